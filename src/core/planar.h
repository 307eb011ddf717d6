/* SPDX-License-Identifier: MIT */
/* Polygons of few corners in the plane: GJK in the caller's own lengths, and with nothing in it that is not needed
 * where rounding does not blur what is asked. All corners are placed before the first step, side by side, so that a
 * step costs little. An edge's direction is square to the difference of its ends, which has lost nothing to where these
 * are; what the bounds charge is what a glance does (glance.h). Whatever is out of the ordinary is left to the walk;
 * where sizes are not plain all is done in the frame, to the same bits. */
#ifndef GJK_CORE_PLANAR_H
#define GJK_CORE_PLANAR_H

#include "fine.h"
#include "flat.h"
#include "thin.h"

#if DIM == 2

/* Bounds are off by so many roundings of the root of A^2 + B^2 + c^2 at most, where the bodies reach A and B from their
 * positions, c apart (docs/bounds.md). */
#define PLANAR_DOUBT (24 * UNIT)

/* By so many roundings of the edges that lead there a corner may seem to lie lower than the front, which is nearest
 * then; by more than so many doubts the cores must be apart, or overlap, for more than a verdict. */
#define LEVEL UNIT
#define EVIDENT 2

/* Added to a number and taken away again this times a bound of it, so many upper digits are left that a product of two
 * such, and the sum of two of these, is exact. */
#define DIGITS_OFF ROUNDING_TO(GRID)

/* So many doubts a bracket of the distance may be wide. */
#define MOST_WIDE 4

/* The whole answer is kept out of the way of the everyday one. */
#define WHOLE APART

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
    static const real identity[DIM * DIM] = {1, 0, 0, 1};
    p->m = k->posed ? k->m : identity;
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
HOT unsigned lowest_placed(const cluster *p, vec v)
{
    lanes heights[PLACES / LANES], least;
    unsigned lowest = 1u << (PLACES - 1); /* where no height is a number */
    raise_placed(p, v, heights);
    least = heights[0];
    for (int i = LANES; i < PLACES; i += LANES) least = smaller_ones(least, heights[i / LANES]);
    least = least_in_all(least);
    for (int i = 0; i < PLACES; i += LANES) lowest |= (unsigned)any_as_large(least, heights[i / LANES]) << i;
    return first_bit(lowest);
}

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
HOT int recall(const difference *d, const scene *k, int framed, front *f, const cache *from)
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

/* ---- spelling ---- */

/* What is known of the cores: how far apart at least, along v, of length l, and at most, as these points of theirs are,
 * from the bodies' positions; and in all, the radii taken off. */
typedef struct verdict {
    real lower, upper, value, l;
    vec v, a, b, way;
} verdict;

/* Of any bodies. 0: that does not say whether they meet or, where it is asked, how deep; and nothing is changed. */
static APART int spell_in_full(search *q, verdict own, int steps, int deep, const shape *a, const shape *b, result *r)
{
    const verdict *t = &own;
    result told = {.value = t->value, .steps = steps, .supports = 2 * steps};
    bracket(&told, &q->d, t->lower, t->upper, a, b);
    if (!(told.lower > 0) && !(told.upper < 0)) return 0;
    EACH(q->normal.c[i] = 0 - t->v.c[i] / t->l);
    move_points(&told, &q->d, q->normal, t->a, t->b, t->way, a, b, deep);
    store(told.normal, q->normal);
    *r = told;
    return 1;
}

/* Sharp bodies, in the caller's own lengths; apart, or with one point of both. */
HOT void spell_at_once(const verdict *t, const shape *a, const shape *b, result *r)
{
    r->lower = t->lower;
    r->upper = t->upper;
    r->value = t->value;
    const vec on_a = a->pose ? add(t->a, load(a->pose->p)) : t->a;
    store(r->point_a, on_a);
    store(r->point_b, !(t->upper > 0) ? on_a : b->pose ? add(t->b, load(b->pose->p)) : t->b);
    EACH(r->normal[i] = 0 - t->v.c[i] / t->l);
}

HOT int spell_verdict(search *q, const verdict *t, const front *f, int framed, const shape *a, const shape *b,
                      const goal *g, result *r)
{
    if (framed || g->radius != 0) return spell_in_full(q, *t, f->steps, g->deep, a, b, r);
    spell_at_once(t, a, b, r);
    r->steps = f->steps;
    r->supports = 2 * f->steps;
    r->reserved = 0;
    return 1;
}

/* ---- telling ---- */

/* How far along the edge the origin is. */
HOT real share_of_edge(const front *f)
{
    return f->n == 1 ? 0 : within_way(-dot(f->p.w, f->edge) / dot(f->edge, f->edge));
}

/* The body's point at that share of the way, and what of it rounds away. */
HOT vec point_between(const cluster *p, unsigned from, unsigned to, real share, vec *low)
{
    const vec x = own_of(p, from), way = mul(sub(own_of(p, to), x), share);
    vec r;
    for (int i = 0; i < DIM; i++) {
        const twin t = sum_of(x.c[i], way.c[i]);
        r.c[i] = t.high;
        low->c[i] = t.low;
    }
    return r;
}

/* A point of each body, times its grain, and what of it rounds away; and the corner that they make. */
typedef struct closest {
    vec x, x_low, y, y_low, w;
} closest;

HOT closest pair_at_front(const difference *d, const scene *k, const front *f, real share)
{
    closest p;
    p.x = point_between(&k->a, in_a(&f->p), in_a(&f->q), share, &p.x_low);
    p.y = point_between(&k->b, in_b(&f->p), in_b(&f->q), share, &p.y_low);
    p.w = sub(map(k->a.m, p.x), add(map(k->b.m, p.y), d->c));
    return p;
}

static inline closest pair_at_spot(const scene *k, const spot *p)
{
    const vec none = axis(0, 0);
    return (closest){own_of(&k->a, in_a(p)), none, own_of(&k->b, in_b(p)), none, p->w};
}

/* Of four numbers the upper digits, by bounds of them times DIGITS_OFF. */
HOT fours upper_of(fours x, fours off) { return differences_of(sums_of(x, off), off); }

/* Where the pair's points are, of a and then of b, and what rounding took from that: products of upper digits are
 * whole, and so is their sum. */
HOT void place_finely(const difference *d, const scene *k, const closest *p, real place[2 * DIM], real low[2 * DIM])
{
    const real *m = k->a.m, *n = k->b.m;
    const vec x = p->x, y = p->y, s = p->x_low, t = p->y_low;
    const real of_m = d->a.norm * DIGITS_OFF, of_n = d->b.norm * DIGITS_OFF;
    const real of_x = d->a.limit * d->a.grain * DIGITS_OFF, of_y = d->b.limit * d->b.grain * DIGITS_OFF;
    const fours map_off = fours_of(of_m, of_m, of_n, of_n), off = fours_of(of_x, of_x, of_y, of_y);
    const fours first = fours_of(m[0], m[2], n[0], n[2]), second = fours_of(m[1], m[3], n[1], n[3]);
    const fours x0 = fours_of(x.c[0], x.c[0], y.c[0], y.c[0]), x1 = fours_of(x.c[1], x.c[1], y.c[1], y.c[1]);
    const fours first_up = upper_of(first, map_off), second_up = upper_of(second, map_off);
    const fours x0_up = upper_of(x0, off), x1_up = upper_of(x1, off);
    const fours x0_rest = sums_of(differences_of(x0, x0_up), fours_of(s.c[0], s.c[0], t.c[0], t.c[0]));
    const fours x1_rest = sums_of(differences_of(x1, x1_up), fours_of(s.c[1], s.c[1], t.c[1], t.c[1]));
    const fours up = sums_of(products_of(first_up, x0_up), products_of(second_up, x1_up));
    const fours rest = sums_of(products_of(first_up, x0_rest), products_of(second_up, x1_rest));
    const fours lower =
        sums_of(products_of(differences_of(first, first_up), x0), products_of(differences_of(second, second_up), x1));
    const fours at = sums_of(products_of(first, x0), products_of(second, x1));
    part_fours(at, place);
    part_fours(sums_of(differences_of(up, at), sums_of(rest, lower)), low);
}

/* What it took from the corner of the difference that they make, and from c on the way there. */
HOT vec lost_finely(const difference *d, const scene *k, const closest *p, const shape *a, const shape *b)
{
    const vec c_low = mul(offset_low(a->pose, b->pose), d->scale);
    real place[2 * DIM], lost[2 * DIM];
    vec low;
    place_finely(d, k, p, place, lost);
    for (int i = 0; i < DIM; i++) {
        const twin t = sum_of(place[DIM + i], d->c.c[i]);
        low.c[i] = (sum_of(place[i], -t.high).low - t.low) + (lost[i] - lost[DIM + i] - c_low.c[i]);
    }
    return low;
}

/* The pair is what is told. */
HOT void place_verdict(const scene *k, const closest *p, verdict *t)
{
    t->a = map(k->a.m, p->x);
    t->b = map(k->b.m, p->y);
    t->way = p->w;
}

/* How long w + low is, to more digits than one number has, as upper digits have exact squares: length_to_twice,
 * cheaper, and not as exact. */
HOT twin length_by_digits(vec w, vec low)
{
    const real off = spread(w) * DIGITS_OFF, l = length(w), l_up = (l + off) - off, l_rest = l - l_up;
    vec up;
    EACH(up.c[i] = (w.c[i] + off) - off);
    const vec rest = sub(w, up);
    const real square = dot(up, up) - l_up * l_up;
    const real more = 2 * (dot(up, rest) - l_up * l_rest + dot(w, low)) + (dot(rest, rest) - l_rest * l_rest);
    return (twin){l, (square + more) / (2 * l)};
}

/* Bit for bit, which other corners of the body are not lower along v than that one by the margin for certain. */
HOT unsigned near_corners(const cluster *p, unsigned at, vec v, real margin)
{
    const real least = dot(place_of(p, at), v) - margin;
    lanes heights[PLACES / LANES];
    unsigned near = 0;
    raise_placed(p, v, heights);
    for (int i = 0; i < PLACES; i += LANES) near |= (unsigned)any_as_large(heights[i / LANES], in_all(least)) << i;
    if (p->from->count < RUN) near &= (1u << p->from->count) - 1; /* none again */
    return near & ~(1u << at);
}

/* By how much a corner of the body may rise above that one along the direction of length l, and by how much one seems
 * to, in roundings of the edge there. */
static real rise_of_body(const body *k, const cluster *p, unsigned at, vec v, real l, real margin, real *seems)
{
    real most = 0;
    for (unsigned near = near_corners(p, at, v, margin); near != 0; near &= near - 1) {
        const vec way = sub(own_of(p, first_bit(near)), own_of(p, at));
        const real edge = k->posed ? length(map_size(p->m, way)) : length(way), rise = dot(map(p->m, way), v) / l;
        most = larger(rise + lost_of_rise(edge, rise), most);
        *seems = larger(rise - LIES * edge, *seems);
    }
    return most;
}

/* What the way between two of the body's corners sums, without the signs. */
static inline real sums_between(const cluster *p, unsigned from, unsigned to)
{
    return spread(map_size(p->m, sub(own_of(p, to), own_of(p, from))));
}

/* What is charged where a corner's place is known to twice the digits. */
static inline real blur_of(const difference *d)
{
    return d->doubt / PLANAR_DOUBT * (UNIT / 8) + (d->wild ? d->lost : 0);
}

/* So near that rounding hides it: the front's first corner to twice the digits, and how much lower another may lie by
 * the edges between them (docs/bounds.md). 0: that leaves it open, too. */
static APART int tell_finely(search *q, const scene *k, front own, const shape *a, const shape *b, int deep, result *r)
{
    const difference *d = &q->d;
    front *f = &own;
    const spot *p = &f->p, *last = &f->q;
    const closest first = pair_at_spot(k, p);
    const vec low = lost_finely(d, k, &first, a, b);
    verdict t;
    if (f->n == 1) f->v = add(p->w, low);
    t.v = f->v;
    t.l = length(f->v);
    const real whole = d->doubt / PLANAR_DOUBT, blur = blur_of(d);
    const real margin = d->doubt * t.l;
    real seems = 0;
    const real fall = rise_of_body(&d->a, &k->a, in_a(p), mul(f->v, -1), t.l, margin, &seems) +
                      rise_of_body(&d->b, &k->b, in_b(p), f->v, t.l, margin, &seems);
    const twin height = height_to_twice(f->v, p->w, low);
    if (seems > 0 || !(t.l > 0)) return 0;
    const closest pair = pair_at_front(d, k, f, share_of_edge(f));
    place_verdict(k, &pair, &t);
    t.way = add(pair.w, lost_finely(d, k, &pair, a, b));
    const real off = 8 * UNIT * (sums_between(&k->a, in_a(p), in_a(last)) + sums_between(&k->b, in_b(p), in_b(last)));
    const real far = length(t.way);
    t.lower = height.high + (height.low - fall - blur - 2 * UNIT * size(height.high));
    t.upper = far + (off + blur + 8 * UNIT * far);
    t.value = gap_of(d, height, a, b);
    const real radius = (a->radius + b->radius) * d->scale, width = t.upper - t.lower;
    if (!(width <= MOST_WIDE * d->doubt)) return 0;
    if (deep && !(t.lower > radius) && !(width <= BROAD * (whole / 2 + radius))) return 0;
    return spell_in_full(q, t, f->steps, deep, a, b, r);
}

/* By how much four numbers are off whole multiples of 2^-places of that power of two, and how much that is in all. */
HOT fours odds_of(fours odds, fours x, int places, real power)
{
    const real off = ROUNDING_TO(places) * power;
    return sums_of(odds, sizes_of(differences_of(upper_of(x, fours_of(off, off, off, off)), x)));
}

/* The body's numbers there, and its map, are short: their products, and sums of these, are exact. */
HOT fours odds_of_body(fours odds, const body *k, const cluster *p, const unsigned at[3], real power)
{
    const real level = leveler(k->norm * (1 + LENGTH_OFF)), share = level / 2 * power;
    const real *x = p->own[0], *y = p->own[1];
    odds = odds_of(odds, join_fours(p->m), SHORT, 2 / level);
    odds = odds_of(odds, fours_of(x[at[0]], y[at[0]], x[at[1]], y[at[1]]), SHORT, share);
    return odds_of(odds, fours_of(x[at[2]], y[at[2]], x[at[2]], y[at[2]]), SHORT, share);
}

/* Nothing was rounded on the way to these corners, nor will be in their determinants: as are_corners_whole has it, in
 * the caller's own lengths, of which the bodies reach the power of two at most, and all sums twice that. */
HOT int are_spots_whole(const difference *d, const scene *k, const spot *const at[3], const shape *a, const shape *b)
{
    const real power = 2 / leveler(d->doubt / PLANAR_DOUBT);
    const unsigned of_a[3] = {in_a(at[0]), in_a(at[1]), in_a(at[2])};
    const unsigned of_b[3] = {in_b(at[0]), in_b(at[1]), in_b(at[2])};
    const vec p = at[0]->w, q = at[1]->w, r = at[2]->w;
    fours odds = odds_of_body(fours_of(0, 0, 0, 0), &d->a, &k->a, of_a, power);
    odds = odds_of_body(odds, &d->b, &k->b, of_b, power);
    odds = odds_of(odds, fours_of(p.c[0], p.c[1], q.c[0], q.c[1]), SHORTER, power);
    odds = odds_of(odds, fours_of(r.c[0], r.c[1], r.c[0], r.c[1]), SHORTER, power);
    return are_none(odds) && is_way_short(d, a, b, power);
}

/* Weights of the front's corner, its edge, or that and the corner asked for last, with which they add up to the origin;
 * 0: they do not hold it. */
HOT int weigh_front(const front *f, const spot *const at[3], real weight[3])
{
    const vec p = at[0]->w, q = at[1]->w, r = at[2]->w;
    weight[0] = 1;
    weight[1] = weight[2] = 0;
    if (f->n == 1) return !(peak(p) > 0);
    const real turn = cross(p, q);
    if (f->around) {
        weight[0] = cross(q, r);
        weight[1] = cross(r, p);
        weight[2] = turn;
    } else {
        const int i = size(q.c[0] - p.c[0]) > size(q.c[1] - p.c[1]) ? 0 : 1;
        weight[0] = q.c[i];
        weight[1] = -p.c[i];
    }
    const real least = smaller(weight[0], smaller(weight[1], weight[2]));
    const real most = larger(weight[0], larger(weight[1], weight[2]));
    return (f->around || turn == 0) && (least < 0) != (most > 0);
}

/* All of the body's numbers are short, and all its places as those of corners of the difference are. */
static fours odds_of_places(fours odds, const body *k, const cluster *p, real power)
{
    const real level = leveler(k->norm * (1 + LENGTH_OFF)), share = level / 2 * power;
    odds = odds_of(odds, join_fours(p->m), SHORT, 2 / level);
    for (int i = 0; i < DIM; i++)
        for (int j = 0; j < PLACES; j += 4) {
            odds = odds_of(odds, join_fours(p->own[i] + j), SHORT, share);
            odds = odds_of(odds, join_fours(p->at[i] + j), SHORTER, power);
        }
    return odds;
}

/* Nor was anything on the way to any corner, nor is in its height along an edge, or along the way between the
 * positions. */
static int are_all_whole(const difference *d, const scene *k, const shape *a, const shape *b)
{
    const real power = 2 / leveler(d->doubt / PLANAR_DOUBT), x = d->c.c[0], y = d->c.c[1];
    fours odds = odds_of_places(fours_of(0, 0, 0, 0), &d->a, &k->a, power);
    odds = odds_of_places(odds, &d->b, &k->b, power);
    odds = odds_of(odds, fours_of(x, y, x, y), SHORTER, power);
    return is_way_short(d, a, b, power) && are_none(odds);
}

/* That the cores meet where the walk has come to, of corners that are short numbers: with nothing rounded; and that
 * they do no more, if that is asked. 0: they are none, or do not, or there is no direction. */
static APART int tell_touching(search *q, const scene *k, front own, int framed, const shape *a, const shape *b,
                               const goal *g, result *r)
{
    const front *f = &own;
    const spot *const at[3] = {&f->p, f->n > 1 ? &f->q : &f->p, f->around ? &f->last : &f->p};
    verdict t = {.v = f->way, .l = length(f->way), .value = 0};
    real weight[3];
    if (framed || !(f->around || f->ended) || f->steps == 0) return 0;
    if (!weigh_front(f, at, weight) || !are_spots_whole(&q->d, k, at, a, b)) return 0;
    if (g->deep && (dot(f->way, f->last.w) != 0 || !are_all_whole(&q->d, k, a, b))) return 0;
    q->lower = -REAL_MAX;
    q->d.slack = 0;
    raise(q, f->way, f->last.w);
    if (!(q->lower > -REAL_MAX)) return 0;
    t.lower = g->deep ? 0 : q->lower; /* so high all of them lie */
    t.upper = 0;
    const real sum = size(weight[0]) + size(weight[1]) + size(weight[2]);
    vec x = axis(0, 0), y = x;
    for (int i = 0; i < 3; i++) {
        const real share = size(weight[i]) / sum;
        x = add(x, mul(own_of(&k->a, in_a(at[i])), share));
        y = add(y, mul(own_of(&k->b, in_b(at[i])), share));
    }
    t.a = map(k->a.m, x);
    t.b = map(k->b.m, y);
    t.way = axis(0, 0);
    return spell_verdict(q, &t, f, framed, a, b, g, r);
}

/* How far apart: as the pair is, than which no corner lies lower; or whether, where that is asked. 0: rounding leaves
 * it open, or has chosen an edge that is too short for it. */
HOT int tell_front(search *q, const scene *k, front *f, int framed, const shape *a, const shape *b, const goal *g,
                   result *r)
{
    const difference *d = &q->d;
    verdict t = {.v = f->way, .l = length(f->way), .value = 0};
    t.lower = dot(f->way, f->last.w) / t.l - d->doubt;
    if (!(t.lower > EVIDENT * d->doubt) && g->radius == 0) {
        const int on_it = !(dot(f->v, f->p.w) > 0) && tell_touching(q, k, *f, framed, a, b, g, r);
        return on_it || tell_finely(q, k, *f, a, b, g->deep, r);
    }
    if (g->deep && !(t.lower > g->radius * d->scale)) return tell_finely(q, k, *f, a, b, 1, r);
    const closest pair = pair_at_front(d, k, f, share_of_edge(f));
    place_verdict(k, &pair, &t);
    if (g->sign_only) {
        t.upper = length(t.way) * (1 + 8 * UNIT) + d->doubt;
    } else {
        const twin far = length_by_digits(t.way, lost_finely(d, k, &pair, a, b));
        t.upper = far.high * (1 + 8 * UNIT) + d->doubt;
        t.value = gap_of(d, far, a, b);
        if (!(t.upper - t.lower <= MOST_WIDE * d->doubt) && f->ended) return 0;
    }
    if (spell_verdict(q, &t, f, framed, a, b, g, r)) return 1;
    return tell_finely(q, k, *f, a, b, g->deep, r);
}

/* They overlap: the corner asked for last and the edge hold the origin. 0: with too little room, or more is asked. */
HOT int tell_held(search *q, const scene *k, const front *f, int framed, const shape *a, const shape *b, const goal *g,
                  result *r)
{
    const difference *d = &q->d;
    const spot *at[3] = {&f->p, &f->q, &f->last};
    simplex s;
    real weight[DIM + 1];
    clear(&s);
    s.n = 3;
    for (int i = 0; i < 3; i++) s.slot[i].w = at[i]->w;
    if (!holds(&s, weight)) return 0;
    const real inside = rough_room(&s, weight);
    if (!(inside > (1 + EVIDENT) * d->doubt)) return 0;
    verdict t = {.v = f->way, .l = length(f->way), .upper = d->doubt - inside, .value = 0};
    t.lower = dot(f->way, f->last.w) / t.l - d->doubt;
    const real sum = weight[0] + weight[1] + weight[2];
    t.a = t.b = axis(0, 0);
    for (int i = 0; i < 3; i++) {
        t.a = add(t.a, mul(place_of(&k->a, in_a(at[i])), weight[i] / sum));
        t.b = add(t.b, mul(place_of(&k->b, in_b(at[i])), weight[i] / sum));
    }
    t.way = sub(t.a, add(t.b, d->c));
    if (!(peak(t.way) <= d->doubt / 3)) return 0; /* the pair is none */
    return spell_verdict(q, &t, f, framed, a, b, g, r);
}

/* ---- how deep ---- */

HOT mark mark_of_spot(const spot *p) { return (mark){(ring_real)p->w.c[0], (ring_real)p->w.c[1], p->at}; }

/* Of an edge of the ring, or of what is taken for one. */
HOT void stand_in_ring(const difference *d, const scene *k, const ring *o, unsigned i, front *f)
{
    stand_on_edge(k, f, spot_at(d, k, o->at[i].at), spot_at(d, k, o->at[o->next[i]].at));
    f->v = (vec){{-f->edge.c[1], f->edge.c[0]}};
}

/* Grows beyond the lowest edge until no corner lies there, but for the doubt. 0: it is not known. */
static int grow_planar_ring(const difference *d, const scene *k, front *f, const goal *g, ring *o)
{
    start_ring(o, mark_of_spot(&f->p), mark_of_spot(&f->q), mark_of_spot(&f->last));
    for (;;) {
        const unsigned i = lowest_of_ring(o);
        stand_in_ring(d, k, o, i, f);
        if (o->count == RING_MOST || f->steps >= g->max_steps || !(dot(f->v, f->v) > 0)) return 0;
        ask_ahead(d, k, f);
        f->around = 0;
        f->ended = !(dot(f->v, sub(f->p.w, f->last.w)) > d->doubt * length(f->v));
        if (f->ended) return 1;
        split_edge(o, i, mark_of_spot(&f->last));
    }
}

/* A corner's height along v to twice the digits. */
static twin height_finely(const difference *d, const scene *k, vec v, const spot *p, const shape *a, const shape *b)
{
    const closest at = pair_at_spot(k, p);
    return height_to_twice(v, p->w, lost_finely(d, k, &at, a, b));
}

/* An edge of the ring, where it starts, the heights of its ends along v to twice the digits, and how near the origin it
 * is at least. */
typedef struct ledge {
    front f;
    unsigned at;
    twin from, to;
    real far;
} ledge;

/* Of those that are as low but for the doubt the lowest. */
static void lowest_finely(const difference *d, const scene *k, const ring *o, const shape *a, const shape *b,
                          ledge *best)
{
    const ring_real low = o->far[lowest_of_ring(o)] + 8 * (ring_real)d->doubt;
    ledge e = *best;
    best->far = REAL_MAX;
    for (unsigned i = 0; i < o->count; i++) {
        if (o->far[i] > low) continue;
        stand_in_ring(d, k, o, i, &e.f);
        e.at = i;
        e.from = height_finely(d, k, e.f.v, &e.f.p, a, b);
        e.to = height_finely(d, k, e.f.v, &e.f.q, a, b);
        e.far = smaller(-e.from.high - e.from.low, -e.to.high - e.to.low);
        if (e.far < best->far) *best = e;
    }
}

/* How much lower along v than the first corner of the edge another one of the body lies, to twice the digits. */
static real fall_finely(const difference *d, const scene *k, const ledge *e, int of_b, const shape *a, const shape *b)
{
    const front *f = &e->f;
    const real margin = d->doubt * length(f->v);
    const cluster *p = of_b ? &k->b : &k->a;
    unsigned near = near_corners(p, of_b ? in_b(&f->p) : in_a(&f->p), of_b ? f->v : mul(f->v, -1), margin);
    real fall = 0;
    for (; near != 0; near &= near - 1) {
        const unsigned nth = first_bit(near);
        const spot at = spot_at(d, k, of_b ? in_a(&f->p) + PLACES * nth : nth + PLACES * in_b(&f->p));
        const twin h = at.at == f->q.at ? e->to : height_finely(d, k, f->v, &at, a, b);
        fall = larger((e->from.high - h.high) + (e->from.low - h.low), fall);
    }
    return fall;
}

/* How deep, from the edge and the corner asked for last on, which hold the origin. 0: they hardly overlap, and it is
 * not known that they touch; or rounding leaves open beyond which edge nothing lies. */
static APART int tell_deep(search *q, const scene *k, front own, int framed, const shape *a, const shape *b,
                           const goal *g, result *r)
{
    const difference *d = &q->d;
    ledge e = {.f = own};
    ring o;
    if (!grow_planar_ring(d, k, &e.f, g, &o)) return 0;
    if (!(o.far[lowest_of_ring(&o)] > 4 * (ring_real)d->doubt))
        return g->radius == 0 && tell_touching(q, k, e.f, framed, a, b, g, r);
    lowest_finely(d, k, &o, a, b, &e);
    front *f = &e.f;
    const real fall = fall_finely(d, k, &e, 0, a, b) + fall_finely(d, k, &e, 1, a, b);
    const real blur = blur_of(d), broad = d->doubt / PLANAR_DOUBT / 2 + (a->radius + b->radius) * d->scale;
    verdict t = {.v = f->v, .l = length(f->v), .value = gap_of(d, e.from, a, b)};
    stand_in_ring(d, k, &o, edge_beside(&o, e.at), f);
    const closest pair = pair_at_front(d, k, f, share_of_edge(f));
    place_verdict(k, &pair, &t);
    t.lower = e.from.high + (e.from.low - fall - 3 * blur - 2 * UNIT * size(e.from.high));
    t.upper = blur + 3 * UNIT * e.far - e.far;
    if (!(e.far > 3 * d->doubt && fall <= UNIT * broad && t.upper - t.lower <= BROAD * broad)) return 0;
    if (!(spread(sub(t.way, mul(t.v, e.from.high / t.l))) <= BROAD / 2 * broad)) return 0; /* the pair is beside it */
    return spell_in_full(q, t, f->steps, 2, a, b, r);
}

/* What the corner asked for last shows, where it is only asked whether they meet: that they are apart. The line of
 * centres, along which that was first, may be too short to be a direction. */
HOT int is_apart(const difference *d, const front *f, const goal *g)
{
    const real least = d->doubt + g->radius * d->scale, height = dot(f->way, f->last.w);
    if (!(height > 0)) return 0;
    const real l = length(f->way);
    return height > least * l && l > d->doubt * (UNIT / PLANAR_DOUBT);
}

HOT int tell_apart_at(search *q, const scene *k, const front *f, int framed, const shape *a, const shape *b,
                      const goal *g, result *r)
{
    const spot *p = &f->last;
    verdict t = {.v = f->way, .l = length(f->way), .way = p->w, .value = 0};
    t.lower = dot(f->way, p->w) / t.l - q->d.doubt;
    t.upper = length(p->w) * (1 + 8 * UNIT) + q->d.doubt;
    t.a = place_of(&k->a, in_a(p));
    t.b = place_of(&k->b, in_b(p));
    return t.lower > 0 && spell_verdict(q, &t, f, framed, a, b, g, r);
}

/* That they are farther apart than is asked, if that is asked. */
HOT int shows_beyond(const difference *d, const front *f, const goal *g)
{
    if (g->sign_only || g->beyond == REAL_MAX) return 0;
    return dot(f->way, f->last.w) > (g->beyond * d->scale + EVIDENT * d->doubt) * length(f->way);
}

/* The front is so near that the radii meet. */
HOT int is_within(const difference *d, const front *f, const goal *g)
{
    if (!g->sign_only) return 0;
    const real within = g->radius * d->scale - EVIDENT * d->doubt, height = dot(f->v, f->p.w);
    return within > 0 && height < within * length(f->v);
}

/* ---- the walk ---- */

HOT enum halt walk_front(const difference *d, const scene *k, front *f, const goal *g)
{
    const real least = d->doubt * (UNIT / PLANAR_DOUBT);
    for (;;) {
        f->ended = f->n > 0 && !(dot(f->v, f->v) > least * least); /* it has no direction */
        if (f->ended || f->steps >= ASKED_MOST || f->steps >= g->max_steps) return LOST;
        ask_ahead(d, k, f);
        if (g->sign_only && is_apart(d, f, g)) return SHOWN;
        if (f->n > 0) {
            f->ended = is_foremost(d, k, f);
            if (f->ended || shows_beyond(d, f, g) || is_within(d, f, g)) return FOREMOST;
        }
        f->around = !turn_front(k, f);
        if (f->around) return AROUND;
    }
}

/* Where this walk was left, if that is where another may go on. */
static APART void leave_front(search *q, const scene *k, front f, const shape *a, const shape *b)
{
    q->found.at.count = 0;
    if (!f.around && !f.ended) return;
    blank(q);
    q->lower = -REAL_MAX;
    q->d.slack = 0;
    if (f.steps > 0) raise(q, f.way, f.last.w);
    keep_front(&q->found.at, q, k, &f, a, b);
    q->found.steps = f.steps;
    q->found.calls = 2 * f.steps;
    q->found.lower = q->lower * q->d.unscale;
    q->found.normal = q->normal;
}

/* 0: nothing is told. */
HOT int look_at_planar(search *q, cache *own, int framed, const shape *a, const shape *b, const goal *g, result *r)
{
    const difference *d = &q->d;
    scene k;
    front f;
    q->found.at.count = 0;
    list_places(&d->a, &k.a);
    list_places(&d->b, &k.b);
    if (!place_corners(&d->a, framed, &k.a) || !place_corners(&d->b, framed, &k.b)) return 0;
    const int lent = own && lends(own, a, b);
    f.n = f.steps = f.around = f.ended = 0;
    if (lent && !recall(d, &k, framed, &f, own)) {
        if (g->deep) return 0; /* to the walk, which knows what was lent */
        f.n = 0;
    }
    const int recalled = f.n;
    if (!recalled) f.v = mul(d->c, -1);
    const enum halt at = walk_front(d, &k, &f, g);
    int told = at == SHOWN      ? tell_apart_at(q, &k, &f, framed, a, b, g, r)
               : at == FOREMOST ? tell_front(q, &k, &f, framed, a, b, g, r)
               : at == AROUND   ? g->deep ? !HAS_SISTER && tell_deep(q, &k, f, framed, a, b, g, r)
                                          : tell_held(q, &k, &f, framed, a, b, g, r)
                                : 0;
    if (!told) told = tell_touching(q, &k, f, framed, a, b, g, r);
    if (told && f.n == 0) stand_on_corner(&f, f.last);
    if (!told) leave_front(q, &k, f, a, b);
    else if (own && !(recalled && is_kept(own, &f))) hand_on_front(own, q, &k, f, a, b);
    return told;
}

/* The same, for the few that ask anything else. */
static APART int look_in_full(search *q, cache *own, int framed, const shape *a, const shape *b, const goal *g,
                              result *r)
{
    return look_at_planar(q, own, framed, a, b, g, r);
}

/* ---- the doubt ---- */

/* Without a frame. 0: the sizes are none for that. */
HOT int settle_outside(difference *d, const shape *a, const shape *b)
{
    real map[2];
    stay_outside(d, a, b);
    if (!doubt_outside(d, a, b, square_of_reach(&d->a, 1), square_of_reach(&d->b, 1), PLANAR_DOUBT, map)) return 0;
    d->a.norm = root(map[0]);
    d->b.norm = root(map[1]);
    return 1;
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
    d->a.norm = root(map_a) / level_a;
    d->b.norm = root(map_b) / level_b;
    if (look_in_full(q, own, 1, a, b, g, r)) return 1;
    const find found = q->found;
    *q = before;
    q->found = found;
    return 0;
}

/* ---- the door ---- */

/* Without a frame, if they are polygons and that will do. */
static APART enum glanced tell_planar(search *q, const shape *a, const shape *b, const options *o, const goal *g,
                                      result *r)
{
    know_reach_listed(&q->d.a);
    know_reach_listed(&q->d.b);
    if (!settle_outside(&q->d, a, b)) return UNCLEAR;
    return look_in_full(q, o->cache, 0, a, b, g, r) ? TELLING : IN_VAIN;
}

static inline void tell_polygons(search *q, const shape *a, const shape *b, const options *o, const goal *g, result *r)
{
    if (q->planar == UNTRIED) q->found.at.count = 0;
    if (q->told || !q->listed || q->thin != UNTRIED || !are_planar(&q->d)) return;
    if (q->planar == UNTRIED) q->planar = tell_planar(q, a, b, o, g, r);
    q->told = q->planar == TELLING;
}

/* A polygon of few corners, and all that is known of it. 0: it is none. */
HOT int list_polygon(body *k, const shape *s)
{
    const points *p = s->data;
    if (s->support != pub(support_points) || !p || !p->v) return 0;
    const size_t step = stride_of(p);
    if (p->count - 3 > PLACES - 3 || step < DIM || p->stride % sizeof(real) != 0 || !(p->reach > TINY)) return 0;
    k->posed = s->pose != NULL;
    if (k->posed) k->m = s->pose->m;
    k->asked = AS_LIST;
    k->list = (list){p->v, p->count, step, p->reach, NULL};
    k->reach = p->reach;
    k->limit = p->reach * (1 + 16 * UNIT); /* that of know_reach, of plain sizes */
    return 1;
}

/* Without a frame, as settle_outside has it, but for what polygons are not. */
HOT int settle_polygons(difference *d, const shape *a, const shape *b)
{
    stay_outside(d, a, b);
    const real set_a = square_of_reach(&d->a, 1), map_a = square_of_map(&d->a, squared_axes(&d->a, 1));
    const real set_b = square_of_reach(&d->b, 1), map_b = square_of_map(&d->b, squared_axes(&d->b, 1));
    const real square = map_a * set_a + map_b * set_b + dot(d->c, d->c);
    d->doubt = PLANAR_DOUBT * root(square);
    d->a.norm = root(map_a);
    d->b.norm = root(map_b);
    return smaller(smaller(map_a, map_b), smaller(set_a, set_b)) > 1 / PLAIN && are_of_plain_size(square, a, b);
}

/* The everyday question of two polygons: how far apart, or whether they meet. 0: it is left to the whole answer, which
 * goes on from there. */
HOT int tell_at_once(search *q, const shape *a, const shape *b, const options *o, int sign_only, int deep, result *r)
{
    q->planar = UNTRIED;
    q->flat = UNTRIED;
    if (!HAS_SISTER && (!list_polygon(&q->d.a, a) || !list_polygon(&q->d.b, b))) return 0;
    const uint32_t most = deep ? DEEP_ASKED_MOST : ASKED_MOST;
    const goal g = {.beyond = REAL_MAX,
                    .radius = a->radius + b->radius,
                    .sign_only = sign_only,
                    .deep = deep,
                    .max_steps = (int)(o && o->max_steps != 0 && o->max_steps < most ? o->max_steps : most)};
    if (HAS_SISTER) {
        q->flat = IN_VAIN;
        if (!tell_flat(a, b, o ? o->cache : NULL, &g, r)) return 0;
        say_plainly(r, sign_only, deep);
        return 1;
    }
    q->planar = UNCLEAR;
    q->found.at.count = 0;
    if (!settle_polygons(&q->d, a, b)) return 0;
    q->planar = IN_VAIN;
    if (!look_at_planar(q, o ? o->cache : NULL, 0, a, b, &g, r)) return 0;
    say_plainly(r, sign_only, deep);
    return 1;
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

/* In the frame, where it was not clear without. What is left is gone on with from there. */
static inline int tell_polygons_in_frame(search *q, const shape *a, const shape *b, const options *o, const goal *g,
                                         result *r)
{
    if (q->planar == UNCLEAR) {
        q->planar = tell_planar_in_frame(q, o->cache, a, b, g, r) ? TELLING : IN_VAIN;
        q->told = q->planar == TELLING;
    }
    if (q->told || q->found.at.count == 0) return q->told;
    q->told = !g->deep && tell_found(q, a, b, r);
    if (q->told && o->cache) pass_on(o->cache, &q->found.at);
    if (q->found.steps >= g->max_steps) q->found.at.count = 0;
    return q->told;
}
#else
#define WHOLE inline
#define are_planar(d) 0
#define tell_flat(a, b, own, g, r) 0
#define tell_at_once(q, a, b, o, sign_only, deep, r) ((q)->planar = (q)->flat = UNTRIED, 0)
#define tell_polygons(q, a, b, o, g, r) ((void)0)
#define tell_polygons_in_frame(q, a, b, o, g, r) 0
#endif

#endif
