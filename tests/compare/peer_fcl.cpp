/* SPDX-License-Identifier: MIT */
/* FCL: the distance between two convex hulls, in double, by either of its solvers. */
#include "peer.h"

#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include <exception>
#include <limits>

namespace
{

typedef fcl::Convexd hull;

/* Distance asks a hull for farthest vertices and an inner point, never for its faces: one that holds all vertices will
 * do, and makes the search look at each of them. */
void *make(const peer_set *set)
{
    auto points = std::make_shared<std::vector<fcl::Vector3d>>();
    auto face = std::make_shared<std::vector<int>>(1, set->count);
    for (int k = 0; k < set->count; k++) {
        points->emplace_back(set->v[3 * k], set->v[3 * k + 1], set->v[3 * k + 2]);
        face->push_back(k);
    }
    return new std::shared_ptr<hull>(std::make_shared<hull>(points, 1, face));
}

/* It returns -1 where they meet, and the largest number where it found nothing. */
int ask(const void *a, const void *b, fcl::GJKSolverType solver, peer_answer *out)
try {
    fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    request.gjk_solver_type = solver;
    double d = fcl::distance(static_cast<const std::shared_ptr<hull> *>(a)->get(), fcl::Transform3d::Identity(),
                             static_cast<const std::shared_ptr<hull> *>(b)->get(), fcl::Transform3d::Identity(),
                             request, result);
    out->meet = d <= 0;
    out->distance = d <= 0 ? 0 : d;
    return d == std::numeric_limits<double>::max();
} catch (const std::exception &) {
    return 1;
}

int by_ccd(const void *a, const void *b, peer_answer *out) { return ask(a, b, fcl::GST_LIBCCD, out); }
int by_own(const void *a, const void *b, peer_answer *out) { return ask(a, b, fcl::GST_INDEP, out); }
void discard(void *made) { delete static_cast<std::shared_ptr<hull> *>(made); }

const peer ccd = {"FCL",  PEER_VERSION, "distance of Convex, GST_LIBCCD, tolerances as they come", 3, 0, 0, 0, 1, make,
                  by_ccd, discard};
const peer own = {
    "FCL own GJK", PEER_VERSION, "distance of Convex, GST_INDEP, tolerances as they come", 3, 0, 0, 0, 1, make,
    by_own,        discard};
const peer *const all[] = {&ccd, &own, nullptr};

} // namespace

const peer *const *gjk_peers() { return all; }
