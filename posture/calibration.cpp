#include "posture/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "identification/assignment.hpp"
#include "identification/tracking.hpp"

namespace thinwall::posture {

namespace {

using Complex = std::complex<double>;

void require_tapped(const TappedArm& nominal, const std::vector<TappedPosture>& postures) {
  if (postures.empty()) throw core::InputError("calibration: no posture, must be at least one");
  for (const robot::Link& link : nominal.arm.links) {
    if (!(link.joint.damping > 0.0))
      throw core::InputError("calibration: joint " + link.name + " has damping " + std::to_string(link.joint.damping) +
                             ", must be above 0; give it a first guess");
  }
  for (std::size_t i = 0; i < postures.size(); ++i) {
    for (const identification::FittedMode& mode : postures[i].modes) {
      if (mode.right.size() == nominal.responses.rows() && mode.left.size() == nominal.references.rows()) continue;
      throw core::InputError("calibration: a mode of posture " + std::to_string(i + 1) + " has " +
                             std::to_string(mode.right.size()) + " responses and " + std::to_string(mode.left.size()) +
                             " references, must be " + std::to_string(nominal.responses.rows()) + " and " +
                             std::to_string(nominal.references.rows()) + " as the arm's rows");
    }
  }
}

/// The joints' values as the unknowns: ln k, then ln d.
Eigen::VectorXd unknowns_of(const robot::SerialArm& arm) {
  const Eigen::Index n = arm.joints();
  Eigen::VectorXd p(2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const robot::Joint& joint = arm.links[static_cast<std::size_t>(i)].joint;
    p(i) = std::log(joint.stiffness);
    p(n + i) = std::log(joint.damping);
  }
  return p;
}

robot::SerialArm with_unknowns(robot::SerialArm arm, const Eigen::VectorXd& p) {
  const Eigen::Index n = arm.joints();
  for (Eigen::Index i = 0; i < n; ++i) {
    robot::Joint& joint = arm.links[static_cast<std::size_t>(i)].joint;
    joint.stiffness = std::exp(p(i));
    joint.damping = std::exp(p(n + i));
  }
  return arm;
}

/// ∂λ/∂(ln k, ln d) of a mode.
Eigen::VectorXcd pole_slope(const ArmModes& modes, Eigen::Index r, const Eigen::VectorXd& p) {
  const Eigen::Index n = modes.stretch.rows();
  Eigen::VectorXcd slope(2 * n);
  slope.head(n) = -modes.stretch.col(r).cwiseProduct(modes.stretch.col(r));
  slope.tail(n) = modes.poles(r) * slope.head(n);
  return slope.cwiseProduct(p.array().exp().matrix().cast<Complex>());
}

/// The normal equations of the data, without the priors.
struct Differences {
  Eigen::MatrixXd JtJ;
  Eigen::VectorXd Jtr;
  double sum = 0.0;
  int count = 0;
  std::vector<std::vector<int>> model{};
};

void add_pair(const ArmModes& modes, Eigen::Index r, const identification::FittedMode& seen, const Eigen::VectorXd& p,
              const CalibrationOptions& options, Differences& to) {
  const Complex pole = modes.poles(r), there = seen.pole();
  const Eigen::VectorXcd slope = pole_slope(modes, r, p);
  const Eigen::VectorXd of_frequency = (slope / pole).real();
  const Eigen::VectorXd of_damping = slope.real() / pole.real() - of_frequency;
  const double ln_f = std::log(std::abs(there) / std::abs(pole));
  const double ln_zeta = std::log(there.real() / pole.real()) - ln_f;
  const auto add = [&](double difference, const Eigen::VectorXd& gradient, double sd) {
    to.JtJ.noalias() += gradient * gradient.transpose() / (sd * sd);
    to.Jtr += gradient * (difference / (sd * sd));
    to.sum += difference * difference / (sd * sd);
    ++to.count;
  };
  add(ln_f, of_frequency, options.sd_ln_frequency);
  add(ln_zeta, of_damping, options.sd_ln_damping);
}

Differences differences(const TappedArm& nominal, const std::vector<TappedPosture>& postures, const Eigen::VectorXd& p,
                        const CalibrationOptions& options) {
  const robot::SerialArm arm = with_unknowns(nominal.arm, p);
  Differences result{Eigen::MatrixXd::Zero(p.size(), p.size()), Eigen::VectorXd::Zero(p.size())};
  for (const TappedPosture& posture : postures) {
    const ArmModes modes = arm_modes(arm, posture.place.q);
    result.model.push_back(paired(posture.modes, as_identified(modes, nominal)));
    for (std::size_t k = 0; k < posture.modes.size(); ++k) {
      const int r = result.model.back()[k];
      if (r >= 0) add_pair(modes, r, posture.modes[k], p, options, result);
    }
  }
  return result;
}

/// The search for the least of the objective.
struct Search {
  const TappedArm& nominal;
  const std::vector<TappedPosture>& postures;
  const CalibrationOptions& options;
  Eigen::VectorXd first;   ///< nominal values
  Eigen::VectorXd weight;  ///< 1/σ² of the priors
  Eigen::VectorXd p{};
  Differences at{};

  [[nodiscard]] double objective(const Differences& there, const Eigen::VectorXd& place) const {
    // A mode that lost its partner counts as one that is wrong by three deviations, or losing it would be a gain.
    return there.sum - 9.0 * there.count + (place - first).cwiseAbs2().dot(weight);
  }
  [[nodiscard]] Eigen::LLT<Eigen::MatrixXd> information() const {
    return Eigen::LLT<Eigen::MatrixXd>(Eigen::MatrixXd(at.JtJ + Eigen::MatrixXd(weight.asDiagonal())));
  }
};

/// Takes one step; true where there is none left that lowers the objective.
bool gauss_newton_step(Search& search) {
  const Eigen::VectorXd slope = search.at.Jtr - search.weight.cwiseProduct(search.p - search.first);
  const Eigen::VectorXd step = search.information().solve(slope);
  for (double share = 1.0; share > 1e-4; share *= 0.5) {
    const Eigen::VectorXd place = search.p + share * step;
    Differences there = differences(search.nominal, search.postures, place, search.options);
    if (search.objective(there, place) > search.objective(search.at, search.p)) continue;
    search.p = place;
    search.at = std::move(there);
    return step.cwiseAbs().maxCoeff() < 1e-8;
  }
  return true;
}

}  // namespace

std::vector<int> paired(const std::vector<identification::FittedMode>& identified,
                        const std::vector<identification::FittedMode>& model) {
  constexpr double most_unlike = 3.0;
  std::vector<int> pair(identified.size(), -1);
  if (identified.empty() || model.empty()) return pair;
  // Costs beyond the bound are all the same, so that modes that the model has not do not pull at the pairs of others.
  Eigen::MatrixXd cost(static_cast<Eigen::Index>(identified.size()), static_cast<Eigen::Index>(model.size()));
  for (Eigen::Index i = 0; i < cost.rows(); ++i) {
    for (Eigen::Index j = 0; j < cost.cols(); ++j)
      cost(i, j) = std::min(most_unlike, identification::unlikeness(identified[static_cast<std::size_t>(i)],
                                                                    model[static_cast<std::size_t>(j)]));
  }
  pair = identification::cheapest_pairing(cost);
  for (std::size_t i = 0; i < pair.size(); ++i) {
    if (pair[i] >= 0 && cost(static_cast<Eigen::Index>(i), pair[i]) >= most_unlike) pair[i] = -1;
  }
  return pair;
}

Calibration calibrate(const TappedArm& nominal, const std::vector<TappedPosture>& postures,
                      const CalibrationOptions& options) {
  require_tapped(nominal, postures);
  const Eigen::Index n = nominal.arm.joints();
  Search search{nominal, postures, options, unknowns_of(nominal.arm), Eigen::VectorXd(2 * n)};
  search.weight << Eigen::VectorXd::Constant(n, std::pow(options.sd_ln_stiffness, -2)),
      Eigen::VectorXd::Constant(n, std::pow(options.sd_ln_joint_damping, -2));
  search.p = search.first;
  search.at = differences(nominal, postures, search.p, options);
  if (search.at.count == 0)
    throw core::InputError("calibration: no identified mode is like one of the arm's; check units, joints and rows");
  Calibration result;
  while (result.steps < options.most_steps && !result.converged) {
    ++result.steps;
    result.converged = gauss_newton_step(search);
  }
  result.arm = with_unknowns(nominal.arm, search.p);
  result.stiffness = search.p.head(n).array().exp();
  result.damping = search.p.tail(n).array().exp();
  result.covariance = search.information().solve(Eigen::MatrixXd::Identity(2 * n, 2 * n));
  result.model = search.at.model;
  result.rms = std::sqrt(search.at.sum / search.at.count);
  return result;
}

}  // namespace thinwall::posture
