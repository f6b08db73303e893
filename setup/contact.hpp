#pragma once
// Places where the robot touches the part, and the sources of their stiffness.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/words.hpp"
#include "coupling/contact.hpp"
#include "coupling/contact_table.hpp"
#include "coupling/hertz_contact.hpp"
#include "coupling/kernel.hpp"
#include "setup/measured_frf.hpp"

namespace thinwall::setup {

/// Sources of a contact's stiffness.
enum class ContactModel {
  springs,  ///< given
  table,    ///< a table over the preload
  hertz,    ///< a ball on the part
  caster,   ///< a ball on smaller balls in a cup
};

/// Kinds of damping that are sought in FRFs of the assembly.
enum class DampingSought { viscous, structural, both };

/// The ball by which a robot touches; the supports are a caster's.
struct ContactBall {
  double radius = 0.0;        ///< m
  coupling::Elastic steel{};  ///< of all balls and of the cup
  std::optional<int> supports;
  std::optional<double> support_radius, support_angle;  ///< m, rad
};

/// A place where the robot touches the part, and the source of its stiffness.
struct Contact {
  std::string part_point, robot_point;
  std::vector<Eigen::Vector3d> directions;  ///< the first is the contact's normal
  std::vector<double> stiffness;            ///< N/m, one per direction; infinite allowed
  std::vector<double> damping;              ///< N s/m, one per direction
  double loss_factor = 0.0;
  ContactModel model = ContactModel::springs;
  std::optional<double> preload{};                          ///< N; none: from robot.preload
  std::filesystem::path table{};                            ///< of model table
  std::shared_ptr<const coupling::ContactTable> rows = {};  ///< of the table, once it is read
  std::optional<ContactBall> ball{};
  std::optional<coupling::Elastic> surface{};  ///< that the ball touches; none: part.material
  std::vector<MeasuredFrf> measured{};         ///< of the assembly, from which the joint is found
  DampingSought damping_sought = DampingSought::viscous;
  std::vector<double> noise{};  ///< relative: of the assembly, of the part, of the robot
};

/// Options for the solution of the receptance route's kernel.
struct CouplingChoice {
  coupling::Regularisation regularisation = coupling::Regularisation::none;
  double threshold = 1e-10;  ///< of the largest singular value
};

}  // namespace thinwall::setup

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 4> words<setup::ContactModel>{"springs", "table", "hertz", "caster"};
template <>
inline constexpr std::array<std::string_view, 3> words<setup::DampingSought>{"viscous", "structural", "both"};

}  // namespace thinwall::core
