/* SPDX-License-Identifier: MIT */
/* Whether a simplex of known corners holds the origin, in twins that know how far they may be off. Where coordinates
 * are such that nothing is rounded off, as those of bodies in a row or on a grid, that is 0, and so contact is proven
 * without whole numbers; else signs are told unless they are lost in the error. Nothing is told that is not certain.
 */
#ifndef GJK_CORE_TOUCH_H
#define GJK_CORE_TOUCH_H

#include "distance.h"

/* A number known to be no farther than off from high + low, but for the roundings of off, which whoever asks for a sign
 * has room for. With off 0 it is that sum. */
typedef struct span {
    real high, low; /* high is the sum rounded */
    real off;
} span;

static inline span span_plus(span a, span b, real sign)
{
    twin s = sum_of(a.high, sign * b.high), t = sum_of(a.low, sign * b.low), l = sum_of(s.low, t.high);
    s = sum_of(s.high, l.high);
    return (span){s.high, s.low, a.off + b.off + size(t.low + l.low)};
}

static inline span span_minus(span a) { return (span){-a.high, -a.low, a.off}; }

/* Products that are not as small keep all their digits: their lowest is above TINY. */
#define SAFE (REAL_MIN / (UNIT * UNIT))

/* Left out is low * low, and lost the roundings of the sums with the lows: 8 UNIT^2 of the product. */
static inline span span_times(span a, span b)
{
    if ((a.high == 0 && a.off == 0) || (b.high == 0 && b.off == 0)) return (span){0, 0, 0};
    twin p = product_of(a.high, b.high);
    if (a.low == 0 && b.low == 0 && a.off == 0 && b.off == 0 && size(p.high) > SAFE) return (span){p.high, p.low, 0};
    twin r = sum_of(p.high, p.low + (a.high * b.low + a.low * b.high));
    real off = size(a.high) * b.off + size(b.high) * a.off + a.off * b.off;
    return (span){r.high, r.low, off + 9 * UNIT * UNIT * size(p.high) + 16 * TINY};
}

/* p q - r s */
static inline span span_minor(span p, span q, span r, span s)
{
    return span_plus(span_times(p, q), span_times(r, s), -1);
}

enum { BLURRED = 2 };

/* Its sign, if that is certain. */
static inline int span_sign(span a)
{
    if (!(size(a.high) > 2 * a.off)) return a.off == 0 && a.high == 0 ? 0 : BLURRED;
    return a.high < 0 ? -1 : 1;
}

typedef struct spans {
    span c[DIM];
} spans;

/* sum + x, of which nothing is known to be off; high need not be the sum rounded then. */
static inline void span_gather(span *sum, twin x)
{
    twin s = sum_of(sum->high, x.high), t = sum_of(sum->low, s.low), l = sum_of(t.high, x.low);
    *sum = (span){s.high, l.high, sum->off + size(t.low + l.low)};
}

/* Adds sign times the body's point x, which is times its grain. */
static inline void add_point(spans *sum, const body *k, real sign, vec x)
{
    halves h[DIM];
    for (int j = 0; j < DIM; j++) h[j] = halves_of(x.c[j]);
    for (int i = 0; i < DIM; i++) {
        if (!k->posed) span_gather(&sum->c[i], (twin){sign * x.c[i], 0});
        for (int j = 0; j < DIM && k->posed; j++) {
            real m = sign * k->m[DIM * i + j];
            if (m == 0 || x.c[j] == 0) continue;
            twin p = product_of_halves(m, halves_of(m), x.c[j], h[j]);
            span_gather(&sum->c[i], p);
            if (!(size(p.high) > SAFE)) sum->c[i].off += 16 * TINY;
        }
    }
}

/* y is x times a power of two, and no digit of it was lost to underflow. */
static inline int is_whole(real x, real y) { return x == 0 ? y == 0 : size(y) >= REAL_MIN; }

/* What the map does to the point came to the frame without rounding, as far as it does anything. */
static int is_map_whole(const body *k, const shape *s, vec x)
{
    int r = 1;
    for (int i = 0; i < DIM * DIM && k->posed; i++) r &= x.c[i % DIM] == 0 || is_whole(s->pose->m[i], k->m[i]);
    return r;
}

/* So did the way between the positions. */
static int is_way_whole(const difference *d, const shape *a, const shape *b)
{
    int r = 1;
    for (int i = 0; i < DIM; i++) {
        twin c = sum_of(b->pose ? b->pose->p[i] : 0, a->pose ? -a->pose->p[i] : 0);
        r &= is_whole(c.high, d->c.c[i]) && is_whole(c.low, d->c_low.c[i]);
    }
    return r;
}

/* What corner_of rounds. 0: that can't be told. */
static int corner_in_spans(const difference *d, const vertex *p, spans *w)
{
    vec x = mul(p->x, d->a.grain), y = mul(p->y, d->b.grain);
    int r = 1;
    EACH(r &= is_whole(p->x.c[i], x.c[i]) && is_whole(p->y.c[i], y.c[i]));
    for (int i = 0; i < DIM; i++) w->c[i] = (span){-d->c.c[i], -d->c_low.c[i], 0};
    add_point(w, &d->a, 1, x);
    add_point(w, &d->b, -1, y);
    for (int i = 0; i < DIM; i++) {
        twin t = sum_of(w->c[i].high, w->c[i].low);
        w->c[i].high = t.high;
        w->c[i].low = t.low;
    }
    return r;
}

/* ---- weights with which the corners add up to the origin, in proportion, of any sign; 0: that there are such is not
 * certain ---- */

#if DIM == 2
static span span_cross(const spans *a, const spans *b) { return span_minor(a->c[0], b->c[1], a->c[1], b->c[0]); }

/* Two corners in line with the origin. Of a vector's components the largest tells most. */
static int weigh_pair(const simplex *s, const spans w[3], span weight[3])
{
    vec e = sub(point(s, 1), point(s, 0));
    int k = size(e.c[0]) > size(e.c[1]) ? 0 : 1;
    weight[0] = w[1].c[k];
    weight[1] = span_minus(w[0].c[k]);
    return span_sign(span_cross(&w[0], &w[1])) == 0;
}

static int weigh_whole(const spans w[3], span weight[3])
{
    for (int i = 0; i < 3; i++) weight[i] = span_cross(&w[(i + 1) % 3], &w[(i + 2) % 3]);
    return 1;
}
#else
/* Component k of the product across. */
static span span_cross(const spans *a, const spans *b, int k)
{
    int i = (k + 1) % 3, j = (k + 2) % 3;
    return span_minor(a->c[i], b->c[j], a->c[j], b->c[i]);
}

static spans span_outer(const spans *a, const spans *b)
{
    return (spans){{span_cross(a, b, 0), span_cross(a, b, 1), span_cross(a, b, 2)}};
}

static span span_inner(const spans *a, const spans *b)
{
    span r = span_times(a->c[0], b->c[0]);
    for (int i = 1; i < 3; i++) r = span_plus(r, span_times(a->c[i], b->c[i]), 1);
    return r;
}

/* Of a vector's components the largest. */
static int peak_at(vec v)
{
    int k = size(v.c[1]) > size(v.c[0]) ? 1 : 0;
    return size(v.c[2]) > size(v.c[k]) ? 2 : k;
}

/* Two corners in line with the origin. */
static int weigh_pair(const simplex *s, const spans w[4], span weight[4])
{
    spans n = span_outer(&w[0], &w[1]);
    int k = peak_at(sub(point(s, 1), point(s, 0)));
    weight[0] = w[1].c[k];
    weight[1] = span_minus(w[0].c[k]);
    return span_sign(n.c[0]) == 0 && span_sign(n.c[1]) == 0 && span_sign(n.c[2]) == 0;
}

/* Three in a plane with it, seen along an axis. */
static int weigh_face(const simplex *s, const spans w[4], span weight[4])
{
    spans n = span_outer(&w[0], &w[1]);
    if (span_sign(span_inner(&n, &w[2])) != 0) return 0;
    int k = peak_at(cross(edge_to(s, 1), edge_to(s, 2)));
    weight[0] = span_cross(&w[1], &w[2], k);
    weight[1] = span_cross(&w[2], &w[0], k);
    weight[2] = n.c[k];
    return 1;
}

static int weigh_whole(const spans w[4], span weight[4])
{
    spans m = span_outer(&w[0], &w[1]), n = span_outer(&w[2], &w[3]);
    weight[0] = span_inner(&n, &w[1]);
    weight[1] = span_minus(span_inner(&n, &w[0]));
    weight[2] = span_inner(&m, &w[3]);
    weight[3] = span_minus(span_inner(&m, &w[2]));
    return 1;
}
#endif

static int weigh_spans(const simplex *s, const spans w[DIM + 1], span weight[DIM + 1])
{
    if (s->n == 2) return weigh_pair(s, w, weight);
#if DIM == 3
    if (s->n == 3) return weigh_face(s, w, weight);
#endif
    if (s->n > DIM) return weigh_whole(w, weight);
    int r = 1;
    for (int i = 0; i < DIM; i++) r &= span_sign(w[0].c[i]) == 0;
    weight[0] = (span){1, 0, 0};
    return r;
}

/* The weights are of one sign for certain, and good to all the digits that a point needs. Which of them are not 0. */
static unsigned same_side(const span r[DIM + 1], int n)
{
    real sum = 0;
    int turn = 0;
    unsigned mask = 0;
    for (int i = 0; i < n; i++) sum += size(r[i].high);
    for (int i = 0; i < n; i++) {
        int sign = span_sign(r[i]);
        if (sign == BLURRED || sign * turn < 0 || !(r[i].off <= UNIT / 4 * sum)) return 0;
        turn = sign == 0 ? turn : sign;
        mask |= sign == 0 ? 0 : 1u << i;
    }
    return mask;
}

/* Whether the origin is certain to be in the simplex of the corners w. Then that keeps the corners that carry it, with
 * their weights. */
static int is_carried(simplex *s, const spans w[DIM + 1], real weight[DIM + 1])
{
    span r[DIM + 1];
    unsigned mask = weigh_spans(s, w, r) ? same_side(r, s->n) : 0;
    if (mask == 0) return 0;
    for (int i = 0, n = 0; i < s->n; i++)
        if (mask >> i & 1) weight[n++] = size(r[i].high);
    keep(s, mask);
    normalize(weight, s->n);
    return 1;
}

/* None of its coordinates is known without error: it lies in no plane with others for certain. */
static int is_blurred(const spans *w)
{
    int r = 1;
    for (int i = 0; i < DIM; i++) r &= w->c[i].off != 0;
    return r;
}

/* ---- the same in plain numbers, of corners with so few digits that nothing is rounded ---- */

/* Of binary places, in a frame of that size: a map's and a point's, so that their products' sums are exact; and a
 * corner's, so that determinants are. */
#define SHORT ((MANTISSA - 1) / 2)
#define SHORTER ((MANTISSA - 4) / DIM)

/* x is a whole multiple of 2^-places times that power of two. */
static inline int is_short(real x, int places, real power)
{
    real big = ROUNDING_TO(places) * power;
    return (x + big) - big == x;
}

/* By how much numbers are off such multiples, in all; big is as above. */
HOT duo odds_of_both(duo odds, duo x, duo big) { return duo_add(odds, duo_size(duo_sub(upper_digits_of(x, big), x))); }

/* The bodies' maps are short, for their sizes; to which they came without rounding where sizes are plain. So are the
 * simplex's points of them, before such maps, where all sums are within twice that power, and they came there whole.
 * The corners of a box differ in signs. */
static int are_parts_short(const difference *d, const simplex *s, real power)
{
    const duo none = duo_both(0), levels = duo_of(level_of_map(&d->a), level_of_map(&d->b));
    const duo grains = duo_of(d->a.grain, d->b.grain), big = duo_both(ROUNDING_TO(SHORT));
    const duo of_map = duo_mul(big, duo_div(duo_both(2), levels));
    const duo of_point = duo_mul(big, duo_mul(levels, duo_both(power / 2)));
    const real *m_a = map_of(&d->a), *m_b = map_of(&d->b);
    const int n = d->a.asked == AS_BOX && d->b.asked == AS_BOX ? 1 : s->n;
    duo odds = none;
    for (int i = 0; i < DIM * DIM; i++) odds = odds_of_both(odds, duo_at(m_a + i, m_b + i), of_map);
    for (int j = 0; j < n; j++) {
        const vertex *p = corner(s, j);
        const duos x = duos_at(p->x.c, p->y.c), y = duos_mul(x, grains);
        EACH(odds = odds_of_both(odds, y.c[i], of_point);
             odds = duo_add(odds, duo_where_larger(duo_size(y.c[i]), none, none, duo_size(x.c[i]))));
    }
    return of_a(odds) == 0 && of_b(odds) == 0;
}

static inline int are_corners_short(const simplex *s)
{
    int r = 1;
    for (int j = 0; j < s->n; j++) {
        vec w = point(s, j);
        EACH(r &= is_short(w.c[i], SHORTER, 1));
    }
    return r;
}

/* So is the way between the positions, which came to the frame whole, with nothing rounded off. */
static inline int is_way_short(const difference *d, const shape *a, const shape *b, real power)
{
    const vec c = offset(a->pose, b->pose), low = offset_low(a->pose, b->pose);
    int r = 1;
    EACH(r &= is_short(d->c.c[i], 2 * SHORT, power) & is_whole(c.c[i], d->c.c[i]) & (low.c[i] == 0));
    return r;
}

/* As weigh_spans. */
static int weigh_plainly(const simplex *s, real weight[DIM + 1])
{
    vec p = point(s, 0), q = point(s, s->n > 1 ? 1 : 0), r = point(s, s->n > 2 ? 2 : 0);
    weight[0] = 1;
    if (s->n == 1) return !(peak(p) > 0);
#if DIM == 2
    if (s->n == 2) {
        int k = size(q.c[0] - p.c[0]) > size(q.c[1] - p.c[1]) ? 0 : 1;
        weight[0] = q.c[k];
        weight[1] = -p.c[k];
        return cross(p, q) == 0;
    }
    weight[0] = cross(q, r);
    weight[1] = cross(r, p);
    weight[2] = cross(p, q);
    return 1;
#else
    vec n = cross(p, q);
    if (s->n == 2) {
        int k = peak_at(sub(q, p));
        weight[0] = q.c[k];
        weight[1] = -p.c[k];
        return !(peak(n) > 0);
    }
    if (s->n == 3) {
        int k = peak_at(cross(sub(q, p), sub(r, p)));
        weight[0] = cross(q, r).c[k];
        weight[1] = cross(r, p).c[k];
        weight[2] = n.c[k];
        return dot(n, r) == 0;
    }
    vec t = point(s, 3), m = cross(r, t);
    weight[0] = dot(m, q);
    weight[1] = -dot(m, p);
    weight[2] = dot(n, t);
    weight[3] = -dot(n, r);
    return 1;
#endif
}

/* corner_of places the simplex's corners without rounding, for certain; all its sums are within twice that power of
 * two, in the frame within 2. */
static int are_corners_whole(const difference *d, const simplex *s, const shape *a, const shape *b, real power)
{
    if (!is_way_short(d, a, b, power) || !are_parts_short(d, s, power)) return 0;
    for (int i = 0; i < s->n && d->wild; i++)
        if (!is_map_whole(&d->a, a, corner(s, i)->x) || !is_map_whole(&d->b, b, corner(s, i)->y)) return 0;
    return 1;
}

/* Whether the simplex, of corners as corner_of places them, holds the origin, if that can be told in plain numbers.
 * Then it keeps the corners that carry it, with their weights. */
static int holds_origin_plainly(const difference *d, simplex *s, const shape *a, const shape *b, real weight[DIM + 1])
{
    real share[DIM + 1];
    int low = 0, high = 0;
    unsigned mask = 0;
    if (!are_corners_short(s) || !weigh_plainly(s, share) || !are_corners_whole(d, s, a, b, 1)) return 0;
    for (int i = 0; i < s->n; i++) {
        low |= share[i] < 0;
        high |= share[i] > 0;
        mask |= share[i] != 0 ? 1u << i : 0;
    }
    if (low == high) return 0;
    for (int i = 0, n = 0; i < s->n; i++)
        if (mask >> i & 1) weight[n++] = size(share[i]);
    keep(s, mask);
    normalize(weight, s->n);
    return 1;
}

/* Whether the simplex holds the origin, told in plain numbers or else in spans. */
static int holds_origin(search *q, const shape *a, const shape *b, real weight[DIM + 1])
{
    spans w[DIM + 1];
    simplex *s = &q->s;
    if (s->n <= DIM && q->vv > q->d.doubt * q->d.doubt) return 0;
    simplex fresh = *s;
    for (int i = 0; i < s->n; i++) {
        vertex *p = &fresh.slot[s->at[i]];
        p->w = corner_of(&q->d, p->x, p->y);
    }
    if (holds_origin_plainly(&q->d, &fresh, a, b, weight)) {
        *s = fresh;
        return 1;
    }
    if (!is_way_whole(&q->d, a, b)) return 0;
    for (int i = 0; i < s->n && q->d.wild; i++)
        if (!is_map_whole(&q->d.a, a, corner(s, i)->x) || !is_map_whole(&q->d.b, b, corner(s, i)->y)) return 0;
    for (int i = 0; i < s->n; i++)
        if (!corner_in_spans(&q->d, corner(s, i), &w[i]) || (s->n <= DIM && is_blurred(&w[i]))) return 0;
    return is_carried(s, w, weight);
}

#endif
