#include "mesh/locate.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::mesh {

namespace {

const Eigen::Vector3d& vertex(const TetMesh& mesh, int index) {
  return mesh.vertices[static_cast<std::size_t>(index)];
}

Eigen::Vector4d barycentric(const TetMesh& mesh, int tet, const Eigen::Vector3d& x) {
  const auto& t = mesh.tets[static_cast<std::size_t>(tet)];
  Eigen::Matrix3d edges;
  edges << vertex(mesh, t[1]) - vertex(mesh, t[0]), vertex(mesh, t[2]) - vertex(mesh, t[0]),
      vertex(mesh, t[3]) - vertex(mesh, t[0]);
  const Eigen::Vector3d last = edges.inverse() * (x - vertex(mesh, t[0]));
  return {1.0 - last.sum(), last.x(), last.y(), last.z()};
}

Eigen::Vector3d position(const TetMesh& mesh, const Location& location) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (int k = 0; k < 4; ++k) {
    x += location.lambda(k) *
         vertex(mesh, mesh.tets[static_cast<std::size_t>(location.tet)][static_cast<std::size_t>(k)]);
  }
  return x;
}

double diagonal(const TetMesh& mesh) {
  Eigen::Vector3d low = mesh.vertices.front();
  Eigen::Vector3d high = low;
  for (const auto& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return (high - low).norm();
}

/// Point of the triangle nearest to x (Ericson 2005, section 5.1.5).
Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d& x, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const double d1 = ab.dot(x - a);
  const double d2 = ac.dot(x - a);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const double d3 = ab.dot(x - b);
  const double d4 = ac.dot(x - b);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(x - c);
  const double d6 = ac.dot(x - c);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = va + vb + vc;
  return a + (vb / sum) * ab + (vc / sum) * ac;
}

const BoundaryTriangle& nearest_triangle(const TetMesh& mesh, const std::vector<BoundaryTriangle>& boundary,
                                         const Eigen::Vector3d& x, double& distance) {
  const BoundaryTriangle* best = nullptr;
  distance = std::numeric_limits<double>::max();
  for (const auto& triangle : boundary) {
    const auto& v = triangle.vertices;
    const double d = (x - nearest_on_triangle(x, vertex(mesh, v[0]), vertex(mesh, v[1]), vertex(mesh, v[2]))).norm();
    if (d < distance) {
      distance = d;
      best = &triangle;
    }
  }
  return *best;
}

[[noreturn]] void off_the_part(const Eigen::Vector3d& x, double distance, const char* what) {
  std::ostringstream text;
  text << "the point (" << x.x() * 1e3 << ", " << x.y() * 1e3 << ", " << x.z() * 1e3 << ") mm lies " << distance * 1e3
       << " mm off " << what << "; move it onto the part";
  throw core::InputError(text.str());
}

/// Of these tetrahedra the one that x lies in, or the one that it is least outside of by barycentric coordinates.
Located locate_among(const TetMesh& mesh, const std::vector<int>& tets, const Eigen::Vector3d& x) {
  Location best;
  double worst = -std::numeric_limits<double>::max();
  for (const int tet : tets) {
    const Eigen::Vector4d lambda = barycentric(mesh, tet, x);
    if (lambda.minCoeff() > worst) {
      worst = lambda.minCoeff();
      best = {tet, lambda};
      if (worst >= 0.0) return {best, 0.0};
    }
  }
  best.lambda = best.lambda.cwiseMax(0.0);
  best.lambda /= best.lambda.sum();
  return {best, (position(mesh, best) - x).norm()};
}

/// Those whose boxes come within `reach_m` of x.
std::vector<int> tets_near(const TetMesh& mesh, const Eigen::Vector3d& x, double reach_m) {
  std::vector<int> near;
  for (std::size_t tet = 0; tet < mesh.tets.size(); ++tet) {
    Eigen::AlignedBox3d box;
    for (const int corner : mesh.tets[tet]) box.extend(vertex(mesh, corner));
    if (box.squaredExteriorDistance(x) <= reach_m * reach_m) near.push_back(static_cast<int>(tet));
  }
  return near;
}

}  // namespace

Located locate(const TetMesh& mesh, const Eigen::Vector3d& x) {
  std::vector<int> all(mesh.tets.size());
  std::iota(all.begin(), all.end(), 0);
  return locate_among(mesh, all, x);
}

std::vector<PatchSample> patch_samples(const TetMesh& mesh, const std::vector<BoundaryTriangle>& boundary,
                                       const Eigen::Vector3d& x, double radius_m) {
  const double tolerance = 1e-6 * diagonal(mesh);
  double distance = 0.0;
  if (radius_m <= 0.0) {
    const Located found = locate(mesh, x);
    if (found.distance_m > tolerance) {
      nearest_triangle(mesh, boundary, x, distance);  // locate() moves x by more than its distance
      off_the_part(x, distance, "the part");
    }
    return {{found.location, 1.0}};
  }
  const BoundaryTriangle& triangle = nearest_triangle(mesh, boundary, x, distance);
  if (distance > tolerance) off_the_part(x, distance, "the part's surface, where a patch must lie");
  const Eigen::Vector3d e1 = (vertex(mesh, triangle.vertices[1]) - vertex(mesh, triangle.vertices[0])).normalized();
  const Eigen::Vector3d normal =
      e1.cross(vertex(mesh, triangle.vertices[2]) - vertex(mesh, triangle.vertices[0])).normalized();
  const Eigen::Vector3d e2 = normal.cross(e1);
  const std::vector<int> tets = tets_near(mesh, x, radius_m + tolerance);
  constexpr int rings = 8;
  constexpr int sectors = 24;
  std::vector<PatchSample> samples;
  for (int ring = 0; ring < rings; ++ring) {
    const double r = radius_m * std::sqrt((ring + 0.5) / rings);
    for (int sector = 0; sector < sectors; ++sector) {
      // A quarter of a sector on, so that no ray lies on an edge of the part along e1, where half a sector would count
      // whole.
      const double angle = 2.0 * std::numbers::pi * (sector + 0.25 + 0.5 * (ring % 2)) / sectors;
      const Located found = locate_among(mesh, tets, x + r * (std::cos(angle) * e1 + std::sin(angle) * e2));
      if (found.distance_m <= tolerance) samples.push_back({found.location, 1.0});
    }
  }
  if (samples.empty()) off_the_part(x, radius_m, "the part's surface, where a patch must lie");
  for (auto& sample : samples) sample.weight = 1.0 / static_cast<double>(samples.size());
  return samples;
}

}  // namespace thinwall::mesh
