#!/bin/sh
# SPDX-License-Identifier: MIT
# How much flash each variant takes, alone and with parts left out, in bytes of code and constants.
#
#   sh tests/sizes.sh 'COMPILER FLAGS' [SIZE]
#
# e.g. 'arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard -Os' arm-none-eabi-size
set -eu
cd "$(dirname "$0")/.."
compiler=${1:?'COMPILER FLAGS'} size=${2-size} out=build/sizes
mkdir -p $out

bytes() { # VARIANT, and what is defined
    variant=$1
    shift
    # shellcheck disable=SC2086 # flags are words
    $compiler -std=c99 -ffp-contract=off -DNDEBUG -DGJK_STATIC "$@" -Iinclude -c "src/$variant.c" -o $out/variant.o
    $size $out/variant.o | awk 'NR == 2 { print $1 + $2 }'
}

printf '%-8s %8s %13s %9s %9s %9s %9s\n' variant whole NO_SHORTCUTS NO_ROUND NO_EXACT NO_DEPTH 'all four'
for variant in gjk2f gjk3f gjk2 gjk3; do
    printf '%-8s %8s %13s %9s %9s %9s %9s\n' $variant "$(bytes $variant -DGJK_ALONE)" \
        "$(bytes $variant -DGJK_ALONE -DGJK_NO_SHORTCUTS)" "$(bytes $variant -DGJK_ALONE -DGJK_NO_ROUND)" \
        "$(bytes $variant -DGJK_ALONE -DGJK_NO_EXACT)" "$(bytes $variant -DGJK_ALONE -DGJK_NO_DEPTH)" \
        "$(bytes $variant -DGJK_ALONE -DGJK_NO_SHORTCUTS -DGJK_NO_ROUND -DGJK_NO_EXACT -DGJK_NO_DEPTH)"
done
