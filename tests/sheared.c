/* SPDX-License-Identifier: MIT */
/* Depths of round bodies and boxes under maps of any kind: along no way out, of hundreds, does the difference of the
 * bodies reach less far than is proven. Ways are sought by the supports, and what they come to is told in 113 bits.
 *
 *   sheared [PAIRS] [--seed SEED]     default 6000 pairs */
#include "pairs.h"
#include "settle.h"

#define WAYS 250  /* drawn for each pair, */
#define TURNS 200 /*   and of those from the best, and from the normal */

static long pairs = 6000;
static uint64_t seed = 1;
static pair p;

/* ---- drawing ---- */

/* Such numbers as make maps of any rank, or almost. */
static double entry(draws *d)
{
    switch (below(d, 8)) {
    case 0:
        return 0;
    case 1:
        return 1;
    case 2:
        return -1;
    case 3:
        return between(d, -30, 30);
    case 4:
        return 1 + (below(d, 9) - 4) * (double)REAL_EPSILON;
    case 5:
        return -1 + between(d, 0, 0.01);
    case 6:
        return between(d, -0.05, 0.05);
    default:
        return between(d, -1, 1);
    }
}

static double size(draws *d) { return below(d, 2) ? 1 : magnitude(d, -3, 1); }

static void draw_sheared(draws *d, body *b)
{
    static const enum kind kinds[] = {ELLIPSOID, BOX, BALL, CYLINDER, DISC, CONE, CONE, CONE};
    start_body(b, kinds[below(d, DIM == 3 ? 8 : 3)]);
    for (int i = 0; i < DIM; i++) {
        b->half[i] = (real)size(d);
    }
    b->radius = (real)size(d);
    b->half_length = (real)size(d);
    for (int i = 0; i < DIM * DIM; i++) {
        b->pose.m[i] = (real)entry(d);
    }
}

/* ---- ways out ---- */

/* How far the core of the body reaches along n, or with sign -1 against it. */
static double reach_along(const body *b, const double *n, int sign)
{
    double sum = 0;
    real dir[DIM], x[DIM];
    for (int j = 0; j < DIM; j++) {
        double along = 0;
        for (int i = 0; i < DIM; i++) {
            along += (double)b->pose.m[DIM * i + j] * n[i];
        }
        dir[j] = (real)(sign * along);
    }
    b->shape.support(b->shape.data, dir, x);
    for (int j = 0; j < DIM; j++) {
        sum += (double)dir[j] * (double)x[j] + sign * (double)b->pose.p[j] * n[j];
    }
    return sum;
}

/* How far A - B reaches along n, which is made a unit. */
static double height_along(double *n)
{
    double square = 0;
    for (int i = 0; i < DIM; i++) {
        square += n[i] * n[i];
    }
    for (int i = 0; i < DIM; i++) {
        n[i] /= sqrt(square);
    }
    return reach_along(&p.a, n, 1) + reach_along(&p.b, n, -1);
}

/* Takes n if it is shorter than the best. */
static int take_shorter(double n[DIM], double best[DIM], double *least)
{
    double height = height_along(n);
    if (!(height < *least)) {
        return 0;
    }
    *least = height;
    memcpy(best, n, DIM * sizeof *n);
    return 1;
}

/* Turns it to shorter ways nearby. */
static void turn_shorter(draws *d, double best[DIM], double *least)
{
    double far = 0.3;
    for (int k = 0; k < TURNS; k++) {
        double n[DIM];
        for (int i = 0; i < DIM; i++) {
            n[i] = best[i] + between(d, -far, far);
        }
        if (!take_shorter(n, best, least)) {
            far *= 0.93;
        }
    }
}

/* The shortest way out that is found, from any and from the normal. */
static quad seek_way_out(draws *d, const real *normal)
{
    double n[DIM], best[2][DIM] = {{0}}, least[2] = {1e300, 1e300};
    quad found = 0;
    for (int k = 0; k < WAYS; k++) {
        unit(d, n);
        take_shorter(n, best[0], &least[0]);
    }
    for (int i = 0; i < DIM; i++) {
        n[i] = (double)normal[i];
    }
    take_shorter(n, best[1], &least[1]);
    for (int k = 0; k < 2; k++) {
        real rounded[DIM];
        quad height;
        turn_shorter(d, best[k], &least[k]);
        for (int i = 0; i < DIM; i++) {
            rounded[i] = (real)best[k][i];
        }
        height = along_normal(&p.a, rounded, 1) + along_normal(&p.b, rounded, -1);
        found = k == 0 || height < found ? height : found;
    }
    return found;
}

/* ---- the tests ---- */

/* b is moved, so that the difference holds the origin, or almost. */
static void move_together(draws *d)
{
    double deep = between(d, 0, 0.6);
    for (int i = 0; i < DIM; i++) {
        double n[DIM] = {0};
        n[i] = 1;
        p.b.pose.p[i] = (real)(between(d, -deep, deep) * (reach_along(&p.a, n, 1) + reach_along(&p.b, n, -1)));
    }
}

static void no_way_out_is_shorter(void **state)
{
    long deep = 0, wrong = 0;
    (void)state;
    for (long at = 0; at < pairs; at++) {
        V(result) r;
        draws d = draws_from(seed, 0, (uint64_t)at);
        draw_sheared(&d, &p.a);
        draw_sheared(&d, &p.b);
        bind_pair(&p);
        move_together(&d);
        int status = V(penetration)(&p.a.shape, &p.b.shape, NULL, &r);
        int fair = status >= 0 && r.lower <= r.value && r.value <= r.upper;
        deep += fair && r.upper < 0;
        if (fair && (!(r.upper < 0) || seek_way_out(&d, r.normal) >= -(quad)r.upper)) {
            continue;
        }
        if (wrong++ == 0) {
            print_error("%s, pair %ld: status %d, upper %.17g\n", VARIANT, at, status, (double)r.upper);
            print_case(stderr, "penetration", &p.a, &p.b);
        }
    }
    printf("%-6s %ld of %ld pairs overlap\n", VARIANT, deep, pairs);
    assert_true(deep > pairs / 3);
    assert_int_equal(wrong, 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_way_out_is_shorter)};
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--seed") == 0 && i + 1 < argc) {
            seed = strtoull(argv[++i], NULL, 10);
        } else {
            pairs = strtol(argv[i], NULL, 10);
        }
    }
    return cmocka_run_group_tests_name("sheared bodies of " VARIANT, tests, NULL, NULL);
}
