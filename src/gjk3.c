/* SPDX-License-Identifier: MIT */
/* One whole variant: compile this single file and you have it. */
#include "../include/gjk/gjk3.h"

#define DIM 3
#define PREFIX gjk3_
#define REAL_IS_DOUBLE 1
#include "core/api.h"
