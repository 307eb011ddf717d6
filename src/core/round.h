/* SPDX-License-Identifier: MIT */
/* Round sets. The height of an ellipsoid, a cylinder, a cone or a box along n is a sum of lengths |L n|, or of parts of
 * such, whose slopes and curvatures are known; so where the height of A - B is least nearby is found in a few turns of
 * n: the way to the nearest points, where they are apart, and a way out, where they overlap. Nothing is proven here. */
#ifndef GJK_CORE_ROUND_H
#define GJK_CORE_ROUND_H

#include "minkowski.h"

/* Directions across a normal. */
#define ACROSS (DIM - 1)

#define MOST_LIMBS (2 * DIM)

/* Adds |L n| to the height along n; it is straight, of one row, or round. A cone's adds what |L n| + lean.n is above 0,
 * if it is: |L n| + lean.n times (1 + sign) / 2, the sign that of it. */
typedef struct limb {
    vec row[DIM];    /* of L, so many, */
    int rows;        /*   and then 0 */
    vec square[DIM]; /* of a round one: L^T L */
    int partial;     /* a cone's */
    vec lean;
    real size;       /* bounds |L| */
    real aside;      /* so much of what is joined to it may lead aside from its axis or plane, */
    real askew;      /*   and in all be off it but for its length */
    real vague;      /* what counts for no more than that may be of either sign; of a round one that is no cone's all */
    real steep;      /* of a cone's, and |lean| */
    int of_b, first; /* the body's axes that it is made of, from that on; */
    real length[DIM]; /*   along these, in the body's own unit; of a cone's also half its length, beside these */
    int stick;        /* or a segment's: */
    vec half, center; /*   half the way to its second end, and the middle between these, in that unit, too */
    int mate, back;   /* where it is joined: the limb that counts for it, and whether that leads the other way */
} limb;

/* What the heights of A - B are made of, in the frame: middle.n, and its limbs'. */
typedef struct bulk {
    limb limb[MOST_LIMBS];
    int limbs, joined; /* so many count; and behind them are those that count with these; below 0: not yet looked for */
    vec middle;
} bulk;

/* ---- what ready-made sets are made of ---- */

/* How a body's own points come to the frame: by its map, if it has one, and times the grain; and its unit. */
typedef struct stand {
    const real *m;
    real unit, grain;
} stand;

static inline stand stand_of(const body *k) { return (stand){k->posed ? k->m : NULL, k->unit, k->grain}; }

/* Where a way or a point in the body's own unit, from where it is posed, lies in the frame. */
static vec in_frame(const stand *k, vec x) { return mul(k->m ? map(k->m, x) : x, k->grain); }

/* Where the body's axis leads, by its map. */
static vec axis_by_map(const stand *k, int at)
{
    vec u = axis(at, 1);
    for (int i = 0; i < DIM && k->m; i++) u.c[i] = k->m[DIM * i + at];
    return u;
}

/* The axis, so long, in the frame. */
static vec axis_in_frame(const stand *k, int at, real size) { return mul(axis_by_map(k, at), size * k->grain); }

/* What its rows are, where these are known. */
static void measure_limb(limb *l)
{
    real square = 0;
    for (int r = 0; r < l->rows; r++) square += dot(l->row[r], l->row[r]);
    for (int i = 0; i < DIM && l->rows > 1; i++) {
        l->square[i] = mul(l->row[0], l->row[0].c[i]);
        for (int r = 1; r < l->rows; r++) l->square[i] = add(l->square[i], mul(l->row[r], l->row[r].c[i]));
    }
    l->size = root(square) * (1 + 16 * UNIT);
    l->vague = l->rows > 1 ? REAL_MAX : 64 * UNIT * l->size;
}

/* Takes in the limb that has been put in after the last, its rows there, so many. Of no length they add nothing. */
static void keep_limb(bulk *b, int rows)
{
    limb *l = &b->limb[b->limbs];
    for (int r = rows; r < DIM; r++) l->row[r] = axis(0, 0);
    l->rows = rows;
    l->partial = l->back = 0;
    l->aside = l->askew = 0;
    measure_limb(l);
    b->limbs += l->size > 0;
}

/* The body's axes from the first on, so many, each as long as it says. */
static void add_limb(bulk *b, const stand *k, int of_b, int first, int rows, const real *lengths)
{
    limb *l = &b->limb[b->limbs];
    l->of_b = of_b;
    l->first = first;
    l->stick = 0;
    for (int r = 0; r < rows; r++) {
        l->length[r] = lengths[r] * k->unit;
        l->row[r] = axis_in_frame(k, first + r, l->length[r]);
    }
    keep_limb(b, rows);
}

/* A segment. */
static void add_stick(bulk *b, const stand *k, int of_b, const real *ends)
{
    limb *l = &b->limb[b->limbs];
    const vec first = mul(load(ends), k->unit), last = mul(load(ends + DIM), k->unit);
    l->of_b = of_b;
    l->stick = 1;
    l->half = mul(sub(last, first), (real)0.5);
    l->center = mul(add(last, first), (real)0.5);
    l->row[0] = in_frame(k, l->half);
    b->middle = add(b->middle, mul(in_frame(k, l->center), of_b ? (real)-1 : (real)1));
    keep_limb(b, 1);
}

static void add_box(bulk *b, const stand *k, int of_b, const real *half)
{
    for (int i = 0; i < DIM; i++) add_limb(b, k, of_b, i, 1, half + i);
}

#if DIM == 3
static void add_cylinder(bulk *b, const stand *k, int of_b, real radius, real half)
{
    const real radii[2] = {radius, radius};
    add_limb(b, k, of_b, 0, 2, radii);
    add_limb(b, k, of_b, 2, 1, &half);
}

/* A cone is its apex, and what its disc rises above that. 0: it has none. */
static int add_cone(bulk *b, const stand *k, int of_b, real radius, real half)
{
    const real radii[2] = {radius, radius};
    limb *l = &b->limb[b->limbs];
    add_limb(b, k, of_b, 0, 2, radii);
    if (!(l->size > 0 && half > 0)) return 0;
    l->partial = 1;
    l->length[2] = half * k->unit;
    const vec up = axis_in_frame(k, 2, of_b ? -l->length[2] : l->length[2]);
    b->middle = add(b->middle, up);
    l->lean = mul(up, -2);
    l->steep = l->size + length(l->lean) * (1 + 16 * UNIT);
    l->vague = 64 * UNIT * l->steep;
    return 1;
}
#endif

/* 0: it is not known what the set's heights are made of. */
static int add_body(bulk *b, const body *of, int of_b, const shape *s)
{
    const stand k = stand_of(of);
    const real *sizes = s->data;
    support_fn *const f = s->support;
    if (f == pub(support_origin)) return 1;
    if (f == pub(support_box)) {
        add_box(b, &k, of_b, sizes);
        return 1;
    }
    if (f == pub(support_segment)) {
        add_stick(b, &k, of_b, sizes);
        return 1;
    }
    if (f == pub(support_ellipsoid) || f == pub(support_ball)) {
        const real radii[3] = {sizes[0], sizes[0], sizes[0]};
        add_limb(b, &k, of_b, 0, DIM, f == pub(support_ball) ? radii : sizes);
        return 1;
    }
#if DIM == 3
    if (f == pub(support_cone)) return add_cone(b, &k, of_b, sizes[0], sizes[1]);
    if (f == pub(support_cylinder) || f == pub(support_disc)) {
        add_cylinder(b, &k, of_b, sizes[0], f == pub(support_disc) ? 0 : sizes[1]);
        return 1;
    }
#endif
    return 0;
}

#if DIM == 3
/* Along which a limb has an edge, or square to which: its axis, of any length, and what rounding does to each number of
 * that, but for the rows' own, of which each has lost 2 roundings of itself. 0: it has none. */
typedef struct spindle {
    vec way, off;
} spindle;

/* The product of vectors of sizes, all added up. */
static inline vec cross_sizes(vec a, vec b)
{
    return (vec){
        {a.c[1] * b.c[2] + a.c[2] * b.c[1], a.c[2] * b.c[0] + a.c[0] * b.c[2], a.c[0] * b.c[1] + a.c[1] * b.c[0]}};
}

static inline vec sizes_of_vec(vec a)
{
    EACH(a.c[i] = size(a.c[i]));
    return a;
}

static spindle spindle_of(const limb *l)
{
    const vec none = axis(0, 0), u = unit_size(l->row[0]), v = unit_size(l->row[1]);
    if (l->rows == 2) return (spindle){cross(u, v), mul(cross_sizes(sizes_of_vec(u), sizes_of_vec(v)), 6 * UNIT)};
    return (spindle){l->rows == 1 ? u : none, none};
}

static inline int are_parallel(vec u, vec v)
{
    const real along = dot(u, v), most = dot(u, u) * dot(v, v);
    if (!(2 * along * along > most)) return 0;
    const vec n = cross(u, v);
    return dot(n, n) <= 4096 * UNIT * UNIT * most;
}

/* The sine between two that are parallel so far, at most. */
static real sine_between(const spindle *k, const spindle *l)
{
    const vec u = sizes_of_vec(k->way), v = sizes_of_vec(l->way);
    const vec off = add(cross_sizes(u, l->off), cross_sizes(k->off, v));
    const vec sum = add(sizes_of_vec(cross(k->way, l->way)), add(mul(cross_sizes(u, v), 6 * UNIT), off));
    return length(sum) / (length(u) * length(v)) * (1 + 16 * UNIT);
}

/* Whether the squares that its size is made of have all their digits. */
static inline int has_squares(const limb *l) { return l->size * l->size > 8 * REAL_MIN / UNIT; }

/* By how much a limb of two rows is no circle, of one. */
static inline real unevenness(const limb *l)
{
    const real xx = dot(l->row[0], l->row[0]), yy = dot(l->row[1], l->row[1]), xy = dot(l->row[0], l->row[1]);
    return (size(xx - yy) + 2 * size(xy)) / xx + 16 * UNIT;
}

/* Limbs along one axis are joined if no more of one than that leads aside from the other, and so much that is round is
 * a circle. */
#define ASIDE_MOST (32 * UNIT)
#define UNEVEN_MOST (64 * UNIT)

/* Limb i, which is like j, then is as long as both, and j stands behind those that count, with it. */
static void join_limbs(bulk *b, int i, int j, real sine, real uneven)
{
    limb *l = &b->limb[i];
    const limb m = b->limb[j];
    const real times = 1 + m.size / l->size;
    l->aside = (l->aside + sine * m.size) * (1 + 8 * UNIT);
    l->askew = (l->askew + l->aside + uneven * m.size) * (1 + 8 * UNIT);
    for (int r = 0; r < l->rows; r++) l->row[r] = mul(l->row[r], times);
    measure_limb(l);
    b->limbs--;
    b->joined++;
    for (int k = j; k < b->limbs; k++) b->limb[k] = b->limb[k + 1];
    limb *last = &b->limb[b->limbs];
    *last = m;
    last->mate = i;
    last->back = dot(l->row[0], m.row[0]) < 0;
}

/* The same, if they are alike. */
static int try_join(bulk *b, int i, int j, const spindle *k, const spindle *l)
{
    const limb *x = &b->limb[i], *y = &b->limb[j];
    if (x->rows != y->rows || x->partial || y->partial || !has_squares(x) || !has_squares(y)) return 0;
    const real sine = sine_between(k, l), uneven = x->rows > 1 ? unevenness(x) + unevenness(y) : 0;
    if (!(sine <= ASIDE_MOST && uneven <= UNEVEN_MOST)) return 0;
    join_limbs(b, i, j, sine, uneven);
    return 1;
}
#endif

/* Of limbs of A and of B that are alike, along one axis to rounding, one is made, once. Their edges lie on one another,
 * and n would be on more than tell their shares. */
static void join_alike(bulk *b)
{
    if (b->joined >= 0) return;
    b->joined = 0;
#if DIM == 3
    spindle at[MOST_LIMBS];
    for (int j = 0; j < b->limbs; j++) {
        at[j] = spindle_of(&b->limb[j]);
        for (int i = 0; i < j; i++) {
            if (b->limb[i].of_b == b->limb[j].of_b || !are_parallel(at[i].way, at[j].way)) continue;
            if (!try_join(b, i, j, &at[i], &at[j])) continue;
            j--;
            break;
        }
    }
#endif
}

static int know_bulk(bulk *b, const difference *d, const shape *s, const shape *t)
{
    b->limbs = 0;
    b->middle = mul(d->c, -1);
    b->joined = -1;
    return add_body(b, &d->a, 0, s) && add_body(b, &d->b, 1, t);
}

/* The axes of a body, by bits, along which heights have edges; of unit size. How many. */
static int put_edged(const stand *k, unsigned axes, vec way[DIM])
{
    int n = 0;
    for (int i = 0; i < DIM; i++)
        if (axes >> i & 1) way[n++] = unit_size(axis_by_map(k, i));
    return n;
}

/* The same of any: of a box all, of a disc its own, of a segment this; of an ellipsoid none. */
static int put_edged_of(const stand *k, const shape *s, vec way[DIM])
{
    support_fn *const f = s->support;
    if (f == pub(support_segment)) {
        const real *ends = s->data;
        const vec along = sub(mul(load(ends + DIM), k->unit), mul(load(ends), k->unit));
        way[0] = unit_size(in_frame(k, along));
        return 1;
    }
#if DIM == 3
    if (f == pub(support_cylinder) || f == pub(support_disc) || f == pub(support_cone)) return put_edged(k, 4, way);
#endif
    return f == pub(support_box) ? put_edged(k, (1u << DIM) - 1, way) : 0;
}

/* Whether one of the ways is one of the others, to rounding: edges and faces may lie on one another then, so that n is
 * on more edges than tell their shares. A few corners find such a place. */
static int are_aligned(const vec *u, int n, const vec *v, int m)
{
#if DIM == 3
    for (int i = 0; i < n; i++)
        for (int j = 0; j < m; j++)
            if (are_parallel(u[i], v[j])) return 1;
#else
    (void)u, (void)n, (void)v, (void)m;
#endif
    return 0;
}

static int are_bodies_aligned(const difference *d, const shape *a, const shape *b)
{
    const stand k = stand_of(&d->a), l = stand_of(&d->b);
    vec u[DIM], v[DIM];
    const int n = put_edged_of(&k, a, u);
    return DIM == 3 && n > 0 && are_aligned(u, n, v, put_edged_of(&l, b, v));
}

/* Whether heights have no edges. */
static inline int are_ellipsoids(const bulk *of)
{
    int r = 1;
    for (int i = 0; i < of->limbs; i++) r &= of->limb[i].rows == DIM;
    return r;
}

/* Whether it is known of the set, but for cones without a length or a disc. */
static int has_heights(const shape *s)
{
    support_fn *const f = s->support;
#if DIM == 3
    if (f == pub(support_cylinder) || f == pub(support_disc) || f == pub(support_cone)) return 1;
#endif
    return f == pub(support_ellipsoid) || f == pub(support_ball) || f == pub(support_box) ||
           f == pub(support_segment) || f == pub(support_origin);
}

/* Of both, and one is round. */
static inline int have_heights(const shape *a, const shape *b)
{
    return ROUND && has_heights(a) && has_heights(b) && !(has_corners(a) && has_corners(b));
}

/* ---- slope and curvature ---- */

/* A symmetric form of directions across. */
typedef struct quadric {
    real c[ACROSS][ACROSS]; /* at and below the diagonal */
} quadric;

/* The height along n, and how it changes as n is turned across: of n + t with t across n, it is height + slope.t +
 * t.bow t / 2 to the second order. n may lie on edges of the height: where limbs have no length, or a cone's is 0.
 * There they count as their shares say, each within 1, and above that the height rises as the quadric kink has it. */
typedef struct bent {
    vec n, e[ACROSS]; /* unit and square to one another, to rounding */
    real height, slope[ACROSS];
    quadric bow, kink;
    quadric part, rim;                             /* what cones' edges may give of the bow, and get for it as a kink */
    real slope_off, bow_off, kink_off, height_off; /* by so much these may be off */
    real sway;              /* farther off, by t, the bow may be less, by the factor 1 + sway |t| */
    unsigned edges, slants; /* the limbs on whose edges n is to lie; of these, a cone's that are 0: */
    int rows;               /*   so many rows in all, */
    int of[ACROSS];         /*   of these limbs, */
    real d[ACROSS][ACROSS]; /*   across, */
    real off[ACROSS];       /*   and how far n is from there; */
    real share[ACROSS];     /*   what the rows count for, */
    quadric slant[ACROSS];  /*   and how all of a cone's is bowed */
    real sign[MOST_LIMBS];  /* as which straight limbs and cones' count, on slants by their shares as last known */
    real room;              /* see room_of_ball; below 0: it is not told yet */
    real floor;             /* heights are no less, by circles; 0: that is not told; */
    int level;              /*   and about the same all around an axis, 1, or all but the same, 2 */
} bent;

static inline int is_on_edge(const bent *b, int i) { return (int)(b->edges >> i & 1); }
static inline int is_on_slant(const bent *b, int i) { return (int)(b->slants >> i & 1); }

static void put_across(vec n, vec e[ACROSS])
{
#if DIM == 2
    e[0] = (vec){{-n.c[1], n.c[0]}};
#else
    const real x = size(n.c[0]), y = size(n.c[1]), z = size(n.c[2]);
    const int k = x <= y && x <= z ? 0 : y <= z ? 1 : 2;
    vec a = cross(n, axis(k, 1));
    e[0] = mul(a, 1 / length(a));
    e[1] = cross(n, e[0]);
#endif
}

static inline void add_quadric(quadric *f, const quadric *g, real k)
{
    for (int i = 0; i < ACROSS; i++)
        for (int j = 0; j <= i; j++) f->c[i][j] += k * g->c[i][j];
}

static inline void add_square(quadric *f, const real d[ACROSS], real k)
{
    for (int i = 0; i < ACROSS; i++)
        for (int j = 0; j <= i; j++) f->c[i][j] += k * d[i] * d[j];
}

/* How n stands to a limb: L n, its length, and what the limb counts for, if it does; of a straight one L n's number. */
typedef struct bearing {
    vec along;
    real far, here;
} bearing;

static inline bearing bearing_of(const limb *l, vec n)
{
    bearing v = {axis(0, 0), 0, 0};
    if (l->rows == 1) {
        v.here = dot(l->row[0], n);
        return v;
    }
    EACH(v.along.c[i] = dot(l->row[i], n));
    v.far = length(v.along);
    v.here = l->partial ? v.far + dot(l->lean, n) : v.far;
    return v;
}

/* What is too much by this, where that is not certain to be below 0. */
static inline void count_off(bent *b, real off, real slop)
{
    if (!(off < -slop)) b->height_off += size(off) + slop;
}

/* A straight limb is no more than its slope; where its sign is not certain, or not that, n is off it. */
static void add_straight(bent *b, const limb *l, real here, real sign)
{
    b->height += sign * here;
    count_off(b, -2 * (sign * here), 16 * UNIT * l->size + 2 * l->aside);
    b->slope_off += 2 * l->aside;
    for (int j = 0; j < ACROSS; j++) b->slope[j] += sign * dot(l->row[0], b->e[j]);
}

/* The slope of |L n|, and its curvature. */
static inline quadric add_round(bent *b, const limb *l, real far, real slope[ACROSS])
{
    const real per = 1 / far, share = l->size * per;
    quadric bow;
    vec g[ACROSS];
    for (int j = 0; j < ACROSS; j++) {
        EACH(g[j].c[i] = dot(l->square[i], b->e[j]));
        slope[j] = dot(g[j], b->n) * per;
    }
    for (int i = 0; i < ACROSS; i++)
        for (int j = 0; j <= i; j++) bow.c[i][j] = per * (dot(g[j], b->e[i]) - slope[i] * slope[j]);
    b->slope_off += share * (32 * UNIT * l->size + 4 * l->askew);
    b->bow_off += share * share * (512 * UNIT * l->size + 16 * l->askew);
    b->sway = larger(share, b->sway);
    return bow;
}

static void add_whole(bent *b, const limb *l, real far)
{
    real slope[ACROSS];
    const quadric bow = add_round(b, l, far, slope);
    b->height += far;
    add_quadric(&b->bow, &bow, 1);
    for (int j = 0; j < ACROSS; j++) b->slope[j] += slope[j];
}

/* n is to lie where the limb has no length. */
static void add_edge(bent *b, const limb *l, int at)
{
    for (int r = 0; r < l->rows; r++, b->rows++) {
        b->of[b->rows] = at;
        b->off[b->rows] = dot(l->row[r], b->n);
        for (int j = 0; j < ACROSS; j++) b->d[b->rows][j] = dot(l->row[r], b->e[j]);
        b->height_off += 2 * size(b->off[b->rows]);
    }
    b->height_off += 16 * UNIT * l->size + 2 * l->aside;
    b->slope_off += 32 * UNIT * l->size + 4 * l->askew;
    b->kink_off += 128 * UNIT * l->size + 16 * l->askew;
}

#if DIM == 3
/* A cone's above 0, for all that it is. */
static void add_above(bent *b, const limb *l, const bearing *v)
{
    real slope[ACROSS];
    b->height += v->here;
    count_off(b, -v->here, 16 * UNIT * l->steep);
    const quadric bow = add_round(b, l, v->far, slope);
    add_quadric(&b->bow, &bow, 1);
    for (int j = 0; j < ACROSS; j++) b->slope[j] += slope[j] + dot(l->lean, b->e[j]);
}

/* Where n is to lie between these, for half of it, and its share of the other half. */
static void add_slant(bent *b, const limb *l, const bearing *v, int at)
{
    real slope[ACROSS];
    b->slant[b->rows] = add_round(b, l, v->far, slope);
    add_quadric(&b->bow, &b->slant[b->rows], (1 + b->sign[at]) / 2);
    b->of[b->rows] = at;
    b->off[b->rows] = v->here / 2;
    for (int j = 0; j < ACROSS; j++) {
        b->d[b->rows][j] = (slope[j] + dot(l->lean, b->e[j])) / 2;
        b->slope[j] += b->d[b->rows][j];
    }
    b->rows++;
    b->height_off += size(v->here) + 16 * UNIT * l->steep;
    b->slope_off += 32 * UNIT * l->steep;
    b->kink_off += 256 * UNIT * l->steep * larger(1, l->size / v->far);
}

/* n is to lie along its axis, on the side of its disc; on the other it counts for nothing. */
static void add_base(bent *b, const limb *l, int at)
{
    const real up = dot(l->lean, b->n);
    add_edge(b, l, at);
    b->height += up;
    count_off(b, -up, 16 * UNIT * l->steep);
    for (int j = 0; j < ACROSS; j++) b->slope[j] += dot(l->lean, b->e[j]);
}

static void add_cones(bent *b, const limb *l, const bearing *v, int at)
{
    if (is_on_slant(b, at)) add_slant(b, l, v, at);
    else if (is_on_edge(b, at)) add_base(b, l, at);
    else if (b->sign[at] < 0) count_off(b, v->here, 16 * UNIT * l->steep); /* below 0 it counts for nothing */
    else add_above(b, l, v);
}
#endif

/* The height of A - B along n. */
static real height_of_bulk(const bulk *of, vec n)
{
    real height = dot(of->middle, n);
    for (int k = 0; k < of->limbs; k++) {
        const limb *l = &of->limb[k];
        const real here = bearing_of(l, n).here;
        height += l->rows == 1 ? size(here) : larger(here, 0);
    }
    return height;
}

/* The least value of the quadric on unit vectors. */
static real least_value(const quadric *f)
{
#if DIM == 2
    return f->c[0][0];
#else
    const real half = (f->c[0][0] - f->c[1][1]) / 2, mid = (f->c[0][0] + f->c[1][1]) / 2;
    return mid - root(half * half + f->c[1][0] * f->c[1][0]);
#endif
}

static inline real length_across(const real t[ACROSS])
{
    real square = 0;
    for (int j = 0; j < ACROSS; j++) square += t[j] * t[j];
    return root(square);
}

/* ---- the way out nearby ---- */

/* So often a direction is turned toward it, by so much at most. */
#define ROLLS 24
#define ROLL ((real)0.625)

static inline int is_all_but_level(real slope, real height) { return size(slope) < (real)0x1p-10 * height; }

/* Where heights are all but level, and bowed less than over n's length they fall (a ridge, or a saddle), n does not
 * rest. */
static inline int is_poised(real slope, real bow, real height)
{
    return bow < height - 4096 * UNIT * height && is_all_but_level(slope, height);
}

/* One way across: down, to where there would be no slope if it is bowed, and by no more than that; as far as may be if
 * it is bowed the other way. Where it is level, as far as can be told, what slope there is may be noise. */
static inline real roll_along(real slope, real bow, real height, real most)
{
    const int level = size(bow - height) <= 4096 * UNIT * height;
    const real k = bow > height ? bow - height : level ? bow : 0;
    if (is_poised(slope, bow, height)) return slope > 0 ? -most : most;
    return size(slope) < most * k ? -slope / k : slope > 0 ? -most : most;
}

#if DIM == 2
static void roll(bent *b, real most, real t[1])
{
    t[0] = b->rows ? -b->off[0] / b->d[0][0] : roll_along(b->slope[0], b->bow.c[0][0], b->height, most);
    if (b->rows) b->share[0] = -b->slope[0] / b->d[0][0];
}
#else
/* Solves for the turn at which the slope would be gone, if the height were bowed by so much more all around. 0: it is
 * too narrow a valley to tell. */
static inline int turn_by(const bent *b, const real slope[2], real more, real t[2])
{
    const real p = b->bow.c[0][0] + more, q = b->bow.c[1][1] + more, r = b->bow.c[1][0], whole = p * q - r * r;
    t[0] = (r * slope[1] - q * slope[0]) / whole;
    t[1] = (r * slope[0] - p * slope[1]) / whole;
    return b->height < 0 || whole > (real)0x1p-12 * (p * p + q * q);
}

/* How much more the height is to count as bowed, off edges, where it has that slope: to where the height, and not the
 * height of the same over n's length, would have none (Newton); or, where it is not bowed like that, or that is too
 * far, so much that it is, and the turn no longer than most (Levenberg). */
static real more_bow(const bent *b, const real slope[2], real most)
{
    real t[2];
    const real least = least_value(&b->bow), steep = length_across(slope);
    if (least > b->height && turn_by(b, slope, -b->height, t) && length_across(t) <= most) return -b->height;
    return larger(-least, -b->height) + steep / most;
}

/* Off edges, where n is poised: down along the way across that is bowed least. 0: it is not. */
static int fall(const bent *b, real most, real t[2])
{
    const real least = least_value(&b->bow), p = b->bow.c[0][0] - least, q = b->bow.c[1][1] - least, r = b->bow.c[1][0];
    if (!is_poised(length_across(b->slope), least, b->height)) return 0;
    const real way[2] = {p > q ? r : q, p > q ? -p : -r}, far = length_across(way);
    const real by = b->slope[0] * way[0] + b->slope[1] * way[1] > 0 ? -most : most;
    t[0] = far > 0 ? way[0] * (by / far) : by;
    t[1] = far > 0 ? way[1] * (by / far) : 0;
    return 1;
}

/* n is to stay on one edge. What share that has is told as n would be turned without it. */
static void roll_on_edge(bent *b, real most, real t[2])
{
    const real *d = b->d[0], l = length_across(d), along[2] = {d[0] / l, d[1] / l}, across[2] = {-along[1], along[0]};
    const quadric *f = &b->bow;
    const real mixed = across[0] * (f->c[0][0] * along[0] + f->c[1][0] * along[1]) +
                       across[1] * (f->c[1][0] * along[0] + f->c[1][1] * along[1]);
    const real bow = across[0] * across[0] * f->c[0][0] + 2 * across[0] * across[1] * f->c[1][0] +
                     across[1] * across[1] * f->c[1][1];
    const real back = -b->off[0] / l, steep = b->slope[0] * along[0] + b->slope[1] * along[1];
    const real slope = b->slope[0] * across[0] + b->slope[1] * across[1] + mixed * back;
    const real on = roll_along(slope, bow, b->height, most), side = steep > 0 ? -1 : 1;
    const real beside[2] = {b->slope[0] + side * d[0], b->slope[1] + side * d[1]};
    for (int j = 0; j < 2; j++) t[j] = back * along[j] + on * across[j];
    b->share[0] = -(steep - mixed * slope / (bow + more_bow(b, beside, most))) / l;
}

/* n is where two edges meet, or on the point of one. */
static void roll_to_corner(bent *b, real t[2])
{
    const real(*d)[2] = (const real(*)[2])b->d;
    const real whole = d[0][0] * d[1][1] - d[0][1] * d[1][0];
    t[0] = (b->off[1] * d[0][1] - b->off[0] * d[1][1]) / whole;
    t[1] = (b->off[0] * d[1][0] - b->off[1] * d[0][0]) / whole;
    b->share[0] = (b->slope[1] * d[1][0] - b->slope[0] * d[1][1]) / whole;
    b->share[1] = (b->slope[0] * d[0][1] - b->slope[1] * d[0][0]) / whole;
}

/* How the direction is to turn: to where the height, and not the height of the same over n's length, would have no
 * slope (Newton); or, where it is not bowed like that, at least down. And what shares edges have then. */
static void roll(bent *b, real most, real t[2])
{
    if (b->rows == 2) roll_to_corner(b, t);
    else if (b->rows == 1) roll_on_edge(b, most, t);
    else if (!fall(b, most, t)) turn_by(b, b->slope, more_bow(b, b->slope, most), t);
}
#endif

/* How much the shares of a limb come to, at least 0. */
static real share_of_limb(const bent *b, int at)
{
    real square = 0;
    for (int r = 0; r < b->rows; r++)
        if (b->of[r] == at) square += b->share[r] * b->share[r];
    return root(square);
}

/* The limb whose share is above 1, or no number, the most so, but for that one; -1: none. */
static int limb_let_go(const bent *b, int but)
{
    int worst = -1;
    real most = 1;
    for (int r = 0; r < b->rows; r++) {
        const real here = share_of_limb(b, b->of[r]);
        if (here <= most || b->of[r] == but) continue;
        most = here;
        worst = b->of[r];
    }
    return worst;
}

static inline vec turn_of(const bent *b, const real t[ACROSS])
{
    vec turn = mul(b->e[0], t[0]);
    return ACROSS > 1 ? add(turn, mul(b->e[ACROSS - 1], t[ACROSS - 1])) : turn;
}

/* ---- rolling there ---- */

/* A direction on its way to where the height is least nearby, edges and all: each roll goes as far as the first edge on
 * the way, or on along those that it is to lie on, till their shares let one go. */
typedef struct rolling {
    const bulk *of;
    vec n;
    bearing to[MOST_LIMBS]; /* how n stands to these, where it was looked at last */
    real sign[MOST_LIMBS];  /* as which they count: see bent */
    unsigned edges, slants; /* on which n is to lie */
    unsigned shut;          /* whose points it is to lie on no more */
    int left, held;         /* the limb just let go, and one that is not to be let go again; -1: none */
    int met;                /* the limb whose edge was met last */
    real most, last;        /* how far a roll leads at most, and the height before it */
    real missed;            /* so far was where edges meet before it */
} rolling;

static void start_rolling(rolling *s, const bulk *of, vec n)
{
    s->of = of;
    s->n = n;
    s->edges = s->slants = s->shut = 0;
    s->left = s->held = -1;
    s->met = -1;
    s->most = ROLL;
    s->last = s->missed = REAL_MAX;
    for (int i = 0; i < of->limbs; i++) s->sign[i] = dot(of->limb[i].row[0], n) < 0 ? -1 : 1;
}

/* Nothing counts yet but where the middle is. */
static inline void start_bend(const rolling *s, bent *b)
{
    b->n = s->n;
    put_across(s->n, b->e);
    b->height = dot(s->of->middle, s->n);
    for (int j = 0; j < ACROSS; j++) b->slope[j] = dot(s->of->middle, b->e[j]);
    b->bow = (quadric){{{0}}};
    b->slope_off = 32 * UNIT;
    b->bow_off = b->kink_off = b->height_off = b->sway = b->floor = 0;
    b->room = -1;
    b->level = 0;
    b->edges = s->edges;
    b->slants = s->slants;
    b->rows = 0;
}

/* How the height changes where n leads now. */
static void bend(rolling *s, bent *b)
{
    const bulk *of = s->of;
    const unsigned kept = s->left < 0 ? s->edges : s->edges | 1u << s->left; /* as which these count is known better */
    start_bend(s, b);
    for (int i = 0; i < of->limbs; i++) {
        const limb *l = &of->limb[i];
        s->to[i] = bearing_of(l, s->n);
        if (size(s->to[i].here) > l->vague && !(kept >> i & 1)) s->sign[i] = s->to[i].here < 0 ? -1 : 1;
        b->sign[i] = s->sign[i];
#if DIM == 3
        if (l->partial) add_cones(b, l, &s->to[i], i);
        else
#endif
            if (is_on_edge(b, i))
            add_edge(b, l, i);
        else if (l->rows == 1) add_straight(b, l, s->to[i].here, s->sign[i]);
        else add_whole(b, l, s->to[i].far);
    }
}

/* The first edge on the way. */
typedef struct meeting {
    int limb, slant; /* -1: none */
    real part;       /* of the turn that leads there */
} meeting;

/* What is so much here, and changes by so much on the way, counts as its sign says: where that would be wrong is an
 * edge. */
static inline void meet_edge(meeting *m, int at, int slant, real here, real way, real sign)
{
    if (!((here + way * m->part) * sign < 0)) return;
    m->part = larger(0, smaller(-here / way, m->part));
    m->limb = at;
    m->slant = slant;
}

/* Whether the turn leads toward where the round limb has no length, from not far away. */
static inline int leads_to_point(const limb *l, const bearing *v, vec turn)
{
    const real off = v->far * v->far;
    if (!(off <= l->size * l->size / 64)) return 0;
    const real to_x = dot(l->row[0], turn), to_y = dot(l->row[1], turn);
    return 4 * (to_x * to_x + to_y * to_y) >= off;
}

/* How much what the cone's limb counts for changes on the way. */
static inline real change_of_cone(const limb *l, const bearing *v, vec turn)
{
    const real x = dot(l->row[0], turn), y = dot(l->row[ACROSS - 1], turn);
    return (v->along.c[0] * x + v->along.c[ACROSS - 1] * y) / v->far + dot(l->lean, turn);
}

/* The limb to whose edge the turn leads first. */
static meeting limb_met(const rolling *s, const bent *b, vec turn)
{
    meeting m = {-1, 0, 1};
    for (int i = 0; i < s->of->limbs; i++) {
        const limb *l = &s->of->limb[i];
        const bearing *v = &s->to[i];
        if (is_on_edge(b, i)) continue;
        if (l->rows > 1 && !(s->shut >> i & 1) && b->rows + l->rows <= ACROSS && leads_to_point(l, v, turn) &&
            (!l->partial || v->here > v->far))
            return (meeting){i, 0, 0};
        if (b->rows == ACROSS) continue;
        if (l->rows == 1) meet_edge(&m, i, 0, v->here, dot(l->row[0], turn), b->sign[i]);
        if (l->partial) meet_edge(&m, i, 1, v->here, change_of_cone(l, v, turn), b->sign[i]);
    }
    return m;
}

/* What edges add. A cone's are bowed, and have a kink for what of that they give. */
static void add_kinks(const bulk *of, bent *b)
{
    b->kink = b->part = b->rim = (quadric){{{0}}};
    for (int r = 0; r < b->rows; r++) {
        const limb *l = &of->limb[b->of[r]];
        const real steep = 1 - share_of_limb(b, b->of[r]);
        for (int j = 0; j < ACROSS; j++) b->slope[j] += b->share[r] * b->d[r][j];
        if (is_on_slant(b, b->of[r])) {
            add_square(&b->rim, b->d[r], 4 * steep / l->steep);
            add_quadric(&b->part, &b->slant[r], steep / 2);
        } else add_square(&b->kink, b->d[r], 2 * steep / l->size);
    }
}

/* Where a round limb is let go, at whose point n is: a way beside that, on the side that its shares say. */
static vec beside_point(const bent *b, const limb *l)
{
    real t[ACROSS] = {0}, bow = 0;
    for (int r = 0; r < b->rows; r++)
        for (int j = 0; j < ACROSS; j++) t[j] += b->share[r] * b->d[r][j];
    const real far = length_across(t);
    for (int i = 0; i < ACROSS; i++)
        for (int j = 0; j <= i; j++) bow += (i == j ? 1 : 2) * b->bow.c[i][j] * (t[i] / far) * (t[j] / far);
    const real stiff = bow - b->height, off = (length_across(b->share) - 1) * l->size;
    const real by = stiff * (real)0.125 > off ? off / stiff : (real)0.125;
    for (int j = 0; j < ACROSS; j++) t[j] *= by / far;
    const vec n = add(b->n, turn_of(b, t));
    return mul(n, 1 / length(n));
}

/* By how much the height changes with the turn t, to the first order. */
static inline real change_along(const bent *b, const real t[ACROSS])
{
    real sum = 0;
    for (int j = 0; j < ACROSS; j++) sum += b->slope[j] * t[j];
    for (int r = 0; r < b->rows; r++)
        for (int j = 0; j < ACROSS; j++) sum += b->share[r] * b->d[r][j] * t[j];
    return sum;
}

/* Whether n is hardly off the edge that it is to lie on, if any. */
static inline int is_by_its_edge(const bent *b)
{
    const real l = b->rows ? length_across(b->d[0]) : 0;
    return b->rows == 0 || b->off[0] * b->off[0] <= 4 * UNIT * (l * l);
}

/* No more is to be had by the turn t, so far, than roundings are. */
static int is_at_rest(const bent *b, const real t[ACROSS], real far)
{
    if (b->rows < ACROSS && size(change_along(b, t)) <= 4 * UNIT * far) return is_by_its_edge(b);
    const real bent_by = far * b->sway; /* so much of the bow may have changed on the way, and with it the next turn */
    return far <= 16 * UNIT || (far * far <= 4 * UNIT && bent_by * bent_by <= 4096 * UNIT);
}

/* The edge whose share is too large for n to stay on it is left. 0: there is none. */
static int let_go(rolling *s, const bent *b)
{
    const int gone = limb_let_go(b, s->held);
    if (gone < 0) return 0;
    const limb *l = &s->of->limb[gone];
    s->sign[gone] = 1;
    if (l->rows > 1 && !is_on_slant(b, gone)) s->n = beside_point(b, l);
    else
        for (int r = 0; r < b->rows; r++)
            if (b->of[r] == gone) s->sign[gone] = b->share[r] < 0 ? -1 : 1;
    s->edges &= ~(1u << gone);
    s->slants &= ~(1u << gone);
    s->shut |= 1u << gone;
    s->left = gone;
    return 1;
}

enum rolled { ROLLS_ON, RESTS, STRAYS };

#if DIM == 3
/* A turn along the cones' edges on which n is to lie leaves these by what they bend: back to each, square to it. */
static inline void keep_to_slants(rolling *s)
{
    for (int i = 0; i < s->of->limbs && s->slants; i++) {
        if (!(s->slants >> i & 1)) continue;
        const limb *l = &s->of->limb[i];
        const bearing v = bearing_of(l, s->n);
        const vec way = add(l->lean, mul(add(mul(l->row[0], v.along.c[0]), mul(l->row[1], v.along.c[1])), 1 / v.far));
        s->n = sub(s->n, mul(way, v.here / dot(way, way)));
    }
}
#else
#define keep_to_slants(s) (void)0
#endif

/* Edges may seem to meet that do not, as a cone's is a curve: n is to come near where they do, or leaves the one met
 * last. 0: it comes near. */
static int miss_corner(rolling *s, const bent *b, real far)
{
    if (ACROSS < 2 || b->rows < ACROSS) {
        s->missed = REAL_MAX;
        return 0;
    }
    if (2 * far < s->missed || far * far <= 4 * UNIT) {
        s->missed = far;
        return 0;
    }
    s->edges &= ~(1u << s->met);
    s->slants &= ~(1u << s->met);
    return 1;
}

/* One roll, by the turn t. STRAYS: it has no end. */
static enum rolled roll_by(rolling *s, const bent *b, real t[ACROSS])
{
    const real far = length_across(t), share = far > s->most ? s->most / far : 1;
    if (!(far <= REAL_MAX)) return STRAYS;
    if ((b->rows < ACROSS || far * far <= 4 * UNIT) && let_go(s, b)) return ROLLS_ON;
    if (miss_corner(s, b, far)) return ROLLS_ON;
    for (int j = 0; j < ACROSS; j++) t[j] *= share;
    const vec turn = turn_of(b, t);
    const meeting m = limb_met(s, b, turn);
    if (m.limb >= 0) {
        s->edges |= 1u << m.limb;
        s->met = m.limb;
    }
    if (m.slant) s->slants |= 1u << m.limb;
    s->held = m.limb == s->left && m.part * far <= 64 * UNIT ? s->left : -1;
    s->left = -1;
    s->n = add(s->n, mul(turn, m.part));
    if (b->rows < ACROSS) keep_to_slants(s);
    s->n = mul(s->n, 1 / length(s->n));
    return m.limb < 0 && is_at_rest(b, t, far) ? RESTS : ROLLS_ON;
}

#if DIM == 3
/* Turns n back onto the cones' edges that it is to lie on, square to these. What b shares is then to be told anew. 0:
 * it is on them, to rounding. */
static int return_to_slant(rolling *s, bent *b)
{
    real t[ACROSS], off = 0;
    for (int r = 0; r < b->rows; r++)
        if (is_on_slant(b, b->of[r])) off = larger(size(b->off[r]), off);
    if (!(off > 2 * UNIT)) return 0;
    if (b->rows == ACROSS) {
        roll_to_corner(b, t);
    } else {
        const real square = b->d[0][0] * b->d[0][0] + b->d[0][1] * b->d[0][1];
        for (int j = 0; j < ACROSS; j++) t[j] = -b->off[0] * b->d[0][j] / square;
    }
    s->n = add(s->n, turn_of(b, t));
    s->n = mul(s->n, 1 / length(s->n));
    return 1;
}
#endif

/* The height is bowed as slants share now. 0: that is as before. */
static inline int take_shares(rolling *s, bent *b)
{
    int r = 0;
    for (int k = 0; k < b->rows; k++) {
        real *sign = &b->sign[b->of[k]], here = larger(-1, smaller(1, b->share[k]));
        if (!is_on_slant(b, b->of[k]) || here == *sign) continue;
        add_quadric(&b->bow, &b->slant[k], (here - *sign) / 2);
        s->sign[b->of[k]] = *sign = here;
        r = 1;
    }
    return r;
}

/* What there is where n has come to rest, its edges' shares and kinks with it. 0: they do not hold it. The last turn
 * led along what is a curve on a cone, and so off its edge by what that bends. */
static int come_to_rest(rolling *s, bent *b)
{
    real t[ACROSS];
    s->left = -1;
    bend(s, b);
#if DIM == 3
    for (int i = 0; i < 2 && return_to_slant(s, b); i++) bend(s, b);
#endif
    roll(b, s->most, t);
    take_shares(s, b);
    for (int r = 0; r < b->rows; r++) /* as the curvature has them */
        if (is_on_slant(b, b->of[r])) b->share[r] = b->sign[b->of[r]];
    add_kinks(s->of, b);
    return limb_let_go(b, -1) < 0;
}

/* The next turn. */
static inline void aim(rolling *s, bent *b, real t[ACROSS])
{
    s->most = b->height > s->last + 64 * UNIT ? s->most / 2 : smaller((real)1.125 * s->most, ROLL);
    s->last = b->height;
    roll(b, s->most, t);
    if (b->slants && take_shares(s, b)) roll(b, s->most, t);
}

/* So near to a way where heights are known to be the least nearby a direction is given up. */
#define CLOSE_BY ((real)0.9)

/* Turns n to where the height is least nearby. 0: it is not found, or leads to the one known, if any. */
static int find_least(const bulk *of, vec n, const vec *known, bent *b)
{
    rolling s;
    real t[ACROSS];
    start_rolling(&s, of, n);
    for (int i = 0; i < ROLLS && !(known && dot(s.n, *known) > CLOSE_BY); i++) {
        bend(&s, b);
        aim(&s, b, t);
        const enum rolled to = roll_by(&s, b, t);
        if (to != ROLLS_ON) return to == RESTS && come_to_rest(&s, b);
    }
    return 0;
}

/* What is known of round bodies from the first dip of their heights on. */
typedef struct first_dip {
    bulk bulk;
    bent at;
    int known, found; /* the bulk; and the dip */
} first_dip;

/* What the heights of A - B are made of. 0: it is not known. */
static int know_first_bulk(first_dip *f, const difference *d, const shape *a, const shape *b)
{
    if (ROUND && !f->known) f->known = know_bulk(&f->bulk, d, a, b);
    return ROUND && f->known;
}

static inline void forget_first_dip(first_dip *f) { f->known = f->found = 0; }

static inline void put_length(const limb *l, int k, real share, vertex *c)
{
    if (l->stick) {
        const vec way = mul(l->half, l->of_b ? -share : share);
        *(l->of_b ? &c->y : &c->x) = add(l->center, way);
    } else if (l->of_b) c->y.c[l->first + k] = -share * l->length[k];
    else c->x.c[l->first + k] = share * l->length[k];
}

#if DIM == 3
/* What the rows of a disc count for at whose point n is: as told; or, of several, as the one does of which that is. */
static void share_of_disc(const bulk *of, const bent *b, int at, real share[2])
{
    const limb *l = &of->limb[at], *told = &of->limb[b->of[0]];
    const vec p = mul(add(mul(told->row[0], b->share[0]), mul(told->row[1], b->share[1])), 2 / told->size);
    for (int r = 0; r < 2; r++) share[r] = b->of[0] == at ? b->share[r] : dot(l->row[r], p) / l->size;
}

/* The cone's point. */
static void put_on_cone(const bulk *of, const bent *b, int at, vertex *c)
{
    const limb *l = &of->limb[at];
    const int base = is_on_edge(b, at) && !is_on_slant(b, at);
    const real times = base ? 1 : (1 + b->sign[at]) / 2, x = dot(l->row[0], b->n), y = dot(l->row[1], b->n);
    const real square = x * x + y * y, per = square > REAL_MIN / UNIT ? times / root(square) : 0;
    real share[2] = {x * per, y * per};
    if (base) share_of_disc(of, b, at, share);
    const vec p = {{share[0] * l->length[0], share[1] * l->length[1], (1 - 2 * times) * l->length[2]}};
    if (l->of_b) c->y = (vec){{-p.c[0], -p.c[1], p.c[2]}};
    else c->x = p;
}
#endif

/* Of the straight limb that share, of what is joined to it the same. */
static void put_straight(const bulk *of, int at, real share, vertex *c)
{
    put_length(&of->limb[at], 0, share, c);
    for (int i = of->limbs; i < of->limbs + of->joined; i++)
        if (of->limb[i].mate == at) put_length(&of->limb[i], 0, of->limb[i].back ? -share : share, c);
}

#if DIM == 3
/* The same of a round limb, at whose edge n is: of what is joined to it as that is turned along its own axes. */
static void put_round(const bulk *of, int at, const real share[2], vertex *c)
{
    const limb *l = &of->limb[at];
    vec p = axis(0, 0);
    for (int k = 0; k < l->rows; k++) {
        put_length(l, k, share[k], c);
        p = add(p, mul(l->row[k], share[k] / l->size));
    }
    for (int i = of->limbs; i < of->limbs + of->joined; i++) {
        const limb *m = &of->limb[i];
        if (m->mate != at) continue;
        for (int k = 0; k < m->rows; k++) put_length(m, k, 2 * dot(m->row[k], p) / m->size, c);
    }
}
#endif

/* Of the bodies' points what straight limbs and edges make: as they count, not as rounding has it. */
static void share_out(const bulk *of, const bent *b, vertex *c)
{
    for (int i = 0; i < of->limbs; i++) {
        const limb *l = &of->limb[i];
        real share[ACROSS] = {b->sign[i]};
#if DIM == 3
        if (l->partial) put_on_cone(of, b, i, c);
        if (l->rows == 2 && !l->partial && is_on_edge(b, i)) {
            share_of_disc(of, b, i, share);
            put_round(of, i, share, c);
        }
#endif
        for (int r = 0; r < b->rows; r++)
            if (b->of[r] == i && is_on_edge(b, i)) share[0] = b->share[r];
        if (l->rows == 1) put_straight(of, i, share[0], c);
    }
}

#endif
