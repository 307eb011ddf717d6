/* SPDX-License-Identifier: MIT */
/* The library beside its peers on everyday pairs: each answer held against exact truth, and what it cost.
 *
 *   bench PAIRS ROUNDS OUTPUT [NAME=MODULE...]     writes JSON, one object a line, for comparison.py
 *
 * PAIRS is the binary file that draw_pairs and robot_pairs.py write. The library is a peer as any. In each round
 * everyone, in every setting, answers in turn all pairs of a class. ROUNDS 0: nothing is judged; run by callgrind, it
 * dumps the instructions of one pass each, under the label that the answers have. Ends with 1 where the library failed,
 * and where a peer is missing that the environment variable GJK_COMPARE_NEEDS names. Where GJK_COMPARE_CLASSES is set,
 * only those classes are asked about, and no growth, whose line "QUESTION DIM PRECISION CLASS STATE" has a match of it,
 * an extended regular expression. */
#define _DEFAULT_SOURCE /* fork, setitimer */
#include "judge.h"
#include "pair_file.h"
#include "timing.h"

#include <float.h>
#include <math.h>
#include <regex.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define NOT_THERE HUGE_VAL /* printed as null */
#define VALUE_ERROR 4.0    /* of ours, of bodies with corners, in u * scale */
#define NORMAL_EXCESS 16.0
#define MOST_DEADLY 20      /* one pair in so many: who crashes or hangs on more is not timed */
#define LONGEST_SHOWN 64    /* points of an example */
#define LONGEST_COUNTED 300 /* seconds on the processor, under callgrind, of all pairs of a class */

static const char *const question_name[QUESTIONS] = {"distance", "intersect", "penetration"};

static long rounds;
static const regex_t *chosen; /* NULL: all classes */
static peer_list peers;
static pair_block block;
static fed *pairs;

/* ---- whom to ask ---- */

typedef struct entry {
    const peer *p;
    reply *replies;
    int timed;
    run run;
} entry;

static entry asked[MOST_PEERS];
static int count_asked;

static const char *precision_name(void) { return block.single ? "float" : "double"; }

static int is_chosen(enum question question)
{
    char line[128];
    snprintf(line, sizeof line, "%s %d %s %s %s", question_name[question], block.dim, precision_name(), block.name,
             block.state);
    return (block.questions >> question & 1) && (!chosen || regexec(chosen, line, 0, NULL, 0) == 0);
}

static int takes_all(const peer *p)
{
    for (int i = 0; i < block.pairs; i++) {
        if (!takes_pair(p, &pairs[i])) {
            return 0;
        }
    }
    return 1;
}

/* Of pairs in float those in double are asked, too, as they come, where they can be told them; never the other way
 * round. What is kept in mind helps along a path only. */
static int is_asked(const peer *p, enum question question)
{
    int above = p->usual && p->single < block.single && p->poses != ROTATIONS;
    return (p->single == block.single || above) && p->query[question] && (p->memory == 0 || block.track > 0) &&
           takes_all(p);
}

/* Growth is told of those that are set as usual; with the accuracy, of those whose tolerance is set. Instructions are
 * counted of those that are set as usual, and of ours at every setting. */
static int is_wanted(const peer *p)
{
    if (strcmp(block.growth, "accuracy") == 0) {
        return strcmp(p->knob, "tolerance") == 0;
    }
    return p->usual || (!*block.growth && (rounds > 0 || p->proves));
}

static void choose(enum question question)
{
    count_asked = 0;
    for (int k = 0; k < peers.count; k++) {
        const peer *p = peers.all[k];
        if (is_asked(p, question) && is_wanted(p)) {
            memset(&asked[count_asked], 0, sizeof asked[0]);
            asked[count_asked++].p = p;
        }
    }
}

static size_t reply_bytes(void) { return (size_t)block.pairs * sizeof(reply); }

/* Each library, in all its settings, in a process of its own. */
static void ask_all(enum question question)
{
    const peer *alike[MOST_PEERS];
    reply *replies[MOST_PEERS];
    for (int k = 0, count; k < count_asked; k += count) {
        for (count = 0; k + count < count_asked && asked[k + count].p->make == asked[k].p->make; count++) {
            alike[count] = asked[k + count].p;
            replies[count] = asked[k + count].replies = shared_space(reply_bytes());
        }
        ask_peers(alike, count, question, pairs, block.pairs, block.track, replies);
    }
}

static void forget_replies(void)
{
    for (int k = 0; k < count_asked; k++) {
        give_back(asked[k].replies, reply_bytes());
    }
}

/* ---- what is timed ---- */

static long *track_of; /* of each pair that is timed */
static int *safe;      /* those pairs */
static long count_safe;

static int is_deadly(const entry *e, int i) { return e->replies[i].outcome > GAVE_UP; }

/* The pairs on which no one dies who is timed. */
static void find_safe(void)
{
    for (int k = 0; k < count_asked; k++) {
        long deaths = 0;
        for (int i = 0; i < block.pairs; i++) {
            deaths += is_deadly(&asked[k], i);
        }
        asked[k].timed = deaths * MOST_DEADLY <= block.pairs;
    }
    count_safe = 0;
    for (int i = 0; i < block.pairs; i++) {
        int fine = 1;
        for (int k = 0; k < count_asked; k++) {
            fine &= !asked[k].timed || !is_deadly(&asked[k], i);
        }
        if (fine) {
            safe[count_safe] = i;
            track_of[count_safe++] = block.track ? i / block.track : 0;
        }
    }
}

static void all_are_safe(void)
{
    for (count_safe = 0; count_safe < block.pairs; count_safe++) {
        safe[count_safe] = (int)count_safe;
        track_of[count_safe] = block.track ? count_safe / block.track : 0;
    }
    for (int k = 0; k < count_asked; k++) {
        asked[k].timed = 1;
    }
}

/* The bodies of the safe pairs, for all who make them alike. */
typedef struct shelf {
    const peer *p;
    void **bodies;
} shelf;

static shelf shelves[MOST_PEERS];
static int count_shelves;

static void **make_bodies(const peer *p)
{
    void **made = calloc(2 * (size_t)count_safe + 1, sizeof *made);
    for (long i = 0; i < count_safe && made; i++) {
        long first = i;
        while (block.track && first > 0 && track_of[first - 1] == track_of[i]) {
            first--;
        }
        made[2 * i] = make_body(p, &pairs[safe[i]].a, first < i ? made[2 * first] : NULL);
        made[2 * i + 1] = make_body(p, &pairs[safe[i]].b, first < i ? made[2 * first + 1] : NULL);
    }
    return made;
}

static void *const *bodies_of(const peer *p)
{
    int k = 0;
    while (k < count_shelves && shelves[k].p->make != p->make) {
        k++;
    }
    if (k == count_shelves) {
        shelves[k].p = p;
        shelves[k].bodies = make_bodies(p);
        count_shelves++;
    }
    return shelves[k].bodies;
}

static void discard_bodies(void)
{
    for (int k = 0; k < count_shelves; k++) {
        for (long i = 2 * count_safe - 1; i >= 0 && shelves[k].bodies; i--) {
            shelves[k].p->discard(shelves[k].bodies[i]);
        }
        free(shelves[k].bodies);
    }
    count_shelves = 0;
}

/* Who is not timed needs no bodies; by the first it is told what asking costs. */
static void start_runs(enum question question)
{
    for (int k = 0; k < count_asked; k++) {
        run *r = &asked[k].run;
        const peer *p = r->p = asked[k].p;
        if (k > 0 && !asked[k].timed) {
            continue;
        }
        r->query = p->query[question];
        r->bodies = bodies_of(p);
        r->track = track_of;
        r->tracks = block.track ? (block.pairs - 1) / block.track + 1 : 1;
        r->memory = p->memory ? calloc((size_t)r->tracks, p->memory) : NULL;
    }
}

static void end_runs(void)
{
    for (int k = 0; k < count_asked; k++) {
        free(asked[k].run.memory);
    }
}

/* ---- what is printed ---- */

static void print_asked(enum question question)
{
    printf("\"question\": \"%s\", \"dim\": %d, \"precision\": \"%s\", \"class\": \"%s\", \"state\": \"%s\"",
           question_name[question], block.dim, precision_name(), block.name, block.state);
}

/* Tolerances as powers of ten. */
static void spell_setting(char *text, size_t size, const peer *p)
{
    if (strcmp(p->knob, "tolerance") == 0) {
        snprintf(text, size, "1e%.0f", log10(p->setting));
    } else if (strcmp(p->knob, "steps") == 0) {
        snprintf(text, size, "%.0f", p->setting);
    } else {
        snprintf(text, size, "%s", "");
    }
}

static void spell_label(char *text, size_t size, enum question question, const peer *p)
{
    char setting[32];
    spell_setting(setting, sizeof setting, p);
    snprintf(text, size, "%s/%d/%s/%s/%s/%s/%s/%s/%s", question_name[question], block.dim, precision_name(), block.name,
             block.state, p->library, p->knob, setting, p->memory ? "warm" : "cold");
}

static const char *truth_value(int x) { return x ? "true" : "false"; }

/* Ours is the variant of the pairs' own precision. */
static void print_library(const peer *p)
{
    char setting[32];
    spell_setting(setting, sizeof setting, p);
    printf(", \"library\": \"%s\", \"knob\": \"%s\", \"setting\": \"%s\", \"default\": %s, \"warm\": %s, "
           "\"ours\": %s",
           p->library, p->knob, setting, truth_value(p->usual), truth_value(p->memory != 0),
           truth_value(p->proves && p->single == block.single));
}

static void print_class(enum question question, const run *empty, const run *alone)
{
    double width = 0, least = HUGE_VAL, most = -HUGE_VAL;
    for (int i = 0; i < block.pairs; i++) {
        const fed *f = &pairs[i];
        width = fmax(width, (double)((f->upper - f->lower) / f->scale));
        least = fmin(least, (double)(f->lower / f->scale));
        most = fmax(most, (double)(f->upper / f->scale));
    }
    printf("{\"row\": \"class\", ");
    print_asked(question);
    printf(", \"pairs\": %d, \"timed\": %ld", block.pairs, count_safe);
    print_number("truth_width", width);
    print_number("least", least);
    print_number("most", most);
    print_number("empty_least", empty->least);
    print_number("empty_median", empty->median);
    print_number("supports_median", alone->median - empty->median);
    printf("}\n");
}

static double mean_supports(const entry *e)
{
    double sum = 0;
    long count = 0;
    for (int i = 0; i < block.pairs && e->p->proves; i++) {
        if (e->replies[i].outcome == ANSWERED) {
            sum += e->replies[i].answer.supports;
            count++;
        }
    }
    return count ? sum / (double)count : NOT_THERE;
}

static double said(enum question question, const peer_answer *x)
{
    return question == INTERSECT ? x->meet : question == DISTANCE ? (x->meet ? 0 : x->distance) : -x->depth;
}

static void print_example(const score *s, const entry *e)
{
    const fed *f = &pairs[s->example < 0 ? 0 : s->example];
    int bad = s->example >= 0 && (s->worst.failure != SOUND || s->worst.wrong);
    if (!bad || f->a.count + f->b.count > LONGEST_SHOWN) {
        printf(", \"example\": null, \"truth\": null, \"said\": null");
        return;
    }
    printf(", \"example\": ");
    print_fed_case(stdout, f, question_name[s->question]);
    print_number("truth", (double)((f->lower + f->upper) / 2));
    print_number("said", said(s->question, &e->replies[s->example].answer));
    printf(", \"failure\": \"%s\"", failure_name(s->worst.failure));
}

/* ---- judgement ---- */

static int is_sharp(const peer_set *s)
{
    return s->radius == 0 &&
           (s->core == PEER_POINTS || s->core == PEER_BOX || s->core == PEER_SEGMENT || s->core == PEER_ORIGIN);
}

/* Whether ours is not as good as it says: in any setting no bracket without the truth in it, and without options the
 * error of bodies with corners is one of rounding. */
static int fails(const peer *p, const fed *f, const judgement *j)
{
    double u = (p->single ? (double)FLT_EPSILON : DBL_EPSILON) / 2;
    int sharp = is_sharp(&f->a) && is_sharp(&f->b);
    return p->proves && (j->wrong || (p->usual && j->failure != SOUND) ||
                         (p->usual && sharp && !(j->error <= VALUE_ERROR * u && j->excess <= NORMAL_EXCESS * u)));
}

/* Without an answer that has a number there is no error. Returns how often ours failed. */
static long print_answers(enum question question, const entry *e, const run *empty)
{
    char label[200];
    score s;
    int measured;
    long bad = 0, sound = 0;
    double *error = calloc((size_t)block.pairs, sizeof *error);
    start_score(&s, question);
    for (int i = 0; i < block.pairs && error; i++) {
        judgement j = judge_answer(&s, e->p, &pairs[i], &e->replies[i], i);
        if (j.failure == SOUND) {
            error[sound++] = j.error;
        }
        bad += fails(e->p, &pairs[i], &j);
    }
    measured = question != INTERSECT && sound > 0;
    spell_label(label, sizeof label, question, e->p);
    printf("{\"row\": \"answers\", ");
    print_asked(question);
    print_library(e->p);
    print_number("least", e->run.least - empty->least);
    print_number("median", e->run.median - empty->median);
    print_number("supports", mean_supports(e));
    print_number("promised", e->p->proves && sound > 0 ? s.promised : NOT_THERE);
    print_number("max_error", measured ? s.error : NOT_THERE);
    print_number("median_error", measured ? median(error, sound) : NOT_THERE);
    print_number("excess", measured && question == PENETRATION ? s.excess : NOT_THERE);
    printf(", \"asked\": %ld, \"wrong\": %ld, \"failed\": %ld", s.asked, s.wrong, failures_of(&s));
    print_example(&s, e);
    printf(", \"instructions\": null, \"label\": \"%s\"}\n", label);
    free(error);
    return bad;
}

/* The truth of every second pair is found by a child. */
static void find_truths(void)
{
    pid_t child;
    int status = 0;
    fflush(NULL);
    child = fork();
    for (int i = child == 0; i < block.pairs; i += child < 0 ? 1 : 2) {
        find_fed_truth(&pairs[i]);
    }
    if (child == 0) {
        _exit(0);
    }
    if (child > 0 && (waitpid(child, &status, 0) < 0 || status != 0)) {
        fprintf(stderr, "the truth was not found\n");
        exit(2);
    }
}

/* ---- one block ---- */

/* Asks each body for one corner by the functions of ours, and nothing else. */
static run one_corner_each(const int calls[])
{
    run alone = {.median = NOT_THERE};
    for (int k = 0; k < count_asked; k++) {
        const peer *p = asked[k].p;
        if (p->supports && p->single == block.single && asked[k].timed && !alone.p) {
            alone = asked[k].run;
            alone.query = NULL;
            alone.memory = NULL;
            alone.calls = calls;
        }
    }
    return alone;
}

/* The last of the runs but one asks nothing, the last for no more than corners. */
static void time_all(run *empty, run *alone)
{
    static run runs[MOST_PEERS + 2];
    int *calls = calloc((size_t)block.pairs, sizeof *calls);
    int count = 0;
    for (int k = 0; k < count_asked; k++) {
        if (asked[k].timed) {
            runs[count++] = asked[k].run;
        }
    }
    runs[count] = asked[0].run;
    runs[count].query = ask_nothing;
    for (int i = 0; i < block.pairs && calls; i++) {
        calls[i] = 2;
    }
    runs[count + 1] = one_corner_each(calls);
    time_runs(runs, count + (calls && runs[count + 1].p ? 2 : 1), count_safe, rounds);
    *empty = runs[count];
    *alone = runs[count + 1];
    free(calls);
    for (int k = count_asked - 1; k >= 0; k--) {
        if (asked[k].timed) {
            asked[k].run = runs[--count];
        } else {
            asked[k].run.least = asked[k].run.median = NOT_THERE;
        }
    }
}

/* Returns how often ours failed. */
static long compare(enum question question)
{
    run empty, alone;
    long bad = 0;
    choose(question);
    ask_all(question);
    find_safe();
    start_runs(question);
    time_all(&empty, &alone);
    print_class(question, &empty, &alone);
    for (int k = 0; k < count_asked; k++) {
        bad += print_answers(question, &asked[k], &empty);
    }
    end_runs();
    discard_bodies();
    forget_replies();
    return bad;
}

/* Whether all is well with the truth of it is not asked here: of the largest it is not known. */
static void grow(enum question question)
{
    static run floors[MOST_PEERS];
    run empty, alone;
    int *calls = calloc((size_t)block.pairs, sizeof *calls);
    choose(question);
    ask_all(question);
    find_safe();
    start_runs(question);
    time_all(&empty, &alone);
    for (int k = 0; k < count_asked && calls; k++) {
        const entry *e = &asked[k];
        char at[32];
        run floor = e->run;
        floor.median = NOT_THERE;
        if (e->p->supports && e->timed) {
            for (long i = 0; i < count_safe; i++) {
                calls[i] = (int)e->replies[safe[i]].answer.supports;
            }
            floor.query = NULL;
            floor.calls = calls;
            floors[0] = floor;
            time_runs(floors, 1, count_safe, rounds);
            floor = floors[0];
        }
        spell_setting(at, sizeof at, e->p);
        if (strcmp(block.growth, "accuracy") != 0) {
            snprintf(at, sizeof at, "%d", block.at);
        }
        printf("{\"row\": \"growth\", \"by\": \"%s\", \"at\": %s, ", block.growth, at);
        print_asked(question);
        print_library(e->p);
        print_number("median", e->run.median - empty.median);
        print_number("least", e->run.least - empty.least);
        print_number("supports", mean_supports(e));
        print_number("floor", floor.median);
        printf("}\n");
    }
    end_runs();
    discard_bodies();
    forget_replies();
    free(calls);
}

static void read_pairs(FILE *file)
{
    size_t count = (size_t)block.pairs;
    pairs = shared_space(count * sizeof *pairs);
    track_of = calloc(count, sizeof *track_of);
    safe = calloc(count, sizeof *safe);
    for (int i = 0; i < block.pairs; i++) {
        read_pair(file, block.dim, &pairs[i]);
    }
}

static void free_pairs(void)
{
    for (int i = 0; i < block.pairs; i++) {
        free(pairs[i].numbers[0]);
        free(pairs[i].numbers[1]);
    }
    give_back(pairs, (size_t)block.pairs * sizeof *pairs);
    free(track_of);
    free(safe);
}

static int is_any_chosen(void)
{
    int any = 0;
    for (int question = 0; question < QUESTIONS; question++) {
        any |= is_chosen((enum question)question);
    }
    return any;
}

/* Returns how often ours failed. */
static long measure_block(void)
{
    long bad = 0;
    if (!*block.growth) {
        find_truths();
    }
    for (int question = 0; question < QUESTIONS; question++) {
        if (!is_chosen((enum question)question)) {
            continue;
        }
        if (*block.growth) {
            grow((enum question)question);
        } else {
            bad += compare((enum question)question);
        }
    }
    return bad;
}

/* ---- instructions ---- */

/* Of all passes those before this one have been counted, or died: a child counts, and where it dies, the next child
 * goes on behind the pass that it died of. */
static volatile long *begun;
static long passes;

static int begins(void)
{
    struct itimerval limit = {{0, 0}, {LONGEST_COUNTED, 0}};
    if (passes++ < *begun) {
        return 0;
    }
    *begun = passes;
    setitimer(ITIMER_VIRTUAL, &limit, NULL);
    return 1;
}

/* Twice, for what is done once is not counted. */
static void count_one(const run *r, const char *label)
{
    run_once(r, count_safe);
    count_run(r, count_safe, label);
    printf("{\"row\": \"counted\", \"label\": \"%s\", \"answers\": %ld", label, count_safe);
}

/* What asking costs by itself is counted once. */
static void count_nothing(void)
{
    if (passes == 0 && begins()) {
        run nothing = asked[0].run;
        nothing.query = ask_nothing;
        count_one(&nothing, "nothing");
        printf("}\n");
        fflush(stdout);
    }
}

static void count_question(enum question question)
{
    choose(question);
    all_are_safe();
    start_runs(question);
    count_nothing();
    for (int k = 0; k < count_asked; k++) {
        if (begins()) {
            char label[200];
            spell_label(label, sizeof label, question, asked[k].p);
            count_one(&asked[k].run, label);
            printf(", ");
            print_asked(question);
            print_library(asked[k].p);
            printf("}\n");
            fflush(stdout);
        }
    }
    end_runs();
}

static long count_block(void)
{
    for (int question = 0; question < QUESTIONS; question++) {
        if (is_chosen((enum question)question)) {
            count_question((enum question)question);
        }
    }
    discard_bodies();
    return 0;
}

/* ---- all blocks ---- */

static long all_blocks(FILE *file, long (*one)(void))
{
    long bad = 0;
    rewind(file);
    while (read_block(file, &block)) {
        time_t start = time(NULL);
        int skipped = *block.growth && (rounds == 0 || chosen);
        read_pairs(file);
        if (!skipped && is_any_chosen()) {
            bad += one();
            fflush(stdout);
            fprintf(stderr, "%4.0f s  %s, %s%s%s, %d-D, %s\n", difftime(time(NULL), start), block.name, block.state,
                    *block.growth ? ", growth by " : "", block.growth, block.dim, precision_name());
        }
        free_pairs();
    }
    return bad;
}

static void count_all(FILE *file)
{
    int status = 1;
    begun = shared_space(sizeof *begun);
    while (status) {
        long before = *begun;
        pid_t child;
        fflush(NULL);
        child = fork();
        if (child == 0) {
            all_blocks(file, count_block);
            _exit(0);
        }
        if (child < 0 || waitpid(child, &status, 0) < 0 || (status && *begun == before)) {
            fprintf(stderr, "not all is counted\n");
            exit(2);
        }
    }
}

static void print_head(void)
{
    printf("{\"row\": \"head\", \"version\": \"%s\", \"compiler\": \"%s\", \"seed\": %d, \"pairs\": %d, \"rounds\": "
           "%ld, ",
           GJK_TEST_VERSION, GJK_TEST_COMPILER, block.seed, block.pairs, rounds);
    print_peers(&peers);
    printf("}\n");
}

/* NULL if there is none; ends the process where it is none. */
static const regex_t *choice(const char *text)
{
    static regex_t expression;
    if (text && regcomp(&expression, text, REG_EXTENDED | REG_NOSUB) != 0) {
        fprintf(stderr, "GJK_COMPARE_CLASSES is no regular expression\n");
        exit(2);
    }
    return text ? &expression : NULL;
}

int main(int argc, char **argv)
{
    long bad = 0, missing;
    FILE *file;
    if (argc < 5 || !(file = fopen(argv[1], "rb")) || !freopen(argv[3], "w", stdout) ||
        (missing = load_peers(&peers, argc - 4, argv + 4)) < 0) {
        fprintf(stderr, "usage: bench PAIRS ROUNDS OUTPUT [NAME=MODULE...]\n");
        return 2;
    }
    rounds = strtol(argv[2], NULL, 10);
    chosen = choice(getenv("GJK_COMPARE_CLASSES"));
    if (read_block(file, &block)) {
        print_head();
    }
    if (rounds) {
        bad = all_blocks(file, measure_block);
    } else {
        count_all(file);
    }
    fclose(file);
    printf("{\"row\": \"end\", \"failures\": %ld}\n", bad);
    return fclose(stdout) != 0 || bad + missing != 0;
}
