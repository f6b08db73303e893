// Bytes as each of the tables of responses, modes and results: built and run by fuzz/run, with the corpus
// fuzz/corpus/csv.

#include "fuzz/file_fuzz.hpp"
#include "io/frf/frf_csv.hpp"
#include "io/frf/frf_cutpro.hpp"
#include "io/frf/frf_lvm.hpp"
#include "io/frf/modal_table_csv.hpp"
#include "io/frf/response_csv.hpp"
#include "io/results/csv_table.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace thinwall;
  using Path = std::filesystem::path;
  const fuzz::BytesAsFile file(data, size);
  const Path path = file.path();
  const io::FrfFormat mobility{io::FrfQuantity::mobility, 1e-3, 1.0};
  fuzz::read_path(path, [](const Path& bytes) { static_cast<void>(io::read_csv(bytes)); });
  fuzz::read_path(path, [](const Path& bytes) { static_cast<void>(io::read_response(bytes)); });
  fuzz::read_path(path, [](const Path& bytes) { static_cast<void>(io::read_cutpro_frf(bytes)); });
  fuzz::read_path(path, [&mobility](const Path& bytes) { static_cast<void>(io::read_lvm_frf(bytes, mobility)); });
  fuzz::read_path(path, [](const Path& bytes) { static_cast<void>(io::read_modal_table(bytes, {1e-7, 1.0, {}})); });
  fuzz::read_path(path, [&mobility](const Path& bytes) {
    if (!io::read_frf(bytes, mobility).H.allFinite()) std::abort();
  });
  fuzz::read_path(path, [](const Path& bytes) {
    io::MeasuredFrf frf;
    frf.axis.hz = Eigen::Vector2d(1.0, 2.0);
    io::add_coherence(frf, bytes, 1.0);
  });
  return 0;
}
