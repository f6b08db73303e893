// A plate by closed-form modes, with two points as physical DOFs, held by a robot of one mode.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "core/dense_factorisations.hpp"
#include "coupling/receptance.hpp"
#include "coupling/route_difference.hpp"
#include "coupling/spatial.hpp"
#include "robot/measured.hpp"
#include "robot/one_mode.hpp"

namespace thinwall::coupling::closed_form_plate_test {
namespace {

using std::numbers::pi;
constexpr double rigid = std::numeric_limits<double>::infinity();

struct PlateMode {
  double omega;
  Eigen::Matrix<double, 6, 1> shape;  // mass-normalised, P.x P.y P.z Q.x Q.y Q.z
};

/// A simply supported steel plate 400 × 100 × 6 mm: bending modes ω = π² √(D/ρh) (m²/a² + n²/b²) along x (Leissa 1969,
/// Eq. 4.20), and stretching modes ω = c π √(m²/a² + n²/b²) in its plane.
std::vector<PlateMode> plate_modes() {
  const double E = 210e9, nu = 0.3, rho = 7850.0, a = 0.4, b = 0.1, h = 0.006;
  const double bending = std::sqrt(E * h * h / (12.0 * rho * (1.0 - nu * nu)));
  const double sound = std::sqrt(E / rho);
  const double amplitude = 2.0 / std::sqrt(rho * a * b * h);
  const double y_P = 0.19, y_Q = 0.21, z_P = 0.085, z_Q = 0.085;
  std::vector<PlateMode> modes;
  for (int m = 1; m <= 10; ++m) {
    for (int n = 1; n <= 4; ++n) {
      const double ky = m * pi / a, kz = n * pi / b, k = std::hypot(ky, kz);
      PlateMode out_of_plane{bending * k * k, Eigen::Matrix<double, 6, 1>::Zero()};
      out_of_plane.shape(0) = amplitude * std::sin(ky * y_P) * std::sin(kz * z_P);
      out_of_plane.shape(3) = amplitude * std::sin(ky * y_Q) * std::sin(kz * z_Q);
      modes.push_back(out_of_plane);
      if (m > 3 || n > 2) continue;
      PlateMode in_plane{sound * k, Eigen::Matrix<double, 6, 1>::Zero()};
      in_plane.shape << 0.0, ky / k * std::cos(ky * y_P) * std::sin(kz * z_P),
          kz / k * std::sin(ky * y_P) * std::cos(kz * z_P), 0.0, ky / k * std::cos(ky * y_Q) * std::sin(kz * z_Q),
          kz / k * std::sin(ky * y_Q) * std::cos(kz * z_Q);
      in_plane.shape *= amplitude;
      modes.push_back(in_plane);
    }
  }
  return modes;
}

/// The plate as matrices over (u_P, u_Q, remaining modal amplitudes): six amplitudes, chosen by pivoting, are replaced
/// by the six displacements u = Φ q, as a Craig-Bampton model has them. Modal damping ζ in every mode.
dynamics::SpatialModel plate(double zeta) {
  const auto modes = plate_modes();
  const auto n = static_cast<Eigen::Index>(modes.size());
  Eigen::MatrixXd Phi(6, n);
  Eigen::VectorXd omega(n);
  for (Eigen::Index r = 0; r < n; ++r) {
    Phi.col(r) = modes[static_cast<std::size_t>(r)].shape;
    omega(r) = modes[static_cast<std::size_t>(r)].omega;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> pivoted(Phi);
  const Eigen::VectorXi order = pivoted.colsPermutation().indices();
  const Eigen::MatrixXd sorted = Phi(Eigen::all, order);
  const Eigen::VectorXd w = omega(order);
  Eigen::MatrixXd q_of_y = Eigen::MatrixXd::Identity(n, n);
  const Eigen::PartialPivLU<Eigen::MatrixXd> replaced(sorted.leftCols(6));
  q_of_y.topLeftCorner(6, 6) = replaced.inverse();
  q_of_y.topRightCorner(6, n - 6) = -replaced.solve(sorted.rightCols(n - 6));
  dynamics::DofTable dofs = dynamics::translations("P");
  for (const auto& dof : dynamics::translations("Q")) dofs.push_back(dof);
  for (Eigen::Index r = 6; r < n; ++r) {
    dofs.push_back({"mode " + std::to_string(r), Eigen::Vector3d::Zero(), dynamics::DofKind::modal});
  }
  return {q_of_y.transpose() * q_of_y, q_of_y.transpose() * (2.0 * zeta * w).asDiagonal() * q_of_y,
          q_of_y.transpose() * w.cwiseAbs2().asDiagonal() * q_of_y, Eigen::MatrixXd(), dofs};
}

class ClosedFormPlate : public ::testing::Test {
 protected:
  const dynamics::SpatialModel part = plate(0.003);
  const dynamics::SpatialModel robot =
      robot::spatial_model({robot::one_mode(29.0, 0.02, 1.7e6, Eigen::Vector3d::UnitX())}, "R");
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(0.5, 5000.0, 2000);
  const dynamics::ResponseModel H_part = dynamics::to_response(dynamics::to_modal(part), axis);
  const dynamics::ResponseModel H_robot = dynamics::to_response(dynamics::to_modal(robot), axis);
};

TEST_F(ClosedFormPlate, ComponentKeepsItsClosedFormModes) {
  std::vector<double> expected;
  for (const PlateMode& mode : plate_modes()) expected.push_back(mode.omega);
  std::sort(expected.begin(), expected.end());
  const auto found = dynamics::undamped_modes(part).omega_rad_s;
  for (std::size_t r = 0; r < expected.size(); ++r) {
    EXPECT_NEAR(found(static_cast<Eigen::Index>(r)) / expected[r], 1.0, 1e-10) << r;
  }
}

TEST_F(ClosedFormPlate, RoutesAgreeFromHalfAHertzToFiveKilohertz) {
  for (const Eigen::Vector3d& direction : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.96, 0.168, 0.224)}) {
    for (const double K : {1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e12, rigid}) {
      const std::vector<Contact> contacts{{"P", "R", {{direction, K, 0.0, 0.0}}}};
      const auto spatial = direct_response(couple(part, robot, contacts), axis);
      const auto receptance = couple(H_part, H_robot, contacts).response;
      for (const char* point : {"P", "Q"}) {
        const RouteDifference difference = route_difference(spatial, receptance, point, point);
        std::cout << "K " << K << ", " << point << ": " << difference.max_relative << " in " << difference.entry
                  << " at " << difference.at_frequency_hz << " Hz\n";
        EXPECT_LE(difference.max_relative, K == 1e12 ? 1e-8 : 1e-9) << "K " << K << " at " << point;
      }
      for (const auto& G : receptance.H) EXPECT_LE(G.diagonal().imag().maxCoeff(), 0.0);
      for (const auto& G : spatial.H) EXPECT_LE(G.diagonal().imag().maxCoeff(), 0.0);
    }
  }
}

TEST_F(ClosedFormPlate, MeasuredRobotGivesWhatItsModelGives) {
  const auto measured =
      robot::measured_receptance(axis, dynamics::entry(H_robot, "R.x", "R.x"), "R", Eigen::Vector3d::UnitX());
  for (const double K : {1e6, 1e9, rigid}) {
    const std::vector<Contact> contacts{{"P", "R", {{Eigen::Vector3d::UnitX(), K, 0.0, 0.0}}}};
    const auto spatial = direct_response(couple(part, robot, contacts), axis);
    const auto mixed = direct_response(part, measured, contacts, axis);
    EXPECT_LE(route_difference(spatial, mixed, "P", "Q").max_relative, 1e-9) << K;
  }
}

TEST_F(ClosedFormPlate, TheNineEntriesAreThoseOfThePaper) {
  // Barrios 2019, Eq. 12-14, written out entry by entry with scalars only
  const double K = 1e8;
  const std::vector<Contact> contacts{{"P", "R", {{Eigen::Vector3d::UnitX(), K, 0.0, 0.0}}}};
  const auto coupled = between(couple(H_part, H_robot, contacts).response, "P", "P");
  const auto part_P = between(H_part, "P", "P");
  for (std::size_t line = 0; line < coupled.H.size(); ++line) {
    const Eigen::MatrixXcd& H = part_P.H[line];
    const std::complex<double> kernel = H(0, 0) + H_robot.H[line](0, 0) + 1.0 / K;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        const std::complex<double> G = H(a, b) - H(a, 0) / kernel * H(0, b);
        EXPECT_LT(std::abs(coupled.H[line](a, b) - G), 1e-14 * H.cwiseAbs().maxCoeff());
      }
    }
  }
}

}  // namespace
}  // namespace thinwall::coupling::closed_form_plate_test
