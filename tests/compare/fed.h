/* SPDX-License-Identifier: MIT */
/* The truth about exactly what a peer is fed, and that as a case. In double whatever the peer: its numbers are doubles.
 */
#ifndef FED_H
#define FED_H

#include <stdio.h>
#include "../quad.h"
#include "peer.h"

typedef struct fed {
    int dim;
    peer_set a, b;
    quad lower, upper; /* of the signed separation */
    quad scale;
    double *numbers[2]; /* of the two sets, to be freed */
} fed;

/* What there is to do, for each of the two dimensions. */
typedef struct fed_space {
    void (*find_truth)(fed *f);
    int (*find_separation)(const fed *f, const double *normal, quad *separation);
    void (*print_case)(FILE *out, const fed *f, const char *query);
} fed_space;
extern const fed_space fed_in_2, fed_in_3;

static inline const fed_space *space_of(const fed *f) { return f->dim == 2 ? &fed_in_2 : &fed_in_3; }

static inline void find_fed_truth(fed *f) { space_of(f)->find_truth(f); }

/* Of a pair whose truth was found, along a normal from a to b. 0: it is not unit. */
static inline int find_fed_separation(const fed *f, const double *normal, quad *separation)
{
    return space_of(f)->find_separation(f, normal, separation);
}

static inline void print_fed_case(FILE *out, const fed *f, const char *query)
{
    space_of(f)->print_case(out, f, query);
}

#endif
