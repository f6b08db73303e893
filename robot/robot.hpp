#pragma once
// The headers of robot/ that other programs may include.

#include "core/eigen_alignment.hpp"
#include "robot/arm_dynamics.hpp"
#include "robot/arm_kinematics.hpp"
#include "robot/feed_motion.hpp"
#include "robot/flexible_joints.hpp"
#include "robot/freed_table.hpp"
#include "robot/inverse_kinematics.hpp"
#include "robot/measured.hpp"
#include "robot/modal_table.hpp"
#include "robot/multibody.hpp"
#include "robot/newmark.hpp"
#include "robot/one_mode.hpp"
#include "robot/serial_arm.hpp"
#include "robot/tip_model.hpp"
#include "robot/virtual_joints.hpp"
