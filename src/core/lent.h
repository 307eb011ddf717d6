/* SPDX-License-Identifier: MIT */
/* Whether two bodies meet, by what the cache has kept of the last query, before all else. The corner along the way that
 * showed them to be apart then mostly does so still, or that along the simplex's nearest point, where the bodies stand
 * now: of this nothing is taken on trust. Or the simplex, of four points or of three and that corner, still holds the
 * origin; then its points are to be found among the corners. What is not told so is left to the walk. */
#ifndef GJK_CORE_LENT_H
#define GJK_CORE_LENT_H

#include "stride.h"

#if DIM == 3

/* The bodies, of which the cache lends points, are such that it is looked at before all else. It takes two steps. */
HOT int is_recalled(const search *q, const shape *a, const shape *b, int max_steps)
{
    return max_steps > 2 && are_for_strides(&q->d, a, b);
}

/* The simplex is of these points, where they are now, on trust; at, by slot, is where A's are placed. 0: they are
 * beyond the reaches. */
HOT int stand_on_lent(search *q, const cache *k, vec at[DIM + 1])
{
    const difference *d = &q->d;
    clear(&q->s);
    for (uint32_t i = 0; i < k->count; i++) {
        vertex *p = spare(&q->s);
        p->x = load(k->a[i]);
        p->y = load(k->b[i]);
        if (!fits(&d->a, p->x) || !fits(&d->b, p->y)) return 0;
        const duos placed = duos_mapped(&d->maps, duos_of(mul(p->x, d->a.grain), mul(p->y, d->b.grain)));
        at[i] = vec_of_a(placed);
        p->w = corner_at_spots(d, placed);
        q->s.n++;
    }
    q->borrowed = 0; /* none is kept unless it is a corner */
    return 1;
}

/* What the positions show along the line of centres, without a corner: bodies that reach A and B from these overlap by
 * no more than A + B, less by what lies between; and that is below 3/2 of the root of A^2 + B^2 + c^2. */
HOT void bound_by_reaches(search *q)
{
    const difference *d = &q->d;
    const real l = root(dot(d->c, d->c)), far = whole_of(d);
    q->lower = l - (real)1.5 * far;
    q->normal = axis(0, 1);
    if (l > UNIT * far) EACH(q->normal.c[i] = 0 + d->c.c[i] / l);
}

/* The full simplex still holds the origin. */
static int holds_still(search *q, const cache *k, const vec at[DIM + 1], const shape *a, const shape *b, result *r)
{
    tetra t = {.w = {point(&q->s, 0), point(&q->s, 1), point(&q->s, 2), point(&q->s, 3)}};
    q->inside = room_of(&t, whole_of(&q->d));
    if (!(q->inside > q->d.doubt) || !are_lent_well(&q->d, k)) return 0;
    bound_by_reaches(q);
    return tell_met(q, &t, 1, at, a, b, r);
}

/* The way, as A sees it, stands behind the points, where it is known. */
#define WAY_KNOWN 1
HOT int lends_way(const cache *k) { return k->count <= DIM && k->reserved == WAY_KNOWN; }

/* That way now, of about size 1 whatever the map's is. 0: it is none. */
HOT int recall_way(const difference *d, const cache *k, vec *way)
{
    if (!lends_way(k)) return 0;
    *way = unit_size(mapped(&d->a, load(k->a[DIM])));
    return dot(*way, *way) >= 1 && spread(*way) <= 2 * DIM;
}

/* Along which they have been shown to be apart. */
static void keep_way(cache *k, const difference *d, vec way)
{
    store(k->a[DIM], unit_size(d->a.posed ? pull(d->a.m, way) : way));
    k->reserved = WAY_KNOWN;
}

/* In a frame by the doubt of a glance; the way at first, if that has not been tried. */
static enum glanced recall(search *q, cache *k, const shape *a, const shape *b, result *r)
{
    vec at[DIM + 1];
    evidence e;
    q->lower = -4;
    q->normal = axis(0, 1);
    q->pending = q->repeated = 0;
    q->kept = 1;
    q->steps = q->lent == IN_VAIN;
    q->d.calls = 2 * q->steps;
    q->d.slack = 0;
    q->d.loose = 0;
    if (q->lent != IN_VAIN && recall_way(&q->d, k, &q->way)) {
        if (!find_corner(&q->d, 0, q->way, &q->s.slot[0], &e)) return IN_VAIN;
        if (tell_corner(q, &e, q->way, a, b, r)) return TELLING;
        q->steps++;
    }
    if (!stand_on_lent(q, k, at)) return IN_VAIN;
    if (q->s.n > DIM) return holds_still(q, k, at, a, b, r) ? TELLING : IN_VAIN;
    project(q, 1);
    q->way = q->v;
    if (!(q->vv > UNIT * UNIT / 4) || !seek_corner(q, &e, at)) return IN_VAIN;
    if (tell_corner(q, &e, q->way, a, b, r)) {
        keep_way(k, &q->d, q->way);
        return TELLING;
    }
    q->steps++;
    if (q->s.n < DIM || !are_lent_well(&q->d, k) || !tell_closed(q, &e, 1, at, a, b, r)) return IN_VAIN;
    q->kept = 0;
    return TELLING;
}

/* In the caller's lengths. UNCLEAR: the sizes are none for that. */
static APART enum glanced recall_outside(search *q, cache *k, const shape *a, const shape *b, result *r)
{
    stay_outside(&q->d, a, b);
    lay_maps(&q->d);
    know_reach_listed(&q->d.a);
    know_reach_listed(&q->d.b);
    if (!doubt_of_listed(&q->d, dot(q->d.c, q->d.c))) return UNCLEAR;
    bring_to_size(&q->d);
    return recall(q, k, a, b, r);
}

/* The same in the frame. 0: nothing has changed but what was spent. */
static APART int recall_in_frame(search *q, cache *k, const shape *a, const shape *b, result *r)
{
    const difference before = q->d;
    q->d.doubt = doubt_in_frame(&q->d);
    bring_frame_to_size(&q->d);
    lay_maps(&q->d);
    if (recall(q, k, a, b, r) == TELLING) return 1;
    const int calls = q->d.calls, steps = q->steps;
    q->d = before;
    q->d.calls = calls;
    blank(q);
    q->steps = steps;
    return 0;
}

#else
#define is_recalled(q, a, b, max_steps) 0
#endif

#endif
