/* SPDX-License-Identifier: MIT */
/* All four variants. Include just the one you use where you can. */
#ifndef GJK_H
#define GJK_H

#include "gjk2.h"
#include "gjk2f.h"
#include "gjk3.h"
#include "gjk3f.h"

#endif
