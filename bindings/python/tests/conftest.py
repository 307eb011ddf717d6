# SPDX-License-Identifier: MIT
"""Hypothesis settings: the same examples in each run, and no stop watch."""

from hypothesis import HealthCheck, settings

settings.register_profile(
    "gjk", deadline=None, derandomize=True, max_examples=150, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("gjk")
