/* SPDX-License-Identifier: MIT */
/* Float only: where its roundings leave more doubt about a smooth shape than the caller asked for, the question is put
 * to the sister in double. Hulls of known corners have no need of it (tight.h), callbacks of the caller's own speak
 * only float. With GJK_ALONE a float variant does without: it then needs no other translation unit, and no double. */
#ifndef GJK_CORE_WIDEN_H
#define GJK_CORE_WIDEN_H

#include "distance.h"
#include "polytope.h"
#include "round.h"
#include "shapes.h"

/* Of the sister in double, for float alone: as penetration, but a depth may be open by a quarter of float's roundoff,
 * which float does not show. How far apart is told as ever, and so as distance tells it. */
#if REAL_IS_DOUBLE
int pub(penetration_for_float)(const shape *a, const shape *b, const options *given, result *out);
#endif

#if REAL_IS_DOUBLE || defined(GJK_ALONE)
#define HAS_SISTER 0

static enum end ask_sister(search *q, const shape *a, const shape *b, const options *o, const goal *g, result *r)
{
    (void)q, (void)a, (void)b, (void)o, (void)g, (void)r;
    return FAULT;
}

static int ask_sister_alone(search *q, const shape *a, const shape *b, const options *o, const goal *g, result *r)
{
    (void)q, (void)a, (void)b, (void)o, (void)g, (void)r;
    return 0;
}

static int ask_sister_first(search *q, const shape *a, const shape *b, const options *o, const goal *g, enum end *end,
                            result *r)
{
    (void)q, (void)a, (void)b, (void)o, (void)g, (void)end, (void)r;
    return 0;
}

#else
#define HAS_SISTER 1

#if DIM == 2
#include "../../include/gjk/gjk2.h"
#else
#include "../../include/gjk/gjk3.h"
#endif

int sister(penetration_for_float)(const sister(shape) * a, const sister(shape) * b, const sister(options) * given,
                                  sister(result) * out);

typedef struct widened {
    sister(shape) shape;
    sister(pose) pose;
    double numbers[3 * DIM]; /* what the support's data are made of */
} widened;

static double widened_points(const void *data, const double dir[DIM], double point[DIM])
{
    const points *p = data;
    double highest = 0;
    size_t best = 0;
    for (size_t n = 0; n < p->count; n++) {
        vec x = load(p->v + n * stride_of(p));
        double height = 0;
        for (int i = 0; i < DIM; i++) height += (double)x.c[i] * dir[i];
        if (n > 0 && !(height > highest)) continue;
        highest = height;
        best = n;
    }
    for (int i = 0; i < DIM; i++) point[i] = (double)p->v[best * stride_of(p) + (size_t)i];
    return (double)p->reach;
}

/* The data of every ready-made support but points are so many numbers and nothing else. */
static int take_numbers(widened *w, const shape *s, sister(support_fn) * support, int n)
{
    const real *from = s->data;
    for (int i = 0; i < n; i++) w->numbers[i] = (double)from[i];
    w->shape.support = support;
    w->shape.data = w->numbers;
    return 1;
}

#define KIN(name, n)                                                                                                   \
    if (s->support == pub(name)) return take_numbers(w, s, sister(name), n)

/* One point, or two: a segment of hers, whose corners she knows, where callbacks leave contact open. 0: they are not
 * within the reach that is told, which a segment of hers does not ask. */
static int take_ends(widened *w, const points *p)
{
    const real *end[2] = {p->v, p->v + (p->count - 1) * stride_of(p)};
    const double reach = (double)p->reach * (1 + 16 * (double)UNIT);
    for (int k = 0; k < 2; k++) {
        double square = 0;
        for (int i = 0; i < DIM; i++) square += (double)end[k][i] * (double)end[k][i];
        if (p->reach > 0 && !(square <= reach * reach)) return 0;
        for (int i = 0; i < DIM; i++) w->numbers[DIM * k + i] = (double)end[k][i];
    }
    w->shape.support = sister(support_segment);
    w->shape.data = w->numbers;
    return 1;
}

/* The set in double. 0: it is nothing ready-made, or there is none. */
static int widen_set(widened *w, const shape *s)
{
    KIN(support_origin, 0);
    if (!s->data) return 0;
    KIN(support_segment, 2 * DIM);
    KIN(support_box, DIM);
    KIN(support_ball, 1);
    KIN(support_ellipsoid, DIM);
#if DIM == 3
    KIN(support_triangle, 3 * DIM);
    KIN(support_cylinder, 2);
    KIN(support_cone, 2);
    KIN(support_disc, 1);
#endif
    if (s->support != pub(support_points) || !cloud(s->data)) return 0;
    if (((const points *)s->data)->count <= 2) return take_ends(w, s->data);
    w->shape.support = widened_points;
    w->shape.data = s->data;
    return 1;
}

static int widen(widened *w, const shape *s)
{
    for (int i = 0; i < DIM * DIM && s->pose; i++) w->pose.m[i] = (double)s->pose->m[i];
    for (int i = 0; i < DIM && s->pose; i++) w->pose.p[i] = (double)s->pose->p[i];
    w->shape.pose = s->pose ? &w->pose : NULL;
    w->shape.radius = (double)s->radius;
    return widen_set(w, s);
}

/* Hulls of so few corners are widened with these. */
#define WIDENED_MOST 64

typedef struct widened_hull {
    widened body;
    sister(points) points;
    double corners[WIDENED_MOST * DIM];
} widened_hull;

static int widen_hull(widened_hull *w, const shape *s)
{
    const points *p = s->data;
    if (!widen(&w->body, s)) return 0;
    if (w->body.shape.support != widened_points) return 1;
    if (p->count > WIDENED_MOST || !(p->reach > 0)) return 0;
    const size_t step = stride_of(p);
    for (size_t n = 0; n < p->count; n++)
        for (size_t i = 0; i < DIM; i++) w->corners[DIM * n + i] = (double)p->v[n * step + i];
    w->points = (sister(points)){.v = w->corners, .count = p->count, .reach = (double)p->reach};
    w->body.shape.support = sister(support_points);
    w->body.shape.data = &w->points;
    return 1;
}

static real rounded_down(double x)
{
    real r = (real)x;
    return (double)r > x ? lower_neighbour(r) : r;
}

/* A coordinate may lie beyond all floats. */
static real rounded_to_range(double x)
{
    double most = (double)REAL_MAX;
    return (real)(x > most ? most : x < -most ? -most : x);
}

/* Somewhat tighter than was asked for, since the bounds are rounded once more, with no more digits than float can show,
 * unless all of them cost no more. Of the sign there are none, and known corners are told as well as they can be. */
static sister(options) sister_options(const options *o, const search *q, const goal *g, int all)
{
    sister(options) r = {.size = sizeof r, .max_steps = o->max_steps - (uint32_t)q->steps};
    r.slack = (double)o->slack;
    if (g->sign_only || g->exact) return r;
    r.abs_tol = (double)o->abs_tol / 2;
    r.rel_tol = (double)(o->rel_tol - smaller(o->rel_tol / 2, 16 * UNIT));
    if (!all) r.rel_tol = r.rel_tol > (double)UNIT / 4 ? r.rel_tol : (double)UNIT / 4;
    r.cutoff = (double)o->cutoff * (1 + 4 * (double)UNIT);
    return r;
}

/* Her bracket instead of r's, where it is the narrower one; with the normal and the points that belong to it. */
static void take_all(result *r, const sister(result) * hers, real lower, real upper)
{
    if (!(upper - lower < r->upper - r->lower)) return;
    r->lower = lower;
    r->value = (real)hers->value;
    r->upper = upper;
    for (int i = 0; i < DIM; i++) {
        r->normal[i] = (real)hers->normal[i];
        r->point_a[i] = rounded_to_range(hers->point_a[i]);
        r->point_b[i] = rounded_to_range(hers->point_b[i]);
    }
}

/* r's bracket narrowed by hers; her value and points stand in it. */
static void take_better(result *r, const sister(result) * hers, real lower, real upper)
{
    r->value = (real)hers->value;
    if (lower > r->lower) {
        r->lower = lower;
        for (int i = 0; i < DIM; i++) r->normal[i] = (real)hers->normal[i];
    }
    if (upper < r->upper) {
        r->upper = upper;
        for (int i = 0; i < DIM; i++) r->point_a[i] = rounded_to_range(hers->point_a[i]);
        for (int i = 0; i < DIM; i++) r->point_b[i] = rounded_to_range(hers->point_b[i]);
    }
}

static int ask_of_wide(const sister(shape) * a, const sister(shape) * b, const sister(options) * asked, const goal *g,
                       sister(result) * hers)
{
#if DEPTHS
    if (g->deep) return sister(penetration_for_float)(a, b, asked, hers);
#endif
    return (g->sign_only ? sister(intersect) : sister(distance))(a, b, asked, hers);
}

/* Puts the question to the sister. Her status; below 0: she can't be asked or has no answer. */
static APART int hear_sister(const search *q, const shape *a, const shape *b, const options *o, const goal *g,
                             sister(result) * hers)
{
    widened wide_a, wide_b;
    sister(options) asked = sister_options(o, q, g, have_heights(a, b));
    if (q->steps >= g->max_steps || !widen(&wide_a, a) || !widen(&wide_b, b)) return GJK_BAD_ARGUMENT;
    return ask_of_wide(&wide_a.shape, &wide_b.shape, &asked, g, hers);
}

/* And takes what is better of her answer; her steps and calls are counted. FAULT: there is none, and nothing is
 * changed. */
static enum end ask_sister(search *q, const shape *a, const shape *b, const options *o, const goal *g, result *r)
{
    sister(result) hers;
    int status = hear_sister(q, a, b, o, g, &hers);
    if (status < 0) return FAULT;
    real lower = rounded_down(hers.lower), upper = -rounded_down(-hers.upper);
    if (g->deep) take_all(r, &hers, lower, upper); /* overlapping, there may be several ways out */
    else take_better(r, &hers, lower, upper);
    q->steps += hers.steps;
    q->d.calls += hers.supports;
    return status == GJK_LIMIT ? OPEN : STILL;
}

/* Whether she knows enough to go without float's own: of more than the sign, about as many digits as float has. */
static int is_final(const sister(result) * hers, const goal *g)
{
    return g->sign_only || hers->upper - hers->lower <= 8 * (double)UNIT * hers->upper;
}

/* All of the answer is hers. 0: float can't spell it. */
static int take_over_all(result *r, const sister(result) * hers)
{
    const real lower = rounded_down(hers->lower), upper = -rounded_down(-hers->upper);
    if (!(lower > -REAL_MAX && upper < REAL_MAX)) return 0;
    r->lower = -REAL_MAX;
    r->upper = REAL_MAX;
    take_better(r, hers, lower, upper);
    r->steps = hers->steps;
    r->supports = hers->supports;
    r->reserved = 0;
    return 1;
}

/* The same, if that is her status. 0: it is not final, either. */
static int take_alone(result *r, const sister(result) * hers, int status, const goal *g)
{
    return status >= 0 && status != GJK_LIMIT && is_final(hers, g) && take_over_all(r, hers);
}

/* The same of boxes, or what a formula tells, where so near to contact float can't: what she sees at a glance costs
 * less than a walk. */
static APART int ask_sister_alone(search *q, const shape *a, const shape *b, const options *o, const goal *g, result *r)
{
    sister(result) hers;
    const int steps = q->steps;
    q->steps = 0;
    const int status = hear_sister(q, a, b, o, g, &hers);
    q->steps = steps;
    return take_alone(r, &hers, status, g);
}

/* For a polytope of hers the caller's workspace, where there is room in it for more than she has of her own: as much as
 * so many corners of float's take, wherever it lies. */
static void lend_room(sister(options) * asked, const options *o)
{
#if DEPTHS
    if (!o->workspace) return;
    const size_t bytes = bytes_for(tips_in(o->workspace_bytes)) - sizeof(real);
    const size_t skew = (uintptr_t)o->workspace % sizeof(double);
    if (bytes < sister(workspace_size)(USUAL_TIPS + 1)) return;
    asked->workspace = (char *)o->workspace + skew;
    asked->workspace_bytes = (uint32_t)bytes;
#else
    (void)asked, (void)o;
#endif
}

/* Smooth bodies, of which float leaves more doubt than is asked as a rule: all of the answer is hers, however far she
 * came. BEYOND: so far as rounding let her, or the cutoff. 0: she can't be asked, or has no answer that float can
 * spell. */
static APART int ask_sister_first(search *q, const shape *a, const shape *b, const options *o, const goal *g,
                                  enum end *end, result *r)
{
    sister(result) hers;
    widened_hull wide_a, wide_b;
    q->steps = 0;
    if (!sound(a) || !sound(b) || !widen_hull(&wide_a, a) || !widen_hull(&wide_b, b)) return 0;
    sister(options) asked = sister_options(o, q, g, have_heights(a, b));
    if (g->deep) lend_room(&asked, o);
    const int status = ask_of_wide(&wide_a.body.shape, &wide_b.body.shape, &asked, g, &hers);
    *end = status == GJK_OK ? STILL : status == GJK_LIMIT ? OPEN : BEYOND;
    return status >= 0 && take_over_all(r, &hers);
}

#endif

/* ---- near contact ---- */

#if !HAS_SISTER || DIM == 2 /* in the plane flat.h is in double anyway */
static int ask_sister_near(const search *q, const shape *a, const shape *b, const options *o, const goal *g, result *r)
{
    (void)q, (void)a, (void)b, (void)o, (void)g, (void)r;
    return 0;
}

#else

/* What she starts from: the simplex that float's search has led to. */
static void lend_simplex(sister(cache) * k, const search *q, const sister(shape) * a, const sister(shape) * b)
{
    *k = (sister(cache)){.reach_a = (double)q->d.a.reach,
                         .reach_b = (double)q->d.b.reach,
                         .support = {a->support, b->support},
                         .data = {a->data, b->data},
                         .count = (uint32_t)q->s.n};
    for (int i = 0; i < q->s.n; i++) {
        const vertex *p = corner(&q->s, i);
        for (int j = 0; j < DIM; j++) {
            k->a[i][j] = (double)p->x.c[j];
            k->b[i][j] = (double)p->y.c[j];
        }
    }
}

/* The same of hulls so near to contact that float's search comes to no end of its own, from where that stands on:
 * whether they meet, or how far apart they are, if they are. */
static APART int ask_sister_near(const search *q, const shape *a, const shape *b, const options *o, const goal *g,
                                 result *r)
{
    sister(result) hers;
    sister(cache) k;
    widened_hull wide_a, wide_b;
    if (q->steps >= g->max_steps || !widen_hull(&wide_a, a) || !widen_hull(&wide_b, b)) return 0;
    const sister(shape) *of_a = &wide_a.body.shape, *of_b = &wide_b.body.shape;
    sister(options) asked = sister_options(o, q, g, 0);
    lend_simplex(&k, q, of_a, of_b);
    asked.cache = &k;
    const int status =
        g->sign_only ? sister(intersect)(of_a, of_b, &asked, &hers) : sister(distance)(of_a, of_b, &asked, &hers);
    if (!take_alone(r, &hers, status, g) || !(r->lower > 0 || (!g->deep && r->upper <= 0))) return 0;
    r->steps += q->steps;
    r->supports += q->d.calls;
    return 1;
}
#endif

#endif
