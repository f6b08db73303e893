#pragma once
// The orders that the ranks take from the program that started them, and their answers.

#include <filesystem>

namespace thinwall::distributed {

// clang-format off
/// Carries out the lines of the first rank's input until "quit" or its end, on all ranks of MPI_COMM_WORLD; the first
/// rank prints the answers, each a line that begins with "=". Between orders the ranks sleep.
///
///     hello           = ready RANKS LIBRARY
///     analyse N DISK  = analysed BYTES_OF_MACHINE FREE LEAST MOST SECONDS ENTRIES FLOPS ANALYSIS_SECONDS   of `matrix`, `order`
///     factorise N     = factorised SECONDS PEAK_BYTES
///     solve N COUNT   = solved                                                                          in `columns`
///     drop N          = dropped
///
/// DISK is 1 if the factor goes to files in the folder. Or the answer is "= failed …" for a matrix that cannot be
/// factorised, which is dropped. What ends the ranks is thrown.
// clang-format on
void carry_out_orders(const std::filesystem::path& folder);

}  // namespace thinwall::distributed
