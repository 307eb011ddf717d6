/* SPDX-License-Identifier: MIT */
/* What a build may leave out, where flash and stack are short: it costs time or digits, never truth. */
#ifndef GJK_CORE_PARTS_H
#define GJK_CORE_PARTS_H

/* Exact arithmetic, by which the last digits are told, and contact (tight.h). */
#ifdef GJK_NO_EXACT
#define EXACT 0
#else
#define EXACT 1
#endif

/* All that is there for speed alone: the everyday way of bodies whose corners are listed, looks at the door, formulas
 * (everyday.h). Without it all bodies are searched. */
#ifdef GJK_NO_SHORTCUTS
#define SHORTCUTS 0
#else
#define SHORTCUTS 1
#endif

/* How deep bodies overlap: the function penetration, and its polytope. */
#ifdef GJK_NO_DEPTH
#define DEPTHS 0
#else
#define DEPTHS 1
#endif

/* What the heights of ready-made round sets are made of (round.h). Without it they are asked by their supports, as the
 * caller's own are. */
#ifdef GJK_NO_ROUND
#define ROUND 0
#else
#define ROUND 1
#endif

#endif
