/* SPDX-License-Identifier: MIT */
/* Box2D 3: the distance between two polygons in the plane, grown by radii, in float. */
#include "peer.h"

#include <box2d/collision.h>
#include <stdlib.h>

static void *make(const peer_set *set)
{
    b2ShapeProxy *proxy = malloc(sizeof *proxy);
    b2Vec2 points[B2_MAX_POLYGON_VERTICES];
    for (int k = 0; k < set->count; k++) {
        points[k].x = (float)set->v[2 * k];
        points[k].y = (float)set->v[2 * k + 1];
    }
    if (proxy) {
        *proxy = b2MakeProxy(points, set->count, (float)set->radius);
    }
    return proxy;
}

static int query(const void *a, const void *b, peer_answer *out)
{
    b2DistanceInput in = {0};
    b2SimplexCache cache = {0};
    in.proxyA = *(const b2ShapeProxy *)a;
    in.proxyB = *(const b2ShapeProxy *)b;
    in.transform = b2Transform_identity;
    in.useRadii = true;
    out->distance = b2ShapeDistance(&in, &cache, NULL, 0).distance;
    out->meet = !(out->distance > 0);
    return 0;
}

const peer *const *gjk_peers(void)
{
    static const peer box2d = {
        "Box2D 3", PEER_VERSION, "b2ShapeDistance, cold", "", 2, 1, B2_MAX_POLYGON_VERTICES, 1, 0, 1, make, free,
        query,     NULL};
    static const peer *const all[] = {&box2d, NULL};
    return all;
}
