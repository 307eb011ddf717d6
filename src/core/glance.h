/* SPDX-License-Identifier: MIT */
/* The first glance, where it is only asked whether the bodies meet: most pairs of a scene are far apart, and one corner
 * along the line of centres shows it. That is told in the caller's own lengths, without a frame, if their squares
 * neither underflow nor overflow; else in the frame, to the same bits. */
#ifndef GJK_CORE_GLANCE_H
#define GJK_CORE_GLANCE_H

#include "plain.h"

/* What one corner shows along v. */
typedef struct evidence {
    vec a, b, w; /* the bodies' points, from their positions, and the corner */
    real height; /* of w along v, times the length of v, */
    real l;      /* which this is */
    real lower, upper;
} evidence;

/* The corner of the points x and y, times their grain. */
HOT evidence corner_shown(const difference *d, vec v, vec c, vec x, vec y)
{
    evidence e;
    e.a = d->a.posed ? map(d->a.m, x) : x;
    e.b = d->b.posed ? map(d->b.m, y) : y;
    e.w = sub(e.a, add(e.b, c));
    e.height = dot(v, e.w);
    return e;
}

/* Of the body's map, times that power of two, the sum of squares, whose root bounds all norms of it, with its signs or
 * without; and the square of the set's reach, its points times that grain. */
static inline real square_of_map(const body *k, real level)
{
    if (!k->posed) return 1;
    const real first = k->m[0] * level, second = k->m[1] * level;
    real even = first * first, odd = second * second; /* side by side, where the machine can */
    for (int i = 2; i + 1 < DIM * DIM; i += 2) {
        const real one = k->m[i] * level, other = k->m[i + 1] * level;
        even += one * one;
        odd += other * other;
    }
    const real last = k->m[DIM * DIM - 1] * level;
    return DIM % 2 ? even + odd + last * last : even + odd;
}

static inline real square_of_reach(const body *k, real grain)
{
    if (k->asked == AS_BOX) {
        vec half = mul(load(((const box *)k->data)->half), grain);
        return dot(half, half);
    }
    real reach = k->list.reach * grain * (1 + 8 * UNIT);
    return reach * reach;
}

/* The doubt, and what raise and spell charge besides, of bodies that reach A and B from their positions, c apart, is no
 * more than UNIT (30 A + 30 B + 20 |c|), and that below this many roundings of the root of A^2 + B^2 + c^2. */
#define GLANCE_DOUBT (48 * UNIT)

/* The bounds of the cores; square is A^2 + B^2 + c^2. */
HOT void weigh_evidence(evidence *e, vec v, real square)
{
    const real off = GLANCE_DOUBT * root(square);
    e->l = length(v);
    e->lower = e->height / e->l - off;
    e->upper = length(e->w) + off;
}

/* Of sharp bodies, in the caller's lengths. */
HOT void spell_sharp(const evidence *e, vec v, const shape *a, const shape *b, result *r)
{
    r->value = r->lower = e->lower;
    r->upper = e->upper;
    store(r->point_a, a->pose ? add(e->a, load(a->pose->p)) : e->a);
    store(r->point_b, b->pose ? add(e->b, load(b->pose->p)) : e->b);
    EACH(r->normal[i] = 0 - v.c[i] / e->l);
    r->steps = 1;
    r->supports = 2;
    r->reserved = 0;
}

/* Of any, in the lengths of the search's frame. */
static int spell_evidence(search *q, const evidence *e, vec v, vec x, vec y, const shape *a, const shape *b, result *r)
{
    const closest pair = {.x = x, .y = y, .w = e->w};
    q->lower = e->lower;
    EACH(q->normal.c[i] = 0 - v.c[i] / e->l);
    spell(q, a, b, e->upper, &pair, r);
    r->value = r->lower;
    r->steps = 1;
    return r->lower > 0;
}

/* Of round bodies, in the caller's lengths: a frame of scale 1, for as long as that takes. 0: the radii meet, and r is
 * as it was. */
static int spell_round(search *q, const evidence *e, vec v, const vertex *p, const shape *a, const shape *b, result *r)
{
    difference *d = &q->d;
    result round;
    d->scale = d->unscale = d->a.grain = d->b.grain = 1;
    d->wild = 0;
    d->calls = 2;
    q->steps = 1;
    if (!spell_evidence(q, e, v, p->x, p->y, a, b, &round)) return 0;
    *r = round;
    return 1;
}

/* Whether the first corner shows it, of two bodies listed, of which nothing more is known. */
static inline enum glanced glance(search *q, const shape *a, const shape *b, result *r)
{
    difference *d = &q->d;
    const vec c = offset(a->pose, b->pose), v = mul(c, -1);
    const real cc = dot(c, c);
    vertex *p = &q->s.slot[0];
    if (!(cc > 1 / PLAIN) || !(a->radius >= 0 && b->radius >= 0 && a->radius + b->radius < PLAIN)) return UNCLEAR;
    if (!farthest_plain(&d->a, c, FIRST_SIGHT, &p->x) || !farthest_plain(&d->b, v, FIRST_SIGHT, &p->y)) return UNCLEAR;
    evidence e = corner_shown(d, v, c, p->x, p->y);
    p->w = e.w;
    if (!(e.height > 0)) return IN_VAIN;
    const real map_a = square_of_map(&d->a, 1), map_b = square_of_map(&d->b, 1);
    const real set_a = square_of_reach(&d->a, 1), set_b = square_of_reach(&d->b, 1);
    if (!(smaller(smaller(map_a, map_b), smaller(set_a, set_b)) > 1 / PLAIN)) return UNCLEAR;
    const real square = map_a * set_a + map_b * set_b + cc;
    if (!(square < REAL_MAX / 4)) return UNCLEAR; /* the squares of w and of its height are up to three times that */
    weigh_evidence(&e, v, square);
    if (!(e.lower > a->radius + b->radius)) return IN_VAIN;
    if (a->radius + b->radius > 0) return spell_round(q, &e, v, p, a, b, r) ? TELLING : IN_VAIN;
    spell_sharp(&e, v, a, b, r);
    return TELLING;
}

/* The square of how far the body reaches from its position, in the frame. */
static real square_in_frame(const body *k)
{
    const real level = k->posed ? leveler(k->norm) : 1;
    return square_of_map(k, level) * square_of_reach(k, k->grain / level);
}

/* The same in the frame, of the corner in the spare slot. */
static APART int glance_in_frame(search *q, const shape *a, const shape *b, result *r)
{
    const difference *d = &q->d;
    const vertex *p = spare(&q->s);
    const vec x = mul(p->x, d->a.grain), y = mul(p->y, d->b.grain), normal = q->normal;
    const real lower = q->lower, square = square_in_frame(&d->a) + square_in_frame(&d->b);
    evidence e = corner_shown(d, q->v, d->c, x, y);
    if (!(e.height > 0)) return 0;
    weigh_evidence(&e, q->v, square + dot(d->c, d->c));
    if (e.lower > 0 && spell_evidence(q, &e, q->v, x, y, a, b, r)) return 1;
    q->lower = lower;
    q->normal = normal;
    return 0;
}

#endif
