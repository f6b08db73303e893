#pragma once
// The tables of a case file, with their meanings.

#include "case/schema/schema.hpp"

namespace thinwall::cases {

// A built-in array: clang stops counting the arguments from which a std::array would find its size at 256.
inline constexpr Section case_sections[] = {
    Section{"", "The case as a whole.", ""},
    Section{"part",
            "A box with one corner at the origin or a prism, as it stands or bent; the surface or the mesh in a file; "
            "or matrices.",
            ""},
    Section{"part.axes", "Which axis each extent runs along.", "part.thickness"},
    Section{"part.material", "Isotropic linear elasticity.", "part.thickness|part.file"},
    Section{"part.mesh", "Tetrahedra, elements of any order.", "part.thickness|part.file"},
    Section{"part.holes[]", "Holes through a prism.", ""},
    Section{"part.zones[]", "Regions of a prism with a height of their own: pockets, ribs. Later ones win.", ""},
    Section{"part.repair", "What may be mended of a surface from a file (docs/surfaces.md).", ""},
    Section{"part.materials[]",
            "Other materials than part.material, of sets of elements or of what lies in a selection.", ""},
    Section{"part.clamps[]", "Elastic clamps: a bed of springs on faces (docs/theory/elements.md).", ""},
    Section{"part.masses[]", "Rigid bodies that ride on the part.", ""},
    Section{"part.springs[]", "Springs from a point to ground.", ""},
    Section{"part.matrices", "Stiffness and mass from another program (docs/matrices.md), in place of a shape.", ""},
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
    Section{"modes", "Modes of the whole part. Give `count` or `up_to`; 10 modes if neither.",
            "part.thickness|part.file|part.matrices.stiffness"},
    Section{"reduction", "The reduced model of the part. Give `modes` or `up_to`; 30 modes if neither.",
            "part.thickness|part.file|part.matrices.stiffness"},
    Section{"damping", "Damping of the part.", "part.thickness|part.file|part.matrices.stiffness"},
    Section{"damping.from_frf", "Damping ratios from a measured driving point, by a fit of each peak.", ""},
    Section{"robot", "The robot's tip.", ""},
    Section{"robot.modes[]", "Modes of the tip.", ""},
    Section{"robot.measured[]",
            "FRFs of a measured robot: one along `direction`, or several between the tip's x, "
            "y, z.",
            ""},
    Section{"robot.sensors[]",
            "Accelerometers on the measured robot, likewise; or, of tables of modes, whatever rigid mass sat there "
            "when they were tapped, as a tool that was left in.",
            ""},
    Section{"robot.links[]",
            "An arm's links from the base to the tip, each with the joint that carries it. At angle 0 a link's frame "
            "is its joint's.",
            ""},
    Section{"robot.counterbalances[]", "Springs or gas cylinders between two points of the arm.", ""},
    Section{"robot.elements[]",
            "What follows each other from base to tip: joints, beams, bodies, rigid offsets; each in the frame that "
            "the one before leaves.",
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
            "The ball by which the robot touches a flat surface (docs/theory/coupling.md, Eq. 18-20).", ""},
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
        "modes and measured; without `[[tool.swap.measured]]` from the modes of the robot that carries it, whose "
        "tables "
        "have both points.",
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
    Section{"observed[]", "Cuts that were made: each chart tells which of them it predicts rightly. Needs [lobes].",
            ""},
    Section{"calibration",
            "The chart learns from `[[observed]]`: `[lobes.uncertainty]` is what is known beforehand "
            "(docs/theory/calibration.md). Needs poles.",
            ""},
    Section{"simulation",
            "Operating points in the time domain (docs/theory/time-domain.md): how large the vibration becomes, where "
            "teeth "
            "leave the cut, the wall. Needs a feed, and structures that are known by modes.",
            ""},
    Section{"simulation.map",
            "Peak-to-peak vibration over speed and depth, by circular paths, with the lobe drawn on it. Needs [lobes].",
            ""},
    Section{"path", "Where the cut goes along the part: the chart at each position. Give `points`, or `from` and `to`.",
            ""},
};

}  // namespace thinwall::cases
