/* SPDX-License-Identifier: MIT */
/* One whole variant: compile this single file and you have it. */
#include "../include/gjk/gjk2.h"

#define DIM 2
#define PREFIX gjk2_
#define REAL_IS_DOUBLE 1
#include "core/api.h"
