// Bytes as VTU: built and run by fuzz/run, with the corpus fuzz/corpus/vtu.

#include "fuzz/mesh_fuzz.hpp"
#include "io/mesh/vtu_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_mesh_bytes(data, size, thinwall::io::vtu_mesh);
}
