#include "report/compare.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/json_file.hpp"

namespace thinwall::report {

namespace {

/// The key that a path ends with, without indices: "error_m" of "lobes[0].forced.error_m[2]".
std::string last_key(const std::string& path) {
  const std::string key = path.substr(path.find_last_of(". ") + 1);
  return key.substr(0, key.find('['));
}

/// True if a name ends in a unit, as the names of all quantities with a dimension do.
bool has_unit(const std::string& key) {
  static constexpr std::array units{"_m", "_mm", "_hz", "_n", "_nm", "_w", "_s", "_kg", "_pa", "_rad", "_deg", "_rpm"};
  return key.find("_per_") != std::string::npos ||
         std::ranges::any_of(units, [&key](const char* unit) { return key.ends_with(unit); });
}

/// True if a number of that name is a residual or a relative error: a number without a dimension whose size is that of
/// round-off or of an estimate, so that only its staying small counts, and a relative comparison would tell nothing. An
/// error with a unit, as surface_location_error_m, is a quantity like any other.
bool is_relative_error(const std::string& path) {
  const std::string key = last_key(path);
  if (has_unit(key)) return false;
  const auto says = [&key](const char* word) { return key.find(word) != std::string::npos; };
  return says("residual") || says("difference") || says("error") || key == "max_relative" ||
         key.ends_with("_change_relative");
}

using nlohmann::json;
using Row = std::vector<std::string>;

/// A number or a text as it is, of a whole section what it holds, in one short line.
std::string shown_value(const json& value) {
  constexpr std::size_t longest = 80;
  if (value.is_structured()) return io::kind_of(value);
  std::string text = value.dump(-1, ' ', true);  // in ASCII: it may be cut anywhere
  if (text.size() > longest) text.replace(longest, std::string::npos, " …");
  return text;
}

struct Comparer {
  double tolerance;
  Comparison result;

  void number(const std::string& where, double a, double b, double scale) {
    ++result.numbers;
    const double size = std::max({std::abs(a), std::abs(b), scale});
    if (a == b || (std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= tolerance * size) return;
    std::ostringstream left, right;
    left.precision(10);
    right.precision(10);
    left << a;
    right << b;
    result.differences.push_back({where, left.str(), right.str()});
  }

  void text(const std::string& where, const std::string& a, const std::string& b) {
    if (a != b) result.differences.push_back({where, a, b});
  }

  void node(const std::string& where, const json& a, const json& b) {
    if (a.is_number() && b.is_number()) {
      return number(where, a.get<double>(), b.get<double>(), is_relative_error(where) ? 1.0 : 0.0);
    }
    if (a.is_object() && b.is_object()) return object(where, a, b);
    if (a.is_array() && b.is_array() && a.size() == b.size()) {
      for (std::size_t i = 0; i < a.size(); ++i) node(where + "[" + std::to_string(i) + "]", a[i], b[i]);
      return;
    }
    text(where, shown_value(a), shown_value(b));
  }

  void object(const std::string& where, const json& a, const json& b) {
    std::set<std::string> names;
    for (const auto& [name, value] : a.items()) names.insert(name);
    for (const auto& [name, value] : b.items()) names.insert(name);
    names.erase("timings_s");
    names.erase("sentences");  // numbers that are compared as such
    for (const auto& name : names) {
      std::string place = where;
      if (!where.ends_with(": ")) place += '.';
      place += name;
      if (a.contains(name) && b.contains(name)) {
        node(place, a[name], b[name]);
      } else {
        text(place, a.contains(name) ? shown_value(a[name]) : "absent",
             b.contains(name) ? shown_value(b[name]) : "absent");
      }
    }
  }
};

json read_summary(const std::filesystem::path& folder) {
  require_results(folder);
  const auto file = folder / "summary.json";
  json summary = io::read_json(file);
  if (!summary.is_object()) io::JsonValue{&summary, file.string(), ""}.refuse("is no object");
  return summary;
}

std::vector<Row> read_rows(const std::filesystem::path& file) {
  std::vector<Row> rows;
  std::istringstream lines(core::read_file(file));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    Row row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::optional<double> as_number(const std::string& cell) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size() ? std::optional(value) : std::nullopt;
}

/// Largest finite magnitude of each column; 1 for a column of relative errors.
std::vector<double> column_scales(const std::vector<Row>& rows) {
  std::vector<double> scales;
  for (const auto& name : rows.empty() ? Row{} : rows.front()) scales.push_back(is_relative_error(name) ? 1.0 : 0.0);
  for (const auto& row : rows) {
    if (scales.size() < row.size()) scales.resize(row.size(), 0.0);
    for (std::size_t j = 0; j < row.size(); ++j) {
      const double value = as_number(row[j]).value_or(0.0);
      if (std::isfinite(value)) scales[j] = std::max(scales[j], std::abs(value));
    }
  }
  return scales;
}

void compare_csv(Comparer& comparer, const std::string& name, const std::vector<Row>& a, const std::vector<Row>& b) {
  if (a.size() != b.size()) {
    return comparer.text(name + ": rows", std::to_string(a.size()), std::to_string(b.size()));
  }
  const auto scales = column_scales(a);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::string line = name + ": row " + std::to_string(i + 1);
    if (a[i].size() != b[i].size()) {
      comparer.text(line + ", columns", std::to_string(a[i].size()), std::to_string(b[i].size()));
      continue;
    }
    for (std::size_t j = 0; j < a[i].size(); ++j) {
      const std::string where = line + ", column " + std::to_string(j + 1);
      const auto x = as_number(a[i][j]), y = as_number(b[i][j]);
      if (x && y) {
        comparer.number(where, *x, *y, scales[j]);
      } else {
        comparer.text(where, a[i][j], b[i][j]);
      }
    }
  }
}

std::set<std::string> csv_files(const std::filesystem::path& folder) {
  std::set<std::string> names;
  try {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file() && entry.path().extension() == ".csv" && !core::is_partial_name(entry.path())) {
        names.insert(entry.path().lexically_relative(folder).string());
      }
    }
  } catch (const std::filesystem::filesystem_error& error) {
    throw core::DataError("cannot list \"" + folder.string() + "\": " + error.code().message());
  }
  return names;
}

}  // namespace

void require_results(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (std::filesystem::exists(folder / "summary.json", ignored)) return;
  throw core::DataError(
      "\"" + folder.string() +
      (std::filesystem::is_directory(folder, ignored) ? "\" holds no summary.json" : "\" is no folder") +
      ": name the result folder of a finished run, as results/<case>");
}

Comparison compare_results(const std::filesystem::path& left, const std::filesystem::path& right, double tolerance) {
  if (!(tolerance >= 0.0) || std::isinf(tolerance))
    throw core::UsageError("the tolerance is a relative one, a number from 0 on, as 1e-6");
  Comparer comparer{tolerance, {}};
  comparer.node("summary.json: ", read_summary(left), read_summary(right));
  const auto ours = csv_files(left), theirs = csv_files(right);
  std::set<std::string> names = ours;
  names.insert(theirs.begin(), theirs.end());
  for (const auto& name : names) {
    if (ours.contains(name) && theirs.contains(name)) {
      compare_csv(comparer, name, read_rows(left / name), read_rows(right / name));
    } else {
      comparer.text(name, ours.contains(name) ? "present" : "absent", theirs.contains(name) ? "present" : "absent");
    }
  }
  return std::move(comparer.result);
}

}  // namespace thinwall::report
