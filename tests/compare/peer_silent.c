/* SPDX-License-Identifier: MIT */
/* A peer that never answers, by which the tests see what is made of that. */
#include "peer.h"

static int body;

static void *make(const peer_set *set)
{
    (void)set;
    return &body;
}

static void discard(void *made) { (void)made; }

static int answer(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    (void)p;
    (void)memory;
    out->meet = a != b;
    return 1;
}

const peer *gjk_peers(int *count)
{
    static const peer silent = {.library = "silent",
                                .knob = "none",
                                .usual = 1,
                                .version = "none",
                                .how = {"nothing", "nothing", "nothing"},
                                .dim = 3,
                                .cores = ALL_CORES,
                                .poses = 1,
                                .radii = 1,
                                .make = make,
                                .discard = discard,
                                .query = {answer, answer, answer}};
    *count = 1;
    return &silent;
}
