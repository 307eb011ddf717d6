/* SPDX-License-Identifier: MIT */
/* Round sets that are apart, without a walk. The height of A - B along n is below 0 only where they are, and there it
 * has but one dip: along the way between their nearest points. A few turns find it (round.h), where corners come near
 * it but slowly; and the one corner there proves it. */
#ifndef GJK_CORE_APART_H
#define GJK_CORE_APART_H

#include "distance.h"
#include "round.h"

static void put_in(search *q, vertex p)
{
    p.w = corner_of(&q->d, p.x, p.y);
    *spare(&q->s) = p;
    q->s.n++;
}

/* The corner is all of the simplex. */
static void stand_alone(search *q, const vertex *p)
{
    clear(&q->s);
    put_in(q, *p);
    project(q, 1);
}

/* p, which lies along the dip's way, gives way to the point of the difference that is least along it and nearest the
 * origin: where a straight limb counts for a share, that lies between the corners that have it either way. */
static void stand_in_dip_of(search *q, const bulk *of, const bent *at, vertex p)
{
    clear(&q->s);
    share_out(of, at, &p);
    for (int r = 0; r < at->rows; r++)
        if (of->limb[at->of[r]].rows == 1) put_straight(of, at->of[r], signed_as(1, at->share[r]), &p);
    put_in(q, p);
    for (int r = 0; r < at->rows; r++) {
        vertex other = p;
        if (of->limb[at->of[r]].rows != 1) continue;
        put_straight(of, at->of[r], -signed_as(1, at->share[r]), &other);
        put_in(q, other);
    }
    project(q, 1);
}

/* From the first corner, in the spare slot, to a dip of the heights. BEYOND, STILL: apart, and told. INSIDE: they seem
 * to meet; the corner there is all of the simplex. OPEN: none was found, or nothing comes of it, and nothing is
 * changed. */
static APART enum end turn_to_dip(search *q, const shape *a, const shape *b, const goal *g)
{
    bulk *const of = &q->first_dip->bulk;
    bent *const at = &q->first_dip->at;
    vertex p = *spare(&q->s);
    raise(q, q->v, p.w);
    if (q->lower > g->beyond) {
        q->steps++;
        stand_alone(q, &p);
        return BEYOND;
    }
    const real far = length(q->v);
    if (!ROUND || g->max_steps < 2 || !(far > 0) || are_bodies_aligned(&q->d, a, b)) return OPEN;
    if (!know_first_bulk(q->first_dip, &q->d, a, b)) return OPEN;
    if (!find_least(of, mul(q->v, -1 / far), NULL, at)) return OPEN;
    q->first_dip->found = 1;
    const int deep = g->deep && at->height > 64 * q->d.doubt;
    if (!(at->height < 0) && !deep) return OPEN;
    const vec way = mul(at->n, -1);
    if (!ask(&q->d, way, &p)) return FAULT;
    q->steps += 2;
    raise(q, way, p.w);
    if (deep) stand_alone(q, &p);
    else stand_in_dip_of(q, of, at, p);
    return q->lower > g->beyond ? BEYOND : deep ? INSIDE : STILL;
}

#endif
