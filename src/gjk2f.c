/* SPDX-License-Identifier: MIT */
/* One whole variant: compile this single file, and gjk2.c or with -DGJK_ALONE (src/core/widen.h), and you have it. */
#include "../include/gjk/gjk2f.h"

#define DIM 2
#define PREFIX gjk2f_
#define REAL_IS_DOUBLE 0
#include "core/api.h"
