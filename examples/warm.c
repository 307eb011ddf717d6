/* SPDX-License-Identifier: MIT */
/* One hull turns and drifts past another, a little at each frame. With a cache each query starts where the last one
 * ended; without, each starts afresh. The answers agree, the work does not. */
#include <gjk/gjk3.h>
#include <math.h>
#include <stdio.h>

enum { FRAMES = 10000 };

static void turn(gjk3_pose *pose, double angle, double drift)
{
    const double c = cos(angle), s = sin(angle);
    const double m[9] = {c, -0.6 * s, 0.8 * s, s, 0.6 * c, -0.8 * c, 0, 0.8, 0.6};
    for (int i = 0; i < 9; i++) pose->m[i] = m[i];
    pose->p[0] = 3.5 * cos(drift);
    pose->p[1] = 3.5 * sin(drift);
    pose->p[2] = 0.5;
}

int main(void)
{
    static const double wedge[6][3] = {{-1, -0.7, -1}, {-1, 0.7, -1},  {1, -0.7, -1},
                                       {1, 0.7, -1},   {1, -0.7, 1.2}, {1, 0.7, 1.2}};
    static const double gem[6][3] = {{0.5, 0, 0}, {-0.5, 0, 0}, {0, 0.9, 0}, {0, -0.9, 0}, {0, 0, 0.6}, {0, 0, -0.6}};
    gjk3_points hull_a = {.v = wedge[0], .count = 6}, hull_b = {.v = gem[0], .count = 6};
    hull_a.reach = gjk3_points_reach(&hull_a);
    hull_b.reach = gjk3_points_reach(&hull_b);
    gjk3_pose moving;
    const gjk3_shape a = {gjk3_support_points, &hull_a, NULL, 0}, b = {gjk3_support_points, &hull_b, &moving, 0};

    gjk3_cache cache = {0};
    gjk3_options warm = {0};
    warm.size = sizeof warm;
    warm.cache = &cache;

    long cold_calls = 0, warm_calls = 0, agreed = 0;
    for (int frame = 0; frame < FRAMES; frame++) {
        gjk3_result x, y;
        turn(&moving, 0.001 * frame, 0.0004 * frame);
        if (gjk3_distance(&a, &b, NULL, &x) < 0 || gjk3_distance(&a, &b, &warm, &y) < 0) return 1;
        cold_calls += x.supports;
        warm_calls += y.supports;
        agreed += x.lower <= y.upper && y.lower <= x.upper; /* both brackets hold the truth */
    }
    printf("support calls per body and query: cold %.2f, warm %.2f; %ld of %d answers agree\n",
           (double)cold_calls / (2.0 * FRAMES), (double)warm_calls / (2.0 * FRAMES), agreed, FRAMES);
    return agreed != FRAMES;
}
