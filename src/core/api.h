/* SPDX-License-Identifier: MIT */
/* The door: arguments are checked on the way in, the result is written on the way out, once and whole. */
#ifndef GJK_CORE_API_H
#define GJK_CORE_API_H

#include "intersect.h"
#include "tight.h"

#define OPTIONS_LARGEST 1024 /* beyond any size this struct will grow to; a larger one was never set */

static int sound(const shape *s)
{
    if (!s || !s->support || !(s->radius >= 0 && s->radius <= REAL_MAX / 16)) return 0;
    if (!s->pose) return 1;
    int r = 1;
    for (int i = 0; i < DIM * DIM; i++) r &= bounded(s->pose->m[i]);
    for (int i = 0; i < DIM; i++) r &= bounded(s->pose->p[i]);
    return r;
}

/* Options of any age: a shorter struct ends before the pointers, or after one; what a longer one says beyond the end of
 * ours must be nothing. */
static int read_options(options *o, const options *given)
{
    const unsigned char *from = (const unsigned char *)given;
    uint32_t given_size = sizeof *o;
    memset(o, 0, sizeof *o);
    if (given) {
        given_size = given->size;
        if (given_size < offsetof(options, cache) || given_size > OPTIONS_LARGEST) return 0;
        if (given_size < sizeof *o && (given_size - offsetof(options, cache)) % sizeof(void *) != 0) return 0;
        for (size_t i = sizeof *o; i < given_size; i++)
            if (from[i] != 0) return 0;
        memcpy(o, given, given_size < sizeof *o ? given_size : sizeof *o);
    }
    if (o->max_steps == 0) o->max_steps = 256;
    if (o->max_steps > INT32_MAX / 4) o->max_steps = INT32_MAX / 4;
    return o->abs_tol >= 0 && o->rel_tol >= 0 && o->cutoff >= 0 && o->slack >= 0 && bounded(o->abs_tol) &&
           bounded(o->rel_tol) && bounded(o->cutoff) && bounded(o->slack) && o->reserved == NULL && o->tight <= 1 &&
           o->reserved_bits == 0;
}

/* What a later query of this pair may start from. */
static void remember(cache *k, const search *q, const shape *a, const shape *b)
{
    int n = q->s.n, lent = 1;
    for (int i = 0; i < n; i++) lent &= (int)(q->borrowed >> q->s.at[i] & 1);
    if (lent && q->repeated) return;     /* nothing new: the cache may hold more than this simplex */
    if (q->pending && !q->repeated) n++; /* the corner in the spare slot: the next query may be answered with it */
    for (int i = 0; i < n; i++) {
        store(k->a[i], corner(&q->s, i)->x);
        store(k->b[i], corner(&q->s, i)->y);
    }
    k->count = (uint32_t)n;
    k->reserved = 0;
    k->reach_a = q->d.a.reach;
    k->reach_b = q->d.b.reach;
    k->support[0] = a->support;
    k->support[1] = b->support;
    k->data[0] = a->data;
    k->data[1] = b->data;
}

/* The goal in the search's scale. */
static goal scaled(const goal *g, real scale)
{
    goal r = *g;
    r.beyond = smaller(g->beyond * scale, REAL_MAX);
    r.within = smaller(g->within * scale, REAL_MAX);
    r.radius = smaller(g->radius * scale, REAL_MAX);
    r.abs_tol = smaller(g->abs_tol * scale, REAL_MAX);
    return r;
}

/* Searches, from the cache if that fits. Returns how the search ended, with an upper bound of the cores' separation;
 * FAULT also where the bounds cross, which points of two convex sets never do. */
static enum end run(search *q, const shape *a, const shape *b, const options *o, const goal *g, real *upper,
                    real weight[])
{
    int warm = o->cache != NULL;
    enum end end;
    q->d.calls = 0;
    for (;;) {
        end = FAULT;
        if (warm) warm = open_warm(q, a, b, o->slack, o->cache);
        if (warm || open_cold(q, a, b, o->slack)) {
            goal here = scaled(g, q->d.scale);
            end = search_on(q, &here, upper, weight);
        }
        if (end != FAULT) {
            if (end == INSIDE && room(&q->s) > q->d.doubt) *upper = q->d.doubt - room(&q->s);
            if (q->lower <= *upper && settled(q)) break;
        }
        if (!warm) return FAULT;
        warm = 0;
    }
    if (o->cache) remember(o->cache, q, a, b);
    return end;
}

/* Where the search has come to its end on contact, and the bracket of the cores straddles it, finds out on which side
 * they are, if rounding allows. 0: a support's answer was none. */
static int tell(search *q, const goal *g, real *upper, enum end *end)
{
    if ((*end != STILL && *end != INSIDE) || q->lower > 0 || *upper < 0 || *upper < g->within * q->d.scale) return 1;
    enum end told = probe(q, g->max_steps, upper);
    if (told == OPEN) *end = OPEN;
    return told != FAULT;
}

/* The bracket in the caller's units, the radii taken off, each bound rounded its own way. */
static void bracket(result *r, const difference *d, real lower, real upper, real radius)
{
    real tiny = d->wild ? 2 * TINY : 0, near = lower * d->unscale, far = upper * d->unscale;
    real doubt_near = radius > 0 ? 4 * UNIT * (size(near) + radius) : 0;
    real doubt_far = radius > 0 ? 4 * UNIT * (size(far) + radius) : 0;
    r->lower = near - radius - doubt_near - tiny;
    r->upper = far - radius + doubt_far + tiny;
}

/* The witnesses, from the cores' to the shapes': each moves toward the other by its radius, or, where the radii reach
 * across, both move to one point between. */
static void witness(result *r, const search *q, const real weight[], const shape *a, const shape *b, int meeting)
{
    vec on_a = blend(&q->s, weight, offsetof(vertex, x)), on_b = blend(&q->s, weight, offsetof(vertex, y));
    vec way = blend(&q->s, weight, offsetof(vertex, w));
    real l = length(way), radius = a->radius + b->radius;
    if (a->pose) on_a = add(map(a->pose->m, on_a), load(a->pose->p));
    if (b->pose) on_b = add(map(b->pose->m, on_b), load(b->pose->p));
    if (meeting || l * q->d.unscale < radius) {
        real share = a->radius > 0 ? a->radius / radius : 0;
        on_a = on_b = add(on_a, mul(sub(on_b, on_a), share));
    } else if (radius > 0) {
        vec toward_b = l > 0 ? mul(way, -1 / l) : q->normal;
        on_a = add(on_a, mul(toward_b, a->radius));
        on_b = sub(on_b, mul(toward_b, b->radius));
    }
    store(r->point_a, on_a);
    store(r->point_b, on_b);
}

/* The search has ended at what rounding can tell, and that is not enough: the caller asks for all digits, or gets fewer
 * than rounding explains. */
static int unsettled(const search *q, const options *o, enum end end, real upper)
{
    if ((end != STILL && end != INSIDE) || upper < 0) return 0;
    return o->tight || upper - larger(q->lower, 0) > 4 * q->d.doubt;
}

enum proof { NONE, PROVEN_APART, PROVEN_MEETING };

/* Finishes the search without rounding, and replaces what the result says of the distance. NONE, and nothing changed,
 * where that can't be done. */
static APART enum proof tighten(search *q, const shape *a, const shape *b, const goal *g, result *r, real weight[])
{
    finish f;
    real ends[3];
    if (count_corners(a) == 0 || count_corners(b) == 0) return NONE;
    if (conclude(&f, q, a, b, g->max_steps) != STILL) return NONE;
    enclose(&f, a->radius, b->radius, q->d.scale, ends);
    if (!(ends[0] <= ends[1] && ends[1] <= ends[2] && bounded(ends[2]))) return NONE;
    hand_back(&f, q, weight);
    store(r->normal, q->normal);
    r->upper = ends[2];
    if (f.over.sign == 0) return PROVEN_MEETING;
    r->lower = ends[0];
    r->value = ends[1];
    return PROVEN_APART;
}

/* What both questions share: the cores' search and its bracket with the radii taken off. FAULT: a support's answer was
 * none, or the bounds cross. */
static enum end solve(search *q, const shape *a, const shape *b, const options *o, const goal *g, result *r,
                      real weight[], enum proof *proof)
{
    real upper;
    enum end end = run(q, a, b, o, g, &upper, weight);
    *proof = NONE;
    if (end == FAULT) return FAULT;
    bracket(r, &q->d, q->lower, upper, g->radius);
    store(r->normal, q->normal);
    if (unsettled(q, o, end, upper)) *proof = tighten(q, a, b, g, r, weight);
    if (*proof == NONE || (*proof == PROVEN_MEETING && g->depth)) {
        real known = r->upper;
        if (!tell(q, g, &upper, &end) || !(q->lower <= upper)) return FAULT;
        bracket(r, &q->d, q->lower, upper, g->radius);
        store(r->normal, q->normal);
        r->upper = smaller(r->upper, known);
    }
    r->steps = q->steps;
    r->supports = q->d.calls;
    r->reserved = 0;
    return end;
}

static int distance_status(const result *r, const options *o, enum end end, real rounding)
{
    real width = r->upper - r->lower, asked = o->abs_tol + o->rel_tol * r->upper;
    if (end == BEYOND) return GJK_DECIDED;
    if (width <= asked || end == WITHIN) return GJK_OK;
    if (end == OPEN) return GJK_LIMIT;
    return o->abs_tol == 0 && o->rel_tol == 0 && width <= rounding ? GJK_OK : GJK_FLOOR;
}

GJK_API int pub(distance)(const shape *a, const shape *b, const options *given, result *out)
{
    options o;
    search q;
    result r;
    real weight[DIM + 1];
    enum proof proof;
    if (!out || !sound(a) || !sound(b) || !read_options(&o, given)) return GJK_BAD_ARGUMENT;
    real radius = a->radius + b->radius;
    goal g = {.beyond = REAL_MAX,
              .within = -1,
              .radius = radius,
              .abs_tol = o.abs_tol,
              .rel_tol = o.rel_tol,
              .max_steps = (int)o.max_steps};
    if (o.cutoff > 0) g.beyond = (o.cutoff + radius) * (1 + 16 * UNIT);
    if (radius > 0) g.within = radius * (1 - 16 * UNIT);
    g.early = radius > 0 || o.abs_tol > 0 || o.rel_tol > 0;

    enum end end = solve(&q, a, b, &o, &g, &r, weight, &proof);
    if (end == FAULT) return GJK_BAD_SUPPORT;
    int meeting = r.upper <= 0;
    r.upper = larger(r.upper, 0);
    r.lower = larger(r.lower, 0);
    if (proof == NONE)
        r.value = refine(&q, weight) * q.d.unscale - radius; /* NaN where products overflow: passed over */
    if (proof == PROVEN_MEETING) r.value = 0;
    r.value = smaller(larger(r.value, r.lower), r.upper);
    witness(&r, &q, weight, a, b, meeting);
    real rounding = (4 * q.d.doubt + 2 * q.d.slack) * q.d.unscale + 16 * UNIT * radius;
    r.status = distance_status(&r, &o, end, rounding);
    *out = r;
    return r.status;
}

GJK_API int pub(intersect)(const shape *a, const shape *b, const options *given, result *out)
{
    options o;
    search q;
    result r;
    real weight[DIM + 1];
    enum proof proof;
    if (!out || !sound(a) || !sound(b) || !read_options(&o, given)) return GJK_BAD_ARGUMENT;
    real radius = a->radius + b->radius;
    goal g = {.beyond = radius * (1 + 16 * UNIT),
              .within = radius * (1 - 16 * UNIT),
              .radius = radius,
              .abs_tol = -1, /* never */
              .early = radius > 0,
              .depth = 1,
              .max_steps = (int)o.max_steps};

    enum end end = solve(&q, a, b, &o, &g, &r, weight, &proof);
    if (end == FAULT) return GJK_BAD_SUPPORT;
    r.value = r.lower > 0 ? r.lower : r.upper < 0 ? r.upper : 0;
    witness(&r, &q, weight, a, b, r.upper < 0);
    r.status = r.lower > 0 || r.upper <= 0 ? GJK_DECIDED : end == OPEN ? GJK_LIMIT : GJK_FLOOR;
    *out = r;
    return r.status;
}

#endif
