#!/bin/sh
# SPDX-License-Identifier: MIT
# Weakens the library in one place at a time and says which test notices; see README.md. A long job.
exec python3 "$(dirname "$0")/run.py" "$@"
