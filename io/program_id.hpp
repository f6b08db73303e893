#pragma once
// Which program this is, to the last instruction.

#include <string>

namespace thinwall::io {

/// The linker's build ID of the running program (a hash of what it holds; man ld, --build-id), in hexadecimal digits;
/// without one the SHA-256 of its file, which takes 30 ms.
[[nodiscard]] const std::string& program_id();

}  // namespace thinwall::io
