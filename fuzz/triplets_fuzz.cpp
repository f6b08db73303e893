// Bytes as lines of row, column, value: built and run by fuzz/run, with the corpus fuzz/corpus/triplets.

#include "fuzz/matrix_fuzz.hpp"
#include "io/matrices/matrix_triplets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_matrix_bytes(data, size, [](std::string_view bytes) {
    thinwall::fuzz::assemble(thinwall::io::triplet_entries(bytes, "fuzz"));
  });
}
