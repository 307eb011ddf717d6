/* SPDX-License-Identifier: MIT */
#include "pair_file.h"

#include <stdlib.h>
#include <string.h>

static void check(int fine, const char *what)
{
    if (!fine) {
        fprintf(stderr, "the pairs cannot be %s\n", what);
        exit(2);
    }
}

static int numbers_of(const peer_set *s, int dim) { return s->count * dim; }

void write_block(FILE *file, const pair_block *block) { check(fwrite(block, sizeof *block, 1, file) == 1, "written"); }

static void write_set(FILE *file, int dim, const peer_set *s)
{
    int32_t whole[4] = {(int32_t)s->core, s->count, s->posed, 0};
    size_t count = (size_t)numbers_of(s, dim);
    check(fwrite(whole, sizeof whole, 1, file) == 1 && fwrite(s->size, sizeof s->size, 1, file) == 1 &&
              fwrite(s->m, sizeof s->m, 1, file) == 1 && fwrite(s->p, sizeof s->p, 1, file) == 1 &&
              fwrite(&s->radius, sizeof s->radius, 1, file) == 1 && fwrite(s->v, sizeof *s->v, count, file) == count,
          "written");
}

void write_pair(FILE *file, int dim, const peer_set *a, const peer_set *b)
{
    write_set(file, dim, a);
    write_set(file, dim, b);
}

int read_block(FILE *file, pair_block *block)
{
    size_t bytes = fread(block, 1, sizeof *block, file);
    check(bytes == 0 || bytes == sizeof *block, "read");
    return bytes != 0;
}

/* Where it has numbers of its own, they are to be freed. */
static double *read_set(FILE *file, int dim, peer_set *s)
{
    int32_t whole[4];
    size_t count;
    double *numbers;
    memset(s, 0, sizeof *s);
    check(fread(whole, sizeof whole, 1, file) == 1 && whole[0] >= PEER_POINTS && whole[0] <= PEER_ORIGIN &&
              whole[1] >= 0,
          "read");
    s->core = (enum peer_core)whole[0];
    s->count = whole[1];
    s->posed = whole[2];
    count = (size_t)numbers_of(s, dim);
    s->v = numbers = malloc((count + 1) * sizeof *numbers);
    check(numbers && fread(s->size, sizeof s->size, 1, file) == 1 && fread(s->m, sizeof s->m, 1, file) == 1 &&
              fread(s->p, sizeof s->p, 1, file) == 1 && fread(&s->radius, sizeof s->radius, 1, file) == 1 &&
              fread(numbers, sizeof *numbers, count, file) == count,
          "read");
    return numbers;
}

void read_pair(FILE *file, int dim, fed *f)
{
    memset(f, 0, sizeof *f);
    f->dim = dim;
    f->numbers[0] = read_set(file, dim, &f->a);
    f->numbers[1] = read_set(file, dim, &f->b);
}
