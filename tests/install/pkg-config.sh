#!/bin/sh
# SPDX-License-Identifier: MIT
# pkg-config.sh shared|static COMPILER SOURCE PROGRAM: builds PROGRAM by pkg-config's flags alone and runs it.
# PKG_CONFIG names the tool, LIBDIR where the library was moved to, VERSION the one expected there.
set -eu
export PKG_CONFIG_LIBDIR="$LIBDIR/pkgconfig"
[ "$("$PKG_CONFIG" --modversion gjk)" = "$VERSION" ]
static=
[ "$1" = shared ] || static=--static
flags=$("$PKG_CONFIG" $static --cflags --libs gjk)
echo "flags: $flags"
# shellcheck disable=SC2086 # flags are words
"$2" "$3" -o "$4" ${static:+-static} $flags
LD_LIBRARY_PATH=$LIBDIR "./$4"
