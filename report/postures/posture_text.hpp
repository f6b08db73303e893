#pragma once
// A study of postures in words, for the terminal.

#include <string>

#include "report/postures/posture_summary.hpp"

namespace thinwall::report {

/// A table of the modes with their errors where postures were held out, and a line or two for each of depths, numbers
/// learned together, map, envelope and next posture.
[[nodiscard]] std::string posture_text(const LearnedRobotSummary& robot);

}  // namespace thinwall::report
