/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 199309L
#include "_bench.h"

#if defined(_WIN32)
#include <windows.h>

static uint64_t now(void)
{
    LARGE_INTEGER ticks, per_second;
    QueryPerformanceCounter(&ticks);
    QueryPerformanceFrequency(&per_second);
    return (uint64_t)((double)ticks.QuadPart * 1e9 / (double)per_second.QuadPart);
}
#else
#include <time.h>

static uint64_t now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000000u + (uint64_t)t.tv_nsec;
}
#endif

/* One body for four types: only the names differ. */
#define BENCH(bench, gjk)                                                                                              \
    uint64_t bench(int query, const gjk##_shape *a, const gjk##_shape *b, size_t count, size_t repeats,                \
                   const gjk##_options *options, gjk##_result *out)                                                    \
    {                                                                                                                  \
        int (*ask)(const gjk##_shape *, const gjk##_shape *, const gjk##_options *, gjk##_result *) =                  \
            query == 0   ? gjk##_distance                                                                              \
            : query == 1 ? gjk##_intersect                                                                             \
                         : gjk##_penetration;                                                                          \
        uint64_t start = now();                                                                                        \
        for (size_t r = 0; r < repeats; r++)                                                                           \
            for (size_t i = 0; i < count; i++) ask(&a[i], &b[i], options, &out[i]);                                    \
        return now() - start;                                                                                          \
    }

BENCH(bench2, gjk2)
BENCH(bench2f, gjk2f)
BENCH(bench3, gjk3)
BENCH(bench3f, gjk3f)
