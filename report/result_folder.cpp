#include "report/result_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"

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

/// A lock on the folder itself: it goes with the process, however that ends, and leaves no file behind.
int lock_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) refuse(folder, std::generic_category().message(errno));
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  const int error = errno;
  ::close(descriptor);
  refuse(folder, error == EWOULDBLOCK ? "another run is writing there" : std::generic_category().message(error));
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

ResultFolder::ResultFolder(std::filesystem::path folder) : path_(std::move(folder)) {
  make_folder(path_);
  refuse_foreign_content(path_);
  lock_ = lock_folder(path_);
  try {
    remove_unfinished_files(path_);
    try_to_write(path_);
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

ResultFolder::~ResultFolder() {
  try {
    remove_unfinished_files(path_);
  } catch (const std::exception&) {
    // The next run removes what remains; the results themselves are whole.
  }
  ::close(lock_);
}

void remove_unfinished_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> unfinished;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (core::is_partial_name(entry.path())) unfinished.push_back(entry.path());
  }
  for (const auto& path : unfinished) std::filesystem::remove_all(path);
}

}  // namespace thinwall::report
