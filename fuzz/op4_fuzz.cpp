// Bytes as matrices of Nastran's OUTPUT4: built and run by fuzz/run, with the corpus fuzz/corpus/op4.

#include "fuzz/matrix_fuzz.hpp"
#include "io/matrices/op4.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_matrix_bytes(data, size, [](std::string_view bytes) {
    const std::vector<thinwall::io::NastranMatrix> matrices = thinwall::io::read_op4(bytes, "fuzz");
    for (const thinwall::io::NastranMatrix& matrix : matrices)
      if (!matrix.entries.empty()) thinwall::fuzz::assemble({"fuzz", matrix.rows, matrix.entries, matrix.form == 6});
  });
}
