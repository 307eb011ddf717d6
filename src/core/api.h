/* SPDX-License-Identifier: MIT */
/* The door: arguments are checked on the way in, the result is written on the way out, once and whole. */
#ifndef GJK_CORE_API_H
#define GJK_CORE_API_H

#include "answer.h"
#include "apart.h"
#include "axes.h"
#include "boxes.h"
#include "fine.h"
#include "gap.h"
#include "glance.h"
#include "hulls.h"
#include "intersect.h"
#include "plain.h"
#include "planar.h"
#include "solid.h"
#include "stride.h"
#include "thin_door.h"
#include "widen.h"

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

/* What a later query of this pair may start from. */
static void remember(cache *k, const search *q, const shape *a, const shape *b)
{
    if (q->kept) return;
    int n = q->s.n, lent = 1;
    for (int i = 0; i < n; i++) lent &= (int)(q->borrowed >> q->s.at[i] & 1);
    if (lent && (q->repeated || !q->pending)) return; /* nothing new: the cache may hold more than this simplex */
    if (q->d.loose) return;
    if (q->pending && !q->repeated) n++; /* the corner in the spare slot: the next query may be answered with it */
    for (int i = 0; i < n; i++) {
        store(k->a[i], corner(&q->s, i)->x);
        store(k->b[i], corner(&q->s, i)->y);
    }
    k->count = (uint32_t)n;
    k->reserved = 0;
    keep_whose(k, q, a, b);
}

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
#define recall_and_remember(q, a, b, o, r, spent) UNTRIED
#endif

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

/* No length stands in it but 0 and more than any. */
static inline int is_scale_free(const goal *g)
{
    return !g->early && g->radius == 0 && (g->beyond == 0 || g->beyond == REAL_MAX);
}

/* The full simplex leaves so much room that depth is all that is left to ask, and needs no pair of points. */
static inline int is_depth_alone(const search *q, const goal *g)
{
    return g->deep && g->exact && !g->tight && !(q->lower > 0) && q->inside > 64 * q->d.doubt;
}

/* Round bodies, that the first corner has been asked of: without a walk, if they have a dip that tells. 0: it does not.
 */
static int run_to_dip(search *q, const shape *a, const shape *b, const goal *g, enum end *end, real *upper,
                      real weight[])
{
    const goal here = scaled(g, q->d.scale);
    *end = turn_to_dip(q, a, b, &here);
    if (*end == OPEN) return 0;
    q->turned = *end == INSIDE;
    if (q->turned) *end = STILL;
    if (q->turned) *upper = certify(q, weight);
    else if (*end != FAULT) *end = sharpen_on(q, &here, *end, upper, weight);
    if (*end != FAULT && q->lower <= *upper) return 1;
    *end = FAULT; /* numbers are lost, as where a cone is flat to the last: from the start again */
    return 0;
}

/* Searches, from the cache if that fits. Returns how the search ended, with an upper bound of the cores' separation;
 * FAULT also where the bounds cross, which points of two convex sets never do. */
static enum end run(search *q, const shape *a, const shape *b, const options *o, const goal *g, enum end walked,
                    real *upper, real weight[])
{
    int warm = o->cache != NULL;
    enum end end;
    if (walked != FAULT) {
        settle_rest(&q->d, a, b);
        goal here = scaled(g, q->d.scale);
        end = walked;
        if (end == STILL && !q->repeated && !g->sign_only) q->stuck = is_lower(q);
        if (end == OPEN && q->steps < g->max_steps) end = descend(q, &here);
        if (walked == INSIDE && is_depth_alone(q, g)) {
            *upper = q->d.doubt - q->inside;
            weigh_walked(q, weight);
            return end;
        }
        end = sharpen_on(q, &here, end, upper, weight);
        if (end == INSIDE && q->inside > q->d.doubt) *upper = q->d.doubt - q->inside;
        if (end != FAULT && q->lower <= *upper) return end;
    }
    int opened = q->turned >= 0 && !g->exact && have_heights(a, b) && open_cold(q, a, b, o->slack);
    end = OPEN;
    if (opened && run_to_dip(q, a, b, g, &end, upper, weight)) return end;
    opened &= !warm && end == OPEN;
    if (q->turned > 0) q->turned = 0;
    for (;;) {
        end = FAULT;
        if (warm) warm = open_warm(q, a, b, o->slack, o->cache);
        if (!opened) forget_first_dip(q->first_dip); /* the frame may be another */
        if (warm || opened || open_cold(q, a, b, o->slack)) {
            opened = 0;
            goal here = scaled(g, q->d.scale);
            end = search_on(q, &here, upper, weight);
            if (end == BEYOND && g->sign_only && q->lender) {
                stand_on_last(q);
                *upper = certify(q, weight);
            }
        }
        if (end != FAULT) {
            if (end == INSIDE && q->inside > q->d.doubt) *upper = q->d.doubt - q->inside;
            if (q->lower <= *upper && settled(q) &&
                !(warm && (end == STILL || end == INSIDE) && coarse(q, *upper) && !g->exact))
                break;
        }
        if (!warm) return FAULT;
        warm = 0;
    }
    return end;
}

/* Where the search has come to its end on contact, and the bracket of the cores straddles it, finds out on which side
 * they are, if rounding allows. 0: a support's answer was none. */
static int tell(search *q, const goal *g, real *upper, real weight[], enum end *end)
{
    if ((*end != STILL && *end != INSIDE) || q->lower > 0 || *upper < 0 || *upper < g->within * q->d.scale) return 1;
    simplex around;
    enum end told = probe(q, g->max_steps, upper, &around);
    if (told == WITHIN && !g->exact) stand_among(q, &around, weight);
    if (told == OPEN) *end = OPEN;
    return told != FAULT;
}

/* The cores may be as near to each other, or the shapes to contact, as rounding hides; or rounding does not explain the
 * width of the bracket. */
static int is_doubtful(const search *q, const goal *g, real upper)
{
    real near = g->radius * q->d.scale, margin = 32 * q->d.doubt + 16 * UNIT * near;
    return (q->lower <= near + margin && upper >= near - margin) || q->stuck || coarse(q, upper);
}

/* The search has ended at what rounding can tell, and that is not enough: the sign is open; or so near to contact the
 * way of v is noise; or the caller asks for all digits, or gets fewer than rounding explains, or a corner that promised
 * to be nearer was not; or the weights of a thin full simplex miss the origin. */
static int unanswered(const search *q, const result *r, const options *o, const goal *g, real upper,
                      const real weight[])
{
    real near = g->radius * q->d.scale, margin = (real)(g->sign_only ? 8 : 32) * q->d.doubt + 16 * UNIT * near;
    if (g->deep && upper < 0) return 0;
    if (r->lower <= 0 && r->upper > 0) return 1;
    if (g->sign_only && r->lower > 0) return 0;
    if (q->lower <= near + margin && upper >= near - margin) return 1;
    if (g->deep && q->lower <= margin) return 1;
    if (r->upper <= 0 && !g->deep) return q->s.n > DIM && peak(blend(&q->s, weight, offsetof(vertex, w), 1)) > 8 * UNIT;
    if (g->sign_only) return 0;
    return o->tight || q->stuck || coarse(q, upper);
}

/* The bracket of the distance is as narrow as asked. One too wide for a number is not. */
static int narrow(const result *r, const options *o, int deep, real level)
{
    const real far = r->upper < 0 ? -r->lower : r->upper, lower = deep ? r->lower : larger(r->lower, 0);
    const real width = (r->upper - lower) * level;
    return width <= REAL_MAX && width <= o->abs_tol * level + o->rel_tol * (far * level);
}

/* Finishes the search without rounding, and replaces what the result says of the distance. OPEN, FAULT: that can't be
 * done, and nothing is changed. */
static APART enum end tighten(search *q, const shape *a, const shape *b, const goal *g, result *r, real weight[])
{
    finish f;
    real ends[3];
    enum end end = conclude(&f, q, a, b, g->max_steps);
    if (end != STILL) return end;
    if (!enclose(&f, a->radius, b->radius, ends)) return FAULT;
    hand_back(&f, q, weight);
    store(r->normal, q->normal);
    if (f.off > 0) ends[0] = larger(ends[0], r->lower);
    if (f.over.sign != 0) r->lower = ends[0]; /* else that bounds no depth */
    q->met = f.over.sign == 0;
    q->met_off = f.off * q->d.scale;
    r->upper = smaller(r->upper, ends[2]); /* which may know of an overlap */
    r->value = f.off > 0 ? larger(smaller(ends[1], r->upper), r->lower) : ends[1];
    witness(r, q, weight, a, b, 2 * g->deep);
    return STILL;
}

/* The search's own answer. The value is rounded once, the radii taken off, and no farther from what the bounds say
 * without their allowance for rounding; NaN where products overflow. */
static void answer(const search *q, const shape *a, const shape *b, const goal *g, real upper, const real weight[],
                   result *r)
{
    store(r->normal, q->normal);
    witness(r, q, weight, a, b, g->deep);
    r->value = 0;
    if (g->sign_only) return;
    real doubt = q->d.doubt;
    real low = q->lower + doubt - 2 * UNIT * (size(q->lower) + doubt);
    real high = upper - doubt + 2 * UNIT * (size(upper) + doubt);
    twin l = refine(q, weight);
    if (l.high > high) l = (twin){high, 0};
    if (l.high < low) l = (twin){low, 0};
    r->value = gap_of(&q->d, l, a, b);
}

/* Takes the answer further where rounding stood in its way: exactly for known corners, in double for float's smooth
 * shapes. How that ended; FAULT: there was no need, or no way, and nothing is changed. */
static enum end take_further(search *q, const shape *a, const shape *b, const options *o, const goal *g, real upper,
                             real weight[], result *r)
{
    if (g->exact) return EXACT && unanswered(q, r, o, g, upper, weight) ? tighten(q, a, b, g, r, weight) : FAULT;
    int open = g->sign_only ? r->lower <= 0 && r->upper > 0
                            : (g->deep || r->upper > 0) && !narrow(r, o, g->deep, level_of(&q->d, g->radius, 0));
    return open ? ask_sister(q, a, b, o, g, r) : FAULT;
}

/* The middle of the bracket, the radii taken off, rounded once; 0 where the cores only touch. */
static real middle(const search *q, const goal *g, real upper)
{
    real level = level_of(&q->d, g->radius, 0), down = level * q->d.unscale;
    if (q->met && upper == 0 && !(q->lower < -4096 * UNIT * UNIT)) return -g->radius;
    twin m = sum_of(q->lower / 2 * down, upper / 2 * down), r = sum_of(m.high, -g->radius * level);
    return (r.high + (r.low + m.low)) * (1 / level);
}

/* Without a workspace of the caller's. */
static APART enum end fathom_in_own_room(depth *d, real *upper, real weight[])
{
    usual_room own;
    d->p = polytope_in(&own, USUAL_TIPS);
    return fathom(d, upper, weight);
}

/* The cores meet, or rounding leaves it open: the depth instead of the distance. */
static APART enum end plumb(search *q, const shape *a, const shape *b, const options *o, const goal *g, real *upper,
                            real weight[], result *r)
{
    goal here = scaled(g, q->d.scale);
    depth d = {.q = q, .a = a, .b = b, .g = &here, .dropped.least = REAL_MAX, .least = REAL_MAX};
    const simplex searched = q->s;
    real found[DIM + 1];
    memcpy(found, weight, sizeof found);
    if (q->met) *upper = smaller(*upper, q->met_off);
    if (o->workspace) d.p = polytope_in(o->workspace, tips_in(o->workspace_bytes));
    enum end end = o->workspace ? fathom(&d, upper, weight) : fathom_in_own_room(&d, upper, weight);
    if (end == FAULT || !(q->lower <= *upper)) return FAULT;
    if (*upper < 0) q->turned = 0;
    bracket(r, &q->d, q->lower, *upper, a, b);
    r->value = middle(q, g, d.near);
    if (d.settled) {
        r->lower = d.ends[0];
        r->value = d.ends[1];
        r->upper = d.ends[2];
    }
    store(r->normal, q->normal);
    if (r->lower > 0) { /* apart after all: the pair that upper is of */
        q->s = searched;
        memcpy(weight, found, sizeof found);
    }
    witness(r, q, weight, a, b, r->lower > 0 ? 1 : 2);
    enum end further = g->exact || end == OPEN ? FAULT : take_further(q, a, b, o, g, *upper, weight, r);
    return further == FAULT ? end : further;
}

/* Tightens from the simplex as it is, or where that can't be done from the one that the search ended with. OPEN: more
 * steps might do it. */
static enum end tighten_from_either(search *q, const shape *a, const shape *b, const goal *g, result *r, real weight[],
                                    const simplex *searched)
{
    enum end end = tighten(q, a, b, g, r, weight);
    if (end == STILL) return STILL;
    q->s = *searched;
    enum end again = tighten(q, a, b, g, r, weight);
    return again == FAULT ? end : again;
}

/* The same of known corners; where rounding does not tell whether they meet, that is found out without it, from the
 * lowest facet, or where that has too many digits from where the search ended; and if they do not the answer is the
 * distance. Where that is not found out for want of steps, so it says. */
static enum end plumb_and_tell(search *q, const shape *a, const shape *b, const options *o, const goal *g, real upper,
                               real weight[], result *r)
{
    simplex searched = q->s;
    enum end end = plumb(q, a, b, o, g, &upper, weight, r);
    if (end == FAULT || !EXACT || upper <= 0) return end;
    result apart = *r;
    enum end told = tighten_from_either(q, a, b, g, &apart, weight, &searched);
    if (told != STILL) return told == OPEN ? OPEN : end;
    if (!q->met) {
        *r = apart;
        return STILL;
    }
    r->value = middle(q, g, 0);
    r->upper = apart.upper;
    return end;
}

/* The cores are apart, and known by their corners: the normal, and where the radii overlap the bracket, to more digits.
 */
static void point_out_apart(search *q, const shape *a, const shape *b, const goal *g, real upper, const real weight[],
                            result *r)
{
    if (r->lower <= 0) {
        bound_apart(q, a, b, g, weight, &upper);
        bracket(r, &q->d, q->lower, upper, a, b);
    }
    point_along_pair(q, a, b, g, weight);
    store(r->normal, q->normal);
    if (g->radius > 0 && !(r->lower > 0)) witness(r, q, weight, a, b, 2);
}

/* Whether the cores are not proven to be apart, by rounded bounds or without rounding. */
static int may_meet(const search *q, const goal *g, enum end further)
{
    return !(q->lower > 0) && !(g->exact && further == STILL && !q->met);
}

/* Whether the depth is asked for, of known corners that may meet, before all else: it is the whole answer then. */
static int is_plumbed(const search *q, const goal *g, int still)
{
    return g->deep && still && !(q->lower > 0) && g->exact && !g->tight;
}

/* How deep: what follows the cores' search, which ended like that. */
static enum end go_deep(search *q, const shape *a, const shape *b, const options *o, const goal *g, real upper,
                        real weight[], result *r, enum end end)
{
    int still = end == STILL || end == INSIDE, open = !(q->lower > 0);
    enum end further = FAULT;
    if (is_plumbed(q, g, still)) return plumb_and_tell(q, a, b, o, g, upper, weight, r);
    if (still && (g->exact || !open)) further = take_further(q, a, b, o, g, upper, weight, r);
    if (may_meet(q, g, further)) return plumb(q, a, b, o, g, &upper, weight, r);
    if (g->exact && further == FAULT) point_out_apart(q, a, b, g, upper, weight, r);
    return further == FAULT ? end : further;
}

/* Where the search has come to its end near contact: what is seen to twice the digits. It is told (q->told), or they
 * meet, and how deep is to be asked. 0: neither. */
static int settle_near(search *q, const shape *a, const shape *b, const goal *g, real weight[], real *upper, result *r)
{
    enum sighting seen = NOTHING;
    if (vanished(q) || q->s.n > DIM) seen = holds_origin(q, a, b, weight) ? MEETING : NOTHING;
    if (q->d.a.asked == BY_CALL) q->d.a.list = corners_of(a);
    if (q->d.b.asked == BY_CALL) q->d.b.list = corners_of(b);
    q->weighed = 0;
    if (seen == NOTHING) seen = tell_near(q, a, b, g, weight, r);
    if (seen == MEETING) {
        q->pending = 0;
        q->met = 1;
        *upper = smaller(*upper, 0);
        if (!g->deep) tell_meeting(q, a, b, *upper, weight, r);
    }
    q->told = seen == APART_FINELY || (seen == MEETING && !g->deep);
    return seen != NOTHING;
}

/* The point of both is one only as far as the weights of the full simplex meet the origin, which those of a thin one
 * miss: the bracket is to be as wide as that. */
static real cover_point(const search *q, const real weight[], real upper)
{
    real off = length(blend(&q->s, weight, offsetof(vertex, w), 1)) + q->d.doubt;
    return smaller(larger(upper, q->lower + off * (1 + 8 * UNIT)), upper / 1024);
}

/* The cores' search from where the walk stands, its bracket with the radii taken off, and what a finish adds. FAULT: a
 * support's answer was none, or the bounds cross. */
static APART enum end solve(search *q, const shape *a, const shape *b, const options *o, const goal *g, enum end walked,
                            result *r)
{
    real upper, weight[DIM + 1];
    first_dip own;
    q->first_dip = &own;
    forget_first_dip(&own);
    q->met = 0;
    q->met_off = 0;
    enum end end = run(q, a, b, o, g, walked, &upper, weight), further = FAULT;
    int still = end == STILL || end == INSIDE;
    /* the distance of known corners needs no probing, the exact finish tells more; overlap does */
    int probed = still && !g->deep && (g->sign_only || !g->exact);
    int met = g->deep && upper < 0; /* for certain: how deep is all that is open */
    int tried = still && g->exact && !o->tight && !met && is_doubtful(q, g, upper);
    int settled = tried && settle_near(q, a, b, g, weight, &upper, r);
    if (q->told) return STILL;
    if (end == FAULT || (probed && !settled && !tell(q, g, &upper, weight, &end)) || !(q->lower <= upper)) return FAULT;
    if (g->sign_only && q->s.n > DIM && upper < 0) upper = cover_point(q, weight, upper);
    bracket(r, &q->d, q->lower, upper, a, b);
    const int faint = g->sign_only && end == BEYOND && !(r->lower > 0); /* apart, by less than there are numbers for */
    if ((still || faint) && g->exact && !g->deep) further = take_further(q, a, b, o, g, upper, weight, r);
    if (further != STILL && !is_plumbed(q, g, still) && !(g->deep && may_meet(q, g, further)))
        answer(q, a, b, g, upper, weight, r);
    if (g->deep) end = go_deep(q, a, b, o, g, upper, weight, r, end);
    else if (still && !g->exact) further = take_further(q, a, b, o, g, upper, weight, r);
    if (end == FAULT) return FAULT;
    r->steps = q->steps;
    r->supports = q->d.calls;
    r->reserved = 0;
    return further == FAULT ? end : further;
}

/* The radius in it, the bracket may be this wide and still be as tight as rounding allows. */
static int tight_enough(const result *r, const difference *d, real radius, real level)
{
    real rounding = (4 * d->doubt + 2 * d->slack) * (level * d->unscale) + 16 * UNIT * (radius * level);
    return (r->upper - r->lower) * level <= rounding;
}

static int distance_status(const result *r, const options *o, enum end end, const search *q, real radius, int deep)
{
    int tolerant = o->abs_tol > 0 || o->rel_tol > 0;
    if (o->cutoff > 0 && r->lower > o->cutoff) return GJK_DECIDED;
    if (q->told && end == STILL && !tolerant) return GJK_OK;
    real level = level_of(&q->d, radius, 0);
    if (narrow(r, o, deep, level) || end == WITHIN) return GJK_OK;
    if (end == OPEN) return GJK_LIMIT;
    return !tolerant && tight_enough(r, &q->d, radius, level) ? GJK_OK : GJK_FLOOR;
}

/* The bracket is about as narrow as its numbers can be. */
static int is_to_last_place(const result *r)
{
    return r->upper - r->lower <= 8 * UNIT * larger(size(r->lower), size(r->upper)) + 8 * TINY;
}

/* The corner in the spare slot lies lower along v than the simplex by so little at most that the simplex may do. */
static int is_about_lowest(const search *q, const goal *g)
{
    real height = dot(q->v, corner(&q->s, q->s.n)->w), gap = q->vv - height;
    return height > 0 && (g->sign_only || !(gap * gap > 16 * UNIT * UNIT * q->vv));
}

/* Where the walk stops at a corner that it does not take in, or one that brings v no nearer: contact of few digits, or
 * a gap that rounding all but blurs. */
static int tell_closely(search *q, const shape *a, const shape *b, const goal *g, int open, result *r)
{
    real weight[DIM + 1];
    know_offset(&q->d, a, b);
    if (open && !g->deep && tell_touch(q, a, b, r)) return 1;
    if (q->s.n > DIM || !is_about_lowest(q, g)) return 0;
    q->steps += open;
    enum sighting seen = tell_near(q, a, b, g, g->deep ? NULL : weight, r);
    if (seen == MEETING) tell_meeting(q, a, b, 0, weight, r);
    q->steps -= open && seen == NOTHING;
    return seen != NOTHING;
}

/* Walks. Where a corner that was not sought along v, with care, is out of the ordinary, they touch, or one is sought
 * that way: at most once, since no other is rough from there on. Where strides have led is such a corner. */
static inline enum end walk(search *q, const shape *a, const shape *b, const goal *g, result *r)
{
    int thin = is_thin(&q->d.a) || is_thin(&q->d.b), boxes = q->d.a.asked == AS_BOX && q->d.b.asked == AS_BOX;
    int headings = thin || q->s.n > 0 ? 0 : HEADINGS, hasty = g->sign_only && !thin && !boxes;
    int strode = q->glanced == STRODE && q->s.n <= DIM;
    for (;;) {
        enum end end = strode ? OPEN : stroll(q, g, headings, hasty);
        if (end != OPEN || (!strode && !q->rough) || q->steps >= g->max_steps) return end;
        know_offset(&q->d, a, b);
        q->told = !g->deep && !(strode && q->stood) && tell_touch(q, a, b, r);
        if (q->told) return STILL;
        if (!strode && ++q->steps >= g->max_steps) {
            raise(q, q->way, spare(&q->s)->w);
            return OPEN;
        }
        headings = hasty = strode = q->repeated = 0;
        if (!ask_on(&q->d, q->v, spare(&q->s))) return FAULT;
    }
}

#if DIM == 3
/* Strides have led so near to contact that float can't tell: the sister may. */
static int tell_trail(search *q, const shape *a, const shape *b, const options *o, const goal *g, result *r)
{
    if (!HAS_SISTER || q->glanced != STRODE || !q->trail.near || !ask_sister_near(q, a, b, o, g, r)) return 0;
    if (o->cache) remember(o->cache, q, a, b);
    return 1;
}
#else
#define tell_trail(q, a, b, o, g, r) 0
#endif

/* The corners of both can be listed, and are, and nothing is asked that the everyday way does not know. */
static inline int list_both(search *q, const shape *a, const shape *b, const options *o)
{
    q->listed = !o->tight && o->slack == 0 && list_corners(&q->d.a, a) && list_corners(&q->d.b, b);
    q->glanced = UNTRIED;
    return q->listed;
}

/* The corners of both are known, and are all that counts. */
static inline int are_exact(const search *q, const shape *a, const shape *b, const options *o)
{
    return EXACT && (q->listed || (o->slack == 0 && has_corners(a) && has_corners(b)));
}

/* What the cache lends to the everyday way. The axes of boxes need none. */
static inline const cache *lender_of(const shape *a, const shape *b, const options *o, int sign_only)
{
    return o->cache && !(sign_only && are_boxes(a, b)) && lends(o->cache, a, b) ? o->cache : NULL;
}

/* Where float can't tell how far apart two boxes are, in space, the sister may. By penetration as by distance, so that
 * the two agree; how deep they overlap is left to float's own proof. */
static int ask_sister_how_far(search *q, const shape *a, const shape *b, const options *o, const goal *g, result *r)
{
    goal far = *g;
    far.deep = 0;
    return HAS_SISTER && DIM == 3 && ask_sister_alone(q, a, b, o, &far, r) && (!g->deep || r->lower > 0);
}

/* How deep two boxes are, if that is asked, or how far apart. */
static inline int tell_extent(search *q, const shape *a, const shape *b, const options *o, const goal *g, result *r)
{
    if (g->deep && (tell_level(q, a, b, g, r) || (ask_centres(q) && tell_boxes(q, a, b, g, r)))) return 1;
    const int seen = tell_gap(q, a, b, g, r);
    if (!seen && !ask_sister_how_far(q, a, b, o, g, r)) return 0;
    if (o->cache && seen && q->pending) remember(o->cache, q, a, b);
    else if (o->cache) o->cache->count = 0; /* a point of both took no corner */
    return 1;
}

/* The everyday way, of sets whose corners are listed. How far it led; FAULT: nowhere. q->told: to the answer. */
static enum end answer_plainly(search *q, const shape *a, const shape *b, const options *o, const goal *asked,
                               result *r)
{
    goal own;
    const goal *g = asked;
    const int boxes = are_boxes(a, b);
    if (!settle_both(q, a, b)) return FAULT;
    if (q->glanced == STRODE && q->d.wild) q->glanced = UNCLEAR;
    if (!is_scale_free(g)) {
        own = scaled(g, q->d.scale);
        g = &own;
    }
    if (boxes && !g->sign_only) q->told = tell_extent(q, a, b, o, g, r);
    if (q->thin == UNCLEAR) {
        q->thin = tell_thin_in_frame(&q->d, a, b, g, r) ? TELLING : IN_VAIN;
        q->told = q->thin == TELLING;
    }
    if (HAS_SISTER && g->sign_only && q->thin && !q->told) q->told = ask_sister_alone(q, a, b, o, asked, r);
    if (q->told || tell_polygons_in_frame(q, a, b, o, asked, r)) return STILL;
#if DIM == 3
    if (q->lent == UNCLEAR && recall_in_frame(q, o->cache, a, b, r)) {
        remember(o->cache, q, a, b);
        q->told = 1;
        return BEYOND;
    }
#endif
    if (!open_listed(q, lender_of(a, b, o, g->sign_only))) return FAULT;
    if (q->glanced == UNCLEAR || (q->glanced && q->d.wild) || (boxes && g->sign_only && q->glanced != AIMED))
        q->told = look_in_frame(q, g->max_steps, a, b, r);
    if (HAS_SISTER && g->sign_only && boxes && !q->told) q->told = ask_sister_alone(q, a, b, o, asked, r);
#if DIM == 3
    const int lost = q->d.wild && q->d.lost > 0; /* strides charge nothing for what underflows */
    if (!q->told && !lost && q->glanced == UNCLEAR && are_for_strides(&q->d, a, b)) {
        q->glanced = stride_in_frame(q, g->max_steps, a, b, r);
        if (q->glanced == UNCLEAR) return FAULT;
        q->told = q->glanced == TELLING;
        if (q->told && o->cache) remember(o->cache, q, a, b);
        q->told |= tell_trail(q, a, b, o, g, r);
    }
#endif
    if (q->told) return BEYOND;
    if (boxes && g->sign_only && o->cache && !reopen_after_axes(q, a, b, o->cache)) return FAULT;
    enum end end = walk(q, a, b, g, r);
    if (!q->told) q->told = g->sign_only ? tell_sign(q, a, b, end, r) : tell_distance(q, a, b, g, end, r);
    int open = end == OPEN && q->steps < g->max_steps;
    if (!q->told && (end == STILL || open))
        q->told = (is_near(q) && ask_sister_near(q, a, b, o, g, r)) || tell_closely(q, a, b, g, open, r);
    if (q->told && open) end = STILL;
    if (q->told && o->cache) remember(o->cache, q, a, b);
    return end;
}

/* What the questions share, of bodies that are listed if they can be. Not 0: the caller's mistake. */
static int reply_to(search *q, const shape *a, const shape *b, const options *o, const goal *g, enum end *end,
                    result *r)
{
    q->d.calls = 0;
    q->told = 0;
    if (q->flat == UNTRIED && q->listed && !g->sign_only) {
        q->flat = tell_flat(a, b, o->cache, g, r) ? TELLING : IN_VAIN;
        q->told = q->flat == TELLING;
    }
    *end = STILL;
    if (DIM == 3 && q->thin == UNTRIED && q->listed && tell_wide_sticks(a, b, g, r)) {
        q->told = 1;
        if (o->cache) o->cache->count = 0;
    }
    if (HAS_SISTER && !q->listed && !g->exact && !g->sign_only) q->told = ask_sister_first(q, a, b, o, g, end, r);
    if (q->told) {
        q->d.scale = leveler(larger(size(r->lower), size(r->upper))); /* what the status is found in */
        q->d.unscale = 1 / q->d.scale;
        q->d.doubt = 2 * UNIT; /* of an answer of the sister's, which may be wide */
        q->d.slack = 0;
        return 0;
    }
    if (q->thin == UNTRIED && q->listed && are_thin(&q->d))
        q->thin = are_ends_within(&q->d.a) && are_ends_within(&q->d.b) ? tell_thin(&q->d, a, b, g, r) : IN_VAIN;
    q->told = q->thin == TELLING;
    tell_polygons(q, a, b, o, g, r);
    *end = q->told ? STILL : q->listed ? answer_plainly(q, a, b, o, g, r) : FAULT;
    if (q->thin == TELLING && o->cache) o->cache->count = 0; /* there is nothing that a formula would start from */
    if (q->told) return 0;
    if (!sound(a) || !sound(b)) return GJK_BAD_ARGUMENT;
    q->turned = 0;
    *end = solve(q, a, b, o, g, *end, r);
    if (q->turned) { /* to what has turned out to be no way out */
        q->turned = -1;
        *end = solve(q, a, b, o, g, FAULT, r);
    }
    if (*end == FAULT) return GJK_BAD_SUPPORT;
    if (o->cache) remember(o->cache, q, a, b);
    return 0;
}

/* The whole answer, of any bodies, whatever is asked. */
static WHOLE int answer_distance(search *q, const shape *a, const shape *b, const options *given, result *out)
{
    options own;
    const options *o = read_options(&own, given);
    result r;
    if (!o || !out || !a || !b) return GJK_BAD_ARGUMENT;
    q->lent = UNTRIED;
    list_both(q, a, b, o);
    real radius = a->radius + b->radius;
    goal g = {.beyond = REAL_MAX,
              .within = -1,
              .radius = radius,
              .abs_tol = o->abs_tol,
              .rel_tol = o->rel_tol,
              .exact = are_exact(q, a, b, o),
              .max_steps = (int)o->max_steps};
    if (o->cutoff > 0) g.beyond = (o->cutoff + radius) * (1 + 16 * UNIT);
    if (radius > 0) g.within = radius * (1 - 16 * UNIT);
    g.early = radius > 0 || o->abs_tol > 0 || o->rel_tol > 0;

    enum end end;
    int bad = reply_to(q, a, b, o, &g, &end, &r);
    if (bad) return bad;
    r.upper = larger(r.upper, 0);
    r.lower = larger(r.lower, 0);
    r.value = smaller(larger(r.value, r.lower), r.upper);
    r.status = distance_status(&r, o, end, q, radius, 0);
    *out = r;
    return r.status;
}

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
    if (!a || !b || !r || !asks_nothing_else(o) || (deep && o && !has_workspace(o))) return 0;
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

GJK_API int pub(distance)(const shape *a, const shape *b, const options *given, result *out)
{
    search q;
    if (tell_plainly(&q, a, b, given, 0, 0, out)) return out->status = GJK_OK;
    return answer_distance(&q, a, b, given, out);
}

/* So many are used up already. */
static const options *take_steps_off(options *own, const options *o, int steps)
{
    if (o != own) *own = *o;
    own->max_steps -= (uint32_t)steps;
    return own;
}

static WHOLE int answer_intersect(search *q, const shape *a, const shape *b, const options *given, result *out)
{
    options own;
    const options *o = check_options(&own, given);
    result r;
    if (!o || !out || !a || !b) return GJK_BAD_ARGUMENT;
    int spent[2] = {0, 0}; /* steps and calls, on what is left to the search */
    if (q->glanced == UNTRIED && list_both(q, a, b, o) && !are_thin(&q->d) && !are_planar(&q->d)) {
        if (!lender_of(a, b, o, 1))
            q->glanced = are_boxes(a, b) ? glance_at_boxes(q, (int)steps_of(o), a, b, out) : glance(q, a, b, out);
        else if (is_recalled(q, a, b, (int)steps_of(o))) q->glanced = recall_and_remember(q, a, b, o, out, spent);
    }
#if DIM == 3
    if (q->glanced == IN_VAIN) q->glanced = stride_and_remember(q, a, b, o, out);
    if (!q->listed && o->slack == 0 && look_at_solids(q, (int)steps_of(o), a, b, out, spent)) q->glanced = TELLING;
#endif
    if (q->glanced == TELLING) return out->status = GJK_DECIDED;
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
        (!q->listed && spent[1] > 0) || q->glanced == CLOUDED || q->glanced == AIMED; /* float can't tell */
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

GJK_API int pub(intersect)(const shape *a, const shape *b, const options *given, result *out)
{
    search q;
    q.dug = -1;
    q.glanced = q.lent = UNTRIED;
    if (are_plain_hulls(a, b, given, out)) q.glanced = glance_at_hulls(&q, given ? given->cache : NULL, a, b, out);
    else if (are_plain_boxes(a, b, given, out)) q.glanced = glance_at_plain_boxes(&q, (int)steps_of(given), a, b, out);
    if (q.glanced == TELLING) return out->status = GJK_DECIDED;
    if (q.glanced == UNTRIED && tell_plainly(&q, a, b, given, 1, 0, out)) return out->status = GJK_DECIDED;
    return answer_intersect(&q, a, b, given, out);
}

GJK_API size_t pub(workspace_size)(uint32_t corners)
{
    return corners >= FEWEST_TIPS && corners <= MOST_TIPS ? bytes_for(corners) : 0;
}

static int answer_penetration(search *q, const shape *a, const shape *b, const options *given, result *out)
{
    options own;
    const options *o = read_options(&own, given);
    result r;
    if (!o || !out || !a || !b || !has_workspace(o)) return GJK_BAD_ARGUMENT;
    q->lent = UNTRIED;
    list_both(q, a, b, o);
    real radius = a->radius + b->radius;
    goal g = {.beyond = REAL_MAX,
              .within = -1,
              .radius = radius,
              .abs_tol = o->abs_tol,
              .rel_tol = o->rel_tol,
              .early = o->abs_tol > 0 || o->rel_tol > 0,
              .exact = are_exact(q, a, b, o),
              .deep = 1,
              .max_steps = (int)o->max_steps};
    g.tight = g.exact && o->tight;
    if (o->cutoff > 0) g.beyond = (o->cutoff + radius) * (1 + 16 * UNIT);

    enum end end;
    int bad = reply_to(q, a, b, o, &g, &end, &r);
    if (bad) return bad;
    r.lower = larger(r.lower, -REAL_MAX); /* any slack may have been taken off */
    r.value = smaller(larger(r.value, r.lower), r.upper);
    r.status = distance_status(&r, o, end, q, radius, 1);
    if (g.tight && r.status == GJK_OK && !narrow(&r, o, 1, 1) && !is_to_last_place(&r)) r.status = GJK_FLOOR;
    *out = r;
    return r.status;
}

GJK_API int pub(penetration)(const shape *a, const shape *b, const options *given, result *out)
{
    search q;
    if (tell_plainly(&q, a, b, given, 0, 1, out)) return out->status = GJK_OK;
    return answer_penetration(&q, a, b, given, out);
}

#endif
