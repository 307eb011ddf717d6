/* SPDX-License-Identifier: MIT */
/* The end of a polytope's growth between hulls of known corners, without rounding: planes of facets, and whether a
 * corner lies beyond one, are exact. So the depth is rounded once, at the end, and that of bodies that only touch is 0.
 */
#ifndef GJK_CORE_TIGHT_DEPTH_H
#define GJK_CORE_TIGHT_DEPTH_H

#include "penetration.h"

static void take_tips(finish *f, const depth *d, const int16_t *v, int n)
{
    f->a = d->known[0];
    f->b = d->known[1];
    f->off = d->known_off;
    f->n = f->lost = f->squared = 0;
    for (int i = 0; i < n; i++) take_in(f, d->p.tip[v[i]].x, d->p.tip[v[i]].y);
}

/* The facet's plane: way is outward, over / sqrt(under) its height. */
static void take_plane(finish *f, const depth *d, const facet *of)
{
    take_tips(f, d, of->v, DIM);
    dyadics a = difference_of(&f->w[1], &f->w[0]);
#if DIM == 2
    f->way = quarter(&a);
    reverse(&f->way);
#else
    dyadics b = difference_of(&f->w[2], &f->w[0]);
    f->way = outer(&a, &b);
#endif
    f->over = inner(&f->way, &f->w[0]);
    f->under = inner(&f->way, &f->way);
    side(f, &f->under);
    side(f, &f->over);
}

/* On which side of the facet's plane t is: 1, the outer. */
static int exact_side(const void *of, const facet *of_it, const tip *t)
{
    const depth *d = of;
    finish f;
    take_plane(&f, d, of_it);
    dyadics a = placed(&d->known[0], t->x), b = placed(&d->known[1], t->y), w = difference_of(&a, &b),
            e = difference_of(&w, &f.w[0]);
    dyadic r = inner(&f.way, &e);
    return r.sign;
}

/* The corner farthest along the way, and whether it lies beyond the first. */
static int take_step(finish *f, depth *d, tip *t)
{
    vertex c = {.x = f->x[0], .y = f->y[0]};
    dyadics back = f->way;
    reverse(&back);
    d->q->steps++;
    d->q->d.calls += 2;
    dyadic up = climb(f, &f->a, &f->way, &c.x), down = climb(f, &f->b, &back, &c.y), gain = plus(&up, &down, 1);
    c.w = corner_of(&d->q->d, c.x, c.y);
    *t = tip_of(&c);
    return side(f, &gain) > 0;
}

/* Minus the height of the plane and the radii: the bracket of the separation along the way, if nothing lies beyond. 0:
 * numbers are lost. */
static int enclose_depth(finish *f, const depth *d, real ends[3])
{
    dyadic a = dyadic_of(d->a->radius), b = dyadic_of(d->b->radius), r = plus(&a, &b, 1);
    wide sum = wide_sum(core_distance(f), wide_of(&r));
    return !f->lost && round_off((estimate){sum, sum.t.high > 0 ? -1 : 0, FORMULA_OFF, f->off}, ends);
}

/* Above the height of the plane, in the frame. */
static real height_above(const finish *f, const depth *d)
{
    wide h = core_distance(f);
    return (raised(h.t.high, h.exponent) * (1 + 64 * UNIT) + f->off) * d->q->d.scale + TINY;
}

/* The lowest of the facets, by their planes, or the first that has the origin beyond it; f, ends: its own. One that is
 * proven to be higher by rounded numbers need not be looked at, if it is turned as these say; one without area is a
 * line, which other facets have in common. NULL: numbers are lost, or one that was dropped may be lower. */
static facet *lowest_plane(finish *f, const depth *d, real ends[3])
{
    facet *best = NULL;
    real here[3], height = REAL_MAX;
    for (int k = 0; k < d->p.facets; k++) {
        facet *at = &d->p.facet[k];
        if (at->form == WIDE && floor_of(d, at) > height) continue;
        take_plane(f, d, at);
        if (f->lost) return NULL;
        if (f->over.sign < 0) return at;
        if (f->under.sign == 0) continue;
        if (!enclose_depth(f, d, here)) return NULL;
        if (best && !(here[2] > ends[2])) continue;
        memcpy(ends, here, sizeof here);
        height = height_above(f, d);
        best = at;
    }
    if (best) take_plane(f, d, best);
    return d->dropped.least > height ? best : NULL;
}

/* Grows the polytope on, from where rounding sees nothing beyond it: until the lowest plane has no corner beyond it.
 * The facet of that plane is the floor then, and ends the bracket of the separation, radii included, if the surface
 * goes around the origin: STILL. OPEN: steps or workspace are used up. FAULT: it can't be done. Each step adds a tip,
 * for which there must be room. */
static enum end grow_on(depth *d, finish *f, real ends[3])
{
    for (;;) {
        tip t;
        facet *low = lowest_plane(f, d, ends);
        d->floor = low ? low : lowest(&d->p);
        if (!low) return FAULT;
        if (d->q->steps >= d->g->max_steps) return OPEN;
        if (!take_step(f, d, &t)) break;
        if (f->lost || grow(&d->p, low, &t) != GROWN) return FAULT;
    }
    return f->lost || f->over.sign < 0 ? FAULT : STILL;
}

/* A way square to the tips, which is all that a flat difference has. */
static void take_normal(finish *f, const depth *d)
{
    static const int16_t first[3] = {0, 1, 2};
    take_tips(f, d, first, d->p.tips);
    f->way = no_way();
    f->way.c[0] = dyadic_of(1);
    if (f->n < 2) return;
    dyadics a = difference_of(&f->w[1], &f->w[0]);
#if DIM == 2
    f->way = quarter(&a);
#else
    dyadics b = no_way();
    int k = 0;
    for (int i = 1; i < 3; i++) k = side(f, &a.c[i]) == 0 ? i : k;
    b.c[k] = dyadic_of(1);
    if (f->n > 2) b = difference_of(&f->w[2], &f->w[0]);
    f->way = outer(&a, &b);
#endif
}

/* Of a difference that is flat to rounding: STILL, it is so without rounding, and the origin in it; CLOSE, it has a
 * surface now. FAULT: numbers are lost. From one tip on, as of the others some may be the same without rounding. */
static enum end span_out(depth *d, finish *f)
{
    d->p.tips = 1;
    while (d->p.tips <= DIM) {
        tip t;
        if (d->q->steps + 2 > d->g->max_steps) return OPEN;
        take_normal(f, d);
        dyadic height = inner(&f->way, &f->w[0]);
        if (!take_step(f, d, &t)) {
            reverse(&f->way);
            if (!take_step(f, d, &t)) return side(f, &height) == 0 && !f->lost ? STILL : FAULT;
        }
        if (f->lost) return FAULT;
        d->p.tip[d->p.tips++] = t;
    }
    put_first(&d->p);
    return CLOSE;
}

/* How the growth without rounding ended: settled, if it came to its end; then d->ends are the bracket of the
 * separation, radii included, if the origin is proven to be in the difference. */
static void settle_on(depth *d, finish *f, enum end grown, enum end *end)
{
    d->settled = grown == STILL;
    if (grown != FAULT) *end = grown;
    if (!d->settled) return;
    if (d->p.facets == 0) {
        f->over = nought(0);
        f->under = dyadic_of(1);
    }
    d->flush = f->over.sign == 0;
    if (d->flush) { /* that they meet may be known of others alone */
        f->off = d->known_off = larger(d->known_off, d->q->met_off * d->q->d.unscale);
        d->settled = enclose_depth(f, d, d->ends);
    }
    d->normal = rough(&f->way);
    d->normal = mul(d->normal, 1 / length(d->normal));
    if (d->floor) { /* for the points, what is level with it */
        d->floor->n = d->normal;
        d->floor->height = least_height(&d->p, d->floor, d->normal);
    }
}

/* From that tip of the polytope on, of which nothing else is left then. */
static void begin_anew(depth *d, int from)
{
    polytope *p = &d->p;
    p->tip[0] = p->tip[from];
    p->facets = 0;
    d->dropped = (tally){.least = REAL_MAX};
    d->floor = NULL;
}

/* Settles the depth from the polytope as it is, or from the tips, where these are flat to rounding; where numbers are
 * lost, that of bodies next to these. Returns how the growth ended. */
static APART enum end settle_depth(depth *d, enum end *end)
{
    finish f;
    d->p.without_rounding = 1;
    d->p.side = exact_side;
    d->p.of = d;
    enum end grown;
    for (;;) {
        grown = d->p.facets == 0 ? span_out(d, &f) : CLOSE;
        if (grown == CLOSE) grown = grow_on(d, &f, d->ends);
        if (grown != FAULT || !f.lost) break;
        if (!leave_out(&d->known[0], &d->known[1], d->q->d.unscale, &d->known_off)) break;
        begin_anew(d, 0);
    }
    settle_on(d, &f, grown, end);
    return grown;
}

/* The same from a corner on, where rounding has spoiled the polytope or filled the workspace with what it left. */
static APART enum end settle_anew(depth *d, enum end *end)
{
    begin_anew(d, d->floor->v[0]);
    return settle_depth(d, end);
}

#endif
