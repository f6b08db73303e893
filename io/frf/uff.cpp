#include "io/frf/uff.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "io/frf/uff_meaning.hpp"
#include "io/frf/uff_units.hpp"

namespace thinwall::io {

namespace {

using dynamics::Dof;
using dynamics::DofKind;
using dynamics::DofTable;
using dynamics::FrequencyAxis;
using dynamics::ResponseModel;

constexpr std::size_t longest_point_name = uff_record_width - uff::response_point_words.size();

// ---- Writing ----

std::string response_unit(DofKind kind) {
  return kind == DofKind::rotation ? "rad" : "m";
}

std::string force_unit(DofKind kind) {
  return kind == DofKind::rotation ? "N m" : "N";
}

/// First frequency and step of an axis that is even in the digits of the format.
struct Abscissa {
  bool even = false;
  double first_hz = 0.0;
  double step_hz = 0.0;
};

double in_six_digits(double value) {
  std::string field;
  add_real_field(field, value, 13, 5);
  const auto first = field.find_first_not_of(' ');
  double rounded = value;
  std::from_chars(field.data() + first, field.data() + field.size(), rounded);
  return rounded;
}

/// A frequency of an uneven abscissa with the digits that the file keeps.
double kept(double hz, const UffForm& form) {
  if (!form.binary) return in_six_digits(hz);
  return form.double_precision ? hz : static_cast<double>(static_cast<float>(hz));
}

Abscissa abscissa_of(const FrequencyAxis& axis) {
  const Eigen::Index lines = axis.size();
  if (lines < 2) return {};
  const double step_hz = (axis.hz(lines - 1) - axis.hz(0)) / static_cast<double>(lines - 1);
  const Abscissa even{true, in_six_digits(axis.hz(0)), in_six_digits(step_hz)};
  for (Eigen::Index line = 0; line < lines; ++line) {
    // The bound by which two axes count as equal (dynamics::require_equal).
    const double hz = even.first_hz + static_cast<double>(line) * even.step_hz;
    if (std::abs(hz - axis.hz(line)) > 1e-12 * std::abs(axis.hz(line))) return {};
  }
  return even;
}

void require_entries(const ResponseModel& model) {
  dynamics::require_consistent(model);
  if (model.responses.empty() || model.forces.empty() || model.H.empty()) {
    throw core::InputError("the response has no entry or no frequency; a universal file needs at least one of each");
  }
}

std::string vector_text(const Eigen::Vector3d& vector) {
  const Eigen::Vector3d v = vector.array() + 0.0;  // turns -0 into 0
  return core::number_text(v.x()) + " " + core::number_text(v.y()) + " " + core::number_text(v.z());
}

void require_writable(const Dof& dof) {
  if (dof.kind == DofKind::modal) {
    throw core::InputError("\"" + name(dof) +
                           "\" is a modal amplitude, which a universal file cannot hold; write responses of points");
  }
  if (!(std::abs(dof.direction.norm() - 1.0) <= 1e-9)) {
    throw core::InputError("the direction " + vector_text(dof.direction) + " of point \"" + dof.point +
                           "\" is no unit vector (length 1 within 1e-9); divide it by its length");
  }
  const std::string& point = dof.point;
  const bool plain = std::none_of(point.begin(), point.end(), [](unsigned char c) { return std::iscntrl(c); });
  if (!plain || point.empty() || point.front() == ' ' || point.back() == ' ' || point.size() > longest_point_name) {
    throw core::InputError("the point name \"" + point + "\" cannot be written; use 1 to " +
                           std::to_string(longest_point_name) + " bytes without outer blanks");
  }
}

void require_writable(const FrequencyAxis& axis, const Abscissa& abscissa, const UffForm& form) {
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    if (!std::isfinite(axis.hz(line))) {
      throw core::NumericalError("frequency " + std::to_string(line + 1) + " of the response is not finite");
    }
    if (abscissa.even || line == 0 || kept(axis.hz(line), form) > kept(axis.hz(line - 1), form)) continue;
    throw core::InputError("the frequencies " + core::number_text(axis.hz(line - 1)) + " Hz and " +
                           core::number_text(axis.hz(line)) +
                           " Hz do not rise in the digits that a universal file keeps; use a coarser or an even axis");
  }
}

/// The numbers of the model's points, from 1 on.
std::map<std::string, long> nodes_of(const ResponseModel& model) {
  std::map<std::string, long> nodes;
  for (const DofTable* table : {&model.responses, &model.forces}) {
    for (const Dof& dof : *table) nodes.try_emplace(dof.point, static_cast<long>(nodes.size()) + 1);
  }
  return nodes;
}

double writable(double value, const ResponseModel& model, Eigen::Index line, const UffFunction& function,
                const UffForm& form) {
  const auto about = [&] {
    return function.id[0] + " (" + function.id[3] + "), " + function.id[1] + " (" + function.id[4] + "), ";
  };
  const std::string at = " at " + core::number_text(model.axis.hz(line)) + " Hz";
  if (!std::isfinite(value)) throw core::NumericalError(about() + "is not finite" + at);
  const double single = static_cast<double>(static_cast<float>(value));
  if (!form.double_precision && (!std::isfinite(single) || (single == 0.0 && value != 0.0))) {
    throw core::NumericalError(about() + "is beyond single precision" + at + "; write double precision");
  }
  return value;
}

/// Records 1 to 11 of an entry, without values. The exponents of the units are left to the data type, except along
/// directions that the format does not have.
UffFunction function_of(const ResponseModel& model, const Abscissa& abscissa, const std::map<std::string, long>& nodes,
                        Eigen::Index row, Eigen::Index column) {
  const Dof& response = model.responses[static_cast<std::size_t>(row)];
  const Dof& force = model.forces[static_cast<std::size_t>(column)];
  UffFunction function;
  function.id = {std::string(uff::response_point_words) + response.point,
                 std::string(uff::force_point_words) + force.point, "NONE",
                 std::string(uff::response_direction_words) + vector_text(response.direction),
                 std::string(uff::force_direction_words) + vector_text(force.direction)};
  function.type = uff::frequency_response_function;
  function.number = row * static_cast<long>(model.forces.size()) + column + 1;
  function.response = {"NONE", nodes.at(response.point), direction_code(response)};
  function.reference = {"NONE", nodes.at(force.point), direction_code(force)};
  function.even = abscissa.even;
  function.first = abscissa.first_hz;
  function.increment = abscissa.step_hz;
  const bool scalar_response = function.response.direction == 0;
  const bool scalar_force = function.reference.direction == 0;
  const int length = scalar_response && response.kind == DofKind::translation ? 1 : 0;
  const int lever = scalar_force && force.kind == DofKind::rotation ? 1 : 0;
  function.abscissa = {uff::frequency, {}, "Frequency", "Hz"};
  function.numerator = {uff::displacement, {length, 0, 0}, "Displacement", response_unit(response.kind)};
  function.denominator = {
      uff::excitation_force, {lever, scalar_force ? 1 : 0, 0}, "Excitation force", force_unit(force.kind)};
  function.x.assign(model.axis.hz.begin(), model.axis.hz.end());
  return function;
}

std::string frf_text(const ResponseModel& model, UffFunction function, Eigen::Index row, Eigen::Index column,
                     const UffForm& form) {
  for (std::size_t line = 0; line < model.H.size(); ++line) {
    const std::complex<double> value = model.H[line](row, column);
    const auto index = static_cast<Eigen::Index>(line);
    function.values.emplace_back(writable(value.real(), model, index, function, form),
                                 writable(value.imag(), model, index, function, form));
  }
  return function_text(function, form);
}

std::string coherence_text(const ResponseModel& model, UffFunction function, const Eigen::VectorXd& coherence,
                           const UffForm& form) {
  if (coherence.size() != model.axis.size()) {
    throw core::InputError("a coherence has " + std::to_string(coherence.size()) + " values on " +
                           std::to_string(model.axis.size()) + " frequencies");
  }
  function.id[0] = std::string(uff::coherence_point_words) + function.id[0].substr(uff::response_point_words.size());
  function.type = uff::coherence;
  function.is_complex = false;
  function.numerator = {uff::unknown_data, {}, "Coherence", "NONE"};
  function.denominator = {};
  for (Eigen::Index line = 0; line < coherence.size(); ++line) {
    function.values.emplace_back(writable(coherence(line), model, line, function, form), 0.0);
  }
  return function_text(function, form);
}

// ---- Reading ----

/// The coherence of a data set 58 of type 6; `taken` becomes true when an FRF has used it.
struct Coherence {
  UffRecords at;
  std::vector<double> hz;
  std::vector<double> values;
  bool taken = false;
};

/// A key that is equal for functions between the same DOFs: points, directions of record 6 and of the ID lines.
using FunctionKey = std::tuple<std::string, int, std::array<double, 3>, std::string, int, std::array<double, 3>>;

FunctionKey key_of(const UffFunction& function, const UffDofs& dofs) {
  const auto numbers = [](const Eigen::Vector3d& v) { return std::array<double, 3>{v.x(), v.y(), v.z()}; };
  return {dofs.response.point, function.response.direction,  numbers(dofs.response.direction),
          dofs.force.point,    function.reference.direction, numbers(dofs.force.direction)};
}

/// The contents of a file that have been read so far.
struct Contents {
  std::optional<UffUnits> units;
  std::vector<MeasuredEntry> entries;
  std::vector<FunctionKey> keys;
  std::map<FunctionKey, Coherence> coherence;
  std::map<int, int> passed_over;  ///< types of the functions that were skipped, with their numbers
};

/// The frequencies of a function in Hz.
std::vector<double> frequencies(const UffFunction& function, const UffReading& reading, const UffRecords& at,
                                UffNotes& notes) {
  const double in_hz = abscissa_in_hz(function, reading.stated, at, notes);
  std::vector<double> hz(function.x);
  for (std::size_t i = 0; i < hz.size(); ++i) {
    hz[i] *= in_hz;
    if (!std::isfinite(hz[i])) refuse(at, "frequency " + std::to_string(i + 1) + " is not finite");
    if (i > 0 && hz[i] <= hz[i - 1]) refuse(at, "the frequency does not rise at value " + std::to_string(i + 1));
  }
  if (hz.front() < 0.0) refuse(at, "the first frequency is negative");
  return hz;
}

void add_entry(const UffFunction& function, const UffRecords& at, const UffReading& reading, Contents& contents,
               UffNotes& notes) {
  UffDofs dofs = dofs_of(function, at);
  const FunctionKey key = key_of(function, dofs);
  const FrfFormat format = format_of(function, contents.units, reading.stated, at, dofs, notes);
  const std::vector<double> hz = frequencies(function, reading, at, notes);
  std::size_t first = 0;
  if (hz.front() == 0.0 && format.quantity != FrfQuantity::receptance) {
    note(notes, at, "the line at 0 Hz has no receptance and is left out");
    first = 1;
  }
  if (hz.size() == first) refuse(at, "no line above 0 Hz");
  const auto lines = static_cast<Eigen::Index>(hz.size() - first);
  MeasuredFrf frf;
  frf.source = at.source + ":" + std::to_string(at.line);
  frf.axis.hz = Eigen::Map<const Eigen::VectorXd>(hz.data() + first, lines);
  frf.H.resize(lines);
  for (Eigen::Index line = 0; line < lines; ++line) {
    const std::complex<double> value = function.values[first + static_cast<std::size_t>(line)];
    frf.H(line) = to_receptance(value, 2.0 * std::numbers::pi * frf.axis.hz(line), format);
    if (!std::isfinite(frf.H(line).real()) || !std::isfinite(frf.H(line).imag())) {
      refuse(at, "the receptance at " + core::number_text(frf.axis.hz(line)) + " Hz is beyond the range of a double");
    }
  }
  contents.entries.push_back({std::move(dofs.response), std::move(dofs.force), std::move(frf)});
  contents.keys.push_back(key);
}

void add_coherence(const UffFunction& function, const UffRecords& at, const UffReading& reading, Contents& contents,
                   UffNotes& notes) {
  Coherence coherence{at, frequencies(function, reading, at, notes), {}};
  for (const std::complex<double>& value : function.values) {
    // A value in single precision may exceed 1 by a rounding.
    if (!(value.real() >= 0.0 && value.real() <= 1.0 + 1e-6) || value.imag() != 0.0) {
      refuse(at, "a coherence of " + core::number_text(value.real()) + " where 0 to 1 is expected");
    }
    coherence.values.push_back(std::min(value.real(), 1.0));
  }
  const auto [place, is_new] =
      contents.coherence.try_emplace(key_of(function, dofs_of(function, at)), std::move(coherence));
  if (!is_new) note(notes, at, "a coherence that is there twice is passed over");
}

void join_coherence(Contents& contents, UffNotes& notes) {
  for (std::size_t k = 0; k < contents.entries.size(); ++k) {
    const auto found = contents.coherence.find(contents.keys[k]);
    if (found == contents.coherence.end()) continue;
    Coherence& coherence = found->second;
    MeasuredFrf& frf = contents.entries[k].frf;
    const std::size_t first = coherence.hz.front() == 0.0 && frf.axis.hz(0) > 0.0 ? 1 : 0;
    const auto lines = static_cast<Eigen::Index>(coherence.hz.size() - first);
    const FrequencyAxis axis{Eigen::Map<const Eigen::VectorXd>(coherence.hz.data() + first, lines)};
    if (!equal(axis, frf.axis)) continue;
    frf.coherence = Eigen::Map<const Eigen::VectorXd>(coherence.values.data() + first, lines);
    coherence.taken = true;
  }
  for (const auto& [key, coherence] : contents.coherence) {
    if (!coherence.taken) note(notes, coherence.at, "a coherence belongs to no FRF on its frequencies; passed over");
  }
}

}  // namespace

void write_uff(const std::filesystem::path& path, const MeasuredResponse& measured, const UffForm& form) {
  const ResponseModel& model = measured.response;
  require_entries(model);
  for (const Dof& dof : model.responses) require_writable(dof);
  for (const Dof& dof : model.forces) require_writable(dof);
  const Abscissa abscissa = abscissa_of(model.axis);
  require_writable(model.axis, abscissa, form);
  const std::map<std::string, long> nodes = nodes_of(model);
  std::string text = header_sets("thinwall responses", "receptance, e^{+i omega t}");
  for (Eigen::Index row = 0; row < static_cast<Eigen::Index>(model.responses.size()); ++row) {
    for (Eigen::Index column = 0; column < static_cast<Eigen::Index>(model.forces.size()); ++column) {
      const UffFunction function = function_of(model, abscissa, nodes, row, column);
      text += frf_text(model, function, row, column, form);
      const Eigen::VectorXd coherence = coherence_of(measured, row, column);
      if (coherence.size() > 0) text += coherence_text(model, function, coherence, form);
    }
  }
  core::write_file_atomically(path, text);
}

void write_uff(const std::filesystem::path& path, const ResponseModel& model, const UffForm& form) {
  write_uff(path, MeasuredResponse{model, {}, {}}, form);
}

MeasuredEntries uff_entries(std::string_view bytes, const std::string& source, const UffReading& reading) {
  MeasuredEntries measured;
  Contents contents;
  for (const UffDataSet& set : universal_data_sets(bytes, source, measured.notes)) {
    if (set.number == 164) contents.units = read_units(set);
    if (set.number != 58) continue;
    const UffFunction function = read_function(set, measured.notes);
    if (function.type == uff::frequency_response_function) {
      add_entry(function, set.records, reading, contents, measured.notes);
    } else if (function.type == uff::coherence) {
      add_coherence(function, set.records, reading, contents, measured.notes);
    } else {
      ++contents.passed_over[function.type];
    }
  }
  for (const auto& [type, count] : contents.passed_over) {
    measured.notes.push_back(source + ": " + std::to_string(count) + " functions of type " + std::to_string(type) +
                             " are passed over");
  }
  if (contents.entries.empty()) {
    throw core::DataError(source + ": holds no data set 58 of function type 4 (FRF); export frequency response " +
                          "functions");
  }
  join_coherence(contents, measured.notes);
  measured.entries = std::move(contents.entries);
  return measured;
}

MeasuredEntries read_uff_entries(const std::filesystem::path& path, const UffReading& reading) {
  return uff_entries(core::read_file(path), path.string(), reading);
}

MeasuredResponse read_uff(const std::filesystem::path& path, const UffReading& reading) {
  return response_matrix(read_uff_entries(path, reading));
}

}  // namespace thinwall::io
