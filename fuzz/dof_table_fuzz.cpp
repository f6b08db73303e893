// Bytes as a table of DOFs and as one of positions: built and run by fuzz/run, with the corpus fuzz/corpus/dof_table.

#include "fuzz/file_fuzz.hpp"
#include "io/matrices/dof_table_csv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const thinwall::fuzz::BytesAsFile file(data, size);
  thinwall::fuzz::read_path(file.path(), [](const std::filesystem::path& path) {
    const thinwall::io::DofTableFile table = thinwall::io::read_dof_table(path);
    for (const auto& dof : table.dofs)
      if (dof.component < 0 || dof.component > 6) std::abort();
    for (const auto& [node, position] : table.positions_m)
      if (!position.allFinite()) std::abort();
  });
  thinwall::fuzz::read_path(file.path(), [](const std::filesystem::path& path) {
    for (const auto& [node, position] : thinwall::io::read_node_positions(path))
      if (!position.allFinite()) std::abort();
  });
  return 0;
}
