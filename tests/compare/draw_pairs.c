/* SPDX-License-Identifier: MIT */
/* Draws everyday pairs of bodies, from a seed, and writes them for the bench. Compiled once for each variant, in whose
 * precision the numbers are.
 *
 *   draw_pairs PAIRS SEED >>FILE     so many pairs of each class in each state
 *
 * What is near or shallow is placed by the library; how near it really is, the truth tells. */
#include "../pairs.h"
#include "pair_file.h"

#define MOST_VERTICES 100000
#define STEPS_OF_TRACK 20
#define MOST_PER_PAIR 5000 /* vertices: a small run is also one of small bodies */

/* ---- bodies ---- */

typedef struct class
{
    const char *name;
    enum kind a, b; /* POINTS: with so many corners, or in the plane up to that */
    int corners;
    int rounded; /* 1: grown by a ball */
    int part;    /* of the pairs asked for: one in so many, 0: all */
} class;

static real numbers[2][MOST_VERTICES * DIM]; /* of the points of both */

/* Points of an ellipsoid, so that each is a corner. */
static void draw_corners(draws *d, body *b, int corners, real *x)
{
    double axes[DIM], dir[DIM];
    b->kind = CLOUD;
    b->count = DIM == 3 || corners < 4 ? corners : 3 + below(d, corners - 2);
    b->cloud = x;
    for (int i = 0; i < DIM; i++) {
        axes[i] = between(d, 0.5, 1);
    }
    for (int k = 0; k < b->count; k++) {
        unit(d, dir);
        for (int i = 0; i < DIM; i++) {
            x[k * DIM + i] = (real)(axes[i] * dir[i]);
        }
    }
}

static void draw_body(draws *d, body *b, enum kind kind, const class *c, real *x)
{
    start_body(b, kind);
    switch (kind) {
    case POINTS:
        draw_corners(d, b, c->corners, x);
        break;
    case SEGMENT: /* a capsule */
        b->v[0][DIM - 1] = (real)between(d, 0.3, 1);
        b->v[1][DIM - 1] = -b->v[0][DIM - 1];
        b->shape.radius = (real)between(d, 0.1, 0.5);
        break;
    case ORIGIN: /* a ball */
        b->shape.radius = (real)between(d, 0.3, 1);
        break;
    default:
        for (int i = 0; i < DIM; i++) {
            b->half[i] = (real)between(d, 0.3, 1);
        }
        b->radius = (real)between(d, 0.3, 1);
        b->half_length = (real)between(d, 0.3, 1);
    }
    if (c->rounded) {
        b->shape.radius = (real)between(d, 0.05, 0.3);
    }
    turn(d, b, 100);
}

static void draw_bodies(draws *d, pair *p, const class *c)
{
    memset(p, 0, sizeof *p);
    draw_body(d, &p->a, c->a, c, numbers[0]);
    draw_body(d, &p->b, c->b, c, numbers[1]);
    bind_pair(p);
}

/* ---- states ---- */

/* From apart, moves b along the closest pair until it stands gap away, or is so deep in a: first near by, from where
 * the normal hardly changes; into a by more than one step, for a corner that slides off another. */
static void approach(pair *p, double gap)
{
    const double near = gap > 0.01 ? gap : 0.01;
    for (int k = 0; k < 8; k++) {
        double n[DIM];
        V(result) r;
        if (V(penetration)(&p->a.shape, &p->b.shape, NULL, &r) < 0) {
            abort();
        }
        for (int i = 0; i < DIM; i++) {
            n[i] = (double)r.normal[i];
        }
        move(&p->b, n, (k < 2 ? near : gap) - (double)r.value);
        bind_pair(p);
        if (k == 2 && gap > 0) {
            return;
        }
    }
}

static void stand_apart(draws *d, pair *p, double gap)
{
    double dir[DIM];
    unit(d, dir);
    stand_off(p, dir, gap + (double)p->a.shape.radius + (double)p->b.shape.radius);
    bind_pair(p);
}

/* A mean of four farthest points, and so inside. */
static void draw_inner_point(draws *d, body *b, double *point)
{
    double sum = 0;
    memset(point, 0, DIM * sizeof *point);
    for (int k = 0; k < 4; k++) {
        double dir[DIM], weight = between(d, 0, 1);
        real back[DIM] = {0}, x[DIM];
        unit(d, dir);
        for (int i = 0; i < DIM * DIM; i++) {
            back[i % DIM] += b->pose.m[i] * (real)dir[i / DIM];
        }
        b->shape.support(b->shape.data, back, x);
        for (int i = 0; i < DIM; i++) {
            double at = (double)b->shape.radius * dir[i];
            for (int j = 0; j < DIM; j++) {
                at += (double)(b->pose.m[i * DIM + j] * x[j]);
            }
            point[i] += weight * at;
        }
        sum += weight;
    }
    for (int i = 0; i < DIM; i++) {
        point[i] /= sum;
    }
}

typedef struct state {
    const char *name;
    void (*place)(draws *d, pair *p, double by, int step);
    double by; /* the gap */
    int questions;
    int track;
} state;

#define ASK(question) (1 << (question))
#define APART (ASK(DISTANCE) | ASK(INTERSECT))
#define OVERLAPPING (ASK(INTERSECT) | ASK(PENETRATION))

static void place_separated(draws *d, pair *p, double by, int step)
{
    (void)by;
    (void)step;
    stand_apart(d, p, between(d, 0.1, 2));
}

static void place_at(draws *d, pair *p, double by, int step)
{
    (void)step;
    stand_apart(d, p, 0.5);
    approach(p, by);
}

/* An inner point of one on an inner point of the other. */
static void place_deep(draws *d, pair *p, double by, int step)
{
    double x[DIM], y[DIM];
    (void)by;
    (void)step;
    draw_inner_point(d, &p->a, x);
    draw_inner_point(d, &p->b, y);
    for (int i = 0; i < DIM; i++) {
        p->b.pose.p[i] = (real)(x[i] - y[i]);
    }
}

/* Cubes, one on a side of the other, in steps that are held without rounding. */
static void place_stacked(draws *d, pair *p, double by, int step)
{
    int up = below(d, DIM), sign = below(d, 2) ? -1 : 1;
    body *both[2] = {&p->a, &p->b};
    (void)by;
    (void)step;
    for (int k = 0; k < 2; k++) {
        body *b = both[k];
        int corners = b->kind == CLOUD;
        start_body(b, corners ? CLOUD : BOX);
        b->count = corners ? 1 << DIM : 0;
        b->cloud = numbers[k];
        for (int i = 0; i < b->count * DIM; i++) { /* round the square; any order for the cube */
            int at = i / DIM;
            numbers[k][i] = (real)((at ^ (DIM == 2 && i % DIM == 0 ? at >> 1 : 0)) >> i % DIM & 1 ? 0.5 : -0.5);
        }
        for (int i = 0; i < DIM; i++) {
            b->half[i] = (real)0.5;
        }
    }
    for (int i = 0; i < DIM; i++) {
        p->b.pose.p[i] = (real)(i == up ? sign : (below(d, 7) - 3) * 0.25);
    }
}

/* So many steps along a path: b turns and slides a little with each, and stays as near, or as deep. */
static void place_on_path(draws *d, pair *p, double by, int step)
{
    double way[DIM], small[DIM * DIM];
    unit(d, way);
    rotation(d, 0.01, small);
    stand_apart(d, p, 0.5);
    approach(p, by);
    for (int k = 0; k < step; k++) {
        double m[DIM * DIM] = {0};
        for (int i = 0; i < DIM * DIM * DIM; i++) {
            m[i / DIM] += small[i / DIM / DIM * DIM + i % DIM] * (double)p->b.pose.m[i % DIM * DIM + i / DIM % DIM];
        }
        for (int i = 0; i < DIM * DIM; i++) {
            p->b.pose.m[i] = (real)m[i];
        }
        move(&p->b, way, 0.005);
        bind_pair(p);
        approach(p, by);
    }
}

static const state separated = {"separated", place_separated, 0, APART, 0};
static const state deep = {"deep", place_deep, 0, OVERLAPPING, 0};
static const state stacked = {"stacked", place_stacked, 0, APART | OVERLAPPING, 0};
static const state states[] = {{"near 1e-3", place_at, 1e-3, APART, 0},
                               {"near 1e-6", place_at, 1e-6, APART, 0},
#if !VARIANT_FLOAT
                               {"near 1e-9", place_at, 1e-9, APART, 0},
#endif
                               {"shallow", place_at, -1e-3, OVERLAPPING, 0},
                               {"path", place_on_path, 0.05, APART, STEPS_OF_TRACK},
                               {"inner path", place_on_path, -0.05, OVERLAPPING, STEPS_OF_TRACK}};

/* ---- the file ---- */

static peer_set set_of(const body *b, double *spelled)
{
    static const enum peer_core cores[] = {
        [CLOUD] = PEER_POINTS, [BOX] = PEER_BOX,       [SEGMENT] = PEER_SEGMENT,    [CYLINDER] = PEER_CYLINDER,
        [CONE] = PEER_CONE,    [ORIGIN] = PEER_ORIGIN, [ELLIPSOID] = PEER_ELLIPSOID};
    peer_set s;
    memset(&s, 0, sizeof s);
    s.core = cores[b->kind];
    s.count = b->kind == CLOUD || b->kind == SEGMENT ? b->count : 0;
    for (int i = 0; i < s.count * DIM; i++) {
        spelled[i] = (double)points_of(b)[i];
    }
    s.v = spelled;
    for (int i = 0; i < DIM; i++) {
        s.size[i] = (double)b->half[i];
        s.p[i] = (double)b->pose.p[i];
    }
    if (b->kind == CYLINDER || b->kind == CONE) {
        s.size[0] = (double)b->radius;
        s.size[1] = (double)b->half_length;
    }
    for (int i = 0; i < DIM * DIM; i++) {
        s.m[i] = (double)b->pose.m[i];
    }
    s.posed = 1;
    s.radius = (double)b->shape.radius;
    return s;
}

static uint64_t seed;

static void write_pairs(const class *c, const state *s, const char *growth, int count, int at)
{
    static double spelled[2][MOST_VERTICES * DIM];
    static uint64_t family; /* each block draws from its own */
    pair_block block;
    family++;
    memset(&block, 0, sizeof block);
    snprintf(block.name, sizeof block.name, "%s", c->name);
    snprintf(block.state, sizeof block.state, "%s", s->name);
    snprintf(block.growth, sizeof block.growth, "%s", growth);
    block.dim = DIM;
    block.single = VARIANT_FLOAT;
    block.questions = *growth ? s->questions & ~ASK(INTERSECT) : s->questions;
    block.pairs = count;
    block.track = s->track;
    block.at = at;
    block.seed = (int32_t)seed;
    write_block(stdout, &block);
    for (int i = 0; i < count; i++) {
        draws d = draws_from(seed, family, (uint64_t)(s->track ? i / s->track : i));
        pair p;
        peer_set a, b;
        draw_bodies(&d, &p, c);
        s->place(&d, &p, s->by, s->track ? i % s->track : 0);
        a = set_of(&p.a, spelled[0]);
        b = set_of(&p.b, spelled[1]);
        write_pair(stdout, DIM, &a, &b);
    }
}

/* ---- classes ---- */

static const class classes[] = {
#if DIM == 2
    {"polygons", POINTS, POINTS, 8, 0, 0},
    {"rounded polygons", POINTS, POINTS, 8, 1, 0},
    {"capsules 2-D", SEGMENT, SEGMENT, 0, 0, 0},
#elif VARIANT_FLOAT
    {"boxes", BOX, BOX, 0, 0, 0},
    {"hulls of 8", POINTS, POINTS, 8, 0, 0},
    {"hulls of 64", POINTS, POINTS, 64, 0, 0},
    {"capsules", SEGMENT, SEGMENT, 0, 0, 0},
#else
    {"boxes", BOX, BOX, 0, 0, 0},
    {"hulls of 8", POINTS, POINTS, 8, 0, 0},
    {"hulls of 16", POINTS, POINTS, 16, 0, 0},
    {"hulls of 64", POINTS, POINTS, 64, 0, 0},
    {"hulls of 256", POINTS, POINTS, 256, 0, 2},
    {"hulls of 1024", POINTS, POINTS, 1024, 0, 4},
    {"capsules", SEGMENT, SEGMENT, 0, 0, 0},
    {"ball and box", ORIGIN, BOX, 0, 0, 0},
    {"cylinder and box", CYLINDER, BOX, 0, 0, 0},
    {"cones", CONE, CONE, 0, 0, 0},
    {"ellipsoids", ELLIPSOID, ELLIPSOID, 0, 0, 2},
#endif
};
#define COUNT(all) ((int)(sizeof(all) / sizeof *(all)))

static int rounded_up(int count, int unit) { return (count + unit - 1) / unit * unit; }

static void write_classes(int pairs)
{
    for (int k = 0; k < COUNT(classes); k++) {
        const class *c = &classes[k];
        int count = rounded_up(pairs, c->part ? c->part : 1) / (c->part ? c->part : 1);
        write_pairs(c, &separated, "", count, 0);
        for (int i = 0; i < COUNT(states); i++) {
            write_pairs(c, &states[i], "", states[i].track ? rounded_up(count, states[i].track) : count, 0);
        }
        write_pairs(c, &deep, "", count, 0);
        if (k == 0) {
            write_pairs(c, &stacked, "", count, 0);
        }
    }
}

#if DIM == 3 && !VARIANT_FLOAT
static void write_growth(int pairs)
{
    static const int vertices[] = {4, 8, 16, 32, 64, 128, 256, 1024, 4096, 16384, MOST_VERTICES};
    static const int counts[] = {1, 10, 100, 1000, 10000};
    class hulls = {"hulls", POINTS, POINTS, 0, 0, 0};
    for (int k = 0; k < COUNT(vertices) && vertices[k] <= pairs * MOST_PER_PAIR; k++) {
        int most = 20000 / vertices[k] < 3 ? 3 : 20000 / vertices[k];
        hulls.corners = vertices[k];
        write_pairs(&hulls, &separated, "vertices", pairs < most ? pairs : most, vertices[k]);
        write_pairs(&hulls, &deep, "vertices", pairs < most ? pairs : most, vertices[k]);
    }
    for (int k = 0; k < COUNT(counts); k++) {
        write_pairs(&classes[0], &separated, "pairs", counts[k], counts[k]);
    }
    for (int k = 0; k < COUNT(classes); k++) {
        if (strcmp(classes[k].name, "hulls of 64") == 0 || strcmp(classes[k].name, "ellipsoids") == 0) {
            write_pairs(&classes[k], &separated, "accuracy", pairs, 0);
            write_pairs(&classes[k], &deep, "accuracy", pairs, 0);
        }
    }
}
#else
static void write_growth(int pairs) { (void)pairs; } /* it is told of one variant */
#endif

int main(int argc, char **argv)
{
    int pairs;
    if (argc != 3 || (pairs = (int)strtol(argv[1], NULL, 10)) <= 0) {
        fprintf(stderr, "usage: draw_pairs PAIRS SEED >>FILE\n");
        return 2;
    }
    seed = strtoull(argv[2], NULL, 10);
    write_classes(pairs);
    write_growth(pairs < 20 ? pairs : 20);
    return fclose(stdout) != 0;
}
