/* SPDX-License-Identifier: MIT */
/* Prints the layout of every public struct, which programs already compiled rely on; fails where a struct that must
 * have no padding has some. */
#include <gjk/gjk.h>

#include <stdio.h>

static size_t filled; /* bytes of the present struct that its fields take */
static int holes;

static void whole(const char *name, size_t size)
{
    printf("%s %u\n", name, (unsigned)size);
    filled = 0;
}

static void field(const char *name, size_t offset, size_t size)
{
    printf("    %-12s %4u %4u\n", name, (unsigned)offset, (unsigned)size);
    filled += size;
}

static void expect_packed(const char *name, size_t size)
{
    if (filled == size) return;
    fprintf(stderr, "%s: %u bytes, but its fields take %u\n", name, (unsigned)size, (unsigned)filled);
    holes++;
}

/* The structs of a variant, field by field. The options are told apart by size and the results and caches are
 * copied as bytes: no byte of theirs may be padding. */
#define F(member) field(#member, offsetof(T, member), sizeof(((T *)0)->member));
#define STRUCT(gjk, name, fields)                                                                                      \
    {                                                                                                                  \
        typedef gjk##name T;                                                                                           \
        whole(#gjk #name, sizeof(T));                                                                                  \
        fields                                                                                                         \
    }
#define PACKED(gjk, name, fields) STRUCT(gjk, name, fields expect_packed(#gjk #name, sizeof(T));)
#define FLAT(gjk)                                                                                                      \
    PACKED(gjk, pose, F(m) F(p))                                                                                       \
    STRUCT(gjk, shape, F(support) F(data) F(pose) F(radius))                                                           \
    PACKED(gjk, cache, F(a) F(b) F(reach_a) F(reach_b) F(support) F(data) F(count) F(reserved))                        \
    PACKED(gjk, options,                                                                                               \
           F(size) F(max_steps) F(abs_tol) F(rel_tol) F(cutoff) F(slack) F(cache) F(workspace) F(tight)                \
               F(workspace_bytes))                                                                                     \
    PACKED(gjk, result,                                                                                                \
           F(value) F(lower) F(upper) F(point_a) F(point_b) F(normal) F(status) F(steps) F(supports) F(reserved))      \
    STRUCT(gjk, points, F(v) F(count) F(stride) F(indexed) F(reach))                                                   \
    STRUCT(gjk, indexed_points, F(points) F(index))                                                                    \
    PACKED(gjk, box, F(half))                                                                                          \
    PACKED(gjk, segment, F(v))                                                                                         \
    PACKED(gjk, ball, F(radius))                                                                                       \
    PACKED(gjk, ellipsoid, F(radii))                                                                                   \
    PACKED(gjk, couple, F(a) F(b))
#define SOLID(gjk)                                                                                                     \
    FLAT(gjk)                                                                                                          \
    PACKED(gjk, triangle, F(v))                                                                                        \
    PACKED(gjk, cylinder, F(radius) F(half_length))                                                                    \
    PACKED(gjk, cone, F(radius) F(half_length))                                                                        \
    PACKED(gjk, disc, F(radius))

int main(void)
{
    FLAT(gjk2_)
    FLAT(gjk2f_)
    SOLID(gjk3_)
    SOLID(gjk3f_)
    return holes > 0;
}
