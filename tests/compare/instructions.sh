#!/bin/sh
# SPDX-License-Identifier: MIT
# Counts the instructions that answers take: of the library, and of the peers that are named, at their defaults.
#
#   sh tests/compare/instructions.sh [-n PAIRS] [-b BUILD] REGEX [PEER...]
#
# PAIRS of each class, default 20. BUILD is a folder that has been built, say build/release, and is taken as it is;
# without it build.sh sets up build/comparison.
# REGEX, an extended one, picks classes by the line "QUESTION DIM PRECISION CLASS STATE": distance, intersect or
# penetration, 2 or 3, double or float, then class and state as in the tables of docs/comparison.md. Peers: libccd fcl
# bullet box2d3 box2d2 parry jolt coal mujoco, as far as they could be had.
#
#   sh tests/compare/instructions.sh '^penetration 3 double (boxes|hulls of 8) (deep|stacked)' libccd coal
#
# A line for each class and question: instructions of an answer, of others also divided by ours, cold, then warm where
# a path is followed; what asking costs is taken off. Who is named and does not stand there does not take the class.
set -eu
cd "$(dirname "$0")/../.."
usage() {
    sed -n '3,/^set -eu/s/^# \{0,1\}//p' tests/compare/instructions.sh
    exit 2
}
. tests/compare/build.sh
pairs=20 built=
while getopts n:b: option; do
    case $option in
    n) pairs=$OPTARG ;;
    b) built=$OPTARG ;;
    *) usage ;;
    esac
done
shift $((OPTIND - 1))
[ $# -ge 1 ] || usage
GJK_COMPARE_CLASSES=$1
export GJK_COMPARE_CLASSES
shift

command -v valgrind >/dev/null || { echo 'valgrind is not installed' >&2; exit 1; }
if [ -n "$built" ]; then
    out=$built/tests/compare
else
    set_up bench draw_pairs.gjk3 draw_pairs.gjk3f draw_pairs.gjk2f >&2
fi
modules=
for peer in gjk3 gjk3f gjk2 gjk2f "$@"; do
    module=$(grep "^$peer=." "$out/everyone.txt") || {
        echo "no such peer: $peer; there are: $(sed -n '/^gjk/d; s/=..*//p' "$out/everyone.txt" | tr '\n' ' ')" >&2
        exit 1
    }
    [ -n "$built" ] || cmake --build $build --target "peer_$peer" >$build.log 2>&1 || fail
    modules="$modules $module"
done
counted=$out/instructions
sh tests/compare/draw_all.sh "$out" "$pairs" 1 "$counted.bin"
# shellcheck disable=SC2086 # a word for each module
sh tests/compare/count.sh "$counted" "$out/bench" "$counted.bin" 0 "$counted.jsonl" $modules >&2 || {
    echo "nothing was counted: is there a class that matches '$GJK_COMPARE_CLASSES'?" >&2
    exit 1
}
python3 tests/compare/instructions.py "$counted.jsonl" "$counted"
