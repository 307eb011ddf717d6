/* SPDX-License-Identifier: MIT */
/* Any magnitude: a scene in another unit, a power of two apart, has the same answer to the bit as long as its numbers
 * are normal ones; where they are subnormal or about to overflow the bracket holds the truth all the same, or the pair
 * is refused; and how far from the world's origin the bodies are costs what their coordinates lose by it, no more. */
#include "pairs.h"
#include "truth.h"

#if VARIANT_FLOAT
#define LEAST_EXPONENT FLT_MIN_EXP
#define MOST_EXPONENT FLT_MAX_EXP
#define FRACTION_BITS 23
#define LARGEST_PLAIN 26 /* exponent of a size that is plain for certain */
#else
#define LEAST_EXPONENT DBL_MIN_EXP
#define MOST_EXPONENT DBL_MAX_EXP
#define FRACTION_BITS 52
#define LARGEST_PLAIN 290
#endif

#define THOROUGH 1 /* pairs of each family at each power of two */
#define PAIRS 30   /* of each family at some of them */
#define POWERS 8
/* What a pair adds up to on the way is at most so many binades above its largest number, and with couples, whose reach
 * is a generous bound, so many more: nothing may be refused that is farther below the largest number of all. */
#define HEADROOM 8
#define HEADROOM_OF_COUPLES 4
#define VALUE_ERROR 4.0 /* in u * scale */

/* Of sizes from which there is room up and down, and spelled in the body itself. */
static int is_plain(enum family f) { return !is_extreme(f) && f != CLOUDS; }

/* Through the plain ones of the first so many families: so many pairs of each, every pair by draws of its own. */
typedef struct walk {
    uint64_t seed, each;
    int families, family;
    uint64_t drawn; /* of this family */
    draws d;        /* as the pair has left them */
} walk;

/* 0: there are no more. */
static int next_pair(walk *w, pair *p)
{
    for (; w->family < w->families; w->family++, w->drawn = 0) {
        if (is_plain((enum family)w->family) && w->drawn < w->each) {
            w->d = draws_from(w->seed, (uint64_t)w->family, w->drawn++);
            draw_pair(&w->d, (enum family)w->family, p);
            return 1;
        }
    }
    return 0;
}

/* ---- the four kinds of query ---- */

#define KINDS 4

typedef int query_fn(const V(shape) *, const V(shape) *, const V(options) *, V(result) *);
static query_fn *const queries[2] = {V(distance), V(intersect)};
static const char *const query_name[2] = {"distance", "intersect"};

/* distance and intersect, then both tight. */
static int ask(int kind, const pair *p, V(result) * r)
{
    V(options) o = default_options();
    o.tight = (uint32_t)(kind / 2);
    return queries[kind % 2](&p->a.shape, &p->b.shape, &o, r);
}

/* ---- another unit ---- */

static real resized(real x, int k) { return (real)ldexp((double)x, k); }

static void resize_all(real *out, const real *in, int count, int k)
{
    for (int i = 0; i < count; i++) {
        out[i] = resized(in[i], k);
    }
}

/* The set's own lengths by 2^set, its map by 2^map: the body in the world by both. */
static void resize_body(body *out, const body *in, int set, int map)
{
    resize_all(out->v[0], in->v[0], MAX_POINTS * DIM, set);
    resize_all(out->half, in->half, DIM, set);
    out->radius = resized(in->radius, set);
    out->half_length = resized(in->half_length, set);
    resize_all(out->pose.m, in->pose.m, DIM * DIM, map);
    resize_all(out->pose.p, in->pose.p, DIM, set + map);
    out->shape.radius = resized(in->shape.radius, set + map);
}

static void resize_pair(pair *out, const pair *in, int set, int map)
{
    *out = *in;
    resize_body(&out->a, &in->a, set, map);
    resize_body(&out->b, &in->b, set, map);
    for (int i = 0; i < 4; i++) {
        resize_body(&out->part[i], &in->part[i], set, 0);
    }
    bind_pair(out);
}

/* The binades of the numbers that are not 0. */
typedef struct range {
    int least, most;
} range;

static void note_binades(range *r, const real *x, int count)
{
    for (int i = 0; i < count; i++) {
        int e;
        if (x[i] != 0) {
            frexp((double)x[i], &e);
            r->least = e < r->least ? e : r->least;
            r->most = e > r->most ? e : r->most;
        }
    }
}

static void note_set(range *r, const body *b)
{
    note_binades(r, b->v[0], MAX_POINTS * DIM);
    note_binades(r, b->half, DIM);
    note_binades(r, &b->radius, 1);
    note_binades(r, &b->half_length, 1);
}

static int headroom(const pair *p)
{
    return HEADROOM + (is_couple(&p->a) || is_couple(&p->b) ? HEADROOM_OF_COUPLES : 0);
}

static void stretch_range(range *r, int least, int most)
{
    r->least = least < r->least ? least : r->least;
    r->most = most > r->most ? most : r->most;
}

/* Of the sets' own lengths, of those in the world, and of the maps. */
static void note_pair(const pair *p, range *own, range *world, range *maps)
{
    const body *whole[2] = {&p->a, &p->b};
    const range none = {INT16_MAX, INT16_MIN};
    *own = *world = *maps = none;
    for (int k = 0; k < 2; k++) {
        range set = none, map = none;
        note_set(&set, whole[k]);
        note_binades(&map, whole[k]->pose.m, DIM * DIM);
        note_binades(world, whole[k]->pose.p, DIM);
        note_binades(world, &whole[k]->shape.radius, 1);
        for (int i = 0; i < 2 && is_couple(whole[k]); i++) {
            const body *part = &p->part[2 * k + i];
            note_set(&set, part);
            note_binades(&set, part->pose.p, DIM);
            note_binades(&set, &part->shape.radius, 1);
        }
        if (set.most > none.most && map.most > none.most) { /* what the map makes of the set is in the world too */
            stretch_range(world, set.most + map.most, set.most + map.most);
        }
        stretch_range(own, set.least, set.most);
        stretch_range(maps, map.least, map.most);
    }
}

/* ---- the same bits ---- */

#define ANSWERS 17
#define WITH_OPTIONS 2     /* of these, the first after the KINDS */
#define OF_UNKNOWN_REACH 2 /* and the next */
#define WARM (KINDS + WITH_OPTIONS + OF_UNKNOWN_REACH)

typedef struct answers {
    V(result) r[ANSWERS];
} answers;

/* Along a warm path: distance, intersect, or that tight. */
static const char warm_path[] = "diiidtiii";

/* Cold by default and tight; with every option; and along that path, b elsewhere each time. */
static void ask_all(const pair *given, int set, int map, answers *out)
{
    static pair p;
    V(options) o = default_options();
    V(cache) cache;
    int n = 0;
    memset(out, 0, sizeof *out);
    memset(&cache, 0, sizeof cache);
    p = *given;
    bind_pair(&p);
    for (; n < KINDS; n++) {
        out->r[n].status = ask(n, &p, &out->r[n]);
    }
    o = default_options();
    o.abs_tol = resized((real)0.01, set + map);
    o.rel_tol = (real)0.01;
    o.slack = resized((real)0.001, set);
    out->r[n].status = V(distance)(&p.a.shape, &p.b.shape, &o, &out->r[n]);
    n++;
    o = default_options();
    o.cutoff = resized((real)0.25, set + map);
    o.max_steps = 3;
    out->r[n].status = V(distance)(&p.a.shape, &p.b.shape, &o, &out->r[n]);
    n++;
    if (p.a.kind == POINTS) {
        p.a.set.points.reach = 0; /* not known: found out */
    }
    for (int q = 0; q < OF_UNKNOWN_REACH; q++) {
        out->r[n].status = queries[q](&p.a.shape, &p.b.shape, NULL, &out->r[n]);
        n++;
    }
    bind_pair(&p);
    o = default_options();
    o.cache = &cache;
    for (int step = 0; warm_path[step]; step++, n++) {
        o.tight = warm_path[step] == 't';
        out->r[n].status = queries[warm_path[step] != 'd'](&p.a.shape, &p.b.shape, &o, &out->r[n]);
        p.b.pose.p[step % DIM] += resized((real)0.015625, set + map);
    }
}

static const char *const field_name[] = {"value",  "lower",  "upper", "point_a", "point_b",
                                         "normal", "status", "steps", "supports"};

/* 0, or a normal number in both units. */
static int is_normal(real x, int k)
{
    int e;
    frexp((double)x, &e);
    return x == 0 || (e >= LEAST_EXPONENT && e + k >= LEAST_EXPONENT && e + k <= MOST_EXPONENT);
}

static int is_normal_answer(const V(result) * x, int k)
{
    return x->status < 0 || (is_normal(x->value, k) && is_normal(x->lower, k) && is_normal(x->upper, k));
}

/* A coordinate of a point that is not normal in one of the units need not be the same. */
static int same_number(real x, real y, int k) { return !is_normal(x, k) || (double)y == ldexp((double)x, k); }

static int same_numbers(const real *x, const real *y, int k)
{
    int same = 1;
    for (int i = 0; i < DIM; i++) {
        same &= same_number(x[i], y[i], k);
    }
    return same;
}

/* The index of the first field that differs, -1 where none does. So many calls may be more in the other unit. */
static int first_difference(const V(result) * x, const V(result) * y, int k, int more_calls)
{
    const int same[] = {same_number(x->value, y->value, k),
                        same_number(x->lower, y->lower, k),
                        same_number(x->upper, y->upper, k),
                        same_numbers(x->point_a, y->point_a, k),
                        same_numbers(x->point_b, y->point_b, k),
                        same_numbers(x->normal, y->normal, 0),
                        x->status == y->status,
                        x->steps == y->steps,
                        y->supports - x->supports >= 0 && y->supports - x->supports <= more_calls};
    if (x->status != y->status) {
        return 6;
    }
    for (int i = 0; i < 9; i++) {
        if (!same[i]) {
            return i;
        }
    }
    return -1;
}

static struct {
    long compared, different, refused;
    int least, most;    /* powers where something differed */
    int but_for_points; /* which may differ */
} seen;

/* Whether the options' lengths are normal at these powers; they are of 2^-10 to 1/4 in the pair's own unit. */
static int options_are_normal(int set, int map)
{
    return set - 9 >= LEAST_EXPONENT && set + map - 9 >= LEAST_EXPONENT && set + map <= MOST_EXPONENT;
}

static void must_be_same(const pair *p, const answers *x, const answers *y, int set, int map, int may_refuse)
{
    for (int i = 0; i < ANSWERS; i++) {
        int k = set + map, field, kind = i - KINDS;
        /* sets of unknown reach that turn out to be among the smallest are asked once more, each */
        int unknown = kind >= WITH_OPTIONS && kind < WITH_OPTIONS + OF_UNKNOWN_REACH && set < 0;
        if (kind >= 0 && kind < WITH_OPTIONS && !options_are_normal(set, map)) {
            continue;
        }
        if (may_refuse && y->r[i].status < 0) {
            seen.refused++;
            continue;
        }
        if (!is_normal_answer(&x->r[i], k)) {
            continue;
        }
        field = first_difference(&x->r[i], &y->r[i], k, unknown ? 2 : 0);
        seen.compared++;
        if (field < 0 || (seen.but_for_points && (field == 3 || field == 4))) {
            continue;
        }
        seen.least = k < seen.least ? k : seen.least;
        seen.most = k > seen.most ? k : seen.most;
        if (seen.different++ == 0) {
            print_error("%s: %s of answer %d is not the same at 2^%d (maps by 2^%d)\n", VARIANT, field_name[field], i,
                        k, map);
            print_error("  status %d %.17g .. %.17g .. %.17g\n  status %d %.17g .. %.17g .. %.17g  times 2^-%d\n  ",
                        x->r[i].status, (double)x->r[i].lower, (double)x->r[i].value, (double)x->r[i].upper,
                        y->r[i].status, ldexp((double)y->r[i].lower, -k), ldexp((double)y->r[i].value, -k),
                        ldexp((double)y->r[i].upper, -k), k);
            print_case(stderr, i < WARM ? query_name[i % 2] : "warm", &p->a, &p->b);
        }
    }
}

static int may_be_a_ball(const body *b) { return b->kind == ELLIPSOID || b->kind == BALL; }

static void compare(const pair *p, const answers *plain, int set, int map)
{
    static pair other;
    static answers y;
    range own, world, maps;
    note_pair(p, &own, &world, &maps);
    if (own.most < LEAST_EXPONENT && world.most < LEAST_EXPONENT) {
        return; /* a pair without any length has no unit */
    }
    if (own.least + set < LEAST_EXPONENT || own.most + set > MOST_EXPONENT ||
        world.least + set + map < LEAST_EXPONENT || world.most + set + map > MOST_EXPONENT ||
        maps.least + map < LEAST_EXPONENT || maps.most + map > MOST_EXPONENT) {
        return;
    }
    if ((may_be_a_ball(&p->a) || may_be_a_ball(&p->b)) && own.most + set + maps.most + map > MOST_EXPONENT - 5) {
        return; /* it counts as one up to the largest radius, 1/16 of the largest number */
    }
    resize_pair(&other, p, set, map);
    ask_all(&other, set, map, &y);
    must_be_same(p, plain, &y, set, map,
                 own.most + set > MOST_EXPONENT - headroom(p) || world.most + set + map > MOST_EXPONENT - headroom(p) ||
                     maps.most + map > MOST_EXPONENT - 2);
}

static int any_power(draws *d) { return below(d, MOST_EXPONENT - LEAST_EXPONENT) + LEAST_EXPONENT; }

static void expect_same(const char *how, long least)
{
    printf("%-6s %s: %ld answers compared, %ld differ, from 2^%d to 2^%d; %ld refused near overflow\n", VARIANT, how,
           seen.compared, seen.different, seen.least, seen.most, seen.refused);
    assert_true(seen.compared > least);
    assert_int_equal(seen.different, 0);
}

static void another_unit(void **state)
{
    static pair p;
    static answers plain;
    (void)state;
    memset(&seen, 0, sizeof seen);
    for (walk w = {.seed = 4, .families = FAMILIES, .each = PAIRS}; next_pair(&w, &p);) {
        ask_all(&p, 0, 0, &plain);
        for (int k = LEAST_EXPONENT; k <= MOST_EXPONENT && w.drawn <= THOROUGH; k++) {
            compare(&p, &plain, k, 0);
        }
        for (int n = 0; n < POWERS; n++) {
            compare(&p, &plain, any_power(&w.d), 0);
        }
    }
    expect_same("another unit", 10000);
}

/* The set smaller and its map larger by as much, or both. */
static void another_unit_by_the_map(void **state)
{
    static pair p;
    static answers plain;
    (void)state;
    memset(&seen, 0, sizeof seen);
    for (walk w = {.seed = 5, .families = FAMILIES, .each = PAIRS}; next_pair(&w, &p);) {
        ask_all(&p, 0, 0, &plain);
        for (int n = 0; n < POWERS; n++) {
            int map = any_power(&w.d);
            compare(&p, &plain, n % 3 ? any_power(&w.d) / (n % 3) : -map, map);
        }
    }
    expect_same("by the map", 1000);
}

static void set_straight(body *k)
{
    for (int i = 0; i < DIM * DIM; i++) {
        k->pose.m[i] = i % (DIM + 1) == 0;
    }
}

/* Round sets, and couples of them, on an axis, or off it by next to nothing: their points have coordinates far smaller
 * than the set, which in another unit would be subnormal. */
static void another_unit_along_an_axis(void **state)
{
    static pair p;
    static answers plain;
    (void)state;
    memset(&seen, 0, sizeof seen);
    for (walk w = {.seed = 12, .families = FAMILIES, .each = PAIRS}; next_pair(&w, &p);) {
        const int along = below(&w.d, DIM);
        range own, world, maps;
        double size = span_of(&p.a) + span_of(&p.b);
        if (!(size > 0) || has_corners(&p.a)) {
            continue;
        }
        set_straight(&p.a);
        for (int i = 0; i < DIM; i++) {
            p.a.pose.p[i] = 0;
            p.b.pose.p[i] =
                (real)(size * (i == along ? between(&w.d, 0.5, 2) : magnitude(&w.d, VARIANT_FLOAT ? -25 : -60, 0)));
            for (int k = 0; k < 2 && is_couple(&p.a); k++) {
                set_straight(&p.part[k]);
                p.part[k].pose.p[i] = 0;
            }
        }
        ask_all(&p, 0, 0, &plain);
        note_pair(&p, &own, &world, &maps);
        stretch_range(&own, world.least, world.most);
        for (int n = 0; n < POWERS; n++) {
            int map = any_power(&w.d);
            compare(&p, &plain, n % 3 ? any_power(&w.d) / (n % 3) : -map, map);
            compare(&p, &plain, any_power(&w.d), 0);
            compare(&p, &plain, LEAST_EXPONENT - own.least + n, 0); /* the smallest in which its numbers are normal */
        }
    }
    expect_same("along an axis", 1000);
}

/* Of boxes in line, one without a pose, all corners across the axis are as near: the choice must not hang on the sign
 * of a 0, which a pose changes, as does the way it is asked in units so small that squares underflow. */
static void another_unit_of_boxes_in_line(void **state)
{
    const int least = LEAST_EXPONENT + 16;
    static pair p, q;
    (void)state;
    for (uint64_t n = 0; n < 2000; n++) {
        draws d = draws_from(13, 0, n);
        const int along = below(&d, DIM), by = least + below(&d, 1 - least);
        const int bare = below(&d, 2);
        V(result) x, y;
        for (int k = 0; k < 2; k++) {
            body *b = k ? &p.b : &p.a;
            start_body(b, BOX);
            for (int i = 0; i < DIM; i++) {
                b->half[i] = (real)((1 + (double)below(&d, 8)) / 8);
            }
        }
        for (int i = 0; i < DIM; i++) {
            real *at = bare ? &p.a.pose.p[i] : &p.b.pose.p[i];
            *at = i == along ? (real)(below(&d, 2) ? 2.25 : -2.25) : below(&d, 2) ? 0 : -(real)0;
        }
        bind_pair(&p);
        resize_pair(&q, &p, by, 0);
        (bare ? &p.b : &p.a)->shape.pose = NULL;
        (bare ? &q.b : &q.a)->shape.pose = NULL;
        memset(&x, 0, sizeof x);
        memset(&y, 0, sizeof y);
        assert_int_equal(V(intersect)(&p.a.shape, &p.b.shape, NULL, &x), GJK_DECIDED);
        assert_int_equal(V(intersect)(&q.a.shape, &q.b.shape, NULL, &y), GJK_DECIDED);
        assert_int_equal(first_difference(&x, &y, by, 0), -1);
    }
}

static int is_same_point(const real *x, const real *y, int k)
{
    real z[DIM];
    resize_all(z, x, DIM, k);
    return memcmp(z, y, sizeof z) == 0;
}

/* Of boxes without width along some axes, one without a pose: the signs of their points' zeros, too, which a product
 * with a map's 0 would change. In units so small that squares underflow they are asked another way, which in the plane
 * takes a step more where they touch: so of these nothing is asked here. */
static void another_unit_of_flat_boxes(void **state)
{
    const int least = LEAST_EXPONENT + 16;
    static pair p, q;
    long apart = 0;
    (void)state;
    for (uint64_t n = 0; n < 2000; n++) {
        draws d = draws_from(15, 0, n);
        const int by = least + below(&d, 1 - least), bare = below(&d, 2);
        V(result) x, y;
        for (int k = 0; k < 2; k++) {
            body *b = k ? &p.b : &p.a;
            start_body(b, BOX);
            for (int i = 0; i < DIM; i++) {
                b->half[i] = (real)(below(&d, 2) * (1 + (double)below(&d, 8)) / 8);
            }
        }
        for (int i = 0; i < DIM; i++) {
            (bare ? &p.a : &p.b)->pose.p[i] = (real)(below(&d, 7) - 3);
        }
        bind_pair(&p);
        resize_pair(&q, &p, by, 0);
        (bare ? &p.b : &p.a)->shape.pose = NULL;
        (bare ? &q.b : &q.a)->shape.pose = NULL;
        for (int kind = 0; kind < 2; kind++) {
            memset(&x, 0, sizeof x);
            memset(&y, 0, sizeof y);
            assert_int_equal(queries[kind](&p.a.shape, &p.b.shape, NULL, &x),
                             queries[kind](&q.a.shape, &q.b.shape, NULL, &y));
            if (x.lower > 0) {
                assert_int_equal(first_difference(&x, &y, by, 0), -1);
                assert_true(is_same_point(x.point_a, y.point_a, by) && is_same_point(x.point_b, y.point_b, by));
                apart++;
            }
        }
    }
    assert_true(apart > 2000);
}

/* A length of few digits, one far smaller, or none. */
static real unlike(draws *d, int big, int small)
{
    switch (below(d, 4)) {
    case 0:
        return 0;
    case 1:
        return (real)ldexp(below(d, 2) ? -1 : 1, small + below(d, 3));
    default:
        return (real)ldexp((double)(below(d, 9) - 4), big);
    }
}

/* Of lengths unlike each other, the radius none of the small ones. */
static void draw_unlike(draws *d, body *b, enum kind kind, int big, int small)
{
    start_body(b, kind);
    b->count = kind == POINTS ? 1 + below(d, 4) : 0;
    for (int i = 0; i < DIM; i++) {
        b->half[i] = kind == BOX ? (real)fabs((double)unlike(d, big, small)) : 0;
        b->pose.p[i] = unlike(d, big, small);
    }
    for (int k = 0; k < 4 && (k < b->count || (k < 2 && kind == SEGMENT)); k++) {
        for (int i = 0; i < DIM; i++) {
            b->v[k][i] = unlike(d, big, small);
        }
    }
    b->shape.radius = (real)ldexp((double)below(d, 4), big);
    if (below(d, 2)) {
        b->pose.m[1] = (real)between(d, -4, 4); /* a shear */
    }
}

/* All numbers are normal, and so are their squares in a frame of the pair's size; not all that points have of the small
 * ones need be. */
static void another_unit_of_unlike_lengths(void **state)
{
    static const enum kind kinds[] = {ORIGIN, SEGMENT, BOX, POINTS};
    static pair p;
    static answers plain;
    (void)state;
    memset(&seen, 0, sizeof seen);
    seen.but_for_points = 1;
    for (uint64_t n = 0; n < 100 * PAIRS; n++) {
        draws d = draws_from(18, 0, n);
        const int big = below(&d, LARGEST_PLAIN / 2), small = LEAST_EXPONENT / 2 + big + 8 + below(&d, 4);
        memset(&p, 0, sizeof p);
        draw_unlike(&d, &p.a, kinds[below(&d, 4)], big, small);
        draw_unlike(&d, &p.b, kinds[below(&d, 4)], big, small);
        bind_pair(&p);
        ask_all(&p, 0, 0, &plain);
        for (int k = 0; k < POWERS; k++) {
            compare(&p, &plain, below(&d, LARGEST_PLAIN - big), 0);
        }
    }
    expect_same("of unlike lengths", 1000);
}

/* But for components that are nothing next to the others. */
static int is_about(const real *x, const real *y)
{
    int r = 1;
    for (int i = 0; i < DIM; i++) {
        r &= x[i] == y[i] || fabs((double)x[i] - (double)y[i]) < (double)REAL_MIN / (double)REAL_EPSILON;
    }
    return r;
}

/* Where the point is, to next to nothing. */
enum { ANYWHERE, AT_A_CORNER, IN_ITS_MIDDLE };

/* A point beside a box or in it, or a body without size under a map, and lengths that are normal but would not be in a
 * frame of the pair's size, which is asked only in some units: nothing is told by whether they are 0, and nothing by a
 * map that moves no point. */
static void another_unit_of_what_is_lost_in_the_frame(void **state)
{
    static pair p, q;
    V(result) x, y;
    long compared = 0;
    (void)state;
    for (uint64_t n = 0; n < 400 * PAIRS; n++) {
        draws d = draws_from(19, 0, n);
        const int big = below(&d, LARGEST_PLAIN / 2), small = LEAST_EXPONENT + below(&d, 4), of_map = below(&d, 2);
        const int place = below(&d, 3);
        const int by = below(&d, MOST_EXPONENT - HEADROOM - big), swapped = below(&d, 2);
        body *box = swapped ? &p.b : &p.a, *other = swapped ? &p.a : &p.b;
        memset(&p, 0, sizeof p);
        draw_unlike(&d, box, of_map && below(&d, 2) ? POINTS : BOX, big, of_map ? big : small);
        draw_unlike(&d, other, of_map ? SEGMENT : ORIGIN, big, of_map ? big : small);
        if (of_map) {
            const int down = -below(&d, LARGEST_PLAIN);
            memset(box->half, 0, sizeof box->half);
            memset(box->v, 0, sizeof box->v);
            resize_all(box->pose.m, box->pose.m, DIM * DIM, down);
        } else if (place != ANYWHERE) {
            set_straight(box);
            for (int i = 0; i < DIM; i++) {
                box->half[i] += place == IN_ITS_MIDDLE ? (real)ldexp(1, big) : 0;
                other->pose.p[i] = place == AT_A_CORNER && below(&d, 2) ? box->half[i] : unlike(&d, small, small);
                box->pose.p[i] = 0;
            }
        }
        bind_pair(&p);
        resize_pair(&q, &p, by, 0);
        if (box->kind == POINTS && below(&d, 2)) {
            box->set.points.reach = (swapped ? &q.b : &q.a)->set.points.reach = 0;
        }
        for (int kind = 0; kind <= KINDS - of_map; kind++) {
            memset(&x, 0, sizeof x);
            memset(&y, 0, sizeof y);
            x.status = kind < KINDS ? ask(kind, &p, &x) : V(penetration)(&p.a.shape, &p.b.shape, NULL, &x);
            y.status = kind < KINDS ? ask(kind, &q, &y) : V(penetration)(&q.a.shape, &q.b.shape, NULL, &y);
            if (x.status < 0 || !is_normal_answer(&x, by)) {
                continue;
            }
            if (x.status != y.status || !same_number(x.value, y.value, by) || !same_number(x.lower, y.lower, by) ||
                !same_number(x.upper, y.upper, by) ||
                ((x.lower > 0 || place == IN_ITS_MIDDLE) && !of_map && !is_about(x.normal, y.normal))) {
                print_error("%s: not the same at 2^%d: %.17g .. %.17g, %.17g .. %.17g\n  ", VARIANT, by,
                            (double)x.lower, (double)x.upper, ldexp((double)y.lower, -by), ldexp((double)y.upper, -by));
                print_case(stderr, kind < KINDS ? query_name[kind % 2] : "penetration", &p.a, &p.b);
                fail();
            }
            compared++;
        }
    }
    assert_true(compared > 1000);
}

#define CLOUD_MOST 12

/* The same of clouds whose points lie in planes of the axes, on either side of 0, one of them thin or none: whether
 * they meet. */
static void another_unit_of_flat_clouds(void **state)
{
    const int least = LEAST_EXPONENT + 16;
    long apart = 0;
    (void)state;
    for (uint64_t n = 0; n < 2000; n++) {
        draws d = draws_from(17, 0, n);
        const int by[2] = {0, least + below(&d, 1 - least)}, bare = below(&d, 2), flat = below(&d, DIM);
        const int many = 9 + below(&d, CLOUD_MOST - 8), few = 1 + below(&d, 2), pairing = below(&d, 3);
        real x[2][2][CLOUD_MOST * DIM];
        V(points) set[2][2];
        V(pose) at[2];
        V(result) r[2];
        memset(at, 0, sizeof at);
        for (int k = 0; k < 2; k++) {
            for (int i = 0; i < CLOUD_MOST * DIM; i++) {
                x[0][k][i] = (real)(i % DIM == flat ? (below(&d, 2) ? 0.0 : -0.0) : (double)(below(&d, 17) - 8) / 8);
            }
        }
        for (int i = 0; i < DIM; i++) {
            at[0].m[(DIM + 1) * i] = 1;
            at[0].p[i] = (real)(below(&d, 7) - 3);
        }
        at[1] = at[0];
        resize_all(at[1].p, at[0].p, DIM, by[1]);
        for (int unit = 0; unit < 2; unit++) {
            V(shape) s[2];
            for (int k = 0; k < 2; k++) {
                for (int i = 0; unit && i < CLOUD_MOST; i++) {
                    resize_all(x[1][k] + DIM * i, x[0][k] + DIM * i, DIM, by[1]);
                }
                memset(&set[unit][k], 0, sizeof set[unit][k]);
                set[unit][k].v = x[unit][k];
                set[unit][k].count = (size_t)(pairing == k ? few : many);
                set[unit][k].reach = (real)ldexp(2, by[unit]);
                memset(&s[k], 0, sizeof s[k]);
                s[k].support = V(support_points);
                s[k].data = &set[unit][k];
                s[k].pose = k == bare ? NULL : &at[unit];
            }
            memset(&r[unit], 0, sizeof r[unit]);
            V(intersect)(&s[0], &s[1], NULL, &r[unit]);
        }
        assert_int_equal(r[0].status, r[1].status);
        if (r[0].lower > 0) {
            assert_int_equal(first_difference(&r[0], &r[1], by[1], 0), -1);
            assert_true(is_same_point(r[0].point_a, r[1].point_a, by[1]));
            assert_true(is_same_point(r[0].point_b, r[1].point_b, by[1]));
            apart++;
        }
    }
    assert_true(apart > 1000);
}

/* A cloud without size, of a reach that nobody said, under a map beside which the unit is so small that its reach, as
 * it is found, would be a length. */
static void another_unit_without_size(void **state)
{
    static pair p, q;
    V(result) x, y;
    (void)state;
    for (uint64_t n = 0; n < 100 * PAIRS; n++) {
        draws d = draws_from(20, 0, n);
        const int by = LEAST_EXPONENT + 32 + below(&d, -LEAST_EXPONENT / 2), to = below(&d, LARGEST_PLAIN);
        memset(&p, 0, sizeof p);
        start_body(&p.a, POINTS);
        p.a.count = 1 + below(&d, 4);
        resize_all(p.a.pose.m, p.a.pose.m, DIM * DIM, to);
        start_body(&p.b, POINTS);
        p.b.count = DIM + 2;
        for (int i = 0; i < DIM * p.b.count; i++) {
            p.b.v[i / DIM][i % DIM] = (real)(below(&d, 9) - 4);
        }
        for (int i = 0; i < DIM; i++) {
            p.a.pose.p[i] = (real)(below(&d, 17) - 8);
        }
        bind_pair(&p);
        resize_pair(&q, &p, by, 0);
        p.a.set.points.reach = q.a.set.points.reach = 0;
        memset(&x, 0, sizeof x);
        memset(&y, 0, sizeof y);
        x.status = V(distance)(&p.a.shape, &p.b.shape, NULL, &x);
        y.status = V(distance)(&q.a.shape, &q.b.shape, NULL, &y);
        assert_int_equal(first_difference(&x, &y, by, 0), -1);
    }
}

/* Two points with radii, on one another or apart along an axis by a number of few digits: to the last bit the sum of a
 * few numbers, which may be a tie between two more. */
static void another_unit_of_points_with_radii(void **state)
{
    static pair p, q;
    (void)state;
    for (uint64_t n = 0; n < 100 * PAIRS; n++) {
        draws d = draws_from(14, 0, n);
        const int by = below(&d, MOST_EXPONENT) - MOST_EXPONENT / 2;
        V(result) x, y;
        for (int k = 0; k < 2; k++) {
            body *b = k ? &p.b : &p.a;
            start_body(b, DIM == 3 && below(&d, 2) ? TRIANGLE : POINTS);
            b->count = b->kind == POINTS;
            b->shape.radius = (real)between(&d, 0.5, 2);
        }
        p.b.pose.p[0] = (real)below(&d, 5);
        bind_pair(&p);
        resize_pair(&q, &p, by, 0);
        memset(&x, 0, sizeof x);
        memset(&y, 0, sizeof y);
        x.status = V(penetration)(&p.a.shape, &p.b.shape, NULL, &x);
        y.status = V(penetration)(&q.a.shape, &q.b.shape, NULL, &y);
        assert_true(x.status >= 0);
        assert_int_equal(first_difference(&x, &y, by, 0), -1);
    }
}

#if DIM == 3
/* The first corner lies as far along the way to a point within as that point does: no ways lead down beside it, to
 * where others would be sought at once. */
static void another_unit_without_a_fan(void **state)
{
    static const real a[3][DIM] = {{1, 0, -3}, {1, -1, -2}, {4, -2, -2}};
    static const real b[5][DIM] = {{-2, -2, 0}, {0, 3, 1}, {4, 3, 1}, {4, 1, 0}, {-3, 0, -3}};
    static const int unit[] = {LEAST_EXPONENT / 2, LEAST_EXPONENT / 3, 1, MOST_EXPONENT / 2};
    static pair p, q;
    V(result) x, y;
    (void)state;
    start_body(&p.a, TRIANGLE);
    start_body(&p.b, POINTS);
    memcpy(p.a.v, a, sizeof a);
    memcpy(p.b.v, b, sizeof b);
    p.b.count = 5;
    p.b.pose.p[0] = p.b.pose.p[2] = 2;
    bind_pair(&p);
    memset(&x, 0, sizeof x);
    assert_int_equal(V(intersect)(&p.a.shape, &p.b.shape, NULL, &x), GJK_DECIDED);
    for (size_t i = 0; i < sizeof unit / sizeof *unit; i++) {
        resize_pair(&q, &p, unit[i], 0);
        memset(&y, 0, sizeof y);
        assert_int_equal(V(intersect)(&q.a.shape, &q.b.shape, NULL, &y), GJK_DECIDED);
        assert_int_equal(first_difference(&x, &y, unit[i], 0), -1);
    }
}
#endif

/* A capsule as the hull of two balls about points: the points have no size to round, in the smallest unit either. */
static void capsules_in_the_smallest_unit(void **state)
{
    static pair p;
    static answers plain;
    (void)state;
    memset(&seen, 0, sizeof seen);
    for (uint64_t n = 0; n < 10 * PAIRS; n++) {
        draws d = draws_from(13, 0, n);
        memset(&p, 0, sizeof p);
        start_body(&p.a, HULL);
        draw_box(&d, &p.b, 0.5, 2);
        for (int k = 0; k < 2; k++) {
            start_body(&p.part[k], ORIGIN);
            p.part[k].pose.p[0] = (real)between(&d, 0.5, 2);
            p.part[k].pose.p[1] = (real)between(&d, 0.5, 2);
            p.part[k].shape.radius = (real)between(&d, 0.5, 2);
            p.a.part[k] = &p.part[k];
        }
        p.b.pose.p[1] = (real)between(&d, -8, 8);
        bind_pair(&p);
        ask_all(&p, 0, 0, &plain);
        for (int k = LEAST_EXPONENT; k < LEAST_EXPONENT + POWERS; k++) {
            compare(&p, &plain, k, 0);
        }
    }
    expect_same("capsules", 1000);
}

/* ---- subnormal numbers, and overflow ---- */

static const pair *asked; /* for the message */

static void expect_bracket(const V(result) * r, int k, const truth *t, int query)
{
    /* the truth itself is good to 1e-28 of the size */
    quad small = ((quad)t->a.size + (quad)t->b.size) * (quad)1e-28, unit = 1;
    quad lower = (query ? t->lower : positive(t->lower)) - small,
         upper = (query ? t->upper : positive(t->upper)) + small;
    for (int i = 0; i < abs(k); i++) {
        unit = k > 0 ? unit * 2 : unit / 2;
    }
    if ((quad)r->lower <= upper * unit && lower * unit <= (quad)r->upper && r->lower <= r->value &&
        r->value <= r->upper) {
        return;
    }
    print_error("%s %s at 2^%d: status %d %.17g .. %.17g .. %.17g, truth %.17g * 2^%d, of\n  ", VARIANT,
                query_name[query], k, r->status, (double)r->lower, (double)r->value, (double)r->upper, (double)t->upper,
                k);
    print_case(stderr, query_name[query], &asked->a, &asked->b);
    fail();
}

/* All four kinds of query of the pair made larger or smaller by 2^k; what rounding takes from its numbers there changes
 * the pair, so the truth is that of the pair brought back, which is exact. may_refuse: the pair is near overflow. */
static long expect_brackets(const pair *p, int k, int may_refuse)
{
    static pair there, back;
    static truth t;
    V(result) r, before;
    long refused = 0;
    resize_pair(&there, p, k, 0);
    resize_pair(&back, &there, -k, 0);
    find_truth(&t, &back.a, &back.b, 1);
    memset(&before, 0x5a, sizeof before);
    asked = &there;
    for (int n = 0; n < KINDS; n++) {
        r = before;
        if (ask(n, &there, &r) < 0) {
            if (!may_refuse) {
                print_error("%s %s at 2^%d is refused:\n  ", VARIANT, query_name[n % 2], k);
                print_case(stderr, query_name[n % 2], &there.a, &there.b);
                fail();
            }
            assert_memory_equal(&r, &before, sizeof r);
            refused++;
        } else {
            expect_bracket(&r, k, &t, n % 2);
        }
    }
    return refused;
}

/* From the last binade in which all numbers are normal, down to where all are 0. */
static void subnormal_numbers(void **state)
{
    static pair p;
    (void)state;
    for (walk w = {.seed = 6, .families = FAMILIES, .each = PAIRS}; next_pair(&w, &p);) {
        for (int n = 0; n < POWERS / 2; n++) {
            expect_brackets(&p, LEAST_EXPONENT - below(&w.d, FRACTION_BITS + 4), 0);
        }
    }
}

/* Up to where the largest number is in the topmost binade. What is refused there is refused; what is answered is right.
 */
static void numbers_near_overflow(void **state)
{
    static pair p;
    long refused = 0, answered = 0;
    (void)state;
    for (walk w = {.seed = 7, .families = FAMILIES, .each = PAIRS}; next_pair(&w, &p);) {
        range own, world, maps;
        note_pair(&p, &own, &world, &maps);
        for (int n = 0; n < POWERS / 2; n++) {
            int spare = below(&w.d, 3 * headroom(&p)), most = own.most > world.most ? own.most : world.most;
            if (most < LEAST_EXPONENT) {
                continue; /* nothing but zeros */
            }
            refused += expect_brackets(&p, MOST_EXPONENT - spare - most, spare < headroom(&p));
            answered += KINDS;
        }
    }
    answered -= refused;
    printf("%-6s near overflow: %ld answers, %ld refused\n", VARIANT, answered, refused);
    assert_true(answered > 2 * refused);
}

/* ---- far from the origin ---- */

/* All four answers hold, and both distances are good. The worst error of these goes on. */
static void expect_good_value(const pair *p, double *worst)
{
    static truth t;
    V(result) r;
    double error;
    find_truth(&t, &p->a, &p->b, 1);
    asked = p;
    for (int n = 0; n < KINDS; n++) {
        memset(&r, 0, sizeof r);
        assert_true(ask(n, p, &r) >= 0);
        expect_bracket(&r, 0, &t, n % 2);
        if (n % 2 == 0) {
            error = (double)(quad_abs((quad)r.value - positive(t.upper)) / ((quad)U * t.scale + (quad)REAL_MIN));
            if (error > VALUE_ERROR && *worst <= VALUE_ERROR) {
                print_error("%s: value %.17g, truth %.17g, %.2f u * scale, of\n  ", VARIANT, (double)r.value,
                            (double)t.upper, error);
                print_case(stderr, "distance", &p->a, &p->b);
            }
            *worst = fmax(*worst, error);
        }
    }
}

static void expect_small(const char *where, double worst)
{
    printf("%-6s %s: error at most %.2f u * scale\n", VARIANT, where, worst);
    assert_true(worst <= VALUE_ERROR);
}

/* A point with a radius on a segment without one: so deep to the last bit. */
static void as_deep_as_the_radius(void **state)
{
    static pair p;
    (void)state;
    for (uint64_t n = 0; n < 100 * PAIRS; n++) {
        draws d = draws_from(21, 0, n);
        V(result) r;
        memset(&p, 0, sizeof p);
        start_body(&p.a, SEGMENT);
        start_body(&p.b, n % 2 ? BOX : ORIGIN); /* of no size */
        p.a.v[0][0] = (real)-below(&d, 4);
        p.a.v[1][0] = (real)(1 + below(&d, 4));
        p.b.shape.radius = (real)between(&d, 0.5, 2);
        for (int i = 0; i < DIM; i++) {
            p.a.pose.p[i] = p.b.pose.p[i] = (real)(below(&d, 9) - 4);
        }
        bind_pair(&p);
        assert_int_equal(V(penetration)(&p.a.shape, &p.b.shape, NULL, &r), GJK_OK);
        assert_true(r.value == -p.b.shape.radius);
    }
}

#if DIM == 3
/* Four corners in a plane, but for some roundings of one of them, and another cloud over them: what tells that the face
 * of three is nearest must see whether the fourth lies lower. */
static void faces_hardly_bent(void **state)
{
    static pair p;
    double worst = 0;
    (void)state;
    for (uint64_t n = 0; n < 300 * PAIRS; n++) {
        draws d = draws_from(20, 0, n);
        double m[DIM * DIM], gap = magnitude(&d, VARIANT_FLOAT ? -3 : -9, 0), at[DIM];
        const double bend = (below(&d, 401) - 200) * (double)U;
        memset(&p, 0, sizeof p);
        start_body(&p.a, POINTS);
        draw_hull(&d, &p.b, 1 + below(&d, 12), between(&d, 0.1, 1));
        p.a.count = 5;
        for (int k = 0; k < 4; k++) {
            p.a.v[k][0] = (real)(k % 2 ? 1 : -1);
            p.a.v[k][1] = (real)(k / 2 ? 1 : -1);
            p.a.v[k][2] = (real)(k == 3 ? 1 + bend : 1); /* not 0, of which more than roundings would be known */
        }
        rotation(&d, between(&d, 0, 3), m);
        for (int i = 0; i < DIM; i++) {
            at[i] = between(&d, -1, 1);
        }
        at[2] = 2.1 + gap; /* b reaches 1 */
        for (int i = 0; i < DIM; i++) {
            p.b.pose.p[i] = (real)(m[DIM * i] * at[0] + m[DIM * i + 1] * at[1] + m[DIM * i + 2] * at[2]);
            for (int j = 0; j < DIM; j++) {
                p.a.pose.m[DIM * i + j] = p.b.pose.m[DIM * i + j] = (real)m[DIM * i + j];
            }
        }
        bind_pair(&p);
        expect_good_value(&p, &worst);
    }
    expect_small("faces hardly bent", worst);
    assert_true(worst <= 2);
}
#endif

/* Both bodies moved out by 1e12 of their sizes, which rounds their places, often to one and the same; the truth is that
 * of the places as rounded, and the offset is not in the scale. */
static void far_from_the_origin(void **state)
{
    static pair p;
    double worst = 0;
    (void)state;
    for (walk w = {.seed = 8, .families = POLYTOPES, .each = 10 * PAIRS}; next_pair(&w, &p);) {
        double dir[DIM];
        unit(&w.d, dir);
        move(&p.a, dir, 1e12);
        move(&p.b, dir, 1e12);
        expect_good_value(&p, &worst);
    }
    expect_small("1e12 sizes from the origin", worst);
}

/* The vertices themselves stand far out, no pose says so. */
static void far_vertices(void **state)
{
    static pair p;
    double worst = 0;
    (void)state;
    for (uint64_t i = 0; i < 100 * PAIRS; i++) {
        draws d = draws_from(9, 0, i);
        double dir[DIM], far = magnitude(&d, 0, 12);
        memset(&p, 0, sizeof p);
        draw_hull(&d, &p.a, 1 + below(&d, 12), 1);
        draw_hull(&d, &p.b, 1 + below(&d, 12), 1);
        unit(&d, dir);
        move_points(&p.a, dir, far);
        move_points(&p.b, dir, far + 1.5);
        bind_pair(&p);
        p.a.shape.pose = p.b.shape.pose = NULL;
        expect_good_value(&p, &worst);
    }
    expect_small("vertices 1 to 1e12 sizes from the origin", worst);
}

/* The pair as it is from a, where a's map is a turn: a has no pose, b's is turned back by it, to rounding. */
static void see_from_a(pair *p)
{
    V(pose) a = p->a.pose, b = p->b.pose;
    for (int i = 0; i < DIM; i++) {
        double at = 0;
        for (int j = 0; j < DIM; j++) {
            double sum = 0;
            for (int k = 0; k < DIM; k++) {
                sum += (double)a.m[k * DIM + i] * (double)b.m[k * DIM + j];
            }
            p->b.pose.m[i * DIM + j] = (real)sum;
            p->a.pose.m[i * DIM + j] = i == j;
            at += (double)a.m[j * DIM + i] * ((double)b.p[j] - (double)a.p[j]);
        }
        p->b.pose.p[i] = (real)at;
        p->a.pose.p[i] = 0;
    }
    p->a.shape.pose = NULL;
}

/* b given relative to a, which has no pose: the world's offset is in no number, and nothing is lost to it. */
static void relative_to_a(void **state)
{
    static pair p;
    double worst = 0;
    (void)state;
    for (walk w = {.seed = 10, .families = POLYTOPES, .each = 10 * PAIRS}; next_pair(&w, &p);) {
        see_from_a(&p);
        expect_good_value(&p, &worst);
    }
    expect_small("b relative to a", worst);
}

/* Places on a grid that the world's coordinates still hold far out: the bracket and the normal keep their bits there,
 * with a's pose and without. Points of contact are as good as the frame's coordinates. */
static void moved_without_rounding(void **state)
{
    static pair p, q;
    const double grid = VARIANT_FLOAT ? 4 : 1024, far = VARIANT_FLOAT ? 262144 : 1099511627776.0;
    (void)state;
    for (walk w = {.seed = 11, .families = FAMILIES, .each = PAIRS}; next_pair(&w, &p);) {
        for (int j = 0; j < DIM; j++) {
            p.a.pose.p[j] = 0;
            p.b.pose.p[j] = (real)(rint((double)p.b.pose.p[j] * grid) / grid); /* also -0, which is no other tie */
            if (fabs((double)p.b.pose.p[j]) > far) {
                p.b.pose.p[j] = 1;
            }
        }
        q = p;
        bind_pair(&p);
        bind_pair(&q);
        for (int j = 0; j < DIM; j++) {
            double by = rint(between(&w.d, -far, far));
            q.a.pose.p[j] = (real)by;
            q.b.pose.p[j] = (real)(by + (double)p.b.pose.p[j]);
        }
        for (int n = 0; n < KINDS; n++) {
            V(result) x, y;
            memset(&x, 0, sizeof x);
            memset(&y, 0, sizeof y);
            assert_true(ask(n, &p, &x) >= 0);
            assert_true(ask(n, &q, &y) >= 0);
            memcpy(y.point_a, x.point_a, sizeof x.point_a);
            memcpy(y.point_b, x.point_b, sizeof x.point_b);
            assert_int_equal(first_difference(&x, &y, 0, 0), -1);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(another_unit),
        cmocka_unit_test(another_unit_by_the_map),
        cmocka_unit_test(another_unit_along_an_axis),
        cmocka_unit_test(another_unit_of_boxes_in_line),
        cmocka_unit_test(another_unit_of_flat_boxes),
        cmocka_unit_test(another_unit_of_flat_clouds),
        cmocka_unit_test(another_unit_without_size),
        cmocka_unit_test(another_unit_of_unlike_lengths),
        cmocka_unit_test(another_unit_of_what_is_lost_in_the_frame),
        cmocka_unit_test(another_unit_of_points_with_radii),
        cmocka_unit_test(as_deep_as_the_radius),
#if DIM == 3
        cmocka_unit_test(another_unit_without_a_fan),
        cmocka_unit_test(faces_hardly_bent),
#endif
        cmocka_unit_test(capsules_in_the_smallest_unit),
        cmocka_unit_test(subnormal_numbers),
        cmocka_unit_test(numbers_near_overflow),
        cmocka_unit_test(far_from_the_origin),
        cmocka_unit_test(far_vertices),
        cmocka_unit_test(relative_to_a),
        cmocka_unit_test(moved_without_rounding),
    };
    return cmocka_run_group_tests_name("magnitudes of " VARIANT, tests, NULL, NULL);
}
