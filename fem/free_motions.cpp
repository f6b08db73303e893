#include "fem/free_motions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "mesh/pieces.hpp"

namespace thinwall::fem {

namespace {

/// Below this, relative to one, a component of a direction or of a motion is round-off.
constexpr double negligible = 1e-6;

/// The free motions of one piece, orthonormal columns: translation over the size, then rotation, about the centre.
struct Kernel {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double size = 0.0;
  Eigen::Matrix<double, 6, Eigen::Dynamic> motions;
};

Kernel kernel(const mesh::LagrangeNodes& nodes, const std::vector<int>& fixed, const std::vector<int>& piece,
              int which) {
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

/// The span of the columns (independent) in its plainest basis, as unit vectors: reduced to echelon form with the
/// largest pivots, so that a span of axes comes out as these axes, in their order.
Eigen::Matrix3Xd plainest(Eigen::Matrix3Xd A) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> pivots;  // row, column
  Eigen::Array3d open = Eigen::Array3d::Ones();
  for (Eigen::Index c = 0; c < A.cols(); ++c) {
    Eigen::Index row = 0;
    Eigen::Index column = 0;
    (A.rightCols(A.cols() - c).cwiseAbs().array().colwise() * open).maxCoeff(&row, &column);
    A.col(c).swap(A.col(c + column));
    A.col(c) /= A(row, c);
    for (Eigen::Index other = 0; other < A.cols(); ++other) {
      if (other != c) A.col(other) -= (A(row, other) * A.col(c)).eval();
    }
    open(row) = 0.0;
    pivots.emplace_back(row, c);
  }
  std::sort(pivots.begin(), pivots.end());
  Eigen::Matrix3Xd sorted(3, A.cols());
  for (std::size_t i = 0; i < pivots.size(); ++i)
    sorted.col(static_cast<Eigen::Index>(i)) = A.col(pivots[i].second).normalized();
  return sorted;
}

std::string number(double x) {
  char text[32];
  (void)std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

/// "(x, y, z)", what is negligible beside `scale` as 0.
std::string triple(const Eigen::Vector3d& x, double scale) {
  const auto rounded = [&](double value) { return number(std::abs(value) < negligible * scale ? 0.0 : value); };
  return "(" + rounded(x(0)) + ", " + rounded(x(1)) + ", " + rounded(x(2)) + ")";
}

std::string direction(const Eigen::Vector3d& d) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (std::abs(d(k)) > 1.0 - negligible) return {"xyz"[k]};
  }
  return triple(d, 1.0);
}

/// The rotations are the motions that are orthogonal to all free translations; each turns about an axis a (of
/// unit length) through centre + a × t and advances by a·t a radian. Free translations across it leave no place to
/// name.
std::vector<std::string> in_words(const Kernel& k) {
  std::vector<std::string> words;
  if (k.motions.cols() == 0) return words;
  Eigen::JacobiSVD<Eigen::MatrixXd> turns(k.motions.bottomRows<3>(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  turns.setThreshold(negligible);
  const Eigen::Index rotations = (turns.singularValues().array() > negligible).count();
  const Eigen::Index translations = k.motions.cols() - rotations;
  const Eigen::Matrix3Xd slides = k.motions.topRows<3>() * turns.matrixV().rightCols(translations);
  const Eigen::Matrix3Xd directions = plainest(slides);
  for (Eigen::Index i = 0; i < translations; ++i) words.push_back("translation along " + direction(directions.col(i)));
  const Eigen::Matrix3Xd axes = plainest(turns.matrixU().leftCols(rotations));
  for (Eigen::Index i = 0; i < rotations; ++i) {
    const Eigen::Vector3d axis = axes.col(i);
    const Eigen::VectorXd share = turns.matrixV().leftCols(rotations) *
                                  turns.singularValues().head(rotations).cwiseInverse().asDiagonal() *
                                  (turns.matrixU().leftCols(rotations).transpose() * axis);
    const Eigen::Vector3d t = k.motions.topRows<3>() * share;
    const double advance = axis.dot(t);
    std::string word = (std::abs(advance) > negligible ? "screw about " : "rotation about ") + direction(axis);
    if ((slides - axis * (axis.transpose() * slides)).norm() < negligible)
      word += " through " + triple(k.centre + k.size * axis.cross(t), k.size);
    words.push_back(word);
  }
  return words;
}

}  // namespace

std::vector<std::string> free_motions(const mesh::LagrangeNodes& nodes, const std::vector<int>& fixed) {
  const std::vector<int> piece = mesh::pieces(static_cast<int>(nodes.positions.rows()), nodes.elements.rowwise());
  std::set<int> roots;  // a node of no element is no piece
  for (Eigen::Index e = 0; e < nodes.elements.rows(); ++e)
    roots.insert(piece[static_cast<std::size_t>(nodes.elements(e, 0))]);
  std::vector<std::string> words;
  for (const int root : roots) {
    const Kernel k = kernel(nodes, fixed, piece, root);
    for (const std::string& word : in_words(k))
      words.push_back(roots.size() == 1 ? word : word + " of the piece around " + triple(k.centre, k.size));
  }
  return words;
}

std::string listed(const std::vector<std::string>& motions) {
  std::string line;
  for (const std::string& motion : motions) line += (line.empty() ? "" : ", ") + motion;
  return line;
}

}  // namespace thinwall::fem
