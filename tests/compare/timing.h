/* SPDX-License-Identifier: MIT */
/* What answers cost: nanoseconds on the processor, or under callgrind instructions. */
#ifndef TIMING_H
#define TIMING_H

#include "peer.h"

/* One peer, set in one way, and the pairs that it is to answer. */
typedef struct run {
    const peer *p;
    peer_query *query;   /* NULL: its support calls alone */
    void *const *bodies; /* a and b of each pair */
    char *memory;        /* what it keeps in mind, one after another; NULL: it starts cold each time */
    const long *track;   /* of each pair, which of these is its own */
    long tracks;
    const int *calls;     /* of each pair, where there is no query */
    double least, median; /* set by time_runs, in nanoseconds an answer */
} run;

/* Asked as any peer is, it answers at once: what asking costs by itself. */
int ask_nothing(const peer *p, const void *a, const void *b, void *memory, peer_answer *out);

/* In each round everyone in turn answers all pairs. */
void time_runs(run *runs, int count, long pairs, long rounds);

/* A pass, so that what is done once is done. */
void run_once(const run *r, long pairs);

/* Has callgrind write the instructions of one pass under this label. */
void count_run(const run *r, long pairs, const char *label);

double median(double *x, long count);

#endif
