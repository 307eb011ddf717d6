/* SPDX-License-Identifier: MIT */
/* Peers are loaded from modules and asked in a process of their own, so that one which crashes or hangs is counted and
 * no more. */
#ifndef ASK_H
#define ASK_H

#include <stddef.h>
#include "fed.h"

#define MOST_PEERS 16

typedef struct peer_list {
    const peer *all[MOST_PEERS];
    int count;
} peer_list;

enum outcome {
    NOT_ASKED, /* too many points, a radius, or out of the range of its numbers */
    ANSWERED,
    GAVE_UP, /* said so itself, or answered no number */
    CRASHED,
    HUNG /* longer than TIME_LIMIT on the processor */
};

#define TIME_LIMIT 0.25 /* in seconds */

typedef struct reply {
    enum outcome outcome;
    peer_answer answer;
} reply;

/* Adds the peers of one module. Whether it could be loaded. */
int load_peers(peer_list *list, const char *path);

/* The replies come back in shared memory that lives to the end of the process. */
reply *reply_space(int count);

void ask_peer(const peer *p, const fed *pairs, int count, reply *replies);

#endif
