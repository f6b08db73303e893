#include "io/matrices/dmig.hpp"

#include <algorithm>
#include <cmath>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/matrices/matrix_names.hpp"
#include "io/matrices/nastran_cards.hpp"
#include "io/mesh/inp_text.hpp"
#include "io/surface_text.hpp"

namespace thinwall::io {

namespace {

using dynamics::NodeDof;
using Matrix = Eigen::SparseMatrix<double>;

constexpr int largest_node = 100000000;

// ---- Reading ----

class DmigReader {
 public:
  explicit DmigReader(std::string name) : name_(std::move(name)) {}

  void take(const NastranCard& card) {
    if (capitals(card.name) == "GRID") {
      take_grid(card);
    } else if (field(card, 1) == "0") {
      take_heading(card);
    } else {
      take_column(card);
    }
  }

  DmigFile file;

 private:
  [[noreturn]] void fail(const NastranCard& card, const std::string& what) const {
    throw core::DataError(name_ + ":" + std::to_string(card.line) + ": " + what);
  }

  static std::string_view field(const NastranCard& card, std::size_t i) {
    return i < card.fields.size() ? card.fields[i] : std::string_view();
  }

  int integer(const NastranCard& card, std::size_t i, const char* what, int least, int most) const {
    return nastran_integer(field(card, i), what, least, most, name_, card.line);
  }

  /// Reads the entry GRID, ID, CP, X1, X2, X3, CD.
  void take_grid(const NastranCard& card) {
    for (const std::size_t system : {std::size_t{1}, std::size_t{5}}) {
      if (field(card, system).empty() || field(card, system) == "0") continue;
      fail(card, "grid point " + io::quoted(field(card, 0)) + " stands in coordinate system " +
                     io::quoted(field(card, system)) + ", which is not read; export in the basic system");
    }
    const int node = integer(card, 0, "a grid point", 1, largest_node);
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      if (!field(card, 2 + k).empty())
        x(static_cast<Eigen::Index>(k)) = nastran_real(field(card, 2 + k), name_, card.line);
    if (!file.positions.emplace(node, x).second) fail(card, "grid point " + std::to_string(node) + " is there twice");
  }

  /// Reads the heading DMIG, NAME, 0, IFO, TIN, TOUT, POLAR, , NCOL.
  void take_heading(const NastranCard& card) {
    DmigMatrix matrix;
    matrix.labelled.path = name_;
    matrix.labelled.name = capitals(field(card, 0));
    matrix.form = integer(card, 2, "the form of the matrix", 1, 9);
    matrix.labelled.may_be_half = matrix.form == 6;
    matrix.type = integer(card, 3, "the type of its numbers", 1, 4);
    matrix.line = card.line;
    if (find(matrix.labelled.name) != nullptr) fail(card, "the heading of " + matrix.labelled.name + " is there twice");
    places_.emplace(matrix.labelled.name, file.matrices.size());
    file.matrices.push_back(std::move(matrix));
  }

  /// Reads the column DMIG, NAME, GJ, CJ, , G1, C1, A1, B1, G2, C2, A2, B2, ...
  void take_column(const NastranCard& card) {
    DmigMatrix* matrix = find(capitals(field(card, 0)));
    if (matrix == nullptr) {
      fail(card, "a column of " + io::quoted(field(card, 0)) +
                     " before its heading (\"DMIG, NAME, 0, form, type\"): the file is truncated, or in another order");
    }
    if ((matrix->form != 1 && matrix->form != 6) || matrix->type > 2) return;
    const NodeDof column = dof(card, 1);
    for (std::size_t i = 4; i < card.fields.size(); i += 4) {
      const bool empty = field(card, i).empty() && field(card, i + 1).empty() && field(card, i + 2).empty();
      if (empty) continue;
      const double value = nastran_real(field(card, i + 2), name_, card.line);
      matrix->labelled.entries.push_back({dof(card, i), column, value, card.line});
    }
  }

  NodeDof dof(const NastranCard& card, std::size_t i) const {
    const int node = integer(card, i, "a grid point", 1, largest_node);
    if (field(card, i + 1).empty()) return {node, 0};
    return {node, integer(card, i + 1, "a component", 0, 6)};
  }

  DmigMatrix* find(const std::string& matrix_name) {
    const auto found = places_.find(matrix_name);
    return found == places_.end() ? nullptr : &file.matrices[found->second];
  }

  std::string name_;
  std::map<std::string, std::size_t> places_;
};

// ---- Writing ----

std::string right(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, text.size()), ' ') + text;
}

std::string left(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, text.size()), ' ');
}

struct Written {
  std::string text;
  double rounding = 0.0;
};

void write_matrix(const std::string& name, const Matrix& A, const std::vector<NodeDof>& dofs, Written& written) {
  const bool symmetric = dynamics::asymmetry(A).relative == 0.0;
  const auto place = [&](Eigen::Index row) {
    const NodeDof& dof = dofs[static_cast<std::size_t>(row)];
    return right(std::to_string(dof.node), 16) + right(std::to_string(dof.component), 16);
  };
  written.text += "DMIG    " + left(name, 8) + right("0", 8) + right(symmetric ? "6" : "1", 8) + right("2", 8) +
                  right("0", 8) + "\n";
  for (Eigen::Index column = 0; column < A.outerSize(); ++column) {
    bool opened = false;
    for (Matrix::InnerIterator entry(A, column); entry; ++entry) {
      if ((symmetric && entry.row() < column) || entry.value() == 0.0) continue;
      if (!opened) written.text += "DMIG*   " + left(name, 16) + place(column) + "\n";
      opened = true;
      const std::string number = nastran_real_text(entry.value());
      const double read = nastran_real(number, name, 0);
      written.rounding = std::max(written.rounding, std::abs(read / entry.value() - 1.0));
      written.text += "*       " + place(entry.row()) + right(number, 16) + "\n";
    }
  }
}

std::string points_text(const dynamics::SparseModel& model) {
  std::string text;
  for (const auto& [node, x] : model.positions) {
    text += "GRID*   " + right(std::to_string(node), 16) + right("", 16) + right(nastran_real_text(x.x()), 16) +
            right(nastran_real_text(x.y()), 16) + "\n*       " + right(nastran_real_text(x.z()), 16) + "\n";
  }
  for (const NodeDof& dof : model.dofs)
    if (dof.component == 0) text += "SPOINT* " + right(std::to_string(dof.node), 16) + "\n";
  return text;
}

}  // namespace

DmigFile read_dmig(std::string_view bytes, const std::string& name) {
  DmigReader reader(name);
  for_each_card(
      bytes, [](std::string_view card) { return capitals(card) == "DMIG" || capitals(card) == "GRID"; },
      [&](const NastranCard& card) { reader.take(card); });
  if (reader.file.matrices.empty()) throw core::DataError(name + ": holds no DMIG entry");
  return std::move(reader.file);
}

const DmigMatrix& dmig_matrix(const DmigFile& file, const std::string& wanted, char letter, const std::string& name) {
  std::vector<std::string> names;
  for (const DmigMatrix& matrix : file.matrices) names.push_back(matrix.labelled.name);
  const DmigMatrix& matrix = file.matrices[matrix_by_name(names, wanted, letter, name)];
  if (matrix.form == 1 || matrix.form == 6) {
    if (matrix.type <= 2) return matrix;
    throw core::DataError(name + ":" + std::to_string(matrix.line) + ": " + matrix.labelled.name +
                          " is complex (type " + std::to_string(matrix.type) + "); a real one belongs here");
  }
  throw core::DataError(name + ":" + std::to_string(matrix.line) + ": " + matrix.labelled.name +
                        " is not square (form " + std::to_string(matrix.form) + "; 1 and 6 are)");
}

double write_dmig(const std::filesystem::path& path, const dynamics::SparseModel& model) {
  dynamics::require_consistent(model);
  for (const NodeDof& dof : model.dofs) {
    if (dof.node >= 1 && dof.node <= largest_node) continue;
    throw core::InputError(path.string() + ": node " + std::to_string(dof.node) + " of \"" +
                           dynamics::point_name(model, dof) + "\" cannot be written as DMIG: from 1 to " +
                           std::to_string(largest_node));
  }
  Written written;
  written.text = "$ K, M and B of a component, by thinwall\n" + points_text(model);
  write_matrix("KAAX", model.K, model.dofs, written);
  write_matrix("MAAX", model.M, model.dofs, written);
  if (model.has_damping()) write_matrix("BAAX", model.C, model.dofs, written);
  core::write_file_atomically(path, written.text);
  return written.rounding;
}

}  // namespace thinwall::io
