/* SPDX-License-Identifier: MIT */
/* The corners of a simplex of the difference A - B, and the edges between them. */
#ifndef GJK_CORE_CORNERS_H
#define GJK_CORE_CORNERS_H

#include "linear.h"

typedef struct vertex {
    vec w;    /* of the difference, in the search's frame and scale */
    vec x, y; /* of A and of B, each in its own coordinates and unit */
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

static inline void swap(int *a, int *b)
{
    const int c = *a;
    *a = *b;
    *b = c;
}

/* Brings the largest coefficient of the edges and rows from k on, in their order, to place k; 0: all are 0. */
static real bring_largest(const vec edge[DIM], int row[DIM], int column[DIM], int k)
{
    int r = k, c = k;
    for (int i = k; i < DIM; i++)
        for (int j = k; j < DIM; j++)
            if (size(edge[column[j]].c[row[i]]) > size(edge[column[c]].c[row[r]])) r = i, c = j;
    swap(&row[k], &row[r]);
    swap(&column[k], &column[c]);
    return edge[column[k]].c[row[k]];
}

/* The shares of the edges that add up to the way: by elimination, of the largest coefficient first, so that they miss
 * it by roundings of the edges and the way, however narrow what these span; determinants do not. Across what they do
 * not span at all they miss it. */
static vec shares_of(vec edge[DIM], vec way)
{
    int row[DIM], column[DIM], n = 0;
    vec r = axis(0, 0);
    for (int i = 0; i < DIM; i++) row[i] = column[i] = i;
    for (; n < DIM; n++) {
        const real pivot = bring_largest(edge, row, column, n);
        if (!(size(pivot) > 0)) break;
        for (int i = n + 1; i < DIM; i++) {
            const real part = edge[column[n]].c[row[i]] / pivot;
            for (int j = n; j < DIM; j++) edge[column[j]].c[row[i]] -= part * edge[column[j]].c[row[n]];
            way.c[row[i]] -= part * way.c[row[n]];
        }
    }
    while (n-- > 0) {
        real left = way.c[row[n]];
        for (int j = n + 1; j < DIM; j++) left -= edge[column[j]].c[row[n]] * r.c[column[j]];
        r.c[column[n]] = left / edge[column[n]].c[row[n]];
    }
    return r;
}

/* By how much a walk from p along e can bring the squared distance down; 0 where e leads away. */
static inline real gain(vec p, vec e)
{
    real t = -dot(p, e);
    return t > 0 ? t * (t / dot(e, e)) : 0;
}

/* The simplex's point nearest the origin, which corners carry it, and their weights, by corner. */
typedef struct footing {
    vec v;
    unsigned mask;
    real weight[DIM + 1];
} footing;

static inline void nearest_on_edge(const simplex *s, int i, int j, footing *f)
{
    real weight[2];
    if (edge(point(s, i), point(s, j), 0, &f->v, weight)) {
        f->mask = 1u << i | 1u << j;
        f->weight[i] = weight[0];
        f->weight[j] = weight[1];
        return;
    }
    f->v = point(s, j);
    f->mask = 1u << j;
    f->weight[j] = 1;
}

/* Leaves the corners that carry it, with their weights. */
static inline void stand_on(simplex *s, const footing *f, real weight[DIM + 1])
{
    int n = 0;
    if (f->mask == (1u << s->n) - 1) {
        memcpy(weight, f->weight, sizeof f->weight);
        return;
    }
    for (int i = 0; i < s->n; i++)
        if (f->mask >> i & 1) weight[n++] = f->weight[i];
    keep(s, f->mask);
}

#endif
