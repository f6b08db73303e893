#include "distributed/open_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace thinwall::distributed {

namespace {

constexpr std::size_t at_once = std::size_t{1} << 30;  // the kernel moves no more than 2 GiB in a call

[[noreturn]] void fail(const char* what, const std::filesystem::path& file, const std::string& why) {
  throw core::DataError(std::string("cannot ") + what + " " + file.string() + ": " + why +
                        "; TMPDIR must be a folder with space that all ranks share");
}

}  // namespace

OpenFile::OpenFile(const std::filesystem::path& file, Access access)
    : name_(file),
      file_(access == Access::read ? ::open(file.c_str(), O_RDONLY | O_CLOEXEC)
                                   : ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600)) {
  if (file_ < 0) fail("open", name_, std::strerror(errno));
}

OpenFile::~OpenFile() {
  if (file_ >= 0) ::close(file_);
}

void OpenFile::finish() {
  if (::close(std::exchange(file_, -1)) != 0) fail("write", name_, std::strerror(errno));
}

void OpenFile::read(void* to, std::size_t bytes, std::size_t place) const {
  for (std::size_t done = 0; done < bytes;) {
    const ssize_t got = ::pread(file_, static_cast<char*>(to) + done, std::min(bytes - done, at_once),
                                static_cast<off_t>(place + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail("read", name_, got < 0 ? std::strerror(errno) : "it is too short");
    done += static_cast<std::size_t>(got);
  }
}

void OpenFile::write(const void* from, std::size_t bytes, std::size_t place) const {
  for (std::size_t done = 0; done < bytes;) {
    const ssize_t put = ::pwrite(file_, static_cast<const char*>(from) + done, std::min(bytes - done, at_once),
                                 static_cast<off_t>(place + done));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) fail("write", name_, std::strerror(errno));
    done += static_cast<std::size_t>(put);
  }
}

}  // namespace thinwall::distributed
