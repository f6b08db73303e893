// Bytes as a .dof file: built and run by fuzz/run, with the corpus fuzz/corpus/ccx_dof.

#include "fuzz/matrix_fuzz.hpp"
#include "io/matrices/matrix_triplets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_matrix_bytes(
      data, size, [](std::string_view bytes) { static_cast<void>(thinwall::io::ccx_dofs(bytes, "fuzz")); });
}
