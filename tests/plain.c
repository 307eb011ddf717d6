/* SPDX-License-Identifier: MIT */
/* What the everyday answer rests on, from inside: a variant is compiled in. The value of a distance comes from one pair
 * of points; what rounding took from it, and its length, are held against 113 bits. No bound depends on them, so no
 * bracket would show that they are worse than they should be. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>
#include "quad.h"

#define GJK_ALONE
#if VARIANT_DIM == 2 && VARIANT_FLOAT
#include "../src/gjk2f.c"
#elif VARIANT_DIM == 2
#include "../src/gjk2.c"
#elif VARIANT_FLOAT
#include "../src/gjk3f.c"
#else
#include "../src/gjk3.c"
#endif

#define PAIRS 20000

static uint64_t state_of_draws;

/* splitmix64 */
static double any_between(double least, double most)
{
    uint64_t z = state_of_draws += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return least + (most - least) * ((double)(z >> 11) / 0x1p53);
}

static real any_real(double least, double most) { return (real)any_between(least, most); }

static box boxes[2];
static pose poses[2];
static shape shapes[2];
static search q;

/* Two boxes, each of a size of its own, out in the world, under maps that are no rotations; or under none. */
static int open_pair(void)
{
    for (int k = 0; k < 2; k++) {
        double size = pow(10, any_between(-3, 3));
        shapes[k] = (shape){pub(support_box), &boxes[k], any_between(0, 4) < 3 ? &poses[k] : NULL, 0};
        for (int i = 0; i < DIM; i++) {
            boxes[k].half[i] = any_real(size / 2, size);
            poses[k].p[i] = any_real(-100, 100);
        }
        for (int i = 0; i < DIM * DIM; i++) {
            poses[k].m[i] = any_real(-1, 1);
        }
    }
    q.d.calls = 0;
    if (!open_listed(&q, &shapes[0], &shapes[1], NULL)) {
        return 0;
    }
    know_offset(&q.d, &shapes[0], &shapes[1]);
    return 1;
}

/* Somewhere in the box, times its grain. */
static vec draw_point(const box *b, real grain, vec *low)
{
    vec x;
    for (int i = 0; i < DIM; i++) {
        x.c[i] = any_real(-1, 1) * b->half[i] * grain;
        low->c[i] = any_real(-1, 1) * UNIT * x.c[i];
    }
    return x;
}

static closest draw_closest(void)
{
    closest p;
    p.x = draw_point(&boxes[0], q.d.a.grain, &p.x_low);
    p.y = draw_point(&boxes[1], q.d.b.grain, &p.y_low);
    p.w = sub(place(&q.d.a, mul(p.x, 1 / q.d.a.grain)), add(place(&q.d.b, mul(p.y, 1 / q.d.b.grain)), q.d.c));
    return p;
}

/* Coordinate i of the body's point in the frame. */
static quad position(const shape *s, vec x, vec low, int i)
{
    quad sum = 0;
    if (!s->pose) {
        return (quad)x.c[i] + (quad)low.c[i];
    }
    for (int j = 0; j < DIM; j++) {
        sum += (quad)s->pose->m[DIM * i + j] * ((quad)x.c[j] + (quad)low.c[j]);
    }
    return sum;
}

static quad offset_of(int i)
{
    quad b = shapes[1].pose ? (quad)poses[1].p[i] : 0, a = shapes[0].pose ? (quad)poses[0].p[i] : 0;
    return (b - a) * (quad)q.d.scale;
}

/* The rest of a product is 2^-GRID of it, and rounds a few times. */
static void what_rounding_took(void **state)
{
    const quad most = 5 * (quad)UNIT / (quad)((uint64_t)1 << GRID);
    double worst = 0;
    (void)state;
    state_of_draws = 1;
    for (int k = 0; k < PAIRS; k++) {
        closest p;
        vec low;
        assert_true(open_pair());
        p = draw_closest();
        low = lost_of_pair(&q.d, &p);
        for (int i = 0; i < DIM; i++) {
            quad truth = position(&shapes[0], p.x, p.x_low, i) - position(&shapes[1], p.y, p.y_low, i) - offset_of(i);
            quad error = quad_abs((quad)p.w.c[i] + (quad)low.c[i] - truth);
            worst = fmax(worst, (double)(error / most));
        }
    }
    printf("error at most %.2f of what is allowed\n", worst);
    assert_true(worst <= 1 && worst > 0);
}

static void the_length(void **state)
{
    double worst = 0;
    (void)state;
    state_of_draws = 1;
    for (int k = 0; k < PAIRS; k++) {
        vec w, low;
        quad square = 0, error;
        twin l;
        for (int i = 0; i < DIM; i++) {
            w.c[i] = any_real(0.1, 1) * (real)(any_between(-1, 1) < 0 ? -1 : 1);
            low.c[i] = any_real(-1, 1) * 4 * UNIT;
            square += ((quad)w.c[i] + (quad)low.c[i]) * ((quad)w.c[i] + (quad)low.c[i]);
        }
        l = length_to_twice(w, low);
        error = quad_abs((quad)l.high + (quad)l.low - quad_sqrt(square));
        worst = fmax(worst, (double)(error / ((quad)UNIT * (quad)UNIT)));
    }
    printf("length: error at most %.1f u^2\n", worst);
    assert_true(worst <= 128 && worst > 0); /* low has 4u, its square over twice the least length 80 u^2 */
}

static quad coordinate(int corner, int i) { return (quad)q.s.slot[corner].w.c[i]; }

/* How far the origin is from the plane of the facet opposite that corner, on its side; squared, with that sign. */
static quad height_over(int corner)
{
    quad to[DIM + 1][DIM], n[DIM], size = 0, height = 0, side = 0, h;
    int at = 0, first = corner == 0 ? 1 : 0;
    for (int k = 0; k <= DIM; k++) {
        for (int i = 0; i < DIM && k != corner && k != first; i++) {
            to[at][i] = coordinate(k, i) - coordinate(first, i);
        }
        at += k != corner && k != first;
    }
#if DIM == 2
    n[0] = -to[0][1];
    n[1] = to[0][0];
#else
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = to[0][j] * to[1][k] - to[0][k] * to[1][j];
    }
#endif
    for (int i = 0; i < DIM; i++) {
        size += n[i] * n[i];
        height -= n[i] * coordinate(first, i);
        side += n[i] * (coordinate(corner, i) - coordinate(first, i));
    }
    h = height * height / size;
    return (height < 0) == (side < 0) ? h : -h;
}

/* Simplices that hold the origin, narrow by any power of two, the origin near a facet or a corner. */
static int draw_simplex(void)
{
    double narrow = ldexp(1, -(int)any_between(0, MANTISSA)), low = ldexp(1, -(int)any_between(0, MANTISSA + 2));
    clear(&q.s);
    q.s.n = DIM + 1;
    for (int k = 0; k <= DIM; k++) {
        for (int i = 0; i < DIM; i++) {
            q.s.slot[k].w.c[i] = any_real(-1, 1);
        }
        q.s.slot[k].w.c[DIM - 1] *= (real)(k == 0 ? 1 : low);
        q.s.slot[k].w.c[0] *= (real)narrow;
    }
    return holds(&q.s, q.weight);
}

/* Room is less than there is. */
static void rough_rooms(void **state)
{
    int held = 0, above = 0;
    (void)state;
    state_of_draws = 1;
    for (int k = 0; k < 50 * PAIRS; k++) {
        real rough;
        if (!draw_simplex()) {
            continue;
        }
        held++;
        rough = rough_room(&q.s, q.weight);
        for (int i = 0; i <= DIM && rough > 0; i++) {
            assert_true((quad)rough * (quad)rough <= height_over(i));
        }
        above += rough > 0;
    }
    printf("%d simplices hold the origin, %d with room\n", held, above);
    assert_true(above > held / 8 && above < held);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rough_rooms),
        cmocka_unit_test(what_rounding_took),
        cmocka_unit_test(the_length),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
