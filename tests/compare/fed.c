/* SPDX-License-Identifier: MIT */
#include "fed.h"
#include "../truth.h"

static void body_of_set(body *b, const peer_set *set)
{
    start_body(b, CLOUD);
    b->count = set->count;
    b->cloud = set->v;
    bind(b);
    b->shape.radius = set->radius;
}

void find_fed_truth(fed *f)
{
    static body a, b;
    static truth t;
    body_of_set(&a, &f->a);
    body_of_set(&b, &f->b);
    find_truth(&t, &a, &b, 1);
    f->lower = t.lower;
    f->upper = t.upper;
    f->scale = t.scale;
}

void print_fed_case(FILE *out, const fed *f, const char *query)
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
