#pragma once
// Which keys and tables of a case file belong to which alternative.

#include "case/schema/schema.hpp"

namespace thinwall::cases {

namespace belongings {

inline constexpr bool needed = true;
inline constexpr auto modelled = "box|prism|surface|mesh";
inline constexpr auto extruded = "box|prism";
inline constexpr auto joints = "rotation|translation";
inline constexpr auto balls = "hertz|caster";

}  // namespace belongings

// A built-in array, as that of the keys.
inline constexpr Belonging case_belongings[] = {
    {"part.length", "part.shape", "box", belongings::needed},
    {"part.height", "part.shape", "box", belongings::needed},
    {"part.axes", "part.shape", "box"},
    {"part.thickness", "part.shape", belongings::extruded, belongings::needed},
    {"part.outline", "part.shape", "prism", belongings::needed},
    {"part.holes[]", "part.shape", "prism"},
    {"part.zones[]", "part.shape", "prism"},
    {"part.bend", "part.shape", belongings::extruded},
    {"part.file", "part.shape", "surface|mesh", belongings::needed},
    {"part.unit", "part.shape", "surface|mesh|matrices"},
    {"part.mass_unit", "part.shape", "mesh|matrices"},
    {"part.matrices", "part.shape", "matrices", belongings::needed},
    {"part.origin", "part.shape", "surface|mesh|matrices"},
    {"part.repair", "part.shape", "surface"},
    {"part.material", "part.shape", belongings::modelled},
    {"part.materials[]", "part.shape", belongings::modelled},
    {"part.mesh", "part.shape", belongings::modelled},
    {"part.supports[]", "part.shape", belongings::modelled},
    {"part.clamps[]", "part.shape", belongings::modelled},
    {"part.masses[]", "part.shape", belongings::modelled},
    {"part.springs[]", "part.shape", belongings::modelled},

    {"damping.ratio", "damping.model", "modal"},
    {"damping.ratios", "damping.model", "modal"},
    {"damping.from_frf", "damping.model", "modal"},
    {"damping.alpha", "damping.model", "rayleigh"},
    {"damping.beta", "damping.model", "rayleigh"},
    {"damping.loss_factor", "damping.model", "structural"},

    {"robot.direction", "robot.model", "one_mode|measured"},
    {"robot.frequency", "robot.model", "one_mode"},
    {"robot.damping_ratio", "robot.model", "one_mode"},
    {"robot.stiffness", "robot.model", "one_mode", belongings::needed},
    {"robot.mass", "robot.model", "one_mode"},
    {"robot.damping", "robot.model", "one_mode"},
    {"robot.modes[]", "robot.model", "modes", belongings::needed},
    {"robot.measured[]", "robot.model", "measured", belongings::needed},
    {"robot.sensors[]", "robot.model", "measured|modal_table"},
    {"robot.table", "robot.model", "modal_table", belongings::needed},
    {"robot.postures", "robot.model", "modal_table"},
    {"robot.over", "robot.model", "modal_table"},
    {"robot.at", "robot.model", "modal_table"},
    {"robot.joint_columns", "robot.model", "modal_table"},
    {"robot.table_point", "robot.model", "modal_table"},
    {"robot.left_unit", "robot.model", "modal_table"},
    {"robot.right_unit", "robot.model", "modal_table"},
    {"robot.cross_terms", "robot.model", "modal_table"},
    {"robot.base", "robot.model", "modal_table|flexible_joints|virtual_joints"},
    {"robot.gravity", "robot.model", "modal_table|flexible_joints"},
    {"robot.links[]", "robot.model", "modal_table|flexible_joints"},
    {"robot.urdf", "robot.model", "modal_table|flexible_joints"},
    {"robot.urdf_base", "robot.model", "modal_table|flexible_joints"},
    {"robot.urdf_tip", "robot.model", "modal_table|flexible_joints"},
    {"robot.joints", "robot.model", "modal_table|flexible_joints"},
    {"robot.counterbalances[]", "robot.model", "modal_table|flexible_joints"},
    {"robot.tip", "robot.model", "modal_table|flexible_joints"},
    {"robot.posture", "robot.model", "modal_table|flexible_joints"},
    {"robot.workspace", "robot.model", "flexible_joints"},
    {"robot.elements[]", "robot.model", "virtual_joints", belongings::needed},

    {"robot.elements[].axis", "robot.elements[].kind", belongings::joints},
    {"robot.elements[].angle", "robot.elements[].kind", "rotation"},
    {"robot.elements[].stiffness", "robot.elements[].kind", "rotation"},
    {"robot.elements[].damping", "robot.elements[].kind", "rotation"},
    {"robot.elements[].distance", "robot.elements[].kind", "translation"},
    {"robot.elements[].linear_stiffness", "robot.elements[].kind", "translation"},
    {"robot.elements[].linear_damping", "robot.elements[].kind", "translation"},
    {"robot.elements[].length", "robot.elements[].kind", "beam", belongings::needed},
    {"robot.elements[].outer_diameter", "robot.elements[].kind", "beam", belongings::needed},
    {"robot.elements[].inner_diameter", "robot.elements[].kind", "beam"},
    {"robot.elements[].youngs_modulus", "robot.elements[].kind", "beam"},
    {"robot.elements[].poisson_ratio", "robot.elements[].kind", "beam"},
    {"robot.elements[].density", "robot.elements[].kind", "beam"},
    {"robot.elements[].position", "robot.elements[].kind", "offset"},
    {"robot.elements[].rotation", "robot.elements[].kind", "offset"},
    {"robot.elements[].mass", "robot.elements[].kind", "body", belongings::needed},
    {"robot.elements[].centre", "robot.elements[].kind", "body"},
    {"robot.elements[].inertia", "robot.elements[].kind", "body"},

    {"contacts[].stiffness", "contacts[].model", "springs"},
    {"contacts[].damping", "contacts[].model", "springs|hertz|caster"},
    {"contacts[].measured[]", "contacts[].model", "springs"},
    {"contacts[].damping_model", "contacts[].model", "springs"},
    {"contacts[].noise", "contacts[].model", "springs"},
    {"contacts[].preload", "contacts[].model", "table|hertz|caster"},
    {"contacts[].table", "contacts[].model", "table", belongings::needed},
    {"contacts[].ball", "contacts[].model", belongings::balls, belongings::needed},
    {"contacts[].surface", "contacts[].model", belongings::balls},
    {"contacts[].ball.supports", "contacts[].model", "caster", belongings::needed},
    {"contacts[].ball.support_radius", "contacts[].model", "caster", belongings::needed},
    {"contacts[].ball.support_angle", "contacts[].model", "caster", belongings::needed},

    {"coupling.threshold", "coupling.regularisation", "truncated|tikhonov"},

    {"updating[].targets[].frequency", "updating[].targets[].quantity", "reduction_at"},

    {"tool.corner_radius", "tool.end", "bull_nose|general"},
    {"tool.corner_radial", "tool.end", "general"},
    {"tool.corner_axial", "tool.end", "general"},
    {"tool.tip_angle", "tool.end", "general"},
    {"tool.taper", "tool.end", "general"},

    {"cutting.material", "cutting.law", "linear|power"},
    {"cutting.Kt", "cutting.law", "linear|power|fractional", belongings::needed, "cutting.material"},
    {"cutting.exponents", "cutting.law", "power", belongings::needed, "cutting.material"},
    {"cutting.chip_scale", "cutting.law", "fractional", belongings::needed},
    {"cutting.stiffness_ratio", "cutting.law", "fractional", belongings::needed},
    {"cutting.shear_stress", "cutting.law", "oblique", belongings::needed},
    {"cutting.friction_angle", "cutting.law", "oblique", belongings::needed},
    {"cutting.rake_angle", "cutting.law", "oblique"},
    {"cutting.shear_angle", "cutting.law", "oblique"},

    {"lobes.uncertainty", "lobes.method", "direct"},

    {"simulation.steps", "simulation.paths", "circular"},
    {"simulation.steps_a_turn", "simulation.paths", "exact|region"},
    {"simulation.trace", "simulation.start", "steady|loaded"},
    {"simulation.chords", "simulation.paths", "region"},
    {"simulation.support", "simulation.paths", "exact|region"},
};

inline constexpr Telling case_tellings[] = {
    {"part.shape", "matrices", "part.matrices"},
    {"part.shape", "mesh", "part.file", ".msh|.inp|.vtu"},
    {"part.shape", "surface", "part.file"},
    {"part.shape", "box", "part.length|part.height|part.thickness|part.outline"},
};

}  // namespace thinwall::cases
