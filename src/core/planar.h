/* SPDX-License-Identifier: MIT */
/* Polygons of few corners in the plane: GJK in the caller's own lengths, and with nothing in it that is not needed
 * where rounding does not blur what is asked. All corners are cluster before the first step, side by side, so that a
 * step costs little. An edge's direction is square to the difference of its ends, which has lost nothing to where these
 * are; what the bounds charge is what a glance does (glance.h). Whatever is out of the ordinary is left to the walk;
 * where sizes are not plain all is done in the frame, to the same bits. */
#ifndef GJK_CORE_PLANAR_H
#define GJK_CORE_PLANAR_H

#include "fine.h"
#include "thin.h"

#if DIM == 2

/* So many corners a body has at most, and so many are asked for. */
#define PLACES (2 * RUN)
#define ASKED_MOST 16

/* Bounds are off by so many roundings of the root of A^2 + B^2 + c^2 at most, where the bodies reach A and B from their
 * positions, c apart (docs/bounds.md). */
#define PLANAR_DOUBT (24 * UNIT)

/* By so many roundings of the edges that lead there a corner may seem to lie lower than the front, which is nearest
 * then; by more than so many doubts the cores must be apart, or overlap, for more than a verdict. */
#define LEVEL UNIT
#define EVIDENT 2

/* So many doubts a bracket of the distance may be wide. */
#define MOST_WIDE 4

/* ---- the bodies ---- */

/* A body's corners, where they are in the difference: the list's first run and its last, which may be one, or have some
 * corners in common; of fewer than a run some stand there again and again. */
typedef struct cluster {
    real c[DIM][PLACES];
    list from;           /* the corners in the body's own coordinates; */
    real own[RUN * DIM]; /* those of a box */
} cluster;

static inline int has_few(const body *k) { return k->asked == AS_BOX || k->list.count <= PLACES; }

/* Two bodies listed that are looked at so. */
static inline int are_planar(const difference *d)
{
    return has_few(&d->a) && has_few(&d->b) && !(d->a.asked == AS_BOX && d->b.asked == AS_BOX);
}

/* Where the corners are listed. */
static inline void list_places(const body *k, cluster *p)
{
    p->from = k->list;
    if (k->asked != AS_BOX) return;
    const real *half = ((const box *)k->data)->half;
    for (int i = 0; i < RUN; i++) {
        p->own[DIM * i] = i & 1 ? half[0] : -half[0];
        p->own[DIM * i + 1] = i & 2 ? half[1] : -half[1];
    }
    p->from = (list){p->own, RUN, DIM, 0};
}

/* Fewer than a run, again and again. */
static APART void fill_run(const list *l, real run[RUN * DIM])
{
    for (size_t i = 0, k = 0; i < RUN; i++, k = k + 1 < l->count ? k + 1 : 0) {
        run[DIM * i] = l->v[l->step * k];
        run[DIM * i + 1] = l->v[l->step * k + 1];
    }
}

/* What places corners: the body's map of points times their grain, and how far it is from A's position. */
typedef struct placing {
    lanes grain, limit, m[DIM * DIM], by[DIM];
} placing;

HOT placing placing_of(const body *k, vec by)
{
    static const real identity[DIM * DIM] = {1, 0, 0, 1};
    const real *m = k->posed ? k->m : identity;
    placing r = {.grain = in_all(k->grain), .limit = in_all(k->limit)};
    for (int i = 0; i < DIM * DIM; i++) r.m[i] = in_all(m[i]);
    for (int i = 0; i < DIM; i++) r.by[i] = in_all(by.c[i]);
    return r;
}

/* A run of them. 0: one is none, or beyond the reach. */
HOT int place_run(const placing *k, const real *x, size_t step, real to[DIM][PLACES], size_t at)
{
    int fit = (1 << LANES) - 1;
    for (size_t j = 0; j < RUN; j += LANES) {
        lanes c[DIM];
        load_lanes(x + j * step, step, c);
        fit &= any_as_large(k->limit, larger_ones(c[0], products(c[0], in_all(-1))));
        fit &= any_as_large(k->limit, larger_ones(c[1], products(c[1], in_all(-1))));
        for (int i = 0; i < DIM; i++) c[i] = products(c[i], k->grain);
        for (int i = 0; i < DIM; i++) {
            const lanes r = sums(products(k->m[DIM * i], c[0]), products(k->m[DIM * i + 1], c[1]));
            part_lanes(sums(r, k->by[i]), to[i] + at + j);
        }
    }
    return fit == (1 << LANES) - 1;
}

/* All of them. */
HOT int place_corners(const body *k, vec by, cluster *p)
{
    const placing to = placing_of(k, by);
    real run[RUN * DIM];
    list_places(k, p);
    const size_t count = p->from.count, step = p->from.step;
    if (count < RUN) {
        fill_run(&p->from, run);
        return place_run(&to, run, DIM, p->c, 0) & place_run(&to, run, DIM, p->c, RUN);
    }
    return place_run(&to, p->from.v, step, p->c, 0) & place_run(&to, p->from.v + (count - RUN) * step, step, p->c, RUN);
}

static inline vec place_of(const cluster *p, unsigned at) { return (vec){{p->c[0][at], p->c[1][at]}}; }

/* In the body's own coordinates; of fewer than a run, one of the first that often. */
static inline vec corner_placed(const cluster *p, unsigned at)
{
    return nth_of(&p->from, at < RUN ? at : at + p->from.count - PLACES);
}

/* The first of those bits; there is one. */
static inline unsigned first_bit(unsigned set)
{
    unsigned at = 0;
#if defined(__GNUC__) || defined(__clang__)
    at = (unsigned)__builtin_ctz(set);
#else
    while (!(set >> at & 1)) at++;
#endif
    return at;
}

/* Rounded heights of all of them. */
HOT void raise_placed(const cluster *p, vec v, lanes heights[PLACES / LANES])
{
    const lanes x = in_all(v.c[0]), y = in_all(v.c[1]);
    for (int i = 0; i < PLACES; i += LANES)
        heights[i / LANES] = sums(products(join_lanes(p->c[0] + i), x), products(join_lanes(p->c[1] + i), y));
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

/* ---- the front ---- */

/* A corner of the difference, and which of the bodies' it is made of. */
typedef struct spot {
    vec w;
    unsigned a, b;
} spot;

/* What of the difference is nearest to the origin so far: a corner, or an edge. */
typedef struct front {
    spot at[2], last; /* its corners; and that asked for last, */
    vec way;          /* along this */
    int n;
    vec v;      /* the corner; or square to the edge, away from the origin */
    int around; /* the corner asked for last and the edge hold the origin, */
    int ended;  /* or the walk has come to its end otherwise */
} front;

typedef struct scene {
    cluster a, b;
} scene;

/* The corner of the difference that is least along v. */
HOT void ask_ahead(difference *d, const scene *k, front *f, vec v)
{
    spot *p = &f->last;
    d->calls += 2;
    f->way = v;
    p->a = highest_placed(&k->a, mul(v, -1));
    p->b = highest_placed(&k->b, v);
    p->w = sub(place_of(&k->a, p->a), place_of(&k->b, p->b));
}

/* The ways from a corner to another in either body, and that in the difference. */
typedef struct leap {
    vec of_a, of_b, w;
} leap;

static inline leap leap_of(const difference *d, const scene *k, const spot *p, const spot *q)
{
    leap e;
    e.of_a = mapped(&d->a, mul(sub(corner_placed(&k->a, q->a), corner_placed(&k->a, p->a)), d->a.grain));
    e.of_b = mapped(&d->b, mul(sub(corner_placed(&k->b, q->b), corner_placed(&k->b, p->b)), d->b.grain));
    e.w = sub(e.of_a, e.of_b);
    return e;
}

static inline int same_spot(const spot *p, const spot *q) { return p->a == q->a && p->b == q->b; }

/* The corner asked for last lies no lower along v than the front, but for what edges round. */
static inline int is_foremost(const difference *d, const scene *k, const front *f)
{
    const real rise = dot(f->v, sub(f->at[0].w, f->last.w));
    if (same_spot(&f->last, &f->at[0]) || same_spot(&f->last, &f->at[f->n - 1])) return 1;
    if (rise > d->doubt * spread(f->v)) return 0;
    const leap e = leap_of(d, k, &f->last, &f->at[0]);
    return !(dot(f->v, e.w) > LEVEL * (spread(e.of_a) + spread(e.of_b)) * spread(f->v));
}

static inline void stand_on_corner(front *f, spot p)
{
    f->at[0] = p;
    f->n = 1;
    f->v = p.w;
}

static inline void stand_on_edge(const difference *d, const scene *k, front *f, spot p, spot q)
{
    const vec e = leap_of(d, k, &p, &q).w;
    const vec n = {{-e.c[1], e.c[0]}};
    f->v = dot(n, p.w) < 0 ? mul(n, -1) : n;
    f->at[0] = p;
    f->at[1] = q;
    f->n = 2;
}

/* The nearest of the corner, the one asked for last, and what is between them. */
static inline void turn_from_corner(const difference *d, const scene *k, front *f)
{
    const spot p = f->at[0], q = f->last;
    const vec e = sub(q.w, p.w);
    if (!(dot(p.w, e) < 0)) stand_on_corner(f, p);
    else if (!(dot(q.w, e) > 0)) stand_on_corner(f, q);
    else stand_on_edge(d, k, f, p, q);
}

/* The nearest of what the corner asked for last makes with the edge, which it lies below. 0: the triangle holds the
 * origin. */
static inline int turn_from_edge(const difference *d, const scene *k, front *f)
{
    const spot p = f->last;
    const vec left = sub(f->at[0].w, p.w), right = sub(f->at[1].w, p.w);
    const real turn = cross(left, right) < 0 ? -1 : 1;
    const int beyond_left = cross(p.w, left) * turn<0, beyond_right = cross(p.w, right) * turn> 0;
    if (!beyond_left && !beyond_right) return 0;
    if (beyond_left && dot(p.w, left) < 0) stand_on_edge(d, k, f, f->at[0], p);
    else if (beyond_right && dot(p.w, right) < 0) stand_on_edge(d, k, f, f->at[1], p);
    else stand_on_corner(f, p);
    return 1;
}

static inline int turn_front(const difference *d, const scene *k, front *f)
{
    if (f->n == 2) return turn_from_edge(d, k, f);
    turn_from_corner(d, k, f);
    return 1;
}

/* ---- telling ---- */

static inline vertex vertex_of(const scene *k, const spot *p)
{
    return (vertex){.w = p->w, .x = corner_placed(&k->a, p->a), .y = corner_placed(&k->b, p->b)};
}

/* For a walk from there: the front's corners and, where it holds the origin with these, the one asked for last; and
 * where they stand in their lists, if there is a query after this. */
static inline void keep_front(cache *own, const search *q, const scene *k, const front *f, const shape *a,
                              const shape *b)
{
    const spot *at[3] = {&f->at[0], f->n > 1 ? &f->at[1] : &f->last, &f->last};
    own->count = (uint32_t)(f->n + f->around);
    own->reserved = 0;
    for (uint32_t i = 0; i < own->count; i++) {
        store(own->a[i], corner_placed(&k->a, at[i]->a));
        store(own->b[i], corner_placed(&k->b, at[i]->b));
        own->reserved |= (at[i]->b * PLACES + at[i]->a) << 8 * i;
    }
    keep_whose(own, q, a, b);
}

/* How far along the edge the origin is. */
static inline real share_of_edge(const front *f)
{
    if (f->n == 1) return 0;
    const vec e = sub(f->at[1].w, f->at[0].w);
    return within_way(-dot(f->at[0].w, e) / dot(e, e));
}

/* The point at that share of the way from x to y, times that grain, and what of it rounds away. */
static inline vec point_between(vec x, vec y, real share, real grain, vec *low)
{
    const vec way = mul(mul(sub(y, x), grain), share);
    vec r;
    for (int i = 0; i < DIM; i++) {
        const twin t = sum_of(x.c[i] * grain, way.c[i]);
        r.c[i] = t.high;
        low->c[i] = t.low;
    }
    return r;
}

static inline closest pair_at_front(const difference *d, const scene *k, const front *f)
{
    const spot *p = &f->at[0], *q = &f->at[f->n - 1];
    const real share = share_of_edge(f);
    closest r;
    r.x = point_between(corner_placed(&k->a, p->a), corner_placed(&k->a, q->a), share, d->a.grain, &r.x_low);
    r.y = point_between(corner_placed(&k->b, p->b), corner_placed(&k->b, q->b), share, d->b.grain, &r.y_low);
    r.w = corner_at(d, r.x, r.y);
    return r;
}

/* By how much a corner of the body may rise above that one along the direction of length l, and by how much one seems
 * to, in roundings of the edge there. Those that are lower by the margin for certain are passed over. */
static real rise_of_body(const body *k, const cluster *p, unsigned at, vec v, real l, real margin, real *seems)
{
    const vec x = corner_placed(p, at);
    const real least = dot(place_of(p, at), v) - margin;
    lanes heights[PLACES / LANES];
    unsigned near = 0;
    real most = 0;
    raise_placed(p, v, heights);
    for (int i = 0; i < PLACES; i += LANES) near |= (unsigned)any_as_large(heights[i / LANES], in_all(least)) << i;
    if (p->from.count < RUN) near &= (1u << p->from.count) - 1; /* none again */
    for (near &= ~(1u << at); near != 0; near &= near - 1) {
        const vec way = mul(sub(corner_placed(p, first_bit(near)), x), k->grain);
        const real edge = k->posed ? length(map_size(k->m, way)) : length(way), rise = dot(mapped(k, way), v) / l;
        most = larger(rise + lost_of_rise(edge, rise), most);
        *seems = larger(rise - LIES * edge, *seems);
    }
    return most;
}

/* So near that rounding hides it: the front's first corner to twice the digits, and how much lower another may lie by
 * the edges between them (docs/bounds.md). 0: that leaves it open, too. */
static APART int tell_finely(search *q, const scene *k, front *f, const shape *a, const shape *b, const goal *g,
                             result *r)
{
    const difference *d = &q->d;
    const vertex p = vertex_of(k, &f->at[0]);
    const closest first = {.x = mul(p.x, d->a.grain), .y = mul(p.y, d->b.grain), .w = p.w};
    know_offset(&q->d, a, b);
    const vec low = lost_of_pair(d, &first);
    if (f->n == 1) f->v = add(p.w, low);
    const real l = length(f->v), whole = d->doubt / PLANAR_DOUBT;
    const real blur = whole * (UNIT / 8) + (d->wild ? d->lost : 0), margin = d->doubt * l;
    real seems = 0;
    const real fall = rise_of_body(&d->a, &k->a, f->at[0].a, mul(f->v, -1), l, margin, &seems) +
                      rise_of_body(&d->b, &k->b, f->at[0].b, f->v, l, margin, &seems);
    const twin height = height_to_twice(f->v, p.w, low);
    if (seems > 0 || !(l > 0)) return 0;
    const closest pair = pair_at_front(d, k, f);
    const vec way = add(pair.w, lost_of_pair(d, &pair));
    const leap edge = leap_of(d, k, &f->at[0], &f->at[f->n - 1]);
    const real off = 8 * UNIT * (spread(edge.of_a) + spread(edge.of_b)), far = length(way);
    q->lower = height.high + (height.low - fall - blur - 2 * UNIT * size(height.high));
    EACH(q->normal.c[i] = 0 - f->v.c[i] / l);
    r->value = gap_of(d, height, a, b);
    const real upper = far + (off + blur + 8 * UNIT * far);
    const real radius = g->radius * d->scale, width = upper - q->lower;
    if (!(width <= MOST_WIDE * d->doubt)) return 0;
    if (g->deep && !(q->lower > radius) && !(width <= BROAD * (whole / 2 + radius))) return 0;
    spell(q, a, b, upper, &pair, r);
    if (g->deep && r->upper < 0) move_points(r, q, mapped(&d->a, pair.x), mapped(&d->b, pair.y), pair.w, a, b, 1);
    return r->lower > 0 || r->upper < 0;
}

/* How far apart: as the pair is, than which no corner lies lower; or whether, where that is asked. 0: rounding leaves
 * it open, or has chosen an edge that is too short for it. */
static int tell_front(search *q, const scene *k, front *f, const shape *a, const shape *b, const goal *g, result *r)
{
    const difference *d = &q->d;
    raise(q, f->way, f->last.w);
    if (!(q->lower > EVIDENT * d->doubt) && g->radius == 0) return tell_finely(q, k, f, a, b, g, r);
    const closest pair = pair_at_front(d, k, f);
    const real upper = length(pair.w) * (1 + 8 * UNIT) + d->doubt;
    if (g->sign_only) {
        spell(q, a, b, upper, &pair, r);
    } else {
        if (!(upper - q->lower <= MOST_WIDE * d->doubt) && f->ended) return 0;
        know_offset(&q->d, a, b);
        spell_distance(q, a, b, upper, &pair, lost_of_pair(d, &pair), r);
    }
    return r->lower > 0 || (r->upper < 0 && !g->deep) || tell_finely(q, k, f, a, b, g, r);
}

/* They overlap: the corner asked for last and the edge hold the origin. 0: with too little room, or more is asked. */
static int tell_held(search *q, const scene *k, const front *f, const shape *a, const shape *b, const goal *g,
                     result *r)
{
    clear(&q->s);
    q->s.n = 3;
    for (int i = 0; i < 2; i++) q->s.slot[i] = vertex_of(k, &f->at[i]);
    q->s.slot[2] = vertex_of(k, &f->last);
    raise(q, f->way, f->last.w);
    if (g->deep || !holds(&q->s, q->weight)) return 0;
    q->inside = rough_room(&q->s, q->weight);
    if (!(q->inside > (1 + EVIDENT) * q->d.doubt)) return 0;
    q->weighed = 1;
    tell_overlap(q, a, b, INSIDE, q->d.doubt / 3, r);
    r->value = 0;
    return r->upper < 0;
}

/* What the corner asked for last shows, where it is only asked whether they meet: that they are apart. */
static inline int shows_apart(search *q, const scene *k, const front *f, const shape *a, const shape *b, const goal *g,
                              result *r)
{
    const real least = q->d.doubt + g->radius * q->d.scale, height = dot(f->way, f->last.w);
    if (!(height > 0 && height > least * length(f->way))) return 0;
    const vertex p = vertex_of(k, &f->last);
    evidence e = corner_shown(&q->d, f->way, &p);
    q->steps--; /* it counts itself */
    if (tell_evidence(q, &e, f->way, &p, a, b, r)) return 1;
    q->steps++;
    return 0;
}

/* That they are farther apart than is asked, if that is asked. */
static inline int shows_beyond(const difference *d, const front *f, const goal *g)
{
    if (g->sign_only || g->beyond == REAL_MAX) return 0;
    return dot(f->way, f->last.w) > (g->beyond * d->scale + EVIDENT * d->doubt) * length(f->way);
}

/* The front is so near that the radii meet. */
static inline int is_within(const difference *d, const front *f, const goal *g)
{
    if (!g->sign_only) return 0;
    const real within = g->radius * d->scale - EVIDENT * d->doubt, height = dot(f->v, f->at[0].w);
    return within > 0 && height < within * length(f->v);
}

/* ---- the walk ---- */

static inline int stands_at(const cluster *p, unsigned at, vec x)
{
    return (at < p->from.count || p->from.count >= RUN) && same(corner_placed(p, at), x);
}

/* From the points of the last query, if they stand where they did. 0: they do not. */
static inline int recall(const difference *d, const scene *k, front *f, const cache *from)
{
    uint32_t hint = from->reserved;
    for (uint32_t i = 0; i < from->count; i++, hint >>= 8) {
        spot p = {.a = hint % PLACES, .b = hint / PLACES % PLACES};
        if (!stands_at(&k->a, p.a, load(from->a[i])) || !stands_at(&k->b, p.b, load(from->b[i]))) return 0;
        p.w = sub(place_of(&k->a, p.a), place_of(&k->b, p.b));
        f->last = p;
        if (i == 0) stand_on_corner(f, p);
        else if (f->n == 1) turn_from_corner(d, k, f);
        else if (dot(f->v, p.w) < dot(f->v, f->at[0].w)) turn_from_edge(d, k, f);
    }
    return 1;
}

/* Walks to the front that is nearest, or until the origin is held, and tells what that shows. 0: nothing. */
static inline int walk_front(search *q, const scene *k, front *f, const shape *a, const shape *b, const goal *g,
                             result *r)
{
    difference *d = &q->d;
    const real least = d->doubt * (UNIT / PLANAR_DOUBT);
    for (;;) {
        f->ended = !(dot(f->v, f->v) > least * least); /* it has no direction */
        if (f->ended || q->steps >= ASKED_MOST || q->steps >= g->max_steps) return 0;
        ask_ahead(d, k, f, f->v);
        q->steps++;
        if (g->sign_only && shows_apart(q, k, f, a, b, g, r)) return 1;
        f->ended = is_foremost(d, k, f);
        if (f->ended || shows_beyond(d, f, g) || is_within(d, f, g)) return tell_front(q, k, f, a, b, g, r);
        f->around = !turn_front(d, k, f);
        if (f->around) return tell_held(q, k, f, a, b, g, r);
    }
}

/* Where this walk was left, if that is where another may go on. */
static void leave_front(search *q, const scene *k, const front *f, const shape *a, const shape *b)
{
    if (!f->around && !f->ended) return;
    keep_front(&q->found.at, q, k, f, a, b);
    q->found.steps = q->steps;
    q->found.calls = q->d.calls;
    q->found.lower = q->lower * q->d.unscale;
    q->found.normal = q->normal;
}

/* 0: nothing is told, and the glance's corner is where it was. */
static int look_at_planar(search *q, cache *own, const shape *a, const shape *b, const goal *g, result *r)
{
    const vertex glanced = q->s.slot[0];
    const int calls = q->d.calls;
    scene k;
    front f;
    f.around = f.ended = 0;
    blank(q);
    q->lower = -REAL_MAX;
    q->d.loose = 0;
    if (!place_corners(&q->d.a, axis(0, 0), &k.a) || !place_corners(&q->d.b, q->d.c, &k.b)) return 0;
    const int lent = own && lends(own, a, b);
    if (!lent || !recall(&q->d, &k, &f, own)) {
        if (lent && g->deep) return 0; /* to the walk, which knows what was lent */
        ask_ahead(&q->d, &k, &f, mul(q->d.c, -1));
        stand_on_corner(&f, f.last);
        q->steps++;
    }
    q->d.calls = 2 * q->steps;
    if (walk_front(q, &k, &f, a, b, g, r)) {
        if (own) keep_front(own, q, &k, &f, a, b);
        return 1;
    }
    leave_front(q, &k, &f, a, b);
    q->s.slot[0] = glanced;
    q->d.calls = calls;
    return 0;
}

/* ---- the doubt ---- */

/* Without a frame. UNCLEAR: the sizes are none for that. */
static enum glanced tell_planar(search *q, cache *own, const shape *a, const shape *b, const goal *g, result *r)
{
    difference *d = &q->d;
    if (q->glanced == UNCLEAR) return UNCLEAR;
    stay_outside(d, a, b);
    d->slack = 0;
    know_reach_listed(&d->a);
    know_reach_listed(&d->b);
    real map[2];
    if (!doubt_outside(d, a, b, square_of_reach(&d->a, 1), square_of_reach(&d->b, 1), PLANAR_DOUBT, map))
        return UNCLEAR;
    know_norms(d, root(map[0]), root(map[1]));
    return look_at_planar(q, own, a, b, g, r) ? TELLING : IN_VAIN;
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
    know_norms(d, root(map_a) / level_a, root(map_b) / level_b);
    if (look_at_planar(q, own, a, b, g, r)) return 1;
    const find found = q->found;
    *q = before;
    q->found = found;
    return 0;
}

/* ---- the door ---- */

/* Without a frame, if they are polygons and that will do. */
static inline void tell_polygons(search *q, const shape *a, const shape *b, const options *o, const goal *g, result *r)
{
    q->planar = UNTRIED;
    q->found.at.count = 0;
    if (q->told || !q->listed || q->thin != UNTRIED || !are_planar(&q->d)) return;
    q->planar = tell_planar(q, o->cache, a, b, g, r);
    q->told = q->planar == TELLING;
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

/* In the frame, where it was not clear without, nor in a glance, for which the search has been opened. What is left is
 * gone on with from there. */
static inline int tell_polygons_in_frame(search *q, int opened, const shape *a, const shape *b, const options *o,
                                         const goal *g, result *r)
{
    const int late = q->planar == UNCLEAR && q->glanced != UNTRIED;
    if (opened != late) return 0;
    if (q->planar == UNCLEAR) {
        q->planar = tell_planar_in_frame(q, o->cache, a, b, g, r) ? TELLING : IN_VAIN;
        q->told = q->planar == TELLING;
    }
    if (q->told || q->found.at.count == 0) return q->told;
    q->told = !g->deep && tell_found(q, a, b, r);
    if (q->told && o->cache) pass_on(o->cache, &q->found.at);
    if (q->found.steps >= g->max_steps) q->found.at.count = 0;
    if (!q->told && opened && q->found.at.count > 0) open_found(q);
    return q->told;
}
#else
#define tell_polygons(q, a, b, o, g, r) ((void)0)
#define tell_polygons_in_frame(q, opened, a, b, o, g, r) ((void)(g), 0)
#endif

#endif
