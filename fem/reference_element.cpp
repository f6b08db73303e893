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

/// The polynomial P_m(s) = Π_{i<m} (p s − i)/(i + 1) of Silvester 1969.
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

/// The polynomial Σ j! c_j s^j for Σ c_j s^j. The factorials γ_k! of ∫ λ^γ dV = 6V Π γ_k! / (|γ| + 3)! are so applied
/// to each factor beforehand; what is left depends on the sum |γ| of the powers alone, so that a product of polynomials
/// in different coordinates may be multiplied out as if they were one coordinate.
Polynomial weighted(Polynomial c) {
  for (std::size_t j = 0; j < c.size(); ++j) c[j] *= factorial(j);
  return c;
}

/// The coordinate of a pair of barycentric coordinates, (λ₀, λ₁) or (λ₂, λ₃), by which a shape function is
/// differentiated.
enum Derivative : std::size_t { by_first, by_second, by_neither };

/// The weighted products of the factors of two shape functions in one pair of the four coordinates. An integrand N_a
/// N_b is the product of two such halves, one for each pair. There are few different halves and many integrals, so that
/// halves are computed once.
class Halves {
 public:
  explicit Halves(int order) : p_(static_cast<std::size_t>(order)), products_(9 * size() * size() * size() * size()) {
    const auto one = factors();
    for (const auto da : {by_first, by_second, by_neither}) {
      for (const auto db : {by_first, by_second, by_neither}) {
        for (std::size_t a0 = 0; a0 <= p_; ++a0) {
          for (std::size_t a1 = 0; a0 + a1 <= p_; ++a1) {
            for (std::size_t b0 = 0; b0 <= p_; ++b0) {
              for (std::size_t b1 = 0; b0 + b1 <= p_; ++b1)
                products_[place(da, db, a0, a1, b0, b1)] =
                    product(one[da == by_first][db == by_first][a0 * size() + b0],
                            one[da == by_second][db == by_second][a1 * size() + b1]);
            }
          }
        }
      }
    }
  }

  [[nodiscard]] const Polynomial& of(Derivative da, Derivative db, const int* alpha, const int* beta) const {
    return products_[place(da, db, static_cast<std::size_t>(alpha[0]), static_cast<std::size_t>(alpha[1]),
                           static_cast<std::size_t>(beta[0]), static_cast<std::size_t>(beta[1]))];
  }

 private:
  [[nodiscard]] std::size_t size() const { return p_ + 1; }
  [[nodiscard]] std::size_t place(Derivative da, Derivative db, std::size_t a0, std::size_t a1, std::size_t b0,
                                  std::size_t b1) const {
    return ((((da * 3 + db) * size() + a0) * size() + a1) * size() + b0) * size() + b1;
  }

  /// The products of the factors in one coordinate, indexed by [a is differentiated][b is differentiated][(p + 1) m_a +
  /// m_b].
  [[nodiscard]] std::array<std::array<std::vector<Polynomial>, 2>, 2> factors() const {
    std::array<std::array<std::vector<Polynomial>, 2>, 2> table;
    const int p = static_cast<int>(p_);
    for (std::size_t da = 0; da < 2; ++da) {
      for (std::size_t db = 0; db < 2; ++db) {
        for (int ma = 0; ma <= p; ++ma) {
          for (int mb = 0; mb <= p; ++mb) {
            const Polynomial a = da != 0U ? derivative(silvester(p, ma)) : silvester(p, ma);
            const Polynomial b = db != 0U ? derivative(silvester(p, mb)) : silvester(p, mb);
            table[da][db].push_back(weighted(product(a, b)));
          }
        }
      }
    }
    return table;
  }

  std::size_t p_;
  std::vector<Polynomial> products_;
};

/// The integral over V of the product of two halves, divided by V: Σ 6 c_i d_j / (i + j + 3)!.
Real integral(const Polynomial& c, const Polynomial& d) {
  static const auto by_power = [] {
    std::array<Real, 32> weights{};
    for (std::size_t g = 0; g < weights.size(); ++g) weights[g] = 6.0L / factorial(g + 3);
    return weights;
  }();
  Real sum = 0.0L;
  for (std::size_t i = 0; i < c.size(); ++i) {
    Real inner = 0.0L;
    for (std::size_t j = 0; j < d.size(); ++j) inner += d[j] * by_power[i + j];
    sum += c[i] * inner;
  }
  return sum;
}

/// The integral ∫ ∂N_a/∂λ_k ∂N_b/∂λ_l dV / V with the four λ taken as independent; k or l = 4 means no derivative.
Real pair_integral(const Halves& halves, const std::array<int, 4>& alpha, const std::array<int, 4>& beta, int k,
                   int l) {
  const auto in = [](int coordinate, int first) {
    return coordinate == first ? by_first : (coordinate == first + 1 ? by_second : by_neither);
  };
  return integral(halves.of(in(k, 0), in(l, 0), alpha.data(), beta.data()),
                  halves.of(in(k, 2), in(l, 2), alpha.data() + 2, beta.data() + 2));
}

/// The matrix with D̂^{kl}_ab at (k, l), from the integrals with independent λ and ∂/∂ξ_k = ∂/∂λ_{k+1} − ∂/∂λ₀.
Eigen::Matrix3d slopes_integral(const Halves& halves, const std::array<int, 4>& alpha, const std::array<int, 4>& beta) {
  Eigen::Matrix<Real, 4, 4> d;
  for (int k = 0; k < 4; ++k) {
    for (int l = 0; l < 4; ++l) d(k, l) = pair_integral(halves, alpha, beta, k, l);
  }
  Eigen::Matrix3d D;
  for (int k = 0; k < 3; ++k) {
    for (int l = 0; l < 3; ++l) D(k, l) = static_cast<double>(d(k + 1, l + 1) - d(0, l + 1) - d(k + 1, 0) + d(0, 0));
  }
  return D;
}

ReferenceElement integrated_element(int order) {
  const auto alphas = mesh::lattice(order);
  const Halves halves(order);
  ReferenceElement element;
  element.order = order;
  element.nodes = static_cast<int>(alphas.size());
  element.mass.resize(element.nodes, element.nodes);
  element.stiffness.resize(9, static_cast<Eigen::Index>(element.nodes) * element.nodes);
  for (Eigen::Index b = 0; b < element.nodes; ++b) {
    for (Eigen::Index a = 0; a <= b; ++a) {
      const auto& alpha = alphas[static_cast<std::size_t>(a)];
      const auto& beta = alphas[static_cast<std::size_t>(b)];
      element.mass(a, b) = element.mass(b, a) = static_cast<double>(pair_integral(halves, alpha, beta, 4, 4));
      const Eigen::Matrix3d D = slopes_integral(halves, alpha, beta);
      element.stiffness.col(a + element.nodes * b) = D.reshaped<Eigen::RowMajor>();
      element.stiffness.col(b + element.nodes * a) = D.reshaped();
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
  // P_m and its derivative at the four coordinates follow from a recurrence over their factors.
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
    Eigen::Vector4d d;  // derivatives by the four coordinates, taken as independent
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
  if (!element) element = std::make_unique<ReferenceElement>(integrated_element(order));
  return *element;
}

}  // namespace thinwall::fem
