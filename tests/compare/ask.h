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
    const char *missing[MOST_PEERS];
    int count, missing_count;
} peer_list;

enum question { HOW_FAR, HOW_DEEP };

enum outcome {
    NOT_ASKED, /* too many points, a radius, another core, or out of the range of its numbers */
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

/* Loads the peers of NAME=MODULE each; where that cannot be done, says so and notes the name as missing. Returns how
 * many are missing that GJK_COMPARE_NEEDS names in the environment, -1: bad arguments. */
int load_peers(peer_list *list, int count, char **arguments);
/* As two members of a JSON object. */
void print_peers(const peer_list *list);

/* The function that answers; NULL: it has none. */
peer_query *query_of(const peer *p, enum question question);
int takes_pair(const peer *p, const fed *pair);

/* The replies come back in shared memory that lives to the end of the process. */
reply *reply_space(int count);

void ask_peer(const peer *p, enum question question, const fed *pairs, int count, reply *replies);

#endif
