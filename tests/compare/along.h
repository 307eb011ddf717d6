/* SPDX-License-Identifier: MIT */
/* What a direction is worth: how far apart two bodies stand along it, in 113 bits. */
#ifndef ALONG_H
#define ALONG_H

#include "../truth.h"

#define UNIT_ERROR 1e-6 /* of a normal that is taken for one */

static inline int is_unit(const quad *n) { return quad_abs(norm(n) - 1) <= (quad)UNIT_ERROR; }

/* From a to b along n, which is nearly unit; below 0 by as much as b must be moved along n. */
static inline quad separation_along(const body *a, const body *b, const quad *n)
{
    quad origin[DIM], back[DIM], x[DIM], y[DIM], along = 0;
    for (int i = 0; i < DIM; i++) {
        origin[i] = (quad)a->pose.p[i];
        back[i] = -n[i];
    }
    farthest_of_body(a, origin, 1, n, x);
    farthest_of_body(b, origin, 1, back, y);
    for (int i = 0; i < DIM; i++) {
        along += n[i] * (y[i] - x[i]);
    }
    return along / norm(n);
}

#endif
