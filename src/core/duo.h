/* SPDX-License-Identifier: MIT */
/* A number of each of the two bodies, side by side: what is done with the one is done with the other, where the machine
 * can at once. Each is rounded as it is alone. */
#ifndef GJK_CORE_DUO_H
#define GJK_CORE_DUO_H

#include "exact.h"

#if HAS_LANES && REAL_IS_DOUBLE
typedef struct duo {
    __m128d c;
} duo;

HOT duo duo_of(real a, real b) { return (duo){_mm_setr_pd(a, b)}; }
HOT duo duo_at(const real *a, const real *b) { return (duo){_mm_loadh_pd(_mm_load_sd(a), b)}; }
HOT duo duo_beside(const real *x) { return (duo){_mm_loadu_pd(x)}; }
HOT real of_a(duo x) { return _mm_cvtsd_f64(x.c); }
HOT real of_b(duo x) { return _mm_cvtsd_f64(_mm_unpackhi_pd(x.c, x.c)); }
HOT duo duo_add(duo x, duo y) { return (duo){_mm_add_pd(x.c, y.c)}; }
HOT duo duo_sub(duo x, duo y) { return (duo){_mm_sub_pd(x.c, y.c)}; }
HOT duo duo_mul(duo x, duo y) { return (duo){_mm_mul_pd(x.c, y.c)}; }
HOT duo duo_div(duo x, duo y) { return (duo){_mm_div_pd(x.c, y.c)}; }
HOT duo duo_root(duo x) { return (duo){_mm_sqrt_pd(x.c)}; }
HOT duo duo_size(duo x) { return (duo){_mm_andnot_pd(_mm_set1_pd(-0.0), x.c)}; }
HOT duo duo_larger(duo x, duo y) { return (duo){_mm_max_pd(x.c, y.c)}; }
HOT duo duo_smaller(duo x, duo y) { return (duo){_mm_min_pd(x.c, y.c)}; }
/* Whether both of x are larger. */
HOT int are_larger(duo x, duo y) { return _mm_movemask_pd(_mm_cmpgt_pd(x.c, y.c)) == 3; }
/* v where x > y, else w. */
HOT duo duo_where_larger(duo x, duo y, duo v, duo w)
{
    const __m128d mask = _mm_cmpgt_pd(x.c, y.c);
    return (duo){_mm_or_pd(_mm_and_pd(mask, v.c), _mm_andnot_pd(mask, w.c))};
}
/* As signed_as has it. */
HOT duo duo_signed(duo x, duo y)
{
    const __m128d sign = _mm_and_pd(_mm_set1_pd(-0.0), _mm_add_pd(y.c, _mm_setzero_pd()));
    return (duo){_mm_or_pd(x.c, sign)};
}
#elif HAS_LANES
typedef struct duo {
    __m128 c; /* the first two */
} duo;

HOT duo duo_of(real a, real b) { return (duo){_mm_setr_ps(a, b, 0, 0)}; }
HOT duo duo_at(const real *a, const real *b) { return (duo){_mm_unpacklo_ps(_mm_load_ss(a), _mm_load_ss(b))}; }
HOT duo duo_beside(const real *x) { return (duo){_mm_loadl_pi(_mm_setzero_ps(), (const __m64 *)(const void *)x)}; }
HOT real of_a(duo x) { return _mm_cvtss_f32(x.c); }
HOT real of_b(duo x) { return _mm_cvtss_f32(_mm_shuffle_ps(x.c, x.c, 0x55)); }
HOT duo duo_add(duo x, duo y) { return (duo){_mm_add_ps(x.c, y.c)}; }
HOT duo duo_sub(duo x, duo y) { return (duo){_mm_sub_ps(x.c, y.c)}; }
HOT duo duo_mul(duo x, duo y) { return (duo){_mm_mul_ps(x.c, y.c)}; }
HOT duo duo_div(duo x, duo y) { return (duo){_mm_div_ps(x.c, y.c)}; }
HOT duo duo_root(duo x) { return (duo){_mm_sqrt_ps(x.c)}; }
HOT duo duo_size(duo x) { return (duo){_mm_andnot_ps(_mm_set1_ps(-0.0f), x.c)}; }
HOT duo duo_larger(duo x, duo y) { return (duo){_mm_max_ps(x.c, y.c)}; }
HOT duo duo_smaller(duo x, duo y) { return (duo){_mm_min_ps(x.c, y.c)}; }
HOT int are_larger(duo x, duo y) { return (_mm_movemask_ps(_mm_cmpgt_ps(x.c, y.c)) & 3) == 3; }
HOT duo duo_where_larger(duo x, duo y, duo v, duo w)
{
    const __m128 mask = _mm_cmpgt_ps(x.c, y.c);
    return (duo){_mm_or_ps(_mm_and_ps(mask, v.c), _mm_andnot_ps(mask, w.c))};
}
HOT duo duo_signed(duo x, duo y)
{
    const __m128 sign = _mm_and_ps(_mm_set1_ps(-0.0f), _mm_add_ps(y.c, _mm_setzero_ps()));
    return (duo){_mm_or_ps(x.c, sign)};
}
#else
typedef struct duo {
    real c[2];
} duo;

HOT duo duo_of(real a, real b) { return (duo){{a, b}}; }
HOT duo duo_at(const real *a, const real *b) { return duo_of(*a, *b); }
HOT duo duo_beside(const real *x) { return duo_of(x[0], x[1]); }
HOT real of_a(duo x) { return x.c[0]; }
HOT real of_b(duo x) { return x.c[1]; }
HOT duo duo_add(duo x, duo y) { return duo_of(x.c[0] + y.c[0], x.c[1] + y.c[1]); }
HOT duo duo_sub(duo x, duo y) { return duo_of(x.c[0] - y.c[0], x.c[1] - y.c[1]); }
HOT duo duo_mul(duo x, duo y) { return duo_of(x.c[0] * y.c[0], x.c[1] * y.c[1]); }
HOT duo duo_div(duo x, duo y) { return duo_of(x.c[0] / y.c[0], x.c[1] / y.c[1]); }
HOT duo duo_root(duo x) { return duo_of(root(x.c[0]), root(x.c[1])); }
HOT duo duo_size(duo x) { return duo_of(size(x.c[0]), size(x.c[1])); }
HOT duo duo_larger(duo x, duo y) { return duo_of(larger(x.c[0], y.c[0]), larger(x.c[1], y.c[1])); }
HOT duo duo_smaller(duo x, duo y) { return duo_of(smaller(x.c[0], y.c[0]), smaller(x.c[1], y.c[1])); }
HOT int are_larger(duo x, duo y) { return x.c[0] > y.c[0] && x.c[1] > y.c[1]; }
/* v where x > y, else w. */
HOT duo duo_where_larger(duo x, duo y, duo v, duo w)
{
    return duo_of(x.c[0] > y.c[0] ? v.c[0] : w.c[0], x.c[1] > y.c[1] ? v.c[1] : w.c[1]);
}
/* As signed_as has it. */
HOT duo duo_signed(duo x, duo y) { return duo_of(signed_as(x.c[0], y.c[0]), signed_as(x.c[1], y.c[1])); }
#endif

HOT duo duo_both(real x) { return duo_of(x, x); }

/* ---- a vector of each, and a map ---- */

typedef struct duos {
    duo c[DIM];
} duos;

typedef struct duo_map {
    duo c[DIM * DIM];
} duo_map;

HOT vec vec_of_a(duos x)
{
    vec r;
    EACH(r.c[i] = of_a(x.c[i]));
    return r;
}

HOT vec vec_of_b(duos x)
{
    vec r;
    EACH(r.c[i] = of_b(x.c[i]));
    return r;
}

/* The same vector for both. */
HOT duos duos_both(vec v)
{
    duos r;
    EACH(r.c[i] = duo_both(v.c[i]));
    return r;
}

HOT duos duos_of(vec a, vec b)
{
    duos r;
    EACH(r.c[i] = duo_of(a.c[i], b.c[i]));
    return r;
}

HOT duos duos_at(const real *a, const real *b)
{
    duos r;
    EACH(r.c[i] = duo_at(a + i, b + i));
    return r;
}

HOT duos duos_add(duos x, duos y)
{
    EACH(x.c[i] = duo_add(x.c[i], y.c[i]));
    return x;
}

HOT duos duos_sub(duos x, duos y)
{
    EACH(x.c[i] = duo_sub(x.c[i], y.c[i]));
    return x;
}

HOT duos duos_mul(duos x, duo k)
{
    EACH(x.c[i] = duo_mul(x.c[i], k));
    return x;
}

HOT duos duos_where_larger(duo x, duo y, duos v, duos w)
{
    EACH(v.c[i] = duo_where_larger(x, y, v.c[i], w.c[i]));
    return v;
}

HOT duos duos_signed(duos x, duos y)
{
    EACH(x.c[i] = duo_signed(x.c[i], y.c[i]));
    return x;
}

HOT duo duos_dot(duos x, duos y)
{
    duo r = duo_mul(x.c[0], y.c[0]);
    REST(r = duo_add(r, duo_mul(x.c[i], y.c[i])));
    return r;
}

#if DIM == 3
HOT duos duos_cross(duos x, duos y)
{
    duos r;
    r.c[0] = duo_sub(duo_mul(x.c[1], y.c[2]), duo_mul(x.c[2], y.c[1]));
    r.c[1] = duo_sub(duo_mul(x.c[2], y.c[0]), duo_mul(x.c[0], y.c[2]));
    r.c[2] = duo_sub(duo_mul(x.c[0], y.c[1]), duo_mul(x.c[1], y.c[0]));
    return r;
}
#endif

HOT duo duos_dot_size(duos x, duos y)
{
    duo r = duo_size(duo_mul(x.c[0], y.c[0]));
    REST(r = duo_add(r, duo_size(duo_mul(x.c[i], y.c[i]))));
    return r;
}

HOT duo duos_peak(duos x)
{
    duo r = duo_size(x.c[0]);
    REST(r = duo_larger(duo_size(x.c[i]), r));
    return r;
}

HOT duos row_of_map(const duo_map *m, int row)
{
    duos r;
    EACH(r.c[i] = m->c[DIM * row + i]);
    return r;
}

HOT duos duos_mapped(const duo_map *m, duos x)
{
    duos r;
    EACH(r.c[i] = duos_dot(row_of_map(m, i), x));
    return r;
}

/* The transpose, as pull has it. */
HOT duos duos_pulled(const duo_map *m, duos x)
{
    duos r = duos_mul(row_of_map(m, 0), x.c[0]);
    REST(r = duos_add(r, duos_mul(row_of_map(m, i), x.c[i])));
    return r;
}

/* As stretch has it. */
HOT duo duo_stretch(const duo_map *m)
{
    duo r = duo_both(0);
    for (int i = 0; i < DIM; i++) {
        duo row = duo_size(m->c[DIM * i]), column = duo_size(m->c[i]);
        for (int j = 1; j < DIM; j++) {
            row = duo_add(row, duo_size(m->c[DIM * i + j]));
            column = duo_add(column, duo_size(m->c[DIM * j + i]));
        }
        r = duo_larger(row, duo_larger(column, r));
    }
    return r;
}

#if HAS_LANES && !REAL_IS_DOUBLE
/* Four of each, one after another. */
HOT void four_duos_at(const real *a, const real *b, duo *r)
{
    const __m128 x = _mm_loadu_ps(a), y = _mm_loadu_ps(b), low = _mm_unpacklo_ps(x, y), high = _mm_unpackhi_ps(x, y);
    r[0].c = low;
    r[1].c = _mm_movehl_ps(low, low);
    r[2].c = high;
    r[3].c = _mm_movehl_ps(high, high);
}
#else
HOT void four_duos_at(const real *a, const real *b, duo *r)
{
    for (int i = 0; i < 4; i++) r[i] = duo_at(a + i, b + i);
}
#endif

HOT duo_map duo_map_at(const real *a, const real *b)
{
    duo_map r;
    for (int i = 0; i < DIM * DIM / 4; i++) four_duos_at(a + 4 * i, b + 4 * i, r.c + 4 * i);
    if (DIM > 2) r.c[DIM * DIM - 1] = duo_at(a + DIM * DIM - 1, b + DIM * DIM - 1);
    return r;
}

/* The squares of its columns, and the sum of these. */
HOT duos squares_of_duo_map(const duo_map *m)
{
    duos r;
    for (int i = 0; i < DIM; i++) {
        r.c[i] = duo_mul(m->c[i], m->c[i]);
        for (int j = 1; j < DIM; j++) r.c[i] = duo_add(r.c[i], duo_mul(m->c[DIM * j + i], m->c[DIM * j + i]));
    }
    return r;
}

HOT duo duos_sum(duos x)
{
    duo sum = x.c[0];
    REST(sum = duo_add(sum, x.c[i]));
    return sum;
}

HOT duo square_of_duo_map(const duo_map *m) { return duos_sum(squares_of_duo_map(m)); }

/* The upper digits, big being a power of two above x times ROUNDING_TO them. */
HOT duo upper_digits_of(duo x, duo big) { return duo_sub(duo_add(x, big), big); }

/* What rounds away in a sum. */
HOT duo duo_lost(duo x, duo y, duo sum)
{
    const duo t = duo_sub(sum, x);
    return duo_add(duo_sub(x, duo_sub(sum, t)), duo_sub(y, t));
}

/* ---- to twice the digits: as exact.h has it ---- */

typedef struct duo_twin {
    duo high, low;
} duo_twin;

typedef struct duo_halves {
    duo upper, lower;
} duo_halves;

HOT duo_twin duo_sum_of(duo x, duo y)
{
    const duo sum = duo_add(x, y);
    return (duo_twin){sum, duo_lost(x, y, sum)};
}

HOT duo_halves duo_halves_of(duo x)
{
    const duo t = duo_mul(x, duo_both(SPLITTER)), upper = duo_sub(t, duo_sub(t, x));
    return (duo_halves){upper, duo_sub(x, upper)};
}

HOT duo_twin duo_product_of_halves(duo x, duo_halves h, duo y, duo_halves k)
{
    const duo p = duo_mul(x, y), upper = duo_sub(duo_mul(h.upper, k.upper), p);
    const duo mixed = duo_add(duo_add(upper, duo_mul(h.upper, k.lower)), duo_mul(h.lower, k.upper));
    return (duo_twin){p, duo_add(mixed, duo_mul(h.lower, k.lower))};
}

HOT void duo_gather(duo_twin *sum, duo_twin x)
{
    const duo_twin s = duo_sum_of(sum->high, x.high);
    sum->high = s.high;
    sum->low = duo_add(sum->low, duo_add(s.low, x.low));
}

#endif
