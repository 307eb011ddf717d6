/* SPDX-License-Identifier: MIT */
/* Sets whose corners can be listed: how a query of two such is opened, and what they are asked in the search. It is
 * that of distance.h, but for what is not needed: nothing is asked of a set to open the query, of plain sizes no
 * direction is brought to size, and what a cache lends is looked up, not taken on trust. */
#ifndef GJK_CORE_LISTED_H
#define GJK_CORE_LISTED_H

#include "answer.h"

/* 0: it is no box. */
HOT int take_box(body *k, const box *b)
{
    if (!b) return 0;
    EACH(if (!(b->half[i] >= 0)) return 0);
    k->asked = AS_BOX;
    return 1;
}

HOT void take_pose(body *k, const shape *s)
{
    k->data = s->data;
    k->posed = s->pose != NULL;
    if (k->posed) k->m = s->pose->m;
}

/* The body's corners, without a call; of a cloud with their reach. 0: it has none that can be listed, or not that
 * reach, or the data describe no set. */
static inline int list_corners(body *k, const shape *s)
{
    static const real nothing[DIM] = {0};
    take_pose(k, s);
    k->asked = AS_LIST;
    if (s->support == pub(support_points)) {
        const points *p = s->data;
        if (!p || !cloud(p) || !(p->reach > TINY)) return 0;
        k->list = list_of_cloud(p);
    } else if (s->support == pub(support_box)) {
        return take_box(k, s->data);
    } else if (s->support == pub(support_segment)) {
        const segment *e = s->data;
        if (!e) return 0;
        k->list = (list){e->v[0], 2, DIM, 0, NULL};
#if DIM == 3
    } else if (s->support == pub(support_triangle)) {
        const triangle *t = s->data;
        if (!t) return 0;
        k->list = (list){t->v[0], 3, DIM, 0, NULL};
#endif
    } else {
        k->list = (list){nothing, 1, DIM, padded(0), NULL};
        if (s->support != pub(support_origin)) return 0;
    }
    return 1;
}

/* And how far they reach. */
static inline void know_reach_listed(body *k)
{
    if (k->asked == AS_BOX) {
        know_reach(k, at_most(load(((const box *)k->data)->half)));
        return;
    }
    if (k->list.reach == 0) k->list.reach = reach_of(k->list.v, k->list.count);
    know_reach(k, k->list.reach);
}

/* Its map stretches by so much. 0: it is not of plain sizes. A number that is none may pass; then no corner has one,
 * and nothing is told. */
HOT int seize_plain(body *k, const shape *s, real grows)
{
    k->support = s->support;
    k->stretch = grows;
    know_reach_listed(k);
    k->size = k->reach > TINY ? k->reach : 0;
    return !unruly(k->stretch) && (k->size == 0 || !unruly(k->size)) && s->radius >= 0 && s->radius < PLAIN;
}

HOT void fit_plain(body *k, real scale)
{
    k->grain = scale;
    k->norm = k->stretch;
}

/* The frame, as start and settle have it. 0: not all sizes are plain. */
static int settle_plain(difference *d, const shape *a, const shape *b)
{
    lay_maps(d);
    const duo stretches = duo_stretch(&d->maps);
    if (!seize_plain(&d->a, a, of_a(stretches)) || !seize_plain(&d->b, b, of_b(stretches))) return 0;
    d->c = offset(a->pose, b->pose);
    real far_a = d->a.stretch * d->a.size, far_b = d->b.stretch * d->b.size, apart = spread(d->c);
    real whole = far_a + far_b + apart;
    if (unruly(whole)) return 0;
    d->scale = leveler(whole);
    d->unscale = 1 / d->scale;
    if (unruly(d->a.stretch * d->scale) || unruly(d->b.stretch * d->scale)) return 0;
    fit_plain(&d->a, d->scale);
    fit_plain(&d->b, d->scale);
    lay_grains(d);
    d->c = mul(d->c, d->scale);
    d->doubt = doubt_of(d, far_a * d->scale, far_b * d->scale, apart * d->scale);
    d->slack = 0;
    d->wild = d->loose = 0;
    return 1;
}

/* What is not needed to walk: what rounding took from the offset. */
static void know_offset(difference *d, const shape *a, const shape *b)
{
    if (!d->wild) d->c_low = mul(offset_low(a->pose, b->pose), d->scale);
}

/* A body whose corners are listed is asked in the caller's unit. */
static void settle_body(body *k)
{
    k->in = NULL;
    k->unit = 1;
    k->ease = larger(leveler(k->stretch), EASE);
}

/* And what else the search needs. */
static void settle_rest(difference *d, const shape *a, const shape *b)
{
    if (d->wild) return;
    know_offset(d, a, b);
    d->lost = 0;
    settle_body(&d->a);
    settle_body(&d->b);
}

/* The frame of any sizes, now that the reaches are known. 0: the shapes are none, or beyond all numbers. */
static APART int settle_listed(difference *d, const shape *a, const shape *b)
{
    know_reach_listed(&d->a);
    know_reach_listed(&d->b);
    real reach_a = d->a.reach, reach_b = d->b.reach;
    if (!(reach_a <= REAL_MAX && reach_b <= REAL_MAX) || !sound(a) || !sound(b) || !start(d, a, b)) return 0;
    know_reach(&d->a, reach_a);
    know_reach(&d->b, reach_b);
    return settle(d, 0);
}

/* ---- asking ---- */

/* A direction that is none is the first axis, as levelled has it. */
HOT vec seen_or_first(vec dir) { return dir.c[0] == 0 && !(peak(dir) > 0) ? axis(0, 1) : dir; }

/* The frame's direction as a body of plain sizes sees it. */
HOT vec plain_direction(const body *k, vec dir) { return seen_or_first(k->posed ? pull(k->m, dir) : dir); }

/* The body's corner farthest along a direction as it sees it, of corners that are known to be numbers or are found to
 * be, and within their reach. */
HOT int farthest_seen(const body *k, vec dir, enum care care, vec *x)
{
    if (k->asked == AS_BOX) {
        *x = corner_of_box(k->data, dir);
        return 1;
    }
    const list *l = &k->list;
    if (l->count == 1) {
        *x = load(l->v);
        return fits(k, *x);
    }
    size_t best = farthest_among(l, dir, care);
    if (best == l->count) return 0;
    *x = nth_of(l, best);
    return fits(k, *x);
}

/* The corner least along v. */
HOT int ask_plainly(difference *d, vec v, enum care care, vertex *p)
{
    const duos dirs = duos_pulled(&d->maps, duos_of(mul(v, -1), v));
    d->calls += 2;
    if (!farthest_seen(&d->a, seen_or_first(vec_of_a(dirs)), care, &p->x)) return 0;
    if (!farthest_seen(&d->b, seen_or_first(vec_of_b(dirs)), care, &p->y)) return 0;
    p->w = corner_at_spots(d, duos_mapped(&d->maps, duos_mul(duos_at(p->x.c, p->y.c), d->grains)));
    return 1;
}

/* The same for the first time, and of any sizes: the supports say whether their data are good. */
static int ask_anew(difference *d, vec v, int hasty, vertex *p)
{
    real reach[2];
    if (!d->wild) return ask_plainly(d, v, hasty ? FIRST_SIGHT : WARY, p);
    if (!ask_first(d, v, p, reach)) return 0;
    d->calls -= hasty ? 2 : 0; /* those of before were for the data */
    if (hasty) return ask_with(d, v, FIRST_SIGHT, p);
    p->w = corner_of(d, p->x, p->y);
    return 1;
}

/* The same, not for the first time. */
static inline int ask_on(difference *d, vec v, vertex *p)
{
    return d->wild ? ask(d, v, p) : ask_plainly(d, v, CAREFUL, p);
}

/* The same in haste, if that will do. */
static inline int ask_for(difference *d, vec v, int hasty, vertex *p)
{
    if (!hasty) return ask_on(d, v, p);
    return d->wild ? ask_with(d, v, HASTY, p) : ask_plainly(d, v, HASTY, p);
}

/* A point or a segment, which has no inside. */
static inline int is_thin(const body *k) { return k->asked != AS_BOX && k->list.count < 3; }

/* Of a long list some corners do for first steps; of a shorter one, or one with an index, all take hardly longer. */
#define LONG 512
static inline int is_long(const body *k) { return k->asked == AS_LIST && k->list.count >= LONG && !k->list.index; }

/* One corner in so many, a power of 4: so few, or up to four times as many. 1: all, of a list as short as that or with
 * an index. */
static size_t share_of(const body *k, size_t few)
{
    size_t n = 1;
    while (k->asked == AS_LIST && !k->list.index && k->list.count / n >= 4 * few) n *= 4;
    return n;
}

/* One corner in n of a list is left, or more where these would be too few. */
static void thin_out(body *k, size_t n, size_t few)
{
    const size_t share = share_of(k, few);
    if (n > share) n = share;
    if (n == 1) return; /* a box has no list */
    k->list.count = (k->list.count + n - 1) / n;
    k->list.step *= n;
}

/* x is a corner of the set. */
static inline int is_corner(const body *k, const real x[DIM])
{
    const list *l = &k->list;
    const vec v = load(x);
    if (k->asked == AS_BOX) return same(corner_of_box(k->data, v), v);
    if (l->index) return is_in_order(l, v);
    for (size_t i = 0; i < l->count; i++)
        if (same(nth_of(l, i), v)) return 1;
    return 0;
}

/* All of these points are. */
static inline int are_corners(const body *k, const real x[][DIM], uint32_t n)
{
    if (k->asked != AS_BOX && k->list.count >= EIGHT && !k->list.index) return are_in_eights(&k->list, x, n);
    for (uint32_t i = 0; i < n; i++)
        if (!is_corner(k, x[i])) return 0;
    return 1;
}

/* All that the cache lends is of these sets. */
static inline int are_lent_well(const difference *d, const cache *k)
{
    return are_corners(&d->a, k->a, k->count) && are_corners(&d->b, k->b, k->count);
}

/* From these points, which are corners. 0: v has no direction, or nothing comes of it. */
static int open_at(search *q, const cache *k)
{
    vertex p;
    if (!borrow(q, k)) return 0;
    q->lender = NULL;
    int full = q->s.n > DIM;
    if (!full && vanished(q)) return 0;
    vec v = full ? away(q) : q->v;
    if (!ask_anew(&q->d, v, 0, &p)) return 0;
    if (!full) {
        *spare(&q->s) = p;
        return 1;
    }
    q->steps++;
    raise(q, v, p.w);
    q->inside = room_inside(q);
    return q->inside > q->d.doubt;
}

/* From the points of the last query, if they are corners still: nothing is taken on trust. 0: they are not, or as
 * above.
 */
static int reopen_listed(search *q, const cache *k)
{
    const int steps = q->steps;
    blank(q);
    q->steps = steps;
    if (are_lent_well(&q->d, k) && open_at(q, k)) return 1;
    blank(q);
    q->steps = steps;
    return 0;
}

#if DIM == 2
/* From where polygons looked at by themselves were left. 0: nothing comes of it. */
static APART int open_found(search *q)
{
    const search before = *q;
    int opened = 0;
    cache at = q->found.at;
    for (; at.count > 1 && !opened; at.count--) {
        blank(q);
        opened = open_at(q, &at);
    }
    if (!opened) {
        *q = before;
        return 0;
    }
    q->steps += q->found.steps;
    q->d.calls += q->found.calls - before.d.calls;
    q->borrowed = 0;
    return 1;
}
#endif

/* The frame of two bodies listed. 0: there is something wrong. */
static inline int settle_both(search *q, const shape *a, const shape *b)
{
    blank(q);
    return settle_plain(&q->d, a, b) || settle_listed(&q->d, a, b);
}

/* The first corner, along the line of centres. */
static int ask_centres(search *q)
{
    q->v = first_direction(&q->d);
    q->pending = ask_anew(&q->d, q->v, 0, spare(&q->s));
    return q->pending;
}

#if DIM == 3
/* From where strides have led. */
static int take_up_trail(search *q)
{
    const trail *t = &q->trail;
    const real by = q->d.scale * t->unscale;
    memcpy(q->s.at, t->at, sizeof t->at);
    q->s.n = t->n;
    for (int i = 0; i < t->n + t->pending; i++) q->s.slot[t->at[i]].w = mul(corner(&q->s, i)->w, by);
    q->v = mul(q->v, by);
    q->vv = t->vv * (by * by);
    if (t->n > DIM) q->inside *= by;
    q->weighed = 1;
    q->lower = larger(t->lower * by, -4);
    q->normal = t->normal;
    q->pending = t->pending;
    q->steps = t->steps;
    q->d.calls = t->calls;
    return 1;
}
#endif

/* And where the walk starts: from the points of the last query, which the cache lends, or from a corner that has been
 * asked for, or from nothing. 0: there is something wrong. */
static int open_listed(search *q, const cache *k)
{
#if DIM == 2
    if (q->found.at.count > 0 && open_found(q)) return 1;
#endif
#if DIM == 3
    if (q->glanced == STRODE && !q->d.wild) return take_up_trail(q);
#endif
    if (k && reopen_listed(q, k)) return 1;
    if (q->pending) return 1;
    vertex *p = spare(&q->s);
    if (q->glanced != AIMED || q->d.wild) q->v = first_direction(&q->d);
    if (q->glanced < IN_VAIN || q->d.wild) return q->pending = ask_anew(&q->d, q->v, q->glanced != UNTRIED, p);
    q->steps = q->glanced == AIMED;
    q->d.calls = 2 + 2 * q->steps;
    p->w = mul(p->w, q->d.scale);
    return q->pending = 1;
}

#endif
