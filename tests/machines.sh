#!/bin/sh
# SPDX-License-Identifier: MIT
# Compiles the library and tests/bits.c for another machine, and runs it there: equal inputs give equal bits.
#
#   sh tests/machines.sh 'COMPILER FLAGS' [RUNNER]     e.g. 'aarch64-linux-gnu-gcc -O2 -static' qemu-aarch64
set -eu
cd "$(dirname "$0")/.."
compiler=${1:?'COMPILER FLAGS'} runner=${2-} out=build/machines
mkdir -p $out
for variant in gjk2:2:0 gjk2f:2:1 gjk3:3:0 gjk3f:3:1; do
    is_float=${variant##*:} dim=${variant#*:}
    printf '%s: %s\n' "$compiler" "${variant%%:*}"
    # shellcheck disable=SC2086 # flags are words
    $compiler -ffp-contract=off -DGJK_STATIC -DVARIANT_DIM="${dim%:*}" -DVARIANT_FLOAT="$is_float" -Iinclude \
        -o $out/bits tests/bits.c src/*.c -lm
    $runner $out/bits
done
