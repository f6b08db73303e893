#pragma once
// A part given by matrices of another program: from K, M and their DOF table to what the pipeline solves.

#include "dynamics/sparse_model.hpp"
#include "reduction/interface.hpp"
#include "setup/machining_setup.hpp"
#include "study/part/solution.hpp"

namespace thinwall::study {

/// Factor and modes of the matrices. How many motions nothing holds is told by the eigenvalues: those below 1e-6 of the
/// next (|λ|, K shifted by −1e-8 tr K / tr M), at most twelve. Throws NumericalError where no such gap tells rigid from
/// elastic modes, DataError that names the file where K or M is indefinite beyond round-off. Cost: a factorisation
/// of M and one of K, two for a held part, and the modes.
[[nodiscard]] Solution matrix_solution(const setup::PartSetup& source);

/// The points of the reduction by the rows of their nodes: a column for each direction n, Σ n_i of component i. Throws
/// InputError for a direction along which the node has no row.
[[nodiscard]] reduction::Interface matrix_interface(const setup::PartSetup& source);

}  // namespace thinwall::study
