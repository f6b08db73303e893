#pragma once
// The headers of dynamics/ that other programs may include.
// Internal: motion_words, rational_lines, rational_noise.

#include "core/eigen_alignment.hpp"
#include "dynamics/beam_element.hpp"
#include "dynamics/believable_band.hpp"
#include "dynamics/conversion.hpp"
#include "dynamics/dof.hpp"
#include "dynamics/frequency_axis.hpp"
#include "dynamics/frf_checks.hpp"
#include "dynamics/mac.hpp"
#include "dynamics/modal_model.hpp"
#include "dynamics/modal_table.hpp"
#include "dynamics/rational_fit.hpp"
#include "dynamics/response_model.hpp"
#include "dynamics/rigid_body.hpp"
#include "dynamics/round_circles.hpp"
#include "dynamics/sparse_model.hpp"
#include "dynamics/sparse_spatial.hpp"
#include "dynamics/spatial_model.hpp"
#include "dynamics/unit_system.hpp"
