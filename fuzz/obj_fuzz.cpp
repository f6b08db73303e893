// Bytes as OBJ: built and run by fuzz/run, with the corpus fuzz/corpus/obj.

#include "fuzz/surface_fuzz.hpp"
#include "io/surface/obj.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_surface_bytes(data, size, thinwall::io::obj_surface);
}
