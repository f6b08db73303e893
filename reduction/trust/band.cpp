#include "reduction/trust/band.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/faults.hpp"
#include "core/interrupt.hpp"
#include "core/units.hpp"
#include "reduction/methods/free_interface.hpp"
#include "reduction/worst.hpp"

namespace thinwall::reduction {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

Complex square(const Band& band, double hz) {
  const double omega = 2.0 * std::numbers::pi * hz;
  return omega * omega / Complex(1.0, band.loss_factor);
}

/// The receptance B (K − zM)⁻¹ Bᵀ. K − zM is scaled to rows and columns of similar size, because interface forces and
/// displacements may be coordinates of one model.
Eigen::MatrixXcd at(const dynamics::SpatialModel& model, Index interface, Complex z) {
  Eigen::MatrixXcd Z = model.K.cast<Complex>() - z * model.M.cast<Complex>();
  const Eigen::VectorXd scale = Z.cwiseAbs().rowwise().maxCoeff().cwiseSqrt().cwiseInverse();
  if (!scale.allFinite()) throw core::NumericalError("a reduced model has a coordinate without mass and stiffness");
  Z = (scale.asDiagonal() * Z * scale.asDiagonal()).eval();
  const Eigen::MatrixXcd B = (dynamics::displacements(model).topRows(interface) * scale.asDiagonal()).cast<Complex>();
  return B * Z.partialPivLu().solve(B.transpose());
}

Eigen::MatrixXcd at(const dynamics::ModalModel& model, Index interface, Complex z) {
  const Complex s = std::sqrt(-z);
  const Eigen::VectorXcd weight = (model.scaling.array() * (s - model.poles.array())).inverse();
  Eigen::MatrixXcd H = model.right.topRows(interface) * weight.asDiagonal() * model.left.topRows(interface).transpose();
  if (model.residual.size() > 0) H += model.residual.topLeftCorner(interface, interface).cast<Complex>();
  return H;
}

}  // namespace

void validate(const Band& band) {
  core::Faults faults;
  faults.require_number(band.from_hz, band.from_hz >= 0.0, "from_hz", "value", "not be negative");
  faults.require_number(band.to_hz, band.to_hz > band.from_hz, "to_hz", "value", "lie above from_hz");
  faults.require_number(band.lines, band.lines >= 2, "lines", "value", "be 2 or more");
  faults.require_number(band.loss_factor, band.loss_factor > 0.0, "loss_factor", "value", "be positive");
  faults.raise("the band of a comparison");
}

void validate(const Band& band, const FullModel& full) {
  validate(band);
  if (full.rigid.cols() == 0 || band.from_hz > 0.0) return;
  throw core::InputError(
      "the band of a comparison: it begins at from_hz 0, where a free part has no receptance; give " +
      core::number_text(1e-3 * band.to_hz) + ", or another value above 0");
}

std::vector<Complex> squares(const Band& band, const Eigen::VectorXd& natural_hz) {
  std::vector<double> lines;
  const double first = band.from_hz > 0.0 ? band.from_hz : 1e-3 * band.to_hz;
  lines.reserve(static_cast<std::size_t>(band.lines));
  for (int i = 0; i < band.lines; ++i)
    lines.push_back(first * std::pow(band.to_hz / first, static_cast<double>(i) / (band.lines - 1)));
  if (band.from_hz == 0.0) lines.front() = 0.0;
  for (const double hz : natural_hz) {
    for (const double share : {1.0 - 0.5 * band.loss_factor, 1.0, 1.0 + 0.5 * band.loss_factor}) {
      if (share * hz >= band.from_hz && share * hz <= band.to_hz) lines.push_back(share * hz);
    }
  }
  std::sort(lines.begin(), lines.end());
  std::vector<Complex> z;
  z.reserve(lines.size());
  for (const double hz : lines) z.push_back(square(band, hz));
  return z;
}

double frequency_hz(const Band& band, Complex z) {
  return std::sqrt((z * Complex(1.0, band.loss_factor)).real()) / (2.0 * std::numbers::pi);
}

Eigen::MatrixXcd receptance_at(const ReducedModel& model, Index interface, Complex z) {
  Eigen::MatrixXcd H = std::visit([&](const auto& each) { return at(each, interface, z); }, model);
  if (!H.allFinite()) throw core::NumericalError("the receptance of a reduced model is singular in the band");
  return H;
}

Eigen::VectorXd common_units(const dynamics::DofTable& interface, const std::vector<Eigen::MatrixXcd>& H) {
  Eigen::VectorXd rotational(interface.size());
  for (std::size_t i = 0; i < interface.size(); ++i)
    rotational(static_cast<Index>(i)) = interface[i].kind == dynamics::DofKind::rotation ? 1.0 : 0.0;
  double translation = 0.0, rotation = 0.0;
  for (const Eigen::MatrixXcd& line : H) {
    const Eigen::VectorXd size = line.diagonal().cwiseAbs();
    translation = std::max(translation, size.cwiseProduct(Eigen::VectorXd::Ones(size.size()) - rotational).maxCoeff());
    rotation = std::max(rotation, size.cwiseProduct(rotational).maxCoeff());
  }
  const double factor = translation > 0.0 && rotation > 0.0 ? std::sqrt(translation / rotation) : 1.0;
  return rotational.unaryExpr([factor](double is_rotation) { return is_rotation > 0.0 ? factor : 1.0; });
}

double relative_error(const Eigen::MatrixXcd& H, const Eigen::MatrixXcd& full, const Eigen::VectorXd& units) {
  const auto size = [&](const Eigen::MatrixXcd& X) {
    return (units.asDiagonal() * X.cwiseAbs() * units.asDiagonal()).eval().maxCoeff<Eigen::PropagateNaN>();
  };
  return size(H - full) / size(full);
}

BandTruth band_truth(const FullModel& full, const Interface& interface, const Band& band) {
  validate(band, full);
  const StaticFlexibility flexibility(full);
  PartModes modes = free_modes_beyond(full, flexibility, band.to_hz);
  if (modes.status != linalg::EigenStatus::converged)
    throw core::NumericalError("the modes of the full model up to the band's end did not converge");
  const Index rigid = flexibility.rigid_modes().cols();
  const linalg::Eigenpairs pairs{modes.lambda, std::move(modes.Phi), {}, modes.status};
  const ReceptanceSum sum =
      receptance_sum(full.K, full.M, flexibility.action(), pairs, interface, 2.0 * std::numbers::pi * band.to_hz);
  const Eigen::VectorXd hz = modes.lambda.tail(modes.lambda.size() - rigid).cwiseSqrt() / (2.0 * std::numbers::pi);
  BandTruth truth;
  truth.natural_hz = hz.head((hz.array() <= band.to_hz).count());
  truth.rigid_motions = static_cast<int>(rigid);
  truth.max_relative_error = sum.max_relative_error;
  truth.z = squares(band, truth.natural_hz);
  for (const Complex z : truth.z) {
    core::check_interrupt();
    truth.H.push_back(receptance_at(sum, z));
  }
  truth.units = common_units(interface.dofs, truth.H);
  return truth;
}

double max_receptance_error(const ReducedModel& model, const BandTruth& truth) {
  double worst = 0.0;
  for (std::size_t i = 0; i < truth.z.size(); ++i) {
    const double error = relative_error(receptance_at(model, truth.units.size(), truth.z[i]), truth.H[i], truth.units);
    worst = worse_of(worst, error);
  }
  return worst;
}

}  // namespace thinwall::reduction
