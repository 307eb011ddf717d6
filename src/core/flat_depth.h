/* SPDX-License-Identifier: MIT */
/* How deep bodies of few corners in the plane overlap, in float where it stands beside its sister: in double, around
 * the triangle that the walk has ended with a ring of corners of the difference grows beyond its lowest edge, until
 * nothing lies there. A ball as large as that edge is high is in the ring, and no corner is farther out along the
 * edge's normal: that is the depth, with what double rounds charged (docs/bounds.md). */
#ifndef GJK_CORE_FLAT_DEPTH_H
#define GJK_CORE_FLAT_DEPTH_H

#include "flat_front.h"
#include "ring.h"

#if DIM == 2

/* So many corners are asked for, those of the walk included. */
#define DEEP_ASKED_MOST (ASKED_MOST + RING_MOST)

#if HAS_SISTER

HOT mark mark_of(const dspot *p) { return (mark){dfirst(p->w), dsecond(p->w), p->at}; }

HOT dspot dspot_at(const flat *f, const mark *p) { return dspot_of(f, at_in_a(p->at), at_in_b(p->at)); }

HOT void stand_in_flat_ring(const flat *f, const ring *o, unsigned i, dfront *k)
{
    k->p = dspot_at(f, &o->at[i]);
    k->q = dspot_at(f, &o->at[o->next[i]]);
    k->n = 2;
    k->around = 0;
}

/* Stands beside the origin on the ring's lowest edge, beyond which no corner lies, and which has been asked along; or
 * on one in line with it. 0: it is not known. */
HOT int find_floor(const flat *f, dfront *k, const goal *g, dsight *s)
{
    ring o;
    start_ring(&o, mark_of(&k->p), mark_of(&k->q), mark_of(&k->last));
    for (;;) {
        const unsigned i = lowest_of_ring(&o);
        stand_in_flat_ring(f, &o, i, k);
        const dvec e = dsub(k->q.w, k->p.w);
        if (o.count == RING_MOST || k->steps >= g->max_steps || !(ddot(e, e) > 0)) return 0;
        k->v = dturned(e);
        ask_flat(f, k);
        s->v = k->v;
        s->per = 1 / dlength(e);
        s->far = dcross(k->p.w, e) * s->per;
        if (!(-k->height * s->per - s->far > f->blur)) {
            const unsigned beside = edge_beside(&o, i);
            if (beside != i) stand_in_flat_ring(f, &o, beside, k);
            return 1;
        }
        split_edge(&o, i, mark_of(&k->last));
    }
}

/* The nearest point of the front is as far along its normal, and not beside it. */
HOT int is_square_to(const flat *f, const dsight *s)
{
    const dvec off = dsizes(dadd(s->way, dmul(s->v, s->far * s->per)));
    return dfirst(off) + dsecond(off) <= f->wide;
}

/* How deep, from three corners on that hold the origin. 0: they hardly overlap, and it is not known that they touch. */
static APART int tell_flat_deep(const flat *f, dfront *k, const shape *a, const shape *b, const goal *g, result *r)
{
    dsight s;
    const double blur = 2 * f->blur + f->radius * 0x1p-51;
    if (!find_floor(f, k, g, &s)) return 0;
    if (!(s.far > blur)) return 0;
    const double lower = k->height * s.per - f->radius - blur, upper = blur - s.far - f->radius;
    k->under = 1;
    sight_flat(k, &s);
    if (!(upper - lower <= f->wide) || !(1 > f->blur * AWAY * s.per) || !is_square_to(f, &s)) return 0;
    if (f->radius > 0) move_flat(&s, (double)a->radius, (double)b->radius, 1, 1);
    return spell_flat(f, k->steps, &s, lower, upper, -s.far - f->radius, 1, r);
}

#endif
#endif

#endif
