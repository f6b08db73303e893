#include "fem/patch.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <sstream>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "fem/disc_quadrature.hpp"
#include "fem/face_points.hpp"
#include "fem/reference_element.hpp"

namespace thinwall::fem {

namespace {

/// Sums over the samples of a patch. Moments are taken about a place near the patch, so that a part far from the origin
/// loses no digits.
struct Sums {
  struct Node {
    double share = 0.0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  };
  std::map<int, Node> nodes;
  double area = 0.0;
  Eigen::Vector3d about = Eigen::Vector3d::Zero();
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  /// Adds a sample at x with the values N of the shape functions of the nodes `of_sample`.
  template <class Values>
  void add(const Eigen::Vector3d& x, double weight, const std::vector<int>& of_sample, const Values& N) {
    if (area == 0.0) about = x;
    const Eigen::Vector3d r = x - about;
    area += weight;
    first += weight * r;
    second += weight * r * r.transpose();
    for (std::size_t a = 0; a < of_sample.size(); ++a) {
      const double share = weight * N(static_cast<Eigen::Index>(a));
      Node& node = nodes[of_sample[a]];
      node.share += share;
      node.moment += share * r;
    }
  }
};

/// Adds the place of a disc of no radius to the sums.
void add_place(const mesh::LagrangeNodes& nodes, const mesh::Location& place, Sums& sums) {
  const Eigen::VectorXd N = shape_functions(nodes.order, place.lambda);
  const Eigen::VectorXi row = nodes.elements.row(place.tet);
  const std::vector<int> of_element(row.begin(), row.end());
  sums.add(nodes.positions(of_element, Eigen::all).transpose() * N, 1.0, of_element, N);
}

/// The corners of a triangle from the centre of a disc, in its frame [e₁ e₂ n], columns.
Eigen::Matrix3d corners_from(const mesh::DiscFace& face, const mesh::TetMesh& mesh,
                             const mesh::BoundaryTriangle& triangle) {
  const Eigen::Vector3d e1 = face.normal.unitOrthogonal();
  Eigen::Matrix3d frame, corners;
  frame << e1, face.normal.cross(e1), face.normal;
  for (std::size_t c = 0; c < 3; ++c) {
    corners.col(static_cast<Eigen::Index>(c)) =
        frame.transpose() * (mesh.vertices[static_cast<std::size_t>(triangle.vertices[c])] - face.centre_m);
  }
  return corners;
}

/// Adds the quadrature points of the parts of the faces that lie in a disc to the sums. On a curved surface the disc
/// lies in the plane of its centre, and the surface under it counts down to its depth.
void add_samples(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes, const Disc& disc, const std::string&,
                 Sums& sums) {
  const auto boundary = mesh::boundary(mesh);
  if (disc.radius_m <= 0.0) return add_place(nodes, mesh::locate_on(mesh, boundary, disc), sums);
  const mesh::DiscFace face = mesh::disc_face(mesh, boundary, disc);
  for (const mesh::BoundaryTriangle& triangle : face.triangles) {
    const Eigen::Matrix3d corners = corners_from(face, mesh, triangle);
    const TriangleQuadrature rule = disc_quadrature(corners.topRows<2>(), disc.radius_m, nodes.order + 1);
    if (rule.weight.size() == 0) continue;
    const Eigen::RowVectorXd depth = (corners.row(2) * rule.lambda).cwiseAbs();
    const FacePoints points = face_points(mesh, nodes, triangle, rule);
    for (Eigen::Index q = 0; q < depth.size(); ++q)
      if (depth(q) <= face.depth_m)
        sums.add(points.positions_m.col(q), points.areas_m2(q), points.nodes, points.values.col(q));
  }
}

/// Adds the quadrature points of all faces of a region to the sums.
void add_samples(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes, const mesh::Region& region,
                 const std::string& name, Sums& sums) {
  const auto faces = face_points(mesh, nodes, mesh::select(mesh, mesh::boundary(mesh), region, name));
  for (const FacePoints& face : faces) {
    for (Eigen::Index q = 0; q < face.areas_m2.size(); ++q)
      sums.add(face.positions_m.col(q), face.areas_m2(q), face.nodes, face.values.col(q));
  }
}

}  // namespace

PatchAverage patch_average(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes, const Patch& patch,
                           const std::string& name) {
  Sums sums;
  try {
    std::visit([&](const auto& where) { add_samples(mesh, nodes, where, name, sums); }, patch);
  } catch (const core::InputError& error) {
    throw core::InputError("point \"" + name + "\": " + error.what());
  }
  PatchAverage average;
  const Eigen::Vector3d shift = sums.first / sums.area;
  average.centre_m = sums.about + shift;
  const Eigen::Matrix3d second = sums.second / sums.area - shift * shift.transpose();
  average.spread_m2 = second.trace() * Eigen::Matrix3d::Identity() - second;
  average.share.resize(static_cast<Eigen::Index>(sums.nodes.size()));
  average.moment_m.resize(3, average.share.size());
  for (const auto& [node, sum] : sums.nodes) {
    const auto a = static_cast<Eigen::Index>(average.nodes.size());
    average.nodes.push_back(node);
    average.share(a) = sum.share / sums.area;
    average.moment_m.col(a) = sum.moment / sums.area - average.share(a) * shift;
  }
  return average;
}

Eigen::Matrix3d inverse_spread(const PatchAverage& average, const std::string& name) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(average.spread_m2);
  const Eigen::Vector3d& spread = eigen.eigenvalues();
  // The spread of a single sample is the round-off of its position.
  const double least = 1e-24 * average.centre_m.squaredNorm();
  if (spread(2) <= least || average.nodes.empty()) {
    throw core::InputError("point \"" + name +
                           "\" is a single place, which has no turn: give it a patch (a radius, or faces)");
  }
  if (spread(0) < 1e-8 * spread(2)) {
    std::ostringstream text;
    text << "point \"" << name << "\": its patch lies on one line and does not see the turn about ("
         << eigen.eigenvectors().col(0).transpose() << "): make it wider";
    throw core::InputError(text.str());
  }
  return eigen.eigenvectors() * spread.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
}

Eigen::Matrix<double, 6, 3> motion_of_node(const PatchAverage& average, Eigen::Index a,
                                           const Eigen::Matrix3d& J_inverse) {
  Eigen::Matrix<double, 6, 3> rows;
  rows << average.share(a) * Eigen::Matrix3d::Identity(), J_inverse * cross_matrix(average.moment_m.col(a));
  return rows;
}

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& r) {
  Eigen::Matrix3d R;
  R << 0.0, -r.z(), r.y(), r.z(), 0.0, -r.x(), -r.y(), r.x(), 0.0;
  return R;
}

}  // namespace thinwall::fem
