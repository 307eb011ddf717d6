/* SPDX-License-Identifier: MIT */
#include "judge.h"

#include <float.h>
#include <string.h>

#define ROUNDING 4.0 /* in u * scale */

static const char *const failure_name[DEPTH_FAILURES] = {"sound", "gave_up", "crashed", "hung", "missed", "no_normal"};

/* What rounding one coordinate can do. */
static quad rounding_of(const fed *f, int single)
{
    return single ? f->scale * (quad)(FLT_EPSILON / 2) + (quad)FLT_MIN
                  : f->scale * (quad)(DBL_EPSILON / 2) + (quad)DBL_MIN;
}

int is_deep(const fed *f, int single) { return -f->upper > (quad)ROUNDING * rounding_of(f, single); }

void start_depth_tally(depth_tally *s)
{
    memset(s, 0, sizeof *s);
    s->example = -1;
}

static enum failure failure_of(const peer *p, const fed *f, const reply *r)
{
    switch (r->outcome) {
    case GAVE_UP:
        return SAYS_NOTHING;
    case CRASHED:
        return DIES;
    case HUNG:
        return HANGS;
    default:
        return is_deep(f, p->single) && !(r->answer.meet && r->answer.depth > 0) ? MISSES : SOUND;
    }
}

static judgement judged(const peer *p, const fed *f, const reply *r)
{
    judgement j = {SOUND, 0, 0, 0, 0};
    quad error, along;
    int deep = is_deep(f, p->single);
    j.failure = failure_of(p, f, r);
    if (j.failure != SOUND || !(f->scale > 0)) {
        return j;
    }
    error = off(r->answer.meet ? (quad)r->answer.depth : 0, -f->upper, -f->lower);
    j.error = (double)(error / f->scale);
    j.relative = deep ? (double)(error / -f->upper) : 0;
    j.wrong = j.relative > WRONG && error > (quad)ROUNDING * rounding_of(f, p->single);
    if (deep && !find_fed_separation(f, r->answer.normal, &along)) {
        j.failure = NO_NORMAL;
    } else if (deep && along < f->lower) {
        j.excess = (double)((f->lower - along) / f->scale);
    }
    return j;
}

static int is_worse(const judgement *x, const judgement *y)
{
    return x->failure != SOUND || y->failure != SOUND ? y->failure == SOUND : x->error > y->error;
}

judgement judge_depth(depth_tally *s, const peer *p, const fed *f, const reply *r, long index)
{
    judgement j = judged(p, f, r);
    s->asked++;
    s->failed[j.failure]++;
    if (j.failure == SOUND) {
        s->wrong += j.wrong;
        s->error = fmax(s->error, j.error);
        s->relative = fmax(s->relative, j.relative);
        s->excess = fmax(s->excess, j.excess);
    }
    if (s->example < 0 || is_worse(&j, &s->worst)) {
        s->example = index;
        s->worst = j;
    }
    return j;
}

void print_number(const char *key, double x)
{
    if (isfinite(x)) {
        printf(", \"%s\": %.9g", key, x);
    } else {
        printf(", \"%s\": null", key);
    }
}

static void print_example(const depth_tally *s, const fed *f, const reply *r)
{
    printf(", \"example\": {\"index\": %ld, \"failure\": \"%s\", \"meet\": %d", s->example,
           failure_name[s->worst.failure], r->answer.meet);
    print_number("depth", r->answer.depth);
    print_number("lower", (double)f->lower);
    print_number("upper", (double)f->upper);
    print_number("error", s->worst.error);
    printf(", \"case\": ");
    print_fed_case(stdout, f, "penetration");
    printf("}");
}

void print_depth_tally(const depth_tally *s, const fed *pairs, const reply *replies)
{
    printf(", \"asked\": %ld, \"wrong\": %ld", s->asked, s->wrong);
    for (int k = SAYS_NOTHING; k < DEPTH_FAILURES; k++) {
        printf(", \"%s\": %ld", failure_name[k], s->failed[k]);
    }
    print_number("error", s->error);
    print_number("relative", s->relative);
    print_number("excess", s->excess);
    if (s->example >= 0) {
        print_example(s, &pairs[s->example], &replies[s->example]);
    }
}
