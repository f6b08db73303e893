#include "dynamics/unit_system.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"

namespace thinwall::dynamics {

namespace {

double unit_of(const std::string& text, const char* what, const core::Dimension& wanted, const char* examples) {
  if (text.empty()) {
    throw core::InputError(std::string("imported matrices do not tell their unit of ") + what + ": state it, " +
                           examples);
  }
  const core::Quantity unit = core::parse_unit(text);
  if (unit.dimension == wanted) return unit.value;
  throw core::InputError("the unit of " + std::string(what) + " of imported matrices is \"" + text + "\", a " +
                         core::dimension_name(unit.dimension) + ": state one of " + what + ", " + examples);
}

}  // namespace

UnitSystem unit_system(const std::string& length, const std::string& mass) {
  return {unit_of(length, "length", {.length = 1}, "\"mm\" or \"m\""),
          unit_of(mass, "mass", {.mass = 1}, "\"t\" beside mm, N and s, \"kg\" beside m, N and s")};
}

SparseModel in_si(SparseModel model, const UnitSystem& units) {
  const double l = units.metres_per_unit, m = units.kilograms_per_unit;
  if (!(l > 0.0 && m > 0.0 && std::isfinite(l) && std::isfinite(m)))
    throw core::InputError("the units of imported matrices must be positive: " + core::number_text(l) + " m and " +
                           core::number_text(m) + " kg a unit");
  const double amplitude = l * std::sqrt(m);
  const auto factor = [&](Eigen::Index i, Eigen::Index j) {
    const int a = model.dofs[static_cast<std::size_t>(i)].component,
              b = model.dofs[static_cast<std::size_t>(j)].component;
    const auto size = [&](int component) { return component == 0 ? amplitude : component > 3 ? 1.0 : l; };
    if (a == 0 && b == 0) return 1.0;
    const int lengths = (a > 3 ? 1 : 0) + (b > 3 ? 1 : 0);
    if (a > 0 && b > 0) return lengths == 0 ? m : lengths == 1 ? m * l : m * l * l;
    return m * l * l / (size(a) * size(b));
  };
  for (Eigen::SparseMatrix<double>* A : {&model.K, &model.M, &model.C}) {
    for (Eigen::Index column = 0; column < A->outerSize(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(*A, column); entry; ++entry)
        entry.valueRef() *= factor(entry.row(), column);
  }
  for (auto& [node, position] : model.positions) position *= l;
  return model;
}

}  // namespace thinwall::dynamics
