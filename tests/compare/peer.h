/* SPDX-License-Identifier: MIT */
/* What another library is asked through. Each peer is a module of its own, loaded at run time, so that one which is not
 * installed is missed by name and no other is hurt by it. */
#ifndef PEER_H
#define PEER_H

#ifdef __cplusplus
extern "C" {
#endif

enum peer_core { PEER_POINTS, PEER_BOX, PEER_SEGMENT, PEER_CYLINDER, PEER_ELLIPSOID, PEER_ORIGIN };

/* A convex core, posed and grown by a ball. The numbers are of the peer's own precision, whatever they are kept in. */
typedef struct peer_set {
    enum peer_core core;
    int count;       /* of points */
    const double *v; /* points, segment: count times dim coordinates */
    double size[3];  /* box, ellipsoid: half the sides, the radii; cylinder, about the last axis: its radius, half its
                        length */
    int posed;       /* 1: x goes to m x + p */
    double m[9], p[3];
    double radius;
} peer_set;

typedef struct peer_answer {
    int meet;         /* 1 or 0 */
    double distance;  /* 0 where they meet; of a peer that only says whether: not set */
    double depth;     /* of penetration, where they meet: to be moved by, */
    double normal[3]; /*   b along it, unit */
} peer_answer;

/* What is done for each question. Not 0: the peer itself says that it has no answer. */
typedef int peer_query(const void *a, const void *b, peer_answer *out);

typedef struct peer {
    const char *name;
    const char *version; /* and where it is from */
    const char *how;     /* query is asked: function, settings */
    const char *how_deep;
    int dim;
    int single;      /* 1: float, 0: double */
    int most_points; /* of one set; 0: any number */
    int radii;       /* 1: takes them */
    int cores;       /* 1: takes other cores than points, and poses */
    int distances;   /* 1: query measures, 0: it says whether they meet and no more */

    /* What is done once for each body. The set outlives what is made of it. NULL: the peer refuses. */
    void *(*make)(const peer_set *set);
    void (*discard)(void *made);
    peer_query *query;       /* how far apart; NULL: not to be asked */
    peer_query *penetration; /* how deep; likewise */
} peer;

/* The one function that a module exports: its peers, a NULL after the last. */
typedef const peer *const *peers_fn(void);
#define PEERS_FN "gjk_peers"
#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
const peer *const *
gjk_peers(void);

#ifdef __cplusplus
}
#endif

#endif
