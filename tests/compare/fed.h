/* SPDX-License-Identifier: MIT */
/* The truth about exactly what a peer is fed, and that as a case. In double whatever the peer: its numbers are doubles.
 */
#ifndef FED_H
#define FED_H

#include <stdio.h>
#include "../quad.h"
#include "peer.h"

typedef struct fed {
    peer_set a, b;
    quad lower, upper; /* of the signed separation */
    quad scale;
    double *numbers[2]; /* of the two sets, to be freed */
} fed;

void find_fed_truth(fed *f);
/* Of a pair whose truth was found, along a normal from a to b. 0: it is not unit. */
int find_fed_separation(const fed *f, const double *normal, quad *separation);
void print_fed_case(FILE *out, const fed *f, const char *query);

#endif
