#include "case/urdf_arm.hpp"

#include <map>
#include <utility>

#include "case/joint_binding.hpp"
#include "case/table.hpp"
#include "case/toml_values.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "io/urdf.hpp"

namespace thinwall::cases {

namespace {

/// What a file tells of joints: of those that move, and where others stand still.
struct Joints {
  CaseValues values;
  std::map<std::string, Table> moving;
  io::UrdfPlaces held;
};

/// The tables refer to the values, which therefore stay where they are.
void read_joints(const std::filesystem::path& file, Joints& joints) {
  const std::string text = core::read_file(file);
  ReadValues read = read_values(text, file.string(), joints_schema());
  if (!read.problems.empty()) throw CaseError({file.string(), text}, read.problems);
  joints.values = std::move(read.values);
  for (const Table& table : Table{joints.values, ""}.tables("joints")) {
    const std::string name = table.text("name");
    if (joints.moving.contains(name) || joints.held.contains(name))
      throw core::InputError(file.string() + ": joint \"" + name + "\" is there twice");
    if (!table.has("angle") && !table.has("distance")) {
      joints.moving.emplace(name, table);
      continue;
    }
    for (const char* key : {"stiffness", "linear_stiffness", table.has("angle") ? "distance" : "angle"}) {
      if (table.has(key))
        throw core::InputError(file.string() + ": joint \"" + name + "\" stands still at its " +
                               (table.has("angle") ? "angle" : "distance") + " and has no " + key + "; remove one");
    }
    const bool slides = table.has("distance");
    joints.held.emplace(name, io::UrdfPlace{table.number(slides ? "distance" : "angle"), slides});
  }
}

/// The joint of a link; one that slides has no motor.
robot::Joint joint_of(const io::UrdfLink& link, const Table& table, const std::filesystem::path& file) {
  const std::string what =
      file.string() + ": joint \"" + link.joint + "\" " + (link.slides ? "slides" : "turns") + " and ";
  const char* own = link.slides ? "linear_stiffness" : "stiffness";
  const char* other = link.slides ? "stiffness" : "linear_stiffness";
  if (!table.has(own)) throw core::InputError(what + "needs its " + own);
  if (table.has(other)) throw core::InputError(what + "has no " + other + "; remove it");
  const robot::Joint turning = bind_joint(table);
  if (!link.slides) return turning;
  if (turning.damping != 0.0 || turning.motor_inertia != 0.0 || turning.gear_ratio != 1.0 || !turning.motor_locked())
    throw core::InputError(what + "has linear_stiffness and linear_damping only; remove its motor, servo and damping");
  return {.stiffness = table.number("linear_stiffness"), .damping = table.number("linear_damping")};
}

std::string assumed(const io::UrdfFrozenJoint& joint, const std::filesystem::path& urdf,
                    const std::filesystem::path& joints) {
  const auto& kind = joint.slides ? core::kind::length : core::kind::angle;
  return "joint \"" + joint.name + "\" of " + urdf.string() + " lies beside the chain and stands still at " +
         core::readable_text(joint.value, kind) + "; if it stands elsewhere, give its " +
         (joint.slides ? "distance" : "angle") + " in a [[joints]] of " + joints.string();
}

}  // namespace

UrdfArm urdf_arm(const std::filesystem::path& urdf, const std::string& base, const std::string& tip,
                 const std::filesystem::path& joints) {
  Joints known;
  read_joints(joints, known);
  const io::UrdfChain chain = io::read_urdf(urdf, base, tip, known.held);
  UrdfArm result;
  for (const io::UrdfLink& link : chain.links) {
    const auto joint = known.moving.find(link.joint);
    if (joint == known.moving.end())
      throw core::InputError(joints.string() + ": nothing of joint \"" + link.joint + "\", which " +
                             (link.slides ? "slides in " : "turns in ") + urdf.string() +
                             "; add a [[joints]] with its " + (link.slides ? "linear_stiffness" : "stiffness"));
    result.arm.links.push_back({link.name, link.placement, link.axis, joint_of(link, joint->second, joints), link.mass,
                                link.centre, link.inertia, link.slides});
    known.moving.erase(joint);
  }
  if (!known.moving.empty())
    throw core::InputError(joints.string() + ": joint \"" + known.moving.begin()->first +
                           "\" does not move between base and tip in " + urdf.string() +
                           "; give it an angle or a distance if it stands still elsewhere than at 0, or remove it");
  result.arm.tip = chain.tip;
  for (const io::UrdfFrozenJoint& joint : chain.frozen) {
    if (!joint.stated) result.assumed.push_back(assumed(joint, urdf.filename(), joints.filename()));
  }
  return result;
}

}  // namespace thinwall::cases
