/* SPDX-License-Identifier: MIT */
/* The truth in 113 bits, and where that is in doubt, by whole numbers of any length. */
#ifndef SETTLE_H
#define SETTLE_H

#include "exact.h"
#include "truth.h"

/* x to within 2^-110 of it. */
static inline quad quad_of(exact *e, mpf_srcptr x)
{
    quad sum = 0;
    mpf_set(e->f, x);
    for (int part = 0; part < 3; part++) {
        long power;
        double d = mpf_get_d_2exp(&power, e->f);
        sum += (quad)d * (quad)ldexp(1, (int)(power / 2)) * (quad)ldexp(1, (int)(power - power / 2));
        mpf_set_d(e->h, d);
        if (power > 0) {
            mpf_mul_2exp(e->h, e->h, (mp_bitcnt_t)power);
        } else {
            mpf_div_2exp(e->h, e->h, (mp_bitcnt_t)-power);
        }
        mpf_sub(e->f, e->f, e->h);
    }
    return sum;
}

/* Replaces the truth by the exact one, rounded outwards in the last of 113 bits. 0: it is not known, as of round bodies
 * and of couples. */
static inline int settle(truth *t, exact *e, const body *a, const body *b)
{
    quad d, off;
    if (!has_corners(a) || !has_corners(b)) {
        return 0;
    }
    exact_distance(e, a, b);
    t->apart = mpq_sgn(e->square) > 0;
    if (!t->apart && !exact_depth(e)) {
        return 0;
    }
    d = quad_of(e, e->distance);
    off = quad_abs(d) * (quad)1e-33 + t->scale * (quad)ldexp(1, -900); /* what the root and the radii leave */
    t->lower = d - off;
    t->upper = d + off;
    t->certified = 1;
    return 1;
}

/* How far x is from what the truth is known to be. */
static inline quad off_truth(const truth *t, quad x) { return positive(x > t->upper ? x - t->upper : t->lower - x); }

/* How far the point stands off the body. */
static inline quad stands_off_body(exact *e, const body *b, const real *point)
{
    static body dot;
    static truth spot;
    start_body(&dot, POINTS);
    dot.count = 1;
    memcpy(dot.v[0], point, sizeof dot.v[0]);
    bind(&dot);
    find_truth(&spot, &dot, b, 0);
    settle(&spot, e, &dot, b);
    return spot.lower;
}

/* How far the body reaches along the normal, or with sign -1 against it. */
static inline quad along_normal(const body *b, const real *normal, int sign)
{
    quad n[DIM], x[DIM], sum = 0;
    for (int i = 0; i < DIM; i++) {
        n[i] = (quad)normal[i] * (quad)sign;
    }
    farthest_of_body(b, no_origin, 1, n, x);
    for (int i = 0; i < DIM; i++) {
        sum += n[i] * x[i];
    }
    return sum / norm(n);
}

#endif
