# SPDX-License-Identifier: MIT
"""How deep sets with curved cores lie in each other, between proven bounds.

gjk.exact leaves that open: such a set has no facets to count. But a polytope of its points has, and grown where it is
nearest to 0 it closes in on the depth from within, as the best of the directions does from without. Where the depth is
that of one direction only, each corner more makes the gap smaller by about the same factor."""

from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

from alone import exact

GAP_BITS = 84  # solved when the bracket is 2**-84 of the pair's size
MOST_CORNERS = 420  # the bracket holds wherever it stops


@dataclass(frozen=True)
class Separation:
    """Between which bounds the signed separation is, and what proves it."""

    lower: Fraction
    upper: Fraction
    direction: tuple | None  # the certificate of lower, where a support value along it is; else that of the truth
    corners: tuple = ()  # the certificate of upper: (point of core a, point of core b), ...; each gives a w = b - a
    facets: tuple = ()  # of which of them: a closed shell about 0, nowhere nearer than the cores are deep


def spanning(pair, spots):
    """Spots that span the space, with 0 in their hull, from affinely independent ones with 0 in theirs. None where all
    found lie on one side of them."""
    while len(spots) <= pair.dim:
        d = exact.across([exact.minus(s[0], spots[0][0]) for s in spots[1:]], pair.dim)
        found = [pair.farthest(way)[0] for way in (d, tuple(-x for x in d))]
        found = [s for s in found if exact.dot(d, s[0])]
        if not found:
            return None
        spots = spots + found[:1]
    return spots


def grown(pair, spots):
    """Of the cores: the best bound from a direction, that direction, and the shell. The bound is below 0."""
    inside = tuple(map(sum, zip(*(s[0] for s in spots))))
    facets = [exact.facet(corners, spots, inside) for corners in combinations(range(len(spots)), pair.dim)]
    size = max(abs(x) for s in spots for x in s[0])
    lower, best = None, None
    while True:
        near = min(facets, key=lambda f: f.level)
        upper = -exact.root(near.level, False)
        for n in dict.fromkeys((exact.shorten(near.n), near.n)):
            direction = tuple(-x for x in n)
            spot, least = pair.farthest(direction)
            bound = least / exact.root(Fraction(exact.dot(n, n)), least > 0)
            if best is None or bound > lower:
                lower, best = bound, direction
            beyond = exact.dot(near.n, spot[0]) > near.h
            if beyond:
                break
        if not beyond or upper - lower <= Fraction(size, 1 << GAP_BITS) or len(spots) == MOST_CORNERS:
            return lower, best, upper, spots, facets
        spots = spots + [spot]
        facets = exact.grow(facets, spots, inside)


def depth(truth, a, b, dim):
    """Of sets that overlap by their curved cores."""
    pair = exact.Pair(a, b, dim)
    unit, radii = Fraction(1, 1 << pair.grid), pair.ra + pair.rb
    start = [tuple(tuple(int(x / unit) for x in p) for p in s[1:]) for s in truth.corral]
    spots = spanning(pair, [(exact.minus(q, p), p, q) for p, q in start])
    if spots is None:
        raise exact.Unproven("the cores have no ball in common")
    lower, direction, upper, spots, facets = grown(pair, spots)
    return Separation(
        lower=exact.rounded((lower - radii) * unit, False),
        upper=exact.rounded((upper - radii) * unit, True),
        direction=direction,
        corners=tuple(tuple(tuple(x * unit for x in p) for p in s[1:]) for s in spots),
        facets=tuple(f.corners for f in facets),
    )


def separation(truth, a, b, dim):
    """The signed separation of two shapes whose relation is proven."""
    if truth.relation == exact.TOUCHING:
        return Separation(Fraction(0), Fraction(0), truth.direction)
    if truth.separation is None:
        return depth(truth, a, b, dim)
    return Separation(*truth.separation, truth.direction, truth.corners, truth.facets)
