/* SPDX-License-Identifier: MIT */
/* What simplex.h asks of its dimension, in the plane: points, edges, triangles. */
#ifndef GJK_CORE_SIMPLEX2_H
#define GJK_CORE_SIMPLEX2_H

#include "corners.h"

static inline real cross(vec a, vec b) { return a.c[0] * b.c[1] - a.c[1] * b.c[0]; }

/* The origin's side of each edge against the triangle's own turn. Weights of p, q, r, times twice the area. */
static int holds(const simplex *s, real weight[3])
{
    vec p = point(s, 0), q = point(s, 1), r = point(s, 2);
    weight[0] = cross(q, r);
    weight[1] = cross(r, p);
    weight[2] = cross(p, q);
    if (cross(sub(q, p), sub(r, p)) < 0)
        for (int i = 0; i < 3; i++) weight[i] = -weight[i];
    return weight[0] > 0 && weight[1] > 0 && weight[2] > 0;
}

/* The part of the simplex that the mask picks: its point nearest the origin, if that is in its
 * interior, or outside by no more than the leeway. */
static int part(const simplex *s, unsigned mask, real leeway, vec *v, real weight[3])
{
    int k[3], n = 0;
    weight[0] = 1;
    for (int i = 0; i < s->n; i++)
        if (mask >> i & 1) k[n++] = i;
    *v = n == 1 ? point(s, k[0]) : axis(0, 0);
    if (n == 2) return edge(point(s, k[0]), point(s, k[1]), leeway, v, weight);
    return n == 3 ? holds(s, weight) : 1;
}

/* The newest corner p is in the answer: three weights decide for the triangle, else the better edge at p. */
static void nearest_on_triangle(const simplex *s, footing *f)
{
    f->v = axis(0, 0);
    f->mask = 7;
    if (holds(s, f->weight)) return;
    vec p = point(s, 2);
    nearest_on_edge(s, gain(p, sub(point(s, 1), p)) > gain(p, sub(point(s, 0), p)), 2, f);
}

static vec nearest(simplex *s, real weight[3])
{
    footing f = {point(s, 0), 1, {1}};
    if (s->n == 2) nearest_on_edge(s, 0, 1, &f);
    if (s->n == 3) nearest_on_triangle(s, &f);
    stand_on(s, &f, weight);
    return f.v;
}

static vec square_to(const simplex *s, vec v)
{
    vec e = sub(point(s, 1), point(s, 0)), n = {{-e.c[1], e.c[0]}};
    return s->n == 2 ? mul(n, dot(n, v) / dot(n, n)) : v;
}

static void change(const simplex *s, vec way, real weight[3])
{
    vec p = point(s, 0), a = sub(point(s, 1), p);
    for (int i = 0; i < 3; i++) weight[i] = 0;
    if (s->n == 3) {
        vec edge[2] = {a, sub(point(s, 2), p)}, share = shares_of(edge, way);
        memcpy(weight + 1, share.c, sizeof share.c);
    } else if (s->n == 2) {
        weight[1] = dot(way, a) / dot(a, a);
    }
    weight[0] = -weight[1] - weight[2];
}

static inline real rough_room(const simplex *s, const real weight[3])
{
    vec p = point(s, 0), q = point(s, 1), r = point(s, 2);
    real far = larger(dot(p, p), larger(dot(q, q), dot(r, r))), doubt = 4 * UNIT * far;
    real least = (weight[0] - doubt) / length_or_more(sub(r, q));
    least = smaller((weight[1] - doubt) / length_or_more(sub(p, r)), least);
    return smaller((weight[2] - doubt) / length_or_more(sub(q, p)), least) * (1 - 8 * UNIT);
}

static real room(const simplex *s)
{
    real least = REAL_MAX;
    for (int i = 0; i < 3; i++) {
        vec p = point(s, i), e = sub(point(s, (i + 1) % 3), p), f = sub(point(s, (i + 2) % 3), p);
        real inside = cross(p, e), third = cross(e, f), l = length_or_more(e);
        if (third < 0) inside = -inside;
        /* each product's operands carry a rounding of their own */
        real doubt = 4 * UNIT * l * (length(p) + length(f));
        if (!(size(third) > doubt)) return 0;
        least = smaller((inside - doubt) / l * (1 - 8 * UNIT), least);
    }
    return least;
}

#endif
