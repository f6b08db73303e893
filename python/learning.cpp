// Bindings of learning: cutting coefficients from measured forces.

#include <algorithm>
#include <numbers>

#include "core/error.hpp"
#include "learning/edge_force_fit.hpp"
#include "learning/mean_force_fit.hpp"
#include "python/bindings.hpp"

namespace thinwall::python {

namespace {

using Range = std::pair<double, double>;

/// Value k of a list, which stands for all where there is one.
template <typename Value>
const Value& at(const OneOrMore<Value>& list, std::size_t k, std::size_t count, const char* name) {
  if (list.values.size() == 1) return list.values.front();
  if (list.values.size() == count) return list.values[k];
  throw core::InputError(std::string(name) + " has " + std::to_string(list.values.size()) +
                         " values, must have 1 or one for each of the " + std::to_string(count) + " forces");
}

/// A test for each row of the forces.
std::vector<learning::MeanForceTest> tests_of(const OneOrMore<double>& feed, const OneOrMore<double>& depth,
                                              const Eigen::Matrix<double, Eigen::Dynamic, 3>& force,
                                              const std::optional<OneOrMore<Range>>& given) {
  const OneOrMore<Range> arc = given.value_or(OneOrMore<Range>{{Range(0.0, std::numbers::pi)}});
  const auto count = static_cast<std::size_t>(force.rows());
  std::vector<learning::MeanForceTest> tests;
  for (std::size_t k = 0; k < count; ++k) {
    const auto [entry, exit] = at(arc, k, count, "arc_rad");
    tests.push_back({{entry, exit},
                     at(depth, k, count, "depth_m"),
                     at(feed, k, count, "feed_per_tooth_m"),
                     force.row(static_cast<Eigen::Index>(k)).transpose()});
  }
  return tests;
}

py::tuple tuple_of(const learning::FittedCoefficient& c) {
  return py::make_tuple(c.value, c.half_interval);
}

/// The entries that both fits have: each coefficient as value and half interval.
template <typename Fit>
py::dict dict_of_fit(const Fit& fit) {
  py::dict result;
  result["K_t"] = tuple_of(fit.K_t);
  result["K_r"] = tuple_of(fit.K_r);
  result["K_a"] = tuple_of(fit.K_a);
  result["K_te"] = tuple_of(fit.K_te);
  result["K_re"] = tuple_of(fit.K_re);
  result["K_ae"] = tuple_of(fit.K_ae);
  result["r_squared"] = fit.r_squared;
  result["residual_n"] = fit.residual_n;
  result["condition"] = fit.condition;
  return result;
}

py::dict mean_force_coefficients(int teeth, const OneOrMore<double>& feed_per_tooth_m, const OneOrMore<double>& depth_m,
                                 const Eigen::Matrix<double, Eigen::Dynamic, 3>& force_n,
                                 const std::optional<OneOrMore<Range>>& arc_rad) {
  return dict_of_fit(learning::fit_mean_forces(teeth, tests_of(feed_per_tooth_m, depth_m, force_n, arc_rad)));
}

py::dict edge_force_coefficients(int teeth, double diameter_m, const OneOrMore<double>& feed_per_tooth_m,
                                 const OneOrMore<double>& depth_m, const Eigen::VectorXd& angle_rad,
                                 const Eigen::Matrix<double, Eigen::Dynamic, 3>& force_n,
                                 const std::optional<OneOrMore<Range>>& arc_rad, double helix_rad) {
  milling::Cutter cutter;
  cutter.teeth = teeth;
  cutter.diameter_m = diameter_m;
  if (helix_rad != 0.0) cutter.helices_rad.assign(static_cast<std::size_t>(std::max(teeth, 0)), helix_rad);
  const auto lines = tests_of(feed_per_tooth_m, depth_m, force_n, arc_rad);
  learning::EdgeForceFit fit;
  {
    const LongCall call;
    fit = learning::fit_edge_forces(cutter, learning::records_of(lines, angle_rad));
  }
  py::dict result = dict_of_fit(fit);
  py::list runout;
  for (const learning::FittedCoefficient& offset : fit.runout_m) runout.append(tuple_of(offset));
  result["runout_m"] = runout;
  result["converged"] = fit.converged;
  return result;
}

}  // namespace

void bind_learning(py::module_& module) {
  module.def("mean_force_coefficients", mean_force_coefficients, "teeth"_a, "feed_per_tooth_m"_a, "depth_m"_a,
             "force_n"_a, py::kw_only(), "arc_rad"_a = py::none(),
             "Cutting coefficients from mean forces over a turn: a dict of K_t, K_r, K_a (N/m^2), K_te, K_re, K_ae\n"
             "(N/m of depth), each the value and half its interval of 95 %, r_squared, residual_n and condition.\n"
             "force_n has a row a cut: feed, normal, axis, on the tool. Feed, depth and the arc (entry and exit, from\n"
             "the normal in the direction of rotation; a slot if not given) are one value or one for each cut.");
  module.def(
      "edge_force_coefficients", edge_force_coefficients, "teeth"_a, "diameter_m"_a, "feed_per_tooth_m"_a, "depth_m"_a,
      "angle_rad"_a, "force_n"_a, py::kw_only(), "arc_rad"_a = py::none(), "helix_rad"_a = 0.0,
      "Cutting coefficients and runout from forces over the angle of the first tooth's tip: the dict of\n"
      "mean_force_coefficients() with edge coefficients in N/m of edge, and runout_m, the radial offset of each\n"
      "tooth as value and half interval, and converged. A row of force_n is an angle; neighbouring rows of one\n"
      "feed, depth and arc are one cut.");
}

}  // namespace thinwall::python
