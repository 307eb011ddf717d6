# SPDX-License-Identifier: MIT
"""python -m gjk is the command gjk."""

import sys

from .cli import main

sys.exit(main())
