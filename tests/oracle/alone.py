# SPDX-License-Identifier: MIT
"""`from alone import exact`: gjk.exact from this tree, without the package around it, which needs the C core."""

import importlib.util
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
_spec = importlib.util.spec_from_file_location("gjk_exact", ROOT / "bindings/python/src/gjk/exact.py")
exact = importlib.util.module_from_spec(_spec)
sys.modules[_spec.name] = exact
_spec.loader.exec_module(exact)
