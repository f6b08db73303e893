#include "identification/modal_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "identification/line_functions.hpp"

namespace thinwall::identification {

namespace {

using Complex = std::complex<double>;

/// An entry of the matrix.
struct Entry {
  Eigen::Index response = 0, reference = 0;
};

/// The unknowns of the search. `L` has a column a mode, whose largest entry `fixed` is 1.
struct Unknowns {
  Eigen::VectorXd ln_omega, ln_zeta;
  Eigen::MatrixXcd L;  ///< empty for free residues
  std::vector<Eigen::Index> fixed;

  [[nodiscard]] Eigen::Index modes() const { return ln_omega.size(); }
  [[nodiscard]] Eigen::Index count() const { return 2 * modes() + (L.size() > 0 ? 2 * (L.rows() - 1) * modes() : 0); }
  [[nodiscard]] Complex pole(Eigen::Index r) const {
    const double omega = std::exp(ln_omega(r)), zeta = std::exp(ln_zeta(r));
    return {-zeta * omega, omega * std::sqrt(std::max(1e-12, 1.0 - zeta * zeta))};
  }
};

/// The least squares problem: entries with their values and weights over the lines, real parts above imaginary ones, in
/// groups that share their linear unknowns.
struct Problem {
  const MeasuredLines* lines;
  ResidualTerms terms;
  Residues residues;
  Eigen::VectorXcd s;  ///< iω of each line
  std::vector<Entry> entries;
  WeightedEntries weighted;
  std::vector<std::vector<std::size_t>> groups;  ///< numbers of entries

  [[nodiscard]] const MeasuredLines& measured() const { return *lines; }

  [[nodiscard]] Eigen::Index term_count() const { return terms.highest_power + 1 + (terms.inertia ? 1 : 0); }
};

/// The solution of the linear unknowns, and what the search needs.
struct Evaluation {
  double cost = 0.0;  ///< sum of squares
  double size = 0.0;  ///< that of the weighted values
  Eigen::MatrixXd JtJ;
  Eigen::VectorXd Jtr;
  std::vector<Eigen::VectorXd> linear;  ///< of each group
};

void add_entry(Problem& p, const Entry& e) {
  const Eigen::Index lines = p.s.size();
  const auto column = static_cast<Eigen::Index>(p.entries.size());
  for (Eigen::Index i = 0; i < lines; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Complex H = p.measured().H[at](e.response, e.reference);
    p.weighted.values(i, column) = H.real();
    p.weighted.values(lines + i, column) = H.imag();
    p.weighted.weights(i, column) = std::sqrt(2.0 / p.measured().variance[at](e.response, e.reference));
  }
  p.entries.push_back(e);
}

Problem problem_of(const MeasuredLines& measured, const ModalFitOptions& options) {
  Problem p{&measured, options.terms, options.residues, {}, {}, {}, {}};
  p.s = Complex(0.0, 2.0 * std::numbers::pi) * measured.hz.cast<Complex>();
  const Eigen::Index entries = measured.responses() * measured.references();
  p.weighted.values.resize(2 * measured.lines(), entries);
  p.weighted.weights.resize(measured.lines(), entries);
  for (Eigen::Index j = 0; j < measured.responses(); ++j) {
    for (Eigen::Index k = 0; k < measured.references(); ++k) {
      const bool opens = options.residues == Residues::free || (options.residues == Residues::rank_one && k == 0) ||
                         (options.residues == Residues::symmetric && j == 0 && k == 0);
      if (opens) p.groups.emplace_back();
      p.groups.back().push_back(p.entries.size());
      add_entry(p, {j, k});
    }
  }
  return p;
}

/// The factor of a mode in an entry.
Complex factor(const Problem& p, const Unknowns& u, Eigen::Index mode, const Entry& e) {
  if (p.residues == Residues::free) return 1.0;
  if (p.residues == Residues::rank_one) return u.L(e.reference, mode);
  return u.L(e.response, mode) * u.L(e.reference, mode);
}

/// Its derivative by L(q, mode).
Complex factor_change(const Problem& p, const Unknowns& u, Eigen::Index mode, const Entry& e, Eigen::Index q) {
  if (p.residues == Residues::rank_one) return e.reference == q ? 1.0 : 0.0;
  return (e.response == q ? u.L(e.reference, mode) : 0.0) + (e.reference == q ? u.L(e.response, mode) : 0.0);
}

/// The columns of a pole with an amplitude a, in the few rows of an entry: a/(s − λ) + conj(a)/(s − λ*), or with the
/// squares of the denominators.
Eigen::VectorXd pair(const Eigen::MatrixXd& triangle, Eigen::Index mode, Complex amplitude, int power = 1) {
  const Eigen::Index at = 4 * mode + 2 * (power - 1);
  return amplitude.real() * triangle.col(at) + amplitude.imag() * triangle.col(at + 1);
}

/// The columns of a group: two a mode for the real and imaginary part of its residue, then the terms of each entry.
/// `triangles` are those of all entries.
Eigen::MatrixXd columns_of(const Problem& p, const Unknowns& u, const std::vector<std::size_t>& group,
                           const std::vector<Eigen::MatrixXd>& triangles) {
  const Eigen::Index m = u.modes(), n = p.term_count(), rows = triangles.front().rows();
  const auto entries = static_cast<Eigen::Index>(group.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows * entries, 2 * m + n * entries);
  for (Eigen::Index e = 0; e < entries; ++e) {
    const std::size_t number = group[static_cast<std::size_t>(e)];
    const Eigen::MatrixXd& triangle = triangles[number];
    for (Eigen::Index r = 0; r < m; ++r) {
      const Complex f = factor(p, u, r, p.entries[number]);
      A.col(2 * r).segment(e * rows, rows) = pair(triangle, r, f);
      A.col(2 * r + 1).segment(e * rows, rows) = pair(triangle, r, Complex(0.0, 1.0) * f);
    }
    A.block(e * rows, 2 * m + n * e, rows, n) = triangle.middleCols(4 * m, n);
  }
  return A;
}

/// The change of the group's model with each unknown, its linear unknowns c held.
Eigen::MatrixXd changes_of(const Problem& p, const Unknowns& u, const std::vector<std::size_t>& group,
                           const Eigen::VectorXd& c, const std::vector<Eigen::MatrixXd>& triangles) {
  const Eigen::Index m = u.modes(), rows = triangles.front().rows();
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(rows * static_cast<Eigen::Index>(group.size()), u.count());
  for (std::size_t i = 0; i < group.size(); ++i) {
    const Eigen::Index at = static_cast<Eigen::Index>(i) * rows;
    const Entry& entry = p.entries[group[i]];
    const Eigen::MatrixXd& triangle = triangles[group[i]];
    for (Eigen::Index r = 0; r < m; ++r) {
      const Complex a(c(2 * r), c(2 * r + 1)), f = factor(p, u, r, entry), pole = u.pole(r);
      const double omega = std::abs(pole), zeta = -pole.real() / omega;
      const Complex by_zeta(-zeta * omega, -zeta * zeta * omega / std::sqrt(1.0 - zeta * zeta));
      D.col(r).segment(at, rows) = pair(triangle, r, a * f * pole, 2);
      D.col(m + r).segment(at, rows) = pair(triangle, r, a * f * by_zeta, 2);
      Eigen::Index column = 2 * m + 2 * (u.L.rows() - 1) * r;
      for (Eigen::Index q = 0; q < u.L.rows(); ++q) {
        if (q == u.fixed[static_cast<std::size_t>(r)]) continue;
        const Complex change = a * factor_change(p, u, r, entry, q);
        if (change != 0.0) {
          D.col(column).segment(at, rows) = pair(triangle, r, change);
          D.col(column + 1).segment(at, rows) = pair(triangle, r, Complex(0.0, 1.0) * change);
        }
        column += 2;
      }
    }
  }
  return D;
}

/// Each entry's triangle of the functions at the poles, with its values in the last column.
std::vector<Eigen::MatrixXd> triangles_of(const Problem& p, const Unknowns& u, Digits digits) {
  Eigen::VectorXcd poles(u.modes());
  for (Eigen::Index r = 0; r < poles.size(); ++r) poles(r) = u.pole(r);
  return compressed(line_functions(p.s, poles, p.terms), p.weighted, digits);
}

Evaluation evaluate(const Problem& p, const Unknowns& u, Digits digits) {
  Evaluation result;
  result.JtJ = Eigen::MatrixXd::Zero(u.count(), u.count());
  result.Jtr = Eigen::VectorXd::Zero(u.count());
  const std::vector<Eigen::MatrixXd> triangles = triangles_of(p, u, digits);
  const Eigen::Index rows = triangles.front().rows();
  for (const std::vector<std::size_t>& group : p.groups) {
    Eigen::VectorXd y(rows * static_cast<Eigen::Index>(group.size()));
    for (std::size_t i = 0; i < group.size(); ++i)
      y.segment(rows * static_cast<Eigen::Index>(i), rows) = triangles[group[i]].col(rows - 1);
    const Eigen::MatrixXd A = columns_of(p, u, group, triangles);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
    const Eigen::Index n = A.cols();
    const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(A.rows(), n);
    const Eigen::VectorXd Qy = Q.transpose() * y;
    const Eigen::VectorXd c = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>().solve(Qy);
    const Eigen::VectorXd residual = y - Q * Qy;
    Eigen::MatrixXd J = changes_of(p, u, group, c, triangles);
    J -= Q * (Q.transpose() * J);
    result.cost += residual.squaredNorm();
    result.size += y.squaredNorm();
    result.JtJ.noalias() += J.transpose() * J;
    result.Jtr.noalias() -= J.transpose() * residual;
    result.linear.push_back(c);
  }
  return result;
}

Unknowns moved(const Unknowns& u, const Eigen::VectorXd& step) {
  constexpr double least_zeta = 1e-7, largest_zeta = 0.9;
  Unknowns next = u;
  const Eigen::Index m = u.modes();
  next.ln_omega += step.head(m);
  next.ln_zeta = (u.ln_zeta + step.segment(m, m)).cwiseMin(std::log(largest_zeta)).cwiseMax(std::log(least_zeta));
  Eigen::Index at = 2 * m;
  for (Eigen::Index r = 0; r < m; ++r) {
    for (Eigen::Index q = 0; q < u.L.rows(); ++q) {
      if (q == u.fixed[static_cast<std::size_t>(r)]) continue;
      next.L(q, r) += Complex(step(at), step(at + 1));
      at += 2;
    }
  }
  return next;
}

/// The search; what it ends with.
struct Found {
  Unknowns unknowns;
  Evaluation at;
  bool converged = false;
};

/// Levenberg's and Marquardt's steps from `u`, where the sum of squares is `at`.
Found descended(const Problem& p, Unknowns u, Evaluation at, const ModalFitOptions& options, Digits digits) {
  constexpr double largest_move = 0.3, most_damping = 1e12;
  const double settled = options.coarse ? 1e-6 : 1e-10, least_gain = options.coarse ? 1e-8 : 1e-12;
  double damping = 1e-3;
  for (int i = 0; i < options.most_steps; ++i) {
    core::check_interrupt();
    const Eigen::VectorXd diagonal = at.JtJ.diagonal().cwiseMax(1e-30 * at.JtJ.diagonal().maxCoeff());
    for (;;) {
      Eigen::MatrixXd damped = at.JtJ;
      damped.diagonal() += damping * diagonal;
      Eigen::VectorXd step = Eigen::LDLT<Eigen::MatrixXd>(damped).solve(-at.Jtr);
      // No frequency moves by more than a third at once.
      const double largest = step.head(u.modes()).cwiseAbs().maxCoeff();
      if (largest > largest_move) step *= largest_move / largest;
      const Unknowns next = moved(u, step);
      Evaluation there = evaluate(p, next, digits);
      const double gain = at.cost - there.cost;
      if (std::isfinite(there.cost) && gain >= 0.0) {
        const bool done = step.head(2 * u.modes()).cwiseAbs().maxCoeff() < settled || gain <= least_gain * at.cost;
        u = next;
        at = std::move(there);
        damping = std::max(1e-12, 0.1 * damping);
        if (done) return {u, at, true};
        break;
      }
      damping *= 10.0;
      // No step lowers the sum any more: round-off is reached where the last ones are tiny.
      if (damping > most_damping) return {u, at, step.cwiseAbs().maxCoeff() < 1e-6};
    }
  }
  return {u, at, false};
}

/// The search: with half the digits first, and with all where so little is left that half of them do not tell it.
Found search(const Problem& p, const Unknowns& u, const ModalFitOptions& options) {
  constexpr double told_by_half = 1e-6;
  Found found = descended(p, u, evaluate(p, u, Digits::half), options, Digits::half);
  if (options.coarse || found.at.cost > told_by_half * found.at.size) return found;
  return descended(p, found.unknowns, evaluate(p, found.unknowns, Digits::all), options, Digits::all);
}

/// Residue matrices of the modes.
std::vector<Eigen::MatrixXcd> residues_of(const Problem& p, const Found& found) {
  const Eigen::Index m = found.unknowns.modes();
  std::vector<Eigen::MatrixXcd> residues(static_cast<std::size_t>(m),
                                         Eigen::MatrixXcd::Zero(p.measured().responses(), p.measured().references()));
  for (std::size_t g = 0; g < p.groups.size(); ++g) {
    for (const std::size_t number : p.groups[g]) {
      const Entry& e = p.entries[number];
      for (Eigen::Index r = 0; r < m; ++r) {
        const Complex a(found.at.linear[g](2 * r), found.at.linear[g](2 * r + 1));
        residues[static_cast<std::size_t>(r)](e.response, e.reference) = a * factor(p, found.unknowns, r, e);
      }
    }
  }
  return residues;
}

/// The free residues' singular vectors as a start: L, largest entry 1.
void start_vectors(const std::vector<Eigen::MatrixXcd>& residues, Residues form, Unknowns& u) {
  const Eigen::Index references = residues.front().cols();
  u.L.resize(references, u.modes());
  u.fixed.assign(residues.size(), 0);
  for (std::size_t r = 0; r < residues.size(); ++r) {
    const Eigen::MatrixXcd R =
        form == Residues::symmetric ? Eigen::MatrixXcd(0.5 * (residues[r] + residues[r].transpose())) : residues[r];
    const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(R, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::VectorXcd left = svd.matrixV().col(0).conjugate();
    left.cwiseAbs().maxCoeff(&u.fixed[r]);
    u.L.col(static_cast<Eigen::Index>(r)) = left / left(u.fixed[r]);
  }
}

double second_singular(const Eigen::MatrixXcd& residue) {
  if (std::min(residue.rows(), residue.cols()) < 2) return 0.0;
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXcd>(residue).singularValues();
  return values(1) / values(0);
}

void take_terms(const Problem& p, const Found& found, ModalFit& fit) {
  const Eigen::Index m = found.unknowns.modes(), n = p.term_count();
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(p.measured().responses(), p.measured().references());
  if (p.terms.inertia) fit.inertia = zero;
  fit.powers.assign(static_cast<std::size_t>(p.terms.highest_power) + 1, zero);
  const double first = std::abs(p.s(0)), last = std::abs(p.s(p.s.size() - 1));
  for (std::size_t g = 0; g < p.groups.size(); ++g) {
    for (std::size_t e = 0; e < p.groups[g].size(); ++e) {
      const Entry& entry = p.entries[p.groups[g][e]];
      Eigen::Index at = 2 * m + n * static_cast<Eigen::Index>(e);
      if (p.terms.inertia) fit.inertia(entry.response, entry.reference) = found.at.linear[g](at++) * first * first;
      for (std::size_t power = 0; power < fit.powers.size(); ++power)
        fit.powers[power](entry.response, entry.reference) =
            found.at.linear[g](at++) / std::pow(last, static_cast<double>(power));
    }
  }
}

void require_start(const MeasuredLines& measured, const Eigen::VectorXcd& start, const ModalFitOptions& options) {
  require_usable(measured);
  if (start.size() == 0) throw core::InputError("identification: no pole to start from; give at least one");
  for (const Complex& pole : start) {
    if (!(pole.imag() > 0.0) || !(pole.real() < 0.0))
      throw core::InputError("identification: a pole to start from does not oscillate and decay; give Im > 0, Re < 0");
  }
  if (options.terms.highest_power < -1 || options.terms.highest_power > 6)
    throw core::InputError("identification: a highest power of " + std::to_string(options.terms.highest_power) +
                           ", must be -1 to 6");
  if (options.residues == Residues::symmetric && measured.responses() != measured.references())
    throw core::InputError("identification: symmetric residues need as many responses as references; take others");
  const Eigen::Index unknowns = 2 * start.size() + options.terms.highest_power + 2;
  if (2 * measured.lines() <= 2 * unknowns) {
    throw core::InputError("identification: " + std::to_string(measured.lines()) + " lines for " +
                           std::to_string(unknowns) + " unknowns of an entry, must be more; widen the band");
  }
}

}  // namespace

ResidualTerms terms_named(const std::string& word) {
  if (word == "none") return {false, -1};
  if (word == "constant") return {false, 0};
  if (word.size() == 1 && word[0] >= '0' && word[0] <= '6') return {true, word[0] - '0'};
  throw core::InputError("\"" + word + "\" names no terms; write none, constant, or the highest power of s, 0 to 6");
}

std::complex<double> FittedMode::pole() const {
  const double omega = 2.0 * std::numbers::pi * frequency_hz;
  return {-damping_ratio * omega, omega * std::sqrt(1.0 - damping_ratio * damping_ratio)};
}

ModalFit modal_fit(const MeasuredLines& measured, const Eigen::VectorXcd& start, const ModalFitOptions& options) {
  require_start(measured, start, options);
  ModalFitOptions free = options;
  free.residues = Residues::free;
  Unknowns u;
  u.ln_omega = start.cwiseAbs().array().log();
  u.ln_zeta = (-start.real().array() / start.cwiseAbs().array()).log();
  Problem problem = problem_of(measured, free);
  Found found = search(problem, u, options);
  const std::vector<Eigen::MatrixXcd> free_residues = residues_of(problem, found);
  if (options.residues != Residues::free) {
    start_vectors(free_residues, options.residues, found.unknowns);
    problem = problem_of(measured, options);
    found = search(problem, found.unknowns, options);
  }
  const std::vector<Eigen::MatrixXcd> residues = residues_of(problem, found);
  const Eigen::Index m = start.size();
  std::vector<std::size_t> order(residues.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return found.unknowns.ln_omega(static_cast<Eigen::Index>(a)) <
           found.unknowns.ln_omega(static_cast<Eigen::Index>(b));
  });
  const Eigen::MatrixXd covariance = Eigen::LDLT<Eigen::MatrixXd>(found.at.JtJ)
                                         .solve(Eigen::MatrixXd::Identity(found.at.JtJ.rows(), found.at.JtJ.cols()));
  ModalFit fit;
  fit.converged = found.converged;
  fit.covariance.resize(2 * m, 2 * m);
  Eigen::Index linear = 0;
  for (const Eigen::VectorXd& c : found.at.linear) linear += c.size();
  const double numbers = 2.0 * static_cast<double>(measured.lines() * measured.responses() * measured.references());
  fit.chi2 = found.at.cost;
  fit.degrees_of_freedom = numbers - static_cast<double>(linear + found.unknowns.count());
  for (Eigen::Index i = 0; i < m; ++i) {
    const std::size_t r = order[static_cast<std::size_t>(i)];
    const auto at = static_cast<Eigen::Index>(r);
    FittedMode mode;
    mode.frequency_hz = std::exp(found.unknowns.ln_omega(at)) / (2.0 * std::numbers::pi);
    mode.damping_ratio = std::exp(found.unknowns.ln_zeta(at));
    mode.sd_ln_frequency = std::sqrt(covariance(at, at));
    mode.sd_ln_damping = std::sqrt(covariance(m + at, m + at));
    mode.residue = residues[r];
    mode.second_singular = second_singular(free_residues[r]);
    if (options.residues != Residues::free) {
      const Eigen::Index fixed = found.unknowns.fixed[r];
      mode.left = found.unknowns.L.col(at);
      mode.right = mode.residue.col(fixed);
    }
    fit.modes.push_back(std::move(mode));
    for (Eigen::Index k = 0; k < m; ++k) {
      const auto other = static_cast<Eigen::Index>(order[static_cast<std::size_t>(k)]);
      fit.covariance(i, k) = covariance(at, other);
      fit.covariance(i, m + k) = covariance(at, m + other);
      fit.covariance(m + i, k) = covariance(m + at, other);
      fit.covariance(m + i, m + k) = covariance(m + at, m + other);
    }
  }
  take_terms(problem, found, fit);
  return fit;
}

Eigen::VectorXcd poles_of(const ModalFit& fit) {
  Eigen::VectorXcd poles(static_cast<Eigen::Index>(fit.modes.size()));
  for (std::size_t i = 0; i < fit.modes.size(); ++i) poles(static_cast<Eigen::Index>(i)) = fit.modes[i].pole();
  return poles;
}

Eigen::MatrixXcd value(const ModalFit& fit, double hz) {
  const Complex s(0.0, 2.0 * std::numbers::pi * hz);
  Eigen::MatrixXcd H = Eigen::MatrixXcd::Zero(fit.modes.front().residue.rows(), fit.modes.front().residue.cols());
  for (const FittedMode& mode : fit.modes)
    H += mode.residue / (s - mode.pole()) + mode.residue.conjugate() / (s - std::conj(mode.pole()));
  if (fit.inertia.size() > 0) H += fit.inertia.cast<Complex>() / (s * s);
  Complex power = 1.0;
  for (const Eigen::MatrixXd& c : fit.powers) {
    H += power * c.cast<Complex>();
    power *= s;
  }
  return H;
}

}  // namespace thinwall::identification
