/* SPDX-License-Identifier: MIT */
/* Two boxes: whether they meet. Their axes tell where to look: along which direction they are apart, or for a point of
 * both. Nothing of this is taken on trust: the corner asked for along that direction proves the one, the room around
 * that point the other (docs/bounds.md). What neither proves is left to the walk. */
#ifndef GJK_CORE_AXES_H
#define GJK_CORE_AXES_H

#include "plain.h"
#include "touch.h"
#include "zonotope.h"

/* The boxes as they see each other, in lengths along their axes. Where a box's axes are not square to each other it is
 * no more than a guess. */
typedef struct gauge {
    zonotope z;  /* whose axes are of length 1 */
    real off;    /* but for that, in squares */
    vec e, f;    /* the halves of a and of b */
    vec unit[2]; /* 1 along an axis, in a box's own coordinates times their grain */
    vec t, s;    /* the way from a's middle to b's: along a's axes, and along b's */
    vec r[DIM];  /* r[i].c[j]: a's axis i along b's axis j */
} gauge;

/* Bounds what a ball loses where axes are not of length 1 and square to each other, as a share: the squares of the axes
 * are off 1 by that, or their products off 0. */
static inline real skew_of(const gauge *k, int at)
{
    const vec *u = k->z.u + DIM * at;
    real skew = size(dot(u[0], u[1]));
    if (DIM > 2) skew += size(dot(u[0], u[DIM - 1])) + size(dot(u[1], u[DIM - 1]));
    return skew + (k->off + 64 * UNIT);
}

/* Axes whose squared length is off 1 by more are brought to length 1. */
#define LENGTH_OFF (4096 * UNIT)

/* 0: they are of too different lengths, or far from square to each other, where guesses are no good. */
static APART int bring_to_length(gauge *k)
{
    if (!is_fair(&k->z, 0) || !is_fair(&k->z, 1)) return 0;
    for (int i = 0; i < AXES; i++) {
        const real l = root(k->z.uu[i]);
        k->z.u[i] = mul(k->z.u[i], 1 / l);
        (i < DIM ? &k->e : &k->f)->c[i % DIM] *= l;
        k->unit[i / DIM].c[i % DIM] /= l;
    }
    k->off = 0;
    return skew_of(k, 0) + skew_of(k, 1) < (real)0x1p-10;
}

static inline int take_gauge(gauge *k, const difference *d)
{
    zonotope *z = &k->z;
    take_axes(z, 0, &d->a);
    take_axes(z, 1, &d->b);
    k->off = 0;
    EACH(k->e.c[i] = z->e[i]; k->f.c[i] = z->e[DIM + i]; k->unit[0].c[i] = z->level[0]; k->unit[1].c[i] = z->level[1]);
    for (int i = 0; i < AXES; i++) k->off = larger(size(z->uu[i] - 1), k->off);
    if (k->off > LENGTH_OFF && !bring_to_length(k)) return 0;
    EACH(k->t.c[i] = dot(z->u[i], d->c); k->s.c[i] = dot(z->u[DIM + i], d->c);
         for (int j = 0; j < DIM; j++) k->r[i].c[j] = dot(z->u[i], z->u[DIM + j]));
    return 1;
}

static inline vec clamped(vec x, vec e)
{
    EACH(x.c[i] = larger(smaller(x.c[i], e.c[i]), -e.c[i]));
    return x;
}

/* A point of a, from b's middle along b's axes, and the other way round. */
static inline vec seen_from_b(const gauge *k, vec x)
{
    vec y = mul(k->r[0], x.c[0]);
    REST(y = add(y, mul(k->r[i], x.c[i])));
    return sub(y, k->s);
}

static inline vec seen_from_a(const gauge *k, vec y)
{
    vec x;
    EACH(x.c[i] = dot(k->r[i], y) + k->t.c[i]);
    return x;
}

/* ---- a point of both ---- */

/* How far a point is from the box's nearest side; below 0: it is outside. */
static inline real room_at(vec x, vec e)
{
    real least = e.c[0] - size(x.c[0]);
    REST(least = smaller(e.c[i] - size(x.c[i]), least));
    return least;
}

/* The body's point x, times its grain, is that of both. */
static inline void place_common(result *r, const search *q, const body *k, const shape *s, vec x)
{
    const real far = far_out(s);
    const int plain = !q->d.wild && far < PLAIN;
    const real level = plain ? 1 : level_of(&q->d, 0, far);
    vec p = in_world(k, s->pose, x, level * q->d.unscale, level);
    if (!plain) p = in_range(mul(p, 1 / level));
    store(r->point_a, p);
    store(r->point_b, p);
}

/* Of the box's point, times its grain, the coordinates. 0: it is none, or they are no numbers of the format. */
static inline int is_in_box(const body *k, vec x, vec *own)
{
    const box *of = k->data;
    int r = 1;
    *own = mul(x, 1 / k->grain);
    EACH(r &= size(own->c[i]) <= of->half[i]);
    return r && same(mul(*own, k->grain), x);
}

/* The points x and y of the bodies, times their grain, are one, and nothing was rounded. */
static APART int is_one_point(const search *q, vec x, vec y, const shape *a, const shape *b)
{
    simplex s;
    s.n = 1;
    s.at[0] = 0;
    return is_in_box(&q->d.a, x, &s.slot[0].x) && is_in_box(&q->d.b, y, &s.slot[0].y) &&
           are_corners_whole(&q->d, &s, a, b);
}

/* The points x of a and y of b, lengths along their axes, are as good as one: that proves the boxes to meet if there is
 * room around it in one of them, or if nothing was rounded. 0: neither is certain. */
static APART int tell_point(search *q, const gauge *k, vec x, vec y, real room, int in_b, const shape *a,
                            const shape *b, result *r)
{
    const difference *d = &q->d;
    EACH(x.c[i] *= k->unit[0].c[i]; y.c[i] *= k->unit[1].c[i]);
    const vec w = sub(d->a.posed ? map(d->a.m, x) : x, add(d->b.posed ? map(d->b.m, y) : y, d->c));
    const real deep = room > 0 ? room * (1 - skew_of(k, in_b)) - spread(w) - d->doubt : 0;
    const int one = !(deep > 0) && same(w, axis(0, 0)) && is_one_point(q, x, y, a, b);
    if (!(deep > 0) && !one) return 0;
    raise(q, q->v, spare(&q->s)->w);
    bracket(r, d, q->lower, one ? 0 : -deep, a, b);
    if (one) r->upper = smaller(r->upper, 0); /* also where it was rounded on the way out */
    else if (!(r->upper < 0)) return 0;
    if (in_b) place_common(r, q, &d->a, a, x);
    else place_common(r, q, &d->b, b, y);
    store(r->normal, q->normal);
    r->steps = q->steps + 1;
    r->supports = d->calls;
    r->reserved = 0;
    return 1;
}

/* The point of a may be one of b, too, or the other way round. */
static inline int try_of_a(search *q, const gauge *k, vec x, const shape *a, const shape *b, result *r)
{
    const vec y = seen_from_b(k, x);
    const real room = room_at(y, k->f);
    return room >= 0 && tell_point(q, k, x, y, room, 1, a, b, r);
}

static inline int try_of_b(search *q, const gauge *k, vec y, const shape *a, const shape *b, result *r)
{
    const vec x = seen_from_a(k, y);
    const real room = room_at(x, k->e);
    return room >= 0 && tell_point(q, k, x, y, room, 0, a, b, r);
}

/* ---- along the axes ---- */

/* By how much the boxes reach into each other along each axis; below 0: they are apart along it. */
static inline void reach_along(const gauge *k, real h[AXES])
{
    vec over = axis(0, 0);
    EACH(h[i] = k->e.c[i] - size(k->t.c[i]); for (int j = 0; j < DIM; j++) {
        h[i] += k->f.c[j] * size(k->r[i].c[j]);
        over.c[j] += k->e.c[i] * size(k->r[i].c[j]);
    });
    EACH(h[DIM + i] = k->f.c[i] + over.c[i] - size(k->s.c[i]));
}

static inline int least_of(const real *h, int n)
{
    int at = 0;
    for (int i = 1; i < n; i++) at = h[i] < h[at] ? i : at;
    return at;
}

/* The point of b farthest along an axis of a toward a, or of a toward b. */
static inline vec foremost_of_b(const gauge *k, int at)
{
    const real way = k->t.c[at] > 0 ? -1 : 1;
    vec y;
    EACH(y.c[i] = signed_as(k->f.c[i], way * k->r[at].c[i]));
    return y;
}

static inline vec foremost_of_a(const gauge *k, int at)
{
    const real way = k->s.c[at] > 0 ? 1 : -1;
    vec x;
    EACH(x.c[i] = signed_as(k->e.c[i], way * k->r[i].c[at]));
    return x;
}

#if DIM == 3
/* The same along the normal of each pair of axes, one of each box, times its length, whose square is ll. */
static inline void reach_across(const gauge *k, real h[9], real ll[9])
{
    const vec e = k->e, f = k->f, *r = k->r;
    for (int i = 0; i < 3; i++) {
        const int i1 = next_axis[i + 1], i2 = next_axis[i + 2];
        for (int j = 0; j < 3; j++) {
            const int j1 = next_axis[j + 1], j2 = next_axis[j + 2];
            const real way = k->t.c[i2] * r[i1].c[j] - k->t.c[i1] * r[i2].c[j];
            h[3 * i + j] = (e.c[i1] * size(r[i2].c[j]) + e.c[i2] * size(r[i1].c[j])) +
                           (f.c[j1] * size(r[i].c[j2]) + f.c[j2] * size(r[i].c[j1])) - size(way);
            ll[3 * i + j] = 1 - r[i].c[j] * r[i].c[j];
        }
    }
}

/* The point of a's edge nearest to b's, where these two are what is foremost across the pair of axes. */
static inline vec nearest_on_edge_of_a(const gauge *k, int of_a, int of_b)
{
    const int i1 = next_axis[of_a + 1], i2 = next_axis[of_a + 2];
    const real way = k->t.c[i2] * k->r[i1].c[of_b] - k->t.c[i1] * k->r[i2].c[of_b], rr = k->r[of_a].c[of_b];
    vec l = axis(0, 0), x, y, m;
    l.c[i1] = -k->r[i2].c[of_b] * way;
    l.c[i2] = k->r[i1].c[of_b] * way;
    m = add(mul(k->r[i1], l.c[i1]), mul(k->r[i2], l.c[i2]));
    EACH(x.c[i] = signed_as(k->e.c[i], l.c[i]); y.c[i] = signed_as(k->f.c[i], -m.c[i]));
    x.c[of_a] = y.c[of_b] = 0;
    const real along = (seen_from_a(k, y).c[of_a] + rr * seen_from_b(k, x).c[of_b]) / (1 - rr * rr);
    x.c[of_a] = larger(smaller(along, k->e.c[of_a]), -k->e.c[of_a]);
    return x;
}
#endif

/* ---- telling ---- */

/* That they are apart, if the corner in the spare slot proves it. */
static int tell_gap(search *q, const shape *a, const shape *b, const goal *g, result *r)
{
    q->way = q->v;
    if (!is_proven_beyond(q, g->beyond)) return 0;
    q->steps++;
    spell_apart(q, a, b, r);
    q->steps--;
    return r->lower > 0;
}

/* The same of the corner along l, which seems to lead from one box to the other. If not, the walk starts from there. */
static int try_along(search *q, vec l, const shape *a, const shape *b, const goal *g, result *r)
{
    vertex p;
    if (dot(l, q->d.c) > 0) l = mul(l, -1);
    if (g->max_steps < 2 || !(peak(l) > 0) || !ask_on(&q->d, l, &p)) return 0;
    q->steps++;
    q->v = l;
    *spare(&q->s) = p;
    return tell_gap(q, a, b, g, r);
}

/* So near contact heights in plain numbers, of a frame of size 1 to 2, are no guide. */
#define REACH_DOUBT (32 * UNIT)

/* Along which axis, or across which pair of them, the boxes seem to be apart, or else into each other by the least. */
static int try_axes(search *q, const gauge *k, const shape *a, const shape *b, const goal *g, result *r)
{
    real h[AXES];
    const real apart = -g->beyond - REACH_DOUBT;
    reach_along(k, h);
    const int least = least_of(h, AXES);
    if (h[least] < apart) return try_along(q, k->z.u[least], a, b, g, r);
#if DIM == 3
    real across[9], ll[9], lowest = h[least] * h[least];
    int edges = -1;
    reach_across(k, across, ll);
    const int gap = least_of(across, 9);
    if (across[gap] < apart) return try_along(q, cross(k->z.u[gap / 3], k->z.u[DIM + gap % 3]), a, b, g, r);
    if (!(h[least] > REACH_DOUBT)) return 0;
    for (int i = 0; i < 9; i++) {
        if (!(across[i] * across[i] < lowest * ll[i]) || !(ll[i] > PARALLEL)) continue;
        lowest = across[i] * across[i] / ll[i];
        edges = i;
    }
    if (edges >= 0) return try_of_a(q, k, nearest_on_edge_of_a(k, edges / 3, edges % 3), a, b, r);
#endif
    return least < DIM ? try_of_b(q, k, foremost_of_b(k, least), a, b, r)
                       : try_of_a(q, k, foremost_of_a(k, least - DIM), a, b, r);
}

/* Whether they meet, of two boxes whose first corner is in the spare slot. 0: it is left to the walk, from there. */
static APART int tell_by_axes(search *q, const shape *a, const shape *b, const goal *g, result *r)
{
    gauge k;
    if (dot(q->v, spare(&q->s)->w) > 0 || !take_gauge(&k, &q->d)) return 0;
    const vec x = clamped(k.t, k.e), y = clamped(mul(k.s, -1), k.f);
    return try_of_a(q, &k, x, a, b, r) || try_of_b(q, &k, y, a, b, r) || try_axes(q, &k, a, b, g, r);
}

static inline int are_boxes(const shape *a, const shape *b)
{
    return a->support == pub(support_box) && b->support == pub(support_box);
}

/* The walk takes up the last query's simplex after all. 0: something is wrong. */
static APART int reopen_after_axes(search *q, const shape *a, const shape *b, const cache *k)
{
    const int steps = q->steps;
    if (!lends(k, a, b)) return 1;
    blank(q);
    q->steps = steps;
    if (reopen_listed(q, k)) return 1;
    blank(q);
    q->steps = steps;
    q->v = first_direction(&q->d);
    return ask_anew(&q->d, q->v, 1, spare(&q->s));
}

#endif
