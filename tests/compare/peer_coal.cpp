/* SPDX-License-Identifier: MIT */
/* coal: distance, whether they meet and how deep, in double, by its dispatch over its own shapes. */
#include "peer.h"

#include <coal/collision.h>
#include <coal/distance.h>
#include <coal/shape/geometric_shapes.h>
#include <cmath>
#include <exception>
#include <memory>
#include <vector>

namespace
{

struct body {
    std::unique_ptr<coal::ShapeBase> shape;
    coal::Transform3s pose;
};

/* With the neighbours of its corners, along which it climbs where there are many. */
coal::ShapeBase *hull(const peer_set *set)
{
    auto points = std::make_shared<std::vector<coal::Vec3s>>();
    for (int k = 0; k < set->count; k++) {
        points->emplace_back(set->v[3 * k], set->v[3 * k + 1], set->v[3 * k + 2]);
    }
    return coal::ConvexBase::convexHull(points, static_cast<unsigned>(set->count), true);
}

/* Segments lie along the last axis, as its capsules do. */
coal::ShapeBase *shape(const peer_set *set)
{
    const double *size = set->size;
    switch (set->core) {
    case PEER_BOX:
        return new coal::Box(2 * size[0], 2 * size[1], 2 * size[2]);
    case PEER_SEGMENT:
        return new coal::Capsule(set->radius, 2 * std::abs(set->v[2]));
    case PEER_CYLINDER:
        return new coal::Cylinder(size[0], 2 * size[1]);
    case PEER_CONE:
        return new coal::Cone(size[0], 2 * size[1]);
    case PEER_ELLIPSOID:
        return new coal::Ellipsoid(size[0], size[1], size[2]);
    case PEER_ORIGIN:
        return new coal::Sphere(set->radius);
    default:
        return hull(set);
    }
}

void *make(const peer_set *set)
try {
    std::unique_ptr<body> b(new body{std::unique_ptr<coal::ShapeBase>(shape(set)), coal::Transform3s::Identity()});
    if (set->posed) {
        b->pose.setRotation(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(set->m));
        b->pose.setTranslation(Eigen::Map<const coal::Vec3s>(set->p));
    }
    if (set->core == PEER_POINTS || set->core == PEER_BOX) {
        b->shape->setSweptSphereRadius(set->radius);
    }
    return b.release();
} catch (const std::exception &) {
    return nullptr;
}

void discard(void *made) { delete static_cast<body *>(made); }

/* ---- questions ---- */

/* What is kept of a pair. */
struct guess {
    double dir[3];
    int hint[2], known;
};

void set_up(const peer *p, const void *memory, coal::QueryRequest *request)
{
    request->gjk_tolerance = request->epa_tolerance = p->setting;
    const guess *g = static_cast<const guess *>(memory);
    if (g && g->known) {
        request->gjk_initial_guess = coal::GJKInitialGuess::CachedGuess;
        request->cached_gjk_guess = Eigen::Map<const coal::Vec3s>(g->dir);
        request->cached_support_func_guess = Eigen::Map<const coal::support_func_guess_t>(g->hint);
    }
}

void keep(void *memory, const coal::QueryResult &result)
{
    guess *g = static_cast<guess *>(memory);
    if (g) {
        g->known = 1;
        Eigen::Map<coal::Vec3s>(g->dir) = result.cached_gjk_guess;
        Eigen::Map<coal::support_func_guess_t>(g->hint) = result.cached_support_func_guess;
    }
}

/* Signed where asked so; then with the way out. */
coal::DistanceResult measure(const peer *p, const void *a, const void *b, bool is_signed, void *memory)
{
    const body *x = static_cast<const body *>(a), *y = static_cast<const body *>(b);
    coal::DistanceRequest request(true, is_signed);
    coal::DistanceResult result;
    set_up(p, memory, &request);
    coal::distance(x->shape.get(), x->pose, y->shape.get(), y->pose, request, result);
    keep(memory, result);
    return result;
}

int distance(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
try {
    double d = measure(p, a, b, false, memory).min_distance;
    out->meet = !(d > 0);
    out->distance = out->meet ? 0 : d;
    return 0;
} catch (const std::exception &) {
    return 1;
}

int penetration(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
try {
    coal::DistanceResult result = measure(p, a, b, true, memory);
    out->meet = !(result.min_distance > 0);
    out->depth = -result.min_distance;
    for (int i = 0; i < 3; i++) {
        out->normal[i] = result.normal[i];
    }
    return 0;
} catch (const std::exception &) {
    return 1;
}

int intersect(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
try {
    const body *x = static_cast<const body *>(a), *y = static_cast<const body *>(b);
    coal::CollisionRequest request(coal::NO_REQUEST, 1);
    coal::CollisionResult result;
    set_up(p, memory, &request);
    coal::collide(x->shape.get(), x->pose, y->shape.get(), y->pose, request, result);
    keep(memory, result);
    out->meet = result.isCollision();
    return 0;
} catch (const std::exception &) {
    return 1;
}

/* ---- settings ---- */

const double usual = 1e-6; /* GJK_DEFAULT_TOLERANCE, EPA_DEFAULT_TOLERANCE */

peer setting(double tolerance, size_t memory)
{
    peer p = tolerant_peer("coal", tolerance, tolerance == usual, PEER_VERSION);
    p.memory = memory;
    p.how[DISTANCE] = "distance, unsigned";
    p.how[INTERSECT] = "collide, without contacts";
    p.how[PENETRATION] = "distance, signed";
    p.radii = 1;
    p.make = make;
    p.discard = discard;
    p.query[DISTANCE] = distance;
    p.query[INTERSECT] = intersect;
    p.query[PENETRATION] = penetration;
    return p;
}

} // namespace

const peer *gjk_peers(int *count)
{
    static std::vector<peer> all;
    if (all.empty()) {
        for (double tolerance : {usual, 1e-2, 1e-3, 1e-4, 1e-8, 1e-10, 1e-12}) {
            all.push_back(setting(tolerance, 0));
        }
        all.push_back(setting(usual, sizeof(guess)));
    }
    *count = static_cast<int>(all.size());
    return all.data();
}
