/* SPDX-License-Identifier: MIT */
/* The everyday way: of sets whose corners are listed, by the shortest that tells, from formulas and a few looks to a
 * walk; what that leaves open, and all other bodies, are left to the search (solve.h). */
#ifndef GJK_CORE_EVERYDAY_H
#define GJK_CORE_EVERYDAY_H

#include "boxes.h"
#include "gap.h"
#include "hulls.h"
#include "plain.h"
#include "planar.h"
#include "solid.h"
#include "solve.h"
#include "stride.h"
#include "thin_door.h"

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
    q->listed = SHORTCUTS && !o->tight && o->slack == 0 && list_corners(&q->d.a, a) && list_corners(&q->d.b, b);
    q->glanced = UNTRIED;
    return q->listed;
}

static inline int are_listed(const search *q) { return SHORTCUTS && q->listed; }

/* The corners of both are known, and are all that counts. */
static inline int are_exact(const search *q, const shape *a, const shape *b, const options *o)
{
    return EXACT && (are_listed(q) || (o->slack == 0 && has_corners(a) && has_corners(b)));
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
    if (DEPTHS && g->deep && (tell_level(q, a, b, g, r) || (ask_centres(q) && tell_boxes(q, a, b, g, r)))) return 1;
    const int seen = tell_gap(q, a, b, g, r);
    if (!seen && !ask_sister_how_far(q, a, b, o, g, r)) return 0;
    if (o->cache && seen && q->pending) remember(o->cache, q, a, b);
    else if (o->cache) o->cache->count = 0; /* a point of both took no corner */
    return 1;
}

/* By what needs no walk: the axes and facets of boxes, formulas, what goes around polygons. */
static int tell_by_formula(search *q, const shape *a, const shape *b, const options *o, const goal *asked,
                           const goal *g, result *r)
{
    if (are_boxes(a, b) && !g->sign_only) q->told = tell_extent(q, a, b, o, g, r);
    if (q->thin == UNCLEAR) {
        q->thin = tell_thin_in_frame(&q->d, a, b, g, r) ? TELLING : IN_VAIN;
        q->told = q->thin == TELLING;
    }
    if (HAS_SISTER && g->sign_only && q->thin && !q->told) q->told = ask_sister_alone(q, a, b, o, asked, r);
    return q->told || tell_polygons_in_frame(q, a, b, o, asked, r);
}

/* By a look along a way or some, in the frame. 0: that can't be done. */
static int look_on(search *q, const shape *a, const shape *b, const options *o, const goal *asked, const goal *g,
                   result *r)
{
    const int boxes = are_boxes(a, b) && g->sign_only;
    if (q->glanced == UNCLEAR || (q->glanced && q->d.wild) || (boxes && q->glanced != AIMED))
        q->told = look_in_frame(q, g->max_steps, a, b, r);
    if (HAS_SISTER && boxes && !q->told) q->told = ask_sister_alone(q, a, b, o, asked, r);
#if DIM == 3
    const int lost = q->d.wild && q->d.lost > 0; /* strides charge nothing for what underflows */
    if (!q->told && !lost && q->glanced == UNCLEAR && are_for_strides(&q->d, a, b)) {
        q->glanced = stride_in_frame(q, g->max_steps, a, b, r);
        if (q->glanced == UNCLEAR) return 0;
        q->told = q->glanced == TELLING;
        if (q->told && o->cache) remember(o->cache, q, a, b);
        q->told |= tell_trail(q, a, b, o, g, r);
    }
#endif
    return 1;
}

/* The distance where a corner that was sought along v, with care, looks lower than it is but brings v no nearer, as one
 * in the plane of a simplex does: that its roundings make it so is seen without them. */
static int tell_distance_at_last(search *q, const shape *a, const shape *b, const goal *g, result *r)
{
    const real lower = q->lower;
    const vec normal = q->normal;
    if (g->sign_only || q->rough || q->s.n == 0) return 0;
    q->steps++;
    raise(q, q->v, spare(&q->s)->w);
    if (tell_distance(q, a, b, g, STILL, r)) return 1;
    q->steps--;
    q->lower = lower;
    q->normal = normal;
    return 0;
}

/* By a walk, and what may tell where that ends. */
static enum end walk_and_tell(search *q, const shape *a, const shape *b, const options *o, const goal *g, result *r)
{
    const enum end end = walk(q, a, b, g, r);
    const int open = end == OPEN && q->steps < g->max_steps;
    if (!q->told) q->told = g->sign_only ? tell_sign(q, a, b, end, r) : tell_distance(q, a, b, g, end, r);
    if (!q->told && open) q->told = tell_distance_at_last(q, a, b, g, r);
    if (!q->told && (end == STILL || open))
        q->told = (is_near(q) && ask_sister_near(q, a, b, o, g, r)) || tell_closely(q, a, b, g, open, r);
    if (q->told && o->cache) remember(o->cache, q, a, b);
    return q->told && open ? STILL : end;
}

/* The everyday way, of sets whose corners are listed. How far it led; FAULT: nowhere. q->told: to the answer. */
static enum end answer_plainly(search *q, const shape *a, const shape *b, const options *o, const goal *asked,
                               result *r)
{
    goal own;
    const goal *g = asked;
    if (!settle_both(q, a, b)) return FAULT;
    if (q->glanced == STRODE && q->d.wild) q->glanced = UNCLEAR;
    if (!is_scale_free(g)) {
        own = scaled(g, q->d.scale);
        g = &own;
    }
    if (tell_by_formula(q, a, b, o, asked, g, r)) return STILL;
#if DIM == 3
    if (q->lent == UNCLEAR && recall_in_frame(q, o->cache, a, b, r)) {
        remember(o->cache, q, a, b);
        q->told = 1;
        return BEYOND;
    }
#endif
    if (!open_listed(q, lender_of(a, b, o, g->sign_only)) || !look_on(q, a, b, o, asked, g, r)) return FAULT;
    if (q->told) return BEYOND; /* or however else: not for want of steps */
    if (are_boxes(a, b) && g->sign_only && o->cache && !reopen_after_axes(q, a, b, o->cache)) return FAULT;
    return walk_and_tell(q, a, b, o, g, r);
}

/* What the questions share, of bodies that are listed if they can be. Not 0: the caller's mistake. */
static int reply_to(search *q, const shape *a, const shape *b, const options *o, const goal *g, enum end *end,
                    result *r)
{
    q->d.calls = 0;
    q->told = 0;
    if (q->flat == UNTRIED && are_listed(q)) {
        q->flat = tell_flat(a, b, o->cache, g, r) ? TELLING : IN_VAIN;
        q->told = q->flat == TELLING;
    }
    *end = STILL;
    if (DIM == 3 && q->thin == UNTRIED && are_listed(q) && tell_wide_sticks(a, b, g, r)) {
        q->told = 1;
        if (o->cache) o->cache->count = 0;
    }
    if (HAS_SISTER && !are_listed(q) && !g->exact && !g->sign_only) q->told = ask_sister_first(q, a, b, o, g, end, r);
    if (q->told) {
        q->d.scale = leveler(larger(size(r->lower), size(r->upper))); /* what the status is found in */
        q->d.unscale = 1 / q->d.scale;
        /* of an answer of the sister's, which may be wide; where hers ends it, float's of a size: */
        q->d.doubt = 2 * UNIT;
        if (*end == BEYOND) q->d.doubt = larger(UNIT * size_of_pair(a, b) * q->d.scale, q->d.doubt);
        q->d.slack = 0;
        return 0;
    }
    if (q->thin == UNTRIED && are_listed(q) && are_thin(&q->d))
        q->thin = are_ends_within(&q->d.a) && are_ends_within(&q->d.b) ? tell_thin(&q->d, a, b, g, r) : IN_VAIN;
    q->told = q->thin == TELLING;
    if (are_listed(q)) tell_polygons(q, a, b, o, g, r);
    *end = q->told ? STILL : are_listed(q) ? answer_plainly(q, a, b, o, g, r) : FAULT;
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

#endif
