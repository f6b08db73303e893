# %% [markdown]
# # Forces in a full slot
# After `thinwall run cases/bondarenko-2012-a`: the forces on a tool that does not move.

# %%
import sys

import numpy as np
import thinwall

results = thinwall.read_results(sys.argv[1] if len(sys.argv) > 1 else "results/bondarenko-2012-a")
point = results.summary["simulation"]["points"][0]
trace = results.simulation["tool-1"]

# %% [markdown]
# Forces over a tooth, and the law that gives them: four teeth, of which two are in the slot.

# %%
print("mean force {:.3f}, {:.3f} N".format(*point["mean_force_n"]))
turn = slice(0, 720)
print(f"largest along the normal {trace['force_y_n'][turn].max():.2f} N")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    degrees = np.arange(720) / 2
    plt.plot(degrees, trace["force_x_n"][turn], label="along the feed")
    plt.plot(degrees, trace["force_y_n"][turn], label="across")
    plt.xlabel("rotation, degrees")
    plt.ylabel("force on the tool, N")
    plt.legend()
    plt.show()
