#pragma once
// Measured FRFs from files of any format: one entry, a list of entries with their DOFs, a matrix.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/response_model.hpp"

namespace thinwall::io {

/// One receptance H (m/N) on its own axis. `source` names the file in messages. `coherence` γ² (0 to 1, one value for
/// each line) is empty if the file has none.
struct MeasuredFrf {
  dynamics::FrequencyAxis axis;
  Eigen::VectorXcd H;
  std::string source;
  Eigen::VectorXd coherence{};
};

/// An FRF with the DOFs between which it was measured. A direction that the file does not contain is zero.
struct MeasuredEntry {
  dynamics::Dof response;
  dynamics::Dof force;
  MeasuredFrf frf;
};

/// The FRFs of a file, and notes ("place: fact") on everything that was repaired or left out.
struct MeasuredEntries {
  std::vector<MeasuredEntry> entries;
  std::vector<std::string> notes;
};

/// Coherence of the entry (row, column) of a response, one value for each line.
struct EntryCoherence {
  Eigen::Index row = 0;
  Eigen::Index column = 0;
  Eigen::VectorXd values;
};

/// A measured FRF matrix, with the coherence of the entries that have one.
struct MeasuredResponse {
  dynamics::ResponseModel response;
  std::vector<EntryCoherence> coherence;
  std::vector<std::string> notes;
};

/// The coherence of an entry, empty if there is none.
[[nodiscard]] Eigen::VectorXd coherence_of(const MeasuredResponse& measured, Eigen::Index row, Eigen::Index column);

/// The entries of a matrix, row by row, with its notes; `source` names its file.
[[nodiscard]] MeasuredEntries entries_of(const MeasuredResponse& measured, const std::string& source);

/// The entries as a matrix, with rows and columns in the order in which their DOFs appear. Throws DataError that names
/// every entry that is absent or occurs twice, has no direction, or has other frequencies than the first (relative
/// 1e-12). Cost O(n log n), and one copy of the values.
[[nodiscard]] MeasuredResponse response_matrix(const MeasuredEntries& measured);

}  // namespace thinwall::io
