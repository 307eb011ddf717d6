/* SPDX-License-Identifier: MIT */
/* libccd: whether two convex sets meet and how deep, by GJK with EPA or by MPR, in double where it was built so. */
#include "peer.h"

#include <ccd/ccd.h>
#include <ccd/quat.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct convex {
    const peer_set *set;
    ccd_vec3_t center; /* the mean of the points, which lies inside; of other cores their middle */
} convex;

static double dot(const double *x, const double *y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

/* ---- supports, as its manual has them ---- */

static void farthest_point(const peer_set *s, const double *dir, double *out)
{
    double best = -INFINITY;
    int at = 0;
    for (int k = 0; k < s->count; k++) {
        double along = dot(s->v + 3 * k, dir);
        if (along > best) {
            best = along;
            at = k;
        }
    }
    memcpy(out, s->v + 3 * at, 3 * sizeof *out);
}

static void farthest_of_cylinder(const peer_set *s, const double *dir, double *out)
{
    double length = sqrt(dir[0] * dir[0] + dir[1] * dir[1]), by = length > 0 ? s->size[0] / length : 0;
    out[0] = by * dir[0];
    out[1] = by * dir[1];
    out[2] = dir[2] < 0 ? -s->size[1] : s->size[1];
}

static void farthest_of_ellipsoid(const peer_set *s, const double *dir, double *out)
{
    double x[3] = {s->size[0] * dir[0], s->size[1] * dir[1], s->size[2] * dir[2]}, length = sqrt(dot(x, x));
    for (int i = 0; i < 3; i++) {
        out[i] = length > 0 ? s->size[i] * x[i] / length : 0;
    }
}

static void farthest_of_core(const peer_set *s, const double *dir, double *out)
{
    switch (s->core) {
    case PEER_BOX:
        for (int i = 0; i < 3; i++) {
            out[i] = dir[i] < 0 ? -s->size[i] : s->size[i];
        }
        return;
    case PEER_CYLINDER:
        farthest_of_cylinder(s, dir, out);
        return;
    case PEER_ELLIPSOID:
        farthest_of_ellipsoid(s, dir, out);
        return;
    case PEER_ORIGIN:
        memset(out, 0, 3 * sizeof *out);
        return;
    default:
        farthest_point(s, dir, out);
    }
}

static void place(const peer_set *s, const double *x, double *out)
{
    for (int i = 0; i < 3; i++) {
        out[i] = dot(s->m + 3 * i, x) + s->p[i];
    }
}

static void support(const void *object, const ccd_vec3_t *dir, ccd_vec3_t *out)
{
    const peer_set *s = ((const convex *)object)->set;
    if (s->posed) {
        double back[3], x[3];
        for (int i = 0; i < 3; i++) {
            back[i] = s->m[i] * dir->v[0] + s->m[3 + i] * dir->v[1] + s->m[6 + i] * dir->v[2];
        }
        farthest_of_core(s, back, x);
        place(s, x, out->v);
    } else {
        farthest_of_core(s, dir->v, out->v);
    }
    if (s->radius > 0) {
        double length = sqrt(dot(dir->v, dir->v)), by = length > 0 ? s->radius / length : 0;
        for (int i = 0; i < 3; i++) {
            out->v[i] += by * dir->v[i];
        }
    }
}

static void center(const void *object, ccd_vec3_t *out) { *out = ((const convex *)object)->center; }

static void *make(const peer_set *set)
{
    convex *c = malloc(sizeof *c);
    if (c) {
        double mean[3] = {0};
        for (int k = 0; k < 3 * set->count; k++) {
            mean[k % 3] += set->v[k] / set->count;
        }
        c->set = set;
        memcpy(c->center.v, mean, sizeof mean);
        if (set->posed) {
            place(set, mean, c->center.v);
        }
    }
    return c;
}

/* ---- questions ---- */

static ccd_t settings(double tolerance)
{
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = ccd.support2 = support;
    ccd.center1 = ccd.center2 = center;
    ccd.max_iterations = 100;
    if (tolerance > 0) {
        ccd.epa_tolerance = ccd.mpr_tolerance = tolerance;
    }
    return ccd;
}

static int by_gjk(const void *a, const void *b, peer_answer *out)
{
    ccd_t ccd = settings(0);
    out->meet = ccdGJKIntersect(a, b, &ccd) == 1;
    return 0;
}

static int by_mpr(const void *a, const void *b, peer_answer *out)
{
    ccd_t ccd = settings(0);
    out->meet = ccdMPRIntersect(a, b, &ccd) == 1;
    return 0;
}

typedef int penetrate(const void *, const void *, const ccd_t *, ccd_real_t *, ccd_vec3_t *, ccd_vec3_t *);

/* They are said not to meet by -1; -2 is no answer. */
static int how_deep(penetrate *by, double tolerance, const void *a, const void *b, peer_answer *out)
{
    ccd_t ccd = settings(tolerance);
    ccd_real_t depth = 0;
    ccd_vec3_t dir = {{0}}, at;
    int said = by(a, b, &ccd, &depth, &dir, &at);
    out->meet = said == 0;
    out->depth = depth;
    for (int i = 0; i < 3; i++) {
        out->normal[i] = dir.v[i];
    }
    return said < -1;
}

#define FINE 1e-10

static int deep_by_gjk(const void *a, const void *b, peer_answer *out)
{
    return how_deep(ccdGJKPenetration, 0, a, b, out);
}

static int deep_by_mpr(const void *a, const void *b, peer_answer *out)
{
    return how_deep(ccdMPRPenetration, 0, a, b, out);
}

static int finely_by_gjk(const void *a, const void *b, peer_answer *out)
{
    return how_deep(ccdGJKPenetration, FINE, a, b, out);
}

static int finely_by_mpr(const void *a, const void *b, peer_answer *out)
{
    return how_deep(ccdMPRPenetration, FINE, a, b, out);
}

#define USUAL "max_iterations 100 as its manual has it, tolerance 1e-4 as it comes"
#define OF(title, asked, asked_how_deep, query, penetration)                                                           \
    {                                                                                                                  \
        title, PEER_VERSION, asked, asked_how_deep, 3, sizeof(ccd_real_t) == sizeof(float), 0, 1, 1, 0, make, free,    \
            query, penetration                                                                                         \
    }

const peer *const *gjk_peers(void)
{
    static const peer gjk =
        OF("libccd GJK", "ccdGJKIntersect, " USUAL, "ccdGJKPenetration, " USUAL, by_gjk, deep_by_gjk);
    static const peer mpr =
        OF("libccd MPR", "ccdMPRIntersect, " USUAL, "ccdMPRPenetration, " USUAL, by_mpr, deep_by_mpr);
    static const peer fine_gjk =
        OF("libccd GJK 1e-10", "", "ccdGJKPenetration, epa_tolerance 1e-10", NULL, finely_by_gjk);
    static const peer fine_mpr =
        OF("libccd MPR 1e-10", "", "ccdMPRPenetration, mpr_tolerance 1e-10", NULL, finely_by_mpr);
    static const peer *const all[] = {&gjk, &mpr, &fine_gjk, &fine_mpr, NULL};
    return all;
}
