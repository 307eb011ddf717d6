/* SPDX-License-Identifier: MIT */
/* Bodies of few corners in the plane, in float where it stands beside its sister: GJK in double, from the first corner
 * on. A map's products have all their digits there, nothing under- or overflows and needs a frame, and the walk sees
 * gaps that are far below what float rounds: so it ends where the truth is, and the last corner that it asks for proves
 * it, with what double rounds charged (docs/bounds.md). Nothing else of the bodies is set up. Overlaps by less than
 * that, or deeper where the depth is asked, are left to others. */
#ifndef GJK_CORE_FLAT_H
#define GJK_CORE_FLAT_H

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

/* The corners as they are given, in its own coordinates. */
typedef struct flat_list {
    list from;
    double reach; /* how far they are from their origin, at most; */
    real limit;   /* no coordinate is above this */
} flat_list;

typedef struct flat_body {
    list from;                   /* the corners as they are given; */
    dvec share[DIM][PLACES / 2]; /* what each of the list's first run and its last, as a cluster has them (planar.h),
                                    adds to one of the difference; */
    dvec row[DIM], p;            /* its map by rows, and where it is */
} flat_body;

/* The corners, those of a box spelled into run. 0: they are not known, or there are too many, or the data
 * are none. */
HOT int list_flat(const shape *k, real run[RUN * DIM], flat_list *s)
{
    static const real nothing[DIM] = {0};
    if (k->support == pub(support_points)) {
        const points *p = k->data;
        if (!p || !p->v) return 0;
        const size_t step = stride_of(p);
        if (p->count - 1 > PLACES - 1 || step < DIM || p->stride % sizeof(real) != 0 || !(p->reach > TINY)) return 0;
        *s = (flat_list){
            {p->v, p->count, step, 0, NULL}, (double)p->reach, smaller(p->reach * (1 + 16 * UNIT), REAL_MAX)};
        return 1;
    }
    s->limit = REAL_MAX;
    if (k->support == pub(support_segment)) {
        const segment *e = k->data;
        if (!e) return 0;
        s->from = (list){e->v[0], 2, DIM, 0, NULL};
        const dvec first = dsizes(dload(e->v[0])), second = dsizes(dload(e->v[1]));
        const dvec spreads = dadd(dfirsts(first, second), dseconds(first, second));
        s->reach = dfirst(dlarger(spreads, dswapped(spreads)));
    } else if (k->support == pub(support_box)) {
        const box *e = k->data;
        if (!e || !(e->half[0] >= 0 && e->half[1] >= 0)) return 0;
        for (int i = 0; i < RUN; i++) {
            run[DIM * i] = i & 1 ? e->half[0] : -e->half[0];
            run[DIM * i + 1] = i & 2 ? e->half[1] : -e->half[1];
        }
        s->from = (list){run, RUN, DIM, 0, NULL};
        s->reach = (double)e->half[0] + (double)e->half[1];
    } else {
        s->from = (list){nothing, 1, DIM, 0, NULL};
        s->reach = 0;
        return k->support == pub(support_origin);
    }
    return 1;
}

/* Its pose. No point of it is farther from there than what is returned. */
HOT double pose_flat(const shape *k, double reach, flat_body *s)
{
    static const pose none = {{1, 0, 0, 1}, {0, 0}};
    const pose *o = k->pose ? k->pose : &none;
    s->row[0] = dload(o->m);
    s->row[1] = dload(o->m + DIM);
    s->p = dload(o->p);
    const dvec far = dadd(dsizes(s->row[0]), dsizes(s->row[1]));
    return (dfirst(far) + dsecond(far)) * (reach * 1.5);
}

/* What a run of corners from place at on adds to those of a - b: a's as they are placed, b's taken from c. Bit for bit,
 * which of their numbers are within the limit. */
HOT lanes take_run(const real *x, size_t step, lanes limit, flat_body *s, size_t at, int is_b, dvec c)
{
    const dvec r = s->row[0], t = s->row[1], rx = dfirsts(r, r), ry = dseconds(r, r), tx = dfirsts(t, t),
               ty = dseconds(t, t), cx = dfirsts(c, c), cy = dseconds(c, c);
    dvec own[DIM][RUN / 2];
    lanes fit = limit;
    for (size_t j = 0; j < RUN; j += LANES, x += LANES * step) {
        lanes l[DIM];
        load_lanes(x, step, l);
        const lanes near = in_both(no_larger(sizes(l[0]), limit), no_larger(sizes(l[1]), limit));
        fit = j == 0 ? near : in_both(fit, near);
        EACH(widen_lanes(l[i], own[i], j));
    }
    for (size_t j = 0; j < RUN / 2; j++) {
        const dvec u = dadd(dtimes(rx, own[0][j]), dtimes(ry, own[1][j]));
        const dvec v = dadd(dtimes(tx, own[0][j]), dtimes(ty, own[1][j]));
        s->share[0][at / 2 + j] = is_b ? dsub(cx, u) : u;
        s->share[1][at / 2 + j] = is_b ? dsub(cy, v) : v;
    }
    return fit;
}

/* All of them; of fewer than a run the first stands there again. Bit for bit, whether they are within the limit. */
HOT lanes take_flat(const flat_list *l, flat_body *s, int is_b, dvec c)
{
    const lanes limit = in_all(l->limit);
    real few[RUN * DIM];
    const real *x = l->from.v;
    size_t step = l->from.step;
    s->from = l->from;
    if (l->from.count < RUN) {
        for (size_t i = 0; i < RUN; i++)
            memcpy(few + DIM * i, x + (i < l->from.count ? i : 0) * step, DIM * sizeof *few); /* as it is loaded */
        x = few;
        step = DIM;
    }
    const lanes fit = take_run(x, step, limit, s, 0, is_b, c);
    if (l->from.count <= RUN) return fit;
    return in_both(fit, take_run(x + (l->from.count - RUN) * step, step, limit, s, RUN, is_b, c));
}

HOT int has_more_than_run(const flat_body *s) { return s->from.count > RUN; }

/* The corner of that place, as it is given. */
HOT dvec corner_in_flat(const flat_body *s, unsigned at)
{
    const size_t nth = at < RUN ? at : at + s->from.count - PLACES;
    return dload(s->from.v + s->from.step * (nth < s->from.count ? nth : 0));
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
    int n;
    dvec v;        /* the corner; or square to the edge from p to q, away from the origin */
    dvec way;      /* along which the last corner has been asked for, */
    double height; /* so high it lies there, times the way's length; */
    int steps, around;
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

static inline uint32_t dhint_of(const dfront *k)
{
    uint32_t r = k->p.at;
    if (k->n > 1) r |= k->q.at << 8;
    if (k->around) r |= k->last.at << 8 * k->n;
    return r;
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

/* The corner stands there, as it did. */
HOT int is_there(const flat_body *s, unsigned at, const real was[DIM])
{
    return (has_more_than_run(s) || at < RUN) && dsame(corner_in_flat(s, at), dload(was));
}

/* From the corners of the last query, as far as they stand where they did. */
HOT void recall_flat(const flat *f, dfront *k, const cache *from)
{
    uint32_t hint = from->reserved;
    for (uint32_t i = 0; i < from->count; i++, hint >>= 8) {
        const unsigned of_a = at_in_a(hint), of_b = at_in_b(hint);
        if (!is_there(&f->a, of_a, from->a[i]) || !is_there(&f->b, of_b, from->b[i])) return;
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
HOT int spell_flat(const flat *f, const dfront *k, const dsight *s, double lower, double upper, double value, int apart,
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
    r->steps = k->steps;
    r->supports = 2 * k->steps;
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

/* How far apart the front is, or whether that is more than the radii, of cores that are so far apart along its way at
 * least. 0: that is not proven, or leaves open whether they meet. */
HOT int tell_flat_sight(const flat *f, const dfront *k, dsight *s, double low, double along, const shape *a,
                        const shape *b, const goal *g, result *r)
{
    const double blur = f->blur + f->radius * 0x1p-51;
    const double lower = low - f->radius - blur, upper = s->far - f->radius + blur;
    const int meet = upper < 0, narrow = upper - lower <= f->wide && along > f->blur * AWAY;
    if (!(lower > 0) && !meet) return 0;
    if (!narrow && (meet ? g->deep : !g->sign_only)) return 0;
    if (f->radius > 0) move_flat(s, (double)a->radius, (double)b->radius, meet, g->deep);
    return spell_flat(f, k, s, lower, upper, s->far - f->radius, !meet || g->deep, r);
}

/* The same where the last corner was asked for along it. */
HOT int tell_flat_front(const flat *f, const dfront *k, const shape *a, const shape *b, const goal *g, result *r)
{
    dsight s = {.v = k->way};
    sight_flat(k, &s);
    const dvec lengths = dlengths(s.way, k->way);
    s.far = dfirst(lengths);
    s.per = 1 / dsecond(lengths);
    return tell_flat_sight(f, k, &s, k->height * s.per, dsecond(lengths), a, b, g, r);
}

/* That they are apart, as the last corner shows, if that is all that is asked. */
HOT int shows_apart_flat(const flat *f, const dfront *k)
{
    const double least = f->radius + 2 * f->blur;
    return k->height > 0 && k->height * k->height > least * least * ddot(k->way, k->way);
}

HOT int tell_flat_apart(const flat *f, const dfront *k, const shape *a, const shape *b, result *r)
{
    const double blur = f->blur + f->radius * 0x1p-51;
    dsight s = {.a = k->last.a, .b = k->last.b, .way = k->last.w, .v = k->way};
    const dvec lengths = dlengths(s.way, k->way);
    s.far = dfirst(lengths);
    s.per = 1 / dsecond(lengths);
    const double lower = k->height * s.per - f->radius - blur;
    if (!(lower > 0)) return 0;
    if (f->radius > 0) move_flat(&s, (double)a->radius, (double)b->radius, 0, 0);
    return spell_flat(f, k, &s, lower, s.far - f->radius + blur, lower, 1, r);
}

/* By how much the origin is to the left of an edge, times its length, and the square of how far that is. */
HOT double turn_at(dvec p, dvec q, double *square)
{
    const dvec e = dsub(q, p);
    const double turn = dcross(p, e);
    *square = dleast(turn * turn / ddot(e, e), *square);
    return turn;
}

/* They overlap: the corner asked for last and the edge hold the origin. 0: with less room than is in doubt, or too
 * narrowly for a point of both. */
HOT int tell_flat_held(const flat *f, const dfront *k, result *r)
{
    const dspot at[3] = {k->p, k->q, k->last};
    double square = DBL_MAX, turn[3];
    dsight s = {.v = k->way};
    dvec off = dboth(0);
    for (int i = 0; i < 3; i++) turn[i] = turn_at(at[(i + 1) % 3].w, at[(i + 2) % 3].w, &square);
    if (!((turn[0] > 0 && turn[1] > 0 && turn[2] > 0) || (turn[0] < 0 && turn[1] < 0 && turn[2] < 0))) return 0;
    const double inside = droot(square), blur = 2 * f->blur + f->radius * 0x1p-51;
    s.per = 1 / dlength(k->way);
    s.a = dboth(0);
    for (int i = 0; i < 3; i++) {
        const double share = turn[i] / (turn[0] + turn[1] + turn[2]);
        s.a = dadd(s.a, dmul(at[i].a, share));
        off = dadd(off, dmul(at[i].w, share));
    }
    off = dsizes(off);
    if (!(dfirst(off) + dsecond(off) <= f->wide)) return 0;
    const double upper = blur - inside - f->radius;
    return spell_flat(f, k, &s, k->height * s.per - f->radius - blur, upper, upper, 0, r);
}

/* Both numbers are whole multiples of what 1.5 * 2^52 of is off. */
HOT int is_dwhole(dvec x, dvec off) { return dsame(dsub(dadd(x, off), off), x); }

/* So are the products that the body's corner is placed by, which are exact. */
HOT int is_placed_whole(const flat_body *s, unsigned at, dvec off)
{
    const dvec x = corner_in_flat(s, at);
    return is_dwhole(dtimes(s->row[0], x), off) & is_dwhole(dtimes(s->row[1], x), off);
}

/* 1.5 * 2^52 of what is 2^-26 of a power of two above x. */
HOT double off_above(double x)
{
    uint64_t e;
    memcpy(&e, &x, sizeof e);
    e = ((e >> 52) + 27) << 52;
    memcpy(&x, &e, sizeof x);
    return 1.5 * x;
}

/* Weights with which the front's corner, its edge, or that and the corner asked for last add up to the origin, in
 * numbers whose products are exact. 0: they do not hold it. */
HOT int weigh_flat(const dspot *const at[3], int n, double weight[3])
{
    const dvec p = at[0]->w, q = at[1]->w, r = at[2]->w;
    weight[0] = 1;
    weight[1] = weight[2] = 0;
    if (n == 1) return ddot(p, p) == 0;
    weight[2] = dcross(p, q);
    if (n == 2) {
        weight[0] = droot(ddot(q, q));
        weight[1] = droot(ddot(p, p));
        return weight[2] == 0 && ddot(p, q) <= 0 && weight[0] + weight[1] > 0;
    }
    weight[0] = dcross(q, r);
    weight[1] = dcross(r, p);
    const double least = dleast(weight[0], dleast(weight[1], weight[2]));
    const double most = -dleast(-weight[0], dleast(-weight[1], -weight[2]));
    return (least < 0) != (most > 0);
}

/* That the cores touch, where the walk has come to, of corners whose places are short numbers: with nothing rounded. 0:
 * they are none, or do not. */
static APART int tell_flat_touching(const flat *f, dfront own, result *r)
{
    const dfront *k = &own;
    const int n = k->n + k->around;
    const dspot *const at[3] = {&k->p, k->n > 1 ? &k->q : &k->p, k->around ? &k->last : &k->p};
    const dvec off = dboth(off_above(f->wide * (1 / FLAT_WIDTH)));
    dsight s = {.a = dboth(0), .v = k->way};
    double weight[3];
    if (k->n == 0 || k->steps == 0 || !weigh_flat(at, n, weight)) return 0;
    int whole = is_dwhole(f->a.p, off) & is_dwhole(f->b.p, off);
    for (int i = 0; i < n; i++)
        whole &= is_placed_whole(&f->a, at_in_a(at[i]->at), off) & is_placed_whole(&f->b, at_in_b(at[i]->at), off);
    if (!whole) return 0;
    const double sum = weight[0] + weight[1] + weight[2];
    for (int i = 0; i < n; i++) s.a = dadd(s.a, dmul(at[i]->a, weight[i] / sum));
    s.per = 1 / dlength(k->way);
    return spell_flat(f, k, &s, k->height * s.per - f->blur, 0, 0, 0, r);
}

/* ---- the first front ---- */

/* Where a body's two lowest corners stand, by a look; of one corner that twice. The place is written into the last
 * digits of the height, so that the least has it in itself. */
HOT void find_two(const flat_body *s, const dheights *h, unsigned at[2])
{
#define OUT DBL_MAX
#define IN -DBL_MAX
    static const double barred[PLACES + 1][PLACES] = {
        {OUT, OUT, OUT, OUT, OUT, OUT, OUT, OUT}, {IN, OUT, OUT, OUT, OUT, OUT, OUT, OUT},
        {IN, IN, OUT, OUT, OUT, OUT, OUT, OUT},   {IN, IN, IN, OUT, OUT, OUT, OUT, OUT},
        {IN, IN, IN, IN, OUT, OUT, OUT, OUT},     {IN, IN, IN, IN, OUT, OUT, OUT, IN},
        {IN, IN, IN, IN, OUT, OUT, IN, IN},       {IN, IN, IN, IN, OUT, IN, IN, IN},
        {IN, IN, IN, IN, IN, IN, IN, IN},
    };
#undef OUT
#undef IN
    const double *bar = barred[s->from.count];
    const dvec x = dlarger(dtagged(h->of[0], 0, 1), djoin(bar)), y = dlarger(dtagged(h->of[1], 2, 3), djoin(bar + 2));
    dvec low = dsmaller(x, y), next = dlarger(x, y);
    if (has_more_than_run(s)) {
        const dvec z = dlarger(dtagged(h->of[2], 4, 5), djoin(bar + 4));
        const dvec u = dlarger(dtagged(h->of[3], 6, 7), djoin(bar + 6)), lower = dsmaller(z, u);
        next = dsmaller(dlarger(low, lower), dsmaller(next, dlarger(z, u)));
        low = dsmaller(low, lower);
    }
    const dvec other = dswapped(low);
    at[0] = dtag(dsmaller(low, other));
    at[1] = dtag(dsmaller(dlarger(low, other), dsmaller(next, dswapped(next))));
    if (s->from.count == 1) at[1] = 0;
}

/* Where the walk starts: at the two lowest corners of each body. */
typedef struct dstart {
    unsigned of_a[2], of_b[2];
    dvec gain;   /* which is the nearer of a's edge and b's, where they meet; */
    double part; /* at this share of it the nearest point is */
} dstart;

/* The first front, by a look: the nearer of the edges, one of each body, that meet in the lowest corner of all; which
 * that is, is told by their lines. Its v and its nearest point, without a branch. */
HOT void start_flat(const flat *f, dfront *k, const dlook *l, dstart *t, dsight *s)
{
    const dvec none = dboth(0), one = dboth(1);
    find_two(&f->a, &l->a, t->of_a);
    find_two(&f->b, &l->b, t->of_b);
    const dvec a = share_in_flat(&f->a, t->of_a[0]), along_a = dsub(share_in_flat(&f->a, t->of_a[1]), a);
    const dvec b = share_in_flat(&f->b, t->of_b[0]), along_b = dsub(share_in_flat(&f->b, t->of_b[1]), b);
    const dvec w = dadd(a, b);
    /* of both edges, side by side */
    const dvec from = ddots(along_a, along_b, dopposite(w)), squares = dsquares(along_a, along_b);
    const dvec away = ddots(dturned(along_a), dturned(along_b), w);
    const dvec ahead = dlarger(from, none), gain = dtimes(dtimes(ahead, ahead), dswapped(squares));
    const dvec within = dwhere_below(none, from, dwhere_below(from, squares, one, none), none);
    const dvec share = dsmaller(dlarger(ddivide(from, squares), none), one);
    /* of the one that is nearer */
    const dvec of_a = dfirsts(gain, gain), of_b = dseconds(gain, gain);
    const dvec to_a = dwhere_below(of_a, of_b, none, along_a), to_b = dwhere_below(of_a, of_b, along_b, none);
    const dvec part = dwhere_below(of_a, of_b, dseconds(share, share), dfirsts(share, share));
    const dvec edge = dwhere_below(of_a, of_b, dseconds(within, within), dfirsts(within, within));
    const dvec square = dturned(dadd(to_a, to_b));
    const double side = dfirst(dwhere_below(of_a, of_b, dseconds(away, away), away));
    sight_between(s, a, b, to_a, to_b, part);
    k->v = dwhere_below(none, edge, dflipped(square, side != 0 ? side : ddot(square, k->way)), s->way);
    t->gain = gain;
    t->part = dfirst(part);
}

/* The front that it is. */
HOT void stand_as_started(const flat *f, dfront *k, const dstart *t)
{
    const int is_b = dfirst(t->gain) < dsecond(t->gain);
    const dspot p = dspot_of(f, t->of_a[0], t->of_b[0]), q = dspot_of(f, t->of_a[!is_b], t->of_b[is_b]);
    k->p = t->part < 1 ? p : q;
    k->q = t->part > 0 ? q : p;
    k->n = t->part > 0 && t->part < 1 ? 2 : 1;
}

/* ---- the walk ---- */

/* The front, along which the last corner was asked for, is so near that the radii meet. */
HOT int is_flat_within(const flat *f, const dfront *k)
{
    const double within = f->radius - 4 * f->blur, height = ddot(k->v, k->p.w);
    return within > 0 && height * height < within * within * ddot(k->v, k->v);
}

/* The corner asked for last lies no lower along v than the front, but for what rounding takes. */
HOT int is_flat_foremost(const flat *f, const dfront *k)
{
    const double gap = ddot(k->v, dsub(k->p.w, k->last.w));
    if (k->last.at == k->p.at || k->last.at == k->q.at) return 1;
    return !(gap > 0) || gap * gap <= f->blur * f->blur * ddot(k->v, k->v);
}

/* Where it ends: nowhere; where the corner asked for last shows that they are apart; at a front that is nearest; or
 * around the origin. */
HOT enum halt walk_flat(const flat *f, dfront *k, const goal *g)
{
    for (;;) {
        if (k->steps >= ASKED_MOST || k->steps >= g->max_steps || !(ddot(k->v, k->v) > 0)) return LOST;
        ask_flat(f, k);
        if (g->sign_only && shows_apart_flat(f, k)) return SHOWN;
        if (k->n > 0) {
            if (is_flat_foremost(f, k)) return FOREMOST;
            if (g->sign_only && is_flat_within(f, k)) return FOREMOST;
        }
        k->around = !turn_flat(k);
        if (k->around) return AROUND;
    }
}

/* The pair, as far as it is looked at. 0: it is no such, or too large. */
HOT int set_flat(flat *f, real run_a[RUN * DIM], real run_b[RUN * DIM], const shape *a, const shape *b)
{
    flat_list of_a, of_b;
    if (!list_flat(a, run_a, &of_a) || !list_flat(b, run_b, &of_b)) return 0;
    if (!(a->radius >= 0 && b->radius >= 0 && a->radius + b->radius <= REAL_MAX / 16)) return 0;
    const double far = pose_flat(a, of_a.reach, &f->a) + pose_flat(b, of_b.reach, &f->b);
    f->c = dsub(f->a.p, f->b.p);
    const dvec apart = dsizes(f->c);
    const double whole = far + (dfirst(apart) + dsecond(apart));
    if (!(whole <= (double)REAL_MAX / 4) && is_too_large(a, b)) return 0;
    f->blur = whole * FLAT_DOUBT;
    f->wide = whole * FLAT_WIDTH;
    f->radius = (double)a->radius + (double)b->radius;
    return holds_in_all(in_both(take_flat(&of_a, &f->a, 0, f->c), take_flat(&of_b, &f->b, 1, f->c)));
}

/* To the cache, for the next query, the front, if that is not there. */
HOT void pass_flat_on(cache *own, const flat *f, const dfront *k, int recalled, const shape *a, const shape *b)
{
    const uint32_t count = (uint32_t)(k->n + k->around), hint = dhint_of(k);
    if (!recalled || own->count != count || own->reserved != hint) keep_flat(own, f, count, hint, a, b);
}

/* What the walk has found. */
HOT int tell_walked_flat(const flat *f, dfront *k, enum halt at, int recalled, const shape *a, const shape *b,
                         cache *own, const goal *g, result *r)
{
    int told = at == SHOWN      ? tell_flat_apart(f, k, a, b, r)
               : at == FOREMOST ? tell_flat_front(f, k, a, b, g, r)
               : at == AROUND   ? !g->deep && tell_flat_held(f, k, r)
                                : 0;
    if (!told && !g->deep && f->radius == 0) told = tell_flat_touching(f, *k, r);
    if (told && own) {
        if (k->n == 0) stand_on_dspot(k, k->last);
        pass_flat_on(own, f, k, recalled, a, b);
    }
    return told;
}

/* From the first look along a front, where it has found a lower corner; or, at its end, tells too little. */
static APART int go_on_flat(const flat *f, const dfront *first, const dlook *l, const dstart *t, enum halt at,
                            const shape *a, const shape *b, cache *own, const goal *g, result *r)
{
    dfront k = *first;
    if (t) stand_as_started(f, &k, t);
    find_last(f, &k, l);
    if (at == FOREMOST) {
        if (g->deep || f->radius > 0 || !tell_flat_touching(f, k, r)) return 0;
        if (own) pass_flat_on(own, f, &k, !t, a, b);
        return 1;
    }
    at = FOREMOST;
    if (!is_flat_foremost(f, &k)) {
        k.around = !turn_flat(&k);
        at = k.around ? AROUND : walk_flat(f, &k, g);
    }
    return tell_walked_flat(f, &k, at, !t, a, b, own, g, r);
}

/* The front's length and direction, from the nearest point. */
HOT double measure_flat(dsight *s, dvec v)
{
    const dvec lengths = dlengths(s->way, v);
    s->v = v;
    s->far = dfirst(lengths);
    s->per = 1 / dsecond(lengths);
    return dsecond(lengths);
}

/* How far apart: by the first front, if no corner is lower. Its length is worked out before that is known. */
HOT int tell_flat_start(const flat *f, dfront *k, const shape *a, const shape *b, cache *own, const goal *g, result *r)
{
    dlook l;
    dstart t;
    dsight s;
    look_flat(f, k, &l);
    start_flat(f, k, &l, &t, &s);
    const double along = measure_flat(&s, k->v), near = ddot(k->v, s.way);
    if (!(along > 0)) k->v = k->way;
    look_flat(f, k, &l);
    const double height = dfirst(l.a.least) + dfirst(l.b.least);
    const enum halt at = (near - height) * s.per > f->blur ? LOST : FOREMOST;
    if (at == FOREMOST && tell_flat_sight(f, k, &s, height * s.per, along, a, b, g, r)) {
        if (own) {
            dfront front = *k;
            stand_as_started(f, &front, &t);
            pass_flat_on(own, f, &front, 0, a, b);
        }
        return 1;
    }
    const dfront first = *k;
    const dlook look = l;
    const dstart start = t;
    return go_on_flat(f, &first, &look, &start, at, a, b, own, g, r);
}

/* The same by the front that the cache has lent. */
HOT int tell_flat_again(const flat *f, dfront *k, const shape *a, const shape *b, cache *own, const goal *g, result *r)
{
    dlook l;
    dsight s;
    sight_flat(k, &s);
    const double along = measure_flat(&s, k->v), near = ddot(k->v, k->p.w);
    look_flat(f, k, &l);
    const double height = dfirst(l.a.least) + dfirst(l.b.least);
    const enum halt at = (near - height) * s.per > f->blur ? LOST : FOREMOST;
    if (at == FOREMOST && tell_flat_sight(f, k, &s, height * s.per, along, a, b, g, r)) {
        pass_flat_on(own, f, k, 1, a, b);
        return 1;
    }
    const dfront first = *k;
    const dlook look = l;
    return go_on_flat(f, &first, &look, NULL, at, a, b, own, g, r);
}

/* 0: nothing is told. Else r is written as it is told of all bodies, its value 0 where they meet. */
HOT int tell_flat(const shape *a, const shape *b, cache *own, const goal *g, result *r)
{
    flat f;
    dfront k;
    real run_a[RUN * DIM], run_b[RUN * DIM];
    if (a->support == pub(support_box) && b->support == pub(support_box)) return 0; /* told by their axes */
    if (!set_flat(&f, run_a, run_b, a, b)) return 0;
    k.n = k.steps = k.around = 0;
    if (own && lends(own, a, b)) recall_flat(&f, &k, own);
    const int recalled = k.n;
    if (!recalled) k.v = ddot(f.c, f.c) > 0 ? f.c : dvec_of(1, 0);
    if (!g->sign_only && g->max_steps > 1)
        return recalled ? tell_flat_again(&f, &k, a, b, own, g, r) : tell_flat_start(&f, &k, a, b, own, g, r);
    const enum halt at = walk_flat(&f, &k, g);
    return tell_walked_flat(&f, &k, at, recalled, a, b, own, g, r);
}

#else
#define tell_flat(a, b, own, g, r) 0
#endif
#endif

#endif
