/* SPDX-License-Identifier: MIT */
/* Two boxes: how deep, and whether they meet, against the exact truth. Boxes of all sorts: in line or turned by next to
 * nothing, flat, long, one in the other, on one spot, touching, near by, under maps that shear and mirror, of any unit.
 * Most depths are told by the boxes' facets, which shows in that no step was taken; most signs by their axes, in two
 * steps at most. How many of each sort is printed, and held to a share where it is to be all of them. */
#include "faults.h"
#include "pairs.h"
#include "settle.h"

/* In u * scale. */
#define VALUE_ERROR 2.0
#define WIDTH 16.0
#define NORMAL_ERROR 16.0
#define POINT_ERROR 16.0
#define UNIT_ERROR 4.0 /* in u */

#define BOX_PAIRS 1500 /* of each sort */

enum turned { IN_LINE, SPUN, TILTED, YAWED, UNLIKE, CROSSED, LOOSE, TURNS };
static const char *const turned_name[TURNS] = {"in line", "turned", "tilted", "yawed", "sheared", "crossed", "loose"};

enum placed { CONCENTRIC, WITHIN, AT_FACE, ON_GRID, ANYWHERE, PLACES };
static const char *const placed_name[PLACES] = {"on one spot", "one in the other", "at a face", "on a grid",
                                                "anywhere"};

static exact best;
static truth nearly;
static pair p;
static faults found;
static long at;
static const char *sort;
static double worst_error, worst_width, worst_gap;

static double scale(void) { return (double)nearly.scale + (double)p.a.shape.radius + (double)p.b.shape.radius; }

static double far_out(void)
{
    double most = 0;
    for (int i = 0; i < DIM; i++) {
        most = fmax(most, fmax(fabs((double)p.a.pose.p[i]), fabs((double)p.b.pose.p[i])));
    }
    return most;
}

static double in_u(quad x) { return (double)(x / (quad)scale()) / U; }

static void hold(const char *law, const V(result) * r, int holds, double by)
{
    if (holds || !note_fault(&found, law, by)) {
        return;
    }
    print_error("%s boxes, pair %ld, %s: %s (%.3g)\n  value %.17g in %.17g .. %.17g; truth %.17g, steps %d\n  ",
                VARIANT, at, sort, law, by, (double)r->value, (double)r->lower, (double)r->upper, (double)nearly.lower,
                r->steps);
    print_case(stderr, "intersect", &p.a, &p.b);
}

/* ---- drawing ---- */

/* Axes go to axes, either way. */
static void turn_squarely(draws *d, body *b)
{
    int at_axis[3] = {0, 1, 2}, k = below(d, DIM);
    at_axis[0] = k;
    at_axis[k] = 0;
    for (int i = 0; i < DIM; i++) {
        for (int j = 0; j < DIM; j++) {
            b->pose.m[i * DIM + j] = (real)(at_axis[i] == j ? (below(d, 2) ? 1 : -1) : 0);
        }
    }
}

/* b's map is a's, turned by so much; about one of a's axes, or any. */
static void turn_from(draws *d, double angle, int about)
{
    double small[DIM * DIM];
    rotation(d, angle, small);
#if DIM == 3
    if (about >= 0) {
        int i = (about + 1) % 3, j = (about + 2) % 3;
        double l = sqrt(1 + angle * angle);
        for (int k = 0; k < 9; k++) {
            small[k] = k % 4 == 0;
        }
        small[4 * i] = small[4 * j] = 1 / l;
        small[3 * i + j] = -angle / l;
        small[3 * j + i] = angle / l;
    }
#else
    (void)about;
#endif
    for (int i = 0; i < DIM; i++) {
        for (int j = 0; j < DIM; j++) {
            double sum = 0;
            for (int k = 0; k < DIM; k++) {
                sum += (double)p.a.pose.m[i * DIM + k] * small[k * DIM + j];
            }
            p.b.pose.m[i * DIM + j] = (real)sum;
        }
    }
}

/* A map that is a turn, or an axis-to-axis one, only to so many digits, of another size at times. */
static void loosen(draws *d, body *b)
{
    double by = below(d, 2) ? 1 : between(d, 0.4, 3), off = magnitude(d, -14, -3);
    for (int i = 0; i < DIM * DIM; i++) {
        b->pose.m[i] = (real)(by * ((double)b->pose.m[i] + off * between(d, -1, 1)));
    }
}

static void draw_maps(draws *d, enum turned how)
{
    int about = below(d, DIM);
    turn_squarely(d, &p.a);
    turn_squarely(d, &p.b);
    if (how != IN_LINE && below(d, 3)) {
        turn(d, &p.a, 100);
    }
    switch (how) {
    case SPUN:
        turn(d, &p.b, 100);
        break;
    case TILTED:
        turn_from(d, magnitude(d, -18, -2), -1);
        break;
    case YAWED:
        turn_from(d, below(d, 2) ? magnitude(d, -18, -2) : between(d, 0.01, 3), about);
        break;
    case UNLIKE:
        draw_affine(d, &p.a);
        draw_affine(d, &p.b);
        if (below(d, 2)) {
            memcpy(p.b.pose.m, p.a.pose.m, sizeof p.b.pose.m);
        }
        break;
    case LOOSE:
        if (below(d, 2)) {
            turn(d, &p.b, 100);
        }
        loosen(d, &p.a);
        loosen(d, &p.b);
        break;
    default:
        break;
    }
    memset(p.a.pose.p, 0, sizeof p.a.pose.p);
    memset(p.b.pose.p, 0, sizeof p.b.pose.p);
}

static void draw_halves(draws *d, body *b)
{
    int kind = below(d, 6);
    for (int i = 0; i < DIM; i++) {
        double x = kind == 0   ? 0.5
                   : kind == 1 ? 0.25 * (1 + below(d, 4))
                   : kind == 2 ? magnitude(d, -4, 1)
                               : between(d, 0.2, 2);
        b->half[i] = (real)(kind == 5 && below(d, 6) == 0 ? 0 : x);
    }
}

/* Puts b at a place of a's own frame. */
static void put(const double *x)
{
    for (int i = 0; i < DIM; i++) {
        double sum = 0;
        for (int j = 0; j < DIM; j++) {
            sum += (double)p.a.pose.m[i * DIM + j] * x[j];
        }
        p.b.pose.p[i] = (real)sum;
    }
}

static void place_b(draws *d, enum placed where)
{
    double x[DIM] = {0}, dir[DIM];
    int k = below(d, DIM);
    switch (where) {
    case WITHIN:
        for (int i = 0; i < DIM; i++) {
            x[i] = (double)p.a.half[i] * between(d, -1, 1);
        }
        break;
    case ON_GRID:
        for (int i = 0; i < DIM; i++) {
            x[i] = below(d, 3) == 0 ? (double)p.a.half[i] + (double)p.b.half[i] : 0.25 * (below(d, 7) - 3);
        }
        break;
    default:
        break;
    }
    put(x);
    if (where == AT_FACE) {
        axis_of(below(d, 2) ? &p.a : &p.b, k, dir);
        stand_off(&p, dir, -magnitude(d, -17, 0));
        for (int i = 0; i < DIM; i++) {
            axis_of(&p.a, i, dir);
            if (i != k) move(&p.b, dir, (double)p.a.half[i] * between(d, -1, 1));
        }
    }
    if (where == ANYWHERE) {
        unit(d, dir);
        stand_off(&p, dir, -magnitude(d, -6, 1));
    }
}

#if DIM == 3
/* The map after a turn about z, and after one about x by an eighth. */
static void set_crossed(body *b, const double *m, double angle)
{
    const double l = sqrt(1 + angle * angle), c = sqrt(0.5);
    const double turned[9] = {1 / l, -angle / l * c, angle / l * c, angle / l, c / l, -c / l, 0, c, c};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            double sum = 0;
            for (int k = 0; k < 3; k++) {
                sum += m[3 * i + k] * turned[3 * k + j];
            }
            b->pose.m[3 * i + j] = (real)sum;
        }
    }
}

/* Two rods across each other at a small angle, one with an edge on an edge of the other: what is across their long axes
 * is the way out. */
static void cross_rods(draws *d)
{
    double m[9], angle = magnitude(d, -5, -1), depth = magnitude(d, -4, 0) / 10;
    body *both[2] = {&p.a, &p.b};
    rotation(d, below(d, 2) ? 100 : 0, m);
    for (int k = 0; k < 2; k++) {
        both[k]->half[0] = (real)(between(d, 1, 4) / angle);
        both[k]->half[1] = both[k]->half[2] = (real)between(d, 0.3, 1);
        set_crossed(both[k], m, k ? angle : 0);
    }
    depth = ((double)p.a.half[1] + (double)p.b.half[1]) * (sqrt(2) - depth);
    for (int i = 0; i < 3; i++) {
        p.b.pose.p[i] = (real)(m[3 * i + 2] * depth);
    }
}
#endif

static void draw_boxes(draws *d, enum turned how, enum placed where)
{
    double by = 1;
    start_body(&p.a, BOX);
    start_body(&p.b, BOX);
    draw_halves(d, &p.a);
    draw_halves(d, &p.b);
    if (below(d, 4) == 0) {
        memcpy(p.b.half, p.a.half, sizeof p.a.half);
    }
    draw_maps(d, how);
    place_b(d, where);
#if DIM == 3
    if (how == CROSSED) {
        cross_rods(d);
    }
#endif
    if (below(d, 8) == 0) {
        by = power_of_ten(below(d, 21) - 10);
    }
    if (below(d, 32) == 0) {
        by = ldexp(1, (sizeof(real) == 8 ? 320 : 40) * (below(d, 2) ? 1 : -1));
    }
    scale_pair(&p, by);
    if (below(d, 8) == 0) {
        for (int i = 0; i < DIM; i++) {
            double x = between(d, -10, 10) * by;
            p.a.pose.p[i] = (real)((double)p.a.pose.p[i] + x);
            p.b.pose.p[i] = (real)((double)p.b.pose.p[i] + x);
        }
    }
    bind_pair(&p);
    p.a.shape.radius = below(d, 8) == 0 ? (real)(by * between(d, 0, 1)) : 0;
    p.b.shape.radius = below(d, 8) == 0 ? (real)(by * between(d, 0, 1)) : 0;
}

/* ---- the laws ---- */

static void check_points(const V(result) * r)
{
    const quad most = (quad)(POINT_ERROR * U * (scale() + far_out()));
    quad gap = 0, off_a = stands_off_body(&best, &p.a, r->point_a), off_b = stands_off_body(&best, &p.b, r->point_b);
    for (int i = 0; i < DIM; i++) {
        quad x = quad_abs((quad)r->point_a[i] - (quad)r->point_b[i] + (quad)r->value * (quad)r->normal[i]);
        gap = x > gap ? x : gap;
    }
    worst_gap = fmax(worst_gap, (double)(gap / most) * POINT_ERROR);
    hold("the points are in their boxes", r, off_a <= most && off_b <= most, in_u(off_a > off_b ? off_a : off_b));
    hold("the points are apart by the depth along the normal", r, gap <= most, in_u(gap));
}

/* Whether it was told without a step. */
static int check(const V(result) * r)
{
    quad n[DIM], along, width = (quad)r->upper - (quad)r->lower, error = off_truth(&nearly, (quad)r->value);
    hold("the bracket holds", r, (quad)r->lower <= nearly.upper && nearly.lower <= (quad)r->upper,
         in_u(quad_abs(off_truth(&nearly, (quad)r->lower)) + quad_abs(off_truth(&nearly, (quad)r->upper))));
    hold("the value is in the bracket", r, r->lower <= r->value && r->value <= r->upper, 0);
    if (r->steps > 0 || nearly.lower > 0 || !(scale() * U >= (double)REAL_MIN)) {
        return 0; /* the search's answers have tests of their own */
    }
    worst_error = fmax(worst_error, in_u(error));
    worst_width = fmax(worst_width, in_u(width));
    hold("the value is near", r, in_u(error) <= VALUE_ERROR, in_u(error));
    hold("the bracket is narrow", r, in_u(width) <= WIDTH, in_u(width));
    for (int i = 0; i < DIM; i++) {
        n[i] = (quad)r->normal[i];
    }
    hold("the normal is unit", r, quad_abs(norm(n) - 1) <= (quad)(UNIT_ERROR * U), (double)norm(n) - 1);
    along = -along_normal(&p.a, r->normal, 1) - along_normal(&p.b, r->normal, -1);
    hold("the normal leads out", r, in_u(nearly.lower - along) <= NORMAL_ERROR, in_u(nearly.lower - along));
    hold("the normal realises lower", r, in_u((quad)r->lower - along) <= (double)UNIT_ERROR,
         in_u((quad)r->lower - along));
    check_points(r);
    return 1;
}

static void depths_of_boxes(void **state)
{
    (void)state;
    for (int how = 0; how < TURNS; how++) {
        for (int where = 0; where < PLACES; where++) {
            long told = 0, meet = 0;
            worst_error = worst_width = worst_gap = 0;
            sort = turned_name[how];
            for (at = 0; at < BOX_PAIRS / PLACES; at++) {
                draws d = draws_from(1, (uint64_t)(how * PLACES + where), (uint64_t)at);
                V(result) r;
                memset(&r, 0, sizeof r);
                draw_boxes(&d, (enum turned)how, (enum placed)where);
                find_truth(&nearly, &p.a, &p.b, 1);
                assert_true(settle(&nearly, &best, &p.a, &p.b));
                assert_true(V(penetration)(&p.a.shape, &p.b.shape, NULL, &r) >= 0);
                told += check(&r);
                meet += !(nearly.lower > 0);
            }
            print_message("%-8s %-16s: %4ld meet, %4ld told by their facets; error %.2f, width %.1f, points %.1f\n",
                          turned_name[how], placed_name[where], meet, told, worst_error, worst_width, worst_gap);
            assert_true(how == UNLIKE || where > WITHIN || 10 * told >= 7 * meet);
        }
    }
    print_faults(&found, "boxes");
    assert_int_equal(found.count, 0);
}

/* ---- whether they meet ---- */

/* Apart or into each other by so much, where they are nearest. */
static void bring_near(draws *d)
{
    double n[DIM], gap = magnitude(d, -17, 0) * (below(d, 2) ? 1 : -1);
    V(result) r;
    assert_true(V(penetration)(&p.a.shape, &p.b.shape, NULL, &r) >= 0);
    for (int i = 0; i < DIM; i++) {
        n[i] = (double)r.normal[i];
    }
    move(&p.b, n, gap - (double)r.value);
    bind_pair(&p);
}

static quad between_points(const V(result) * r)
{
    quad gap[DIM];
    for (int i = 0; i < DIM; i++) {
        gap[i] = (quad)r->point_a[i] - (quad)r->point_b[i];
    }
    return norm(gap);
}

/* Rounding hides nothing of it, and no radius. */
static int is_clear(void)
{
    quad off = nearly.lower > 0 ? nearly.lower : -nearly.upper;
    return in_u(off) > 256 && p.a.shape.radius == 0 && p.b.shape.radius == 0;
}

/* Whether it was told by the axes: in two steps at most. */
static int check_sign(const V(result) * r)
{
    const quad most = (quad)(POINT_ERROR * U * (scale() + far_out()));
    quad n[DIM], along, off_a, off_b, off, above;
    int by_axes;
    hold("the bracket holds", r, (quad)r->lower <= nearly.upper && nearly.lower <= (quad)r->upper,
         in_u(quad_abs(off_truth(&nearly, (quad)r->lower)) + quad_abs(off_truth(&nearly, (quad)r->upper))));
    if (!(scale() * U >= (double)REAL_MIN)) {
        return 0;
    }
    hold("the sign is told", r, nearly.lower > 0 ? r->lower > 0 : r->upper <= 0, in_u(nearly.lower));
    for (int i = 0; i < DIM; i++) {
        n[i] = (quad)r->normal[i];
    }
    hold("the normal is unit", r, quad_abs(norm(n) - 1) <= (quad)(UNIT_ERROR * U), (double)norm(n) - 1);
    along = -along_normal(&p.a, r->normal, 1) - along_normal(&p.b, r->normal, -1);
    hold("the normal realises lower", r, in_u((quad)r->lower - along) <= (double)UNIT_ERROR,
         in_u((quad)r->lower - along));
    off_a = stands_off_body(&best, &p.a, r->point_a);
    off_b = stands_off_body(&best, &p.b, r->point_b);
    off = off_a > off_b ? off_a : off_b;
    /* what the walk tells of an overlap is no better than its bracket, and as good as its maps */
    by_axes = r->steps <= 2 && sort != turned_name[UNLIKE];
    off -= by_axes ? 0 : positive((quad)fmin(0, (double)r->upper) - (quad)r->lower);
    hold("the points are in their boxes", r, off <= most, in_u(off));
    above = between_points(r) - positive((quad)r->upper);
    hold("the points are within upper", r, !by_axes || above <= (r->upper > 0 ? most : 0), in_u(above));
    return r->steps <= 2;
}

/* Sizes go from the halves into the map, or back, as far as the numbers reach. */
static void shift_size(draws *d, body *b)
{
    const int most = sizeof(real) == 8 ? 1000 : 120, shift = below(d, 2 * most) - most;
    for (int i = 0; i < DIM; i++) {
        b->half[i] = (real)ldexp((double)b->half[i], -shift);
        if (!(b->half[i] <= REAL_MAX / 4)) {
            b->half[i] = REAL_MAX / 4;
        }
    }
    for (int i = 0; i < DIM * DIM; i++) {
        b->pose.m[i] = (real)ldexp((double)b->pose.m[i], shift);
        if (!(fabs((double)b->pose.m[i]) <= (double)REAL_MAX / 4)) {
            b->pose.m[i] = 0;
        }
    }
    bind(b);
}

static void signs_of_boxes(void **state)
{
    (void)state;
    memset(&found, 0, sizeof found);
    for (int how = 0; how < TURNS; how++) {
        for (int where = 0; where < PLACES; where++) {
            long told[2] = {0, 0}, all[2] = {0, 0};
            sort = turned_name[how];
            for (at = 0; at < BOX_PAIRS / PLACES; at++) {
                draws d = draws_from(2, (uint64_t)(how * PLACES + where), (uint64_t)at);
                V(result) r;
                memset(&r, 0, sizeof r);
                draw_boxes(&d, (enum turned)how, (enum placed)where);
                if (below(&d, 2)) {
                    bring_near(&d);
                }
                if (at % 4 == 3) {
                    shift_size(&d, &p.a);
                    shift_size(&d, at % 8 == 7 ? &p.a : &p.b);
                }
                find_truth(&nearly, &p.a, &p.b, 1);
                assert_true(settle(&nearly, &best, &p.a, &p.b));
                assert_true(V(intersect)(&p.a.shape, &p.b.shape, NULL, &r) >= 0);
                told[nearly.lower > 0] += check_sign(&r) && is_clear();
                all[nearly.lower > 0] += is_clear();
            }
            print_message("%-8s %-16s: of %4ld that meet %4ld told by their axes, of %4ld apart %4ld\n",
                          turned_name[how], placed_name[where], all[0], told[0], all[1], told[1]);
            const int share = how == UNLIKE ? 0 : how == LOOSE ? 6 : 8;
            assert_true(10 * told[0] >= share * all[0] && 10 * told[1] >= share * all[1]);
        }
    }
    print_faults(&found, "signs of boxes");
    assert_int_equal(found.count, 0);
}

/* Where a radius keeps the cores apart whose bounds nearly touch: how deep they are is how far apart, to the bit. */
static void apart_by_a_radius(void **state)
{
    long apart = 0;
    (void)state;
    for (at = 0; at < 4 * BOX_PAIRS; at++) {
        draws d = draws_from(3, 0, (uint64_t)at);
        V(result) r, deep;
        memset(&r, 0, sizeof r);
        memset(&deep, 0, sizeof deep);
        draw_boxes(&d, SPUN, (enum placed)below(&d, PLACES));
        (below(&d, 2) ? &p.a : &p.b)->shape.radius = (real)between(&d, 0.01, 0.3);
        bring_near(&d);
        r.status = V(distance)(&p.a.shape, &p.b.shape, NULL, &r);
        deep.status = V(penetration)(&p.a.shape, &p.b.shape, NULL, &deep);
        if (!(r.lower > 0)) {
            continue;
        }
        apart++;
        if (r.status != deep.status || r.value != deep.value || r.lower != deep.lower || r.upper != deep.upper) {
            print_case(stderr, "penetration", &p.a, &p.b);
            fail_msg("%s: distance %.17g in %.17g .. %.17g, penetration %.17g in %.17g .. %.17g", VARIANT,
                     (double)r.value, (double)r.lower, (double)r.upper, (double)deep.value, (double)deep.lower,
                     (double)deep.upper);
        }
    }
    assert_true(apart > BOX_PAIRS);
}

/* ---- numbers that underflow on the way ---- */

/* The least number above 0. */
#define LEAST ((double)REAL_MIN * (double)REAL_EPSILON)

/* A cube whose map is the axes', times size, but for one entry. */
static void spell_cube(body *b, double size, int entry, double other, double radius)
{
    memset(b, 0, sizeof *b);
    b->kind = BOX;
    for (int i = 0; i < DIM; i++) {
        b->half[i] = 1;
        b->pose.m[i * DIM + i] = (real)size;
    }
    if (entry >= 0) {
        b->pose.m[entry] = (real)other;
    }
    bind(b);
    b->shape.radius = (real)radius;
}

static void expect(const char *name, quad least, quad most)
{
    V(result) r;
    sort = name;
    nearly.lower = least;
    nearly.upper = most;
    assert_true(V(penetration)(&p.a.shape, &p.b.shape, NULL, &r) >= 0);
    hold("the bracket holds", &r, (quad)r.lower <= most && least <= (quad)r.upper, 0);
    assert_true(V(intersect)(&p.a.shape, &p.b.shape, NULL, &r) >= 0);
    hold("intersect's bracket holds", &r, (quad)r.lower <= most && least <= (quad)r.upper, 0);
}

/* The same of the pair as it stands, by exact truth. */
static void expect_truth(const char *name)
{
    find_truth(&nearly, &p.a, &p.b, 1);
    assert_true(settle(&nearly, &best, &p.a, &p.b));
    expect(name, nearly.lower, nearly.upper);
}

static void numbers_that_underflow(void **state)
{
    const int aside = DIM * (DIM - 1); /* what the first axis adds to the last coordinate */
    (void)state;
    memset(&found, 0, sizeof found);
    spell_cube(&p.a, 2, aside, LEAST, 0); /* all but on top of each other, deeper by the least number */
    spell_cube(&p.b, 2, -1, 0, 0);
    p.b.pose.p[DIM - 1] = 4;
    expect("an entry of the map", -(quad)LEAST, -(quad)LEAST);
    { /* far below all else of its map, it leans a box out of line, and makes it that much deeper */
        const int wide = sizeof(real) == 8, of_map = wide ? 600 : 60, of_half = wide ? 300 : 20;
        const double lean = wide ? 0x1p-500 : 0x1p-100;
        spell_cube(&p.a, ldexp(1, of_map), 1, lean, 0);
        spell_cube(&p.b, 1, -1, 0, 0);
        for (int i = 0; i < DIM; i++) {
            p.a.half[i] = (real)ldexp(1, of_half);
            p.b.half[i] = (real)ldexp(1, of_half + of_map);
        }
        p.b.pose.p[0] = (real)ldexp(2, of_half + of_map);
        bind_pair(&p);
        expect("an entry far below the others", -(quad)ldexp(lean, of_half), -(quad)ldexp(lean, of_half));
    }
    spell_cube(&p.a, 1024, -1, 0, 0); /* apart by 64 of it */
    spell_cube(&p.b, 1024, -1, 0, 0);
    p.b.pose.m[0] = (real)(-128 * LEAST);
    p.b.pose.m[1] = p.b.pose.m[DIM] = 1024;
    p.b.pose.m[DIM + 1] = 0;
    p.b.pose.p[0] = 2048;
    p.b.pose.p[1] = 1536;
    expect("an entry of the map, apart", 64 * (quad)LEAST, 64 * (quad)LEAST);
    spell_cube(&p.a, 1, -1, 0, 0);
    spell_cube(&p.b, 1, -1, 0, LEAST);
    p.b.pose.p[DIM - 1] = 2;
    expect("a radius", -(quad)LEAST, -(quad)LEAST);
#if DIM == 3
    for (int i = 0; i < 400; i++) { /* turned by an angle whose square is none */
        const int wide = sizeof(real) == 8, bits_of = wide ? -538 : -75;
        const double e = ldexp(1 + (i % 20) / 20.0, bits_of + i / 20 - 10);
        spell_cube(&p.a, 1, -1, 0, 0);
        spell_cube(&p.b, 1, 1, -e, 0);
        p.b.pose.m[3] = (real)e;
        p.b.pose.p[2] = (real)(2 - ldexp(70, wide ? -52 : -23));
        expect_truth("a small angle");
    }
#endif
    for (int i = 3; i < 12; i++) { /* a rod of subnormal halves under a huge map, beside another of everyday numbers */
        const double size = ldexp(LEAST, sizeof(real) == 8 ? 1000 : 100);
        spell_cube(&p.a, size / LEAST, -1, 0, 0);
        spell_cube(&p.b, 1, -1, 0, 0);
        for (int k = 0; k < DIM; k++) {
            const int log_of_half = k == 0 ? i : 2;
            p.a.half[k] = (real)ldexp(LEAST, log_of_half);
            p.b.half[k] = (real)ldexp(size, log_of_half);
            p.b.pose.p[k] = (real)(k == 0 ? ldexp(1.5 * size, i) : 9 * size);
        }
        bind(&p.a);
        bind(&p.b);
        expect("a huge map", (quad)size, (quad)(1.5 * size));
    }
    print_faults(&found, "boxes");
    assert_int_equal(found.count, 0);
}

/* ---- axes that are short by some roundings ---- */

/* A box of a rotation times that, and a point in it: which of the two is a's is told. */
static void spell_short(double share, int point_first)
{
    body *of = point_first ? &p.b : &p.a, *point = point_first ? &p.a : &p.b;
    spell_cube(of, share, -1, 0, 0);
    spell_cube(point, 1, -1, 0, 0);
    of->pose.m[0] = of->pose.m[DIM + 1] = (real)(0.6 * share);
    of->pose.m[DIM] = (real)(0.8 * share);
    of->pose.m[1] = -of->pose.m[DIM];
    for (int i = 0; i < DIM; i++) {
        point->half[i] = 0;
        of->pose.p[i] = (real)(0.05 * (i + 1));
    }
    bind(point);
}

static void axes_short_by_roundings(void **state)
{
    (void)state;
    memset(&found, 0, sizeof found);
    for (int i = 500; i <= 2000; i += 50) {
        for (int first = 0; first < 2; first++) {
            spell_short(1 - i * (double)U, first);
            expect_truth("short axes");
        }
    }
    print_faults(&found, "boxes");
    assert_int_equal(found.count, 0);
}

/* In line with the frame, in another unit, a power of two away: the same bits, also where sizes are wild there. */
static void in_line_in_another_unit(void **state)
{
    const int most = sizeof(real) == 8 ? 600 : 60;
    (void)state;
    for (at = 0; at < 300; at++) {
        draws d = draws_from(31, 0, (uint64_t)at);
        const int power = below(&d, 2 * most) - most;
        V(result) r[2];
        memset(r, 0, sizeof r);
        start_body(&p.a, BOX);
        start_body(&p.b, BOX);
        for (int i = 0; i < DIM; i++) {
            p.a.half[i] = (real)between(&d, 0.1, 2);
            p.b.half[i] = (real)between(&d, 0.1, 2);
            p.b.pose.p[i] = (real)between(&d, -1, 1);
        }
        for (int k = 0; k < 2; k++) {
            bind_pair(&p);
            assert_true(V(penetration)(&p.a.shape, &p.b.shape, NULL, &r[k]) >= 0);
            scale_pair(&p, ldexp(1, power));
        }
        assert_true((double)r[0].lower * ldexp(1, power) == (double)r[1].lower);
        assert_true((double)r[0].value * ldexp(1, power) == (double)r[1].value);
        assert_true((double)r[0].upper * ldexp(1, power) == (double)r[1].upper);
    }
}

/* Whether boxes meet whose axes are off length 1, as those of a map in float are, or how far apart they are, in another
 * unit by the halves or by the map, a power of two away: the same bits, near contact and far from it. */
static void loose_in_another_unit(void **state)
{
    const int most = sizeof(real) == 8 ? 200 : 20;
    long met = 0, apart = 0;
    (void)state;
    for (at = 0; at < 3000; at++) {
        draws d = draws_from(33, 0, (uint64_t)at);
        const int power = below(&d, 2 * most) - most, way = below(&d, 3);
        V(result) r[2], s[2];
        memset(r, 0, sizeof r);
        memset(s, 0, sizeof s);
        start_body(&p.a, BOX);
        start_body(&p.b, BOX);
        draw_halves(&d, &p.a);
        draw_halves(&d, &p.b);
        draw_maps(&d, LOOSE);
        place_b(&d, below(&d, 2) ? AT_FACE : ANYWHERE);
        bind_pair(&p);
        for (int k = 0; k < 2; k++) {
            assert_true(V(intersect)(&p.a.shape, &p.b.shape, NULL, &r[k]) >= 0);
            assert_true(V(distance)(&p.a.shape, &p.b.shape, NULL, &s[k]) >= 0);
            for (int i = 0; i < DIM; i++) {
                p.a.half[i] = (real)ldexp((double)p.a.half[i], way == 1 ? -power : power);
                p.b.half[i] = (real)ldexp((double)p.b.half[i], way == 2 ? 0 : power);
                p.b.pose.p[i] = (real)ldexp((double)p.b.pose.p[i], power);
            }
            for (int i = 0; i < DIM * DIM; i++) {
                p.a.pose.m[i] = (real)ldexp((double)p.a.pose.m[i], way == 1 ? 2 * power : 0);
                p.b.pose.m[i] = (real)ldexp((double)p.b.pose.m[i], way == 2 ? power : 0);
            }
            bind_pair(&p);
        }
        assert_true(ldexp((double)r[0].lower, power) == (double)r[1].lower);
        assert_true(ldexp((double)r[0].upper, power) == (double)r[1].upper);
        assert_true(memcmp(r[0].normal, r[1].normal, sizeof r[0].normal) == 0);
        assert_int_equal(r[0].steps, r[1].steps);
        assert_true(ldexp((double)s[0].lower, power) == (double)s[1].lower);
        assert_true(ldexp((double)s[0].value, power) == (double)s[1].value);
        assert_true(ldexp((double)s[0].upper, power) == (double)s[1].upper);
        assert_int_equal(s[0].steps, s[1].steps);
        met += r[0].upper < 0;
        apart += r[0].lower > 0;
    }
    print_message("loose, in another unit: %ld meet, %ld are apart\n", met, apart);
    assert_true(met > 500 && apart > 500);
}

#if DIM == 3
/* Gaps of about 2^-20, which float all but blurs: told by one corner, as a rule, and to the last places. */
static void near_contact(void **state)
{
    long near = 0, at_once = 0;
    (void)state;
    for (at = 0; at < 1000; at++) {
        draws d = draws_from(34, 0, (uint64_t)at);
        V(options) tight = default_options();
        V(result) r, s, t;
        start_body(&p.a, BOX);
        start_body(&p.b, BOX);
        draw_halves(&d, &p.a);
        draw_halves(&d, &p.b);
        draw_maps(&d, at % 2 ? LOOSE : TILTED);
        place_b(&d, ANYWHERE);
        bind_pair(&p);
        for (int i = 0; i < 8; i++) {
            assert_true(V(distance)(&p.a.shape, &p.b.shape, NULL, &r) >= 0);
            if (!(r.lower > 0) || ((double)r.value > 0x1p-21 && (double)r.value < 0x1p-19)) {
                break;
            }
            for (int j = 0; j < DIM; j++) {
                p.b.pose.p[j] -= (real)(((double)r.value - 0x1p-20) * (double)r.normal[j]);
            }
        }
        if (!(r.lower > 0 && (double)r.value > 0x1p-21 && (double)r.value < 0x1p-19)) {
            continue;
        }
        near++;
        at_once += r.steps <= 1;
        tight.tight = 1;
        assert_int_equal(V(distance)(&p.a.shape, &p.b.shape, &tight, &s), GJK_OK);
        assert_true(r.status == GJK_OK && r.lower <= s.upper && s.lower <= r.upper);
        assert_int_equal(V(penetration)(&p.a.shape, &p.b.shape, NULL, &t), GJK_OK);
        assert_true(t.lower == r.lower && t.value == r.value && t.upper == r.upper);
#if VARIANT_FLOAT
        assert_true(fabs((double)r.value - (double)s.value) <= 4 * U * (double)s.value);
        assert_true((double)r.upper - (double)r.lower <= 16 * U * (double)s.value);
#endif
    }
    print_message("near contact: %ld, by one corner %ld\n", near, at_once);
    assert_true(near > 200);
    assert_true(at_once * 10 > near * 6);
}
#endif

/* Slack as large as a number is takes all that is known of the depth, and leaves a number. */
static void slack_beyond_all(void **state)
{
    V(options) o;
    V(result) r;
    (void)state;
    memset(&o, 0, sizeof o);
    memset(&r, 0, sizeof r);
    o.size = sizeof o;
    start_body(&p.a, BOX);
    start_body(&p.b, BOX);
    for (int i = 0; i < DIM; i++) {
        p.a.half[i] = p.b.half[i] = 1;
    }
    p.b.pose.m[0] = p.b.pose.m[DIM + 1] = (real)0.8;
    p.b.pose.m[1] = (real)0.6;
    p.b.pose.m[DIM] = (real)-0.6;
    p.b.pose.p[0] = (real)0.3;
    bind_pair(&p);
    for (int k = 0; k < 2; k++) {
        p.a.shape.radius = (real)(0.25 * k);
        o.slack = REAL_MAX;
        for (int i = 0; i < 20; i++, o.slack = (real)((double)o.slack * 0.75)) {
            assert_true(V(penetration)(&p.a.shape, &p.b.shape, &o, &r) >= 0);
            assert_true(r.lower >= -REAL_MAX && r.lower <= r.value && r.value <= r.upper);
        }
    }
    spell_cube(&p.a, 1, -1, 0, 0); /* what is proven by curvature before any facet has been asked */
    spell_cube(&p.b, 1, -1, 0, 0);
    p.a.half[1] = (real)0.5;
    p.b.half[0] = 0;
    p.b.half[1] = 4;
    p.b.pose.p[1] = (real)0.125;
    bind_pair(&p);
    for (o.slack = 1; o.slack < 1000000; o.slack *= 4) {
        assert_true(V(penetration)(&p.a.shape, &p.b.shape, &o, &r) >= 0);
        assert_true(r.lower <= -1 && -1 <= r.upper);
    }
}

/* A bracket that is too wide for a number, in the frame, is not as narrow as a tolerance asks, which is too large there
 * as well. */
static void slack_beyond_tolerance(void **state)
{
    V(options) o;
    V(result) r;
    (void)state;
    memset(&o, 0, sizeof o);
    o.size = sizeof o;
    o.rel_tol = (real)1e-4;
    for (int power = 0; power < 100; power++) {
        const double size = ldexp(1, -power);
        start_body(&p.a, SEGMENT);
        start_body(&p.b, BOX);
        for (int i = 0; i < DIM; i++) {
            p.a.v[0][i] = (real)(i == 1 ? -size : i == 0 ? size : 0);
            p.a.v[1][i] = -p.a.v[0][i];
            p.b.half[i] = (real)(i == 0 ? size : size / 2);
        }
        p.b.pose.m[0] = p.b.pose.m[DIM + 1] = 0;
        p.b.pose.m[1] = (real)0.413;
        p.b.pose.m[DIM] = (real)-0.413;
        p.b.pose.p[0] = (real)(size / 2);
        bind_pair(&p);
        p.b.shape.radius = (real)size;
        o.slack = REAL_MAX;
        const int status = V(penetration)(&p.a.shape, &p.b.shape, &o, &r);
        assert_true(status != GJK_OK || (double)r.upper - (double)r.lower <= 1e-3 * size);
    }
}

/* A box on itself, of a side that is next to nothing beside the others, under a large map: in the frame that side has
 * few digits, and no depth is to be told by what is left of them. */
static void side_of_few_digits(void **state)
{
    const real side = (real)(VARIANT_FLOAT ? 0x1.4e1b2ap-100 : 0x1.d640cf2a9bf16p-777);
    const real broad = (real)(VARIANT_FLOAT ? 0x1.250a58p-25 : 0x1.cp-113),
               map = (real)(VARIANT_FLOAT ? 0x1p53 : 0x1p378);
    (void)state;
    for (int k = 0; k < DIM; k++) {
        V(box) box;
        V(pose) pose = {{0}, {0}};
        V(result) r;
        for (int i = 0; i < DIM; i++) {
            box.half[i] = i == k ? side : broad;
            pose.m[(DIM + 1) * i] = map;
        }
        const V(shape) a = {V(support_box), &box, &pose, 0};
        assert_true(V(penetration)(&a, &a, NULL, &r) >= 0);
        assert_true(r.lower <= -2 * side * map && -2 * side * map <= r.upper);
    }
}

/* The same where the map makes the side smaller, and how deep they are is between two numbers. */
static void depth_between_numbers(void **state)
{
    const real side = (real)(VARIANT_FLOAT ? 0x1.5b6342p-100 : 0x1.5b6341063bdc8p-753);
    const real broad = (real)(VARIANT_FLOAT ? 0x1p20 : 0x1.64p87), map = (real)(VARIANT_FLOAT ? 0x1p-40 : 0x1p-306);
    (void)state;
    for (int k = 0; k < DIM; k++) {
        V(box) box;
        V(pose) pose = {{0}, {0}};
        for (int i = 0; i < DIM; i++) {
            box.half[i] = i == k ? side : broad;
            pose.m[(DIM + 1) * i] = map;
        }
        for (int n = 0; n < 12; n++, box.half[k] /= 2) {
            const quad truth_here = -2 * (quad)box.half[k] * (quad)map;
            const V(shape) a = {V(support_box), &box, &pose, 0};
            V(result) r;
            assert_true(V(penetration)(&a, &a, NULL, &r) >= 0);
            assert_true((quad)r.lower <= truth_here && truth_here <= (quad)r.upper);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(side_of_few_digits),
        cmocka_unit_test(depth_between_numbers),
        cmocka_unit_test(depths_of_boxes),
        cmocka_unit_test(signs_of_boxes),
        cmocka_unit_test(apart_by_a_radius),
        cmocka_unit_test(numbers_that_underflow),
        cmocka_unit_test(axes_short_by_roundings),
        cmocka_unit_test(in_line_in_another_unit),
        cmocka_unit_test(loose_in_another_unit),
#if DIM == 3
        cmocka_unit_test(near_contact),
#endif
        cmocka_unit_test(slack_beyond_all),
        cmocka_unit_test(slack_beyond_tolerance)
    };
    exact_start(&best);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
