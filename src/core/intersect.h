/* SPDX-License-Identifier: MIT */
/* Overlap where the search ends on its origin, or with it inside a simplex too thin to say: a ball around the origin is
 * in A - B if the corners of a simplex around that ball are. So each of these corners in turn is the origin of a
 * search; all come within a share of the ball's radius, and the sets overlap for certain; or one is proven to be
 * outside, and the sets are as good as touching. No face is ever asked for its side. */
#ifndef GJK_CORE_INTERSECT_H
#define GJK_CORE_INTERSECT_H

#include "distance.h"

/* Corner k of a simplex that holds the unit ball around the origin; none is farther out than 4. */
static vec outpost(int k)
{
#if DIM == 2
    static const real corners[3][2] = {{0, 2}, {2, -1}, {-2, -1}};
#else
    static const real corners[4][3] = {{2, 2, 2}, {2, -2, -2}, {-2, 2, -2}, {-2, -2, 2}};
#endif
    return load(corners[k]);
}

/* Moves the origin of the search to c. */
static void move(search *q, vec c)
{
    q->d.c = c;
    for (int i = 0; i < q->s.n; i++) {
        vertex *p = &q->s.slot[q->s.at[i]];
        p->w = corner_of(&q->d, p->x, p->y);
    }
    project(q, 1);
    q->lower = -REAL_MAX;
    q->repeated = 0;
    q->sidesteps = 0;
}

/* The points of the bodies that the simplex's weights make, times their grain, as one corner. */
static vertex point_made(const search *q, const real weight[DIM + 1])
{
    return (vertex){.x = blend(&q->s, weight, offsetof(vertex, x), q->d.a.grain),
                    .y = blend(&q->s, weight, offsetof(vertex, y), q->d.b.grain)};
}

/* probe with a ball of radius r; STILL: it is too small for the noise of the corners. */
static enum end probe_ball(search *q, real r, int max_steps, real *upper, simplex *around)
{
    search p = *q;
    real weight[DIM + 1];
    goal g = {.within = (real)0.75 * r, .abs_tol = -1, .early = 1, .max_steps = max_steps};
    enum end end = WITHIN;
    for (int k = 0; k <= DIM; k++) {
        vec t = mul(outpost(k), r);
        move(&p, add(q->d.c, t));
        if (certify(&p, weight) < g.within) end = WITHIN;
        else if (p.s.n > DIM) end = INSIDE;
        else if (p.steps >= max_steps) end = OPEN;
        else end = look(&p) ? descend(&p, &g) : FAULT;
        if (end == INSIDE && room(&p.s) > p.d.doubt) end = WITHIN;
        if (end == INSIDE || end == STILL) end = certify(&p, weight) < g.within ? WITHIN : STILL;
        real lower = p.lower - dot(p.normal, t) - 32 * UNIT * r;
        if (end == BEYOND && lower > q->lower) {
            q->lower = lower;
            q->normal = p.normal;
        }
        if (end != WITHIN) break;
        certify(&p, weight);
        around->slot[k] = point_made(&p, weight);
    }
    q->steps = p.steps;
    q->d.calls = p.d.calls;
    if (end == WITHIN) *upper = smaller(*upper, g.within - r);
    return end;
}

/* The points by the ball's corners, around the origin, tell a point of both that is one to more digits than that of the
 * search, which is too thin or too far off, if that is so. These are no corners: the cache is to stay, and what is left
 * to do is to place them, of which the grain is now 1. */
static void stand_among(search *q, simplex *around, real weight[DIM + 1])
{
    real share[DIM + 1];
    around->n = DIM + 1;
    for (int k = 0; k <= DIM; k++) {
        vertex *p = &around->slot[k];
        around->at[k] = k;
        p->w = corner_at(&q->d, p->x, p->y);
    }
    weigh(around, share);
    const vec off = blend(around, share, offsetof(vertex, w), 1), was = blend(&q->s, weight, offsetof(vertex, w), 1);
    if (!(dot(off, off) < dot(was, was))) return;
    q->s = *around;
    q->d.a.grain = q->d.b.grain = 1;
    q->kept = 1;
    memcpy(weight, share, sizeof share);
}

/* The search has ended on its origin. WITHIN: the sets overlap, by -upper at least. BEYOND: q's lower bound has risen
 * to no more than 4 balls below 0. OPEN: max_steps are used up. STILL: no ball told. The least ball is of 2 doubt,
 * since any point of it can be certified no better than to 1; one so small may drown in the noise of the corners. Of a
 * ball told, around are the points by its corners. */
static enum end probe(search *q, int max_steps, real *upper, simplex *around)
{
    enum end end = STILL;
    for (int r = 2; end == STILL && r <= 128; r *= 8)
        end = probe_ball(q, (real)r * q->d.doubt, max_steps, upper, around);
    return end;
}

#endif
