#include "milling/direct/harmonic_gain.hpp"

#include <cmath>
#include <numbers>

#include "core/interrupt.hpp"
#include "milling/cut/product_rule.hpp"
#include "milling/structure/regenerative_loop.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;
using std::numbers::pi;

/// The sum over the harmonics at one angle: visit(ω, seen, force) for each, so that
///
///     Z = (1/T) Σ seen H(ω) force
class Harmonics {
 public:
  Harmonics(double highest_rad_s, const ContactGrid& grid, double spindle_speed_rpm)
      : grid_(grid), seconds_per_rad_(30.0 / (pi * spindle_speed_rpm)), highest_(highest_rad_s) {
    for (const CutElement& e : grid.elements)
      rules_.emplace_back(e.nodes, highest_ * (e.to_rad - e.from_rad) * seconds_per_rad_);
  }

  [[nodiscard]] double period_s() const { return grid_.period_rad * seconds_per_rad_; }

  template <typename Visit>
  void at(double theta, Visit visit) const {
    const auto contacts = static_cast<Index>(grid_.contacts.size());
    const double period = period_s();
    Eigen::Matrix3Xcd force(3, contacts);
    Eigen::MatrixX3cd seen(contacts, 3);
    const int last = static_cast<int>(std::floor((highest_ * period - theta) / (2.0 * pi)));
    // As many on the negative side, so that the sum is real where it has to be.
    const int first = static_cast<int>(std::ceil((-highest_ * period - theta) / (2.0 * pi)));
    const complex<double> period_ago = std::conj(on_circle(theta));
    for (int k = first; k <= last; ++k) {
      core::check_interrupt();
      const double omega = (theta + 2.0 * pi * k) / period;
      const Eigen::VectorXcd moments = node_moments(omega);
      for (Index j = 0; j < contacts; ++j) {
        const EdgeContact& c = grid_.contacts[static_cast<std::size_t>(j)];
        force.col(j) = moments(c.node) * c.force;
        seen.row(j) = turn(c.node, omega) * c.chip.transpose();
        for (const Past& past : c.past) {
          const complex<double> then = turn(past.node, omega) * (past.previous_period ? period_ago : 1.0);
          seen.row(j) -= then * past.chip.transpose();
        }
      }
      visit(omega, seen, force);
    }
  }

 private:
  /// e^{iωt} at a node.
  [[nodiscard]] complex<double> turn(int node, double omega) const {
    return std::polar(1.0, omega * grid_.node_rad(node) * seconds_per_rad_);
  }

  /// ∫ e^{−iω s} ℓ_j(s) ds over each element's polynomials, s from the start of the period; one a node.
  [[nodiscard]] Eigen::VectorXcd node_moments(double omega) const {
    Eigen::VectorXcd moments(grid_.node_rad.size());
    for (std::size_t e = 0; e < grid_.elements.size(); ++e) {
      const CutElement& element = grid_.elements[e];
      const double length = (element.to_rad - element.from_rad) * seconds_per_rad_;
      const complex<double> at_end = std::polar(length, -omega * element.to_rad * seconds_per_rad_);
      moments.segment(element.first_node, element.nodes) = at_end * rules_[e].end({0.0, omega * length}).transpose();
    }
    return moments;
  }

  const ContactGrid& grid_;
  double seconds_per_rad_;
  double highest_;
  std::vector<ProductRule> rules_;
};

double last_line_rad_s(const SampledReceptance& receptance) {
  return 2.0 * pi * receptance.frequency_hz(receptance.frequency_hz.size() - 1);
}

}  // namespace

GainOnCircle harmonic_gain(const SampledReceptance& receptance, const ContactGrid& grid, double spindle_speed_rpm) {
  require_usable(receptance);
  const Harmonics harmonics(last_line_rad_s(receptance), grid, spindle_speed_rpm);
  const auto contacts = static_cast<Index>(grid.contacts.size());
  const auto gain = [&receptance, harmonics, contacts](double theta) {
    // Harmonics are gathered, and their products made at once: one product of rank three for each would spend its time
    // on reading and writing Z.
    constexpr Index gathered = 32;
    Eigen::MatrixXcd Z = Eigen::MatrixXcd::Zero(contacts, contacts);
    Eigen::MatrixXcd motion(contacts, 3 * gathered), forces(3 * gathered, contacts);
    Index columns = 0;
    const auto add = [&] {
      Z.noalias() += motion.leftCols(columns) * forces.topRows(columns);
      columns = 0;
    };
    harmonics.at(theta, [&](double omega, const Eigen::MatrixX3cd& seen, const Eigen::Matrix3Xcd& force) {
      motion.middleCols<3>(columns).noalias() = seen * interpolated(receptance, omega);
      forces.middleRows<3>(columns) = force;
      columns += 3;
      if (columns == motion.cols()) add();
    });
    add();
    return Eigen::MatrixXcd(Z / harmonics.period_s());
  };
  const auto between = [&receptance, harmonics](double theta, const Eigen::VectorXcd& l, const Eigen::VectorXcd& r) {
    complex<double> sum = 0.0;
    harmonics.at(theta, [&](double omega, const Eigen::MatrixX3cd& seen, const Eigen::Matrix3Xcd& force) {
      sum += ((seen.transpose() * l).transpose() * interpolated(receptance, omega) * (force * r)).value();
    });
    return sum / harmonics.period_s();
  };
  const auto slope = [between](double theta, const Eigen::VectorXcd& l, const Eigen::VectorXcd& r) {
    constexpr double h = 1e-5;  // rad; the slope steers Newton's rule and need not be exact
    return (between(theta + h, l, r) - between(theta - h, l, r)) / (2.0 * h);
  };
  return {contacts, gain, slope, {}};
}

std::vector<HarmonicWeight> gain_weights(double highest_rad_s, const ContactGrid& grid, double spindle_speed_rpm,
                                         double theta_rad, const Eigen::VectorXcd& l, const Eigen::VectorXcd& r) {
  const Harmonics harmonics(highest_rad_s, grid, spindle_speed_rpm);
  std::vector<HarmonicWeight> weights;
  harmonics.at(theta_rad, [&](double omega, const Eigen::MatrixX3cd& seen, const Eigen::Matrix3Xcd& force) {
    weights.push_back({omega, (seen.transpose() * l) * (force * r).transpose() / harmonics.period_s()});
  });
  return weights;
}

Eigen::Matrix3cd static_weight(const ContactGrid& grid, double theta_rad, const Eigen::VectorXcd& l,
                               const Eigen::VectorXcd& r) {
  const complex<double> period_ago = std::conj(on_circle(theta_rad));
  const Index nodes = grid.node_rad.size();
  Eigen::Matrix3Xcd seen = Eigen::Matrix3Xcd::Zero(3, nodes), force = Eigen::Matrix3Xcd::Zero(3, nodes);
  for (std::size_t i = 0; i < grid.contacts.size(); ++i) {
    const EdgeContact& c = grid.contacts[i];
    const auto at = static_cast<Index>(i);
    force.col(c.node) += c.force * r(at);
    seen.col(c.node) += c.chip * l(at);
    for (const Past& past : c.past) {
      const complex<double> then = past.previous_period ? period_ago : 1.0;
      seen.col(past.node) -= past.chip * (then * l(at));
    }
  }
  return seen * force.transpose();
}

std::vector<Eigen::Matrix3cd> gain_gradient(const SampledReceptance& receptance, const ContactGrid& grid,
                                            double spindle_speed_rpm, double theta_rad, const Eigen::VectorXcd& l,
                                            const Eigen::VectorXcd& r, complex<double> factor) {
  require_usable(receptance);
  std::vector<Eigen::Matrix3cd> gradient(receptance.H.size(), Eigen::Matrix3cd::Zero());
  for (const auto& [omega, weight] :
       gain_weights(last_line_rad_s(receptance), grid, spindle_speed_rpm, theta_rad, l, r)) {
    const LineWeights of = line_weights(receptance, std::abs(omega) / (2.0 * pi));
    Eigen::Matrix3cd g = factor * weight;
    if (omega < 0.0) g = g.conjugate().eval();  // Re(z̄) = Re(z)
    for (Index i = 0; i < of.weight.size(); ++i) gradient[static_cast<std::size_t>(of.first + i)] += of.weight(i) * g;
  }
  return gradient;
}

}  // namespace thinwall::milling
