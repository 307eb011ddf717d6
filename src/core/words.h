/* SPDX-License-Identifier: MIT */
/* The words that a variant binds: its dimension, its number, its public names. The only file that pastes names. */
#ifndef GJK_CORE_WORDS_H
#define GJK_CORE_WORDS_H

#ifndef DIM /* opened alone, by an editor or a checker: 3-D double */
#include "../../include/gjk/gjk3.h"
#define DIM 3
#define PREFIX gjk3_
#define REAL_IS_DOUBLE 1
#endif

#define JOIN2(a, b) a##b
#define JOIN(a, b) JOIN2(a, b)
#define pub(name) JOIN(PREFIX, name) /* pub(distance) is gjk3_distance, or one of its sisters */

/* The variant of this dimension in double, where it stands beside one in float. */
#if DIM == 2
#define sister(name) gjk2_##name
#else
#define sister(name) gjk3_##name
#endif

typedef pub(support_fn) support_fn;
typedef pub(pose) pose;
typedef pub(shape) shape;
typedef pub(cache) cache;
typedef pub(options) options;
typedef pub(result) result;

#endif
