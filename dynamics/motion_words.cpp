#include "dynamics/motion_words.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/dense_factorisations.hpp"
#include "core/units.hpp"

namespace thinwall::dynamics {

namespace {

/// The size, relative to one, below which a component of a direction or of a motion counts as round-off.
constexpr double negligible = 1e-6;

/// The simplest basis of the span of the columns of A (independent), as unit vectors: its reduced echelon form with the
/// largest pivots. If the span is that of coordinate axes, these axes come out in their order.
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

std::string direction(const Eigen::Vector3d& d) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (std::abs(d(k)) > 1.0 - negligible) return {"xyz"[k]};
  }
  return place(d, 1.0);
}

}  // namespace

std::string place(const Eigen::Vector3d& x, double scale) {
  const auto rounded = [&](double value) {
    return core::number_text(std::abs(value) < negligible * scale ? 0.0 : value, 3);
  };
  return "(" + rounded(x(0)) + ", " + rounded(x(1)) + ", " + rounded(x(2)) + ")";
}

std::vector<std::string> in_words(const RigidKernel& k) {
  std::vector<std::string> words;
  if (k.motions.cols() == 0) return words;
  Eigen::JacobiSVD<Eigen::MatrixXd> turns(Eigen::MatrixXd(k.motions.bottomRows<3>()),
                                          Eigen::ComputeFullU | Eigen::ComputeFullV);
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
      word += " through " + place(k.centre + k.size * axis.cross(t), k.size);
    words.push_back(word);
  }
  return words;
}

}  // namespace thinwall::dynamics
