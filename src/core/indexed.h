/* SPDX-License-Identifier: MIT */
/* Clouds with an index: of every cell of directions, which points may be the farthest along one of them. All others are
 * lower than one of these, by more than rounding, so what is found is what a look at all of them would find, to the
 * bit. */
#ifndef GJK_CORE_INDEXED_H
#define GJK_CORE_INDEXED_H

#include "scan.h"

/* ---- cells ---- */

/* Directions by the face of the cube that they go through, and where they go through that: a square of PER_SIDE cells a
 * side, in the plane a row of them. An index is so many numbers: how many points, how many cells a side, the points'
 * reach as it was, where the points of each cell begin and where the last one's end, and the points; then all points,
 * in order of their coordinates. A cell without any stands for all points. */
enum { OF_POINTS, PER_SIDE, OF_REACH, BEGINS = OF_REACH + sizeof(real) / sizeof(uint32_t) };

#define FACES (2 * DIM)

static inline uint32_t cells_of_face(uint32_t side) { return DIM == 2 ? side : side * side; }

/* The cell of a direction whose largest coordinate is of that size. */
HOT uint32_t cell_of(vec d, real far, uint32_t side)
{
    const real half = (real)side / 2;
    uint32_t axis = 0, cell;
    for (uint32_t i = 1; i < DIM; i++) axis = size(d.c[i]) == far ? i : axis;
    cell = 2 * axis + (d.c[axis] < 0);
    for (uint32_t i = 0; i < DIM; i++) {
        if (i == axis) continue;
        const uint32_t at = (uint32_t)((d.c[i] / far + 1) * half);
        cell = cell * side + (at < side ? at : side - 1);
    }
    return cell;
}

/* It is of so many points, of that reach. */
HOT int is_index_of(const uint32_t *index, size_t count, real reach)
{
    return index[OF_POINTS] == count && memcmp(index + OF_REACH, &reach, sizeof reach) == 0;
}

/* ---- asking ---- */

/* Of points by number, as farthest_among has it. */
HOT size_t farthest_of_those(const list *l, vec d, const uint32_t *from, const uint32_t *end, int careful)
{
    summit s = {-REAL_MAX, -REAL_MAX, *from};
    for (const uint32_t *i = from; i < end; i++) s = see(s, dot(nth_of(l, *i), d), *i);
    const real almost = s.highest - margin_of(l, d);
    if (!careful || !(s.second >= almost)) return s.at;
    tie t = tie_of(l, d, s.at);
    for (const uint32_t *i = from; i < end; i++)
        if (dot(nth_of(l, *i), d) >= almost) look_for_rise(&t, l, d, *i);
    return t.best;
}

/* The numbers of those that may be farthest along a direction. */
typedef struct candidates {
    const uint32_t *from, *end;
} candidates;

/* 0: all may be, or there is no index; or heights that large may under- or overflow. */
HOT int look_up(const list *l, vec d, candidates *s)
{
    const real far = peak(d), high = l->reach * far;
    if (!l->index || !(high > REAL_MIN / UNIT && high < REAL_MAX / 8 && spread(d) <= REAL_MAX)) return 0;
    const uint32_t *begin = l->index + BEGINS + cell_of(d, far, l->index[PER_SIDE]);
    *s = (candidates){l->index + begin[0], l->index + begin[1]};
    return begin[0] < begin[1];
}

static APART size_t farthest_by_index(const list *l, vec d, enum care care)
{
    candidates s;
    return look_up(l, d, &s) ? farthest_of_those(l, d, s.from, s.end, tells_equals(care))
                             : farthest_scanned(l, d, care);
}

/* By the first coordinate, of equals by the next. */
HOT int is_before(vec a, vec b)
{
    EACH(if (a.c[i] != b.c[i]) return a.c[i] < b.c[i]);
    return 0;
}

/* All points, in that order. */
static inline const uint32_t *order_of(const uint32_t *index)
{
    return index + index[BEGINS + FACES * cells_of_face(index[PER_SIDE])];
}

/* x is one of the points of a list with an index. */
static inline int is_in_order(const list *l, vec x)
{
    const uint32_t *from = order_of(l->index);
    size_t n = l->count;
    while (n > 1) { /* if x is there, it is among these n */
        const size_t half = n / 2;
        if (!is_before(x, nth_of(l, from[half]))) from += half;
        n -= half;
    }
    return same(nth_of(l, *from), x);
}

/* Farthest of the points, the first among equals; of strangers their count if one is not finite. */
HOT size_t farthest_among(const list *l, vec d, enum care care)
{
    return l->index ? farthest_by_index(l, d, care) : farthest_scanned(l, d, care);
}

/* The same, where it is one call among many. */
static APART size_t farthest_apart(const list *l, vec d, enum care care) { return farthest_among(l, d, care); }

/* ---- making one ---- */

/* So many cells a side for so many points: about four times as many cells as points, and no more than
 * MOST_A_FACE; half as many a side, and so on, where an index would be larger than so many numbers a point. */
#define MOST_A_POINT 16
#define MOST_A_FACE 576
static inline uint32_t cells_a_side(size_t count)
{
    uint32_t side = 1;
    while (cells_of_face(side) < MOST_A_FACE && (size_t)cells_of_face(side) * FACES < 4 * count) side++;
    return side;
}

/* Cells are wider by so much on each side, as directions are sorted by rounded numbers. */
#define BRIM ((real)0x1p-16)
#define ENDS (1 << (DIM - 1))

/* The cell's ends, whose cone it is, and a direction amid it. */
typedef struct sector {
    vec end[ENDS], mid;
} sector;

static sector sector_of(uint32_t cell, uint32_t side)
{
    const uint32_t face = cell / cells_of_face(side);
    sector s;
    uint32_t at = cell % cells_of_face(side), bit = 0;
    s.mid = axis((int)face / 2, face % 2 ? -1 : 1);
    for (int e = 0; e < ENDS; e++) s.end[e] = s.mid;
    for (uint32_t i = DIM; i-- > 0;) {
        if (i == face / 2) continue;
        const real from = 2 * (real)(at % side) / (real)side - 1, to = 2 * (real)(at % side + 1) / (real)side - 1;
        s.mid.c[i] = (from + to) / 2;
        for (int e = 0; e < ENDS; e++) s.end[e].c[i] = e >> bit & 1 ? to + BRIM : from - BRIM;
        at /= side;
        bit++;
    }
    return s;
}

/* The points that others are held against: those farthest along the ends, and amid. */
typedef struct rivals {
    real high[ENDS + 1][ENDS];
} rivals;

static rivals rivals_of(const list *l, const sector *s)
{
    rivals r;
    for (int k = 0; k <= ENDS; k++) {
        const vec x = nth_of(l, farthest_scanned(l, k < ENDS ? s->end[k] : s->mid, HASTY));
        for (int e = 0; e < ENDS; e++) r.high[k][e] = dot(x, s->end[e]);
    }
    return r;
}

/* By so many roundings of the reach are those lower that are left out. */
#define LOWER (128 * DIM)

/* One of the rivals is higher along all ends, and so along all ways between them, than x by more than a margin. */
static int is_outdone(const rivals *r, const sector *s, vec x, real margin)
{
    real high[ENDS];
    for (int e = 0; e < ENDS; e++) high[e] = dot(x, s->end[e]) + margin;
    for (int k = 0; k <= ENDS; k++) {
        int outdone = 1;
        for (int e = 0; e < ENDS; e++) outdone &= r->high[k][e] > high[e];
        if (outdone) return 1;
    }
    return 0;
}

/* The points of a cell, to there if they fit before end; where the next one's begin. None where they are a third of
 * all: to look at all is as fast then. */
static size_t write_cell(const list *l, uint32_t cell, uint32_t side, uint32_t *index, size_t at, size_t end)
{
    const sector s = sector_of(cell, side);
    const rivals r = rivals_of(l, &s);
    const real margin = LOWER * UNIT * l->reach + 32 * TINY;
    const size_t begin = at;
    for (size_t i = 0; i < l->count; i++) {
        if (is_outdone(&r, &s, nth_of(l, i), margin)) continue;
        if (at < end) index[at] = (uint32_t)i;
        at++;
    }
    return 3 * (at - begin) < l->count ? at : begin;
}

/* Of the order, those from here on sink to where none below is later, as of a heap: below n stand 2n + 1 and 2n + 2. */
static void sink(const list *l, uint32_t *order, size_t at, size_t end)
{
    for (size_t next = 2 * at + 1; next < end; next = 2 * at + 1) {
        if (next + 1 < end && is_before(nth_of(l, order[next]), nth_of(l, order[next + 1]))) next++;
        if (!is_before(nth_of(l, order[at]), nth_of(l, order[next]))) return;
        const uint32_t later = order[next];
        order[next] = order[at];
        order[at] = later;
        at = next;
    }
}

static void put_in_order(const list *l, uint32_t *order)
{
    for (size_t i = 0; i < l->count; i++) order[i] = (uint32_t)i;
    for (size_t i = l->count / 2; i-- > 0;) sink(l, order, i, l->count);
    for (size_t end = l->count; end-- > 1;) {
        const uint32_t last = order[0];
        order[0] = order[end];
        order[end] = last;
        sink(l, order, 0, end);
    }
}

static inline size_t begin_of_points(uint32_t side) { return BEGINS + FACES * cells_of_face(side) + 1; }

/* An index of so many cells a side, as far as it fits before end. How large it is, or that it is larger than most. */
static size_t write_index(const list *l, uint32_t side, uint32_t *index, size_t end, size_t most)
{
    const size_t begins = BEGINS + FACES * cells_of_face(side);
    size_t at = begin_of_points(side);
    for (size_t k = BEGINS; k < begins && at <= most; k++) {
        if (k < end) index[k] = (uint32_t)at;
        at = write_cell(l, (uint32_t)(k - BEGINS), side, index, at, end);
    }
    const size_t size = at + l->count;
    if (size > end || (size > most && side > 1)) return size; /* there is to be one of fewer cells */
    index[begins] = (uint32_t)at;
    put_in_order(l, index + at);
    index[OF_POINTS] = (uint32_t)l->count;
    index[PER_SIDE] = side;
    memcpy(index + OF_REACH, &l->reach, sizeof l->reach);
    return size;
}

/* The same of as many cells as make it no larger than it may be: of one a side it is not. */
static size_t make_index(const list *l, uint32_t *index, size_t end)
{
    uint32_t side = cells_a_side(l->count);
    for (;; side /= 2) {
        const size_t most = begin_of_points(side) + MOST_A_POINT * l->count,
                     size = write_index(l, side, index, end, most);
        if (size <= most || side == 1) return size;
    }
}

#endif
