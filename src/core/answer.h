/* SPDX-License-Identifier: MIT */
/* From the search's frame to the caller's: the bracket with the radii taken off, and the pair of points. */
#ifndef GJK_CORE_ANSWER_H
#define GJK_CORE_ANSWER_H

#include "distance.h"

/* The power of two that brings the largest of the pair, the radius and how far it is from the world's origin to size:
 * to what is reckoned in that unit no other makes a difference. */
static real level_of(const difference *d, real radius, real far)
{
    if (radius == 0 && far == 0) return d->scale;
    return smaller(d->scale, smaller(leveler(size(radius)), leveler(far))); /* a radius may be -0 */
}

/* A number below x + y + z; level * each is of size 1 at most. */
static real below_sum(real x, real y, real z)
{
    twin r = sum_of(y, z), s = sum_of(x, r.high);
    s = sum_of(s.high, s.low + r.low);
    return below(s.high, s.low - 4 * UNIT * UNIT * (size(x) + size(r.high)), 0);
}

/* Radii times level, a power of two; what underflows there goes the bound's way. */
static inline real above_scaled(real radius, real level, real up)
{
    real r = radius * level;
    return r * up < radius ? r + TINY : r;
}

static inline real below_scaled(real radius, real level, real up)
{
    real r = radius * level;
    return r * up > radius ? r - TINY : r;
}

/* A bound in the caller's unit; a subnormal one is rounded. */
static real rescaled(real bound, real unscale, real way_out)
{
    real r = bound * unscale;
    return size(r) < REAL_MIN ? r + way_out * 2 * TINY : r;
}

/* A bound from below that came out of the frame; or the number below it, if it was rounded up there, of subnormals. */
static inline real no_more_than(real bound, real scale, real out) { return out * scale > bound ? out - TINY : out; }

/* The bracket in the caller's units, the radii taken off, each bound rounded its own way. */
static void bracket(result *r, const difference *d, real lower, real upper, const shape *a, const shape *b)
{
    const real radius = a->radius + b->radius;
    const int sharp = !(radius > 0);
    if (!d->wild && (sharp || !unruly(radius))) {
        const real near = lower * d->unscale, far = upper * d->unscale;
        r->lower = sharp ? no_more_than(lower, d->scale, near) : below_sum(near, -a->radius, -b->radius);
        r->upper = -(sharp ? no_more_than(-upper, d->scale, -far) : below_sum(-far, a->radius, b->radius));
        return;
    }
    real level = level_of(d, radius, 0), down = level * d->unscale, up = 1 / level;
    real near = lower * down, far = upper * down;
    if (!sharp) {
        near = below_sum(near, -above_scaled(a->radius, level, up), -above_scaled(b->radius, level, up));
        far = -below_sum(-far, below_scaled(a->radius, level, up), below_scaled(b->radius, level, up));
    }
    r->lower = larger(near * up, -REAL_MAX);
    r->upper = far * up;
    if (r->lower * level > near) r->lower -= TINY; /* it was rounded on the way out, of subnormals */
    if (r->upper * level < far) r->upper += TINY;
}

/* How far apart, the radii taken off what the cores are apart, which is known to twice the digits: rounded once. */
HOT real gap_of(const difference *d, twin apart, const shape *a, const shape *b)
{
    if (a->radius + b->radius == 0) return (apart.high + apart.low) * d->unscale;
    const twin radii = sum_of(a->radius * d->scale, b->radius * d->scale), gap = sum_of(apart.high, -radii.high);
    return (gap.high + (gap.low + (apart.low - radii.low))) * d->unscale;
}

/* At the edge of the numbers where these end before the body does. */
static vec in_range(vec x)
{
    EACH(x.c[i] = larger(smaller(x.c[i], REAL_MAX), -REAL_MAX));
    return x;
}

/* What lies there from the body's position, in the world, times level; down leads there from the search's frame. */
HOT vec moved(const pose *o, vec x, real down, real level)
{
    x = mul(x, down);
    return o ? add(x, mul(load(o->p), level)) : x;
}

static inline real far_out(const shape *s) { return s->pose ? peak(load(s->pose->p)) : 0; }

/* A point of each body. */
typedef struct two_points {
    vec a, b;
} two_points;

/* The points x and y, from the bodies' positions, way apart in the frame, from the cores' to the shapes', times level:
 * each moves toward the other by its radius, or, where the radii reach across, both move to one point between. */
HOT two_points moved_points(const result *r, vec normal, vec x, vec y, vec way, real down, real level, const shape *a,
                            const shape *b, int deep)
{
    const real radius = a->radius + b->radius;
    two_points on = {moved(a->pose, x, down, level), moved(b->pose, y, down, level)};
    if (!(radius > 0)) {
        if (r->upper <= 0 && !deep) on.b = on.a;
        return on;
    }
    real l = 0;
    vec toward_b = normal;
    if (deep < 2 && !(deep && r->upper <= 0)) {
        l = length_anyhow(way);
        if (r->upper <= 0 || l * down < radius * level) {
            const real share = a->radius > 0 ? a->radius / radius : 0;
            on.a = on.b = add(on.a, mul(sub(on.b, on.a), share));
            return on;
        }
        if (l > 0) toward_b = unruly(l) ? along(way, -1) : mul(way, -1 / l);
    }
    on.a = add(on.a, mul(toward_b, a->radius * level));
    on.b = sub(on.b, mul(toward_b, b->radius * level));
    return on;
}

/* Of sizes or in places that are not plain. */
static APART void move_wild_points(result *r, const difference *d, vec normal, vec x, vec y, vec way, real far,
                                   const shape *a, const shape *b, int deep)
{
    const real level = level_of(d, a->radius + b->radius, far);
    const two_points on = moved_points(r, normal, x, y, way, level * d->unscale, level, a, b, deep);
    store(r->point_a, in_range(mul(on.a, 1 / level)));
    store(r->point_b, in_range(mul(on.b, 1 / level)));
}

/* To the result, in the world. */
HOT void move_points(result *r, const difference *d, vec normal, vec x, vec y, vec way, const shape *a, const shape *b,
                     int deep)
{
    const real far = larger(far_out(a), far_out(b));
    if (d->wild || !(far < PLAIN) || !(a->radius + b->radius < PLAIN)) {
        move_wild_points(r, d, normal, x, y, way, far, a, b, deep);
        return;
    }
    const two_points on = moved_points(r, normal, x, y, way, d->unscale, 1, a, b, deep);
    store(r->point_a, on.a);
    store(r->point_b, on.b);
}

/* The same of the bodies' own points, times their grain. */
static APART void place_points(result *r, const search *q, vec x, vec y, vec way, const shape *a, const shape *b,
                               int deep)
{
    move_points(r, &q->d, q->normal, mapped(&q->d.a, x), mapped(&q->d.b, y), way, a, b, deep);
}

/* The same of points from the bodies' positions. */
static APART void place_at(result *r, const search *q, vec at_a, vec at_b, vec way, const shape *a, const shape *b)
{
    move_points(r, &q->d, q->normal, at_a, at_b, way, a, b, 0);
}

/* And of sharp bodies apart, of plain sizes in plain places, as a rule. */
HOT void place_pair(result *r, const search *q, vec at_a, vec at_b, vec way, const shape *a, const shape *b)
{
    if (q->d.wild || a->radius + b->radius != 0 || !(r->upper > 0) || !(far_out(a) < PLAIN && far_out(b) < PLAIN)) {
        place_at(r, q, at_a, at_b, way, a, b);
        return;
    }
    store(r->point_a, moved(a->pose, at_a, q->d.unscale, 1));
    store(r->point_b, moved(b->pose, at_b, q->d.unscale, 1));
}

/* Those that the weights single out. */
static void witness(result *r, const search *q, const real weight[], const shape *a, const shape *b, int deep)
{
    vec x = blend(&q->s, weight, offsetof(vertex, x), q->d.a.grain);
    vec y = blend(&q->s, weight, offsetof(vertex, y), q->d.b.grain);
    place_points(r, q, x, y, blend(&q->s, weight, offsetof(vertex, w), 1), a, b, deep);
}

/* Nothing is asked but what everyone asks. */
static inline int asks_nothing_else(const options *o)
{
    return !o || (o->size == sizeof *o && !o->tight &&
                  size(o->abs_tol) + size(o->rel_tol) + size(o->cutoff) + size(o->slack) == 0);
}

/* As the question has it: of the distance none is below 0, of the depth all are what they are. */
HOT void say_plainly(result *r, int sign_only, int deep)
{
    if (sign_only) {
        r->value = r->lower > 0 ? r->lower : r->upper;
        return;
    }
    if (!deep) {
        r->upper = larger(r->upper, 0);
        r->lower = larger(r->lower, 0);
    }
    r->value = smaller(larger(r->value, r->lower), r->upper);
}

#endif
