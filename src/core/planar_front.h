/* SPDX-License-Identifier: MIT */
/* Polygons of few corners in the plane: their corners, all of which are placed before the first step, side by side, so
 * that a step costs little; and what of their difference is nearest so far. An edge's direction is square to the
 * difference of its ends, which has lost nothing to where these are. */
#ifndef GJK_CORE_PLANAR_FRONT_H
#define GJK_CORE_PLANAR_FRONT_H

#include "fine.h"
#include "flat.h"
#include "thin.h"

#if DIM == 2

/* Bounds are off by so many roundings of the root of A^2 + B^2 + c^2 at most, where the bodies reach A and B from their
 * positions, c apart (docs/bounds.md). */
#define PLANAR_DOUBT (24 * UNIT)

/* By so many roundings of the edges that lead there a corner may seem to lie lower than the front, which is nearest
 * then. */
#define LEVEL UNIT

/* ---- the bodies ---- */

/* A body's corners: the list's first run and its last, which may be one, or have some corners in common; of fewer than
 * a run some stand there again and again. */
typedef struct cluster {
    real at[DIM][PLACES];  /* from the body's position, */
    real own[DIM][PLACES]; /* and in its own coordinates, times their grain */
    const real *m;         /* its map; */
    const list *from;      /* the corners as they are given, */
    list of_box;           /* and those of a box: */
    real box[RUN * DIM];
} cluster;

typedef struct scene {
    cluster a, b;
} scene;

static inline int has_few(const body *k) { return k->asked == AS_BOX || k->list.count <= PLACES; }

/* Two bodies listed that are looked at so. */
static inline int are_planar(const difference *d)
{
    return has_few(&d->a) && has_few(&d->b) && !(d->a.asked == AS_BOX && d->b.asked == AS_BOX);
}

/* Where the corners are listed. */
static inline void list_places(const body *k, cluster *p)
{
    p->from = &k->list;
    if (k->asked != AS_BOX) return;
    const real *half = ((const box *)k->data)->half;
    for (int i = 0; i < RUN; i++) {
        p->box[DIM * i] = i & 1 ? half[0] : -half[0];
        p->box[DIM * i + 1] = i & 2 ? half[1] : -half[1];
    }
    p->of_box = (list){p->box, RUN, DIM, 0, NULL};
    p->from = &p->of_box;
}

/* What places corners: the body's map of points times their grain; and what no sum of a corner's coordinates is above.
 */
typedef struct placing {
    lanes m[DIM * DIM], grain, limit;
} placing;

HOT placing placing_of(const body *k, const real *m)
{
    placing r = {.grain = in_all(k->grain), .limit = in_all(smaller(k->limit * (real)1.4143, REAL_MAX))};
    for (int i = 0; i < DIM * DIM; i++) r.m[i] = in_all(m[i]);
    return r;
}

/* A run of them. 0: one is none, or beyond the reach. */
HOT int place_run(const placing *k, int framed, const real *x, size_t step, cluster *p, size_t at)
{
    int fit = (1 << LANES) - 1;
    for (size_t j = at; j < at + RUN; j += LANES, x += LANES * step) {
        lanes c[DIM];
        load_lanes(x, step, c);
        fit &= any_as_large(k->limit, sums(sizes(c[0]), sizes(c[1])));
        for (int i = 0; i < DIM; i++) {
            if (framed) c[i] = products(c[i], k->grain);
            part_lanes(c[i], p->own[i] + j);
        }
        for (int i = 0; i < DIM; i++)
            part_lanes(sums(products(k->m[DIM * i], c[0]), products(k->m[DIM * i + 1], c[1])), p->at[i] + j);
    }
    return fit == (1 << LANES) - 1;
}

/* All of them. */
HOT int place_corners(const body *k, int framed, cluster *p)
{
    p->m = map_of(k);
    const placing to = placing_of(k, p->m);
    real run[RUN * DIM];
    const real *first = p->from->v, *last = first;
    size_t step = p->from->step;
    if (p->from->count < RUN) {
        fill_run(*p->from, run);
        first = last = run;
        step = DIM;
    } else {
        last += (p->from->count - RUN) * step;
    }
    return place_run(&to, framed, first, step, p, 0) & place_run(&to, framed, last, step, p, RUN);
}

static inline vec place_of(const cluster *p, unsigned at) { return (vec){{p->at[0][at], p->at[1][at]}}; }

static inline vec own_of(const cluster *p, unsigned at) { return (vec){{p->own[0][at], p->own[1][at]}}; }

/* As it is given: of fewer than a run, which stand there again and again, at any place, as a cache may name one where
 * there were more. */
static inline vec corner_given(const cluster *p, unsigned at)
{
    const size_t count = p->from->count;
    if (count < RUN) return nth_of(p->from, at % RUN % count);
    return nth_of(p->from, at < RUN ? at : at + count - PLACES);
}

/* Rounded heights of all of them. */
HOT void raise_placed(const cluster *p, vec v, lanes heights[PLACES / LANES])
{
    const lanes x = in_all(v.c[0]), y = in_all(v.c[1]);
    for (int i = 0; i < PLACES; i += LANES)
        heights[i / LANES] = sums(products(join_lanes(p->at[0] + i), x), products(join_lanes(p->at[1] + i), y));
}

/* The first of the corners that are highest, by rounded heights. */
HOT unsigned highest_placed(const cluster *p, vec v)
{
    lanes heights[PLACES / LANES], most;
    unsigned highest = 1u << (PLACES - 1); /* where no height is a number */
    raise_placed(p, v, heights);
    most = heights[0];
    for (int i = LANES; i < PLACES; i += LANES) most = larger_ones(most, heights[i / LANES]);
    most = largest_in_all(most);
    for (int i = 0; i < PLACES; i += LANES) highest |= (unsigned)any_as_large(heights[i / LANES], most) << i;
    return first_bit(highest);
}

/* The first of those that are lowest, which are the highest the other way. */
HOT unsigned lowest_placed(const cluster *p, vec v) { return highest_placed(p, mul(v, -1)); }

/* ---- the front ---- */

/* A corner of the difference, and where those of the bodies stand that it is made of: b's times PLACES, and a's. */
typedef struct spot {
    vec w;
    unsigned at;
} spot;

static inline unsigned in_a(const spot *p) { return p->at % PLACES; }
static inline unsigned in_b(const spot *p) { return p->at / PLACES % PLACES; }

/* What of the difference is nearest to the origin so far: nothing, a corner, or an edge. */
typedef struct front {
    spot p, q, last; /* its corners, of one both; and that asked for last, */
    vec way;         /* along this */
    int n;
    vec v;      /* the corner; or square to the edge, away from the origin */
    vec edge;   /* which this is, from p to q; of a corner 0 */
    int steps;  /* so often has been asked */
    int around; /* the corner asked for last and the edge hold the origin, */
    int ended;  /* or the walk has come to its end otherwise */
} front;

HOT spot spot_at(const difference *d, const scene *k, unsigned at)
{
    spot p = {.at = at};
    p.w = sub(place_of(&k->a, in_a(&p)), add(place_of(&k->b, in_b(&p)), d->c));
    return p;
}

/* The corner of the difference that is least along v. */
HOT void ask_ahead(const difference *d, const scene *k, front *f)
{
    f->way = f->v;
    f->steps++;
    f->last = spot_at(d, k, lowest_placed(&k->a, f->v) + PLACES * highest_placed(&k->b, f->v));
}

HOT vec way_in(const cluster *p, unsigned from, unsigned to) { return map(p->m, sub(own_of(p, to), own_of(p, from))); }

/* The corner asked for last lies lower than that, along v, by no more than edges round. */
static APART int is_level_with(const scene *k, spot last, spot p, vec v)
{
    const vec a = way_in(&k->a, in_a(&last), in_a(&p)), b = way_in(&k->b, in_b(&last), in_b(&p));
    return !(dot(v, sub(a, b)) > LEVEL * (spread(a) + spread(b)) * spread(v));
}

/* The corner asked for last lies no lower along v than the front, but for what edges round. */
HOT int is_foremost(const difference *d, const scene *k, const front *f)
{
    if (f->last.at == f->p.at || f->last.at == f->q.at) return 1;
    if (dot(f->v, sub(f->p.w, f->last.w)) > d->doubt * spread(f->v)) return 0;
    return is_level_with(k, f->last, f->p, f->v);
}

HOT void stand_on_corner(front *f, spot p)
{
    f->p = f->q = p;
    f->n = 1;
    f->v = p.w;
    f->edge = axis(0, 0);
}

HOT void stand_on_edge(const scene *k, front *f, spot p, spot q)
{
    const vec e = sub(way_in(&k->a, in_a(&p), in_a(&q)), way_in(&k->b, in_b(&p), in_b(&q)));
    const vec n = {{-e.c[1], e.c[0]}};
    f->v = dot(n, p.w) < 0 ? mul(n, -1) : n;
    f->edge = e;
    f->p = p;
    f->q = q;
    f->n = 2;
}

/* What is nearest of the corner, the one asked for last, and what is between them: how many corners are left, and
 * these. */
HOT int turn_from_corner(const front *f, spot *p, spot *q)
{
    const vec e = sub(f->last.w, f->p.w);
    *p = f->p;
    *q = f->last;
    if (dot(f->p.w, e) < 0 && dot(f->last.w, e) > 0) return 2;
    if (dot(f->p.w, e) < 0) *p = f->last;
    return 1;
}

/* The same of what the corner asked for last makes with the edge, which it lies below. 3: the triangle holds the
 * origin. */
HOT int turn_from_edge(const front *f, spot *p, spot *q)
{
    const vec w = f->last.w, left = sub(f->p.w, w), right = sub(f->q.w, w);
    const real turn = cross(left, right) < 0 ? -1 : 1;
    const int beyond_left = cross(w, left) * turn<0, beyond_right = cross(w, right) * turn> 0;
    if (!beyond_left && !beyond_right) return 3;
    *q = f->last;
    *p = f->p;
    if (beyond_left && dot(w, left) < 0) return 2;
    *p = f->q;
    if (beyond_right && dot(w, right) < 0) return 2;
    *p = f->last;
    return 1;
}

/* Takes in the corner asked for last. 0: the edge and that corner hold the origin. */
HOT int turn_front(const scene *k, front *f)
{
    spot p = f->last, q = p;
    const int n = f->n == 0 ? 1 : f->n == 1 ? turn_from_corner(f, &p, &q) : turn_from_edge(f, &p, &q);
    if (n == 2) stand_on_edge(k, f, p, q);
    else if (n == 1) stand_on_corner(f, p);
    return n < 3;
}

/* ---- what a cache holds ---- */

/* Where the front's corners stand in their lists and, where it holds the origin with these, the one asked for last. */
static inline uint32_t hint_of(const front *f)
{
    uint32_t r = f->p.at;
    if (f->n > 1) r |= f->q.at << 8;
    if (f->around) r |= f->last.at << 8 * f->n;
    return r;
}

/* For a walk from there: these corners, and where they stand, if there is a query after this. */
static void keep_front(cache *own, const search *q, const scene *k, const front *f, const shape *a, const shape *b)
{
    uint32_t hint = own->reserved = hint_of(f);
    own->count = (uint32_t)(f->n + f->around);
    for (uint32_t i = 0; i < own->count; i++, hint >>= 8) {
        const spot p = {.at = hint};
        store(own->a[i], corner_given(&k->a, in_a(&p)));
        store(own->b[i], corner_given(&k->b, in_b(&p)));
    }
    keep_whose(own, q, a, b);
}

static APART void hand_on_front(cache *own, const search *q, const scene *k, front f, const shape *a, const shape *b)
{
    keep_front(own, q, k, &f, a, b);
}

/* It holds them already, as has been seen. */
static inline int is_kept(const cache *own, const front *f)
{
    return own->count == (uint32_t)(f->n + f->around) && own->reserved == hint_of(f);
}

HOT int stands_at(const body *k, int framed, const cluster *p, unsigned at, const real *x)
{
    return same(own_of(p, at), framed ? mul(load(x), k->grain) : load(x));
}

/* From the points of the last query, if they stand where they did. 0: they do not. */
HOT int recall_front(const difference *d, const scene *k, int framed, front *f, const cache *from)
{
    uint32_t hint = from->reserved;
    for (uint32_t i = 0; i < from->count; i++, hint >>= 8) {
        const spot p = f->last = spot_at(d, k, hint % (PLACES * PLACES));
        if (!stands_at(&d->a, framed, &k->a, in_a(&p), from->a[i])) return 0;
        if (!stands_at(&d->b, framed, &k->b, in_b(&p), from->b[i])) return 0;
        if (f->n < 2 || dot(f->v, p.w) < dot(f->v, f->p.w)) turn_front(k, f);
    }
    return 1;
}

#endif

#endif
