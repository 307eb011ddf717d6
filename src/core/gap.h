/* SPDX-License-Identifier: MIT */
/* Two boxes: how far apart. The nearest points are looked for by turns, in one box and in the other; what they lie on,
 * faces, edges or corners, says along which way they are nearest. Nothing of this is taken on trust: the corner asked
 * for along that way proves it (docs/bounds.md). What it does not prove is left to the walk. */
#ifndef GJK_CORE_GAP_H
#define GJK_CORE_GAP_H

#include "axes.h"

/* So often each box has its turn. From the middle of b all that ends on a face or a corner is found in three, or else
 * slides along two edges. */
#define BY_TURNS 3

/* Along which of its axes the point is not at the box's side. */
static inline unsigned free_axes(vec x, vec e)
{
    unsigned r = 0;
    EACH(r |= (unsigned)(size(x.c[i]) < e.c[i]) << i);
    return r;
}

/* The only axis that is in it, or that is not; -1: it is none such. */
static inline int only_axis(unsigned axes)
{
    static const signed char only[8] = {-1, 0, 1, -1, 2, -1, -1, -1};
    return only[axes];
}

static inline int face_at(unsigned axes) { return only_axis(~axes & ((1u << DIM) - 1)); }

/* The points may slide along an edge of one box and a face of the other, say: these are not known to be parallel. */
static inline int may_slide(unsigned free_a, unsigned free_b)
{
    return free_a && free_b && (DIM == 2 || !(only_axis(free_a) >= 0 && only_axis(free_b) >= 0));
}

/* Points of the boxes, lengths along their axes, times their grain. */
static inline void scale_points(const gauge *k, vec *x, vec *y)
{
    EACH(x->c[i] *= k->unit[0].c[i]; y->c[i] *= k->unit[1].c[i]);
}

/* The way between the points, to rounding. */
static inline vec way_at(const difference *d, const gauge *k, vec x, vec y)
{
    scale_points(k, &x, &y);
    return corner_at(d, x, y);
}

#if DIM == 3
/* What the way between two points gains where both go along their edges, as if these were parallel. It has all digits
 * that the edges have. */
static inline vec spread_of_edges(vec u, vec v) { return dot(u, v) < 0 ? add(u, v) : sub(u, v); }

/* Square to two edges; to one of them, that is as near to w as any. */
static inline vec square_to_edges(vec u, vec v) { return cross(u, spread_of_edges(u, v)); }

static inline vec square_to_edge(vec u, vec w) { return sub(w, mul(u, dot(w, u))); }

/* How far along all but parallel edges x is to go, and y beside it, until nothing of the way between them is along what
 * the edges spread by. What is less than two roundings of the frame is left. */
static real slide_along(const difference *d, const gauge *k, int of_a, int of_b, vec x, vec y)
{
    const vec u = k->u[of_a], e = square_to_edge(u, spread_of_edges(u, k->u[DIM + of_b]));
    const real along = dot(way_at(d, k, x, y), e), ee = dot(e, e);
    return along * along > 4 * UNIT * UNIT * ee ? -along / ee : 0;
}

/* Of the lines along an axis of each box, through x and through y, the points nearest to each other, as far as they are
 * in the boxes. */
static void meet_on_edges(const difference *d, const gauge *k, int of_a, int of_b, vec *x, vec *y)
{
    const real rr = k->r[of_a].c[of_b];
    if (1 - rr * rr > PARALLEL) {
        x->c[of_a] = y->c[of_b] = 0;
        x->c[of_a] = (seen_from_a(k, *y).c[of_a] + rr * seen_from_b(k, *x).c[of_b]) / (1 - rr * rr);
    } else {
        x->c[of_a] += slide_along(d, k, of_a, of_b, *x, *y);
    }
    *x = clamped(*x, k->e);
    y->c[of_b] = seen_from_b(k, *x).c[of_b];
    if (size(y->c[of_b]) < k->f.c[of_b]) return; /* and x, if at its edge's end, to the last digit */
    *y = clamped(*y, k->f);
    x->c[of_a] = seen_from_a(k, *y).c[of_a];
    *x = clamped(*x, k->e);
}
#endif

/* Points x of a and y of b, lengths along their axes, as near to each other as turns bring them: from what is foremost
 * along an axis with a gap. */
static inline void start_at_face(const gauge *k, int at, vec *x, vec *y)
{
    if (at < DIM) *y = foremost_of_b(k, at);
    else *y = clamped(seen_from_b(k, foremost_of_a(k, at - DIM)), k->f);
    for (int i = 0; i < BY_TURNS; i++) {
        *x = clamped(seen_from_a(k, *y), k->e);
        *y = clamped(seen_from_b(k, *x), k->f);
    }
    *x = clamped(seen_from_a(k, *y), k->e);
}

#if DIM == 3
/* The same from the edges across which there is the widest gap. 0: there is none that wide. */
static int start_at_edges(const gauge *k, real least, vec *x, vec *y)
{
    real across[9], widest = least * least;
    int at = -1;
    for (int i = 0; i < 3; i++) reach_across(k, i, across + 3 * i);
    for (int i = 0; i < 9; i++) {
        const real gap = larger(-across[i], 0), ll = square_across(k, i / 3, i % 3);
        if (!(gap * gap > widest * ll) || !(ll > PARALLEL)) continue;
        widest = gap * gap / ll;
        at = i;
    }
    if (at < 0) return 0;
    *x = nearest_on_edge_of_a(k, at / 3, at % 3);
    *y = clamped(seen_from_b(k, *x), k->f);
    *x = clamped(seen_from_a(k, *y), k->e);
    return 1;
}
#endif

/* The nearest points, where the least of the heights along the axes is at. 0: there is no gap wider than least. */
static inline int find_nearest(const difference *d, const gauge *k, int at, real height, real least, vec *x, vec *y)
{
    const int faced = height < -least;
    if (faced) start_at_face(k, at, x, y);
#if DIM == 3
    if (!faced || may_slide(free_axes(*x, k->e), free_axes(*y, k->f))) {
        if (!start_at_edges(k, least, x, y) && !faced) return 0;
    }
    const int of_a = only_axis(free_axes(*x, k->e)), of_b = only_axis(free_axes(*y, k->f));
    if (of_a >= 0 && of_b >= 0) meet_on_edges(d, k, of_a, of_b, x, y);
    return 1;
#else
    (void)d;
    return faced;
#endif
}

/* Square to all of a box's axes but one, to a few roundings, however square they are to each other. */
static inline vec normal_of(const vec *u, int but)
{
#if DIM == 2
    return (vec){{-u[1 - but].c[1], u[1 - but].c[0]}};
#else
    return cross(u[next_axis[but + 1]], u[next_axis[but + 2]]);
#endif
}

/* The way from y to x, which is w to rounding, without that: square to the face or the edges that they lie on. */
static vec way_between(const gauge *k, vec w, unsigned free_a, unsigned free_b)
{
    const vec *u = k->u, *v = k->u + DIM;
    const int face_a = face_at(free_a), face_b = face_at(free_b);
    vec l = w;
    if (face_a >= 0) l = normal_of(u, face_a);
    else if (face_b >= 0) l = normal_of(v, face_b);
#if DIM == 3
    else {
        const int of_a = only_axis(free_a), of_b = only_axis(free_b);
        if (of_a >= 0 && of_b >= 0) l = square_to_edges(u[of_a], v[of_b]);
        else if (of_a >= 0) l = square_to_edge(u[of_a], w);
        else if (of_b >= 0) l = square_to_edge(v[of_b], w);
    }
#endif
    return dot(l, w) < 0 ? mul(l, -1) : l;
}

/* The corner in the spare slot lies on the same faces of the box as the point x, a length along its axes, which is free
 * along these. */
static inline int is_beside(const body *k, vec corner, vec x, unsigned free)
{
    const box *of = k->data;
    int r = 1;
    EACH(r &= (free >> i & 1) || of->half[i] == 0 || (corner.c[i] > 0) == (x.c[i] > 0));
    return r;
}

/* The corner in the spare slot, sought along l, lies lower than the pair of points by more than the roundings of
 * either. */
static int is_beneath(const search *q, vec l, const spots *p, vec low)
{
    return dot(l, way_from_last(q, p, low)) > UNIT * spread(l);
}

/* What is seen between x and y: the pair, the way without rounding, and along which axes the points are free. */
typedef struct prospect {
    spots p;
    vec l;
    unsigned free_a, free_b;
} prospect;

/* A point on the box's sides, x times its grain, is on them to the last digit. */
static vec put_on_sides(const body *k, vec x, unsigned free)
{
    const box *of = k->data;
    EACH(if (!(free >> i & 1)) x.c[i] = signed_as(of->half[i] * k->grain, x.c[i]));
    return x;
}

/* The way w between the points is that of l, but for a rounding of the frame. */
static inline int is_along(vec l, vec w) { return length(w) - dot(l, w) / length(l) <= UNIT; }

/* 0: the way without rounding is none between these points. */
static inline int look_between(const difference *d, const gauge *k, vec x, vec y, prospect *s)
{
    s->free_a = free_axes(x, k->e);
    s->free_b = free_axes(y, k->f);
    scale_points(k, &x, &y);
    if (k->brought) {
        x = put_on_sides(&d->a, x, s->free_a);
        y = put_on_sides(&d->b, y, s->free_b);
    }
    s->p = spots_at(d, &d->maps, duos_of(x, y));
    s->l = way_between(k, s->p.w, s->free_a, s->free_b);
    return is_along(s->l, s->p.w);
}

/* What of the way w between the points is not square to the faces or edges that they lie on is taken back, where that
 * is more than rounding: a box's axes are not quite square to each other. */
static void square_up(const gauge *k, vec w, vec *x, vec *y)
{
    const unsigned free_a = free_axes(*x, k->e), free_b = free_axes(*y, k->f);
    const int of_a = only_axis(free_a), of_b = only_axis(free_b);
    if (DIM == 3 && of_a >= 0 && of_b >= 0) {
        const vec u = k->u[of_a], v = k->u[DIM + of_b];
        const real rr = dot(u, v), on = (rr * dot(v, w) - dot(u, w)) / (1 - rr * rr);
        x->c[of_a] += on;
        y->c[of_b] += rr * on + dot(v, w);
    } else {
        for (int i = 0; i < DIM; i++) {
            const vec u = k->u[free_a ? i : DIM + i];
            const real back = (free_a ? free_a : free_b) >> i & 1 ? dot(u, w) : 0;
            if (free_a) x->c[i] -= back;
            else y->c[i] += back;
            w = sub(w, mul(u, back));
        }
    }
    *x = clamped(*x, k->e);
    *y = clamped(*y, k->f);
}

/* Nothing is nearer along l than the points x and y, as the corner in the spare slot shows: it is beside them, where l
 * is square to all that they lie on, or no lower. */
static inline int are_nearest(search *q, vec x, vec y, const prospect *s, vec low)
{
    const vertex *last = spare(&q->s);
    if (!may_slide(s->free_a, s->free_b) && is_beside(&q->d.a, last->x, x, s->free_a) &&
        is_beside(&q->d.b, last->y, y, s->free_b))
        return 1;
    return !is_beneath(q, s->l, &s->p, low);
}

/* That they are as far apart as these points. 0: that is not proven, or as near to contact as rounding blurs; then the
 * walk starts from the corner along l. */
static int tell_nearest(search *q, const gauge *k, vec x, vec y, const shape *a, const shape *b, const goal *g,
                        result *r)
{
    difference *d = &q->d;
    vertex *last = spare(&q->s);
    const int steps = q->steps + q->pending;
    prospect s;
    if (k->brought) square_up(k, way_at(d, k, x, y), &x, &y);
    if (!look_between(d, k, x, y, &s)) {
        square_up(k, s.p.w, &x, &y);
        if (!look_between(d, k, x, y, &s)) return 0;
    }
    const real far = length(s.p.w), upper = far * (1 + 8 * UNIT) + d->doubt;
    if (!(peak(s.l) > 0) || steps >= g->max_steps || !ask_on(d, s.l, last)) return 0;
    q->v = s.l;
    q->steps = steps;
    q->pending = 1;
    raise(q, s.l, last->w);
    if (!(q->lower > g->radius + 32 * d->doubt + 16 * UNIT * g->radius) || !(upper - q->lower <= 4 * d->doubt))
        return 0;
    know_offset(d, a, b);
    const vec low = lost_of_spots(d, &d->maps, &s.p);
    if (!are_nearest(q, x, y, &s, low)) return 0;
    spell_distance(q, a, b, far, upper, &s.p, low, r);
    r->steps = q->steps + 1;
    return 1;
}

/* What tell_inside finds across the axes, so that the same is left to the walk where it is asked how deep they are. */
static inline void look_for_gap_across(const search *q, const gauge *k, const shape *a, const shape *b, vec *way)
{
    *way = axis(0, 0);
#if DIM == 3
    real across[9];
    (void)find_gap_across(q, k, a, b, across, way);
#else
    (void)q, (void)k, (void)a, (void)b;
#endif
}

/* How far apart two boxes are; or that they meet, if it is not asked how deep. 0: it is left to the walk. */
static APART int tell_gap(search *q, const shape *a, const shape *b, const goal *g, result *r)
{
    gauge k;
    vec x, y;
    vec way;
    real h[AXES];
    if (!take_gauge_in_frame(&k, &q->d, LENGTH_OFF)) return 0;
    for (int i = 0; i < DIM; i++) h[i] = reach_along_a(&k, i);
    for (int i = 0; i < DIM; i++) h[DIM + i] = reach_along_b(&k, i);
    const int least = least_of(h, AXES);
    if (!(h[least] < -q->d.doubt)) {
        if (g->deep) look_for_gap_across(q, &k, a, b, &way);
        else if (tell_inside(q, &k, h, &way, a, b, r)) return 1;
        if (!(peak(way) > 0)) return 0;
    }
    const real blurred = 32 * q->d.doubt + (1 + 16 * UNIT) * g->radius; /* as tell_nearest has it */
    return find_nearest(&q->d, &k, least, h[least], blurred, &x, &y) && tell_nearest(q, &k, x, y, a, b, g, r);
}

#endif
