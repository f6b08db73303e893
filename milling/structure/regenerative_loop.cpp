#include "milling/structure/regenerative_loop.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "core/dense_factorisations.hpp"
#include "core/interrupt.hpp"
#include "milling/cut/product_rule.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

/// The motion of the modes under polynomial forces of an element of `length_s`. The last few are kept, each thread its
/// own: along a path the poles often stay while shapes change.
std::shared_ptr<const ModeMoments> moments_of(const Eigen::VectorXcd& poles, int nodes, double length_s) {
  struct Known {
    Eigen::VectorXcd poles;
    int nodes = 0;
    double length_s = 0.0;
    std::shared_ptr<const ModeMoments> moments;
  };
  thread_local std::array<Known, 6> known;  // the grids of a row
  thread_local std::size_t oldest = 0;
  for (const Known& k : known) {
    if (k.nodes == nodes && k.length_s == length_s && k.poles.size() == poles.size() && k.poles == poles)
      return k.moments;
  }
  const Eigen::VectorXcd exponent = poles * length_s;
  ModeMoments moments = shared_product_rule(nodes, exponent.lpNorm<Eigen::Infinity>()).moments(exponent);
  for (Eigen::MatrixXcd& at_node : moments.inside) at_node *= length_s;
  moments.end *= length_s;
  known[oldest] = {poles, nodes, length_s, std::make_shared<const ModeMoments>(std::move(moments))};
  return known[std::exchange(oldest, (oldest + 1) % known.size())].moments;
}

/// The motion of the modes under unit modal forces at the nodes: at a node, and at the end of the period.
class ModeHistory {
 public:
  ModeHistory(const Eigen::VectorXcd& poles, const ContactGrid& grid, double seconds_per_rad)
      : poles_(poles), grid_(grid), seconds_per_rad_(seconds_per_rad) {
    double last_length = -1.0;
    moments_.reserve(grid.elements.size());
    for (const CutElement& e : grid.elements) {
      // Teeth are in the cut one after the other for equal times: their elements share their moments.
      const double length = (e.to_rad - e.from_rad) * seconds_per_rad;
      const bool as_before = !moments_.empty() && std::abs(length - last_length) <= 1e-12 * length;
      moments_.push_back(as_before ? moments_.back() : moments_of(poles, e.nodes, length));
      if (!as_before) last_length = length;
    }
  }

  /// e^{λ t}, poles.
  [[nodiscard]] Eigen::VectorXcd flow(double rad) const { return (poles_ * (rad * seconds_per_rad_)).array().exp(); }

  /// The motion at a node, poles × the nodes up to the end of its element; later ones have no part in it.
  [[nodiscard]] Eigen::MatrixXcd at_node(int node) const {
    Eigen::MatrixXcd history;
    for (std::size_t e = moments_.size(); e-- > 0;) {
      const CutElement& element = grid_.elements[e];
      const int inside = node - element.first_node;
      if (inside < 0) continue;
      if (inside < element.nodes) {
        // The node's own element, the last that matters: within it a node feels forces of later ones, too, since the
        // force is one polynomial over the element.
        history.resize(poles_.size(), element.first_node + element.nodes);
        history.rightCols(element.nodes) = moments_[e]->inside[static_cast<std::size_t>(inside)];
      } else {
        // An element that has passed: the motion at its end decays until the node; later elements add their own.
        history.middleCols(element.first_node, element.nodes).noalias() =
            flow(grid_.node_rad(node) - element.to_rad).asDiagonal() * moments_[e]->end;
      }
    }
    return history;
  }

  /// The motion at the end of the period, poles × nodes.
  [[nodiscard]] Eigen::MatrixXcd at_end() const {
    Eigen::MatrixXcd history(poles_.size(), grid_.node_rad.size());
    for (std::size_t e = 0; e < moments_.size(); ++e) {
      const CutElement& element = grid_.elements[e];
      history.middleCols(element.first_node, element.nodes) =
          flow(grid_.period_rad - element.to_rad).asDiagonal() * moments_[e]->end;
    }
    return history;
  }

 private:
  const Eigen::VectorXcd& poles_;
  const ContactGrid& grid_;
  double seconds_per_rad_;
  std::vector<std::shared_ptr<const ModeMoments>> moments_;  ///< of each element
};

/// The share of a node's displacement q in the chip of a contact: chipᵀ q.
struct ChipTerm {
  Index row;
  Eigen::Vector3d chip;
};

/// The contacts in whose chips a node counts: of this period (its own, less the past within it), and of the next one.
struct ChipTerms {
  std::vector<std::vector<ChipTerm>> now, before;  ///< of each node
};

ChipTerms chip_terms(const ContactGrid& grid) {
  const auto nodes = static_cast<std::size_t>(grid.node_rad.size());
  ChipTerms result{std::vector<std::vector<ChipTerm>>(nodes), std::vector<std::vector<ChipTerm>>(nodes)};
  for (std::size_t k = 0; k < grid.contacts.size(); ++k) {
    const auto row = static_cast<Index>(k);
    result.now[static_cast<std::size_t>(grid.contacts[k].node)].push_back({row, grid.contacts[k].chip});
    for (const Past& past : grid.contacts[k].past) {
      const auto node = static_cast<std::size_t>(past.node);
      // The past within this period is known from this period's own forces; what lies before its start enters the
      // next equation as h. Its sign is that of h in c = ... − h.
      if (past.previous_period) result.before[node].push_back({row, past.chip});
      else result.now[node].push_back({row, -past.chip});
    }
  }
  return result;
}

/// The motion of the modes at a node in the chips of the contacts there: `flow` e^{λt}, and `forced`, the motion by
/// unit forces at all contacts, real parts above imaginary ones, 2 poles × contacts. It is added to E and to the
/// transpose of K.
void add_motion(const RelativeStructure& structure, const std::vector<ChipTerm>& terms, const Eigen::VectorXcd& flow,
                const Eigen::MatrixXd& forced, const Eigen::VectorXd& share, Eigen::MatrixXd& E, Eigen::MatrixXd& Kt) {
  if (terms.empty()) return;
  const Index poles = flow.size();
  Eigen::MatrixXd seen(2 * poles, static_cast<Index>(terms.size()));
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Eigen::VectorXcd shape = structure.phi.transpose() * terms[i].chip;
    const Eigen::VectorXcd free = shape.cwiseProduct(flow);
    E.row(terms[i].row).head(poles) += free.real();
    E.row(terms[i].row).tail(poles) += free.imag();
    // A mode and its conjugate together move by twice the real part; a real pole has half a share.
    seen.col(static_cast<Index>(i)) << 2.0 * shape.real().cwiseProduct(share), -2.0 * shape.imag().cwiseProduct(share);
  }
  // One real product for all terms of the node, since real parts alone are wanted.
  const Eigen::MatrixXd motion = forced.transpose() * seen;
  for (std::size_t i = 0; i < terms.size(); ++i) Kt.col(terms[i].row) += motion.col(static_cast<Index>(i));
}

/// Adds the static residual R: a contact's force moves its own node at once, and no other.
void add_residual(const RelativeStructure& structure, const ContactGrid& grid,
                  const std::vector<std::vector<ChipTerm>>& terms, Eigen::MatrixXd& K) {
  if (structure.R.isZero(0.0)) return;
  for (Index l = 0; l < K.cols(); ++l) {
    const EdgeContact& from = grid.contacts[static_cast<std::size_t>(l)];
    const Eigen::Vector3d motion = structure.R * from.force;
    for (const ChipTerm& term : terms[static_cast<std::size_t>(from.node)]) K(term.row, l) += term.chip.dot(motion);
  }
}

/// The matrix of the previous period, which is this period's where all delays are one period.
const Eigen::MatrixXd& before(const Eigen::MatrixXd& now, const Eigen::MatrixXd& previous) {
  return previous.size() > 0 ? previous : now;
}

/// X with Σ E_k a_k L_k + Ē_k a'_k L̄_k = [Re E, Im E] X, real and imaginary parts of X side by side: half the products
/// of the complex sum, and real ones. Shape 2 poles × 2 contacts.
Eigen::MatrixXd modal_motion(const Eigen::MatrixXd& L, const Eigen::ArrayXcd& a, const Eigen::ArrayXcd& conjugate) {
  const Index poles = a.size(), contacts = L.cols();
  const Eigen::ArrayXcd even = a + conjugate;
  const Eigen::ArrayXcd odd = complex<double>(0.0, 1.0) * (a - conjugate);
  Eigen::MatrixXd X(2 * poles, 2 * contacts);
  const auto fill = [&](Index first, const Eigen::ArrayXd& of_even, const Eigen::ArrayXd& of_odd) {
    for (Index l = 0; l < contacts; ++l) {
      const auto re = L.col(l).head(poles).array(), im = L.col(l).tail(poles).array();
      X.col(first + l).head(poles) = of_even * re + of_odd * im;
      X.col(first + l).tail(poles) = of_odd * re - of_even * im;
    }
  };
  fill(0, even.real(), odd.real());
  fill(contacts, even.imag(), odd.imag());
  return X;
}

/// [Re E, Im E] X as complex numbers, contacts × contacts.
Eigen::MatrixXcd seen_motion(const Eigen::MatrixXd& E, const Eigen::MatrixXd& X) {
  const Index contacts = E.rows();
  const Eigen::MatrixXd product = E * X;
  Eigen::MatrixXcd result(contacts, contacts);
  result.real() = product.leftCols(contacts);
  result.imag() = product.rightCols(contacts);
  return result;
}

/// A real matrix times a complex vector.
Eigen::VectorXcd product(const Eigen::Ref<const Eigen::MatrixXd>& A, const Eigen::VectorXcd& v) {
  Eigen::MatrixX2d parts(v.size(), 2);
  parts << v.real(), v.imag();
  const Eigen::MatrixX2d result = A * parts;
  return result.col(0) + complex<double>(0.0, 1.0) * result.col(1);
}

/// One pole, or the conjugate of one, between two vectors: lᵀ E, lᵀ E⁻ and L r.
struct OfPole {
  complex<double> flow, seen, seen_before, moved;
};

/// The matrices of a loop between the vectors l and r, by products of a matrix and a vector.
struct BetweenVectors {
  BetweenVectors(const RegenerativeLoop& loop, const Eigen::VectorXcd& l, const Eigen::VectorXcd& r)
      : K(l.cwiseProduct(product(loop.K, r)).sum()),
        K_before(loop.K_previous.size() > 0 ? l.cwiseProduct(product(loop.K_previous, r)).sum() : K),
        loop_(loop),
        seen_(product(loop.E.transpose(), l)),
        seen_before_(loop.E_previous.size() > 0 ? product(loop.E_previous.transpose(), l) : seen_),
        moved_(product(loop.L, r)) {}

  complex<double> K, K_before;  ///< lᵀ K r, lᵀ K⁻ r

  /// Σ share of(k) over the poles and their conjugates.
  template <typename Of>
  [[nodiscard]] complex<double> over_poles(Of of) const {
    complex<double> sum = 0.0;
    const Index poles = loop_.flow.size();
    // A pole's row of [Re E, Im E]ᵀ l and [Re L; Im L] r has its real part first; with ±i the other makes E or its
    // conjugate of it.
    const auto part = [poles](const Eigen::VectorXcd& v, Index k, double sign) {
      return v(k) + complex<double>(0.0, sign) * v(poles + k);
    };
    for (Index k = 0; k < poles; ++k) {
      for (const double sign : {1.0, -1.0}) {
        const complex<double> flow = sign > 0.0 ? loop_.flow(k) : std::conj(loop_.flow(k));
        sum +=
            loop_.share(k) * of(OfPole{flow, part(seen_, k, sign), part(seen_before_, k, sign), part(moved_, k, sign)});
      }
    }
    return sum;
  }

 private:
  const RegenerativeLoop& loop_;
  Eigen::VectorXcd seen_, seen_before_, moved_;
};

}  // namespace

RegenerativeLoop regenerative_loop(const RelativeStructure& structure, const ContactGrid& grid,
                                   double spindle_speed_rpm) {
  const double seconds_per_rad = 30.0 / (std::numbers::pi * spindle_speed_rpm);
  const Index poles = structure.poles.size();
  const auto contacts = static_cast<Index>(grid.contacts.size());
  RegenerativeLoop loop;
  loop.period_s = grid.period_rad * seconds_per_rad;
  loop.flow = (structure.poles * loop.period_s).array().exp();
  loop.share = structure.poles.imag().unaryExpr([](double w) { return w != 0.0 ? 1.0 : 0.5; });
  loop.E = Eigen::MatrixXd::Zero(contacts, 2 * poles);
  loop.K = Eigen::MatrixXd::Zero(contacts, contacts);
  if (!grid.one_delay) {
    loop.E_previous = loop.E;
    loop.K_previous = loop.K;
  }
  // Forces of the nodes move the modes; contacts are ways in which a node's force acts, so that a column of a contact
  // is its node's, times the modal force of its direction.
  const ModeHistory history(structure.poles, grid, seconds_per_rad);
  Eigen::MatrixXcd modal_force(poles, contacts);
  for (Index l = 0; l < contacts; ++l)
    modal_force.col(l) = structure.b.transpose() * grid.contacts[static_cast<std::size_t>(l)].force;
  const auto forced_by_contacts = [&](const Eigen::MatrixXcd& by_nodes) {
    Eigen::MatrixXd forced = Eigen::MatrixXd::Zero(2 * poles, contacts);
    for (Index l = 0; l < contacts; ++l) {
      const Index node = grid.contacts[static_cast<std::size_t>(l)].node;
      if (node >= by_nodes.cols()) continue;
      const Eigen::VectorXcd motion = modal_force.col(l).cwiseProduct(by_nodes.col(node));
      forced.col(l) << motion.real(), motion.imag();
    }
    return forced;
  };
  // Node by node, since the motion of all modes at a node serves all contacts that look at it. A contact's row of K is
  // gathered as a column, whose numbers lie side by side.
  Eigen::MatrixXd Kt = loop.K, Kt_previous = loop.K_previous;
  const ChipTerms terms = chip_terms(grid);
  for (int node = 0; node < static_cast<int>(grid.node_rad.size()); ++node) {
    core::check_interrupt();
    const Eigen::VectorXcd flow = history.flow(grid.node_rad(node));
    const Eigen::MatrixXd forced = forced_by_contacts(history.at_node(node));
    const auto i = static_cast<std::size_t>(node);
    add_motion(structure, terms.now[i], flow, forced, loop.share, loop.E, Kt);
    if (!grid.one_delay) add_motion(structure, terms.before[i], flow, forced, loop.share, loop.E_previous, Kt_previous);
  }
  loop.K = Kt.transpose();
  loop.K_previous = Kt_previous.transpose();
  loop.L = forced_by_contacts(history.at_end());
  add_residual(structure, grid, terms.now, loop.K);
  if (!grid.one_delay) add_residual(structure, grid, terms.before, loop.K_previous);
  return loop;
}

Eigen::MatrixXd period_map(const RegenerativeLoop& loop, double depth_m) {
  const Index poles = loop.flow.size();
  const Index contacts = loop.K.rows();
  const Index states = poles + (loop.share.array() == 1.0).count();
  // Real columns and rows of the modes: Re z of all, Im z of pairs.
  Eigen::MatrixXd E(contacts, states), E_previous(contacts, states), L(states, contacts);
  Eigen::MatrixXd map = Eigen::MatrixXd::Zero(states + contacts, states + contacts);
  const Eigen::MatrixXd& E_before = before(loop.E, loop.E_previous);
  Index im = poles;
  for (Index k = 0; k < poles; ++k) {
    const double twice = 2.0 * loop.share(k);
    E.col(k) = twice * loop.E.col(k);
    E_previous.col(k) = twice * E_before.col(k);
    L.row(k) = loop.L.row(k);
    map(k, k) = loop.flow(k).real();
    if (loop.share(k) != 1.0) continue;
    E.col(im) = -twice * loop.E.col(poles + k);
    E_previous.col(im) = -twice * E_before.col(poles + k);
    L.row(im) = loop.L.row(poles + k);
    map(im, im) = loop.flow(k).real();
    map(im, k) = loop.flow(k).imag();
    map(k, im) = -loop.flow(k).imag();
    ++im;
  }
  // c = (I + wK)⁻¹ (E z − h)
  Eigen::MatrixXd c(contacts, states + contacts);
  c << E, -Eigen::MatrixXd::Identity(contacts, contacts);
  const Eigen::MatrixXd system = Eigen::MatrixXd::Identity(contacts, contacts) + depth_m * loop.K;
  c = Eigen::PartialPivLU<Eigen::MatrixXd>(system).solve(c).eval();
  map.topRows(states).noalias() -= depth_m * (L * c);
  if (loop.K_previous.size() == 0) {
    // E⁻ = E and K⁻ = K, so that h⁺ = E z − w K c = c + h without a product.
    map.bottomRows(contacts) = c;
    map.bottomRightCorner(contacts, contacts).diagonal().array() += 1.0;
    return map;
  }
  map.bottomLeftCorner(contacts, states) = E_previous;
  map.bottomRows(contacts).noalias() -= depth_m * (loop.K_previous * c);
  return map;
}

complex<double> on_circle(double theta_rad) {
  return theta_rad == std::numbers::pi ? complex<double>(-1.0) : std::polar(1.0, theta_rad);
}

Eigen::MatrixXcd loop_gain(const RegenerativeLoop& loop, complex<double> mu) {
  const complex<double> past = 1.0 / mu;
  const Eigen::ArrayXcd gain = loop.share.array() / (mu - loop.flow.array());
  const Eigen::ArrayXcd conjugate_gain = loop.share.array() / (mu - loop.flow.conjugate().array());
  const Eigen::MatrixXd motion = modal_motion(loop.L, gain, conjugate_gain);
  // With one delay Z = (1 − 1/μ) (K + Σ …): the factor of regeneration of the zeroth-order solution.
  if (loop.K_previous.size() == 0) return (1.0 - past) * (loop.K.cast<complex<double>>() + seen_motion(loop.E, motion));
  return loop.K.cast<complex<double>>() + seen_motion(loop.E, motion) -
         past * (loop.K_previous.cast<complex<double>>() + seen_motion(loop.E_previous, motion));
}

complex<double> loop_gain(const RegenerativeLoop& loop, complex<double> mu, const Eigen::VectorXcd& l,
                          const Eigen::VectorXcd& r) {
  const complex<double> past = 1.0 / mu;
  const BetweenVectors of(loop, l, r);
  const auto sum = [&](const OfPole& k) { return (k.seen - past * k.seen_before) * k.moved / (mu - k.flow); };
  return of.K - past * of.K_before + of.over_poles(sum);
}

complex<double> loop_gain_slope(const RegenerativeLoop& loop, complex<double> mu, const Eigen::VectorXcd& l,
                                const Eigen::VectorXcd& r) {
  // dZ/dμ = K⁻/μ² + Σ (E − E⁻/μ) g' L + Σ E⁻ (g/μ²) L + the same of the conjugates, g = share/(μ − Φ)
  const complex<double> past = 1.0 / mu;
  const BetweenVectors of(loop, l, r);
  const auto sum = [&](const OfPole& k) {
    const complex<double> resonance = 1.0 / (mu - k.flow);
    return resonance * k.moved * (past * past * k.seen_before - resonance * (k.seen - past * k.seen_before));
  };
  return complex<double>(0.0, 1.0) * mu * (past * past * of.K_before + of.over_poles(sum));
}

}  // namespace thinwall::milling
