/* SPDX-License-Identifier: MIT */
/* Rings of corners around the origin, from inside: a variant is compiled in. Of few points on a grid, turned, so that
 * some are in line but for rounding, a ring that is started with any three that hold the origin, on the hull or not,
 * ends at the lowest of the hull's edges, in few corners; and the origin is beside the edge that is named for that. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "splitmix.h"
#include "inside.h"

#define POINTS 8
#define ROUNDS 20000
#define SLOP (64 * UNIT * 12) /* no point is farther out than 12 */

static uint64_t state_of_draws;
static mark at[POINTS];

static int below_any(int n) { return (int)(splitmix64(&state_of_draws) % (uint64_t)n); }

static void draw_turned(int count)
{
    for (int i = 0; i < count; i++) {
        const real x = (real)(below_any(17) - 8), y = (real)(below_any(17) - 8);
        at[i] = (mark){x * (real)0.8 - y * (real)0.6, x * (real)0.6 + y * (real)0.8, (unsigned)i};
    }
}

static real length_between(const mark *p, const mark *q)
{
    return root((q->x - p->x) * (q->x - p->x) + (q->y - p->y) * (q->y - p->y));
}

static const mark origin = {0, 0, 0};

/* How far the origin is to the left of the way from p to q. */
static real far_from(const mark *p, const mark *q)
{
    const real l = length_between(p, q);
    return l > 0 ? left_of(p, q, &origin) / l : 0;
}

/* How near the hull's edges come to the origin: below 0 where that is outside. */
static real least_of_hull(int count)
{
    real least = REAL_MAX;
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++) {
            const real l = length_between(&at[i], &at[j]);
            int outer = l > 0;
            for (int k = 0; k < count && outer; k++) outer = left_of(&at[i], &at[j], &at[k]) >= -SLOP * l;
            if (outer) least = smaller(far_from(&at[i], &at[j]), least);
        }
    }
    return least;
}

/* Three of the points that hold the origin with room. 0: these do not. */
static int draw_three(int count, mark of[3])
{
    for (int i = 0; i < 3; i++) of[i] = at[below_any(count)];
    const real turn = left_of(&of[0], &of[1], &of[2]) < 0 ? -1 : 1;
    for (int i = 0; i < 3; i++)
        if (!(far_from(&of[i], &of[(i + 1) % 3]) * turn > SLOP)) return 0;
    return 1;
}

/* The point farthest out beyond the edge. */
static mark farthest_beyond(int count, const mark *p, const mark *q)
{
    mark best = at[0];
    for (int i = 1; i < count; i++) best = left_of(p, q, &at[i]) < left_of(p, q, &best) ? at[i] : best;
    return best;
}

static void grows_to_the_lowest(void **state)
{
    long tried = 0, hidden = 0;
    (void)state;
    for (int round = 0; round < ROUNDS; round++) {
        const int count = 3 + below_any(POINTS - 2);
        mark of[3];
        ring o;
        unsigned i, live = 0;
        draw_turned(count);
        if (!draw_three(count, of)) continue;
        start_ring(&o, of[0], of[1], of[2]);
        for (;;) {
            i = lowest_of_ring(&o);
            const mark *p = &o.at[i], *q = &o.at[o.next[i]], far = farthest_beyond(count, p, q);
            if (!(left_of(p, q, &far) < 0) || far.at == p->at || far.at == q->at) break;
            assert_true(o.count < 3 + POINTS);
            split_edge(&o, i, far);
        }
        assert_true(size(o.far[i] - least_of_hull(count)) <= SLOP);
        for (unsigned k = 0; k < o.count; k++) live += o.far[k] < GONE;
        unsigned round_it = 0;
        for (unsigned k = i; round_it == 0 || k != i; k = o.next[k]) {
            assert_true(o.last[o.next[k]] == k && o.far[k] < GONE && o.far[k] >= o.far[i]);
            round_it++;
        }
        assert_true(round_it == live);
        const unsigned beside = edge_beside(&o, i);
        const mark *p = &o.at[beside], *q = &o.at[o.next[beside]];
        const real x = q->x - p->x, y = q->y - p->y, along = -(p->x * x + p->y * y), l = length_between(p, q);
        assert_true(along >= -SLOP * l && along <= l * l + SLOP * l);
        assert_true(far_from(p, q) <= o.far[i] + SLOP);
        tried++;
        hidden += live < o.count;
    }
    assert_true(tried > ROUNDS / 20);
    assert_true(hidden > tried / 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(grows_to_the_lowest)};
    return cmocka_run_group_tests_name("rings", tests, NULL, NULL);
}
