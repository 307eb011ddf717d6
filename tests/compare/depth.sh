#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds what measures depths beside the library's peers, runs it, and writes docs/depth.md anew.
#
#   sh tests/compare/depth.sh [PAIRS [ROUNDS [SEED [PAGE]]]]     pairs of each class, rounds of timing; default 200, 51, 1
#
# libccd is used where it is installed (Debian: libccd-dev), as its packager compiled it; GJK_COMPARE_LIBCCD in the
# environment, a folder with its sources, has it compiled with the flags of the library instead. Instructions are counted
# where valgrind is installed. The build stays in build/depth. Ends with 1 where the library failed; the page is written
# even so.
set -eu
cd "$(dirname "$0")/../.."
pairs=${1:-200} rounds=${2:-51} seed=${3:-1} page=${4:-docs/depth.md}
build=build/depth # its log lies beside it
out=$build/tests/compare
mkdir -p build

cmake -S . -B $build -DCMAKE_BUILD_TYPE=Release "-DGJK_COMPARE_LIBCCD=${GJK_COMPARE_LIBCCD:-}" >$build.log 2>&1 ||
    { cat $build.log; exit 2; }
grep '^-- Peer' $build.log
cmake --build $build --parallel "$(nproc)" --target depth >$build.log 2>&1 || { cat $build.log; exit 2; }

depth() { # ROUNDS RESULTS [COMMAND...]
    rounds_here=$1 results=$2
    shift 2
    tr '\n' '\0' <$out/peers_in_space.txt |
        xargs -0 "$@" $out/depth.gjk3 "$pairs" "$rounds_here" "$seed" "$results" || [ $? -eq 123 ]
}
depth "$rounds" $out/depth.jsonl env
counted=
if command -v valgrind >/dev/null; then
    rm -rf $out/counts
    mkdir $out/counts
    depth 0 $out/counted.jsonl valgrind -q --tool=callgrind --instr-atstart=no \
        --callgrind-out-file=$out/counts/callgrind.%p 2>/dev/null
    counted="--counted $out/counted.jsonl --counts $out/counts"
else
    echo 'valgrind is not installed: instructions are not counted'
fi
# shellcheck disable=SC2086 # arguments
python3 tests/compare/depth_page.py --command "sh tests/compare/depth.sh $pairs $rounds $seed" $counted -o "$page" \
    $out/depth.jsonl
