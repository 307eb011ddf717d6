/* SPDX-License-Identifier: MIT */
/* Bytes to numbers. Any bytes will do: past their end come zeros. Every number is finite, and may be one that was used
 * before, so that bodies share coordinates to the bit or but for a few units in the last place. */
#ifndef INPUT_H
#define INPUT_H

#include "variant.h"

#define MOST_REMEMBERED 96

typedef struct input {
    const uint8_t *next, *end;
    real used[MOST_REMEMBERED]; /* numbers decoded so far */
    int used_count;
    int calm; /* no number of extreme magnitude */
} input;

static inline input input_from(const uint8_t *bytes, size_t count)
{
    input in;
    memset(&in, 0, sizeof in);
    in.next = bytes;
    in.end = bytes + count;
    return in;
}

static inline int byte(input *in) { return in->next < in->end ? *in->next++ : 0; }

static inline int two_bytes(input *in)
{
    int high = byte(in);
    return high << 8 | byte(in);
}

/* -128 .. 127 */
static inline int small_whole(input *in)
{
    int b = byte(in);
    return b < 128 ? b : b - 256;
}

/* 0 .. n - 1 */
static inline int choice(input *in, int n) { return byte(in) % n; }

/* The real next to x, towards to. */
static inline real next_to(real x, real to)
{
#if VARIANT_FLOAT
    return nextafterf(x, to);
#else
    return nextafter(x, to);
#endif
}

/* x moved by some units in its last place, at most 8. */
static inline real nudged(real x, int by)
{
    for (int i = 0; i < abs(by) % 9; i++) {
        x = next_to(x, by < 0 ? -REAL_MAX : REAL_MAX);
    }
    return x;
}

/* The nearest number of the format that is finite. */
static inline real rounded(double x)
{
    return (real)(x > (double)REAL_MAX ? (double)REAL_MAX : x < -(double)REAL_MAX ? -(double)REAL_MAX : x);
}

static inline real used_before(input *in)
{
    int at = byte(in);
    return in->used_count ? in->used[at % in->used_count] : 0;
}

/* In -1 .. 1, with digits down to the last place. */
static inline double fraction(input *in)
{
    double x = 0;
    for (int i = 0; i < 7; i++) {
        x = (x + byte(in)) / 256;
    }
    return 2 * x - 1;
}

static inline real fresh_number(input *in)
{
    const int least = VARIANT_FLOAT ? -149 : -1074, most = VARIANT_FLOAT ? 127 : 1023;
    int op = choice(in, 16), x;
    real used;
    if (in->calm && op > 12) {
        op -= 8;
    }
    switch (op) {
    case 0:
    case 1:
    case 2:
        return (real)small_whole(in);
    case 3:
        return (real)small_whole(in) / 4;
    case 4:
        return (real)small_whole(in) / 128;
    case 5:
        return used_before(in);
    case 6:
        return -used_before(in);
    case 7:
        used = used_before(in);
        return nudged(used, small_whole(in));
    case 8:
        used = used_before(in);
        return rounded((double)used + (double)used_before(in));
    case 9:
        x = choice(in, 48);
        used = used_before(in);
        return rounded((double)used + ldexp(small_whole(in), -x)); /* a little beside */
    case 10:
    case 11:
        return (real)fraction(in);
    case 12:
        x = choice(in, 81) - 40;
        return (real)ldexp(fraction(in), x);
    case 13:
        x = least + two_bytes(in) % (most - least);
        return rounded(ldexp(small_whole(in) / 64.0, x));
    case 14:
        return (real)(small_whole(in) * (double)REAL_MIN * (double)REAL_EPSILON); /* subnormal */
    default:
        x = choice(in, 24);
        return rounded(ldexp((double)REAL_MAX / 128 * small_whole(in), -x));
    }
}

static inline real number(input *in)
{
    real x = fresh_number(in);
    in->used[in->used_count % MOST_REMEMBERED] = x;
    in->used_count += in->used_count < MOST_REMEMBERED - 1;
    return x;
}

static inline real size_number(input *in)
{
    real x = number(in);
    return x < 0 ? -x : x;
}

#endif
