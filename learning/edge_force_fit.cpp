#include "learning/edge_force_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "core/gauss_rule.hpp"

namespace thinwall::learning {

namespace {

using Eigen::Index;
using std::numbers::pi;

constexpr Index coefficients = 6;

/// The surface that the tooth some places ahead left: the chip above it is advance sin φ + offset.
struct Surface {
  double advance_m = 0.0, offset_m = 0.0;
  int left_by = 0;

  [[nodiscard]] double chip_m(double phi) const { return advance_m * std::sin(phi) + offset_m; }
};

std::vector<Surface> surfaces_before(const milling::Cutter& cutter, const std::vector<double>& runout, double feed,
                                     int tooth) {
  const int z = cutter.teeth;
  std::vector<Surface> surfaces;
  double turned = 0.0;
  for (int k = 1; k <= z; ++k) {
    turned += cutter.pitch_rad((tooth - k + 1 + z) % z);
    const int ahead = (tooth - k + z) % z;
    surfaces.push_back({z * feed * turned / (2.0 * pi),
                        runout[static_cast<std::size_t>(tooth)] - runout[static_cast<std::size_t>(ahead)], ahead});
  }
  return surfaces;
}

/// The surface that the tooth meets, which leaves it the thinnest chip.
const Surface& met_at(const std::vector<Surface>& surfaces, double phi) {
  return *std::ranges::min_element(surfaces, {}, [phi](const Surface& surface) { return surface.chip_m(phi); });
}

/// F = A (K_t, K_r, K_a, K_te, K_re, K_ae), and its derivative by the runout of each tooth.
struct EdgeForce {
  Eigen::Matrix<double, 3, 6> A = Eigen::Matrix<double, 3, 6>::Zero();
  Eigen::Matrix3Xd by_runout;
};

/// A tool at work.
struct Edges {
  const milling::Cutter& cutter;
  std::vector<double> runout;
  core::GaussRule rule = core::gauss_legendre(8);

  [[nodiscard]] EdgeForce at(const ForceRecord& cut, double angle, const milling::CuttingCoefficients& k) const {
    EdgeForce force;
    force.by_runout = Eigen::Matrix3Xd::Zero(3, cutter.teeth);
    double behind = 0.0;
    for (int tooth = 0; tooth < cutter.teeth; ++tooth) {
      if (tooth > 0) behind += cutter.pitch_rad(tooth);
      add_tooth(cut, tooth, angle - behind, k, force);
    }
    return force;
  }

 private:
  /// A height at which the chip above a surface is 0.
  struct Ending {
    double height_m = 0.0;
    const Surface* surface = nullptr;
  };

  /// The heights at which the edge is in the cut follow from φ_tip − lag z in (entry, exit) + 2π n.
  void add_tooth(const ForceRecord& cut, int tooth, double tip, const milling::CuttingCoefficients& k,
                 EdgeForce& force) const {
    const std::vector<Surface> surfaces = surfaces_before(cutter, runout, cut.feed_per_tooth_m, tooth);
    const double lag = cutter.lag_rad_per_m(tooth), last = tip - lag * cut.depth_m;
    const auto [entry, exit] = cut.engagement;
    for (double turn = 2.0 * pi * std::ceil((last - exit) / (2.0 * pi)); turn + entry < tip; turn += 2.0 * pi) {
      const double from = lag > 0.0 ? std::max(0.0, (tip - exit - turn) / lag) : 0.0;
      const double to = lag > 0.0 ? std::min(cut.depth_m, (tip - entry - turn) / lag) : cut.depth_m;
      if (to <= from) continue;
      const std::vector<Ending> endings = endings_between(surfaces, tip, lag, from, to);
      double begin = from;
      for (const Ending& ending : endings) {
        add_piece(tooth, tip - lag * begin, begin, ending.height_m, surfaces, k, force);
        add_ending(tooth, tip - lag * ending.height_m, ending, lag, surfaces, k, force);
        begin = ending.height_m;
      }
      add_piece(tooth, tip - lag * begin, begin, to, surfaces, k, force);
    }
  }

  /// The heights in (from, to) at which the chip above some surface begins or ends, ascending.
  static std::vector<Ending> endings_between(const std::vector<Surface>& surfaces, double tip, double lag, double from,
                                             double to) {
    std::vector<Ending> endings;
    if (!(lag > 0.0)) return endings;
    for (const Surface& surface : surfaces) {
      const double sine = -surface.offset_m / surface.advance_m;
      if (!(std::abs(sine) < 1.0)) continue;
      for (const double zero : {std::asin(sine), pi - std::asin(sine)}) {
        const double last = tip - lag * to;
        const double phi = zero + 2.0 * pi * std::ceil((last - zero) / (2.0 * pi)), height = (tip - phi) / lag;
        if (height > from && height < to) endings.push_back({height, &surface});
      }
    }
    std::ranges::sort(endings, {}, &Ending::height_m);
    return endings;
  }

  /// Gauss's rule over heights without an ending between them; the angle is that at `from`.
  void add_piece(int tooth, double phi_from, double from, double to, const std::vector<Surface>& surfaces,
                 const milling::CuttingCoefficients& k, EdgeForce& force) const {
    const double lag = cutter.lag_rad_per_m(tooth);
    for (Index i = 0; i < rule.node.size(); ++i) {
      const double along = (to - from) * rule.node(i), width = (to - from) * rule.weight(i);
      const double edge = milling::edge_length_per_height(cutter, tooth, from + along) * width;
      add_point(tooth, phi_from - lag * along, width, edge, surfaces, k, force);
    }
  }

  void add_point(int tooth, double phi, double width, double edge, const std::vector<Surface>& surfaces,
                 const milling::CuttingCoefficients& k, EdgeForce& force) const {
    const Surface& met = met_at(surfaces, phi);
    const double thickness = met.chip_m(phi);
    if (!(thickness > 0.0)) return;
    const Eigen::Matrix3d axes = axes_at(phi);
    force.A.leftCols<3>() += width * thickness * axes;
    force.A.rightCols<3>() += edge * axes;
    const Eigen::Vector3d by_chip = width * axes * Eigen::Vector3d(k.K_t, k.K_r, k.K_a);
    force.by_runout.col(tooth) += by_chip;
    force.by_runout.col(met.left_by) -= by_chip;
  }

  /// The edge that a thicker chip brings into the cut where it ends: dz = dh/(lag |dh/dφ|).
  void add_ending(int tooth, double phi, const Ending& ending, double lag, const std::vector<Surface>& surfaces,
                  const milling::CuttingCoefficients& k, EdgeForce& force) const {
    constexpr double flattest = 1e-3;  // a chip that only touches 0 has no derivative there
    const double slope = ending.surface->advance_m * std::abs(std::cos(phi));
    if (&met_at(surfaces, phi) != ending.surface || slope < flattest * ending.surface->advance_m) return;
    const double edge = milling::edge_length_per_height(cutter, tooth, ending.height_m);
    const Eigen::Vector3d by_chip = edge / (lag * slope) * axes_at(phi) * Eigen::Vector3d(k.K_te, k.K_re, k.K_ae);
    force.by_runout.col(tooth) += by_chip;
    force.by_runout.col(ending.surface->left_by) -= by_chip;
  }

  /// −t, −r and the tool's axis as columns.
  static Eigen::Matrix3d axes_at(double phi) {
    const Eigen::Vector3d r(std::sin(phi), std::cos(phi), 0.0), t(std::cos(phi), -std::sin(phi), 0.0);
    Eigen::Matrix3d axes;
    axes << -t, -r, Eigen::Vector3d::UnitZ();
    return axes;
  }
};

milling::CuttingCoefficients coefficients_in(const Eigen::VectorXd& x) {
  return {x(0), x(1), x(2), x(3), x(4), x(5)};
}

/// The runout of every tooth: the last takes what the sum of the others leaves.
std::vector<double> runout_in(const Eigen::VectorXd& x, int teeth) {
  std::vector<double> runout(static_cast<std::size_t>(teeth), 0.0);
  for (std::size_t j = 0; j + 1 < runout.size(); ++j) {
    runout[j] = x(coefficients + static_cast<Index>(j));
    runout.back() -= runout[j];
  }
  return runout;
}

/// The forces of all records one below the other at x, and their derivative.
struct Modelled {
  Eigen::VectorXd force;
  Eigen::MatrixXd by_x;
};

Modelled modelled(const milling::Cutter& cutter, const std::vector<ForceRecord>& records, const Eigen::VectorXd& x) {
  Index rows = 0;
  for (const ForceRecord& record : records) rows += 3 * record.angle_rad.size();
  Modelled result{Eigen::VectorXd(rows), Eigen::MatrixXd(rows, x.size())};
  const Edges edges{cutter, runout_in(x, cutter.teeth)};
  const milling::CuttingCoefficients k = coefficients_in(x);
  Index row = 0;
  for (const ForceRecord& record : records) {
    for (const double angle : record.angle_rad) {
      const EdgeForce at = edges.at(record, angle, k);
      result.force.segment<3>(row) = at.A * x.head<coefficients>();
      result.by_x.block<3, coefficients>(row, 0) = at.A;
      for (Index j = 0; j + coefficients < x.size(); ++j)
        result.by_x.block<3, 1>(row, coefficients + j) = at.by_runout.col(j) - at.by_runout.col(cutter.teeth - 1);
      row += 3;
    }
  }
  return result;
}

Eigen::VectorXd measured(const std::vector<ForceRecord>& records) {
  Index rows = 0;
  for (const ForceRecord& record : records) rows += record.force_n.size();
  Eigen::VectorXd all(rows);
  Index row = 0;
  for (const ForceRecord& record : records) {
    all.segment(row, record.force_n.size()) = record.force_n.reshaped();
    row += record.force_n.size();
  }
  return all;
}

void require_usable(const milling::Cutter& cutter, const std::vector<ForceRecord>& records) {
  if (const auto faults = milling::validate(cutter); !faults.empty())
    throw core::InputError("edge forces: " + faults.front());
  if (!is_cylinder(cutter))
    throw core::InputError("edge forces: the tool has another end than a cylinder; give forces of one with a flat end");
  if (records.empty()) throw core::InputError("edge forces: there is no record; give one at least");
  for (std::size_t i = 0; i < records.size(); ++i) {
    const ForceRecord& record = records[i];
    const bool well = record.depth_m > 0.0 && record.feed_per_tooth_m > 0.0 && record.angle_rad.size() > 0 &&
                      record.angle_rad.size() == record.force_n.cols() && record.angle_rad.allFinite() &&
                      record.force_n.allFinite() && milling::validate(record.engagement).empty();
    if (!well) {
      throw core::InputError("edge forces: record " + std::to_string(i + 1) +
                             " needs a depth and a feed above 0, an engagement and finite forces, one for each angle; "
                             "correct it");
    }
  }
}

void require_told_apart(const LinearFit& fit) {
  if (fit.condition < largest_condition) return;
  std::ostringstream text;
  text << "edge forces: the records do not tell the coefficients and the runout apart (condition " << fit.condition
       << ", must be below " << largest_condition
       << "); add a cut at twice the feed per tooth, or one over a whole turn";
  throw core::InputError(text.str());
}

/// The largest change of an unknown over the largest of its kind.
double relative_change(const Eigen::VectorXd& step, const Eigen::VectorXd& x, double feed) {
  const double chip = step.head(3).norm() / x.head(3).norm();
  const double edge = step.segment(3, 3).norm() / (feed * x.head(3).norm());
  const double runout = step.size() > coefficients ? step.tail(step.size() - coefficients).norm() / feed : 0.0;
  return std::max({chip, edge, runout});
}

bool is_same_cut(const MeanForceTest& a, const MeanForceTest& b) {
  return a.depth_m == b.depth_m && a.feed_per_tooth_m == b.feed_per_tooth_m &&
         a.engagement.entry_rad == b.engagement.entry_rad && a.engagement.exit_rad == b.engagement.exit_rad;
}

/// The gain in squares that a step predicts, over the variance of the residual: the square of its length in deviations.
double predicted_gain(const LinearFit& fit, double before) {
  const auto freedom = static_cast<double>(fit.degrees_of_freedom);
  if (!(freedom > 0.0)) return std::numeric_limits<double>::infinity();
  return (before - fit.residual_square) * freedom / fit.residual_square;
}

/// The search on its way.
struct Search {
  Eigen::VectorXd x;
  Modelled at;
  int steps = 0;
  bool converged = false;
};

/// The measured forces, and the cuts and the tool that made them.
struct Fitted {
  const milling::Cutter& cutter;
  const std::vector<ForceRecord>& records;
  const Eigen::VectorXd& force;

  [[nodiscard]] double square(const Modelled& at) const { return (force - at.force).squaredNorm(); }
};

/// The step, halved until it gains; false if it never does.
bool advance(Search& s, const Fitted& fitted, Eigen::VectorXd step) {
  constexpr int most_halvings = 20;
  const double before = fitted.square(s.at);
  for (int i = 0; i < most_halvings; ++i, step *= 0.5) {
    Modelled there = modelled(fitted.cutter, fitted.records, s.x + step);
    if (!(fitted.square(there) < before)) continue;
    s.x += step;
    s.at = std::move(there);
    return true;
  }
  return false;
}

/// Ends where a step changes nothing: by round-off, or by a thousandth of the variance of the residual. The force of an
/// edge without helix jumps with the runout, so that a step may gain nothing though it predicts some: then it is enough
/// if it predicts less than noise moves the solution from the truth, the variance for each unknown.
Search search(const Fitted& fitted) {
  constexpr int most_steps = 50;
  constexpr double exact = 1e-9, hidden = 1e-3;
  Search s{Eigen::VectorXd::Zero(coefficients + fitted.cutter.teeth - 1), {}};
  s.at = modelled(fitted.cutter, fitted.records, s.x);
  const LinearFit linear = linear_fit(s.at.by_x.leftCols(coefficients), fitted.force);
  require_told_apart(linear);
  s.x.head(coefficients) = linear.x;
  s.at = modelled(fitted.cutter, fitted.records, s.x);
  for (bool gains = true; gains && !s.converged && s.steps < most_steps; ++s.steps) {
    const LinearFit fit = linear_fit(s.at.by_x, fitted.force - s.at.force);
    require_told_apart(fit);
    const double predicted = predicted_gain(fit, fitted.square(s.at));
    const double change = relative_change(fit.x, s.x, fitted.records.front().feed_per_tooth_m);
    s.converged = change < exact || predicted < hidden;
    gains = advance(s, fitted, fit.x);
    if (!gains) s.converged = s.converged || predicted < static_cast<double>(s.x.size());
  }
  return s;
}

/// The runout that is left for the last tooth, minus the sum of the others: its variance is the sum of their
/// covariances.
FittedCoefficient last_of(const LinearFit& fit, double runout) {
  const Index others = fit.x.size() - coefficients;
  if (others == 0) return {runout};
  if (fit.degrees_of_freedom == 0) return {runout, interval_factor(fit), interval_factor(fit)};
  const double deviation = std::sqrt(fit.covariance.bottomRightCorner(others, others).sum());
  return {runout, deviation, deviation * interval_factor(fit)};
}

}  // namespace

bool is_cylinder(const milling::Cutter& cutter) {
  return cutter.envelope.straight() && cutter.envelope.taper_rad == 0.0;
}

std::vector<ForceRecord> records_of(const std::vector<MeanForceTest>& lines, const Eigen::VectorXd& angles_rad) {
  if (std::ssize(lines) != angles_rad.size()) {
    throw core::InputError("edge forces: " + std::to_string(angles_rad.size()) + " angles for " +
                           std::to_string(lines.size()) + " lines; give one for each");
  }
  std::vector<ForceRecord> records;
  for (std::size_t from = 0, to = 0; from < lines.size(); from = to) {
    while (to < lines.size() && is_same_cut(lines[from], lines[to])) ++to;
    const auto first = static_cast<Index>(from), count = static_cast<Index>(to - from);
    ForceRecord record{lines[from].engagement, lines[from].depth_m, lines[from].feed_per_tooth_m,
                       angles_rad.segment(first, count), Eigen::Matrix3Xd(3, count)};
    for (std::size_t i = from; i < to; ++i) record.force_n.col(static_cast<Index>(i - from)) = lines[i].force_n;
    records.push_back(std::move(record));
  }
  return records;
}

Eigen::Vector3d edge_force_n(const milling::Cutter& cutter, const milling::CuttingCoefficients& k,
                             const ForceRecord& cut, double angle_rad) {
  std::vector<double> runout = cutter.runout_m;
  runout.resize(static_cast<std::size_t>(cutter.teeth), 0.0);
  Eigen::Vector<double, 6> x;
  x << k.K_t, k.K_r, k.K_a, k.K_te, k.K_re, k.K_ae;
  return Edges{cutter, runout}.at(cut, angle_rad, k).A * x;
}

EdgeForceFit fit_edge_forces(const milling::Cutter& cutter, const std::vector<ForceRecord>& records) {
  require_usable(cutter, records);
  const Eigen::VectorXd force = measured(records);
  const Search found = search({cutter, records, force});
  LinearFit about = linear_fit(found.at.by_x, force - found.at.force);
  require_told_apart(about);
  about.x = found.x;
  const auto runout = runout_in(found.x, cutter.teeth);
  EdgeForceFit fit{coefficient_of(about, 0), coefficient_of(about, 1), coefficient_of(about, 2),
                   coefficient_of(about, 3), coefficient_of(about, 4), coefficient_of(about, 5)};
  for (Index j = 0; j + 1 < cutter.teeth; ++j) fit.runout_m.push_back(coefficient_of(about, coefficients + j));
  fit.runout_m.push_back(last_of(about, runout.back()));
  const double residual = (force - found.at.force).squaredNorm();
  const Eigen::Map<const Eigen::Matrix3Xd> forces(force.data(), 3, force.size() / 3);
  const double scatter = (forces.colwise() - forces.rowwise().mean()).squaredNorm();
  fit.r_squared = scatter > 0.0 ? 1.0 - residual / scatter : 1.0;
  fit.residual_n = std::sqrt(residual / static_cast<double>(force.size()));
  fit.condition = about.condition;
  fit.degrees_of_freedom = about.degrees_of_freedom;
  fit.steps = found.steps;
  fit.converged = found.converged;
  return fit;
}

}  // namespace thinwall::learning
