/* SPDX-License-Identifier: MIT */
/* The cases of tests/cases, whose truth was found in exact arithmetic by other code (tests/oracle). They judge the
 * library, and also truth.h, which judges the library elsewhere. */
#include "cases.h"
#include "truth.h"

#define VALUE_ERROR 4.0   /* in u * scale */
#define WIDTH 16.0        /* of polytopes that meet, in u * scale; with radii, in u * span */
#define SMOOTH_WIDTH 100. /* of others, in u * span */
#define NORMAL_ERROR 16.0 /* of the separation along the normal, in u * scale */
#define UNIT_ERROR 8.0    /* in u */
#define TELLS 100.0       /* in u * span: farther apart, intersect must say so */

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

/* ---- depth ---- */

typedef struct depth_case {
    const test_case *c;
    const body *a, *b;
    const truth *t;
    quad low, high; /* the signed separation is between */
    double span;
    int known, sharp; /* corners that the library knows; and no radius */
} depth_case;

static double max_depth_error, max_depth_width, max_excess, max_grown_width, max_smooth_width;
static long smooth_depths, depth_limits;

static double in_u(quad x, quad unit) { return (double)(x / ((quad)U * unit + (quad)REAL_MIN)); }

/* Of the bodies along the normal, radii included; NaN where that is not unit. */
static quad separation_along(const depth_case *d, const real *normal)
{
    quad n[DIM], back[DIM], x[DIM], y[DIM], along = 0, length;
    for (int i = 0; i < DIM; i++) {
        n[i] = (quad)normal[i];
        back[i] = -n[i];
    }
    length = quad_length(n);
    if (!(quad_abs(length - 1) <= (quad)(UNIT_ERROR * U))) {
        return (quad)NAN;
    }
    quad_farthest(&d->t->a, n, x);
    quad_farthest(&d->t->b, back, y);
    for (int i = 0; i < DIM; i++) {
        along += n[i] * (y[i] - x[i]) * d->t->unit;
    }
    return along / length - (quad)d->a->shape.radius - (quad)d->b->shape.radius;
}

/* Of every pair, whatever the room. */
static void check_separation(const depth_case *d, const V(result) * r, quad along)
{
    check(d->c, (quad)r->lower <= d->high && (quad)r->upper >= d->low, "the bracket of the depth misses the truth", r);
    check(d->c, r->lower <= r->value && r->value <= r->upper, "the depth is outside its bracket", r);
    check(d->c, along - along == 0, "the normal is not unit", r);
    check(d->c, in_u((quad)r->lower - along, (quad)d->span) <= NORMAL_ERROR, "the normal does not realise lower", r);
}

/* Of a pair that meets, with room. */
static void check_depth(const depth_case *d, const V(result) * r, quad along)
{
    quad v = (quad)r->value, wide = (quad)r->upper - (quad)r->lower;
    double error = in_u(v > d->high ? v - d->high : v < d->low ? d->low - v : 0, d->t->scale);
    double width = in_u(wide, d->sharp ? d->t->scale : (quad)d->span), excess = in_u(d->low - along, d->t->scale);
    double *widest = d->sharp ? &max_depth_width : d->known ? &max_grown_width : &max_smooth_width;
    smooth_depths += !d->known;
    if (!d->known && r->status == GJK_LIMIT) {
        depth_limits++;
        return;
    }
    *widest = fmax(*widest, width);
    check(d->c, width <= (d->known ? WIDTH : SMOOTH_WIDTH), "the bracket of the depth is wide", r);
    if (d->known) {
        max_depth_error = fmax(max_depth_error, error);
        max_excess = fmax(max_excess, excess);
        check(d->c, error <= VALUE_ERROR, "the depth is off", r);
        check(d->c, excess <= NORMAL_ERROR, "the normal leads another way out", r);
        check(d->c, !d->sharp || r->upper <= 0, "penetration does not see that they meet", r);
    }
}

/* As soon as distance sees it. */
static void check_apart(const depth_case *d, const V(result) * r)
{
    V(result) as;
    memset(&as, 0, sizeof as);
    as.status = V(distance)(&d->a->shape, &d->b->shape, NULL, &as);
    check(d->c, !(as.lower > 0) || (as.value == r->value && as.lower == r->lower && as.upper == r->upper),
          "apart, but not what distance says", r);
}

/* penetration in the usual room, in much, and in the least. */
static void depth_of_case(const test_case *c, const body *a, const body *b, const truth *t, V(cache) * cache)
{
    static real room[1 << 16];
    static const uint32_t corners[] = {0, 1000, 8};
    quad small = ((quad)t->a.size + (quad)t->b.size) * t->unit * (quad)1e-28;
    int known = has_corners(a) && has_corners(b);
    depth_case d = {c, a, b, t, 0, 0, span_of_pair(a, b), known, known && !(a->shape.radius + b->shape.radius > 0)};
    V(options) o = default_options();
    d.low = (quad)c->separation[0] + (quad)c->separation[1];
    d.high = (quad)c->separation[2] + (quad)c->separation[3];
    o.cache = cache;
    if (!(t->lower <= d.high + small && t->upper >= d.low - small)) {
        failures++;
        print_error("%s: truth.h is wrong about the depth\n", c->id);
    }
    for (int k = 0; k < 3; k++) {
        V(result) r;
        quad along;
        memset(&r, 0, sizeof r);
        o.workspace_bytes = (uint32_t)V(workspace_size)(corners[k]);
        o.workspace = corners[k] ? room : NULL;
        assert_true(o.workspace_bytes <= sizeof room);
        check(c, V(penetration)(&a->shape, &b->shape, &o, &r) >= 0, "penetration fails", &r);
        along = separation_along(&d, r.normal);
        check_separation(&d, &r, along);
        if (c->relation != K(APART) && corners[k] != 8) {
            check_depth(&d, &r, along);
        }
        if (c->relation == K(APART) && !cache) {
            check_apart(&d, &r);
        }
    }
}

/* ---- each case ---- */

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
    depth_of_case(c, a, b, &t, cache);
}

static void cold(void **state)
{
    (void)state;
    for (size_t i = 0; i < C(_count); i++) {
        one_case(&C(_all)[i], NULL);
    }
    printf("%-6s %zu cases: error at most %.2f u * scale for polytopes, %.2f for round shapes\n", VARIANT, C(_count),
           max_error, max_round_error);
    printf("%-6s depths: error at most %.2f, bracket %.2f, excess along the normal %.2f u * scale of polytopes; "
           "bracket with radii %.1f, of round shapes %.1f u * span, but for %ld limits of %ld\n",
           VARIANT, max_depth_error, max_depth_width, max_excess, max_grown_width, max_smooth_width, depth_limits,
           smooth_depths);
    printf("%-6s tight: %ld cases, error at most %.3f ulp\n", VARIANT, tight_cases, max_ulps);
    assert_true(tight_cases > 100);
    assert_true(smooth_depths > 10 && depth_limits < smooth_depths / 3);
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
