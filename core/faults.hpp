#pragma once
// A collector of the faults of an input, so that one error lists all of them.

#include <string>

namespace thinwall::core {

/// A list of faults, raised together as one InputError.
class Faults {
 public:
  /// Notes the fault "<where> <what>" unless `holds`.
  void require(bool holds, const std::string& where, const std::string& what);

  /// Notes the fault "<where> has the <what> <value>: it must <bound>" unless `holds` and the value is finite.
  void require_number(double value, bool holds, const std::string& where, const std::string& what,
                      const std::string& bound);

  /// Throws InputError "<subject>: <fault>; <fault>" if any fault was noted.
  void raise(const std::string& subject) const;

 private:
  std::string text_;
};

}  // namespace thinwall::core
