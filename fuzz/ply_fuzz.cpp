// Bytes as PLY: built and run by fuzz/run, with the corpus fuzz/corpus/ply.

#include "fuzz/surface_fuzz.hpp"
#include "io/surface/ply.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_surface_bytes(data, size, thinwall::io::ply_surface);
}
