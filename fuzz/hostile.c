/* SPDX-License-Identifier: MIT */
/* Callbacks that are no supports: not convex, noisy, another answer at each call, slow to agree, not finite, denormal,
 * huge, of a wrong reach or none. Whatever they say: no crash, no hang, and an answer that is well formed, or
 * GJK_BAD_SUPPORT with the result untouched. What they are asked is always a direction. */
#include "laws.h"

#define MOST_MISDEEDS 16

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

typedef struct hostile {
    V(shape) honest;
    input in; /* all bytes once more, for what wants numbers */
    uint8_t misdeed[MOST_MISDEEDS];
    int count;  /* of misdeeds, taken in turn; 0: honest */
    int steady; /* the first one always */
    int calls;
    real last[DIM]; /* the answer before */
    question *q;
} hostile;

static void check_direction(const hostile *h, const real *dir)
{
    double most = 0;
    for (int i = 0; i < DIM; i++) {
        most = fmax(most, fabs((double)dir[i]));
    }
    if (!finite(dir, DIM) || !(most * most > (double)REAL_MIN) || !(most * most < (double)REAL_MAX / 4)) {
        broken(h->q, "a support was asked along no good direction", NULL, most);
    }
}

static void away_from(const real *dir, real *back)
{
    for (int i = 0; i < DIM; i++) {
        back[i] = -dir[i];
    }
}

static real misbehave(hostile *h, int what, const real *dir, real *point)
{
    real back[DIM], reach = h->honest.support(h->honest.data, dir, point);
    int axis = h->calls % DIM;
    real some = number(&h->in);
    switch (what % 20) {
    case 0: /* honest */
        return reach;
    case 1: /* noise, from a rounding to all of it */
    case 2:
        for (int i = 0; i < DIM; i++) {
            point[i] = rounded((double)point[i] + (double)reach * ldexp(fraction(&h->in), -(what / 20) * 5));
        }
        return reach;
    case 3: /* on the other side, every other time */
        if (h->calls % 2) {
            away_from(point, point);
        }
        return reach;
    case 4: /* what it said before */
        memcpy(point, h->last, sizeof h->last);
        return reach;
    case 5: /* the nearest, not the farthest */
        away_from(dir, back);
        return h->honest.support(h->honest.data, back, point);
    case 6: /* slow to agree: each time a little farther */
        for (int i = 0; i < DIM; i++) {
            point[i] = rounded((double)point[i] * (1 - ldexp(1, -1 - h->calls / (1 + what / 20))));
        }
        return reach;
    case 7: /* by a few last places */
        point[axis] = nudged(point[axis], h->calls % 17 - 8);
        return reach;
    case 8:
        point[axis] = (real)(h->calls % 2 ? NAN : INFINITY);
        return reach;
    case 9:
        return (real)(h->calls % 3 == 0 ? NAN : h->calls % 3 == 1 ? INFINITY : -1);
    case 10: /* of another reach each time */
        return some < 0 ? -some : some;
    case 11:
        return 0;
    case 12:
        return rounded((double)reach * ldexp(1, what / 20 - 6));
    case 13:
        return REAL_MAX / 32;
    case 14: /* nothing written */
        for (int i = 0; i < DIM; i++) {
            point[i] = h->calls % 2 ? point[i] : 0;
        }
        return reach;
    case 15: /* huge */
        point[axis] = rounded(ldexp((double)REAL_MAX, -what / 20));
        return REAL_MAX;
    case 16: /* denormal */
        for (int i = 0; i < DIM; i++) {
            point[i] = (real)(small_whole(&h->in) * (double)REAL_MIN * (double)REAL_EPSILON);
        }
        return what / 20 % 2 ? reach : 0;
    case 17: /* a hollow: what lies far along an axis is left out */
        if (fabs((double)dir[axis]) > 0.7 * fabs((double)dir[(axis + 1) % DIM])) {
            memset(point, 0, sizeof h->last);
        }
        return reach;
    default: /* anything */
        point[axis] = some;
        return reach;
    }
}

static real hostile_support(const void *data, const real *dir, real *point)
{
    hostile *h;
    real reach;
    memcpy(&h, &data, sizeof h);
    check_direction(h, dir);
    reach = misbehave(h, h->count ? h->misdeed[h->steady ? 0 : h->calls % h->count] : 0, dir, point);
    h->calls++;
    memcpy(h->last, point, sizeof h->last);
    return reach;
}

/* In the place of the shape, its honest self behind it. */
static void turn_hostile(question *q, input *in, V(shape) * shape, hostile *h)
{
    int op = byte(in);
    memset(h, 0, sizeof *h);
    h->q = q;
    h->honest = *shape;
    h->steady = op & 1;
    h->count = op >> 1 & 7 ? 1 + (op >> 4) : 0;
    for (int i = 0; i < h->count; i++) {
        h->misdeed[i] = (uint8_t)byte(in);
    }
    shape->support = hostile_support;
    shape->data = h;
}

/* For the message: what the callbacks do, by the cases of misbehave. */
static void note_misdeeds(question *q, const hostile *h)
{
    size_t room = sizeof q->note, at = 0;
    for (int k = 0; k < 2; k++) {
        at += (size_t)snprintf(q->note + at, room - at, "%s misdeeds of %s%s:", k ? ";" : "", k ? "b" : "a",
                               h[k].steady ? ", the first alone" : "");
        for (int i = 0; i < h[k].count; i++) {
            at += (size_t)snprintf(q->note + at, room - at, " %d", h[k].misdeed[i]);
        }
    }
}

/* Each query meets the same callbacks in the same state. */
static void start_over(hostile *h, const question *q)
{
    h->in = input_from(q->bytes, q->count);
    h->calls = 0;
}

static void ask(question *q, hostile *h, enum query asked, int counted)
{
    static const char *const names[QUERIES] = {"distance of hostile supports", "intersect of hostile supports",
                                               "penetration of hostile supports"};
    V(result) r, before;
    memset(&before, 0x5a, sizeof before);
    r = before;
    q->query = names[asked];
    start_over(&h[0], q);
    start_over(&h[1], q);
    int status = query_of[asked](&q->s.p.a.shape, &q->s.p.b.shape, &q->options, &r);
    if (status < 0) {
        if (status != GJK_BAD_SUPPORT) {
            broken(q, "not called a bad support", NULL, status);
        }
        if (memcmp(&r, &before, sizeof r) != 0) {
            broken(q, "refused, but the result was touched", &r, status);
        }
        return;
    }
    check_form(q, asked, &r, status);
    if (counted && r.supports != h[0].calls + h[1].calls) {
        broken(q, "support calls were miscounted", &r, h[0].calls + h[1].calls);
    }
    if (asked == DISTANCE && !(r.lower >= 0)) {
        broken(q, "a distance below 0", &r, 0);
    }
    if (asked == INTERSECT && r.value != (r.lower > 0 ? r.lower : r.upper < 0 ? r.upper : 0)) {
        broken(q, "the value does not state the verdict", &r, 0);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    static question q;
    hostile h[2];
    V(cache) cache;
    input in = input_from(bytes, count);
    int flags = byte(&in), counted = 1;
    read_question(&q, &in, bytes, count);
    memset(&cache, 0, sizeof cache);
    memset(&q.t, 0, sizeof q.t); /* there is none */
    q.span = 1;
    q.may_refuse = 1;
    for (int k = 0; k < 2; k++) {
        body *b = whole_of(&q.s, k);
        int couple = b->kind == SUM || b->kind == HULL;
        turn_hostile(&q, &in, couple ? &b->set.couple.a : &b->shape, &h[k]);
        counted &= !couple;
    }
    note_misdeeds(&q, h);
    q.options.max_steps = flags & 1 ? (uint32_t)(flags >> 4) + 1 : 0;
    q.options.cache = flags & 2 ? &cache : NULL;
    q.options.slack = flags & 4 ? size_number(&in) : 0;
    q.options.abs_tol = flags & 8 ? size_number(&in) : 0;
    q.options.cutoff = flags & 16 ? size_number(&in) : 0;
    q.options.tight = (uint32_t)(flags >> 5 & 1);
    announce(&q);
    for (int k = 0; k < 2 * QUERIES; k++) {
        ask(&q, h, (enum query)(k % QUERIES), counted);
    }
    return 0;
}
