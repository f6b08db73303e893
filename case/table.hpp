#pragma once
// One table of a case's values, read as typed members: what a binding is written with. A key that is absent, or could
// not be read, gives NaN, an empty text or an empty list; the checks have said so then.

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "case/values.hpp"
#include "core/words.hpp"

namespace thinwall::cases {

/// The values below one table.
struct Table {
  const CaseValues& values;
  std::string path;

  /// The value of that name with its place; nullptr if the table has none.
  [[nodiscard]] const CaseValue* get(std::string_view name) const {
    return find(values, path.empty() ? std::string(name) : path + "." + std::string(name));
  }
  /// True if the table has a value of that name.
  [[nodiscard]] bool has(std::string_view name) const { return get(name) != nullptr; }

  /// The value of that name as a T; `otherwise` if it is absent or of another type.
  template <typename T>
  [[nodiscard]] T value(std::string_view name, T otherwise) const {
    const CaseValue* found = get(name);
    const T* held = found == nullptr ? nullptr : std::get_if<T>(&found->value);
    return held == nullptr ? otherwise : *held;
  }
  /// The number of that name; NaN if it is absent.
  [[nodiscard]] double number(std::string_view name) const {
    return value<double>(name, std::numeric_limits<double>::quiet_NaN());
  }
  /// The number of that name; none if it is absent.
  [[nodiscard]] std::optional<double> optional(std::string_view name) const {
    return has(name) ? std::optional(number(name)) : std::nullopt;
  }
  /// Whole numbers; −1 stands for one that could not be read.
  [[nodiscard]] int integer(std::string_view name) const {
    const double held = number(name);
    return std::isfinite(held) ? static_cast<int>(held) : -1;
  }
  /// The text of that name; empty if it is absent.
  [[nodiscard]] std::string text(std::string_view name) const { return value<std::string>(name, ""); }
  /// The value whose word the text of that name is; `otherwise` if it is absent or a word of none, which the checks
  /// report.
  template <class Enum>
  [[nodiscard]] Enum choice(std::string_view name, Enum otherwise = Enum{}) const {
    return optional_choice<Enum>(name).value_or(otherwise);
  }
  /// The value whose word the text of that name is; none if it is absent or a word of none.
  template <class Enum>
  [[nodiscard]] std::optional<Enum> optional_choice(std::string_view name) const {
    return core::from_word<Enum>(text(name));
  }
  /// The truth value of that name; false if it is absent.
  [[nodiscard]] bool flag(std::string_view name) const { return value<bool>(name, false); }
  /// The list of numbers of that name; empty if it is absent.
  [[nodiscard]] std::vector<double> numbers(std::string_view name) const {
    return value<std::vector<double>>(name, {});
  }
  /// The list of numbers of that name, where a single one stands for `count` of them.
  [[nodiscard]] std::vector<double> numbers(std::string_view name, std::size_t count) const {
    const std::vector<double> list = numbers(name);
    return list.size() == 1 ? std::vector<double>(count, list.front()) : list;
  }
  /// The list of names of that name; empty if it is absent.
  [[nodiscard]] std::vector<std::string> names(std::string_view name) const {
    return value<std::vector<std::string>>(name, {});
  }
  /// The unit vectors of that name; none if it is absent.
  [[nodiscard]] std::vector<Eigen::Vector3d> directions(std::string_view name) const {
    return value<std::vector<Eigen::Vector3d>>(name, {});
  }
  /// The first unit vector of that name; NaN if it is absent.
  [[nodiscard]] Eigen::Vector3d direction(std::string_view name) const {
    const auto list = directions(name);
    return list.empty() ? Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()) : list.front();
  }
  /// The three numbers of that name; NaN if they are absent or not three.
  [[nodiscard]] Eigen::Vector3d vector(std::string_view name) const {
    const auto list = numbers(name);
    return list.size() == 3 ? Eigen::Vector3d(list[0], list[1], list[2])
                            : Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  /// The table of that name below this one.
  [[nodiscard]] Table table(std::string_view name) const {
    return {values, path.empty() ? std::string(name) : path + "." + std::string(name)};
  }
  /// The tables of the array of that name, in order.
  [[nodiscard]] std::vector<Table> tables(std::string_view name) const {
    const std::string prefix = table(name).path;
    const int count = array_size(values, prefix);
    std::vector<Table> list;
    list.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) list.push_back({values, prefix + "[" + std::to_string(i) + "]"});
    return list;
  }
  /// True if any value lies in this table.
  [[nodiscard]] bool exists() const { return has_table(values, path); }
};

}  // namespace thinwall::cases
