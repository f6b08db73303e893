#include "mesh/planar/bend.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::mesh {

std::vector<std::string> violations(const Bend& bend, const Positions& positions) {
  std::vector<std::string> found;
  std::ostringstream text;
  const auto report = [&] {
    found.push_back(text.str());
    text.str("");
  };
  if (bend.along < 0 || bend.along > 2 || bend.through < 0 || bend.through > 2 || bend.along == bend.through) {
    text << "the bend's axes are along " << bend.along << " and through " << bend.through
         << "; give two different ones of 0 (x), 1 (y), 2 (z)";
    report();
    return found;
  }
  if (!std::isfinite(bend.radius_m) || !std::isfinite(bend.start_m) || !std::isfinite(bend.middle_m)) {
    text << "the bend's radius, start and middle are " << bend.radius_m << ", " << bend.start_m << " and "
         << bend.middle_m << " m; give finite lengths";
    report();
    return found;
  }
  if (positions.rows() == 0) return found;
  const double radius = std::abs(bend.radius_m);
  const double half = (positions.col(bend.through).array() - bend.middle_m).abs().maxCoeff();
  if (!(radius > half)) {
    text << "the bend's radius is " << bend.radius_m * 1e3 << " mm; its size must be above " << half * 1e3
         << " mm, the largest distance from the mid-surface: take a larger radius or a thinner wall";
    report();
  }
  const double arc = positions.col(bend.along).maxCoeff() - positions.col(bend.along).minCoeff();
  if (!(arc < 2.0 * std::numbers::pi * radius)) {
    text << "the bend turns " << arc * 1e3 << " mm about a radius of " << bend.radius_m * 1e3 << " mm, "
         << arc / radius * 180.0 / std::numbers::pi
         << " degrees; it must be below 360: take a larger radius or a shorter part";
    report();
  }
  return found;
}

Eigen::Vector3d bent(const Bend& bend, const Eigen::Vector3d& x) {
  const double angle = (x[bend.along] - bend.start_m) / bend.radius_m;
  const double w = x[bend.through] - bend.middle_m;
  const double half_sine = std::sin(0.5 * angle);
  Eigen::Vector3d result = x;
  result[bend.along] = bend.start_m + (bend.radius_m + w) * std::sin(angle);
  // This is w cos φ − R (1 − cos φ), written so that a large radius causes no cancellation.
  result[bend.through] = bend.middle_m + w * std::cos(angle) - 2.0 * bend.radius_m * half_sine * half_sine;
  return result;
}

Eigen::Vector3d unbent(const Bend& bend, const Eigen::Vector3d& x) {
  const double u = x[bend.along] - bend.start_m;
  const double v = x[bend.through] - bend.middle_m;
  const double sign = std::copysign(1.0, bend.radius_m);
  const double r = std::hypot(u, v + bend.radius_m);
  Eigen::Vector3d result = x;
  result[bend.along] = bend.start_m + bend.radius_m * std::atan2(sign * u, sign * (v + bend.radius_m));
  // w = ±r − R is computed as (r² − R²) / (±r + R), again to avoid cancellation.
  result[bend.through] = bend.middle_m + (u * u + v * (v + 2.0 * bend.radius_m)) / (sign * r + bend.radius_m);
  return result;
}

Eigen::Matrix3d rotation_at(const Bend& bend, const Eigen::Vector3d& x) {
  const double angle = (x[bend.along] - bend.start_m) / bend.radius_m;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  rotation(bend.along, bend.along) = std::cos(angle);
  rotation(bend.through, bend.along) = -std::sin(angle);
  rotation(bend.along, bend.through) = std::sin(angle);
  rotation(bend.through, bend.through) = std::cos(angle);
  return rotation;
}

void bend(const Bend& bend, Positions& positions) {
  std::string all;
  for (const auto& violation : violations(bend, positions)) all += (all.empty() ? "" : "; ") + violation;
  if (!all.empty()) throw core::InputError(all);
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
    positions.row(i) = bent(bend, positions.row(i).transpose()).transpose();
}

}  // namespace thinwall::mesh
