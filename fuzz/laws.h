/* SPDX-License-Identifier: MIT */
/* What every answer owes, and the truth that it is held against. The first law that is broken is printed, with the
 * case and with the bytes it came from, and ends the program. */
#ifndef LAWS_H
#define LAWS_H

#include "scene.h"
#include "truth.h"

/* In u * span, as in tests/brackets.c. */
#define VALUE_ERROR 4
#define WITNESS_ERROR 16
#define WIDTH 100
#define SHALLOW 300 /* of known corners: a deeper overlap is seen */
/* Of others: 440 doubt, or needles thinner than 1e-5 of their length around a single point (docs/design.md). There the
 * walk may also end with a bracket wider than rounding, and says GJK_FLOOR. */
#define SHALLOW_UNKNOWN fmax(8800, 1e-5 / U)
#define EXACT_DIGITS 1200  /* more than that between the ends of the numbers, and tight is good to SLOP */
#define SLOP ((quad)1e-28) /* of the truth itself: it is sought for a pair of size 1 */

enum query { DISTANCE, INTERSECT, PENETRATION, QUERIES };
typedef int query_fn(const V(shape) *, const V(shape) *, const V(options) *, V(result) *);
static query_fn *const query_of[QUERIES] = {V(distance), V(intersect), V(penetration)};

#define NOTHING (-100000) /* the exponent of 0 */

/* The truth is sought for the pair brought to size 1 by powers of two, from where the numbers are; whatever is lost to
 * underflow by that is far below SLOP. */
typedef struct question {
    scene s, one;
    int exponent; /* sizes of s are those of one times 2^exponent */
    truth t;
    quad span;      /* of one: what rounding scales with */
    int tame;       /* no size so large or small that products under- or overflow */
    int may_refuse; /* a size near the end of the format */
    int sharp;      /* both are polytopes, radii apart */
    int known;      /* and their corners known to the library */
    V(options) options;
    const V(options) * given; /* what the library is handed: the same, or the same in another size */
    const char *query;
    char note[400]; /* what else the case is made of */
    const uint8_t *bytes;
    size_t count;
} question;

/* ---- when a law is broken ---- */

static inline void print_result(const char *name, const V(result) * r)
{
    fprintf(stderr, "  %s: status %d (%s) value %.17g lower %.17g upper %.17g steps %d supports %d\n    point_a ", name,
            r->status, gjk_status_name(r->status), (double)r->value, (double)r->lower, (double)r->upper, r->steps,
            r->supports);
    print_numbers(stderr, r->point_a, DIM);
    fprintf(stderr, " point_b ");
    print_numbers(stderr, r->point_b, DIM);
    fprintf(stderr, " normal ");
    print_numbers(stderr, r->normal, DIM);
    fprintf(stderr, "\n");
}

static inline void print_question(const question *q)
{
    const V(options) *o = &q->options;
    fprintf(stderr, "  bytes ");
    for (size_t i = 0; i < q->count; i++) {
        fprintf(stderr, "%02x", q->bytes[i]);
    }
    fprintf(stderr, "\n  ");
    print_scene(stderr, q->query, &q->s);
    fprintf(stderr, "  max_steps %u abs_tol %.17g rel_tol %.17g cutoff %.17g slack %.17g cache %d tight %u\n",
            o->max_steps, (double)o->abs_tol, (double)o->rel_tol, (double)o->cutoff, (double)o->slack, o->cache != NULL,
            o->tight);
    if (q->note[0]) {
        fprintf(stderr, "  %s\n", q->note);
        return;
    }
    fprintf(stderr, "  truth (%.17g + %.3g) * 2^%d, scale %.3g, span %.3g of that%s%s\n", (double)q->t.lower,
            (double)(q->t.upper - q->t.lower), q->exponent, (double)q->t.scale, (double)q->span,
            q->tame ? "" : ", extreme sizes", q->t.certified ? "" : ", uncertified");
}

static inline void broken(const question *q, const char *law, const V(result) * r, double by)
{
    fprintf(stderr, "%s %s: %s (%.3g)\n", VARIANT, q->query, law, by);
    if (r) {
        print_result("result", r);
    }
    print_question(q);
    fflush(stderr);
    abort();
}

/* ---- the pair at size 1 ---- */

static inline int exponent_of(double x)
{
    int e;
    frexp(x, &e);
    return x == 0 ? NOTHING : e;
}

static inline int highest(const real *x, int count)
{
    int e = NOTHING;
    for (int i = 0; i < count; i++) {
        e = exponent_of((double)x[i]) > e ? exponent_of((double)x[i]) : e;
    }
    return e;
}

static inline int larger_of(int x, int y) { return x > y ? x : y; }

/* The least e with all coordinates of the set below 2^e, but for a small factor. */
static inline int set_exponent(const body *b)
{
    int e = NOTHING;
    if (is_couple(b)) {
        for (int k = 0; k < 2; k++) {
            const body *p = b->part[k];
            e = larger_of(e, larger_of(set_exponent(p) + highest(p->pose.m, DIM * DIM), highest(p->pose.p, DIM)));
            e = larger_of(e, highest(&p->shape.radius, 1));
        }
        return larger_of(e, NOTHING);
    }
    e = larger_of(highest(b->v[0], b->count * DIM), highest(b->half, DIM));
    return larger_of(e, larger_of(highest(&b->radius, 1), highest(&b->half_length, 1)));
}

/* Both positions' common part taken off: a move of the frame. Returns the exponent of the way from one to the other. */
static inline int near_origin(scene *s)
{
    int e = NOTHING;
    for (int i = 0; i < DIM; i++) {
        real *a = &s->p.a.pose.p[i], *b = &s->p.b.pose.p[i];
        if (memcmp(a, b, sizeof *a) == 0) {
            *a = *b = 0;
        } else {
            double half = (double)*b / 2 - (double)*a / 2;
            e = larger_of(e, fabs(half) < 1 ? exponent_of((double)*b - (double)*a) : exponent_of(half) + 1);
        }
    }
    return e;
}

/* The posed body by 2^-by, its set by so much that its coordinates come near to 1. */
static inline void shrink(body *b, int by)
{
    int set = set_exponent(b);
    if (set <= NOTHING / 2) {
        memset(b->pose.m, 0, sizeof b->pose.m);
        set = 0;
    }
    if (!is_couple(b)) { /* whose sets are their parts */
        multiply(b->v[0], MAX_POINTS * DIM, -set);
        multiply(b->half, DIM, -set);
        multiply(&b->radius, 1, -set);
        multiply(&b->half_length, 1, -set);
    }
    multiply(b->pose.m, DIM * DIM, set - by);
    multiply(b->pose.p, DIM, -by);
    multiply(&b->shape.radius, 1, -by);
}

/* A couple before its parts: these then come near to 1 together. */
static inline void shrink_whole(body *b, body *part, int by)
{
    int set = set_exponent(b);
    shrink(b, by);
    for (int i = 0; i < 2 && is_couple(b); i++) {
        shrink(&part[i], set <= NOTHING / 2 ? 0 : set);
    }
}

/* Whether a body's sizes are plain, beside those of the pair. */
static inline void judge_sizes(question *q, const body *b, int whole)
{
    const int plain = VARIANT_FLOAT ? 26 : 290, most = (VARIANT_FLOAT ? 128 : 1024) - 8;
    int sizes[5] = {set_exponent(b), highest(b->pose.m, DIM * DIM), 0, highest(b->pose.p, DIM), whole};
    sizes[2] = sizes[1] > NOTHING ? sizes[1] - whole : 0;
    for (int i = 0; i < 5; i++) {
        q->tame &= sizes[i] <= NOTHING / 2 || i == 3 || abs(sizes[i]) <= plain;
        q->may_refuse |= i != 2 && sizes[i] >= most;
    }
    q->may_refuse |= sizes[0] + sizes[1] >= most;
}

static inline void read_question(question *q, input *in, const uint8_t *bytes, size_t count)
{
    int whole, a, b;
    q->query = "";
    q->note[0] = 0;
    q->bytes = bytes;
    q->count = count;
    q->options = default_options();
    q->given = &q->options;
    read_scene(in, &q->s);
    q->one = q->s;
    memset(q->one.silent, 0, sizeof q->one.silent);
    memset(q->one.bare, 0, sizeof q->one.bare);
    bind_scene(&q->one);
    a = larger_of(set_exponent(&q->one.p.a) + highest(q->one.p.a.pose.m, DIM * DIM),
                  highest(&q->s.p.a.shape.radius, 1));
    b = larger_of(set_exponent(&q->one.p.b) + highest(q->one.p.b.pose.m, DIM * DIM),
                  highest(&q->s.p.b.shape.radius, 1));
    whole = larger_of(larger_of(a, b), near_origin(&q->one));
    q->tame = whole > NOTHING / 2; /* a pair of no size is all underflow */
    whole = q->tame ? whole : 0;
    q->exponent = whole;
    q->may_refuse = 0;
    for (int k = 0; k < 2; k++) {
        body *w = whole_of(&q->one, k), *part = &q->one.p.part[2 * k];
        judge_sizes(q, w, whole);
        for (int i = 0; i < 2 && is_couple(w); i++) {
            judge_sizes(q, &part[i], whole);
        }
    }
    q->may_refuse |= !q->tame && (q->s.silent[0] || q->s.silent[1]);
    for (int k = 0; k < 2; k++) {
        shrink_whole(whole_of(&q->one, k), &q->one.p.part[2 * k], whole);
    }
    bind_scene(&q->one);
}

static inline void seek_truth(question *q)
{
    find_truth(&q->t, &q->one.p.a, &q->one.p.b, 1);
    q->sharp = q->t.a.count && q->t.b.count;
    q->known = has_corners(&q->s.p.a) && has_corners(&q->s.p.b);
    q->span = (quad)span_of_pair(&q->one.p.a, &q->one.p.b);
}

/* Before it is tried: for who wants to see what some bytes stand for. */
static inline void announce(const question *q)
{
    if (getenv("GJK_FUZZ_PRINT")) {
        print_question(q);
    }
}

/* A pair from the bytes, and its truth. Returns the exponent of another size to ask about it in. */
static inline int pose_question(question *q, input *in, const uint8_t *bytes, size_t count)
{
    int exponent;
    *in = input_from(bytes, count);
    exponent = small_whole(in);
    read_question(q, in, bytes, count);
    seek_truth(q);
    announce(q);
    return exponent;
}

/* x * 2^by */
static inline quad shifted(quad x, int by)
{
    for (; by > 1000; by -= 1000) {
        x *= (quad)ldexp(1, 1000);
    }
    for (; by < -1000; by += 1000) {
        x *= (quad)ldexp(1, -1000);
    }
    return x * (quad)ldexp(1, by);
}

/* A length of the pair as at size 1. */
static inline quad at_one(const question *q, real x) { return shifted((quad)x, -q->exponent); }

/* A length at size 1 in units of roundoff, of scale and of the least number of the format. */
static inline double in_u(const question *q, quad x, quad scale)
{
    return (double)(x / (scale * (quad)U + shifted((quad)REAL_MIN * (quad)REAL_EPSILON, -q->exponent)));
}

static inline int finite(const real *x, int count)
{
    for (int i = 0; i < count; i++) {
        if (!(x[i] - x[i] == 0)) {
            return 0;
        }
    }
    return 1;
}

/* ---- the laws for one answer ---- */

/* What was taken off that coordinate of both positions. */
static inline real taken_off(const question *q, int i)
{
    const real *a = &q->s.p.a.pose.p[i], *b = &q->s.p.b.pose.p[i];
    return memcmp(a, b, sizeof *a) == 0 ? *a : 0;
}

/* How far a point of the frame is off the body, for certain. */
static inline double stands_off(const question *q, int k, const real *point)
{
    static truth off;
    static body dot;
    start_body(&dot, POINTS);
    dot.count = 1;
    for (int i = 0; i < DIM; i++) {
        dot.v[0][i] = point[i];
        dot.pose.p[i] = -taken_off(q, i);
    }
    multiply(dot.v[0], DIM, -q->exponent);
    multiply(dot.pose.p, DIM, -q->exponent);
    bind(&dot);
    find_truth(&off, k ? &q->one.p.b : &q->one.p.a, &dot, 0);
    return (double)off.lower;
}

/* The rounding of a posed set is charged by the largest sum of a row or column of its map, the span by the root of all
 * squares: how much larger the first may be. */
static inline double sums_over_span(const body *b)
{
    double most = 0, squares = 0;
    for (int i = 0; i < DIM; i++) {
        double row = 0, column = 0;
        for (int j = 0; j < DIM; j++) {
            row += fabs((double)b->pose.m[DIM * i + j]);
            column += fabs((double)b->pose.m[DIM * j + i]);
            squares += (double)b->pose.m[DIM * i + j] * (double)b->pose.m[DIM * i + j];
        }
        most = fmax(most, fmax(row, column));
    }
    return most > 0 ? fmax(1, most / sqrt(squares)) : 1;
}

/* How wide rounding may make a bracket. The reach of a cloud that does not know its own is found along the axes: up to
 * sqrt(DIM) times too large, and the rounding counted with it. */
static inline double width_of(const question *q)
{
    double wide = WIDTH * fmax(sums_over_span(&q->one.p.a), sums_over_span(&q->one.p.b));
    return q->s.silent[0] || q->s.silent[1] ? wide * sqrt(DIM) : wide;
}

/* What points are rounded by: the sizes, and how far out they stand. 0: of what is so far out nothing is asked. */
static inline quad scale_of_points(const question *q, const V(result) * r)
{
    int world = larger_of(highest(r->point_a, DIM), highest(r->point_b, DIM));
    if (!q->tame || world > q->exponent + 60) {
        return 0;
    }
    return q->span + (world > NOTHING ? shifted(1, world - q->exponent) : 0);
}

/* more: how far off they may be beyond their rounding, in u * scale. */
static inline void check_points_in(const question *q, const V(result) * r, quad scale, double more)
{
    for (int k = 0; k < 2; k++) {
        double off = in_u(q, (quad)stands_off(q, k, k ? r->point_b : r->point_a), scale);
        if (!(off - more <= WITNESS_ERROR)) {
            broken(q, k ? "point_b is outside b, in u * span" : "point_a is outside a, in u * span", r, off);
        }
    }
}

static inline void check_unit(const question *q, const V(result) * r)
{
    quad n = 0;
    double off;
    for (int i = 0; i < DIM; i++) {
        n += (quad)r->normal[i] * (quad)r->normal[i];
    }
    off = (double)((quad_sqrt(n) - 1) / (quad)U);
    if (!(fabs(off) <= 4)) {
        broken(q, "the normal is not unit, in u", r, off);
    }
}

static inline void check_witnesses(const question *q, const V(result) * r)
{
    quad scale = scale_of_points(q, r), way = 0;
    double off;
    if (!(scale > 0)) {
        return;
    }
    /* of an overlap the point of intersect is no better than its bracket */
    check_points_in(q, r, scale, r->upper < 0 ? in_u(q, at_one(q, r->upper) - at_one(q, r->lower), scale) : 0);
    for (int i = 0; i < DIM; i++) {
        quad gap = at_one(q, r->point_b[i]) - at_one(q, r->point_a[i]);
        way += gap * gap;
    }
    off = in_u(q, quad_sqrt(way) - positive(at_one(q, r->upper)), scale);
    if (!(off <= WITNESS_ERROR && off >= -width_of(q))) {
        broken(q, "the points do not realise upper, in u * span", r, off);
    }
    check_unit(q, r);
}

/* Of a body, without its radius, the farthest along sign n, relative to the truth's origin. */
static inline quad height_of_body(const question *q, int k, const real *normal, int sign)
{
    quad n[DIM], x[DIM], along = 0, l = 0;
    for (int i = 0; i < DIM; i++) {
        n[i] = (quad)normal[i] * (quad)sign;
        l += n[i] * n[i];
    }
    farthest_of_body(k ? &q->one.p.b : &q->one.p.a, q->t.a.origin, 0, n, x);
    for (int i = 0; i < DIM; i++) {
        along += n[i] * x[i];
    }
    return along / quad_sqrt(l);
}

/* Whatever the normal, a lower bound of the truth. */
static inline quad separation_along(const question *q, const real *normal)
{
    return -height_of_body(q, 0, normal, 1) - height_of_body(q, 1, normal, -1) - (quad)q->one.p.a.shape.radius -
           (quad)q->one.p.b.shape.radius;
}

static inline void check_normal(const question *q, const V(result) * r)
{
    double off = in_u(q, at_one(q, r->lower) - separation_along(q, r->normal), q->span);
    if (q->tame && !(off <= WITNESS_ERROR)) {
        broken(q, "the normal does not realise lower, in u * span", r, off);
    }
}

/* What all answers share, true or false: numbers, order, counts. */
static inline void check_form(const question *q, enum query asked, const V(result) * r, int status)
{
    const V(options) *o = &q->options;
    uint32_t most = o->max_steps ? o->max_steps : 256;
    if (status != r->status || r->reserved != 0) {
        broken(q, "returned another status than written", r, status);
    }
    int endless = o->slack > 0 && q->may_refuse; /* a bound may then be beyond the format */
    if (!finite(&r->value, 1) || !finite(r->point_a, DIM) || !finite(r->point_b, DIM) || !finite(r->normal, DIM) ||
        (!endless && !(finite(&r->lower, 1) && finite(&r->upper, 1)))) {
        broken(q, "a number is not finite", r, 0);
    }
    if (!(r->lower <= r->value && r->value <= r->upper)) {
        broken(q, "the value is outside its bracket", r, 0);
    }
    if (status > GJK_LIMIT) {
        broken(q, "a status that does not exist", r, status);
    }
    if (r->steps < 0 || (uint32_t)r->steps > most || r->supports < 0 ||
        (double)r->supports > 4.0 * most + 64) { /* a warm start given up, and the reaches */
        broken(q, "took more steps than allowed", r, r->steps);
    }
    if (status == GJK_LIMIT && asked != PENETRATION && (uint32_t)r->steps != most) { /* its limit may be the room */
        broken(q, "says limit before it", r, r->steps);
    }
}

static inline void check_bracket(const question *q, const V(result) * r, quad low, quad high)
{
    if (!(at_one(q, r->lower) <= high + SLOP)) {
        broken(q, "lower is above the truth, in u * scale", r, in_u(q, at_one(q, r->lower) - high, q->t.scale));
    }
    if (!(at_one(q, r->upper) >= low - SLOP)) {
        broken(q, "upper is below the truth, in u * scale", r, in_u(q, low - at_one(q, r->upper), q->t.scale));
    }
}

/* What the statuses say. */
static inline void check_distance_status(const question *q, const V(result) * r)
{
    const V(options) *o = &q->options;
    double asked = ((double)o->abs_tol + (double)o->rel_tol * (double)r->upper) * (1 + 8 * U) +
                   (double)REAL_MIN * (double)REAL_EPSILON;
    double width = (double)r->upper - (double)r->lower,
           wide = in_u(q, at_one(q, r->upper) - at_one(q, r->lower), q->span);
    if (r->status == GJK_DECIDED && !(o->cutoff > 0 && r->lower > o->cutoff)) {
        broken(q, "decided, but not above the cutoff", r, (double)r->lower);
    }
    if (q->tame && o->slack == 0 && r->status == GJK_OK && !(width <= asked || wide <= width_of(q))) {
        broken(q, "ok, but wider than asked, in u * span", r, wide);
    }
    if (q->tame && o->slack == 0 && r->status == GJK_FLOOR && !(wide <= (q->known ? width_of(q) : SHALLOW_UNKNOWN))) {
        broken(q, "floor, but wider than rounding, in u * span", r, wide);
    }
    if (r->status == GJK_FLOOR && o->abs_tol > 0 && width <= (double)o->abs_tol * (1 - 8 * U)) {
        broken(q, "floor, yet as tight as asked", r, width);
    }
}

/* How far the value is off the truth, at size 1. */
static inline quad error_of(const question *q, const V(result) * r)
{
    quad low = positive(q->t.lower), high = positive(q->t.upper), x = at_one(q, r->value);
    return x > high ? x - high : x < low ? low - x : 0;
}

static inline void check_value(const question *q, const V(result) * r)
{
    /* where the maps' own products cancel, little of what rounds is left to see in the scale */
    quad scale = q->t.scale * 16 > q->span ? q->t.scale : q->span;
    double error = in_u(q, error_of(q, r), scale);
    if (q->sharp && q->tame && q->t.certified && !(error <= VALUE_ERROR)) {
        broken(q, "the value is further off than it may be, in u * scale", r, error);
    }
    if (r->status != GJK_OK && r->status != GJK_FLOOR && q->sharp) {
        broken(q, "without a limit or a cutoff, yet stopped early", r, r->status);
    }
}

/* The exponent of the lowest digit. */
static inline int lowest(const real *x, int count)
{
    int least = -NOTHING, e;
    for (int i = 0; i < count; i++) {
        double digits = frexp((double)x[i], &e);
        for (; digits - floor(digits) != 0; e--) {
            digits *= 2;
        }
        least = x[i] != 0 && e < least ? e : least;
    }
    return least;
}

static inline int lower_of(int x, int y) { return x < y ? x : y; }

/* From the lowest digit of a posed coordinate, or of a radius, to the size of the pair. */
static inline int digits_between(const question *q)
{
    int low = -NOTHING;
    for (int k = 0; k < 2; k++) {
        const body *b = k ? &q->s.p.b : &q->s.p.a;
        int set = lower_of(lowest(b->v[0], b->count * DIM), lowest(b->half, DIM));
        low = lower_of(low, lower_of(set + lowest(b->pose.m, DIM * DIM), lowest(b->pose.p, DIM)));
        low = lower_of(low, lowest(&b->shape.radius, 1));
    }
    return q->exponent - low;
}

/* Whether bodies that seem to touch do so: with so few digits no distance but 0 is as small as SLOP. */
static inline int touches(const question *q)
{
    int round = q->s.p.a.shape.radius > 0 || q->s.p.b.shape.radius > 0;
    return q->t.lower <= SLOP && digits_between(q) <= (round ? 12 : 24);
}

/* Points, box, segment, triangle, origin: finished exactly. The truth is good to SLOP, and so is the answer where
 * numbers are unlike. */
static inline void check_tight(const question *q, const V(result) * r)
{
    const quad off = digits_between(q) > EXACT_DIGITS ? SLOP : 0;
    quad unit = shifted((quad)1, exponent_of((double)r->upper) - (VARIANT_FLOAT ? 24 : 53) - q->exponent);
    quad least = shifted((quad)REAL_MIN * (quad)REAL_EPSILON, -q->exponent);
    unit = unit > least ? unit : least;
    if (!has_corners(&q->s.p.a) || !has_corners(&q->s.p.b) || !q->t.certified) {
        return;
    }
    if (!(error_of(q, r) <= unit + SLOP)) {
        broken(q, "tight, yet off by more than 1 ulp", r, (double)(error_of(q, r) / unit));
    }
    if (!(at_one(q, r->upper) - at_one(q, r->lower) <= 2 * unit + off)) {
        broken(q, "tight, yet wider than 2 ulp", r, (double)((at_one(q, r->upper) - at_one(q, r->lower)) / unit));
    }
    if ((q->t.upper < -SLOP || touches(q)) && !(at_one(q, r->upper) <= off)) {
        broken(q, "tight, yet the contact is not seen", r, (double)r->upper);
    }
}

/* 0: refused, which was fair. */
static inline int answered(const question *q, const V(result) * r, int status)
{
    V(result) before;
    if (status >= 0) {
        return 1;
    }
    memset(&before, 0x5a, sizeof before);
    if (memcmp(&before, r, sizeof before) != 0) {
        broken(q, "refused, but the result was touched", NULL, status);
    }
    if (status != GJK_BAD_SUPPORT || !q->may_refuse) {
        broken(q, "an error for a good pair", NULL, status);
    }
    return 0;
}

/* 0: refused, which was fair. */
static inline int ask_any(question *q, enum query asked, int swap, V(result) * r)
{
    static const char *const query[QUERIES][2] = {{"distance", "distance, swapped"},
                                                  {"intersect", "intersect, swapped"},
                                                  {"penetration", "penetration, swapped"}};
    const V(shape) *a = &q->s.p.a.shape, *b = &q->s.p.b.shape;
    int status;
    q->query = query[asked][swap];
    memset(r, 0x5a, sizeof *r);
    status = query_of[asked](swap ? b : a, swap ? a : b, q->given, r);
    if (!answered(q, r, status)) {
        return 0;
    }
    check_form(q, asked, r, status);
    return 1;
}

static inline int ask_distance(question *q, int swap, V(result) * r)
{
    if (!ask_any(q, DISTANCE, swap, r)) {
        return 0;
    }
    if (!(r->lower >= 0)) {
        broken(q, "a distance below 0", r, 0);
    }
    check_bracket(q, r, positive(q->t.lower), positive(q->t.upper));
    check_distance_status(q, r);
    if (!swap) {
        if (r->lower > 0) {
            check_normal(q, r);
        }
    }
    return 1;
}

static inline int ask_intersect(question *q, int swap, V(result) * r)
{
    quad nearest = q->t.lower > 0 ? q->t.lower : q->t.upper < 0 ? -q->t.upper : 0;
    double off = in_u(q, nearest, q->span), shallow = q->known ? SHALLOW : SHALLOW_UNKNOWN;
    if (!ask_any(q, INTERSECT, swap, r)) {
        return 0;
    }
    check_bracket(q, r, q->t.lower, q->t.upper);
    if (r->value != (r->lower > 0 ? r->lower : r->upper < 0 ? r->upper : 0)) {
        broken(q, "the value does not state the verdict", r, 0);
    }
    if ((r->status == GJK_OK || r->status == GJK_DECIDED) && !(r->lower > 0 || r->upper < 0 || r->upper == 0)) {
        broken(q, "decided, but no sign is proven", r, 0);
    }
    if ((r->status == GJK_FLOOR || r->status == GJK_LIMIT) && (r->lower > 0 || r->upper < 0)) {
        broken(q, "undecided, but a sign is proven", r, 0);
    }
    if (r->status == GJK_FLOOR && q->tame && q->options.slack == 0 &&
        !(off <= (q->t.lower > 0 ? width_of(q) : shallow))) {
        broken(q, "called touching, but is further off, in u * span", r, off);
    }
    if (!swap) {
        check_normal(q, r);
    }
    return 1;
}

/* ---- laws between answers ---- */

static inline void must_meet(const question *q, const char *law, const V(result) * x, const V(result) * y)
{
    if (!(x->lower <= y->upper && y->lower <= x->upper)) {
        print_result("other", y);
        broken(q, law, x, 0);
    }
}

/* Asked the same twice, from the cache of the first; then with what was left behind by other queries, of the pair a
 * little moved: the answers meet the cold one. */
static inline void must_meet_warm(question *q, input *in, int (*ask_it)(question *, int, V(result) *),
                                  const enum query other[2], const V(result) * cold)
{
    V(cache) cache;
    V(result) r;
    memset(&cache, 0, sizeof cache);
    q->options.cache = &cache;
    for (int k = 0; k < 4; k++) {
        V(pose) *pose = &whole_of(&q->s, k & 1)->pose, was = *pose;
        if (k > 1) {
            real p = number(in), m;
            pose->p[choice(in, DIM)] = p;
            m = number(in);
            pose->m[choice(in, DIM * DIM)] = m;
            query_of[other[k - 2]](&q->s.p.a.shape, &q->s.p.b.shape, &q->options, &r);
            *pose = was;
        }
        if (ask_it(q, 0, &r)) {
            must_meet(q, "warm and cold contradict each other", &r, cold);
        }
    }
    q->options.cache = NULL;
}

/* distance and intersect of one pair: of d and the signed separation s, d = max(s, 0). */
static inline void must_be_consistent(const question *q, const V(result) * d, const V(result) * i)
{
    real lower = i->lower > 0 ? i->lower : 0, upper = i->upper > 0 ? i->upper : 0;
    if (!(d->lower <= upper && lower <= d->upper)) {
        print_result("distance", d);
        broken(q, "distance and intersect contradict each other", i, 0);
    }
}

/* Whether all numbers of x and of their multiples are 0 or normal. */
static inline int stays_normal(const real *x, int count, int exponent)
{
    for (int i = 0; i < count; i++) {
        int e = exponent_of((double)x[i]), least = VARIANT_FLOAT ? -125 : -1021, most = VARIANT_FLOAT ? 128 : 1024;
        if (e > NOTHING && (e < least || e + exponent < least || e + exponent > most)) {
            return 0;
        }
    }
    return 1;
}

static inline int scales_exactly(const scene *s, int exponent)
{
    const body *all[6] = {&s->p.a, &s->p.b, &s->p.part[0], &s->p.part[1], &s->p.part[2], &s->p.part[3]};
    int ok = 1;
    for (int k = 0; k < 6; k++) {
        ok &= stays_normal(all[k]->pose.m, DIM * DIM, 0);
        ok &= stays_normal(all[k]->v[0], MAX_POINTS * DIM, exponent) && stays_normal(all[k]->half, DIM, exponent);
        ok &= stays_normal(&all[k]->radius, 1, exponent) && stays_normal(&all[k]->half_length, 1, exponent);
        ok &= stays_normal(all[k]->pose.p, DIM, exponent) && stays_normal(&all[k]->shape.radius, 1, exponent);
    }
    return ok;
}

/* Whether what is not 0 is so near a size that the squares of both are normal numbers at once. */
static inline int comes_near(const real *x, int count, int size)
{
    for (int i = 0; i < count; i++) {
        int e = exponent_of((double)x[i]);
        if (e > NOTHING && e < size - (VARIANT_FLOAT ? 60 : 500)) {
            return 0;
        }
    }
    return 1;
}

/* Whether no length of the body is next to nothing beside the others of its set, or, of where it lies, beside that. */
static inline int is_of_a_size(const body *b, int whole)
{
    const int set = set_exponent(b);
    return comes_near(b->v[0], MAX_POINTS * DIM, set) && comes_near(b->half, DIM, set) &&
           comes_near(&b->radius, 1, set) && comes_near(&b->half_length, 1, set) && comes_near(b->pose.p, DIM, whole) &&
           comes_near(&b->shape.radius, 1, whole);
}

static inline int is_all_of_a_size(question *q)
{
    int ok = 1;
    for (int k = 0; k < 2; k++) {
        const body *b = whole_of(&q->s, k);
        ok &= is_of_a_size(b, q->exponent);
        for (int i = 0; i < 2 && is_couple(b); i++) {
            ok &= is_of_a_size(b->part[i], set_exponent(b));
        }
    }
    return ok;
}

/* The answer r, and the one to the pair in another unit, a power of two apart, have the same bits. */
static inline void must_scale(question *q, enum query asked, const V(result) * r, int exponent)
{
    const int plain = VARIANT_FLOAT ? 26 : 290;
    scene s = q->s;
    V(result) big, want = *r;
    if (!q->tame || abs(q->exponent + exponent) > plain || !scales_exactly(&s, exponent) || !is_all_of_a_size(q)) {
        return;
    }
    scale_scene(&s, exponent);
    bind_scene(&s);
    for (int k = 0; k < 2; k++) {
        if (abs(larger_of(set_exponent(whole_of(&s, k)), -plain)) > plain) {
            return;
        }
    }
    if (!stays_normal(&want.value, 1, exponent) || !stays_normal(&want.lower, 1, exponent) ||
        !stays_normal(&want.upper, 1, exponent) || !stays_normal(want.normal, DIM, 0)) {
        return;
    }
    multiply(&want.value, 1, exponent);
    multiply(&want.lower, 1, exponent);
    multiply(&want.upper, 1, exponent);
    memset(&big, 0x5a, sizeof big);
    query_of[asked](&s.p.a.shape, &s.p.b.shape, &q->options, &big);
    if (!stays_normal(&big.value, 1, -exponent) || !stays_normal(&big.lower, 1, -exponent) ||
        !stays_normal(&big.upper, 1, -exponent)) {
        return; /* what is 0 here is a number there */
    }
    if (want.value != big.value || want.lower != big.lower || want.upper != big.upper || want.status != big.status ||
        memcmp(want.normal, big.normal, sizeof want.normal) != 0) {
        print_result("in another unit", &big);
        broken(q, "another unit, another answer; times 2 to the", r, exponent);
    }
}

#endif
