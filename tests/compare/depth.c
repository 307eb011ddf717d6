/* SPDX-License-Identifier: MIT */
/* How deep everyday shapes overlap: the library beside its peers, by exact truth, and the time that each takes.
 *
 *   depth PAIRS ROUNDS SEED OUTPUT [NAME=MODULE...]     writes JSON, one object a line, for depth_page.py
 *
 * The library is a peer as any, and the first of them. In each round everyone in turn answers all pairs of a class.
 * ROUNDS 0: nothing is judged; run by callgrind, with --instr-atstart=no, it dumps the instructions of one round, each
 * peer's under the name CLASS/PEER. Ends with 1 where the library failed, and where a peer is missing that the
 * environment variable GJK_COMPARE_NEEDS names. */
#define _POSIX_C_SOURCE 200112L /* clock_gettime */
#include "../pairs.h"
#include "judge.h"

#include <time.h>

#if GJK_TEST_KNOWS_CALLGRIND
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_STOP_INSTRUMENTATION
#define CALLGRIND_DUMP_STATS_AT(name) (void)(name)
#endif

#define OURS 0          /* the place of ours, without options, among the peers */
#define VALUE_ERROR 4.0 /* of bodies with corners, in u * scale */
#define NORMAL_EXCESS 16.0

/* ---- bodies ---- */

static void draw_kind(draws *d, body *b, enum kind kind, int count)
{
    start_body(b, kind);
    switch (kind) {
    case POINTS:
        draw_hull(d, b, count, 1);
        break;
    case SEGMENT: /* a capsule */
        b->v[0][2] = between(d, 0.3, 1);
        b->v[1][2] = -b->v[0][2];
        b->shape.radius = between(d, 0.1, 0.5);
        break;
    case ORIGIN: /* a ball */
        b->shape.radius = between(d, 0.3, 1);
        break;
    default:
        for (int i = 0; i < DIM; i++) {
            b->half[i] = between(d, 0.3, 1);
        }
        b->radius = between(d, 0.3, 1);
        b->half_length = between(d, 0.3, 1);
    }
    turn(d, b, 100);
}

/* A mean of four farthest points, and so inside. */
static void draw_inner_point(draws *d, body *b, double *point)
{
    double sum = 0;
    memset(point, 0, DIM * sizeof *point);
    for (int k = 0; k < 4; k++) {
        double dir[DIM], back[DIM] = {0}, x[DIM], weight = between(d, 0, 1);
        unit(d, dir);
        for (int i = 0; i < DIM * DIM; i++) {
            back[i % DIM] += b->pose.m[i] * dir[i / DIM];
        }
        b->shape.support(b->shape.data, back, x);
        for (int i = 0; i < DIM; i++) {
            double at = b->shape.radius * dir[i];
            for (int j = 0; j < DIM; j++) {
                at += b->pose.m[i * DIM + j] * x[j];
            }
            point[i] += weight * at;
        }
        sum += weight;
    }
    for (int i = 0; i < DIM; i++) {
        point[i] /= sum;
    }
}

/* ---- classes of pairs, which overlap by the way they are drawn ---- */

typedef struct class
{
    const char *name;
    void (*draw)(draws *d, pair *p, const struct class *c);
    enum kind a, b;
    int count; /* of points of each */
    double depth;
} class;

/* An inner point of one on an inner point of the other. */
static void draw_overlap(draws *d, pair *p, const class *c)
{
    double x[DIM], y[DIM];
    draw_kind(d, &p->a, c->a, c->count);
    draw_kind(d, &p->b, c->b, c->count);
    bind_pair(p);
    draw_inner_point(d, &p->a, x);
    draw_inner_point(d, &p->b, y);
    for (int i = 0; i < DIM; i++) {
        p->b.pose.p[i] = x[i] - y[i];
    }
}

/* Middle near middle. */
static void draw_deep(draws *d, pair *p, const class *c)
{
    double dir[DIM];
    draw_kind(d, &p->a, c->a, c->count);
    draw_kind(d, &p->b, c->b, c->count);
    unit(d, dir);
    move(&p->b, dir, between(d, 0, 0.2));
}

/* One on a side of the other, in steps that are held without rounding. */
static void draw_stacked(draws *d, pair *p, const class *c)
{
    int up = below(d, DIM), sign = below(d, 2) ? -1 : 1;
    (void)c;
    draw_box(d, &p->a, 1, 1);
    draw_box(d, &p->b, 1, 1);
    for (int i = 0; i < DIM; i++) {
        p->a.half[i] = p->b.half[i] = 0.5;
        p->b.pose.p[i] = i == up ? sign : (below(d, 7) - 3) * 0.25;
    }
}

/* Corner in face, or face on face, of which one is turned about the way up. */
static void draw_shallow(draws *d, pair *p, const class *c)
{
    double side[2][DIM], at[DIM], up[DIM], back[DIM];
    int axis = below(d, DIM), flat = below(d, 2);
    draw_kind(d, &p->a, BOX, 0);
    draw_kind(d, &p->b, BOX, 0);
    axis_of(&p->a, axis, up);
    axis_of(&p->a, (axis + 1) % DIM, side[0]);
    axis_of(&p->a, (axis + 2) % DIM, side[1]);
    if (flat) {
        double x = between(d, -1, 1), y = between(d, 0.1, 1), n = sqrt(x * x + y * y);
        for (int i = 0; i < DIM; i++) {
            p->b.pose.m[i * DIM + axis] = up[i];
            p->b.pose.m[i * DIM + (axis + 1) % DIM] = (x * side[0][i] + y * side[1][i]) / n;
            p->b.pose.m[i * DIM + (axis + 2) % DIM] = (x * side[1][i] - y * side[0][i]) / n;
        }
    }
    memset(at, 0, sizeof at);
    for (int k = 0; k < 2; k++) {
        double by = between(d, -0.8, 0.8) * p->a.half[(axis + 1 + k) % DIM];
        for (int i = 0; i < DIM; i++) {
            at[i] += by * side[k][i];
        }
    }
    for (int i = 0; i < DIM; i++) {
        back[i] = -up[i];
    }
    /* the lowest corner of b, or its middle, over that place of the face */
    for (int j = 0; j < DIM && !flat; j++) {
        double column[DIM], along = 0;
        axis_of(&p->b, j, column);
        for (int i = 0; i < DIM; i++) {
            along += column[i] * up[i];
        }
        for (int i = 0; i < DIM; i++) {
            at[i] += (along > 0 ? 1 : -1) * p->b.half[j] * (column[i] - along * up[i]);
        }
    }
    move(&p->b, at, 1);
    move(&p->b, up, extent(&p->a, up) + extent(&p->b, back) - c->depth);
}

static const class classes[] = {{"boxes, turned", draw_overlap, BOX, BOX, 0, 0},
                                {"cubes, stacked", draw_stacked, BOX, BOX, 0, 0},
                                {"boxes, 1e-3 deep", draw_shallow, BOX, BOX, 0, 1e-3},
                                {"boxes, 1e-6 deep", draw_shallow, BOX, BOX, 0, 1e-6},
                                {"boxes, 1e-9 deep", draw_shallow, BOX, BOX, 0, 1e-9},
                                {"boxes, very deep", draw_deep, BOX, BOX, 0, 0},
                                {"hulls of 8 points", draw_overlap, POINTS, POINTS, 8, 0},
                                {"hulls of 16 points", draw_overlap, POINTS, POINTS, 16, 0},
                                {"hulls of 64 points", draw_overlap, POINTS, POINTS, 64, 0},
                                {"box and ball", draw_overlap, BOX, ORIGIN, 0, 0},
                                {"capsules", draw_overlap, SEGMENT, SEGMENT, 0, 0},
                                {"capsule and box", draw_overlap, SEGMENT, BOX, 0, 0},
                                {"cylinder and box", draw_overlap, CYLINDER, BOX, 0, 0},
                                {"ellipsoids", draw_overlap, ELLIPSOID, ELLIPSOID, 0, 0}};
#define CLASSES ((int)(sizeof classes / sizeof *classes))

static int is_sharp(const class *c) { return c->a <= BOX && c->b <= BOX; }

static peer_set set_of(const body *b)
{
    static const enum peer_core cores[] = {
        [POINTS] = PEER_POINTS,       [BOX] = PEER_BOX,      [SEGMENT] = PEER_SEGMENT, [CYLINDER] = PEER_CYLINDER,
        [ELLIPSOID] = PEER_ELLIPSOID, [ORIGIN] = PEER_ORIGIN};
    peer_set s;
    memset(&s, 0, sizeof s);
    s.core = cores[b->kind];
    s.count = b->kind == POINTS || b->kind == SEGMENT ? b->count : 0;
    s.v = b->v[0];
    memcpy(s.size, b->half, sizeof s.size);
    if (b->kind == CYLINDER) {
        s.size[0] = b->radius;
        s.size[1] = b->half_length;
    }
    s.posed = 1;
    memcpy(s.m, b->pose.m, sizeof s.m);
    memcpy(s.p, b->pose.p, sizeof s.p);
    s.radius = b->shape.radius;
    return s;
}

/* ---- time ---- */

/* What asking costs by itself. */
static int ask_nothing(const void *a, const void *b, peer_answer *out)
{
    out->meet = a != b;
    return 0;
}

static long pair_count, rounds;
static uint64_t seed;
static peer_list peers;
static pair *pairs;
static fed *fed_pairs;
static reply *replies[MOST_PEERS];
static void **made[MOST_PEERS]; /* a and b of each pair; NULL: no part in it */

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static void answer_all(peer_query *query, void **bodies, long count)
{
    static volatile int sink;
    for (long i = 0; i < count; i++) {
        peer_answer answer;
        query(bodies[2 * i], bodies[2 * i + 1], &answer);
        sink = answer.meet;
    }
    (void)sink;
}

/* Those pairs that no peer crashes or hangs on; returns how many. */
static long make_all(void)
{
    long count = 0;
    for (int k = 0; k < peers.count; k++) {
        made[k] = replies[k][0].outcome == NOT_ASKED ? NULL : calloc(2 * (size_t)pair_count, sizeof *made[k]);
    }
    for (long i = 0; i < pair_count; i++) {
        int safe = 1;
        for (int k = 0; k < peers.count; k++) {
            safe &= replies[k][i].outcome <= GAVE_UP;
        }
        for (int k = 0; k < peers.count && safe; k++) {
            if (made[k]) {
                made[k][2 * count] = peers.all[k]->make(&fed_pairs[i].a);
                made[k][2 * count + 1] = peers.all[k]->make(&fed_pairs[i].b);
            }
        }
        count += safe;
    }
    return count;
}

static void discard_all(long count)
{
    for (int k = 0; k < peers.count; k++) {
        for (long i = 0; i < 2 * count && made[k]; i++) {
            peers.all[k]->discard(made[k][i]);
        }
        free(made[k]);
    }
}

static int by_size(const void *x, const void *y)
{
    double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}

static double median(double *x, long count)
{
    qsort(x, (size_t)count, sizeof *x, by_size);
    return count ? (x[(count - 1) / 2] + x[count / 2]) / 2 : 0;
}

typedef struct timing {
    double least, median; /* nanoseconds an answer */
} timing;

/* Turn by turn, whoever asks nothing first. */
static void time_all(long count, timing *empty, timing *theirs)
{
    double *ns[MOST_PEERS + 1];
    for (int k = 0; k <= peers.count; k++) {
        ns[k] = calloc((size_t)rounds, sizeof *ns[k]);
    }
    for (long round = -1; round < rounds; round++) { /* the first is not counted */
        for (int k = 0; k <= peers.count; k++) {
            double start = seconds();
            if (k == peers.count) {
                answer_all(ask_nothing, made[OURS], count);
            } else if (made[k]) {
                answer_all(peers.all[k]->penetration, made[k], count);
            }
            ns[k][round > 0 ? round : 0] = (seconds() - start) * 1e9 / (double)count;
        }
    }
    for (int k = 0; k <= peers.count; k++) {
        timing *t = k == peers.count ? empty : &theirs[k];
        t->median = median(ns[k], rounds);
        t->least = ns[k][0];
        free(ns[k]);
    }
}

static void count_one(const class *c, const char *name, peer_query *query, void **bodies, long count)
{
    char label[120];
    snprintf(label, sizeof label, "%s/%s", c->name, name);
    CALLGRIND_START_INSTRUMENTATION;
    answer_all(query, bodies, count);
    CALLGRIND_DUMP_STATS_AT(label);
    CALLGRIND_STOP_INSTRUMENTATION;
    printf("{\"row\": \"counted\", \"label\": \"%s\", \"answers\": %ld}\n", label, count);
}

static void count_all(const class *c, long count)
{
    count_one(c, "nothing", ask_nothing, made[OURS], count);
    for (int k = 0; k < peers.count; k++) {
        if (made[k]) {
            count_one(c, peers.all[k]->name, peers.all[k]->penetration, made[k], count);
        }
    }
}

/* ---- truth ---- */

static void print_class(const class *c, long timed, const timing *empty)
{
    double width = 0, least = HUGE_VAL, most = 0;
    for (long i = 0; i < pair_count; i++) {
        const fed *f = &fed_pairs[i];
        width = fmax(width, (double)((f->upper - f->lower) / f->scale));
        least = fmin(least, (double)(-f->upper / f->scale));
        most = fmax(most, (double)(-f->lower / f->scale));
    }
    printf("{\"row\": \"class\", \"class\": \"%s\", \"pairs\": %ld, \"timed\": %ld", c->name, pair_count, timed);
    print_number("truth_width", width);
    print_number("least", least);
    print_number("most", most);
    print_number("empty_least", empty->least);
    print_number("empty_median", empty->median);
    printf("}\n");
}

/* Returns how often ours failed. */
static long print_answers(const class *c, int k, const timing *empty, const timing *t)
{
    const peer *p = peers.all[k];
    depth_tally s;
    long bad = 0, sound = 0;
    double *error = calloc((size_t)pair_count, sizeof *error), u = DBL_EPSILON / 2;
    start_depth_tally(&s);
    for (long i = 0; i < pair_count; i++) {
        judgement j = judge_depth(&s, p, &fed_pairs[i], &replies[k][i], i);
        if (j.failure == SOUND) {
            error[sound++] = j.error;
        }
        bad += k == OURS &&
               (j.failure != SOUND || (is_sharp(c) && !(j.error <= VALUE_ERROR * u && j.excess <= NORMAL_EXCESS * u)));
    }
    printf("{\"row\": \"answers\", \"class\": \"%s\", \"peer\": \"%s\"", c->name, p->name);
    print_number("median_error", median(error, sound));
    print_number("least", t->least - empty->least);
    print_number("median", t->median - empty->median);
    print_depth_tally(&s, fed_pairs, replies[k]);
    printf("}\n");
    free(error);
    return bad;
}

/* ---- all of it ---- */

static void draw_class(const class *c)
{
    for (long i = 0; i < pair_count; i++) {
        draws d = draws_from(seed, (uint64_t)(c - classes), (uint64_t)i);
        memset(&pairs[i], 0, sizeof pairs[i]);
        c->draw(&d, &pairs[i], c);
        memset(&fed_pairs[i], 0, sizeof fed_pairs[i]);
        fed_pairs[i].a = set_of(&pairs[i].a);
        fed_pairs[i].b = set_of(&pairs[i].b);
    }
}

static long one_class(const class *c)
{
    timing empty, theirs[MOST_PEERS];
    long count, bad = 0;
    draw_class(c);
    for (int k = 0; k < peers.count; k++) {
        ask_peer(peers.all[k], HOW_DEEP, fed_pairs, (int)pair_count, replies[k]);
    }
    count = make_all();
    if (rounds == 0) {
        count_all(c, count);
        discard_all(count);
        return 0;
    }
    for (long i = 0; i < pair_count; i++) {
        find_fed_truth(&fed_pairs[i]);
    }
    time_all(count, &empty, theirs);
    discard_all(count);
    print_class(c, count, &empty);
    for (int k = 0; k < peers.count; k++) {
        if (replies[k][0].outcome != NOT_ASKED) {
            bad += print_answers(c, k, &empty, &theirs[k]);
        }
    }
    fflush(stdout);
    return bad;
}

/* Only those who can be asked how deep. */
static void leave_out_others(void)
{
    int kept = 0;
    for (int k = 0; k < peers.count; k++) {
        if (peers.all[k]->penetration && peers.all[k]->dim == DIM) {
            peers.all[kept++] = peers.all[k];
        }
    }
    peers.count = kept;
}

int main(int argc, char **argv)
{
    long bad = 0, missing;
    if (argc < 6 || !freopen(argv[4], "w", stdout) || (missing = load_peers(&peers, argc - 5, argv + 5)) < 0) {
        fprintf(stderr, "usage: depth PAIRS ROUNDS SEED OUTPUT [NAME=MODULE...]\n");
        return 2;
    }
    pair_count = strtol(argv[1], NULL, 10);
    rounds = strtol(argv[2], NULL, 10);
    seed = strtoull(argv[3], NULL, 10);
    leave_out_others();
    pairs = calloc((size_t)pair_count, sizeof *pairs);
    fed_pairs = calloc((size_t)pair_count, sizeof *fed_pairs);
    if (!pairs || !fed_pairs || peers.count == 0) {
        return 2;
    }
    for (int k = 0; k < peers.count; k++) {
        replies[k] = reply_space((int)pair_count);
    }
    printf("{\"row\": \"head\", \"pairs\": %ld, \"rounds\": %ld, \"seed\": %llu, \"version\": \"%s\", \"compiler\": "
           "\"%s\", ",
           pair_count, rounds, (unsigned long long)seed, GJK_TEST_VERSION, GJK_TEST_COMPILER);
    print_peers(&peers);
    printf("}\n");
    for (int k = 0; k < CLASSES; k++) {
        bad += one_class(&classes[k]);
    }
    printf("{\"row\": \"end\", \"failures\": %ld}\n", bad);
    return fclose(stdout) != 0 || bad + missing != 0;
}
