#pragma once
// The problems that are found in a case, for tests of bad ones.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "case/reader.hpp"

namespace thinwall::tests {

/// All problems of a case whose files lie in a folder, or none if it is right.
inline std::vector<cases::Problem> problems_of(const std::string& text, const std::filesystem::path& folder = ".") {
  EXPECT_FALSE(text.empty()) << "the replacement did not match";
  try {
    (void)cases::parse_case(text, folder);
  } catch (const cases::CaseError& error) {
    EXPECT_EQ(error.code(), core::ExitCode::invalid_case);
    return error.problems;
  }
  return {};
}

}  // namespace thinwall::tests
