#include "case/machining_case.hpp"

#include <algorithm>

#include "setup/imported_part.hpp"

namespace thinwall::cases {

std::vector<DataFile> named_files(const setup::Setup& source) {
  std::vector<DataFile> files;
  std::string section;
  const auto add = [&](const std::filesystem::path& file) {
    if (!file.empty()) files.push_back({file, section, {}});
  };
  const auto add_measured = [&](const std::vector<setup::MeasuredFrf>& all) {
    for (const setup::MeasuredFrf& frf : all) add(frf.file);
  };
  const auto add_arm = [&](const setup::JointedRobot& arm) {
    add(arm.urdf);
    add(arm.joints);
  };
  section = "part";
  if (const auto* matrices = source.part ? std::get_if<setup::MatrixShape>(&source.part->shape) : nullptr) {
    const io::MatrixFiles& of = matrices->files;
    for (const auto& file : {of.stiffness, of.mass, of.damping, io::dof_table_path(of), of.positions}) add(file);
  }
  if (const auto* file = source.part ? setup::shape_file(*source.part) : nullptr) add(file->path);
  add_measured(source.measured_part);
  section = "robot";
  if (source.robot) {
    if (const auto* robot = std::get_if<setup::MeasuredRobot>(&source.robot->model)) add_measured(robot->measured);
    if (const auto* robot = std::get_if<setup::TabledRobot>(&source.robot->model)) {
      if (robot->postures) add(robot->postures->list);
      if (!robot->postures) add(robot->table);
      if (robot->tapped) std::ranges::for_each(robot->tapped->files, add);
      if (robot->mean) add_arm(*robot->mean);
    }
    if (const auto* robot = std::get_if<setup::JointedRobot>(&source.robot->model)) add_arm(*robot);
  }
  section = "contacts";
  for (const setup::SupportContact& contact : source.contacts) {
    if (const auto* tabled = std::get_if<setup::TabledContact>(&contact.model)) add(tabled->table);
    add_measured(setup::measured_assembly(contact));
  }
  section = "tool";
  if (source.tool) add_measured(source.tool->measured);
  if (source.tool && source.tool->swap) add_measured(source.tool->swap->measured);
  section = "observed";
  for (const setup::ObservedCuts& entry : source.observed) add(entry.file);
  section = "damping";
  if (const auto* modal = std::get_if<setup::ModalDamping>(&source.damping); modal != nullptr && modal->from_frf)
    add(modal->from_frf->file);
  return files;
}

std::vector<std::filesystem::path> input_files(const Case& source) {
  std::vector<std::filesystem::path> paths;
  paths.reserve(source.data_files.size());
  for (const DataFile& file : source.data_files) paths.push_back(file.path);
  return paths;
}

}  // namespace thinwall::cases
