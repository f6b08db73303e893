// Bytes as lines of two nodes and components and a value: built and run by fuzz/run, with the corpus
// fuzz/corpus/abaqus_matrix.

#include "fuzz/matrix_fuzz.hpp"
#include "io/matrices/matrix_triplets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_matrix_bytes(data, size, [](std::string_view bytes) {
    static_cast<void>(thinwall::io::fields_of_first_line(bytes));
    thinwall::fuzz::assemble(thinwall::io::labelled_triplets(bytes, "fuzz"));
  });
}
