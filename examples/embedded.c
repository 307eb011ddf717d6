/* SPDX-License-Identifier: MIT */
/* A guard for a small vehicle: is anything nearer than the margin? In float, without a heap, and of the C
 * library with memcpy, memset and sqrtf alone; only main, which plays the vehicle's part on a desk, prints. */
#include <gjk/gjk2f.h>

enum { OBSTACLES = 3 };

/* The vehicle's outline, rounded by 0.05 m. */
static const float outline[][2] = {{-0.30f, -0.20f}, {0.25f, -0.20f}, {0.35f, 0.0f}, {0.25f, 0.20f}, {-0.30f, 0.20f}};
static const gjk2f_points vehicle = {outline[0], sizeof outline / sizeof outline[0], 0, 0, 0.45f};

static const gjk2f_box crate = {{0.40f, 0.25f}};
static const gjk2f_segment wall = {{{-2.0f, 1.5f}, {4.0f, 1.5f}}};
static const gjk2f_pose crate_place = {{0.8f, -0.6f, 0.6f, 0.8f}, {2.0f, -0.3f}};
static const gjk2f_pose post_place = {{1.0f, 0.0f, 0.0f, 1.0f}, {1.1f, 0.9f}};
static const gjk2f_shape obstacles[OBSTACLES] = {
    {gjk2f_support_box, &crate, &crate_place, 0.0f},
    {gjk2f_support_segment, &wall, 0, 0.02f},
    {gjk2f_support_origin, 0, &post_place, 0.10f},
};
static gjk2f_cache caches[OBSTACLES];

/* The number of the first obstacle not proven farther than the margin; OBSTACLES when the way is clear. An answer that
 * does not come counts as an obstacle. */
static int guard(const gjk2f_pose *place, float margin)
{
    const gjk2f_shape self = {gjk2f_support_points, &vehicle, place, 0.05f};
    gjk2f_options options = {0};
    options.size = sizeof options;
    options.cutoff = margin; /* how much farther is nobody's concern */
    for (int i = 0; i < OBSTACLES; i++) {
        gjk2f_result r;
        options.cache = &caches[i];
        if (gjk2f_distance(&self, &obstacles[i], &options, &r) < 0 || !(r.lower > margin)) return i;
    }
    return OBSTACLES;
}

#include <stdio.h>

int main(void)
{
    static const char *const names[OBSTACLES + 1] = {"crate", "wall", "post", "nothing"};
    for (int step = 0; step <= 4; step++) {
        const gjk2f_pose place = {{1.0f, 0.0f, 0.0f, 1.0f}, {0.25f * (float)step, 0.0f}};
        printf("x = %.2f m: %s within 0.5 m\n", 0.25 * step, names[guard(&place, 0.5f)]);
    }
    return 0;
}
