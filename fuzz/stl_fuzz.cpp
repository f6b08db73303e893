// Bytes as STL: built and run by fuzz/run, with the corpus fuzz/corpus/stl.

#include "fuzz/surface_fuzz.hpp"
#include "io/surface/stl.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_surface_bytes(data, size, thinwall::io::stl_surface);
}
