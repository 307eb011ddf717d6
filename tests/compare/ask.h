/* SPDX-License-Identifier: MIT */
/* Peers are loaded from modules and asked in a process of their own, so that one which crashes or hangs is counted and
 * no more. */
#ifndef ASK_H
#define ASK_H

#include <stddef.h>
#include "fed.h"

#define MOST_PEERS 256
#define MOST_MODULES 16

typedef struct peer_list {
    const peer *all[MOST_PEERS];
    const char *missing[MOST_MODULES];
    int count, missing_count;
} peer_list;

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
/* Only those that are set as their documentation has it, and start cold. */
void keep_usual(peer_list *list);
/* As two members of a JSON object. */
void print_peers(const peer_list *list);

int takes_pair(const peer *p, const fed *pair);

/* Memory that children share, zeros at first. */
void *shared_space(size_t size);
void give_back(void *space, size_t size);

/* The body of a set, which along a track is that of the first under another pose; first NULL: it is the first. */
void *make_body(const peer *p, const peer_set *set, const void *first);

/* What peers of one make answer, each into its own replies, which are in shared memory. Pairs of a track, so many
 * one after another, share what the peer keeps in mind. */
void ask_peers(const peer *const *peers, int peer_count, enum question question, const fed *pairs, int count, int track,
               reply *const *replies);

#endif
