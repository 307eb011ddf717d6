#!/bin/sh
# SPDX-License-Identifier: MIT
# Whether each part that a build leaves out is gone, with all that is there for it: kept, it makes the object larger by
# more than an eighth.
#   weigh.sh OBJECT COMPILER...
set -eu
object=$1
shift

bytes() { # COMPILER and what is defined
    "$@" -o "$object"
    size "$object" | awk 'NR == 2 { print $1 }'
}

failed=0
adds() { # PART BYTES BYTES: with it and without
    echo "$1: $2 bytes with it, $3 without"
    [ $(($2 * 8)) -gt $(($3 * 9)) ] || failed=1
}

no_shortcuts=-DGJK_NO_SHORTCUTS no_round=-DGJK_NO_ROUND no_exact=-DGJK_NO_EXACT
few=$(bytes "$@" $no_shortcuts $no_round $no_exact)
adds shortcuts "$(bytes "$@" $no_round $no_exact)" "$few"
adds round "$(bytes "$@" $no_shortcuts $no_exact)" "$few"
adds exact "$(bytes "$@" $no_shortcuts $no_round)" "$few"
adds depth "$few" "$(bytes "$@" $no_shortcuts $no_round $no_exact -DGJK_NO_DEPTH)"
exit $failed
