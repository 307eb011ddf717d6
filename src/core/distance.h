/* SPDX-License-Identifier: MIT */
/* The search: GJK with a bracket.
 *
 * v is the point of the simplex nearest the origin; the next corner is the one that lies least along v. Of the signed
 * separation of the two sets (distance apart, minus depth overlapping) this proves
 *     from below: the corner's height v.w / |v|, for any v at all,
 *     from above: the length of any convex combination of corners; minus the room around the origin inside a full
 * simplex.
 *
 * It ends: every step raises the count toward max_steps. Long before that, as a rule: a step makes |v| smaller, or uses
 * up one of SIDESTEPS, or is the last; SHARPENINGS times at most the walk is taken up again. */
#ifndef GJK_CORE_DISTANCE_H
#define GJK_CORE_DISTANCE_H

#include "minkowski.h"

#define SIDESTEPS 6
#define SHARPENINGS 8

/* What would settle the question: in the caller's lengths, and for the search in those of its frame (scaled). */
typedef struct goal {
    real beyond;           /* stop when proven to be more than this apart */
    real within;           /* stop when proven to be less than this apart */
    real radius;           /* of both bodies together */
    real abs_tol, rel_tol; /* stop at upper - lower <= abs_tol + rel_tol * (upper - radius) */
    int early;             /* whether anything but beyond can end it early */
    int sign_only;         /* stop at the first proof of the sign */
    int exact;             /* both sets' corners are known: the end of the search can be without rounding */
    int deep;              /* the depth is wanted, where they overlap */
    int tight;             /* to the last place, if exact */
    int max_steps;
} goal;

enum end {
    BEYOND, /* more than goal.beyond apart */
    WITHIN, /* less than goal.within apart */
    CLOSE,  /* bracket as narrow as goal's tolerances ask */
    STILL,  /* no corner brings v nearer: v is nearest, to rounding */
    INSIDE, /* a full simplex holds the origin, to rounding */
    OPEN,   /* none of these: goal.max_steps are used up */
    FAULT   /* a support's answer was none */
};

/* How a glance at the first corner went: not cast; the sizes were none to tell by; it told nothing; nor did the axes of
 * two boxes; nor the corner along one of them; nor a few strides from there; or the answer. */
enum glanced { UNTRIED, UNCLEAR, IN_VAIN, CLOUDED, AIMED, STRODE, TELLING };

/* Where a walk was left, the count 0 if nowhere: the simplex, with what it took to come there, and what is known. */
typedef struct find {
    cache at;
    int steps, calls;
    real lower; /* in the caller's lengths */
    vec normal;
} find;

/* Where strides have led: the corners are in the search's slots, in lengths of another frame. */
typedef struct trail {
    int at[DIM + 1], n;
    real unscale, vv, lower;
    vec normal;
    int pending, steps, calls, near;
} trail;

typedef struct search {
    difference d;
    int listed;           /* the corners of both bodies, before all else */
    enum glanced thin;    /* how it went with thin cores, without a frame; and */
    enum glanced planar;  /* with few corners in the plane; and */
    enum glanced flat;    /* with these in double */
    enum glanced glanced; /* IN_VAIN to AIMED: the corner is in s's first slot, in the caller's lengths */
    enum glanced lent;    /* how it went with what the cache has kept (lent.h) */
    simplex s;
    vec v;
    real vv;      /* v.v; REAL_MAX before there is a simplex */
    real lower;   /* of the signed separation */
    vec normal;   /* unit, from A to B: where lower was found */
    int pending;  /* s's spare slot holds a corner that was asked for and not taken in */
    int repeated; /* because it stood in the simplex already */
    int stuck;    /* because it brought v no nearer, although it lies lower along v */
    real inside;  /* room in a full simplex, where it ended INSIDE */
    vec way;      /* along which the everyday walk has sought that corner, */
    int rough;    /* elsewhere than along v, or in haste */
    int weighed;  /* the walk has left the corners' weights here: */
    real weight[DIM + 1];
    int sidesteps; /* that brought v no nearer, to rounding */
    int steps;
    int told;            /* the answer is found, without more ado */
    int met;             /* proven without rounding, where rounding leaves it open, */
    real met_off;        /*   of bodies that are off the caller's by no more than this */
    const cache *lender; /* of the warm start's corners; NULL: none, or no longer in doubt */
    unsigned borrowed;   /* slots that still hold them */
    simplex around;      /* full, around the origin, and too thin to prove it; n is 0: none was */
    unsigned borrowed_around;
#if DIM == 2
    find found; /* where polygons looked at by themselves were left to the walk */
#endif
#if DIM == 3
    trail trail;
#endif
    struct first_dip *first_dip; /* where it is kept (round.h) */
    int turned;  /* not walked, but turned to a dip of the heights that seems to be a way out; below 0: never again */
    int dug;     /* so many corners were looked at from there in vain (stride.h); -1: that is still to be tried */
    int stood;   /* the corner in the spare slot was sought in haste, and lies no lower along v */
    int kept;    /* the cache is to stay as it is: nothing vouches for its corners, nor is against them */
    real enough; /* a depth may be open by this share of it, whatever is asked; 0, as a rule: by none */
} search;

/* |v| is below a sixteenth of a rounding of the frame, which is of size 1 to 2: it has no direction. Not as much as
 * half a rounding: the frame is as large as the reaches say, and those of couples are several times what the bodies
 * are. */
static int is_faded(real vv) { return !(vv > UNIT * UNIT / 256); }

static int vanished(const search *q) { return is_faded(q->vv); }

/* |v| is below so many doubts: rounding leaves hardly a digit of it. */
#define NEAR 8
static inline int is_near(const search *q)
{
    const real near = NEAR * q->d.doubt;
    return q->s.n > 0 && q->s.n <= DIM && q->vv < near * near;
}

/* Room in the full simplex, by its weights; where these show none, by itself. */
static real room_inside(const search *q)
{
    real inside = q->weighed ? rough_room(&q->s, q->weight) : 0;
    return inside > q->d.doubt ? inside : room(&q->s);
}

/* The nearest point's weights, from the walk if it has left them. */
static inline void weigh_walked(const search *q, real weight[DIM + 1])
{
    if (!q->weighed) {
        weigh(&q->s, weight);
        return;
    }
    memcpy(weight, q->weight, sizeof q->weight);
    normalize(weight, q->s.n);
}

/* Two roundings of a blend of the simplex's corners, which may be small in the frame: those of couples are several
 * times what the bodies are. To make it one costs more, and nothing comes of it. */
static real noise_of_blend(const simplex *s)
{
    real far = 0;
    for (int k = 0; k < s->n; k++) far = larger(peak(point(s, k)), far);
    return 2 * UNIT * far;
}

/* In a narrow simplex the weights are coarse, and their corner x off v by a slip across it; what the slip says of them
 * is taken back, as long as that brings the corner nearer. */
static vec take_back(const simplex *s, vec v, vec x, real noise, real weight[DIM + 1])
{
    for (int i = 0; i < 3; i++) {
        real better[DIM + 1];
        vec slip = sub(x, v);
        if (!(peak(slip) > noise)) break;
        change(s, slip, better);
        for (int k = 0; k < s->n; k++) better[k] = weight[k] - better[k];
        normalize(better, s->n);
        vec y = blend(s, better, offsetof(vertex, w), 1);
        if (!(dot(y, y) < dot(x, x))) break;
        memcpy(weight, better, sizeof better);
        x = y;
    }
    return x;
}

/* A simplex too narrow for that is no better than its sides: takes the weights of the best side, if that is nearer. */
static vec take_side(const simplex *s, vec v, vec x, real noise, real weight[DIM + 1])
{
    if (s->n == 1 || !(peak(sub(x, v)) > noise)) return x;
    simplex side = *s;
    real better[DIM + 1];
    vec of_side = nearest_of_all(&side, 0, 0, 0);
    weigh(&side, better);
    vec y = take_back(&side, of_side, blend(&side, better, offsetof(vertex, w), 1), noise, better);
    if (!(dot(y, y) < dot(x, x))) return x;
    for (int i = 0; i < s->n; i++) {
        weight[i] = 0;
        for (int k = 0; k < side.n; k++) weight[i] += side.at[k] == s->at[i] ? better[k] : 0;
    }
    return y;
}

/* A combination of corners is in A - B: its length bounds the separation from above, whatever the weights. v is the
 * simplex's nearest point; corners are off by no more than the doubt. */
static real certify_by(const simplex *s, vec v, real doubt, real weight[DIM + 1])
{
    weigh(s, weight);
    if (s->n == 1) return length(point(s, 0)) * (1 + 8 * UNIT) + doubt;
    vec x = blend(s, weight, offsetof(vertex, w), 1);
    const real noise = noise_of_blend(s);
    x = take_side(s, v, take_back(s, v, x, noise, weight), noise, weight);
    return length(x) * (1 + 8 * UNIT) + doubt;
}

static real certify(const search *q, real weight[DIM + 1]) { return certify_by(&q->s, q->v, q->d.doubt, weight); }

/* The same at the end of a search. A full simplex without room holds the origin all the same, to rounding, even if
 * that is not proven: the point that it holds there may be nearer than all that was found without it. */
static real certify_end(search *q, const goal *g, enum end *end, real weight[DIM + 1])
{
    real other[DIM + 1], upper = certify(q, weight);
    if (*end != STILL || g->exact || q->around.n == 0 || q->lower > 0) return upper;
    const real held = certify_by(&q->around, axis(0, 0), q->d.doubt, other);
    if (!(held < upper)) return upper;
    q->s = q->around;
    q->borrowed = q->borrowed_around;
    q->v = axis(0, 0);
    q->vv = q->inside = 0;
    q->weighed = q->pending = 0;
    memcpy(weight, other, sizeof other);
    *end = INSIDE;
    return held;
}

/* A blend of the corners' x or y, times their grain, to more digits than one number holds: the first corner, and the
 * way from there. */
static vec fine_blend(const simplex *s, const real weight[DIM + 1], size_t member, real grain, vec *low)
{
    vec first = mul(member_of(corner(s, 0), member), grain), way = axis(0, 0), r;
    for (int i = 1; i < s->n; i++)
        way = add(way, mul(sub(mul(member_of(corner(s, i), member), grain), first), weight[i]));
    for (int i = 0; i < DIM; i++) {
        twin t = sum_of(first.c[i], way.c[i]);
        r.c[i] = t.high;
        low->c[i] = t.low;
    }
    return r;
}

/* The corner of A - B that the weights single out, without the roundings of the simplex's own: high is their blend. */
static vec single_out(const search *q, const real weight[DIM + 1], vec *low)
{
    vec x_low, y_low, x = fine_blend(&q->s, weight, offsetof(vertex, x), q->d.a.grain, &x_low);
    vec y = fine_blend(&q->s, weight, offsetof(vertex, y), q->d.b.grain, &y_low);
    vec high = blend(&q->s, weight, offsetof(vertex, w), 1);
    *low = remainder_of(&q->d, x, x_low, y, y_low, high);
    return high;
}

/* v to all its digits. Its error is that of the corners, a rounding of their size; near contact v is smaller still, and
 * its direction noise. Worked out from the corner that the weights single out, and once more made square to the
 * simplex, it is as good as the edges are. 0 where it vanishes. */
static int sharpen(search *q, const real weight[DIM + 1])
{
    vec low;
    vec high = single_out(q, weight, &low), v = square_to(&q->s, add(high, low));
    real vv = dot(v, v);
    if (is_faded(vv)) return 0;
    q->v = v;
    q->vv = vv;
    return 1;
}

/* The height of w along v, to more digits than one number can say. */
static twin height_to_twice(vec v, vec w, vec w_low)
{
    real l = length(v);
    if (!(l > 0)) return (twin){0, 0};
    twin along = {0, dot(v, w_low)}, square = product_of(-l, l);
    for (int i = 0; i < DIM; i++) {
        gather(&along, product_of(v.c[i], w.c[i]));
        gather(&square, product_of(v.c[i], v.c[i]));
    }
    real height = along.high / l; /* l is short by square / 2 l: so is the quotient too large */
    twin back = product_of(-height, l);
    gather(&back, along);
    return (twin){height, (back.high + back.low - height * (square.high + square.low) / (2 * l)) / l};
}

/* |v| to more digits than one number can say: the height of the corner that the weights single out, along v made square
 * to the simplex. What the weights are off moves that corner across v, and so counts for nothing. */
static twin refine(const search *q, const real weight[DIM + 1])
{
    vec w_low, w = single_out(q, weight, &w_low);
    return height_to_twice(square_to(&q->s, add(w, w_low)), w, w_low);
}

/* The height of w, the corner least along v, bounds the separation from below. The normal is divided, not multiplied,
 * so that along an axis it is 1, and taken from 0, which has no sign. */
static inline void raise(search *q, vec v, vec w)
{
    real l = length(v), k = 1 / l, height = dot(v, w) * k;
    real lower = height - 5 * UNIT * (size(height) + dot_size(v, w) * k) - q->d.doubt - q->d.slack;
    if (!(lower > q->lower)) return;
    q->lower = lower;
    EACH(q->normal.c[i] = 0 - v.c[i] / l);
}

static int repeats(const vertex *p, const vertex *q)
{
    return p->x.c[0] == q->x.c[0] && p->y.c[0] == q->y.c[0] && same(p->x, q->x) && same(p->y, q->y);
}

/* Takes the corner in the spare slot into the simplex. 0, and nothing changed, where that brings v no nearer. Near
 * contact |v| is noise of a rounding of the corners, while their gap may still promise more than that: up to SIDESTEPS
 * times in a query, v may stay where it is to within that noise. */
static inline int advance(search *q)
{
    simplex *s = &q->s;
    int at[DIM + 1], n = s->n;
    memcpy(at, s->at, sizeof at);
    q->borrowed &= ~(1u << at[n]);
    s->n = n + 1;
    vec v = nearest(s, q->weight);
    real vv = dot(v, v);
    q->weighed = 1;
    if (!(vv < q->vv)) { /* once more without assumptions */
        /* of corners in a frame of size 1 to 2; a v without direction has nothing to gain */
        real noise = vanished(q) ? 0 : 16 * UNIT * root(q->vv);
        memcpy(s->at, at, sizeof at);
        s->n = n + 1;
        q->weighed = 0;
        v = nearest_of_all(s, 1u << n, 1, noise);
        vv = dot(v, v);
        if (!(vv < q->vv + noise) || q->sidesteps >= SIDESTEPS) {
            memcpy(s->at, at, sizeof at);
            s->n = n;
            return 0;
        }
        q->sidesteps++;
    }
    q->v = v;
    q->vv = vv;
    q->pending = 0;
    return 1;
}

/* v anew, of a simplex that nothing is known of. A full one that holds the origin, but is so narrow that rounding may
 * have put it there, gives way to the face that the origin is nearest to: it does not count as a whole. */
static void project(search *q, int whole)
{
    q->weighed = whole && part(&q->s, (1u << q->s.n) - 1, 0, &q->v, q->weight);
    if (!q->weighed) q->v = nearest_of_all(&q->s, 0, whole, 0);
    q->vv = dot(q->v, q->v);
}

/* A full simplex gives way to its part that is nearest the origin: of some that are as near, to what rounding hides,
 * one with the newest corner, which was lower than all without it. */
static void give_way(search *q)
{
    const int newest = q->s.at[DIM];
    simplex other = q->s;
    project(q, 0);
    for (int i = 0; i < q->s.n; i++)
        if (q->s.at[i] == newest) return;
    const vec v = nearest_of_all(&other, 1u << DIM, 0, 0);
    const real vv = dot(v, v);
    if (!(vv < q->vv + 16 * UNIT * root(q->vv))) return;
    q->s = other;
    q->v = v;
    q->vv = vv;
}

/* What w of a corner lost to rounding. */
static vec lost_of(const search *q, const vertex *p)
{
    const difference *d = &q->d;
    return remainder_of(d, mul(p->x, d->a.grain), axis(0, 0), mul(p->y, d->b.grain), axis(0, 0), p->w);
}

/* What rounding may make of the gap between v and a corner's height. */
static inline real noise_along(vec v, vec w) { return UNIT / 2 * dot_size(v, w); }

/* By how many roundings of the gap a corner may lie lower than a simplex of n, and still be left out where an exact
 * finish could take it in. v of an edge or a face rounds itself, that of a single corner does not. */
static inline real forgiven(int n) { return (real)(n == 1 ? 0.25 : n == 2 ? 1 : 4); }

/* The corner in the spare slot lies lower along v than the simplex, by more than is forgiven, without the roundings of
 * either. */
static int is_lower(const search *q)
{
    const vertex *from = corner(&q->s, 0), *last = corner(&q->s, q->s.n);
    real gap = dot(q->v, add(sub(from->w, last->w), sub(lost_of(q, from), lost_of(q, last))));
    return gap > forgiven(q->s.n) * noise_along(q->v, last->w);
}

/* As wide may a bracket of the cores be that ends there. */
static inline real asked_of(const goal *g, real upper)
{
    return g->abs_tol + g->rel_tol * (upper - g->radius) - 16 * UNIT * (upper + g->radius); /* the radius taken off */
}

/* Whether v is near enough, or the bracket narrow enough; OPEN: neither. */
static enum end judge(const search *q, const goal *g)
{
    real weight[DIM + 1], upper = root(q->vv) + q->d.doubt, asked = asked_of(g, upper);
    if (upper < g->within && certify(q, weight) < g->within) return WITHIN;
    if (g->deep && g->radius > 0 && !(upper < g->radius || q->lower > g->radius)) return OPEN; /* that is to be told */
    return upper - q->lower <= asked && certify(q, weight) - q->lower <= asked ? CLOSE : OPEN;
}

/* What the corner in the spare slot shows; OPEN where the search may go on. */
static inline enum end consider(search *q, const goal *g)
{
    const vertex *last = spare(&q->s);
    q->steps++;
    q->pending = 1;
    raise(q, q->v, last->w);
    if (q->lower > g->beyond) {
        if (q->s.n == 0) advance(q);
        return BEYOND;
    }
    if (q->s.n > 0) {
        real gap = dot(q->v, sub(q->v, last->w));
        for (int i = 0; i < q->s.n; i++) q->repeated |= repeats(corner(&q->s, i), last);
        if (q->repeated) return STILL;
        if (!(gap > noise_along(q->v, last->w))) {
            q->stuck = g->exact && !g->sign_only && is_lower(q);
            return STILL;
        }
    }
    if (!advance(q)) {
        q->stuck = 1;
        return STILL;
    }
    if (q->s.n > DIM) {
        q->inside = room_inside(q);
        if (q->inside > q->d.doubt || q->sidesteps++ >= SIDESTEPS) return INSIDE;
        enum end end = g->early ? judge(q, g) : OPEN;
        if (end != OPEN) return end;
        q->around = q->s;
        q->borrowed_around = q->borrowed;
        give_way(q);
    }
    if (vanished(q)) return STILL;
    return g->early ? judge(q, g) : OPEN;
}

/* p was handed out just now. If it is one of the lender's, to the bit, the sets are still those that it knew. */
static int known(search *q, const vertex *p)
{
    const cache *k = q->lender;
    if (!k) return 0;
    for (uint32_t i = 0; i < k->count && i <= DIM; i++) { /* a callback may have written to the cache since it lent */
        if (!same(load(k->a[i]), p->x) || !same(load(k->b[i]), p->y)) continue;
        q->lender = NULL;
        return 1;
    }
    return 0;
}

/* Asks for the corner least along q->v, into the spare slot. */
static int look(search *q)
{
    if (!ask(&q->d, q->v, spare(&q->s))) return 0;
    known(q, spare(&q->s));
    return 1;
}

/* How many of the first corners are asked for along another way than v. */
#define HEADINGS (DIM - 1)

/* Where the next corner is sought, of a point or an edge: v is the way to the nearest of very few points, and says less
 * of where the bodies meet than the line of centres does. So what leads along the corner is taken off that, and half as
 * much again; across an edge the two are halved. v itself, where the corner does not lie on the other side of the
 * origin. */
static inline vec heading(const search *q, vec centres)
{
    vec v = q->v;
    real back = dot(centres, point(&q->s, 0));
    if (q->s.n > 2 || !(back < 0)) return v;
    if (q->s.n == 1) return sub(mul(centres, q->vv), mul(v, (real)1.5 * back));
    vec e = sub(point(&q->s, 1), point(&q->s, 0)), across = sub(mul(centres, dot(e, e)), mul(e, dot(centres, e)));
    return add(mul(v, leveler(peak(v))), mul(across, (real)0.75 * leveler(peak(across))));
}

/* One of the first corners, sought elsewhere than along v; one that leads nowhere is left. */
static enum end set_out(search *q, const goal *g)
{
    vec way = heading(q, first_direction(&q->d));
    if (same(way, q->v) || q->steps >= g->max_steps) return OPEN;
    if (!ask(&q->d, way, spare(&q->s))) return FAULT;
    const vertex *last = spare(&q->s);
    q->steps++;
    q->pending = 1;
    raise(q, way, last->w);
    if (q->lower > g->beyond) return BEYOND;
    q->pending = 0;
    if (!(q->vv - dot(q->v, last->w) > noise_along(q->v, last->w)) || !advance(q)) return OPEN;
    if (vanished(q)) return STILL;
    return g->early ? judge(q, g) : OPEN;
}

/* Walks on from the corner in the spare slot, least along q->v. */
static enum end descend(search *q, const goal *g)
{
    if (vanished(q)) {
        if (q->s.n <= DIM) return STILL;
        q->inside = room_inside(q);
        return INSIDE;
    }
    int headings = q->s.n == 0 && g->sign_only ? HEADINGS : 0; /* round bodies take many more steps to the rest */
    for (;;) {
        enum end end = consider(q, g);
        for (; headings > 0 && end == OPEN; headings--) end = set_out(q, g);
        if (end != OPEN || q->steps >= g->max_steps) return end;
        if (!look(q)) return FAULT;
    }
}

/* The bracket of the distance is wider than roundings of its corners explain. */
static int coarse(const search *q, real upper) { return upper - larger(q->lower, 0) > 4 * q->d.doubt + q->d.slack; }

/* The search ended like that. Where v was too coarse to prove what it found, it goes on along the sharpened v, unless
 * that is left to an exact finish. upper and weight are those of the simplex that is left. */
static enum end sharpen_on(search *q, const goal *g, enum end end, real *upper, real weight[DIM + 1])
{
    *upper = certify_end(q, g, &end, weight);
    for (int i = 0; i < SHARPENINGS && end == STILL && coarse(q, *upper) && !g->exact; i++) {
        if (!sharpen(q, weight)) break;
        if (q->steps >= g->max_steps) return OPEN;
        if (!look(q)) return FAULT;
        q->repeated = 0;
        end = descend(q, g);
        *upper = certify_end(q, g, &end, weight);
    }
    return end;
}

static enum end search_on(search *q, const goal *g, real *upper, real weight[DIM + 1])
{
    return sharpen_on(q, g, descend(q, g), upper, weight);
}

static void blank(search *q)
{
    clear(&q->s);
    q->vv = REAL_MAX;
    q->lower = -4; /* deeper than the frame is wide no overlap is */
    q->normal = axis(0, 1);
    q->pending = 0;
    q->repeated = 0;
    q->stuck = 0;
    q->sidesteps = 0;
    q->steps = 0;
    q->lender = NULL;
    q->borrowed = 0;
    q->kept = 0;
    q->weighed = 0;
    q->around.n = 0;
}

/* A direction along which the simplex's first corner is likely the least: v, tilted away from the others. */
static vec away(const search *q)
{
    vec middle = axis(0, 0), p = point(&q->s, 0);
    for (int i = 0; i < q->s.n; i++) middle = add(middle, mul(point(&q->s, i), (real)1 / (real)q->s.n));
    vec tilt = sub(middle, p);
    real long_side = peak(tilt), far = peak(q->v);
    if (!(far > 0)) return levelled(tilt);
    return levelled(long_side > 0 ? add(q->v, mul(tilt, far / long_side / 1024)) : q->v);
}

/* From nothing. */
static int open_cold(search *q, const shape *a, const shape *b, real slack)
{
    blank(q);
    if (!start(&q->d, a, b)) return 0;
    q->v = first_direction(&q->d);
    return meet(&q->d, q->v, slack, spare(&q->s));
}

/* Whether the cache holds points of these sets, as far as their names say. */
static int lends(const cache *k, const shape *a, const shape *b)
{
    return k->count > 0 && k->count <= DIM + 1 && k->support[0] == a->support && k->support[1] == b->support &&
           k->data[0] == a->data && k->data[1] == b->data;
}

static inline void keep_whose(cache *k, const search *q, const shape *a, const shape *b)
{
    k->reach_a = q->d.a.reach;
    k->reach_b = q->d.b.reach;
    k->support[0] = a->support;
    k->support[1] = b->support;
    k->data[0] = a->data;
    k->data[1] = b->data;
}

/* Its points as corners on trust. 0: they are not within the reaches. */
static int take_over(search *q, const cache *k)
{
    for (uint32_t i = 0; i < k->count; i++) {
        vertex *p = spare(&q->s);
        p->x = load(k->a[i]);
        p->y = load(k->b[i]);
        if (!fits(&q->d.a, p->x) || !fits(&q->d.b, p->y)) return 0;
        p->w = corner_of(&q->d, p->x, p->y);
        q->s.n++;
    }
    return 1;
}

/* And where they stand. */
static int borrow(search *q, const cache *k)
{
    if (!take_over(q, k)) return 0;
    q->lender = k;
    q->borrowed = (1u << k->count) - 1;
    project(q, 1);
    return 1;
}

/* From the points of the last query, as corners on trust: they are points of these sets only if the sets still answer
 * as they did. The search ends well if no borrowed corner is left in its simplex, or if one of the lender's points was
 * handed out again, to the bit; see settled. The first call also tells whether the reaches are the same. */
static int open_warm(search *q, const shape *a, const shape *b, real slack, const cache *k)
{
    real reach[2];
    vertex first;
    blank(q);
    if (!start(&q->d, a, b) || !lends(k, a, b)) return 0;
    if (!(k->reach_a > 0 && k->reach_a <= REAL_MAX && k->reach_b > 0 && k->reach_b <= REAL_MAX)) return 0;
    know_reach(&q->d.a, k->reach_a);
    know_reach(&q->d.b, k->reach_b);
    if (!settle(&q->d, slack) || !borrow(q, k)) return 0;
    vec dir = vanished(q) ? away(q) : q->v;
    if (!ask_first(&q->d, dir, &first, reach)) return 0;
    first.w = corner_of(&q->d, first.x, first.y);
    if (reach[0] != 0 && reach[0] != k->reach_a) return 0;
    if (reach[1] != 0 && reach[1] != k->reach_b) return 0;
    q->repeated = known(q, &first);
    if (!vanished(q)) {
        *spare(&q->s) = first;
        return 1;
    }
    q->steps++; /* on the origin, where v has no direction: a corner handed out again is all that is wanted */
    raise(q, dir, first.w);
    return q->repeated;
}

/* Whether the simplex's corners are points of the sets for certain. Where none of the lender's points came back by
 * itself, one more corner is asked for, along v tilted a little toward one of them. */
static int settled(search *q)
{
    vertex p;
    unsigned left = 0;
    for (int i = 0; i < q->s.n; i++) left |= q->borrowed & 1u << q->s.at[i];
    if (!q->lender || !left) return 1;
    return ask(&q->d, away(q), &p) && known(q, &p);
}

/* Where the corner handed out last proves the sets apart, and that is all that is asked, it alone is the simplex:
 * whether borrowed corners are good is of no account then. The cache must not get that corner beside others that nobody
 * has vouched for: handed out again, it would vouch for them; so it stays as it is, for the next query. */
static void stand_on_last(search *q)
{
    simplex *s = &q->s;
    int last = s->at[s->n];
    s->at[s->n] = s->at[0];
    s->at[0] = last;
    s->n = 1;
    q->pending = 0;
    q->borrowed = 0;
    q->kept = 1;
}

#endif
