/* SPDX-License-Identifier: MIT */
/* Bullet: the distance between two hulls, or their depth, by its pair detector, whose margins are radii. */
#include "peer.h"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

namespace
{

struct body {
    btConvexHullShape hull;
    btTransform pose;
};

void add_point(btConvexHullShape *hull, double x, double y, double z)
{
    hull->addPoint(btVector3(btScalar(x), btScalar(y), btScalar(z)), false);
}

/* A box is the hull of its corners: the margin of its own box shape would have to be taken off. */
void *make(const peer_set *set)
{
    body *made = new body;
    const double *size = set->size, *m = set->m, *p = set->p;
    for (int k = 0; k < set->count; k++) {
        add_point(&made->hull, set->v[3 * k], set->v[3 * k + 1], set->v[3 * k + 2]);
    }
    for (int k = 0; k < 8 && set->core == PEER_BOX; k++) {
        add_point(&made->hull, k & 1 ? size[0] : -size[0], k & 2 ? size[1] : -size[1], k & 4 ? size[2] : -size[2]);
    }
    if (set->core == PEER_ORIGIN) {
        add_point(&made->hull, 0, 0, 0);
    }
    made->hull.setMargin(btScalar(set->radius));
    made->hull.recalcLocalAabb();
    made->pose.setIdentity();
    if (set->posed) {
        made->pose.setBasis(btMatrix3x3(btScalar(m[0]), btScalar(m[1]), btScalar(m[2]), btScalar(m[3]), btScalar(m[4]),
                                        btScalar(m[5]), btScalar(m[6]), btScalar(m[7]), btScalar(m[8])));
        made->pose.setOrigin(btVector3(btScalar(p[0]), btScalar(p[1]), btScalar(p[2])));
    }
    return made;
}

int ask(const void *a, const void *b, btPointCollector *answer)
{
    const body *x = static_cast<const body *>(a), *y = static_cast<const body *>(b);
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver depth;
    btGjkPairDetector detector(&x->hull, &y->hull, &simplex, &depth);
    btGjkPairDetector::ClosestPointInput in;
    in.m_transformA = x->pose;
    in.m_transformB = y->pose;
    detector.getClosestPoints(in, *answer, nullptr);
    return !answer->m_hasResult;
}

int distance(const peer *, const void *a, const void *b, void *, peer_answer *out)
{
    btPointCollector answer;
    if (ask(a, b, &answer)) {
        return 1;
    }
    out->meet = !(answer.m_distance > 0);
    out->distance = out->meet ? 0 : double(answer.m_distance);
    return 0;
}

/* Its normal points from b to a. */
int penetration(const peer *, const void *a, const void *b, void *, peer_answer *out)
{
    btPointCollector answer;
    if (ask(a, b, &answer)) {
        return 1;
    }
    out->meet = !(answer.m_distance > 0);
    out->depth = -double(answer.m_distance);
    for (int i = 0; i < 3; i++) {
        out->normal[i] = -double(answer.m_normalOnBInWorld[i]);
    }
    return 0;
}

void discard(void *made) { delete static_cast<body *>(made); }

peer setting()
{
    peer p = peer();
    p.library = "Bullet";
    p.knob = "none";
    p.usual = 1;
    p.version = PEER_VERSION;
    p.how[DISTANCE] = p.how[INTERSECT] = p.how[PENETRATION] = "btGjkPairDetector with EPA, margins = radii";
    p.dim = 3;
    p.single = sizeof(btScalar) == sizeof(float);
    p.cores = CORE(POINTS) | CORE(BOX) | CORE(SEGMENT) | CORE(ORIGIN);
    p.poses = p.radii = 1;
    p.make = make;
    p.discard = discard;
    p.query[DISTANCE] = p.query[INTERSECT] = distance;
    p.query[PENETRATION] = penetration;
    return p;
}

} // namespace

const peer *gjk_peers(int *count)
{
    static const peer bullet = setting();
    *count = 1;
    return &bullet;
}
