/* SPDX-License-Identifier: MIT */
/* How deep round sets are, without a polytope: an ellipsoid within A - B that touches its surface where the heights are
 * least nearby. The sum of lengths |L y| of the limbs is no less than the length of the sum of all L y, however each of
 * these is turned (Kurzhanski and Valyi 1997). Whether that ellipsoid holds the ball of that height around the origin
 * is told by one matrix (the S-lemma: Polik and Terlaky 2007). If it does, no way out is shorter (docs/bounds.md). */
#ifndef GJK_CORE_INBALL_H
#define GJK_CORE_INBALL_H

#include "round.h"

/* What the limbs give to the ellipsoid: its height along n is along + middle.n. */
typedef struct ovoid {
    vec middle;
    real along;
    real times[MOST_LIMBS]; /* so much of each |L y|; the rest is linear in y, and has gone to the middle */
} ovoid;

/* The limb whose length n has none of: its shares are of the middle. */
static real give_edge(const bulk *of, const bent *b, int at, ovoid *e)
{
    const limb *l = &of->limb[at];
    int k = 0;
    for (int r = 0; r < b->rows; r++)
        if (b->of[r] == at) e->middle = add(e->middle, mul(l->row[k++], b->share[r]));
    return 1 - share_of_limb(b, at);
}

static void give_limb(const bulk *of, const bent *b, int at, ovoid *e)
{
    const limb *l = &of->limb[at];
    const bearing v = bearing_of(l, b->n);
    const int on_edge = is_on_edge(b, at) && !is_on_slant(b, at);
    const real leans = on_edge ? 1 : (1 + b->sign[at]) / 2; /* of a cone's */
    if (l->partial) e->middle = add(e->middle, mul(l->lean, leans));
    e->times[at] = on_edge ? give_edge(of, b, at, e) : l->partial ? leans : 1;
    if (!on_edge) e->along += e->times[at] * (l->rows == 1 ? size(v.here) : v.far);
}

/* Adds the symmetric root of the square of the map that leads to these columns. */
static void add_root(quadric *sum, const vec x[ACROSS])
{
#if DIM == 2
    sum->c[0][0] += length(x[0]);
#else
    const real xx = dot(x[0], x[0]), yy = dot(x[1], x[1]), area = length(cross(x[0], x[1]));
    const real trace = root(xx + yy + 2 * area);
    if (!(trace > 0)) return;
    sum->c[0][0] += (xx + area) / trace;
    sum->c[1][0] += dot(x[0], x[1]) / trace;
    sum->c[1][1] += (yy + area) / trace;
#endif
}

/* What the limb does to those directions across n: square to where it leads n, if it does. */
static void add_limb_across(const limb *l, const bent *b, int on_edge, real times, const vec u[ACROSS], quadric *sum)
{
    const bearing v = bearing_of(l, b->n);
    vec x[ACROSS];
    if (!on_edge && l->rows == 1) return;
    for (int j = 0; j < ACROSS; j++) {
        EACH(x[j].c[i] = times * dot(l->row[i], u[j]));
        if (on_edge) continue;
        const vec a = mul(v.along, 1 / v.far);
        x[j] = sub(x[j], mul(a, dot(a, x[j])));
    }
    add_root(sum, x);
}

/* By how much the ellipsoid is wider across n than 1 at least, in these directions across, to the first order. */
static real spare_across(const bulk *of, const bent *b, const ovoid *e, const vec u[ACROSS])
{
    quadric sum = {{{0}}};
    for (int i = 0; i < of->limbs; i++)
        add_limb_across(&of->limb[i], b, is_on_edge(b, i) && !is_on_slant(b, i), e->times[i], u, &sum);
    return least_value(&sum) - 1;
}

/* The least value, on unit vectors, of the form in n and what is across that is to be above 0, or less; 0: it is not
 * above 0. */
static real room_of_ball(const bulk *of, const bent *b)
{
    ovoid e = {.middle = of->middle};
    for (int i = 0; i < of->limbs; i++) give_limb(of, b, i, &e);
    const real off = -dot(e.middle, b->n), low = b->height * e.along;
    real t[ACROSS];
    for (int j = 0; j < ACROSS; j++) t[j] = dot(e.middle, b->e[j]);
    const real far = length_across(t), aside = far > UNIT ? far : 0, lean = aside / off; /* less is not known */
    if (!(off > 0)) return 0;
    const real high = low + b->height * aside * lean; /* asked along t, low across */
    vec u[ACROSS];
#if DIM == 3
    const real per = 1 / aside, x = aside > 0 ? t[0] * per : 1, y = aside > 0 ? t[1] * per : 0;
    u[0] = add(mul(b->e[0], x), mul(b->e[1], y));
    u[1] = mul(sub(mul(b->e[1], x), mul(b->e[0], y)), 1 / root(low));
#else
    u[0] = b->e[0];
#endif
    u[0] = mul(u[0], 1 / root(high));
    const real spare = spare_across(of, b, &e, u);
    if (!(spare > 0)) return 0;
    const real room = smaller(b->height * off / 2, 2 * spare * low / (1 + 2 * lean * lean));
    return room / ((1 + lean) * (1 + lean));
}

/* The same, told once. */
static real known_room(const bulk *of, bent *b)
{
    if (b->room < 0) b->room = room_of_ball(of, b);
    return b->room;
}

/* What rounding and the slope do to the form and to the ellipsoid. */
static inline real slope_of(const bent *b) { return length_across(b->slope) + b->slope_off; }
static inline real off_of_room(const bent *b) { return 2048 * UNIT + 128 * slope_of(b); }

/* A - B is as high as the dip's floor along all ways, if it is along those within the tangent far of n, up to 1; over:
 * so high above that floor is the corner there. */
static inline int is_least_of_all(const bent *b, real room, real over, real far)
{
    return room * (far * far) / 2 >= off_of_room(b) + 64 * over;
}

/* Whether ellipsoids all but share their middles. */
#define ALL_BUT ((real)0x1p-20)
static inline int is_centred(const bulk *of, real height)
{
    return are_ellipsoids(of) && length(of->middle) <= ALL_BUT * height;
}

/* Whether there are ways beside n along which A - B is about as high, as of balls that share their middles: corners
 * prove these but slowly, and what the ellipsoid proves is taken if it is no more than so much off: of a frame of size
 * 2, four times what middles may be apart where neither their way nor the bodies' own unroundness, in float poses
 * 2^-24, decides which way is the least; and what is charged, in float. */
#define ALONE_OFF ((real)0x1p-25 + (real)0x1p16 * UNIT)
static inline int is_level_around(const bent *b) { return least_value(&b->bow) <= b->height * (1 + (real)0x1p-8); }

/* How high A - B is along all ways by the ellipsoid alone, of ellipsoids, if it is as high as r along n, and over as
 * above: some roundings less. -REAL_MAX: that is not told. */
static real height_of_all(const bulk *of, const bent *b, real room, real r, real over)
{
    const real apart = length(of->middle), steep = 2 * slope_of(b) + 8 * over;
    if (room > 2 * off_of_room(b) && are_ellipsoids(of) && apart <= r / 4)
        return r - (32 * over + 4 * steep * (steep / room)) / r;
    if (!is_centred(of, r)) return -REAL_MAX;
    ovoid e = {.middle = axis(0, 0)};
    for (int i = 0; i < of->limbs; i++) give_limb(of, b, i, &e);
    vec u[ACROSS];
    for (int j = 0; j < ACROSS; j++) u[j] = mul(b->e[j], 1 / root(b->height * e.along));
    const real spare = spare_across(of, b, &e, u);
    if (!(spare >= -ALL_BUT)) return -REAL_MAX;
    return b->height * (1 + smaller(spare, 0)) - 4 * apart - 512 * UNIT - 8 * slope_of(b);
}

#endif
