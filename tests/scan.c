/* SPDX-License-Identifier: MIT */
/* The farthest of many points, from inside: a variant is compiled in. Points side by side, in runs, give the very point
 * that they give one after another, whichever way the machine takes: among equals, among almost equals that only their
 * differences tell apart, and where one is no number. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "splitmix.h"
#include "inside.h"

#define MOST 150
#define LONGEST 5000
#define WIDEST 7 /* numbers from point to point */

static real v[LONGEST * WIDEST];
static uint64_t state_of_draws;

static int below_any(int n) { return (int)(splitmix64(&state_of_draws) % (uint64_t)n); }

static real any_real(void) { return (real)(below_any(1 << 24) - (1 << 23)) / (real)(1 << 23); }

/* Of kind 0 and 3: anywhere; 1: on a coarse grid, where many are equal; 2: close together far out, where rounding makes
 * equals. */
static void draw_points(int kind, int count, int step)
{
    for (int i = 0; i < count * step; i++) {
        real x = kind == 1 ? (real)(below_any(5) - 2) : any_real();
        v[i] = kind == 2 ? 1000 + x * 4096 * UNIT : x;
    }
}

static list any_list(int kind)
{
    int count = RUN + below_any((below_any(2) ? MOST : (int)MANY) - RUN),
        step = DIM + below_any(WIDEST - DIM + 1) * below_any(2);
    draw_points(kind, count, step);
    real reach = kind == 1 ? 4 : kind == 2 ? 2000 : 2;
    return (list){v, (size_t)count, (size_t)step, reach, NULL};
}

static vec any_direction(int kind)
{
    vec d;
    for (int i = 0; i < DIM; i++) d.c[i] = kind == 1 ? (real)(below_any(3) - 1) : any_real();
    if (below_any(4) == 0) d.c[below_any(DIM)] = 0;
    return d;
}

/* One of the list far above the others, so far aside; another is as high but for a rounding or two. */
static void raise_one(const list *l, vec d, size_t at, real aside)
{
    real *x = v + at * l->step;
    for (int i = 0; i < DIM; i++) x[i] = 64 * d.c[i] * (1 + (real)below_any(3) * 2 * UNIT);
    x[0] -= aside * d.c[1];
    x[1] += aside * d.c[0];
}

static void raise_two(const list *l, vec d)
{
    for (int k = 0; k < 2; k++) raise_one(l, d, (size_t)below_any((int)l->count), 0);
}

static size_t first_of_highest(const list *l, vec d)
{
    size_t first = 0;
    for (size_t k = 1; k < l->count; k++) {
        if (dot(nth_of(l, k), d) > dot(nth_of(l, first), d)) first = k;
    }
    return first;
}

/* The highest once almost equals are told apart, told without any means of the library's but dot. */
static size_t one_after_another(const list *l, vec d)
{
    const size_t first = first_of_highest(l, d);
    const vec top = nth_of(l, first);
    real highest = 0;
    size_t best = first;
    for (size_t k = 0; k < l->count; k++) {
        if (!(dot(nth_of(l, k), d) >= dot(top, d) - 8 * UNIT * l->reach * spread(d))) continue;
        const vec e = sub(nth_of(l, k), top);
        const int is_told = dot(e, d) > 4 * UNIT * dot_size(e, d),
                  is_slight = 4 * UNIT * dot_size(e, d) <= 2 * UNIT * l->reach * peak(d);
        if (dot(e, d) > highest && (is_told || is_slight)) {
            highest = dot(e, d);
            best = k;
        }
    }
    return best;
}

/* In runs, as many as there are; what is told of almost equals, and what in haste. */
static void check_runs(const list *l, vec d, size_t best, size_t first)
{
    if (l->count >= EIGHT) {
        assert_true(farthest_in_runs(l, d, CAREFUL) == best);
        assert_true(farthest_in_runs(l, d, WARY) == best);
        assert_true(farthest_in_runs(l, d, HASTY) == first);
        assert_true(farthest_in_runs(l, d, FIRST_SIGHT) == first);
    }
    if (l->count >= MANY) return;
    if (l->count >= EIGHT) {
        assert_true(farthest_of_some(l, d, CAREFUL) == best);
        assert_true(farthest_of_some(l, d, WARY) == best);
        assert_true(farthest_of_some(l, d, HASTY) == first);
        assert_true(farthest_of_some(l, d, FIRST_SIGHT) == first);
    }
    assert_true(farthest_in_few_runs(l, d, CAREFUL) == best);
    assert_true(farthest_in_few_runs(l, d, WARY) == best);
    assert_true(farthest_in_few_runs(l, d, HASTY) == first);
    assert_true(farthest_in_few_runs(l, d, FIRST_SIGHT) == first);
}

/* Lists of any length from a run on. */
static void whichever_way(void **state)
{
    int ties = 0;
    (void)state;
    for (int i = 0; i < 60000; i++) {
        int kind = i % 4;
        list l = any_list(kind);
        vec d = any_direction(kind);
        if (kind == 3) {
            raise_two(&l, d);
            l.reach = 128;
        }
        size_t best = farthest_of_few(&l, d, WARY), first = first_of_highest(&l, d);
        assert_true(best == one_after_another(&l, d));
        assert_true(farthest_of_few(&l, d, CAREFUL) == best);
        check_runs(&l, d, best, first);
        for (size_t k = 0; k < l.count; k++) {
            assert_true(dot(nth_of(&l, k), d) <= dot(nth_of(&l, best), d) + margin_of(&l, d));
            if (kind == 1 && k != best && dot(nth_of(&l, k), d) == dot(nth_of(&l, best), d)) {
                assert_true(k > best); /* nothing rounds there */
                ties++;
            }
        }
    }
    assert_true(ties > 20000);
}

/* A place in a list: among the first, among the last, of which some are looked at twice, or anywhere. */
static size_t any_place(size_t n)
{
    const int few = n < 2 * EIGHT ? (int)n : 2 * EIGHT, kind = below_any(3);
    if (kind == 0) return (size_t)below_any(few);
    return kind == 1 ? n - 1 - (size_t)below_any(few) : (size_t)below_any((int)n);
}

static void check_long(size_t n, int rounds)
{
    const size_t step = DIM + (size_t)below_any(2) * (size_t)below_any(WIDEST - DIM + 1);
    const list l = {v, n, step, 256, NULL};
    for (int i = 0; i < rounds; i++) {
        const vec d = any_direction(0);
        draw_points(0, (int)n, (int)step);
        for (int k = i % 4; k >= 0; k--) raise_one(&l, d, any_place(n), i % 3 ? 0 : 128 * any_real());
        const size_t best = one_after_another(&l, d), first = first_of_highest(&l, d);
        assert_true(farthest_of_few(&l, d, WARY) == best);
        assert_true(farthest_among(&l, d, WARY) == best);
        assert_true(farthest_among(&l, d, CAREFUL) == best);
        assert_true(farthest_among(&l, d, HASTY) == (n < RUN ? best : first));
        assert_true(farthest_among(&l, d, FIRST_SIGHT) == (n < RUN ? best : first));
        if (n >= RUN) check_runs(&l, d, best, first);
        v[any_place(n) * step] = (real)NAN;
        assert_true(farthest_among(&l, d, WARY) == n);
        assert_true(farthest_among(&l, d, FIRST_SIGHT) == n);
    }
}

/* Almost equals anywhere in lists of any length, of one eight or several in a block; and one that is none. */
static void wherever_they_are(void **state)
{
    (void)state;
    for (size_t n = 1; n <= 700; n++) check_long(n, 24);
    for (size_t n = 701; n <= LONGEST; n += 61) check_long(n, 12);
}

static void no_numbers(void **state)
{
    const real nones[3] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    (void)state;
    for (int i = 0; i < 60000; i++) {
        list l = any_list(0);
        vec d = any_direction(0);
        int at = below_any((int)l.count), axis_of = below_any(DIM);
        if (d.c[axis_of] == 0) d.c[axis_of] = 1;
        v[(size_t)at * l.step + (size_t)axis_of] = nones[i % 3];
        assert_true(farthest_of_few(&l, d, WARY) == l.count);
        if (l.count >= EIGHT) assert_true(farthest_in_runs(&l, d, WARY) == l.count);
        if (l.count >= MANY) continue;
        if (l.count >= EIGHT) {
            assert_true(farthest_of_some(&l, d, FIRST_SIGHT) == l.count);
            assert_true(farthest_of_some(&l, d, WARY) == l.count);
        }
        assert_true(farthest_in_few_runs(&l, d, FIRST_SIGHT) == l.count);
        assert_true(farthest_in_few_runs(&l, d, WARY) == l.count);
    }
}

/* Heights whose sum is no number of the format, though each of them is. */
static void no_sum(void **state)
{
    (void)state;
    for (int i = 0; i < 6000; i++) {
        list l = any_list(1);
        vec d = any_direction(1);
        size_t best = farthest_of_few(&l, d, CAREFUL), first = first_of_highest(&l, d);
        for (size_t k = 0; k < l.count * l.step; k++) v[k] *= 1 / (8 * REAL_MIN);
        l.reach *= 1 / (8 * REAL_MIN);
        assert_true(farthest_of_few(&l, d, WARY) == best);
        check_runs(&l, d, best, first);
    }
}

#define MOST_OF_INDEX (1 << 20)

/* With an index of its own. */
static list indexed_list(list l, size_t *bytes)
{
    static uint32_t memory[MOST_OF_INDEX];
    indexed_points cloud = {{l.v, l.count, (uint32_t)(l.step * sizeof(real)), 0, l.reach}, NULL};
    *bytes = pub(index_points)(&cloud, NULL, 0);
    assert_true(*bytes > 0 && *bytes <= sizeof memory);
    assert_true(cloud.index == NULL && !cloud.points.indexed);
    assert_true(pub(index_points)(&cloud, memory, *bytes) == *bytes);
    assert_true(cloud.index == memory && cloud.points.indexed == 1);
    return list_of_cloud(&cloud.points);
}

/* Where cells of so many a side meet, but for some roundings. */
static vec direction_between_cells(uint32_t side)
{
    vec d;
    for (int i = 0; i < DIM; i++)
        d.c[i] = (2 * (real)below_any((int)side + 1) / (real)side - 1) * (1 + (real)(below_any(5) - 2) * UNIT);
    d.c[below_any(DIM)] = below_any(2) ? 1 : -1;
    return mul(d, any_real() + 2);
}

static void draw_on_ball(list *l)
{
    for (size_t k = 0; k < l->count; k++) {
        vec x;
        do x = any_direction(0);
        while (!(dot(x, x) > (real)0.01));
        store(v + k * l->step, mul(x, 1 / root(dot(x, x))));
    }
}

/* What is found by an index is what is found without, of points of any kind, along ways of any kind. */
static void by_an_index(void **state)
{
    long looked_at = 0, of = 0;
    (void)state;
    for (int i = 0; i < 2000; i++) {
        const int kind = i % 5;
        list l = any_list(kind % 3);
        size_t bytes;
        if (kind > 2) draw_on_ball(&l);
        vec d = any_direction(0);
        if (kind == 4) raise_two(&l, d), l.reach = 128;
        const list with = indexed_list(l, &bytes);
        for (int k = 0; k < 40; k++) {
            if (k > 0 || kind != 4)
                d = k % 3 == 0 ? direction_between_cells(with.index[PER_SIDE]) : any_direction(k % 3);
            if (!(peak(d) > 0)) continue;
            const size_t best = one_after_another(&l, d), first = first_of_highest(&l, d);
            assert_true(farthest_among(&with, d, CAREFUL) == best);
            assert_true(farthest_among(&with, d, WARY) == best);
            assert_true(farthest_among(&with, d, HASTY) == first);
            assert_true(farthest_among(&with, d, FIRST_SIGHT) == first);
        }
        if (kind != 3 || l.count < 100) continue;
        looked_at +=
            (long)(bytes / sizeof(uint32_t)) - (long)(BEGINS + 1 + FACES * cells_of_face(with.index[PER_SIDE]));
        of += (long)(FACES * cells_of_face(with.index[PER_SIDE]) * l.count);
    }
    assert_true(looked_at < of / 10);
}

/* So large at most, as the header says. */
static size_t most_bytes(size_t count) { return 100 * count + 100; }

/* Heights that overflow are of strangers alone, who are refused then. */
static void check_same(const list *with, const list *l, vec d)
{
    const int stays_finite = l->reach * peak(d) < REAL_MAX / 4;
    if (!(peak(d) > 0)) return;
    assert_true(farthest_among(with, d, WARY) == farthest_scanned(l, d, WARY));
    if (stays_finite) assert_true(farthest_among(with, d, CAREFUL) == farthest_scanned(l, d, CAREFUL));
    if (l->count < RUN) return; /* of which almost equals are told apart in any case */
    assert_true(farthest_among(with, d, FIRST_SIGHT) == farthest_scanned(l, d, FIRST_SIGHT));
    if (stays_finite) assert_true(farthest_among(with, d, HASTY) == farthest_scanned(l, d, HASTY));
}

/* Four bunches, in each of which all may be the farthest; four points, many times; and one. */
static void of_any_size(void **state)
{
    (void)state;
    for (int n = 1; n < LONGEST; n += 1 + n / 3) {
        for (int kind = 0; kind < 3; kind++) {
            const list l = {v, (size_t)n, DIM, 4, NULL};
            size_t bytes;
            for (int i = 0; i < n * DIM; i++)
                v[i] = (i / DIM >> i % DIM % 2 & 1 && kind < 2 ? 1 : -1) + (kind == 0 ? any_real() * 64 * UNIT : 0);
            const list with = indexed_list(l, &bytes);
            assert_true(bytes <= most_bytes(l.count));
            for (int k = 0; k < 20; k++) check_same(&with, &l, any_direction(0));
        }
    }
}

static int is_one_of(const list *l, vec x)
{
    for (size_t k = 0; k < l->count; k++)
        if (same(nth_of(l, k), x)) return 1;
    return 0;
}

/* Every point is one of a cloud with an index, whatever the zeros' signs; but for some roundings it is none; nor is any
 * that is no number. Many points share coordinates, or all of them. */
static void one_of_them(void **state)
{
    long others = 0;
    (void)state;
    for (int i = 0; i < 600; i++) {
        list l = any_list(i % 3);
        size_t bytes;
        if (i % 2) {
            for (size_t k = 0; k < l.count * l.step; k++) v[k] = (real)(int)(v[k] * 2);
            l.reach *= 2;
        }
        const list with = indexed_list(l, &bytes);
        for (size_t k = 0; k < l.count; k++) {
            vec x = nth_of(&l, k);
            assert_true(is_in_order(&with, x));
            for (int c = 0; c < DIM; c++) x.c[c] = x.c[c] == 0 ? -x.c[c] : x.c[c];
            assert_true(is_in_order(&with, x));
            x.c[below_any(DIM)] *= 1 + (real)(below_any(3) - 1) * 2 * UNIT;
            const int is_one = is_one_of(&l, x);
            others += !is_one;
            assert_true(is_in_order(&with, x) == is_one);
            x.c[below_any(DIM)] = below_any(2) ? (real)NAN : (real)INFINITY;
            assert_true(!is_in_order(&with, x));
        }
    }
    assert_true(others > 10000);
}

static real any_power(void)
{
    const int most = REAL_IS_DOUBLE ? 1000 : 120;
    return (real)ldexp(1, below_any(2 * most + 1) - most);
}

/* Points, and directions, from one end of the numbers to the other: heights under- and overflow. */
static void of_any_length(void **state)
{
    (void)state;
    for (int i = 0; i < 8000; i++) {
        list l = any_list(i % 3);
        size_t bytes;
        const real to =
            i % 4 ? smaller(any_power(), REAL_MAX / 16 / l.reach) : REAL_MIN * UNIT * (real)(1 + below_any(64));
        for (size_t k = 0; k < l.count * l.step; k++) v[k] *= to;
        l.reach = larger(l.reach * to, TINY);
        const list with = indexed_list(l, &bytes);
        for (int k = 0; k < 20; k++) {
            const real far = k % 2 ? any_power() : 1;
            check_same(&with, &l, mul(any_direction(0), far));
        }
    }
}

/* A body of these points, its map drawn: a turn, a shear, or rows that are the same but for some roundings, so that of
 * a way across them hardly anything is left in the body's own coordinates. */
static body any_body(const list *l, real m[DIM * DIM], int kind)
{
    body k = {0};
    real sum = 0;
    for (int i = 0; i < DIM * DIM; i++) {
        m[i] = kind == 0 ? (real)(i % (DIM + 1) == 0) : any_real() * 2;
        if (kind == 2 && i >= DIM) m[i] = m[i % DIM] * (1 + (real)(below_any(9) - 4) * 4 * UNIT);
        sum += m[i] * m[i];
    }
    k.posed = below_any(8) > 0;
    k.m = m;
    k.norm = k.posed ? root(sum) * (1 + 8 * UNIT) : 1;
    k.asked = AS_LIST;
    k.list = *l;
    k.reach = l->reach;
    k.grain = (real)ldexp(1, below_any(9) - 4);
    k.size = 1;
    return k;
}

/* A way, and a simplex of that body alone, whose corners are about as low along it as any. */
static void any_sight(sight *e, simplex *s, real rise[DIM + 1], const body *k, int kind)
{
    vec way;
    do way = kind == 2 ? add(axis(0, 1), axis(1, -1)) : any_direction(0);
    while (!(peak(way) > 0));
    const vec aside = any_direction(0), low = any_direction(0);
    way = mul(add(way, mul(aside, kind == 2 ? 8 * UNIT : 0)), any_real() + 2);
    e->way = (vec_twin){way, mul(low, UNIT * peak(way))};
    const vec down = mul(k->posed ? pull(k->m, way) : way, -1);
    size_t at[DIM];
    s->n = 1;
    at[0] = below_any(4) ? farthest_scanned(&k->list, down, HASTY) : (size_t)below_any((int)k->list.count);
    while (s->n < DIM && below_any(2)) at[s->n++] = (size_t)below_any((int)k->list.count);
    for (int i = 0; i < s->n; i++) {
        s->at[i] = i;
        s->slot[i].x = nth_of(&k->list, at[i]);
        const vec_twin edge = edge_between(k, s->slot[0].x, s->slot[i].x);
        rise[i] = rise_along(&e->way, &edge);
    }
}

/* The last look of a distance, to twice the digits: by an index the same corner is the lowest, as low to the last bit,
 * as it is of all. */
static void lowest_by_an_index(void **state)
{
    long lower = 0, hidden = 0;
    (void)state;
    for (int i = 0; i < 2000; i++) {
        const int of = i % 4, kind = i / 4 % 3;
        list l = any_list(of % 3);
        size_t bytes;
        if (of == 3) draw_on_ball(&l);
        const list with = indexed_list(l, &bytes);
        real m[DIM * DIM], rise[DIM + 1] = {0};
        body k = any_body(&l, m, kind);
        for (int round = 0; round < 20; round++) {
            sight e;
            simplex s;
            vec lowest, same_one;
            candidates those;
            any_sight(&e, &s, rise, &k, kind);
            k.list = l;
            const real fall = fall_of(&e, &k, &s, offsetof(vertex, x), rise, 1, &lowest);
            descent all = {0, s.slot[0].x};
            for (size_t n = 0; n < l.count; n++)
                look_for_fall(&all, &e, &k, &s, offsetof(vertex, x), rise, 1, nth_of(&l, n));
            assert_true(fall == all.least && same(lowest, all.x));
            k.list = with;
            assert_true(fall == fall_of(&e, &k, &s, offsetof(vertex, x), rise, 1, &same_one));
            assert_true(same(lowest, same_one));
            if (!look_up(&with, mul(k.posed ? pull(m, e.way.high) : e.way.high, -1), &those)) continue;
            int named = 0;
            for (; those.from < those.end; those.from++) named |= same(nth_of(&l, *those.from), lowest);
            lower += fall < 0;
            hidden += fall < 0 && !named;
        }
    }
    assert_true(lower > 1000);
    assert_true(hidden > 10); /* the index alone would not do */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whichever_way), cmocka_unit_test(wherever_they_are),  cmocka_unit_test(no_numbers),
        cmocka_unit_test(no_sum),        cmocka_unit_test(by_an_index),        cmocka_unit_test(of_any_size),
        cmocka_unit_test(of_any_length), cmocka_unit_test(lowest_by_an_index), cmocka_unit_test(one_of_them),
    };
    return cmocka_run_group_tests_name("scans", tests, NULL, NULL);
}
