#pragma once
// Figures that a case is expected to reproduce, with where they come from.

#include <optional>
#include <string>
#include <vector>

namespace thinwall::cases {

/// A figure with its bounds, as expected.toml gives them.
struct Expectation {
  std::string name;
  std::string quantity;  ///< path into summary.json, "coupling.modes[0].frequency_hz"
  std::optional<double> value, tolerance, relative, at_least, at_most;
  std::string origin;        ///< published, analytic, another program, recorded
  std::string same_as = {};  ///< path of the number that stands in place of `value`; empty: none
};

}  // namespace thinwall::cases
