/* SPDX-License-Identifier: MIT */
/* The expanding polytope and its proof from inside: a variant is compiled in, so that surfaces can be made that no pair
 * of shapes is known to lead to. Whatever rounding may say of who sees whom, the surface stays closed; what is proven
 * is held against the turns that it makes around the origin, counted with 113 bits. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>
#include "quad.h"
#include "splitmix.h"
#include "inside.h"

#define PI 3.14159265358979323846
#define MOST 64 /* tips */

/* ---- a polytope to work on ---- */

static usual_room room_of_all, as_it_was;
static search q;
static goal g;
static shape tips_themselves, nothing; /* a tip's x is its place, y is 0 */
static depth d;
static uint64_t state_of_draws;

static void draw_from(int number) { state_of_draws = (uint64_t)number; }

static uint64_t any_bits(void) { return splitmix64(&state_of_draws); }

static int any_below(int n) { return (int)(any_bits() % (uint64_t)n); }

static real any_between(real least, real most)
{
    return least + (most - least) * ((real)(any_bits() >> 11) / (real)0x1p53);
}

static vec any_vec(real most)
{
    vec r;
    for (int i = 0; i < DIM; i++) {
        r.c[i] = any_between(-most, most);
    }
    return r;
}

static vec any_unit(void)
{
    for (;;) {
        vec n = any_vec(1);
        if (dot(n, n) <= 1 && dot(n, n) > (real)0.01) {
            return mul(n, 1 / length(n));
        }
    }
}

/* Of length 2^-binades. */
static vec any_short(int binades) { return mul(any_unit(), ldexp(1, -binades)); }

/* No facets, room for so many tips, which are known without rounding or only to it. */
static void begin(int tips, int exact)
{
    memset(&room_of_all, 0, sizeof room_of_all);
    memset(&q, 0, sizeof q);
    memset(&g, 0, sizeof g);
    memset(&d, 0, sizeof d);
    q.d.doubt = 64 * UNIT;
    q.lower = -REAL_MAX;
    g.exact = exact;
    d.q = &q;
    d.g = &g;
    d.a = &tips_themselves;
    d.b = &nothing;
    d.known[0] = outline_of(d.a);
    d.known[1] = outline_of(d.b);
    d.dropped.least = REAL_MAX;
    d.p = polytope_in(&room_of_all, (size_t)tips);
}

static tip tip_at(vec w)
{
    tip t = {w, axis(0, 0), w, axis(0, 0)};
    return t;
}

static void put_tip(vec w) { d.p.tip[d.p.tips++] = tip_at(w); }

/* A simplex with its middle there. */
static void put_simplex_at(vec middle, real size)
{
    vec sum = axis(0, 0);
    for (int k = 0; k < DIM; k++) {
        put_tip(add(middle, axis(k, size)));
        sum = sub(sum, axis(k, size));
    }
    put_tip(add(middle, sum));
    put_first(&d.p);
}

/* ---- what is true of a surface ---- */

/* The determinant of the facet's corners: above 0 where the origin is on its inner side. */
static quad volume(const facet *f)
{
    const real *a = d.p.tip[f->v[0]].w.c, *b = d.p.tip[f->v[1]].w.c;
#if DIM == 2
    return (quad)a[0] * (quad)b[1] - (quad)a[1] * (quad)b[0];
#else
    const real *c = d.p.tip[f->v[2]].w.c;
    quad sum = 0;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += (quad)c[i] * ((quad)a[j] * (quad)b[k] - (quad)a[k] * (quad)b[j]);
    }
    return sum;
#endif
}

/* The angle under which the origin sees the facet, in space the solid one (van Oosterom, Strackee 1983). */
static double angle(const facet *f)
{
    const vec a = d.p.tip[f->v[0]].w, b = d.p.tip[f->v[1]].w;
#if DIM == 2
    return atan2((double)volume(f), dot(a, b));
#else
    const vec c = d.p.tip[f->v[2]].w;
    double la = length(a), lb = length(b), lc = length(c);
    return 2 * atan2((double)volume(f), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
#endif
}

/* How often the facets go around the origin. */
static double turns(void)
{
    double sum = 0;
    for (int k = 0; k < d.p.facets; k++) {
        sum += angle(&d.p.facet[k]);
    }
    return sum / (DIM == 2 ? 2 * PI : 4 * PI);
}

/* Each seam is at a wall; or has one other side, which says the same of it. */
static void expect_closed(void)
{
    for (int at = 0; at < d.p.facets; at++) {
        assert_false(d.p.facet[at].gone);
        for (int i = 0; i < DIM; i++) {
            seam s = seam_of(&d.p, at, i);
            int others = 0;
            assert_true(s.v[0] >= 0 && s.v[0] < d.p.tips);
            if (s.next == WALL) {
                continue;
            }
            assert_true(s.next >= 0 && s.next < d.p.facets && s.next != at);
            for (int k = 0; k < DIM; k++) {
                seam other = seam_of(&d.p, s.next, k);
                others += other.next == at && meet_in(other, s);
            }
            assert_int_equal(others, 1);
        }
    }
}

/* How often the facets' seams pass from a tip to a tip, less how often back; in the plane, end at a tip less how often
 * they start there. */
typedef struct border {
    int count[MOST][MOST];
} border;

static void find_border(border *b)
{
    memset(b, 0, sizeof *b);
    for (int at = 0; at < d.p.facets; at++) {
        for (int i = 0; i < DIM; i++) {
            seam s = seam_of(&d.p, at, i);
            b->count[s.v[0]][DIM == 2 ? 0 : s.v[1]] += DIM == 2 && s.v[1] ? -1 : 1;
            b->count[DIM == 2 ? 0 : s.v[1]][s.v[0]] -= DIM == 3;
        }
    }
}

static int has_tip(const facet *f, int v)
{
    int r = 0;
    for (int i = 0; i < DIM; i++) {
        r |= f->v[i] == v;
    }
    return r;
}

/* Whether two tips have more than one edge between them. */
static int has_double_edge(void)
{
    static signed char seen[MOST][MOST];
    memset(seen, 0, sizeof seen);
    for (int at = 0; at < d.p.facets && DIM == 3; at++) {
        for (int i = 0; i < DIM; i++) {
            seam s = seam_of(&d.p, at, i);
            if (seen[s.v[0]][s.v[1]]++) {
                return 1;
            }
        }
    }
    return 0;
}

/* ---- growth ---- */

/* As it is now. */
static polytope copy_of_it(void)
{
    polytope p = polytope_in(&as_it_was, (size_t)d.p.most_tips);
    memcpy(&as_it_was, &room_of_all, sizeof as_it_was);
    p.tips = d.p.tips;
    p.facets = d.p.facets;
    return p;
}

/* It may have been placed to more digits. */
static void expect_same_but_for_digits(const facet *f, const facet *was)
{
    facet sharp = *was;
    if (was->rough && !f->rough) {
        sharpen_facet(&d.p, &sharp);
    }
    assert_memory_equal(f, &sharp, sizeof sharp);
}

static enum growth grow_to(facet *f, tip *t)
{
    polytope was = copy_of_it();
    facet from = *f;
    border before, after;
    find_border(&before);
    enum growth end = grow(&d.p, f, t);
    expect_closed();
    if (end == GROWN) {
        assert_int_equal(d.p.tips, was.tips + 1);
        assert_memory_equal(&d.p.tip[was.tips], t, sizeof *t);
        for (int k = 0; k < d.p.facets; k++) {
            assert_memory_not_equal(&d.p.facet[k], &from, sizeof from);
        }
        find_border(&after);
        assert_memory_equal(&after, &before, sizeof after);
    } else {
        assert_true(d.p.facets == was.facets && d.p.tips == was.tips);
        assert_memory_equal(d.p.tip, was.tip, (size_t)was.tips * sizeof(tip));
        for (int k = 0; k < d.p.facets; k++) {
            expect_same_but_for_digits(&d.p.facet[k], &was.facet[k]);
        }
    }
    return end;
}

/* Of a ball around there. */
static enum growth grow_toward_ball(vec middle, real radius)
{
    facet *f = lowest(&d.p);
    tip t = tip_at(add(middle, mul(f->n, radius)));
    return sees(&d.p, f, &t) ? grow_to(f, &t) : LOWERED;
}

static void put_ball(vec middle, real radius, int tips)
{
    put_simplex_at(middle, radius / 2);
    while (d.p.tips < tips && grow_toward_ball(middle, radius) == GROWN) {
    }
}

/* In a ball's polytope all tips are corners, and each facet is turned outward. */
static void grows_in_a_ball(void **state)
{
    (void)state;
    for (int n = 0; n < 40; n++) {
        draw_from(n);
        vec middle = any_vec((real)0.4);
        begin(MOST, n & 1);
        put_ball(middle, 1, MOST);
        assert_true(d.p.tips > 20);
        for (int k = 0; k < d.p.facets; k++) {
            const facet *f = &d.p.facet[k];
            real off = f->height - dot(f->n, middle);
            assert_true(off > 0 && off < 1 + 8 * UNIT);
            assert_true(f->height == least_height(&d.p, f, f->n));
        }
        assert_true(fabs(turns() - 1) < 1e-9);
    }
}

/* Whether the facet, by its tips, is one of that polytope's. */
static int is_in(const facet *f, const polytope *of)
{
    for (int k = 0; k < of->facets; k++) {
        int same_tips = 1;
        for (int i = 0; i < DIM; i++) {
            same_tips &= memcmp(&d.p.tip[f->v[i]], &of->tip[of->facet[k].v[i]], sizeof(tip)) == 0;
        }
        if (same_tips) {
            return 1;
        }
    }
    return 0;
}

/* Makes room, as the search would, between any heights; what stays is as it was. */
static void make_any_room(void)
{
    polytope was = copy_of_it();
    int dropped = d.dropped.facets;
    q.lower = -any_between(-1, 1);
    make_room(&d);
    assert_int_equal(d.dropped.facets - dropped, was.facets - d.p.facets);
    for (int k = 0; k < d.p.facets; k++) {
        assert_true(is_in(&d.p.facet[k], &was));
    }
    expect_closed();
}

/* What the newest tip was to take the place of is gone, as far as it is next to what is gone. */
static void expect_way_cleared(void)
{
    int newest = d.p.tips - 1;
    for (int k = 0; k < d.p.facets; k++) {
        for (int i = 0; i < DIM && has_tip(&d.p.facet[k], newest); i++) {
            seam s = seam_of(&d.p, k, i);
            if (s.v[0] == newest || (DIM == 3 && s.v[1] == newest) || s.next == WALL) {
                continue;
            }
            assert_false(goes_too(&d.p, &d.p.facet[s.next], s, &d.p.tip[newest]));
        }
    }
}

/* Facets that are turned any way, at any height, see any corner: the surface is closed after each step, around what was
 * dropped as well, also where two tips have two edges between them. */
static void stays_closed(void **state)
{
    int grown = 0, not_grown = 0, doubled = 0, rooms = 0;
    (void)state;
    for (int n = 0; n < 200; n++) {
        draw_from(n);
        begin(8 + n % 30, 0);
        put_simplex_at(any_vec(1), 1);
        for (int step = 0; step < 60; step++) {
            tip t = tip_at(any_vec(2));
            facet *f = &d.p.facet[any_below(d.p.facets)];
            for (int k = 0; k < d.p.facets; k++) {
                d.p.facet[k].n = any_unit();
                d.p.facet[k].height = any_between(-1, 1);
            }
            f->height = -1; /* it may get lower */
            enum growth end = grow_to(f, &t);
            if (end == GROWN) {
                expect_way_cleared();
            }
            grown += end == GROWN;
            not_grown += end != GROWN;
            doubled += has_double_edge();
            if (d.p.tips == d.p.most_tips) {
                make_any_room();
                rooms += d.p.tips < d.p.most_tips;
            }
        }
    }
    printf("grown %d times, not %d, room made %d times, %d times an edge was double\n", grown, not_grown, rooms,
           doubled);
    assert_true(grown > 1000 && not_grown > 100 && rooms > 100);
    assert_true(DIM == 2 || doubled > 100);
}

/* A surface around the origin never gets lower: a corner that would make it so is noise. */
static void never_gets_lower(void **state)
{
    (void)state;
    for (int n = 0; n < 100; n++) {
        draw_from(n);
        begin(MOST, 0);
        put_ball(any_vec((real)0.1), 1, 20);
        facet *f = lowest(&d.p);
        tip t = tip_at(mul(f->n, f->height * any_between(0, (real)0.9)));
        assert_true(f->height > 0);
        assert_int_equal(grow_to(f, &t), LOWERED);
        f->height = -f->height; /* around the origin or not, nobody knows */
        assert_int_equal(grow_to(f, &t), GROWN);
    }
}

static void no_room_for_tips(void **state)
{
    (void)state;
    begin(10, 0);
    put_ball(axis(0, 0), 1, 10);
    assert_int_equal(d.p.tips, 10);
    assert_int_equal(grow_toward_ball(axis(0, 0), 2), FULL);
}

#if DIM == 3
/* A corner below a base of many sees all of that: more new facets than there is room for. */
static void no_room_for_facets(void **state)
{
    enum { BASE = 12 };
    (void)state;
    begin(BASE + 2, 0);
    for (int k = 0; k < BASE; k++) {
        real a = (real)(2 * PI * (k % 3 * 4 + k / 3) / BASE); /* three far apart, then those between */
        tip t = tip_at((vec){{(real)cos(a), (real)sin(a), (real)-0.5}});
        int seen = 0;
        if (k < 3) {
            put_tip(t.w);
            if (k == 2) {
                put_tip(axis(2, 1));
                put_first(&d.p);
            }
            continue;
        }
        while (!sees(&d.p, &d.p.facet[seen], &t)) {
            seen++;
        }
        assert_int_equal(grow_to(&d.p.facet[seen], &t), GROWN);
    }
    tip bottom = tip_at(axis(2, -3));
    assert_int_equal(d.p.tips, BASE + 1);
    assert_true(sees(&d.p, lowest(&d.p), &bottom));
    assert_int_equal(grow_to(lowest(&d.p), &bottom), FULL);
}
#endif

/* ---- the proof ---- */

static tally count_all(void)
{
    tally all = d.dropped;
    for (int k = 0; k < d.p.facets; k++) {
        count_height(&d, &d.p.facet[k], &all);
        count_angle(&d, &d.p.facet[k], &all);
    }
    return all;
}

/* Balls around the origin, beside it and near its edge: what is proven is true, and away from the edge, all that is. */
static void what_is_proven_goes_around(void **state)
{
    int proven = 0, around = 0;
    (void)state;
    for (int n = 0; n < 600; n++) {
        draw_from(n);
        real near = any_below(3) ? ldexp(1, -any_below(56)) : 1, far = 1 + near * any_between(-1, 1), upper = REAL_MAX;
        vec middle = mul(any_unit(), far);
        begin(MOST, any_below(2));
        put_ball(middle, 1, 4 + any_below(40));
        int holds = bound(&d, &upper), goes = turns() > 0.5;
        assert_true(!holds || goes);
        assert_true(upper == REAL_MAX || (holds && upper < 0 && upper >= -lowest(&d.p)->height - 8 * UNIT));
        assert_true(holds || !(lowest(&d.p)->height > (real)1e-12));
        proven += holds;
        around += goes;
    }
    printf("%d surfaces go around the origin, %d are proven to\n", around, proven);
    assert_true(proven > 100 && around < 500);
}

/* A facet in a plane near the origin, wide or narrow, turned either way. */
static void put_any_facet(void)
{
    static const int16_t v[3] = {0, 1, 2};
    vec along = any_unit(), across = any_short(any_below(60));
    vec off = any_short(any_below(2) ? any_below(12) : 40 + any_below(24));
    begin(MOST, any_below(2));
    for (int k = 0; k < DIM; k++) {
        vec to = mul(along, any_between(-1, 1));
        to = add(to, mul(across, any_between(-1, 1)));
        put_tip(add(off, to));
    }
    put_facet(&d.p, v);
}

/* A facet counts for no more than its angle where its side is certain, and for no less where it is in doubt: so far as
 * 113 bits tell the side. */
static void facets_count_for_their_angles(void **state)
{
    int counted = 0, certain = 0, in_doubt = 0, proven = 0, clearly = 0;
    (void)state;
    draw_from(0);
    for (int n = 0; n < 100000; n++) {
        tally t = {.least = REAL_MAX};
        put_any_facet();
        quad v = volume(&d.p.facet[0]);
        double a = angle(&d.p.facet[0]) * (v > 0 ? 1 - 1e-9 : 1);
        count_height(&d, &d.p.facet[0], &t);
        count_angle(&d, &d.p.facet[0], &t);
        if (!(t.least > 0) || quad_abs(v) < (quad)0x1p-100) {
            continue;
        }
        counted++;
        certain += t.certain > 0;
        in_doubt += t.doubtful > 0;
        proven += t.proven;
        assert_true(!(t.certain > 0) || (v > 0 && t.certain <= a));
        int clear = d.p.facet[0].form == WIDE && d.p.facet[0].height > CLEAR;
        clearly += clear;
        assert_true(!clear || v > 0);
        assert_true(t.proven == 0 || v > 0);
        assert_true(t.certain > 0 || t.proven > 0 || t.doubtful >= fabs(a));
    }
    printf("%d facets, %d of them certain, %d in doubt, %d proven, %d clear\n", counted, certain, in_doubt, proven,
           clearly);
    assert_true(certain > 100 && in_doubt > 5 && proven > 100 && clearly > 100);
}

/* The certain must outweigh the doubtful; without any of these, one that is proven will do. */
static void certain_outweighs_doubtful(void **state)
{
    static const struct {
        int proven, surrounds;
        real certain, doubtful;
    } of[] = {{0, 0, 0, 0}, {1, 1, 0, 0}, {1, 0, 0, 1}, {0, 1, 1, 0}, {0, 0, 1, 0.5}, {0, 1, 1, 0.25}, {3, 0, 1, 1}};
    (void)state;
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
        tally t = {.facets = DIM + 1,
                   .proven = of[k].proven,
                   .least = 1,
                   .certain = of[k].certain,
                   .doubtful = of[k].doubtful};
        assert_int_equal(surrounds(&t), of[k].surrounds);
    }
}

/* Where a facet in doubt was dropped, the angles of the clear ones are measured against it. */
static void clear_ones_are_measured(void **state)
{
    (void)state;
    draw_from(0);
    begin(MOST, 1);
    put_ball(axis(0, 0), 1, 30);
    assert_true(goes_around(&d, 0));
    d.dropped.doubtful = (real)0.01;
    assert_true(goes_around(&d, 0));
    d.dropped.doubtful = 100;
    assert_false(goes_around(&d, 0));
}

/* Needles and specks beside the origin have no facet that is lower than they are far: that does not make them go
 * around it. */
static void thin_ones_go_around_nothing(void **state)
{
    int high = 0;
    (void)state;
    for (int n = 0; n < 2000; n++) {
        draw_from(n);
        real thin = ldexp(1, -52 - (any_below(8) ? any_below(1000) : 0)), long_way = any_below(4) ? (real)0.5 : 0;
        real upper = REAL_MAX;
        vec along = any_below(2) ? any_unit() : axis(any_below(DIM), 1);
        begin(MOST, any_below(2));
        for (int k = 0; k <= DIM; k++) {
            vec to = mul(along, 1 + long_way * any_between(-1, 1));
            put_tip(add(to, any_vec(thin)));
        }
        put_first(&d.p);
        expect_closed();
        assert_false(bound(&d, &upper));
        assert_true(upper == REAL_MAX);
        high += count_all().least > 0;
    }
    printf("%d thin ones have no facet that is low\n", high);
    assert_true(high > 10);
}

/* Of the facet's corners along its n, without rounding. */
static quad true_height(const facet *f)
{
    quad least = 0, square = 0;
    for (int k = 0; k < DIM; k++) {
        const tip *t = &d.p.tip[f->v[k]];
        quad h = 0;
        square = 0;
        for (int i = 0; i < DIM; i++) {
            h += (quad)f->n.c[i] * ((quad)t->w.c[i] + (quad)t->low.c[i]);
            square += (quad)f->n.c[i] * (quad)f->n.c[i];
        }
        least = k == 0 || h < least ? h : least;
    }
    return least / quad_sqrt(square);
}

/* A floor is below the corners, also where they are off by all the doubt that there is; and no lower than it need be.
 */
static void floors_are_below_all_corners(void **state)
{
    (void)state;
    draw_from(0);
    for (int n = 0; n < 50000; n++) {
        put_any_facet();
        facet *f = &d.p.facet[0];
        for (int k = 0; k < DIM && g.exact; k++) {
            tip *t = &d.p.tip[k];
            for (int twice = any_below(3); twice < 2; twice++) {
                t->w = sub(t->w, mul(f->n, dot(f->n, t->w))); /* in the plane, or nearly so */
            }
            t->low = any_vec(UNIT * larger(peak(t->w), UNIT) / 4);
        }
        f->height = least_height(&d.p, f, f->n);
        quad floor = floor_of(&d, f), height = true_height(f) - (g.exact ? 0 : (quad)q.d.doubt);
        assert_true(floor <= height);
        assert_true(floor > height - (quad)(g.exact ? 2048 * UNIT * UNIT + 16 * UNIT * size(f->height) : 128 * UNIT));
    }
}

/* What is called close enough is as close as asked, all charges in it. */
static void close_enough_is_as_asked(void **state)
{
    int close = 0;
    (void)state;
    draw_from(0);
    for (int n = 0; n < 100000; n++) {
        facet f;
        memset(&f, 0, sizeof f);
        begin(MOST, 0);
        f.height = any_between(0, (real)1.5);
        g.abs_tol = ldexp(any_between(1, 2), -any_below(46));
        real lower = -f.height - g.abs_tol + any_between(-200, 200) * UNIT;
        if (close_enough(&d, &f, lower)) {
            close++;
            assert_true(-(quad)floor_of(&d, &f) - (quad)lower <= (quad)g.abs_tol);
        }
    }
    printf("%d times close enough\n", close);
    assert_true(close > 100);
}

#if DIM == 3
/* Where the numbers are too unlike, nothing is said of the side; nor is it then that the facet holds the origin in. */
static void a_lost_side_is_no_inner_side(void **state)
{
    static const int16_t v[3] = {0, 1, 2};
    const real large = (real)0x1p1000, small = (real)0x1p-1000;
    (void)state;
    begin(MOST, 1);
    put_simplex_at(axis(0, 0), 1);
    for (int k = 0; k < 3; k++) {
        d.p.tip[k].x = add(axis(k, large), axis((k + 1) % 3, small));
    }
    put_facet(&d.p, v);
    assert_int_equal(inner_side(&d, &d.p.facet[d.p.facets - 1]), -1);
    for (int k = 0; k < 3; k++) {
        d.p.tip[k].x = axis(k, large);
    }
    assert_int_equal(inner_side(&d, &d.p.facet[d.p.facets - 1]), 1);
}
#endif

/* ---- sides ---- */

/* Of what is not known to so many digits no side is told. */
static void rises_are_above_the_noise(void **state)
{
    (void)state;
    begin(MOST, 0);
    put_tip(axis(0, 1));
    for (int k = -8; k <= 8; k++) {
        tip t = tip_at(axis(0, 1));
        t.low = axis(0, k * 8 * UNIT * UNIT);
        real r = rise(&d.p, 0, &t, axis(0, 1));
        assert_true(r == (size(t.low.c[0]) > 33 * UNIT * UNIT ? t.low.c[0] : 0)); /* the noise is 32 UNIT^2 */
    }
}

/* To twice the digits, a tip by what rounding took from it too. */
static tip fine_tip(const quad *at)
{
    tip t = tip_at(axis(0, 0));
    for (int i = 0; i < DIM; i++) {
        t.w.c[i] = (real)at[i];
        t.low.c[i] = (real)(at[i] - (quad)t.w.c[i]);
    }
    return t;
}

/* On which side of the facet t is, by a determinant: above 0, the outer. */
static quad true_side(const facet *f, const tip *t)
{
    const tip *from = &d.p.tip[f->v[0]];
    quad e[DIM][DIM];
    for (int k = 0; k < DIM; k++) {
        const tip *to = k < DIM - 1 ? &d.p.tip[f->v[k + 1]] : t;
        for (int i = 0; i < DIM; i++) {
            e[k][i] = (quad)to->w.c[i] - (quad)from->w.c[i] + ((quad)to->low.c[i] - (quad)from->low.c[i]);
        }
    }
#if DIM == 2
    return e[0][1] * e[1][0] - e[0][0] * e[1][1];
#else
    quad sum = 0;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += e[2][i] * (e[0][j] * e[1][k] - e[0][k] * e[1][j]);
    }
    return sum;
#endif
}

/* Of known corners the side is told to nearly twice the digits, and never the wrong one. */
static void sides_are_told_to_twice_the_digits(void **state)
{
    static const int16_t v[3] = {0, 1, 2};
    int told = 0;
    (void)state;
    draw_from(0);
    for (int n = 0; n < 20000; n++) {
        quad at[DIM];
        int down = 20 + any_below(90);
        begin(MOST, 1);
        for (int k = 0; k < DIM; k++) {
            put_tip(any_vec(1));
        }
        put_facet(&d.p, v);
        facet *f = &d.p.facet[0];
        real off = (any_below(2) ? 1 : -1) * ldexp(1, -down), share = any_between(-1, 1), other = any_between(-1, 1);
        for (int i = 0; i < DIM; i++) {
            quad a = (quad)d.p.tip[0].w.c[i], b = (quad)d.p.tip[1].w.c[i], c = (quad)d.p.tip[DIM - 1].w.c[i];
            at[i] = a + (b - a) * (quad)share + (c - a) * (quad)other + (quad)f->n.c[i] * (quad)off;
        }
        tip t = fine_tip(at);
        quad side = true_side(f, &t);
        real said = side_of(&d.p, f, &t);
        told += said != 0;
        assert_true(said == 0 || (said > 0) == (side > 0));
        assert_true(said != 0 || f->form == THIN || quad_abs(side) < (quad)0x1p-92);
    }
    printf("%d sides told\n", told);
}

/* The facet that a simplex has next to a seam goes with it for a t in its plane that is on its side of the seam, where
 * a new facet would cover it; for one on the other side it stays. */
static void a_level_facet_goes_where_it_would_be_covered(void **state)
{
    (void)state;
    begin(MOST, 1);
    put_simplex_at(axis(0, 0), 1);
    for (int k = 0; k <= DIM; k++) {
        for (int i = 0; i < DIM; i++) {
            seam s = seam_of(&d.p, k, i);
            facet *f = &d.p.facet[s.next];
            vec middle = axis(0, 0), on = axis(0, 0);
            for (int j = 0; j < DIM; j++) {
                vec w = d.p.tip[f->v[j]].w;
                middle = add(middle, w);
                on = has_tip(&d.p.facet[k], f->v[j]) ? add(on, w) : on;
            }
            on = mul(on, DIM == 2 ? 1 : (real)0.5); /* of the seam itself */
            for (int side = -1; side <= 1; side += 2) {
                vec other = sub(middle, mul(on, DIM - 1)), off = mul(sub(other, on), (real)0.5);
                tip t = tip_at(add(on, mul(off, side)));
                assert_int_equal(goes_too(&d.p, f, s, &t), side > 0);
            }
        }
    }
}

/* Of whole numbers, where many tips are in one plane: a new facet is never folded back on one that stays, so that all
 * that has area keeps all tips on its inner side. */
static void grows_over_flat_faces(void **state)
{
    int grown = 0, level = 0;
    (void)state;
    for (int n = 0; n < 60; n++) {
        draw_from(n);
        begin(24, n & 1);
        put_simplex_at(axis(0, 0), 1);
        for (int step = 0; step < 100 && d.p.tips < 24; step++) {
            tip t = tip_at(axis(0, 0));
            int seen = 0;
            for (int i = 0; i < DIM; i++) {
                t.w.c[i] = (real)(any_below(5) - 2);
            }
            while (seen < d.p.facets && !sees(&d.p, &d.p.facet[seen], &t)) {
                seen++;
            }
            if (seen == d.p.facets) {
                continue;
            }
            grown += grow_to(&d.p.facet[seen], &t) == GROWN;
            for (int k = 0; k < d.p.facets; k++) {
                for (int v = 0; v < d.p.tips && d.p.facet[k].form != THIN; v++) {
                    quad side = true_side(&d.p.facet[k], &d.p.tip[v]);
                    level += side == 0 && !has_tip(&d.p.facet[k], v);
                    assert_true(side <= 0);
                }
            }
        }
    }
    printf("grown %d times, level %d times\n", grown, level);
    assert_true(grown > 100 && level > 100);
}

/* Of a way that is nearly along the tips, too, what is square to them is square to rounding. */
static void square_to_tips_to_rounding(void **state)
{
    (void)state;
    for (int n = 0; n < 1000; n++) {
        draw_from(n);
        begin(MOST, 0);
        vec along = any_unit(), beside = any_short(n % 40);
        put_tip(any_vec(1));
        put_tip(add(d.p.tip[0].w, along));
        along = sub(d.p.tip[1].w, d.p.tip[0].w);
        vec square = square_to_tips(&d.p, add(along, beside));
        assert_true(size(dot(square, along)) <= 16 * UNIT * length(square));
    }
}

/* How high the facet's plane is, by its corners. */
static quad plane_height(const facet *f)
{
    quad square = 0;
    for (int i = 0; i < DIM; i++) {
        tip t = d.p.tip[f->v[0]];
        quad at = true_side(f, &t);
        t.low.c[i] += 1;
        square += (true_side(f, &t) - at) * (true_side(f, &t) - at);
    }
    return volume(f) / quad_sqrt(square);
}

/* Without rounding, the lowest plane is found whatever the normals are; but not where a facet that is lower may have
 * been dropped. */
static void the_lowest_plane_is_found(void **state)
{
    (void)state;
    for (int n = 0; n < 50; n++) {
        finish f;
        real ends[3];
        draw_from(n);
        begin(MOST, 1);
        q.d.scale = 1;
        put_simplex_at(any_vec((real)0.05), 1);
        for (int k = 0; k <= DIM; k++) {
            facet *of = &d.p.facet[k];
            of->n = unit_of(add(of->n, any_vec((real)0.3)), of->n);
            of->height = least_height(&d.p, of, of->n);
        }
        facet *low = lowest_plane(&f, &d, ends);
        assert_non_null(low);
        for (int k = 0; k <= DIM; k++) {
            assert_true(plane_height(&d.p.facet[k]) >= plane_height(low));
        }
        assert_true(quad_abs((quad)ends[1] + plane_height(low)) <= (quad)UNIT);
        d.dropped.least = -ends[1] * (1 - 1024 * UNIT);
        assert_null(lowest_plane(&f, &d, ends));
    }
}

#if DIM == 3
static vec any_eighths(void)
{
    vec r;
    EACH(r.c[i] = (real)(any_below(17) - 8) / 8);
    return r;
}

/* A facet that is a line has the way to its nearest point for its normal, whichever edge that is on; and is below a tip
 * where all its corners are. */
static void lines_face_the_origin(void **state)
{
    static const int16_t v[3] = {0, 1, 2};
    (void)state;
    draw_from(0);
    for (int n = 0; n < 5000; n++) {
        vec at = any_eighths(), along = any_eighths(); /* tips are not rounded, so that they are in line */
        real way[3], least, most;
        begin(MOST, 0);
        for (int k = 0; k < 3; k++) {
            way[k] = (real)(any_below(33) - 16) / 8;
            put_tip(add(at, mul(along, way[k])));
        }
        if (!(peak(along) > 0)) {
            continue;
        }
        put_facet(&d.p, v);
        least = smaller(way[0], smaller(way[1], way[2]));
        most = larger(way[0], larger(way[1], way[2]));
        vec near = add(at, mul(along, smaller(larger(-dot(at, along) / dot(along, along), least), most)));
        assert_true(d.p.facet[0].form == THIN);
        assert_true(!(length(near) > (real)1e-3) || size(d.p.facet[0].height - length(near)) < (real)1e-12);
    }
    begin(MOST, 0);
    for (int k = 0; k < 3; k++) {
        put_tip(axis(0, k == 0 ? 1 : 4 - k));
    }
    put_facet(&d.p, v);
    tip beyond = tip_at(axis(0, 4)), between = tip_at(axis(0, (real)1.25)), before = tip_at(axis(0, (real)0.5));
    assert_true(rise_over(&d.p, &d.p.facet[0], &beyond) == 1);
    assert_true(rise_over(&d.p, &d.p.facet[0], &between) == 0);
    assert_true(rise_over(&d.p, &d.p.facet[0], &before) == -(real)0.5);
}
#endif

/* ---- dropping ---- */

/* Facets with a tip in common with one below some height, all in all. */
static int count_low(real height)
{
    int low[MOST] = {0}, count = 0;
    for (int k = 0; k < d.p.facets; k++) {
        for (int v = 0; v < d.p.tips; v++) {
            low[v] |= d.p.facet[k].height < height && has_tip(&d.p.facet[k], v);
        }
    }
    for (int k = 0; k < d.p.facets; k++) {
        int at = 0;
        for (int v = 0; v < d.p.tips; v++) {
            at |= low[v] && has_tip(&d.p.facet[k], v);
        }
        count += at;
    }
    return count;
}

/* What no more than so many facets are lower than. */
static real height_of_rank(int rank)
{
    real most = -REAL_MAX;
    for (int k = 0; k < d.p.facets; k++) {
        int lower = 0;
        for (int j = 0; j < d.p.facets; j++) {
            lower += d.p.facet[j].height < d.p.facet[k].height;
        }
        most = lower <= rank ? larger(d.p.facet[k].height, most) : most;
    }
    return most;
}

static int count_tips(void)
{
    int count = 0;
    for (int v = 0; v < d.p.tips; v++) {
        int at = 0;
        for (int k = 0; k < d.p.facets; k++) {
            at |= has_tip(&d.p.facet[k], v);
        }
        count += at;
    }
    return count;
}

/* What is low stays and what touches it, the rest is dropped and counts on; then there is room for more. */
static void what_is_dropped_counts(void **state)
{
    const int tips = DIM == 2 ? 16 : 40;
    (void)state;
    for (int n = 0; n < 100; n++) {
        draw_from(n);
        vec middle = mul(any_unit(), (real)0.5);
        begin(tips, 0);
        put_ball(middle, 1, tips);
        count_all(); /* which sharpens some */
        tally before = count_all();
        q.lower = -height_of_rank(6);
        int low = count_low(-q.lower);
        make_room(&d);
        tally after = count_all();
        expect_closed();
        assert_int_equal(d.p.facets, low);
        assert_int_equal(count_tips(), d.p.tips);
        assert_true(d.p.tips < tips && d.dropped.facets > 0);
        assert_int_equal(after.facets, before.facets);
        assert_true(after.least == before.least && d.dropped.least > after.least);
        assert_true(fabs((double)(after.certain - before.certain)) <= 1e-12);
        assert_int_equal(grow_toward_ball(middle, 1), GROWN);
    }
}

/* ---- numbers ---- */

/* However short a vector is, it has a direction; and a facet, as far as the tips are known, is turned outward. */
static void directions_of_any_size(void **state)
{
    (void)state;
    for (int n = 0; n < 3000; n++) {
        draw_from(n);
        vec way = any_unit(), u = unit_of(mul(way, ldexp(1, -(n % 1020))), axis(0, 0));
        assert_true(fabs((double)length(u) - 1) <= 4 * (double)UNIT && length(sub(u, way)) <= 8 * UNIT);
        begin(MOST, 1);
        put_simplex_at(axis(0, 0), ldexp(1, -any_below(DIM == 2 ? 1000 : 90)));
        for (int k = 0; k < d.p.facets; k++) {
            assert_true(d.p.facet[k].height > 0);
            assert_true(fabs((double)length(d.p.facet[k].n) - 1) <= 8 * (double)UNIT);
        }
    }
    assert_true(same(unit_of(axis(1, 0), axis(1, 3)), axis(1, 1)));
    assert_true(same(unit_of(axis(1, 0), axis(1, 0)), axis(0, 1)));
}

/* As many as there are bytes for, and no more; and 16 bits are enough to count what that makes. */
static void rooms(void **state)
{
    (void)state;
    for (size_t n = FEWEST_TIPS; n <= MOST_TIPS; n += n / 8 + 1) {
        assert_int_equal(tips_in(bytes_for(n)), n);
        assert_int_equal(tips_in(bytes_for(n) - 1), n - 1);
    }
    for (size_t n = FEWEST_TIPS; n <= USUAL_TIPS; n++) {
        polytope p = polytope_in(&room_of_all, n);
        assert_true((size_t)((char *)(p.rim + p.most_facets) - (char *)&room_of_all) <= bytes_for(n));
    }
    assert_int_equal(tips_in(SIZE_MAX / 4), MOST_TIPS);
    assert_true(FACETS_FOR(MOST_TIPS) <= INT16_MAX);
    assert_true(bytes_for(USUAL_TIPS) <= sizeof(usual_room));
    assert_true(FEWEST_TIPS >= 2 * (DIM + 1));
}

int main(void)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(grows_in_a_ball),
        cmocka_unit_test(stays_closed),
        cmocka_unit_test(never_gets_lower),
        cmocka_unit_test(no_room_for_tips),
        cmocka_unit_test(what_is_proven_goes_around),
        cmocka_unit_test(facets_count_for_their_angles),
        cmocka_unit_test(certain_outweighs_doubtful),
        cmocka_unit_test(clear_ones_are_measured),
        cmocka_unit_test(thin_ones_go_around_nothing),
        cmocka_unit_test(floors_are_below_all_corners),
        cmocka_unit_test(close_enough_is_as_asked),
        cmocka_unit_test(rises_are_above_the_noise),
        cmocka_unit_test(sides_are_told_to_twice_the_digits),
        cmocka_unit_test(a_level_facet_goes_where_it_would_be_covered),
        cmocka_unit_test(grows_over_flat_faces),
        cmocka_unit_test(the_lowest_plane_is_found),
        cmocka_unit_test(square_to_tips_to_rounding),
        cmocka_unit_test(what_is_dropped_counts),
        cmocka_unit_test(directions_of_any_size),
        cmocka_unit_test(rooms),
#if DIM == 3
        cmocka_unit_test(no_room_for_facets),
        cmocka_unit_test(a_lost_side_is_no_inner_side),
        cmocka_unit_test(lines_face_the_origin),
#endif
    };
    return cmocka_run_group_tests_name("surface", tests, NULL, NULL);
}
