/* SPDX-License-Identifier: MIT */
/* A point of each of two listed bodies, side by side, and the corner of the difference that they make: those that the
 * walk's weights single out, or a corner's own. */
#ifndef GJK_CORE_SPOTS_H
#define GJK_CORE_SPOTS_H

#include "listed.h"

typedef struct spots {
    duos x, low; /* in the bodies' own coordinates, times their grain, and what of that rounds away; */
    duos at;     /* from their positions; */
    vec w;       /* the corner */
} spots;

/* The points x themselves; m: the bodies' maps. */
HOT spots spots_at(const difference *d, const duo_map *m, duos x)
{
    spots p = {.x = x, .low = duos_both(axis(0, 0)), .at = duos_mapped(m, x)};
    p.w = corner_at_spots(d, p.at);
    return p;
}

/* Those that the weights single out: of each body the first corner, and the way from there. */
static inline spots nearest_spots(const search *q)
{
    const difference *d = &q->d;
    const vertex *p = corner(&q->s, 0);
    const duos first = duos_mul(duos_at(p->x.c, p->y.c), d->grains);
    duos way = duos_both(axis(0, 0)), x;
    spots r;
    real weight[DIM + 1];
    weigh_walked(q, weight);
    for (int i = 1; i < q->s.n; i++) {
        p = corner(&q->s, i);
        const duos edge = duos_sub(duos_mul(duos_at(p->x.c, p->y.c), d->grains), first);
        way = duos_add(way, duos_mul(edge, duo_both(weight[i])));
    }
    x = duos_add(first, way);
    r = spots_at(d, &d->maps, x);
    EACH(r.low.c[i] = duo_lost(first.c[i], way.c[i], x.c[i]));
    return r;
}

/* Those of the corner in the spare slot. */
static inline spots last_spots(const search *q)
{
    const vertex *p = corner(&q->s, q->s.n);
    return spots_at(&q->d, &q->d.maps, duos_mul(duos_at(p->x.c, p->y.c), q->d.grains));
}

/* ---- without rounding ---- */

/* For the upper digits of numbers up to these. */
HOT duo big_above(real a, real b) { return duo_of(above(a) * ROUNDING_TO(GRID), above(b) * ROUNDING_TO(GRID)); }

/* m (x + low): a part without rounding, and the rest. Cheaper than remainder_of, and not as exact, since no bound
 * depends on it, only the value. */
HOT void place_spots_in_parts(const difference *d, const duo_map *m, const spots *p, duos *upper, duos *rest)
{
    const duo far = duos_peak(p->x), of_point = big_above(of_a(far), of_b(far));
    const duo of_map = big_above(d->a.norm, d->b.norm);
    duos x_up;
    EACH(x_up.c[i] = upper_digits_of(p->x.c[i], of_point));
    const duos x_rest = duos_add(duos_sub(p->x, x_up), p->low);
    for (int row = 0; row < DIM; row++) {
        const duos own = row_of_map(m, row);
        duos up;
        EACH(up.c[i] = upper_digits_of(own.c[i], of_map));
        upper->c[row] = duos_dot(up, x_up);
        rest->c[row] = duo_add(duos_dot(up, x_rest), duos_dot(duos_sub(own, up), p->x));
    }
}

/* What rounding took from their corner. */
HOT vec lost_of_spots(const difference *d, const duo_map *m, const spots *p)
{
    duos upper, rest;
    vec low;
    place_spots_in_parts(d, m, p, &upper, &rest);
    EACH(const twin t = sum_of(of_a(upper.c[i]), -of_b(upper.c[i])); const twin s = sum_of(t.high, -d->c.c[i]);
         low.c[i] = (s.high - p->w.c[i]) + ((s.low + t.low) + (of_a(rest.c[i]) - of_b(rest.c[i]) - d->c_low.c[i])));
    return low;
}

#endif
