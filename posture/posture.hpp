#pragma once
// The headers of posture/ that other programs may include.

#include "core/eigen_alignment.hpp"
#include "posture/arm_modes.hpp"
#include "posture/calibration.hpp"
#include "posture/tapped_posture.hpp"
