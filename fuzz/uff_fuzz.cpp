// Bytes as a universal file: nothing but our own errors may leave the reader, and no sanitizer may speak.
//     cmake -S . -B build/fuzz -G Ninja -DTHINWALL_FUZZ=ON -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Release
//     cmake --build build/fuzz --target uff_fuzz
//     build/fuzz/fuzz/uff_fuzz -max_total_time=300 -max_len=20000 -rss_limit_mb=1024 NEW_INPUTS fuzz/corpus/uff
// New inputs go to the first folder; keep the few that matter: uff_fuzz -merge=1 fuzz/corpus/uff NEW_INPUTS

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/error.hpp"
#include "io/frf/one_reference.hpp"
#include "io/frf/uff.hpp"
#include "io/frf/uff_content.hpp"
#include "io/frf/uff_mesh.hpp"
#include "io/frf/uff_shapes.hpp"

namespace {

template <typename Read>
void read(Read reader) {
  try {
    static_cast<void>(reader());
  } catch (const thinwall::core::DataError&) {
  } catch (const thinwall::core::InputError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace thinwall::io;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  read([bytes] { return response_matrix(uff_entries(bytes, "fuzz")); });
  read([bytes] { return reference_column(uff_entries(bytes, "fuzz")); });
  read([bytes] { return nodes_without_place(uff_content(bytes, "fuzz")); });
  read([bytes] { return uff_mesh(bytes, "fuzz"); });
  read([bytes] { return uff_shapes(bytes, "fuzz"); });
  return 0;
}
