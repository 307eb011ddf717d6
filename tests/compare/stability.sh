#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds what measures the library beside its peers, runs it, and writes docs/stability.md anew.
#
#   sh tests/compare/stability.sh [PAIRS [SEED [PAGE]]]     pairs of each family in each variant; default 500, 1
#
# Peers are used where they are installed (Debian: libccd-dev libbox2d-dev libfcl-dev libbullet-dev); cargo brings Box2D
# 3, parry and Jolt, pip coal and MuJoCo. The build stays in build/stability. Ends with 1 where the library failed; the
# page is written even so.
set -eu
cd "$(dirname "$0")/../.."
pairs=${1:-500} seed=${2:-1} page=${3:-docs/stability.md}
build=build/stability # its log lies beside it
out=$build/tests/compare
mkdir -p build

cmake -S . -B $build -DCMAKE_BUILD_TYPE=Release -DGJK_COMPARE_CARGO=ON \
    -DGJK_COMPARE_PACKAGES=ON >$build.log 2>&1 || { cat $build.log; exit 2; }
grep '^-- Peer' $build.log
cmake --build $build --parallel "$(nproc)" --target stability \
    >$build.log 2>&1 || { cat $build.log; exit 2; }

measure() { # VARIANT...
    for variant; do
        tr '\n' '\0' <$out/peers.txt |
            xargs -0 $out/stability.$variant "$pairs" "$seed" $out/$variant.jsonl || [ $? -eq 123 ]
    done
}
measure gjk3 &
measure gjk3f gjk2 gjk2f
wait $!
python3 tests/compare/page.py --command "sh tests/compare/stability.sh $pairs $seed" -o "$page" \
    $out/gjk2.jsonl $out/gjk2f.jsonl $out/gjk3.jsonl $out/gjk3f.jsonl
