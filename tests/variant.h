/* SPDX-License-Identifier: MIT */
/* One test source serves four variants: it is compiled once for each, with VARIANT_DIM and VARIANT_FLOAT set. */
#ifndef VARIANT_H
#define VARIANT_H

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifndef VARIANT_WITHOUT_CMOCKA
#include <cmocka.h>
#else /* outside a test, what may not happen ends the process */
#define fail_msg(text) (fprintf(stderr, "%s\n", text), exit(2))
#endif
#include <gjk/gjk.h>

#define DIM VARIANT_DIM

#if VARIANT_DIM == 3 && !VARIANT_FLOAT
#define V(name) gjk3_##name
#define VARIANT "gjk3"
#elif VARIANT_DIM == 3
#define V(name) gjk3f_##name
#define VARIANT "gjk3f"
#elif !VARIANT_FLOAT
#define V(name) gjk2_##name
#define VARIANT "gjk2"
#else
#define V(name) gjk2f_##name
#define VARIANT "gjk2f"
#endif

#if VARIANT_FLOAT
typedef float real;
#define REAL_EPSILON FLT_EPSILON
#define REAL_MAX FLT_MAX
#define REAL_MIN FLT_MIN
#define PRECISION "float"
#else
typedef double real;
#define REAL_EPSILON DBL_EPSILON
#define REAL_MAX DBL_MAX
#define REAL_MIN DBL_MIN
#define PRECISION "double"
#endif

/* The unit of roundoff: 2^-53 or 2^-24. */
#define U ((double)REAL_EPSILON / 2)

static inline V(options) default_options(void)
{
    V(options) o;
    memset(&o, 0, sizeof o);
    o.size = (uint32_t)sizeof o;
    return o;
}

#endif
