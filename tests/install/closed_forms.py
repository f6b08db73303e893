"""What the C++ examples print, against Euler and Bernoulli's beam and the closed form of a slotting cut.

    closed_forms.py FOLDER      with the example's outputs, NAME.txt
"""

import math
import pathlib
import sys

E, RHO, LENGTH, WIDTH, THICKNESS = 210e9, 7850.0, 0.2, 0.02, 0.002
EI = E * WIDTH * THICKNESS**3 / 12
MASS = RHO * LENGTH * WIDTH * THICKNESS


def frequency(lam):
    """Hz of the bending mode with wave number lam / LENGTH."""
    return lam**2 * math.sqrt(EI / (MASS * LENGTH**3)) / (2 * math.pi)


def root(function, low, high):
    """By bisection."""
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if function(low) * function(middle) <= 0 else (middle, high)
    return low


def cantilever(lam, tip_mass=0.0, tip_stiffness=0.0):
    """Zero at the modes of a cantilever with a mass and a spring to ground at its tip."""
    load = lam * tip_mass / MASS - tip_stiffness * LENGTH**3 / (EI * lam**3)
    c, s, ch, sh = math.cos(lam), math.sin(lam), math.cosh(lam), math.sinh(lam)
    return 1 + c * ch + load * (c * sh - s * ch)


def numbers(folder, example, word):
    """The numbers behind `word` in what an example printed."""
    text = (pathlib.Path(folder) / f"{example}.txt").read_text(encoding="utf-8")
    return [float(line[len(word) :].split()[0]) for line in text.splitlines() if line.startswith(word + " ")]


def close(what, actual, expected, tolerance):
    """Ends the program unless they agree relatively."""
    if abs(actual / expected - 1) > tolerance:
        sys.exit(f"{what}: {actual}, by the closed form {expected}")


def check_plate(folder):
    (mass,) = numbers(folder, "plate_modes", "mass")
    close("mass", mass, MASS, 1e-5)  # six digits are printed
    modes = numbers(folder, "plate_modes", "mode")
    # A strip ten times as long as wide; its clamped edge cannot bend across, which makes it 0.5 % stiffer.
    for number, hz in ((0, frequency(root(cantilever, 1.0, 3.0))), (1, frequency(root(cantilever, 3.0, 6.0)))):
        close(f"bending mode {number + 1}", modes[number], hz, 0.01)


def check_coupled(folder):
    stiffness = 2e3
    mass = stiffness / (2 * math.pi * 30.0) ** 2  # a robot of one mode at 30 Hz
    modes = numbers(folder, "couple_robot", "mode")

    def supported(lam):
        return cantilever(lam, mass, stiffness)

    close("first supported mode", modes[0], frequency(root(supported, 1.0, 2.5)), 0.01)
    close("second supported mode", modes[1], frequency(root(supported, 2.5, 5.0)), 0.01)
    text = (pathlib.Path(folder) / "couple_robot.txt").read_text(encoding="utf-8")
    if float(text.split()[-1]) > 1e-9:
        sys.exit(f"the two routes: {text.splitlines()[-1]}")


def check_lobes(folder):
    """Four teeth in a full slot: the sum of sin² over the two in the cut is one, of sin cos none. The force against
    the motion along the feed is then K_r w whatever the angle, and w_min = −1 / (2 K_r min Re G), with
    min Re G = −1 / (4 k ζ (1 + ζ)) of one mode."""
    k, zeta, radial_coefficient = 2e7, 0.03, 200e6
    (depth_mm,) = numbers(folder, "lobes_from_frf", "least depth")
    close("least depth", depth_mm * 1e-3, 2 * k * zeta * (1 + zeta) / radial_coefficient, 5e-3)


def main():
    for check in (check_plate, check_coupled, check_lobes):
        check(sys.argv[1])
    print("closed forms hold")


if __name__ == "__main__":
    main()
