#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds what measures the library beside its peers, runs it, and writes docs/stability.md anew.
#
#   sh tests/compare/stability.sh [PAIRS [SEED [PAGE]]]     pairs of each family in each variant; default 500, 1
#
# Whose libraries, and from where: build.sh. The build stays in build/comparison. Ends with 1 where the library failed;
# the page is written even so.
set -eu
cd "$(dirname "$0")/../.."
pairs=${1:-500} seed=${2:-1} page=${3:-docs/stability.md}
. tests/compare/build.sh

set_up stability
say 'asking everyone'
measure() { # VARIANT...
    for variant; do
        tr '\n' '\0' <$out/peers.txt |
            xargs -0 $out/stability.$variant "$pairs" "$seed" $out/$variant.jsonl || [ $? -eq 123 ]
    done
}
measure gjk3 gjk2 &
measure gjk3f gjk2f
wait $!
python3 tests/compare/page.py --command "sh tests/compare/stability.sh $pairs $seed" -o "$page" \
    $out/gjk2.jsonl $out/gjk2f.jsonl $out/gjk3.jsonl $out/gjk3f.jsonl
