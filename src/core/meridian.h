/* SPDX-License-Identifier: MIT */
/* How deep bodies about one axis are (balls, capsules, cylinders, cones, ellipsoids that are round about it, side by
 * side or within each other), without a polytope: on a cone's edge all ways around the axis are about as short, and a
 * surface of facets comes to no end. But for where the middle is, heights are the same all around; so they are the
 * least on the meridian that leads away from it, and there the shadow of A - B is a polygon and an ellipse or two. */
#ifndef GJK_CORE_MERIDIAN_H
#define GJK_CORE_MERIDIAN_H

#include "circles.h"

#if DIM == 3

/* That half of its plane, x across the axis and y along it, and what limbs count for there. */
typedef struct meridian {
    vec across, along;
    arrow middle; /* and discs, which count as so much x */
    real edge;    /* along the axis */
    arrow cone[2];
    oval oval[MOST_OVALS];
    int cones, ovals;
    real off;       /* limbs are no farther off these than that, */
    real roundings; /*   but for so many; */
    real sizes;     /* and what all count for at most */
    real far;       /* the middle from the axis */
} meridian;

/* ---- the axis ---- */

/* As long as 1 can be: what a rounded one is too long, to twice the digits, is taken off. */
static inline vec to_unit(vec x)
{
    const vec n = mul(x, 1 / length(x));
    twin more = {-1, 0};
    for (int i = 0; i < DIM; i++) gather(&more, square_of(n.c[i]));
    return sub(n, mul(n, (more.high + more.low) / 2));
}

/* The row of an ellipsoid that is the least like the others, by their squares, and how much so. */
static int odd_row(const limb *l, real *odds)
{
    real square[3];
    int odd = 0;
    *odds = -1;
    for (int r = 0; r < 3; r++) square[r] = dot(l->row[r], l->row[r]);
    for (int r = 0; r < 3; r++) {
        const real p = square[(r + 1) % 3], q = square[(r + 2) % 3];
        const real here = smaller(size(square[r] - p), size(square[r] - q)) - size(p - q);
        if (!(here > *odds * (l->size * l->size))) continue;
        *odds = here / (l->size * l->size);
        odd = r;
    }
    return odd;
}

/* That of the first limb that has one, of ellipsoids the one that is the least like a ball. 0: there is none. */
static int find_axis(const bulk *of, vec *along)
{
    vec way = axis(0, 0);
    real most = -1;
    for (int i = 0; i < of->limbs; i++) {
        const limb *l = &of->limb[i];
        if (l->rows < 3) {
            way = spindle_of(l).way;
            break;
        }
        real odds;
        const int odd = odd_row(l, &odds);
        if (!(odds > most)) continue;
        most = odds;
        way = unit_size(l->row[odd]);
    }
    *along = to_unit(way);
    return dot(way, way) > 0;
}

/* ---- limbs about it ---- */

static inline vec aside_of(vec along, vec x) { return sub(x, mul(along, dot(x, along))); }

/* As a circle about the axis, its radius; and so much farther off, by squares. */
static real as_circle(vec along, vec u, vec v, real *square)
{
    const vec x = aside_of(along, u);
    if (!(dot(x, x) > REAL_MIN / UNIT)) {
        *square = REAL_MAX;
        return 0;
    }
    const vec p = to_unit(x), y = cross(along, p), q = dot(y, v) < 0 ? mul(y, -1) : y;
    const real radius = (dot(u, p) + dot(v, q)) / 2;
    const vec off_u = sub(u, mul(p, radius)), off_v = sub(v, mul(q, radius));
    *square += dot(off_u, off_u) + dot(off_v, off_v);
    return radius;
}

static void add_ellipse(meridian *m, const limb *l)
{
    int odd = 0;
    real square = 0, most = -1;
    for (int r = 0; r < 3; r++) {
        const real here = size(dot(l->row[r], m->along)), far = length(l->row[r]);
        if (!(here > most * far)) continue;
        most = here / far;
        odd = r;
    }
    const vec w = aside_of(m->along, l->row[odd]);
    const real radius = as_circle(m->along, l->row[(odd + 1) % 3], l->row[(odd + 2) % 3], &square);
    const real half = size(dot(l->row[odd], m->along));
    m->off += root(square + dot(w, w));
    m->roundings += 10 * radius + 3 * half;
    m->sizes += larger(radius, half);
    m->oval[m->ovals++] = (oval){{{radius, 0}, {0, half}}, radius * half, larger(radius, half)};
}

static void add_edge_along(meridian *m, vec x)
{
    const real half = size(dot(x, m->along));
    m->off += length(aside_of(m->along, x));
    m->roundings += 3 * half;
    m->sizes += half;
    m->edge += half;
}

static void add_disc_about(meridian *m, const limb *l)
{
    real square = 0;
    const real radius = as_circle(m->along, l->row[0], l->row[1], &square);
    m->off += root(square);
    m->roundings += 10 * radius;
    m->sizes += radius;
    if (!l->partial) {
        m->middle.x += radius;
        return;
    }
    const real lean = dot(l->lean, m->along);
    m->cone[m->cones++] = (arrow){radius, lean};
    m->off += length(aside_of(m->along, l->lean));
    m->roundings += 3 * size(lean);
    m->sizes += size(lean);
}

static void add_part(meridian *m, const limb *l)
{
    if (l->rows == 3) add_ellipse(m, l);
    else if (l->rows == 2) add_disc_about(m, l);
    else add_edge_along(m, l->row[0]);
}

/* The way from the middle to the axis: any, where it is there to rounding. */
static void lay_across(meridian *m, vec middle)
{
    const vec x = mul(aside_of(m->along, middle), -1);
    const real far = length(x), size_of_middle = length(middle);
    vec e[2];
    if (far > 64 * UNIT * size_of_middle) {
        e[0] = aside_of(m->along, mul(x, 1 / far)); /* square to the axis, to rounding */
    } else {
        put_across(m->along, e);
    }
    m->across = to_unit(e[0]);
    const arrow in = {dot(middle, m->across), dot(middle, m->along)};
    const vec by = sub(sub(middle, mul(m->across, in.x)), mul(m->along, in.y));
    m->middle = add2(m->middle, in);
    m->off += length(by) + 2 * larger(in.x, 0);
    m->roundings += 7 * size_of_middle;
    m->sizes += size_of_middle;
    m->far = far;
}

/* So much limbs may be off, over their sizes, for that to be of any use. */
#define ASKEW_MOST ((real)0x1p-20)

/* 0: they are not about one axis. */
static int lay_meridian(meridian *m, const bulk *of)
{
    const real most = ASKEW_MOST * sum_of_sizes(of, NULL);
    m->middle = (arrow){0, 0};
    m->edge = m->off = m->roundings = m->sizes = 0;
    m->cones = m->ovals = 0;
    if (!find_axis(of, &m->along)) return 0;
    for (int i = 0; i < of->limbs && m->off <= most; i++) add_part(m, &of->limb[i]);
    if (!(m->off <= most)) return 0;
    lay_across(m, of->middle);
    return m->off <= most;
}

/* ---- its pieces ---- */

/* From one way to the next, between which a polygon has one corner. */
static void draw_piece(const meridian *m, arrow from, arrow to, circle *c)
{
    const arrow amid = add2(from, to);
    c->e[0] = m->across;
    c->e[1] = m->along;
    c->middle = add2(m->middle, (arrow){0, amid.y < 0 ? -m->edge : m->edge});
    for (int i = 0; i < m->cones; i++)
        if (dot2(m->cone[i], amid) > 0) c->middle = add2(c->middle, m->cone[i]);
    c->edges = 0;
    c->ovals = m->ovals;
    for (int i = 0; i < m->ovals; i++) c->oval[i] = m->oval[i];
    c->nodes = 2;
    c->node[0] = node_at(c, from);
    c->node[1] = node_at(c, to);
}

/* What rounding does to a floor, as derived in docs/bounds.md, and what is off and joined. */
static real charge_meridian(const meridian *m, const bulk *of, real least)
{
    const int roundings = of->limbs + 3 + (m->ovals ? 24 : 0);
    const real all = m->roundings + (real)roundings * m->sizes + 4 * size(least) + 2;
    return UNIT * all + m->off * (1 + 16 * UNIT) + off_by_joints(of);
}

/* Where it bends: along the axis and square to it, and where a cone begins to count. 0: bodies are not about one axis.
 */
static int draw_meridian(circles *all, const bulk *of)
{
    meridian m;
    directions f;
    all->of = of;
    all->disc = -1;
    all->count = 0;
    all->least = REAL_MAX;
    if (!lay_meridian(&m, of)) return 0;
    f.n[0] = (arrow){0, -1};
    f.count = 1;
    put_direction(&f, (arrow){1, 0});
    for (int i = 0; i < m.cones; i++) put_direction(&f, left2(m.cone[i]));
    f.n[f.count++] = (arrow){0, 1};
    for (int i = 0; i + 1 < f.count; i++) {
        draw_piece(&m, f.n[i], f.n[i + 1], &all->at[all->count]);
        take_circle(all);
    }
    all->off = charge_meridian(&m, of, all->least);
    all->simple = m.ovals ? -REAL_MAX : all->least - all->off;
    all->level = (m.far <= all->least / 16) + (m.far <= all->least / 1024 && m.ovals < of->limbs);
    return 1;
}

/* ---- its dips ---- */

/* So often a way is turned toward the dip below it. */
#define TURNS_TO_DIP 64

/* Where the height of the piece is the least below n: an end, or where it has no slope, by Newton's turns or halves. */
static arrow go_to_dip(const circle *c, arrow n)
{
    arrow from = c->node[0].n, to = c->node[c->nodes - 1].n;
    for (int i = 0; i < TURNS_TO_DIP; i++) {
        const arrow left = left2(n);
        const node here = node_at(c, n);
        real slope = dot2(c->middle, left), bow = -here.height;
        for (int k = 0; k < c->ovals; k++) {
            const arrow rim = oval_along(&c->oval[k], n), there = oval_along(&c->oval[k], left);
            const real far = here.far[k], by = dot2(rim, there) / far;
            slope += by;
            bow += (dot2(there, there) - by * by) / far;
        }
        if (!(size(slope) > 4 * UNIT * here.height)) break;
        *(slope > 0 ? &to : &from) = n;
        const arrow next = unit2(sub2(n, mul2(left, slope / bow)));
        const int amid = bow > 0 && cross2(from, next) > 0 && cross2(next, to) > 0;
        n = amid ? next : unit2(add2(from, to));
    }
    return n;
}

/* ---- where limbs meet ---- */

static inline int is_at_point(const bent *b, int at) { return is_on_edge(b, at) && !is_on_slant(b, at); }

/* What a limb counts for along n, on whose edge that is not; or amid what it may count for. half: from there to both
 * ends of that, or nothing; a disc's, square to the axis, which n is along, is any way. */
static vec amid_limb(const bent *b, const limb *l, int at, vec *half)
{
    const bearing v = bearing_of(l, b->n);
    vec rim = axis(0, 0);
    *half = rim;
    if (l->rows == 1) {
        if (is_on_edge(b, at)) *half = l->row[0];
        return mul(l->row[0], is_on_edge(b, at) ? 0 : b->sign[at]);
    }
    for (int r = 0; r < l->rows && v.far > 0 && !is_at_point(b, at); r++)
        rim = add(rim, mul(l->row[r], v.along.c[r] / v.far));
    if (!l->partial) return rim;
    rim = add(rim, l->lean);
    if (is_on_slant(b, at)) *half = mul(rim, (real)0.5);
    return is_on_slant(b, at) ? *half : mul(rim, (1 + b->sign[at]) / 2);
}

/* On whose edge n is, to rounding or to what is off, and as which those count where it is not. */
static void find_edges(const bulk *of, real off, bent *b)
{
    for (int i = 0; i < of->limbs; i++) {
        const limb *l = &of->limb[i];
        const bearing v = bearing_of(l, b->n);
        const real slop = larger(64 * UNIT * (l->partial ? l->steep : l->size), 2 * off);
        const int at_point = l->rows == 2 && v.far <= slop && (!l->partial || v.here > 0);
        const int by_edge = (l->rows == 1 || l->partial) && size(v.here) <= slop;
        b->sign[i] = v.here < 0 ? -1 : 1;
        if (at_point || by_edge) b->edges |= 1u << i;
        if (by_edge && l->partial) b->slants |= 1u << i;
        if (!at_point || b->rows > 0) continue;
        for (; b->rows < 2; b->rows++) b->of[b->rows] = i;
    }
}

/* The point that is farthest along n where that is on more edges than tell their shares (round.h), all of which lie one
 * way: they share alike. Nothing is said of how heights are bent there. */
static void stand_about_axis(const circles *all, bent *b)
{
    const bulk *of = all->of;
    vec half[MOST_LIMBS], rest = of->middle, along = axis(0, 0);
    real radii = 0;
    *b = (bent){.n = all->n, .height_off = REAL_MAX};
    find_edges(of, all->off, b);
    for (int i = 0; i < of->limbs; i++) {
        const limb *l = &of->limb[i];
        rest = add(rest, amid_limb(b, l, i, &half[i]));
        along = dot(along, half[i]) < 0 ? sub(along, half[i]) : add(along, half[i]);
        if (l->rows == 2 && is_at_point(b, i)) radii += l->size; /* times one number */
    }
    const real square = dot(along, along), share = square > 0 ? -dot(rest, along) / square : 0;
    for (int i = 0; i < of->limbs; i++) {
        if (!(dot(half[i], half[i]) > 0)) continue;
        b->sign[i] = larger(-1, smaller(1, dot(along, half[i]) < 0 ? -share : share));
        b->edges &= ~(1u << i); /* it counts as that */
    }
    b->slants = 0;
    if (b->rows == 0) return;
    const limb *first = &of->limb[b->of[0]];
    vec part = mul(rest, first->size / radii);
    share_rest(first, b->share, &part);
}

/* ---- the least of all ---- */

/* So often a lower dip is looked for. */
#define DESCENTS 4

/* A dip where heights have been seen to be the least, or near there, if that is as low; with its points. */
static void go_down(circles *all, real spare, bent *b)
{
    if (all->disc >= 0) {
        if (!find_least(all->of, all->n, NULL, b) || all->least < height_of_bulk(all->of, b->n) - spare)
            stand_on_edges(all, b);
        return;
    }
    const circle *c = &all->at[all->in];
    if (c->ovals) {
        const arrow n = go_to_dip(c, in_plane(c, all->n));
        take_least(all, node_at(c, n).height, lifted(c, n));
    }
    stand_about_axis(all, b);
}

/* Ways around n are as level as can be said, unless n itself is all but along the axis: nothing is level around that.
 */
static int level_at(const circles *all, vec n)
{
    const real along = all->level ? dot(n, all->at[0].e[1]) : 1;
    return 1 - along * along > (real)0x1p-12 ? all->level : 0;
}

/* Finds the least height of all; of edges and a disc from a dip that is known, if any. 0: it is not proven to be; else
 * b's floor is what heights are at least. */
static int find_least_of_all(const bulk *of, const bent *known, bent *b)
{
    circles all;
    if (!draw_circles(&all, of) && !draw_meridian(&all, of)) return 0;
    const real spare = all.off / 8;
    const int has_dip = known && all.disc >= 0;
    if (has_dip) *b = *known;
    for (int i = 0; i < DESCENTS; i++) {
        if (i > 0 || !has_dip || all.least < height_of_bulk(of, b->n) - spare) go_down(&all, spare, b);
        const real high = smaller(height_of_bulk(of, b->n), all.least) - spare;
        if (!(high > all.off)) return 0;
        b->level = level_at(&all, b->n);
        if (all.simple >= high - all.off) {
            b->floor = all.simple;
            return 1;
        }
        const enum round_trip trip = are_circles_high(&all, high);
        if (trip == UNPROVEN) return 0;
        if (trip == IS_LOWER) continue;
        b->floor = high - all.off;
        return 1;
    }
    return 0;
}

#endif

#endif
