#include "report/result_folder.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "report/publish.hpp"

namespace thinwall::report {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& folder, const std::string& cause) {
  throw core::DataError("cannot write results to \"" + folder.string() + "\": " + cause +
                        "; choose another folder with --out");
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder, error) && !std::filesystem::is_directory(folder, error)) {
    refuse(folder, "it is a file, not a folder");
  }
  std::filesystem::create_directories(folder, error);
  if (error) refuse(folder, error.message());
}

/// The folder, if it is there, or the nearest one around it that is.
std::filesystem::path nearest_present(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::path present = std::filesystem::absolute(folder, error);
  while (!std::filesystem::exists(present, error) && present.has_relative_path()) present = present.parent_path();
  return present;
}

/// Folders that a run replaces must be a run's own.
void refuse_foreign_content(const std::filesystem::path& folder) {
  if (std::filesystem::exists(folder / "run.log") || std::filesystem::exists(folder / "manifest.json")) return;
  for (const char* name : result_subfolders) {
    if (std::filesystem::exists(folder / name)) {
      refuse(folder, std::string("it has a \"") + name +
                         "\" that no run of thinwall left there and that this run would replace");
    }
  }
}

/// The lock of the folder. A run that was killed may take a moment to be gone, with all of its memory, and a run that
/// ends puts another folder in its place; so it is asked for a second long.
FolderLock lock_folder(const std::filesystem::path& folder) {
  using namespace std::chrono_literals;
  for (int tries = 0; tries < 20; ++tries) {
    if (tries > 0) std::this_thread::sleep_for(50ms);
    if (std::optional<FolderLock> lock = FolderLock::of(folder)) return std::move(*lock);
  }
  refuse(folder, "another run is writing there");
}

/// Removes what a killed run may have left of the folder beside it, unless the run that ends just now still has it.
void remove_earlier_folders(const std::filesystem::path& folder) {
  const std::filesystem::path place = std::filesystem::canonical(folder);
  std::vector<std::filesystem::path> left;
  for (const auto& entry : std::filesystem::directory_iterator(place.parent_path())) {
    if (entry.is_directory() && !entry.is_symlink() && core::is_partial_name_of(entry.path(), place))
      left.push_back(entry.path());
  }
  for (const auto& path : left) {
    if (FolderLock::of(path)) std::filesystem::remove_all(path);
  }
}

/// More than a block, so that a full disk shows.
void try_to_write(const std::filesystem::path& folder) {
  const core::PartialFile never_committed(folder / "trial");
  core::write_file_atomically(never_committed.partial(), std::string(16384, '\n'));
}

}  // namespace

std::filesystem::path default_result_folder(const std::string& case_name) {
  return std::filesystem::path("results") / (case_name.empty() ? "case" : case_name);
}

ResultFolder::ResultFolder(std::filesystem::path folder) : path_(std::move(folder)), present_(nearest_present(path_)) {
  make_folder(path_);
  refuse_foreign_content(path_);
  lock_ = lock_folder(path_);
  was_empty_ = std::filesystem::is_empty(path_);
  remove_unfinished_files(path_);
  try {
    remove_earlier_folders(path_);
  } catch (const std::filesystem::filesystem_error&) {
    // The folder around this one may not be listed or changed: then nothing was left there.
  }
  try_to_write(path_);
}

ResultFolder::~ResultFolder() {
  try {
    remove_unfinished_files(path_);
  } catch (const std::exception&) {
    // The next run removes what remains; the results themselves are whole.
  }
}

void ResultFolder::publish(const std::filesystem::path& staging) {
  std::optional<FolderLock> next = FolderLock::of(staging);
  if (report::publish(staging, path_) == Published::by_exchange && next) lock_ = std::move(*next);
}

void ResultFolder::leave_nothing() noexcept {
  if (!was_empty_) return;
  std::error_code error;
  try {
    const std::filesystem::path kept = path_ / "cache";
    if (std::filesystem::exists(kept) && !std::filesystem::is_empty(kept)) return;  // the log belongs to what is kept
    std::filesystem::remove(kept, error);
    std::filesystem::remove(path_ / "run.log", error);
    for (auto folder = std::filesystem::absolute(path_); folder != present_ && !folder.empty();
         folder = folder.parent_path()) {
      if (folder.has_filename() && !std::filesystem::remove(folder, error)) return;
    }
  } catch (const std::exception&) {
    // What is left is a log and empty folders, and the message of the refusal is still to be told.
  }
}

void remove_unfinished_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> unfinished;
  const auto note = [&](const std::filesystem::directory_entry& entry) {
    if (core::is_partial_name(entry.path())) unfinished.push_back(entry.path());
  };
  for (const auto& entry : std::filesystem::directory_iterator(folder)) note(entry);
  std::vector<std::filesystem::path> own{folder / "cache"};
  for (const char* name : result_subfolders) own.push_back(folder / name);
  for (const auto& path : own) {
    if (!std::filesystem::is_directory(path)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path)) note(entry);
  }
  for (const auto& path : unfinished) std::filesystem::remove_all(path);
}

}  // namespace thinwall::report
