#include "reduction/trust/mode_count.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/dense_factorisations.hpp"
#include "core/faults.hpp"
#include "core/interrupt.hpp"
#include "dynamics/conversion.hpp"
#include "reduction/methods/held_interface.hpp"
#include "reduction/trust/accuracy.hpp"
#include "reduction/worst.hpp"

namespace thinwall::reduction {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Index interface_size(const CraigBampton& reduced) {
  return reduced.model.size() - reduced.fixed_interface_hz.size();
}

/// The undamped frequencies of a model in (0.001 … 1) of the band's end, Hz.
VectorXd natural_hz(const dynamics::SpatialModel& model, const Band& band) {
  const VectorXd hz = dynamics::undamped_modes(model).omega_rad_s / (2.0 * std::numbers::pi);
  std::vector<double> inside;
  std::copy_if(hz.begin(), hz.end(), std::back_inserter(inside),
               [&](double f) { return f > 1e-3 * band.to_hz && f < band.to_hz; });
  return Eigen::Map<const VectorXd>(inside.data(), std::ssize(inside));
}

/// The receptance of a model with its interface first, M = I and K diagonal inside, for every number of its modes
/// (docs/theory/reductions.md, Eq. 14). The dynamic stiffness changes by a rank-one term for each mode, so that all
/// numbers cost one pass.
class CountedReceptance {
 public:
  CountedReceptance(const dynamics::SpatialModel& model, Index interface)
      : K_(model.K.topLeftCorner(interface, interface)),
        M_(model.M.topLeftCorner(interface, interface)),
        L_(model.M.topRightCorner(interface, model.size() - interface)),
        lambda_(model.K.diagonal().tail(model.size() - interface)) {}

  [[nodiscard]] Index modes() const { return lambda_.size(); }
  [[nodiscard]] MatrixXcd stiffness(Complex z) const { return K_.cast<Complex>() - z * M_.cast<Complex>(); }
  void add(MatrixXcd& Z, Index mode, Complex z) const {
    Z -= (z * z / (lambda_(mode) - z)) * (L_.col(mode) * L_.col(mode).transpose()).cast<Complex>();
  }
  [[nodiscard]] MatrixXcd receptance(Complex z) const {
    MatrixXcd Z = stiffness(z);
    for (Index k = 0; k < modes(); ++k) add(Z, k, z);
    return Z.inverse();
  }

 private:
  MatrixXd K_, M_, L_;
  VectorXd lambda_;
};

/// The reduction with its first modes only.
CraigBampton cut(const CraigBampton& reduced, Index modes) {
  const Index n = interface_size(reduced) + modes;
  CraigBampton result = reduced;
  result.fixed_interface_hz.conservativeResize(modes);
  result.T.conservativeResize(Eigen::NoChange, n);
  for (MatrixXd* matrix : {&result.model.M, &result.model.C, &result.model.K}) matrix->conservativeResize(n, n);
  result.model.dofs.resize(static_cast<std::size_t>(n));
  return result;
}

/// The truncation of a reduction with its first modes only: that of the whole reduction, plus the contribution L Lᵀ/λ
/// and L Lᵀ/λ² of the modes dropped.
Truncation cut(const Truncation& truncation, const CraigBampton& reduced, Index modes) {
  const Index nb = interface_size(reduced), dropped = reduced.fixed_interface_hz.size() - modes;
  const MatrixXd L = reduced.model.M.topRightCorner(nb, dropped);
  const VectorXd flexibility = reduced.model.K.diagonal().tail(dropped).cwiseInverse();
  return {truncation.A + L * flexibility.asDiagonal() * L.transpose(),
          truncation.B + L * flexibility.cwiseAbs2().asDiagonal() * L.transpose()};
}

/// Undamped frequencies at which an error of the reference is most visible. They are a little above the highest
/// resonances, at the half-power point of the damped receptance, where a wrong frequency has as much effect as in that
/// receptance; and in the middles of the widest gaps. Frequencies near to another resonance are left out.
std::vector<double> verification_frequencies(const VectorXd& natural, const Band& band, int count) {
  const double flank = 0.5 * band.loss_factor;
  const double from = std::max(band.from_hz, 1e-2 * band.to_hz);
  std::vector<double> lines;
  for (Index k = natural.size(); k-- > 0 && std::ssize(lines) < (count + 1) / 2;) {
    const double hz = natural(k) * (1.0 + flank);
    const double nearest = (natural.array() / hz - 1.0).abs().minCoeff();
    if (hz > from && hz < band.to_hz && nearest > 0.5 * flank) lines.push_back(hz);
  }
  const int rest = count - static_cast<int>(lines.size());
  for (const double hz : frequencies_between(natural, from, band.to_hz, rest)) lines.push_back(hz);
  return lines;
}

/// The largest error of the reference over the lines of a truth.
double against_truth(const CountedReceptance& reference, const BandTruth& truth) {
  double worst = 0.0;
  for (std::size_t k = 0; k < truth.z.size(); ++k) {
    const double error = relative_error(reference.receptance(truth.z[k]), truth.H[k], truth.units);
    worst = worse_of(worst, error);
  }
  return worst;
}

/// The largest error of the reference against direct solves of the full model.
double against_direct_solves(const CountedReceptance& reference, const FullModel& full, const Interface& interface,
                             const std::vector<double>& lines, const VectorXd& units) {
  double worst = 0.0;
  for (const FullReceptance& line : full_receptances(full.K, full.M, full.node_of_row, interface, lines)) {
    const double omega = 2.0 * std::numbers::pi * line.frequency_hz;
    const double error = relative_error(reference.receptance(omega * omega), line.H.cast<Complex>(), units);
    worst = worse_of(worst, error);
  }
  return worst;
}

/// The errors by number of modes, and the data by which they were measured.
struct Estimates {
  std::vector<double> errors;
  VectorXd units, natural_hz;
};

/// The errors of the reduction with 0, 1, 2 … of its modes against the model `better`, the largest over the band. A
/// line's stiffness is updated mode by mode, so that all numbers of modes cost one pass.
Estimates estimates(const CraigBampton& reduced, const dynamics::SpatialModel& better, const Band& band) {
  const Index nb = interface_size(reduced);
  const CountedReceptance counted(reduced.model, nb), reference(better, nb);
  Estimates result;
  result.natural_hz = natural_hz(better, band);
  // The lines follow the natural frequencies, and the fixed-interface frequencies, which are antiresonances of the
  // receptance of an interface with a single DOF.
  VectorXd peaks(result.natural_hz.size() + reduced.fixed_interface_hz.size());
  peaks << result.natural_hz, reduced.fixed_interface_hz;
  const std::vector<Complex> z = squares(band, peaks);
  std::vector<MatrixXcd> H;
  H.reserve(z.size());
  for (const Complex each : z) H.push_back(reference.receptance(each));
  const dynamics::DofTable dofs(reduced.model.dofs.begin(), reduced.model.dofs.begin() + nb);
  result.units = common_units(dofs, H);
  result.errors.assign(static_cast<std::size_t>(counted.modes()) + 1, 0.0);
  for (std::size_t line = 0; line < z.size(); ++line) {
    core::check_interrupt();
    MatrixXcd Z = counted.stiffness(z[line]);
    for (std::size_t m = 0; m < result.errors.size(); ++m) {
      if (m > 0) counted.add(Z, static_cast<Index>(m) - 1, z[line]);
      const double error = relative_error(Z.inverse(), H[line], result.units);
      result.errors[m] = worse_of(result.errors[m], error);
    }
  }
  return result;
}

/// The smallest number of modes of one reduction that meets the tolerance, with the verification of the reference
/// against which it was chosen.
ChosenModes chosen_from(const CraigBampton& all, const Truncation& left_out, const FullModel& full,
                        const Interface& interface, const ModeCountOptions& options, const BandTruth* truth) {
  const dynamics::SpatialModel better = with_left_out(all.model, left_out);
  Estimates estimate = estimates(all, better, options.band);
  ChosenModes result;
  const CountedReceptance reference(better, interface_size(all));
  result.reference_error =
      truth != nullptr
          ? against_truth(reference, *truth)
          : against_direct_solves(reference, full, interface,
                                  verification_frequencies(estimate.natural_hz, options.band, options.verified_lines),
                                  estimate.units);
  const auto first = std::find_if(estimate.errors.begin(), estimate.errors.end(),
                                  [&](double error) { return error <= options.tolerance; });
  const bool met = first != estimate.errors.end();
  result.modes = static_cast<int>((met ? first : estimate.errors.end() - 1) - estimate.errors.begin());
  result.estimated_error = estimate.errors[static_cast<std::size_t>(result.modes)];
  result.reference_modes = static_cast<int>(all.fixed_interface_hz.size());
  result.errors = std::move(estimate.errors);
  result.reduced = cut(all, result.modes);
  result.truncation = cut(left_out, all, result.modes);
  const bool converged = all.status == linalg::EigenStatus::converged;
  const bool verified = converged && result.reference_error <= 0.1 * options.tolerance;
  result.status = !met ? ModeCountStatus::not_met : verified ? ModeCountStatus::met : ModeCountStatus::not_verified;
  return result;
}

ChosenModes chosen_modes(const FullModel& full, const Interface& interface, const ModeCountOptions& options,
                         const BandTruth* truth) {
  validate(options);
  validate(options.band, full);
  const linalg::SparseCholesky factor = held_by_interface(full, interface);
  const linalg::ShiftedInverse inverse{
      [&factor](const Eigen::Ref<const MatrixXd>& B) -> MatrixXd { return factor.solve(B); }, 0.0};
  ChosenModes result;
  double up_to_hz = 1.5 * options.band.to_hz;
  for (int round = 0; round < options.rounds; ++round, up_to_hz *= 1.6) {
    const CraigBampton all = craig_bampton(full.K, full.M, inverse, interface, {.modes = 0, .up_to_hz = up_to_hz});
    result = chosen_from(all, truncation(all, full.M, inverse, interface), full, interface, options, truth);
    if (result.status == ModeCountStatus::met) break;
  }
  return result;
}

}  // namespace

void validate(const ModeCountOptions& options) {
  validate(options.band);
  core::Faults faults;
  faults.require_number(options.tolerance, options.tolerance >= 1e-8 && options.tolerance <= 1.0, "tolerance", "value",
                        "lie in 1e-8 to 1");
  faults.require_number(options.verified_lines, options.verified_lines >= 1, "verified_lines", "value", "be 1 or more");
  faults.require_number(options.rounds, options.rounds >= 1, "rounds", "value", "be 1 or more");
  faults.raise("the choice of a mode count");
}

std::vector<double> truncation_errors(const CraigBampton& reduced, const Truncation& truncation, const Band& band) {
  validate(band);
  return estimates(reduced, with_left_out(reduced.model, truncation), band).errors;
}

ChosenModes modes_for_tolerance(const FullModel& full, const Interface& interface, const ModeCountOptions& options) {
  return chosen_modes(full, interface, options, nullptr);
}

ChosenModes modes_for_tolerance(const FullModel& full, const Interface& interface, const ModeCountOptions& options,
                                const BandTruth& truth) {
  return chosen_modes(full, interface, options, &truth);
}

}  // namespace thinwall::reduction
