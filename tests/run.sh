#!/bin/sh
# SPDX-License-Identifier: MIT
# Sets up and passes every test, on a bare Debian 12 or wherever the tools below are present already.
# As root it installs what is missing by apt-get; otherwise it says what that is, and stops.
set -eu
cd "$(dirname "$0")/.."

say() { printf '\n== %s\n' "$*"; }

. tests/tools.sh
links_fuzzers() { echo 'int LLVMFuzzerTestOneInput(void) { return 0; }' | clang -fsanitize=fuzzer,address -x c - -o /dev/null; }
look() {
    need gcc command -v gcc
    need g++ command -v g++
    need make command -v make
    need cmake cmake --list-presets # 3.25 or later
    need clang clang++ --version
    need clang-format command -v clang-format
    need libclang-rt-14-dev links_fuzzers
    need pkg-config command -v pkg-config
    need libcmocka-dev pkg-config --exists cmocka
    need libgmp-dev pkg-config --exists gmp
    need libccd-dev pkg-config --exists ccd
    need libbox2d-dev pkg-config --exists box2d
    need cargo-web knows_crates # brings Box2D 3; Debian's plain cargo is too old
    need valgrind command -v valgrind
    need chromium command -v chromium
    need chromium-driver command -v chromedriver
    need python3-venv python3 -c 'import ensurepip, venv'
    need python3-dev python3 -c 'import os, sysconfig; os.stat(sysconfig.get_path("include") + "/Python.h")'
}

say 'Looking for the tools'
get_tools

CMAKE_BUILD_PARALLEL_LEVEL=$(nproc)
CTEST_PARALLEL_LEVEL=$CMAKE_BUILD_PARALLEL_LEVEL
GJK_COMPARE_NEEDS='libccd box2d2 box2d3' # a test fails where these peers are missing
export CMAKE_BUILD_PARALLEL_LEVEL CTEST_PARALLEL_LEVEL GJK_COMPARE_NEEDS
for preset in release clang asan-ubsan; do
    say "C: $preset"
    cmake --workflow --preset $preset
done

say 'Fuzzing'
GJK_FUZZ_SEED=1 fuzz/run.sh 5000x # the same each time: what is new is found by longer runs

say 'Python: setting up'
python3 -m venv build/venv
build/venv/bin/pip install -q './bindings/python[test]' -r examples/requirements.txt -r tests/compare/requirements.txt

# One run each, as pytest takes its settings from beside the tests; the bindings' beside the others', which take as long.
run_pytest() { build/venv/bin/python -m pytest -q "$1"; }
failed=0
run_pytest bindings/python/tests >build/bindings.log 2>&1 &
bindings=$!
for tests in tests/oracle tests/compare examples; do
    say "Python: $tests"
    run_pytest "$tests" || failed=1
done
say 'Python: bindings/python/tests'
wait $bindings || failed=1
cat build/bindings.log
[ $failed -eq 0 ]

say 'All tests passed'
