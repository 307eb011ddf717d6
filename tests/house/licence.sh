#!/bin/sh
# SPDX-License-Identifier: MIT
# Every file says its licence in its first lines, save data formats that have no room for it.
set -eu
files=$(git ls-files --cached --others --exclude-standard)
[ -n "$files" ]
bare=$(printf '%s\n' "$files" | grep -vE '(^|/)(LICENSE|py\.typed|layout-lp64\.txt|symbols\.txt|inner\.txt)$|/licences/|^fuzz/corpus/|\.(json|jsonl|png|svg)$' |
    while read -r file; do
        [ ! -f "$file" ] || head -n 3 "$file" | grep -q 'SPDX-License-Identifier: ' || echo "$file"
    done)
[ -z "$bare" ] || { printf 'without a licence line:\n%s\n' "$bare"; exit 1; }
