#include "case/checks/path_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "case/checks/part_checks.hpp"
#include "case/checks/robot_checks.hpp"
#include "setup/path.hpp"

namespace thinwall::cases {

namespace {

void check_keys(Findings& findings) {
  const bool from = findings.given("path.from"), to = findings.given("path.to");
  if (findings.given("path.points")) {
    for (const char* key : {"path.from", "path.to", "path.positions"}) {
      if (!findings.given(key)) continue;
      findings.report(key, "give either path.points or a straight path, not both");
      return;
    }
  } else if (from != to) {
    findings.report(from ? "path.from" : "path.to",
                    "a straight path has both ends; add " + std::string(from ? "path.to" : "path.from"));
  } else if (!from) {
    findings.report("path", "give path.from and path.to, or path.points");
  }
}

/// True if nothing is missing that a path needs.
bool check_needs(const Case& source, Findings& findings) {
  const std::size_t before = findings.problems.size();
  if (!source.part || setup::kind(*source.part) == setup::ShapeKind::matrices)
    findings.report("path", "there is no modelled part to move along; describe it (part.length …), or remove [path]");
  if (!source.tool || !source.cutting || !source.lobes)
    findings.report("path", "a path needs [tool], [cutting] and [lobes]; add what is missing, or remove [path]");
  if (source.path->robot_follows && !setup::carries_tool(source.robot) && (!source.robot || source.contacts.empty()))
    findings.report("path.support", "there is no robot to follow the cut; add [robot] and [[contacts]]");
  const auto* robot = source.robot ? std::get_if<setup::JointedRobot>(&source.robot->model) : nullptr;
  if (source.path->robot_follows && robot != nullptr && (!robot->posture.joints.empty() || robot->posture.tip))
    findings.report("path.support",
                    "the robot cannot follow with robot.posture.joints or tip, which hold it in one "
                    "place; give its posture by pitch or approach");
  if (source.lobes && source.lobes->method != milling::Method::direct)
    findings.report("lobes.method", "lobes along a path are by the direct method; leave it at \"direct\" and name \"" +
                                        milling::name(source.lobes->method) + "\" in lobes.compare");
  return findings.problems.size() == before;
}

bool all_finite(const std::vector<Eigen::Vector3d>& positions) {
  return std::ranges::all_of(positions, [](const Eigen::Vector3d& p) { return p.allFinite(); });
}

void check_length(const setup::Path& path, Findings& findings) {
  for (std::size_t i = 1; i < path.positions.size(); ++i) {
    if (path.positions[i] != path.positions[i - 1]) continue;
    findings.report(findings.given("path.points") ? "path.points" : "path.to",
                    "positions " + std::to_string(i) + " and " + std::to_string(i + 1) +
                        " are the same; a path goes from one to another");
    return;
  }
}

/// The fault of a point of the case at one position; empty if nothing.
std::string fault_at(const setup::PartSetup& there, const setup::Point& p) {
  if (std::string outside = outside_part(*there.part, *p.position, p.patch_radius); !outside.empty()) return outside;
  for (const Eigen::Vector3d& direction : p.directions) {
    const std::string support = clamped_by(there, p.name, direction);
    if (!support.empty()) return "is clamped by \"" + support + "\"";
  }
  return "";
}

/// The first position that does not do; true if all do.
bool check_position(const Case& source, std::size_t i, std::optional<Eigen::VectorXd>& near, Findings& findings) {
  const std::string number =
      "position " + std::to_string(i + 1) + " of " + std::to_string(source.path->positions.size());
  const setup::PathStation station = setup::station(source, i);
  const setup::PartSetup there = setup::part_at(source, station);
  for (const setup::Point& p : there.points) {
    const bool is_cut = p.name == station.cut;
    if (!is_cut && !source.path->robot_follows) continue;
    const std::string fault = fault_at(there, p);
    if (fault.empty()) continue;
    if (is_cut) {
      const char* last = i == 0 ? "path.from" : "path.to";
      findings.report(findings.given("path.points") ? "path.points" : last,
                      fmt::format("{} {}; keep the path on the part and off its supports", number, fault));
    } else {
      findings.report("path.support", fmt::format("at {} the contact at \"{}\" {}; shorten the path, or hold the robot "
                                                  "(support = \"held\")",
                                                  number, p.name, fault));
    }
    return false;
  }
  if (!source.path->robot_follows || !source.robot) return true;
  const std::string fault = fault_of_posture(there, setup::support_at(source, station), near);
  if (fault.empty()) return true;
  findings.report("path.support", fmt::format("at {} {}", number, fault));
  return false;
}

bool points_known(const Case& source) {
  const auto known = [&](const std::string& name) {
    return std::ranges::any_of(source.points, [&](const setup::Point& p) {
      return p.name == name && p.at.has_value() != p.position.has_value();
    });
  };
  return known(source.cutting->at) &&
         std::ranges::all_of(source.contacts, [&](const setup::SupportContact& c) { return known(c.part_point); });
}

}  // namespace

void check_path(const Case& source, Findings& findings) {
  check_keys(findings);
  const bool complete = check_needs(source, findings);
  if (!all_finite(source.path->positions)) return;  // reported by the reader
  check_length(*source.path, findings);
  if (!complete || !points_known(source)) return;
  std::optional<Eigen::VectorXd> near;
  for (std::size_t i = 0; i < source.path->positions.size(); ++i) {
    if (!check_position(source, i, near, findings)) return;
  }
}

}  // namespace thinwall::cases
