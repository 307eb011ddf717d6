/* SPDX-License-Identifier: MIT */
/* distance of any pair, cold and warm, swapped, in another unit and tight, against the truth. */
#include "laws.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    static const enum query other[2] = {DISTANCE, DISTANCE};
    static question q;
    input in;
    V(result) cold, r;
    int exponent = pose_question(&q, &in, bytes, count);
    if (ask_distance(&q, 0, &cold)) {
        check_value(&q, &cold);
        check_witnesses(&q, &cold);
        must_scale(&q, DISTANCE, &cold, exponent);
        if (ask_distance(&q, 1, &r)) {
            must_meet(&q, "swapped, another answer", &r, &cold);
        }
        must_meet_warm(&q, &in, ask_distance, other, &cold);
    }
    q.options.tight = 1;
    if (ask_distance(&q, 0, &r)) {
        check_tight(&q, &r);
        check_value(&q, &r);
        check_witnesses(&q, &r);
    }
    return 0;
}
