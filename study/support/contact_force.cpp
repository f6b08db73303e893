#include "study/support/contact_force.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "coupling/sensitivity.hpp"
#include "dynamics/conversion.hpp"
#include "setup/contact_model.hpp"
#include "setup/milling_process.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr Index harmonics = 64;

/// F_k of the force on the part, part axes, k = 0 … harmonics: columns. Trapezoids over the samples, which begin and
/// end a period.
Eigen::Matrix3Xcd force_harmonics(const milling::ForcedVibration& cut, const Eigen::Matrix3d& R) {
  const Index n = cut.rotation_rad.size();
  const Eigen::ArrayXd share =
      (cut.rotation_rad.array() - cut.rotation_rad(0)) / (cut.rotation_rad(n - 1) - cut.rotation_rad(0));
  Eigen::ArrayXd weight = Eigen::ArrayXd::Zero(n);
  weight.head(n - 1) += 0.5 * (share.tail(n - 1) - share.head(n - 1));
  weight.tail(n - 1) += 0.5 * (share.tail(n - 1) - share.head(n - 1));
  const Eigen::Matrix3Xd force = -(R * cut.force_n) * weight.matrix().asDiagonal();
  Eigen::Matrix3Xcd F(3, harmonics + 1);
  for (Index k = 0; k <= harmonics; ++k) {
    const Eigen::ArrayXd phase = 2.0 * std::numbers::pi * static_cast<double>(k) * share;
    const Eigen::VectorXcd turn = phase.cos() - Complex(0.0, 1.0) * phase.sin();
    F.col(k) = force * turn * (k > 0 ? 2.0 : 1.0);  // both signs of the frequency
  }
  return F;
}

dynamics::ResponseModel response_on(const Component& known, const dynamics::FrequencyAxis& axis) {
  // Modes say the same where damping is viscous, without a factorisation a line.
  if (known.spatial && (!known.modal || known.spatial->has_structural_damping()))
    return dynamics::direct_response(*known.spatial, axis);
  if (known.modal) return dynamics::to_response(*known.modal, axis);
  throw core::InputError("the force on a contact needs a part and a robot that are known by models");
}

}  // namespace

std::pair<double, Eigen::Vector3d> pressing_force(const setup::SupportSetup& source) {
  const Eigen::Vector3d& on_tip = source.robot->preload;
  const setup::SupportContact& first = source.contacts.front();
  if (const auto preload = setup::preload_of(source, first); preload && source.contacts.size() == 1) {
    const Eigen::Vector3d& normal = first.directions.front();
    return {*preload, on_tip.dot(normal) < 0.0 ? Eigen::Vector3d(-normal) : normal};
  }
  if (!(on_tip.norm() > 0.0))
    throw core::InputError("the force on a contact is compared with its preload, which is zero; give robot.preload");
  return {on_tip.norm(), on_tip.normalized()};
}

ContactForce contact_force(const setup::SupportSetup& support, const std::vector<coupling::Contact>& contacts,
                           const CutPlace& place, const Component& part, const Component& tip,
                           const milling::ForcedVibration& cut) {
  const auto [preload, n] = pressing_force(support);
  dynamics::FrequencyAxis axis{Eigen::VectorXd::LinSpaced(harmonics + 1, 0.0, static_cast<double>(harmonics)) /
                               cut.period_s};
  axis.hz(0) = 1e-3 * axis.hz(1);
  const std::vector<dynamics::ResponseModel> both{response_on(part, axis), response_on(tip, axis)};
  const coupling::CouplingSensitivity sensitivity = coupling::coupling_sensitivity(both, contacts);
  dynamics::DofTable forces = both[0].forces;
  forces.insert(forces.end(), both[1].forces.begin(), both[1].forces.end());
  const Eigen::Matrix3Xd at_tip = dynamics::displacement_matrix(forces, support.robot->point);
  const Eigen::Matrix3Xd at_cut = dynamics::displacement_matrix(sensitivity.forces, place.point);
  const Eigen::Matrix3Xcd F = force_harmonics(cut, place.rotation);
  ContactForce result{preload, preload, preload, false};
  constexpr int samples = 512;
  Eigen::VectorXd force = Eigen::VectorXd::Constant(samples, preload);
  // Forces on the DOFs of the cut that add up to F: their directions are a basis.
  const Eigen::MatrixXd to_dofs = at_cut.completeOrthogonalDecomposition().pseudoInverse();
  for (Index k = 0; k <= harmonics; ++k) {
    const Eigen::VectorXcd on_dofs = to_dofs * F.col(k);
    const Complex along = n.cast<Complex>().dot(at_tip * (sensitivity.Q[static_cast<std::size_t>(k)] * on_dofs));
    for (int i = 0; i < samples; ++i)
      force(i) += (along * std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(k * i) / samples)).real();
  }
  result.least_n = force.minCoeff();
  result.largest_n = force.maxCoeff();
  result.lost = result.least_n < 0.0;
  return result;
}

std::optional<double> depth_of_lost_contact(const std::function<ContactForce(double depth_m)>& force_at,
                                            double deepest_m) {
  constexpr int depths = 8;
  double holds = 0.0, lost = 0.0;
  for (int i = 1; i <= depths && lost == 0.0; ++i) {
    const double depth_m = deepest_m * i / depths;
    (force_at(depth_m).lost ? lost : holds) = depth_m;
  }
  if (lost == 0.0) return std::nullopt;
  for (int i = 0; i < 30 && lost - holds > 0.01 * lost; ++i) {
    const double middle = 0.5 * (holds + lost);
    (force_at(middle).lost ? lost : holds) = middle;
  }
  return holds;
}

}  // namespace thinwall::study
