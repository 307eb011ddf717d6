/* SPDX-License-Identifier: MIT */
/* A pebble of 1000 points rolls past another. With an index, made once, a support looks at a few of the points instead
 * of all. The answers agree, the time does not. */
#include <gjk/gjk3.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { POINTS = 1000, FRAMES = 2000 };

static double seconds(const gjk3_shape *a, const gjk3_shape *b, gjk3_pose *moving, gjk3_result *out)
{
    const clock_t start = clock();
    for (int frame = 0; frame < FRAMES; frame++) {
        const double angle = 0.003 * frame, c = cos(angle), s = sin(angle);
        *moving = (gjk3_pose){{c, -s, 0, s, c, 0, 0, 0, 1}, {2.5 * s, 2.5 * c, 0.1}};
        if (gjk3_distance(a, b, NULL, &out[frame]) < 0) exit(1);
    }
    return (double)(clock() - start) / CLOCKS_PER_SEC;
}

int main(void)
{
    static double v[POINTS][3];
    static gjk3_result by_all[FRAMES], by_few[FRAMES];
    for (int i = 0; i < POINTS; i++) { /* along a spiral, from pole to pole */
        const double z = (2 * i + 1.0) / POINTS - 1, r = sqrt(1 - z * z), turn = 2.399963 * i;
        v[i][0] = r * cos(turn);
        v[i][1] = 0.8 * r * sin(turn);
        v[i][2] = 0.6 * z;
    }
    gjk3_indexed_points pebble = {.points = {.v = v[0], .count = POINTS}};
    pebble.points.reach = gjk3_points_reach(&pebble.points);

    gjk3_pose moving;
    const gjk3_shape a = {gjk3_support_points, &pebble, NULL, 0}, b = {gjk3_support_points, &pebble, &moving, 0};
    const double all = seconds(&a, &b, &moving, by_all);

    const size_t bytes = gjk3_index_points(&pebble, NULL, 0);
    void *memory = malloc(bytes);
    if (!memory || gjk3_index_points(&pebble, memory, bytes) != bytes) return 1;
    const double few = seconds(&a, &b, &moving, by_few);
    free(memory);

    int agreed = 0;
    for (int i = 0; i < FRAMES; i++) agreed += by_all[i].lower <= by_few[i].upper && by_few[i].lower <= by_all[i].upper;
    printf("an index of %.1f bytes a point: %.1f times as fast; %d of %d answers agree\n", (double)bytes / POINTS,
           all / few, agreed, FRAMES);
    return agreed != FRAMES;
}
