# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Builds what the scripts beside it run, for them to include from the root of the checkout.
#
# A C compiler, cmake, GMP and Python are needed; who else is compared with is used where it is installed (Debian:
# libccd-dev libbox2d-dev libfcl-dev libbullet-dev), as its packager compiled it; cargo brings Box2D 3, Jolt and parry,
# compiled as the library is, and pip coal and MuJoCo. As root on Debian, what is missing is installed first. Who cannot
# be had is named as missing. GJK_COMPARE_LIBCCD in the environment, a folder with sources of libccd, has that compiled
# as the library is, too.
. tests/tools.sh

includes() { echo "#include <$1>" | gcc -E -; }
look() {
    need gcc command -v gcc
    need make command -v make
    need cmake command -v cmake
    need libc6-dev includes math.h
    need libgmp-dev includes gmp.h
    need python3-venv python3 -c 'import ensurepip, venv'
    need python3-dev python3 -c 'import os, sysconfig; os.stat(sysconfig.get_path("include") + "/Python.h")'
    can_use g++ command -v g++
    can_use pkg-config command -v pkg-config
    can_use libccd-dev pkg-config --exists ccd
    can_use libbox2d-dev pkg-config --exists box2d
    can_use libfcl-dev pkg-config --exists fcl
    can_use libbullet-dev pkg-config --exists bullet
    can_use cargo-web knows_crates
    can_use valgrind command -v valgrind # counts instructions
}

build=build/comparison # its log lies beside it
# shellcheck disable=SC2034 # for those who include it
out=$build/tests/compare

start=$(date +%s)
say() { printf '== after %d s: %s\n' $(($(date +%s) - start)) "$*"; }

set_up() { # TARGET...: builds these
    say 'looking for the tools'
    get_tools
    say 'building'
    mkdir -p build
    cmake -S . -B $build -DCMAKE_BUILD_TYPE=Release -DGJK_COMPARE_ALONE=ON -DGJK_COMPARE_CARGO=ON \
        -DGJK_COMPARE_PACKAGES=ON "-DGJK_COMPARE_LIBCCD=${GJK_COMPARE_LIBCCD:-}" >$build.log 2>&1 || fail
    grep '^-- Peer' $build.log
    cmake --build $build --parallel "$(nproc)" --target "$@" >$build.log 2>&1 || fail
}
fail() {
    cat $build.log
    exit 2
}
