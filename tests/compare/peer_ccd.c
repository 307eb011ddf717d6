/* SPDX-License-Identifier: MIT */
/* libccd: whether two convex sets meet, by GJK or by MPR, in double where it was built so. */
#include "peer.h"

#include <ccd/ccd.h>
#include <ccd/quat.h>
#include <math.h>
#include <stdlib.h>

typedef struct hull {
    const peer_set *set;
    ccd_vec3_t center; /* the mean of the points, which lies inside */
} hull;

static void support(const void *object, const ccd_vec3_t *dir, ccd_vec3_t *out)
{
    const peer_set *s = ((const hull *)object)->set;
    double best = -INFINITY, length = sqrt(dir->v[0] * dir->v[0] + dir->v[1] * dir->v[1] + dir->v[2] * dir->v[2]);
    int at = 0;
    for (int k = 0; k < s->count; k++) {
        const double *x = s->v + 3 * k;
        double along = x[0] * dir->v[0] + x[1] * dir->v[1] + x[2] * dir->v[2];
        if (along > best) {
            best = along;
            at = k;
        }
    }
    for (int i = 0; i < 3; i++) {
        out->v[i] = s->v[3 * at + i] + (length > 0 ? s->radius * dir->v[i] / length : 0);
    }
}

static void center(const void *object, ccd_vec3_t *out) { *out = ((const hull *)object)->center; }

static void *make(const peer_set *set)
{
    hull *h = malloc(sizeof *h);
    if (h) {
        double sum[3] = {0};
        for (int k = 0; k < 3 * set->count; k++) {
            sum[k % 3] += set->v[k] / set->count;
        }
        h->set = set;
        ccdVec3Set(&h->center, sum[0], sum[1], sum[2]);
    }
    return h;
}

static ccd_t settings(void)
{
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = ccd.support2 = support;
    ccd.center1 = ccd.center2 = center;
    ccd.max_iterations = 100;
    return ccd;
}

static int by_gjk(const void *a, const void *b, peer_answer *out)
{
    ccd_t ccd = settings();
    out->meet = ccdGJKIntersect(a, b, &ccd) == 1;
    return 0;
}

static int by_mpr(const void *a, const void *b, peer_answer *out)
{
    ccd_t ccd = settings();
    out->meet = ccdMPRIntersect(a, b, &ccd) == 1;
    return 0;
}

#define SINGLE (sizeof(ccd_real_t) == sizeof(float))

const peer *const *gjk_peers(void)
{
    static const peer gjk = {"libccd GJK",
                             PEER_VERSION,
                             "ccdGJKIntersect, max_iterations 100 as its manual has it",
                             3,
                             SINGLE,
                             0,
                             1,
                             0,
                             make,
                             by_gjk,
                             free};
    static const peer mpr = {"libccd MPR",
                             PEER_VERSION,
                             "ccdMPRIntersect, max_iterations 100, tolerance 1e-4 as it comes",
                             3,
                             SINGLE,
                             0,
                             1,
                             0,
                             make,
                             by_mpr,
                             free};
    static const peer *const all[] = {&gjk, &mpr, NULL};
    return all;
}
