#include "io/urdf.hpp"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/nearest_name.hpp"

namespace thinwall::io {

namespace {

using core::DataError;

Eigen::Isometry3d frame(const urdf::Pose& pose) {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
  pose.rotation.getQuaternion(x, y, z, w);
  Eigen::Isometry3d T(Eigen::Quaterniond(w, x, y, z).normalized());
  T.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  return T;
}

/// A handler that collects the parser's messages, which become part of this program's message.
class ParserErrors : public console_bridge::OutputHandler {
 public:
  ParserErrors() { console_bridge::useOutputHandler(this); }
  ~ParserErrors() override { console_bridge::restorePreviousOutputHandler(); }
  ParserErrors(const ParserErrors&) = delete;
  ParserErrors& operator=(const ParserErrors&) = delete;
  void log(const std::string& text, console_bridge::LogLevel level, const char* /*file*/, int /*line*/) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && first.empty()) first = text;
  }
  std::string first;
};

/// The parser descends by recursion into elements, and frees links so.
constexpr int deepest_element = 100, most_joints = 1000;

/// Refuses what the parser would not survive, by the tags of the text; comments and quoted texts are passed over.
void require_modest(const std::string& text, const std::filesystem::path& path) {
  int depth = 0, joints = 0;
  for (std::size_t i = text.find('<'); i != std::string::npos; i = text.find('<', i)) {
    const std::string_view rest = std::string_view(text).substr(i);
    const auto comment = rest.starts_with("<!--");
    std::size_t end = comment ? rest.find("-->") : 1;
    for (char quote = 0; !comment && end < rest.size() && (quote != 0 || rest[end] != '>'); ++end) {
      if (quote == 0 && (rest[end] == '"' || rest[end] == '\'')) quote = rest[end];
      else if (rest[end] == quote) quote = 0;
    }
    if (end >= rest.size()) return;  // no XML, which the parser says
    const bool declaration = rest[1] == '?' || rest[1] == '!';
    if (rest[1] == '/') --depth;
    else if (!declaration && rest[end - 1] != '/') ++depth;
    if (rest.starts_with("<joint")) ++joints;
    if (depth > deepest_element)
      throw DataError(path.string() + ": elements are nested deeper than " + std::to_string(deepest_element) +
                      "; a robot needs five: look for a tag that is not closed");
    if (joints > most_joints)
      throw DataError(path.string() + ": more than " + std::to_string(most_joints) +
                      " joints; keep those between the robot's base and its tip");
    i += end;
  }
}

/// A link that hangs on itself, or on two others, is none of a tree.
void require_tree(const urdf::ModelInterface& model, const std::filesystem::path& path) {
  std::map<std::string, std::string> joint_of;
  for (const auto& [name, joint] : model.joints_) {
    const auto [first, is_new] = joint_of.emplace(joint->child_link_name, name);
    if (!is_new)
      throw DataError(path.string() + ": the joints \"" + first->second + "\" and \"" + name + "\" both carry link \"" +
                      joint->child_link_name + "\"; a link hangs on one joint");
  }
  for (const auto& [name, link] : model.links_) {
    auto below = link->getParent();
    for (std::size_t step = 0; below; below = below->getParent()) {
      if (++step > model.links_.size())
        throw DataError(path.string() + ": link \"" + name +
                        "\" hangs on joints that form a cycle; a linkage is no serial chain: open it");
    }
  }
}

urdf::ModelInterfaceSharedPtr parse(const std::filesystem::path& path) {
  const std::string text = core::read_file(path);
  require_modest(text, path);
  ParserErrors errors;
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& error) {
    errors.first = error.what();
  }
  if (!model || !errors.first.empty()) {
    std::ranges::replace(errors.first, '\n', ' ');
    throw DataError(path.string() + ": no robot in URDF" + (errors.first.empty() ? "" : ": " + errors.first));
  }
  require_tree(*model, path);
  return model;
}

const urdf::Link& link_named(const urdf::ModelInterface& model, const std::filesystem::path& path,
                             const std::string& name, bool tip) {
  const auto found = model.links_.find(name);
  if (found != model.links_.end()) return *found->second;
  std::vector<std::string> names;
  for (const auto& [known, link] : model.links_) names.push_back(known);
  throw UrdfEndError(path.string() + ": there is no link \"" + name + "\"" + core::did_you_mean(name, names), tip);
}

bool moves(const urdf::Joint& joint) {
  return joint.type != urdf::Joint::FIXED;
}

/// True if a joint moves in the link's own joint or in those that it carries.
bool carries_motion(const urdf::Link& link) {
  return moves(*link.parent_joint) ||
         std::ranges::any_of(link.child_links, [](const auto& child) { return carries_motion(*child); });
}

double fixed_mass(const urdf::Link& link) {
  double mass = link.inertial ? link.inertial->mass : 0.0;
  for (const auto& child : link.child_links) mass += moves(*child->parent_joint) ? 0.0 : fixed_mass(*child);
  return mass;
}

/// The end that is probably meant: the link that carries no other, moves with some mass, and lies farthest from `base`
/// along the links; null if there is none.
const urdf::Link* likely_tip(const urdf::ModelInterface& model, const urdf::Link& base) {
  const urdf::Link* best = nullptr;
  double farthest = -1.0;
  for (const auto& [name, leaf] : model.links_) {
    if (!leaf->child_links.empty()) continue;
    double length = 0.0;
    const urdf::Link* moving = nullptr;  // the link that the last joint moves
    const urdf::Link* link = leaf.get();
    for (; link != &base && link->parent_joint; link = link->getParent().get()) {
      length += frame(link->parent_joint->parent_to_joint_origin_transform).translation().norm();
      if (moving == nullptr && moves(*link->parent_joint)) moving = link;
    }
    if (link != &base || moving == nullptr || !(fixed_mass(*moving) > 0.0) || !(length > farthest)) continue;
    farthest = length;
    best = leaf.get();
  }
  return best;
}

/// The link at the end of the only chain that leaves `base`; a branch without a joint that moves is none where another
/// has one.
const urdf::Link& only_end(const urdf::ModelInterface& model, const urdf::Link& base,
                           const std::filesystem::path& path) {
  const urdf::Link* link = &base;
  while (!link->child_links.empty()) {
    auto next = link->child_links;
    if (std::ranges::any_of(next, [](const auto& child) { return carries_motion(*child); }))
      std::erase_if(next, [](const auto& child) { return !carries_motion(*child); });
    if (next.size() > 1) {
      std::string names;
      for (const auto& child : next) names += (names.empty() ? " (" : ", ") + child->name;
      const urdf::Link* likely = likely_tip(model, base);
      throw UrdfEndError(path.string() + ": link \"" + link->name + "\" carries several" + names +
                             "); name the link that is the robot's tip" +
                             (likely == nullptr ? "" : ": \"" + likely->name + "\" lies farthest from the base"),
                         true);
    }
    link = next.front().get();
  }
  return *link;
}

/// The links from the base to the tip, both included.
std::vector<const urdf::Link*> way(const urdf::Link& base, const urdf::Link& tip, const std::filesystem::path& path) {
  std::vector<const urdf::Link*> links{&tip};
  while (links.back() != &base) {
    const auto parent = links.back()->getParent();
    if (!parent)
      throw UrdfEndError(path.string() + ": link \"" + tip.name + "\" does not hang on \"" + base.name + "\"", true);
    links.push_back(parent.get());
  }
  std::ranges::reverse(links);
  return links;
}

std::string kind(const urdf::Joint& joint) {
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return "revolute";
    case urdf::Joint::CONTINUOUS:
      return "continuous";
    case urdf::Joint::PRISMATIC:
      return "prismatic";
    case urdf::Joint::FLOATING:
      return "floating";
    case urdf::Joint::PLANAR:
      return "planar";
    case urdf::Joint::FIXED:
      return "fixed";
    default:
      return "unknown";
  }
}

bool slides(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::PRISMATIC;
}

bool turns(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS;
}

/// What a joint along the chain must be, unless it is held at a stated place.
void require_supported(const urdf::Joint& joint, const std::filesystem::path& path) {
  const std::string what = path.string() + ": joint \"" + joint.name + "\" is " + kind(joint);
  if (!turns(joint) && !slides(joint) && joint.type != urdf::Joint::FIXED)
    throw DataError(what + "; an arm's joints are revolute, continuous, prismatic or fixed");
  if (moves(joint) && joint.mimic)
    throw DataError(what + " and mimics another; a linkage is no serial chain: state where the joint stands");
}

Eigen::Vector3d axis_of(const urdf::Joint& joint, const std::filesystem::path& path) {
  const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
  if (!(axis.norm() > 1e-9))
    throw DataError(path.string() + ": joint \"" + joint.name + "\" has an axis without direction");
  return axis.normalized();
}

/// The model with the places of joints that the user has stated.
struct Robot {
  const urdf::ModelInterface& model;
  const std::filesystem::path& path;
  const UrdfPlaces& places;
};

/// Throws unless every stated place is that of a joint of the file, and of its kind.
void require_joints(const Robot& robot) {
  for (const auto& [name, place] : robot.places) {
    const auto found = robot.model.joints_.find(name);
    if (found == robot.model.joints_.end()) {
      std::vector<std::string> names;
      for (const auto& [known, joint] : robot.model.joints_) names.push_back(known);
      throw DataError(robot.path.string() + ": there is no joint \"" + name + "\"" + core::did_you_mean(name, names));
    }
    const urdf::Joint& joint = *found->second;
    if (place.slides ? !slides(joint) : !turns(joint))
      throw DataError(robot.path.string() + ": joint \"" + name + "\" is " + kind(joint) + " and stands at no " +
                      (place.slides ? "distance" : "angle"));
  }
}

/// The place of a joint that is not followed: as stated, or as the joint that it mimics, or the one within its limits
/// that is nearest to 0.
double place_of(const Robot& robot, const urdf::Joint& joint) {
  const auto stated = [&](const urdf::Joint& of) {
    const auto found = robot.places.find(of.name);
    if (found != robot.places.end()) return found->second.value;
    return of.limits && of.limits->lower <= of.limits->upper ? std::clamp(0.0, of.limits->lower, of.limits->upper)
                                                             : 0.0;
  };
  if (!joint.mimic || robot.places.contains(joint.name)) return stated(joint);
  const auto leader = robot.model.joints_.find(joint.mimic->joint_name);
  return leader == robot.model.joints_.end() ? stated(joint)
                                             : joint.mimic->multiplier * stated(*leader->second) + joint.mimic->offset;
}

/// The frame of the link behind a joint that stands still, in that of the link before.
Eigen::Isometry3d held(const Robot& robot, const urdf::Joint& joint) {
  Eigen::Isometry3d T = frame(joint.parent_to_joint_origin_transform);
  if (turns(joint)) T = T * Eigen::AngleAxisd(place_of(robot, joint), axis_of(joint, robot.path));
  if (slides(joint)) T = T * Eigen::Translation3d(place_of(robot, joint) * axis_of(joint, robot.path));
  return T;
}

/// Adds a rigid body to a link, both in the link's frame (Steiner).
void add_body(const urdf::Inertial& body, const Eigen::Isometry3d& at, const std::string& name,
              const std::filesystem::path& path, UrdfLink& link) {
  Eigen::Matrix3d I;
  I << body.ixx, body.ixy, body.ixz, body.ixy, body.iyy, body.iyz, body.ixz, body.iyz, body.izz;
  const Eigen::Isometry3d T = at * frame(body.origin);
  if (!std::isfinite(body.mass) || body.mass < 0.0 || !I.allFinite() || !T.matrix().allFinite())
    throw DataError(path.string() + ": link \"" + name + "\" has a mass or inertia that no body has");
  const double mass = link.mass + body.mass;
  if (mass == 0.0) return;
  const Eigen::Vector3d centre = (link.mass * link.centre + body.mass * T.translation()) / mass;
  const auto steiner = [&](double m, const Eigen::Vector3d& c) -> Eigen::Matrix3d {
    const Eigen::Vector3d d = c - centre;
    return m * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
  };
  link.inertia +=
      steiner(link.mass, link.centre) + T.linear() * I * T.linear().transpose() + steiner(body.mass, T.translation());
  link.inertia = (0.5 * (link.inertia + link.inertia.transpose())).eval();
  link.mass = mass;
  link.centre = centre;
}

/// Adds the body of `from` and of all links that it carries, except those beyond `next`; joints beside the chain stand
/// still, and are listed in `frozen`.
void add_carried(const Robot& robot, const urdf::Link& from, const urdf::Link* next, const Eigen::Isometry3d& at,
                 UrdfLink& link, std::vector<UrdfFrozenJoint>& frozen) {
  if (from.inertial) add_body(*from.inertial, at, from.name, robot.path, link);
  for (const auto& child : from.child_links) {
    if (child.get() == next) continue;
    const urdf::Joint& joint = *child->parent_joint;
    const bool follows = joint.mimic && robot.places.contains(joint.mimic->joint_name);
    if (moves(joint))
      frozen.push_back(
          {joint.name, place_of(robot, joint), slides(joint), follows || robot.places.contains(joint.name)});
    add_carried(robot, *child, nullptr, at * held(robot, joint), link, frozen);
  }
}

/// Goes over a joint of the chain: one that moves begins a new link, another one shifts the frame.
void step(const Robot& robot, const urdf::Joint& joint, UrdfChain& chain) {
  if (robot.places.contains(joint.name)) {
    chain.tip = chain.tip * held(robot, joint);
    return;
  }
  require_supported(joint, robot.path);
  chain.tip = chain.tip * frame(joint.parent_to_joint_origin_transform);
  if (!moves(joint)) return;
  UrdfLink link{.name = joint.child_link_name, .joint = joint.name, .placement = chain.tip};
  link.axis = axis_of(joint, robot.path);
  link.slides = slides(joint);
  chain.links.push_back(link);
  chain.tip.setIdentity();
}

}  // namespace

UrdfChain read_urdf(const std::filesystem::path& path, const std::string& base, const std::string& tip,
                    const UrdfPlaces& places) {
  const auto model = parse(path);
  const Robot robot{*model, path, places};
  require_joints(robot);
  const urdf::Link& first = base.empty() ? *model->getRoot() : link_named(*model, path, base, false);
  const auto links =
      way(first, tip.empty() ? only_end(*model, first, path) : link_named(*model, path, tip, true), path);
  UrdfChain chain;
  UrdfLink ground;  // bodies fixed to the base do not move
  std::vector<UrdfFrozenJoint> beside_ground;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (i > 0) step(robot, *links[i]->parent_joint, chain);
    const bool stands = chain.links.empty();
    add_carried(robot, *links[i], i + 1 < links.size() ? links[i + 1] : nullptr, chain.tip,
                stands ? ground : chain.links.back(), stands ? beside_ground : chain.frozen);
  }
  if (chain.links.empty())
    throw DataError(path.string() + ": no joint moves between \"" + first.name + "\" and \"" + links.back()->name +
                    "\"");
  return chain;
}

}  // namespace thinwall::io
