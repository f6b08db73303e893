#include "milling/cutting_force.hpp"

#include <cmath>

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
  const double s = std::sin(phi_rad);
  const double c = std::cos(phi_rad);
  DirectionalMatrix D = from_products(coefficients, s * s, s * c, c * c);
  add_axial_row(coefficients, s, c, D);
  return D;
}

DirectionalMatrix mean_directional_matrix(const CuttingCoefficients& coefficients, double from_rad, double to_rad) {
  const double half = 0.5 * (to_rad - from_rad);
  const double middle = 0.5 * (from_rad + to_rad);
  const double cos_double = std::cos(2.0 * middle) * sinc(2.0 * half);
  const double sin_double = std::sin(2.0 * middle) * sinc(2.0 * half);
  DirectionalMatrix D =
      from_products(coefficients, 0.5 * (1.0 - cos_double), 0.5 * sin_double, 0.5 * (1.0 + cos_double));
  add_axial_row(coefficients, std::sin(middle) * sinc(half), std::cos(middle) * sinc(half), D);
  return D;
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
