#pragma once
// Which files of a folder are opened, as the kernel tells (inotify).

#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>

namespace thinwall::tests {

/// Counts from its construction on how often each file of one folder is opened.
class OpenedFiles {
 public:
  explicit OpenedFiles(const std::filesystem::path& folder) : watch_(inotify_init1(IN_NONBLOCK)) {
    EXPECT_GE(inotify_add_watch(watch_, folder.c_str(), IN_OPEN), 0) << std::strerror(errno);
  }
  ~OpenedFiles() { ::close(watch_); }
  OpenedFiles(const OpenedFiles&) = delete;
  OpenedFiles& operator=(const OpenedFiles&) = delete;

  /// The number of times that the file of that name was opened until now.
  [[nodiscard]] int count(const std::filesystem::path& file) {
    alignas(inotify_event) std::array<char, 65536> buffer{};
    for (ssize_t size = ::read(watch_, buffer.data(), buffer.size()); size > 0;
         size = ::read(watch_, buffer.data(), buffer.size())) {
      for (ssize_t at = 0; at < size;) {
        inotify_event event{};
        std::memcpy(&event, buffer.data() + at, sizeof event);
        if (event.len > 0) ++counts_[buffer.data() + at + sizeof event];
        at += static_cast<ssize_t>(sizeof event + event.len);
      }
    }
    return counts_[file.filename().string()];
  }

 private:
  int watch_;
  std::map<std::string, int> counts_;
};

}  // namespace thinwall::tests
