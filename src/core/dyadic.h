/* SPDX-License-Identifier: MIT */
/* Dyadic numbers: whole numbers times a power of two. Sums and products of reals are dyadic, and here they are exact,
 * whatever the exponents, as long as LIMBS hold them. What they do not hold is lost, and so is all that is made of it.
 */
#ifndef GJK_CORE_DYADIC_H
#define GJK_CORE_DYADIC_H

#include "exact.h"

/* Products of four sums are the largest met, as a rule: room for sums of 1280 bits, in float for any sum of products.
 */
#define LIMBS (REAL_IS_DOUBLE ? 160 : 80)

typedef struct dyadic {
    int sign;                 /* -1, 0, 1 */
    int lost;                 /* whether this is not the number at all */
    int low;                  /* limb[0] counts units of 2^(32 low) */
    int n;                    /* limbs, the lowest first; neither the first nor the last of them is 0 */
    uint32_t limb[LIMBS + 2]; /* the last two while it is worked out */
} dyadic;

static dyadic nought(int lost)
{
    dyadic r;
    r.sign = r.low = r.n = 0;
    r.lost = lost;
    return r;
}

static dyadic opposite_of(const dyadic *a)
{
    dyadic r = *a;
    r.sign = -r.sign;
    return r;
}

/* Takes the zeros off its ends. */
static void strip(dyadic *r)
{
    int zeros = 0;
    while (r->n > 0 && r->limb[r->n - 1] == 0) r->n--;
    while (zeros < r->n && r->limb[zeros] == 0) zeros++;
    r->n -= zeros;
    r->low += zeros;
    for (int i = 0; i < r->n && zeros > 0; i++) r->limb[i] = r->limb[i + zeros];
    if (r->n == 0 || r->n > LIMBS) *r = nought(r->n > 0);
}

/* A number's digits in three limbs, the lowest of them counting units of 2^(32 low). */
typedef struct digits {
    int low;
    uint32_t limb[3];
} digits;

static inline digits digits_of(real x)
{
    bits b;
    memcpy(&b, &x, sizeof b);
    int exponent = (int)(b >> MANTISSA & EXPONENT_MAX);
    uint64_t whole = b & (((bits)1 << MANTISSA) - 1);
    if (exponent > 0) whole |= (bits)1 << MANTISSA;
    int at = (exponent > 0 ? exponent : 1) - (int)(EXPONENT_MAX >> 1) - MANTISSA + 2048; /* not negative */
    uint64_t above = whole >> (32 - at % 32);
    return (digits){
        at / 32 - 64,
        {(uint32_t)(whole << at % 32 & 0xffffffffu), (uint32_t)(above & 0xffffffffu), (uint32_t)(above >> 32)}};
}

static dyadic dyadic_of(real x)
{
    digits d = digits_of(x);
    dyadic r = nought(0);
    r.sign = x < 0 ? -1 : 1;
    r.low = d.low;
    r.n = 3;
    for (int i = 0; i < 3; i++) r.limb[i] = d.limb[i];
    strip(&r);
    return r;
}

/* The limbs are those of a number below 0, as a machine has it: makes them its size. */
static void negate(dyadic *r)
{
    uint64_t carry = 1;
    r->sign = -r->sign;
    for (int i = 0; i < r->n; i++) {
        carry += r->limb[i] ^ 0xffffffffu;
        r->limb[i] = (uint32_t)(carry & 0xffffffffu);
        carry >>= 32;
    }
}

/* Takes the lowest limb off a sum, of either sign, and leaves what is carried. */
static inline uint32_t take_limb(int64_t *sum)
{
    uint32_t r = (uint32_t)((uint64_t)*sum & 0xffffffffu);
    *sum = (*sum - (int64_t)r) / 0x100000000;
    return r;
}

#define MOST_TERMS 16

/* The sum of so few numbers that a limb's sums never overflow. */
static dyadic total_of(const real *x, int n)
{
    digits d[MOST_TERMS];
    int64_t sum[LIMBS + 2], carry = 0;
    int low = INT32_MAX, high = INT32_MIN;
    dyadic r = nought(0);
    for (int i = 0; i < n; i++) {
        if (x[i] == 0) continue;
        d[i] = digits_of(x[i]);
        low = d[i].low < low ? d[i].low : low;
        high = d[i].low > high ? d[i].low : high;
    }
    if (low > high) return r;
    r.low = low;
    r.n = high - low + 4; /* three, and one for what is carried */
    if (r.n > LIMBS + 2) return nought(1);
    for (int i = 0; i < r.n; i++) sum[i] = 0;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 3 && x[i] != 0; k++)
            sum[d[i].low - low + k] += x[i] < 0 ? -(int64_t)d[i].limb[k] : (int64_t)d[i].limb[k];
    for (int i = 0; i < r.n; i++) {
        carry += sum[i];
        r.limb[i] = take_limb(&carry);
    }
    r.sign = 1;
    if (carry < 0) negate(&r);
    strip(&r);
    return r;
}

/* a + b, or a - b with sign -1. */
static dyadic plus(const dyadic *a, const dyadic *b, int sign)
{
    if (a->lost || b->lost) return nought(1);
    if (b->sign == 0) return *a;
    if (a->sign == 0) return sign < 0 ? opposite_of(b) : *b;
    dyadic r = nought(0);
    int end = a->low + a->n > b->low + b->n ? a->low + a->n : b->low + b->n;
    r.low = a->low < b->low ? a->low : b->low;
    r.n = end - r.low + 1;
    r.sign = a->sign;
    if (r.n > LIMBS + 2) return nought(1);
    memset(r.limb, 0, (size_t)r.n * sizeof *r.limb);
    memcpy(&r.limb[a->low - r.low], a->limb, (size_t)a->n * sizeof *a->limb);
    const int64_t by = a->sign == sign * b->sign ? 1 : -1;
    int64_t carry = 0;
    for (int i = b->low - r.low, k = 0; i < r.n && (k < b->n || carry != 0); i++, k++) {
        carry += (int64_t)r.limb[i] + (k < b->n ? by * (int64_t)b->limb[k] : 0);
        r.limb[i] = take_limb(&carry);
    }
    if (carry < 0) negate(&r);
    strip(&r);
    return r;
}

static dyadic times(const dyadic *a, const dyadic *b)
{
    if (a->lost || b->lost || a->sign == 0 || b->sign == 0) return nought(a->lost || b->lost);
    dyadic r = nought(0);
    r.sign = a->sign * b->sign;
    r.low = a->low + b->low;
    r.n = a->n + b->n;
    if (r.n > LIMBS + 2) return nought(1);
    for (int i = 0; i < r.n; i++) r.limb[i] = 0;
    for (int i = 0; i < a->n; i++) {
        uint64_t carry = 0;
        if (a->limb[i] == 0) continue; /* most are, between large and tiny */
        for (int j = 0; j < b->n; j++) {
            carry += (uint64_t)a->limb[i] * b->limb[j] + r.limb[i + j];
            r.limb[i + j] = (uint32_t)(carry & 0xffffffffu);
            carry >>= 32;
        }
        r.limb[i + b->n] = (uint32_t)carry;
    }
    strip(&r);
    return r;
}

/* 32 of the number's binary places, so many below where limb i begins. */
static inline uint32_t places_of(const dyadic *a, int i, int below)
{
    const uint32_t next = i > 0 ? a->limb[i - 1] : 0;
    return below == 0 ? a->limb[i] : a->limb[i] << below | next >> (32 - below);
}

/* The number's size, to a relative UNIT^2 or so, as a twin times 2^*exponent; the twin is in [1/2, 1), or 0. In any
 * unit the same twin: its places are counted from the first that is not 0, not from where limbs begin. */
static twin leading(const dyadic *a, int *exponent)
{
    twin r = {0, 0};
    real weight = 1;
    int end = a->n > 5 ? a->n - 5 : 0, noughts = 0;
    *exponent = 0;
    if (a->n == 0) return r;
    while (!(a->limb[a->n - 1] << noughts >> 31)) noughts++;
    for (int i = a->n - 1; i >= end; i--) { /* by halves, which every format holds */
        const uint32_t places = places_of(a, i, noughts);
        weight *= (real)0x1p-16;
        gather(&r, (twin){(real)(places >> 16) * weight, 0});
        weight *= (real)0x1p-16;
        gather(&r, (twin){(real)(places & 0xffff) * weight, 0});
    }
    *exponent = 32 * (a->low + a->n) - noughts;
    return sum_of(r.high, r.low);
}

#endif
