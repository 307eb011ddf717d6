/* SPDX-License-Identifier: MIT */
/* A box in a box: how deep, which way out, and where. */
#include <gjk/gjk3.h>
#include <stdio.h>

int main(void)
{
    const gjk3_box block = {{1, 1, 1}}, crate = {{0.5, 0.5, 0.5}};
    const gjk3_pose tilted = {{0.48, -0.8, -0.36, 0.64, 0.6, -0.48, 0.6, 0, 0.8}, {0.96, 1.28, 1.2}};

    const gjk3_shape a = {gjk3_support_box, &block, NULL, 0};
    const gjk3_shape b = {gjk3_support_box, &crate, &tilted, 0};
    gjk3_result r;
    if (gjk3_penetration(&a, &b, NULL, &r) < 0) return 1;

    /* Below 0 the value is minus the depth, and b is clear of a once it has gone this way. */
    printf("separation %.6g, proven to be in [%.17g, %.17g]\n", r.value, r.lower, r.upper);
    printf("way out (%.4f, %.4f, %.4f), ", -r.value * r.normal[0], -r.value * r.normal[1], -r.value * r.normal[2]);
    printf("from (%.4f, %.4f, %.4f) to (%.4f, %.4f, %.4f)\n", r.point_b[0], r.point_b[1], r.point_b[2], r.point_a[0],
           r.point_a[1], r.point_a[2]);
    return 0;
}
