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
  if (auto* modal = std::get_if<ModalDamping>(&source.damping); modal != nullptr && modal->from_frf)
    modal->from_frf->sha256 = checksum(modal->from_frf->file);
  for (Contact& contact : source.contacts) {
    if (auto* springs = std::get_if<SpringContact>(&contact.model)) stamp(springs->measured);
    if (auto* tabled = std::get_if<TabledContact>(&contact.model)) tabled->table_sha256 = checksum(tabled->table);
  }
  if (source.robot) {
    if (auto* robot = std::get_if<MeasuredRobot>(&source.robot->model)) stamp(robot->measured);
    if (auto* robot = std::get_if<TabledRobot>(&source.robot->model)) robot->table_sha256 = checksum(robot->table);
  }
  if (!source.tool) return;
  stamp(source.tool->measured);
  if (source.tool->swap) stamp(source.tool->swap->measured);
}

}  // namespace thinwall::setup
