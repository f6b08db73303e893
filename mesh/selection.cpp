#include "mesh/selection.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

#include "core/error.hpp"
#include "core/nearest_name.hpp"

namespace thinwall::mesh {

namespace {

/// The distance of x outside the region; 0 inside.
double distance(const PlaneRegion& plane, const Eigen::Vector3d& x) {
  return std::abs(plane.normal.normalized().dot(x - plane.point));
}
double distance(const BoxRegion& box, const Eigen::Vector3d& x) {
  return (box.min - x).cwiseMax(x - box.max).cwiseMax(0.0).norm();
}
double distance(const SphereRegion& sphere, const Eigen::Vector3d& x) {
  return std::max(0.0, (x - sphere.centre).norm() - sphere.radius);
}

std::string in_mm(const Eigen::Vector3d& x) {
  std::ostringstream text;
  text << '(' << x.x() * 1e3 << ", " << x.y() * 1e3 << ", " << x.z() * 1e3 << ") mm";
  return text.str();
}

}  // namespace

Region face_of(const Box& box, const std::string& name) {
  const auto& names = face_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw core::InputError("no face or selection is called \"" + name + "\"" +
                           core::did_you_mean(name, {names.begin(), names.end()}) + "; faces are x_min, x_max … z_max");
  }
  const auto index = found - names.begin();
  PlaneRegion plane;
  plane.normal = Eigen::Vector3d::Unit(index / 2);
  if (index % 2 == 1) plane.point = box.size;
  return plane;
}

std::vector<BoundaryTriangle> select(const TetMesh& mesh, const std::vector<BoundaryTriangle>& boundary,
                                     const Region& region, const std::string& name) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector3d high = -low;
  for (const auto& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const double tolerance = 1e-6 * (high - low).norm();
  double nearest = std::numeric_limits<double>::max();
  Eigen::Vector3d nearest_centre = Eigen::Vector3d::Zero();
  std::vector<BoundaryTriangle> chosen;
  for (const BoundaryTriangle& triangle : boundary) {
    double farthest = 0.0;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const int v : triangle.vertices) {
      const Eigen::Vector3d& x = mesh.vertices[static_cast<std::size_t>(v)];
      farthest = std::max(farthest, std::visit([&](const auto& r) { return distance(r, x); }, region));
      centre += x / 3.0;
    }
    if (farthest <= tolerance) chosen.push_back(triangle);
    if (farthest < nearest) {
      nearest = farthest;
      nearest_centre = centre;
    }
  }
  const std::string extent = "; the part reaches from " + in_mm(low) + " to " + in_mm(high);
  if (chosen.empty()) {
    std::ostringstream text;
    text << "selection \"" << name << "\" holds no face of the part: the nearest, at " << in_mm(nearest_centre)
         << ", lies " << nearest * 1e3 << " mm outside" << extent << ", and its faces are x_min, x_max … z_max";
    throw core::InputError(text.str());
  }
  if (chosen.size() == boundary.size()) {
    throw core::InputError("selection \"" + name + "\" holds every face of the part" + extent + "; make it smaller");
  }
  return chosen;
}

std::vector<int> nodes_on(const LagrangeNodes& nodes, const TetMesh& mesh,
                          const std::vector<BoundaryTriangle>& triangles) {
  const auto alphas = lattice(nodes.order);
  std::set<int> chosen;
  for (const BoundaryTriangle& triangle : triangles) {
    const auto& tet = mesh.tets[static_cast<std::size_t>(triangle.tet)];
    std::size_t opposite = 0;
    while (std::find(triangle.vertices.begin(), triangle.vertices.end(), tet[opposite]) != triangle.vertices.end())
      ++opposite;
    for (std::size_t a = 0; a < alphas.size(); ++a) {
      if (alphas[a][opposite] == 0) chosen.insert(nodes.elements(triangle.tet, static_cast<Eigen::Index>(a)));
    }
  }
  return {chosen.begin(), chosen.end()};
}

}  // namespace thinwall::mesh
