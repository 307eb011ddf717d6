/* SPDX-License-Identifier: MIT */
/* In the plane: corners of the difference in a ring around the origin, which grows beyond its lowest edge. Which edges
 * there are is all that it is asked for; what is proven by them is told of their own corners (docs/bounds.md). */
#ifndef GJK_CORE_RING_H
#define GJK_CORE_RING_H

#include "double.h"

#if DIM == 2

/* So many corners a ring has at most, those counted that are none of it any more. */
#define RING_MOST 24

/* Beside the sister rings are made in double. */
#if HAS_SISTER
typedef double ring_real;
#define ring_root droot
#define GONE DBL_MAX
#else
typedef real ring_real;
#define ring_root root
#define GONE REAL_MAX
#endif

/* A corner: where it is, and which. */
typedef struct mark {
    ring_real x, y;
    unsigned at;
} mark;

/* The origin is to the left of their edges. */
typedef struct ring {
    mark at[RING_MOST];
    unsigned next[RING_MOST], last[RING_MOST];
    ring_real far[RING_MOST]; /* how far the edge from there is; below 0 where the origin lies beyond it; GONE: the
                                 corner is none of the ring any more */
    unsigned count;
} ring;

/* How far to the left of the way from p to q r lies, times how far that is. */
HOT ring_real left_of(const mark *p, const mark *q, const mark *r)
{
    return (q->x - p->x) * (r->y - p->y) - (q->y - p->y) * (r->x - p->x);
}

/* An edge leads from there to there. */
HOT void link_ring(ring *o, unsigned from, unsigned to)
{
    const mark *p = &o->at[from], *q = &o->at[to];
    const ring_real x = q->x - p->x, y = q->y - p->y;
    o->next[from] = to;
    o->last[to] = from;
    o->far[from] = (p->x * y - p->y * x) / ring_root(x * x + y * y);
}

/* Of three corners. */
HOT void start_ring(ring *o, mark p, mark q, mark r)
{
    const int left = left_of(&p, &q, &r) > 0;
    o->at[0] = p;
    o->at[1] = left ? q : r;
    o->at[2] = left ? r : q;
    o->count = 3;
    for (unsigned i = 0; i < 3; i++) link_ring(o, i, (i + 1) % 3);
}

/* Where the lowest edge starts; or one of which that is no number. */
HOT unsigned lowest_of_ring(const ring *o)
{
    unsigned low = 0;
    for (unsigned i = 1; i < o->count; i++) low = o->far[i] >= o->far[low] ? low : i;
    return low;
}

/* The corner does not stand out of the way from one to another. */
HOT int is_hidden(const mark *p, const mark *from, const mark *to) { return !(left_of(from, to, p) < 0); }

/* Takes in a corner beyond the edge from there on; those that it hides are none of the ring any more, as those may be
 * that it was started with, if they are not the farthest along any way. There is room for it. */
HOT void split_edge(ring *o, unsigned from, mark p)
{
    const unsigned at = o->count++;
    unsigned to = o->next[from];
    o->at[at] = p;
    while (o->last[from] != to && is_hidden(&o->at[from], &o->at[o->last[from]], &p)) {
        o->far[from] = GONE;
        from = o->last[from];
    }
    while (o->next[to] != from && is_hidden(&o->at[to], &p, &o->at[o->next[to]])) {
        o->far[to] = GONE;
        to = o->next[to];
    }
    link_ring(o, from, at);
    link_ring(o, at, to);
}

/* The edge that the origin is beside, from the lowest on: of edges in line rounding may take another for that. */
HOT unsigned edge_beside(const ring *o, unsigned i)
{
    for (unsigned n = 0; n < o->count; n++) {
        const mark *p = &o->at[i], *q = &o->at[o->next[i]];
        const ring_real x = q->x - p->x, y = q->y - p->y, along = -(p->x * x + p->y * y);
        if (along >= 0 && along <= x * x + y * y) break;
        i = along < 0 ? o->last[i] : o->next[i];
    }
    return i;
}

#endif

#endif
