/* SPDX-License-Identifier: MIT */
/* One whole variant: compile this single file, and gjk3.c or with -DGJK_ALONE (src/core/widen.h), and you have it. */
#include "../include/gjk/gjk3f.h"

#define DIM 3
#define PREFIX gjk3f_
#define REAL_IS_DOUBLE 0
#include "core/api.h"
