#include "mesh/surface/size_space.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "core/error.hpp"
#include "mesh/surface/smooth_patches.hpp"
#include "mesh/surface/wall_thickness.hpp"

namespace thinwall::mesh {

namespace {

constexpr double thicknesses_per_size = 9.0;
constexpr double smallest_sizes_per_diagonal = 8.0;

/// The integral ∫ (1 − s²)^½ / s ds, up to a constant.
double stretch_integral(double s) {
  const double c = std::sqrt(std::max(0.0, 1.0 - s * s));
  return c + std::log(s / (1.0 + c));
}

/// φ(d) = ∫₀^d (1/h² − 1/H²)^½ dd with h = h₀ + g d, by the substitution s = h/H. `first`: h₀; growth: g; size: H.
double stretched(double d, double first, double growth, double size) {
  if (first >= size) return 0.0;
  const double s = std::min(1.0, (first + growth * d) / size);
  return (stretch_integral(s) - stretch_integral(first / size)) / growth;
}

/// Signed distance to a region's border, m, negative inside.
double signed_distance(const Region& region, const Eigen::Vector3d& x) {
  if (const auto* ball = std::get_if<SphereRegion>(&region)) return (x - ball->centre).norm() - ball->radius;
  const auto& box = std::get<BoxRegion>(region);
  const Eigen::Vector3d q = (x - 0.5 * (box.min + box.max)).cwiseAbs() - 0.5 * (box.max - box.min);
  return q.cwiseMax(0.0).norm() + std::min(0.0, q.maxCoeff());
}

/// Normals at each triangle's corners, each the area-weighted mean over the triangles of the same patch around the
/// vertex. The normal jumps across a sharp line, so that a vertex there has one normal for each patch.
std::vector<std::array<Eigen::Vector3d, 3>> corner_normals(const TriangleSurface& surface,
                                                           const SurfaceFeatures& features) {
  std::map<std::array<int, 2>, Eigen::Vector3d> sums;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Eigen::Vector3d area = area_vector(surface, static_cast<int>(t));
    for (const int v : surface.triangles[t]) {
      sums.try_emplace({v, features.patch_of_triangle[t]}, Eigen::Vector3d::Zero()).first->second += area;
    }
  }
  std::vector<std::array<Eigen::Vector3d, 3>> result(surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      result[t][k] = sums.at({surface.triangles[t][k], features.patch_of_triangle[t]}).normalized();
  return result;
}

Polyline positions(const TriangleSurface& surface, const FeatureLine& line) {
  Polyline result;
  for (const int v : line.vertices) result.push_back(surface.vertices[static_cast<std::size_t>(v)]);
  return result;
}

/// Radius of about the largest circle in the patch, m: the largest distance of a triangle's centroid from the lines.
double inradius(const TriangleSurface& surface, const std::vector<int>& triangles, const std::vector<int>& lines,
                const std::vector<Polyline>& positions_of) {
  double largest = 0.0;
  for (const int t : triangles) {
    const Eigen::Vector3d x = centroid(surface, t);
    double smallest = std::numeric_limits<double>::infinity();
    for (const int line : lines)
      smallest = std::min(smallest, (nearest_on(positions_of[static_cast<std::size_t>(line)], x) - x).norm());
    largest = std::max(largest, smallest);
  }
  return largest;
}

void check(std::string& wrong, const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  wrong += std::string(wrong.empty() ? "" : ", ") + name + " = " + std::to_string(value) + " (" + std::to_string(low) +
           " to " + std::to_string(high) + ")";
}

}  // namespace

void validate(const SurfaceSize& size) {
  std::string wrong;
  check(wrong, "size_m", size.size_m, 0.0, 1e6);
  check(wrong, "least_plane_m", size.least_plane_m, 0.0, 1e6);
  check(wrong, "scale", size.scale, 0.05, 20.0);
  check(wrong, "layers", size.layers, 0, 4);
  check(wrong, "layer_width_m", size.layer_width_m, 0.0, 1e6);
  check(wrong, "layer_ratio", size.layer_ratio, 0.05, 0.8);
  check(wrong, "turn_rad", size.turn_rad, 0.01, 1.0);
  check(wrong, "deviation", size.deviation, 0.01, 0.5);
  check(wrong, "sharp_angle_rad", size.sharp_angle_rad, 0.05, 2.0);
  for (const auto& region : size.refined)
    if (std::holds_alternative<PlaneRegion>(region)) wrong += wrong.empty() ? "a plane to refine at" : ", a plane too";
  if (!wrong.empty()) throw core::InputError("sizes of a surface mesh out of range: " + wrong + "; choose within");
}

SizeSpace::SizeSpace(const TriangleSurface& surface, const SurfaceFeatures& features,
                     const std::vector<double>& thickness, const SurfaceSize& size)
    : surface_(surface),
      normals_(corner_normals(surface, features)),
      refined_(size.refined),
      turn_(size.turn_rad),
      deviation_(size.deviation) {
  validate(size);
  // Lines are simplified so far that the distance to a line errs by a thousandth of the layers' width.
  const double thinnest = *std::min_element(thickness.begin(), thickness.end());
  const double tolerance = 1e-3 * (size.layer_width_m > 0.0 ? size.layer_width_m : thinnest);
  for (const auto& line : features.lines) {
    lines_.push_back(positions(surface, line));
    straight_lines_.push_back(simplified(lines_.back(), tolerance));
    line_blocks_.emplace_back();
    for (const auto& x : lines_.back()) line_blocks_.back().extend(x);
  }
  for (int p = 0; p < features.patches; ++p) patches_.push_back(make_patch(p, features, thickness, size));
}

SizeSpace::Patch SizeSpace::make_patch(int patch, const SurfaceFeatures& features, const std::vector<double>& thickness,
                                       const SurfaceSize& size) const {
  std::vector<int> triangles;
  for (std::size_t t = 0; t < features.patch_of_triangle.size(); ++t)
    if (features.patch_of_triangle[t] == patch) triangles.push_back(static_cast<int>(t));
  Patch result{TriangleTree(surface_, triangles)};
  result.thickness = median_thickness(surface_, thickness, triangles);
  for (const int t : triangles) result.mean_normal += area_vector(surface_, t);
  result.mean_normal.normalize();
  result.planar = mesh::is_planar(surface_, triangles);
  for (std::size_t l = 0; l < features.lines.size() && size.layers > 0; ++l) {
    const auto& sides = features.lines[l].patches;
    if (sides[0] == patch || sides[1] == patch) result.lines.push_back(static_cast<int>(l));
  }
  const double wanted = std::max(thicknesses_per_size * result.thickness, result.planar ? size.least_plane_m : 0.0);
  const double automatic = std::min(wanted, diagonal(surface_) / smallest_sizes_per_diagonal);
  result.size = size.scale * (size.size_m > 0.0 ? size.size_m : automatic);
  const double width = size.layer_width_m > 0.0 ? size.layer_width_m : result.thickness;
  // h₀ follows from ∫₀^w dd/(h₀ + g d) = layers.
  result.growth = -std::log(size.layer_ratio);
  result.first = size.layers == 0 ? std::numeric_limits<double>::infinity()
                                  : result.growth * width / (std::pow(size.layer_ratio, -size.layers) - 1.0);
  const double radius = inradius(surface_, triangles, result.lines, straight_lines_);
  // A patch that is no wider than its layers or its wall, such as a rim, gets no layers.
  if (radius < std::max(width, 0.5 * result.thickness)) result.lines.clear();
  return result;
}

Eigen::VectorXd SizeSpace::at(int patch, const Eigen::Vector3d& x, const Eigen::Vector3d& normal) const {
  const Patch& p = of(patch);
  const auto lines = static_cast<Eigen::Index>(p.lines.size());
  Eigen::VectorXd result(6 + lines + static_cast<Eigen::Index>(refined_.size()));
  result.head<3>() = x / p.size;
  result.segment<3>(3) = normal / turn_;
  // Beyond `reach` the layers have grown to H and φ is constant, so that the distance to a far line is not needed.
  const double reach = std::max(0.0, (p.size - p.first) / p.growth);
  for (Eigen::Index k = 0; k < lines; ++k) {
    const auto line = static_cast<std::size_t>(p.lines[static_cast<std::size_t>(k)]);
    const bool far = line_blocks_[line].exteriorDistance(x) >= reach;
    const double d = far ? reach : (nearest_on(straight_lines_[line], x) - x).norm();
    result(6 + k) = stretched(d, p.first, p.growth, p.size);
  }
  for (std::size_t k = 0; k < refined_.size(); ++k) {
    const double d = signed_distance(refined_[k], x);
    result(6 + lines + static_cast<Eigen::Index>(k)) =
        std::copysign(stretched(std::abs(d), p.first, p.growth, p.size), d);
  }
  return result;
}

Eigen::Vector3d SizeSpace::normal(int patch, const Eigen::Vector3d& x) const {
  if (of(patch).planar) return of(patch).mean_normal;
  const auto nearest = of(patch).tree.nearest(x);
  const auto& t = surface_.triangles[static_cast<std::size_t>(nearest.triangle)];
  const auto corner = [&](int k) -> const Eigen::Vector3d& {
    return surface_.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k % 3)])];
  };
  const Eigen::Vector3d area = area_vector(surface_, nearest.triangle);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d& a = corner(k + 1);
    const double share = (corner(k + 2) - a).cross(nearest.point - a).dot(area) / (2.0 * area.squaredNorm());
    sum += share * normals_[static_cast<std::size_t>(nearest.triangle)][static_cast<std::size_t>(k)];
  }
  return sum.normalized();
}

Eigen::Vector3d SizeSpace::on_patch(int patch, const Eigen::Vector3d& x) const {
  return of(patch).tree.nearest(x).point;
}

Eigen::Vector3d SizeSpace::on_line(int line, const Eigen::Vector3d& x) const {
  return nearest_on(lines_[static_cast<std::size_t>(line)], x);
}

double SizeSpace::allowed_deviation_m(int patch) const {
  return deviation_ * of(patch).thickness;
}

bool SizeSpace::is_planar(int patch) const {
  return of(patch).planar;
}

}  // namespace thinwall::mesh
