/* SPDX-License-Identifier: MIT */
/* How deep sets of edges and one disc are (a box or a segment and a cylinder or a disc, two upright cylinders), without
 * a polytope: their heights are least where n is square to an edge, or to the disc, and nowhere else (docs/bounds.md).
 * So the great circles square to the edges are gone around, arc by arc, each in its own plane: the shadow of A - B
 * there is a polygon and an ellipse. */
#ifndef GJK_CORE_CIRCLES_H
#define GJK_CORE_CIRCLES_H

#include "round.h"

#if DIM == 3

/* A vector of the plane. */
typedef struct arrow {
    real x, y;
} arrow;

static inline real dot2(arrow a, arrow b) { return a.x * b.x + a.y * b.y; }
static inline real cross2(arrow a, arrow b) { return a.x * b.y - a.y * b.x; }
static inline arrow add2(arrow a, arrow b) { return (arrow){a.x + b.x, a.y + b.y}; }
static inline arrow sub2(arrow a, arrow b) { return (arrow){a.x - b.x, a.y - b.y}; }
static inline arrow mul2(arrow a, real k) { return (arrow){a.x * k, a.y * k}; }
static inline arrow left2(arrow a) { return (arrow){-a.y, a.x}; }
static inline arrow unit2(arrow a) { return mul2(a, 1 / root(dot2(a, a))); }

#define MOST_EDGES (MOST_LIMBS - 2)
#define MOST_NODES (MOST_EDGES + 4)
#define MOST_OVALS 2

/* An ellipse: its two rows, what they span at least, and by how much it is wide where that is known. */
typedef struct oval {
    arrow row[2];
    real area, wide;
} oval;

/* A direction on a circle, what each ellipse counts for along it, and how high A - B is there. */
typedef struct node {
    arrow n;
    real far[MOST_OVALS], height;
} node;

/* Half a great circle, on which the middle counts for nothing or less: along the other half heights are no less. Or a
 * part of it. */
typedef struct circle {
    vec e[2];                       /* its plane */
    arrow middle, edge[MOST_EDGES]; /* there */
    oval oval[MOST_OVALS];
    int edges, ovals, nodes;
    node node[MOST_NODES]; /* from its start to its end, by angles */
} circle;

/* All of them, where they are least, and what is charged for rounding. */
typedef struct circles {
    const bulk *of;
    int disc, count; /* disc: the one of A - B; -1: bodies about one axis (meridian.h) */
    circle at[MOST_EDGES];
    real ends, least, off; /* the least along the disc's axis, and of all, */
    vec n;                 /*   there, */
    int in;                /*   seen in that one; */
    real simple;           /* heights are no less, which takes no trip to know */
    int level;             /* all around the axis they are about the same: 1; or all but the same: 2 */
} circles;

/* ---- the shadow ---- */

static inline arrow oval_along(const oval *o, arrow n) { return (arrow){dot2(o->row[0], n), dot2(o->row[1], n)}; }

static inline node node_at(const circle *c, arrow n)
{
    node r = {.n = n, .height = dot2(c->middle, n)};
    for (int i = 0; i < c->edges; i++) r.height += size(dot2(c->edge[i], n));
    for (int i = 0; i < c->ovals; i++) {
        const arrow rim = oval_along(&c->oval[i], n);
        r.height += r.far[i] = root(dot2(rim, rim));
    }
    return r;
}

static inline vec lifted(const circle *c, arrow n) { return add(mul(c->e[0], n.x), mul(c->e[1], n.y)); }
static inline arrow in_plane(const circle *c, vec x) { return (arrow){dot(c->e[0], x), dot(c->e[1], x)}; }

/* Whether it has a direction. */
static inline int leads(arrow a) { return dot2(a, a) > REAL_MIN / UNIT; }

/* How far on the half circle from start the direction is, from 0 to 2: exactly so far only at both ends and amid them,
 * but more where the angle is larger, by more than rounding, and that is 2 UNIT of it. */
static real turn_from(arrow start, arrow n)
{
    const real x = dot2(start, n), y = larger(cross2(start, n), 0);
    return x < 0 ? 2 - y / (y - x) : y / (x + y);
}

/* Directions on half a circle, by angles, as these grow. */
typedef struct directions {
    arrow n[MOST_NODES];
    real turn[MOST_NODES];
    int count;
} directions;

/* Puts one, or the other way, where its angle is. */
static void put_direction(directions *f, arrow n)
{
    if (!leads(n)) return;
    n = unit2(n);
    if (cross2(f->n[0], n) < 0) n = mul2(n, -1);
    const real turn = turn_from(f->n[0], n);
    int at = f->count++;
    for (; at > 1 && turn < f->turn[at - 1]; at--) {
        f->n[at] = f->n[at - 1];
        f->turn[at] = f->turn[at - 1];
    }
    f->n[at] = n;
    f->turn[at] = turn;
}

/* Where the shadow's heights have edges, where the disc is narrow, and no two farther apart than a quarter. */
static void put_nodes(circle *c, arrow axle)
{
    directions f;
    f.n[0] = leads(c->middle) ? unit2(left2(c->middle)) : (arrow){1, 0};
    f.count = 1;
    put_direction(&f, left2(f.n[0]));
    put_direction(&f, axle);
    for (int i = 0; i < c->edges; i++) put_direction(&f, left2(c->edge[i]));
    f.n[f.count++] = mul2(f.n[0], -1);
    c->nodes = f.count;
    for (int i = 0; i < c->nodes; i++) c->node[i] = node_at(c, f.n[i]);
}

/* The circle square to edge i. */
static void draw_circle(const bulk *of, int rim, int i, circle *c)
{
    const vec edge = unit_size(of->limb[i].row[0]);
    const limb *l = &of->limb[rim];
    put_across(mul(edge, 1 / length(edge)), c->e);
    for (int k = 0; k < 2; k++) c->e[k] = mul(c->e[k], (real)1.5 - dot(c->e[k], c->e[k]) / 2); /* as long as 1 can be */
    c->middle = in_plane(c, of->middle);
    c->edges = 0;
    for (int j = 0; j < of->limbs; j++)
        if (j != i && j != rim) c->edge[c->edges++] = in_plane(c, of->limb[j].row[0]);
    oval *o = &c->oval[0];
    for (int r = 0; r < 2; r++) o->row[r] = in_plane(c, l->row[r]);
    o->area = larger(size(cross2(o->row[0], o->row[1])) - 16 * UNIT * l->size * l->size, 0);
    o->wide = l->size;
    c->ovals = 1;
    put_nodes(c, in_plane(c, cross(l->row[0], l->row[1])));
}

/* ---- all circles ---- */

static void take_least(circles *all, real height, vec n)
{
    if (!(height < all->least)) return;
    all->least = height;
    all->n = n;
}

/* Takes a circle, or a part of one, in, whose nodes are known. */
static void take_circle(circles *all)
{
    const circle *c = &all->at[all->count];
    for (int k = 0; k < c->nodes; k++) {
        if (!(c->node[k].height < all->least)) continue;
        take_least(all, c->node[k].height, lifted(c, c->node[k].n));
        all->in = all->count;
    }
    all->count++;
}

/* What the limbs count for in all, at most; of a disc that is given by its rows. */
static real sum_of_sizes(const bulk *of, const limb *rim)
{
    real sum = length(of->middle);
    for (int i = 0; i < of->limbs; i++) {
        const limb *l = &of->limb[i];
        const vec u = l->row[0], v = l->row[1];
        if (l == rim) sum += root(larger(dot(u, u), dot(v, v)) + size(dot(u, v)));
        else sum += l->partial ? l->steep : l->size;
    }
    return sum;
}

/* What is joined of limbs is as high as these to so much, but for how long they are; with what segments are mapped. */
static real askew_of(const bulk *of)
{
    real sum = 0;
    for (int i = 0; i < of->limbs; i++) sum += of->limb[i].askew + (of->limb[i].stick ? 20 * UNIT : 0);
    for (int i = of->limbs; i < of->limbs + of->joined; i++) sum += of->limb[i].stick ? 20 * UNIT : 0;
    return sum * (1 + 16 * UNIT);
}

/* By so much a limb may not be as long as both, if another is joined to it. */
static real off_in_length(const bulk *of, int at)
{
    for (int i = of->limbs; i < of->limbs + of->joined; i++)
        if (of->limb[i].mate == at) return 12 * UNIT * of->limb[at].size;
    return 0;
}

/* What joints do to a floor. */
static real off_by_joints(const bulk *of)
{
    real off = askew_of(of);
    for (int i = 0; i < of->limbs; i++) off += off_in_length(of, i);
    return off;
}

/* What rounding does to it, as derived in docs/bounds.md, and what is joined. */
static real charge_circles(const bulk *of, const limb *rim)
{
    return UNIT * (37 * sum_of_sizes(of, rim) + 2) + off_by_joints(of);
}

/* The disc, if there is one, and all else are edges. -1: that is not so. */
static int find_disc(const bulk *of)
{
    int rim = -1;
    for (int i = 0; i < of->limbs; i++) {
        const limb *l = &of->limb[i];
        if (l->partial || l->rows > 2 || (l->rows == 2 && rim >= 0)) return -1;
        if (l->rows == 2) rim = i;
    }
    return rim;
}

/* Square to the disc, both ways. 0: it is too narrow for that to be told. */
static int look_along_spindle(circles *all)
{
    const limb *l = &all->of->limb[all->disc];
    const spindle k = spindle_of(l);
    const real far = length(k.way);
    if (!(length(k.off) <= 64 * UNIT * far)) return 0;
    const vec n = mul(k.way, 1 / far);
    take_least(all, height_of_bulk(all->of, n), n);
    take_least(all, height_of_bulk(all->of, mul(n, -1)), mul(n, -1));
    return 1;
}

/* How high a disc and one edge are at least, as of bodies along one axis: on the circle square to the edge there is the
 * disc's shadow alone, as high as that is narrow, off its middle. */
static real floor_of_one_edge(const circles *all)
{
    const circle *c = &all->at[0];
    const limb *l = &all->of->limb[all->disc];
    const arrow u = c->oval[0].row[0], v = c->oval[0].row[1];
    const real mean = (dot2(u, u) + dot2(v, v)) / 2, half = u.x * u.x + v.x * v.x - mean, mixed = u.x * u.y + v.x * v.y;
    const real least = mean - root(half * half + mixed * mixed), off = length(all->of->middle);
    if (!(2 * least > mean)) return -REAL_MAX;
    const real charge = UNIT * (24 * (l->size + off) + 2) + off_in_length(all->of, all->disc);
    const real around = root(least) - root(dot2(c->middle, c->middle)) - charge - askew_of(all->of);
    return smaller(around, all->ends - all->off);
}

/* Looks along all that are to be looked along first. 0: the set is another. */
static int draw_circles(circles *all, const bulk *of)
{
    all->of = of;
    all->disc = find_disc(of);
    all->count = 0;
    all->least = REAL_MAX;
    if (all->disc < 0 || of->limbs > MOST_EDGES + 1 || !look_along_spindle(all)) return 0;
    all->ends = all->least;
    all->off = charge_circles(of, &of->limb[all->disc]);
    for (int i = 0; i < of->limbs; i++) {
        if (i == all->disc) continue;
        draw_circle(of, all->disc, i, &all->at[all->count]);
        take_circle(all);
    }
    all->simple = all->count == 1 ? floor_of_one_edge(all) : -REAL_MAX;
    all->level = 0;
    return all->count > 0;
}

/* ---- an arc ---- */

/* From one direction to another, less than half a circle on; the corner of the edges that is the farthest along all of
 * it; and how high A - B is to be. */
typedef struct arc {
    node from, to;
    arrow corner;
    real high;
} arc;

/* Between two nodes. */
static arc arc_between(const circle *c, int from, real high)
{
    arc a = {c->node[from], c->node[from + 1], c->middle, high};
    const arrow middle = add2(a.from.n, a.to.n);
    for (int i = 0; i < c->edges; i++)
        a.corner = add2(a.corner, mul2(c->edge[i], dot2(c->edge[i], middle) < 0 ? -1 : 1));
    return a;
}

/* How high a point of the shadow is along one of the arc's ends, and how that changes on the way to the other. */
typedef struct stance {
    real high, slope;
} stance;

/* That corner and the point of each ellipse that is the farthest there or, where there is none, along the middle. */
static inline stance stance_at(const circle *c, const arc *a, const node *end, real back)
{
    const arrow left = mul2(left2(end->n), back);
    stance s = {dot2(a->corner, end->n), dot2(a->corner, left)};
    for (int i = 0; i < c->ovals; i++) {
        const arrow rim = oval_along(&c->oval[i], end->n), there = oval_along(&c->oval[i], left);
        if (leads(rim)) {
            s.high += end->far[i];
            s.slope += dot2(rim, there) / end->far[i];
            continue;
        }
        const arrow amid = oval_along(&c->oval[i], add2(a->from.n, a->to.n));
        if (!leads(amid)) continue;
        s.high += dot2(unit2(amid), rim);
        s.slope += dot2(unit2(amid), there);
    }
    return s;
}

/* Where an ellipse is so much narrower than where it is widest, rounding may take its point too far off to tell by it
 * how it is curved. */
#define WELL_SEEN ((real)0.25)

/* Of what it is curved so much is left out for that. */
#define BOW_LOSS (UNIT < (real)0x1p-40 ? (real)0x1p-20 : (real)0x1p-8)

/* By so much at least the ellipse is curved along the arc. */
static real bow_along(const oval *o, real from, real to, real cosine)
{
    const real far = larger(from, to), most = far * far * 2 / (1 + cosine), cube = most * root(most);
    return cube > REAL_MIN / UNIT ? o->area * o->area / cube * (1 - BOW_LOSS) : 0;
}

/* An arc of that sine and cosine is as high as that by what is seen from one end, if the shadow is curved so beyond the
 * point there. */
static int is_high(const stance *s, real bow, real cosine, real sine, real high)
{
    const real over = s->high - bow, under = bow - high;
    if (!(s->high >= high && bow + over * cosine + s->slope * sine >= high)) return 0;
    if (s->slope >= 0 || s->slope * cosine - over * sine <= 0) return 1;
    return under >= 0 && under * under >= over * over + s->slope * s->slope;
}

/* From one of its ends, the arc is as high as it is to be. */
static int is_arc_high(const circle *c, const arc *a)
{
    const real cosine = dot2(a->from.n, a->to.n), sine = size(cross2(a->from.n, a->to.n));
    const stance first = stance_at(c, a, &a->from, 1);
    if (is_high(&first, 0, cosine, sine, a->high)) return 1;
    const stance last = stance_at(c, a, &a->to, -1);
    if (is_high(&last, 0, cosine, sine, a->high)) return 1;
    real bow_of_first = 0, bow_of_last = 0;
    for (int i = 0; i < c->ovals; i++) {
        const oval *o = &c->oval[i];
        const real from = a->from.far[i], to = a->to.far[i], bow = bow_along(o, from, to, cosine);
        bow_of_first += from >= WELL_SEEN * o->wide ? bow : 0;
        bow_of_last += to >= WELL_SEEN * o->wide ? bow : 0;
    }
    const real most = 2 * a->high;
    return is_high(&first, smaller(bow_of_first, most), cosine, sine, a->high) ||
           is_high(&last, smaller(bow_of_last, most), cosine, sine, a->high);
}

/* So often an arc and its parts are halved in all. */
#define HALVINGS 64

enum round_trip { AROUND, IS_LOWER, UNPROVEN };

/* From one node to the next. IS_LOWER: below n it is lower. UNPROVEN: it is not told. */
static enum round_trip go_along(const circle *c, arc a, arrow *n)
{
    node next[HALVINGS];
    int halved = 0, ahead = 0;
    for (;;) {
        if (!(a.from.height >= a.high && a.to.height >= a.high)) return UNPROVEN;
        if (is_arc_high(c, &a)) {
            if (ahead == 0) return AROUND;
            a.from = a.to;
            a.to = next[--ahead];
            continue;
        }
        if (halved++ == HALVINGS) return UNPROVEN;
        next[ahead++] = a.to;
        a.to = node_at(c, unit2(add2(a.from.n, a.to.n)));
        *n = a.to.n;
        if (a.to.height < a.high) return IS_LOWER;
    }
}

/* Whether A - B is so high along all circles. IS_LOWER: all->n is where it is not. */
static enum round_trip are_circles_high(circles *all, real high)
{
    for (int i = 0; i < all->count; i++) {
        const circle *c = &all->at[i];
        for (int k = 0; k + 1 < c->nodes; k++) {
            arrow n;
            const enum round_trip trip = go_along(c, arc_between(c, k, high), &n);
            if (trip == AROUND) continue;
            if (trip == IS_LOWER) all->n = lifted(c, n);
            all->in = i;
            return trip;
        }
    }
    return AROUND;
}

/* ---- where edges cross ---- */

/* So often shares are told in turn. Of edges square to one another once will do. */
#define SHARINGS 8

/* Moves what the limb counts for, by so much, within its bounds: as much of the rest as there is along its rows. */
static void share_rest(const limb *l, real *share, vec *rest)
{
    real square = 0, was[2];
    for (int r = 0; r < l->rows; r++) {
        const real rr = dot(l->row[r], l->row[r]);
        was[r] = share[r];
        share[r] -= rr > REAL_MIN / UNIT ? dot(*rest, l->row[r]) / rr : 0;
        square += share[r] * share[r];
    }
    const real times = square > 1 ? 1 / root(square) : 1;
    for (int r = 0; r < l->rows; r++) {
        share[r] *= times;
        *rest = add(*rest, mul(l->row[r], share[r] - was[r]));
    }
}

/* The point that is farthest along n where that lies on more edges than tell their shares (round.h), as of a cylinder
 * that stands on a box: each takes what the others leave aside of n. Nothing is said of how heights are bent there. */
static void stand_on_edges(const circles *all, bent *b)
{
    const bulk *of = all->of;
    vec rest = of->middle;
    unsigned on = 0;
    *b = (bent){.n = all->n, .height_off = REAL_MAX};
    for (int i = 0; i < of->limbs; i++) {
        const limb *l = &of->limb[i];
        const bearing v = bearing_of(l, b->n);
        if (size(l->rows == 1 ? v.here : v.far) <= 64 * UNIT * l->size) on |= 1u << i;
        else if (l->rows == 1) rest = add(rest, mul(l->row[0], b->sign[i] = v.here < 0 ? -1 : 1));
        else
            for (int r = 0; r < 2; r++) rest = add(rest, mul(l->row[r], v.along.c[r] / v.far));
    }
    b->edges = on & (1u << all->disc);
    for (; b->edges && b->rows < 2; b->rows++) b->of[b->rows] = all->disc;
    for (int k = 0; k < SHARINGS; k++)
        for (int i = 0; i < of->limbs; i++)
            if (on >> i & 1) share_rest(&of->limb[i], i == all->disc ? b->share : &b->sign[i], &rest);
}

#endif

#endif
