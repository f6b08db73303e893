#include "study/support/support_stage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "setup/believed_lines.hpp"
#include "setup/contact_model.hpp"
#include "setup/measured.hpp"
#include "setup/sensor_mass.hpp"

namespace thinwall::study {

namespace {

/// Names of a contact's directed DOFs on the part, "P.x".
std::vector<std::string> contact_dofs(const std::vector<coupling::Contact>& contacts) {
  std::vector<std::string> names;
  for (const coupling::Contact& c : contacts) {
    for (const coupling::ContactSpring& spring : c.springs)
      names.push_back(dynamics::name({c.point_a, spring.direction, dynamics::DofKind::translation}));
  }
  return names;
}

bool has_dof(const dynamics::DofTable& dofs, const std::string& name) {
  return std::any_of(dofs.begin(), dofs.end(), [&](const dynamics::Dof& d) { return dynamics::name(d) == name; });
}

/// Only the part's rows and columns of a coupled response.
dynamics::ResponseModel part_block(const dynamics::ResponseModel& all, const dynamics::ResponseModel& part) {
  dynamics::ResponseModel block;
  block.axis = all.axis;
  block.responses = part.responses;
  block.forces = part.forces;
  const auto n = static_cast<Eigen::Index>(part.responses.size());
  for (const auto& H : all.H) block.H.emplace_back(H.topLeftCorner(n, n));
  return block;
}

/// Peaks of a measured curve; none is an answer here.
std::vector<reduction::IdentifiedMode> identified_peaks(const dynamics::FrequencyAxis& axis,
                                                        const Eigen::VectorXcd& H) {
  try {
    return reduction::identify_modes(axis, H);
  } catch (const core::InputError&) {
    return {};
  }
}

double peak_near(const dynamics::FrequencyAxis& axis, const Eigen::VectorXcd& H, double hz, Eigen::Index& line) {
  double largest = -1.0;
  for (Eigen::Index i = 0; i < axis.size(); ++i) {
    if (std::abs(axis.hz(i) - hz) > 0.02 * hz || std::abs(H(i)) <= largest) continue;
    largest = std::abs(H(i));
    line = i;
  }
  return largest;
}

/// As far as matrices are known: the coupled model with its modes and response, or the part's response alone.
void add_spatial_route(const Component& part, const Component& robot, const std::vector<coupling::Contact>& contacts,
                       const dynamics::FrequencyAxis& axis, CouplingResult& result) {
  if (part.spatial && robot.spatial) {
    result.model = coupling::couple(*part.spatial, *robot.spatial, contacts);
    result.modal = modes_of(*result.model);
    result.spatial_response = part_block(dynamics::direct_response(*result.model, axis), part.response);
  } else if (part.spatial) {
    result.spatial_response = coupling::direct_response(*part.spatial, robot.response, contacts, axis);
  }
}

}  // namespace

dynamics::FrequencyAxis frequency_axis(const setup::ResponseOptions& r) {
  return r.logarithmic ? dynamics::logarithmic_axis(r.from_hz, r.to_hz, r.lines)
                       : dynamics::linear_axis(r.from_hz, r.to_hz, r.lines);
}

dynamics::FrequencyAxis frequency_axis(const setup::ResponseOptions& options, const setup::MeasuredPart& part,
                                       const setup::SupportSetup& support) {
  const dynamics::FrequencyAxis axis = setup::within_lines_of(part.measured_part, frequency_axis(options));
  const auto* robot = support.robot ? std::get_if<setup::MeasuredRobot>(&support.robot->model) : nullptr;
  return robot != nullptr ? setup::within_lines_of(robot->measured, axis) : axis;
}

Component component(dynamics::SpatialModel model, const dynamics::FrequencyAxis& axis) {
  Component result;
  if (dynamics::undamped_modes(model).omega_rad_s.minCoeff() < 1e-3 * axis.omega_rad_s(0)) {
    // A rigid-body motion has no decaying pole pair.
    result.response = dynamics::direct_response(model, axis);
    result.spatial = std::move(model);
    return result;
  }
  result.modal = modes_of(model);
  result.response = model.has_structural_damping() ? dynamics::direct_response(model, axis)
                                                   : dynamics::to_response(*result.modal, axis);
  result.spatial = std::move(model);
  return result;
}

Component robot_component(const setup::Robot& robot, const dynamics::FrequencyAxis& axis,
                          const robot::Posture& posture) {
  robot::Tip tip = setup::tip_model(robot, axis)(posture);
  if (auto* spatial = std::get_if<dynamics::SpatialModel>(&tip)) return component(std::move(*spatial), axis);
  Component result;
  if (auto* modal = std::get_if<dynamics::ModalModel>(&tip)) {
    result.response = dynamics::to_response(*modal, axis);
    result.modal = std::move(*modal);
    return result;
  }
  result.response = std::get<dynamics::ResponseModel>(std::move(tip));
  return result;
}

const dynamics::ModalModel& carrier_modes(const Component& robot) {
  if (robot.modal) return *robot.modal;
  throw core::InputError(robot.spatial ? "the robot that carries the tool moves without any force; give its joints a "
                                         "stiffness"
                                       : "the robot that carries the tool is known by receptances alone; give them as "
                                         "tool.measured, for they are those of the tool's tip, and leave [robot] out");
}

Component measured_part(const setup::MeasuredPart& source, const dynamics::FrequencyAxis& axis) {
  Component part;
  part.response =
      setup::without_sensors(setup::measured_response(source.measured_part, axis), source.part_sensors, "the part's");
  return part;
}

std::vector<coupling::Contact> contacts_of(const std::vector<setup::JoinedContact>& joined) {
  std::vector<coupling::Contact> contacts;
  contacts.reserve(joined.size());
  for (const setup::JoinedContact& one : joined) contacts.push_back(one.contact);
  return contacts;
}

coupling::CouplingOptions coupling_options(const setup::CouplingChoice& choice) {
  coupling::CouplingOptions options;
  options.regularisation = choice.regularisation;
  options.threshold = choice.threshold;
  return options;
}

dynamics::ModalModel modes_of(const dynamics::SpatialModel& model) {
  return dynamics::to_modal(model.has_structural_damping() ? dynamics::equivalent_viscous(model) : model);
}

CoupledResponses coupled_responses(const std::vector<coupling::Contact>& contacts,
                                   const coupling::CouplingOptions& options, const Component& part,
                                   const Component& robot) {
  CoupledResponses both{coupling::couple(part.response, robot.response, contacts, options).response, {}};
  CouplingResult spatial;
  try {
    add_spatial_route(part, robot, contacts, part.response.axis, spatial);
  } catch (const core::InputError&) {
    return both;  // couple() tells why
  }
  both.spatial = std::move(spatial.spatial_response);
  return both;
}

CouplingResult couple(const std::vector<coupling::Contact>& contacts, const coupling::CouplingOptions& options,
                      const Component& part, const Component& robot) {
  const dynamics::FrequencyAxis& axis = part.response.axis;
  CouplingResult result{coupling::couple(part.response, robot.response, contacts, options), {}, {}, {}, {}, {}, {}};
  try {
    add_spatial_route(part, robot, contacts, axis, result);
  } catch (const core::InputError& error) {
    if (options.regularisation == coupling::Regularisation::none) throw;
    result.model.reset();
    result.no_spatial_route = error.what();
  }
  if (result.spatial_response) {
    const std::string& point = contacts.front().point_a;
    result.difference = coupling::route_difference(*result.spatial_response,
                                                   part_block(result.receptance.response, part.response), point, point);
  }
  const std::string dof = contact_dofs(contacts).front();
  if (!result.modal && has_dof(part.response.responses, dof)) {
    result.identified = identified_peaks(axis, dynamics::entry(result.receptance.response, dof, dof));
  }
  return result;
}

std::vector<Participation> participating_modes(const dynamics::ModalModel& model, const std::string& dof) {
  const int row = dynamics::row_of(model.dofs, dof);
  std::vector<Participation> all;
  double largest = 0.0;
  for (const int k : dynamics::oscillating_modes(model)) {
    const double omega = std::abs(model.poles(k));
    const double share = 2.0 * std::abs(model.right(row, k) * model.left(row, k) / model.scaling(k)) / omega;
    all.push_back({omega / (2.0 * std::numbers::pi), share});
    largest = std::max(largest, share);
  }
  std::erase_if(all, [&](const Participation& p) { return p.share < 0.1 * largest; });
  return all;
}

std::vector<AmplitudeReduction> reductions(const std::vector<coupling::Contact>& contacts, const Component& part,
                                           const CouplingResult& coupled) {
  std::vector<AmplitudeReduction> result;
  const dynamics::FrequencyAxis& axis = part.response.axis;
  for (const std::string& dof : contact_dofs(contacts)) {
    if (!has_dof(part.response.responses, dof)) continue;
    const Eigen::VectorXcd H = dynamics::entry(part.response, dof, dof);
    const Eigen::VectorXcd G = dynamics::entry(coupled.receptance.response, dof, dof);
    std::vector<double> resonances;
    if (part.modal) {
      for (const auto& mode : participating_modes(*part.modal, dof)) resonances.push_back(mode.frequency_hz);
    } else {
      for (const auto& mode : identified_peaks(axis, H)) resonances.push_back(mode.frequency_hz);
    }
    for (const double hz : resonances) {
      Eigen::Index line = 0;
      const double alone = peak_near(axis, H, hz, line);
      if (alone > 0.0) result.push_back({dof, axis.hz(line), alone, std::abs(G(line))});
    }
  }
  return result;
}

}  // namespace thinwall::study
