#include "app/schema.hpp"

namespace thinwall::app {

namespace {

namespace kind = core::kind;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Bounds any{};
constexpr Bounds positive{0.0, infinity, true, false, false, ""};
constexpr Bounds not_negative{0.0, infinity, false, false, false, ""};
constexpr Bounds at_least_one{1.0, 1e6, false, false, false, ""};
constexpr Bounds fraction{0.0, 1.0, false, false, false, "a fraction of the box, 0 at one face and 1 at the other"};
constexpr Bounds sensor_mass{0.0, 1.0, true, false, false, "for grams write the unit: \"5 g\""};
constexpr Bounds damping_ratio{0.0, 1.0, false, true, false, "a ratio to critical damping: 1 % is 0.01"};
constexpr Bounds density_bounds{100.0, 25000.0, false, false, false, "for g/cm^3 write the unit: \"7.85 g/cm^3\""};
constexpr Bounds modulus_bounds{1e6, 2e12, false, false, false, "for GPa write the unit: \"210 GPa\""};
constexpr Bounds poisson_bounds{0.0,  0.5,   false,
                                true, false, "isotropic solids lie at 0.2 to 0.45; 0.5 would be incompressible"};
constexpr Bounds stiffness_or_infinite{0.0, infinity, true, false, true, "\"inf\" for a rigid contact"};
constexpr Bounds coefficient_bounds{1e6, 1e11, false, false, false, "for N/mm^2 write the unit: \"1800 N/mm^2\""};
constexpr Bounds axial_bounds{-1e12, 1e12, false, false, false, "for N/mm^2 write the unit: \"-200 N/mm^2\""};
constexpr Bounds exponent_bounds{0.0, 1.0, false, true, false, "0.2 to 0.3 is usual for steel"};
constexpr Bounds right_angle{0.0, 1.5707963268, false, true, false, "below 90 deg"};
constexpr Bounds tilt{-1.3962634016, 1.3962634016, false, false, false, "within 80 deg"};
constexpr Bounds turn{-6.2831853072, 12.5663706144, false, false, false, "a full turn is 360 deg"};
constexpr Bounds radial_bounds{0.0, 1e12, false, false, false, "for N/mm^2 write the unit: \"600 N/mm^2\""};

constexpr Bounds uncertainty{0.0,   1.0,   false,
                             false, false, "a standard uncertainty relative to the value: 5 % is 0.05"};
constexpr auto methods =
    "direct|zeroth_order|multi_frequency|semi_discretization_0|semi_discretization_1|semi_discretization_2|"
    "full_discretization_1|full_discretization_2|full_discretization_3";

constexpr bool required = true;

// Built-in arrays: clang stops counting the arguments from which a std::array would find its size at 256.

constexpr Section case_sections[] = {
    Section{"", "The case as a whole.", ""},
    Section{"part", "A box with one corner at the origin, or a prism; as it stands or bent.", ""},
    Section{"part.axes", "Which axis each extent runs along.", "part.thickness"},
    Section{"part.material", "Isotropic linear elasticity.", "part.thickness"},
    Section{"part.mesh", "Tetrahedra, elements of any order.", "part.thickness"},
    Section{"part.holes[]", "Holes through a prism.", ""},
    Section{"part.zones[]", "Regions of a prism with a height of their own: pockets, ribs. Later ones win.", ""},
    Section{"part.bend", "Bends the part about a cylinder: a curved wall, a cylinder sector.", ""},
    Section{"part.supports[]", "Directions held at zero; none makes the part free.", ""},
    Section{"part.measured[]", "FRFs of a measured part; they take the place of the box.", ""},
    Section{"part.sensors[]",
            "Accelerometers that sat on the measured part during all of its FRFs; their mass is taken off "
            "(docs/theory/measured-frfs.md).",
            ""},
    Section{"selections.*", "A named set of boundary points: exactly one of plane, box, sphere.", ""},
    Section{"selections.*.plane", "All points of a plane.", ""},
    Section{"selections.*.box", "All points in a box along the axes.", ""},
    Section{"selections.*.sphere", "All points in a sphere.", ""},
    Section{"points.*", "A named point: `at` or `position`, then an offset.", ""},
    Section{"modes", "Modes of the whole part. Give `count` or `up_to`; 10 modes if neither.", "part.thickness"},
    Section{"reduction", "The reduced model of the part. Give `modes` or `up_to`; 30 modes if neither.",
            "part.thickness"},
    Section{"damping", "Damping of the part.", "part.thickness"},
    Section{"damping.from_frf", "Damping ratios from a measured driving point, by a fit of each peak.", ""},
    Section{"robot", "The robot's tip.", ""},
    Section{"robot.modes[]", "Modes of the tip (`model = \"modes\"`).", ""},
    Section{"robot.measured[]",
            "FRFs of a measured robot (`model = \"measured\"`): one along `direction`, or several between the tip's x, "
            "y, z.",
            ""},
    Section{"robot.sensors[]", "Accelerometers on the measured robot, likewise.", ""},
    Section{"robot.links[]",
            "An arm's links from the base to the tip, each with the joint that carries it (`model = "
            "\"flexible_joints\"`). At angle 0 a link's frame is its joint's.",
            ""},
    Section{"robot.counterbalances[]", "Springs or gas cylinders between two points of the arm.", ""},
    Section{"robot.elements[]",
            "What follows each other from base to tip (`model = \"virtual_joints\"`): joints, beams, bodies, rigid "
            "offsets; each in the frame that the one before leaves.",
            ""},
    Section{"robot.base", "Where the arm stands, in the part's axes; of a modal table, its axes.", ""},
    Section{"robot.tip", "The arm's tip in the frame of the last link.", ""},
    Section{"robot.posture",
            "How the arm stands: `joints`; or the tip's place with `pitch` for a four-axis arm, with `approach` and "
            "`angle` for any other.",
            ""},
    Section{"robot.workspace", "Places of the tip over which `thinwall robot` tells modes and stiffness: a grid.", ""},
    Section{"contacts[]", "Where the robot touches the part. The first direction is the contact's normal.", ""},
    Section{"contacts[].ball",
            "The ball by which the robot touches a flat surface (`model = \"hertz\"`, `\"caster\"`; "
            "docs/theory/coupling.md, Eq. 18-20).",
            ""},
    Section{"contacts[].surface", "What the ball touches, where it is not `part.material`.", ""},
    Section{"contacts[].measured[]",
            "FRFs of the part while the robot holds it: stiffness and damping of the only contact are found from them "
            "(docs/theory/coupling.md, Eq. 16). Between one point and another, or at one, in all directions of the "
            "contact.",
            ""},
    Section{"coupling", "How the receptance route solves its kernel.", "robot"},
    Section{"response", "The lines at which FRFs are computed.", "part"},
    Section{"updating[]", "Values of the case found by fitting it to known results.", ""},
    Section{"updating[].parameters[]", "A number of this case that may be changed.", ""},
    Section{"updating[].targets[]", "A result that is known.", ""},
    Section{"tool", "The cutter.", ""},
    Section{"tool.modes[]", "Modes of the tool tip; none makes the tool rigid.", ""},
    Section{"tool.measured[]", "Measured FRFs of the tool tip, in place of modes; entries that no file gives are zero.",
            ""},
    Section{
        "tool.swap",
        "The tip from FRFs that were measured with another tool in its place (docs/theory/tool-swap.md), in place of "
        "modes and measured.",
        ""},
    Section{"tool.swap.measured[]", "The 16 FRFs between two directions of the tip and of a point up the tool.", ""},
    Section{"tool.swap.reference[]", "The tool that was measured: cylinders from the tip to the holder.", ""},
    Section{"tool.swap.target[]", "The tool that cuts, likewise.", ""},
    Section{"cutting", "How the cutter meets the part.", ""},
    Section{"machine", "What the machine allows; pockets are ranked within it.", ""},
    Section{"lobes", "The stability chart.", ""},
    Section{
        "lobes.uncertainty",
        "Relative standard uncertainties, for a chart that holds in spite of them (docs/theory/lobes.md). From poles "
        "and by the direct method.",
        ""},
    Section{"path", "Where the cut goes along the part: the chart at each position. Give `points`, or `from` and `to`.",
            ""},
};

// clang-format off
constexpr Key case_keys[] = {
    Key{"title", Type::text, kind::number, "\"\"", any, "", "What the case is, in a line."},

    Key{"part.shape", Type::choice, kind::number, "", any, "box|prism", "`box`: length, height, thickness. `prism`: an outline in the x-y plane, thick along z."},
    Key{"part.length", Type::quantity, kind::length, "", positive, "", "Extent along `axes.length`."},
    Key{"part.height", Type::quantity, kind::length, "", positive, "", "Extent along `axes.height`."},
    Key{"part.thickness", Type::quantity, kind::length, "", positive, "", "Extent along `axes.thickness`; of a prism along z, from 0."},
    Key{"part.outline", Type::polygon, kind::length, "", any, "", "Corners of a prism's outline, x and y, in order."},
    Key{"part.holes[].outline", Type::polygon, kind::length, "", any, "", "Corners, x and y, in order.", required},
    Key{"part.zones[].outline", Type::polygon, kind::length, "", any, "", "Corners, x and y, in order.", required},
    Key{"part.zones[].thickness", Type::quantity, kind::length, "", positive, "", "Extent along z inside the outline.", required},
    Key{"part.zones[].bottom", Type::quantity, kind::length, "0", any, "", "Where it starts along z."},
    Key{"part.bend.radius", Type::quantity, kind::length, "", any, "", "Radius of the mid-surface; negative bends to the other side. Points, faces and selections stay in the flat part's coordinates, directions in space.", required},
    Key{"part.bend.along", Type::choice, kind::number, "", any, "x|y|z", "Axis that becomes the arc; its middle stays where it is. The longest but the thickness's if not given."},
    Key{"part.axes.length", Type::choice, kind::number, "\"y\"", any, "x|y|z", "Axis of the length."},
    Key{"part.axes.height", Type::choice, kind::number, "\"z\"", any, "x|y|z", "Axis of the height."},
    Key{"part.axes.thickness", Type::choice, kind::number, "\"x\"", any, "x|y|z", "Axis of the thickness."},
    Key{"part.material.youngs_modulus", Type::quantity, kind::stress, "", modulus_bounds, "", "Young's modulus.", required},
    Key{"part.material.poisson_ratio", Type::quantity, kind::number, "", poisson_bounds, "", "Poisson's ratio.", required},
    Key{"part.material.density", Type::quantity, kind::density, "", density_bounds, "", "Density.", required},
    Key{"part.mesh.element_size", Type::quantity, kind::length, "\"auto\"", positive, "auto", "`auto`: a graded mesh whose size and order follow from the tolerance. Or the edge of a regular tetrahedron of the largest volume allowed; of a prism or a bent part, the edge in the plane."},
    Key{"part.mesh.tolerance", Type::quantity, kind::number, "0.001", {1e-6, 0.1, false, false, false, "0.001 is a thousandth of a frequency or receptance"}, "", "With `element_size = \"auto\"`: largest relative error of frequencies and of receptances at the interface, by estimate."},
    Key{"part.mesh.order", Type::integer, kind::number, "\"auto\"", {1, 6, false, false, false, ""}, "auto", "Polynomial order of the elements. `auto`: what the tolerance takes; 2 with a given size."},
    Key{"part.mesh.quality", Type::quantity, kind::number, "1.4", {1.1, 5, false, false, false, "TetGen may not end below 1.1"}, "", "Bound on circumradius over shortest edge."},
    Key{"part.mesh.grading", Type::quantity, kind::number, "", {1.0, 10.0, false, false, false, "1 keeps the size at the points, 1.5 lets it grow"}, "", "Growth of the element size away from the named points, with `point_element_size`; 1.5 if not given."},
    Key{"part.mesh.point_element_size", Type::quantity, kind::length, "", positive, "", "Element size near the named points."},
    Key{"part.mesh.time_limit", Type::quantity, kind::time, "\"120 s\"", positive, "", "Time after which the mesher is stopped."},
    Key{"part.mesh.memory_limit", Type::quantity, kind::memory, "\"4 GB\"", {1e7, infinity, false, false, false, "a memory needs its unit: \"4 GB\""}, "", "Memory at which the mesher is stopped."},
    Key{"part.supports[].on", Type::name, kind::number, "", any, "", "A face of the box, `x_min` … `z_max`, or a selection.", required},
    Key{"part.supports[].fixed", Type::names, kind::number, "[\"x\", \"y\", \"z\"]", any, "x|y|z", "Directions held at zero."},
    Key{"part.measured[].response", Type::name, kind::number, "", any, "", "DOF that moves, `P.x`.", required},
    Key{"part.measured[].force", Type::name, kind::number, "", any, "", "DOF that is excited.", required},
    Key{"part.measured[].file", Type::file, kind::number, "", any, "", "CSV (frequency, real part, imaginary part; perhaps coherence), `.frf`, Universal File (`.uff`, `.unv`) or MAT file.", required},
    Key{"part.measured[].quantity", Type::choice, kind::number, "", any, "receptance|mobility|accelerance", "What was measured. A Universal File or a MAT file of ours says it itself."},
    Key{"part.measured[].unit", Type::text, kind::number, "", any, "", "Unit of the FRF: `m/N`, `um/N`, `m/s/N`, `m/s^2/N` …"},
    Key{"part.measured[].frequency_unit", Type::choice, kind::number, "\"Hz\"", any, "Hz|rad/s", "Unit of the first column."},
    Key{"part.measured[].record", Type::integer, kind::number, "", {1, 1e6, false, false, false, "FRFs are numbered from 1"}, "", "Of a file with several FRFs: which one, in their order; not needed where one is there."},
    Key{"part.measured[].noise", Type::quantity, kind::number, "", uncertainty, "", "Standard deviation of its real and imaginary part, relative to its size: what the error budget starts from."},
    Key{"part.measured[].averages", Type::integer, kind::number, "", {1, 1e6, false, false, false, "an average is of one measurement or more"}, "", "In place of `noise`: the number of averages behind the file's coherence, from which the noise follows."},
    Key{"part.sensors[].at", Type::name, kind::number, "", any, "", "Measured point, `P`: excited as well as measured.", required},
    Key{"part.sensors[].mass", Type::quantity, kind::mass, "", sensor_mass, "", "Its mass, with what holds it on and moves with it.", required},

    Key{"selections.*.plane.point", Type::vector, kind::length, "", any, "", "A point of the plane.", required},
    Key{"selections.*.plane.normal", Type::direction, kind::number, "", any, "", "Its normal.", required},
    Key{"selections.*.box.min", Type::vector, kind::length, "", any, "", "Smallest x, y, z.", required},
    Key{"selections.*.box.max", Type::vector, kind::length, "", any, "", "Largest x, y, z.", required},
    Key{"selections.*.sphere.centre", Type::vector, kind::length, "", any, "", "Centre.", required},
    Key{"selections.*.sphere.radius", Type::quantity, kind::length, "", positive, "", "Radius.", required},

    Key{"points.*.at", Type::vector, kind::number, "", fraction, "", "Position in fractions of the box along x, y, z."},
    Key{"points.*.position", Type::vector, kind::length, "", any, "", "Position in the part's axes."},
    Key{"points.*.offset", Type::vector, kind::length, "[0, 0, 0]", any, "", "Added to the position."},
    Key{"points.*.patch_radius", Type::quantity, kind::length, "0", not_negative, "", "The point stands for the mean motion of the surface within this radius; 0 for a single node."},
    Key{"points.*.directions", Type::directions, kind::number, "[\"x\", \"y\", \"z\"]", any, "", "Directions in which it can be loaded and watched."},

    Key{"modes.count", Type::integer, kind::number, "", {1, 2000, false, false, false, ""}, "", "Number of modes."},
    Key{"modes.up_to", Type::quantity, kind::frequency, "", positive, "", "All modes up to this frequency."},
    Key{"modes.verify_count", Type::boolean, kind::number, "false", any, "", "Confirm by a Sturm count that no mode was missed."},

    Key{"reduction.method", Type::choice, kind::number, "\"craig_bampton\"", any, "craig_bampton", "The method."},
    Key{"reduction.modes", Type::integer, kind::number, "", {0, 2000, false, false, false, ""}, "", "Number of fixed-interface modes."},
    Key{"reduction.up_to", Type::quantity, kind::frequency, "", positive, "", "All fixed-interface modes up to this frequency."},
    Key{"reduction.interface", Type::names, kind::number, "", any, "", "Points that are kept; all points if not given."},
    Key{"reduction.check_frequencies", Type::integer, kind::number, "5", {0, 1000, false, false, false, ""}, "", "Lines at which the reduced model is compared with the full one."},

    Key{"damping.model", Type::choice, kind::number, "\"modal\"", any, "modal|rayleigh|structural", "The model."},
    Key{"damping.ratio", Type::quantity, kind::number, "0.01", damping_ratio, "", "Ratio of every mode that `ratios` does not name."},
    Key{"damping.ratios", Type::quantities, kind::number, "", damping_ratio, "", "Ratios of the first modes."},
    Key{"damping.alpha", Type::quantity, kind::rate, "0", not_negative, "", "C = alpha M + beta K (rayleigh)."},
    Key{"damping.beta", Type::quantity, kind::time, "0", not_negative, "", "C = alpha M + beta K (rayleigh)."},
    Key{"damping.loss_factor", Type::quantity, kind::number, "0", {0.0, 1.0, false, true, false, "steel in a fixture lies at 0.001 to 0.05"}, "", "K (1 + i loss_factor) (structural)."},
    Key{"damping.from_frf.response", Type::name, kind::number, "", any, "", "DOF that moves, `P.x`.", required},
    Key{"damping.from_frf.force", Type::name, kind::number, "", any, "", "DOF that is excited.", required},
    Key{"damping.from_frf.file", Type::file, kind::number, "", any, "", "CSV (frequency, real part, imaginary part; perhaps coherence), `.frf`, Universal File (`.uff`, `.unv`) or MAT file.", required},
    Key{"damping.from_frf.quantity", Type::choice, kind::number, "", any, "receptance|mobility|accelerance", "What was measured. A Universal File or a MAT file of ours says it itself."},
    Key{"damping.from_frf.unit", Type::text, kind::number, "", any, "", "Unit of the FRF."},
    Key{"damping.from_frf.frequency_unit", Type::choice, kind::number, "\"Hz\"", any, "Hz|rad/s", "Unit of the first column."},
    Key{"damping.from_frf.record", Type::integer, kind::number, "", {1, 1e6, false, false, false, "FRFs are numbered from 1"}, "", "Of a file with several FRFs: which one, in their order; not needed where one is there."},

    Key{"robot.model", Type::choice, kind::number, "\"one_mode\"", any, "one_mode|modes|measured|modal_table|flexible_joints|virtual_joints", "How the tip is known."},
    Key{"robot.point", Type::text, kind::number, "\"R\"", any, "", "Name of the tip."},
    Key{"robot.direction", Type::direction, kind::number, "\"x\"", any, "", "Direction in which the tip moves."},
    Key{"robot.frequency", Type::quantity, kind::frequency, "", positive, "", "Natural frequency, with `stiffness` and `damping_ratio`."},
    Key{"robot.damping_ratio", Type::quantity, kind::number, "", damping_ratio, "", "Damping ratio."},
    Key{"robot.stiffness", Type::quantity, kind::stiffness, "", positive, "", "Stiffness of the mode at the tip."},
    Key{"robot.mass", Type::quantity, kind::mass, "", positive, "", "Modal mass at the tip, in place of the frequency."},
    Key{"robot.damping", Type::quantity, kind::damping, "", not_negative, "", "Viscous damping, in place of the ratio."},
    Key{"robot.preload", Type::vector, kind::force, "[0, 0, 0]", any, "", "Force of the part on the tip at rest, along the part's axes. It changes the arm's stiffness, and a contact that the cut pulls by more is flagged."},
    Key{"robot.gravity", Type::vector, kind::acceleration, "", any, "", "Along the part's axes; 9.81 m/s^2 against `base.z` if not given."},
    Key{"robot.modes[].frequency", Type::quantity, kind::frequency, "", positive, "", "Natural frequency.", required},
    Key{"robot.modes[].damping_ratio", Type::quantity, kind::number, "", damping_ratio, "", "Damping ratio.", required},
    Key{"robot.modes[].stiffness", Type::quantity, kind::stiffness, "", positive, "", "Modal stiffness at the tip.", required},
    Key{"robot.modes[].direction", Type::direction, kind::number, "\"x\"", any, "", "Direction in which the tip moves."},
    Key{"robot.links[].name", Type::text, kind::number, "\"\"", any, "", "For messages and counterbalances."},
    Key{"robot.links[].position", Type::vector, kind::length, "[0, 0, 0]", any, "", "The joint's place in the frame of the link before."},
    Key{"robot.links[].rotation", Type::vector, kind::angle, "[0, 0, 0]", any, "", "The joint's axes in the frame of the link before: turned about x, then y, then z of that frame."},
    Key{"robot.links[].axis", Type::direction, kind::number, "\"z\"", any, "", "The joint's axis, in the link's axes."},
    Key{"robot.links[].mass", Type::quantity, kind::mass, "", not_negative, "", "Mass.", required},
    Key{"robot.links[].centre", Type::vector, kind::length, "", any, "", "Centre of mass, in the link's frame.", required},
    Key{"robot.links[].inertia", Type::quantities, kind::inertia, "", any, "", "About the centre of mass, in the link's axes: xx, yy, zz, or xx, yy, zz, xy, xz, yz (of the tensor: −∫xy dm).", required},
    Key{"robot.links[].stiffness", Type::quantity, kind::torsional_stiffness, "", positive, "", "Of the joint's gearbox.", required},
    Key{"robot.links[].damping", Type::quantity, kind::torsional_damping, "0", not_negative, "", "Beside it."},
    Key{"robot.links[].motor_inertia", Type::quantity, kind::inertia, "0", not_negative, "", "Of the rotor about its shaft."},
    Key{"robot.links[].gear_ratio", Type::quantity, kind::number, "1", any, "", "Turns of the rotor for one of the joint."},
    Key{"robot.links[].servo_stiffness", Type::quantity, kind::torsional_stiffness, "\"inf\"", {0.0, infinity, false, false, true, "\"inf\" for a locked motor"}, "", "Position gain at the joint; `inf` for a locked motor."},
    Key{"robot.links[].servo_damping", Type::quantity, kind::torsional_damping, "0", not_negative, "", "Speed gain at the joint."},
    Key{"robot.table", Type::file, kind::number, "", any, "", "CSV of modes (`model = \"modal_table\"`): frequency, damping, left and right vectors as docs/theory/robots.md has them."},
    Key{"robot.table_point", Type::text, kind::number, "\"1\"", any, "", "The table's name of the tip; its X, Y, Z are the axes of `base`."},
    Key{"robot.left_unit", Type::text, kind::number, "\"sqrt(s/kg)\"", any, "", "Unit of the left vectors: `sqrt(s/kg)`, `1e-7 sqrt(s/kg)`."},
    Key{"robot.right_unit", Type::text, kind::number, "\"sqrt(s/kg)\"", any, "", "Unit of the right vectors."},
    Key{"robot.cross_terms", Type::boolean, kind::number, "true", any, "", "Of a modal table: false leaves out the receptances between different directions, to see what they do."},
    Key{"robot.elements[].kind", Type::choice, kind::number, "", any, "rotation|translation|beam|offset|body", "What it is.", required},
    Key{"robot.elements[].chain", Type::integer, kind::number, "1", {1, 12, false, false, false, "chains are numbered from 1"}, "", "Of a parallel robot: the chain that it belongs to; all hold one tip."},
    Key{"robot.elements[].axis", Type::direction, kind::number, "\"z\"", any, "", "Of a joint."},
    Key{"robot.elements[].angle", Type::quantity, kind::angle, "0", any, "", "Of a rotation: where it stands."},
    Key{"robot.elements[].distance", Type::quantity, kind::length, "0", any, "", "Of a translation: where it stands."},
    Key{"robot.elements[].stiffness", Type::quantity, kind::torsional_stiffness, "", {0.0, infinity, true, false, true, "leave it out for a passive joint, \"inf\" for a locked one"}, "", "Of a rotation; none: the joint is passive."},
    Key{"robot.elements[].damping", Type::quantity, kind::torsional_damping, "0", not_negative, "", "Of a rotation."},
    Key{"robot.elements[].linear_stiffness", Type::quantity, kind::stiffness, "", {0.0, infinity, true, false, true, "leave it out for a passive joint, \"inf\" for a locked one"}, "", "Of a translation; none: the joint is passive."},
    Key{"robot.elements[].linear_damping", Type::quantity, kind::damping, "0", not_negative, "", "Of a translation."},
    Key{"robot.elements[].length", Type::quantity, kind::length, "", positive, "", "Of a beam, along x."},
    Key{"robot.elements[].outer_diameter", Type::quantity, kind::length, "", positive, "", "Of a beam."},
    Key{"robot.elements[].inner_diameter", Type::quantity, kind::length, "0", not_negative, "", "Of a beam."},
    Key{"robot.elements[].youngs_modulus", Type::quantity, kind::stress, "\"210 GPa\"", modulus_bounds, "", "Of a beam."},
    Key{"robot.elements[].poisson_ratio", Type::quantity, kind::number, "0.3", poisson_bounds, "", "Of a beam."},
    Key{"robot.elements[].density", Type::quantity, kind::density, "\"7850 kg/m^3\"", density_bounds, "", "Of a beam."},
    Key{"robot.elements[].position", Type::vector, kind::length, "[0, 0, 0]", any, "", "Of an offset."},
    Key{"robot.elements[].rotation", Type::vector, kind::angle, "[0, 0, 0]", any, "", "Of an offset: turned about x, then y, then z."},
    Key{"robot.elements[].mass", Type::quantity, kind::mass, "", not_negative, "", "Of a body."},
    Key{"robot.elements[].centre", Type::vector, kind::length, "[0, 0, 0]", any, "", "Of a body, in the frame where it stands."},
    Key{"robot.elements[].inertia", Type::quantities, kind::inertia, "[0, 0, 0]", any, "", "Of a body about its centre: xx, yy, zz, or these and xy, xz, yz."},
    Key{"robot.urdf", Type::file, kind::number, "", any, "", "The links from a URDF file, in place of [[robot.links]]; it knows no stiffness: `joints` does."},
    Key{"robot.urdf_base", Type::text, kind::number, "\"\"", any, "", "Name of the link that stands; the root if not given. `base` places it."},
    Key{"robot.urdf_tip", Type::text, kind::number, "\"\"", any, "", "Name of the link that is the tip; the end of the only chain if not given."},
    Key{"robot.joints", Type::file, kind::number, "", any, "", "TOML with a [[joints]] for each joint of the URDF."},
    Key{"robot.counterbalances[].from", Type::name, kind::number, "\"base\"", any, "", "Name of a link, or `base`."},
    Key{"robot.counterbalances[].from_point", Type::vector, kind::length, "", any, "", "In its frame.", required},
    Key{"robot.counterbalances[].to", Type::name, kind::number, "", any, "", "Name of another link.", required},
    Key{"robot.counterbalances[].to_point", Type::vector, kind::length, "", any, "", "In its frame.", required},
    Key{"robot.counterbalances[].force", Type::quantity, kind::force, "0", any, "", "Pull at `length`; negative pushes."},
    Key{"robot.counterbalances[].length", Type::quantity, kind::length, "", not_negative, "", "Distance of the ends at which `force` is given.", required},
    Key{"robot.counterbalances[].stiffness", Type::quantity, kind::stiffness, "0", not_negative, "", "What the pull gains as they part."},
    Key{"robot.base.position", Type::vector, kind::length, "[0, 0, 0]", any, "", "Origin of the base's frame."},
    Key{"robot.base.x", Type::direction, kind::number, "\"x\"", any, "", "Its x axis."},
    Key{"robot.base.z", Type::direction, kind::number, "\"z\"", any, "", "Its z axis, at a right angle."},
    Key{"robot.tip.position", Type::vector, kind::length, "[0, 0, 0]", any, "", "Place of the tip."},
    Key{"robot.tip.rotation", Type::vector, kind::angle, "[0, 0, 0]", any, "", "Its axes: turned about x, then y, then z."},
    Key{"robot.posture.joints", Type::quantities, kind::angle, "", any, "", "The joints' angles."},
    Key{"robot.posture.tip", Type::vector, kind::length, "", any, "", "Place of the tip in the part's axes; where the first contact is if not given."},
    Key{"robot.posture.pitch", Type::quantity, kind::angle, "", any, "", "Of a four-axis arm (first axis z, the others y): angle of the last link from the base's z."},
    Key{"robot.posture.elbow", Type::choice, kind::number, "\"up\"", any, "up|down", "With `pitch`: sign of the third joint's angle, `up` positive."},
    Key{"robot.posture.facing", Type::choice, kind::number, "\"ahead\"", any, "ahead|behind", "With `pitch`: the first joint turns the arm towards the place, or away from it."},
    Key{"robot.posture.approach", Type::direction, kind::number, "", any, "", "Direction of the tip's z axis, in the part's axes; the posture is searched from `start`."},
    Key{"robot.posture.angle", Type::quantity, kind::angle, "0", any, "", "With `approach`: turn of the tip about it, which is free for a round tip. At 0 the tip's x axis lies in the plane of `approach` and the base's z, towards z."},
    Key{"robot.posture.start", Type::quantities, kind::angle, "", any, "", "With `approach`: joint angles to search from; zeros if not given."},
    Key{"robot.workspace.from", Type::vector, kind::length, "", any, "", "One corner, in the part's axes.", required},
    Key{"robot.workspace.to", Type::vector, kind::length, "", any, "", "The other.", required},
    Key{"robot.workspace.counts", Type::quantities, kind::number, "[5, 5, 5]", {1.0, 100.0, false, false, false, "1 to 100 places along each axis"}, "", "Places along x, y, z."},
    Key{"robot.measured[].response", Type::name, kind::number, "", any, "", "DOF that moves, `R.x`.", required},
    Key{"robot.measured[].force", Type::name, kind::number, "", any, "", "DOF that is excited.", required},
    Key{"robot.measured[].file", Type::file, kind::number, "", any, "", "CSV (frequency, real part, imaginary part; perhaps coherence), `.frf`, Universal File (`.uff`, `.unv`) or MAT file.", required},
    Key{"robot.measured[].quantity", Type::choice, kind::number, "", any, "receptance|mobility|accelerance", "What was measured. A Universal File or a MAT file of ours says it itself."},
    Key{"robot.measured[].unit", Type::text, kind::number, "", any, "", "Unit of the FRF."},
    Key{"robot.measured[].frequency_unit", Type::choice, kind::number, "\"Hz\"", any, "Hz|rad/s", "Unit of the first column."},
    Key{"robot.measured[].record", Type::integer, kind::number, "", {1, 1e6, false, false, false, "FRFs are numbered from 1"}, "", "Of a file with several FRFs: which one, in their order; not needed where one is there."},
    Key{"robot.measured[].noise", Type::quantity, kind::number, "", uncertainty, "", "Standard deviation of its real and imaginary part, relative to its size: what the error budget starts from."},
    Key{"robot.measured[].averages", Type::integer, kind::number, "", {1, 1e6, false, false, false, "an average is of one measurement or more"}, "", "In place of `noise`: the number of averages behind the file's coherence, from which the noise follows."},
    Key{"robot.sensors[].at", Type::name, kind::number, "", any, "", "Measured point, `R`.", required},
    Key{"robot.sensors[].mass", Type::quantity, kind::mass, "", sensor_mass, "", "Its mass, with what holds it on and moves with it.", required},

    Key{"contacts[].part", Type::name, kind::number, "", any, "", "Point of the part.", required},
    Key{"contacts[].robot", Type::name, kind::number, "\"R\"", any, "", "Point of the robot."},
    Key{"contacts[].directions", Type::directions, kind::number, "[\"x\"]", any, "", "Directions in which they are joined; the others stay free."},
    Key{"contacts[].stiffness", Type::quantities, kind::stiffness, "\"inf\"", stiffness_or_infinite, "", "One, or one per direction."},
    Key{"contacts[].damping", Type::quantities, kind::damping, "0", not_negative, "", "Viscous damping, one or one per direction."},
    Key{"contacts[].loss_factor", Type::quantity, kind::number, "0", {0.0, 1.0, false, true, false, "K (1 + i loss_factor)"}, "", "Structural damping of the contact."},
    Key{"contacts[].model", Type::choice, kind::number, "\"springs\"", any, "springs|table|hertz|caster", "Where the stiffness comes from. `springs`: `stiffness` and `damping`. From the preload: `table`, measured; `hertz`, a ball, by Hertz along the first direction and by Mindlin along those across it; `caster`, a ball on balls, one direction."},
    Key{"contacts[].preload", Type::quantity, kind::force, "", {0.0, infinity, true, false, false, "without a preload there is no contact"}, "", "Force that presses both together at rest. Of the only contact: the part of `robot.preload` along the first direction if not given."},
    Key{"contacts[].table", Type::file, kind::number, "", any, "", "CSV with the columns `preload_n`, `stiffness_n_per_m`, `damping_n_s_per_m` (`model = \"table\"`): monotone cubics between its rows, nothing outside."},
    Key{"contacts[].damping_model", Type::choice, kind::number, "\"viscous\"", any, "viscous|structural|both", "With `measured`: C, the loss factor, or both are sought."},
    Key{"contacts[].noise", Type::quantities, kind::number, "0.01", {0.0, 1.0, true, true, false, "relative: 1 % is 0.01"}, "", "With `measured`: standard deviation of real and imaginary part of an FRF, relative to its size, for weights and confidence. One, or three: of the assembly, of the part, of the robot."},
    Key{"contacts[].ball.radius", Type::quantity, kind::length, "", positive, "", "Radius of the ball that touches.", required},
    Key{"contacts[].ball.youngs_modulus", Type::quantity, kind::stress, "\"210 GPa\"", modulus_bounds, "", "Of the ball; of a caster, of its cup and carrying balls too."},
    Key{"contacts[].ball.poisson_ratio", Type::quantity, kind::number, "0.3", poisson_bounds, "", "Likewise."},
    Key{"contacts[].ball.supports", Type::integer, kind::number, "", {3, 1000, false, false, false, "balls that bear the main ball"}, "", "Of a caster: number of carrying balls."},
    Key{"contacts[].ball.support_radius", Type::quantity, kind::length, "", positive, "", "Of a caster: their radius."},
    Key{"contacts[].ball.support_angle", Type::quantity, kind::angle, "", right_angle, "", "Of a caster: from its axis to where they touch the main ball."},
    Key{"contacts[].surface.youngs_modulus", Type::quantity, kind::stress, "", modulus_bounds, "", "Young's modulus.", required},
    Key{"contacts[].surface.poisson_ratio", Type::quantity, kind::number, "", poisson_bounds, "", "Poisson's ratio.", required},
    Key{"contacts[].measured[].response", Type::name, kind::number, "", any, "", "DOF of the part that moves, `P.x`.", required},
    Key{"contacts[].measured[].force", Type::name, kind::number, "", any, "", "DOF of the part that is excited.", required},
    Key{"contacts[].measured[].file", Type::file, kind::number, "", any, "", "CSV (frequency, real part, imaginary part; perhaps coherence), `.frf`, Universal File (`.uff`, `.unv`) or MAT file.", required},
    Key{"contacts[].measured[].quantity", Type::choice, kind::number, "", any, "receptance|mobility|accelerance", "What was measured. A Universal File or a MAT file of ours says it itself."},
    Key{"contacts[].measured[].unit", Type::text, kind::number, "", any, "", "Unit of the FRF."},
    Key{"contacts[].measured[].frequency_unit", Type::choice, kind::number, "\"Hz\"", any, "Hz|rad/s", "Unit of the first column."},
    Key{"contacts[].measured[].record", Type::integer, kind::number, "", {1, 1e6, false, false, false, "FRFs are numbered from 1"}, "", "Of a file with several FRFs: which one, in their order; not needed where one is there."},

    Key{"coupling.regularisation", Type::choice, kind::number, "\"none\"", any, "none|truncated|tikhonov", "What becomes of small singular values of the kernel (docs/theory/coupling.md, Eq. 8). `none`: a singular kernel is an error. The spatial route knows no regularisation: the routes then differ where it acts."},
    Key{"coupling.threshold", Type::quantity, kind::number, "1e-10", {0.0, 1.0, true, true, false, "a share of the largest singular value"}, "", "Of the largest singular value: those below are left out (`truncated`) or damped (`tikhonov`)."},

    Key{"response.from", Type::quantity, kind::frequency, "\"1 Hz\"", not_negative, "", "First line."},
    Key{"response.to", Type::quantity, kind::frequency, "\"2000 Hz\"", positive, "", "Last line."},
    Key{"response.lines", Type::integer, kind::number, "2000", {2, 1e6, false, false, false, ""}, "", "Number of lines."},
    Key{"response.spacing", Type::choice, kind::number, "\"linear\"", any, "linear|logarithmic", "How they are spread."},
    Key{"response.points", Type::names, kind::number, "", any, "", "Points at and between which FRFs are written; the interface if not given."},

    Key{"updating[].name", Type::text, kind::number, "", any, "", "Name of the fit in the results.", required},
    Key{"updating[].on", Type::choice, kind::number, "\"part\"", any, "part|coupled", "The model that is fitted."},
    Key{"updating[].parameters[].key", Type::text, kind::number, "", any, "", "Dotted key of the number, `part.length`.", required},
    Key{"updating[].parameters[].lower", Type::amount, kind::number, "", any, "", "Least value, in the dimension of the key.", required},
    Key{"updating[].parameters[].upper", Type::amount, kind::number, "", any, "", "Largest value.", required},
    Key{"updating[].targets[].quantity", Type::choice, kind::number, "", any, "part_frequency|coupled_frequency|reduction_at", "What is known. `reduction_at`: 1 − abs(G)/abs(H) at `point`.", required},
    Key{"updating[].targets[].value", Type::amount, kind::number, "", any, "", "Its value: a frequency, or a number for `reduction_at`.", required},
    Key{"updating[].targets[].point", Type::name, kind::number, "", any, "", "DOF at which it is seen, `P.x`.", required},
    Key{"updating[].targets[].match", Type::choice, kind::number, "\"participation\"", any, "participation|mac|number", "How the mode is found: those that take part at `point` by a tenth of the largest, the best MAC with the starting model, or the bare number."},
    Key{"updating[].targets[].rank", Type::integer, kind::number, "1", at_least_one, "", "Which of these modes, by rising frequency."},
    Key{"updating[].targets[].frequency", Type::quantity, kind::frequency, "", positive, "", "Where the reduction is read (`reduction_at`); at the frequency of the matched mode of the part if not given."},
    Key{"updating[].targets[].weight", Type::quantity, kind::number, "1", positive, "", "Weight of the relative deviation in the sum of squares."},

    Key{"tool.teeth", Type::integer, kind::number, "", {1, 100, false, false, false, ""}, "", "Number of teeth.", required},
    Key{"tool.diameter", Type::quantity, kind::length, "", positive, "", "Diameter.", required},
    Key{"tool.length", Type::quantity, kind::length, "", positive, "", "Length of the cutting edges: no deeper cut is possible.", required},
    Key{"tool.pitches", Type::quantities, kind::angle, "", {0.0, 6.2831853072, true, false, false, "a full turn is 360 deg"}, "", "Angle from each tooth to the one ahead of it, at the tip; equal if not given. One a tooth, 360 deg together."},
    Key{"tool.helices", Type::quantities, kind::angle, "", {0.0, 1.3962634016, false, false, false, "end mills have 30 to 45 deg"}, "", "Helix angle of each tooth, or one for all; none if not given."},
    Key{"tool.runout", Type::quantities, kind::length, "", any, "", "Radial offset of each tooth, outwards positive; changes the mean chip of a law that is not linear."},
    Key{"tool.end", Type::choice, kind::number, "\"flat\"", any, "flat|ball|bull_nose|general", "Shape of the tip; `general` is the envelope of seven parameters of Engin & Altintas 2001, with `diameter` and `length` its D and h."},
    Key{"tool.corner_radius", Type::quantity, kind::length, "", not_negative, "", "Of `bull_nose` and `general`: R."},
    Key{"tool.corner_radial", Type::quantity, kind::length, "", any, "", "Of `general`: centre of the corner's arc from the axis, R_r; 0 if not given."},
    Key{"tool.corner_axial", Type::quantity, kind::length, "", any, "", "Of `general`: centre of the corner's arc above the tip, R_z; 0 if not given."},
    Key{"tool.tip_angle", Type::quantity, kind::angle, "", right_angle, "", "Of `general`: cone at the tip, from the plane across the axis; 0 if not given."},
    Key{"tool.taper", Type::quantity, kind::angle, "", tilt, "", "Of `general`: of the side from the axis, positive where it widens upwards; 0 if not given."},
    Key{"tool.modes[].frequency", Type::quantity, kind::frequency, "", positive, "", "Natural frequency.", required},
    Key{"tool.modes[].damping_ratio", Type::quantity, kind::number, "", damping_ratio, "", "Damping ratio.", required},
    Key{"tool.modes[].stiffness", Type::quantity, kind::stiffness, "", positive, "", "Modal stiffness at the tip.", required},
    Key{"tool.modes[].direction", Type::direction, kind::number, "", any, "", "Direction, in the part's axes.", required},

    Key{"tool.measured[].response", Type::choice, kind::number, "", any, "x|y|z", "Direction that moves, in the part's axes.", required},
    Key{"tool.measured[].force", Type::choice, kind::number, "", any, "x|y|z", "Direction that is excited. A cross FRF serves its reverse, too, unless that is given.", required},
    Key{"tool.measured[].file", Type::file, kind::number, "", any, "", "CSV (frequency, real part, imaginary part), `.frf`, Universal File or MAT file. Lines are those of the first file.", required},
    Key{"tool.measured[].quantity", Type::choice, kind::number, "", any, "receptance|mobility|accelerance", "What was measured. A Universal File or a MAT file of ours says it itself."},
    Key{"tool.measured[].unit", Type::text, kind::number, "", any, "", "Unit of the FRF: `m/N`, `um/N`, `m/s/N`, `m/s^2/N` …"},
    Key{"tool.measured[].frequency_unit", Type::choice, kind::number, "\"Hz\"", any, "Hz|rad/s", "Unit of the first column."},
    Key{"tool.measured[].record", Type::integer, kind::number, "", {1, 1e6, false, false, false, "FRFs are numbered from 1"}, "", "Of a file with several FRFs: which one, in their order; not needed where one is there."},
    Key{"tool.measured[].noise", Type::quantity, kind::number, "", uncertainty, "", "Standard deviation of its real and imaginary part, relative to its size: what the error budget starts from."},
    Key{"tool.measured[].averages", Type::integer, kind::number, "", {1, 1e6, false, false, false, "an average is of one measurement or more"}, "", "In place of `noise`: the number of averages behind the file's coherence, from which the noise follows."},

    Key{"tool.swap.tip", Type::text, kind::number, "\"1\"", any, "", "Name of the tip in the measured FRFs."},
    Key{"tool.swap.up", Type::text, kind::number, "\"1a\"", any, "", "Name of the point up the tool."},
    Key{"tool.swap.distance", Type::quantity, kind::length, "", positive, "", "Of that point from the tip.", required},
    Key{"tool.swap.rotations", Type::choice, kind::number, "\"none\"", any, "none|second_difference|corrected|rank_one", "`none`: the 16 displacements as they are, without bias. The others take rotations at the tip by differences, as published."},
    Key{"tool.swap.measured[].response", Type::name, kind::number, "", any, "", "DOF that moves, `1.x`.", required},
    Key{"tool.swap.measured[].force", Type::name, kind::number, "", any, "", "DOF that is excited.", required},
    Key{"tool.swap.measured[].file", Type::file, kind::number, "", any, "", "CSV (frequency, real part, imaginary part), `.frf`, Universal File or MAT file. Lines are those of the first file.", required},
    Key{"tool.swap.measured[].quantity", Type::choice, kind::number, "", any, "receptance|mobility|accelerance", "What was measured. A Universal File or a MAT file of ours says it itself."},
    Key{"tool.swap.measured[].unit", Type::text, kind::number, "", any, "", "Unit of the FRF."},
    Key{"tool.swap.measured[].frequency_unit", Type::choice, kind::number, "\"Hz\"", any, "Hz|rad/s", "Unit of the first column."},
    Key{"tool.swap.measured[].record", Type::integer, kind::number, "", {1, 1e6, false, false, false, "FRFs are numbered from 1"}, "", "Of a file with several FRFs: which one, in their order."},
    Key{"tool.swap.reference[].length", Type::quantity, kind::length, "", positive, "", "Length; of the last one up to the holder.", required},
    Key{"tool.swap.reference[].outer_diameter", Type::quantity, kind::length, "", positive, "", "Diameter; of a fluted part about 0.8 of the cutter's.", required},
    Key{"tool.swap.reference[].inner_diameter", Type::quantity, kind::length, "0", not_negative, "", "Of a bore."},
    Key{"tool.swap.reference[].youngs_modulus", Type::quantity, kind::stress, "", modulus_bounds, "", "Young's modulus.", required},
    Key{"tool.swap.reference[].poisson_ratio", Type::quantity, kind::number, "0.22", poisson_bounds, "", "Poisson's ratio."},
    Key{"tool.swap.reference[].density", Type::quantity, kind::density, "", density_bounds, "", "Density.", required},
    Key{"tool.swap.target[].length", Type::quantity, kind::length, "", positive, "", "Length; of the last one up to the holder.", required},
    Key{"tool.swap.target[].outer_diameter", Type::quantity, kind::length, "", positive, "", "Diameter; of a fluted part about 0.8 of the cutter's.", required},
    Key{"tool.swap.target[].inner_diameter", Type::quantity, kind::length, "0", not_negative, "", "Of a bore."},
    Key{"tool.swap.target[].youngs_modulus", Type::quantity, kind::stress, "", modulus_bounds, "", "Young's modulus.", required},
    Key{"tool.swap.target[].poisson_ratio", Type::quantity, kind::number, "0.22", poisson_bounds, "", "Poisson's ratio."},
    Key{"tool.swap.target[].density", Type::quantity, kind::density, "", density_bounds, "", "Density.", required},
    Key{"cutting.at", Type::name, kind::number, "", any, "", "Point of the part that is cut; not needed without a part."},
    Key{"cutting.radial_depth", Type::quantity, kind::length, "", positive, "", "Radial depth of cut; or give `entry_angle` and `exit_angle`."},
    Key{"cutting.entry_angle", Type::quantities, kind::angle, "", turn, "", "Where teeth enter, one an arc: 0 on the normal side (tool_axis x feed_direction), 90 deg ahead, 180 deg opposite; in place of `radial_depth`."},
    Key{"cutting.exit_angle", Type::quantities, kind::angle, "", turn, "", "Where they leave, one an arc, each after its entry."},
    Key{"cutting.lead_angle", Type::quantity, kind::angle, "0", tilt, "", "The tool leans forwards by this angle, from `tool_axis` towards `feed_direction`; depth and engagement are meant in its own axes."},
    Key{"cutting.mode", Type::choice, kind::number, "\"down\"", any, "down|up", "Down (climb) or up (conventional) milling."},
    Key{"cutting.feed_direction", Type::direction, kind::number, "\"y\"", any, "", "Feed of the tool, in the part's axes."},
    Key{"cutting.tool_axis", Type::direction, kind::number, "\"z\"", any, "", "Axis of the tool, in the part's axes."},
    Key{"cutting.Kt", Type::quantity, kind::stress, "", coefficient_bounds, "", "Tangential cutting coefficient: K_t of the linear law, k1.1 (at a chip of 1 mm) of the power law, stiffness at thin chips of the fractional one; none of `oblique`."},
    Key{"cutting.Kr", Type::quantity, kind::stress, "0", radial_bounds, "", "Radial cutting coefficient."},
    Key{"cutting.Ka", Type::quantity, kind::stress, "0", axial_bounds, "", "Axial cutting coefficient, positive towards the spindle."},
    Key{"cutting.Kte", Type::quantity, kind::stiffness, "0", not_negative, "", "Tangential edge coefficient."},
    Key{"cutting.Kre", Type::quantity, kind::stiffness, "0", not_negative, "", "Radial edge coefficient."},
    Key{"cutting.Kae", Type::quantity, kind::stiffness, "0", not_negative, "", "Axial edge coefficient."},
    Key{"cutting.spindle_speed", Type::quantity, kind::spindle_speed, "", positive, "", "The speed at which the depth is reported besides the chart."},
    Key{"cutting.feed_rate", Type::quantity, kind::velocity, "", positive, "", "Feed rate. With `spindle_speed` it gives the feed per tooth, on which stability depends where `law` is not linear."},
    Key{"cutting.feed_per_tooth", Type::quantity, kind::length, "", positive, "", "In place of `feed_rate`; the same at every speed of the chart."},
    Key{"cutting.law", Type::choice, kind::number, "\"linear\"", any, "linear|power|fractional|oblique", "Force over chip thickness: linear; power (Kienzle, K h (h/1 mm)^-m); fractional (Bondarenko 2012), both linearised at the mean chip; or linear by the orthogonal-to-oblique transformation."},
    Key{"cutting.exponents", Type::quantities, kind::number, "", exponent_bounds, "", "m of the power law: one, or three for Kt, Kr, Ka."},
    Key{"cutting.chip_scale", Type::quantity, kind::length, "", positive, "", "h_s of the fractional law: the chip at which it bends."},
    Key{"cutting.stiffness_ratio", Type::quantity, kind::number, "", {0.0, 1.0, false, false, false, ""}, "", "r of the fractional law: stiffness at thick chips over that at thin ones."},
    Key{"cutting.shear_stress", Type::quantity, kind::stress, "", coefficient_bounds, "", "Of orthogonal cutting, for `oblique`; the oblique angle is the tool's helix."},
    Key{"cutting.friction_angle", Type::quantity, kind::angle, "", right_angle, "", "Of orthogonal cutting, on the rake face."},
    Key{"cutting.rake_angle", Type::quantity, kind::angle, "", tilt, "", "Normal rake of the tool; 0 if not given."},
    Key{"cutting.shear_angle", Type::quantity, kind::angle, "", right_angle, "", "Of orthogonal cutting; Merchant's 45 deg - (friction - rake)/2 if not given."},
    Key{"cutting.process_damping", Type::quantity, kind::stiffness, "0", not_negative, "", "C of the flank's force per width, C/v times the normal velocity, v the cutting speed; flat ends only."},
    Key{"cutting.process_damping_friction", Type::quantity, kind::number, "0.3", not_negative, "", "Tangential share of that force."},

    Key{"lobes.from", Type::quantity, kind::spindle_speed, "", positive, "", "Lowest speed.", required},
    Key{"lobes.to", Type::quantity, kind::spindle_speed, "", positive, "", "Highest speed.", required},
    Key{"lobes.count", Type::integer, kind::number, "400", {2, 1e5, false, false, false, ""}, "", "Number of speeds."},
    Key{"lobes.depth_limit", Type::quantity, kind::length, "", positive, "", "Deepest cut that is asked; `tool.length` if not given."},
    Key{"lobes.tolerance", Type::quantity, kind::number, "1e-4", {1e-9, 0.5, false, false, false, ""}, "", "Bound on the estimated relative error of the depth."},
    Key{"lobes.modes_up_to", Type::quantity, kind::frequency, "", positive, "", "Only modes up to this frequency; those above act by their static compliance alone, whose share is reported as static_share."},
    Key{"lobes.method", Type::choice, kind::number, "\"direct\"", any, methods, "What the chart is computed by; `docs/theory/lobes.md` says which when. All but `direct` need modes; `semi_` and `full_discretization` a cylinder without process damping, `zeroth_order` equal teeth besides, `multi_frequency` equal straight ones."},
    Key{"lobes.compare", Type::names, kind::number, "", any, methods, "Further charts of the same cut by these methods, `lobes/<name>_<method>.csv`, with the largest difference from the chart."},
    Key{"lobes.steps_per_period", Type::integer, kind::number, "", {3, 2000, false, false, false, "40 is customary, 200 better"}, "", "Steps a tooth period of semi- and full-discretization; 40 if not given."},
    Key{"lobes.harmonics", Type::integer, kind::number, "", {0, 500, false, false, false, "16 is usual"}, "", "Harmonics of the cut in `multi_frequency`, and in the error estimate of `zeroth_order`; 16 if not given."},
    Key{"lobes.map_depths", Type::integer, kind::number, "", {1, 2000, false, false, false, "200 draws a fine map"}, "", "Number of depths, up to the chart's largest, of a map of the largest Floquet multiplier's modulus: `lobes/<name>_map.csv`. By collocation, from poles."},
    Key{"lobes.noise_samples", Type::integer, kind::number, "", {2, 1e5, false, false, false, "100 tell a deviation to 7 %"}, "", "Draws of noisy FRFs: limiting depths at `cutting.spindle_speed` beside the first-order deviation."},
    Key{"lobes.seed", Type::integer, kind::number, "1", {0, 1e9, false, false, false, ""}, "", "Seed of these draws."},
    Key{"lobes.uncertainty.frequency", Type::quantity, kind::number, "0", uncertainty, "", "Of every natural frequency, at constant modal mass."},
    Key{"lobes.uncertainty.damping_ratio", Type::quantity, kind::number, "0", uncertainty, "", "Of every damping ratio."},
    Key{"lobes.uncertainty.receptance", Type::quantity, kind::number, "0", uncertainty, "", "Of every mode's height in the receptance (its modal mass), frequency and damping apart."},
    Key{"lobes.uncertainty.coefficients", Type::quantity, kind::number, "0", uncertainty, "", "Of each cutting coefficient."},
    Key{"lobes.uncertainty.confidence", Type::quantity, kind::number, "2", {0.0, 6.0, true, false, false, "2 stands for 97.7 %"}, "", "k: how many standard uncertainties the robust depth stays below the limit."},

    Key{"machine.min_spindle_speed", Type::quantity, kind::spindle_speed, "", positive, "", "Lowest spindle speed."},
    Key{"machine.max_spindle_speed", Type::quantity, kind::spindle_speed, "", positive, "", "Highest spindle speed."},
    Key{"machine.max_power", Type::quantity, kind::power, "", positive, "", "Power of the spindle's motor; against the mean of the static cutting force."},
    Key{"machine.max_torque", Type::quantity, kind::torque, "", positive, "", "Torque at the spindle, likewise."},
    Key{"machine.max_feed_rate", Type::quantity, kind::velocity, "", positive, "", "Highest feed rate: with the feed per tooth a bound on the speed."},
    Key{"machine.efficiency", Type::quantity, kind::number, "1", {0.0, 1.0, true, false, false, "0.8 to 0.95 is usual"}, "", "Share of the motor's power that reaches the cut."},

    Key{"path.points", Type::positions, kind::length, "", any, "", "Positions of the point that is cut, in the part's axes, in order. The patch is that of `cutting.at`."},
    Key{"path.from", Type::vector, kind::length, "", any, "", "First position of a straight path."},
    Key{"path.to", Type::vector, kind::length, "", any, "", "Last position."},
    Key{"path.positions", Type::integer, kind::number, "", {2, 200, false, false, false, "2 to 200 positions"}, "", "Number of positions, evenly spaced `from` … `to`; 11 if not given."},
    Key{"path.support", Type::choice, kind::number, "\"held\"", any, "held|follows", "`held`: the robot stays at its contacts. `follows`: they move with the cut and keep the distance that they have from `cutting.at`."},
};

constexpr Section joint_sections[] = {
    Section{"joints[]", "What a URDF does not know of a joint that turns.", ""},
};
constexpr Key joint_keys[] = {
    Key{"joints[].name", Type::text, kind::number, "", any, "", "Name of the joint in the URDF.", required},
    Key{"joints[].stiffness", Type::quantity, kind::torsional_stiffness, "", positive, "", "Of the joint's gearbox.", required},
    Key{"joints[].damping", Type::quantity, kind::torsional_damping, "0", not_negative, "", "Beside it."},
    Key{"joints[].motor_inertia", Type::quantity, kind::inertia, "0", not_negative, "", "Of the rotor about its shaft."},
    Key{"joints[].gear_ratio", Type::quantity, kind::number, "1", any, "", "Turns of the rotor for one of the joint."},
    Key{"joints[].servo_stiffness", Type::quantity, kind::torsional_stiffness, "\"inf\"", {0.0, infinity, false, false, true, "\"inf\" for a locked motor"}, "", "Position gain at the joint; `inf` for a locked motor."},
    Key{"joints[].servo_damping", Type::quantity, kind::torsional_damping, "0", not_negative, "", "Speed gain at the joint."},
};
constexpr Section expectation_sections[] = {
    Section{"expect[]", "One figure of summary.json: `value` with `tolerance` or `relative`, or a bound.", ""},
};
constexpr Key expectation_keys[] = {
    Key{"expect[].name", Type::text, kind::number, "", any, "", "What it is, for people.", required},
    Key{"expect[].quantity", Type::text, kind::number, "", any, "", "Path into summary.json, `coupling.modes[0].frequency_hz`.", required},
    Key{"expect[].value", Type::quantity, kind::number, "", any, "", "The expected number, in the unit of the summary."},
    Key{"expect[].same_as", Type::text, kind::number, "", any, "", "Path into summary.json of the number that it must equal, in place of `value`."},
    Key{"expect[].tolerance", Type::quantity, kind::number, "", not_negative, "", "Largest deviation, absolute."},
    Key{"expect[].relative", Type::quantity, kind::number, "", not_negative, "", "Largest deviation relative to the value."},
    Key{"expect[].at_least", Type::quantity, kind::number, "", any, "", "Least value."},
    Key{"expect[].at_most", Type::quantity, kind::number, "", any, "", "Largest value."},
    Key{"expect[].origin", Type::text, kind::number, "", any, "", "Where the figure comes from: published (where), analytic, another program (which), recorded.", required},
};
// clang-format on

}  // namespace

const Schema& case_schema() {
  static constexpr Schema schema{case_sections, case_keys};
  return schema;
}

const Schema& joints_schema() {
  static constexpr Schema schema{joint_sections, joint_keys};
  return schema;
}

const Schema& expectation_schema() {
  static constexpr Schema schema{expectation_sections, expectation_keys};
  return schema;
}

}  // namespace thinwall::app
