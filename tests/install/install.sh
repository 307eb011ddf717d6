#!/bin/sh
# SPDX-License-Identifier: MIT
# install.sh CMAKE BUILD CONFIG PREFIX: installs elsewhere, moves the whole to PREFIX, and looks for the old place in it.
set -eu
first=$4.first
rm -rf "$first" "$4"
"$1" --install "$2" --config "$3" --prefix "$first"
mv "$first" "$4"
if grep -rFI -e "$first" -e "$2" "$4"; then
    echo 'an installed file names a place it was made in'
    exit 1
fi
