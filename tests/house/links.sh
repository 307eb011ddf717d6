#!/bin/sh
# SPDX-License-Identifier: MIT
# Every link of a page to a file of this repository leads to one.
set -eu
pages=$(git ls-files --cached --others --exclude-standard '*.md')
[ -n "$pages" ]
dead=$(printf '%s\n' "$pages" | while read -r page; do
    [ ! -f "$page" ] || grep -oE '\]\([^)#: ]+' "$page" | sed 's/^](//' | while read -r link; do
        [ -e "$(dirname "$page")/$link" ] || echo "$page: $link"
    done
done)
[ -z "$dead" ] || { printf 'dead links:\n%s\n' "$dead"; exit 1; }
