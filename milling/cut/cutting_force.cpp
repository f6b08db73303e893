#include "milling/cut/cutting_force.hpp"

#include <cmath>
#include <numbers>

namespace thinwall::milling {

namespace {

// D(φ) needs only these three products of sine and cosine; their means are the means of 1, cos 2φ and sin 2φ.
DirectionalMatrix from_products(const CuttingCoefficients& k, double sin_sin, double sin_cos, double cos_cos) {
  DirectionalMatrix D;
  D << k.K_t * sin_cos + k.K_r * sin_sin, k.K_t * cos_cos + k.K_r * sin_cos,   //
      -k.K_t * sin_sin + k.K_r * sin_cos, -k.K_t * sin_cos + k.K_r * cos_cos,  //
      0.0, 0.0;
  return D;
}

// rᵀ is linear in sine and cosine, so the axial row has its own mean.
void add_axial_row(const CuttingCoefficients& k, double sine, double cosine, DirectionalMatrix& D) {
  D(2, 0) = -k.K_a * sine;
  D(2, 1) = -k.K_a * cosine;
}

double sinc(double x) {
  return std::abs(x) < 1e-4 ? 1.0 - x * x / 6.0 : std::sin(x) / x;
}

/// Products of sine and cosine of φ, at an angle or their means over an arc.
struct Products {
  double sin_sin, sin_cos, cos_cos, sine, cosine;
};

Products at_angle(double phi) {
  const double s = std::sin(phi);
  const double c = std::cos(phi);
  return {s * s, s * c, c * c, s, c};
}

Products over_arc(double from, double to) {
  const double half = 0.5 * (to - from);
  const double middle = 0.5 * (from + to);
  const double cos_double = std::cos(2.0 * middle) * sinc(2.0 * half);
  const double sin_double = std::sin(2.0 * middle) * sinc(2.0 * half);
  return {0.5 * (1.0 - cos_double), 0.5 * sin_double, 0.5 * (1.0 + cos_double), std::sin(middle) * sinc(half),
          std::cos(middle) * sinc(half)};
}

DirectionalMatrix in_plane(const CuttingCoefficients& k, const Products& p) {
  DirectionalMatrix D = from_products(k, p.sin_sin, p.sin_cos, p.cos_cos);
  add_axial_row(k, p.sine, p.cosine, D);
  return D;
}

/// The force per chip is K_t t + K_r n − K_a a = K_t t + P r − Q z_T; chips see sin κ r − cos κ z_T.
Eigen::Matrix3d with_kappa(const CuttingCoefficients& k, double kappa, const Products& p) {
  const double s = std::sin(kappa);
  const double c = kappa == 0.5 * std::numbers::pi ? 0.0 : std::cos(kappa);
  const CuttingCoefficients turned{k.K_t, k.K_r * s - k.K_a * c, k.K_r * c + k.K_a * s, 0.0, 0.0, 0.0};
  Eigen::Matrix3d D;
  D.leftCols<2>() = s * in_plane(turned, p);
  D.col(2) = -c * Eigen::Vector3d(turned.K_t * p.cosine + turned.K_r * p.sine,
                                  -turned.K_t * p.sine + turned.K_r * p.cosine, -turned.K_a);
  return D;
}

}  // namespace

std::vector<std::string> validate(const CuttingCoefficients& k) {
  std::vector<std::string> violations;
  const Eigen::Matrix<double, 6, 1> all{k.K_t, k.K_r, k.K_a, k.K_te, k.K_re, k.K_ae};
  if (!all.allFinite())
    violations.emplace_back("cutting coefficients: one is not a finite number; give numbers in N/m² and N/m");
  if (k.K_t < 0.0) {
    violations.push_back("cutting coefficients: K_t = " + std::to_string(k.K_t) +
                         " N/m², must not be negative; the tangential force acts against the tooth's motion");
  }
  if (k.K_t == 0.0 && k.K_r == 0.0 && k.K_a == 0.0) {
    violations.emplace_back("cutting coefficients: K_t, K_r and K_a are all 0 N/m², one must not be; give K_t");
  }
  return violations;
}

DirectionalMatrix directional_matrix(const CuttingCoefficients& coefficients, double phi_rad) {
  return in_plane(coefficients, at_angle(phi_rad));
}

DirectionalMatrix mean_directional_matrix(const CuttingCoefficients& coefficients, double from_rad, double to_rad) {
  return in_plane(coefficients, over_arc(from_rad, to_rad));
}

Eigen::Matrix3d directional_matrix_on(const CuttingCoefficients& coefficients, double kappa_rad, double phi_rad) {
  return with_kappa(coefficients, kappa_rad, at_angle(phi_rad));
}

Eigen::Matrix3d mean_directional_matrix_on(const CuttingCoefficients& coefficients, double kappa_rad, double from_rad,
                                           double to_rad) {
  return with_kappa(coefficients, kappa_rad, over_arc(from_rad, to_rad));
}

DirectionalMatrix mean_directional_matrix(const CuttingCoefficients& coefficients, const Cutter& cutter,
                                          const Engagement& engagement, int teeth, double from_rad, double to_rad) {
  DirectionalMatrix sum = DirectionalMatrix::Zero();
  for (int j = 0; j < teeth; ++j) {
    const double ahead = engagement.entry_rad + j * cutter.pitch_rad();
    sum += mean_directional_matrix(coefficients, ahead + from_rad, ahead + to_rad);
  }
  return sum;
}

Eigen::Matrix3d directional_matrix(const CuttingCoefficients& coefficients, const Cutter& cutter,
                                   const Engagement& engagement, const ToolFrame& frame, double theta_rad) {
  DirectionalMatrix sum = DirectionalMatrix::Zero();
  for (const CutSegment& segment : cut_segments(engagement, cutter)) {
    if (theta_rad < segment.from_rad || theta_rad >= segment.to_rad) continue;
    for (int j = 0; j < segment.teeth; ++j) {
      sum += directional_matrix(coefficients, engagement.entry_rad + theta_rad + j * cutter.pitch_rad());
    }
  }
  const Eigen::Matrix3d R = frame.rotation();
  return R * sum * R.leftCols<2>().transpose();
}

}  // namespace thinwall::milling
