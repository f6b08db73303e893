#pragma once
// A set-up whose numbers can be given other values by their names, as fits do.

#include <functional>
#include <map>
#include <string>

#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// Numbers of a set-up by their names ("part.thickness"), in SI (frequencies in Hz, spindle speeds in rpm).
using NamedValues = std::map<std::string, double>;

/// Access to the numbers of one set-up.
struct Variation {
  /// The number of that name in the set-up as it was given. Throws InputError if there is none.
  std::function<double(const std::string& name)> value;
  /// The set-up with these numbers in place of its own, and all that follows from them. Throws InputError for a name
  /// that is none, or a number outside its bounds.
  std::function<Setup(const NamedValues& values)> with;
};

/// A set-up and the values that were put into it.
struct VariedSetup {
  Setup setup;
  NamedValues values;
};

/// The number of that name: as it was varied, or else as it was given.
[[nodiscard]] double value_of(const Variation& variation, const VariedSetup& varied, const std::string& name);

/// The set-up with one more value in place.
[[nodiscard]] VariedSetup with_value(const Variation& variation, const VariedSetup& varied, const std::string& name,
                                     double value);

}  // namespace thinwall::setup
