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

/* The apex or the rim below. */
static void farthest_of_cone(const peer_set *s, const double *dir, double *out)
{
    double length = sqrt(dir[0] * dir[0] + dir[1] * dir[1]), by = length > 0 ? s->size[0] / length : 0;
    if (2 * s->size[1] * dir[2] >= s->size[0] * length) {
        out[0] = out[1] = 0;
        out[2] = s->size[1];
    } else {
        out[0] = by * dir[0];
        out[1] = by * dir[1];
        out[2] = -s->size[1];
    }
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
    case PEER_CONE:
        farthest_of_cone(s, dir, out);
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

static const char tolerance[] = "tolerance", steps[] = "steps";

static ccd_t settings(const peer *p)
{
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = ccd.support2 = support;
    ccd.center1 = ccd.center2 = center;
    ccd.max_iterations = p->knob == steps ? (unsigned long)p->setting : 100;
    if (p->knob == tolerance) {
        ccd.epa_tolerance = ccd.mpr_tolerance = p->setting;
    }
    return ccd;
}

static int meet_by_gjk(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    ccd_t ccd = settings(p);
    (void)memory;
    out->meet = ccdGJKIntersect(a, b, &ccd) == 1;
    return 0;
}

static int meet_by_mpr(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    ccd_t ccd = settings(p);
    (void)memory;
    out->meet = ccdMPRIntersect(a, b, &ccd) == 1;
    return 0;
}

typedef int penetrate(const void *, const void *, const ccd_t *, ccd_real_t *, ccd_vec3_t *, ccd_vec3_t *);

/* They are said not to meet by -1; -2 is no answer. */
static int how_deep(penetrate *by, const peer *p, const void *a, const void *b, peer_answer *out)
{
    ccd_t ccd = settings(p);
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

static int deep_by_gjk(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    (void)memory;
    return how_deep(ccdGJKPenetration, p, a, b, out);
}

static int deep_by_mpr(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    (void)memory;
    return how_deep(ccdMPRPenetration, p, a, b, out);
}

/* ---- settings ---- */

#define MOST 32
#define FIXED "max_iterations 100 as its manual has it"

static peer all[MOST];
static int count_of_all;

static peer *add(int mpr, const char *knob, double setting)
{
    peer *p = &all[count_of_all++];
    memset(p, 0, sizeof *p);
    p->library = mpr ? "libccd MPR" : "libccd GJK";
    p->knob = knob;
    p->setting = setting;
    p->version = PEER_VERSION;
    p->how[INTERSECT] = mpr ? "ccdMPRIntersect, " FIXED : "ccdGJKIntersect, " FIXED;
    p->how[PENETRATION] = mpr ? "ccdMPRPenetration, " FIXED : "ccdGJKPenetration, " FIXED;
    p->how[DISTANCE] = "";
    p->dim = 3;
    p->single = sizeof(ccd_real_t) == sizeof(float);
    p->cores = ALL_CORES;
    p->poses = p->radii = 1;
    p->make = make;
    p->discard = free;
    p->query[PENETRATION] = mpr ? deep_by_mpr : deep_by_gjk;
    return p;
}

/* The tolerance that it comes with is the usual one; of whether they meet by GJK it knows none. */
const peer *gjk_peers(int *count)
{
    static const double tolerances[] = {1e-4, 1e-2, 1e-3, 1e-6, 1e-8, 1e-10, 1e-12};
    static const double iterations[] = {4, 8, 16, 32};
    count_of_all = 0;
    for (int mpr = 0; mpr < 2; mpr++) {
        for (int k = 0; k < (int)(sizeof tolerances / sizeof *tolerances); k++) {
            peer *p = add(mpr, tolerance, tolerances[k]);
            p->usual = k == 0;
            p->tolerance[PENETRATION] = tolerances[k];
            p->tolerance[INTERSECT] = mpr ? tolerances[k] : 0;
            if (mpr || k == 0) {
                p->query[INTERSECT] = mpr ? meet_by_mpr : meet_by_gjk;
            }
        }
        for (int k = 0; k < (int)(sizeof iterations / sizeof *iterations); k++) {
            peer *p = add(mpr, steps, iterations[k]);
            p->tolerance[PENETRATION] = tolerances[0];
            p->tolerance[INTERSECT] = mpr ? tolerances[0] : 0;
            p->query[INTERSECT] = mpr ? meet_by_mpr : meet_by_gjk;
        }
    }
    *count = count_of_all;
    return all;
}
