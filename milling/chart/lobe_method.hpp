#pragma once
// One interface to all methods for stability: |μ| at a point, critical depths at a speed.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/words.hpp"
#include "milling/cut/process.hpp"
#include "milling/direct/lobe_row.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// Ways to the stability of a cut (docs/theory/lobes.md). They differ in what they leave out: `direct` nothing, so that
/// it is the reference of the others; `zeroth_order` the change of the cut over a tooth period, which is what makes
/// flips and islands; `multi_frequency` the higher harmonics of that change; semi- and full-discretization the motion
/// within a step of the period, whose error falls with a power of the step.
enum class Method {
  direct,           ///< contact-phase collocation, critical depths directly (stability.hpp): exact, with its error
  zeroth_order,     ///< Altintas & Budak 1995: the mean cut
  multi_frequency,  ///< Budak & Altintas 1998, Merdol & Altintas 2004: some harmonics of the cut
  semi_discretization_0,  ///< Insperger, Stepan & Turi 2008: the delayed term held over a step
  semi_discretization_1,  ///< Insperger & Stepan 2004: linear
  semi_discretization_2,  ///< quadratic
  full_discretization_1,  ///< Ding et al. 2010: state and delayed term linear
  full_discretization_2,  ///< Ding et al. 2010b: state quadratic
  full_discretization_3,  ///< Guo et al. 2012: state cubic
};

/// All methods in the order of the enumeration.
[[nodiscard]] const std::vector<Method>& all_methods();

/// The name of a method as in the enumeration: "zeroth_order" and so on.
[[nodiscard]] std::string name(Method method);

/// The method of that name. Throws InputError with the nearest one if there is none.
[[nodiscard]] Method method_named(const std::string& name);

/// The reason for which the method cannot take this cut, "" if it can. `direct` takes all, semi- and
/// full-discretization all on a cylinder without process damping (any pitches, helices, arcs), `zeroth_order` equal
/// teeth with any helix, `multi_frequency` equal teeth without.
[[nodiscard]] std::string objection(Method method, const MillingProcess& process);

/// The options of all methods; each reads those that it needs.
struct MethodOptions {
  StabilityOptions stability;
  int steps_per_period = 40;  ///< ≥ 3 a mean tooth period: semi- and full-discretization; 40 is not always enough
  int harmonics = 16;         ///< ≥ 0: of the directional matrix, in the multi-frequency solution
};

/// Every violation, empty if there is none.
[[nodiscard]] std::vector<std::string> validate(const MethodOptions& options);

/// A method with the structure, the process and the options that it was made for. A chart asks for one row a speed, so
/// that rows can be compared between methods; calls do not change the method, so that threads may share the speeds.
class LobeMethod {
 public:
  LobeMethod(RelativeStructure structure, MillingProcess process, MethodOptions options);
  virtual ~LobeMethod() = default;
  LobeMethod(const LobeMethod&) = delete;
  LobeMethod& operator=(const LobeMethod&) = delete;

  /// The method in words, with its steps or harmonics.
  [[nodiscard]] virtual std::string name() const = 0;

  /// The dominant multiplier with its estimate; Multiplier::status says whether that meets the tolerance. Throws
  /// InputError unless speed and depth are positive, NumericalError if no multiplier is found.
  [[nodiscard]] Multiplier multiplier_at(double spindle_speed_rpm, double depth_m) const;

  /// The row of a speed, with crossings in ascending depth and an estimate of each: all of them (direct,
  /// multi_frequency), those of the mean cut (zeroth_order), or those that bound a stable range (the others).
  /// `expected_depth_m` as in StabilityOptions: for `direct`, others take no notice. Throws as above.
  [[nodiscard]] LobeRow limiting_depth(double spindle_speed_rpm, std::optional<double> expected_depth_m = {}) const {
    return row_of(spindle_speed_rpm, expected_depth_m);
  }

  /// The share of the static compliance that has no dynamics here, residual_share(): a method cannot see chatter that
  /// comes from it.
  [[nodiscard]] double residual_share() const;

 protected:
  RelativeStructure structure_;
  MillingProcess process_;
  MethodOptions options_;

 private:
  [[nodiscard]] virtual Multiplier multiplier_of(double spindle_speed_rpm, double depth_m) const = 0;
  [[nodiscard]] virtual LobeRow row_of(double spindle_speed_rpm, std::optional<double> expected_depth_m) const = 0;
};

/// The method, which keeps copies of its arguments. Throws InputError for a bad process or option, or with the method's
/// objection().
[[nodiscard]] std::unique_ptr<LobeMethod> lobe_method(Method method, const RelativeStructure& structure,
                                                      const MillingProcess& process, const MethodOptions& options);

}  // namespace thinwall::milling

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 9> words<milling::Method>{"direct",
                                                                        "zeroth_order",
                                                                        "multi_frequency",
                                                                        "semi_discretization_0",
                                                                        "semi_discretization_1",
                                                                        "semi_discretization_2",
                                                                        "full_discretization_1",
                                                                        "full_discretization_2",
                                                                        "full_discretization_3"};

}  // namespace thinwall::core
