#include "milling/direct/chatter_frequency.hpp"

#include <cmath>
#include <numbers>

#include "core/gauss_rule.hpp"
#include "core/interrupt.hpp"

namespace thinwall::milling {

double chatter_frequency_hz(const ContactGrid& grid, double period_s, const ReceptanceAt& receptance,
                            double highest_rad_s, double theta_rad, const Eigen::VectorXcd& c) {
  using std::complex;
  const double seconds_per_rad = period_s / grid.period_rad;
  const double spacing = 2.0 * std::numbers::pi / period_s;
  const int reach = 1 + static_cast<int>(std::ceil(highest_rad_s / spacing));
  Eigen::Matrix3Xcd force = Eigen::Matrix3Xcd::Zero(3, grid.node_rad.size());
  for (std::size_t k = 0; k < grid.contacts.size(); ++k)
    force.col(grid.contacts[k].node) += grid.contacts[k].force * c(static_cast<Eigen::Index>(k));
  for (const CutElement& e : grid.elements) {
    const Eigen::VectorXd weight = core::gauss_legendre(e.nodes).weight * (e.to_rad - e.from_rad);
    force.middleCols(e.first_node, e.nodes) *= weight.asDiagonal();
  }
  double largest = -1.0;
  double chatter = 0.0;
  const auto turn_of = [&](double omega) -> Eigen::VectorXcd {
    return (complex<double>(0.0, -omega * seconds_per_rad) * grid.node_rad).array().exp();
  };
  const Eigen::VectorXcd step = turn_of(spacing);
  Eigen::VectorXcd turn = turn_of(theta_rad / period_s - reach * spacing);
  for (int k = -reach; k <= reach; ++k, turn = turn.cwiseProduct(step)) {
    core::check_interrupt();
    const double omega = theta_rad / period_s + k * spacing;
    const double motion = (receptance(omega) * (force * turn)).norm();
    if (motion <= largest) continue;
    largest = motion;
    chatter = omega;
  }
  return std::abs(chatter) / (2.0 * std::numbers::pi);
}

}  // namespace thinwall::milling
