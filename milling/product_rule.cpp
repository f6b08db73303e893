#include "milling/product_rule.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace thinwall::milling {

GaussRule gauss_legendre(int count) {
  GaussRule rule{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (int i = 0; i < count; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));  // within Newton's reach of the root
    double slope = 0.0;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double before = 1.0;
      double value = x;
      for (int k = 2; k <= count; ++k)
        before = std::exchange(value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
      slope = count * (x * value - before) / (x * x - 1.0);
      const double step = value / slope;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    rule.node(i) = 0.5 * (1.0 + x);
    rule.weight(i) = 1.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

Eigen::VectorXd lagrange_polynomials(const Eigen::VectorXd& node, double at) {
  Eigen::VectorXd value = Eigen::VectorXd::Ones(node.size());
  for (Eigen::Index j = 0; j < node.size(); ++j) {
    for (Eigen::Index k = 0; k < node.size(); ++k) {
      if (k != j) value(j) *= (at - node(k)) / (node(j) - node(k));
    }
  }
  return value;
}

ProductRule::ProductRule(int nodes, double largest_exponent) : node_(gauss_legendre(nodes).node) {
  // Degree of the polynomial, and points for the exponential: its Legendre series ends at about |z|/2.
  const GaussRule rule = gauss_legendre((nodes + 1) / 2 + 8 + static_cast<int>(std::ceil(0.6 * largest_exponent)));
  distance_ = 1.0 - rule.node.array();
  for (int i = 0; i <= nodes; ++i) {
    const double c = i < nodes ? node_(i) : 1.0;
    Eigen::MatrixXd table(rule.node.size(), nodes);
    for (Eigen::Index q = 0; q < rule.node.size(); ++q)
      table.row(q) = c * rule.weight(q) * lagrange_polynomials(node_, c * rule.node(q)).transpose();
    table_.push_back(std::move(table));
  }
}

Eigen::RowVectorXcd ProductRule::row(Eigen::Index i, std::complex<double> z) const {
  const double c = i < node_.size() ? node_(i) : 1.0;
  const Eigen::ArrayXd size = (z.real() * c * distance_.array()).exp();
  const Eigen::ArrayXd phase = z.imag() * c * distance_.array();
  const Eigen::MatrixXd& table = table_[static_cast<std::size_t>(i)];
  Eigen::RowVectorXcd result(node_.size());
  result.real() = (size * phase.cos()).matrix().transpose() * table;
  result.imag() = (size * phase.sin()).matrix().transpose() * table;
  return result;
}

ModeMoments ProductRule::moments(std::complex<double> z) const {
  const Eigen::Index n = node_.size();
  ModeMoments result{Eigen::MatrixXcd(n, n), end(z)};
  for (Eigen::Index i = 0; i < n; ++i) result.inside.row(i) = row(i, z);
  return result;
}

}  // namespace thinwall::milling
