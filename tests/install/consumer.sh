#!/bin/sh
# SPDX-License-Identifier: MIT
# consumer.sh CMAKE CTEST BUILD OPTION...: configures, builds and runs the consumer project from nothing.
set -eu
cmake=$1
ctest=$2
build=$3
shift 3
rm -rf "$build"
"$cmake" -S "$(dirname "$0")/consumer" -B "$build" "$@"
"$cmake" --build "$build" --config Release
cd "$build"
"$ctest" -C Release --output-on-failure --no-tests=error
