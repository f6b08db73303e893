#include "dynamics/frf_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/median.hpp"

namespace thinwall::dynamics {

namespace {

using Complex = std::complex<double>;

void require_measured(const ResponseModel& model) {
  const auto rows = static_cast<Eigen::Index>(model.responses.size());
  const auto columns = static_cast<Eigen::Index>(model.forces.size());
  bool consistent = model.axis.size() == static_cast<Eigen::Index>(model.H.size());
  for (const auto& H : model.H) consistent = consistent && H.rows() == rows && H.cols() == columns;
  if (!consistent) throw core::InputError("the response's matrices do not match its frequencies and DOF tables");
  for (const auto& H : model.H) {
    if (!H.allFinite()) throw core::InputError("the response holds values that are not finite; leave those lines out");
  }
}

/// The first line at or above from_hz and above 0 Hz.
Eigen::Index first_line(const FrequencyAxis& axis, double from_hz) {
  Eigen::Index line = 0;
  while (line < axis.size() && (axis.hz(line) < from_hz || axis.hz(line) <= 0.0)) ++line;
  return line;
}

/// The FRF matrix between the driving points at one line, with forces turned into the responses' directions.
Eigen::MatrixXcd block(const ResponseModel& model, const std::vector<Collocated>& points, Eigen::Index line) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXcd B(n, n);
  for (Eigen::Index a = 0; a < n; ++a) {
    for (Eigen::Index b = 0; b < n; ++b) {
      const auto& force = points[static_cast<std::size_t>(b)];
      B(a, b) =
          force.sign * model.H[static_cast<std::size_t>(line)](points[static_cast<std::size_t>(a)].row, force.column);
    }
  }
  return B;
}

/// The largest value that a line and both its neighbours reach, and that line; with fewer than three lines, the largest
/// value. A single line of noise does not count.
struct Run {
  double value = 0.0;
  Eigen::Index line = 0;
};

Run largest_of_three(const Eigen::VectorXd& values) {
  Run run;
  if (values.size() < 3) {
    if (values.size() > 0) run.value = values.maxCoeff(&run.line);
    return run;
  }
  for (Eigen::Index k = 1; k + 1 < values.size(); ++k) {
    const double reached = values.segment(k - 1, 3).minCoeff();
    if (reached > run.value) run = {reached, k};
  }
  return run;
}

/// The change of Re H through the resonance around `line`: over the neighbouring lines on which |Im H| is at least half
/// its value there, and over one neighbour on each side at least. Only its sign is used.
double change_of_real_part(const Eigen::VectorXcd& H, Eigen::Index line) {
  const double half = 0.5 * std::abs(H(line).imag());
  Eigen::Index below = line;
  Eigen::Index above = line;
  while (below > 0 && (below == line || std::abs(H(below - 1).imag()) >= half)) --below;
  while (above + 1 < H.size() && (above == line || std::abs(H(above + 1).imag()) >= half)) ++above;
  return H(above).real() - H(below).real();
}

DrivingPointSign sign_of(const ResponseModel& model, const Collocated& point, Eigen::Index first) {
  const Eigen::Index lines = model.axis.size() - first;
  DrivingPointSign sign{point};
  Eigen::VectorXcd H(lines);
  Eigen::VectorXd power(lines);
  for (Eigen::Index k = 0; k < lines; ++k) {
    H(k) = point.sign * model.H[static_cast<std::size_t>(first + k)](point.row, point.column);
    power(k) = model.axis.omega_rad_s(first + k) * H(k).imag();
  }
  const double sum = power.cwiseAbs().sum();
  if (lines == 0 || !(sum > 0.0)) return sign;
  Eigen::Index peak = 0;
  power.cwiseAbs().maxCoeff(&peak);
  sign.balance = power.sum() / sum;
  sign.frequency_hz = model.axis.hz(first + peak);
  sign.share = H(peak).imag() / std::abs(H(peak));
  if (sign.balance < -0.5) {
    sign.verdict = SignVerdict::passive;
  } else if (sign.balance > 0.5) {
    sign.verdict = change_of_real_part(H, peak) > 0.0 ? SignVerdict::turned : SignVerdict::conjugated;
  }
  return sign;
}

/// The largest eigenvalue of A = (B − Bᴴ)/(2i) and the index of the largest entry of its vector.
struct LargestEigenvalue {
  double value = 0.0;
  Eigen::Index largest_part = 0;
};

LargestEigenvalue largest_eigenvalue(const Eigen::MatrixXcd& B) {
  const Eigen::MatrixXcd A = (B - B.adjoint()) / Complex(0.0, 2.0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(A);
  LargestEigenvalue largest{solver.eigenvalues()(A.rows() - 1), 0};
  solver.eigenvectors().col(A.rows() - 1).cwiseAbs().maxCoeff(&largest.largest_part);
  return largest;
}

// ---- Low frequencies ----

constexpr Eigen::Index half_window = 10;
constexpr Eigen::Index least_lines = 25;

/// The median of value(i) over the lines i within half_window of line k.
template <typename Value>
double window_median(Eigen::Index lines, Eigen::Index k, Value value) {
  std::vector<double> values;
  for (Eigen::Index i = std::max<Eigen::Index>(0, k - half_window); i <= std::min(lines - 1, k + half_window); ++i) {
    values.push_back(value(i));
  }
  return core::median(std::move(values));
}

/// An estimate of each line's noise: its distance from the straight line through its neighbours, divided by the factor
/// √(1 + w² + (1 − w)²) by which independent noise of three lines adds up in that distance. It is a Rayleigh variable
/// with median 0.833 σ. The first and last lines have no such distance of their own and take their neighbour's.
Eigen::VectorXd line_scatter(const Eigen::VectorXd& hz, const Eigen::VectorXcd& H) {
  const Eigen::Index lines = H.size();
  Eigen::VectorXd scatter(lines);
  for (Eigen::Index k = 1; k + 1 < lines; ++k) {
    const double w = (hz(k + 1) - hz(k)) / (hz(k + 1) - hz(k - 1));
    const Complex distance = H(k) - w * H(k - 1) - (1.0 - w) * H(k + 1);
    scatter(k) = std::abs(distance) / std::sqrt(1.0 + w * w + (1.0 - w) * (1.0 - w));
  }
  scatter(0) = scatter(1);
  scatter(lines - 1) = scatter(lines - 2);
  return scatter;
}

/// The frequency of the first line k for which holds(k) is true; infinity if there is none.
template <typename Holds>
double first_that_holds(const Eigen::VectorXd& hz, Holds holds) {
  for (Eigen::Index k = 0; k < hz.size(); ++k) {
    if (holds(k)) return hz(k);
  }
  return std::numeric_limits<double>::infinity();
}

/// The slope of ln |H| over ln f from line k on, least squares over an octave (five lines at least), and the geometric
/// mean of its first and last frequency.
struct Slope {
  double slope = 0.0;
  double middle_hz = 0.0;
};

Slope slope_from(const Eigen::VectorXd& hz, const Eigen::VectorXcd& H, Eigen::Index k) {
  Eigen::Index last = std::min(k + 4, hz.size() - 1);
  while (last + 1 < hz.size() && hz(last + 1) <= 2.0 * hz(k)) ++last;
  const Eigen::Index lines = last - k + 1;
  const Eigen::ArrayXd x = hz.segment(k, lines).array().log();
  const Eigen::ArrayXd y = H.segment(k, lines).cwiseAbs().array().max(std::numeric_limits<double>::min()).log();
  const Eigen::ArrayXd dx = x - x.mean();
  return {(dx * (y - y.mean())).sum() / dx.square().sum(), std::sqrt(hz(k) * hz(last))};
}

/// The frequency from which on the slope is above −1 for the first time, which is the first line if it is above there
/// already; infinity if it never is.
double growth_limit(const Eigen::VectorXd& hz, const Eigen::VectorXcd& H) {
  for (Eigen::Index k = 0; k + 4 < hz.size(); ++k) {
    const Slope slope = slope_from(hz, H, k);
    if (slope.slope > -1.0) return k == 0 ? hz(0) : slope.middle_hz;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<Collocated> driving_points(const ResponseModel& model) {
  std::vector<Collocated> points;
  for (std::size_t row = 0; row < model.responses.size(); ++row) {
    const Dof& response = model.responses[row];
    for (std::size_t column = 0; column < model.forces.size(); ++column) {
      const Dof& force = model.forces[column];
      if (force.point != response.point || force.kind != response.kind) continue;
      const double cosine = force.direction.dot(response.direction);
      if (std::abs(std::abs(cosine) - 1.0) > 1e-9) continue;
      points.push_back({static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column), cosine > 0.0 ? 1.0 : -1.0});
      break;
    }
  }
  return points;
}

std::vector<DrivingPointSign> driving_point_signs(const ResponseModel& model, double from_hz) {
  require_measured(model);
  std::vector<DrivingPointSign> signs;
  for (const Collocated& point : driving_points(model)) {
    signs.push_back(sign_of(model, point, first_line(model.axis, from_hz)));
  }
  return signs;
}

std::optional<MatrixCheck> reciprocity(const ResponseModel& model, double from_hz, double bound) {
  require_measured(model);
  const std::vector<Collocated> points = driving_points(model);
  if (points.size() < 2) return std::nullopt;
  const Eigen::Index first = first_line(model.axis, from_hz);
  const Eigen::Index lines = model.axis.size() - first;
  MatrixCheck check;
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = a + 1; b < points.size(); ++b) {
      Eigen::VectorXd difference(lines);
      double largest = 0.0;
      for (Eigen::Index k = 0; k < lines; ++k) {
        const Eigen::MatrixXcd& H = model.H[static_cast<std::size_t>(first + k)];
        const Complex H_ab = points[b].sign * H(points[a].row, points[b].column);
        const Complex H_ba = points[a].sign * H(points[b].row, points[a].column);
        difference(k) = std::abs(H_ab - H_ba);
        largest = std::max({largest, std::abs(H_ab), std::abs(H_ba)});
      }
      if (!(largest > 0.0)) continue;
      const Run run = largest_of_three(difference / largest);
      if (run.value <= check.figure) continue;
      check = {run.value, model.axis.hz(first + run.line), points[a].row, points[b].column, run.value <= bound};
    }
  }
  return check;
}

std::optional<MatrixCheck> passivity(const ResponseModel& model, double from_hz, double bound) {
  require_measured(model);
  const std::vector<Collocated> points = driving_points(model);
  if (points.empty()) return std::nullopt;
  const Eigen::Index first = first_line(model.axis, from_hz);
  const Eigen::Index lines = model.axis.size() - first;
  Eigen::VectorXd size = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(points.size()));
  for (Eigen::Index k = 0; k < lines; ++k) {
    size = size.cwiseMax(block(model, points, first + k).diagonal().cwiseAbs());
  }
  const Eigen::VectorXd scale = size.unaryExpr([](double s) { return s > 0.0 ? 1.0 / std::sqrt(s) : 0.0; });
  Eigen::VectorXd norm(lines);
  Eigen::VectorXd given(lines);
  std::vector<Eigen::Index> main_point(static_cast<std::size_t>(lines));
  for (Eigen::Index k = 0; k < lines; ++k) {
    const Eigen::MatrixXcd B = scale.asDiagonal() * block(model, points, first + k) * scale.asDiagonal();
    const LargestEigenvalue largest = largest_eigenvalue(B);
    norm(k) = Eigen::JacobiSVD<Eigen::MatrixXcd>(B).singularValues()(0);
    given(k) = largest.value;
    main_point[static_cast<std::size_t>(k)] = largest.largest_part;
  }
  const double quiet = lines > 0 ? 0.01 * norm.maxCoeff() : 0.0;
  for (Eigen::Index k = 0; k < lines; ++k) {
    given(k) = norm(k) > 0.0 && norm(k) >= quiet ? std::max(0.0, given(k) / norm(k)) : 0.0;
  }
  const Run run = largest_of_three(given);
  if (lines == 0) return MatrixCheck{};
  const Collocated& worst = points[static_cast<std::size_t>(main_point[static_cast<std::size_t>(run.line)])];
  return MatrixCheck{run.value, model.axis.hz(first + run.line), worst.row, worst.column, run.value <= bound};
}

LowFrequencyLimit low_frequency_limit(const FrequencyAxis& axis, const Eigen::VectorXcd& H,
                                      const Eigen::VectorXd& coherence, const LowFrequencyOptions& options) {
  const Eigen::Index first = first_line(axis, 0.0);
  const Eigen::Index lines = axis.size() - first;
  if (H.size() != axis.size() || (coherence.size() != 0 && coherence.size() != axis.size())) {
    throw core::InputError("a response of " + std::to_string(H.size()) + " values and a coherence of " +
                           std::to_string(coherence.size()) + " on " + std::to_string(axis.size()) + " frequencies");
  }
  if (lines < least_lines) {
    throw core::InputError("a response on " + std::to_string(lines) + " lines above 0 Hz; " +
                           std::to_string(least_lines) + " are needed to tell noise from structure");
  }
  if (!H.allFinite() || !coherence.allFinite()) {
    throw core::InputError("the response or its coherence holds values that are not finite; leave those lines out");
  }
  constexpr double rayleigh_median = 0.8325546111576977;  // √ln 2
  const Eigen::VectorXd hz = axis.hz.tail(lines);
  const Eigen::VectorXcd receptance = H.tail(lines);
  const Eigen::VectorXd scatter = line_scatter(hz, receptance);
  LowFrequencyLimit limit;
  limit.scatter_from_hz = first_that_holds(hz, [&](Eigen::Index k) {
    const double sigma = window_median(lines, k, [&](Eigen::Index i) { return scatter(i); }) / rayleigh_median;
    return sigma <= options.scatter * window_median(lines, k, [&](Eigen::Index i) { return std::abs(receptance(i)); });
  });
  limit.coherence_from_hz = coherence.size() == 0 ? hz(0) : first_that_holds(hz, [&](Eigen::Index k) {
    return window_median(lines, k, [&](Eigen::Index i) { return coherence(first + i); }) >= options.coherence;
  });
  limit.growth_from_hz = options.supported ? growth_limit(hz, receptance) : hz(0);
  limit.from_hz = std::max({limit.scatter_from_hz, limit.coherence_from_hz, limit.growth_from_hz});
  if (limit.from_hz > hz(0)) {
    limit.cause = limit.from_hz == limit.scatter_from_hz     ? LowFrequencyCause::scatter
                  : limit.from_hz == limit.coherence_from_hz ? LowFrequencyCause::coherence
                                                             : LowFrequencyCause::growth;
  }
  return limit;
}

}  // namespace thinwall::dynamics
