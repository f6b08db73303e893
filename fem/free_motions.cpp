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

dynamics::RigidKernel kernel(const mesh::LagrangeNodes& nodes, const std::vector<int>& fixed,
                             const std::vector<int>& piece, int which) {
  dynamics::RigidKernel k;
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
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
  for (const int row : fixed) {
    if (piece[static_cast<std::size_t>(row / 3)] != which) continue;
    const Eigen::Vector3d x = (nodes.positions.row(row / 3).transpose() - k.centre) / k.size;
    Eigen::Matrix<double, 6, 1> r;
    r << Eigen::Vector3d::Unit(row % 3), x.cross(Eigen::Vector3d::Unit(row % 3));
    gram += r * r.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(gram);
  const double largest = std::max(eigen.eigenvalues().maxCoeff(), 1.0);
  k.motions = eigen.eigenvectors().leftCols((eigen.eigenvalues().array() < 1e-10 * largest).count());
  return k;
}

}  // namespace

std::vector<std::string> free_motions(const mesh::LagrangeNodes& nodes, const std::vector<int>& fixed) {
  const std::vector<int> piece = mesh::pieces(static_cast<int>(nodes.positions.rows()), nodes.elements.rowwise());
  std::set<int> roots;  // a node of no element is no piece
  for (Eigen::Index e = 0; e < nodes.elements.rows(); ++e)
    roots.insert(piece[static_cast<std::size_t>(nodes.elements(e, 0))]);
  std::vector<std::string> words;
  for (const int root : roots) {
    const dynamics::RigidKernel k = kernel(nodes, fixed, piece, root);
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
