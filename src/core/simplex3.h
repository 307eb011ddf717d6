/* SPDX-License-Identifier: MIT */
/* What simplex.h asks of its dimension, in space: points, edges, triangles, tetrahedra. */
#ifndef GJK_CORE_SIMPLEX3_H
#define GJK_CORE_SIMPLEX3_H

#include "corners.h"

/* How narrow a triangle is: squared sines of its angle, ratios of its own areas, so that its size does not enter. They
 * choose between two ways to the same point; no bracket depends on them. Measured in docs/bounds.md.
 *
 * Its normal is off by UNIT over the sine. Below SLENDER that shows along the longer side, and is taken out there.
 * Below NARROW the rest shows too, and the triangle is projected onto side by side: v is then square to both to what
 * the narrower direction rounds, but off by a UNIT of the corners, however near it is. */
#define SLENDER ((real)1e-2) /* times |a|^2 |b|^2, against |a x b|^2: an angle of 0.1 */
#define NARROW ((real)1e-5)  /* likewise: 0.003 */

static inline vec cross(vec a, vec b)
{
    vec r = {{a.c[1] * b.c[2] - a.c[2] * b.c[1], a.c[2] * b.c[0] - a.c[0] * b.c[2], a.c[0] * b.c[1] - a.c[1] * b.c[0]}};
    return r;
}

static inline vec edge_to(const simplex *s, int i) { return sub(point(s, i), point(s, 0)); }

/* Two sides of a triangle and its normal, with their squared lengths. */
typedef struct sides {
    vec a, b, n;
    real aa, bb, nn;
} sides;

static inline sides sides_of(vec a, vec b)
{
    sides t = {.a = a, .b = b, .n = cross(a, b)};
    t.aa = dot(t.a, t.a);
    t.bb = dot(t.b, t.b);
    if (!(dot(t.n, t.n) > SLENDER * t.aa * t.bb))
        t.n = sub(t.n, t.aa > t.bb ? mul(t.a, dot(t.n, t.a) / t.aa) : mul(t.b, dot(t.n, t.b) / t.bb));
    t.nn = dot(t.n, t.n);
    return t;
}

/* Not true of NaN, which sides of no length give. */
static inline int has_normal(const sides *t) { return t->nn > NARROW * t->aa * t->bb; }

/* A triangle so narrow that its normal is mostly noise: onto its longer side first, then across it. The weights are of
 * p, of the far end of the longer side, and of the remaining corner. */
static void across(vec p, vec along, vec aside, vec *v, real weight[3])
{
    real ll = dot(along, along), lean = dot(aside, along) / ll, share = -dot(p, along) / ll;
    vec up = sub(aside, mul(along, lean)), foot = add(p, mul(along, share));
    real uu = dot(up, up);
    weight[2] = uu > 0 ? -dot(foot, up) / uu : 0;
    weight[1] = share - weight[2] * lean;
    weight[0] = 1 - weight[1] - weight[2];
    *v = add(foot, mul(up, weight[2]));
    if (uu > 0) *v = sub(*v, mul(up, dot(*v, up) / uu));
    *v = sub(*v, mul(along, dot(*v, along) / ll));
}

/* Where the origin projects onto the plane of the triangle, if that is inside it or outside by no more than the
 * leeway. Weights of p, q, r. */
static inline int face(vec p, vec q, vec r, real leeway, vec *v, real weight[3])
{
    sides t = sides_of(sub(q, p), sub(r, p));
    if (has_normal(&t)) {
        weight[1] = dot(t.n, cross(t.b, p));
        weight[2] = dot(t.n, cross(p, t.a));
        weight[0] = t.nn - weight[1] - weight[2];
        *v = mul(t.n, dot(t.n, p) / t.nn);
    } else if (!(t.aa > 0 && t.bb > 0)) {
        return 0;
    } else if (t.aa > t.bb) {
        across(p, t.a, t.b, v, weight);
    } else {
        across(p, t.b, t.a, v, weight);
        real swap = weight[1];
        weight[1] = weight[2];
        weight[2] = swap;
    }
    real least = -leeway * (weight[0] + weight[1] + weight[2]);
    return weight[0] > least && weight[1] > least && weight[2] > least;
}

/* Six times the signed volumes that the origin makes with the faces, as weights of the corners opposite. */
static int holds(const simplex *s, real weight[4])
{
    vec p = point(s, 3), a = sub(point(s, 0), p), b = sub(point(s, 1), p), c = sub(point(s, 2), p);
    vec bc = cross(b, c);
    real whole = dot(a, bc), turn = whole < 0 ? (real)-1 : (real)1;
    weight[0] = -dot(p, bc) * turn;
    weight[1] = -dot(p, cross(c, a)) * turn;
    weight[2] = -dot(p, cross(a, b)) * turn;
    weight[3] = dot(point(s, 0), cross(point(s, 1), point(s, 2))) * turn;
    return weight[0] > 0 && weight[1] > 0 && weight[2] > 0 && weight[3] > 0;
}

/* The part of the simplex that the mask picks: its point nearest the origin, if that is in its
 * interior, or outside by no more than the leeway. */
static int part(const simplex *s, unsigned mask, real leeway, vec *v, real weight[4])
{
    int k[4], n = 0;
    weight[0] = 1;
    for (int i = 0; i < s->n; i++)
        if (mask >> i & 1) k[n++] = i;
    *v = n == 1 ? point(s, k[0]) : axis(0, 0);
    if (n == 2) return edge(point(s, k[0]), point(s, k[1]), leeway, v, weight);
    if (n == 3) return face(point(s, k[0]), point(s, k[1]), point(s, k[2]), leeway, v, weight);
    return n == 4 ? holds(s, weight) : 1;
}

/* Corner k is in the answer: the face, else the better of its two edges there. */
static inline void nearest_on_face(const simplex *s, int i, int j, int k, footing *f)
{
    real weight[3];
    vec p = point(s, k);
    if (face(p, point(s, i), point(s, j), 0, &f->v, weight)) {
        f->mask = 1u << i | 1u << j | 1u << k;
        f->weight[k] = weight[0];
        f->weight[i] = weight[1];
        f->weight[j] = weight[2];
        return;
    }
    nearest_on_edge(s, gain(p, sub(point(s, j), p)) > gain(p, sub(point(s, i), p)) ? j : i, k, f);
}

/* The newest corner is in the answer: the origin is inside, or nearest to one of the three faces there that it sees. */
static void nearest_on_faces(const simplex *s, footing *f)
{
    static const int opposite[3][2] = {{1, 2}, {2, 0}, {0, 1}};
    real weight[4], least = REAL_MAX;
    footing two[2];
    int next = 0, found = 0;
    f->v = axis(0, 0);
    f->mask = 15;
    if (holds(s, f->weight)) return;
    EACH(weight[i] = f->weight[i]);
    for (int i = 0; i < 3; i++) {
        if (weight[i] > 0) continue;
        nearest_on_face(s, opposite[i][0], opposite[i][1], 3, &two[next]);
        real d = dot(two[next].v, two[next].v);
        if (d < least) {
            least = d;
            next = !next;
            found = 1;
        }
    }
    if (found) *f = two[!next];
    else nearest_on_face(s, 0, 1, 2, f); /* only rounding sends us here */
}

static vec nearest(simplex *s, real weight[4])
{
    footing f = {point(s, 0), 1, {1}};
    if (s->n == 2) nearest_on_edge(s, 0, 1, &f);
    if (s->n == 3) nearest_on_face(s, 0, 1, 2, &f);
    if (s->n == 4) nearest_on_faces(s, &f);
    stand_on(s, &f, weight);
    return f.v;
}

/* For a narrow triangle its longer side stands in. */
static vec square_to(const simplex *s, vec v)
{
    if (s->n != 2 && s->n != 3) return v;
    sides t = sides_of(edge_to(s, 1), edge_to(s, s->n - 1));
    if (has_normal(&t)) return mul(t.n, dot(t.n, v) / t.nn);
    return sub(v, t.aa > t.bb ? mul(t.a, dot(v, t.a) / t.aa) : mul(t.b, dot(v, t.b) / t.bb));
}

static void change(const simplex *s, vec way, real weight[4])
{
    sides t = sides_of(edge_to(s, 1), edge_to(s, s->n > 2 ? 2 : 1));
    for (int i = 0; i < 4; i++) weight[i] = 0;
    if (s->n == 4) {
        vec edge[3] = {t.a, t.b, edge_to(s, 3)}, share = shares_of(edge, way);
        memcpy(weight + 1, share.c, sizeof share.c);
    } else if (has_normal(&t)) {
        weight[1] = dot(t.n, cross(way, t.b)) / t.nn;
        weight[2] = dot(t.n, cross(t.a, way)) / t.nn;
    } else if (s->n > 1) {
        weight[t.aa < t.bb ? 2 : 1] = t.aa < t.bb ? dot(way, t.b) / t.bb : dot(way, t.a) / t.aa;
    }
    weight[0] = -weight[1] - weight[2] - weight[3];
}

static inline real rough_room(const simplex *s, const real weight[4])
{
    vec p = point(s, 3), a = sub(point(s, 0), p), b = sub(point(s, 1), p), c = sub(point(s, 2), p);
    vec bc = cross(b, c), ca = cross(c, a), ab = cross(a, b), last = add(add(bc, ca), ab);
    real far = dot(p, p);
    for (int i = 0; i < 3; i++) far = larger(dot(point(s, i), point(s, i)), far);
    real doubt = 128 * UNIT * far * root(far); /* docs/bounds.md */
    real least = (weight[0] - doubt) / length_or_more(bc);
    least = smaller((weight[1] - doubt) / length_or_more(ca), least);
    least = smaller((weight[2] - doubt) / length_or_more(ab), least);
    return smaller((weight[3] - doubt) / length_or_more(last), least) * (1 - 8 * UNIT);
}

static real room(const simplex *s)
{
    real least = REAL_MAX;
    for (int i = 0; i < 4; i++) {
        vec p = point(s, i), a = sub(point(s, (i + 1) % 4), p), b = sub(point(s, (i + 2) % 4), p);
        vec n = cross(a, b), f = sub(point(s, (i + 3) % 4), p);
        real inside = -dot(n, p), fourth = dot(n, f), l = length_or_more(n);
        if (fourth < 0) inside = -inside;
        /* docs/bounds.md: 9 for the products, and 6 for n's length where n is small beside a and b */
        real doubt = 16 * UNIT * length(a) * length(b) * (length(p) + length(f));
        if (!(size(fourth) > doubt)) return 0;
        least = smaller((inside - doubt) / l * (1 - 8 * UNIT), least);
    }
    return least;
}

#endif
