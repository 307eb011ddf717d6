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
    real at[DIM][PLACES];      /* the list's first run and its last, as a cluster has them (planar.h); */
    double share[DIM][PLACES]; /* what each of these corners adds to one of the difference; */
    int many;                  /* there are more than a run; */
    dvec row[DIM], p;          /* its map by rows, and where it is */
} flat_body;

/* The corners, those that are not listed spelled into run. 0: they are not known, or there are too many, or the data
 * are none. */
HOT int list_flat(const shape *k, real run[RUN * DIM], flat_list *s)
{
    if (k->support == pub(support_points)) {
        const points *p = k->data;
        if (!p || !p->v) return 0;
        const size_t step = stride_of(p);
        if (p->count - 1 > PLACES - 1 || step < DIM || p->stride % sizeof(real) != 0 || !(p->reach > TINY)) return 0;
        *s = (flat_list){{p->v, p->count, step, 0}, (double)p->reach, smaller(p->reach * (1 + 16 * UNIT), REAL_MAX)};
        return 1;
    }
    s->from = (list){run, RUN, DIM, 0};
    s->limit = REAL_MAX;
    if (k->support == pub(support_segment)) {
        const segment *e = k->data;
        if (!e) return 0;
        for (int i = 0; i < RUN; i += 2) memcpy(run + DIM * i, e->v, sizeof e->v);
        s->reach = -dleast(-dspread(e->v[0]), -dspread(e->v[1]));
    } else if (k->support == pub(support_box)) {
        const box *e = k->data;
        if (!e || !(e->half[0] >= 0 && e->half[1] >= 0)) return 0;
        for (int i = 0; i < RUN; i++) {
            run[DIM * i] = i & 1 ? e->half[0] : -e->half[0];
            run[DIM * i + 1] = i & 2 ? e->half[1] : -e->half[1];
        }
        s->reach = (double)e->half[0] + (double)e->half[1];
    } else {
        memset(run, 0, sizeof(real) * RUN * DIM);
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

/* A run of corners from place at on, and what they add to those of a - b: a's as they are placed, b's taken from c. Bit
 * for bit, which of their numbers are within the limit. */
HOT lanes take_run(const real *x, size_t step, lanes limit, flat_body *s, size_t at, int is_b, dvec c)
{
    const dvec r = s->row[0], t = s->row[1], rx = dfirsts(r, r), ry = dseconds(r, r), tx = dfirsts(t, t),
               ty = dseconds(t, t), cx = dfirsts(c, c), cy = dseconds(c, c);
    lanes fit = no_larger(limit, limit);
    for (size_t j = at; j < at + RUN; j += LANES, x += LANES * step) {
        lanes l[DIM];
        load_lanes(x, step, l);
        EACH(fit = in_both(fit, no_larger(sizes(l[i]), limit)); part_lanes(l[i], s->at[i] + j));
    }
    for (size_t j = at; j < at + RUN; j += 2) {
        const dvec first = dload(s->at[0] + j), second = dload(s->at[1] + j);
        const dvec u = dadd(dtimes(rx, first), dtimes(ry, second)), v = dadd(dtimes(tx, first), dtimes(ty, second));
        dpart(s->share[0] + j, is_b ? dsub(cx, u) : u);
        dpart(s->share[1] + j, is_b ? dsub(cy, v) : v);
    }
    return fit;
}

/* All of them. 0: one is none, or beyond the limit. */
HOT int take_flat(const flat_list *l, real run[RUN * DIM], flat_body *s, int is_b, dvec c)
{
    const lanes limit = in_all(l->limit);
    const real *x = l->from.v;
    size_t step = l->from.step;
    s->many = l->from.count > RUN;
    if (l->from.count < RUN) {
        fill_run(l->from, run);
        x = run;
        step = DIM;
    }
    lanes fit = take_run(x, step, limit, s, 0, is_b, c);
    if (s->many) fit = in_both(fit, take_run(x + (l->from.count - RUN) * step, step, limit, s, RUN, is_b, c));
    return holds_in_all(fit);
}

HOT dvec corner_in_flat(const flat_body *s, unsigned at) { return dvec_of((double)s->at[0][at], (double)s->at[1][at]); }

HOT dvec place_in_flat(const flat_body *s, unsigned at) { return ddots(s->row[0], s->row[1], corner_in_flat(s, at)); }

HOT dvec share_in_flat(const flat_body *s, unsigned at) { return dvec_of(s->share[0][at], s->share[1][at]); }

/* How high the shares of two corners from place at on are along a way, that is given as its parts, each side by side.
 */
HOT dvec heights_in_flat(const flat_body *s, int at, dvec x, dvec y)
{
    return dadd(dtimes(djoin(s->share[0] + at), x), dtimes(djoin(s->share[1] + at), y));
}

/* The first of the corners whose shares are lowest along it. */
HOT unsigned lowest_in_flat(const flat_body *s, dvec x, dvec y)
{
    const dvec first = heights_in_flat(s, 0, x, y), second = heights_in_flat(s, 2, x, y);
    dvec heights[PLACES / 2] = {first, second, first, second}, least = dsmaller(first, second);
    if (s->many) {
        heights[2] = heights_in_flat(s, RUN, x, y);
        heights[3] = heights_in_flat(s, RUN + 2, x, y);
        least = dsmaller(least, dsmaller(heights[2], heights[3]));
    }
    return dfirst_within(heights, dsmaller(least, dswapped(least)));
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

/* A corner of the difference, and where those of the bodies stand, as a spot of planar.h has it. */
typedef struct dspot {
    dvec w;
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

static inline unsigned at_in_a(unsigned at) { return at % PLACES; }
static inline unsigned at_in_b(unsigned at) { return at / PLACES % PLACES; }

HOT dspot dspot_of(const flat *f, unsigned of_a, unsigned of_b)
{
    return (dspot){dadd(share_in_flat(&f->a, of_a), share_in_flat(&f->b, of_b)), of_a + PLACES * of_b};
}

/* The corner of the difference that is least along v. */
HOT void ask_flat(const flat *f, dfront *k)
{
    const dvec x = dfirsts(k->v, k->v), y = dseconds(k->v, k->v);
    k->way = k->v;
    k->last = dspot_of(f, lowest_in_flat(&f->a, x, y), lowest_in_flat(&f->b, x, y));
    k->height = ddot(k->way, k->last.w);
    k->steps++;
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
    k->v = ddot(square, p.w) < 0 ? dnegative(square) : square;
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
    return (s->many || at < RUN) && dsame(corner_in_flat(s, at), dload(was));
}

/* From the corners of the last query, if they stand where they did. */
HOT void recall_flat(const flat *f, dfront *k, const cache *from)
{
    uint32_t hint = from->reserved;
    for (uint32_t i = 0; i < from->count; i++, hint >>= 8) {
        const unsigned of_a = at_in_a(hint), of_b = at_in_b(hint);
        if (!is_there(&f->a, of_a, from->a[i]) || !is_there(&f->b, of_b, from->b[i])) {
            k->n = 0;
            return;
        }
        k->last = dspot_of(f, of_a, of_b);
        turn_flat(k);
    }
}

/* ---- telling ---- */

/* Of the cores: a point of each, from its position; the way between them, and its length; along which way they are
 * apart, one by its length, and by how much at least. */
typedef struct dsight {
    dvec a, b, way, v;
    double far, per, lower;
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
    dstore(r->point_b, apart ? dinto_range(dadd(s->b, f->b.p)) : x);
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
    s->b = dsub(s->b, dmul(toward_b, of_b));
}

/* The nearest point of the front. */
HOT void sight_flat(const flat *f, const dfront *k, dsight *s)
{
    s->a = place_in_flat(&f->a, at_in_a(k->p.at));
    s->b = place_in_flat(&f->b, at_in_b(k->p.at));
    s->way = k->p.w;
    if (k->n == 1) return;
    const dvec edge = dsub(k->q.w, k->p.w);
    const double share = -ddot(k->p.w, edge) / ddot(edge, edge);
    const double part = share > 0 ? share < 1 ? share : 1 : 0;
    s->a = dadd(s->a, dmul(dsub(place_in_flat(&f->a, at_in_a(k->q.at)), s->a), part));
    s->b = dadd(s->b, dmul(dsub(place_in_flat(&f->b, at_in_b(k->q.at)), s->b), part));
    s->way = dadd(s->way, dmul(edge, part));
}

/* How far apart the front is, or whether that is more than the radii; the last corner was asked for along its way. 0:
 * that is not proven, or leaves open whether they meet. */
HOT int tell_flat_front(const flat *f, const dfront *k, const shape *a, const shape *b, const goal *g, result *r)
{
    const double of_a = (double)a->radius, of_b = (double)b->radius, blur = f->blur + f->radius * 0x1p-51;
    dsight s = {.v = k->way};
    sight_flat(f, k, &s);
    const dvec lengths = dlengths(s.way, k->way);
    const double along = dsecond(lengths);
    s.far = dfirst(lengths);
    s.per = 1 / along;
    s.lower = k->height * s.per;
    const double lower = s.lower - f->radius - blur, upper = s.far - f->radius + blur;
    const int meet = upper < 0, narrow = upper - lower <= f->wide && along > f->blur * AWAY;
    if (!(lower > 0) && !meet) return 0;
    if (!narrow && (meet ? g->deep : !g->sign_only)) return 0;
    if (f->radius > 0) move_flat(&s, of_a, of_b, meet, g->deep);
    return spell_flat(f, k, &s, lower, upper, s.far - f->radius, !meet || g->deep, r);
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
    dsight s = {.way = k->last.w, .v = k->way};
    s.a = place_in_flat(&f->a, at_in_a(k->last.at));
    s.b = place_in_flat(&f->b, at_in_b(k->last.at));
    const dvec lengths = dlengths(s.way, k->way);
    s.far = dfirst(lengths);
    s.per = 1 / dsecond(lengths);
    s.lower = k->height * s.per;
    const double lower = s.lower - f->radius - blur;
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

/* They overlap: the corner asked for last and the edge hold the origin. 0: with too little room, or too narrowly for a
 * point of both. */
HOT int tell_flat_held(const flat *f, const dfront *k, result *r)
{
    const dspot at[3] = {k->p, k->q, k->last};
    double square = DBL_MAX, turn[3];
    dsight s = {.v = k->way};
    dvec off = dboth(0);
    for (int i = 0; i < 3; i++) turn[i] = turn_at(at[(i + 1) % 3].w, at[(i + 2) % 3].w, &square);
    if (!((turn[0] > 0 && turn[1] > 0 && turn[2] > 0) || (turn[0] < 0 && turn[1] < 0 && turn[2] < 0))) return 0;
    const double inside = droot(square), blur = 2 * f->blur + f->radius * 0x1p-51;
    if (!(inside > 2 * blur)) return 0;
    s.per = 1 / dlength(k->way);
    s.a = dboth(0);
    for (int i = 0; i < 3; i++) {
        const double share = turn[i] / (turn[0] + turn[1] + turn[2]);
        s.a = dadd(s.a, dmul(place_in_flat(&f->a, at_in_a(at[i].at)), share));
        off = dadd(off, dmul(at[i].w, share));
    }
    off = dsizes(off);
    if (!(dfirst(off) + dsecond(off) <= f->wide)) return 0;
    const double upper = blur - inside - f->radius;
    return spell_flat(f, k, &s, k->height * s.per - f->radius - blur, upper, upper, 0, r);
}

/* What rounding took from the sum of a and b. */
HOT dvec dlost(dvec a, dvec b, dvec sum)
{
    const dvec of_b = dsub(sum, a);
    return dadd(dsub(a, dsub(sum, of_b)), dsub(b, of_b));
}

/* What it took from the place of the body's corner, whose products are exact. */
HOT dvec lost_in_flat(const flat_body *s, unsigned at, dvec *place)
{
    const dvec x = corner_in_flat(s, at), p = dtimes(s->row[0], x), q = dtimes(s->row[1], x);
    const dvec first = dfirsts(p, q), second = dseconds(p, q);
    *place = dadd(first, second);
    return dlost(first, second, *place);
}

/* By how much at least the spot is off, to rounding and from whole multiples of what 1.5 * 2^52 of is off. */
HOT dvec odds_of_dspot(const flat *f, const dspot *p, double off)
{
    dvec x, y, odds = dsizes(lost_in_flat(&f->a, at_in_a(p->at), &x));
    odds = dadd(odds, dsizes(lost_in_flat(&f->b, at_in_b(p->at), &y)));
    const dvec of_b = dsub(f->c, y);
    odds = dadd(odds, dsizes(dlost(f->c, dnegative(y), of_b)));
    odds = dadd(odds, dsizes(dlost(x, of_b, p->w)));
    return dadd(odds, dsizes(dsub(dsub(dadd(p->w, dboth(off)), dboth(off)), p->w)));
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
    const double off = off_above(f->wide * (1 / FLAT_WIDTH));
    dsight s = {.a = dboth(0), .v = k->way};
    double weight[3];
    if (k->n == 0 || k->steps == 0 || !weigh_flat(at, n, weight)) return 0;
    dvec odds = dsizes(dlost(f->a.p, dnegative(f->b.p), f->c));
    for (int i = 0; i < n; i++) odds = dadd(odds, odds_of_dspot(f, at[i], off));
    if (!(dfirst(odds) + dsecond(odds) == 0)) return 0;
    const double sum = weight[0] + weight[1] + weight[2];
    for (int i = 0; i < n; i++) s.a = dadd(s.a, dmul(place_in_flat(&f->a, at_in_a(at[i]->at)), weight[i] / sum));
    s.per = 1 / dlength(k->way);
    return spell_flat(f, k, &s, k->height * s.per - f->blur, 0, 0, 0, r);
}

/* ---- the walk ---- */

/* The front, along which the last corner was asked for, is so near that the radii meet. */
HOT int is_flat_within(const flat *f, const dfront *k)
{
    const double within = f->radius - 4 * f->blur, height = ddot(k->v, k->p.w);
    return within > 0 && height * height < within * within * ddot(k->v, k->v);
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
            const double gap = ddot(k->v, dsub(k->p.w, k->last.w));
            if (k->last.at == k->p.at || k->last.at == k->q.at) return FOREMOST;
            if (!(gap > 0) || gap * gap <= f->blur * f->blur * ddot(k->v, k->v)) return FOREMOST;
            if (g->sign_only && is_flat_within(f, k)) return FOREMOST;
        }
        k->around = !turn_flat(k);
        if (k->around) return AROUND;
    }
}

/* The pair, as far as it is looked at. 0: it is no such, or too large. */
HOT int set_flat(flat *f, const shape *a, const shape *b)
{
    flat_list of_a, of_b;
    real run_a[RUN * DIM], run_b[RUN * DIM];
    if (!list_flat(a, run_a, &of_a) || !list_flat(b, run_b, &of_b)) return 0;
    if (!(a->radius >= 0 && a->radius <= REAL_MAX / 16 && b->radius >= 0 && b->radius <= REAL_MAX / 16)) return 0;
    const double far = pose_flat(a, of_a.reach, &f->a) + pose_flat(b, of_b.reach, &f->b);
    f->c = dsub(f->a.p, f->b.p);
    const dvec apart = dsizes(f->c);
    const double whole = far + (dfirst(apart) + dsecond(apart));
    if (!(whole <= (double)REAL_MAX / 4) && is_too_large(a, b)) return 0;
    f->blur = whole * FLAT_DOUBT;
    f->wide = whole * FLAT_WIDTH;
    f->radius = (double)a->radius + (double)b->radius;
    return take_flat(&of_a, run_a, &f->a, 0, f->c) && take_flat(&of_b, run_b, &f->b, 1, f->c);
}

/* 0: nothing is told. Else r is written as it is told of all bodies, its value 0 where they meet. */
HOT int tell_flat(const shape *a, const shape *b, cache *own, const goal *g, result *r)
{
    flat f;
    dfront k;
    if (a->support == pub(support_box) && b->support == pub(support_box)) return 0; /* told by their axes */
    if (!set_flat(&f, a, b)) return 0;
    k.n = k.steps = k.around = 0;
    if (own && lends(own, a, b)) recall_flat(&f, &k, own);
    const int recalled = k.n;
    if (!recalled) k.v = ddot(f.c, f.c) > 0 ? f.c : dvec_of(1, 0);
    const enum halt at = walk_flat(&f, &k, g);
    int told = at == SHOWN      ? tell_flat_apart(&f, &k, a, b, r)
               : at == FOREMOST ? tell_flat_front(&f, &k, a, b, g, r)
               : at == AROUND   ? !g->deep && tell_flat_held(&f, &k, r)
                                : 0;
    if (!told && !g->deep && f.radius == 0) told = tell_flat_touching(&f, k, r);
    if (told && own) {
        if (k.n == 0) stand_on_dspot(&k, k.last);
        const uint32_t count = (uint32_t)(k.n + k.around), hint = dhint_of(&k);
        if (!recalled || own->count != count || own->reserved != hint) keep_flat(own, &f, count, hint, a, b);
    }
    return told;
}

#else
#define tell_flat(a, b, own, g, r) 0
#endif
#endif

#endif
