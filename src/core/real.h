/* SPDX-License-Identifier: MIT */
/* The number: one IEEE 754 type, rounded after each operation, so that equal inputs give equal bits everywhere.
 * Build with -ffp-contract=off, which cannot be checked here; what can be, is. */
#ifndef GJK_CORE_REAL_H
#define GJK_CORE_REAL_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "parts.h"
#include "words.h"

/* Whether the machine reckons several numbers at once (lanes.h). */
#if (defined(__SSE2__) || defined(_M_X64)) && !defined(GJK_NO_LANES)
#define HAS_LANES 1
#include <emmintrin.h>
#else
#define HAS_LANES 0
#endif

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "gjk proves its answers from the rules of IEEE arithmetic: build it without -ffast-math"
#endif
#if defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "gjk proves its answers from the rules of IEEE arithmetic: build it without -funsafe-math-optimizations"
#endif
#if defined(_MSC_VER) && defined(_M_FP_FAST)
#error "gjk proves its answers from the rules of IEEE arithmetic: build it without /fp:fast"
#endif

#if REAL_IS_DOUBLE
#if DBL_MANT_DIG != 53 || DBL_MAX_EXP != 1024
#error "double is not an IEEE 754 double here: use the float variants"
#endif
#if FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1
#error "doubles are computed in a wider format: on 32-bit x86 build with -msse2 -mfpmath=sse"
#endif
typedef double real;
typedef uint64_t bits;
#define MANTISSA 52
#define EXPONENT_MAX 2047u
#define REAL_MAX DBL_MAX
#define REAL_MIN DBL_MIN
#define PLAIN ((real)0x1p300) /* sizes within 1/PLAIN .. PLAIN need no care for under- and overflow */
#define LIFT ((real)0x1p500)  /* its square, and some, is within range */
#else
#if FLT_MANT_DIG != 24 || FLT_MAX_EXP != 128
#error "float is not an IEEE 754 float here"
#endif
#if FLT_EVAL_METHOD != 0
#error "floats are computed in a wider format: -std=gnu99, or on 32-bit x86 -msse2 -mfpmath=sse, cures it"
#endif
typedef float real;
typedef uint32_t bits;
#define MANTISSA 23
#define EXPONENT_MAX 255u
#define REAL_MAX FLT_MAX
#define REAL_MIN FLT_MIN
#define PLAIN ((real)0x1p30)
#define LIFT ((real)0x1p60)
#endif

/* Kept out of its caller, whose stack frame would otherwise hold its own from the start. */
#if defined(__GNUC__) || defined(__clang__)
#define APART __attribute__((noinline))
#elif defined(_MSC_VER)
#define APART __declspec(noinline)
#else
#define APART
#endif

/* Taken into each of its callers, however many: a call would cost more than it does. Where size counts more, the
 * compiler chooses. */
#if (defined(__GNUC__) || defined(__clang__)) && !defined(__OPTIMIZE_SIZE__)
#define HOT static inline __attribute__((always_inline))
#else
#define HOT static inline
#endif

/* Unit roundoff: a rounded result is off by this share at most. */
#define UNIT ((real)1 / (real)((bits)2 << MANTISSA))
/* The least number above 0. */
#define TINY (REAL_MIN * (2 * UNIT))

/* By the instruction itself where there is one: what is called keeps track of errno for those below 0, and values that
 * live on across a call have no registers. */
static inline real root(real x)
{
#if HAS_LANES && REAL_IS_DOUBLE
    const __m128d r = _mm_set_sd(x);
    return _mm_cvtsd_f64(_mm_sqrt_sd(r, r));
#elif HAS_LANES
    return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(x)));
#elif REAL_IS_DOUBLE
    return sqrt(x);
#else
    return sqrtf(x);
#endif
}

static inline real size(real x)
{
#if REAL_IS_DOUBLE
    return fabs(x);
#else
    return fabsf(x);
#endif
}

/* A NaN in x is passed over; in y it comes through. */
static inline real larger(real x, real y) { return x > y ? x : y; }
static inline real smaller(real x, real y) { return x < y ? x : y; }

/* x, not negative, with the sign of y; no branch, since signs of directions follow no pattern. -0 counts as 0: which of
 * them a direction has depends on the way by which it was reckoned. */
static inline real signed_as(real x, real y)
{
    bits b, s;
    y += 0;
    memcpy(&b, &x, sizeof b);
    memcpy(&s, &y, sizeof s);
    b |= s & (bits)1 << (8 * sizeof s - 1);
    memcpy(&x, &b, sizeof x);
    return x;
}

/* 0 where it is so small that it is to count for nothing. */
static inline real unless_below(real x, real least) { return size(x) < least ? 0 : x; }

static inline int bounded(real x) { return size(x) <= REAL_MAX; }

static inline int is_length(real x) { return x >= 0 && x <= REAL_MAX; }

/* Not of a plain size: under- and overflow need care. NaN is unruly. */
static inline int unruly(real x) { return !(x > 1 / PLAIN && x < PLAIN); }

/* A reach so small that a rounding of the least number is no rounding of the reach. A set of no size rounds nothing. */
static inline int faint(real reach) { return reach > TINY && reach < REAL_MIN; }

/* A reach so small that heights along a direction of size 1/16 round by more than the reach does. */
static inline int tiny(real reach) { return reach > TINY && reach < 64 * REAL_MIN; }

/* A power of two that brings x, finite and not negative, into [1, 2), in the topmost binade [2, 4); as near as the
 * format allows where x is subnormal. */
static inline real leveler(real x)
{
    bits e;
    memcpy(&e, &x, sizeof e);
    e = (EXPONENT_MAX - 1) - (e >> MANTISSA);
    e = (e == 0 ? 1 : e) << MANTISSA;
    memcpy(&x, &e, sizeof x);
    return x;
}

/* x = m 2^e with m in [1, 2): e. x is a normal number. */
static inline int exponent_of(real x)
{
    bits b;
    memcpy(&b, &x, sizeof b);
    return (int)(b >> MANTISSA & EXPONENT_MAX) - (int)(EXPONENT_MAX / 2);
}

/* The digits of it without its exponent. */
static inline bits fraction_of(real x)
{
    bits b;
    memcpy(&b, &x, sizeof b);
    return b & (((bits)1 << MANTISSA) - 1);
}

/* x times 2^e, rounded once where x is of size 1. */
static real raised(real x, int e)
{
    const int half = (int)(EXPONENT_MAX / 4); /* of the range: subnormal after two steps at the earliest */
    while (e != 0) {
        int step = e > half ? half : e < -half ? -half : e;
        bits b = (bits)(step + (int)(EXPONENT_MAX / 2)) << MANTISSA;
        real power;
        memcpy(&power, &b, sizeof power);
        x *= power;
        e -= step;
    }
    return x;
}

/* The next number below. */
static real lower_neighbour(real x)
{
    bits b;
    if (x == 0) return -TINY;
    memcpy(&b, &x, sizeof b);
    b = x > 0 ? b - 1 : b + 1;
    memcpy(&x, &b, sizeof x);
    return x;
}

/* A number below (x + rest) 2^e: the highest or the one under it, where x is of size 1 and the rest below a rounding.
 */
static real below(real x, real rest, int e)
{
    real r = x;
    if (!(rest >= 0)) r = lower_neighbour(x + rest);
    real shrunk = raised(r, e);
    return raised(shrunk, -e) > r ? lower_neighbour(shrunk) : shrunk;
}

#endif
