/* SPDX-License-Identifier: MIT */
/* A simplex of the difference A - B and its point nearest the origin.
 *
 * simplex2.h and simplex3.h give, each for its dimension:
 *   nearest     drops the corners that do not carry the nearest point, and weighs the others; the newest corner is
 *               known to carry it
 *   part        the nearest point of one part of the simplex and its weights, if it is in that part's interior
 *   square_to   what of a vector is square to all edges
 *   change      of the weights, when the point that they single out moves
 *   room        a full simplex: how far the origin is inside, after rounding; not above 0 where that is not certain
 *   rough_room  the same, by the weights with which it holds the origin: cheaper, and less where it is narrow
 * The nearest point of a face (2-D: of an edge) comes from its normal, v = n (n.p) / (n.n), not from a weighted sum of
 * corners: that sum's rounding error stops the search on the wrong face once the gap is small. */
#ifndef GJK_CORE_SIMPLEX_H
#define GJK_CORE_SIMPLEX_H

#include "words.h"

#if DIM == 2
#include "simplex2.h"
#else
#include "simplex3.h"
#endif

#define ALL_CORNERS ((2u << DIM) - 1)

/* Whether the origin is in the full simplex, however narrow: determinants of such a one are noise, its corners' shares
 * in the origin are those of a simplex that is next to it. */
static int holds_narrowly(const simplex *s)
{
    vec p = point(s, DIM), edge[DIM];
    real last = 1;
    int r = 1;
    for (int i = 0; i < DIM; i++) edge[i] = sub(point(s, i), p);
    vec share = shares_of(edge, mul(p, -1));
    EACH(last -= share.c[i]; r &= share.c[i] > 0);
    return r && last > 0;
}

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
        if ((mask & required) != required) continue;
        if (!part(s, mask, noise > 0 ? 16 * UNIT : 0, &p, weight) && !(mask == ALL_CORNERS && holds_narrowly(s)))
            continue;
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
    for (int i = 1; i <= DIM; i++) weight[i] = 0;
    weight[0] = 1;
    if (s->n == 1) return;
    vec v;
    part(s, (1u << s->n) - 1, 0, &v, weight);
    normalize(weight, s->n);
}

/* Of a vertex: w, x or y, by its offset. */
static inline vec member_of(const vertex *p, size_t member)
{
    return *(const vec *)(const void *)((const char *)p + member);
}

/* The weighted sum of the corners' w; of their x or y, times their grain, which keeps it in range. */
static vec blend(const simplex *s, const real weight[DIM + 1], size_t member, real grain)
{
    vec r = axis(0, 0);
    for (int i = 0; i < s->n; i++) r = add(r, mul(mul(member_of(corner(s, i), member), grain), weight[i]));
    return r;
}

#endif
