/* SPDX-License-Identifier: MIT */
/* Float only, where it stands beside its sister: vectors of the plane in double. The product of two floats has all its
 * digits there, and no size of a float under- or overflows, be it squared twice: so nothing needs a frame. */
#ifndef GJK_CORE_DOUBLE_H
#define GJK_CORE_DOUBLE_H

#include "widen.h"

#if DIM == 2 && HAS_SISTER

/* ---- two numbers ---- */

#if HAS_LANES
typedef struct dvec {
    __m128d c;
} dvec;

HOT dvec dvec_of(double x, double y) { return (dvec){_mm_setr_pd(x, y)}; }
HOT double dfirst(dvec a) { return _mm_cvtsd_f64(a.c); }
HOT double dsecond(dvec a) { return _mm_cvtsd_f64(_mm_unpackhi_pd(a.c, a.c)); }
HOT dvec dload(const real *c)
{
    return (dvec){_mm_cvtps_pd(_mm_loadl_pi(_mm_setzero_ps(), (const __m64 *)(const void *)c))};
}
HOT void dstore(real *c, dvec a) { _mm_storel_pi((__m64 *)(void *)c, _mm_cvtpd_ps(a.c)); }
HOT void dpart(double *c, dvec a) { _mm_storeu_pd(c, a.c); }
HOT dvec djoin(const double *c) { return (dvec){_mm_loadu_pd(c)}; }
HOT dvec dadd(dvec a, dvec b) { return (dvec){_mm_add_pd(a.c, b.c)}; }
HOT dvec dsub(dvec a, dvec b) { return (dvec){_mm_sub_pd(a.c, b.c)}; }
HOT dvec dtimes(dvec a, dvec b) { return (dvec){_mm_mul_pd(a.c, b.c)}; }
HOT dvec dboth(double x) { return (dvec){_mm_set1_pd(x)}; }
HOT dvec dfirsts(dvec a, dvec b) { return (dvec){_mm_unpacklo_pd(a.c, b.c)}; }
HOT dvec dseconds(dvec a, dvec b) { return (dvec){_mm_unpackhi_pd(a.c, b.c)}; }
HOT dvec dsizes(dvec a) { return (dvec){_mm_andnot_pd(_mm_set1_pd(-0.0), a.c)}; }
/* a where that is smaller, or b. */
HOT dvec dsmaller(dvec a, dvec b) { return (dvec){_mm_min_pd(a.c, b.c)}; }
/* Bit i: number i of a is no larger than that of b. */
HOT unsigned dwithin(dvec a, dvec b) { return (unsigned)_mm_movemask_pd(_mm_cmple_pd(a.c, b.c)); }
/* Square to it, turned to the left. */
HOT dvec dturned(dvec a) { return (dvec){_mm_xor_pd(_mm_shuffle_pd(a.c, a.c, 1), _mm_setr_pd(-0.0, 0))}; }
#else
typedef struct dvec {
    double c[2];
} dvec;

HOT dvec dvec_of(double x, double y) { return (dvec){{x, y}}; }
HOT double dfirst(dvec a) { return a.c[0]; }
HOT double dsecond(dvec a) { return a.c[1]; }
HOT dvec dload(const real *c) { return dvec_of((double)c[0], (double)c[1]); }
HOT void dstore(real *c, dvec a)
{
    c[0] = (real)a.c[0];
    c[1] = (real)a.c[1];
}
HOT void dpart(double *c, dvec a)
{
    c[0] = a.c[0];
    c[1] = a.c[1];
}
HOT dvec djoin(const double *c) { return dvec_of(c[0], c[1]); }
HOT dvec dadd(dvec a, dvec b) { return dvec_of(a.c[0] + b.c[0], a.c[1] + b.c[1]); }
HOT dvec dsub(dvec a, dvec b) { return dvec_of(a.c[0] - b.c[0], a.c[1] - b.c[1]); }
HOT dvec dtimes(dvec a, dvec b) { return dvec_of(a.c[0] * b.c[0], a.c[1] * b.c[1]); }
HOT dvec dboth(double x) { return dvec_of(x, x); }
HOT dvec dfirsts(dvec a, dvec b) { return dvec_of(a.c[0], b.c[0]); }
HOT dvec dseconds(dvec a, dvec b) { return dvec_of(a.c[1], b.c[1]); }
HOT dvec dsizes(dvec a) { return dvec_of(fabs(a.c[0]), fabs(a.c[1])); }
HOT dvec dsmaller(dvec a, dvec b)
{
    return dvec_of(a.c[0] < b.c[0] ? a.c[0] : b.c[0], a.c[1] < b.c[1] ? a.c[1] : b.c[1]);
}
HOT unsigned dwithin(dvec a, dvec b) { return (unsigned)(a.c[0] <= b.c[0]) | (unsigned)(a.c[1] <= b.c[1]) << 1; }
HOT dvec dturned(dvec a) { return dvec_of(-a.c[1], a.c[0]); }
#endif

/* ---- what is made of these ---- */

HOT dvec dmul(dvec a, double k) { return dtimes(a, dboth(k)); }

HOT dvec dnegative(dvec a) { return dsub(dboth(0), a); }

/* Dots of a with x, and of b. */
HOT dvec ddots(dvec a, dvec b, dvec x)
{
    const dvec p = dtimes(a, x), q = dtimes(b, x);
    return dadd(dfirsts(p, q), dseconds(p, q));
}

HOT double ddot(dvec a, dvec b)
{
    const dvec p = dtimes(a, b);
    return dfirst(p) + dsecond(p);
}

HOT double dcross(dvec a, dvec b) { return ddot(dturned(a), b); }

HOT int dsame(dvec a, dvec b)
{
    const dvec off = dsizes(dsub(a, b));
    return dfirst(off) + dsecond(off) == 0;
}

/* The transpose of the map, times v: a direction seen from the set's own frame. */
HOT dvec dpull(const dvec row[2], dvec v)
{
    return dadd(dtimes(row[0], dfirsts(v, v)), dtimes(row[1], dseconds(v, v)));
}

/* At the edge of the floats where these end before it does. */
HOT dvec dinto_range(dvec a)
{
    a = dsmaller(a, dboth((double)REAL_MAX));
    return dnegative(dsmaller(dnegative(a), dboth((double)REAL_MAX)));
}

HOT double dleast(double x, double y) { return x < y ? x : y; }

/* Sum of sizes. */
HOT double dspread(const real *c) { return fabs((double)c[0]) + fabs((double)c[1]); }

/* Rounded as sqrt is, without a call (real.h). */
HOT double droot(double x)
{
#if HAS_LANES
    const __m128d r = _mm_set_sd(x);
    return _mm_cvtsd_f64(_mm_sqrt_sd(r, r));
#else
    return sqrt(x);
#endif
}

HOT double dlength(dvec a) { return droot(ddot(a, a)); }

/* A float below, at most two of its steps. */
HOT real dbelow(double x)
{
    const double far = fabs(x), down = far * (0x1p-24 + 0x1p-44);
    return (real)(x - (far >= (double)REAL_MIN ? down : down + (double)TINY));
}

HOT real dabove(double x) { return -dbelow(-x); }

#endif
#endif
