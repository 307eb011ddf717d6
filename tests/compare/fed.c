/* SPDX-License-Identifier: MIT */
#include "fed.h"
#include "../settle.h"
#include "along.h"

static void set_core(body *b, const peer_set *set)
{
    static const enum kind kinds[] = {CLOUD, BOX, SEGMENT, CYLINDER, CONE, ELLIPSOID, ORIGIN};
    start_body(b, kinds[set->core]);
    switch (b->kind) {
    case CLOUD:
        b->count = set->count;
        b->cloud = set->v;
        return;
    case SEGMENT:
        b->count = 2;
        memcpy(b->v, set->v, 2 * sizeof b->v[0]);
        return;
    case CYLINDER:
    case CONE:
        b->radius = set->size[0];
        b->half_length = set->size[1];
        return;
    default:
        memcpy(b->half, set->size, sizeof b->half);
    }
}

static void body_of_set(body *b, const peer_set *set)
{
    set_core(b, set);
    if (set->posed) {
        memcpy(b->pose.m, set->m, sizeof b->pose.m);
        memcpy(b->pose.p, set->p, sizeof b->pose.p);
    }
    bind(b);
    b->shape.radius = set->radius;
}

/* Of corners to the last bit, where they meet as where they are apart. */
static void find(fed *f)
{
    static body a, b;
    static truth t;
    static exact best;
    static int started;
    if (!started) {
        exact_start(&best);
        started = 1;
    }
    body_of_set(&a, &f->a);
    body_of_set(&b, &f->b);
    find_truth(&t, &a, &b, 1);
    if (!t.certified) {
        settle(&t, &best, &a, &b);
    }
    f->lower = t.lower;
    f->upper = t.upper;
    f->scale = t.scale;
}

static int find_separation(const fed *f, const double *normal, quad *separation)
{
    static body a, b;
    quad n[DIM];
    for (int i = 0; i < DIM; i++) {
        n[i] = (quad)normal[i];
    }
    if (!is_unit(n)) {
        return 0;
    }
    body_of_set(&a, &f->a);
    body_of_set(&b, &f->b);
    *separation = separation_along(&a, &b, n);
    return 1;
}

static void print(FILE *out, const fed *f, const char *query)
{
    static body a, b;
    body_of_set(&a, &f->a);
    body_of_set(&b, &f->b);
    fprintf(out, "{\"dim\": %d, \"query\": \"%s\", \"a\": ", DIM, query);
    print_body(out, &a);
    fprintf(out, ", \"b\": ");
    print_body(out, &b);
    fprintf(out, "}");
}

#define SPACE_(dim) fed_in_##dim
#define SPACE(dim) SPACE_(dim)
const fed_space SPACE(VARIANT_DIM) = {find, find_separation, print};
