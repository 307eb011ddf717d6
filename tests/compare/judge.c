/* SPDX-License-Identifier: MIT */
#include "judge.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define ROUNDING 4.0 /* in u * scale: what it may do to an answer */
#define TELLS 300.0  /* likewise: so far from contact, whether they meet is to be told */
#define SENSE 1e6    /* in scales of the pair: no length of it comes near */

static const char *const failure_names[FAILURES] = {"sound",  "gave_up",   "crashed",   "hung",
                                                    "missed", "no_normal", "undecided", "absurd"};
static const char *const question_name[QUESTIONS] = {"distance", "intersect", "penetration"};

/* What rounding can do. */
static quad rounding_of(const fed *f, int single)
{
    return (quad)ROUNDING * (single ? f->scale * (quad)(FLT_EPSILON / 2) + (quad)FLT_MIN
                                    : f->scale * (quad)(DBL_EPSILON / 2) + (quad)DBL_MIN);
}

static quad positive(quad x) { return x > 0 ? x : 0; }
static quad larger(quad x, quad y) { return x > y ? x : y; }

const char *failure_name(enum failure failure) { return failure_names[failure]; }

void start_score(score *s, enum question question)
{
    memset(s, 0, sizeof *s);
    s->question = question;
    s->example = -1;
}

/* Where the truth lies of what brackets hold: the distance, else the signed separation. */
static void truth_of(enum question question, const fed *f, quad *low, quad *high)
{
    *low = question == DISTANCE ? positive(f->lower) : f->lower;
    *high = question == DISTANCE ? positive(f->upper) : f->upper;
}

/* What the answer itself leaves open: the width of its bracket, or what its setting lets it be off by. */
static quad allowed(enum question question, const peer *p, const reply *r)
{
    return p->proves ? (quad)r->answer.upper - (quad)r->answer.lower : (quad)p->tolerance[question];
}

static int misses(const peer *p, const fed *f, const reply *r)
{
    quad open = p->proves ? allowed(PENETRATION, p, r) : 0;
    return -f->upper > larger(rounding_of(f, p->single), open) && !(r->answer.meet == 1 && r->answer.depth > 0);
}

static int is_undecided(const peer *p, const fed *f, const reply *r)
{
    quad far = (quad)(TELLS / ROUNDING) * rounding_of(f, p->single);
    return r->answer.meet < 0 && (f->lower > far || -f->upper > far);
}

static quad said(enum question question, const reply *r)
{
    const peer_answer *x = &r->answer;
    return question == DISTANCE ? (x->meet ? 0 : (quad)x->distance) : (x->meet ? -(quad)x->depth : 0);
}

static int is_absurd(enum question question, const fed *f, const reply *r)
{
    quad x = said(question, r), most = (quad)SENSE * f->scale;
    return question != INTERSECT && f->scale > 0 && !(-most <= x && x <= most);
}

static enum failure failure_of(enum question question, const peer *p, const fed *f, const reply *r)
{
    switch (r->outcome) {
    case GAVE_UP:
        return SAYS_NOTHING;
    case CRASHED:
        return DIES;
    case HUNG:
        return HANGS;
    default:
        return is_absurd(question, f, r)                        ? ABSURD
               : question == PENETRATION && misses(p, f, r)     ? MISSES
               : question == INTERSECT && is_undecided(p, f, r) ? UNDECIDED
                                                                : SOUND;
    }
}

static int is_wrong_verdict(const peer *p, const fed *f, const reply *r)
{
    quad near = larger(rounding_of(f, p->single), (quad)p->tolerance[INTERSECT]);
    return r->answer.meet == 1 ? f->lower > near : r->answer.meet == 0 && -f->upper > near;
}

/* Of bodies that are apart the depth is 0. */
static void judge_length(judgement *j, enum question question, const peer *p, const fed *f, const reply *r)
{
    quad low, high, error, size, rounding = rounding_of(f, p->single);
    truth_of(question, f, &low, &high);
    if (question == PENETRATION) {
        low = -positive(-low);
        high = -positive(-high);
    }
    error = off(said(question, r), low, high);
    size = larger(low, -high);
    j->error = (double)(error / f->scale);
    j->relative = (double)(error / (size > rounding ? size : f->scale));
    j->wrong |= j->relative > WRONG && error > rounding && error > allowed(question, p, r);
}

static void judge_normal(judgement *j, const fed *f, const reply *r)
{
    quad along;
    if (!find_fed_separation(f, r->answer.normal, &along)) {
        j->failure = NO_NORMAL;
    } else if (along < f->lower) {
        j->excess = (double)((f->lower - along) / f->scale);
    }
}

/* Whether the truth lies outside the bracket. */
static int is_false(enum question question, const fed *f, const reply *r)
{
    quad low, high;
    truth_of(question, f, &low, &high);
    return (quad)r->answer.lower > high || (quad)r->answer.upper < low;
}

static judgement judged(enum question question, const peer *p, const fed *f, const reply *r)
{
    judgement j;
    memset(&j, 0, sizeof j);
    j.failure = failure_of(question, p, f, r);
    if (p->proves && r->outcome == ANSWERED && is_false(question, f, r)) {
        j.failure = SOUND;
        j.wrong = 1;
    }
    if (j.failure != SOUND || !(f->scale > 0)) {
        return j;
    }
    if (question == INTERSECT) {
        j.wrong |= is_wrong_verdict(p, f, r);
    } else {
        judge_length(&j, question, p, f, r);
    }
    if (p->proves) {
        j.promised = (double)(allowed(question, p, r) / f->scale);
    }
    if (question == PENETRATION && -f->upper > rounding_of(f, p->single)) {
        judge_normal(&j, f, r);
    }
    return j;
}

static int is_worse(const judgement *x, const judgement *y)
{
    if (x->failure != SOUND || y->failure != SOUND) {
        return y->failure == SOUND;
    }
    return x->wrong != y->wrong ? x->wrong : x->error > y->error;
}

judgement judge_answer(score *s, const peer *p, const fed *f, const reply *r, long index)
{
    judgement j = judged(s->question, p, f, r);
    s->asked++;
    s->failed[j.failure]++;
    if (j.failure == SOUND) {
        s->wrong += j.wrong;
        s->error = fmax(s->error, j.error);
        s->relative = fmax(s->relative, j.relative);
        s->excess = fmax(s->excess, j.excess);
        s->promised = fmax(s->promised, j.promised);
    }
    if (s->example < 0 || is_worse(&j, &s->worst)) {
        s->example = index;
        s->worst = j;
    }
    return j;
}

long failures_of(const score *s)
{
    long sum = 0;
    for (int k = SAYS_NOTHING; k < FAILURES; k++) {
        sum += s->failed[k];
    }
    return sum;
}

void print_number(const char *key, double x)
{
    if (isfinite(x)) {
        printf(", \"%s\": %.9g", key, x);
    } else {
        printf(", \"%s\": null", key);
    }
}

static void print_example(const score *s, const fed *f, const reply *r)
{
    printf(", \"example\": {\"index\": %ld, \"failure\": \"%s\", \"meet\": %d", s->example,
           failure_names[s->worst.failure], r->answer.meet);
    print_number(s->question == DISTANCE ? "distance" : "depth",
                 s->question == DISTANCE ? r->answer.distance : r->answer.depth);
    print_number("lower", (double)f->lower);
    print_number("upper", (double)f->upper);
    print_number("error", s->worst.error);
    printf(", \"case\": ");
    print_fed_case(stdout, f, question_name[s->question]);
    printf("}");
}

void print_score(const score *s, const fed *pairs, const reply *replies)
{
    printf(", \"asked\": %ld, \"wrong\": %ld", s->asked, s->wrong);
    for (int k = SAYS_NOTHING; k < FAILURES; k++) {
        printf(", \"%s\": %ld", failure_names[k], s->failed[k]);
    }
    print_number("error", s->error);
    print_number("relative", s->relative);
    print_number("excess", s->excess);
    if (s->example >= 0) {
        print_example(s, &pairs[s->example], &replies[s->example]);
    }
}
