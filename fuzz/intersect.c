/* SPDX-License-Identifier: MIT */
/* intersect of any pair, cold and warm, swapped, in another unit and tight, against the truth and against distance. */
#include "laws.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    static question q;
    input in;
    V(result) cold, r, d;
    V(cache) cache;
    int exponent = pose_question(&q, &in, bytes, count);
    if (ask_intersect(&q, 0, &cold)) {
        must_scale(&q, INTERSECT, &cold, exponent);
        check_witnesses(&q, &cold);
        if (ask_intersect(&q, 1, &r)) {
            must_meet(&q, "swapped, another answer", &r, &cold);
        }
        memset(&cache, 0, sizeof cache);
        q.options.cache = &cache;
        for (int k = 0; k < 3; k++) {
            if (ask_intersect(&q, 0, &r)) {
                must_meet(&q, "warm and cold contradict each other", &r, &cold);
            }
            if (k == 0 && ask_distance(&q, 0, &d)) { /* on the same cache */
                must_be_consistent(&q, &d, &r);
                must_be_consistent(&q, &d, &cold);
            }
        }
        q.options.cache = NULL;
    }
    q.options.tight = 1;
    if (ask_intersect(&q, 0, &r)) {
        check_witnesses(&q, &r);
    }
    return 0;
}
