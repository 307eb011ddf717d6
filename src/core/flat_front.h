/* SPDX-License-Identifier: MIT */
/* Bodies of few corners in the plane, in float where it stands beside its sister: what of their difference is nearest
 * so far, in double, and what is told by it. A map's products have all their digits there, nothing under- or overflows
 * and needs a frame, and nothing else of the bodies is set up (flat.h). */
#ifndef GJK_CORE_FLAT_FRONT_H
#define GJK_CORE_FLAT_FRONT_H

#include "double.h"

#if DIM == 2

/* So many corners a body has at most, and so many are asked for. */
#define PLACES (2 * RUN)
#define ASKED_MOST 16

/* Where the walk ends: nowhere; where the corner asked for last shows that they are apart; at a front that is nearest,
 * or near enough; or it is held. */
enum halt { LOST, SHOWN, FOREMOST, AROUND };

/* Fewer than a run, again and again. */
static APART void fill_run(const list of, real run[RUN * DIM])
{
    for (size_t i = 0, k = 0; i < RUN; i++, k = k + 1 < of.count ? k + 1 : 0) {
        run[DIM * i] = of.v[of.step * k];
        run[DIM * i + 1] = of.v[of.step * k + 1];
    }
}

#if HAS_SISTER

/* Bounds are off by so much of A + B + |c|_1 at most, where the bodies reach A and B from their positions, c apart: 15
 * roundings (docs/bounds.md). */
#define FLAT_DOUBT 0x1p-49

/* By so much may a bracket be wide, if it is to be the answer: a share of a float's rounding of them. */
#define FLAT_WIDTH 0x1p-26

/* So many times what bounds are off is a corner's distance, or an edge's length, to be a direction to a float's
 * rounding.
 */
#define AWAY 0x1p20

/* ---- the bodies ---- */

typedef struct flat_body {
    const real *v;               /* the corners as they are given, step by step; */
    size_t count, step;          /*   so many; */
    double reach;                /* how far they are from their origin, at most; */
    real limit;                  /* no coordinate is above this; */
    real run[RUN * DIM];         /* those of a box; */
    dvec share[DIM][PLACES / 2]; /* what each of the list's first run and its last, as a cluster has them (planar.h),
                                    adds to one of the difference; */
    dvec row[DIM], p;            /* its map by rows, and where it is */
} flat_body;

/* The corners, those of a box spelled. 0: they are not known, or there are too many, or the data are none. */
HOT int list_flat(const shape *k, flat_body *s)
{
    static const real nothing[DIM] = {0};
    s->step = DIM;
    if (k->support == pub(support_points)) {
        const points *p = k->data;
        if (!p || !p->v) return 0;
        s->v = p->v;
        s->count = p->count;
        if (p->stride) s->step = p->stride / sizeof(real);
        s->reach = (double)p->reach;
        s->limit = smaller(p->reach * (1 + 16 * UNIT), REAL_MAX);
        return p->count - 1 <= PLACES - 1 && !(p->stride && !is_stride(p)) && p->reach > TINY;
    }
    s->limit = REAL_MAX;
    if (k->support == pub(support_segment)) {
        const segment *e = k->data;
        if (!e) return 0;
        const dvec first = dsizes(dload(e->v[0])), second = dsizes(dload(e->v[1]));
        const dvec spreads = dadd(dfirsts(first, second), dseconds(first, second));
        s->v = e->v[0];
        s->count = 2;
        s->reach = dfirst(dlarger(spreads, dswapped(spreads)));
    } else if (k->support == pub(support_box)) {
        const box *e = k->data;
        if (!e || !(e->half[0] >= 0 && e->half[1] >= 0)) return 0;
        for (int i = 0; i < RUN; i++) {
            s->run[DIM * i] = i & 1 ? e->half[0] : -e->half[0];
            s->run[DIM * i + 1] = i & 2 ? e->half[1] : -e->half[1];
        }
        s->v = s->run;
        s->count = RUN;
        s->reach = (double)e->half[0] + (double)e->half[1];
    } else {
        s->v = nothing;
        s->count = 1;
        s->reach = 0;
        return k->support == pub(support_origin);
    }
    return 1;
}

/* Its pose. No point of it is farther from there than what is returned. */
HOT double pose_flat(const shape *k, flat_body *s)
{
    static const pose none = {{1, 0, 0, 1}, {0, 0}};
    const pose *o = k->pose ? k->pose : &none;
    s->row[0] = dload(o->m);
    s->row[1] = dload(o->m + DIM);
    s->p = dload(o->p);
    const dvec far = dadd(dsizes(s->row[0]), dsizes(s->row[1]));
    return (dfirst(far) + dsecond(far)) * (s->reach * 1.5);
}

/* A run of corners, in their own coordinates. Bit for bit, which of their numbers are within the limit. */
HOT lanes load_run(const real *x, size_t step, lanes limit, dvec own[DIM][RUN / 2])
{
    lanes fit = limit;
    for (size_t j = 0; j < RUN; j += LANES, x += LANES * step) {
        lanes l[DIM];
        load_lanes(x, step, l);
        const lanes near = in_both(no_larger(sizes(l[0]), limit), no_larger(sizes(l[1]), limit));
        fit = j == 0 ? near : in_both(fit, near);
        EACH(widen_lanes(l[i], own[i], j));
    }
    return fit;
}

/* Where the first run stands, step by step; of fewer the first stands there again. */
HOT const real *first_run(const flat_body *s, real few[RUN * DIM], size_t *step)
{
    *step = s->step;
    if (s->count >= RUN) return s->v;
    for (size_t i = 0; i < RUN; i++)
        memcpy(few + DIM * i, s->v + (i < s->count ? i : 0) * s->step, DIM * sizeof *few); /* as it is loaded */
    *step = DIM;
    return few;
}

HOT int has_more_than_run(const flat_body *s) { return s->count > RUN; }

/* And the last. */
HOT const real *last_run(const flat_body *s) { return s->v + (s->count - RUN) * s->step; }

/* What a run from place at on adds to the corners of a - b: a's as they are placed, b's taken from c. */
HOT lanes take_run(const real *x, size_t step, lanes limit, flat_body *s, size_t at, int is_b, dvec c)
{
    const dvec r = s->row[0], t = s->row[1], rx = dfirsts(r, r), ry = dseconds(r, r), tx = dfirsts(t, t),
               ty = dseconds(t, t), cx = dfirsts(c, c), cy = dseconds(c, c);
    dvec own[DIM][RUN / 2];
    const lanes fit = load_run(x, step, limit, own);
    for (size_t j = 0; j < RUN / 2; j++) {
        const dvec u = dadd(dtimes(rx, own[0][j]), dtimes(ry, own[1][j]));
        const dvec v = dadd(dtimes(tx, own[0][j]), dtimes(ty, own[1][j]));
        s->share[0][at / 2 + j] = is_b ? dsub(cx, u) : u;
        s->share[1][at / 2 + j] = is_b ? dsub(cy, v) : v;
    }
    return fit;
}

/* All of them. Bit for bit, whether they are within the limit. */
HOT lanes take_flat(flat_body *s, int is_b, dvec c)
{
    const lanes limit = in_all(s->limit);
    real few[RUN * DIM];
    size_t step;
    const real *x = first_run(s, few, &step);
    const lanes fit = take_run(x, step, limit, s, 0, is_b, c);
    return has_more_than_run(s) ? in_both(fit, take_run(last_run(s), s->step, limit, s, RUN, is_b, c)) : fit;
}

/* The least height of a run along a way in their own coordinates, in both parts. */
HOT dvec least_of_run(const real *x, size_t step, lanes limit, dvec way, lanes *fit)
{
    const dvec wx = dfirsts(way, way), wy = dseconds(way, way);
    dvec own[DIM][RUN / 2], least = wx;
    *fit = load_run(x, step, limit, own);
    for (size_t j = 0; j < RUN / 2; j++) {
        const dvec height = dadd(dtimes(wx, own[0][j]), dtimes(wy, own[1][j]));
        least = j == 0 ? height : dsmaller(least, height);
    }
    return least;
}

/* Of all; and bit for bit, whether they are within the limit. */
HOT double least_in_flat(const flat_body *s, dvec way, lanes *fit)
{
    const lanes limit = in_all(s->limit);
    real few[RUN * DIM];
    size_t step;
    const real *x = first_run(s, few, &step);
    dvec least = least_of_run(x, step, limit, way, fit);
    if (has_more_than_run(s)) {
        lanes also;
        least = dsmaller(least, least_of_run(last_run(s), s->step, limit, way, &also));
        *fit = in_both(*fit, also);
    }
    return dfirst(dsmaller(least, dswapped(least)));
}

/* Which corner of the list stands at that place. */
HOT size_t nth_corner_at(const flat_body *s, unsigned at) { return at < RUN ? at : at + s->count - PLACES; }

/* As it is given. */
HOT dvec corner_in_flat(const flat_body *s, unsigned at)
{
    const size_t nth = nth_corner_at(s, at);
    return dload(s->v + s->step * (nth < s->count ? nth : 0));
}

HOT dvec share_in_flat(const flat_body *s, unsigned at)
{
    return dvec_of(dpart_of(s->share[0], at), dpart_of(s->share[1], at));
}

/* How high the shares are along a way, and in both parts the least of these. */
typedef struct dheights {
    dvec of[PLACES / 2], least;
} dheights;

HOT dheights heights_in_flat(const flat_body *s, dvec x, dvec y)
{
    dheights r;
    for (int i = 0; i < 2; i++) r.of[i] = dadd(dtimes(s->share[0][i], x), dtimes(s->share[1][i], y));
    r.of[2] = r.of[0];
    r.of[3] = r.of[1];
    dvec least = dsmaller(r.of[0], r.of[1]);
    if (has_more_than_run(s)) {
        for (int i = 2; i < 4; i++) r.of[i] = dadd(dtimes(s->share[0][i], x), dtimes(s->share[1][i], y));
        least = dsmaller(least, dsmaller(r.of[2], r.of[3]));
    }
    r.least = dsmaller(least, dswapped(least));
    return r;
}

/* How far the body reaches, as its support says. */
static real reach_of_flat(const shape *of)
{
    static const real nothing[DIM] = {0};
    if (of->support == pub(support_box)) return at_most(load(((const box *)of->data)->half));
    if (of->support == pub(support_points)) return ((const points *)of->data)->reach;
    return of->support == pub(support_segment) ? reach_of(((const segment *)of->data)->v[0], 2) : reach_of(nothing, 1);
}

/* The pair is too large for a frame (minkowski.h): such are refused, all of them. */
static APART int is_too_large(const shape *a, const shape *b)
{
    const real far_a = reach_of_flat(a) * (a->pose ? stretch(a->pose->m) : 1);
    const real far_b = reach_of_flat(b) * (b->pose ? stretch(b->pose->m) : 1);
    return !(far_a + far_b + spread(offset(a->pose, b->pose)) <= REAL_MAX / 4);
}

/* ---- the front ---- */

/* Two of them. */
typedef struct flat {
    flat_body a, b;
    dvec c;        /* from b's position to a's */
    double blur;   /* what bounds are off at most; */
    double wide;   /* what they may be apart; */
    double radius; /* of both */
} flat;

/* A corner of the difference, what the bodies' corners add to it, and where these stand, as a spot of planar.h has it.
 */
typedef struct dspot {
    dvec w, a, b;
    unsigned at;
} dspot;

/* What is nearest to the origin so far, as the front of planar.h. */
typedef struct dfront {
    dspot p, q, last;
    dvec v;        /* the corner; or square to the edge from p to q, away from the origin */
    dvec way;      /* along which the last corner has been asked for, */
    double height; /* so high it lies there, times the way's length; */
    int n, steps, around;
    int under; /* the origin lies under the edge, which is the lowest on the way out */
} dfront;

/* How low the bodies' corners lie. */
typedef struct dlook {
    dheights a, b;
} dlook;

static inline unsigned at_in_a(unsigned at) { return at % PLACES; }
static inline unsigned at_in_b(unsigned at) { return at / PLACES % PLACES; }

HOT dspot dspot_of(const flat *f, unsigned of_a, unsigned of_b)
{
    const dvec a = share_in_flat(&f->a, of_a), b = share_in_flat(&f->b, of_b);
    return (dspot){dadd(a, b), a, b, of_a + PLACES * of_b};
}

/* Along v, which is the way then. */
HOT void look_flat(const flat *f, dfront *k, dlook *l)
{
    const dvec x = dfirsts(k->v, k->v), y = dseconds(k->v, k->v);
    l->a = heights_in_flat(&f->a, x, y);
    l->b = heights_in_flat(&f->b, x, y);
    k->way = k->v;
    k->steps++;
}

/* How low corners of the difference lie along v. */
HOT double lowest_in_flat(const flat *f, dvec v)
{
    const dvec x = dfirsts(v, v), y = dseconds(v, v);
    return dfirst(heights_in_flat(&f->a, x, y).least) + dfirst(heights_in_flat(&f->b, x, y).least);
}

/* The corner that has been seen to be least. */
HOT void find_last(const flat *f, dfront *k, const dlook *l)
{
    k->last = dspot_of(f, dfirst_within(l->a.of, l->a.least), dfirst_within(l->b.of, l->b.least));
    k->height = ddot(k->way, k->last.w);
}

/* The corner of the difference that is least along v. */
HOT void ask_flat(const flat *f, dfront *k)
{
    dlook l;
    look_flat(f, k, &l);
    find_last(f, k, &l);
}

HOT void stand_on_dspot(dfront *k, dspot p)
{
    k->p = k->q = p;
    k->n = 1;
    k->v = p.w;
}

HOT void stand_between(dfront *k, dspot p, dspot q)
{
    const dvec square = dturned(dsub(q.w, p.w));
    k->v = dflipped(square, ddot(square, p.w));
    k->p = p;
    k->q = q;
    k->n = 2;
}

/* Takes in the corner asked for last, as turn_front does. 0: with the edge it holds the origin. */
HOT int turn_flat(dfront *k)
{
    if (k->n == 0) {
        stand_on_dspot(k, k->last);
        return 1;
    }
    const dspot p = k->p, q = k->q, last = k->last;
    const dvec left = dsub(p.w, last.w);
    if (k->n == 1) {
        const double from = ddot(p.w, left), to = ddot(last.w, left);
        if (from > 0 && to < 0) stand_between(k, p, last);
        else stand_on_dspot(k, from > 0 ? last : p);
    } else {
        const dvec right = dsub(q.w, last.w);
        const double turn = dcross(left, right) < 0 ? -1 : 1;
        const int beyond_left = dcross(last.w, left) * turn<0, beyond_right = dcross(last.w, right) * turn> 0;
        if (!beyond_left && !beyond_right) return 0;
        if (beyond_left && ddot(last.w, left) < 0) stand_between(k, p, last);
        else if (beyond_right && ddot(last.w, right) < 0) stand_between(k, q, last);
        else stand_on_dspot(k, last);
    }
    return 1;
}

/* ---- what a cache holds ---- */

/* Beside that: the origin lies under the edge. */
#define UNDER ((uint32_t)1 << 31)

static inline uint32_t dhint_of(const dfront *k)
{
    uint32_t r = k->p.at;
    if (k->n > 1) r |= k->q.at << 8;
    if (k->around) r |= k->last.at << 8 * k->n;
    return k->under ? r | UNDER : r;
}

static APART void keep_flat(cache *own, const flat *f, uint32_t count, uint32_t hint, const shape *a, const shape *b)
{
    own->count = count;
    own->reserved = hint;
    for (uint32_t i = 0; i < count; i++, hint >>= 8) {
        dstore(own->a[i], corner_in_flat(&f->a, at_in_a(hint)));
        dstore(own->b[i], corner_in_flat(&f->b, at_in_b(hint)));
    }
    own->reach_a = reach_of_flat(a);
    own->reach_b = reach_of_flat(b);
    own->support[0] = a->support;
    own->support[1] = b->support;
    own->data[0] = a->data;
    own->data[1] = b->data;
}

/* The corner of that place, if it is where it was, to the bit; or NULL. */
HOT const real *corner_there(const flat_body *s, unsigned at, const real was[DIM])
{
    const size_t nth = nth_corner_at(s, at);
    if ((at >= RUN && !has_more_than_run(s)) || nth >= s->count) return NULL;
    const real *x = s->v + s->step * nth;
    return memcmp(x, was, DIM * sizeof *x) == 0 ? x : NULL;
}

/* From the corners of the last query, as far as they stand where they did. */
HOT void recall_flat(const flat *f, dfront *k, const cache *from)
{
    uint32_t hint = from->reserved;
    for (uint32_t i = 0; i < from->count; i++, hint >>= 8) {
        const unsigned of_a = at_in_a(hint), of_b = at_in_b(hint);
        if (!corner_there(&f->a, of_a, from->a[i]) || !corner_there(&f->b, of_b, from->b[i])) return;
        k->last = dspot_of(f, of_a, of_b);
        turn_flat(k);
    }
}

/* ---- telling ---- */

/* Of the cores: a point of each, as corners add to those of the difference; the way between them, and its length; along
 * which way they are apart, and one by its length. */
typedef struct dsight {
    dvec a, b, way, v;
    double far, per;
} dsight;

/* Bounds beyond that are no floats. */
#define BROADEST ((double)REAL_MAX * (1 - 0x1p-20))

/* The bracket, the radii taken off; of the points b's is a's where the bodies meet. 0: in float it does not say whether
 * they do, and nothing is changed. */
HOT int spell_flat(const flat *f, int steps, const dsight *s, double lower, double upper, double value, int apart,
                   result *r)
{
    const dvec x = dinto_range(dadd(s->a, f->a.p));
    real bounds[2]; /* the upper one's sign turned */
    dstore(bounds, dbelow(dvec_of(lower, -upper)));
    if (!(bounds[0] > 0 || upper <= 0) || !(lower >= -BROADEST && upper <= BROADEST)) return 0;
    r->lower = bounds[0];
    r->upper = upper > 0 ? -bounds[1] : smaller(-bounds[1], 0);
    r->value = (real)value;
    dstore(r->point_a, x);
    dstore(r->point_b, apart ? dinto_range(dsub(f->a.p, s->b)) : x);
    dstore(r->normal, dnegative(dmul(s->v, s->per)));
    r->steps = steps;
    r->supports = 2 * steps;
    r->reserved = 0;
    return 1;
}

/* The points where the radii end, the normal's way if they are deep; or between them, where the radii meet. */
HOT void move_flat(dsight *s, double of_a, double of_b, int meet, int deep)
{
    if (meet && !deep) {
        const dvec part = dmul(s->way, of_a / (of_a + of_b));
        s->a = dsub(s->a, part);
        return;
    }
    const dvec toward_b = meet ? dmul(s->v, -s->per) : dmul(s->way, -1 / s->far);
    s->a = dadd(s->a, dmul(toward_b, of_a));
    s->b = dadd(s->b, dmul(toward_b, of_b));
}

/* The point between two spots, at a share of the way. */
HOT void sight_between(dsight *s, dvec a, dvec b, dvec to_a, dvec to_b, dvec part)
{
    s->a = dadd(a, dtimes(to_a, part));
    s->b = dadd(b, dtimes(to_b, part));
    s->way = dadd(s->a, s->b);
}

/* The nearest point of the front. */
HOT void sight_flat(const dfront *k, dsight *s)
{
    s->a = k->p.a;
    s->b = k->p.b;
    s->way = k->p.w;
    if (k->n == 1) return;
    const dvec edge = dsub(k->q.w, k->p.w);
    const double share = -ddot(k->p.w, edge) / ddot(edge, edge);
    const double part = share > 0 ? share < 1 ? share : 1 : 0;
    sight_between(s, k->p.a, k->p.b, dsub(k->q.a, k->p.a), dsub(k->q.b, k->p.b), dboth(part));
}

#endif
#endif

#endif
