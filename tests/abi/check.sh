#!/bin/sh
# SPDX-License-Identifier: MIT
# What a compiled library shows, holds and asks for. NM and READELF name the tools.
#   check.sh layout RECORD PROGRAM HEADER...   PROGRAM prints RECORD, and RECORD names every struct of the headers
#   check.sh exports LIST... -D|-g LIBRARY  it exports the names in these, no more and no fewer (-D: shared, -g: static)
#   check.sh undefined LIBRARY            it asks its host for square roots, block copies and their comparison only
#   check.sh data OBJECT...               it holds no data that can be written, before or after relocation
#   check.sh soname NAME LIBRARY          it calls itself NAME and depends on libc and libm only
set -eu

none() { # WHAT, and on standard input the offenders: there must be none
    found=$(cat)
    [ -z "$found" ] || { printf '%s:\n%s\n' "$1" "$found"; exit 1; }
}

question=$1
shift
case $question in
layout)
    record=$1
    "$2" | diff -u "$record" -
    shift 2
    named=$(awk '/^[^ ]/ { print $1 }' "$record" | sort)
    declared=$(sed -n 's/^typedef struct \([a-z0-9_]*\).*/\1/p' "$@" | sort)
    [ "$named" = "$declared" ] || { printf 'recorded:\n%s\ndeclared:\n%s\n' "$named" "$declared"; exit 1; }
    ;;
exports)
    known=$(while [ -f "$1" ]; do cat "$1"; shift; done | sort)
    while [ -f "$1" ]; do shift; done
    found=$("$NM" "$1" --defined-only "$2" | awk 'NF == 3 { print $3 }' | sort)
    [ "$found" = "$known" ] || { printf 'exported:\n%s\nknown:\n%s\n' "$found" "$known"; exit 1; }
    ;;
undefined)
    # The second list is what compilers and the C run-time's start files put into any shared library.
    "$NM" -D --undefined-only "$1" | awk '{ sub(/@.*/, "", $2); print $2 }' |
        grep -vxE 'sqrtf?|mem(cpy|move|set|cmp)' |
        grep -vxE '__cxa_finalize|__gmon_start__|_ITM_(de)?registerTMCloneTable|__stack_chk_fail' |
        none 'asked of the host'
    ;;
data)
    sections=$("$READELF" -SW "$@" | sed 's/^ *\[ *[0-9]*\] *//')
    printf '%s\n' "$sections" | grep -q '^\.text ' # the listing is one that the next line can read
    printf '%s\n' "$sections" | awk '$7 ~ /W/ && $5 !~ /^0*$/ { print $1, "0x" $5 }' | none 'writable data'
    ;;
soname)
    dynamic=$("$READELF" -dW "$2" | sed -n 's/.*(\(SONAME\|NEEDED\)).*\[\(.*\)\]/\1 \2/p')
    printf '%s\n' "$dynamic"
    printf '%s\n' "$dynamic" | grep -qx "SONAME $1"
    printf '%s\n' "$dynamic" | grep -v ^SONAME | grep -vE '^NEEDED (libc|libm|ld-linux[^.]*)\.so' | none 'libraries needed'
    ;;
*)
    sed -n '3,8p' "$0"
    exit 2
    ;;
esac
