#include "milling/chart/sampled_stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "core/gauss_rule.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "milling/direct/chatter_frequency.hpp"
#include "milling/direct/cut_at_speed.hpp"
#include "milling/direct/row_search.hpp"
#include "milling/direct/stability.hpp"
#include "milling/direct/unstable_count.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

using std::numbers::pi;

/// The part of a cut that does not change with resolution and depth. It keeps references.
struct SampledCut {
  const SampledReceptance& receptance;
  std::optional<CutAtSpeed> by_poles;
  const MillingProcess& process;
  Eigen::Matrix3Xd yielding;
  double mean_stiffness = 0.0;  ///< ‖mean directional matrix‖ over a period, N/m²
  double resonance_hz = 0.0;    ///< the highest
  double spindle_speed_rpm = 0.0;
};

/// Samples and poles together.
Eigen::Matrix3cd receptance_at(const SampledCut& cut, double omega_rad_s) {
  Eigen::Matrix3cd H = interpolated(cut.receptance, omega_rad_s, {cut.resonance_hz, cut.resonance_hz});
  if (cut.by_poles) H += receptance(cut.by_poles->structure, omega_rad_s);
  return H;
}

/// Directions that take part in the motion by more than a ten-millionth, at the lines of the samples.
Eigen::Matrix3Xd yielding_directions(const SampledCut& cut) {
  Eigen::Matrix3d motion = Eigen::Matrix3d::Zero();
  for (const double hz : cut.receptance.frequency_hz) {
    const Eigen::Matrix3cd H = receptance_at(cut, 2.0 * pi * hz);
    motion += (H * H.adjoint()).real();
  }
  if (!(motion.topLeftCorner<2, 2>().norm() > 1e-14 * motion.norm())) {
    throw core::InputError(
        "receptance at the cut: nothing moves in the plane of the cut, something must; check the feed and the tool "
        "axis");
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(motion);
  const auto count = (eigen.eigenvalues().array() > 1e-14 * eigen.eigenvalues()(2)).count();
  return eigen.eigenvectors().rightCols(count);
}

/// 0 if there is none.
double highest_resonance_hz(const SampledReceptance& r) {
  Resonance highest;
  for (const Resonance& found : resonances(r)) {
    if (found.size > highest.size) highest = found;
  }
  return highest.frequency_hz;
}

/// Mean over the period of force · chipᵀ.
double mean_stiffness(const ContactGrid& grid) {
  Eigen::VectorXd weight(grid.node_rad.size());
  for (const CutElement& e : grid.elements)
    weight.segment(e.first_node, e.nodes) = core::gauss_legendre(e.nodes).weight * (e.to_rad - e.from_rad);
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  for (const EdgeContact& c : grid.contacts) mean += weight(c.node) / grid.period_rad * c.force * c.chip.transpose();
  return mean.norm();
}

void require_usable(const MillingProcess& process, const StabilityOptions& options, double spindle_speed_rpm) {
  milling::require_usable(process, options);
  (void)tooth_period_s(process.cutter, spindle_speed_rpm);  // refuses a bad speed
  if (!equal_teeth(process) || process.cutter.depends_on_depth() || process.damping.C != 0.0) {
    throw core::InputError(
        std::string("stability from a measured receptance: ") +
        (!equal_teeth(process)               ? "the teeth have unequal pitches, helices or chips"
         : process.cutter.has_helix()        ? "the teeth have a helix"
         : process.cutter.depends_on_depth() ? "the tool has a round end"
                                             : "there is process damping") +
        ", only equal straight teeth on a cylinder or cone without it are known here; change that, or "
        "describe the structure by its modes");
  }
}

std::optional<CutAtSpeed> by_poles(const SampledStructure& structure, const MillingProcess& process,
                                   double spindle_speed_rpm) {
  if (!structure.poles) return std::nullopt;
  return CutAtSpeed{in_tool_axes(*structure.poles, process.frame), process, {}, spindle_speed_rpm};
}

SampledCut sampled_cut(const SampledStructure& structure, const MillingProcess& process, double spindle_speed_rpm) {
  SampledCut cut{structure.samples,
                 by_poles(structure, process, spindle_speed_rpm),
                 process,
                 {},
                 0.0,
                 highest_resonance_hz(structure.samples),
                 spindle_speed_rpm};
  cut.yielding = yielding_directions(cut);
  if (cut.by_poles) cut.by_poles->yielding = cut.yielding;  // one grid for both
  cut.mean_stiffness = mean_stiffness(contact_grid(process, cut.yielding, {1, 8}));
  return cut;
}

/// The highest line that could regenerate at this depth (0: none), or has a twentieth of the largest |H|.
double highest_that_matters_hz(const SampledCut& cut, double depth_m) {
  const auto& H = cut.receptance.H;
  double largest = 0.0;
  for (const auto& line : H) largest = std::max(largest, line.norm());
  const double least = std::min(0.05 * largest, 0.25 / (depth_m * cut.mean_stiffness));
  std::size_t line = H.size() - 1;
  while (line > 0 && H[line].norm() < least) --line;
  return cut.receptance.frequency_hz(static_cast<Index>(line));
}

/// Nodes in the cut, and harmonics up to a frequency.
struct Fineness {
  Resolution resolution;
  double harmonics_to_hz = 0.0;
};

Fineness resolving(const SampledCut& cut, double depth_m) {
  const double hz = highest_that_matters_hz(cut, depth_m);
  const double pole_hz =
      cut.by_poles ? fastest_that_matters(*cut.by_poles, cut.mean_stiffness, depth_m) / (2.0 * pi) : 0.0;
  const double phase =
      2.0 * pi * std::max(hz, pole_hz) * longest_stretch_rad(cut.process) * 30.0 / (pi * cut.spindle_speed_rpm);
  const int elements = std::max(1, static_cast<int>(std::ceil(phase / 14.0)));
  const double tooth_passing_hz = 1.0 / tooth_period_s(cut.process.cutter, cut.spindle_speed_rpm);
  return {{elements, static_cast<int>(std::ceil(4.0 + 0.5 * phase / elements))}, 4.0 * (hz + 2.0 * tooth_passing_hz)};
}

Fineness finer(const Fineness& f) {
  return {finer(f.resolution), 2.0 * f.harmonics_to_hz};
}

double chatter_hz(const SampledCut& cut, const ContactGrid& grid, double theta, const Eigen::VectorXcd& c) {
  const auto& hz = cut.receptance.frequency_hz;
  double highest = 2.0 * pi * hz(hz.size() - 1);
  if (cut.by_poles) highest = std::max(highest, 1.5 * cut.by_poles->structure.poles.cwiseAbs().maxCoeff());
  const auto at = [&](double omega) { return receptance_at(cut, omega); };
  return chatter_frequency_hz(grid, tooth_period_s(cut.process.cutter, cut.spindle_speed_rpm), at, highest, theta, c);
}

GainOnCircle sum(const GainOnCircle& a, const GainOnCircle& b) {
  GainOnCircle both{a.size,
                    [a, b](double theta) { return Eigen::MatrixXcd(a.Z(theta) + b.Z(theta)); },
                    [a, b](double theta) { return Eigen::MatrixXcd(a.slope(theta) + b.slope(theta)); },
                    {}};
  std::ranges::merge(a.stops, b.stops, std::back_inserter(both.stops));
  const auto same = [](double x, double y) { return y - x < 1e-4; };
  both.stops.erase(std::unique(both.stops.begin(), both.stops.end(), same), both.stops.end());
  both.stops.back() = pi;
  return both;
}

/// Grids of a cut known by samples, each finer one with more harmonics, too.
class SampledGrids : public FixedGrids {
 public:
  SampledGrids(const SampledCut& cut, Fineness first, int most_nodes)
      : cut_(cut), next_(first), most_nodes_(most_nodes) {}

  const ContactGrid& operator[](std::size_t level) { return made(level).cut.grid; }
  [[nodiscard]] double reach(std::size_t level) { return made(level).reach; }
  [[nodiscard]] const GainOnCircle& gain(std::size_t level) override { return made(level).gain; }
  [[nodiscard]] int nodes(std::size_t level) override { return static_cast<int>((*this)[level].node_rad.size()); }
  [[nodiscard]] bool more_after(std::size_t level) override { return level < 2 || 3 * nodes(level) < 2 * most_nodes_; }
  /// The count on the second grid at most: it costs as much as a search, and its harmonics are many enough for it.
  [[nodiscard]] int unstable(std::size_t level, double depth_m) override {
    return unstable_count(gain(std::min<std::size_t>(level, 1)), depth_m);
  }
  [[nodiscard]] double chatter_frequency_hz(std::size_t level, const Crossing& crossing) override {
    return chatter_hz(cut_, (*this)[level], crossing.theta_rad, crossing.mode);
  }
  /// The error by what lies beyond the range of the receptance: twice what the depth moves by with a plain line at
  /// either end, since the oscillator that matters there may be another than the one that is taken.
  [[nodiscard]] double error_beyond_grids(std::size_t level, const Crossing& crossing) override {
    double error = 0.0;
    for (const Continuation& plain : {Continuation{0.0, cut_.resonance_hz}, Continuation{cut_.resonance_hz, 0.0}}) {
      Crossing moved = crossing;
      const bool kept = refine(gain_of(made(level), plain), moved);
      error += kept ? 2.0 * std::abs(moved.depth_m / crossing.depth_m - 1.0) : 1.0;
    }
    return error;
  }

 private:
  struct Level {
    DiscreteCut cut;     ///< its loop empty without poles
    double reach = 0.0;  ///< harmonics, over the last line
    GainOnCircle gain;
  };

  const Level& made(std::size_t level) {
    const auto& hz = cut_.receptance.frequency_hz;
    while (levels_.size() <= level) {
      levels_.push_back(std::make_unique<Level>());
      Level& last = *levels_.back();
      last.cut = cut_.by_poles ? discrete(*cut_.by_poles, next_.resolution, 0.0)
                               : DiscreteCut{contact_grid(cut_.process, cut_.yielding, next_.resolution), {}};
      last.reach = next_.harmonics_to_hz / hz(hz.size() - 1);
      last.gain = remembering(gain_of(last, {cut_.resonance_hz, cut_.resonance_hz}));
      next_ = finer(next_);
    }
    return *levels_[level];
  }
  [[nodiscard]] GainOnCircle gain_of(const Level& level, const Continuation& beyond) const {
    const GainOnCircle samples =
        harmonic_gain(cut_.receptance, level.cut.grid, cut_.spindle_speed_rpm, level.reach, beyond);
    return cut_.by_poles ? sum(samples, milling::gain_of(level.cut)) : samples;
  }

  const SampledCut& cut_;
  Fineness next_;
  int most_nodes_;
  std::vector<std::unique_ptr<Level>> levels_;
};

/// Describes the limit of a row without crossings by the motion nearest to growing at the depth limit.
void describe_depth_limit(const SampledCut& cut, SampledGrids& grids, double depth_limit_m, LobeRow& row) {
  double nearest = INFINITY;
  for (const double theta : grids.gain(0).stops) {
    const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> eigen(Eigen::MatrixXcd(-depth_limit_m * grids.gain(0).Z(theta)));
    Index at = 0;
    const double distance = (eigen.eigenvalues().array() - 1.0).abs().minCoeff(&at);
    if (distance >= nearest) continue;
    nearest = distance;
    row.kind = bifurcation_at(theta);
    row.chatter_frequency_hz = chatter_hz(cut, grids[0], theta, eigen.eigenvectors().col(at));
  }
  row.limiting_depth_m = depth_limit_m;
  row.at_limit = true;
  if (row.status == StabilityStatus::converged) row.status = StabilityStatus::stable_to_depth_limit;
}

LobeRow row_of(const SampledCut& cut, const StabilityOptions& options) {
  const auto nodes = [](const Fineness& f) { return f.resolution.elements * f.resolution.nodes; };
  Fineness fineness = resolving(cut, 0.0);
  // Noise may let the search and the count of any grid disagree: a second try, but no endless ones.
  for (int tries = 0; true;) {
    SampledGrids grids(cut, fineness, options.most_nodes);
    FirstCrossing first = first_crossing(grids.gain(0), beyond_limit(options));
    // A cut counts as stable up to a depth only if the grid resolves every line that could regenerate there.
    const Fineness needed = resolving(cut, std::min(options.depth_limit_m, first.depth_m()));
    if (nodes(fineness) < nodes(needed)) {
      fineness = needed;
      continue;
    }
    const double wanted = wanted_m(first.found, options);
    LobeRow row = row_from(grids, std::move(first), cut.spindle_speed_rpm, options);
    if (row.crossings.empty()) describe_depth_limit(cut, grids, options.depth_limit_m, row);
    if ((sound(row) && row.searched_m >= wanted) || ++tries == 2 || 3 * row.nodes >= options.most_nodes) return row;
    fineness = finer(fineness);
  }
}

/// A crossing on the first of some grids whose depth agrees with it; no level if none does.
struct FoundAgain {
  Crossing crossing;
  std::optional<std::size_t> level{};
};

FoundAgain found_again(SampledGrids& grids, const LobePoint& point, double period_s, double tolerance) {
  for (std::size_t level = 0; true; ++level) {
    FoundAgain found{{point.depth_m, multiplier_angle_rad(point, period_s), 0, {}}};
    const bool kept = refine(grids.gain(level), found.crossing);
    if (kept && std::abs(found.crossing.depth_m / point.depth_m - 1.0) <= tolerance) found.level = level;
    if (found.level || !grids.more_after(level)) return found;
  }
}

}  // namespace

std::vector<Eigen::Matrix3cd> depth_gradient(const SampledStructure& structure, const MillingProcess& process,
                                             double spindle_speed_rpm, const LobePoint& point,
                                             const StabilityOptions& options) {
  require_usable(process, options, spindle_speed_rpm);
  require_range(structure.samples, process, spindle_speed_rpm);
  SampledCut cut = sampled_cut(structure, process, spindle_speed_rpm);
  cut.yielding = Eigen::Matrix3d::Identity();  // a change may move what did not move so far
  if (cut.by_poles) cut.by_poles->yielding = cut.yielding;
  SampledGrids grids(cut, finer(resolving(cut, point.depth_m)), options.most_nodes);
  const FoundAgain found = found_again(grids, point, tooth_period_s(process.cutter, spindle_speed_rpm),
                                       10.0 * std::max(point.error_estimate, options.error_tolerance));
  if (!found.level) {
    std::ostringstream text;
    text << "gradient of a depth: no crossing at " << point.depth_m * 1e3 << " mm and " << spindle_speed_rpm
         << " rpm; give a crossing of the same structure and process";
    throw core::NumericalError(text.str());
  }
  const double theta = found.crossing.theta_rad, w = found.crossing.depth_m;
  const Eigenpair pair = eigenpair_near(grids.gain(*found.level), theta, 1.0 / w);
  const bool at_end = theta == 0.0 || theta == pi;
  const complex<double> along(1.0, at_end ? 0.0 : pair.slope.real() / pair.slope.imag());
  const complex<double> factor = w * w * along / (pair.left.transpose() * pair.right).value();
  return gain_gradient(structure.samples, grids[*found.level], spindle_speed_rpm, grids.reach(*found.level),
                       {cut.resonance_hz, cut.resonance_hz}, theta, pair.left, pair.right, factor);
}

void require_range(const SampledReceptance& receptance, const MillingProcess& process, double spindle_speed_rpm) {
  require_usable(receptance);
  const double first = receptance.frequency_hz(0);
  const double last = receptance.frequency_hz(receptance.frequency_hz.size() - 1);
  const double resonance = highest_resonance_hz(receptance);
  std::ostringstream text;
  text << "receptance at the cut: lines from " << first << " to " << last << " Hz ";
  if (resonance == 0.0) {
    text << "hold no resonance, the one that chatters must lie among them; measure a wider range";
    throw core::InputError(text.str());
  }
  const double passing = 1.0 / tooth_period_s(process.cutter, spindle_speed_rpm);
  const double above = resonance + passing;
  const double below = std::abs(resonance - passing);
  const bool reaches_down = first <= below || first <= 0.5 * resonance;
  if (last >= above && reaches_down) return;
  text << "do not hold the harmonic at " << (last < above ? above : below) << " Hz, one tooth passing (" << passing
       << " Hz at " << spindle_speed_rpm << " rpm) " << (last < above ? "above" : "beside") << " the resonance at "
       << resonance << " Hz; measure from " << std::min(first, 0.5 * resonance) << " to " << std::max(last, above)
       << " Hz" << (last < above ? ", or ask for lower speeds" : "");
  throw core::InputError(text.str());
}

LobeRow limiting_depth(const SampledStructure& structure, const MillingProcess& process, double spindle_speed_rpm,
                       const StabilityOptions& options) {
  require_usable(process, options, spindle_speed_rpm);
  require_range(structure.samples, process, spindle_speed_rpm);
  return row_of(sampled_cut(structure, process, spindle_speed_rpm), options);
}

Lobes stability_lobes(const SampledStructure& structure, const MillingProcess& process,
                      const std::vector<double>& spindle_speeds_rpm, const StabilityOptions& options,
                      const KeptRows& kept) {
  const auto at = [&](double rpm, std::optional<double> /*expected*/) {
    return limiting_depth(structure, process, rpm, options);
  };
  return lobes_of(rows_by_blocks(spindle_speeds_rpm, at, kept),
                  "contact-phase collocation on samples of the receptance");
}

}  // namespace thinwall::milling
