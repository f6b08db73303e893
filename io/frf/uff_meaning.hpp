#pragma once
// The meaning of a data set 58: between which DOFs it was measured, of which quantity, in which units.

#include <optional>

#include "dynamics/dof.hpp"
#include "io/frf/frf_quantity.hpp"
#include "io/frf/uff_function.hpp"
#include "io/frf/uff_units.hpp"

namespace thinwall::io {

/// ID lines of our own: they keep the names of points, which the format numbers, and directions off the axes.
namespace uff {
constexpr std::string_view response_point_words = "receptance at ";
constexpr std::string_view coherence_point_words = "coherence at ";
constexpr std::string_view force_point_words = "force at ";
constexpr std::string_view response_direction_words = "response ";
constexpr std::string_view force_direction_words = "force ";
}  // namespace uff

/// Direction of record 6: ±1…±3, ±4…±6, or 0 where it is along none of the axes.
[[nodiscard]] int direction_code(const dynamics::Dof& dof);

/// The DOFs of a function.
struct UffDofs {
  dynamics::Dof response;
  dynamics::Dof force;
};

/// DOFs by our ID lines where all four are there, else by record 6: points are "node 12", or "wing:12" with an entity
/// name, directions along the axes; a direction 0 (scalar) stays zero. Throws DataError (about `records`) if ID lines
/// contradict record 6 or a direction is none.
[[nodiscard]] UffDofs dofs_of(const UffFunction& function, const UffRecords& records);

/// Quantity and units of an FRF. The quantity follows from the numerator's type, 8 displacement, 11 velocity, 12
/// acceleration, over the denominator's, 13 excitation force; the units from the axis labels, which by the format come
/// before anything else, or where there is none from data set 164. A DOF in direction 0 is a rotation if its label
/// says so, and is set to it in `dofs`.
///
/// What the caller states fills in what the file leaves open, which is noted: data types 0 (unknown) and 1 (general),
/// a reaction force (9) for a force, a unit that no known label and no data set 164 tells. It goes over nothing: throws
/// DataError, with what is stated, what the file says and its records, for another quantity, a label of another
/// dimension, another scale (relative 1e-3). Without a statement throws DataError for another type, an unknown label, a
/// label of another dimension, units that are not told: nothing is guessed.
[[nodiscard]] FrfFormat format_of(const UffFunction& function, const std::optional<UffUnits>& units,
                                  const std::optional<FrfFormat>& stated, const UffRecords& records, UffDofs& dofs,
                                  UffNotes& notes);

/// The unit of the abscissa in Hz: that of type 18 (frequency), or of an unknown or general type whose label is a
/// frequency. What the caller states must agree (relative 1e-9), or fills in, noted, where such a type has no label or
/// an unknown one. Throws DataError for other types and labels.
[[nodiscard]] double abscissa_in_hz(const UffFunction& function, const std::optional<FrfFormat>& stated,
                                    const UffRecords& records, UffNotes& notes);

}  // namespace thinwall::io
