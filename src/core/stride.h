/* SPDX-License-Identifier: MIT */
/* Whether two bodies meet, where the first glance has told nothing, and a few more corners may: most pairs that overlap
 * are told by four. The walk's first steps are taken without its frame and without its care: lengths are brought to
 * size by the doubt of a glance, corners are sought in haste, and what they show is told as a glance tells it. Whatever
 * is out of the ordinary is left to the walk, which takes over from there. */
#ifndef GJK_CORE_STRIDE_H
#define GJK_CORE_STRIDE_H

#include "glance.h"

#if DIM == 3

/* Neither is a point or a segment, which have no inside; not both are boxes, which are told by their axes; and there
 * are no radii, which may reach across before the cores meet. */
static inline int are_for_strides(const difference *d, const shape *a, const shape *b)
{
    return !is_thin(&d->a) && !is_thin(&d->b) && (d->a.asked != AS_BOX || d->b.asked != AS_BOX) && a->radius == 0 &&
           b->radius == 0;
}

/* The corner is not so near to the origin that it gives no direction. */
static inline int stands_clear(const vertex *p) { return dot(p->w, p->w) > UNIT * UNIT / 4; }

/* The corner in the first slot is the simplex. */
static inline void stand_on_first(search *q)
{
    clear(&q->s);
    q->s.n = 1;
    q->way = first_direction(&q->d);
    q->v = q->s.slot[0].w;
    q->vv = dot(q->v, q->v);
    q->weight[0] = 1;
    q->weighed = 1;
    q->lower = -4;
    q->normal = axis(0, 1);
    q->pending = q->repeated = q->stood = q->kept = 0;
    q->borrowed = 0;
    q->d.slack = 0;
    q->d.loose = 0;
    q->steps = 1 + (q->dug > 0 ? q->dug : 0);
}

/* A frame by the doubt of a glance at bodies in the caller's lengths: the root that it is made of is of size 1 to 2. */
static inline void bring_to_size(difference *d)
{
    d->scale = d->a.grain = d->b.grain = leveler(d->doubt * (1 / GLANCE_DOUBT));
    d->unscale = 1 / d->scale;
    d->c = mul(d->c, d->scale);
    d->doubt *= d->scale;
}

/* One in so many of the lists' corners is looked at, SOME at least; of all bounds can be told. */
#define SOME 16
typedef struct portion {
    size_t n;
    list a, b; /* all of them, if that was ever more than 1 */
} portion;

static void look_at_portion(difference *d, portion *k, size_t n)
{
    k->n = n;
    d->a.list = k->a;
    d->b.list = k->b;
    if (n == 1) return;
    thin_out(&d->a, n, SOME);
    thin_out(&d->b, n, SOME);
}

HOT void look_at_some(difference *d, portion *k)
{
    const size_t of_a = share_of(&d->a, SOME), of_b = share_of(&d->b, SOME);
    k->n = of_a > of_b ? of_a : of_b;
    if (k->n == 1) return;
    k->a = d->a.list;
    k->b = d->b.list;
    look_at_portion(d, k, k->n);
}

HOT void look_at_all(difference *d, portion *k)
{
    if (k->n > 1) look_at_portion(d, k, 1);
}

/* The body's point farthest along a direction as it sees it, in haste. 0: it is none. */
static APART int point_toward(const body *k, vec dir, vec *x) { return farthest_seen(k, dir, HASTY, x); }

/* The same of a hull at the door: of eight corners or more, in the caller's lengths. */
HOT int point_of_hull(const body *k, vec dir, enum care care, vec *x)
{
    const list *l = &k->list;
    const size_t best = l->count < MANY ? farthest_of_some(l, dir, care) : farthest_among(l, dir, care);
    if (best == l->count) return 0;
    *x = nth_of(l, best);
    return fits(k, *x);
}

/* The corner least along the way, in haste, and what it shows; hulls: both are, at the door. 0: it is none. */
HOT int find_corner(difference *d, int hulls, vec way, vertex *p, evidence *e)
{
    if (!hulls && d->wild) {
        if (!ask_with(d, way, HASTY, p)) return 0;
    } else {
        const sought v = seek_both(d, way);
        d->calls += 2;
        if (hulls ? !point_of_hull(&d->a, v.of_a, HASTY, &p->x) || !point_of_hull(&d->b, v.of_b, HASTY, &p->y)
                  : !point_toward(&d->a, v.of_a, &p->x) || !point_toward(&d->b, v.of_b, &p->y))
            return 0;
    }
    const vec x = hulls ? p->x : mul(p->x, d->a.grain), y = hulls ? p->y : mul(p->y, d->b.grain);
    see_corner(d, way, duos_of(x, y), e);
    p->w = e->w;
    return 1;
}

/* The same along the search's way; where A's point of it is placed is kept, too. */
static inline int seek_corner(search *q, evidence *e, vec at[DIM + 1])
{
    const int slot = q->s.at[q->s.n];
    if (!find_corner(&q->d, 0, q->way, &q->s.slot[slot], e)) return 0;
    at[slot] = e->a;
    q->pending = 1;
    return 1;
}

/* A corner, sought along that way, proves the bodies to be apart. */
static inline int tell_corner(search *q, evidence *e, vec way, const shape *a, const shape *b, result *r)
{
    if (!(e->height > 0)) return 0;
    weigh_evidence(e, way, q->d.doubt);
    if (!(e->lower > 0)) return 0;
    q->pending = 0; /* the next query starts better from the others */
    if (q->d.wild) return spell_evidence(q, e, way, a, b, r);
    spell_sharp(q, e, way, q->d.unscale, a, b, r);
    return 1;
}

/* What it proves, whatever becomes of it. */
static inline void keep_evidence(search *q, const evidence *e)
{
    const real l = length(q->way), lower = proven_along(e->height, l, q->d.doubt);
    if (!(lower > q->lower)) return;
    q->lower = lower;
    EACH(q->normal.c[i] = 0 - q->way.c[i] / l);
}

/* A tetrahedron of points of A - B. */
typedef struct tetra {
    vec w[DIM + 1];
    real turn;            /* its handedness */
    real weight[DIM + 1]; /* with which it holds the origin, which lies beyond the face across where one is below 0 */
} tetra;

/* How much room the origin has in it, as rough_room has it: of the heights' squares, and of corners no farther out than
 * that, or sqrt(3) times. 0: none for certain. */
HOT real room_of(tetra *t, real far)
{
    const vec p = t->w[3], a = sub(t->w[0], p), b = sub(t->w[1], p), c = sub(t->w[2], p);
    const vec bc = cross(b, c), ca = cross(c, a), ab = cross(a, b), last = add(add(bc, ca), ab);
    const real turn = signed_as(1, dot(a, bc));
    const real doubt = 667 * UNIT * (far * far * far); /* 128 UNIT (sqrt(3) far)^3: docs/bounds.md */
    const real w0 = -dot(p, bc) * turn, w1 = -dot(p, ca) * turn, w2 = -dot(p, ab) * turn;
    const real w3 = dot(t->w[0], cross(t->w[1], t->w[2])) * turn;
    t->turn = turn;
    t->weight[0] = w0;
    t->weight[1] = w1;
    t->weight[2] = w2;
    t->weight[3] = w3;
    const real u0 = w0 - doubt, u1 = w1 - doubt, u2 = w2 - doubt, u3 = w3 - doubt;
    if (!((u0 > 0) & (u1 > 0) & (u2 > 0) & (u3 > 0))) return 0;
    real least = u0 * u0 / dot(bc, bc);
    least = smaller(u1 * u1 / dot(ca, ca), least);
    least = smaller(u2 * u2 / dot(ab, ab), least);
    least = smaller(u3 * u3 / dot(last, last), least);
    return root(least) * (1 - 8 * UNIT);
}

/* Square to the face across from one of the points, toward that. */
static vec square_to_face(const tetra *t, int across)
{
    const vec p = t->w[3], e[DIM] = {sub(t->w[0], p), sub(t->w[1], p), sub(t->w[2], p)};
    if (across < DIM) return mul(cross(e[(across + 1) % DIM], e[(across + 2) % DIM]), t->turn);
    return mul(add(add(cross(e[1], e[2]), cross(e[2], e[0])), cross(e[0], e[1])), -t->turn);
}

/* How far out corners are, or a little less. */
static inline real whole_of(const difference *d) { return d->doubt * (1 / GLANCE_DOUBT); }

/* With the corner in the spare slot a triangle holds the origin; its weights, and the room there. */
static inline real room_with_last(const search *q, real weight[DIM + 1])
{
    tetra t = {.w = {point(&q->s, 0), point(&q->s, 1), point(&q->s, 2), point(&q->s, 3)}};
    const real inside = room_of(&t, whole_of(&q->d));
    memcpy(weight, t.weight, sizeof t.weight);
    return inside;
}

/* They meet, at least that deep; at is the point of both, from A's position. */
static void spell_met(const search *q, vec at, real upper, const shape *a, const shape *b, result *r)
{
    const real unscale = q->d.unscale;
    r->lower = q->lower * unscale;
    r->upper = upper * unscale;
    if (q->d.wild) bracket(r, &q->d, q->lower, upper, a, b);
    r->value = r->upper;
    at = mul(at, unscale);
    if (a->pose) at = add(at, load(a->pose->p));
    if (q->d.wild) at = in_range(at);
    store(r->point_a, at);
    store(r->point_b, at);
    store(r->normal, q->normal);
    r->steps = q->steps;
    r->supports = q->d.calls;
    r->reserved = 0;
}

HOT vec blended(const vec x[DIM + 1], const real part[DIM + 1])
{
    return add(add(add(mul(x[0], part[0]), mul(x[1], part[1])), mul(x[2], part[2])), mul(x[3], part[3]));
}

/* The tetrahedron, times that power of two, holds the origin with room; at is where A's points of it are placed. 0: the
 * weights miss the point of both. */
HOT int tell_met(const search *q, const tetra *t, real by, const vec at[DIM + 1], const shape *a, const shape *b,
                 result *r)
{
    const real *w = t->weight, per = 1 / (w[0] + w[1] + w[2] + w[3]), upper = q->d.doubt - q->inside;
    const real part[DIM + 1] = {w[0] * per, w[1] * per, w[2] * per, w[3] * per};
    if (!(peak(blended(t->w, part)) <= q->d.doubt * by / 8) || !(upper * q->d.unscale < 0)) return 0;
    spell_met(q, blended(at, part), upper, a, b, r);
    return 1;
}

/* The corner in the spare slot closes a full simplex around the origin, and that is told; at, by slot, is where A's
 * points of it are placed. */
static inline int tell_closed(search *q, const evidence *e, int of_all, const vec at[DIM + 1], const shape *a,
                              const shape *b, result *r)
{
    const int *of = q->s.at;
    tetra t = {.w = {point(&q->s, 0), point(&q->s, 1), point(&q->s, 2), point(&q->s, 3)}};
    const vec on_a[DIM + 1] = {at[of[0]], at[of[1]], at[of[2]], at[of[3]]};
    const real inside = room_of(&t, whole_of(&q->d));
    if (!(inside > q->d.doubt)) return 0;
    q->inside = inside;
    if (of_all) keep_evidence(q, e);
    if (!tell_met(q, &t, 1, on_a, a, b, r)) return 0;
    q->s.n = DIM + 1;
    q->pending = 0;
    return 1;
}

/* ---- digging ---- */

/* Bodies whose first corner lies deep are told by two more, as a rule, and by a point that is within for certain:
 * sought at once, to both sides of the line from that point to the first corner, they close a tetrahedron around the
 * origin. Where they do not, the next one is sought beyond the face that the origin is beyond. */
#define FAN 2
#define DIGS 3
#define DEEPEST (FAN + DIGS - 1)

/* A corner's first two coordinates, side by side, and the third; or the sum of two corners. */
typedef struct threefold {
    duo xy;
    real z;
} threefold;

HOT threefold threefold_of(const real *v, real by)
{
    return (threefold){duo_mul(duo_beside(v), duo_both(by)), v[2] * by};
}

HOT threefold summed(threefold p, threefold q) { return (threefold){duo_add(p.xy, q.xy), p.z + q.z}; }

/* The middle of some corners, each times that: a point within. */
HOT vec middle_of(const list *l, real by)
{
    const size_t n = l->count, far = n / EIGHT * l->step;
    if (n < EIGHT) return mul(add(mul(load(l->v), by), mul(nth_of(l, n - 1), by)), (real)0.5);
    threefold even = threefold_of(l->v, by), odd = threefold_of(l->v + far, by);
    for (size_t i = 2; i < EIGHT; i += 2) {
        even = summed(even, threefold_of(l->v + i * far, by));
        odd = summed(odd, threefold_of(l->v + (i + 1) * far, by));
    }
    const threefold all = summed(even, odd);
    return mul((vec){{of_a(all.xy), of_b(all.xy), all.z}}, (real)1 / EIGHT);
}

HOT vec inner_point(const body *k, int hull)
{
    if (!hull && k->asked == AS_BOX) return axis(0, 0);
    return middle_of(&k->list, hull ? 1 : k->grain);
}

/* 1 / sqrt(3): with that for p the ways are those of a regular triangle around the line. */
#define ACROSS_FAN ((real)0.58)

/* The ways least along which such corners lie: beside the line from o, within, to the first corner p. How long its
 * parts are is told by their spreads, which is near enough. 0: there are none, as p lies as far along o as o does, or
 * in line with it. */
HOT int spread_fan(vec o, vec p, vec way[FAN])
{
    const real oo = dot(o, o), op = dot(o, p), per = 1 / oo, tall = spread(o), fall = 1 - op * per;
    const vec aside = sub(p, mul(o, op * per)), across = mul(cross(o, aside), tall * per * ACROSS_FAN);
    const vec down = mul(o, spread(aside) / (tall * fall)), on = add(mul(aside, (real)0.5), down);
    way[0] = add(on, across);
    way[1] = sub(on, across);
    return fall != 0 && dot(way[0], way[0]) > 0;
}

/* The point of the tetrahedron across from the face that the origin is beyond. */
HOT int across_from(const real w[DIM + 1])
{
    const int i = w[1] < w[0], k = w[3] < w[2] ? 3 : 2;
    return w[k] < w[i] ? k : i;
}

/* A hull's points along the fan's directions as it sees them; of eight in one look. 0: they are none. */
HOT int points_of_fan(const body *k, const vec dir[FAN], vec x[FAN])
{
    if (k->list.count != EIGHT) return point_of_hull(k, dir[0], HASTY, &x[0]) && point_of_hull(k, dir[1], HASTY, &x[1]);
    size_t at[FAN];
    farthest_of_eight_twice(&k->list, DIM, dir, at);
    for (int i = 0; i < FAN; i++) x[i] = nth_of(&k->list, at[i]);
    return fits(k, x[0]) && fits(k, x[1]);
}

/* The corners along a fan of ways, of hulls, as find_corner has them one after another. 0: they are none. */
HOT int find_fan(const difference *d, const vec way[FAN], evidence e[FAN])
{
    vec of_a[FAN], of_b[FAN], x[FAN], y[FAN];
    for (int i = 0; i < FAN; i++) {
        const sought v = seek_both(d, way[i]);
        of_a[i] = v.of_a;
        of_b[i] = v.of_b;
    }
    if (!points_of_fan(&d->a, of_a, x) || !points_of_fan(&d->b, of_b, y)) return 0;
    for (int i = 0; i < FAN; i++) see_corner(d, way[i], duos_of(x[i], y[i]), &e[i]);
    return 1;
}

/* Whether there is a line of centres, and the first corner, so high along it, lies deep. */
HOT int lies_deep(const difference *d, real height)
{
    const real l = root(dot(d->c, d->c)), far = whole_of(d);
    return l > UNIT * far && -height > l * far / 8;
}

/* What is dug: a tetrahedron of the first corner, of those that were sought since, and of a point within; all times a
 * power of two. */
typedef struct pit {
    tetra t;
    vec at[DIM + 1]; /* where A's points of it are placed */
    real by;         /* that power */
    real height;     /* of the first corner, along the line of centres */
    int corners;     /* so many of its points, from the first on */
} pit;

/* The first corner and the point within, in between neither. 0: that gives no direction. */
HOT int open_pit(const search *q, int hulls, real height, vec first_at, pit *k)
{
    const difference *d = &q->d;
    const duos within = duos_mapped(&d->maps, duos_of(inner_point(&d->a, hulls), inner_point(&d->b, hulls)));
    k->by = hulls ? leveler(whole_of(d)) : 1;
    k->height = height;
    k->corners = DIM;
    k->t.w[0] = mul(q->s.slot[0].w, k->by);
    k->t.w[DIM] = mul(corner_at_spots(d, within), k->by);
    k->at[0] = first_at;
    k->at[DIM] = vec_of_a(within);
    return dot(k->t.w[DIM], k->t.w[DIM]) > UNIT * UNIT;
}

/* Takes the corner that was sought along the way for one of its points. 1: the bodies are apart, and that is told. */
HOT int take_dug(search *q, pit *k, int place, evidence *e, vec way, int of_all, const shape *a, const shape *b,
                 result *r)
{
    q->steps = 1 + q->dug++;
    if (of_all && tell_corner(q, e, way, a, b, r)) return 1;
    k->t.w[place] = mul(e->w, k->by);
    k->at[place] = e->a;
    return 0;
}

/* It holds the origin, and that is told. */
HOT int tell_pit(search *q, pit *k, const shape *a, const shape *b, result *r)
{
    const difference *d = &q->d;
    q->inside = room_of(&k->t, whole_of(d) * k->by) / k->by;
    if (!(q->inside > d->doubt)) return 0;
    const real l = root(dot(d->c, d->c));
    q->lower = k->height / l - d->doubt;
    EACH(q->normal.c[i] = 0 + d->c.c[i] / l); /* where that is 0 it has no sign */
    q->steps++;
    q->s.n = k->corners;
    return tell_met(q, &k->t, k->by, k->at, a, b, r);
}

/* Where the fan has told nothing: corner after corner, beyond the face that the origin is beyond. */
static APART enum glanced dig_on(search *q, pit own, int hulls, int of_all, const shape *a, const shape *b, result *r)
{
    pit *k = &own;
    vertex none;
    evidence e;
    while (q->dug < DEEPEST) {
        const int place = across_from(k->t.weight);
        const vec way = square_to_face(&k->t, place);
        if (place == DIM) k->corners = DIM + 1; /* a corner instead of the point within */
        if (!find_corner(&q->d, hulls, way, hulls ? &none : &q->s.slot[place], &e)) return UNCLEAR;
        if (take_dug(q, k, place, &e, way, of_all, a, b, r) || tell_pit(q, k, a, b, r)) return TELLING;
    }
    return IN_VAIN;
}

/* It does; so high, and that is where A's point of it is placed. IN_VAIN: this tells nothing, q->dug corners have been
 * looked at, and the first is in its slot as before. */
HOT enum glanced dig_from(search *q, int hulls, int of_all, real height, vec first_at, const shape *a, const shape *b,
                          result *r)
{
    difference *d = &q->d;
    vec way[FAN];
    evidence e[FAN];
    pit k;
    q->dug = 0;
    if (!open_pit(q, hulls, height, first_at, &k) || !spread_fan(k.t.w[DIM], k.t.w[0], way)) return IN_VAIN;
    if (hulls && !find_fan(d, way, e)) return UNCLEAR;
    for (int i = 0; i < FAN; i++) {
        if (hulls) d->calls += 2;
        else if (!find_corner(d, 0, way[i], &q->s.slot[1 + i], &e[i])) return UNCLEAR;
        if (take_dug(q, &k, 1 + i, &e[i], way[i], of_all, a, b, r)) return TELLING;
    }
    if (tell_pit(q, &k, a, b, r)) return TELLING;
    const vertex first = q->s.slot[0];
    const enum glanced seen = dig_on(q, k, hulls, of_all, a, b, r);
    if (seen == IN_VAIN) q->s.slot[0] = first;
    return seen;
}

/* ---- striding ---- */

/* The corner in the spare slot lies no lower along v. */
static inline int leads_nowhere(const search *q)
{
    const vec w = point(&q->s, q->s.n);
    return !(q->vv - dot(q->v, w) > noise_along(q->v, w));
}

/* From the corner in the first slot, which has told nothing. STRODE: neither have those that are in the simplex now,
 * and one that may be pending. UNCLEAR: something is wrong. */
static enum glanced stride_among(search *q, portion *k, int max_steps, const shape *a, const shape *b, result *r)
{
    const vec centres = q->way;
    vec at[DIM + 1];
    evidence e = {.height = 0};
    int headings = HEADINGS;
    at[0] = place(&q->d.a, q->s.slot[0].x);
    while (q->steps < max_steps) {
        const int heads = headings-- > 0, of_all = k->n == 1;
        q->way = heads ? heading(q, centres) : q->v;
        if (!seek_corner(q, &e, at)) return UNCLEAR;
        if (of_all && tell_corner(q, &e, q->way, a, b, r)) return TELLING;
        q->steps++;
        if (q->s.n == DIM && tell_closed(q, &e, of_all, at, a, b, r)) return TELLING;
        q->stood = leads_nowhere(q) || (!of_all && !heads && !(dot(q->v, e.w) < q->vv / 2));
        if (!q->stood && q->s.n <= DIM && step_plainly(q) && q->s.n <= DIM) continue;
        if (of_all || q->s.n > DIM) {
            if (of_all) keep_evidence(q, &e);
            return STRODE;
        }
        look_at_portion(&q->d, k, k->n / 4);
        q->pending = 0;
    }
    return STRODE;
}

/* From the corner in the first slot, if it lies deep, and that has not been tried. */
static enum glanced dig_anywhere(search *q, int of_all, int max_steps, const shape *a, const shape *b, result *r)
{
    const real height = -dot(q->d.c, q->v);
    if (q->dug >= 0) return IN_VAIN;
    q->dug = 0;
    if (max_steps <= DEEPEST || !lies_deep(&q->d, height)) return IN_VAIN;
    const enum glanced seen = dig_from(q, 0, of_all, height, place(&q->d.a, q->s.slot[0].x), a, b, r);
    if (seen == IN_VAIN) {
        q->s.n = 1;
        q->steps = 1 + q->dug;
    }
    return seen;
}

static enum glanced stride(search *q, int max_steps, const shape *a, const shape *b, result *r)
{
    portion k;
    const int take_all = !is_long_way(&q->d);
    look_at_some(&q->d, &k);
    stand_on_first(q);
    if (k.n > 1) {
        const evidence first = {.height = dot(q->way, q->v)};
        keep_evidence(q, &first);
    }
    enum glanced seen = dig_anywhere(q, k.n == 1, max_steps, a, b, r);
    if (take_all) look_at_all(&q->d, &k);
    if (seen == IN_VAIN) seen = stride_among(q, &k, max_steps, a, b, r);
    look_at_all(&q->d, &k);
    return seen;
}

/* Where the walk may go on, in another frame. */
static void leave_trail(search *q)
{
    trail *t = &q->trail;
    memcpy(t->at, q->s.at, sizeof t->at);
    t->n = q->s.n;
    t->unscale = q->d.unscale;
    t->vv = q->vv;
    t->lower = q->lower;
    t->normal = q->normal;
    t->pending = q->pending;
    t->steps = q->steps;
    t->calls = q->d.calls;
    t->near = is_near(q);
}

/* Of bodies at which a glance was cast in vain, in the caller's lengths, with its doubt. */
static APART enum glanced stride_outside(search *q, int max_steps, const shape *a, const shape *b, result *r)
{
    if (!are_for_strides(&q->d, a, b)) return IN_VAIN;
    bring_to_size(&q->d);
    q->s.slot[0].w = mul(q->s.slot[0].w, q->d.scale);
    const enum glanced seen = stands_clear(&q->s.slot[0]) ? stride(q, max_steps, a, b, r) : UNCLEAR;
    if (seen == STRODE) leave_trail(q);
    return seen;
}

/* That frame of bodies in another, which is as large to a binade or two: so that bits are the same. */
static void bring_frame_to_size(difference *d)
{
    const real level = leveler(d->doubt * (1 / GLANCE_DOUBT));
    body *const both[2] = {&d->a, &d->b};
    for (int i = 0; i < 2; i++) {
        body *k = both[i];
        if (!d->wild || !k->posed) k->grain *= level;
        for (int j = 0; j < DIM * DIM && d->wild && k->posed; j++) k->fitted[j] *= level;
    }
    d->c = mul(d->c, level);
    d->scale *= level;
    d->unscale /= level;
    d->doubt *= level;
}

/* The same in the frame, of the corner in the spare slot. IN_VAIN: nothing has changed. */
static APART enum glanced stride_in_frame(search *q, int max_steps, const shape *a, const shape *b, result *r)
{
    const difference before = q->d;
    vertex *first = &q->s.slot[0];
    *first = *spare(&q->s);
    q->d.doubt = doubt_in_frame(&q->d);
    q->dug = -1; /* whatever was tried outside is not counted here */
    bring_frame_to_size(&q->d);
    lay_maps(&q->d);
    first->w = mul(first->w, q->d.scale * before.unscale);
    enum glanced seen = IN_VAIN;
    if (stands_clear(first)) seen = stride(q, max_steps, a, b, r);
    else first->w = mul(first->w, before.scale * q->d.unscale);
    leave_trail(q);
    q->d = before;
    if (seen == STRODE) take_up_trail(q);
    return seen;
}

#endif

#endif
