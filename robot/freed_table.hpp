#pragma once
// A table of modes freed of a mass that sat on the structure when it was tapped.

#include <string>

#include "dynamics/modal_table.hpp"

namespace thinwall::robot {

/// A table without a mass, and how well the modes tell what is left.
struct FreedTable {
  dynamics::ModalTable table;  ///< by rising frequency, with as many rows
  double condition = 1.0;  ///< ‖(1 − m Σ φφᵀ)⁻¹‖₂ at the point: relative errors of the modal masses there, which are
                           ///< those of the table, grow by so much
};

/// The modes of a structure from those that were found with a mass m (kg) of a sensor or a rigid tool at `point`. With
/// the table's poles λ, responses C and forces B at its DOFs, and p the translations of the point,
///
///     ẋ = Λx + B f + B_p u,    y = C x,    u = m ÿ_p
///
/// takes the mass off, for H_free = (1 + ω² m H_pp)⁻¹ H at the point (Ewins 2000, chapter 3, mass cancellation): the
/// receptance of the sum of all rows, exactly where C B = 0, as of a table that leaves no mode out. Its poles are the
/// eigenvalues of
///
///     s [ 1          0        ] z = [ Λ  B_p ] z,    z = (x, u)
///       [ m C_p Λ    m C_p B_p ]    [ 0  1   ]
///
/// and residues those of its eigenvectors. Modes that the table leaves out are no part of it: they would move with the
/// mass, too, so that a table should reach well beyond the modes that matter. Rotations of the mass are not taken off.
///
/// Throws InputError for a mass that is not above 0, a point that the table has not, has no translation or is at
/// different places in different rows (modal_model()), and for a mass of which the modes at the point have not as much,
/// so that less than nothing would move on. Cost O((2 rows + 3)³).
[[nodiscard]] FreedTable without_point_mass(const dynamics::ModalTable& table, const std::string& point,
                                            double mass_kg);

}  // namespace thinwall::robot
