#pragma once
// What is wrong with an input, collected so that all of it is said at once.

#include <string>

namespace thinwall::core {

/// Collects what is wrong, so that one error tells all of it.
class Faults {
 public:
  /// Notes "<where> <what>" unless it holds.
  void require(bool holds, const std::string& where, const std::string& what);

  /// Notes "<where> has the <what> <value>: it must <bound>" unless it holds and the value is finite.
  void require_number(double value, bool holds, const std::string& where, const std::string& what,
                      const std::string& bound);

  /// Throws InputError "<subject>: <fault>; <fault>" if there is any.
  void raise(const std::string& subject) const;

 private:
  std::string text_;
};

}  // namespace thinwall::core
