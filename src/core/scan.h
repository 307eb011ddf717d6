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

HOT ways ways_of(vec d)
{
    ways r;
    EACH(r.c[i] = in_all(d.c[i]));
    return r;
}

/* How high LANES points are: what dot says of each. */
HOT lanes heights(const real *x, size_t step, const ways *d)
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

/* The farthest of so few points, but a RUN of them at least. Which are high is read off bits, one for each:
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

/* From EIGHT on points are looked at eight by eight, the last of the last ones, some of them once more. */
#define EIGHT 8

typedef struct eight {
    lanes high[EIGHT / LANES];
} eight;

/* A statement for each part i of eight. */
#if LANES == 4
#define EACH_OF_EIGHT(statement)                                                                                       \
    do {                                                                                                               \
        PART(0, statement);                                                                                            \
        PART(1, statement);                                                                                            \
    } while (0)
#elif LANES == 2
#define EACH_OF_EIGHT(statement)                                                                                       \
    do {                                                                                                               \
        PART(0, statement);                                                                                            \
        PART(1, statement);                                                                                            \
        PART(2, statement);                                                                                            \
        PART(3, statement);                                                                                            \
    } while (0)
#else
#define EACH_OF_EIGHT(statement)                                                                                       \
    for (size_t i = 0; i < EIGHT; i++) statement
#endif

HOT eight look_at_eight(const real *x, size_t step, const ways *d)
{
    eight r;
    EACH_OF_EIGHT(r.high[i] = heights(x + i * LANES * step, step, d));
    return r;
}

/* In each lane the highest. */
HOT lanes highest_of_eight(const eight *e)
{
    lanes most = e->high[0];
    EACH_OF_EIGHT(if (i > 0) most = larger_ones(e->high[i], most));
    return most;
}

HOT lanes add_eight(const eight *e, lanes sum)
{
    EACH_OF_EIGHT(sum = sums(sum, e->high[i]));
    return sum;
}

/* Each of these sums is finite only if all that is in it is. */
HOT int are_finite(lanes sum) { return holds_in_all(no_larger(products(sum, in_all(0)), in_all(0))); }

/* The first of the highest of n, of which these bits tell, or in care whichever is. */
HOT size_t choose_highest(const list *l, vec d, unsigned at, unsigned near, real almost, enum care care)
{
    if (tells_equals(care) && (near & (near - 1))) return settle_tie(l, d, first_bit(at), almost);
    return first_bit(at | 1u << (l->count - 1));
}

HOT size_t farthest_of_eight(const list *l, size_t step, vec d, enum care care)
{
    const ways way = ways_of(d);
    const eight e = look_at_eight(l->v, step, &way);
    if (is_of_strangers(care) && !are_finite(add_eight(&e, in_all(0))) && !are_numbers(l, d)) return EIGHT;
    const lanes most = largest_in_all(highest_of_eight(&e));
    const real almost = tells_equals(care) ? first_lane(most) - margin_of(l, d) : 0;
    const unsigned near = tells_equals(care) ? eight_as_large(e.high, in_all(almost)) : 0;
    return choose_highest(l, d, eight_as_large(e.high, most), near, almost, care);
}

static inline size_t later_eight(size_t i, size_t last) { return i < last ? i : last; }

HOT size_t farthest_in_eights(const list *l, size_t step, vec d, enum care care)
{
    const size_t n = l->count, last = n - EIGHT;
    if (last == 0) return farthest_of_eight(l, step, d, care);
    const ways way = ways_of(d);
    eight e[MANY / EIGHT];
    lanes most = in_all(-REAL_MAX), total = in_all(0);
    for (size_t i = 0; i < n; i += EIGHT) {
        eight *next = &e[i / EIGHT];
        *next = look_at_eight(l->v + later_eight(i, last) * step, step, &way);
        most = larger_ones(highest_of_eight(next), most);
        if (is_of_strangers(care)) total = add_eight(next, total);
    }
    if (is_of_strangers(care) && !are_finite(total) && !are_numbers(l, d)) return n;
    most = largest_in_all(most);
    const real almost = tells_equals(care) ? first_lane(most) - margin_of(l, d) : 0;
    unsigned at = 0, near = 0;
    for (size_t i = 0; i < n; i += EIGHT) {
        at |= eight_as_large(e[i / EIGHT].high, most) << later_eight(i, last);
        if (tells_equals(care)) near |= eight_as_large(e[i / EIGHT].high, in_all(almost)) << later_eight(i, last);
    }
    return choose_highest(l, d, at, near, almost, care);
}

static APART size_t farthest_in_eights_apart(const list *l, vec d, enum care care)
{
    return farthest_in_eights(l, l->step, d, care);
}

/* Of corners one beside another, or not. */
HOT size_t farthest_of_some(const list *l, vec d, enum care care)
{
    return l->step == DIM ? farthest_in_eights(l, DIM, d, care) : farthest_in_eights_apart(l, d, care);
}

/* Of many, in each lane the highest so far, of the highest of each eight, and which eight that is of; and the next one.
 */
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

/* The first eight that has one so high. */
static inline size_t eight_of(const summits *all, lanes most)
{
    const unsigned here = (unsigned)any_as_large(all->highest, most);
    uint32_t at[LANES], first = UINT32_MAX;
    part_indices(all->at, at);
    for (int k = 0; k < LANES; k++) {
        const uint32_t next = at[k] | ((here >> k & 1) - 1);
        first = next < first ? next : first;
    }
    return here ? first : 0;
}

static inline int is_more_than_one(unsigned set) { return (set & (set - 1)) != 0; }

/* Whether another is almost as high as the highest, which is one of these eight: it may be one looked at twice. */
static inline int has_rival(const summits *all, const eight *e, lanes almost)
{
    return any_as_large(all->second, almost) || is_more_than_one((unsigned)any_as_large(all->highest, almost)) ||
           is_more_than_one(eight_as_large(e->high, almost));
}

/* As many as indices count. */
#define MOST_POINTS (8 * (size_t)0x7fffffff)

HOT size_t farthest_in_runs_of(const list *l, size_t step, vec d, enum care care)
{
    const size_t n = l->count, last = n - EIGHT;
    const ways way = ways_of(d);
    summits all = {in_all(-REAL_MAX), in_all(-REAL_MAX), index_in_all(0)};
    lanes total = in_all(0);
    indices at = index_in_all(0);
    for (size_t i = 0; i < n; i += EIGHT, at = next_indices(at)) {
        const eight e = look_at_eight(l->v + later_eight(i, last) * step, step, &way);
        if (is_of_strangers(care)) total = add_eight(&e, total);
        all = see_run(all, highest_of_eight(&e), at);
    }
    if (is_of_strangers(care) && !are_finite(total) && !are_numbers(l, d)) return n;
    const lanes most = largest_in_all(all.highest);
    const size_t from = later_eight(eight_of(&all, most) * EIGHT, last);
    const eight e = look_at_eight(l->v + from * step, step, &way);
    const size_t best = from + first_bit(eight_as_large(e.high, most) | 1u << (EIGHT - 1));
    if (!tells_equals(care)) return best;
    const real almost = first_lane(most) - margin_of(l, d);
    return has_rival(&all, &e, in_all(almost)) ? settle_tie(l, d, best, almost) : best;
}

HOT size_t farthest_in_runs(const list *l, vec d, enum care care)
{
    if (l->count > MOST_POINTS) return farthest_of_few(l, d, care);
    return l->step == DIM ? farthest_in_runs_of(l, DIM, d, care) : farthest_in_runs_of(l, l->step, d, care);
}

static APART size_t farthest_of_many(const list *l, vec d) { return farthest_in_runs(l, d, WARY); }
static APART size_t farthest_of_many_at_sight(const list *l, vec d) { return farthest_in_runs(l, d, FIRST_SIGHT); }
static APART size_t farthest_of_many_numbers(const list *l, vec d) { return farthest_in_runs(l, d, CAREFUL); }
static APART size_t farthest_of_many_in_haste(const list *l, vec d) { return farthest_in_runs(l, d, HASTY); }

/* Farthest of the points, the first among equals; of strangers their count if one is not finite. Of so few as a segment
 * or a triangle has almost equals are told apart in any case. */
HOT size_t farthest_among(const list *l, vec d, enum care care)
{
    if (l->count < MANY && l->count >= EIGHT) return farthest_of_some(l, d, care);
    if (l->count < MANY && l->count >= RUN) return farthest_in_few_runs(l, d, care);
    if (l->count < MANY) return farthest_of_few(l, d, care);
    if (care == HASTY) return farthest_of_many_in_haste(l, d);
    if (care == FIRST_SIGHT) return farthest_of_many_at_sight(l, d);
    return care == WARY ? farthest_of_many(l, d) : farthest_of_many_numbers(l, d);
}

/* The same, where it is one call among many. */
static APART size_t farthest_apart(const list *l, vec d, enum care care) { return farthest_among(l, d, care); }

#endif
