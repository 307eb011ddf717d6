/* SPDX-License-Identifier: MIT */
/* The ready-made supports. Each is written against the same contract as anyone's: a farthest point out, the reach back,
 * NaN for both where the data describe no set. */
#ifndef GJK_CORE_SHAPES_H
#define GJK_CORE_SHAPES_H

#include "reach.h"

typedef pub(points) points;
typedef pub(box) box;
typedef pub(segment) segment;
typedef pub(ball) ball;
typedef pub(ellipsoid) ellipsoid;
typedef pub(couple) couple;

/* The answer of data that describe no set. */
static real refuse(real *out)
{
    store(out, nowhere());
    return (real)NAN;
}

/* Sizes are finite and not negative. */
static int sized(const real *sizes, int n)
{
    int r = 1;
    for (int i = 0; i < n; i++) r &= sizes[i] >= 0 && sizes[i] <= REAL_MAX;
    return r;
}

/* A reach: r, with up to 7 relative roundings and some that underflow; the least number for a set of no size, which
 * rounds nothing. */
static real padded(real r) { return r > 0 ? r * (1 + 8 * UNIT) + 4 * TINY : TINY; }

/* A bound on the length, tight for the cube and along the axes, without square roots, safe from overflow in between. */
static real at_most(vec a)
{
    real box_diagonal = (real)(DIM == 2 ? 1.4142136 : 1.7320509) * peak(a);
    return padded(smaller(spread(a), box_diagonal));
}

/* Along dir, length l; dir is brought to size 1 first, so that its square is within range. The zero vector for none. */
static vec along(vec dir, real l)
{
    if (!(peak(dir) > 0)) return axis(0, 0);
    dir = unit_size(dir);
    return mul(dir, l / length(dir));
}

static size_t stride_of(const points *p) { return p->stride ? p->stride / sizeof(real) : DIM; }

static int cloud(const points *p)
{
    return p->v && p->count > 0 && p->stride % sizeof(real) == 0 &&
           (p->stride == 0 || p->stride >= DIM * sizeof(real)) && p->reach >= 0;
}

GJK_API real pub(points_reach)(const points *p)
{
    if (!p || !cloud(p)) return (real)NAN;
    real far = 0, sum = 0;
    size_t step = stride_of(p);
    for (size_t i = 0; i < p->count; i++) {
        vec x = load(p->v + i * step);
        if (!(spread(x) <= REAL_MAX)) return (real)NAN;
        far = larger(peak(x), far);
    }
    if (far == 0) return padded(0);
    real level = leveler(far);
    for (size_t i = 0; i < p->count; i++) {
        vec x = mul(load(p->v + i * step), level);
        sum = larger(dot(x, x), sum);
    }
    return padded(root(sum) / level);
}

/* A point that is higher than the best one, if there is any among those of almost its height: of points that lie close
 * together far from their origin, their differences tell. A rise of which rounding leaves even the sign open counts
 * where it can't be wrong by more than 2 units of the reach, which heights leave of the licence. */
static size_t settle_tie(const real *v, size_t n, size_t step, real reach, vec d, size_t best, real almost)
{
    vec top = load(v + best * step);
    real highest = 0, leave = 2 * UNIT * reach * peak(d);
    for (size_t i = 0; i < n; i++) {
        vec x = load(v + i * step), e = sub(x, top);
        real rise = dot(e, d), doubt = 4 * UNIT * dot_size(e, d);
        if (!(dot(x, d) >= almost) || !(rise > highest) || !(rise > doubt || doubt <= leave)) continue;
        highest = rise;
        best = i;
    }
    return best;
}

/* Farthest of n points, the first among equals; n if one is not finite. The sum of height * 0 is 0 only if every
 * height, and with it every point, is. The rounding of two heights, 3 each, is within the licence of 8. */
static inline size_t farthest_among(const real *v, size_t n, size_t step, real reach, vec d)
{
    real highest = dot(load(v), d), second = -REAL_MAX, sum = highest * 0;
    size_t best = 0;
    for (size_t i = 1; i < n; i++) {
        real height = dot(load(v + i * step), d);
        sum += height * 0;
        if (height > highest) {
            second = highest;
            highest = height;
            best = i;
        } else {
            second = larger(height, second);
        }
    }
    if (!(sum == 0)) return n;
    real almost = highest - 8 * UNIT * reach * spread(d);
    return second >= almost ? settle_tie(v, n, step, reach, d, best, almost) : best;
}

GJK_API real pub(support_points)(const void *data, const real dir[DIM], real out[DIM])
{
    const points *p = data;
    if (!p || !cloud(p)) return refuse(out);
    size_t step = stride_of(p), best = farthest_among(p->v, p->count, step, p->reach, load(dir));
    if (best == p->count) return refuse(out);
    store(out, load(p->v + best * step));
    return p->reach;
}

GJK_API real pub(support_box)(const void *data, const real dir[DIM], real out[DIM])
{
    const box *b = data;
    if (!b || !sized(b->half, DIM)) return refuse(out);
    EACH(out[i] = signed_as(b->half[i], dir[i]));
    return at_most(load(b->half));
}

/* Among n corners. */
static real farthest_of(const real (*v)[DIM], size_t n, const real dir[DIM], real out[DIM])
{
    real reach = 0;
    for (size_t i = 0; i < n; i++) reach = larger(at_most(load(v[i])), reach);
    size_t best = farthest_among(v[0], n, DIM, smaller(reach, REAL_MAX), load(dir));
    if (best == n || !(reach <= REAL_MAX)) return refuse(out);
    store(out, load(v[best]));
    return reach;
}

GJK_API real pub(support_segment)(const void *data, const real dir[DIM], real out[DIM])
{
    const segment *s = data;
    return s ? farthest_of(s->v, 2, dir, out) : refuse(out);
}

GJK_API real pub(support_origin)(const void *unused, const real dir[DIM], real out[DIM])
{
    (void)unused;
    (void)dir;
    EACH(out[i] = 0);
    return padded(0);
}

GJK_API real pub(support_ball)(const void *data, const real dir[DIM], real out[DIM])
{
    const ball *b = data;
    if (!b || !sized(&b->radius, 1)) return refuse(out);
    store(out, along(load(dir), b->radius));
    return padded(b->radius);
}

/* The radii times the unit vector along (radii times dir). Both are brought to size first: what underflows then is far
 * below the rounding. */
GJK_API real pub(support_ellipsoid)(const void *data, const real dir[DIM], real out[DIM])
{
    const ellipsoid *e = data;
    if (!e || !sized(e->radii, DIM)) return refuse(out);
    vec r = load(e->radii), d = unit_size(load(dir)), g = mul(r, leveler(peak(r)));
    EACH(g.c[i] *= d.c[i]);
    g = along(g, 1);
    EACH(out[i] = r.c[i] * g.c[i]);
    return padded(peak(r));
}

#if DIM == 3
typedef pub(triangle) triangle;
typedef pub(cylinder) cylinder;
typedef pub(cone) cone;
typedef pub(disc) disc;

GJK_API real pub(support_triangle)(const void *data, const real dir[DIM], real out[DIM])
{
    const triangle *t = data;
    return t ? farthest_of(t->v, 3, dir, out) : refuse(out);
}

/* The rim point of the disc of that radius at that height. */
static void rim(const real *dir, real radius, real height, real *out)
{
    vec flat = {{dir[0], dir[1], 0}};
    flat = along(flat, radius);
    flat.c[2] = height;
    store(out, flat);
}

GJK_API real pub(support_disc)(const void *data, const real dir[DIM], real out[DIM])
{
    const disc *d = data;
    if (!d || !sized(&d->radius, 1)) return refuse(out);
    rim(dir, d->radius, 0, out);
    return padded(d->radius);
}

GJK_API real pub(support_cylinder)(const void *data, const real dir[DIM], real out[DIM])
{
    const cylinder *c = data;
    if (!c || !sized(&c->radius, 1) || !sized(&c->half_length, 1)) return refuse(out);
    rim(dir, c->radius, signed_as(c->half_length, dir[2]), out);
    vec corner = {{c->radius, c->half_length, 0}};
    return at_most(corner);
}

/* The apex is h up the axis, the rim h down and r out: the rim is farther where r |flat| > 2 h dir_z. */
GJK_API real pub(support_cone)(const void *data, const real dir[DIM], real out[DIM])
{
    const cone *c = data;
    if (!c || !sized(&c->radius, 1) || !sized(&c->half_length, 1)) return refuse(out);
    vec d = load(dir), corner = {{c->radius, c->half_length, 0}};
    d = unit_size(d);
    real level = leveler(larger(peak(corner), REAL_MIN)), up = 2 * (c->half_length * level) * d.c[2];
    real flat = root(d.c[0] * d.c[0] + d.c[1] * d.c[1]);
    if (c->radius * level * flat > up) {
        rim(dir, c->radius, -c->half_length, out);
    } else {
        store(out, axis(2, c->half_length));
    }
    return at_most(corner);
}
#endif

/* Whether the set is known to be the hull of corners that can be listed. */
static int has_corners(const shape *s)
{
    int r = s->support == pub(support_points) || s->support == pub(support_box) || s->support == pub(support_segment) ||
            s->support == pub(support_origin);
#if DIM == 3
    r |= s->support == pub(support_triangle);
#endif
    return r;
}

/* How many, of a set that has them, and whose support has found the data good. */
static size_t count_corners(const shape *s)
{
    if (s->support == pub(support_points)) return ((const points *)s->data)->count;
    if (s->support == pub(support_box)) return (size_t)1 << DIM;
    if (s->support == pub(support_segment)) return 2;
#if DIM == 3
    if (s->support == pub(support_triangle)) return 3;
#endif
    return 1;
}

static vec nth_corner(const shape *s, size_t n)
{
    vec r = axis(0, 0);
    if (s->support == pub(support_points)) {
        const points *p = s->data;
        return load(p->v + n * stride_of(p));
    }
    if (s->support == pub(support_box)) {
        r = load(((const box *)s->data)->half);
        EACH(r.c[i] = n >> i & 1 ? -r.c[i] : r.c[i]);
    }
    if (s->support == pub(support_segment)) return load(((const segment *)s->data)->v[n]);
#if DIM == 3
    if (s->support == pub(support_triangle)) return load(((const triangle *)s->data)->v[n]);
#endif
    return r;
}

/* The direction as the part sees it, of a size that makes its heights those that the couple sees: not so small that
 * they underflow. */
static vec seen_by(const pose *p, real grows, vec dir)
{
    vec d = levelled(dir);
    real lift = 16 / leveler(peak(dir));
    if (p) {
        if (grows > 0) d = levelled(pull(p->m, mul(d, leveler(grows))));
        lift = grows > 0 ? lift / leveler(grows) : 0;
    }
    return mul(d, smaller(larger(lift, 1), LIFT));
}

/* One of a couple, pose and radius included. Its reach counts all that passes through the rounding here, what
 * underflows too, so that the licence of 8 roundings holds for the couple: so it must be known, and is surveyed where
 * the part does not say. From outside the couple that can't be done. */
static real support_of(const shape *s, vec dir, vec *out)
{
    const pose *p = s->pose;
    real grows = p ? stretch(p->m) : 1;
    if (!s->support || !sized(&s->radius, 1) || !(grows <= REAL_MAX)) return (real)NAN;
    *out = nowhere();
    real reach = s->support(s->data, seen_by(p, grows, dir).c, out->c);
    if (p) *out = add(map(p->m, *out), load(p->p));
    if (s->radius > 0) *out = add(*out, along(dir, s->radius));
    if (reach == 0) reach = surveyed(s->support, s->data, 0);
    int found = reach > 0;
    EACH(found &= bounded(out->c[i]));
    if (!found) return (real)NAN;
    if (faint(reach)) reach += 16 * REAL_MIN;
    return (p ? 4 * (grows * reach) + spread(load(p->p)) : reach) + s->radius + 64 * TINY;
}

/* A couple's reach, which must be finite; so must its parts'. */
static real joint(real reach_a, real reach_b, real reach)
{
    return reach_a <= REAL_MAX && reach_b <= REAL_MAX ? reach : (real)NAN;
}

GJK_API real pub(support_sum)(const void *data, const real dir[DIM], real out[DIM])
{
    const couple *c = data;
    vec a, b, d = load(dir);
    if (!c) return refuse(out);
    real reach_a = support_of(&c->a, d, &a), reach_b = support_of(&c->b, d, &b);
    store(out, add(a, b));
    return joint(reach_a, reach_b, 2 * (reach_a + reach_b));
}

GJK_API real pub(support_hull)(const void *data, const real dir[DIM], real out[DIM])
{
    const couple *c = data;
    vec a, b, d = load(dir);
    if (!c) return refuse(out);
    real reach_a = support_of(&c->a, d, &a), reach_b = support_of(&c->b, d, &b);
    store(out, dot(d, a) >= dot(d, b) ? a : b);
    return joint(reach_a, reach_b, 2 * larger(reach_a, reach_b));
}

#endif
