/* SPDX-License-Identifier: MIT */
/* FCL: the distance between two convex hulls, or how deep two shapes of its own overlap, in double, by either solver.
 */
#include "peer.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <vector>

namespace
{

struct body {
    std::shared_ptr<fcl::CollisionGeometryd> shape;
    fcl::Transform3d pose;
};

/* Distance asks a hull for farthest vertices and an inner point, never for its faces: one that holds all vertices will
 * do, and makes the search look at each of them. */
std::shared_ptr<fcl::CollisionGeometryd> hull(const peer_set *set)
{
    auto points = std::make_shared<std::vector<fcl::Vector3d>>();
    auto face = std::make_shared<std::vector<int>>(1, set->count);
    for (int k = 0; k < set->count; k++) {
        points->emplace_back(set->v[3 * k], set->v[3 * k + 1], set->v[3 * k + 2]);
        face->push_back(k);
    }
    return std::make_shared<fcl::Convexd>(points, 1, face);
}

/* Segments come with a radius and along the last axis, as its capsules are. */
std::shared_ptr<fcl::CollisionGeometryd> shape(const peer_set *set)
{
    const double *size = set->size;
    switch (set->core) {
    case PEER_BOX:
        return std::make_shared<fcl::Boxd>(2 * size[0], 2 * size[1], 2 * size[2]);
    case PEER_SEGMENT:
        return std::make_shared<fcl::Capsuled>(set->radius, 2 * std::abs(set->v[2]));
    case PEER_CYLINDER:
        return std::make_shared<fcl::Cylinderd>(size[0], 2 * size[1]);
    case PEER_CONE:
        return std::make_shared<fcl::Coned>(size[0], 2 * size[1]);
    case PEER_ELLIPSOID:
        return std::make_shared<fcl::Ellipsoidd>(size[0], size[1], size[2]);
    case PEER_ORIGIN:
        return std::make_shared<fcl::Sphered>(set->radius);
    default:
        return hull(set);
    }
}

void *make(const peer_set *set)
{
    body *b = new body{shape(set), fcl::Transform3d::Identity()};
    for (int i = 0; i < 3 && set->posed; i++) {
        b->pose.translation()[i] = set->p[i];
        for (int j = 0; j < 3; j++) {
            b->pose.linear()(i, j) = set->m[3 * i + j];
        }
    }
    return b;
}

void discard(void *made) { delete static_cast<body *>(made); }

/* ---- questions ---- */

const char own_name[] = "FCL own GJK";

fcl::GJKSolverType solver_of(const peer *p) { return p->library == own_name ? fcl::GST_INDEP : fcl::GST_LIBCCD; }

double distance(const void *a, const void *b, const fcl::DistanceRequestd &request, fcl::DistanceResultd *result)
{
    const body *x = static_cast<const body *>(a), *y = static_cast<const body *>(b);
    return fcl::distance(x->shape.get(), x->pose, y->shape.get(), y->pose, request, *result);
}

/* It returns -1 where they meet, and the largest number where it found nothing. */
int how_far(const peer *p, const void *a, const void *b, void *, peer_answer *out)
try {
    fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    request.gjk_solver_type = solver_of(p);
    request.distance_tolerance = p->setting;
    double d = distance(a, b, request, &result);
    out->meet = d <= 0;
    out->distance = d <= 0 ? 0 : d;
    return d == std::numeric_limits<double>::max();
} catch (const std::exception &) {
    return 1;
}

/* It tells the way out by the two points alone. */
int signed_distance(const peer *p, const void *a, const void *b, void *, peer_answer *out)
try {
    fcl::DistanceRequestd request(true, true);
    fcl::DistanceResultd result;
    request.distance_tolerance = p->setting;
    double d = distance(a, b, request, &result);
    fcl::Vector3d normal = (result.nearest_points[0] - result.nearest_points[1]).normalized();
    out->meet = d <= 0;
    out->depth = -d;
    for (int i = 0; i < 3; i++) {
        out->normal[i] = normal[i];
    }
    return d == std::numeric_limits<double>::max();
} catch (const std::exception &) {
    return 1;
}

void collide(const peer *p, const void *a, const void *b, bool deep, void *memory, fcl::CollisionResultd *result)
{
    const body *x = static_cast<const body *>(a), *y = static_cast<const body *>(b);
    fcl::CollisionRequestd request(1, deep);
    request.gjk_solver_type = solver_of(p);
    request.gjk_tolerance = p->setting;
    if (memory) {
        fcl::Vector3d guess = Eigen::Map<fcl::Vector3d>(static_cast<double *>(memory));
        request.enable_cached_gjk_guess = true;
        request.cached_gjk_guess = guess.isZero() ? fcl::Vector3d(1, 0, 0) : guess;
    }
    fcl::collide(x->shape.get(), x->pose, y->shape.get(), y->pose, request, *result);
    if (memory) {
        Eigen::Map<fcl::Vector3d>(static_cast<double *>(memory)) = result->cached_gjk_guess;
    }
}

int meet(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
try {
    fcl::CollisionResultd result;
    collide(p, a, b, false, memory, &result);
    out->meet = result.isCollision();
    return 0;
} catch (const std::exception &) {
    return 1;
}

/* Where it has no way of its own for the pair, the depth comes below 0, and the normal from b to a, in the frame of a.
 */
int contact(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
try {
    fcl::CollisionResultd result;
    collide(p, a, b, true, memory, &result);
    out->meet = result.isCollision();
    if (out->meet) {
        double depth = result.getContact(0).penetration_depth;
        fcl::Vector3d normal = result.getContact(0).normal;
        if (depth < 0) {
            normal = -(static_cast<const body *>(a)->pose.linear() * normal);
        }
        out->depth = std::abs(depth);
        for (int i = 0; i < 3; i++) {
            out->normal[i] = normal[i];
        }
    }
    return 0;
} catch (const std::exception &) {
    return 1;
}

/* ---- settings ---- */

peer setting(bool own, double value, size_t memory)
{
    peer p = tolerant_peer(own ? own_name : "FCL", value, value == 1e-6, PEER_VERSION); /* as it comes */
    p.memory = memory;
    p.how[DISTANCE] = own ? "distance, GST_INDEP" : "distance, GST_LIBCCD";
    p.how[INTERSECT] = own ? "collide, GST_INDEP" : "collide, GST_LIBCCD";
    p.how[PENETRATION] =
        own ? "contact of collide of its shapes, GST_INDEP" : "signed distance of its shapes, GST_LIBCCD";
    p.make = make;
    p.discard = discard;
    p.query[DISTANCE] = memory ? nullptr : how_far;
    p.query[INTERSECT] = meet;
    p.query[PENETRATION] = own ? contact : signed_distance;
    return p;
}

} // namespace

/* Only its own solver takes a guess, and not for the distance. */
const peer *gjk_peers(int *count)
{
    static std::vector<peer> all;
    if (all.empty()) {
        for (double value : {1e-6, 1e-2, 1e-3, 1e-4, 1e-8, 1e-10, 1e-12}) {
            all.push_back(setting(false, value, 0));
            all.push_back(setting(true, value, 0));
        }
        all.push_back(setting(true, 1e-6, 3 * sizeof(double)));
    }
    *count = static_cast<int>(all.size());
    return all.data();
}
