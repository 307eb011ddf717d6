/* SPDX-License-Identifier: MIT */
/* Whether two solids meet, one of them round: ellipsoid, ball, cylinder, disc, cone, and box. What sets they are is
 * known, so no support is called, and nothing is set up to call one. One corner along the line of centres shows most
 * pairs to be apart; a point on that line that is in both shows most others to meet; and a few corners more, as in
 * strides, tell the rest but contact, which is left to the search. All in the caller's lengths, if these are plain;
 * else in such lengths that they are, to the same bits. Radii are left out. */
#ifndef GJK_CORE_SOLID_H
#define GJK_CORE_SOLID_H

#include "axes.h"
#include "round.h"
#include "stride.h"
#include "widen.h"

#if DIM == 3

enum kind { IS_ELLIPSOID, IS_CYLINDER, IS_CONE, IS_BOX };

typedef struct solid {
    enum kind kind;
    vec size; /* of an ellipsoid the radii, of a box the halves; of others the radius, twice, and half the length */
    const real *m; /* the map of its pose, if there is one */
} solid;

/* The numbers of the shape's data, so many, each given an index, into the size; -0 as 0, since there is divided by
 * them. 0: one is none. */
static inline int take_sizes(solid *k, const shape *s, enum kind kind, int i, int j, int l)
{
    const real *from = s->data;
    if (!from) return 0;
    k->kind = kind;
    k->size = (vec){{from[i] + 0, from[j] + 0, l < 0 ? 0 : from[l] + 0}};
    k->m = s->pose ? s->pose->m : NULL;
    return k->size.c[0] >= 0 && k->size.c[1] >= 0 && k->size.c[2] >= 0;
}

/* 0: it is none of these. */
static inline int take_solid(solid *k, const shape *s)
{
    support_fn *const f = s->support;
    if (f == pub(support_ellipsoid)) return take_sizes(k, s, IS_ELLIPSOID, 0, 1, 2);
    if (f == pub(support_cylinder)) return take_sizes(k, s, IS_CYLINDER, 0, 0, 1);
    if (f == pub(support_cone)) return take_sizes(k, s, IS_CONE, 0, 0, 1);
    if (f == pub(support_box)) return take_sizes(k, s, IS_BOX, 0, 1, 2);
    if (f == pub(support_ball)) return take_sizes(k, s, IS_ELLIPSOID, 0, 0, 0);
    return f == pub(support_disc) && take_sizes(k, s, IS_CYLINDER, 0, 0, -1);
}

/* ---- asking ---- */

/* Its point farthest along g, where squares of directions leave their range: as the supports have it. */
static APART vec point_with_care(const solid *k, vec g)
{
    const real two[2] = {k->size.c[0], k->size.c[2]};
    vec x = axis(0, 0);
    if (k->kind == IS_ELLIPSOID) ellipsoid_in(1, k->size.c, g, &x);
    if (k->kind == IS_CYLINDER) cylinder_in(1, two, g, &x);
    if (k->kind == IS_CONE) cone_in(1, two, g, &x);
    return x;
}

/* Its point farthest along g, which it sees: to the licence of a support, by the same operations. */
HOT vec point_of_solid(const solid *k, vec g)
{
    if (k->kind == IS_BOX) {
        EACH(g.c[i] = signed_as(k->size.c[i], g.c[i]));
        return g;
    }
    if (k->kind == IS_ELLIPSOID) {
        const vec t = stretched(g, k->size);
        const real square = dot(t, t);
        return unruly(square) ? point_with_care(k, g) : stretched(mul(t, 1 / root(square)), k->size);
    }
    const real square = g.c[0] * g.c[0] + g.c[1] * g.c[1], r = k->size.c[0], h = k->size.c[2];
    if (unruly(square)) return point_with_care(k, g);
    const real aside = root(square), by = r / aside;
    if (k->kind == IS_CYLINDER) return (vec){{g.c[0] * by, g.c[1] * by, signed_as(h, g.c[2])}};
    return r * aside > 2 * h * g.c[2] ? (vec){{g.c[0] * by, g.c[1] * by, -h}} : axis(2, h);
}

HOT vec seen_by_solid(const solid *k, vec dir) { return k->m ? pull(k->m, dir) : dir; }

HOT vec put_in_place(const solid *k, vec x) { return k->m ? map(k->m, x) : x; }

/* ---- how far they reach, and the doubt ---- */

/* The square of how far its points are from its middle. */
HOT real square_of_solid(const solid *k)
{
    const vec s = k->size;
    if (k->kind == IS_ELLIPSOID) {
        const real far = peak(s);
        return far * far;
    }
    return k->kind == IS_BOX ? dot(s, s) : s.c[0] * s.c[0] + s.c[2] * s.c[2];
}

HOT vec squares_of_axes(const solid *k) { return k->m ? squared_columns(k->m, 1) : (vec){{1, 1, 1}}; }

/* Two solids, b's middle at c from a's; v leads back. */
typedef struct couplet {
    solid a, b;
    vec c, v;
    vec s, t;             /* c as a sees it, and v as b does */
    vec uu[2];            /* the squares of their axes */
    real doubt;           /* of a glance */
    real per[2], ball[2]; /* see know_axes */
    evidence e;           /* what the first corner shows */
    vec normal;           /* the answer, once it is told: */
    vec on_a, on_b;
    real lower, upper;
    int steps, calls;
} couplet;

/* Squares that are no less lose nothing that counts to underflow. */
#define LEAST_SQUARE (REAL_MIN / (UNIT * UNIT))

/* The doubt as a glance has it. TELLING: a glance may tell. UNCLEAR: squares leave their range. IN_VAIN: one solid, or
 * the way between them, is as small as a rounding of the others, in any unit. */
HOT enum glanced doubt_solids(couplet *k)
{
    k->uu[0] = squares_of_axes(&k->a);
    k->uu[1] = squares_of_axes(&k->b);
    const real map_a = k->a.m ? k->uu[0].c[0] + k->uu[0].c[1] + k->uu[0].c[2] : 1;
    const real map_b = k->b.m ? k->uu[1].c[0] + k->uu[1].c[1] + k->uu[1].c[2] : 1;
    const real set_a = square_of_solid(&k->a), set_b = square_of_solid(&k->b);
    const real of_a = map_a * set_a, of_b = map_b * set_b, cc = dot(k->c, k->c), square = of_a + of_b + cc;
    k->doubt = GLANCE_DOUBT * root(square);
    if (!(smaller(smaller(map_a, map_b), smaller(set_a, set_b)) > LEAST_SQUARE && square > LEAST_SQUARE / UNIT &&
          square < REAL_MAX / 4))
        return UNCLEAR;
    return smaller(smaller(of_a, of_b), cc) > UNIT * UNIT * square ? TELLING : IN_VAIN;
}

/* ---- the first corner ---- */

HOT void see_first(couplet *k)
{
    k->v = mul(k->c, -1);
    k->s = seen_by_solid(&k->a, k->c);
    k->t = seen_by_solid(&k->b, k->v);
    k->e.a = put_in_place(&k->a, point_of_solid(&k->a, k->s));
    k->e.b = put_in_place(&k->b, point_of_solid(&k->b, k->t));
    k->e.w = sub(k->e.a, add(k->e.b, k->c));
    k->e.height = dot(k->v, k->e.w);
}

/* What the corner e along v shows is the answer. */
HOT void keep_apart(couplet *k, const evidence *e, vec v, real unscale)
{
    k->lower = e->lower * unscale;
    k->upper = e->upper * unscale;
    EACH(k->normal.c[i] = 0 - v.c[i] / e->l);
    k->on_a = e->a;
    k->on_b = e->b;
}

/* The corner along v, which lies above 0, shows them to be apart. */
HOT int solids_apart(couplet *k)
{
    weigh_evidence(&k->e, k->v, k->doubt);
    if (!(k->e.lower > 0)) return 0;
    keep_apart(k, &k->e, k->v, 1);
    return 1;
}

/* ---- a point of both ---- */

/* How many times as large the solid is that x is on the surface of. Where a box is flat and x in its plane, 0 / 0 is
 * passed over, and nothing else with it. */
static inline real gauge_of(const solid *k, vec x)
{
    const vec s = k->size;
    if (k->kind == IS_BOX) {
        real times = 0;
        EACH(times = larger(size(x.c[i]) / s.c[i], times));
        return times;
    }
    if (k->kind == IS_ELLIPSOID) {
        EACH(x.c[i] /= s.c[i]);
        return root(dot(x, x));
    }
    const real aside = root(x.c[0] * x.c[0] + x.c[1] * x.c[1]) / s.c[0], up = x.c[2] / s.c[2];
    return k->kind == IS_CYLINDER ? larger(aside, size(up)) : larger(2 * aside + up, -up);
}

/* How large a ball around its middle it has, at least. */
static inline real ball_within(const solid *k)
{
    const vec s = k->size;
    if (k->kind == IS_CONE) return s.c[0] * s.c[2] / (s.c[0] + 2 * s.c[2]);
    return smaller(smaller(s.c[0], s.c[1]), s.c[2]);
}

/* A power of two that brings the solid's axes to length 1, if they are as long as each other and a power of two. */
static inline real level_of_solid(const solid *k, vec uu)
{
    return k->m ? leveler(root(uu.c[0]) * (1 + LENGTH_OFF)) : 1;
}

/* What a ball loses, as a share, where its axes, brought to length 1, are not square to each other or not of that
 * length; above 1: too much. */
static inline real skew_of_axes(const solid *k, vec uu, real level)
{
    const real *m = k->m;
    if (!m) return 0;
    real off = 0, skew = 0;
    EACH(off = larger(size(uu.c[i] * level * level - 1), off));
    for (int i = 0; i < DIM; i++) {
        const int j = (i + 1) % DIM;
        skew += size(m[i] * m[j] + m[DIM + i] * m[DIM + j] + m[2 * DIM + i] * m[2 * DIM + j]);
    }
    return off <= LENGTH_OFF ? skew * level * level + (off + 64 * UNIT) : 2;
}

/* How large balls within are, and what they see along their axes comes to in lengths along these. */
static inline void know_axes(couplet *k)
{
    const real level_a = level_of_solid(&k->a, k->uu[0]), level_b = level_of_solid(&k->b, k->uu[1]);
    const real skew = larger(skew_of_axes(&k->a, k->uu[0], level_a), skew_of_axes(&k->b, k->uu[1], level_b));
    k->per[0] = level_a * level_a;
    k->per[1] = level_b * level_b;
    k->ball[0] = skew < 1 ? ball_within(&k->a) / level_a * (1 - skew) : 0;
    k->ball[1] = skew < 1 ? ball_within(&k->b) / level_b * (1 - skew) : 0;
}

/* x of a and y of b, as the solids see them, are as good as one, and as far within for certain as the shares of their
 * sizes say that are left there: that shows them to meet, if it is more than they are apart. */
static inline int meet_at(couplet *k, vec x, vec y, real left_a, real left_b)
{
    if (!(left_a > 0 && left_b > 0)) return 0;
    const vec on_a = put_in_place(&k->a, x), on_b = put_in_place(&k->b, y);
    const real room = larger(left_a * k->ball[0], left_b * k->ball[1]);
    const real upper = length(sub(on_a, add(on_b, k->c))) + k->doubt - room;
    if (!(upper < 0)) return 0;
    const real l = length(k->v);
    k->lower = k->e.height / l - k->doubt;
    k->upper = upper;
    EACH(k->normal.c[i] = 0 - k->v.c[i] / l);
    k->on_a = on_a;
    return 1;
}

/* What is left of a size, where a point is on the surface of that many times the solid; with what rounds in it. */
static inline real left_of(real times) { return times > 0 ? 1 - (times + 32 * UNIT) : 0; }

/* On the line of centres the point that is as far in one solid, for its size, as in the other. */
static inline int meet_on_line(couplet *k)
{
    const vec s = mul(k->s, k->per[0]), t = mul(k->t, k->per[1]);
    const real of_a = gauge_of(&k->a, s), of_b = gauge_of(&k->b, t), share = of_b / (of_a + of_b);
    const real left = of_b > 0 ? left_of(of_a * share) : 0;
    return left > 0 && meet_at(k, mul(s, share), mul(t, 1 - share), left, left);
}

/* ---- ellipsoids ---- */

/* Of an ellipsoid the square of its map times its radii, in lengths of a frame: its height along v is the root of
 * v.square v. */
typedef struct squared {
    real c[6]; /* xx, yy, zz, yz, zx, xy */
} squared;

static inline squared squared_map(const solid *k, real level)
{
    const vec r = mul(k->size, level), rr = stretched(r, r);
    squared q = {{rr.c[0], rr.c[1], rr.c[2], 0, 0, 0}};
    if (!k->m) return q;
    const vec x = load(k->m), y = load(k->m + DIM), z = load(k->m + 2 * DIM);
    const vec rx = stretched(x, rr), ry = stretched(y, rr), rz = stretched(z, rr);
    q = (squared){{dot(x, rx), dot(y, ry), dot(z, rz), dot(y, rz), dot(z, rx), dot(x, ry)}};
    return q;
}

static inline vec times_squared(const squared *q, vec v)
{
    const real *c = q->c, x = v.c[0], y = v.c[1], z = v.c[2];
    return (vec){{c[0] * x + c[5] * y + c[4] * z, c[5] * x + c[1] * y + c[3] * z, c[4] * x + c[3] * y + c[2] * z}};
}

/* Adds how much the height of the ellipsoid is bowed there, its point x being farthest at height h. */
static inline void add_bow(real bow[6], const squared *q, vec x, real h)
{
    const real per = 1 / h;
    for (int i = 0; i < DIM; i++) {
        const int j = (i + 1) % DIM, l = (i + 2) % DIM;
        bow[i] += (q->c[i] - x.c[i] * x.c[i]) * per;
        bow[DIM + i] += (q->c[DIM + i] - x.c[j] * x.c[l]) * per;
    }
}

/* The solution of a symmetric system. */
static inline vec solved(const real f[6], vec y)
{
    const real xx = f[1] * f[2] - f[3] * f[3], yy = f[2] * f[0] - f[4] * f[4], zz = f[0] * f[1] - f[5] * f[5];
    const real yz = f[4] * f[5] - f[0] * f[3], zx = f[5] * f[3] - f[1] * f[4], xy = f[3] * f[4] - f[2] * f[5];
    const real per = 1 / (f[0] * xx + f[5] * xy + f[4] * zx);
    const squared inverse = {{xx, yy, zz, yz, zx, xy}};
    return mul(times_squared(&inverse, y), per);
}

/* So often a direction is turned, by so much at most; where it is turned by less it has come to rest. */
#define NEWTONS 12
#define SWING ((real)0.5)
#define AT_REST ((real)0x1p-20)

/* Turns v, of length 1, toward where two ellipsoids are the farthest apart, or the least deep, by Newton's steps on how
 * high their corner is along v; till it is above the doubt, or v has come to rest. Nothing rests on what comes of it.
 * And where the middle of both points there is, from a's. 0: it does not come to rest. */
static inline int turn_to_gap(const couplet *k, vec *way, vec *middle)
{
    const real level = leveler(k->doubt * (1 / GLANCE_DOUBT)), doubt = k->doubt * level;
    const squared a = squared_map(&k->a, level), b = squared_map(&k->b, level);
    const vec c = mul(k->c, level);
    vec v = mul(k->v, 1 / length(k->v));
    real far = 1;
    for (int i = 0; i < NEWTONS; i++) {
        const vec av = times_squared(&a, v), bv = times_squared(&b, v);
        const real h_a = root(dot(v, av)), h_b = root(dot(v, bv));
        const vec on_a = mul(av, -1 / h_a), on_b = mul(bv, 1 / h_b), w = sub(on_a, add(on_b, c));
        const real height = dot(v, w);
        if (height > 2 * doubt || far <= AT_REST) {
            *way = v;
            *middle = mul(add(on_a, add(on_b, c)), (real)0.5 / level);
            return 1;
        }
        real bow[6] = {0};
        add_bow(bow, &a, on_a, h_a);
        add_bow(bow, &b, on_b, h_b);
        const real stiff = bow[0] + bow[1] + bow[2];
        for (int j = 0; j < DIM; j++) {
            bow[j] += height + stiff * v.c[j] * v.c[j];
            bow[DIM + j] += stiff * v.c[(j + 1) % DIM] * v.c[(j + 2) % DIM];
        }
        const vec t = solved(bow, sub(w, mul(v, height)));
        far = length(t);
        if (!(far <= REAL_MAX)) return 0;
        v = add(v, mul(t, far > SWING ? SWING / far : 1));
        v = mul(v, 1 / length(v));
    }
    return 0;
}

/* ---- along a way on which they may be the farthest apart ---- */

/* The corner least along the way, which is to be of length 1, and the bodies' points there. */
static void look_along_way(couplet *k, vec way, vec *x, vec *y)
{
    *x = point_of_solid(&k->a, seen_by_solid(&k->a, mul(way, -1)));
    *y = point_of_solid(&k->b, seen_by_solid(&k->b, way));
    k->v = way;
    k->e.a = put_in_place(&k->a, *x);
    k->e.b = put_in_place(&k->b, *y);
    k->e.w = sub(k->e.a, add(k->e.b, k->c));
    k->e.height = dot(way, k->e.w);
    k->steps++;
    k->calls += 2;
}

/* Whether that point, from a's middle, is in both; and of how many times as large solids it is on the surface. */
static int meet_there(couplet *k, vec at, real times[2])
{
    const vec x = mul(seen_by_solid(&k->a, at), k->per[0]);
    const vec y = mul(seen_by_solid(&k->b, sub(at, k->c)), k->per[1]);
    times[0] = gauge_of(&k->a, x);
    times[1] = gauge_of(&k->b, y);
    return meet_at(k, x, y, left_of(times[0]), left_of(times[1]));
}

/* Two ellipsoids that the first corner leaves open. 0: they still are. */
static APART int tell_ellipsoids(couplet *k)
{
    vec way, middle, x, y;
    real times[2];
    if (!turn_to_gap(k, &way, &middle)) return 0;
    look_along_way(k, way, &x, &y);
    return k->e.height > 0 ? solids_apart(k) : meet_there(k, middle, times);
}

/* What the solid adds to the heights of the difference. */
static int add_solid(bulk *b, const solid *k, const stand *s, int of_b)
{
    const vec size = k->size;
    if (k->kind == IS_CONE) return add_cone(b, s, of_b, size.c[0], size.c[2]);
    if (k->kind == IS_CYLINDER) add_cylinder(b, s, of_b, size.c[0], size.c[2]);
    if (k->kind == IS_ELLIPSOID) add_limb(b, s, of_b, 0, DIM, size.c);
    if (k->kind == IS_BOX) add_box(b, s, of_b, size.c);
    return 1;
}

static inline unsigned edged_axes_of(const solid *k) { return k->kind == IS_BOX ? 7 : k->kind == IS_ELLIPSOID ? 0 : 4; }

/* The heights of A - B in lengths of a frame by the doubt, that many to the caller's. 0: what they are made of is not
 * known, or axes lie along one another. */
static int know_heights(bulk *of, const couplet *k, real level)
{
    const stand a = {k->a.m, 1, level}, b = {k->b.m, 1, level};
    of->limbs = 0;
    of->middle = mul(k->c, -level);
    vec u[DIM], v[DIM];
    const int n = put_edged(&a, edged_axes_of(&k->a), u), m = put_edged(&b, edged_axes_of(&k->b), v);
    of->joined = -1;
    if (are_aligned(u, n, v, m)) return 0;
    return add_solid(of, &k->a, &a, 0) && add_solid(of, &k->b, &b, 1);
}

/* They overlap along n, a's point on_a and b's on_b being farthest: whether a point half as deep in each is in both.
 * That between these, as a rule; but of a sharp edge it may be beside the solid, and the way to the middle is not; then
 * one between both. */
static int meet_between(couplet *k, vec n, vec on_a, vec on_b)
{
    const real half = (real)-0.5 * k->e.height;
    const vec from_b = sub(on_b, k->c), between = mul(add(on_a, on_b), (real)0.5);
    const vec in_a = mul(on_a, 1 - half / dot(n, on_a)), in_b = add(k->c, mul(from_b, 1 + half / dot(n, from_b)));
    real times[2], others[2];
    if (meet_there(k, between, times)) return 1;
    const vec inner = times[0] < 1 ? in_b : times[1] < 1 ? in_a : mul(add(in_a, in_b), (real)0.5);
    if (meet_there(k, inner, others)) return 1;
    const real off = times[0] - times[1], other_off = others[0] - others[1], share = off / (off - other_off);
    return share > 0 && share < 1 && meet_there(k, add(between, mul(sub(inner, between), share)), times);
}

/* Whether the corner there shows them to be apart; or a point that is as deep in one as in the other is in both. */
static int tell_in_dip(couplet *k, const bulk *of, const bent *at)
{
    vertex p;
    look_along_way(k, mul(at->n, -1), &p.x, &p.y);
    if (k->e.height > 0) return solids_apart(k);
    share_out(of, at, &p); /* edges as they count */
    return meet_between(k, at->n, put_in_place(&k->a, p.x), add(put_in_place(&k->b, p.y), k->c));
}

/* Where the heights' dip is sought from: the line of centres, with most of what leads along the first corner taken off.
 */
static vec way_to_dip(const couplet *k, real level)
{
    const vec c = mul(k->c, level), w = mul(k->e.w, level);
    const vec n = sub(mul(c, dot(w, w)), mul(w, (real)0.875 * dot(c, w)));
    return mul(n, 1 / length(n));
}

/* The same of any two, on the way to a dip of the heights: as soon as they are below the doubt there, or seem to stay
 * above it; by so many corners in all. */
static APART int tell_by_dip(couplet *k, int most)
{
    bulk of;
    rolling s;
    bent at;
    real t[ACROSS];
    const real level = leveler(k->doubt * (1 / GLANCE_DOUBT)), doubt = 2 * k->doubt * level;
    if (!know_heights(&of, k, level)) return 0;
    start_rolling(&s, &of, way_to_dip(k, level));
    for (int i = 0; i < ROLLS && k->steps < most; i++) {
        bend(&s, &at);
        if (at.height + at.height_off < -doubt) return tell_in_dip(k, &of, &at);
        aim(&s, &at, t);
        if (-4 * change_along(&at, t) < at.height && tell_in_dip(k, &of, &at)) return 1;
        const enum rolled to = roll_by(&s, &at, t);
        if (to != ROLLS_ON) return to == RESTS && k->steps < most && come_to_rest(&s, &at) && tell_in_dip(k, &of, &at);
    }
    return 0;
}

/* ---- more corners ---- */

/* The corner least along the way, in lengths of the frame, into the spare slot; and what it shows. */
static inline void seek_on_solids(couplet *k, search *q, evidence *e, vec at[DIM + 1])
{
    const int slot = q->s.at[q->s.n];
    e->a = put_in_place(&k->a, point_of_solid(&k->a, seen_by_solid(&k->a, mul(q->way, -1))));
    e->b = put_in_place(&k->b, point_of_solid(&k->b, seen_by_solid(&k->b, q->way)));
    e->w = mul(sub(e->a, add(e->b, k->c)), q->d.scale);
    e->height = dot(q->way, e->w);
    q->s.slot[slot].w = e->w;
    at[slot] = e->a;
    k->calls += 2;
    q->steps++;
}

/* It proves the solids to be apart. */
static inline int shows_apart(couplet *k, const search *q, evidence *e)
{
    if (!(e->height > 0)) return 0;
    weigh_evidence(e, q->way, q->d.doubt);
    if (!(e->lower > 0)) return 0;
    keep_apart(k, e, q->way, q->d.unscale);
    return 1;
}

/* The full simplex holds the origin by those weights, with so much room; at, by slot, is where a's points are placed.
 * 0: the point of both that the weights give is off by more than the bracket is wide. */
static int tell_room(couplet *k, const search *q, const real weight[DIM + 1], real inside, const vec at[DIM + 1])
{
    const real per = 1 / (weight[0] + weight[1] + weight[2] + weight[3]), upper = q->d.doubt - inside;
    vec on_a = axis(0, 0), off = axis(0, 0);
    for (int i = 0; i <= DIM; i++) {
        on_a = add(on_a, mul(at[q->s.at[i]], weight[i] * per));
        off = add(off, mul(point(&q->s, i), weight[i] * per));
    }
    if (!(2 * peak(off) + q->d.doubt <= upper - q->lower) || !(upper * q->d.unscale < 0)) return 0;
    k->lower = q->lower * q->d.unscale;
    k->upper = upper * q->d.unscale;
    k->normal = q->normal;
    k->on_a = on_a;
    return 1;
}

/* With the corner in the spare slot a full simplex holds the origin, as in strides. */
static inline int is_closed(couplet *k, search *q, const evidence *e, const vec at[DIM + 1])
{
    real weight[DIM + 1];
    const real inside = room_with_last(q, weight);
    if (!(inside > q->d.doubt)) return 0;
    keep_evidence(q, e);
    return tell_room(k, q, weight, inside, at);
}

/* From the first corner, which has told nothing, in a frame by the doubt. 0: it is contact, to a few roundings, or the
 * steps are used up. */
static APART int stride_on_solids(couplet *k, search *q, int max_steps)
{
    vec at[DIM + 1];
    evidence e;
    int headings = HEADINGS;
    q->d.scale = leveler(k->doubt * (1 / GLANCE_DOUBT));
    q->d.unscale = 1 / q->d.scale;
    q->d.c = mul(k->c, q->d.scale);
    q->d.doubt = k->doubt * q->d.scale;
    q->s.slot[0].w = mul(k->e.w, q->d.scale);
    at[0] = k->e.a;
    if (!stands_clear(&q->s.slot[0])) return 0;
    stand_on_first(q);
    q->steps = k->steps;
    const vec centres = q->way;
    while (q->steps < max_steps) {
        const int heads = headings-- > 0;
        q->way = heads ? heading(q, centres) : q->v;
        seek_on_solids(k, q, &e, at);
        k->steps = q->steps;
        if (shows_apart(k, q, &e)) return 1;
        if (q->s.n == DIM && is_closed(k, q, &e, at)) return 1;
        if (leads_nowhere(q)) {
            if (heads) continue;
            return 0;
        }
        if (!step_plainly(q)) return 0;
        if (q->s.n <= DIM) continue;
        keep_evidence(q, &e);
        return tell_room(k, q, q->weight, q->inside, at);
    }
    return 0;
}

/* ---- the answer ---- */

/* By so many corners at most; and half of the steps are left to the search. */
#define MOST_STRIDES 64

/* TELLING: what the couplet says is the answer; UNCLEAR: the sizes are none to tell by. */
static inline enum glanced tell_couplet(couplet *k, search *q, int max_steps)
{
    k->steps = 1;
    k->calls = 2;
    see_first(k);
    const enum glanced sized = doubt_solids(k);
    if (sized != TELLING) return sized;
    if (k->e.height > 0 && solids_apart(k)) return TELLING;
    know_axes(k);
    if (!(k->e.height > 0) && meet_on_line(k)) return TELLING;
    const int ellipsoids = k->a.kind == IS_ELLIPSOID && k->b.kind == IS_ELLIPSOID;
    const int most = max_steps / 2 < MOST_STRIDES ? max_steps / 2 : MOST_STRIDES;
    if (k->steps < most && (ellipsoids ? tell_ellipsoids(k) : tell_by_dip(k, most))) return TELLING;
    if (ellipsoids && HAS_SISTER) return IN_VAIN; /* she has the digits */
    return stride_on_solids(k, q, most) ? TELLING : IN_VAIN;
}

/* What the couplet says, in the caller's lengths. */
HOT void spell_couplet(const couplet *k, const shape *a, const shape *b, result *r)
{
    const vec on_a = k->on_a, on_b = k->on_b;
    r->lower = k->lower;
    r->upper = k->upper;
    r->value = k->lower > 0 ? r->lower : r->upper;
    store(r->point_a, a->pose ? add(on_a, load(a->pose->p)) : on_a);
    if (k->lower > 0) store(r->point_b, b->pose ? add(on_b, load(b->pose->p)) : on_b);
    else memcpy(r->point_b, r->point_a, sizeof r->point_b);
    store(r->normal, k->normal);
    r->steps = k->steps;
    r->supports = k->calls;
    r->reserved = 0;
}

/* Lengths brought to size 1: those of the solid by one power of two, and what is left by its map. Where there is none
 * they are brought to the frame's. The exponent of the latter is e. */
static void bring_solid(solid *k, real m[DIM * DIM], int e)
{
    const int own = k->m ? exponent_of(peak(k->size)) : e;
    EACH(k->size.c[i] = raised(k->size.c[i], -own));
    for (int i = 0; i < DIM * DIM && k->m; i++) m[i] = raised(k->m[i], own - e);
    if (k->m) k->m = m;
}

/* The exponent of how far the solid reaches; it is one of normal numbers. 0: they are none. */
static int exponent_of_solid(const solid *k, int *e)
{
    real far = 0;
    const real own = peak(k->size);
    for (int i = 0; i < DIM * DIM && k->m; i++) far = larger(size(k->m[i]), far);
    if (!k->m) far = 1;
    if (!(own >= REAL_MIN && own <= REAL_MAX && far >= REAL_MIN && far <= REAL_MAX)) return 0;
    *e = exponent_of(own) + exponent_of(far);
    return 1;
}

/* x times 2^e beside a coordinate p, summed where neither underflows that counts. */
static real placed_beside(real x, int e, real p)
{
    const int out = size(p) >= REAL_MIN && exponent_of(size(p)) > e ? exponent_of(size(p)) : e;
    return raised(raised(x, e - out) + raised(p, -out), out);
}

/* What is so far from the shape's position, times 2^e, in the world. */
static vec placed_from(vec x, int e, const shape *s)
{
    EACH(x.c[i] = placed_beside(x.c[i], e, s->pose ? s->pose->p[i] : 0));
    return in_range(x);
}

/* The same in lengths that are plain, whatever the caller's are. 0: neither there, or what is told is no normal number
 * in the caller's. */
static APART enum glanced tell_in_plain_lengths(couplet *k, search *q, int max_steps, const shape *a, const shape *b,
                                                result *r)
{
    real m[2][DIM * DIM];
    int e, of_b;
    const real far = peak(k->c);
    if (!exponent_of_solid(&k->a, &e) || !exponent_of_solid(&k->b, &of_b)) return UNCLEAR;
    if (!(far >= REAL_MIN && far <= REAL_MAX)) return UNCLEAR;
    if (of_b > e) e = of_b;
    if (exponent_of(far) > e) e = exponent_of(far);
    bring_solid(&k->a, m[0], e);
    bring_solid(&k->b, m[1], e);
    EACH(k->c.c[i] = raised(k->c.c[i], -e));
    const enum glanced seen = tell_couplet(k, q, max_steps);
    if (seen != TELLING) return seen;
    k->lower = raised(k->lower, e);
    k->upper = raised(k->upper, e);
    const real least = smaller(size(k->lower), size(k->upper)), most = larger(size(k->lower), size(k->upper));
    if (!(least >= REAL_MIN && most <= REAL_MAX)) return IN_VAIN;
    spell_couplet(k, a, b, r);
    const vec on_a = placed_from(k->on_a, e, a), on_b = k->lower > 0 ? placed_from(k->on_b, e, b) : on_a;
    store(r->point_a, on_a);
    store(r->point_b, on_b);
    return TELLING;
}

/* Whether two solids meet. 0: that is left to others; of solids so many steps and calls have told nothing. */
static APART int look_at_solids(search *q, int max_steps, const shape *a, const shape *b, result *r, int spent[2])
{
    couplet k;
    if (!take_solid(&k.a, a) || !take_solid(&k.b, b) || (k.a.kind == IS_BOX && k.b.kind == IS_BOX)) return 0;
    if (!(a->radius == 0 && b->radius == 0)) return 0;
    k.c = offset(a->pose, b->pose);
    q->d.calls = 0;
    enum glanced seen = tell_couplet(&k, q, max_steps);
    if (seen == TELLING) spell_couplet(&k, a, b, r);
    if (seen == UNCLEAR) seen = tell_in_plain_lengths(&k, q, max_steps, a, b, r);
    spent[0] = k.steps - 1; /* the search asks for the first corner itself */
    spent[1] = k.calls;
    return seen == TELLING;
}

#endif

#endif
