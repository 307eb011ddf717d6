/* SPDX-License-Identifier: MIT */
/* Cores that are known by their corners, where rounded corners hardly tell: so near to each other, or with radii that
 * so nearly fill the gap. The pair of points that the weights single out is placed to twice the digits, the way between
 * them made square to the simplex, and the height of the lowest corners along it worked out to as many. The bounds
 * prove themselves, however the simplex was come by; where they do not tell enough, the exact finish does. */
#ifndef GJK_CORE_FINE_H
#define GJK_CORE_FINE_H

#include "answer.h"
#include "contact.h"

/* So often another simplex is tried. */
#define FINE_ROUNDS 4

/* By so much at most, as its bound has it, which is far above what it is, may the way be turned that is the normal. */
#define MOST_TURN (4096 * UNIT)

/* ---- the way between the sets ---- */

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
    vec edge[DIM + 1];                         /* of both, rounded; */
    real aa, bb, ab, whole;                    /*   their products, of one the first alone: whole; of two the area */
    real tall;                                 /* the simplex, at least */
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

/* The simplex's edges in plain numbers. 0: it is too narrow. */
static int measure_edges(sight *e, const search *q)
{
    const vertex *p = corner(&q->s, 0);
    for (int i = 1; i < q->s.n; i++) {
        e->edge_a[i] = edge_between(&q->d.a, p->x, corner(&q->s, i)->x);
        e->edge_b[i] = edge_between(&q->d.b, p->y, corner(&q->s, i)->y);
        e->edge[i] = sub(e->edge_a[i].high, e->edge_b[i].high);
    }
    real aa = dot(e->edge[1], e->edge[1]);
    e->whole = e->tall = e->aa = aa;
#if DIM == 3
    if (q->s.n == 3) {
        real bb = dot(e->edge[2], e->edge[2]), ab = dot(e->edge[1], e->edge[2]);
        e->whole = aa * bb - ab * ab;
        e->tall = e->whole / (2 * (aa + bb));
        e->bb = bb;
        e->ab = ab;
        if (!(e->whole > NARROW * aa * bb)) return 0;
    }
#endif
    e->tall = root(e->tall);
    return 1;
}

/* Takes what leads so far up the way off it, by the simplex's edges; the weights then are those of the point that it
 * leads to. 0: the pair is not where the weights were thought to have it. */
static int turn(sight *e, const search *q, const real rise[DIM + 1], vec *off)
{
    real share[3] = {0, rise[1] / e->whole, 0};
    *off = mul(e->edge[1], share[1]);
#if DIM == 3
    if (q->s.n == 3) {
        share[1] = (rise[1] * e->bb - rise[2] * e->ab) / e->whole;
        share[2] = (rise[2] * e->aa - rise[1] * e->ab) / e->whole;
        *off = add(mul(e->edge[1], share[1]), mul(e->edge[2], share[2]));
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
    if (q->s.n == 1) return 1;
    if (!measure_edges(e, q)) return 0;
    for (int i = 1; i < q->s.n; i++) rise[i] = dot(e->way.high, e->edge[i]);
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

/* The pair that they single out is in the bodies. */
static inline int are_shares(const real weight[DIM + 1], int n)
{
    int r = 1;
    for (int k = 0; k < n; k++) r &= weight[k] >= 0;
    return r;
}

/* The pair that the weights single out, square to the simplex. Of one that is not too narrow the weights may still be
 * off by more than the points may be moved: it is looked at once more then, with what the weights have become. */
static int look_squarely(sight *e, const search *q)
{
    look_across(e, q);
    if (make_square(e, q)) return 1;
    if (!(e->moved > 0) || !are_shares(e->weight, q->s.n)) return 0;
    look_across(e, q);
    return make_square(e, q);
}

/* How far the corner x of the body leads up the way from the simplex's first. */
static real rise_to(const sight *e, const body *k, const simplex *s, size_t member, const real rise[DIM + 1], vec x)
{
    for (int i = 1; i < s->n; i++)
        if (same(member_of(corner(s, i), member), x)) return rise[i];
    vec_twin edge = edge_between(k, member_of(corner(s, 0), member), x);
    return rise_along(&e->way, &edge);
}

/* A bit for each of the list's eight corners from there on, or of all where they are fewer, times their grain: whether
 * it is not higher than that along the way. */
static inline unsigned not_above(const body *k, size_t from, vec way, real most)
{
    const list *l = &k->list;
    lanes at[DIM], high[EIGHT / LANES];
    if (l->count < EIGHT) {
        unsigned r = 0;
        for (size_t i = 0; i < l->count; i++) r |= (unsigned)!(dot(mul(nth_of(l, i), k->grain), way) > most) << i;
        return r;
    }
    const ways back = ways_of(mul(way, -1));
    for (size_t j = 0; j < EIGHT / LANES; j++) {
        load_lanes(l->v + (from + j * LANES) * l->step, l->step, at);
        EACH(at[i] = products(at[i], in_all(k->grain)));
        high[j] = products(at[0], back.c[0]);
        REST(high[j] = sums(high[j], products(at[i], back.c[i])));
    }
    return eight_as_large(high, in_all(-most));
}

/* What fall_of has found so far. */
typedef struct descent {
    real least;
    vec x;
} descent;

static inline void look_for_fall(descent *f, const sight *e, const body *k, const simplex *s, size_t member,
                                 const real rise[DIM + 1], real sign, vec y)
{
    if (same(y, member_of(corner(s, 0), member))) return;
    const real far = sign * rise_to(e, k, s, member, rise, y);
    if (far < f->least) *f = (descent){far, y};
}

/* How far any corner of the body leads down the way from the simplex's first, or with sign -1 up: not above 0; x is
 * that corner. Rounded heights tell which corners do not, or an index; a box's edges are asked one by one. */
static real fall_of(const sight *e, const body *k, const simplex *s, size_t member, const real rise[DIM + 1], real sign,
                    vec *x)
{
    vec first = *x = member_of(corner(s, 0), member);
    vec rough = mul(k->posed ? pull(k->m, e->way.high) : e->way.high, sign);
    const real far = k->size == 0 ? 0 : k->reach * k->grain;
    real sum = 0;
    const real clear = 64 * UNIT * (k->norm * far) * spread(e->way.high);
    for (int i = 0; i < DIM && k->asked == AS_BOX; i++) {
        vec y = first;
        y.c[i] = -y.c[i];
        if (first.c[i] * k->grain * rough.c[i] * -2 > clear) continue;
        real fall = sign * rise_to(e, k, s, member, rise, y);
        if (!(fall < 0)) continue;
        sum += fall;
        x->c[i] = y.c[i];
    }
    if (k->asked == AS_BOX) return sum;
    descent f = {0, first};
    candidates those;
    const real high = dot(mul(first, k->grain), rough) + clear;
    if (clear <= LOWER / 2 * UNIT * far * peak(rough) && look_up(&k->list, mul(rough, -1), &those)) {
        for (; those.from < those.end; those.from++) {
            const vec y = nth_of(&k->list, *those.from);
            if (!(dot(mul(y, k->grain), rough) > high)) look_for_fall(&f, e, k, s, member, rise, sign, y);
        }
    } else {
        for (size_t i = 0; i < k->list.count; i += EIGHT) {
            const size_t from = k->list.count < EIGHT ? 0 : later_eight(i, k->list.count - EIGHT);
            for (unsigned low = not_above(k, from, rough, high); low; low &= low - 1)
                look_for_fall(&f, e, k, s, member, rise, sign, nth_of(&k->list, from + first_bit(low)));
        }
    }
    *x = f.x;
    return f.least;
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

/* By how much less than that the sets are apart along the way: the simplex's corners are not level, and others lower:
 * last is the corner that lies lowest, of points alone. */
static real short_of_way(const sight *e, const search *q, real length, vertex *last)
{
    real r = 0;
    for (int i = 1; i < q->s.n; i++) r += e->weight[i] * (e->rise_a[i] - e->rise_b[i]);
    r -= fall_of(e, &q->d.a, &q->s, offsetof(vertex, x), e->rise_a, 1, &last->x);
    r -= fall_of(e, &q->d.b, &q->s, offsetof(vertex, y), e->rise_b, -1, &last->y);
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

/* The corners that are in the simplex by more than the pair may be off, high; another would turn the way, or is none of
 * it. */
static unsigned corners_amid(const sight *e, int n, real high)
{
    unsigned mask = 0;
    if (n == 1) return 1;
    for (int i = 0; i < n; i++) mask |= e->weight[i] * e->tall > 16 * high ? 1u << i : 0;
    return mask;
}

/* The bodies' size at the simplex, or less. */
static real size_at(const search *q)
{
    real far = 0;
    for (int i = 0; i < q->s.n; i++) far = larger(peak(add(point(&q->s, i), q->d.c)), far);
    return smaller(far / 2, 1);
}

/* What is left to do where a look does not tell enough. */
typedef struct glimpse {
    unsigned amid; /* the corners that are in the simplex for certain */
    int seen;      /* all are: then */
    vertex last;   /*   the corner that lies lowest, of points alone, */
    int beyond;    /*   and whether the origin lies between */
} glimpse;

/* The distance or its sign, as the pair tells that the simplex singles out. 0: that is not enough. */
static APART int tell_pair(search *q, const shape *a, const shape *b, const goal *g, glimpse *left, result *r)
{
    sight e;
    real radius_a = a->radius * q->d.scale, radius_b = b->radius * q->d.scale, rounded = UNIT * UNIT;
    weigh_walked(q, e.weight);
    int square = look_squarely(&e, q);
    real high = 256 * rounded + 32 * UNIT * e.moved;
    left->seen = 0;
    left->amid = corners_amid(&e, q->s.n, high);
    if (!square || left->amid + 1 != 1u << q->s.n) return 0;
    twin l = length_of_way(&e.way);
    if (!(l.high > 4096 * rounded) || !(radius_a + radius_b < 8)) return 0;
    real low = high + 768 * rounded + 64 * UNIT * e.turned / l.high + short_of_way(&e, q, l.high, &left->last);
    left->seen = 1;
    left->beyond = q->s.n == DIM && l.high < low;
    real lower = below_gap(l, low, radius_a, radius_b);
    real upper = -below_gap((twin){-l.high, -l.low}, high, -radius_a, -radius_b);
    int deep = g->deep && upper < 0; /* but only the radii overlap */
    if (!(lower > 0) && !(upper < 0 && (!g->deep || l.high > 2 * low))) return 0;
    if (!g->sign_only && !(low + high <= UNIT / 4 * size_at(q) && high <= MOST_TURN * l.high)) return 0;
    r->value = gap_of(&q->d, l, a, b);
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

/* ---- other simplices ---- */

/* The corner's w rounded once. */
static void polish(search *q, vertex *p) { p->w = add(p->w, lost_of(q, p)); }

/* Puts a corner that was found, not asked for, where the next one goes. */
static void put_spare(search *q, const vertex *c)
{
    q->borrowed &= ~(1u << q->s.at[q->s.n]);
    *spare(&q->s) = *c;
    spare(&q->s)->w = corner_of(&q->d, c->x, c->y);
}

static void count_step(search *q)
{
    q->steps++;
    q->d.calls += 2;
}

/* Whether the simplex, which is a facet, and the corner that lies beyond the origin as seen from there hold it. */
static int holds_with(search *q, const shape *a, const shape *b, const vertex *c, real weight[DIM + 1])
{
    put_spare(q, c);
    q->s.n++;
    if (holds_origin(q, a, b, weight)) {
        count_step(q);
        return 1;
    }
    q->s.n--;
    return 0;
}

/* Takes in the corner that was seen. 0: v comes no nearer by it. */
static int take_corner(search *q, const goal *g, const vertex *c)
{
    for (int i = 0; i < q->s.n; i++)
        if (repeats(corner(&q->s, i), c)) return 0;
    if (q->steps >= g->max_steps) return 0;
    put_spare(q, c);
    polish(q, spare(&q->s));
    count_step(q);
    return advance(q) && q->s.n <= DIM && !vanished(q);
}

/* Goes on to another simplex: without corners that have shown to be none of it; or from its corners rounded once, and
 * with that which was seen. 0: there is none. */
static int go_on(search *q, const goal *g, const glimpse *left, int anew)
{
    int before = q->s.n;
    if (!left->seen) {
        if (left->amid + 1 == 1u << before || left->amid == 0) return 0;
        keep(&q->s, left->amid);
        project(q, 1);
        q->weighed = 0;
        return 1;
    }
    for (int i = 0; i < before && anew; i++) polish(q, &q->s.slot[q->s.at[i]]);
    if (anew) project(q, 1);
    q->weighed = 0;
    return take_corner(q, g, &left->last) || q->s.n < before;
}

enum sighting { NOTHING, APART_FINELY, MEETING };

/* The same from other simplices. NOTHING: q is as it was. */
static APART enum sighting look_around(search *q, const shape *a, const shape *b, const goal *g, glimpse *left,
                                       real *weight, result *r)
{
    search kept = *q;
    for (int i = 0; i < FINE_ROUNDS; i++) {
        int meet = left->seen && left->beyond && weight && q->steps < g->max_steps;
        if (meet && holds_with(q, a, b, &left->last, weight)) return MEETING;
        if (!go_on(q, g, left, i == 0)) break;
        if (tell_pair(q, a, b, g, left, r)) return APART_FINELY;
    }
    *q = kept;
    return NOTHING;
}

/* The distance or its sign, told; or, where weights are asked for, that the cores meet, with these. */
static enum sighting tell_near(search *q, const shape *a, const shape *b, const goal *g, real *weight, result *r)
{
    glimpse left;
    if (q->s.n > DIM || q->s.n == 0) return NOTHING;
    return tell_pair(q, a, b, g, &left, r) ? APART_FINELY : look_around(q, a, b, g, &left, weight, r);
}

/* That the cores meet, as the simplex and these weights prove. */
static void tell_meeting(search *q, const shape *a, const shape *b, real upper, const real weight[DIM + 1], result *r)
{
    vec x = blend(&q->s, weight, offsetof(vertex, x), q->d.a.grain);
    vec y = blend(&q->s, weight, offsetof(vertex, y), q->d.b.grain);
    q->pending = 0;
    bracket(r, &q->d, q->lower, smaller(upper, 0), a, b);
    r->upper = smaller(r->upper, 0); /* also where it was rounded on the way out */
    r->value = 0;
    place_points(r, q, x, y, axis(0, 0), a, b, 0);
    store(r->normal, q->normal);
    r->steps = q->steps;
    r->supports = q->d.calls;
    r->reserved = 0;
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
    raise(q, q->way, q->s.slot[at[n]].w);
    q->borrowed &= ~(1u << at[n]);
    q->steps++;
    tell_meeting(q, a, b, 0, weight, r);
    return 1;
}

#endif
