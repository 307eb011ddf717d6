/* SPDX-License-Identifier: MIT */
/* Thin cores: points and segments, which balls and capsules have, and a point beside a box or in it. A formula tells
 * which of their points are nearest. Nothing of it is taken on trust: how much lower any corner may lie along the way
 * between these points bounds what the formula may have missed (docs/bounds.md). All that is done in the caller's own
 * lengths; in the frame if they are not plain, to the same bits. What rounding leaves open is left to the walk. */
#ifndef GJK_CORE_THIN_H
#define GJK_CORE_THIN_H

#include "axes.h"

/* Two points, and what they show. */
typedef struct sight_of_two {
    closest pair;
    vec a, b;    /* these points, from the bodies' positions */
    vec low;     /* what their corner lost to rounding */
    vec v;       /* the way from b to a; of a point in a box the way out */
    real l;      /* its length */
    real lies;   /* by so much lower than the pair does a corner lie along v, */
    real fall;   /*   by no more than that for certain */
    real edge;   /* how long edges are that lead there */
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

/* The square of the set's reach, times that grain. */
static inline real square_of_thin(const body *k, real grain)
{
    if (k->asked == AS_BOX) return square_of_reach(k, grain);
    const vec x = mul(first_end(k), grain), y = mul(last_end(k), grain);
    return larger(dot(x, x), dot(y, y));
}

/* The way between them. What only tells whether they meet needs no more digits. */
static inline void sight_pair(const difference *d, const goal *g, sight_of_two *e)
{
    e->pair.w = sub(e->a, add(e->b, d->c));
    e->low = g->sign_only ? axis(0, 0) : lost_of_pair(d, &e->pair);
    e->v = add(e->pair.w, e->low);
    e->l = length(e->v);
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

/* ---- points and segments ---- */

typedef struct stick {
    vec end[2]; /* in its own coordinates, times their grain, */
    vec at[2];  /* and placed */
    vec way;    /* from the first to the second, */
    real ll;    /* its square, */
    real per;   /* and 1 by that; 0 of a point */
} stick;

static inline stick stick_of(const body *k)
{
    stick s;
    s.end[0] = mul(first_end(k), k->grain);
    s.end[1] = mul(last_end(k), k->grain);
    s.at[0] = mapped(k, s.end[0]);
    s.at[1] = mapped(k, s.end[1]);
    s.way = mapped(k, sub(s.end[1], s.end[0]));
    s.ll = dot(s.way, s.way);
    s.per = s.ll > 0 ? 1 / s.ll : 0;
    return s;
}

/* Its square does not underflow, if it is none to be left out. */
static inline int is_of_length(const stick *k, const difference *d)
{
    const real least = UNIT * UNIT * (d->doubt / GLANCE_DOUBT);
    return !(peak(k->way) > 0) || k->ll > least * least;
}

static inline real within_way(real share) { return larger(smaller(share, 1), 0); }

/* Of the way from the first end to the second the shares at which the sticks are nearest: where their lines are, if
 * that is on them; and the one's nearest to the other's, which also is the answer of parallel ones (Ericson 2005,
 * 5.1.9). */
static inline void nearest_shares(const stick *a, const stick *b, vec c, real *s, real *t)
{
    const vec r = sub(a->at[0], add(b->at[0], c));
    const real ab = dot(a->way, b->way), ar = dot(a->way, r), br = dot(b->way, r);
    const real on = ab * b->per, whole = a->ll - on * ab;
    *s = whole > PARALLEL * a->ll ? within_way((on * br - ar) / whole) : (real)0.5;
    *t = within_way((ab * *s + br) * b->per);
    *s = within_way((ab * *t - ar) * a->per);
}

/* The point at that share of the way, from the end that is nearer, placed; and what it is in its own coordinates. */
static inline vec point_at(const stick *k, real share, int exactly, vec *x, vec *low)
{
    const int far = share > (real)0.5;
    const real part = far ? 1 - share : share;
    if (exactly) {
        const vec from = k->end[far], to = k->end[!far];
        for (int i = 0; i < DIM; i++) {
            const twin t = sum_of(from.c[i], (to.c[i] - from.c[i]) * part);
            x->c[i] = t.high;
            low->c[i] = t.low;
        }
    }
    return add(k->at[far], mul(k->way, far ? -part : part));
}

/* The length of what rounding is a share of in the way from end to end. */
static inline real edge_of(const body *k, const stick *e)
{
    const vec way = sub(e->end[1], e->end[0]);
    return k->posed ? length(map_size(k->m, way)) : length(way);
}

static inline void sight_sticks(const difference *d, const goal *g, sight_of_two *e)
{
    const stick a = stick_of(&d->a), b = stick_of(&d->b);
    real s, t, edge_a = 0, edge_b = 0;
    e->inside = 0;
    nearest_shares(&a, &b, d->c, &s, &t);
    e->a = point_at(&a, s, !g->sign_only, &e->pair.x, &e->pair.x_low);
    e->b = point_at(&b, t, !g->sign_only, &e->pair.y, &e->pair.y_low);
    sight_pair(d, g, e);
    if (!g->sign_only) {
        edge_a = edge_of(&d->a, &a);
        edge_b = edge_of(&d->b, &b);
    }
    const real rise_a = dot(e->v, a.way) / e->l, rise_b = -dot(e->v, b.way) / e->l;
    e->fall = fall_along(rise_a, lost_of_rise(edge_a, rise_a), s, 1 - s) +
              fall_along(rise_b, lost_of_rise(edge_b, rise_b), t, 1 - t);
    e->lies = fall_along(rise_a, 0, s, 1 - s) + fall_along(rise_b, 0, t, 1 - t);
    e->edge = edge_a + edge_b;
    e->off = UNIT * e->edge * (real)1.125;
    if (!is_of_length(&a, d) || !is_of_length(&b, d)) e->l = 0;
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

static inline int way_out(vec x, vec e)
{
    int out = 0;
    REST(out = e.c[i] - size(x.c[i]) < e.c[out] - size(x.c[out]) ? i : out);
    return out;
}

static inline vista look_from_box(const difference *d, real level)
{
    const int of_a = d->a.asked == AS_BOX;
    vista k = {.box = of_a ? &d->a : &d->b, .other = of_a ? &d->b : &d->a, .level = level, .out = -1};
    k.point = mul(first_end(k.other), k.other->grain);
    k.at = of_a ? add(mapped(k.other, k.point), d->c) : sub(mapped(k.other, k.point), d->c);
    k.half = mul(load(((const box *)k.box->data)->half), k.box->grain);
    k.uu = squared_axes(k.box, level);
    const vec seen = k.box->posed ? pull(k.box->m, mul(k.at, level)) : k.at;
    EACH(k.x.c[i] = seen.c[i] * level / k.uu.c[i]);
    if (same(clamped(k.x, k.half), k.x) && room_at(k.x, k.half) > 0) k.out = way_out(k.x, k.half);
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
    return take_off(&own) ? skew_of(&own, 0) : 1;
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

/* By how much a corner of the box may lie below the foot along v, where the axes rise so much along it; exactly: for
 * certain, none being longer than that. */
static inline real fall_of_box(vec rise, real longest, int exactly, vec half, vec foot)
{
    real fall = 0;
    for (int i = 0; i < DIM; i++) {
        const real err = exactly ? UNIT * 4 * (longest + size(rise.c[i])) : 0; /* the product alone, and as above */
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

static inline void sight_box(const difference *d, const goal *g, real level, sight_of_two *e)
{
    vista k = look_from_box(d, level);
    const int of_a = k.box == &d->a, leaves = k.out >= 0 && g->deep;
    const real toward = of_a ? -1 : 1; /* the box, along v */
    vec foot = clamped(k.x, k.half);
    if (leaves) foot.c[k.out] = signed_as(k.half.c[k.out], k.x.c[k.out]);
    e->pair.x = of_a ? foot : k.point;
    e->pair.y = of_a ? k.point : foot;
    e->pair.x_low = e->pair.y_low = axis(0, 0);
    e->a = mapped(&d->a, e->pair.x);
    e->b = mapped(&d->b, e->pair.y);
    e->inside = k.out >= 0;
    sight_pair(d, g, e);
    if (e->inside) sight_way_out(&k, toward, e);
    const vec rise = mul(k.box->posed ? pull(k.box->m, e->v) : e->v, toward / e->l);
    const real longest = g->sign_only ? 0 : root(peak(k.uu)) / level;
    e->fall = fall_of_box(rise, longest, !g->sign_only, k.half, foot);
    e->lies = fall_of_box(rise, longest, 0, k.half, foot);
    e->edge = 2 * longest * spread(k.half);
    e->off = 0;
    if (!e->inside) return;
    e->height = height_to_twice(e->v, e->pair.w, e->low);
    e->deep = sure_room(&k, leaves, -e->height.high, d->doubt);
    e->broad = peak(k.half) / k.level;
    if (leaves) return;
    *(of_a ? &e->a : &e->b) = k.at; /* the point itself is that of both */
}

/* ---- telling ---- */

/* By so many roundings of the edges a corner may seem to lie lower than the pair, which is nearest then. */
#define LIES (4 * UNIT)

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
    if (!(l.high * l.high > UNIT * (whole * whole)) || !(e->lies <= LIES * e->edge)) return 0;
    const real broad = e->inside ? e->broad : whole / 2;
    return !g->deep || *lower > g->radius || *upper - *lower <= BROAD * (broad + g->radius);
}

/* The same where it is only asked whether they meet: all of the doubt is charged. 0: the way between is noise. */
static inline int bound_roughly(const difference *d, const sight_of_two *e, real *lower, real *upper)
{
    *lower = (e->inside ? e->height.high : e->l) - e->fall - d->doubt;
    *upper = e->inside ? -e->deep : e->l * (1 + 8 * UNIT) + d->doubt;
    return e->inside ? e->deep > 0 : e->l > d->doubt * (UNIT / GLANCE_DOUBT / 1024);
}

/* What the two points tell. 0: that is not whether the bodies meet, or not how far they are apart. */
static int tell_sight(search *q, const sight_of_two *e, const shape *a, const shape *b, const goal *g, result *r)
{
    const difference *d = &q->d;
    const int rough = g->sign_only || (e->inside && !g->deep);
    real upper;
    if (!(e->l > 0)) return 0;
    r->value = 0;
    if (rough) {
        if (!bound_roughly(d, e, &q->lower, &upper)) return 0;
    } else {
        const twin l = e->inside ? e->height : length_to_twice(e->pair.w, e->low);
        if (!bound_finely(d, e, l, g, &q->lower, &upper)) return 0;
        r->value = gap_of(d, l, a, b);
    }
    bracket(r, d, q->lower, upper, a, b);
    if (!(r->lower > 0) && !(r->upper < 0)) return 0;
    EACH(q->normal.c[i] = 0 - e->v.c[i] / e->l);
    store(r->normal, q->normal);
    move_points(r, q, e->a, e->b, e->pair.w, a, b, g->deep);
    r->steps = 1;
    r->supports = 2;
    r->reserved = 0;
    return 1;
}

static inline int look_at_thin(search *q, real level, const shape *a, const shape *b, const goal *g, result *r)
{
    sight_of_two e;
    if (q->d.a.asked == AS_BOX || q->d.b.asked == AS_BOX) sight_box(&q->d, g, level, &e);
    else sight_sticks(&q->d, g, &e);
    return tell_sight(q, &e, a, b, g, r);
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
    d->a.size = d->b.size = 1; /* not 0, where nothing is known to be rounded */
    d->a.norm = of_a;
    d->b.norm = of_b;
}

/* The doubt without a frame, in units of the root of A^2 + B^2 + c^2, of sets whose squared reaches are these; and the
 * squares of the maps. 0: the sizes are none to do without. */
HOT int doubt_outside(difference *d, const shape *a, const shape *b, real set_a, real set_b, real unit, real map[2])
{
    map[0] = square_of_map(&d->a, squared_axes(&d->a, 1));
    map[1] = square_of_map(&d->b, squared_axes(&d->b, 1));
    const real square = map[0] * set_a + map[1] * set_b + dot(d->c, d->c);
    d->doubt = unit * root(square);
    return is_of_plain_size(&d->a, map[0], set_a) && is_of_plain_size(&d->b, map[1], set_b) && square > 1 / PLAIN &&
           square < PLAIN * PLAIN && a->radius >= 0 && b->radius >= 0 && a->radius + b->radius < PLAIN;
}

/* Without a frame. UNCLEAR: the sizes are none for that. */
static enum glanced tell_thin(search *q, const shape *a, const shape *b, const goal *g, result *r)
{
    difference *d = &q->d;
    stay_outside(d, a, b);
    d->slack = 0;
    real map[2];
    if (!doubt_outside(d, a, b, square_of_thin(&d->a, 1), square_of_thin(&d->b, 1), GLANCE_DOUBT, map)) return UNCLEAR;
    if (!g->sign_only) {
        know_norms(d, root(map[0]), root(map[1]));
        know_offset(d, a, b);
    }
    const real level = d->a.asked == AS_BOX ? leveler(root(map[0])) : d->b.asked == AS_BOX ? leveler(root(map[1])) : 1;
    return look_at_thin(q, level, a, b, g, r) ? TELLING : IN_VAIN;
}

/* In the frame, where the sizes were none to do without. */
static APART int tell_thin_in_frame(search *q, const shape *a, const shape *b, const goal *g, result *r)
{
    const difference before = q->d;
    difference *d = &q->d;
    const real level_a = level_of_map(&d->a), level_b = level_of_map(&d->b);
    const real map_a = square_of_map(&d->a, squared_axes(&d->a, level_a));
    const real map_b = square_of_map(&d->b, squared_axes(&d->b, level_b));
    const real set_a = square_of_thin(&d->a, d->a.grain / level_a), set_b = square_of_thin(&d->b, d->b.grain / level_b);
    d->doubt = GLANCE_DOUBT * root(map_a * set_a + map_b * set_b + dot(d->c, d->c)) + (d->wild ? d->lost : 0);
    know_norms(d, root(map_a) / level_a, root(map_b) / level_b);
    know_offset(d, a, b);
    if (look_at_thin(q, d->a.asked == AS_BOX ? level_a : level_b, a, b, g, r)) return 1;
    blank(q);
    *d = before;
    return 0;
}

#endif
