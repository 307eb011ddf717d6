/* SPDX-License-Identifier: MIT */
/* The binary file that all are asked from: blocks of pairs, one after another, each of a head and its pairs. Files can
 * be put together end to end. Numbers are as the machine has them.
 *
 * A pair is two sets; a set is core, count and posed as int32, a fourth that is 0, then as double size, m, p, radius,
 * and count times dim coordinates. */
#ifndef PAIR_FILE_H
#define PAIR_FILE_H

#include <stdint.h>
#include "fed.h"

typedef struct pair_block {
    char name[48];        /* of the class */
    char state[16];       /* separated, near 1e-3, ... */
    char growth[16];      /* vertices, pairs or accuracy: this block tells how cost grows by it; else empty */
    int32_t dim, single;  /* single: the numbers are floats */
    int32_t questions;    /* to be asked, a bit each */
    int32_t pairs, track; /* so many pairs one after another lie along one path; 0: each stands for itself */
    int32_t at;           /* the number that grows */
    int32_t seed;         /* they were drawn from; 0: not drawn */
} pair_block;

/* All end the process where the file cannot be written or read. */
void write_block(FILE *file, const pair_block *block);
void write_pair(FILE *file, int dim, const peer_set *a, const peer_set *b);
/* 0: there are no more. */
int read_block(FILE *file, pair_block *block);
void read_pair(FILE *file, int dim, fed *f);

#endif
