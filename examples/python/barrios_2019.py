# %% [markdown]
# # Reading the results of a run
# After `thinwall run cases/barrios-2019`: the receptance of the plate with and without the robot, and both charts.
# Give the folder of another run as an argument.

# %%
import sys

import numpy as np
import thinwall

folder = sys.argv[1] if len(sys.argv) > 1 else "results/barrios-2019"
results = thinwall.read_results(folder)
print(results.summary["title"])
for mode in results.summary["part"]["modes"][:3]:
    print(f"part {mode['frequency_hz']:8.2f} Hz, damping {100 * mode['damping_ratio']:.2f} %")

# %%
part, coupled = results.frf["part"], results.frf["coupled_receptance"]
hz = part.frequency_hz
alone, supported = part.entry("P.x", "P.x"), coupled.entry("P.x", "P.x")
peak = np.argmax(abs(alone))
print(f"at {hz[peak]:.0f} Hz the robot leaves {100 * abs(supported[peak] / alone[peak]):.3f} % of the vibration")

# %% [markdown]
# The same coupling once more, from the receptances of the two components alone.

# %%
again = thinwall.couple([part, results.frf["robot"]], [thinwall.Contact("P", "R", "x")]).response.entry("P.x", "P.x")
print(f"coupled here and by the program: equal to {np.max(abs(again - supported)) / np.max(abs(supported)):.0e}")

# %%
for shape in results.shapes("coupled")[:3]:
    place = shape.points[np.argmax(np.linalg.norm(shape.displacement, axis=1))]
    print(f"with robot {shape.frequency_hz:8.2f} Hz, moves most at {np.round(1e3 * place, 1)} mm")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    figure, (above, below) = plt.subplots(2)
    above.semilogy(hz, abs(alone), hz, abs(supported))
    above.set(xlabel="frequency, Hz", ylabel="|H| at P along x, m/N")
    for name in ("part", "supported"):
        chart = results.lobes[name]
        below.plot(chart["spindle_speed_rpm"], 1e3 * chart["limiting_depth_m"], label=name)
    below.set(xlabel="spindle speed, rpm", ylabel="limiting depth, mm")
    below.legend()
    plt.show()
