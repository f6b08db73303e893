#pragma once
// The FRFs of a roving test: one sensor or hammer stays, its reference, and the other one moves over the structure.

#include <optional>
#include <vector>

#include "dynamics/dof.hpp"
#include "io/frf/measured_response.hpp"

namespace thinwall::io {

/// The FRFs of a test with one reference as one column.
struct ReferenceColumn {
  MeasuredResponse measured;  ///< every DOF as a response, the reference as the only force
  int by_reciprocity = 0;     ///< entries that were taken from their transpose: the hammer moved there
  int driving_point = -1;     ///< row of the reference itself; −1: it was not measured
};

/// The DOF that all entries have in common, as response or as force, along the positive axis (the entry of its largest
/// component is positive). Where several qualify, as with a single entry, it is the one of which the driving point was
/// measured, or else the force of the first entry. Empty if there is none. Cost O(entries).
[[nodiscard]] std::optional<dynamics::Dof> reference_of(const std::vector<MeasuredEntry>& entries);

/// The column H_aR of the reference R: an entry of a force at R stands as it is, one of a response at R, where the
/// hammer moved, is H_aR = H_Ra by reciprocity (Maxwell, Betti). All DOFs are turned along their positive axes, with
/// the sign of H, so that a hammer along −z and a sensor along +z are one DOF. Of a pair that was measured both ways
/// the force at R counts, and a note says by how much the other one differs. Throws DataError where the entries have
/// no common reference, and as response_matrix(). Cost O(n log n), and a copy of the values.
[[nodiscard]] ReferenceColumn reference_column(const MeasuredEntries& measured);

}  // namespace thinwall::io
