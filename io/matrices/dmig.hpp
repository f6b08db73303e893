#pragma once
// Matrices as DMIG entries of Nastran's bulk data: punch files of superelements and of DMAP alters.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/sparse_model.hpp"
#include "io/matrices/matrix_entries.hpp"

namespace thinwall::io {

/// One matrix of a file. Entries are there of square ones (form 1, and 6: symmetric, one triangle) of real numbers
/// (type 1 or 2); others are known by name only.
struct DmigMatrix {
  int form = 0;
  int type = 0;
  int line = 0;  ///< of its heading
  LabelledEntries labelled;
};

/// A file's matrices in their order, and the positions that its GRID entries state.
struct DmigFile {
  std::vector<DmigMatrix> matrices;
  std::map<int, Eigen::Vector3d> positions;
};

/// Reads the DMIG and GRID entries in small or large fields or free format. Scalar points (component 0 or blank) are
/// amplitudes. Throws DataError with file and line: a column before its heading, a heading twice, a row that is cut
/// short, text where a number belongs, a GRID entry in coordinate systems of its own, no DMIG entry. Cost O(bytes).
[[nodiscard]] DmigFile read_dmig(std::string_view bytes, const std::string& name);

/// The matrix called `wanted`; without it the only one whose name begins with `letter` (K without K4, M, B). Throws
/// DataError, listing the names that are there, if there is none or more than one, or if it is rectangular or complex.
[[nodiscard]] const DmigMatrix& dmig_matrix(const DmigFile& file, const std::string& wanted, char letter,
                                            const std::string& name);

/// Writes the matrices of a model as KAAX, MAAX and BAAX in large fields, symmetric ones (bit by bit) as form 6, with a
/// GRID entry for each node that has a position and SPOINT for amplitudes. A field has 16 columns: returns the largest
/// relative rounding of a matrix entry, 0 if all were exact (io/matrices/nastran_cards.hpp); 5e-12 for entries within
/// 1e±9. Throws InputError as require_consistent() and for a node number that Nastran cannot have (1 to 100000000),
/// DataError if the file cannot be written.
double write_dmig(const std::filesystem::path& path, const dynamics::SparseModel& model);

}  // namespace thinwall::io
