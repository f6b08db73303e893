#pragma once
// The name that an option gives to what a command writes.

#include <string>

namespace thinwall::app {

/// A check of CLI11: says what is wrong with an empty name of a folder or file, which would stand for the default, as
/// where a variable of a script is not set; empty if nothing is.
inline std::string has_a_name(const std::string& name) {
  return name.empty() ? "the name is empty; give one, or leave the option out where it has a default" : "";
}

}  // namespace thinwall::app
