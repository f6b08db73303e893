#pragma once
// Bytes as a file, for readers that take a path: nothing but our own errors may leave them.

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/error.hpp"

namespace thinwall::fuzz {

/// A file in memory that holds the bytes, for as long as this object lives.
class BytesAsFile {
 public:
  BytesAsFile(const std::uint8_t* data, std::size_t size) : descriptor_(memfd_create("fuzz", MFD_CLOEXEC)) {
    if (descriptor_ < 0 || write(descriptor_, data, size) != static_cast<ssize_t>(size)) std::abort();
  }
  BytesAsFile(const BytesAsFile&) = delete;
  BytesAsFile& operator=(const BytesAsFile&) = delete;
  ~BytesAsFile() { close(descriptor_); }

  [[nodiscard]] std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

/// Calls `read(path)`; a DataError refuses the bytes, anything else that is thrown is a fault.
template <class Read>
void read_path(const std::filesystem::path& path, Read read) {
  try {
    read(path);
  } catch (const core::DataError&) {
    return;
  }
}

}  // namespace thinwall::fuzz
