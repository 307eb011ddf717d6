// SPDX-License-Identifier: MIT
#include "boxes.c"
