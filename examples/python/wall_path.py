# %% [markdown]
# # A path along a wall
# After `thinwall run cases/wall-path`: the limiting depth over position and speed, alone and with a robot that goes with
# the cutter.

# %%
import sys

import numpy as np
import thinwall

results = thinwall.read_results(sys.argv[1] if len(sys.argv) > 1 else "results/wall-path")
maps = {}
for name in ("part", "supported"):
    table = results.lobes[f"{name}_path"]
    y, speeds = np.unique(table["y_m"]), np.unique(table["spindle_speed_rpm"])
    maps[name] = table["limiting_depth_m"].reshape(len(y), len(speeds))
    whole = maps[name].min(axis=0)
    best, (weakest, _) = np.argmax(whole), np.unravel_index(np.argmin(maps[name]), maps[name].shape)
    print(f"{name:9s} weakest at y = {1e3 * y[weakest]:.0f} mm with {1e3 * maps[name].min():.3f} mm; "
          f"the whole path up to {1e3 * whole[best]:.3f} mm at {speeds[best]:.0f} rpm")

# %% [markdown]
# How stiff should the robot's pad be? The largest receptance at P in the middle of the path, over the stiffness of a pad
# with a loss factor of 0.1.

# %%
wall, robot = results.frf["part"], results.frf["robot"]


def held(stiffness):
    pad = thinwall.Contact("B", "R", "x", stiffness=stiffness, loss_factor=0.1)
    return thinwall.couple([wall, robot], [pad]).response.entry("P.x", "P.x")


stiffnesses = np.geomspace(1e4, 1e8, 17)
largest = [np.max(abs(held(stiffness))) for stiffness in stiffnesses]
print(f"softest at P: {1e6 * np.max(abs(wall.entry('P.x', 'P.x'))):.1f} um/N alone, {1e6 * min(largest):.2f} at best, "
      f"with a pad of {stiffnesses[np.argmin(largest)]:.1e} N/m")
program = results.frf["coupled_receptance"].entry("P.x", "P.x")
print(f"the pad of the case, here and by the program: equal to {np.max(abs(held(2e6) - program)) / np.max(abs(program)):.0e}")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    figure, (above, below) = plt.subplots(2)
    drawn = above.pcolormesh(speeds, 1e3 * y, np.log10(1e3 * maps["supported"]), shading="nearest")
    figure.colorbar(drawn, label="log10 of the limiting depth in mm")
    above.set(xlabel="spindle speed, rpm", ylabel="position, mm")
    below.loglog(stiffnesses, largest)
    below.set(xlabel="stiffness of the pad, N/m", ylabel="largest |H| at P, m/N")
    plt.show()
