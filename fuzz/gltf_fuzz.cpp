// Bytes as glTF, binary or text: built and run by fuzz/run, with the corpus fuzz/corpus/gltf.

#include "fuzz/surface_fuzz.hpp"
#include "io/surface/gltf.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_surface_bytes(data, size, [](std::string_view bytes, const std::string& name, double) {
    return thinwall::io::gltf_surface(bytes, name).soup;
  });
}
