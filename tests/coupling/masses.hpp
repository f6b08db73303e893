#pragma once
// Masses on springs to the ground: components small enough to be worked by hand.

#include <complex>
#include <string>

#include "dynamics/conversion.hpp"

namespace thinwall::coupling::testing {

struct Mass {
  double m, c, k;
  /// k + iωc − ω²m
  [[nodiscard]] std::complex<double> stiffness(double w) const { return {k - w * w * m, w * c}; }
};

inline dynamics::SpatialModel model(const Mass& mass, const std::string& point,
                                    dynamics::DofKind kind = dynamics::DofKind::translation) {
  const auto scalar = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  return {scalar(mass.m), scalar(mass.c), scalar(mass.k), {}, {{point, Eigen::Vector3d::UnitX(), kind}}};
}

inline dynamics::ResponseModel response(const Mass& mass, const std::string& point,
                                        const dynamics::FrequencyAxis& axis) {
  return dynamics::to_response(dynamics::to_modal(model(mass, point)), axis);
}

/// The masses along x, y, z of one point, each on its own.
inline dynamics::SpatialModel model(const std::vector<Mass>& masses, const std::string& point) {
  const auto n = static_cast<Eigen::Index>(masses.size());
  dynamics::SpatialModel all{
      Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), {}, {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Mass& mass = masses[static_cast<std::size_t>(i)];
    all.M(i, i) = mass.m;
    all.C(i, i) = mass.c;
    all.K(i, i) = mass.k;
    all.dofs.push_back({point, Eigen::Vector3d::Unit(i), dynamics::DofKind::translation});
  }
  return all;
}

}  // namespace thinwall::coupling::testing
