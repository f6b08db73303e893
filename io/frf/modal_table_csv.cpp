#include "io/frf/modal_table_csv.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/units.hpp"
#include "io/csv_text.hpp"

namespace thinwall::io {

namespace {

using Eigen::Index;

/// The columns of one DOF: real and imaginary part of its left and its right vector.
struct DofColumns {
  std::string name;  ///< "1X"
  std::size_t left_re, left_im, right_re, right_im;
};

struct Columns {
  std::optional<std::size_t> mode;
  std::size_t frequency = 0;
  std::size_t damping = 0;
  bool in_percent = false;
  std::vector<DofColumns> dofs;
};

using ColumnIndices = std::map<std::string, std::size_t>;

/// The number of each column by its name; a map, so that a header of very many names is searched fast.
ColumnIndices indices_of(const std::vector<std::string>& header) {
  ColumnIndices indices;
  for (std::size_t i = 0; i < header.size(); ++i) indices.emplace(header[i], i);
  return indices;
}

std::optional<std::size_t> column(const ColumnIndices& indices, const std::string& name) {
  const auto found = indices.find(name);
  if (found == indices.end()) return std::nullopt;
  return found->second;
}

/// The first ten names, as "a, b, c".
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 10;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) list += (i == 0 ? "" : ", ") + names[i];
  return list + (names.size() > most ? " and " + std::to_string(names.size() - most) + " more" : "");
}

/// The DOF of a column, such as "1X" of "L_1X_re"; empty if the column belongs to no vector.
std::string dof_of(const std::string& column) {
  const bool vector = column.size() > 6 && (column.starts_with("L_") || column.starts_with("R_")) &&
                      (column.ends_with("_re") || column.ends_with("_im"));
  const std::string name = vector ? column.substr(2, column.size() - 5) : "";
  const bool direction = name.size() > 1 && std::string("XYZ").find(name.back()) != std::string::npos;
  return direction ? name : "";
}

void require_known_columns(const CsvText& text) {
  const std::vector<std::string> known{"mode", "frequency_hz", "damping_percent", "damping_ratio"};
  std::set<std::string> seen;
  for (const std::string& name : text.header) {
    const bool is_known = std::find(known.begin(), known.end(), name) != known.end();
    if (!is_known && dof_of(name).empty()) {
      throw core::DataError(text.path.string() + ": column \"" + name +
                            "\" is neither mode, frequency_hz, damping_percent, damping_ratio nor a vector's, such as "
                            "L_1X_re of point 1 along x" +
                            core::did_you_mean(name, known));
    }
    if (!seen.insert(name).second) throw core::DataError(text.path.string() + ": column \"" + name + "\" stands twice");
  }
  if (text.header.empty()) throw core::DataError(text.path.string() + ": has no header that names its columns");
}

Columns columns_of(const CsvText& text) {
  require_known_columns(text);
  const ColumnIndices indices = indices_of(text.header);
  std::vector<std::string> missing;
  const auto need = [&](const std::string& name) {
    const auto found = column(indices, name);
    if (!found) missing.push_back(name);
    return found.value_or(0);
  };
  Columns columns;
  columns.mode = column(indices, "mode");
  columns.frequency = need("frequency_hz");
  const auto percent = column(indices, "damping_percent");
  const auto ratio = column(indices, "damping_ratio");
  if (percent && ratio)
    throw core::DataError(text.path.string() + ": has both damping_percent and damping_ratio; keep one of them");
  if (!percent && !ratio) missing.emplace_back("damping_percent or damping_ratio");
  columns.in_percent = percent.has_value();
  columns.damping = percent ? *percent : ratio.value_or(0);
  std::set<std::string> seen;
  for (const std::string& name : text.header) {
    const std::string dof = dof_of(name);
    if (dof.empty() || !seen.insert(dof).second) continue;
    columns.dofs.push_back(
        {dof, need("L_" + dof + "_re"), need("L_" + dof + "_im"), need("R_" + dof + "_re"), need("R_" + dof + "_im")});
  }
  if (columns.dofs.empty()) missing.emplace_back("the vectors, such as L_1X_re, L_1X_im, R_1X_re, R_1X_im");
  if (missing.empty()) return columns;
  throw core::DataError(text.path.string() + ": lacks " + listed(missing));
}

dynamics::Dof dof_named(const std::string& name) {
  const std::string letter(1, static_cast<char>(name.back() - 'X' + 'x'));
  return {name.substr(0, name.size() - 1), dynamics::axis(letter), dynamics::DofKind::translation};
}

double damping_ratio(const CsvText& text, const CsvLine& line, const Columns& columns) {
  const double value = number(text, line, columns.damping);
  const double ratio = columns.in_percent ? 0.01 * value : value;
  if (ratio > 0.0 && ratio < 1.0) return ratio;
  const char* bound = columns.in_percent ? "must lie between 0 and 100 %"
                                         : "must lie between 0 and 1; if it is in percent, name its column "
                                           "damping_percent";
  throw core::DataError(location(text, line) + ": the damping " + line.fields[columns.damping] + " " + bound);
}

dynamics::ModalTableRow row_of_line(const CsvText& text, const CsvLine& line, const Columns& columns,
                                    const ModalTableFormat& format) {
  dynamics::ModalTableRow row;
  row.mode = columns.mode ? line.fields[*columns.mode] : std::to_string(&line - text.lines.data() + 1);
  row.frequency_hz = number(text, line, columns.frequency);
  if (!(row.frequency_hz > 0.0)) {
    throw core::DataError(location(text, line) + ": frequency_hz is " + line.fields[columns.frequency] +
                          ", but a mode's must be positive");
  }
  row.damping_ratio = damping_ratio(text, line, columns);
  const auto n = static_cast<Index>(columns.dofs.size());
  row.left.resize(n);
  row.right.resize(n);
  row.place_m = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
  for (Index i = 0; i < n; ++i) {
    const DofColumns& dof = columns.dofs[static_cast<std::size_t>(i)];
    row.left(i) = {format.left_unit * number(text, line, dof.left_re),
                   format.left_unit * number(text, line, dof.left_im)};
    row.right(i) = {format.right_unit * number(text, line, dof.right_re),
                    format.right_unit * number(text, line, dof.right_im)};
  }
  return row;
}

/// Writes the places of the points into the rows; NaN if no place is given.
void set_places(dynamics::ModalTable& table, const std::vector<PointPlace>& places, const std::string& file) {
  for (const PointPlace& given : places) {
    const std::vector<int> dofs = dynamics::rows_of_point(table.dofs, given.point);
    const std::size_t count = given.place_m.size();
    if (count != 1 && count != table.rows.size()) {
      throw core::InputError(file + ": point \"" + given.point + "\" has " + std::to_string(count) + " places for " +
                             std::to_string(table.rows.size()) + " modes; give one, or one a mode");
    }
    for (std::size_t mode = 0; mode < table.rows.size(); ++mode) {
      const double place = given.place_m[count == 1 ? 0 : mode];
      if (!std::isfinite(place))
        throw core::InputError(file + ": the place of point \"" + given.point + "\" is not a number");
      table.rows[mode].place_m(dofs).setConstant(place);
    }
  }
}

}  // namespace

double modal_unit(const std::string& text) {
  const std::string root = "sqrt(s/kg)";
  if (text.ends_with(root)) {
    std::string factor = text.substr(0, text.size() - root.size());
    while (!factor.empty() && factor.back() == ' ') factor.pop_back();
    if (factor.empty()) return 1.0;
    if (is_number(factor)) {
      const double value = core::parse_quantity(factor).value;
      if (value > 0.0) return value;
    }
  }
  throw core::InputError("\"" + text + "\" is no unit of a modal vector: write sqrt(s/kg) or 1e-7 sqrt(s/kg)");
}

dynamics::ModalTable read_modal_table(const std::filesystem::path& path, const ModalTableFormat& format) {
  for (const double unit : {format.left_unit, format.right_unit}) {
    if (!(unit > 0.0 && std::isfinite(unit))) {
      throw core::InputError(path.string() + ": a unit of its vectors is " + core::number_text(unit) +
                             " sqrt(s/kg), but it must be positive");
    }
  }
  const CsvText text = read_csv_text(path);
  const Columns columns = columns_of(text);
  require_columns(text, text.header.size(), "as many as the header names");
  dynamics::ModalTable table;
  for (const DofColumns& dof : columns.dofs) table.dofs.push_back(dof_named(dof.name));
  table.rows.reserve(text.lines.size());
  for (const CsvLine& line : text.lines) table.rows.push_back(row_of_line(text, line, columns, format));
  set_places(table, format.places, path.string());
  return table;
}

}  // namespace thinwall::io
