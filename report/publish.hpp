#pragma once
// A finished result takes the place of an earlier one.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace thinwall::report {

/// Folders of a result folder, which a run replaces whole.
inline constexpr std::array result_subfolders{"modes", "frf", "robot", "lobes", "simulation", "models"};

/// Files of a result folder that a run replaces. The manifest, which lists all others, is the last.
inline constexpr std::array result_files{"case.toml",   "case.resolved.toml", "case.fitted.toml",
                                         "report.html", "summary.json",       "manifest.json"};

/// Ways in which a result takes the place of an earlier one.
enum class Published {
  by_exchange,  ///< the folder is another one now, with all that lay in the earlier one
  by_moves,     ///< the folder is the same one
};

/// Puts the result that is complete in `staging`, a folder within `folder`, in place of the earlier one there; staging
/// is gone afterwards. What is not a run's own in the folder stays: notes, run.log, cache.
///
/// `staging` gets hard links to these, leaves the folder, and both change places in one step (renameat2 with
/// RENAME_EXCHANGE), so that at any moment, that of a death of the process included, the folder holds the earlier
/// result or the new one. Where that is not possible (no such call or no links in the file system, a mount point, no
/// right to write in the folder around it, an access list, the working directory within it), results are moved one by
/// one, the manifest away first and back last: a failure brings the earlier ones back, and a death in between leaves a
/// folder without a manifest.
///
/// Throws DataError if the results cannot be replaced; they are then the earlier ones. Cost: of listing what lies in
/// the folder.
Published publish(const std::filesystem::path& staging, const std::filesystem::path& folder);

/// Puts a folder that is complete in place of an earlier one, which is removed, or where none was: in one step, or,
/// where the file system has no exchange, in two, the earlier one away first and back if the second fails. Throws
/// DataError if it cannot be replaced; it is then the earlier one.
void publish_folder(const std::filesystem::path& complete, const std::filesystem::path& folder);

/// Moves these files from `staging`, a folder within `folder`, to it, in the place of earlier ones of these names,
/// those that are not in staging included; the last name goes first and comes last. Other files of the folder stay,
/// staging is gone afterwards. Throws DataError if they cannot be replaced; they are then the earlier ones.
void publish_files(const std::filesystem::path& staging, const std::filesystem::path& folder,
                   const std::vector<std::string>& names);

}  // namespace thinwall::report
