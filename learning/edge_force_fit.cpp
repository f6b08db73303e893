#include "learning/edge_force_fit.hpp"

#include <algorithm>
#include <cmath>
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

/// The chip that a tooth cuts, and the number of the tooth whose surface it meets.
struct Chip {
  double thickness_m = 0.0;
  int surface_of = 0;
};

Chip chip_of(const milling::Cutter& cutter, const std::vector<double>& runout, double feed, int tooth, double phi) {
  const int z = cutter.teeth;
  Chip chip;
  double turned = 0.0;
  for (int k = 1; k <= z; ++k) {
    turned += cutter.pitch_rad((tooth - k + 1 + z) % z);
    const int ahead = (tooth - k + z) % z;
    const double h = z * feed * turned / (2.0 * pi) * std::sin(phi) + runout[static_cast<std::size_t>(tooth)] -
                     runout[static_cast<std::size_t>(ahead)];
    if (k == 1 || h < chip.thickness_m) chip = {h, ahead};
  }
  return chip;
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
  /// The heights at which the edge is in the cut follow from φ_tip − lag z in (entry, exit) + 2π n.
  void add_tooth(const ForceRecord& cut, int tooth, double tip, const milling::CuttingCoefficients& k,
                 EdgeForce& force) const {
    const double lag = cutter.lag_rad_per_m(tooth), last = tip - lag * cut.depth_m;
    const auto [entry, exit] = cut.engagement;
    for (double turn = 2.0 * pi * std::ceil((last - exit) / (2.0 * pi)); turn + entry < tip; turn += 2.0 * pi) {
      const double from = lag > 0.0 ? std::max(0.0, (tip - exit - turn) / lag) : 0.0;
      const double to = lag > 0.0 ? std::min(cut.depth_m, (tip - entry - turn) / lag) : cut.depth_m;
      if (to <= from) continue;
      for (Index i = 0; i < rule.node.size(); ++i) {
        const double height = from + (to - from) * rule.node(i), width = (to - from) * rule.weight(i);
        const double edge = milling::edge_length_per_height(cutter, tooth, height) * width;
        add_point(cut, tooth, tip - lag * height, width, edge, k, force);
      }
    }
  }

  void add_point(const ForceRecord& cut, int tooth, double phi, double width, double edge,
                 const milling::CuttingCoefficients& k, EdgeForce& force) const {
    const Chip chip = chip_of(cutter, runout, cut.feed_per_tooth_m, tooth, phi);
    if (!(chip.thickness_m > 0.0)) return;
    const Eigen::Vector3d r(std::sin(phi), std::cos(phi), 0.0), t(std::cos(phi), -std::sin(phi), 0.0);
    Eigen::Matrix3d axes;
    axes << -t, -r, Eigen::Vector3d::UnitZ();
    force.A.leftCols<3>() += width * chip.thickness_m * axes;
    force.A.rightCols<3>() += edge * axes;
    const Eigen::Vector3d by_chip = width * axes * Eigen::Vector3d(k.K_t, k.K_r, k.K_a);
    force.by_runout.col(tooth) += by_chip;
    force.by_runout.col(chip.surface_of) -= by_chip;
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
  if (!cutter.envelope.straight()) throw core::InputError("edge forces: the tool must be a cylinder; use mean forces");
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

/// The search on its way.
struct Search {
  Eigen::VectorXd x;
  Modelled at;
  int steps = 0;
  bool converged = false;
};

Search search(const milling::Cutter& cutter, const std::vector<ForceRecord>& records, const Eigen::VectorXd& force) {
  constexpr int most_steps = 50, most_halvings = 20;
  constexpr double enough = 1e-9;
  Search s{Eigen::VectorXd::Zero(coefficients + cutter.teeth - 1), {}};
  s.at = modelled(cutter, records, s.x);
  const LinearFit linear = linear_fit(s.at.by_x.leftCols(coefficients), force);
  require_told_apart(linear);
  s.x.head(coefficients) = linear.x;
  s.at = modelled(cutter, records, s.x);
  for (bool gains = true; gains && !s.converged && s.steps < most_steps; ++s.steps) {
    const LinearFit fit = linear_fit(s.at.by_x, force - s.at.force);
    require_told_apart(fit);
    Eigen::VectorXd step = fit.x;
    s.converged = relative_change(step, s.x, records.front().feed_per_tooth_m) < enough;
    const double before = (force - s.at.force).squaredNorm();
    gains = false;
    for (int i = 0; i < most_halvings && !gains; ++i, step *= 0.5) {
      Modelled there = modelled(cutter, records, s.x + step);
      gains = s.converged || (force - there.force).squaredNorm() < before;
      if (!gains) continue;
      s.x += step;
      s.at = std::move(there);
    }
  }
  return s;
}

}  // namespace

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
  const Search found = search(cutter, records, force);
  LinearFit about = linear_fit(found.at.by_x, force - found.at.force);
  require_told_apart(about);
  about.x = found.x;
  const auto runout = runout_in(found.x, cutter.teeth);
  EdgeForceFit fit{coefficient_of(about, 0), coefficient_of(about, 1), coefficient_of(about, 2),
                   coefficient_of(about, 3), coefficient_of(about, 4), coefficient_of(about, 5)};
  for (Index j = 0; j + 1 < cutter.teeth; ++j) fit.runout_m.push_back(coefficient_of(about, coefficients + j));
  fit.runout_m.push_back({runout.back()});
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
