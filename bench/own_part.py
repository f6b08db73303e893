"""A part of one's own: a milled tray from an STL, a measured tool with a helix and a robot behind, as a new user has it."""

import json
import pathlib
import random
import re
import sys
import tempfile

import fem
import processes

PROGRAM = fem.ROOT / "build" / "release" / "app" / "thinwall"
MOST_S = 480.0  # of the quarter of an hour until a new user's first picture, less seven minutes for the README's command
FACTOR = 3.0  # within which forecasts of charts are promised (study/lobes/lobes_forecast.hpp)

# The tray, mm: walls of 2 mm on a floor of 4 mm. A cell of the grid is solid or the pocket.
XS, YS, ZS = (0.0, 2.0, 88.0, 90.0), (0.0, 2.0, 53.0, 55.0), (0.0, 4.0, 22.0)

# Modes of the tool's tip by direction: Hz, damping ratio, N/m.
TOOL = {"x": ((1450.0, 0.03, 4.5e7), (2900.0, 0.02, 1.2e8)), "y": ((1390.0, 0.035, 4.2e7), (3100.0, 0.02, 1.1e8))}
LINES_HZ = range(100, 5001)
NOISE = 5e-11  # m/N, standard deviation of real and imaginary part

CASE = """title = "Tray of one's own"

[part]
file = "tray.stl"
unit = "mm"

[part.material]
youngs_modulus = "71 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"

[[part.supports]]
on = "z_min"

[points.P]
position = ["45 mm", "0 mm", "20 mm"]
patch_radius = "2 mm"

[points.B]
position = ["45 mm", "2 mm", "14 mm"]
patch_radius = "3 mm"

[modes]
count = 6

[damping]
ratio = 0.008

[robot]
point = "R"
direction = "y"
frequency = "29 Hz"
stiffness = "1.5e6 N/m"
damping_ratio = 0.03

[[contacts]]
part = "B"
robot = "R"
directions = ["y"]
stiffness = "1e7 N/m"

[response]
from = "1 Hz"
to = "6 kHz"

[tool]
teeth = 4
diameter = "10 mm"
length = "22 mm"
helices = ["30 deg"]

[[tool.measured]]
file = "tip_x.csv"
response = "x"
force = "x"
quantity = "receptance"
unit = "m/N"

[[tool.measured]]
file = "tip_y.csv"
response = "y"
force = "y"
quantity = "receptance"
unit = "m/N"

[cutting]
at = "P"
radial_depth = "0.4 mm"
mode = "down"
feed_direction = "x"
tool_axis = "z"
material = "Al7075-T6"
spindle_speed = "12000 rpm"

[lobes]
from = "6000 rpm"
to = "16000 rpm"
"""


def add_command(commands):
    parser = commands.add_parser("own-part", description=__doc__, help="a new user's own part: forecast and time of its run")
    parser.add_argument("--make", type=pathlib.Path, metavar="DIR", help="only write the case there")
    parser.add_argument("--out", type=pathlib.Path, metavar="FILE", help="write all figures as JSON")
    parser.set_defaults(run=run)


def is_solid(i, j, k):
    if not (0 <= i < len(XS) - 1 and 0 <= j < len(YS) - 1 and 0 <= k < len(ZS) - 1):
        return False
    return k == 0 or i in (0, 2) or j in (0, 2)


def tray():
    """The triangles of the faces between solid cells and the rest, corners in mm, outward."""
    triangles = []
    for i in range(len(XS) - 1):
        for j in range(len(YS) - 1):
            for k in range(len(ZS) - 1):
                if not is_solid(i, j, k):
                    continue
                for axis in range(3):
                    for side in (0, 1):
                        beside = [i, j, k]
                        beside[axis] += 2 * side - 1
                        if not is_solid(*beside):
                            triangles += face((i, j, k), axis, side)
    return triangles


def face(cell, axis, side):
    """Two triangles of a side of a cell, counterclockwise from outside."""
    corners = []
    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
        at = list(cell)
        at[axis] += side
        at[(axis + 1) % 3] += a
        at[(axis + 2) % 3] += b
        corners.append((XS[at[0]], YS[at[1]], ZS[at[2]]))
    if side == 0:
        corners.reverse()
    return [(corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])]


def stl(triangles):
    lines = ["solid tray"]
    for corners in triangles:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex {:g} {:g} {:g}".format(*corner) for corner in corners]
        lines += ["endloop", "endfacet"]
    return "\n".join([*lines, "endsolid tray", ""])


def tip_lines(modes, draw):
    """H = sum of 1/(k (1 - r^2 + 2 i zeta r)), r = f/f_k, with noise."""
    lines = ["frequency_hz,real,imag"]
    for hz in LINES_HZ:
        H = sum(1.0 / (k * complex(1.0 - (hz / f) ** 2, 2.0 * zeta * hz / f)) for f, zeta, k in modes)
        lines.append(f"{hz},{H.real + draw.gauss(0.0, NOISE):.9e},{H.imag + draw.gauss(0.0, NOISE):.9e}")
    return "\n".join([*lines, ""])


def make(folder):
    folder.mkdir(parents=True, exist_ok=True)
    draw = random.Random(1)
    (folder / "tray.stl").write_text(stl(tray()))
    for direction, modes in TOOL.items():
        (folder / f"tip_{direction}.csv").write_text(tip_lines(modes, draw))
    (folder / "case.toml").write_text(CASE)


def seconds(text):
    """The time that a text such as "about 3 min" tells; None without one."""
    found = re.search(r"([\d.]+) (s|min|h)\b", text)
    return float(found[1]) * {"s": 1.0, "min": 60.0, "h": 3600.0}[found[2]] if found else None


def run(arguments):
    if arguments.make:
        make(arguments.make)
        return 0
    if not PROGRAM.exists():
        sys.exit("bench/run own-part: the program is not built; call ./thinwall --version first")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        make(folder)
        words = [PROGRAM, "run", folder, "--out", folder / "out", "--fresh", "-v", "--progress", "never"]
        done = processes.run(words, 3600.0, folder, processes.environment())
        log = (folder / "stderr.txt").read_text()
        if done.failure:
            sys.exit(f"bench/run own-part: {done.failure}")
        summary = json.loads((folder / "out" / "summary.json").read_text())
        has_page = (folder / "out" / "report.html").exists()
    told = next((line for line in log.splitlines() if "this takes" in line), "")
    of_lobes = told.partition("the lobes ")[2]
    forecast_s, at_least = seconds(of_lobes), of_lobes.startswith("over")
    timings = summary["timings_s"]
    figures = {"machine": processes.machine(), "wall_s": done.wall_s, "told": told, "lobes_told_s": forecast_s,
               "timings_s": timings}
    print(told)
    print(f"the run took {done.wall_s:.0f} s, of them " +
          ", ".join(f"{stage} {time_s:.0f} s" for stage, time_s in timings.items() if stage != "total" and time_s >= 1.0))
    if arguments.out:
        arguments.out.write_text(json.dumps(figures, indent=1) + "\n")
    wrong = []
    if not has_page:
        wrong.append("there is no report.html")
    if done.wall_s > MOST_S:
        wrong.append(f"the first picture took longer than {MOST_S:.0f} s")
    if forecast_s is None:
        wrong.append("the time of the lobes was not told")
    else:
        ratio = timings["lobes"] / forecast_s
        if ratio < 1.0 / FACTOR or (ratio > FACTOR and not at_least):
            wrong.append(f"the forecast of the lobes was off by more than a factor of {FACTOR:g}")
    for text in wrong:
        print(text)
    return 1 if wrong else 0
