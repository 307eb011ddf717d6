# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Sees to it that the tools are there which a script needs: the script includes this, says in a function `look` what it
# needs or can use, and calls `get_tools`.

need() { # PACKAGE COMMAND...: the package is there when the command succeeds
    has "$@" || missing="$missing $1"
}
can_use() { # PACKAGE COMMAND...: there is a way without it
    has "$@" || useful="$useful $1"
}
has() {
    shift
    "$@" >/dev/null 2>&1
}
knows_crates() { # of the edition 2024
    version=$(cargo --version) && minor=${version#cargo 1.} && [ "${minor%%.*}" -ge 85 ]
}
look_anew() {
    missing='' useful=''
    look
}
install() { DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "$@"; }

# As root it installs what is missing by apt-get; otherwise it says what that is, and stops where it is needed.
get_tools() {
    look_anew
    [ -n "$missing$useful" ] || return 0
    echo "missing:${missing:- nothing that is needed}${useful:+; of use:$useful}"
    if [ "$(id -u)" -ne 0 ] || ! command -v apt-get >/dev/null; then
        echo "install these, or run this as root on Debian: apt-get install$missing$useful"
        [ -z "$missing" ] || exit 1
        return 0
    fi
    apt-get update -q
    # shellcheck disable=SC2086 # one word for each package
    [ -z "$missing" ] || install $missing
    for package in $useful; do
        install "$package" || echo "cannot be had: $package"
    done
    look_anew
    [ -z "$missing" ] || { echo "still missing:$missing"; exit 1; }
}
