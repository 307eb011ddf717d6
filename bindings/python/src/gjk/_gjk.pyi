# SPDX-License-Identifier: MIT
# The extension module. What is in ffi and lib, the headers say.
from typing import Any

ffi: Any
lib: Any
