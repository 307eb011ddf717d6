/* SPDX-License-Identifier: MIT */
/* FCL: the distance between two convex hulls, or how deep two shapes of its own overlap, in double, by either solver.
 */
#include "peer.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
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

double distance(const void *a, const void *b, const fcl::DistanceRequestd &request, fcl::DistanceResultd *result)
{
    const body *x = static_cast<const body *>(a), *y = static_cast<const body *>(b);
    return fcl::distance(x->shape.get(), x->pose, y->shape.get(), y->pose, request, *result);
}

/* It returns -1 where they meet, and the largest number where it found nothing. */
int ask(const void *a, const void *b, fcl::GJKSolverType solver, peer_answer *out)
try {
    fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    request.gjk_solver_type = solver;
    double d = distance(a, b, request, &result);
    out->meet = d <= 0;
    out->distance = d <= 0 ? 0 : d;
    return d == std::numeric_limits<double>::max();
} catch (const std::exception &) {
    return 1;
}

/* It tells the way out by the two points alone. */
int signed_distance(const void *a, const void *b, peer_answer *out)
try {
    fcl::DistanceRequestd request(true, true);
    fcl::DistanceResultd result;
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

/* Where it has no way of its own for the pair, the depth comes below 0, and the normal from b to a, in the frame of a.
 */
int contact(const void *a, const void *b, peer_answer *out)
try {
    fcl::CollisionRequestd request(1, true);
    fcl::CollisionResultd result;
    request.gjk_solver_type = fcl::GST_INDEP;
    const body *x = static_cast<const body *>(a), *y = static_cast<const body *>(b);
    fcl::collide(x->shape.get(), x->pose, y->shape.get(), y->pose, request, result);
    out->meet = result.isCollision();
    if (out->meet) {
        double depth = result.getContact(0).penetration_depth;
        fcl::Vector3d normal = result.getContact(0).normal;
        if (depth < 0) {
            normal = -(x->pose.linear() * normal);
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

int by_ccd(const void *a, const void *b, peer_answer *out) { return ask(a, b, fcl::GST_LIBCCD, out); }
int by_own(const void *a, const void *b, peer_answer *out) { return ask(a, b, fcl::GST_INDEP, out); }
void discard(void *made) { delete static_cast<body *>(made); }

const peer ccd = {"FCL",
                  PEER_VERSION,
                  "distance of Convex, GST_LIBCCD, tolerances as they come",
                  "signed distance of its shapes, GST_LIBCCD, tolerances as they come",
                  3,
                  0,
                  0,
                  0,
                  1,
                  1,
                  make,
                  discard,
                  by_ccd,
                  signed_distance};
const peer own = {"FCL own GJK",
                  PEER_VERSION,
                  "distance of Convex, GST_INDEP, tolerances as they come",
                  "contact of collide of its shapes, GST_INDEP, tolerances as they come",
                  3,
                  0,
                  0,
                  0,
                  1,
                  1,
                  make,
                  discard,
                  by_own,
                  contact};
const peer *const all[] = {&ccd, &own, nullptr};

} // namespace

const peer *const *gjk_peers() { return all; }
