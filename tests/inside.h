/* SPDX-License-Identifier: MIT */
/* For tests from inside: compiles a variant in, a float one without its sister in double. Its public functions are
 * static here, so that compilers leave out what a test does not use: that saves up to four fifths of the compiling. */
#ifndef INSIDE_H
#define INSIDE_H

#include "../include/gjk/common.h"
#undef GJK_API
#define GJK_API static __attribute__((unused))

/* Of parts that lack their callers gcc knows less, and warns of what never happens; of the whole it does not. */
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#define GJK_ALONE
#if VARIANT_DIM == 2 && VARIANT_FLOAT
#include "../src/gjk2f.c"
#elif VARIANT_DIM == 2
#include "../src/gjk2.c"
#elif VARIANT_FLOAT
#include "../src/gjk3f.c"
#else
#include "../src/gjk3.c"
#endif

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#endif
