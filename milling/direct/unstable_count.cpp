#include "milling/direct/unstable_count.hpp"

#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"

namespace thinwall::milling {

namespace {

using std::complex;

/// ln det(I + w Z); its imaginary part up to turns.
complex<double> log_det(const GainOnCircle& gain, double depth_m, double theta_rad) {
  Eigen::MatrixXcd loop = depth_m * gain.Z(theta_rad);
  loop.diagonal().array() += 1.0;
  const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(loop);
  complex<double> sum = std::log(complex<double>(static_cast<double>(lu.permutationP().determinant())));
  for (Eigen::Index i = 0; i < loop.rows(); ++i) sum += std::log(lu.matrixLU()(i, i));
  if (!std::isfinite(sum.real()) || !std::isfinite(sum.imag()))
    throw core::NumericalError("stability: det(I + w Z) is zero or not finite; check the structure at the cut");
  return sum;
}

struct Place {
  double theta_rad;
  complex<double> log_det;
};

double turn_between(const GainOnCircle& gain, double depth_m, const Place& a, const Place& b, int halvings) {
  const double growth = b.log_det.real() - a.log_det.real();
  const double turn = std::remainder(b.log_det.imag() - a.log_det.imag(), 2.0 * std::numbers::pi);
  if (halvings == 0 || std::hypot(growth, turn) < 0.7) return turn;
  const double middle = 0.5 * (a.theta_rad + b.theta_rad);
  const Place m{middle, log_det(gain, depth_m, middle)};
  return turn_between(gain, depth_m, a, m, halvings - 1) + turn_between(gain, depth_m, m, b, halvings - 1);
}

}  // namespace

int unstable_count(const GainOnCircle& gain, double depth_m) {
  constexpr int most_halvings = 14;
  double turn = 0.0;
  Place last{gain.stops.front(), log_det(gain, depth_m, gain.stops.front())};
  for (std::size_t i = 1; i < gain.stops.size(); ++i) {
    const Place next{gain.stops[i], log_det(gain, depth_m, gain.stops[i])};
    turn += turn_between(gain, depth_m, last, next, most_halvings);
    last = next;
  }
  return -static_cast<int>(std::lround(turn / std::numbers::pi));
}

GainOnCircle remembering(GainOnCircle gain) {
  const auto known = std::make_shared<std::map<double, Eigen::MatrixXcd>>();
  gain.Z = [known, value = std::move(gain.Z)](double theta) {
    const auto found = known->find(theta);
    return found != known->end() ? found->second : known->emplace(theta, value(theta)).first->second;
  };
  return gain;
}

}  // namespace thinwall::milling
