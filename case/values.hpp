#pragma once
// The values of a case by dotted key: what stands between the text and the typed Case.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace thinwall::cases {

/// A number is in the unit of its key (case/schema/schema.hpp); directions are unit vectors.
using Value = std::variant<double, bool, std::string, std::vector<double>, std::vector<std::string>,
                           std::vector<Eigen::Vector3d>>;

/// One key of the case with its value, and the place where it was written (as of a Problem; line 0: a default).
struct CaseValue {
  std::string key;  ///< "part.supports[0].on", "points.P.at"
  Value value;
  int line = 0;
  int column = 0;
  bool from_file = false;
  bool bare = false;  ///< a number that was written without a unit
};

/// All keys, defaults included, tables and arrays of tables in the order of the file.
using CaseValues = std::vector<CaseValue>;

/// The value of that key; nullptr if there is none.
[[nodiscard]] const CaseValue* find(const CaseValues& values, std::string_view key);

/// The names that follow `prefix.` in order, each once: children(values, "points") = {"P", "P2"}.
[[nodiscard]] std::vector<std::string> children(const CaseValues& values, std::string_view prefix);

/// Number of tables in the array `prefix`: keys prefix[0].…, prefix[1].…
[[nodiscard]] int array_size(const CaseValues& values, std::string_view prefix);

/// True if any key lies in the table `prefix`.
[[nodiscard]] bool has_table(const CaseValues& values, std::string_view prefix);

}  // namespace thinwall::cases
