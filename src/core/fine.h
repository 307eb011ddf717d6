/* SPDX-License-Identifier: MIT */
/* Cores that are known by their corners, and apart by so little that rounded corners hardly tell: v worked out anew,
 * the height of the lowest corners along it and the length of the pair that goes with it, all to twice the digits. The
 * bounds prove themselves, however v was come by; where they do not tell enough, the exact finish does. */
#ifndef GJK_CORE_FINE_H
#define GJK_CORE_FINE_H

#include "contact.h"

/* A corner that v has not met yet is taken in so often. */
#define FINE_ROUNDS 4

/* How far from their bodies' own positions the simplex's points lie: no more than the bodies' size, which may be far
 * below the frame's where points far out are mapped near. */
static real size_of_points(const search *q)
{
    real r = 0;
    for (int i = 0; i < q->s.n; i++) {
        const vertex *p = corner(&q->s, i);
        r = larger(peak(place(&q->d.a, p->x)), larger(peak(place(&q->d.b, p->y)), r));
    }
    return r;
}

/* They tell the sign, the radii taken off; and where the distance is wanted, that to two roundings of the bodies. */
static int is_fine(const search *q, const goal *g, real lower, real upper)
{
    real near = g->radius * q->d.scale;
    int told = lower > near + 4 * UNIT * near || (lower > 0 && upper < near - 4 * UNIT * near);
    return told && (g->sign_only || upper - lower <= 2 * UNIT * smaller(size_of_points(q), 1));
}

/* The corner in that slot to twice the digits: w rounded once, and what that takes away. */
static void polish(search *q, int slot, vec low[DIM + 1])
{
    vertex *p = &q->s.slot[slot];
    vec lost = lost_of(q, p);
    for (int i = 0; i < DIM; i++) {
        twin t = sum_of(p->w.c[i], lost.c[i]);
        p->w.c[i] = t.high;
        low[slot].c[i] = t.low;
    }
}

/* Puts a corner that was found, not asked for, where the next one goes. */
static void put_spare(search *q, const vertex *c, vec low[DIM + 1])
{
    q->borrowed &= ~(1u << q->s.at[q->s.n]);
    *spare(&q->s) = *c;
    spare(&q->s)->w = corner_of(&q->d, c->x, c->y);
    polish(q, q->s.at[q->s.n], low);
}

static void count_step(search *q)
{
    q->steps++;
    q->d.calls += 2;
}

/* Takes in a corner farther along the way than the simplex. 0: it is none, or v comes no nearer by it. */
static int take_corner(search *q, const vertex *c, vec low[DIM + 1])
{
    for (int i = 0; i < q->s.n; i++)
        if (repeats(corner(&q->s, i), c)) return 0;
    put_spare(q, c, low);
    count_step(q);
    return advance(q) && q->s.n <= DIM && !vanished(q);
}

/* Goes on from the corners as they are now, and with c. 0: nothing comes of it. */
static int come_nearer(search *q, const goal *g, const vertex *c, vec low[DIM + 1], int anew)
{
    int before = q->s.n;
    if (anew) project(q, 1);
    int taken = q->steps < g->max_steps && take_corner(q, c, low);
    return taken || q->s.n < before;
}

static vec low_of(const search *q, const vec low[DIM + 1], int i) { return low[q->s.at[i]]; }

/* The point of A - B that the weights single out, to twice the digits: the heaviest corner, and shares of the ways from
 * there. It is in A - B: the shares add up to no more than 3/4, as none is above that of the corner they start from. */
static vec fine_point(const search *q, const vec low[DIM + 1], const real weight[DIM + 1], vec *rest)
{
    int from = 0;
    for (int k = 1; k < q->s.n; k++) from = weight[k] > weight[from] ? k : from;
    vec r, at = point(&q->s, from), at_low = low_of(q, low, from);
    for (int i = 0; i < DIM; i++) {
        twin t = {at.c[i], at_low.c[i]};
        for (int k = 0; k < q->s.n; k++) {
            if (k == from) continue;
            twin e = sum_of(point(&q->s, k).c[i], -at.c[i]);
            gather(&t, product_of(weight[k], e.high));
            t.low += weight[k] * (e.low + (low_of(q, low, k).c[i] - at_low.c[i]));
        }
        t = sum_of(t.high, t.low);
        r.c[i] = t.high;
        rest->c[i] = t.low;
    }
    return r;
}

/* v made square to the simplex, with edges that rounding took nothing from: of a point that is known to twice the
 * digits as good as it can be spelled. */
static vec square_to_edges(const search *q, const vec low[DIM + 1], vec v)
{
    simplex edges = q->s;
    if (q->s.n == 1) return v;
    for (int i = 1; i < q->s.n; i++)
        edges.slot[q->s.at[i]].w =
            add(sub(point(&q->s, i), point(&q->s, 0)), sub(low_of(q, low, i), low_of(q, low, 0)));
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

/* The simplex holds the origin for certain: the cores meet. */
static void note_meeting(search *q, real *upper)
{
    q->pending = 0;
    q->met = q->fine = 1;
    q->apart = (twin){0, 0};
    *upper = smaller(*upper, 0);
}

/* Whether a facet and the corner that lies beyond the origin as seen from there hold it. */
static int settle_beyond(search *q, const vertex *c, vec low[DIM + 1], real weight[DIM + 1], real *upper)
{
    simplex *s = &q->s;
    spans w[DIM + 1];
    put_spare(q, c, low);
    s->n++;
    for (int k = 0; k <= DIM; k++) {
        vec high = point(s, k), rest = low_of(q, low, k);
        for (int i = 0; i < DIM; i++) w[k].c[i] = (span){high.c[i], rest.c[i], 256 * UNIT * UNIT};
    }
    if (!is_carried(s, w, weight)) {
        s->n--;
        return 0;
    }
    count_step(q);
    note_meeting(q, upper);
    return 1;
}

/* Bounds the cores' separation from both sides. 0: that does not tell enough; the bounds of q and upper are as they
 * were, its simplex and the weights still are those of corners. */
static APART int settle_apart(search *q, const shape *a, const shape *b, const goal *g, real weight[DIM + 1],
                              real *upper)
{
    if ((vanished(q) || q->s.n > DIM) && holds_origin(q, a, b, weight)) {
        note_meeting(q, upper);
        return 1;
    }
    vec low[DIM + 1];
    for (int i = 0; i < q->s.n; i++) polish(q, q->s.at[i], low);
    for (int i = 0; i < FINE_ROUNDS && q->s.n <= DIM; i++) {
        depth d = {.q = q, .a = a, .b = b, .g = g};
        vertex c;
        vec rest, w = fine_point(q, low, weight, &rest), v = square_to_edges(q, low, add(w, rest));
        if (!(dot(v, v) > UNIT * UNIT * UNIT * UNIT)) return 0;
        vec n = mul(v, -1 / length(v));
        real lower = fine_bound(&d, n, &c), high = fine_length(w, rest);
        if (is_fine(q, g, lower, high) && (g->sign_only || is_inside(q, weight, sub(add(w, rest), v)))) {
            q->lower = lower;
            q->normal = n;
            q->fine = 1;
            if (!g->sign_only) q->apart = height_to_twice(v, w, rest);
            *upper = smaller(*upper, high);
            return 1;
        }
        int may_hold = q->s.n == DIM && lower < 0 && q->steps < g->max_steps;
        if (may_hold && settle_beyond(q, &c, low, weight, upper)) return 1;
        int nearer = come_nearer(q, g, &c, low, i == 0);
        certify(q, weight);
        if (!nearer) return 0;
    }
    return 0;
}

#endif
