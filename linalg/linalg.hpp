#pragma once
// The headers of linalg/ that other programs may include.
// Internal: cholmod, condensed_factor, divided_problem, domains, factor_bytes, large_array, matrix_graph, minimum_fill,
// supernodal_factor, supernodal_solve, symbolic_factor, tall, tall_triangle, tree_cut.

#include "core/eigen_alignment.hpp"
#include "linalg/block_lanczos.hpp"
#include "linalg/bracketed_root.hpp"
#include "linalg/complex_eigenvalues.hpp"
#include "linalg/complex_lu.hpp"
#include "linalg/eigenpair_check.hpp"
#include "linalg/eigenpairs.hpp"
#include "linalg/external_factor.hpp"
#include "linalg/inverse_iteration.hpp"
#include "linalg/largest_eigenvalues.hpp"
#include "linalg/library_threads.hpp"
#include "linalg/ordering.hpp"
#include "linalg/rayleigh_quotients.hpp"
#include "linalg/real_eigenvalues.hpp"
#include "linalg/sparse.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "linalg/sparse_indefinite.hpp"
#include "linalg/substructures/substructured_eigenpairs.hpp"
