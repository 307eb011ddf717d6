/* SPDX-License-Identifier: MIT */
/* Bodies that come, touch and leave again, and piles at rest: from step to step the distance changes by no more than
 * the body has moved, the normal does not flip, and each bracket holds. Cold, warm, and tight. */
#include "exact.h"
#include "faults.h"
#include "pairs.h"
#include "truth.h"

#define STEPS 1000
#define TRACKS 4
#define SMOOTH_TRUTHS 4 /* of round bodies the truth is sought at one step in so many: it costs a millisecond */
#define VALUE_ERROR 4.0 /* in u * scale, between bodies with corners, by default */
#define ROUND_WIDTH (VARIANT_FLOAT ? 16 * U : 1e-12)

enum mode { COLD, WARM, TIGHT, MODES };
static const char *const mode_name[MODES] = {"cold", "warm", "tight"};

static exact best;
static truth nearly;
static pair p;
static int exactly; /* whether best is the truth */
static int known;   /* whether the truth at hand is that of this step */
static faults found;
static const char *scene;

/* ---- the way of b ---- */

typedef struct track {
    double normal[DIM], side[DIM]; /* from a to b where they touch, and any direction */
    double from[DIM];              /* where b touches a */
    double far, slide, deep;       /* how far it starts, how far it slides across, how deep it goes */
    int geometric;                 /* comes nearer by halves, and not by equal steps */
} track;

static void place(const track *way, int step)
{
    double t = (step - STEPS / 2) / (STEPS / 2.0), off = way->far * fabs(t) - way->deep;
    if (way->geometric) {
        off = step == STEPS / 2 ? 0 : ldexp(way->far, -50) * pow(2, 50 * fabs(t));
    }
    for (int i = 0; i < DIM; i++) {
        p.b.pose.p[i] = (real)(way->from[i] + way->normal[i] * off + way->side[i] * way->slide * t);
    }
}

/* Brings b into contact with a along the normal between them, to within rounding. */
static void bring_together(draws *d, track *way)
{
    V(result) r;
    memset(&r, 0, sizeof r);
    unit(d, way->normal);
    stand_off(&p, way->normal, 0.1);
    bind_pair(&p);
    assert_true(V(distance)(&p.a.shape, &p.b.shape, NULL, &r) >= 0);
    for (int i = 0; i < DIM; i++) {
        way->normal[i] = (double)r.normal[i];
        way->from[i] = (double)p.b.pose.p[i] - way->normal[i] * (double)r.value;
    }
}

static void draw_track(draws *d, track *way, int kind)
{
    unit(d, way->side);
    way->far = between(d, 0.1, 2);
    way->slide = kind == 1 ? between(d, 0.1, 1) : 0;
    way->deep = kind == 2 ? 0.1 * way->far : 0;
    way->geometric = kind == 3;
}

/* ---- one step ---- */

static void fault_at(int step, enum mode mode, const V(result) * r, const char *what, double by)
{
    if (!note_fault(&found, what, by)) {
        return;
    }
    print_error("%s %s, %s, step %d: %s (%.3g)\n  status %d value %.17g lower %.17g upper %.17g; truth %.17g, scale "
                "%.3g\n  ",
                VARIANT, scene, mode_name[mode], step, what, by, r->status, (double)r->value, (double)r->lower,
                (double)r->upper, exactly ? mpf_get_d(best.distance) : (double)nearly.lower, (double)nearly.scale);
    print_case(stderr, "distance", &p.a, &p.b);
}

static void find_truths(int step)
{
    exactly = has_corners(&p.a) && has_corners(&p.b);
    known = exactly || step % SMOOTH_TRUTHS == 0;
    if (known) {
        find_truth(&nearly, &p.a, &p.b, 0);
    }
    if (exactly) {
        exact_distance(&best, &p.a, &p.b);
    }
}

static int is_apart(void) { return exactly ? exact_above(&best, 0) > 0 : nearly.lower > 0; }

static void check_bracket(int step, enum mode mode, const V(result) * r)
{
    double low = (double)r->lower, high = (double)r->upper;
    if (r->status < 0) {
        fault_at(step, mode, r, "an error for a good pair", r->status);
    } else if (exactly ? exact_above(&best, low) < 0 : positive(nearly.upper) < (quad)low) {
        fault_at(step, mode, r, "lower is above the truth", 0);
    } else if (exactly ? exact_above(&best, high) > 0 : positive(nearly.lower) > (quad)high) {
        fault_at(step, mode, r, "upper is below the truth", 0);
    } else if (!(r->lower <= r->value && r->value <= r->upper)) {
        fault_at(step, mode, r, "the value is outside its bracket", 0);
    }
}

static void check_verdict(int step, enum mode mode, const V(options) * o)
{
    V(result) r;
    memset(&r, 0, sizeof r);
    r.status = V(intersect)(&p.a.shape, &p.b.shape, o, &r);
    if (r.status < 0 || (r.lower > 0 && exactly && !is_apart()) || (r.lower > 0 && nearly.upper < 0) ||
        (r.upper < 0 && is_apart())) {
        fault_at(step, mode, &r, "a wrong verdict", 0);
    }
    if (mode == TIGHT && exactly && (r.lower > 0) != is_apart()) {
        fault_at(step, mode, &r, "the tight verdict leaves open what is exact", 0);
    }
}

static double between_normals(const V(result) * r, const V(result) * s)
{
    double sum = 0;
    for (int i = 0; i < DIM; i++) {
        sum += (double)r->normal[i] * (double)s->normal[i];
    }
    return sum;
}

/* How far the value may be from the truth. */
static double error_of(enum mode mode, const V(result) * r)
{
    if (mode == TIGHT && exactly) {
        return ulp_of((double)r->value);
    }
    return exactly ? VALUE_ERROR * U * (double)nearly.scale : ROUND_WIDTH * (double)nearly.scale;
}

/* The nearest point of the differences moves by no more than b does. It may turn by a right angle only where it is
 * nearer to the origin than that. */
static void check_change(int step, enum mode mode, const V(result) * r, const V(result) * before, double motion)
{
    double change = fabs((double)r->value - (double)before->value), now = (double)r->lower;
    double then = (double)before->lower, allowed = motion * (1 + 4 * U) + error_of(mode, r) + error_of(mode, before);
    if (!(change <= allowed)) {
        fault_at(step, mode, r, "the value jumps, in u * scale", (change - motion) / (U * (double)nearly.scale));
    }
    if (now > 0 && then > 0 && now * now + then * then > motion * motion && !(between_normals(r, before) > 0)) {
        fault_at(step, mode, r, "the normal flips, to a cosine of minus", -between_normals(r, before));
    }
}

static void follow(const track *way)
{
    static V(result) r[MODES], before[MODES];
    V(cache) cache;
    double at[DIM] = {0}, motion;
    memset(&cache, 0, sizeof cache);
    for (int step = 0; step <= STEPS; step++) {
        place(way, step);
        bind_pair(&p);
        find_truths(step);
        motion = 0;
        for (int i = 0; i < DIM; i++) {
            motion += ((double)p.b.pose.p[i] - at[i]) * ((double)p.b.pose.p[i] - at[i]);
            at[i] = (double)p.b.pose.p[i];
        }
        motion = sqrt(motion);
        for (int m = 0; m < MODES; m++) {
            enum mode mode = (enum mode)m;
            V(options) o = default_options();
            o.cache = mode == WARM ? &cache : NULL;
            o.tight = mode == TIGHT;
            before[m] = r[m];
            memset(&r[m], 0, sizeof r[m]);
            r[m].status = V(distance)(&p.a.shape, &p.b.shape, &o, &r[m]);
            if (known) {
                check_bracket(step, mode, &r[m]);
                check_verdict(step, mode, &o);
            }
            if (step > 0) {
                check_change(step, mode, &r[m], &before[m], motion);
            }
        }
    }
}

/* ---- scenes ---- */

static void report(void)
{
    print_faults(&found, scene);
    assert_int_equal(found.count, 0);
}

static void start_scene(const char *name)
{
    scene = name;
    memset(&found, 0, sizeof found);
}

/* state: which family */
static void of_family(void **state)
{
    enum family family = *(const enum family *)*state;
    start_scene(family_name[family]);
    for (int k = 0; k < TRACKS; k++) {
        draws d = draws_from(9, (uint64_t)family, (uint64_t)k);
        track way;
        draw_pair(&d, family, &p);
        bring_together(&d, &way);
        draw_track(&d, &way, k % 4);
        follow(&way);
    }
    report();
}

/* Face to face, and turned by 1e-3 to 1e-15. */
static void of_nearly_parallel_boxes(void **state)
{
    (void)state;
    start_scene("nearly parallel");
    for (int k = 0; k < 2 * TRACKS; k++) {
        draws d = draws_from(9, 100, (uint64_t)k);
        track way;
        memset(&p, 0, sizeof p);
        draw_parallel(&d, &p, 0.1, magnitude(&d, -15, -2));
        bring_together(&d, &way);
        draw_track(&d, &way, k % 4);
        follow(&way);
    }
    report();
}

/* They touch exactly, half the way. */
static void of_whole_coordinates(void **state)
{
    (void)state;
    start_scene("whole coordinates");
    for (int k = 0; k < 2 * TRACKS; k++) {
        draws d = draws_from(9, 101, (uint64_t)k);
        track way;
        memset(&way, 0, sizeof way);
        memset(&p, 0, sizeof p);
        if (k % 2) {
            draw_boxes_in_contact(&d, &p, way.normal);
        } else {
            draw_hulls_in_contact(&d, &p, way.normal);
        }
        draw_track(&d, &way, k / 2 % 4);
        follow(&way);
    }
    report();
}

/* Ten boxes, each 1e-9 above the one below: in float less than the last digit of where they stand, so that tight
 * answers alone can tell. */
static void of_piles(void **state)
{
    static body ten[10];
    (void)state;
    start_scene("piles");
    for (int k = 0; k < 50; k++) {
        draws d = draws_from(9, 102, (uint64_t)k);
        draw_tower(&d, ten);
        for (int i = 0; i < 9; i++) {
            memset(&p, 0, sizeof p);
            p.a = ten[i];
            p.b = ten[i + 1];
            bind_pair(&p);
            find_truths(0);
            for (int m = 0; m < MODES; m++) {
                V(options) o = default_options();
                V(result) r;
                double off;
                o.tight = m == TIGHT;
                memset(&r, 0, sizeof r);
                r.status = V(distance)(&p.a.shape, &p.b.shape, &o, &r);
                check_bracket(i, (enum mode)m, &r);
                check_verdict(i, (enum mode)m, &o);
                off = exact_error(&best, (double)r.value, (double)nearly.scale) / U;
                if (!(off <= VALUE_ERROR)) {
                    fault_at(i, (enum mode)m, &r, "the value is further off than it may be, in u * scale", off);
                }
                if (is_apart() && r.lower > 0 && !(r.normal[DIM - 1] > (real)0.999)) {
                    fault_at(i, (enum mode)m, &r, "the normal does not point up", (double)r.normal[DIM - 1]);
                }
                if (!VARIANT_FLOAT && is_apart() && !(r.lower > 0)) {
                    fault_at(i, (enum mode)m, &r, "a gap of 1e-9 is not seen", (double)r.upper);
                }
            }
        }
    }
    report();
}

static struct CMUnitTest family_test(enum family family)
{
    static enum family families[FAMILIES];
    families[family] = family;
    return (struct CMUnitTest){family_name[family], of_family, NULL, NULL, &families[family]};
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        family_test(BOXES),
        family_test(HULLS),
        family_test(EDGES),
        cmocka_unit_test(of_nearly_parallel_boxes),
        cmocka_unit_test(of_whole_coordinates),
        family_test(ROUNDED),
        family_test(ELLIPSOIDS),
#if DIM == 3
        family_test(CYLINDERS),
        family_test(CONES),
#endif
        cmocka_unit_test(of_piles),
    };
    exact_start(&best);
    return cmocka_run_group_tests_name("paths of " VARIANT, tests, NULL, NULL);
}
