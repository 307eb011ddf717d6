/* SPDX-License-Identifier: MIT */
/* The library itself, asked through the same door as its peers. Compiled once for each variant. */
#include "../variant.h"
#include "peer.h"

typedef struct body {
    V(shape) shape;
    V(pose) pose;
    union {
        V(indexed_points) cloud;
        V(box) box;
        V(segment) segment;
        V(ellipsoid) ellipsoid;
#if DIM == 3
        V(cylinder) cylinder;
        V(cone) cone;
#endif
    } core;
    real *numbers;   /* of its points, in its own precision, */
    uint32_t *index; /*   and their index */
} body;

/* Clouds of so many points have an index, unless GJK_COMPARE_SCANS is set. */
#define INDEXED 32

static void copy(real *to, const double *from, int count)
{
    for (int i = 0; i < count; i++) {
        to[i] = (real)from[i];
    }
}

/* Mostly 80 bytes a point are enough. */
static void give_index(body *b)
{
    size_t bytes = b->core.cloud.points.count * 80, more;
    b->index = malloc(bytes);
    more = V(index_points)(&b->core.cloud, b->index, bytes);
    if (more > bytes) {
        free(b->index);
        b->index = malloc(more);
        V(index_points)(&b->core.cloud, b->index, more);
    }
}

static void set_points(body *b, const peer_set *set)
{
    V(indexed_points) *cloud = &b->core.cloud;
    cloud->points = (V(points)){NULL, (size_t)set->count, 0, 0, 0};
    b->numbers = malloc((size_t)set->count * DIM * sizeof *b->numbers);
    if (b->numbers) {
        copy(b->numbers, set->v, set->count * DIM);
        cloud->points.v = b->numbers;
        cloud->points.reach = V(points_reach)(&cloud->points);
    }
    if (b->numbers && set->count >= INDEXED && !getenv("GJK_COMPARE_SCANS")) {
        give_index(b);
    }
    b->shape.support = V(support_points);
}

static void set_core(body *b, const peer_set *set)
{
    switch (set->core) {
    case PEER_BOX:
        copy(b->core.box.half, set->size, DIM);
        b->shape.support = V(support_box);
        return;
    case PEER_SEGMENT:
        copy(b->core.segment.v[0], set->v, 2 * DIM);
        b->shape.support = V(support_segment);
        return;
#if DIM == 3
    case PEER_CYLINDER:
        b->core.cylinder.radius = (real)set->size[0];
        b->core.cylinder.half_length = (real)set->size[1];
        b->shape.support = V(support_cylinder);
        return;
    case PEER_CONE:
        b->core.cone.radius = (real)set->size[0];
        b->core.cone.half_length = (real)set->size[1];
        b->shape.support = V(support_cone);
        return;
#endif
    case PEER_ELLIPSOID:
        copy(b->core.ellipsoid.radii, set->size, DIM);
        b->shape.support = V(support_ellipsoid);
        return;
    case PEER_ORIGIN:
        b->shape.support = V(support_origin);
        return;
    default:
        set_points(b, set);
    }
}

static void place(body *b, const peer_set *set)
{
    b->shape.pose = NULL;
    if (set->posed) {
        copy(b->pose.m, set->m, DIM * DIM);
        copy(b->pose.p, set->p, DIM);
        b->shape.pose = &b->pose;
    }
}

static void *make(const peer_set *set)
{
    body *b = calloc(1, sizeof *b);
    if (b) {
        set_core(b, set);
        b->shape.data = &b->core;
        b->shape.radius = (real)set->radius;
        place(b, set);
    }
    return b;
}

/* With the same data, by which a cache knows it. */
static void *again(const void *made, const peer_set *set)
{
    body *b = calloc(1, sizeof *b);
    if (b) {
        b->shape = ((const body *)made)->shape;
        place(b, set);
    }
    return b;
}

static void discard(void *made)
{
    free(((body *)made)->numbers);
    free(((body *)made)->index);
    free(made);
}

/* ---- questions ---- */

static const char none[] = "none", tolerance[] = "tolerance", steps[] = "steps", tight[] = "tight";

static V(options) options_of(const peer *p, V(cache) * cache)
{
    V(options) o = {0};
    o.size = sizeof o;
    o.abs_tol = p->knob == tolerance ? (real)p->setting : 0;
    o.max_steps = p->knob == steps ? (uint32_t)p->setting : 0;
    o.tight = p->knob == tight;
    o.cache = cache;
    return o;
}

static void tell(const V(result) * r, peer_answer *out)
{
    out->lower = (double)r->lower;
    out->upper = (double)r->upper;
    out->supports = r->supports;
}

typedef int ask_fn(const V(shape) *, const V(shape) *, const V(options) *, V(result) *);

static int ask(ask_fn *fn, const peer *p, const body *a, const body *b, void *memory, V(result) * r)
{
    V(options) o = options_of(p, memory);
    return fn(&a->shape, &b->shape, p->usual && !memory ? NULL : &o, r) < 0;
}

/* Its value is the distance, or below 0 the depth. */
static int measure(ask_fn *fn, const peer *p, const body *a, const body *b, void *memory, peer_answer *out)
{
    V(result) r;
    if (ask(fn, p, a, b, memory, &r)) {
        return 1;
    }
    out->meet = !(r.value > 0);
    out->distance = (double)r.value;
    out->depth = -(double)r.value;
    for (int i = 0; i < DIM; i++) {
        out->normal[i] = (double)r.normal[i];
    }
    tell(&r, out);
    return 0;
}

static int distance(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    return measure(V(distance), p, a, b, memory, out);
}

static int penetration(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    return measure(V(penetration), p, a, b, memory, out);
}

static int intersect(const peer *p, const void *a, const void *b, void *memory, peer_answer *out)
{
    V(result) r;
    if (ask(V(intersect), p, a, b, memory, &r)) {
        return 1;
    }
    out->meet = r.lower > 0 ? 0 : r.upper <= 0 ? 1 : -1;
    tell(&r, out);
    return 0;
}

/* Each along a direction of its own. */
static void supports(const void *a, const void *b, int count)
{
    static volatile real sink;
    real dir[3] = {1, (real)0.25, (real)-0.5}, x[DIM];
    for (int k = 0; k < count; k++) {
        const V(shape) *s = &((const body *)(k % 2 ? b : a))->shape;
        s->support(s->data, dir, x);
        sink = x[0];
        dir[0] = -dir[1];
        dir[1] = dir[2] + x[0] * (real)1e-3;
        dir[2] = (real)(k % 7 - 3);
    }
    (void)sink;
}

/* ---- settings ---- */

#define MOST 32
#define TOLERANCES (VARIANT_FLOAT ? 6 : 9)

static peer all[MOST];
static int count_of_all;

static peer *add(const char *knob, double setting)
{
    peer *p = &all[count_of_all++];
    memset(p, 0, sizeof *p);
    p->library = VARIANT;
    p->knob = knob;
    p->setting = setting;
    p->version = PEER_VERSION;
    p->how[DISTANCE] = VARIANT "_distance, no options";
    p->how[INTERSECT] = VARIANT "_intersect, no options";
    p->how[PENETRATION] = VARIANT "_penetration, no options: 64 corners on the stack";
    p->dim = DIM;
    p->single = VARIANT_FLOAT;
    p->proves = 1;
    p->cores = ALL_CORES;
    p->poses = p->radii = 1;
    p->make = make;
    p->discard = discard;
    p->again = again;
    p->query[DISTANCE] = distance;
    p->query[PENETRATION] = penetration;
    p->supports = supports;
    return p;
}

const peer *gjk_peers(int *count)
{
    static const double tolerances[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-12};
    static const double most_steps[] = {2, 4, 8, 16, 32};
    peer *p;
    count_of_all = 0;
    for (int warm = 0; warm < 2; warm++) {
        p = add(none, 0);
        p->usual = 1;
        p->query[INTERSECT] = intersect;
        p->memory = warm ? sizeof(V(cache)) : 0;
    }
    for (int k = 0; k < TOLERANCES; k++) {
        add(tolerance, tolerances[k]);
    }
    for (int k = 0; k < (int)(sizeof most_steps / sizeof *most_steps); k++) {
        add(steps, most_steps[k])->query[INTERSECT] = intersect;
    }
    add(tight, 1);
    *count = count_of_all;
    return all;
}
