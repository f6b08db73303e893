#include "study/simulation/felt_structures.hpp"

#include <string>
#include <utility>

#include "core/error.hpp"
#include "setup/contact_model.hpp"
#include "setup/simulation_faults.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/results.hpp"
#include "study/support/contact_force.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

milling::RelativeStructure poles_of(const setup::Setup& setup, const dynamics::ModalModel* part,
                                    const dynamics::ModalModel* carrier = nullptr) {
  auto poles = cut_poles(setup, part, carrier);
  if (!poles)
    throw core::InputError("simulation: nothing moves; give a part, tool.modes, or a robot that carries the tool");
  return std::move(*poles);
}

const dynamics::ModalModel& modal(const std::optional<dynamics::ModalModel>& model, const char* what) {
  if (!model)
    throw core::InputError(std::string("simulation: ") + what +
                           " is known by measured receptances alone, and a simulation needs poles; give it by a model");
  return *model;
}

/// The contact of the robot that may open (setup::fault_of_opening()). The pair of forces pushes the tip along the
/// direction in which the part presses it, and the part against it.
milling::OneSidedContact one_sided_contact(const setup::Setup& setup, const Results& results,
                                           const dynamics::ModalModel& model, Eigen::Index poles) {
  const coupling::ContactSpring& spring = results.contacts.front().contact.springs.front();
  const Eigen::Vector3d normal = pressing_force(setup).second;
  const dynamics::ModalModel kept = kept_modes(setup, model);
  const Eigen::Index of_part = milling::relative_structure(kept, setup.cutting->at).poles.size();
  const setup::SupportContact& contact = setup.contacts.front();
  return {
      milling::force_pair(kept, setup.cutting->at, contact.robot_point, contact.part_point, normal, poles - of_part),
      spring.stiffness, spring.damping, *setup::preload_of(setup, contact)};
}

FeltStructure felt_structure(const setup::Setup& setup, const Results& results, ChartOf of) {
  if (of == ChartOf::supported) {
    const dynamics::ModalModel& model = modal(results.coupled->modal, "the supported part");
    FeltStructure felt{of, poles_of(setup, &model), {}};
    if (setup.simulation->support == setup::SupportSides::one_sided)
      felt.contact = one_sided_contact(setup, results, model, felt.structure.poles.size());
    return felt;
  }
  const bool with_part = of == ChartOf::part || (of == ChartOf::carried && results.part);
  return {of,
          poles_of(setup, with_part ? &modal(results.part->modal, "the part") : nullptr,
                   of == ChartOf::carried ? &carrier_modes(*results.robot) : nullptr),
          {}};
}

}  // namespace

std::vector<FeltStructure> felt_structures(const setup::Setup& setup, const Results& results) {
  std::vector<FeltStructure> felt;
  for (const ChartOf of : setup::simulated_structures(setup)) felt.push_back(felt_structure(setup, results, of));
  return felt;
}

}  // namespace thinwall::study
