# SPDX-License-Identifier: MIT
import gjk

cube = gjk.Box((1, 1, 1))
rod = gjk.Capsule(0.5, 1, pose=[0.8, 0, -0.6, 4, 0, 1, 0, 0, 0.6, 0, 0.8, 0])
r = gjk.distance(cube, rod)
print(f"distance {r.value:.6g}, proven to be in [{r.lower!r}, {r.upper!r}]")
