/* SPDX-License-Identifier: MIT */
/* Box2D 2.4: the distance between two polygons in the plane, grown by radii, in float. */
#include "peer.h"

#include <box2d/b2_distance.h>
#include <box2d/b2_math.h>
#include <box2d/b2_settings.h>

namespace
{

struct body {
    b2Vec2 points[b2_maxPolygonVertices];
    b2DistanceProxy proxy;
    b2Transform pose;
};

void *make(const peer_set *set)
{
    body *made = new body;
    for (int k = 0; k < set->count; k++) {
        made->points[k].Set(static_cast<float>(set->v[2 * k]), static_cast<float>(set->v[2 * k + 1]));
    }
    made->proxy.Set(made->points, set->count, static_cast<float>(set->radius));
    made->pose.SetIdentity();
    if (set->posed) {
        made->pose.q.c = static_cast<float>(set->m[0]);
        made->pose.q.s = static_cast<float>(set->m[2]);
        made->pose.p.Set(static_cast<float>(set->p[0]), static_cast<float>(set->p[1]));
    }
    return made;
}

/* Warm, it keeps its simplex cache, as its documentation has it. */
int distance(const peer *, const void *a, const void *b, void *memory, peer_answer *out)
{
    const body *x = static_cast<const body *>(a), *y = static_cast<const body *>(b);
    b2DistanceInput in;
    b2SimplexCache cold;
    b2DistanceOutput answer;
    cold.count = 0;
    in.proxyA = x->proxy;
    in.proxyB = y->proxy;
    in.transformA = x->pose;
    in.transformB = y->pose;
    in.useRadii = true;
    b2Distance(&answer, memory ? static_cast<b2SimplexCache *>(memory) : &cold, &in);
    out->distance = static_cast<double>(answer.distance);
    out->meet = !(answer.distance > 0);
    return 0;
}

void discard(void *made) { delete static_cast<body *>(made); }

peer setting(size_t memory)
{
    peer p = peer();
    p.library = "Box2D 2.4";
    p.knob = "none";
    p.usual = 1;
    p.memory = memory;
    p.version = PEER_VERSION;
    p.how[DISTANCE] = p.how[INTERSECT] = "b2Distance";
    p.how[PENETRATION] = "";
    p.dim = 2;
    p.single = 1;
    p.cores = CORE(POINTS) | CORE(SEGMENT);
    p.poses = p.radii = 1;
    p.most_points = b2_maxPolygonVertices;
    p.make = make;
    p.discard = discard;
    p.query[DISTANCE] = p.query[INTERSECT] = distance;
    return p;
}

} // namespace

const peer *gjk_peers(int *count)
{
    static const peer all[] = {setting(0), setting(sizeof(b2SimplexCache))};
    *count = 2;
    return all;
}
