#pragma once
// The headers of posture/ that other programs may include.

#include "core/eigen_alignment.hpp"
#include "posture/arm_modes.hpp"
#include "posture/band_envelope.hpp"
#include "posture/bands.hpp"
#include "posture/calibration.hpp"
#include "posture/held_out.hpp"
#include "posture/hull.hpp"
#include "posture/learning_curve.hpp"
#include "posture/mode_targets.hpp"
#include "posture/next_posture.hpp"
#include "posture/predictor.hpp"
#include "posture/shared_tasks.hpp"
#include "posture/tapped_posture.hpp"
#include "posture/workspace_map.hpp"
