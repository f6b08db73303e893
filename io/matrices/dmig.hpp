#pragma once
// Matrices as DMIG entries of Nastran's bulk data, from punch files of superelements and of DMAP alters.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/sparse_model.hpp"
#include "io/matrices/matrix_entries.hpp"

namespace thinwall::io {

/// One matrix of a file. Entries are read of square matrices (form 1, and 6: symmetric, one triangle) of real numbers
/// (type 1 or 2); others are known by name only.
struct DmigMatrix {
  int form = 0;
  int type = 0;
  int line = 0;  ///< line of its heading
  LabelledEntries labelled;
};

/// The matrices of a file in their order, and the positions that its GRID entries state.
struct DmigFile {
  std::vector<DmigMatrix> matrices;
  std::map<int, Eigen::Vector3d> positions;
};

/// Reads the DMIG and GRID entries in small or large fields or free format. Scalar points (component 0 or blank) are
/// amplitudes. Throws DataError with file and line for a column before its heading, a repeated heading, an incomplete
/// row, text in place of a number, a GRID entry in another coordinate system, and a file without DMIG entries. Cost
/// O(bytes).
[[nodiscard]] DmigFile read_dmig(std::string_view bytes, const std::string& name);

/// The matrix called `wanted`; if that is empty, the only one whose name begins with `letter` (K, but not K4; M; B).
/// Throws DataError, with a list of all names, if there is none or more than one, or if it is rectangular or complex.
[[nodiscard]] const DmigMatrix& dmig_matrix(const DmigFile& file, const std::string& wanted, char letter,
                                            const std::string& name);

/// Writes the matrices of a model as KAAX, MAAX and BAAX in large fields, symmetric ones (bit by bit) as form 6, with a
/// GRID entry for each node that has a position and SPOINT for amplitudes. A field has 16 columns: returns the largest
/// relative rounding of a matrix entry, 0 if all were exact (io/matrices/nastran_cards.hpp); 5e-12 for entries within
/// 1e±9. Throws InputError as require_consistent() does and for a node number that Nastran does not allow (it must be 1
/// to 100000000), DataError if the file cannot be written.
double write_dmig(const std::filesystem::path& path, const dynamics::SparseModel& model);

}  // namespace thinwall::io
