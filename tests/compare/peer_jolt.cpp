/* SPDX-License-Identifier: MIT */
/* Jolt: GJK and EPA, in float, on shapes that say their farthest points, grown by its convex radius. */
#include "peer.h"

#include <Jolt/Jolt.h>

#include <Jolt/Geometry/EPAPenetrationDepth.h>
#include <Jolt/Geometry/GJKClosestPoint.h>
#include <vector>

namespace
{

using JPH::Mat44;
using JPH::Vec3;
using JPH::Vec3Arg;

/* A core in its own frame. */
struct shape {
    peer_core core;
    Vec3 size;
    std::vector<Vec3> points;
    float radius;

    Vec3 GetSupport(Vec3Arg dir) const;
};

struct body {
    shape of;
    Mat44 pose;
};

Vec3 farthest_point(const std::vector<Vec3> &points, Vec3Arg dir)
{
    size_t at = 0;
    float best = -FLT_MAX;
    for (size_t k = 0; k < points.size(); k++) {
        float along = points[k].Dot(dir);
        if (along > best) {
            best = along;
            at = k;
        }
    }
    return points[at];
}

/* On the rim about the last axis, at this height. */
Vec3 farthest_of_rim(float radius, float height, Vec3Arg dir)
{
    float length = std::sqrt(dir.GetX() * dir.GetX() + dir.GetY() * dir.GetY()), by = length > 0 ? radius / length : 0;
    return Vec3(by * dir.GetX(), by * dir.GetY(), height);
}

Vec3 farthest_of_cone(Vec3Arg size, Vec3Arg dir)
{
    float radius = size.GetX(), half = size.GetY();
    float length = std::sqrt(dir.GetX() * dir.GetX() + dir.GetY() * dir.GetY());
    return 2 * half * dir.GetZ() >= radius * length ? Vec3(0, 0, half) : farthest_of_rim(radius, -half, dir);
}

Vec3 farthest_of_ellipsoid(Vec3Arg radii, Vec3Arg dir)
{
    Vec3 x = radii * dir;
    float length = x.Length();
    return length > 0 ? radii * x / length : Vec3::sZero();
}

Vec3 shape::GetSupport(Vec3Arg dir) const
{
    switch (core) {
    case PEER_BOX:
        return Vec3::sSelect(size, -size, Vec3::sLess(dir, Vec3::sZero()));
    case PEER_CYLINDER:
        return farthest_of_rim(size.GetX(), dir.GetZ() < 0 ? -size.GetY() : size.GetY(), dir);
    case PEER_CONE:
        return farthest_of_cone(size, dir);
    case PEER_ELLIPSOID:
        return farthest_of_ellipsoid(size, dir);
    case PEER_ORIGIN:
        return Vec3::sZero();
    default:
        return farthest_point(points, dir);
    }
}

Vec3 vector(const double *x) { return Vec3(float(x[0]), float(x[1]), float(x[2])); }

void *make(const peer_set *set)
{
    body *b = new body{{set->core, vector(set->size), {}, float(set->radius)}, Mat44::sIdentity()};
    for (int k = 0; k < set->count; k++) {
        b->of.points.push_back(vector(set->v + 3 * k));
    }
    for (unsigned i = 0; i < 3 && set->posed; i++) {
        b->pose.SetColumn3(i, Vec3(float(set->m[i]), float(set->m[3 + i]), float(set->m[6 + i])));
    }
    if (set->posed) {
        b->pose.SetTranslation(vector(set->p));
    }
    return b;
}

void discard(void *made) { delete static_cast<body *>(made); }

/* ---- questions ---- */

/* Two bodies in the frame of the first, as its own queries have them. */
struct couple {
    const shape &a;
    JPH::TransformedConvexObject<shape> b;
    const Mat44 &frame;
    float radii;

    couple(const body *x, const body *y)
        : a(x->of), b(x->pose.InversedRotationTranslation() * y->pose, y->of), frame(x->pose),
          radii(x->of.radius + y->of.radius)
    {
    }
    couple(const void *x, const void *y) : couple(static_cast<const body *>(x), static_cast<const body *>(y)) {}
};

/* The axis to begin with: that of before, else, as its documentation has it, the first. */
Vec3 first_axis(const void *memory)
{
    const float *x = static_cast<const float *>(memory);
    Vec3 axis = x ? Vec3(x[0], x[1], x[2]) : Vec3::sZero();
    return axis.IsNearZero() ? Vec3::sAxisX() : axis;
}

void keep(void *memory, Vec3Arg axis)
{
    if (memory) {
        axis.StoreFloat3(static_cast<JPH::Float3 *>(memory));
    }
}

int distance(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    couple c(a, b);
    JPH::GJKClosestPoint gjk;
    Vec3 axis = first_axis(memory), x, y;
    float d = std::sqrt(gjk.GetClosestPoints(c.a, c.b, float(p->setting), FLT_MAX, axis, x, y)) - c.radii;
    keep(memory, axis);
    out->meet = !(d > 0);
    out->distance = out->meet ? 0 : double(d);
    return 0;
}

/* Of bodies that are grown it asks whether the closest points are nearer than their radii. */
int intersect(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    couple c(a, b);
    JPH::GJKClosestPoint gjk;
    Vec3 axis = first_axis(memory), x, y;
    float tolerance = float(p->setting), most = c.radii * c.radii;
    out->meet = c.radii > 0 ? gjk.GetClosestPoints(c.a, c.b, tolerance, most, axis, x, y) <= most
                            : gjk.Intersects(c.a, c.b, tolerance, axis);
    keep(memory, axis);
    return 0;
}

int penetration(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    couple c(a, b);
    JPH::EPAPenetrationDepth epa;
    JPH::AddConvexRadius<shape> grown_a(c.a, c.a.radius);
    JPH::AddConvexRadius<JPH::TransformedConvexObject<shape>> grown_b(c.b, c.b.mObject.radius);
    Vec3 axis = first_axis(memory), x, y;
    float tolerance = float(p->setting);
    out->meet = epa.GetPenetrationDepth(c.a, grown_a, c.a.radius, c.b, grown_b, c.b.mObject.radius, tolerance,
                                        tolerance, axis, x, y);
    keep(memory, axis);
    if (out->meet) {
        Vec3 normal = c.frame.Multiply3x3(axis.NormalizedOr(Vec3::sZero()));
        out->depth = double((y - x).Length());
        for (unsigned i = 0; i < 3; i++) {
            out->normal[i] = double(normal[i]);
        }
    }
    return 0;
}

/* ---- settings ---- */

const double usual = 1e-4; /* cDefaultCollisionTolerance, cDefaultPenetrationTolerance */

peer setting(double tolerance, size_t memory)
{
    peer p = tolerant_peer("Jolt", tolerance, tolerance == usual, PEER_VERSION);
    p.memory = memory;
    p.how[DISTANCE] = "GJKClosestPoint::GetClosestPoints";
    p.how[INTERSECT] = "GJKClosestPoint::Intersects";
    p.how[PENETRATION] = "EPAPenetrationDepth::GetPenetrationDepth";
    p.single = 1;
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
        for (double tolerance : {usual, 1e-2, 1e-3, 1e-5, 1e-6}) {
            all.push_back(setting(tolerance, 0));
        }
        all.push_back(setting(usual, 3 * sizeof(float)));
    }
    *count = static_cast<int>(all.size());
    return all.data();
}
