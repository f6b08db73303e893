#pragma once
// The headers of identification/ that other programs may include.
// Internal: assignment, line_functions.

#include "core/eigen_alignment.hpp"
#include "identification/drawn_fits.hpp"
#include "identification/fit_response.hpp"
#include "identification/fitted_model.hpp"
#include "identification/identify.hpp"
#include "identification/measured_lines.hpp"
#include "identification/modal_fit.hpp"
#include "identification/passive_fit.hpp"
#include "identification/plscf.hpp"
#include "identification/tracking.hpp"
