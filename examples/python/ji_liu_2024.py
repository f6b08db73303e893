# %% [markdown]
# # Cuts of a robot against a chart by the coefficients of an alloy
# After `thinwall run cases/ji-liu-2024-x` (or `-y`): which coefficients the material gave, and which cuts are predicted
# rightly.

# %%
import pathlib
import sys
import tomllib

import thinwall

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "results/ji-liu-2024-x")  # or "results/ji-liu-2024-y"
results = thinwall.read_results(folder)
case = tomllib.loads((folder / "case.resolved.toml").read_text())


def quantity(text):
    """The number of a quantity in SI."""
    return float(str(text).split()[0])


print(f"{case['cutting']['material']}: K_t {1e-6 * quantity(case['cutting']['Kt']):.2f} N/mm^2, "
      f"K_r {1e-6 * quantity(case['cutting']['Kr']):.2f}, spread {quantity(case['lobes']['uncertainty']['coefficients']):.3f}")

# %%
for cut in results.summary["lobes"][0]["observed"]["cuts"]:
    print(f"{cut['spindle_speed_rpm']:.0f} rpm, {1e3 * cut['depth_m']:.2f} mm: {cut['observed']}, "
          f"{'right' if cut['right'] else 'wrong'}, boundary {1e3 * cut['depth_margin_m']:+.2f} mm away")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    chart = results.lobes["tool"]
    plt.plot(chart["spindle_speed_rpm"], 1e3 * chart["limiting_depth_m"])
    plt.xlabel("spindle speed, rpm")
    plt.ylabel("limiting depth, mm")
    plt.show()
