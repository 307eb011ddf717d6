/* SPDX-License-Identifier: MIT */
/* The ready-made supports. Each is written against the same contract as anyone's: a farthest point out, the reach back,
 * NaN for both where the data describe no set. */
#ifndef GJK_CORE_SHAPES_H
#define GJK_CORE_SHAPES_H

#include "reach.h"
#include "indexed.h"

typedef pub(points) points;
typedef pub(indexed_points) indexed_points;
typedef pub(box) box;
typedef pub(segment) segment;
typedef pub(ball) ball;
typedef pub(ellipsoid) ellipsoid;
typedef pub(couple) couple;

/* A set's support in another unit: its point and its reach come times that power of two, so that what is small about a
 * small set is not lost to underflow on the way. NaN, and no point, where the data describe no set. */
typedef real support_in(real unit, const void *data, vec dir, vec *out);

/* The same as the contract has it: in the caller's unit. */
static real in_own_unit(support_in *f, const void *data, const real *dir, real *out)
{
    vec x = nowhere();
    real reach = f(1, data, load(dir), &x);
    store(out, x);
    return reach;
}

/* The answer of data that describe no set. */
static real refuse(real *out)
{
    store(out, nowhere());
    return (real)NAN;
}

/* Sizes are finite and not negative. */
static int sized(const real *sizes, int n)
{
    int r = 1;
    for (int i = 0; i < n; i++) r &= sizes[i] >= 0 && sizes[i] <= REAL_MAX;
    return r;
}

/* A reach: r, with up to 7 relative roundings, and some that underflow where r does; the least number for a set of no
 * size, which rounds nothing. */
static inline real padded(real r) { return r > 0 ? r * (1 + 8 * UNIT) + (r < REAL_MIN ? 4 * TINY : 0) : TINY; }

/* A bound on the length, tight for the cube and along the axes, without square roots, safe from overflow in between. */
static inline real at_most(vec a)
{
    real box_diagonal = (real)(DIM == 2 ? 1.4142136 : 1.7320509) * peak(a);
    return padded(smaller(spread(a), box_diagonal));
}

/* Along dir, length l; where its square might leave the range it is brought to size 1 first, to the same bits. The zero
 * vector for none. */
static vec along(vec dir, real l)
{
    const real square = dot(dir, dir);
    if (!unruly(square) && !unruly(l)) return mul(dir, l / root(square));
    if (!(peak(dir) > 0)) return axis(0, 0);
    dir = unit_size(dir);
    return mul(dir, l / length(dir));
}

static size_t stride_of(const points *p) { return p->stride ? p->stride / sizeof(real) : DIM; }

static int cloud(const points *p)
{
    return p->v && p->count > 0 && p->stride % sizeof(real) == 0 &&
           (p->stride == 0 || p->stride >= DIM * sizeof(real)) && p->reach >= 0;
}

GJK_API real pub(points_reach)(const points *p)
{
    if (!p || !cloud(p)) return (real)NAN;
    real far = 0, sum = 0;
    size_t step = stride_of(p);
    for (size_t i = 0; i < p->count; i++) {
        vec x = load(p->v + i * step);
        if (!(spread(x) <= REAL_MAX)) return (real)NAN;
        far = larger(peak(x), far);
    }
    if (far == 0) return padded(0);
    real level = leveler(far);
    for (size_t i = 0; i < p->count; i++) {
        vec x = mul(load(p->v + i * step), level);
        sum = larger(dot(x, x), sum);
    }
    return padded(root(sum) / level);
}

/* The index that the cloud has been given; NULL: none, or one of other points, or of another
 * reach. */
static inline const uint32_t *index_of_cloud(const points *p)
{
    if (p->indexed != 1) return NULL;
    const uint32_t *index = ((const indexed_points *)(const void *)p)->index;
    return index && is_index_of(index, p->count, p->reach) ? index : NULL;
}

static inline list list_of_cloud(const points *p)
{
    return (list){p->v, p->count, stride_of(p), p->reach, index_of_cloud(p)};
}

#define MOST_INDEXED (UINT32_MAX / 128) /* so that sizes are numbers of 32 bits */

GJK_API size_t pub(index_points)(indexed_points *p, void *memory, size_t bytes)
{
    if (p && memory) p->points.indexed = 0;
    if (!p || !cloud(&p->points) || p->points.count > MOST_INDEXED) return 0;
    if ((uintptr_t)memory % sizeof(uint32_t) != 0) return 0;
    if (!(pub(points_reach)(&p->points) <= p->points.reach && p->points.reach <= REAL_MAX / 8)) return 0;
    const list l = {p->points.v, p->points.count, stride_of(&p->points), p->points.reach, NULL};
    const size_t end = memory ? bytes / sizeof(uint32_t) : 0, size = make_index(&l, memory, end);
    if (size <= end) {
        p->index = memory;
        p->points.indexed = 1;
    }
    return size * sizeof(uint32_t);
}

GJK_API real pub(support_points)(const void *data, const real dir[DIM], real out[DIM])
{
    const points *p = data;
    if (!p || !cloud(p)) return refuse(out);
    const list l = list_of_cloud(p);
    size_t best = farthest_apart(&l, load(dir), WARY);
    if (best == p->count) return refuse(out);
    store(out, nth_of(&l, best));
    return p->reach;
}

static inline vec corner_of_box(const box *b, vec dir)
{
    vec r;
    EACH(r.c[i] = signed_as(b->half[i], dir.c[i]));
    return r;
}

GJK_API real pub(support_box)(const void *data, const real dir[DIM], real out[DIM])
{
    const box *b = data;
    if (!b || !sized(b->half, DIM)) return refuse(out);
    store(out, corner_of_box(b, load(dir)));
    return at_most(load(b->half));
}

/* Of n corners, packed. */
static inline real reach_of(const real *v, size_t n)
{
    real reach = 0;
    for (size_t i = 0; i < n; i++) reach = larger(at_most(load(v + DIM * i)), reach);
    return reach;
}

static inline list list_of(const real (*v)[DIM], size_t n) { return (list){v[0], n, DIM, reach_of(v[0], n), NULL}; }

/* Among n corners. */
static real farthest_of(const real (*v)[DIM], size_t n, const real dir[DIM], real out[DIM])
{
    list l = list_of(v, n);
    size_t best = l.reach <= REAL_MAX ? farthest_of_few(&l, load(dir), WARY) : n;
    if (best == n) return refuse(out);
    store(out, load(v[best]));
    return l.reach;
}

GJK_API real pub(support_segment)(const void *data, const real dir[DIM], real out[DIM])
{
    const segment *s = data;
    return s ? farthest_of(s->v, 2, dir, out) : refuse(out);
}

GJK_API real pub(support_origin)(const void *unused, const real dir[DIM], real out[DIM])
{
    (void)unused;
    (void)dir;
    EACH(out[i] = 0);
    return padded(0);
}

static real ball_in(real unit, const void *data, vec dir, vec *out)
{
    const ball *b = data;
    if (!b || !sized(&b->radius, 1)) return (real)NAN;
    *out = along(dir, b->radius * unit);
    return padded(b->radius * unit);
}

GJK_API real pub(support_ball)(const void *data, const real dir[DIM], real out[DIM])
{
    return in_own_unit(ball_in, data, dir, out);
}

static inline vec stretched(vec x, vec by)
{
    EACH(x.c[i] *= by.c[i]);
    return x;
}

/* The radii times the unit vector along (radii times dir). Where that is of no plain size both are brought to size
 * first: what underflows then is far below the rounding. */
static real ellipsoid_in(real unit, const void *data, vec dir, vec *out)
{
    const ellipsoid *e = data;
    if (!e || !sized(e->radii, DIM)) return (real)NAN;
    const vec r = mul(load(e->radii), unit);
    vec g = stretched(dir, r);
    if (unruly(dot(g, g))) g = stretched(unit_size(dir), mul(r, leveler(peak(r))));
    g = along(g, 1);
    EACH(out->c[i] = r.c[i] * g.c[i]);
    return padded(peak(r));
}

GJK_API real pub(support_ellipsoid)(const void *data, const real dir[DIM], real out[DIM])
{
    return in_own_unit(ellipsoid_in, data, dir, out);
}

#if DIM == 3
typedef pub(triangle) triangle;
typedef pub(cylinder) cylinder;
typedef pub(cone) cone;
typedef pub(disc) disc;

GJK_API real pub(support_triangle)(const void *data, const real dir[DIM], real out[DIM])
{
    const triangle *t = data;
    return t ? farthest_of(t->v, 3, dir, out) : refuse(out);
}

/* The rim point of the disc of that radius at that height. */
static vec rim(vec dir, real radius, real height)
{
    dir.c[2] = 0;
    dir = along(dir, radius);
    dir.c[2] = height;
    return dir;
}

static real disc_in(real unit, const void *data, vec dir, vec *out)
{
    const disc *d = data;
    if (!d || !sized(&d->radius, 1)) return (real)NAN;
    *out = rim(dir, d->radius * unit, 0);
    return padded(d->radius * unit);
}

GJK_API real pub(support_disc)(const void *data, const real dir[DIM], real out[DIM])
{
    return in_own_unit(disc_in, data, dir, out);
}

static real cylinder_in(real unit, const void *data, vec dir, vec *out)
{
    const cylinder *c = data;
    if (!c || !sized(&c->radius, 1) || !sized(&c->half_length, 1)) return (real)NAN;
    vec corner = {{c->radius * unit, c->half_length * unit, 0}};
    *out = rim(dir, corner.c[0], signed_as(corner.c[1], dir.c[2]));
    return at_most(corner);
}

GJK_API real pub(support_cylinder)(const void *data, const real dir[DIM], real out[DIM])
{
    return in_own_unit(cylinder_in, data, dir, out);
}

/* The apex is h up the axis, the rim h down and r out: the rim is farther where r |flat| > 2 h dir_z. */
static real cone_in(real unit, const void *data, vec dir, vec *out)
{
    const cone *c = data;
    if (!c || !sized(&c->radius, 1) || !sized(&c->half_length, 1)) return (real)NAN;
    vec d = unit_size(dir), corner = {{c->radius * unit, c->half_length * unit, 0}};
    real level = leveler(larger(peak(corner), REAL_MIN)), up = 2 * (corner.c[1] * level) * d.c[2];
    real flat = root(d.c[0] * d.c[0] + d.c[1] * d.c[1]);
    *out = corner.c[0] * level * flat > up ? rim(dir, corner.c[0], -corner.c[1]) : axis(2, corner.c[1]);
    return at_most(corner);
}

GJK_API real pub(support_cone)(const void *data, const real dir[DIM], real out[DIM])
{
    return in_own_unit(cone_in, data, dir, out);
}
#endif

/* What is known of a set before it is asked. */
typedef struct view {
    support_in *in; /* of a ready-made round set: to be asked instead */
    real size;      /* to a binade or two, of a ready-made set; NaN: not known, or no set */
} view;

/* A power of two: the set's size in it is 1; 1 where that is not known. */
static real own_unit(const view *k) { return k->size >= 0 ? leveler(k->size) : 1; }

static inline view know(const shape *s);

/* ---- two as one ---- */

/* The direction as the part sees it, of a size that keeps its heights from underflow: those of a part whose size is not
 * known are then of the size that the couple sees. */
static vec seen_by(const pose *p, real grows, real unit, vec dir)
{
    vec d = levelled(dir);
    real lift = 16 / leveler(peak(dir));
    if (p) {
        if (grows > 0) d = levelled(pull(p->m, mul(d, leveler(grows))));
        lift = grows > 0 ? lift / leveler(grows) : 0;
    }
    lift = larger(lift, unit);
    return mul(d, smaller(larger(lift, 1), LIFT));
}

/* The set's own point, times the unit for its size, and its reach alike. It is surveyed where the part does not say:
 * what couples round on the way is charged by the reach, so it must be known, and from outside that can't be done. */
static real core_in(const view *k, const shape *s, vec dir, vec *x)
{
    *x = nowhere();
    if (k->in) return k->in(own_unit(k), s->data, dir, x);
    real reach = s->support(s->data, dir.c, x->c);
    if (reach == 0) reach = surveyed(s->support, s->data, 0);
    if (faint(reach)) reach += 16 * REAL_MIN;
    *x = mul(*x, own_unit(k));
    return reach * own_unit(k);
}

/* A power of two that brings the map to size, and points of size 1 through it; of others it is not known what it would
 * do to them. */
static real level_for(const view *k, real grows)
{
    return grows > 0 && k->size >= 0 ? smaller(leveler(grows), 1 / (16 * REAL_MIN)) : 1;
}

/* One of a couple in that unit, pose and radius included. Its reach counts all that passes through the rounding here,
 * what underflows too, so that the licence of 8 roundings holds for the couple. The part is of size 1 in a unit of its
 * own, its map is brought to size, and the exponents come together in one. */
static real part_in(real unit, const shape *s, vec dir, vec *out)
{
    const pose *p = s->pose;
    real grows = p ? stretch(p->m) : 1;
    if (!s->support || !sized(&s->radius, 1) || !(grows <= REAL_MAX)) return (real)NAN;
    view k = know(s);
    real reach = core_in(&k, s, seen_by(p, grows, own_unit(&k), dir), out);
    int found = reach > 0;
    if (k.size == 0) reach = 0;
    real level = level_for(&k, grows);
    real back = grows > 0 ? raised(1, exponent_of(unit) - exponent_of(own_unit(&k)) - exponent_of(level)) : 0;
    if (p) {
        vec at = mul(load(p->p), unit);
        real m[DIM * DIM]; /* not the point: where its unit can't bring it to size, it is small */
        for (int i = 0; i < DIM * DIM; i++) m[i] = p->m[i] * level;
        *out = add(mul(map(m, *out), back), at);
        reach = 4 * (grows * level * reach) * back + spread(at);
    } else {
        *out = mul(*out, back);
        reach *= back;
    }
    if (s->radius > 0) *out = add(*out, along(dir, s->radius * unit));
    EACH(found &= bounded(out->c[i]));
    return found ? reach + s->radius * unit + 64 * TINY : (real)NAN;
}

/* A couple's reach, which must be finite; so must its parts'. */
static real joint(real reach_a, real reach_b, real reach)
{
    return reach_a <= REAL_MAX && reach_b <= REAL_MAX ? reach : (real)NAN;
}

static real sum_in(real unit, const void *data, vec dir, vec *out)
{
    const couple *c = data;
    vec a, b;
    if (!c) return (real)NAN;
    real reach_a = part_in(unit, &c->a, dir, &a), reach_b = part_in(unit, &c->b, dir, &b);
    *out = add(a, b);
    return joint(reach_a, reach_b, 2 * (reach_a + reach_b));
}

GJK_API real pub(support_sum)(const void *data, const real dir[DIM], real out[DIM])
{
    return in_own_unit(sum_in, data, dir, out);
}

static real hull_in(real unit, const void *data, vec dir, vec *out)
{
    const couple *c = data;
    vec a, b;
    if (!c) return (real)NAN;
    real reach_a = part_in(unit, &c->a, dir, &a), reach_b = part_in(unit, &c->b, dir, &b);
    *out = dot(dir, a) >= dot(dir, b) ? a : b;
    return joint(reach_a, reach_b, 2 * larger(reach_a, reach_b));
}

GJK_API real pub(support_hull)(const void *data, const real dir[DIM], real out[DIM])
{
    return in_own_unit(hull_in, data, dir, out);
}

/* ---- what the search knows of them ---- */

/* What data are made of: so many numbers and nothing else, or one of these. */
#define CLOUD (-1)
#define COUPLE (-2)
#define UNKNOWN (-3)

typedef struct ready {
    int data;
    support_in *in; /* NULL: a hull of corners, which are numbers of the caller's */
} ready;

static inline ready ready_of(support_fn *f)
{
    if (f == pub(support_points)) return (ready){CLOUD, NULL};
    if (f == pub(support_box)) return (ready){DIM, NULL};
    if (f == pub(support_segment)) return (ready){2 * DIM, NULL};
    if (f == pub(support_origin)) return (ready){0, NULL};
#if DIM == 3
    if (f == pub(support_triangle)) return (ready){3 * DIM, NULL};
    if (f == pub(support_cylinder)) return (ready){2, cylinder_in};
    if (f == pub(support_cone)) return (ready){2, cone_in};
    if (f == pub(support_disc)) return (ready){1, disc_in};
#endif
    if (f == pub(support_ball)) return (ready){1, ball_in};
    if (f == pub(support_ellipsoid)) return (ready){DIM, ellipsoid_in};
    if (f == pub(support_sum)) return (ready){COUPLE, sum_in};
    if (f == pub(support_hull)) return (ready){COUPLE, hull_in};
    return (ready){UNKNOWN, NULL};
}

/* By its reach. That is the least number for a cloud of no size, which must not count as one of that size; so there the
 * points themselves are asked. */
static real size_of_cloud(const points *p)
{
    if (!(p->reach > 0)) return (real)NAN;
    real far = p->reach > TINY ? p->reach : 0;
    for (size_t i = 0; i < p->count && !(far > 0); i++) far = larger(peak(load(p->v + i * stride_of(p))), far);
    return far;
}

/* Of a part, as the couple sees it. */
static real size_in_couple(const shape *s)
{
    real far = know(s).size, grows = 0;
    if (!s->pose) return far + s->radius;
    for (int i = 0; i < DIM * DIM; i++) grows = larger(size(s->pose->m[i]), grows);
    return far * grows + s->radius + peak(load(s->pose->p));
}

static real size_of_couple(const couple *c) { return size_in_couple(&c->a) + size_in_couple(&c->b); }

static inline view know(const shape *s)
{
    ready k = ready_of(s->support);
    view unknown = {NULL, (real)NAN};
    real far = 0;
    if (k.data == UNKNOWN || (!s->data && k.data != 0)) return unknown;
    if (k.data == CLOUD) far = size_of_cloud(s->data);
    if (k.data == COUPLE) far = size_of_couple(s->data);
    for (int i = 0; i < k.data; i++) far = larger(size(((const real *)s->data)[i]), far);
    return far <= REAL_MAX ? (view){k.in, far} : unknown;
}

/* Whether the set is known to be the hull of corners that can be listed. */
static int has_corners(const shape *s)
{
    ready k = ready_of(s->support);
    return k.data != UNKNOWN && !k.in;
}

static int is_box(const shape *s) { return s->support == pub(support_box); }

/* How many, of a set that has them, and whose support has found the data good. */
static size_t count_corners(const shape *s)
{
    int n = ready_of(s->support).data;
    if (n == CLOUD) return ((const points *)s->data)->count;
    if (is_box(s)) return (size_t)1 << DIM;
    return n > 0 ? (size_t)n / DIM : 1;
}

static vec nth_corner(const shape *s, size_t n)
{
    vec r = axis(0, 0);
    if (s->support == pub(support_points)) {
        const points *p = s->data;
        return load(p->v + n * stride_of(p));
    }
    if (is_box(s)) {
        r = load(((const box *)s->data)->half);
        EACH(r.c[i] = n >> i & 1 ? -r.c[i] : r.c[i]);
    }
    if (s->support == pub(support_segment)) return load(((const segment *)s->data)->v[n]);
#if DIM == 3
    if (s->support == pub(support_triangle)) return load(((const triangle *)s->data)->v[n]);
#endif
    return r;
}

#endif
