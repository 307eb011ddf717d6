/* SPDX-License-Identifier: MIT */
/* What the everyday answer rests on, from inside: a variant is compiled in. The value of a distance comes from one pair
 * of points; what rounding took from it, and its length, are held against 113 bits. No bound depends on them, so no
 * bracket would show that they are worse than they should be. Nor would it of what else is asked before an answer is
 * told, where other questions mostly see the same; each is asked by itself here. Numbers that know how far they may be
 * off are held against 2000 bits. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>
#include <gmp.h>
#include "quad.h"
#include "splitmix.h"
#include "inside.h"

#define PAIRS 20000

static uint64_t state_of_draws;

static double any_between(double least, double most)
{
    return least + (most - least) * ((double)(splitmix64(&state_of_draws) >> 11) / 0x1p53);
}

static real any_real(double least, double most) { return (real)any_between(least, most); }

static box boxes[2];
static pose poses[2];
static shape shapes[2];
static search q;

static int place_together;

/* The everyday way to them, without a glance. */
static int open_both(void)
{
    static const options none;
    q.d.calls = 0;
    return list_both(&q, &shapes[0], &shapes[1], &none) && settle_both(&q, &shapes[0], &shapes[1]) &&
           open_listed(&q, NULL);
}

/* Two boxes, each of a size of its own, out in the world, under maps that are no rotations; or under none. */
static int open_pair(void)
{
    for (int k = 0; k < 2; k++) {
        double size = pow(10, any_between(-3, 3));
        shapes[k] = (shape){pub(support_box), &boxes[k], any_between(0, 4) < 3 ? &poses[k] : NULL, 0};
        for (int i = 0; i < DIM; i++) {
            boxes[k].half[i] = any_real(size / 2, size);
            poses[k].p[i] = place_together ? 0 : any_real(-100, 100);
        }
        for (int i = 0; i < DIM * DIM; i++) {
            poses[k].m[i] = any_real(-1, 1);
        }
    }
    if (!open_both()) {
        return 0;
    }
    know_offset(&q.d, &shapes[0], &shapes[1]);
    return 1;
}

/* Somewhere in the box, times its grain. */
static vec draw_point(const box *b, real grain, vec *low)
{
    vec x;
    for (int i = 0; i < DIM; i++) {
        x.c[i] = any_real(-1, 1) * b->half[i] * grain;
        low->c[i] = any_real(-1, 1) * UNIT * x.c[i];
    }
    return x;
}

static spots draw_spots(void)
{
    vec low_a, low_b, x = draw_point(&boxes[0], q.d.a.grain, &low_a), y = draw_point(&boxes[1], q.d.b.grain, &low_b);
    spots p = spots_at(&q.d, &q.d.maps, duos_of(x, y));
    p.low = duos_of(low_a, low_b);
    return p;
}

/* Coordinate i of the body's point in the frame. */
static quad position(const shape *s, vec x, vec low, int i)
{
    quad sum = 0;
    if (!s->pose) {
        return (quad)x.c[i] + (quad)low.c[i];
    }
    for (int j = 0; j < DIM; j++) {
        sum += (quad)s->pose->m[DIM * i + j] * ((quad)x.c[j] + (quad)low.c[j]);
    }
    return sum;
}

static quad offset_of(int i)
{
    quad b = shapes[1].pose ? (quad)poses[1].p[i] : 0, a = shapes[0].pose ? (quad)poses[0].p[i] : 0;
    return (b - a) * (quad)q.d.scale;
}

/* The rest of a product is 2^-GRID of it, and rounds a few times. */
static void what_rounding_took(void **state)
{
    const quad most = 5 * (quad)UNIT / (quad)((uint64_t)1 << GRID);
    double worst = 0;
    (void)state;
    state_of_draws = 1;
    for (int k = 0; k < PAIRS; k++) {
        spots p;
        vec low;
        assert_true(open_pair());
        p = draw_spots();
        low = lost_of_spots(&q.d, &q.d.maps, &p);
        for (int i = 0; i < DIM; i++) {
            quad truth = position(&shapes[0], vec_of_a(p.x), vec_of_a(p.low), i) -
                         position(&shapes[1], vec_of_b(p.x), vec_of_b(p.low), i) - offset_of(i);
            quad error = quad_abs((quad)p.w.c[i] + (quad)low.c[i] - truth);
            worst = fmax(worst, (double)(error / most));
        }
    }
    printf("error at most %.2f of what is allowed\n", worst);
    assert_true(worst <= 1 && worst > 0);
}

static void the_length(void **state)
{
    double worst = 0;
    (void)state;
    state_of_draws = 1;
    for (int k = 0; k < PAIRS; k++) {
        vec w, low;
        quad square = 0, error;
        twin l;
        for (int i = 0; i < DIM; i++) {
            w.c[i] = any_real(0.1, 1) * (real)(any_between(-1, 1) < 0 ? -1 : 1);
            low.c[i] = any_real(-1, 1) * 4 * UNIT;
            square += ((quad)w.c[i] + (quad)low.c[i]) * ((quad)w.c[i] + (quad)low.c[i]);
        }
        l = length_by_digits(w, length(w), low);
        error = quad_abs((quad)l.high + (quad)l.low - quad_sqrt(square));
        worst = fmax(worst, (double)(error / ((quad)UNIT / (quad)((bits)1 << GRID) + 100 * (quad)UNIT * (quad)UNIT)));
    }
    printf("length: error at most %.2f of what is allowed\n", worst);
    assert_true(worst <= 10 && worst > 0); /* low has 4u, its square over twice the least length 80 u^2 */
}

static quad coordinate(int corner, int i) { return (quad)q.s.slot[corner].w.c[i]; }

/* How far the origin is from the plane of the facet opposite that corner, on its side; squared, with that sign. */
static quad height_over(int corner)
{
    quad to[DIM + 1][DIM], n[DIM], size = 0, height = 0, side = 0, h;
    int at = 0, first = corner == 0 ? 1 : 0;
    for (int k = 0; k <= DIM; k++) {
        for (int i = 0; i < DIM && k != corner && k != first; i++) {
            to[at][i] = coordinate(k, i) - coordinate(first, i);
        }
        at += k != corner && k != first;
    }
#if DIM == 2
    n[0] = -to[0][1];
    n[1] = to[0][0];
#else
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = to[0][j] * to[1][k] - to[0][k] * to[1][j];
    }
#endif
    for (int i = 0; i < DIM; i++) {
        size += n[i] * n[i];
        height -= n[i] * coordinate(first, i);
        side += n[i] * (coordinate(corner, i) - coordinate(first, i));
    }
    h = height * height / size;
    return (height < 0) == (side < 0) ? h : -h;
}

/* Simplices that hold the origin, narrow by any power of two, the origin near a facet or a corner. */
static int draw_simplex(void)
{
    double narrow = ldexp(1, -(int)any_between(0, MANTISSA)), low = ldexp(1, -(int)any_between(0, MANTISSA + 2));
    clear(&q.s);
    q.s.n = DIM + 1;
    for (int k = 0; k <= DIM; k++) {
        for (int i = 0; i < DIM; i++) {
            q.s.slot[k].w.c[i] = any_real(-1, 1);
        }
        q.s.slot[k].w.c[DIM - 1] *= (real)(k == 0 ? 1 : low);
        q.s.slot[k].w.c[0] *= (real)narrow;
    }
    return holds(&q.s, q.weight);
}

/* Room is less than there is. */
static void rough_rooms(void **state)
{
    int count = 0, above = 0;
    (void)state;
    state_of_draws = 1;
    for (int k = 0; k < 50 * PAIRS; k++) {
        real rough;
        if (!draw_simplex()) {
            continue;
        }
        count++;
        rough = rough_room(&q.s, q.weight);
        for (int i = 0; i <= DIM && rough > 0; i++) {
            assert_true((quad)rough * (quad)rough <= height_over(i));
        }
        above += rough > 0;
    }
    printf("%d simplices hold the origin, %d with room\n", count, above);
    assert_true(above > count / 8 && above < count);
}

/* The pair that the weights single out is v, to 8 roundings of the frame; else the weights are not good enough, however
 * narrow the bracket is. */
static void the_pair_is_v(void **state)
{
    const goal g = {.beyond = REAL_MAX, .within = -1};
    (void)state;
    state_of_draws = 2;
    for (int k = 0; k < PAIRS; k++) {
        spots p;
        real upper;
        assert_true(open_pair());
        for (int i = 0; i < DIM; i++) {
            q.v.c[i] = any_real(0.25, 1);
        }
        p.w = q.v;
        upper = length(q.v);
        q.lower = upper - q.d.doubt;
        if (!(q.lower > 33 * q.d.doubt)) {
            continue;
        }
        assert_true(is_evident(&q, &g, STILL, &p, upper));
        p.w.c[k % DIM] += (real)(k % 2 ? 10 : -10) * UNIT;
        assert_false(is_evident(&q, &g, STILL, &p, upper));
        p.w = q.v;
        q.lower = upper - 5 * q.d.doubt;
        assert_false(is_evident(&q, &g, STILL, &p, upper));
    }
}

/* A corner of the difference, as the search has it. */
static vertex draw_corner(void)
{
    vertex c;
    for (int i = 0; i < DIM; i++) {
        c.x.c[i] = any_between(-1, 1) < 0 ? -boxes[0].half[i] : boxes[0].half[i];
        c.y.c[i] = any_between(-1, 1) < 0 ? -boxes[1].half[i] : boxes[1].half[i];
    }
    c.w = corner_of(&q.d, c.x, c.y);
    return c;
}

/* The way between two corners of the simplex without rounding. */
static void edge_in_quads(int from, int to, quad e[DIM])
{
    const vec none = axis(0, 0);
    const vertex *a = corner(&q.s, from), *b = corner(&q.s, to);
    for (int i = 0; i < DIM; i++) {
        e[i] = position(&shapes[0], mul(b->x, q.d.a.grain), none, i) -
               position(&shapes[0], mul(a->x, q.d.a.grain), none, i) -
               position(&shapes[1], mul(b->y, q.d.b.grain), none, i) +
               position(&shapes[1], mul(a->y, q.d.b.grain), none, i);
    }
}

static quad quad_inner(const quad *x, const quad *y)
{
    quad sum = 0;
    for (int i = 0; i < DIM; i++) {
        sum += x[i] * y[i];
    }
    return sum;
}

/* How far a way is off square to the edges of a body as they are, in u^2, once it has been made so from one that is,
 * rounded; or 0, where the edges are hardly two. */
static double off_square(int corners, int of_a)
{
    quad e[DIM][DIM], v[DIM], worst = 0;
    sight s = {.tall = 0};
    q.s.n = corners;
    for (int k = 0; k < corners; k++) {
        vertex *c = &q.s.slot[q.s.at[k]];
        *c = draw_corner();
        *(of_a ? &c->y : &c->x) = of_a ? corner(&q.s, 0)->y : corner(&q.s, 0)->x;
        s.weight[k] = (real)1 / (real)corners;
    }
    for (int i = 0; i < DIM; i++) {
        v[i] = (quad)any_real(-1, 1);
    }
    for (int k = 1; k < corners; k++) {
        quad length_before;
        edge_in_quads(0, k, e[k]);
        length_before = quad_inner(e[k], e[k]);
        for (int j = 1; j < k; j++) {
            quad share = quad_inner(e[k], e[j]) / quad_inner(e[j], e[j]);
            for (int i = 0; i < DIM; i++) {
                e[k][i] -= share * e[j][i];
            }
        }
        if (!(quad_inner(e[k], e[k]) > length_before / 100)) {
            return 0;
        }
        quad share = quad_inner(v, e[k]) / quad_inner(e[k], e[k]);
        for (int i = 0; i < DIM; i++) {
            v[i] -= share * e[k][i];
        }
    }
    for (int i = 0; i < DIM; i++) {
        s.way.high.c[i] = (real)v[i];
    }
    assert_true(make_square(&s, &q));
    for (int i = 0; i < DIM; i++) {
        v[i] = (quad)s.way.high.c[i] + (quad)s.way.low.c[i];
    }
    for (int k = 1; k < corners; k++) {
        quad off = quad_abs(quad_inner(v, e[k])) / quad_sqrt(quad_inner(v, v) * quad_inner(e[k], e[k]));
        worst = off > worst ? off : worst;
    }
    return (double)(worst / ((quad)UNIT * (quad)UNIT));
}

static void square_to_corners_far_away(void **state)
{
    double worst = 0;
    (void)state;
    state_of_draws = 6;
    for (int k = 0; k < PAIRS; k++) {
        assert_true(open_pair());
        worst = fmax(worst, off_square(2 + k % (DIM - 1), k / 2 % 2));
    }
    printf("square to the edges within %.1f u^2\n", worst);
    assert_true(worst <= 0x1p14 && worst > 0); /* edges that a map flattens lose digits, or whose angle is small */
}

/* Square to the simplex, in the frame. */
static vec square_to_simplex(void)
{
    vec e = sub(point(&q.s, 1), point(&q.s, 0));
#if DIM == 2
    return (vec){{e.c[1], -e.c[0]}};
#else
    return cross(e, sub(point(&q.s, 2), point(&q.s, 0)));
#endif
}

/* The first corner has that weight, the others as much as one another of what is left. */
static void weigh_first(sight *s, real first)
{
    for (int i = 0; i < DIM; i++) {
        s->weight[i] = i == 0 ? first : (1 - first) / (DIM - 1);
    }
}

/* Corners of the first box against one of the other, half a unit apart where the first corner has that weight. 0: they
 * are too narrow. */
static int open_simplex(sight *s, real first)
{
    vec n;
    assert_true(open_pair());
    q.s.n = DIM;
    q.d.c = q.d.c_low = axis(0, 0);
    for (int i = 0; i < DIM; i++) {
        vertex *c = &q.s.slot[q.s.at[i]];
        *c = draw_corner();
        c->y = corner(&q.s, 0)->y;
        c->w = corner_of(&q.d, c->x, c->y);
    }
    n = square_to_simplex();
    if (!(length(n) > (real)0.01)) {
        return 0;
    }
    weigh_first(s, first);
    look_across(s, &q);
    q.d.c = sub(s->way.high, mul(n, 1 / (2 * length(n))));
    return 1;
}

/* Of a narrow simplex weights are off by many roundings, and the pair they single out is not where the way is square
 * to the edges: a second look is, where one is not enough. But none is taken at a pair that is outside the bodies. */
static void weights_may_be_off(void **state)
{
    int once = 0, twice = 0;
    (void)state;
    state_of_draws = 8;
    for (int k = 0; k < PAIRS; k++) {
        sight s;
        if (!open_simplex(&s, (real)0.25)) {
            continue;
        }
        weigh_first(&s, (real)0.25 + 1024 * UNIT);
        look_across(&s, &q);
        once += make_square(&s, &q);
        weigh_first(&s, (real)0.25 + 1024 * UNIT);
        twice += look_squarely(&s, &q);
        assert_true(once <= twice);
        if (open_simplex(&s, -(real)0x1p-6)) {
            weigh_first(&s, (real)0x1p-6);
            assert_false(look_squarely(&s, &q));
        }
    }
    printf("weights that are off: one look is enough for %d, a second for %d\n", once, twice);
    assert_true(twice > PAIRS / 8 && once < twice / 2);
}

/* ---- how far below the way's end the sets reach ---- */

/* The lowest height of a box's corners along v, or with sign -1 minus the highest, in the frame. */
static quad lowest_of(const shape *s, const box *b, real grain, const quad v[DIM], int sign)
{
    quad least = 0;
    for (int j = 0; j < DIM; j++) {
        quad up = 0;
        for (int i = 0; i < DIM; i++) {
            up += v[i] * (s->pose ? (quad)s->pose->m[DIM * i + j] : (quad)(i == j));
        }
        least -= quad_abs(up) * (quad)(b->half[j] * grain);
    }
    return sign * least;
}

/* Of any simplex, level or not: what it and the lowest corners take from the way's length is what they lie lower. */
static void what_the_way_falls_short(void **state)
{
    double worst = 0;
    (void)state;
    state_of_draws = 9;
    for (int k = 0; k < PAIRS; k++) {
        sight s = {.tall = 0};
        vertex last;
        real fall;
        quad v[DIM], square = 0, lowest = 0;
        assert_true(open_pair());
        q.s.n = 1 + k % DIM;
        for (int i = 0; i < q.s.n; i++) {
            q.s.slot[q.s.at[i]] = draw_corner();
            s.weight[i] = any_real(0.1, 1);
        }
        normalize(s.weight, q.s.n);
        look_across(&s, &q);
        measure_edges(&s, &q);
        for (int i = 1; i < q.s.n; i++) {
            s.rise_a[i] = rise_along(&s.way, &s.edge_a[i]);
            s.rise_b[i] = rise_along(&s.way, &s.edge_b[i]);
        }
        fall = short_of_way(&s, &q, length_of_way(&s.way).high, &last);
        for (int i = 0; i < DIM; i++) {
            v[i] = (quad)s.way.high.c[i] + (quad)s.way.low.c[i];
            square += v[i] * v[i];
            lowest -= v[i] * offset_of(i);
        }
        lowest += lowest_of(&shapes[0], &boxes[0], q.d.a.grain, v, 1);
        lowest -= lowest_of(&shapes[1], &boxes[1], q.d.b.grain, v, -1);
        worst = fmax(worst, (double)(quad_abs(square - lowest - (quad)fall * quad_sqrt(square)) / quad_sqrt(square)));
    }
    worst /= (double)UNIT;
    printf("what the way falls short: within %.1f u\n", worst);
    assert_true(worst <= 16 && worst > 0);
}

/* ---- facets that are placed by rounded corners ---- */

static usual_room room_of_all;

#if DIM == 3
/* The facet across each seam has that seam, too, and knows whom it has there. */
static void expect_closed(const polytope *p)
{
    for (int k = 0; k < p->facets; k++) {
        for (int i = 0; i < 3; i++) {
            const seam s = seam_of(p, k, i);
            assert_in_range(s.next, 0, p->facets - 1);
            const seam back = seam_of(p, s.next, seam_to(p, s.next, s));
            assert_true(back.v[0] == s.v[1] && back.v[1] == s.v[0] && back.next == k);
        }
    }
}

/* Two facets that have nothing in common make room for one corner: the rim goes around twice. */
static void two_holes_are_closed(void **state)
{
    static const int16_t side[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                       {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    static const int16_t across[8][3] = {{4, 1, 3}, {5, 2, 0}, {6, 3, 1}, {7, 0, 2},
                                         {0, 7, 5}, {1, 4, 6}, {2, 5, 7}, {3, 6, 4}};
    static const int gone[2] = {0, 6};
    polytope p = polytope_in(&room_of_all, USUAL_TIPS);
    (void)state;
    memset(p.tip, 0, 7 * sizeof *p.tip);
    for (int k = 0; k < 6; k++) {
        p.tip[k].w = axis(k / 2, k % 2 ? (real)-1 : (real)1);
    }
    p.tip[6].w = (vec){{2, 2, 2}};
    p.tips = 7;
    for (int k = 0; k < 8; k++) {
        put_facet(&p, side[k]);
        memcpy(p.facet[k].next, across[k], sizeof across[k]);
    }
    expect_closed(&p);
    for (int k = 0; k < 2; k++) {
        p.facet[gone[k]].gone = 1;
        for (int i = 0; i < 3; i++) {
            p.rim[p.rims++] = seam_of(&p, gone[k], i);
        }
    }
    put_all_on(&p, p.rims, 6);
    settle_in(&p, 8, 2);
    assert_int_equal(p.facets, 12);
    expect_closed(&p);
}
#endif

/* A facet that is done has been asked for by more than rounded corners. */
static void done_is_not_rough(void **state)
{
    long done = 0;
    (void)state;
    state_of_draws = 8;
    for (int k = 0; k < PAIRS / 10; k++) {
        const goal g = {.beyond = REAL_MAX, .within = -1, .exact = 1, .deep = 1, .max_steps = 256};
        depth d;
        begin_depth(&d, &q, &shapes[0], &shapes[1], &g);
        place_together = 1;
        assert_true(open_pair());
        place_together = 0;
        d.p = polytope_in(&room_of_all, USUAL_TIPS);
        d.p.whole = &q.d;
        if (stroll(&q, &g, HEADINGS, 0) != INSIDE || first_surface(&d) != OPEN || deepen(&d) != STILL) {
            continue;
        }
        for (int i = 0; i < d.p.facets; i++) {
            assert_false(d.p.facet[i].done && d.p.facet[i].rough == 1);
            done += d.p.facet[i].done;
        }
    }
    printf("done %ld\n", done);
    assert_true(done > PAIRS / 100);
}

/* ---- where corners are sought ---- */

#define CORNERS 16

static real corners[2][CORNERS][DIM];
static points clouds[2];

/* Two hulls, a thousandth apart. */
static void draw_near_hulls(void)
{
    result r = {0};
    for (int k = 0; k < 2; k++) {
        shapes[k] = (shape){pub(support_points), &clouds[k], &poses[k], 0};
        for (int i = 0; i < CORNERS; i++) {
            for (int j = 0; j < DIM; j++) {
                corners[k][i][j] = any_real(-1, 1);
            }
        }
        clouds[k] = (points){.v = corners[k][0], .count = CORNERS};
        clouds[k].reach = pub(points_reach)(&clouds[k]);
        for (int i = 0; i < DIM; i++) {
            poses[k].p[i] = k == 0 ? 0 : any_real(-4, 4);
            for (int j = 0; j < DIM; j++) {
                poses[k].m[DIM * i + j] = i == j;
            }
        }
    }
    assert_true(pub(penetration)(&shapes[0], &shapes[1], NULL, &r) >= 0);
    for (int i = 0; i < DIM; i++) {
        poses[1].p[i] -= (r.value - (real)1e-3) * r.normal[i];
    }
}

/* How many support calls show that they are apart. */
static long calls_to_apart(int headings)
{
    const goal g = {.abs_tol = -1, .sign_only = 1, .exact = 1, .max_steps = 256};
    assert_true(open_both());
    assert_true(stroll(&q, &g, headings, 1) == BEYOND);
    return q.d.calls;
}

static void headings_save_calls(void **state)
{
    long with = 0, without = 0;
    (void)state;
    state_of_draws = 9;
    for (int k = 0; k < PAIRS / 10; k++) {
        draw_near_hulls();
        with += calls_to_apart(HEADINGS);
        without += calls_to_apart(0);
    }
    printf("near hulls: %.2f calls, without headings %.2f\n", (double)with / (PAIRS / 10),
           (double)without / (PAIRS / 10));
    assert_true(with * 10 < without * 9);
}

/* ---- numbers that know how far they may be off ---- */

static mpf_t truth_a, truth_b, truth_r, addend;

/* Hulls and boxes, some rounded, under maps of sizes of their own. */
static void draw_scattered(void)
{
    for (int k = 0; k < 2; k++) {
        double size = pow(10, any_between(-2, 2)), of_map = pow(10, any_between(-2, 2));
        for (int i = 0; i < DIM; i++) {
            boxes[k].half[i] = any_real(0, size);
            poses[k].p[i] = any_real(-3, 3) * (real)(size * of_map);
        }
        for (int i = 0; i < DIM * DIM; i++) poses[k].m[i] = any_real(-1, 1) * (real)of_map;
        for (int i = 0; i < CORNERS; i++) {
            for (int j = 0; j < DIM; j++) corners[k][i][j] = any_real(-1, 1) * (real)size;
        }
        clouds[k] = (points){.v = corners[k][0], .count = CORNERS};
        clouds[k].reach = pub(points_reach)(&clouds[k]);
        shapes[k] = any_between(0, 2) < 1 ? (shape){pub(support_box), &boxes[k], &poses[k], 0}
                                          : (shape){pub(support_points), &clouds[k], &poses[k], 0};
        if (k == 0 && any_between(0, 4) < 1) shapes[k].pose = NULL;
        if (any_between(0, 3) < 1) shapes[k].radius = any_real(0, size);
    }
}

static long told_apart, told_meeting, aimed, in_vain;

/* What a glance tells it tells without a frame as in one. */
static void compare_glances(void)
{
    static const options none;
    result glanced = {0}, framed = {0};
    assert_true(list_both(&q, &shapes[0], &shapes[1], &none));
    const enum glanced seen = are_boxes(&shapes[0], &shapes[1])
                                  ? glance_at_boxes(&q, 256, &shapes[0], &shapes[1], &glanced)
                                  : glance(&q, &shapes[0], &shapes[1], &glanced);
    assert_true(seen == TELLING || seen == AIMED || seen == CLOUDED || seen == IN_VAIN);
    assert_true(open_both());
    const int in_frame = look_in_frame(&q, 256, &shapes[0], &shapes[1], &framed);
    in_vain += seen == IN_VAIN;
    aimed += seen == AIMED;
    if (seen != TELLING) {
        assert_true(seen == IN_VAIN || !in_frame); /* boxes that are not turned alone have axes in a frame only */
        return;
    }
    assert_true(in_frame);
    told_apart += glanced.lower > 0;
    told_meeting += glanced.upper < 0;
    assert_memory_equal(glanced.normal, framed.normal, sizeof framed.normal);
    assert_memory_equal(glanced.point_a, framed.point_a, sizeof framed.point_a);
    assert_memory_equal(glanced.point_b, framed.point_b, sizeof framed.point_b);
    assert_true(glanced.value == framed.value && glanced.lower == framed.lower && glanced.upper == framed.upper);
    assert_true(glanced.value == (glanced.lower > 0 ? glanced.lower : glanced.upper));
    assert_true(glanced.steps == framed.steps && glanced.supports == framed.supports);
}

/* By the first corner. */
static void a_glance_needs_no_frame(void **state)
{
    long apart = 0;
    (void)state;
    state_of_draws = 11;
    told_apart = told_meeting = aimed = in_vain = 0;
    for (int k = 0; k < PAIRS; k++) {
        result r = {0};
        draw_scattered();
        compare_glances();
        apart += pub(intersect)(&shapes[0], &shapes[1], NULL, &r) == GJK_DECIDED && r.lower > 0;
    }
    assert_true(5 * told_apart > 4 * apart && in_vain > PAIRS / 10);
}

/* A turn, to rounding. */
static void draw_turn(real m[DIM * DIM])
{
    double u[DIM][DIM];
    for (int i = 0; i < DIM; i++) {
        double l = 0;
        for (int j = 0; j < DIM; j++) u[i][j] = any_between(-1, 1);
        for (int k = 0; k < 2 * i; k++) {
            double along = 0;
            for (int j = 0; j < DIM; j++) along += u[i][j] * u[k % i][j];
            for (int j = 0; j < DIM; j++) u[i][j] -= along * u[k % i][j];
        }
        for (int j = 0; j < DIM; j++) l += u[i][j] * u[i][j];
        for (int j = 0; j < DIM; j++) m[DIM * i + j] = (real)(u[i][j] /= sqrt(l));
    }
}

#if DIM == 3
/* A corner of a box over another's face, whose fourth corner may look lower than the three that the walk has: the
 * distance is told where it stops, without what gaps need that rounding blurs. */
static void a_fourth_corner_is_level(void **state)
{
    const goal g = {.beyond = REAL_MAX, .within = -1, .abs_tol = 0, .max_steps = 256};
    long stopped = 0, told = 0, lowest = 0;
    (void)state;
    state_of_draws = 21;
    for (int n = 0; n < 20000; n++) {
        result r;
        for (int k = 0; k < 2; k++) {
            shapes[k] = (shape){pub(support_box), &boxes[k], &poses[k], 0};
            draw_turn(poses[k].m);
            for (int i = 0; i < DIM; i++) {
                boxes[k].half[i] = any_real(0.5, 1);
                poses[k].p[i] = k ? any_real(-1.5, 1.5) : 0;
            }
        }
        if (!open_both()) {
            continue;
        }
        q.told = 0;
        q.glanced = UNTRIED;
        const enum end end = walk(&q, &shapes[0], &shapes[1], &g, &r);
        if (end != OPEN || q.told || q.s.n < DIM || q.steps >= g.max_steps) {
            continue;
        }
        const int calls = q.d.calls;
        stopped++;
        if (tell_distance_at_last(&q, &shapes[0], &shapes[1], &g, &r)) {
            told++;
            lowest += q.d.calls > calls;
        }
    }
    printf("of %ld walks that stopped at a corner of the face %ld are told, %ld by its own normal\n", stopped, told,
           lowest);
    assert_true(stopped > 100 && 10 * told > 9 * stopped && lowest > 20);
}
#endif

#if DIM == 3
#define MOST_CORNERS 100

static real hull_corners[2][MOST_CORNERS * (DIM + 1)];
static points hulls[2];

/* Two hulls of some corners, of one size, so far from each other, each among its own origin or beside it. */
static void draw_hulls(real size, real far, int stride)
{
    for (int k = 0; k < 2; k++) {
        const int count = 5 + (int)any_between(0, any_between(0, 2) < 1 ? 20 : MOST_CORNERS - 5);
        const real aside = any_real(0, 1) < (real)0.2 ? size : 0;
        for (int i = 0; i < count * stride; i++) hull_corners[k][i] = any_real(-1, 1) * size + aside;
        hulls[k] = (points){hull_corners[k], (size_t)count, (uint32_t)(stride * (int)sizeof(real)), 0, 0};
        hulls[k].reach = pub(points_reach)(&hulls[k]);
        draw_turn(poses[k].m);
        for (int i = 0; i < DIM; i++) poses[k].p[i] = any_real(-far, far) * size;
        shapes[k] = (shape){pub(support_points), &hulls[k], any_between(0, 8) < 7 ? &poses[k] : NULL, 0};
    }
}

/* How far the point lies from the body, at least. */
static real distance_of(const real *point, const shape *s)
{
    pose at = {.m = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    const shape alone = {pub(support_origin), NULL, &at, 0};
    result r;
    for (int i = 0; i < DIM; i++) at.p[i] = point[i];
    assert_true(pub(distance)(&alone, s, NULL, &r) >= 0);
    return r.lower;
}

/* How far apart the hulls are along n, in their exact places. */
static quad apart_along(const quad n[DIM])
{
    quad most[2] = {0, 0}, l = 0;
    for (int k = 0; k < 2; k++) {
        const list all = list_of_cloud(&hulls[k]);
        for (size_t j = 0; j < all.count; j++) {
            const real *x = all.v + all.step * j;
            quad h = 0;
            for (int i = 0; i < DIM; i++) {
                quad at = (quad)x[i];
                if (shapes[k].pose) {
                    at = (quad)poses[k].p[i];
                    for (int m = 0; m < DIM; m++) at += (quad)poses[k].m[DIM * i + m] * (quad)x[m];
                }
                h += k ? -n[i] * at : n[i] * at;
            }
            if (j == 0 || h > most[k]) most[k] = h;
        }
    }
    for (int i = 0; i < DIM; i++) l += n[i] * n[i];
    return -(most[0] + most[1]) / quad_sqrt(l);
}

/* The normal shows lower, to its own rounding. Where it is that of the line of centres, that line itself does, to none:
 * that is 1 then. */
static int check_lower(const result *r, real size)
{
    quad n[DIM], c[DIM];
    for (int i = 0; i < DIM; i++) {
        n[i] = (quad)r->normal[i];
        c[i] = (shapes[1].pose ? (quad)poses[1].p[i] : 0) - (shapes[0].pose ? (quad)poses[0].p[i] : 0);
    }
    assert_true((quad)r->lower <= apart_along(n) + (quad)(64 * UNIT * size));
    if (r->steps != (r->lower > 0 ? 1 : 3)) return 0;
    assert_true((quad)r->lower <= apart_along(c));
    return 1;
}

/* Two hulls are told at the door what they are told behind it, to the bit; and that is so. */
static void hulls_are_told_at_the_door(void **state)
{
    const options steps = {.size = sizeof steps, .max_steps = 255};
    long apart = 0, deep = 0, by_three = 0, dug = 0, along_centres = 0;
    (void)state;
    state_of_draws = 17;
    for (int k = 0; k < PAIRS / 4; k++) {
        result told, behind, p;
        const real size = (real)pow(10, any_between(-3, 3));
        draw_hulls(size, k % 2 ? (real)0.5 : (real)1.5, k % 5 ? DIM : DIM + 1);
        memset(&told, 0, sizeof told);
        memset(&behind, 0, sizeof behind);
        assert_true(pub(intersect)(&shapes[0], &shapes[1], NULL, &told) >= 0);
        assert_true(pub(intersect)(&shapes[0], &shapes[1], &steps, &behind) >= 0);
        assert_memory_equal(&told, &behind, sizeof told);
        assert_true(pub(penetration)(&shapes[0], &shapes[1], NULL, &p) >= 0);
        assert_true(told.lower <= p.upper && p.lower <= told.upper);
        apart += told.lower > 0;
        if (told.lower > 0 || told.upper < 0) along_centres += check_lower(&told, size);
        if (!(told.upper < 0)) continue;
        deep++;
        by_three += told.steps == 3;
        dug += told.steps <= 1 + DEEPEST;
        for (int i = 0; i < 2; i++) assert_true(distance_of(told.point_a, &shapes[i]) <= 64 * UNIT * size);
        assert_memory_equal(told.point_a, told.point_b, sizeof told.point_a);
    }
    assert_true(apart > 500 && deep > 3000 && 2 * by_three > deep && 5 * dug > 4 * deep);
    assert_true(along_centres > deep / 2);
}
#endif

/* Along the axes of two boxes that are turned, and lie near each other. */
static void axes_need_no_frame(void **state)
{
    (void)state;
    state_of_draws = 13;
    told_apart = told_meeting = aimed = in_vain = 0;
    for (int k = 0; k < PAIRS; k++) {
        const real size = (real)pow(10, any_between(-2, 2));
        for (int i = 0; i < 2; i++) {
            for (int j = 0; j < DIM; j++) {
                boxes[i].half[j] = any_real((real)0.1, 1) * size;
                poses[i].p[j] = any_real(0, 2) * size;
            }
            draw_turn(poses[i].m);
            shapes[i] = (shape){pub(support_box), &boxes[i], k % 8 == i ? NULL : &poses[i], 0};
            if (k % 3 == 0) shapes[i].radius = any_real(0, size / 4);
        }
        compare_glances();
    }
    assert_true(told_apart + told_meeting > PAIRS * 9 / 10 && told_apart > PAIRS / 10 && told_meeting > PAIRS / 10);
}

/* Nor do axes of length 1 that are far from square to each other: what a frame makes of them does not depend on that.
 */
static void skew_axes_need_no_frame(void **state)
{
    (void)state;
    state_of_draws = 14;
    told_apart = told_meeting = aimed = in_vain = 0;
    for (int k = 0; k < PAIRS; k++) {
        for (int i = 0; i < 2; i++) {
            for (int j = 0; j < DIM; j++) {
                boxes[i].half[j] = any_real((real)0.1, 1);
                poses[i].p[j] = any_real(0, 3);
            }
            draw_turn(poses[i].m);
            for (int j = 0; j < DIM; j++) {
                double l = 0;
                for (int row = 0; row < DIM; row++) {
                    poses[i].m[DIM * row + j] += any_real(0, 1);
                    l += (double)poses[i].m[DIM * row + j] * (double)poses[i].m[DIM * row + j];
                }
                for (int row = 0; row < DIM; row++) poses[i].m[DIM * row + j] /= (real)sqrt(l);
            }
            shapes[i] = (shape){pub(support_box), &boxes[i], &poses[i], 0};
        }
        compare_glances();
    }
    assert_true(told_apart > PAIRS / 10);
}

/* What two turned boxes tell of their distance is found without a walk, as a rule: one corner proves it. */
static void a_gap_needs_no_walk(void **state)
{
    long apart = 0, at_once = 0;
    (void)state;
    state_of_draws = 15;
    for (int k = 0; k < PAIRS; k++) {
        result r = {0};
        for (int i = 0; i < 2; i++) {
            for (int j = 0; j < DIM; j++) {
                boxes[i].half[j] = any_real((real)0.1, 1);
                poses[i].p[j] = any_real(0, 3);
            }
            draw_turn(poses[i].m);
            shapes[i] = (shape){pub(support_box), &boxes[i], &poses[i], 0};
        }
        assert_int_equal(pub(distance)(&shapes[0], &shapes[1], NULL, &r), GJK_OK);
        apart += r.lower > 0;
        at_once += r.lower > 0 && r.steps == 1 && r.supports <= 4;
    }
    assert_true(apart > PAIRS / 4 && at_once > apart * 95 / 100);
}

/* A turn of few digits, and a stretch: its axes are not of length 1, and hardly square to each other. */
static void draw_rough_turn(real m[DIM * DIM])
{
    const double grid = ldexp(1, (MANTISSA + 9) / 2), stretched = any_between(1, 2);
    draw_turn(m);
    for (int i = 0; i < DIM * DIM; i++) m[i] = (real)(floor((double)m[i] * grid + 0.5) / grid * stretched);
}

/* What such boxes tell of a gap that is small beside them is off by hardly more than the gap rounds. */
static void a_gap_of_skew_boxes_is_exact(void **state)
{
    double worst = 0;
    long told = 0;
    (void)state;
    state_of_draws = 16;
    for (int k = 0; k < PAIRS; k++) {
        static const options exact = {.size = sizeof exact, .tight = 1};
        const double gap = pow(10, any_between(-2, 0));
        result r = {0}, truth = {0};
        for (int i = 0; i < 2; i++) {
            for (int j = 0; j < DIM; j++) {
                boxes[i].half[j] = any_real((real)0.1, 1);
                poses[i].p[j] = any_real(0, 4);
            }
            draw_rough_turn(poses[i].m);
            shapes[i] = (shape){pub(support_box), &boxes[i], &poses[i], 0};
        }
        assert_int_equal(pub(distance)(&shapes[0], &shapes[1], NULL, &r), GJK_OK);
        if (!(r.lower > (real)gap)) continue;
        for (int j = 0; j < DIM; j++) poses[1].p[j] -= (r.lower - (real)gap) * r.normal[j];
        assert_int_equal(pub(distance)(&shapes[0], &shapes[1], NULL, &r), GJK_OK);
        assert_int_equal(pub(distance)(&shapes[0], &shapes[1], &exact, &truth), GJK_OK);
        if (r.steps > 1) continue;
        worst = fmax(worst, fabs((double)r.value - (double)truth.value) / (double)UNIT - 2 * gap);
        told++;
    }
    printf("off by %.3f u at most\n", worst);
    assert_true(told > PAIRS / 4 && worst < 0.125);
}

/* Turned about the second axis, and before that on an edge, or not; its first axis leads up by roundings. */
static void draw_slope(real m[DIM * DIM], int on_edge)
{
    const double turned = DIM == 3 ? any_between(-3, 3) : 0, c = cos(turned), s = sin(turned),
                 h = on_edge ? sqrt(0.5) : 0;
    const double uphill = any_between(-256, 256) * (double)UNIT, up = on_edge && DIM == 3 ? h : 1;
    for (int i = 0; i < DIM * DIM; i++) m[i] = 0;
    m[0] = (real)c;
    m[DIM] = (real)uphill;
    m[1] = (real)(DIM == 3 ? -s * h : -uphill);
    m[DIM + 1] = (real)up;
    if (DIM == 3) {
        m[2 * DIM] = (real)s;
        m[2 * DIM + 1] = (real)(c * h);
        m[DIM - 1] = (real)(-s * up);
        m[2 * DIM - 1] = (real)-h;
        m[3 * DIM - 1] = (real)(c * up);
    }
}

/* A face or an edge over a face, off parallel to it by so little that the bracket hardly tells: the lowest point is a
 * corner all the same. */
static void a_slope_of_roundings_is_seen(void **state)
{
    double worst = 0;
    long told = 0;
    (void)state;
    state_of_draws = 17;
    for (int k = 0; k < PAIRS; k++) {
        static const options exact = {.size = sizeof exact, .tight = 1};
        result r = {0}, truth = {0};
        for (int i = 0; i < 2; i++) {
            for (int j = 0; j < DIM; j++) {
                boxes[i].half[j] = any_real((real)0.25, 1);
                poses[i].p[j] = i == 0 ? 0 : j == 1 ? any_real(2, 3) : any_real(-1, 1);
            }
            shapes[i] = (shape){pub(support_box), &boxes[i], i == 0 ? NULL : &poses[i], 0};
        }
        draw_slope(poses[1].m, k % 2);
        assert_int_equal(pub(distance)(&shapes[0], &shapes[1], NULL, &r), GJK_OK);
        assert_int_equal(pub(distance)(&shapes[0], &shapes[1], &exact, &truth), GJK_OK);
        worst = fmax(worst, fabs((double)r.value - (double)truth.value) / (double)UNIT);
        told += r.steps == 1;
    }
    printf("off by %.3f u at most, %ld at once\n", worst, told);
    assert_true(told > PAIRS / 8 && worst <= 8);
}

/* Squares of lengths near the root of the largest number: sets off their own positions, in a unit so large, answer as
 * they do in their own. */
static void a_glance_sees_no_overflow(void **state)
{
    (void)state;
    state_of_draws = 12;
    for (int k = 0; k < PAIRS / 10; k++) {
        result own, large;
        const real off = any_real((real)0.1, 1), c = any_real((real)0.1, 1),
                   radius = k % 3 ? 0 : any_real(0, (real)0.1);
        const int unposed = any_between(0, 2) < 1;
        const real half[2] = {any_real(0, (real)0.1), any_real(0, (real)0.1)};
        for (int e = 0; e <= 8; e++) {
            const real unit = (real)(e == 0 ? 1 : ldexp(1, (sizeof(real) == 8 ? 512 : 64) - 6 + e));
            for (int n = 0; n < 9; n++) { /* more than a glance in the plane is not cast at */
                for (int i = 0; i < DIM; i++) corners[0][n][i] = 0;
                corners[0][n][0] = -off * unit;
                corners[0][n][1] = half[0] * unit * (real)n / 8;
            }
            clouds[0] = (points){.v = corners[0][0], .count = 9, .reach = off * unit * (real)1.25};
            for (int i = 0; i < DIM; i++) {
                boxes[1].half[i] = half[1] * unit;
                poses[0].p[i] = poses[1].p[i] = 0;
                for (int j = 0; j < DIM; j++) poses[0].m[DIM * i + j] = poses[1].m[DIM * i + j] = i == j;
            }
            poses[1].p[0] = c * unit;
            shapes[0] = (shape){pub(support_points), &clouds[0], unposed ? NULL : &poses[0], 0};
            shapes[1] = (shape){pub(support_box), &boxes[1], &poses[1], radius * unit};
            result *r = e == 0 ? &own : &large;
            pub(intersect)(&shapes[0], &shapes[1], NULL, r);
            if (e == 0) continue;
            assert_int_equal(large.status, own.status);
            assert_true(large.lower == own.lower * unit && large.upper == own.upper * unit);
        }
    }
}

static void set_to(mpf_t x, real high, real low)
{
    mpf_set_d(x, (double)high);
    mpf_set_d(addend, (double)low);
    mpf_add(x, x, addend);
}

/* Of any size and either sign, and as far off as it may be; or not at all, with as many digits as high has, or few. */
static span draw_span(mpf_t truth)
{
    int kind = (int)any_between(0, 4);
    real size_here = (real)ldexp(1, (int)any_between(-12, 4)), x = any_real(-1, 1) * size_here;
    twin t = sum_of(x, kind == 0 ? 0 : any_real(-1, 1) * UNIT * x);
    span s = {t.high, t.low, 0};
    if (kind == 3) {
        s = (span){(real)(int)any_between(-9, 9) * size_here, 0, 0};
    }
    set_to(truth, s.high, s.low);
    if (kind == 2) {
        s.off = any_real(0, 8) * UNIT * UNIT * size(x);
        mpf_set_d(addend, (double)(any_between(-1, 1) < 0 ? -s.off : s.off));
        mpf_add(truth, truth, addend);
    }
    return s;
}

/* The truth is no farther off than it says, but for the roundings of that; and high is the sum rounded. */
static void expect_within(span s, const mpf_t truth, int sharp)
{
    mpf_t off;
    mpf_init2(off, 2000);
    set_to(off, s.high, s.low);
    mpf_sub(off, off, truth);
    mpf_abs(off, off);
    mpf_set_d(addend, (double)s.off * (1 + 16 * (double)UNIT));
    assert_true(mpf_cmp(off, addend) <= 0);
    mpf_clear(off);
    assert_true(!sharp || s.high + s.low == s.high);
}

static void spans_know_how_far_they_are_off(void **state)
{
    (void)state;
    state_of_draws = 3;
    for (int k = 0; k < PAIRS; k++) {
        span a = draw_span(truth_a), b = draw_span(truth_b), r = span_plus(a, b, -1);
        mpf_sub(truth_r, truth_a, truth_b);
        expect_within(r, truth_r, 1);
        r = span_times(a, b);
        mpf_mul(truth_r, truth_a, truth_b);
        expect_within(r, truth_r, 1);
        if (b.off == 0) {
            r = a;
            span_gather(&r, (twin){b.high, b.low});
            mpf_add(truth_r, truth_a, truth_b);
            expect_within(r, truth_r, 0);
        }
    }
}

/* A sign that is told is that of all numbers that it may be. */
static void a_sign_is_certain(void **state)
{
    long told = 0, blurred = 0;
    (void)state;
    state_of_draws = 4;
    for (int k = 0; k < PAIRS; k++) {
        span s = draw_span(truth_a);
        int sign;
        s.off = k % 3 == 0 ? 0 : size(s.high) * (real)ldexp(1, (int)any_between(-8, 4));
        sign = span_sign(s);
        assert_true(sign == BLURRED ? s.off > 0 : sign == (s.high > 0) - (s.high < 0));
        assert_true(sign == BLURRED || s.off == 0 || s.off < size(s.high));
        told += sign != BLURRED;
        blurred += sign == BLURRED;
    }
    assert_true(told > PAIRS / 8 && blurred > PAIRS / 8);
}

/* Weights that are told are of one sign, and good to all digits of a point. */
static void weights_have_digits(void **state)
{
    long told = 0;
    (void)state;
    state_of_draws = 5;
    for (int k = 0; k < PAIRS; k++) {
        span r[DIM + 1];
        int n = 1 + k % (DIM + 1), good = 1;
        unsigned mask;
        real sum = 0;
        for (int i = 0; i < n; i++) {
            r[i] = (span){any_real(0.1, 1) * (real)(any_between(0, 16) < 1 ? -1 : 1), 0, 0};
            r[i].off = any_between(0, 2) < 1 ? 0 : UNIT * (real)ldexp(1, (int)any_between(-8, 2));
            sum += size(r[i].high);
        }
        for (int i = 0; i < n; i++) {
            good &= r[i].off <= UNIT / 4 * sum && (r[i].high > 0) == (r[0].high > 0);
        }
        mask = same_side(r, n);
        assert_int_equal(mask, good ? (1u << n) - 1 : 0);
        told += mask != 0;
    }
    assert_true(told > PAIRS / 8 && told < PAIRS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rough_rooms),
        cmocka_unit_test(what_rounding_took),
        cmocka_unit_test(the_length),
        cmocka_unit_test(the_pair_is_v),
        cmocka_unit_test(square_to_corners_far_away),
        cmocka_unit_test(weights_may_be_off),
        cmocka_unit_test(what_the_way_falls_short),
#if DIM == 3
        cmocka_unit_test(two_holes_are_closed),
#endif
        cmocka_unit_test(done_is_not_rough),
        cmocka_unit_test(headings_save_calls),
        cmocka_unit_test(a_glance_needs_no_frame),
#if DIM == 3
        cmocka_unit_test(a_fourth_corner_is_level),
#endif
#if DIM == 3
        cmocka_unit_test(hulls_are_told_at_the_door),
#endif
        cmocka_unit_test(axes_need_no_frame),
        cmocka_unit_test(skew_axes_need_no_frame),
        cmocka_unit_test(a_gap_needs_no_walk),
        cmocka_unit_test(a_gap_of_skew_boxes_is_exact),
        cmocka_unit_test(a_slope_of_roundings_is_seen),
        cmocka_unit_test(a_glance_sees_no_overflow),
        cmocka_unit_test(spans_know_how_far_they_are_off),
        cmocka_unit_test(a_sign_is_certain),
        cmocka_unit_test(weights_have_digits),
    };
    mpf_set_default_prec(2000);
    mpf_init(truth_a);
    mpf_init(truth_b);
    mpf_init(truth_r);
    mpf_init(addend);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
