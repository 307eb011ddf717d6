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

void *make(const peer_set *set)
{
    btConvexHullShape *hull = new btConvexHullShape;
    for (int k = 0; k < set->count; k++) {
        const double *x = set->v + 3 * k;
        hull->addPoint(btVector3(btScalar(x[0]), btScalar(x[1]), btScalar(x[2])), false);
    }
    hull->setMargin(btScalar(set->radius));
    hull->recalcLocalAabb();
    return hull;
}

int ask(const void *a, const void *b, btPointCollector *answer)
{
    const btConvexHullShape *hull_a = static_cast<const btConvexHullShape *>(a);
    const btConvexHullShape *hull_b = static_cast<const btConvexHullShape *>(b);
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver depth;
    btGjkPairDetector detector(hull_a, hull_b, &simplex, &depth);
    btGjkPairDetector::ClosestPointInput in;
    in.m_transformA.setIdentity();
    in.m_transformB.setIdentity();
    detector.getClosestPoints(in, *answer, nullptr);
    return !answer->m_hasResult;
}

int query(const void *a, const void *b, peer_answer *out)
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
int penetration(const void *a, const void *b, peer_answer *out)
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

void discard(void *made) { delete static_cast<btConvexHullShape *>(made); }

#define HOW "btGjkPairDetector with EPA, margins = radii"
const peer bullet = {"Bullet", PEER_VERSION, HOW,     HOW,   3,          sizeof(btScalar) == sizeof(float), 0, 1, 0,
                     1,        make,         discard, query, penetration};
const peer *const all[] = {&bullet, nullptr};

} // namespace

const peer *const *gjk_peers() { return all; }
