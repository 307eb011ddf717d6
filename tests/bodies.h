/* SPDX-License-Identifier: MIT */
/* A body is a shape together with everything it points to, so that the tests can also look inside. */
#ifndef BODIES_H
#define BODIES_H

#include "variant.h"

#define MAX_POINTS 64 /* in a body; a cloud has its points elsewhere */

enum kind {
    POINTS,
    BOX,
    SEGMENT,
    TRIANGLE, /* from here to DISC only in 3-D, BALL apart */
    CYLINDER,
    CONE,
    DISC,
    BALL,
    ORIGIN,
    SUM,
    HULL,
    CLOUD, /* points by the thousand, which stay where they are when the body is copied */
    ELLIPSOID
};

typedef struct body {
    enum kind kind;
    int count;                  /* of points */
    real v[MAX_POINTS][DIM];    /* points, segment, triangle */
    const real *cloud;          /* cloud: its coordinates, point by point, */
    const uint32_t *index;      /*   and their index, if they have one */
    real half[DIM];             /* box, ellipsoid */
    real radius, half_length;   /* ball, cylinder, cone, disc; the rounding is shape.radius */
    const struct body *part[2]; /* sum, hull */
    V(pose) pose;
    V(shape) shape; /* from here on: set by bind */
    union {
        V(points) points;
        V(indexed_points) indexed;
        V(box) box;
        V(segment) segment;
        V(ball) ball;
        V(ellipsoid) ellipsoid;
        V(couple) couple;
#if DIM == 3
        V(triangle) triangle;
        V(cylinder) cylinder;
        V(cone) cone;
        V(disc) disc;
#endif
    } set;
} body;

static inline void start_body(body *b, enum kind kind)
{
    memset(b, 0, sizeof *b);
    b->kind = kind;
    for (int i = 0; i < DIM; i++) {
        b->pose.m[i * DIM + i] = 1;
    }
}

/* The coordinates of a body that is spelled by its points. */
static inline const real *points_of(const body *b) { return b->kind == CLOUD ? b->cloud : b->v[0]; }

/* Whether the body is spelled by its corners: tight answers are promised for these, with a radius or without. */
static inline int has_corners(const body *b)
{
    return b->kind == POINTS || b->kind == CLOUD || b->kind == SEGMENT || b->kind == TRIANGLE || b->kind == BOX ||
           b->kind == ORIGIN;
}

static inline int is_couple(const body *b) { return b->kind == SUM || b->kind == HULL; }

/* Makes b->shape speak of b. Again after each copy of a body, parts first. */
static inline void bind(body *b)
{
    b->shape.data = &b->set;
    b->shape.pose = &b->pose;
    switch (b->kind) {
    case POINTS:
    case CLOUD:
        b->shape.support = V(support_points);
        b->set.points.v = points_of(b);
        b->set.points.count = (size_t)b->count;
        b->set.points.stride = 0;
        b->set.points.indexed = 0;
        b->set.points.reach = 0;
        b->set.points.reach = V(points_reach)(&b->set.points);
        if (b->kind == CLOUD && b->index) {
            b->set.points.indexed = 1;
            b->set.indexed.index = b->index;
        }
        break;
    case BOX:
        b->shape.support = V(support_box);
        memcpy(b->set.box.half, b->half, sizeof b->half);
        break;
    case SEGMENT:
        b->shape.support = V(support_segment);
        memcpy(b->set.segment.v, b->v, sizeof b->set.segment.v);
        b->count = 2;
        break;
    case BALL:
        b->shape.support = V(support_ball);
        b->set.ball.radius = b->radius;
        break;
    case ELLIPSOID:
        b->shape.support = V(support_ellipsoid);
        memcpy(b->set.ellipsoid.radii, b->half, sizeof b->half);
        break;
    case ORIGIN:
        b->shape.support = V(support_origin);
        b->shape.data = NULL;
        break;
    case SUM:
    case HULL:
        b->shape.support = b->kind == SUM ? V(support_sum) : V(support_hull);
        b->set.couple.a = b->part[0]->shape;
        b->set.couple.b = b->part[1]->shape;
        break;
#if DIM == 3
    case TRIANGLE:
        b->shape.support = V(support_triangle);
        memcpy(b->set.triangle.v, b->v, sizeof b->set.triangle.v);
        b->count = 3;
        break;
    case CYLINDER:
        b->shape.support = V(support_cylinder);
        b->set.cylinder.radius = b->radius;
        b->set.cylinder.half_length = b->half_length;
        break;
    case CONE:
        b->shape.support = V(support_cone);
        b->set.cone.radius = b->radius;
        b->set.cone.half_length = b->half_length;
        break;
    case DISC:
        b->shape.support = V(support_disc);
        b->set.disc.radius = b->radius;
        break;
#else
    default:
        abort();
#endif
    }
}

/* The shape behind a support that the library does not know, as callers write them. */
static inline real own_support(const void *data, const real *dir, real *point)
{
    const V(shape) *s = data;
    return s->support(s->data, dir, point);
}

static inline V(shape) hidden(const V(shape) * s)
{
    V(shape) r = *s;
    r.support = own_support;
    r.data = s;
    return r;
}

/* Both the origin, where a support of the test's own is to take its place. */
static inline void start_points(body *a, body *b)
{
    start_body(a, ORIGIN);
    start_body(b, ORIGIN);
    bind(a);
    bind(b);
}

static inline void print_numbers(FILE *f, const real *x, int n)
{
    for (int i = 0; i < n; i++) {
        fprintf(f, "%s%.17g", i ? ", " : "[", (double)x[i]);
    }
    fprintf(f, "]");
}

static inline void print_points(FILE *f, const body *b)
{
    for (int i = 0; i < b->count; i++) {
        fprintf(f, "%s", i ? ", " : "[");
        print_numbers(f, points_of(b) + i * DIM, DIM);
    }
    fprintf(f, "]");
}

/* As in the case files. */
static inline void print_body(FILE *f, const body *b)
{
    static const char *const name[] = {"points",    "box",    "segment", "triangle", "cylinder", "cone",     "disc",
                                       "ellipsoid", "points", "sum",     "hull",     "points",   "ellipsoid"};
    real rows[DIM * (DIM + 1)];
    fprintf(f, "{\"shape\": \"%s\"", name[b->kind]);
    if (b->kind == POINTS || b->kind == CLOUD) {
        fprintf(f, ", \"points\": ");
        print_points(f, b);
    } else if (b->kind == SEGMENT || b->kind == TRIANGLE) {
        fprintf(f, ", \"v\": ");
        print_points(f, b);
    } else if (b->kind == BOX) {
        fprintf(f, ", \"half\": ");
        print_numbers(f, b->half, DIM);
    } else if (b->kind == ORIGIN) {
        fprintf(f, ", \"points\": [%s]", DIM == 3 ? "[0, 0, 0]" : "[0, 0]");
    } else if (is_couple(b)) {
        fprintf(f, ", \"a\": ");
        print_body(f, b->part[0]);
        fprintf(f, ", \"b\": ");
        print_body(f, b->part[1]);
    } else if (b->kind == BALL) {
        real radii[3] = {b->radius, b->radius, b->radius};
        fprintf(f, ", \"radii\": ");
        print_numbers(f, radii, DIM);
    } else if (b->kind == ELLIPSOID) {
        fprintf(f, ", \"radii\": ");
        print_numbers(f, b->half, DIM);
    } else {
        fprintf(f, ", \"r\": %.17g, \"half_length\": %.17g", (double)b->radius, (double)b->half_length);
    }
    if (b->shape.radius > 0) {
        fprintf(f, ", \"radius\": %.17g", (double)b->shape.radius);
    }
    for (int i = 0; i < DIM; i++) {
        memcpy(rows + i * (DIM + 1), b->pose.m + i * DIM, DIM * sizeof(real));
        rows[i * (DIM + 1) + DIM] = b->pose.p[i];
    }
    fprintf(f, ", \"pose\": ");
    print_numbers(f, rows, DIM * (DIM + 1));
    fprintf(f, "}");
}

static inline void print_case(FILE *f, const char *query, const body *a, const body *b)
{
    fprintf(f, "{\"dim\": %d, \"precision\": \"%s\", \"query\": \"%s\", \"a\": ", DIM, PRECISION, query);
    print_body(f, a);
    fprintf(f, ", \"b\": ");
    print_body(f, b);
    fprintf(f, "}\n");
}

#endif
