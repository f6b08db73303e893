#include "milling/chart/lobe_method.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "milling/classical/multi_frequency.hpp"
#include "milling/classical/uniform_step_stability.hpp"
#include "milling/classical/zeroth_order.hpp"
#include "milling/direct/stability.hpp"

namespace thinwall::milling {

namespace {

/// The row of what a search has found; nothing found is the depth limit, with the multiplier there.
LobeRow row_from(const LobeMethod& method, double rpm, FoundCrossings found, const StabilityOptions& options) {
  LobeRow row;
  row.spindle_speed_rpm = rpm;
  row.searched_m = found.searched_m;
  row.nodes = found.nodes;
  row.crossings = std::move(found.points);
  if (!row.crossings.empty()) {
    take_limit_from_crossings(row);
    if (row.error_estimate > options.error_tolerance) row.status = StabilityStatus::node_limit_reached;
    return row;
  }
  const Multiplier mu = method.multiplier_at(rpm, options.depth_limit_m);
  row.limiting_depth_m = options.depth_limit_m;
  row.at_limit = true;
  row.chatter_frequency_hz = mu.chatter_frequency_hz;
  row.kind = mu.kind;
  row.error_estimate = mu.error_estimate;
  row.modulus_at_limit = mu.modulus;
  const bool inside = mu.status == StabilityStatus::converged || mu.modulus + mu.error_estimate < 1.0;
  row.status = inside ? StabilityStatus::stable_to_depth_limit : mu.status;
  if (mu.modulus >= 1.0) row.status = StabilityStatus::crossing_missed;
  return row;
}

class Direct : public LobeMethod {
 public:
  using LobeMethod::LobeMethod;
  [[nodiscard]] std::string name() const override { return "contact-phase collocation, critical depths directly"; }

 private:
  [[nodiscard]] Multiplier multiplier_of(double rpm, double depth_m) const override {
    return milling::multiplier_at(structure_, process_, rpm, depth_m, options_.stability);
  }
  [[nodiscard]] LobeRow row_of(double rpm, std::optional<double> expected_depth_m) const override {
    StabilityOptions options = options_.stability;
    options.expected_depth_m = expected_depth_m;
    return milling::limiting_depth(structure_, process_, rpm, options);
  }
};

/// |μ| with h harmonics; what other harmonics would change is part of the estimate.
Multiplier averaged_multiplier(const CutAtSpeed& cut, int harmonics, int others, double depth_m,
                               const StabilityOptions& options) {
  Multiplier mu = harmonic_multiplier(cut, directional_harmonics(cut.process, harmonics), depth_m, options);
  const Multiplier other = harmonic_multiplier(cut, directional_harmonics(cut.process, others), depth_m, options);
  mu.error_estimate += 2.0 * std::abs(other.modulus / mu.modulus - 1.0);
  return mu;
}

class ZerothOrder : public LobeMethod {
 public:
  using LobeMethod::LobeMethod;
  [[nodiscard]] std::string name() const override { return "zeroth-order solution"; }

 private:
  [[nodiscard]] Multiplier multiplier_of(double rpm, double depth_m) const override {
    return averaged_multiplier(cut_at_speed(structure_, process_, rpm), 0, options_.harmonics, depth_m,
                               options_.stability);
  }
  [[nodiscard]] LobeRow row_of(double rpm, std::optional<double> /*expected_depth_m*/) const override {
    const CutAtSpeed cut = cut_at_speed(structure_, process_, rpm);
    return row_from(*this, rpm, zeroth_order_crossings(cut, options_.harmonics, options_.stability),
                    options_.stability);
  }
};

class MultiFrequency : public LobeMethod {
 public:
  using LobeMethod::LobeMethod;
  [[nodiscard]] std::string name() const override {
    return "multi-frequency solution, " + std::to_string(options_.harmonics) + " harmonics";
  }

 private:
  [[nodiscard]] Multiplier multiplier_of(double rpm, double depth_m) const override {
    const int others = options_.harmonics == 0 ? 1 : options_.harmonics / 2;
    return averaged_multiplier(cut_at_speed(structure_, process_, rpm), options_.harmonics, others, depth_m,
                               options_.stability);
  }
  [[nodiscard]] LobeRow row_of(double rpm, std::optional<double> /*expected_depth_m*/) const override {
    const CutAtSpeed cut = cut_at_speed(structure_, process_, rpm);
    return row_from(*this, rpm, multi_frequency_crossings(cut, options_.harmonics, options_.stability),
                    options_.stability);
  }
};

class UniformSteps : public LobeMethod {
 public:
  UniformSteps(const RelativeStructure& structure, const MillingProcess& process, const MethodOptions& options,
               StepRule rule)
      : LobeMethod(structure, process, options), rule_(rule) {}
  [[nodiscard]] std::string name() const override {
    return (rule_.full ? "full-discretization of order " + std::to_string(rule_.state_order)
                       : "semi-discretization of order " + std::to_string(rule_.delayed_order)) +
           ", " + std::to_string(options_.steps_per_period) + " steps a tooth period";
  }

 private:
  [[nodiscard]] Multiplier multiplier_of(double rpm, double depth_m) const override {
    return uniform_step_multiplier(cut_at_speed(structure_, process_, rpm), rule_, options_.steps_per_period, depth_m);
  }
  [[nodiscard]] LobeRow row_of(double rpm, std::optional<double> /*expected_depth_m*/) const override {
    const CutAtSpeed cut = cut_at_speed(structure_, process_, rpm);
    return row_from(*this, rpm, uniform_step_crossings(cut, rule_, options_.steps_per_period, options_.stability),
                    options_.stability);
  }

  StepRule rule_;
};

}  // namespace

const std::vector<Method>& all_methods() {
  static const std::vector<Method> all{Method::direct,
                                       Method::zeroth_order,
                                       Method::multi_frequency,
                                       Method::semi_discretization_0,
                                       Method::semi_discretization_1,
                                       Method::semi_discretization_2,
                                       Method::full_discretization_1,
                                       Method::full_discretization_2,
                                       Method::full_discretization_3};
  return all;
}

std::string name(Method method) {
  return core::word_of(method);
}

Method method_named(const std::string& name) {
  if (const auto method = core::from_word<Method>(name)) return *method;
  const auto& words = core::words<Method>;
  throw core::InputError("there is no method \"" + name + "\" for lobes" +
                         core::did_you_mean(name, std::vector<std::string>(words.begin(), words.end())) +
                         "; \"direct\" serves any cut");
}

std::string objection(Method method, const MillingProcess& process) {
  if (method == Method::direct) return "";
  if (method != Method::zeroth_order && method != Method::multi_frequency) {
    if (regenerates_in_plane(process)) return "";
    return name(method) + ": takes a cylinder without process damping; this cut has more; take the direct method";
  }
  MillingProcess taken = process;
  if (method == Method::zeroth_order && process.cutter.equal_teeth()) taken.cutter.helices_rad.clear();
  if (elementary(taken)) return "";
  const std::string helix = method == Method::zeroth_order ? ", with any helix, " : " without helix ";
  return name(method) + ": takes equal teeth" + helix +
         "on a cylinder, one arc, no process damping; this cut has more; take the direct method";
}

std::vector<std::string> validate(const MethodOptions& options) {
  std::vector<std::string> violations = validate(options.stability);
  const auto require_least = [&](const char* what, int value, int least, const char* usual) {
    if (value >= least) return;
    std::ostringstream text;
    text << "stability: " << what << " is " << value << ", must be at least " << least << "; " << usual << " is usual";
    violations.push_back(text.str());
  };
  require_least("number of steps a tooth period", options.steps_per_period, 3, "40");
  require_least("number of harmonics", options.harmonics, 0, "16");
  return violations;
}

LobeMethod::LobeMethod(RelativeStructure structure, MillingProcess process, MethodOptions options)
    : structure_(std::move(structure)), process_(std::move(process)), options_(options) {}

Multiplier LobeMethod::multiplier_at(double spindle_speed_rpm, double depth_m) const {
  if (!(depth_m > 0.0) || !std::isfinite(depth_m)) {
    std::ostringstream text;
    text << "stability: depth of cut " << depth_m << " m, must be positive; correct the operating point";
    throw core::InputError(text.str());
  }
  Multiplier mu = multiplier_of(spindle_speed_rpm, depth_m);
  const bool met = mu.error_estimate <= options_.stability.error_tolerance;
  if (mu.status == StabilityStatus::converged && !met) mu.status = StabilityStatus::node_limit_reached;
  return mu;
}

double LobeMethod::residual_share() const {
  return milling::residual_share(structure_);
}

std::unique_ptr<LobeMethod> lobe_method(Method method, const RelativeStructure& structure,
                                        const MillingProcess& process, const MethodOptions& options) {
  std::vector<std::string> violations = validate(process);
  const auto more = validate(options);
  violations.insert(violations.end(), more.begin(), more.end());
  require_valid(violations);
  if (const std::string why = objection(method, process); !why.empty()) throw core::InputError(why);
  const auto steps = [&](StepRule rule) -> std::unique_ptr<LobeMethod> {
    return std::make_unique<UniformSteps>(structure, process, options, rule);
  };
  switch (method) {
    case Method::direct:
      break;
    case Method::zeroth_order:
      return std::make_unique<ZerothOrder>(structure, process, options);
    case Method::multi_frequency:
      return std::make_unique<MultiFrequency>(structure, process, options);
    case Method::semi_discretization_0:
      return steps(semi_discretization(0));
    case Method::semi_discretization_1:
      return steps(semi_discretization(1));
    case Method::semi_discretization_2:
      return steps(semi_discretization(2));
    case Method::full_discretization_1:
      return steps(full_discretization(1));
    case Method::full_discretization_2:
      return steps(full_discretization(2));
    case Method::full_discretization_3:
      return steps(full_discretization(3));
  }
  return std::make_unique<Direct>(structure, process, options);
}

}  // namespace thinwall::milling
