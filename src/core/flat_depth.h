/* SPDX-License-Identifier: MIT */
/* How deep bodies of few corners in the plane overlap, in float where it stands beside its sister: in double, around
 * the triangle that the walk has ended with a ring of corners of the difference grows beyond its lowest edge, until
 * nothing lies there. A ball as large as that edge is high is in the ring, and no corner is farther out along the
 * edge's normal: that is the depth, with what double rounds charged (docs/bounds.md). */
#ifndef GJK_CORE_FLAT_DEPTH_H
#define GJK_CORE_FLAT_DEPTH_H

#include "flat_front.h"

#if DIM == 2

/* So many corners a ring has at most, and so many are asked for, those of the walk included. */
#define RING_MOST 24
#define DEEP_ASKED_MOST (ASKED_MOST + RING_MOST)

#if HAS_SISTER

/* Corners of the difference around the origin, to the left. */
typedef struct ring {
    dspot at[RING_MOST];
    unsigned next[RING_MOST], last[RING_MOST];
    double square[RING_MOST]; /* of how far the edge from there is; below 0 where the origin lies beyond it; DBL_MAX:
                                 the corner is none of the ring any more */
    unsigned count;
} ring;

/* The way of the edge from there on. */
HOT dvec edge_of_ring(const ring *o, unsigned i) { return dsub(o->at[o->next[i]].w, o->at[i].w); }

/* An edge leads from there to there. */
HOT void link_ring(ring *o, unsigned from, unsigned to)
{
    o->next[from] = to;
    o->last[to] = from;
    const dvec e = edge_of_ring(o, from);
    const double turn = dcross(o->at[from].w, e);
    o->square[from] = turn * fabs(turn) / ddot(e, e);
}

/* Of the triangle that the front and the corner asked for last make. */
HOT void start_ring(ring *o, const dfront *k)
{
    const int left = dcross(dsub(k->q.w, k->p.w), dsub(k->last.w, k->p.w)) > 0;
    o->at[0] = k->p;
    o->at[1] = left ? k->q : k->last;
    o->at[2] = left ? k->last : k->q;
    o->count = 3;
    for (unsigned i = 0; i < 3; i++) link_ring(o, i, (i + 1) % 3);
}

/* Where the lowest edge starts. */
HOT unsigned lowest_of_ring(const ring *o)
{
    unsigned low = 0;
    for (unsigned i = 1; i < o->count; i++) low = o->square[i] >= o->square[low] ? low : i;
    return low;
}

/* The corner does not stand out of the way from one to another. */
HOT int is_hidden(dvec at, dvec from, dvec to) { return !(dcross(dsub(to, from), dsub(at, from)) < 0); }

/* Takes in a corner beyond the edge from there on; those that it hides are none of the ring any more, as the walk's may
 * be, which starts at corners that are not the farthest along any way. */
HOT void split_edge(ring *o, unsigned from, dspot p)
{
    const unsigned at = o->count++;
    unsigned to = o->next[from];
    o->at[at] = p;
    while (o->last[from] != to && is_hidden(o->at[from].w, o->at[o->last[from]].w, p.w)) {
        o->square[from] = DBL_MAX;
        from = o->last[from];
    }
    while (o->next[to] != from && is_hidden(o->at[to].w, p.w, o->at[o->next[to]].w)) {
        o->square[to] = DBL_MAX;
        to = o->next[to];
    }
    link_ring(o, from, at);
    link_ring(o, at, to);
}

/* Stands on the ring's lowest edge, beyond which no corner lies, and which has been asked along. 0: it is not known. */
HOT int find_floor(const flat *f, dfront *k, const goal *g, dsight *s)
{
    ring o;
    start_ring(&o, k);
    for (;;) {
        const unsigned i = lowest_of_ring(&o);
        const dvec e = edge_of_ring(&o, i);
        if (o.count == RING_MOST || k->steps >= g->max_steps || !(ddot(e, e) > 0)) return 0;
        k->v = dturned(e);
        ask_flat(f, k);
        s->v = k->v;
        s->per = 1 / dlength(e);
        s->far = dcross(o.at[i].w, e) * s->per;
        k->p = o.at[i];
        k->q = o.at[o.next[i]];
        k->n = 2;
        k->around = 0;
        if (!(-k->height * s->per - s->far > f->blur)) return 1;
        split_edge(&o, i, k->last);
    }
}

/* How deep, from three corners on that hold the origin. 0: they hardly overlap, and it is not known that they touch. */
static APART int tell_flat_deep(const flat *f, dfront *k, const shape *a, const shape *b, const goal *g, result *r)
{
    dsight s;
    const double blur = 2 * f->blur + f->radius * 0x1p-51;
    if (!find_floor(f, k, g, &s)) return 0;
    if (!(s.far > blur)) return 0;
    const double lower = k->height * s.per - f->radius - blur, upper = blur - s.far - f->radius;
    if (!(upper - lower <= f->wide) || !(1 > f->blur * AWAY * s.per)) return 0;
    sight_flat(k, &s);
    if (f->radius > 0) move_flat(&s, (double)a->radius, (double)b->radius, 1, 1);
    return spell_flat(f, k, &s, lower, upper, -s.far - f->radius, 1, r);
}

#endif
#endif

#endif
