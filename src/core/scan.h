/* SPDX-License-Identifier: MIT */
/* The farthest of many points along a direction. Nothing is branched on but what is rare: in pairs never seen before
 * each new summit would be a branch mispredicted. */
#ifndef GJK_CORE_SCAN_H
#define GJK_CORE_SCAN_H

#include "lanes.h"

/* Points, one after another, and a bound on how far out they lie. */
typedef struct list {
    const real *v;
    size_t count, step;
    real reach;
} list;

static inline vec nth_of(const list *l, size_t n) { return load(l->v + n * l->step); }

/* ---- runs ---- */

/* Many points are looked at in runs. */
#define RUN 4
#define MANY (8 * RUN)

/* A direction in every lane. */
typedef struct ways {
    lanes c[DIM];
} ways;

static inline ways ways_of(vec d)
{
    ways r;
    EACH(r.c[i] = in_all(d.c[i]));
    return r;
}

/* How high LANES points are: what dot says of each. */
static inline lanes heights(const real *x, size_t step, const ways *d)
{
    lanes c[DIM], r;
    load_lanes(x, step, c);
    r = products(c[0], d->c[0]);
    REST(r = sums(r, products(c[i], d->c[i])));
    return r;
}

/* Of a run, in each lane the highest; to all the heights are added. */
static inline lanes highest_in_run(const real *x, size_t step, const ways *d, lanes *all)
{
    lanes most = heights(x, step, d);
    *all = sums(*all, most);
    for (int k = LANES; k < RUN; k += LANES) {
        lanes next = heights(x + (size_t)k * step, step, d);
        *all = sums(*all, next);
        most = larger_ones(most, next);
    }
    return most;
}

/* ---- ties ---- */

/* How far the computed heights of equals may lie apart: the rounding of two, 3 each, is within the licence of 8. */
static inline real margin_of(const list *l, vec d) { return 8 * UNIT * l->reach * spread(d); }

/* A point that is higher than the best one, if there is any among those of almost its height: of points that lie close
 * together far from their origin, their differences tell. A rise of which rounding leaves even the sign open counts
 * where it can't be wrong by more than 2 units of the reach, which heights leave of the licence. */
static APART size_t settle_tie(const list *l, vec d, size_t best, real almost)
{
    const size_t n = l->count, step = l->step;
    const vec top = nth_of(l, best);
    real highest = 0, leave = 2 * UNIT * l->reach * peak(d);
    lanes all = in_all(0), least = in_all(almost);
    ways way = ways_of(d);
    for (size_t i = 0; i < n; i++) {
        while (n >= MANY && i + RUN < n && !any_as_large(highest_in_run(l->v + i * step, step, &way, &all), least))
            i += RUN;
        vec x = nth_of(l, i);
        if (!(dot(x, d) >= almost)) continue;
        vec e = sub(x, top);
        real rise = dot(e, d), doubt = 4 * UNIT * dot_size(e, d);
        if (!(rise > highest) || !(rise > doubt || doubt <= leave)) continue;
        highest = rise;
        best = i;
    }
    return best;
}

/* The highest of the points so far, the first among equals, and the height of the next one. */
typedef struct summit {
    real highest, second;
    size_t at;
} summit;

static inline summit see(summit s, real height, size_t at)
{
    s.second = larger(smaller(height, s.highest), s.second);
    s.at = height > s.highest ? at : s.at;
    s.highest = larger(height, s.highest);
    return s;
}

/* Of almost equals the others are asked, too. */
static inline size_t settle_summit(const list *l, vec d, summit s)
{
    real almost = s.highest - margin_of(l, d);
    return s.second >= almost ? settle_tie(l, d, s.at, almost) : s.at;
}

/* ---- few points, and many ---- */

/* How points are looked at: some may be no numbers, or all are; and almost equals are told apart, or the first of the
 * highest by rounded heights will do, which falls short by no more than the licence of 8. */
enum care { HASTY, CAREFUL, FIRST_SIGHT, WARY };

static inline int tells_equals(enum care care) { return care == CAREFUL || care == WARY; }
static inline int is_of_strangers(enum care care) { return care == FIRST_SIGHT || care == WARY; }

/* A number times 0 is 0, unless it is none or not finite. */
static APART int are_numbers(const list *l, vec d)
{
    real none = 0;
    for (size_t i = 0; i < l->count; i++) none += dot(nth_of(l, i), d) * 0;
    return none == 0;
}

/* A sum of heights is finite only if every height, and with it every point, is; it need not be if they are. */
static inline int has_none(const list *l, vec d, real sum) { return !(sum * 0 == 0) && !are_numbers(l, d); }

/* Of less than a run almost equals are told apart in any case. */
HOT size_t farthest_of_few(const list *l, vec d, enum care care)
{
    const real *x = l->v;
    summit s = {dot(load(x), d), -REAL_MAX, 0};
    real sum = s.highest;
    for (size_t i = 1; i < l->count; i++) {
        real height = dot(load(x += l->step), d);
        sum += height;
        s = see(s, height, i);
    }
    if (is_of_strangers(care) && has_none(l, d, sum)) return l->count;
    return settle_summit(l, d, s);
}

static inline real sum_of_lanes(lanes x)
{
    real parts[LANES], sum = 0;
    part_lanes(x, parts);
    for (int k = 0; k < LANES; k++) sum += parts[k];
    return sum;
}

/* The first of those bits; there is one. */
static inline unsigned first_bit(unsigned set)
{
    unsigned at = 0;
#if defined(__GNUC__) || defined(__clang__)
    at = (unsigned)__builtin_ctz(set);
#else
    while (!(set >> at & 1)) at++;
#endif
    return at;
}

/* Bit i: point i of n is no lower than that. The last run is of the last ones, some of them once more. */
HOT unsigned as_high_as(const real height[MANY], size_t n, lanes least)
{
    const size_t last = n - RUN;
    unsigned at = 0;
    for (size_t i = 0;; i = i + RUN < last ? i + RUN : last) {
        for (size_t k = i; k < i + RUN; k += LANES) at |= (unsigned)any_as_large(join_lanes(height + k), least) << k;
        if (i == last) return at;
    }
}

/* The farthest of less than MANY points, but a RUN of them at least. Which are high is read off bits, one for each:
 * nothing is branched on but whether there is more than one. */
HOT size_t farthest_in_few_runs(const list *l, vec d, enum care care)
{
    const size_t n = l->count, step = l->step, last = n - RUN;
    const ways way = ways_of(d);
    real height[MANY];
    lanes most = in_all(-REAL_MAX), total = in_all(0);
    for (size_t i = 0;; i = i + RUN < last ? i + RUN : last) {
        for (size_t k = i; k < i + RUN; k += LANES) {
            const lanes next = heights(l->v + k * step, step, &way);
            part_lanes(next, height + k);
            most = larger_ones(next, most);
            if (is_of_strangers(care)) total = sums(total, next);
        }
        if (i == last) break;
    }
    if (is_of_strangers(care) && has_none(l, d, sum_of_lanes(total))) return n;
    most = largest_in_all(most);
    if (tells_equals(care)) {
        const real almost = first_lane(most) - margin_of(l, d);
        const unsigned near = as_high_as(height, n, in_all(almost));
        if (near & (near - 1)) return settle_tie(l, d, first_bit(as_high_as(height, n, most)), almost);
        if (near) return first_bit(near);
    }
    const unsigned at = as_high_as(height, n, most);
    return at ? first_bit(at) : 0;
}

/* A summit in each lane, of runs. */
typedef struct summits {
    lanes highest, second;
    indices at;
} summits;

static inline summits see_run(summits s, lanes height, indices at)
{
    s.second = larger_ones(smaller_ones(height, s.highest), s.second);
    s.at = where_larger(height, s.highest, at, s.at);
    s.highest = larger_ones(height, s.highest);
    return s;
}

/* The point that is the highest of all lanes. */
static inline summit summit_of(const summits *all, const list *l, vec d)
{
    real highest[LANES], second[LANES];
    uint32_t at[LANES];
    part_lanes(all->highest, highest);
    part_lanes(all->second, second);
    part_indices(all->at, at);
    summit lane = {highest[0], second[0], 0};
    for (size_t k = 1; k < LANES; k++) {
        lane = see(lane, highest[k], k);
        lane.second = larger(second[k], lane.second);
    }
    size_t i = (size_t)at[lane.at] * RUN + lane.at;
    summit s = {dot(nth_of(l, i), d), lane.second, i};
    for (size_t k = LANES; k < RUN; k += LANES) s = see(s, dot(nth_of(l, i + k), d), i + k);
    return s;
}

/* Lanes do not tell which of equals is the first. One of the points has that height. */
static inline size_t first_of_height(const list *l, vec d, real height)
{
    size_t i = 0;
    while (i + 1 < l->count && dot(nth_of(l, i), d) != height) i++;
    return i;
}

/* As many runs as indices count; points beyond these are looked at one by one. */
#define MOST_RUNS 0x7fffffffu

HOT size_t farthest_in_runs(const list *l, vec d, enum care care)
{
    const size_t step = l->step, runs = l->count / RUN < MOST_RUNS ? l->count / RUN : MOST_RUNS;
    const real *x = l->v;
    const ways way = ways_of(d);
    summits all = {in_all(-REAL_MAX), in_all(-REAL_MAX), index_in_all(0)};
    lanes total = in_all(0);
    indices at = index_in_all(0);
    for (size_t k = 0; k < runs; k++, x += RUN * step, at = next_indices(at))
        all = see_run(all, highest_in_run(x, step, &way, &total), at);
    summit s = summit_of(&all, l, d);
    real sum = sum_of_lanes(total);
    for (size_t i = runs * RUN; i < l->count; i++, x += step) {
        real height = dot(load(x), d);
        sum += height;
        s = see(s, height, i);
    }
    if (is_of_strangers(care) && has_none(l, d, sum)) return l->count;
    if (s.second == s.highest) s.at = first_of_height(l, d, s.highest);
    return care == HASTY ? s.at : settle_summit(l, d, s);
}

static APART size_t farthest_of_many(const list *l, vec d) { return farthest_in_runs(l, d, WARY); }
static APART size_t farthest_of_many_numbers(const list *l, vec d) { return farthest_in_runs(l, d, CAREFUL); }
static APART size_t farthest_of_many_in_haste(const list *l, vec d) { return farthest_in_runs(l, d, HASTY); }

/* Farthest of the points, the first among equals; of strangers their count if one is not finite. Of many at first
 * sight, and of so few as a segment or a triangle has, almost equals are told apart in any case. */
HOT size_t farthest_among(const list *l, vec d, enum care care)
{
    if (l->count < MANY && l->count >= RUN) return farthest_in_few_runs(l, d, care);
    if (l->count < MANY) return farthest_of_few(l, d, care);
    if (care == HASTY) return farthest_of_many_in_haste(l, d);
    return is_of_strangers(care) ? farthest_of_many(l, d) : farthest_of_many_numbers(l, d);
}

/* The same, where it is one call among many. */
static APART size_t farthest_apart(const list *l, vec d, enum care care) { return farthest_among(l, d, care); }

#endif
