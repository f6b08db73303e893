#include "setup/data_files.hpp"

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "core/messages.hpp"
#include "setup/believed_lines.hpp"
#include "setup/contact_model.hpp"
#include "setup/imported_part.hpp"
#include "setup/measured.hpp"
#include "setup/observed.hpp"
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
  if (auto* modal = std::get_if<ModalDamping>(&source.damping); modal != nullptr && modal->from_frf)
    all.push_back(&*modal->from_frf);
  for (auto& contact : source.contacts) {
    if (auto* springs = std::get_if<SpringContact>(&contact.model)) add(springs->measured);
  }
  if (source.robot) {
    if (auto* robot = std::get_if<MeasuredRobot>(&source.robot->model)) add(robot->measured);
  }
  if (source.tool) add(source.tool->measured);
  if (source.tool && source.tool->swap) add(source.tool->swap->measured);
  return all;
}

/// True for an FRF of the tool or the robot, which stand on something; a part may hang freely.
bool is_of_held_structure(const Setup& source, const MeasuredFrf* frf) {
  const auto among = [frf](const std::vector<MeasuredFrf>& files) {
    return std::ranges::any_of(files, [frf](const MeasuredFrf& file) { return &file == frf; });
  };
  if (source.tool && (among(source.tool->measured) || (source.tool->swap && among(source.tool->swap->measured))))
    return true;
  const auto* robot = source.robot ? std::get_if<MeasuredRobot>(&source.robot->model) : nullptr;
  return robot != nullptr && among(robot->measured);
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
    if (frf->content) continue;
    frf->content = std::make_shared<const FrfContent>(
        with_believed_lines(read_measured(*frf, files), *frf, is_of_held_structure(source, frf)));
  }
  if (source.tool) take_common_band(source.tool->measured);
  if (source.tool && source.tool->swap) take_common_band(source.tool->swap->measured);
  for (SupportContact& contact : source.contacts) {
    if (auto* tabled = std::get_if<TabledContact>(&contact.model); tabled != nullptr && !tabled->rows)
      tabled->rows = std::make_shared<const coupling::ContactTable>(read_contact_table(tabled->table));
  }
  if (auto* robot = tabled_robot(source.robot); robot != nullptr && !robot->table_modes && !robot->tapped)
    read_table_of_modes(*robot);
  for (ObservedCuts& entry : source.observed) {
    if (!entry.file.empty() && entry.cuts.empty()) entry.cuts = read_observed_cuts(entry.file);
  }
  if (source.part && from_file(*source.part) && !source.part->imported)
    source.part->imported = read_part_file(*source.part);
}

void share_data_files(Setup& varied, const Setup& read) {
  const std::vector<MeasuredFrf*> to = measured_frfs(varied);
  const std::vector<const MeasuredFrf*> from = measured_frfs(read);
  for (std::size_t i = 0; i < std::min(to.size(), from.size()); ++i) to[i]->content = from[i]->content;
  for (std::size_t i = 0; i < std::min(varied.contacts.size(), read.contacts.size()); ++i) {
    auto* tabled = std::get_if<TabledContact>(&varied.contacts[i].model);
    const auto* with_rows = std::get_if<TabledContact>(&read.contacts[i].model);
    if (tabled != nullptr && with_rows != nullptr) tabled->rows = with_rows->rows;
  }
  auto* robot = tabled_robot(varied.robot);
  const auto* with_modes = tabled_robot(read.robot);
  if (robot != nullptr && with_modes != nullptr) {
    robot->tapped = with_modes->tapped;
    if (!robot->postures) robot->table_modes = with_modes->table_modes;
  }
  for (std::size_t i = 0; i < std::min(varied.observed.size(), read.observed.size()); ++i) {
    if (!varied.observed[i].file.empty()) varied.observed[i].cuts = read.observed[i].cuts;
  }
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
