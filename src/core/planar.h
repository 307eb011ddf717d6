/* SPDX-License-Identifier: MIT */
/* Polygons of few corners in the plane: GJK in the caller's own lengths, and with nothing in it that is not needed
 * where rounding does not blur what is asked. All corners are placed before the first step, side by side, so that a
 * step costs little. An edge's direction is square to the difference of its ends, which has lost nothing to where these
 * are; what the bounds charge is what a glance does (glance.h). Whatever is out of the ordinary is left to the walk;
 * where sizes are not plain all is done in the frame, to the same bits. */
#ifndef GJK_CORE_PLANAR_H
#define GJK_CORE_PLANAR_H

#include "planar_depth.h"

#if DIM == 2

/* The whole answer is kept out of the way of the everyday one. */
#define WHOLE APART

/* ---- the corner asked for last ---- */

/* What it shows, where it is only asked whether they meet: that they are apart. The line of centres, along which it was
 * first, may be too short to be a direction. */
HOT int is_apart(const difference *d, const front *f, const goal *g)
{
    const real least = d->doubt + g->radius * d->scale, height = dot(f->way, f->last.w);
    if (!(height > 0)) return 0;
    const real l = length(f->way);
    return height > least * l && l > d->doubt * (UNIT / PLANAR_DOUBT);
}

HOT int tell_apart_at(search *q, const scene *k, const front *f, int framed, const shape *a, const shape *b,
                      const goal *g, result *r)
{
    const spot *p = &f->last;
    verdict t;
    see_along(&t, f->way);
    t.way = p->w;
    t.lower = dot(f->way, p->w) / t.l - q->d.doubt;
    t.upper = length(p->w) * (1 + 8 * UNIT) + q->d.doubt;
    t.a = place_of(&k->a, in_a(p));
    t.b = place_of(&k->b, in_b(p));
    return t.lower > 0 && spell_verdict(q, &t, f, framed, a, b, g, r);
}

/* That they are farther apart than is asked, if that is asked. */
HOT int shows_beyond(const difference *d, const front *f, const goal *g)
{
    if (g->sign_only || g->beyond == REAL_MAX) return 0;
    return dot(f->way, f->last.w) > (g->beyond * d->scale + EVIDENT * d->doubt) * length(f->way);
}

/* The front is so near that the radii meet. */
HOT int is_within(const difference *d, const front *f, const goal *g)
{
    if (!g->sign_only) return 0;
    const real within = g->radius * d->scale - EVIDENT * d->doubt, height = dot(f->v, f->p.w);
    return within > 0 && height < within * length(f->v);
}

/* ---- the walk ---- */

HOT enum halt walk_front(const difference *d, const scene *k, front *f, const goal *g)
{
    const real least = d->doubt * (UNIT / PLANAR_DOUBT);
    for (;;) {
        f->ended = f->n > 0 && !(dot(f->v, f->v) > least * least); /* it has no direction */
        if (f->ended || f->steps >= ASKED_MOST || f->steps >= g->max_steps) return LOST;
        ask_ahead(d, k, f);
        if (g->sign_only && is_apart(d, f, g)) return SHOWN;
        if (f->n > 0) {
            f->ended = is_foremost(d, k, f);
            if (f->ended || shows_beyond(d, f, g) || is_within(d, f, g)) return FOREMOST;
        }
        f->around = !turn_front(k, f);
        if (f->around) return AROUND;
    }
}

/* Where this walk was left, if that is where another may go on. */
static APART void leave_front(search *q, const scene *k, front f, const shape *a, const shape *b)
{
    q->found.at.count = 0;
    if (!f.around && !f.ended) return;
    blank(q);
    q->lower = -REAL_MAX;
    q->d.slack = 0;
    if (f.steps > 0) raise(q, f.way, f.last.w);
    keep_front(&q->found.at, q, k, &f, a, b);
    q->found.steps = f.steps;
    q->found.calls = 2 * f.steps;
    q->found.lower = q->lower * q->d.unscale;
    q->found.normal = q->normal;
}

/* 0: nothing is told. */
HOT int look_at_planar(search *q, cache *own, int framed, const shape *a, const shape *b, const goal *g, result *r)
{
    const difference *d = &q->d;
    scene k;
    front f;
    q->found.at.count = 0;
    list_places(&d->a, &k.a);
    list_places(&d->b, &k.b);
    if (!place_corners(&d->a, framed, &k.a) || !place_corners(&d->b, framed, &k.b)) return 0;
    const int lent = own && lends(own, a, b);
    f.n = f.steps = f.around = f.ended = 0;
    if (lent && !recall_front(d, &k, framed, &f, own)) {
        if (g->deep) return 0; /* to the walk, which knows what was lent */
        f.n = 0;
    }
    const int recalled = f.n;
    if (!recalled) f.v = mul(d->c, -1);
    const enum halt at = walk_front(d, &k, &f, g);
    int told = at == SHOWN      ? tell_apart_at(q, &k, &f, framed, a, b, g, r)
               : at == FOREMOST ? tell_front(q, &k, &f, framed, a, b, g, r)
               : at == AROUND   ? DEPTHS && g->deep ? !HAS_SISTER && tell_deep(q, &k, f, framed, a, b, g, r)
                                                    : tell_held(q, &k, &f, framed, a, b, g, r)
                                : 0;
    if (!told) told = tell_touching(q, &k, f, framed, a, b, g, r);
    if (told && f.n == 0) stand_on_corner(&f, f.last);
    if (!told) leave_front(q, &k, f, a, b);
    else if (own && !(recalled && is_kept(own, &f))) hand_on_front(own, q, &k, f, a, b);
    return told;
}

/* The same, for the few that ask anything else. */
static APART int look_in_full(search *q, cache *own, int framed, const shape *a, const shape *b, const goal *g,
                              result *r)
{
    return look_at_planar(q, own, framed, a, b, g, r);
}

/* ---- the doubt ---- */

/* Without a frame. 0: the sizes are none for that. */
HOT int settle_outside(difference *d, const shape *a, const shape *b)
{
    real map[2];
    duos uu;
    stay_outside(d, a, b);
    if (!doubt_outside(d, a, b, square_of_reach(&d->a, 1, 1), square_of_reach(&d->b, 1, 1), PLANAR_DOUBT, map, &uu))
        return 0;
    d->a.norm = root(map[0]);
    d->b.norm = root(map[1]);
    return 1;
}

/* In the frame. */
static APART int tell_planar_in_frame(search *q, cache *own, const shape *a, const shape *b, const goal *g, result *r)
{
    const search before = *q;
    difference *d = &q->d;
    const real level_a = level_of_map(&d->a), level_b = level_of_map(&d->b);
    const real map_a = square_of_map(&d->a, squared_axes(&d->a, level_a));
    const real map_b = square_of_map(&d->b, squared_axes(&d->b, level_b));
    d->doubt = PLANAR_DOUBT * root(square_in_frame(&d->a) + square_in_frame(&d->b) + dot(d->c, d->c)) +
               (d->wild ? d->lost : 0);
    d->a.norm = root(map_a) / level_a;
    d->b.norm = root(map_b) / level_b;
    if (look_in_full(q, own, 1, a, b, g, r)) return 1;
    const find found = q->found;
    *q = before;
    q->found = found;
    return 0;
}

/* ---- the door ---- */

/* Without a frame, if they are polygons and that will do. */
static APART enum glanced tell_planar(search *q, const shape *a, const shape *b, const options *o, const goal *g,
                                      result *r)
{
    know_reach_listed(&q->d.a);
    know_reach_listed(&q->d.b);
    if (!settle_outside(&q->d, a, b)) return UNCLEAR;
    return look_in_full(q, o->cache, 0, a, b, g, r) ? TELLING : IN_VAIN;
}

static inline void tell_polygons(search *q, const shape *a, const shape *b, const options *o, const goal *g, result *r)
{
    if (q->planar == UNTRIED) q->found.at.count = 0;
    if (q->told || q->thin != UNTRIED || !are_planar(&q->d)) return;
    if (q->planar == UNTRIED) q->planar = tell_planar(q, a, b, o, g, r);
    q->told = q->planar == TELLING;
}

/* A polygon of few corners, and all that is known of it. 0: it is none. */
HOT int list_polygon(body *k, const shape *s)
{
    const points *p = s->data;
    if (s->support != pub(support_points) || !p || !p->v) return 0;
    const size_t step = stride_of(p);
    if (p->count - 3 > PLACES - 3 || step < DIM || p->stride % sizeof(real) != 0 || !(p->reach > TINY)) return 0;
    k->posed = s->pose != NULL;
    if (k->posed) k->m = s->pose->m;
    k->asked = AS_LIST;
    k->list = (list){p->v, p->count, step, p->reach, NULL};
    k->reach = p->reach;
    k->limit = p->reach * (1 + 16 * UNIT); /* that of know_reach, of plain sizes */
    return 1;
}

/* Without a frame, as settle_outside has it, but for what polygons are not. */
HOT int settle_polygons(difference *d, const shape *a, const shape *b)
{
    stay_outside(d, a, b);
    const real set_a = square_of_reach(&d->a, 1, 1), map_a = square_of_map(&d->a, squared_axes(&d->a, 1));
    const real set_b = square_of_reach(&d->b, 1, 1), map_b = square_of_map(&d->b, squared_axes(&d->b, 1));
    const real square = map_a * set_a + map_b * set_b + dot(d->c, d->c);
    d->doubt = PLANAR_DOUBT * root(square);
    d->a.norm = root(map_a);
    d->b.norm = root(map_b);
    return smaller(smaller(map_a, map_b), smaller(set_a, set_b)) > 1 / PLAIN && are_of_plain_size(square, a, b);
}

/* All that two polygons may be asked at once. */
HOT goal goal_at_once(real radius, int sign_only, int deep, int max_steps)
{
    goal g;
    g.beyond = REAL_MAX;
    g.within = g.abs_tol = g.rel_tol = 0;
    g.radius = radius;
    g.early = g.exact = g.tight = 0;
    g.sign_only = sign_only;
    g.deep = deep;
    g.max_steps = max_steps;
    return g;
}

/* The everyday question of two polygons: how far apart, or whether they meet. 0: it is left to the whole answer, which
 * goes on from there. */
HOT int tell_at_once(search *q, const shape *a, const shape *b, const options *o, int sign_only, int deep, result *r)
{
    q->planar = UNTRIED;
    q->flat = UNTRIED;
    if (!HAS_SISTER && (!list_polygon(&q->d.a, a) || !list_polygon(&q->d.b, b))) return 0;
    const uint32_t most = deep ? DEEP_ASKED_MOST : ASKED_MOST;
    const uint32_t max_steps = o && o->max_steps != 0 && o->max_steps < most ? o->max_steps : most;
    const goal g = goal_at_once(a->radius + b->radius, sign_only, deep, (int)max_steps);
    if (HAS_SISTER) {
        q->flat = IN_VAIN;
        if (!tell_flat(a, b, o ? o->cache : NULL, &g, r)) return 0;
        if (sign_only || !(r->lower > 0)) say_plainly(r, sign_only, deep); /* else all is said */
        return 1;
    }
    q->planar = UNCLEAR;
    q->found.at.count = 0;
    if (!settle_polygons(&q->d, a, b)) return 0;
    q->planar = IN_VAIN;
    if (!look_at_planar(q, o ? o->cache : NULL, 0, a, b, &g, r)) return 0;
    say_plainly(r, sign_only, deep);
    return 1;
}

/* That they touch where they were left, with nothing rounded. */
static APART int tell_found(search *q, const shape *a, const shape *b, result *r)
{
    const simplex before = q->s;
    real weight[DIM + 1];
    clear(&q->s);
    if (!take_over(q, &q->found.at) || !holds_origin_plainly(&q->d, &q->s, a, b, weight)) {
        q->s = before;
        return 0;
    }
    q->lower = larger(q->found.lower * q->d.scale, q->lower);
    q->normal = q->found.normal;
    q->steps = q->found.steps;
    q->d.calls = q->found.calls;
    tell_meeting(q, a, b, 0, weight, r);
    return 1;
}

/* What was found, to the caller's cache. */
static void pass_on(cache *own, const cache *found)
{
    for (uint32_t i = 0; i < found->count; i++) {
        store(own->a[i], load(found->a[i]));
        store(own->b[i], load(found->b[i]));
    }
    own->reach_a = found->reach_a;
    own->reach_b = found->reach_b;
    memcpy(own->support, found->support, sizeof own->support);
    memcpy(own->data, found->data, sizeof own->data);
    own->count = found->count;
    own->reserved = found->reserved;
}

/* In the frame, where it was not clear without. What is left is gone on with from there. */
static inline int tell_polygons_in_frame(search *q, const shape *a, const shape *b, const options *o, const goal *g,
                                         result *r)
{
    if (q->planar == UNCLEAR) {
        q->planar = tell_planar_in_frame(q, o->cache, a, b, g, r) ? TELLING : IN_VAIN;
        q->told = q->planar == TELLING;
    }
    if (q->told || q->found.at.count == 0) return q->told;
    q->told = !g->deep && tell_found(q, a, b, r);
    if (q->told && o->cache) pass_on(o->cache, &q->found.at);
    if (q->found.steps >= g->max_steps) q->found.at.count = 0;
    return q->told;
}
#else
#define WHOLE inline
#define are_planar(d) 0
#define tell_flat(a, b, own, g, r) 0
#define tell_at_once(q, a, b, o, sign_only, deep, r) ((q)->planar = (q)->flat = UNTRIED, 0)
#define tell_polygons(q, a, b, o, g, r) ((void)0)
#define tell_polygons_in_frame(q, a, b, o, g, r) 0
#endif

#endif
