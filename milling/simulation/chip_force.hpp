#pragma once
// The force of a chip on an edge, in the forms that a simulation is compiled for.

#include <variant>
#include <vector>

#include "milling/cut/force_law.hpp"
#include "milling/cut/process.hpp"

namespace thinwall::milling {

/// Per width of cut, N/m, as CuttingCoefficients names them: tangential, along the normal, along the meridian.
struct EdgeForce {
  double tangential = 0.0, normal = 0.0, axial = 0.0;
};

/// The chip and what else the force of a point of an edge depends on.
struct Chip {
  double thickness_m = 0.0;
  double slope = 0.0;       ///< nᵀ dq/dφ, m/rad, of process damping
  double edge_share = 1.0;  ///< length of edge over width of cut
  int tooth = 0;
};

/// The linear law without edge forces and without loss of contact: what a small vibration about a steady chip feels.
/// Chips may be negative.
struct LinearVariation {
  static constexpr bool loses_contact = false;
  std::vector<CuttingCoefficients> of_tooth;
  CuttingCoefficients damping;  ///< per_slope()

  /// The force of a chip.
  [[nodiscard]] EdgeForce operator()(const Chip& chip) const {
    const CuttingCoefficients& k = of_tooth[static_cast<std::size_t>(chip.tooth)];
    return {k.K_t * chip.thickness_m + damping.K_t * chip.slope, k.K_r * chip.thickness_m + damping.K_r * chip.slope,
            k.K_a * chip.thickness_m};
  }
};

/// The linear law with edge forces, as long as there is a chip.
struct LinearContact {
  static constexpr bool loses_contact = true;
  std::vector<CuttingCoefficients> of_tooth;
  CuttingCoefficients damping;

  /// The force of a chip above zero.
  [[nodiscard]] EdgeForce operator()(const Chip& chip) const {
    const CuttingCoefficients& k = of_tooth[static_cast<std::size_t>(chip.tooth)];
    return {k.K_t * chip.thickness_m + k.K_te * chip.edge_share + damping.K_t * chip.slope,
            k.K_r * chip.thickness_m + k.K_re * chip.edge_share + damping.K_r * chip.slope,
            k.K_a * chip.thickness_m + k.K_ae * chip.edge_share};
  }
};

/// Any other law, as long as there is a chip.
template <class Law>
struct NonlinearContact {
  static constexpr bool loses_contact = true;
  Law law;
  CuttingCoefficients damping;

  /// The force of a chip above zero.
  [[nodiscard]] EdgeForce operator()(const Chip& chip) const {
    const Eigen::Vector3d f = force_per_width(law, chip.thickness_m);
    return {f[0] + damping.K_t * chip.slope, f[1] + damping.K_r * chip.slope, f[2]};
  }
};

/// The coefficients of each tooth.
[[nodiscard]] inline std::vector<CuttingCoefficients> coefficients_of_teeth(const MillingProcess& process) {
  std::vector<CuttingCoefficients> of_tooth;
  of_tooth.reserve(static_cast<std::size_t>(process.cutter.teeth));
  for (int j = 0; j < process.cutter.teeth; ++j) of_tooth.push_back(coefficients(process, j));
  return of_tooth;
}

/// body(chip_force) with the form that a law needs: the linear law has the coefficients of `process`.
template <class Body>
auto with_chip_force(const MillingProcess& process, const ForceLaw& law, const Body& body) {
  const CuttingCoefficients damping = per_slope(process.damping, process.cutter);
  if (const auto* power = std::get_if<PowerLaw>(&law)) return body(NonlinearContact<PowerLaw>{*power, damping});
  if (const auto* bent = std::get_if<FractionalLaw>(&law)) return body(NonlinearContact<FractionalLaw>{*bent, damping});
  return body(LinearContact{coefficients_of_teeth(process), damping});
}

}  // namespace thinwall::milling
