/* SPDX-License-Identifier: MIT */
/* What the bodies are, in 113 bits: their vertices, or the formulas of the round ones. */
#ifndef SETS_H
#define SETS_H

#include "bodies.h"
#include "quad.h"

#define MAX_VERTICES 2048

static inline quad positive(quad x) { return x > 0 ? x : 0; }

static inline quad norm(const quad *x)
{
    quad sum = 0;
    for (int i = 0; i < DIM; i++) {
        sum += x[i] * x[i];
    }
    return quad_sqrt(sum);
}

static inline void posed(const V(pose) * pose, const quad *origin, const quad *x, quad *out)
{
    for (int i = 0; i < DIM; i++) {
        out[i] = (quad)pose->p[i] - origin[i];
        for (int j = 0; j < DIM; j++) {
            out[i] += (quad)pose->m[i * DIM + j] * x[j];
        }
    }
}

static const quad no_origin[DIM] = {0};

/* The vertices of the set itself, before its pose. Returns how many, 0 where it is round. */
static int list_vertices(const body *b, quad (*out)[DIM])
{
    int count = b->count;
    if (b->kind == SUM || b->kind == HULL) {
        quad part[2][MAX_VERTICES][DIM];
        int n[2];
        for (int k = 0; k < 2; k++) {
            n[k] = b->part[k]->shape.radius > 0 ? 0 : list_vertices(b->part[k], part[k]);
            for (int i = 0; i < n[k]; i++) {
                quad x[DIM];
                memcpy(x, part[k][i], sizeof x);
                posed(&b->part[k]->pose, no_origin, x, part[k][i]);
            }
        }
        if (n[0] == 0 || n[1] == 0 || (b->kind == SUM ? n[0] * n[1] : n[0] + n[1]) > MAX_VERTICES) {
            return 0;
        }
        if (b->kind == HULL) {
            memcpy(out, part[0], (size_t)n[0] * sizeof *out);
            memcpy(out + n[0], part[1], (size_t)n[1] * sizeof *out);
            return n[0] + n[1];
        }
        for (int i = 0; i < n[0] * n[1]; i++) {
            for (int j = 0; j < DIM; j++) {
                out[i][j] = part[0][i % n[0]][j] + part[1][i / n[0]][j];
            }
        }
        return n[0] * n[1];
    }
    if (b->kind == BOX) {
        for (int i = 0; i < 1 << DIM; i++) {
            for (int j = 0; j < DIM; j++) {
                out[i][j] = i >> j & 1 ? -(quad)b->half[j] : (quad)b->half[j];
            }
        }
        return 1 << DIM;
    }
    if (b->kind == ORIGIN) {
        memset(out, 0, sizeof *out);
        return 1;
    }
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < DIM; j++) {
            out[i][j] = (quad)points_of(b)[i * DIM + j];
        }
    }
    return count;
}

static void farthest_of_body(const body *b, const quad *origin, int grown, const quad *dir, quad *point);

#if DIM == 3
/* radius / |(x, y)| times (x, y) */
static void rim(quad radius, const quad *dir, quad *point)
{
    quad n = quad_sqrt(dir[0] * dir[0] + dir[1] * dir[1]);
    point[0] = n > 0 ? radius * dir[0] / n : 0;
    point[1] = n > 0 ? radius * dir[1] / n : 0;
    point[2] = 0;
}
#endif

/* The formulas of the round sets, and of the sets made of them. */
static void farthest_of_set(const body *b, const quad *dir, quad *point)
{
    quad v[MAX_VERTICES][DIM], best = 0, other[DIM], n;
    int count;
    switch (b->kind) {
    case BALL:
        n = norm(dir);
        for (int i = 0; i < DIM; i++) {
            point[i] = n > 0 ? (quad)b->radius * dir[i] / n : 0;
        }
        return;
    case ELLIPSOID:
        for (int i = 0; i < DIM; i++) {
            other[i] = (quad)b->half[i] * dir[i];
            best = quad_abs(other[i]) > best ? quad_abs(other[i]) : best;
        }
        for (int i = 0; i < DIM && best > 0; i++) {
            other[i] /= best;
        }
        n = norm(other);
        for (int i = 0; i < DIM; i++) {
            point[i] = n > 0 ? (quad)b->half[i] * other[i] / n : 0;
        }
        return;
#if DIM == 3
    case CYLINDER:
        rim((quad)b->radius, dir, point);
        point[2] = dir[2] < 0 ? -(quad)b->half_length : (quad)b->half_length;
        return;
    case CONE:
        rim((quad)b->radius, dir, point);
        point[2] = -(quad)b->half_length;
        if (dir[2] * 2 * (quad)b->half_length > point[0] * dir[0] + point[1] * dir[1]) {
            point[0] = point[1] = 0;
            point[2] = (quad)b->half_length;
        }
        return;
    case DISC:
        rim((quad)b->radius, dir, point);
        return;
#endif
    case SUM:
    case HULL:
        farthest_of_body(b->part[0], no_origin, 1, dir, point);
        farthest_of_body(b->part[1], no_origin, 1, dir, other);
        for (int i = 0; i < DIM; i++) {
            best += (other[i] - point[i]) * dir[i];
        }
        for (int i = 0; i < DIM; i++) {
            point[i] = b->kind == SUM ? point[i] + other[i] : best > 0 ? other[i] : point[i];
        }
        return;
    default:
        count = list_vertices(b, v);
        for (int k = 0; k < count; k++) {
            quad along = 0;
            for (int i = 0; i < DIM; i++) {
                along += v[k][i] * dir[i];
            }
            if (k == 0 || along > best) {
                best = along;
                memcpy(point, v[k], sizeof v[k]);
            }
        }
    }
}

/* The same of the posed set; grown: by its radius as well. */
static void farthest_of_body(const body *b, const quad *origin, int grown, const quad *dir, quad *point)
{
    quad back[DIM] = {0}, x[DIM], n;
    for (int i = 0; i < DIM; i++) {
        for (int j = 0; j < DIM; j++) {
            back[j] += (quad)b->pose.m[i * DIM + j] * dir[i];
        }
    }
    farthest_of_set(b, back, x);
    posed(&b->pose, origin, x, point);
    n = norm(dir);
    for (int i = 0; i < DIM && grown && n > 0; i++) {
        point[i] += (quad)b->shape.radius * dir[i] / n;
    }
}

#endif
