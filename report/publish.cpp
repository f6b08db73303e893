#include "report/publish.hpp"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"

namespace thinwall::report {

namespace {

namespace fs = std::filesystem;

bool is_of_a_run(const fs::path& path) {
  const auto named = [name = path.filename()](const char* own) { return name == own; };
  return std::ranges::any_of(result_subfolders, named) || std::ranges::any_of(result_files, named);
}

/// The entries of a result folder that stay when a run replaces its results.
std::vector<fs::path> other_entries(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!is_of_a_run(entry.path()) && !core::is_partial_name(entry.path())) found.push_back(entry.path());
  }
  return found;
}

/// Mode and owner of another folder. Throws filesystem_error where they cannot be given.
void make_alike(const fs::path& folder, const fs::path& model) {
  struct stat wanted {
  }, has{};
  const bool known = ::stat(model.c_str(), &wanted) == 0 && ::stat(folder.c_str(), &has) == 0;
  const bool same_owner = wanted.st_uid == has.st_uid && wanted.st_gid == has.st_gid;
  if (known && (same_owner || ::chown(folder.c_str(), wanted.st_uid, wanted.st_gid) == 0) &&
      ::chmod(folder.c_str(), wanted.st_mode & 07777U) == 0)
    return;
  throw fs::filesystem_error("make alike", folder, {errno, std::generic_category()});
}

/// Gives a file, folder or link a second name: files by hard links, folders anew. Throws filesystem_error.
void link_entry(const fs::path& from, const fs::path& to) {
  if (!fs::is_directory(fs::symlink_status(from))) return fs::create_hard_link(from, to);
  fs::create_directory(to);
  make_alike(to, from);
  for (const auto& entry : fs::directory_iterator(from)) link_entry(entry.path(), to / entry.path().filename());
}

bool is_same(const fs::path& a, const fs::path& b) {
  struct stat first {
  }, second{};
  return ::lstat(a.c_str(), &first) == 0 && ::lstat(b.c_str(), &second) == 0 && first.st_dev == second.st_dev &&
         first.st_ino == second.st_ino;
}

/// Moves what came into `from`, or was written anew there, after its entries were linked into `to`.
void bring_newcomers(const std::vector<fs::path>& entries, const fs::path& to) {
  for (const fs::path& entry : entries) {
    const fs::path there = to / entry.filename();
    if (is_same(entry, there)) continue;
    if (fs::is_directory(fs::symlink_status(entry)) && fs::is_directory(fs::symlink_status(there))) {
      bring_newcomers({fs::directory_iterator(entry), {}}, there);
    } else {
      fs::rename(entry, there);
    }
  }
}

bool holds_working_directory(const fs::path& folder) {
  std::error_code gone;
  const fs::path here = fs::current_path(gone);
  return std::ranges::mismatch(folder, here).in1 == folder.end();
}

bool has_access_list(const fs::path& folder) {
  return ::getxattr(folder.c_str(), "system.posix_acl_access", nullptr, 0) > 0 ||
         ::getxattr(folder.c_str(), "system.posix_acl_default", nullptr, 0) > 0;
}

bool change_places(const fs::path& a, const fs::path& b) {
  return ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
}

void remove_or_tell(const fs::path& folder) {
  std::error_code error;
  fs::remove_all(folder, error);
  if (error)
    spdlog::warn("left behind: {} ({}); the next run into this folder removes it", folder.string(), error.message());
}

/// False if the folder cannot be exchanged; all is then as before.
bool exchange(const fs::path& staging, const fs::path& folder) {
  if (holds_working_directory(folder) || has_access_list(folder)) return false;
  const fs::path beside = core::partial_path(folder);
  try {
    make_alike(staging, folder);
    for (const fs::path& entry : other_entries(folder)) link_entry(entry, staging / entry.filename());
    fs::rename(staging, beside);
  } catch (const fs::filesystem_error&) {
    return false;
  }
  if (!change_places(beside, folder)) {
    fs::rename(beside, staging);
    return false;
  }
  bring_newcomers(other_entries(beside), folder);
  remove_or_tell(beside);
  return true;
}

/// Renames that can be taken back.
class Moves {
 public:
  void move_if_there(const fs::path& from, const fs::path& to) {
    if (!fs::exists(fs::symlink_status(from))) return;
    fs::rename(from, to);
    done_.emplace_back(from, to);
  }

  void take_back() {
    std::for_each(done_.rbegin(), done_.rend(), [](const auto& move) {
      std::error_code error;
      fs::rename(move.second, move.first, error);
      if (error) spdlog::warn("{} could not be moved back: {}", move.second.string(), error.message());
    });
  }

 private:
  std::vector<std::pair<fs::path, fs::path>> done_;
};

std::vector<std::string> names_of_a_run() {
  std::vector<std::string> names(result_subfolders.begin(), result_subfolders.end());
  names.insert(names.end(), result_files.begin(), result_files.end());
  return names;
}

void replace_one_by_one(const fs::path& staging, const fs::path& folder, const std::vector<std::string>& names) {
  const fs::path earlier = core::partial_path(folder / "earlier");
  fs::create_directory(earlier);
  Moves moves;
  try {
    std::for_each(names.rbegin(), names.rend(),
                  [&](const std::string& name) { moves.move_if_there(folder / name, earlier / name); });
    for (const std::string& name : names) moves.move_if_there(staging / name, folder / name);
  } catch (const fs::filesystem_error&) {
    moves.take_back();
    std::error_code not_empty;  // where a file could not be taken back it stays there
    fs::remove(earlier, not_empty);
    throw;
  }
  remove_or_tell(staging);
  remove_or_tell(earlier);
}

void move_over(const fs::path& complete, const fs::path& folder) {
  const fs::path earlier = core::partial_path(folder);
  Moves moves;
  try {
    moves.move_if_there(folder, earlier);
    fs::rename(complete, folder);
  } catch (const fs::filesystem_error&) {
    moves.take_back();
    throw;
  }
  remove_or_tell(earlier);
}

}  // namespace

Published publish(const fs::path& staging, const fs::path& folder) {
  try {
    const fs::path place = fs::canonical(folder);  // a link to a folder stays one
    if (exchange(place / staging.filename(), place)) return Published::by_exchange;
    replace_one_by_one(place / staging.filename(), place, names_of_a_run());
    return Published::by_moves;
  } catch (const fs::filesystem_error& error) {
    throw core::DataError(std::string("cannot replace the results of an earlier run: ") + error.what());
  }
}

void publish_folder(const fs::path& complete, const fs::path& folder) {
  try {
    if (!change_places(complete, folder)) return move_over(complete, folder);
    remove_or_tell(complete);
  } catch (const fs::filesystem_error& error) {
    throw core::DataError("cannot replace \"" + folder.string() + "\": " + error.what());
  }
}

void publish_files(const fs::path& staging, const fs::path& folder, const std::vector<std::string>& names) {
  try {
    replace_one_by_one(staging, folder, names);
  } catch (const fs::filesystem_error& error) {
    throw core::DataError(std::string("cannot replace the files of an earlier result: ") + error.what());
  }
}

}  // namespace thinwall::report
