/* SPDX-License-Identifier: MIT */
/* Round sets near the way out: how high they are at least, around where their height is least nearby, is proven by
 * curvature (docs/bounds.md), which corners prove but slowly. */
#ifndef GJK_CORE_DIP_H
#define GJK_CORE_DIP_H

#include "round.h"

/* Where the height of A - B is least nearby: along n. Around there it is proven by curvature, not by facets. In their
 * place a polytope takes in a tip that is no corner, but stands out of A - B: `at`, along n. It is of account only to
 * ways along which it is higher than what is to be proven, and these are near n. */
typedef struct dip {
    vec n, at;
    vertex corner;          /* along n, */
    real below;             /* and the bound from below that it gave */
    real aside;             /* so far is the corner from where n is that high */
    real height;            /* of A - B along n, at least */
    quadric bow, kink;      /* see bent, */
    quadric part, rim;      /*   of cones' edges: */
    int rimmed;             /*   there are some; */
    real bow_off, kink_off; /*   off by no more; */
    real slope, sway;       /*   at most */
    real floor;             /* no way out that is near n, as far as `at` is of account, is shorter; */
    real far;               /*   that is as a tangent; 0: only that of all ways is proven; */
    real held;              /* no way out at all is shorter: as ellipsoids have it */
    int everywhere;         /*   nor than the floor */
    int planted;            /* `at` is in the polytope, */
    int frayed;             /*   and facets around it have been dropped */
} dip;

/* How far from n, as a tangent, ways lead along which the tip is higher than r. */
static real reach_of_tip(const dip *f, real r)
{
    const real share = length(f->at) * (1 + 8 * UNIT) / r;
    return root(larger(share * share - 1, 0) + 32 * UNIT) * (1 + 32 * UNIT);
}

/* How much the height is bowed, kinks and all, as seen from that far at least; where cones' edges give that share. */
static real bow_given(const dip *f, real far, real share)
{
    quadric sum;
    const real k = 1 / (1 + f->sway * far), l = 1 / far;
    for (int i = 0; i < ACROSS; i++)
        for (int j = 0; j <= i; j++)
            sum.c[i][j] =
                k * (f->bow.c[i][j] - share * f->part.c[i][j]) + l * (f->kink.c[i][j] + share * f->rim.c[i][j]);
    return least_value(&sum) - f->bow_off - l * f->kink_off -
           32 * UNIT * (size(sum.c[0][0]) + size(sum.c[ACROSS - 1][ACROSS - 1]));
}

/* So little of the bow may be given. */
#define LEAST_GIVEN ((real)0x1p-5)

/* The same with the share that proves most. */
static real bow_within(const dip *f, real far)
{
    real most = bow_given(f, far, f->rimmed ? 1 : 0);
    for (real share = (real)0.5; f->rimmed && share >= LEAST_GIVEN; share /= 2)
        most = larger(bow_given(f, far, share), most);
    return most;
}

/* Along ways that lead no farther from n A - B is at least as high as this, if it is to be as high as r. */
static real floor_near(const dip *f, real far, real r)
{
    const real bow = bow_within(f, far) - r * (1 + 8 * UNIT);
    if (!(bow > UNIT && far < 8)) return -REAL_MAX;
    return f->height - 8 * UNIT * r - f->slope * f->slope / bow;
}

#define NEAREST ((real)0x1p-12)

/* Takes what is known of the height along n. 0: nothing is proven by it. */
static int set_tip(dip *f)
{
    const real spare = smaller(f->height, bow_within(f, NEAREST) - f->height) / 4;
    real far = 1;
    if (!(spare > 0)) return 0;
    while (far > NEAREST && !(bow_within(f, far) >= f->height + spare)) far *= (real)0.75;
    f->far = far;
    f->floor = floor_near(f, far, f->height);
    f->at = mul(f->n, f->floor * root(1 + (real)0.9375 * far * far));
    return f->floor > 0;
}

#endif
