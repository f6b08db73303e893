#pragma once
// The meaning of a data set 58: its DOFs, its quantity and its units.

#include <optional>

#include "dynamics/dof.hpp"
#include "io/frf/frf_quantity.hpp"
#include "io/frf/uff_function.hpp"
#include "io/frf/uff_units.hpp"

namespace thinwall::io {

/// Words of the ID lines that this program writes. They keep the names of points, for which the format has numbers
/// only, and directions that are along no axis.
namespace uff {
constexpr std::string_view response_point_words = "receptance at ";
constexpr std::string_view coherence_point_words = "coherence at ";
constexpr std::string_view force_point_words = "force at ";
constexpr std::string_view response_direction_words = "response ";
constexpr std::string_view force_direction_words = "force ";
}  // namespace uff

/// Direction of a DOF in record 6: ±1…±3, ±4…±6, or 0 if it is along none of the axes.
[[nodiscard]] int direction_code(const dynamics::Dof& dof);

/// The DOFs of a function.
struct UffDofs {
  dynamics::Dof response;
  dynamics::Dof force;
};

/// The DOFs by the ID lines of this program if all four are present, otherwise by record 6: points are "node 12", or
/// "wing:12" with an entity name, directions are along the axes, and a direction 0 (scalar) remains zero. Throws
/// DataError (about `records`) if ID lines contradict record 6 or a direction is invalid.
[[nodiscard]] UffDofs dofs_of(const UffFunction& function, const UffRecords& records);

/// Quantity and units of an FRF. The quantity follows from the type of the numerator (8 displacement, 11 velocity, 12
/// acceleration) over that of the denominator (13 excitation force); the units from the axis labels, which have
/// precedence in the format, or, without labels, from data set 164. A DOF in direction 0 is a rotation if its label has
/// the dimension of one, and is set to it in `dofs`.
///
/// The caller's statement supplies what the file leaves open, which is noted: data types 0 (unknown) and 1 (general), a
/// reaction force (9) for a force, a unit that no known label and no data set 164 gives. It overrides nothing: throws
/// DataError, with the statement, the file's data and its records, for another quantity, a label of another dimension,
/// and another scale (relative 1e-3). Without a statement throws DataError for another type, an unknown label, a label
/// of another dimension, and missing units, because nothing is guessed.
[[nodiscard]] FrfFormat format_of(const UffFunction& function, const std::optional<UffUnits>& units,
                                  const std::optional<FrfFormat>& stated, const UffRecords& records, UffDofs& dofs,
                                  UffNotes& notes);

/// The unit of the abscissa in Hz: that of type 18 (frequency), or of an unknown or general type whose label is a
/// frequency. The caller's statement must agree (relative 1e-9), or supplies the unit, with a note, if such a type has
/// no label or an unknown one. Throws DataError for other types and labels.
[[nodiscard]] double abscissa_in_hz(const UffFunction& function, const std::optional<FrfFormat>& stated,
                                    const UffRecords& records, UffNotes& notes);

}  // namespace thinwall::io
