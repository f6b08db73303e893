#pragma once
// The folder in which a run leaves its results: one run at a time, and nothing that is not whole.

#include <array>
#include <filesystem>

#include "core/error.hpp"
#include "report/folder_lock.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::report {

/// results/<case>/ below the working directory.
[[nodiscard]] std::filesystem::path default_result_folder(const std::string& case_name);

/// A result folder held by this process alone for as long as the object lives.
class ResultFolder {
 public:
  /// Makes the folder if need be, takes an advisory lock (FolderLock) on it, removes unfinished files of a killed run
  /// in it and beside it, and writes a trial file, all before anything is computed. Throws DataError: not a folder, not
  /// writable, disk full, or in use by another run.
  explicit ResultFolder(std::filesystem::path folder);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Publishes `staging` here as publish() does; the folder stays locked.
  void publish(const std::filesystem::path& staging);

  /// For a run that is refused, in a folder that was empty before: removes run.log, an empty cache, and the folders
  /// that were made for it where they are empty then. Stages that were kept in the cache stay, with the log, and so do
  /// files of others.
  void leave_nothing() noexcept;

 private:
  std::filesystem::path path_;
  std::filesystem::path present_;  ///< the nearest folder around it that was there before, or itself
  bool was_empty_ = true;
  FolderLock lock_;
};

/// body(), which computes into the folder; where it throws InputError, for what the user asked for cannot be computed,
/// nothing is left there but what is worth keeping (ResultFolder::leave_nothing).
template <class Body>
auto unless_refused(ResultFolder& folder, const Body& body) {
  try {
    return body();
  } catch (const core::InputError&) {
    folder.leave_nothing();
    throw;
  }
}

/// Removes unfinished files (core::is_partial_name) in `folder`, in its cache and in the folders of its results. What
/// lies in other folders is of others: a run there may be writing it.
void remove_unfinished_files(const std::filesystem::path& folder);

}  // namespace thinwall::report
