// Bytes as a superelement in NetCDF: built and run by fuzz/run, with the corpus fuzz/corpus/superelement.

#include "fuzz/matrix_fuzz.hpp"
#include "io/matrices/superelement.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_matrix_bytes(
      data, size, [](std::string_view bytes) { (void)thinwall::io::read_superelement(bytes, "fuzz"); });
}
