#pragma once
// Matrices as lines of numbers: CalculiX MATRIXSTORAGE (.sti, .mas, .dof) and Abaqus *MATRIX OUTPUT (.mtx).
//
// CalculiX: "row column value", from 1, the upper triangle; "node.component" a line names the rows (Dhondt, CalculiX
// CrunchiX User's Manual 2.20, *FREQUENCY). Abaqus FORMAT=COORDINATE: "row column value"; FORMAT=MATRIX INPUT and
// LABELS: "row node, component, column node, component, value", one triangle of symmetric matrices or both (Abaqus
// Keywords Reference, *MATRIX INPUT, *MATRIX OUTPUT). Fields are separated by blanks or commas; lines from "**" are
// comments.

#include <string>
#include <string_view>
#include <vector>

#include "io/matrices/matrix_entries.hpp"

namespace thinwall::io {

/// Number of fields on the first line that is no comment: 3, 5, or any other number.
[[nodiscard]] int fields_of_first_line(std::string_view bytes);

/// The entries of lines "row column value"; the size is the largest row or column. Throws DataError with file and line
/// for another number of fields, an invalid index, a number that is not finite, and a file without entries. Cost
/// O(bytes).
[[nodiscard]] MatrixEntries triplet_entries(std::string_view bytes, const std::string& name);

/// The entries of lines "row node, component, column node, component, value"; lines that begin with '*' are keywords
/// and are skipped. Nodes that Abaqus has added itself have negative numbers. Throws as triplet_entries() does, and for
/// a component other than 0 to 6 (temperatures, pressures). Cost O(bytes).
[[nodiscard]] LabelledEntries labelled_triplets(std::string_view bytes, const std::string& name);

/// The lines "node.component" of a .dof file, in the order of the rows. Throws DataError with file and line. Cost
/// O(bytes).
[[nodiscard]] std::vector<dynamics::NodeDof> ccx_dofs(std::string_view bytes, const std::string& name);

}  // namespace thinwall::io
