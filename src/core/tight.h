/* SPDX-License-Identifier: MIT */
/* The end of a search between hulls of known corners, without rounding: from the simplex that the search left, on
 * until no corner of either set lies nearer. Corners, normals, weights and the choice between equally far corners are
 * exact, so there is nothing to tolerate: each step brings the simplex nearer in truth, the last one is the answer, and
 * contact is exactly 0. Only the distance itself is rounded, once, at the end. */
#ifndef GJK_CORE_TIGHT_H
#define GJK_CORE_TIGHT_H

#include "outline.h"
#include "touch.h"

typedef struct finish {
    outline a, b;
    real off;                   /* so far these are off the bodies at most */
    vec x[DIM + 1], y[DIM + 1]; /* corners of the sets, each in its own coordinates */
    dyadics w[DIM + 1];         /* of the difference */
    int n;
    int lost;               /* a decision was asked of a number that is */
    dyadics way;            /* along the nearest point; 0 where that is the origin */
    dyadic weight[DIM + 1]; /* of the corners there, in proportion */
    dyadic over, under;     /* the distance: over / sqrt(under), or the root of that */
    int squared;
} finish;

/* All decisions pass here. */
static int side(finish *f, const dyadic *x)
{
    f->lost |= x->lost;
    return x->sign;
}

/* The way along a facet's normal, to the side where the facet lies as seen from the origin, and its distance. */
static void along_normal(finish *f, const dyadics *n, const dyadics *p)
{
    f->over = inner(n, p);
    f->under = inner(n, n);
    f->squared = 0;
    f->way = *n;
    int turn = side(f, &f->over);
    if (turn < 0) reverse(&f->way);
    if (turn == 0) f->way = no_way();
    f->over.sign = turn != 0;
}

/* ---- numbers of any magnitude ---- */

static twin root_of(twin a)
{
    real r = root(a.high);
    twin square = product_of(r, r);
    return sum_of(r, ((a.high - square.high) - square.low + a.low) / (2 * r));
}

static twin quotient_of(twin a, twin b)
{
    real q = a.high / b.high;
    twin back = product_of(q, b.high);
    return sum_of(q, ((a.high - back.high) - back.low + a.low - q * b.low) / b.high);
}

/* A twin and the power of two that goes with it: of any magnitude. */
typedef struct wide {
    twin t;
    int exponent;
} wide;

static wide wide_of(const dyadic *a)
{
    wide r;
    r.t = leading(a, &r.exponent);
    return r;
}

static wide wide_root(wide a)
{
    if (a.exponent & 1) a = (wide){{2 * a.t.high, 2 * a.t.low}, a.exponent - 1};
    return (wide){a.t.high > 0 ? root_of(a.t) : a.t, a.exponent / 2};
}

static wide wide_sum(wide a, wide b)
{
    if (a.t.high == 0) return b;
    if (b.t.high == 0) return a;
    int top = a.exponent > b.exponent ? a.exponent : b.exponent;
    twin t = {raised(a.t.high, a.exponent - top), raised(a.t.low, a.exponent - top)};
    gather(&t, (twin){raised(b.t.high, b.exponent - top), raised(b.t.low, b.exponent - top)});
    return (wide){sum_of(t.high, t.low), top};
}

static wide wide_quotient(wide a, wide b) { return (wide){quotient_of(a.t, b.t), a.exponent - b.exponent}; }

/* ---- the nearest point ---- */

static int between(finish *f, int i, int j)
{
    const dyadics *p = &f->w[i], *q = &f->w[j];
    dyadics e = difference_of(q, p);
    f->weight[i] = inner(q, &e);
    f->weight[j] = inner(p, &e);
    if (side(f, &f->weight[i]) <= 0 || side(f, &f->weight[j]) >= 0) return 0;
    f->weight[j].sign = 1;
#if DIM == 2
    dyadics n = quarter(&e);
    along_normal(f, &n, p);
#else
    dyadics n = outer(p, &e);
    f->over = inner(&n, &n);
    f->under = inner(&e, &e);
    f->squared = 1;
    for (int k = 0; k < DIM; k++) {
        dyadic s = times(&p->c[k], &f->under), t = times(&e.c[k], &f->weight[j]);
        f->way.c[k] = plus(&s, &t, 1);
    }
#endif
    return 1;
}

#if DIM == 3
static int within(finish *f, int i, int j, int k)
{
    const dyadics *p = &f->w[i];
    dyadics a = difference_of(&f->w[j], p), b = difference_of(&f->w[k], p), n = outer(&a, &b), t = outer(&b, p);
    f->weight[j] = inner(&n, &t);
    if (side(f, &f->weight[j]) <= 0) return 0;
    t = outer(p, &a);
    f->weight[k] = inner(&n, &t);
    if (side(f, &f->weight[k]) <= 0) return 0;
    along_normal(f, &n, p);
    f->weight[i] = plus(&f->under, &f->weight[j], -1);
    f->weight[i] = plus(&f->weight[i], &f->weight[k], -1);
    return side(f, &f->weight[i]) > 0;
}
#endif

/* Of the full simplex: square to the facet opposite corner i, on which p is. */
static dyadics square_to_facet(const finish *f, int i, const dyadics **p)
{
    *p = &f->w[(i + 1) % (DIM + 1)];
    const dyadics a = difference_of(&f->w[(i + 2) % (DIM + 1)], *p);
#if DIM == 2
    return quarter(&a);
#else
    const dyadics b = difference_of(&f->w[(i + 3) % (DIM + 1)], *p);
    return outer(&a, &b);
#endif
}

/* The full simplex: the origin is on the inner side of each facet, and how far from it is the weight of the corner
 * opposite. */
static int inside(finish *f)
{
    for (int i = 0; i <= DIM; i++) {
        const dyadics *p, n = square_to_facet(f, i, &p), b = difference_of(&f->w[i], p);
        dyadic whole = inner(&n, &b);
        f->weight[i] = inner(&n, p);
        int outward = side(f, &f->weight[i]);
        if (outward == 0 || side(f, &whole) != -outward) return 0;
        f->weight[i].sign = 1;
    }
    f->over = nought(0);
    f->under = dyadic_of(1);
    f->way = no_way();
    return 1;
}

/* Whether the origin projects into the interior of what the corners of the mask span. Sets weights, way and distance.
 */
static int carries(finish *f, unsigned mask)
{
    int k[DIM + 1], n = 0;
    for (int i = 0; i < f->n; i++)
        if (mask >> i & 1) k[n++] = i;
    if (n == 2) return between(f, k[0], k[1]);
#if DIM == 3
    if (n == 3) return within(f, k[0], k[1], k[2]);
#endif
    if (n > DIM) return inside(f);
    f->weight[k[0]] = f->under = dyadic_of(1);
    f->over = inner(&f->w[k[0]], &f->w[k[0]]);
    f->squared = 1;
    f->way = f->w[k[0]];
    return 1;
}

/* No corner is nearer along the way than those of the mask. */
static int foremost(finish *f, unsigned mask)
{
    int k = 0;
    while (!(mask >> k & 1)) k++;
    for (int i = 0; i < f->n; i++) {
        if (mask >> i & 1) continue;
        dyadics e = difference_of(&f->w[i], &f->w[k]);
        dyadic rise = inner(&e, &f->way);
        if (side(f, &rise) < 0) return 0;
    }
    return 1;
}

/* Keeps the corners that carry the nearest point: those in whose span it is interior, and which no other corner is
 * nearer than. There are such, of any corners whatsoever: if it is a combination of some, then of few that are not
 * degenerate (Caratheodory). 0: numbers are lost. */
static int shrink(finish *f)
{
    unsigned mask = (1u << f->n) - 1;
    while (mask > 0 && !(carries(f, mask) && foremost(f, mask))) mask--;
    int n = 0;
    for (int i = 0; i < f->n; i++) {
        if (!(mask >> i & 1)) continue;
        f->w[n] = f->w[i];
        f->x[n] = f->x[i];
        f->y[n] = f->y[i];
        f->weight[n++] = f->weight[i];
    }
    f->n = n;
    side(f, &f->over);
    side(f, &f->under);
    return !f->lost && mask > 0;
}

/* ---- the farthest corner ---- */

/* From x to the corner of the set that lies farthest along the way, if any lies farther; and how much farther, with the
 * way's length as unit. Rounded heights tell which corners can be the farthest; among these numbers are exact. */
static dyadic climb(finish *f, const outline *o, const dyadics *way, vec *x)
{
    dyadics g = pulled(o, way);
    dyadic gain = nought(0);
    int moved = 0;
    for (int i = 0; i < DIM; i++) moved |= side(f, &g.c[i]) != 0;
    if (!moved || f->lost) return gain;
    vec d = rough(&g), from = point_in(o, *x);
    size_t n = count_corners(o->s);
    real top = -REAL_MAX, far = 0;
    for (size_t i = 0; i < n; i++) {
        vec p = point_in(o, nth_corner(o->s, i));
        top = larger(dot(p, d), top);
        far = larger(peak(p), far);
    }
    top -= 16 * UNIT * (spread(d) * far) + 8 * TINY; /* d is off by a rounding, each height by DIM */
    for (size_t i = 0; i < n; i++) {
        const vec corner = nth_corner(o->s, i), p = point_in(o, corner);
        if (dot(p, d) < top || same(p, from)) continue;
        dyadic rise = nought(0);
        for (int j = 0; j < DIM; j++) {
            if (p.c[j] == from.c[j]) continue;
            dyadic to = dyadic_of(p.c[j]), at = dyadic_of(from.c[j]), e = plus(&to, &at, -1);
            e = times(&e, &g.c[j]);
            rise = plus(&rise, &e, 1);
        }
        dyadic more = plus(&rise, &gain, -1);
        if (side(f, &more) <= 0) continue;
        gain = rise;
        *x = corner;
    }
    return gain;
}

/* ---- the search ---- */

static void take_in(finish *f, vec x, vec y)
{
    f->x[f->n] = x;
    f->y[f->n] = y;
    f->w[f->n++] = corner_without_rounding(&f->a, &f->b, x, y);
}

/* The simplex of q as it is holds the origin. */
static APART void stay(finish *f, const search *q, const real weight[DIM + 1])
{
    f->n = q->s.n;
    for (int i = 0; i < f->n; i++) {
        f->x[i] = corner(&q->s, i)->x;
        f->y[i] = corner(&q->s, i)->y;
        f->weight[i] = dyadic_of(weight[i]);
    }
    f->over = nought(0);
    f->under = dyadic_of(1);
    f->squared = 0;
    f->way = no_way();
}

/* Between the bodies themselves, and nothing is known yet. */
static void start_finish(finish *f, const shape *a, const shape *b)
{
    f->a = outline_of(a);
    f->b = outline_of(b);
    f->off = 0;
    f->n = f->lost = f->squared = 0;
}

/* Leaves out what is faint in a frame of that size. 0: that has been left out, or there is nothing. */
static int leave_out(outline *a, outline *b, real frame, real *off)
{
    if (*off > 0) return 0;
    *off = leave_out_faint(a, frame) + leave_out_faint(b, frame);
    return *off > 0;
}

/* From the simplex of q on, until no corner is nearer. */
static APART enum end climb_down(finish *f, search *q, int max_steps)
{
    f->n = f->lost = 0;
    for (int i = 0; i < q->s.n; i++) take_in(f, corner(&q->s, i)->x, corner(&q->s, i)->y);
    while (shrink(f)) {
        vec x = f->x[0], y = f->y[0];
        dyadics back = f->way;
        reverse(&back);
        dyadic up = climb(f, &f->b, &f->way, &y), down = climb(f, &f->a, &back, &x), gain = plus(&up, &down, 1);
        if (side(f, &gain) <= 0) break;
        if (q->steps >= max_steps) return f->lost ? FAULT : OPEN;
        q->steps++;
        q->d.calls += 2;
        take_in(f, x, y);
    }
    return f->lost ? FAULT : STILL;
}

/* A ball of that radius around the origin is in the full simplex. */
static APART int holds_ball(const finish *f, real radius)
{
    int r = f->n > DIM;
    for (int i = 0; i <= DIM && r; i++) {
        const dyadics *p, n = square_to_facet(f, i, &p);
        const dyadic over = inner(&n, p), under = inner(&n, &n);
        const wide h = wide_quotient(wide_of(&over), wide_root(wide_of(&under)));
        r = raised(h.t.high, h.exponent) > 2 * radius;
    }
    return r;
}

/* The same without what is faint. FAULT: nothing is, or numbers were lost again. */
static enum end climb_down_roughly(finish *f, search *q, int max_steps)
{
    if (!leave_out(&f->a, &f->b, q->d.unscale, &f->off)) return FAULT;
    const enum end end = climb_down(f, q, max_steps);
    if (end == STILL && holds_ball(f, f->off)) f->off = 0; /* as that these meet is true of the bodies */
    return end;
}

/* From the simplex of q, to the end: STILL, and f's simplex is the nearest of all; OPEN: max_steps are used up; FAULT:
 * numbers were lost. */
static enum end conclude(finish *f, search *q, const shape *a, const shape *b, int max_steps)
{
    real weight[DIM + 1];
    start_finish(f, a, b);
    if (q->s.n == 0) return FAULT; /* there is nothing to start from */
    if (holds_origin(q, a, b, weight)) {
        stay(f, q, weight);
        return STILL;
    }
    const enum end end = climb_down(f, q, max_steps);
    return end == FAULT ? climb_down_roughly(f, q, max_steps) : end;
}

/* ---- the answer ---- */

/* The cores' distance, good to 32 UNIT^2 of itself. */
static wide core_distance(const finish *f)
{
    wide over = wide_of(&f->over), under = wide_of(&f->under);
    return f->squared ? wide_root(wide_quotient(over, under)) : wide_quotient(over, wide_root(under));
}

/* A length, its sign apart; by how much of itself it may be off, and by how much besides. */
typedef struct estimate {
    wide size;
    int sign;
    real off, more;
} estimate;

/* What formulas of a few operations on twins are good to. */
#define FORMULA_OFF (128 * UNIT * UNIT)

/* d - r, each good to 32 UNIT^2 of itself; of numbers near each other it tells little. */
static estimate difference_in_twins(wide d, wide r)
{
    wide sum = wide_sum(d, r), gap = wide_sum(d, (wide){{-r.t.high, -r.t.low}, r.exponent});
    estimate e = {gap, gap.t.high < 0 ? -1 : 1, REAL_MAX, 0};
    real whole = raised(sum.t.high, sum.exponent - gap.exponent);
    if (e.sign < 0) e.size.t = (twin){-gap.t.high, -gap.t.low};
    if (e.size.t.high > 0) e.off = FORMULA_OFF * (whole / e.size.t.high);
    return e;
}

/* d^2 - r^2 without rounding, over f->under. */
static dyadic squares_between(const finish *f, const dyadic *r)
{
    dyadic over = f->squared ? f->over : times(&f->over, &f->over), rr = times(r, r);
    rr = times(&rr, &f->under);
    return plus(&over, &rr, -1);
}

static dyadic sum_of_radii(real radius_a, real radius_b)
{
    dyadic a = dyadic_of(radius_a), b = dyadic_of(radius_b);
    return plus(&a, &b, 1);
}

/* The distance less the radii, d - r, by (d^2 - r^2) / (d + r), where the difference is without rounding; where that
 * has too many digits, in twins. */
static estimate separation(const finish *f, real radius_a, real radius_b)
{
    dyadic r = sum_of_radii(radius_a, radius_b);
    wide d = core_distance(f);
    if (r.sign == 0) return (estimate){d, f->over.sign, FORMULA_OFF, 0};
    dyadic squares = squares_between(f, &r);
    if (squares.lost) return difference_in_twins(d, wide_of(&r));
    wide under = wide_of(&f->under), sum = wide_sum(d, wide_of(&r));
    under = (wide){product_of_twins(under.t, sum.t), under.exponent + sum.exponent};
    return (estimate){wide_quotient(wide_of(&squares), under), squares.sign, FORMULA_OFF, 0};
}

/* Its bracket, each end the nearest number its way, or the one next to that; the value between. 0: it is not known to
 * all digits, or too large to be told. */
static int round_off(estimate e, real ends[3])
{
    wide s = e.size;
    if (!(e.off <= UNIT / 4)) return 0;
    real error = e.off * s.t.high + raised(e.more, -s.exponent);
    if (error > s.t.high / UNIT) { /* it is as good as none then */
        s = (wide){{0, 0}, 0};
        error = 2 * e.more;
    }
    real low = below(s.t.high, s.t.low - error, s.exponent), high = -below(-s.t.high, -s.t.low - error, s.exponent);
    ends[0] = e.sign < 0 ? -high : low;
    ends[1] = raised(s.t.high, s.exponent) * (real)e.sign;
    ends[2] = e.sign < 0 ? -low : high;
    return bounded(ends[0]) && bounded(ends[2]);
}

/* Whether the distance less the radii is the least number, or more. */
static int is_a_number(const finish *f, real radius_a, real radius_b)
{
    dyadic r = sum_of_radii(radius_a, radius_b), least = dyadic_of(TINY);
    r = plus(&r, &least, 1);
    dyadic squares = squares_between(f, &r);
    return !squares.lost && squares.sign >= 0;
}

/* The bracket of the distance less the radii. 0: that is not to be told. */
static APART int enclose(const finish *f, real radius_a, real radius_b, real ends[3])
{
    estimate e = separation(f, radius_a, radius_b);
    e.more = f->off;
    if (!round_off(e, ends)) return 0;
    if (ends[0] == 0 && ends[2] > 0 && f->off == 0 && is_a_number(f, radius_a, radius_b)) ends[0] = TINY;
    return 1;
}

/* What f found, as the search's own: the simplex, its weights, the normal. */
static void hand_back(const finish *f, search *q, real weight[DIM + 1])
{
    int e[DIM + 1], top = 0;
    vec v = rough(&f->way);
    clear(&q->s);
    q->pending = 0;
    q->borrowed = 0;
    for (int i = 0; i < f->n; i++) {
        vertex *p = spare(&q->s);
        p->x = f->x[i];
        p->y = f->y[i];
        p->w = corner_of(&q->d, p->x, p->y);
        q->s.n++;
        weight[i] = leading(&f->weight[i], &e[i]).high;
        if (i == 0 || e[i] > top) top = e[i];
    }
    for (int i = 0; i < f->n; i++) weight[i] = raised(weight[i], e[i] - top);
    normalize(weight, f->n);
    if (peak(v) > 0) q->normal = mul(v, -1 / length(v));
}

#endif
