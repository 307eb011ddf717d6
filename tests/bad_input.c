/* SPDX-License-Identifier: MIT */
/* Each kind of bad input has its outcome: GJK_BAD_ARGUMENT for what the call itself carries, GJK_BAD_SUPPORT for what
 * the supports return, and the result untouched by both; or, where the input is odd but legal, the truth. */
#include "bodies.h"

static body a, b;

/* Two boxes of half size 1 on the first axis, 3 from centre to centre: 1 apart. */
static int fresh(void **state)
{
    (void)state;
    start_body(&a, BOX);
    start_body(&b, BOX);
    for (int i = 0; i < DIM; i++) {
        a.half[i] = b.half[i] = 1;
    }
    b.pose.p[0] = 3;
    bind(&a);
    bind(&b);
    return 0;
}

typedef int query_fn(const V(shape) *, const V(shape) *, const V(options) *, V(result) *);
#define QUERIES 3
static query_fn *const queries[QUERIES] = {V(distance), V(intersect), V(penetration)};

static void expect_query(query_fn *query, const V(shape) * x, const V(shape) * y, const V(options) * o, int status)
{
    V(result) r, before;
    memset(&before, 0x5a, sizeof before);
    r = before;
    assert_int_equal(query(x, y, o, &r), status);
    if (status < 0) {
        assert_memory_equal(&r, &before, sizeof r);
    }
}

/* Both ways round, all queries. */
static void expect_with(const V(options) * o, int status)
{
    for (int q = 0; q < QUERIES; q++) {
        expect_query(queries[q], &a.shape, &b.shape, o, status);
        expect_query(queries[q], &b.shape, &a.shape, o, status);
    }
}

static void expect(int status) { expect_with(NULL, status); }

/* Legal: all queries answer, and their brackets hold the truth. */
static void expect_truth_with(const V(options) * o, double truth)
{
    V(result) r;
    for (int swap = 0; swap < 2; swap++) {
        const V(shape) *x = swap ? &b.shape : &a.shape, *y = swap ? &a.shape : &b.shape;
        assert_true(V(distance)(x, y, o, &r) >= 0);
        assert_true((double)r.lower <= fmax(truth, 0) && fmax(truth, 0) <= (double)r.upper);
        assert_true(r.lower <= r.value && r.value <= r.upper);
        for (int q = 1; q < QUERIES; q++) {
            assert_true(queries[q](x, y, o, &r) >= 0);
            assert_true((double)r.lower <= truth && truth <= (double)r.upper);
            assert_true(r.lower <= r.value && r.value <= r.upper);
        }
    }
}

static void expect_truth(double truth) { expect_truth_with(NULL, truth); }

#define BAD_NUMBERS 4
static real bad_number(int i)
{
    const real bad[BAD_NUMBERS] = {(real)NAN, (real)INFINITY, -(real)INFINITY, -(real)NAN};
    return bad[i];
}

/* ---- pointers ---- */

static void null_pointers(void **state)
{
    V(result) r;
    (void)state;
    for (int q = 0; q < QUERIES; q++) {
        expect_query(queries[q], NULL, &b.shape, NULL, GJK_BAD_ARGUMENT);
        expect_query(queries[q], &a.shape, NULL, NULL, GJK_BAD_ARGUMENT);
        assert_int_equal(queries[q](&a.shape, &b.shape, NULL, NULL), GJK_BAD_ARGUMENT);
    }
    a.shape.support = NULL;
    expect(GJK_BAD_ARGUMENT);
    bind(&a);
    a.shape.data = NULL;
    expect(GJK_BAD_SUPPORT);
    bind(&a);
    a.shape.pose = NULL;
    expect_truth(1);
    assert_int_equal(V(distance)(&a.shape, &a.shape, NULL, &r), GJK_OK);
}

static void ready_made_without_data(void **state)
{
    V(support_fn) *const all[] = {
        V(support_points),
        V(support_box),
        V(support_segment),
        V(support_ball),
        V(support_ellipsoid),
        V(support_sum),
        V(support_hull),
#if DIM == 3
        V(support_triangle),
        V(support_cylinder),
        V(support_cone),
        V(support_disc),
#endif
    };
    (void)state;
    a.shape.data = NULL;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        a.shape.support = all[i];
        expect(GJK_BAD_SUPPORT);
    }
    a.shape.support = V(support_origin);
    expect_truth(2);
}

/* ---- numbers ---- */

static void poses_not_finite(void **state)
{
    (void)state;
    for (int k = 0; k < BAD_NUMBERS; k++) {
        for (int i = 0; i < DIM * DIM; i++) {
            fresh(NULL);
            a.pose.m[i] = bad_number(k);
            expect(GJK_BAD_ARGUMENT);
        }
        for (int i = 0; i < DIM; i++) {
            fresh(NULL);
            a.pose.p[i] = bad_number(k);
            expect(GJK_BAD_ARGUMENT);
        }
    }
}

static void radii(void **state)
{
    (void)state;
    for (int k = 0; k < BAD_NUMBERS; k++) {
        a.shape.radius = bad_number(k);
        expect(GJK_BAD_ARGUMENT);
    }
    a.shape.radius = -REAL_MIN;
    expect(GJK_BAD_ARGUMENT);
    a.shape.radius = -(real)0.0;
    expect_truth(1);
    a.shape.radius = (real)0.5;
    expect_truth(0.5);
    b.shape.radius = (real)0.5;
    expect_truth(0);
}

/* A body of that kind, of size 1 about. */
static void some_body(body *k, enum kind kind)
{
    start_body(k, kind);
    k->radius = k->half_length = 1;
    k->count = 1 << DIM;
    for (int i = 0; i < DIM; i++) {
        k->half[i] = 1;
        for (int n = 0; n < 1 << DIM; n++) {
            k->v[n][i] = (real)(n >> i & 1 ? 1 : -1);
        }
    }
}

/* Neither is a radius below 0, if the other's makes up for it, whether they are apart or overlap, and whatever a cache
 * has kept of the same bodies without. */
static void radii_that_cancel(void **state)
{
    static const enum kind kinds[] = {POINTS, BOX, ELLIPSOID, SEGMENT, ORIGIN};
    static const real places[] = {4, (real)0.25};
    (void)state;
    for (int k = 0; k < 5 * 5 * 2 * QUERIES; k++) {
        V(result) r;
        V(cache) cache;
        V(options) o = default_options();
        memset(&cache, 0, sizeof cache);
        o.cache = &cache;
        some_body(&a, kinds[k % 5]);
        some_body(&b, kinds[k / 5 % 5]);
        b.pose.p[0] = places[k / 25 % 2];
        bind(&a);
        bind(&b);
        assert_true(queries[k / 50](&a.shape, &b.shape, &o, &r) >= 0);
        const V(cache) kept = cache;
        for (int below = 0; below < 2; below++) {
            a.shape.radius = below ? 1 : -1;
            b.shape.radius = below ? -1 : 1;
            expect(GJK_BAD_ARGUMENT);
            for (int q = 0; q < QUERIES; q++) {
                cache = kept;
                expect_query(queries[q], &a.shape, &b.shape, &o, GJK_BAD_ARGUMENT);
            }
        }
    }
}

static void sizes_of(enum kind kind, real *size, real good)
{
    start_body(&a, kind);
    a.radius = a.half_length = 1;
    for (int i = 0; i < DIM; i++) {
        a.half[i] = 1;
    }
    for (int k = 0; k < BAD_NUMBERS; k++) {
        *size = bad_number(k);
        bind(&a);
        expect(GJK_BAD_SUPPORT);
    }
    *size = -good;
    bind(&a);
    expect(GJK_BAD_SUPPORT);
    *size = good;
    bind(&a);
    expect_truth(1);
}

static void sizes(void **state)
{
    (void)state;
    for (int i = 0; i < DIM; i++) {
        sizes_of(BOX, &a.half[i], 1);
        sizes_of(ELLIPSOID, &a.half[i], 1);
    }
    sizes_of(BALL, &a.radius, 1);
#if DIM == 3
    sizes_of(CYLINDER, &a.radius, 1);
    sizes_of(CYLINDER, &a.half_length, 1);
    sizes_of(CONE, &a.half_length, 1);
    sizes_of(DISC, &a.radius, 1);
    for (int k = 0; k < BAD_NUMBERS; k++) {
        start_body(&a, CONE);
        a.half_length = 1;
        a.radius = bad_number(k);
        bind(&a);
        expect(GJK_BAD_SUPPORT);
    }
#endif
}

static void sizes_of_0(void **state)
{
    static const enum kind kinds[] = {BOX, BALL, ELLIPSOID, CYLINDER, CONE, DISC, SEGMENT, TRIANGLE};
    (void)state;
    for (int k = 0; k < 8; k++) {
        if (DIM == 2 && (kinds[k] == CYLINDER || kinds[k] == CONE || kinds[k] == DISC || kinds[k] == TRIANGLE)) {
            continue;
        }
        start_body(&a, kinds[k]);
        bind(&a);
        expect_truth(2);
    }
}

static void points_not_finite(void **state)
{
    static const enum kind kinds[] = {POINTS, SEGMENT, TRIANGLE};
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        for (int k = 0; k < BAD_NUMBERS; k++) {
            for (int at = 0; at < 3; at++) {
                for (int i = 0; i < DIM; i++) {
                    if ((kinds[kind] == TRIANGLE && DIM == 2) || (kinds[kind] == SEGMENT && at == 2)) {
                        continue;
                    }
                    start_body(&a, kinds[kind]);
                    a.count = 3;
                    a.v[1][1] = a.v[2][0] = 1;
                    a.v[at][i] = bad_number(k);
                    bind(&a);
                    assert_true(kind > 0 || isnan(a.set.points.reach));
                    expect(GJK_BAD_SUPPORT);
                    a.set.points.reach = 0; /* for the clouds: not known */
                    if (kinds[kind] == POINTS) {
                        expect(GJK_BAD_SUPPORT);
                    }
                }
            }
        }
    }
}

static void cloud(int count)
{
    start_body(&a, POINTS);
    a.count = count;
    for (int k = 0; k < count; k++) {
        a.v[k][0] = (real)(k & 1);
        a.v[k][1] = (real)(k & 2);
    }
    bind(&a);
}

/* Nor where a cache lends a front that they have nothing to do with. */
static void points_behind_a_cache(void **state)
{
    V(result) r;
    V(cache) cache;
    V(options) o = default_options();
    (void)state;
    o.cache = &cache;
    for (int k = 0; k < BAD_NUMBERS; k++) {
        for (int q = 0; q < QUERIES; q++) {
            memset(&cache, 0, sizeof cache);
            cloud(4);
            assert_true(queries[q](&a.shape, &b.shape, &o, &r) >= 0);
            a.v[0][1] = bad_number(k);
            expect_query(queries[q], &a.shape, &b.shape, &o, GJK_BAD_SUPPORT);
        }
    }
}

static void point_sets(void **state)
{
    (void)state;
    cloud(0);
    assert_true(isnan(a.set.points.reach));
    expect(GJK_BAD_SUPPORT);
    a.set.points.reach = 0;
    expect(GJK_BAD_SUPPORT);

    cloud(4);
    expect_truth(1);
    a.set.points.v = NULL;
    expect(GJK_BAD_SUPPORT);
    assert_true(isnan(V(points_reach)(&a.set.points)));
    assert_true(isnan(V(points_reach)(NULL)));

    cloud(4);
    for (uint32_t stride = 1; stride < DIM * sizeof(real); stride++) {
        a.set.points.stride = stride;
        expect(GJK_BAD_SUPPORT);
        assert_true(isnan(V(points_reach)(&a.set.points)));
    }
    a.set.points.stride = DIM * sizeof(real) + 1;
    expect(GJK_BAD_SUPPORT);
    a.set.points.stride = DIM * sizeof(real);
    expect_truth(1);
    a.set.points.stride = 2 * DIM * sizeof(real); /* every second point: those with x = 0 */
    a.set.points.count = 2;
    expect_truth(2);

    for (int k = 0; k < BAD_NUMBERS; k++) {
        cloud(4);
        a.set.points.reach = bad_number(k);
        expect(GJK_BAD_SUPPORT);
    }
    a.set.points.reach = -1;
    expect(GJK_BAD_SUPPORT);
    a.set.points.reach = 0;
    expect_truth(1);
    a.set.points.reach = 100;
    expect_truth(1);
    a.set.points.reach = (real)0.5; /* less than its points */
    expect(GJK_BAD_SUPPORT);
}

#define ROOM_FOR_INDEX 1024

static void no_index(V(indexed_points) * c)
{
    static uint32_t room[ROOM_FOR_INDEX];
    assert_int_equal(V(index_points)(c, NULL, 0), 0);
    assert_int_equal(V(index_points)(c, room, sizeof room), 0);
    if (c) {
        assert_int_equal(c->points.indexed, 0);
    }
}

/* An index is made of sound points alone, in memory that it fits; one of another number of points is not looked at. */
static void indexes(void **state)
{
    static uint32_t room[ROOM_FOR_INDEX], guard = 0x5a5a5a5a;
    real v[40][DIM], out[2][DIM];
    const V(points) points = {v[0], 40, 0, 0, 2};
    V(indexed_points) c = {points, NULL};
    (void)state;
    for (int k = 0; k < 40; k++) {
        for (int i = 0; i < DIM; i++) {
            v[k][i] = (real)(((k + 1) * (i + 3) * 7) % 11) / 8 - (real)0.5;
        }
    }
    for (int i = 0; i < DIM; i++) {
        v[39][i] = (real)0.875; /* the farthest along dir */
    }
    no_index(NULL);
    for (int k = 0; k < BAD_NUMBERS; k++) {
        const real was = v[k % 40][k % DIM];
        v[k % 40][k % DIM] = bad_number(k);
        no_index(&c);
        v[k % 40][k % DIM] = was;
        c.points.reach = bad_number(k);
        no_index(&c);
        c.points = points;
    }
    c.points.reach = 0;
    no_index(&c);
    c.points.reach = (real)0.25;
    no_index(&c);
    c.points = points;
    c.points.count = 0;
    no_index(&c);
    c.points.count = (size_t)1 << 31;
    no_index(&c);
    c.points = points;
    c.points.v = NULL;
    no_index(&c);
    c.points = points;
    assert_int_equal(V(index_points)(&c, (char *)room + 1, sizeof room - 1), 0);

    const size_t bytes = V(index_points)(&c, NULL, 0);
    assert_true(bytes > 0 && bytes < sizeof room);
    for (size_t less = 0; less < bytes; less += sizeof *room) {
        room[less / sizeof *room] = guard;
        assert_int_equal(V(index_points)(&c, room, less), bytes);
        assert_true(c.points.indexed == 0 && room[less / sizeof *room] == guard);
    }
    assert_int_equal(V(index_points)(&c, room, bytes), bytes);
    assert_true(c.points.indexed == 1 && c.index == room);

    const real dir[DIM] = {(real)0.5, 1}, was = v[7][0];
    v[7][0] = 4; /* beyond the reach: that is refused, and the old index is none of these points */
    assert_int_equal(V(index_points)(&c, room, bytes), 0);
    assert_int_equal(c.points.indexed, 0);
    v[7][0] = was;
    assert_int_equal(V(index_points)(&c, room, bytes), bytes);
    for (size_t count = 40; count > 30; count--) {
        c.points.count = count;
        V(points) scanned = points;
        scanned.count = count;
        assert_true(V(support_points)(&c, dir, out[0]) == V(support_points)(&scanned, dir, out[1]));
        assert_memory_equal(out[0], out[1], sizeof out[0]);
    }
    c.points.count = 40;
    v[7][0] = 4;
    c.points.reach = 8; /* nor is it of points of another reach */
    const real along[DIM] = {1};
    assert_true(V(support_points)(&c, along, out[0]) == 8);
    assert_memory_equal(out[0], v[7], sizeof out[0]);
    v[7][0] = was;
    c.points = points;
    c.points.indexed = 1;
    c.index = NULL; /* that is none */
    assert_true(V(support_points)(&c, dir, out[0]) == V(support_points)(&points, dir, out[1]));
    assert_memory_equal(out[0], out[1], sizeof out[0]);
}

/* A singular map is legal: the set is flat, on a line, or one point. */
static void singular_poses(void **state)
{
    (void)state;
    memset(a.pose.m, 0, sizeof a.pose.m);
    expect_truth(2);
    memset(b.pose.m, 0, sizeof b.pose.m);
    expect_truth(3);
    b.pose.p[0] = 0;
    expect_truth(0);
    for (int flat = 0; flat < DIM; flat++) {
        fresh(NULL);
        a.pose.m[flat * DIM + flat] = 0;
        expect_truth(flat == 0 ? 2 : 1);
        b.pose.m[flat * DIM + flat] = 0;
        expect_truth(flat == 0 ? 3 : 1);
        b.pose.p[0] = flat == 0 ? 0 : 1;
        expect_truth(flat == 0 ? 0 : 0);
    }
}

/* ---- callbacks ---- */

static struct {
    real point[DIM], reach;
    int calls;
} fake;

static real fake_support(const void *data, const real *dir, real *point)
{
    (void)data;
    (void)dir;
    fake.calls++;
    memcpy(point, fake.point, sizeof fake.point);
    return fake.reach;
}

static void use_fake(real x, real reach)
{
    fresh(NULL);
    memset(&fake, 0, sizeof fake);
    fake.point[0] = x;
    fake.reach = reach;
    a.shape.support = fake_support;
}

static void callbacks_not_finite(void **state)
{
    (void)state;
    for (int k = 0; k < BAD_NUMBERS; k++) {
        for (int i = 0; i < DIM; i++) {
            for (int known = 0; known < 2; known++) {
                use_fake(0, (real)(2 * known));
                fake.point[i] = bad_number(k);
                expect(GJK_BAD_SUPPORT);
            }
        }
        use_fake(0, bad_number(k));
        expect(GJK_BAD_SUPPORT);
    }
}

static real silent_support(const void *data, const real *dir, real *point)
{
    (void)data;
    (void)dir;
    (void)point;
    return fake.reach;
}

/* Some points, each of them beyond the reach that is told, beside a smooth body. In float the sister sees them first.
 */
static void points_beyond_their_reach(void **state)
{
    static const size_t counts[] = {1, 2, 3, 40, 70};
    static real v[70][DIM];
    V(points) points = {.v = v[0]};
    V(ellipsoid) round = {.radii = {1, (real)0.5}};
    V(result) r;
    (void)state;
    for (int i = 0; i < 70; i++) {
        v[i][i % DIM] = i / DIM % 2 ? 1 : -1;
    }
    round.radii[DIM - 1] = (real)0.75;
    fresh(NULL);
    a.shape.support = V(support_points);
    a.shape.data = &points;
    b.shape.support = V(support_ellipsoid);
    b.shape.data = &round;
    b.shape.pose = &b.pose;
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        for (int far = 0; far < 2; far++) {
            points.count = counts[k];
            b.pose.p[0] = far ? 3 : (real)0.5;
            points.reach = (real)0.5;
            expect_query(V(distance), &a.shape, &b.shape, NULL, GJK_BAD_SUPPORT);
            expect_query(V(penetration), &b.shape, &a.shape, NULL, GJK_BAD_SUPPORT);
            points.reach = V(points_reach)(&points);
            assert_int_equal(V(distance)(&a.shape, &b.shape, NULL, &r), GJK_OK);
            assert_true(!VARIANT_FLOAT || r.upper - r.lower <= 16 * (real)U); /* by her, sooner or later */
            assert_true(V(penetration)(&a.shape, &b.shape, NULL, &r) >= 0);
        }
    }
    points.count = 3;
    a.shape.radius = REAL_MAX / 8;
    expect(GJK_BAD_ARGUMENT);
}

#if DIM == 3
/* Cubes deep in each other, of one of which a corner lies far out aside, beyond its reach: it is seen by whoever looks
 * that way, also where that is the second look and both its ways are looked along at once. */
static void corner_beyond_the_reach_aside(void **state)
{
    int refused = 0;
    (void)state;
    for (int k = 0; k < 32; k++) {
        const int corner = k % 8, axis = 1 + k / 8 % 2;
        body *const lies = k / 16 ? &b : &a;
        V(result) r;
        for (int side = 0; side < 2; side++) {
            body *s = side ? &b : &a;
            start_body(s, POINTS);
            s->count = 8;
            for (int i = 0; i < 8; i++) {
                for (int j = 0; j < 3; j++) {
                    s->v[i][j] = (real)(i >> j & 1 ? 1 : -1);
                }
            }
        }
        b.pose.p[0] = (real)0.5;
        b.pose.p[1] = (real)0.125;
        b.pose.p[2] = (real)0.0625;
        lies->v[corner][axis] *= 8;
        bind(&a);
        bind(&b);
        lies->set.points.reach = (real)1.75;
        memset(&r, 0, sizeof r);
        refused += V(intersect)(&a.shape, &b.shape, NULL, &r) == GJK_BAD_SUPPORT;
    }
    assert_true(refused >=
                10); /* nobody looks toward the others; 8 where the second look takes what it sees on trust */
}
#endif

/* Nor is a formula of one or two that lie beyond it an answer. */
static void ends_beyond_their_reach(void **state)
{
    static real v[2][DIM];
    V(points) points = {.v = v[0]};
    V(box) box = {.half = {1, 1}};
    V(segment) segment = {.v = {{-1}, {1}}};
    V(result) r;
    (void)state;
    box.half[DIM - 1] = 1;
    v[1][DIM - 1] = 1;
    for (int k = 0; k < 8; k++) {
        fresh(NULL);
        points.count = (size_t)(1 + k % 2);
        v[0][0] = points.count == 1 ? 1 : (real)0.25;
        a.shape.support = V(support_points);
        a.shape.data = &points;
        b.shape.support = points.count == 1 && k & 4 ? V(support_box) : V(support_segment);
        b.shape.data = points.count == 1 && k & 4 ? (const void *)&box : &segment;
        b.pose.p[DIM - 1] = k & 2 ? 3 : (real)0.5;
        b.shape.pose = &b.pose;
        a.shape.radius = b.shape.radius = (real)0.125;
        points.reach = (real)0.5;
        expect_query(V(distance), &a.shape, &b.shape, NULL, GJK_BAD_SUPPORT);
        expect_query(V(penetration), &b.shape, &a.shape, NULL, GJK_BAD_SUPPORT);
        points.reach = V(points_reach)(&points);
        assert_int_equal(V(distance)(&a.shape, &b.shape, NULL, &r), GJK_OK);
        points.reach = 0;
        assert_int_equal(V(penetration)(&b.shape, &a.shape, NULL, &r), GJK_OK);
    }
}

/* What a support leaves in its point must be its own: whatever lay there before is no answer. */
static void callback_writes_nothing(void **state)
{
    (void)state;
    for (int known = 0; known < 2; known++) {
        use_fake(0, (real)(2 * known));
        a.shape.support = silent_support;
        expect(GJK_BAD_SUPPORT);
    }
}

static void callback_reaches(void **state)
{
    V(result) known, unknown;
    (void)state;
    use_fake(1, -1);
    expect(GJK_BAD_SUPPORT);
    use_fake(1, (real)0.5);
    expect(GJK_BAD_SUPPORT);
    use_fake(1, 1);
    expect_truth(1);
    assert_true(V(distance)(&a.shape, &b.shape, NULL, &known) >= 0);
    assert_int_equal(known.supports, 2 * known.steps);
    use_fake(1, 0);
    expect_truth(1);
    assert_true(V(distance)(&a.shape, &b.shape, NULL, &unknown) >= 0);
    assert_int_equal(unknown.supports, known.supports + 2 * DIM);
}

/* Every support call is counted, and no query calls without end. */
static void calls_are_counted(void **state)
{
    V(result) r;
    (void)state;
    use_fake(1, 1);
    b = a;
    b.pose.p[0] = 3;
    b.shape.pose = &b.pose;
    for (int overlap = 0; overlap < 2; overlap++) {
        for (int q = 0; q < QUERIES; q++) {
            fake.calls = 0;
            assert_true(queries[q](&a.shape, &b.shape, NULL, &r) >= 0);
            assert_int_equal(r.supports, fake.calls);
        }
        b.pose.p[0] = 0;
    }
}

/* First a point near, then only points farther away: no convex set answers so. */
static real backing_support(const void *data, const real *dir, real *point)
{
    (void)data;
    (void)dir;
    memset(point, 0, DIM * sizeof *point);
    point[0] = fake.calls++ ? -2 : 1;
    return 4;
}

static void points_that_contradict(void **state)
{
    V(result) r;
    (void)state;
    for (int q = 0; q < QUERIES; q++) {
        fresh(NULL);
        memset(&r, 0x5a, sizeof r);
        a.shape.support = backing_support;
        b.shape.support = V(support_origin);
        fake.calls = 0;
        int status = queries[q](&a.shape, &b.shape, NULL, &r);
        /* 1 is proven reached, then nothing beyond -2 is: distance must notice, intersect may have had its proof. */
        assert_true(status == GJK_BAD_SUPPORT || (q == 1 && status == GJK_DECIDED));
    }
}

/* Noise of its own at each call, and no convex set behind it: any outcome but a hang, a crash or a half-written result.
 */
static real noisy_support(const void *data, const real *dir, real *point)
{
    uint64_t *state = (uint64_t *)(uintptr_t)data;
    (void)dir;
    for (int i = 0; i < DIM; i++) {
        *state = *state * 6364136223846793005u + 1442695040888963407u;
        point[i] = (real)((double)(*state >> 40) / 16777216.0 - 0.5);
    }
    return *state % 3 ? 1 : 0;
}

static void noise(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 2000; seed++) {
        uint64_t s = seed;
        V(result) r, before;
        V(options) o = default_options();
        V(cache) cache;
        int status;
        memset(&cache, 0, sizeof cache);
        o.cache = &cache;
        fresh(NULL);
        a.shape.support = noisy_support;
        a.shape.data = &s;
        b.pose.p[0] = (real)((double)(seed % 7) / 2);
        for (int k = 0; k < 2 * QUERIES; k++) {
            memset(&before, 0x5a, sizeof before);
            r = before;
            status = queries[k % QUERIES](&a.shape, &b.shape, &o, &r);
            assert_true(status >= 0 || status == GJK_BAD_SUPPORT);
            if (status < 0) {
                assert_memory_equal(&r, &before, sizeof r);
            } else {
                assert_true(r.lower <= r.value && r.value <= r.upper);
                assert_int_equal(r.status, status);
            }
        }
    }
}

static void bad_couples(void **state)
{
    static body part[2];
    (void)state;
    for (int kind = SUM; kind <= HULL; kind++) {
        for (int bad = 0; bad < 6; bad++) {
            for (int at = 0; at < 2; at++) {
                fresh(NULL);
                part[0] = a;
                part[1] = a;
                bind(&part[0]);
                bind(&part[1]);
                start_body(&a, (enum kind)kind);
                a.part[0] = &part[0];
                a.part[1] = &part[1];
                if (bad == 0) {
                    part[at].shape.support = NULL;
                } else if (bad == 1) {
                    part[at].shape.data = NULL;
                } else if (bad == 2) {
                    part[at].shape.radius = -1;
                } else if (bad == 3) {
                    part[at].shape.radius = (real)NAN;
                } else if (bad == 4) {
                    fake.reach = 1;
                    part[at].shape.support = silent_support;
                } else {
                    part[at].pose.p[1] = (real)INFINITY;
                }
                bind(&a);
                expect(GJK_BAD_SUPPORT);
            }
        }
    }
}

/* ---- ties ---- */

static void expect_point(const body *k, real x, real y)
{
    const real up[DIM] = {0, 1};
    real point[DIM];
    memset(point, 0x5a, sizeof point);
    assert_true(k->shape.support(k->shape.data, up, point) > 0);
    assert_true(point[0] == x && point[1] == y);
}

/* Of points equally far the first is handed out, of a box the one on the positive side, of 0 and of -0. */
static void ties(void **state)
{
    static const enum kind kinds[] = {POINTS, SEGMENT, TRIANGLE};
    static body part[2];
    const real down_left[DIM] = {-(real)0.0, -1};
    real point[DIM];
    (void)state;
    for (int k = 0; k < (DIM == 3 ? 3 : 2); k++) {
        for (int turn = -1; turn <= 1; turn += 2) {
            start_body(&a, kinds[k]);
            a.count = kinds[k] == SEGMENT ? 2 : 3;
            a.v[0][1] = a.v[1][1] = 1;
            a.v[0][0] = (real)turn;
            a.v[1][0] = (real)-turn;
            bind(&a);
            expect_point(&a, (real)turn, 1);
            if (kinds[k] == POINTS) {
                part[(1 - turn) / 2] = a;
            }
        }
    }
    bind(&part[0]);
    bind(&part[1]);
    start_body(&a, HULL);
    a.part[0] = &part[1];
    a.part[1] = &part[0];
    bind(&a);
    expect_point(&a, -1, 1);
    fresh(NULL);
    expect_point(&a, 1, 1);
    a.shape.support(a.shape.data, down_left, point);
    assert_true(point[0] == 1 && point[1] == -1);
}

/* ---- options ---- */

/* The struct ended before the cache once, then after it, and then after the pointer behind that; after tight alone it
 * would, were that as wide as a pointer, which is harmless. */
static int is_older(uint32_t size)
{
    return size == offsetof(V(options), cache) || size == offsetof(V(options), workspace) ||
           size == offsetof(V(options), tight) ||
           (size == offsetof(V(options), workspace_bytes) && sizeof(void *) == sizeof(uint32_t));
}

static void option_sizes(void **state)
{
    union {
        V(options) o;
        unsigned char bytes[1024];
        uint32_t size;
    } u;
    const uint32_t whole = (uint32_t)sizeof(V(options));
    (void)state;
    for (uint32_t size = 0; size <= 1024; size++) {
        int older = is_older(size);
        memset(&u, 0, sizeof u);
        u.size = size;
        if (size > whole ? 1 : older || size == whole) {
            expect_truth_with(&u.o, 1);
        } else {
            expect_with(&u.o, GJK_BAD_ARGUMENT);
        }
        if (size > whole) {
            u.bytes[size - 1] = 1;
            expect_with(&u.o, GJK_BAD_ARGUMENT);
            u.bytes[size - 1] = 0;
            u.bytes[whole] = 1;
            expect_with(&u.o, GJK_BAD_ARGUMENT);
        }
    }
    memset(&u, 0, sizeof u);
    u.size = UINT32_MAX;
    expect_with(&u.o, GJK_BAD_ARGUMENT);
    u.size = 0x10000;
    expect_with(&u.o, GJK_BAD_ARGUMENT);
}

/* What an older caller's struct does not hold is not read. */
static void older_options(void **state)
{
    V(options) o;
    int ages = 0;
    (void)state;
    memset(&o, 0xff, sizeof o);
    o.max_steps = 0;
    o.abs_tol = o.rel_tol = o.cutoff = o.slack = 0;
    for (uint32_t size = 0; size < sizeof o; size++) {
        if (!is_older(size)) {
            continue;
        }
        if (size > offsetof(V(options), cache)) {
            o.cache = NULL;
        }
        if (size > offsetof(V(options), workspace)) {
            o.workspace = NULL;
        }
        if (size > offsetof(V(options), tight)) {
            o.tight = 1;
        }
        o.size = size;
        expect_truth_with(&o, 1);
        if (size > offsetof(V(options), workspace)) { /* one of no bytes */
            o.workspace = &o;
            expect_query(V(penetration), &a.shape, &b.shape, &o, GJK_BAD_ARGUMENT);
            o.workspace = NULL;
        }
        ages++;
    }
    assert_in_range(ages, 3, 4);
    o.size = (uint32_t)sizeof o; /* and now all of it is read */
    o.tight = 1;
    expect_query(V(penetration), &a.shape, &b.shape, &o, GJK_BAD_ARGUMENT);
    o.workspace_bytes = 0;
    expect_truth_with(&o, 1);
    o.tight = UINT32_MAX;
    expect_with(&o, GJK_BAD_ARGUMENT);
}

/* A workspace is penetration's: it takes one that is aligned and large enough, or none. The others look at neither
 * field. */
static void expect_workspace(const void *workspace, size_t bytes, int good)
{
    V(options) o = default_options();
    o.workspace = (void *)(uintptr_t)workspace;
    o.workspace_bytes = (uint32_t)bytes;
    for (double at = 3; at >= 1; at -= 1) { /* apart, touching, overlapping: it makes no difference */
        b.pose.p[0] = (real)at;
        for (int q = 0; q < QUERIES; q++) {
            V(result) r;
            if (good || queries[q] != V(penetration)) {
                assert_true(queries[q](&a.shape, &b.shape, &o, &r) >= 0);
                assert_true((double)r.lower <= fmax(at - 2, q ? -1 : 0) && at - 2 <= (double)r.upper);
            } else {
                expect_query(queries[q], &a.shape, &b.shape, &o, GJK_BAD_ARGUMENT);
            }
        }
    }
}

static void workspaces(void **state)
{
    static union {
        real numbers[4096];
        unsigned char bytes[4096 * sizeof(real)];
    } room;
    const size_t least = V(workspace_size)(8), most = sizeof room;
    (void)state;
    assert_in_range(least, 1, most);
    expect_workspace(NULL, 0, 1);
    expect_workspace(room.bytes, least, 1);
    expect_workspace(room.bytes, most, 1);
    expect_workspace(NULL, least, 0);
    expect_workspace(NULL, 1, 0);
    expect_workspace(NULL, UINT32_MAX, 0);
    for (size_t bytes = 0; bytes < least; bytes++) {
        expect_workspace(room.bytes, bytes, 0);
    }
    for (size_t off = 1; off < sizeof(real); off++) {
        expect_workspace(room.bytes + off, least, 0);
        expect_workspace(room.bytes + off, most - off, 0);
    }
    expect_workspace(room.bytes + sizeof(real), least, 1);
}

/* Of the numbers of corners that there may be; of more corners, more bytes, and whole numbers of reals. */
static void workspace_sizes(void **state)
{
    static const uint32_t none[] = {0, 1, 7, 16001, 32768, 65536 + 8, 0x80000000u, 0x80000008u, UINT32_MAX};
    size_t before = 0;
    (void)state;
    for (size_t k = 0; k < sizeof none / sizeof *none; k++) {
        assert_int_equal(V(workspace_size)(none[k]), 0);
    }
    for (uint32_t corners = 8; corners <= 16000; corners++) {
        size_t bytes = V(workspace_size)(corners);
        assert_true(bytes > before);
        assert_true(bytes <= UINT32_MAX); /* or the options could not say so */
        before = bytes;
    }
}

static void tight(void **state)
{
    static const enum kind kinds[] = {POINTS, BOX, SEGMENT, TRIANGLE, BALL, CYLINDER, CONE, DISC, ORIGIN, ELLIPSOID};
    static const uint32_t others[] = {2, 3, 255, 256, 0x80000000u, 0x80000001u, UINT32_MAX};
    V(options) o = default_options();
    (void)state;
    for (int k = 0; k < (int)(sizeof kinds / sizeof *kinds); k++) {
        if (DIM == 2 && kinds[k] >= TRIANGLE && kinds[k] <= DISC) {
            continue;
        }
        start_body(&a, kinds[k]);
        a.count = 1; /* all of one point */
        bind(&a);
        for (o.tight = 0; o.tight <= 1; o.tight++) {
            expect_truth_with(&o, 2);
        }
    }
    fresh(NULL);
    for (int k = 0; k < (int)(sizeof others / sizeof *others); k++) {
        o.tight = others[k];
        expect_with(&o, GJK_BAD_ARGUMENT);
    }
    for (o.tight = 0; o.tight <= 1; o.tight++) {
        expect_truth_with(&o, 1);
    }
}

/* With tight as without: what is refused stays refused, and the other options keep their meaning. */
static void tight_refuses_the_same(void **state)
{
    V(options) o = default_options();
    V(cache) cache;
    (void)state;
    o.tight = 1;
    a.half[0] = (real)NAN;
    bind(&a);
    expect_with(&o, GJK_BAD_SUPPORT);
    cloud(4);
    a.v[1][1] = (real)INFINITY;
    expect_with(&o, GJK_BAD_SUPPORT);
    cloud(4);
    a.set.points.reach = (real)0.5; /* less than its points */
    expect_with(&o, GJK_BAD_SUPPORT);
    fresh(NULL);
    a.pose.m[0] = (real)NAN;
    expect_with(&o, GJK_BAD_ARGUMENT);
    fresh(NULL);
    a.shape.radius = (real)0.5;
    expect_truth_with(&o, 0.5);
    memset(&cache, 0, sizeof cache);
    o.cache = &cache;
    o.max_steps = 1;
    expect_truth_with(&o, 0.5);
    o.max_steps = 0;
    o.cutoff = (real)0.25;
    o.slack = (real)0.125;
    expect_truth_with(&o, 0.5);
}

static void option_numbers(void **state)
{
    V(options) o = default_options();
    real *const fields[] = {&o.abs_tol, &o.rel_tol, &o.cutoff, &o.slack};
    (void)state;
    for (int f = 0; f < 4; f++) {
        *fields[f] = (real)NAN;
        expect_with(&o, GJK_BAD_ARGUMENT);
        *fields[f] = -1;
        expect_with(&o, GJK_BAD_ARGUMENT);
        *fields[f] = -(real)INFINITY;
        expect_with(&o, GJK_BAD_ARGUMENT);
        *fields[f] = -(real)0.0;
        expect_truth_with(&o, 1);
        *fields[f] = 1;
        expect_truth_with(&o, 1);
        *fields[f] = REAL_MAX;
        if (f < 3) {
            expect_truth_with(&o, 1);
        }
        *fields[f] = 0;
    }
    o.slack = (real)INFINITY;
    expect_with(&o, GJK_BAD_ARGUMENT);
    o.slack = 0;
    o.max_steps = UINT32_MAX;
    expect_truth_with(&o, 1);
    o.max_steps = 1;
    expect_truth_with(&o, 1);
}

/* ---- magnitudes ---- */

/* Boxes with the given half size, that much times 3 from centre to centre; what is representable must be right. */
static void boxes_of(double size, double gap_in_sizes)
{
    fresh(NULL);
    for (int i = 0; i < DIM; i++) {
        a.half[i] = b.half[i] = (real)size;
    }
    b.pose.p[0] = (real)((2 + gap_in_sizes) * size);
    bind(&a);
    bind(&b);
    expect_truth((double)b.pose.p[0] - 2 * (double)(real)size);
}

static void magnitudes(void **state)
{
    const double tiny = (double)REAL_MIN * (double)REAL_EPSILON;
    (void)state;
    for (double size = tiny; size <= (double)REAL_MAX / 64; size *= 2) {
        boxes_of(size, 1);
        boxes_of(size, 0);
        boxes_of(size, -1);
    }
    /* Beyond the format: refused, or right. */
    for (double size = (double)REAL_MAX / 64; size <= (double)REAL_MAX; size *= 2) {
        V(result) r, before;
        fresh(NULL);
        for (int i = 0; i < DIM; i++) {
            a.half[i] = b.half[i] = (real)size;
        }
        bind(&a);
        bind(&b);
        memset(&before, 0x5a, sizeof before);
        for (int q = 0; q < QUERIES; q++) {
            r = before;
            int status = queries[q](&a.shape, &b.shape, NULL, &r);
            assert_true(status < 0 || r.lower <= 0);
            assert_true(status >= 0 || memcmp(&r, &before, sizeof r) == 0);
        }
    }
}

static void sizes_worlds_apart(void **state)
{
    (void)state;
    for (int k = 0; k < DIM; k++) {
        fresh(NULL);
        a.half[k] = (real)((double)REAL_MAX / 1024);
        b.half[k] = REAL_MIN * REAL_EPSILON * 3;
        bind(&a);
        bind(&b);
        expect_truth(k == 0 ? -2 : 1); /* out by another axis */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(null_pointers, fresh),
        cmocka_unit_test_setup(ready_made_without_data, fresh),
        cmocka_unit_test_setup(poses_not_finite, fresh),
        cmocka_unit_test_setup(radii, fresh),
        cmocka_unit_test_setup(radii_that_cancel, fresh),
        cmocka_unit_test_setup(sizes, fresh),
        cmocka_unit_test_setup(sizes_of_0, fresh),
        cmocka_unit_test_setup(points_not_finite, fresh),
        cmocka_unit_test_setup(points_behind_a_cache, fresh),
        cmocka_unit_test_setup(point_sets, fresh),
        cmocka_unit_test_setup(indexes, fresh),
        cmocka_unit_test_setup(singular_poses, fresh),
        cmocka_unit_test_setup(callbacks_not_finite, fresh),
        cmocka_unit_test_setup(points_beyond_their_reach, fresh),
#if DIM == 3
        cmocka_unit_test_setup(corner_beyond_the_reach_aside, fresh),
#endif
        cmocka_unit_test_setup(ends_beyond_their_reach, fresh),
        cmocka_unit_test_setup(callback_writes_nothing, fresh),
        cmocka_unit_test_setup(callback_reaches, fresh),
        cmocka_unit_test_setup(calls_are_counted, fresh),
        cmocka_unit_test_setup(points_that_contradict, fresh),
        cmocka_unit_test_setup(noise, fresh),
        cmocka_unit_test_setup(bad_couples, fresh),
        cmocka_unit_test_setup(ties, fresh),
        cmocka_unit_test_setup(option_sizes, fresh),
        cmocka_unit_test_setup(older_options, fresh),
        cmocka_unit_test_setup(option_numbers, fresh),
        cmocka_unit_test_setup(workspaces, fresh),
        cmocka_unit_test_setup(workspace_sizes, fresh),
        cmocka_unit_test_setup(tight, fresh),
        cmocka_unit_test_setup(tight_refuses_the_same, fresh),
        cmocka_unit_test_setup(magnitudes, fresh),
        cmocka_unit_test_setup(sizes_worlds_apart, fresh),
    };
    return cmocka_run_group_tests_name("bad input to " VARIANT, tests, NULL, NULL);
}
