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
static APART void fill_run(const list *l, real run[RUN * DIM])
{
    for (size_t i = 0, k = 0; i < RUN; i++, k = k + 1 < l->count ? k + 1 : 0) {
        run[DIM * i] = l->v[l->step * k];
        run[DIM * i + 1] = l->v[l->step * k + 1];
    }
}

#if HAS_SISTER

/* Bounds are off by so much of A + B + |c|_1 at most, where the bodies reach A and B from their positions, c apart: 12
 * roundings (docs/bounds.md). */
#define FLAT_DOUBT 0x1p-49

/* By so much may a bracket be wide, if it is to be the answer: a share of a float's rounding of them. */
#define FLAT_WIDTH 0x1p-26

/* So many times what bounds are off is a corner's distance to be a direction, to a float's rounding. */
#define AWAY 0x1p20

/* ---- the bodies ---- */

typedef struct flat_body {
    real at[DIM][PLACES]; /* the corners, in its own coordinates: the list's first run and its last, as a cluster has
                             them (planar.h) */
    dvec row[DIM], p;     /* its map by rows, and where it is; */
    double far;           /* no point of it is farther from there */
    list from;            /* the corners as they are given; */
    double reach;         /* how far these are from their origin, at most; */
    real limit;           /* no coordinate is above this */
    real run[RUN * DIM];  /* those of a box, or what stands there again and again */
} flat_body;

/* A box's corners in order. */
HOT void spell_box(const box *k, flat_body *s)
{
    for (int i = 0; i < RUN; i++) {
        s->run[DIM * i] = i & 1 ? k->half[0] : -k->half[0];
        s->run[DIM * i + 1] = i & 2 ? k->half[1] : -k->half[1];
    }
    s->from = (list){s->run, RUN, DIM, 0};
    s->reach = (double)k->half[0] + (double)k->half[1];
}

/* The corners, and how far they reach. 0: they are not known, or there are too many, or the data are none. */
HOT int list_flat(const shape *k, flat_body *s)
{
    static const real nothing[DIM] = {0};
    s->limit = REAL_MAX;
    if (k->support == pub(support_points)) {
        const points *p = k->data;
        if (!p || !p->v) return 0;
        const size_t step = stride_of(p);
        if (p->count - 1 > PLACES - 1 || step < DIM || p->stride % sizeof(real) != 0 || !(p->reach > TINY)) return 0;
        s->from = (list){p->v, p->count, step, p->reach};
        s->reach = (double)p->reach;
        s->limit = smaller(p->reach * (1 + 16 * UNIT), REAL_MAX);
    } else if (k->support == pub(support_segment)) {
        const segment *e = k->data;
        if (!e) return 0;
        s->from = (list){e->v[0], 2, DIM, 0};
        s->reach = -dleast(-dspread(e->v[0]), -dspread(e->v[1]));
    } else if (k->support == pub(support_box)) {
        const box *e = k->data;
        if (!e || !(e->half[0] >= 0 && e->half[1] >= 0)) return 0;
        spell_box(e, s);
    } else {
        s->from = (list){nothing, 1, DIM, 0};
        s->reach = 0;
        return k->support == pub(support_origin);
    }
    return 1;
}

/* A run of corners. 0: one is none, or beyond the limit. */
HOT int take_run(const real *x, size_t step, flat_body *s, size_t at)
{
    int fit = (1 << LANES) - 1;
    for (size_t j = at; j < at + RUN; j += LANES, x += LANES * step) {
        lanes c[DIM];
        load_lanes(x, step, c);
        EACH(fit &= any_as_large(in_all(s->limit), sizes(c[i])); part_lanes(c[i], s->at[i] + j));
    }
    return fit == (1 << LANES) - 1;
}

/* All of them, and the pose. 0: one is none, or beyond the limit. */
HOT int take_flat(const shape *k, flat_body *s)
{
    static const pose none = {{1, 0, 0, 1}, {0, 0}};
    const pose *o = k->pose ? k->pose : &none;
    const list *l = &s->from;
    s->row[0] = dload(o->m);
    s->row[1] = dload(o->m + DIM);
    s->p = dload(o->p);
    const dvec far = dadd(dsizes(s->row[0]), dsizes(s->row[1]));
    s->far = (dfirst(far) + dsecond(far)) * (s->reach * 1.5);
    if (l->count >= RUN)
        return take_run(l->v, l->step, s, 0) & take_run(l->v + (l->count - RUN) * l->step, l->step, s, RUN);
    fill_run(l, s->run);
    return take_run(s->run, DIM, s, 0) & take_run(s->run, DIM, s, RUN);
}

HOT dvec corner_in_flat(const flat_body *s, unsigned at) { return dvec_of((double)s->at[0][at], (double)s->at[1][at]); }

HOT dvec place_in_flat(const flat_body *s, dvec x) { return ddots(s->row[0], s->row[1], x); }

/* The first of the corners that are lowest along v. */
HOT unsigned lowest_in_flat(const flat_body *s, dvec v)
{
    const dvec way = dpull(s->row, v), x = dfirsts(way, way), y = dseconds(way, way);
    dvec heights[PLACES / 2], least;
    unsigned lowest = 1u << (PLACES - 1); /* where no height is a number */
    for (int i = 0; i < PLACES; i += 2)
        heights[i / 2] = dadd(dtimes(dload(s->at[0] + i), x), dtimes(dload(s->at[1] + i), y));
    least = dsmaller(dsmaller(heights[0], heights[1]), dsmaller(heights[2], heights[3]));
    least = dsmaller(dseconds(least, least), dfirsts(least, least));
    least = dfirsts(least, least);
    for (int i = 0; i < PLACES; i += 2) lowest |= dwithin(heights[i / 2], least) << i;
    return first_bit(lowest);
}

/* How far the body reaches, as its support says. */
static real reach_of_flat(const flat_body *s, const shape *of)
{
    if (of->support == pub(support_box)) return at_most(load(((const box *)of->data)->half));
    return s->from.reach != 0 ? s->from.reach : reach_of(s->from.v, s->from.count);
}

/* The pair is too large for a frame (minkowski.h): such are refused, all of them. */
static APART int is_too_large(const flat_body *s, const flat_body *t, const shape *a, const shape *b)
{
    const real far_a = reach_of_flat(s, a) * (a->pose ? stretch(a->pose->m) : 1);
    const real far_b = reach_of_flat(t, b) * (b->pose ? stretch(b->pose->m) : 1);
    return !(far_a + far_b + spread(offset(a->pose, b->pose)) <= REAL_MAX / 4);
}

/* ---- the front ---- */

/* A corner of the difference, and where those of the bodies stand, as a spot of planar.h has it. */
typedef struct dspot {
    dvec w;
    unsigned at;
} dspot;

/* What is nearest to the origin so far, as the front of planar.h. */
typedef struct flat {
    flat_body a, b;
    dvec c;        /* from a's position to b's */
    double blur;   /* what bounds are off at most; */
    double wide;   /* what they may be apart; */
    double radius; /* of both */
    dspot p, q, last;
    int n;
    dvec v;                    /* the corner; or square to the edge from p to q, away from the origin */
    dvec edge_a, edge_b, edge; /* this edge, of the bodies and of the difference */
    dvec way;                  /* along which the last corner has been asked for, */
    double height;             /* so high it lies there, times the way's length; */
    int steps, around;
} flat;

static inline unsigned at_in_a(unsigned at) { return at % PLACES; }
static inline unsigned at_in_b(unsigned at) { return at / PLACES % PLACES; }

HOT dspot dspot_at(const flat *f, unsigned at)
{
    const dvec x = place_in_flat(&f->a, corner_in_flat(&f->a, at_in_a(at)));
    const dvec y = place_in_flat(&f->b, corner_in_flat(&f->b, at_in_b(at)));
    return (dspot){dsub(x, dadd(y, f->c)), at};
}

/* The corner of the difference that is least along v. */
HOT void ask_flat(flat *f)
{
    const unsigned of_a = lowest_in_flat(&f->a, f->v), of_b = lowest_in_flat(&f->b, dnegative(f->v));
    f->way = f->v;
    f->last = dspot_at(f, of_a + PLACES * of_b);
    f->height = ddot(f->way, f->last.w);
    f->steps++;
}

HOT void stand_on_dspot(flat *f, dspot p)
{
    f->p = f->q = p;
    f->n = 1;
    f->v = p.w;
}

HOT dvec way_in_flat(const flat_body *s, unsigned from, unsigned to)
{
    return place_in_flat(s, dsub(corner_in_flat(s, to), corner_in_flat(s, from)));
}

HOT void stand_between(flat *f, dspot p, dspot q)
{
    f->edge_a = way_in_flat(&f->a, at_in_a(p.at), at_in_a(q.at));
    f->edge_b = way_in_flat(&f->b, at_in_b(p.at), at_in_b(q.at));
    f->edge = dsub(f->edge_a, f->edge_b);
    const dvec square = dturned(f->edge);
    f->v = ddot(square, p.w) < 0 ? dnegative(square) : square;
    f->p = p;
    f->q = q;
    f->n = 2;
}

/* Takes in the corner asked for last, as turn_front does. 0: with the edge it holds the origin. */
HOT int turn_flat(flat *f)
{
    const dspot p = f->p, q = f->q, last = f->last;
    const dvec left = dsub(p.w, last.w);
    if (f->n == 0) {
        stand_on_dspot(f, last);
    } else if (f->n == 1) {
        const double from = ddot(p.w, left), to = ddot(last.w, left);
        if (from > 0 && to < 0) stand_between(f, p, last);
        else stand_on_dspot(f, from > 0 ? last : p);
    } else {
        const dvec right = dsub(q.w, last.w);
        const double turn = dcross(left, right) < 0 ? -1 : 1;
        const int beyond_left = dcross(last.w, left) * turn<0, beyond_right = dcross(last.w, right) * turn> 0;
        if (!beyond_left && !beyond_right) return 0;
        if (beyond_left && ddot(last.w, left) < 0) stand_between(f, p, last);
        else if (beyond_right && ddot(last.w, right) < 0) stand_between(f, q, last);
        else stand_on_dspot(f, last);
    }
    return 1;
}

/* ---- what a cache holds ---- */

static inline uint32_t dhint_of(const flat *f)
{
    uint32_t r = f->p.at;
    if (f->n > 1) r |= f->q.at << 8;
    if (f->around) r |= f->last.at << 8 * f->n;
    return r;
}

/* It holds them already, as has been seen. */
static inline int is_kept_flat(const cache *own, const flat *f)
{
    return own->count == (uint32_t)(f->n + f->around) && own->reserved == dhint_of(f);
}

static APART void keep_flat(cache *own, const flat *f, const shape *a, const shape *b)
{
    uint32_t hint = dhint_of(f);
    const uint32_t count = (uint32_t)(f->n + f->around);
    own->count = count;
    own->reserved = hint;
    for (uint32_t i = 0; i < count; i++, hint >>= 8) {
        dstore(own->a[i], corner_in_flat(&f->a, at_in_a(hint)));
        dstore(own->b[i], corner_in_flat(&f->b, at_in_b(hint)));
    }
    own->reach_a = reach_of_flat(&f->a, a);
    own->reach_b = reach_of_flat(&f->b, b);
    own->support[0] = a->support;
    own->support[1] = b->support;
    own->data[0] = a->data;
    own->data[1] = b->data;
}

/* From the corners of the last query, if they stand where they did. */
HOT void recall_flat(flat *f, const cache *from)
{
    uint32_t hint = from->reserved;
    for (uint32_t i = 0; i < from->count; i++, hint >>= 8) {
        const unsigned at = hint % (PLACES * PLACES);
        f->last = dspot_at(f, at);
        if (!dsame(corner_in_flat(&f->a, at_in_a(at)), dload(from->a[i])) ||
            !dsame(corner_in_flat(&f->b, at_in_b(at)), dload(from->b[i]))) {
            f->n = 0;
            return;
        }
        turn_flat(f);
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
HOT int spell_flat(const flat *f, const dsight *s, double lower, double upper, double value, int apart, result *r)
{
    const real low = dbelow(lower), high = upper > 0 ? dabove(upper) : smaller(dabove(upper), 0);
    const dvec x = dinto_range(dadd(s->a, f->a.p));
    if (!(low > 0 || upper <= 0) || !(lower >= -BROADEST && upper <= BROADEST)) return 0;
    r->lower = low;
    r->upper = high;
    r->value = (real)value;
    dstore(r->point_a, x);
    dstore(r->point_b, apart ? dinto_range(dadd(s->b, f->b.p)) : x);
    dstore(r->normal, dnegative(dmul(s->v, s->per)));
    r->steps = f->steps;
    r->supports = 2 * f->steps;
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
HOT void sight_flat(const flat *f, dsight *s)
{
    const dvec x = corner_in_flat(&f->a, at_in_a(f->p.at)), y = corner_in_flat(&f->b, at_in_b(f->p.at));
    s->a = place_in_flat(&f->a, x);
    s->b = place_in_flat(&f->b, y);
    s->way = f->p.w;
    if (f->n == 1) return;
    const double share = -ddot(f->p.w, f->edge) / ddot(f->edge, f->edge);
    const double part = share > 0 ? share < 1 ? share : 1 : 0;
    s->a = dadd(s->a, dmul(f->edge_a, part));
    s->b = dadd(s->b, dmul(f->edge_b, part));
    s->way = dadd(s->way, dmul(f->edge, part));
}

/* How far apart the front is, or whether that is more than the radii; the last corner was asked for along its way. 0:
 * that is not proven, or leaves open whether they meet. */
HOT int tell_flat_front(const flat *f, const shape *a, const shape *b, const goal *g, result *r)
{
    const double of_a = (double)a->radius, of_b = (double)b->radius, blur = f->blur + f->radius * 0x1p-51;
    dsight s = {.v = f->way};
    sight_flat(f, &s);
    s.far = dlength(s.way);
    s.per = 1 / dlength(f->way);
    s.lower = f->height * s.per;
    const double lower = s.lower - f->radius - blur, upper = s.far - f->radius + blur;
    const int meet = upper < 0, narrow = upper - lower <= f->wide && (f->n > 1 || s.far > f->blur * AWAY);
    if (!(lower > 0) && !meet) return 0;
    if (!narrow && (meet ? g->deep : !g->sign_only)) return 0;
    if (f->radius > 0) move_flat(&s, of_a, of_b, meet, g->deep);
    return spell_flat(f, &s, lower, upper, s.far - f->radius, !meet || g->deep, r);
}

/* That they are apart, as the last corner shows, if that is all that is asked. */
HOT int shows_apart_flat(const flat *f)
{
    const double least = f->radius + 2 * f->blur;
    return f->height > 0 && f->height * f->height > least * least * ddot(f->way, f->way);
}

HOT int tell_flat_apart(const flat *f, const shape *a, const shape *b, result *r)
{
    const double blur = f->blur + f->radius * 0x1p-51;
    dsight s = {.way = f->last.w, .v = f->way};
    s.a = place_in_flat(&f->a, corner_in_flat(&f->a, at_in_a(f->last.at)));
    s.b = place_in_flat(&f->b, corner_in_flat(&f->b, at_in_b(f->last.at)));
    s.far = dlength(s.way);
    s.per = 1 / dlength(f->way);
    s.lower = f->height * s.per;
    const double lower = s.lower - f->radius - blur;
    if (!(lower > 0)) return 0;
    if (f->radius > 0) move_flat(&s, (double)a->radius, (double)b->radius, 0, 0);
    return spell_flat(f, &s, lower, s.far - f->radius + blur, lower, 1, r);
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
HOT int tell_flat_held(const flat *f, result *r)
{
    const dspot *at[3] = {&f->p, &f->q, &f->last};
    double square = DBL_MAX, turn[3];
    dsight s = {.v = f->way};
    dvec off = dboth(0);
    for (int i = 0; i < 3; i++) turn[i] = turn_at(at[(i + 1) % 3]->w, at[(i + 2) % 3]->w, &square);
    if (!((turn[0] > 0 && turn[1] > 0 && turn[2] > 0) || (turn[0] < 0 && turn[1] < 0 && turn[2] < 0))) return 0;
    const double inside = droot(square), blur = 2 * f->blur + f->radius * 0x1p-51;
    if (!(inside > 2 * blur)) return 0;
    s.per = 1 / dlength(f->way);
    s.a = dboth(0);
    for (int i = 0; i < 3; i++) {
        const double share = turn[i] / (turn[0] + turn[1] + turn[2]);
        s.a = dadd(s.a, dmul(place_in_flat(&f->a, corner_in_flat(&f->a, at_in_a(at[i]->at))), share));
        off = dadd(off, dmul(at[i]->w, share));
    }
    off = dsizes(off);
    if (!(dfirst(off) + dsecond(off) <= f->wide)) return 0;
    const double upper = blur - inside - f->radius;
    return spell_flat(f, &s, f->height * s.per - f->radius - blur, upper, upper, 0, r);
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
    const dvec from = dadd(y, f->c);
    odds = dadd(odds, dsizes(dlost(y, f->c, from)));
    odds = dadd(odds, dsizes(dlost(x, dnegative(from), p->w)));
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
static APART int tell_flat_touching(flat own, result *r)
{
    const flat *f = &own;
    const int n = f->n + f->around;
    const dspot *const at[3] = {&f->p, f->n > 1 ? &f->q : &f->p, f->around ? &f->last : &f->p};
    const double off = off_above(f->wide * (1 / FLAT_WIDTH));
    dsight s = {.a = dboth(0), .v = f->way};
    double weight[3];
    if (f->n == 0 || f->steps == 0 || !weigh_flat(at, n, weight)) return 0;
    dvec odds = dsizes(dlost(f->b.p, dnegative(f->a.p), f->c));
    for (int i = 0; i < n; i++) odds = dadd(odds, odds_of_dspot(f, at[i], off));
    if (!(dfirst(odds) + dsecond(odds) == 0)) return 0;
    const double sum = weight[0] + weight[1] + weight[2];
    for (int i = 0; i < n; i++)
        s.a = dadd(s.a, dmul(place_in_flat(&f->a, corner_in_flat(&f->a, at_in_a(at[i]->at))), weight[i] / sum));
    s.per = 1 / dlength(f->way);
    return spell_flat(f, &s, f->height * s.per - f->blur, 0, 0, 0, r);
}

/* ---- the walk ---- */

/* The front, along which the last corner was asked for, is so near that the radii meet. */
HOT int is_flat_within(const flat *f)
{
    const double within = f->radius - 4 * f->blur, height = ddot(f->v, f->p.w);
    return within > 0 && height * height < within * within * ddot(f->v, f->v);
}

/* Where it ends: nowhere; where the corner asked for last shows that they are apart; at a front that is nearest; or
 * around the origin. */
HOT enum halt walk_flat(flat *f, const goal *g)
{
    for (;;) {
        if (f->steps >= ASKED_MOST || f->steps >= g->max_steps || !(ddot(f->v, f->v) > 0)) return LOST;
        ask_flat(f);
        if (g->sign_only && shows_apart_flat(f)) return SHOWN;
        if (f->n > 0) {
            const double gap = ddot(f->v, dsub(f->p.w, f->last.w));
            if (f->last.at == f->p.at || f->last.at == f->q.at) return FOREMOST;
            if (!(gap > 0) || gap * gap <= f->blur * f->blur * ddot(f->v, f->v)) return FOREMOST;
            if (g->sign_only && is_flat_within(f)) return FOREMOST;
        }
        f->around = !turn_flat(f);
        if (f->around) return AROUND;
    }
}

/* 0: nothing is told. Else r is written as it is told of all bodies, its value 0 where they meet. */
HOT int tell_flat(const shape *a, const shape *b, cache *own, const goal *g, result *r)
{
    flat f;
    if (a->support == pub(support_box) && b->support == pub(support_box)) return 0; /* told by their axes */
    if (!list_flat(a, &f.a) || !list_flat(b, &f.b)) return 0;
    if (!(a->radius >= 0 && a->radius <= REAL_MAX / 16 && b->radius >= 0 && b->radius <= REAL_MAX / 16)) return 0;
    if (!take_flat(a, &f.a) || !take_flat(b, &f.b)) return 0;
    f.c = dsub(f.b.p, f.a.p);
    const dvec apart = dsizes(f.c);
    const double whole = f.a.far + f.b.far + (dfirst(apart) + dsecond(apart));
    if (!(whole <= (double)REAL_MAX / 4) && is_too_large(&f.a, &f.b, a, b)) return 0;
    f.blur = whole * FLAT_DOUBT;
    f.wide = whole * FLAT_WIDTH;
    f.radius = (double)a->radius + (double)b->radius;
    f.n = f.steps = f.around = 0;
    if (own && lends(own, a, b)) recall_flat(&f, own);
    const int recalled = f.n;
    if (!recalled) f.v = ddot(f.c, f.c) > 0 ? dnegative(f.c) : dvec_of(1, 0);
    const enum halt at = walk_flat(&f, g);
    int told = at == SHOWN      ? tell_flat_apart(&f, a, b, r)
               : at == FOREMOST ? tell_flat_front(&f, a, b, g, r)
               : at == AROUND   ? !g->deep && tell_flat_held(&f, r)
                                : 0;
    if (!told && !g->deep && f.radius == 0) told = tell_flat_touching(f, r);
    if (told && own && !(recalled && is_kept_flat(own, &f))) keep_flat(own, &f, a, b);
    return told;
}

#else
#define tell_flat(a, b, own, g, r) 0
#endif
#endif

#endif
