/* SPDX-License-Identifier: MIT */
/* A set of your own: a lens, the part that two balls have in common. All the library asks of it is the point that
 * lies farthest in a direction. */
#include <gjk/gjk3.h>
#include <math.h>
#include <stdio.h>

typedef struct lens {
    double radius; /* of the two balls */
    double offset; /* of their centres, up and down the z axis; less than the radius */
} lens;

/* Either the ball's own farthest point, where that lies on the lens, or a point of the rim. */
static double support_lens(const void *data, const double dir[3], double point[3])
{
    const lens *l = data;
    const double rim = sqrt((l->radius - l->offset) * (l->radius + l->offset));
    const double flat = hypot(dir[0], dir[1]), length = hypot(flat, dir[2]);
    const double height = l->radius * (fabs(dir[2]) / length) - l->offset;

    /* Straight up and straight down lead to a cap, so that flat is not 0 where it divides. */
    const double across = height > 0 ? l->radius / length : rim / flat;
    point[0] = across * dir[0];
    point[1] = across * dir[1];
    point[2] = height > 0 ? copysign(height, dir[2]) : 0;
    return l->radius; /* the reach: no point of the lens is farther from its middle */
}

int main(void)
{
    const lens glass = {1.25, 0.75}; /* 1 thick, its rim a circle of radius 1 */
    const gjk3_pose upright = {{0, 0, 1, 0, 1, 0, -1, 0, 0}, {3, 0, 0}};
    const gjk3_shape a = {support_lens, &glass, NULL, 0};
    const gjk3_shape b = {support_lens, &glass, &upright, 0};

    gjk3_options options = {0};
    options.size = sizeof options;
    options.abs_tol = 1e-9;

    gjk3_result r;
    if (gjk3_distance(&a, &b, &options, &r) < 0) return 1;
    printf("distance %.9f, not known better than to %.0e\n", r.value, options.abs_tol);
    printf("from the rim at x = %.3f to the cap at x = %.3f\n", r.point_a[0], r.point_b[0]);
    return r.upper - r.lower > options.abs_tol * (1 + 1e-9);
}
