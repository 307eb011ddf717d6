/* SPDX-License-Identifier: MIT */
/* Each ready-made support against its formula in 113 bits: a farthest point, of the set, within the reach. */
#include "pairs.h"
#include "sets.h"

/* What the contract lets a support be off by, in units of roundoff times its reach. */
#define LICENCE 8

/* Directions of all kinds, of any size whose products with the sets' sizes stay within the format; n counts up from 0.
 */
static void draw_direction(draws *d, int n, real dir[DIM])
{
    static const double sizes[] = {1, 1e-9, 1e9, sizeof(real) == 8 ? 1e-250 : 1e-25, sizeof(real) == 8 ? 1e250 : 1e25};
    double x[DIM], size = sizes[below(d, 5)];
    int zero = 0;
    unit(d, x);
    for (int i = 0; i < DIM; i++) {
        if (n % 3 == 0) {
            x[i] = below(d, 3) - 1; /* axes, diagonals and ties */
        } else if (n % 3 == 1 && below(d, 3) == 0) {
            x[i] *= magnitude(d, -9, 0);
        }
        dir[i] = (real)(x[i] * size);
        zero += dir[i] == 0;
    }
    if (zero == DIM) {
        dir[below(d, DIM)] = (real)(below(d, 2) ? size : -size);
    }
}

/* Scaled to size 1, which changes no farthest point and keeps the formulas within their range. */
static void quad_direction(const real *dir, quad *out)
{
    quad most = 0;
    for (int i = 0; i < DIM; i++) {
        most = quad_abs((quad)dir[i]) > most ? quad_abs((quad)dir[i]) : most;
    }
    for (int i = 0; i < DIM; i++) {
        out[i] = (quad)dir[i] / most;
    }
}

/* How far the ellipsoid's point is at most from where its ray leaves the set. The grain, what underflow may have added
 * to a coordinate, is taken off first: of a radius hardly larger it is too great a share. */
static quad beyond_ellipsoid(const body *b, const quad *x, quad grain)
{
    quad y[DIM], off[DIM], ratio[DIM], q;
    for (int i = 0; i < DIM; i++) {
        y[i] = positive(quad_abs(x[i]) - grain);
        off[i] = quad_abs(x[i]) - y[i];
        ratio[i] = y[i] > 0 ? y[i] / (quad)b->half[i] : 0; /* infinite where the set is flat */
    }
    q = norm(ratio);
    return norm(off) + (q > 1 ? norm(y) * (1 - 1 / q) : 0);
}

/* A point of each set that lies nearest to x tells whether x is in it; here, how far out of it x is. */
static quad outside(const body *b, const quad *x, quad grain)
{
    quad flat = DIM == 3 ? quad_sqrt(x[0] * x[0] + x[1] * x[1]) : 0, r = (quad)b->radius, h = (quad)b->half_length;
    quad z = x[DIM - 1], off = 0;
    switch (b->kind) {
    case BALL:
        return positive(norm(x) - r);
    case ELLIPSOID:
        return beyond_ellipsoid(b, x, grain);
    case DISC:
        return positive(flat - r) + quad_abs(z);
    case CYLINDER:
        return positive(flat - r) + positive(quad_abs(z) - h);
    case CONE:
        off = h > 0 ? flat - r * (h - z) / (2 * h) : flat - r;
        return positive(off) + positive(quad_abs(z) - h);
    default:
        return 0; /* farthest along dir, and one of finitely many: see is_vertex */
    }
}

static int is_vertex(const body *b, const quad *x)
{
    quad v[MAX_VERTICES][DIM];
    int n = list_vertices(b, v), found = n == 0;
    for (int k = 0; k < n; k++) {
        int same = 1;
        for (int i = 0; i < DIM; i++) {
            same &= v[k][i] == x[i];
        }
        found |= same;
    }
    return found;
}

/* unit: by what everything is divided before the formulas are asked, so that they stay within their range. */
static void check_direction(const body *b, const real *dir, double unit_of, real *reach_before)
{
    real point[DIM], reach = b->shape.support(b->shape.data, dir, point);
    body small = *b;
    quad d[DIM], x[DIM], best[DIM], length, short_by = 0, r = (quad)reach / (quad)unit_of;
    quad grain = (quad)REAL_MIN * (quad)REAL_EPSILON / (quad)unit_of, licence = r * LICENCE * (quad)U + 8 * grain, out;
    assert_true(reach >= 0 && reach <= REAL_MAX);
    assert_true(*reach_before == -1 || reach == *reach_before);
    *reach_before = reach;
    for (int k = 0; k < MAX_POINTS; k++) {
        for (int i = 0; i < DIM; i++) {
            small.v[k][i] = (real)((double)b->v[k][i] / unit_of);
        }
    }
    for (int i = 0; i < DIM; i++) {
        small.half[i] = (real)((double)b->half[i] / unit_of);
        x[i] = (quad)point[i] / (quad)unit_of;
    }
    small.radius = (real)((double)b->radius / unit_of);
    small.half_length = (real)((double)b->half_length / unit_of);
    quad_direction(dir, d);
    length = norm(d);
    farthest_of_set(&small, d, best);
    for (int i = 0; i < DIM; i++) {
        short_by += d[i] * (best[i] - x[i]) / length;
    }
    out = outside(&small, x, grain);
    if (!(short_by <= licence && norm(x) <= r && norm(best) <= r && out <= licence)) {
        print_error("short by %g, out by %g, reach %g, length %g; dir", (double)(short_by / (r * (quad)U)),
                    (double)(out / (r * (quad)U)), (double)r, (double)norm(x));
        print_numbers(stderr, dir, DIM);
        print_error("\n  ");
        print_body(stderr, b);
        fail();
    }
    if (b->kind != SUM && b->kind != HULL) {
        assert_true(is_vertex(&small, x));
    }
}

static void draw_set(draws *d, enum kind kind, body *b)
{
    static const double ratio[] = {0, 1e-6, 0.5, 1, 1};
    start_body(b, kind);
    b->count = kind == POINTS ? 1 + below(d, MOST_POINTS) : kind == SEGMENT ? 2 : kind == TRIANGLE ? 3 : 0;
    for (int k = 0; k < b->count; k++) {
        double x[DIM];
        unit(d, x);
        for (int i = 0; i < DIM; i++) {
            b->v[k][i] = (real)(x[i] * ratio[below(d, 5)]);
        }
    }
    for (int i = 0; i < DIM; i++) {
        b->half[i] = (real)(between(d, 0.1, 1) * ratio[below(d, 5)]);
    }
    b->radius = (real)(between(d, 0.1, 1) * ratio[below(d, 5)]);
    b->half_length = (real)(between(d, 0.1, 1) * ratio[below(d, 5)]);
}

static void check_kind(enum kind kind)
{
    const int most = sizeof(real) == 8 ? 990 : 115;
    for (uint64_t i = 0; i < 3000; i++) {
        draws d = draws_from(3, (uint64_t)kind, i);
        body b;
        real dir[DIM], reach = -1;
        double by = ldexp(1, i % 2 ? 0 : below(&d, 2 * most + 1) - most);
        draw_set(&d, kind, &b);
        scale_body(&b, by);
        bind(&b);
        for (int n = 0; n < 12; n++) {
            draw_direction(&d, n, dir);
            if (by != 1) { /* one thing at a time: a direction of size 1 */
                real top = 0;
                for (int k = 0; k < DIM; k++) {
                    top = (real)fmax((double)top, fabs((double)dir[k]));
                }
                for (int k = 0; k < DIM; k++) {
                    dir[k] /= top;
                }
            }
            check_direction(&b, dir, by, &reach);
        }
    }
}

#define KIND(name, kind)                                                                                               \
    static void name(void **state)                                                                                     \
    {                                                                                                                  \
        (void)state;                                                                                                   \
        check_kind(kind);                                                                                              \
    }
KIND(points, POINTS)
KIND(box, BOX)
KIND(segment, SEGMENT)
KIND(ball, BALL)
KIND(ellipsoid, ELLIPSOID)
#if DIM == 3
KIND(triangle, TRIANGLE)
KIND(cylinder, CYLINDER)
KIND(cone, CONE)
KIND(disc, DISC)
#endif

/* Of any size a number can have; in every third, such that the radii times it are of like size. */
static void draw_any_direction(draws *d, int n, const body *b, real dir[DIM])
{
    const int least = sizeof(real) == 8 ? -1074 : -149, most = sizeof(real) == 8 ? 1023 : 127;
    double x[DIM], low = 0;
    int common = least + below(d, most - least + 1), zero = 0;
    unit(d, x);
    for (int i = 0; i < DIM; i++) {
        double half = (double)b->half[i];
        low = half > 0 && (low == 0 || half < low) ? half : low;
    }
    for (int i = 0; i < DIM; i++) {
        int exponent = n % 3 == 0 ? least + below(d, most - least + 1) : common;
        if (n % 3 == 1 && b->half[i] > 0) {
            x[i] *= low / (double)b->half[i];
        }
        dir[i] = below(d, 8) ? (real)ldexp(x[i], exponent) : 0;
        zero += dir[i] == 0;
    }
    if (zero == DIM) {
        dir[below(d, DIM)] = (real)ldexp(1, common);
    }
}

/* Axes of any ratio, flat ones, subnormal ones, along directions of any size. */
static void thin_ellipsoids(void **state)
{
    static const double ratio[] = {0, 1, 1e-6, 1e-30, sizeof(real) == 8 ? 1e-300 : 1e-36};
    const int least = sizeof(real) == 8 ? -1070 : -145, most = sizeof(real) == 8 ? 1023 : 127;
    (void)state;
    for (uint64_t i = 0; i < 6000; i++) {
        draws d = draws_from(6, 0, i);
        body b;
        real dir[DIM], reach = -1;
        int near_the_end = below(&d, 40), anywhere = least + below(&d, most - least + 1);
        int e = i % 4 == 0 ? least + near_the_end : i % 4 == 1 ? most - near_the_end : i % 4 == 2 ? 0 : anywhere;
        double by = ldexp(1, e);
        start_body(&b, ELLIPSOID);
        for (int k = 0; k < DIM; k++) {
            b.half[k] = (real)(between(&d, 0.5, 1.9) * ratio[below(&d, 5)]);
        }
        scale_body(&b, by);
        bind(&b);
        for (int n = 0; n < 12; n++) {
            draw_any_direction(&d, n, &b, dir);
            check_direction(&b, dir, by, &reach);
        }
    }
}

/* No direction at all: any point of the set will do. */
static void ellipsoid_along_nothing(void **state)
{
    real dir[DIM] = {0}, point[DIM];
    body b;
    (void)state;
    start_body(&b, ELLIPSOID);
    for (int round = 0; round < 2; round++) {
        bind(&b);
        assert_true(b.shape.support(b.shape.data, dir, point) > 0);
        for (int i = 0; i < DIM; i++) {
            assert_true(point[i] == 0);
            b.half[i] = 1;
        }
    }
}

/* Cores that are apart, and radii that reach across. */
static void rounded_ellipsoids(void **state)
{
    V(ellipsoid) e;
    V(pose) beside;
    V(result) r;
    (void)state;
    memset(&beside, 0, sizeof beside);
    for (int i = 0; i < DIM; i++) {
        e.radii[i] = 1;
        beside.m[i * (DIM + 1)] = 1;
    }
    beside.p[0] = (real)2.5;
    {
        const V(shape) a = {V(support_ellipsoid), &e, NULL, (real)0.5},
                       b = {V(support_ellipsoid), &e, &beside, (real)0.5};
        assert_int_equal(V(intersect)(&a, &b, NULL, &r), GJK_DECIDED);
        assert_true(r.upper < 0);
    }
}

#if DIM == 3
/* A thin ellipsoid aslant along two of the axes, which passes by the first set at a distance of more than 1, while the
 * way between the middles meets both. */
static void assert_passed_by(V(support_fn) * f, const void *data, int u, int v, real along_u, real along_v)
{
    const V(ellipsoid) thin = {{10, (real)0.0625, (real)0.0625}};
    for (int turn = -1; turn <= 1; turn += 2) {
        V(pose) pose;
        V(result) r;
        memset(&pose, 0, sizeof pose);
        pose.m[DIM * u] = pose.m[DIM * v + 1] = (real)0.6;
        pose.m[DIM * v] = (real)0.8 * (real)turn;
        pose.m[DIM * u + 1] = (real)-0.8 * (real)turn;
        pose.m[DIM * (DIM - u - v) + 2] = 1;
        pose.p[u] = along_u;
        pose.p[v] = along_v;
        {
            const V(shape) a = {f, data, NULL, 0}, b = {V(support_ellipsoid), &thin, &pose, 0};
            assert_int_equal(V(intersect)(&a, &b, NULL, &r), GJK_DECIDED);
            assert_true(r.lower > 0);
            assert_int_equal(V(intersect)(&b, &a, NULL, &r), GJK_DECIDED);
            assert_true(r.lower > 0);
        }
    }
}

/* A flat box in whose plane the way between the middles lies. */
static void flat_boxes(void **state)
{
    (void)state;
    for (int flat = 0; flat < DIM; flat++) {
        V(box) b = {{1, 1, 1}};
        const int u = (flat + 1) % DIM, v = (flat + 2) % DIM;
        b.half[flat] = 0;
        assert_passed_by(V(support_box), &b, u, v, 5, (real)0.25);
        assert_passed_by(V(support_box), &b, v, u, 5, (real)0.25);
    }
}

/* -0 is a size like 0. */
static void negative_zeros(void **state)
{
    const V(cone) needle = {(real)-0.0, 1};
    (void)state;
    assert_passed_by(V(support_cone), &needle, 0, 2, 5, (real)-0.25);
    for (int flat = 0; flat < DIM; flat++) {
        V(box) b = {{1, 1, 1}};
        b.half[flat] = (real)-0.0;
        assert_passed_by(V(support_box), &b, flat, (flat + 1) % DIM, 5, (real)0.25);
        assert_passed_by(V(support_box), &b, flat, (flat + 2) % DIM, 5, (real)0.25);
    }
}

/* A ball that its pose makes larger than all numbers: there is no bound on how deep the other is in it. */
static void beyond_numbers(void **state)
{
    const real far = sizeof(real) == sizeof(double) ? (real)0x1p60 * (real)0x1p40 : (real)0x1p70;
    const int times = sizeof(real) == sizeof(double) ? 6 : 1;
    V(ball) large = {1};
    V(pose) pose;
    V(result) r;
    const V(cylinder) small = {1, 1};
    (void)state;
    memset(&pose, 0, sizeof pose);
    for (int i = 0; i < times; i++) large.radius *= far;
    for (int i = 0; i < DIM; i++) pose.m[i * (DIM + 1)] = large.radius;
    {
        const V(shape) a = {V(support_cylinder), &small, NULL, 0}, b = {V(support_ball), &large, &pose, 0};
        assert_int_equal(V(intersect)(&a, &b, NULL, &r), GJK_BAD_SUPPORT);
    }
}
#endif

/* The ball of radius 1 under a pose that stretches, as an ellipsoid: the columns of the pose brought to size 1 by
 * powers of two, the radii those powers. The same set to the bit. */
static void to_ellipsoid(body *b)
{
    b->kind = ELLIPSOID;
    for (int j = 0; j < DIM; j++) {
        double most = 0;
        int e;
        for (int i = 0; i < DIM; i++) {
            most = fmax(most, fabs((double)b->pose.m[i * DIM + j]));
        }
        frexp(most, &e);
        b->half[j] = (real)ldexp(1, e);
        for (int i = 0; i < DIM; i++) {
            b->pose.m[i * DIM + j] = (real)ldexp((double)b->pose.m[i * DIM + j], -e);
        }
    }
}

/* Told either way, the set has one truth, and in float the answer is finished in double all the same. */
static void ellipsoids_as_balls(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 3000; i++) {
        draws d = draws_from(7, 0, i);
        pair p, q;
        V(result) r, s;
        do {
            draw_pair(&d, ELLIPSOIDS, &p);
        } while (p.a.kind != BALL);
        q = p;
        to_ellipsoid(&q.a);
        bind_pair(&q);
        bind_pair(&p);
        assert_true(V(distance)(&p.a.shape, &p.b.shape, NULL, &r) >= 0);
        assert_true(V(distance)(&q.a.shape, &q.b.shape, NULL, &s) >= 0);
        assert_true(r.lower <= s.upper && s.lower <= r.upper);
        assert_true(s.upper - s.lower <= 8 * (r.upper - r.lower));
        assert_true(V(intersect)(&q.a.shape, &q.b.shape, NULL, &s) >= 0);
        assert_true(s.lower <= r.upper && (r.lower <= 0 || s.upper >= r.lower));
    }
}

/* A turn by right angles, mirrored or not, times a power of two. */
static void draw_quarter_turn(draws *d, real m[DIM * DIM], int power)
{
    const int first = below(d, DIM), step = 1 + below(d, DIM - 1);
    memset(m, 0, DIM * DIM * sizeof *m);
    for (int i = 0; i < DIM; i++) {
        m[i * DIM + (first + i * step) % DIM] = (real)ldexp(below(d, 2) ? 1 : -1, power);
    }
}

static int is_same_answer(const V(result) * r, const V(result) * s)
{
    int same = r->status == s->status && r->value == s->value && r->lower == s->lower && r->upper == s->upper;
    for (int i = 0; i < DIM; i++) {
        same &= r->point_a[i] == s->point_a[i] && r->point_b[i] == s->point_b[i] && r->normal[i] == s->normal[i];
    }
    return same && r->steps == s->steps && r->supports == s->supports;
}

/* A ball is a point and a radius, to the bit, in whatever unit its map has it, and whichever of its axes has which. */
static void balls_as_points(void **state)
{
    long deep = 0;
    (void)state;
    for (uint64_t i = 0; i < 2000; i++) {
        draws d = draws_from(8, 0, i);
        pair p;
        V(pose) turned, straight;
        V(result) r, s;
        const int power = below(&d, 9) - 4, a_ball = below(&d, 2);
        const real radius = (real)between(&d, 0.2, 1);
        real radii[DIM];
        draw_pair(&d, i % FAMILIES, &p);
        bind_pair(&p);
        draw_quarter_turn(&d, turned.m, -power);
        memset(&straight, 0, sizeof straight);
        for (int j = 0; j < DIM; j++) {
            const int longer = below(&d, 4);
            turned.p[j] = straight.p[j] = p.b.pose.p[j] + (real)between(&d, -1, 1);
            straight.m[j * (DIM + 1)] = 1;
            radii[j] = (real)ldexp((double)radius, power + (a_ball ? 0 : longer));
            for (int k = 0; k < DIM && !a_ball; k++) turned.m[k * DIM + j] *= (real)ldexp(1, -longer);
        }
        const V(shape) ball = {a_ball ? V(support_ball) : V(support_ellipsoid), radii, &turned, 0};
        const V(shape) point = {V(support_origin), NULL, &straight, radius};
        V(distance)(&ball, &p.b.shape, NULL, &r);
        V(distance)(&point, &p.b.shape, NULL, &s);
        assert_true(is_same_answer(&r, &s));
        V(intersect)(&p.b.shape, &ball, NULL, &r);
        V(intersect)(&p.b.shape, &point, NULL, &s);
        assert_true(is_same_answer(&r, &s));
        V(penetration)(&ball, &p.b.shape, NULL, &r);
        V(penetration)(&point, &p.b.shape, NULL, &s);
        assert_true(is_same_answer(&r, &s));
        deep += r.upper < 0;
    }
    assert_true(deep > 100);
}

/* What the map's roundings, or what is hardly more, make of a ball is in the bracket: a point on an axis, which they
 * leave longer or shorter by so much. */
static void hardly_balls(void **state)
{
    const V(ball) ball = {(real)0.7};
    (void)state;
    for (int k = -24; k <= 24; k++) {
        for (int axis = 0; axis < DIM; axis++) {
            V(pose) of_ball, of_point;
            V(result) r;
            memset(&of_ball, 0, sizeof of_ball);
            memset(&of_point, 0, sizeof of_point);
            for (int j = 0; j < DIM; j++) of_ball.m[j * (DIM + 1)] = of_point.m[j * (DIM + 1)] = 1;
            of_ball.m[axis * (DIM + 1)] += (real)(k * (k < 0 ? U : 2 * U));
            for (int inside = 0; inside < 2; inside++) {
                of_point.p[axis] = (real)(inside ? 0.65 : 3);
                const V(shape) a = {V(support_ball), &ball, &of_ball, 0}, b = {V(support_origin), NULL, &of_point, 0};
                const quad apart = (quad)of_point.p[axis] - (quad)ball.radius * (quad)of_ball.m[axis * (DIM + 1)];
                assert_true(V(penetration)(&a, &b, NULL, &r) >= 0);
                assert_true((quad)r.lower <= apart && apart <= (quad)r.upper);
                assert_true((double)(r.upper - r.lower) <= 160 * U);
                assert_true(V(distance)(&b, &a, NULL, &r) >= 0);
                assert_true(inside ? r.upper == 0 : (quad)r.lower <= apart && apart <= (quad)r.upper);
            }
        }
    }
}

static void origin(void **state)
{
    real dir[DIM] = {1}, point[DIM];
    (void)state;
    memset(point, 0x5a, sizeof point);
    assert_true(V(support_origin)(NULL, dir, point) >= 0);
    for (int i = 0; i < DIM; i++) {
        assert_true(point[i] == 0);
    }
}

/* Parts turned, moved, stretched, flattened, rounded. */
static void couples(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 6000; i++) {
        draws d = draws_from(4, 0, i);
        body b, part[2];
        real dir[DIM], reach = -1;
        draw_couple(&d, &b, part, 0);
        if (below(&d, 3) == 0) {
            draw_affine(&d, &part[0]);
        }
        for (int k = 0; k < 2; k++) {
            b.part[k] = &part[k];
            bind(&part[k]);
        }
        bind(&b);
        for (int n = 0; n < 12; n++) {
            draw_direction(&d, n, dir);
            check_direction(&b, dir, 1, &reach);
        }
    }
}

/* A couple of couples, and the reach of a couple where a part does not know its own. */
static void nested_couples(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 2000; i++) {
        draws d = draws_from(4, 1, i);
        body top, mid[2], part[4];
        real dir[DIM], point[DIM], reach = -1;
        start_body(&top, below(&d, 2) ? SUM : HULL);
        for (int k = 0; k < 2; k++) {
            draw_couple(&d, &mid[k], part + 2 * k, 0);
            for (int j = 0; j < 2; j++) {
                mid[k].part[j] = &part[2 * k + j];
                bind(&part[2 * k + j]);
            }
            bind(&mid[k]);
            top.part[k] = &mid[k];
        }
        bind(&top);
        for (int n = 0; n < 12; n++) {
            draw_direction(&d, n, dir);
            check_direction(&top, dir, 1, &reach);
        }
        if (part[0].kind == POINTS) {
            part[0].set.points.reach = 0; /* found by the couple: nobody else can */
            real found = top.shape.support(top.shape.data, dir, point);
            assert_true(found >= reach && found <= 4 * reach);
        }
    }
}

#define LINKS 24

/* Couples in couples, one in the other, as deep as anyone stacks them: each is off by some roundings more. */
static void chains_of_couples(void **state)
{
    static body link[LINKS + 1], beside[LINKS];
    (void)state;
    for (uint64_t i = 0; i < 1000; i++) {
        draws d = draws_from(4, 2, i);
        const int links = 3 + below(&d, LINKS - 2);
        real dir[DIM], reach = -1;
        draw_round(&d, &link[0]);
        for (int k = 0; k < links; k++) {
            bind(&link[k]);
            draw_round(&d, &beside[k]);
            bind(&beside[k]);
            start_body(&link[k + 1], below(&d, 2) ? SUM : HULL);
            link[k + 1].part[0] = &link[k];
            link[k + 1].part[1] = &beside[k];
            if (below(&d, 8) == 0) draw_affine(&d, &link[k + 1]);
            else turn(&d, &link[k + 1], 100);
            for (int j = 0; j < DIM; j++) link[k + 1].pose.p[j] = (real)between(&d, -1, 1);
            if (below(&d, 4) == 0) link[k + 1].shape.radius = (real)between(&d, 0, 0.5);
        }
        bind(&link[links]);
        for (int n = 0; n < 12; n++) {
            draw_direction(&d, n, dir);
            check_direction(&link[links], dir, 1, &reach);
        }
    }
}

#define TURNS 400

/* Has the body's map follow those that all are made of. */
static void turn_quads(const body *b, quad all[DIM][DIM])
{
    quad before[DIM][DIM];
    memcpy(before, all, sizeof before);
    for (int i = 0; i < DIM; i++) {
        for (int j = 0; j < DIM; j++) {
            all[i][j] = 0;
            for (int k = 0; k < DIM; k++) all[i][j] += (quad)b->pose.m[DIM * i + k] * before[k][j];
        }
    }
}

/* How far the ball of radius 1 reaches along dir, through that map. */
static quad height_through(quad all[DIM][DIM], const quad *dir)
{
    quad back[DIM] = {0};
    for (int i = 0; i < DIM; i++)
        for (int j = 0; j < DIM; j++) back[j] += all[i][j] * dir[i];
    return norm(back) / norm(dir);
}

/* Turned again and again a set reaches no farther: a ball of radius 1, hull after hull. The licence grows by some
 * roundings with each, which are needed, and is not multiplied. */
static void turned_again(void **state)
{
    static body link[TURNS + 1], beside;
    draws d = draws_from(4, 3, 0);
    quad all[DIM][DIM] = {{0}};
    (void)state;
    start_body(&beside, BALL);
    beside.radius = (real)0.5;
    bind(&beside);
    for (int i = 0; i < DIM; i++) all[i][i] = 1;
    for (int k = 0; k <= TURNS; k++) {
        start_body(&link[k], k ? HULL : BALL);
        link[k].radius = 1;
        link[k].part[0] = &link[k - (k > 0)];
        link[k].part[1] = &beside;
        turn(&d, &link[k], 100);
        bind(&link[k]);
        for (int n = 0; n < 3; n++) {
            real dir[DIM], x[DIM];
            quad q[DIM], height = 0;
            draw_direction(&d, n, dir);
            const real reach = link[k].shape.support(link[k].shape.data, dir, x);
            quad_direction(dir, q);
            for (int i = 0; i < DIM; i++) height += q[i] / norm(q) * (quad)x[i];
            assert_true(quad_abs(height - height_through(all, q)) <= (quad)reach * LICENCE * (quad)U);
            assert_true(reach >= 1 && reach <= (real)(2 + 5 * k));
        }
        turn_quads(&link[k], all);
    }
}

/* A set that is the origin, whose support says that it reaches a little. */
static real next_to_nothing(const void *data, const real dir[DIM], real out[DIM])
{
    (void)dir;
    memset(out, 0, DIM * sizeof *out);
    return *(const real *)data;
}

/* Couple in couple around a set of unknown size, each grown by the least radius there is: every one rounds that. */
static void least_radii(void **state)
{
    static V(couple) link[TURNS];
    const real tiny = REAL_MIN * REAL_EPSILON;
    real reach = 3 * tiny;
    draws d = draws_from(4, 4, 0);
    (void)state;
    for (int k = 0; k < TURNS; k++) {
        link[k].a =
            (V(shape)){k ? V(support_sum) : next_to_nothing, k ? (void *)&link[k - 1] : (void *)&reach, NULL, tiny};
        link[k].b = (V(shape)){V(support_origin), NULL, NULL, 0};
        for (int n = 0; n < 3; n++) {
            real dir[DIM], x[DIM];
            quad q[DIM], height = 0;
            draw_direction(&d, n, dir);
            const quad licence = (quad)V(support_sum)(&link[k], dir, x) * LICENCE * (quad)U;
            quad_direction(dir, q);
            for (int i = 0; i < DIM; i++) height += q[i] / norm(q) * (quad)x[i];
            assert_true(quad_abs(height - (quad)(k + 1) * (quad)tiny) <= licence);
        }
    }
}

/* A set that is one point near the origin, and says so. */
static real some_tiny(const void *data, const real dir[DIM], real out[DIM])
{
    next_to_nothing(data, dir, out);
    out[0] = *(const real *)data;
    return out[0] < 0 ? -out[0] : out[0];
}

/* Of two points the one that is farther along a direction so short that heights underflow. */
static void hull_along_hardly_anything(void **state)
{
    const real far = 1000 * REAL_MIN * REAL_EPSILON, back = -far;
    const V(couple) c = {{some_tiny, &back, NULL, 0}, {some_tiny, &far, NULL, 0}};
    real dir[DIM] = {(real)1e-9}, x[DIM];
    (void)state;
    assert_true(V(support_hull)(&c, dir, x) > 0 && x[0] == far);
    dir[0] = (real)-1e-9;
    assert_true(V(support_hull)(&c, dir, x) > 0 && x[0] == back);
}

/* A part so small that its size underflows, which a pose makes large again: it is no point. */
static void part_of_no_number(void **state)
{
    const real small = sizeof(real) == sizeof(double) ? (real)1e-200 : (real)1e-25;
    const real large = sizeof(real) == sizeof(double) ? (real)1e300 : (real)1e35;
    V(pose) down, up, beside;
    V(couple) c;
    V(box) b;
    V(result) r;
    (void)state;
    memset(&down, 0, sizeof down);
    memset(&up, 0, sizeof up);
    memset(&beside, 0, sizeof beside);
    for (int i = 0; i < DIM; i++) {
        b.half[i] = down.m[i * (DIM + 1)] = small;
        up.m[i * (DIM + 1)] = large;
        beside.m[i * (DIM + 1)] = 1;
    }
    c.a = (V(shape)){V(support_box), &b, &down, 0};
    c.b = (V(shape)){V(support_origin), NULL, NULL, 0};
    for (int k = 0; k < 4; k++) {
        const real reached = small * large * small, off = k & 1 ? 3 * reached : reached / 2;
        const V(shape) whole = {k & 2 ? V(support_sum) : V(support_hull), &c, &up, 0},
                       point = {V(support_origin), NULL, &beside, 0};
        beside.p[0] = off;
        assert_true(V(penetration)(&whole, &point, NULL, &r) >= 0);
        assert_true(r.lower <= off - (real)0.99 * reached && r.upper >= off - (real)1.01 * reached);
        assert_true(V(intersect)(&whole, &point, NULL, &r) >= 0);
        assert_true(k & 1 ? r.lower > 0 : !(r.lower > 0));
    }
}

/* The least normal size through a map of almost the largest, asked along a way that hardly leaves an axis. */
static void largest_of_maps(void **state)
{
    const int top = sizeof(real) == sizeof(double) ? 1022 : 126;
    (void)state;
    for (int k = 0; k < 4; k++) {
        body part[2], b;
        real dir[DIM], reach = -1;
        start_body(&b, k & 1 ? SUM : HULL);
        start_body(&part[0], BOX);
        start_body(&part[1], POINTS);
        part[1].count = 1;
        memset(part[1].v, 0, sizeof part[1].v);
        for (int i = 0; i < DIM; i++) {
            part[0].half[i] = REAL_MIN;
            part[0].pose.m[i * (DIM + 1)] = (real)ldexp(1, top + (k >> 1));
            dir[i] = i ? (real)-ldexp(1, sizeof(real) == sizeof(double) ? -49 : -20) : 1;
        }
        for (int j = 0; j < 2; j++) {
            b.part[j] = &part[j];
            bind(&part[j]);
        }
        bind(&b);
        check_direction(&b, dir, 1, &reach);
    }
}

/* A point that is no number is found out wherever it stands in a cloud of any length. */
static void none_among_many(void **state)
{
    static real v[70][DIM];
    const real nones[3] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    (void)state;
    for (int n = 1; n <= 70; n++) {
        for (int at = 0; at < n; at++) {
            V(points) p = {v[0], (size_t)n, 0, 0, 2};
            real dir[DIM] = {1}, out[DIM];
            memset(v, 0, sizeof v);
            dir[1] = (real)0.5;
            assert_true(V(support_points)(&p, dir, out) == 2);
            v[at][at % 2] = nones[(at + n) % 3];
            assert_true(isnan(V(support_points)(&p, dir, out)));
        }
    }
}

/* Heights whose sum overflows: a long cloud is no other than a short one. */
static void far_clouds(void **state)
{
    static real v[40][DIM];
    (void)state;
    for (int n = 28; n <= 40; n++) {
        V(points) p = {v[0], (size_t)n, 0, 0, 0};
        real dir[DIM] = {2}, out[DIM] = {0};
        for (int i = 0; i < n; i++) {
            v[i][0] = REAL_MAX / 4;
            v[i][1] = REAL_MAX / 320 * (real)i;
        }
        p.reach = V(points_reach)(&p);
        assert_true(V(support_points)(&p, dir, out) == p.reach);
        assert_true(out[0] == REAL_MAX / 4);
    }
}

/* The reach found once, rounded up but little. */
static void cloud_reaches(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 5000; i++) {
        draws d = draws_from(5, 0, i);
        body b;
        quad most = 0;
        int exponent = below(&d, sizeof(real) == 8 ? 1980 : 230) - (sizeof(real) == 8 ? 990 : 115);
        draw_set(&d, POINTS, &b);
        b.v[0][0] = 1;
        for (int k = 0; k < b.count; k++) {
            quad x[DIM], length;
            for (int j = 0; j < DIM; j++) {
                x[j] = (quad)b.v[k][j];
            }
            length = norm(x);
            most = length > most ? length : most;
        }
        scale_body(&b, ldexp(1, exponent));
        bind(&b);
        assert_true((quad)b.set.points.reach / (quad)ldexp(1, exponent) >= most);
        assert_true(((quad)b.set.points.reach - (quad)REAL_MIN) / (quad)ldexp(1, exponent) <=
                    most * (1 + 64 * (quad)U));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points),
        cmocka_unit_test(box),
        cmocka_unit_test(segment),
        cmocka_unit_test(ball),
        cmocka_unit_test(ellipsoid),
        cmocka_unit_test(thin_ellipsoids),
        cmocka_unit_test(ellipsoid_along_nothing),
        cmocka_unit_test(ellipsoids_as_balls),
        cmocka_unit_test(balls_as_points),
        cmocka_unit_test(hardly_balls),
        cmocka_unit_test(rounded_ellipsoids),
        cmocka_unit_test(origin),
#if DIM == 3
        cmocka_unit_test(triangle),
        cmocka_unit_test(cylinder),
        cmocka_unit_test(cone),
        cmocka_unit_test(disc),
        cmocka_unit_test(flat_boxes),
        cmocka_unit_test(negative_zeros),
        cmocka_unit_test(beyond_numbers),
#endif
        cmocka_unit_test(couples),
        cmocka_unit_test(nested_couples),
        cmocka_unit_test(chains_of_couples),
        cmocka_unit_test(turned_again),
        cmocka_unit_test(least_radii),
        cmocka_unit_test(hull_along_hardly_anything),
        cmocka_unit_test(part_of_no_number),
        cmocka_unit_test(largest_of_maps),
        cmocka_unit_test(none_among_many),
        cmocka_unit_test(far_clouds),
        cmocka_unit_test(cloud_reaches),
    };
    return cmocka_run_group_tests_name("shapes of " VARIANT, tests, NULL, NULL);
}
