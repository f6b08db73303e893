#pragma once
// `thinwall inspect FILE.uff`: what does this universal file hold?

#include <filesystem>
#include <optional>
#include <string>

#include "app/inspect_command.hpp"

namespace thinwall::app {

/// True for a universal file, by its ending (.uff, .unv) or by its first line.
[[nodiscard]] bool is_universal_file(const std::filesystem::path& file);

/// The table of a universal file: nodes and trace lines, shapes, FRFs with the number by which a case names each, what
/// its test was, and notes. Trustworthy is a file of which every part could be read. `unit`: of its nodes, where the
/// file does not tell it ("mm", or empty). With `json`, the same facts are written there. Throws DataError for a file
/// that cannot be read, InputError for another unit than one of length. Cost O(bytes).
[[nodiscard]] Inspection inspect_universal(const std::filesystem::path& file, const std::string& unit,
                                           const std::optional<std::filesystem::path>& json);

}  // namespace thinwall::app
