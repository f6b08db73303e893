# %% [markdown]
# # An arm that follows the cut
# After `thinwall run cases/huynh-2017-support`: a plate is cut along its edge, and a four-axis arm behind it takes a new
# posture at every position.

# %%
import sys

import numpy as np
import thinwall

results = thinwall.read_results(sys.argv[1] if len(sys.argv) > 1 else "results/huynh-2017-support")
arm = results.robot["postures"]
for y, stiffness, hz in zip(arm["tip_y_m"], arm["stiffness_x_n_per_m"], arm["frequency_1_hz"]):
    print(f"tip at y = {1e3 * y:5.1f} mm: {1e-6 * stiffness:5.2f} N/um along x, first mode {hz:.2f} Hz")

# %% [markdown]
# The plate and the arm in its middle posture once more, joined by a ball of 20 N/um.

# %%
contact = thinwall.Contact("B", "R", "x", stiffness=2e7)
coupled = thinwall.couple([results.frf["part"], results.frf["robot"]], [contact]).response.entry("P.x", "P.x")
program = results.frf["coupled_receptance"].entry("P.x", "P.x")
print(f"coupled here and by the program: equal to {np.max(abs(coupled - program)) / np.max(abs(program)):.0e}")

# %% [markdown]
# A program with one speed may cut as deep as the worst position allows.

# %%
path = {}
for name in ("part", "supported"):
    table = results.lobes[f"{name}_path"]
    y, speeds = np.unique(table["y_m"]), np.unique(table["spindle_speed_rpm"])
    path[name] = table["limiting_depth_m"].reshape(len(y), len(speeds))
    print(f"{name:9s} the whole path allows {1e3 * path[name].min(axis=0).max():.3f} mm at the best speed")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    figure, (above, below) = plt.subplots(2)
    above.plot(1e3 * arm["tip_y_m"], 1e-6 * arm["stiffness_x_n_per_m"], "o-")
    above.set(xlabel="tip along the plate, mm", ylabel="stiffness of the arm, N/um")
    for name, depth in path.items():
        below.semilogy(1e3 * y, 1e3 * depth.min(axis=1), "o-", label=name)
    below.set(xlabel="position along the plate, mm", ylabel="least depth of all speeds, mm")
    below.legend()
    plt.show()
