/* SPDX-License-Identifier: MIT */
/* Round sets from inside: a variant is compiled in. Where the height of a difference is said to be the least nearby,
 * and how high curvature says that it is at least around there, is held against heights of 113 bits: no bracket would
 * show that the former is worse than it should be, and few pairs need all that the latter says. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>
#include "quad.h"
#include "splitmix.h"
#include "inside.h"

#define PAIRS 4000
#define TURNS_EACH 40 /* from each of them */

static uint64_t state_of_draws;

static double any_between(double least, double most)
{
    return least + (most - least) * ((double)(splitmix64(&state_of_draws) >> 11) / 0x1p53);
}

/* ---- pairs ---- */

static support_fn *const kinds[] = {pub(support_ellipsoid), pub(support_ball),     pub(support_box),
#if DIM == 3
                                    pub(support_cone),      pub(support_cylinder), pub(support_disc),
#endif
                                    pub(support_segment)};
#define KINDS (int)(sizeof kinds / sizeof *kinds)
#define SOLIDS (KINDS - 1) /* all but the segment */

static real numbers[2][2 * DIM];
static pose poses[2];
static shape shapes[2];
static search q;

static void draw_turn(real m[DIM * DIM])
{
#if DIM == 2
    double angle[2] = {any_between(-1, 1), any_between(-1, 1)}, l = sqrt(angle[0] * angle[0] + angle[1] * angle[1]);
    m[0] = m[3] = angle[0] / l;
    m[1] = -(m[2] = angle[1] / l);
#else
    double u[4], l = 0;
    for (int i = 0; i < 4; i++) {
        u[i] = any_between(-1, 1);
        l += u[i] * u[i];
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const int k = 3 - i - j;
            const double sign = (j - i + 3) % 3 == 1 ? -1 : 1;
            m[3 * i + j] =
                i == j ? 1 - 2 * (l - u[3] * u[3] - u[i] * u[i]) / l : 2 * (u[i] * u[j] + sign * u[k] * u[3]) / l;
        }
    }
#endif
}

/* b is turned as a is: to the bit, or but about the last axis, or to rounding of that. */
enum manner { UNLIKE, THE_SAME, COAXIAL, NEARLY };
static enum manner alike;

static void turn_alike(const real m[DIM * DIM], real turned[DIM * DIM])
{
    const double angle = any_between(-1, 1), l = sqrt(1 + angle * angle);
    const double tilt = alike == NEARLY ? any_between(-24, 24) * UNIT : 0;
    const double c = alike == COAXIAL ? 1 / l : 1, s = alike == COAXIAL ? angle / l : 0;
    for (int i = 0; i < DIM; i++) {
        const double x = m[DIM * i], y = m[DIM * i + 1], z = m[DIM * i + DIM - 1];
        turned[DIM * i] = (real)(x * c + y * s - z * tilt);
        turned[DIM * i + 1] = (real)(y * c - x * s);
        if (DIM == 3) {
            turned[DIM * i + DIM - 1] = (real)(z + x * tilt);
        }
    }
}

/* Two of these sets, turned, at most so far apart, from middle to middle; not both with corners. */
static void draw_pair(support_fn *a, support_fn *b, double apart)
{
    for (int k = 0; k < 2; k++) {
        shapes[k] = (shape){k ? b : a, numbers[k], &poses[k], 0};
        if (k && alike) {
            turn_alike(poses[0].m, poses[1].m);
        } else {
            draw_turn(poses[k].m);
        }
        for (int i = 0; i < 3; i++) {
            numbers[k][i] = any_between(0.1, 1);
        }
        if (shapes[k].support == pub(support_segment)) { /* near the last axis where it is to be that of both */
            for (int i = 0; i < 2 * DIM; i++) {
                numbers[k][i] = i % DIM < DIM - 1 && alike ? numbers[k][i % DIM] : any_between(-1, 1);
            }
        }
        for (int i = 0; i < DIM; i++) {
            poses[k].p[i] = any_between(-apart, apart) / 2;
        }
    }
}

static int are_cornered(support_fn *f) { return f == pub(support_box) || f == pub(support_segment); }

/* Of the first so many kinds. */
static void draw_pair_of(int many, int k, double apart)
{
    support_fn *const a = kinds[k % many], *b = kinds[k / many % many];
    draw_pair(a, are_cornered(a) && are_cornered(b) ? kinds[0] : b, apart);
}

static void draw_any_pair(int k, double apart) { draw_pair_of(KINDS, k, apart); }

/* ---- heights of 113 bits ---- */

static quad quad_length_of(const quad *x, int n)
{
    quad sum = 0;
    for (int i = 0; i < n; i++) {
        sum += x[i] * x[i];
    }
    return quad_sqrt(sum);
}

/* The height of the set along n times sign, as the search's frame has it, from the body's position. */
static quad height_of_set(int which, const quad n[DIM], int sign)
{
    const real *s = numbers[which], *m = poses[which].m;
    support_fn *const f = shapes[which].support;
    quad g[3] = {0}, sum = 0;
    for (int j = 0; j < DIM; j++) {
        for (int i = 0; i < DIM; i++) {
            g[j] += (quad)m[DIM * i + j] * n[i] * sign;
        }
    }
    if (f == pub(support_ball)) {
        return (quad)s[0] * quad_length_of(g, DIM);
    }
    if (f == pub(support_segment)) {
        quad ends[2] = {0};
        for (int i = 0; i < 2 * DIM; i++) {
            ends[i / DIM] += (quad)s[i] * g[i % DIM];
        }
        return ends[0] > ends[1] ? ends[0] : ends[1];
    }
    for (int i = 0; i < DIM; i++) {
        sum += (quad)s[i] * quad_abs(g[i]);
    }
    if (f == pub(support_box)) {
        return sum;
    }
#if DIM == 3
    const quad aside = quad_length_of(g, 2);
    if (f == pub(support_disc)) {
        return (quad)s[0] * aside;
    }
    if (f == pub(support_cylinder)) {
        return (quad)s[0] * aside + (quad)s[1] * quad_abs(g[2]);
    }
    if (f == pub(support_cone)) {
        const quad rim = (quad)s[0] * aside - (quad)s[1] * g[2], apex = (quad)s[1] * g[2];
        return rim > apex ? rim : apex;
    }
#endif
    for (int i = 0; i < DIM; i++) {
        g[i] *= (quad)s[i];
    }
    return quad_length_of(g, DIM);
}

/* That of A - B, in the frame. */
static quad height_along_way(const quad n[DIM])
{
    quad h = height_of_set(0, n, 1) + height_of_set(1, n, -1);
    for (int i = 0; i < DIM; i++) {
        h -= ((quad)poses[1].p[i] - (quad)poses[0].p[i]) * n[i];
    }
    return h * (quad)q.d.scale;
}

/* n turned by t across, not brought to length 1. */
static void turned_by(const bent *b, const double t[ACROSS], quad n[DIM])
{
    for (int i = 0; i < DIM; i++) {
        n[i] = (quad)b->n.c[i];
        for (int j = 0; j < ACROSS; j++) {
            n[i] += (quad)t[j] * (quad)b->e[j].c[i];
        }
    }
}

/* ---- the tests ---- */

static bulk of_both;
static bent least;

/* Where the height is the least near the line of centres, or near any way; 0: that is not found. */
static int find_dip(int anywhere)
{
    vec n;
    q.d.calls = 0;
    if (!open_cold(&q, &shapes[0], &shapes[1], 0) || !know_bulk(&of_both, &q.d, &shapes[0], &shapes[1])) {
        return 0;
    }
    if (alike) {
        join_alike(&of_both);
    }
    EACH(n.c[i] = anywhere ? (real)any_between(-1, 1) : q.d.c.c[i]);
    return find_least(&of_both, mul(n, 1 / length(n)), NULL, &least);
}

/* A turn by at most so much: anywhere, or along an edge that n is on and hardly off it. */
static void draw_turn_across(double far, double t[ACROSS])
{
    for (int j = 0; j < ACROSS; j++) {
        t[j] = any_between(-far, far) / ACROSS;
    }
#if DIM == 3
    if (least.rows > 0 && any_between(0, 1) < 0.5) {
        const double *d = least.d[0], l = sqrt(d[0] * d[0] + d[1] * d[1]), on = any_between(-far, far) / 2;
        const double off = on * on * any_between(-4, 4);
        t[0] = (-d[1] * on + (size(off) < far / 2 ? off : 0) * d[0]) / l;
        t[1] = (d[0] * on + (size(off) < far / 2 ? off : 0) * d[1]) / l;
    }
#endif
}

/* Along no way nearby is the height of a unit vector less. */
static void check_that_it_is_least(void)
{
    quad n[DIM];
    turned_by(&least, (const double[2]){0, 0}, n);
    const quad here = height_along_way(n) / quad_length_of(n, DIM);
    for (int i = 0; i < TURNS_EACH; i++) {
        double t[ACROSS];
        draw_turn_across(pow(10, any_between(-8, -3)), t);
        turned_by(&least, t, n);
        assert_true(height_along_way(n) / quad_length_of(n, DIM) - here > -(quad)(256 * UNIT));
    }
}

/* Whether the point that shares make is right above the origin. */
static int is_point_above(void)
{
    vertex p;
    assert_true(ask(&q.d, mul(least.n, -1), &p));
    share_out(&of_both, &least, &p);
    p.w = corner_of(&q.d, p.x, p.y);
    return length(sub(p.w, mul(least.n, dot(p.w, least.n)))) < 1e-10;
}

static void it_is_the_least_nearby(void **state)
{
    long found = 0, exact = 0;
    (void)state;
    state_of_draws = 1;
    for (int k = 0; k < PAIRS; k++) {
        draw_any_pair(k, 4);
        if (find_dip(k % 2)) {
            check_that_it_is_least();
            found++;
            exact += is_point_above();
        }
    }
    printf("the least nearby: found %ld of %d, %ld right above the origin\n", found, PAIRS, exact);
    assert_true(found > PAIRS * 998 / 1000 && exact >= found * 999 / 1000);
}

/* Ellipsoids that are all but balls, or all but share their middles, are about as high along all ways, and any sets in
 * these along all around an edge: n is brought to rest from any of them. */
static void it_is_found_where_all_ways_are_alike(void **state)
{
    long found = 0, edged = 0;
    (void)state;
    state_of_draws = 19;
    for (int k = 0; k < 2 * PAIRS; k++) {
        draw_pair(kinds[0], k % 2 ? kinds[k / 2 % KINDS] : kinds[0], pow(10, any_between(-6, 0)));
        for (int i = 0; i < 2 - k % 2; i++) {
            const double apart = pow(10, any_between(-6, 0));
            for (int j = 1; j < DIM; j++) {
                numbers[i][j] = (real)((double)numbers[i][0] * (1 + apart * any_between(0, 1)));
            }
        }
        if (find_dip(1)) {
            check_that_it_is_least();
            *(k % 2 ? &edged : &found) += 1;
        }
    }
    printf("all ways are alike: found %ld, and %ld of any sets, of %d\n", found, edged, PAIRS);
    assert_true(found > PAIRS * 999 / 1000 - 1 && edged > PAIRS * 999 / 1000 - 1);
}

#if DIM == 3
/* Where a cone's edge seems to meet another: it is a curve, and many miss each other. */
static void it_is_found_beside_edges_that_miss(void **state)
{
    long found = 0;
    (void)state;
    state_of_draws = 23;
    for (int k = 0; k < PAIRS; k++) {
        draw_pair(pub(support_cone), kinds[1 + k % (KINDS - 1)], 0.5);
        if (find_dip(k % 3 > 0)) {
            check_that_it_is_least();
            found++;
        }
    }
    printf("edges that miss: found %ld of %d\n", found, PAIRS);
    assert_true(found > PAIRS * 997 / 1000);
}
#endif

/* What curvature says of heights up to so far from there, an error as large as is said taken off, where cones' edges
 * give such a share of their bow for a kink. */
static quad height_by_curvature(const double t[ACROSS], double far, double share)
{
    quad h = height_along_way((const quad[3]){(quad)least.n.c[0], (quad)least.n.c[1], (quad)least.n.c[DIM - 1]});
    quad square = 0;
    h -= (quad)least.height_off;
    for (int i = 0; i < ACROSS; i++) {
        square += (quad)t[i] * (quad)t[i];
        h += (quad)least.slope[i] * (quad)t[i];
        for (int j = 0; j <= i; j++) {
            const quad both = (quad)t[i] * (quad)t[j] * (i == j ? 1 : 2) / 2;
            const quad bow = (quad)least.bow.c[i][j] - (quad)share * (quad)least.part.c[i][j];
            const quad kink = (quad)least.kink.c[i][j] + (quad)share * (quad)least.rim.c[i][j];
            h += bow * both / (quad)(1 + least.sway * far) + kink * both / (quad)far;
        }
    }
    return h - (quad)least.slope_off * quad_sqrt(square) - (quad)(least.bow_off + least.kink_off / far) * square;
}

/* How far above that heights are, over the square of how far the turn is, the least of many; never below it. */
static quad least_above_curvature(void)
{
    quad nearest = 1;
    for (int i = 0; i < TURNS_EACH; i++) {
        double t[ACROSS];
        const double far = pow(10, any_between(i % 2 ? -8 : -3, 0));
        quad n[DIM], above;
        draw_turn_across(far, t);
        turned_by(&least, t, n);
        above = height_along_way(n) - height_by_curvature(t, far, any_between(0, 1));
        assert_true(above >= 0);
        nearest = above / (quad)(far * far) < nearest ? above / (quad)(far * far) : nearest;
    }
    return nearest;
}

static void it_is_as_high_as_curvature_says(void **state)
{
    long told = 0, slants = 0;
    quad nearest = 1;
    (void)state;
    state_of_draws = 2;
    for (int k = 0; k < PAIRS; k++) {
        draw_any_pair(k, 2);
        if (find_dip(k % 2)) {
            const quad above = least_above_curvature();
            nearest = above < nearest ? above : nearest;
            told++;
            slants += least.slants != 0;
        }
    }
    printf("as curvature says: %ld, of which %ld on a cone's edge; nearest %.2g\n", told, slants, (double)nearest);
    assert_true(told > PAIRS * 8 / 10 && (DIM == 2 || slants > 20) && nearest < 1e-6);
}

#if DIM == 3
/* The same where an axis of one is the other's, to rounding or to the bit: limbs that are alike count as one, and what
 * that is off is charged. */
static void limbs_that_are_alike_are_one(void **state)
{
    static support_fn *const with_axes[] = {pub(support_cylinder), pub(support_disc), pub(support_segment)};
    static const enum manner manners[] = {THE_SAME, COAXIAL, NEARLY};
    long found = 0, joined = 0, exact = 0;
    (void)state;
    state_of_draws = 15;
    for (int k = 0; k < PAIRS; k++) {
        alike = manners[k % 3];
        draw_pair(with_axes[k % 3], with_axes[k / 3 % 2], pow(10, any_between(-1, 0.6)));
        const int told = find_dip(k / 2 % 2);
        alike = UNLIKE;
        joined += of_both.joined > 0;
        if (told) {
            check_that_it_is_least();
            least_above_curvature();
            found++;
            exact += is_point_above();
        }
    }
    printf("alike: %ld of %d joined, %ld found, %ld right above the origin\n", joined, PAIRS, found, exact);
    assert_true(joined > PAIRS * 8 / 10 && found > PAIRS * 9 / 10 && exact >= found * 999 / 1000);
}
#endif

#if DIM == 3
/* Heights are bowed enough around the least for a dip to prove that it is one. */
static int is_bowed_enough(void)
{
    const dip f = {.bow = least.bow,
                   .kink = least.kink,
                   .part = least.part,
                   .rim = least.rim,
                   .rimmed = least.slants != 0,
                   .bow_off = least.bow_off,
                   .kink_off = least.kink_off,
                   .sway = least.sway};
    return bow_within(&f, NEAREST) > least.height;
}

/* Cones deep in each other: the least lies on a cone's edge, as a rule, and hardly more than along that it is bowed. */
static void edges_of_cones_are_bowed_enough(void **state)
{
    long slants = 0, bowed = 0;
    (void)state;
    state_of_draws = 9;
    for (int k = 0; k < PAIRS; k++) {
        draw_pair(pub(support_cone), pub(support_cone), 0.3);
        if (find_dip(1) && least.slants && least.height > CLEAR) {
            slants++;
            bowed += is_bowed_enough();
        }
    }
    printf("cones in each other: %ld on a cone's edge, %ld bowed enough\n", slants, bowed);
    assert_true(slants > PAIRS / 8 && bowed > slants * 98 / 100);
}
#endif

/* The lowest of the dips that are found from here and there, by its height. */
static real lowest_dip_seen(void)
{
    real lowest = REAL_MAX;
    for (int turn = 0; turn < TURNS_EACH; turn++) {
        vec n;
        bent b;
        EACH(n.c[i] = (real)any_between(-1, 1));
        if (find_least(&of_both, mul(n, 1 / length(n)), NULL, &b)) {
            lowest = smaller(height_of_bulk(&of_both, b.n), lowest);
        }
    }
    return lowest;
}

/* Where an ellipsoid within says that no way out is shorter than a dip, none is found; and it does as a rule where both
 * are ellipsoids, wherever they are. */
static void no_way_is_shorter_than_told(void **state)
{
    long overlaps = 0, told = 0, edged = 0, others = 0, round = 0, round_told = 0;
    (void)state;
    state_of_draws = 11;
    for (int k = 0; k < 4 * PAIRS; k++) {
        const int are_round = k % 4 == 0;
        if (are_round) {
            draw_pair(kinds[0], kinds[0], 1);
        } else {
            draw_any_pair(k / 4 + k, pow(10, any_between(-3, 0.3)));
        }
        for (int i = 0; i < 2; i++) {
            numbers[i][k % 3] /= k % 5 == 0 ? 30 : 1; /* flat ones and long ones */
        }
        if (!find_dip(k % 2) || !(least.height > CLEAR)) {
            continue;
        }
        overlaps++;
        round += are_round;
        const real lowest = lowest_dip_seen();
        others += lowest < least.height - 256 * (real)UNIT;
        if (!is_least_of_all(&least, room_of_ball(&of_both, &least), 64 * (real)UNIT, (real)0.125)) {
            continue;
        }
        told++;
        round_told += are_round;
        edged += least.edges != 0;
        assert_false(is_least_of_all(&least, 256 * (real)UNIT, 0, 1)); /* by hardly any room */
        assert_true(lowest > least.height - 256 * (real)UNIT);
    }
    printf(
        "no way shorter: told of %ld of %ld, %ld of which are not the lowest; on edges %ld; of ellipsoids %ld of %ld\n",
        told, overlaps, others, edged, round_told, round);
    assert_true(overlaps > PAIRS && others > overlaps / 8 && told > overlaps / 4 && round_told > round * 8 / 10);
}

/* Ellipsoids next to balls, their middles all but shared: no way is lower than what their own ellipsoid says of all, by
 * whichever dip it is told. */
static void all_ways_are_as_high_as_told(void **state)
{
    long told = 0, aside = 0;
    (void)state;
    state_of_draws = 13;
    for (int k = 0; k < 4 * PAIRS; k++) {
        const double off = pow(10, any_between(-9, -6)), apart = off * pow(10, any_between(-2, 1));
        draw_pair(kinds[0], kinds[0], apart);
        for (int i = 0; i < 2; i++) {
            const double radius = any_between(0.1, 1);
            for (int j = 0; j < DIM; j++) {
                numbers[i][j] = radius * (1 + any_between(0, off));
            }
        }
        if (!find_dip(1)) {
            continue;
        }
        const real over = 64 * (real)UNIT; /* what heights are charged for roundings, in a search */
        const real all = height_of_all(&of_both, &least, room_of_ball(&of_both, &least), least.height - over, over);
        if (!(all > 0)) {
            continue;
        }
        const real lowest = lowest_dip_seen();
        told++;
        aside += lowest < least.height - 512 * (real)UNIT;
        assert_true(all <= lowest);
    }
    printf("all ways: told of %ld, by another dip than the lowest of %ld\n", told, aside);
    assert_true(told > PAIRS && aside > PAIRS / 8);
}

/* A ball is a point and a radius, and walks as these do where the other has corners, or is one as well. */
static int is_ball_by(int i, int j)
{
    support_fn *const f = shapes[j].support;
    return shapes[i].support == pub(support_ball) && (f == pub(support_ball) || are_cornered(f));
}

/* The gap of round bodies is found by one corner more than the first, as a rule. */
static void a_gap_needs_no_walk(void **state)
{
    long apart = 0, at_once = 0;
    (void)state;
    state_of_draws = 3;
    for (int k = 0; k < 4 * PAIRS; k++) {
        result r = {0};
        draw_any_pair(k, 4);
        assert_int_equal(pub(distance)(&shapes[0], &shapes[1], NULL, &r), GJK_OK);
        if (!(r.lower > 0) || is_ball_by(0, 1) || is_ball_by(1, 0)) {
            continue;
        }
        apart++;
        at_once += r.steps == 2 && r.supports == 4;
    }
    printf("gaps: %ld of %ld at once\n", at_once, apart);
    assert_true(apart > PAIRS && at_once > apart * 99 / 100);
}

#if DIM == 3
/* A dip above 0 is no way out of bodies that are apart, nor is any other of these: how far they are apart is told all
 * the same. */
static void no_way_out(void **state)
{
    long reached = 0, close_by = 0;
    (void)state;
    state_of_draws = 5;
    for (int k = 0; k < PAIRS; k++) {
        result r = {0}, s = {0};
        draw_any_pair(k, 3);
        for (int i = 0; i < 2; i++) {
            numbers[i][k % 3] /= 16; /* flat ones and long ones */
        }
        pub(distance)(&shapes[0], &shapes[1], NULL, &r);
        for (int i = 0; i < 8 && !(r.value > 0 && r.value < 2e-3); i++) { /* brought to a gap of 1e-3 */
            pub(penetration)(&shapes[0], &shapes[1], NULL, &s);
            for (int j = 0; j < DIM; j++) {
                poses[1].p[j] -= (s.value - 1e-3) * s.normal[j];
            }
            pub(distance)(&shapes[0], &shapes[1], NULL, &r);
        }
        if (!(r.value > 0 && r.value < 2e-3)) {
            continue;
        }
        reached++;
        close_by += find_dip(0) && least.height > 0;
        assert_int_equal(pub(penetration)(&shapes[0], &shapes[1], NULL, &s), GJK_OK);
        assert_true(s.lower > 0 && s.lower <= r.upper && r.lower <= s.upper);
    }
    printf("apart: %ld, of which %ld beside a dip above 0\n", reached, close_by);
    assert_true(close_by > 0);
}

/* Overlaps of a thousandth, which no point of the line of centres shows: by a point near the dip, with few corners,
 * also where one body's edge is sharp; and with no more than are allowed. */
static void a_shallow_overlap_needs_few_corners(void **state)
{
    long reached = 0, few = 0, allowed = 0;
    (void)state;
    state_of_draws = 7;
    for (int k = 0; k < 2 * PAIRS; k++) {
        result r = {0}, s = {0};
        options o = {.size = sizeof o, .max_steps = 3 + (uint32_t)(k / (SOLIDS * SOLIDS)) % 8};
        draw_pair_of(SOLIDS, k, 2);
        for (int i = 0; i < 8 && !(s.value > -2e-3 && s.value < -5e-4); i++) {
            pub(penetration)(&shapes[0], &shapes[1], NULL, &s);
            for (int j = 0; j < DIM; j++) {
                poses[1].p[j] -= (s.value + 1e-3) * s.normal[j];
            }
        }
        assert_true(pub(penetration)(&shapes[0], &shapes[1], NULL, &s) >= 0);
        if (!(s.value > -2e-3 && s.value < -5e-4)) {
            continue;
        }
        reached++;
        assert_int_equal(pub(intersect)(&shapes[0], &shapes[1], NULL, &r), GJK_DECIDED);
        assert_true(r.upper < 0 && r.lower <= s.upper && s.lower <= r.upper);
        few += r.steps <= 3;
        assert_true(pub(intersect)(&shapes[0], &shapes[1], &o, &r) >= 0);
        assert_true((uint32_t)r.steps <= o.max_steps);
        allowed += r.upper < 0;
    }
    printf("shallow: %ld of %ld by three corners at most; %ld by as many as allowed\n", few, reached, allowed);
    assert_true(reached > PAIRS && few * 1000 > reached * 682);
}

#endif

#if DIM == 3
/* The least height seen on a circle: among many, and then nearer and nearer to the best. */
static real least_seen_on(const circle *c)
{
    arrow best = c->node[0].n;
    for (int i = 0; i < 200; i++) {
        const double off = i < 100 ? 4 : ldexp(1, -(i - 100) / 4);
        const arrow n = unit2(add2(best, (arrow){(real)any_between(-off, off), (real)any_between(-off, off)}));
        if (node_at(c, n).height < node_at(c, best).height) {
            best = n;
        }
    }
    return node_at(c, best).height;
}

/* Edges and one disc: bodies with flat ones and long ones among them, or turned alike. */
static void draw_edges_and_disc(int k)
{
    support_fn *const edged[2] = {pub(support_box), pub(support_segment)};
    support_fn *const disced[2] = {pub(support_cylinder), pub(support_disc)};
    support_fn *const a = disced[k & 1], *const b = edged[k >> 1 & 1];
    alike = (k >> 2) % 4 == 0 ? (enum manner)(1 + (k >> 4) % 3) : 0;
    draw_pair(k & 64 ? a : b, k & 64 ? b : alike && k & 128 ? disced[k >> 8 & 1] : a, pow(10, any_between(-3, 0.3)));
    for (int i = 0; i < 2; i++) {
        numbers[i][k % 3] /= k % 5 == 0 ? 30 : 1;
    }
}

/* Where circles say that no way out is shorter than their floor, none is, by 113 bits; no circle is held to be higher
 * than it is; and they tell it as a rule. */
static void no_way_is_lower_than_circles_say(void **state)
{
    long overlaps = 0, told = 0, apart = 0, drawn = 0;
    double widest = 0;
    (void)state;
    state_of_draws = 17;
    for (int k = 0; k < 4 * PAIRS; k++) {
        static circles all;
        bent b;
        draw_edges_and_disc(k);
        const int found = find_dip(k % 3 == 0);
        if (!draw_circles(&all, &of_both)) {
            continue;
        }
        drawn++;
        real lowest = all.least;
        for (int i = 0; i < all.count; i++) {
            lowest = smaller(least_seen_on(&all.at[i]), lowest);
        }
        apart += !(lowest > 0);
        const circles before = all;
        for (int i = 0; i < all.count; i++) { /* each alone */
            all = before;
            all.at[0] = before.at[i];
            all.count = 1;
            assert_int_not_equal(are_circles_high(&all, least_seen_on(&all.at[0]) + all.off / 4), AROUND);
        }
        overlaps += lowest > CLEAR;
        if (!find_least_of_all(&of_both, found ? &least : NULL, &b)) {
            continue;
        }
        told += lowest > CLEAR;
        const real seen = lowest_dip_seen();
        lowest = smaller(height_of_bulk(&of_both, b.n), lowest);
        widest = fmax(widest, (double)((lowest - b.floor) / all.off));
        quad n[DIM], square = 0;
        for (int i = 0; i < DIM; i++) {
            n[i] = (quad)b.n.c[i];
            square += n[i] * n[i];
        }
        assert_true(lowest > 0 && b.floor <= seen && (quad)b.floor <= height_along_way(n) / quad_sqrt(square));
        for (int i = 0; i < TURNS_EACH; i++) {
            square = 0;
            for (int j = 0; j < DIM; j++) {
                n[j] = (quad)any_between(-1, 1) * (i % 2 ? 1 : 0x1p-20) + (i % 2 ? 0 : (quad)b.n.c[j]);
                square += n[j] * n[j];
            }
            assert_true((quad)b.floor <= height_along_way(n) / quad_sqrt(square));
        }
    }
    alike = 0;
    printf("circles: told of %ld of %ld overlaps, %ld apart, of %ld; at most %.2f of what is charged off\n", told,
           overlaps, apart, drawn, widest);
    assert_true(overlaps > 2 * PAIRS && apart > PAIRS / 2 && told * 1000 > overlaps * 991 && widest <= 1.6);
}
/* Bodies round about one axis, side by side or all but on it, turned alike as above or head over heels. */
static void draw_about_one_axis(int k)
{
    support_fn *const about[] = {pub(support_cone), pub(support_cylinder), pub(support_ellipsoid),
                                 pub(support_disc), pub(support_segment),  pub(support_ball)};
    const double aside = k % 3 ? pow(10, any_between(-17, -1)) : any_between(0, 0.5), along = any_between(-0.8, 0.8);
    const double angle = any_between(-4, 4), by[3] = {aside * cos(angle), aside * sin(angle), along};
    alike = (enum manner)(1 + k % 4 % 3);
    draw_pair(about[k / 4 % 3], about[k / 12 % 6], 0);
    for (int i = 0; i < 2; i++) {
        if (shapes[i].support == pub(support_ellipsoid)) {
            numbers[i][1] = numbers[i][0];
            numbers[i][2] = k % 5 ? numbers[i][2] : (real)((double)numbers[i][0] * (1 + pow(10, any_between(-4, -1))));
        }
    }
    for (int i = 0; i < DIM; i++) {
        const real *m = &poses[0].m[DIM * i];
        poses[1].p[i] += (real)(by[0] * (double)m[0] + by[1] * (double)m[1] + by[2] * (double)m[2]);
        for (int j = 1; j < DIM && k / 72 % 2; j++) {
            poses[1].m[DIM * i + j] *= -1;
        }
    }
}

/* How high a piece of a meridian is at least, as seen: all along, and then nearer and nearer to the best. */
static real least_seen_on_piece(const circle *c)
{
    const arrow from = c->node[0].n, to = c->node[1].n;
    double best = 0.5;
    real lowest = REAL_MAX;
    for (int i = 0; i < 200; i++) {
        const double off = i < 100 ? 1 : ldexp(1, -(i - 100) / 4);
        const double t = fmin(1, fmax(0, i < 100 ? i / 99. : best + any_between(-off, off)));
        const real here = node_at(c, unit2(add2(mul2(from, (real)(1 - t)), mul2(to, (real)t)))).height;
        if (here < lowest) {
            lowest = here;
            best = t;
        }
    }
    return lowest;
}

/* A way: any, or near n, or the same after a turn about a's axis. */
static void draw_way_about(const vec *about, int i, quad n[DIM])
{
    const double off = i % 3 ? pow(10, any_between(-9, -2)) : 1, angle = any_between(-4, 4);
    const double c = i % 3 < 2 ? 1 : cos(angle), s = i % 3 < 2 ? 0 : sin(angle);
    double in[3] = {0};
    for (int j = 0; j < 3; j++) {
        for (int r = 0; r < 3; r++) {
            in[j] += (double)about->c[r] * (double)poses[0].m[3 * r + j];
        }
    }
    const double turned[3] = {in[0] * c - in[1] * s, in[0] * s + in[1] * c, in[2]};
    for (int r = 0; r < 3; r++) {
        n[r] = (quad)any_between(-off, off);
        for (int j = 0; j < 3 && i % 3; j++) {
            n[r] += (quad)turned[j] * (quad)poses[0].m[3 * r + j];
        }
    }
}

/* Where a meridian says that no way out is shorter than its floor, none is, by 113 bits; no piece of it is held to be
 * higher than it is; and it tells it as a rule. */
static void no_way_is_lower_than_a_meridian_says(void **state)
{
    long overlaps = 0, told = 0, level = 0;
    double widest = 0;
    (void)state;
    state_of_draws = 19;
    for (int k = 0; k < 4 * PAIRS; k++) {
        static circles all;
        bent b = {.floor = 0};
        draw_about_one_axis(k);
        q.d.calls = 0;
        if (!open_cold(&q, &shapes[0], &shapes[1], 0) || !know_bulk(&of_both, &q.d, &shapes[0], &shapes[1])) {
            continue;
        }
        join_alike(&of_both);
        if (of_both.limbs == 0) {
            continue;
        }
        assert_true(draw_meridian(&all, &of_both));
        real lowest = all.least;
        const circles before = all;
        for (int i = 0; i < before.count; i++) { /* each alone */
            const real seen = least_seen_on_piece(&before.at[i]);
            lowest = smaller(seen, lowest);
            all = before;
            all.at[0] = before.at[i];
            all.count = 1;
            assert_int_not_equal(are_circles_high(&all, seen + all.off / 4), AROUND);
        }
        overlaps += lowest > 64 * all.off;
        if (!find_least_of_all(&of_both, NULL, &b)) {
            continue;
        }
        told += lowest > 64 * all.off;
        level += b.level;
        if (!draw_circles(&all, &of_both)) { /* else these have told it */
            lowest = smaller(height_of_bulk(&of_both, b.n), lowest);
            widest = fmax(widest, (double)((lowest - b.floor) / before.off));
        }
        for (int i = 0; i < 3 * TURNS_EACH; i++) {
            quad n[DIM];
            draw_way_about(&b.n, i, n);
            assert_true((quad)b.floor <= height_along_way(n) / quad_length_of(n, DIM));
        }
    }
    alike = 0;
    printf("meridians: told of %ld of %ld overlaps, %ld all but on the axis; at most %.2f of what is charged off\n",
           told, overlaps, level, widest);
    assert_true(overlaps > PAIRS && told * 1000 > overlaps * 999 && level > PAIRS / 2 && widest <= 1.3);
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_the_least_nearby),
        cmocka_unit_test(it_is_found_where_all_ways_are_alike),
        cmocka_unit_test(it_is_as_high_as_curvature_says),
#if DIM == 3
        cmocka_unit_test(it_is_found_beside_edges_that_miss),
        cmocka_unit_test(limbs_that_are_alike_are_one),
        cmocka_unit_test(edges_of_cones_are_bowed_enough),
        cmocka_unit_test(no_way_is_lower_than_circles_say),
        cmocka_unit_test(no_way_is_lower_than_a_meridian_says),
#endif
        cmocka_unit_test(no_way_is_shorter_than_told),
        cmocka_unit_test(all_ways_are_as_high_as_told),
        cmocka_unit_test(a_gap_needs_no_walk),
#if DIM == 3
        cmocka_unit_test(no_way_out),
        cmocka_unit_test(a_shallow_overlap_needs_few_corners),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
