#pragma once
// Checks of a component that is known by measured FRFs: that its files make a matrix, where its sensors sat.

#include <string>
#include <vector>

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Reports why the files of `key` ("part.measured") make no matrix, as measured_response() would refuse them. Names
/// that are no DOFs are reported elsewhere.
void check_layout(const std::string& key, const std::vector<setup::MeasuredFrf>& files, Findings& findings);

/// Reports sensors of `key` ("part.sensors") at points that were not measured.
void check_sensors(const std::string& key, const std::vector<setup::Sensor>& sensors,
                   const std::vector<std::string>& measured, Findings& findings);

/// Both for the part.
void check_measured_part(const Case& source, Findings& findings);

}  // namespace thinwall::cases
