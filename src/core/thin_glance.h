/* SPDX-License-Identifier: MIT */
/* Whether thin cores meet, told in plain numbers: how high their corners lie along the way between two of their points
 * bounds from below how far apart they are, these points do from above, and all that rounds is charged
 * (docs/bounds.md). In the frame it is the same to the bit. */
#ifndef GJK_CORE_THIN_GLANCE_H
#define GJK_CORE_THIN_GLANCE_H

#include "thin.h"

/* Two points of the cores, and what they show. */
typedef struct hint {
    vec a, b;    /* these points, from the bodies' positions */
    vec v;       /* from b to a; of a point in a box the way out */
    real far;    /* how far apart they are */
    real height; /* of the lowest corner along v, times the length of v, */
    real l;      /* which this is, */
    real least;  /*   and is to be above */
} hint;

/* All that rounds, but for radii, is below this many of the root of A^2 + B^2 + c^2. */
#define HINT_DOUBT (32 * UNIT)

HOT hint hint_of_sticks(const sticks *k, vec c, real whole)
{
    const duo share = nearest_shares(k, c);
    const duos at = duos_add(k->at[0], duos_mul(k->way, share));
    hint e = {.a = vec_of_a(at), .b = vec_of_b(at), .least = UNIT * whole};
    e.v = sub(e.a, add(e.b, c));
    e.far = e.l = length(e.v);
    const duo first = duos_dot(k->at[0], duos_both(e.v)), last = duos_dot(k->at[1], duos_both(e.v));
    e.height = (smaller(of_a(first), of_a(last)) - larger(of_b(first), of_b(last))) - dot(c, e.v);
    return e;
}

/* A point's coordinates along the axes of a box that it is seen from, whose squares are uu, the map times level. */
static inline vec seen_along(const body *k, vec at, vec uu, real level)
{
    vec x = k->posed ? pull(k->m, mul(at, level)) : at;
    EACH(x.c[i] = x.c[i] * level / uu.c[i]);
    return x;
}

/* Of a point of the other body, from the position of that. */
HOT hint hint_of_box(const body *k, int of_a, vec half, vec own, vec c, vec uu, real level, real whole)
{
    const real least = least_of_note(whole, level);
    const vec at = of_a ? add(own, c) : sub(own, c), x = seen_along(k, at, uu, level);
    const vec foot = clamped(x, half), there = mapped(k, foot);
    /* in it, or so near to it that the way there is none */
    const int inside = peak(sub(foot, x)) <= least && peak(half) > least;
    hint e = {.a = of_a ? there : own, .b = of_a ? own : there, .least = UNIT * whole};
    vec way = sub(at, there);
    e.far = e.l = length(way);
    if (inside) {
        const vec in = noted(x, least);
        const int out = way_out(in, noted(half, least));
        way = mul(mapped(k, axis(out, 1)), signed_as(level, in.c[out]));
        e.l = length(way);
        e.least = UNIT;
    }
    e.v = mul(way, of_a ? -1 : 1);
    e.height = dot(at, way) - dot_size(half, k->posed ? pull(k->m, way) : way);
    return e;
}

/* The bounds in the caller's unit. */
HOT void bring_out(result *r, real lower, real upper, real unscale)
{
    r->lower = larger(smaller(rescaled(lower, unscale, -1), REAL_MAX), -REAL_MAX);
    r->upper = larger(rescaled(upper, unscale, 1), -REAL_MAX);
}

/* whole: that root. 0: it does not tell whether they meet. */
HOT int tell_hint(const difference *d, const hint *e, real whole, int framed, const shape *a, const shape *b, result *r)
{
    const real radius = (a->radius + b->radius) * d->scale;
    const real doubt = HINT_DOUBT * whole + 4 * UNIT * radius + (framed && d->wild ? d->lost : 0);
    result told;
    told.lower = (e->height / e->l - doubt) - radius;
    told.upper = (e->far + doubt) - radius;
    if (!(e->l > e->least) || !(radius < PLAIN * PLAIN) || !(told.lower <= told.upper)) return 0;
    if (framed) bring_out(&told, told.lower, told.upper, d->unscale);
    if (!(told.lower > 0) && !(told.upper < 0)) return 0;
    r->lower = told.lower;
    r->upper = told.upper;
    r->value = 0;
    vec normal;
    EACH(normal.c[i] = 0 - e->v.c[i] / e->l);
    store(r->normal, normal);
    move_points(r, d, normal, e->a, e->b, sub(e->a, add(e->b, d->c)), a, b, 0);
    r->steps = 1;
    r->supports = 2;
    r->reserved = 0;
    return 1;
}

/* ---- with or without a frame ---- */

HOT hint hint_at_box(const difference *d, real level, vec uu, real whole)
{
    const int of_a = d->a.asked == AS_BOX;
    const body *k = of_a ? &d->a : &d->b, *other = of_a ? &d->b : &d->a;
    const vec half = mul(load(((const box *)k->data)->half), k->grain),
              own = mapped(other, mul(first_end(other), other->grain));
    return hint_of_box(k, of_a, half, own, d->c, uu, level, whole);
}

/* Neither squares nor products of such sizes overflow, and what of them underflows is far below the doubt: of the
 * squares of a map and of a set, and of all. */
HOT int are_for_hint(real map, real set, real square, const shape *a, const shape *b)
{
    return map < PLAIN && set < PLAIN && are_of_plain_size(square, a, b);
}

static APART enum glanced glance_at_sticks(difference *d, const shape *a, const shape *b, result *r)
{
    sticks k;
    place_sticks(d, duo_both(1), 0, &k);
    real map[2], set[2];
    const real square = square_of_sticks(d, &k, map, set);
    if (!are_for_hint(larger(map[0], map[1]), larger(set[0], set[1]), square, a, b)) return UNCLEAR;
    const real whole = root(square);
    const hint e = hint_of_sticks(&k, d->c, whole);
    return tell_hint(d, &e, whole, 0, a, b, r) ? TELLING : IN_VAIN;
}

/* The map of what is but a point where its body is counts for nothing. */
static APART enum glanced glance_at_point(difference *d, const shape *a, const shape *b, result *r)
{
    const int of_a = d->a.asked == AS_BOX;
    const body *k = of_a ? &d->a : &d->b, *other = of_a ? &d->b : &d->a;
    const vec half = load(((const box *)k->data)->half), x = first_end(other), squares = squared_axes(k, 1);
    const real map = square_of_map(k, squares), set = dot(half, half);
    const real of_point = peak(x) > 0 ? square_of_map(other, squared_axes(other, 1)) : 0;
    const real reach = map * set, point = of_point * dot(x, x);
    const real square = (of_a ? reach + point : point + reach) + dot(d->c, d->c);
    if (!are_for_hint(larger(map, of_point), larger(set, dot(x, x)), square, a, b)) return UNCLEAR;
    const real level = leveler(root(map)), whole = root(square);
    const hint e = hint_at_box(d, level, mul(squares, level * level), whole);
    return tell_hint(d, &e, whole, 0, a, b, r) ? TELLING : IN_VAIN;
}

/* The same in the frame, whose root whole is, of a box whose level and axes' squares these are. */
static APART int glance_at_thin_in_frame(const difference *d, real whole, real level, vec uu, const shape *a,
                                         const shape *b, result *r)
{
    hint e;
    if (d->a.asked == AS_BOX || d->b.asked == AS_BOX) e = hint_at_box(d, level, uu, whole);
    else {
        sticks k;
        place_sticks(d, duo_of(d->a.grain, d->b.grain), 0, &k);
        e = hint_of_sticks(&k, d->c, whole);
    }
    return tell_hint(d, &e, whole, 1, a, b, r);
}

#endif
