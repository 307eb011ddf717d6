/* SPDX-License-Identifier: MIT */
/* Two points or segments, in float beside the sister: a formula in double tells which of their points are nearest, and
 * how high the ends lie along the way between these proves it, or does not (docs/bounds.md). */
#ifndef GJK_CORE_WIDE_STICKS_H
#define GJK_CORE_WIDE_STICKS_H

#include "double.h"

#if HAS_SISTER

/* Bounds are off by so much of A + B + |c|_1 at most, where ends add up to A and B, without the signs of any of the
 * products that place them: 16 roundings. */
#define WIDE_DOUBT 0x1p-49

/* By so much of the sum of all coordinates may a bracket be wide, if it is to be the answer: a share of a float's
 * rounding. */
#define WIDE_WIDTH 0x1p-26

/* So many doubts long is a way that is a direction to a float's rounding. */
#define WIDE_AWAY 0x1p20

/* A vector of each body, side by side. */
typedef struct dduo {
    dvec c[DIM];
} dduo;

HOT dduo dduo_at(const real *a, const real *b)
{
    dduo r;
    EACH(r.c[i] = dvec_of((double)a[i], (double)b[i]));
    return r;
}

HOT dvec dduo_dot(dduo x, dduo y)
{
    dvec r = dtimes(x.c[0], y.c[0]);
    REST(r = dadd(r, dtimes(x.c[i], y.c[i])));
    return r;
}

/* Without signs, all in all. */
HOT dvec dduo_sizes(dduo x)
{
    dvec r = dsizes(x.c[0]);
    REST(r = dadd(r, dsizes(x.c[i])));
    return r;
}

HOT double dsum(dvec x) { return dfirst(x) + dsecond(x); }

/* A point or a segment of each. */
typedef struct wide_pair {
    dduo end[2], way; /* placed from the bodies' positions, */
    dduo p;           /* which are there, */
    double c[DIM];    /* from the first to the second */
    double whole;     /* the sum of the sizes of all their coordinates and of c's; */
    double doubt;     /* by no more are bounds off */
} wide_pair;

/* Where the core's ends are, one after the other. NULL: it has none. */
HOT const real *ends_of_stick(const shape *s)
{
    static const real nothing[2 * DIM] = {0};
    if (s->support == pub(support_origin)) return nothing;
    return s->support == pub(support_segment) && s->data ? ((const segment *)s->data)->v[0] : NULL;
}

HOT const real *map_of_shape(const shape *s) { return s->pose ? s->pose->m : unturned; }

HOT const real *place_of_shape(const shape *s)
{
    static const real nothing[DIM] = {0};
    return s->pose ? s->pose->p : nothing;
}

/* 0: they are none, or their sizes may be no floats. */
HOT int place_wide_sticks(const shape *a, const shape *b, wide_pair *s)
{
    const real *of_a = ends_of_stick(a), *of_b = ends_of_stick(b);
    if (!of_a || !of_b) return 0;
    const real *m = map_of_shape(a), *n = map_of_shape(b);
    const dduo first = dduo_at(of_a, of_b), last = dduo_at(of_a + DIM, of_b + DIM);
    dvec map = dboth(0);
    for (int i = 0; i < DIM; i++) {
        const dduo row = dduo_at(m + DIM * i, n + DIM * i);
        map = dadd(map, dduo_sizes(row));
        s->end[0].c[i] = dduo_dot(row, first);
        s->end[1].c[i] = dduo_dot(row, last);
        s->way.c[i] = dsub(s->end[1].c[i], s->end[0].c[i]);
    }
    s->p = dduo_at(place_of_shape(a), place_of_shape(b));
    double between = 0;
    EACH(s->c[i] = dsecond(s->p.c[i]) - dfirst(s->p.c[i]); between += fabs(s->c[i]));
    const double far = dsum(dtimes(map, dadd(dduo_sizes(first), dduo_sizes(last)))) + between;
    s->whole = dsum(dadd(dduo_sizes(s->end[0]), dduo_sizes(s->end[1]))) + between;
    s->doubt = far * WIDE_DOUBT;
    return far <= (double)REAL_MAX / 4;
}

HOT double dwithin_way(double share) { return share > 0 ? share < 1 ? share : 1 : 0; }

/* As nearest_shares has it (thin.h). */
HOT dvec nearest_dshares(const wide_pair *k)
{
    const dvec none = dboth(0), squares = dduo_dot(k->way, k->way);
    const dvec per = dwhere_below(none, squares, ddivide(dboth(1), squares), none);
    dvec along = none;
    double ab = 0;
    for (int i = 0; i < DIM; i++) {
        const double r = dfirst(k->end[0].c[i]) - (dsecond(k->end[0].c[i]) + k->c[i]);
        along = dadd(along, dmul(k->way.c[i], r));
        ab += dfirst(k->way.c[i]) * dsecond(k->way.c[i]);
    }
    const double aa = dfirst(squares), per_a = dfirst(per), per_b = dsecond(per);
    const double ar = dfirst(along), br = dsecond(along), on = ab * per_b, whole = aa - on * ab;
    const double s = whole > (double)PARALLEL * aa ? dwithin_way((on * br - ar) / whole) : 0.5;
    const double t = dwithin_way((ab * s + br) * per_b);
    return dvec_of(dwithin_way((ab * t - ar) * per_a), t);
}

/* What the pair at such shares shows. */
typedef struct wide_sight {
    dduo at;         /* the points, */
    double way[DIM]; /* from b's to a's, */
    double far, per; /* the length of that, and one by it; */
    double height;   /* the cores are so far apart along it at least, but for rounding */
} wide_sight;

HOT void sight_wide_sticks(const wide_pair *k, dvec share, wide_sight *e)
{
    double square = 0, c = 0;
    dvec first = dboth(0), last = first;
    for (int i = 0; i < DIM; i++) {
        e->at.c[i] = dadd(k->end[0].c[i], dtimes(k->way.c[i], share));
        e->way[i] = dfirst(e->at.c[i]) - (dsecond(e->at.c[i]) + k->c[i]);
        square += e->way[i] * e->way[i];
        c += e->way[i] * k->c[i];
        first = dadd(first, dmul(k->end[0].c[i], e->way[i]));
        last = dadd(last, dmul(k->end[1].c[i], e->way[i]));
    }
    const dvec least = dsmaller(first, last), most = dlarger(first, last);
    e->far = droot(square);
    e->per = 1 / e->far;
    e->height = (dfirst(least) - dsecond(most) - c) * e->per;
}

/* The points where the radii end; or between them, where the radii meet and it is not asked how deep. */
HOT void spell_wide_points(const wide_pair *k, const wide_sight *e, double of_a, double of_b, int between, result *r)
{
    const dvec radii = dvec_of(of_a, -of_b);
    const double share = of_a / (of_a + of_b);
    for (int i = 0; i < DIM; i++) {
        const double toward_b = -e->way[i] * e->per;
        dvec at = dadd(e->at.c[i], k->p.c[i]);
        if (between) at = dboth(dfirst(at) - e->way[i] * share);
        else at = dadd(at, dmul(radii, toward_b));
        real both[2];
        dstore(both, dinto_range(at));
        r->point_a[i] = both[0];
        r->point_b[i] = both[1];
        r->normal[i] = (real)(0 + toward_b);
    }
}

/* 0: they are none, or the formula does not tell. */
HOT int tell_wide_sticks(const shape *a, const shape *b, const goal *g, result *r)
{
    wide_pair k;
    wide_sight e;
    const double of_a = (double)a->radius, of_b = (double)b->radius, radius = of_a + of_b;
    if (!place_wide_sticks(a, b, &k)) return 0;
    if (!(of_a >= 0 && of_b >= 0 && radius <= (double)REAL_MAX / 16)) return 0;
    sight_wide_sticks(&k, nearest_dshares(&k), &e);
    const double off = k.doubt + radius * 0x1p-51;
    const double lower = e.height - radius - off, upper = e.far - radius + off;
    const int meet = upper < 0, narrow = upper - lower <= k.whole * WIDE_WIDTH && e.far > k.doubt * WIDE_AWAY;
    if (!(e.far > k.doubt) || !(lower > 0 || meet)) return 0;
    if (!narrow && (meet ? g->deep : !g->sign_only)) return 0;
    real bounds[2]; /* the upper one's sign turned */
    dstore(bounds, dbelow(dvec_of(lower, -upper)));
    if (!(bounds[0] > 0 || meet)) return 0;
    r->lower = bounds[0];
    r->upper = meet ? smaller(-bounds[1], 0) : -bounds[1];
    r->value = (real)(e.far - radius);
    spell_wide_points(&k, &e, of_a, of_b, meet && !g->deep, r);
    r->steps = 1;
    r->supports = 2;
    r->reserved = 0;
    return 1;
}

#else
#define tell_wide_sticks(a, b, g, r) 0
#endif

#endif
