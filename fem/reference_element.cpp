#include "fem/reference_element.hpp"

#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "core/error.hpp"
#include "mesh/lagrange_nodes.hpp"

namespace thinwall::fem {

namespace {

using Real = long double;
using Polynomial = std::vector<Real>;  // coefficients by rising power

/// P_m(s) = Π_{i<m} (p s − i)/(i + 1).
Polynomial silvester(int p, int m) {
  Polynomial c{1.0L};
  for (int i = 0; i < m; ++i) {
    Polynomial next(c.size() + 1, 0.0L);
    for (std::size_t j = 0; j < c.size(); ++j) {
      next[j] -= c[j] * static_cast<Real>(i) / static_cast<Real>(i + 1);
      next[j + 1] += c[j] * static_cast<Real>(p) / static_cast<Real>(i + 1);
    }
    c = std::move(next);
  }
  return c;
}

Polynomial derivative(const Polynomial& c) {
  Polynomial d(std::max<std::size_t>(1, c.size() - 1), 0.0L);
  for (std::size_t j = 1; j < c.size(); ++j) d[j - 1] = static_cast<Real>(j) * c[j];
  return d;
}

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial c(a.size() + b.size() - 1, 0.0L);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  }
  return c;
}

Real factorial(std::size_t n) {
  Real f = 1.0L;
  for (std::size_t i = 2; i <= n; ++i) f *= static_cast<Real>(i);
  return f;
}

/// ∫ Π_k f_k(λ_k) dV / V, term by term.
Real integral(const std::array<const Polynomial*, 4>& f) {
  // Σ over powers of 6 Π c γ! / (|γ| + 3)!: gather the coefficients by total power first.
  std::vector<Real> by_power{1.0L};
  for (const Polynomial* factor : f) {
    Polynomial weighted(factor->size());
    for (std::size_t j = 0; j < factor->size(); ++j) weighted[j] = (*factor)[j] * factorial(j);
    by_power = product(by_power, weighted);
  }
  Real sum = 0.0L;
  for (std::size_t g = 0; g < by_power.size(); ++g) sum += 6.0L * by_power[g] / factorial(g + 3);
  return sum;
}

/// Products of one-dimensional factors of two shape functions in one coordinate, with derivatives on neither, the
/// first, the second, both; indexed [derivative of a][derivative of b][m_a][m_b].
using Products = std::array<std::array<std::vector<std::vector<Polynomial>>, 2>, 2>;

Products factor_products(int p) {
  Products table;
  for (std::size_t da = 0; da < 2; ++da) {
    for (std::size_t db = 0; db < 2; ++db) {
      for (int ma = 0; ma <= p; ++ma) {
        std::vector<Polynomial> row;
        for (int mb = 0; mb <= p; ++mb) {
          const Polynomial a = da != 0U ? derivative(silvester(p, ma)) : silvester(p, ma);
          const Polynomial b = db != 0U ? derivative(silvester(p, mb)) : silvester(p, mb);
          row.push_back(product(a, b));
        }
        table[da][db].push_back(std::move(row));
      }
    }
  }
  return table;
}

/// ∫ ∂N_a/∂λ_k ∂N_b/∂λ_l dV / V with the four λ taken as independent; k or l = −1: no derivative.
Real pair_integral(const Products& table, const std::array<int, 4>& alpha, const std::array<int, 4>& beta, int k,
                   int l) {
  std::array<const Polynomial*, 4> f{};
  for (int c = 0; c < 4; ++c) {
    const auto i = static_cast<std::size_t>(c);
    f[i] = &table[c == k][c == l][static_cast<std::size_t>(alpha[i])][static_cast<std::size_t>(beta[i])];
  }
  return integral(f);
}

ReferenceElement make(int order) {
  const auto alphas = mesh::lattice(order);
  const Products table = factor_products(order);
  ReferenceElement element;
  element.order = order;
  element.nodes = static_cast<int>(alphas.size());
  element.mass.resize(element.nodes, element.nodes);
  element.stiffness.resize(9, static_cast<Eigen::Index>(element.nodes) * element.nodes);
  for (int b = 0; b < element.nodes; ++b) {
    for (int a = 0; a < element.nodes; ++a) {
      const auto& alpha = alphas[static_cast<std::size_t>(a)];
      const auto& beta = alphas[static_cast<std::size_t>(b)];
      element.mass(a, b) = static_cast<double>(pair_integral(table, alpha, beta, -1, -1));
      std::array<std::array<Real, 4>, 4> d{};
      for (int k = 0; k < 4; ++k) {
        for (int l = 0; l < 4; ++l)
          d[static_cast<std::size_t>(k)][static_cast<std::size_t>(l)] = pair_integral(table, alpha, beta, k, l);
      }
      for (std::size_t k = 1; k < 4; ++k) {
        for (std::size_t l = 1; l < 4; ++l) {
          element.stiffness(static_cast<Eigen::Index>(3 * (k - 1) + l - 1),
                            a + static_cast<Eigen::Index>(element.nodes) * b) =
              static_cast<double>(d[k][l] - d[0][l] - d[k][0] + d[0][0]);
        }
      }
    }
  }
  return element;
}

}  // namespace

Eigen::VectorXd shape_functions(int order, const Eigen::Vector4d& lambda) {
  const auto alphas = mesh::lattice(order);
  Eigen::VectorXd N = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(alphas.size()));
  for (std::size_t a = 0; a < alphas.size(); ++a) {
    for (std::size_t k = 0; k < 4; ++k) {
      for (int i = 0; i < alphas[a][k]; ++i) {
        N(static_cast<Eigen::Index>(a)) *= (order * lambda(static_cast<Eigen::Index>(k)) - i) / (i + 1.0);
      }
    }
  }
  return N;
}

Eigen::MatrixX3d shape_slopes(int order, const Eigen::Vector4d& lambda) {
  // P_m and P_m' at the four coordinates, by the recurrence of their factors.
  Eigen::Matrix<double, Eigen::Dynamic, 4> P = Eigen::MatrixXd::Ones(order + 1, 4);
  Eigen::Matrix<double, Eigen::Dynamic, 4> dP = Eigen::MatrixXd::Zero(order + 1, 4);
  for (int k = 0; k < 4; ++k) {
    for (int m = 0; m < order; ++m) {
      const double factor = (order * lambda(k) - m) / (m + 1.0);
      P(m + 1, k) = P(m, k) * factor;
      dP(m + 1, k) = dP(m, k) * factor + P(m, k) * order / (m + 1.0);
    }
  }
  const auto alphas = mesh::lattice(order);
  Eigen::MatrixX3d slopes(static_cast<Eigen::Index>(alphas.size()), 3);
  for (std::size_t a = 0; a < alphas.size(); ++a) {
    Eigen::Vector4d d;  // by the four coordinates as if they were independent
    for (int k = 0; k < 4; ++k) {
      d(k) = dP(alphas[a][static_cast<std::size_t>(k)], k);
      for (int other = 0; other < 4; ++other) {
        if (other != k) d(k) *= P(alphas[a][static_cast<std::size_t>(other)], other);
      }
    }
    slopes.row(static_cast<Eigen::Index>(a)) = d.tail<3>().transpose().array() - d(0);
  }
  return slopes;
}

const ReferenceElement& reference_element(int order) {
  if (order < 1 || order > 6) throw core::InputError("element order " + std::to_string(order) + " is outside 1 to 6");
  static std::array<std::unique_ptr<ReferenceElement>, 7> made;
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  auto& element = made[static_cast<std::size_t>(order)];
  if (!element) element = std::make_unique<ReferenceElement>(make(order));
  return *element;
}

}  // namespace thinwall::fem
