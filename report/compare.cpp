#include "report/compare.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "io/json_file.hpp"
#include "report/summary/summary_schema.hpp"

namespace thinwall::report {

namespace {

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

/// True of what differs from run to run, and of words for numbers that are compared as such.
bool not_compared(Kind kind) {
  return kind == Kind::run_time || kind == Kind::sentence;
}

/// The text that an entry has under a key; empty if it has none.
std::string text_at(const json& entry, const char* key) {
  const auto found = entry.find(key);
  return found != entry.end() && found->is_string() ? found->get<std::string>() : "";
}

/// The place of a value of the summary, and what an entry around it says of it.
struct Place {
  std::string path;
  std::string quantity = {};  ///< the number that values of an entry about another number are of
  std::string entry = {};     ///< the name of the outermost entry that has one: of the chart
};

struct Comparer {
  double tolerance;
  Comparison result;

  void number(Difference at, double a, double b, double scale) {
    ++result.numbers;
    const double size = std::max({std::abs(a), std::abs(b), scale});
    if (a == b || (std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= tolerance * size) return;
    std::ostringstream left, right;
    left.precision(10);
    right.precision(10);
    left << a;
    right << b;
    at.left = left.str();
    at.right = right.str();
    at.numbers = std::pair(a, b);
    result.differences.push_back(std::move(at));
  }

  void text(Difference at, const std::string& a, const std::string& b) {
    if (a == b) return;
    at.left = a;
    at.right = b;
    result.differences.push_back(std::move(at));
  }

  void node(const Place& place, const json& a, const json& b) {
    if (a.is_number() && b.is_number()) {
      const Kind own = kind_at(place.path);
      const Kind kind = own == Kind::of_quantity ? kind_at(place.quantity) : own;
      return number(in_summary(place), a.get<double>(), b.get<double>(), stays_small(kind) ? 1.0 : 0.0);
    }
    if (a.is_object() && b.is_object()) return object(place, a, b);
    if (a.is_array() && b.is_array()) {
      Place entry = place;
      for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        entry.path = place.path + "[" + std::to_string(i) + "]";
        node(entry, a[i], b[i]);
      }
      if (a.size() == b.size()) return;
    }
    text(in_summary(place), shown_value(a), shown_value(b));
  }

  void object(const Place& around, const json& a, const json& b) {
    std::set<std::string> names;
    for (const auto& [name, value] : a.items()) names.insert(name);
    for (const auto& [name, value] : b.items()) names.insert(name);
    Place place{"", text_at(a, "quantity"), around.entry};
    if (place.entry.empty() && !around.path.empty()) place.entry = text_at(a, "chart") + text_at(a, "name");
    for (const auto& name : names) {
      place.path = around.path.empty() ? name : around.path + "." + name;
      if (not_compared(kind_at(place.path))) continue;
      if (a.contains(name) && b.contains(name)) {
        node(place, a[name], b[name]);
      } else {
        text(in_summary(place), a.contains(name) ? shown_value(a[name]) : "absent",
             b.contains(name) ? shown_value(b[name]) : "absent");
      }
    }
  }

 private:
  static Difference in_summary(const Place& place) {
    return {"summary.json: " + place.path, {}, {}, place.path, place.entry};
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

/// Largest finite magnitude of each column; at least 1 for one of residuals or error estimates.
std::vector<double> column_scales(const std::vector<Row>& rows) {
  std::vector<double> scales;
  for (const auto& name : rows.empty() ? Row{} : rows.front())
    scales.push_back(stays_small(kind_of_column(name)) ? 1.0 : 0.0);
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
    return comparer.text({name + ": rows"}, std::to_string(a.size()), std::to_string(b.size()));
  }
  const auto scales = column_scales(a);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::string line = name + ": row " + std::to_string(i + 1);
    if (a[i].size() != b[i].size()) {
      comparer.text({line + ", columns"}, std::to_string(a[i].size()), std::to_string(b[i].size()));
      continue;
    }
    for (std::size_t j = 0; j < a[i].size(); ++j) {
      const std::string where = line + ", column " + std::to_string(j + 1);
      const auto x = as_number(a[i][j]), y = as_number(b[i][j]);
      if (x && y) {
        comparer.number({where}, *x, *y, scales[j]);
      } else {
        comparer.text({where}, a[i][j], b[i][j]);
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
  if (!(tolerance >= 0.0 && tolerance <= 1.0))
    throw core::UsageError(core::number_text(tolerance) +
                           " is no relative tolerance; write a number from 0 to 1, as 1e-6");
  Comparer comparer{tolerance, {}};
  comparer.object({""}, read_summary(left), read_summary(right));
  const auto ours = csv_files(left), theirs = csv_files(right);
  std::set<std::string> names = ours;
  names.insert(theirs.begin(), theirs.end());
  for (const auto& name : names) {
    if (ours.contains(name) && theirs.contains(name)) {
      compare_csv(comparer, name, read_rows(left / name), read_rows(right / name));
    } else {
      comparer.text({name}, ours.contains(name) ? "present" : "absent", theirs.contains(name) ? "present" : "absent");
    }
  }
  return std::move(comparer.result);
}

}  // namespace thinwall::report
