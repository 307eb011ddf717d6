/* SPDX-License-Identifier: MIT */
/* Legal input of extreme magnitude: the bracket holds the truth there too, and a refusal is for what cannot be
 * answered. Each test is of one thing that once went wrong. */
#include "draw.h"
#include "truth.h"

#define DRAWS 3000
#define TINY ((double)REAL_MIN * (double)REAL_EPSILON)

static body a, b, part[4];

static int fresh(void **state)
{
    (void)state;
    start_points(&a, &b);
    for (int i = 0; i < 4; i++) {
        start_body(&part[i], ORIGIN);
        bind(&part[i]);
    }
    return 0;
}

/* ---- what is expected ---- */

typedef int query_fn(const V(shape) *, const V(shape) *, const V(options) *, V(result) *);
static query_fn *const queries[2] = {V(distance), V(intersect)};

enum refusal { NEVER, MAYBE, ALWAYS };

/* The truth lies between lower and upper, which are as good as one. */
static void expect_query(int query, int swap, const V(options) * o, quad lower, quad upper, enum refusal refusal)
{
    V(result) r, before;
    memset(&before, 0x5a, sizeof before);
    r = before;
    int status = queries[query](swap ? &b.shape : &a.shape, swap ? &a.shape : &b.shape, o, &r);
    if (status < 0) {
        assert_int_equal(status, GJK_BAD_SUPPORT);
        assert_int_not_equal(refusal, NEVER);
        assert_memory_equal(&r, &before, sizeof r);
        return;
    }
    assert_int_not_equal(refusal, ALWAYS);
    if (query == 0) {
        lower = positive(lower);
        upper = positive(upper);
    }
    assert_true((quad)r.lower <= upper && lower <= (quad)r.upper);
    assert_true(r.lower <= r.value && r.value <= r.upper);
}

static void expect(const V(options) * o, quad lower, quad upper, enum refusal refusal)
{
    V(options) with = o ? *o : default_options();
    for (with.tight = 0; with.tight < 2; with.tight++) {
        for (int query = 0; query < 2; query++) {
            expect_query(query, 0, &with, lower, upper, refusal);
            expect_query(query, 1, &with, lower, upper, refusal);
        }
    }
}

static void expect_exactly(quad answer, enum refusal refusal) { expect(NULL, answer, answer, refusal); }

static void expect_found(enum refusal refusal)
{
    static truth t;
    find_truth(&t, &a, &b, 1);
    expect(NULL, t.lower, t.upper, refusal);
}

/* One point, at that place but for rounding, and of plain sizes: the other body alone has to tell that care is needed.
 */
static void place_point(body *k, const double *at)
{
    k->kind = POINTS;
    k->count = 1;
    for (int i = 0; i < DIM; i++) {
        k->v[0][i] = (real)0.5;
        k->pose.p[i] = (real)(at[i] - 0.5);
    }
    bind(k);
}

/* ---- couples ---- */

static void couple(body *whole, enum kind kind, const body *x, const body *y)
{
    whole->kind = kind;
    whole->part[0] = x;
    whole->part[1] = y;
    bind(whole);
}

static void map_by(body *k, double size)
{
    for (int i = 0; i < DIM; i++) {
        k->pose.m[i * DIM + i] = (real)size;
    }
}

static void draw_points(body *k, draws *d, int count, double size)
{
    k->kind = POINTS;
    k->count = count;
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < DIM; j++) {
            k->v[i][j] = (real)(between(d, -1, 1) * size);
        }
    }
    bind(k);
}

/* The part is of plain size, but on the way to its reach stood a product beyond all numbers: it was refused. */
static void inner_map_overflows_reach(void **state)
{
    const double large = 0.5 * (double)REAL_MAX;
    (void)state;
    for (uint64_t k = 0; k < DRAWS; k++) {
        draws d = draws_from(1, 1, k);
        double turn[DIM * DIM], at[DIM];
        fresh(NULL);
        rotation(&d, HUGE_VAL, turn);
        draw_points(&part[0], &d, DIM + 1, 1 / large);
        for (int i = 0; i < DIM * DIM; i++) {
            part[0].pose.m[i] = (real)(turn[i] * large);
        }
        couple(&a, k % 2 ? SUM : HULL, &part[0], &part[1]);
        a.shape.pose = NULL; /* a pose would scale the direction */
        for (int i = 0; i < DIM; i++) {
            at[i] = between(&d, 2, 40);
        }
        place_point(&b, at);
        expect_found(NEVER);
    }
}

/* The point 0, of unknown reach: what it is part of is then of unknown reach too. */
static void draw_nothing(body *k)
{
    k->kind = POINTS;
    k->count = 1;
    bind(k);
    k->set.points.reach = 0;
}

/* The map of a couple's part turned the direction, itself of size up to 4, to infinity; what was then taken for the
 * farthest point was another, and the bracket false. To be refused is fair: the reach can't be bounded by a number. */
static void inner_map_overflows_direction(void **state)
{
    const double large = 0.95 * (double)REAL_MAX;
    (void)state;
    for (uint64_t k = 0; k < DRAWS; k++) {
        draws d = draws_from(1, 2, k);
        double at[DIM] = {0};
        fresh(NULL);
        draw_points(&part[0], &d, 2, 3);
        part[0].kind = SEGMENT;
        for (int i = 0; i < 2; i++) {
            part[0].v[i][0] = (real)((double)part[0].v[i][0] / large);
        }
        bind(&part[0]);
        part[0].pose.m[0] = (real)large;
        draw_nothing(&part[1]);
        couple(&a, SUM, &part[0], &part[1]);
        a.shape.pose = NULL; /* a pose would scale the direction */
        at[0] = between(&d, 20, 100);
        at[1] = between(&d, -30, 30);
        place_point(&b, at);
        expect_found(MAYBE);
    }
}

/* A point a hair above a face: the direction, short already, lost its digits in the small map of a couple's part. */
static void inner_map_underflows_direction(void **state)
{
    const double small = 4 * (double)REAL_MIN;
    (void)state;
    for (uint64_t k = 0; k < DRAWS; k++) {
        draws d = draws_from(1, 3, k);
        double way[DIM], at[DIM], weight[DIM], sum = 0, gap = magnitude(&d, VARIANT_FLOAT ? -10 : -19, -2);
        fresh(NULL);
        draw_points(&part[0], &d, DIM + 1, 1 / small);
        map_by(&part[0], small);
        couple(&a, SUM, &part[0], &part[1]);
        a.shape.pose = NULL; /* a pose would scale the direction */
        unit(&d, way);
        for (int i = 0; i < DIM; i++) {
            weight[i] = between(&d, 0, 1);
            sum += weight[i];
        }
        for (int j = 0; j < DIM; j++) {
            at[j] = gap * way[j];
            for (int i = 0; i < DIM; i++) {
                at[j] += weight[i] / sum * ((double)part[0].v[i][j] * small);
            }
        }
        place_point(&b, at);
        expect_found(NEVER);
    }
}

/* The inner couple's points are subnormal and rounded there, the outer's pose enlarges them: the inner couple answered
 * for less rounding than was in them. */
static void nested_couples(void **state)
{
    const double small = (double)REAL_MIN / 20000, large = VARIANT_FLOAT ? 1e30 : 1e300;
    (void)state;
    for (int known = 1; known >= 0; known--) {
        for (int k = 0; k < 40; k++) {
            fresh(NULL);
            for (int i = 0; i < 2; i++) {
                part[i].kind = POINTS;
                part[i].count = 1;
                part[i].v[0][0] = i == 0 ? (real)(1.0 / 3 + k / 31.0) : 0;
                bind(&part[i]);
                map_by(&part[i], small);
                part[i].set.points.reach = known ? part[i].set.points.reach : 0;
            }
            couple(&part[2], SUM, &part[0], &part[1]);
            map_by(&part[2], large * (1 + k / 7.0));
            couple(&a, SUM, &part[2], &part[1]);
            quad at = (quad)part[0].pose.m[0] * (quad)part[0].v[0][0] * (quad)part[2].pose.m[0];
            expect_exactly(at, known ? NEVER : MAYBE);
        }
    }
}

/* Parts that stand far from where the couple comes to lie, and of unknown reach: the couple's own reach was surveyed
 * from outside, where the roundings of its making are not seen. */
static void parts_of_unknown_reach(void **state)
{
    const double far_off = ldexp(1, VARIANT_FLOAT ? 13 : 20);
    (void)state;
    for (int n = 0; n < DRAWS; n++) {
        draws d = draws_from(23, 0, (uint64_t)n);
        int sum = (int)below(&d, 2);
        fresh(NULL);
        for (int k = 0; k < 2; k++) {
            draw_points(&part[k], &d, 1 + (int)below(&d, 3), 1);
            part[k].set.points.reach = below(&d, 4) ? 0 : part[k].set.points.reach;
            part[k].pose.p[0] = (real)(sum && k ? -far_off : far_off);
            for (int i = 0; i < part[k].count && !sum; i++) {
                part[k].v[i][0] -= (real)far_off;
            }
        }
        couple(&a, sum ? SUM : HULL, &part[0], &part[1]);
        expect_found(NEVER);
    }
}

/* A segment, or a triangle, across the first axis there, around the axis. */
static void place_across(body *k, draws *d, double size, double at)
{
    k->kind = POINTS;
    k->count = DIM;
    for (int i = 0; i < DIM; i++) {
        k->v[i][0] = (real)at;
        for (int j = 1; j < DIM; j++) {
            double side = i == j ? 1 : i < j ? -1 : 0;
            k->v[i][j] = (real)(side * (1 + (double)below(d, 8)) * size);
        }
    }
    bind(k);
}

/* Two of them, so near that the coordinate between them vanishes in a frame of their size: it must not count as 0. */
static void hair_beside_a_large_face(void **state)
{
    const int most = VARIANT_FLOAT ? 120 : 1000;
    (void)state;
    for (int n = 0; n < DRAWS; n++) {
        draws d = draws_from(27, 0, (uint64_t)n);
        double size = ldexp(1, below(&d, 2 * most) - most), hair = (1 + (double)below(&d, 8)) * TINY;
        fresh(NULL);
        place_across(&a, &d, size, hair);
        place_across(&b, &d, size, 0);
        expect_exactly((quad)hair, NEVER);
    }
}

/* The corners 3 e_i, each a hair off in so many binary places that the squares of the distance, less those of a ball's
 * radius, are more than the exact finish holds. A hair is no part of the truth that shows; the radius is any share of
 * the distance, up to all of it. */
static void radius_off_long_numbers(void **state)
{
    const quad far = 3 / quad_sqrt((quad)DIM);
    (void)state;
    for (int n = 0; n < DRAWS; n++) {
        draws d = draws_from(28, 0, (uint64_t)n);
        const int share = below(&d, 60);
        V(options) o = default_options();
        V(result) r;
        fresh(NULL);
        a.kind = POINTS;
        a.count = DIM;
        for (int i = 0; i < DIM; i++) {
            for (int j = 0; j < DIM; j++) {
                const real hair = (real)((1 + (double)below(&d, 8)) * TINY);
                a.pose.m[DIM * i + j] = i == j ? 1 : hair;
                a.v[i][j] = i == j ? 3 : DIM == 2 ? hair : 0;
            }
        }
        bind(&a);
        b.kind = POINTS;
        b.count = 1;
        bind(&b);
        b.shape.radius = (real)((double)far * (1 - ldexp(between(&d, 0.5, 1), -share)));
        const quad gap = far - (quad)b.shape.radius, off = (quad)1e-33;
        o.tight = 1;
        assert_true(V(distance)(&a.shape, &b.shape, &o, &r) >= 0);
        assert_true((quad)r.lower <= positive(gap) + off && positive(gap) - off <= (quad)r.upper);
        if (share < (VARIANT_FLOAT ? 10 : 38)) {
            assert_true(r.upper - r.lower <= 2 * REAL_EPSILON * r.value);
        }
    }
}

/* Corners, maps and positions among whose numbers some are of a few last places of the least, so that products of them
 * all have more digits than the exact finish holds: it leaves those out, and tells the rest as it does elsewhere. */
static void draw_unlike(body *k, draws *d, double size)
{
    k->kind = below(d, 3) ? POINTS : BOX;
    k->count = 2 + below(d, 8);
    double m[DIM * DIM];
    rotation(d, INFINITY, m);
    for (int i = 0; i < DIM * DIM; i++) {
        k->pose.m[i] = (real)(below(d, 6) ? m[i] : TINY * below(d, 8));
    }
    for (int i = 0; i < DIM; i++) {
        k->half[i] = (real)(below(d, 3) ? size * between(d, 0, 1) : TINY * below(d, 8));
        k->pose.p[i] = (real)(below(d, 3) ? size * between(d, -0.5, 0.5) : TINY * below(d, 8));
        for (int j = 0; j < k->count; j++) {
            k->v[j][i] = (real)(below(d, 4) ? size * between(d, -1, 1) : TINY * below(d, 8));
        }
    }
    bind(k);
}

static void numbers_unlike(void **state)
{
    const int most = VARIANT_FLOAT ? 40 : 900;
    long apart = 0, meet = 0;
    double widest = 0;
    (void)state;
    for (int n = 0; n < DRAWS; n++) {
        static truth t;
        draws d = draws_from(30, 0, (uint64_t)n);
        const double size = ldexp(1, below(&d, 2 * most) - most);
        V(options) o = default_options();
        V(result) r;
        fresh(NULL);
        draw_unlike(&a, &d, size);
        draw_unlike(&b, &d, size);
        find_truth(&t, &a, &b, 1);
        const quad u = (quad)REAL_EPSILON / 2 * t.scale, off = 1e-31 * t.scale;
        expect(NULL, t.lower, t.upper, NEVER);
        o.tight = 1;
        assert_int_equal(V(distance)(&a.shape, &b.shape, &o, &r), GJK_OK);
        assert_true((quad)r.upper - (quad)r.lower <= (quad)(2 * REAL_EPSILON) * (quad)r.upper + off);
        assert_true((quad)r.upper <= off || !(t.upper < -u));
        apart += t.apart;
        if (V(penetration)(&a.shape, &b.shape, NULL, &r) == GJK_OK && !t.apart && t.certified) {
            assert_true((quad)r.lower <= t.upper && t.lower <= (quad)r.upper);
            widest = fmax(widest, (double)(((quad)r.upper - (quad)r.lower) / u));
            meet++;
        }
    }
    printf("%-6s unlike numbers: %ld apart, %ld meet, by brackets of %.1f u * scale at most\n", VARIANT, apart, meet,
           widest);
    assert_true(apart > DRAWS / 4 && meet > DRAWS / 8 && widest <= 16);
}

/* Two squares, in the plane two segments, whose numbers are as unlike, apart by less than what is left out of these: no
 * bracket says that they meet. */
static void unlike_and_hardly_apart(void **state)
{
    const int least = VARIANT_FLOAT ? -140 : -1060, most = VARIANT_FLOAT ? -20 : -300;
    (void)state;
    for (int n = 0; n < DRAWS; n++) {
        draws d = draws_from(31, 0, (uint64_t)n);
        const double gap = ldexp(1, least + below(&d, most - least));
        fresh(NULL);
        for (int k = 0; k < 2; k++) {
            body *of = k ? &b : &a;
            of->kind = POINTS;
            of->count = 1 << (DIM - 1);
            for (int i = 0; i < of->count; i++) {
                for (int j = 0; j < DIM - 1; j++) {
                    of->v[i][j] = (real)(i >> j & 1 ? 1 : -1);
                }
                of->v[i][DIM - 1] = (real)(TINY * below(&d, 4));
            }
            for (int i = 0; i < DIM * DIM; i++) {
                of->pose.m[i] = (real)(i % (DIM + 1) == 0 ? 1 : TINY * below(&d, 4));
            }
            bind(of);
        }
        b.pose.p[DIM - 1] = (real)gap;
        expect(NULL, (quad)gap - 64 * (quad)TINY, (quad)gap + 64 * (quad)TINY, NEVER);
        for (int k = 0; k < 2; k++) {
            V(options) o = default_options();
            V(result) r;
            o.tight = (uint32_t)k;
            assert_true(V(penetration)(&a.shape, &b.shape, &o, &r) >= 0);
            assert_true((quad)r.lower <= (quad)gap + 64 * (quad)TINY && (quad)gap - 64 * (quad)TINY <= (quad)r.upper);
        }
    }
}

#if DIM == 3 && !VARIANT_FLOAT
/* Two boxes sheared a billion to one, one beside itself with numbers of a few last places of the least, which overlap
 * by millions of roundings: that is told though their numbers are not to be held all together. */
static void unlike_and_sheared(void **state)
{
    static const double half[2][3] = {{5e-324, 1, 1.0000000000000002},
                                      {2.8961780008078509e-05, 3.6841747807521447e-05, 520085119.79218149}};
    static const double m[9] = {-1e-323,
                                -3.5e-323,
                                127375255.59215593,
                                2.8961780024509809e-05,
                                0.47003676470588229,
                                1e-323,
                                6.1035156249970835e-05,
                                127375255.59215586,
                                6.0908807334307514e-05};
    static const double at[3] = {-1.5e-323, -1e-323, -1.5e-323};
    V(result) r;
    (void)state;
    a.kind = b.kind = BOX;
    for (int i = 0; i < 3; i++) {
        a.half[i] = half[0][i];
        b.half[i] = half[1][i];
        a.pose.p[i] = at[i];
    }
    memcpy(a.pose.m, m, sizeof m);
    bind(&a);
    bind(&b);
    for (int k = 0; k < 2; k++) {
        assert_int_equal(V(distance)(k ? &b.shape : &a.shape, k ? &a.shape : &b.shape, NULL, &r), GJK_OK);
        assert_true(r.upper == 0);
    }
}

/* A needle through the origin, as long as numbers go, that is next to no thicker than 0: no unit of the distance, which
 * is 0, holds what is left out of it. */
static void unlike_and_huge(void **state)
{
    static const double half[3] = {2.2727019708697341e-322, 2.2727019708697341e-322, 16};
    V(options) o = default_options();
    V(result) r;
    (void)state;
    a.kind = BOX;
    for (int i = 0; i < 3; i++) {
        a.half[i] = half[i];
        a.pose.m[4 * i] = 0;
    }
    a.pose.m[3] = 25;
    a.pose.m[4] = 4.5454039417394682e-322;
    a.pose.m[5] = 5.0472341432901928e+305;
    a.pose.m[6] = 1.1049932511608379e+301;
    bind(&a);
    o.tight = 1;
    assert_int_equal(V(distance)(&a.shape, &b.shape, &o, &r), GJK_OK);
    assert_true(r.lower == 0 && r.upper <= 1e200);
}

/* A box whose map makes it far smaller than its numbers, or far larger, and that touches a face of a box far larger
 * than it is, which has numbers to be left out: its own are not, though they are next to the largest, or smallest. */
static void unlike_by_a_map(void **state)
{
    static const int half[2] = {1013, -300}, map[2] = {-77, 1000};
    (void)state;
    for (int k = 0; k < 2; k++) {
        fresh(NULL);
        a.kind = b.kind = BOX;
        for (int i = 0; i < 3; i++) {
            a.half[i] = i ? 0 : ldexp(1, half[k]);
            a.pose.m[4 * i] = ldexp(1, map[k]);
            b.half[i] = i ? ldexp(1, 1013) : 0x9p-1074;
        }
        a.half[1] = 1;
        a.pose.p[0] = -ldexp(1, half[k] + map[k]);
        a.pose.p[1] = -0x1p-77;
        bind(&a);
        bind(&b);
        expect(NULL, -9 * (quad)TINY, 0, NEVER);
        V(options) o = default_options();
        V(result) r;
        o.tight = 1;
        assert_int_equal(V(distance)(&a.shape, &b.shape, &o, &r), GJK_OK);
        assert_true(r.lower == 0 && r.upper <= 1e200);
    }
}

/* A plate with a radius on another, of sides so small that their squares have too many digits beside the radius': the
 * cores overlap by less than the radius is, or are apart by a little more. */
static void plates_of_next_to_no_size(void **state)
{
    (void)state;
    for (int k = -1074; k < -20; k += 3) {
        for (int side = -1; side <= 1; side += 2) {
            const double gap = side * 49 * (REAL_EPSILON / 2), size = ldexp(k % 2 ? 1 : 3, k);
            V(options) o = default_options();
            V(result) r;
            fresh(NULL);
            a.kind = b.kind = BOX;
            a.half[0] = a.half[1] = b.half[2] = size;
            a.shape.radius = 1;
            b.half[0] = 1 + (REAL_EPSILON / 2) * 2;
            b.half[1] = 4;
            b.pose.p[0] = 1;
            b.pose.p[1] = -1;
            b.pose.p[2] = -1 - gap;
            bind(&a);
            bind(&b);
            o.tight = 1;
            assert_int_equal(V(distance)(&a.shape, &b.shape, &o, &r), GJK_OK);
            const quad gap_of_all = -(quad)b.pose.p[2] - (quad)size - 1;
            const quad apart = gap_of_all > 0 ? gap_of_all : 0;
            assert_true(r.upper - r.lower <= 4 * (REAL_EPSILON / 2) * r.upper);
            assert_true((quad)r.lower <= apart && (quad)r.upper >= apart);
        }
    }
}

/* A point beside a triangle, in the plane of it, by less than what is left out of their numbers: no depth of 0 is said
 * to be theirs. */
static void unlike_and_hardly_beside(void **state)
{
    const double far = 0x1p450, least = 0x1p-1074;
    (void)state;
    for (int k = 0; k < 60; k++) {
        const double gap = ldexp(1, k);
        fresh(NULL);
        a.kind = b.kind = POINTS;
        a.count = 3;
        a.v[0][0] = -far;
        a.v[0][1] = 3 * least;
        a.v[1][0] = far;
        a.v[1][1] = -least;
        a.v[2][1] = -far;
        b.count = 1;
        b.v[0][0] = least;
        b.v[0][1] = gap;
        bind(&a);
        bind(&b);
        a.shape.pose = b.shape.pose = NULL;
        for (uint32_t tight = 0; tight < 2; tight++) {
            V(options) o = default_options();
            V(result) r;
            o.tight = tight;
            assert_true(V(penetration)(&a.shape, &b.shape, &o, &r) >= 0);
            assert_true(r.lower <= gap * (1 + 0x1p-50) && r.upper >= gap * (1 - 0x1p-50));
        }
    }
}
#endif

/* A box that its map flattens to a line but for rounding, with b on it or next to it, and one or both of them a couple,
 * so that no finish knows all corners. The generous reach of couples makes the box small in the pair's frame, and with
 * it the weights' errors that are to be seen. */
static void flattened_box_in_couples(void **state)
{
    double worst = 0;
    (void)state;
    for (uint64_t k = 0; k < DRAWS; k++) {
        static truth t;
        draws d = draws_from(29, 0, k);
        V(result) r;
        fresh(NULL);
        part[0].kind = BOX;
        const double along = between(&d, -DIM, DIM);
        for (int i = 0; i < DIM; i++) {
            part[0].half[i] = 1;
            for (int j = 0; j < DIM; j++) {
                const double off = below(&d, 2) ? 0 : ldexp(between(&d, 0, 1), -below(&d, VARIANT_FLOAT ? 24 : 53));
                part[0].pose.m[i * DIM + j] = (real)(-1 - off);
            }
            part[0].pose.p[i] = (real)(along + between(&d, -8, 8) * (double)REAL_EPSILON);
        }
        bind(&part[0]);
        couple(&a, SUM, &part[0], &part[1]);
        couple(&b, SUM, &part[2], &part[3]);
        if (k % 2) {
            a = part[0];
            bind(&a);
        }
        assert_true(V(distance)(&a.shape, &b.shape, NULL, &r) >= 0);
        find_truth(&t, &a, &b, 1);
        worst = fmax(worst, (double)(quad_abs((quad)r.value - positive(t.upper)) / ((quad)REAL_EPSILON / 2 * t.scale)));
    }
    printf("%-6s flattened couples: error at most %.2f u * scale\n", VARIANT, worst);
    assert_true(worst <= 6);
}

/* ---- poses ---- */

static void two_points(double x, double y, double map)
{
    fresh(NULL);
    a.kind = b.kind = POINTS;
    a.count = b.count = 1;
    a.v[0][0] = (real)x;
    b.v[0][0] = (real)y;
    map_by(&a, map);
    map_by(&b, map);
    bind(&a);
    bind(&b);
    expect_exactly(((quad)a.v[0][0] - (quad)b.v[0][0]) * (quad)a.pose.m[0], NEVER);
}

/* The pose takes the body to subnormal size, or below the least number: the bounds, rounded there, missed the truth. */
static void bodies_posed_into_subnormals(void **state)
{
    (void)state;
    for (int k = 1; k < 40; k++) {
        two_points(0.3, -0.4, k * TINY);
        two_points(1, -0.7, k * TINY);
    }
    for (int k = 0; k < 40; k++) {
        double x = ldexp(1 + k / 40.0, VARIANT_FLOAT ? -60 : -300);
        two_points(x, -x, (double)REAL_MIN / 256);
    }
}

/* Two points about as long as the least normal number, and the origin in a direction in which the nearer is hard to
 * tell: heights along a direction of size 1 round by whole tinies, more than the licence of so small a set. As a cloud,
 * as a couple, and under a map to normal size. */
static void as_small_as_normal_numbers_get(void **state)
{
    const double digits = ldexp(1, VARIANT_FLOAT ? 23 : 52);
    (void)state;
    for (int n = 0; n < 2 * DRAWS; n++) {
        draws d = draws_from(24, 0, (uint64_t)n);
        double sum = 0, near = 32 * (double)below(&d, 4);
        int posed = (int)below(&d, 2);
        body *k = below(&d, 2) ? &part[0] : &a;
        fresh(NULL);
        k->kind = POINTS;
        k->count = 2;
        for (int i = 0; i < DIM; i++) {
            double at = 32 * floor(between(&d, -1, 1) * digits / 32) + 24;
            at = i < DIM - 1 ? at : DIM * near - 24 - sum;
            sum += at;
            k->v[0][i] = (real)(at * TINY);
            k->v[1][i] = (real)(near * TINY);
        }
        bind(k);
        if (k == &part[0]) {
            couple(&a, SUM, &part[0], &part[1]);
        }
        if (posed) {
            map_by(&a, ldexp(1, VARIANT_FLOAT ? 100 : 1000));
        }
        b.kind = POINTS;
        b.count = 1;
        for (int i = 0; i < DIM; i++) {
            b.pose.p[i] = (real)(256 * TINY) * a.pose.m[0];
        }
        bind(&b);
        expect_found(NEVER);
        V(options) o = default_options();
        static truth t;
        find_truth(&t, &a, &b, 1);
        o.max_steps = 1;
        expect(&o, t.lower, t.upper, NEVER);
    }
}

/* Two points, the second taken only where its height is the greater. */
static real own_two_points(const void *data, const real *dir, real *point)
{
    const body *k = data;
    real rise[2] = {0};
    for (int i = 0; i < DIM; i++) {
        rise[0] += k->v[0][i] * dir[i];
        rise[1] += k->v[1][i] * dir[i];
    }
    memcpy(point, k->v[rise[1] > rise[0]], DIM * sizeof *point);
    return k->set.points.reach;
}

/* The same two by a support of the caller's own, of which no size is known before the first answer: it is asked once
 * more, along a direction long enough. Along one of size 1/16 the coordinates of the first round up, those of the
 * second down, and so the wrong one is as high. */
static void as_small_by_a_support_of_ones_own(void **state)
{
    const double digits = ldexp(1, VARIANT_FLOAT ? 23 : 52);
    (void)state;
    for (int n = 0; n < DRAWS; n++) {
        draws d = draws_from(26, 0, (uint64_t)n);
        double sum = 0, near = 32 * (double)below(&d, 4) + 8;
        fresh(NULL);
        a.kind = POINTS;
        a.count = 2;
        for (int i = 0; i < DIM; i++) {
            double at = 32 * floor(between(&d, -1, 1) * digits / 32) + 24;
            at = i < DIM - 1 ? at : DIM * (near - 16) - sum;
            sum += at;
            a.v[0][i] = (real)(at * TINY);
            a.v[1][i] = (real)(near * TINY);
        }
        bind(&a);
        if (below(&d, 2)) {
            map_by(&a, ldexp(1, VARIANT_FLOAT ? 100 : 1000));
        }
        for (int i = 0; i < DIM; i++) {
            b.pose.p[i] = (real)(256 * TINY) * a.pose.m[0];
        }
        static truth t;
        find_truth(&t, &a, &b, 1);
        a.shape.support = own_two_points;
        a.shape.data = &a;
        expect(NULL, t.lower, t.upper, NEVER);
    }
}

/* A ball by a support of the caller's own, which the library can't ask in another unit. */
static real own_ball(const void *data, const real *dir, real *point) { return V(support_ball)(data, dir, point); }

/* A radius of a few of the least numbers, and a map to normal size: what rounds in the ball's points, and is no
 * rounding of its reach, is as large as the map makes it. */
static void ball_of_few_digits(void **state)
{
    const int most = VARIANT_FLOAT ? 120 : 1000, least = VARIANT_FLOAT ? 30 : 60;
    (void)state;
    for (int n = 0; n < DRAWS; n++) {
        draws d = draws_from(25, 0, (uint64_t)n);
        double way[DIM], far = between(&d, 0.5, 4);
        quad at[DIM];
        fresh(NULL);
        start_body(&a, BALL);
        a.radius = (real)((double)(2 + below(&d, 40)) * TINY);
        bind(&a);
        a.shape.support = own_ball;
        map_by(&a, ldexp(1, least + below(&d, most - least)));
        unit(&d, way);
        quad size = (quad)a.radius * (quad)a.pose.m[0];
        for (int i = 0; i < DIM; i++) {
            b.pose.p[i] = (real)(way[i] * far * (double)size);
            at[i] = (quad)b.pose.p[i] / size;
        }
        expect_exactly((norm(at) - 1) * size, NEVER);
    }
}

/* The textbook's: no care for the size of dir. */
static real least_square, most_square;
static real naive_ball(const void *data, const real *dir, real *point)
{
    const real radius = data ? *(const real *)data : 1;
    real square = 0;
    for (int i = 0; i < DIM; i++) {
        square += dir[i] * dir[i];
    }
    least_square = square < least_square ? square : least_square;
    most_square = square > most_square ? square : most_square;
    for (int i = 0; i < DIM; i++) {
        point[i] = radius * (dir[i] / (real)sqrt((double)square));
    }
    return radius;
}

/* A pose that flattens the ball along the direction shortened it until its square was 0. */
static void flattened_ball(void **state)
{
    const int last = DIM - 1, from = VARIANT_FLOAT ? -60 : -490, to = VARIANT_FLOAT ? -100 : -700;
    (void)state;
    for (int e = from; e > to; e--) {
        double at[DIM] = {0};
        fresh(NULL);
        a.shape.support = naive_ball;
        a.pose.m[last * DIM + last] = (real)ldexp(1, e);
        at[last] = 1;
        place_point(&b, at);
        least_square = 1;
        expect_exactly(1 - (quad)a.pose.m[last * DIM + last], NEVER);
        assert_true(least_square > REAL_EPSILON);
    }
}

/* Whatever its size, and under whatever map, a set is asked along directions whose square is well within range. */
static void balls_of_any_size(void **state)
{
    const int range = VARIANT_FLOAT ? 100 : 980;
    (void)state;
    for (int n = 0; n < DRAWS; n++) {
        draws d = draws_from(27, 0, (uint64_t)n);
        int size = below(&d, 2 * range) - range, map = below(&d, 2 * range) - range;
        real radius = (real)ldexp(between(&d, 1, 2), size);
        double way[DIM], far = between(&d, 1.5, 4);
        quad at[DIM], grown;
        if (size + map < -range || size + map > range) {
            continue;
        }
        fresh(NULL);
        a.shape.support = naive_ball;
        a.shape.data = &radius;
        map_by(&a, ldexp(1, map));
        grown = (quad)radius * (quad)a.pose.m[0];
        unit(&d, way);
        for (int i = 0; i < DIM; i++) {
            b.pose.p[i] = (real)(way[i] * far * (double)grown);
            at[i] = (quad)b.pose.p[i] / grown;
        }
        least_square = most_square = 1;
        expect_exactly((norm(at) - 1) * grown, NEVER);
        assert_true(least_square > REAL_EPSILON && most_square < REAL_MAX / 256);
    }
}

/* ---- no size, and beyond all numbers ---- */

/* A set of no size has none under any map, and rounds nothing: beside it a small ball is as good as beside the origin.
 */
static void nothing_under_a_large_map(void **state)
{
    static const enum kind kinds[] = {ORIGIN, POINTS, BOX, SEGMENT, BALL, ELLIPSOID};
    const int large = VARIANT_FLOAT ? 120 : 1000;
    const real radius = (real)ldexp(1, VARIANT_FLOAT ? -100 : -950);
    (void)state;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        for (int e = 0; e < large; e += 7) {
            fresh(NULL);
            start_body(&a, kinds[k]);
            a.count = kinds[k] == POINTS;
            bind(&a);
            map_by(&a, ldexp(1, e));
            b.shape.support = naive_ball;
            b.shape.data = &radius;
            b.pose.p[0] = 3 * radius;
            for (int swap = 0; swap < 2; swap++) {
                V(result) r;
                assert_int_equal(V(distance)(swap ? &b.shape : &a.shape, swap ? &a.shape : &b.shape, NULL, &r), GJK_OK);
                assert_true(r.lower <= 2 * radius && r.upper >= 2 * radius);
                assert_true((double)r.upper - (double)r.lower <= 512 * U * (double)radius);
            }
        }
    }
}

/* A small pair so far out that the place overflows in the pair's own unit: the witnesses are at that place. */
static void small_and_far_out(void **state)
{
    const int size = VARIANT_FLOAT ? -100 : -900, place = VARIANT_FLOAT ? 100 : 900;
    (void)state;
    for (int query = 0; query < 2; query++) {
        V(result) r;
        fresh(NULL);
        two_points(ldexp(1, size), -ldexp(2, size), 1);
        a.pose.p[0] = b.pose.p[0] = (real)ldexp(1, place);
        expect_exactly((quad)a.v[0][0] - (quad)b.v[0][0], NEVER);
        assert_true(queries[query](&a.shape, &b.shape, NULL, &r) >= 0);
        assert_true(r.point_a[0] == a.pose.p[0] && r.point_b[0] == b.pose.p[0]);
    }
}

/* A radius of -0 is one of 0. */
static void radius_of_minus_zero(void **state)
{
    (void)state;
    for (int query = 0; query < 2; query++) {
        V(result) r[2];
        memset(r, 0, sizeof r);
        for (int minus = 0; minus < 2; minus++) {
            fresh(NULL);
            two_points(1, -2, 1);
            a.shape.radius = b.shape.radius = minus ? -(real)0 : 0;
            assert_true(queries[query](&a.shape, &b.shape, NULL, &r[minus]) >= 0);
        }
        assert_memory_equal(&r[0], &r[1], sizeof *r);
    }
}

/* Two points a little apart, both farther out than the largest number: the witnesses end there. */
static void witnesses_at_the_end_of_numbers(void **state)
{
    (void)state;
    for (int n = 0; n < 100; n++) {
        V(result) r;
        fresh(NULL);
        two_points(0, 0, 1);
        real out = REAL_MAX / (real)(64 + n), sign = n % 2 ? -1 : 1;
        a.v[0][0] = b.v[0][0] = sign * out;
        a.pose.p[0] = b.pose.p[0] = sign * REAL_MAX;
        b.pose.p[1] = out;
        bind(&a);
        bind(&b);
        expect_exactly(out, NEVER);
        for (int query = 0; query < 2; query++) {
            assert_true(queries[query](&a.shape, &b.shape, NULL, &r) >= 0);
            assert_true(r.point_a[0] == a.pose.p[0] && r.point_b[0] == b.pose.p[0]);
        }
    }
}

/* No face tells that smooth bodies overlap: it is probed for, down to depths of a few times the doubt. */
static void shallow_overlap_of_balls(void **state)
{
    (void)state;
    for (int units = 300; units < 3000; units += 100) {
        V(result) r;
        fresh(NULL);
        start_body(&a, BALL);
        start_body(&b, BALL);
        a.radius = 1;
        b.radius = (real)0.5;
        bind(&a);
        bind(&b);
        b.pose.p[0] = (real)(1.5 - units * U);
        assert_int_equal(V(intersect)(&a.shape, &b.shape, NULL, &r), GJK_DECIDED);
        assert_true(r.upper < 0);
    }
}

/* ---- a warm start ---- */

/* a: a triangle with one edge across the first axis. b: a wedge, its apex at 0 and farthest along that axis. */
static void triangle_and_wedge(void)
{
    fresh(NULL);
    a.kind = b.kind = POINTS;
    a.count = 3;
    a.v[0][1] = a.v[2][0] = 1;
    a.v[1][1] = -1;
    b.count = 1 + 2 * (DIM - 1);
    for (int k = 1; k < b.count; k++) {
        b.v[k][0] = -2;
        b.v[k][(k + 1) / 2] = k % 2 ? 50 : -50;
    }
    bind(&a);
    bind(&b);
}

/* What is remembered is the triangle against the apex; then the triangle is flattened and the edge shrunk to a speck on
 * the apex. The direction to test, along the speck, was so short that its length came out wrong, and the lower bound
 * with it. */
static void warm_start_from_a_speck(void **state)
{
    const quad depth = 1 / quad_sqrt(1 + (quad)(16 * (DIM - 1)) / 10000); /* to a side of the wedge moved by 1 */
    V(options) o = default_options();
    V(cache) first, cache;
    V(result) r;
    (void)state;
    triangle_and_wedge();
    map_by(&b, 0);
    b.pose.p[0] = (real)0.3;
    b.pose.p[1] = (real)0.05;
    b.pose.p[DIM - 1] += DIM - 2;
    memset(&first, 0, sizeof first);
    o.cache = &first;
    assert_true(V(distance)(&a.shape, &b.shape, &o, &r) >= 0);
    assert_int_equal(first.count, 3);
    o.cache = &cache;
    memset(&a.pose, 0, sizeof a.pose);
    memset(&b.pose, 0, sizeof b.pose);
    map_by(&b, -1);
    a.pose.m[0] = 1;
    for (int k = 0; k < 1000; k++) {
        double speck = ldexp(1 + k % 50 / 50.0, (VARIANT_FLOAT ? -78 : -545) + k / 50);
        a.pose.m[1] = (real)(k % 2 ? speck : -speck);
        for (int query = 0; query < 2; query++) {
            cache = first;
            for (int i = 0; i < 3; i++) { /* in any order of its corners */
                int from = (k / 2 % 2 ? i + k : 3 + k - i) % 3;
                memcpy(cache.a[i], first.a[from], sizeof cache.a[i]);
                memcpy(cache.b[i], first.b[from], sizeof cache.b[i]);
            }
            expect_query(query, 0, &o, -depth, -depth, NEVER);
        }
    }
}

/* ---- supports ---- */

static int calls;
static real soon_infinite(const void *data, const real *dir, real *point)
{
    (void)dir;
    for (int i = 0; i < DIM; i++) {
        point[i] = calls < *(const int *)data ? REAL_MAX / 2 : (real)INFINITY;
    }
    calls++;
    return REAL_MAX;
}

/* Beside a reach of the largest number, the bound on points rounded to infinity and let an infinite point in. */
static void infinite_point(void **state)
{
    (void)state;
    for (int finite = 0; finite < 2; finite++) {
        fresh(NULL);
        a.shape.support = soon_infinite;
        a.shape.data = &finite;
        map_by(&a, 1e-10);
        for (int query = 0; query < 2 - finite; query++) { /* the one finite point is proof enough for intersect */
            for (int swap = 0; swap < 2; swap++) {
                calls = 0;
                expect_query(query, swap, NULL, 0, 0, ALWAYS);
            }
        }
    }
}

/* From -1 to 1 on the first axis; along the axes it stops short by 0.1. */
static real short_segment(const void *data, const real *dir, real *point)
{
    int oblique = 0;
    (void)data;
    for (int i = 1; i < DIM; i++) {
        oblique |= dir[0] != 0 && dir[i] != 0;
    }
    memset(point, 0, DIM * sizeof *point);
    point[0] = (real)(oblique ? 1 : 0.9);
    point[0] = dir[0] < 0 ? -point[0] : point[0];
    return 0;
}

/* The library's own survey of the reach did not count the slack: the farthest point was then beyond it, and refused. */
static void short_by_the_slack(void **state)
{
    V(options) o = default_options();
    const quad answer = quad_sqrt(8);
    (void)state;
    o.slack = (real)0.125;
    a.shape.support = short_segment;
    b.pose.p[0] = 3;
    b.pose.p[1] = 2;
    expect(&o, answer, answer, NEVER);
}

/* Off by as much as a support may be, and alone: no doubt of another body or of the offset covers it. */
static double off_by; /* in roundings of its reach */
static real bar_at_the_edge(const void *data, const real *dir, real *point)
{
    (void)data;
    memset(point, 0, DIM * sizeof *point);
    point[0] = dir[0] < 0 ? -1 : 1;
    point[1] = (real)(0x1p-10 + off_by * U);
    return (real)1.001;
}

static void alone_at_the_edge_of_its_licence(void **state)
{
    int dummy;
    (void)state;
    for (int k = 0; k < 8; k++) {
        V(pose) pose;
        V(shape) bar, point;
        V(result) r;
        memset(&pose, 0, sizeof pose);
        memset(&bar, 0, sizeof bar);
        memset(&point, 0, sizeof point);
        for (int i = 0; i < DIM; i++) {
            pose.m[DIM * i + i] = 1;
        }
        off_by = k & 1 ? -7 : 7;
        bar.support = bar_at_the_edge;
        bar.data = &dummy;
        bar.pose = k & 2 ? &pose : NULL;
        point.support = V(support_origin);
        assert_true((k & 4 ? V(distance)(&point, &bar, NULL, &r) : V(distance)(&bar, &point, NULL, &r)) >= 0);
        assert_true(r.lower <= (real)0x1p-10 && r.upper >= (real)0x1p-10);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(inner_map_overflows_reach, fresh),
        cmocka_unit_test_setup(inner_map_overflows_direction, fresh),
        cmocka_unit_test_setup(inner_map_underflows_direction, fresh),
        cmocka_unit_test_setup(nested_couples, fresh),
        cmocka_unit_test_setup(parts_of_unknown_reach, fresh),
        cmocka_unit_test_setup(hair_beside_a_large_face, fresh),
        cmocka_unit_test_setup(radius_off_long_numbers, fresh),
        cmocka_unit_test_setup(numbers_unlike, fresh),
        cmocka_unit_test_setup(unlike_and_hardly_apart, fresh),
#if DIM == 3 && !VARIANT_FLOAT
        cmocka_unit_test_setup(unlike_and_sheared, fresh),
        cmocka_unit_test_setup(unlike_and_huge, fresh),
        cmocka_unit_test_setup(unlike_by_a_map, fresh),
        cmocka_unit_test_setup(plates_of_next_to_no_size, fresh),
        cmocka_unit_test_setup(unlike_and_hardly_beside, fresh),
#endif
        cmocka_unit_test_setup(flattened_box_in_couples, fresh),
        cmocka_unit_test_setup(bodies_posed_into_subnormals, fresh),
        cmocka_unit_test_setup(as_small_as_normal_numbers_get, fresh),
        cmocka_unit_test_setup(as_small_by_a_support_of_ones_own, fresh),
        cmocka_unit_test_setup(ball_of_few_digits, fresh),
        cmocka_unit_test_setup(flattened_ball, fresh),
        cmocka_unit_test_setup(balls_of_any_size, fresh),
        cmocka_unit_test_setup(nothing_under_a_large_map, fresh),
        cmocka_unit_test_setup(witnesses_at_the_end_of_numbers, fresh),
        cmocka_unit_test_setup(small_and_far_out, fresh),
        cmocka_unit_test_setup(radius_of_minus_zero, fresh),
        cmocka_unit_test_setup(shallow_overlap_of_balls, fresh),
        cmocka_unit_test_setup(warm_start_from_a_speck, fresh),
        cmocka_unit_test_setup(infinite_point, fresh),
        cmocka_unit_test_setup(short_by_the_slack, fresh),
        cmocka_unit_test(alone_at_the_edge_of_its_licence),
    };
    return cmocka_run_group_tests_name("extreme magnitudes to " VARIANT, tests, NULL, NULL);
}
