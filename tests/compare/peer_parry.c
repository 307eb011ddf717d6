/* SPDX-License-Identifier: MIT */
/* parry: distance, whether they meet and how deep, in its crates for the plane and for space, in float and in double,
 * by way of parry/parry.rs. */
#include "peer.h"

#include <string.h>

#define CRATE(name)                                                                                                    \
    void *name##_make(const peer_set *set);                                                                            \
    void name##_discard(void *made);                                                                                   \
    peer_query name##_distance, name##_intersect, name##_penetration
CRATE(parry2d);
CRATE(parry3d);
CRATE(parry3d_f64);

/* Solids that it has none of its own for are left out. */
static peer crate(const char *name, int dim, int single, size_t memory)
{
    peer p;
    memset(&p, 0, sizeof p);
    p.library = name;
    p.knob = "none";
    p.usual = 1;
    p.memory = memory;
    p.version = PEER_VERSION;
    p.how[DISTANCE] = "query::distance";
    p.how[INTERSECT] = "query::intersection_test";
    p.how[PENETRATION] = "query::contact, prediction 0";
    p.dim = dim;
    p.single = single;
    p.cores = CORE(POINTS) | CORE(BOX) | CORE(SEGMENT) | CORE(ORIGIN);
    p.cores |= dim == 3 ? CORE(CYLINDER) | CORE(CONE) : 0;
    p.poses = ROTATIONS;
    p.radii = 1;
    return p;
}

/* Warm, it begins with a direction that it is given; it takes none for penetration. */
#define ASKED(p, name)                                                                                                 \
    do {                                                                                                               \
        (p).make = name##_make;                                                                                        \
        (p).discard = name##_discard;                                                                                  \
        (p).query[DISTANCE] = name##_distance;                                                                         \
        (p).query[INTERSECT] = name##_intersect;                                                                       \
        (p).query[PENETRATION] = (p).memory ? NULL : name##_penetration;                                               \
    } while (0)

const peer *gjk_peers(int *count)
{
    static peer all[6];
    for (int warm = 0; warm < 2; warm++) {
        size_t memory = warm ? 3 * sizeof(double) : 0;
        all[warm] = crate("parry2d", 2, 1, memory);
        ASKED(all[warm], parry2d);
        all[2 + warm] = crate("parry3d", 3, 1, memory);
        ASKED(all[2 + warm], parry3d);
        all[4 + warm] = crate("parry3d-f64", 3, 0, memory);
        ASKED(all[4 + warm], parry3d_f64);
    }
    *count = 6;
    return all;
}
