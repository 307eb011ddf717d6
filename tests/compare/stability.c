/* SPDX-License-Identifier: MIT */
/* How the library and its peers stand up to the families of pairs and to the cases, measured by exact truth.
 *
 *   stability PAIRS SEED OUTPUT [NAME=MODULE...]     writes JSON, one object a line, for page.py
 *
 * A peer without a module is named as missing. Ends with 1 where the library failed, and where a peer is missing that
 * the environment variable GJK_COMPARE_NEEDS names. */
#include "../cases.h"
#include "../exact.h"
#include "../pairs.h"
#include "../settle.h"
#include "along.h"
#include "judge.h"

#define VALUE_ERROR 4.0  /* in u * scale, of polytopes */
#define DEPTH_WIDTH 16.0 /* likewise */
#define NORMAL_EXCESS 16.0
#define TIGHT_ERROR 1.0   /* in ulp */
#define TIGHT_WIDTH 2.0   /* likewise */
#define TELLS 300.0       /* in u * span: farther apart, or deeper, intersect must say so */
#define FAR_FROM_IT 1e-9  /* of the scale: a wrong verdict so far from contact is no matter of rounding */
#define NEAR_IT 4.0       /* in u * scale: so near to contact any verdict will do */
#define MOST_COUNTED 1000 /* in u * scale: an error beyond is called a wrong answer */

/* Two more groups than families: the museum, whose cases broke other libraries, and the other cases. */
#define MUSEUM FAMILIES
#define WORKED (FAMILIES + 1)
#define GROUPS (FAMILIES + 2)

static const char *group_name(int group)
{
    return group == MUSEUM ? "museum" : group == WORKED ? "worked cases" : family_name[group];
}

/* ---- the pairs ---- */

static int is_extreme_group(int group) { return group < FAMILIES && is_extreme((enum family)group); }

static uint64_t seed;
static long pairs_per_family;

static int is_museum(const test_case *c) { return strcmp(c->group, "museum") == 0; }

/* The pair of that index, and what is known of it. 0: there are no more. */
static int get_pair(int group, long index, const body **a, const body **b, truth *t)
{
    static pair p;
    size_t at = 0;
    if (group < FAMILIES) {
        draws d = draws_from(seed, (uint64_t)group, (uint64_t)index);
        if (index >= pairs_per_family) {
            return 0;
        }
        draw_pair(&d, (enum family)group, &p);
        *a = &p.a;
        *b = &p.b;
        find_truth(t, *a, *b, 1);
        return 1;
    }
    for (long left = index; at < C(_count) && (is_museum(&C(_all)[at]) != (group == MUSEUM) || left-- > 0); at++) {
    }
    if (at == C(_count)) {
        return 0;
    }
    read_case(&C(_all)[at], a, b);
    find_truth(t, *a, *b, 1);
    if (t->lower > 0) { /* a case's own bracket of the distance is of exact arithmetic */
        const test_case *c = &C(_all)[at];
        quad low = (quad)c->lower_hi + (quad)c->lower_lo, high = (quad)c->upper_hi + (quad)c->upper_lo;
        t->lower = low > t->lower ? low : t->lower;
        t->upper = high < t->upper ? high : t->upper;
    }
    return 1;
}

/* ---- ours ---- */

typedef struct tally {
    int group;
    long pairs, apart, meeting, failures, violations, tight_pairs;
    double max_error, max_round_error, max_width, max_tight_error, max_tight_width, sum_calls, max_calls;
    struct {
        long pairs, sharp, limits, failures, violations;
        double max_error, max_width, max_excess, max_round_error, max_round_width, sum_calls, max_calls;
    } deep; /* of penetration, sharp: of bodies with corners and no radius */
} tally;

static struct {
    const body *a, *b;
    const truth *truth;
    double span;
    int exact; /* the truth is known without any rounding */
    tally *tally;
    long index;
} now;

static exact exactly; /* of the pair at hand, if now.exact */

static void tell(const char *what, double by, const V(result) * r)
{
    const truth *t = now.truth;
    if (now.tally->failures + now.tally->violations > 3) {
        return;
    }
    fprintf(stderr, "%s, %s %ld: %s (%.3g)\n", VARIANT, group_name(now.tally->group), now.index, what, by);
    fprintf(stderr, "  answer %.17g in %.17g .. %.17g, status %d; truth %.17g + %.3g, scale %.3g\n  ", (double)r->value,
            (double)r->lower, (double)r->upper, r->status, (double)t->lower, (double)(t->upper - t->lower),
            (double)t->scale);
    print_case(stderr, "distance", now.a, now.b);
}

static void failed(const char *what, double by, const V(result) * r)
{
    now.tally->failures++;
    tell(what, by, r);
}

static void violated(const char *what, const V(result) * r)
{
    now.tally->violations++;
    tell(what, 0, r);
}

/* What lies below the least normal number counts as one unit. */
static double in_u(quad x, quad scale) { return (double)(x / (scale * (quad)U + (quad)REAL_MIN)); }

static void try_distance(void)
{
    const truth *t = now.truth;
    tally *s = now.tally;
    quad low = positive(t->lower), high = positive(t->upper);
    int sharp = t->a.count && t->b.count;
    double error, calls;
    V(result) r;
    memset(&r, 0, sizeof r);
    if (V(distance)(&now.a->shape, &now.b->shape, NULL, &r) < 0) {
        failed("no answer", r.status, &r);
        return;
    }
    if (r.status != GJK_OK && r.status != GJK_FLOOR) {
        failed("ended early", r.status, &r);
    }
    if (now.exact ? exact_above(&exactly, (double)r.lower) < 0 || exact_above(&exactly, (double)r.upper) > 0
                  : (quad)r.lower > high || (quad)r.upper < low) {
        violated("the bracket misses the truth", &r);
    }
    if (!(r.lower <= r.value && r.value <= r.upper)) {
        violated("the value is outside its bracket", &r);
    }
    error = in_u(off((quad)r.value, low, high), t->scale);
    if (!(error <= VALUE_ERROR) && sharp) {
        failed("the value is off, in u * scale", error, &r);
    }
    calls = r.supports / 2.0;
    s->max_error = fmax(s->max_error, error);
    s->max_width = fmax(s->max_width, in_u((quad)r.upper - (quad)r.lower, t->scale));
    s->sum_calls += calls;
    s->max_calls = fmax(s->max_calls, calls);
}

/* Whole numbers of any length decide here. */
static void try_tight(void)
{
    tally *s = now.tally;
    double ulp, error, width;
    V(options) o = default_options();
    V(result) r;
    memset(&r, 0, sizeof r);
    o.tight = 1;
    s->tight_pairs++;
    if (V(distance)(&now.a->shape, &now.b->shape, &o, &r) < 0) {
        failed("tight: no answer", r.status, &r);
        return;
    }
    if (exact_above(&exactly, (double)r.lower) < 0 || exact_above(&exactly, (double)r.upper) > 0 ||
        !(r.lower <= r.value && r.value <= r.upper)) {
        violated("tight: the bracket misses the truth", &r);
    }
    if (exact_above(&exactly, 0) == 0) {
        if (r.value != 0 || r.upper != 0) {
            failed("tight: they meet, yet it is not 0", (double)r.upper, &r);
        }
        return;
    }
    ulp = ulp_of(mpf_get_d(exactly.distance));
    error = exact_error(&exactly, (double)r.value, ulp);
    width = (double)(((quad)r.upper - (quad)r.lower) / (quad)ulp);
    s->max_tight_error = fmax(s->max_tight_error, error);
    s->max_tight_width = fmax(s->max_tight_width, width);
    if (!(error <= TIGHT_ERROR)) {
        failed("tight: the value is off, in ulp", error, &r);
    }
    if (!(width <= TIGHT_WIDTH)) {
        failed("tight: the bracket is wide, in ulp", width, &r);
    }
}

static void try_intersect(void)
{
    const truth *t = now.truth;
    V(result) r;
    memset(&r, 0, sizeof r);
    if (V(intersect)(&now.a->shape, &now.b->shape, NULL, &r) < 0) {
        failed("intersect: no answer", r.status, &r);
        return;
    }
    if ((quad)r.lower > t->upper || (quad)r.upper < t->lower || !(r.lower <= r.value && r.value <= r.upper)) {
        violated("intersect: the bracket misses the truth", &r);
    }
    if (!(r.lower > 0) && in_u(t->lower, now.span) > TELLS) {
        failed("intersect: not seen to be apart, in u * span", in_u(t->lower, now.span), &r);
    }
    if (!(r.upper <= 0) && in_u(-t->upper, now.span) > TELLS) {
        failed("intersect: not seen to meet, in u * span", in_u(-t->upper, now.span), &r);
    }
}

/* Whether u * scale is a normal number. Below, brackets must hold, but no limits are set. */
static int is_normal(void) { return now.truth->scale * (quad)U >= (quad)REAL_MIN; }

/* How much further b must be moved along the normal than the depth, in u * scale. */
static double excess_of(const V(result) * r)
{
    quad n[DIM], along;
    for (int i = 0; i < DIM; i++) {
        n[i] = (quad)r->normal[i];
    }
    if (!is_unit(n)) {
        return HUGE_VAL;
    }
    along = separation_along(now.a, now.b, n);
    return in_u(positive(now.truth->lower - along), now.truth->scale);
}

static void try_sharp_depth(const V(result) * r, double error, double width)
{
    tally *s = now.tally;
    double excess = excess_of(r);
    s->deep.sharp++;
    s->deep.max_error = fmax(s->deep.max_error, error);
    s->deep.max_width = fmax(s->deep.max_width, width);
    s->deep.max_excess = fmax(s->deep.max_excess, excess);
    if (!(error <= VALUE_ERROR)) {
        failed("penetration: the value is off, in u * scale", error, r);
    }
    if (!(width <= DEPTH_WIDTH)) {
        failed("penetration: the bracket is wide, in u * scale", width, r);
    }
    if (!(excess <= NORMAL_EXCESS)) {
        failed("penetration: the normal is not the way out, in u * scale", excess, r);
    }
}

/* Of bodies that meet, or may; those with corners and no radius by exact truth. */
static void try_penetration(int sharp)
{
    const truth *t = now.truth;
    tally *s = now.tally;
    double error, width;
    V(result) r;
    memset(&r, 0, sizeof r);
    s->deep.pairs++;
    if (V(penetration)(&now.a->shape, &now.b->shape, NULL, &r) < 0) {
        failed("penetration: no answer", r.status, &r);
        return;
    }
    if ((quad)r.lower > t->upper || (quad)r.upper < t->lower || !(r.lower <= r.value && r.value <= r.upper)) {
        violated("penetration: the bracket misses the truth", &r);
    }
    s->deep.limits += r.status == GJK_LIMIT;
    s->deep.sum_calls += r.supports / 2.0;
    s->deep.max_calls = fmax(s->deep.max_calls, r.supports / 2.0);
    if (!is_normal()) {
        return;
    }
    error = in_u(off((quad)r.value, t->lower, t->upper), t->scale);
    width = in_u((quad)r.upper - (quad)r.lower, t->scale);
    if (sharp) {
        try_sharp_depth(&r, error, width);
    } else {
        s->deep.max_round_error = fmax(s->deep.max_round_error, error);
        s->deep.max_round_width = fmax(s->deep.max_round_width, width);
    }
}

/* ---- theirs ---- */

/* What a peer of either precision is fed: the corners, mapped in 113 bits, relative to the origin of a; then rounded.
 */
static double rounded_to(quad x, int single)
{
    quad most = single ? (quad)FLT_MAX : (quad)DBL_MAX;
    return x > most ? HUGE_VAL : x < -most ? -HUGE_VAL : single ? (double)(float)x : (double)x;
}

/* Whether all numbers stayed in range. */
static int feed(peer_set *set, double **numbers, const view *v, real radius, int single)
{
    int finite = 1;
    double *x = *numbers = malloc((size_t)v->count * DIM * sizeof *x);
    if (!x) {
        abort();
    }
    for (int k = 0; k < v->count * DIM; k++) {
        x[k] = rounded_to(v->v[k / DIM][k % DIM] * v->unit, single);
        finite &= isfinite(x[k]) != 0;
    }
    set->count = v->count;
    set->v = x;
    set->radius = rounded_to((quad)radius, single);
    return finite && isfinite(set->radius);
}

/* A round body, or one out of range, is not fed: its count stays 0. */
static void feed_pair(fed *f, int single)
{
    memset(f, 0, sizeof *f);
    f->dim = DIM;
    if (now.truth->a.count == 0 || now.truth->b.count == 0) {
        return;
    }
    if (feed(&f->a, &f->numbers[0], &now.truth->a, now.a->shape.radius, single) &
        feed(&f->b, &f->numbers[1], &now.truth->b, now.b->shape.radius, single)) {
        find_fed_truth(f);
    } else {
        f->a.count = f->b.count = 0;
    }
}

typedef struct peer_tally {
    long asked, gave_up, crashed, hung;
    long wrong, near_wrong; /* of verdicts: contradicts the truth far from contact, near it */
    long over[3];           /* of distances: in u * scale beyond 4, 16, 1000 */
    double max_error;       /* of distances in u * scale, of wrong verdicts in scales */
    long example;           /* a wrong answer to the smallest pair; where none is wrong, the largest error; -1: none */
    int example_wrong, example_points;
    double example_error;
} peer_tally;

/* How wrong a verdict is, in scales: 0 where it is right, or cannot be known. */
static double verdict_error(const fed *f, int meet)
{
    quad by = meet ? f->lower : -f->upper;
    return by > 0 ? (double)(by / f->scale) : 0;
}

/* Who cannot measure says whether they meet. */
static enum question how_far(const peer *p) { return p->query[DISTANCE] ? DISTANCE : INTERSECT; }

static void keep_example(peer_tally *s, long index, int points, int wrong, double error)
{
    int better = wrong != s->example_wrong              ? wrong
                 : wrong && points != s->example_points ? points < s->example_points
                                                        : error > s->example_error;
    if (better || (s->example < 0 && error > 0)) {
        s->example = index;
        s->example_wrong = wrong;
        s->example_points = points;
        s->example_error = error;
    }
}

static void judge(peer_tally *s, const peer *p, const fed *f, const reply *r, long index)
{
    static const double marks[] = {4, 16, MOST_COUNTED};
    double u = (p->single ? (double)FLT_EPSILON : DBL_EPSILON) / 2, error = 0;
    int wrong = 1;
    if (r->outcome == NOT_ASKED) {
        return;
    }
    s->asked++;
    s->gave_up += r->outcome == GAVE_UP;
    s->crashed += r->outcome == CRASHED;
    s->hung += r->outcome == HUNG;
    if (r->outcome == ANSWERED && how_far(p) == DISTANCE) {
        quad unit = f->scale * (quad)u + (p->single ? (quad)FLT_MIN : (quad)DBL_MIN);
        error = (double)(off((quad)r->answer.distance, positive(f->lower), positive(f->upper)) / unit);
        for (int k = 0; k < 3; k++) {
            s->over[k] += error > marks[k];
        }
        wrong = error > MOST_COUNTED;
    } else if (r->outcome == ANSWERED) {
        error = verdict_error(f, r->answer.meet);
        error = error > NEAR_IT * u ? error : 0;
        wrong = error > FAR_FROM_IT;
        s->wrong += wrong;
        s->near_wrong += !wrong && error > 0;
    }
    s->max_error = fmax(s->max_error, error);
    keep_example(s, index, f->a.count + f->b.count, wrong, error);
}

/* ---- what is printed ---- */

static void print_tally(const tally *s)
{
    printf(
        "{\"row\": \"ours\", \"variant\": \"%s\", \"group\": \"%s\", \"pairs\": %ld, \"apart\": %ld, \"meeting\": %ld, "
        "\"failures\": %ld, \"violations\": %ld, \"tight_pairs\": %ld, \"extreme\": %d",
        VARIANT, group_name(s->group), s->pairs, s->apart, s->meeting, s->failures, s->violations, s->tight_pairs,
        is_extreme_group(s->group));
    print_number("error", s->max_error);
    print_number("width", s->max_width);
    print_number("tight_error", s->max_tight_error);
    print_number("tight_width", s->max_tight_width);
    print_number("mean_calls", s->pairs ? s->sum_calls / (double)s->pairs : 0);
    print_number("max_calls", s->max_calls);
    printf(", \"deep\": {\"pairs\": %ld, \"sharp\": %ld, \"limits\": %ld, \"failures\": %ld, "
           "\"violations\": %ld",
           s->deep.pairs, s->deep.sharp, s->deep.limits, s->deep.failures, s->deep.violations);
    print_number("error", s->deep.max_error);
    print_number("width", s->deep.max_width);
    print_number("excess", s->deep.max_excess);
    print_number("round_error", s->deep.max_round_error);
    print_number("round_width", s->deep.max_round_width);
    print_number("mean_calls", s->deep.pairs ? s->deep.sum_calls / (double)s->deep.pairs : 0);
    print_number("max_calls", s->deep.max_calls);
    printf("}}\n");
}

static void print_peer_tally(const peer *p, int group, const peer_tally *s, const fed *pairs, const reply *replies)
{
    static const char *const outcomes[] = {"not asked", "answered", "gave up", "crashed", "hung"};
    printf("{\"row\": \"peer\", \"variant\": \"%s\", \"group\": \"%s\", \"peer\": \"%s\", \"extreme\": %d, \"asked\": "
           "%ld, \"gave_up\": %ld, "
           "\"crashed\": %ld, \"hung\": %ld, \"wrong\": %ld, \"near_wrong\": %ld, \"over\": [%ld, %ld, %ld]",
           VARIANT, group_name(group), p->library, is_extreme_group(group), s->asked, s->gave_up, s->crashed, s->hung,
           s->wrong, s->near_wrong, s->over[0], s->over[1], s->over[2]);
    print_number("error", s->max_error);
    if (s->example >= 0) {
        const fed *f = &pairs[s->example];
        const reply *r = &replies[s->example];
        printf(", \"example\": {\"index\": %ld, \"outcome\": \"%s\", \"meet\": %d", s->example, outcomes[r->outcome],
               r->answer.meet);
        print_number("distance", how_far(p) == DISTANCE ? r->answer.distance : 0);
        print_number("lower", (double)f->lower);
        print_number("upper", (double)f->upper);
        print_number("error", s->example_error);
        printf(", \"case\": ");
        print_fed_case(stdout, f, how_far(p) == DISTANCE ? "distance" : "intersect");
        printf("}");
    }
    printf("}\n");
}

static void print_head(const peer_list *peers)
{
    printf(
        "{\"row\": \"head\", \"variant\": \"%s\", \"dim\": %d, \"precision\": \"%s\", \"pairs\": %ld, \"seed\": %llu, "
        "\"version\": \"%s\", \"compiler\": \"%s\", ",
        VARIANT, DIM, PRECISION, pairs_per_family, (unsigned long long)seed, GJK_TEST_VERSION, GJK_TEST_COMPILER);
    print_peers(peers);
    printf("}\n");
}

/* ---- all of it ---- */

static fed *fed_pairs[2]; /* to peers in double, in float */
static reply *replies;

static void ask_how_far(const peer *p, const tally *s)
{
    const fed *pairs = fed_pairs[p->single];
    peer_tally theirs;
    memset(&theirs, 0, sizeof theirs);
    theirs.example = -1;
    ask_peers(&p, 1, how_far(p), pairs, (int)s->pairs, 0, &replies);
    for (long i = 0; i < s->pairs; i++) {
        judge(&theirs, p, &pairs[i], &replies[i], i);
    }
    print_peer_tally(p, s->group, &theirs, pairs, replies);
}

/* Of pairs that are apart it is not asked. */
static void ask_how_deep(const peer *p, const tally *s)
{
    const fed *pairs = fed_pairs[p->single];
    score theirs;
    start_score(&theirs, PENETRATION);
    ask_peers(&p, 1, PENETRATION, pairs, (int)s->pairs, 0, &replies);
    for (long i = 0; i < s->pairs; i++) {
        if (replies[i].outcome != NOT_ASKED && !(pairs[i].lower > 0)) {
            judge_answer(&theirs, p, &pairs[i], &replies[i], i);
        }
    }
    printf("{\"row\": \"peer depth\", \"variant\": \"%s\", \"group\": \"%s\", \"peer\": \"%s\", \"extreme\": %d",
           VARIANT, group_name(s->group), p->library, is_extreme_group(s->group));
    print_score(&theirs, pairs, replies);
    printf("}\n");
}

static void try_pairs(tally *s, const int *single)
{
    static truth t;
    int sharp = 0;
    now.truth = &t;
    for (now.index = 0; get_pair(s->group, now.index, &now.a, &now.b, &t); now.index++) {
        now.span = span_of_pair(now.a, now.b);
        s->pairs++;
        s->apart += t.lower > 0;
        s->meeting += t.upper < 0;
        now.exact = has_corners(now.a) && has_corners(now.b);
        if (now.exact) {
            exact_distance(&exactly, now.a, now.b);
            try_tight();
        }
        try_distance();
        try_intersect();
        if (!(t.lower > 0)) {
            sharp = now.exact && !(now.a->shape.radius > 0) && !(now.b->shape.radius > 0);
            sharp = settle(&t, &exactly, now.a, now.b) && sharp;
            if (!(t.lower > 0)) {
                long failures = s->failures, violations = s->violations;
                try_penetration(sharp);
                s->deep.failures += s->failures - failures;
                s->deep.violations += s->violations - violations;
            }
        }
        for (int k = 0; k < 2; k++) {
            if (single[k]) {
                feed_pair(&fed_pairs[k][now.index], k);
            }
        }
    }
}

static void one_group(tally *s, const peer_list *peers)
{
    long most = s->group < FAMILIES ? pairs_per_family : (long)C(_count);
    int single[2] = {0, 0};
    replies = shared_space((size_t)most * sizeof *replies);
    for (int k = 0; k < peers->count; k++) {
        single[peers->all[k]->single] |= peers->all[k]->dim == DIM;
    }
    for (int k = 0; k < 2; k++) {
        fed_pairs[k] = calloc((size_t)most, sizeof *fed_pairs[k]);
        if (!fed_pairs[k]) {
            abort();
        }
    }
    now.tally = s;
    try_pairs(s, single);
    print_tally(s);
    for (int k = 0; k < peers->count; k++) {
        const peer *p = peers->all[k];
        if (p->dim == DIM && p->query[how_far(p)]) {
            ask_how_far(p, s);
        }
        if (p->dim == DIM && p->query[PENETRATION]) {
            ask_how_deep(p, s);
        }
    }
    for (int k = 0; k < 2; k++) {
        for (long i = 0; i < most; i++) {
            free(fed_pairs[k][i].numbers[0]);
            free(fed_pairs[k][i].numbers[1]);
        }
        free(fed_pairs[k]);
    }
    fflush(stdout);
}

int main(int argc, char **argv)
{
    static peer_list peers;
    long bad = 0;
    if (argc < 4 || !freopen(argv[3], "w", stdout) || (bad = load_peers(&peers, argc - 4, argv + 4)) < 0) {
        fprintf(stderr, "usage: stability PAIRS SEED OUTPUT [NAME=MODULE...]\n");
        return 2;
    }
    keep_usual(&peers);
    pairs_per_family = strtol(argv[1], NULL, 10);
    seed = strtoull(argv[2], NULL, 10);
    print_head(&peers);
    exact_start(&exactly);
    for (int group = 0; group < GROUPS; group++) {
        tally s;
        memset(&s, 0, sizeof s);
        s.group = group;
        one_group(&s, &peers);
        bad += s.failures + s.violations;
    }
    printf("{\"row\": \"end\"}\n");
    return fclose(stdout) != 0 || bad != 0;
}
