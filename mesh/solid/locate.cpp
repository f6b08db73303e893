#include "mesh/solid/locate.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "core/error.hpp"
#include "mesh/nearest_point.hpp"

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

/// The point of a triangle nearest to x.
Eigen::Vector3d nearest_on_boundary(const TetMesh& mesh, const BoundaryTriangle& triangle, const Eigen::Vector3d& x) {
  const auto& v = triangle.vertices;
  return nearest_on_triangle(x, vertex(mesh, v[0]), vertex(mesh, v[1]), vertex(mesh, v[2]));
}

/// The boundary triangle nearest to a point, and its point nearest to it.
struct OnBoundary {
  const BoundaryTriangle* triangle = nullptr;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double distance_m = std::numeric_limits<double>::max();
};
OnBoundary nearest(const TetMesh& mesh, const std::vector<BoundaryTriangle>& boundary, const Eigen::Vector3d& x) {
  OnBoundary best;
  for (const auto& triangle : boundary) {
    const Eigen::Vector3d p = nearest_on_boundary(mesh, triangle, x);
    if ((p - x).norm() < best.distance_m) best = {&triangle, p, (p - x).norm()};
  }
  return best;
}

/// The location of a point of the boundary in its tetrahedron.
Location location_of(const TetMesh& mesh, const OnBoundary& at) {
  const Eigen::Vector4d lambda = barycentric(mesh, at.triangle->tet, at.point).cwiseMax(0.0);
  return {at.triangle->tet, lambda / lambda.sum()};
}

[[noreturn]] void off_the_part(const Eigen::Vector3d& x, double distance, const char* what) {
  std::ostringstream text;
  text << "the point (" << x.x() * 1e3 << ", " << x.y() * 1e3 << ", " << x.z() * 1e3 << ") mm lies " << distance * 1e3
       << " mm off " << what << "; move it onto the part";
  throw core::InputError(text.str());
}

/// Outward normal of a boundary triangle.
Eigen::Vector3d normal(const TetMesh& mesh, const BoundaryTriangle& triangle) {
  const auto& v = triangle.vertices;
  const Eigen::Vector3d a = vertex(mesh, v[0]);
  return (vertex(mesh, v[1]) - a).cross(vertex(mesh, v[2]) - a).normalized();
}

/// True if two normals differ by less than 30°, as those of the pieces of a curved face do.
bool alike(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.dot(b) > std::cos(std::numbers::pi / 6.0);
}

/// True if a disc lies on a face of normal a rather than on one of normal b (Disc::facing).
bool preferred(const Disc& disc, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const auto by = [&](const Eigen::Vector3d& d) { return std::abs(a.dot(d)) - std::abs(b.dot(d)); };
  constexpr double equal = 1e-6;
  for (const Eigen::Vector3d& d : disc.facing)
    if (std::abs(by(d)) > equal) return by(d) > 0.0;
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(by(Eigen::Vector3d::Unit(axis))) > equal) return by(Eigen::Vector3d::Unit(axis)) > 0.0;
  return false;
}

/// The triangle on which a disc lies: of those as near to the centre as the nearest one, within the tolerance (m), the
/// preferred().
OnBoundary chosen(const TetMesh& mesh, const std::vector<BoundaryTriangle>& boundary, const Disc& disc,
                  double tolerance) {
  OnBoundary best = nearest(mesh, boundary, disc.centre_m);
  const double within = best.distance_m + tolerance;
  for (const auto& triangle : boundary) {
    const Eigen::Vector3d p = nearest_on_boundary(mesh, triangle, disc.centre_m);
    const double distance = (p - disc.centre_m).norm();
    if (distance <= within && preferred(disc, normal(mesh, triangle), normal(mesh, *best.triangle)))
      best = {&triangle, p, distance};
  }
  return best;
}

}  // namespace

Located locate(const TetMesh& mesh, const Eigen::Vector3d& x) {
  Location best;
  double worst = -std::numeric_limits<double>::max();
  for (int tet = 0; tet < static_cast<int>(mesh.tets.size()); ++tet) {
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

DiscFace disc_face(const TetMesh& mesh, const std::vector<BoundaryTriangle>& boundary, const Disc& disc) {
  const double tolerance = 1e-6 * diagonal(mesh);
  const OnBoundary centre = chosen(mesh, boundary, disc, tolerance);
  if (centre.distance_m > tolerance + disc.off_m)
    off_the_part(disc.centre_m, centre.distance_m, "the part's surface, where a patch must lie");
  DiscFace face{centre.point, normal(mesh, *centre.triangle), tolerance, {*centre.triangle}, {}};
  if (disc.off_m > 0.0) face.depth_m += disc.off_m + 0.25 * disc.radius_m;
  const double reach = disc.radius_m + face.depth_m;
  for (const auto& triangle : boundary) {
    Eigen::AlignedBox3d box;
    for (const int corner : triangle.vertices) box.extend(vertex(mesh, corner));
    if (&triangle == centre.triangle || box.squaredExteriorDistance(face.centre_m) > reach * reach) continue;
    const Eigen::Vector3d n = normal(mesh, triangle);
    if (n.dot(face.normal) > 0.5) face.triangles.push_back(triangle);
    if (!alike(n, face.normal) && std::ranges::none_of(face.others, [&](const auto& o) { return alike(n, o); }) &&
        (nearest_on_boundary(mesh, triangle, face.centre_m) - face.centre_m).norm() <= tolerance)
      face.others.push_back(n);
  }
  return face;
}

Location locate_on(const TetMesh& mesh, const std::vector<BoundaryTriangle>& boundary, const Disc& disc) {
  const double tolerance = 1e-6 * diagonal(mesh);
  const Located found = locate(mesh, disc.centre_m);
  if (found.distance_m <= tolerance) return found.location;
  const OnBoundary moved = nearest(mesh, boundary, disc.centre_m);  // locate() moves it by more than its distance
  if (moved.distance_m > tolerance + disc.off_m) off_the_part(disc.centre_m, moved.distance_m, "the part");
  return location_of(mesh, moved);
}

}  // namespace thinwall::mesh
