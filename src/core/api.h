/* SPDX-License-Identifier: MIT */
/* The door: arguments are checked on the way in, the result is written on the way out, once and whole. */
#ifndef GJK_CORE_API_H
#define GJK_CORE_API_H

#include "balls.h"
#include "everyday.h"

/* ---- options ---- */

#define OPTIONS_LARGEST 1024 /* beyond any size this struct will grow to; a larger one was never set */

/* Of another age: a shorter struct ends before the pointers, or after one; what a longer one says beyond the end of
 * ours must be nothing. */
static APART int read_aged_options(options *o, const options *given)
{
    const unsigned char *from = (const unsigned char *)given;
    uint32_t given_size = given->size;
    if (given_size < offsetof(options, cache) || given_size > OPTIONS_LARGEST) return 0;
    if (given_size < sizeof *o && (given_size - offsetof(options, cache)) % sizeof(void *) != 0) return 0;
    for (size_t i = sizeof *o; i < given_size; i++)
        if (from[i] != 0) return 0;
    memset(o, 0, sizeof *o);
    memcpy(o, given, given_size < sizeof *o ? given_size : sizeof *o);
    return 1;
}

static inline uint32_t steps_of(const options *o)
{
    if (!o || o->max_steps == 0) return 256;
    return o->max_steps < INT32_MAX / 4 ? o->max_steps : INT32_MAX / 4;
}

/* What is asked: the caller's options as they stand there, or none; of another age copied to own. NULL: they say what
 * makes no sense. */
static inline const options *check_options(options *own, const options *given)
{
    static const options none = {.size = sizeof none, .max_steps = 256};
    const options *o = given;
    if (!given) return &none;
    if (given->size != sizeof *own) {
        if (!read_aged_options(own, given)) return NULL;
        own->max_steps = steps_of(own);
        o = own;
    }
    int fine = is_length(o->abs_tol) & is_length(o->rel_tol) & is_length(o->cutoff) & is_length(o->slack);
    fine &= o->tight <= 1;
    return fine ? o : NULL;
}

/* The caller's own are copied before the first callback, which may change them. */
static inline const options *keep_options(options *own, const options *o, const options *given)
{
    if (o != given) return o;
    *own = *given;
    own->max_steps = steps_of(given);
    return own;
}

static inline const options *read_options(options *own, const options *given)
{
    const options *o = check_options(own, given);
    return o ? keep_options(own, o, given) : NULL;
}

/* ---- the shorter way ---- */

/* A workspace is there, aligned, and large enough; or there is none. */
static int has_workspace(const options *o)
{
    if (!o->workspace) return o->workspace_bytes == 0;
    return (uintptr_t)o->workspace % sizeof(real) == 0 && o->workspace_bytes >= bytes_for(FEWEST_TIPS);
}

/* What most ask, of bodies for which there is a shorter way. 0: it is left to the whole answer. */
HOT int tell_plainly(search *q, const shape *a, const shape *b, const options *o, int sign_only, int deep, result *r)
{
    q->thin = q->planar = q->flat = UNTRIED;
    if (!SHORTCUTS || !a || !b || !r || !asks_nothing_else(o) || (deep && o && !has_workspace(o))) return 0;
    if (DIM == 3 || !HAS_SISTER) { /* in the plane flat.h has them */
        const goal g = {.beyond = REAL_MAX, .radius = a->radius + b->radius, .sign_only = sign_only, .deep = deep};
        q->thin = tell_thin_at_once(a, b, o ? o->cache : NULL, &g, r);
        if (q->thin == TELLING) {
            say_plainly(r, sign_only, deep);
            return 1;
        }
        if (q->thin != UNTRIED) return 0;
    }
    return (!deep || (DIM == 2 && HAS_SISTER)) && tell_at_once(q, a, b, o, sign_only, deep, r);
}

/* How far off, times its size, a ball is that a rounded turn makes, to stand as a point at once. In float the sister
 * has more digits than that would leave. */
#define ROUNDED_BALL (HAS_SISTER ? 0 : 12 * UNIT)

/* Whether either may be a ball, to stand as a point. A slack is in the balls' own unit, which points have not. */
static inline int may_have_balls(const shape *a, const shape *b, const options *o)
{
    return a && b && (may_be_ball(a) || may_be_ball(b)) && (!o || (o->size == sizeof *o && o->slack == 0));
}

/* ---- how far apart ---- */

/* The radius in it, and off, the bracket may be this wide and still be as tight as rounding allows. */
static int tight_enough(const result *r, const difference *d, real radius, real off, real level)
{
    real rounding = (4 * d->doubt + 2 * d->slack) * (level * d->unscale) + (16 * UNIT * radius + 2 * off) * level;
    return (r->upper - r->lower) * level <= rounding;
}

static int distance_status(const result *r, const options *o, enum end end, const search *q, real radius, real off,
                           int deep)
{
    int tolerant = o->abs_tol > 0 || o->rel_tol > 0;
    if (o->cutoff > 0 && r->lower > o->cutoff) return GJK_DECIDED;
    if (q->told && end == STILL && !tolerant) return GJK_OK;
    real level = level_of(&q->d, radius, 0);
    if (narrow(r, o, deep) || end == WITHIN) return GJK_OK;
    const int enough = deep && r->upper < 0 && r->upper - r->lower <= q->enough * -r->lower;
    if (end == OPEN && !enough) return GJK_LIMIT;
    return !tolerant && tight_enough(r, &q->d, radius, off, level) ? GJK_OK : GJK_FLOOR;
}

/* What is asked where the bracket is to be narrow. */
static goal goal_of(const search *q, const shape *a, const shape *b, const options *o)
{
    goal g = {.beyond = REAL_MAX,
              .within = -1,
              .radius = a->radius + b->radius,
              .abs_tol = o->abs_tol,
              .rel_tol = o->rel_tol,
              .early = o->abs_tol > 0 || o->rel_tol > 0,
              .exact = are_exact(q, a, b, o),
              .max_steps = (int)o->max_steps};
    if (o->cutoff > 0) g.beyond = (o->cutoff + g.radius) * (1 + 16 * UNIT);
    return g;
}

/* The shapes are off what they stand for by this. */
static inline void widen_by(result *r, real off)
{
    if (!(off > 0)) return;
    r->lower -= off;
    r->upper += off;
    r->lower -= size(r->lower) * (2 * UNIT) + TINY;
    r->upper += size(r->upper) * (2 * UNIT) + TINY;
}

/* The whole answer, of any bodies, whatever is asked; of such that are off by so much. */
static WHOLE int answer_distance(search *q, const shape *a, const shape *b, real off, const options *given, result *out)
{
    options own;
    const options *o = read_options(&own, given);
    result r;
    if (!o || !out || !a || !b) return GJK_BAD_ARGUMENT;
    q->lent = UNTRIED;
    list_both(q, a, b, o);
    goal g = goal_of(q, a, b, o);
    if (g.radius > 0) {
        g.within = g.radius * (1 - 16 * UNIT);
        g.early = 1;
    }

    enum end end;
    int bad = reply_to(q, a, b, o, &g, &end, &r);
    if (bad) return bad;
    widen_by(&r, off);
    r.upper = larger(r.upper, 0);
    r.lower = larger(r.lower, 0);
    r.value = smaller(larger(r.value, r.lower), r.upper);
    r.status = distance_status(&r, o, end, q, g.radius, off, 0);
    *out = r;
    return r.status;
}

/* The same of what may be balls. */
static APART int answer_distance_of_balls(search *q, const shape *a, const shape *b, const options *given, result *out)
{
    pointed k;
    const int some = take_balls(&k, a, b, ROUNDED_BALL);
    if (some && k.off == 0 && tell_plainly(q, k.a, k.b, given, 0, 0, out)) return out->status = GJK_OK;
    return answer_distance(q, k.a, k.b, k.off, given, out);
}

GJK_API int pub(distance)(const shape *a, const shape *b, const options *given, result *out)
{
    search q;
    if (tell_plainly(&q, a, b, given, 0, 0, out)) return out->status = GJK_OK;
    if (may_have_balls(a, b, given)) return answer_distance_of_balls(&q, a, b, given, out);
    return answer_distance(&q, a, b, 0, given, out);
}

/* ---- whether they meet ---- */

#if DIM == 3
/* Strides where a glance was in vain. */
static enum glanced stride_and_remember(search *q, const shape *a, const shape *b, const options *o, result *r)
{
    const enum glanced seen = stride_outside(q, (int)steps_of(o), a, b, r);
    if (seen == TELLING && o->cache) remember(o->cache, q, a, b);
    return seen;
}

/* By what the cache has kept. So many steps and calls were spent, if that tells nothing. */
static enum glanced recall_and_remember(search *q, const shape *a, const shape *b, const options *o, result *r,
                                        int spent[2])
{
    q->lent = recall_outside(q, o->cache, a, b, r);
    if (q->lent == TELLING) remember(o->cache, q, a, b);
    spent[0] = q->lent == IN_VAIN ? q->steps : 0;
    spent[1] = 2 * spent[0];
    return q->lent == TELLING ? TELLING : UNTRIED;
}
#else
#define recall_and_remember(q, a, b, o, r, spent) ((void)(spent), UNTRIED)
#endif

/* So many are used up already. */
static const options *take_steps_off(options *own, const options *o, int steps)
{
    if (o != own) *own = *o;
    own->max_steps -= (uint32_t)steps;
    return own;
}

/* Whether they meet by a look, before a search is set up. 0: that is left to the search, less the steps and calls that
 * were spent. */
static inline int meet_at_sight(search *q, const shape *a, const shape *b, const options *o, result *r, int spent[2])
{
    if (!SHORTCUTS) return 0;
    if (q->glanced == UNTRIED && list_both(q, a, b, o) && !are_thin(&q->d) && !are_planar(&q->d)) {
        if (!lender_of(a, b, o, 1))
            q->glanced = are_boxes(a, b) ? glance_at_boxes(q, (int)steps_of(o), a, b, r) : glance(q, a, b, r);
        else if (is_recalled(q, a, b, (int)steps_of(o))) q->glanced = recall_and_remember(q, a, b, o, r, spent);
    }
#if DIM == 3
    if (q->glanced == IN_VAIN) q->glanced = stride_and_remember(q, a, b, o, r);
    if (ROUND && !q->listed && o->slack == 0 && look_at_solids(q, (int)steps_of(o), a, b, r, spent))
        q->glanced = TELLING;
#endif
    return q->glanced == TELLING;
}

static WHOLE int answer_intersect(search *q, const shape *a, const shape *b, const options *given, result *out)
{
    options own;
    const options *o = check_options(&own, given);
    result r;
    if (!o || !out || !a || !b) return GJK_BAD_ARGUMENT;
    int spent[2] = {0, 0};
    if (meet_at_sight(q, a, b, o, out, spent)) return out->status = GJK_DECIDED;
    o = keep_options(&own, o, given);
    if (spent[0] > 0) o = take_steps_off(&own, o, spent[0]);
    real radius = a->radius + b->radius;
    goal g = {.beyond = radius * (1 + 16 * UNIT),
              .within = radius * (1 - 16 * UNIT),
              .radius = radius,
              .abs_tol = -1, /* never */
              .early = radius > 0,
              .sign_only = 1,
              .exact = are_exact(q, a, b, o),
              .max_steps = (int)o->max_steps};

    enum end end = STILL;
    const int hers =
        (!are_listed(q) && spent[1] > 0) || q->glanced == CLOUDED || q->glanced == AIMED; /* float can't tell */
    if (!(HAS_SISTER && hers && ask_sister_alone(q, a, b, o, &g, &r)) && !tell_trail(q, a, b, o, &g, &r)) {
        int bad = reply_to(q, a, b, o, &g, &end, &r);
        if (bad) return bad;
    }
    if (spent[1] > 0) {
        r.steps += spent[0];
        r.supports += spent[1];
    }
    r.value = r.lower > 0 ? r.lower : r.upper < 0 ? r.upper : 0;
    r.status = r.lower > 0 || r.upper <= 0 ? GJK_DECIDED : end == OPEN ? GJK_LIMIT : GJK_FLOOR;
    *out = r;
    return r.status;
}

/* The same of what may be balls; but for what is off, the verdict would be. */
static APART int answer_intersect_of_balls(search *q, const shape *a, const shape *b, const options *given, result *out)
{
    pointed k;
    if (take_balls(&k, a, b, 0) && tell_plainly(q, k.a, k.b, given, 1, 0, out)) return out->status = GJK_DECIDED;
    return answer_intersect(q, k.a, k.b, given, out);
}

GJK_API int pub(intersect)(const shape *a, const shape *b, const options *given, result *out)
{
    search q;
    q.dug = -1;
    q.glanced = q.lent = UNTRIED;
    if (SHORTCUTS && are_plain_hulls(a, b, given, out))
        q.glanced = glance_at_hulls(&q, given ? given->cache : NULL, a, b, out);
    else if (SHORTCUTS && are_plain_boxes(a, b, given, out))
        q.glanced = glance_at_plain_boxes(&q, (int)steps_of(given), a, b, out);
    if (q.glanced == TELLING) return out->status = GJK_DECIDED;
    if (q.glanced == UNTRIED && tell_plainly(&q, a, b, given, 1, 0, out)) return out->status = GJK_DECIDED;
    if (may_have_balls(a, b, given)) return answer_intersect_of_balls(&q, a, b, given, out);
    return answer_intersect(&q, a, b, given, out);
}

/* ---- how deep ---- */

#if DEPTHS

GJK_API size_t pub(workspace_size)(uint32_t corners)
{
    return corners >= FEWEST_TIPS && corners <= MOST_TIPS ? bytes_for(corners) : 0;
}

/* The bracket is about as narrow as its numbers can be. */
static int is_to_last_place(const result *r)
{
    return r->upper - r->lower <= 8 * UNIT * larger(size(r->lower), size(r->upper)) + 8 * TINY;
}

/* A depth to the last place: not at an end of its bracket, if that has a number within, which is a step from all in it.
 */
static real off_the_ends(const result *r)
{
    const real amid = r->lower + (r->upper - r->lower) / 2;
    const int at_end = r->value == r->lower || r->value == r->upper;
    return at_end && r->value != 0 && amid > r->lower && amid < r->upper && is_to_last_place(r) ? amid : r->value;
}

/* The whole answer of bodies as they are said to be, into r. Returns its status; a mistake leaves r alone. */
static int fathom_both(search *q, const shape *a, const shape *b, real off, const options *o, result *r)
{
    q->lent = UNTRIED;
    list_both(q, a, b, o);
    goal g = goal_of(q, a, b, o);
    g.deep = 1;
    g.tight = g.exact && o->tight;

    enum end end;
    int bad = reply_to(q, a, b, o, &g, &end, r);
    if (bad) return bad;
    widen_by(r, off);
    r->lower = larger(r->lower, -REAL_MAX); /* any slack may have been taken off */
    r->value = smaller(larger(r->value, r->lower), r->upper);
    if (g.tight && r->upper < 0) r->value = off_the_ends(r);
    r->status = distance_status(r, o, end, q, g.radius, off, 1);
    const int is_rounding = off <= 32 * UNIT * g.radius;
    if (!is_rounding && r->status == GJK_OK && !narrow(r, o, 1)) r->status = GJK_FLOOR;
    if (g.tight && r->status == GJK_OK && !narrow(r, o, 1) && !is_to_last_place(r)) r->status = GJK_FLOOR;
    return r->status;
}

/* Bodies as they are said to be otherwise, once more, by the steps that are left: r is what took the others. There are
 * some. */
static int fathom_again(search *q, const shape *a, const shape *b, real off, const options *o, const result *r,
                        result *again)
{
    options left = *o;
    left.max_steps -= (uint32_t)r->steps;
    left.cache = NULL; /* which is to know the caller's own */
    q->thin = q->planar = q->flat = UNTRIED;
    const int status = fathom_both(q, a, b, off, &left, again);
    again->steps += r->steps;
    again->supports += r->supports;
    return status;
}

/* A cloud whose reach is told anew. */
typedef struct measured {
    shape s;
    points p;
} measured;

/* A reach may be any bound, and the bracket holds whatever it is; but the points are as good as the frame, which is
 * made of it. Such a cloud by its own reach, where that is less than a share of what is said; its first point tells
 * whether it can be. */
static const shape *by_own_reach(const shape *s, measured *own)
{
    const points *p = s->data;
    const real share = (real)0x1p-10;
    if (s->support != pub(support_points) || !(peak(load(p->v)) < share * p->reach)) return s;
    own->s = *s;
    own->s.data = &own->p;
    own->p = *p;
    own->p.reach = pub(points_reach)(p);
    own->p.indexed = 0; /* the index is made for the other */
    return own->p.reach < share * p->reach ? &own->s : s;
}

/* How deep, once more where that is told in a frame that is far too large, if there are steps for it. */
static APART void fathom_by_own_reaches(search *q, const shape *a, const shape *b, real off, const options *o,
                                        result *r)
{
    measured of_a, of_b;
    const shape *x = by_own_reach(a, &of_a), *y = by_own_reach(b, &of_b);
    result again;
    if ((x == a && y == b) || r->steps >= (int)o->max_steps) return;
    const int status = fathom_again(q, x, y, off, o, r, &again);
    if (status >= 0 && status != GJK_LIMIT && !(again.lower > 0)) *r = again;
}

/* The same of what may be balls. Where the way out of what is round is not found, or by and large, those that their
 * maps leave balls by and large stand as points once more; a quarter of the steps is kept for that. */
static APART int fathom_round_or_points(search *q, const shape *a, const shape *b, real off, const options *o,
                                        result *r)
{
    pointed k;
    options part = *o;
    result again;
    if (!take_balls(&k, a, b, (real)0x1p-10)) return fathom_both(q, a, b, off, o, r);
    part.max_steps -= o->max_steps / 4;
    const int status = fathom_both(q, a, b, off, &part, r);
    if ((status != GJK_LIMIT && status != GJK_FLOOR) || r->lower > 0 || r->steps >= (int)o->max_steps) return status;
    if (fathom_again(q, k.a, k.b, off + k.off, o, r, &again) < 0) return status;
    if (again.upper - again.lower < r->upper - r->lower) *r = again;
    return r->status;
}

/* The whole answer; of bodies that are off by so much. */
static int answer_penetration(search *q, const shape *a, const shape *b, real off, const options *given, result *out)
{
    options own;
    const options *o = read_options(&own, given);
    result r;
    if (!o || !out || !a || !b || !has_workspace(o)) return GJK_BAD_ARGUMENT;
    const int bad =
        may_have_balls(a, b, o) ? fathom_round_or_points(q, a, b, off, o, &r) : fathom_both(q, a, b, off, o, &r);
    if (bad < 0) return bad;
    if (!(r.lower > 0)) fathom_by_own_reaches(q, a, b, off, o, &r);
    *out = r;
    return r.status;
}

/* The same of what may be balls. */
static APART int answer_penetration_of_balls(search *q, const shape *a, const shape *b, const options *given,
                                             result *out)
{
    pointed k;
    const int some = take_balls(&k, a, b, ROUNDED_BALL);
    if (some && k.off == 0 && tell_plainly(q, k.a, k.b, given, 0, 1, out)) return out->status = GJK_OK;
    return answer_penetration(q, k.a, k.b, k.off, given, out);
}

/* A depth may be open by that share of it. */
static inline int ask_penetration(const shape *a, const shape *b, const options *given, real enough, result *out)
{
    search q;
    q.enough = enough;
    if (tell_plainly(&q, a, b, given, 0, 1, out)) return out->status = GJK_OK;
    if (may_have_balls(a, b, given)) return answer_penetration_of_balls(&q, a, b, given, out);
    return answer_penetration(&q, a, b, 0, given, out);
}

GJK_API int pub(penetration)(const shape *a, const shape *b, const options *given, result *out)
{
    return ask_penetration(a, b, given, 0, out);
}

#if REAL_IS_DOUBLE
int pub(penetration_for_float)(const shape *a, const shape *b, const options *given, result *out)
{
    return ask_penetration(a, b, given, (real)0x1p-26, out);
}
#endif
#endif

#endif
