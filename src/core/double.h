/* SPDX-License-Identifier: MIT */
/* Float only, where it stands beside its sister: pairs of numbers in double, which are vectors in the plane. The
 * product of two floats has all its digits there, and no size of a float under- or overflows, be it squared twice: so
 * nothing needs a frame. */
#ifndef GJK_CORE_DOUBLE_H
#define GJK_CORE_DOUBLE_H

#include "lanes.h"
#include "widen.h"

#if HAS_SISTER

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
HOT dvec dlarger(dvec a, dvec b) { return (dvec){_mm_max_pd(a.c, b.c)}; }
HOT dvec ddivide(dvec a, dvec b) { return (dvec){_mm_div_pd(a.c, b.c)}; }
HOT dvec droots(dvec a) { return (dvec){_mm_sqrt_pd(a.c)}; }
/* x where a is below most, or 0. */
HOT dvec dif_below(dvec a, double most, double x)
{
    return (dvec){_mm_and_pd(_mm_cmplt_pd(a.c, _mm_set1_pd(most)), _mm_set1_pd(x))};
}
/* a where x is below y, or b. */
HOT dvec dwhere_below(dvec x, dvec y, dvec a, dvec b)
{
    const __m128d below = _mm_cmplt_pd(x.c, y.c);
    return (dvec){_mm_or_pd(_mm_and_pd(below, a.c), _mm_andnot_pd(below, b.c))};
}
HOT dvec dopposite(dvec a) { return (dvec){_mm_xor_pd(a.c, _mm_set1_pd(-0.0))}; }
HOT int dsame(dvec a, dvec b) { return _mm_movemask_pd(_mm_cmpeq_pd(a.c, b.c)) == 3; }
/* 0 where a and b are. */
HOT dvec deither(dvec a, dvec b) { return (dvec){_mm_or_pd(a.c, b.c)}; }
/* Turned round where s has its sign set. */
HOT dvec dflipped(dvec a, double s) { return (dvec){_mm_xor_pd(a.c, _mm_and_pd(_mm_set1_pd(s), _mm_set1_pd(-0.0)))}; }
/* With whole numbers below 8 for their last digits; and that of the first. */
HOT dvec dtagged(dvec a, unsigned first, unsigned second)
{
    const __m128i tags = _mm_setr_epi32((int)first, 0, (int)second, 0);
    const __m128i rest = _mm_andnot_si128(_mm_setr_epi32(7, 0, 7, 0), _mm_castpd_si128(a.c));
    return (dvec){_mm_castsi128_pd(_mm_or_si128(rest, tags))};
}
HOT unsigned dtag(dvec a) { return (unsigned)_mm_cvtsi128_si32(_mm_castpd_si128(a.c)) & 7; }
/* Of eight, two bits each: which are no larger than those of x. */
HOT unsigned dwithin(const dvec a[4], dvec x)
{
    __m128i within[4], pairs[2];
    for (int i = 0; i < 4; i++) within[i] = _mm_castpd_si128(_mm_cmple_pd(a[i].c, x.c));
    pairs[0] = _mm_packs_epi32(within[0], within[1]);
    pairs[1] = _mm_packs_epi32(within[2], within[3]);
    return (unsigned)_mm_movemask_epi8(_mm_packs_epi16(pairs[0], pairs[1]));
}
HOT dvec dswapped(dvec a) { return (dvec){_mm_shuffle_pd(a.c, a.c, 1)}; }
/* Square to it, turned to the left. */
HOT dvec dturned(dvec a) { return (dvec){_mm_xor_pd(dswapped(a).c, _mm_setr_pd(-0.0, 0))}; }
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
HOT dvec dlarger(dvec a, dvec b)
{
    return dvec_of(a.c[0] > b.c[0] ? a.c[0] : b.c[0], a.c[1] > b.c[1] ? a.c[1] : b.c[1]);
}
HOT dvec ddivide(dvec a, dvec b) { return dvec_of(a.c[0] / b.c[0], a.c[1] / b.c[1]); }
HOT dvec droots(dvec a) { return dvec_of(sqrt(a.c[0]), sqrt(a.c[1])); }
HOT dvec dif_below(dvec a, double most, double x) { return dvec_of(a.c[0] < most ? x : 0, a.c[1] < most ? x : 0); }
HOT dvec dwhere_below(dvec x, dvec y, dvec a, dvec b)
{
    return dvec_of(x.c[0] < y.c[0] ? a.c[0] : b.c[0], x.c[1] < y.c[1] ? a.c[1] : b.c[1]);
}
HOT dvec dopposite(dvec a) { return dvec_of(-a.c[0], -a.c[1]); }
HOT int dsame(dvec a, dvec b) { return a.c[0] == b.c[0] && a.c[1] == b.c[1]; }
HOT dvec deither(dvec a, dvec b) { return dvec_of(a.c[0] == 0 ? b.c[0] : a.c[0], a.c[1] == 0 ? b.c[1] : a.c[1]); }
HOT dvec dflipped(dvec a, double s)
{
    uint64_t sign;
    memcpy(&sign, &s, sizeof sign);
    return sign >> 63 ? dvec_of(-a.c[0], -a.c[1]) : a;
}
HOT unsigned dtag(dvec a)
{
    uint64_t spelled;
    memcpy(&spelled, a.c, sizeof spelled);
    return (unsigned)spelled & 7;
}
HOT dvec dtagged(dvec a, unsigned first, unsigned second)
{
    uint64_t spelled[2];
    memcpy(spelled, a.c, sizeof spelled);
    spelled[0] = (spelled[0] & ~(uint64_t)7) | first;
    spelled[1] = (spelled[1] & ~(uint64_t)7) | second;
    memcpy(a.c, spelled, sizeof spelled);
    return a;
}
HOT unsigned dwithin(const dvec a[4], dvec x)
{
    unsigned set = 0;
    for (unsigned i = 0; i < 8; i++) set |= a[i / 2].c[i % 2] <= x.c[i % 2] ? 3u << 2 * i : 0;
    return set;
}
HOT dvec dswapped(dvec a) { return dvec_of(a.c[1], a.c[0]); }
HOT dvec dturned(dvec a) { return dvec_of(-a.c[1], a.c[0]); }
#endif

/* ---- what is made of these ---- */

/* One number of pairs that stand one after another. */
HOT double dpart_of(const dvec *pairs, unsigned at)
{
    double r;
    memcpy(&r, (const unsigned char *)pairs + at * sizeof r, sizeof r);
    return r;
}

/* Lanes of floats, from number at on. */
HOT void widen_lanes(lanes x, dvec *pairs, size_t at)
{
#if HAS_LANES
    pairs[at / 2].c = _mm_cvtps_pd(x);
    pairs[at / 2 + 1].c = _mm_cvtps_pd(_mm_movehl_ps(x, x));
#else
    pairs[at / 2].c[at % 2] = (double)x;
#endif
}

HOT dvec dmul(dvec a, double k) { return dtimes(a, dboth(k)); }

HOT dvec dnegative(dvec a) { return dsub(dboth(0), a); }

/* The first of eight that is no larger than those of x; the last where none is. */
HOT unsigned dfirst_within(const dvec a[4], dvec x) { return first_bit(dwithin(a, x) | 1u << 15) / 2; }

/* Dots of a with x and of b with y. */
HOT dvec ddots_of(dvec a, dvec x, dvec b, dvec y)
{
    const dvec p = dtimes(a, x), q = dtimes(b, y);
    return dadd(dfirsts(p, q), dseconds(p, q));
}

/* Of both with x. */
HOT dvec ddots(dvec a, dvec b, dvec x) { return ddots_of(a, x, b, x); }

/* Of each with itself. */
HOT dvec dsquares(dvec a, dvec b) { return ddots_of(a, a, b, b); }

HOT double ddot(dvec a, dvec b)
{
    const dvec p = dtimes(a, b);
    return dfirst(p) + dsecond(p);
}

HOT double dcross(dvec a, dvec b) { return ddot(dturned(a), b); }

/* At the edge of the floats where these end before it does. */
HOT dvec dinto_range(dvec a) { return dlarger(dsmaller(a, dboth((double)REAL_MAX)), dboth(-(double)REAL_MAX)); }

HOT double dleast(double x, double y) { return x < y ? x : y; }

/* Rounded as sqrt is, without a call (real.h). */
HOT double droot(double x) { return dfirst(droots(dboth(x))); }

HOT dvec dlengths(dvec a, dvec b) { return droots(dsquares(a, b)); }

/* What a map, by rows, makes of directions: that along which a body's own corners are as high as placed ones along v.
 */
HOT dvec dpulled(const dvec row[2], dvec v)
{
    return dadd(dtimes(row[0], dfirsts(v, v)), dtimes(row[1], dseconds(v, v)));
}

HOT double dlength(dvec a) { return droot(ddot(a, a)); }

/* Less by as much as rounding them to float may add, and at most two of its steps. */
HOT dvec dbelow(dvec x)
{
    const dvec far = dsizes(x), step = dif_below(far, (double)REAL_MIN, (double)TINY);
    return dsub(x, dadd(dtimes(far, dboth(0x1p-24 + 0x1p-44)), step));
}

#endif
#endif
