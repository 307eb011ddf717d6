/* SPDX-License-Identifier: MIT */
/* What a test that goes on after a fault has found: each kind, how often, and the worst. */
#ifndef FAULTS_H
#define FAULTS_H

#include "variant.h"

typedef struct fault {
    const char *what; /* a string literal: kinds are told apart by its address */
    long count;
    double worst;
} fault;

typedef struct faults {
    fault kind[32];
    long count;
} faults;

/* Whether it is the first of its kind, of which one example is worth printing. */
static inline int note_fault(faults *all, const char *what, double by)
{
    fault *f = all->kind;
    while (f->what && f->what != what) {
        f++;
    }
    f->what = what;
    f->worst = fmax(f->worst, by);
    all->count++;
    return f->count++ == 0;
}

static inline void print_faults(const faults *all, const char *name)
{
    for (const fault *f = all->kind; f->what; f++) {
        print_error("%s %s: %ld times %s, at worst %.3g\n", VARIANT, name, f->count, f->what, f->worst);
    }
}

#endif
