/* SPDX-License-Identifier: MIT */
/* Box2D 3: the distance between two polygons in the plane, grown by radii, in float. */
#include "peer.h"

#include <box2d/collision.h>
#include <stdlib.h>
#include <string.h>

typedef struct body {
    b2ShapeProxy proxy;
    b2Transform pose;
} body;

static void *make(const peer_set *set)
{
    body *made = malloc(sizeof *made);
    b2Vec2 points[B2_MAX_POLYGON_VERTICES];
    for (int k = 0; k < set->count; k++) {
        points[k].x = (float)set->v[2 * k];
        points[k].y = (float)set->v[2 * k + 1];
    }
    if (made) {
        made->proxy = b2MakeProxy(points, set->count, (float)set->radius);
        made->pose = b2Transform_identity;
        if (set->posed) {
            made->pose.q.c = (float)set->m[0];
            made->pose.q.s = (float)set->m[2];
            made->pose.p.x = (float)set->p[0];
            made->pose.p.y = (float)set->p[1];
        }
    }
    return made;
}

/* Warm, it keeps its simplex cache, as its documentation has it. */
static int distance(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    const body *x = a, *y = b;
    b2DistanceInput in;
    b2SimplexCache cold = {0};
    (void)p;
    in.proxyA = x->proxy;
    in.proxyB = y->proxy;
    in.transform = b2InvMulTransforms(x->pose, y->pose);
    in.useRadii = true;
    out->distance = b2ShapeDistance(&in, memory ? memory : &cold, NULL, 0).distance;
    out->meet = !(out->distance > 0);
    return 0;
}

static const char how[] = "b2ShapeDistance of the relative pose";

const peer *gjk_peers(int *count)
{
    static peer all[2];
    memset(all, 0, sizeof all);
    for (int warm = 0; warm < 2; warm++) {
        peer *p = &all[warm];
        p->library = "Box2D 3";
        p->knob = "none";
        p->usual = 1;
        p->memory = warm ? sizeof(b2SimplexCache) : 0;
        p->version = PEER_VERSION;
        p->how[DISTANCE] = p->how[INTERSECT] = how;
        p->how[PENETRATION] = "";
        p->dim = 2;
        p->single = 1;
        p->cores = CORE(POINTS) | CORE(SEGMENT);
        p->poses = p->radii = 1;
        p->most_points = B2_MAX_POLYGON_VERTICES;
        p->make = make;
        p->discard = free;
        p->query[DISTANCE] = p->query[INTERSECT] = distance;
    }
    *count = 2;
    return all;
}
