/* SPDX-License-Identifier: MIT */
/* The distance between two bodies with corners, or how deep they overlap, exactly: whole numbers of any length, by GMP.
 *
 * Every coordinate is a sum of products of floating-point numbers, hence a whole number times a power of two. The
 * nearest point of the set of differences b - a is sought by active sets, and is accepted only once it is proven: it is
 * a mean of differences of vertices with weights that are not negative, and no difference of two vertices lies nearer
 * along it. Both are decided without rounding, so the result does not depend on how it was found. So it is with the
 * depth: a polytope is grown within the differences until none lies beyond its face nearest to the origin. */
#ifndef EXACT_H
#define EXACT_H

#include "bodies.h"
#include <gmp.h>

#define EXACT_VERTICES 2048

/* m 2^e */
typedef struct dyadic {
    mpz_t m;
    long e;
} dyadic;

static inline void dyadic_set(dyadic *x, real value)
{
    int e;
    double f = frexp((double)value, &e);
    mpz_set_d(x->m, ldexp(f, 53));
    x->e = e - 53;
}

/* Gives x the exponent e, which is not above its own. */
static inline void dyadic_lower(dyadic *x, long e)
{
    mpz_mul_2exp(x->m, x->m, (mp_bitcnt_t)(x->e - e));
    x->e = e;
}

static inline void dyadic_add(dyadic *sum, dyadic *x)
{
    if (mpz_sgn(x->m) == 0) {
        return;
    }
    if (mpz_sgn(sum->m) == 0 || sum->e > x->e) {
        if (mpz_sgn(sum->m) == 0) {
            sum->e = x->e;
        }
        dyadic_lower(sum, x->e);
    } else {
        dyadic_lower(x, sum->e);
    }
    mpz_add(sum->m, sum->m, x->m);
}

typedef struct exact_set {
    int count;
    dyadic v[EXACT_VERTICES][DIM];
} exact_set;

/* A difference of two vertices, w = b - a. */
typedef struct exact_corner {
    int at_a, at_b;
    mpz_t w[DIM];
} exact_corner;

#define EXACT_CORNERS 160
#define EXACT_FACES 640

/* Of the polytope: n points outwards, and n w is at most h within it. */
typedef struct exact_face {
    int corner[DIM]; /* rising */
    mpz_t n[DIM], h;
    mpq_t level; /* the square of h / |n|, with the sign of h */
} exact_face;

typedef struct exact {
    exact_set a, b;
    long e; /* of all coordinates, in the end */
    exact_corner s[DIM + 2];
    int count;
    mpz_t dot[DIM + 2][DIM + 2]; /* of the corners */
    mpz_t weight[DIM + 2];       /* in the nearest point, as multiples of 1 / whole */
    mpz_t whole;
    mpz_t n[DIM];   /* the nearest point, times whole */
    mpq_t square;   /* the squared distance of the cores */
    mpq_t radius;   /* to be taken off their distance */
    mpf_t distance; /* of the bodies, to 2^-1000, below 0 in overlap: to measure with, nothing is decided by it */
    mpz_t w[EXACT_CORNERS][DIM], inside[DIM]; /* the polytope, and the sum of its first corners */
    exact_face face[EXACT_FACES];
    int corners, faces;
    int rounds;
    mpz_t x, y, z, g[DIM][DIM], r[DIM];
    mpq_t p, q;
    mpf_t f, h;
} exact;

static inline void exact_start_set(exact_set *s)
{
    for (int k = 0; k < EXACT_VERTICES; k++) {
        for (int i = 0; i < DIM; i++) {
            mpz_init(s->v[k][i].m);
        }
    }
}

static inline void exact_start_polytope(exact *t)
{
    for (int i = 0; i < DIM; i++) {
        mpz_init(t->inside[i]);
        for (int k = 0; k < EXACT_CORNERS; k++) {
            mpz_init(t->w[k][i]);
        }
        for (int k = 0; k < EXACT_FACES; k++) {
            mpz_init(t->face[k].n[i]);
        }
    }
    for (int k = 0; k < EXACT_FACES; k++) {
        mpz_init(t->face[k].h);
        mpq_init(t->face[k].level);
    }
}

/* Once, for a variable with static storage; it is never given back. */
static inline void exact_start(exact *t)
{
    exact_start_set(&t->a);
    exact_start_set(&t->b);
    for (int k = 0; k < DIM + 2; k++) {
        for (int i = 0; i < DIM; i++) {
            mpz_init(t->s[k].w[i]);
        }
        for (int i = 0; i < DIM + 2; i++) {
            mpz_init(t->dot[k][i]);
        }
        mpz_init(t->weight[k]);
    }
    for (int i = 0; i < DIM; i++) {
        mpz_init(t->n[i]);
        mpz_init(t->r[i]);
        for (int j = 0; j < DIM; j++) {
            mpz_init(t->g[i][j]);
        }
    }
    mpz_inits(t->whole, t->x, t->y, t->z, NULL);
    mpq_inits(t->square, t->radius, t->p, t->q, NULL);
    mpf_init2(t->distance, 1000);
    mpf_init2(t->f, 1000);
    mpf_init2(t->h, 1000);
    exact_start_polytope(t);
}

/* ---- the vertices, posed ---- */

/* v goes to m v + p. */
static inline void exact_pose(const V(pose) * pose, dyadic *v)
{
    static dyadic out[DIM], factor, product;
    static int started;
    if (!started) {
        for (int i = 0; i < DIM; i++) {
            mpz_init(out[i].m);
        }
        mpz_inits(factor.m, product.m, NULL);
        started = 1;
    }
    for (int i = 0; i < DIM; i++) {
        dyadic_set(&out[i], pose->p[i]);
        for (int j = 0; j < DIM; j++) {
            dyadic_set(&factor, pose->m[i * DIM + j]);
            mpz_mul(product.m, factor.m, v[j].m);
            product.e = factor.e + v[j].e;
            dyadic_add(&out[i], &product);
        }
    }
    for (int i = 0; i < DIM; i++) {
        mpz_swap(v[i].m, out[i].m);
        v[i].e = out[i].e;
    }
}

static inline void exact_add_vertex(exact_set *s, const real *v, const body *b)
{
    for (int i = 0; i < DIM; i++) {
        dyadic_set(&s->v[s->count][i], v[i]);
    }
    exact_pose(&b->pose, s->v[s->count]);
    s->count++;
}

static inline void exact_vertices(exact_set *s, const body *b)
{
    const real nought[DIM] = {0};
    s->count = 0;
    if (b->kind == ORIGIN) {
        exact_add_vertex(s, nought, b);
    } else if (b->kind == BOX) {
        for (int k = 0; k < 1 << DIM; k++) {
            real v[DIM];
            for (int i = 0; i < DIM; i++) {
                v[i] = k >> i & 1 ? -b->half[i] : b->half[i];
            }
            exact_add_vertex(s, v, b);
        }
    } else {
        for (int k = 0; k < b->count; k++) {
            exact_add_vertex(s, points_of(b) + k * DIM, b);
        }
    }
}

/* Gives all coordinates of both sets one exponent. */
static inline void exact_align(exact *t)
{
    exact_set *sets[2] = {&t->a, &t->b};
    int any = 0;
    t->e = 0;
    for (int align = 0; align < 2; align++) {
        for (int s = 0; s < 2; s++) {
            for (int k = 0; k < sets[s]->count; k++) {
                for (int i = 0; i < DIM; i++) {
                    dyadic *x = &sets[s]->v[k][i];
                    if (mpz_sgn(x->m) == 0) {
                        x->e = t->e;
                    } else if (align) {
                        dyadic_lower(x, t->e);
                    } else {
                        mp_bitcnt_t zeros = mpz_scan1(x->m, 0);
                        long e = x->e + (long)zeros;
                        mpz_tdiv_q_2exp(x->m, x->m, zeros);
                        x->e = e;
                        t->e = !any || e < t->e ? e : t->e;
                        any = 1;
                    }
                }
            }
        }
    }
}

/* ---- the nearest point ---- */

/* The vertex with the largest product with sign n, of the first such. */
static inline int exact_farthest(exact *t, const exact_set *s, int sign)
{
    int at = 0;
    for (int k = 0; k < s->count; k++) {
        mpz_mul(t->y, t->n[0], s->v[k][0].m);
        for (int i = 1; i < DIM; i++) {
            mpz_addmul(t->y, t->n[i], s->v[k][i].m);
        }
        if (k == 0 || mpz_cmp(t->y, t->x) * sign > 0) {
            mpz_swap(t->x, t->y);
            at = k;
        }
    }
    return at;
}

static inline void exact_add_corner(exact *t, int at_a, int at_b)
{
    exact_corner *c = &t->s[t->count];
    c->at_a = at_a;
    c->at_b = at_b;
    for (int i = 0; i < DIM; i++) {
        mpz_sub(c->w[i], t->b.v[at_b][i].m, t->a.v[at_a][i].m);
    }
    for (int k = 0; k <= t->count; k++) {
        mpz_ptr product = t->dot[k][t->count];
        mpz_mul(product, c->w[0], t->s[k].w[0]);
        for (int i = 1; i < DIM; i++) {
            mpz_addmul(product, c->w[i], t->s[k].w[i]);
        }
        mpz_set(t->dot[t->count][k], product);
    }
    t->count++;
}

/* The determinant of the upper left of g, with column out, if it is one, replaced by r. */
static inline void exact_determinant(exact *t, int size, int out, mpz_ptr det)
{
#define AT(i, j) ((j) == out ? t->r[i] : t->g[i][j])
    if (size == 0) {
        mpz_set_ui(det, 1);
    } else if (size == 1) {
        mpz_set(det, AT(0, 0));
    } else if (size == 2) {
        mpz_mul(det, AT(0, 0), AT(1, 1));
        mpz_submul(det, AT(0, 1), AT(1, 0));
    }
#if DIM == 3
    if (size == 3) {
        mpz_set_ui(det, 0);
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3, k = (i + 2) % 3;
            mpz_mul(t->z, AT(1, j), AT(2, k));
            mpz_submul(t->z, AT(1, k), AT(2, j));
            mpz_addmul(det, AT(0, i), t->z);
        }
    }
#endif
#undef AT
}

/* Whether the point nearest to the origin in the affine hull of the picked corners lies among them, and no corner lies
 * nearer along it; weight and whole are then its weights. */
static inline int exact_try(exact *t, const int *pick, int size)
{
    mpz_ptr rest = t->weight[pick[0]];
    for (int k = 0; k < t->count; k++) {
        mpz_set_ui(t->weight[k], 0);
    }
    for (int i = 1; i < size; i++) {
        for (int j = 1; j < size; j++) {
            mpz_add(t->g[i - 1][j - 1], t->dot[pick[i]][pick[j]], t->dot[pick[0]][pick[0]]);
            mpz_sub(t->g[i - 1][j - 1], t->g[i - 1][j - 1], t->dot[pick[i]][pick[0]]);
            mpz_sub(t->g[i - 1][j - 1], t->g[i - 1][j - 1], t->dot[pick[j]][pick[0]]);
        }
        mpz_sub(t->r[i - 1], t->dot[pick[0]][pick[0]], t->dot[pick[i]][pick[0]]);
    }
    exact_determinant(t, size - 1, -1, t->whole);
    if (mpz_sgn(t->whole) <= 0) {
        return 0; /* no dimension of their own */
    }
    mpz_set(rest, t->whole);
    for (int i = 1; i < size; i++) {
        exact_determinant(t, size - 1, i - 1, t->weight[pick[i]]);
        mpz_sub(rest, rest, t->weight[pick[i]]);
        if (mpz_sgn(t->weight[pick[i]]) < 0) {
            return 0;
        }
    }
    if (mpz_sgn(rest) < 0) {
        return 0;
    }
    for (int k = 0; k < t->count; k++) { /* the product of the point with corner k, less that with corner pick[0] */
        mpz_set_ui(t->x, 0);
        for (int i = 0; i < size; i++) {
            mpz_sub(t->y, t->dot[pick[i]][k], t->dot[pick[i]][pick[0]]);
            mpz_addmul(t->x, t->weight[pick[i]], t->y);
        }
        if (mpz_sgn(t->x) < 0) {
            return 0;
        }
    }
    return 1;
}

/* Leaves of the corners those that the nearest point of their hull is a mean of. It needs the newest. */
static inline void exact_shrink(exact *t)
{
    int newest = t->count - 1;
    for (int mask = 0; mask < 1 << newest; mask++) {
        int pick[DIM + 2] = {newest}, size = 1, kept = 0;
        for (int k = 0; k < newest; k++) {
            if (mask >> k & 1) {
                pick[size++] = k;
            }
        }
        if (size > DIM + 1 || !exact_try(t, pick, size)) {
            continue;
        }
        for (int i = 0; i < DIM; i++) {
            mpz_set_ui(t->n[i], 0);
            for (int k = 0; k < t->count; k++) {
                mpz_addmul(t->n[i], t->weight[k], t->s[k].w[i]);
            }
        }
        for (int k = 0; k < t->count; k++) {
            int from[2] = {t->s[k].at_a, t->s[k].at_b};
            if (mpz_sgn(t->weight[k]) == 0) {
                continue;
            }
            mpz_swap(t->weight[kept], t->weight[k]);
            int more = t->count;
            t->count = kept; /* the corner is placed anew, with its products */
            exact_add_corner(t, from[0], from[1]);
            t->count = more;
            kept++;
        }
        t->count = kept;
        return;
    }
    fail_msg("no part of a simplex holds its nearest point");
}

/* From a square in units of 2^e. */
static inline void exact_square_in_full(const exact *t, mpq_ptr square)
{
    if (t->e > 0) {
        mpq_mul_2exp(square, square, (mp_bitcnt_t)(2 * t->e));
    } else {
        mpq_div_2exp(square, square, (mp_bitcnt_t)(-2 * t->e));
    }
}

/* The square, and the distance less the radii to measure with. */
static inline void exact_finish(exact *t, const body *a, const body *b)
{
    mpz_mul(t->x, t->n[0], t->n[0]);
    for (int i = 1; i < DIM; i++) {
        mpz_addmul(t->x, t->n[i], t->n[i]);
    }
    mpz_mul(t->y, t->whole, t->whole);
    mpq_set_num(t->square, t->x);
    mpq_set_den(t->square, t->y);
    mpq_canonicalize(t->square);
    exact_square_in_full(t, t->square);
    mpq_set_d(t->radius, (double)a->shape.radius);
    mpq_set_d(t->p, (double)b->shape.radius);
    mpq_add(t->radius, t->radius, t->p);
    mpf_set_q(t->distance, t->square);
    mpf_sqrt(t->distance, t->distance);
    mpf_set_q(t->f, t->radius);
    mpf_sub(t->distance, t->distance, t->f);
}

static inline void exact_distance(exact *t, const body *a, const body *b)
{
    exact_vertices(&t->a, a);
    exact_vertices(&t->b, b);
    exact_align(t);
    t->count = 0;
    exact_add_corner(t, 0, 0);
    for (t->rounds = 1;; t->rounds++) {
        int at_a, at_b, zero = 1;
        exact_shrink(t);
        for (int i = 0; i < DIM; i++) {
            zero &= mpz_sgn(t->n[i]) == 0;
        }
        if (zero) {
            break; /* a mean of differences: they meet */
        }
        at_a = exact_farthest(t, &t->a, 1);
        at_b = exact_farthest(t, &t->b, -1);
        exact_add_corner(t, at_a, at_b);
        mpz_set_ui(t->x, 0);
        for (int i = 0; i < DIM; i++) {
            mpz_sub(t->y, t->s[t->count - 1].w[i], t->s[0].w[i]);
            mpz_addmul(t->x, t->n[i], t->y);
        }
        if (mpz_sgn(t->x) >= 0) {
            t->count--;
            break; /* nothing lies nearer along the nearest point than it does itself */
        }
    }
    exact_finish(t, a, b);
}

/* ---- the depth ---- */

/* sum = n w */
static inline void exact_along(mpz_t *n, mpz_t *w, mpz_ptr sum)
{
    mpz_mul(sum, n[0], w[0]);
    for (int i = 1; i < DIM; i++) {
        mpz_addmul(sum, n[i], w[i]);
    }
}

/* Makes the farthest difference along sign n the next corner, which does not count yet. */
static inline void exact_beyond(exact *t, int sign)
{
    int at_a = exact_farthest(t, &t->a, -sign), at_b = exact_farthest(t, &t->b, sign);
    for (int i = 0; i < DIM; i++) {
        mpz_sub(t->w[t->corners][i], t->b.v[at_b][i].m, t->a.v[at_a][i].m);
    }
}

/* A vector across the edges from the first corner given to the others; of fewer than DIM corners, across axes too. */
static inline void exact_across(exact *t, const int *corner, int count, int axis, mpz_t *n)
{
    for (int k = 0; k < DIM - 1; k++) {
        for (int i = 0; i < DIM; i++) {
            if (k + 1 < count) {
                mpz_sub(t->g[k][i], t->w[corner[k + 1]][i], t->w[corner[0]][i]);
            } else {
                mpz_set_si(t->g[k][i], i == (axis + k) % DIM);
            }
        }
    }
#if DIM == 3
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        mpz_mul(n[i], t->g[0][j], t->g[1][k]);
        mpz_submul(n[i], t->g[0][k], t->g[1][j]);
    }
#else
    mpz_set(n[0], t->g[0][1]);
    mpz_neg(n[1], t->g[0][0]);
#endif
}

/* Adds a corner that is not in the flat through those so far. 0: there is none. */
static inline int exact_widen(exact *t)
{
    int all[DIM];
    for (int k = 0; k < DIM; k++) {
        all[k] = k;
    }
    for (int axis = 0; axis < DIM; axis++) {
        exact_across(t, all, t->corners, axis, t->n);
        for (int sign = -1; sign <= 1; sign += 2) {
            exact_beyond(t, sign);
            exact_along(t->n, t->w[t->corners], t->x);
            exact_along(t->n, t->w[0], t->y);
            if (mpz_cmp(t->x, t->y) != 0) {
                t->corners++;
                return 1;
            }
        }
    }
    return 0;
}

/* 0: no room. */
static inline int exact_add_face(exact *t, const int *corner)
{
    exact_face *f = &t->face[t->faces];
    if (t->faces == EXACT_FACES) {
        return 0;
    }
    memcpy(f->corner, corner, sizeof f->corner);
    exact_across(t, corner, DIM, 0, f->n);
    exact_along(f->n, t->w[corner[0]], f->h);
    exact_along(f->n, t->inside, t->x);
    mpz_mul_ui(t->y, f->h, DIM + 1);
    if (mpz_cmp(t->x, t->y) > 0) {
        mpz_neg(f->h, f->h);
        for (int i = 0; i < DIM; i++) {
            mpz_neg(f->n[i], f->n[i]);
        }
    }
    mpz_mul(t->x, f->h, f->h);
    exact_along(f->n, f->n, t->y);
    mpq_set_num(f->level, t->x);
    mpq_set_den(f->level, t->y);
    mpq_canonicalize(f->level);
    if (mpz_sgn(f->h) < 0) {
        mpq_neg(f->level, f->level);
    }
    t->faces++;
    return 1;
}

/* A first simplex. 0: the differences lie in a flat. */
static inline int exact_first_polytope(exact *t)
{
    t->corners = t->faces = 0;
    for (int i = 0; i < DIM; i++) {
        mpz_set_ui(t->n[i], i == 0);
    }
    exact_beyond(t, 1);
    t->corners = 1;
    while (t->corners <= DIM) {
        if (!exact_widen(t)) {
            return 0;
        }
    }
    for (int i = 0; i < DIM; i++) {
        mpz_set(t->inside[i], t->w[0][i]);
        for (int k = 1; k <= DIM; k++) {
            mpz_add(t->inside[i], t->inside[i], t->w[k][i]);
        }
    }
    for (int out = 0; out <= DIM; out++) {
        int corner[DIM];
        for (int i = 0; i < DIM; i++) {
            corner[i] = i + (i >= out);
        }
        exact_add_face(t, corner);
    }
    return 1;
}

/* Replaces the faces that the next corner lies beyond by faces from their rim to it. 0: no room. */
static inline int exact_grow(exact *t)
{
    static int rim[EXACT_FACES * DIM][DIM];
    int rims = 0, kept = 0;
    for (int k = 0; k < t->faces; k++) {
        exact_along(t->face[k].n, t->w[t->corners], t->x);
        if (mpz_cmp(t->x, t->face[k].h) <= 0) {
            exact_face keep = t->face[k];
            t->face[k] = t->face[kept];
            t->face[kept++] = keep;
            continue;
        }
        for (int out = 0; out < DIM; out++) { /* the side across from each corner is rim unless it comes twice */
            int side[DIM], twin = 0;
            for (int i = 0; i < DIM - 1; i++) {
                side[i] = t->face[k].corner[i + (i >= out)];
            }
            side[DIM - 1] = t->corners;
            while (twin < rims && memcmp(rim[twin], side, sizeof side) != 0) {
                twin++;
            }
            if (twin < rims) {
                memmove(rim[twin], rim[--rims], sizeof side);
            } else {
                memcpy(rim[rims++], side, sizeof side);
            }
        }
    }
    t->faces = kept;
    for (int k = 0; k < rims; k++) {
        if (!exact_add_face(t, rim[k])) {
            return 0;
        }
    }
    t->corners++;
    return 1;
}

/* Grows the polytope until its nearest face is one of the differences. 0: no room. */
static inline int exact_nearest_face(exact *t, int *at)
{
    while (t->corners < EXACT_CORNERS) {
        *at = 0;
        for (int k = 1; k < t->faces; k++) {
            *at = mpq_cmp(t->face[k].level, t->face[*at].level) < 0 ? k : *at;
        }
        for (int i = 0; i < DIM; i++) {
            mpz_set(t->n[i], t->face[*at].n[i]);
        }
        exact_beyond(t, 1);
        exact_along(t->n, t->w[t->corners], t->x);
        if (mpz_cmp(t->x, t->face[*at].h) == 0) {
            return 1;
        }
        if (!exact_grow(t)) {
            return 0;
        }
    }
    return 0;
}

/* After exact_distance: takes the depth off the distance, 0 as it is, of cores that meet. 0: it was not found. */
static inline int exact_depth(exact *t)
{
    int at;
    if (!exact_first_polytope(t)) {
        return 1; /* flat: they touch */
    }
    if (!exact_nearest_face(t, &at)) {
        return 0;
    }
    exact_square_in_full(t, t->face[at].level);
    mpf_set_q(t->h, t->face[at].level);
    mpf_sqrt(t->h, t->h);
    mpf_sub(t->distance, t->distance, t->h);
    return 1;
}

/* ---- questions, answered without rounding ---- */

/* The sign of (distance of the cores - radii) - x. */
static inline int exact_side(exact *t, mpq_srcptr x)
{
    mpq_add(t->q, x, t->radius);
    if (mpq_sgn(t->q) < 0) {
        return 1;
    }
    mpq_mul(t->q, t->q, t->q);
    return mpq_cmp(t->square, t->q);
}

/* The same for the distance of the bodies, which is 0 where their cores are nearer than the radii. */
static inline int exact_above(exact *t, double x)
{
    mpq_set_d(t->p, 0);
    if (exact_side(t, t->p) <= 0) {
        return x > 0 ? -1 : x < 0;
    }
    mpq_set_d(t->p, x);
    return exact_side(t, t->p);
}

/* From one number to the next in the binade of x. */
static inline double ulp_of(double x)
{
    const int digits = sizeof(real) == 8 ? DBL_MANT_DIG : FLT_MANT_DIG;
    const int least = sizeof(real) == 8 ? DBL_MIN_EXP - DBL_MANT_DIG : FLT_MIN_EXP - FLT_MANT_DIG;
    int e;
    frexp(x, &e);
    return ldexp(1, x == 0 || e - digits < least ? least : e - digits);
}

/* Whether the value is within some ulp, its own, of the distance. */
static inline int exact_within(exact *t, double value, double ulps)
{
    double by = ulps * ulp_of(value);
    return exact_above(t, value - by) >= 0 && exact_above(t, value + by) <= 0;
}

/* |value - distance| / unit, to measure with. */
static inline double exact_error(exact *t, double value, double unit)
{
    mpf_set_d(t->f, value);
    if (mpf_sgn(t->distance) > 0) {
        mpf_sub(t->f, t->f, t->distance);
    }
    mpf_abs(t->f, t->f);
    mpf_set_d(t->h, unit);
    mpf_div(t->f, t->f, t->h);
    return mpf_get_d(t->f);
}

#endif
