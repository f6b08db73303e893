#include "report/kept_files.hpp"

#include <spdlog/spdlog.h>

#include <atomic>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "io/manifest.hpp"
#include "study/kept/archive.hpp"

namespace thinwall {

namespace io {
template <class Archive>
void serialize(Archive& archive, FileRecord& file) {
  archive(file.name, file.bytes, file.sha256);
}
}  // namespace io

namespace report {

namespace {

namespace fs = std::filesystem;

bool is_as_written(const fs::path& path, const io::FileRecord& file) {
  std::error_code error;
  return fs::file_size(path, error) == file.bytes && !error && io::sha256_of_file(path) == file.sha256;
}

void link_or_copy(const fs::path& from, const fs::path& to) {
  std::error_code no_links;
  fs::create_hard_link(from, to, no_links);
  if (no_links) fs::copy_file(from, to);
}

}  // namespace

bool take_files(const study::Checkpoint& kept, const fs::path& earlier, const fs::path& staging) {
  const std::string* bytes = kept.find("files");
  if (bytes == nullptr) return false;
  std::vector<io::FileRecord> files;
  study::from_bytes(*bytes, files);
  std::atomic<bool> as_written{true};
  core::parallel_for(files.size(), [&](std::size_t i) {
    if (as_written && !is_as_written(earlier / files[i].name, files[i])) as_written = false;
  });
  if (!as_written) return false;
  try {
    fs::create_directories(staging);
    for (const io::FileRecord& file : files) {
      fs::create_directories((staging / file.name).parent_path());
      link_or_copy(earlier / file.name, staging / file.name);
    }
  } catch (const fs::filesystem_error& error) {
    throw core::DataError(std::string("cannot take over files of the earlier run: ") + error.what());
  }
  spdlog::info("files of part, robot and receptances are those of the earlier run: their inputs are the same");
  return true;
}

void keep_files(study::Checkpoint& kept, const fs::path& staging) {
  kept.add("files", study::to_bytes(io::file_records(staging)));
}

report::KeptSections kept_sections(study::Checkpoint& kept) {
  return {[&kept](const std::string& name) { return kept.find("page-" + name); },
          [&kept](const std::string& name, const std::string& text) { kept.add("page-" + name, text); }};
}

}  // namespace report

}  // namespace thinwall
