#include "app/lobes_input.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "dynamics/dof.hpp"
#include "io/csv_text.hpp"

namespace thinwall::app {

namespace {

namespace fs = std::filesystem;
using core::UsageError;

/// One CSV file of the command line.
struct Source {
  char response = 'x';
  char force = 'x';
  fs::path file;
  bool entry_given = false;
};

bool is_direction(char letter) {
  return letter == 'x' || letter == 'y' || letter == 'z';
}

Source source_of(const std::string& word) {
  const auto equals = word.find('=');
  const bool entry = (equals == 1 || equals == 2) && is_direction(word[0]) && is_direction(word[equals - 1]);
  if (!entry) return {'x', 'x', word, false};
  return {word[0], word[equals - 1], word.substr(equals + 1), true};
}

/// A TOML string; JSON escapes are among TOML's.
std::string quoted(const std::string& text) {
  try {
    return nlohmann::json(text).dump();
  } catch (const nlohmann::json::exception&) {
    throw core::InputError("\"" + text + "\" is not in UTF-8, as names in a case have to be; rename it");
  }
}

std::optional<std::size_t> column(const io::CsvText& text, const std::string& name) {
  const auto found = std::ranges::find(text.header, name);
  if (found == text.header.end()) return std::nullopt;
  return static_cast<std::size_t>(found - text.header.begin());
}

bool is_table_of_modes(const io::CsvText& text) {
  return column(text, "damping_ratio").has_value();
}

std::size_t required_column(const io::CsvText& text, const std::string& name) {
  if (const auto found = column(text, name)) return *found;
  throw core::DataError(
      text.path.string() + ": no column \"" + name +
      "\"; a table of modes has frequency_hz, damping_ratio, stiffness (N/m) or mass (kg), direction");
}

double checked(const io::CsvText& text, const io::CsvLine& line, std::size_t at, double lower, double upper) {
  const double value = io::number(text, line, at);
  if (value > lower && value < upper) return value;
  throw core::DataError(io::location(text, line) + ": " + text.header[at] + " = " + core::number_text(value) +
                        ", must be above " + core::number_text(lower) +
                        (std::isfinite(upper) ? " and below " + core::number_text(upper) : "") +
                        "; correct the table of modes");
}

/// [[tool.modes]] for every line.
std::string modes_text(const io::CsvText& text) {
  const std::size_t frequency = required_column(text, "frequency_hz");
  const std::size_t damping = required_column(text, "damping_ratio");
  const auto mass = column(text, "mass");
  const std::size_t stiffness_or_mass = mass ? *mass : required_column(text, "stiffness");
  if (mass && column(text, "stiffness"))
    throw core::DataError(text.path.string() + ": has stiffness and mass; keep one of the two columns");
  const auto direction = column(text, "direction");
  io::require_columns(text, text.header.size(), "a table of modes");
  std::string toml;
  for (const io::CsvLine& line : text.lines) {
    const double hz = checked(text, line, frequency, 0.0, INFINITY);
    const double omega = 2.0 * std::numbers::pi * hz;
    const double given = checked(text, line, stiffness_or_mass, 0.0, INFINITY);
    const std::string along = direction ? line.fields[*direction] : "x";
    try {
      (void)dynamics::axis(along);
    } catch (const core::InputError& error) {
      throw core::DataError(io::location(text, line) + ": " + error.what());
    }
    toml += "\n[[tool.modes]]\nfrequency = " + quoted(core::number_text(hz) + " Hz") +
            "\ndamping_ratio = " + quoted(core::number_text(checked(text, line, damping, 0.0, 1.0))) +
            "\nstiffness = " + quoted(core::number_text(mass ? given * omega * omega : given) + " N/m") +
            "\ndirection = " + quoted(along) + "\n";
  }
  return toml;
}

std::string measured_text(const Source& source, const LobesInput& input) {
  if (input.quantity.empty() || input.unit.empty()) {
    throw UsageError("\"" + source.file.string() +
                     "\": say what the FRF is, for example --quantity accelerance --unit m/s^2/N (receptance m/N, "
                     "mobility m/s/N)");
  }
  return "\n[[tool.measured]]\nresponse = " + quoted(std::string(1, source.response)) +
         "\nforce = " + quoted(std::string(1, source.force)) +
         "\nfile = " + quoted(fs::absolute(source.file).lexically_normal().string()) +
         "\nquantity = " + quoted(input.quantity) + "\nunit = " + quoted(input.unit) +
         "\nfrequency_unit = " + quoted(input.frequency_unit.empty() ? "Hz" : input.frequency_unit) + "\n";
}

std::string structure_text(const LobesInput& input) {
  std::string toml;
  for (const std::string& word : input.sources) {
    const Source source = source_of(word);
    const io::CsvText text = io::read_csv_text(source.file);
    const bool modes = is_table_of_modes(text);
    if (modes && (input.sources.size() > 1 || source.entry_given || !input.quantity.empty() || !input.unit.empty())) {
      throw UsageError("\"" + source.file.string() +
                       "\" is a table of modes: give it alone, without ENTRY=, --quantity and --unit");
    }
    toml += modes ? modes_text(text) : measured_text(source, input);
  }
  return toml;
}

cases::Case from_case(const LobesInput& input) {
  if (input.sources.size() > 1 || !input.tool.empty() || !input.quantity.empty() || !input.unit.empty() ||
      !input.frequency_unit.empty()) {
    throw UsageError("\"" + input.sources.front() +
                     "\" is a case: give it alone; --tool, --quantity, --unit and --frequency-unit go with CSV files");
  }
  cases::Case result = cases::read_case(input.sources.front(), input.overrides);
  if (!result.lobes || !result.cutting || !result.tool) {
    throw core::InputError(result.file.string() +
                           ": has no chart to compute; add [tool], [cutting] and [lobes] (docs/case-file.md)");
  }
  return result;
}

cases::Case from_files(const LobesInput& input) {
  if (input.tool.empty()) {
    throw UsageError("\"" + input.sources.front() +
                     "\" needs --tool TOOL.toml, a file with the tables [tool], [cutting] and [lobes] of a case");
  }
  if (!fs::is_regular_file(input.tool))
    throw core::DataError("--tool: there is no file \"" + input.tool + "\"; write one with [tool], [cutting], [lobes]");
  const fs::path file = input.tool;
  const std::string text = core::read_file(file) + structure_text(input);
  cases::Case result = cases::parse_case(text, file.parent_path(), file.string(), input.overrides);
  result.file = file;
  result.name = source_of(input.sources.front()).file.stem().string();
  if (!result.lobes || !result.cutting) {
    throw core::InputError(input.tool + ": has no " + (result.cutting ? "[lobes]" : "[cutting]") +
                           "; a chart needs [tool], [cutting] and [lobes] (docs/case-file.md)");
  }
  return result;
}

}  // namespace

cases::Case lobes_case(const LobesInput& input) {
  const fs::path first = input.sources.front();
  return fs::is_directory(first) || first.extension() == ".toml" ? from_case(input) : from_files(input);
}

milling::OperatingPoint operating_point(const std::string& text) {
  const auto fail = [&](const std::string& why) {
    throw UsageError("--at \"" + text + "\": " + why + "; write --at \"5000 rpm, 0.5 mm\"");
  };
  const auto comma = text.find(',');
  if (comma == std::string::npos || text.find(',', comma + 1) != std::string::npos)
    fail("a spindle speed and a depth with one comma between them are expected");
  milling::OperatingPoint point;
  try {
    point.spindle_speed_rpm = core::parse_quantity(text.substr(0, comma), core::kind::spindle_speed);
    point.depth_m = core::parse_quantity(text.substr(comma + 1), core::kind::length);
  } catch (const core::InputError& error) {
    fail(error.what());
  }
  if (!(point.spindle_speed_rpm > 0.0) || !(point.depth_m > 0.0)) fail("speed and depth must be above 0");
  return point;
}

}  // namespace thinwall::app
