/* SPDX-License-Identifier: MIT */
/* penetration of any pair, cold and warm, swapped, in another unit, in little room and in few steps, against the truth
 * and against the other two queries. */
#include "laws.h"
#include "settle.h"

#define DEPTH_WIDTH 16 /* of known corners without radii that meet, in u * scale */
#define MOST_CORNERS 264

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

typedef struct pair_facts {
    int sharp; /* corners that the library knows, and no radius */
    int meets; /* for certain */
    quad scale;
} pair_facts;

/* Of known corners the truth is made exact. */
static pair_facts learn(question *q)
{
    static exact best;
    static int started;
    int exactly, radii = q->s.p.a.shape.radius > 0 || q->s.p.b.shape.radius > 0;
    pair_facts f = {0, 0, q->t.scale * 16 > q->span ? q->t.scale : q->span}; /* as in check_value */
    if (!started) {
        exact_start(&best);
        started = 1;
    }
    exactly = settle(&q->t, &best, &q->one.p.a, &q->one.p.b);
    f.sharp = exactly && !radii;
    f.meets = exactly && !radii ? !q->t.apart : q->t.upper <= 0;
    return f;
}

static int ask_depth(question *q, int swap, V(result) * r)
{
    if (!ask_any(q, PENETRATION, swap, r)) {
        return 0;
    }
    check_bracket(q, r, q->t.lower, q->t.upper);
    if (!swap) {
        check_normal(q, r);
        check_unit(q, r);
    }
    return 1;
}

/* ---- bodies that meet ---- */

static double width_in_u(const question *q, const V(result) * r, quad scale)
{
    return in_u(q, at_one(q, r->upper) - at_one(q, r->lower), scale);
}

/* Known corners without radii. */
static void check_sharp(const question *q, const pair_facts *f, const V(result) * r)
{
    quad x = at_one(q, r->value);
    double error = in_u(q, x > q->t.upper ? x - q->t.upper : x < q->t.lower ? q->t.lower - x : 0, q->span);
    double width = width_in_u(q, r, f->scale), off = in_u(q, q->t.lower - separation_along(q, r->normal), f->scale);
    if (!(error <= VALUE_ERROR)) {
        broken(q, "the depth is further off than it may be, in u * span", r, error);
    }
    if (!(width <= DEPTH_WIDTH)) {
        broken(q, "the bracket of the depth is wider than it may be, in u * scale", r, width);
    }
    if (!(off <= WITNESS_ERROR)) {
        broken(q, "the normal leads another way out, in u * scale", r, off);
    }
    if (r->upper > 0 && (q->t.upper < -SLOP || touches(q))) {
        broken(q, "not seen to meet", r, (double)r->upper);
    }
}

/* Each point is the body's deepest in the other, and from one to the other it is the depth, along the normal. What the
 * bracket leaves open counts twice: the facet that the points are on may be a little higher than the lowest, and face a
 * little another way than the normal. */
static void check_deepest(const question *q, const V(result) * r, quad scale, double more)
{
    quad along[2] = {0, 0};
    double off;
    for (int k = 0; k < 2; k++) {
        const real *x = k ? r->point_b : r->point_a;
        quad radius = (quad)whole_of((scene *)&q->one, k)->shape.radius;
        for (int i = 0; i < DIM; i++) {
            along[k] +=
                (quad)r->normal[i] * (shifted((quad)x[i] - (quad)taken_off(q, i), -q->exponent) - q->t.a.origin[i]);
        }
        off = in_u(q, height_of_body(q, k, r->normal, k ? -1 : 1) + radius - (k ? -along[k] : along[k]), scale);
        if (!(off <= WITNESS_ERROR + more)) {
            broken(q, k ? "point_b is not the deepest, in u * span" : "point_a is not the deepest, in u * span", r,
                   off);
        }
    }
    off = in_u(q, along[1] - along[0] - at_one(q, r->value), scale);
    if (!(fabs(off) <= WITNESS_ERROR + more)) {
        broken(q, "the points are not as deep as the value along the normal, in u * span", r, off);
    }
}

static void check_depth(const question *q, const pair_facts *f, const V(result) * r)
{
    quad scale = scale_of_points(q, r);
    double more = f->sharp ? 0 : width_in_u(q, r, scale);
    if (r->status == GJK_OK && q->tame && !(width_in_u(q, r, q->span) <= width_of(q))) {
        broken(q, "ok, but wider than rounding, in u * span", r, width_in_u(q, r, q->span));
    }
    if (f->sharp && q->tame && r->status != GJK_LIMIT) {
        check_sharp(q, f, r);
    }
    if (scale > 0) {
        check_points_in(q, r, scale, more);
    }
    if (scale > 0 && r->status != GJK_LIMIT) {
        check_deepest(q, r, scale, 2 * more);
    }
}

/* ---- bodies that are apart ---- */

/* As soon as distance sees it, its answer. */
static void check_apart(question *q, const pair_facts *f, const V(result) * r)
{
    V(result) d;
    if (ask_distance(q, 0, &d) && d.lower > 0) {
        if (d.value != r->value || d.lower != r->lower || d.upper != r->upper) {
            print_result("distance", &d);
            broken(q, "apart, but not what distance says", r, 0);
        }
        check_witnesses(q, r);
    } else if (f->sharp && q->tame && q->t.lower > SLOP) {
        broken(q, "not seen to be apart", r, (double)r->lower);
    }
}

/* ---- however it is asked ---- */

static void must_be_same(question *q, const char *law, const V(result) * x, const V(result) * y)
{
    if (memcmp(x, y, sizeof *x) != 0) {
        print_result("other", y);
        broken(q, law, x, 0);
    }
}

/* In a block of so many bytes, filled with that byte before. */
static int ask_within(question *q, size_t bytes, int fill, V(result) * r)
{
    unsigned char *room = malloc(bytes); /* of its own size, so that a step beyond it is seen */
    int answers = 0;
    if (room) {
        memset(room, fill, bytes);
        q->options.workspace = room;
        q->options.workspace_bytes = (uint32_t)bytes;
        answers = ask_depth(q, 0, r);
        q->options.workspace = NULL;
        q->options.workspace_bytes = 0;
        free(room);
    }
    return answers;
}

static void check_rooms(question *q, input *in, const V(result) * usual)
{
    for (int k = 0; k < 3; k++) {
        static const int most[3] = {8, 56, MOST_CORNERS};
        uint32_t corners = 8 + (uint32_t)choice(in, most[k]);
        size_t bytes = V(workspace_size)(corners);
        V(result) r, again;
        size_t more;
        if (!ask_within(q, bytes, byte(in), &r)) {
            continue;
        }
        must_meet(q, "another workspace, another answer", &r, usual);
        more = (size_t)choice(in, 24);
        if (ask_within(q, bytes + more, byte(in), &again)) {
            must_be_same(q, "what was in the workspace, or a few bytes more, made a difference", &again, &r);
        }
    }
}

static void check_few_steps(question *q, input *in, const V(result) * usual)
{
    V(result) r;
    q->options.max_steps = 1 + (uint32_t)choice(in, 32);
    if (ask_depth(q, 0, &r)) {
        must_meet(q, "fewer steps, another answer", &r, usual);
    }
    q->options.max_steps = 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    static const enum query other[2] = {PENETRATION, INTERSECT};
    static question q;
    input in;
    V(result) cold, r;
    int exponent = pose_question(&q, &in, bytes, count);
    pair_facts f = learn(&q);
    if (!ask_depth(&q, 0, &cold)) {
        return 0;
    }
    if (f.meets) {
        check_depth(&q, &f, &cold);
    } else if (q.t.lower > 0) {
        check_apart(&q, &f, &cold);
    }
    must_scale(&q, PENETRATION, &cold, exponent);
    if (ask_depth(&q, 1, &r)) {
        must_meet(&q, "swapped, another answer", &r, &cold);
    }
    if (ask_distance(&q, 0, &r)) {
        must_be_consistent(&q, &r, &cold);
    }
    if (ask_intersect(&q, 0, &r)) {
        must_meet(&q, "penetration and intersect contradict each other", &r, &cold);
    }
    check_rooms(&q, &in, &cold);
    check_few_steps(&q, &in, &cold);
    must_meet_warm(&q, &in, ask_depth, other, &cold);
    q.options.tight = 1;
    if (ask_depth(&q, 0, &r)) {
        must_meet(&q, "tight, another answer", &r, &cold);
    }
    q.options.tight = 0;
    return 0;
}
