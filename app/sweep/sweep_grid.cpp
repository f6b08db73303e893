#include "app/sweep/sweep_grid.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "case/schema/schema.hpp"
#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/units.hpp"

namespace thinwall::app {

namespace {

using core::UsageError;

constexpr std::size_t most_points = 100000;

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Parts between `separator`, but not within quotes or brackets.
std::vector<std::string> parts_between(const std::string& text, char separator) {
  std::vector<std::string> parts{""};
  int depth = 0;
  bool quoted = false;
  for (const char c : text) {
    quoted = quoted != (c == '"');
    if (!quoted) depth += c == '[' ? 1 : c == ']' ? -1 : 0;
    if (c == separator && !quoted && depth == 0) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  for (auto& part : parts) part = trimmed(part);
  return parts;
}

std::string without_quotes(const std::string& text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

/// The unit that follows the number: "4 mm" → "mm".
std::string unit_of(const std::string& quantity) {
  return trimmed(quantity.substr(std::min(quantity.find_first_not_of("+-0123456789.eE"), quantity.size())));
}

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

/// The quantity as a number in `unit`, to twelve digits: 8 mm is 0.008 m and, divided by the size of a millimetre, not
/// 8 to the last bit. Throws InputError.
double number_in(const std::string& quantity, const std::string& unit, const core::QuantityKind& kind) {
  const double value = core::parse_quantity(quantity, kind);
  return unit.empty() ? value
                      : core::parse_quantity(core::number_text(value / core::parse_quantity("1 " + unit, kind), 12),
                                             core::kind::number);
}

const cases::Key& swept_key(const std::string& path, const std::string& text) {
  if (const cases::Key* key = cases::find_key(cases::case_schema(), cases::pattern_of(cases::case_schema(), path)))
    return *key;
  std::vector<std::string> known;
  for (const cases::Key& key : cases::case_schema().keys) known.emplace_back(key.path);
  throw UsageError("sweep of \"" + text + "\": a case has no key " + path + core::did_you_mean(path, known) +
                   "; docs/case-file.md has them all");
}

void add_range(SweepAxis& axis, const cases::Key& key, const std::vector<std::string>& ends, const std::string& text) {
  const auto refuse = [&](const std::string& why) {
    throw UsageError("sweep of \"" + text + "\": " + why + "; write " + axis.key + "=from:to:step, as in " +
                     "part.thickness=\"4 mm:8 mm:0.5 mm\"");
  };
  if (ends.size() != 3) refuse("a range has three parts");
  axis.unit = unit_of(ends[0]);
  double from = 0.0, to = 0.0, step = 0.0;
  try {
    from = number_in(ends[0], axis.unit, key.kind);
    to = number_in(ends[1], axis.unit, key.kind);
    step = number_in(ends[2], axis.unit, key.kind);
  } catch (const core::InputError& error) {
    refuse(error.what());
  }
  const double steps = (to - from) / step;
  if (!std::isfinite(steps) || steps < 0.0) refuse("the step does not lead from the first value to the last");
  if (steps >= static_cast<double>(most_points)) refuse("that is more than 100000 values");
  const auto last = static_cast<std::size_t>(std::floor(steps * (1.0 + 1e-12) + 1e-9));
  for (std::size_t i = 0; i <= last; ++i) {
    const double value = from + static_cast<double>(i) * step;
    // Twelve digits of the step, not of the difference: a value near zero is zero.
    const std::string number = std::abs(value) < 1e-9 * std::abs(step) ? "0" : core::number_text(value, 12);
    axis.values.push_back(with_unit(number, axis.unit));
    axis.numbers.push_back(core::parse_quantity(number, core::kind::number));
  }
}

/// The list's values as numbers of one unit, where they are.
void read_numbers(SweepAxis& axis, const cases::Key& key) {
  const std::string unit = unit_of(axis.values.front());
  std::vector<double> numbers;
  for (const auto& value : axis.values) {
    if (unit_of(value) != unit) return;
    try {
      numbers.push_back(number_in(value, unit, key.kind));
    } catch (const core::InputError&) {
      return;
    }
  }
  axis.unit = unit;
  axis.numbers = std::move(numbers);
}

bool is_number(cases::Type type) {
  return type == cases::Type::quantity || type == cases::Type::integer || type == cases::Type::quantities ||
         type == cases::Type::vector;
}

/// Throws UsageError for one of a list's values that is a range without a step.
void require_no_range(const std::string& value, const std::string& key, const std::string& text) {
  const auto range = core::range_ends(value);
  if (!range) return;
  throw UsageError("sweep of \"" + text + "\": \"" + value + "\" is a range without a step; write " + key + "=\"" +
                   range->first + ":" + range->second + ":STEP\"");
}

}  // namespace

std::string SweepAxis::title() const {
  return unit.empty() ? key : key + " [" + unit + "]";
}

std::string SweepAxis::entry(std::size_t value) const {
  return numbers.empty() ? values[value] : core::number_text(numbers[value], 12);
}

SweepAxis sweep_axis(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || trimmed(text.substr(equals + 1)).empty())
    throw UsageError("\"" + text +
                     "\" is no key with values; write part.thickness=\"4 mm:8 mm:0.5 mm\" or \"4 mm, 6 mm\"");
  SweepAxis axis;
  axis.key = cases::full_path(cases::case_schema(), trimmed(text.substr(0, equals)));
  const cases::Key& key = swept_key(axis.key, text);
  const std::string values = without_quotes(trimmed(text.substr(equals + 1)));
  const auto ends = parts_between(values, ':');
  if (is_number(key.type) && ends.size() > 1) {
    add_range(axis, key, ends, text);
    return axis;
  }
  for (const auto& value : parts_between(values, ',')) {
    if (value.empty()) throw UsageError("sweep of \"" + text + "\": a value is missing between two commas; write it");
    if (is_number(key.type)) require_no_range(value, axis.key, text);
    axis.values.push_back(without_quotes(value));
  }
  if (is_number(key.type)) read_numbers(axis, key);
  return axis;
}

std::vector<SweepAxis> sweep_axes(const std::vector<std::string>& texts) {
  std::vector<SweepAxis> axes;
  for (const auto& text : texts) {
    axes.push_back(sweep_axis(text));
    if (std::ranges::count(axes, axes.back().key, &SweepAxis::key) > 1)
      throw UsageError("sweep: " + axes.back().key + " is given twice; give all of its values at once");
  }
  if (axes.empty()) throw UsageError("sweep: no key to sweep; write part.thickness=\"4 mm:8 mm:0.5 mm\"");
  return axes;
}

std::vector<GridPoint> grid_points(const std::vector<SweepAxis>& axes) {
  std::vector<GridPoint> points{{}};
  for (const auto& axis : axes) {
    if (points.size() * axis.values.size() > most_points)
      throw UsageError("sweep: more than 100000 points; take larger steps or fewer keys");
    std::vector<GridPoint> longer;
    longer.reserve(points.size() * axis.values.size());
    for (const auto& point : points) {
      for (std::size_t value = 0; value < axis.values.size(); ++value) {
        longer.push_back(point);
        longer.back().push_back(value);
      }
    }
    points = std::move(longer);
  }
  return points;
}

std::vector<std::string> overrides_at(const std::vector<SweepAxis>& axes, const GridPoint& point) {
  std::vector<std::string> overrides;
  overrides.reserve(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i) overrides.push_back(axes[i].key + "=" + axes[i].values[point[i]]);
  return overrides;
}

Shard shard_of(const std::string& text) {
  if (text.empty()) return {};
  const auto slash = text.find('/');
  const auto whole = [](const std::string& digits) -> std::optional<std::size_t> {
    const bool plain =
        !digits.empty() && digits.size() < 7 && digits.find_first_not_of("0123456789") == std::string::npos;
    return plain ? std::optional<std::size_t>(std::stoul(digits)) : std::nullopt;
  };
  const auto index = slash == std::string::npos ? std::nullopt : whole(text.substr(0, slash));
  const auto count = slash == std::string::npos ? std::nullopt : whole(text.substr(slash + 1));
  if (!index || !count || *index < 1 || *index > *count)
    throw UsageError("--shard \"" + text + "\": write i/n with i from 1 to n, as in --shard 2/4");
  return {*index, *count};
}

}  // namespace thinwall::app
