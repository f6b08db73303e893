# %% [markdown]
# # A robot that mills
# After `thinwall run cases/huynh-2017`: a four-axis arm carries the spindle, and the cut feels its tip.

# %%
import sys

import numpy as np
import thinwall

results = thinwall.read_results(sys.argv[1] if len(sys.argv) > 1 else "results/huynh-2017")
chart = results.lobes["carried"]
for mode in results.summary["robot"]["modes"]:
    print(f"mode {mode['frequency_hz']:9.4f} Hz, damping {100 * mode['damping_ratio']:6.3f} %")

# %% [markdown]
# Where the boundary lies, and how far the published cut of 1.6 mm at 18 700 rpm is from it.

# %%
speeds, depths = chart["spindle_speed_rpm"], chart["limiting_depth_m"]
print(f"least limiting depth {1e3 * depths.min():.2f} mm at {speeds[np.argmin(depths)]:.0f} rpm")
at = results.summary["lobes"][0]["at_case_speed"]["limiting_depth_m"]
print(f"at the published speed {1e3 * at:.2f} mm, {at / 1.6e-3:.1f} times the published depth")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    plt.plot(speeds, 1e3 * depths)
    plt.plot([18700], [1.6], "o")
    plt.xlabel("spindle speed, rpm")
    plt.ylabel("limiting depth, mm")
    plt.show()
