// Bytes as DMIG and GRID entries: built and run by fuzz/run, with the corpus fuzz/corpus/dmig.

#include "fuzz/matrix_fuzz.hpp"
#include "io/matrices/dmig.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_matrix_bytes(data, size, [](std::string_view bytes) {
    const thinwall::io::DmigFile file = thinwall::io::read_dmig(bytes, "fuzz");
    for (const thinwall::io::DmigMatrix& matrix : file.matrices) thinwall::fuzz::assemble(matrix.labelled);
  });
}
