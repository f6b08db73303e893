#include "mesh/tet_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace thinwall::mesh {

namespace {

const Eigen::Vector3d& vertex(const TetMesh& mesh, int index) {
  return mesh.vertices[static_cast<std::size_t>(index)];
}

/// Face k is opposite vertex k; its normal points away from it.
constexpr std::array<std::array<int, 3>, 4> faces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

}  // namespace

double volume(const TetMesh& mesh, int tet) {
  const auto& t = mesh.tets[static_cast<std::size_t>(tet)];
  const Eigen::Vector3d& origin = vertex(mesh, t[0]);
  return (vertex(mesh, t[1]) - origin).cross(vertex(mesh, t[2]) - origin).dot(vertex(mesh, t[3]) - origin) / 6.0;
}

double volume(const TetMesh& mesh) {
  long double sum = 0.0L;  // in double precision the sum of 60 000 elements is 2e-12 off, more than prisms may be
  for (int tet = 0; tet < static_cast<int>(mesh.tets.size()); ++tet) sum += volume(mesh, tet);
  return static_cast<double>(sum);
}

std::vector<BoundaryTriangle> boundary(const TetMesh& mesh) {
  struct Face {
    std::array<int, 3> key;
    BoundaryTriangle triangle;
  };
  std::vector<Face> all;
  all.reserve(4 * mesh.tets.size());
  for (std::size_t tet = 0; tet < mesh.tets.size(); ++tet) {
    for (const auto& face : faces) {
      Face f;
      for (std::size_t k = 0; k < 3; ++k) f.triangle.vertices[k] = mesh.tets[tet][static_cast<std::size_t>(face[k])];
      f.triangle.tet = static_cast<int>(tet);
      f.key = f.triangle.vertices;
      std::sort(f.key.begin(), f.key.end());
      all.push_back(f);
    }
  }
  std::sort(all.begin(), all.end(), [](const Face& a, const Face& b) { return a.key < b.key; });
  std::vector<BoundaryTriangle> result;
  for (std::size_t i = 0; i < all.size();) {
    if (i + 1 < all.size() && all[i].key == all[i + 1].key) {
      i += 2;
    } else {
      result.push_back(all[i++].triangle);
    }
  }
  std::sort(result.begin(), result.end(), [](const BoundaryTriangle& a, const BoundaryTriangle& b) {
    return a.tet != b.tet ? a.tet < b.tet : a.vertices < b.vertices;
  });
  return result;
}

double mean_ratio(const TetMesh& mesh, int tet) {
  const auto& t = mesh.tets[static_cast<std::size_t>(tet)];
  double squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) squares += (vertex(mesh, t[i]) - vertex(mesh, t[j])).squaredNorm();
  }
  return 12.0 * std::pow(3.0 * std::max(volume(mesh, tet), 0.0), 2.0 / 3.0) / squares;
}

}  // namespace thinwall::mesh
