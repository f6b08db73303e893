# %% [markdown]
# # A tool that was never measured
# After `thinwall run cases/tool-swap`: the lobes of a carbide end mill, from FRFs taken with a steel rod in its place.

# %%
import sys

import numpy as np
import thinwall

results = thinwall.read_results(sys.argv[1] if len(sys.argv) > 1 else "results/tool-swap")
chart = results.lobes["tool"]
speeds, depths = chart["spindle_speed_rpm"], chart["limiting_depth_m"]
least = np.argmin(depths)
print(f"least depth {1e3 * depths[least]:.3f} mm at {speeds[least]:.0f} rpm ({chart['bifurcation'][least]})")

# %% [markdown]
# Above its limit a cut of two teeth chatters at half the tooth passing (flip) or at a frequency of its own (hopf).

# %%
passing_hz = 2 * speeds / 60
waves = chart["chatter_frequency_hz"] / passing_hz
for speed, word, count in zip(speeds, chart["bifurcation"], waves):
    if word:
        print(f"{speed:7.0f} rpm {word:5s} {count:6.3f} waves from tooth to tooth")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    figure, (above, below) = plt.subplots(2, sharex=True)
    above.plot(speeds, 1e3 * depths)
    above.set(ylabel="limiting depth, mm")
    below.plot(speeds, chart["chatter_frequency_hz"], ".", speeds, passing_hz / 2)
    below.set(xlabel="spindle speed, rpm", ylabel="chatter and half the tooth passing, Hz")
    plt.show()
