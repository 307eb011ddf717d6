/* SPDX-License-Identifier: MIT */
/* The everyday case without detours: corners that can be listed, and a gap or an overlap that is more than rounding
 * blurs. The walk's ends are those of the search, and what it finds is told at once. Whatever is out of the ordinary is
 * left to the search, which takes over where the walk stands. The bound from below is worked out where it decides. */
#ifndef GJK_CORE_PLAIN_H
#define GJK_CORE_PLAIN_H

#include "spots.h"

/* ---- walking ---- */

/* Two corners that differ do so in w, as a rule. */
static inline int is_repeated(search *q)
{
    const vertex *last = spare(&q->s);
    for (int i = 0; i < q->s.n; i++)
        if (point(&q->s, i).c[0] == last->w.c[0]) q->repeated |= repeats(corner(&q->s, i), last);
    return q->repeated;
}

/* The corner in the spare slot is taken in. 0, and nothing changed: v comes no nearer, or the cores are nearer than
 * rounding tells. */
static inline int step_plainly(search *q)
{
    simplex *s = &q->s;
    int at[DIM + 1], n = s->n;
    memcpy(at, s->at, sizeof at);
    s->n = n + 1;
    vec v = nearest(s, q->weight);
    real vv = dot(v, v);
    q->weighed = 1;
    if (s->n > DIM) q->inside = room_inside(q);
    if (s->n > DIM ? !(q->inside > q->d.doubt) : !(vv < q->vv && vv > UNIT * UNIT / 4)) {
        memcpy(s->at, at, sizeof at);
        s->n = n;
        q->weighed = 0;
        return 0;
    }
    q->borrowed &= ~(1u << at[n]);
    q->pending = 0;
    q->v = v;
    q->vv = vv;
    return 1;
}

/* The corner in the spare slot proves the cores to be apart by more than what is asked for.
 * It rarely looks so and is not. What falls short is not kept, so that a goal out of reach changes nothing. */
static inline int is_proven_beyond(search *q, real beyond)
{
    real height = dot(q->way, spare(&q->s)->w);
    if (!(height > 0 && height * height > beyond * beyond * dot(q->way, q->way))) return 0;
    real lower = q->lower;
    vec normal = q->normal;
    raise(q, q->way, spare(&q->s)->w);
    if (q->lower > beyond) return 1;
    q->lower = lower;
    q->normal = normal;
    return 0;
}

/* The corner in the spare slot stands in the simplex already, or is no lower along v. */
static inline int is_still(search *q)
{
    if (q->s.n == 0) return 0;
    const vec w = spare(&q->s)->w;
    return is_repeated(q) || !(q->vv - dot(q->v, w) > noise_along(q->v, w));
}

/* Most of what a step costs is asking. */
static inline int is_long_way(const difference *d) { return is_long(&d->a) || is_long(&d->b); }

/* A step of an approach. 0: v would not come near by half. */
static int come_near(search *q, int max_steps)
{
    if (q->steps >= max_steps || !ask_on(&q->d, q->v, spare(&q->s))) return 0;
    q->steps++;
    q->repeated = 0;
    return !is_repeated(q) && dot(q->v, spare(&q->s)->w) < q->vv / 2 && step_plainly(q);
}

/* So few. */
#define FEW 64

/* Walks among few corners of long lists, then among more of them, while that brings v much nearer. It tells nothing of
 * the corners left out, so no bound comes of it; those taken in are good. */
static APART void approach(search *q, const goal *g)
{
    list a = q->d.a.list, b = q->d.b.list;
    size_t in_a = share_of(&q->d.a, FEW), in_b = share_of(&q->d.b, FEW);
    for (size_t n = in_a > in_b ? in_a : in_b; n > 1 && q->s.n <= DIM; n /= 4) {
        thin_out(&q->d.a, n, FEW);
        thin_out(&q->d.b, n, FEW);
        while (q->s.n <= DIM && come_near(q, g->max_steps)) continue;
        q->repeated = 0;
        q->d.a.list = a;
        q->d.b.list = b;
    }
}

/* What the walk has come to by a step; still: by one that took no corner in. */
static inline enum end end_of_step(search *q, const goal *g, int still)
{
    if (q->s.n > DIM) return INSIDE;
    return g->early && !still ? judge(q, g) : OPEN;
}

/* Walks like descend, from the corner in the spare slot, and ends as it does, but for what was stuck. A corner that was
 * sought elsewhere than along v, or in haste, and lies no lower along it, is sought along v, with care. OPEN, with
 * steps left: something is out of the ordinary with that corner, which is not taken in and not counted. */
static enum end stroll(search *q, const goal *g, int headings, int hasty)
{
    int tolerant = g->abs_tol > 0 || g->rel_tol > 0;
    int fresh = q->s.n == 0;
    int sought = g->beyond < 4; /* in the frame nothing is farther apart */
    const vec centres = first_direction(&q->d);
    q->way = q->v;
    q->rough = 0;
    if (q->s.n > DIM) return INSIDE; /* the last query's simplex */
    for (;;) {
        const vec w = spare(&q->s)->w;
        q->pending = 1;
        if (tolerant) raise(q, q->way, w);
        if (sought && is_proven_beyond(q, g->beyond)) {
            q->steps++;
            return BEYOND;
        }
        const int still = is_still(q);
        if (still && !q->rough) {
            q->steps++;
            raise(q, q->v, w);
            return g->early && judge(q, g) == WITHIN ? WITHIN : STILL; /* of a simplex lent, which nobody has judged */
        }
        if (!still && !step_plainly(q)) return OPEN;
        q->steps++;
        const enum end end = end_of_step(q, g, still);
        if (end != OPEN || q->steps >= g->max_steps) {
            raise(q, q->way, w);
            return end;
        }
        if (fresh && is_long_way(&q->d)) {
            raise(q, q->way, w);
            approach(q, g);
            if (q->s.n > DIM) return INSIDE;
            if (q->steps >= g->max_steps) return OPEN;
        }
        fresh = 0;
        if (still) q->repeated = headings = hasty = 0;
        q->way = headings-- > 0 ? heading(q, centres) : q->v;
        q->rough = hasty || !same(q->way, q->v);
        if (!ask_for(&q->d, q->way, hasty, spare(&q->s))) return FAULT;
    }
}

/* ---- telling ---- */

/* From the corner in the spare slot to the pair's, without the roundings of either. */
static inline vec way_from_last(const search *q, const spots *p, vec low)
{
    const spots c = last_spots(q);
    return add(sub(p->w, c.w), sub(low, lost_of_spots(&q->d, &q->d.maps, &c)));
}

#if DIM == 3
/* From one corner to another, by the bodies' own points: what that rounds is a share of it. */
static vec own_edge(const search *q, const vertex *from, const vertex *to)
{
    const difference *d = &q->d;
    const duos way = duos_sub(duos_at(to->x.c, to->y.c), duos_at(from->x.c, from->y.c));
    const duos at = duos_mapped(&d->maps, duos_mul(way, d->grains));
    return sub(vec_of_a(at), vec_of_b(at));
}

/* No corner is lower than the face along the way that is square to the face's own edges; v is as far off that as
 * corners round. */
static APART int is_face_lowest(search *q)
{
    const vertex *p = corner(&q->s, 0);
    const vec square = cross(own_edge(q, p, corner(&q->s, 1)), own_edge(q, p, corner(&q->s, 2)));
    const vec n = dot(square, q->v) < 0 ? mul(square, -1) : square;
    vertex low;
    if (!ask_on(&q->d, n, &low)) return 0;
    const vec way = own_edge(q, &low, p);
    return dot(n, way) < forgiven(DIM) * noise_along(n, way) || repeats(p, &low);
}
#else
#define is_face_lowest(q) 0
#endif

/* That corner looked no lower along v than the pair, but it is, without these. */
static int is_passed_over(search *q, const spots *p, vec low)
{
    const vec way = way_from_last(q, p, low);
    if (!(dot(q->v, way) > forgiven(q->s.n) * noise_along(q->v, way))) return 0;
    return q->s.n < DIM || !is_face_lowest(q);
}

/* How long w + low is, l being the length of w, to more digits than one number has: upper digits have exact squares,
 * and so are their sums. */
HOT twin length_by_digits(vec w, real l, vec low)
{
    const real far = spread(w), l_up = upper_digits(l, far), l_rest = l - l_up;
    vec up;
    EACH(up.c[i] = upper_digits(w.c[i], far));
    const vec rest = sub(w, up);
    const real square = dot(up, up) - l_up * l_up;
    const real more = 2 * (dot(up, rest) - l_up * l_rest + dot(w, low)) + (dot(rest, rest) - l_rest * l_rest);
    return (twin){l, (square + more) / (2 * l)};
}

/* What the bounds and two points, placed from the bodies' positions, tell; upper is of the cores. */
static inline void spell(const search *q, const shape *a, const shape *b, real upper, vec at_a, vec at_b, vec way,
                         result *r)
{
    bracket(r, &q->d, q->lower, upper, a, b);
    place_pair(r, q, at_a, at_b, way, a, b);
    store(r->normal, q->normal);
    r->steps = q->steps;
    r->supports = q->d.calls;
    r->reserved = 0;
}

/* The same of a pair. */
static inline void spell_spots(const search *q, const shape *a, const shape *b, real upper, const spots *p, result *r)
{
    spell(q, a, b, upper, vec_of_a(p->at), vec_of_b(p->at), p->w, r);
}

/* And how far apart they are: as the pair is, far, which lost low to rounding. */
static inline void spell_distance(const search *q, const shape *a, const shape *b, real far, real upper, const spots *p,
                                  vec low, result *r)
{
    r->value = gap_of(&q->d, length_by_digits(p->w, far, low), a, b);
    spell_spots(q, a, b, upper, p, r);
}

/* The walk came so far with a gap that rounding does not blur, and this is a pair as near as v. */
static inline int is_evident(const search *q, const goal *g, enum end end, const spots *p, real upper)
{
    real doubt = q->d.doubt, width = upper - q->lower;
    if (end == WITHIN) return upper < g->within;
    if (!(q->lower > g->radius + 32 * doubt + 16 * UNIT * g->radius)) return 0;
    if (end == CLOSE) return width <= asked_of(g, upper);
    return end == BEYOND || (end == STILL && peak(sub(p->w, q->v)) <= 8 * UNIT && width <= 4 * doubt);
}

/* The normal along the pair, where that proves as much as any: as good as the pair is, where the direction of the best
 * bound is only as good as that bound. */
static void point_along(search *q, vec way)
{
    vertex p;
    vec normal = q->normal;
    real lower = q->lower;
    q->lower = -REAL_MAX;
    if (ask_on(&q->d, way, &p)) raise(q, way, p.w);
    if (!(q->lower >= lower - 8 * UNIT * lower)) q->normal = normal;
    q->lower = lower;
}

/* The cores overlap, or the radii do; a point of both is off by no more than that. */
static void tell_overlap(search *q, const shape *a, const shape *b, enum end end, real off, result *r)
{
    const spots p = nearest_spots(q);
    real upper = end == INSIDE ? q->d.doubt - q->inside : length(p.w) * (1 + 8 * UNIT) + q->d.doubt;
    spell_spots(q, a, b, upper, &p, r);
    if (end == INSIDE && !(peak(p.w) <= off)) r->upper = 0; /* the pair is none */
}

/* The distance, where the walk has found it. 0: it is no more than rounding blurs, or the weights are not good enough.
 */
static int tell_distance(search *q, const shape *a, const shape *b, const goal *g, enum end end, result *r)
{
    if (end == OPEN || end == FAULT || (end == INSIDE && g->deep)) return 0;
    if (end == INSIDE) {
        tell_overlap(q, a, b, end, 8 * UNIT, r);
        r->value = 0;
        return r->upper < 0;
    }
    if (end == BEYOND && q->s.n == 0) step_plainly(q);
    const spots p = nearest_spots(q);
    const real far = length(p.w), upper = far * (1 + 8 * UNIT) + q->d.doubt;
    if (!is_evident(q, g, end, &p, upper)) return 0;
    know_offset(&q->d, a, b);
    vec low = lost_of_spots(&q->d, &q->d.maps, &p);
    if (end == STILL && !q->repeated && is_passed_over(q, &p, low)) return 0;
    if (end == STILL && g->deep) point_along(q, add(p.w, low));
    spell_distance(q, a, b, far, upper, &p, low, r);
    return 1;
}

/* Apart, as the corner in the spare slot proves. */
static inline void spell_apart(const search *q, const shape *a, const shape *b, result *r)
{
    const spots p = last_spots(q);
    spell_spots(q, a, b, length(p.w) * (1 + 8 * UNIT) + q->d.doubt, &p, r);
}

/* The same of a walk; v, for the next query, is made of the other corners. */
static void tell_apart(search *q, const shape *a, const shape *b, result *r)
{
    spell_apart(q, a, b, r);
    if (!(r->lower > 0) && q->s.n == 0) step_plainly(q);
    q->pending = q->s.n == 0;
}

/* Whether they meet, where the walk has found it. 0: it has not, or the weights are not good enough, or what is proven
 * does not survive the way out. */
static int tell_sign(search *q, const shape *a, const shape *b, enum end end, result *r)
{
    if (end == BEYOND) {
        tell_apart(q, a, b, r);
        return r->lower > 0;
    }
    if (end != WITHIN && end != INSIDE) return 0;
    tell_overlap(q, a, b, end, 8 * UNIT, r);
    return r->upper < 0;
}

#endif
