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

HOT evidence corner_shown(const difference *d, vec v, const vertex *p)
{
    const vec x = mul(p->x, d->a.grain), y = mul(p->y, d->b.grain);
    evidence e = {.height = 0};
    e.a = mapped(&d->a, x);
    e.b = mapped(&d->b, y);
    e.w = sub(e.a, add(e.b, d->c));
    e.height = dot(v, e.w);
    return e;
}

/* The way to the corner least along it, as the bodies see it. */
typedef struct sought {
    vec of_a, of_b;
} sought;

HOT sought seek_both(const difference *d, vec way)
{
    const duos dirs = duos_pulled(&d->maps, duos_of(mul(way, -1), way));
    return (sought){seen_or_first(vec_of_a(dirs)), seen_or_first(vec_of_b(dirs))};
}

/* What the corner of these two points shows along the way. */
HOT void see_corner(const difference *d, vec way, duos x, evidence *e)
{
    const duos at = duos_mapped(&d->maps, x);
    e->a = vec_of_a(at);
    e->b = vec_of_b(at);
    e->w = corner_at_spots(d, at);
    e->height = dot(way, e->w);
}

HOT vec squared_columns(const real *m, real level)
{
    vec uu;
    EACH(uu.c[i] = (m[i] * level) * (m[i] * level);
         for (int j = 1; j < DIM; j++) uu.c[i] += (m[DIM * j + i] * level) * (m[DIM * j + i] * level));
    return uu;
}

/* The squared lengths of the body's axes, its map times that power of two. */
static inline vec squared_axes(const body *k, real level)
{
    vec uu = axis(0, 1);
    if (!k->posed) {
        EACH(uu.c[i] = 1);
        return uu;
    }
    return squared_columns(k->m, level);
}

/* Of the body's map, the sum of squares, whose root bounds all norms of it, with its signs or without; and the square
 * of the set's reach, its points times grain, and then times by: in this order nothing overflows. */
HOT real sum_of_all(vec x)
{
    real sum = x.c[0];
    REST(sum += x.c[i]);
    return sum;
}

static inline real square_of_map(const body *k, vec uu) { return k->posed ? sum_of_all(uu) : 1; }

HOT real square_of_list(const list *l, real grain, real by)
{
    const real reach = l->reach * grain * by * (1 + 8 * UNIT);
    return reach * reach;
}

static inline real square_of_reach(const body *k, real grain, real by)
{
    if (k->asked == AS_BOX) {
        vec half = mul(mul(load(((const box *)k->data)->half), grain), by);
        return dot(half, half);
    }
    return square_of_list(&k->list, grain, by);
}

/* The doubt, and what raise and spell charge besides, of bodies that reach A and B from their positions, c apart, is no
 * more than UNIT (30 A + 30 B + 20 |c|), and that below this many roundings of the root of A^2 + B^2 + c^2. */
#define GLANCE_DOUBT (48 * UNIT)

/* The bound from below of a corner so high along a way, times its length l. A way so short that its squares have lost
 * digits to underflow proves nothing. */
HOT real proven_along(real height, real l, real doubt)
{
    return l * l > REAL_MIN / (2 * UNIT) ? height / l - doubt : -REAL_MAX;
}

/* The bounds of the cores. */
HOT void weigh_evidence(evidence *e, vec v, real doubt)
{
    e->l = length(v);
    e->lower = proven_along(e->height, e->l, doubt);
    e->upper = length(e->w) + doubt;
}

/* Of sharp bodies, whose lengths come times that power of two. */
HOT void spell_sharp(const search *q, const evidence *e, vec v, real unscale, const shape *a, const shape *b, result *r)
{
    const vec on_a = mul(e->a, unscale), on_b = mul(e->b, unscale);
    r->value = r->lower = e->lower * unscale;
    r->upper = e->upper * unscale;
    store(r->point_a, a->pose ? add(on_a, load(a->pose->p)) : on_a);
    store(r->point_b, b->pose ? add(on_b, load(b->pose->p)) : on_b);
    EACH(r->normal[i] = 0 - v.c[i] / e->l);
    r->steps = q->steps + 1;
    r->supports = q->d.calls;
    r->reserved = 0;
}

/* Of any. 0: the radii meet, and nothing is changed. */
static int spell_evidence(search *q, const evidence *e, vec v, const shape *a, const shape *b, result *r)
{
    const real lower = q->lower;
    const vec normal = q->normal;
    result told;
    q->lower = e->lower;
    EACH(q->normal.c[i] = 0 - v.c[i] / e->l);
    spell(q, a, b, e->upper, e->a, e->b, e->w, &told);
    told.value = told.lower;
    told.steps = q->steps + 1;
    if (told.lower > 0) *r = told;
    q->lower = lower;
    q->normal = normal;
    return told.lower > 0;
}

/* Whether it shows the bodies to be apart. */
HOT int tell_evidence(search *q, evidence *e, vec v, const shape *a, const shape *b, result *r)
{
    const difference *d = &q->d;
    if (!(e->height > 0)) return 0;
    weigh_evidence(e, v, d->doubt);
    if (!(e->lower > (a->radius + b->radius) * d->scale)) return 0;
    if (a->radius + b->radius > 0 || d->wild || d->scale != 1) return spell_evidence(q, e, v, a, b, r);
    spell_sharp(q, e, v, 1, a, b, r);
    return 1;
}

/* A frame of scale 1: the caller's lengths. Its doubt is not known yet. */
HOT void stay_outside(difference *d, const shape *a, const shape *b)
{
    d->c = offset(a->pose, b->pose);
    d->scale = d->unscale = d->a.grain = d->b.grain = 1;
    d->wild = 0;
}

/* The doubt of bodies so far apart, by the squares of that, of their maps and of their sets' reaches. 0: squares
 * underflow, or overflow, as those of w and of its height do, which are up to three times the whole. */
HOT int doubt_by_squares(difference *d, real cc, duo sums, duo sets)
{
    real map[2];
    squares_of_maps(d, sums, map);
    const duo maps = duo_of(map[0], map[1]), wholes = duo_mul(maps, sets);
    const real square = of_a(wholes) + of_b(wholes) + cc;
    d->doubt = GLANCE_DOUBT * root(square);
    return are_larger(duo_smaller(maps, sets), duo_both(1 / PLAIN)) && square < REAL_MAX / 4;
}

/* The same of bodies whose maps lie side by side. */
HOT int doubt_of_listed(difference *d, real cc)
{
    const duo sets = duo_of(square_of_reach(&d->a, 1, 1), square_of_reach(&d->b, 1, 1));
    return doubt_by_squares(d, cc, square_of_duo_map(&d->maps), sets);
}

/* The square of the way between the bodies does not underflow, and their radii are plain. */
HOT int are_plain(real cc, const shape *a, const shape *b)
{
    return cc > 1 / PLAIN && a->radius >= 0 && b->radius >= 0 && a->radius + b->radius < PLAIN;
}

/* Along v, and nothing is known yet. */
HOT void start_glance(search *q, vec v)
{
    q->v = v;
    q->lower = -REAL_MAX;
    q->normal = axis(0, 1);
    q->steps = 0;
    q->pending = 0;
    q->d.calls = 2;
}

/* Whether the first corner shows it, of two bodies listed, of which nothing more is known. */
static inline enum glanced glance(search *q, const shape *a, const shape *b, result *r)
{
    difference *d = &q->d;
    vertex *p = &q->s.slot[0];
    evidence e;
    stay_outside(d, a, b);
    const vec v = mul(d->c, -1);
    const real cc = dot(v, v);
    if (!are_plain(cc, a, b)) return UNCLEAR;
    know_reach_listed(&d->a);
    know_reach_listed(&d->b);
    lay_maps(d);
    const sought s = seek_both(d, v);
    if (!farthest_seen(&d->a, s.of_a, FIRST_SIGHT, &p->x) || !farthest_seen(&d->b, s.of_b, FIRST_SIGHT, &p->y))
        return UNCLEAR;
    see_corner(d, v, duos_of(p->x, p->y), &e);
    p->w = e.w;
    start_glance(q, v);
    if (!doubt_of_listed(d, cc)) return UNCLEAR;
    return tell_evidence(q, &e, v, a, b, r) ? TELLING : IN_VAIN;
}

/* The square of how far the body reaches from its position, in the frame. */
static real square_in_frame(const body *k)
{
    const real level = k->posed ? leveler(k->norm) : 1;
    return square_of_map(k, squared_axes(k, level)) * square_of_reach(k, k->grain, 1 / level);
}

/* The doubt as a glance has it, in the frame. */
static real doubt_in_frame(const difference *d)
{
    const real square = square_in_frame(&d->a) + square_in_frame(&d->b) + dot(d->c, d->c);
    return GLANCE_DOUBT * root(square) + (d->wild ? d->lost : 0);
}

/* The same of the corner in the spare slot, in the frame, with that doubt. */
static int glance_in_frame(search *q, const shape *a, const shape *b, result *r)
{
    const difference *d = &q->d;
    const vertex *p = spare(&q->s);
    evidence e;
    const int boxes = d->a.asked == AS_BOX && d->b.asked == AS_BOX; /* leave zeros their signs without a frame, too */
    if (boxes) e = corner_shown(d, q->v, p);
    else see_corner(d, q->v, duos_mul(duos_of(p->x, p->y), d->grains), &e);
    return tell_evidence(q, &e, q->v, a, b, r);
}

#endif
