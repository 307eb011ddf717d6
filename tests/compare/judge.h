/* SPDX-License-Identifier: MIT */
/* Answers to how deep two bodies overlap, held against the truth about what was fed. */
#ifndef JUDGE_H
#define JUDGE_H

#include "ask.h"

enum failure {
    SOUND,
    SAYS_NOTHING, /* gave up, or no number */
    DIES,
    HANGS,
    MISSES,    /* no overlap, or none deeper than 0, where it is deeper than rounding */
    NO_NORMAL, /* there, and no unit vector to go along */
    DEPTH_FAILURES
};

#define WRONG 0.01

/* Of one answer; lengths in scales of the pair. */
typedef struct judgement {
    enum failure failure;
    double error;    /* of the depth; where a touch was not seen, all of it */
    double relative; /* the same as a part of the depth, of pairs that overlap by more than rounding */
    int wrong;       /* that is more than WRONG, and more than rounding */
    double excess;   /* what b must be moved along the normal beyond the depth */
} judgement;

typedef struct depth_tally {
    long asked, failed[DEPTH_FAILURES];
    long wrong;                     /* of those that did not fail */
    double error, relative, excess; /* the largest of those */
    long example;                   /* the first failure, else the largest error; -1: none */
    judgement worst;                /* of it */
} depth_tally;

/* How far a value is off a bracket. */
static inline quad off(quad value, quad low, quad high)
{
    return value > high ? value - high : value < low ? low - value : 0;
}

/* Whether it overlaps by more than rounding its coordinates can do. */
int is_deep(const fed *f, int single);
void start_depth_tally(depth_tally *s);
/* Not of replies that were not asked for. */
judgement judge_depth(depth_tally *s, const peer *p, const fed *f, const reply *r, long index);
/* As members of a JSON object, each after a comma. */
void print_depth_tally(const depth_tally *s, const fed *pairs, const reply *replies);
void print_number(const char *key, double x);

#endif
