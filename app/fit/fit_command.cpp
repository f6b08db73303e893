#include "app/fit/fit_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "app/doctor.hpp"
#include "app/fit/fit_geometry.hpp"
#include "app/fit/fit_sensors.hpp"
#include "app/fit/fit_swap.hpp"
#include "case/schema/physical_range.hpp"
#include "core/error.hpp"
#include "core/split.hpp"
#include "core/units.hpp"
#include "identification/fit_response.hpp"
#include "report/fit/fit_files.hpp"
#include "report/fit/fit_text.hpp"

namespace thinwall::app {

namespace {

using identification::Band;

double frequency(const std::string& text, const std::string& option) {
  try {
    const double hz = core::parse_quantity(text, core::kind::frequency);
    if (hz > 0.0) {
      cases::require_physical(core::kind::frequency, hz, false);
      return hz;
    }
  } catch (const core::InputError& error) {
    throw core::UsageError(option + " \"" + text + "\": " + error.what());
  }
  throw core::UsageError(option + " \"" + text + "\": must be above 0 Hz");
}

Band left_out_band(const std::string& text) {
  constexpr double within = 0.01;
  const std::vector<std::string> ends = core::split(text, ':');
  if (ends.size() == 1) {
    const double at = frequency(ends.front(), "--exclude");
    return {(1.0 - within) * at, (1.0 + within) * at};
  }
  if (ends.size() == 2) {
    const Band band{frequency(ends.front(), "--exclude"), frequency(ends.back(), "--exclude")};
    if (band.from_hz < band.to_hz) return band;
  }
  throw core::UsageError("--exclude \"" + text + "\": write \"50 Hz\" or \"49 Hz:51 Hz\"");
}

identification::ResidualTerms terms_of(const std::string& text) {
  try {
    return identification::terms_named(text);
  } catch (const core::InputError& error) {
    throw core::UsageError(std::string("--terms: ") + error.what());
  }
}

identification::ResponseFitOptions options_of(const FitRequest& request) {
  identification::ResponseFitOptions options;
  if (!request.from.empty()) options.band.from_hz = frequency(request.from, "--from");
  if (!request.to.empty()) options.band.to_hz = frequency(request.to, "--to");
  if (!(options.band.from_hz < options.band.to_hz))
    throw core::UsageError("--from \"" + request.from + "\" is not below --to \"" + request.to + "\"");
  for (const std::string& text : request.left_out) options.left_out.push_back(left_out_band(text));
  if (!request.residues.empty()) {
    const auto residues = core::from_word<identification::Residues>(request.residues);
    if (!residues) throw core::UsageError("--residues \"" + request.residues + "\": write free, rank_one or symmetric");
    options.identify.residues = *residues;
  }
  options.identify.highest_order = request.order;
  options.passive = request.passive;
  if (!request.terms.empty()) options.identify.terms = terms_of(request.terms);
  if (request.averages && request.noise)
    throw core::UsageError("--averages and --noise both weigh the lines; give one of the two");
  if (request.noise && !(*request.noise > 0.0 && *request.noise < 1.0))
    throw core::UsageError(
        fmt::format("--noise {}: must be above 0 and below 1; 0.01 stands for 1 % of |H|", *request.noise));
  if (request.averages) options.averages = identification::OfEntries::Constant(1, 1, *request.averages);
  if (request.noise) options.noise = identification::OfEntries::Constant(1, 1, *request.noise);
  return options;
}

/// The named frequencies, Hz. Throws UsageError for two that are alike, and for one outside of the band.
std::vector<double> named_frequencies(const std::string& text, const Band& band) {
  constexpr double least_distance = 1e-6;
  std::vector<double> hz;
  for (const std::string& word : core::split(text, ',')) {
    const double named = frequency(word, "--poles");
    if (named < band.from_hz || named > band.to_hz)
      throw core::UsageError(
          fmt::format("--poles: {:.6g} Hz is outside of the band from {:.6g} to {:.6g} Hz; leave it "
                      "out, or widen the band",
                      named, band.from_hz, band.to_hz));
    if (std::ranges::any_of(hz, [&](double other) { return std::abs(other / named - 1.0) < least_distance; }))
      throw core::UsageError(fmt::format("--poles: {:.6g} Hz stands twice; name each pole once", named));
    hz.push_back(named);
  }
  return hz;
}

/// The band in which there are lines; as it is where there are none, which the fit refuses.
Band measured_band(const Band& band, const dynamics::FrequencyAxis& axis) {
  if (axis.size() == 0) return band;
  return {std::max(band.from_hz, axis.hz(0)), std::min(band.to_hz, axis.hz(axis.size() - 1))};
}

/// Throws UsageError if a result would take the place of a file that is read.
void require_other_files(const FitRequest& request) {
  for (const std::string& source : request.input.sources) {
    const std::filesystem::path file = file_of(source);
    for (const char* name : report::fit_file_names) {
      std::error_code absent;
      if (std::filesystem::equivalent(file, std::filesystem::path(request.out) / name, absent))
        throw core::UsageError("--out " + request.out + ": " + name +
                               " there is a file that is read; give another folder");
    }
  }
}

/// Tells where coherence is not used. Throws UsageError for averages without a coherence that they belong to.
void check_weights(const FitMatrix& matrix, const FitRequest& request, std::vector<std::string>& notes) {
  if (request.averages && matrix.coherence.empty())
    throw core::UsageError(
        "--averages weighs the lines by their coherence, which these files do not have for every entry; leave it out, "
        "or state --noise");
  if (!matrix.coherence.empty() && !request.averages && !request.noise)
    notes.emplace_back("coherence is not used without --averages; the lines are weighed by their scatter");
}

/// The fit in the asked form, or of rank one where that is enough.
identification::ResponseFit fitted(const FitMatrix& matrix, const FitRequest& request,
                                   identification::ResponseFitOptions& options, std::vector<std::string>& notes) {
  if (!request.residues.empty()) return identification::fit_response(matrix.measured, matrix.coherence, options);
  identification::ResponseFit fit = identification::fit_of_any_rank(matrix.measured, matrix.coherence, options);
  if (options.identify.residues == identification::Residues::free)
    notes.emplace_back(
        "residues are free, for a pole is double, as that of a round tool; --residues rank_one asks for one shape a "
        "pole");
  return fit;
}

/// The words of the command without --poles.
std::vector<std::string> words_of(const FitRequest& request) {
  std::vector<std::string> words{"thinwall", "fit"};
  words.insert(words.end(), request.input.sources.begin(), request.input.sources.end());
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  const FitInput& input = request.input;
  add("--quantity", input.quantity);
  add("--unit", input.unit);
  add("--frequency-unit", input.frequency_unit);
  add("--variable", input.variable);
  add("--frequency-variable", input.frequency_variable);
  add("--coherence-variable", input.coherence_variable);
  add("--responses", input.responses);
  add("--forces", input.forces);
  add("--geometry", input.geometry);
  for (const std::string& sensor : request.sensors) add("--sensor", sensor);
  add("--swap", request.swap);
  add("--from", request.from);
  add("--to", request.to);
  for (const std::string& band : request.left_out) add("--exclude", band);
  if (request.order != FitRequest().order) add("--order", std::to_string(request.order));
  add("--terms", request.terms);
  add("--residues", request.residues);
  if (request.averages) add("--averages", std::to_string(*request.averages));
  if (request.noise) add("--noise", fmt::format("{}", *request.noise));
  if (request.passive) words.emplace_back("--passive");
  add("--out", request.out);
  return words;
}

}  // namespace

std::string fit_files(const FitRequest& request) {
  require_other_files(request);
  identification::ResponseFitOptions options = options_of(request);
  FitMatrix matrix = fit_matrix(request.input);
  const std::vector<std::string> sensor_doubts = free_of_sensors(matrix, request.sensors);
  const std::vector<std::string> swap_doubts = with_other_tool(matrix, request.swap, options);
  report::FitReport found{matrix.measured, {}};
  check_weights(matrix, request, found.notes);
  if (!request.poles.empty()) {
    const auto hz = named_frequencies(request.poles, measured_band(options.band, matrix.measured.axis));
    found.diagram = identification::stabilisation_diagram(matrix.measured, options);
    options.identify.poles = identification::poles_near(hz, identification::stable_poles(found.diagram));
  }
  found.fit = fitted(matrix, request, options, found.notes);
  if (found.diagram.empty()) found.diagram = found.fit.found.diagram;
  found.doubts = identification::doubts_about(found.fit, matrix.measured.responses, matrix.measured.forces, options);
  for (const auto* doubts : {&sensor_doubts, &swap_doubts})
    found.doubts.insert(found.doubts.end(), doubts->begin(), doubts->end());
  found.notes.insert(found.notes.end(), matrix.notes.begin(), matrix.notes.end());
  found.coherence = matrix.coherence;
  found.sources = matrix.files;
  found.geometry = test_geometry(request.input.geometry, matrix.files, found.notes);
  found.command = words_of(request);
  const std::vector<std::string> left = report::write_fit(request.out, found, program_name());
  found.notes.insert(found.notes.end(), left.begin(), left.end());
  return report::fit_text(found) + "  wrote       " + request.out + "\n";
}

}  // namespace thinwall::app
