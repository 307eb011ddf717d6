/* SPDX-License-Identifier: MIT */
/* Seeded random numbers, the same on every machine: splitmix64 seeds xoshiro256** (Blackman, Vigna), and nothing
 * here rounds but + - * / and sqrt. */
#ifndef DRAW_H
#define DRAW_H

#include "splitmix.h"
#include "variant.h"

typedef struct draws {
    uint64_t s[4];
} draws;

/* A stream of its own for each (seed, family, index), so that one pair can be drawn again by itself. */
static inline draws draws_from(uint64_t seed, uint64_t family, uint64_t index)
{
    draws d;
    uint64_t state = seed;
    state = splitmix64(&state) ^ family;
    state = splitmix64(&state) ^ index;
    for (int i = 0; i < 4; i++) {
        d.s[i] = splitmix64(&state);
    }
    return d;
}

static inline uint64_t bits(draws *d)
{
    uint64_t x = d->s[1] * 5, t = d->s[1] << 17;
    x = ((x << 7) | (x >> 57)) * 9;
    d->s[2] ^= d->s[0];
    d->s[3] ^= d->s[1];
    d->s[1] ^= d->s[2];
    d->s[0] ^= d->s[3];
    d->s[2] ^= t;
    d->s[3] = (d->s[3] << 45) | (d->s[3] >> 19);
    return x;
}

/* 0 .. n - 1 */
static inline int below(draws *d, int n) { return (int)(bits(d) % (uint64_t)n); }

/* lo <= x < hi */
static inline double between(draws *d, double lo, double hi)
{
    return lo + (hi - lo) * ((double)(bits(d) >> 11) / 9007199254740992.0);
}

static inline double power_of_ten(int exponent)
{
    double x = 1;
    for (int i = 0; i < abs(exponent); i++) {
        x *= 10;
    }
    return exponent < 0 ? 1 / x : x;
}

/* Of any magnitude from 10^lo to 10^hi, each decade as likely. */
static inline double magnitude(draws *d, int lo, int hi)
{
    return between(d, 1, 10) * power_of_ten(lo + below(d, hi - lo));
}

static inline void unit(draws *d, double x[DIM])
{
    double n;
    do {
        n = 0;
        for (int i = 0; i < DIM; i++) {
            x[i] = between(d, -1, 1);
            n += x[i] * x[i];
        }
    } while (n > 1 || n < 0.01);
    n = sqrt(n);
    for (int i = 0; i < DIM; i++) {
        x[i] /= n;
    }
}

/* A rotation, by rows, by about turn radians where turn is small; by anything where turn is infinite. */
static inline void rotation(draws *d, double turn, double m[DIM * DIM])
{
#if DIM == 3
    double q[4], axis[3], n = 0;
    unit(d, axis);
    q[3] = turn > 10 ? between(d, -1, 1) : 1;
    for (int i = 0; i < 3; i++) {
        q[i] = axis[i] * (turn > 10 ? 1 : turn / 2);
    }
    for (int i = 0; i < 4; i++) {
        n += q[i] * q[i];
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            int k = 3 - i - j;
            double sign = (j - i + 3) % 3 == 1 ? -1 : 1;
            m[3 * i + j] =
                i == j ? 1 - 2 * (n - q[3] * q[3] - q[i] * q[i]) / n : 2 * (q[i] * q[j] + sign * q[k] * q[3]) / n;
        }
    }
#else
    double q[2] = {1, turn}, n;
    if (turn > 10) {
        unit(d, q);
    }
    n = sqrt(q[0] * q[0] + q[1] * q[1]);
    m[0] = m[3] = q[0] / n;
    m[1] = -q[1] / n;
    m[2] = q[1] / n;
#endif
}

#endif
