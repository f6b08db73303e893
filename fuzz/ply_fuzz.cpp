// Bytes as PLY: built and run as fuzz/uff_fuzz.cpp says, with the corpus fuzz/corpus/ply.

#include "io/ply.hpp"
#include "fuzz/surface_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_surface_bytes(data, size, thinwall::io::ply_surface);
}
