/* SPDX-License-Identifier: MIT */
/* Two boxes: whether they meet. Their axes tell where to look: along which direction they are apart, or for a point of
 * both. Nothing of this is taken on trust: the corner asked for along that direction proves the one, the room around
 * that point the other (docs/bounds.md). What neither proves is left to the walk. */
#ifndef GJK_CORE_AXES_H
#define GJK_CORE_AXES_H

#include "glance.h"
#include "touch.h"
#include "widen.h"
#include "zonotope.h"

/* The boxes as they see each other, in lengths along their axes. Where a box's axes are not square to each other it is
 * no more than a guess. */
typedef struct gauge {
    vec u[AXES];      /* in the frame: the axes, a's first, of length 1; */
    const real *m[2]; /* else they are the columns of these maps */
    vec uu[2];        /* their squares, by box, */
    real off;         /* all off 1 by no more */
    vec e, f;         /* the halves of a and of b */
    vec unit[2];      /* 1 along an axis, in a box's own coordinates times their grain */
    vec t, s;         /* the way from a's middle to b's: along a's axes, and along b's; */
    real cc, first;   /* the square of it, and how high the first corner is along it, times its length */
    vec r[DIM];       /* r[i].c[j]: a's axis i along b's axis j */
    int brought;      /* the axes were not of length 1: unit is no power of two then */
    int framed;       /* in the frame; else in the caller's lengths, of turned boxes only */
} gauge;

static inline vec axis_of(const gauge *k, int at)
{
    vec u;
    if (k->framed) return k->u[at];
    const real *m = k->m[at / DIM] + at % DIM;
    EACH(u.c[i] = m[DIM * i]);
    return u;
}

/* Bounds what a ball loses where axes are not of length 1 and square to each other, as a share: the squares of the axes
 * are off 1 by that, or their products off 0. */
static inline real skew_among(const vec u[DIM], real off)
{
    real skew = size(dot(u[0], u[1]));
    if (DIM > 2) skew += size(dot(u[0], u[DIM - 1])) + size(dot(u[1], u[DIM - 1]));
    return skew + (off + 64 * UNIT);
}

/* The same of a box in the frame. */
static inline real skew_of(const gauge *k, int at) { return skew_among(k->u + DIM * at, k->off); }

/* The same as LENGTH_OFF of one that was turned in float, whatever is asked in: lengths along it are good enough to
 * tell where to look, but where the boxes nearly touch. */
#define ROUGHLY ((real)0x1p-12)

/* How far the squares of the axes are off 1. */
static inline void take_off(gauge *k)
{
    k->off = 0;
    EACH(k->off = larger(size(k->uu[0].c[i] - 1), k->off); k->off = larger(size(k->uu[1].c[i] - 1), k->off));
}

/* To length 1. 0: the axes are far from square to each other, where guesses are no good. */
static int bring_to_length(gauge *k)
{
    for (int i = 0; i < AXES; i++) {
        const real l = root(k->uu[i / DIM].c[i % DIM]);
        k->u[i] = mul(k->u[i], 1 / l);
        (i < DIM ? &k->e : &k->f)->c[i % DIM] *= l;
        k->unit[i / DIM].c[i % DIM] /= l;
    }
    k->off = 0;
    k->brought = 1;
    return skew_of(k, 0) + skew_of(k, 1) < (real)0x1p-10;
}

/* Brings the box's axes to length 1 if they are as long as each other, and a power of two: however skew they are, which
 * the norm of their map depends on. */
static real level_of_axes(const body *k)
{
    const real level = level_of_map(k), first = squared_axes(k, level).c[0];
    return first > UNIT ? level * leveler(root(first) * (1 + ROUGHLY)) : level;
}

/* How high the first corner is, along the way from b to a, times the length of that, whose square is cc. */
static inline real first_height(vec e, vec f, vec t, vec s, real cc) { return cc - (dot_size(e, t) + dot_size(f, s)); }

/* Axes that are off length 1 by more than most are brought to it. 0: there is none to reckon by; of a box that is but a
 * point, for one. */
static APART int take_gauge_in_frame(gauge *k, const difference *d, real most)
{
    zonotope z;
    if (d->a.size == 0 || d->b.size == 0) return 0;
    take_axes(&z, 0, &d->a, level_of_axes(&d->a));
    take_axes(&z, 1, &d->b, level_of_axes(&d->b));
    k->framed = 1;
    k->m[0] = k->m[1] = unturned; /* nobody asks */
    k->brought = 0;
    for (int i = 0; i < AXES; i++) k->u[i] = z.u[i];
    EACH(k->uu[0].c[i] = z.uu[i]; k->uu[1].c[i] = z.uu[DIM + i]; k->e.c[i] = z.e[i]; k->f.c[i] = z.e[DIM + i];
         k->unit[0].c[i] = z.level[0]; k->unit[1].c[i] = z.level[1]);
    take_off(k);
    if (!(k->off <= most) && !(is_fair(&z, 0) && is_fair(&z, 1) && bring_to_length(k))) return 0;
    EACH(k->t.c[i] = dot(k->u[i], d->c); k->s.c[i] = -dot(k->u[DIM + i], mul(d->c, -1)));
    k->cc = dot(d->c, d->c);
    k->first = first_height(k->e, k->f, k->t, k->s, k->cc);
    return 1;
}

/* The same of boxes that see the way between them as t and s, and whose squared axes are known: all in it. 0: an axis
 * is too long or too short to reckon by as it is. */
static inline int take_gauge(gauge *k, const difference *d)
{
    k->framed = k->brought = 0;
    k->m[0] = map_of(&d->a);
    k->m[1] = map_of(&d->b);
    k->e = load(((const box *)d->a.data)->half);
    k->f = load(((const box *)d->b.data)->half);
    EACH(k->unit[0].c[i] = k->unit[1].c[i] = 1);
    take_off(k);
    return k->off <= ROUGHLY;
}

static inline vec clamped(vec x, vec e)
{
    EACH(x.c[i] = larger(smaller(x.c[i], e.c[i]), -e.c[i]));
    return x;
}

/* A point of a, from b's middle along b's axes, and the other way round. */
static inline vec seen_from_b(const gauge *k, vec x)
{
    vec y = mul(k->r[0], x.c[0]);
    REST(y = add(y, mul(k->r[i], x.c[i])));
    return sub(y, k->s);
}

static inline vec seen_from_a(const gauge *k, vec y)
{
    vec x;
    EACH(x.c[i] = dot(k->r[i], y) + k->t.c[i]);
    return x;
}

/* ---- a point of both ---- */

/* How far a point is from the box's nearest side; below 0: it is outside. */
static inline real room_at(vec x, vec e)
{
    real least = e.c[0] - size(x.c[0]);
    REST(least = smaller(e.c[i] - size(x.c[i]), least));
    return least;
}

/* The body's point, from its position, is that of both. */
static inline void place_common(result *r, const difference *d, const shape *s, vec at)
{
    const real far = far_out(s);
    const int plain = !d->wild && far < PLAIN;
    const real level = plain ? 1 : level_of(d, 0, far);
    vec p = moved(s->pose, at, level * d->unscale, level);
    if (!plain) p = in_range(mul(p, 1 / level));
    store(r->point_a, p);
    store(r->point_b, p);
}

/* Of the box's point, times its grain, the coordinates. 0: it is none, or they are no numbers of the format. */
static inline int is_in_box(const body *k, vec x, vec *own)
{
    const box *of = k->data;
    int r = 1;
    *own = mul(x, 1 / k->grain);
    EACH(r &= size(own->c[i]) <= of->half[i]);
    return r && same(mul(*own, k->grain), x);
}

/* The points x and y of the bodies, times their grain, are one, and nothing was rounded. All sums of such are within
 * sqrt(3) times the root of the glance's square. */
static APART int is_one_point(search *q, int framed, vec x, vec y, const shape *a, const shape *b)
{
    simplex s;
    if (!framed) {
        const duo_map maps = duo_map_at(map_of(&q->d.a), map_of(&q->d.b));
        const duo norms = duo_stretch(&maps);
        q->d.a.norm = of_a(norms);
        q->d.b.norm = of_b(norms);
    }
    const real power = 1 / leveler(q->d.doubt / (GLANCE_DOUBT / 2)); /* above half that root times 2 */
    s.n = 1;
    s.at[0] = 0;
    return is_in_box(&q->d.a, x, &s.slot[0].x) && is_in_box(&q->d.b, y, &s.slot[0].y) &&
           are_corners_whole(&q->d, &s, a, b, power);
}

/* The first corner, asked for only now, in the spare slot. 0: there is none. */
static int know_first(search *q, const gauge *k)
{
    if (k->framed) return ask_centres(q);
    clear(&q->s);
    vertex *p = spare(&q->s);
    p->x = corner_of_box(q->d.a.data, k->t);
    p->y = corner_of_box(q->d.b.data, mul(k->s, -1));
    p->w = corner_shown(&q->d, q->v, p).w;
    q->d.slack = 0;
    return q->pending = 1;
}

/* By the first corner, along the way between the middles, how deep the overlap is at most. 0: it can't be asked for. */
static inline int look_at_first(search *q, const gauge *k)
{
    const real whole = q->d.doubt / GLANCE_DOUBT, least = UNIT * UNIT * whole, l = root(k->cc);
    if (l > least) {
        q->lower = k->first / l - q->d.doubt;
        EACH(q->normal.c[i] = 0 + q->d.c.c[i] / l);
        return 1;
    }
    if (!q->pending && !know_first(q, k)) return 0; /* the middles are all but one: along another way */
    raise(q, q->v, spare(&q->s)->w);
    return 1;
}

/* There is a point of both, and they reach into each other by deep at least. 0: the radii are too large for that to
 * show. */
static int tell_common(search *q, const gauge *k, vec at, int of_a, real deep, const shape *a, const shape *b,
                       result *r)
{
    const difference *d = &q->d;
    result told;
    if (!look_at_first(q, k)) return 0;
    bracket(&told, d, q->lower, -deep, a, b);
    if (!(deep > 0)) told.upper = smaller(told.upper, 0); /* also where it was rounded on the way out */
    else if (!(told.upper < 0)) return 0;
    told.value = told.upper;
    if (of_a) place_common(&told, d, a, at);
    else place_common(&told, d, b, at);
    store(told.normal, q->normal);
    told.steps = q->steps + 1;
    told.supports = d->calls;
    told.reserved = 0;
    *r = told;
    return 1;
}

/* The point of a, or of b, nearest to the other's middle may be one of both, with room around it in the other. It is
 * looked at along that one's axes, which it may be off by their skew. */
static inline int try_middle(search *q, const gauge *k, int of_a, const shape *a, const shape *b, result *r)
{
    const difference *d = &q->d;
    const int own = of_a ? 0 : DIM, other = DIM - own;
    const vec x = of_a ? clamped(k->t, k->e) : clamped(mul(k->s, -1), k->f);
    vec at = mul(axis_of(k, own), x.c[0]), u[DIM], y;
    REST(at = add(at, mul(axis_of(k, own + i), x.c[i])));
    const vec from_other = of_a ? sub(at, d->c) : add(at, d->c);
    EACH(u[i] = axis_of(k, other + i); y.c[i] = dot(u[i], from_other));
    const real room = room_at(y, of_a ? k->f : k->e);
    if (!(room > 0)) return 0;
    const real skew = skew_among(u, k->off), deep = room * (1 - skew) - (1 + skew * (2 / GLANCE_DOUBT)) * d->doubt;
    return deep > 0 && tell_common(q, k, at, of_a, deep, a, b, r);
}

/* The points x of a and y of b, lengths along their axes, are as good as one: that proves the boxes to meet if there is
 * room around it in one of them, or if nothing was rounded. 0: neither is certain. */
static APART int tell_point(search *q, const gauge *k, vec x, vec y, real room, int in_b, const shape *a,
                            const shape *b, result *r)
{
    const difference *d = &q->d;
    EACH(x.c[i] *= k->unit[0].c[i]; y.c[i] *= k->unit[1].c[i]);
    const vec at_a = mapped(&d->a, x), at_b = mapped(&d->b, y), w = sub(at_a, add(at_b, d->c));
    vec u[DIM];
    EACH(u[i] = axis_of(k, DIM * in_b + i));
    const real deep = room > 0 ? room * (1 - skew_among(u, k->off)) - spread(w) - d->doubt : 0;
    const int one = !(deep > 0) && same(w, axis(0, 0)) && is_one_point(q, k->framed, x, y, a, b);
    if (!(deep > 0) && !one) return 0;
    return tell_common(q, k, in_b ? at_a : at_b, in_b, one ? 0 : deep, a, b, r);
}

/* The point of a may be one of b, too, or the other way round. */
static inline int try_of_a(search *q, const gauge *k, vec x, const shape *a, const shape *b, result *r)
{
    const vec y = seen_from_b(k, x);
    const real room = room_at(y, k->f);
    return room >= 0 && tell_point(q, k, x, y, room, 1, a, b, r);
}

static inline int try_of_b(search *q, const gauge *k, vec y, const shape *a, const shape *b, result *r)
{
    const vec x = seen_from_a(k, y);
    const real room = room_at(x, k->e);
    return room >= 0 && tell_point(q, k, x, y, room, 0, a, b, r);
}

/* ---- along the axes ---- */

/* By how much the boxes reach into each other along an axis of a, which is looked at along b's; below 0: they are apart
 * along it. */
static inline real reach_along_a(gauge *k, int i)
{
    real h = k->e.c[i] - size(k->t.c[i]);
    for (int j = 0; j < DIM; j++) {
        k->r[i].c[j] = dot(axis_of(k, i), axis_of(k, DIM + j));
        h += k->f.c[j] * size(k->r[i].c[j]);
    }
    return h;
}

/* The same along an axis of b, once all of a have been looked at. */
static inline real reach_along_b(const gauge *k, int j)
{
    real h = k->f.c[j] - size(k->s.c[j]);
    for (int i = 0; i < DIM; i++) h += k->e.c[i] * size(k->r[i].c[j]);
    return h;
}

static inline int least_of(const real *h, int n)
{
    int at = 0;
    for (int i = 1; i < n; i++) at = h[i] < h[at] ? i : at;
    return at;
}

/* The point of b farthest along an axis of a toward a, or of a toward b. */
static inline vec foremost_of_b(const gauge *k, int at)
{
    const real way = k->t.c[at] > 0 ? -1 : 1;
    vec y;
    EACH(y.c[i] = signed_as(k->f.c[i], way * k->r[at].c[i]));
    return y;
}

static inline vec foremost_of_a(const gauge *k, int at)
{
    const real way = k->s.c[at] > 0 ? 1 : -1;
    vec x;
    EACH(x.c[i] = signed_as(k->e.c[i], way * k->r[i].c[at]));
    return x;
}

#if DIM == 3
/* The same along the normal of each pair of that axis of a and one of b, times its length; */
static inline void reach_across(const gauge *k, int i, real h[3])
{
    const vec e = k->e, f = k->f, *r = k->r;
    const int i1 = next_axis[i + 1], i2 = next_axis[i + 2];
    for (int j = 0; j < 3; j++) {
        const int j1 = next_axis[j + 1], j2 = next_axis[j + 2];
        const real way = k->t.c[i2] * r[i1].c[j] - k->t.c[i1] * r[i2].c[j];
        h[j] = (e.c[i1] * size(r[i2].c[j]) + e.c[i2] * size(r[i1].c[j])) +
               (f.c[j1] * size(r[i].c[j2]) + f.c[j2] * size(r[i].c[j1])) - size(way);
    }
}

/* the square of which this is. */
static inline real square_across(const gauge *k, int i, int j) { return 1 - k->r[i].c[j] * k->r[i].c[j]; }

/* The first pair of axes along whose normal they reach into each other by less than that; -1: there is none. What all
 * before it do is left in h. */
static inline int first_gap_across(const gauge *k, real apart, real h[9])
{
    for (int i = 0; i < 3; i++) {
        reach_across(k, i, h + 3 * i);
        for (int j = 0; j < 3; j++)
            if (h[3 * i + j] < apart) return 3 * i + j;
    }
    return -1;
}

/* The point of a's edge nearest to b's, where these two are what is foremost across the pair of axes. */
static inline vec nearest_on_edge_of_a(const gauge *k, int of_a, int of_b)
{
    const int i1 = next_axis[of_a + 1], i2 = next_axis[of_a + 2];
    const real way = k->t.c[i2] * k->r[i1].c[of_b] - k->t.c[i1] * k->r[i2].c[of_b], rr = k->r[of_a].c[of_b];
    vec l = axis(0, 0), x, y, m;
    l.c[i1] = -k->r[i2].c[of_b] * way;
    l.c[i2] = k->r[i1].c[of_b] * way;
    m = add(mul(k->r[i1], l.c[i1]), mul(k->r[i2], l.c[i2]));
    EACH(x.c[i] = signed_as(k->e.c[i], l.c[i]); y.c[i] = signed_as(k->f.c[i], -m.c[i]));
    x.c[of_a] = y.c[of_b] = 0;
    const real along = (seen_from_a(k, y).c[of_a] + rr * seen_from_b(k, x).c[of_b]) / (1 - rr * rr);
    x.c[of_a] = larger(smaller(along, k->e.c[of_a]), -k->e.c[of_a]);
    return x;
}
#endif

/* ---- telling ---- */

/* The boxes' corners farthest along v toward each other. */
HOT int seek_corners(difference *d, vec v, vertex *p)
{
    if (d->wild) return ask(d, v, p);
    d->calls += 2;
    p->x = corner_of_box(d->a.data, plain_direction(&d->a, mul(v, -1)));
    p->y = corner_of_box(d->b.data, plain_direction(&d->b, v));
    return 1;
}

/* The corner along l, which seems to lead from one box to the other, may prove them to be apart. If not, the walk
 * starts from there. */
HOT int try_along(search *q, vec l, int max_steps, const shape *a, const shape *b, result *r)
{
    vertex p;
    if (max_steps < 2 || !(peak(l) > 0) || !seek_corners(&q->d, l, &p)) return 0;
    evidence e = corner_shown(&q->d, l, &p);
    p.w = e.w;
    q->steps++;
    if (tell_evidence(q, &e, l, a, b, r)) return 1;
    q->v = l;
    q->glanced = AIMED;
    q->s.slot[0] = p; /* the spare one */
    q->pending = 1;
    return 0;
}

/* Reaching into each other by less, they may be apart. Nearer contact heights in plain numbers are no guide. */
static inline real apart_by(const search *q, const shape *a, const shape *b)
{
    return -(a->radius + b->radius) * q->d.scale - q->d.doubt;
}

#if DIM == 3
/* The way across the first pair of axes along which they seem to be apart. 0: there is none, and across all they reach
 * into each other by so much. */
static inline int find_gap_across(const search *q, const gauge *k, const shape *a, const shape *b, real across[9],
                                  vec *way)
{
    const int gap = first_gap_across(k, apart_by(q, a, b), across);
    if (gap < 0) return 0;
    *way = cross(axis_of(k, gap / 3), axis_of(k, DIM + gap % 3));
    *way = mul(*way, -signed_as(1, dot(*way, q->d.c)));
    return 1;
}
#endif

/* Of boxes that are not apart along any axis, as it seems, and reach into each other by that least height along one of
 * them: whether there is a point of both. If not, the way across a pair of axes along which they seem to be apart; 0:
 * there is none. */
static APART int tell_inside(search *q, const gauge *k, const real h[AXES], vec *way, const shape *a, const shape *b,
                             result *r)
{
    const int least = least_of(h, AXES);
    const real height = h[least];
    const vec x = clamped(k->t, k->e), y = clamped(mul(k->s, -1), k->f);
    *way = axis(0, 0);
    if (try_of_a(q, k, x, a, b, r) || try_of_b(q, k, y, a, b, r)) return 1;
#if DIM == 3
    real across[9], lowest = height * height;
    int edges = -1;
    if (find_gap_across(q, k, a, b, across, way)) return 0;
    for (int i = 0; i < 9; i++) {
        const real ll = square_across(k, i / 3, i % 3);
        if (!(across[i] * across[i] < lowest * ll) || !(ll > PARALLEL)) continue;
        lowest = across[i] * across[i] / ll;
        edges = i;
    }
    if (edges >= 0 && height > q->d.doubt)
        return try_of_a(q, k, nearest_on_edge_of_a(k, edges / 3, edges % 3), a, b, r);
#endif
    if (!(height > q->d.doubt)) return 0;
    return least < DIM ? try_of_b(q, k, foremost_of_b(k, least), a, b, r)
                       : try_of_a(q, k, foremost_of_a(k, least - DIM), a, b, r);
}

/* That the first corner lies so far beyond the other middle, as a share of the way between them, is a sign of overlap.
 */
#define FAR_BEYOND ((real)1 / 3)

/* Whether they meet, of two boxes whose first corner shows nothing. */
HOT int tell_by_axes(search *q, gauge *k, int max_steps, const shape *a, const shape *b, result *r)
{
    if (k->first < -FAR_BEYOND * k->cc && (try_middle(q, k, 1, a, b, r) || try_middle(q, k, 0, a, b, r))) return 1;
    real h[AXES];
    const real apart = apart_by(q, a, b);
    vec way;
    int at = 0;
    for (; at < DIM; at++)
        if ((h[at] = reach_along_a(k, at)) < apart) break;
    for (; at >= DIM && at < AXES; at++)
        if ((h[at] = reach_along_b(k, at - DIM)) < apart) break;
    if (at < AXES) way = mul(axis_of(k, at), -signed_as(1, at < DIM ? k->t.c[at] : k->s.c[at - DIM]));
    else if (tell_inside(q, k, h, &way, a, b, r)) return 1;
    return try_along(q, way, max_steps, a, b, r);
}

/* The same without a frame. If not, what was asked last is left in the first slot. */
static APART enum glanced glance_along_axes(search *q, gauge *k, int max_steps, const shape *a, const shape *b,
                                            result *r)
{
    const int taken = take_gauge(k, &q->d);
    q->glanced = taken ? CLOUDED : IN_VAIN;
    if (taken && tell_by_axes(q, k, max_steps, a, b, r)) return TELLING;
    if (!q->pending) know_first(q, k);
    return q->glanced;
}

static inline int are_boxes(const shape *a, const shape *b)
{
    return a->support == pub(support_box) && b->support == pub(support_box);
}

/* Whether the first corner shows it, or else the axes, of two boxes, of which nothing more is known. */
static inline enum glanced glance_at_boxes(search *q, int max_steps, const shape *a, const shape *b, result *r)
{
    difference *d = &q->d;
    stay_outside(d, a, b);
    const vec v = mul(d->c, -1);
    const duo_map m = duo_map_at(map_of(&d->a), map_of(&d->b));
    const duos way = duos_pulled(&m, duos_of(d->c, v)), uu = squares_of_duo_map(&m);
    const duos half = duos_at(((const box *)d->a.data)->half, ((const box *)d->b.data)->half);
    const real cc = dot(v, v);
    start_glance(q, v);
    if (!are_plain(cc, a, b) || !doubt_by_squares(d, cc, duos_sum(uu), duos_dot(half, half))) return UNCLEAR;
    const duo rest = duos_dot_size(half, way);
    const real first = cc - (of_a(rest) + of_b(rest));
    if (!(first > 0)) {
        gauge k;
        k.uu[0] = vec_of_a(uu);
        k.uu[1] = vec_of_b(uu);
        k.t = vec_of_a(way);
        k.s = mul(vec_of_b(way), -1);
        k.cc = cc;
        k.first = first;
        return glance_along_axes(q, &k, max_steps, a, b, r);
    }
    const duos x = duos_signed(half, way), at = duos_mapped(&m, x);
    evidence e = {.w = corner_at_spots(d, at)};
    e.a = vec_of_a(d->a.posed ? at : x); /* as it is, signs of zeros included, where no map is */
    e.b = vec_of_b(d->b.posed ? at : x);
    e.height = dot(v, e.w);
    if (tell_evidence(q, &e, v, a, b, r)) return TELLING;
    q->s.slot[0] = (vertex){.x = vec_of_a(x), .y = vec_of_b(x), .w = e.w};
    return IN_VAIN;
}

/* With the axes as they are, if they may be; and where that tells nothing, of length 1. Float leaves that to the
 * sister: without a frame she is asked at once, and other units are to have the same bits. */
static APART int tell_by_axes_in_frame(search *q, int max_steps, const shape *a, const shape *b, result *r)
{
    gauge k;
    for (real most = ROUGHLY; take_gauge_in_frame(&k, &q->d, most) && !(k.first > 0); most = LENGTH_OFF) {
        if (tell_by_axes(q, &k, max_steps, a, b, r)) return 1;
        if (HAS_SISTER || q->glanced == AIMED || k.off <= LENGTH_OFF) break;
    }
    return 0;
}

/* A glance in the frame, where none told without. */
static APART int look_in_frame(search *q, int max_steps, const shape *a, const shape *b, result *r)
{
    const real doubt = q->d.doubt;
    q->d.doubt = doubt_in_frame(&q->d);
    int told = glance_in_frame(q, a, b, r);
    if (!told && are_boxes(a, b)) told = tell_by_axes_in_frame(q, max_steps, a, b, r);
    q->d.doubt = doubt;
    return told;
}

/* ---- the door ---- */

#if DIM == 3
/* Two boxes, and nothing is asked that their axes do not tell. */
HOT int are_plain_boxes(const shape *a, const shape *b, const options *o, const result *r)
{
    return a && b && r && are_boxes(a, b) && asks_nothing_else(o);
}

/* Before anything is set up for what else may be asked, of bodies or about them. UNTRIED: they are no boxes. */
static APART enum glanced glance_at_plain_boxes(search *q, int max_steps, const shape *a, const shape *b, result *r)
{
    take_pose(&q->d.a, a);
    take_pose(&q->d.b, b);
    if (!take_box(&q->d.a, a->data) || !take_box(&q->d.b, b->data)) return UNTRIED;
    q->listed = 1;
    q->thin = q->planar = q->flat = UNTRIED;
    return glance_at_boxes(q, max_steps, a, b, r);
}
#else
#define are_plain_boxes(a, b, o, r) 0
#define glance_at_plain_boxes(q, max_steps, a, b, r) UNTRIED
#endif

/* The walk takes up the last query's simplex after all. 0: something is wrong. */
static APART int reopen_after_axes(search *q, const shape *a, const shape *b, const cache *k)
{
    if (!lends(k, a, b) || reopen_listed(q, k)) return 1;
    q->v = first_direction(&q->d);
    return ask_anew(&q->d, q->v, 1, spare(&q->s));
}

#endif
