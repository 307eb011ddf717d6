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

/* No point of a set, nor one found, lies farther out than far; and what is found is off the set, or short, by no more
 * than 8 roundings of due. Of a couple far grows with its parts' far, and due with how far they are and are due: so
 * they are told apart until the contract asks for one number, which is both. */
typedef struct reaches {
    real far, due;
} reaches;

static inline reaches both_of(real reach) { return (reaches){reach, reach}; }

/* A set's support in another unit: its point and its reaches come times that power of two, so that what is small about
 * a small set is not lost to underflow on the way. NaN, and no point, where the data describe no set. */
typedef reaches support_in(real unit, const void *data, vec dir, vec *out);

/* As the contract has it, in that unit. */
static inline real reach_in(support_in *f, real unit, const void *data, vec dir, vec *out)
{
    const reaches r = f(unit, data, dir, out);
    return r.far >= r.due ? r.far : r.due; /* NaN where both are */
}

/* And in the caller's. */
static real in_own_unit(support_in *f, const void *data, const real *dir, real *out)
{
    vec x = nowhere();
    const real reach = reach_in(f, 1, data, load(dir), &x);
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

/* Of points that are not packed: one is in it. */
HOT int is_stride(const points *p) { return p->stride % sizeof(real) == 0 && p->stride >= DIM * sizeof(real); }

static int cloud(const points *p) { return p->v && p->count > 0 && (p->stride == 0 || is_stride(p)) && p->reach >= 0; }

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

static reaches ball_in(real unit, const void *data, vec dir, vec *out)
{
    const ball *b = data;
    if (!b || !sized(&b->radius, 1)) return both_of((real)NAN);
    *out = along(dir, b->radius * unit);
    return both_of(padded(b->radius * unit));
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
static reaches ellipsoid_in(real unit, const void *data, vec dir, vec *out)
{
    const ellipsoid *e = data;
    if (!e || !sized(e->radii, DIM)) return both_of((real)NAN);
    const vec r = mul(load(e->radii), unit);
    vec g = stretched(dir, r);
    if (unruly(dot(g, g))) g = stretched(unit_size(dir), mul(r, leveler(peak(r))));
    g = along(g, 1);
    EACH(out->c[i] = r.c[i] * g.c[i]);
    return both_of(padded(peak(r)));
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

static reaches disc_in(real unit, const void *data, vec dir, vec *out)
{
    const disc *d = data;
    if (!d || !sized(&d->radius, 1)) return both_of((real)NAN);
    *out = rim(dir, d->radius * unit, 0);
    return both_of(padded(d->radius * unit));
}

GJK_API real pub(support_disc)(const void *data, const real dir[DIM], real out[DIM])
{
    return in_own_unit(disc_in, data, dir, out);
}

static reaches cylinder_in(real unit, const void *data, vec dir, vec *out)
{
    const cylinder *c = data;
    if (!c || !sized(&c->radius, 1) || !sized(&c->half_length, 1)) return both_of((real)NAN);
    vec corner = {{c->radius * unit, c->half_length * unit, 0}};
    *out = rim(dir, corner.c[0], signed_as(corner.c[1], dir.c[2]));
    return both_of(at_most(corner));
}

GJK_API real pub(support_cylinder)(const void *data, const real dir[DIM], real out[DIM])
{
    return in_own_unit(cylinder_in, data, dir, out);
}

/* The apex is h up the axis, the rim h down and r out: the rim is farther where r |flat| > 2 h dir_z. */
static reaches cone_in(real unit, const void *data, vec dir, vec *out)
{
    const cone *c = data;
    if (!c || !sized(&c->radius, 1) || !sized(&c->half_length, 1)) return both_of((real)NAN);
    vec d = unit_size(dir), corner = {{c->radius * unit, c->half_length * unit, 0}};
    real level = leveler(larger(peak(corner), REAL_MIN)), up = 2 * (corner.c[1] * level) * d.c[2];
    real flat = root(d.c[0] * d.c[0] + d.c[1] * d.c[1]);
    *out = corner.c[0] * level * flat > up ? rim(dir, corner.c[0], -corner.c[1]) : axis(2, corner.c[1]);
    return both_of(at_most(corner));
}

GJK_API real pub(support_cone)(const void *data, const real dir[DIM], real out[DIM])
{
    return in_own_unit(cone_in, data, dir, out);
}
#endif

/* ---- what is known of them ---- */

/* What data are made of: so many numbers and nothing else, or one of these. */
#define CLOUD (-1)
#define COUPLE (-2)
#define UNKNOWN (-3)

static support_in sum_in, hull_in;

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

/* What is known of a set before it is asked. */
typedef struct view {
    support_in *in; /* of a ready-made round set: to be asked instead */
    real size;      /* to a binade or two, of a ready-made set; NaN: not known, or no set */
} view;

/* A power of two: the set's size in it is 1; 1 where that is not known. */
static real own_unit(const view *k) { return k->size >= 0 ? leveler(k->size) : 1; }

/* By its reach. That is the least number for a cloud of no size, which must not count as one of that size; so there the
 * points themselves are asked. */
static real size_of_cloud(const points *p)
{
    if (!(p->reach > 0)) return (real)NAN;
    real far = p->reach > TINY ? p->reach : 0;
    for (size_t i = 0; i < p->count && !(far > 0); i++) far = larger(peak(load(p->v + i * stride_of(p))), far);
    return far;
}

static inline view know(const shape *s);

/* Of a set through its map. */
static real size_through_map(const shape *s)
{
    const real far = know(s).size;
    real grows = 0;
    if (!s->pose) return far;
    for (int i = 0; i < DIM * DIM; i++) grows = larger(size(s->pose->m[i]), grows);
    return far > 0 && grows > 0 ? larger(far * grows, TINY) : far * grows; /* not 0: that is of no size at all */
}

/* Of a part, as the couple sees it. */
static real size_in_couple(const shape *s)
{
    const real far = size_through_map(s) + s->radius;
    return s->pose ? far + peak(load(s->pose->p)) : far;
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

/* ---- two as one ---- */

/* A map times a power of two. */
static void scale_map(const real *m, real level, real scaled[DIM * DIM])
{
    for (int i = 0; i < DIM * DIM; i++) scaled[i] = m[i] * level;
}

/* The direction as the part sees it, of a size that keeps its heights from underflow: those of a part whose size is not
 * known are then of the size that the couple sees. */
static vec seen_by(const pose *p, real grows, real unit, vec dir)
{
    vec d = levelled(dir);
    real lift = 16 / leveler(peak(dir));
    if (p) {
        real m[DIM * DIM]; /* not the direction, which would lose digits to the largest maps */
        scale_map(p->m, leveler(grows), m);
        if (grows > 0) d = levelled(pull(m, d));
        lift = grows > 0 ? lift / leveler(grows) : 0;
    }
    lift = larger(lift, unit);
    return mul(d, smaller(larger(lift, 1), LIFT));
}

/* As a set says it that is none of a ready-made round kind. It is surveyed where it does not: what couples round on the
 * way is charged by the reach, so it must be known, and from outside that can't be done. */
static reaches reaches_told(const shape *s, vec dir, vec *x)
{
    const real reach = s->support(s->data, dir.c, x->c);
    return both_of(reach == 0 ? surveyed(s->support, s->data, 0) : reach);
}

/* What is due for products that underflow in the support of a small set, or, where its size is not known and its unit
 * 1, in what the couple does with its points: 64 tiny. */
#define UNDERFLOW (16 * REAL_MIN)

/* The set's own point, times the unit for its size, and its reaches alike. */
static reaches core_in(const view *k, const shape *s, vec dir, vec *x)
{
    support_in *in = ready_of(s->support).in;
    const real unit = own_unit(k);
    *x = nowhere();
    if (k->in) return k->in(unit, s->data, dir, x);
    reaches r = in ? in(1, s->data, dir, x) : reaches_told(s, dir, x); /* a couple of unknown size, or corners */
    if (r.due > TINY && r.due < (k->size >= 0 ? REAL_MIN : REAL_MIN / UNIT)) r.due += UNDERFLOW;
    *x = mul(*x, unit);
    return (reaches){r.far * unit, r.due * unit};
}

/* A power of two that brings the map to size, and points of size 1 through it; of others it is not known what it would
 * do to them. */
static real level_for(const view *k, real grows)
{
    return grows > 0 && k->size >= 0 ? smaller(leveler(grows), 1 / (16 * REAL_MIN)) : 1;
}

/* No vector grows by more under the map, of that stretch, than by this share of it: of a turn the stretch may be the
 * root of DIM, which a couple of couples of couples would multiply. The largest row sum of m^T m is off by 3 roundings
 * of the stretch's square, and some of itself. */
static real share_of_stretch(const real *m, real grows)
{
    const real level = leveler(grows), square = (grows * level) * (grows * level);
    vec column[DIM], row = axis(0, 0);
    for (int j = 0; j < DIM; j++) EACH(column[j].c[i] = m[DIM * i + j] * level);
    for (int j = 0; j < DIM; j++) {
        row.c[j] += dot(column[j], column[j]);
        for (int k = 0; k < j; k++) {
            const real skew = size(dot(column[j], column[k]));
            row.c[j] += skew;
            row.c[k] += skew;
        }
    }
    return smaller(root(peak(row) / square + 16 * UNIT), 1);
}

/* The reaches of a set through a map, and moved so far; r is its own, times the map's stretch. The direction it is
 * asked along is off by 3 roundings of that, across a set twice as wide as it reaches; its point then by 3, and by 1 of
 * all. How much less than it stretches a map grows lengths is asked of couples alone, whose reaches are two. */
static reaches reaches_posed(reaches r, const real *m, real grows, real moved)
{
    const real share = r.due != r.far ? share_of_stretch(m, grows) : 1, whole = share * r.far + moved;
    return (reaches){whole, share * r.due + 9 * r.far / 8 + whole / 8};
}

/* Of a set grown by a ball, whose point is off by 4.5 roundings of the radius, and then by 1 of all. */
static reaches reaches_grown(reaches r, real radius)
{
    const real whole = r.far + radius;
    return (reaches){whole, r.due + 9 * radius / 16 + whole / 8};
}

/* One of a couple in that unit, pose and radius included. Its reaches count all that passes through the rounding here,
 * what underflows too, and their own. The part is of size 1 in a unit of its own, its map is brought to size, and the
 * exponents come together in one. */
static reaches part_in(real unit, const shape *s, vec dir, vec *out)
{
    const pose *p = s->pose;
    real grows = p ? stretch(p->m) : 1;
    if (!s->support || !sized(&s->radius, 1) || !(grows <= REAL_MAX)) return both_of((real)NAN);
    view k = know(s);
    reaches r = core_in(&k, s, seen_by(p, grows, own_unit(&k), dir), out);
    int found = r.far > 0;
    if (k.size == 0) r = both_of(0);
    real level = level_for(&k, grows), radius = s->radius * unit;
    real back = grows > 0 ? raised(1, exponent_of(unit) - exponent_of(own_unit(&k)) - exponent_of(level)) : 0;
    if (p) {
        vec at = mul(load(p->p), unit);
        real m[DIM * DIM], all = grows * level; /* not the point: where its unit can't bring it to size, it is small */
        scale_map(p->m, level, m);
        *out = add(mul(map(m, *out), back), at);
        r = (reaches){all * r.far * back, all * r.due * back};
        r = reaches_posed(r, p->m, grows, spread(at));
    } else {
        *out = mul(*out, back);
        r = (reaches){r.far * back, r.due * back};
    }
    if (s->radius > 0) {
        *out = add(*out, along(dir, radius));
        r = reaches_grown(r, radius);
    }
    EACH(found &= bounded(out->c[i]));
    const real up = 1 + 16 * UNIT;
    return found ? (reaches){r.far * up + 64 * TINY, r.due * up + 64 * TINY} : both_of((real)NAN);
}

static int reaches_finitely(reaches r) { return r.far <= REAL_MAX && r.due <= REAL_MAX; }

/* Of a couple of such parts, which must be finite, too. */
static reaches reaches_of_couple(reaches a, reaches b, real far, real due)
{
    return reaches_finitely(a) && reaches_finitely(b) ? (reaches){far, due} : both_of((real)NAN);
}

/* The sum of the points is off by 1 rounding of all. */
static reaches sum_in(real unit, const void *data, vec dir, vec *out)
{
    const couple *c = data;
    vec a, b;
    if (!c) return both_of((real)NAN);
    const reaches of_a = part_in(unit, &c->a, dir, &a), of_b = part_in(unit, &c->b, dir, &b);
    const real far = (of_a.far + of_b.far) * (1 + 4 * UNIT);
    *out = add(a, b);
    return reaches_of_couple(of_a, of_b, far, of_a.due + of_b.due + far / 8);
}

GJK_API real pub(support_sum)(const void *data, const real dir[DIM], real out[DIM])
{
    return in_own_unit(sum_in, data, dir, out);
}

/* Heights are off by 3 roundings, so of two the lower may win by 6. */
static reaches hull_in(real unit, const void *data, vec dir, vec *out)
{
    const couple *c = data;
    vec a, b;
    if (!c) return both_of((real)NAN);
    const reaches of_a = part_in(unit, &c->a, dir, &a), of_b = part_in(unit, &c->b, dir, &b);
    const real far = larger(of_a.far, of_b.far);
    if (!(peak(dir) >= (real)0.0625)) dir = levelled(dir); /* heights along it would underflow */
    *out = dot(dir, a) >= dot(dir, b) ? a : b;
    return reaches_of_couple(of_a, of_b, far, larger(of_a.due, of_b.due) + 3 * far / 4);
}

GJK_API real pub(support_hull)(const void *data, const real dir[DIM], real out[DIM])
{
    return in_own_unit(hull_in, data, dir, out);
}

/* ---- their corners ---- */

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
