/* SPDX-License-Identifier: MIT */
/* distance of any pair, cold and warm, swapped, in another unit and tight, against the truth. */
#include "laws.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

/* The same pair, then the pair a little moved, with what the first query left behind. */
static void check_warm(question *q, input *in, const V(result) * cold)
{
    V(cache) cache;
    V(result) r;
    memset(&cache, 0, sizeof cache);
    q->options.cache = &cache;
    for (int k = 0; k < 2; k++) {
        if (ask_distance(q, 0, &r)) {
            must_meet(q, "warm and cold contradict each other", &r, cold);
        }
    }
    for (int k = 0; k < 2; k++) {
        V(pose) was = whole_of(&q->s, k)->pose;
        V(pose) *pose = &whole_of(&q->s, k)->pose;
        pose->p[choice(in, DIM)] = number(in);
        pose->m[choice(in, DIM * DIM)] = number(in);
        V(distance)(&q->s.p.a.shape, &q->s.p.b.shape, &q->options, &r);
        *pose = was;
        if (ask_distance(q, 0, &r)) {
            must_meet(q, "warm from elsewhere and cold contradict each other", &r, cold);
        }
    }
    q->options.cache = NULL;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    static question q;
    input in = input_from(bytes, count);
    V(result) cold, r;
    int exponent = small_whole(&in);
    read_question(&q, &in, bytes, count);
    seek_truth(&q);
    announce(&q);
    if (ask_distance(&q, 0, &cold)) {
        check_value(&q, &cold);
        check_witnesses(&q, &cold);
        must_scale(&q, DISTANCE, &cold, exponent);
        if (ask_distance(&q, 1, &r)) {
            must_meet(&q, "swapped, another answer", &r, &cold);
        }
        check_warm(&q, &in, &cold);
    }
    q.options.tight = 1;
    if (ask_distance(&q, 0, &r)) {
        check_tight(&q, &r);
        check_value(&q, &r);
        check_witnesses(&q, &r);
    }
    return 0;
}
