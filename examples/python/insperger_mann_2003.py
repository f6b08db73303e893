# %% [markdown]
# # Cuts of an experiment against the chart
# After `thinwall run cases/insperger-mann-2003-up` (or `-down`): which cuts are predicted rightly, and how far the wrong
# ones lie beside the boundary.

# %%
import sys

import thinwall

results = thinwall.read_results(sys.argv[1] if len(sys.argv) > 1 else "results/insperger-mann-2003-up")  # or "results/insperger-mann-2003-down"
chart = results.lobes["tool"]
observed = results.summary["lobes"][0]["observed"]
share = observed["prediction"]
print(f"{share['right']} of {share['of']} right, 95 % interval {share['low']:.2f} to {share['high']:.2f}")

# %%
for cut in observed["cuts"]:
    if cut["right"] is False:
        print(f"{cut['spindle_speed_rpm']:.0f} rpm, {1e3 * cut['depth_m']:.2f} mm: {cut['observed']}, boundary "
              f"{1e3 * cut['depth_margin_m']:+.2f} mm away")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    plt.plot(chart["spindle_speed_rpm"], 1e3 * chart["limiting_depth_m"])
    for seen, mark in {"stable": "o", "chatter": "x", "marginal": "d"}.items():
        cuts = [cut for cut in observed["cuts"] if cut["observed"] == seen]
        plt.plot([cut["spindle_speed_rpm"] for cut in cuts], [1e3 * cut["depth_m"] for cut in cuts], mark, label=seen)
    plt.xlabel("spindle speed, rpm")
    plt.ylabel("limiting depth, mm")
    plt.legend()
    plt.show()
