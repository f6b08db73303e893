#include "dynamics/beam_element.hpp"

#include <cmath>
#include <numbers>

#include "core/gauss_rule.hpp"

namespace thinwall::dynamics {

namespace {

/// Constants of bending in one plane: EI, κGA, and the ratio ϕ = 12EI/κGAL² of shear to bending flexibility.
struct Bending {
  double EI;
  double GA;
  double phi;
};

Bending in_xy(const BeamSection& s, double L) {
  const double EI = s.youngs_modulus_Pa * s.I_z_m4;
  const double GA = s.shear_y * s.shear_modulus_Pa * s.area_m2;
  return {EI, GA, 12.0 * EI / (GA * L * L)};
}

Bending in_xz(const BeamSection& s, double L) {
  const double EI = s.youngs_modulus_Pa * s.I_y_m4;
  const double GA = s.shear_z * s.shear_modulus_Pa * s.area_m2;
  return {EI, GA, 12.0 * EI / (GA * L * L)};
}

/// The 6 × 6 matrix with a 2 × 2 matrix of (v, θ_z), one of (w, −θ_y), and the entries for stretching and torsion at
/// their places.
Matrix6 placed(double stretching, double torsion, const Eigen::Matrix2d& xy, const Eigen::Matrix2d& xz) {
  Matrix6 six = Matrix6::Zero();
  six(0, 0) = stretching;
  six(3, 3) = torsion;
  six({1, 5}, {1, 5}) = xy;
  six({2, 4}, {2, 4}) = xz.cwiseProduct(Eigen::Matrix2d{{1.0, -1.0}, {-1.0, 1.0}});
  return six;
}

Eigen::Matrix2d compliance(const Bending& b, double L) {
  const double both = L * L / (2.0 * b.EI);
  return Eigen::Matrix2d{{L * L * L / (3.0 * b.EI) + L / b.GA, both}, {both, L / b.EI}};
}

Eigen::Matrix2d stiffness(const Bending& b, double L) {
  const double k = b.EI / ((1.0 + b.phi) * L);
  return k * Eigen::Matrix2d{{12.0 / (L * L), -6.0 / L}, {-6.0 / L, 4.0 + b.phi}};
}

/// Deflection and rotation at ξ = x/L from (v₁, θ₁, v₂, θ₂) (Friedman & Kosmatka 1993, Eq. 20-23).
Eigen::Matrix<double, 2, 4> bending_motion(double phi, double L, double xi) {
  const double xi2 = xi * xi;
  const double xi3 = xi2 * xi;
  const double bent = (xi2 - xi) * 6.0 / L;
  Eigen::Matrix<double, 2, 4> N;
  N << 2.0 * xi3 - 3.0 * xi2 - phi * xi + 1.0 + phi,                 //
      L * (xi3 - (2.0 + phi / 2.0) * xi2 + (1.0 + phi / 2.0) * xi),  //
      -2.0 * xi3 + 3.0 * xi2 + phi * xi,                             //
      L * (xi3 - (1.0 - phi / 2.0) * xi2 - phi / 2.0 * xi),          //
      bent, 3.0 * xi2 - (4.0 + phi) * xi + 1.0 + phi, -bent, 3.0 * xi2 - (2.0 - phi) * xi;
  return N / (1.0 + phi);
}

void require_positive(double value, const std::string& where, const char* what, core::Faults& faults) {
  faults.require_number(value, value > 0.0, where, what, "be positive");
}

}  // namespace

void check(const Tube& tube, const std::string& where, core::Faults& faults) {
  require_positive(tube.outer_diameter_m, where, "outer diameter (m)", faults);
  faults.require_number(tube.inner_diameter_m,
                        tube.inner_diameter_m >= 0.0 && tube.inner_diameter_m < tube.outer_diameter_m, where,
                        "inner diameter (m)", "not be negative, and be smaller than the outer one");
  require_positive(tube.youngs_modulus_Pa, where, "Young's modulus (Pa)", faults);
  faults.require_number(tube.poisson_ratio, tube.poisson_ratio >= 0.0 && tube.poisson_ratio < 0.5, where,
                        "Poisson's ratio", "lie in 0 <= nu < 0.5");
  require_positive(tube.density_kg_m3, where, "density (kg/m^3)", faults);
}

BeamSection section(const Tube& tube) {
  core::Faults faults;
  check(tube, "the section", faults);
  faults.raise("beam");
  const double D = tube.outer_diameter_m;
  const double d = tube.inner_diameter_m;
  const double nu = tube.poisson_ratio;
  const double m2 = (d / D) * (d / D);
  const double I = std::numbers::pi / 64.0 * (D * D - d * d) * (D * D + d * d);
  const double square = (1.0 + m2) * (1.0 + m2);
  const double kappa = 6.0 * (1.0 + nu) * square / ((7.0 + 6.0 * nu) * square + (20.0 + 12.0 * nu) * m2);
  return {.youngs_modulus_Pa = tube.youngs_modulus_Pa,
          .shear_modulus_Pa = tube.youngs_modulus_Pa / (2.0 * (1.0 + nu)),
          .density_kg_m3 = tube.density_kg_m3,
          .area_m2 = std::numbers::pi / 4.0 * (D - d) * (D + d),
          .I_y_m4 = I,
          .I_z_m4 = I,
          .J_m4 = 2.0 * I,
          .shear_y = kappa,
          .shear_z = kappa};
}

void check(const BeamSection& s, const std::string& where, core::Faults& faults) {
  require_positive(s.youngs_modulus_Pa, where, "Young's modulus (Pa)", faults);
  require_positive(s.shear_modulus_Pa, where, "shear modulus (Pa)", faults);
  require_positive(s.density_kg_m3, where, "density (kg/m^3)", faults);
  require_positive(s.area_m2, where, "area (m^2)", faults);
  require_positive(s.I_y_m4, where, "second moment of area I_y (m^4)", faults);
  require_positive(s.I_z_m4, where, "second moment of area I_z (m^4)", faults);
  require_positive(s.J_m4, where, "torsion constant (m^4)", faults);
  faults.require(s.shear_y > 0.0 && s.shear_z > 0.0, where, "has a shear factor that is not positive");
}

Matrix6 tip_compliance(const BeamSection& s, double L) {
  return placed(L / (s.youngs_modulus_Pa * s.area_m2), L / (s.shear_modulus_Pa * s.J_m4), compliance(in_xy(s, L), L),
                compliance(in_xz(s, L), L));
}

Matrix6 tip_stiffness(const BeamSection& s, double L) {
  return placed(s.youngs_modulus_Pa * s.area_m2 / L, s.shear_modulus_Pa * s.J_m4 / L, stiffness(in_xy(s, L), L),
                stiffness(in_xz(s, L), L));
}

Eigen::Matrix<double, 6, 12> section_motion(const BeamSection& s, double L, double xi) {
  Eigen::Matrix<double, 6, 12> N = Eigen::Matrix<double, 6, 12>::Zero();
  for (const int linear : {0, 3}) N(linear, {linear, linear + 6}) = Eigen::RowVector2d(1.0 - xi, xi);
  N({1, 5}, {1, 5, 7, 11}) = bending_motion(in_xy(s, L).phi, L, xi);
  // θ_y = −w'
  const Eigen::Matrix<double, 2, 4> xz = bending_motion(in_xz(s, L).phi, L, xi);
  const Eigen::RowVector4d sign(1.0, -1.0, 1.0, -1.0);
  N(2, {2, 4, 8, 10}) = xz.row(0).cwiseProduct(sign);
  N(4, {2, 4, 8, 10}) = -xz.row(1).cwiseProduct(sign);
  return N;
}

Matrix12 beam_stiffness(const BeamSection& s, double L) {
  Eigen::Matrix<double, 6, 12> G;
  G << -transport(L * Eigen::Vector3d::UnitX()), Matrix6::Identity();
  const Matrix12 K = G.transpose() * tip_stiffness(s, L) * G;
  return 0.5 * (K + K.transpose());
}

Matrix12 beam_mass(const BeamSection& s, double L) {
  Eigen::Vector<double, 6> Q;
  Q << Eigen::Vector3d::Constant(s.area_m2), s.I_y_m4 + s.I_z_m4, s.I_y_m4, s.I_z_m4;
  const core::GaussRule rule = core::gauss_legendre(4);  // exact to degree 7; the integrand has degree 6
  Matrix12 M = Matrix12::Zero();
  for (Eigen::Index q = 0; q < rule.node.size(); ++q) {
    const Eigen::Matrix<double, 6, 12> N = section_motion(s, L, rule.node(q));
    M += rule.weight(q) * s.density_kg_m3 * L * N.transpose() * Q.asDiagonal() * N;
  }
  return 0.5 * (M + M.transpose());
}

}  // namespace thinwall::dynamics
