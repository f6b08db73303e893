#include "case/template_texts.hpp"

namespace thinwall::cases {

const char* const plate_template =
    R"(# A plate clamped at both ends, held from behind by a robot and milled on its front.
# Every key is described in docs/case-file.md. Quantities carry their unit in quotes; a bare number is SI.
title = "Robot-supported plate"

[part]                       # a box, one corner at the origin
length = "400 mm"            # along y
height = "100 mm"            # along z
thickness = "6 mm"           # along x

[part.material]
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
density = "7850 kg/m^3"

[part.mesh]
tolerance = 0.005            # of frequencies and receptances; size and order of the elements follow

[[part.supports]]            # faces: x_min, x_max, y_min, y_max, z_min, z_max
on = "y_min"
[[part.supports]]
on = "y_max"

[points.P]                   # where the robot touches and the tool cuts
at = [1.0, 0.5, 0.95]        # fractions of the box along x, y, z
patch_radius = "3 mm"

[damping]
ratio = 0.01                 # of every mode; ratios = [0.008, 0.012] names the first ones

[robot]                      # one mode at the tip; leave the section out for the part alone
direction = "x"
frequency = "29 Hz"
stiffness = "1.7e6 N/m"
damping_ratio = 0.02

[[contacts]]
part = "P"
directions = ["x"]
stiffness = "inf"            # or "1e8 N/m"

[response]
to = "2 kHz"

[tool]
teeth = 6
diameter = "16 mm"
length = "20 mm"

[cutting]
at = "P"
radial_depth = "0.2 mm"
mode = "down"
Kt = "2220 N/mm^2"           # C45; see cases/barrios-2019/README.md
Kr = "666 N/mm^2"
spindle_speed = "1900 rpm"

[lobes]
from = "1000 rpm"
to = "3000 rpm"
count = 200
modes_up_to = "4 kHz"
)";

const char* const wall_template = R"(# A wall clamped along its foot and milled along its free edge.
# Every key is described in docs/case-file.md. Quantities carry their unit in quotes; a bare number is SI.
title = "Cantilever wall"

[part]                       # a box, one corner at the origin
length = "120 mm"            # along y
height = "60 mm"             # along z
thickness = "2 mm"           # along x

[part.material]              # aluminium
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"

[part.mesh]
tolerance = 0.005            # of frequencies and receptances; size and order of the elements follow

[[part.supports]]
on = "z_min"

[points.P]                   # middle of the free edge
at = [1.0, 0.5, 0.97]        # fractions of the box along x, y, z
patch_radius = "1.5 mm"

[damping]
ratio = 0.006

[response]
to = "5 kHz"

[tool]
teeth = 4
diameter = "12 mm"
length = "26 mm"

[cutting]
at = "P"
radial_depth = "0.5 mm"
mode = "down"
Kt = "600 N/mm^2"            # 7075-T6; see cases/cantilever-wall/README.md
Kr = "181 N/mm^2"
spindle_speed = "9000 rpm"

[lobes]
from = "3000 rpm"
to = "15000 rpm"
count = 200
depth_limit = "10 mm"
modes_up_to = "10 kHz"       # of the part; stiffer modes count by their static compliance

# [simulation]               # how large the vibration becomes on both sides of the boundary at the speed above, or
# at = "9000 rpm, 0.5 mm"    # at points of your own; needs feed_per_tooth = "0.05 mm" in [cutting]
)";

const char* const stl_part_template =
    R"(# A bracket from an STL file, screwed down on its foot and milled along the edge of its thin wall.
# Every key is described in docs/case-file.md. Quantities carry their unit in quotes; a bare number is SI.
title = "Bracket from an STL file"

[part]
file = "bracket.stl"         # beside this file; also OFF, OBJ, PLY, STEP, and meshes: MSH, INP, VTU
unit = "mm"                  # an STL file does not tell its unit

[part.material]              # aluminium
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"

[part.mesh]
element_size = "10 mm"       # frequencies within 1 %, in seconds; "auto", the default, takes both from a tolerance
order = 4

[[part.supports]]            # a face of the box around the part, or a name of [selections]
on = "z_min"

[points.P]                   # on the wall's outer side, below the middle of its free edge
position = ["0 mm", "40 mm", "48 mm"]    # in the file's axes
patch_radius = "1.5 mm"

[damping]
ratio = 0.006                # of every mode

[response]
to = "5 kHz"

[tool]
teeth = 4
diameter = "12 mm"
length = "10 mm"

[cutting]
at = "P"
radial_depth = "0.5 mm"
mode = "down"
feed_direction = "y"         # along the wall
tool_axis = "z"
Kt = "600 N/mm^2"            # 7075-T6; see cases/cantilever-wall/README.md
Kr = "181 N/mm^2"
spindle_speed = "9000 rpm"

[lobes]
from = "6000 rpm"
to = "15000 rpm"
count = 200
modes_up_to = "10 kHz"       # of the part; stiffer modes count by their static compliance
)";

const char* const robot_template =
    R"(# A clamped plate, held from behind by a four-axis arm that is known by its links and joints.
# Every key is described in docs/case-file.md. Quantities carry their unit in quotes; a bare number is SI.
title = "Plate backed by a four-axis arm"

[part]                       # a box, one corner at the origin
length = "300 mm"            # along y
height = "100 mm"            # along z
thickness = "5 mm"           # along x

[part.material]
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
density = "7850 kg/m^3"

[part.mesh]
tolerance = 0.005            # of frequencies and receptances; size and order of the elements follow

[[part.supports]]
on = "y_min"
[[part.supports]]
on = "y_max"

[points.P]                   # on the front: cut here
at = [1.0, 0.5, 0.95]        # fractions of the box along x, y, z
patch_radius = "3 mm"

[points.B]                   # behind it: the arm's tip
at = [0.0, 0.5, 0.95]
patch_radius = "3 mm"

[damping]
ratio = 0.01

[robot]
model = "flexible_joints"    # also one_mode, modes, measured, modal_table, virtual_joints

[robot.base]                 # where it stands, in the part's axes
position = ["-1300 mm", "150 mm", "-900 mm"]

[[robot.links]]              # each with the joint that carries it; frames at the joints
name = "shoulder"
axis = "z"
mass = "340 kg"
centre = ["0 m", "0 m", "0.33 m"]
inertia = ["18 kg m^2", "29 kg m^2", "30 kg m^2"]
stiffness = "3.8e6 N m/rad"
damping = "1060 N m s/rad"

[[robot.links]]
name = "upper arm"
position = ["0 m", "0 m", "0.65 m"]
axis = "y"
mass = "240 kg"
centre = ["0 m", "0 m", "0.48 m"]
inertia = ["35 kg m^2", "37 kg m^2", "4 kg m^2"]
stiffness = "6.6e6 N m/rad"
damping = "1390 N m s/rad"

[[robot.links]]
name = "forearm"
position = ["0 m", "0 m", "0.95 m"]
axis = "y"
mass = "200 kg"
centre = ["0 m", "0 m", "0.43 m"]
inertia = ["5.5 kg m^2", "5.5 kg m^2", "4.5 kg m^2"]
stiffness = "3.9e6 N m/rad"
damping = "1070 N m s/rad"

[[robot.links]]
name = "wrist"
position = ["0 m", "0 m", "0.85 m"]
axis = "y"
mass = "11 kg"
centre = ["0 m", "0 m", "0.1 m"]
inertia = ["0.1 kg m^2", "0.1 kg m^2", "0.04 kg m^2"]
stiffness = "0.66e6 N m/rad"
damping = "440 N m s/rad"

[robot.tip]                  # in the frame of the last link
position = ["0 m", "0 m", "0.2 m"]

[robot.posture]              # the tip goes to the contact; the last link lies level
pitch = "90 deg"

[[contacts]]                 # a ball: it holds along x only
part = "B"
directions = ["x"]
stiffness = "2e7 N/m"

[response]
to = "2 kHz"

[tool]
teeth = 6
diameter = "16 mm"
length = "20 mm"

[cutting]
at = "P"
radial_depth = "0.2 mm"
mode = "down"
Kt = "2220 N/mm^2"           # C45; see cases/barrios-2019/README.md
Kr = "666 N/mm^2"
spindle_speed = "1900 rpm"

[lobes]
from = "1000 rpm"
to = "3000 rpm"
count = 200
modes_up_to = "4 kHz"
)";

const char* const frf_only_template =
    R"(# What a robot does to a part when both are known by measured FRFs only: no shape, no mesh.
# The two files beside this one are made up; put measured ones in their place.
# Every key is described in docs/case-file.md. Quantities carry their unit in quotes; a bare number is SI.
title = "Part and robot from measured FRFs"

[[part.measured]]            # hammer and sensor at P, both along x
response = "P.x"
force = "P.x"
file = "part_xx.csv"         # frequency in Hz, real part, imaginary part; also .frf, .uff, .unv, .mat
quantity = "receptance"      # or mobility, accelerance
unit = "um/N"
noise = 0.01                 # standard deviation, relative; leave it out if it is not known

[robot]
model = "measured"
direction = "x"

[[robot.measured]]           # at the robot's tip R
response = "R.x"
force = "R.x"
file = "robot_xx.csv"
quantity = "receptance"
unit = "um/N"
noise = 0.01

[[contacts]]                 # the tip R touches the part at P
part = "P"
directions = ["x"]
stiffness = "inf"            # or "1e7 N/m"

[response]                   # the lines of the files, so that nothing is interpolated
from = "10 Hz"
to = "1000 Hz"
lines = 991
)";

const char* const lobes_template = R"(# Stability lobes of a tool whose tip was measured: no part, no mesh.
# The two files beside this one are made up; put measured ones in their place.
# Every key is described in docs/case-file.md. Quantities carry their unit in quotes; a bare number is SI.
title = "Lobes from a measured tool tip"

[tool]
teeth = 4
diameter = "20 mm"
length = "10 mm"             # no deeper cut is possible

[[tool.measured]]            # hammer and sensor at the tip, along x
response = "x"
force = "x"
file = "tip_xx.csv"          # frequency in Hz, real part, imaginary part; also .frf, .uff, .unv, .mat
quantity = "receptance"      # or mobility, accelerance
unit = "um/N"

[[tool.measured]]
response = "y"
force = "y"
file = "tip_yy.csv"
quantity = "receptance"
unit = "um/N"

[cutting]
radial_depth = "2 mm"        # a tenth of the diameter
mode = "down"
feed_direction = "x"
tool_axis = "z"
Kt = "600 N/mm^2"            # aluminium
Kr = "200 N/mm^2"
spindle_speed = "9000 rpm"

[lobes]
from = "6000 rpm"
to = "14000 rpm"
count = 60
)";

}  // namespace thinwall::cases
