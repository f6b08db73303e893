#pragma once
// An identifier of the running program.

#include <string>

namespace thinwall::io {

/// The linker's build ID of the running program (a hash of its contents; man ld, --build-id) in hexadecimal digits;
/// without a build ID the SHA-256 of its file, which takes 30 ms.
[[nodiscard]] const std::string& program_id();

}  // namespace thinwall::io
