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

/* The bracket in the caller's units, the radii taken off, each bound rounded its own way. */
static void bracket(result *r, const difference *d, real lower, real upper, const shape *a, const shape *b)
{
    const real radius = a->radius + b->radius;
    const int sharp = !(radius > 0);
    if (!d->wild && (sharp || !unruly(radius))) {
        const real near = lower * d->unscale, far = upper * d->unscale;
        r->lower = sharp ? near : below_sum(near, -a->radius, -b->radius);
        r->upper = sharp ? far : -below_sum(-far, a->radius, b->radius);
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

/* The points x and y, from the bodies' positions, way apart in the frame, from the cores' to the shapes': each moves
 * toward the other by its radius, or, where the radii reach across, both move to one point between. */
HOT void move_points(result *r, const difference *d, vec normal, vec x, vec y, vec way, const shape *a, const shape *b,
                     int deep)
{
    real radius = a->radius + b->radius, far = larger(far_out(a), far_out(b));
    int plain = !d->wild && far < PLAIN && radius < PLAIN;
    real level = plain ? 1 : level_of(d, radius, far), down = level * d->unscale, l = length(way);
    vec on_a = moved(a->pose, x, down, level), on_b = moved(b->pose, y, down, level);
    if (deep > 1 || (deep && r->upper <= 0)) {
        on_a = add(on_a, mul(normal, a->radius * level));
        on_b = sub(on_b, mul(normal, b->radius * level));
    } else if (r->upper <= 0 || l * down < radius * level) {
        real share = a->radius > 0 ? a->radius / radius : 0;
        on_a = on_b = add(on_a, mul(sub(on_b, on_a), share));
    } else if (radius > 0) {
        vec toward_b = l > 0 ? mul(way, -1 / l) : normal;
        on_a = add(on_a, mul(toward_b, a->radius * level));
        on_b = sub(on_b, mul(toward_b, b->radius * level));
    }
    store(r->point_a, plain ? on_a : in_range(mul(on_a, 1 / level)));
    store(r->point_b, plain ? on_b : in_range(mul(on_b, 1 / level)));
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
