// Bytes as 3MF, and as the model of one: built and run by fuzz/run, with the corpus fuzz/corpus/three_mf.

#include "fuzz/surface_fuzz.hpp"
#include "io/surface/three_mf.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_surface_bytes(data, size, [](std::string_view bytes, const std::string& name, double) {
    return thinwall::io::three_mf_surface(bytes, name).soup;
  });
}
