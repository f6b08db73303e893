# %% [markdown]
# # The two-DOF benchmark
# After `thinwall run cases/ding-2010`: the chart on which methods for stability lobes are compared.

# %%
import sys

import numpy as np
import thinwall

results = thinwall.read_results(sys.argv[1] if len(sys.argv) > 1 else "results/ding-2010")
chart = results.lobes["tool"]
speeds, depths = chart["spindle_speed_rpm"][::10], chart["limiting_depth_m"][::10]

# %% [markdown]
# The same chart by three methods. At a tenth of the diameter the cut is short: 40 steps from tooth to tooth are few for
# it, and the average of its force, which is all that the zeroth order keeps, has no flips.

# %%
tool = thinwall.oscillators([(922.0, 0.011, 1340049.648, direction) for direction in "xy"], "tip")
cut = thinwall.MillingProcess(teeth=2, diameter_m=0.010, K_t=600e6, K_r=200e6, radial_depth_m=0.001, direction="down")
charts = {
    method: thinwall.lobes(tool, cut, speeds, depth_limit_m=0.010, method=method)
    for method in ("direct", "full_discretization_2", "zeroth_order")
}
for method, by_method in charts.items():
    off = np.max(abs(by_method.limiting_depth_m / depths - 1))
    print(f"{method:22s} off by {100 * off:7.3f} % at most, {by_method.kind.count('flip'):2d} flips")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    plt.plot(chart["spindle_speed_rpm"], 1e3 * chart["limiting_depth_m"], label="program")
    for method, by_method in charts.items():
        plt.plot(speeds, 1e3 * by_method.limiting_depth_m, ".", label=method)
    plt.xlabel("spindle speed, rpm")
    plt.ylabel("limiting depth, mm")
    plt.legend()
    plt.show()
