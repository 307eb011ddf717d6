/* SPDX-License-Identifier: MIT */
/* gjk: what the four variants share.
 *
 *   gjk2_   2-D double      gjk2f_   2-D float
 *   gjk3_   3-D double      gjk3f_   3-D float
 *
 * All four live side by side in one library; the name says dimension and precision, f as in sqrt and sqrtf. */
#ifndef GJK_COMMON_H
#define GJK_COMMON_H

#include <stddef.h>
#include <stdint.h>

#define GJK_VERSION_MAJOR 0
#define GJK_VERSION_MINOR 1
#define GJK_VERSION_PATCH 0

#if defined(GJK_STATIC)
#define GJK_API
#elif defined(_WIN32)
#if defined(GJK_BUILDING)
#define GJK_API __declspec(dllexport)
#else
#define GJK_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define GJK_API __attribute__((visibility("default")))
#else
#define GJK_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/*[cdef]*/

/* The sign is the meaning: from 0 up the bracket holds, below 0 the caller has erred and *out is untouched. */
enum gjk_status {
    GJK_OK = 0,      /* the bracket is as tight as asked; no tolerance asked: as rounding allows, given the reach */
    GJK_DECIDED = 1, /* stopped early, the question being settled: a sign proven, or the cutoff passed */
    GJK_FLOOR = 2,   /* this arithmetic yields no more: the bracket is wider than asked (or, nothing asked, some times
                      * wider than the rounding of points explains), or straddles contact */
    GJK_LIMIT = 3,   /* stopped at max_steps, or, by penetration, where the workspace was full */
    /* a null pointer; a pose, radius or option that is not finite, or negative where it may not be; a radius above a
     * sixteenth of the largest number; options without size, or from the future: of more than 1024 bytes, or not 0
     * where nothing is known here; tight above 1; by penetration a workspace that is misaligned or too small, or bytes
     * of none */
    GJK_BAD_ARGUMENT = -1,
    /* a support gave a point that is not finite or beyond the reach, a reach that is none, or a point that lies, once
     * placed, beyond a quarter of the largest number, or points that no convex set has: the bounds crossed; or a
     * ready-made one has no data, or bad sizes */
    GJK_BAD_SUPPORT = -2
};

/* The library's own version: major * 10000 + minor * 100 + patch. */
GJK_API uint32_t gjk_version(void);

/* "ok", "decided", "floor", "limit", "bad argument", "bad support"; "unknown" for any other number. */
GJK_API const char *gjk_status_name(int status);

/*[/cdef]*/

#ifdef __cplusplus
}
#endif

#endif
