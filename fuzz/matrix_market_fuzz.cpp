// Bytes as Matrix Market: built and run by fuzz/run, with the corpus fuzz/corpus/matrix_market.

#include "fuzz/matrix_fuzz.hpp"
#include "io/matrices/matrix_market.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_matrix_bytes(data, size, [](std::string_view bytes) {
    thinwall::fuzz::assemble(thinwall::io::matrix_market_entries(bytes, "fuzz"));
  });
}
