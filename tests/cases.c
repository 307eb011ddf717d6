/* SPDX-License-Identifier: MIT */
/* The cases of tests/cases, whose truth was found in exact arithmetic by other code (tests/oracle). They judge the
 * library, and also truth.h, which judges the library elsewhere. */
#include "cases.h"
#include "truth.h"

#define VALUE_ERROR 4.0 /* in u * scale */
#define TELLS 100.0     /* in u * span: farther apart, intersect must say so */

static int failures;

static void check(const test_case *c, int holds, const char *what, const V(result) * r)
{
    if (!holds) {
        failures++;
        print_error("%s: %s; distance %.17g .. %.17g, answer %d %.17g .. %.17g .. %.17g\n", c->id, what, c->lower_hi,
                    c->upper_hi, r->status, (double)r->lower, (double)r->value, (double)r->upper);
    }
}

static double max_error, max_round_error, max_ulps;
static long tight_cases;

/* The step from the number that x rounds to, to the next larger one. */
static double ulp_of(quad x)
{
    int e;
    frexp(fmax((double)x, (double)REAL_MIN), &e);
    return ldexp((double)REAL_EPSILON, e - 1);
}

/* With options.tight: of points, boxes, segments, triangles and single points to the last bit, contact as exactly 0,
 * and whether they meet is always told. Of other shapes as good an answer as without. */
static void tight_case(const test_case *c, const body *a, const body *b, V(cache) * cache, quad low, quad high)
{
    int exact = has_corners(a) && has_corners(b);
    double ulp = ulp_of(high), ulps;
    quad v;
    V(options) o = default_options();
    V(result) r;
    memset(&r, 0, sizeof r);
    o.tight = 1;
    o.cache = cache;
    check(c, V(distance)(&a->shape, &b->shape, &o, &r) >= 0, "tight distance fails", &r);
    check(c, (quad)r.lower <= high && (quad)r.upper >= low, "the tight bracket misses the truth", &r);
    check(c, r.lower <= r.value && r.value <= r.upper, "the tight value is outside its bracket", &r);
    if (exact) {
        v = (quad)r.value;
        ulps = (double)(v > high ? v - high : v < low ? low - v : 0) / ulp;
        tight_cases++;
        max_ulps = fmax(max_ulps, ulps);
        check(c, ulps <= 1, "the tight value is off", &r);
        check(c, (quad)r.upper - (quad)r.lower <= (quad)(2 * ulp), "the tight bracket is wide", &r);
        check(c, c->relation == K(APART) || r.upper == 0, "contact is not exactly 0", &r);
        check(c, c->relation != K(APART) || r.lower > 0, "not proven to be apart", &r);
    }
    check(c, V(intersect)(&a->shape, &b->shape, &o, &r) >= 0, "tight intersect fails", &r);
    check(c, (quad)r.lower <= high, "the tight lower is above the truth", &r);
    check(c, !(r.lower > 0) || c->relation == K(APART), "wrongly called apart, with tight", &r);
    check(c, !(r.upper < 0) || c->relation == K(OVERLAPPING), "wrongly called overlapping, with tight", &r);
    check(c, !exact || (r.lower > 0) == (c->relation == K(APART)), "apart or not is not told", &r);
    check(c, !exact || (r.upper <= 0) == (c->relation != K(APART)), "meeting or not is not told", &r);
}

static void one_case(const test_case *c, V(cache) * cache)
{
    static truth t;
    const body *a, *b;
    quad low = (quad)c->lower_hi + (quad)c->lower_lo, high = (quad)c->upper_hi + (quad)c->upper_lo, v, small;
    double error, span;
    int sharp;
    V(options) o = default_options();
    V(result) r;
    memset(&r, 0, sizeof r);
    o.cache = cache;
    read_case(c, &a, &b);
    find_truth(&t, a, b, 1);
    span = span_of_pair(a, b);
    sharp = t.a.count && t.b.count;

    small = ((quad)t.a.size + (quad)t.b.size) * (quad)1e-28;
    check(c, positive(t.lower) <= high + small && positive(t.upper) >= low - small, "truth.h is wrong", &r);
    check(c, !sharp || t.certified, "truth.h is not sure", &r);
    check(c, c->relation != K(APART) || t.lower > 0 || !sharp, "truth.h does not see them apart", &r);
    check(c, c->relation != K(OVERLAPPING) || t.upper < 0 || !sharp, "truth.h does not see them overlap", &r);

    check(c, V(distance)(&a->shape, &b->shape, &o, &r) >= 0, "distance fails", &r);
    v = (quad)r.value;
    error = (double)((v > high ? v - high : v < low ? low - v : 0) / ((quad)U * t.scale + (quad)REAL_MIN));
    check(c, (quad)r.lower <= high && (quad)r.upper >= low, "the bracket misses the truth", &r);
    check(c, r.lower <= r.value && r.value <= r.upper, "the value is outside its bracket", &r);
    check(c, !sharp || error <= VALUE_ERROR, "the value is off", &r);
    max_error = sharp ? fmax(max_error, error) : max_error;
    max_round_error = sharp ? max_round_error : fmax(max_round_error, error);

    check(c, V(intersect)(&a->shape, &b->shape, &o, &r) >= 0, "intersect fails", &r);
    check(c, !(r.lower > 0) || c->relation == K(APART), "wrongly called apart", &r);
    check(c, !(r.upper < 0) || c->relation == K(OVERLAPPING), "wrongly called overlapping", &r);
    check(c, (quad)r.lower <= high, "lower is above the truth", &r);
    check(c, r.lower > 0 || (double)low <= TELLS * U * span, "not seen to be apart", &r);
    check(c, r.upper <= 0 || (double)-t.upper <= TELLS * U * span, "not seen to meet", &r);
    check(c, !(r.upper <= 0) || c->relation != K(APART), "wrongly said to meet", &r);
    tight_case(c, a, b, cache, low, high);
}

static void cold(void **state)
{
    (void)state;
    for (size_t i = 0; i < C(_count); i++) {
        one_case(&C(_all)[i], NULL);
    }
    printf("%-6s %zu cases: error at most %.2f u * scale for polytopes, %.2f for round shapes\n", VARIANT, C(_count),
           max_error, max_round_error);
    printf("%-6s tight: %ld cases, error at most %.3f ulp\n", VARIANT, tight_cases, max_ulps);
    assert_true(tight_cases > 100);
    assert_true(C(_count) > 100);
    assert_int_equal(failures, 0);
}

/* The cache of each case handed on to the next. */
static void warm(void **state)
{
    V(cache) cache;
    (void)state;
    memset(&cache, 0, sizeof cache);
    for (size_t i = 0; i < C(_count); i++) {
        one_case(&C(_all)[i], &cache);
        one_case(&C(_all)[i], &cache);
    }
    assert_int_equal(failures, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(cold), cmocka_unit_test(warm)};
    return cmocka_run_group_tests_name("cases of " VARIANT, tests, NULL, NULL);
}
