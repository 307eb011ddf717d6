/* SPDX-License-Identifier: MIT */
/* Answers about two bodies, held against the truth about what was fed. */
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
    UNDECIDED, /* whether they meet, though far from contact */
    ABSURD,    /* a length far beyond any that the pair has: no answer, but a number left over from the search */
    FAILURES
};

#define WRONG 0.01

/* Of one answer; lengths in scales of the pair. */
typedef struct judgement {
    enum failure failure;
    double error;    /* of the distance or depth; where a touch was not seen, all of it */
    double relative; /* the same as a part of the truth, where that is more than rounding, else of the scale */
    int wrong;       /* that is more than WRONG, and more than rounding, and than the peer allows itself; a verdict
                        likewise; a bracket without the truth in it, whatever else there is to say */
    double excess;   /* what b must be moved along the normal beyond the depth */
    double promised; /* the width of the bracket */
} judgement;

typedef struct score {
    enum question question;
    long asked, failed[FAILURES];
    long wrong;                               /* of those that did not fail */
    double error, relative, excess, promised; /* the largest of those */
    long example;                             /* the first failure, else the largest error; -1: none */
    judgement worst;                          /* of it */
} score;

/* How far a value is off a bracket. */
static inline quad off(quad value, quad low, quad high)
{
    return value > high ? value - high : value < low ? low - value : 0;
}

void start_score(score *s, enum question question);
/* Not of replies that were not asked for. */
judgement judge_answer(score *s, const peer *p, const fed *f, const reply *r, long index);
long failures_of(const score *s);
const char *failure_name(enum failure failure);
/* As members of a JSON object, each after a comma. */
void print_score(const score *s, const fed *pairs, const reply *replies);
void print_number(const char *key, double x);

#endif
