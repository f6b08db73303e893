#include "case/checks/measured_checks.hpp"

#include <algorithm>

#include "case/checks/part_checks.hpp"
#include "setup/measured_layout.hpp"

namespace thinwall::cases {

void check_layout(const std::string& key, const std::vector<setup::MeasuredFrf>& files, Findings& findings) {
  const bool named = std::ranges::all_of(
      files, [](const setup::MeasuredFrf& frf) { return direction_of(frf.response) && direction_of(frf.force); });
  if (!named) return;
  const setup::LayoutFault fault = setup::fault_of_layout(files);
  if (fault.text.empty()) return;
  findings.report(fault.file ? key + "[" + std::to_string(*fault.file) + "].response" : key, fault.text);
}

void check_sensors(const std::string& key, const std::vector<setup::Sensor>& sensors,
                   const std::vector<std::string>& measured, Findings& findings) {
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    findings.require_known(key + "[" + std::to_string(i) + "].at", sensors[i].point, measured, "measured point");
  }
}

void check_measured_part(const Case& source, Findings& findings) {
  check_layout("part.measured", source.measured_part, findings);
  if (source.part_sensors.empty()) return;
  if (source.measured_part.empty()) {
    findings.report("part.sensors", "there are no FRFs to take their mass off; add [[part.measured]], or remove them");
    return;
  }
  std::vector<std::string> points;
  for (const std::string& dof : setup::measured_layout(source.measured_part).dofs) {
    if (std::ranges::find(points, setup::point_of(dof)) == points.end()) points.push_back(setup::point_of(dof));
  }
  check_sensors("part.sensors", source.part_sensors, points, findings);
}

}  // namespace thinwall::cases
