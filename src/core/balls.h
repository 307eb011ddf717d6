/* SPDX-License-Identifier: MIT */
/* Balls. Of a point with a radius more is known, and sooner, than of what is round: its nearest points and its ways out
 * are those of the other body alone. So a ball that its map leaves one is taken for that; off by what the map, which
 * has been rounded as a rule, makes of it. */
#ifndef GJK_CORE_BALLS_H
#define GJK_CORE_BALLS_H

#include "exact.h"
#include "shapes.h"

/* Two bodies, the balls of which stand as points. */
typedef struct pointed {
    shape own[2];
    pose at[2];
    const shape *a, *b; /* these, or the caller's */
    real off;           /* surfaces are no farther off than this */
} pointed;

/* Whether the radii may be one, times powers of two. */
static int have_one_fraction(const real *r)
{
    int same = 1;
    for (int i = 1; i < DIM; i++) same &= fraction_of(r[i]) == fraction_of(r[0]);
    return same;
}

static inline int may_be_ball(const shape *s)
{
    return s->support == pub(support_ball) ||
           (s->support == pub(support_ellipsoid) && s->data && have_one_fraction(s->data));
}

/* What may be a ball has radii f times 2^e[i], f in [1, 2). 0: one is no normal number. */
static int take_radii(const shape *s, real *f, int e[DIM])
{
    const real *r = s->data;
    for (int i = 0; i < DIM; i++) {
        const real here = r[s->support == pub(support_ball) ? 0 : i];
        if (!(here >= REAL_MIN && here <= REAL_MAX)) return 0;
        e[i] = exponent_of(here);
        *f = raised(here, -e[i]);
    }
    return 1;
}

/* Columns of the map times 2^e, of one size: the largest number is in [1, 2). Times which power of two. 0: none is
 * a normal number. */
static int bring_map(real n[DIM][DIM], const pose *m, const int e[DIM], int *top)
{
    int found = 0;
    for (int i = 0; i < DIM * DIM; i++) {
        const real here = m ? size(m->m[i]) : i % (DIM + 1) == 0;
        if (!(here <= REAL_MAX)) return 0;
        if (!(here >= REAL_MIN)) continue;
        const int at = exponent_of(here) + e[i % DIM];
        *top = found && *top > at ? *top : at;
        found = 1;
    }
    for (int i = 0; i < DIM * DIM && found; i++)
        n[i / DIM][i % DIM] = raised(m ? m->m[i] : i % (DIM + 1) == 0, e[i % DIM] - *top);
    return found;
}

/* How much longer or shorter n makes vectors than 1 or 2, whichever it may be, over that, at most (docs/bounds.md); 0
 * where it only exchanges axes. doubled: it is 2. */
static real out_of_round(real n[DIM][DIM], int *doubled)
{
    real most = 0, square = 0;
    int whole = 1;
    for (int k = 0; k < DIM; k++) square += n[0][k] * n[0][k];
    *doubled = square > 2;
    for (int i = 0; i < DIM; i++) {
        real sum = 0;
        for (int j = 0; j < DIM; j++) {
            twin t = {i == j ? *doubled ? -4 : -1 : 0, 0};
            for (int k = 0; k < DIM; k++) gather(&t, product_of(n[i][k], n[j][k]));
            sum += size(t.high + t.low);
            whole &= n[i][j] == 0 || size(n[i][j]) == 1;
        }
        if (!(sum <= most)) most = sum;
    }
    if (*doubled) most /= 4;
    return whole && most == 0 ? 0 : most * ((real)0.5 + most) + 64 * UNIT * UNIT;
}

/* The radius of what is a ball as it is posed, off by no more than that share. 0: it is none. */
static int is_ball(const shape *s, real most, real *radius, real *skew)
{
    real f = 0, n[DIM][DIM];
    int e[DIM], top = 0, doubled;
    if (!may_be_ball(s) || !s->data || !(s->radius == 0)) return 0;
    if (!take_radii(s, &f, e) || !bring_map(n, s->pose, e, &top)) return 0;
    *skew = out_of_round(n, &doubled);
    *radius = raised(f, top + doubled);
    return *skew <= most && *radius >= REAL_MIN && *radius <= REAL_MAX / 16;
}

/* The same as a point, the i-th, if it is a ball; else as it is. */
static const shape *as_point(pointed *k, int i, const shape *s, real most)
{
    real radius, skew;
    if (!is_ball(s, most, &radius, &skew)) return s;
    k->off += radius * skew * (1 + 4 * UNIT);
    k->own[i] = (shape){.support = pub(support_origin), .radius = radius};
    if (s->pose) {
        for (int j = 0; j < DIM * DIM; j++) k->at[i].m[j] = j % (DIM + 1) == 0;
        memcpy(k->at[i].p, s->pose->p, sizeof s->pose->p);
        k->own[i].pose = &k->at[i];
    }
    return &k->own[i];
}

/* Of either. 0: there is none. */
static int take_balls(pointed *k, const shape *a, const shape *b, real most)
{
    k->off = 0;
    k->a = as_point(k, 0, a, most);
    k->b = as_point(k, 1, b, most);
    return k->a != a || k->b != b;
}

#endif
