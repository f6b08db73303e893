#pragma once
// The headers of distributed/ that other programs may include.
// Internal: child_process, matrix_file, open_file, orders, rank_factor.

#include "core/eigen_alignment.hpp"
#include "distributed/rank_team.hpp"
