#pragma once
// The tool of path_march.hpp on a structure of modes, with a contact of its support that may open.

#include <Eigen/Core>
#include <algorithm>

#include "milling/simulation/march_rule.hpp"
#include "milling/simulation/march_step.hpp"
#include "milling/simulation/one_sided_contact.hpp"
#include "milling/simulation/path_march.hpp"

namespace thinwall::milling {

/// A tool on modes, by march_step.hpp: N = 4 forces with a contact that may open, else 3.
template <int N>
class ModalTool {
 public:
  static constexpr bool has_contact = N == 4;

  /// Keeps a reference to the cut.
  explicit ModalTool(const PathCut& cut)
      : c_(cut),
        rule_(march_rule<N>(cut.structure, cut.ports, 2.0 * cut.node_rad / cut.rad_per_s, 2.0 * cut.node_rad)),
        x_(cut.start) {}

  /// Sets the contact at the node with which the simulation begins, whose displacement is known.
  void begin(MarchNode& node) const {
    if constexpr (has_contact) {
      node.opening_m = c_.structure.pair_motion.dot(x_);
      press(node);
    }
  }

  /// Displacements and forces at the middle and the end of a step; `load(c, node)` sets the force of a node from its
  /// displacement and slope. Returns the number of nodes that did not settle.
  template <class LoadAt>
  int over_step(MarchStep& step, const LoadAt& load) {
    const int unsettled = settle_forces<N>(rule_, x_, true, step, [&](std::size_t c, MarchNode& node) {
      load(c, node);
      if constexpr (has_contact) press(node);
    });
    advance_state<N>(rule_, step, x_);
    return unsettled;
  }

  /// Modes are scaled to their displacement at the cut. The largest of numbers some of which are NaN is any of them.
  [[nodiscard]] bool within(double radius_m) const { return x_.allFinite() && x_.cwiseAbs().maxCoeff() < radius_m; }

 private:
  void press(MarchNode& node) const {
    const double force = force_between(*c_.contact, node.opening_m, node.opening_slope * c_.rad_per_s);
    node.separating_n = std::max(0.0, -force);
    node.pressing_n = std::max(0.0, force);
    node.gap_m = node.opening_m - c_.contact->preload_n / c_.contact->stiffness_n_per_m;
  }

  const PathCut& c_;
  MarchRule<N> rule_;
  Eigen::VectorXd x_;
};

/// body(tool) with the tool of a cut, with a contact that may open where the cut has one.
template <class Body>
auto with_modal_tool(const PathCut& cut, const Body& body) {
  return cut.contact ? body(ModalTool<4>(cut)) : body(ModalTool<3>(cut));
}

}  // namespace thinwall::milling
