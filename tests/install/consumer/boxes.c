/* SPDX-License-Identifier: MIT */
/* Two unit boxes whose centres are 3 apart are 2 apart. C and C++. */
#include <gjk/gjk3.h>

#include <stdio.h>

int main(void)
{
    gjk3_box box = {{0.5, 0.5, 0.5}};
    gjk3_pose away = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {3, 0, 0}};
    gjk3_shape a = {gjk3_support_box, &box, NULL, 0};
    gjk3_shape b = {gjk3_support_box, &box, &away, 0};
    gjk3_result result;
    int status = gjk3_distance(&a, &b, NULL, &result);
    printf("%s: %.17g in [%.17g, %.17g]\n", gjk_status_name(status), result.value, result.lower, result.upper);
    return !(status >= 0 && result.lower <= 2 && 2 <= result.upper && result.upper - result.lower < 1e-12);
}
