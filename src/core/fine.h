/* SPDX-License-Identifier: MIT */
/* Cores that are known by their corners, and apart by so little that rounded corners hardly tell: v worked out anew,
 * the height of the lowest corners along it and the length of the pair that goes with it, all to twice the digits. The
 * bounds prove themselves, however v was come by; where they do not tell enough, the exact finish does. */
#ifndef GJK_CORE_FINE_H
#define GJK_CORE_FINE_H

#include "contact.h"

/* A corner that v has not met yet is taken in so often. */
#define FINE_ROUNDS 4

/* They tell the sign, the radii taken off; and where the distance is wanted, that to two roundings of the
 * frame. */
static int is_fine(const search *q, const goal *g, real lower, real upper)
{
    real near = g->radius * q->d.scale;
    int told = lower > near + 4 * UNIT * near || (lower > 0 && upper < near - 4 * UNIT * near);
    return told && (g->sign_only || upper - lower <= 2 * UNIT);
}

/* Takes in a corner farther along the way than the simplex. 0: it is none, or v comes no nearer by it. */
static int take_corner(search *q, const vertex *c)
{
    for (int i = 0; i < q->s.n; i++)
        if (repeats(corner(&q->s, i), c)) return 0;
    *spare(&q->s) = *c;
    spare(&q->s)->w = corner_of(&q->d, c->x, c->y);
    q->steps++;
    q->d.calls += 2;
    return advance(q) && q->s.n <= DIM && !vanished(q);
}

/* v made square to the simplex, with edges that rounding took nothing from: of a pair that is known to twice the digits
 * as good as it can be spelled. */
static vec square_to_edges(const search *q, vec v)
{
    simplex edges = q->s;
    if (q->s.n == 1) return v;
    vec first = lost_of(q, corner(&q->s, 0));
    for (int i = 1; i < q->s.n; i++) {
        const vertex *p = corner(&q->s, i);
        edges.slot[q->s.at[i]].w = add(sub(p->w, point(&q->s, 0)), sub(lost_of(q, p), first));
    }
    edges.slot[q->s.at[0]].w = axis(0, 0);
    return square_to(&edges, v);
}

/* The nearest point is well inside the simplex, so that no corner is in it by rounding alone, which would turn v: the
 * weights, less what the pair lies off v by. */
static int is_inside(const search *q, const real weight[DIM + 1], vec off)
{
    real extra[DIM + 1];
    int r = 1;
    if (q->s.n == 1) return 1;
    change(&q->s, off, extra);
    for (int i = 0; i < q->s.n; i++) r &= weight[i] - extra[i] > 256 * UNIT;
    return r;
}

/* The simplex of corners holds the origin for certain: the cores meet. */
static int settle_meeting(search *q, const shape *a, const shape *b, real weight[DIM + 1], real *upper)
{
    if (!(q->lower <= 0) || !holds_origin(q, a, b, weight)) return 0;
    q->pending = 0;
    q->met = q->fine = 1;
    q->apart = (twin){0, 0};
    *upper = smaller(*upper, 0);
    return 1;
}

/* Bounds the cores' separation from both sides. 0: that does not tell enough; the bounds of q and upper are as they
 * were, its simplex and the weights still are those of corners. */
static APART int settle_apart(search *q, const shape *a, const shape *b, const goal *g, real weight[DIM + 1],
                              real *upper)
{
    if ((vanished(q) || q->s.n > DIM) && settle_meeting(q, a, b, weight, upper)) return 1;
    for (int i = 0; i < FINE_ROUNDS && q->s.n <= DIM; i++) {
        depth d = {.q = q, .a = a, .b = b, .g = g};
        vertex c;
        vec low, w = fine_pair(q, weight, &low), v = square_to_edges(q, add(w, low)), n = mul(v, -1 / length(v));
        if (!(dot(v, v) > UNIT * UNIT * UNIT * UNIT)) return 0;
        real lower = fine_bound(&d, n, &c), high = fine_length(w, low);
        if (is_fine(q, g, lower, high) && (g->sign_only || is_inside(q, weight, sub(add(w, low), v)))) {
            q->lower = lower;
            q->normal = n;
            q->fine = 1;
            if (!g->sign_only) q->apart = height_to_twice(v, w, low);
            *upper = smaller(*upper, high);
            return 1;
        }
        int taken = q->steps < g->max_steps && take_corner(q, &c);
        certify(q, weight);
        if (!taken) return 0;
    }
    return 0;
}

#endif
