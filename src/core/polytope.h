/* SPDX-License-Identifier: MIT */
/* A polytope within the difference A - B: a closed surface of facets between corners of the difference, each turned
 * outward. It grows by one corner at a time: the facets that see the corner give way to facets from their rim to it.
 * Only that the surface is closed is ever relied on, and that is so by the way it is made: what is taken out and what
 * is put in have the same rim, whatever rounding says of who sees whom. Whether it surrounds the origin is proven at
 * the end. Facets that are high enough may be dropped, after they have been counted: they are never taken out again, so
 * the others and they are a closed surface still. The memory is the caller's. */
#ifndef GJK_CORE_POLYTOPE_H
#define GJK_CORE_POLYTOPE_H

#include "minkowski.h"

#define FEWEST_TIPS 8
#define USUAL_TIPS 64
#define MOST_TIPS 16000 /* 16 bits count the facets */

/* A corner of the polytope. */
typedef struct tip {
    vec w, low; /* of the difference, and what rounding took from it, where that can be known; see sharpen_tip */
    vec x, y;   /* of A and of B */
} tip;

/* In place of what rounding took from a tip, until somebody asks. */
#define UNTOLD REAL_MAX

typedef struct facet {
    vec n;             /* unit to rounding, outward; of a facet without area any unit vector */
    real height;       /* along n, the least of its corners' */
    int16_t v[DIM];    /* tips, counterclockwise from outside */
    int16_t next[DIM]; /* the facets across its seams; WALL: one that was dropped */
    signed char done;  /* nothing lies beyond it */
    signed char gone;  /* it makes room for the corner that is being taken in */
    signed char form;
    signed char
        rough; /* made of what its tips are by rounding, though more of these can be known; or its normal is not */
} facet;

enum rough { SHARP, ROUGH, POLISHED };

/* THIN: it has no area to speak of, and its normal is noise. WIDE: it is so large that its normal, by what its corners
 * and its edges have been rounded, is off by less than an eighth of CLEAR; a rough one so large that as seen from the
 * origin it is turned the same way without these roundings, if it is higher than CLEAR (docs/bounds.md). */
enum form { THIN, LEAN, WIDE };

/* What rounding may have put into a tip, to all that is known of it; and without that. */
#define NOISE (32 * UNIT * UNIT)
#define ROUGH_NOISE (32 * UNIT)

/* What is so far from a wide facet's plane is on that side of it, whichever corner is asked. */
#define CLEAR ((real)0x1p14 * UNIT)

#define WALL (-1)
#define ALONE (-2) /* until the other side is found */

/* Where two facets meet, as one of them sees it: in space an edge, from a tip to a tip; in the plane a tip, and whether
 * the facet ends there. */
typedef struct seam {
    int16_t v[2];
    int16_t of, next; /* the facet, and that across it */
} seam;

typedef struct polytope {
    tip *tip;
    facet *facet;
    seam *rim; /* of what is gone */
    int tips, facets, rims, most_tips, most_facets;
    const difference *whole;                                   /* tips are its corners, known to twice the digits */
    int (*side)(const void *of, const facet *f, const tip *t); /* on which side of the facet t is, without rounding */
    const void *of;                                            /* NULL, both: that is not asked */
    int without_rounding;                                      /* nothing but side tells sides */
} polytope;

/* A closed surface of triangles has 2 tips - 4, of edges as many as tips; and some more, which are put in before others
 * are taken out. */
#define FACETS_FOR(tips) (DIM == 2 ? (tips) + 2 : 2 * (tips) + 4)

/* As polytope_in lays it out. */
typedef struct usual_room {
    tip tip[USUAL_TIPS];
    facet facet[FACETS_FOR(USUAL_TIPS)];
    seam rim[FACETS_FOR(USUAL_TIPS)];
} usual_room;

static inline size_t bytes_for(size_t tips)
{
    return tips * sizeof(tip) + FACETS_FOR(tips) * (sizeof(facet) + sizeof(seam));
}

/* How many go into so many bytes, which are enough for a few. */
static inline size_t tips_in(size_t bytes)
{
    size_t tips = (bytes - bytes_for(0)) / (bytes_for(1) - bytes_for(0));
    return tips < MOST_TIPS ? tips : MOST_TIPS;
}

/* With room for so many tips; none but the counts is set. */
static polytope polytope_in(void *workspace, size_t tips)
{
    polytope p = {.tip = workspace, .most_tips = (int)tips, .most_facets = (int)FACETS_FOR(tips)};
    p.facet = (facet *)(void *)(p.tip + tips);
    p.rim = (seam *)(void *)(p.facet + p.most_facets);
    return p;
}

/* Whether they are the same points of both bodies; w, which follows from these, tells most apart. */
static inline int is_same(const tip *t, const tip *u)
{
    return t->w.c[0] == u->w.c[0] && same(t->x, u->x) && same(t->y, u->y);
}

static int is_tip_of(const polytope *p, const facet *f, const tip *t)
{
    for (int i = 0; i < DIM; i++)
        if (is_same(&p->tip[f->v[i]], t)) return 1;
    return 0;
}

/* Whether that corner was taken in before, and not dropped to make room. */
static int is_known(const polytope *p, const tip *t)
{
    for (int i = 0; i < p->tips; i++)
        if (is_same(&p->tip[i], t)) return 1;
    return 0;
}

/* Works out what rounding took from the tip, if that has not been asked before. */
static inline void sharpen_tip(const polytope *p, tip *t)
{
    const difference *d = p->whole;
    const vec none = axis(0, 0);
    if (t->low.c[0] == UNTOLD) t->low = remainder_of(d, mul(t->x, d->a.grain), none, mul(t->y, d->b.grain), none, t->w);
}

/* From one tip to another, as they are rounded. */
static inline vec way_to(const tip *from, const tip *to) { return sub(to->w, from->w); }

/* The same to all digits that are known: of sharp tips. */
static inline vec reach_over(const tip *from, const tip *to)
{
    return add(sub(to->w, from->w), sub(to->low, from->low));
}

static inline real height_of(const tip *t, vec n) { return dot(n, t->w) + dot(n, t->low); }

/* How far the tip, as rounded, lies beyond the facet's lowest corner. */
static inline real rough_rise(const facet *f, const tip *t) { return dot(f->n, t->w) - f->height; }

/* Whether that alone tells on which side of the facet the tip is. */
static inline int is_clear(const facet *f, real above) { return f->form == WIDE && size(above) > CLEAR; }

/* Of none at all: along the first axis. */
static vec unit_of(vec n, vec otherwise)
{
    if (!(peak(n) > 0)) n = otherwise;
    if (!(peak(n) > 0)) return axis(0, 1);
    n = unit_size(n);
    return mul(n, 1 / length(n));
}

static real least_height(const polytope *p, const facet *f, vec n)
{
    real least = height_of(&p->tip[f->v[0]], n);
    for (int i = 1; i < DIM; i++) least = smaller(height_of(&p->tip[f->v[i]], n), least);
    return least;
}

/* From tip to tip, without rounding. */
static void fine_reach(const tip *from, const tip *to, twin r[DIM])
{
    for (int i = 0; i < DIM; i++) {
        r[i] = sum_of(to->w.c[i], -from->w.c[i]);
        gather(&r[i], (twin){to->low.c[i], 0});
        gather(&r[i], (twin){-from->low.c[i], 0});
        r[i] = sum_of(r[i].high, r[i].low);
    }
}

/* How tall a facet must be, to be wide for so much noise of its corners. */
#define TALL(noise) ((noise) * ((real)0x1p-12 / UNIT))

#if DIM == 2
/* Square to the edge, to the right of it. */
static vec outward(const polytope *p, const facet *f, enum form *form)
{
    vec e = reach_over(&p->tip[f->v[0]], &p->tip[f->v[1]]);
    *form = dot(e, e) > TALL(NOISE) * TALL(NOISE) ? WIDE : LEAN;
    return (vec){{e.c[1], -e.c[0]}};
}

/* The normal of the facet to twice the digits, from its corner k. Returns how long edges are that it is made of. */
static real fine_outward(const polytope *p, const facet *f, int k, twin n[2])
{
    twin e[2];
    fine_reach(&p->tip[f->v[0]], &p->tip[f->v[1]], e);
    n[0] = e[1];
    n[1] = (twin){-e[0].high, -e[0].low};
    (void)k;
    return 1; /* it is the edge itself, off by its ends alone */
}
#else
/* The normal of a triangle to twice the digits. Returns how long the edges are that it is made of. */
static real fine_cross(const tip *at, const tip *first, const tip *second, twin n[3])
{
    twin a[3], b[3];
    real edges = 0;
    fine_reach(at, first, a);
    fine_reach(at, second, b);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        twin back = product_of_twins(a[k], b[j]);
        n[i] = product_of_twins(a[j], b[k]);
        gather(&n[i], (twin){-back.high, -back.low});
        n[i] = sum_of(n[i].high, n[i].low);
        edges += size(a[i].high) + size(b[i].high);
    }
    return edges;
}

static real fine_outward(const polytope *p, const facet *f, int k, twin n[3])
{
    return fine_cross(&p->tip[f->v[k]], &p->tip[f->v[(k + 1) % 3]], &p->tip[f->v[(k + 2) % 3]], n);
}

/* From the two shorter edges, which meet in corner k. */
static vec outward(const polytope *p, const facet *f, enum form *form)
{
    vec e[3];
    real square[3];
    int k = 0;
    for (int i = 0; i < 3; i++) {
        e[i] = reach_over(&p->tip[f->v[i]], &p->tip[f->v[(i + 1) % 3]]);
        square[i] = dot(e[i], e[i]);
        k = square[i] > square[k] ? i : k;
    }
    real longest = square[k];
    k = (k + 2) % 3;
    vec a = e[k], b = mul(e[(k + 2) % 3], -1), n = cross(a, b);
    real nn = dot(n, n), size = dot(a, a) * dot(b, b);
    *form = WIDE;
    if (4096 * nn > longest * longest && nn > TALL(NOISE) * TALL(NOISE) * longest) return n;
    if (!(nn > (real)0.25 * size)) { /* a narrow one, which rounded edges leave to noise */
        twin fine[3];
        fine_outward(p, f, k, fine);
        for (int i = 0; i < 3; i++) n.c[i] = fine[i].high;
    }
    int thin = !(dot(n, n) > 64 * UNIT * UNIT * UNIT * size) || !(length(n) > NOISE * root(longest));
    *form = thin ? THIN : LEAN;
    return n;
}

/* The point of the edge that is nearest the origin: inside the edge square to it, to all digits. */
static vec nearest_of_edge(const tip *a, const tip *b)
{
    vec e = reach_over(a, b), near = a->w;
    real square = dot(e, e), t = -dot(a->w, e) / square;
    if (!(t > 0 && t < 1)) return t > 0 ? b->w : a->w;
    near = add(add(near, mul(e, t)), a->low);
    return sub(near, mul(e, dot(near, e) / square));
}

/* A triangle without area to speak of has no normal; the way to its nearest point will do. */
static void straighten(const polytope *p, facet *f)
{
    for (int i = 0; i < 3; i++) {
        vec near = nearest_of_edge(&p->tip[f->v[i]], &p->tip[f->v[(i + 1) % 3]]), n = unit_of(near, near);
        real height = least_height(p, f, n);
        if (i > 0 && !(height > f->height)) continue;
        f->n = n;
        f->height = height;
    }
}
#endif

/* Places the facet by all that is known of its tips. */
static APART void sharpen_facet(polytope *p, facet *f)
{
    enum form form;
    for (int i = 0; i < DIM; i++) sharpen_tip(p, &p->tip[f->v[i]]);
    f->n = unit_of(outward(p, f, &form), p->tip[f->v[0]].w);
    f->form = (signed char)form;
    f->height = least_height(p, f, f->n);
    f->rough = SHARP;
#if DIM == 3
    if (form == THIN) straighten(p, f);
#endif
}

/* Places the facet by what its tips are by rounding, if it is WIDE for that. */
static inline int place_roughly(const polytope *p, facet *f)
{
    const real tall = TALL(ROUGH_NOISE);
    const vec w0 = p->tip[f->v[0]].w, w1 = p->tip[f->v[1]].w;
#if DIM == 2
    vec e = sub(w1, w0), n = {{e.c[1], -e.c[0]}};
    real nn = dot(e, e);
    if (!(nn > tall * tall)) return 0;
    f->n = mul(n, 1 / root(nn));
    f->height = smaller(dot(f->n, w1), dot(f->n, w0));
#else
    const vec w2 = p->tip[f->v[2]].w, e0 = sub(w1, w0), e1 = sub(w2, w1), e2 = sub(w0, w2), n = cross(e0, e1);
    const real longest = larger(dot(e0, e0), larger(dot(e1, e1), dot(e2, e2))), nn = dot(n, n);
    if (!(4096 * nn > longest * longest && nn > tall * tall * longest)) return 0;
    f->n = mul(n, 1 / root(nn));
    f->height = smaller(dot(f->n, w2), smaller(dot(f->n, w1), dot(f->n, w0)));
#endif
    f->form = WIDE;
    f->rough = ROUGH;
    return 1;
}

/* Puts a facet between these tips on the place; what is next to it is told it later. */
static inline void lay_facet(facet *f, const int16_t v[DIM])
{
    EACH(f->v[i] = v[i]);
    f->done = f->gone = 0;
}

/* Takes the facet between these tips in. Returns its height. */
static inline real put_facet(polytope *p, const int16_t v[DIM])
{
    facet *f = &p->facet[p->facets++];
    lay_facet(f, v);
    if (!place_roughly(p, f)) sharpen_facet(p, f);
    return f->height;
}

/* How far t lies beyond a tip along n; 0 where rounding leaves that open. */
static real rise(const polytope *p, int from, const tip *t, vec n)
{
    vec e = reach_over(&p->tip[from], t);
    real r = dot(n, e);
    return size(r) > 4 * UNIT * dot_size(n, e) + NOISE ? r : 0;
}

static int nearest_corner(const polytope *p, const facet *f, const tip *t)
{
    real near = REAL_MAX;
    int k = 0;
    for (int i = 0; i < DIM; i++) {
        real way = spread(reach_over(&p->tip[f->v[i]], t));
        if (!(way < near)) continue;
        near = way;
        k = i;
    }
    return k;
}

/* Whether a and b have the same sum as c and d, seen without rounding: coordinate by coordinate they are the same two
 * numbers. */
static inline int have_one_sum(vec a, vec b, vec c, vec d)
{
    int r = 1;
    EACH(r &= ((a.c[i] == c.c[i]) & (b.c[i] == d.c[i])) | ((a.c[i] == d.c[i]) & (b.c[i] == c.c[i])));
    return r;
}

/* Whether t makes the facet a parallelogram, in whose plane it is then: such are faces of boxes, and what an edge of
 * either body makes of the other's. */
static int is_fourth(const polytope *p, const facet *f, const tip *t)
{
    for (int i = 0; i < DIM && DIM == 3; i++) {
        const tip *a = &p->tip[f->v[i]], *b = &p->tip[f->v[(i + 1) % DIM]], *c = &p->tip[f->v[(i + 2) % DIM]];
        if (have_one_sum(t->x, a->x, b->x, c->x) && have_one_sum(t->y, a->y, b->y, c->y)) return 1;
    }
    return 0;
}

/* How far t lies beyond the facet, or below 0 behind it; 0 where rounding leaves that open. From the nearest corner,
 * where the normal's own roundings count least; a thin facet has no plane, it is below t where all its corners are. */
static real rise_over(polytope *p, facet *f, tip *t)
{
    real above = rough_rise(f, t);
    if (is_clear(f, above)) return above;
    if (f->rough) sharpen_facet(p, f);
    sharpen_tip(p, t);
    if (f->form != THIN) return rise(p, f->v[nearest_corner(p, f, t)], t, f->n);
    real most = -REAL_MAX, least = REAL_MAX;
    for (int i = 0; i < DIM; i++) {
        real here = rise(p, f->v[i], t, f->n);
        least = smaller(here, least);
        most = larger(here, most);
    }
    return least > 0 ? least : most < 0 ? most : 0;
}

static int sees(polytope *p, facet *f, tip *t)
{
    real above = rough_rise(f, t);
    return is_clear(f, above) ? above > 0 : !is_fourth(p, f, t) && rise_over(p, f, t) > 0;
}

/* On which side of the facet's plane t is, to twice the digits: of the sign. */
static real fine_side(const polytope *p, const facet *f, const tip *t)
{
    int k = nearest_corner(p, f, t);
    twin n[DIM], e[DIM], sum = {0, 0};
    real long_edges = fine_outward(p, f, k, n), tall = 0, far = 0;
    fine_reach(&p->tip[f->v[k]], t, e);
    for (int i = 0; i < DIM; i++) {
        gather(&sum, product_of_twins(n[i], e[i]));
        tall += size(n[i].high);
        far += size(e[i].high);
    }
    real side = sum.high + sum.low;
    return size(side) > NOISE * (tall + 4 * far * long_edges) ? side : 0;
}

static seam seam_of(const polytope *p, int at, int i)
{
    const facet *f = &p->facet[at];
    return (seam){{f->v[i], DIM == 2 ? (int16_t)i : f->v[i == DIM - 1 ? 0 : i + 1]}, (int16_t)at, f->next[i]};
}

/* Whether they are the two sides of one. */
static int meet_in(seam a, seam b)
{
    return DIM == 2 ? a.v[0] == b.v[0] && a.v[1] != b.v[1] : a.v[0] == b.v[1] && a.v[1] == b.v[0];
}

/* The other side of s on the rim; where it is not there, the rim's end. Two corners may have more than one edge between
 * them: these are told apart by their facets. */
static int other_side(const polytope *p, seam s)
{
    int k = 0;
    while (k < p->rims && !(p->rim[k].of == s.next && p->rim[k].next == s.of && meet_in(p->rim[k], s))) k++;
    return k;
}

/* Of a t in the facet's plane, whether it is on the same side of the seam as the facet is. */
static int is_on_side(const polytope *p, const facet *f, seam s, const tip *t)
{
#if DIM == 2
    const tip *at = &p->tip[s.v[0]], *end = &p->tip[f->v[f->v[0] == s.v[0]]];
    return dot(way_to(at, end), way_to(at, t)) > 0;
#else
    const tip *from = &p->tip[s.v[1]], *to = &p->tip[s.v[0]];
    return dot(cross(f->n, way_to(from, to)), way_to(from, t)) > 0;
#endif
}

/* On which side of the facet t is, as well as can be told: of the sign. The facet's normal is off by some roundings,
 * which count by how far t is from the nearest corner; of a small facet it is noise to those who know more. */
static real side_of(polytope *p, facet *f, tip *t)
{
    real r = rough_rise(f, t);
    if (is_clear(f, r)) return r;
    if (p->side && f->form != WIDE) return (real)p->side(p->of, f, t); /* its normal may be none */
    if (is_fourth(p, f, t)) return 0;
    r = rise_over(p, f, t);
    if (size(r) > CLEAR) return r;
    vec e = reach_over(&p->tip[f->v[nearest_corner(p, f, t)]], t);
    if (!(size(r) > 16 * UNIT * spread(e))) r = fine_side(p, f, t);
    return r == 0 && p->side ? (real)p->side(p->of, f, t) : r;
}

/* Whether the facet next to the rim goes too: t sees it; or, as far as can be told, is in its plane, and a new facet
 * from the seam to t would lie on it, folded back. */
static inline int goes_too(polytope *p, facet *f, seam s, tip *t)
{
    const real above = rough_rise(f, t);
    if (is_clear(f, above)) return above > 0;
    const real r = side_of(p, f, t);
    return r > 0 || (r == 0 && is_on_side(p, f, s, t));
}

static inline real put_facet_on(polytope *p, seam r, int t)
{
#if DIM == 2
    int16_t v[2] = {r.v[1] ? (int16_t)t : r.v[0], r.v[1] ? r.v[0] : (int16_t)t};
#else
    int16_t v[3] = {r.v[0], r.v[1], (int16_t)t};
#endif
    return put_facet(p, v);
}

#if DIM == 3
/* Puts a facet from that seam to t, placed by its rounded tips, on the place. */
HOT void lay_roughly(facet *f, seam r, int t, vec n, real height)
{
    const int16_t v[3] = {r.v[0], r.v[1], (int16_t)t};
    lay_facet(f, v);
    f->n = n;
    f->height = height;
    f->form = WIDE;
    f->rough = ROUGH;
}

/* Takes facets from two seams to t in, side by side, each as place_roughly has it; or one after the other, if not both
 * are WIDE. Returns how low they are. */
HOT real put_two_on(polytope *p, const seam *r, int t)
{
    const real tall = TALL(ROUGH_NOISE);
    const duos w0 = duos_at(p->tip[r[0].v[0]].w.c, p->tip[r[1].v[0]].w.c);
    const duos w1 = duos_at(p->tip[r[0].v[1]].w.c, p->tip[r[1].v[1]].w.c), w2 = duos_both(p->tip[t].w);
    const duos e0 = duos_sub(w1, w0), e1 = duos_sub(w2, w1), e2 = duos_sub(w0, w2), n = duos_cross(e0, e1);
    const duo longest = duo_larger(duos_dot(e0, e0), duo_larger(duos_dot(e1, e1), duos_dot(e2, e2)));
    const duo nn = duos_dot(n, n);
    if (!are_larger(duo_mul(duo_both(4096), nn), duo_mul(longest, longest)) ||
        !are_larger(nn, duo_mul(duo_both(tall * tall), longest))) {
        const real first = put_facet_on(p, r[0], t);
        return smaller(put_facet_on(p, r[1], t), first);
    }
    const duos unit = duos_mul(n, duo_div(duo_both(1), duo_root(nn)));
    const duo height = duo_smaller(duos_dot(unit, w2), duo_smaller(duos_dot(unit, w1), duos_dot(unit, w0)));
    facet *f = &p->facet[p->facets];
    p->facets += 2;
    lay_roughly(f, r[0], t, vec_of_a(unit), of_a(height));
    lay_roughly(f + 1, r[1], t, vec_of_b(unit), of_b(height));
    return smaller(of_a(height), of_b(height));
}
#endif

/* From so many seams of the rim to t. Returns how low the facets are. */
static inline real put_all_on(polytope *p, int rims, int t)
{
    real least = REAL_MAX;
    int k = 0;
#if DIM == 3
    for (; k + 1 < rims; k += 2) least = smaller(put_two_on(p, &p->rim[k], t), least);
#endif
    for (; k < rims; k++) least = smaller(put_facet_on(p, p->rim[k], t), least);
    return least;
}

/* Which of the facet's seams is the other side of s, if any is: in space the one that starts where s ends. */
static inline int seam_to(const polytope *p, int at, seam s)
{
    const int16_t *v = p->facet[at].v;
    const int later = v[0] != s.v[DIM - 2];
    return DIM == 2 ? later : later + (later & (v[1] != s.v[DIM - 2]));
}

/* Drops the seam at that place of the rim. */
static void drop_seam(polytope *p, int at)
{
    p->rims--;
    for (int k = at; k < p->rims; k++) p->rim[k] = p->rim[k + 1];
}

/* Puts a seam at that place of the rim, before what is there. */
static inline void put_seam(polytope *p, int at, seam s)
{
    for (int k = p->rims; k > at; k--) p->rim[k] = p->rim[k - 1];
    p->rim[at] = s;
    p->rims++;
}

/* Takes out the facet across the seam at that place of the rim, which its other seams take; but for those that were on
 * the rim, which it has in common with others that are out. So the rim goes around what is out, each seam after the one
 * that ends where it starts, as long as that has no holes. Returns the place. */
static int take_out(polytope *p, int at)
{
    const seam s = p->rim[at];
    const int i = seam_to(p, s.next, s);
    int put = 0;
    p->facet[s.next].gone = 1;
    for (int k = DIM - 1; k > 0; k--) {
        seam r = seam_of(p, s.next, i + k < DIM ? i + k : i + k - DIM);
        int other = p->rims;
        if (r.next != WALL && p->facet[r.next].gone) other = other_side(p, r);
        if (other < p->rims) {
            drop_seam(p, other);
            at -= other < at;
        } else if (put++) {
            put_seam(p, at, r);
        } else {
            p->rim[at] = r;
        }
    }
    if (!put) drop_seam(p, at);
    return at;
}

/* Marks what t takes the place of: the facet, and around it all that go too. Returns how many. Their rim is what new
 * facets start from: each facet after the first adds one seam to it at most, so that there is room. */
static int clear_way(polytope *p, int from, tip *t)
{
    int looked = 0, outs = 1;
    p->facet[from].gone = 1;
    for (p->rims = 0; p->rims < DIM; p->rims++) p->rim[p->rims] = seam_of(p, from, p->rims);
    while (looked < p->rims && p->rims + DIM <= p->most_facets) {
        seam s = p->rim[looked];
        if (s.next != WALL && !p->facet[s.next].gone && goes_too(p, &p->facet[s.next], s, t)) {
            looked = take_out(p, looked);
            outs++;
        } else {
            looked++;
        }
    }
    return outs;
}

/* The facet across seam i is to know this one by its place. */
static void tell_next(polytope *p, int at, int i)
{
    seam s = seam_of(p, at, i);
    if (s.next != WALL) p->facet[s.next].next[seam_to(p, s.next, s)] = (int16_t)at;
}

/* A facet that was put on the rim takes the place there of the one that is gone. */
static inline void tie_to_rim(polytope *p, int at, seam r)
{
    p->facet[at].next[DIM == 2 ? r.v[1] : 0] = r.next;
    if (r.next != WALL) p->facet[r.next].next[seam_to(p, r.next, r)] = (int16_t)at;
}

/* The seams of a facet put on r that end at the new tip: one that leads there, and one that leads from there. */
static int seam_there(seam r) { return DIM == 2 ? 1 - r.v[1] : 1; }
static int seam_back(seam r) { return DIM == 2 ? 1 - r.v[1] : 2; }

/* Whether the facet put on r has the one put on the other next to it, along the seam there. */
static int comes_before(seam r, seam other) { return DIM == 2 ? r.v[1] == 0 && other.v[1] == 1 : other.v[0] == r.v[1]; }

/* Joins the facet there to the one that comes before it. */
static inline void join_to(polytope *p, int at, int before)
{
    p->facet[before].next[1] = (int16_t)at;
    p->facet[at].next[DIM - 1] = (int16_t)before;
}

/* Joins the facets that were put on the rim: it goes around, once or more often, so each has one before it and one
 * after it. Where tips are passed more often than once any pairing will do. */
static APART void join_all(polytope *p)
{
    const int rims = p->rims;
    for (int k = 0; k < rims; k++) {
        const seam r = p->rim[k];
        p->facet[r.of].next[seam_there(r)] = p->facet[r.of].next[seam_back(r)] = ALONE;
    }
    for (int a = 0; a < rims; a++)
        for (int n = 0, b = a; n < rims; n++) {
            b = b + 1 < rims ? b + 1 : 0;
            const seam *from = &p->rim[a], *to = &p->rim[b];
            if (!comes_before(*from, *to)) continue;
            int16_t *next = &p->facet[from->of].next[seam_there(*from)], *back = &p->facet[to->of].next[seam_back(*to)];
            if (*back != ALONE) continue;
            *next = to->of;
            *back = from->of;
            break;
        }
}

/* Drops the facets that are marked; the last ones move to their places. */
static void sweep(polytope *p)
{
    for (int k = 0; k < p->facets; k++) {
        while (p->facets > k && p->facet[p->facets - 1].gone) p->facets--;
        if (k >= p->facets || !p->facet[k].gone) continue;
        p->facet[k] = p->facet[--p->facets];
        for (int i = 0; i < DIM; i++) tell_next(p, k, i);
    }
}

/* The facets on the rim, which are the last so far, take the places of those that are gone, so many, and are tied in.
 * Seams of the rim know them from then on. As a rule each seam of it ends where the next one starts, all around. */
static void settle_in(polytope *p, int before, int outs)
{
    const int rims = p->rims;
    seam last = p->rim[rims - 1];
    int end = before, left = outs, ring = DIM == 3, place = WALL;
    for (int k = 0; k < rims; k++) {
        const seam r = p->rim[k];
        const int gone = p->facet[r.of].gone, at = gone ? r.of : end;
        left -= gone;
        end += !gone;
        p->facet[at] = p->facet[before + k];
        tie_to_rim(p, at, r);
        p->rim[k].of = (int16_t)at;
        ring &= comes_before(last, r);
        if (DIM == 3 && k > 0) join_to(p, at, place);
        last = r;
        place = at;
    }
    p->facets = end;
    if (ring) join_to(p, p->rim[0].of, place);
    else join_all(p);
    if (left > 0) sweep(p); /* no seam of those was on the rim */
}

/* Places the facets from there on by all that is known. Returns how low they are. */
static real sharpen_new(polytope *p, int from)
{
    real least = REAL_MAX;
    for (int k = from; k < p->facets; k++) {
        if (p->facet[k].rough) sharpen_facet(p, &p->facet[k]);
        least = smaller(p->facet[k].height, least);
    }
    return least;
}

enum growth { GROWN, FULL, LOWERED };

/* Takes in a corner that lies beyond the facet, the lowest. FULL: there is no room for it. LOWERED: a surface that goes
 * around the origin never gets lower by what lies beyond it, so this is noise. Either way nothing has changed. */
static enum growth grow(polytope *p, facet *f, tip *t)
{
    int before = p->facets;
    const real height = f->height;
    if (p->tips == p->most_tips || before + 2 > p->most_facets) return FULL;
    int outs = clear_way(p, (int)(f - p->facet), t);
    enum growth end = p->rims == 0 ? LOWERED : before + p->rims > p->most_facets ? FULL : GROWN;
    const int rims = end == GROWN ? p->rims : 0, at = p->tips;
    p->tip[at] = *t;
    const real least = put_all_on(p, rims, at);
    if (end == GROWN && !p->without_rounding && height > 0 && !(least >= height - 64 * UNIT) &&
        !(sharpen_new(p, before) >= height - 64 * UNIT))
        end = LOWERED;
    if (end != GROWN) {
        p->facets = before;
        for (int k = 0; k < p->facets; k++) p->facet[k].gone = 0;
        return end;
    }
    p->tips++;
    settle_in(p, before, outs);
    return GROWN;
}

/* The first of the lowest. */
static facet *lowest(const polytope *p)
{
    facet *f = p->facet;
    real least = f->height;
    for (int k = 1; k < p->facets; k++) least = smaller(p->facet[k].height, least);
    while (f->height > least) f++;
    return f;
}

/* Those that are not marked have a wall where they met one that is. */
static void wall_off(polytope *p)
{
    for (int k = 0; k < p->facets; k++)
        for (int i = 0; i < DIM; i++) {
            int16_t *next = &p->facet[k].next[i];
            if (*next != WALL && p->facet[*next].gone) *next = WALL;
        }
}

/* Marks the facets above some height that have no corner in common with one below, nor with the lowest. */
static void mark_above(polytope *p, real height)
{
    seam *near = p->rim; /* there is a seam for each tip */
    const facet *low = lowest(p);
    for (int i = 0; i < p->tips; i++) near[i].v[0] = 0;
    for (int i = 0; i < DIM; i++) near[low->v[i]].v[0] = 1;
    for (int k = 0; k < p->facets; k++)
        for (int i = 0; i < DIM && !(p->facet[k].height >= height); i++) near[p->facet[k].v[i]].v[0] = 1;
    for (int k = 0; k < p->facets; k++) {
        facet *f = &p->facet[k];
        f->gone = 1;
        for (int i = 0; i < DIM; i++) f->gone &= !near[f->v[i]].v[0];
    }
    wall_off(p);
}

/* Marks the facets that look farther aside from n than half as far as they do on the average, beyond the one that does
 * least; but not the lowest. */
static void mark_aside(polytope *p, vec n)
{
    real mean = 0, most = -1;
    for (int k = 0; k < p->facets; k++) {
        const real along = dot(p->facet[k].n, n);
        mean += along / (real)p->facets;
        most = larger(along, most);
    }
    for (int k = 0; k < p->facets; k++) p->facet[k].gone = dot(p->facet[k].n, n) < (mean + most) / 2;
    lowest(p)->gone = 0;
    wall_off(p);
}

/* Drops the tips that no facet has. */
static void forget_tips(polytope *p)
{
    seam *place = p->rim;
    int kept = 0;
    for (int i = 0; i < p->tips; i++) place[i].v[0] = -1;
    for (int k = 0; k < p->facets; k++)
        for (int i = 0; i < DIM; i++) place[p->facet[k].v[i]].v[0] = 0;
    for (int i = 0; i < p->tips; i++) {
        if (place[i].v[0] < 0) continue;
        p->tip[kept] = p->tip[i];
        place[i].v[0] = (int16_t)kept++;
    }
    p->tips = kept;
    for (int k = 0; k < p->facets; k++)
        for (int i = 0; i < DIM; i++) p->facet[k].v[i] = place[p->facet[k].v[i]].v[0];
}

/* Whether the first DIM + 1 tips turn counterclockwise, as they are rounded. */
static int turn_roughly(const polytope *p)
{
    const vec a = way_to(&p->tip[0], &p->tip[1]), b = way_to(&p->tip[0], &p->tip[2]);
#if DIM == 2
    return !(a.c[0] * b.c[1] - a.c[1] * b.c[0] < 0);
#else
    return !(dot(cross(a, b), way_to(&p->tip[0], &p->tip[3])) < 0);
#endif
}

/* Puts their surface, outward if they turn so: its facets, and those across their seams. */
static void put_sides(polytope *p, int turn)
{
#if DIM == 2
    static const int16_t side[2][3][2] = {{{1, 0}, {2, 1}, {0, 2}}, {{0, 1}, {1, 2}, {2, 0}}};
    static const int16_t across[2][3][2] = {{{1, 2}, {2, 0}, {0, 1}}, {{2, 1}, {0, 2}, {1, 0}}};
    p->facets = 0;
    for (int k = 0; k < 3; k++) put_facet(p, side[turn][k]);
#else
    static const int16_t side[2][4][3] = {{{1, 2, 0}, {3, 1, 0}, {3, 0, 2}, {1, 3, 2}},
                                          {{2, 1, 0}, {1, 3, 0}, {0, 3, 2}, {3, 1, 2}}};
    static const int16_t across[2][4][3] = {{{3, 2, 1}, {3, 0, 2}, {1, 0, 3}, {1, 2, 0}},
                                            {{3, 1, 2}, {3, 2, 0}, {1, 3, 0}, {1, 0, 2}}};
    p->facets = 0;
    for (int k = 0; k < 4; k += 2) {
        const int16_t *v = side[turn][k], *u = side[turn][k + 1];
        const seam two[2] = {{{v[0], v[1]}, 0, 0}, {{u[0], u[1]}, 0, 0}};
        put_two_on(p, two, v[2]);
    }
#endif
    for (int k = 0; k <= DIM; k++) EACH(p->facet[k].next[i] = across[turn][k][i]);
}

/* That surface, turned so that the last of the tips is not beyond the first facet. */
static void put_first(polytope *p)
{
    const int turn = turn_roughly(p);
    put_sides(p, turn);
    if (side_of(p, &p->facet[0], &p->tip[DIM]) > 0) put_sides(p, !turn);
}

#endif
