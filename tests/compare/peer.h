/* SPDX-License-Identifier: MIT */
/* What another library is asked through. Each peer is a module of its own, loaded at run time, so that one which is not
 * installed is missed by name and no other is hurt by it. */
#ifndef PEER_H
#define PEER_H

#ifdef __cplusplus
extern "C" {
#endif

/* The convex hull of points, grown by a ball. The numbers are of the peer's own precision, whatever they are kept in.
 */
typedef struct peer_set {
    int count;
    const double *v; /* count times dim */
    double radius;
} peer_set;

typedef struct peer_answer {
    int meet;        /* 1 or 0 */
    double distance; /* 0 where they meet; of a peer that only says whether: not set */
} peer_answer;

typedef struct peer {
    const char *name;
    const char *version; /* and where it is from */
    const char *how;     /* it is asked: function, settings */
    int dim;
    int single;      /* 1: float, 0: double */
    int most_points; /* of one set; 0: any number */
    int radii;       /* 1: takes them */
    int distances;   /* 1: measures, 0: says whether they meet and no more */

    /* What is done once for each body. The set outlives what is made of it. NULL: the peer refuses. */
    void *(*make)(const peer_set *set);
    /* What is done for each question. Not 0: the peer itself says that it has no answer. */
    int (*query)(const void *a, const void *b, peer_answer *out);
    void (*discard)(void *made);
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
