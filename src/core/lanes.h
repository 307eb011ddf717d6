/* SPDX-License-Identifier: MIT */
/* Numbers side by side, where the machine reckons several at once. Each is rounded as it is alone, so that the bits are
 * those of one after another; how many there are, LANES, is known to nobody but who counts them. */
#ifndef GJK_CORE_LANES_H
#define GJK_CORE_LANES_H

#include "linear.h"

#if HAS_LANES
#if REAL_IS_DOUBLE
#define LANES 2
typedef __m128d lanes;

static inline lanes in_all(real x) { return _mm_set1_pd(x); }
static inline lanes sums(lanes x, lanes y) { return _mm_add_pd(x, y); }
static inline lanes differences(lanes x, lanes y) { return _mm_sub_pd(x, y); }
static inline lanes products(lanes x, lanes y) { return _mm_mul_pd(x, y); }
static inline lanes larger_ones(lanes x, lanes y) { return _mm_max_pd(x, y); }
static inline lanes sizes(lanes x) { return _mm_andnot_pd(_mm_set1_pd(-0.0), x); }
static inline int any_as_large(lanes x, lanes y) { return _mm_movemask_pd(_mm_cmpge_pd(x, y)); }
static inline lanes no_larger(lanes x, lanes y) { return _mm_cmple_pd(x, y); }
static inline lanes equals(lanes x, lanes y) { return _mm_cmpeq_pd(x, y); }
static inline lanes in_both(lanes x, lanes y) { return _mm_and_pd(x, y); }
static inline int holds_in_all(lanes x) { return _mm_movemask_pd(x) == (1 << LANES) - 1; }
static inline void part_lanes(lanes x, real r[LANES]) { _mm_storeu_pd(r, x); }
static inline lanes join_lanes(const real x[LANES]) { return _mm_loadu_pd(x); }
static inline lanes largest_in_all(lanes x) { return _mm_max_pd(x, _mm_shuffle_pd(x, x, 1)); }
static inline real first_lane(lanes x) { return _mm_cvtsd_f64(x); }

/* A bit for each of eight comparisons: whether it holds. */
HOT unsigned eight_that_hold(const lanes x[4])
{
    const __m128 a = _mm_castpd_ps(x[0]), b = _mm_castpd_ps(x[1]), c = _mm_castpd_ps(x[2]), d = _mm_castpd_ps(x[3]);
    return (unsigned)(_mm_movemask_ps(_mm_shuffle_ps(a, b, 0x88)) | _mm_movemask_ps(_mm_shuffle_ps(c, d, 0x88)) << 4);
}

/* A bit for each of eight numbers: whether it is as large as y. */
HOT unsigned eight_as_large(const lanes x[4], lanes y)
{
    const lanes large[4] = {_mm_cmpge_pd(x[0], y), _mm_cmpge_pd(x[1], y), _mm_cmpge_pd(x[2], y), _mm_cmpge_pd(x[3], y)};
    return eight_that_hold(large);
}

/* The first number of each point, step by step. */
HOT lanes load_firsts(const real *x, size_t step) { return _mm_loadh_pd(_mm_load_sd(x), x + step); }

/* A number of each point, step by step. */
HOT void load_lanes(const real *x, size_t step, lanes c[DIM])
{
    EACH(c[i] = _mm_loadh_pd(_mm_load_sd(x + i), x + step + i));
}
#else
#define LANES 4
typedef __m128 lanes;

static inline lanes in_all(real x) { return _mm_set1_ps(x); }
static inline lanes sums(lanes x, lanes y) { return _mm_add_ps(x, y); }
static inline lanes differences(lanes x, lanes y) { return _mm_sub_ps(x, y); }
static inline lanes products(lanes x, lanes y) { return _mm_mul_ps(x, y); }
static inline lanes larger_ones(lanes x, lanes y) { return _mm_max_ps(x, y); }
static inline lanes sizes(lanes x) { return _mm_andnot_ps(_mm_set1_ps(-0.0f), x); }
static inline int any_as_large(lanes x, lanes y) { return _mm_movemask_ps(_mm_cmpge_ps(x, y)); }
static inline lanes no_larger(lanes x, lanes y) { return _mm_cmple_ps(x, y); }
static inline lanes equals(lanes x, lanes y) { return _mm_cmpeq_ps(x, y); }
static inline lanes in_both(lanes x, lanes y) { return _mm_and_ps(x, y); }
static inline int holds_in_all(lanes x) { return _mm_movemask_ps(x) == (1 << LANES) - 1; }
static inline void part_lanes(lanes x, real r[LANES]) { _mm_storeu_ps(r, x); }
static inline lanes join_lanes(const real x[LANES]) { return _mm_loadu_ps(x); }
static inline lanes largest_in_all(lanes x)
{
    x = _mm_max_ps(x, _mm_shuffle_ps(x, x, 0x4e));
    return _mm_max_ps(x, _mm_shuffle_ps(x, x, 0xb1));
}
static inline real first_lane(lanes x) { return _mm_cvtss_f32(x); }

HOT unsigned eight_that_hold(const lanes x[2])
{
    return (unsigned)(_mm_movemask_ps(x[0]) | _mm_movemask_ps(x[1]) << 4);
}

HOT unsigned eight_as_large(const lanes x[2], lanes y)
{
    return (unsigned)(any_as_large(x[0], y) | any_as_large(x[1], y) << 4);
}

HOT lanes load_firsts(const real *x, size_t step)
{
    const lanes low = _mm_unpacklo_ps(_mm_load_ss(x), _mm_load_ss(x + step));
    return _mm_movelh_ps(low, _mm_unpacklo_ps(_mm_load_ss(x + 2 * step), _mm_load_ss(x + 3 * step)));
}

/* x and y of two points, step apart. */
static inline lanes load_two(const real *x, size_t step)
{
    lanes r = _mm_loadl_pi(_mm_setzero_ps(), (const __m64 *)(const void *)x);
    return _mm_loadh_pi(r, (const __m64 *)(const void *)(x + step));
}

/* A number of each point, step by step. */
HOT void load_lanes(const real *x, size_t step, lanes c[DIM])
{
    lanes low = load_two(x, step), high = load_two(x + 2 * step, step);
    c[0] = _mm_shuffle_ps(low, high, 0x88);
    c[1] = _mm_shuffle_ps(low, high, 0xdd);
#if DIM == 3
    c[2] = load_firsts(x + 2, step);
#endif
}
#endif
#else
#define LANES 1
typedef real lanes;

static inline lanes in_all(real x) { return x; }
static inline lanes sums(lanes x, lanes y) { return x + y; }
static inline lanes differences(lanes x, lanes y) { return x - y; }
static inline lanes products(lanes x, lanes y) { return x * y; }
static inline lanes larger_ones(lanes x, lanes y) { return larger(x, y); }
static inline lanes sizes(lanes x) { return size(x); }
static inline int any_as_large(lanes x, lanes y) { return x >= y; }
static inline lanes no_larger(lanes x, lanes y) { return x <= y ? 1 : 0; }
static inline lanes equals(lanes x, lanes y) { return x == y ? 1 : 0; }
static inline lanes in_both(lanes x, lanes y) { return x * y; }
static inline int holds_in_all(lanes x) { return x != 0; }
static inline void part_lanes(lanes x, real r[LANES]) { r[0] = x; }
static inline lanes join_lanes(const real x[LANES]) { return x[0]; }
static inline lanes largest_in_all(lanes x) { return x; }
static inline real first_lane(lanes x) { return x; }
HOT unsigned eight_that_hold(const lanes x[8])
{
    unsigned r = 0;
    for (int k = 0; k < 8; k++) r |= (unsigned)(x[k] != 0) << k;
    return r;
}
HOT lanes load_firsts(const real *x, size_t step)
{
    (void)step;
    return *x;
}
HOT unsigned eight_as_large(const lanes x[8], lanes y)
{
    unsigned r = 0;
    for (int k = 0; k < 8; k++) r |= (unsigned)(x[k] >= y) << k;
    return r;
}
HOT void load_lanes(const real *x, size_t step, lanes c[DIM])
{
    (void)step;
    EACH(c[i] = x[i]);
}
#endif

/* ---- four at a time ---- */

typedef struct fours {
    lanes part[4 / LANES];
} fours;

/* A statement for each part i of them. */
#define EACH_PART(statement)                                                                                           \
    for (int i = 0; i < 4 / LANES; i++) statement

static inline fours fours_of(real a, real b, real c, real d)
{
#if LANES == 4
    return (fours){{_mm_setr_ps(a, b, c, d)}};
#elif LANES == 2
    return (fours){{_mm_setr_pd(a, b), _mm_setr_pd(c, d)}};
#else
    return (fours){{a, b, c, d}};
#endif
}

static inline fours join_fours(const real x[4])
{
    fours r;
    EACH_PART(r.part[i] = join_lanes(x + i * LANES));
    return r;
}

static inline fours sizes_of(fours x)
{
    EACH_PART(x.part[i] = sizes(x.part[i]));
    return x;
}

static inline fours sums_of(fours x, fours y)
{
    EACH_PART(x.part[i] = sums(x.part[i], y.part[i]));
    return x;
}

static inline fours differences_of(fours x, fours y)
{
    EACH_PART(x.part[i] = differences(x.part[i], y.part[i]));
    return x;
}

static inline fours products_of(fours x, fours y)
{
    EACH_PART(x.part[i] = products(x.part[i], y.part[i]));
    return x;
}

/* None of them is below 0, or no number: whether all are 0. */
static inline int are_none(fours x)
{
    int r = 1;
    EACH_PART(r &= holds_in_all(no_larger(x.part[i], in_all(0))));
    return r;
}

static inline void part_fours(fours x, real r[4]) { EACH_PART(part_lanes(x.part[i], r + i * LANES)); }

#endif
