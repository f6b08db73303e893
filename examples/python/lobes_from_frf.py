# %% [markdown]
# # Lobes from a hammer test
# All that is known is a receptance of the tool tip along the feed. It is taken as it is: no mode is fitted.

# %%
import pathlib

import numpy as np
import thinwall

data = pathlib.Path(__file__).parents[1] / "data" / "tip.csv"
tip = thinwall.read_frf(data, "tip.x", quantity="receptance", unit="m/N")
H = tip.entry("tip.x", "tip.x")
print(f"{len(H)} lines up to {tip.frequency_hz[-1]:.0f} Hz, largest {1e6 * abs(H).max():.2f} um/N")

# %% [markdown]
# Slotting with four teeth. There the force does not change with the angle of the cutter, and the depth that is stable at
# every speed has a closed form, −1 / (2 K_r min Re H): a check of the chart.

# %%
slot = thinwall.MillingProcess(teeth=4, diameter_m=0.012, K_t=600e6, K_r=200e6, radial_depth_m=0.012, direction="up")
chart = thinwall.lobes(tip, slot, np.linspace(3000.0, 9000.0, 61), progress=lambda done, of: None)
closed_form = -1 / (2 * 200e6 * H.real.min())
print(f"least depth {1e3 * chart.minimum_depth_m:.3f} mm, by the closed form {1e3 * closed_form:.3f} mm")

# %% [markdown]
# What a fit would say of the same peak.

# %%
for hz, ratio in thinwall.identify_modes(tip.frequency_hz, H):
    print(f"peak at {hz:.1f} Hz, damping ratio {ratio:.4f}")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    figure, (above, below) = plt.subplots(2)
    above.plot(tip.frequency_hz, 1e6 * H.real, tip.frequency_hz, 1e6 * H.imag)
    above.set(xlabel="frequency, Hz", ylabel="receptance, um/N")
    below.plot(chart.spindle_speed_rpm, 1e3 * chart.limiting_depth_m)
    below.axhline(1e3 * closed_form, linestyle="--")
    below.set(xlabel="spindle speed, rpm", ylabel="limiting depth, mm")
    plt.show()
