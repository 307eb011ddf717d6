/* SPDX-License-Identifier: MIT */
/* How deep two views overlap: how far the origin lies within the set of differences b - a. A polytope is grown inside
 * that set, each time beyond the face nearest to the origin. Its nearest face bounds the depth from below, the nearest
 * plane that supports the set from above. Included by truth.h. */

#ifndef MAX_CORNERS
#define MAX_CORNERS 160
#endif
#define MAX_FACES (4 * MAX_CORNERS)
#ifndef ROUND_STEPS
#define ROUND_STEPS 40 /* of round bodies, which have no end */
#endif

typedef struct face {
    int corner[DIM]; /* counterclockwise from outside */
    quad normal[DIM], height;
    double rough[DIM];
} face;

typedef struct polytope {
    quad w[MAX_CORNERS][DIM];
    face f[MAX_FACES];
    int corners, faces;
} polytope;

static quad beyond(const view *a, const view *b, const quad *n, quad *w)
{
    quad_corner c;
    quad back[DIM];
    for (int i = 0; i < DIM; i++) {
        back[i] = -n[i];
    }
    quad_corner_along(a, b, back, &c);
    memcpy(w, c.w, sizeof c.w);
    return quad_dot(n, c.w);
}

/* The normal of the face to the right of x, or of the triangle x y; whether it has one. */
#if DIM == 3
static int perpendicular(const quad *x, const quad *y, quad *n)
{
    quad l;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = x[j] * y[k] - x[k] * y[j];
    }
    l = quad_length(n);
    for (int i = 0; i < 3 && l > 0; i++) {
        n[i] /= l;
    }
    return l > 0;
}
#endif

static int add_face(polytope *p, const int *corner)
{
    face *f = &p->f[p->faces];
    quad x[DIM];
    if (p->faces == MAX_FACES) {
        return 0;
    }
    memcpy(f->corner, corner, sizeof f->corner);
    for (int i = 0; i < DIM; i++) {
        x[i] = p->w[corner[1]][i] - p->w[corner[0]][i];
    }
#if DIM == 3
    quad y[DIM];
    for (int i = 0; i < DIM; i++) {
        y[i] = p->w[corner[2]][i] - p->w[corner[0]][i];
    }
    if (!perpendicular(x, y, f->normal)) {
        return 0;
    }
#else
    quad l = quad_length(x);
    if (!(l > 0)) {
        return 0;
    }
    f->normal[0] = x[1] / l;
    f->normal[1] = -x[0] / l;
#endif
    f->height = quad_dot(f->normal, p->w[corner[0]]);
    for (int i = 1; i < DIM; i++) {
        quad h = quad_dot(f->normal, p->w[corner[i]]);
        f->height = h < f->height ? h : f->height;
    }
    for (int i = 0; i < DIM; i++) {
        f->rough[i] = (double)f->normal[i];
    }
    p->faces++;
    return 1;
}

/* Whether w lies beyond the face; in double where that is clear enough. */
static int sees(const face *f, const quad *w, quad size)
{
    double rough = -(double)f->height;
    for (int i = 0; i < DIM; i++) {
        rough += f->rough[i] * (double)w[i];
    }
    if (fabs(rough) > 1e-13 * (double)size) {
        return rough > 0;
    }
    return quad_dot(f->normal, w) - f->height > size * (quad)1e-30;
}

/* Replaces the faces that see the new corner by faces from their rim to it. 0: no room, or a flat face. */
static int grow(polytope *p, const quad *w, quad size)
{
    int rim[MAX_FACES][DIM], rims = 0, kept = 0;
    if (p->corners == MAX_CORNERS) {
        return 0;
    }
    memcpy(p->w[p->corners], w, sizeof p->w[0]);
    for (int i = 0; i < p->faces; i++) {
        if (!sees(&p->f[i], w, size)) {
            p->f[kept++] = p->f[i];
            continue;
        }
        for (int e = 0; e < DIM; e++) {
            /* DIM 3: the edge from corner e to the next, gone where the face beyond it goes too. DIM 2: the end e. */
            int from = p->f[i].corner[e], to = DIM == 3 ? p->f[i].corner[(e + 1) % DIM] : 1 - e, twin = -1;
            for (int k = 0; k < rims; k++) {
                if (rim[k][0] == (DIM == 3 ? to : from) && rim[k][1] == (DIM == 3 ? from : 1 - to)) {
                    twin = k;
                }
            }
            if (twin >= 0) {
                memcpy(rim[twin], rim[--rims], sizeof rim[0]);
            } else if (rims < MAX_FACES) {
                rim[rims][0] = from;
                rim[rims++][1] = to;
            }
        }
    }
    if (kept == p->faces) {
        return 0;
    }
    p->faces = kept;
    for (int k = 0; k < rims; k++) {
#if DIM == 3
        int corner[3] = {rim[k][0], rim[k][1], p->corners};
#else
        int corner[2] = {rim[k][1] ? rim[k][0] : p->corners, rim[k][1] ? p->corners : rim[k][0]};
#endif
        if (!add_face(p, corner)) {
            return 0;
        }
    }
    p->corners++;
    return 1;
}

/* The point of the set farthest from the flat through the corners so far, with the orthonormal directions q of that
 * flat. On failure: a unit direction across which the set has no width. */
static int widen(const view *a, const view *b, polytope *p, quad (*q)[DIM], quad size, quad *flat)
{
    quad best = 0, best_w[DIM] = {0};
    for (int axis = 0; axis < DIM; axis++) {
        quad n[DIM] = {0}, ignored[DIM] = {0}, l;
        n[axis] = 1;
        quad_take_out(n, q, p->corners - 1, ignored);
        l = quad_length(n);
        if (l < (quad)0.1) {
            continue;
        }
        for (int i = 0; i < DIM; i++) {
            n[i] /= l;
        }
        memcpy(flat, n, sizeof n);
        for (int side = 0; side < 2; side++) {
            quad w[DIM], off;
            beyond(a, b, n, w);
            off = quad_abs(quad_dot(n, w) - quad_dot(n, p->w[0]));
            if (off > best) {
                best = off;
                memcpy(best_w, w, sizeof w);
            }
            for (int i = 0; i < DIM; i++) {
                n[i] = -n[i];
            }
        }
    }
    if (!(best > size * (quad)1e-29)) {
        return 0;
    }
    memcpy(p->w[p->corners], best_w, sizeof best_w);
    for (int i = 0; i < DIM; i++) {
        q[p->corners - 1][i] = best_w[i] - p->w[0][i];
    }
    quad ignored[DIM] = {0}, l;
    quad_take_out(q[p->corners - 1], q, p->corners - 1, ignored);
    l = quad_length(q[p->corners - 1]);
    for (int i = 0; i < DIM; i++) {
        q[p->corners - 1][i] /= l;
    }
    p->corners++;
    return 1;
}

static int first_polytope(const view *a, const view *b, polytope *p, quad size, quad *flat)
{
    quad q[DIM][DIM], first[DIM] = {1};
    p->corners = 1;
    p->faces = 0;
    beyond(a, b, first, p->w[0]);
    while (p->corners <= DIM) {
        if (!widen(a, b, p, q, size, flat)) {
            return 0;
        }
    }
    for (int out = 0; out <= DIM; out++) {
        int corner[DIM], n = 0;
        for (int i = 0; i <= DIM; i++) {
            if (i != out) {
                corner[n++] = i;
            }
        }
        add_face(p, corner);
        if (quad_dot(p->f[out].normal, p->w[out]) > p->f[out].height) {
            int swap = corner[0];
            corner[0] = corner[1];
            corner[1] = swap;
            p->faces--;
            add_face(p, corner);
        }
    }
    return 1;
}

/* shallow <= depth <= deep; below 0 where the origin is outside. */
static void find_depth(const view *a, const view *b, quad size, quad *shallow, quad *deep)
{
    polytope p;
    quad flat[DIM], w[DIM];
    int steps = a->count && b->count ? MAX_CORNERS : ROUND_STEPS;
    *shallow = -4 * size;
    *deep = 4 * size;
    if (!first_polytope(a, b, &p, size, flat)) {
        /* No width across flat, to this precision: no depth. Whether the sets meet at all is for the caller to say. */
        *deep = beyond(a, b, flat, w);
        *deep = *deep > 0 ? *deep : 0;
        return;
    }
    for (int step = 0; step < steps; step++) {
        int at = 0;
        quad reach;
        for (int i = 1; i < p.faces; i++) {
            at = p.f[i].height < p.f[at].height ? i : at;
        }
        *shallow = p.f[at].height > *shallow ? p.f[at].height : *shallow; /* a sliver among later ones may be noise */
        reach = beyond(a, b, p.f[at].normal, w);
        *deep = reach < *deep ? reach : *deep;
        if (*deep - *shallow <= size * (quad)1e-29 || !grow(&p, w, size)) {
            return;
        }
    }
}
