// Bytes as Gmsh: built and run by fuzz/run, with the corpus fuzz/corpus/gmsh.

#include "fuzz/mesh_fuzz.hpp"
#include "io/mesh/gmsh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_mesh_bytes(data, size, thinwall::io::gmsh_mesh);
}
