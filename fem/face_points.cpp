#include "fem/face_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "fem/reference_element.hpp"

namespace thinwall::fem {

namespace {

/// Shape functions of the nodes on a face, and their slopes along its edges 0-1 and 0-2, at quadrature points (nodes ×
/// points).
struct FaceReference {
  std::vector<int> local;   // local numbers of the face's nodes in the element
  Eigen::MatrixXd lattice;  // nodes × 3: barycentric coordinates among the corners
  Eigen::MatrixXd values;
  std::array<Eigen::MatrixXd, 2> slopes;
  Eigen::VectorXd weight;
};

/// The reference values of the face whose corners are these vertices of the element, in their order.
FaceReference face_reference(int order, const std::array<int, 3>& corners, const TriangleQuadrature& rule) {
  const auto alphas = mesh::lattice(order);
  FaceReference face;
  for (std::size_t a = 0; a < alphas.size(); ++a) {
    int on_face = 0;
    for (const int corner : corners) on_face += alphas[a][static_cast<std::size_t>(corner)];
    if (on_face == order) face.local.push_back(static_cast<int>(a));
  }
  face.lattice.resize(static_cast<Eigen::Index>(face.local.size()), 3);
  for (std::size_t k = 0; k < face.local.size(); ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      face.lattice(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c)) =
          double(alphas[static_cast<std::size_t>(face.local[k])][static_cast<std::size_t>(corners[c])]) / order;
    }
  }
  face.weight = rule.weight;
  face.values.resize(face.lattice.rows(), rule.weight.size());
  for (auto& slope : face.slopes) slope.resize(face.lattice.rows(), rule.weight.size());
  for (Eigen::Index q = 0; q < rule.weight.size(); ++q) {
    Eigen::Vector4d lambda = Eigen::Vector4d::Zero();
    for (std::size_t c = 0; c < 3; ++c) lambda(corners[c]) = rule.lambda(static_cast<Eigen::Index>(c), q);
    face.values.col(q) = shape_functions(order, lambda)(face.local);
    const Eigen::MatrixX3d by_xi = shape_slopes(order, lambda)(face.local, Eigen::all);
    // Since ξ_k = λ_{k+1}: along the edge from the first corner to another, the λ of that other one grows and that of
    // the first falls.
    const auto along = [&](int corner) -> Eigen::VectorXd {
      return corner == 0 ? Eigen::VectorXd::Zero(by_xi.rows()) : Eigen::VectorXd(by_xi.col(corner - 1));
    };
    for (std::size_t t = 0; t < 2; ++t) face.slopes[t].col(q) = along(corners[t + 1]) - along(corners[0]);
  }
  return face;
}

/// The places of a boundary triangle's corners among the four vertices of its tetrahedron.
std::array<int, 3> local_corners(const mesh::TetMesh& mesh, const mesh::BoundaryTriangle& triangle) {
  const auto& tet = mesh.tets[static_cast<std::size_t>(triangle.tet)];
  std::array<int, 3> corners{};
  for (std::size_t c = 0; c < 3; ++c)
    corners[c] = static_cast<int>(std::find(tet.begin(), tet.end(), triangle.vertices[c]) - tet.begin());
  return corners;
}

/// The nodes of a face.
std::vector<int> nodes_of(const mesh::LagrangeNodes& nodes, int tet, const FaceReference& reference) {
  std::vector<int> of_face;
  for (const int a : reference.local) of_face.push_back(nodes.elements(tet, a));
  return of_face;
}

/// The positions of the chosen nodes, 3 × nodes.
Eigen::Matrix3Xd positions_of(const mesh::LagrangeNodes& nodes, const std::vector<int>& chosen) {
  return nodes.positions(chosen, Eigen::all).transpose();
}

/// The quadrature points of a face with the nodes at x (3 × nodes).
FacePoints at_points(const FaceReference& reference, const Eigen::Matrix3Xd& x, std::vector<int>&& nodes) {
  FacePoints face;
  face.nodes = std::move(nodes);
  face.values = reference.values;
  face.positions_m = x * reference.values;
  const Eigen::Matrix3Xd first = x * reference.slopes[0];
  const Eigen::Matrix3Xd second = x * reference.slopes[1];
  face.normals.resize(3, first.cols());
  face.areas_m2.resize(first.cols());
  for (Eigen::Index q = 0; q < first.cols(); ++q) {
    const Eigen::Vector3d cross = Eigen::Vector3d(first.col(q)).cross(Eigen::Vector3d(second.col(q)));
    face.normals.col(q) = cross.normalized();
    face.areas_m2(q) = 0.5 * cross.norm() * reference.weight(q);
  }
  return face;
}

}  // namespace

std::vector<FacePoints> face_points(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes,
                                    const std::vector<mesh::BoundaryTriangle>& triangles) {
  std::map<std::pair<std::array<int, 3>, bool>, FaceReference> references;
  const auto reference = [&](const std::array<int, 3>& corners, bool curved) -> const FaceReference& {
    const auto found = references.find({corners, curved});
    if (found != references.end()) return found->second;
    const int points = curved ? 2 * nodes.order + 1 : nodes.order + 1;
    return references
        .emplace(std::pair{corners, curved}, face_reference(nodes.order, corners, triangle_quadrature(points)))
        .first->second;
  };
  std::vector<FacePoints> faces;
  faces.reserve(triangles.size());
  for (const mesh::BoundaryTriangle& triangle : triangles) {
    const std::array<int, 3> corners = local_corners(mesh, triangle);
    const FaceReference& straight = reference(corners, false);
    std::vector<int> of_face = nodes_of(nodes, triangle.tet, straight);
    const Eigen::Matrix3Xd x = positions_of(nodes, of_face);
    const Eigen::Matrix3d vertices =
        positions_of(nodes, {nodes.elements(triangle.tet, corners[0]), nodes.elements(triangle.tet, corners[1]),
                             nodes.elements(triangle.tet, corners[2])});
    const double size = (vertices.colwise() - vertices.col(0)).cwiseAbs().maxCoeff();
    const double off = (x - vertices * straight.lattice.transpose()).cwiseAbs().maxCoeff();
    const bool curved = off > 1e-10 * size + 1e-14 * vertices.cwiseAbs().maxCoeff();
    faces.push_back(at_points(curved ? reference(corners, true) : straight, x, std::move(of_face)));
  }
  return faces;
}

FacePoints face_points(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes,
                       const mesh::BoundaryTriangle& triangle, const TriangleQuadrature& rule) {
  const FaceReference reference = face_reference(nodes.order, local_corners(mesh, triangle), rule);
  std::vector<int> of_face = nodes_of(nodes, triangle.tet, reference);
  const Eigen::Matrix3Xd x = positions_of(nodes, of_face);
  return at_points(reference, x, std::move(of_face));
}

}  // namespace thinwall::fem
