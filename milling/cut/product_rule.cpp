#include "milling/cut/product_rule.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/gauss_rule.hpp"

namespace thinwall::milling {

Eigen::VectorXd lagrange_polynomials(const Eigen::VectorXd& node, double at) {
  Eigen::VectorXd value = Eigen::VectorXd::Ones(node.size());
  for (Eigen::Index j = 0; j < node.size(); ++j) {
    for (Eigen::Index k = 0; k < node.size(); ++k) {
      if (k != j) value(j) *= (at - node(k)) / (node(j) - node(k));
    }
  }
  return value;
}

Eigen::VectorXd lagrange_slopes(const Eigen::VectorXd& node, Eigen::Index i) {
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(node.size());
  for (Eigen::Index j = 0; j < node.size(); ++j) {
    if (j == i) continue;
    slope(j) = 1.0 / (node(j) - node(i));
    for (Eigen::Index k = 0; k < node.size(); ++k) {
      if (k != j && k != i) slope(j) *= (node(i) - node(k)) / (node(j) - node(k));
    }
    slope(i) += 1.0 / (node(i) - node(j));
  }
  return slope;
}

namespace {

/// Gauss points that integrate a polynomial of the degree of `nodes` times e^{z s}, |z| up to `largest_exponent`, whose
/// Legendre series ends at about |z|/2.
core::GaussRule points_for(int nodes, double largest_exponent) {
  return core::gauss_legendre((nodes + 1) / 2 + 8 + static_cast<int>(std::ceil(0.6 * largest_exponent)));
}

/// length weight_q ℓ_j(from + length x_q), points × nodes.
Eigen::MatrixXd weighted_polynomials(const Eigen::VectorXd& node, const core::GaussRule& points, double from,
                                     double length) {
  Eigen::MatrixXd table(points.node.size(), node.size());
  for (Eigen::Index q = 0; q < points.node.size(); ++q)
    table.row(q) = length * points.weight(q) * lagrange_polynomials(node, from + length * points.node(q)).transpose();
  return table;
}

/// e^{z_k d_q}, real parts above imaginary ones: 2 modes × distances. As real numbers, for the tables that they are
/// multiplied by are real: half the products of a complex one.
Eigen::MatrixXd exponentials(const Eigen::VectorXcd& z, const Eigen::ArrayXd& distance) {
  const Eigen::Index modes = z.size();
  Eigen::MatrixXd result(2 * modes, distance.size());
  for (Eigen::Index q = 0; q < distance.size(); ++q) {
    const Eigen::ArrayXd size = (z.real().array() * distance(q)).exp();
    for (Eigen::Index k = 0; k < modes; ++k) {
      const double phase = z(k).imag() * distance(q);
      result(k, q) = size(k) * std::cos(phase);
      result(modes + k, q) = size(k) * std::sin(phase);
    }
  }
  return result;
}

Eigen::MatrixXcd as_complex(const Eigen::MatrixXd& parts) {
  const Eigen::Index modes = parts.rows() / 2;
  Eigen::MatrixXcd result(modes, parts.cols());
  result.real() = parts.topRows(modes);
  result.imag() = parts.bottomRows(modes);
  return result;
}

}  // namespace

ProductRule::ProductRule(int nodes, double largest_exponent)
    : ProductRule(core::gauss_legendre(nodes).node, largest_exponent) {}

ProductRule::ProductRule(const Eigen::VectorXd& given, double largest_exponent) : node_(given) {
  const auto nodes = static_cast<int>(given.size());
  const core::GaussRule whole = points_for(nodes, largest_exponent);
  // A force at s acts for 1 − s until the end: e^{z (1 − s)} is taken at these distances.
  distance_ = 1.0 - whole.node.array();
  whole_ = weighted_polynomials(node_, whole, 0.0, 1.0);
  Eigen::VectorXd ends(nodes + 2);
  // The motion at each node needs the integral up to it. From node to node the intervals are short, and few points do.
  ends << 0.0, node_, 1.0;
  gap_ = ends.tail(nodes + 1) - ends.head(nodes + 1);
  const core::GaussRule points = points_for(nodes, gap_.maxCoeff() * largest_exponent);
  gap_distance_ = 1.0 - points.node.array();
  for (int i = 0; i <= nodes; ++i) gap_table_.push_back(weighted_polynomials(node_, points, ends(i), gap_(i)));
}

Eigen::RowVectorXcd ProductRule::end(std::complex<double> z) const {
  return as_complex(exponentials(Eigen::VectorXcd::Constant(1, z), distance_) * whole_);
}

ModeMoments ProductRule::moments(const Eigen::VectorXcd& z) const {
  const Eigen::Index n = node_.size();
  ModeMoments result{{}, Eigen::MatrixXcd::Zero(z.size(), n)};
  result.inside.reserve(static_cast<std::size_t>(n));
  std::vector<Eigen::MatrixXd> decay(static_cast<std::size_t>(n / 2 + 1));
  for (Eigen::Index i = 0; i <= n; ++i) {
    const Eigen::Index same = std::min(i, n - i);  // the gaps are symmetric
    auto& in_gap = decay[static_cast<std::size_t>(same)];
    if (i == same) in_gap = exponentials(z * gap_(i), gap_distance_);
    const Eigen::VectorXcd over_gap = (z * gap_(i)).array().exp();
    // The state before the gap is carried over it, and the gap's own share is added. After the last gap this is the
    // end.
    result.end =
        (over_gap.asDiagonal() * result.end + as_complex(in_gap * gap_table_[static_cast<std::size_t>(i)])).eval();
    if (i < n) result.inside.push_back(result.end);
  }
  return result;
}

const ProductRule& shared_product_rule(int nodes, double exponent) {
  // In steps of √2 neighbouring speeds share a rule. More points than an exponent needs do no harm.
  thread_local std::map<std::pair<int, int>, ProductRule> rules;
  const int half_powers = std::max(4, static_cast<int>(std::ceil(2.0 * std::log2(std::max(exponent, 1.0)))));
  return rules.try_emplace({nodes, half_powers}, nodes, std::exp2(0.5 * half_powers)).first->second;
}

}  // namespace thinwall::milling
