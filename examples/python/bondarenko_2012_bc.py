# %% [markdown]
# # A robot enters a border
# After `thinwall run cases/bondarenko-2012-b` and `-c`: the deflection of the tip, averaged over each tooth. In case C
# the tip yields along the feed and across.

# %%
import sys

import numpy as np
import thinwall

folders = sys.argv[1:] or ["results/bondarenko-2012-b", "results/bondarenko-2012-c"]
runs = [thinwall.read_results(folder) for folder in folders]
for results in runs:
    print(results.folder.name)
    for approach in results.summary["simulation"]["points"][0]["approach"]:
        if approach["final_m"]:
            print(
                f"{approach['direction']:6s} ends at {1e3 * approach['final_m']:8.4f} mm, overshoot "
                f"{100 * approach['overshoot']:5.1f} %, within 2 % after {approach['settling_2_s']:.3f} s"
            )

# %% [markdown]
# The same from the trace: means over a tooth period, of which the file has 24 samples each.

# %%
samples = 24


def tooth_means(results):
    trace = results.simulation["tool-1"]
    teeth = len(trace["time_s"]) // samples
    means = {axis: trace[f"{axis}_m"][: teeth * samples].reshape(teeth, samples).mean(axis=1) for axis in "xy"}
    return trace["time_s"][: teeth * samples : samples], means


for results in runs:
    time, means = tooth_means(results)
    end = means["x"][-len(time) // 10 :].mean()
    print(f"from the trace: ends at {1e3 * end:.4f} mm, overshoot {100 * (np.max(means['x'] / end) - 1):.1f} %")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    for results in runs:
        time, means = tooth_means(results)
        for axis, mean in means.items():
            plt.plot(time, 1e3 * mean, label=f"{results.folder.name} along {axis}")
    plt.xlabel("time, s")
    plt.ylabel("deflection, mm")
    plt.legend()
    plt.show()
