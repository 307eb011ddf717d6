/* SPDX-License-Identifier: MIT */
/* All of the way to an answer, of any bodies: the search, from the cache or from where a walk has come to, and what
 * finishes it: without rounding, in the float variants' sister, or as a depth. */
#ifndef GJK_CORE_SOLVE_H
#define GJK_CORE_SOLVE_H

#include "answer.h"
#include "apart.h"
#include "contact.h"
#include "fine.h"
#include "intersect.h"
#include "widen.h"

/* ---- the search ---- */

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

/* The room in a full simplex bounds the cores' separation from above. */
static inline void take_room(const search *q, enum end end, real *upper)
{
    if (end == INSIDE && q->inside > q->d.doubt) *upper = q->d.doubt - q->inside;
}

/* Goes on from where the walk has come to. FAULT: the bounds cross, or a support's answer was none. */
static enum end run_on(search *q, const shape *a, const shape *b, const goal *g, enum end walked, real *upper,
                       real weight[])
{
    settle_rest(&q->d, a, b);
    const goal here = scaled(g, q->d.scale);
    enum end end = walked;
    if (end == STILL && !q->repeated && !g->sign_only) q->stuck = is_lower(q);
    if (end == OPEN && q->steps < g->max_steps) end = descend(q, &here);
    if (walked == INSIDE && is_depth_alone(q, g)) {
        *upper = q->d.doubt - q->inside;
        weigh_walked(q, weight);
        return end;
    }
    end = sharpen_on(q, &here, end, upper, weight);
    take_room(q, end, upper);
    return end != FAULT && q->lower <= *upper ? end : FAULT;
}

/* The same from a frame that is open, and what the cache has lent in that. */
static enum end run_anew(search *q, const goal *g, real *upper, real weight[])
{
    const goal here = scaled(g, q->d.scale);
    const enum end end = search_on(q, &here, upper, weight);
    if (end == BEYOND && g->sign_only && q->lender) {
        stand_on_last(q);
        *upper = certify(q, weight);
    }
    take_room(q, end, upper);
    return end;
}

/* Searches, from the cache if that fits. Returns how the search ended, with an upper bound of the cores' separation;
 * FAULT also where the bounds cross, which points of two convex sets never do. */
static enum end run(search *q, const shape *a, const shape *b, const options *o, const goal *g, enum end walked,
                    real *upper, real weight[])
{
    enum end end = walked == FAULT ? FAULT : run_on(q, a, b, g, walked, upper, weight);
    if (end != FAULT) return end;
    int warm = o->cache != NULL;
    int opened = q->turned >= 0 && !g->exact && have_heights(a, b) && open_cold(q, a, b, o->slack);
    end = OPEN;
    if (opened && run_to_dip(q, a, b, g, &end, upper, weight)) return end;
    opened &= !warm && end == OPEN;
    if (q->turned > 0) q->turned = 0;
    for (;;) {
        if (warm) warm = open_warm(q, a, b, o->slack, o->cache);
        if (!opened) forget_first_dip(q->first_dip); /* the frame may be another */
        opened = opened || warm || open_cold(q, a, b, o->slack);
        end = opened ? run_anew(q, g, upper, weight) : FAULT;
        if (end != FAULT && q->lower <= *upper && settled(q)) {
            const int closed = end == STILL || end == INSIDE;
            if (!(warm && closed && coarse(q, *upper) && !g->exact)) return end;
        }
        if (!warm) return FAULT;
        warm = opened = 0;
    }
}

/* ---- what finishes it ---- */

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

/* The bracket of the distance is as narrow as asked. One too wide for a number is not. In the answer's own unit, so
 * that what is asked is not lost where numbers are least. */
static int narrow(const result *r, const options *o, int deep)
{
    const real far = r->upper < 0 ? -r->lower : r->upper, width = r->upper - (deep ? r->lower : larger(r->lower, 0));
    if (!(width <= REAL_MAX)) return 0;
    const real level = leveler(larger(size(r->lower), size(r->upper)));
    return width * level <= o->abs_tol * level + o->rel_tol * (far * level);
}

/* Finishes the search without rounding, and replaces what the result says of the distance. OPEN, FAULT: that can't be
 * done, and nothing is changed. */
static APART enum end tighten(search *q, const shape *a, const shape *b, const goal *g, result *r, real weight[])
{
    finish f;
    real ends[3];
    enum end end = conclude(&f, q, a, b, g->max_steps);
    if (end != STILL) return end;
    if (!enclose(&f, a->radius, b->radius, ends)) { /* with the radii's too many digits */
        end = climb_down_roughly(&f, q, g->max_steps);
        if (end != STILL) return end;
        if (!enclose(&f, a->radius, b->radius, ends)) return FAULT;
    }
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
    int open = g->sign_only ? r->lower <= 0 && r->upper > 0 : (g->deep || r->upper > 0) && !narrow(r, o, g->deep);
    return open ? ask_sister(q, a, b, o, g, r) : FAULT;
}

/* ---- how deep ---- */

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

/* The cores meet, or rounding leaves it open: the depth instead of the distance. searched: the simplex as it is. */
static APART enum end plumb(search *q, const shape *a, const shape *b, const options *o, const goal *g, real *upper,
                            real weight[], const simplex *searched, result *r)
{
    depth d;
    goal here = scaled(g, q->d.scale);
    real found[DIM + 1];
    begin_depth(&d, q, a, b, &here);
    memcpy(found, weight, sizeof found);
    if (q->met) *upper = smaller(*upper, q->met_off);
    if (o->workspace) d.p = polytope_in(o->workspace, tips_in(o->workspace_bytes));
    enum end end = o->workspace ? fathom(&d, upper, weight) : fathom_in_own_room(&d, upper, weight);
    if (end == FAULT || !(q->lower <= *upper)) return FAULT;
    if (*upper < 0) q->turned = 0;
    bracket(r, &q->d, q->lower, *upper, a, b);
    r->value = middle(q, g, d.near);
    if (d.settled) {
        r->lower = d.known_off > 0 ? larger(d.ends[0], r->lower) : d.ends[0];
        r->value = d.ends[1];
        r->upper = d.known_off > 0 ? smaller(d.ends[2], r->upper) : d.ends[2];
    }
    store(r->normal, q->normal);
    if (r->lower > 0) { /* apart after all: the pair that upper is of */
        q->s = *searched;
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
    const simplex searched = q->s;
    enum end end = plumb(q, a, b, o, g, &upper, weight, &searched, r);
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
    if (may_meet(q, g, further)) {
        const simplex searched = q->s;
        return plumb(q, a, b, o, g, &upper, weight, &searched, r);
    }
    if (g->exact && further == FAULT) point_out_apart(q, a, b, g, upper, weight, r);
    return further == FAULT ? end : further;
}

/* ---- all of it ---- */

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
    if (DEPTHS && g->deep) end = go_deep(q, a, b, o, g, upper, weight, r, end);
    else if (still && !g->exact) further = take_further(q, a, b, o, g, upper, weight, r);
    if (end == FAULT) return FAULT;
    r->steps = q->steps;
    r->supports = q->d.calls;
    r->reserved = 0;
    return further == FAULT ? end : further;
}

#endif
