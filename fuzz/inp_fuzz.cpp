// Bytes as an input file of Abaqus: built and run by fuzz/run, with the corpus fuzz/corpus/inp.

#include "fuzz/mesh_fuzz.hpp"
#include "io/mesh/inp.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_mesh_bytes(data, size, [](std::string_view bytes, const char* name, double metres) {
    return thinwall::io::inp_mesh(bytes, name, metres).mesh;
  });
}
