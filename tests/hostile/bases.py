"""Cases that are right, for hostile inputs to make wrong: the shipped ones, and some with tables that none of these has."""

import copy
import tomllib

# The wall of barrios-2019 with a length that is fitted.
UPDATED_LENGTH = """
[[updating]]
name = "length"
parameters = [{ key = "part.length", lower = "380 mm", upper = "410 mm" }]
[[updating.targets]]
quantity = "part_frequency"
value = "212 Hz"
point = "P.x"
"""

# For every base, the shipped case that it begins with and the tables that are added; one of the same name is exchanged.
ADDED = {
    "held-wall": ("cantilever-wall", """
[[part.clamps]]
on = "y_min"
normal_stiffness = "1e9 N/m^3"
tangential_stiffness = "1e9 N/m^3"
[[part.masses]]
at = "corner"
mass = "10 g"
inertia = [1e-6, 1e-6, 1e-6]
offset = ["1 mm", 0, 0]
[[part.springs]]
at = "corner"
stiffness = ["1e5 N/m", 0, 0]
rotation_stiffness = ["10 N m/rad", 0, 0]
offset = ["1 mm", 0, 0]
[[part.materials]]
on = "edge"
youngs_modulus = "100 GPa"
poisson_ratio = 0.3
density = "4500 kg/m^3"
[selections.edge.box]
min = [0, 0, "50 mm"]
max = ["2 mm", "120 mm", "60 mm"]
[selections.round.sphere]
centre = [0, "60 mm", "60 mm"]
radius = "10 mm"
[selections.foot.plane]
point = [0, 0, 0]
normal = "z"
[cutting]
feed_per_tooth = "0.1 mm"
[machine]
min_spindle_speed = "1000 rpm"
max_spindle_speed = "18000 rpm"
max_power = "12 kW"
max_torque = "30 N m"
max_feed_rate = "20 m/min"
efficiency = 0.9
[[updating]]
name = "clamp"
parameters = [{ key = "part.length", lower = "110 mm", upper = "130 mm" }]
[[updating.targets]]
quantity = "part_frequency"
value = "500 Hz"
point = "P.x"
weight = 1
"""),
    "prism": ("cantilever-wall", """
[part]
shape = "prism"
thickness = "4 mm"
outline = [[0, 0], ["100 mm", 0], ["100 mm", "50 mm"], [0, "50 mm"]]
[[part.holes]]
outline = [["20 mm", "20 mm"], ["30 mm", "20 mm"], ["30 mm", "30 mm"], ["20 mm", "30 mm"]]
[[part.zones]]
outline = [["50 mm", "10 mm"], ["80 mm", "10 mm"], ["80 mm", "40 mm"], ["50 mm", "40 mm"]]
thickness = "2 mm"
bottom = "1 mm"
[part.bend]
radius = "500 mm"
along = "x"
[part.material]
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"
[part.mesh]
element_size = "10 mm"
order = 2
[[part.supports]]
on = "x_min"
[points.P]
position = ["100 mm", "25 mm", "2 mm"]
patch_radius = "2 mm"
"""),
    "damped": ("cantilever-wall", """
[damping.from_frf]
response = "P.x"
force = "P.x"
file = "tip.csv"
quantity = "accelerance"
unit = "m/s^2/N"
"""),
    "surface": ("pocketed-rib", """
[part.repair]
merge_tolerance = "1 um"
largest_hole = 4
largest_movement = 1e-4
thinnest_wall = "0.1 mm"
"""),
    "ball": ("barrios-2019", """
[[contacts]]
part = "P"
directions = ["x"]
model = "caster"
preload = "80 N"
[contacts.ball]
radius = "12.7 mm"
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
supports = 3
support_radius = "2 mm"
support_angle = "45 deg"
[contacts.surface]
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
[coupling]
regularisation = "none"
"""),
    "identified": ("barrios-2019", """
[[contacts]]
part = "P"
[[contacts.measured]]
response = "P.x"
force = "P.x"
file = "held_xx.csv"
quantity = "receptance"
unit = "m/N"
""" + UPDATED_LENGTH),
    "held-measured": ("barrios-2019-measured", """
[[part.sensors]]
at = "P"
mass = "3 g"
[[robot.sensors]]
at = "R"
mass = "3 g"
"""),
    "several-modes": ("barrios-2019", """
[robot]
model = "modes"
[[robot.modes]]
frequency = "29 Hz"
damping_ratio = 0.02
stiffness = "1.7e6 N/m"
direction = "x"
""" + UPDATED_LENGTH),
    "elements": ("huynh-2017", """
[robot]
model = "virtual_joints"
carries = "tool"
[[robot.elements]]
kind = "rotation"
chain = 1
axis = "z"
angle = "0 deg"
stiffness = "4e6 N m/rad"
damping = "1000 N m s/rad"
[[robot.elements]]
kind = "beam"
length = "0.5 m"
outer_diameter = "200 mm"
inner_diameter = "150 mm"
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2700 kg/m^3"
"""),
    "arm": ("huynh-2017", """
[[robot.counterbalances]]
from_point = [0, 0, 0]
to = "main arm"
to_point = [0, 0, "0.5 m"]
length = "0.2 m"
stiffness = "1000 N/m"
force = "100 N"
"""),
    "described": ("barrios-2019", """
[robot]
model = "flexible_joints"
urdf = "arm.urdf"
joints = "joints.toml"
[robot.posture]
joints = [0.3, 0.4]
""" + UPDATED_LENGTH),
    "pressed": ("barrios-2019", """
[[contacts]]
part = "P"
directions = ["x"]
model = "table"
table = "stiffness.csv"
preload = "80 N"
"""),
    "workspace": ("huynh-2017-support", """
[robot.workspace]
from = ["1 m", "-0.2 m", "0.5 m"]
to = ["1.2 m", "0.2 m", "0.7 m"]
counts = [2, 2, 2]
"""),
    "tip": ("ding-2010", """
[tool]
teeth = 2
diameter = "10 mm"
length = "10 mm"
[[tool.measured]]
response = "x"
force = "x"
file = "tip.csv"
quantity = "accelerance"
unit = "m/s^2/N"
noise = 0.01
"""),
    "map": ("ding-2010", """
[cutting]
feed_per_tooth = "0.1 mm"
[simulation]
at = "5000 rpm, 0.5 mm"
[simulation.map]
speeds = 4
depths = 3
deepest = "2 mm"
turns = 20
steps = 40
"""),
    "taught": ("hajdu-2020", """
[calibration]
draws = 200
seed = 1
folds = 2
spindle_speed = "5000 rpm"
risk = 0.1
"""),
    "meshed": ("cantilever-wall", """
[part]
shape = "mesh"
file = "block.inp"
unit = "mm"
[part.material]
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"
[[part.supports]]
on = "z_min"
[points.P]
position = ["40 mm", "10 mm", "30 mm"]
patch_radius = "4 mm"
"""),
    "matrices": ("cantilever-wall", """
[part]
unit = "mm"
mass_unit = "t"
[part.matrices]
stiffness = "k.mtx"
mass = "m.mtx"
dofs = "dofs.csv"
positions = "positions.csv"
[points.P]
node = 1
[modes]
count = 2
[damping]
ratio = 0.01
"""),
}

# Matrices of two nodes that may move along x, y, z: springs of 1000 N/mm to ground and between them, 1 kg each.
_STIFFNESS = ["%%MatrixMarket matrix coordinate real symmetric", "6 6 9"] + [f"{i} {i} 2000" for i in range(1, 7)] + [
    f"{i + 3} {i} -1000" for i in range(1, 4)]
_MASS = ["%%MatrixMarket matrix coordinate real symmetric", "6 6 6"] + [f"{i} {i} 0.001" for i in range(1, 7)]
_DOFS = ["row,node,component"] + [f"{3 * node + c},{node + 1},{c}" for node in (0, 1) for c in (1, 2, 3)]
COPIES = {"tip.csv": "docs/tutorials/tip/tip.csv", "held_xx.csv": "cases/barrios-2019-measured/part_xx.csv"}
_BODY = ("""<link name="{0}"><inertial><origin xyz="0 0 0.3"/><mass value="{1}"/>"""
         """<inertia ixx="2" iyy="2" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>\n""")
_JOINT = """<joint name="{0}" type="{1}"><parent link="{2}"/><child link="{3}"/><origin xyz="0 0 0.5"/><axis xyz="0 1 0"/></joint>\n"""
_ARM = ("""<robot name="two"><link name="base"/>\n""" + _BODY.format("a", 30) + _BODY.format("b", 10) + """<link name="tool"/>\n"""
        + _JOINT.format("j1", "continuous", "base", "a") + _JOINT.format("j2", "continuous", "a", "b")
        + _JOINT.format("f", "fixed", "b", "tool") + "</robot>\n")
_JOINTS = "".join(f"[[joints]]\nname = \"{name}\"\nstiffness = \"2e6 N m/rad\"\n" for name in ("j1", "j2"))
_BLOCK = """*NODE
1, 0, 0, 0
2, 40, 0, 0
3, 40, 20, 0
4, 0, 20, 0
5, 0, 0, 30
6, 40, 0, 30
7, 40, 20, 30
8, 0, 20, 30
*ELEMENT, TYPE=C3D8, ELSET=ALL
1, 1, 2, 3, 4, 5, 6, 7, 8
"""
FILES = {
    "block.inp": _BLOCK,
    "arm.urdf": _ARM,
    "joints.toml": _JOINTS,
    "stiffness.csv": "preload_n,stiffness_n_per_m,damping_n_s_per_m\n10,1e6,10\n100,2e6,20\n",
    "k.mtx": "\n".join(_STIFFNESS) + "\n",
    "m.mtx": "\n".join(_MASS) + "\n",
    "dofs.csv": "\n".join(_DOFS) + "\n",
    "positions.csv": "node,x,y,z\n1,0,0,0\n2,0,0,10\n",
}


class Raw(str):
    """A value as the text of TOML that it is to be."""


def text_of(value):
    """A value of a case as TOML."""
    if isinstance(value, Raw):
        return str(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return '"' + "".join(f"\\u{ord(c):04x}" if ord(c) < 32 or c in '"\\\x7f' else c for c in value) + '"'
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {text_of(entry)}" for key, entry in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(text_of, value)) + "]"
    return repr(value)


def toml_of(table, path=""):
    """A case as TOML; tables and lists of tables have headings."""
    lines, below = [], []
    for key, value in table.items():
        name = f"{path}.{key}" if path else key
        if isinstance(value, dict):
            below += [f"[{name}]", toml_of(value, name)]
        elif isinstance(value, list) and value and all(isinstance(entry, dict) for entry in value):
            for entry in value:
                below += [f"[[{name}]]", toml_of(entry, name)]
        else:
            lines.append(f"{key} = {text_of(value)}")
    return "\n".join(line for line in lines + below if line)


def merged(case, added):
    """`case` with the tables of `added`; a robot, a part or a tool is exchanged as a whole if its model or shape is."""
    whole = {"part": ("shape", "matrices"), "robot": ("model",), "tool": ("teeth",), "damping": ("ratio",), "points": ("P",)}
    result = copy.deepcopy(case)
    for key, value in added.items():
        both = isinstance(value, dict) and isinstance(result.get(key), dict)
        if both and not any(word in value for word in whole.get(key, ())):
            result[key] = merged(result[key], value)
        else:
            result[key] = value
    return result


def cases_of(folder):
    """{name: (shipped case, its tables)}; those that are checked quickly first."""
    shipped = {file.parent.name: tomllib.loads(file.read_text(encoding="utf-8"))
               for file in sorted(folder.glob("*/case.toml"))}
    cases = {name: (name, case) for name, case in shipped.items()}
    cases |= {name: (start, merged(shipped[start], tomllib.loads(added))) for name, (start, added) in ADDED.items()}
    cases["tip"][1]["cutting"].pop("at", None)
    quick = ("ding-2010", "tip", "map", "barrios-2019-measured", "ji-liu-2024-x", "hajdu-2020", "lei-2022", "barrios-2019",
             "huynh-2017-support")
    return {name: cases[name] for name in [*quick, *(name for name in cases if name not in quick)]}
