/* SPDX-License-Identifier: MIT */
/* A simplex of the difference A - B and its point nearest the origin.
 *
 * simplex2.h and simplex3.h give, each for its dimension:
 *   nearest     drops the corners that do not carry the nearest point; the newest corner is known to carry it
 *   part        the nearest point of one part of the simplex, if it is in that part's interior
 *   square_to   what of a vector is square to all edges
 *   change      of the weights on the corners, when the point they single out moves
 *   proportion  the nearest point's weights on the corners that are left
 *   room        a full simplex: how far the origin is inside, after rounding; not above 0 where that is not certain
 * and both nearest points come from the face's normal, v = n (n.p) / (n.n), not from a weighted sum of corners: the
 * sum's rounding error stops the search on the wrong face once the gap is small. */
#ifndef GJK_CORE_SIMPLEX_H
#define GJK_CORE_SIMPLEX_H

#include "linear.h"

typedef struct vertex {
    vec w;    /* of the difference, in the search's frame and scale */
    vec x, y; /* of A and of B, each in its own coordinates */
} vertex;

typedef struct simplex {
    vertex slot[DIM + 1];
    int at[DIM + 1]; /* slots of the corners, the newest last; then the free slots */
    int n;
} simplex;

static inline void clear(simplex *s)
{
    for (int i = 0; i <= DIM; i++) s->at[i] = i;
    s->n = 0;
}

static inline const vertex *corner(const simplex *s, int i) { return &s->slot[s->at[i]]; }
static inline vec point(const simplex *s, int i) { return s->slot[s->at[i]].w; }

/* Where the next corner goes, to be one of the simplex once n is raised. */
static inline vertex *spare(simplex *s) { return &s->slot[s->at[s->n]]; }

/* Keeps the corners i of the mask, in their order; the slots of the others are free. */
static inline void keep(simplex *s, unsigned mask)
{
    int dropped[DIM + 1], k = 0, n = 0;
    for (int i = 0; i < s->n; i++) {
        if (mask >> i & 1) s->at[k++] = s->at[i];
        else dropped[n++] = s->at[i];
    }
    s->n = k;
    for (int i = 0; i < n; i++) s->at[k + i] = dropped[i];
}

/* Where the origin projects onto the line through p and q, if that is between them, or beyond by no more than the
 * leeway, a share of the whole. The weights, here and in what follows, are in proportion; their sum is not 1. */
static inline int edge(vec p, vec q, real leeway, vec *v, real weight[2])
{
    vec e = sub(q, p);
    real from_p = -dot(p, e), from_q = dot(q, e), l = dot(e, e);
    weight[0] = from_q;
    weight[1] = from_p;
    if (!(from_p > -leeway * l) || !(from_q > -leeway * l) || !(l > 0)) return 0;
#if DIM == 2
    vec n = {{-e.c[1], e.c[0]}};
    *v = mul(n, dot(n, from_p < from_q ? p : q) / l);
#else
    *v = from_p < from_q ? add(p, mul(e, from_p / l)) : sub(q, mul(e, from_q / l));
    *v = sub(*v, mul(e, dot(*v, e) / l)); /* square to the edge by v's measure, not just by p's */
#endif
    return 1;
}

/* How near the line from p along e comes to the origin for positive steps: the decrease of the squared distance. */
static inline real gain(vec p, vec e)
{
    real t = -dot(p, e);
    return t > 0 ? t * (t / dot(e, e)) : 0;
}

static inline vec nearest_on_edge(const simplex *s, int i, int j, unsigned *mask)
{
    real weight[2];
    vec v;
    if (edge(point(s, i), point(s, j), 0, &v, weight)) {
        *mask = 1u << i | 1u << j;
        return v;
    }
    *mask = 1u << j;
    return point(s, j);
}

#if DIM == 2
#include "simplex2.h"
#else
#include "simplex3.h"
#endif

/* The least of all parts of the simplex that have the required corners, tried one by one: slower than nearest, and free
 * of assumptions. The whole of it counts as a part only if asked for. Drops the other corners.
 *
 * With noise, in squared distance, a part also serves where its plane's nearest point is outside it by a rounding, and
 * of parts that are equal to within the noise the one with more corners is taken: in truth it is never the farther one.
 */
static vec nearest_of_all(simplex *s, unsigned required, int whole, real noise)
{
    unsigned best = 0, end = (1u << s->n) - (whole ? 0 : 1);
    real least = 0;
    vec v = axis(0, 0);
    for (unsigned mask = 1; mask < end; mask++) {
        vec p;
        real weight[DIM + 1];
        if ((mask & required) != required || !part(s, mask, noise > 0 ? 16 * UNIT : 0, &p, weight)) continue;
        real d = dot(p, p);
        for (int i = 0; i < s->n; i++) d -= mask >> i & 1 ? noise : 0;
        if (best != 0 && !(d < least)) continue;
        best = mask;
        least = d;
        v = p;
    }
    keep(s, best);
    return v;
}

/* None negative, their sum 1 to rounding. */
static void normalize(real weight[DIM + 1], int n)
{
    real sum = 0;
    for (int i = 0; i < n; i++) {
        weight[i] = weight[i] > 0 ? weight[i] : 0;
        sum += weight[i];
    }
    for (int i = 0; i < n; i++) weight[i] = sum > 0 ? weight[i] / sum : (real)(i == n - 1);
}

/* The nearest point's weights. */
static void weigh(const simplex *s, real weight[DIM + 1])
{
    for (int i = 0; i <= DIM; i++) weight[i] = 0;
    vec v;
    part(s, (1u << s->n) - 1, 0, &v, weight);
    normalize(weight, s->n);
}

/* Of a vertex: w, x or y, by its offset. */
static inline vec member_of(const vertex *p, size_t member)
{
    return *(const vec *)(const void *)((const char *)p + member);
}

/* The weighted sum of the corners' w, x or y. */
static vec blend(const simplex *s, const real weight[DIM + 1], size_t member)
{
    vec r = axis(0, 0);
    for (int i = 0; i < s->n; i++) r = add(r, mul(member_of(corner(s, i), member), weight[i]));
    return r;
}

#endif
