/* SPDX-License-Identifier: MIT */
/* What must hold between the answers to related questions, over all families of pairs. */
#include "pairs.h"

#define PAIRS 400 /* of each family */

typedef struct answer {
    V(result) distance, intersect;
} answer;

static answer ask(const body *a, const body *b)
{
    answer r;
    memset(&r, 0, sizeof r);
    assert_true(V(distance)(&a->shape, &b->shape, NULL, &r.distance) >= 0);
    assert_true(V(intersect)(&a->shape, &b->shape, NULL, &r.intersect) >= 0);
    return r;
}

static V(result) distance_with(const pair *p, const V(options) * o)
{
    V(result) r;
    memset(&r, 0, sizeof r);
    assert_true(V(distance)(&p->a.shape, &p->b.shape, o, &r) >= 0);
    return r;
}

/* The size of the pair as rounding sees it. */
static double size_of(const body *k)
{
    real dir[DIM] = {1}, x[DIM];
    double sum = 0, reach = (double)k->shape.support(k->shape.data, dir, x);
    for (int i = 0; i < DIM * DIM; i++) {
        sum += fabs((double)k->pose.m[i]);
    }
    sum = sum * reach + (double)k->shape.radius;
    for (int i = 0; i < DIM; i++) {
        sum += fabs((double)k->pose.p[i]);
    }
    return sum;
}

static const char *law;
static enum family family;

static void fail_with(const pair *p, const answer *x, const answer *y)
{
    print_error("%s: %s fails for a pair of %s\n", VARIANT, law, family_name[family]);
    print_error("  distance %.17g .. %.17g and %.17g .. %.17g\n  intersect %.17g .. %.17g and %.17g .. %.17g\n  ",
                (double)x->distance.lower, (double)x->distance.upper, (double)y->distance.lower,
                (double)y->distance.upper, (double)x->intersect.lower, (double)x->intersect.upper,
                (double)y->intersect.lower, (double)y->intersect.upper);
    print_case(stderr, "distance", &p->a, &p->b);
    fail();
}

/* Brackets of truths that differ by the given amount at most must come that near to each other. */
static void must_agree(const pair *p, const answer *x, const answer *y, double apart)
{
    const V(result) * pairs[4] = {&x->distance, &y->distance, &x->intersect, &y->intersect};
    for (int i = 0; i < 4; i += 2) {
        double lower = fmax((double)pairs[i]->lower, (double)pairs[i + 1]->lower);
        double upper = fmin((double)pairs[i]->upper, (double)pairs[i + 1]->upper);
        if (!(lower <= upper + apart)) {
            fail_with(p, x, y);
        }
    }
}

static void must_be_same(const pair *p, const answer *x, const answer *y)
{
    if (memcmp(x, y, sizeof *x) != 0) {
        fail_with(p, x, y);
    }
}

/* Whether stretch_pair reaches all lengths of the pair, and leaves them numbers. */
static int can_stretch(const pair *p, real by)
{
    double size = size_of(&p->a) + size_of(&p->b);
    return !is_extreme(family) && family != CLOUDS && size * (double)by <= (double)REAL_MAX / 64;
}

typedef void check_fn(pair *p, draws *d);

static void for_all(check_fn *check, const char *name)
{
    static pair p;
    law = name;
    for (int f = 0; f < FAMILIES; f++) {
        family = (enum family)f;
        for (uint64_t i = 0; i < PAIRS; i++) {
            draws d = draws_from(2, (uint64_t)f, i);
            draw_pair(&d, family, &p);
            check(&p, &d);
        }
    }
}

static void check_repeat(pair *p, draws *d)
{
    answer x = ask(&p->a, &p->b), y = ask(&p->a, &p->b);
    (void)d;
    must_be_same(p, &x, &y);
}

static void check_swap(pair *p, draws *d)
{
    answer x = ask(&p->a, &p->b), y = ask(&p->b, &p->a);
    (void)d;
    must_agree(p, &x, &y, 0);
}

static void check_agreement(pair *p, draws *d)
{
    answer x = ask(&p->a, &p->b);
    const V(result) *m = &x.distance, *i = &x.intersect;
    double size = size_of(&p->a) + size_of(&p->b);
    int ok = !(m->lower > 0 && i->upper < 0) && !(i->upper < 0 && m->lower > 0) && !(i->lower > m->upper);
    (void)d;
    ok &= !(i->upper >= 0 && i->upper < m->lower);
    /* so far apart, that must be seen */
    ok &= !((double)m->lower > 100 * U * size + (double)REAL_MIN && !(i->lower > 0));
    if (!ok) {
        fail_with(p, &x, &x);
    }
}

#define SPACED (DIM + 2) /* numbers from point to point */

static void space_out(body *b, real spaced[MAX_POINTS * SPACED])
{
    for (int n = 0; n < b->count; n++) {
        for (int i = 0; i < SPACED; i++) {
            spaced[n * SPACED + i] = i < DIM ? b->v[n][i] : (real)NAN;
        }
    }
    b->set.points.v = spaced;
    b->set.points.stride = SPACED * sizeof(real);
}

/* Points that stand farther apart in memory, something else between them. */
static void check_stride(pair *p, draws *d)
{
    static real spaced[2][MAX_POINTS * SPACED];
    answer x = ask(&p->a, &p->b), y;
    (void)d;
    for (int k = 0; k < 2; k++) {
        body *b = k ? &p->b : &p->a;
        if (b->kind == POINTS) {
            space_out(b, spaced[k]);
        }
    }
    y = ask(&p->a, &p->b);
    must_be_same(p, &x, &y);
}

/* Into a common frame that is only rounded: the truth moves by the rounding of the poses. */
static void check_motion(pair *p, draws *d)
{
    answer x = ask(&p->a, &p->b), y;
    double m[DIM * DIM], shift[DIM], size = size_of(&p->a) + size_of(&p->b);
    body *both[2] = {&p->a, &p->b};
    pair q = *p;
    rotation(d, 100, m);
    unit(d, shift);
    for (int k = 0; k < 2; k++) {
        V(pose) moved;
        for (int i = 0; i < DIM; i++) {
            double sum = shift[i];
            for (int j = 0; j < DIM; j++) {
                double row = 0;
                for (int l = 0; l < DIM; l++) {
                    row += m[i * DIM + l] * (double)both[k]->pose.m[l * DIM + j];
                }
                moved.m[i * DIM + j] = (real)row;
                sum += m[i * DIM + j] * (double)both[k]->pose.p[j];
            }
            moved.p[i] = (real)sum;
        }
        (k ? &q.b : &q.a)->pose = moved;
    }
    bind_pair(&q);
    y = ask(&q.a, &q.b);
    must_agree(p, &x, &y, 16 * U * (size + 1));
}

/* The same sets with the axes renamed and mirrored: the same numbers in another order. */
static void check_axes(pair *p, draws *d)
{
    answer x = ask(&p->a, &p->b), y;
    int first = below(d, DIM);
    pair q = *p;
    body *from[2] = {&p->a, &p->b}, *to[2] = {&q.a, &q.b};
    for (int i = 0; i < DIM; i++) {
        real sign = (real)(below(d, 2) ? -1 : 1);
        for (int k = 0; k < 2; k++) {
            to[k]->pose.p[i] = sign * from[k]->pose.p[(i + first) % DIM];
            for (int j = 0; j < DIM; j++) {
                to[k]->pose.m[i * DIM + j] = sign * from[k]->pose.m[(i + first) % DIM * DIM + j];
            }
        }
    }
    bind_pair(&q);
    y = ask(&q.a, &q.b);
    must_agree(p, &x, &y, 0);
}

/* A move that no rounding sees leaves every bit, and the witnesses move along. */
static void check_lattice_motion(pair *p, draws *d)
{
    answer x, y;
    real shift[DIM];
    body *both[2] = {&p->a, &p->b};
    if (family != LATTICES) {
        return;
    }
    x = ask(&p->a, &p->b);
    for (int i = 0; i < DIM; i++) {
        shift[i] = (real)((1 << below(d, 16)) * (below(d, 2) ? -1 : 1));
        both[0]->pose.p[i] += shift[i];
        both[1]->pose.p[i] += shift[i];
    }
    y = ask(&p->a, &p->b);
    for (int i = 0; i < DIM; i++) {
        double off = 4 * U * (fabs((double)shift[i]) + 64);
        assert_true(fabs((double)y.distance.point_a[i] - (double)shift[i] - (double)x.distance.point_a[i]) <= off);
        assert_true(fabs((double)y.distance.point_b[i] - (double)shift[i] - (double)x.distance.point_b[i]) <= off);
        y.distance.point_a[i] = x.distance.point_a[i];
        y.distance.point_b[i] = x.distance.point_b[i];
        y.intersect.point_a[i] = x.intersect.point_a[i];
        y.intersect.point_b[i] = x.intersect.point_b[i];
    }
    must_be_same(p, &x, &y);
}

static void shuffle(draws *d, body *b)
{
    if (b->kind != POINTS) {
        return;
    }
    while (b->count < 2 * MOST_POINTS && below(d, 4)) {
        memcpy(b->v[b->count], b->v[below(d, b->count)], sizeof b->v[0]);
        b->count++;
    }
    for (int i = b->count - 1; i > 0; i--) {
        real x[DIM];
        int j = below(d, i + 1);
        memcpy(x, b->v[i], sizeof x);
        memcpy(b->v[i], b->v[j], sizeof x);
        memcpy(b->v[j], x, sizeof x);
    }
}

static void check_vertices(pair *p, draws *d)
{
    answer x = ask(&p->a, &p->b), y;
    pair q = *p;
    shuffle(d, &q.a);
    shuffle(d, &q.b);
    bind_pair(&q);
    y = ask(&q.a, &q.b);
    must_agree(p, &x, &y, 0);
}

/* The sum of the two radii is taken off the separation of the cores, to the bit of the truth. */
static void check_radius(pair *p, draws *d)
{
    answer x, y;
    real ra = (real)(below(d, 4) ? between(d, 0, 2) : 0), rb = (real)magnitude(d, -6, 1);
    double sum, slack, low, high;
    p->a.shape.radius = 0;
    p->b.shape.radius = 0;
    x = ask(&p->a, &p->b);
    p->a.shape.radius = ra;
    p->b.shape.radius = rb;
    y = ask(&p->a, &p->b);
    sum = (double)ra + (double)rb;
    slack = 4 * DBL_EPSILON * sum; /* of this sum and of these differences */
    low = fmax(0, (double)x.distance.lower - sum - slack);
    high = fmax(0, (double)x.distance.upper - sum + slack);
    if (!((double)y.distance.lower <= high && (double)y.distance.upper >= low)) {
        fail_with(p, &x, &y);
    }
    if ((double)x.distance.lower > sum + 100 * U * (size_of(&p->a) + size_of(&p->b)) && !(y.intersect.lower > 0)) {
        fail_with(p, &x, &y);
    }
    if ((double)x.distance.upper < sum - 100 * U * (size_of(&p->a) + size_of(&p->b)) && !(y.intersect.upper < 0)) {
        fail_with(p, &x, &y);
    }
}

static void stretch_numbers(real *x, int n, real by)
{
    for (int i = 0; i < n; i++) {
        x[i] *= by;
    }
}

static void stretch_body(body *b, real by)
{
    stretch_numbers(b->v[0], MAX_POINTS * DIM, by);
    stretch_numbers(b->half, DIM, by);
    stretch_numbers(&b->radius, 1, by);
    stretch_numbers(&b->half_length, 1, by);
    stretch_numbers(b->pose.p, DIM, by);
    stretch_numbers(&b->shape.radius, 1, by);
}

static void stretch_pair(pair *p, real by)
{
    stretch_body(&p->a, by);
    stretch_body(&p->b, by);
    for (int i = 0; i < 4; i++) {
        stretch_body(&p->part[i], by);
    }
    bind_pair(p);
}

static void stretch_result(V(result) * r, real by)
{
    stretch_numbers(&r->value, 1, by);
    stretch_numbers(&r->lower, 1, by);
    stretch_numbers(&r->upper, 1, by);
    stretch_numbers(r->point_a, DIM, by);
    stretch_numbers(r->point_b, DIM, by);
}

/* Lengths in another unit, a power of two apart: the same bits. */
static void check_unit_of_length(pair *p, draws *d)
{
    answer x = ask(&p->a, &p->b), y;
    int most = sizeof(real) == 8 ? 200 : 16;
    real by = (real)ldexp(1, below(d, 2 * most + 1) - most);
    pair q = *p;
    if (!can_stretch(p, by) || size_of(&p->a) + size_of(&p->b) < 1e-30) {
        return; /* two points in one place have no length to measure by */
    }
    stretch_pair(&q, by);
    y = ask(&q.a, &q.b);
    stretch_result(&x.distance, by);
    stretch_result(&x.intersect, by);
    must_be_same(p, &x, &y);
}

/* Near the ends of the range bits are lost, but not the truth. */
static void check_extreme_unit(pair *p, draws *d)
{
    answer x = ask(&p->a, &p->b), y;
    int most = sizeof(real) == 8 ? 900 : 90;
    real by = (real)ldexp(1, (below(d, 2) ? 1 : -1) * (most - below(d, most / 8)));
    pair q = *p;
    if (!can_stretch(p, by)) {
        return;
    }
    stretch_pair(&q, by);
    y = ask(&q.a, &q.b);
    stretch_result(&y.distance, 1 / by);
    stretch_result(&y.intersect, 1 / by);
    must_agree(p, &x, &y, 16 * (double)REAL_MIN * (double)REAL_EPSILON / (double)by); /* what was lost below it */
}

/* A cache that has seen the pair, and one that has seen it elsewhere. */
static void check_warm(pair *p, draws *d)
{
    answer x = ask(&p->a, &p->b), y = x;
    V(options) o = default_options();
    V(cache) cache;
    double dir[DIM];
    memset(&cache, 0, sizeof cache);
    o.cache = &cache;
    for (int round = 0; round < 3; round++) {
        assert_true(V(distance)(&p->a.shape, &p->b.shape, &o, &y.distance) >= 0);
        assert_true(V(intersect)(&p->a.shape, &p->b.shape, &o, &y.intersect) >= 0);
        must_agree(p, &x, &y, 0);
    }
    unit(d, dir);
    move(&p->b, dir, magnitude(d, -6, 1));
    x = ask(&p->a, &p->b);
    assert_true(V(distance)(&p->a.shape, &p->b.shape, &o, &y.distance) >= 0);
    assert_true(V(intersect)(&p->a.shape, &p->b.shape, &o, &y.intersect) >= 0);
    must_agree(p, &x, &y, 0);
}

/* Whether they meet is told the same whatever tolerances and cutoff are asked for, cold and warm. */
static void check_tolerances(pair *p, draws *d)
{
    answer x = ask(&p->a, &p->b), y = x;
    V(options) o = default_options();
    V(cache) plain, cache;
    o.abs_tol = (real)(below(d, 2) ? magnitude(d, -9, 1) : 0);
    o.rel_tol = (real)(below(d, 2) ? magnitude(d, -9, 0) : 0);
    o.cutoff = (real)(below(d, 2) ? magnitude(d, -3, 1) : 0);
    assert_true(V(intersect)(&p->a.shape, &p->b.shape, &o, &y.intersect) >= 0);
    must_be_same(p, &x, &y);
    memset(&plain, 0, sizeof plain);
    cache = plain;
    for (int round = 0; round < 2; round++) {
        V(options) without = default_options();
        without.cache = &plain;
        o.cache = &cache;
        assert_true(V(intersect)(&p->a.shape, &p->b.shape, &without, &x.intersect) >= 0);
        assert_true(V(intersect)(&p->a.shape, &p->b.shape, &o, &y.intersect) >= 0);
        must_be_same(p, &x, &y);
    }
}

static void must_not_cost_more(const pair *p, const V(result) * r, int32_t steps)
{
    if (r->steps > steps) {
        print_error("%s: %d steps, then %d, for a pair of %s: %.17g .. %.17g\n  ", VARIANT, steps, r->steps,
                    family_name[family], (double)r->lower, (double)r->upper);
        print_case(stderr, "distance", &p->a, &p->b);
        fail();
    }
}

/* Looser tolerances and nearer cutoffs never cost more steps, and a cutoff beyond the answer changes nothing. */
static void check_effort(pair *p, draws *d)
{
    V(options) o = default_options();
    V(result) full = distance_with(p, &o), r;
    int32_t steps = full.steps;
    (void)d;
    if (is_extreme(family)) {
        return; /* a tenth less may be the same number */
    }
    for (int k = -12; k <= 1; k++) {
        o.rel_tol = (real)power_of_ten(k);
        r = distance_with(p, &o);
        must_not_cost_more(p, &r, steps);
        steps = r.steps;
    }
    o.rel_tol = 0;
    o.cutoff = full.upper * (real)1.001;
    r = distance_with(p, &o);
    assert_memory_equal(&r, &full, sizeof r);
    steps = full.steps;
    for (int k = 9; k >= 1; k--) {
        o.cutoff = full.lower * (real)k / 10;
        r = distance_with(p, &o);
        must_not_cost_more(p, &r, steps);
        assert_true(o.cutoff > 0 ? r.status == GJK_DECIDED && r.lower > o.cutoff : r.status >= 0);
        steps = r.steps;
    }
    o.cutoff = 0;
    for (uint32_t limit = 1; limit < 6; limit++) {
        o.max_steps = limit;
        r = distance_with(p, &o);
        assert_true((uint32_t)r.steps <= limit);
        assert_true(r.lower <= full.upper && full.lower <= r.upper);
        assert_true(r.status != GJK_LIMIT || (uint32_t)r.steps == limit);
        if (full.steps <= (int32_t)limit && memcmp(&r, &full, sizeof r) != 0) {
            print_error("%s: %d steps allowed, %d needed: %d and %d support calls, statuses %d and %d\n  ", VARIANT,
                        limit, full.steps, r.supports, full.supports, r.status, full.status);
            print_case(stderr, "distance", &p->a, &p->b);
            fail();
        }
    }
}

/* Near contact v is as small as what its corners lost to rounding, and its direction noise. The normal must not be.
 * Whether the pair is that near. */
static int check_normal(const pair *p)
{
    V(options) tight = default_options();
    tight.tight = 1;
    V(result) fast = distance_with(p, NULL), exact = distance_with(p, &tight);
    if (!(exact.value > 0 && (double)exact.value < 100 * U * (size_of(&p->a) + size_of(&p->b)))) {
        return 0;
    }
    for (int k = 0; k < DIM; k++) {
        double off = fabs((double)fast.normal[k] - (double)exact.normal[k]);
        if (off > 16 * U) {
            print_error("%s: normal off by %g, %g apart\n  ", VARIANT, off, (double)exact.value);
            print_case(stderr, "distance", &p->a, &p->b);
            fail();
        }
    }
    return 1;
}

static void normal_near_contact(void **state)
{
    static pair p;
    int near = 0;
    (void)state;
    for (uint64_t i = 0; i < 4000; i++) {
        draws d = draws_from(3, GAPS, i);
        draw_pair(&d, GAPS, &p);
        near += check_normal(&p);
    }
    assert_true(near > 100);
}

/* A simplex from its first corner along the first axis, forwards or backwards. */
static void draw_wedge(draws *d, body *b, const real tip[DIM], double forwards)
{
    start_body(b, POINTS);
    b->count = DIM + 1;
    memcpy(b->v[0], tip, sizeof b->v[0]);
    for (int k = 1; k <= DIM; k++) {
        for (int i = 0; i < DIM; i++) {
            double side = i == 0 ? forwards : i == k ? 0.5 : -0.5;
            b->v[k][i] = (real)((double)tip[i] + side * between(d, 0.5, 1));
        }
    }
}

/* Two tips that nearly meet, less apart than the rounding of a number as large as the one is: what its map and
 * position leave of it, the other is, a little off. */
static void normal_of_tips(void **state)
{
    static pair p;
    int near = 0;
    (void)state;
    for (uint64_t i = 0; i < 4000; i++) {
        draws d = draws_from(9, 0, i);
        real tip[DIM], mate[DIM];
        double way[DIM], gap = U * U * magnitude(&d, 1, 4);
        memset(&p, 0, sizeof p);
        unit(&d, way);
        for (int k = 0; k < DIM; k++) {
            tip[k] = (real)between(&d, -1, 1);
        }
        draw_wedge(&d, &p.b, tip, 1);
        turn(&d, &p.b, magnitude(&d, -4, 0) / 10);
        for (int k = 0; k < DIM; k++) {
            double at = 0;
            for (int j = 0; j < DIM; j++) {
                at += (double)p.b.pose.m[k * DIM + j] * (double)tip[j];
            }
            p.b.pose.p[k] = (real)-at;
            mate[k] = (real)(at + (double)p.b.pose.p[k] - gap * (k ? way[k] : fabs(way[k])));
        }
        draw_wedge(&d, &p.a, mate, -1);
        bind_pair(&p);
        near += check_normal(&p);
    }
    assert_true(near > 100);
}

#if DIM == 2
/* An edge or more, U * 2^-6 long at most, square to the first axis at the end of it, and up to two corners behind. */
static void draw_blunt(draws *d, body *b, double forwards)
{
    const int tips = 2 + below(d, 3);
    start_body(b, POINTS);
    b->count = tips + below(d, 3);
    for (int k = 0; k < b->count; k++) {
        const double aside = U * ldexp(between(d, -1, 1), -6 - below(d, 8));
        b->v[k][0] = (real)(forwards * (k < tips ? 1 : between(d, -1, 0.5)));
        b->v[k][1] = (real)(k < tips ? aside : between(d, -1, 1));
    }
    turn(d, b, 100);
    for (int i = 0; i < DIM; i++) {
        b->pose.p[i] = (real)(-forwards * (double)b->pose.m[DIM * i]);
    }
}

/* Their ends lie in one place, but for how long these edges are: of numbers with twice the digits there are few left to
 * tell an edge's direction. (Of 90,000 such pairs one is off that owes nothing to that: there a corner is as near as
 * the edge beside it.) */
static void normal_of_short_edges(void **state)
{
    static pair p;
    int near = 0;
    (void)state;
    for (uint64_t i = 0; i < 20000; i++) {
        draws d = draws_from(9, 1, i);
        memset(&p, 0, sizeof p);
        draw_blunt(&d, &p.a, 1);
        draw_blunt(&d, &p.b, -1);
        bind_pair(&p);
        near += (double)distance_with(&p, NULL).lower > U * 0x1p-12 && check_normal(&p);
    }
    assert_true(near > 1000);
}
#endif

#define LAW(name)                                                                                                      \
    static void name(void **state)                                                                                     \
    {                                                                                                                  \
        (void)state;                                                                                                   \
        for_all(check_##name, #name);                                                                                  \
    }
LAW(repeat)
LAW(swap)
LAW(agreement)
LAW(stride)
LAW(motion)
LAW(axes)
LAW(lattice_motion)
LAW(vertices)
LAW(radius)
LAW(unit_of_length)
LAW(extreme_unit)
LAW(warm)
LAW(tolerances)
LAW(effort)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(repeat),
        cmocka_unit_test(swap),
        cmocka_unit_test(agreement),
        cmocka_unit_test(stride),
        cmocka_unit_test(motion),
        cmocka_unit_test(axes),
        cmocka_unit_test(lattice_motion),
        cmocka_unit_test(vertices),
        cmocka_unit_test(radius),
        cmocka_unit_test(unit_of_length),
        cmocka_unit_test(warm),
        cmocka_unit_test(tolerances),
        cmocka_unit_test(extreme_unit),
        cmocka_unit_test(effort),
        cmocka_unit_test(normal_near_contact),
        cmocka_unit_test(normal_of_tips),
#if DIM == 2
        cmocka_unit_test(normal_of_short_edges),
#endif
    };
    return cmocka_run_group_tests_name("laws of " VARIANT, tests, NULL, NULL);
}
