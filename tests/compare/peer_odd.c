/* SPDX-License-Identifier: MIT */
/* Peers that answer as none should, by which the tests see what is made of that: one never answers, one says lengths
 * that are none, one dies. */
#include "peer.h"

#include <stdlib.h>

static int body;

static void *make(const peer_set *set)
{
    (void)set;
    return &body;
}

static void discard(void *made) { (void)made; }

static int say_nothing(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    (void)p;
    (void)memory;
    out->meet = a != b;
    return 1;
}

static int say_far(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    say_nothing(p, a, b, memory, out);
    out->meet = 0;
    out->distance = 1e300;
    return 0;
}

static int say_deep(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    say_nothing(p, a, b, memory, out);
    out->meet = 1;
    out->depth = 1e300;
    return 0;
}

static int die(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    say_nothing(p, a, b, memory, out);
    abort();
}

static peer odd(const char *library, peer_query *distance, peer_query *penetration)
{
    peer p = {.library = library,
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
              .query = {distance, distance, penetration}};
    return p;
}

const peer *gjk_peers(int *count)
{
    static peer all[3];
    *count = 0;
    all[(*count)++] = odd("silent", say_nothing, say_nothing);
    all[(*count)++] = odd("absurd", say_far, say_deep);
    all[(*count)++] = odd("dying", die, die);
    return all;
}
