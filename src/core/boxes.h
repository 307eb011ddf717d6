/* SPDX-License-Identifier: MIT */
/* Two boxes: how deep. The depth is the least height of the facets of their difference over the origin. What of this is
 * told, and why it is proven, is derived in docs/bounds.md. */
#ifndef GJK_CORE_BOXES_H
#define GJK_CORE_BOXES_H

#include "contact.h"
#include "walls.h"

#define MOST_WALLS 6 /* so many facets may be as low as any */

/* ---- all facets that may be the lowest ---- */

typedef struct lows {
    wall of[MOST_WALLS];
    unsigned along[MOST_WALLS]; /* their axes, once more: what is asked of all */
    int n;
} lows;

/* Whether the facet across that pair of axes, if there is one, is one of those: its axes lie along that, and are far
 * from parallel. */
static inline int is_found(const lows *f, const pair_of_axes *p, int i, int j)
{
    for (int k = 0; k < f->n; k++)
        if ((f->along[k] >> i & 1) && (f->along[k] >> j & 1)) return p->ll * 64 > p->size * p->size;
    return 0;
}

static int add_wall(lows *f, const zonotope *z, const pair_of_axes p[PAIRS_OF_AXES], int at)
{
    if (f->n == MOST_WALLS) return 0;
    see_wall(z, p, at, &f->of[f->n]);
    f->along[f->n] = f->of[f->n].along;
    f->n++;
    return 1;
}

#if DIM == 3
/* Two axes, one of each box, that are as good as parallel, by their difference: it has all its digits where they are of
 * one length. 0: they are parallel, and there is no facet across them. */
static int cross_parallel(const zonotope *z, int first, int second, pair_of_axes *p)
{
    const vec u = z->u[first], v = z->u[second], d = unit_size(dot(u, v) < 0 ? add(v, u) : sub(v, u));
    real skew = 0;
    EACH(skew += size(u.c[i] * v.c[(i + 1) % 3]) + size(u.c[(i + 1) % 3] * v.c[i]));
    if (!(peak(d) > 0) || !(skew > 0)) return 0;
    p->l = cross(u, d);
    p->ll = dot(p->l, p->l);
    p->size = root(z->uu[first] * dot(d, d));
    p->height = -size(dot(p->l, z->c));
    for (int k = 0; k < AXES; k++)
        if (k != first && k != second) p->height += z->e[k] * size(dot(p->l, z->u[k]));
    return 1;
}
#endif

/* The facets that may be the lowest, the first of them the one that looks so. 0: that is not certain, or the boxes are
 * apart. */
static int find_lows(const zonotope *z, lows *f)
{
    pair_of_axes p[PAIRS_OF_AXES];
    if (!find_pairs(z, p)) return 0;
    const int best = lowest_pair(p);
    f->n = 0;
    if (!is_steady(&p[best])) return 0;
    add_wall(f, z, p, best);
    const real height = larger(f->of[0].height.high, 0);
    for (int k = 0; k < PAIRS_OF_AXES; k++) {
        if (is_above(z, &p[k], height) || is_found(f, &p[k], first_of[k], second_of[k])) continue;
        if (!is_steady(&p[k])) {
#if DIM == 3
            if (k < 2 * DIM) return 0;
            if (!cross_parallel(z, first_of[k], second_of[k], &p[k]) || is_above(z, &p[k], height)) continue;
            if (!is_steady(&p[k])) return 0;
#else
            return 0;
#endif
        }
        if (!add_wall(f, z, p, k)) return 0;
    }
    return 1;
}

/* ---- telling ---- */

/* The face's height without any rounding, where its normal is an axis of the frame and nothing else is off it. */
static int level_height(const zonotope *z, const difference *d, const shape *a, const shape *b, const wall *f, span *h)
{
    int at = -1, whole = 1, thick = 0;
    for (int i = 0; i < DIM; i++) {
        if (f->n.c[i] == 0) continue;
        if (at >= 0) return 0;
        at = i;
    }
    if (!is_way_whole(d, a, b)) return 0;
    const real sign = f->n.c[at] < 0 ? 1 : -1;
    *h = (span){sign * d->c.c[at], sign * d->c_low.c[at], 0};
    for (int k = 0; k < AXES; k++) {
        const shape *s = k < DIM ? a : b;
        const real u = z->u[k].c[at], half = ((const box *)s->data)->half[k % DIM];
        if (f->along >> k & 1 ? u != 0 : u == 0) return 0;
        whole &= !s->pose || is_whole(s->pose->m[DIM * at + k % DIM], u);
        if (u == 0) continue;
        whole &= is_whole(half, half * (k < DIM ? d->a.grain : d->b.grain)) && is_whole(half, z->e[k]);
        thick |= z->e[k] > 0;
        *h = span_plus(*h, span_times((span){z->e[k], 0, 0}, (span){size(u), 0, 0}), 1);
    }
    return whole && thick && h->off == 0;
}

/* The facet's own height. */
static inline twin depth_of(const wall *f) { return sum_of(f->height.high, f->height.low - f->drop); }

/* Of some that are equally low to rounding one is right under the origin: the lowest such; and how low the lowest of
 * all is. NULL: none. */
static const wall *lowest_wall(const zonotope *z, lows *f, twin *least)
{
    const wall *best = NULL;
    *least = (twin){REAL_MAX, 0};
    for (int k = 0; k < f->n; k++) {
        wall *here = &f->of[k];
        find_foot(z, here);
        const twin own = depth_of(here);
        if (is_lower_twin(own, *least)) *least = own;
        if (here->beside <= BESIDE * z->far && (!best || is_lower_twin(own, depth_of(best)))) best = here;
    }
    return best;
}

/* Bounds of the cores' separation where all facets' heights are known to all digits: contact, as a rule. */
static int bound_level(const zonotope *z, const difference *d, const shape *a, const shape *b, const lows *f,
                       const wall *low, real *lower, real *upper)
{
    *upper = -REAL_MAX;
    for (int k = 0; k < f->n; k++) {
        span h;
        if (!level_height(z, d, a, b, &f->of[k], &h) || !(h.high >= 0)) return 0;
        const real off = 2 * UNIT * h.high;
        *upper = larger(*upper, 0 - (h.high - off));
        if (low == &f->of[k]) *lower = 0 - (h.high + off);
    }
    return 1;
}

/* The cores' depth with its bounds, along n, and the points that go with it, in the boxes, times their grain. There is
 * no simplex to be remembered: a cache stays as it is. */
static void spell_boxes(search *q, const shape *a, const shape *b, real lower, real upper, twin deep, vec n, vec x,
                        vec y, result *r)
{
    const difference *d = &q->d;
    q->normal = n;
    bracket(r, d, lower, upper, a, b);
    r->value = gap_of(d, (twin){-deep.high, -deep.low}, a, b);
    place_points(r, q, x, y, n, a, b, 2);
    store(r->normal, n);
    r->steps = q->steps;
    r->supports = d->calls;
    r->reserved = 0;
}

/* How deep two boxes overlap, or that they touch. 0: that is not certain, or they are apart. */
static APART int tell_boxes(search *q, const shape *a, const shape *b, const goal *g, result *r)
{
    zonotope z;
    lows f;
    vec x, y;
    twin deep;
    difference *d = &q->d;
    if (!(g->radius < PLAIN)) return 0;
    if (dot(q->v, spare(&q->s)->w) > 0) return 0; /* apart, as their first corner shows */
    know_offset(d, a, b);
    if (!take_boxes(&z, d) || !find_lows(&z, &f)) return 0;
    const wall *low = lowest_wall(&z, &f, &deep);
    if (!low) return 0;
    real least = f.of[0].floor;
    for (int k = 1; k < f.n; k++) least = smaller(f.of[k].floor, least);
    const twin h = low->height;
    real lower = below(-h.high, -h.low - WALL_DOUBT * z.far, 0), upper = -least;
    if (!(upper - lower <= 3 * UNIT * z.far)) return 0;
    if (!(upper < 0) && !bound_level(&z, d, a, b, &f, low, &lower, &upper)) return 0;
    EACH(x.c[i] = low->s[i] * (z.e[i] * z.level[0]); y.c[i] = -low->s[DIM + i] * (z.e[DIM + i] * z.level[1]));
    spell_boxes(q, a, b, lower, upper, deep, low->n, x, y, r);
    return 1;
}

/* ---- boxes in line with the frame: their difference is one, too ---- */

/* The box's map takes each axis of the frame to itself, longer or shorter, or to nothing: as the caller gave it, since
 * what is small beside the rest may underflow on its way to the frame. */
static inline int is_in_line(const shape *s)
{
    int r = 1;
    for (int i = 1; i < DIM * DIM && s->pose && r; i++) r = i % (DIM + 1) == 0 || s->pose->m[i] == 0;
    return r;
}

static inline real entry_of(const body *k, int i) { return k->posed ? k->m[(DIM + 1) * i] : 1; }

static inline real half_of(const body *k, int i) { return ((const box *)k->data)->half[i]; }

/* How far the box reaches along that axis. */
static inline span reach_level(const body *k, int i)
{
    return span_times((span){half_of(k, i) * k->grain, 0, 0}, (span){size(entry_of(k, i)), 0, 0});
}

/* Nothing of that has underflowed. */
static inline int is_reach_whole(span reach, const body *k, const shape *s, int i)
{
    return reach.high > 1 / PLAIN || half_of(k, i) == 0 || (k->posed && s->pose->m[(DIM + 1) * i] == 0);
}

/* All that is there came to the frame without rounding. */
static int are_whole(const difference *d, const shape *a, const shape *b)
{
    int r = is_way_whole(d, a, b);
    for (int i = 0; i < DIM; i++) {
        r &= is_whole(half_of(&d->a, i), half_of(&d->a, i) * d->a.grain);
        r &= is_whole(half_of(&d->b, i), half_of(&d->b, i) * d->b.grain);
        r &= is_reach_whole(reach_level(&d->a, i), &d->a, a, i) & is_reach_whole(reach_level(&d->b, i), &d->b, b, i);
    }
    return r;
}

/* The point of the box that is the share s out, along that axis of the frame, in the box's own length. */
static inline real level_point(const body *k, int i, real s)
{
    return (entry_of(k, i) < 0 ? -s : s) * (half_of(k, i) * k->grain);
}

/* The depth of such boxes: the least of how deep they are along each axis, in numbers that know how far they are off. A
 * look at a few numbers, before anything is asked; 0: they are none such, or apart. */
static int tell_level(search *q, const shape *a, const shape *b, const goal *g, result *r)
{
    difference *d = &q->d;
    int at = -1;
    real lower = 0, least = REAL_MAX, sign[DIM], share[DIM];
    twin deep = {REAL_MAX, 0};
    vec x, y;
    if (!(g->radius < PLAIN) || !is_in_line(a) || !is_in_line(b)) return 0;
    know_offset(d, a, b);
    for (int i = 0; i < DIM; i++) {
        const real c = d->c.c[i];
        sign[i] = c < 0 ? -1 : 1;
        const span both = span_plus(reach_level(&d->a, i), reach_level(&d->b, i), 1);
        const span h = span_plus(both, (span){c, d->c_low.c[i], 0}, -sign[i]);
        const real floor = below(h.high, h.low - 2 * h.off, 0);
        if (!(floor >= 0)) return 0;
        least = smaller(floor, least);
        share[i] = both.high > 0 ? larger(-1, smaller(1, c / both.high)) : 0;
        if (!is_lower_twin((twin){h.high, h.low}, deep)) continue;
        deep = (twin){h.high, h.low};
        lower = below(0 - h.high, -h.low - 2 * h.off, 0);
        at = i;
    }
    if (!are_whole(d, a, b)) return 0;
    share[at] = sign[at];
    EACH(x.c[i] = level_point(&d->a, i, share[i]); y.c[i] = -level_point(&d->b, i, share[i]));
    spell_boxes(q, a, b, lower, 0 - least, deep, axis(at, sign[at]), x, y, r);
    return 1;
}

#endif
