#pragma once
// A structure and a cut made ready to be marched from period to period, with teeth on circles.

#include <Eigen/Core>
#include <vector>

#include "milling/simulation/march_grid.hpp"
#include "milling/simulation/march_rule.hpp"
#include "milling/structure/contact_state.hpp"

namespace thinwall::milling {

/// The structure between two stretches of the cut, where no tooth cuts: at once, or in steps that can be looked at.
struct Flight {
  FreeFlight whole;
  FreeFlight half_step;
  int steps = 0;
  double from_rad = 0.0;  ///< rotation since the period began
  double step_rad = 0.0;
};

/// All that does not change from one period to the next. Teeth move on circles that the vibration shifts and that the
/// feed moves on by f_j = v_f τ_j from one tooth to the next; angles of entry and exit are fixed.
struct CircularCut {
  MarchGrid grid;
  ContactState structure;
  Eigen::Matrix3d residual = Eigen::Matrix3d::Zero();  ///< R in tool axes, m/N
  double rad_per_s = 0.0;                              ///< Ω
  StartMap start;
  std::vector<MarchRule<3>> rules;  ///< of each stretch
  std::vector<Flight> flights;      ///< up to each stretch from the one before, and from the last to the period's end

  /// Duration of a period, s.
  [[nodiscard]] double period_s() const { return grid.period_rad / rad_per_s; }
};

/// `structure` in part axes; speed, depth and feed are positive. Throws InputError for a bad process or option, or a
/// structure that does not move in the plane of the cut. Cost O(nodes teeth discs + stretches states²).
[[nodiscard]] CircularCut circular_cut(const RelativeStructure& structure, const MillingProcess& process,
                                       double spindle_speed_rpm, double depth_m, double feed_per_tooth_m,
                                       const StepOptions& options);

/// The state that a period hands on to the next.
struct CutState {
  Eigen::VectorXd modes;             ///< as in ContactState
  std::vector<double> surface_m;     ///< left by each point of MarchGrid::points, along its normal, in the moving frame
  std::vector<unsigned char> fresh;  ///< 1 where that point cut it, 0 where it is that of an earlier tooth
};

/// The state of a structure at rest under a constant force on the tool, tool axes, N: x = −Λ⁻¹ B f.
[[nodiscard]] Eigen::VectorXd at_rest(const ContactState& structure, const Eigen::Vector3d& force_n);

/// A structure at rest under that force, and the surfaces that a tool in this place has left.
[[nodiscard]] CutState at_rest(const CircularCut& cut, const Eigen::Vector3d& force_n = Eigen::Vector3d::Zero());

}  // namespace thinwall::milling
