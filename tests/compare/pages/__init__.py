# SPDX-License-Identifier: MIT
"""How the pages on comparison are written."""
