/* SPDX-License-Identifier: MIT */
/* How much of the stack queries take, as the header says of optimised builds: each is asked in a thread of its own, on
 * a stack that is painted before and looked at after. */
#define _POSIX_C_SOURCE 200112L /* for pthread_attr_setstack */
#include "pairs.h"
#include "sets.h"

#include <pthread.h>

#define STACK (1 << 20)
#define PAGE 4096
#define PAINT 0xa5
#define PAIRS 40    /* of each family, */
#define GAPPED 1000 /* and of those with gaps that rounding all but blurs */

/* What the header says, in bytes: of distance and intersect, and of penetration; with a workspace of the caller's so
 * much less, but where that is not what takes the most. */
#if VARIANT_FLOAT
#define DISTANCE_STACK (DIM == 3 ? 58000 : 39000)
#define PENETRATION_STACK (DIM == 3 ? 58000 : 39000)
#define SAVED (DIM == 3 ? 0 : V(workspace_size)(64) / 2)
#else
#define DISTANCE_STACK (DIM == 3 ? 54000 : 37000)
#define SAVED (V(workspace_size)(64) / 2)
#define PENETRATION_STACK (DIM == 3 ? 95000 : 63000)
#endif

#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
#define IS_HELD 1
#else
#define IS_HELD 0
#endif
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#undef IS_HELD
#define IS_HELD 0
#endif
#endif

static union {
    real aligned;
    unsigned char bytes[1 << 15];
} room;

typedef struct asked {
    int query; /* none below 0 */
    pair p;
    V(options) options;
    V(result) result;
} asked;

static int (*const queries[])(const V(shape) *, const V(shape) *, const V(options) *,
                              V(result) *) = {V(distance), V(intersect), V(penetration)};
static const char *const query_name[] = {"distance", "intersect", "penetration", "penetration in a workspace"};

static void *ask(void *of)
{
    asked *q = of;
    if (q->query >= 0) {
        queries[q->query](&q->p.a.shape, &q->p.b.shape, &q->options, &q->result);
    }
    return NULL;
}

/* The bytes of a thread's stack that it writes to. */
static size_t stack_of(asked *q)
{
    static unsigned char *stack, *base;
    pthread_attr_t how;
    pthread_t thread;
    size_t left = 0;
    if (!stack) {
        stack = malloc(STACK + PAGE);
        assert_non_null(stack);
        base = stack + (PAGE - (uintptr_t)stack % PAGE);
    }
    memset(base, PAINT, STACK);
    assert_int_equal(pthread_attr_init(&how), 0);
    assert_int_equal(pthread_attr_setstack(&how, base, STACK), 0);
    assert_int_equal(pthread_create(&thread, &how, ask, q), 0);
    assert_int_equal(pthread_join(thread, NULL), 0);
    assert_int_equal(pthread_attr_destroy(&how), 0);
    while (left < STACK && base[left] == PAINT) {
        left++;
    }
    return STACK - left;
}

/* A ball touches a face of a box. */
static void draw_touching_ball(draws *d, pair *p)
{
    const int face = below(d, DIM);
    start_body(&p->a, BOX);
    start_body(&p->b, ORIGIN);
    for (int i = 0; i < DIM; i++) {
        p->a.half[i] = (real)(1 + below(d, 4)) / 4;
        p->b.pose.p[i] = (real)(below(d, 9) - 4) / 4 * p->a.half[i];
    }
    const real radius = (real)(1 + below(d, 4)) / 8;
    p->b.pose.p[face] = p->a.half[face] + radius;
    bind_pair(p);
    p->b.shape.radius = radius;
}

/* Of each query, in a workspace or not, to the last place or not, the most so far. */
static void ask_about(asked *q, size_t most[4], size_t nothing)
{
    for (uint32_t k = 0; k < 8; k++) {
        memset(&q->options, 0, sizeof q->options);
        q->options.size = sizeof q->options;
        q->options.tight = k % 2;
        q->query = k / 2 < 2 ? (int)(k / 2) : 2;
        if (k / 2 == 3) {
            q->options.workspace = room.bytes;
            q->options.workspace_bytes = (uint32_t)V(workspace_size)(64);
        }
        const size_t taken = stack_of(q) - nothing;
        most[k / 2] = taken > most[k / 2] ? taken : most[k / 2];
    }
}

static void within_what_the_header_says(void **state)
{
    static asked q;
    size_t most[4] = {0}, nothing;
    (void)state;
    q.query = -1;
    nothing = stack_of(&q);
    for (int family = 0; family < FAMILIES; family++) {
        for (uint64_t at = 0; at < (family == GAPS ? GAPPED : PAIRS); at++) {
            draws d = draws_from(17, (uint64_t)family, at);
            draw_pair(&d, (enum family)family, &q.p);
            bind_pair(&q.p);
            ask_about(&q, most, nothing);
        }
    }
    for (uint64_t at = 0; at < PAIRS; at++) {
        draws d = draws_from(18, 0, at);
        draw_touching_ball(&d, &q.p);
        ask_about(&q, most, nothing);
    }
    for (int k = 0; k < 4; k++) {
        printf("%-6s %s takes up to %zu bytes of stack%s\n", VARIANT, query_name[k], most[k],
               IS_HELD ? "" : ", which is not held to the header's number in such a build");
    }
    assert_true(most[0] > 1000);
    if (IS_HELD) {
        assert_true(most[0] <= DISTANCE_STACK && most[1] <= DISTANCE_STACK);
        assert_true(most[2] <= PENETRATION_STACK);
        assert_true(most[3] + SAVED <= PENETRATION_STACK);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(within_what_the_header_says)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
