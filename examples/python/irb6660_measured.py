# %% [markdown]
# # A measured robot and its cross terms
# After `thinwall run cases/irb6660-measured`: a steel wall backed by a robot that is known by nine modes. A push along x
# moves its tip along y, too. How much of the limiting depth is that?

# %%
import sys

import numpy as np
import thinwall

results = thinwall.read_results(sys.argv[1] if len(sys.argv) > 1 else "results/irb6660-measured")
wall, robot = results.frf["part"], results.frf["robot"]
direct = thinwall.Response(robot.frequency_hz, robot.H * np.eye(2), robot.responses)
print(f"largest cross term over largest direct one: {np.max(abs(robot.H - direct.H)) / np.max(abs(direct.H)):.2f}")

# %% [markdown]
# Its rod is pressed against the wall and held by friction, 10 and 5 N/um. The chart comes from the coupled receptance as
# it is, without poles.

# %%
contacts = [
    thinwall.Contact("B", "R", "x", stiffness=1e7, damping=50.0),
    thinwall.Contact("B", "R", "y", stiffness=5e6, damping=50.0),
]
cut = thinwall.MillingProcess(
    teeth=4, diameter_m=0.016, K_t=2220e6, K_r=666e6, radial_depth_m=0.0005, feed=(0, 1, 0), axis=(0, 0, 1)
)
chart = results.lobes["supported"]
some = slice(None, None, max(1, len(chart["spindle_speed_rpm"]) // 4))
speeds, program = chart["spindle_speed_rpm"][some], chart["limiting_depth_m"][some]
depths = {}
for name, tip in {"with cross terms": robot, "without": direct}.items():
    held = thinwall.couple([wall, tip], contacts).response
    depths[name] = thinwall.lobes(held, cut, speeds, at="P", depth_limit_m=0.03).limiting_depth_m
    print(f"{name:16s}", np.round(1e3 * depths[name], 2), "mm")
print(f"here and by the program: equal to {np.max(abs(depths['with cross terms'] / program - 1)):.0e}")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    figure, (above, below) = plt.subplots(2)
    for entry in ("R.x/R.x", "R.y/R.y", "R.x/R.y", "R.y/R.x"):
        above.semilogy(robot.frequency_hz, abs(robot.entry(*entry.split("/"))), label=entry)
    above.set(xlabel="frequency, Hz", ylabel="receptance of the tip, m/N")
    above.legend()
    below.plot(chart["spindle_speed_rpm"], 1e3 * chart["limiting_depth_m"], label="program")
    for name, depth in depths.items():
        below.plot(speeds, 1e3 * depth, "o", label=name)
    below.set(xlabel="spindle speed, rpm", ylabel="limiting depth, mm")
    below.legend()
    plt.show()
