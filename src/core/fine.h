/* SPDX-License-Identifier: MIT */
/* Cores that are known by their corners, and apart by so little that rounded corners hardly tell: v worked out anew,
 * the height of the lowest corners along it and the length of the pair that goes with it, all to twice the digits. The
 * bounds prove themselves, however v was come by; where they do not tell enough, the exact finish does. */
#ifndef GJK_CORE_FINE_H
#define GJK_CORE_FINE_H

#include "answer.h"
#include "contact.h"

/* A corner that v has not met yet is taken in so often. */
#define FINE_ROUNDS 4

/* How far from their bodies' own positions the simplex's points lie: no more than the bodies' size, which may be far
 * below the frame's where points far out are mapped near. */
static real size_of_points(const search *q)
{
    real r = 0;
    for (int i = 0; i < q->s.n; i++) {
        const vertex *p = corner(&q->s, i);
        r = larger(peak(place(&q->d.a, p->x)), larger(peak(place(&q->d.b, p->y)), r));
    }
    return r;
}

/* They tell the sign, the radii taken off; and where the distance is wanted, that to two roundings of the bodies. */
static int is_fine(const search *q, const goal *g, real lower, real upper)
{
    real near = g->radius * q->d.scale;
    int told = lower > near + 4 * UNIT * near || (lower > 0 && upper < near - 4 * UNIT * near);
    return told && (g->sign_only || upper - lower <= 2 * UNIT * smaller(size_of_points(q), 1));
}

/* The corner in that slot to twice the digits: w rounded once, and what that takes away. */
static void polish(search *q, int slot, vec low[DIM + 1])
{
    vertex *p = &q->s.slot[slot];
    vec lost = lost_of(q, p);
    for (int i = 0; i < DIM; i++) {
        twin t = sum_of(p->w.c[i], lost.c[i]);
        p->w.c[i] = t.high;
        low[slot].c[i] = t.low;
    }
}

/* Puts a corner that was found, not asked for, where the next one goes. */
static void put_spare(search *q, const vertex *c, vec low[DIM + 1])
{
    q->borrowed &= ~(1u << q->s.at[q->s.n]);
    *spare(&q->s) = *c;
    spare(&q->s)->w = corner_of(&q->d, c->x, c->y);
    polish(q, q->s.at[q->s.n], low);
}

static void count_step(search *q)
{
    q->steps++;
    q->d.calls += 2;
}

/* Takes in a corner farther along the way than the simplex. 0: it is none, or v comes no nearer by it. */
static int take_corner(search *q, const vertex *c, vec low[DIM + 1])
{
    for (int i = 0; i < q->s.n; i++)
        if (repeats(corner(&q->s, i), c)) return 0;
    put_spare(q, c, low);
    count_step(q);
    return advance(q) && q->s.n <= DIM && !vanished(q);
}

/* Goes on from the corners as they are now, and with c. 0: nothing comes of it. */
static int come_nearer(search *q, const goal *g, const vertex *c, vec low[DIM + 1], int anew)
{
    int before = q->s.n;
    if (anew) project(q, 1);
    int taken = q->steps < g->max_steps && take_corner(q, c, low);
    return taken || q->s.n < before;
}

static vec low_of(const search *q, const vec low[DIM + 1], int i) { return low[q->s.at[i]]; }

/* The point of A - B that the weights single out, to twice the digits: the heaviest corner, and shares of the ways from
 * there. It is in A - B: the shares add up to no more than 3/4, as none is above that of the corner they start from. */
static vec fine_point(const search *q, const vec low[DIM + 1], const real weight[DIM + 1], vec *rest)
{
    int from = 0;
    for (int k = 1; k < q->s.n; k++) from = weight[k] > weight[from] ? k : from;
    vec r, at = point(&q->s, from), at_low = low_of(q, low, from);
    for (int i = 0; i < DIM; i++) {
        twin t = {at.c[i], at_low.c[i]};
        for (int k = 0; k < q->s.n; k++) {
            if (k == from) continue;
            twin e = sum_of(point(&q->s, k).c[i], -at.c[i]);
            gather(&t, product_of(weight[k], e.high));
            t.low += weight[k] * (e.low + (low_of(q, low, k).c[i] - at_low.c[i]));
        }
        t = sum_of(t.high, t.low);
        r.c[i] = t.high;
        rest->c[i] = t.low;
    }
    return r;
}

/* v made square to the simplex, with edges that rounding took nothing from: of a point that is known to twice the
 * digits as good as it can be spelled. */
static vec square_to_edges(const search *q, const vec low[DIM + 1], vec v)
{
    simplex edges = q->s;
    if (q->s.n == 1) return v;
    for (int i = 1; i < q->s.n; i++)
        edges.slot[q->s.at[i]].w =
            add(sub(point(&q->s, i), point(&q->s, 0)), sub(low_of(q, low, i), low_of(q, low, 0)));
    edges.slot[q->s.at[0]].w = axis(0, 0);
    return square_to(&edges, v);
}

/* The nearest point is well inside the simplex, so that no corner is in it by rounding alone, which would turn v: the
 * weights, less what the pair lies off v by. */
static int is_inside(const search *q, const real weight[DIM + 1], vec off)
{
    real extra[DIM + 1];
    int r = 1;
    if (q->s.n == 1) return 1;
    change(&q->s, off, extra);
    for (int i = 0; i < q->s.n; i++) r &= weight[i] - extra[i] > 256 * UNIT;
    return r;
}

/* The simplex holds the origin for certain: the cores meet. */
static void note_meeting(search *q, real *upper)
{
    q->pending = 0;
    q->met = q->fine = 1;
    q->apart = (twin){0, 0};
    *upper = smaller(*upper, 0);
}

/* Whether a facet and the corner that lies beyond the origin as seen from there hold it. */
static int settle_beyond(search *q, const vertex *c, vec low[DIM + 1], real weight[DIM + 1], real *upper)
{
    simplex *s = &q->s;
    spans w[DIM + 1];
    put_spare(q, c, low);
    s->n++;
    for (int k = 0; k <= DIM; k++) {
        vec high = point(s, k), rest = low_of(q, low, k);
        for (int i = 0; i < DIM; i++) w[k].c[i] = (span){high.c[i], rest.c[i], 256 * UNIT * UNIT};
    }
    if (!is_carried(s, w, weight)) {
        s->n--;
        return 0;
    }
    count_step(q);
    note_meeting(q, upper);
    return 1;
}

/* Bounds the cores' separation from both sides. 0: that does not tell enough; the bounds of q and upper are as they
 * were, its simplex and the weights still are those of corners. */
static APART int settle_apart(search *q, const shape *a, const shape *b, const goal *g, real weight[DIM + 1],
                              real *upper)
{
    if ((vanished(q) || q->s.n > DIM) && holds_origin(q, a, b, weight)) {
        note_meeting(q, upper);
        return 1;
    }
    vec low[DIM + 1];
    for (int i = 0; i < q->s.n; i++) polish(q, q->s.at[i], low);
    for (int i = 0; i < FINE_ROUNDS && q->s.n <= DIM; i++) {
        depth d = {.q = q, .a = a, .b = b, .g = g};
        vertex c;
        vec rest, w = fine_point(q, low, weight, &rest), v = square_to_edges(q, low, add(w, rest));
        if (!(dot(v, v) > UNIT * UNIT * UNIT * UNIT)) return 0;
        vec n = mul(v, -1 / length(v));
        real lower = fine_bound(&d, n, &c), high = fine_length(w, rest);
        if (is_fine(q, g, lower, high) && (g->sign_only || is_inside(q, weight, sub(add(w, rest), v)))) {
            q->lower = lower;
            q->normal = n;
            q->fine = 1;
            if (!g->sign_only) q->apart = height_to_twice(v, w, rest);
            *upper = smaller(*upper, high);
            return 1;
        }
        int may_hold = q->s.n == DIM && lower < 0 && q->steps < g->max_steps;
        if (may_hold && settle_beyond(q, &c, low, weight, upper)) return 1;
        int nearer = come_nearer(q, g, &c, low, i == 0);
        certify(q, weight);
        if (!nearer) return 0;
    }
    return 0;
}

/* ---- where the everyday walk ends so near to contact that rounded corners hardly tell ---- */

/* A vector to twice the digits. */
typedef struct vec_twin {
    vec high, low;
} vec_twin;

/* What is seen from one set to the other. */
typedef struct sight {
    vec_twin way; /* from B to A: of the difference the point that the weights single out */
    vec x, y;     /* the sets' points there, rounded, times their grain */
    vec_twin edge_a[DIM + 1], edge_b[DIM + 1]; /* from the simplex's first corner to the others, of each body */
    real rise_a[DIM + 1], rise_b[DIM + 1];     /* how far up the way these lead */
    real moved;                                /* by how much the weights were changed */
    real turned;                               /* how far the way was turned last */
    real weight[DIM + 1];
} sight;

/* The body's own vector x + low, times its grain, in the frame. Edges of boxes are along an axis. */
static vec_twin place_to_twice(const body *k, vec x, vec low)
{
    vec_twin r = {x, low};
    twin sum[DIM];
    if (!k->posed) return r;
    for (int row = 0; row < DIM; row++) sum[row] = (twin){0, dot(load(k->m + DIM * row), low)};
    for (int j = 0; j < DIM; j++) {
        halves h = halves_of(x.c[j]);
        if (x.c[j] == 0) continue;
        EACH(gather(&sum[i], product_of_halves(k->m[DIM * i + j], halves_of(k->m[DIM * i + j]), x.c[j], h)));
    }
    EACH(r.high.c[i] = sum[i].high; r.low.c[i] = sum[i].low);
    return r;
}

/* The way between the body's corners x and y, in the frame. */
static vec_twin edge_between(const body *k, vec x, vec y)
{
    vec_twin r = {axis(0, 0), axis(0, 0)};
    if (same(x, y)) return r;
    for (int i = 0; i < DIM; i++) {
        twin e = sum_of(y.c[i] * k->grain, -x.c[i] * k->grain);
        r.high.c[i] = e.high;
        r.low.c[i] = e.low;
    }
    return place_to_twice(k, r.high, r.low);
}

/* A vector's height along the way. */
static real rise_along(const vec_twin *way, const vec_twin *e)
{
    twin t = {0, dot(way->high, e->low) + dot(way->low, e->high)};
    EACH(gather(&t, product_of(way->high.c[i], e->high.c[i])));
    return t.high + t.low;
}

/* The blend of a body's points, times their grain: the heaviest, and shares of the ways from there. It is in the set:
 * the shares add up to no more than 3/4, as none is above that of the corner they start from. */
static vec_twin blend_to_twice(const simplex *s, const real weight[DIM + 1], int from, size_t member, real grain)
{
    vec at = mul(member_of(corner(s, from), member), grain);
    vec_twin r = {at, axis(0, 0)};
    for (int k = 0; k < s->n; k++) {
        vec x = mul(member_of(corner(s, k), member), grain);
        if (k == from || same(x, at)) continue;
        for (int i = 0; i < DIM; i++) {
            twin e = sum_of(x.c[i], -at.c[i]), t = {r.high.c[i], r.low.c[i]};
            if (e.high == 0) continue;
            gather(&t, product_of(weight[k], e.high));
            r.high.c[i] = t.high;
            r.low.c[i] = t.low + weight[k] * e.low;
        }
    }
    return r;
}

/* Looks along the pair of points that the weights single out. */
static void look_across(sight *e, const search *q)
{
    const difference *d = &q->d;
    int from = 0;
    for (int k = 1; k < q->s.n; k++) from = e->weight[k] > e->weight[from] ? k : from;
    vec_twin x = blend_to_twice(&q->s, e->weight, from, offsetof(vertex, x), d->a.grain);
    vec_twin y = blend_to_twice(&q->s, e->weight, from, offsetof(vertex, y), d->b.grain);
    e->x = x.high;
    e->y = y.high;
    x = place_to_twice(&d->a, x.high, x.low);
    y = place_to_twice(&d->b, y.high, y.low);
    for (int i = 0; i < DIM; i++) {
        twin t = sum_of(x.high.c[i], -y.high.c[i]), s = sum_of(t.high, -d->c.c[i]);
        s = sum_of(s.high, (s.low + t.low) + (x.low.c[i] - y.low.c[i] - d->c_low.c[i]));
        e->way.high.c[i] = s.high;
        e->way.low.c[i] = s.low;
    }
    e->moved = e->turned = 0;
}

/* Takes what leads so far up the way off it, by the simplex's edges; the weights then are those of the point that it
 * leads to. 0: the simplex is too narrow, or the pair is not where the weights were thought to have it. */
static int turn(sight *e, const search *q, const real rise[DIM + 1], vec *off)
{
    vec a = sub(e->edge_a[1].high, e->edge_b[1].high);
    real share[3] = {0, 0, 0}, aa = dot(a, a);
    share[1] = rise[1] / aa;
    *off = mul(a, share[1]);
#if DIM == 3
    if (q->s.n == 3) {
        vec b = sub(e->edge_a[2].high, e->edge_b[2].high);
        real bb = dot(b, b), ab = dot(a, b), whole = aa * bb - ab * ab;
        if (!(whole > NARROW * aa * bb)) return 0;
        share[1] = (rise[1] * bb - rise[2] * ab) / whole;
        share[2] = (rise[2] * aa - rise[1] * ab) / whole;
        *off = add(mul(a, share[1]), mul(b, share[2]));
    }
#endif
    for (int i = 1; i < q->s.n; i++) {
        e->weight[i] -= share[i];
        e->weight[0] += share[i];
        e->moved += size(share[i]);
    }
    for (int i = 0; i < DIM; i++) {
        twin t = sum_of(e->way.high.c[i], -off->c[i]), s = sum_of(t.high, t.low + e->way.low.c[i]);
        e->way.high.c[i] = s.high;
        e->way.low.c[i] = s.low;
    }
    return spread(*off) <= 32 * UNIT;
}

/* Makes the way square to the simplex's edges: in plain numbers, and once more for what these leave of it. */
static int make_square(sight *e, const search *q)
{
    real rise[DIM + 1] = {0};
    vec off;
    const vertex *p = corner(&q->s, 0);
    if (q->s.n == 1) return 1;
    for (int i = 1; i < q->s.n; i++) {
        e->edge_a[i] = edge_between(&q->d.a, p->x, corner(&q->s, i)->x);
        e->edge_b[i] = edge_between(&q->d.b, p->y, corner(&q->s, i)->y);
        rise[i] = dot(e->way.high, sub(e->edge_a[i].high, e->edge_b[i].high));
    }
    if (!turn(e, q, rise, &off)) return 0;
    for (int i = 1; i < q->s.n; i++) {
        e->rise_a[i] = rise_along(&e->way, &e->edge_a[i]);
        e->rise_b[i] = rise_along(&e->way, &e->edge_b[i]);
        rise[i] = e->rise_a[i] - e->rise_b[i];
    }
    if (!turn(e, q, rise, &off)) return 0;
    for (int i = 1; i < q->s.n; i++) {
        e->rise_a[i] -= dot(off, e->edge_a[i].high);
        e->rise_b[i] -= dot(off, e->edge_b[i].high);
    }
    e->turned = spread(off);
    return 1;
}

/* How far the corner x of the body leads up the way from the simplex's first. */
static real rise_to(const sight *e, const body *k, const simplex *s, size_t member, const real rise[DIM + 1], vec x)
{
    for (int i = 1; i < s->n; i++)
        if (same(member_of(corner(s, i), member), x)) return rise[i];
    vec_twin edge = edge_between(k, member_of(corner(s, 0), member), x);
    return rise_along(&e->way, &edge);
}

/* How far any corner of the body leads down the way from the simplex's first, or with sign -1 up: not above 0. Rounded
 * heights tell which corners do not; a box's edges are asked one by one. */
static real fall_of(const sight *e, const body *k, const simplex *s, size_t member, const real rise[DIM + 1], real sign)
{
    vec first = member_of(corner(s, 0), member);
    vec rough = mul(k->posed ? pull(k->m, e->way.high) : e->way.high, sign);
    real far = k->size == 0 ? 0 : k->reach * k->grain, least = 0, sum = 0;
    real clear = 64 * UNIT * (k->norm * far) * spread(e->way.high);
    for (int i = 0; i < DIM && k->asked == AS_BOX; i++) {
        vec x = first;
        x.c[i] = -x.c[i];
        if (first.c[i] * k->grain * rough.c[i] * -2 > clear) continue;
        sum += smaller(0, sign * rise_to(e, k, s, member, rise, x));
    }
    if (k->asked == AS_BOX) return sum;
    clear += dot(mul(first, k->grain), rough);
    for (size_t i = 0; i < k->list.count; i++) {
        vec x = load(k->list.v + i * k->list.step);
        if (dot(mul(x, k->grain), rough) > clear || same(x, first)) continue;
        least = smaller(least, sign * rise_to(e, k, s, member, rise, x));
    }
    return least;
}

/* The way's length. */
static twin length_of_way(const vec_twin *way)
{
    twin square = {0, 2 * dot(way->high, way->low)};
    EACH(gather(&square, square_of(way->high.c[i])));
    real l = root(square.high);
    twin back = square_of(l);
    return sum_of(l, ((square.high - back.high) + (square.low - back.low)) / (2 * l));
}

/* By how much less than that the sets are apart along the way: the simplex's corners are not level, and others lower.
 */
static real short_of_way(const sight *e, const search *q, real length)
{
    real r = 0;
    for (int i = 1; i < q->s.n; i++) r += e->weight[i] * (e->rise_a[i] - e->rise_b[i]);
    r -= fall_of(e, &q->d.a, &q->s, offsetof(vertex, x), e->rise_a, 1);
    r -= fall_of(e, &q->d.b, &q->s, offsetof(vertex, y), e->rise_b, -1);
    return r / length;
}

/* A number below the length, with the radii and what it may be off taken from it. */
static real below_gap(twin l, real off, real radius_a, real radius_b)
{
    twin r = sum_of(radius_a, radius_b), s = sum_of(l.high, -r.high);
    real rounded = 8 * UNIT * size(off) + 8 * UNIT * UNIT * (size(l.high) + size(r.high));
    s = sum_of(s.high, s.low + (l.low - r.low) - off - rounded);
    return below(s.high, s.low, 0);
}

/* No corner is in the simplex by rounding alone. */
static int is_amid(const real weight[DIM + 1], int n)
{
    int r = 1;
    for (int i = 0; i < n; i++) r &= weight[i] > 256 * UNIT;
    return r;
}

/* The bodies' size at the simplex, or less. */
static real size_at(const search *q)
{
    real far = 0;
    for (int i = 0; i < q->s.n; i++) far = larger(peak(add(point(&q->s, i), q->d.c)), far);
    return smaller(far / 2, 1);
}

/* A bound in the caller's unit; a subnormal one is rounded. */
static real rescaled(real bound, real unscale, real way_out)
{
    real r = bound * unscale;
    return size(r) < REAL_MIN ? r + way_out * 2 * TINY : r;
}

/* The corner in the spare slot lies lower along v than the simplex by so little at most that the simplex may do. */
static int is_about_lowest(const search *q, const goal *g)
{
    real height = dot(q->v, corner(&q->s, q->s.n)->w), gap = q->vv - height;
    return height > 0 && (g->sign_only || !(gap * gap > 16 * UNIT * UNIT * q->vv));
}

/* The distance or its sign, where the walk has come to its end. 0: the bounds do not tell enough. */
static APART int tell_near(search *q, const shape *a, const shape *b, const goal *g, result *r)
{
    sight e;
    if (q->s.n > DIM || q->s.n == 0 || !is_about_lowest(q, g)) return 0;
    weigh(&q->s, e.weight);
    look_across(&e, q);
    if (!make_square(&e, q) || !is_amid(e.weight, q->s.n)) return 0;
    real radius_a = a->radius * q->d.scale, radius_b = b->radius * q->d.scale, rounded = UNIT * UNIT;
    twin l = length_of_way(&e.way);
    if (!(l.high > 4096 * rounded) || !(radius_a + radius_b < 8)) return 0;
    real high = 256 * rounded + 32 * UNIT * e.moved;
    real low = high + 768 * rounded + 64 * UNIT * e.turned / l.high + short_of_way(&e, q, l.high);
    real lower = below_gap(l, low, radius_a, radius_b);
    real upper = -below_gap((twin){-l.high, -l.low}, high, -radius_a, -radius_b);
    int deep = g->deep && upper < 0; /* but only the radii overlap */
    if (!(lower > 0) && !(upper < 0 && (!g->deep || l.high > 2 * low))) return 0;
    if (!g->sign_only && !(low + high <= UNIT / 4 * size_at(q))) return 0;
    twin sum = sum_of(radius_a, radius_b), gap = sum_of(l.high, -sum.high);
    r->value = (gap.high + (gap.low + (l.low - sum.low))) * q->d.unscale;
    r->lower = rescaled(lower, q->d.unscale, -1);
    r->upper = rescaled(upper, q->d.unscale, 1);
    EACH(q->normal.c[i] = 0 - e.way.high.c[i] / l.high);
    place_points(r, q, e.x, e.y, e.way.high, a, b, deep ? 2 : 0);
    store(r->normal, q->normal);
    r->steps = q->steps;
    r->supports = q->d.calls;
    r->reserved = 0;
    return 1;
}

/* That the cores meet, where the corner in the spare slot makes the simplex hold the origin, with nothing rounded. 0:
 * that is not told, and the simplex is as it was. */
static APART int tell_touch(search *q, const shape *a, const shape *b, result *r)
{
    real weight[DIM + 1];
    int at[DIM + 1], n = q->s.n;
    if (n > DIM) return 0;
    memcpy(at, q->s.at, sizeof at);
    q->s.n++;
    if (!holds_origin_plainly(&q->d, &q->s, a, b, weight)) {
        q->s.n = n;
        return 0;
    }
    raise(q, q->v, q->s.slot[at[n]].w);
    q->borrowed &= ~(1u << at[n]);
    q->pending = 0;
    q->steps++;
    vec x = blend(&q->s, weight, offsetof(vertex, x), q->d.a.grain);
    vec y = blend(&q->s, weight, offsetof(vertex, y), q->d.b.grain);
    bracket(r, &q->d, q->lower, 0, a, b);
    r->value = 0;
    place_points(r, q, x, y, axis(0, 0), a, b, 0);
    store(r->normal, q->normal);
    r->steps = q->steps;
    r->supports = q->d.calls;
    r->reserved = 0;
    return 1;
}

#endif
