/* SPDX-License-Identifier: MIT */
/* What another library is asked through. Each is a module of its own, loaded at run time, so that one which is not
 * installed is missed by name and no other is hurt by it. A module holds peers: its library, once for each setting. */
#ifndef PEER_H
#define PEER_H

#include <stddef.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

enum peer_core { PEER_POINTS, PEER_BOX, PEER_SEGMENT, PEER_CYLINDER, PEER_CONE, PEER_ELLIPSOID, PEER_ORIGIN };
#define ROTATIONS 2
#define CORE(name) (1u << PEER_##name)
#define ALL_CORES                                                                                                      \
    (CORE(POINTS) | CORE(BOX) | CORE(SEGMENT) | CORE(CYLINDER) | CORE(CONE) | CORE(ELLIPSOID) | CORE(ORIGIN))

/* A convex core, posed and grown by a ball. The numbers are of the pair's precision, whatever they are kept in. */
typedef struct peer_set {
    enum peer_core core;
    int count;       /* of points */
    const double *v; /* points, segment: count times dim coordinates */
    double size[3];  /* box, ellipsoid: half the sides, the radii; cylinder, cone, about the last axis: the radius, half
                        the length */
    int posed;       /* 1: x goes to m x + p */
    double m[9], p[3];
    double radius;
} peer_set;

enum question { DISTANCE, INTERSECT, PENETRATION, QUESTIONS };

typedef struct peer_answer {
    int meet;            /* 1 or 0; -1: it cannot tell */
    double distance;     /* 0 where they meet */
    double depth;        /* of penetration, where they meet: to be moved by, */
    double normal[3];    /*   b along it, unit */
    double lower, upper; /* of a peer that proves: of the distance, else of the signed separation */
    double supports;     /* likewise: the support calls made, of both sets */
} peer_answer;

struct peer;
/* memory is of one pair, or NULL. Not 0: the peer itself says that it has no answer. */
typedef int peer_query(const struct peer *p, const void *a, const void *b, void *memory, peer_answer *out);

typedef struct peer {
    const char *library;
    const char *knob; /* what is set: "tolerance", "steps", "tight"; "none" */
    double setting;   /*   to this */
    int usual;        /* 1: as its documentation has it; of ours: without options */
    size_t memory;    /* of bytes, 0 at first, that it keeps of a pair from query to query; 0: each starts cold */
    double tolerance[QUESTIONS]; /* what the setting lets its answers be off by, in lengths; of one that proves: 0 */
    const char *version;         /* and where it is from */
    const char *how[QUESTIONS];  /* it is asked: functions, fixed settings; "": not at all */
    int dim;
    int single;      /* 1: float, 0: double */
    int proves;      /* 1: gives a bracket */
    unsigned cores;  /* that it takes */
    int poses;       /* 1: takes them; ROTATIONS: keeps a rotation, which one in float is not to a double */
    int radii;       /* 1: takes points grown by them */
    int most_points; /* of one set; 0: any number */

    /* What is done once for each body. The set outlives what is made of it. NULL: the peer refuses. The same make, the
     * same body. */
    void *(*make)(const peer_set *set);
    void (*discard)(void *made);
    /* The same body, made before, under the pose of this set, and discarded before it. NULL: it is made anew. */
    void *(*again)(const void *made, const peer_set *set);
    peer_query *query[QUESTIONS]; /* NULL: not to be asked */
    /* So many support calls, on one and the other in turn, and nothing else; NULL: it is not to be told apart. */
    void (*supports)(const void *a, const void *b, int count);
} peer;

/* What those in 3-D with one tolerance, which holds for all questions, have in common. */
static inline peer tolerant_peer(const char *library, double tolerance, int usual, const char *version)
{
    peer p;
    memset(&p, 0, sizeof p);
    p.library = library;
    p.knob = "tolerance";
    p.setting = p.tolerance[DISTANCE] = p.tolerance[INTERSECT] = p.tolerance[PENETRATION] = tolerance;
    p.usual = usual;
    p.version = version;
    p.dim = 3;
    p.cores = ALL_CORES;
    p.poses = 1;
    return p;
}

/* The one function that a module exports: its peers. */
typedef const peer *peers_fn(int *count);
#define PEERS_FN "gjk_peers"
#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
const peer *
gjk_peers(int *count);

#ifdef __cplusplus
}
#endif

#endif
