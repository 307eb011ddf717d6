/* SPDX-License-Identifier: MIT */
/* Box2D 2.4: the distance between two polygons in the plane, grown by radii, in float. */
#include "peer.h"

#include <box2d/b2_distance.h>
#include <box2d/b2_math.h>
#include <box2d/b2_settings.h>

namespace
{

struct polygon {
    b2Vec2 points[b2_maxPolygonVertices];
    b2DistanceProxy proxy;
};

void *make(const peer_set *set)
{
    polygon *p = new polygon;
    for (int k = 0; k < set->count; k++) {
        p->points[k].Set(static_cast<float>(set->v[2 * k]), static_cast<float>(set->v[2 * k + 1]));
    }
    p->proxy.Set(p->points, set->count, static_cast<float>(set->radius));
    return p;
}

int query(const void *a, const void *b, peer_answer *out)
{
    b2DistanceInput in;
    b2SimplexCache cache;
    b2DistanceOutput answer;
    cache.count = 0;
    in.proxyA = static_cast<const polygon *>(a)->proxy;
    in.proxyB = static_cast<const polygon *>(b)->proxy;
    in.transformA.SetIdentity();
    in.transformB.SetIdentity();
    in.useRadii = true;
    b2Distance(&answer, &cache, &in);
    out->distance = static_cast<double>(answer.distance);
    out->meet = !(answer.distance > 0);
    return 0;
}

void discard(void *made) { delete static_cast<polygon *>(made); }

const peer box2d = {
    "Box2D 2.4", PEER_VERSION, "b2Distance, cold", "", 2, 1, b2_maxPolygonVertices, 1, 0, 1, make, discard,
    query,       nullptr};
const peer *const all[] = {&box2d, nullptr};

} // namespace

const peer *const *gjk_peers() { return all; }
