#pragma once
// Measured FRFs, whatever file they came from: one entry, a list of entries with their DOFs, a matrix.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/response_model.hpp"

namespace thinwall::io {

/// One receptance H (m/N) on its own axis. `source` names the file in messages. `coherence` γ² (0 to 1, a value a line)
/// is empty where the file has none.
struct MeasuredFrf {
  dynamics::FrequencyAxis axis;
  Eigen::VectorXcd H;
  std::string source;
  Eigen::VectorXd coherence{};
};

/// An FRF with the DOFs between which it was measured. A direction that the file does not tell is zero.
struct MeasuredEntry {
  dynamics::Dof response;
  dynamics::Dof force;
  MeasuredFrf frf;
};

/// The FRFs of a file, and what was odd in it ("where: what"): nothing is repaired or left out in silence.
struct MeasuredEntries {
  std::vector<MeasuredEntry> entries;
  std::vector<std::string> notes;
};

/// Coherence of the entry (row, column) of a response, a value a line.
struct EntryCoherence {
  Eigen::Index row = 0;
  Eigen::Index column = 0;
  Eigen::VectorXd values;
};

/// A measured FRF matrix with the coherence of those entries that have one.
struct MeasuredResponse {
  dynamics::ResponseModel response;
  std::vector<EntryCoherence> coherence;
  std::vector<std::string> notes;
};

/// The coherence of an entry, empty if there is none.
[[nodiscard]] Eigen::VectorXd coherence_of(const MeasuredResponse& measured, Eigen::Index row, Eigen::Index column);

/// The entries as a matrix, rows and columns in the order in which their DOFs appear. Throws DataError that names every
/// entry that is absent or there twice, has no direction or other frequencies than the first (relative 1e-12). Cost
/// O(n log n) and the values once.
[[nodiscard]] MeasuredResponse response_matrix(const MeasuredEntries& measured);

/// H on another axis. Lines of an equal axis pass untouched (relative 1e-12); else each line is taken from the cubic
/// through the four nearest measured lines, real and imaginary part alike. With spacing h and a resonance of half-width
/// δ = ζ f the error is at most (9/16) (h/δ)⁴ of the peak, (h/δ)⁴ between the outermost lines, because the divided
/// difference of 1/(x − iδ) is the product of 1/|x_i − iδ| ≤ 1/δ: 1e-3 needs h ≤ δ/5. Throws DataError, with both
/// ranges, if the axis goes beyond the measured one: nothing is extrapolated.
[[nodiscard]] Eigen::VectorXcd resample(const MeasuredFrf& frf, const dynamics::FrequencyAxis& axis);

/// The coherence on another axis, straight between its lines; equal lines pass untouched. Empty if there is none.
/// Throws DataError as resample().
[[nodiscard]] Eigen::VectorXd coherence_on(const MeasuredFrf& frf, const dynamics::FrequencyAxis& axis);

}  // namespace thinwall::io
