// Bytes as an input file of Abaqus: built and run by fuzz/run, with the corpus fuzz/corpus/inp. What follows the first
// byte 0 is the content of every file that is included.

#include <algorithm>

#include "fuzz/mesh_fuzz.hpp"
#include "io/mesh/inp.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_mesh_bytes(data, size, [](std::string_view bytes, const char* name, double metres) {
    const std::size_t end = std::min(bytes.find('\0'), bytes.size());
    const std::string_view included = bytes.substr(std::min(end + 1, bytes.size()));
    return thinwall::io::inp_mesh(bytes.substr(0, end), name, metres,
                                  [&](const auto& /*path*/) { return std::string(included); })
        .mesh;
  });
}
