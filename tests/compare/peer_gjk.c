/* SPDX-License-Identifier: MIT */
/* The library itself, asked through the same door as its peers. */
#include "peer.h"

#include <gjk/gjk.h>
#include <stdlib.h>
#include <string.h>

typedef struct body {
    gjk3_shape shape;
    gjk3_pose pose;
    union {
        gjk3_points points;
        gjk3_box box;
        gjk3_segment segment;
        gjk3_cylinder cylinder;
        gjk3_ellipsoid ellipsoid;
    } core;
} body;

static void set_points(body *b, const peer_set *set)
{
    gjk3_points points = {set->v, (size_t)set->count, 0, 0, 0};
    points.reach = gjk3_points_reach(&points);
    b->core.points = points;
    b->shape.support = gjk3_support_points;
}

static void set_core(body *b, const peer_set *set)
{
    switch (set->core) {
    case PEER_BOX:
        memcpy(b->core.box.half, set->size, sizeof set->size);
        b->shape.support = gjk3_support_box;
        return;
    case PEER_SEGMENT:
        memcpy(b->core.segment.v, set->v, sizeof b->core.segment.v);
        b->shape.support = gjk3_support_segment;
        return;
    case PEER_CYLINDER:
        b->core.cylinder.radius = set->size[0];
        b->core.cylinder.half_length = set->size[1];
        b->shape.support = gjk3_support_cylinder;
        return;
    case PEER_ELLIPSOID:
        memcpy(b->core.ellipsoid.radii, set->size, sizeof set->size);
        b->shape.support = gjk3_support_ellipsoid;
        return;
    case PEER_ORIGIN:
        b->shape.support = gjk3_support_origin;
        return;
    default:
        set_points(b, set);
    }
}

static void *make(const peer_set *set)
{
    body *b = calloc(1, sizeof *b);
    if (b) {
        set_core(b, set);
        b->shape.data = &b->core;
        b->shape.radius = set->radius;
        if (set->posed) {
            memcpy(b->pose.m, set->m, sizeof b->pose.m);
            memcpy(b->pose.p, set->p, sizeof b->pose.p);
            b->shape.pose = &b->pose;
        }
    }
    return b;
}

static int how_deep(double abs_tol, const body *a, const body *b, peer_answer *out)
{
    gjk3_options o = {0};
    gjk3_result r;
    o.size = sizeof o;
    o.abs_tol = abs_tol;
    if (gjk3_penetration(&a->shape, &b->shape, &o, &r) < 0) {
        return 1;
    }
    out->meet = r.value <= 0;
    out->depth = -r.value;
    memcpy(out->normal, r.normal, sizeof out->normal);
    return 0;
}

static int deep(const void *a, const void *b, peer_answer *out) { return how_deep(0, a, b, out); }
static int coarsely(const void *a, const void *b, peer_answer *out) { return how_deep(1e-4, a, b, out); }
static int finely(const void *a, const void *b, peer_answer *out) { return how_deep(1e-10, a, b, out); }

#define OF(title, asked_how_deep, penetration)                                                                         \
    {                                                                                                                  \
        title, PEER_VERSION, "", "gjk3_penetration, " asked_how_deep, 3, 0, 0, 1, 1, 0, make, free, NULL, penetration  \
    }

const peer *const *gjk_peers(void)
{
    static const peer exact = OF("gjk", "no options: as tight as rounding allows, 64 corners on the stack", deep);
    static const peer coarse = OF("gjk 1e-4", "abs_tol 1e-4", coarsely);
    static const peer fine = OF("gjk 1e-10", "abs_tol 1e-10", finely);
    static const peer *const all[] = {&exact, &coarse, &fine, NULL};
    return all;
}
