/* SPDX-License-Identifier: MIT */
/* Bytes to a pair of bodies: total, so that every input is a legal question. */
#ifndef SCENE_H
#define SCENE_H

#include "input.h"
#include "pairs.h"

#define MOST_CLOUD 16

typedef struct scene {
    pair p;
    int bare[2];   /* handed over without a pose */
    int silent[2]; /* of unknown reach, where that is a cloud's to say */
} scene;

static inline body *whole_of(scene *s, int k) { return k ? &s->p.b : &s->p.a; }

/* Makes the shapes speak of this scene. Again after each copy. */
static inline void bind_scene(scene *s)
{
    bind_pair(&s->p);
    for (int k = 0; k < 2; k++) {
        body *b = whole_of(s, k), *all[3] = {b, &s->p.part[2 * k], &s->p.part[2 * k + 1]};
        int couple = b->kind == SUM || b->kind == HULL;
        for (int i = 0; i < (couple ? 3 : 1); i++) {
            if (all[i]->kind == POINTS && s->silent[k]) {
                all[i]->set.points.reach = 0;
            }
        }
        if (s->bare[k]) {
            b->shape.pose = NULL;
        }
    }
}

static inline void read_vector(input *in, real *x)
{
    for (int i = 0; i < DIM; i++) {
        x[i] = number(in);
    }
}

/* Points used so far, of both bodies. */
typedef struct points_used {
    real v[2 * MOST_CLOUD][DIM];
    int count;
} points_used;

static inline const real *point_used(input *in, const points_used *all)
{
    static const real none[DIM] = {0};
    int at = byte(in);
    return all->count ? all->v[at % all->count] : none;
}

static inline void read_point(input *in, points_used *all, real *x)
{
    const real *from, *to, *third;
    int op = choice(in, 12);
    double t;
    switch (op) {
    case 0: /* one that was there, or its neighbour by some last places */
    case 1:
        from = point_used(in, all);
        for (int i = 0; i < DIM; i++) {
            x[i] = op ? nudged(from[i], small_whole(in)) : from[i];
        }
        break;
    case 2: /* on a line with two */
        from = point_used(in, all);
        to = point_used(in, all);
        t = small_whole(in) / 64.0;
        for (int i = 0; i < DIM; i++) {
            x[i] = rounded((double)from[i] + t * ((double)to[i] - (double)from[i]));
        }
        break;
    case 3: /* in a plane with three */
        from = point_used(in, all);
        to = point_used(in, all);
        third = point_used(in, all);
        for (int i = 0; i < DIM; i++) {
            x[i] = rounded((double)from[i] + (double)to[i] - (double)third[i]);
        }
        break;
    case 4: /* mirrored */
    case 5: /* moved along one axis */
        memcpy(x, point_used(in, all), DIM * sizeof *x);
        t = choice(in, DIM);
        x[(int)t] = op == 4 ? -x[(int)t] : number(in);
        break;
    default:
        read_vector(in, x);
    }
    if (all->count < 2 * MOST_CLOUD) {
        memcpy(all->v[all->count++], x, DIM * sizeof *x);
    }
}

static inline void read_set(input *in, points_used *all, body *b, int couples)
{
    static const enum kind kinds[] = {POINTS, POINTS,   POINTS, BOX,  BOX,  SEGMENT, TRIANGLE,
                                      ORIGIN, CYLINDER, CONE,   DISC, BALL, SUM,     HULL};
    enum kind kind = kinds[choice(in, 14)];
    if (!couples && (kind == SUM || kind == HULL)) {
        kind = BOX;
    }
    if (DIM == 2 && (kind == TRIANGLE || kind == CYLINDER || kind == CONE || kind == DISC)) {
        kind = kind == TRIANGLE ? POINTS : BALL;
    }
    start_body(b, kind);
    if (kind == POINTS || kind == SEGMENT || kind == TRIANGLE) {
        b->count = kind == SEGMENT ? 2 : kind == TRIANGLE ? 3 : 1 + choice(in, MOST_CLOUD);
        for (int k = 0; k < b->count; k++) {
            read_point(in, all, b->v[k]);
        }
    } else if (kind == BOX) {
        for (int i = 0; i < DIM; i++) {
            b->half[i] = size_number(in);
        }
    } else if (kind == BALL || kind == CYLINDER || kind == CONE || kind == DISC) {
        b->radius = size_number(in);
        if (kind == CYLINDER || kind == CONE) {
            b->half_length = size_number(in);
        }
    }
}

/* By a whole quaternion, rounded: near enough to a rotation, and exact for the quarter turns. */
static inline void read_rotation(input *in, real *m)
{
#if DIM == 3
    double q[4], n = 0;
    for (int i = 0; i < 4; i++) {
        q[i] = small_whole(in);
        n += q[i] * q[i];
    }
    for (int i = 0; i < 3 && n > 0; i++) {
        for (int j = 0; j < 3; j++) {
            double sign = (j - i + 3) % 3 == 1 ? -1 : 1;
            m[3 * i + j] = (real)(i == j ? 1 - 2 * (n - q[3] * q[3] - q[i] * q[i]) / n
                                         : 2 * (q[i] * q[j] + sign * q[3 - i - j] * q[3]) / n);
        }
    }
#else
    double x = small_whole(in), y = small_whole(in), n = sqrt(x * x + y * y);
    if (n > 0) {
        m[0] = m[3] = (real)(x / n);
        m[1] = (real)(-y / n);
        m[2] = (real)(y / n);
    }
#endif
}

/* other: a pose to be like. */
static inline void read_map(input *in, const V(pose) * other, real *m)
{
    int i, j, whole, op = choice(in, 16);
    real by;
    switch (op) {
    case 0:
    case 1:
    case 2:
    case 3: /* as it is: identity */
        return;
    case 4:
    case 5:
    case 6:
        read_rotation(in, m);
        return;
    case 7: /* turned by a very small angle */
        i = choice(in, DIM);
        j = (i + 1) % DIM;
        whole = small_whole(in);
        m[i * DIM + j] = (real)ldexp(whole, -choice(in, 64));
        m[j * DIM + i] = -m[i * DIM + j];
        return;
    case 8:
    case 9: /* the other body's, or nearly */
        memcpy(m, other->m, sizeof other->m);
        if (op == 9) {
            i = choice(in, DIM * DIM);
            m[i] = nudged(m[i], small_whole(in));
        }
        return;
    case 10: /* mirrored */
        i = choice(in, DIM);
        m[i * DIM + i] = -1;
        return;
    case 11: /* stretched by a power of two */
        by = (real)ldexp(1, in->calm ? choice(in, 41) - 20 : small_whole(in) * (VARIANT_FLOAT ? 1 : 7));
        for (i = 0; i < DIM; i++) {
            m[i * DIM + i] = by;
        }
        return;
    case 12: /* stretched along each axis, flat where a number is 0 */
        for (i = 0; i < DIM; i++) {
            m[i * DIM + i] = number(in);
        }
        return;
    case 13: /* sheared */
        i = choice(in, DIM * DIM);
        m[i] = number(in);
        return;
    case 14: /* singular: one row a multiple of another */
        for (i = 0; i < DIM * DIM; i++) {
            m[i] = number(in);
        }
        i = choice(in, DIM);
        by = (real)small_whole(in) / 16;
        for (j = 0; j < DIM; j++) {
            m[i * DIM + j] = rounded((double)by * (double)m[(i + 1) % DIM * DIM + j]);
        }
        return;
    default:
        for (i = 0; i < DIM * DIM; i++) {
            m[i] = number(in);
        }
    }
}

/* Where the pose takes a point, but for the rounding. */
static inline void place_of(const body *b, const real *x, double *out)
{
    for (int i = 0; i < DIM; i++) {
        out[i] = (double)b->pose.p[i];
        for (int j = 0; j < DIM; j++) {
            out[i] += (double)b->pose.m[i * DIM + j] * (double)x[j];
        }
    }
}

/* A corner, or for a round set its origin. */
static inline void corner_of_set(const body *b, int at, real *x)
{
    memset(x, 0, DIM * sizeof *x);
    if (b->count > 0) {
        memcpy(x, b->v[at % b->count], DIM * sizeof *x);
    }
    for (int i = 0; i < DIM && b->kind == BOX; i++) {
        x[i] = at >> i & 1 ? -b->half[i] : b->half[i];
    }
}

/* Onto the other body, corner on corner, along all axes or but one. */
static inline void place_on(input *in, const body *other, body *b)
{
    real x[DIM], y[DIM];
    double there[DIM], here[DIM];
    int axis = choice(in, 2 * DIM);
    corner_of_set(other, byte(in), x);
    corner_of_set(b, byte(in), y);
    place_of(other, x, there);
    place_of(b, y, here);
    for (int i = 0; i < DIM; i++) {
        double by = there[i] - here[i];
        if (i != axis && by - by == 0) {
            b->pose.p[i] = rounded((double)b->pose.p[i] + by);
        }
    }
    if (axis < DIM) {
        b->pose.p[axis] = rounded((double)b->pose.p[axis] + (double)number(in));
    } else {
        b->pose.p[axis - DIM] = nudged(b->pose.p[axis - DIM], small_whole(in));
    }
}

static inline void read_position(input *in, const body *other, body *b)
{
    int i, op = choice(in, 8);
    real x;
    switch (op) {
    case 0:
        break;
    case 1:
    case 2:
        place_on(in, other, b);
        break;
    case 3: /* where the other is */
        memcpy(b->pose.p, other->pose.p, sizeof b->pose.p);
        i = choice(in, DIM);
        b->pose.p[i] = nudged(b->pose.p[i], small_whole(in));
        break;
    case 4: /* along one axis */
        x = number(in);
        b->pose.p[choice(in, DIM)] = x;
        break;
    default:
        read_vector(in, b->pose.p);
    }
}

/* Never one that is refused: the library takes radii up to REAL_MAX / 16. */
static inline real read_radius(input *in)
{
    real r;
    if (choice(in, 4) != 0) {
        return 0;
    }
    r = size_number(in);
    return r > REAL_MAX / 32 ? REAL_MAX / 32 : r;
}

static inline void multiply(real *x, int count, int exponent)
{
    for (int i = 0; i < count; i++) {
        x[i] = rounded(ldexp((double)x[i], exponent));
    }
}

/* All lengths of the pair times a power of two. */
static inline void scale_scene(scene *s, int exponent)
{
    body *all[6] = {&s->p.a, &s->p.b, &s->p.part[0], &s->p.part[1], &s->p.part[2], &s->p.part[3]};
    for (int k = 0; k < 6; k++) {
        multiply(all[k]->v[0], MAX_POINTS * DIM, exponent);
        multiply(all[k]->half, DIM, exponent);
        multiply(&all[k]->radius, 1, exponent);
        multiply(&all[k]->half_length, 1, exponent);
        multiply(all[k]->pose.p, DIM, exponent);
        multiply(&all[k]->shape.radius, 1, exponent);
        if (all[k]->shape.radius > REAL_MAX / 32) {
            all[k]->shape.radius = REAL_MAX / 32;
        }
    }
}

static inline int is_identity(const V(pose) * pose)
{
    V(pose) plain;
    memset(&plain, 0, sizeof plain);
    for (int i = 0; i < DIM; i++) {
        plain.m[i * DIM + i] = 1;
    }
    return memcmp(pose, &plain, sizeof plain) == 0;
}

static inline void read_scene(input *in, scene *s)
{
    points_used all = {{{0}}, 0};
    int flags = byte(in), exponent = small_whole(in);
    memset(s, 0, sizeof *s);
    for (int k = 0; k < 2; k++) {
        start_body(whole_of(s, k), ORIGIN);
        start_body(&s->p.part[2 * k], ORIGIN);
        start_body(&s->p.part[2 * k + 1], ORIGIN);
    }
    in->calm = flags & 1;
    for (int k = 0; k < 2; k++) {
        body *b = whole_of(s, k), *other = whole_of(s, 1 - k), *part = &s->p.part[2 * k];
        if (k == 1 && (flags & 6) == 6) { /* the same set twice */
            *b = *other;
            memcpy(part, &s->p.part[0], 2 * sizeof *part);
        } else {
            read_set(in, &all, b, 1);
        }
        if (b->kind == SUM || b->kind == HULL) {
            for (int i = 0; i < 2; i++) {
                read_set(in, &all, &part[i], 0);
                read_map(in, &part[0].pose, part[i].pose.m);
                read_position(in, &part[0], &part[i]);
                part[i].shape.radius = read_radius(in);
            }
        }
        read_map(in, &other->pose, b->pose.m);
        read_position(in, other, b);
        b->shape.radius = read_radius(in);
        s->silent[k] = (flags >> (3 + k) & 1) && b->kind != SUM && b->kind != HULL;
        s->bare[k] = (flags >> (5 + k) & 1) && is_identity(&b->pose);
    }
    if (flags & 128) {
        scale_scene(s, in->calm ? exponent / 4 : exponent * (VARIANT_FLOAT ? 1 : 8));
    }
    bind_scene(s);
}

static inline void print_scene(FILE *f, const char *query, const scene *s)
{
    print_case(f, query, &s->p.a, &s->p.b);
    fprintf(f, "  without a pose: %d %d, of unknown reach: %d %d\n", s->bare[0], s->bare[1], s->silent[0],
            s->silent[1]);
}

#endif
