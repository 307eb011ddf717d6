/* SPDX-License-Identifier: MIT */
/* The stop watch of `gjk report`: the time of many queries without Python around each one. */
#ifndef GJK_BENCH_H
#define GJK_BENCH_H

#include <gjk/gjk.h>

/*[cdef]*/

/* Asks about the pairs a[i], b[i], one after the other and all of them `repeats` times: query 0 is distance, 1
 * intersect, 2 penetration. out[i] holds the last answers. Returns the nanoseconds spent. */
uint64_t bench2(int query, const gjk2_shape *a, const gjk2_shape *b, size_t count, size_t repeats,
                const gjk2_options *options, gjk2_result *out);
uint64_t bench2f(int query, const gjk2f_shape *a, const gjk2f_shape *b, size_t count, size_t repeats,
                 const gjk2f_options *options, gjk2f_result *out);
uint64_t bench3(int query, const gjk3_shape *a, const gjk3_shape *b, size_t count, size_t repeats,
                const gjk3_options *options, gjk3_result *out);
uint64_t bench3f(int query, const gjk3f_shape *a, const gjk3f_shape *b, size_t count, size_t repeats,
                 const gjk3f_options *options, gjk3f_result *out);

/*[/cdef]*/

#endif
