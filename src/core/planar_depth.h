/* SPDX-License-Identifier: MIT */
/* How deep polygons of few corners in the plane overlap: a ring of corners of the difference grows beyond its lowest
 * edge, until nothing lies there but for the doubt, and heights are told to twice the digits (docs/bounds.md). */
#ifndef GJK_CORE_PLANAR_DEPTH_H
#define GJK_CORE_PLANAR_DEPTH_H

#include "planar_tell.h"

#if DIM == 2

HOT mark mark_of_spot(const spot *p) { return (mark){(ring_real)p->w.c[0], (ring_real)p->w.c[1], p->at}; }

/* Of an edge of the ring, or of what is taken for one. */
HOT void stand_in_ring(const difference *d, const scene *k, const ring *o, unsigned i, front *f)
{
    stand_on_edge(k, f, spot_at(d, k, o->at[i].at), spot_at(d, k, o->at[o->next[i]].at));
    f->v = (vec){{-f->edge.c[1], f->edge.c[0]}};
}

/* Grows beyond the lowest edge until no corner lies there, but for the doubt. 0: it is not known. */
static int grow_planar_ring(const difference *d, const scene *k, front *f, const goal *g, ring *o)
{
    start_ring(o, mark_of_spot(&f->p), mark_of_spot(&f->q), mark_of_spot(&f->last));
    for (;;) {
        const unsigned i = lowest_of_ring(o);
        stand_in_ring(d, k, o, i, f);
        if (o->count == RING_MOST || f->steps >= g->max_steps || !(dot(f->v, f->v) > 0)) return 0;
        ask_ahead(d, k, f);
        f->around = 0;
        f->ended = !(dot(f->v, sub(f->p.w, f->last.w)) > d->doubt * length(f->v));
        if (f->ended) return 1;
        split_edge(o, i, mark_of_spot(&f->last));
    }
}

/* A corner's height along v to twice the digits. */
static twin height_finely(const difference *d, const scene *k, vec v, const spot *p, const shape *a, const shape *b)
{
    const closest at = pair_at_spot(k, p);
    return height_to_twice(v, p->w, lost_finely(d, k, &at, a, b));
}

/* An edge of the ring, where it starts, the heights of its ends along v to twice the digits, and how near the origin it
 * is at least. */
typedef struct ledge {
    front f;
    unsigned at;
    twin from, to;
    real far;
} ledge;

/* Of those that are as low but for the doubt the lowest. */
static void lowest_finely(const difference *d, const scene *k, const ring *o, const shape *a, const shape *b,
                          ledge *best)
{
    const ring_real low = o->far[lowest_of_ring(o)] + 8 * (ring_real)d->doubt;
    ledge e = *best;
    best->far = REAL_MAX;
    for (unsigned i = 0; i < o->count; i++) {
        if (o->far[i] > low) continue;
        stand_in_ring(d, k, o, i, &e.f);
        e.at = i;
        e.from = height_finely(d, k, e.f.v, &e.f.p, a, b);
        e.to = height_finely(d, k, e.f.v, &e.f.q, a, b);
        e.far = smaller(-e.from.high - e.from.low, -e.to.high - e.to.low);
        if (e.far < best->far) *best = e;
    }
}

/* How much lower along v than the first corner of the edge another one of the body lies, to twice the digits. */
static real fall_finely(const difference *d, const scene *k, const ledge *e, int of_b, const shape *a, const shape *b)
{
    const front *f = &e->f;
    const real margin = d->doubt * length(f->v);
    const cluster *p = of_b ? &k->b : &k->a;
    unsigned near = near_corners(p, of_b ? in_b(&f->p) : in_a(&f->p), of_b ? f->v : mul(f->v, -1), margin);
    real fall = 0;
    for (; near != 0; near &= near - 1) {
        const unsigned nth = first_bit(near);
        const spot at = spot_at(d, k, of_b ? in_a(&f->p) + PLACES * nth : nth + PLACES * in_b(&f->p));
        const twin h = at.at == f->q.at ? e->to : height_finely(d, k, f->v, &at, a, b);
        fall = larger((e->from.high - h.high) + (e->from.low - h.low), fall);
    }
    return fall;
}

/* How deep, from the edge and the corner asked for last on, which hold the origin. 0: they hardly overlap, and it is
 * not known that they touch; or rounding leaves open beyond which edge nothing lies. */
static APART int tell_deep(search *q, const scene *k, front own, int framed, const shape *a, const shape *b,
                           const goal *g, result *r)
{
    const difference *d = &q->d;
    ledge e = {.f = own};
    ring o;
    if (!grow_planar_ring(d, k, &e.f, g, &o)) return 0;
    if (!(o.far[lowest_of_ring(&o)] > 4 * (ring_real)d->doubt))
        return g->radius == 0 && tell_touching(q, k, e.f, framed, a, b, g, r);
    lowest_finely(d, k, &o, a, b, &e);
    front *f = &e.f;
    const real fall = fall_finely(d, k, &e, 0, a, b) + fall_finely(d, k, &e, 1, a, b);
    const real blur = blur_of(d), broad = d->doubt / PLANAR_DOUBT / 2 + (a->radius + b->radius) * d->scale;
    verdict t;
    see_along(&t, f->v);
    t.value = gap_of(d, e.from, a, b);
    stand_in_ring(d, k, &o, edge_beside(&o, e.at), f);
    const closest pair = pair_at_front(d, k, f, share_of_edge(f));
    place_verdict(k, &pair, &t);
    t.lower = e.from.high + (e.from.low - fall - 3 * blur - 2 * UNIT * size(e.from.high));
    t.upper = blur + 3 * UNIT * e.far - e.far;
    if (!(e.far > 3 * d->doubt && fall <= UNIT * broad && t.upper - t.lower <= BROAD * broad)) return 0;
    if (!(spread(sub(t.way, mul(t.v, e.from.high / t.l))) <= BROAD / 2 * broad)) return 0; /* the pair is beside it */
    return spell_in_full(q, t, f->steps, 2, a, b, r);
}

#endif

#endif
