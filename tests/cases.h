/* SPDX-License-Identifier: MIT */
/* The cases of tests/cases for this variant, from the header that oracle/cases_to_c.py makes of them, as bodies. */
#ifndef CASES_H
#define CASES_H

#include "bodies.h"

#if VARIANT_DIM == 3 && !VARIANT_FLOAT
#include "cases3.h"
#define C(name) case3##name
#define K(name) CASE3_##name
#elif VARIANT_DIM == 3
#include "cases3f.h"
#define C(name) case3f##name
#define K(name) CASE3F_##name
#elif !VARIANT_FLOAT
#include "cases2.h"
#define C(name) case2##name
#define K(name) CASE2_##name
#else
#include "cases2f.h"
#define C(name) case2f##name
#define K(name) CASE2F_##name
#endif

typedef C() test_case;
typedef C(_shape) case_shape;

#define MOST_BODIES 16 /* in a case, parts of couples included */

typedef struct case_bodies {
    body b[MOST_BODIES];
    int used;
} case_bodies;

static inline const body *body_of(case_bodies *all, const case_shape *s)
{
    static const enum kind kinds[] = {[K(ORIGIN)] = ORIGIN,       [K(POINTS)] = POINTS,     [K(BOX)] = BOX,
                                      [K(SEGMENT)] = SEGMENT,     [K(TRIANGLE)] = TRIANGLE, [K(BALL)] = BALL,
                                      [K(ELLIPSOID)] = ELLIPSOID, [K(CYLINDER)] = CYLINDER, [K(CONE)] = CONE,
                                      [K(DISC)] = DISC,           [K(SUM)] = SUM,           [K(HULL)] = HULL};
    body *b = &all->b[all->used++];
    if (all->used > MOST_BODIES || s->count > MAX_POINTS) {
        fail_msg("a case is too large for its bodies");
    }
    start_body(b, kinds[s->kind]);
    b->count = b->kind == POINTS ? (int)s->count : b->kind == SEGMENT ? 2 : b->kind == TRIANGLE ? 3 : 0;
    if (b->count) {
        memcpy(b->v, s->numbers, (size_t)b->count * sizeof b->v[0]);
    } else if (b->kind == BOX || b->kind == ELLIPSOID) {
        memcpy(b->half, s->numbers, sizeof b->half);
    } else if (b->kind >= CYLINDER && b->kind <= BALL) {
        b->radius = s->numbers[0];
        b->half_length = b->kind <= CONE ? s->numbers[1] : 0;
    } else if (is_couple(b)) {
        b->part[0] = body_of(all, s->a);
        b->part[1] = body_of(all, s->b);
    }
    if (s->pose) {
        memcpy(b->pose.m, s->pose, sizeof b->pose.m);
        memcpy(b->pose.p, s->pose + DIM * DIM, sizeof b->pose.p);
    }
    bind(b);
    b->shape.radius = s->radius;
    if (!s->pose) {
        b->shape.pose = NULL;
    }
    return b;
}

/* The bodies stay until the next case but one is read, and a case that is read again has the same: so a cache never
 * meets a set that was edited in place. */
static inline void read_case(const test_case *c, const body **a, const body **b)
{
    static case_bodies all[2];
    static const test_case *held;
    static int at;
    at ^= c != held;
    held = c;
    all[at].used = 0;
    *a = body_of(&all[at], &c->a);
    *b = body_of(&all[at], &c->b);
}

#endif
