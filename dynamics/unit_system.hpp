#pragma once
// Conversion to SI of matrices in another consistent system of units, such as mm, t, s.

#include <string>

#include "dynamics/sparse_model.hpp"

namespace thinwall::dynamics {

/// The units of length and mass, with the second as that of time; the unit of force follows: "mm, t, s" has N and MPa,
/// "mm, kg, s" has mN.
struct UnitSystem {
  double metres_per_unit = 0.0;
  double kilograms_per_unit = 0.0;
};

/// The system of units with the named units, such as "mm" and "t". There is no silent default: throws InputError if a
/// name is empty, is no unit, or has another dimension.
[[nodiscard]] UnitSystem unit_system(const std::string& length, const std::string& mass);

/// The model converted to m, kg, s. With l metres and m kilograms a unit,
///
///     A_SI = m l² S A S,   S = diag(1/l of a translation, 1 of a rotation, 1/(l √m) of an amplitude)
///
/// for K, M and C alike, so that mass-normalised modes stay mass-normalised; positions are multiplied by l. An entry of
/// K between two translations is multiplied by m, between a translation and a rotation by m l, between two rotations by
/// m l². A factor of 1 leaves the bits as they are. Throws InputError unless l and m are positive and finite. Cost
/// O(nnz).
[[nodiscard]] SparseModel in_si(SparseModel model, const UnitSystem& units);

}  // namespace thinwall::dynamics
