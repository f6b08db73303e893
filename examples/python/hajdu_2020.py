# %% [markdown]
# # What cuts teach
# After `thinwall run cases/hajdu-2020`, or better `thinwall calibrate cases/hajdu-2020`: how often the chart of the tap
# test is right, and what the cuts make of it.

# %%
import sys

import thinwall

results = thinwall.read_results(sys.argv[1] if len(sys.argv) > 1 else "results/hajdu-2020")
chart = results.lobes["tool"]
summary = results.summary["lobes"][0]
observed = summary["observed"]
print(f"tap test: {observed['prediction']['right']} of {observed['prediction']['of']} right")
print(f"median difference of heard frequencies: {100 * observed['median_frequency_difference_relative']:.1f} %")

# %%
learned = summary.get("learned")
if learned:
    print(f"after: {learned['after']['right']} of {learned['after']['of']} right")
    for p in learned["parameters"]:
        print(f"{p['parameter']:14s} {p['before']:10.4g} -> {p['after']:10.4g}, moved {p['moved']:+.2f} deviations")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    plt.plot(chart["spindle_speed_rpm"], 1e3 * chart["limiting_depth_m"], label="tap test")
    if learned:
        rows = learned["rows"]
        plt.plot([row["spindle_speed_rpm"] for row in rows], [1e3 * row["median_m"] for row in rows], label="learned")
    for seen, mark in {"stable": "o", "chatter": "x", "marginal": "d"}.items():
        cuts = [cut for cut in observed["cuts"] if cut["observed"] == seen]
        plt.plot([cut["spindle_speed_rpm"] for cut in cuts], [1e3 * cut["depth_m"] for cut in cuts], mark, label=seen)
    plt.xlabel("spindle speed, rpm")
    plt.ylabel("limiting depth, mm")
    plt.legend()
    plt.show()
