/* SPDX-License-Identifier: MIT */
/* Made from gjk3.h by src/twins.cmake. */
#ifndef GJK3F_H
#define GJK3F_H

#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

/*[cdef]*/

/* gjk3f: questions about pairs of convex sets in 3-D.
 *
 * The contract, once, for every function:
 *   lengths   any unit, one unit. There are no angles.
 *   frame     the poses put both shapes in one frame; points and normals come back in that frame.
 *   memory    pointers are borrowed for the call. Nothing is kept, nothing is allocated.
 *   threads   no global state. Calls may run at once unless they share a cache or a workspace.
 *   truth     status >= 0: lower <= answer <= upper holds, rounding included.
 *             status < 0: the caller's mistake, *out untouched.
 *   numbers   IEEE arithmetic, rounding to nearest, subnormal numbers kept (no flush-to-zero), exceptions masked: calls
 *             raise their flags as a matter of course, and read none.
 *   return    the status, also found in the result. */

/* Writes to point a point of the set that lies farthest along dir. dir is finite and not zero; not unit, but of a size
 * whose square is well within range. Equal inputs must give equal outputs.
 *
 * Returns the reach of the set: no point of it lies farther than this from its own origin. A bound will do; it
 * enters the bracket's rounding terms only. 0, and then always 0: not known, and the library makes six more calls to
 * find out.
 *
 * The bracket allows for the support's own rounding: the point may fall short of the farthest, or stand off
 * the set, by up to 8 units of roundoff times the reach. What falls shorter is declared in options.slack; a support
 * that lies beyond that is noticed only where the bounds cross. It must return: no exception, no longjmp. */
typedef float gjk3f_support_fn(const void *data, const float dir[3], float point[3]);

/* x goes to m x + p. m by rows, any linear map: it may rotate, scale, shear, mirror or flatten. */
typedef struct gjk3f_pose {
    float m[9];
    float p[3];
} gjk3f_pose;

/* The set { m x + p : x in the support's set } grown by a ball. */
typedef struct gjk3f_shape {
    gjk3f_support_fn *support; /* yours, or a ready-made one */
    const void *data;         /* handed to support */
    const gjk3f_pose *pose;    /* NULL: identity. For large worlds give b relative to a, and a none */
    float radius;            /* of the ball, up to 1/16 of the largest number; 0 keeps corners sharp */
} gjk3f_shape;

/* A warm start: where the last query of this pair ended. Start it as {0} and hand it to each query of the
 * same pair. Poses and radii may change between queries, and one cache may meet other shapes: it then costs
 * time, never truth. The one thing it cannot see is a set edited in place, behind the same data pointer,
 * the poses and radii inside a couple included: zero the count after such an edit. Nothing else is to be
 * written to it by anyone but the library: points of the caller's own making are not all found out. */
typedef struct gjk3f_cache {
    float a[4][3], b[4][3];     /* points of the two sets, in coordinates of their own */
    float reach_a, reach_b;     /* of the two sets */
    gjk3f_support_fn *support[2]; /* whose points they are */
    const void *data[2];
    uint32_t count, reserved; /* the second is the library's own, and so are the points from count on */
} gjk3f_cache;

/* The one struct that grows. Zero in a field but size means its default; NULL options mean all defaults:
 *     gjk3f_options o = {0};
 *     o.size = sizeof o;
 * All numbers are finite and not negative. */
typedef struct gjk3f_options {
    uint32_t size;            /* sizeof(gjk3f_options) in your build; never 0 */
    uint32_t max_steps;       /* 0: 256. A step is one support call on each shape; more in a warm start given up */
    float abs_tol;           /* stop at upper - lower <= abs_tol + rel_tol * upper; */
    float rel_tol;           /*   both 0: as tight as rounding allows */
    float cutoff;            /* > 0: stop once lower is above it; value may then be as far off as upper */
    float slack;             /* how far a support may fall short of the farthest point, in its set's own coordinates */
    gjk3f_cache *cache;        /* NULL: start cold */
    void *workspace;          /* for penetration, aligned for a float; NULL: it takes its own from the stack */
    uint32_t tight;           /* 1: of points, box, segment, triangle and origin to the last place, see below */
    uint32_t workspace_bytes; /* of the workspace; 0 where there is none */
} gjk3f_options;

/* Never grows. point_a is a point of a, point_b one of b: apart, as far from each other as upper, the closest pair
 * where the bracket is tight; meeting, one and the same point, by intersect to within its bracket; by penetration the
 * deepest of each. They are as good as the coordinates of their frame: far from its origin they round. */
typedef struct gjk3f_result {
    float value;        /* the answer, inside the bracket */
    float lower, upper; /* proven */
    float point_a[3], point_b[3];
    float normal[3]; /* unit, from a to b, always; where lower is not 0, the direction that realises it */
    int32_t status;
    int32_t steps;    /* of the search that answered */
    int32_t supports; /* support calls, of both shapes, and of a warm start given up */
    int32_t reserved;
} gjk3f_result;

/* How far apart? 0 where the shapes meet.
 *
 * With options.tight, of sets whose corners are known (points, box, segment, triangle, origin, by the address of
 * these supports, under any poses and radii): value is within one unit in the last place of the truth, the bracket
 * two wide, contact exactly 0. Without it the same exact arithmetic steps in where rounding leaves too much open. It
 * holds sums of 1280 bits and takes up to 54 KB of stack where the compiler optimises, in float 58, or 29 where it is
 * built with GJK_ALONE. Of a pair that spans more, what is below 1e-115 of its size is left out, and the bracket is
 * wider by that. A library built with GJK_NO_EXACT does without. */
GJK_API int gjk3f_distance(const gjk3f_shape *a, const gjk3f_shape *b, const gjk3f_options *options, gjk3f_result *out);

/* Do they meet? Ends at the first proof. The bracket is of the signed separation, the distance apart or minus
 * the depth of the overlap, and is only as tight as the proof needs:
 *   lower > 0    apart             value = lower; status GJK_DECIDED, as of the next two
 *   upper < 0    overlapping       value = upper
 *   upper == 0   they meet: proven of points, box, segment, triangle and origin, down to what is said there
 *   else         not told apart    value = 0; status GJK_FLOOR: they touch, to this precision, or to the slack;
 *                                  status GJK_LIMIT: not found out within max_steps
 * abs_tol, rel_tol and cutoff play no part. It takes no more of the stack than is said there. */
GJK_API int gjk3f_intersect(const gjk3f_shape *a, const gjk3f_shape *b, const gjk3f_options *options, gjk3f_result *out);

/* How far apart, or how deep in each other? The signed separation: the distance where the shapes are apart, else
 * minus the depth, which is the length of the shortest way that one of them can be moved to where they only touch. One
 * number that passes through 0 without a break: moving b by -value * normal makes the shapes touch. The normal is that
 * of the closest pair. Overlapping, point_a is the point of a deepest in b along the normal, point_b that of b deepest
 * in a, and point_a - point_b is depth * normal. Along the normal they are as far from each other as the bracket has
 * it, where GJK_LIMIT ends it as far as the few points that it has seen; of round shapes they are off sideways, by
 * about the root of the bracket's width times the shapes' size, more of flat ones, and where GJK_LIMIT ends it by as
 * much as that leaves open. Where a tolerance is so loose that the bracket holds 0 they are points of the two, and no
 * more.
 *
 * The depth is sought by a polytope that grows within the difference of the shapes. Its corners have a workspace; where
 * that is full, those that can no longer matter make room, and where there are none the bracket holds all the same,
 * status GJK_LIMIT. 64 corners do for everyday polytopes, and for round shapes unless they are all but concentric: what
 * ends those is max_steps, 10 to 130 steps being usual. Radii take no room. cutoff and tolerances are as for distance;
 * of a depth, rel_tol is a share of -lower, the most that it may be. tight is as there, too: a depth down to about the
 * least that the coordinates can spell is right to the last place, unless the polytope comes to its end in the noise of
 * nearly flat bodies; then the bracket is the usual one. It takes up to 95 KB of stack where the compiler optimises, in
 * float 58, its own room for corners included. A library built with GJK_NO_DEPTH has neither this function nor the
 * next. */
GJK_API int gjk3f_penetration(const gjk3f_shape *a, const gjk3f_shape *b, const gjk3f_options *options, gjk3f_result *out);
/* The bytes of a workspace for so many corners, from 8 to 16000; 0 for other numbers. Without one there is room for 64,
 * 13536 bytes of stack, in float 8352. Of smooth shapes, which float asks of its larger sister unless it is built with
 * GJK_ALONE, it is her room, and a workspace is of use where it is larger than that. What it holds before and after is
 * of no account. */
GJK_API size_t gjk3f_workspace_size(uint32_t corners);

/* The ready-made supports. Not special: each could have been yours. A size that is negative or not finite, or
 * a set without points, comes back as GJK_BAD_SUPPORT. A ball, a capsule or a rounded box is cheapest as
 * origin, segment or box with a radius in its shape. */

/* The convex hull of a point cloud. */
typedef struct gjk3f_points {
    const float *v;  /* the first point */
    size_t count;     /* of points */
    uint32_t stride;  /* in bytes from point to point, 3 sizeof(float) or a larger multiple of it; 0: packed */
    uint32_t indexed; /* 0; 1: these are the points of a gjk3f_indexed_points, with its index */
    float reach;     /* from gjk3f_points_reach; 0: not known, found at the price of six more support calls */
} gjk3f_points;
GJK_API float gjk3f_support_points(const void *points, const float dir[3], float point[3]);
/* The largest distance of a point of the cloud from the origin, rounded up. NaN: bad points. */
GJK_API float gjk3f_points_reach(const gjk3f_points *points);

/* A cloud of many points with an index: which of them may be the farthest, by direction. A support looks at these
 * alone, and finds the same point, to the bit; from about 40 points on that pays. The index is of the points as they
 * are: of others it proves nothing, make it anew. Where there are fewer or more of them, or their reach is another, it
 * is left alone, and all are looked at. */
typedef struct gjk3f_indexed_points {
    gjk3f_points points;    /* data of a shape is their address, or this one's: they are the same. A copy of the points
                            * alone has no index: indexed is to be 0 there */
    const uint32_t *index; /* the caller's memory, which must outlive its use */
} gjk3f_indexed_points;
/* Makes the index of cloud->points, whose reach is that of gjk3f_points_reach or larger, in memory of so many bytes,
 * aligned for a uint32_t, and gives it to the cloud if it fits there; if not, the cloud has none. Returns how many
 * bytes it takes: ask with NULL and 0 first. Of 32 to 500 on a ball they are about 70 a point, of more fewer, of
 * others 100 at most, and 100 besides. 0: the points are bad, more than 2^25, or farther out than the largest number /
 * 8; their reach is not known, or less than that; or the memory is not aligned. */
GJK_API size_t gjk3f_index_points(gjk3f_indexed_points *cloud, void *memory, size_t bytes);

/* |x| <= half[0], |y| <= half[1], |z| <= half[2] */
typedef struct gjk3f_box {
    float half[3];
} gjk3f_box;
GJK_API float gjk3f_support_box(const void *box, const float dir[3], float point[3]);

/* From v[0] to v[1]. */
typedef struct gjk3f_segment {
    float v[2][3];
} gjk3f_segment;
GJK_API float gjk3f_support_segment(const void *segment, const float dir[3], float point[3]);

typedef struct gjk3f_triangle {
    float v[3][3];
} gjk3f_triangle;
GJK_API float gjk3f_support_triangle(const void *triangle, const float dir[3], float point[3]);

/* The one point 0; data is not read. */
GJK_API float gjk3f_support_origin(const void *unused, const float dir[3], float point[3]);

/* |x| <= radius */
typedef struct gjk3f_ball {
    float radius;
} gjk3f_ball;
GJK_API float gjk3f_support_ball(const void *ball, const float dir[3], float point[3]);

/* (x / radii[0])^2 + (y / radii[1])^2 + (z / radii[2])^2 <= 1; where a radius is 0, so is that coordinate. A ball
 * under a pose that stretches is an ellipsoid too, but radii that are multiplied into a rotation are rounded. */
typedef struct gjk3f_ellipsoid {
    float radii[3];
} gjk3f_ellipsoid;
GJK_API float gjk3f_support_ellipsoid(const void *ellipsoid, const float dir[3], float point[3]);

/* x^2 + y^2 <= radius^2, |z| <= half_length */
typedef struct gjk3f_cylinder {
    float radius, half_length;
} gjk3f_cylinder;
GJK_API float gjk3f_support_cylinder(const void *cylinder, const float dir[3], float point[3]);

/* The hull of the apex (0, 0, half_length) and the disc at z = -half_length. */
typedef struct gjk3f_cone {
    float radius, half_length;
} gjk3f_cone;
GJK_API float gjk3f_support_cone(const void *cone, const float dir[3], float point[3]);

/* x^2 + y^2 <= radius^2, z = 0 */
typedef struct gjk3f_disc {
    float radius;
} gjk3f_disc;
GJK_API float gjk3f_support_disc(const void *disc, const float dir[3], float point[3]);

/* Two shapes as one, poses and radii included; the data of the two supports below. A couple may hold
 * couples, never itself. A part of unknown reach costs six more calls each time; one
 * that may fall short by more than half its size, as slack allows, is to say its reach. */
typedef struct gjk3f_couple {
    gjk3f_shape a, b;
} gjk3f_couple;
/* { x + y : x in a, y in b } */
GJK_API float gjk3f_support_sum(const void *couple, const float dir[3], float point[3]);
/* the convex hull of a and b */
GJK_API float gjk3f_support_hull(const void *couple, const float dir[3], float point[3]);

/*[/cdef]*/

#ifdef __cplusplus
}
#endif

#endif
