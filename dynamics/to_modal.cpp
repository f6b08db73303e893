#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"

namespace thinwall::dynamics {

namespace {

using Complex = std::complex<double>;

/// Solutions λ, η of (λ² + λ D + Ω²) η = 0 in undamped modal coordinates, with a = ηᵀ (2λ + D) η.
struct QuadraticModes {
  Eigen::VectorXcd lambda;
  Eigen::MatrixXcd eta;
  Eigen::VectorXcd a;
};

[[noreturn]] void refuse_double_pole(Complex lambda) {
  std::ostringstream text;
  text << "the pole at " << lambda.real() << (lambda.imag() < 0.0 ? " - " : " + ") << std::abs(lambda.imag())
       << "i rad/s is double (critical damping) and has no modal form; change its stiffness or damping, or use the "
          "direct response";
  throw core::NumericalError(text.str());
}

/// Refuses a double pole. a = ηᵀ (2λ + D) η vanishes at a defective pole only; near one the residues lose the digits
/// that a has lost, so that 1e-7 of its scale leaves nine digits.
void require_simple(Complex lambda, Complex a, double scale) {
  if (!(std::abs(a) > 1e-7 * scale)) refuse_double_pole(lambda);
}

/// The frequency (rad/s) of the soft suspension that stands for the double pole at zero of a free motion (to_modal()).
/// With a millionth of the lowest elastic one, 1/(s² + ε²) differs from 1/s² by 1e-12 there, and the difference of its
/// two terms keeps ten digits.
double suspension(const Eigen::VectorXd& omega) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const double w : omega)
    if (w > 0.0) lowest = std::min(lowest, w);
  return std::isfinite(lowest) ? 1e-6 * lowest : 1e-3;
}

/// The modes of ω = 0 that no damping acts on: in their rows of ΦᵀCΦ, whose entries without cancellation have the size
/// `uncancelled`, all cancels but for the round-off of the shapes.
std::vector<Eigen::Index> free_motions(const Eigen::VectorXd& omega, const Eigen::MatrixXd& D,
                                       const Eigen::MatrixXd& uncancelled) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index r = 0; r < omega.size(); ++r)
    if (omega(r) == 0.0 && (D.row(r).array().abs() <= 1e-9 * uncancelled.row(r).array()).all()) free.push_back(r);
  return free;
}

/// The diagonal of D = ΦᵀCΦ if D is diagonal, else nothing. An off-diagonal entry counts as zero if it is within the
/// round-off of forming it, or within 1e-12 of the damping of both modes: dropping it then changes no receptance by
/// more than 1e-12 of itself.
std::optional<Eigen::VectorXd> proportional_damping(const Eigen::MatrixXd& D, const Eigen::MatrixXd& uncancelled) {
  const Eigen::MatrixXd round_off =
      static_cast<double>(D.rows()) * std::numeric_limits<double>::epsilon() * uncancelled;
  Eigen::VectorXd d = D.diagonal();
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    for (Eigen::Index j = 0; j < d.size(); ++j) {
      const double bound = round_off(i, j) + 1e-12 * std::sqrt(std::abs(D(i, i) * D(j, j)));
      if (i != j && std::abs(D(i, j)) > bound) return std::nullopt;
    }
    if (std::abs(d(i)) <= round_off(i, i)) d(i) = 0.0;
  }
  return d;
}

/// The poles λ = −d/2 ± √(d²/4 − ω²) of each mode in closed form. The smaller root of an overdamped mode is computed as
/// ω² over the larger one, which avoids cancellation.
QuadraticModes proportional_modes(const Eigen::VectorXd& omega, const Eigen::VectorXd& d) {
  const Eigen::Index n = omega.size();
  QuadraticModes modes{Eigen::VectorXcd(2 * n), Eigen::MatrixXcd::Zero(n, 2 * n), Eigen::VectorXcd(2 * n)};
  for (Eigen::Index r = 0; r < n; ++r) {
    modes.eta.row(r).segment(2 * r, 2).setOnes();
    if (omega(r) == 0.0 && d(r) == 0.0) {
      const Complex pole(0.0, suspension(omega));
      modes.lambda.segment(2 * r, 2) << pole, -pole;
      modes.a.segment(2 * r, 2) << 2.0 * pole, -2.0 * pole;
      continue;
    }
    const double half = 0.5 * d(r);
    const double root = std::sqrt(std::abs((omega(r) - half) * (omega(r) + half)));
    const bool oscillates = omega(r) > std::abs(half);
    const double larger = half >= 0.0 ? -half - root : -half + root;
    const Complex first = oscillates ? Complex(-half, root) : Complex(larger, 0.0);
    const Complex second = oscillates ? std::conj(first) : Complex(omega(r) * omega(r) / larger, 0.0);
    const Complex a = oscillates ? Complex(0.0, 2.0 * root) : Complex(half >= 0.0 ? -2.0 * root : 2.0 * root, 0.0);
    require_simple(first, a, 2.0 * std::max(omega(r), std::abs(half)));
    modes.lambda.segment(2 * r, 2) << first, second;
    modes.a.segment(2 * r, 2) << a, -a;
  }
  return modes;
}

/// The state matrix [0 Γ; −Ω²/Γ −D] of the state (Γ η, η'). Γ = Ω, except that rigid-body modes take the mean of Ω
/// instead of 0, so that their displacement remains in the state.
Eigen::MatrixXd state_matrix(const Eigen::VectorXd& omega, const Eigen::VectorXd& Gamma, const Eigen::MatrixXd& D) {
  const Eigen::Index n = omega.size();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).diagonal() = Gamma;
  A.bottomLeftCorner(n, n).diagonal() = -omega.array().square() / Gamma.array();
  A.bottomRightCorner(n, n) = -D;
  return A;
}

/// Indices of one pole of each conjugate pair (Im λ > 0) and of all real poles, by rising |λ|.
std::vector<Eigen::Index> upper_half(const Eigen::VectorXcd& lambda) {
  std::vector<Eigen::Index> indices;
  for (Eigen::Index k = 0; k < lambda.size(); ++k) {
    if (lambda(k).imag() >= 0.0) indices.push_back(k);
  }
  std::stable_sort(indices.begin(), indices.end(),
                   [&](Eigen::Index i, Eigen::Index j) { return std::abs(lambda(i)) < std::abs(lambda(j)); });
  return indices;
}

/// A pole improved by one Newton step on the Rayleigh functional ηᵀ (λ² + λ D + Ω²) η = 0 (Lancaster 1961). The
/// functional is stationary at an eigenvector, so that the error of the pole becomes the square of the vector's, and
/// low poles beside high ones keep all digits.
struct RefinedPole {
  Complex lambda;
  Complex a;
};
RefinedPole refine(Complex lambda, const Eigen::VectorXcd& eta, const Eigen::VectorXd& omega,
                   const Eigen::MatrixXd& D) {
  const Complex m = eta.cwiseProduct(eta).sum();
  const Complex d = eta.cwiseProduct(D * eta).sum();
  const Complex k = eta.cwiseProduct(omega.cwiseAbs2().asDiagonal() * eta).sum();
  const double scale = 2.0 * std::abs(lambda) * eta.squaredNorm() + std::abs(d);
  require_simple(lambda, 2.0 * lambda * m + d, scale);
  lambda -= (lambda * (lambda * m + d) + k) / (2.0 * lambda * m + d);
  return {lambda, 2.0 * lambda * m + d};
}

/// Throws NumericalError unless Σ λ η ηᵀ / a = I, which holds for a complete set of simple poles (at high frequency the
/// response is that of the mass alone).
void require_complete(const QuadraticModes& modes) {
  const Eigen::VectorXcd weight = modes.lambda.cwiseQuotient(modes.a);
  const Eigen::MatrixXcd sum = modes.eta * weight.asDiagonal() * modes.eta.transpose();
  const double error = (sum - Eigen::MatrixXcd::Identity(sum.rows(), sum.rows())).cwiseAbs().maxCoeff();
  if (error <= 1e-7) return;
  std::ostringstream text;
  text << "the complex modes do not add up to the mass (error " << error
       << ", bound 1e-7): two poles coincide; change their damping slightly, or use the direct response";
  throw core::NumericalError(text.str());
}

/// All modes from the eigenvectors of the state matrix, each pole with its conjugate.
QuadraticModes general_modes(const Eigen::VectorXd& omega, const Eigen::MatrixXd& D) {
  const Eigen::Index n = omega.size();
  const double mean = omega.maxCoeff() > 0.0 ? omega.mean() : std::max(D.norm(), 1.0);
  const Eigen::VectorXd Gamma = omega.unaryExpr([mean](double w) { return w > 0.0 ? w : mean; });
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(state_matrix(omega, Gamma, D));
  if (solver.info() != Eigen::Success) {
    throw core::NumericalError("the eigenvalues of the damped model of " + std::to_string(n) +
                               " modes did not converge; use the direct response");
  }
  const Eigen::MatrixXcd X = solver.eigenvectors();
  QuadraticModes modes{Eigen::VectorXcd(2 * n), Eigen::MatrixXcd(n, 2 * n), Eigen::VectorXcd(2 * n)};
  Eigen::Index column = 0;
  for (const Eigen::Index k : upper_half(solver.eigenvalues())) {
    const Complex lambda = solver.eigenvalues()(k);
    // Both halves of the state hold η, as Γ η and λ η. Weighted least squares takes each component mainly from the half
    // in which it is larger.
    const Eigen::ArrayXd weight = Gamma.array().square() + std::norm(lambda);
    Eigen::VectorXcd eta =
        ((Gamma.array() * X.col(k).head(n).array() + std::conj(lambda) * X.col(k).tail(n).array()) / weight).matrix();
    eta.normalize();
    const RefinedPole pole = refine(lambda, eta, omega, D);
    modes.lambda(column) = pole.lambda;
    modes.a(column) = pole.a;
    modes.eta.col(column++) = eta;
    if (lambda.imag() == 0.0) continue;
    modes.lambda(column) = std::conj(pole.lambda);
    modes.a(column) = std::conj(pole.a);
    modes.eta.col(column++) = eta.conjugate();
  }
  require_complete(modes);
  return modes;
}

/// All modes, of which the free motions are taken apart: they are uncoupled from the others, and an eigen-solver would
/// return round-off for their double pole.
QuadraticModes modes_beside(const std::vector<Eigen::Index>& free, const Eigen::VectorXd& omega,
                            const Eigen::MatrixXd& D) {
  if (free.empty()) return general_modes(omega, D);
  std::vector<Eigen::Index> held;
  for (Eigen::Index r = 0; r < omega.size(); ++r)
    if (std::ranges::find(free, r) == free.end()) held.push_back(r);
  const QuadraticModes of_free = proportional_modes(Eigen::VectorXd::Constant(std::ssize(free), suspension(omega)),
                                                    Eigen::VectorXd::Zero(std::ssize(free)));
  const QuadraticModes of_held = general_modes(omega(held), D(held, held));
  const Eigen::Index n = omega.size();
  const Eigen::Index first = 2 * std::ssize(free);
  QuadraticModes modes{Eigen::VectorXcd(2 * n), Eigen::MatrixXcd::Zero(n, 2 * n), Eigen::VectorXcd(2 * n)};
  modes.lambda << of_free.lambda, of_held.lambda;
  modes.a << of_free.a, of_held.a;
  modes.eta(free, Eigen::seqN(0, first)) = of_free.eta;
  modes.eta(held, Eigen::seq(first, Eigen::last)) = of_held.eta;
  return modes;
}

}  // namespace

ModalModel to_modal(const SpatialModel& model) {
  require_consistent(model);
  if (model.has_structural_damping() && !model.D.isZero(0.0)) {
    throw core::InputError(
        "a model with structural damping has no causal poles: convert it with equivalent_viscous, or use the direct "
        "response");
  }
  const UndampedModes undamped = undamped_modes(model);
  const Eigen::MatrixXd product = undamped.Phi.transpose() * model.C * undamped.Phi;
  const Eigen::MatrixXd D = 0.5 * (product + product.transpose());
  const Eigen::MatrixXd uncancelled =
      undamped.Phi.cwiseAbs().transpose() * model.C.cwiseAbs() * undamped.Phi.cwiseAbs();
  const auto diagonal = proportional_damping(D, uncancelled);
  const QuadraticModes modes =
      diagonal ? proportional_modes(undamped.omega_rad_s, *diagonal)
               : modes_beside(free_motions(undamped.omega_rad_s, D, uncancelled), undamped.omega_rad_s, D);
  Eigen::MatrixXcd shapes = undamped.Phi * modes.eta;
  if (model.has_own_coordinates()) shapes = (model.T * shapes).eval();
  return {modes.lambda, shapes, shapes, modes.a, Eigen::MatrixXd(), model.dofs};
}

SpatialModel equivalent_viscous(const SpatialModel& model) {
  require_consistent(model);
  SpatialModel viscous = model;
  viscous.D.resize(0, 0);
  if (!model.has_structural_damping()) return viscous;
  const UndampedModes modes = undamped_modes(model);
  const Eigen::VectorXd loss = (modes.Phi.transpose() * model.D * modes.Phi).diagonal();
  Eigen::VectorXd modal_damping = Eigen::VectorXd::Zero(loss.size());
  for (Eigen::Index r = 0; r < loss.size(); ++r) {
    if (modes.omega_rad_s(r) > 0.0) {
      modal_damping(r) = loss(r) / modes.omega_rad_s(r);
    } else if (std::abs(loss(r)) > 1e-9 * loss.cwiseAbs().maxCoeff()) {
      throw core::InputError(
          "structural damping acts on a rigid-body motion, where no stiffness is: no viscous "
          "damping is equivalent to it");
    }
  }
  const Eigen::MatrixXd MPhi = model.M * modes.Phi;
  viscous.C += MPhi * modal_damping.asDiagonal() * MPhi.transpose();
  return viscous;
}

}  // namespace thinwall::dynamics
