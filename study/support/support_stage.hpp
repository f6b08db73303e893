#pragma once
// The components as the coupling sees them, and the part held by the robot.

#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// The axis of [response].
[[nodiscard]] dynamics::FrequencyAxis frequency_axis(const setup::ResponseOptions& options);

/// That axis as far as measured FRFs of part and robot have lines where some are left out (setup/believed_lines.hpp).
[[nodiscard]] dynamics::FrequencyAxis frequency_axis(const setup::ResponseOptions& options,
                                                     const setup::MeasuredPart& part,
                                                     const setup::SupportSetup& support);

/// A component from its matrices: poles (structural damping taken as equivalent viscous) and receptances; with
/// structural damping the receptances come from the matrices directly.
[[nodiscard]] Component component(dynamics::SpatialModel model, const dynamics::FrequencyAxis& axis);

/// The robot in that posture.
[[nodiscard]] Component robot_component(const setup::Robot& robot, const dynamics::FrequencyAxis& axis,
                                        const robot::Posture& posture);

/// The poles of the tip of a robot that carries the tool. Throws InputError if it has none: it is known by receptances
/// alone, or moves without any force.
[[nodiscard]] const dynamics::ModalModel& carrier_modes(const Component& robot);

/// The part from its measured FRFs, less its sensors. Errors as measured_response() and setup::without_sensors().
[[nodiscard]] Component measured_part(const setup::MeasuredPart& source, const dynamics::FrequencyAxis& axis);

/// The contacts as the coupling takes them, without what their stiffness came from.
[[nodiscard]] std::vector<coupling::Contact> contacts_of(const std::vector<setup::JoinedContact>& joined);

/// Options of the receptance route, from [coupling].
[[nodiscard]] coupling::CouplingOptions coupling_options(const setup::CouplingChoice& choice);

/// Modes of a component's matrices, structural damping taken as equivalent viscous. Errors as dynamics::to_modal.
[[nodiscard]] dynamics::ModalModel modes_of(const dynamics::SpatialModel& model);

/// The receptances of part and robot together: by the receptance route, and by the spatial one between the part's DOFs.
struct CoupledResponses {
  dynamics::ResponseModel receptance;
  std::optional<dynamics::ResponseModel> spatial;  ///< none where the part has no matrices or they cannot be joined
};

/// Both routes on the axis of the components' responses, as couple() has them. Errors as coupling::couple().
[[nodiscard]] CoupledResponses coupled_responses(const std::vector<coupling::Contact>& contacts,
                                                 const coupling::CouplingOptions& options, const Component& part,
                                                 const Component& robot);

/// Both routes and their difference. Throws NumericalError if the kernel cannot be solved. With a regularised kernel a
/// spatial model that cannot be assembled, as of rigid directions that depend on each other, is left out with its
/// reason; without one it is an error.
[[nodiscard]] CouplingResult couple(const std::vector<coupling::Contact>& contacts,
                                    const coupling::CouplingOptions& options, const Component& part,
                                    const Component& robot);

/// A mode that a DOF feels: its frequency, and its share φ²/ω² of the static receptance there.
struct Participation {
  double frequency_hz = 0.0;
  double share = 0.0;
};

/// The modes that take part at a DOF by at least a tenth of the largest share, by rising frequency.
[[nodiscard]] std::vector<Participation> participating_modes(const dynamics::ModalModel& model, const std::string& dof);

/// Alone and supported at the participating modes of the part, at every contact direction: the largest |H| near the
/// mode, and |G| at the same frequency.
[[nodiscard]] std::vector<AmplitudeReduction> reductions(const std::vector<coupling::Contact>& contacts,
                                                         const Component& part, const CouplingResult& coupled);

}  // namespace thinwall::study
