// Bytes as PLY: built and run as fuzz/uff_fuzz.cpp says, with the corpus fuzz/corpus/ply.

#include "fuzz/surface_fuzz.hpp"
#include "io/ply.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_surface_bytes(data, size, thinwall::io::ply_surface);
}
