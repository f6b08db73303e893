#include "app/lobes_input.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "case/operating_point.hpp"
#include "case/problem.hpp"
#include "case/reader.hpp"
#include "case/writer.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "dynamics/dof.hpp"
#include "io/csv_text.hpp"
#include "setup/measured.hpp"

namespace thinwall::app {

namespace {

namespace fs = std::filesystem;
using core::UsageError;

/// One file of the command line.
struct FrfWord {
  char response = 'x';
  char force = 'x';
  fs::path file;
  bool entry_given = false;
};

bool is_direction(char letter) {
  return letter == 'x' || letter == 'y' || letter == 'z';
}

FrfWord source_of(const std::string& word) {
  const auto equals = word.find('=');
  const bool entry = (equals == 1 || equals == 2) && is_direction(word[0]) && is_direction(word[equals - 1]);
  if (!entry) return {'x', 'x', word, false};
  return {word[0], word[equals - 1], word.substr(equals + 1), true};
}

/// The absolute name of a file, which has to be in UTF-8 as all names in a case.
std::string name_in_case(const fs::path& file) {
  std::string name = fs::absolute(file).lexically_normal().string();
  try {
    (void)nlohmann::json(name).dump();
  } catch (const nlohmann::json::exception&) {
    throw core::InputError("\"" + name + "\" is not in UTF-8, as names in a case have to be; rename it");
  }
  return name;
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
  throw core::DataError(text.path.string() + ": no column \"" + name +
                        "\"; a table of modes has frequency_hz, damping_ratio, stiffness (N/m) or mass (kg), direction "
                        "or direction_x, direction_y, direction_z");
}

/// The direction that the line names, by a word or by its components; x where the table has no such column.
Eigen::Vector3d direction_of(const io::CsvText& text, const io::CsvLine& line) {
  if (const auto x = column(text, "direction_x")) {
    const Eigen::Vector3d along(io::number(text, line, *x),
                                io::number(text, line, required_column(text, "direction_y")),
                                io::number(text, line, required_column(text, "direction_z")));
    if (along.norm() > 0.0) return along.normalized();
    throw core::DataError(io::location(text, line) +
                          ": the direction is zero; give the line along which the mode moves");
  }
  const auto direction = column(text, "direction");
  try {
    return dynamics::axis(direction ? line.fields[*direction] : "x");
  } catch (const core::InputError& error) {
    throw core::DataError(io::location(text, line) + ": " + error.what());
  }
}

double checked(const io::CsvText& text, const io::CsvLine& line, std::size_t at, double lower, double upper) {
  const double value = io::number(text, line, at);
  if (value > lower && value < upper) return value;
  throw core::DataError(io::location(text, line) + ": " + text.header[at] + " = " + core::number_text(value) +
                        ", must be above " + core::number_text(lower) +
                        (std::isfinite(upper) ? " and below " + core::number_text(upper) : "") +
                        "; correct the table of modes");
}

/// The values of [[tool.modes]] for every line.
cases::CaseValues modes_values(const io::CsvText& text) {
  const std::size_t frequency = required_column(text, "frequency_hz");
  const std::size_t damping = required_column(text, "damping_ratio");
  const auto mass = column(text, "mass");
  const std::size_t stiffness_or_mass = mass ? *mass : required_column(text, "stiffness");
  if (mass && column(text, "stiffness"))
    throw core::DataError(text.path.string() + ": has stiffness and mass; keep one of the two columns");
  io::require_columns(text, text.header.size(), "a table of modes");
  cases::CaseValues values;
  for (std::size_t i = 0; i < text.lines.size(); ++i) {
    const io::CsvLine& line = text.lines[i];
    const std::string mode = "tool.modes[" + std::to_string(i) + "].";
    const double hz = checked(text, line, frequency, 0.0, INFINITY);
    const double omega = 2.0 * std::numbers::pi * hz;
    const double given = checked(text, line, stiffness_or_mass, 0.0, INFINITY);
    values.push_back({mode + "frequency", hz});
    values.push_back({mode + "damping_ratio", checked(text, line, damping, 0.0, 1.0)});
    values.push_back({mode + "stiffness", mass ? given * omega * omega : given});
    values.push_back({mode + "direction", std::vector{direction_of(text, line)}});
  }
  return values;
}

/// The values of the [[tool.measured]] of that number. `tells_itself`: the format has quantity and unit.
cases::CaseValues measured_values(const FrfWord& source, std::size_t number, const LobesInput& input,
                                  bool tells_itself) {
  const bool none_given = input.quantity.empty() && input.unit.empty() && input.frequency_unit.empty();
  if (!(tells_itself && none_given) && (input.quantity.empty() || input.unit.empty())) {
    throw UsageError("\"" + source.file.string() +
                     "\": say what the FRF is, for example --quantity accelerance --unit m/s^2/N (receptance m/N, "
                     "mobility m/s/N)");
  }
  const std::string frf = "tool.measured[" + std::to_string(number) + "].";
  cases::CaseValues values{{frf + "response", std::string(1, source.response)},
                           {frf + "force", std::string(1, source.force)},
                           {frf + "file", name_in_case(source.file)}};
  if (tells_itself && none_given) return values;
  values.push_back({frf + "quantity", input.quantity});
  values.push_back({frf + "unit", input.unit});
  values.push_back({frf + "frequency_unit", input.frequency_unit.empty() ? "Hz" : input.frequency_unit});
  return values;
}

/// The structure that moves: the modes of a table, or an FRF of each file.
cases::CaseValues structure_values(const LobesInput& input) {
  cases::CaseValues values;
  for (std::size_t i = 0; i < input.sources.size(); ++i) {
    const FrfWord source = source_of(input.sources[i]);
    if (setup::frf_file_kind(source.file) != setup::FrfFileKind::csv) {
      std::ranges::move(measured_values(source, i, input, true), std::back_inserter(values));
      continue;
    }
    const io::CsvText text = io::read_csv_text(source.file);
    const bool modes = is_table_of_modes(text);
    if (modes && (input.sources.size() > 1 || source.entry_given || !input.quantity.empty() || !input.unit.empty())) {
      throw UsageError("\"" + source.file.string() +
                       "\" is a table of modes: give it alone, without ENTRY=, --quantity and --unit");
    }
    std::ranges::move(modes ? modes_values(text) : measured_values(source, i, input, false),
                      std::back_inserter(values));
  }
  return values;
}

/// A problem of a value that stands in no file, by the option that gave it.
cases::Problem by_option(cases::Problem problem) {
  if (problem.line != 0 || !problem.text.starts_with("tool.measured[")) return problem;
  for (const auto& [key, option] :
       {std::pair{"].quantity: ", "--quantity"}, {"].unit: ", "--unit"}, {"].frequency_unit: ", "--frequency-unit"}}) {
    if (const auto at = problem.text.find(key); at != std::string::npos && at < problem.text.find(' '))
      problem.text = std::string(option) + problem.text.substr(at + std::string_view(key).size() - 2);
  }
  return problem;
}

/// The case of the tool's file with what moves put to it. FRFs of one option share its problems, which are told once.
cases::Case parsed(const std::string& tool, const fs::path& file, const cases::CaseValues& structure,
                   const std::vector<std::string>& overrides) {
  try {
    return cases::parse_case(tool, file.parent_path(), file.string(), overrides, structure);
  } catch (cases::CaseError& error) {
    std::vector<cases::Problem> problems;
    for (const cases::Problem& found : error.problems) {
      const cases::Problem problem = by_option(found);
      if (std::ranges::find(problems, problem.text, &cases::Problem::text) == problems.end())
        problems.push_back(problem);
    }
    throw cases::CaseError(error.source, problems);
  }
}

cases::Case from_case(const LobesInput& input) {
  if (input.sources.size() > 1 || !input.tool.empty() || !input.quantity.empty() || !input.unit.empty() ||
      !input.frequency_unit.empty()) {
    throw UsageError(
        "\"" + input.sources.front() +
        "\" is a case: give it alone; --tool, --quantity, --unit and --frequency-unit go with files of FRFs");
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
  const std::string text = core::read_file(file);
  const cases::CaseValues structure = structure_values(input);
  cases::Case result = parsed(text, file, structure, input.overrides);
  result.source = text + cases::values_text(structure, result.folder);  // can be run by itself
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
  cases::Case source = fs::is_directory(first) || first.extension() == ".toml" ? from_case(input) : from_files(input);
  source.simulation.reset();  // the charts alone
  return source;
}

milling::OperatingPoint operating_point(const std::string& text) {
  try {
    return cases::operating_point(text);
  } catch (const core::InputError& error) {
    throw UsageError("--at \"" + text + "\": " + error.what() + "; write --at \"5000 rpm, 0.5 mm\"");
  }
}

}  // namespace thinwall::app
