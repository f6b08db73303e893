#include "core/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <mutex>
#include <random>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace thinwall::core {

namespace {

constexpr std::string_view partial_mark = ".partial-";

[[noreturn]] void fail(std::string_view what, const std::filesystem::path& path, int error, std::string_view remedy) {
  throw DataError("cannot " + std::string(what) + " \"" + path.string() +
                  "\": " + std::generic_category().message(error) + "; " + std::string(remedy));
}

[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error) {
  const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  fail("write", path, error, full ? "free space or choose another folder" : "choose another folder");
}

[[noreturn]] void fail_to_read(const std::filesystem::path& path, int error) {
  fail("read", path, error,
       error == ENOENT || error == ENOTDIR ? "check its name and folder"
       : error == EISDIR                   ? "name a file in it"
                                           : "check that it is a file and may be read");
}

/// An open file descriptor that is closed when it goes out of scope.
struct Descriptor {
  int value = -1;
  explicit Descriptor(int descriptor) : value(descriptor) {}
  ~Descriptor() {
    if (value >= 0) ::close(value);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

void write_all(int descriptor, std::string_view content, const std::filesystem::path& target) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail_to_write(target, written < 0 ? errno : ENOSPC);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// All bytes up to the end of the file. A read that fails is an error: a stream would take it for the end, and what was
/// read so far for the whole.
std::string read_all(int descriptor, const std::filesystem::path& path) {
  constexpr std::size_t step = 1U << 20U;
  std::string content;
  std::size_t filled = 0;
  for (;;) {
    content.resize(filled + step);
    const ssize_t count = ::read(descriptor, content.data() + filled, step);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_to_read(path, errno);
    filled += static_cast<std::size_t>(count);
    if (count == 0) break;
  }
  content.resize(filled);
  return content;
}

/// The names that partial_path() has given out, but for those of files that are no longer unfinished.
struct GivenNames {
  std::mutex mutex;
  std::set<std::filesystem::path> paths;
};

/// The names of this process. They are never destroyed, because a thread that ends the process may still read them.
GivenNames& given_names() {
  static auto* const names = new GivenNames;
  return *names;
}

}  // namespace

std::filesystem::path partial_path(const std::filesystem::path& target) {
  static std::atomic<int> counter{0};
  // Processes of several machines that share a folder may have the same number.
  static const unsigned machine = std::random_device{}();
  std::ostringstream name;
  name << '.' << target.stem().string() << partial_mark << ::getpid() << '-' << machine << '-' << counter++
       << target.extension().string();
  std::filesystem::path path = target.parent_path() / name.str();
  const std::scoped_lock lock(given_names().mutex);
  given_names().paths.insert(std::filesystem::absolute(path));
  return path;
}

void remove_partial_paths() noexcept {
  constexpr int tries = 3;  // a folder into which another thread writes meanwhile is not empty at once
  const std::scoped_lock lock(given_names().mutex);
  for (int i = 0; i < tries; ++i) {
    for (const std::filesystem::path& path : given_names().paths) {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  }
}

PartialFile::PartialFile(std::filesystem::path target) : target_(std::move(target)) {
  std::error_code error;
  const auto folder = target_.has_parent_path() ? target_.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder, error)) fail_to_write(target_, error ? error.value() : ENOTDIR);
  const auto status = std::filesystem::status(target_, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw DataError("cannot write \"" + target_.string() + "\": it exists and is not a plain file; remove it first");
  }
  partial_ = partial_path(target_);
}

PartialFile::~PartialFile() {
  std::error_code ignored;
  std::filesystem::remove(partial_, ignored);
  const std::scoped_lock lock(given_names().mutex);
  given_names().paths.erase(std::filesystem::absolute(partial_, ignored));
}

void PartialFile::commit() {
  {
    const Descriptor file(::open(partial_.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.value < 0) fail_to_write(target_, errno);
    if (::fsync(file.value) != 0) fail_to_write(target_, errno);
  }
  if (std::rename(partial_.c_str(), target_.c_str()) != 0) fail_to_write(target_, errno);
}

bool is_partial_name(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with('.') && name.find(partial_mark) != std::string::npos;
}

bool is_partial_name_of(const std::filesystem::path& path, const std::filesystem::path& target) {
  const std::string name = path.filename().string(), end = target.extension().string();
  const std::string beginning = "." + target.stem().string() + std::string(partial_mark);
  if (!name.starts_with(beginning) || !name.ends_with(end) || name.size() < beginning.size() + end.size()) return false;
  const std::string numbers = name.substr(beginning.size(), name.size() - beginning.size() - end.size());
  const bool has_process = numbers.find_first_of("0123456789") == 0;
  return has_process && numbers.find_first_not_of("0123456789-") == std::string::npos;
}

void write_file_atomically(const std::filesystem::path& path, std::string_view content) {
  PartialFile file(path);
  {
    const Descriptor partial(::open(file.partial().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (partial.value < 0) fail_to_write(path, errno);
    write_all(partial.value, content, path);
  }
  file.commit();
}

std::string read_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) fail_to_read(path, EISDIR);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    // A pipe is waited for without end, and a device may never end.
    throw DataError("cannot read \"" + path.string() +
                    "\": it is a pipe or a device; write its content to a plain file");
  }
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.value < 0) fail_to_read(path, errno);
  return read_all(file.value, path);
}

}  // namespace thinwall::core
