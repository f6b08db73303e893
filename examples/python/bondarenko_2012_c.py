# %% [markdown]
# # A robot enters a border
# After `thinwall run cases/bondarenko-2012-c`: the deflection of the tip, averaged over each tooth.

# %%
import sys

import numpy as np
import thinwall

results = thinwall.read_results(sys.argv[1] if len(sys.argv) > 1 else "results/bondarenko-2012-c")
point = results.summary["simulation"]["points"][0]
trace = results.simulation["tool-1"]
for approach in point["approach"]:
    if approach["final_m"]:
        print(
            f"{approach['direction']:6s} ends at {1e3 * approach['final_m']:8.4f} mm, overshoot "
            f"{100 * approach['overshoot']:5.1f} %, within 2 % after {approach['settling_2_s']:.3f} s"
        )

# %% [markdown]
# The same from the trace: means over a tooth period, of which the file has 24 samples each.

# %%
samples = 24
teeth = len(trace["time_s"]) // samples
time = trace["time_s"][: teeth * samples : samples]
means = {axis: trace[f"{axis}_m"][: teeth * samples].reshape(teeth, samples).mean(axis=1) for axis in "xy"}
end = means["x"][-teeth // 10 :].mean()
print(f"from the trace: ends at {1e3 * end:.4f} mm, overshoot {100 * (np.max(means['x'] / end) - 1):.1f} %")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    for axis, mean in means.items():
        plt.plot(time, 1e3 * mean, label=f"along {axis}")
    plt.xlabel("time, s")
    plt.ylabel("deflection, mm")
    plt.legend()
    plt.show()
