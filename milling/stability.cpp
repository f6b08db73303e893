#include "milling/stability.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>

#include "core/error.hpp"
#include "milling/regeneration.hpp"

namespace thinwall::milling {

namespace {

// Roache's (1994) factor on a Richardson estimate whose order is known.
constexpr double safety = 1.25;

Bifurcation kind_of(std::complex<double> mu) {
  if (std::abs(mu.imag()) > 1e-6 * std::abs(mu)) return Bifurcation::hopf;
  return mu.real() < 0.0 ? Bifurcation::flip : Bifurcation::fold;
}

// What the searches below share: one speed, its options, and whether an eigenvalue was lost on the way.
class Search {
 public:
  Search(Regeneration& at_speed, const StabilityOptions& with) : cut(at_speed), options(with) {}

  Regeneration& cut;
  const StabilityOptions& options;
  bool eigenvalue_lost = false;

  // Relative accuracy of a root at one step count: small beside the tolerance, and part of the estimate.
  [[nodiscard]] double root_tolerance() const { return 0.01 * options.error_tolerance; }

  // ln |μ|: negative if stable, and nearly linear in the depth where |μ| itself is not.
  double growth(double depth_m, StepCount steps) { return growth_of(cut.multiplier(depth_m, steps)); }

  // The same to two digits, which is enough for the sign, unless |μ| is near one.
  double rough_growth(double depth_m, StepCount steps) {
    const DominantEigenvalue eigen = cut.multiplier(depth_m, steps, 1e-4);
    const bool clear = eigen.converged && std::abs(std::abs(eigen.value) - 1.0) > 0.02;
    return clear ? growth_of(eigen) : growth(depth_m, steps);
  }

 private:
  double growth_of(const DominantEigenvalue& eigen) {
    eigenvalue_lost = eigenvalue_lost || !eigen.converged;
    return std::log(std::max(std::abs(eigen.value), 1e-300));
  }
};

struct Bracket {
  double stable_m = 0.0;
  double stable_growth = 0.0;
  double unstable_m = 0.0;
  double unstable_growth = 0.0;
};

struct StableDepth {
  double depth_m = 0.0;
  double growth = 0.0;
  int base = 0;
};

struct Scan {
  std::optional<Bracket> bracket;
  int base = 0;       ///< steps at the last depth
  StableDepth worst;  ///< least stable of the stable depths
};

// The theorem is about the exact cut. Should the discretised one be unstable there, a depth below is looked for.
StableDepth stable_start(Search& search, int least_base) {
  StableDepth start{std::min(search.cut.small_gain_depth_m(), search.options.depth_limit_m), 0.0, 0};
  for (int halvings = 0; halvings < 30; ++halvings, start.depth_m *= 0.5) {
    start.base = std::max(least_base, search.cut.resolving_steps(start.depth_m));
    start.growth = search.rough_growth(start.depth_m, {start.base, 1});
    if (start.growth < 0.0) return start;
  }
  std::ostringstream text;
  text << "stability: unstable at any depth, down to " << start.depth_m
       << " m, so the structure's damping is lost in round-off; give its modes more damping";
  throw core::NumericalError(text.str());
}

Scan scan_depths(Search& search, int least_base) {
  const double limit = search.options.depth_limit_m;
  StableDepth stable = stable_start(search, least_base);
  Scan scan{std::nullopt, stable.base, stable};
  while (stable.depth_m < limit) {
    const double depth = std::min(stable.depth_m * search.options.scan_ratio, limit);
    scan.base = std::max(least_base, search.cut.resolving_steps(depth));
    const double growth = search.rough_growth(depth, {scan.base, 1});
    if (growth >= 0.0) {
      scan.bracket = Bracket{stable.depth_m, stable.growth, depth, growth};
      return scan;
    }
    stable = {depth, growth, scan.base};
    if (growth > scan.worst.growth) scan.worst = stable;
  }
  return scan;
}

struct Root {
  double depth_m = 0.0;
  double slope = 0.0;  ///< d ln|μ| / dw, 1/m
};

// Illinois method: regula falsi that halves the value at an end which stays.
Root root(Search& search, StepCount steps, Bracket b) {
  const double tolerance = search.root_tolerance();
  double slope = (b.unstable_growth - b.stable_growth) / (b.unstable_m - b.stable_m);
  double before_m = b.unstable_m;
  double before_growth = b.unstable_growth;
  int kept = 0;
  for (int i = 0; i < 60 && b.unstable_m - b.stable_m > tolerance * b.unstable_m; ++i) {
    double depth =
        (b.stable_m * b.unstable_growth - b.unstable_m * b.stable_growth) / (b.unstable_growth - b.stable_growth);
    // Clear of the ends, so that the bracket shrinks from both sides.
    const double margin = 0.25 * tolerance * b.unstable_m;
    depth = std::clamp(depth, b.stable_m + margin, b.unstable_m - margin);
    if (i % 8 == 7) depth = 0.5 * (b.stable_m + b.unstable_m);
    const double growth = search.growth(depth, steps);
    slope = (growth - before_growth) / (depth - before_m);
    before_m = depth;
    before_growth = growth;
    if (growth < 0.0) {
      b.stable_m = depth;
      b.stable_growth = growth;
      if (kept == 1) b.unstable_growth *= 0.5;
      kept = 1;
    } else {
      b.unstable_m = depth;
      b.unstable_growth = growth;
      if (kept == -1) b.stable_growth *= 0.5;
      kept = -1;
    }
    if (slope > 0.0 && std::abs(growth / slope) <= tolerance * depth) return {depth - growth / slope, slope};
  }
  return {0.5 * (b.stable_m + b.unstable_m), slope};
}

// The crossing of another step count near `guess`, by secants that start from a known slope d ln|μ| / dw; nothing if
// they do not settle within a third of the guess, as when another branch takes over.
std::optional<double> root_near(Search& search, StepCount steps, double guess, double& slope) {
  const double tolerance = search.root_tolerance();
  double depth = guess;
  double growth = search.growth(depth, steps);
  for (int i = 0; i < 8; ++i) {
    const double next = depth - growth / slope;
    if (!(slope > 0.0) || !(std::abs(next - guess) <= guess / 3.0)) return std::nullopt;
    if (std::abs(next - depth) <= tolerance * depth) return next;
    const double next_growth = search.growth(next, steps);
    slope = (next_growth - growth) / (next - depth);
    depth = next;
    growth = next_growth;
  }
  return std::nullopt;
}

// The next m from an estimate that is too large: second order says by what factor; half of the tolerance is aimed at.
int refined(int base, double estimate, double tolerance) {
  const double factor = std::sqrt(estimate / (0.5 * tolerance));
  return static_cast<int>(std::ceil(base * std::clamp(factor, 1.4, 4.0)));
}

// What extrapolation leaves is of fourth order in the phase ω_c Δ of a step. Where the second-order term happens to
// vanish this is the estimate; the factor is from a thousand random structures and cuts (docs/theory/lobes.md).
double fourth_order(const Regeneration& cut, StepCount steps, double frequency_hz) {
  return 0.1 * std::pow(2.0 * std::numbers::pi * frequency_hz * cut.longest_step_s(steps), 4);
}

bool resolves(const Regeneration& cut, StepCount steps, double frequency_hz) {
  return 16.0 * frequency_hz * cut.longest_step_s(steps) <= 1.0;
}

StabilityStatus status_of(const Search& search, bool converged) {
  if (search.eigenvalue_lost) return StabilityStatus::eigenvalue_not_converged;
  return converged ? StabilityStatus::converged : StabilityStatus::step_limit_reached;
}

Multiplier multiplier_of(Search& search, double depth_m, int base) {
  const double tolerance = search.options.error_tolerance;
  Multiplier result;
  while (true) {
    const DominantEigenvalue coarse = search.cut.multiplier(depth_m, {base, 1});
    const DominantEigenvalue fine = search.cut.multiplier(depth_m, {base, 2});
    search.eigenvalue_lost = !coarse.converged || !fine.converged;
    const double third = (std::abs(fine.value) - std::abs(coarse.value)) / 3.0;
    result.value = fine.value;
    result.modulus = std::abs(fine.value) + third;
    result.error_estimate = safety * std::abs(third) / result.modulus;
    result.kind = kind_of(fine.value);
    result.steps = search.cut.steps({base, 2});
    if (fine.converged) result.chatter_frequency_hz = search.cut.chatter_frequency_hz(fine, {base, 2});
    result.error_estimate += fourth_order(search.cut, {base, 2}, result.chatter_frequency_hz);
    bool converged = result.error_estimate <= tolerance && resolves(search.cut, {base, 2}, result.chatter_frequency_hz);
    if (converged) {
      const double witness = std::exp(search.growth(depth_m, {base, 4}));
      result.error_estimate = std::max(result.error_estimate, std::abs(witness / result.modulus - 1.0));
      converged = result.error_estimate <= tolerance;
    }
    const int next = refined(base, result.error_estimate, tolerance);
    if (converged || 2 * next > search.options.most_steps || search.eigenvalue_lost) {
      result.status = status_of(search, converged);
      return result;
    }
    base = next;
  }
}

void require_usable(const MillingProcess& process, const StabilityOptions& options) {
  std::vector<std::string> violations = validate(process);
  const auto more = validate(options);
  violations.insert(violations.end(), more.begin(), more.end());
  require_valid(violations);
}

// A point that stays stable up to the limit, described by its multiplier there.
LobeRow row_at_limit(Search& search, int base) {
  const Multiplier mu = multiplier_of(search, search.options.depth_limit_m, base);
  LobeRow row;
  row.limiting_depth_m = search.options.depth_limit_m;
  row.at_limit = true;
  row.chatter_frequency_hz = mu.chatter_frequency_hz;
  row.kind = mu.kind;
  row.error_estimate = mu.error_estimate;
  row.steps = mu.steps;
  row.status = mu.status == StabilityStatus::converged ? StabilityStatus::stable_to_depth_limit : mu.status;
  return row;
}

// A flip island may hide between the last two depths of the scan: a finer look from the stable end narrows the bracket
// to the first crossing that it sees, and shortens the root finding.
Bracket narrowed(Search& search, StepCount steps, Bracket b) {
  constexpr int parts = 4;
  const double width = (b.unstable_m - b.stable_m) / parts;
  for (int i = 1; i < parts; ++i) {
    const double depth = b.stable_m + width;
    const double growth = search.rough_growth(depth, steps);
    if (growth >= 0.0) return {b.stable_m, b.stable_growth, depth, growth};
    b.stable_m = depth;
    b.stable_growth = growth;
  }
  return b;
}

// A scan that found nothing is believed if its least stable depth is stable at twice the steps and extrapolated too.
bool stable_throughout(Search& search, const Scan& scan) {
  const double growth = search.growth(scan.worst.depth_m, {scan.worst.base, 2});
  return growth < 0.0 && growth + std::abs(growth - scan.worst.growth) / 3.0 < 0.0;
}

// One pair of step counts.
struct Pair {
  double depth_m = 0.0;         ///< extrapolated
  double error_estimate = 0.0;  ///< relative
};

std::optional<Pair> crossing_pair(Search& search, int base, double coarse_m, double& slope) {
  const std::optional<double> fine_m = root_near(search, {base, 2}, coarse_m, slope);
  if (!fine_m) return std::nullopt;
  const double third = (*fine_m - coarse_m) / 3.0;
  const double depth = *fine_m + third;
  return Pair{depth, safety * std::abs(third) / std::abs(depth) + 2.0 * search.root_tolerance()};
}

// Refines a crossing that the scan has bracketed.
std::optional<LobeRow> refined_crossing(Search& search, int base, const Root& start) {
  const StabilityOptions& options = search.options;
  LobeRow row;
  double coarse_m = start.depth_m;
  double slope = start.slope;
  while (true) {
    const std::optional<Pair> pair = crossing_pair(search, base, coarse_m, slope);
    if (!pair) return std::nullopt;
    const DominantEigenvalue eigen = search.cut.multiplier(pair->depth_m, {base, 2});
    row.limiting_depth_m = pair->depth_m;
    row.error_estimate = pair->error_estimate;
    row.kind = kind_of(eigen.value);
    row.steps = search.cut.steps({base, 2});
    if (eigen.converged) row.chatter_frequency_hz = search.cut.chatter_frequency_hz(eigen, {base, 2});
    row.error_estimate += fourth_order(search.cut, {base, 2}, row.chatter_frequency_hz);
    bool converged =
        row.error_estimate <= options.error_tolerance && resolves(search.cut, {base, 2}, row.chatter_frequency_hz);
    if (converged) {
      const double growth = search.growth(pair->depth_m, {base, 4});
      row.error_estimate = std::max(row.error_estimate, std::abs(growth / slope) / pair->depth_m);
      converged = row.error_estimate <= options.error_tolerance;
    }
    const int next = refined(base, row.error_estimate, options.error_tolerance);
    if (converged || 2 * next > options.most_steps || search.eigenvalue_lost) {
      row.status = status_of(search, converged);
      return row;
    }
    base = next;
    const std::optional<double> again = root_near(search, {base, 1}, pair->depth_m, slope);
    if (!again) return std::nullopt;
    coarse_m = *again;
  }
}

LobeRow lowest_crossing(Search& search) {
  int least_base = 0;
  while (true) {
    const Scan scan = scan_depths(search, least_base);
    const bool last = 4 * scan.base > search.options.most_steps;
    if (scan.bracket) {
      const Root coarse = root(search, {scan.base, 1}, narrowed(search, {scan.base, 1}, *scan.bracket));
      const std::optional<LobeRow> row = refined_crossing(search, scan.base, coarse);
      if (row && row->limiting_depth_m <= search.options.depth_limit_m) return *row;
      if (row) return row_at_limit(search, scan.base);
    } else if (last || stable_throughout(search, scan)) {
      return row_at_limit(search, scan.base);
    }
    if (last) {
      // Two step counts do not even see the same crossing at the largest count: report the coarse one, with no error to
      // trust.
      LobeRow row;
      row.limiting_depth_m = scan.bracket->stable_m;
      row.error_estimate = 1.0;
      row.steps = scan.base;
      row.status = StabilityStatus::step_limit_reached;
      return row;
    }
    least_base = 2 * scan.base;
  }
}

}  // namespace

std::string name(Bifurcation kind) {
  switch (kind) {
    case Bifurcation::hopf:
      return "hopf";
    case Bifurcation::flip:
      return "flip";
    case Bifurcation::fold:
      break;
  }
  return "fold";
}

std::string name(StabilityStatus status) {
  switch (status) {
    case StabilityStatus::converged:
      return "converged";
    case StabilityStatus::step_limit_reached:
      return "step_limit_reached";
    case StabilityStatus::stable_to_depth_limit:
      return "stable_to_depth_limit";
    case StabilityStatus::eigenvalue_not_converged:
      break;
  }
  return "eigenvalue_not_converged";
}

std::vector<std::string> validate(const StabilityOptions& options) {
  std::vector<std::string> violations;
  const auto require = [&](bool holds, const char* what, double value, const char* bound) {
    if (holds) return;
    std::ostringstream text;
    text << "stability: " << what << " is " << value << ", must be " << bound;
    violations.push_back(text.str());
  };
  require(options.depth_limit_m > 0.0 && std::isfinite(options.depth_limit_m), "depth limit", options.depth_limit_m,
          "a positive depth in m; give the tool's cutting length");
  require(options.error_tolerance > 0.0 && options.error_tolerance < 1.0, "error tolerance", options.error_tolerance,
          "between 0 and 1; 0.01 is usual");
  require(options.most_steps >= 32, "largest step count", options.most_steps, "at least 32; 4096 is usual");
  require(options.scan_ratio > 1.0 && options.scan_ratio <= 2.0, "ratio of scanned depths", options.scan_ratio,
          "above 1 and at most 2; 1.25 is usual");
  return violations;
}

Multiplier multiplier_at(const RelativeStructure& structure, const MillingProcess& process, double spindle_speed_rpm,
                         double depth_m, const StabilityOptions& options) {
  require_usable(process, options);
  if (!(depth_m > 0.0) || !std::isfinite(depth_m)) {
    std::ostringstream text;
    text << "stability: depth of cut " << depth_m << " m, must be positive; correct the operating point";
    throw core::InputError(text.str());
  }
  const ContactState state = contact_state(structure, process.frame);
  Regeneration cut(structure, state, process, spindle_speed_rpm, depth_m);
  Search search(cut, options);
  return multiplier_of(search, depth_m, cut.resolving_steps(depth_m));
}

LobeRow limiting_depth(const RelativeStructure& structure, const MillingProcess& process, double spindle_speed_rpm,
                       const StabilityOptions& options) {
  require_usable(process, options);
  const ContactState state = contact_state(structure, process.frame);
  Regeneration cut(structure, state, process, spindle_speed_rpm, options.depth_limit_m);
  Search search(cut, options);
  LobeRow row = lowest_crossing(search);
  row.spindle_speed_rpm = spindle_speed_rpm;
  return row;
}

}  // namespace thinwall::milling
