#!/bin/sh
# SPDX-License-Identifier: MIT
# program.sh CMAKE GJK BUILD OPTION...: programs that have as much of the library in them as they need.
set -eu
cmake=$1
gjk=$2
build=$3
shift 3
log=$build/log
rm -rf "$build"
mkdir -p "$build"

configure() { # SOURCE VARIANTS WITHOUT OPTION...
    source=$1 variants=$2 without=$3
    shift 3
    rm -rf "$build/made"
    "$cmake" -S "$gjk/tests/parts/program" -B "$build/made" -DGJK_SOURCE="$gjk" -DSOURCE="$gjk/examples/$source" \
        -DVARIANTS="$variants" -DWITHOUT="$without" "$@" >"$log" 2>&1
}
runs() {
    echo "$1 with $2 without '$3'"
    configure "$@" && "$cmake" --build "$build/made" --config Release >"$log" 2>&1 && "$build/made/program" >"$log" || {
        cat "$log"
        exit 1
    }
}
is_told() { # of what was refused
    grep -q -- "$1" "$log" || {
        cat "$log"
        echo "is to say: $1"
        exit 1
    }
}
refused() { # WHAT VARIANTS WITHOUT OPTION...
    what=$1
    shift
    ! configure embedded.c "$@" || { echo "not refused: $*"; exit 1; }
    is_told "$what"
}

runs embedded.c gjk2f 'SHORTCUTS;ROUND;DEPTH;EXACT' "$@"
runs embedded.c 'gjk2;gjk2f' DEPTH "$@" # float beside its sister
runs penetration.c 'gjk3;gjk2f' ROUND "$@"

configure penetration.c gjk3 DEPTH "$@"
! "$cmake" --build "$build/made" --config Release >"$log" 2>&1 || { echo 'penetration is there'; exit 1; }
is_told gjk3_penetration

refused "'gjk4' is none of" gjk4 '' "$@"
refused "'depth' is none of" gjk3 depth "$@"
refused 'GJK_VARIANTS is empty' '' '' "$@"
refused 'GJK_BUILD_SHARED is for a whole library' gjk3 '' -DGJK_BUILD_SHARED=ON "$@"
refused 'GJK_INSTALL is for a whole library' gjk3 '' -DGJK_INSTALL=ON "$@"
