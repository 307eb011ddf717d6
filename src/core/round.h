/* SPDX-License-Identifier: MIT */
/* Round sets near the way out. The height of an ellipsoid, a cylinder or a box along n is a sum of lengths |L n|, whose
 * slopes and curvatures are known; so where it is least nearby is found in a few steps, and how high it is at least
 * around there is proven by curvature (docs/bounds.md), which corners prove but slowly. */
#ifndef GJK_CORE_ROUND_H
#define GJK_CORE_ROUND_H

#include "minkowski.h"

/* Directions across a normal. */
#define ACROSS (DIM - 1)

#define MOST_LIMBS (2 * DIM)

/* Adds |L n| to the height along n. It is straight, of one row, or round. */
typedef struct limb {
    vec row[DIM]; /* of L */
    int rows;
    real size;        /* bounds |L| */
    int of_b, first;  /* the body's axes that it is made of, from that on */
    real length[DIM]; /* along these, in the body's own unit */
} limb;

/* What the heights of A - B are made of, in the frame: middle.n, and its limbs'. */
typedef struct bulk {
    limb limb[MOST_LIMBS];
    int limbs;
    vec middle;
} bulk;

/* ---- what ready-made sets are made of ---- */

/* The body's axes from the first on, so many, each as long as it says. Of no length they add nothing. */
static void add_limb(bulk *b, const body *k, int of_b, int first, int rows, const real *lengths)
{
    limb *l = &b->limb[b->limbs];
    real square = 0;
    l->of_b = of_b;
    l->first = first;
    for (int r = 0; r < rows; r++) {
        const int at = first + r;
        vec u = axis(at, 1);
        for (int i = 0; i < DIM && k->posed; i++) u.c[i] = k->m[DIM * i + at];
        l->length[r] = lengths[r] * k->unit;
        l->row[r] = mul(u, l->length[r] * k->grain);
        square += dot(l->row[r], l->row[r]);
    }
    l->rows = rows;
    l->size = root(square) * (1 + 16 * UNIT);
    b->limbs += l->size > 0;
}

/* 0: it is not known what the set's heights are made of. */
static int add_body(bulk *b, const body *k, int of_b, const shape *s)
{
    const real *sizes = s->data;
    if (s->support == pub(support_ellipsoid)) {
        add_limb(b, k, of_b, 0, DIM, sizes);
        return 1;
    }
    if (s->support == pub(support_box)) {
        for (int i = 0; i < DIM; i++) add_limb(b, k, of_b, i, 1, sizes + i);
        return 1;
    }
    if (s->support == pub(support_ball)) {
        const real radii[3] = {sizes[0], sizes[0], sizes[0]};
        add_limb(b, k, of_b, 0, DIM, radii);
        return 1;
    }
#if DIM == 3
    if (s->support == pub(support_cylinder) || s->support == pub(support_disc)) {
        const real radii[2] = {sizes[0], sizes[0]};
        add_limb(b, k, of_b, 0, 2, radii);
        if (s->support == pub(support_cylinder)) add_limb(b, k, of_b, 2, 1, sizes + 1);
        return 1;
    }
#endif
    return s->support == pub(support_origin);
}

static int know_bulk(bulk *b, const difference *d, const shape *s, const shape *t)
{
    b->limbs = 0;
    b->middle = mul(d->c, -1);
    return add_body(b, &d->a, 0, s) && add_body(b, &d->b, 1, t);
}

/* ---- slope and curvature ---- */

/* A symmetric form of directions across. */
typedef struct quadric {
    real c[ACROSS][ACROSS]; /* at and below the diagonal */
} quadric;

/* The height along n, and how it changes as n is turned across: of n + t with t across n, it is height + slope.t +
 * t.bow t / 2 to the second order. n may lie on edges of the height, where limbs have no length: they count as their
 * shares say, each within 1, and above that the height rises as the quadric kink has it. */
typedef struct bent {
    vec n, e[ACROSS]; /* unit and square to one another, to rounding */
    real height, slope[ACROSS];
    quadric bow, kink;
    real slope_off, bow_off, kink_off, height_off; /* by so much these may be off */
    real sway;              /* farther off, by t, the bow may be less, by the factor 1 + sway |t| */
    unsigned edges;         /* the limbs on whose edges n is to lie: */
    int rows;               /*   so many rows in all, */
    int of[ACROSS];         /*   of these limbs, */
    real d[ACROSS][ACROSS]; /*   across, */
    real off[ACROSS];       /*   and how far n is from there; */
    real share[ACROSS];     /*   what the rows count for */
    real sign[MOST_LIMBS];  /* as which other straight limbs count */
} bent;

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

static inline void add_square(quadric *f, const real d[ACROSS], real k)
{
    for (int i = 0; i < ACROSS; i++)
        for (int j = 0; j <= i; j++) f->c[i][j] += k * d[i] * d[j];
}

/* A straight limb is no more than its slope; where its sign is not certain, or not that, n is off it. */
static void add_straight(bent *b, const limb *l, real sign)
{
    const real here = sign * dot(l->row[0], b->n), slop = 8 * UNIT * l->size;
    b->height += here;
    if (!(here > slop)) b->height_off += 2 * (size(here) + slop);
    for (int j = 0; j < ACROSS; j++) b->slope[j] += sign * dot(l->row[0], b->e[j]);
}

static void add_round(bent *b, const limb *l)
{
    const int rows = l->rows < DIM ? l->rows : DIM; /* never more; a compiler does not know */
    real a[DIM] = {0}, d[DIM][ACROSS] = {{0}}, along[ACROSS], square = 0;
    for (int r = 0; r < rows; r++) {
        a[r] = dot(l->row[r], b->n);
        square += a[r] * a[r];
        for (int j = 0; j < ACROSS; j++) d[r][j] = dot(l->row[r], b->e[j]);
    }
    const real far = root(square), share = l->size / far;
    b->height += far;
    for (int j = 0; j < ACROSS; j++) {
        along[j] = 0;
        for (int r = 0; r < rows; r++) along[j] += a[r] / far * d[r][j];
        b->slope[j] += along[j];
    }
    for (int r = 0; r < rows; r++) {
        for (int j = 0; j < ACROSS; j++) d[r][j] -= a[r] / far * along[j];
        add_square(&b->bow, d[r], 1 / far);
    }
    b->slope_off += 32 * UNIT * share * l->size;
    b->bow_off += 512 * UNIT * share * share * l->size;
    b->sway = larger(share, b->sway);
}

/* n is to lie on its edge. */
static void add_edge(bent *b, const limb *l, int at)
{
    for (int r = 0; r < l->rows; r++, b->rows++) {
        b->of[b->rows] = at;
        b->off[b->rows] = dot(l->row[r], b->n);
        for (int j = 0; j < ACROSS; j++) b->d[b->rows][j] = dot(l->row[r], b->e[j]);
        b->height_off += 2 * (size(b->off[b->rows]) + 8 * UNIT * l->size);
    }
    b->slope_off += 32 * UNIT * l->size;
    b->kink_off += 128 * UNIT * l->size;
}

/* sign: of the straight limbs. */
static void bent_at(const bulk *of, vec n, unsigned edges, const real sign[MOST_LIMBS], bent *b)
{
    *b = (bent){.n = n, .edges = edges, .height = dot(of->middle, n), .slope_off = 32 * UNIT};
    memcpy(b->sign, sign, sizeof b->sign);
    put_across(n, b->e);
    for (int j = 0; j < ACROSS; j++) b->slope[j] = dot(of->middle, b->e[j]);
    for (int i = 0; i < of->limbs; i++) {
        const limb *l = &of->limb[i];
        if (edges >> i & 1) add_edge(b, l, i);
        else if (l->rows == 1) add_straight(b, l, sign[i]);
        else add_round(b, l);
    }
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
#define ROLLS 16
#define ROLL ((real)0.5)

/* One way across: down, to where there would be no slope if it is bowed. */
static inline real roll_along(real slope, real bow, real height)
{
    real k = bow > height ? bow - height : bow;
    return size(slope) < ROLL * k ? -slope / k : slope > 0 ? -ROLL : ROLL;
}

#if DIM == 2
static void roll(bent *b, real t[1])
{
    t[0] = b->rows ? -b->off[0] / b->d[0][0] : roll_along(b->slope[0], b->bow.c[0][0], b->height);
    if (b->rows) b->share[0] = -b->slope[0] / b->d[0][0];
}
#else
/* n is to stay on one edge. */
static void roll_on_edge(bent *b, real t[2])
{
    const real *d = b->d[0], l = length_across(d), along[2] = {d[0] / l, d[1] / l}, across[2] = {-along[1], along[0]};
    const quadric *f = &b->bow;
    const real mixed = across[0] * (f->c[0][0] * along[0] + f->c[1][0] * along[1]) +
                       across[1] * (f->c[1][0] * along[0] + f->c[1][1] * along[1]);
    const real bow = across[0] * across[0] * f->c[0][0] + 2 * across[0] * across[1] * f->c[1][0] +
                     across[1] * across[1] * f->c[1][1];
    const real back = -b->off[0] / l, slope = b->slope[0] * across[0] + b->slope[1] * across[1] + mixed * back;
    const real on = roll_along(slope, bow, b->height);
    for (int j = 0; j < 2; j++) t[j] = back * along[j] + on * across[j];
    b->share[0] = -(b->slope[0] * along[0] + b->slope[1] * along[1] + mixed * on) / l;
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
static void roll(bent *b, real t[2])
{
    if (b->rows == 2) {
        roll_to_corner(b, t);
        return;
    }
    if (b->rows == 1) {
        roll_on_edge(b, t);
        return;
    }
    const real level = least_value(&b->bow) > b->height ? b->height : 0;
    const real p = b->bow.c[0][0] - level, q = b->bow.c[1][1] - level, r = b->bow.c[1][0], whole = p * q - r * r;
    t[0] = (r * b->slope[1] - q * b->slope[0]) / whole;
    t[1] = (r * b->slope[0] - p * b->slope[1]) / whole;
    if (whole > (real)0x1p-12 * (p * p + q * q) && level >= 0) return;
    const real steep = length_across(b->slope), k = larger(p, larger(q, steep / ROLL));
    for (int j = 0; j < 2; j++) t[j] = -b->slope[j] / k;
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

/* The limb whose share is above 1, the most so; -1: none. */
static int limb_let_go(const bent *b)
{
    int worst = -1;
    real most = 1;
    for (int r = 0; r < b->rows; r++) {
        const real here = share_of_limb(b, b->of[r]);
        if (!(here > most)) continue;
        most = here;
        worst = b->of[r];
    }
    return worst;
}

/* The limb to whose edge the turn t leads first, and how much of the turn that takes; -1: none. */
static int limb_met(const bulk *of, const bent *b, const real sign[MOST_LIMBS], unsigned shut, const real t[ACROSS],
                    real *part)
{
    int met = -1;
    vec turn = mul(b->e[0], t[0]);
    if (ACROSS > 1) turn = add(turn, mul(b->e[ACROSS - 1], t[ACROSS - 1]));
    *part = 1;
    for (int i = 0; i < of->limbs; i++) {
        const limb *l = &of->limb[i];
        if ((b->edges >> i & 1) || b->rows + l->rows > ACROSS) continue;
        const real here = dot(l->row[0], b->n), way = dot(l->row[0], turn);
        if (l->rows > 1) {
            const real beside = dot(l->row[1], b->n);
            if ((shut >> i & 1) || here * here + beside * beside > l->size * l->size / 64) continue;
            *part = 0;
            return i;
        }
        if (!((here + way * *part) * sign[i] < 0)) continue;
        *part = larger(0, smaller(-here / way, *part));
        met = i;
    }
    return met;
}

/* What edges add. */
static void add_kinks(const bulk *of, bent *b)
{
    for (int r = 0; r < b->rows; r++) {
        const limb *l = &of->limb[b->of[r]];
        for (int j = 0; j < ACROSS; j++) b->slope[j] += b->share[r] * b->d[r][j];
        add_square(&b->kink, b->d[r], 2 * (1 - share_of_limb(b, b->of[r])) / l->size);
    }
}

/* The signs of straight limbs, but for those whose edge n is on. */
static void tell_signs(const bulk *of, vec n, real sign[MOST_LIMBS])
{
    for (int i = 0; i < of->limbs; i++) {
        const real here = dot(of->limb[i].row[0], n);
        if (size(here) > 64 * UNIT * of->limb[i].size) sign[i] = here < 0 ? -1 : 1;
    }
}

/* Turns n to where the height is least nearby. 0: it is not found. */
static int find_least(const bulk *of, vec n, bent *b)
{
    real sign[MOST_LIMBS] = {0}, part;
    unsigned edges = 0, shut = 0;
    for (int i = 0; i < of->limbs; i++) sign[i] = dot(of->limb[i].row[0], n) < 0 ? -1 : 1;
    for (int i = 0; i < ROLLS; i++) {
        real t[ACROSS];
        tell_signs(of, n, sign);
        bent_at(of, n, edges, sign, b);
        roll(b, t);
        const real far = length_across(t), share = far > ROLL ? ROLL / far : 1;
        const int gone = limb_let_go(b);
        if (!(far <= REAL_MAX)) return 0;
        if (gone >= 0) {
            for (int r = 0; r < b->rows; r++)
                if (b->of[r] == gone) sign[gone] = b->share[r] < 0 ? -1 : 1;
            edges &= ~(1u << gone);
            shut |= 1u << gone;
            continue;
        }
        for (int j = 0; j < ACROSS; j++) t[j] *= share;
        const int met = limb_met(of, b, sign, shut, t, &part);
        if (met >= 0) edges |= 1u << met;
        for (int j = 0; j < ACROSS; j++) n = add(n, mul(b->e[j], part * t[j]));
        n = mul(n, 1 / length(n));
        if (met >= 0 || far * far > 4 * UNIT) continue;
        bent_at(of, n, edges, sign, b);
        roll(b, t);
        add_kinks(of, b);
        return limb_let_go(b) < 0;
    }
    return 0;
}

/* ---- its proof ---- */

/* Where the height of A - B is least nearby: along n. Around there it is proven by curvature, not by facets. In their
 * place a polytope takes in a tip that is no corner, but stands out of A - B: `at`, along n. It is of account only to
 * ways along which it is higher than what is to be proven, and these are near n. */
typedef struct dip {
    vec n, at;
    vertex corner;          /* along n, */
    real below;             /* and the bound from below that it gave */
    real height;            /* of A - B along n, at least */
    quadric bow, kink;      /* see bent, */
    real bow_off, kink_off; /*   off by no more; */
    real slope, sway;       /*   at most */
    real floor;             /* no way out that is near n, as far as `at` is of account, is shorter */
    int planted;            /* `at` is in the polytope, */
    int frayed;             /*   and facets around it have been dropped */
} dip;

/* How far from n, as a tangent, ways lead along which the tip is higher than r. */
static real reach_of_tip(const dip *f, real r)
{
    const real share = length(f->at) * (1 + 8 * UNIT) / r;
    return root(larger(share * share - 1, 0) + 32 * UNIT) * (1 + 32 * UNIT);
}

/* How much the height is bowed, kinks and all, as seen from that far at least. */
static real bow_within(const dip *f, real far)
{
    quadric sum;
    const real k = 1 / (1 + f->sway * far), l = 1 / far;
    for (int i = 0; i < ACROSS; i++)
        for (int j = 0; j <= i; j++) sum.c[i][j] = k * f->bow.c[i][j] + l * f->kink.c[i][j];
    return least_value(&sum) - f->bow_off - l * f->kink_off -
           32 * UNIT * (size(sum.c[0][0]) + size(sum.c[ACROSS - 1][ACROSS - 1]));
}

/* Along ways that lead no farther from n A - B is at least as high as this, if it is to be as high as r. */
static real floor_near(const dip *f, real far, real r)
{
    const real bow = bow_within(f, far) - r * (1 + 8 * UNIT);
    if (!(bow > UNIT && far < 8)) return -REAL_MAX;
    return f->height - 8 * UNIT * r - f->slope * f->slope / bow;
}

#define NEAREST ((real)0x1p-12)

/* Takes what is known of the height along n. 0: nothing is proven by it. */
static int set_tip(dip *f)
{
    const real spare = smaller(f->height, bow_within(f, NEAREST) - f->height) / 4;
    real far = 1;
    f->planted = f->frayed = 0;
    if (!(spare > 0)) return 0;
    while (far > NEAREST && !(bow_within(f, far) >= f->height + spare)) far *= (real)0.75;
    f->floor = floor_near(f, far, f->height);
    f->at = mul(f->n, f->floor * root(1 + (real)0.9375 * far * far));
    return f->floor > 0;
}

static inline void put_length(const limb *l, int k, real share, vertex *c)
{
    if (l->of_b) c->y.c[l->first + k] = -share * l->length[k];
    else c->x.c[l->first + k] = share * l->length[k];
}

/* Of the bodies' points what straight limbs and edges make: as they count, not as rounding has it. */
static void share_out(const bulk *of, const bent *b, vertex *c)
{
    for (int i = 0; i < of->limbs; i++) {
        const limb *l = &of->limb[i];
        int k = 0;
        if (!(b->edges >> i & 1) && l->rows == 1) put_length(l, 0, b->sign[i], c);
        for (int r = 0; r < b->rows; r++)
            if (b->of[r] == i) put_length(l, k++, b->share[r], c);
    }
}

#endif
