/* SPDX-License-Identifier: MIT */
/* Error-free sums and products: what rounding takes away, as a number (Dekker 1971, Knuth). Exact where nothing over-
 * or underflows. Without fused multiply-add, which not every machine has: the bits are the same either way. */
#ifndef GJK_CORE_EXACT_H
#define GJK_CORE_EXACT_H

#include "linear.h"

typedef struct twin {
    real high, low; /* their sum is the number; high is that sum rounded */
} twin;

static inline twin sum_of(real a, real b)
{
    real s = a + b, t = s - a;
    twin r = {s, (a - (s - t)) + (b - t)};
    return r;
}

/* The upper half of the digits; the rest fits into a half too. */
#define SPLITTER ((real)((bits)1 << (MANTISSA + 2) / 2 | 1))
static inline real upper_half(real a)
{
    real t = a * SPLITTER;
    return t - (t - a);
}

/* Times a power of two, and of numbers within that: added and taken off again it leaves whole multiples of 2^-places of
 * that power. */
#define ROUNDING_TO(places) ((real)((bits)3 << (MANTISSA - (places)-1)))

/* The upper digits of x, which is within that size: whole multiples of 2^-GRID of it, or of a power of two near it. A
 * sum of DIM products of such multiples, each row of a map within its size, is exact. */
#define GRID (MANTISSA / 2)
#define DIGITS_OFF ROUNDING_TO(GRID)
static inline real upper_digits(real x, real size)
{
    const real big = size * DIGITS_OFF;
    return (x + big) - big;
}

/* A power of two above x. */
static inline real above(real x)
{
    bits e;
    memcpy(&e, &x, sizeof e);
    e = ((e >> MANTISSA) + 1) << MANTISSA;
    memcpy(&x, &e, sizeof x);
    return x;
}

typedef struct halves {
    real upper, lower;
} halves;

static inline halves halves_of(real a)
{
    real upper = upper_half(a);
    return (halves){upper, a - upper};
}

/* The product of two numbers that are split already. */
static inline twin product_of_halves(real a, halves h, real b, halves k)
{
    real p = a * b;
    twin r = {p, ((h.upper * k.upper - p) + h.upper * k.lower + h.lower * k.upper) + h.lower * k.lower};
    return r;
}

static inline twin product_of(real a, real b) { return product_of_halves(a, halves_of(a), b, halves_of(b)); }

static inline twin square_of(real a)
{
    halves h = halves_of(a);
    real p = a * a;
    return (twin){p, ((h.upper * h.upper - p) + 2 * h.upper * h.lower) + h.lower * h.lower};
}

static inline twin product_of_twins(twin a, twin b)
{
    twin r = product_of(a.high, b.high);
    return sum_of(r.high, r.low + (a.high * b.low + a.low * b.high));
}

/* Adds x to the sum, keeping what is rounded off. */
static inline void gather(twin *sum, twin x)
{
    twin s = sum_of(sum->high, x.high);
    sum->high = s.high;
    sum->low += s.low + x.low;
}

#endif
