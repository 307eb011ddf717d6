/* SPDX-License-Identifier: MIT */
/* The difference A - B = { x - y : x in A, y in B }, seen through support calls: no other file calls user code, but for
 * a couple's two sets and to find a reach (shapes.h, reach.h).
 *
 * The frame: A's own position is the origin, so that where the bodies are in the world costs nothing; everything is
 * scaled by one power of two, which costs nothing either, so that squares and their squares stay within range. A corner
 * of the difference is
 *     w = m_a x - (m_b y + c),   c = p_b - p_a
 *
 * The rounding in it, in units of roundoff and in lengths of the scaled frame, with A = stretch(m_a) reach_a, B alike,
 * stretch bounding every norm of m and of |m| in use (linear.h):
 *     m x: 3 A,   c: |c|,   the two differences: A + 2 (B + |c|)              the corner:      5 A + 5 B + 3 |c|
 *     the support's own licence, short or off the set:                        8 A + 8 B
 *     the direction m^T d is off by 3 stretch |d|, across a set 2 reach wide: 6 A + 6 B
 *     a convex combination of corners, each |w| <= A + B + |c|:               6 A + 6 B + 6 |c|
 * A lower bound pays the first three, an upper bound the first, second and fourth. Both are charged
 *     doubt = 20 A + 20 B + 10 |c|     (16 for a body without pose: no product, no direction to turn) */
#ifndef GJK_CORE_MINKOWSKI_H
#define GJK_CORE_MINKOWSKI_H

#include "duo.h"
#include "shapes.h"
#include "simplex.h"

/* Directions are brought down no farther before they pass through a map, so that none of their digits underflow. */
#define EASE ((real)0.0625)

/* How the body's points are found once its support has answered for the first time, and with that for its data. */
enum asked { BY_CALL, AS_BOX, AS_LIST };

typedef struct body {
    support_fn *support;
    support_in *in; /* of a ready-made round set: asked instead, in the set's own unit */
    const void *data;
    enum asked asked;
    list list; /* then: of its corners */
    real unit; /* a power of two: points and reach are the caller's times that */
    real size; /* to a binade or two, if known before any call; 0: all points are 0; else NaN */
    int posed;
    const real *m; /* the pose's map; where sizes are wild, once the scale is known, from points of size 1 to the
                      scaled frame: */
    real fitted[DIM * DIM];
    real stretch;    /* bounds the pose's map */
    real norm;       /* likewise m */
    real reach;      /* bounds the set's points, in its unit; 0: not known yet */
    real limit;      /* no coordinate of a point is above this */
    real grain;      /* the power of two that the set's points come times: to the frame; where sizes are wild and
                        there is a pose, to size 1 */
    real ease, rest; /* powers of two for directions: to size 1 for m, as far as EASE goes; and the rest of the way */
    real lift;       /* where sizes are wild: up to the set's size */
} body;

typedef struct difference {
    body a, b;
    vec c, c_low;        /* and what rounding took from it */
    real scale, unscale; /* powers of two */
    real doubt;          /* rounding, as derived above; and what is */
    real lost;           /* to underflow, where sizes are wild */
    real slack;          /* what the supports may fall short beyond that, by the caller's word */
    int wild;            /* sizes so large or small that directions need care */
    int loose;           /* a reach was surveyed with slack, which makes it none for other queries */
    int calls;
    duo_map maps; /* the bodies', once the frame is settled, */
    duo grains;   /* and their points', side by side */
} difference;

/* The reach in the caller's unit, and what there is of it. */
static inline real extent(const body *k) { return k->size == 0 ? 0 : k->in ? k->reach / k->unit : k->reach; }

/* Within the reach, and with that finite; the reach not known, just finite. */
static inline int fits(const body *k, vec x)
{
    EACH(if (!(size(x.c[i]) <= k->limit)) return 0);
    return 1;
}

static inline void know_reach(body *k, real reach)
{
    k->reach = reach;
    k->limit = reach > TINY ? smaller(reach * (1 + 16 * UNIT), REAL_MAX) : reach; /* subnormal numbers are slow */
}

static APART vec wild_direction(const body *k, vec dir)
{
    dir = mul(unit_size(dir), k->ease);
    if (k->posed) dir = pull(k->m, dir);
    return mul(levelled(dir), k->lift);
}

/* As the body sees it. */
static inline vec direction_for(const difference *d, const body *k, vec dir)
{
    if (d->wild) return wild_direction(k, dir);
    if (k->posed) dir = pull(k->m, mul(dir, k->ease));
    if (k->asked == BY_CALL) dir = mul(dir, k->rest);
    return peak(dir) > 1 / PLAIN ? dir : levelled(dir); /* 0: flattened by the map, all points equally far */
}

/* The body's point farthest along a direction that it sees, from its support, with the reach; 0 where the answer is no
 * point of a set of that reach. */
static inline int call(difference *d, body *k, vec dir, vec *x, real *reach)
{
    d->calls++;
    *x = nowhere();
    *reach = k->in ? reach_in(k->in, k->unit, k->data, dir, x) : k->support(k->data, dir.c, x->c);
    return is_length(*reach) && fits(k, *x);
}

/* The same, not for the first time; of a list with that care. */
static inline int seek(difference *d, body *k, vec v, enum care care, vec *x)
{
    vec dir = direction_for(d, k, v);
    real reach;
    if (k->asked == BY_CALL) return call(d, k, dir, x, &reach);
    d->calls++;
    *x = k->asked == AS_BOX ? corner_of_box(k->data, dir) : nth_of(&k->list, farthest_apart(&k->list, dir, care));
    return fits(k, *x);
}

/* The squared length of an axis that was turned, and not scaled, is off 1 by no more. */
#define LENGTH_OFF (4096 * UNIT)

/* Brings the body's map to a norm from 1 to 2; it is 1 of a turn, whose norm may be just below. */
static inline real level_of_map(const body *k) { return k->posed ? leveler(k->norm * (1 + LENGTH_OFF)) : 1; }

/* The map of a body that is not turned. */
#if DIM == 2
static const real unturned[DIM * DIM] = {1, 0, 0, 1};
#else
static const real unturned[DIM * DIM] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
#endif

HOT const real *map_of(const body *k) { return k->posed ? k->m : unturned; }

/* What is done with both at once takes their maps and grains from there. */
HOT void lay_maps(difference *d) { d->maps = duo_map_at(map_of(&d->a), map_of(&d->b)); }
/* The squares of both maps, of the sums of their squared entries: 1 where there is none, though that sum is DIM. */
HOT void squares_of_maps(const difference *d, duo sums, real map[2])
{
    map[0] = d->a.posed ? of_a(sums) : 1;
    map[1] = d->b.posed ? of_b(sums) : 1;
}

HOT void lay_grains(difference *d) { d->grains = duo_of(d->a.grain, d->b.grain); }

static void lay_side_by_side(difference *d)
{
    lay_maps(d);
    lay_grains(d);
}

/* The body's point x, times its grain, from the body's position. */
HOT vec mapped(const body *k, vec x) { return k->posed ? map(k->m, x) : x; }

HOT vec place(const body *k, vec x) { return mapped(k, mul(x, k->grain)); }

/* The corner of the difference that two points make, times their grain; or as they are in the sets. */
HOT vec corner_at(const difference *d, vec x, vec y) { return sub(mapped(&d->a, x), add(mapped(&d->b, y), d->c)); }

/* The same of two that are placed, from the bodies' positions. */
HOT vec corner_at_spots(const difference *d, duos at) { return sub(vec_of_a(at), add(vec_of_b(at), d->c)); }

HOT vec corner_of(const difference *d, vec x, vec y) { return sub(place(&d->a, x), add(place(&d->b, y), d->c)); }

/* Adds sign times the body's point x, to twice the digits; x is times its grain, with what rounding took. */
static inline void gather_point(twin sum[DIM], const body *k, real sign, vec x, vec low)
{
    halves h[DIM];
    for (int i = 0; i < DIM; i++) {
        h[i] = halves_of(x.c[i]);
        if (!k->posed) gather(&sum[i], (twin){sign * x.c[i], sign * low.c[i]});
    }
    for (int i = 0; i < DIM && k->posed; i++) {
        twin s = sum[i];
        for (int j = 0; j < DIM; j++) {
            real m = sign * k->m[DIM * i + j];
            twin p = product_of_halves(m, halves_of(m), x.c[j], h[j]);
            p.low += m * low.c[j];
            gather(&s, p);
        }
        sum[i] = s;
    }
}

/* What corner_of(x, y) is, to twice the digits, minus w. */
static vec remainder_of(const difference *d, vec x, vec x_low, vec y, vec y_low, vec w)
{
    twin sum[DIM];
    vec r;
    for (int i = 0; i < DIM; i++) {
        sum[i] = (twin){-w.c[i], -d->c_low.c[i]};
        gather(&sum[i], (twin){-d->c.c[i], 0});
    }
    gather_point(sum, &d->a, 1, x, x_low);
    gather_point(sum, &d->b, -1, y, y_low);
    for (int i = 0; i < DIM; i++) r.c[i] = sum[i].high + sum[i].low;
    return r;
}

static inline int farthest(difference *d, body *k, vec v, vec *x) { return seek(d, k, v, CAREFUL, x); }

/* The corner of the difference that lies least along v. */
static inline int ask_with(difference *d, vec v, enum care care, vertex *p)
{
    if (!seek(d, &d->a, mul(v, -1), care, &p->x) || !seek(d, &d->b, v, care, &p->y)) return 0;
    p->w = corner_of(d, p->x, p->y);
    return 1;
}

static inline int ask(difference *d, vec v, vertex *p) { return ask_with(d, v, CAREFUL, p); }

/* The same for the first time, from the supports, but for w; and the reaches that they tell. */
static int ask_first(difference *d, vec v, vertex *p, real reach[2])
{
    return call(d, &d->a, direction_for(d, &d->a, mul(v, -1)), &p->x, &reach[0]) &&
           call(d, &d->b, direction_for(d, &d->b, v), &p->y, &reach[1]);
}

/* Takes the reach that a support has said, or finds it, and with that whether a cloud is of any size. 0: there is none.
 */
static int measure(difference *d, body *k, real said, real slack)
{
    if (said == 0) d->calls += SURVEY_CALLS;
    if (said == 0 && slack > 0) d->loose = 1;
    know_reach(k, said == 0 ? surveyed(k->support, k->data, slack) : said);
    if (k->asked == AS_LIST && said == 0 && k->reach <= SURVEYED_NOTHING) k->size = 0;
    return k->reach <= REAL_MAX;
}

/* Of directions, so that the heights of a set of size 1 in that unit do not underflow. */
static real lifting(real unit) { return smaller(larger(unit, 1), LIFT); }

/* A number times 0 is 0, unless it is none or not finite. */
static int sound(const shape *s)
{
    if (!s || !s->support || !(s->radius >= 0 && s->radius <= REAL_MAX / 16)) return 0;
    real none = 0;
    for (int i = 0; i < DIM * DIM && s->pose; i++) none += s->pose->m[i] * 0;
    for (int i = 0; i < DIM && s->pose; i++) none += s->pose->p[i] * 0;
    return none == 0;
}

static void seize(body *k, const shape *s)
{
    view set = know(s);
    k->support = s->support;
    k->data = s->data;
    k->asked = s->support == pub(support_points) ? AS_LIST : s->support == pub(support_box) ? AS_BOX : BY_CALL;
    if (k->asked == AS_LIST && s->data) k->list = list_of_cloud(s->data);
    k->in = set.in;
    k->unit = set.in ? own_unit(&set) : 1;
    k->size = set.size;
    k->reach = 0;
    k->limit = REAL_MAX;
    k->stretch = k->grain = k->ease = k->rest = k->lift = 1;
    k->posed = s->pose != NULL;
    if (!k->posed) return;
    k->m = s->pose->m;
    k->stretch = stretch(k->m);
}

/* How directions are brought to size before the reach is known. */
static APART void seize_wild(body *k)
{
    if (!k->in && k->size >= 0) k->lift = lifting(leveler(k->size));
    if (k->stretch > 0 && k->posed) k->ease = larger(leveler(k->stretch), EASE);
}

/* The size is known, and plain, as is the map's. */
static int is_tame(const body *k) { return !unruly(k->stretch) && (k->size == 0 || !unruly(k->size)); }

/* The body's map and its points' grain, where sizes are wild, now that the scale is known. The map is scaled by its
 * exponent, whose size need not be a number of the format; and what underflows all the same has no weight. That of a
 * set of no size moves no point, but whether its entries are short is asked (touch.h): it comes to size 1 as it is. */
static APART void fit_wild(body *k, real scale)
{
    const real level = leveler(k->reach);
    const int e = k->size == 0 ? exponent_of(leveler(k->stretch))
                               : exponent_of(scale) - exponent_of(k->unit) - exponent_of(level);
    k->grain = k->posed ? level : scale / k->unit;
    for (int i = 0; i < DIM * DIM && k->posed; i++) k->fitted[i] = raised(k->m[i], e);
    k->m = k->fitted;
    k->norm = k->posed ? larger(stretch(k->m), REAL_MIN) : 1;
    k->ease = leveler(k->norm);
    k->lift = k->in ? 1 : lifting(level);
}

/* How they are brought to the frame. Where sizes are plain the points take it all. */
static void fit(body *k, real scale, int wild)
{
    if (wild) {
        fit_wild(k, scale);
        return;
    }
    k->grain = k->in ? scale / k->unit : scale;
    k->ease = larger(leveler(k->stretch), EASE);
    k->rest = leveler(k->stretch) / k->ease;
    k->norm = k->stretch;
}

/* Rounding, of bodies that reach so far in the frame, and lie c apart. */
static inline real doubt_of(const difference *d, real a, real b, real c)
{
    return UNIT * ((real)(d->a.posed ? 20 : 16) * a + (real)(d->b.posed ? 20 : 16) * b + 10 * c);
}

/* A slack, and what couples around the one that falls short by it may add to that: 16 UNIT of it each (docs/bounds.md).
 */
#define SLACKENED ((real)1 + (real)0x1p-10)

/* With both reaches known: the scale, and what follows from it. 0 where the pair overflows its number format. */
static int settle(difference *d, real slack)
{
    real far_a = extent(&d->a), far_b = extent(&d->b);
    real a = d->a.stretch * far_a, b = d->b.stretch * far_b, c = spread(d->c), whole = a + b + c;
    if (!(whole <= REAL_MAX / 4)) return 0;
    d->scale = leveler(whole);
    d->unscale = 1 / d->scale;
    d->wild = unruly(d->scale) || (far_a > 0 && unruly(far_a)) || (far_b > 0 && unruly(far_b)) ||
              unruly(d->a.stretch * d->scale) || unruly(d->b.stretch * d->scale);
    fit(&d->a, d->scale, d->wild);
    fit(&d->b, d->scale, d->wild);
    d->c = mul(d->c, d->scale);
    d->c_low = mul(d->c_low, d->scale);
    a *= d->scale;
    b *= d->scale;
    c *= d->scale;
    d->lost = 0;
    if (d->wild) { /* products that underflow here, and in the supports where reaches are faint */
        if (whole < REAL_MIN) d->lost += 64 * TINY * d->scale;
        if (faint(far_a)) d->lost += 64 * TINY * d->scale * larger(1, d->a.stretch);
        if (faint(far_b)) d->lost += 64 * TINY * d->scale * larger(1, d->b.stretch);
    }
    d->doubt = doubt_of(d, a, b, c) + d->lost;
    d->slack = 0; /* and no 0 times infinity */
    if (slack > 0) d->slack = (slack * (d->a.stretch * d->scale) + slack * (d->b.stretch * d->scale)) * SLACKENED;
    d->slack = smaller(d->slack, REAL_MAX);
    lay_side_by_side(d);
    return d->doubt <= REAL_MAX;
}

/* From A's position to B's, in the caller's unit. */
HOT vec offset(const pose *a, const pose *b)
{
    vec from = axis(0, 0), to = axis(0, 0);
    if (a) from = load(a->p);
    if (b) to = load(b->p);
    return sub(to, from);
}

/* What rounding took from it. */
static vec offset_low(const pose *a, const pose *b)
{
    vec r;
    for (int i = 0; i < DIM; i++) r.c[i] = sum_of(b ? b->p[i] : 0, a ? -a->p[i] : 0).low;
    return r;
}

/* About how large the pair is: its cores, and how far they lie from each other. */
static inline real size_of_pair(const shape *a, const shape *b)
{
    return size_through_map(a) + size_through_map(b) + spread(offset(a->pose, b->pose));
}

/* 0 where a map is too large for its norm to be a number. */
static int start(difference *d, const shape *a, const shape *b)
{
    seize(&d->a, a);
    seize(&d->b, b);
    d->c = offset(a->pose, b->pose);
    d->c_low = offset_low(a->pose, b->pose);
    d->scale = 1;
    d->wild = !is_tame(&d->a) || !is_tame(&d->b); /* until known better */
    if (d->wild) {
        seize_wild(&d->a);
        seize_wild(&d->b);
    }
    d->loose = 0;
    return bounded(d->a.stretch) && bounded(d->b.stretch);
}

/* Along the line of centres, from B to A; along the first axis where there is none. */
static vec first_direction(const difference *d)
{
    real far = peak(d->c);
    if (far > EASE && far < 1 / EASE) return mul(d->c, -1); /* it is of a good size */
    return far > 0 && bounded(far) ? mul(unit_size(d->c), -1) : axis(0, 1);
}

/* Cold: the first corner, least along v, which also tells the reaches and with them the scale. */
static int meet(difference *d, vec v, real slack, vertex *p)
{
    real reach[2];
    if (!ask_first(d, v, p, reach)) return 0;
    if (!measure(d, &d->a, reach[0], slack) || !measure(d, &d->b, reach[1], slack) || !settle(d, slack)) return 0;
    /* now that directions are lifted */
    if (!(d->a.size >= 0) && tiny(d->a.reach) && !farthest(d, &d->a, mul(v, -1), &p->x)) return 0;
    if (!(d->b.size >= 0) && tiny(d->b.reach) && !farthest(d, &d->b, v, &p->y)) return 0;
    p->w = corner_of(d, p->x, p->y);
    return fits(&d->a, p->x) && fits(&d->b, p->y);
}

#endif
