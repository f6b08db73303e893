# %% [markdown]
# # A robot at a posture where it was not tapped
# After `thinwall run cases/posture-map`: the modes of a milling robot were learned at 56 postures and predicted at another.

# %%
import sys

import numpy as np
import thinwall

results = thinwall.read_results(sys.argv[1] if len(sys.argv) > 1 else "results/posture-map")
chart = results.lobes["carried"]
for mode in results.summary["robot"]["modes"]:
    print(f"mode {mode['frequency_hz']:9.3f} Hz, damping {100 * mode['damping_ratio']:6.3f} %")

# %% [markdown]
# The arm's modes limit the slow speeds, the spindle's the fast ones.

# %%
speeds, depths = chart["spindle_speed_rpm"], chart["limiting_depth_m"]
hz = chart["chatter_frequency_hz"]
print(f"least limiting depth {1e3 * depths.min():.2f} mm at {speeds[np.argmin(depths)]:.0f} rpm, chatter at {hz[np.argmin(depths)]:.1f} Hz")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    plt.plot(speeds, 1e3 * depths)
    plt.xlabel("spindle speed, rpm")
    plt.ylabel("limiting depth, mm")
    plt.show()
