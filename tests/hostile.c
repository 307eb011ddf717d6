/* SPDX-License-Identifier: MIT */
/* Supports of no convex set: they lie, waver, come round late. Whatever they say, a query ends, with a whole result or
 * none. Its upper bound is proven by points that were handed out, and where the pairs of points that came together lie
 * nearer to each other than a plane of the walk allows, the bounds cross and the library says GJK_BAD_SUPPORT, which it
 * never says without such a contradiction. Supports that only fall short, by no more than the declared slack, are not
 * hostile at all: the bracket holds for the exact sets. */
#include "pairs.h"
#include "truth.h"

#define PAIRS 400 /* of bodies, for each way to lie */
#define MOST_SEEN MAX_POINTS
#define ROUNDING 128.0  /* in u * span: what doubt may add to a bound */
#define MOST_CALLS 3000 /* in one query of the default limit: twice 256 steps, some of them again without the cache */

/* ---- liars ---- */

enum lie {
    REVERSED, /* the nearest point, not the farthest: a sign got wrong */
    BLOBS,    /* of two bodies apart from each other, either one */
    RING,     /* a point in that direction, on a rim that bulges in and out */
    NOISY,    /* the farthest point, and noise of the same size for each direction */
    WAVERING, /* the farthest point, and other noise each time */
    SLOW,     /* points inside first, the farthest later */
    FADING,   /* the farthest points first, points inside later */
    TURNING,  /* two bodies by turns */
    RANDOM,   /* anything */
    LIES
};

static const char *const lie_name[LIES] = {"reversed", "blobs",  "ring",    "noisy", "wavering",
                                           "slow",     "fading", "turning", "random"};

/* What a body pretends to be, and all that it has said. */
typedef struct liar {
    V(shape) honest[2];
    enum lie lie;
    double size; /* of the lie, in the body's own size */
    uint64_t seed;
    long calls, seen;
    int at; /* of the call where SLOW and FADING change */
    real points[MOST_SEEN][DIM], dirs[MOST_SEEN][DIM];
} liar;

/* -1 to 1, by the seed, the direction and the place. */
static double hash(uint64_t seed, const real *dir, int i)
{
    uint64_t state = seed + (uint64_t)i;
    for (int j = 0; j < DIM; j++) {
        uint64_t word = 0;
        memcpy(&word, &dir[j], sizeof dir[j]);
        state = splitmix64(&state) ^ word;
    }
    return (double)(splitmix64(&state) >> 11) / 4503599627370496.0 - 1;
}

static void shrink(real *point, double by)
{
    for (int i = 0; i < DIM; i++) {
        point[i] = (real)((double)point[i] * by);
    }
}

static void shake(real *point, double by, uint64_t seed, const real *dir)
{
    for (int i = 0; i < DIM; i++) {
        point[i] = (real)((double)point[i] + by * hash(seed, dir, i));
    }
}

static void around(const real *dir, double radius, real *point)
{
    double n = 0;
    for (int i = 0; i < DIM; i++) {
        n = fmax(n, fabs((double)dir[i]));
    }
    for (int i = 0; i < DIM; i++) {
        point[i] = (real)(radius * (double)dir[i] / n);
    }
}

static real lie_about(liar *z, const real *dir, real *point)
{
    const V(shape) *s = &z->honest[0];
    real back[DIM], reach;
    switch (z->lie) {
    case REVERSED:
        for (int i = 0; i < DIM; i++) {
            back[i] = -dir[i];
        }
        return s->support(s->data, back, point);
    case BLOBS:
        s = &z->honest[hash(z->seed, dir, 0) > 0];
        break;
    case TURNING:
        s = &z->honest[z->calls % 2];
        break;
    case RING:
        around(dir, 1 + z->size * hash(z->seed, dir, 0), point);
        return 4;
    case RANDOM:
        around(dir, 1, point);
        shake(point, 1, z->seed + (uint64_t)z->calls, dir);
        return 4;
    default:
        break;
    }
    reach = s->support(s->data, dir, point);
    if (z->lie == NOISY || z->lie == WAVERING) {
        shake(point, z->size, z->lie == NOISY ? z->seed : z->seed + (uint64_t)z->calls, dir);
    } else if ((z->lie == SLOW && z->calls < z->at) || (z->lie == FADING && z->calls >= z->at)) {
        shrink(point, 1 - z->size);
    }
    return 2 * (reach + (real)z->size);
}

static real hostile_support(const void *data, const real *dir, real *point)
{
    liar *z = (liar *)(uintptr_t)data;
    real reach = lie_about(z, dir, point);
    z->calls++;
    if (z->seen < MOST_SEEN) {
        memcpy(z->points[z->seen], point, sizeof z->points[0]);
        memcpy(z->dirs[z->seen], dir, sizeof z->dirs[0]);
    }
    z->seen++;
    return reach;
}

/* ---- what the answers allow ---- */

static struct {
    long asked, refused, unchecked;
} tally[LIES];

static void as_said(body *out, const liar *z, const V(pose) * pose, real radius)
{
    start_body(out, POINTS);
    out->count = (int)z->seen;
    memcpy(out->v, z->points, sizeof out->v);
    out->pose = *pose;
    out->shape.radius = radius;
    bind(out);
}

/* What the answers say together. The bodies are only moved, not turned: a direction is the same for both. */
typedef struct account {
    double nearest; /* distance of the two points that came together and are nearest to each other */
    double beyond;  /* the farthest that a plane of one call keeps the cores apart */
    truth hulls;    /* of all points */
    double rounding, radius;
    body a, b;
} account;

static double apart(const pair *p, const liar *x, const liar *y, int call, const real *along)
{
    double sum = 0, n = 0;
    for (int i = 0; i < DIM; i++) {
        double w = ((double)x->points[call][i] - (double)y->points[call][i]) +
                   ((double)p->a.pose.p[i] - (double)p->b.pose.p[i]);
        sum += along ? (double)along[i] * w : w * w;
        n += along ? (double)along[i] * (double)along[i] : 0;
    }
    return along ? sum / sqrt(n) : sqrt(sum);
}

static void listen(account *t, const pair *p, const liar *x, const liar *y)
{
    as_said(&t->a, x, &p->a.pose, p->a.shape.radius);
    as_said(&t->b, y, &p->b.pose, p->b.shape.radius);
    find_truth(&t->hulls, &t->a, &t->b, 1);
    t->rounding = ROUNDING * U * span_of_pair(&t->a, &t->b);
    t->radius = (double)p->a.shape.radius + (double)p->b.shape.radius;
    t->nearest = HUGE_VAL;
    t->beyond = -HUGE_VAL;
    for (int k = 0; k < x->seen && k < y->seen; k++) {
        t->nearest = fmin(t->nearest, apart(p, x, y, k, NULL) - t->radius);
        t->beyond = fmax(t->beyond, apart(p, x, y, k, y->dirs[k]) - t->radius);
    }
}

static void must_hold(int holds, const char *what, enum lie lie, const V(result) * r, const account *t)
{
    if (holds) {
        return;
    }
    print_error("%s, %s: %s; the nearest points are %.17g apart, a plane says %.17g\n  ", VARIANT, lie_name[lie], what,
                t->nearest, t->beyond);
    print_error("status %d, %.17g .. %.17g .. %.17g; what was handed out:\n  ", r->status, (double)r->lower,
                (double)r->value, (double)r->upper);
    print_case(stderr, "distance", &t->a, &t->b);
    fail();
}

/* first: no earlier query has left points behind. */
static void check_what_was_said(int query, int status, const V(result) * r, const pair *p, const liar *x, const liar *y,
                                int first)
{
    static account t;
    double rounding;
    if (x->seen > MOST_SEEN || y->seen > MOST_SEEN) {
        tally[x->lie].unchecked++;
        return;
    }
    listen(&t, p, x, y);
    rounding = t.rounding;
    if (status < 0) { /* all points lie behind each plane, or something was wrong */
        must_hold(t.beyond > (double)t.hulls.lower - rounding, "refused without reason", x->lie, r, &t);
        return;
    }
    must_hold((double)r->upper >= (double)(query ? t.hulls.lower : positive(t.hulls.lower)) - rounding,
              "the upper bound is of no points", x->lie, r, &t);
    if (first && r->lower > 0) {
        must_hold((double)r->lower <= t.nearest + rounding, "the lower bound is beyond a pair of points", x->lie, r,
                  &t);
        must_hold((double)r->upper >= t.beyond - rounding, "the upper bound is below a plane", x->lie, r, &t);
    }
}

typedef int query_fn(const V(shape) *, const V(shape) *, const V(options) *, V(result) *);
static query_fn *const queries[2] = {V(distance), V(intersect)};

/* Returns the status, of a result that is whole or untouched. */
static int ask(int query, const V(shape) * a, const V(shape) * b, const V(options) * o, V(result) * r)
{
    V(result) before;
    memset(&before, 0x5a, sizeof before);
    *r = before;
    int status = queries[query](a, b, o, r);
    if (status < 0) {
        assert_int_equal(status, GJK_BAD_SUPPORT);
        assert_memory_equal(r, &before, sizeof before);
    } else {
        assert_int_equal(status, r->status);
        assert_true(r->lower <= r->value && r->value <= r->upper);
        assert_in_range(r->steps, 1, 257 + 3 * 4);
    }
    return status;
}

/* ---- anything may be said ---- */

static void draw_liar(draws *d, liar *z, enum lie lie, const body *first, const body *second)
{
    z->honest[0] = first->shape;
    z->honest[1] = second->shape;
    z->lie = lie;
    z->size = magnitude(d, VARIANT_FLOAT ? -6 : -14, 0);
    z->seed = bits(d);
    z->at = 1 + below(d, 6);
    z->calls = z->seen = 0;
}

static void unturn(body *b)
{
    for (int i = 0; i < DIM * DIM; i++) {
        b->pose.m[i] = i % (DIM + 1) == 0;
    }
}

static void one_pair_of_liars(draws *d, enum lie lie)
{
    static pair p, other;
    static liar x, y;
    V(options) o = default_options();
    V(cache) cache;
    V(shape) a, b;
    V(result) r;
    memset(&cache, 0, sizeof cache);
    draw_pair(d, below(d, 2) ? HULLS : BOXES, &p);
    draw_pair(d, HULLS, &other);
    unturn(&p.a);
    unturn(&p.b);
    if (below(d, 3) == 0) {
        p.a.shape.radius = (real)between(d, 0, 0.5);
    }
    draw_liar(d, &x, lie, &p.a, &other.a);
    draw_liar(d, &y, lie, &p.b, &other.b);
    a = p.a.shape;
    b = p.b.shape;
    a.support = hostile_support;
    a.data = &x;
    if (below(d, 2)) {
        b.support = hostile_support;
        b.data = &y;
    } else { /* an honest one, heard all the same: shrunk by nothing */
        y.lie = FADING;
        y.size = 0;
        b.support = hostile_support;
        b.data = &y;
    }
    for (int n = 0; n < 6; n++) {
        int query = n % 2;
        long calls;
        if (n < 4) {
            x.calls = x.seen = y.calls = y.seen = 0;
        }
        o.tight = (uint32_t)(n / 2 % 2);
        o.cache = n < 4 ? NULL : &cache; /* what was said while it was filled counts too */
        calls = x.calls + y.calls;
        tally[lie].asked++;
        int status = ask(query, &a, &b, &o, &r);
        tally[lie].refused += status < 0;
        check_what_was_said(query, status, &r, &p, &x, &y, n < 4);
        assert_in_range(x.calls + y.calls - calls, 2, MOST_CALLS);
    }
}

static void all_lies(void **state)
{
    const enum lie lie = (enum lie)(uintptr_t)*state;
    for (uint64_t i = 0; i < PAIRS; i++) {
        draws d = draws_from(12, (uint64_t)lie, i);
        one_pair_of_liars(&d, lie);
    }
    printf("%-6s %-8s %ld queries, %ld refused, %ld with more points than are checked\n", VARIANT, lie_name[lie],
           tally[lie].asked, tally[lie].refused, tally[lie].unchecked);
    assert_true(tally[lie].unchecked < tally[lie].asked / 4);
    assert_true(tally[lie].refused > tally[lie].asked / 100);
}

/* ---- bounds that must cross ---- */

/* On the first axis: the points said one after the other, the last one for ever. */
static struct {
    double said[4];
    int calls;
} script;

static real scripted_support(const void *data, const real *dir, real *point)
{
    (void)data;
    (void)dir;
    memset(point, 0, DIM * sizeof *point);
    point[0] = (real)script.said[script.calls < 3 ? script.calls : 3];
    script.calls++;
    return 4;
}

/* The point 0 against what the script says, at 3. */
static void expect_distance(int swap, int tight, const double *said, int crossed)
{
    body a, b;
    V(options) o = default_options();
    V(result) r;
    o.tight = (uint32_t)tight;
    memcpy(script.said, said, sizeof script.said);
    script.calls = 0;
    start_points(&a, &b);
    b.shape.support = scripted_support;
    b.pose.p[0] = 3;
    int status = ask(0, swap ? &b.shape : &a.shape, swap ? &a.shape : &b.shape, &o, &r);
    assert_true((status == GJK_BAD_SUPPORT) == crossed);
}

/* Slow: that no point lies nearer than the first was proof of a distance, and then a nearer one comes. Fading: the
 * first point is reached, and then no point is to lie so near. By less than rounding explains it may not be seen. */
static void slow_and_fading_on_a_line(void **state)
{
    (void)state;
    for (int swap = 0; swap < 2; swap++) {
        for (int tight = 0; tight < 2; tight++) {
            for (double by = 1; by > 512 * U; by /= 2) {
                const double slow[4] = {0, -by, -by, -by}, slower[4] = {0, 0, -by, -by}, fading[4] = {0, by, by, by};
                const double same[4] = {0, 0, 0, 0};
                expect_distance(swap, tight, slow, 1);
                expect_distance(swap, tight, fading, 1);
                expect_distance(swap, tight, slower, 0); /* it was believed before that */
                expect_distance(swap, tight, same, 0);
            }
        }
    }
}

/* A box that along an axis hands out a corner short by so much, along all other directions the right one: the first
 * call, along the line of centres, is the wrong one, and the corners after it show it. */
static real axis_liar(const void *data, const real *dir, real *point)
{
    double by = *(const double *)data;
    int axes = 0;
    for (int i = 0; i < DIM; i++) {
        axes += dir[i] != 0;
        point[i] = dir[i] < 0 ? -1 : 1;
    }
    if (axes == 1) {
        point[0] = (real)((double)point[0] * (1 - by));
    }
    return 2;
}

static void short_along_an_axis(void **state)
{
    static body a, b;
    V(options) o = default_options();
    V(result) r;
    (void)state;
    for (double by = 1; by > 1024 * U; by /= 2) {
        start_body(&a, BOX);
        start_body(&b, SEGMENT);
        b.v[0][1] = (real)-0.5; /* its middle is no corner: the second direction is none of the axes */
        b.v[1][1] = (real)0.25;
        bind(&a);
        bind(&b);
        a.shape.support = axis_liar;
        a.shape.data = &by;
        b.pose.p[0] = 4;
        for (int swap = 0; swap < 2; swap++) {
            const V(shape) *x = swap ? &b.shape : &a.shape, *y = swap ? &a.shape : &b.shape;
            o.slack = 0;
            assert_int_equal(ask(0, x, y, &o, &r), GJK_BAD_SUPPORT);
            o.slack = (real)(by * 1.000001); /* declared, it is none */
            assert_true(ask(0, x, y, &o, &r) >= 0);
            assert_true((double)r.lower <= 3 && 3 <= (double)r.upper);
        }
    }
}

/* ---- wide, and said so ---- */

/* The point 0 against (0, 1) first, then (1, 1 - step), (1, 1 - 2 step) and so on: along v, which turns by step with
 * each of them, each lies lower by step than all before. That brings v nearer by less than its square rounds, so the
 * walk ends after some of them, on a bracket a step wide. */
static double late_step;
static int late_calls;
static real late_support(const void *data, const real *dir, real *point)
{
    (void)data;
    (void)dir;
    memset(point, 0, DIM * sizeof *point);
    point[0] = late_calls > 0 ? -1 : 0;
    point[1] = (real)(late_calls * late_step - 1);
    late_calls++;
    return 1.5;
}

static int ask_late(real abs_tol, real rel_tol, V(result) * r)
{
    body a, b;
    V(options) o = default_options();
    o.abs_tol = abs_tol;
    o.rel_tol = rel_tol;
    late_calls = 0;
    start_points(&a, &b);
    b.shape.support = late_support;
    b.shape.pose = NULL;
    int status = ask(0, &a.shape, &b.shape, &o, r);
    double off = late_calls * late_step;
    assert_true((double)r->lower <= 1 - late_step && (double)r->upper >= 1 - off * off);
    return status;
}

/* Ok is said of a bracket as narrow as asked; no tolerance asked, of one that roundings explain: four times what they
 * add to each bound, 16 of the reach. */
static void no_wider_than_ok(void **state)
{
    const double least = VARIANT_FLOAT ? 0x1p-17 : 0x1p-46;
    V(result) r;
    (void)state;
    for (late_step = least; late_step < 2 * least; late_step += least / 16) {
        real step = (real)late_step;
        assert_int_equal(ask_late(0, 0, &r), GJK_FLOOR);
        assert_true((double)r.upper - (double)r.lower > 4 * 16 * 1.5 * U);
        assert_int_equal(ask_late(step, 0, &r), GJK_FLOOR);
        assert_int_equal(ask_late(0, step, &r), GJK_FLOOR);
        assert_int_equal(ask_late(4 * step, 0, &r), GJK_OK);
        assert_int_equal(ask_late(0, 4 * step, &r), GJK_OK);
    }
    late_step = 0;
    assert_int_equal(ask_late(0, 0, &r), GJK_OK);
}

/* ---- short, and said so ---- */

/* A support that stays in its set and short of its farthest point by no more than declared, each time otherwise. */
typedef struct waverer {
    V(shape) exact;
    double short_by;
    uint64_t calls;
} waverer;

static real wavering_support(const void *data, const real *dir, real *point)
{
    waverer *z = (waverer *)(uintptr_t)data;
    real ahead[DIM] = {0}, other[DIM], reach = z->exact.support(z->exact.data, dir, point);
    double way = 0, share = (1 + hash(z->calls, dir, 0)) / 2;
    z->calls++;
    ahead[z->calls % DIM] = z->calls % 3 ? 1 : -1;
    z->exact.support(z->exact.data, ahead, other);
    for (int i = 0; i < DIM; i++) {
        way += fabs((double)point[i] - (double)other[i]);
    }
    share *= way > z->short_by ? z->short_by / way : 1;
    for (int i = 0; i < DIM; i++) {
        point[i] = (real)((double)point[i] + share * ((double)other[i] - (double)point[i]));
    }
    return reach;
}

static void one_short_pair(draws *d, const pair *p, const truth *t)
{
    waverer x = {p->a.shape, magnitude(d, VARIANT_FLOAT ? -5 : -12, 1), 0}, y = {p->b.shape, 0, 0};
    V(shape) a = p->a.shape, b = p->b.shape;
    V(options) o = default_options();
    V(cache) cache;
    V(result) r;
    memset(&cache, 0, sizeof cache);
    a.support = b.support = wavering_support;
    a.data = &x;
    b.data = &y;
    y.short_by = x.short_by;
    o.slack = (real)(x.short_by * 1.000001);
    for (int n = 0; n < 8; n++) {
        int query = n % 2;
        double low = (double)(query ? t->lower : positive(t->lower));
        double high = (double)(query ? t->upper : positive(t->upper));
        o.tight = (uint32_t)(n / 2 % 2);
        o.cache = n < 4 ? NULL : &cache;
        o.max_steps = below(d, 3) ? 0 : (uint32_t)(1 + below(d, 8));
        int status = ask(query, &a, &b, &o, &r);
        if (status < 0 || (double)r.lower > high || (double)r.upper < low) {
            print_error(
                "%s: short by up to %.3g, slack said so: query %d of %d: status %d %.17g .. %.17g, truth %.17g\n  ",
                VARIANT, x.short_by, n, 8, status, (double)r.lower, (double)r.upper, high);
            print_case(stderr, query ? "intersect" : "distance", &p->a, &p->b);
            fail();
        }
    }
}

static void short_within_the_slack(void **state)
{
    static const enum family families[] = {HULLS, BOXES, LATTICES, CLOSE, FLAT, ROUNDED};
    static pair p;
    static truth t;
    (void)state;
    for (int f = 0; f < 6; f++) {
        for (uint64_t i = 0; i < PAIRS; i++) {
            draws d = draws_from(13, (uint64_t)f, i);
            draw_pair(&d, families[f], &p);
            for (int k = 0; k < 2; k++) { /* slack is of the set's own size, and grows with its map */
                body *b = k ? &p.b : &p.a;
                double by = i % 3 ? 1 : k ? 8 : 16;
                b->shape.radius = families[f] == ROUNDED ? b->shape.radius : 0;
                unturn(b);
                for (int j = 0; j < DIM * DIM; j++) {
                    b->pose.m[j] *= (real)by;
                }
            }
            bind_pair(&p);
            find_truth(&t, &p.a, &p.b, 1);
            one_short_pair(&d, &p, &t);
        }
    }
}

#define OTHERS 4

int main(void)
{
    struct CMUnitTest tests[LIES + OTHERS] = {
        cmocka_unit_test(slow_and_fading_on_a_line),
        cmocka_unit_test(short_along_an_axis),
        cmocka_unit_test(no_wider_than_ok),
        cmocka_unit_test(short_within_the_slack),
    };
    for (int k = 0; k < LIES; k++) {
        tests[OTHERS + k].name = lie_name[k];
        tests[OTHERS + k].test_func = all_lies;
        tests[OTHERS + k].initial_state = (void *)(uintptr_t)k;
    }
    return cmocka_run_group_tests_name("hostile supports to " VARIANT, tests, NULL, NULL);
}
