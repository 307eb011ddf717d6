/* SPDX-License-Identifier: MIT */
/* Equal inputs give equal bits: on every machine, by every compiler, at every setting that leaves IEEE arithmetic as it
 * is. Thousands of pairs are drawn by +, -, *, / and sqrt alone, which are the same everywhere; what the library
 * answers is folded into a number for each question, and these are known. It needs nothing but the library and this
 * folder, so that it can be taken to another machine: tests/machines.sh. A change that means to change bits puts the
 * new numbers below. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <gjk/gjk.h>
#include "splitmix.h"

#define DIM VARIANT_DIM
#if VARIANT_DIM == 3 && !VARIANT_FLOAT
#define V(name) gjk3_##name
static const uint64_t known[3] = {0x0068c7100a52d43e, 0x5f982e609b2c2620, 0x2d61f908852d56e3};
#elif VARIANT_DIM == 3
#define V(name) gjk3f_##name
static const uint64_t known[3] = {0xf5cdda6920206129, 0xaf4da97594e4e55d, 0xbec5819e5c75685b};
#elif !VARIANT_FLOAT
#define V(name) gjk2_##name
static const uint64_t known[3] = {0xd21dea2afb8d2d1a, 0xa0618e74e740d4bd, 0x2798a1ca31a9b3bf};
#else
#define V(name) gjk2f_##name
static const uint64_t known[3] = {0x1d2279c7b6c22ef0, 0x29ff7100e0ad5ddb, 0x7460e7af7b723296};
#endif
#if VARIANT_FLOAT
typedef float real;
#else
typedef double real;
#endif

#define PAIRS 3000
#define MOST_POINTS 100

typedef struct body {
    union {
        V(points) points;
        V(box) box;
        V(segment) segment;
        V(ball) ball;
        V(ellipsoid) ellipsoid;
#if DIM == 3
        V(triangle) triangle;
        V(cylinder) cylinder;
        V(cone) cone;
#endif
    } set;
    real v[MOST_POINTS][DIM];
    V(pose) pose;
    V(shape) shape;
} body;

static uint64_t state_of_draws;
static body a, b;

static uint64_t draw(void) { return splitmix64(&state_of_draws); }

static int below(int n) { return (int)(draw() % (uint64_t)n); }

/* From -1 to 1. */
static real any(void) { return (real)((double)(int64_t)(draw() >> 11) / 4503599627370496.0 - 1); }

static real any_size(void) { return (real)0.25 + any() * any(); }

/* ---- bodies ---- */

static void draw_points(body *k)
{
    int count = below(4) == 0 ? MOST_POINTS : 1 + below(16);
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < DIM; j++) {
            k->v[i][j] = any();
        }
    }
    k->set.points = (V(points)){k->v[0], (size_t)count, 0, 0, 0};
    k->set.points.reach = V(points_reach)(&k->set.points);
    k->shape.support = V(support_points);
}

static void draw_set(body *k)
{
    real *sizes = (real *)(void *)&k->set;
    int kind = below(DIM == 3 ? 10 : 7);
    for (int i = 0; i < 9; i++) { /* as many as a triangle has */
        sizes[i] = kind == 3 || kind == 7 ? any() : (real)0.1 + any_size() * any_size();
    }
    k->shape.data = &k->set;
    k->shape.radius = below(3) == 0 ? any_size() * any_size() : 0;
    switch (kind) {
    case 0:
    case 1:
        k->shape.support = V(support_box);
        break;
    case 2:
        k->shape.support = V(support_ellipsoid);
        break;
    case 3:
        k->shape.support = V(support_segment);
        break;
    case 4:
        k->shape.support = V(support_ball);
        break;
#if DIM == 3
    case 7:
        k->shape.support = V(support_triangle);
        break;
    case 8:
        k->shape.support = V(support_cylinder);
        break;
    case 9:
        k->shape.support = V(support_cone);
        break;
#endif
    default:
        draw_points(k);
    }
}

/* A rotation, or any map; rarely to be left out. */
static void draw_pose(body *k, real far)
{
    real *m = k->pose.m, q[4], whole = 0;
    for (int i = 0; i < DIM; i++) {
        k->pose.p[i] = far * any();
    }
    for (int i = 0; i < 4; i++) {
        q[i] = any();
        whole += q[i] * q[i];
    }
    for (int i = 0; i < 4; i++) {
        q[i] /= (real)sqrt((double)whole);
    }
#if DIM == 3
    m[0] = 1 - 2 * (q[2] * q[2] + q[3] * q[3]);
    m[1] = 2 * (q[1] * q[2] - q[0] * q[3]);
    m[2] = 2 * (q[1] * q[3] + q[0] * q[2]);
    m[3] = 2 * (q[1] * q[2] + q[0] * q[3]);
    m[4] = 1 - 2 * (q[1] * q[1] + q[3] * q[3]);
    m[5] = 2 * (q[2] * q[3] - q[0] * q[1]);
    m[6] = 2 * (q[1] * q[3] - q[0] * q[2]);
    m[7] = 2 * (q[2] * q[3] + q[0] * q[1]);
    m[8] = 1 - 2 * (q[1] * q[1] + q[2] * q[2]);
#else
    m[0] = m[3] = 1 - 2 * q[0] * q[0];
    m[2] = 2 * q[0] * (real)sqrt((double)(1 - q[0] * q[0]));
    m[1] = -m[2];
#endif
    if (below(4) == 0) {
        for (int i = 0; i < DIM * DIM; i++) {
            m[i] += any();
        }
    }
    k->shape.pose = below(8) == 0 ? NULL : &k->pose;
}

/* ---- what is answered ---- */

/* FNV-1a, byte by byte from the lowest, whichever way the machine stores them. */
static void fold(uint64_t *sum, const void *number, size_t bytes)
{
    uint64_t x = 0;
    uint32_t half = 0;
    if (bytes == 8) {
        memcpy(&x, number, 8);
    } else {
        memcpy(&half, number, 4);
        x = half;
    }
    for (size_t i = 0; i < bytes; i++) {
        *sum = (*sum ^ (x >> 8 * i & 255)) * 1099511628211u;
    }
}

static void fold_result(uint64_t *sum, const V(result) * r)
{
    const real *numbers = &r->value;
    for (size_t i = 0; i < 3 + 3 * DIM; i++) {
        fold(sum, numbers + i, sizeof(real));
    }
    fold(sum, &r->status, sizeof r->status);
    fold(sum, &r->steps, sizeof r->steps);
    fold(sum, &r->supports, sizeof r->supports);
}

typedef int question(const V(shape) *, const V(shape) *, const V(options) *, V(result) *);

/* Cold, once more with what that has left, and with all that can be asked. */
static void ask(question *f, uint64_t *sum)
{
    V(cache) cache;
    V(options) o;
    V(result) r;
    memset(&cache, 0, sizeof cache);
    memset(&o, 0, sizeof o);
    o.size = (uint32_t)sizeof o;
    o.cache = &cache;
    for (int i = 0; i < 3; i++) {
        memset(&r, 0, sizeof r);
        o.tight = i == 2;
        f(&a.shape, &b.shape, &o, &r);
        fold_result(sum, &r);
    }
}

/* Moves b along the normal to about contact, or not. */
static void bring_near(void)
{
    V(result) r;
    if (V(penetration)(&a.shape, &b.shape, NULL, &r) < 0) {
        return;
    }
    const real left = below(2) ? 0 : (real)1e-4 * any();
    for (int i = 0; i < DIM; i++) {
        b.pose.p[i] += (left - r.value) * r.normal[i];
    }
}

int main(void)
{
    question *const asked[3] = {V(distance), V(intersect), V(penetration)};
    static const char *const name[3] = {"distance", "intersect", "penetration"};
    uint64_t sum[3] = {14695981039346656037u, 14695981039346656037u, 14695981039346656037u};
    int same = 1;
    for (int i = 0; i < PAIRS; i++) {
        draw_set(&a);
        draw_set(&b);
        draw_pose(&a, 1);
        draw_pose(&b, (real)(1 + below(3)));
        if (below(2)) {
            bring_near();
        }
        for (int q = 0; q < 3; q++) {
            ask(asked[q], &sum[q]);
        }
    }
    for (int q = 0; q < 3; q++) {
        printf("%-12s 0x%016llx%s\n", name[q], (unsigned long long)sum[q], sum[q] == known[q] ? "" : ": not as known");
        same &= sum[q] == known[q];
    }
    return !same;
}
