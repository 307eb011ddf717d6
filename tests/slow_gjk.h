/* SPDX-License-Identifier: MIT */
/* The distance between two hulls, slowly and plainly: the nearest point of a simplex is sought over all its faces,
 * each projected onto by orthonormalising its edges twice. Included once for each scalar:
 *   T            the scalar
 *   N(name)      its names
 *   N(root)(x)   its square root
 *   FLAT         an edge this short, relatively, once the others are taken out, adds no dimension
 *   OUTSIDE      a weight down to minus this counts as 0
 *   ENOUGH       the relative width of a bracket that needs no more work */

/* w = b - a. The distance is that of the origin from the hull of all w. */
typedef struct N(corner) {
    T a[DIM], b[DIM], w[DIM];
    int at_a, at_b; /* the indices of a and b among the vertices */
} N(corner);

typedef struct N(slow) {
    N(corner) s[DIM + 1]; /* the last simplex */
    T weight[DIM + 1];
    int count;
    T lower, upper; /* of the distance between the cores */
    T normal[DIM];  /* realises lower; not set where upper is 0 */
} N(slow);

static inline T N(dot)(const T *x, const T *y)
{
    T sum = x[0] * y[0];
    for (int i = 1; i < DIM; i++) {
        sum += x[i] * y[i];
    }
    return sum;
}

static inline T N(length)(const T *x) { return N(root)(N(dot)(x, x)); }

/* The farthest point of a view along a direction, and its index. */
static int N(farthest)(const view *v, const T *dir, T *point);

static void N(corner_along)(const view *a, const view *b, const T *n, N(corner) * c)
{
    T back[DIM];
    for (int i = 0; i < DIM; i++) {
        back[i] = -n[i];
    }
    c->at_a = N(farthest)(a, n, c->a);
    c->at_b = N(farthest)(b, back, c->b);
    for (int i = 0; i < DIM; i++) {
        c->w[i] = c->b[i] - c->a[i];
    }
}

static inline void N(take_out)(T *x, T (*q)[DIM], int count, T *parts)
{
    for (int pass = 0; pass < 2; pass++) {
        for (int j = 0; j < count; j++) {
            T h = N(dot)(q[j], x);
            parts[j] += h;
            for (int i = 0; i < DIM; i++) {
                x[i] -= h * q[j][i];
            }
        }
    }
}

/* The point of the affine hull of the picked corners that lies nearest to the origin, where it is a mean of them:
 * its weights, its length as that mean, and the direction to it, orthogonal to all edges. 0 where it is none. */
static int N(project)(const N(corner) * s, const int *pick, int count, T *weight, T *length, T *normal)
{
    T q[DIM][DIM], r[DIM][DIM] = {{0}}, c[DIM] = {0}, ignored[DIM] = {0}, sum = 0, mean[DIM] = {0}, n;
    for (int k = 0; k < count - 1; k++) {
        T full;
        for (int i = 0; i < DIM; i++) {
            q[k][i] = s[pick[k + 1]].w[i] - s[pick[0]].w[i];
        }
        full = N(length)(q[k]);
        N(take_out)(q[k], q, k, r[k]);
        r[k][k] = N(length)(q[k]);
        if (!(r[k][k] > full * FLAT)) {
            return 0;
        }
        for (int i = 0; i < DIM; i++) {
            q[k][i] /= r[k][k];
        }
    }
    memcpy(normal, s[pick[0]].w, sizeof mean);
    N(take_out)(normal, q, count - 1, c);
    weight[0] = 1;
    for (int j = count - 2; j >= 0; j--) {
        T t = -c[j];
        for (int k = j + 1; k < count - 1; k++) {
            t -= weight[k + 1] * r[k][j];
        }
        weight[j + 1] = t / r[j][j];
        weight[0] -= weight[j + 1];
    }
    for (int k = 0; k < count; k++) {
        if (!(weight[k] >= -OUTSIDE)) {
            return 0;
        }
        weight[k] = weight[k] < 0 ? 0 : weight[k];
        sum += weight[k];
    }
    for (int k = 0; k < count; k++) {
        weight[k] /= sum;
        for (int i = 0; i < DIM; i++) {
            mean[i] += weight[k] * s[pick[k]].w[i];
        }
    }
    *length = N(length)(mean);
    n = N(length)(normal);
    if (count <= DIM && n > 0) {
        for (int i = 0; i < DIM; i++) {
            normal[i] /= n;
        }
        N(take_out)(normal, q, count - 1, ignored);
        n = N(length)(normal);
        for (int i = 0; i < DIM; i++) {
            normal[i] /= n;
        }
    }
    return 1;
}

/* Shrinks the simplex to the face whose point lies nearest to the origin; on a tie, to within rounding, to the largest
 * such face, whose normal is the most trustworthy. Returns that distance. */
static T N(nearest)(N(slow) * r, T size)
{
    T best = -1;
    int best_pick[DIM + 1] = {0}, best_count = 0;
    for (int corners = 1; corners <= r->count; corners++) {
        for (int mask = 1; mask < 1 << r->count; mask++) {
            int pick[DIM + 1], count = 0;
            T weight[DIM + 1], length, normal[DIM];
            for (int i = 0; i < r->count; i++) {
                if (mask >> i & 1) {
                    pick[count++] = i;
                }
            }
            if (count != corners || !N(project)(r->s, pick, count, weight, &length, normal)) {
                continue;
            }
            if (best < 0 || length <= best + size * (T)ENOUGH / 10000) {
                best = length;
                best_count = count;
                memcpy(best_pick, pick, sizeof pick);
                memcpy(r->weight, weight, sizeof weight);
                memcpy(r->normal, normal, sizeof normal);
            }
        }
    }
    for (int i = 0; i < best_count; i++) {
        r->s[i] = r->s[best_pick[i]]; /* picked in rising order */
    }
    r->count = best_count;
    return best;
}

/* From the simplex in r, or from nothing where it is empty. size: of the two views. */
static void N(solve)(const view *a, const view *b, T size, int max_steps, N(slow) * r)
{
    r->lower = -4 * size;
    r->upper = 4 * size;
    if (r->count == 0) {
        T first[DIM] = {1};
        N(corner_along)(a, b, first, &r->s[0]);
        r->count = 1;
    }
    for (int step = 0; step < max_steps; step++) {
        N(corner) c;
        T reach, length = N(nearest)(r, size);
        int seen = 0;
        r->upper = length < r->upper ? length : r->upper;
        if (r->count > DIM || length <= size * (T)ENOUGH / 16) {
            return;
        }
        N(corner_along)(a, b, r->normal, &c);
        reach = N(dot)(r->normal, c.w);
        r->lower = reach > r->lower ? reach : r->lower;
        for (int i = 0; i < r->count; i++) {
            seen |= memcmp(r->s[i].w, c.w, sizeof c.w) == 0;
        }
        if (seen || r->upper - r->lower <= size * (T)ENOUGH) {
            return;
        }
        r->s[r->count++] = c;
    }
    N(nearest)(r, size);
}

#undef T
#undef N
#undef FLAT
#undef OUTSIDE
#undef ENOUGH
