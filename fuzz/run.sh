#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds the fuzzers and runs them all, as many at once as there are cores.
#
#   fuzz/run.sh [-k] MINUTES [TARGET.VARIANT...]
#   fuzz/run.sh EXECUTIONSx [TARGET.VARIANT...]
#
# With GJK_FUZZ_SEED set the fuzzers draw from that seed.
# MINUTES is for all of them together, and may be a fraction; 5000x is 5000 executions of each, which with a seed and
# nothing in build/fuzz/corpus are all but the same every time (without help from memcmp, which sees addresses).
# Each starts from the inputs in fuzz/corpus and from what earlier runs left in build/fuzz/corpus, and stops at its first
# finding; with -k it goes on. Findings are kept in build/fuzz/found; with any the exit status is 1.
set -eu
export LC_ALL=C # logs hold bytes of inputs
cd "$(dirname "$0")/.."

usage() { sed -n 's/^# \{0,1\}//; 4,12p' "$0"; exit 2; }
keep_on=
if [ "${1-}" = -k ]; then
    keep_on='-fork=1 -ignore_crashes=1 -ignore_timeouts=1 -ignore_ooms=1'
    shift
fi
runs=
case ${1-} in
'' | *[!0-9.x]* | *x?* | x) usage ;;
*x) runs=${1%x} minutes=20 ;; # no more than these
*) minutes=$1 ;;
esac
shift
if [ $# -eq 0 ]; then
    for target in distance intersect penetration options hostile; do
        for variant in gjk2 gjk2f gjk3 gjk3f; do set -- "$@" $target.$variant; done
    done
fi

cores=$(nproc)
cmake --preset fuzz >/dev/null
# shellcheck disable=SC2046 # one word for each target
cmake --build --preset fuzz -j "$cores" --target $(printf 'fuzz.%s ' "$@") >/dev/null
build=build/fuzz
seconds=$(awk "BEGIN { s = int($minutes * 60 * ($# < $cores ? $# : $cores) / $#); print s < 1 ? 1 : s }")
if [ -n "$runs" ]; then each="$runs executions"; else each="$seconds s"; fi
echo "$# fuzzers, $each each, $cores at once"

running=
# shellcheck disable=SC2086 # one word for each process
stop() { [ -z "$running" ] || kill $running 2>/dev/null || :; }
trap stop EXIT
trap 'exit 130' INT TERM HUP

mkdir -p $build/log
for name; do
    kept=$build/corpus/$name
    found=$build/found/$name
    mkdir -p "$kept" "$found"
    # shellcheck disable=SC2086 # no word, or some
    timeout -k 10 $((seconds + 60)) $build/fuzz/fuzz."$name" $keep_on -max_total_time="$seconds" -timeout=10 \
        -rss_limit_mb=2048 -max_len=600 -print_final_stats=1 -artifact_prefix="$found/" \
        ${GJK_FUZZ_SEED:+-seed="$GJK_FUZZ_SEED"} ${runs:+-runs="$runs" -reload=0 -use_cmp=0} \
        "$kept" "fuzz/corpus/${name%.*}" >"$build/log/$name" 2>&1 &
    running="$running $!"
    if [ "$(echo "$running" | wc -w)" -ge "$cores" ]; then
        # shellcheck disable=SC2086
        wait $running || :
        running=
    fi
done
# shellcheck disable=SC2086
[ -z "$running" ] || wait $running || :
running=

failed=0
total=0
printf '%-18s %12s %8s %14s %8s %7s %9s\n' fuzzer executions 'per s' 'edges seen' features inputs findings
for name; do
    log=$build/log/$name
    last=$(grep -a 'cov: ' "$log" | tail -n 1)
    executions=$(echo "$last" | sed -n 's/^#\([0-9]*\).*/\1/p')
    if [ -n "$keep_on" ]; then # many processes, none of which saw all: count again what the kept inputs reach
        timeout 120 "$build/fuzz/fuzz.$name" -runs=0 "$build/corpus/$name" >"$log.kept" 2>&1 || :
        last=$(grep -a 'cov: ' "$log.kept" | tail -n 1)
    fi
    edges=$(sed -n 's/.*Loaded 1 modules *(\([0-9]*\) inline.*/\1/p' "$log" | head -n 1)
    number() { echo "$last" | sed -n "s/.* $1: *\([0-9]*\).*/\1/p"; }
    rate=$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")
    findings=$(find "$build/found/$name" -type f -newer "$build/fuzz/fuzz.$name" | wc -l)
    printf '%-18s %12s %8s %14s %8s %7s %9s\n' "$name" "${executions:-0}" "${rate:-$((${executions:-0} / seconds))}" \
        "$(number cov | grep . || echo '?')/${edges:-?}" "$(number ft)" "$(number corp)" "$findings"
    total=$((total + ${executions:-0}))
    failed=$((failed + findings))
done
echo "$total executions, $failed findings"
for name; do
    for input in "$build/found/$name"/*; do
        if [ -e "$input" ] && [ "$input" -nt "$build/fuzz/fuzz.$name" ]; then
            echo
            echo "$build/fuzz/fuzz.$name $input"
            timeout 20 $build/fuzz/fuzz."$name" "$input" 2>&1 |
                grep -a -A 8 '^gjk\|ERROR: \|runtime error' | grep -av '^ *#[0-9]\|^==' || :
        fi
    done
done
[ "$failed" -eq 0 ]
