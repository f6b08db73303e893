# %% [markdown]
# # A wall on its foot
# After `thinwall run cases/cantilever-wall`: modes, receptance and lobes of an aluminium wall, 120 × 60 × 2 mm.

# %%
import sys

import numpy as np
import thinwall

results = thinwall.read_results(sys.argv[1] if len(sys.argv) > 1 else "results/cantilever-wall")
hz = results.modes["modes"]["frequency_hz"]
print("by the program ", np.round(hz[:4], 1), "Hz")

# %% [markdown]
# The same wall in the module, then one of half the thickness: its bending frequencies are about half.

# %%
aluminium = thinwall.Material(youngs_modulus_Pa=70e9, poisson_ratio=0.33, density_kg_m3=2810.0)


def frequencies(thickness):
    mesh = thinwall.box_mesh((thickness, 0.120, 0.060), element_size=0.015)
    return thinwall.modes(thinwall.assemble(mesh, aluminium, fixed=["z_min"]), count=4).frequency_hz


print("by the module  ", np.round(frequencies(0.002), 1), "Hz")
print("half the wall  ", np.round(frequencies(0.001), 1), "Hz")

# %%
chart, response = results.lobes["part"], results.frf["part"]
H = {point: response.entry(f"{point}.x", f"{point}.x") for point in ("P", "corner")}
for point, values in H.items():
    print(f"largest receptance at {point:6s} {1e6 * np.max(abs(values)):6.1f} um/N")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    figure, (above, below) = plt.subplots(2)
    for point, values in H.items():
        above.semilogy(response.frequency_hz, abs(values), label=point)
    above.set(xlabel="frequency, Hz", ylabel="|H| along x, m/N")
    above.legend()
    below.plot(chart["spindle_speed_rpm"], 1e3 * chart["limiting_depth_m"])
    below.set(xlabel="spindle speed, rpm", ylabel="limiting depth, mm")
    plt.show()
