/* SPDX-License-Identifier: MIT */
/* What belongs to no variant. */
#include "../include/gjk/common.h"

uint32_t gjk_version(void) { return GJK_VERSION_MAJOR * 10000u + GJK_VERSION_MINOR * 100u + GJK_VERSION_PATCH; }

const char *gjk_status_name(int status)
{
    /* One array of characters: an array of pointers would be writable data in a shared library. */
    static const char names[][13] = {"bad support", "bad argument", "ok", "decided", "floor", "limit", "unknown"};
    int known = status >= GJK_BAD_SUPPORT && status <= GJK_LIMIT;
    return names[known ? status - GJK_BAD_SUPPORT : 6];
}
