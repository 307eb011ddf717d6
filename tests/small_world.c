/* SPDX-License-Identifier: MIT */
/* A world so small that it can be asked whole: all sets of corners of the unit cube, in the plane of the points of a
 * grid of three by three, beside each other at all whole places near by. Faces lie in one plane there, edges on one
 * line, corners on one spot, and sets are flat, as often as not. A pair stands for those that turning, reflecting and
 * changing places make of it. How far apart they are, or how deep in each other, is known in whole numbers. */
#include "faults.h"

#define VALUE_ERROR 4.0 /* in u * span */
#define SIDE (5 - DIM)  /* points along a side of the grid */
#define POINTS (DIM == 2 ? 9 : 8)
#define SETS (1 << POINTS)
#define FAR (4 - DIM)  /* b stands so far off along each axis, at most */
#define DIFFERENCES 27 /* of two points of the grid, at most */
#define DIRECTIONS 512 /* of facets */
#define TURNS (DIM == 2 ? 8 : 48)
#define PLACES (DIM == 2 ? 25 : 27)
#define SCENES ((size_t)PLACES * (DIM == 2 ? 24292 : 2573)) /* pairs that others do not stand for, at all places */

typedef struct point {
    int x[DIM];
} point;

static point difference(point p, point q)
{
    for (int i = 0; i < DIM; i++) {
        p.x[i] -= q.x[i];
    }
    return p;
}

static point times(point p, int by)
{
    for (int i = 0; i < DIM; i++) {
        p.x[i] *= by;
    }
    return p;
}

static int product(point p, point q)
{
    int sum = 0;
    for (int i = 0; i < DIM; i++) {
        sum += p.x[i] * q.x[i];
    }
    return sum;
}

static point grid_point(int k)
{
    point p;
    for (int i = 0; i < DIM; i++, k /= SIDE) {
        p.x[i] = k % SIDE;
    }
    return p;
}

/* ---- turning the grid ---- */

/* The axes change places, and signs. */
typedef struct turn {
    int axis[DIM], sign[DIM];
} turn;

static turn nth_turn(int n)
{
    turn t;
    int left[] = {0, 1, 2};
    for (int i = 0; i < DIM; i++, n /= 2) {
        t.sign[i] = n % 2 ? -1 : 1;
    }
    for (int i = 0; i < DIM; i++) {
        int k = n % (DIM - i);
        n /= DIM - i;
        t.axis[i] = left[k];
        left[k] = left[DIM - 1 - i];
    }
    return t;
}

static point turned(const turn *t, point p)
{
    point r;
    for (int i = 0; i < DIM; i++) {
        r.x[i] = t->sign[i] * p.x[t->axis[i]];
    }
    return r;
}

static int number_of(point p)
{
    int k = 0;
    for (int i = DIM - 1; i >= 0; i--) {
        k = SIDE * k + p.x[i];
    }
    return k;
}

/* About the grid's middle. */
static int turned_set(const turn *t, int set)
{
    int r = 0;
    for (int k = 0; k < POINTS; k++) {
        point p = turned(t, grid_point(k));
        for (int i = 0; i < DIM; i++) {
            p.x[i] += t->sign[i] < 0 ? SIDE - 1 : 0;
        }
        r |= (set >> k & 1) << number_of(p);
    }
    return r;
}

/* The set that stands for it and those that it can be turned into. */
static int first_alike(int set)
{
    int first = set;
    for (int n = 0; n < TURNS; n++) {
        const turn t = nth_turn(n);
        const int other = turned_set(&t, set);
        first = other < first ? other : first;
    }
    return first;
}

/* ---- the truth ---- */

/* The points of b - a, and of its hull the corners and the directions square to facets, inward; where it is flat, all
 * points, and those square to two edges. */
typedef struct hull {
    point at[DIFFERENCES], facet[DIRECTIONS];
    int count, facets, flat;
} hull;

/* height / sqrt(square) */
typedef struct separation {
    long height, square;
} separation;

static int lowest(const point *at, int count, point d)
{
    int least = product(at[0], d);
    for (int k = 1; k < count; k++) {
        int height = product(at[k], d);
        least = height < least ? height : least;
    }
    return least;
}

static int is_among(const point *all, int count, point p)
{
    for (int k = 0; k < count; k++) {
        if (memcmp(&all[k], &p, sizeof p) == 0) {
            return 1;
        }
    }
    return 0;
}

/* Without what its parts have in common. */
static point shortest(point d)
{
    for (int by = 2; by <= 16; by++) {
        for (;;) {
            int divides = 1;
            for (int i = 0; i < DIM; i++) {
                divides &= d.x[i] % by == 0;
            }
            if (!divides) {
                break;
            }
            for (int i = 0; i < DIM; i++) {
                d.x[i] /= by;
            }
        }
    }
    return d;
}

static void add_facet(hull *h, point d, point on)
{
    if (product(d, d) == 0) {
        return;
    }
    d = shortest(d);
    if (lowest(h->at, h->count, d) == product(on, d) && !is_among(h->facet, h->facets, d)) {
        assert_true(h->facets < DIRECTIONS);
        h->facet[h->facets++] = d;
    }
}

#if DIM == 2
static void find_facets(hull *h)
{
    for (int i = 0; i < h->count; i++) {
        for (int j = 0; j < h->count; j++) {
            const point e = difference(h->at[j], h->at[i]), d = {{-e.x[1], e.x[0]}};
            add_facet(h, d, h->at[i]);
        }
    }
}

static long volume(point p, point q, point r)
{
    (void)r;
    return (long)p.x[0] * q.x[1] - (long)p.x[1] * q.x[0];
}
#else
static point across(point p, point q)
{
    const point r = {
        {p.x[1] * q.x[2] - p.x[2] * q.x[1], p.x[2] * q.x[0] - p.x[0] * q.x[2], p.x[0] * q.x[1] - p.x[1] * q.x[0]}};
    return r;
}

static void find_facets(hull *h)
{
    for (int i = 0; i < h->count; i++) {
        for (int j = i + 1; j < h->count; j++) {
            for (int k = j + 1; k < h->count; k++) {
                const point d = across(difference(h->at[j], h->at[i]), difference(h->at[k], h->at[i]));
                add_facet(h, d, h->at[i]);
                add_facet(h, times(d, -1), h->at[i]);
            }
        }
    }
}

static long volume(point p, point q, point r) { return product(across(p, q), r); }
#endif

/* Three directions, in the plane two, are not in one plane. */
static int span_all(const point *d, int count)
{
    for (int i = 0; i < count; i++) {
        for (int j = i + 1; j < count; j++) {
            for (int k = DIM == 2 ? j : j + 1; k < (DIM == 2 ? j + 1 : count); k++) {
                if (volume(d[i], d[j], d[k]) != 0) {
                    return 1;
                }
            }
        }
    }
    return 0;
}

/* A corner is where facets meet that leave no way open. */
static int is_corner(const hull *h, point p)
{
    static point here[DIRECTIONS];
    int count = 0;
    for (int k = 0; k < h->facets; k++) {
        if (lowest(h->at, h->count, h->facet[k]) == product(h->facet[k], p)) {
            here[count++] = h->facet[k];
        }
    }
    return span_all(here, count);
}

static void keep_corners(hull *h)
{
    point kept[DIFFERENCES];
    int count = 0;
    for (int k = 0; k < h->count; k++) {
        if (is_corner(h, h->at[k])) {
            kept[count++] = h->at[k];
        }
    }
    memcpy(h->at, kept, sizeof kept);
    h->count = count;
}

static void make_hull(hull *h, int a, int b)
{
    point ways[DIFFERENCES] = {{{0}}};
    h->count = h->facets = 0;
    for (int i = 0; i < POINTS; i++) {
        for (int j = 0; j < POINTS; j++) {
            const point p = difference(grid_point(j), grid_point(i));
            if (a >> i & 1 && b >> j & 1 && !is_among(h->at, h->count, p)) {
                h->at[h->count++] = p;
            }
        }
    }
    for (int k = 0; k < h->count; k++) {
        ways[k] = difference(h->at[k], h->at[0]);
    }
    h->flat = !span_all(ways, h->count);
    find_facets(h);
    if (!h->flat) {
        keep_corners(h);
    }
}

/* How far all of the set, moved by that much, lies along d at least, if that is farther. */
static void lie_beyond(separation *s, const point *at, int count, point d)
{
    const separation t = {lowest(at, count, d), product(d, d)};
    const long mine = t.height * labs(t.height) * s->square, other = s->height * labs(s->height) * t.square;
    if (t.square > 0 && (s->square == 0 || mine > other)) {
        *s = t;
    }
}

/* Of b - a, moved by that: the nearest point is square to a facet, to an edge, or is a corner; and so it is farthest
 * along some such direction. A flat set is not deep. */
static separation find_truth_at(const hull *h, point by)
{
    point at[DIFFERENCES];
    separation s = {0, 0};
    for (int k = 0; k < h->count; k++) {
        at[k] = difference(h->at[k], times(by, -1));
    }
    for (int k = 0; k < h->facets; k++) {
        lie_beyond(&s, at, h->count, h->facet[k]);
    }
    if (!h->flat && s.height <= 0) {
        return s;
    }
    if (h->flat && (s.square == 0 || s.height < 0)) {
        s = (separation){0, 1};
    }
    for (int i = 0; i < h->count; i++) {
        lie_beyond(&s, at, h->count, at[i]);
        for (int j = 0; j < i; j++) {
            const point e = difference(at[j], at[i]);
            lie_beyond(&s, at, h->count, difference(times(at[i], product(e, e)), times(e, product(at[i], e))));
        }
    }
    return s;
}

/* ---- asking ---- */

enum clothing { READY_MADE, POSED, CALLED };

/* Its corners in its own coordinates, and how it is asked. */
typedef struct dressed {
    real v[POINTS][DIM];
    V(points) cloud;
    V(segment) segment;
#if DIM == 3
    V(triangle) triangle;
#endif
    V(box) box;
    V(pose) pose;
    V(shape) shape;
    point at[POINTS]; /* and where they stand */
    int count;
} dressed;

static real call(const void *data, const real dir[DIM], real x[DIM])
{
    const dressed *s = data;
    double most = -1e9, reach = 0;
    for (int k = 0; k < s->count; k++) {
        double height = 0, square = 0;
        for (int i = 0; i < DIM; i++) {
            height += (double)s->v[k][i] * (double)dir[i];
            square += (double)s->v[k][i] * (double)s->v[k][i];
        }
        if (height > most) {
            most = height;
            memcpy(x, s->v[k], sizeof s->v[k]);
        }
        reach = fmax(reach, square);
    }
    return (real)(sqrt(reach) * (1 + 8 * U));
}

static void take_cloud(dressed *s)
{
    s->cloud = (V(points)){s->v[0], (size_t)s->count, 0, 0, 0};
    s->cloud.reach = V(points_reach)(&s->cloud);
    s->shape.support = V(support_points);
    s->shape.data = &s->cloud;
}

static void take_ready_made(dressed *s)
{
    take_cloud(s);
    if (s->count == 2) {
        memcpy(s->segment.v, s->v, sizeof s->segment.v);
        s->shape.support = V(support_segment);
        s->shape.data = &s->segment;
    }
#if DIM == 3
    if (s->count == 3) {
        memcpy(s->triangle.v, s->v, sizeof s->triangle.v);
        s->shape.support = V(support_triangle);
        s->shape.data = &s->triangle;
    }
#endif
    if (s->count == POINTS) {
        for (int i = 0; i < DIM; i++) {
            s->box.half[i] = (real)(SIDE - 1) / 2;
            s->pose.p[i] = s->box.half[i] + (real)s->at[0].x[i];
            s->pose.m[i * DIM + i] = 1;
        }
        s->shape.support = V(support_box);
        s->shape.data = &s->box;
        s->shape.pose = &s->pose;
    }
}

/* The grid's points in the set, moved by that much; as they stand, or turned and set there by a pose. */
static void dress(dressed *s, int set, point by, enum clothing how, int n)
{
    const turn t = nth_turn(how == READY_MADE ? 0 : n % TURNS);
    memset(&s->pose, 0, sizeof s->pose);
    memset(&s->shape, 0, sizeof s->shape);
    s->count = 0;
    for (int k = 0; k < POINTS; k++) {
        if (!(set >> k & 1)) {
            continue;
        }
        const point p = grid_point(k), own = turned(&t, p);
        s->at[s->count] = difference(p, times(by, -1));
        for (int i = 0; i < DIM; i++) {
            s->v[s->count][i] = (real)(how == READY_MADE ? s->at[s->count].x[i] : own.x[i]);
        }
        s->count++;
    }
    if (how == READY_MADE) {
        take_ready_made(s);
        return;
    }
    for (int i = 0; i < DIM; i++) {
        s->pose.m[t.axis[i] * DIM + i] = (real)t.sign[i];
        s->pose.p[i] = (real)by.x[i];
    }
    take_cloud(s);
    s->shape.pose = &s->pose;
    if (how == CALLED) {
        s->shape.support = call;
        s->shape.data = s;
    }
}

/* ---- what must hold ---- */

/* How all are asked: in which clothing, whether with what the answer of the place before has left, to the last place,
 * in so few steps, and with radii that together are so large. */
typedef struct manner {
    enum clothing clothing;
    int warm, tight, max_steps, radii;
} manner;

static dressed a, b;
static faults found;
static double truth, span;
static manner how;
static V(options) options;
static V(cache) of_distance, of_meeting, of_depth;

static void hold(const char *what, const V(result) * r, int holds, double by)
{
    if (holds || !note_fault(&found, what, by)) {
        return;
    }
    print_error("%s: %s (%.3g)\n  value %.17g in %.17g .. %.17g; truth %.17g, status %d, steps %d\n", VARIANT, what, by,
                (double)r->value, (double)r->lower, (double)r->upper, truth, r->status, r->steps);
    for (int side = 0; side < 2; side++) {
        const dressed *s = side ? &b : &a;
        print_error("  %s, clothing %d:", side ? "b" : "a", (int)how.clothing);
        for (int k = 0; k < s->count; k++) {
            for (int i = 0; i < DIM; i++) {
                print_error("%s%d", i ? "," : " ", s->at[k].x[i]);
            }
        }
        print_error("\n");
    }
}

/* The least height of b - a along the normal. */
static double height_along(const real normal[DIM])
{
    double of_a = -1e9, of_b = 1e9;
    for (int side = 0; side < 2; side++) {
        const dressed *s = side ? &b : &a;
        for (int k = 0; k < s->count; k++) {
            double height = 0;
            for (int i = 0; i < DIM; i++) {
                height += (double)normal[i] * s->at[k].x[i];
            }
            of_a = side ? of_a : fmax(of_a, height);
            of_b = side ? fmin(of_b, height) : of_b;
        }
    }
    return of_b - of_a;
}

static double apart(const V(result) * r)
{
    double square = 0;
    for (int i = 0; i < DIM; i++) {
        const double x = (double)r->point_b[i] - (double)r->point_a[i];
        square += x * x;
    }
    return sqrt(square);
}

/* Of the number that is asked for, which is known to a rounding or two of a double, radii and all. */
static void check_bracket(const V(result) * r, double number)
{
    const double slip = (fabs(number) + 2 * how.radii) * 0x1p-52, unit = U * span;
    hold("the lower bound is above the truth", r, (double)r->lower <= number + slip,
         ((double)r->lower - number) / unit);
    hold("the upper bound is below the truth", r, (double)r->upper >= number - slip,
         (number - (double)r->upper) / unit);
    hold("the normal does not realise the lower bound", r,
         r->lower == 0 || height_along(r->normal) >= (double)r->lower - VALUE_ERROR * unit,
         ((double)r->lower - height_along(r->normal)) / unit);
}

static void check_number(const V(result) * r, double number)
{
    const double unit = U * span, off = fabs((double)r->value - number) / unit;
    const double between = fabs(apart(r) - fabs(number)) / unit;
    check_bracket(r, number);
    if (how.max_steps > 0) {
        return;
    }
    hold("a limit", r, r->status == GJK_OK || r->status == GJK_FLOOR, 0);
    hold("the value is off", r, off <= VALUE_ERROR, off);
    hold("the points are as far from each other as they should not be", r, between <= VALUE_ERROR, between);
    if (how.tight) {
        const double place = 2 * U * fabs(number), wide = (double)r->upper - (double)r->lower;
        hold("the value is off in its last place", r, off * unit <= place, off * unit / place);
        hold("the bracket is wider than two last places", r, wide <= 2 * place, wide / place);
    }
}

static void check_verdict(const V(result) * r)
{
    check_bracket(r, truth);
    if (how.max_steps > 0) {
        return;
    }
    hold("apart, and not told", r, !(truth > 0) || (r->lower > 0 && r->status == GJK_DECIDED), 0);
    hold("overlapping, and not told", r, !(truth < 0) || (r->upper <= 0 && r->status == GJK_DECIDED), 0);
    hold("touching, and not told", r, truth != 0 || how.clothing == CALLED || how.radii > 0 || r->upper == 0,
         (double)r->upper);
}

static void ask(const separation *s)
{
    V(result) r;
    V(options) *const o = &options;
    truth = (double)s->height / sqrt((double)s->square) - how.radii;
    memset(&r, 0, sizeof r);
    o->cache = how.warm ? &of_distance : NULL;
    hold("distance: refused", &r, V(distance)(&a.shape, &b.shape, o, &r) >= 0, r.status);
    check_number(&r, fmax(truth, 0));
    o->cache = how.warm ? &of_meeting : NULL;
    hold("intersect: refused", &r, V(intersect)(&a.shape, &b.shape, o, &r) >= 0, r.status);
    check_verdict(&r);
    o->cache = how.warm ? &of_depth : NULL;
    hold("penetration: refused", &r, V(penetration)(&a.shape, &b.shape, o, &r) >= 0, r.status);
    check_number(&r, truth);
}

/* ---- the world ---- */

/* Two sets, b moved by that, and what is true of them. */
typedef struct scene {
    int of_a, of_b;
    point by;
    separation truth;
    double span;
} scene;

static scene *world;
static size_t scenes;

static double span_of(const hull *h, point by)
{
    double most = 1;
    for (int k = 0; k < h->count; k++) {
        const point p = difference(h->at[k], times(by, -1));
        most = fmax(most, sqrt((double)product(p, p)));
    }
    return most;
}

static point nth_place(int n)
{
    point p;
    for (int i = 0; i < DIM; i++, n /= 2 * FAR + 1) {
        p.x[i] = n % (2 * FAR + 1) - FAR;
    }
    return p;
}

/* All places of a pair, one after another. */
static int make_world(void **state)
{
    static hull h;
    static int first[SETS];
    (void)state;
    world = malloc(SCENES * sizeof *world);
    for (int set = 1; set < SETS; set++) {
        first[set] = first_alike(set);
    }
    for (int of_a = 1; world && of_a < SETS; of_a++) {
        for (int of_b = 1; of_b < SETS; of_b++) {
            if (first[of_a] < of_a || first[of_b] < of_a) {
                continue; /* others stand for them */
            }
            make_hull(&h, of_a, of_b);
            for (int n = 0; n < PLACES; n++, scenes++) {
                const point by = nth_place(n);
                if (scenes < SCENES) {
                    world[scenes] = (scene){of_a, of_b, by, find_truth_at(&h, by), span_of(&h, by)};
                }
            }
        }
    }
    return scenes != SCENES;
}

static int end_world(void **state)
{
    (void)state;
    free(world);
    return 0;
}

static void ask_all(manner in)
{
    const point here = {{0}};
    memset(&found, 0, sizeof found);
    how = in;
    options = default_options();
    options.tight = (uint32_t)how.tight;
    options.max_steps = (uint32_t)how.max_steps;
    for (const scene *s = world; s < world + SCENES; s++) {
        if ((s - world) % PLACES == 0) {
            memset(&of_distance, 0, sizeof of_distance);
            memset(&of_meeting, 0, sizeof of_meeting);
            memset(&of_depth, 0, sizeof of_depth);
            dress(&a, s->of_a, here, how.clothing, s->of_a);
        }
        dress(&b, s->of_b, s->by, how.clothing, s->of_b);
        a.shape.radius = (real)how.radii / 4;
        b.shape.radius = (real)how.radii - a.shape.radius;
        span = s->span + how.radii;
        ask(&s->truth);
    }
    print_faults(&found, "small world");
    assert_int_equal(found.count, 0);
}

#define MANNER(name, ...)                                                                                              \
    static void name(void **state)                                                                                     \
    {                                                                                                                  \
        (void)state;                                                                                                   \
        ask_all((manner){.clothing = __VA_ARGS__});                                                                    \
    }
MANNER(ready_made, READY_MADE, .warm = 0)
MANNER(posed, POSED, .warm = 0)
MANNER(called, CALLED, .warm = 0)
MANNER(warm, POSED, .warm = 1)
MANNER(called_warm, CALLED, .warm = 1)
MANNER(to_the_last_place, POSED, .tight = 1)
MANNER(in_one_step, READY_MADE, .max_steps = 1)
MANNER(in_three_steps, POSED, .max_steps = 3)
MANNER(called_in_two_steps, CALLED, .warm = 1, .max_steps = 2)
MANNER(rounded, POSED, .radii = 1)
MANNER(called_rounded, CALLED, .radii = 1)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ready_made),  cmocka_unit_test(posed),          cmocka_unit_test(called),
        cmocka_unit_test(warm),        cmocka_unit_test(called_warm),    cmocka_unit_test(to_the_last_place),
        cmocka_unit_test(in_one_step), cmocka_unit_test(in_three_steps), cmocka_unit_test(called_in_two_steps),
        cmocka_unit_test(rounded),     cmocka_unit_test(called_rounded)};
    return cmocka_run_group_tests_name("the small world of " VARIANT, tests, make_world, end_world);
}
