#pragma once
// Options of a command that stand for keys of the case.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "case/machining_case.hpp"

namespace thinwall::app {

/// A key of the case, and the option that gives it a value: {"simulation.turns", "--turns"}.
struct OptionKey {
  std::string_view key, option;
};

/// The case with the overrides, of which those beyond the first `written` were made of the command's options. A problem
/// of such a value is told of its option, one of a table that the command added of the case. Throws as
/// cases::read_case().
[[nodiscard]] cases::Case read_with_options(const std::filesystem::path& path,
                                            const std::vector<std::string>& overrides, std::size_t written,
                                            std::span<const OptionKey> keys);

}  // namespace thinwall::app
