/* SPDX-License-Identifier: MIT */
/* A polytope within the difference A - B: a closed surface of facets between corners of the difference, each turned
 * outward. It grows by one corner at a time: the facets that see the corner give way to facets from their rim to it.
 * Only that the surface is closed is ever relied on, and that is so by the way it is made: what is taken out and what
 * is put in have the same rim, whatever rounding says of who sees whom. Whether it surrounds the origin is proven at
 * the end. The memory is the caller's. */
#ifndef GJK_CORE_POLYTOPE_H
#define GJK_CORE_POLYTOPE_H

#include "exact.h"
#include "simplex.h"

#define FEWEST_TIPS 8
#define USUAL_TIPS 64
#define MOST_TIPS 16384

/* A corner of the polytope. */
typedef struct tip {
    vec w, low; /* of the difference, and what rounding took from it, where that is known */
    vec x, y;   /* of A and of B */
} tip;

typedef struct facet {
    vec n;          /* unit to rounding, outward; of a facet without area any unit vector */
    real height;    /* along n, the least of its corners' */
    int16_t v[DIM]; /* tips, counterclockwise from outside */
    int16_t done;   /* nothing lies beyond it */
    int16_t gone;   /* it makes room for the corner that is being taken in */
    int16_t thin;   /* it has no area to speak of, and its normal is noise */
} facet;

/* The rim of what is gone: in space an edge, from a tip to a tip; in the plane a tip, and whether a facet ended there.
 */
typedef struct seam {
    int16_t v[2];
} seam;

typedef struct polytope {
    tip *tip;
    facet *facet;
    seam *rim;
    int tips, facets, rims, most_tips, most_facets;
} polytope;

/* A closed surface of triangles has so many; of edges, no more than it has tips. */
static inline size_t facets_for(size_t tips) { return DIM == 2 ? tips : 2 * tips - 4; }

static inline size_t bytes_for(size_t tips)
{
    return tips * sizeof(tip) + facets_for(tips) * (sizeof(facet) + DIM * sizeof(seam));
}

/* How many go into so many bytes, which are enough for a few. */
static inline size_t tips_in(size_t bytes)
{
    size_t facet_bytes = sizeof(facet) + DIM * sizeof(seam);
    size_t tips =
        DIM == 2 ? bytes / (sizeof(tip) + facet_bytes) : (bytes + 4 * facet_bytes) / (sizeof(tip) + 2 * facet_bytes);
    return tips < MOST_TIPS ? tips : MOST_TIPS;
}

/* Of the usual number, in numbers. */
#define USUAL_ROOM                                                                                                     \
    ((USUAL_TIPS * sizeof(tip) +                                                                                       \
      (DIM == 2 ? USUAL_TIPS : 2 * USUAL_TIPS - 4) * (sizeof(facet) + DIM * sizeof(seam))) /                           \
         sizeof(real) +                                                                                                \
     1)

/* With room for so many tips; none but the counts is set. */
static polytope polytope_in(void *workspace, size_t tips)
{
    polytope p = {.tip = workspace, .most_tips = (int)tips, .most_facets = (int)facets_for(tips)};
    p.facet = (facet *)(void *)(p.tip + tips);
    p.rim = (seam *)(void *)(p.facet + p.most_facets);
    return p;
}

/* From one tip to another, to all digits that are known. */
static inline vec reach_over(const tip *from, const tip *to)
{
    return add(sub(to->w, from->w), sub(to->low, from->low));
}

static inline real height_of(const tip *t, vec n) { return dot(n, t->w) + dot(n, t->low); }

static vec unit_of(vec n, vec otherwise)
{
    real l = length(n);
    if (l > 0) return mul(n, 1 / l);
    l = length(otherwise);
    return l > 0 ? mul(otherwise, 1 / l) : axis(0, 1);
}

static real least_height(const polytope *p, const facet *f, vec n)
{
    real least = height_of(&p->tip[f->v[0]], n);
    for (int i = 1; i < DIM; i++) least = smaller(height_of(&p->tip[f->v[i]], n), least);
    return least;
}

#if DIM == 2
/* Square to the edge, to the right of it. */
static vec outward(const polytope *p, const facet *f, int *thin)
{
    vec e = reach_over(&p->tip[f->v[0]], &p->tip[f->v[1]]);
    *thin = 0;
    return (vec){{e.c[1], -e.c[0]}};
}
#else
/* From tip to tip, without rounding. */
static twin fine_reach(const tip *from, const tip *to, int i)
{
    twin r = sum_of(to->w.c[i], -from->w.c[i]);
    gather(&r, (twin){to->low.c[i], 0});
    gather(&r, (twin){-from->low.c[i], 0});
    return sum_of(r.high, r.low);
}

/* The normal of a narrow triangle, which rounded edges leave to noise. */
static vec fine_cross(const tip *at, const tip *first, const tip *second)
{
    twin a[3], b[3];
    vec n;
    for (int i = 0; i < 3; i++) {
        a[i] = fine_reach(at, first, i);
        b[i] = fine_reach(at, second, i);
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        twin r = product_of_twins(a[j], b[k]), back = product_of_twins(a[k], b[j]);
        gather(&r, (twin){-back.high, -back.low});
        n.c[i] = r.high + r.low;
    }
    return n;
}

/* From the two shorter edges, which meet in corner k. */
static vec outward(const polytope *p, const facet *f, int *thin)
{
    vec e[3];
    int k = 0;
    for (int i = 0; i < 3; i++) e[i] = reach_over(&p->tip[f->v[i]], &p->tip[f->v[(i + 1) % 3]]);
    for (int i = 1; i < 3; i++) k = dot(e[i], e[i]) > dot(e[k], e[k]) ? i : k;
    k = (k + 2) % 3;
    vec a = e[k], b = mul(e[(k + 2) % 3], -1), n = cross(a, b);
    real size = dot(a, a) * dot(b, b);
    if (!(dot(n, n) > (real)0.25 * size))
        n = fine_cross(&p->tip[f->v[k]], &p->tip[f->v[(k + 1) % 3]], &p->tip[f->v[(k + 2) % 3]]);
    *thin = !(dot(n, n) > 64 * UNIT * UNIT * UNIT * size);
    return n;
}

static vec nearest_of_edge(const tip *a, const tip *b)
{
    vec e = reach_over(a, b);
    real t = -dot(a->w, e) / dot(e, e);
    return t > 0 && t < 1 ? add(a->w, mul(e, t)) : !(t > 0) ? a->w : b->w;
}

/* A triangle without area to speak of has no normal; the way to its nearest point will do. */
static void straighten(const polytope *p, facet *f)
{
    for (int i = 0; i < 3; i++) {
        vec near = nearest_of_edge(&p->tip[f->v[i]], &p->tip[f->v[(i + 1) % 3]]), n = unit_of(near, near);
        real height = least_height(p, f, n);
        if (i > 0 && !(height > f->height)) continue;
        f->n = n;
        f->height = height;
    }
}
#endif

/* Takes the facet between these tips in. */
static void put_facet(polytope *p, const int16_t v[DIM])
{
    facet *f = &p->facet[p->facets++];
    for (int i = 0; i < DIM; i++) f->v[i] = v[i];
    f->done = f->gone = 0;
    int thin;
    f->n = unit_of(outward(p, f, &thin), p->tip[v[0]].w);
    f->thin = (int16_t)thin;
    f->height = least_height(p, f, f->n);
#if DIM == 3
    if (thin) straighten(p, f);
#endif
}

/* How far t lies beyond a tip along n; 0 where rounding leaves that open: of the sum, and of tips in a frame of size 1
 * to 2, which are known to twice the digits at best. */
static real rise(const tip *from, const tip *t, vec n)
{
    vec e = reach_over(from, t);
    real r = dot(n, e);
    return size(r) > 4 * UNIT * dot_size(n, e) + 32 * UNIT * UNIT ? r : 0;
}

/* Whether t lies beyond all corners of the facet, for certain. */
static int sees(const polytope *p, const facet *f, const tip *t)
{
    for (int i = 0; i < DIM; i++)
        if (!(rise(&p->tip[f->v[i]], t, f->n) > 0)) return 0;
    return 1;
}

/* Whether t lies behind all corners of the facet, for certain. */
static int is_behind(const polytope *p, const facet *f, const tip *t)
{
    for (int i = 0; i < DIM; i++)
        if (!(rise(&p->tip[f->v[i]], t, f->n) < 0)) return 0;
    return 1;
}

/* The seams of a facet, each in the form in which its neighbour there has the opposite one. */
static seam seam_of(const facet *f, int i)
{
#if DIM == 2
    return (seam){{f->v[i], (int16_t)i}};
#else
    return (seam){{f->v[i], f->v[(i + 1) % 3]}};
#endif
}

static seam opposite(seam s)
{
#if DIM == 2
    return (seam){{s.v[0], (int16_t)(1 - s.v[1])}};
#else
    return (seam){{s.v[1], s.v[0]}};
#endif
}

static int same_seam(seam a, seam b) { return a.v[0] == b.v[0] && a.v[1] == b.v[1]; }

/* Takes the facet out, once t is in: its seams are on the rim, but for those that were. */
static void take_out(polytope *p, facet *f)
{
    f->gone = 1;
    for (int i = 0; i < DIM; i++) {
        seam s = seam_of(f, i);
        int k = 0;
        while (k < p->rims && !same_seam(p->rim[k], opposite(s))) k++;
        p->rim[k] = k < p->rims ? p->rim[p->rims - 1] : s;
        p->rims += k < p->rims ? -1 : 1;
    }
}

/* The facet across the seam that is still standing. */
static facet *across_seam(const polytope *p, seam s)
{
    for (int k = 0; k < p->facets; k++)
        for (int i = 0; i < DIM && !p->facet[k].gone; i++)
            if (same_seam(seam_of(&p->facet[k], i), opposite(s))) return &p->facet[k];
    return NULL;
}

/* Of a t in the facet's plane, whether it is on the same side of the seam as the facet is. */
static int is_on_side(const polytope *p, const facet *f, seam s, const tip *t)
{
#if DIM == 2
    const tip *at = &p->tip[s.v[0]], *end = &p->tip[f->v[f->v[0] == s.v[0]]];
    return dot(reach_over(at, end), reach_over(at, t)) > 0;
#else
    const tip *from = &p->tip[s.v[1]], *to = &p->tip[s.v[0]];
    return dot(cross(f->n, reach_over(from, to)), reach_over(from, t)) > 0;
#endif
}

/* Whether the facet next to the rim goes too: t sees it; or, as far as rounding can tell, is in its plane, and a new
 * facet from the seam to t would lie on it, folded back; or it has no plane. */
static int goes_too(const polytope *p, const facet *f, seam s, const tip *t)
{
    if (f->thin || sees(p, f, t)) return 1;
    return !is_behind(p, f, t) && is_on_side(p, f, s, t);
}

static void put_facet_on(polytope *p, seam r, int t)
{
#if DIM == 2
    int16_t v[2] = {r.v[1] ? (int16_t)t : r.v[0], r.v[1] ? r.v[0] : (int16_t)t};
#else
    int16_t v[3] = {r.v[0], r.v[1], (int16_t)t};
#endif
    put_facet(p, v);
}

/* Takes in a corner that lies beyond the facet. 0, and nothing changed: there is no room for it. */
static int grow(polytope *p, facet *f, const tip *t)
{
    int gone = 1;
    p->rims = 0;
    take_out(p, f);
    for (int k = 0; k < p->rims; k++) {
        facet *next = across_seam(p, p->rim[k]);
        if (!next || !goes_too(p, next, p->rim[k], t)) continue;
        take_out(p, next);
        gone++;
        k = -1;
    }
    int full = p->tips == p->most_tips || p->rims == 0 || p->facets - gone + p->rims > p->most_facets, kept = 0;
    for (int k = 0; k < p->facets; k++) {
        if (full) p->facet[k].gone = 0;
        if (!p->facet[k].gone) p->facet[kept++] = p->facet[k];
    }
    p->facets = kept;
    if (full) return 0;
    p->tip[p->tips] = *t;
    for (int k = 0; k < p->rims; k++) put_facet_on(p, p->rim[k], p->tips);
    p->tips++;
    return 1;
}

static facet *lowest(const polytope *p)
{
    facet *f = &p->facet[0];
    for (int i = 1; i < p->facets; i++)
        if (p->facet[i].height < f->height || (p->facet[i].height == f->height && p->facet[i].done > f->done))
            f = &p->facet[i];
    return f;
}

/* Twice the area, or six times the volume, of the first DIM + 1 tips: above 0 where they turn counterclockwise. */
static real turn_of(const polytope *p)
{
#if DIM == 2
    return cross(reach_over(&p->tip[0], &p->tip[1]), reach_over(&p->tip[0], &p->tip[2]));
#else
    return dot(fine_cross(&p->tip[0], &p->tip[1], &p->tip[2]), reach_over(&p->tip[0], &p->tip[3]));
#endif
}

/* The first DIM + 1 tips, as a surface. turn: which way they do. */
static void put_simplex(polytope *p, real turn)
{
#if DIM == 2
    static const int16_t side[3][2] = {{0, 1}, {1, 2}, {2, 0}};
#else
    static const int16_t side[4][3] = {{2, 1, 0}, {1, 3, 0}, {3, 2, 0}, {2, 3, 1}};
#endif
    for (int k = 0; k <= DIM; k++) {
        int16_t v[DIM];
        for (int i = 0; i < DIM; i++) v[i] = side[k][turn > 0 || i > 1 ? i : 1 - i];
        put_facet(p, v);
    }
}

#endif
