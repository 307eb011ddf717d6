/* SPDX-License-Identifier: MIT */
/* Seeded pairs of bodies by the kinds of trouble they mean. */
#ifndef PAIRS_H
#define PAIRS_H

#include "bodies.h"
#include "draw.h"

#define MOST_POINTS 32 /* in a drawn hull */

enum family {
    HULLS,     /* 4 to 32 points, from deep inside each other to far apart */
    BOXES,     /* turned anyhow */
    STACKS,    /* boxes on a common grid, face on face, edge on edge, or a little apart */
    PARALLEL,  /* boxes face to face, turned by 1e-3 .. 1e-15, gaps 1e-3 .. 1e-13 */
    SLIVERS,   /* needles and plates, 1 : 1e-7 at the worst */
    LATTICES,  /* small whole coordinates */
    REPEATED,  /* points twice, on one line, in one plane */
    RATIOS,    /* sizes up to 1 : 1e9 */
    CLOSE,     /* hulls and boxes with gaps 1e-3 .. 1e-13, corner to face, corner to corner, and into each other */
    FAR_OUT,   /* both at 1e2 .. 1e7 from the origin */
    DISTANT,   /* sizes small beside the way from one to the other, 1 : 1e9 at the worst */
    IDENTICAL, /* one body twice, the second time moved a little or not at all */
    CONTAINED, /* one inside the other */
    FLAT,      /* points, segments, triangles */
    AFFINE,    /* sheared, mirrored, flattened poses */
    COUPLES,   /* sums and hulls of two */
    POLYTOPES, /* how many of the families have sharp corners */
    ROUNDED = POLYTOPES, /* any of these grown by radii */
    ROUND,               /* balls, cylinders, cones, discs and what can be made of them */
    FAMILIES
};

static const char *const family_name[FAMILIES] = {"hulls",     "boxes",  "stacks", "parallel", "slivers", "lattices",
                                                  "repeated",  "ratios", "close",  "far out",  "distant", "identical",
                                                  "contained", "flat",   "affine", "couples",  "rounded", "round"};

typedef struct pair {
    body a, b;
    body part[4];
} pair;

/* The bodies point into the pair: it is bound again wherever it is copied or changed. */
static inline void bind_pair(pair *p)
{
    body *whole[2] = {&p->a, &p->b};
    for (int k = 0; k < 2; k++) {
        if (whole[k]->kind == SUM || whole[k]->kind == HULL) {
            for (int i = 0; i < 2; i++) {
                whole[k]->part[i] = &p->part[2 * k + i];
                bind(&p->part[2 * k + i]);
            }
        }
        bind(whole[k]);
    }
}

static inline void turn(draws *d, body *b, double angle)
{
    double m[DIM * DIM];
    rotation(d, angle, m);
    for (int i = 0; i < DIM * DIM; i++) {
        b->pose.m[i] = (real)m[i];
    }
}

static inline void move(body *b, const double *dir, double by)
{
    for (int i = 0; i < DIM; i++) {
        b->pose.p[i] = (real)((double)b->pose.p[i] + dir[i] * by);
    }
}

static inline void draw_hull(draws *d, body *b, int count, double size)
{
    double x[DIM];
    start_body(b, POINTS);
    b->count = count;
    for (int k = 0; k < b->count; k++) {
        double r = size * between(d, 0.5, 1);
        unit(d, x);
        for (int i = 0; i < DIM; i++) {
            b->v[k][i] = (real)(x[i] * r);
        }
    }
}

static inline void draw_box(draws *d, body *b, double lo, double hi)
{
    start_body(b, BOX);
    for (int i = 0; i < DIM; i++) {
        b->half[i] = (real)between(d, lo, hi);
    }
}

static inline void scale_body(body *b, double by)
{
    for (int i = 0; i < DIM; i++) {
        for (int k = 0; k < MAX_POINTS; k++) {
            b->v[k][i] = (real)((double)b->v[k][i] * by);
        }
        b->half[i] = (real)((double)b->half[i] * by);
    }
    b->radius = (real)((double)b->radius * by);
    b->half_length = (real)((double)b->half_length * by);
}

/* How far the posed body reaches along a direction; rounded, which is good enough to place it. */
static inline double extent(body *b, const double *dir)
{
    real back[DIM], x[DIM];
    double h = 0;
    bind(b);
    for (int j = 0; j < DIM; j++) {
        double sum = 0;
        for (int i = 0; i < DIM; i++) {
            sum += (double)b->pose.m[i * DIM + j] * dir[i];
        }
        back[j] = (real)sum;
    }
    b->shape.support(b->shape.data, back, x);
    for (int i = 0; i < DIM; i++) {
        h += dir[i] * (double)b->pose.p[i] + (double)back[i] * (double)x[i];
    }
    return h;
}

/* Moves b along dir until it stands gap away from a. */
static inline void stand_off(pair *p, const double *dir, double gap)
{
    double back[DIM];
    for (int i = 0; i < DIM; i++) {
        back[i] = -dir[i];
    }
    move(&p->b, dir, extent(&p->a, dir) + extent(&p->b, back) + gap);
}

/* A column of the pose: for a box the normal of a face. */
static inline void axis_of(const body *b, int column, double *dir)
{
    for (int i = 0; i < DIM; i++) {
        dir[i] = (double)b->pose.m[i * DIM + column];
    }
}

/* Mostly apart, sometimes into each other, at the size of the bodies. */
static inline void scatter(draws *d, pair *p, double size)
{
    double dir[DIM];
    unit(d, dir);
    move(&p->b, dir, size * between(d, 0, 4));
}

static inline void draw_whole(draws *d, body *b)
{
    start_body(b, POINTS);
    b->count = 1 + below(d, 10);
    for (int k = 0; k < b->count; k++) {
        for (int i = 0; i < DIM; i++) {
            b->v[k][i] = (real)(below(d, 7) - 3);
        }
    }
    for (int i = 0; i < DIM; i++) {
        b->pose.p[i] = (real)(below(d, 11) - 5);
    }
}

static inline void draw_repeated(draws *d, body *b)
{
    int base = 1 + below(d, 4);
    draw_hull(d, b, base, 1);
    b->count = base + below(d, MOST_POINTS - base);
    for (int k = base; k < b->count; k++) {
        int from = below(d, k), to = below(d, k);
        real t = (real)(below(d, 5) * 0.25);
        for (int i = 0; i < DIM; i++) {
            b->v[k][i] = b->v[from][i] + t * (b->v[to][i] - b->v[from][i]);
        }
    }
}

static inline void draw_flat(draws *d, body *b)
{
    enum kind kind = (enum kind)(below(d, 4));
    if (kind == SEGMENT || (kind == TRIANGLE && DIM == 3)) {
        draw_hull(d, b, kind == SEGMENT ? 2 : 3, 1);
        b->kind = kind;
    } else if (kind == BOX) {
        start_body(b, ORIGIN);
    } else {
        draw_hull(d, b, 1 + below(d, 3), 1);
    }
}

static inline void draw_sliver(draws *d, body *b)
{
    double stretch[DIM];
    for (int i = 0; i < DIM; i++) {
        stretch[i] = below(d, 2) ? 1 : magnitude(d, -7, 0);
    }
    draw_hull(d, b, 4 + below(d, 12), 1);
    for (int k = 0; k < b->count; k++) {
        for (int i = 0; i < DIM; i++) {
            b->v[k][i] = (real)((double)b->v[k][i] * stretch[i]);
        }
    }
    turn(d, b, 100);
}

static inline void draw_affine(draws *d, body *b)
{
    int rank = below(d, 3);
    for (int i = 0; i < DIM * DIM; i++) {
        b->pose.m[i] = (real)(below(d, 4) ? between(d, -1.5, 1.5) : 0);
    }
    if (rank < 2) {
        /* The last row a multiple of the first: the body is flat, or with rank 0 gone to a point. */
        for (int j = 0; j < DIM; j++) {
            b->pose.m[DIM * (DIM - 1) + j] = 2 * b->pose.m[j];
        }
    }
    if (rank == 0 && below(d, 4) == 0) {
        memset(b->pose.m, 0, sizeof b->pose.m);
    }
}

static inline void draw_round(draws *d, body *b)
{
    static const enum kind kinds[] = {BALL, CYLINDER, CONE, DISC};
    start_body(b, DIM == 3 ? kinds[below(d, 4)] : BALL);
    b->radius = (real)between(d, 0.1, 1);
    b->half_length = (real)between(d, 0.1, 1);
    turn(d, b, 100);
    if (below(d, 3) == 0) {
        for (int i = 0; i < DIM * DIM; i++) {
            b->pose.m[i] = (real)((double)b->pose.m[i] * between(d, 0.2, 2));
        }
    }
}

static inline void draw_couple(draws *d, body *b, body *part, int sharp)
{
    start_body(b, below(d, 2) ? SUM : HULL);
    for (int k = 0; k < 2; k++) {
        if (sharp || below(d, 2)) {
            if (below(d, 2)) {
                draw_box(d, &part[k], 0.1, 1);
            } else {
                draw_hull(d, &part[k], 1 + below(d, 7), 1);
            }
            turn(d, &part[k], 100);
        } else {
            draw_round(d, &part[k]);
        }
        for (int i = 0; i < DIM; i++) {
            part[k].pose.p[i] = (real)between(d, -1, 1);
        }
        if (!sharp && below(d, 3) == 0) {
            part[k].shape.radius = (real)between(d, 0, 0.5);
        }
    }
    turn(d, b, 100);
}

static inline void draw_parallel(draws *d, pair *p, double gap)
{
    double dir[DIM], m[DIM * DIM], small[DIM * DIM];
    int axis = below(d, DIM);
    draw_box(d, &p->a, 0.2, 2);
    draw_box(d, &p->b, 0.2, 2);
    rotation(d, below(d, 3) ? 100 : 0, m);
    rotation(d, below(d, 5) ? magnitude(d, -15, -2) : 0, small);
    for (int i = 0; i < DIM; i++) {
        for (int j = 0; j < DIM; j++) {
            double sum = 0;
            for (int k = 0; k < DIM; k++) {
                sum += m[i * DIM + k] * small[k * DIM + j];
            }
            p->a.pose.m[i * DIM + j] = (real)m[i * DIM + j];
            p->b.pose.m[i * DIM + j] = (real)sum;
        }
    }
    axis_of(&p->a, axis, dir);
    stand_off(p, dir, gap);
    for (int i = 0; i < DIM; i++) {
        if (i != axis && below(d, 2)) {
            axis_of(&p->a, i, dir);
            move(&p->b, dir, between(d, -2, 2));
        }
    }
}

static inline void draw_close(draws *d, pair *p)
{
    double dir[DIM], gap = magnitude(d, -13, -2) * (below(d, 4) ? 1 : -1);
    if (below(d, 2)) {
        draw_box(d, &p->a, 0.2, 2);
        turn(d, &p->a, 100);
        axis_of(&p->a, below(d, DIM), dir);
    } else {
        draw_hull(d, &p->a, 4 + below(d, 10), 1);
        unit(d, dir);
    }
    if (below(d, 2)) {
        draw_box(d, &p->b, 0.2, 2);
        turn(d, &p->b, 100);
    } else {
        draw_hull(d, &p->b, 4 + below(d, 10), 1);
    }
    stand_off(p, dir, gap);
}

static inline void draw_stack(draws *d, pair *p)
{
    double dir[DIM], m[DIM * DIM];
    for (int k = 0; k < 2; k++) {
        body *b = k ? &p->b : &p->a;
        start_body(b, BOX);
        for (int i = 0; i < DIM; i++) {
            b->half[i] = (real)((1 + below(d, 4)) * 0.25);
        }
    }
    for (int i = 0; i < DIM; i++) {
        dir[i] = below(d, 3) ? (double)p->a.half[i] + (double)p->b.half[i] : (below(d, 5) - 2) * 0.25;
        dir[i] += below(d, 4) ? 0 : magnitude(d, -12, 0) * (below(d, 3) ? 1 : -1);
    }
    rotation(d, below(d, 2) ? 100 : 0, m);
    for (int i = 0; i < DIM; i++) {
        double sum = 0;
        for (int j = 0; j < DIM; j++) {
            p->a.pose.m[i * DIM + j] = p->b.pose.m[i * DIM + j] = (real)m[i * DIM + j];
            sum += m[i * DIM + j] * dir[j];
        }
        p->b.pose.p[i] = (real)sum;
    }
}

static inline void draw_sharp(draws *d, enum family family, pair *p);

static inline void draw_twice(draws *d, pair *p)
{
    draw_sharp(d, below(d, 2) ? HULLS : BOXES, p);
    p->b = p->a;
    if (below(d, 2)) {
        double dir[DIM];
        unit(d, dir);
        move(&p->b, dir, magnitude(d, -15, 0));
    }
}

static inline void draw_far_out(draws *d, pair *p)
{
    double dir[DIM], by = magnitude(d, 2, sizeof(real) == 4 ? 4 : 7);
    draw_sharp(d, below(d, 2) ? HULLS : below(d, 2) ? CLOSE : BOXES, p);
    unit(d, dir);
    move(&p->a, dir, by);
    move(&p->b, dir, by);
}

static inline void draw_sharp(draws *d, enum family family, pair *p)
{
    double ratio;
    switch (family) {
    case BOXES:
        draw_box(d, &p->a, 0.2, 1.5);
        draw_box(d, &p->b, 0.2, 1.5);
        turn(d, &p->a, 100);
        turn(d, &p->b, 100);
        scatter(d, p, 1.5);
        return;
    case STACKS:
        draw_stack(d, p);
        return;
    case PARALLEL:
        draw_parallel(d, p, magnitude(d, -13, -2) * (below(d, 5) ? 1 : -1));
        return;
    case SLIVERS:
        draw_sliver(d, &p->a);
        draw_sliver(d, &p->b);
        scatter(d, p, below(d, 2) ? 0.5 : magnitude(d, -6, 0));
        return;
    case LATTICES:
        draw_whole(d, &p->a);
        draw_whole(d, &p->b);
        return;
    case REPEATED:
        draw_repeated(d, &p->a);
        draw_repeated(d, &p->b);
        scatter(d, p, 0.7);
        return;
    case RATIOS:
        draw_sharp(d, below(d, 2) ? HULLS : BOXES, p);
        ratio = magnitude(d, 1, 9);
        scale_body(below(d, 2) ? &p->a : &p->b, ratio);
        scatter(d, p, below(d, 2) ? ratio : 1);
        return;
    case CLOSE:
        draw_close(d, p);
        return;
    case FAR_OUT:
        draw_far_out(d, p);
        return;
    case DISTANT:
        draw_sharp(d, below(d, 2) ? HULLS : BOXES, p);
        scale_body(&p->a, magnitude(d, -9, 0));
        scale_body(&p->b, magnitude(d, -9, 0));
        return;
    case IDENTICAL:
        draw_twice(d, p);
        return;
    case CONTAINED:
        draw_sharp(d, below(d, 2) ? HULLS : BOXES, p);
        scale_body(&p->b, magnitude(d, -4, 0) * 0.3);
        memcpy(p->b.pose.p, p->a.pose.p, sizeof p->b.pose.p);
        scatter(d, p, 0.1);
        return;
    case FLAT:
        draw_flat(d, &p->a);
        draw_flat(d, &p->b);
        scatter(d, p, below(d, 3) ? 0.4 : 0);
        return;
    case AFFINE:
        draw_sharp(d, below(d, 2) ? HULLS : BOXES, p);
        draw_affine(d, &p->a);
        draw_affine(d, &p->b);
        return;
    case COUPLES:
        draw_couple(d, &p->a, p->part, 1);
        draw_couple(d, &p->b, p->part + 2, 1);
        scatter(d, p, 2);
        return;
    default:
        draw_hull(d, &p->a, 4 + below(d, 29), 1);
        draw_hull(d, &p->b, 4 + below(d, 29), 1);
        turn(d, &p->a, 100);
        turn(d, &p->b, 100);
        scatter(d, p, 1);
    }
}

static inline void draw_pair(draws *d, enum family family, pair *p)
{
    memset(p, 0, sizeof *p);
    if (family == ROUND) {
        for (int k = 0; k < 2; k++) {
            body *b = k ? &p->b : &p->a;
            int kind = below(d, 5);
            if (kind == 0) {
                draw_couple(d, b, p->part + 2 * k, 0);
            } else if (kind == 1) {
                draw_box(d, b, 0.2, 1);
            } else {
                draw_round(d, b);
            }
        }
        scatter(d, p, 1);
    } else if (family == ROUNDED) {
        draw_sharp(d, (enum family)below(d, COUPLES), p);
        p->a.shape.radius = (real)(below(d, 3) ? between(d, 0, 1) : below(d, 3) * 0.5);
        p->b.shape.radius = (real)(below(d, 3) ? magnitude(d, -9, 1) : below(d, 3) * 0.5);
    } else {
        draw_sharp(d, family, p);
    }
    bind_pair(p);
}

#endif
