# %% [markdown]
# # The printed tables of a robot that was learned over 112 postures
# After `thinwall run cases/lei-2022`: the errors of frequency and damping that Lei, Hou & Ding 2022 reached at three test
# postures, as their printed values give them, and the slot of their trials at the one posture whose modes are printed.

# %%
import pathlib
import sys

import numpy as np
import thinwall

results = thinwall.read_results(sys.argv[1] if len(sys.argv) > 1 else "results/lei-2022")
case = pathlib.Path(__file__).resolve().parents[2] / "cases" / "lei-2022"
table = thinwall.read_table(case / "predictions.csv")
error = 100 * np.abs(table["predicted_hz"] / table["measured_hz"] - 1)
damping_error = 100 * np.abs(table["predicted_damping_percent"] / table["measured_damping_percent"] - 1)
for name, modes in {"modes 1 to 5": table["mode"] <= 5, "modes 6 to 9": table["mode"] > 5}.items():
    print(f"{name}: mean error of frequency {error[modes].mean():.2f} %, of damping {damping_error[modes].mean():.2f} %")
off = np.abs(error - table["printed_error_percent"])
print(f"the printed errors of frequency follow from the printed values within {off.max():.2f} %")

# %% [markdown]
# Their trials: 2 mm at 7200 rpm stable, 3 mm not; 1 mm at 10800 rpm stable, 2 mm not; chatter at 916 and 935 Hz. They were
# made with another tool at another posture, whose shapes are not printed.

# %%
chart = results.lobes["carried"]
for speed in (7200, 10800):
    i = int(np.argmin(np.abs(chart["spindle_speed_rpm"] - speed)))
    print(f"{speed} rpm: limit {1e3 * chart['limiting_depth_m'][i]:.2f} mm, chatter at {chart['chatter_frequency_hz'][i]:.0f} Hz")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    plt.plot(chart["spindle_speed_rpm"], 1e3 * chart["limiting_depth_m"])
    plt.plot([7200, 10800], [2, 1], "o", [7200, 10800], [3, 2], "x")
    plt.xlabel("spindle speed, rpm")
    plt.ylabel("limiting depth, mm")
    plt.show()
