/* SPDX-License-Identifier: MIT */
/* How many support calls a query costs each body: of boxes, cold; and of their corners as clouds, warm along a path of
 * small steps. */
#include "pairs.h"

#define COLD_PAIRS 20000
#define TRACKS 100
#define STEPS 100

static pair p;

/* Turned anyhow, apart by 0.1 to 2 along some direction. */
static void draw_apart(draws *d, double lo, double hi)
{
    double dir[DIM];
    memset(&p, 0, sizeof p);
    draw_box(d, &p.a, 0.25, 1);
    draw_box(d, &p.b, 0.25, 1);
    turn(d, &p.a, 100);
    turn(d, &p.b, 100);
    unit(d, dir);
    stand_off(&p, dir, between(d, lo, hi));
    bind_pair(&p);
}

static void cold_boxes(void **state)
{
    double sum = 0;
    int most = 0;
    (void)state;
    for (uint64_t i = 0; i < COLD_PAIRS; i++) {
        draws d = draws_from(1, 0, i);
        V(result) r;
        draw_apart(&d, 0.1, 2);
        assert_true(V(distance)(&p.a.shape, &p.b.shape, NULL, &r) >= 0);
        assert_true(r.lower > 0);
        sum += r.supports / 2.0;
        most = r.supports > most ? r.supports : most;
    }
    printf("%-6s cold: %.3f support calls per body, at most %.1f\n", VARIANT, sum / COLD_PAIRS, most / 2.0);
    assert_true(sum / COLD_PAIRS <= 1.1);
}

/* b slides across the normal by 0.005 and turns by 0.01 about a fixed axis; what the gap has lost or gained by that is
 * made good in the next step, so that it stays about 0.05. */
static void one_step(draws *d, const double turn_by[DIM * DIM], const V(result) * r)
{
    double side[DIM], along = 0, length = 0;
    real m[DIM * DIM];
    unit(d, side);
    for (int i = 0; i < DIM; i++) {
        along += side[i] * (double)r->normal[i];
    }
    for (int i = 0; i < DIM; i++) {
        side[i] -= along * (double)r->normal[i];
        length += side[i] * side[i];
    }
    for (int i = 0; i < DIM; i++) {
        double by = 0.005 * side[i] / sqrt(length) + (0.05 - (double)r->value) * (double)r->normal[i];
        p.b.pose.p[i] = (real)((double)p.b.pose.p[i] + by);
    }
    for (int i = 0; i < DIM; i++) {
        for (int j = 0; j < DIM; j++) {
            double sum = 0;
            for (int k = 0; k < DIM; k++) {
                sum += turn_by[i * DIM + k] * (double)p.b.pose.m[k * DIM + j];
            }
            m[i * DIM + j] = (real)sum;
        }
    }
    memcpy(p.b.pose.m, m, sizeof m);
}

/* The boxes' corners in their places. */
static void list_corners_of(V(points) clouds[2], real corners[2][1 << DIM][DIM])
{
    for (int k = 0; k < 2; k++) {
        body *b = k ? &p.b : &p.a;
        const V(box) *of = b->shape.data;
        for (int i = 0; i < 1 << DIM; i++) {
            for (int j = 0; j < DIM; j++) {
                corners[k][i][j] = i >> j & 1 ? of->half[j] : -of->half[j];
            }
        }
        clouds[k] = (V(points)){.v = corners[k][0], .count = 1 << DIM};
        clouds[k].reach = V(points_reach)(&clouds[k]);
        b->shape.support = V(support_points);
        b->shape.data = &clouds[k];
    }
}

static void warm_clouds(void **state)
{
    double sum = 0, gap = 0;
    int queries = 0;
    (void)state;
    for (uint64_t track = 0; track < TRACKS; track++) {
        draws d = draws_from(1, 1, track), slide = draws_from(1, 2, track);
        V(options) o = default_options();
        V(cache) cache;
        double turn_by[DIM * DIM];
        V(points) clouds[2];
        real corners[2][1 << DIM][DIM];
        memset(&cache, 0, sizeof cache);
        o.cache = &cache;
        draw_apart(&d, 0.05, 0.05);
        list_corners_of(clouds, corners);
        rotation(&d, 0.01, turn_by);
        for (int step = 0; step <= STEPS; step++) {
            draws same = slide; /* one direction for the whole track */
            V(result) r;
            assert_true(V(distance)(&p.a.shape, &p.b.shape, &o, &r) >= 0);
            if (step > 0) {
                sum += r.supports / 2.0;
                gap += (double)r.value;
                queries++;
            }
            one_step(&same, turn_by, &r);
        }
    }
    printf("%-6s warm: %.3f support calls per body, at a mean gap of %.3f\n", VARIANT, sum / queries, gap / queries);
    assert_true(sum / queries <= 1.3);
    assert_true(gap / queries > 0.03 && gap / queries < 0.07);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(cold_boxes), cmocka_unit_test(warm_clouds)};
    return cmocka_run_group_tests_name("support calls of " VARIANT, tests, NULL, NULL);
}
