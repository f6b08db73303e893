#include "fem/free_motions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "dynamics/motion_words.hpp"
#include "mesh/pieces.hpp"

namespace thinwall::fem {

namespace {

using Kernel = dynamics::RigidKernel;

/// The centre and size of a piece, as a kernel without motions.
Kernel without_motions(const mesh::LagrangeNodes& nodes, const std::vector<int>& piece, int which) {
  Kernel k;
  double members = 0.0;
  for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i) {
    if (piece[static_cast<std::size_t>(i)] != which) continue;
    k.centre += nodes.positions.row(i).transpose();
    members += 1.0;
  }
  k.centre /= members;
  for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i) {
    if (piece[static_cast<std::size_t>(i)] != which) continue;
    k.size = std::max(k.size, (nodes.positions.row(i).transpose() - k.centre).norm());
  }
  return k;
}

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Motions = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// The motions (orthonormal columns) divided into those in the kernel of the Gram matrix, with eigenvalues below
/// `bound`, and the rest.
std::pair<Motions, Motions> split(const Motions& motions, const Matrix6& gram, double bound) {
  if (motions.cols() == 0) return {motions, motions};
  const Eigen::MatrixXd seen = motions.transpose() * gram * motions;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(seen);
  const Eigen::Index none = (eigen.eigenvalues().array() < bound).count();
  return {motions * eigen.eigenvectors().leftCols(none),
          motions * eigen.eigenvectors().rightCols(motions.cols() - none)};
}

/// The Gram matrix of a restraint for the motions of the kernel: translation divided by the size, then rotation, about
/// its centre.
Matrix6 gram_of(const Restraint& restraint, const Kernel& k) {
  Matrix6 X = Matrix6::Identity();
  const Eigen::Vector3d r = (restraint.about - k.centre) / k.size;
  for (int axis = 0; axis < 3; ++axis) X.block<3, 1>(0, 3 + axis) = Eigen::Vector3d::Unit(axis).cross(r);
  Eigen::Matrix<double, 6, 1> scale;
  scale << Eigen::Vector3d::Ones(), Eigen::Vector3d::Constant(1.0 / k.size);
  return X.transpose() * scale.asDiagonal() * restraint.gram * scale.asDiagonal() * X;
}

/// The rigid motions that one piece keeps. They are found in three steps, each on what the one before left: the motions
/// that fixed rows leave; those of them that no restraint touches at all, by Gram matrices of unit trace, so that a
/// soft restraint beside a stiff one counts; and those that are restrained, but more softly than round-off of K.
Kernel kernel(const mesh::LagrangeNodes& nodes, const Holding& holding, const std::vector<int>& piece, int which) {
  Kernel k = without_motions(nodes, piece, which);
  Matrix6 gram = Matrix6::Zero();
  for (const int row : holding.fixed) {
    if (piece[static_cast<std::size_t>(row / 3)] != which) continue;
    const Eigen::Vector3d x = (nodes.positions.row(row / 3).transpose() - k.centre) / k.size;
    Eigen::Matrix<double, 6, 1> r;
    r << Eigen::Vector3d::Unit(row % 3), x.cross(Eigen::Vector3d::Unit(row % 3));
    gram += r * r.transpose();
  }
  Matrix6 relative = Matrix6::Zero();
  Matrix6 stiffness = Matrix6::Zero();  // N/m
  for (const Restraint& restraint : holding.restraints) {
    if (piece[static_cast<std::size_t>(restraint.node)] != which || !(restraint.stiffness_N_m > 0.0)) continue;
    const Matrix6 own = gram_of(restraint, k);
    if (!(own.trace() > 0.0)) continue;
    relative += own / own.trace();
    stiffness += restraint.stiffness_N_m * own;
  }
  const auto bound = [](const Matrix6& A) {
    return 1e-10 * std::max(Eigen::SelfAdjointEigenSolver<Matrix6>(A).eigenvalues().maxCoeff(), 1.0);
  };
  const Motions unfixed = split(Matrix6::Identity(), gram, bound(gram)).first;
  const auto [unrestrained, restrained] = split(unfixed, relative, bound(relative));
  const Motions soft = split(restrained, stiffness, holding.negligible_N_m).first;
  k.motions.resize(6, unrestrained.cols() + soft.cols());
  k.motions << unrestrained, soft;
  return k;
}

}  // namespace

std::vector<int> tied_pieces(const mesh::LagrangeNodes& nodes, const std::vector<std::vector<int>>& ties) {
  const auto count = static_cast<int>(nodes.positions.rows());
  std::vector<int> piece = mesh::pieces(count, nodes.elements.rowwise());
  if (ties.empty()) return piece;
  std::vector<std::vector<int>> cells = ties;
  for (int node = 0; node < count; ++node) cells.push_back({node, piece[static_cast<std::size_t>(node)]});
  return mesh::pieces(count, cells);
}

std::vector<std::string> free_motions(const mesh::LagrangeNodes& nodes, const std::vector<int>& fixed) {
  return free_motions(nodes, Holding{fixed, {}, {}, 0.0});
}

std::vector<std::string> free_motions(const mesh::LagrangeNodes& nodes, const Holding& holding) {
  const std::vector<int> piece = tied_pieces(nodes, holding.ties);
  std::set<int> roots;  // found by elements, because a node of no element is no piece
  for (Eigen::Index e = 0; e < nodes.elements.rows(); ++e)
    roots.insert(piece[static_cast<std::size_t>(nodes.elements(e, 0))]);
  std::vector<std::string> words;
  for (const int root : roots) {
    const Kernel k = kernel(nodes, holding, piece, root);
    for (const std::string& word : dynamics::in_words(k))
      words.push_back(roots.size() == 1 ? word : word + " of the piece around " + dynamics::place(k.centre, k.size));
  }
  return words;
}

std::string listed(const std::vector<std::string>& motions) {
  std::string line;
  for (const std::string& motion : motions) line += (line.empty() ? "" : ", ") + motion;
  return line;
}

}  // namespace thinwall::fem
