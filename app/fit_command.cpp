#include "app/fit_command.hpp"

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "core/error.hpp"
#include "core/units.hpp"
#include "identification/fit_response.hpp"
#include "report/fit_files.hpp"

namespace thinwall::app {

namespace {

using identification::Band;

double frequency(const std::string& text, const std::string& option) {
  try {
    const double hz = core::parse_quantity(text, core::kind::frequency);
    if (hz > 0.0) return hz;
  } catch (const core::InputError& error) {
    throw core::UsageError(option + " \"" + text + "\": " + error.what());
  }
  throw core::UsageError(option + " \"" + text + "\": must be above 0 Hz");
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> words;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = text.find(separator, begin);
    words.push_back(text.substr(begin, end - begin));
    if (end == std::string::npos) return words;
    begin = end + 1;
  }
}

Band left_out_band(const std::string& text) {
  constexpr double within = 0.01;
  const std::vector<std::string> ends = split(text, ':');
  const double from = frequency(ends.front(), "--exclude");
  if (ends.size() == 1) return {(1.0 - within) * from, (1.0 + within) * from};
  const double to = frequency(ends.back(), "--exclude");
  if (ends.size() == 2 && from < to) return {from, to};
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
    throw core::UsageError("--from " + request.from + " is not below --to " + request.to);
  for (const std::string& text : request.left_out) options.left_out.push_back(left_out_band(text));
  if (!request.residues.empty()) {
    const auto residues = core::from_word<identification::Residues>(request.residues);
    if (!residues) throw core::UsageError("--residues \"" + request.residues + "\": write free, rank_one or symmetric");
    options.identify.residues = *residues;
  }
  options.identify.highest_order = request.order;
  if (!request.terms.empty()) options.identify.terms = terms_of(request.terms);
  options.averages = request.averages;
  options.noise = request.noise;
  return options;
}

/// Starts at the named frequencies: the nearest stable pole within 5 %, or one of a damping of 1 %.
Eigen::VectorXcd named_poles(const std::string& text, const std::vector<identification::StablePole>& stable) {
  constexpr double near = 0.05, usual_damping = 0.01;
  const std::vector<std::string> words = split(text, ',');
  Eigen::VectorXcd poles(static_cast<Eigen::Index>(words.size()));
  for (std::size_t i = 0; i < words.size(); ++i) {
    const double omega = 2.0 * std::numbers::pi * frequency(words[i], "--poles");
    auto& pole = poles(static_cast<Eigen::Index>(i));
    pole = {-usual_damping * omega, omega};
    double least = near * omega;
    for (const identification::StablePole& candidate : stable) {
      const double off = std::abs(std::abs(candidate.pole) - omega);
      if (off >= least) continue;
      least = off;
      pole = candidate.pole;
    }
  }
  return poles;
}

/// Throws UsageError if a result would take the place of a file that is read.
void require_other_files(const FitRequest& request) {
  for (const std::string& source : request.input.sources) {
    const std::filesystem::path file = source.substr(source.find('=') + 1);  // all of it without "="
    for (const char* name : report::fit_file_names) {
      std::error_code absent;
      if (std::filesystem::equivalent(file, std::filesystem::path(request.out) / name, absent))
        throw core::UsageError("--out " + request.out + ": " + name +
                               " there is a file that is read; give another folder");
    }
  }
}

}  // namespace

std::string fit_files(const FitRequest& request) {
  require_other_files(request);
  identification::ResponseFitOptions options = options_of(request);
  const FitMatrix matrix = fit_matrix(request.input);
  if (!request.poles.empty())
    options.identify.poles = named_poles(request.poles, identification::stable_poles(matrix.measured, options));
  report::FitReport found{matrix.measured,
                          request.residues.empty()
                              ? identification::fit_of_any_rank(matrix.measured, matrix.coherence, options)
                              : identification::fit_response(matrix.measured, matrix.coherence, options),
                          {},
                          {}};
  if (request.residues.empty() && options.identify.residues == identification::Residues::free)
    found.notes.emplace_back(
        "residues are free, for a pole is double, as that of a round tool; --residues rank_one asks for one shape a "
        "pole");
  found.doubts = identification::doubts_about(found.fit, matrix.measured.responses, matrix.measured.forces, options);
  if (!matrix.coherence.empty() && !request.averages && !request.noise)
    found.notes.emplace_back("coherence is not used without --averages; the lines are weighed by their scatter");
  found.notes.insert(found.notes.end(), matrix.notes.begin(), matrix.notes.end());
  const std::vector<std::string> left = report::write_fit(request.out, found);
  found.notes.insert(found.notes.end(), left.begin(), left.end());
  return report::fit_text(found) + "  wrote       " + request.out + "\n";
}

}  // namespace thinwall::app
