# %% [markdown]
# # From a plate to its stability lobes
# An aluminium wall, 120 × 60 × 2 mm, clamped along its foot, is milled at its free edge, first alone and then with a
# robot that holds its back 15 mm beside the cut.

# %%
import numpy as np
import thinwall

mesh = thinwall.box_mesh((0.002, 0.120, 0.060), element_size=0.02)
aluminium = thinwall.Material(youngs_modulus_Pa=70e9, poisson_ratio=0.33, density_kg_m3=2810.0)
wall = thinwall.assemble(mesh, aluminium, fixed=["z_min"])
modes = thinwall.modes(wall, count=6)
print("modes of the wall  ", np.round(modes.frequency_hz, 1), "Hz")

# %% [markdown]
# The wall is reduced to the point where it is cut, C, and to that where it is held, P, and gets 0.6 % damping in every
# mode.

# %%
C = thinwall.Point("C", (0.002, 0.075, 0.058), radius=0.0015)
P = thinwall.Point("P", (0.000, 0.060, 0.050), directions="x", radius=0.005)
reduced = thinwall.craig_bampton(wall, [C, P], up_to_hz=20e3)
part = thinwall.with_modal_damping(reduced.model, 0.006)
print(f"reduced from {wall.K.shape[0]} to {part.K.shape[0]} degrees of freedom")

# %% [markdown]
# The robot's tip, one mode across the wall, moves with P.

# %%
robot = thinwall.oscillators([(30.0, 0.02, 1.2e6, "x")], "R")
supported = thinwall.couple([part, robot], [thinwall.Contact("P", "R", "x")])

# %%
cut = thinwall.MillingProcess(
    teeth=4, diameter_m=0.012, K_t=600.46e6, K_r=180.96e6, radial_depth_m=0.0005, feed=(0, 1, 0), axis=(0, 0, 1)
)
speeds = np.linspace(3000.0, 15000.0, 40)
charts = {
    "alone": thinwall.lobes(part, cut, speeds, at="C", depth_limit_m=0.01),
    "with the robot": thinwall.lobes(supported, cut, speeds, at="C", depth_limit_m=0.01),
}
for name, chart in charts.items():
    print(f"{name:15s} least depth {1e3 * chart.minimum_depth_m:6.3f} mm at {chart.at_spindle_speed_rpm:.0f} rpm")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    for name, chart in charts.items():
        plt.plot(chart.spindle_speed_rpm, 1e3 * chart.limiting_depth_m, label=name)
    plt.xlabel("spindle speed, rpm")
    plt.ylabel("limiting depth, mm")
    plt.legend()
    plt.show()
