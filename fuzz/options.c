/* SPDX-License-Identifier: MIT */
/* Options of any age and any content, and caches from anywhere. Each struct is handed over in a block of memory of its
 * own size, so that reading beyond it is seen. What is to be refused is worked out here, from the header's words. */
#include "laws.h"

#define MOST_BYTES 1100
#define LARGEST 1024 /* what no options will outgrow: a larger size was never set */

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

/* ---- the struct ---- */

static real option_number(question *q, input *in)
{
    double cold = (double)shifted(q->t.upper, q->exponent);
    switch (choice(in, 12)) {
    case 0:
        return (real)NAN;
    case 1:
        return (real)(byte(in) & 1 ? INFINITY : -INFINITY);
    case 2:
        return -(real)0.0;
    case 3:
        return number(in); /* may be below 0 */
    case 4:
    case 5:
        return size_number(in);
    case 6:
        return nudged(rounded(fabs(cold)), small_whole(in)); /* around the answer */
    case 7:
        return rounded(fabs(cold) * byte(in) / 128);
    case 8:
        return (real)ldexp(1, -byte(in) % 64);
    default:
        return 0;
    }
}

static uint32_t option_size(input *in)
{
    static const size_t ages[] = {offsetof(V(options), cache), offsetof(V(options), workspace),
                                  offsetof(V(options), tight), sizeof(V(options))};
    int op = choice(in, 8);
    if (op == 0) {
        return (uint32_t)(two_bytes(in) % MOST_BYTES);
    }
    if (op == 1) {
        return UINT32_MAX >> byte(in) % 24;
    }
    return (uint32_t)ages[op < 5 ? 3 : op - 5];
}

#define MOST_CORNERS 264

/* A workspace of so many bytes, aligned for any number. It stays. */
static unsigned char *lend_room(size_t bytes)
{
    static unsigned char *room; /* of its own size, so that a step beyond it is seen */
    free(room);
    room = malloc(bytes > 0 ? bytes : 1);
    return room;
}

/* None, as a rule; or one with room for 8 corners or more; or one too small, or of no bytes, or aligned for nothing. */
static void read_workspace(V(options) * o, int op, input *in)
{
    size_t bytes = 0, off = 0;
    if (op == 4) {
        o->workspace_bytes = 1u << byte(in) % 32;
    }
    if (op != 1 && (op < 6 || op > 9)) {
        return;
    }
    if (op >= 6) {
        bytes = V(workspace_size)(8 + (uint32_t)byte(in) % (MOST_CORNERS - 8));
        off = op == 8 ? (size_t)byte(in) % sizeof(real) : 0;
        bytes = op == 9 ? (size_t)two_bytes(in) : bytes;
    }
    o->workspace = lend_room(bytes + off);
    if (o->workspace) {
        o->workspace = (unsigned char *)o->workspace + off;
        o->workspace_bytes = (uint32_t)bytes;
    }
}

static void read_options(question *q, input *in)
{
    V(options) *o = &q->options;
    int op;
    memset(o, 0, sizeof *o);
    o->size = option_size(in);
    op = choice(in, 8);
    o->max_steps = op == 0 ? UINT32_MAX - (uint32_t)byte(in) : op < 4 ? (uint32_t)byte(in) % 24 : 0;
    o->abs_tol = option_number(q, in);
    o->rel_tol = option_number(q, in);
    o->cutoff = option_number(q, in);
    o->slack = choice(in, 3) == 0 ? option_number(q, in) : 0;
    op = choice(in, 16);
    o->tight = op == 2 ? (uint32_t)byte(in) << 24 | 2 : (uint32_t)(op & 1);
    read_workspace(o, op, in);
}

static int holds(const V(options) * o, size_t field) { return o->size > field; }

static int is_good(real x) { return x >= 0 && x <= REAL_MAX; }

/* Whether the header calls these options good. tail: a byte beyond this library's struct that is not 0. */
static int are_good(const V(options) * o, int tail)
{
    const size_t old = offsetof(V(options), cache);
    if (o->size > LARGEST || (o->size > sizeof *o && tail)) {
        return 0;
    }
    if (o->size < sizeof *o && o->size != old && o->size != offsetof(V(options), workspace) &&
        o->size != offsetof(V(options), tight)) {
        return 0;
    }
    if (holds(o, offsetof(V(options), tight)) && o->tight > 1) {
        return 0;
    }
    return is_good(o->abs_tol) && is_good(o->rel_tol) && is_good(o->cutoff) && is_good(o->slack);
}

/* Whether penetration may take the workspace, or there is none. */
static int is_good_workspace(const V(options) * o)
{
    if (o->workspace == NULL) {
        return o->workspace_bytes == 0;
    }
    return (uintptr_t)o->workspace % sizeof(real) == 0 && o->workspace_bytes >= V(workspace_size)(8);
}

/* Fields that an older struct does not hold are not there, whatever they say. */
static void forget_beyond_size(V(options) * o)
{
    if (!holds(o, offsetof(V(options), workspace))) {
        o->workspace = NULL;
    }
    if (!holds(o, offsetof(V(options), cache))) {
        o->cache = NULL;
    }
    if (!holds(o, offsetof(V(options), tight))) {
        o->tight = 0;
    }
    if (!holds(o, offsetof(V(options), workspace_bytes))) {
        o->workspace_bytes = 0;
    }
}

/* ---- the cache ---- */

enum trust { TRUE_POINTS, ANY_POINTS };

static void spoil_numbers(input *in, real *x, int count)
{
    for (int i = 0; i < count; i++) {
        int op = choice(in, 16);
        x[i] = op == 0 ? (real)NAN : op == 1 ? (real)INFINITY : op < 8 ? number(in) : x[i];
    }
}

/* From a query of this pair, perhaps at another place; or of the swapped pair; or of nothing at all. A cache may lack
 * corners, repeat them or come from elsewhere; points that no support has given are beyond its contract, and for them
 * only the form of the answer is asked. */
static enum trust read_cache(question *q, input *in, V(cache) * cache)
{
    V(options) plain = default_options();
    V(result) r;
    int op = choice(in, 8);
    memset(cache, 0, sizeof *cache);
    plain.cache = cache;
    if (op == 0) {
        return TRUE_POINTS;
    }
    if (op == 1) {
        V(distance)(&q->s.p.b.shape, &q->s.p.a.shape, &plain, &r);
        return TRUE_POINTS;
    }
    if (op == 2) {
        V(pose) was = q->s.p.b.pose;
        spoil_numbers(in, q->s.p.b.pose.m, DIM * DIM);
        read_vector(in, q->s.p.b.pose.p);
        V(intersect)(&q->s.p.a.shape, &q->s.p.b.shape, &plain, &r);
        q->s.p.b.pose = was;
        return TRUE_POINTS;
    }
    V(distance)(&q->s.p.a.shape, &q->s.p.b.shape, &plain, &r);
    if (op == 3 && cache->count > 1) {
        int from = choice(in, (int)cache->count), to = choice(in, (int)cache->count);
        memcpy(cache->a[to], cache->a[from], sizeof cache->a[0]);
        cache->count -= (uint32_t)choice(in, 2);
    }
    if (op == 4) { /* other sets' points: not to be looked at */
        cache->data[choice(in, 2)] = cache;
        spoil_numbers(in, cache->a[0], 4 * DIM);
    }
    if (op < 5) {
        return TRUE_POINTS;
    }
    spoil_numbers(in, cache->a[0], 4 * DIM);
    spoil_numbers(in, cache->b[0], 4 * DIM);
    spoil_numbers(in, &cache->reach_a, 1);
    spoil_numbers(in, &cache->reach_b, 1);
    op = choice(in, 4);
    cache->count = op == 0 ? UINT32_MAX - (uint32_t)byte(in) : op == 1 ? (uint32_t)byte(in) % 8 : cache->count;
    cache->reserved = (uint32_t)byte(in);
    return ANY_POINTS;
}

/* ---- the question ---- */

/* from: the first of the queries that refuse. */
static void ask_refused(question *q, enum query from)
{
    static const char *const names[] = {"distance with bad options", "intersect with bad options",
                                        "penetration with bad options"};
    for (int k = (int)from; k < QUERIES; k++) {
        V(result) r, before;
        memset(&before, 0x5a, sizeof before);
        r = before;
        q->query = names[k];
        int status = query_of[k](&q->s.p.a.shape, &q->s.p.b.shape, q->given, &r);
        if (status != GJK_BAD_ARGUMENT) {
            broken(q, "bad options were taken", &r, q->options.size);
        }
        if (memcmp(&r, &before, sizeof r) != 0) {
            broken(q, "refused, but the result was touched", &r, q->options.size);
        }
    }
}

static void ask_form(question *q, enum query asked)
{
    V(result) r, before;
    memset(&before, 0x5a, sizeof before);
    r = before;
    q->query = asked == INTERSECT ? "intersect from a spoiled cache" : "distance from a spoiled cache";
    int status = query_of[asked](&q->s.p.a.shape, &q->s.p.b.shape, q->given, &r);
    if (status >= 0) {
        check_form(q, asked, &r, status);
    } else if (status != GJK_BAD_SUPPORT || memcmp(&r, &before, sizeof r) != 0) {
        broken(q, "refused, but not for a support, or the result was touched", &r, status);
    }
}

/* The same of the third query: the bracket holds, however the workspace or the steps run out. */
static void ask_penetration(question *q, enum trust trust)
{
    V(result) r, before;
    memset(&before, 0x5a, sizeof before);
    r = before;
    q->query = "penetration";
    int status = V(penetration)(&q->s.p.a.shape, &q->s.p.b.shape, q->given, &r);
    if (status < 0) {
        int fair = status == GJK_BAD_SUPPORT && (q->may_refuse || trust == ANY_POINTS);
        if (!fair || memcmp(&r, &before, sizeof r) != 0) {
            broken(q, "an error for a good pair, or the result was touched", NULL, status);
        }
        return;
    }
    check_form(q, PENETRATION, &r, status);
    if (trust == TRUE_POINTS) {
        check_bracket(q, &r, q->t.lower, q->t.upper);
    }
}

/* Beyond the truth, the cutoff or a tolerance may be what was asked. */
static void ask_both(question *q, enum trust trust)
{
    V(result) d, i;
    if (trust == ANY_POINTS) {
        ask_form(q, DISTANCE);
        ask_form(q, INTERSECT);
    } else if (ask_distance(q, 0, &d) && ask_intersect(q, 0, &i)) {
        must_be_consistent(q, &d, &i);
    }
}

/* Of the slack as the maps make it, with room for what it is added to. */
static int slack_exponent(const question *q)
{
    int a = highest(q->s.p.a.pose.m, DIM * DIM), b = highest(q->s.p.b.pose.m, DIM * DIM);
    return exponent_of((double)q->options.slack) + larger_of(0, larger_of(a, b));
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    static question q;
    input in = input_from(bytes, count);
    V(cache) cache;
    size_t size, whole = sizeof(V(options));
    unsigned char *block;
    enum trust trust;
    int tail;
    read_question(&q, &in, bytes, count);
    seek_truth(&q);
    read_options(&q, &in);
    trust = read_cache(&q, &in, &cache);
    q.options.cache = choice(&in, 4) ? &cache : NULL;

    size = q.options.size < MOST_BYTES ? q.options.size : MOST_BYTES;
    block = calloc(size < 4 ? 4 : size, 1);
    if (!block) {
        return 0;
    }
    memcpy(block, &q.options, size < 4 ? 4 : size < whole ? size : whole);
    tail = choice(&in, 4) == 0 ? byte(&in) : 0;
    if (size > whole) {
        block[whole + (size_t)(byte(&in) << 8 | byte(&in)) % (size - whole)] = (unsigned char)tail;
    }
    memcpy(&q.given, &(unsigned char *){block}, sizeof block);
    announce(&q);
    if (!are_good(&q.options, tail)) {
        ask_refused(&q, DISTANCE);
    } else {
        forget_beyond_size(&q.options);
        q.may_refuse |= slack_exponent(&q) > (VARIANT_FLOAT ? 100 : 1000);
        ask_both(&q, q.options.cache ? trust : TRUE_POINTS);
        if (is_good_workspace(&q.options)) {
            ask_penetration(&q, q.options.cache ? trust : TRUE_POINTS);
        } else {
            ask_refused(&q, PENETRATION);
        }
    }
    free(block);
    return 0;
}
