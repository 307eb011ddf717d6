/* SPDX-License-Identifier: MIT */
/* The difference of two boxes A - B as a zonotope, the sum of six ways, to and fro: the boxes' own axes. Each of its
 * facets lies along two of these, so its normal is across a pair of axes, and of pairs there are 15, in the plane of
 * axes 4. Their heights over the origin in plain numbers, and what those may be off (docs/bounds.md). */
#ifndef GJK_CORE_ZONOTOPE_H
#define GJK_CORE_ZONOTOPE_H

#include "minkowski.h"

#define AXES (2 * DIM)
#define PAIRS_OF_AXES (DIM == 2 ? 4 : 15)

/* A - B: the points of the sum of s_k e_k u_k with s_k from -1 to 1, minus c. A's axes come first. */
typedef struct zonotope {
    vec u[AXES]; /* each box's map has a norm from 1 to 2, to rounding */
    real e[AXES], uu[AXES];
    real level[2]; /* the power of two by which a box's axes are more than its map's, and its halves less */
    vec c, c_low;
    real far; /* bounds the sum of the e_k |u_k| and |c| */
} zonotope;

/* The facet across a pair of axes: its normal, not of length 1, and its height times that length. */
typedef struct pair_of_axes {
    vec l;
    real ll, height;
    real size; /* bounds the product of the axes' lengths */
} pair_of_axes;

/* The axes of one box, its map brought to that level, and how far it reaches along them. */
static inline void take_axes(zonotope *z, int box_at, const body *k, real level)
{
    const box *of = k->data;
    vec *u = z->u + DIM * box_at;
    real *e = z->e + DIM * box_at, *uu = z->uu + DIM * box_at;
    z->level[box_at] = level;
    for (int j = 0; j < DIM; j++) {
        if (k->posed) {
            EACH(u[j].c[i] = k->m[DIM * i + j] * level);
        } else u[j] = axis(j, 1);
        e[j] = of->half[j] * k->grain * (1 / level); /* in this order nothing overflows */
        uu[j] = dot(u[j], u[j]);
    }
}

/* 0: its axes are of too different lengths, or the box is too small beside the other to tell. */
static inline int is_fair(const zonotope *z, int box_at)
{
    const real *e = z->e + DIM * box_at, *uu = z->uu + DIM * box_at, least = (real)0.25;
    real reach = 0;
    int fair = 1;
    for (int j = 0; j < DIM; j++) {
        fair &= uu[j] > least;
        reach += e[j];
    }
    return fair && reach > UNIT;
}

/* The least of all numbers no power of two brings to size 1; what is reckoned to twice the digits takes it to be. */
#define SMALLEST_FAR ((real)0.125)

/* 0: as above, or so small are both. */
static inline int take_boxes(zonotope *z, const difference *d)
{
    z->c = d->c;
    z->c_low = d->c_low;
    z->far = spread(d->c);
    take_axes(z, 0, &d->a, level_of_map(&d->a));
    take_axes(z, 1, &d->b, level_of_map(&d->b));
    for (int k = 0; k < AXES; k++) z->far += z->e[k] * ((z->uu[k] + 1) / 2);
    return z->far > SMALLEST_FAR && is_fair(z, 0) && is_fair(z, 1);
}

/* ---- the facets, in plain numbers ---- */

/* What a height may be off, times the length of the normal: in shares of size times far. */
#define PAIR_DOUBT (32 * UNIT)

/* It shows the boxes to be apart. */
static inline int is_outside(const zonotope *z, const pair_of_axes *p)
{
    return p->height < -PAIR_DOUBT * p->size * z->far;
}

#if DIM == 2
static const unsigned char first_of[PAIRS_OF_AXES] = {0, 1, 2, 3}, second_of[PAIRS_OF_AXES] = {0, 1, 2, 3};

static inline real height_of_pair(const zonotope *z, vec l)
{
    real h = 0;
    for (int k = 0; k < AXES; k++) h += z->e[k] * size(dot(l, z->u[k]));
    return h - size(dot(l, z->c));
}

/* 0: one of them shows the boxes to be apart. */
static inline int find_pairs(const zonotope *z, pair_of_axes p[PAIRS_OF_AXES])
{
    for (int k = 0; k < AXES; k++) {
        const vec u = z->u[k], l = {{-u.c[1], u.c[0]}};
        p[k] = (pair_of_axes){l, z->uu[k], height_of_pair(z, l), (z->uu[k] + 1) / 2};
        if (is_outside(z, &p[k])) return 0;
    }
    return 1;
}
#else
static const unsigned char first_of[PAIRS_OF_AXES] = {1, 2, 0, 4, 5, 3, 0, 0, 0, 1, 1, 1, 2, 2, 2};
static const unsigned char second_of[PAIRS_OF_AXES] = {2, 0, 1, 5, 3, 4, 3, 4, 5, 3, 4, 5, 3, 4, 5};

/* Axis i + k of a box, round and round. */
static const unsigned char next_axis[5] = {0, 1, 2, 0, 1};

/* 0: one of them shows the boxes to be apart; those across axes of one box do as a rule. Each product of three axes is
 * part of several heights. */
static inline int find_pairs(const zonotope *z, pair_of_axes p[PAIRS_OF_AXES])
{
    real across[2][3][3]; /* of the face normal m of a box with axis k of the other */
    for (int b = 0; b < 2; b++) {
        const vec *own = z->u + 3 * b, *other = z->u + 3 - 3 * b;
        const real *e = z->e + 3 * b, *f = z->e + 3 - 3 * b;
        const vec n[3] = {cross(own[1], own[2]), cross(own[2], own[0]), cross(own[0], own[1])};
        const real volume = size(dot(n[0], own[0]));
        for (int m = 0; m < 3; m++) {
            real h = e[m] * volume;
            for (int k = 0; k < 3; k++) {
                across[b][m][k] = size(dot(n[m], other[k]));
                h += f[k] * across[b][m][k];
            }
            pair_of_axes *q = &p[3 * b + m];
            q->l = n[m];
            q->ll = dot(n[m], n[m]);
            q->height = h - size(dot(n[m], z->c));
            q->size = (z->uu[3 * b + next_axis[m + 1]] + z->uu[3 * b + next_axis[m + 2]]) / 2;
            if (is_outside(z, q)) return 0;
        }
    }
    for (int i = 0; i < 3; i++) {
        const int i1 = next_axis[i + 1], i2 = next_axis[i + 2];
        for (int j = 0; j < 3; j++) {
            const int j1 = next_axis[j + 1], j2 = next_axis[j + 2];
            pair_of_axes *q = &p[6 + 3 * i + j];
            q->l = cross(z->u[i], z->u[3 + j]);
            q->ll = dot(q->l, q->l);
            q->height = z->e[i1] * across[0][i2][j] + z->e[i2] * across[0][i1][j] + z->e[3 + j1] * across[1][j2][i] +
                        z->e[3 + j2] * across[1][j1][i] - size(dot(q->l, z->c));
            q->size = (z->uu[i] + z->uu[3 + j]) / 2;
            if (is_outside(z, q)) return 0;
        }
    }
    return 1;
}
#endif

/* Axes that are as good as parallel have no normal to trust. */
#define PARALLEL ((real)0x1p-12)
static inline int is_steady(const pair_of_axes *p) { return p->ll > PARALLEL * (p->size * p->size); }

/* The lowest facet, by rounded heights, of pairs that have a good normal. */
static inline int lowest_pair(const pair_of_axes p[PAIRS_OF_AXES])
{
    int best = 0;
    real least = REAL_MAX;
    for (int k = 0; k < PAIRS_OF_AXES; k++) {
        const real square = p[k].height * size(p[k].height) / p[k].ll;
        if (!(square < least) || !is_steady(&p[k])) continue;
        least = square;
        best = k;
    }
    return best;
}

/* The facet is certainly no lower than that. */
static inline int is_above(const zonotope *z, const pair_of_axes *p, real height)
{
    const real least = p->height - PAIR_DOUBT * p->size * z->far;
    return least >= 0 && least * least >= height * height * p->ll;
}

#endif
