#include "case/checks/material_doubts.hpp"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "core/units.hpp"
#include "setup/materials/cut_materials.hpp"
#include "setup/materials/specific_forces.hpp"

namespace thinwall::cases {

namespace {

std::string stress_of(const char* name, double value) {
  return name + (" " + core::readable_text(value, core::kind::stress));
}

/// A clause on the use that the robust chart makes of a material's spread; empty where there is no such chart.
std::string use_of_spread(const Case& source, double spread) {
  if (!source.lobes || !source.lobes->robust) return "";
  const double taken = source.lobes->robust->uncertainty.coefficients;
  if (taken == spread) return ", which the robust chart takes";
  return ", though the robust chart takes " + core::number_text(100.0 * taken, 2) + " % of lobes.uncertainty";
}

std::string percent_of(double spread) {
  return core::number_text(100.0 * spread, 2) + " %";
}

/// The sentence on the middle of several tools for the linear law; none where neither coefficient is taken.
std::optional<std::string> about_tools(const Case& source, const setup::MaterialCoefficients& middle) {
  const bool K_t = source.cutting->Kt == middle.K_t, K_r = source.cutting->Kr == middle.K_r;
  if (!K_t && !K_r) return std::nullopt;
  const std::string taken = K_t && K_r ? stress_of("Kt", middle.K_t) + " and " + stress_of("Kr", middle.K_r)
                            : K_t      ? stress_of("Kt", middle.K_t)
                                       : stress_of("Kr", middle.K_r);
  const std::string spread = K_t ? ", between which coefficients have a standard deviation of " +
                                       percent_of(middle.spread) + use_of_spread(source, middle.spread)
                                 : ", beside a Kt of your own, whose uncertainty is yours to give";
  return taken + (K_t && K_r ? " are" : " is") + " the middle of " + std::to_string(middle.tools) + " published tools" +
         spread + "; the range of chip thickness is not published; thinwall coefficients finds those of your tool";
}

/// The values of a case that are those of the tables of specific forces.
struct TakenFromTables {
  bool K_t = false, K_r = false, exponents = false;
};

TakenFromTables taken_from(const setup::Cutting& cutting, const setup::PowerLawCoefficients& middle) {
  return {cutting.Kt == middle.K_t, cutting.Kr == setup::usual_radial_share() * cutting.Kt,
          cutting.exponents == std::vector<double>(3, middle.exponent)};
}

/// Kt, the exponent or both as those of published tables; empty where neither is taken. The use of the spread is that
/// where Kr is not taken.
std::string from_tables(const TakenFromTables& taken, const setup::PowerLawCoefficients& middle,
                        const std::string& use) {
  if (!taken.K_t && !taken.exponents) return "";
  const std::string sources = middle.sources > 1
                                  ? "the middle of " + std::to_string(middle.sources) + " published tables"
                                  : "that of one published table";
  const std::string exponent = "the exponent " + core::number_text(middle.exponent, 2);
  if (!taken.K_t) return exponent + " is " + sources + " of its class";
  const std::string range = middle.thinnest_chip_m > 0.0 ? "" : "; the range of chip thickness is not published";
  return stress_of("Kt", middle.K_t) + " at a chip of 1 mm" + (taken.exponents ? ", with " + exponent + "," : "") +
         " is " + sources + " of its class, and tools differ by a standard deviation of " + percent_of(middle.spread) +
         use + range;
}

/// A clause on Kr, which no table has.
std::string about_share(const Case& source) {
  return fmt::format(
      "Kr {} is not published and taken as {:.2f} of Kt, the mean of published tools on aluminium, which have 0.06 to "
      "0.60, a standard deviation of {}",
      core::readable_text(source.cutting->Kr, core::kind::stress), setup::usual_radial_share(),
      percent_of(setup::radial_share_deviation()));
}

/// The sentence on what is taken of several tables of specific forces for the power law; none where nothing is.
std::optional<std::string> about_tables(const Case& source, const setup::PowerLawCoefficients& middle) {
  const TakenFromTables taken = taken_from(*source.cutting, middle);
  if (!taken.K_t && !taken.K_r && !taken.exponents) return std::nullopt;
  std::string text = from_tables(taken, middle, taken.K_r ? "" : use_of_spread(source, middle.spread));
  if (taken.K_r) text += (text.empty() ? "" : "; ") + about_share(source);
  if (taken.K_t && taken.K_r)
    text += "; with that of Kt, Kr has " + percent_of(middle.spread_with_radial) +
            use_of_spread(source, middle.spread_with_radial);
  if (!taken.K_t) text += "; beside a Kt of your own, whose uncertainty is yours to give";
  return text + "; thinwall coefficients finds those of your tool";
}

}  // namespace

void ask_about_cut_material(const Case& source, std::vector<std::string>& doubts) {
  const CaseValue* given = find(source.values, "cutting.material");
  const auto* material = given ? std::get_if<std::string>(&given->value) : nullptr;
  if (!material || !source.cutting) return;
  std::optional<std::string> told;
  if (source.cutting->law == setup::ForceLawKind::power) {
    if (const auto middle = setup::power_law_of(*material)) told = about_tables(source, *middle);
  } else if (const auto middle = setup::coefficients_of(*material)) {
    told = about_tools(source, *middle);
  }
  if (told) doubts.push_back("cutting.material " + *material + ": " + *told);
}

}  // namespace thinwall::cases
