#pragma once
// All that learning/ offers to other programs.

#include "core/eigen_alignment.hpp"
#include "learning/calibration.hpp"
#include "learning/chain_diagnostics.hpp"
#include "learning/cut_likelihood.hpp"
#include "learning/edge_force_fit.hpp"
#include "learning/interpolated_cuts.hpp"
#include "learning/linear_fit.hpp"
#include "learning/mean_force_fit.hpp"
#include "learning/next_cut.hpp"
#include "learning/parameter_limit.hpp"
#include "learning/surrogate_chains.hpp"
