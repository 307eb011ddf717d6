/* SPDX-License-Identifier: MIT */
#include <gjk/gjk3.h>
#include <stdio.h>

int main(void)
{
    const gjk3_box cube = {{1, 1, 1}};
    const gjk3_segment rod = {{{0, 0, -1}, {0, 0, 1}}};
    const gjk3_pose leaning = {{0.8, 0, -0.6, 0, 1, 0, 0.6, 0, 0.8}, {4, 0, 0}}; /* a map by rows, a position */

    const gjk3_shape a = {gjk3_support_box, &cube, NULL, 0};
    const gjk3_shape b = {gjk3_support_segment, &rod, &leaning, 0.5}; /* a segment grown by a ball: a capsule */
    gjk3_result r;
    if (gjk3_distance(&a, &b, NULL, &r) < 0) return 1;

    printf("distance %.6g, proven to be in [%.17g, %.17g] (%s)\n", r.value, r.lower, r.upper,
           gjk_status_name(r.status));
    return 0;
}
