/* SPDX-License-Identifier: MIT */
/* Hulls of known corners without rounding: their corners and those of their difference, as dyadic numbers. Where the
 * numbers of a pair are so unlike that what is made of them is lost, those are left out that are of next to no account:
 * what was asked of the bodies is then known of others, which are off them by next to nothing (docs/bounds.md). */
#ifndef GJK_CORE_OUTLINE_H
#define GJK_CORE_OUTLINE_H

#include "dyadic.h"
#include "shapes.h"

/* ---- vectors ---- */

typedef struct dyadics {
    dyadic c[DIM];
} dyadics;

static dyadics difference_of(const dyadics *a, const dyadics *b)
{
    dyadics r;
    for (int i = 0; i < DIM; i++) r.c[i] = plus(&a->c[i], &b->c[i], -1);
    return r;
}

static dyadic inner(const dyadics *a, const dyadics *b)
{
    dyadic r = times(&a->c[0], &b->c[0]);
    for (int i = 1; i < DIM; i++) {
        dyadic t = times(&a->c[i], &b->c[i]);
        r = plus(&r, &t, 1);
    }
    return r;
}

static dyadics no_way(void)
{
    dyadics r;
    for (int i = 0; i < DIM; i++) r.c[i] = nought(0);
    return r;
}

static void reverse(dyadics *a)
{
    for (int i = 0; i < DIM; i++) a->c[i].sign = -a->c[i].sign;
}

/* p q - r s */
static dyadic minor(const dyadic *p, const dyadic *q, const dyadic *r, const dyadic *s)
{
    dyadic t = times(p, q), u = times(r, s);
    return plus(&t, &u, -1);
}

#if DIM == 2
/* a turned by a quarter, which is the normal of an edge. */
static dyadics quarter(const dyadics *a) { return (dyadics){{opposite_of(&a->c[1]), a->c[0]}}; }
#else
static dyadics outer(const dyadics *a, const dyadics *b)
{
    dyadics r;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        r.c[i] = minor(&a->c[j], &b->c[k], &a->c[k], &b->c[j]);
    }
    return r;
}
#endif

/* ---- a body ---- */

/* Numbers of the shape below these are taken for 0. */
typedef struct outline {
    const shape *s;
    real point, map, place; /* the coordinates of corners, the pose's m and its p */
} outline;

static outline outline_of(const shape *s) { return (outline){s, 0, 0, 0}; }

/* What moves a corner by no more than that share of the frame is left out, where anything is: numbers of a frame of
 * that many places, their products and those of four such sums are never lost. */
#define FAINT ((real)(REAL_IS_DOUBLE ? 0x1p-400 : 0))

/* Below this a number is faint in a frame of that size where it is multiplied by so much. Overflows only where every
 * number is; products that underflow are those of frames so small that the quotient does not overflow. */
static real faint_times(real frame, real by)
{
    const real least = FAINT * frame;
    return least >= REAL_MIN ? least / by : FAINT * (frame / by);
}

/* Leaves out what is faint in a frame of that size. Returns how far the body is off what it was, at most. */
static real leave_out_faint(outline *o, real frame)
{
    real far = TINY, norm = o->s->pose ? TINY : 1;
    for (size_t i = 0; i < count_corners(o->s); i++) far = larger(peak(nth_corner(o->s, i)), far);
    for (int i = 0; i < DIM * DIM && o->s->pose; i++) norm = larger(size(o->s->pose->m[i]), norm);
    o->point = faint_times(frame, norm);
    o->map = faint_times(frame, far);
    o->place = FAINT * frame;
    return FAINT > 0 ? 32 * (o->place + TINY) : 0;
}

static inline vec point_in(const outline *o, vec x)
{
    EACH(x.c[i] = unless_below(x.c[i], o->point));
    return x;
}

static inline real entry_in(const outline *o, int i, int j) { return unless_below(o->s->pose->m[DIM * i + j], o->map); }
static inline real position_in(const outline *o, int i) { return unless_below(o->s->pose->p[i], o->place); }

static dyadics placed(const outline *o, vec x)
{
    dyadics r;
    x = point_in(o, x);
    for (int i = 0; i < DIM; i++) {
        r.c[i] = dyadic_of(o->s->pose ? position_in(o, i) : x.c[i]);
        for (int j = 0; j < DIM && o->s->pose; j++) {
            const real entry = entry_in(o, i, j);
            if (entry == 0) continue;
            dyadic m = dyadic_of(entry), t = dyadic_of(x.c[j]);
            t = times(&m, &t);
            r.c[i] = plus(&r.c[i], &t, 1);
        }
    }
    return r;
}

/* The way as the set sees it. */
static dyadics pulled(const outline *o, const dyadics *way)
{
    dyadics r = *way;
    for (int j = 0; j < DIM && o->s->pose; j++) {
        r.c[j] = nought(0);
        for (int i = 0; i < DIM; i++) {
            const real entry = entry_in(o, i, j);
            if (entry == 0) continue;
            dyadic t = dyadic_of(entry);
            t = times(&t, &way->c[i]);
            r.c[j] = plus(&r.c[j], &t, 1);
        }
    }
    return r;
}

/* Rounded, and brought to size 1/16 .. 1/8. */
static vec rough(const dyadics *d)
{
    vec r = axis(0, 0);
    int e[DIM], top = 0, found = 0;
    for (int i = 0; i < DIM; i++) {
        r.c[i] = leading(&d->c[i], &e[i]).high * (real)d->c[i].sign;
        if (d->c[i].sign == 0 || (found && e[i] <= top)) continue;
        top = e[i];
        found = 1;
    }
    for (int i = 0; i < DIM; i++) r.c[i] = raised(r.c[i], e[i] - top - 3);
    return r;
}

/* ---- a corner of the difference ---- */

/* Adds sign times coordinate i of the corner x, placed, to terms without rounding. Returns how many there are then; 0
 * where products are too large or too small for that. */
static int add_terms(const outline *o, vec x, int i, real sign, real *terms, int n)
{
    x = point_in(o, x);
    if (!o->s->pose) {
        terms[n++] = sign * x.c[i];
        return n;
    }
    terms[n++] = sign * position_in(o, i);
    for (int j = 0; j < DIM; j++) {
        const real m = sign * entry_in(o, i, j);
        if (m == 0 || x.c[j] == 0) continue;
        twin p = product_of(m, x.c[j]);
        if (unruly(size(m)) || unruly(size(x.c[j])) || unruly(size(p.high))) return 0;
        terms[n++] = p.high;
        terms[n++] = p.low;
    }
    return n;
}

/* The corner of the difference, term by term; or, of numbers that are not plain, by what always works. */
static dyadics corner_without_rounding(const outline *a, const outline *b, vec x, vec y)
{
    dyadics r;
    for (int i = 0; i < DIM; i++) {
        real terms[MOST_TERMS];
        int n = add_terms(a, x, i, 1, terms, 0);
        if (n > 0) n = add_terms(b, y, i, -1, terms, n);
        if (n == 0) {
            dyadics p = placed(a, x), q = placed(b, y);
            return difference_of(&p, &q);
        }
        r.c[i] = total_of(terms, n);
    }
    return r;
}

#endif
