/* SPDX-License-Identifier: MIT */
/* Thin cores: points and segments, which balls and capsules have, and a point beside a box or in it. A formula tells
 * which of their points are nearest. Nothing of it is taken on trust: how much lower any corner may lie along the way
 * between these points bounds what the formula may have missed (docs/bounds.md). All that is done in the caller's own
 * lengths; in the frame if they are not plain, to the same bits. What rounding leaves open is left to the walk. */
#ifndef GJK_CORE_THIN_H
#define GJK_CORE_THIN_H

#include "axes.h"
#include "duo.h"

/* Two points, and what they show. */
typedef struct sight_of_two {
    vec a, b;    /* these points, from the bodies' positions */
    vec w;       /* their corner */
    vec low;     /* what it lost to rounding */
    vec v;       /* the way from b to a; of a point in a box the way out */
    real l;      /* its length */
    real lies;   /* by so much lower than the pair does a corner lie along v, */
    real fall;   /*   by no more than that for certain, */
    real most;   /*   and by so much it may seem to, though the pair is nearest */
    real off;    /* so far the pair may be off the bodies */
    int inside;  /* of a point in a box: */
    twin height; /*   of the pair along v, below 0; */
    real broad;  /*   how large the box is, */
    real deep;   /*   so deep it is in there for certain; 0: that is not known */
} sight_of_two;

/* ---- the bodies ---- */

static inline int is_point(const body *k) { return k->asked == AS_LIST && k->list.count == 1; }

/* Two bodies listed, which a formula knows. */
static inline int are_thin(const difference *d)
{
    if (is_thin(&d->a)) return is_thin(&d->b) || (is_point(&d->a) && d->b.asked == AS_BOX);
    return is_point(&d->b) && d->a.asked == AS_BOX;
}

static inline vec first_end(const body *k) { return load(k->list.v); }

static inline vec last_end(const body *k) { return nth_of(&k->list, k->list.count - 1); }

/* A cloud's points are numbers, and within the reach that it says; of what else is thin nobody says any. */
static inline int are_ends_within(body *k)
{
    if (k->asked == AS_BOX || k->list.reach == 0) return 1;
    know_reach(k, k->list.reach);
    return fits(k, first_end(k)) && fits(k, last_end(k));
}

/* The square of the set's reach, times that grain and by, one after the other. */
static inline real square_of_thin(const body *k, real grain, real by)
{
    if (k->asked == AS_BOX) return square_of_reach(k, grain, by);
    const vec x = mul(mul(first_end(k), grain), by), y = mul(mul(last_end(k), grain), by);
    return larger(dot(x, x), dot(y, y));
}

/* A line rises so much for each length of it, or by err more or less: the most by which an end of it lies below the
 * point that is so far from the ends. */
static inline real fall_along(real rise, real err, real behind, real ahead)
{
    return larger((err + rise) * behind, (err - rise) * ahead);
}

/* What rounding may make of a rise: of an edge the map 3 and the product 3, and 4 of the rise, that of its length and
 * of the quotient; of a segment its ends' difference 1 besides. */
static inline real lost_of_rise(real edge, real rise) { return UNIT * (7 * edge + 4 * size(rise)); }

/* By so many roundings of the edges a corner may seem to lie lower than the pair, which is nearest then; of a stick. */
#define LIES (4 * UNIT)
#define LIES_OF_STICK UNIT

/* ---- points and segments ---- */

/* One of each body, a point or a segment. */
typedef struct sticks {
    duo_map m;   /* their maps, */
    duos end[2]; /* in their own coordinates, times their grain, */
    duos at[2];  /* and placed */
    duos way;    /* from the first to the second, */
    duo ll;      /* its square, */
    duo per;     /* and 1 by that; 0 of a point */
} sticks;

HOT const real *last_of_list(const list *l) { return l->v + (l->count - 1) * l->step; }

/* finely: so that rounding takes from the ways no more than is a share of these. */
HOT void place_sticks(const difference *d, duo grain, int finely, sticks *s)
{
    s->m = duo_map_at(map_of(&d->a), map_of(&d->b));
    s->end[0] = duos_mul(duos_at(d->a.list.v, d->b.list.v), grain);
    s->end[1] = duos_mul(duos_at(last_of_list(&d->a.list), last_of_list(&d->b.list)), grain);
    s->at[0] = duos_mapped(&s->m, s->end[0]);
    s->at[1] = duos_mapped(&s->m, s->end[1]);
    s->way = finely ? duos_mapped(&s->m, duos_sub(s->end[1], s->end[0])) : duos_sub(s->at[1], s->at[0]);
    s->ll = duos_dot(s->way, s->way);
    s->per = duo_where_larger(s->ll, duo_both(0), duo_div(duo_both(1), s->ll), duo_both(0));
}

/* Its square does not underflow, if it is none to be left out. */
HOT int is_of_length(real ll, vec way, real least) { return ll > least * least || !(peak(way) > 0); }

HOT int are_of_length(const sticks *s, const difference *d)
{
    const real least = UNIT * UNIT * (d->doubt / GLANCE_DOUBT);
    return is_of_length(of_a(s->ll), vec_of_a(s->way), least) && is_of_length(of_b(s->ll), vec_of_b(s->way), least);
}

static inline real within_way(real share) { return larger(smaller(share, 1), 0); }

/* Of the way from the first end to the second the shares at which the sticks are nearest: where their lines are, if
 * that is on them; and the one's nearest to the other's, which also is the answer of parallel ones (Ericson 2005,
 * 5.1.9). */
HOT duo nearest_shares(const sticks *k, vec c)
{
    const vec r = sub(vec_of_a(k->at[0]), add(vec_of_b(k->at[0]), c));
    const duo along = duos_dot(k->way, duos_both(r));
    const real ab = dot(vec_of_a(k->way), vec_of_b(k->way)), ar = of_a(along), br = of_b(along);
    const real aa = of_a(k->ll), per_a = of_a(k->per), per_b = of_b(k->per);
    const real on = ab * per_b, whole = aa - on * ab;
    real s = whole > PARALLEL * aa ? within_way((on * br - ar) / whole) : (real)0.5;
    const real t = within_way((ab * s + br) * per_b);
    s = within_way((ab * t - ar) * per_a);
    return duo_of(s, t);
}

/* The points at such shares of the way, from the end that is nearer. */
HOT void place_spots(const difference *d, const sticks *k, duo share, spots *p)
{
    const duo half = duo_both((real)0.5), rest = duo_sub(duo_both(1), share);
    const duo part = duo_where_larger(share, half, rest, share);
    const duo back = duo_where_larger(share, half, duo_sub(duo_both(0), rest), share);
    p->at = duos_add(duos_where_larger(share, half, k->at[1], k->at[0]), duos_mul(k->way, back));
    p->w = corner_at_spots(d, p->at);
    const duos from = duos_where_larger(share, half, k->end[1], k->end[0]);
    const duos to = duos_where_larger(share, half, k->end[0], k->end[1]), way = duos_mul(duos_sub(to, from), part);
    p->x = duos_add(from, way);
    EACH(p->low.c[i] = duo_lost(from.c[i], way.c[i], p->x.c[i]));
}

/* The length of what rounding is a share of in the way from end to end. */
HOT duo edges_of(const sticks *k)
{
    const duos way = duos_sub(k->end[1], k->end[0]);
    duos far;
    EACH(far.c[i] = duos_dot_size(row_of_map(&k->m, i), way));
    return duo_root(duos_dot(far, far));
}

/* As lost_of_rise and fall_along have it, of both. */
HOT duo lost_of_rises(duo edge, duo rise)
{
    return duo_mul(duo_both(UNIT), duo_add(duo_mul(duo_both(7), edge), duo_mul(duo_both(4), duo_size(rise))));
}

HOT real falls_along(duo rise, duo err, duo share)
{
    const duo fall =
        duo_larger(duo_mul(duo_add(err, rise), share), duo_mul(duo_sub(err, rise), duo_sub(duo_both(1), share)));
    return of_a(fall) + of_b(fall);
}

/* How far ends may lie below the points along the way between these. */
HOT void look_along_sticks(const sticks *k, duo share, duo edge, sight_of_two *e)
{
    const duo toward = duo_of(1, -1);
    const duo rise = duo_div(duo_mul(duos_dot(k->way, duos_both(e->v)), toward), duo_both(e->l));
    e->fall = falls_along(rise, lost_of_rises(edge, rise), share);
    e->lies = falls_along(rise, duo_both(0), share);
}

/* So many roundings of the pair may the sticks' points be moved, and by no more than such a share of them; one that is
 * nearer to an end stays where it is. */
#define MOST_SHIFT (8 * UNIT)
#define LEAST_SHARE ((real)0x1p-10)

/* Where shares round, the way between the points is turned by a rounding of the edges over how long it is, and an end
 * may seem to lie lower. So it is made square once more to what it is to be square to: the points are moved by less
 * than their coordinates can show, which counts to what the corner lost. */
static APART sight_of_two shifted(const difference *d, sticks own, duo share, duo edge, sight_of_two e)
{
    const sticks *k = &own;
    const vec way_a = vec_of_a(k->way), way_b = vec_of_b(k->way);
    const real s = of_a(share), t = of_b(share), av = dot(way_a, e.v), bv = dot(way_b, e.v);
    const int free_a = s > 0 && s<1, free_b = t> 0 && t < 1;
    const real ab = dot(way_a, way_b), on = free_b ? ab * of_b(k->per) : 0;
    const real ds = free_a ? ((free_b ? bv * on : 0) - av) / (of_a(k->ll) - on * ab) : 0;
    const real dt = free_b ? (ab * ds + bv) * of_b(k->per) : 0;
    const vec shift = sub(mul(way_a, ds), mul(way_b, dt));
    if (!(size(ds) < LEAST_SHARE && size(dt) < LEAST_SHARE)) return e;
    if (!(spread(shift) <= MOST_SHIFT / GLANCE_DOUBT * d->doubt)) return e;
    e.low = add(e.low, shift);
    e.v = add(e.w, e.low);
    e.l = length(e.v);
    look_along_sticks(k, share, edge, &e);
    return e;
}

HOT void sight_sticks(const difference *d, const sticks *k, sight_of_two *e)
{
    const duo share = nearest_shares(k, d->c), edge = edges_of(k);
    spots p;
    place_spots(d, k, share, &p);
    e->inside = 0;
    e->a = vec_of_a(p.at);
    e->b = vec_of_b(p.at);
    e->w = p.w;
    e->low = lost_of_spots(d, &k->m, &p);
    e->v = add(e->w, e->low);
    e->l = are_of_length(k, d) ? length(e->v) : 0;
    look_along_sticks(k, share, edge, e);
    const real edges = of_a(edge) + of_b(edge);
    e->most = LIES_OF_STICK * edges;
    e->off = UNIT * edges * (real)1.125;
    if (!(e->lies <= e->most)) *e = shifted(d, *k, share, edge, *e);
}

/* ---- a point and a box ---- */

/* A point seen from a box. */
typedef struct vista {
    const body *box, *other;
    vec point; /* in its own coordinates, times their grain */
    vec at;    /* and from the box's position */
    vec half;  /* the box's, times its grain */
    vec uu;    /* its axes' squares, its map times that level, a power of two */
    real level;
    vec x;   /* the point along these axes, */
    int out; /* which it is nearest to leave the box along; -1: it is not in it */
} vista;

/* In a box's coordinates, of a pair so large, what is below this is of no account: in another unit, or in the frame, it
 * may have underflown, and nothing may be told by its sign or by its not being 0. */
static inline real least_of_note(real whole, real level) { return UNIT * UNIT * (whole * level); }

/* What there is of a point's coordinates then. */
static inline vec noted(vec x, real least)
{
    EACH(x.c[i] = unless_below(x.c[i], least));
    return x;
}

static inline int way_out(vec x, vec e)
{
    int out = 0;
    REST(out = e.c[i] - size(x.c[i]) < e.c[out] - size(x.c[out]) ? i : out);
    return out;
}

static inline vista look_from_box(const difference *d, real level, vec uu)
{
    const int of_a = d->a.asked == AS_BOX;
    vista k;
    k.box = of_a ? &d->a : &d->b;
    k.other = of_a ? &d->b : &d->a;
    k.level = level;
    k.out = -1;
    k.point = mul(first_end(k.other), k.other->grain);
    k.at = of_a ? add(mapped(k.other, k.point), d->c) : sub(mapped(k.other, k.point), d->c);
    k.half = mul(load(((const box *)k.box->data)->half), k.box->grain);
    k.uu = uu;
    const vec seen = k.box->posed ? pull(k.box->m, mul(k.at, level)) : k.at;
    const real least = least_of_note(d->doubt / GLANCE_DOUBT, level);
    EACH(k.x.c[i] = seen.c[i] * level / k.uu.c[i]);
    if (room_at(k.x, k.half) > least) {
        k.x = noted(k.x, least);
        k.out = way_out(k.x, k.half);
    }
    return k;
}

/* How skew the box's axes are, which are brought to length 1 if that is a power of two away; as much as any if not. */
static real skew_of_box(vista *k)
{
    const real first = root(k->uu.c[0]), by = leveler(first * (1 + LENGTH_OFF));
    gauge own;
    if (!k->box->posed) return 0;
    if (!(first > UNIT && first < 1 / UNIT)) return 1;
    k->level *= by;
    k->uu = mul(k->uu, by * by);
    own.uu[0] = own.uu[1] = k->uu;
    EACH(for (int j = 0; j < DIM; j++) own.u[i].c[j] = k->box->m[DIM * j + i] * k->level);
    take_off(&own);
    return own.off <= LENGTH_OFF ? skew_of(&own, 0) : 1;
}

/* How far from the box's sides the point is for certain, if it is in it; 0: it is not known to be. From the side that
 * it is nearest to it is out, if that is told; 0, if another may be as near, the one across among them, or the axes are
 * too skew for that. */
static real sure_room(vista *k, int told, real out, real doubt)
{
    const real skew = skew_of_box(k), off = spread(sub(mapped(k->box, k->x), k->at)) + doubt;
    real least = REAL_MAX;
    for (int i = 0; i < DIM; i++) {
        const int across = told && i == k->out; /* the other side is farther, as the middle is off */
        const real far = across ? size(k->x.c[i]) : k->half.c[i] - size(k->x.c[i]);
        const real room = far / k->level * (1 - skew) - off;
        if (!(room > 0)) return 0;
        if (!across) least = smaller(room, least);
    }
    if (!told) return least;
    return skew < 256 * UNIT && out < least ? out : 0;
}

/* By how much a corner of the box may lie below the foot along v, where the axes, none longer than that, rise so much
 * along it; 0: by how much it seems to. */
static inline real fall_of_box(vec rise, real longest, vec half, vec foot)
{
    real fall = 0;
    for (int i = 0; i < DIM; i++) {
        const real err = longest > 0 ? UNIT * 4 * (longest + size(rise.c[i])) : 0; /* the product, and as above */
        fall += fall_along(-rise.c[i], err, half.c[i] + foot.c[i], half.c[i] - foot.c[i]);
    }
    return fall;
}

/* The way out of the box, if the point is in it. */
static inline void sight_way_out(const vista *k, real toward, sight_of_two *e)
{
    e->v = mul(mapped(k->box, axis(k->out, 1)), signed_as(1, k->x.c[k->out]) * toward);
    e->l = length(e->v);
}

static inline void sight_box(const difference *d, const goal *g, real level, vec uu, sight_of_two *e)
{
    vista k = look_from_box(d, level, uu);
    const int of_a = k.box == &d->a, leaves = k.out >= 0 && g->deep;
    const real toward = of_a ? -1 : 1; /* the box, along v */
    vec foot = clamped(k.x, k.half);
    if (leaves) foot.c[k.out] = signed_as(k.half.c[k.out], k.x.c[k.out]);
    const spots pair = spots_at(d, &d->maps, duos_of(of_a ? foot : k.point, of_a ? k.point : foot));
    e->a = vec_of_a(pair.at);
    e->b = vec_of_b(pair.at);
    e->inside = k.out >= 0;
    e->w = pair.w;
    e->low = lost_of_spots(d, &d->maps, &pair);
    e->v = add(e->w, e->low);
    e->l = length(e->v);
    if (e->inside) sight_way_out(&k, toward, e);
    const vec rise = mul(k.box->posed ? pull(k.box->m, e->v) : e->v, toward / e->l);
    const real longest = root(peak(k.uu)) / level;
    e->fall = fall_of_box(rise, longest, k.half, foot);
    e->lies = fall_of_box(rise, 0, k.half, foot);
    e->most = LIES * (2 * longest * spread(k.half));
    e->off = 0;
    if (!e->inside) return;
    e->height = height_to_twice(e->v, e->w, e->low);
    e->deep = sure_room(&k, leaves, -e->height.high, d->doubt);
    e->broad = peak(k.half) / k.level;
    if (leaves) return;
    *(of_a ? &e->a : &e->b) = k.at; /* the point itself is that of both */
}

/* ---- telling ---- */

/* So many roundings of its size a bracket of the depth may be wide. */
#define BROAD (16 * UNIT)

/* The bounds of the cores from how far apart the pair is, to the digits that it is known to: what is charged besides is
 * what low may be off, and what rounds here. 0: the pair is so near that this is too little, or it is not the nearest,
 * or they meet and others tell the depth better. */
static inline int bound_finely(const difference *d, const sight_of_two *e, twin l, const goal *g, real *lower,
                               real *upper)
{
    const real whole = d->doubt / GLANCE_DOUBT;
    const real blur = e->off + whole * (UNIT / 8) + (d->wild ? d->lost : 0) + 2 * UNIT * size(l.high);
    *lower = l.high + (l.low - e->fall - blur);
    *upper = l.high + (l.low + blur);
    if (e->inside && !(e->deep > 0)) return 0;
    if (!(l.high * l.high > UNIT * (whole * whole)) || !(e->lies <= e->most)) return 0;
    const real broad = e->inside ? e->broad : whole / 2;
    return !g->deep || *lower > g->radius || *upper - *lower <= BROAD * (broad + g->radius);
}

/* The same of a point in a box where it is not asked how deep that is: all of the doubt is charged. */
static inline int bound_inside(const difference *d, const sight_of_two *e, real *lower, real *upper)
{
    *lower = e->height.high - e->fall - d->doubt;
    *upper = -e->deep;
    return e->deep > 0;
}

/* What the two points tell. 0: that is not whether the bodies meet, or not how far they are apart. */
HOT int tell_sight(const difference *d, const sight_of_two *e, const shape *a, const shape *b, const goal *g, result *r)
{
    real lower, upper, value = 0;
    result told;
    if (!(e->l > 0)) return 0;
    if (e->inside && !g->deep) {
        if (!bound_inside(d, e, &lower, &upper)) return 0;
    } else {
        const twin l = e->inside ? e->height : length_by_digits(e->w, length(e->w), e->low);
        if (!bound_finely(d, e, l, g, &lower, &upper)) return 0;
        value = gap_of(d, l, a, b);
    }
    bracket(&told, d, lower, upper, a, b);
    if (!(told.lower > 0) && !(told.upper < 0)) return 0;
    vec normal;
    EACH(normal.c[i] = 0 - e->v.c[i] / e->l);
    r->lower = told.lower;
    r->upper = told.upper;
    r->value = value;
    store(r->normal, normal);
    move_points(r, d, normal, e->a, e->b, e->w, a, b, g->deep);
    r->steps = 1;
    r->supports = 2;
    r->reserved = 0;
    return 1;
}

HOT int tell_sticks(const difference *d, const sticks *k, const shape *a, const shape *b, const goal *g, result *r)
{
    sight_of_two e;
    sight_sticks(d, k, &e);
    return tell_sight(d, &e, a, b, g, r);
}

/* uu: the squares of the box's axes, its map times that level. */
HOT int tell_point_and_box(const difference *d, real level, vec uu, const shape *a, const shape *b, const goal *g,
                           result *r)
{
    sight_of_two e;
    sight_box(d, g, level, uu, &e);
    return tell_sight(d, &e, a, b, g, r);
}

/* ---- the doubt ---- */

static inline int is_nothing(const body *k)
{
    if (k->asked == AS_BOX) return peak(load(((const box *)k->data)->half)) == 0;
    return k->list.count < 3 && peak(first_end(k)) == 0 && peak(last_end(k)) == 0;
}

/* Neither its square nor those of its map's entries underflow, if it is of any size. */
static inline int is_of_plain_size(const body *k, real map, real set)
{
    return map > 1 / PLAIN && (set > 1 / PLAIN || is_nothing(k));
}

/* What it takes to know what rounding took from a pair. */
static inline void know_norms(difference *d, real of_a, real of_b)
{
    d->a.norm = of_a;
    d->b.norm = of_b;
}

/* The square whose root the doubt is made of is plain, and so are the radii. */
HOT int are_of_plain_size(real square, const shape *a, const shape *b)
{
    return square > 1 / PLAIN && square < PLAIN * PLAIN && a->radius >= 0 && b->radius >= 0 &&
           a->radius + b->radius < PLAIN;
}

/* The doubt without a frame, in units of the root of A^2 + B^2 + c^2, of sets whose squared reaches are these; and the
 * squares of the maps and of their axes. 0: the sizes are none to do without. */
HOT int doubt_outside(difference *d, const shape *a, const shape *b, real set_a, real set_b, real unit, real map[2],
                      duos *uu)
{
    lay_maps(d);
    *uu = squares_of_duo_map(&d->maps);
    squares_of_maps(d, duos_sum(*uu), map);
    const real square = map[0] * set_a + map[1] * set_b + dot(d->c, d->c);
    d->doubt = unit * root(square);
    return is_of_plain_size(&d->a, map[0], set_a) && is_of_plain_size(&d->b, map[1], set_b) &&
           are_of_plain_size(square, a, b);
}

/* The square whose root doubts are made of, without a frame, and those of the maps and of the sets. */
HOT real square_of_sticks(const difference *d, const sticks *k, real map[2], real set[2])
{
    const duo sets = duo_larger(duos_dot(k->end[0], k->end[0]), duos_dot(k->end[1], k->end[1]));
    squares_of_maps(d, square_of_duo_map(&k->m), map);
    set[0] = of_a(sets);
    set[1] = of_b(sets);
    return map[0] * set[0] + map[1] * set[1] + dot(d->c, d->c);
}

static APART enum glanced tell_sticks_outside(difference *d, const shape *a, const shape *b, const goal *g, result *r)
{
    sticks k;
    place_sticks(d, duo_both(1), 1, &k);
    real map[2], set[2];
    const real square = square_of_sticks(d, &k, map, set);
    d->doubt = GLANCE_DOUBT * root(square);
    if (!is_of_plain_size(&d->a, map[0], set[0]) || !is_of_plain_size(&d->b, map[1], set[1])) return UNCLEAR;
    if (!are_of_plain_size(square, a, b)) return UNCLEAR;
    know_norms(d, root(map[0]), root(map[1]));
    d->c_low = offset_low(a->pose, b->pose);
    return tell_sticks(d, &k, a, b, g, r) ? TELLING : IN_VAIN;
}

/* None of the axes, whose squares these are, is so short that they have lost digits to underflow. */
HOT int are_axes_whole(vec uu)
{
    int r = 1;
    EACH(r &= uu.c[i] > REAL_MIN / (UNIT * UNIT));
    return r;
}

static APART enum glanced tell_box_outside(difference *d, const shape *a, const shape *b, const goal *g, result *r)
{
    real map[2];
    duos both;
    if (!doubt_outside(d, a, b, square_of_thin(&d->a, 1, 1), square_of_thin(&d->b, 1, 1), GLANCE_DOUBT, map, &both))
        return UNCLEAR;
    know_norms(d, root(map[0]), root(map[1]));
    d->c_low = offset_low(a->pose, b->pose);
    const int of_second = d->b.asked == AS_BOX;
    const vec uu = of_second ? vec_of_b(both) : vec_of_a(both);
    const real level = leveler(of_second ? d->b.norm : d->a.norm);
    if (!are_axes_whole(uu)) return UNCLEAR;
    return tell_point_and_box(d, level, mul(uu, level * level), a, b, g, r) ? TELLING : IN_VAIN;
}

#endif
