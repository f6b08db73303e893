#include "milling/structure/relative_structure.hpp"

#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"

namespace thinwall::milling {

namespace {

using std::complex;

Eigen::Matrix3Xd displacement_rows(const dynamics::DofTable& dofs, const std::string& point) {
  Eigen::Matrix3Xd rows(3, static_cast<Eigen::Index>(dofs.size()));
  for (int axis = 0; axis < 3; ++axis) {
    rows.row(axis) = dynamics::displacement_row(dofs, point, Eigen::Vector3d::Unit(axis)).transpose();
  }
  return rows;
}

void require_decaying(complex<double> pole, Eigen::Index index) {
  if (pole.real() < 0.0) return;
  std::ostringstream text;
  text << "structure at the cut: pole " << index + 1 << " at " << std::abs(pole) / (2.0 * std::numbers::pi)
       << " Hz has real part " << pole.real()
       << " rad/s, must be negative; give the mode damping, or fix the part against rigid motion";
  throw core::InputError(text.str());
}

// Indices of one pole of every conjugate pair, and of the real poles.
std::vector<Eigen::Index> independent_poles(const Eigen::VectorXcd& poles) {
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index k = 0; k < poles.size(); ++k) {
    const complex<double> pole = poles(k);
    require_decaying(pole, k);
    chosen.push_back(k);
    if (pole.imag() == 0.0) continue;
    const bool paired =
        pole.imag() > 0.0 && k + 1 < poles.size() && std::abs(poles(k + 1) - std::conj(pole)) <= 1e-9 * std::abs(pole);
    if (!paired) {
      throw core::InputError("structure at the cut: pole " + std::to_string(k + 1) +
                             " has no conjugate beside it; list complex poles in pairs, positive imaginary part first");
    }
    ++k;
  }
  return chosen;
}

void require_finite(const dynamics::ModalModel& model) {
  if (model.poles.allFinite() && model.right.allFinite() && model.left.allFinite() && model.scaling.allFinite() &&
      model.residual.allFinite() && (model.scaling.array() != 0.0).all()) {
    return;
  }
  throw core::DataError(
      "structure at the cut: a pole, shape, scaling or residual is not finite, or a modal scaling is 0; check the "
      "modal model");
}

}  // namespace

RelativeStructure relative_structure(const dynamics::ModalModel& model, const std::string& point) {
  require_finite(model);
  const Eigen::Matrix3Xd rows = displacement_rows(model.dofs, point);
  const auto chosen = independent_poles(model.poles);
  RelativeStructure structure;
  structure.poles = model.poles(chosen);
  structure.phi = rows * model.right(Eigen::all, chosen);
  structure.b = rows * model.left(Eigen::all, chosen) * model.scaling(chosen).cwiseInverse().asDiagonal();
  if (model.residual.size() > 0) structure.R = rows * model.residual * rows.transpose();
  return structure;
}

ForcePair force_pair(const dynamics::ModalModel& model, const std::string& cut, const std::string& first,
                     const std::string& second, const Eigen::Vector3d& direction, Eigen::Index further) {
  require_finite(model);
  const Eigen::RowVectorXd apart = (dynamics::displacement_row(model.dofs, first, direction) -
                                    dynamics::displacement_row(model.dofs, second, direction))
                                       .transpose();
  const auto chosen = independent_poles(model.poles);
  const auto poles = static_cast<Eigen::Index>(chosen.size());
  // The cut acts on the part with the opposite of the force on the tool, and the tool moves against the part: states at
  // the cut are those of the part with the other sign.
  ForcePair pair{Eigen::VectorXcd::Zero(poles + further), Eigen::VectorXcd::Zero(poles + further)};
  pair.phi.head(poles) = -(apart * model.right(Eigen::all, chosen)).transpose();
  pair.b.head(poles) =
      -(apart * model.left(Eigen::all, chosen) * model.scaling(chosen).cwiseInverse().asDiagonal()).transpose();
  if (model.residual.size() == 0) return pair;
  const Eigen::Matrix3Xd at_cut = displacement_rows(model.dofs, cut);
  pair.at_cut = -at_cut * model.residual * apart.transpose();
  pair.from_cut = -at_cut * model.residual.transpose() * apart.transpose();
  pair.residual = (apart * model.residual * apart.transpose())(0);
  return pair;
}

RelativeStructure sum(const RelativeStructure& a, const RelativeStructure& b) {
  const Eigen::Index count = a.poles.size() + b.poles.size();
  RelativeStructure both{Eigen::VectorXcd(count), Eigen::Matrix3Xcd(3, count), Eigen::Matrix3Xcd(3, count), a.R + b.R};
  both.poles << a.poles, b.poles;
  both.phi << a.phi, b.phi;
  both.b << a.b, b.b;
  return both;
}

Eigen::Matrix3cd receptance(const RelativeStructure& structure, double omega_rad_s) {
  const complex<double> i_omega(0.0, omega_rad_s);
  Eigen::Matrix3cd G = Eigen::Matrix3cd::Zero();
  for (Eigen::Index k = 0; k < structure.poles.size(); ++k) {
    const complex<double> pole = structure.poles(k);
    const Eigen::Vector3cd phi = structure.phi.col(k), b = structure.b.col(k);
    const complex<double> gain = 1.0 / (i_omega - pole);
    G.noalias() += phi * (gain * b).transpose();
    if (pole.imag() == 0.0) continue;
    const complex<double> conjugate_gain = 1.0 / (i_omega - std::conj(pole));
    G.noalias() += phi.conjugate() * (conjugate_gain * b.conjugate()).transpose();
  }
  return G + structure.R;
}

double residual_share(const RelativeStructure& structure) {
  const double residual = structure.R.norm();
  return residual == 0.0 ? 0.0 : residual / receptance(structure, 0.0).norm();
}

RelativeStructure in_tool_axes(const RelativeStructure& structure, const ToolFrame& frame) {
  const Eigen::Matrix3d R = frame.rotation().transpose();
  return {structure.poles, R * structure.phi, R * structure.b, R * structure.R * R.transpose()};
}

Eigen::Matrix3Xd yielding_directions(const RelativeStructure& structure, bool chip_sees_axis) {
  const Eigen::Index poles = structure.poles.size();
  // An unsymmetric structure may move along one direction and feel forces along another.
  Eigen::Matrix3Xd motion(3, 4 * poles + 6);
  for (Eigen::Index k = 0; k < poles; ++k) {
    const Eigen::Vector3cd moves = structure.phi.col(k) * structure.b.col(k).norm() / std::abs(structure.poles(k));
    const Eigen::Vector3cd feels = structure.b.col(k) * structure.phi.col(k).norm() / std::abs(structure.poles(k));
    motion.middleCols<4>(4 * k) << moves.real(), moves.imag(), feels.real(), feels.imag();
  }
  motion.rightCols<6>() << structure.R, structure.R.transpose();
  const double largest = motion.norm();
  if (!((chip_sees_axis ? largest : motion.topRows<2>().norm()) > 1e-12 * largest)) {
    throw core::InputError(
        "structure at the cut: no mode moves in the plane of the cut, at least one must; check the feed and the tool "
        "axis");
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(motion, Eigen::ComputeFullU);
  const auto directions = (svd.singularValues().array() > 1e-12 * largest).count();
  return svd.matrixU().leftCols(directions);
}

}  // namespace thinwall::milling
