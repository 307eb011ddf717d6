/* SPDX-License-Identifier: MIT */
/* Where shapes that overlap touch: the normal, and a pair of points that goes with it. And how deep, all in all. */
#ifndef GJK_CORE_CONTACT_H
#define GJK_CORE_CONTACT_H

#include "tight_depth.h"

/* ---- cores that are apart, and only the radii overlap ---- */

/* A blend of the corners' x or y, times their grain, to twice the digits: one of them, and shares of the ways from
 * there. */
static vec exact_blend(const simplex *s, const real weight[DIM + 1], int from, size_t member, real grain, vec *low)
{
    vec at = mul(member_of(corner(s, from), member), grain), r;
    for (int i = 0; i < DIM; i++) {
        twin t = {at.c[i], 0};
        for (int k = 0; k < s->n; k++) {
            if (k == from) continue;
            gather(&t, product_of(weight[k], member_of(corner(s, k), member).c[i] * grain));
            gather(&t, product_of(-weight[k], at.c[i]));
        }
        t = sum_of(t.high, t.low);
        r.c[i] = t.high;
        low->c[i] = t.low;
    }
    return r;
}

/* Above the length of v, which is given to twice the digits. */
static real length_above(vec v, vec v_low)
{
    twin square = {0, 0};
    for (int i = 0; i < DIM; i++) {
        twin c = sum_of(v.c[i], v_low.c[i]);
        gather(&square, product_of_twins(c, c));
    }
    square = sum_of(square.high, square.low);
    return square.high > UNIT * UNIT ? root_of(square).high * (1 + 2 * UNIT) : length(add(v, v_low)) * (1 + 8 * UNIT);
}

/* The one corner of A - B that the weights single out, to twice the digits. It is in A - B: the shares of the others
 * add up to no more than 3/4, as none is above that of the corner they start from. */
static vec fine_pair(const search *q, const real weight[DIM + 1], vec *low)
{
    int from = 0;
    for (int k = 1; k < q->s.n; k++) from = weight[k] > weight[from] ? k : from;
    vec x_low, x = exact_blend(&q->s, weight, from, offsetof(vertex, x), q->d.a.grain, &x_low);
    vec y_low, y = exact_blend(&q->s, weight, from, offsetof(vertex, y), q->d.b.grain, &y_low);
    vec high = blend(&q->s, weight, offsetof(vertex, w), 1);
    *low = remainder_of(&q->d, x, x_low, y, y_low, high);
    return high;
}

/* A bound from above: that corner's length. */
static real fine_length(vec high, vec low) { return length_above(high, low) + 256 * UNIT * UNIT; }

/* Bounds of cores that are apart, from both sides: for shapes whose radii overlap. */
static void bound_apart(search *q, const shape *a, const shape *b, const goal *g, const real weight[DIM + 1],
                        real *upper)
{
    depth d;
    vec low, high = fine_pair(q, weight, &low);
    begin_depth(&d, q, a, b, g);
    *upper = smaller(*upper, fine_length(high, low));
    bound_along(&d, q->normal);
}

/* The normal along the closest pair of cores that are apart and known by their corners: as good as the pair is, where
 * the direction of the best bound is only as good as that bound. Left as it is where it proves less. */
static void point_along_pair(search *q, const shape *a, const shape *b, const goal *g, const real weight[DIM + 1])
{
    depth d;
    vec low, high = single_out(q, weight, &low), v = square_to(&q->s, add(high, low)), normal = q->normal;
    real lower = q->lower;
    begin_depth(&d, q, a, b, g);
    if (!(length(v) > 0)) return;
    q->lower = -REAL_MAX;
    bound_along(&d, mul(v, -1 / length(v)));
    if (!(q->lower >= lower - 8 * UNIT * lower)) q->normal = normal;
    q->lower = lower;
}

/* ---- cores that meet ---- */

/* Of the body's corners that are as far along n as any, to rounding, the one farthest along aside. */
static vec corner_aside(const body *k, const shape *s, vec n, vec aside)
{
    vec best = axis(0, 0), up = k->posed ? pull(k->m, n) : n, out = k->posed ? pull(k->m, aside) : aside;
    if (is_box(s)) { /* axis by axis */
        best = mul(corner_of_box(s->data, up), k->grain);
        EACH(up.c[i] = size(up.c[i] * best.c[i]) > 8 * UNIT ? up.c[i] : out.c[i]);
        return corner_of_box(s->data, up);
    }
    real top = -REAL_MAX, most = -REAL_MAX;
    const list l = corners_of(s);
    for (size_t i = 0; i < l.count; i++) top = larger(dot(mul(nth_of(&l, i), k->grain), up), top);
    for (size_t i = 0; i < l.count; i++) {
        vec c = mul(nth_of(&l, i), k->grain);
        if (!(dot(c, up) >= top - 16 * UNIT) || !(dot(c, out) > most)) continue;
        most = dot(c, out);
        best = nth_of(&l, i);
    }
    return best;
}

/* In the lowest facet's plane, as far as rounding can tell. */
static int is_level(const depth *d, const tip *t) { return size(rough_rise(d->floor, t)) <= 32 * UNIT; }

/* Of what is level the corner least along v: of all known corners, else of the tips. */
static tip level_tip(const depth *d, vec v)
{
    tip best = d->p.tip[d->floor->v[0]];
    if (d->g->exact) {
        vertex c;
        c.x = corner_aside(&d->q->d.a, d->a, d->floor->n, mul(v, -1));
        c.y = corner_aside(&d->q->d.b, d->b, mul(d->floor->n, -1), v);
        c.w = corner_of(&d->q->d, c.x, c.y);
        return tip_of(&c);
    }
    for (int k = 0; k < d->p.tips; k++)
        if (is_level(d, &d->p.tip[k]) && dot(v, d->p.tip[k].w) < dot(v, best.w)) best = d->p.tip[k];
    return best;
}

/* Where the lowest facet's plane is nearest the origin. */
static vec foot_of(const depth *d) { return mul(d->floor->n, d->floor->height); }

static void take_tip(simplex *s, const tip *t, vec foot)
{
    vertex *c = spare(s);
    c->w = sub(t->w, foot);
    c->x = t->x;
    c->y = t->y;
    s->n++;
}

static void start_over(search *q)
{
    clear(&q->s);
    q->pending = 0;
    q->borrowed = 0;
}

/* The lowest point of the surface as a blend of tips: the foot. A face of more than DIM corners is several facets, so
 * that point is sought among all that is level, as the origin is in a search. Returns how far beside it lies. */
static real hand_over(const depth *d, real weight[DIM + 1])
{
    search *q = d->q;
    vec foot = foot_of(d), v;
    simplex *s = &q->s;
    start_over(q);
    for (int i = 0; i < DIM; i++) take_tip(s, &d->p.tip[d->floor->v[i]], foot);
    int under = part(s, (1u << DIM) - 1, 0, &v, weight);
    if (!under) v = nearest_of_all(s, 0, 0, 0);
    for (int i = 0; i < USUAL_TIPS && dot(v, v) > (under ? 16 : (real)0.25) * (UNIT * UNIT); i++) {
        tip t = level_tip(d, v);
        simplex before = *s;
        real own[DIM + 1];
        if (!is_level(d, &t) || !(dot(v, sub(t.w, foot)) < dot(v, v))) break;
        take_tip(s, &t, foot);
        vec better = s->n <= DIM ? nearest(s, own) : nearest_of_all(s, 0, 0, 0);
        if (!(dot(better, better) < dot(v, v))) {
            *s = before;
            break;
        }
        v = better;
        under = 0;
    }
    q->v = v;
    if (under) normalize(weight, DIM);
    if (under && peak(sub(blend(s, weight, offsetof(vertex, w), 1), v)) <= 4 * UNIT) return length(v);
    return certify(q, weight) - q->d.doubt;
}

/* The same as a blend of one facet's tips. */
static real hand_over_from(const depth *d, const facet *f, real weight[DIM + 1])
{
    start_over(d->q);
    for (int i = 0; i < DIM; i++) take_tip(&d->q->s, &d->p.tip[f->v[i]], foot_of(d));
    d->q->v = nearest_of_all(&d->q->s, 0, 1, 0);
    return certify(d->q, weight) - d->q->d.doubt;
}

/* The foot may lie beside the lowest facet, on one that is no higher to within some roundings, though its other tips
 * are lower than level: it is in the polytope, since no facet is nearer the origin. */
static void hand_over_from_any(const depth *d, real off, real weight[DIM + 1])
{
    const facet *best = NULL;
    for (int k = 0; k < d->p.facets; k++) {
        real here = hand_over_from(d, &d->p.facet[k], weight);
        if (!(here < off)) continue;
        off = here;
        best = &d->p.facet[k];
    }
    if (best) hand_over_from(d, best, weight);
    else hand_over(d, weight);
}

/* The facet's normal, where that says as much as any direction asked: of several that are equal, one for normal and
 * points alike. Of unknown corners the facet was the last to be asked. */
static int takes_normal(depth *d, const facet *f)
{
    search *q = d->q;
    vec normal = q->normal;
    real best = q->lower;
    const int asked = d->g->exact || same(d->along, f->n); /* where a dip ended it the facet was not, nor may any */
    q->lower = asked ? d->below : best;
    if (d->g->exact) {
        q->lower = -REAL_MAX;
        bound_along(d, f->n);
    }
    const int as_good = asked && q->lower >= best - 2 * UNIT;
    q->normal = as_good ? f->n : normal;
    q->lower = larger(q->lower, best);
    return as_good;
}

/* Where the lowest facet is not the one for the normal, the points go with a facet that faces the same way. */
static void turn_to_normal(depth *d)
{
    for (int k = 0; k < d->p.facets; k++) {
        facet *f = &d->p.facet[k];
        if (dot(f->n, d->q->normal) > dot(d->floor->n, d->q->normal)) d->floor = f;
    }
}

/* Of some that are equally low to rounding, one is the lowest in truth, and that one is right under the origin: it is
 * sought among those whose normal is as good as any, and normal and points go with it. Beside the floor's foot the
 * points lie by off. */
static void stand_under(depth *d, real off, real weight[DIM + 1])
{
    search *q = d->q;
    facet *best = d->floor;
    vec normal = q->normal;
    real bound = q->lower;
    for (int k = 0; k < d->p.facets; k++) {
        facet *f = &d->p.facet[k];
        if (f == best || !(f->height <= best->height + 64 * UNIT)) continue;
        if (f->rough) sharpen_facet(&d->p, f);
        if (!takes_normal(d, f)) continue;
        d->floor = f;
        const real here = hand_over(d, weight);
        if (!(here < off) && q->lower <= bound + 4 * UNIT) continue;
        off = here;
        best = f;
        normal = f->n;
        bound = q->lower;
    }
    d->floor = best;
    q->normal = normal;
    off = hand_over(d, weight);
    if (off > 4 * UNIT) hand_over_from_any(d, off, weight);
}

/* Normal and points go with the lowest facet, if its normal is as good as any. */
static void point_out(depth *d, real weight[DIM + 1])
{
    if (!takes_normal(d, d->floor)) turn_to_normal(d);
    const real off = hand_over(d, weight);
    if (!(off > 4 * UNIT)) return;
    if (d->g->exact) stand_under(d, off, weight);
    else hand_over_from_any(d, off, weight);
}

/* The bound from below that the dip gave is the best one, to a few roundings. */
static inline int bounds_as_well(const search *q, const dip *f) { return f->below >= q->lower - 8 * UNIT; }

/* Its way is the direction that gave the best one, to what rounding hides. */
static inline int leads_as_well(const search *q, const dip *f)
{
    return length(sub(f->n, q->normal)) <= 4 * q->d.doubt;
}

static inline int goes_with_bound(const search *q, const dip *f) { return bounds_as_well(q, f) || leads_as_well(q, f); }

/* The dip that normal and points go with: the lowest, if that is as low as any direction asked; of some that are
 * equally low, to what rounding hides, the one near the direction that has given the best bound. NULL: none. FAULT, and
 * nothing else: a support's answer was none. */
static const dip *dip_to_stand_in(depth *d, dip *other, enum end *end)
{
    bent b;
    const dip *f = lowest_dip(d);
    search *q = d->q;
    if (!f || !(f->below >= q->lower - 4 * q->d.doubt)) return NULL;
    if (goes_with_bound(q, f)) return f;
    if (q->steps >= d->g->max_steps || !find_least(&d->dips->first->bulk, q->normal, NULL, &b)) return NULL;
    const int taken = take_dip(d, &b, other);
    if (taken < 0) *end = FAULT;
    return taken > 0 && goes_with_bound(q, other) ? other : NULL;
}

/* The dip near the one known best, or on the other side, that may be the least everywhere as it is curved. 0: there is
 * none. */
static int find_curved_dip(const depth *d, bent *b)
{
    const bulk *of = &d->dips->first->bulk;
    bent *first = first_dip_of(d);
    if (first && known_room(of, first) > 0) {
        *b = *first;
        return 1;
    }
    return are_ellipsoids(of) && find_least(of, mul(d->q->normal, -1), NULL, b) &&
           (known_room(of, b) > 0 || is_centred(of, b->height));
}

#if DIM == 3
static inline int find_dip_by_circles(const depth *d, bent *b)
{
    return find_least_of_all(&d->dips->first->bulk, first_dip_of(d), b);
}
#else
#define find_dip_by_circles(d, b) 0
#endif

/* The depth by that dip alone. 0: it does not tell it. -1: a support's answer was none. */
static int fathom_by(depth *d, dips *all, bent *b, real *upper, int last)
{
    dip *f = &all->at[last ? MOST_DIPS : 0];
    search *q = d->q;
    const real lower = q->lower;
    const vec normal = q->normal;
    const int taken = take_dip(d, b, f), bounded = taken >= 0 && f->held > CLEAR; /* of all ways */
    const int told = taken > 0 && f->everywhere;
    if (taken < 0) return -1;
    if (bounded && !told) {
        all->held = 1;
        f->everywhere = last || is_as_asked_by(d, f, -f->held);
        if (taken && (f->everywhere || !(b->floor > 0))) /* else points would not go with it */
            *upper = smaller(*upper, -f->held);
        if (f->everywhere) {
            f->floor = f->held;
            f->far = 0;
        }
    }
    if (bounded && f->everywhere && f->below > q->lower) {
        q->lower = f->below;
        q->normal = f->n;
    }
    if (bounded && (told || b->level) && f->everywhere &&
        f->below >= q->lower - larger(2 * q->d.doubt, -f->held - f->below)) {
        q->lower = f->below; /* another way is as good, as far as can be told: normal and points go with this */
        q->normal = f->n;
    }
    if ((taken || bounded) && f->everywhere && bounds_as_well(q, f)) {
        all->best = f;
        if (!last) all->n = 1;
        return 1;
    }
    q->lower = lower; /* to begin where the search has come to */
    q->normal = normal;
    return 0;
}

static inline real width_of_dip(const dip *f) { return -f->below - f->floor; }

/* The dip, by which the depth is told, leaves open no more than rounding does, or than is asked. */
static int is_told_narrowly(const depth *d, const dip *f, real upper)
{
    const real high = smaller(upper, -f->floor);
    return high - d->q->lower <= 4 * d->q->d.doubt || is_as_asked(d, d->q->lower, high);
}

/* The depth by a dip alone, before there is a surface; or at last, where none has come to an end. How it is curved
 * costs less than to go around circles, which may tell more. 0: none tells it. -1: a support's answer was none. */
static int fathom_by_dip(depth *d, dips *all, real *upper, int last)
{
    bent b;
    search *q = d->q;
    int told = 0;
    if (!ROUND || !all) return 0;
    if (q->steps < d->g->max_steps && find_curved_dip(d, &b)) told = fathom_by(d, all, &b, upper, last);
    if (told < 0 || (told && is_told_narrowly(d, all->best, *upper))) return told;
    if (q->steps >= d->g->max_steps || !find_dip_by_circles(d, &b)) return told;
    if (!told) return fathom_by(d, all, &b, upper, last);
    dip *at = &all->at[last ? MOST_DIPS : 0];
    const dip before = *at;
    const real lower = q->lower;
    const vec normal = q->normal;
    const int more = fathom_by(d, all, &b, upper, last);
    if (more < 0 || width_of_dip(at) < width_of_dip(&before)) return more;
    *at = before;
    q->lower = lower;
    q->normal = normal;
    return told;
}

/* The points are those of one corner. */
static void stand_at(search *q, const vertex *corner, real weight[DIM + 1])
{
    start_over(q);
    *spare(&q->s) = *corner;
    q->s.n = 1;
    weight[0] = 1;
    q->v = corner->w;
}

/* Normal and points go with a dip, if one is as low as any direction asked. 0: they don't, and all tips are corners
 * again. */
static int stand_in_dip(depth *d, real weight[DIM + 1], enum end *end)
{
    dip other;
    search *q = d->q;
    const dip *f = dip_to_stand_in(d, &other, end);
    if (f) {
        stand_at(q, &f->corner, weight);
        if (bounds_as_well(q, f)) q->normal = f->n;
        return 1;
    }
    for (int i = 0; i < count_dips(d); i++)
        if (d->dips->at[i].planted) pull_back(&d->p, &d->dips->at[i]);
    return 0;
}

/* The bounds as they are now, and whether what is settled is proven. 0: the surface proves none from above. */
static int prove(depth *d, real *upper)
{
    int proven = bound(d, upper);
    d->settled &= proven || (d->flush && d->q->met);
    return proven;
}

/* Of known corners a bracket that the surface does not close is as wide as the depth, and so is settled without
 * rounding, where that is more than this: their difference is hardly thicker than rounding then. */
#define MOST_OPEN UNIT

/* A corner beyond the lowest facet's plane by this share of how far out the facet's own corners are was not seen: the
 * surface has a dent there. The bound from below is charged half of it, and half is what rounds. */
#define DENT (4 * UNIT)

/* Whether rounding has spoilt the surface: a corner lies beyond that facet by so much; or the bracket is so wide and
 * the cores hardly deeper, as where the difference is so thin that the normals of all facets are rough for it. */
static int is_spoilt(depth *d, real width)
{
    const facet *f = d->floor;
    real far = 0, top = -REAL_MAX;
    for (int k = 0; k < DIM; k++) far = larger(length(d->p.tip[f->v[k]].w), far);
    if (!(width > DENT * far)) return 0;
    if (width > -d->q->lower / 4) return 1;
    if (!same(f->n, d->along)) return 0;
    look_along(&d->sight, &d->q->d, f->n);
    for (int k = 0; k < DIM; k++) {
        const tip *t = &d->p.tip[f->v[k]];
        top = larger(height_at(&d->sight, &d->q->d, t->x, t->y).high, top);
    }
    return -d->below - top > DENT * far;
}

/* Whether the bracket of known corners, of which nothing more is to be seen by rounded numbers, may be wider than need
 * be. */
static int is_open(depth *d, int proven, real upper)
{
    const real width = upper - d->q->lower;
    return proven ? d->floor && is_spoilt(d, width) : width > MOST_OPEN;
}

/* What both bounds of a facet are charged for roundings at most, but for the doubt and the slack, in a frame where
 * heights are up to 2: 6 (2 + 2) by floor_of, 8 times 2 more by a dip, and 5 (2 + 2 sqrt(3)) by raise. */
#define CHARGED (68 * UNIT)

/* The bracket is as narrow as one that is closed. */
static int is_bounded(const search *q, real upper) { return upper - q->lower <= 2 * q->d.doubt + q->d.slack + CHARGED; }

/* Minus how deep it is, as the lowest facet has it, where that is a bound: its own height, if nothing lies beyond it;
 * else between that and the least height seen. What bounds are charged for roundings is left out. */
static real depth_of_floor(const depth *d, enum end end, real seen)
{
    const real height = -fine_floor(&d->p, d->floor, d->floor->n).high;
    return end == STILL ? height : (height + seen) / 2;
}

/* Where the value is in the middle between there and the bound from below. The cores are hardly deeper than the least
 * height seen, which is their depth at a dip; where that is below 0 they are apart, as far as the search's points are.
 */
static real near_of(const depth *d, real upper, enum end end)
{
    const search *q = d->q;
    const int bounded = end != OPEN && d->floor && is_bounded(q, upper);
    if (d->g->exact || (end != OPEN && !(d->least < REAL_MAX))) return upper;
    real value = larger(-d->least, q->lower + q->d.doubt);
    if (value > 0) value = larger(value, upper - q->d.doubt);
    else if (bounded && !lowest_dip(d)) value = depth_of_floor(d, end, value);
    return 2 * value - q->lower;
}

/* Of the tips, of the corners along the dips that there have been, and of the one along the way that is known best, the
 * one that lies farther along n, if any does. */
static void take_farther(const depth *d, vec n, tip *top)
{
    const int seen = !d->seen ? 0 : d->seen->n > 0 ? d->seen->n : d->seen->held;
    for (int k = 0; k < d->p.tips; k++)
        if (dot(n, d->p.tip[k].w) > dot(n, top->w)) *top = d->p.tip[k];
    for (int i = 0; i < seen; i++)
        if (dot(n, d->seen->at[i].corner.w) > dot(n, top->w)) *top = tip_of(&d->seen->at[i].corner);
    if (d->has_foremost && dot(n, d->foremost.w) > dot(n, top->w)) *top = d->foremost;
}

/* The points that the weights single out are short of the bound from above along the normal, where a tolerance or the
 * last step has ended the search and left them on a facet that looks aside: they are moved toward the tip that lies
 * farthest that way. */
static void reach_out(const depth *d, real upper, real weight[DIM + 1])
{
    search *q = d->q;
    vertex at = {.x = blend(&q->s, weight, offsetof(vertex, x), 1), .y = blend(&q->s, weight, offsetof(vertex, y), 1)};
    at.w = corner_of(&q->d, at.x, at.y);
    const tip here = tip_of(&at);
    tip top = here;
    take_farther(d, q->normal, &top);
    const real far = dot(q->normal, here.w), more = -upper - far, most = dot(q->normal, top.w) - far;
    if (!(more > CHARGED && most > 0)) return;
    start_over(q);
    take_tip(&q->s, &here, axis(0, 0));
    take_tip(&q->s, &top, axis(0, 0));
    weight[1] = smaller(more / most, 1);
    weight[0] = 1 - weight[1];
}

/* Steps have ended before there was a surface, and the bound from above is what an ellipsoid proves of all ways: normal
 * and points go with its dip, if that bounds as well as what was asked before. */
static void stand_where_held(search *q, const dip *f, real weight[DIM + 1])
{
    if (!(f->below >= q->lower)) return;
    q->lower = f->below;
    q->normal = f->n;
    stand_at(q, &f->corner, weight);
}

/* Normal and points of the depth as it is known. The search's points, if the difference is flat to rounding. */
static void point_to(depth *d, real upper, real weight[DIM + 1], int flat, enum end *end)
{
    search *q = d->q;
    d->near = near_of(d, upper, *end);
    if (d->settled) q->normal = d->normal;
    if (flat && *end == OPEN) reach_out(d, upper, weight);
    if (flat) return;
    if (stand_in_dip(d, weight, end) || *end == FAULT || !d->floor) return;
    if (*end == OPEN) turn_to_normal(d);
    if (d->settled || *end == OPEN) hand_over(d, weight);
    else point_out(d, weight);
    const int tolerant = d->g->abs_tol > 0 || d->g->rel_tol > 0 || q->enough > 0;
    if (!d->settled && (*end == OPEN || tolerant)) reach_out(d, upper, weight);
}

/* Grows the surface till nothing lies beyond the lowest facet; how that ended. */
static enum end grow_surface(depth *d)
{
    const enum end end = deepen(d);
    if (end == OPEN) raise_kept(d);
    if (end != FAULT && d->floor && d->floor->rough == ROUGH) sharpen_facet(&d->p, d->floor);
    return end;
}

/* So many steps a surface takes to go around the origin and to grow by as much again. */
#define REGROWTH (2 * (DIM + 1))

/* What is proven of the surface. Where it is grown, and dips have left the bracket open, as where a tip turned out to
 * be of account after all, it is grown anew without them, if there are steps for that, which may take more corners.
 * Whether that has closed it. */
static int prove_grown(depth *d, real *upper, enum end *end)
{
    const int proven = prove(d, upper);
    const dip *at = lowest_dip(d);
    if (!at || at->far == 0 || is_bounded(d->q, *upper) || is_as_asked(d, d->q->lower, *upper)) return proven;
    if (d->g->max_steps - d->q->steps < REGROWTH) {
        *end = OPEN;
        return proven;
    }
    d->closings = 0;
    *end = do_without_dips(d) ? grow_surface(d) : FAULT;
    return *end != FAULT && prove(d, upper);
}

/* Where room for the surface is used up, and an ellipsoid tells as much of all ways as there is: with its dip. */
static enum end end_by_all(depth *d, dips *all, real *upper)
{
    dips *const before = d->dips;
    d->dips = all;
    const int told = fathom_by_dip(d, all, upper, 1);
    if (told <= 0) d->dips = before;
    return told > 0 ? STILL : told < 0 ? FAULT : OPEN;
}

/* The cores meet, or nearly so: how deep. Where the difference is flat to rounding, the search's points, which are one
 * to rounding, are the contact. What curvature proves ends it sooner whatever is asked. What can't be settled anew
 * stands as it is known by then. */
static APART enum end fathom(depth *d, real *upper, real weight[DIM + 1])
{
    const goal *g = d->g;
    dips own;
    own.n = 0;
    own.best = NULL;
    own.tried = REAL_MAX;
    own.held = 0;
    own.first = d->q->first_dip;
    if (!g->exact && know_first_bulk(d->q->first_dip, &d->q->d, d->a, d->b)) {
        if (!own.first->found) join_alike(&own.first->bulk); /* else none are: bodies with a common axis are walked */
        d->seen = d->dips = &own;
    }
    d->known[0] = outline_of(d->a);
    d->known[1] = outline_of(d->b);
    d->p.whole = &d->q->d;
    const int told = fathom_by_dip(d, d->dips, upper, 0);
    enum end end = told < 0 ? FAULT : told ? CLOSE : first_surface(d);
    int flat = !told && d->p.facets == 0;
    if (end == OPEN && !flat) end = grow_surface(d);
    if (end == OPEN && own.held && !flat) end = end_by_all(d, &own, upper);
    if (end == FAULT) return end;
    if (EXACT && end == STILL && g->exact && (g->tight || flat)) settle_depth(d, &end);
    const int proven = prove_grown(d, upper, &end), open = g->exact && end == STILL && is_open(d, proven, *upper);
    if (end == OPEN && own.held && !flat && !d->dips) end = end_by_all(d, &own, upper);
    if (end == FAULT) return end;
    if (flat && own.held) stand_where_held(d->q, &own.at[0], weight);
    point_to(d, *upper, weight, flat, &end);
    if (EXACT && (g->tight || open) && !d->settled && end != FAULT && d->floor && d->q->steps < g->max_steps &&
        settle_anew(d, &end) == STILL) {
        prove(d, upper);
        point_to(d, *upper, weight, flat, &end);
    }
    return end;
}

#endif
