#pragma once
// Matrices of a consistent system of units that is not SI: mm, t, s and its likes.

#include <string>

#include "dynamics/sparse_model.hpp"

namespace thinwall::dynamics {

/// Units of length and mass with the second as that of time; force follows: "mm, t, s" is N and MPa, "mm, kg, s" is mN.
struct UnitSystem {
  double metres_per_unit = 0.0;
  double kilograms_per_unit = 0.0;
};

/// From names of units, "mm" and "t". There is no silent default: throws InputError if one is empty, is no unit, or is
/// one of another dimension.
[[nodiscard]] UnitSystem unit_system(const std::string& length, const std::string& mass);

/// The model in m, kg, s. With l metres and m kilograms a unit,
///
///     A_SI = m l² S A S,   S = diag(1/l of a translation, 1 of a rotation, 1/(l √m) of an amplitude)
///
/// for K, M and C alike, so that amplitudes of mass-normalised modes stay so; positions times l. K between translations
/// is multiplied by m, with a rotation by m l, between rotations by m l². A factor of 1 leaves the bits as they are.
/// Throws InputError unless l and m are positive and finite. Cost O(nnz).
[[nodiscard]] SparseModel in_si(SparseModel model, const UnitSystem& units);

}  // namespace thinwall::dynamics
