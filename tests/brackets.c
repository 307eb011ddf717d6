/* SPDX-License-Identifier: MIT */
/* Every answer's bracket holds the truth, at every exit, whatever the pair and the options.
 *
 *   brackets [PAIRS [SEED [FAMILY]]]
 *
 * PAIRS over all families but the round one, default GJK_PAIRS or 100000; FAMILY: of these only its share.
 *
 * The truth is one in 113 bits. Where it is not certain, and before a bracket is said to miss it or an error to be too
 * large, bodies spelled by their corners are asked about in whole numbers of any length. Of round bodies and of couples
 * there is no other truth.
 *
 * Prints for each family how wrong the value is and how wide the bracket, in u * scale, the support calls, and how many
 * truths are exact. */
#include "faults.h"
#include "pairs.h"
#include "settle.h"

/* In u * scale. */
#define VALUE_ERROR 4.0
#define VALUE_ERROR_OF_OWN 8.0 /* behind supports of the caller's own, of which no corner is known */
/* In u * span, the span being what rounding scales with where little of it can be seen in the scale: the maps' norms
 * times the sets' reaches, the offset, the radii. A support may stand off its set by 8 u of its reach. */
#define WITNESS_ERROR 16.0
#define WIDTH 100.0
/* An overlap is proven by a simplex around a ball around the origin, and the ball must be larger than the rounding in
 * its corners: shallower overlaps are called touching. */
#define SHALLOW 300.0

typedef struct tally {
    enum family family;
    faults faults;
    long pairs, exact, uncertified, apart, meeting;
    double max_error, sum_error, max_own_error, max_width, max_span_width, max_witness, sum_calls, max_calls, max_touch;
    long floors;
} tally;

static tally tallies[FAMILIES];
static exact best;
static long pairs_per_family;
static uint64_t seed = 1;

/* What is being checked, for the message. */
static struct {
    const pair *pair;
    truth *truth;
    int asked; /* whether whole numbers were */
    quad span;
    tally *tally;
    const char *query;
    int from_zero; /* to the query an overlap is a distance of 0 */
    V(options) options;
    long index;
} now;

static void broken(const char *what, const V(result) * r, double by)
{
    if (!note_fault(&now.tally->faults, what, by)) {
        return;
    }
    print_error("%s %s, pair %ld of %s: %s (%.3g)\n", VARIANT, now.query, now.index, family_name[now.tally->family],
                what, by);
    print_error("  status %d value %.17g lower %.17g upper %.17g steps %d; truth %.17g + %.3g, scale %.3g\n", r->status,
                (double)r->value, (double)r->lower, (double)r->upper, r->steps, (double)now.truth->lower,
                (double)(now.truth->upper - now.truth->lower), (double)now.truth->scale);
    print_error("  max_steps %u abs_tol %.17g rel_tol %.17g cutoff %.17g cache %d\n  ", now.options.max_steps,
                (double)now.options.abs_tol, (double)now.options.rel_tol, (double)now.options.cutoff,
                now.options.cache != NULL);
    print_case(stderr, now.query, &now.pair->a, &now.pair->b);
}

/* Whether the truth has become exact just now. */
static int settle_truth(void)
{
    if (now.asked) {
        return 0;
    }
    now.asked = 1;
    if (!settle(now.truth, &best, &now.pair->a, &now.pair->b)) {
        return 0;
    }
    now.tally->exact++;
    return 1;
}

/* low() <= truth <= high() */
static quad low(void) { return now.from_zero ? positive(now.truth->lower) : now.truth->lower; }
static quad high(void) { return now.from_zero ? positive(now.truth->upper) : now.truth->upper; }

static int seems_held(const V(result) * r) { return (quad)r->lower <= high() && (quad)r->upper >= low(); }
static int is_held(const V(result) * r) { return seems_held(r) || (settle_truth() && seems_held(r)); }

static double in_u(quad x, quad scale) { return (double)(x / (scale * (quad)U + (quad)REAL_MIN)); }

/* How far the point stands off the body, exactly. */
static double stands_off_exactly(const body *b, const real *point)
{
    static body spot;
    start_body(&spot, POINTS);
    spot.count = 1;
    memcpy(spot.v[0], point, sizeof spot.v[0]);
    exact_distance(&best, &spot, b);
    return mpf_get_d(best.distance);
}

/* The same, in double where that shows it to be no more than enough. */
static double stands_off(const view *v, const body *b, const real *point, double enough)
{
    static view p;
    double radius = (double)b->shape.radius, off = enough + 1;
    p.count = 1;
    p.size = 0;
    for (int i = 0; i < DIM; i++) {
        p.v[0][i] = ((quad)point[i] - v->origin[i]) / v->unit;
        p.near[0][i] = (double)p.v[0][i];
        p.size = fmax(p.size, fabs(p.near[0][i]));
    }
    if (v->count) {
        double_slow r;
        memset(&r, 0, sizeof r);
        double_solve(&p, v, p.size + v->size, 60, &r);
        off = (double)((quad)r.upper * v->unit) - radius;
    }
    if (!(off <= enough)) {
        quad_slow r;
        memset(&r, 0, sizeof r);
        quad_solve(&p, v, (quad)p.size + (quad)v->size, v->count ? 60 : 30, &r);
        off = (double)(r.lower * v->unit) - radius;
    }
    return !(off <= enough) && has_corners(b) ? stands_off_exactly(b, point) : off;
}

/* The separation along the normal, exactly normalised: whatever the normal, a lower bound of the truth. */
static quad separation(const V(result) * r)
{
    const truth *t = now.truth;
    quad n[DIM], back[DIM], a[DIM], b[DIM], l;
    for (int i = 0; i < DIM; i++) {
        n[i] = (quad)r->normal[i];
        back[i] = -n[i];
    }
    l = quad_length(n);
    quad_farthest(&t->a, n, a);
    quad_farthest(&t->b, back, b);
    return (quad_dot(n, b) - quad_dot(n, a)) / l * t->unit - (quad)now.pair->a.shape.radius -
           (quad)now.pair->b.shape.radius;
}

static void check_witnesses(const V(result) * r)
{
    const truth *t = now.truth;
    quad gap[DIM], scale, n = 0;
    double world = 0, off;
    for (int i = 0; i < DIM; i++) {
        gap[i] = ((quad)r->point_b[i] - (quad)r->point_a[i]) / t->unit;
        world = fmax(world, fmax(fabs((double)r->point_a[i]), fabs((double)r->point_b[i])));
        n += (quad)r->normal[i] * (quad)r->normal[i];
    }
    scale = now.span + world;
    off = WITNESS_ERROR * (double)scale * U;
    off = fmax(stands_off(&t->a, &now.pair->a, r->point_a, off), stands_off(&t->b, &now.pair->b, r->point_b, off));
    now.tally->max_witness = fmax(now.tally->max_witness, in_u(off, scale));
    /* of an overlap the point of intersect is no better than its bracket */
    if (!(in_u(off - (r->upper < 0 ? (double)r->upper - (double)r->lower : 0), scale) <= WITNESS_ERROR)) {
        broken("a witness point is outside, in u * span", r, in_u(off, scale));
    }
    off = in_u(quad_length(gap) * t->unit - positive((quad)r->upper), scale);
    if (!(off <= WITNESS_ERROR && off >= -WIDTH)) {
        broken("the witness points do not realise upper, in u * span", r, off);
    }
    off = in_u(quad_abs(quad_sqrt(n) - 1), 1);
    if (!(off <= 4)) {
        broken("the normal is not unit, in u", r, off);
    }
    off = in_u((quad)r->lower - separation(r), scale);
    if ((r->lower > 0 || now.query[0] == 'i') && !(off <= WITNESS_ERROR)) {
        broken("the normal does not realise lower, in u * span", r, off);
    }
}

/* What every answer owes. */
static void check_bracket(const V(result) * r, int status)
{
    const V(options) *o = &now.options;
    if (status != r->status) {
        broken("returned another status than written", r, status);
    }
    if (status < 0) {
        broken("an error for a good pair", r, status);
        return;
    }
    if (!is_held(r) && !((quad)r->lower <= high())) {
        broken("lower is above the truth, in u * scale", r, in_u((quad)r->lower - high(), now.truth->scale));
    }
    if (!((quad)r->upper >= low())) {
        broken("upper is below the truth, in u * scale", r, in_u(low() - (quad)r->upper, now.truth->scale));
    }
    if (!(r->lower <= r->value && r->value <= r->upper)) {
        broken("the value is outside its bracket", r, 0);
    }
    if (r->steps < 0 || r->supports < 0 || (o->max_steps && (uint32_t)r->steps > o->max_steps)) {
        broken("took more steps than allowed", r, r->steps);
    }
    if (status == GJK_LIMIT && (uint32_t)r->steps != (o->max_steps ? o->max_steps : 256)) {
        broken("says limit before it", r, r->steps);
    }
    check_witnesses(r);
}

static void check_distance(const V(result) * r, int status)
{
    const V(options) *o = &now.options;
    quad width = (quad)r->upper - (quad)r->lower;
    quad asked = ((quad)o->abs_tol + (quad)o->rel_tol * (quad)r->upper) * (1 + 4 * (quad)U);
    int tolerant = o->abs_tol > 0 || o->rel_tol > 0;
    check_bracket(r, status);
    if (status == GJK_OK && !(width <= asked || (!tolerant && in_u(width, now.span) <= WIDTH))) {
        broken("ok, but wider than asked", r, (double)width);
    }
    if (status == GJK_FLOOR && !(in_u(width, now.span) <= WIDTH)) {
        broken("floor, but wider than rounding, in u * span", r, in_u(width, now.span));
    }
    if (status == GJK_DECIDED && !(o->cutoff > 0 && r->lower > o->cutoff)) {
        broken("decided, but not above the cutoff", r, 0);
    }
    if (!(r->lower >= 0)) {
        broken("a distance below 0", r, 0);
    }
}

static quad off_contact(void)
{
    const truth *t = now.truth;
    return t->lower > 0 ? t->lower : t->upper < 0 ? -t->upper : 0;
}

/* Whether it is near enough to contact for no sign to be proven. */
static int may_touch(void) { return in_u(off_contact(), now.span) <= (now.truth->lower > 0 ? WIDTH : SHALLOW); }

static void check_intersect(const V(result) * r, int status)
{
    check_bracket(r, status);
    if (r->value != (r->lower > 0 ? r->lower : r->upper < 0 ? r->upper : 0)) {
        broken("the value does not state the verdict", r, 0);
    }
    if ((status == GJK_OK || status == GJK_DECIDED) && !(r->lower > 0 || r->upper <= 0)) {
        broken("decided, but no sign is proven", r, 0);
    }
    if ((status == GJK_FLOOR || status == GJK_LIMIT) && (r->lower > 0 || r->upper <= 0)) {
        broken("undecided, but a sign is proven", r, 0);
    }
    if (status == GJK_FLOOR) {
        int proven_far = !may_touch() && !(settle_truth() && may_touch());
        now.tally->floors++;
        now.tally->max_touch = fmax(now.tally->max_touch, in_u(off_contact(), now.truth->scale));
        if (proven_far) {
            broken("called touching, but is further off, in u * span", r, in_u(off_contact(), now.span));
        }
    }
}

static double error_of(const V(result) * r)
{
    quad v = (quad)r->value;
    return in_u(v > high() ? v - high() : v < low() ? low() - v : 0, now.truth->scale);
}

/* Which may be so large, of bodies without smooth sides. */
static double checked_error(const tally *s, const V(result) * r, double most)
{
    double error = error_of(r);
    if (!(error <= most) && settle_truth()) {
        error = error_of(r);
    }
    if ((s->family < POLYTOPES || s->family == ROUNDED) && !(error <= most)) {
        broken("the value is further off than it may be, in u * scale", r, error);
    }
    return error;
}

static void measure(tally *s, const V(result) * r)
{
    double error = checked_error(s, r, VALUE_ERROR), width = in_u((quad)r->upper - (quad)r->lower, now.truth->scale);
    s->max_error = fmax(s->max_error, error);
    s->sum_error += error;
    s->max_width = fmax(s->max_width, width);
    s->max_span_width = fmax(s->max_span_width, in_u((quad)r->upper - (quad)r->lower, now.span));
    s->sum_calls += r->supports / 2.0;
    s->max_calls = fmax(s->max_calls, r->supports / 2.0);
    if (r->status != GJK_OK && r->status != GJK_FLOOR) {
        broken("without a limit or a cutoff, yet stopped early", r, r->status);
    }
}

/* An earlier pair's cache, handed from pair to pair. What it cannot see is an edit in place, so each pair in turn has
 * another place, and where the cache still speaks of an earlier pair there, its count is set to 0 as its contract says.
 */
static V(cache) stale;

static V(options) draw_options(draws *d, V(cache) * own, const V(result) * first)
{
    V(options) o = default_options();
    V(cache) *const caches[] = {NULL, own, &stale, own};
    o.max_steps = below(d, 2) ? (uint32_t)(1 + below(d, 5)) : 0;
    o.abs_tol = below(d, 3) ? 0 : (real)(magnitude(d, -10, 0) * (double)first->value);
    o.rel_tol = below(d, 3) ? 0 : (real)magnitude(d, -8, 0);
    o.cutoff = below(d, 3) ? 0 : (real)(between(d, 0, 2) * (double)first->value);
    o.cache = caches[below(d, 4)];
    o.tight = below(d, 4) == 0;
    return o;
}

/* The same bodies behind supports that the library does not know. */
static void one_pair_of_own(tally *s, const pair *p)
{
    const V(shape) a = hidden(&p->a.shape), b = hidden(&p->b.shape);
    V(result) r;
    now.options = default_options();
    memset(&r, 0, sizeof r);
    now.query = "distance by supports of one's own";
    now.from_zero = 1;
    check_distance(&r, V(distance)(&a, &b, NULL, &r));
    s->max_own_error = fmax(s->max_own_error, checked_error(s, &r, VALUE_ERROR_OF_OWN));
    now.query = "intersect by supports of one's own";
    now.from_zero = 0;
    check_intersect(&r, V(intersect)(&a, &b, NULL, &r));
}

/* A support that is off: short of the farthest point, by some way towards the point along the first axis, and off the
 * set along dir. */
typedef struct loose {
    V(shape) exact;
    double short_by; /* at most so much */
    double off;      /* along dir, in units of roundoff times the reach; below 0: inwards */
} loose;

/* 0 to 1. Equal directions have equal shares. */
static double share_of(const real *dir)
{
    uint64_t mix = 0;
    for (int i = 0; i < DIM; i++) {
        uint64_t word = 0;
        memcpy(&word, &dir[i], sizeof dir[i]);
        mix = splitmix64(&word) ^ (mix << 1);
    }
    return (double)(mix >> 11) / 9007199254740992.0;
}

static real loose_support(const void *data, const real *dir, real *point)
{
    const loose *z = data;
    const real ahead[DIM] = {1};
    real first[DIM], reach = z->exact.support(z->exact.data, dir, point);
    double way = 0, most = 0, length = 0, share;
    z->exact.support(z->exact.data, ahead, first);
    for (int i = 0; i < DIM; i++) {
        way += fabs((double)point[i] - (double)first[i]);
        most = fmax(most, fabs((double)dir[i]));
    }
    for (int i = 0; i < DIM; i++) {
        length += (double)dir[i] / most * ((double)dir[i] / most);
    }
    share = share_of(dir) * (way > z->short_by ? z->short_by / way : 1);
    for (int i = 0; i < DIM; i++) {
        double off = z->off * U * (double)reach * ((double)dir[i] / most) / sqrt(length);
        point[i] = (real)((double)point[i] + share * ((double)first[i] - (double)point[i]) + off);
    }
    return reach;
}

/* What is declared in options.slack, and the roundings that every support may make, widen the bracket and no more. The
 * truth stays that of the exact sets. */
static void one_loose_pair(draws *d, const pair *p)
{
    static const double offs[] = {0, -7, 7, 7, -7}; /* the point's own rounding makes it 8 */
    loose a = {p->a.shape, 0, offs[below(d, 5)]}, b = {p->b.shape, 0, offs[below(d, 5)]};
    V(shape) shape_a = p->a.shape, shape_b = p->b.shape;
    V(result) r;
    a.short_by = b.short_by = a.off == 0 && b.off == 0 ? magnitude(d, -9, 0) : 0;
    shape_a.support = shape_b.support = loose_support;
    shape_a.data = &a;
    shape_b.data = &b;
    now.options = default_options();
    now.options.slack = (real)(a.short_by * 1.000001);
    now.options.max_steps = below(d, 2) ? 0 : (uint32_t)(1 + below(d, 8));
    for (int k = 0; k < 2; k++) {
        int status = (k ? V(intersect) : V(distance))(&shape_a, &shape_b, &now.options, &r);
        now.query = k ? "loose intersect" : "loose distance";
        now.from_zero = !k;
        if (status < 0) {
            broken("a support within its licence is called a fault", &r, a.off);
        } else if (!(is_held(&r) && r.lower <= r.value && r.value <= r.upper)) {
            broken("the bracket misses the truth of supports within their licence", &r, a.off);
        }
    }
}

static void one_pair(tally *s, long index)
{
    draws d = draws_from(seed, (uint64_t)s->family, (uint64_t)index);
    static pair places[8];
    static truth t;
    pair *p = &places[index % 8];
    V(result) r, first;
    V(cache) own;
    int status;
    memset(&own, 0, sizeof own);
    draw_pair(&d, s->family, p);
    if (stale.data[0] == &p->a.set || stale.data[1] == &p->b.set) {
        stale.count = 0;
    }
    find_truth(&t, &p->a, &p->b, 1);
    s->pairs++;
    now.pair = p;
    now.truth = &t;
    now.asked = 0;
    now.span = span_of_pair(&p->a, &p->b);
    now.tally = s;
    now.index = index;
    if (!t.certified || s->family == MIXED) { /* beside the large, 113 bits may lose the small and not know it */
        settle_truth();
    }
    s->uncertified += t.a.count && t.b.count && !t.certified;
    s->apart += t.lower > 0;
    s->meeting += t.upper < 0;

    now.query = "distance";
    now.from_zero = 1;
    now.options = default_options();
    memset(&first, 0, sizeof first);
    status = V(distance)(&p->a.shape, &p->b.shape, index % 2 ? &now.options : NULL, &first);
    check_distance(&first, status);
    measure(s, &first);
    for (int k = 0; k < 2; k++) {
        now.options = draw_options(&d, &own, &first);
        r = first;
        status = V(distance)(&p->a.shape, &p->b.shape, &now.options, &r);
        check_distance(&r, status);
    }

    now.query = "intersect";
    now.from_zero = 0;
    now.options = default_options();
    memset(&r, 0, sizeof r);
    status = V(intersect)(&p->a.shape, &p->b.shape, NULL, &r);
    check_intersect(&r, status);
    now.options = draw_options(&d, &own, &first);
    status = V(intersect)(&p->a.shape, &p->b.shape, &now.options, &r);
    check_intersect(&r, status);
    one_pair_of_own(s, p);
    if (s->family < RATIOS && s->family != SLIVERS) { /* turned and moved only: slack keeps its size */
        one_loose_pair(&d, p);
    }
}

static void family_holds(void **state)
{
    tally *s = *state;
    long pairs = is_costly(s->family) ? (pairs_per_family + 7) / 8 : pairs_per_family;
    for (long i = 0; i < pairs; i++) {
        one_pair(s, i);
    }
    printf("%-6s %-10s %8ld pairs %5.1f%% apart %5.1f%% meet | error max %5.2f mean %5.3f, "
           "of one's own %5.2f | width max %6.1f, %5.1f of "
           "span | "
           "witness %5.2f | calls %5.2f max %5.1f | touching %ld within %.2f | exact %ld\n",
           VARIANT, family_name[s->family], s->pairs, 100.0 * (double)s->apart / (double)s->pairs,
           100.0 * (double)s->meeting / (double)s->pairs, s->max_error, s->sum_error / (double)s->pairs,
           s->max_own_error, s->max_width, s->max_span_width, s->max_witness, s->sum_calls / (double)s->pairs,
           s->max_calls, s->floors, s->max_touch, s->exact);
    print_faults(&s->faults, family_name[s->family]);
    assert_int_equal(s->faults.count, 0);
    assert_int_equal(s->uncertified, 0);
}

/* Segments all but parallel, of which the middle was taken for the nearest. */
static void pairs_of_other_seeds(void **state)
{
    static const found_pair pairs[] = {{"gjk2", 2, EDGES, 629}};
    const uint64_t usual = seed;
    const found_pair *f;
    (void)state;
    for (size_t k = 0; (f = next_found(pairs, sizeof pairs / sizeof *pairs, &k)) != NULL;) {
        tally s;
        memset(&s, 0, sizeof s);
        s.family = f->family;
        seed = f->seed;
        one_pair(&s, f->at);
        print_faults(&s.faults, family_name[s.family]);
        assert_int_equal(s.faults.count, 0);
    }
    seed = usual;
}

int main(int argc, char **argv)
{
    const char *pairs = argc > 1 ? argv[1] : getenv("GJK_PAIRS");
    struct CMUnitTest tests[FAMILIES + 1];
    seed = argc > 2 ? strtoull(argv[2], NULL, 10) : seed;
    pairs_per_family = (strtol(pairs ? pairs : "100000", NULL, 10) + ROUND - 1) / ROUND;
    memset(tests, 0, sizeof tests);
    for (int f = 0; f < FAMILIES; f++) {
        tallies[f].family = (enum family)f;
        tests[f].name = family_name[f];
        tests[f].test_func = family_holds;
        tests[f].initial_state = &tallies[f];
    }
    tests[FAMILIES] = (struct CMUnitTest)cmocka_unit_test(pairs_of_other_seeds);
    if (argc > 3) {
        cmocka_set_test_filter(argv[3]);
    }
    exact_start(&best);
    printf("%ld pairs in each family, seed %llu; errors in u * scale\n", pairs_per_family, (unsigned long long)seed);
    return cmocka_run_group_tests_name("brackets of " VARIANT, tests, NULL, NULL);
}
