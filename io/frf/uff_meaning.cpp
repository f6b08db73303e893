#include "io/frf/uff_meaning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"

namespace thinwall::io {

namespace {

using dynamics::Dof;
using dynamics::DofKind;

constexpr std::string_view remedy = "; state the quantity and its unit if you know them";
constexpr std::string_view correction = "; correct the file";

/// True for a data type that leaves the quantity open.
bool is_open(int type) {
  return type == uff::unknown_data || type == uff::general_data;
}

/// True for the type of a denominator that may be a force by the caller's statement.
bool may_be_force(int type) {
  return is_open(type) || type == uff::excitation_force || type == uff::reaction_force;
}

/// The text behind the words if the text starts with them.
std::optional<std::string_view> after(std::string_view text, std::string_view words) {
  if (!text.starts_with(words) || text.size() == words.size()) return std::nullopt;
  return text.substr(words.size());
}

Eigen::Vector3d vector_of(std::string_view text, const UffRecords& records) {
  Eigen::Vector3d vector;
  std::size_t start = 0;
  for (double& component : vector) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    component = real(records, text, start, end - start);
    start = std::min(end + 1, text.size());
  }
  return vector;
}

/// The DOF that record 6 alone gives.
Dof plain_dof(const UffDof& dof, const UffRecords& records) {
  const int axis = std::abs(dof.direction);
  if (axis > 6) refuse(records, "direction " + std::to_string(dof.direction) + " where -6 to 6 is expected");
  Dof plain;
  plain.point = is_label(dof.entity) ? dof.entity + ":" + std::to_string(dof.node) : "node " + std::to_string(dof.node);
  plain.kind = axis > 3 ? DofKind::rotation : DofKind::translation;
  if (axis > 0) plain.direction((axis - 1) % 3) = dof.direction > 0 ? 1.0 : -1.0;
  return plain;
}

void take_direction(Dof& dof, std::string_view words, int code, const UffRecords& records) {
  dof.direction = vector_of(words, records);
  if (direction_code(dof) != code || !(std::abs(dof.direction.norm() - 1.0) <= 1e-9)) {
    refuse(records, "a direction in record 6 that agrees with ID lines 4 and 5 is expected; was the file edited?");
  }
}

/// One side of the fraction: its name, its direction in record 6, its dimension if it is a translation or a rotation,
/// and its axis.
struct Side {
  const char* name;
  int direction;
  core::Dimension translation;
  core::Dimension rotation;
  bool is_response;
  bool is_acceleration;
  const UffAxis& axis;
};

/// Both sides of an FRF of this quantity.
std::pair<Side, Side> sides_of(const UffFunction& function, FrfQuantity quantity) {
  const int derivative = static_cast<int>(quantity);  // receptance 0, mobility 1, accelerance 2
  const Side motion{"response",
                    function.response.direction,
                    core::Dimension{1, 0, -derivative, 0, 0},
                    core::Dimension{0, 0, -derivative, 1, 0},
                    true,
                    derivative == 2,
                    function.numerator};
  const Side force{
      "force", function.reference.direction, core::Dimension{1, 1, -2, 0, 0}, core::Dimension{2, 1, -2, 0, 0}, false,
      false,   function.denominator};
  return {motion, force};
}

/// True if a DOF in this direction can be of the kind; direction 0 leaves the kind open.
bool may_be(DofKind kind, int direction) {
  return direction == 0 || (std::abs(direction) > 3) == (kind == DofKind::rotation);
}

/// The unit in SI by data set 164, in which numbers are divided by the factors.
double unit_by_164(const core::Dimension& dimension, const UffUnits& units) {
  // A moment is kg m²/s², a force kg m/s²: both have the mass of one force.
  const int forces = dimension.mass;
  const int lengths = dimension.length - forces;
  return std::pow(units.force, -forces) * std::pow(units.length, -lengths);
}

double unit_by_label(const Side& side, const std::optional<UffUnits>& units, const UffRecords& records, Dof& dof,
                     UffNotes& notes) {
  const auto unit = unit_of_label(side.axis.unit, side.is_acceleration);
  const std::string label = "the " + std::string(side.name) + "'s unit \"" + side.axis.unit + "\"";
  if (!unit) refuse(records, label + " is unknown" + std::string(remedy));
  const bool translates = unit->dimension == side.translation && may_be(DofKind::translation, side.direction);
  const bool rotates = unit->dimension == side.rotation && may_be(DofKind::rotation, side.direction);
  if (!translates && !rotates) {
    refuse(records, label + " is not of the dimension that its type and direction ask for" + std::string(correction));
  }
  dof.kind = translates ? DofKind::translation : DofKind::rotation;
  if (units) {
    const double other = unit_by_164(unit->dimension, *units);
    if (std::abs(unit->value / other - 1.0) > 1e-3) {
      note(notes, records, label + " is taken although data set 164 names another");
    }
  }
  return unit->value;
}

double unit_in_si(const Side& side, const std::optional<UffUnits>& units, const UffRecords& records, Dof& dof,
                  UffNotes& notes) {
  if (is_label(side.axis.unit)) return unit_by_label(side, units, records, dof, notes);
  const std::string what = "the unit of the " + std::string(side.name);
  if (!units) refuse(records, what + " is told neither by a label nor by a data set 164" + std::string(remedy));
  if (side.direction == 0) {
    refuse(records, what + " is told by no label, and its direction is 0 (scalar)" + std::string(remedy));
  }
  return unit_by_164(dof.kind == DofKind::rotation ? side.rotation : side.translation, *units);
}

std::optional<FrfQuantity> quantity_of(int numerator_type) {
  switch (numerator_type) {
    case uff::displacement:
      return FrfQuantity::receptance;
    case uff::velocity:
      return FrfQuantity::mobility;
    case uff::acceleration:
      return FrfQuantity::accelerance;
    default:
      return std::nullopt;
  }
}

std::string format_text(const FrfFormat& format) {
  const std::string factor = format.unit_in_si == 1.0 ? "" : core::number_text(format.unit_in_si) + " ";
  return core::word_of(format.quantity) + " in " + factor + si_unit(format.quantity);
}

[[noreturn]] void refuse_statement(const UffRecords& records, const std::string& stated, const std::string& told) {
  refuse(records, stated + " is stated, but the file says " + told +
                      ": leave out quantity and unit, or correct the one that is wrong");
}

/// Throws DataError if the data types of records 9 and 10 contradict the caller's statement.
void require_agreeing_types(const UffFunction& function, const FrfFormat& stated, const UffRecords& records) {
  const int motion = function.numerator.type, force = function.denominator.type;
  const bool same_motion = is_open(motion) || quantity_of(motion) == stated.quantity;
  const bool same_force = may_be_force(force);
  if (same_motion && same_force) return;
  const auto told = quantity_of(motion);
  refuse_statement(records, format_text(stated),
                   "data type " + std::to_string(motion) + " over " + std::to_string(force) +
                       " (data set 58, records 9 and 10)" + (told && same_force ? ", " + core::word_of(*told) : ""));
}

/// The unit of one side in SI; empty if neither a known label nor data set 164 gives it.
std::optional<double> told_unit(const Side& side, const std::optional<UffUnits>& units, DofKind kind,
                                const FrfFormat& stated, const UffRecords& records) {
  if (is_label(side.axis.unit)) {
    const auto unit = unit_of_label(side.axis.unit, side.is_acceleration);
    if (!unit) return std::nullopt;
    if (unit->dimension == side.translation || unit->dimension == side.rotation) return unit->value;
    refuse_statement(records, format_text(stated),
                     "the unit \"" + side.axis.unit + "\" of the " + side.name + " (data set 58, record " +
                         (side.is_response ? "9" : "10") + ")");
  }
  if (!units || is_open(side.axis.type) || side.direction == 0) return std::nullopt;
  return unit_by_164(kind == DofKind::rotation ? side.rotation : side.translation, *units);
}

/// The caller's format. Throws DataError if something in the file contradicts it, and notes what the file leaves open.
FrfFormat agreed(const FrfFormat& stated, const UffFunction& function, const Side& motion, const Side& force,
                 const std::optional<UffUnits>& units, const UffRecords& records, const UffDofs& dofs,
                 UffNotes& notes) {
  require_agreeing_types(function, stated, records);
  const auto motion_unit = told_unit(motion, units, dofs.response.kind, stated, records);
  const auto force_unit = told_unit(force, units, dofs.force.kind, stated, records);
  // If only the unit of the motion is given, that of the force is taken as newtons.
  const double told_in_si = motion_unit.value_or(1.0) / force_unit.value_or(1.0);
  if (motion_unit && std::abs(told_in_si / stated.unit_in_si - 1.0) > 1e-3) {
    const bool labelled = is_label(motion.axis.unit) || is_label(force.axis.unit);
    const FrfFormat told{stated.quantity, told_in_si, 1.0};
    refuse_statement(records, format_text(stated),
                     format_text(told) + (labelled ? " (data set 58, records 9 and 10)" : " (data set 164)"));
  }
  const bool open = is_open(function.numerator.type) || function.denominator.type != uff::excitation_force;
  if (open || !motion_unit || !force_unit) {
    note(notes, records,
         "read as " + format_text(stated) + ", as stated; the file has data types " +
             std::to_string(function.numerator.type) + " over " + std::to_string(function.denominator.type) + " in \"" +
             function.numerator.unit + "\" over \"" + function.denominator.unit + "\"");
  }
  return stated;
}

/// The unit of an axis of frequencies in Hz; empty if it is another axis.
std::optional<double> frequency_unit(const UffAxis& axis) {
  const bool unnamed = is_open(axis.type);
  if (axis.type != uff::frequency && !unnamed) return std::nullopt;
  if (!is_label(axis.unit)) return unnamed ? std::nullopt : std::optional(1.0);
  const auto unit = unit_of_label(axis.unit, false);
  if (unit && unit->dimension == core::Dimension{0, 0, -1, 0, 0}) return unit->value;
  if (unit && unit->dimension == core::Dimension{0, 0, -1, 1, 0}) return unit->value / (2.0 * std::numbers::pi);
  return std::nullopt;
}

}  // namespace

int direction_code(const Dof& dof) {
  const int offset = dof.kind == DofKind::rotation ? 3 : 0;
  for (int k = 0; k < 3; ++k) {
    if (dof.direction == Eigen::Vector3d::Unit(k)) return k + 1 + offset;
    if (dof.direction == -Eigen::Vector3d::Unit(k)) return -(k + 1 + offset);
  }
  return 0;
}

UffDofs dofs_of(const UffFunction& function, const UffRecords& records) {
  UffDofs dofs{plain_dof(function.response, records), plain_dof(function.reference, records)};
  const auto& words = function.type == uff::coherence ? uff::coherence_point_words : uff::response_point_words;
  const auto response_point = after(function.id[0], words);
  const auto force_point = after(function.id[1], uff::force_point_words);
  const auto response = after(function.id[3], uff::response_direction_words);
  const auto force = after(function.id[4], uff::force_direction_words);
  if (!response_point || !force_point || !response || !force) return dofs;
  dofs.response.point = *response_point;
  dofs.force.point = *force_point;
  take_direction(dofs.response, *response, function.response.direction, records);
  take_direction(dofs.force, *force, function.reference.direction, records);
  return dofs;
}

FrfFormat format_of(const UffFunction& function, const std::optional<UffUnits>& units,
                    const std::optional<FrfFormat>& stated, const UffRecords& records, UffDofs& dofs, UffNotes& notes) {
  if (stated) {
    const auto [motion, force] = sides_of(function, stated->quantity);
    return agreed(*stated, function, motion, force, units, records, dofs, notes);
  }
  const auto quantity = quantity_of(function.numerator.type);
  if (!quantity) {
    refuse(records, "specific data type " + std::to_string(function.numerator.type) +
                        " where 8 (displacement), 11 (velocity) or 12 (acceleration) is expected" +
                        std::string(is_open(function.numerator.type) ? remedy : correction));
  }
  if (function.denominator.type != uff::excitation_force) {
    refuse(records, "specific data type " + std::to_string(function.denominator.type) +
                        " of the denominator where 13 (excitation force) is expected" +
                        std::string(may_be_force(function.denominator.type) ? remedy : correction));
  }
  const auto [motion, force] = sides_of(function, *quantity);
  const double motion_unit = unit_in_si(motion, units, records, dofs.response, notes);
  return {*quantity, motion_unit / unit_in_si(force, units, records, dofs.force, notes), 1.0};
}

double abscissa_in_hz(const UffFunction& function, const std::optional<FrfFormat>& stated, const UffRecords& records,
                      UffNotes& notes) {
  const UffAxis& axis = function.abscissa;
  const auto told = frequency_unit(axis);
  const bool of_frequency = axis.type == uff::frequency || is_open(axis.type);
  const bool known = is_label(axis.unit) && unit_of_label(axis.unit, false).has_value();
  const bool open = of_frequency && !known;  // the caller's statement may then supply the unit
  if (stated) {
    if (told && std::abs(*told / stated->unit_in_hz - 1.0) <= 1e-9) return stated->unit_in_hz;
    const std::string file_says =
        "data type " + std::to_string(axis.type) + " in \"" + axis.unit + "\" (data set 58, record 8)";
    if (!open) {
      refuse(records, "frequencies in " + core::number_text(stated->unit_in_hz) + " Hz are stated, but the file says " +
                          file_says + ": state the frequency_unit that it has, or correct the file");
    }
    note(notes, records, "the frequencies are taken in the unit that is stated; the file has " + file_says);
    return stated->unit_in_hz;
  }
  if (told) return *told;
  refuse(records, "specific data type " + std::to_string(axis.type) + " of the abscissa in \"" + axis.unit +
                      "\" where 18 (frequency) is expected" + std::string(open ? remedy : correction));
}

}  // namespace thinwall::io
