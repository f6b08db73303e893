#include "case/checks/kept_points.hpp"

#include <algorithm>

#include "case/checks/part_checks.hpp"
#include "setup/measured_layout.hpp"

namespace thinwall::cases {

void require_kept(const Case& source, const std::string& key, const std::string& name, Findings& findings) {
  const auto points = part_points(source);
  findings.require_known(key, name, points, "point");
  const auto& kept = source.reduction.interface;
  if (!source.part || std::ranges::find(points, name) == points.end() || std::ranges::count(kept, name) > 0) return;
  findings.report(key, "point \"" + name + "\" is not kept by the reduction; add it to reduction.interface");
}

void require_direction(const std::string& key, const std::string& dof, Findings& findings) {
  if (dof.empty() || direction_of(dof)) return;
  findings.report(key, "\"" + dof + "\" names no direction; write for example \"" + setup::point_of(dof) + ".x\"");
}

}  // namespace thinwall::cases
