#pragma once
// The headers of core/ that other programs may include.
// Internal: atomic_file, dense_eigenvalues, dense_factorisations, dense_products, draws, faults, fields, gauss_rule,
// median, message_line, mode_signs, nearest_name, pieces, split, synonyms.

#include "core/eigen_alignment.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/memory.hpp"
#include "core/messages.hpp"
#include "core/overloaded.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "core/time_limit.hpp"
#include "core/units.hpp"
#include "core/words.hpp"
