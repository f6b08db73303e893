#include "io/matrices/matrix_files.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "dynamics/unit_system.hpp"
#include "io/matrices/dmig.hpp"
#include "io/matrices/dof_table_csv.hpp"
#include "io/matrices/mat_sparse.hpp"
#include "io/matrices/mat_version.hpp"
#include "io/matrices/matrix_entries.hpp"
#include "io/matrices/matrix_format.hpp"
#include "io/matrices/matrix_market.hpp"
#include "io/matrices/matrix_triplets.hpp"
#include "io/matrices/netcdf.hpp"
#include "io/matrices/op2.hpp"
#include "io/matrices/op4.hpp"
#include "io/matrices/superelement.hpp"
#include "io/surface_text.hpp"

namespace thinwall::io {

namespace {

using dynamics::NodeDof;
using dynamics::SparseModel;

enum class Format { mat, matrix_market, dmig, netcdf, op2, op4, labelled, triplets };

const char* name_of(Format format) {
  switch (format) {
    case Format::mat:
      return "MAT";
    case Format::matrix_market:
      return "Matrix Market";
    case Format::dmig:
      return "Nastran DMIG";
    case Format::netcdf:
      return "NetCDF superelement";
    case Format::op2:
      return "Nastran OP2";
    case Format::op4:
      return "Nastran OP4";
    case Format::labelled:
      return "Abaqus matrix input";
    case Format::triplets:
      break;
  }
  return "row, column, value (CalculiX, Abaqus coordinate)";
}

bool has_dmig(std::string_view bytes) {
  bool found = false;
  for (std::size_t at = 0; !found && at < bytes.size(); at = std::min(bytes.find('\n', at), bytes.size() - 1) + 1)
    found = lower_case(bytes.substr(at, 4)) == "dmig";
  return found;
}

Format format_of(std::string_view bytes, const std::string& path) {
  if (is_netcdf4(bytes)) {
    throw core::DataError(path +
                          ": is NetCDF-4 (HDF5); write it in the classic format, by nccopy -k 64-bit-offset IN OUT");
  }
  if (is_netcdf(bytes)) return Format::netcdf;
  if (mat_version(bytes) != MatVersion::none) return Format::mat;
  if (is_matrix_market(bytes)) return Format::matrix_market;
  if (is_op2(bytes)) return Format::op2;
  if (is_op4(bytes)) return Format::op4;
  const int fields = fields_of_first_line(bytes);
  const auto first = bytes.find_first_not_of(" \t\r\n");
  constexpr std::string_view begins_numbers = "0123456789+-*";
  const bool numbers = first != std::string_view::npos && begins_numbers.find(bytes[first]) != std::string_view::npos;
  if (numbers && fields == 3) return Format::triplets;
  if (numbers && fields == 5) return Format::labelled;
  if (has_dmig(bytes)) return Format::dmig;
  throw core::DataError(
      path +
      ": is no matrix that is known: Matrix Market (%%MatrixMarket), CalculiX .sti or .mas and Abaqus "
      ".mtx (lines of three or five numbers), Nastran DMIG, OP2 and OP4, MAT, NetCDF superelements");
}

/// The three matrices of the files, by row or by label; a matrix that is not given has no path.
struct Matrices {
  Format format = Format::triplets;
  std::array<MatrixEntries, 3> rows;
  std::array<LabelledEntries, 3> labelled;
  std::map<int, Eigen::Vector3d> positions;
  SparseModel superelement;
  [[nodiscard]] bool by_label() const { return format == Format::dmig || format == Format::labelled; }
};

/// Calls `take(k, name, letter)` for the matrices that are taken of a file which may hold several: its own, and of the
/// file of the stiffness also those for which no file is stated. `names` are those of its matrices.
template <class Take>
void take_several(const MatrixFiles& files, std::size_t which, const std::vector<std::string>& names, Take take) {
  const std::array wanted{files.stiffness_name, files.mass_name, files.damping_name};
  constexpr std::array letters{'K', 'M', 'B'};
  const std::array<bool, 3> here{which == 0, which == 1 || (which == 0 && files.mass.empty()),
                                 which == 2 || (which == 0 && files.damping.empty())};
  for (std::size_t k = 0; k < 3; ++k) {
    const bool is_there = !wanted[k].empty() || std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return name.starts_with(letters[k]);
    });
    if (here[k] && (k != 2 || which == 2 || is_there)) take(k, wanted[k], letters[k]);
  }
}

void take_dmig(const std::string& bytes, const std::string& path, const MatrixFiles& files, std::size_t which,
               Matrices& matrices) {
  const DmigFile file = read_dmig(bytes, path);
  std::vector<std::string> names;
  for (const DmigMatrix& matrix : file.matrices) names.push_back(matrix.labelled.name);
  take_several(files, which, names, [&](std::size_t k, const std::string& wanted, char letter) {
    matrices.labelled[k] = dmig_matrix(file, wanted, letter, path).labelled;
  });
  matrices.positions.insert(file.positions.begin(), file.positions.end());
}

/// Takes the matrices of a file of OUTPUT2 or OUTPUT4.
void take_nastran(const std::vector<NastranMatrix>& file, const std::string& path, const MatrixFiles& files,
                  std::size_t which, Matrices& matrices) {
  std::vector<std::string> names;
  names.reserve(file.size());
  for (const NastranMatrix& matrix : file) names.push_back(matrix.name);
  take_several(files, which, names, [&](std::size_t k, const std::string& wanted, char letter) {
    matrices.rows[k] = nastran_matrix(file, wanted, letter, path);
  });
}

/// Takes a file that contains all matrices and their DOFs.
void take_superelement(const std::string& bytes, const std::string& path, std::size_t which, Matrices& matrices) {
  if (which != 0)
    throw core::DataError(path + ": a NetCDF superelement holds all matrices: state it as the stiffness alone");
  matrices.superelement = read_superelement(bytes, path);
}

Matrices take_files(const MatrixFiles& files) {
  Matrices matrices;
  const std::array paths{files.stiffness, files.mass, files.damping};
  for (std::size_t k = 0; k < 3; ++k) {
    if (paths[k].empty()) continue;
    const std::string path = paths[k].string();
    const std::string bytes = core::read_file(paths[k]);
    const Format format = format_of(bytes, path);
    if (k == 0) matrices.format = format;
    if (format != matrices.format) {
      throw core::DataError(path + ": is of the format " + name_of(format) + ", the stiffness of " +
                            name_of(matrices.format) + ": take all matrices from one export");
    }
    if (format == Format::matrix_market) matrices.rows[k] = matrix_market_entries(bytes, path);
    if (format == Format::triplets) matrices.rows[k] = triplet_entries(bytes, path);
    if (format == Format::labelled) matrices.labelled[k] = labelled_triplets(bytes, path);
    if (format == Format::dmig) take_dmig(bytes, path, files, k, matrices);
    if (format == Format::netcdf) take_superelement(bytes, path, k, matrices);
    if (format == Format::op2) take_nastran(read_op2(bytes, path), path, files, k, matrices);
    if (format == Format::op4) take_nastran(read_op4(bytes, path), path, files, k, matrices);
  }
  return matrices;
}

std::optional<DofTableFile> table_of(const std::filesystem::path& path) {
  if (path.empty()) return std::nullopt;
  const std::string bytes = core::read_file(path);
  const std::string_view first_line = std::string_view(bytes).substr(0, bytes.find('\n'));
  const bool ccx = first_line.find_first_not_of("0123456789. \r") == std::string_view::npos && !first_line.empty();
  if (ccx) return DofTableFile{ccx_dofs(bytes, path.string()), {}, {}};
  return read_dof_table(path);
}

void require_rows(const MatrixEntries& matrix, Format format, std::size_t rows) {
  const auto size = static_cast<std::size_t>(matrix.size);
  // A file of row, column, value does not show rows without an entry at its end.
  if (size == rows || (format == Format::triplets && size < rows && size + 6 > rows)) return;
  throw core::DataError(matrix.path + ": has " + std::to_string(size) + " rows and the DOF table " +
                        std::to_string(rows) + ": they must come from one export");
}

void require_labels(const std::vector<NodeDof>& dofs, std::vector<NodeDof> table, const std::string& path) {
  std::sort(table.begin(), table.end());
  for (const NodeDof& dof : dofs) {
    if (std::binary_search(table.begin(), table.end(), dof)) continue;
    throw core::DataError(path + ": node " + std::to_string(dof.node) + ", component " + std::to_string(dof.component) +
                          " of the matrices is not in the DOF table: they must come "
                          "from one export");
  }
}

void note_half(const WholeMatrix& whole, const std::string& path, std::vector<std::string>& notes) {
  if (whole.was_half)
    notes.push_back(path + " holds one triangle of a symmetric matrix; the other is its mirror image");
}

/// Makes K, M, C of the model on the rows of its table.
void assemble(Matrices& matrices, SparseModel& model, std::vector<std::string>& notes) {
  const std::array<Eigen::SparseMatrix<double>*, 3> targets{&model.K, &model.M, &model.C};
  for (std::size_t k = 0; k < 3; ++k) {
    MatrixEntries& entries = matrices.rows[k];
    if (matrices.by_label() && !matrices.labelled[k].path.empty()) entries = in_rows(matrices.labelled[k], model.dofs);
    if (entries.path.empty()) continue;
    require_rows(entries, matrices.format, model.dofs.size());
    entries.size = static_cast<int>(model.dofs.size());
    const WholeMatrix whole = whole_matrix(entries);
    note_half(whole, entries.path, notes);
    *targets[k] = whole.A;
  }
}

SparseModel model_of_text(const MatrixFiles& files, Matrices& matrices, const std::optional<DofTableFile>& table,
                          std::vector<std::string>& notes) {
  SparseModel model;
  if (matrices.by_label()) {
    std::vector<const LabelledEntries*> all;
    for (const LabelledEntries& labelled : matrices.labelled) all.push_back(&labelled);
    model.dofs = dofs_of(all);
    if (table) require_labels(model.dofs, table->dofs, dof_table_path(files).string());
  } else if (table) {
    model.dofs = table->dofs;
  } else {
    throw core::DataError(files.stiffness.string() +
                          ": numbers its rows only; state the DOF table that says which row is which (dofs)");
  }
  model.positions = matrices.positions;
  assemble(matrices, model, notes);
  return model;
}

void note_rows(const SparseModel& model, std::vector<std::string>& notes) {
  const Eigen::VectorXd k = model.K.diagonal(), m = model.M.diagonal();
  std::vector<Eigen::Index> empty;
  for (Eigen::Index row = 0; row < k.size(); ++row)
    if (k(row) == 0.0 && m(row) == 0.0) empty.push_back(row);
  if (empty.empty()) return;
  notes.push_back(std::to_string(empty.size()) + " DOFs have neither stiffness nor mass, the first " +
                  name(dynamics::named(model, model.dofs[static_cast<std::size_t>(empty.front())])));
}

/// Keeps the positions of nodes with DOFs, and notes missing ones.
void settle_positions(SparseModel& model, std::vector<std::string>& notes) {
  std::map<int, Eigen::Vector3d> kept;
  int missing = 0, first = 0;
  for (const NodeDof& dof : model.dofs) {
    const auto found = model.positions.find(dof.node);
    if (found != model.positions.end()) kept.insert(*found);
    if (found != model.positions.end() || dof.component == 0) continue;
    if (missing++ == 0) first = dof.node;
  }
  model.positions = std::move(kept);
  if (missing > 0 && !model.positions.empty())
    notes.push_back(std::to_string(missing) + " DOFs are of nodes without a position, the first of node " +
                    std::to_string(first));
}

/// Throws DataError if the table contains a DOF twice.
void require_each_once(const std::vector<NodeDof>& dofs, const std::filesystem::path& path) {
  std::map<NodeDof, std::size_t> first;
  for (std::size_t row = 0; row < dofs.size(); ++row) {
    const auto [known, is_new] = first.emplace(dofs[row], row);
    if (is_new) continue;
    throw core::DataError(path.string() + ": rows " + std::to_string(known->second + 1) + " and " +
                          std::to_string(row + 1) + " are both " + name(dynamics::named({}, dofs[row])) +
                          "; the table must name each DOF once: export it again");
  }
}

}  // namespace

bool may_hold_several_matrices(const std::filesystem::path& path) {
  const Format format = format_of(core::read_file(path), path.string());
  return format == Format::mat || format == Format::dmig || format == Format::netcdf || format == Format::op2 ||
         format == Format::op4;
}

std::filesystem::path dof_table_path(const MatrixFiles& files) {
  if (!files.dofs.empty() || files.stiffness.empty()) return files.dofs;
  std::filesystem::path path = files.stiffness;
  path.replace_extension(".dof");
  const bool is_there = path != files.stiffness && std::filesystem::exists(path);
  return is_there ? path : std::filesystem::path();
}

ImportedMatrices read_matrices(const MatrixFiles& files) {
  const dynamics::UnitSystem units = dynamics::unit_system(files.length_unit, files.mass_unit);
  ImportedMatrices imported;
  Matrices matrices = take_files(files);
  imported.format = name_of(matrices.format);
  const std::optional<DofTableFile> table = table_of(dof_table_path(files));
  if (table) require_each_once(table->dofs, dof_table_path(files));
  const bool is_mat = matrices.format == Format::mat;
  if (is_mat || matrices.format == Format::netcdf) {
    imported.model = is_mat ? read_sparse_mat(MatFiles{files.stiffness, files.mass, files.damping})
                            : std::move(matrices.superelement);
    if (table) imported.model.dofs = table->dofs;
  } else {
    imported.model = model_of_text(files, matrices, table, imported.notes);
  }
  if (!files.positions.empty()) imported.model.positions = read_node_positions(files.positions);
  dynamics::require_consistent(imported.model);
  imported.model = dynamics::in_si(std::move(imported.model), units);
  if (table) {
    imported.model.names.insert(table->names.begin(), table->names.end());
    for (const auto& [node, position] : table->positions_m) imported.model.positions[node] = position;
  }
  note_rows(imported.model, imported.notes);
  settle_positions(imported.model, imported.notes);
  dynamics::require_consistent(imported.model);
  return imported;
}

}  // namespace thinwall::io
