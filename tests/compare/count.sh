#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs the bench, its rounds 0, so that callgrind counts instructions, and says how many labels it wrote.
#
#   count.sh FOLDER BENCH ARGUMENT...     with a file for each label in FOLDER, made anew
set -eu
folder=$1
shift
rm -rf "$folder"
mkdir "$folder"
valgrind -q --tool=callgrind "--callgrind-out-file=$folder/callgrind.%p" "$@"
count=$(grep -l '^desc: Trigger: Client Request' "$folder"/* | wc -l)
echo "$count labels"
[ "$count" -gt 0 ]
