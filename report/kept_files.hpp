#pragma once
// Files of a result folder that follow from the same inputs as those of the run before.

#include <filesystem>

#include "report/page/document.hpp"
#include "study/kept/checkpoint.hpp"

namespace thinwall::report {

/// Puts the files that keep_files() recorded under this key from the folder `earlier` into `staging`, by hard link
/// (by copy where the file system has none). False, and nothing is put there, if nothing was recorded or a file is not
/// as it was written (size, SHA-256). Throws DataError if `staging` cannot be written. Cost: of hashing the files.
[[nodiscard]] bool take_files(const study::Checkpoint& kept, const std::filesystem::path& earlier,
                              const std::filesystem::path& staging);

/// Records all files of `staging`. Throws DataError for one that cannot be read. Cost: of hashing them.
void keep_files(study::Checkpoint& kept, const std::filesystem::path& staging);

/// Sections of a page by the checkpoint's key: of files that are the same.
[[nodiscard]] report::KeptSections kept_sections(study::Checkpoint& kept);

}  // namespace thinwall::report
