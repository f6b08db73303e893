#include "setup/data_files.hpp"

#include <algorithm>
#include <memory>
#include <set>
#include <string>

#include "core/messages.hpp"
#include "setup/contact_model.hpp"
#include "setup/imported_part.hpp"
#include "setup/measured.hpp"
#include "setup/robot_tip.hpp"

namespace thinwall::setup {

namespace {

/// Pointers to the FRFs of a set-up, which is constant or not.
template <class Frf, class Source>
std::vector<Frf*> all_frfs(Source& source) {
  std::vector<Frf*> all;
  const auto add = [&all](auto& files) {
    for (auto& file : files) all.push_back(&file);
  };
  add(source.measured_part);
  if (source.damping.from_frf) all.push_back(&*source.damping.from_frf);
  for (auto& contact : source.contacts) add(contact.measured);
  if (source.robot) add(source.robot->measured);
  if (source.tool) add(source.tool->measured);
  if (source.tool && source.tool->swap) add(source.tool->swap->measured);
  return all;
}

}  // namespace

std::vector<MeasuredFrf*> measured_frfs(Setup& source) {
  return all_frfs<MeasuredFrf>(source);
}

std::vector<const MeasuredFrf*> measured_frfs(const Setup& source) {
  return all_frfs<const MeasuredFrf>(source);
}

void read_data_files(Setup& source) {
  FrfFiles files;
  for (MeasuredFrf* frf : measured_frfs(source)) {
    if (!frf->content) frf->content = std::make_shared<const FrfContent>(read_measured(*frf, files));
  }
  for (Contact& contact : source.contacts) {
    if (contact.model == ContactModel::table && !contact.rows)
      contact.rows = std::make_shared<const coupling::ContactTable>(read_contact_table(contact.table));
  }
  if (source.robot && source.robot->model == RobotModel::modal_table && !source.robot->table_modes)
    source.robot->table_modes = std::make_shared<const dynamics::ModalTable>(read_table_of_modes(*source.robot));
  if (source.part && from_file(*source.part) && !source.part->imported)
    source.part->imported = read_part_file(*source.part);
}

void share_data_files(Setup& varied, const Setup& read) {
  const std::vector<MeasuredFrf*> to = measured_frfs(varied);
  const std::vector<const MeasuredFrf*> from = measured_frfs(read);
  for (std::size_t i = 0; i < std::min(to.size(), from.size()); ++i) to[i]->content = from[i]->content;
  for (std::size_t i = 0; i < std::min(varied.contacts.size(), read.contacts.size()); ++i)
    varied.contacts[i].rows = read.contacts[i].rows;
  if (varied.robot && read.robot) varied.robot->table_modes = read.robot->table_modes;
  if (varied.part && read.part) varied.part->imported = read.part->imported;
}

void tell_of_data_files(const Setup& source) {
  std::set<std::string> told;  // a file of several FRFs is told of once
  for (const MeasuredFrf* frf : measured_frfs(source)) {
    if (!frf->content) continue;
    for (const std::string& note : frf->content->notes)
      if (told.insert(note).second) core::inform(note);
    for (const std::string& warning : frf->content->warnings)
      if (told.insert(warning).second) core::warn(warning);
  }
}

}  // namespace thinwall::setup
