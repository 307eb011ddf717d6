/* SPDX-License-Identifier: MIT */
/* What a front of two polygons, and the corner asked for last along it, tell of how far they are apart, or whether they
 * meet (planar.h). */
#ifndef GJK_CORE_PLANAR_TELL_H
#define GJK_CORE_PLANAR_TELL_H

#include "planar_front.h"

#if DIM == 2

/* By more than so many doubts the cores must be apart, or overlap, for more than a verdict; so many a bracket of the
 * distance may be wide. */
#define EVIDENT 2
#define MOST_WIDE 4

/* ---- spelling ---- */

/* What is known of the cores: how far apart at least, along v, of length l, and at most, as these points of theirs are,
 * from the bodies' positions; and in all, the radii taken off. */
typedef struct verdict {
    real lower, upper, value, l;
    vec v, a, b, way;
} verdict;

/* Begins with the way along which they are apart. */
HOT void see_along(verdict *t, vec v)
{
    t->v = v;
    t->l = length(v);
    t->value = 0;
}

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
    /* of turned bodies whole has the reach 1.4 times: a half of it would be more than the bodies are */
    if (deep && !(t.lower > radius) && !(width <= BROAD * (whole * 3 / 8 + radius))) return 0;
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
    verdict t;
    real weight[3];
    see_along(&t, f->way);
    if (framed || !(f->around || f->ended) || f->steps == 0) return 0;
    if (!weigh_front(f, at, weight) || !are_spots_whole(&q->d, k, at, a, b)) return 0;
    if (g->deep && (dot(f->way, f->last.w) != 0 || !are_all_whole(&q->d, k, a, b))) return 0;
    q->lower = -REAL_MAX;
    q->d.slack = 0;
    raise(q, f->way, f->last.w);
    if (!(q->lower > -REAL_MAX)) return 0;
    t.lower = g->deep ? 0 : q->lower; /* so high all of them lie */
    t.upper = 0;
    if (g->deep) t.value = gap_of(&q->d, (twin){0, 0}, a, b);
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
    verdict t;
    see_along(&t, f->way);
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
        const twin far = length_by_digits(t.way, length(t.way), lost_finely(d, k, &pair, a, b));
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
    verdict t;
    see_along(&t, f->way);
    t.upper = d->doubt - inside;
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

#endif

#endif
