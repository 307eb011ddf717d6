/* SPDX-License-Identifier: MIT */
/* Whether two hulls of some corners meet, told at the door: the glance, along the line of centres or the way that a
 * cache has kept, and the digging where that is deep, before anything is set up for what else may be asked, of bodies
 * or about them. They are those of glance.h, lent.h and stride.h to the bit, and what has told nothing the strides go
 * on from. */
#ifndef GJK_CORE_HULLS_H
#define GJK_CORE_HULLS_H

#include "lent.h"

#if DIM == 3

/* Two clouds without radii, and nothing is asked but what everyone asks; nor does a cache lend anything but a way. */
HOT int are_plain_hulls(const shape *a, const shape *b, const options *o, const result *r)
{
    return a && b && r && a->support == pub(support_points) && b->support == pub(support_points) && a->radius == 0 &&
           b->radius == 0 &&
           (!o || (asks_nothing_else(o) && o->max_steps == 0 &&
                   (!o->cache || lends_way(o->cache) || !lends(o->cache, a, b))));
}

/* The body of one. 0: it is none, or has so few corners that it may be thin, or they do not lie one beside another. */
HOT int take_hull(body *k, const shape *s)
{
    const points *p = s->data;
    if (!p || !p->v || p->count < EIGHT || !(p->stride == 0 || p->stride == DIM * sizeof(real)) || !(p->reach > TINY))
        return 0;
    take_pose(k, s);
    k->asked = AS_LIST;
    k->list = (list){p->v, p->count, DIM, p->reach, index_of_cloud(p)};
    know_reach(k, p->reach);
    return 1;
}

/* The first corner lies deep: few corners of long lists will do. */
static APART enum glanced dig_at_door(search *q, real height, vec first_at, const shape *a, const shape *b, result *r)
{
    portion k;
    look_at_some(&q->d, &k);
    const enum glanced seen = dig_from(q, 1, k.n == 1, height, first_at, a, b, r);
    look_at_all(&q->d, &k);
    return seen;
}

/* Their corners along v, and what these show. 0: they can't be asked for. */
HOT int see_hulls(search *q, vec v, evidence *e)
{
    difference *d = &q->d;
    vertex *p = &q->s.slot[0];
    if (!(dot(v, v) > 1 / PLAIN)) return 0;
    const sought s = seek_both(d, v);
    if (!point_of_hull(&d->a, s.of_a, FIRST_SIGHT, &p->x) || !point_of_hull(&d->b, s.of_b, FIRST_SIGHT, &p->y))
        return 0;
    see_corner(d, v, duos_of(p->x, p->y), e);
    return 1;
}

/* UNTRIED: they are no such hulls, or of sizes that a glance does not know; or the way that a cache has kept has told
 * nothing, and q->lent says so. Where there is a cache others dig, who fill it. */
static APART enum glanced glance_at_hulls(search *q, const cache *own, const shape *a, const shape *b, result *r)
{
    difference *d = &q->d;
    evidence e;
    if (!take_hull(&d->a, a) || !take_hull(&d->b, b)) return UNTRIED;
    stay_outside(d, a, b);
    lay_maps(d);
    vec v = mul(d->c, -1);
    const real cc = dot(v, v);
    const int lent = own && lends(own, a, b);
    if ((lent && !recall_way(d, own, &v)) || !see_hulls(q, v, &e)) return UNTRIED;
    const duo sets = duo_of(square_of_list(&d->a.list, 1, 1), square_of_list(&d->b.list, 1, 1));
    if (!doubt_by_squares(d, cc, square_of_duo_map(&d->maps), sets)) return UNTRIED;
    if (e.height > 0) {
        weigh_evidence(&e, v, d->doubt);
        if (e.lower > 0) {
            q->steps = 0;
            d->calls = 2;
            spell_sharp(q, &e, v, 1, a, b, r);
            return TELLING;
        }
    }
    if (lent) {
        q->lent = IN_VAIN;
        return UNTRIED;
    }
    start_glance(q, v);
    q->s.slot[0].w = e.w;
    q->listed = 1;
    q->thin = q->planar = q->flat = UNTRIED;
    if (own) return IN_VAIN;
    q->dug = 0;
    if (!lies_deep(d, e.height)) return IN_VAIN;
    const enum glanced seen = dig_at_door(q, e.height, e.a, a, b, r);
    return seen == UNCLEAR ? UNTRIED : seen;
}

#else
#define are_plain_hulls(a, b, o, r) 0
#define glance_at_hulls(q, own, a, b, r) UNTRIED
#endif

#endif
