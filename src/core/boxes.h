/* SPDX-License-Identifier: MIT */
/* Two boxes: how deep. Their difference A - B is a zonotope, the sum of six ways, to and fro: the boxes' own axes. Each
 * of its facets lies along two of these, so its normal is across a pair of axes, and of pairs there are 15, in the
 * plane of axes 4. The depth is the least height of these facets over the origin. What of this is told, and why it is
 * proven, is derived in docs/bounds.md. */
#ifndef GJK_CORE_BOXES_H
#define GJK_CORE_BOXES_H

#include "contact.h"
#include "plain.h"

#define AXES (2 * DIM)
#define PAIRS_OF_AXES (DIM == 2 ? 4 : 15)
#define MOST_WALLS 6 /* so many facets may be as low as any */

/* A - B: the points of the sum of s_k e_k u_k with s_k from -1 to 1, minus c. A's axes come first. */
typedef struct zonotope {
    vec u[AXES]; /* each box's map has a norm from 1 to 2 */
    real e[AXES], uu[AXES];
    real grain[2]; /* of the halves: from a box's own unit to e */
    vec c, c_low;
    real far; /* bounds the sum of the e_k |u_k| and |c| */
} zonotope;

/* The facet across a pair of axes: its normal, not of length 1, and its height times that length. */
typedef struct pair_of_axes {
    vec l;
    real ll, height;
    real size; /* bounds the product of the axes' lengths */
} pair_of_axes;

/* A facet that may be the lowest. */
typedef struct wall {
    vec n;             /* unit to rounding, away from A's position */
    real t[AXES];      /* the axes' heights along n */
    int first, second; /* the axes that it lies along, */
    unsigned along;    /* and all such, to rounding */
    twin height;       /* of the farthest corner of A - B along n */
    real floor;        /* no point of the facet is nearer to the origin */
    real drop;         /* by how much it is lower than that, without the rounding of n */
    real s[AXES];      /* its point nearest to the origin, */
    real beside;       /* and how far beside the plane's it is */
} wall;

/* The axes of one box. 0: they are of too different lengths, or the box is too small beside the other to tell. */
static inline int take_axes(zonotope *z, int box_at, const body *k)
{
    const box *of = k->data;
    const real level = k->posed ? leveler(k->norm) : 1, least = (real)0x1p-10;
    real reach = 0;
    int fair = 1;
    z->grain[box_at] = k->grain * (1 / level);
    for (int j = 0; j < DIM; j++) {
        const int at = DIM * box_at + j;
        if (k->posed) {
            EACH(z->u[at].c[i] = k->m[DIM * i + j] * level);
        } else z->u[at] = axis(j, 1);
        z->e[at] = of->half[j] * z->grain[box_at];
        z->uu[at] = dot(z->u[at], z->u[at]);
        fair &= z->uu[at] > least;
        reach += z->e[at];
        z->far += z->e[at] * ((z->uu[at] + 1) / 2);
    }
    return fair && reach > UNIT;
}

static inline int take_boxes(zonotope *z, const difference *d)
{
    z->c = d->c;
    z->c_low = d->c_low;
    z->far = spread(d->c);
    return take_axes(z, 0, &d->a) & take_axes(z, 1, &d->b);
}

/* ---- the facets, in plain numbers ---- */

/* Across which axes each facet is. */
#if DIM == 2
static const unsigned char first_of[PAIRS_OF_AXES] = {0, 1, 2, 3}, second_of[PAIRS_OF_AXES] = {0, 1, 2, 3};

static inline real height_of_pair(const zonotope *z, vec l)
{
    real h = 0;
    for (int k = 0; k < AXES; k++) h += z->e[k] * size(dot(l, z->u[k]));
    return h - size(dot(l, z->c));
}

static inline void find_pairs(const zonotope *z, pair_of_axes p[PAIRS_OF_AXES])
{
    for (int k = 0; k < AXES; k++) {
        const vec u = z->u[k], l = {{-u.c[1], u.c[0]}};
        p[k] = (pair_of_axes){l, z->uu[k], height_of_pair(z, l), (z->uu[k] + 1) / 2};
    }
}
#else
static const unsigned char first_of[PAIRS_OF_AXES] = {1, 2, 0, 4, 5, 3, 0, 0, 0, 1, 1, 1, 2, 2, 2};
static const unsigned char second_of[PAIRS_OF_AXES] = {2, 0, 1, 5, 3, 4, 3, 4, 5, 3, 4, 5, 3, 4, 5};

static inline real height_of_pair(const zonotope *z, vec l)
{
    real h = 0;
    for (int k = 0; k < AXES; k++) h += z->e[k] * size(dot(l, z->u[k]));
    return h - size(dot(l, z->c));
}

/* Each product of three axes is part of several heights. */
static inline void find_pairs(const zonotope *z, pair_of_axes p[PAIRS_OF_AXES])
{
    static const unsigned char next[5] = {0, 1, 2, 0, 1};
    real across[2][3][3]; /* of the face normal m of a box with axis k of the other */
    for (int b = 0; b < 2; b++) {
        const vec *own = z->u + 3 * b, *other = z->u + 3 - 3 * b;
        const real *e = z->e + 3 * b, *f = z->e + 3 - 3 * b;
        const vec n[3] = {cross(own[1], own[2]), cross(own[2], own[0]), cross(own[0], own[1])};
        const real volume = size(dot(n[0], own[0]));
        for (int m = 0; m < 3; m++) {
            real h = e[m] * volume;
            for (int k = 0; k < 3; k++) {
                across[b][m][k] = size(dot(n[m], other[k]));
                h += f[k] * across[b][m][k];
            }
            p[3 * b + m].l = n[m];
            p[3 * b + m].ll = dot(n[m], n[m]);
            p[3 * b + m].height = h - size(dot(n[m], z->c));
            p[3 * b + m].size = (z->uu[3 * b + next[m + 1]] + z->uu[3 * b + next[m + 2]]) / 2;
        }
    }
    for (int i = 0; i < 3; i++) {
        const int i1 = next[i + 1], i2 = next[i + 2];
        for (int j = 0; j < 3; j++) {
            const int j1 = next[j + 1], j2 = next[j + 2];
            pair_of_axes *q = &p[6 + 3 * i + j];
            q->l = cross(z->u[i], z->u[3 + j]);
            q->ll = dot(q->l, q->l);
            q->height = z->e[i1] * across[0][i2][j] + z->e[i2] * across[0][i1][j] + z->e[3 + j1] * across[1][j2][i] +
                        z->e[3 + j2] * across[1][j1][i] - size(dot(q->l, z->c));
            q->size = (z->uu[i] + z->uu[3 + j]) / 2;
        }
    }
}
#endif

/* What a height may be off, times the length of the normal: in shares of size times far. */
#define PAIR_DOUBT (32 * UNIT)

/* Axes that are as good as parallel have no normal to trust. */
#define PARALLEL ((real)0x1p-12)
static inline int is_steady(const pair_of_axes *p) { return p->ll > PARALLEL * (p->size * p->size); }

/* The lowest facet, by rounded heights, of pairs that have a good normal. */
static inline int lowest_pair(const pair_of_axes p[PAIRS_OF_AXES])
{
    int best = 0;
    real least = REAL_MAX;
    for (int k = 0; k < PAIRS_OF_AXES; k++) {
        const real square = p[k].height * size(p[k].height) / p[k].ll;
        if (!(square < least) || !is_steady(&p[k])) continue;
        least = square;
        best = k;
    }
    return best;
}

/* The facet is certainly no lower than that. */
static inline int is_above(const zonotope *z, const pair_of_axes *p, real height)
{
    const real least = p->height - PAIR_DOUBT * p->size * z->far;
    return least >= 0 && least * least >= height * height * p->ll;
}

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
    f->first = first_of[at];
    f->second = second_of[at];
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
    f->floor = f->height.high - 2 * UNIT * size(f->height.high) - (2 + 16 * UNIT) * open - WALL_DOUBT * z->far;
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
typedef struct flat {
    real x, y;
} flat;

static inline flat flat_of(vec a, int drop) { return (flat){a.c[drop == 0], a.c[drop == 2 ? 1 : 2]}; }

static inline real cross_flat(flat a, flat b) { return a.x * b.y - a.y * b.x; }

/* Spreads p among the arms: on the way from the facet's middle to p its rim is met on an edge, and as far as p is on
 * that way, so far each arm leads toward its end there. */
static void share_in_plane(const arms *m, int drop, vec p, real s[AXES])
{
    flat arm[AXES];
    const flat to = flat_of(p, drop);
    int edge = -1;
    real most = 0, side = 0;
    unsigned in_line = 0;
    for (int k = 0; k < m->n; k++) arm[k] = flat_of(m->arm[k], drop);
    for (int e = 0; e < m->n; e++) {
        const real off = cross_flat(to, arm[e]);
        real width = 0;
        for (int k = 0; k < m->n; k++) width += size(cross_flat(arm[k], arm[e]));
        if (!(width > 0) || !(edge < 0 || size(off) > most * width)) continue;
        most = size(off) / width;
        side = off;
        edge = e;
    }
    if (edge < 0) return;
    most = smaller(most, 1);
    for (int k = 0; k < m->n; k++) {
        const real off = cross_flat(arm[k], arm[edge]);
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
#define BESIDE (8 * UNIT)

#if DIM == 3
/* Where only two axes lead to p, and it is right under the origin, its height is the facet's however n is turned. */
static void share_among_two(const arms *m, int drop, vec p, real s[AXES])
{
    const flat a = flat_of(m->arm[0], drop), b = flat_of(m->arm[1], drop), to = flat_of(p, drop);
    const real whole = cross_flat(a, b);
    s[m->axis[0]] = larger(-1, smaller(1, cross_flat(to, b) / whole));
    s[m->axis[1]] = larger(-1, smaller(1, cross_flat(a, to) / whole));
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

/* ---- all facets that may be the lowest ---- */

typedef struct lows {
    wall of[MOST_WALLS];
    unsigned along[MOST_WALLS]; /* their axes, as they say */
    int n;
} lows;

/* Whether the facet across that pair of axes, if there is one, is one of those: its axes lie along that, and are far
 * from parallel. */
static inline int is_found(const lows *f, const pair_of_axes *p, int i, int j)
{
    for (int k = 0; k < f->n; k++)
        if ((f->along[k] >> i & 1) && (f->along[k] >> j & 1)) return p->ll * 64 > p->size * p->size;
    return 0;
}

static int add_wall(lows *f, const zonotope *z, const pair_of_axes p[PAIRS_OF_AXES], int at)
{
    if (f->n == MOST_WALLS) return 0;
    see_wall(z, p, at, &f->of[f->n]);
    f->along[f->n] = f->of[f->n].along;
    f->n++;
    return 1;
}

#if DIM == 3
/* Two axes, one of each box, that are as good as parallel, by their difference: it has all its digits where they are of
 * one length. 0: they are parallel, and there is no facet across them. */
static int cross_parallel(const zonotope *z, int first, int second, pair_of_axes *p)
{
    const vec u = z->u[first], v = z->u[second], d = dot(u, v) < 0 ? add(v, u) : sub(v, u);
    real skew = 0;
    EACH(skew += size(u.c[i] * v.c[(i + 1) % 3]) + size(u.c[(i + 1) % 3] * v.c[i]));
    if (!(peak(d) > 0) || !(skew > 0)) return 0;
    p->l = cross(u, d);
    p->ll = dot(p->l, p->l);
    p->size = root(z->uu[first] * dot(d, d));
    p->height = -size(dot(p->l, z->c));
    for (int k = 0; k < AXES; k++)
        if (k != first && k != second) p->height += z->e[k] * size(dot(p->l, z->u[k]));
    return 1;
}
#endif

/* The facets that may be the lowest, the first of them the one that looks so. 0: that is not certain, or the boxes are
 * apart. */
static int find_lows(const zonotope *z, lows *f)
{
    pair_of_axes p[PAIRS_OF_AXES];
    find_pairs(z, p);
    const int best = lowest_pair(p);
    f->n = 0;
    if (!is_steady(&p[best]) || p[best].height < -PAIR_DOUBT * p[best].size * z->far) return 0;
    add_wall(f, z, p, best);
    const real height = larger(f->of[0].height.high, 0);
    for (int k = 0; k < PAIRS_OF_AXES; k++) {
        if (is_above(z, &p[k], height) || is_found(f, &p[k], first_of[k], second_of[k])) continue;
        if (!is_steady(&p[k])) {
#if DIM == 3
            if (k < 2 * DIM) return 0;
            if (!cross_parallel(z, first_of[k], second_of[k], &p[k]) || is_above(z, &p[k], height)) continue;
            if (!is_steady(&p[k])) return 0;
#else
            return 0;
#endif
        }
        if (!add_wall(f, z, p, k)) return 0;
    }
    return 1;
}

/* ---- telling ---- */

/* The face's height without any rounding, where its normal is an axis of the frame and nothing else is off it. */
static int level_height(const zonotope *z, const difference *d, const shape *a, const shape *b, const wall *f, span *h)
{
    int at = -1, whole = 1, thick = 0;
    for (int i = 0; i < DIM; i++) {
        if (f->n.c[i] == 0) continue;
        if (at >= 0) return 0;
        at = i;
    }
    if (!is_way_whole(d, a, b)) return 0;
    const real sign = f->n.c[at] < 0 ? 1 : -1;
    *h = (span){sign * d->c.c[at], sign * d->c_low.c[at], 0};
    for (int k = 0; k < AXES; k++) {
        const shape *s = k < DIM ? a : b;
        const real u = z->u[k].c[at], half = ((const box *)s->data)->half[k % DIM];
        if (f->along >> k & 1 ? u != 0 : u == 0) return 0;
        if (u == 0) continue;
        whole &= is_whole(half, z->e[k]) && (!s->pose || is_whole(s->pose->m[DIM * at + k % DIM], u));
        thick |= z->e[k] > 0;
        *h = span_plus(*h, span_times((span){z->e[k], 0, 0}, (span){size(u), 0, 0}), 1);
    }
    return whole && thick && h->off == 0;
}

/* The facet's own height. */
static inline twin depth_of(const wall *f) { return sum_of(f->height.high, f->height.low - f->drop); }

/* Of some that are equally low to rounding one is right under the origin: the lowest such; and how low the lowest of
 * all is. NULL: none. */
static const wall *lowest_of(const zonotope *z, lows *f, twin *least)
{
    const wall *best = NULL;
    *least = (twin){REAL_MAX, 0};
    for (int k = 0; k < f->n; k++) {
        wall *here = &f->of[k];
        find_foot(z, here);
        const twin own = depth_of(here);
        if (is_lower_twin(own, *least)) *least = own;
        if (here->beside <= BESIDE * z->far && (!best || is_lower_twin(own, depth_of(best)))) best = here;
    }
    return best;
}

/* Bounds of the cores' separation where all facets' heights are known to all digits: contact, as a rule. */
static int bound_level(const zonotope *z, const difference *d, const shape *a, const shape *b, const lows *f,
                       const wall *low, real *lower, real *upper)
{
    *upper = -REAL_MAX;
    for (int k = 0; k < f->n; k++) {
        span h;
        if (!level_height(z, d, a, b, &f->of[k], &h) || !(h.high >= 0)) return 0;
        const real off = 2 * UNIT * h.high;
        *upper = larger(*upper, 0 - (h.high - off));
        if (low == &f->of[k]) *lower = 0 - (h.high + off);
    }
    return 1;
}

/* How deep two boxes overlap, or that they touch. 0: that is not certain, or they are apart. */
static APART int tell_boxes(search *q, const shape *a, const shape *b, const goal *g, result *r)
{
    zonotope z;
    lows f;
    vec x, y;
    twin deep;
    difference *d = &q->d;
    if (d->a.asked != AS_BOX || d->b.asked != AS_BOX || !(g->radius < PLAIN)) return 0;
    if (q->s.n <= DIM && dot(q->v, spare(&q->s)->w) > 0) return 0;
    know_offset(d, a, b);
    if (!take_boxes(&z, d) || !find_lows(&z, &f)) return 0;
    const wall *low = lowest_of(&z, &f, &deep);
    if (!low) return 0;
    real least = f.of[0].floor;
    for (int k = 1; k < f.n; k++) least = smaller(f.of[k].floor, least);
    const twin h = low->height;
    real lower = -h.high - 2 * UNIT * size(h.high) - WALL_DOUBT * z.far, upper = -least;
    if (!(upper - lower <= 3 * UNIT * z.far)) return 0;
    if (!(upper < 0) && !bound_level(&z, d, a, b, &f, low, &lower, &upper)) return 0;
    q->normal = low->n;
    EACH(x.c[i] = low->s[i] * (z.e[i] * (d->a.grain / z.grain[0]));
         y.c[i] = -low->s[DIM + i] * (z.e[DIM + i] * (d->b.grain / z.grain[1])));
    bracket(r, d, lower, upper, a, b);
    twin value = sum_of(-deep.high, -g->radius);
    r->value = (value.high + (value.low - deep.low)) * d->unscale;
    place_points(r, q, x, y, low->n, a, b, 2);
    store(r->normal, q->normal);
    r->steps = q->steps;
    r->supports = d->calls;
    r->reserved = 0;
    return 1;
}

#endif
