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

/// The link at the end of the only chain that leaves `base`.
const urdf::Link& only_end(const urdf::Link& base, const std::filesystem::path& path) {
  const urdf::Link* link = &base;
  while (!link->child_links.empty()) {
    if (link->child_links.size() > 1) {
      std::string names;
      for (const auto& child : link->child_links) names += (names.empty() ? " (" : ", ") + child->name;
      throw UrdfEndError(path.string() + ": link \"" + link->name + "\" carries several" + names +
                             "); name the link that is the robot's tip",
                         true);
    }
    link = link->child_links.front().get();
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

void require_supported(const urdf::Joint& joint, bool on_the_way, const std::filesystem::path& path) {
  const std::string what = path.string() + ": joint \"" + joint.name + "\" is " + kind(joint);
  if (!on_the_way && joint.type != urdf::Joint::FIXED)
    throw DataError(what +
                    " and lies beside the chain; only what is fixed may hang there: make it fixed, or remove it");
  const bool turns = joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS;
  if (!turns && joint.type != urdf::Joint::FIXED)
    throw DataError(what + "; an arm's joints are revolute, continuous or fixed");
  if (turns && joint.mimic)
    throw DataError(what + " and mimics another; a linkage is no serial chain: give the joint its own angle");
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

/// Adds the body of `from` and of all links that are fixed to it, except those beyond `next`.
void add_fixed(const urdf::Link& from, const urdf::Link* next, const Eigen::Isometry3d& at,
               const std::filesystem::path& path, UrdfLink& link) {
  if (from.inertial) add_body(*from.inertial, at, from.name, path, link);
  for (const auto& child : from.child_links) {
    if (child.get() == next) continue;
    require_supported(*child->parent_joint, false, path);
    add_fixed(*child, next, at * frame(child->parent_joint->parent_to_joint_origin_transform), path, link);
  }
}

}  // namespace

UrdfChain read_urdf(const std::filesystem::path& path, const std::string& base, const std::string& tip) {
  const auto model = parse(path);
  const urdf::Link& first = base.empty() ? *model->getRoot() : link_named(*model, path, base, false);
  const auto links = way(first, tip.empty() ? only_end(first, path) : link_named(*model, path, tip, true), path);
  UrdfChain chain;
  UrdfLink ground;  // bodies fixed to the base do not move
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (i > 0) {
      const urdf::Joint& joint = *links[i]->parent_joint;
      require_supported(joint, true, path);
      chain.tip = chain.tip * frame(joint.parent_to_joint_origin_transform);
      if (joint.type != urdf::Joint::FIXED) {
        const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
        if (!(axis.norm() > 1e-9))
          throw DataError(path.string() + ": joint \"" + joint.name + "\" has an axis without direction");
        chain.links.push_back({links[i]->name, joint.name, chain.tip, axis.normalized()});
        chain.tip.setIdentity();
      }
    }
    add_fixed(*links[i], i + 1 < links.size() ? links[i + 1] : nullptr, chain.tip, path,
              chain.links.empty() ? ground : chain.links.back());
  }
  if (chain.links.empty())
    throw DataError(path.string() + ": no joint moves between \"" + first.name + "\" and \"" + links.back()->name +
                    "\"");
  return chain;
}

}  // namespace thinwall::io
