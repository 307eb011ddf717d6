/* SPDX-License-Identifier: MIT */
/* A binary floating-point type of 113 bits. */
#ifndef QUAD_H
#define QUAD_H

#include <float.h>
#include <math.h>

#if LDBL_MANT_DIG == 113
typedef long double quad;
#elif defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 quad;
#else
#error "no type of 113 bits here"
#endif

static inline quad quad_abs(quad x) { return x < 0 ? -x : x; }

/* Two steps of Newton from 53 bits. x lies within the range of double. */
static inline quad quad_sqrt(quad x)
{
    quad y = sqrt((double)x);
    if (!(y > 0)) {
        return 0;
    }
    y = (y + x / y) / 2;
    return (y + x / y) / 2;
}

#endif
