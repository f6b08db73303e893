#pragma once
// The headers of coupling/ that other programs may include.
// Internal: coupled_line, kernel.

#include "core/eigen_alignment.hpp"
#include "coupling/contact.hpp"
#include "coupling/contact_table.hpp"
#include "coupling/decoupling.hpp"
#include "coupling/error_budget.hpp"
#include "coupling/finite_difference_rotations.hpp"
#include "coupling/frf_noise.hpp"
#include "coupling/hertz_contact.hpp"
#include "coupling/joint_identification.hpp"
#include "coupling/joints.hpp"
#include "coupling/receptance.hpp"
#include "coupling/route_difference.hpp"
#include "coupling/sensitivity.hpp"
#include "coupling/spatial.hpp"
#include "coupling/tool_swap.hpp"
