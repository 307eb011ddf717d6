# SPDX-License-Identifier: MIT
"""The words that the comparison's pages have in common, in Markdown without links."""

import time

from .writing import machine

LEAD = """\
How exact gjk and other libraries are on everyday pairs of bodies, and what that costs: the same pairs for all, every
answer judged by exact truth. A class is a hundred or so pairs of one kind in one state, asked one question: how far
apart boxes are that nearly touch, say."""
PLOT = "Largest error against run time of gjk and other libraries, each through its settings"
MARKS = """\
What the library set out to reach, and how far it has come: everyone at its defaults, each class and state of pairs
for itself. Mean (geometric) and least are of theirs ÷ ours, the median time that they take divided by ours: above 1
they are slower. In the last two rows they are largest errors, theirs to ours. Sound is who answers all right and
errs by no more than 1e-14 scales. *Beyond reach* is a mark where what they take leaves less time than two calls of our
support functions alone, one of each body and without its pose: so fast is nobody who asks these for a corner."""
NOT_FIRST = """\
Everyone at its defaults, and cold, without a cache of an answer before, if not said to be warm. Ours is the variant
in the precision of the pairs, for those in float gjk2f or gjk3f, if nothing else is said. Faster is by median time;
more exact by the largest error of a class, of those who have no wrong and no failed answer in it. Among the faster,
who has none either, and is off by no more than ours or than 4 roundings of the scale, counts as *as good*."""
BY_CLASS = """\
By class: in how many of its states someone as good is faster, and the fastest of all these, with the part of our time
that it takes."""
BY_LIBRARY = """\
By library: the mean (geometric) of its time divided by ours, below 1 it is the faster; then in how many classes it
is faster, and in how many of these as good; then in how many it is more exact, in brackets as above. Which classes
these are, the page with all plots lists."""
BY_ERROR = """\
By class, where someone is more exact: in how many of its states; of pairs in float, in brackets, in how many of
these also than ours in double. Then the largest error, theirs to ours, where they lead by most, and who that is."""
COUNTS = "Of all answers at the defaults, cold and warm."
TIMES = """\
Ours: nanoseconds (median) and, where they were counted, instructions an answer. Of the others what each takes divided
by that: by time, by instructions."""
WARM = "The same with caches kept along a path of small steps."
ERRORS = "Largest error, in scales, of a depth then the largest excess; then how many answers are wrong or failed."
VERDICTS = "How many answers are wrong or failed."
REPLAY = """\
Of each library up to two pairs that it answers wrong, or not, at its defaults. The numbers are those that it was fed.
`gjk query`, which comes with the Python package, says what ours answers: `echo 'CASE' | gjk query`."""
HOW_TO_READ = """\
Each class of pairs is drawn at random, from a seed. *Near* is how far apart the bodies are; *shallow* and *deep* ones
overlap, *stacked* ones touch; along a *path* one body moves in small steps, apart from the other, along an *inner path*
overlapping it. Sizes are about 1, and the *scale* of a pair is its largest coordinate relative to a point between the
bodies. An *error* is how far the distance, or the depth, is off the truth, in scales. A *rounding* is 2^-53 of the
scale, in float 2^-24: of the numbers that a library has where its answers are judged, of those that the pairs have
where libraries are held against each other. The truth is exact: whole numbers of any length where the bodies are
spelled by their corners, else a bracket of 113 bits. *Promised* is the width of the widest bracket that ours returned:
the true error is never larger.

An answer is *wrong* where a distance or depth is off by more than a hundredth of itself, by more than 4 roundings,
and by more than its setting allows; a verdict that is wrong further from contact than that; and of ours, at any
setting, a bracket without the truth in it. It *failed* where there was no number, or one beyond a million scales, or
no normal, where an overlap deeper than that was not seen, where no verdict came though contact is 300 roundings
away, and where the process died or took more than a quarter of a second. The *excess* of a depth is how much further
than the depth the second body must be moved along the normal that came back, at most."""
FAIR = """\
All libraries answer in one process, from the same file of pairs: in each round everyone in turn answers all pairs of
the class, and once more off the clock before that, so that all find their bodies in the caches. What asking costs by
itself is measured with an empty call and taken off. Instructions are counted by callgrind, of ours at every setting
and of the others at their defaults, on some of the pairs, what asking costs taken off, too; they do not depend on
the machine's mood. All code that is compiled here is compiled with -O3; installed libraries are as their packagers
compiled them. Settings are those that each library comes with or that its documentation advises, warm starts
included; then its accuracy is swept through its tolerance or its number of steps. The peers' support functions are
plain ones, as their manuals have them, and look at every corner, as ours do of fewer than 32. Of more, ours look at
few, by an index that is made before the clock runs (`gjk3_index_points`), as coal makes its hulls' neighbours; with
GJK_COMPARE_SCANS set they look at all. Who asks for less accuracy does less work.
Libraries in double are asked about pairs in float, too, as they come, ours among them; they find them easier. parry
keeps rotations as quaternions, and takes the nearest ones; MuJoCo keeps the corners of hulls as floats; the MPR of
libccd looks for a way out, not for the shortest, and is held to that one like all. Ours proves its bracket, rounding
included, in all of these times; the others return what they have got."""


def head(measured):
    """What was run, when and where."""
    head = measured.head
    made = f"{head['compiler']}{', ' + head['flags'] if head.get('flags') else ''}"
    missing = f"Missing: {', '.join(measured.missing)}." if measured.missing else "No library is missing."
    counted = f"; instructions of {measured.counted} of them" if measured.counted else ""
    return (
        f"{time.strftime('%Y-%m-%d', time.gmtime())}: gjk {head['version']}, {head['pairs']} pairs of each class and"
        f" state, seed {head['seed']}, {head['rounds']} rounds{counted}; {made}; {machine()}. {missing}"
    )
