// Bytes as a MAT file of version 4: built and run by fuzz/run, with the corpus fuzz/corpus/mat4.

#include "fuzz/matrix_fuzz.hpp"
#include "io/matrices/mat4.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return thinwall::fuzz::read_matrix_bytes(data, size, [](std::string_view bytes) {
    for (const auto& [name, variable] : thinwall::io::mat4_variables(bytes, {"K", "M", "dof_node"}, "fuzz")) {
      const std::size_t count = variable.size[0] * variable.size[1];
      if (!variable.is_sparse && variable.re.size() != count) std::abort();
      if (!variable.im.empty() && variable.im.size() != count) std::abort();
    }
  });
}
