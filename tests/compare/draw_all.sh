#!/bin/sh
# SPDX-License-Identifier: MIT
# Writes the one file of pairs that the bench reads.
#
#   draw_all.sh BUILT PAIRS SEED FILE     with the programs in the folder BUILT, so many pairs of each class
set -eu
built=$1 pairs=$2 seed=$3 file=$4
here=$(dirname "$0")
for variant in gjk3 gjk2f gjk3f; do
    "$built/draw_pairs.$variant" "$pairs" "$seed"
done >"$file"
python3 "$here/robot_pairs.py" "$here/../../examples/panda.json" "$pairs" "$file"
