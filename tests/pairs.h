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
    PARALLEL,  /* boxes face to face, turned by 1e-2 .. 1e-15, gaps 1e-2 .. 1e-16 */
    SLIVERS,   /* needles and plates, 1 : 1e-9 at the worst */
    LATTICES,  /* small whole coordinates */
    REPEATED,  /* points twice, on one line, in one plane */
    RATIOS,    /* sizes up to 1 : 1e12 */
    CLOSE,     /* hulls and boxes with gaps 1e-2 .. 1e-16, corner to face, corner to corner, and into each other */
    FAR_OUT,   /* at 1e2 .. 1e12 from the origin, half of them by the coordinates of their points */
    DISTANT,   /* sizes small beside the way from one to the other, 1 : 1e12 at the worst */
    IDENTICAL, /* one body twice, the second time moved a little or not at all */
    CONTAINED, /* one inside the other */
    FLAT,      /* points, segments, triangles */
    AFFINE,    /* sheared, mirrored, flattened poses, and nearly flattened ones */
    COUPLES,   /* sums and hulls of two */
    CONTACT,   /* a corner, an edge or a face in exact contact with another */
    GAPS,      /* the same, moved apart or into each other by 1e-1 .. 1e-16 */
    EDGES,     /* edge over edge, crossing or parallel to 1e-15, gaps 1e-1 .. 1e-16; corner over edge in 2-D */
    TURNED,    /* boxes face to face, turned by 1e-9 or 1e-14 */
    JITTER,    /* points twice, on one line, in one plane, but for their last digit */
    THIN,      /* of width 1e-12 */
    TOWERS,    /* two neighbours in a pile of ten, which rest on each other but for 1e-9 */
    LARGE,     /* lengths up to 1e300, 1e35 in float */
    SMALL,     /* and down to the least normal number */
    SUBNORMAL, /* below it */
    MIXED,     /* large and small at once: the bodies, their coordinates, or their points beside their maps */
    CLOUDS,    /* 200 to 2000 points on a sphere */
    POLYTOPES, /* how many of the families have sharp corners */
    ROUNDED = POLYTOPES, /* any of these but couples and extreme lengths grown by radii */
    ROUND,               /* balls, cylinders, cones, discs and what can be made of them */
    ELLIPSOIDS,          /* axes up to 1 : 1e6; here and below against any other body, gaps 1 .. 1e-10 */
#if DIM == 3
    CYLINDERS, /* 1e3 : 1 to 1 : 1e3 */
    CONES,
    DISCS,
#endif
    FAMILIES
};

static const char *const family_name[FAMILIES] = {
    "hulls",     "boxes",     "stacks",  "parallel",  "slivers",   "lattices", "repeated",   "ratios",
    "close",     "far out",   "distant", "identical", "contained", "flat",     "affine",     "couples",
    "contact",   "gaps",      "edges",   "turned",    "jitter",    "thin",     "towers",     "large",
    "small",     "subnormal", "mixed",   "clouds",    "rounded",   "round",    "ellipsoids",
#if DIM == 3
    "cylinders", "cones",     "discs",
#endif
};

/* Lengths whose squares, or which times 2^100 (2^10 in float), may lie out of range. */
static inline int is_extreme(enum family family) { return family >= LARGE && family <= MIXED; }

/* Families that cost tens of times as much as others: long runs draw fewer of them. */
static inline int is_costly(enum family family) { return family == CLOUDS || family >= ROUND; }

typedef struct pair {
    body a, b;
    body part[4];
} pair;

/* A pair that other seeds than the usual draw, of which an answer has been wrong. */
typedef struct found_pair {
    const char *variant;
    uint64_t seed;
    enum family family;
    long at;
} found_pair;

/* Of so many the next of this variant, from the k-th on, which k is moved beyond; NULL: there is none. */
static inline const found_pair *next_found(const found_pair *pairs, size_t count, size_t *k)
{
    while (*k < count) {
        const found_pair *f = &pairs[(*k)++];
        if (strcmp(f->variant, VARIANT) == 0) {
            return f;
        }
    }
    return NULL;
}

/* The bodies point into the pair: it is bound again wherever it is copied or changed. */
static inline void bind_pair(pair *p)
{
    body *whole[2] = {&p->a, &p->b};
    for (int k = 0; k < 2; k++) {
        if (is_couple(whole[k])) {
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

/* The same by the points, of a body that has its own. */
static inline void move_points(body *b, const double *dir, double by)
{
    for (int k = 0; k < b->count; k++) {
        for (int i = 0; i < DIM; i++) {
            b->v[k][i] = (real)((double)b->v[k][i] + dir[i] * by);
        }
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
        for (int k = 0; k < b->count && b->kind != CLOUD; k++) {
            b->v[k][i] = (real)((double)b->v[k][i] * by);
        }
        b->half[i] = (real)((double)b->half[i] * by);
    }
    for (int i = 0; i < DIM * DIM && b->kind == CLOUD; i++) {
        b->pose.m[i] = (real)((double)b->pose.m[i] * by);
    }
    b->radius = (real)((double)b->radius * by);
    b->half_length = (real)((double)b->half_length * by);
}

static inline void scale_pair(pair *p, double by)
{
    for (int k = 0; k < 2; k++) {
        body *b = k ? &p->b : &p->a;
        scale_body(b, by);
        for (int i = 0; i < DIM; i++) {
            b->pose.p[i] = (real)((double)b->pose.p[i] * by);
        }
    }
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

/* The same, with a last digit here and there one more or one less. */
static inline void draw_jitter(draws *d, body *b)
{
    draw_repeated(d, b);
    for (int k = 0; k < b->count; k++) {
        for (int i = 0; i < DIM; i++) {
            b->v[k][i] *= 1 + (real)(below(d, 3) - 1) * (real)U * (real)(1 + below(d, 2));
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

static inline void draw_sliver(draws *d, body *b, int thinnest, int most)
{
    double stretch[DIM];
    for (int i = 0; i < DIM; i++) {
        stretch[i] = below(d, 2) ? 1 : magnitude(d, thinnest, most);
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
    real nearly = (real)(below(d, 2) ? 0 : magnitude(d, -16, -2));
    for (int i = 0; i < DIM * DIM; i++) {
        b->pose.m[i] = (real)(below(d, 4) ? between(d, -1.5, 1.5) : 0);
    }
    if (rank < 2) {
        /* The last row a multiple of the first: the body is flat, or with rank 0 gone to a point. */
        for (int j = 0; j < DIM; j++) {
            b->pose.m[DIM * (DIM - 1) + j] = 2 * b->pose.m[j] + (rank ? nearly * b->pose.m[DIM + j % (DIM - 1)] : 0);
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

static inline void draw_parallel(draws *d, pair *p, double gap, double angle)
{
    double dir[DIM], m[DIM * DIM], small[DIM * DIM];
    int axis = below(d, DIM);
    draw_box(d, &p->a, 0.2, 2);
    draw_box(d, &p->b, 0.2, 2);
    rotation(d, below(d, 3) ? 100 : 0, m);
    rotation(d, angle, small);
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
    double dir[DIM], gap = magnitude(d, -16, -2) * (below(d, 4) ? 1 : -1);
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

/* ---- exact contact: whole coordinates, one plane through 0 between the bodies, and 0 in both ---- */

/* Whole, and not 0. */
static inline void draw_whole_vector(draws *d, int most, double *x)
{
    double n;
    do {
        n = 0;
        for (int i = 0; i < DIM; i++) {
            x[i] = below(d, 2 * most + 1) - most;
            n += fabs(x[i]);
        }
    } while (n == 0);
}

/* A whole vector across n, which is one of two that span all of them. */
static inline void across(const double *n, int which, double *x)
{
#if DIM == 3
    double first[3] = {n[1], -n[0], 0};
    if (n[0] == 0 && n[1] == 0) {
        first[0] = 1;
    }
    if (which == 0) {
        memcpy(x, first, sizeof first);
        return;
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        x[i] = n[j] * first[k] - n[k] * first[j];
    }
#else
    x[0] = which ? n[1] : -n[1];
    x[1] = which ? -n[0] : n[0];
#endif
}

/* Adds u a + v b. */
static inline void add_point(body *b, double u, const double *x, double v, const double *y)
{
    for (int i = 0; i < DIM; i++) {
        b->v[b->count][i] = (real)(u * x[i] + v * y[i]);
    }
    b->count++;
}

/* A hull beyond the plane across n, which it meets in a corner (feature 0), an edge (1) or a face (2) that holds 0. */
static inline void draw_standing(draws *d, body *b, const double *n, int feature)
{
    double s[DIM], t[DIM], x[DIM];
    int more = 1 + below(d, 6);
    start_body(b, POINTS);
    across(n, 0, s);
    across(n, 1, t);
    if (feature == 0) {
        add_point(b, 0, s, 0, t);
    } else if (feature == 1) {
        double k = below(d, 5) - 2, l = 1 + below(d, 2), far = 1 + below(d, 3), back = below(d, 3);
        add_point(b, k * far, s, l * far, t);
        add_point(b, -k * back, s, -l * back, t);
    } else {
        add_point(b, 1 + below(d, 3), s, 0, t);
        add_point(b, 0, s, 1 + below(d, 3), t);
        add_point(b, -1 - below(d, 3), s, -1 - below(d, 3), t);
    }
    while (more > 0) {
        double along = 0;
        draw_whole_vector(d, 6, x);
        for (int i = 0; i < DIM; i++) {
            along += x[i] * n[i];
        }
        if (along != 0) {
            add_point(b, along > 0 ? 1 : -1, x, 0, x);
            more--;
        }
    }
}

/* The axes renamed and mirrored. */
static inline void draw_exact_map(draws *d, real *m)
{
    int first = below(d, DIM);
    memset(m, 0, DIM * DIM * sizeof *m);
    for (int i = 0; i < DIM; i++) {
        m[i * DIM + (i + first) % DIM] = below(d, 2) ? -1 : 1;
    }
}

/* Hulls that meet in 0 alone or in more, but have no inner point in common; the separation is exactly 0. n points from
 * a to b. */
static inline void draw_hulls_in_contact(draws *d, pair *p, double *n)
{
    double back[DIM];
    draw_whole_vector(d, 4, n);
    for (int i = 0; i < DIM; i++) {
        back[i] = -n[i];
    }
    draw_standing(d, &p->a, back, below(d, DIM));
    draw_standing(d, &p->b, n, below(d, DIM));
}

/* Boxes that meet in a face, an edge or a corner. */
static inline void draw_boxes_in_contact(draws *d, pair *p, double *n)
{
    int touching = 1 + below(d, (1 << DIM) - 1);
    draw_box(d, &p->a, 1, 1);
    draw_box(d, &p->b, 1, 1);
    for (int i = 0; i < DIM; i++) {
        double a = 1 + below(d, 8), b = 1 + below(d, 8), most = touching >> i & 1 ? a + b : below(d, (int)(a + b));
        p->a.half[i] = (real)a;
        p->b.half[i] = (real)b;
        n[i] = touching >> i & 1 ? (below(d, 2) ? -1 : 1) : 0;
        p->a.pose.p[i] = (real)(below(d, 2) ? -most : most);
        if (n[i] != 0) {
            p->a.pose.p[i] = (real)(-n[i] * most);
        }
    }
}

static inline void draw_in_contact(draws *d, pair *p, double *n)
{
    if (below(d, 3)) {
        draw_hulls_in_contact(d, p, n);
    } else {
        draw_boxes_in_contact(d, p, n);
    }
}

/* The same whole motion and power of two for both. */
static inline void move_exactly(draws *d, pair *p)
{
    double by = 1;
    real m[DIM * DIM];
    for (int k = below(d, 7); k > 0; k--) {
        by /= 2;
    }
    scale_pair(p, by);
    draw_exact_map(d, m);
    for (int i = 0; i < DIM; i++) {
        real shift = (real)((below(d, 101) - 50) * by), old[2][DIM];
        for (int k = 0; k < 2; k++) {
            body *b = k ? &p->b : &p->a;
            memcpy(old[k], b->pose.p, sizeof old[k]);
        }
        p->a.pose.p[i] = old[0][i] + shift;
        p->b.pose.p[i] = old[1][i] + shift;
    }
    for (int k = 0; k < 2; k++) {
        body *b = k ? &p->b : &p->a;
        real at[DIM] = {0};
        for (int i = 0; i < DIM; i++) {
            for (int j = 0; j < DIM; j++) {
                at[i] += m[i * DIM + j] * b->pose.p[j];
            }
        }
        memcpy(b->pose.p, at, sizeof at);
        memcpy(b->pose.m, m, sizeof m);
    }
}

static inline void draw_contact(draws *d, pair *p)
{
    double n[DIM];
    draw_in_contact(d, p, n);
    move_exactly(d, p);
}

/* b stays at the origin, where a gap of any size is held without rounding. */
static inline void draw_gap(draws *d, pair *p)
{
    double n[DIM], length = 0, gap = magnitude(d, -16, -1) * (below(d, 5) ? 1 : -1);
    draw_in_contact(d, p, n);
    for (int i = 0; i < DIM; i++) {
        length += n[i] * n[i];
    }
    move(&p->b, n, gap / sqrt(length));
}

/* ---- edge over edge ---- */

/* A segment, a hull or in 3-D a box whose upper edge runs along the first axis of the frame m, through 0; side 1 turns
 * it upside down. */
static inline void draw_edge(draws *d, body *b, const double *m, int side, const double *length)
{
    double sign = side ? -1 : 1, x[DIM];
    int kind = below(d, DIM);
    start_body(b, POINTS);
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < DIM; i++) {
            b->v[k][i] = (real)(m[i * DIM] * (k ? -length[1] : length[0]));
        }
    }
    b->count = 2;
    if (kind == 0) {
        b->kind = SEGMENT;
        return;
    }
#if DIM == 3
    if (kind == 2) {
        const double half = 0.70710678118654752;
        draw_box(d, b, 0.1, 2);
        for (int i = 0; i < DIM; i++) {
            double along = m[i * DIM], beside = m[i * DIM + 1], over = m[i * DIM + 2];
            double up = (double)b->half[1] + (double)b->half[2], across = (double)b->half[1] - (double)b->half[2];
            b->pose.m[i * DIM] = (real)along;
            b->pose.m[i * DIM + 1] = (real)((over + beside) * half);
            b->pose.m[i * DIM + 2] = (real)((over - beside) * half);
            b->pose.p[i] = (real)(-sign * half * (over * up + beside * across));
        }
        return;
    }
#endif
    for (int k = 1 + below(d, 5); k > 0; k--) {
        x[0] = between(d, -1, 1);
        x[DIM - 2] = between(d, -1, 1);
        x[DIM - 1] = -sign * between(d, 0.05, 1);
        for (int i = 0; i < DIM; i++) {
            double sum = 0;
            for (int j = 0; j < DIM; j++) {
                sum += m[i * DIM + j] * x[j];
            }
            b->v[b->count][i] = (real)sum;
        }
        b->count++;
    }
}

/* Both edges pass through 0, crossing or nearly parallel; then one is moved by the gap. In 2-D, where crossing edges
 * would overlap, they are nearly parallel, or one is a corner. */
static inline void draw_edges(draws *d, pair *p)
{
    double m[DIM * DIM], second[DIM * DIM], up[DIM];
    double gap = magnitude(d, -16, -1) * (below(d, 6) ? 1 : -1), angle = magnitude(d, -15, -2);
    double length[2][2] = {{between(d, 0.1, 2), between(d, 0, 2)}, {between(d, 0.1, 2), between(d, 0, 2)}};
    double c = 1, s = angle, n;
    if (below(d, 2) && DIM == 3) {
        c = between(d, -1, 1);
        s = between(d, 0.1, 1);
    } else if (below(d, 2)) {
        length[1][0] = length[1][1] = 0;
    }
    n = sqrt(c * c + s * s);
    rotation(d, below(d, 3) ? 100 : 0, m);
    memcpy(second, m, sizeof m);
    for (int i = 0; i < DIM; i++) {
        second[i * DIM] = (c * m[i * DIM] + s * m[i * DIM + 1]) / n;
        second[i * DIM + 1] = (c * m[i * DIM + 1] - s * m[i * DIM]) / n;
        up[i] = m[i * DIM + DIM - 1];
    }
    draw_edge(d, &p->a, m, 0, length[0]);
    draw_edge(d, &p->b, second, 1, length[1]);
    move(&p->b, up, gap);
}

/* ---- a pile of ten, each resting on the one below but for 1e-9 ---- */

static inline void draw_tower(draws *d, body *ten)
{
    const double gap = 1e-9;
    double top = 0;
    int straight = below(d, 2);
    for (int k = 0; k < 10; k++) {
        double m[DIM * DIM];
        body *b = &ten[k];
        draw_box(d, b, 0.3, 2);
        if (straight) {
            rotation(d, 0, m);
        } else {
#if DIM == 3
            /* about the last axis alone */
            double x = between(d, -1, 1), y = between(d, 0.1, 1), n = sqrt(x * x + y * y);
            double turned[9] = {x / n, -y / n, 0, y / n, x / n, 0, 0, 0, 1};
            memcpy(m, turned, sizeof m);
#else
            rotation(d, 1e-12, m);
#endif
        }
        for (int i = 0; i < DIM * DIM; i++) {
            b->pose.m[i] = (real)m[i];
        }
        for (int i = 0; i < DIM - 1; i++) {
            b->pose.p[i] = (real)between(d, -0.2, 0.2);
        }
        b->pose.p[DIM - 1] = (real)(top + (double)b->half[DIM - 1]);
        top = (double)b->pose.p[DIM - 1] + (double)b->half[DIM - 1] + gap;
    }
}

static inline void draw_neighbours(draws *d, pair *p)
{
    body ten[10];
    int k = below(d, 9);
    draw_tower(d, ten);
    p->a = ten[k];
    p->b = ten[k + 1];
}

/* ---- many points on a sphere ---- */

#define MOST_CLOUDS 8

#define MOST_OF_CLOUD 2000
#define INDEX_OF_CLOUD (25 * MOST_OF_CLOUD + 25)

/* Half of the clouds are spread by chance, half along a spiral, which makes many of nearly the same rank. Made once. */
static inline void make_cloud(int which, int count, real *v)
{
    draws d = draws_from(0, 0, (uint64_t)which);
    double x = 1, y = 0;
    for (int k = 0; k < count; k++, v += DIM) {
        double p[DIM], turned = -0.7373688780783198 * x - 0.6754902942615238 * y;
        y = 0.6754902942615238 * x - 0.7373688780783198 * y; /* by the golden angle */
        x = turned;
        if (which % 2) {
            unit(&d, p);
        } else {
            double n = sqrt(x * x + y * y);
            p[0] = x / n;
            p[1] = y / n;
#if DIM == 3
            p[2] = (2 * k + 1) / (double)count - 1;
            p[0] *= sqrt(1 - p[2] * p[2]);
            p[1] *= sqrt(1 - p[2] * p[2]);
#endif
        }
        for (int i = 0; i < DIM; i++) {
            v[i] = (real)p[i];
        }
    }
}

/* Every other one of either kind. */
static inline int has_index(int which) { return which / 2 % 2; }

static inline void index_cloud(body *b, uint32_t *index)
{
    bind(b);
    if (V(index_points)(&b->set.indexed, index, INDEX_OF_CLOUD * sizeof *index) > INDEX_OF_CLOUD * sizeof *index) {
        abort();
    }
}

static inline void draw_cloud(draws *d, body *b)
{
    static const int counts[MOST_CLOUDS] = {200, 200, 500, 500, 1000, 1000, 2000, 2000};
    static real points[MOST_CLOUDS][MOST_OF_CLOUD * DIM];
    static uint32_t index[MOST_CLOUDS][INDEX_OF_CLOUD];
    static int made[MOST_CLOUDS];
    int which = below(d, MOST_CLOUDS);
    start_body(b, CLOUD);
    b->count = counts[which];
    b->cloud = points[which];
    if (!made[which]) {
        make_cloud(which, counts[which], points[which]);
        if (has_index(which)) {
            index_cloud(b, index[which]);
        }
        made[which] = 1;
    }
    b->index = has_index(which) ? index[which] : NULL;
    turn(d, b, 100);
    scale_body(b, between(d, 0.5, 2));
}

static inline void draw_clouds(draws *d, pair *p)
{
    double dir[DIM];
    draw_cloud(d, &p->a);
    switch (below(d, 3)) {
    case 0:
        draw_cloud(d, &p->b);
        break;
    case 1:
        draw_hull(d, &p->b, 4 + below(d, 10), 1);
        break;
    default:
        draw_box(d, &p->b, 0.2, 2);
        turn(d, &p->b, 100);
    }
    unit(d, dir);
    stand_off(p, dir, magnitude(d, -13, 1) * (below(d, 5) ? 1 : -0.1));
}

/* ---- lengths near the ends of the range ---- */

/* Each coordinate its own size, or points and map far apart in size. */
static inline void draw_mixed(draws *d, body *b, int most)
{
    double by[DIM];
    draw_hull(d, b, 1 + below(d, 8), 1);
    switch (below(d, 3)) {
    case 0:
        for (int i = 0; i < DIM; i++) {
            by[i] = magnitude(d, -most, most);
        }
        for (int k = 0; k < b->count; k++) {
            for (int i = 0; i < DIM; i++) {
                b->v[k][i] = (real)((double)b->v[k][i] * by[i]);
            }
        }
        return;
    case 1:
        by[0] = magnitude(d, -most, most);
        turn(d, b, 100);
        scale_body(b, by[0]);
        for (int i = 0; i < DIM * DIM; i++) {
            b->pose.m[i] = (real)((double)b->pose.m[i] / by[0]);
        }
        return;
    default:
        turn(d, b, 100);
        scale_body(b, magnitude(d, -most, most));
    }
}

static inline void draw_extreme(draws *d, enum family family, pair *p)
{
    static const enum family families[] = {HULLS, BOXES, STACKS, LATTICES, CLOSE, FLAT, CONTACT, GAPS};
    const int most = sizeof(real) == 8 ? 300 : 35;
    if (family == MIXED) {
        draw_mixed(d, &p->a, most / 2);
        draw_mixed(d, &p->b, most / 2);
        scatter(d, p, below(d, 2) ? magnitude(d, -most / 2, most / 2) : 1);
        return;
    }
    draw_sharp(d, families[below(d, 8)], p);
    if (family == LARGE) {
        scale_pair(p, magnitude(d, most / 4, most));
    } else if (family == SMALL) {
        scale_pair(p, magnitude(d, -most, -most / 4));
    } else { /* of 2^1 to 2^50 least numbers, or 2^1 to 2^21 */
        double by = (double)REAL_MIN;
        for (int k = below(d, sizeof(real) == 8 ? 50 : 21); k >= 0; k--) {
            by /= 2;
        }
        scale_pair(p, by);
    }
}

static inline void draw_twice(draws *d, pair *p)
{
    draw_sharp(d, below(d, 2) ? HULLS : BOXES, p);
    p->b = p->a;
    if (below(d, 2)) {
        double dir[DIM];
        unit(d, dir);
        move(&p->b, dir, magnitude(d, -16, 0));
    }
}

/* Far away by the poses, or by the coordinates of the points: their own origin is then far as well. */
static inline void draw_far_out(draws *d, pair *p)
{
    double dir[DIM], by = magnitude(d, 2, 12);
    int points = below(d, 2);
    draw_sharp(d, below(d, 2) || points ? HULLS : below(d, 2) ? CLOSE : BOXES, p);
    unit(d, dir);
    for (int k = 0; k < 2; k++) {
        body *b = k ? &p->b : &p->a;
        if (!points) {
            move(b, dir, by);
            continue;
        }
        move_points(b, dir, by);
        memset(b->pose.m, 0, sizeof b->pose.m);
        for (int i = 0; i < DIM; i++) {
            b->pose.m[i * DIM + i] = 1;
        }
    }
}

static inline void draw_sharp(draws *d, enum family family, pair *p)
{
    double ratio, gap;
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
        gap = magnitude(d, -16, -2) * (below(d, 5) ? 1 : -1);
        draw_parallel(d, p, gap, below(d, 5) ? magnitude(d, -15, -2) : 0);
        return;
    case SLIVERS:
        draw_sliver(d, &p->a, -9, 0);
        draw_sliver(d, &p->b, -9, 0);
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
        ratio = magnitude(d, 1, 12);
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
        scale_body(&p->a, magnitude(d, -12, 0));
        scale_body(&p->b, magnitude(d, -12, 0));
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
    case CONTACT:
        draw_contact(d, p);
        return;
    case GAPS:
        draw_gap(d, p);
        return;
    case EDGES:
        draw_edges(d, p);
        return;
    case TURNED:
        gap = magnitude(d, -16, -2) * (below(d, 5) ? 1 : -1);
        draw_parallel(d, p, gap, below(d, 2) ? 1e-9 : 1e-14);
        return;
    case JITTER:
        draw_jitter(d, &p->a);
        draw_jitter(d, &p->b);
        scatter(d, p, 0.7);
        return;
    case THIN:
        draw_sliver(d, &p->a, -13, -11);
        draw_sliver(d, &p->b, -13, -11);
        scatter(d, p, below(d, 2) ? 0.5 : magnitude(d, -13, 0));
        return;
    case TOWERS:
        draw_neighbours(d, p);
        return;
    case LARGE:
    case SMALL:
    case SUBNORMAL:
    case MIXED:
        draw_extreme(d, family, p);
        return;
    case CLOUDS:
        draw_clouds(d, p);
        return;
    default:
        draw_hull(d, &p->a, 4 + below(d, 29), 1);
        draw_hull(d, &p->b, 4 + below(d, 29), 1);
        turn(d, &p->a, 100);
        turn(d, &p->b, 100);
        scatter(d, p, 1);
    }
}

/* Axes of 1e6 to 1 at most, as radii of the set or in the map of a ball. */
static inline void draw_ellipsoid(draws *d, body *b)
{
    double m[DIM * DIM];
    start_body(b, below(d, 2) ? ELLIPSOID : BALL);
    b->radius = 1;
    rotation(d, below(d, 4) ? 100 : 0, m);
    for (int j = 0; j < DIM; j++) {
        double axis = below(d, 3) ? magnitude(d, -6, 0) : 1, stretch = b->kind == BALL ? axis : 1;
        b->half[j] = (real)axis;
        for (int i = 0; i < DIM; i++) {
            b->pose.m[i * DIM + j] = (real)(m[i * DIM + j] * stretch);
        }
    }
}

static inline void draw_round_kind(draws *d, enum family family, body *b)
{
    enum kind kind = family == ELLIPSOIDS ? BALL : CYLINDER;
#if DIM == 3
    kind = family == CONES ? CONE : family == DISCS ? DISC : kind;
#endif
    if (kind == BALL) {
        draw_ellipsoid(d, b);
        return;
    }
    start_body(b, kind);
    b->radius = (real)(below(d, 2) ? between(d, 0.1, 1) : magnitude(d, -3, 0));
    b->half_length = (real)(below(d, 2) ? between(d, 0.1, 1) : magnitude(d, -3, 0));
    turn(d, b, below(d, 4) ? 100 : 0);
}

/* One of the kind, and any other body. */
static inline void draw_round_pair(draws *d, enum family family, pair *p)
{
    double dir[DIM], gap = below(d, 2) ? between(d, 0, 1) : magnitude(d, -10, 0);
    draw_round_kind(d, family, &p->a);
    switch (below(d, 5)) {
    case 0:
        draw_box(d, &p->b, 0.2, 1);
        turn(d, &p->b, below(d, 4) ? 100 : 0);
        break;
    case 1:
        draw_flat(d, &p->b);
        break;
    case 2:
        draw_round(d, &p->b);
        break;
    default:
        draw_round_kind(d, family, &p->b);
    }
    unit(d, dir);
    stand_off(p, dir, gap * (below(d, 5) ? 1 : -0.3));
    if (below(d, 4) == 0) {
        double other[DIM];
        unit(d, other);
        move(&p->b, other, between(d, 0, 0.5));
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
        enum family base = (enum family)below(d, LARGE);
        draw_sharp(d, base == COUPLES ? HULLS : base, p);
        p->a.shape.radius = (real)(below(d, 3) ? between(d, 0, 1) : below(d, 3) * 0.5);
        p->b.shape.radius = (real)(below(d, 3) ? magnitude(d, -9, 1) : below(d, 3) * 0.5);
    } else if (family > ROUND) {
        draw_round_pair(d, family, p);
    } else {
        draw_sharp(d, family, p);
    }
    bind_pair(p);
}

#endif
