#include "fem/elastic_clamps.hpp"

#include <map>
#include <utility>

#include "fem/face_points.hpp"
#include "fem/patch.hpp"

namespace thinwall::fem {

namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

/// Appends the entries of a clamp's stiffness on one face.
void add_face(const FacePoints& face, const ElasticClamp& clamp, Entries& entries) {
  const auto n = static_cast<Eigen::Index>(face.nodes.size());
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Eigen::ArrayXd nn = face.normals.row(i).cwiseProduct(face.normals.row(j)).transpose();
      const Eigen::ArrayXd density = clamp.normal_N_m3 * nn + clamp.tangential_N_m3 * ((i == j ? 1.0 : 0.0) - nn);
      const Eigen::VectorXd weight = (density * face.areas_m2.array()).matrix();
      const Eigen::MatrixXd block = face.values * weight.asDiagonal() * face.values.transpose();
      for (Eigen::Index b = 0; b < n; ++b) {
        for (Eigen::Index a = 0; a < n; ++a) {
          entries.emplace_back(3 * face.nodes[static_cast<std::size_t>(a)] + i,
                               3 * face.nodes[static_cast<std::size_t>(b)] + j, block(a, b));
        }
      }
    }
  }
}

/// Gram matrices of the rigid motions of a face about a place near it: the squared displacements along the normal and
/// along the face, integrated over the area.
struct FaceGrams {
  Eigen::Vector3d about = Eigen::Vector3d::Zero();
  int node = 0;
  double area = 0.0;
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 6> tangential = Eigen::Matrix<double, 6, 6>::Zero();

  void add(const FacePoints& face) {
    if (area == 0.0) {
      about = face.positions_m.col(0);
      node = face.nodes.front();
    }
    for (Eigen::Index q = 0; q < face.areas_m2.size(); ++q) {
      Eigen::Matrix<double, 3, 6> R;
      R << Eigen::Matrix3d::Identity(), -cross_matrix(face.positions_m.col(q) - about);
      const Eigen::RowVectorXd along = face.normals.col(q).transpose() * R;
      const Eigen::Matrix<double, 6, 6> both = R.transpose() * R;
      const Eigen::Matrix<double, 6, 6> of_normal = along.transpose() * along;
      normal += face.areas_m2(q) * of_normal;
      tangential += face.areas_m2(q) * (both - of_normal);
      area += face.areas_m2(q);
    }
  }
};

}  // namespace

ClampStiffness clamp_stiffness(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes,
                               const std::vector<int>& piece, const std::vector<ElasticClamp>& clamps) {
  ClampStiffness result;
  Entries entries;
  const auto boundary = mesh::boundary(mesh);
  for (const ElasticClamp& clamp : clamps) {
    std::map<int, FaceGrams> of_piece;
    for (const FacePoints& face : face_points(mesh, nodes, mesh::select(mesh, boundary, clamp.region, clamp.name))) {
      if (clamp.normal_N_m3 > 0.0 || clamp.tangential_N_m3 > 0.0) add_face(face, clamp, entries);
      of_piece[piece[static_cast<std::size_t>(face.nodes.front())]].add(face);
    }
    for (const auto& [root, grams] : of_piece) {
      result.restraints.push_back({grams.node, grams.about, clamp.normal_N_m3 * grams.area, grams.normal / grams.area});
      result.restraints.push_back(
          {grams.node, grams.about, clamp.tangential_N_m3 * grams.area, grams.tangential / grams.area});
    }
  }
  const Eigen::Index size = 3 * nodes.positions.rows();
  result.K.resize(size, size);
  result.K.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace thinwall::fem
