/* SPDX-License-Identifier: MIT */
/* Heights of A - B along a direction, of known corners, to twice the digits: of both bodies side by side. And a facet's
 * normal, without what its corners' sums round. */
#ifndef GJK_CORE_HEIGHTS_H
#define GJK_CORE_HEIGHTS_H

#include "listed.h"
#include "polytope.h"

/* What heights along a direction are made of. */
typedef struct outlook {
    vec n;             /* unit to rounding; 0: none yet */
    duos high, low;    /* n as A sees it, and -n as B does, to twice the digits, */
    duo_halves h[DIM]; /* and the halves of high */
    twin apart;        /* the height of -c along n */
    real excess;       /* of |n| above 1 */
    int known;         /* of so many points of each body it is known how high they stand: */
    vec x[DIM], y[DIM];
    duo_twin stand[DIM]; /* as heights_of has it */
} outlook;

/* Looks along a unit n: what its heights are made of. */
static void look_along(outlook *s, const difference *d, vec n)
{
    const duos both = duos_of(n, mul(n, -1));
    duo_halves h[DIM];
    duo_twin own = {duo_of(-1, 0), duo_both(0)}; /* |n|^2 - 1, and the height of -c */
    if (same(n, s->n)) return;
    for (int i = 0; i < DIM; i++) {
        const duo with = duo_of(n.c[i], d->c.c[i]);
        h[i] = duo_halves_of(both.c[i]);
        duo_gather(&own, duo_product_of_halves(both.c[i], h[i], with, duo_halves_of(with)));
    }
    for (int j = 0; j < DIM; j++) {
        duo_twin t = duo_product_of_halves(d->maps.c[j], duo_halves_of(d->maps.c[j]), both.c[0], h[0]);
        for (int i = 1; i < DIM; i++) {
            const duo m = d->maps.c[DIM * i + j];
            duo_gather(&t, duo_product_of_halves(m, duo_halves_of(m), both.c[i], h[i]));
        }
        s->high.c[j] = t.high;
        s->low.c[j] = t.low;
        s->h[j] = duo_halves_of(t.high);
    }
    s->n = n;
    s->known = 0;
    s->apart = (twin){of_b(own.high), of_b(own.low) - dot(n, d->c_low)};
    s->excess = (of_a(own.high) + of_a(own.low)) / 2;
}

/* How high a point of each stands, times their grain, from the bodies' own origins. */
HOT duo_twin heights_of(const outlook *s, duos x)
{
    duo_twin h = {duo_both(0), duo_both(0)};
    for (int j = 0; j < DIM; j++) {
        duo_twin p = duo_product_of_halves(s->high.c[j], s->h[j], x.c[j], duo_halves_of(x.c[j]));
        p.low = duo_add(p.low, duo_mul(s->low.c[j], x.c[j]));
        if (j == 0) h = p;
        else duo_gather(&h, p);
    }
    return duo_sum_of(h.high, h.low);
}

/* How high x and y stand. */
HOT duo_twin both_heights(const outlook *s, const difference *d, vec x, vec y)
{
    return heights_of(s, duos_mul(duos_of(x, y), d->grains));
}

/* How high A - B's point stands whose parts stand so high. */
HOT twin height_of_both(const outlook *s, twin a, twin b)
{
    gather(&a, b);
    gather(&a, s->apart);
    return sum_of(a.high, a.low - a.high * s->excess);
}

HOT twin twin_of(duo_twin both, real (*own)(duo)) { return (twin){own(both.high), own(both.low)}; }

/* The height of A - B's point x - y. */
HOT twin height_at(const outlook *s, const difference *d, vec x, vec y)
{
    const duo_twin both = both_heights(s, d, x, y);
    return height_of_both(s, twin_of(both, of_a), twin_of(both, of_b));
}

/* The same, of one more point that is to be known. */
HOT twin height_noted(outlook *s, const difference *d, vec x, vec y)
{
    const duo_twin both = both_heights(s, d, x, y);
    s->x[s->known] = x;
    s->y[s->known] = y;
    s->stand[s->known++] = both;
    return height_of_both(s, twin_of(both, of_a), twin_of(both, of_b));
}

/* ---- the farthest corner ---- */

/* A set's corners, but a box's, one after the other. */
static list corners_of(const shape *s)
{
    static const real none[DIM];
    const points *p = s->data;
    if (s->support == pub(support_points)) return list_of_cloud(p);
    return (list){s->support == pub(support_origin) ? none : s->data, count_corners(s), DIM, 0, NULL};
}

/* Corners that may be the highest. */
#define HELD 8
typedef struct held {
    const real *at[HELD];
    real about[HELD];
    int n;
} held;

static inline int is_lower_twin(twin h, twin k) { return h.high < k.high || (h.high == k.high && h.low < k.low); }

/* How high the body's point stands. */
HOT twin own_height(const outlook *o, real (*own)(duo), real grain, vec x)
{
    const vec *known = own == of_a ? o->x : o->y;
    int k = 0;
    while (k < o->known && !(known[k].c[0] == x.c[0] && same(known[k], x))) k++;
    return twin_of(k < o->known ? o->stand[k] : heights_of(o, duos_both(mul(x, grain))), own);
}

/* Which of these is the highest in truth, the first of equals; those that are about lower than least are not. It is the
 * only one that is held then. own: of_a or of_b, by whose body they are. */
static void settle_held(held *s, const outlook *o, real (*own)(duo), real grain, real least)
{
    twin most = {-REAL_MAX, 0};
    int left = 0;
    for (int k = 0; k < s->n; k++) {
        if (s->about[k] < least) continue;
        s->at[left] = s->at[k];
        s->about[left++] = s->about[k];
    }
    s->n = 1;
    for (int k = 0; k < left && left > 1; k++) {
        const twin h = own_height(o, own, grain, load(s->at[k]));
        if (!is_lower_twin(most, h)) continue;
        most = h;
        s->at[0] = s->at[k];
        s->about[0] = s->about[k];
    }
}

/* How high a run of points stands along the way, step by step. Whether any is as high as that. */
HOT int stand_as_high(const real *at, size_t step, const ways *way, real least, real about[RUN])
{
    const lanes most = in_all(least);
    int high = 0;
    for (size_t k = 0; k < RUN; k += LANES) {
        const lanes here = heights(at + k * step, step, way);
        part_lanes(here, about + k);
        high |= any_as_large(here, most);
    }
    return high;
}

/* What tells which of a body's corners may be the highest. */
typedef struct watch {
    const outlook *o;
    real (*own)(duo);
    real grain, margin; /* heights are off by half of that at most */
    real least;         /* that is lower than one that has been seen */
} watch;

/* A corner that is about so high is held, if it may be the highest. */
HOT void hold_corner(held *s, watch *w, const real *at, real about)
{
    if (about < w->least) return;
    w->least = larger(about - w->margin, w->least);
    if (s->n == HELD) settle_held(s, w->o, w->own, w->grain, w->least);
    s->at[s->n] = at;
    s->about[s->n++] = about;
}

/* Of the body's corners the one farthest along the way looked along, as settle_held has it. Rounded heights tell which
 * it can't be. near: a corner that is about as far, if one is known. */
static vec farthest_corner(const outlook *o, const body *k, const shape *s, real (*own)(duo), const vec *near)
{
    vec rough;
    const real grain = k->grain;
    EACH(rough.c[i] = own(duo_add(o->high.c[i], o->low.c[i])));
    if (is_box(s)) return corner_of_box(s->data, rough);
    const list l = corners_of(s);
    const ways way = ways_of(mul(rough, grain));
    const size_t in_runs = unruly(grain) ? 0 : l.count / RUN * RUN;
    const real *at = l.v;
    watch w = {o, own, grain, 16 * UNIT * (k->reach * grain) * spread(rough), -REAL_MAX};
    if (near) w.least = dot(mul(*near, grain), rough) - w.margin;
    held some;
    some.n = 0;
    some.at[0] = at;
    for (size_t i = 0; i < in_runs; i += RUN, at += RUN * l.step) {
        real about[RUN];
        if (!stand_as_high(at, l.step, &way, w.least, about)) continue;
        for (size_t j = 0; j < RUN; j++) hold_corner(&some, &w, at + j * l.step, about[j]);
    }
    for (size_t i = in_runs; i < l.count; i++, at += l.step)
        hold_corner(&some, &w, at, dot(mul(load(at), grain), rough));
    settle_held(&some, o, own, grain, w.least);
    return load(some.at[0]);
}

/* ---- a facet's normal ---- */

/* For the upper digits of maps and of the ways within the bodies. */
typedef struct grids {
    duo of_map, of_way;
} grids;

static inline real grid_of_way(const body *k) { return 4 / leveler(k->reach * k->grain) * ROUNDING_TO(GRID); }

static inline grids grids_of(const difference *d)
{
    return (grids){duo_of(2 / leveler(d->a.norm) * ROUNDING_TO(GRID), 2 / leveler(d->b.norm) * ROUNDING_TO(GRID)),
                   duo_of(grid_of_way(&d->a), grid_of_way(&d->b))};
}

/* From a tip to another, as the bodies' own points say: what is added rounds itself, not as the points do. No bound
 * depends on it. */
static vec own_way(const difference *d, const grids *g, const tip *from, const tip *to)
{
    const duo by = duo_mul(d->grains, duo_of(1, -1));
    duos x, up, low;
    vec way;
    for (int i = 0; i < DIM; i++) {
        const duo start = duo_at(from->x.c + i, from->y.c + i);
        const duo_twin t = duo_sum_of(duo_at(to->x.c + i, to->y.c + i), duo_sub(duo_both(0), start));
        x.c[i] = duo_mul(t.high, by);
        up.c[i] = upper_digits_of(x.c[i], g->of_way);
        low.c[i] = duo_add(duo_sub(x.c[i], up.c[i]), duo_mul(t.low, by));
    }
    for (int row = 0; row < DIM; row++) {
        const duos m = row_of_map(&d->maps, row);
        duos m_up;
        EACH(m_up.c[i] = upper_digits_of(m.c[i], g->of_map));
        const duo here = duos_dot(m_up, up), lost = duo_add(duos_dot(m_up, low), duos_dot(duos_sub(m, m_up), x));
        const twin sum = sum_of(of_a(here), of_b(here));
        way.c[row] = sum.high + (of_a(lost) + (sum.low + of_b(lost)));
    }
    return way;
}

/* The unit normal of the facet between these tips, which is not thin, without what their corners round. */
static vec own_normal(const difference *d, const tip *const t[DIM])
{
    const grids g = grids_of(d);
#if DIM == 2
    vec e = own_way(d, &g, t[0], t[1]), n = {{e.c[1], -e.c[0]}};
#else
    /* from the two shorter edges, which meet in corner k */
    vec e[3];
    for (int i = 0; i < 3; i++) e[i] = way_to(t[i], t[i == 2 ? 0 : i + 1]);
    const real s0 = dot(e[0], e[0]), s1 = dot(e[1], e[1]), s2 = dot(e[2], e[2]);
    const int k = s0 >= s1 && s0 >= s2 ? 2 : s1 >= s2 ? 0 : 1;
    vec n = cross(own_way(d, &g, t[k], t[(k + 1) % 3]), own_way(d, &g, t[k], t[(k + 2) % 3]));
#endif
    return mul(n, 1 / length(n));
}

#endif
