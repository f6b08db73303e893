#pragma once
// A text with something replaced in it, for cases that differ from a good one in one place.

#include <gtest/gtest.h>

#include <string>

namespace thinwall::tests {

/// The text with the first `from` in it replaced by `to`; a text without it fails the test.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at != std::string::npos) return text.replace(at, from.size(), to);
  ADD_FAILURE() << from;
  return text;
}

}  // namespace thinwall::tests
