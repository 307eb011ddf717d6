/* SPDX-License-Identifier: MIT */
/* Bodies of few corners in the plane, in float where it stands beside its sister: GJK in double, from the first corner
 * on. A map's products have all their digits there, nothing under- or overflows and needs a frame, and the walk sees
 * gaps that are far below what float rounds: so it ends where the truth is, and the last corner that it asks for proves
 * it, with what double rounds charged (docs/bounds.md). Nothing else of the bodies is set up. Overlaps by less than
 * that are left to others, but for contact of short numbers. */
#ifndef GJK_CORE_FLAT_H
#define GJK_CORE_FLAT_H

#include "flat_depth.h"
#include "wide_sticks.h"

#if DIM == 2
#if HAS_SISTER

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
    return spell_flat(f, k->steps, s, lower, upper, s->far - f->radius, !meet || g->deep, r);
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
    return spell_flat(f, k->steps, &s, lower, s.far - f->radius + blur, lower, 1, r);
}

/* They overlap: the corner asked for last and the edge hold the origin, which is to the same side of all three edges.
 * 0: with less room than is in doubt, or too narrowly for a point of both. */
HOT int tell_flat_held(const flat *f, const dfront *k, result *r)
{
    const dspot *const p = &k->p, *const q = &k->q, *const o = &k->last;
    const dvec none = dboth(0), across_p = dsub(o->w, q->w), across_q = dsub(p->w, o->w), across_o = dsub(q->w, p->w);
    /* how far to their left, times their length; which are the corners' weights, too */
    const dvec first = ddots_of(dturned(q->w), across_p, dturned(o->w), across_q);
    const dvec last = dboth(dcross(p->w, across_o));
    const dvec least = dsmaller(first, last), most = dlarger(first, last);
    if (!(dfirst(least) > 0 && dsecond(least) > 0) && !(dfirst(most) < 0 && dsecond(most) < 0)) return 0;
    const dvec far = dsmaller(ddivide(dtimes(first, first), dsquares(across_p, across_q)),
                              ddivide(dtimes(last, last), dboth(ddot(across_o, across_o))));
    const double inside = droot(dleast(dfirst(far), dsecond(far))), blur = 2 * f->blur + f->radius * 0x1p-51;
    const dvec of_p = dfirsts(first, first), of_q = dseconds(first, first);
    const dvec share = ddivide(dboth(1), dadd(dadd(of_p, of_q), last));
    const dvec a = dadd(dadd(dtimes(p->a, of_p), dtimes(q->a, of_q)), dtimes(o->a, last));
    const dvec w = dadd(dadd(dtimes(p->w, of_p), dtimes(q->w, of_q)), dtimes(o->w, last));
    const dvec off = dsizes(dtimes(w, share));
    const dsight s = {.a = dtimes(a, share), .b = none, .v = k->way, .per = 1 / dlength(k->way)};
    if (!(dfirst(off) + dsecond(off) <= f->wide)) return 0;
    const double upper = blur - inside - f->radius;
    return spell_flat(f, k->steps, &s, k->height * s.per - f->radius - blur, upper, upper, 0, r);
}

/* What both numbers are more than whole multiples of what 1.5 * 2^52 of is off; 0 of no such. */
HOT dvec beyond_whole(dvec x, dvec off) { return dsub(dsub(dadd(x, off), off), x); }

/* Likewise the products that the body's corner is placed by, which are exact. */
HOT dvec placed_beyond_whole(const flat_body *s, unsigned at, dvec off)
{
    const dvec x = corner_in_flat(s, at);
    return deither(beyond_whole(dtimes(s->row[0], x), off), beyond_whole(dtimes(s->row[1], x), off));
}

/* Those of all corners are whole. */
static APART int are_placed_whole(const flat_body *s, dvec off)
{
    const unsigned places = has_more_than_run(s) ? PLACES : RUN;
    dvec rest = dboth(0);
    for (unsigned i = 0; i < places; i++) rest = deither(rest, placed_beyond_whole(s, i, off));
    return dsame(rest, dboth(0));
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

/* The corners' places are short numbers where nothing of them is beyond this. */
HOT dvec off_for(const flat *f) { return dboth(off_above(f->wide * (1 / FLAT_WIDTH))); }

/* That they touch in the point seen, and are apart by no less than so high a corner tells; or do no more, if that is
 * asked. 0: that is not known. */
HOT int spell_touching(const flat *f, int steps, const dsight *s, double height, int deep, result *r)
{
    const double lower = height * s->per - f->blur;
    if (deep && !(-lower <= f->wide && 1 > f->blur * AWAY * s->per)) return 0;
    if (!spell_flat(f, steps, s, lower, 0, 0, 0, r)) return 0;
    const int whole = deep && height == 0 && are_placed_whole(&f->a, off_for(f)) && are_placed_whole(&f->b, off_for(f));
    if (whole) r->lower = 0;
    return 1;
}

/* That the cores touch, where the walk has come to, of corners whose places are short numbers: with nothing rounded; or
 * do no more, if that is asked. 0: they are none, or do not. */
static APART int tell_flat_touching(const flat *f, const dfront *k, int deep, result *r)
{
    const int n = k->n + k->around;
    const dspot *const at[3] = {&k->p, k->n > 1 ? &k->q : &k->p, k->around ? &k->last : &k->p};
    const dvec off = off_for(f);
    dsight s = {.a = dboth(0), .v = k->way};
    double weight[3];
    if (k->n == 0 || k->steps == 0 || !weigh_flat(at, n, weight)) return 0;
    dvec rest = deither(beyond_whole(f->a.p, off), beyond_whole(f->b.p, off));
    for (int i = 0; i < n; i++) {
        rest = deither(rest, placed_beyond_whole(&f->a, at_in_a(at[i]->at), off));
        rest = deither(rest, placed_beyond_whole(&f->b, at_in_b(at[i]->at), off));
    }
    if (!dsame(rest, dboth(0))) return 0;
    const double sum = weight[0] + weight[1] + weight[2];
    for (int i = 0; i < n; i++) s.a = dadd(s.a, dmul(at[i]->a, weight[i] / sum));
    s.per = 1 / dlength(k->way);
    return spell_touching(f, k->steps, &s, k->height, deep, r);
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
    const double *bar = barred[s->count];
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
    if (s->count == 1) at[1] = 0;
}

/* Where the walk starts: at the two lowest corners of each body. */
typedef struct dstart {
    unsigned of_a[2], of_b[2];
    dvec gain;   /* which is the nearer of a's edge and b's, where they meet; */
    double part; /* at this share of it the nearest point is; */
    double off;  /* so far to the left of its line the origin, times its length */
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
    t->off = side;
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

/* To the cache, for the next query, the front, if that is not there. */
HOT void pass_flat_on(cache *own, const flat *f, const dfront *k, int recalled, const shape *a, const shape *b)
{
    const uint32_t count = (uint32_t)(k->n + k->around), hint = dhint_of(k);
    if (!recalled || own->count != count || own->reserved != hint) keep_flat(own, f, count, hint, a, b);
}

/* The same of the first front. */
static APART void keep_start(cache *own, const flat *f, const dstart *t, const shape *a, const shape *b)
{
    dfront k = {.around = 0};
    stand_as_started(f, &k, t);
    pass_flat_on(own, f, &k, 0, a, b);
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

/* The pair, but for its corners' places. 0: it is none that is looked at so, or too large. */
HOT int set_flat(flat *f, const shape *a, const shape *b)
{
    if (!list_flat(a, &f->a) || !list_flat(b, &f->b)) return 0;
    if (!(a->radius >= 0 && b->radius >= 0 && a->radius + b->radius <= REAL_MAX / 16)) return 0;
    const double far = pose_flat(a, &f->a) + pose_flat(b, &f->b);
    f->c = dsub(f->a.p, f->b.p);
    const dvec apart = dsizes(f->c);
    const double whole = far + (dfirst(apart) + dsecond(apart));
    if (!(whole <= (double)REAL_MAX / 4) && is_too_large(a, b)) return 0;
    f->blur = whole * FLAT_DOUBT;
    f->wide = whole * FLAT_WIDTH;
    f->radius = (double)a->radius + (double)b->radius;
    return 1;
}

/* What the walk has found. */
HOT int tell_walked_flat(const flat *f, dfront *k, enum halt at, int recalled, const shape *a, const shape *b,
                         cache *own, const goal *g, result *r)
{
    int told = at == SHOWN      ? tell_flat_apart(f, k, a, b, r)
               : at == FOREMOST ? tell_flat_front(f, k, a, b, g, r)
               : at == AROUND   ? DEPTHS && g->deep ? tell_flat_deep(f, k, a, b, g, r) : tell_flat_held(f, k, r)
                                : 0;
    if (!told && f->radius == 0) {
        const dfront last = *k; /* by whose address k is not known */
        told = tell_flat_touching(f, &last, g->deep, r);
    }
    if (told && own) {
        if (k->n == 0) stand_on_dspot(k, k->last);
        pass_flat_on(own, f, k, recalled, a, b);
    }
    return told;
}

/* Where the first front is an edge, beyond which no corner is lower, that holds the origin: that the cores touch, as
 * tell_flat_touching has it. The edge's products are exact, so that they tell where on it the origin is. From and to
 * are its ends, which are made of one corner of a body and two of the other. */
HOT int touch_at_start(const flat *f, unsigned from, unsigned to, int steps, double height, const dsight *s, int deep,
                       result *r)
{
    const unsigned of_a = at_in_a(from), of_b = at_in_b(from), is_b = of_a == at_in_a(to);
    const dvec off = off_for(f);
    dvec rest = deither(beyond_whole(f->a.p, off), beyond_whole(f->b.p, off));
    rest = deither(rest, placed_beyond_whole(&f->a, of_a, off));
    rest = deither(rest, placed_beyond_whole(&f->b, of_b, off));
    rest = deither(rest, placed_beyond_whole(is_b ? &f->b : &f->a, is_b ? at_in_b(to) : at_in_a(to), off));
    return dsame(rest, dboth(0)) && spell_touching(f, steps, s, height, deep, r);
}

/* How far apart, or how deep, from the first front, which tells too little, in so many steps; v is its own. What has
 * been seen along it is looked at again: to keep it would cost all the others more. */
static APART int go_on_flat(const flat *f, dvec v, int steps, const dstart *t, const shape *a, const shape *b,
                            cache *own, int deep, int max_steps, result *r)
{
    const goal g = {.deep = deep, .max_steps = max_steps};
    enum halt at = FOREMOST;
    dfront k;
    k.v = v;
    k.steps = steps - 1;
    k.around = k.under = 0;
    stand_as_started(f, &k, t);
    ask_flat(f, &k);
    if (!is_flat_foremost(f, &k)) {
        k.around = !turn_flat(&k);
        at = k.around ? AROUND : walk_flat(f, &k, &g);
    }
    return tell_walked_flat(f, &k, at, 0, a, b, own, &g, r);
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
    const double height = lowest_in_flat(f, k->v);
    const enum halt at = (near - height) * s.per > f->blur ? LOST : FOREMOST;
    const int is_b = dfirst(t.gain) < dsecond(t.gain), on_edge = t.off == 0 && t.part > 0 && t.part < 1;
    const unsigned from = t.of_a[0] + PLACES * t.of_b[0], to = t.of_a[!is_b] + PLACES * t.of_b[is_b];
    k->steps++;
    if (at == FOREMOST &&
        (on_edge && !(f->radius > 0) ? touch_at_start(f, from, to, k->steps, height, &s, g->deep, r)
                                     : tell_flat_sight(f, k, &s, height * s.per, along, a, b, g, r))) {
        if (own) keep_start(own, f, &t, a, b);
        return 1;
    }
    const dstart start = t;
    return go_on_flat(f, k->v, k->steps, &start, a, b, own, g->deep, g->max_steps, r);
}

/* Whether they meet: by the first corner, if that shows them to be apart, else from the first front on. */
HOT int tell_flat_meeting(const flat *f, dfront *k, const shape *a, const shape *b, cache *own, const goal *g,
                          result *r)
{
    dlook l;
    dstart t;
    dsight s;
    look_flat(f, k, &l);
    k->height = dfirst(l.a.least) + dfirst(l.b.least);
    if (shows_apart_flat(f, k)) {
        find_last(f, k, &l);
        return tell_walked_flat(f, k, SHOWN, 0, a, b, own, g, r);
    }
    start_flat(f, k, &l, &t, &s);
    stand_as_started(f, k, &t);
    return tell_walked_flat(f, k, walk_flat(f, k, g), 0, a, b, own, g, r);
}

/* The corner of the difference that these make. */
HOT dspot dspot_made(const flat *f, const real *x, const real *y)
{
    const dvec a = ddots(f->a.row[0], f->a.row[1], dload(x));
    const dvec b = dsub(f->c, ddots(f->b.row[0], f->b.row[1], dload(y)));
    return (dspot){dadd(a, b), a, b, 0};
}

/* A front's ends, which are one where it is a corner, as a cache lends them. 0: it lends none, or others. */
HOT int borrow_front(const flat *f, const cache *from, dspot *p, dspot *q)
{
    const uint32_t first = from->reserved, last = from->count > 1 ? first >> 8 : first, other = from->count > 1;
    const real *x = corner_there(&f->a, at_in_a(first), from->a[0]);
    const real *y = corner_there(&f->b, at_in_b(first), from->b[0]);
    const real *z = corner_there(&f->a, at_in_a(last), from->a[other]);
    const real *u = corner_there(&f->b, at_in_b(last), from->b[other]);
    if (!x || !y || !z || !u) return 0;
    *p = dspot_made(f, x, y);
    *q = dspot_made(f, z, u);
    return 1;
}

/* The front from p to q: how far along it the nearest point is, and its v; without a branch. */
HOT double stand_from_to(const dspot *p, const dspot *q, dvec *v, dsight *s)
{
    const dvec none = dboth(0), one = dboth(1), edge = dsub(q->w, p->w), square = dturned(edge);
    const dvec from = dboth(-ddot(p->w, edge)), whole = dboth(ddot(edge, edge));
    const dvec within = dwhere_below(none, from, dwhere_below(from, whole, one, none), none);
    const dvec part = dsmaller(dlarger(ddivide(from, whole), none), one); /* 0 of one corner */
    sight_between(s, p->a, p->b, dsub(q->a, p->a), dsub(q->b, p->b), part);
    *v = dwhere_below(none, within, dflipped(square, ddot(square, p->w)), s->way);
    return dfirst(part);
}

/* Leaves in the cache what of the edge in it is nearest. */
HOT void keep_nearest(cache *own, double part)
{
    if (own->count < 2 || (part > 0 && part < 1)) return;
    own->count = 1;
    if (!(part > 0)) return;
    own->reserved >>= 8;
    memcpy(own->a[0], own->a[1], sizeof own->a[0]);
    memcpy(own->b[0], own->b[1], sizeof own->b[0]);
}

/* How far apart by the front that the cache lends, if it is still the nearest, or whether they meet: no corner is
 * placed but those of that front. What is asked is handed on as numbers: a goal by its address is written to memory at
 * the door, for all. 0: that does not tell. */
static APART int tell_flat_again(const shape *a, const shape *b, cache *own, int sign_only, int deep, result *r)
{
    const goal g = {.sign_only = sign_only, .deep = deep};
    flat f;
    dfront k = {.steps = 1};
    dspot p, q;
    dsight s;
    lanes fit_a, fit_b;
    if (!set_flat(&f, a, b) || !borrow_front(&f, own, &p, &q)) return 0;
    const double part = stand_from_to(&p, &q, &k.v, &s), along = measure_flat(&s, k.v), near = ddot(k.v, s.way);
    const double least_a = least_in_flat(&f.a, dpulled(f.a.row, k.v), &fit_a);
    const double least_b = least_in_flat(&f.b, dpulled(f.b.row, dopposite(k.v)), &fit_b);
    const double height = ddot(k.v, f.c) + (least_a + least_b);
    if (!holds_in_all(in_both(fit_a, fit_b))) return 0;
    if (!sign_only && (near - height) * s.per > f.blur) return 0;
    if (!tell_flat_sight(&f, &k, &s, height * s.per, along, a, b, &g, r)) return 0;
    keep_nearest(own, part);
    return 1;
}

/* From the corners that the cache lends on, in so many steps. 0: nothing is told. */
static APART int go_on_lent(const flat *f, int *steps, const shape *a, const shape *b, cache *own, int sign_only,
                            int deep, int max_steps, result *r)
{
    const goal g = {.sign_only = sign_only, .deep = deep, .max_steps = max_steps};
    dfront k;
    k.n = k.steps = k.around = k.under = 0;
    recall_flat(f, &k, own);
    if (k.n == 0) return 0;
    const enum halt at = walk_flat(f, &k, &g);
    *steps = k.steps;
    return tell_walked_flat(f, &k, at, 1, a, b, own, &g, r);
}

/* 0: nothing is told. Else r is written as it is told of all bodies, its value 0 where they meet. */
HOT int tell_flat(const shape *a, const shape *b, cache *own, const goal *g, result *r)
{
    flat f;
    dfront k;
    int steps = 0;
    if (a->support != pub(support_points)) {
        if (a->support == pub(support_box) && b->support == pub(support_box)) return 0; /* told by their axes */
        if (tell_wide_sticks(a, b, g, r)) {
            if (own) own->count = 0; /* there is nothing that a formula would start from */
            return 1;
        }
    }
    const int lent = own && lends(own, a, b);
    if (lent && own->count < 3 && !(own->reserved & UNDER) && tell_flat_again(a, b, own, g->sign_only, g->deep, r))
        return 1;
    if (!set_flat(&f, a, b)) return 0;
    if (!holds_in_all(in_both(take_flat(&f.a, 0, f.c), take_flat(&f.b, 1, f.c)))) return 0;
    if (lent && go_on_lent(&f, &steps, a, b, own, g->sign_only, g->deep, g->max_steps, r)) return 1;
    k.n = k.around = k.under = 0;
    k.steps = steps;
    k.v = ddot(f.c, f.c) > 0 ? f.c : dvec_of(1, 0);
    if (g->max_steps <= steps + 1) return tell_walked_flat(&f, &k, walk_flat(&f, &k, g), 0, a, b, own, g, r);
    if (g->sign_only) return tell_flat_meeting(&f, &k, a, b, own, g, r);
    return tell_flat_start(&f, &k, a, b, own, g, r);
}

#else
#define tell_flat(a, b, own, g, r) 0
#endif
#endif

#endif
