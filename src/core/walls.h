/* SPDX-License-Identifier: MIT */
/* A facet of the difference of two boxes to twice the digits: how low it is at least, and its point nearest to the
 * origin (docs/bounds.md). */
#ifndef GJK_CORE_WALLS_H
#define GJK_CORE_WALLS_H

#include "plain.h"
#include "zonotope.h"

/* A facet that may be the lowest. */
typedef struct wall {
    vec n;          /* unit to rounding, away from A's position */
    real t[AXES];   /* the axes' heights along n */
    unsigned along; /* the axes that it lies along, to rounding */
    twin height;    /* of the farthest corner of A - B along n */
    real floor;     /* no point of the facet is nearer to the origin */
    real drop;      /* by how much it is lower than that, without the rounding of n */
    real s[AXES];   /* its point nearest to the origin, */
    real beside;    /* and how far beside the plane's it is */
} wall;

/* ---- one facet to twice the digits ---- */

/* What heights to twice the digits are off, in shares of far. */
#define WALL_DOUBT (512 * UNIT / (real)((bits)1 << GRID))

/* Upper digits, and the rest: products of the former, and their sums here, have no rounding. */
typedef struct parted {
    real up, rest;
} parted;

static inline parted part_of(real x)
{
    const real up = upper_digits(x, 2);
    return (parted){up, x - up};
}

/* Looks at the facet across that pair of axes. */
static void see_wall(const zonotope *z, const pair_of_axes p[PAIRS_OF_AXES], int at, wall *f)
{
    const pair_of_axes *of = &p[at];
    const real l = root(of->ll), off = UNIT * ((real)4.5 * (of->size / l) + 2);
    const real along = dot(of->l, z->c), blur = 4 * UNIT * dot_size(of->l, z->c);
    const vec n = mul(of->l, (along < 0 ? (real)-1 : (real)1) / l);
    real up = 0, rest = 0, most = 0, open = size(along) > blur ? 0 : blur / l;
    vec n_up, n_rest;
    f->n = n;
    f->along = 0;
    for (int i = 0; i < DIM; i++) {
        const parted d = part_of(n.c[i]), c = part_of(z->c.c[i]);
        n_up.c[i] = d.up;
        n_rest.c[i] = d.rest;
        up -= c.up * d.up;
        rest -= c.up * d.rest + (c.rest + z->c_low.c[i]) * n.c[i];
    }
    const real excess = ((dot(n_up, n_up) - 1) + dot(add(n_up, n), n_rest)) / 2;
    for (int k = 0; k < AXES; k++) {
        const vec u = z->u[k];
        vec u_up;
        EACH(u_up.c[i] = upper_digits(u.c[i], 2));
        const real t = dot(u_up, n_up), low = dot(u_up, n_rest) + dot(sub(u, u_up), n);
        const real rise = t + low, sign = rise < 0 ? -1 : 1;
        const parted e = part_of(z->e[k]), d = part_of(t);
        up += sign * (e.up * d.up);
        rest += sign * (e.up * (d.rest + low) + e.rest * rise);
        f->t[k] = rise;
        if (!(rise * rise <= off * off * z->uu[k])) continue;
        f->along |= 1u << k;
        most = larger(most, rise * rise / z->uu[k]);
    }
    most = larger(off * off, 17 * 17 * most);
    for (int k = 0; k < AXES; k++)
        if (f->t[k] * f->t[k] <= most * z->uu[k]) open += z->e[k] * size(f->t[k]);
    f->height = sum_of(up, rest - up * excess);
    f->floor = below(f->height.high, f->height.low - (2 + 16 * UNIT) * open - WALL_DOUBT * z->far, 0);
}

/* ---- the facet's point above the origin ---- */

static inline vec arm_of(const zonotope *z, int k) { return mul(z->u[k], z->e[k]); }

/* What a facet is spanned by, to and fro: its axes, each as long as it is. */
typedef struct arms {
    vec arm[AXES];
    int axis[AXES], n;
} arms;

/* Spreads what p has along the arm g among those in line with it, by their lengths. */
static void share_along(const arms *m, unsigned in_line, vec g, vec p, real s[AXES])
{
    real way[AXES], whole = 0;
    for (int k = 0; k < m->n; k++) {
        way[k] = in_line >> k & 1 ? dot(m->arm[k], g) : 0;
        whole += size(way[k]);
    }
    const real share = whole > 0 ? larger(-1, smaller(1, dot(p, g) / whole)) : 0;
    for (int k = 0; k < m->n; k++)
        if (in_line >> k & 1) s[m->axis[k]] = way[k] < 0 ? -share : share;
}

#if DIM == 3
/* A direction in a facet's plane, seen along an axis of the frame. */
typedef struct shadow {
    real x, y;
} shadow;

static inline shadow shadow_of(vec a, int drop) { return (shadow){a.c[drop == 0], a.c[drop == 2 ? 1 : 2]}; }

static inline real cross_shadows(shadow a, shadow b) { return a.x * b.y - a.y * b.x; }

/* Spreads p among the arms: on the way from the facet's middle to p its rim is met on an edge, and as far as p is on
 * that way, so far each arm leads toward its end there. */
static void share_in_plane(const arms *m, int drop, vec p, real s[AXES])
{
    shadow arm[AXES];
    const shadow to = shadow_of(p, drop);
    int edge = -1;
    real most = 0, side = 0;
    unsigned in_line = 0;
    for (int k = 0; k < m->n; k++) arm[k] = shadow_of(m->arm[k], drop);
    for (int e = 0; e < m->n; e++) {
        const real off = cross_shadows(to, arm[e]);
        real width = 0;
        for (int k = 0; k < m->n; k++) width += size(cross_shadows(arm[k], arm[e]));
        if (!(width > 0) || !(edge < 0 || size(off) > most * width)) continue;
        most = size(off) / width;
        side = off;
        edge = e;
    }
    if (edge < 0) return;
    most = smaller(most, 1);
    for (int k = 0; k < m->n; k++) {
        const real off = cross_shadows(arm[k], arm[edge]);
        if (!(size(off) > 16 * UNIT * (spread(m->arm[k]) * spread(m->arm[edge])))) {
            in_line |= 1u << k;
            continue;
        }
        const real share = (off < 0) == (side < 0) ? most : -most;
        s[m->axis[k]] = share;
        p = sub(p, mul(m->arm[k], share));
    }
    share_along(m, in_line, m->arm[edge], p, s);
}
#endif

/* By how much the height changes where n is turned so that both of these axes lie across it; p leads from the middle of
 * the facet to the foot. All is of the size of roundings. */
static inline real change_across(const zonotope *z, const wall *f, vec p, int i, int j)
{
#if DIM == 2
    const vec side = {{f->n.c[1], -f->n.c[0]}}, turn = mul(side, -f->t[i] / dot(z->u[i], side));
    (void)j;
#else
    const vec a = cross(z->u[i], f->n), b = cross(z->u[j], f->n);
    const real width = dot(z->u[i], b);
    if (!(width * width > PARALLEL * (z->uu[i] * z->uu[j]))) return 0;
    const vec turn = mul(sub(mul(a, f->t[j]), mul(b, f->t[i])), 1 / width);
#endif
    real change = -dot(p, turn);
    for (int k = 0; k < AXES; k++) {
        if (!(f->along >> k & 1)) continue;
        const real t = f->t[k], turned = k == i || k == j ? 0 : size(t + dot(z->u[k], turn));
        change += z->e[k] * (turned - size(t));
    }
    return change;
}

/* By how much the facet is lower than what rounding makes of n: of those that lie across two of its axes without
 * rounding one is the lowest. */
static real drop_of(const zonotope *z, const wall *f, vec p)
{
    int level = 1;
    real drop = 0;
    for (int k = 0; k < AXES; k++) level &= !(f->along >> k & 1) || f->t[k] == 0;
    for (int k = 0; k < PAIRS_OF_AXES && !level; k++)
        if ((f->along >> first_of[k] & 1) && (f->along >> second_of[k] & 1))
            drop = larger(drop, -change_across(z, f, p, first_of[k], second_of[k]));
    return drop;
}

/* The point is as good as right under the origin, in shares of far. */
#define BESIDE (2 * UNIT)

#if DIM == 3
/* Where only two axes lead to p, and it is right under the origin, its height is the facet's however n is turned. */
static void share_among_two(const arms *m, int drop, vec p, real s[AXES])
{
    const shadow a = shadow_of(m->arm[0], drop), b = shadow_of(m->arm[1], drop), to = shadow_of(p, drop);
    const real whole = cross_shadows(a, b);
    s[m->axis[0]] = larger(-1, smaller(1, cross_shadows(to, b) / whole));
    s[m->axis[1]] = larger(-1, smaller(1, cross_shadows(a, to) / whole));
}
#endif

/* Where the facet's plane is nearest to the origin, as a point of A - B; and how high the facet is. */
static void find_foot(const zonotope *z, wall *f)
{
    vec p = add(mul(f->n, f->height.high), z->c), off;
    arms m;
    m.n = 0;
    for (int k = 0; k < AXES; k++) {
        const vec arm = arm_of(z, k);
        f->s[k] = f->t[k] < 0 ? (real)-1 : (real)1;
        if (f->along >> k & 1) {
            m.arm[m.n] = arm;
            m.axis[m.n++] = k;
        } else p = f->t[k] < 0 ? add(p, arm) : sub(p, arm);
    }
#if DIM == 2
    share_along(&m, (1u << m.n) - 1, (vec){{f->n.c[1], -f->n.c[0]}}, p, f->s);
#else
    const vec n = f->n;
    const int x_high = size(n.c[0]) > size(n.c[1]), peak_at_z = size(n.c[2]) > size(n.c[x_high ? 0 : 1]);
    const int drop = peak_at_z ? 2 : x_high ? 0 : 1;
    if (m.n == 2) share_among_two(&m, drop, p, f->s);
    else share_in_plane(&m, drop, p, f->s);
#endif
    off = p;
    f->drop = 0;
    for (int k = 0; k < m.n; k++) {
        const real s = f->s[m.axis[k]], t = f->t[m.axis[k]];
        off = sub(off, mul(m.arm[k], s));
        f->drop += z->e[m.axis[k]] * (size(t) - s * t);
    }
    f->beside = spread(off);
    if (m.n > DIM - 1 || !(f->beside <= BESIDE * z->far)) f->drop = drop_of(z, f, p);
}

#endif
