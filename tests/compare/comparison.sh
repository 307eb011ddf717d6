#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds what measures the library beside its peers, error against run time, runs it, and writes docs/comparison.md, its
# plot and the page anew.
#
#   sh tests/compare/comparison.sh [PAIRS [ROUNDS [SEED [OUT]]]]     of each class, of timing; default 100, 21, 1, docs
#
# Whose libraries, and from where: build.sh. The build stays in build/comparison. Ends with 1 where the library failed;
# the page is written even so.
set -eu
cd "$(dirname "$0")/../.."
pairs=${1:-100} rounds=${2:-21} seed=${3:-1} folder=${4:-docs}
. tests/compare/build.sh

set_up comparison
python3 -m venv $build/venv # first what may be missing, then the long work
$build/venv/bin/pip install -q './bindings/python[report]'

bench() { # PAIRS_FILE ROUNDS RESULTS [COMMAND...]
    file=$1 rounds_here=$2 results=$3
    shift 3
    tr '\n' '\0' <$out/everyone.txt | xargs -0 "$@" $out/bench "$file" "$rounds_here" "$results" || [ $? -eq 123 ]
}
say 'timing'
sh tests/compare/draw_all.sh $out "$pairs" "$seed" $out/pairs.bin
bench $out/pairs.bin "$rounds" $out/comparison.jsonl env
counted=
count() { # double or float
    GJK_COMPARE_CLASSES=" $1 " bench $out/counted.bin 0 "$out/counted.$1.jsonl" \
        sh tests/compare/count.sh "$out/counts.$1"
}
if command -v valgrind >/dev/null; then # it takes its time: a tenth of the pairs, and a core for each precision
    say 'counting instructions'
    sh tests/compare/draw_all.sh $out $(((pairs + 9) / 10)) "$seed" $out/counted.bin
    count float &
    count double
    wait $!
    counted="--counted $out/counted.double.jsonl $out/counted.float.jsonl --counts $out/counts.double $out/counts.float"
else
    echo 'valgrind is not installed: instructions are not counted'
fi
say 'writing the pages'
# shellcheck disable=SC2086 # arguments
$build/venv/bin/python tests/compare/comparison.py --command "sh tests/compare/comparison.sh $pairs $rounds $seed" $counted \
    -o "$folder/comparison.md" --html build/comparison/index.html --plot "$folder/comparison.svg" \
    -- $out/comparison.jsonl
