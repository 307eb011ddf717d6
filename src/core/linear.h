/* SPDX-License-Identifier: MIT */
/* Vectors and linear maps. Sums run in index order, always: the bits depend on it. */
#ifndef GJK_CORE_LINEAR_H
#define GJK_CORE_LINEAR_H

#include "real.h"

typedef struct vec {
    real c[DIM];
} vec;

/* A statement for each component i, and for each but the first. Written out by the preprocessor, not looped: compilers
 * keep a vector in registers only if no loop stands over its components by the time they take structs apart. */
#define PART(k, statement)                                                                                             \
    do {                                                                                                               \
        enum { i = k };                                                                                                \
        statement;                                                                                                     \
    } while (0)
#if DIM == 2
#define REST(statement) PART(1, statement)
#else
#define REST(statement)                                                                                                \
    do {                                                                                                               \
        PART(1, statement);                                                                                            \
        PART(2, statement);                                                                                            \
    } while (0)
#endif
#define EACH(statement)                                                                                                \
    do {                                                                                                               \
        PART(0, statement);                                                                                            \
        REST(statement);                                                                                               \
    } while (0)

HOT vec load(const real *c)
{
    vec r;
    EACH(r.c[i] = c[i]);
    return r;
}

static inline void store(real *c, vec a) { EACH(c[i] = a.c[i]); }

static inline vec axis(int k, real x)
{
    vec r;
    EACH(r.c[i] = i == k ? x : 0);
    return r;
}

/* No point: what a support finds in its point, so that one which writes nothing is found out. */
static inline vec nowhere(void)
{
    vec r;
    EACH(r.c[i] = (real)NAN);
    return r;
}

HOT vec add(vec a, vec b)
{
    EACH(a.c[i] += b.c[i]);
    return a;
}

HOT vec sub(vec a, vec b)
{
    EACH(a.c[i] -= b.c[i]);
    return a;
}

HOT vec mul(vec a, real k)
{
    EACH(a.c[i] *= k);
    return a;
}

HOT real dot(vec a, vec b)
{
    real r = a.c[0] * b.c[0];
    REST(r += a.c[i] * b.c[i]);
    return r;
}

/* What dot sums, without the signs: its rounding error is at most DIM * UNIT of this. */
static inline real dot_size(vec a, vec b)
{
    real r = size(a.c[0] * b.c[0]);
    REST(r += size(a.c[i] * b.c[i]));
    return r;
}

static inline real length(vec a) { return root(dot(a, a)); }

/* The same for a divisor of what is proven: where the square has lost digits to underflow, as large as can be. */
static inline real length_or_more(vec a)
{
    const real aa = dot(a, a);
    return aa > REAL_MIN / UNIT ? root(aa) : REAL_MAX;
}

/* Sum of sizes, at least the length, and safe from under- and overflow where the length is not. */
HOT real spread(vec a)
{
    real r = size(a.c[0]);
    REST(r += size(a.c[i]));
    return r;
}

/* Largest size; a NaN is passed over, but for the first, of which nothing is known. */
HOT real peak(vec a)
{
    real r = size(a.c[0]);
    REST(r = larger(size(a.c[i]), r));
    return r;
}

/* Its length, also where the square is no plain number, to the same digits. */
static inline real length_anyhow(vec a)
{
    const real square = dot(a, a), far = peak(a);
    if (!unruly(square) || !(far > 0)) return root(square);
    return length(mul(a, leveler(far))) / leveler(far);
}

static inline int same(vec a, vec b)
{
    int r = 1;
    EACH(r &= a.c[i] == b.c[i]);
    return r;
}

/* d brought to size 1 .. 2, where it is not 0; a subnormal one in two steps. */
static inline vec unit_size(vec d)
{
    real far = peak(d);
    d = mul(d, leveler(far));
    return far < REAL_MIN ? mul(d, leveler(peak(d))) : d;
}

/* d brought to size 1/16 .. 1/8: no sum of products of a point with it overflows. The first axis for none. */
static inline vec levelled(vec d) { return peak(d) > 0 ? mul(unit_size(d), (real)0.0625) : axis(0, 1); }

/* m x, m by rows. */
HOT vec map(const real *m, vec x)
{
    vec r;
    EACH(r.c[i] = dot(load(m + DIM * i), x));
    return r;
}

/* What m x sums, without the signs. */
static inline vec map_size(const real *m, vec x)
{
    vec r;
    EACH(r.c[i] = dot_size(load(m + DIM * i), x));
    return r;
}

/* The transpose of m, times d: a direction seen from the set's own frame. */
HOT vec pull(const real *m, vec d)
{
    vec r = mul(load(m), d.c[0]);
    REST(r = add(r, mul(load(m + DIM * i), d.c[i])));
    return r;
}

/* No vector grows by more than this under m, nor under m with its signs removed: the larger of the largest row and
 * column sum of sizes. It is at least every norm used in the rounding terms. */
static inline real stretch(const real *m)
{
    real r = 0;
    for (int i = 0; i < DIM; i++) {
        real row = 0, column = 0;
        for (int j = 0; j < DIM; j++) {
            row += size(m[DIM * i + j]);
            column += size(m[DIM * j + i]);
        }
        r = larger(row, larger(column, r));
    }
    return r;
}

#endif
