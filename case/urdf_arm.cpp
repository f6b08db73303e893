#include "case/urdf_arm.hpp"

#include <algorithm>
#include <map>

#include "case/joint_binding.hpp"
#include "case/table.hpp"
#include "case/toml_values.hpp"
#include "core/atomic_file.hpp"
#include "io/urdf.hpp"

namespace thinwall::cases {

namespace {

std::map<std::string, robot::Joint> read_joints(const std::filesystem::path& file) {
  const std::string text = core::read_file(file);
  const ReadValues read = read_values(text, file.string(), joints_schema());
  if (!read.problems.empty()) throw CaseError({file.string(), text}, read.problems);
  std::map<std::string, robot::Joint> joints;
  for (const Table& table : Table{read.values, ""}.tables("joints")) {
    if (!joints.emplace(table.text("name"), bind_joint(table)).second)
      throw core::InputError(file.string() + ": joint \"" + table.text("name") + "\" is there twice");
  }
  return joints;
}

}  // namespace

robot::SerialArm urdf_arm(const std::filesystem::path& urdf, const std::string& base, const std::string& tip,
                          const std::filesystem::path& joints) {
  const io::UrdfChain chain = io::read_urdf(urdf, base, tip);
  std::map<std::string, robot::Joint> known = read_joints(joints);
  robot::SerialArm arm;
  for (const io::UrdfLink& link : chain.links) {
    const auto joint = known.find(link.joint);
    if (joint == known.end())
      throw core::InputError(joints.string() + ": nothing of joint \"" + link.joint + "\", which turns in " +
                             urdf.string() + "; add a [[joints]] with its stiffness");
    arm.links.push_back({link.name, link.placement, link.axis, joint->second, link.mass, link.centre, link.inertia});
    known.erase(joint);
  }
  if (!known.empty())
    throw core::InputError(joints.string() + ": joint \"" + known.begin()->first +
                           "\" does not turn between base and tip in " + urdf.string());
  arm.tip = chain.tip;
  return arm;
}

}  // namespace thinwall::cases
