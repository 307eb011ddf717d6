/* SPDX-License-Identifier: MIT */
/* Whether two bodies meet, where the first glance has told nothing, and a few more corners may: most pairs that overlap
 * are told by four. The walk's first steps are taken without its frame and without its care: lengths are brought to
 * size by the doubt of a glance, corners are sought in haste, and what they show is told as a glance tells it. Whatever
 * is out of the ordinary is left to the walk, which takes over from there. */
#ifndef GJK_CORE_STRIDE_H
#define GJK_CORE_STRIDE_H

#include "glance.h"

#if DIM == 3

/* Neither is a point or a segment, which have no inside; not both are boxes, which are told by their axes; and there
 * are no radii, which may reach across before the cores meet. */
static inline int are_for_strides(const difference *d, const shape *a, const shape *b)
{
    return !is_thin(&d->a) && !is_thin(&d->b) && (d->a.asked != AS_BOX || d->b.asked != AS_BOX) &&
           a->radius + b->radius == 0;
}

/* The corner is not so near to the origin that it gives no direction. */
static inline int stands_clear(const vertex *p) { return dot(p->w, p->w) > UNIT * UNIT / 4; }

/* The corner in the first slot is the simplex. */
static inline void stand_on_first(search *q)
{
    clear(&q->s);
    q->s.n = 1;
    q->way = first_direction(&q->d);
    q->v = q->s.slot[0].w;
    q->vv = dot(q->v, q->v);
    q->weight[0] = 1;
    q->weighed = 1;
    q->lower = -4;
    q->normal = axis(0, 1);
    q->pending = q->repeated = q->stood = q->kept = 0;
    q->borrowed = 0;
    q->d.slack = 0;
    q->d.loose = 0;
    q->steps = 1;
}

/* A frame by the doubt of a glance at bodies in the caller's lengths: the root that it is made of is of size 1 to 2. */
static inline void bring_to_size(search *q)
{
    difference *d = &q->d;
    d->scale = d->a.grain = d->b.grain = leveler(d->doubt * (1 / GLANCE_DOUBT));
    d->unscale = 1 / d->scale;
    d->c = mul(d->c, d->scale);
    d->doubt *= d->scale;
    q->s.slot[0].w = mul(q->s.slot[0].w, d->scale);
}

/* One in so many of long lists' corners is looked at; of all bounds can be told. */
typedef struct portion {
    list a, b; /* all of them */
    size_t n;
} portion;

static inline void look_at_portion(difference *d, portion *k, size_t n)
{
    k->n = n;
    d->a.list = k->a;
    d->b.list = k->b;
    if (n == 1) return;
    thin_out(&d->a, n);
    thin_out(&d->b, n);
}

static inline portion first_portion(const difference *d)
{
    const size_t of_a = share_of(&d->a), of_b = share_of(&d->b);
    return (portion){d->a.list, d->b.list, of_a > of_b ? of_a : of_b};
}

/* The body's point farthest along the frame's direction, in haste, and where it is placed. 0: it is none. */
static APART int point_toward(const body *k, vec dir, vec *x, vec *at)
{
    if (!farthest_plain(k, dir, HASTY, x)) return 0;
    *at = place(k, *x);
    return 1;
}

/* The corner least along the way, in haste; where A's point of it is placed; and what it shows. 0: it is none. */
static inline int seek_corner(search *q, evidence *e, vec at[DIM + 1])
{
    difference *d = &q->d;
    const int slot = q->s.at[q->s.n];
    vertex *p = &q->s.slot[slot];
    if (d->wild) {
        if (!ask_with(d, q->way, HASTY, p)) return 0;
        e->a = place(&d->a, p->x);
        e->b = place(&d->b, p->y);
    } else {
        d->calls += 2;
        if (!point_toward(&d->a, mul(q->way, -1), &p->x, &e->a) || !point_toward(&d->b, q->way, &p->y, &e->b)) return 0;
    }
    at[slot] = e->a;
    p->w = e->w = sub(e->a, add(e->b, d->c));
    e->height = dot(q->way, e->w);
    q->pending = 1;
    return 1;
}

/* It proves the bodies to be apart. */
static inline int tell_stride(search *q, evidence *e, const shape *a, const shape *b, result *r)
{
    if (!(e->height > 0)) return 0;
    weigh_evidence(e, q->way, q->d.doubt);
    if (!(e->lower > 0)) return 0;
    q->pending = 0; /* the next query starts better from the others */
    if (q->d.wild) return spell_evidence(q, e, q->way, spare(&q->s), a, b, r);
    spell_sharp(q, e, q->way, q->d.unscale, a, b, r);
    return 1;
}

/* What it proves, whatever becomes of it. */
static inline void keep_evidence(search *q, const evidence *e)
{
    const real l = length(q->way), lower = e->height / l - q->d.doubt;
    if (!(lower > q->lower)) return;
    q->lower = lower;
    EACH(q->normal.c[i] = 0 - q->way.c[i] / l);
}

/* With the corner in the spare slot a triangle holds the origin; its weights, and how much room it has there, as
 * rough_room has it: of the heights' squares, and of corners no farther out than the doubt says. 0: none for certain.
 */
static inline real room_with_last(const search *q, real weight[DIM + 1])
{
    const simplex *s = &q->s;
    const vec p = point(s, 3), a = sub(point(s, 0), p), b = sub(point(s, 1), p), c = sub(point(s, 2), p);
    const vec bc = cross(b, c), ca = cross(c, a), ab = cross(a, b), last = add(add(bc, ca), ab);
    const real turn = signed_as(1, dot(a, bc)), far = q->d.doubt * (1 / GLANCE_DOUBT);
    const real doubt = 667 * UNIT * (far * far * far); /* 128 UNIT (sqrt(3) far)^3: docs/bounds.md */
    weight[0] = -dot(p, bc) * turn;
    weight[1] = -dot(p, ca) * turn;
    weight[2] = -dot(p, ab) * turn;
    weight[3] = dot(point(s, 0), cross(point(s, 1), point(s, 2))) * turn;
    const real u0 = weight[0] - doubt, u1 = weight[1] - doubt, u2 = weight[2] - doubt, u3 = weight[3] - doubt;
    if (!(u0 > 0 && u1 > 0 && u2 > 0 && u3 > 0)) return 0;
    real least = u0 * u0 / dot(bc, bc);
    least = smaller(u1 * u1 / dot(ca, ca), least);
    least = smaller(u2 * u2 / dot(ab, ab), least);
    least = smaller(u3 * u3 / dot(last, last), least);
    return root(least) * (1 - 8 * UNIT);
}

/* They meet, at least that deep; at is the point of both, from A's position. */
static void spell_met(const search *q, vec at, real upper, const shape *a, const shape *b, result *r)
{
    const real unscale = q->d.unscale;
    r->lower = q->lower * unscale;
    r->upper = upper * unscale;
    if (q->d.wild) bracket(r, &q->d, q->lower, upper, a, b);
    r->value = r->upper;
    at = mul(at, unscale);
    if (a->pose) at = add(at, load(a->pose->p));
    if (q->d.wild) at = in_range(at);
    store(r->point_a, at);
    store(r->point_b, at);
    store(r->normal, q->normal);
    r->steps = q->steps;
    r->supports = q->d.calls;
    r->reserved = 0;
}

/* The full simplex holds the origin with room; at, by slot, is where A's points of its corners are placed. 0: the
 * weights miss the point of both. */
static int tell_met(const search *q, const real weight[DIM + 1], const vec at[DIM + 1], const shape *a, const shape *b,
                    result *r)
{
    const real per = 1 / (weight[0] + weight[1] + weight[2] + weight[3]), upper = q->d.doubt - q->inside;
    vec on_a = axis(0, 0), off = axis(0, 0);
    for (int i = 0; i <= DIM; i++) {
        const real part = weight[i] * per;
        on_a = add(on_a, mul(at[q->s.at[i]], part));
        off = add(off, mul(point(&q->s, i), part));
    }
    if (!(peak(off) <= q->d.doubt / 8) || !(upper * q->d.unscale < 0)) return 0;
    spell_met(q, on_a, upper, a, b, r);
    return 1;
}

/* The corner in the spare slot closes a full simplex around the origin, and that is told. */
static int tell_closed(search *q, const evidence *e, int of_all, const vec at[DIM + 1], const shape *a, const shape *b,
                       result *r)
{
    real weight[DIM + 1];
    const real inside = room_with_last(q, weight);
    if (!(inside > q->d.doubt)) return 0;
    q->inside = inside;
    if (of_all) keep_evidence(q, e);
    if (!tell_met(q, weight, at, a, b, r)) return 0;
    q->s.n = DIM + 1;
    q->pending = 0;
    return 1;
}

/* The corner in the spare slot lies no lower along v. */
static inline int leads_nowhere(const search *q)
{
    const vec w = point(&q->s, q->s.n);
    return !(q->vv - dot(q->v, w) > noise_along(q->v, w));
}

/* From the corner in the first slot, which has told nothing. STRODE: neither have those that are in the simplex now,
 * and one that may be pending. UNCLEAR: something is wrong. */
static enum glanced stride_among(search *q, portion *k, int max_steps, const shape *a, const shape *b, result *r)
{
    const vec centres = q->way;
    vec at[DIM + 1];
    evidence e = {.height = 0};
    int headings = HEADINGS;
    at[0] = place(&q->d.a, q->s.slot[0].x);
    while (q->steps < max_steps) {
        const int heads = headings-- > 0, of_all = k->n == 1;
        q->way = heads ? heading(q, centres) : q->v;
        if (!seek_corner(q, &e, at)) return UNCLEAR;
        if (of_all && tell_stride(q, &e, a, b, r)) return TELLING;
        q->steps++;
        if (q->s.n == DIM && tell_closed(q, &e, of_all, at, a, b, r)) return TELLING;
        q->stood = leads_nowhere(q) || (!of_all && !heads && !(dot(q->v, e.w) < q->vv / 2));
        if (!q->stood && q->s.n <= DIM && step_plainly(q) && q->s.n <= DIM) continue;
        if (of_all || q->s.n > DIM) {
            if (of_all) keep_evidence(q, &e);
            return STRODE;
        }
        look_at_portion(&q->d, k, k->n / 4);
        q->pending = 0;
    }
    return STRODE;
}

static enum glanced stride(search *q, int max_steps, const shape *a, const shape *b, result *r)
{
    portion k = first_portion(&q->d);
    stand_on_first(q);
    if (k.n > 1) {
        const evidence first = {.height = dot(q->way, q->v)};
        keep_evidence(q, &first);
        look_at_portion(&q->d, &k, k.n);
    }
    const enum glanced seen = stride_among(q, &k, max_steps, a, b, r);
    look_at_portion(&q->d, &k, 1);
    return seen;
}

/* Where the walk may go on, in another frame. */
static void leave_trail(search *q)
{
    trail *t = &q->trail;
    memcpy(t->at, q->s.at, sizeof t->at);
    t->n = q->s.n;
    t->unscale = q->d.unscale;
    t->vv = q->vv;
    t->lower = q->lower;
    t->normal = q->normal;
    t->pending = q->pending;
    t->steps = q->steps;
    t->calls = q->d.calls;
}

/* Of bodies at which a glance was cast in vain, in the caller's lengths. */
static APART enum glanced stride_outside(search *q, int max_steps, const shape *a, const shape *b, result *r)
{
    vec uu[2];
    if (!are_for_strides(&q->d, a, b)) return IN_VAIN;
    if (!doubt_by_squares(&q->d, dot(q->d.c, q->d.c), uu)) return UNCLEAR;
    bring_to_size(q);
    const enum glanced seen = stands_clear(&q->s.slot[0]) ? stride(q, max_steps, a, b, r) : UNCLEAR;
    if (seen == STRODE) leave_trail(q);
    return seen;
}

/* That frame of bodies in another, which is as large to a binade or two: so that bits are the same. */
static void bring_frame_to_size(difference *d)
{
    const real level = leveler(d->doubt * (1 / GLANCE_DOUBT));
    body *const both[2] = {&d->a, &d->b};
    for (int i = 0; i < 2; i++) {
        body *k = both[i];
        if (!d->wild || !k->posed) k->grain *= level;
        for (int j = 0; j < DIM * DIM && d->wild && k->posed; j++) k->fitted[j] *= level;
    }
    d->c = mul(d->c, level);
    d->scale *= level;
    d->unscale /= level;
    d->doubt *= level;
}

/* The same in the frame, of the corner in the spare slot. IN_VAIN: nothing has changed. */
static APART enum glanced stride_in_frame(search *q, int max_steps, const shape *a, const shape *b, result *r)
{
    const difference before = q->d;
    vertex *first = &q->s.slot[0];
    *first = *spare(&q->s);
    q->d.doubt = doubt_in_frame(&q->d);
    bring_frame_to_size(&q->d);
    first->w = mul(first->w, q->d.scale * before.unscale);
    enum glanced seen = IN_VAIN;
    if (stands_clear(first)) seen = stride(q, max_steps, a, b, r);
    else first->w = mul(first->w, before.scale * q->d.unscale);
    leave_trail(q);
    q->d = before;
    if (seen == STRODE) take_up_trail(q);
    return seen;
}

#endif

#endif
