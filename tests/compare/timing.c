/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200112L /* clock_gettime */
#include "timing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#if GJK_TEST_KNOWS_CALLGRIND
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_DUMP_STATS_AT(name) (void)(name)
#endif

#define LEAST_ROUND 50e-6 /* seconds */
#define SHORTEST 1e-6     /* a pass is not taken for shorter */

int ask_nothing(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    (void)p;
    (void)memory;
    out->meet = a != b;
    return 0;
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static void forget(const run *r)
{
    if (r->memory) {
        memset(r->memory, 0, (size_t)r->tracks * r->p->memory);
    }
}

static void answer_all(const run *r, long pairs)
{
    static volatile int sink;
    for (long i = 0; i < pairs; i++) {
        peer_answer answer;
        void *memory = r->memory ? r->memory + (size_t)r->track[i] * r->p->memory : NULL;
        r->query(r->p, r->bodies[2 * i], r->bodies[2 * i + 1], memory, &answer);
        sink = answer.meet;
    }
    (void)sink;
}

static void support_all(const run *r, long pairs)
{
    for (long i = 0; i < pairs; i++) {
        r->p->supports(r->bodies[2 * i], r->bodies[2 * i + 1], r->calls[i]);
    }
}

static void pass(const run *r, long pairs)
{
    if (r->query) {
        answer_all(r, pairs);
    } else {
        support_all(r, pairs);
    }
}

static int by_size(const void *x, const void *y)
{
    double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}

double median(double *x, long count)
{
    qsort(x, (size_t)count, sizeof *x, by_size);
    return count ? (x[(count - 1) / 2] + x[count / 2]) / 2 : 0;
}

/* What two looks at the clock see between them when nothing is done. */
static double find_look(void)
{
    double least = HUGE_VAL;
    for (int k = 0; k < 1000; k++) {
        double start = seconds();
        least = fmin(least, seconds() - start);
    }
    return least;
}

/* Of so many passes, the seconds each, after one off the clock: it does what is done once, and has the caches hold what
 * the next settings of the same library would find there anyway. What is kept in mind is forgotten before each, off the
 * clock, too. */
static double time_passes(const run *r, long pairs, long passes, double look)
{
    double sum = 0;
    long at_once = r->memory ? 1 : passes;
    pass(r, pairs);
    for (long k = 0; k < passes; k += at_once) {
        double start;
        forget(r);
        start = seconds();
        for (long i = 0; i < at_once; i++) {
            pass(r, pairs);
        }
        sum += seconds() - start - look;
    }
    return sum / (double)passes;
}

/* A round of short passes has more of them, so that it is long beside a look at the clock. */
void time_runs(run *runs, int count, long pairs, long rounds)
{
    double *ns = calloc((size_t)(count * rounds), sizeof *ns);
    long *passes = calloc((size_t)count, sizeof *passes);
    double look = find_look();
    for (int k = 0; k < count && ns && passes; k++) {
        passes[k] = 1 + (long)(LEAST_ROUND / fmax(time_passes(&runs[k], pairs, 1, look), SHORTEST));
    }
    for (long round = 0; round < rounds && ns && passes; round++) {
        for (int k = 0; k < count; k++) {
            ns[k * rounds + round] = time_passes(&runs[k], pairs, passes[k], look) * 1e9 / (double)pairs;
        }
    }
    for (int k = 0; k < count && ns; k++) {
        runs[k].median = median(ns + k * rounds, rounds);
        runs[k].least = ns[k * rounds];
    }
    free(ns);
    free(passes);
}

void run_once(const run *r, long pairs) { pass(r, pairs); }

void count_run(const run *r, long pairs, const char *label)
{
    forget(r);
    CALLGRIND_ZERO_STATS;
    pass(r, pairs);
    CALLGRIND_DUMP_STATS_AT(label);
}
