/* SPDX-License-Identifier: MIT */
/* The truth about a pair of bodies, in 113 bits and with its proof: a bracket of the signed separation, closed by
 * one point pair from above and one plane pair from below, each checked against every vertex. It shares nothing
 * with the library. Coordinates here are relative to the origin of body a. */
#ifndef TRUTH_H
#define TRUTH_H

#include "sets.h"

/* What rounding scales with: the maps' norms times the sets' reaches, the offset, the radii. */
static inline double span_of(const body *b)
{
    real dir[DIM] = {1}, x[DIM];
    double sum = 0, reach = (double)b->shape.support(b->shape.data, dir, x);
    for (int i = 0; i < DIM * DIM; i++) {
        sum += (double)b->pose.m[i] * (double)b->pose.m[i];
    }
    return sqrt(sum) * reach + (double)b->shape.radius;
}

static inline double span_of_pair(const body *a, const body *b)
{
    double sum = span_of(a) + span_of(b);
    for (int i = 0; i < DIM; i++) {
        sum += fabs((double)b->pose.p[i] - (double)a->pose.p[i]);
    }
    return sum;
}

typedef struct view {
    int count; /* of vertices; 0: a round body, asked through its formulas */
    quad v[MAX_VERTICES][DIM];
    double near[MAX_VERTICES][DIM]; /* the vertices rounded, to find out quickly which can be the farthest */
    double size;                    /* the largest |coordinate| */
    const body *body;
    quad origin[DIM];
    quad unit; /* what the coordinates here are multiples of: a power of two */
} view;

#define T double
#define N(name) double_##name
#define FLAT 1e-13
#define OUTSIDE 1e-12
#define ENOUGH 1e-15
static inline double double_root(double x) { return sqrt(x); }
#include "slow_gjk.h"

#define T quad
#define N(name) quad_##name
#define FLAT 1e-30
#define OUTSIDE 1e-30
#define ENOUGH 1e-28
static inline quad quad_root(quad x) { return quad_sqrt(x); }
#include "slow_gjk.h"

/* ---- farthest points ---- */

/* The core of the body, without its radius, as seen from an origin. */
static void see(view *v, const body *b, const quad *origin)
{
    quad x[DIM];
    v->body = b;
    v->count = list_vertices(b, v->v);
    v->size = 0;
    v->unit = 1;
    memcpy(v->origin, origin, sizeof v->origin);
    for (int k = 0; k < v->count; k++) {
        memcpy(x, v->v[k], sizeof x);
        posed(&b->pose, origin, x, v->v[k]);
        for (int i = 0; i < DIM; i++) {
            v->size = fmax(v->size, fabs((double)v->v[k][i]));
        }
    }
    for (int k = 0; k < 2 * DIM && v->count == 0; k++) {
        quad dir[DIM] = {0};
        dir[k / 2] = k % 2 ? -1 : 1;
        farthest_of_body(b, origin, 0, dir, x);
        v->size = fmax(v->size, fabs((double)x[k / 2]));
    }
}

/* Goes over to coordinates that count the unit. */
static void count_in(view *v, quad unit)
{
    v->unit = unit;
    v->size = (double)((quad)v->size / unit);
    for (int k = 0; k < v->count; k++) {
        for (int i = 0; i < DIM; i++) {
            v->v[k][i] /= unit;
            v->near[k][i] = (double)v->v[k][i];
        }
    }
}

static int double_farthest(const view *v, const double *dir, double *point)
{
    double best = 0;
    int at = 0;
    for (int k = 0; k < v->count; k++) {
        double along = double_dot(v->near[k], dir);
        if (k == 0 || along > best) {
            best = along;
            at = k;
        }
    }
    memcpy(point, v->near[at], sizeof v->near[at]);
    return at;
}

/* Among equally far vertices the last along a fixed odd direction: a true vertex of the hull, and the same one for
 * the same face, so that the sets of differences has no points but its vertices. */
static int quad_farthest(const view *v, const quad *dir, quad *point)
{
    static const double odd[3] = {0.7548776662466927, 0.5698402909980532, 0.4301597090019468};
    double along[MAX_VERTICES], rough[DIM], top = 0, margin = 0;
    quad best = 0, best_odd = 0, tie;
    int at = -1;
    if (v->count == 0) {
        farthest_of_body(v->body, v->origin, 0, dir, point);
        for (int i = 0; i < DIM; i++) {
            point[i] /= v->unit;
        }
        return -1;
    }
    for (int i = 0; i < DIM; i++) {
        rough[i] = (double)dir[i];
        margin += fabs(rough[i]) * v->size;
    }
    tie = (quad)margin * (quad)1e-31;
    for (int k = 0; k < v->count; k++) {
        along[k] = double_dot(v->near[k], rough);
        top = k == 0 || along[k] > top ? along[k] : top;
    }
    for (int k = 0; k < v->count; k++) {
        if (along[k] >= top - 4e-15 * margin) {
            quad h = quad_dot(v->v[k], dir), g = 0;
            for (int i = 0; i < DIM; i++) {
                g += v->v[k][i] * (quad)odd[i];
            }
            if (at < 0 || h > best + tie || (h >= best - tie && g > best_odd)) {
                best = h;
                best_odd = g;
                at = k;
            }
        }
    }
    memcpy(point, v->v[at], sizeof v->v[at]);
    return at;
}

/* ---- depth: the polytope of differences grown from within, by its nearest face, until no point lies beyond ---- */

#include "slow_depth.h"

/* ---- both ---- */

typedef struct truth {
    quad lower, upper; /* of the signed separation, radii included */
    quad unit;         /* about the size of the pair; what the views and mid count in */
    quad scale;        /* the largest |coordinate| of the pair, the bodies' own origins included, relative to mid */
    int apart;         /* the cores, without their radii, have no point in common */
    int certified;     /* upper - lower <= 1e-28 of the size; round cores seldom are */
    view a, b;
    quad mid[DIM]; /* a point between the bodies, relative to the origin of a, in units */
} truth;

/* A power of two near x, which is within the range of double; 1 where that is good enough for products in double. */
static quad unit_for(quad x)
{
    int e;
    frexp((double)x, &e);
    return abs(e) < 80 ? 1 : (quad)ldexp(1, e / 2) * (quad)ldexp(1, e - e / 2);
}

static quad scale_of(const truth *t, const body *a, const body *b)
{
    quad scale = 0;
    for (int k = 0; k < 2; k++) {
        const view *v = k ? &t->b : &t->a;
        const body *whole = k ? b : a;
        quad radius = (quad)whole->shape.radius / t->unit, most = 0;
        for (int i = 0; i < v->count; i++) {
            for (int j = 0; j < DIM; j++) {
                quad x = quad_abs(v->v[i][j] - t->mid[j]);
                most = x > most ? x : most;
            }
        }
        for (int i = 0; i < 2 * DIM && v->count == 0; i++) {
            quad dir[DIM] = {0}, x[DIM];
            dir[i / 2] = i % 2 ? -1 : 1;
            quad_farthest(v, dir, x);
            x[0] = quad_abs(x[i / 2] - t->mid[i / 2]);
            most = x[0] > most ? x[0] : most;
        }
        scale = most + radius > scale ? most + radius : scale;
        for (int j = 0; j < DIM; j++) {
            quad x = quad_abs(((quad)whole->pose.p[j] - v->origin[j]) / t->unit - t->mid[j]);
            scale = x > scale ? x : scale;
        }
    }
    return scale * t->unit;
}

/* The simplex where a solver in double ends, for the one in quad to go on from: what it costs is saved, and what it
 * gets wrong is found. */
static void start_from_double(const view *a, const view *b, quad_slow *r)
{
    double_slow d;
    memset(&d, 0, sizeof d);
    double_solve(a, b, a->size + b->size, 60, &d);
    r->count = d.count;
    for (int k = 0; k < d.count; k++) {
        r->s[k].at_a = d.s[k].at_a;
        r->s[k].at_b = d.s[k].at_b;
        memcpy(r->s[k].a, a->v[d.s[k].at_a], sizeof r->s[k].a);
        memcpy(r->s[k].b, b->v[d.s[k].at_b], sizeof r->s[k].b);
        for (int i = 0; i < DIM; i++) {
            r->s[k].w[i] = r->s[k].b[i] - r->s[k].a[i];
        }
    }
}

/* depth: whether the sign below 0 and its size are asked for; otherwise such a pair has lower = -infinity, in effect.
 */
static void find_truth(truth *t, const body *a, const body *b, int depth)
{
    quad origin[DIM], size, error, radius;
    quad_slow r;
    for (int i = 0; i < DIM; i++) {
        origin[i] = (quad)a->pose.p[i];
    }
    see(&t->a, a, origin);
    see(&t->b, b, origin);
    size = (quad)t->a.size + (quad)t->b.size;
    t->unit = unit_for(size);
    count_in(&t->a, t->unit);
    count_in(&t->b, t->unit);
    size /= t->unit;
    radius = ((quad)a->shape.radius + (quad)b->shape.radius) / t->unit;
    error = (size + radius) * (quad)1e-32; /* a hundred roundings, more than the solver makes */
    memset(&r, 0, sizeof r);
    if (t->a.count && t->b.count) {
        start_from_double(&t->a, &t->b, &r);
    }
    quad_solve(&t->a, &t->b, size, t->a.count && t->b.count ? 100 : 60, &r);
    memset(t->mid, 0, sizeof t->mid);
    for (int k = 0; k < r.count; k++) {
        for (int i = 0; i < DIM; i++) {
            t->mid[i] += r.weight[k] * (r.s[k].a[i] + r.s[k].b[i]) / 2;
        }
    }
    t->apart = r.lower > 0;
    t->upper = r.upper - radius;
    t->lower = positive(r.lower) - radius;
    if (!t->apart) {
        t->lower = -4 * size - radius;
        if (depth) {
            quad deep, shallow;
            find_depth(&t->a, &t->b, size, &shallow, &deep);
            t->lower = -deep - radius;
            t->upper = -shallow - radius < t->upper ? -shallow - radius : t->upper;
        }
    }
    t->certified = t->apart || depth ? t->upper - t->lower <= size * (quad)1e-28 : r.upper <= size * (quad)1e-28;
    t->lower = (t->lower - error) * t->unit;
    t->upper = (t->upper + error) * t->unit;
    t->scale = scale_of(t, a, b);
}

#endif
