# %% [markdown]
# # A rib from an STL file
# After `thinwall run cases/pocketed-rib`: how thick the walls of the part are, what its receptance at the tool looks like,
# and the lobes.

# %%
import sys

import numpy as np
import thinwall

results = thinwall.read_results(sys.argv[1] if len(sys.argv) > 1 else "results/pocketed-rib")
surface = thinwall.read_vtu(results.folder / "modes" / "wall_thickness.vtp")
corners = surface["Points"][surface["connectivity"].reshape(-1, 3)]
area = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
thickness = surface["wall_thickness_m"]
thin = area[thickness < 2.1e-3].sum() / area.sum()
print(f"walls from {1e3 * thickness.min():.2f} mm; {100 * thin:.0f} % of the surface lies on walls of 2 mm and less")

# %% [markdown]
# A hammer test at the tool would show the same receptance. What a fit of its peaks finds is what was put in: the modes of
# the model, each with a damping ratio of 0.6 %.

# %%
response = results.frf["part"]
H = response.entry("P.x", "P.x")
for hz, ratio in thinwall.identify_modes(response.frequency_hz, H):
    print(f"peak at {hz:7.1f} Hz, damping {100 * ratio:.2f} %")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    chart = results.lobes["part"]
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(12, 4))
    left.hist(1e3 * thickness, weights=1e6 * area, bins=40)
    left.set(xlabel="wall thickness, mm", ylabel="surface, mm²")
    middle.semilogy(response.frequency_hz, abs(H))
    middle.set(xlabel="frequency, Hz", ylabel="|H| at P along x, m/N")
    right.plot(chart["spindle_speed_rpm"], 1e3 * chart["limiting_depth_m"])
    right.set(xlabel="spindle speed, rpm", ylabel="limiting depth, mm")
    plt.show()
