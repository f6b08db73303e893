#include "io/frf/mat_response.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <complex>
#include <numbers>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "io/matrices/mat_variables.hpp"

namespace thinwall::io {

namespace {

using dynamics::ResponseModel;

/// The numbers of lines, responses and forces.
struct Extent {
  std::size_t lines = 0;
  std::size_t rows = 0;
  std::size_t columns = 0;
};

Extent extent_of(const ResponseModel& model) {
  return {static_cast<std::size_t>(model.axis.size()), model.responses.size(), model.forces.size()};
}

/// The distances in an array between neighbouring lines, rows and columns.
struct Strides {
  std::size_t line = 0;
  std::size_t row = 0;
  std::size_t column = 0;
};

/// The strides of the layout that this program writes: responses × forces × lines, first index fastest.
Strides strides_of_ours(const Extent& extent) {
  return {extent.rows * extent.columns, 1, extent.rows};
}

void require_consistent(const MeasuredResponse& measured) {
  const ResponseModel& model = measured.response;
  const auto rows = static_cast<Eigen::Index>(model.responses.size());
  const auto columns = static_cast<Eigen::Index>(model.forces.size());
  bool consistent = model.axis.size() == static_cast<Eigen::Index>(model.H.size());
  for (const auto& H : model.H) consistent = consistent && H.rows() == rows && H.cols() == columns;
  if (!consistent) throw core::InputError("the response's matrices do not match its frequencies and DOF tables");
  const std::size_t coherences = measured.coherence.size();
  if (coherences != 0 && coherences != model.responses.size() * model.forces.size()) {
    throw core::InputError("only some entries of the response have a coherence; a MAT file holds all or none");
  }
  for (const EntryCoherence& entry : measured.coherence) {
    if (entry.values.size() != model.axis.size()) throw core::InputError("a coherence has another number of lines");
  }
}

MatVariable coherence_variable(const MeasuredResponse& measured) {
  const Extent extent = extent_of(measured.response);
  const Strides strides = strides_of_ours(extent);
  MatVariable variable{"coherence", {extent.rows, extent.columns, extent.lines}, {}};
  variable.re.resize(extent.rows * extent.columns * extent.lines);
  for (const EntryCoherence& entry : measured.coherence) {
    for (std::size_t line = 0; line < extent.lines; ++line) {
      variable.re[line * strides.line + static_cast<std::size_t>(entry.row) * strides.row +
                  static_cast<std::size_t>(entry.column) * strides.column] =
          entry.values(static_cast<Eigen::Index>(line));
    }
  }
  return variable;
}

/// The size with three dimensions, because some programs leave out trailing dimensions of one.
std::vector<std::size_t> padded(std::vector<std::size_t> size) {
  while (size.size() < 3) size.push_back(1);
  return size;
}

/// The strides of an array that follow from its size. Throws DataError if none do, or if several do that mean different
/// arrays.
Strides strides_by_size(const MatVariable& array, const Extent& extent, bool lines_last,
                        const std::filesystem::path& path) {
  const std::size_t entries = extent.rows * extent.columns;
  const std::vector<std::size_t> size = padded(array.size);
  std::vector<Strides> readings;
  if (size == std::vector<std::size_t>{extent.rows, extent.columns, extent.lines}) {
    if (lines_last) return strides_of_ours(extent);
    readings.push_back(strides_of_ours(extent));
  }
  if (size == std::vector<std::size_t>{extent.lines, extent.rows, extent.columns}) {
    readings.push_back({1, extent.lines, extent.lines * extent.rows});
  }
  const bool one_list = extent.rows == 1 || extent.columns == 1;
  if (one_list && size == std::vector<std::size_t>{entries, extent.lines, 1}) {
    readings.push_back({entries, 1, extent.rows});
  }
  if (one_list && size == std::vector<std::size_t>{extent.lines, entries, 1}) {
    readings.push_back({1, extent.lines, extent.lines * extent.rows});
  }
  const auto differs = [&](const Strides& a, const Strides& b) {
    return a.line != b.line || (extent.rows > 1 && a.row != b.row) || (extent.columns > 1 && a.column != b.column);
  };
  for (const Strides& other : readings) {
    if (extent.lines > 1 && differs(readings.front(), other)) {
      fail_in(path,
              "the variable " + array.name + " has as many lines as entries; its dimensions cannot be told apart");
    }
  }
  if (!readings.empty()) return readings.front();
  std::string found;
  for (const std::size_t length : array.size) found += (found.empty() ? "" : " x ") + std::to_string(length);
  fail_in(path, "the variable " + array.name + " is " + found + "; expected " + std::to_string(extent.rows) + " x " +
                    std::to_string(extent.columns) + " x " + std::to_string(extent.lines) + " or lines first");
}

std::vector<double> frequencies(const MatVariable& variable, double in_hz, const std::filesystem::path& path) {
  const std::size_t count = variable.re.size();
  const bool is_vector = variable.size.size() == 2 && (variable.size[0] == count || variable.size[1] == count);
  if (!is_vector || !variable.im.empty() || count == 0) {
    fail_in(path, "the variable " + variable.name + " is no real vector of frequencies");
  }
  std::vector<double> hz;
  for (const double value : variable.re) hz.push_back(value * in_hz);
  for (std::size_t i = 1; i < count; ++i) {
    if (hz[i] <= hz[i - 1])
      fail_in(path, "the variable " + variable.name + " does not rise at " + std::to_string(i + 1));
  }
  if (hz.front() < 0.0) fail_in(path, "the variable " + variable.name + " starts below 0");
  return hz;
}

void take_coherence(const MatVariable& array, const Extent& extent, std::size_t first_line, bool lines_last,
                    const std::filesystem::path& path, MeasuredResponse& measured) {
  const Strides strides = strides_by_size(array, extent, lines_last, path);
  for (const double value : array.re) {
    if (value >= 0.0 && value <= 1.0 + 1e-6) continue;
    fail_in(path, "the variable " + array.name + " holds a coherence outside of 0 to 1");
  }
  if (!array.im.empty()) fail_in(path, "the variable " + array.name + " is complex; a coherence is real");
  for (std::size_t row = 0; row < extent.rows; ++row) {
    for (std::size_t column = 0; column < extent.columns; ++column) {
      EntryCoherence entry{static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column),
                           Eigen::VectorXd(static_cast<Eigen::Index>(extent.lines - first_line))};
      for (std::size_t line = first_line; line < extent.lines; ++line) {
        const double value = array.re[line * strides.line + row * strides.row + column * strides.column];
        entry.values(static_cast<Eigen::Index>(line - first_line)) = std::min(value, 1.0);
      }
      measured.coherence.push_back(std::move(entry));
    }
  }
}

/// The FRFs from the variables. `lines_last`: the layout is that of write_mat_response(), even if others fit the size.
MeasuredResponse read_arrays(const std::filesystem::path& path, const MatFrfNames& names, const FrfFormat& format,
                             const dynamics::DofTable& responses, const dynamics::DofTable& forces, bool lines_last) {
  std::vector<std::string> wanted{names.frequency, names.frf};
  if (!names.coherence.empty()) wanted.push_back(names.coherence);
  const MatVariables variables = read_mat_variables(path, wanted);
  const std::vector<double> hz = frequencies(variable(variables, names.frequency, path), format.unit_in_hz, path);
  const Extent extent{hz.size(), responses.size(), forces.size()};
  const MatVariable& array = variable(variables, names.frf, path);
  const Strides strides = strides_by_size(array, extent, lines_last, path);
  MeasuredResponse measured;
  measured.response = {{}, responses, forces, {}};
  std::size_t first = 0;
  if (hz.front() == 0.0 && format.quantity != FrfQuantity::receptance) {
    measured.notes.push_back(path.string() + ": the line at 0 Hz has no receptance and is left out");
    first = 1;
  }
  if (first == hz.size()) fail_in(path, "has no line above 0 Hz");
  const auto lines = static_cast<Eigen::Index>(hz.size() - first);
  measured.response.axis.hz = Eigen::Map<const Eigen::VectorXd>(hz.data() + first, lines);
  for (std::size_t line = first; line < hz.size(); ++line) {
    Eigen::MatrixXcd& H = measured.response.H.emplace_back(static_cast<Eigen::Index>(extent.rows),
                                                           static_cast<Eigen::Index>(extent.columns));
    for (std::size_t row = 0; row < extent.rows; ++row) {
      for (std::size_t column = 0; column < extent.columns; ++column) {
        const std::size_t at = line * strides.line + row * strides.row + column * strides.column;
        const std::complex<double> value(array.re[at], array.im.empty() ? 0.0 : array.im[at]);
        const std::complex<double> receptance = to_receptance(value, 2.0 * std::numbers::pi * hz[line], format);
        if (!std::isfinite(receptance.real()) || !std::isfinite(receptance.imag())) {
          fail_in(path, "the variable " + array.name + " holds a receptance beyond the range of a double");
        }
        H(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = receptance;
      }
    }
  }
  if (!names.coherence.empty()) {
    take_coherence(variable(variables, names.coherence, path), extent, first, lines_last, path, measured);
  }
  return measured;
}

/// A variable, and where in it an FRF lies: an index from 0 for each dimension, of which `lines` is the dimension of
/// the lines; no indices for a variable that is the FRF itself.
struct EntryOfVariable {
  std::string name;
  std::vector<std::size_t> indices{};
  std::size_t lines = 0;
};

[[noreturn]] void no_entry(const std::string& text) {
  throw core::InputError(
      "\"" + text +
      "\" is no variable, \"H00\", nor an entry of an array, \"H(2,1,:)\", with indices from 1 and one "
      "colon for the lines");
}

EntryOfVariable entry_of_variable(const std::string& text) {
  const std::size_t open = text.find('(');
  EntryOfVariable entry{text.substr(0, open)};
  if (entry.name.empty()) no_entry(text);
  if (open == std::string::npos) return entry;
  if (text.back() != ')') no_entry(text);
  std::string_view left = std::string_view(text).substr(open + 1, text.size() - open - 2);
  std::size_t colons = 0;
  while (true) {
    const std::size_t comma = left.find(',');
    std::string_view word = left.substr(0, comma);
    while (word.starts_with(' ')) word.remove_prefix(1);
    while (word.ends_with(' ')) word.remove_suffix(1);
    std::size_t index = 1;
    if (word == ":") {
      entry.lines = entry.indices.size();
      ++colons;
    } else {
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
      if (error != std::errc() || end != word.data() + word.size() || index == 0) no_entry(text);
    }
    entry.indices.push_back(index - 1);
    if (comma == std::string_view::npos) break;
    left.remove_prefix(comma + 1);
  }
  if (colons != 1) no_entry(text);
  return entry;
}

std::string size_text(const MatVariable& array) {
  std::string text;
  for (const std::size_t length : array.size) text += (text.empty() ? "" : " x ") + std::to_string(length);
  return text;
}

/// The place of the first line in the array, and the distance to the next.
struct LinesOfEntry {
  std::size_t first = 0, step = 1;
};

LinesOfEntry lines_of(const MatVariable& array, const EntryOfVariable& entry, std::size_t lines,
                      const std::filesystem::path& path) {
  const std::string what = "the variable " + array.name + " is " + size_text(array);
  if (entry.indices.empty()) {
    if (array.re.size() != lines)
      fail_in(path, what + " for " + std::to_string(lines) + " frequencies; of an array write the entry, \"" +
                        array.name + "(1,1,:)\"");
    return {};
  }
  if (entry.indices.size() != array.size.size())
    fail_in(path, what + " and has " + std::to_string(array.size.size()) + " indices, not " +
                      std::to_string(entry.indices.size()));
  LinesOfEntry place;
  std::size_t step = 1;
  for (std::size_t k = 0; k < array.size.size(); ++k) {
    const std::size_t length = array.size[k];
    if (k == entry.lines && length != lines)
      fail_in(path, what + " with " + std::to_string(length) + " lines for " + std::to_string(lines) + " frequencies");
    if (k != entry.lines && entry.indices[k] >= length)
      fail_in(path, what + "; index " + std::to_string(entry.indices[k] + 1) + " lies beyond");
    if (k == entry.lines) place.step = step;
    else place.first += entry.indices[k] * step;
    step *= length;
  }
  return place;
}

/// Tells how to read a file that this program did not write.
[[noreturn]] void refuse_foreign(const std::filesystem::path& path) {
  std::string names;
  for (const std::string& name : mat_variable_names(path)) names += (names.empty() ? "" : ", ") + name;
  fail_in(path, "has not the variables of a file of this program (H, response_name …)" +
                    (names.empty() ? std::string() : "; it holds " + names) +
                    ": name the one with the FRF and the one with the frequencies (variable, frequency_variable)");
}

}  // namespace

MeasuredEntries read_mat_entry(const std::filesystem::path& path, const MatEntryNames& names, const FrfFormat& format) {
  const EntryOfVariable entry = entry_of_variable(names.frf);
  const MatVariables variables = read_mat_variables(path, {names.frequency, entry.name});
  const std::vector<double> hz = frequencies(variable(variables, names.frequency, path), format.unit_in_hz, path);
  const MatVariable& array = variable(variables, entry.name, path);
  if (array.re.empty()) fail_in(path, "the variable " + array.name + " holds no array of numbers");
  const LinesOfEntry place = lines_of(array, entry, hz.size(), path);
  const std::size_t first = hz.front() == 0.0 && format.quantity != FrfQuantity::receptance ? 1 : 0;
  if (first == hz.size()) fail_in(path, "has no line above 0 Hz");
  MeasuredFrf frf{.axis = {}, .H = {}, .source = path.string()};
  const auto lines = static_cast<Eigen::Index>(hz.size() - first);
  frf.axis.hz = Eigen::Map<const Eigen::VectorXd>(hz.data() + first, lines);
  frf.H.resize(lines);
  for (std::size_t line = first; line < hz.size(); ++line) {
    const std::size_t at = place.first + line * place.step;
    const std::complex<double> value(array.re[at], array.im.empty() ? 0.0 : array.im[at]);
    const auto receptance = to_receptance(value, 2.0 * std::numbers::pi * hz[line], format);
    if (!std::isfinite(std::abs(receptance)))
      fail_in(path, "the variable " + array.name + " holds a receptance beyond the range of a double");
    frf.H(static_cast<Eigen::Index>(line - first)) = receptance;
  }
  const dynamics::Dof untold{"", Eigen::Vector3d::Zero(), dynamics::DofKind::translation};
  MeasuredEntries result{{{untold, untold, frf}}, {}};
  if (first == 1) result.notes.push_back("the line at 0 Hz has no receptance and is left out");
  return result;
}

void write_mat_response(const std::filesystem::path& path, const MeasuredResponse& measured) {
  require_consistent(measured);
  const ResponseModel& model = measured.response;
  const Extent extent = extent_of(model);
  MatVariable H{"H", {extent.rows, extent.columns, extent.lines}, {}};
  for (const Eigen::MatrixXcd& line : model.H) {
    for (const std::complex<double>& value : line.reshaped()) {
      H.re.push_back(value.real());
      H.im.push_back(value.imag());
    }
  }
  std::vector<MatVariable> variables{mat_matrix("frequency_hz", model.axis.hz), std::move(H)};
  if (!measured.coherence.empty()) variables.push_back(coherence_variable(measured));
  for (MatVariable& table : dof_variables("response", model.responses)) variables.push_back(std::move(table));
  for (MatVariable& table : dof_variables("force", model.forces)) variables.push_back(std::move(table));
  write_mat_variables(path, "frequency responses by thinwall", variables);
}

MeasuredResponse read_mat_response(const std::filesystem::path& path) {
  std::vector<std::string> names{"H", "coherence"};
  for (const std::string prefix : {"response", "force"}) {
    for (const std::string& name : dof_variable_names(prefix)) names.push_back(name);
  }
  const MatVariables variables = read_mat_variables(path, names);
  const bool named = std::ranges::any_of(dof_variable_names("response"),
                                         [&](const std::string& name) { return variables.contains(name); });
  if (!variables.contains("H") || !named) refuse_foreign(path);
  const std::vector<std::size_t> size = padded(variable(variables, "H", path).size);
  const auto responses = dofs_of(variables, "response", static_cast<Eigen::Index>(size[0]), path);
  const auto forces = dofs_of(variables, "force", static_cast<Eigen::Index>(size[1]), path);
  const std::string coherence = variables.contains("coherence") ? "coherence" : "";
  return read_arrays(path, {"frequency_hz", "H", coherence}, {FrfQuantity::receptance, 1.0, 1.0}, responses, forces,
                     true);
}

MeasuredResponse read_mat_frf(const std::filesystem::path& path, const MatFrfNames& names, const FrfFormat& format,
                              const dynamics::DofTable& responses, const dynamics::DofTable& forces) {
  if (responses.empty() || forces.empty()) throw core::InputError("name a response and a force for the FRFs at least");
  return read_arrays(path, names, format, responses, forces, false);
}

}  // namespace thinwall::io
