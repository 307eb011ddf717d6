/* SPDX-License-Identifier: MIT */
/* How thin bodies are told: at a glance, if it is only asked whether they meet, else, or if that does not tell, finely;
 * without a frame, and in the frame if sizes are not plain; before anything is set up for the rest, if nothing else is
 * asked. */
#ifndef GJK_CORE_THIN_DOOR_H
#define GJK_CORE_THIN_DOOR_H

#include "thin_glance.h"
#include "wide_sticks.h"

/* Without a frame. UNCLEAR: the sizes are none for that. */
HOT enum glanced tell_thin(difference *d, const shape *a, const shape *b, const goal *g, result *r)
{
    const int boxed = d->a.asked == AS_BOX || d->b.asked == AS_BOX;
    stay_outside(d, a, b);
    d->slack = 0;
    if (g->sign_only) {
        const enum glanced seen = boxed ? glance_at_point(d, a, b, r) : glance_at_sticks(d, a, b, r);
        if (seen != IN_VAIN) return seen;
    }
    return boxed ? tell_box_outside(d, a, b, g, r) : tell_sticks_outside(d, a, b, g, r);
}

/* The square of a rounding of the whole is a normal number, so that no square that counts underflows: where a reach is
 * said to be far more than it is, the bodies are next to nothing in the frame. */
static inline int is_whole_of_note(real whole) { return UNIT * whole * (UNIT * whole) > REAL_MIN / UNIT; }

/* In the frame, where the sizes were none to do without. */
static APART int tell_thin_in_frame(difference *d, const shape *a, const shape *b, const goal *g, result *r)
{
    const difference before = *d;
    const int of_a = d->a.asked == AS_BOX, boxed = of_a || d->b.asked == AS_BOX;
    const real level_a = level_of_map(&d->a), level_b = level_of_map(&d->b);
    const vec uu_a = squared_axes(&d->a, level_a), uu_b = squared_axes(&d->b, level_b);
    const real map_a = square_of_map(&d->a, uu_a), map_b = square_of_map(&d->b, uu_b);
    const real set_a = square_of_thin(&d->a, d->a.grain, 1 / level_a);
    const real set_b = square_of_thin(&d->b, d->b.grain, 1 / level_b);
    const real whole = root(map_a * set_a + map_b * set_b + dot(d->c, d->c)), level = of_a ? level_a : level_b;
    if (!is_whole_of_note(whole)) return 0;
    if (g->sign_only && glance_at_thin_in_frame(d, whole, level, of_a ? uu_a : uu_b, a, b, r)) return 1;
    d->doubt = GLANCE_DOUBT * whole + (d->wild ? d->lost : 0);
    know_norms(d, root(map_a) / level_a, root(map_b) / level_b);
    know_offset(d, a, b);
    sticks k;
    if (!boxed) place_sticks(d, duo_of(d->a.grain, d->b.grain), 1, &k);
    if (boxed ? tell_point_and_box(d, level, of_a ? uu_a : uu_b, a, b, g, r) : tell_sticks(d, &k, a, b, g, r)) return 1;
    *d = before;
    return 0;
}

/* ---- the door ---- */

/* A point or a segment, or a box, by what the caller says it is. 0: none of these. */
HOT int list_thin(body *k, const shape *s)
{
    static const real nothing[DIM] = {0};
    take_pose(k, s);
    if (s->support == pub(support_box)) return take_box(k, s->data);
    k->asked = AS_LIST;
    if (s->support == pub(support_segment)) {
        const segment *e = s->data;
        if (!e) return 0;
        k->list = (list){e->v[0], 2, DIM, 0, NULL};
        return 1;
    }
    k->list = (list){nothing, 1, DIM, 0, NULL};
    return s->support == pub(support_origin);
}

/* Of two thin bodies, before anything else is set up. UNTRIED: they are none. */
HOT enum glanced tell_thin_at_once(const shape *a, const shape *b, cache *own, const goal *g, result *r)
{
    difference d;
    enum glanced seen = TELLING;
    if (are_boxes(a, b)) return UNTRIED;
    if (!tell_wide_sticks(a, b, g, r)) {
        if (!list_thin(&d.a, a) || !list_thin(&d.b, b) || !are_thin(&d)) return UNTRIED;
        seen = tell_thin(&d, a, b, g, r);
    }
    if (seen == TELLING && own) own->count = 0; /* there is nothing that a formula would start from */
    return seen;
}

#endif
