#pragma once
// The two tools of the swaps, as beams and as a case writes them.

#include <string>

#include "dynamics/spatial_model.hpp"
#include "fem/beam.hpp"
#include "tests/verification/tool_swap/machine.hpp"

namespace thinwall::tests::swapped_tools {

/// The distance from the tip to the second point, m.
constexpr double S = 0.02;

/// Steel of 16 mm, 90 mm out, with a point S above its tip; the elements are those of the case's own beams, so that
/// only the swap is between them.
inline dynamics::SpatialModel reference() {
  namespace machine = coupling::testing;
  return fem::tool_beam({{S, machine::steel(0.016), 8}, {0.09 - S, machine::steel(0.016), 8}}, {"1", "1a", "root"},
                        Eigen::Vector3d::UnitZ());
}

/// Carbide of 12 mm, 65 mm out.
inline dynamics::SpatialModel target() {
  return fem::tool_beam({{0.065, coupling::testing::carbide(0.012), 8}}, {"1", "root"}, Eigen::Vector3d::UnitZ());
}

/// The first tool as a table of a case.
inline const std::string reference_table = R"([[tool.swap.reference]]
length = "90 mm"
outer_diameter = "16 mm"
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
density = "7850 kg/m^3"
)";

/// The keys of the second one.
inline const std::string carbide = R"(length = "65 mm"
outer_diameter = "12 mm"
youngs_modulus = "580 GPa"
density = "14400 kg/m^3"
)";

}  // namespace thinwall::tests::swapped_tools
