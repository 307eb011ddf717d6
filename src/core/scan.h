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
    const uint32_t *index; /* of them, or NULL (indexed.h) */
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
HOT lanes heights_there(const lanes c[DIM], const ways *d)
{
    lanes r = products(c[0], d->c[0]);
    REST(r = sums(r, products(c[i], d->c[i])));
    return r;
}

HOT lanes heights(const real *x, size_t step, const ways *d)
{
    lanes c[DIM];
    load_lanes(x, step, c);
    return heights_there(c, d);
}

/* ---- ties ---- */

/* How far the computed heights of equals may lie apart: the rounding of two, 3 each, is within the licence of 8. */
static inline real margin_of(const list *l, vec d) { return 8 * UNIT * l->reach * spread(d); }

/* A point that is higher than the best one, if there is any among those of almost its height: of points that lie close
 * together far from their origin, their differences tell. */
typedef struct tie {
    vec top;
    real highest, leave;
    size_t best;
} tie;

static inline tie tie_of(const list *l, vec d, size_t best)
{
    return (tie){nth_of(l, best), 0, 2 * UNIT * l->reach * peak(d), best};
}

/* A rise of which rounding leaves even the sign open counts where it can't be wrong by more than 2 units of the reach,
 * which heights leave of the licence. */
static inline void look_for_rise(tie *t, const list *l, vec d, size_t i)
{
    const vec e = sub(nth_of(l, i), t->top);
    const real rise = dot(e, d), doubt = 4 * UNIT * dot_size(e, d);
    if (!(rise > t->highest) || !(rise > doubt || doubt <= t->leave)) return;
    t->highest = rise;
    t->best = i;
}

static APART size_t settle_tie(const list *l, vec d, size_t best, real almost)
{
    tie t = tie_of(l, d, best);
    for (size_t i = 0; i < l->count; i++) {
        if (dot(nth_of(l, i), d) >= almost) look_for_rise(&t, l, d, i);
    }
    return t.best;
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

static inline int is_more_than_one(unsigned set) { return (set & (set - 1)) != 0; }

/* Bit i of near: point i from there on is of almost that height. A point that is looked at twice changes nothing. */
static inline void look_among(tie *t, const list *l, vec d, size_t from, unsigned near)
{
    for (; near; near &= near - 1) look_for_rise(t, l, d, from + first_bit(near));
}

static APART size_t settle_those(const list *l, vec d, size_t best, unsigned near)
{
    tie t = tie_of(l, d, best);
    look_among(&t, l, d, 0, near);
    return t.best;
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
        if (is_more_than_one(near)) return settle_those(l, d, first_bit(as_high_as(height, n, most)), near);
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

static inline size_t later_eight(size_t i, size_t last) { return i < last ? i : last; }

/* The first coordinates of eight; and a bit for each of them: whether it is that. */
HOT eight firsts_of_eight(const real *x, size_t step)
{
    eight e;
    EACH_OF_EIGHT(e.high[i] = load_firsts(x + (size_t)i * LANES * step, step));
    return e;
}

HOT unsigned eight_alike(const eight *e, lanes y)
{
    lanes alike[EIGHT / LANES];
    EACH_OF_EIGHT(alike[i] = equals(e->high[i], y));
    return eight_that_hold(alike);
}

/* Of the n points x all are among eight points or more: only those are looked at that share the first coordinate. */
static APART int are_in_eights(const list *l, const real x[][DIM], unsigned n)
{
    unsigned left = (1u << n) - 1;
    for (size_t i = 0; left && i < l->count; i += EIGHT) {
        const real *from = l->v + later_eight(i, l->count - EIGHT) * l->step;
        const eight first = firsts_of_eight(from, l->step);
        for (unsigned k = 0; k < n; k++) {
            unsigned at = left >> k & 1 ? eight_alike(&first, in_all(x[k][0])) : 0;
            for (; at; at &= at - 1)
                if (same(load(from + first_bit(at) * l->step), load(x[k]))) left &= ~(1u << k);
        }
    }
    return !left;
}

/* Bit i: point i of n is no lower than that. */
HOT unsigned eights_as_large(const eight *e, size_t n, lanes least)
{
    unsigned at = 0;
    for (size_t i = 0; i < n; i += EIGHT) at |= eight_as_large(e[i / EIGHT].high, least) << later_eight(i, n - EIGHT);
    return at;
}

/* The first of the highest of less than MANY, or in care whichever is. Mostly none is almost as high. */
HOT size_t choose_highest(const list *l, size_t n, vec d, const eight *e, lanes most, enum care care)
{
    unsigned near = 0;
    if (tells_equals(care)) {
        near = eights_as_large(e, n, in_all(first_lane(most) - margin_of(l, d)));
        if (near && !is_more_than_one(near)) return first_bit(near);
    }
    const unsigned first = first_bit(eights_as_large(e, n, most) | 1u << (n - 1));
    return near ? settle_those(l, d, first, near) : first;
}

HOT size_t farthest_of_eight(const list *l, size_t step, vec d, enum care care)
{
    const ways way = ways_of(d);
    const eight e = look_at_eight(l->v, step, &way);
    if (is_of_strangers(care) && !are_finite(add_eight(&e, in_all(0))) && !are_numbers(l, d)) return EIGHT;
    return choose_highest(l, EIGHT, d, &e, largest_in_all(highest_of_eight(&e)), care);
}

/* Of eight along two directions, in haste, as their coordinates are loaded once. */
HOT void farthest_of_eight_twice(const list *l, size_t step, const vec d[2], size_t at[2])
{
    const ways first = ways_of(d[0]), second = ways_of(d[1]);
    eight e[2];
    for (size_t i = 0; i < EIGHT / LANES; i++) {
        lanes c[DIM];
        load_lanes(l->v + i * LANES * step, step, c);
        e[0].high[i] = heights_there(c, &first);
        e[1].high[i] = heights_there(c, &second);
    }
    for (int k = 0; k < 2; k++)
        at[k] = choose_highest(l, EIGHT, d[k], &e[k], largest_in_all(highest_of_eight(&e[k])), HASTY);
}

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
    return choose_highest(l, n, d, e, largest_in_all(most), care);
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

/* Many are looked at in blocks of so many eights. Of each block in each lane the highest is kept; where one is almost
 * the highest of all, the block is looked at once more. */
#define LANES_OF_BLOCKS 64
#define BLOCKS (LANES_OF_BLOCKS / LANES)
#define BLOCKS_AT_ONCE (EIGHT / LANES)

typedef struct blocks {
    size_t eights, count;
    lanes most, total, high[BLOCKS + BLOCKS_AT_ONCE - 1];
} blocks;

/* No more eights than make BLOCKS of them; the last block may have fewer. The total is of all heights. */
HOT void look_at_blocks(blocks *b, const list *l, size_t step, const ways *way, size_t eights, enum care care)
{
    const real *x = l->v, *const last = x + (l->count - EIGHT) * step;
    lanes most = in_all(-REAL_MAX), total = in_all(0), here = most;
    size_t count = 0;
    for (size_t left = eights;;) {
        const eight e = look_at_eight(x, step, way);
        if (is_of_strangers(care)) total = add_eight(&e, total);
        here = eights == 1 ? highest_of_eight(&e) : larger_ones(highest_of_eight(&e), here);
        if (--left == 0 || x == last) {
            b->high[count++] = here;
            most = larger_ones(here, most);
            if (x == last) break;
            here = in_all(-REAL_MAX);
            left = eights;
        }
        x += EIGHT * step;
        x = x < last ? x : last;
    }
    for (size_t k = 0; k < BLOCKS_AT_ONCE - 1; k++) b->high[count + k] = in_all((real)NAN);
    b->eights = eights;
    b->count = count;
    b->most = most;
    b->total = total;
}

/* A bit for each lane of each block: whether one there is as high as that. */
HOT uint64_t blocks_as_large(const blocks *b, lanes least)
{
    uint64_t set = 0;
    for (size_t k = 0; k < b->count; k += BLOCKS_AT_ONCE)
        set |= (uint64_t)eight_as_large(b->high + k, least) << k * LANES;
    return set;
}

/* The first of those blocks; there is one. */
static inline size_t first_block(uint64_t set)
{
    size_t at = 0;
#if defined(__GNUC__) || defined(__clang__)
    at = (size_t)__builtin_ctzll(set);
#else
    while (!(set >> at & 1)) at++;
#endif
    return at / LANES;
}

/* Without the first of them, which is that. */
static inline uint64_t later_blocks(uint64_t set, size_t block)
{
    const uint64_t till = ((uint64_t)2 << (block * LANES + LANES - 1)) - 1;
    return set & ~till;
}

/* The first of the highest, where it takes a second look at a block. */
static size_t first_of_blocks(const list *l, const ways *way, const blocks *b, lanes most)
{
    const uint64_t set = blocks_as_large(b, most);
    const size_t from = set ? first_block(set) * b->eights : 0;
    for (size_t k = from; k < from + b->eights; k++) {
        const size_t i = later_eight(k * EIGHT, l->count - EIGHT);
        const eight e = look_at_eight(l->v + i * l->step, l->step, way);
        const unsigned at = eight_as_large(e.high, most);
        if (at) return i + first_bit(at);
    }
    return EIGHT - 1;
}

/* That, and of almost equals the others are asked, too. */
static APART size_t settle_blocks(const list *l, vec d, const blocks *b, enum care care)
{
    const ways way = ways_of(d);
    const lanes most = largest_in_all(b->most), least = in_all(first_lane(most) - margin_of(l, d));
    const size_t best = first_of_blocks(l, &way, b, most);
    if (!tells_equals(care)) return best;
    tie t = tie_of(l, d, best);
    uint64_t set = blocks_as_large(b, least);
    while (set) {
        const size_t block = first_block(set), from = block * b->eights;
        for (size_t k = from; k < from + b->eights && k * EIGHT < l->count; k++) {
            const size_t i = later_eight(k * EIGHT, l->count - EIGHT);
            const eight e = look_at_eight(l->v + i * l->step, l->step, &way);
            look_among(&t, l, d, i, eight_as_large(e.high, least));
        }
        set = later_blocks(set, block);
    }
    return t.best;
}

/* The same where each block is one eight; the set is of those with almost equals. */
static APART size_t settle_eights(const list *l, vec d, uint64_t set, lanes most, lanes least)
{
    const ways way = ways_of(d);
    size_t from[BLOCKS], best = EIGHT - 1, n = 0;
    int found = 0;
    unsigned near[BLOCKS];
    for (; set; set = later_blocks(set, first_block(set)), n++) {
        from[n] = later_eight(first_block(set) * EIGHT, l->count - EIGHT);
        const eight e = look_at_eight(l->v + from[n] * l->step, l->step, &way);
        const unsigned at = eight_as_large(e.high, most);
        near[n] = eight_as_large(e.high, least);
        if (at && !found) best = from[n] + first_bit(at);
        found |= at != 0;
    }
    tie t = tie_of(l, d, best);
    for (size_t k = 0; k < n; k++) look_among(&t, l, d, from[k], near[k]);
    return t.best;
}

HOT size_t farthest_in_blocks(const list *l, size_t step, vec d, size_t eights, enum care care)
{
    const size_t n = l->count;
    const ways way = ways_of(d);
    blocks b;
    look_at_blocks(&b, l, step, &way, eights, care);
    if (is_of_strangers(care) && !are_finite(b.total) && !are_numbers(l, d)) return n;
    const lanes most = largest_in_all(b.most);
    const lanes least = tells_equals(care) ? in_all(first_lane(most) - margin_of(l, d)) : most;
    const uint64_t set = blocks_as_large(&b, least);
    if (eights > 1 || !set) return settle_blocks(l, d, &b, care);
    const size_t block = first_block(set), from = later_eight(block * EIGHT, n - EIGHT);
    if (tells_equals(care) && later_blocks(set, block)) return settle_eights(l, d, set, most, least);
    const eight e = look_at_eight(l->v + from * step, step, &way);
    const unsigned near = eight_as_large(e.high, least);
    if (tells_equals(care) && is_more_than_one(near)) return settle_eights(l, d, set, most, least);
    return from + first_bit(near | 1u << (EIGHT - 1));
}

static inline size_t eights_of_block(const list *l) { return (l->count - 1) / (EIGHT * BLOCKS) + 1; }

static APART size_t farthest_of_long(const list *l, vec d, enum care care)
{
    const size_t eights = eights_of_block(l);
    return l->step == DIM ? farthest_in_blocks(l, DIM, d, eights, care)
                          : farthest_in_blocks(l, l->step, d, eights, care);
}

HOT size_t farthest_in_runs(const list *l, vec d, enum care care)
{
    if (l->count > EIGHT * BLOCKS) return farthest_of_long(l, d, care);
    return l->step == DIM ? farthest_in_blocks(l, DIM, d, 1, care) : farthest_in_blocks(l, l->step, d, 1, care);
}

static APART size_t farthest_of_many(const list *l, vec d) { return farthest_in_runs(l, d, WARY); }
static APART size_t farthest_of_many_at_sight(const list *l, vec d) { return farthest_in_runs(l, d, FIRST_SIGHT); }
static APART size_t farthest_of_many_numbers(const list *l, vec d) { return farthest_in_runs(l, d, CAREFUL); }
static APART size_t farthest_of_many_in_haste(const list *l, vec d) { return farthest_in_runs(l, d, HASTY); }

/* Farthest of the points, the first among equals; of strangers their count if one is not finite. Of so few as a segment
 * or a triangle has almost equals are told apart in any case. */
HOT size_t farthest_scanned(const list *l, vec d, enum care care)
{
    if (l->count < MANY && l->count >= EIGHT) return farthest_of_some(l, d, care);
    if (l->count < MANY && l->count >= RUN) return farthest_in_few_runs(l, d, care);
    if (l->count < MANY) return farthest_of_few(l, d, care);
    if (care == HASTY) return farthest_of_many_in_haste(l, d);
    if (care == FIRST_SIGHT) return farthest_of_many_at_sight(l, d);
    return care == WARY ? farthest_of_many(l, d) : farthest_of_many_numbers(l, d);
}

#endif
