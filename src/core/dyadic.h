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
    int sign; /* -1, 0, 1 */
    int lost; /* whether this is not the number at all */
    int low;  /* limb[0] counts units of 2^(32 low) */
    int n;    /* limbs, the lowest first; neither the first nor the last of them is 0 */
    uint32_t limb[LIMBS];
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

/* The number with n limbs from low on, zeros at its ends allowed. */
static dyadic with_limbs(int sign, int low, int n, const uint32_t *limb)
{
    while (n > 0 && limb[n - 1] == 0) n--;
    while (n > 0 && *limb == 0) {
        limb++;
        low++;
        n--;
    }
    dyadic r = nought(n > LIMBS);
    if (n == 0 || r.lost) return r;
    r.sign = sign;
    r.low = low;
    r.n = n;
    for (int i = 0; i < n; i++) r.limb[i] = limb[i];
    return r;
}

static dyadic dyadic_of(real x)
{
    bits b;
    memcpy(&b, &x, sizeof b);
    int exponent = (int)(b >> MANTISSA & EXPONENT_MAX);
    uint64_t digits = b & (((bits)1 << MANTISSA) - 1);
    if (exponent > 0) digits |= (bits)1 << MANTISSA;
    int at = (exponent > 0 ? exponent : 1) - (int)(EXPONENT_MAX >> 1) - MANTISSA + 2048; /* not negative */
    uint64_t above = digits >> (32 - at % 32);
    const uint32_t limb[3] = {(uint32_t)(digits << at % 32 & 0xffffffffu), (uint32_t)(above & 0xffffffffu),
                              (uint32_t)(above >> 32)};
    return with_limbs(x < 0 ? -1 : 1, at / 32 - 64, 3, limb);
}

/* Limb i, counted like low. */
static inline int64_t digit(const dyadic *a, int i)
{
    return i < a->low || i >= a->low + a->n ? 0 : (int64_t)a->limb[i - a->low] * a->sign;
}

/* a + b, or a - b with sign -1. */
static dyadic plus(const dyadic *a, const dyadic *b, int sign)
{
    uint32_t limb[LIMBS + 2];
    if (a->lost || b->lost) return nought(1);
    if (b->sign == 0) return *a;
    if (a->sign == 0) return sign < 0 ? opposite_of(b) : *b;
    int low = a->low < b->low ? a->low : b->low;
    int end = a->low + a->n > b->low + b->n ? a->low + a->n : b->low + b->n, n = end - low + 1, turn = 1;
    if (n > LIMBS + 2) return nought(1);
    for (;;) {
        int64_t carry = 0;
        for (int i = 0; i < n; i++) {
            int64_t sum = turn * (digit(a, low + i) + sign * digit(b, low + i)) + carry;
            limb[i] = (uint32_t)((uint64_t)sum & 0xffffffffu);
            carry = (sum - (int64_t)limb[i]) / ((int64_t)1 << 32);
        }
        if (carry == 0) break;
        turn = -1; /* it was negative */
    }
    return with_limbs(turn, low, n, limb);
}

static dyadic times(const dyadic *a, const dyadic *b)
{
    uint32_t limb[2 * LIMBS];
    if (a->lost || b->lost || a->sign == 0 || b->sign == 0) return nought(a->lost || b->lost);
    for (int i = 0; i < a->n + b->n; i++) limb[i] = 0;
    for (int i = 0; i < a->n; i++) {
        uint64_t carry = 0;
        for (int j = 0; j < b->n; j++) {
            carry += (uint64_t)a->limb[i] * b->limb[j] + limb[i + j];
            limb[i + j] = (uint32_t)(carry & 0xffffffffu);
            carry >>= 32;
        }
        limb[i + b->n] = (uint32_t)carry;
    }
    return with_limbs(a->sign * b->sign, a->low + b->low, a->n + b->n, limb);
}

/* The number's size, to a relative UNIT^2 or so, as a twin times 2^*exponent; the twin is in [1/2, 1), or 0. */
static twin leading(const dyadic *a, int *exponent)
{
    twin r = {0, 0};
    real weight = 1;
    int end = a->n > 5 ? a->n - 5 : 0;
    *exponent = 0;
    if (a->n == 0) return r;
    for (int i = a->n - 1; i >= end; i--) { /* by halves, which every format holds */
        weight *= (real)0x1p-16;
        gather(&r, (twin){(real)(a->limb[i] >> 16) * weight, 0});
        weight *= (real)0x1p-16;
        gather(&r, (twin){(real)(a->limb[i] & 0xffff) * weight, 0});
    }
    *exponent = 32 * (a->low + a->n);
    r = sum_of(r.high, r.low);
    while (r.high < (real)0.5) {
        r.high *= 2;
        r.low *= 2;
        --*exponent;
    }
    return r;
}

#endif
