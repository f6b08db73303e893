#pragma once
// Blocks of solid elements as full models, with an interface of nodes or of a patch.

#include <string>
#include <vector>

#include "dynamics/spatial_model.hpp"
#include "fem/model.hpp"
#include "fem/points.hpp"
#include "fem/supports.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "reduction/interface.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::reduction {

inline const fem::Material steel{210e9, 0.3, 7850.0};

/// The block 0…size, moved to `origin`, clamped at its face x_min or free.
inline fem::Model block(const Eigen::Vector3d& size, const std::array<int, 3>& cells, int order, bool clamped,
                        const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  mesh::TetMesh mesh = mesh::kuhn_box(size, cells);
  for (auto& x : mesh.vertices) x += origin;
  std::vector<fem::Support> supports;
  if (clamped) supports.push_back({"x_min", mesh::PlaneRegion{origin, Eigen::Vector3d::UnitX()}, {0, 1, 2}});
  return fem::supported_model(std::move(mesh), order, steel, supports);
}

/// Named points of a model, joined into one interface.
inline Interface interface_at(const fem::Model& model, const std::vector<fem::NamedPoint>& points) {
  Interface result;
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& point : points) {
    const auto columns = fem::point_columns(model, point);
    for (Eigen::Index j = 0; j < columns.cols(); ++j) {
      for (linalg::SparseMatrix::InnerIterator it(columns, j); it; ++it) {
        entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(result.dofs.size()), it.value());
      }
      result.dofs.push_back(
          {point.name, point.directions[static_cast<std::size_t>(j)], dynamics::DofKind::translation});
    }
  }
  result.W.resize(model.K.rows(), static_cast<Eigen::Index>(result.dofs.size()));
  result.W.setFromTriplets(entries.begin(), entries.end());
  return result;
}

inline const std::vector<Eigen::Vector3d> xyz{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                                              Eigen::Vector3d::UnitZ()};

/// The static inverse that craig_bampton() wants: of K, or of K restrained at the interface where the part is free.
class StaticInverse {
 public:
  StaticInverse(const linalg::SparseMatrix& K, const std::vector<int>& node_of_row) : factor_(K, node_of_row) {}
  [[nodiscard]] linalg::ShiftedInverse action() const {
    return {[this](const Eigen::Ref<const Eigen::MatrixXd>& B) { return factor_.solve(B); }, 0.0};
  }

 private:
  linalg::SparseCholesky factor_;
};

/// A full model as a dense spatial one with nameless DOFs.
inline dynamics::SpatialModel dense(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M) {
  dynamics::SpatialModel model{M, Eigen::MatrixXd::Zero(K.rows(), K.rows()), K, {}, {}};
  for (Eigen::Index i = 0; i < K.rows(); ++i) model.dofs.push_back({std::to_string(i), Eigen::Vector3d::UnitX(), {}});
  return model;
}

}  // namespace thinwall::reduction
