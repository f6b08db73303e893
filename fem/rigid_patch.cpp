#include "fem/rigid_patch.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "mesh/solid/locate.hpp"

namespace thinwall::fem {

namespace {

/// The nodes on the faces of a region.
std::vector<int> nodes_in(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes, const mesh::Region& region,
                          const std::string& name) {
  return mesh::nodes_on(nodes, mesh, mesh::select(mesh, mesh::boundary(mesh), region, name));
}

/// The nodes on the faces under a disc, within its radius and in its plane. They are chosen by their places on the
/// straight mesh, on which a disc is looked up.
std::vector<int> nodes_in(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes, const Disc& disc,
                          const std::string& /*name*/) {
  const mesh::DiscFace face = mesh::disc_face(mesh, mesh::boundary(mesh), disc);
  const auto straight = mesh::lagrange_nodes(mesh, nodes.order);
  std::vector<int> chosen = mesh::nodes_on(nodes, mesh, face.triangles);
  std::erase_if(chosen, [&](int node) {
    const Eigen::Vector3d r = straight.positions.row(node).transpose() - face.centre_m;
    return r.norm() > (1.0 + 1e-6) * disc.radius_m || std::abs(r.dot(face.normal)) > face.depth_m;
  });
  return chosen;
}

/// The columns of T, six for each patch, which give the displacements of the free rows that belong to its nodes from
/// its motion.
linalg::SparseMatrix patch_columns(const mesh::LagrangeNodes& nodes, const std::vector<int>& free_rows,
                                   const std::vector<RigidPatch>& rigid) {
  const RowMap own = row_map(nodes.positions.rows(), free_rows, {});
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t p = 0; p < rigid.size(); ++p) {
    const int first = 6 * static_cast<int>(p);
    for (const int node : rigid[p].nodes) {
      const Eigen::Vector3d r = nodes.positions.row(node).transpose() - rigid[p].centre_m;
      for (int axis = 0; axis < 3; ++axis) {
        const int row = own.row_of[3 * static_cast<std::size_t>(node) + static_cast<std::size_t>(axis)];
        const Eigen::Vector3d turn = r.cross(Eigen::Vector3d::Unit(axis)) / rigid[p].size_m;
        for (int i = 0; i < 3; ++i) {
          entries.emplace_back(row, first + i, i == axis ? 1.0 : 0.0);
          entries.emplace_back(row, first + 3 + i, turn(i));
        }
      }
    }
  }
  linalg::SparseMatrix T(static_cast<Eigen::Index>(free_rows.size()), 6 * static_cast<Eigen::Index>(rigid.size()));
  T.setFromTriplets(entries.begin(), entries.end());
  return T;
}

}  // namespace

RigidPatch rigid_patch(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes, const Patch& patch,
                       const PatchAverage& average, const std::string& name) {
  RigidPatch rigid;
  rigid.name = name;
  rigid.nodes = std::visit([&](const auto& where) { return nodes_in(mesh, nodes, where, name); }, patch);
  rigid.centre_m = average.centre_m;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const int node : rigid.nodes) {
    const Eigen::Vector3d x = nodes.positions.row(node);
    rigid.size_m = std::max(rigid.size_m, (x - rigid.centre_m).norm());
    mean += x / static_cast<double>(rigid.nodes.size());
  }
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const int node : rigid.nodes) {
    const Eigen::Vector3d r = nodes.positions.row(node).transpose() - mean;
    second += r * r.transpose();
  }
  const Eigen::Vector3d spread = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(second).eigenvalues();
  if (rigid.nodes.size() < 3 || !(spread(1) > 1e-8 * spread(2))) {
    throw core::InputError(
        "rigid connection \"" + name + "\" holds " + std::to_string(rigid.nodes.size()) +
        " nodes, on one line or less, which leaves its turn open: make the patch wider, the elements "
        "smaller, or connect by the average");
  }
  return rigid;
}

RowMap row_map(Eigen::Index nodes, const std::vector<int>& free_rows, const std::vector<RigidPatch>& rigid) {
  RowMap map;
  map.row_of.assign(3 * static_cast<std::size_t>(nodes), -1);
  const std::size_t of_nodes = free_rows.size() - 6 * rigid.size();
  for (std::size_t i = 0; i < of_nodes; ++i) map.row_of[static_cast<std::size_t>(free_rows[i])] = static_cast<int>(i);
  map.first_patch_row = static_cast<int>(of_nodes);
  if (!rigid.empty()) map.patch_of.assign(static_cast<std::size_t>(nodes), -1);
  for (std::size_t p = 0; p < rigid.size(); ++p) {
    for (const int node : rigid[p].nodes) map.patch_of[static_cast<std::size_t>(node)] = static_cast<int>(p);
  }
  return map;
}

void add_entries(const RowMap& rows, const mesh::LagrangeNodes& nodes, const std::vector<RigidPatch>& rigid, int node,
                 const Eigen::Vector3d& w, int column, std::vector<Eigen::Triplet<double>>& entries) {
  const int patch = rows.patch_of.empty() ? -1 : rows.patch_of[static_cast<std::size_t>(node)];
  if (patch < 0) {
    for (int axis = 0; axis < 3; ++axis) {
      const int row = rows.row_of[3 * static_cast<std::size_t>(node) + static_cast<std::size_t>(axis)];
      if (row >= 0 && w(axis) != 0.0) entries.emplace_back(row, column, w(axis));
    }
    return;
  }
  const RigidPatch& body = rigid[static_cast<std::size_t>(patch)];
  const Eigen::Vector3d r = nodes.positions.row(node).transpose() - body.centre_m;
  const Eigen::Vector3d moment = r.cross(w) / body.size_m;
  for (int i = 0; i < 3; ++i) {
    entries.emplace_back(rows.first_patch_row + 6 * patch + i, column, w(i));
    entries.emplace_back(rows.first_patch_row + 6 * patch + 3 + i, column, moment(i));
  }
}

std::vector<int> rows_with_patches(const mesh::LagrangeNodes& nodes, const std::vector<int>& free_rows,
                                   const std::vector<RigidPatch>& rigid) {
  const RowMap own = row_map(nodes.positions.rows(), free_rows, {});
  std::vector<int> patch_of(static_cast<std::size_t>(nodes.positions.rows()), -1);
  for (std::size_t p = 0; p < rigid.size(); ++p) {
    for (const int node : rigid[p].nodes) {
      int& patch = patch_of[static_cast<std::size_t>(node)];
      if (patch >= 0) {
        throw core::InputError("rigid connections \"" + rigid[static_cast<std::size_t>(patch)].name + "\" and \"" +
                               rigid[p].name + "\" share nodes: make them one, or move them apart");
      }
      patch = static_cast<int>(p);
      const auto* row = own.row_of.data() + 3 * static_cast<std::size_t>(node);
      if (row[0] < 0 || row[1] < 0 || row[2] < 0) {
        throw core::InputError("rigid connection \"" + rigid[p].name +
                               "\" reaches nodes that a support holds: move it off the support");
      }
    }
  }
  std::vector<int> rows;
  for (const int row : free_rows) {
    if (patch_of[static_cast<std::size_t>(row / 3)] < 0) rows.push_back(row);
  }
  const int first = 3 * static_cast<int>(nodes.positions.rows());
  for (int i = 0; i < 6 * static_cast<int>(rigid.size()); ++i) rows.push_back(first + i);
  return rows;
}

linalg::SparseMatrix with_patches(const linalg::SparseMatrix& A, const mesh::LagrangeNodes& nodes,
                                  const std::vector<int>& free_rows, const std::vector<RigidPatch>& rigid) {
  const linalg::SparseMatrix T = patch_columns(nodes, free_rows, rigid);
  const std::vector<int> rows = rows_with_patches(nodes, free_rows, rigid);
  const auto kept = static_cast<int>(rows.size() - 6 * rigid.size());
  const RowMap old = row_map(nodes.positions.rows(), free_rows, {});
  std::vector<int> new_row(free_rows.size(), -1);
  for (int i = 0; i < kept; ++i)
    new_row[static_cast<std::size_t>(old.row_of[static_cast<std::size_t>(rows[static_cast<std::size_t>(i)])])] = i;
  // u = [1 T] q with q = [kept rows; patches]: the result has the blocks A (kept rows), A T, its transpose, and Tᵀ A T.
  // It is filled column by column with ascending rows.
  const linalg::SparseMatrix AT = A * T;
  const linalg::SparseMatrix TA = AT.transpose();
  const Eigen::MatrixXd TAT = T.transpose() * AT;
  const auto size = static_cast<Eigen::Index>(rows.size());
  linalg::SparseMatrix B(size, size);
  B.reserve(A.nonZeros() + 2 * AT.nonZeros() + TAT.size());
  for (int column = 0; column < static_cast<int>(size); ++column) {
    B.startVec(column);
    const bool of_patch = column >= kept;
    const int from =
        of_patch ? column - kept : old.row_of[static_cast<std::size_t>(rows[static_cast<std::size_t>(column)])];
    for (linalg::SparseMatrix::InnerIterator it(of_patch ? AT : A, from); it; ++it) {
      const int row = new_row[static_cast<std::size_t>(it.row())];
      if (row >= 0) B.insertBack(row, column) = it.value();
    }
    if (of_patch) {
      for (int i = 0; i < static_cast<int>(TAT.rows()); ++i) B.insertBack(kept + i, column) = TAT(i, from);
    } else {
      for (linalg::SparseMatrix::InnerIterator it(TA, from); it; ++it)
        B.insertBack(kept + static_cast<int>(it.row()), column) = it.value();
    }
  }
  B.finalize();
  return B;
}

}  // namespace thinwall::fem
