#include "setup/file_stamps.hpp"

#include "core/error.hpp"
#include "io/manifest.hpp"

namespace thinwall::setup {

namespace {

std::string checksum(const std::filesystem::path& file) {
  if (file.empty()) return "";
  try {
    return io::sha256_of_file(file);
  } catch (const core::Error&) {
    return "";
  }
}

void stamp(std::vector<MeasuredFrf>& files) {
  for (MeasuredFrf& frf : files) frf.sha256 = checksum(frf.file);
}

}  // namespace

void stamp_files(Setup& source) {
  stamp(source.measured_part);
  if (source.damping.from_frf) source.damping.from_frf->sha256 = checksum(source.damping.from_frf->file);
  for (Contact& contact : source.contacts) {
    stamp(contact.measured);
    contact.table_sha256 = checksum(contact.table);
  }
  if (source.robot) {
    stamp(source.robot->measured);
    source.robot->table_sha256 = checksum(source.robot->table);
  }
  if (!source.tool) return;
  stamp(source.tool->measured);
  if (source.tool->swap) stamp(source.tool->swap->measured);
}

}  // namespace thinwall::setup
