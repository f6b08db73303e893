# %% [markdown]
# # Two FRF files and a contact
# After `thinwall run cases/barrios-2019-measured`: the part at P and the robot's tip are known by one receptance each, and
# the contact of Barrios et al. 2019 joins them.

# %%
import sys

import numpy as np
import thinwall

results = thinwall.read_results(sys.argv[1] if len(sys.argv) > 1 else "results/barrios-2019-measured")
part, robot = results.frf["part"], results.frf["robot"]
hz, alone = part.frequency_hz, part.entry("P.x", "P.x")

# %% [markdown]
# How stiff must the contact be? The part's first peak, with a contact from a soft pad to one that is rigid.

# %%
peak = np.argmax(abs(alone))
held = {}
for stiffness in (1e5, 1e6, 1e7, np.inf):
    contact = thinwall.Contact("P", "R", "x", stiffness=stiffness)
    held[stiffness] = thinwall.couple([part, robot], [contact]).response.entry("P.x", "P.x")
    print(f"contact {stiffness:.0e} N/m: {100 * (1 - abs(held[stiffness][peak] / alone[peak])):.2f} % less at {hz[peak]:.1f} Hz")

# %%
program = results.frf["coupled_receptance"].entry("P.x", "P.x")
print(f"rigid, here and by the program: equal to {np.max(abs(held[np.inf] - program)) / np.max(abs(program)):.0e}")

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    print("no figure: python3-matplotlib is not installed")
else:
    plt.semilogy(hz, abs(alone), label="alone")
    for stiffness, H in held.items():
        plt.semilogy(hz, abs(H), label=f"{stiffness:.0e} N/m")
    plt.xlabel("frequency, Hz")
    plt.ylabel("|H| at P along x, m/N")
    plt.legend()
    plt.show()
