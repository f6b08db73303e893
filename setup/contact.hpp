#pragma once
// Places where the robot touches the part, and the sources of their stiffness.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/words.hpp"
#include "coupling/contact.hpp"
#include "coupling/contact_table.hpp"
#include "coupling/hertz_contact.hpp"
#include "coupling/kernel.hpp"
#include "setup/measured_frf.hpp"

namespace thinwall::setup {

/// Kinds of damping that are sought in FRFs of the assembly.
enum class DampingSought { viscous, structural, both };

/// The ball by which a robot touches.
struct ContactBall {
  double radius = 0.0;        ///< m
  coupling::Elastic steel{};  ///< of all balls, and of a caster's cup
};

/// A contact whose stiffness is given, or sought in FRFs of the assembly.
struct SpringContact {
  std::vector<double> stiffness;        ///< N/m, one per direction; infinite allowed
  std::vector<double> damping;          ///< N s/m, one per direction
  std::vector<MeasuredFrf> measured{};  ///< of the assembly, from which the joint is found
  DampingSought damping_sought = DampingSought::viscous;
  std::vector<double> noise{};  ///< relative: of the assembly, of the part, of the robot
};

/// A contact with a measured table over the preload.
struct TabledContact {
  std::optional<double> preload{};  ///< N; none: from robot.preload
  std::filesystem::path table{};
  std::shared_ptr<const coupling::ContactTable> rows = {};  ///< of the table, once it is read
};

/// A ball that is pressed onto the part.
struct BallContact {
  std::optional<double> preload{};  ///< N; none: from robot.preload
  std::vector<double> damping;      ///< N s/m, one per direction
  ContactBall ball;
  std::optional<coupling::Elastic> surface{};  ///< that the ball touches; none: part.material
};

/// A ball that is pressed onto the part and borne by smaller balls in a cup.
struct CasterContact {
  std::optional<double> preload{};  ///< N; none: from robot.preload
  std::vector<double> damping;      ///< N s/m, one per direction
  ContactBall ball;
  std::optional<coupling::Elastic> surface{};  ///< that the ball touches; none: part.material
  int supports = 0;                            ///< balls that carry the main ball
  double support_radius = 0.0;                 ///< m, their radius
  double support_angle = 0.0;                  ///< rad, from the caster's axis to where they touch the main ball
};

/// A source of a contact's stiffness.
using ContactModel = std::variant<SpringContact, TabledContact, BallContact, CasterContact>;

/// The sources of a contact's stiffness, in the order of ContactModel.
enum class ContactKind { springs, table, hertz, caster };

/// A place where the robot touches the part, and the source of its stiffness.
struct SupportContact {
  std::string part_point, robot_point;
  std::vector<Eigen::Vector3d> directions;  ///< the first is the contact's normal
  double loss_factor = 0.0;
  ContactModel model;
};

/// The kind of a contact's model.
[[nodiscard]] inline ContactKind kind(const SupportContact& contact) {
  return static_cast<ContactKind>(contact.model.index());
}

/// The FRFs of the assembly from which a contact's joint is to be found; none where its stiffness is told otherwise.
[[nodiscard]] inline std::vector<MeasuredFrf> measured_assembly(const SupportContact& contact) {
  const auto* springs = std::get_if<SpringContact>(&contact.model);
  return springs == nullptr ? std::vector<MeasuredFrf>() : springs->measured;
}

/// Options for the solution of the receptance route's kernel.
struct CouplingChoice {
  coupling::Regularisation regularisation = coupling::Regularisation::none;
  double threshold = 1e-10;  ///< of the largest singular value
};

}  // namespace thinwall::setup

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 4> words<setup::ContactKind>{"springs", "table", "hertz", "caster"};
template <>
inline constexpr std::array<std::string_view, 3> words<setup::DampingSought>{"viscous", "structural", "both"};

}  // namespace thinwall::core
