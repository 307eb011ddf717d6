/* SPDX-License-Identifier: MIT */
/* How deep: the least height of the difference A - B over all directions. A polytope grows within it, each time beyond
 * its lowest facet. Of the signed separation this proves
 *     from below: minus the height of the farthest corner along any direction at all,
 *     from above: minus the least height of a facet, once the surface is known to surround the origin: then any way out
 * passes through a facet, and a facet lies, along its n, no lower than its lowest corner.
 * So no facet needs a good normal or any area. */
#ifndef GJK_CORE_PENETRATION_H
#define GJK_CORE_PENETRATION_H

#include "meridian.h"
#include "heights.h"
#include "dip.h"
#include "inball.h"
#include "tight.h"

/* What the proof needs to know of some facets. */
typedef struct tally {
    int facets, proven;
    real least, certain, doubtful;
    facet *lowest; /* whose floor is that least; NULL: one that was dropped, or none */
} tally;

/* Where the heights of round sets are least nearby. */
#define MOST_DIPS 4
typedef struct dips {
    first_dip *first; /* with what heights are made of */
    dip at[MOST_DIPS + 1];
    dip *best; /* the lowest; NULL: none */
    int n;
    real tried; /* how deep it was known to be at most when one was last looked for */
    int held;   /* an ellipsoid proves something of all ways */
} dips;

typedef struct depth {
    search *q;
    const shape *a, *b;
    outline known[2]; /* these, without rounding; */
    real known_off;   /*   so far off them at most */
    const goal *g;
    polytope p;
    facet *floor;     /* the lowest facet, at the end */
    tally dropped;    /* of facets that the surface has but the polytope no longer */
    dips *dips;       /* NULL: it is not known what heights are made of, or done without; */
    const dips *seen; /*   those that there have been, all the same */
    vec along;        /* the direction asked last, of known corners to all digits, */
    real below;       /*   and the bound from below that it gave */
    real least;       /* the least height seen of A - B, by rounded numbers, */
    vec least_way;    /*   of known corners also the way along which, and the corner there */
    vec least_at;
    tip foremost; /* of corners that are not known the one along the way that is known best, if it was asked here; */
    int has_foremost;   /*   which it was */
    int closings;       /* so often the lowest facet has been as good as rounding can prove */
    outlook sight;      /* and what is looked along, */
    twin floor_there;   /*   and of the points that are known to it the lowest height */
    real near;          /* the value is in the middle between there and the bound from below */
    int rested;         /* a walk down came to where heights are the least nearby; */
    int narrowed;       /*   none did, and facets were dropped that may be as low as any */
    int settled, flush; /* the depth is known without rounding; of the cores it is 0 */
    real ends[3];       /* the bracket of the separation then, radii included, and the value */
    vec normal;         /* that goes with it */
} depth;

/* Sets what is read before it is written: to clear the rest, a kilobyte, takes longer than much of what follows. */
static void begin_depth(depth *d, search *q, const shape *a, const shape *b, const goal *g)
{
    d->q = q;
    d->a = a;
    d->b = b;
    d->g = g;
    d->known_off = 0;
    d->p = (polytope){.tips = 0};
    d->floor = NULL;
    d->dropped = (tally){.least = REAL_MAX};
    d->dips = NULL;
    d->seen = NULL;
    d->has_foremost = 0;
    d->along = d->sight.n = d->least_way = d->least_at = axis(0, 0);
    d->below = 0;
    d->least = REAL_MAX;
    d->closings = d->sight.known = d->rested = d->narrowed = d->settled = d->flush = 0;
}

static tip tip_of(const vertex *c)
{
    tip t = {c->w, axis(0, 0), c->x, c->y};
    t.low.c[0] = UNTOLD;
    return t;
}

/* The corner farthest along n; of known ones any that is about as far, true heights tell in the end. 0: a support's
 * answer was none. */
static int seek_along(depth *d, vec n, tip *t)
{
    vertex c;
    const vec v = mul(n, -1);
    difference *f = &d->q->d;
    const int plain = d->g->exact && !f->wild && f->a.asked != BY_CALL && f->b.asked != BY_CALL;
    d->q->steps++;
    if (!(plain ? ask_plainly(f, v, HASTY, &c) : ask_with(f, v, d->g->exact ? HASTY : CAREFUL, &c))) return 0;
    *t = tip_of(&c);
    if (!d->g->exact) d->least = smaller(dot(n, t->w), d->least);
    return 1;
}

static void keep_foremost(depth *d, const tip *t)
{
    d->foremost = *t;
    d->has_foremost = 1;
}

/* The same, and the bound from below that comes of it. */
static int ask_along(depth *d, vec n, tip *t)
{
    const real before = d->q->lower;
    if (!seek_along(d, n, t)) return 0;
    raise(d->q, mul(n, -1), t->w);
    if (d->q->lower > before) keep_foremost(d, t);
    return 1;
}

/* ---- heights without rounding, of known corners ---- */

/* The height of A - B along n, and the corner there: its x and y. near: one that is about as far, if any is known. */
static twin fine_height(depth *d, vec n, const tip *near, vertex *c)
{
    const difference *f = &d->q->d;
    look_along(&d->sight, f, n);
    c->x = farthest_corner(&d->sight, &f->a, d->a, of_a, near ? &near->x : NULL);
    c->y = farthest_corner(&d->sight, &f->b, d->b, of_b, near ? &near->y : NULL);
    return height_of_both(&d->sight, own_height(&d->sight, of_a, f->a.grain, c->x),
                          own_height(&d->sight, of_b, f->b.grain, c->y));
}

/* Looks along the facet's normal, at its corners first. */
static void look_at_facet(depth *d, const facet *f)
{
    twin least = {REAL_MAX, 0};
    look_along(&d->sight, &d->q->d, f->n);
    d->sight.known = 0;
    for (int k = 0; k < DIM; k++) {
        const tip *t = &d->p.tip[f->v[k]];
        const twin h = height_noted(&d->sight, &d->q->d, t->x, t->y);
        if (is_lower_twin(h, least)) least = h;
    }
    d->floor_there = least;
}

/* Whether it is known how high the facet's corners stand along the way that is looked along. */
static int is_looked_at(const depth *d, const facet *f)
{
    int r = d->sight.known == DIM;
    for (int k = 0; k < d->sight.known; k++)
        r &= same(d->sight.x[k], d->p.tip[f->v[k]].x) && same(d->sight.y[k], d->p.tip[f->v[k]].y);
    return r;
}

/* The least height of the facet's corners, along its normal, which is looked along. */
static twin floor_seen(const depth *d, const facet *f)
{
    twin least = {REAL_MAX, 0};
    if (is_looked_at(d, f)) return d->floor_there;
    for (int k = 0; k < DIM; k++) {
        const tip *t = &d->p.tip[f->v[k]];
        const twin h = height_at(&d->sight, &d->q->d, t->x, t->y);
        if (is_lower_twin(h, least)) least = h;
    }
    return least;
}

/* By how much |n| is above 1, for n that is unit to rounding. */
static real excess(vec n)
{
    twin square = {-1, 0};
    for (int i = 0; i < DIM; i++) gather(&square, product_of(n.c[i], n.c[i]));
    return (square.high + square.low) / 2;
}

/* The least height of the facet's corners along n. */
static twin fine_floor(const polytope *p, const facet *f, vec n)
{
    twin least = {REAL_MAX, 0};
    for (int k = 0; k < DIM; k++) {
        tip *t = &p->tip[f->v[k]];
        sharpen_tip(p, t);
        twin h = {0, dot(n, t->low)};
        for (int i = 0; i < DIM; i++) gather(&h, product_of(n.c[i], t->w.c[i]));
        h = sum_of(h.high, h.low);
        if (is_lower_twin(h, least)) least = h;
    }
    return sum_of(least.high, least.low - least.high * excess(n));
}

/* Places a rough facet to all digits: its normal is its own, rounded; its height is rough. */
static void polish_facet(depth *d, facet *f)
{
    const tip *t[DIM];
    for (int i = 0; i < DIM; i++) t[i] = &d->p.tip[f->v[i]];
    f->n = own_normal(&d->q->d, t);
    f->height = dot(f->n, t[0]->w);
    for (int i = 1; i < DIM; i++) f->height = smaller(dot(f->n, t[i]->w), f->height);
    f->rough = POLISHED;
}

/* The bound from below along a unit n, without the rounding of corners, and the corner there. */
static real fine_bound(depth *d, vec n, const tip *near, vertex *c)
{
    twin h = fine_height(d, n, near, c);
    d->along = n;
    d->below = -h.high - 2 * UNIT * size(h.high) - h.low - 256 * UNIT * UNIT;
    return d->below;
}

static void bound_along(depth *d, vec n)
{
    vertex c;
    real lower = same(n, d->along) ? d->below : fine_bound(d, n, NULL, &c);
    if (!(lower > d->q->lower)) return;
    d->q->lower = lower;
    d->q->normal = n;
}

/* ---- contact ---- */

/* Whether the cores, which meet, go no deeper along n than n rounds. */
static int is_flush(depth *d, vec n)
{
    if (!d->q->met || d->g->tight || !(peak(n) <= 1 + 8 * UNIT)) return 0;
    bound_along(d, n);
    return d->q->lower >= -4096 * UNIT * UNIT;
}

/* The same along the way that is known best, or off the simplex that holds the origin: away from A's position first. */
static int is_contact(depth *d)
{
    const simplex *s = &d->q->s;
    tip own[DIM];
    const tip *t[DIM];
    if (!d->q->met || !d->g->exact) return 0;
    if (d->q->lower >= -2 * d->q->d.doubt && is_flush(d, d->q->normal)) return 1;
    if (s->n != DIM) return 0;
    for (int i = 0; i < DIM; i++) {
        own[i] = tip_of(corner(s, i));
        t[i] = &own[i];
    }
    vec n = own_normal(&d->q->d, t);
    if (dot(n, d->q->d.c) < 0) n = mul(n, -1);
    return is_flush(d, n) || is_flush(d, mul(n, -1));
}

/* ---- the first surface ---- */

/* What of n is square to all of the tips so far. */
static vec square_to_tips(const polytope *p, vec n)
{
    vec e[DIM];
    for (int k = 1; k < p->tips; k++) {
        e[k] = way_to(&p->tip[0], &p->tip[k]);
        for (int j = 1; j < k; j++) e[k] = sub(e[k], mul(e[j], dot(e[k], e[j])));
        e[k] = unit_of(e[k], e[k]);
    }
    for (int twice = 0; twice < 2; twice++)
        for (int k = 1; k < p->tips; k++) n = sub(n, mul(e[k], dot(n, e[k])));
    return n;
}

/* Works out what rounding took from the tips so far. */
static void sharpen_tips(polytope *p)
{
    for (int k = 0; k < p->tips; k++) sharpen_tip(p, &p->tip[k]);
}

/* Tips that stand off each other by less are as near as rounding may decide. */
#define OFF ((real)0x1p-10)

/* Square to DIM tips, to all the digits. */
static vec fine_normal_of_tips(polytope *p)
{
    sharpen_tips(p);
#if DIM == 2
    const vec n = reach_over(&p->tip[0], &p->tip[1]);
    return (vec){{n.c[1], -n.c[0]}};
#else
    vec n;
    twin fine[3];
    fine_cross(&p->tip[0], &p->tip[1], &p->tip[2], fine);
    for (int k = 0; k < 3; k++) n.c[k] = fine[k].high;
    return n;
#endif
}

/* The same; to all the digits where they are near each other, or all but in line. */
static vec normal_of_tips(polytope *p)
{
#if DIM == 3
    const vec n = cross(way_to(&p->tip[0], &p->tip[1]), way_to(&p->tip[0], &p->tip[2]));
    if (length(n) > OFF) return n;
#endif
    return fine_normal_of_tips(p);
}

/* A unit vector square to the tips so far, near that axis. */
static vec off_tips(polytope *p, int i)
{
    if (p->tips < DIM) {
        const vec n = square_to_tips(p, axis(i, 1));
        return length(n) > (real)0.5 ? unit_of(n, n) : axis(0, 0); /* another axis is more square */
    }
    const vec n = normal_of_tips(p);
    return i == 0 ? unit_of(n, n) : axis(0, 0);
}

/* How far t lies beyond all tips along n; 0 where that is not certain. */
static real rise_over_tips(polytope *p, vec n, tip *t)
{
    real least = REAL_MAX;
    for (int k = 0; k < p->tips; k++) least = smaller(dot(n, way_to(&p->tip[k], t)), least);
    if (size(least) > CLEAR) return larger(least, 0);
    sharpen_tips(p);
    sharpen_tip(p, t);
    least = REAL_MAX;
    for (int k = 0; k < p->tips; k++) least = smaller(rise(p, k, t, n), least);
    return larger(least, 0);
}

/* The ways off the tips, up and down each axis; a zero vector where that axis is not one. */
static vec way_off(polytope *p, int i) { return mul(off_tips(p, i / 2), i & 1 ? (real)-1 : (real)1); }

/* The bound from below of a flat difference, along the ways off it: off DIM tips to all the digits. */
static void bound_flat(depth *d)
{
    polytope *p = &d->p;
    const int all = p->tips == DIM;
    const vec up = all ? fine_normal_of_tips(p) : axis(0, 0);
    for (int i = 0; i < (all ? 2 : 2 * DIM); i++) {
        const vec n = all ? mul(unit_of(up, up), i & 1 ? (real)-1 : (real)1) : way_off(p, i);
        if (peak(n) > 0) bound_along(d, n);
    }
}

/* Adds the corner farthest off the tips so far; the first that is far enough will do. STILL: there is none beyond
 * rounding, the difference is flat. CLOSE: the cores only touch. */
static enum end spread_out(depth *d)
{
    polytope *p = &d->p;
    tip best = p->tip[0];
    real most = 0;
    for (int i = 0; i < 2 * DIM && !(most > (real)0.125); i++) {
        tip t;
        vec n = way_off(p, i);
        if (!(peak(n) > 0)) continue;
        if (d->q->steps >= d->g->max_steps) return OPEN;
        if (!ask_along(d, n, &t)) return FAULT;
        if (d->g->exact && dot(n, t.w) <= 32 * UNIT && is_flush(d, n)) return CLOSE;
        real off = rise_over_tips(p, n, &t);
        if (!(off > most)) continue;
        most = off;
        best = t;
    }
    if (most > 0) {
        p->tip[p->tips++] = best;
        return OPEN;
    }
    if (d->g->exact) bound_flat(d);
    return STILL;
}

/* No corner of a full simplex is left out for standing off those before it by less than OFF. */
static int is_spread(const simplex *s)
{
    vec a = sub(point(s, 1), point(s, 0)), b = sub(point(s, 2), point(s, 0));
    real aa = dot(a, a);
#if DIM == 2
    real area = a.c[0] * b.c[1] - a.c[1] * b.c[0];
    return aa > OFF * OFF && area * area > OFF * OFF * aa;
#else
    vec n = cross(a, b);
    real nn = dot(n, n), volume = dot(n, sub(point(s, 3), point(s, 0)));
    return aa > OFF * OFF && nn > OFF * OFF * aa && volume * volume > OFF * OFF * nn;
#endif
}

/* The simplex that the search left, without the corners that stand off those before them by less than OFF. */
static void take_simplex(depth *d)
{
    polytope *p = &d->p;
    const simplex *s = &d->q->s;
    const int spread = s->n > DIM && is_spread(s);
    for (int i = 0; i < s->n; i++) {
        tip t = tip_of(corner(s, i));
        if (i > 0 && !spread && !(length(square_to_tips(p, way_to(&p->tip[0], &t))) > OFF)) continue;
        p->tip[p->tips++] = t;
    }
}

/* STILL: the difference is flat, there is no surface. CLOSE: the cores only touch, none is needed. */
static enum end first_surface(depth *d)
{
    polytope *p = &d->p;
    if (is_contact(d)) return CLOSE;
    take_simplex(d);
    while (p->tips <= DIM) {
        int before = p->tips;
        enum end end = spread_out(d);
        if (p->tips == before) return end;
    }
    put_first(p);
    return OPEN;
}

/* ---- the proof ---- */

/* Whether tips are points of the bodies in the caller's unit: none of a dip, nor those of ready-made round sets. */
static int are_placed(const depth *d) { return EXACT && (d->g->exact || (!d->dips && !d->q->d.a.in && !d->q->d.b.in)); }

/* On which side of the facet's plane the origin is: above 0, the inner; below 0, the outer, or numbers are lost. */
static int inner_side(const depth *d, const facet *f)
{
    dyadics w[DIM];
    for (int i = 0; i < DIM; i++) {
        const tip *t = &d->p.tip[f->v[i]];
        dyadics a = placed(&d->known[0], t->x), b = placed(&d->known[1], t->y);
        w[i] = difference_of(&a, &b);
    }
#if DIM == 2
    dyadic whole = minor(&w[0].c[0], &w[1].c[1], &w[0].c[1], &w[1].c[0]);
#else
    dyadics n = outer(&w[0], &w[1]);
    dyadic whole = inner(&n, &w[2]);
#endif
    return whole.lost ? -1 : whole.sign;
}

/* A lower bound of heights to twice the digits. */
static inline real below_height(twin h) { return h.high - 2 * UNIT * size(h.high) + h.low - 256 * UNIT * UNIT; }

/* A lower bound of the heights of the facet's points along its n, in the frame, without the corners' own rounding. */
static real floor_of(const depth *d, const facet *f)
{
    if (!d->g->exact) return f->height - 6 * UNIT * (size(f->height) + 2) - d->q->d.doubt;
    return below_height(same(f->n, d->sight.n) ? floor_seen(d, f) : fine_floor(&d->p, f, f->n));
}

/* Whether the two have all corners but one in common; other: which is not, of f. */
static int are_neighbours(const facet *f, const facet *g, int *other)
{
    int shared = 0;
    *other = f->v[0];
    for (int i = 0; i < DIM; i++) {
        int common = 0;
        for (int k = 0; k < DIM; k++) common |= f->v[i] == g->v[k];
        shared += common;
        if (!common) *other = f->v[i];
    }
    return shared == DIM - 1;
}

/* Whether the facet is in the lowest facet's plane for certain: it is the other half of a parallelogram. */
static int is_other_half(const depth *d, const facet *f)
{
    int fourth;
    return are_neighbours(f, d->floor, &fourth) && is_fourth(&d->p, d->floor, &d->p.tip[fourth]);
}

/* What a facet's floor is at least, seen along the lowest facet's normal; below all that counts if it is not known well
 * enough by that. Of the lowest facet's other half it is as good as along its own, which is made of other edges. */
static real floor_seen_well(const depth *d, const facet *f, real least)
{
    if (!(peak(d->sight.n) > 0) || same(f->n, d->sight.n)) return -REAL_MAX;
    real floor = below_height(floor_seen(d, f));
    int well = floor >= least || (floor > least - 4 * UNIT && d->floor && is_other_half(d, f));
    return well ? floor : -REAL_MAX;
}

/* The floor of a facet of known corners that is narrow: along its own normal, which may be noise, or a neighbour's. */
static real floor_of_narrow(const depth *d, const facet *f)
{
    real floor = floor_of(d, f);
    for (int k = 0; k < d->p.facets; k++) {
        const facet *g = &d->p.facet[k];
        int other;
        if (g->form == WIDE && are_neighbours(f, g, &other))
            floor = larger(below_height(fine_floor(&d->p, f, g->n)), floor);
    }
    return floor;
}

/* How low the facets are. */
static void count_height(const depth *d, facet *f, tally *t)
{
    t->facets++;
    if (!(f->height - 64 * UNIT - d->q->d.doubt < t->least)) return;
    real floor = floor_seen_well(d, f, t->least);
    if (!(floor > -REAL_MAX)) floor = d->g->exact && f->form != WIDE ? floor_of_narrow(d, f) : floor_of(d, f);
    if (!(floor < t->least)) return;
    t->least = floor;
    t->lowest = f;
}

/* Whether the origin is on the inner side of the facet for certain, with all that its corners may have been rounded
 * (docs/bounds.md). */
static inline int is_inner_for_certain(const polytope *p, const facet *f)
{
    if (f->form != WIDE) return 0;
    if (f->height > CLEAR) return 1;
    const vec a = way_to(&p->tip[f->v[0]], &p->tip[f->v[1]]);
#if DIM == 2
    const real edges = length(a), area = edges, slop = 64 * (1 + edges);
#else
    const vec b = way_to(&p->tip[f->v[0]], &p->tip[f->v[2]]);
    const real edges = length(a) + length(b), area = length(cross(a, b)), slop = 32 * edges * (2 + edges);
#endif
    return f->height * area > slop * UNIT;
}

/* The tip, sharp, as one point. Where that is near the origin, most of it may be what rounding took from w. */
static inline vec point_of(const tip *t) { return add(t->w, t->low); }

/* The angle under which the origin sees the facet from its inner side, at least: in space that is half its tangent's
 * arc, twice. area: of the normal as edges make it. */
static real angle_above(const polytope *p, const facet *f, real area)
{
    vec way[DIM];
    real sine = area, cosine = DIM == 2 ? 0 : 1;
    for (int i = 0; i < DIM; i++) {
        const vec w = point_of(&p->tip[f->v[i]]);
        const real far = larger(length(w), f->height);
        way[i] = mul(w, 1 / far);
        sine *= (i == 0 ? f->height : 1) / far;
    }
    for (int i = DIM == 2; i < DIM; i++) cosine += dot(way[i], way[(i + 1) % DIM]);
    return (DIM - 1) * sine / (sine + larger(cosine, 0) + 16 * UNIT + 8 * NOISE / f->height);
}

/* The same at most, of a facet of so large a normal and so long an edge, no point of which is nearer than the floor. */
static real angle_below(real normal, real long_edge, real floor)
{
    if (!(floor > 0)) return REAL_MAX;
    return normal / floor / (DIM == 2 ? 1 : larger(floor, long_edge / 8));
}

/* Counts the solid angle under which the origin sees the facet. One whose side is certain counts for more than 0; one
 * too narrow to tell counts for little, either way. */
static void count_angle(depth *d, facet *f, tally *t)
{
    polytope *p = &d->p;
    real far = 0, long_edge = 0; /* or somewhat above */
    enum form form;
    if (f->rough) sharpen_facet(p, f);
    for (int i = 0; i < DIM; i++) {
        far = larger(spread(point_of(&p->tip[f->v[i]])), far);
        long_edge = larger(spread(reach_over(&p->tip[f->v[i]], &p->tip[f->v[(i + 1) % DIM]])), long_edge);
    }
    vec n = outward(p, f, &form);
    real area = length(n), slop = 32 * UNIT * (long_edge + 8 * NOISE / UNIT) * (DIM == 2 ? 1 : long_edge) + TINY;
    if (form != THIN && area * f->height > slop * far) {
        t->certain += angle_above(p, f, area) / 2;
        return;
    }
    int side = are_placed(d) ? inner_side(d, f) : -1;
    t->proven += side > 0; /* its own normal may lead away from the origin */
    if (side < 0) t->doubtful += angle_below(spread(n) + slop, long_edge, t->least);
}

/* Whether the surface goes around the origin, if all facets are off it, on their outer side: then how often it does is
 * the sum of the solid angles under which the origin sees them, and whole. */
static int surrounds(const tally *t) { return t->certain > 2 * t->doubtful || (t->proven > 0 && t->doubtful == 0); }

/* The same of the polytope and what was dropped. At first the angles of facets that are clear to see count as no more
 * than above 0, which is all that is needed if none is in doubt. */
static int goes_around(depth *d, real least)
{
    for (int measured = 0; measured < 2; measured++) {
        tally all = d->dropped;
        all.least = least;
        for (int k = 0; k < d->p.facets; k++) {
            facet *f = &d->p.facet[k];
            if (!measured && is_inner_for_certain(&d->p, f)) all.proven++;
            else count_angle(d, f, &all);
        }
        if (surrounds(&all)) return 1;
    }
    return 0;
}

static inline int count_dips(const depth *d) { return ROUND && d->dips ? d->dips->n : 0; }

static inline dip *lowest_dip(const depth *d) { return ROUND && d->dips ? d->dips->best : NULL; }

/* Whether the dip's tip is of no account to what is to be proven: that A - B is as high as r along all ways. */
static int is_sound(const dip *f, real r) { return floor_near(f, reach_of_tip(f, r), r) >= r; }

/* Moves the dip's tip back to A - B, where it is a corner as others are. 0: facets around it have been dropped. */
static int pull_back(polytope *p, dip *f)
{
    int at = 0;
    while (at < p->tips && !same(p->tip[at].w, f->at)) at++;
    if (f->frayed || at == p->tips) return 0;
    p->tip[at].w = f->corner.w;
    p->tip[at].low.c[0] = UNTOLD;
    for (int k = 0; k < p->facets; k++)
        for (int i = 0; i < DIM; i++)
            if (p->facet[k].v[i] == at) sharpen_facet(p, &p->facet[k]);
    f->planted = 0;
    return 1;
}

/* Adds up what is known of all facets. How low they are, or the planted dips; where the tip of one of these is of
 * account to that, it is pulled back. */
static real count_surface(depth *d, tally *all)
{
    *all = d->dropped;
    all->lowest = NULL;
    if (d->floor) count_height(d, d->floor, all);
    for (int k = 0; k < d->p.facets; k++)
        if (&d->p.facet[k] != d->floor) count_height(d, &d->p.facet[k], all);
    real least = all->least;
    for (int i = 0; i < count_dips(d); i++)
        if (d->dips->at[i].planted) least = smaller(d->dips->at[i].floor, least);
    for (int i = 0; i < count_dips(d); i++)
        if (d->dips->at[i].planted && !is_sound(&d->dips->at[i], least))
            return pull_back(&d->p, &d->dips->at[i]) ? -1 : 0;
    return least;
}

/* A bracket of known corners as wide as that may be so since the lowest facet is not the one that was taken for it by
 * rounded heights. */
#define UNEVEN (4 * UNIT)

/* The facet is the lowest by heights to twice the digits: it is the floor, if its own bound from below is a better one.
 */
static void take_for_floor(depth *d, facet *f)
{
    const vec along = d->along;
    const real below = d->below, best = d->q->lower;
    if (f->rough) sharpen_facet(&d->p, f);
    bound_along(d, f->n);
    if (d->q->lower > best) {
        d->floor = f;
        return;
    }
    d->along = along;
    d->below = below;
}

/* Bounds of what is known of the separation of the cores, to rounding; with known corners to next to none. Whether the
 * surface is proven to go around the origin, where that is of account. */
static int bound(depth *d, real *upper)
{
    tally all;
    real least = -1;
    const dip *at = lowest_dip(d);
    if (at && at->everywhere) {
        *upper = smaller(*upper, -at->floor);
        return 1;
    }
    for (int i = 0; i <= count_dips(d) && least < 0; i++) least = count_surface(d, &all);
    int proven = all.facets > 0 && (d->settled || all.least > 0) && goes_around(d, all.least);
    if (proven && least > 0) *upper = smaller(*upper, -least);
    if (!d->g->exact) return proven;
    bound_along(d, d->floor ? d->floor->n : d->q->normal);
    if (proven && d->floor && all.lowest && *upper - d->q->lower > UNEVEN) take_for_floor(d, all.lowest);
    return proven;
}

/* ---- growth ---- */

/* So often one more facet is looked beyond, though no more can be proven. */
#define CLOSINGS 8

/* Counts how often that is asked. Whether the depth, which lies between the facet's height and the least height seen,
 * is known as well as rounding can tell, or it has been asked often enough. */
static int close_in(depth *d, const facet *f)
{
    return d->least - f->height <= 2 * UNIT + d->q->d.slack || d->closings++ == CLOSINGS;
}

/* With the bound from below the bracket is as narrow as asked. */
static inline int is_as_asked(const depth *d, real lower, real upper)
{
    const goal *g = d->g;
    return upper - lower <= g->abs_tol + larger(g->rel_tol, d->q->enough) * (g->radius - upper) - 32 * UNIT;
}

/* The same of the dip's, whose corner stands no farther off its way than the root of what that leaves open. */
static inline int is_as_asked_by(const depth *d, const dip *f, real upper)
{
    const real width = upper + f->height;
    return is_as_asked(d, f->below, upper) && f->aside * f->aside <= larger(width, 64 * UNIT) * f->height;
}

/* The same of the bracket that the lowest facet proves, which no dip's tip is to be of account to. */
static int is_narrow(const depth *d, const facet *f, real lower)
{
    const real doubt = d->q->d.doubt;
    /* a facet that rounding may take below the origin bounds nothing from above */
    if (!(f->height > (d->g->exact ? 0 : doubt) + 64 * UNIT) || !is_as_asked(d, lower, doubt - f->height)) return 0;
    for (int i = 0; i < count_dips(d); i++)
        if (d->dips->at[i].planted && !is_sound(&d->dips->at[i], f->height - 64 * UNIT - 2 * doubt)) return 0;
    return 1;
}

/* With what the facet's own direction proves, lower, the bracket is as narrow as asked, or as rounding allows where the
 * corners are not known without it. */
static int close_enough(depth *d, const facet *f, real lower)
{
    const real doubt = d->q->d.doubt;
    if (!d->g->exact && doubt - f->height - lower <= 3 * doubt + d->q->d.slack && close_in(d, f)) return 1;
    return is_narrow(d, f, lower);
}

/* Whether anything lies beyond the facet along its n: t, the corner there by rounded heights or, of known corners, by
 * true ones. Beyond a facet of their hull are no tips: what is seen there of these is noise, and taken in again would
 * be seen for ever. */
static int is_beyond(depth *d, facet *f, tip *t)
{
    vertex c;
    int fresh = is_clear(f, rough_rise(f, t)) || !is_tip_of(&d->p, f, t);
    if (fresh && sees(&d->p, f, t) && !is_known(&d->p, t)) return 1;
    if (!d->g->exact) return 0;
    if (f->rough == ROUGH) polish_facet(d, f);
    look_at_facet(d, f);
    fine_bound(d, f->n, t, &c);
    for (int i = 0; i < DIM; i++)
        if (same(d->p.tip[f->v[i]].x, c.x) && same(d->p.tip[f->v[i]].y, c.y)) return 0;
    c.w = corner_of(&d->q->d, c.x, c.y);
    *t = tip_of(&c);
    return sees(&d->p, f, t) && !is_known(&d->p, t);
}

/* Takes note of the bound from below that the corner t gives, the farthest along the facet's n. Whether that is close
 * enough. Of known corners all bounds from below are made anew in the end: only the lowest height is kept till then. */
static int is_bounded_by(depth *d, const facet *f, const tip *t)
{
    search *q = d->q;
    if (d->g->exact && !d->g->early) {
        const real height = dot(f->n, t->w);
        if (!(height < d->least)) return 0;
        d->least = height;
        d->least_way = f->n;
        d->least_at = t->w;
        return 0;
    }
    const real best = q->lower;
    const vec normal = q->normal;
    q->lower = -REAL_MAX;
    raise(q, mul(f->n, -1), t->w);
    if (!d->g->exact) {
        d->along = f->n;
        d->below = q->lower;
    }
    const int close = close_enough(d, f, q->lower);
    if (q->lower < best && (!close || lowest_dip(d))) { /* a facet's own normal and bound end it together, or a dip's */
        q->lower = best;
        q->normal = normal;
    } else {
        keep_foremost(d, t);
    }
    return close;
}

/* The bound from below that has been kept. */
static void raise_kept(depth *d)
{
    if (d->least < REAL_MAX) raise(d->q, mul(d->least_way, -1), d->least_at);
}

/* A facet is done, though a corner lies beyond it: */
#define WALLED_IN 2

/* That corner lies so far beyond that it is for want of what was dropped to make room, not by noise, that new facets
 * would be lower. */
static int is_walled_in(const depth *d, const facet *f, const tip *t)
{
    return !d->g->exact && d->dropped.facets > 0 && rough_rise(f, t) > CLEAR;
}

/* Takes in the corner beyond the facet, or the facet is done. CLOSE: what lies there is of no account; the bound from
 * below is the facet's own then. OPEN: there is no room. */
static enum end look_beyond(depth *d, facet *f)
{
    tip t;
    if (!seek_along(d, f->n, &t)) return FAULT;
    if (is_bounded_by(d, f, &t)) return CLOSE;
    const int beyond = is_beyond(d, f, &t);
    const enum growth grown = beyond ? grow(&d->p, f, &t) : LOWERED;
    if (grown == LOWERED) f->done = beyond && is_walled_in(d, f, &t) ? WALLED_IN : 1;
    return grown == FULL ? OPEN : STILL;
}

/* The facet is dropped, with the tip of a dip where that is. */
static void fray_dips(depth *d, const facet *f)
{
    for (int i = 0; i < count_dips(d); i++)
        for (int k = 0; k < DIM; k++) d->dips->at[i].frayed |= same(d->p.tip[f->v[k]].w, d->dips->at[i].at);
}

/* Drops the facets that are marked, once they have been counted. */
static void drop_marked(depth *d)
{
    for (int k = 0; k < d->p.facets; k++)
        if (d->p.facet[k].gone) {
            count_height(d, &d->p.facet[k], &d->dropped);
            count_angle(d, &d->p.facet[k], &d->dropped);
            fray_dips(d, &d->p.facet[k]);
        }
    sweep(&d->p);
    forget_tips(&d->p);
    d->floor = lowest(&d->p); /* facets have moved */
}

/* Drops what lies above the bound from below, which the depth does not. */
static void make_room(depth *d)
{
    raise_kept(d);
    mark_above(&d->p, -d->q->lower);
    drop_marked(d);
}

/* Drops what looks aside from the way that is known best, though the depth may lie there: the bound from above is no
 * more than what that leaves, but the one from below goes on. */
static void narrow_down(depth *d)
{
    mark_aside(&d->p, d->q->normal);
    drop_marked(d);
    d->narrowed = 1;
}

/* Nothing that was dropped so is lower than the floor. */
static int is_floor_of_all(const depth *d) { return !d->narrowed || d->floor->height <= d->dropped.least; }

/* A way back that is longer by more than this is not walked down. */
#define BEHIND ((real)1.0625)

/* So often a direction is turned on the way down. */
#define TURNS 16

/* Where facets are used up: turns the way that is known best to where the height is least nearby, by how the corners
 * there have moved sideways (Barzilai, Borwein 1988). Raises the bound from below. 0: a support's answer was none. */
static int walk_down(depth *d, vec n)
{
    search *q = d->q;
    vec turn = axis(0, 0), last = turn;
    real share = 1;
    for (int i = 0; i < TURNS && q->steps < d->g->max_steps; i++) {
        tip t;
        if (!ask_along(d, n, &t)) return 0;
        vec aside = sub(t.w, mul(n, dot(n, t.w))), moved = sub(aside, last);
        real bend = dot(turn, moved), far = length(aside);
        if (i > 0) share = bend > 0 ? dot(turn, turn) / bend : 2 * share;
        if (!(share * far * far > q->d.doubt)) {
            d->rested = 1;
            break;
        }
        vec next = sub(n, mul(aside, smaller(share, (real)0.25 / far)));
        next = mul(next, 1 / length(next));
        turn = sub(next, n);
        last = aside;
        n = next;
    }
    return 1;
}

/* Looks along the points of the facet's edges that are nearest the origin. Where heights have a crease, as where a
 * corner of one body meets a round side of the other, the least is in it: square to an edge that leads to that corner,
 * while a facet looks aside by what the round side bends within it. 0: a support's answer was none. */
static int look_along_edges(depth *d, const facet *f)
{
#if DIM == 3
    for (int i = 0; i < 3 && d->q->steps < d->g->max_steps; i++) {
        tip t;
        const vec v = nearest_of_edge(&d->p.tip[f->v[i]], &d->p.tip[f->v[(i + 1) % 3]]);
        if (dot(v, v) > 0 && length(v) <= 2 * f->height && !ask_along(d, unit_of(v, v), &t)) return 0;
    }
#endif
    (void)d, (void)f;
    return 1;
}

/* Of bodies that all but share their middles the way back is about as short, and is walked down as well. 0: a support's
 * answer was none. */
static int look_behind(depth *d)
{
    tip t;
    const vec back = mul(d->q->normal, -1);
    const real least = -d->q->lower;
    if (d->q->steps >= d->g->max_steps) return 1;
    if (!ask_along(d, back, &t)) return 0;
    return !(dot(back, t.w) <= least * BEHIND) || walk_down(d, back);
}

/* Looks for the least height near the lowest facet, where facets are used up. 0: a support's answer was none. */
static int look_lower(depth *d, const facet *f, int first)
{
    if (!look_along_edges(d, f)) return 0;
    if (!first) return 1;
    const vec best = d->q->normal;
    return walk_down(d, best) && (!d->rested || walk_down(d, f->n)) && look_behind(d);
}

/* ---- dips of round sets ---- */

/* The dip near the best direction so far. NULL: there is none. */
static bent *first_dip_of(const depth *d)
{
    first_dip *first = d->dips->first;
    if (!first->found || !same(first->at.n, d->q->normal))
        first->found = find_least(&first->bulk, d->q->normal, NULL, &first->at);
    return first->found ? &first->at : NULL;
}

/* The lowest dip near the best direction so far and the facets' normals. 0: there is none. */
static int find_lowest_dip(const depth *d, int facets, bent *best)
{
    bent b;
    const bulk *of = &d->dips->first->bulk;
    const bent *first = first_dip_of(d);
    int found = first != NULL;
    if (first) *best = *first;
    for (int k = 0; k < facets; k++) {
        if (found && height_of_bulk(of, d->p.facet[k].n) > best->height) continue;
        if (!find_least(of, d->p.facet[k].n, found ? &best->n : NULL, &b) || (found && !(b.height < best->height)))
            continue;
        *best = b;
        found = 1;
    }
    return found;
}

/* What curvature and ellipsoids prove of the ways near the dip, whose corner is h high, and of all. 0: nothing. */
static int set_floor(dip *f, const bulk *of, bent *b, real h, int told)
{
    const real room = known_room(of, b);
    f->planted = f->frayed = 0;
    f->everywhere = told;
    f->held = b->floor > CLEAR ? b->floor : -REAL_MAX;
    if (told || !(f->height > CLEAR)) {
        f->at = f->corner.w; /* never planted */
        f->far = 0;
        f->floor = f->held;
        return f->held > CLEAR;
    }
    f->held = larger(height_of_all(of, b, room, f->height, h - f->height), f->held);
    if (set_tip(f)) {
        f->everywhere = is_least_of_all(b, room, h - f->floor, f->far);
        return 1;
    }
    f->at = f->corner.w; /* never planted */
    f->far = 0;
    f->floor = f->held;
    f->everywhere = f->floor > CLEAR && h - f->floor <= ALONE_OFF && is_level_around(b);
    return f->everywhere;
}

/* So narrow a bracket leaves no more to facets: where all ways around an axis are about as short, they come to no end.
 */
static real told_width(const depth *d, const bent *b)
{
    const real usual = larger((b->level ? 64 : 4) * d->q->d.doubt, 16 * d->q->enough * b->floor);
    return b->level < 2 ? usual : larger(usual, (real)0x1p-20 * b->floor);
}

/* Whether circles have told the dip, and its bracket leaves no more to facets. Its corner may not be too far aside, nor
 * beyond the bracket. */
static int is_told_by_circles(const depth *d, const dip *f, bent *b)
{
    const real width = -f->below - b->floor, here = dot(f->n, f->corner.w);
    const int stands = f->aside * f->aside <= width * b->floor && here >= b->floor && here <= -f->below;
    if (!stands || d->q->d.lost > 0) b->floor = 0;
    return b->floor > CLEAR && width <= told_width(d, b);
}

/* Takes in what is known of A - B along b's n, where the height has a dip. -1: a support's answer was none. 0: nothing
 * is proven by it. */
static int take_dip(depth *d, bent *b, dip *f)
{
    search *q = d->q;
    const real lower = q->lower;
    const vec normal = q->normal;
    tip t;
    q->lower = -REAL_MAX;
    if (!ask_along(d, b->n, &t)) return -1;
    f->below = q->lower;
    if (!(f->below > lower)) {
        q->lower = lower;
        q->normal = normal;
    }
    const real h = dot(b->n, t.w);
    f->n = b->n;
    f->corner = (vertex){t.w, t.x, t.y};
    share_out(&d->dips->first->bulk, b, &f->corner);
    f->corner.w = corner_of(&q->d, f->corner.x, f->corner.y);
    f->aside = length(sub(f->corner.w, mul(b->n, h)));
    f->height = h - 6 * UNIT * (size(h) + 2) - q->d.doubt - b->height_off;
    f->bow = b->bow;
    f->kink = b->kink;
    f->part = b->part;
    f->rim = b->rim;
    f->rimmed = b->slants != 0;
    f->bow_off = b->bow_off;
    f->kink_off = b->kink_off;
    f->sway = b->sway;
    f->slope = slope_of(b);
    const int told = is_told_by_circles(d, f, b);
    const int known = set_floor(f, &d->dips->first->bulk, b, h, told);
    const real spare = told ? larger(4 * q->d.doubt, -f->below - f->held) : 4 * q->d.doubt;
    if (known && (f->far > 0 || f->below >= lower - spare)) return 1;
    q->lower = lower; /* no facet may be near that n, for points to go with it */
    q->normal = normal;
    return 0;
}

/* The polytope from the start again, without the tips of dips. 0: a support's answer was none. */
static int start_again(depth *d)
{
    d->p.tips = d->p.facets = 0;
    d->dropped = (tally){.least = REAL_MAX};
    d->narrowed = 0;
    d->floor = NULL;
    return first_surface(d) != FAULT;
}

/* The same for a lower dip than those before, which alone is kept. */
static int stand_lower(depth *d)
{
    dips *all = d->dips;
    all->at[0] = *all->best;
    all->best = &all->at[0];
    all->n = 1;
    return start_again(d);
}

/* The same without any. */
static int do_without_dips(depth *d)
{
    d->dips = NULL;
    return start_again(d);
}

/* Where the depth has been seen to be less than the dips say, or there are none yet, looks for one that is lower. 0: a
 * support's answer was none. */
static int seek_dip(depth *d)
{
    bent b;
    dips *all = d->dips;
    const real least = -d->q->lower;
    if (all->n == MOST_DIPS || d->q->steps >= d->g->max_steps) return 1;
    if (!(least < all->tried) || (all->best && !(least < all->best->floor - 4 * d->q->d.doubt))) return 1;
    all->tried = least;
    if (!find_lowest_dip(d, all->best || d->p.facets > DIM + 1 ? 0 : d->p.facets, &b)) return 1;
    if (all->best && !(b.height < all->best->floor)) return 1;
    const int taken = take_dip(d, &b, &all->at[all->n]);
    if (taken <= 0) return taken == 0;
    all->best = &all->at[all->n++];
    for (int i = 0; i < all->n; i++)
        if (all->at[i].planted && !is_sound(&all->at[i], all->best->floor)) return stand_lower(d);
    return 1;
}

/* Whether what is left to prove is proven: the lowest facet is as high as the dip, to rounding. */
static int is_proven(const depth *d, const facet *f)
{
    const dip *at = lowest_dip(d);
    return at && !d->narrowed && floor_of(d, f) >= at->floor - d->q->d.doubt / 2;
}

/* The same as narrowly as asked. */
static int is_proven_as_asked(const depth *d, const facet *f)
{
    const dip *at = lowest_dip(d);
    return at && !d->narrowed && is_narrow(d, f, d->q->lower) && is_as_asked_by(d, at, d->q->d.doubt - f->height);
}

/* The way out of a proven facet is asked, too, where it is another than the dip's: of two that are as short to rounding
 * either may have the tighter bracket. 0: a support's answer was none. */
static int ask_floor_beside_dip(depth *d, const facet *f)
{
    tip t;
    if (dot(f->n, d->dips->best->n) >= CLOSE_BY || d->q->steps >= d->g->max_steps) return 1;
    return d->least - f->height <= 2 * UNIT + d->q->d.slack || ask_along(d, f->n, &t);
}

/* The lowest dip, if its tip lies beyond the facet; NULL: it does not, or is planted. */
static dip *dip_beyond(depth *d, const facet *f)
{
    dip *at = lowest_dip(d);
    return at && !at->planted && dot(f->n, at->at) - f->height > CLEAR ? at : NULL;
}

/* Takes in its tip. */
static enum end plant(depth *d, facet *f, dip *at)
{
    tip t = {at->at, axis(0, 0), at->corner.x, at->corner.y};
    at->planted = 1;
    at->frayed = 0;
    return grow(&d->p, f, &t) == FULL ? OPEN : STILL;
}

/* So often facets that look aside are dropped where heights have a crease, on which no walk comes to rest. */
#define NARROWINGS 3

/* Where room is used up so often before. Once, but for creases: what dips prove is lost with facets dropped so. */
static int may_look_lower(const depth *d, int full)
{
    if (d->g->exact) return 0;
    return full == 0 || (full <= NARROWINGS && !d->rested && !lowest_dip(d));
}

/* STILL: nothing lies beyond the lowest facet. CLOSE: as tight as asked. OPEN: steps or workspace are used up. */
static enum end deepen(depth *d)
{
    for (int full = 0;;) {
        if (ROUND && d->dips && !seek_dip(d)) return FAULT;
        if (d->p.facets == 0) return OPEN;
        if (lowest_dip(d) && lowest_dip(d)->everywhere) return CLOSE;
        if (d->p.tips == d->p.most_tips) make_room(d);
        if (!d->floor || !d->floor->done) d->floor = lowest(&d->p); /* else nothing has changed */
        facet *f = d->floor;
        if (f->done) return d->narrowed || f->done == WALLED_IN ? OPEN : STILL;
        if (is_proven_as_asked(d, f)) return CLOSE;
        if (is_proven(d, f)) {
            if (!ask_floor_beside_dip(d, f)) return FAULT;
            if (goes_around(d, d->dips->best->floor)) return CLOSE;
            if (!do_without_dips(d)) return FAULT;
            continue;
        }
        if (d->q->steps >= d->g->max_steps) return OPEN;
        dip *at = dip_beyond(d, f);
        enum end end = at ? plant(d, f, at) : look_beyond(d, f);
        if (end == OPEN && may_look_lower(d, full)) {
            if (!look_lower(d, f, full == 0)) return FAULT;
            if (full++ > 0) narrow_down(d);
            continue;
        }
        if (end != STILL) return end == CLOSE && !is_floor_of_all(d) ? OPEN : end;
    }
}

#endif
