#include "study/rehearsal.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "core/time_limit.hpp"
#include "mesh/lagrange_nodes.hpp"
#include "setup/contact_model.hpp"
#include "setup/graded_mesh.hpp"
#include "setup/imported_part.hpp"
#include "setup/part_geometry.hpp"
#include "setup/part_materials.hpp"
#include "setup/robot_tip.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/lobes/stand_in.hpp"
#include "study/part/discretisation.hpp"
#include "study/part/part_stage.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

constexpr int order = 2;

/// The mesh to solve; none of a surface without its first mesh, of a mesh, which would be solved once more for its
/// error, of matrices, and of a part whose elements have a size that is given.
std::optional<mesh::TetMesh> mesh_of(const PartInput& source, const std::shared_ptr<const fem::FirstMesh>& first) {
  const setup::Part& part = *source.part;
  if (first) return first->mesh;
  if (setup::from_file(part) || part.mesh.element_size) return std::nullopt;
  return setup::cut_at_materials(source, setup::graded_mesh(source, 0));
}

/// The set-up, which has a part, without what a forecast does not need.
setup::Setup plain(const setup::Setup& source) {
  setup::Setup result = before_identification(source);
  result.part->mesh.tolerance = 1.0;  // a first mesh may lack percents of a rounded part's mass
  result.updating.clear();
  result.path.reset();
  result.modes = {};
  result.reduction.tolerance.reset();
  result.reduction.check_frequencies = 0;
  result.response.lines = 2;
  return result;
}

/// The modes of part and robot together; none if there are none, or if the two cannot be coupled before a run has
/// looked at their joint.
std::optional<dynamics::ModalModel> supported_modes(const setup::Setup& source, const Component& part,
                                                    const dynamics::FrequencyAxis& axis) {
  if (!source.robot || source.contacts.empty() || setup::is_measured(*source.robot)) return std::nullopt;
  try {
    const Component robot = robot_component(*source.robot, axis, setup::robot_posture(source, source).posture);
    const auto contacts = contacts_of(setup::joined_contacts(source, source, {}));
    return couple(contacts, coupling_options(source.coupling), part, robot).modal;
  } catch (const core::Interrupted&) {
    throw;
  } catch (const core::Error&) {
    return std::nullopt;
  }
}

std::optional<StandInModes> rehearsed(const setup::Setup& source, mesh::TetMesh mesh) {
  Stages silent;
  const PartResult finite_elements = compute_part(part_input(source), {std::move(mesh), order, {}, {}}, silent);
  if (!finite_elements.damped) return std::nullopt;
  setup::CutSetup cut = source;
  if (!cut.lobes->modes_up_to_hz)
    cut.lobes->modes_up_to_hz = usual_modes_up_to_hz(finite_elements.reduced->fixed_interface_hz);
  const dynamics::FrequencyAxis axis = frequency_axis(source.response);
  const Component part = component(*finite_elements.damped, axis);
  if (!part.modal) return std::nullopt;
  StandInModes result{part_structure(cut, *part.modal), {}};
  if (const auto supported = supported_modes(source, part, axis)) result.supported = part_structure(cut, *supported);
  return result;
}

}  // namespace

std::optional<StandInModes> rehearsed_modes(const setup::Setup& source,
                                            const std::shared_ptr<const fem::FirstMesh>& first, double limit_s) {
  constexpr int most_dofs = 60'000;
  if (!source.part || !source.lobes || !source.cutting || !source.tool) return std::nullopt;
  const core::Silence forecast_only;
  try {
    const core::TimeLimit limit(limit_s);
    const setup::Setup simple = plain(source);
    std::optional<mesh::TetMesh> mesh = mesh_of(part_input(simple), first);
    if (!mesh || 3 * mesh::lagrange_node_count(*mesh, order) > most_dofs) return std::nullopt;
    return rehearsed(simple, std::move(*mesh));
  } catch (const core::Interrupted&) {
    throw;
  } catch (const core::Error&) {
    return std::nullopt;
  } catch (const core::TimeIsOver&) {
    return std::nullopt;
  }
}

}  // namespace thinwall::study
