/* SPDX-License-Identifier: MIT */
/* The reach of a set whose support does not say: the box around it, two calls an axis, each short by the slack. */
#ifndef GJK_CORE_REACH_H
#define GJK_CORE_REACH_H

#include "linear.h"

#define SURVEY_CALLS (2 * DIM)

/* What comes of points that are all 0, without slack, and of no others. */
#define SURVEYED_NOTHING (4 * TINY)

/* Not finite where the support's answers are no points, or do say. */
static real surveyed(support_fn *support, const void *data, real slack)
{
    vec far = axis(0, 0);
    for (int i = 0; i < SURVEY_CALLS; i++) {
        vec x = nowhere();
        if (!(support(data, axis(i / 2, i & 1 ? (real)-1 : (real)1).c, x.c) == 0)) return (real)NAN;
        for (int j = 0; j < DIM; j++) {
            if (!bounded(x.c[j])) return (real)NAN;
            far.c[j] = larger(size(x.c[j]) + slack, far.c[j]);
        }
    }
    return spread(far) * (1 + 16 * UNIT) + SURVEYED_NOTHING;
}

#endif
