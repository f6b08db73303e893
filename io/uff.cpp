#include "io/uff.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <complex>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace thinwall::io {

namespace {

using dynamics::Dof;
using dynamics::DofKind;
using dynamics::DofTable;
using dynamics::FrequencyAxis;
using dynamics::ResponseModel;

// Numbers that the format gives a meaning.
constexpr int function_set = 58;
constexpr int units_set = 164;
constexpr int si_units = 1;
constexpr int frequency_response_function = 4;
constexpr int complex_double_precision = 6;
constexpr int frequency = 18;
constexpr int displacement = 8;
constexpr int excitation_force = 13;

constexpr std::size_t record_width = 80;
constexpr std::string_view delimiter = "    -1";
constexpr std::string_view response_point_words = "receptance at ";
constexpr std::string_view force_point_words = "force at ";
constexpr std::string_view response_direction_words = "response ";
constexpr std::string_view force_direction_words = "force ";

constexpr std::size_t longest_point_name = record_width - response_point_words.size();

// ---- Columns, as FORMAT statements describe them ----

/// nA1: to the left.
std::string text_field(std::string_view text, std::size_t width) {
  std::string field(text);
  field.resize(width, ' ');
  return field;
}

std::string to_the_right(std::string_view text, std::size_t width) {
  return std::string(width - std::min(width, text.size()), ' ') + std::string(text);
}

/// Iw.
std::string integer_field(long value, std::size_t width) {
  return to_the_right(std::to_string(value), width);
}

/// Adds Ew.d with one digit before the point, as every program but a Fortran one writes it.
void add_real(std::string& text, double value, std::size_t width, int decimals) {
  std::array<char, 40> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::scientific, decimals).ptr;
  std::replace(buffer.data(), end, 'e', 'E');
  const auto size = static_cast<std::size_t>(end - buffer.data());
  text.append(width - std::min(width, size), ' ').append(buffer.data(), size);
}

void add_abscissa(std::string& text, double hz) {
  add_real(text, hz, 13, 5);
}

void add_value(std::string& text, double value) {
  add_real(text, value, 20, 12);
}

// ---- What both directions share ----

/// 0 where the direction is along none of the axes.
int direction_code(const Dof& dof) {
  const int offset = dof.kind == DofKind::rotation ? 3 : 0;
  for (int k = 0; k < 3; ++k) {
    if (dof.direction == Eigen::Vector3d::Unit(k)) return k + 1 + offset;
    if (dof.direction == -Eigen::Vector3d::Unit(k)) return -(k + 1 + offset);
  }
  return 0;
}

std::string response_unit(DofKind kind) {
  return kind == DofKind::rotation ? "rad" : "m";
}

std::string force_unit(DofKind kind) {
  return kind == DofKind::rotation ? "N m" : "N";
}

/// First frequency and step, if the axis is even in the digits of the format.
struct Abscissa {
  bool even = false;
  double first_hz = 0.0;
  double step_hz = 0.0;
};

double even_line(const Abscissa& abscissa, Eigen::Index line) {
  return abscissa.first_hz + static_cast<double>(line) * abscissa.step_hz;
}

// ---- Writing ----

double in_six_digits(double value) {
  std::string field;
  add_abscissa(field, value);
  const auto first = field.find_first_not_of(' ');
  double rounded = value;
  std::from_chars(field.data() + first, field.data() + field.size(), rounded);
  return rounded;
}

Abscissa abscissa_of(const FrequencyAxis& axis) {
  const Eigen::Index lines = axis.size();
  if (lines < 2) return {};
  const double step_hz = (axis.hz(lines - 1) - axis.hz(0)) / static_cast<double>(lines - 1);
  const Abscissa even{true, in_six_digits(axis.hz(0)), in_six_digits(step_hz)};
  for (Eigen::Index line = 0; line < lines; ++line) {
    // The bound by which two axes count as equal (dynamics::require_equal).
    if (std::abs(even_line(even, line) - axis.hz(line)) > 1e-12 * std::abs(axis.hz(line))) return {};
  }
  return even;
}

void require_consistent(const ResponseModel& model) {
  const auto rows = static_cast<Eigen::Index>(model.responses.size());
  const auto columns = static_cast<Eigen::Index>(model.forces.size());
  bool consistent = model.axis.size() == static_cast<Eigen::Index>(model.H.size());
  for (const auto& H : model.H) consistent = consistent && H.rows() == rows && H.cols() == columns;
  if (!consistent) throw core::InputError("the response's matrices do not match its frequencies and DOF tables");
  if (rows * columns * model.axis.size() == 0) {
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

void require_writable(const FrequencyAxis& axis, const Abscissa& abscissa) {
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    if (!std::isfinite(axis.hz(line))) {
      throw core::NumericalError("frequency " + std::to_string(line + 1) + " of the response is not finite");
    }
    if (abscissa.even || line == 0 || in_six_digits(axis.hz(line)) > in_six_digits(axis.hz(line - 1))) continue;
    throw core::InputError("the frequencies " + core::number_text(axis.hz(line - 1)) + " Hz and " +
                           core::number_text(axis.hz(line)) +
                           " Hz do not rise in the six digits of a universal file; use a coarser or an even axis");
  }
}

std::string text_record(std::string_view words, std::string_view rest = {}) {
  return text_field(std::string(words) + std::string(rest), record_width) + "\n";
}

/// Data sets 151 and 164. "NONE" stands for dates and times; 1 is the factor from SI to SI, D25.17.
std::string header_sets() {
  const std::string no_date = text_field("NONE", 10) + text_field("NONE", 10);
  const std::string one = to_the_right("1.00000000000000000D+00", 25);
  std::string text = std::string(delimiter) + "\n   151\n";
  text += text_record("thinwall responses") + text_record("receptance, e^{+i omega t}") + text_record("thinwall");
  text += no_date + integer_field(0, 10) + integer_field(0, 10) + integer_field(0, 10) + "\n";
  text += no_date + "\n" + text_record("thinwall") + no_date + "\n" + std::string(delimiter) + "\n";
  text += std::string(delimiter) + "\n   164\n";
  text += integer_field(si_units, 10) + text_field("SI: Meter (newton)", 20) + integer_field(2, 10) + "\n";
  text += one + one + one + "\n" + to_the_right("2.73149999999999977D+02", 25) + "\n";
  return text + std::string(delimiter) + "\n";
}

/// Numbers the points from 1 on.
std::vector<std::string> points_of(const ResponseModel& model) {
  std::vector<std::string> points;
  for (const DofTable* table : {&model.responses, &model.forces}) {
    for (const Dof& dof : *table) {
      if (std::find(points.begin(), points.end(), dof.point) == points.end()) points.push_back(dof.point);
    }
  }
  return points;
}

/// 1X,10A1,I10,I4: entity, node and direction.
std::string dof_fields(const std::vector<std::string>& points, const Dof& dof) {
  const auto node = std::find(points.begin(), points.end(), dof.point) - points.begin() + 1;
  return " " + text_field("NONE", 10) + integer_field(node, 10) + integer_field(direction_code(dof), 4);
}

/// I10,3I5,2(1X,20A1): type, exponents of length, force and temperature, axis and unit label.
std::string characteristics(int type, int length, int force, std::string_view label, std::string_view unit) {
  return integer_field(type, 10) + integer_field(length, 5) + integer_field(force, 5) + integer_field(0, 5) + " " +
         text_field(label, 20) + " " + text_field(unit, 20) + "\n";
}

/// Records 8 to 11. The exponents are left to the data's type, except along directions that the format does not know.
std::string all_characteristics(const Dof& response, const Dof& force) {
  const int length = direction_code(response) == 0 && response.kind == DofKind::translation ? 1 : 0;
  const int force_exponent = direction_code(force) == 0 ? 1 : 0;
  const int lever = direction_code(force) == 0 && force.kind == DofKind::rotation ? 1 : 0;
  return characteristics(frequency, 0, 0, "Frequency", "Hz") +
         characteristics(displacement, length, 0, "Displacement", response_unit(response.kind)) +
         characteristics(excitation_force, lever, force_exponent, "Excitation force", force_unit(force.kind)) +
         characteristics(0, 0, 0, "NONE", "NONE");
}

/// Record 12: 4E20.12 over an even abscissa, else E13.5,2E20.12.
std::string values(const ResponseModel& model, bool even, Eigen::Index row, Eigen::Index column) {
  std::string text;
  for (std::size_t line = 0; line < model.H.size(); ++line) {
    const double hz = model.axis.hz(static_cast<Eigen::Index>(line));
    const std::complex<double> value = model.H[line](row, column);
    if (!std::isfinite(value.real()) || !std::isfinite(value.imag())) {
      throw core::NumericalError("receptance " + name(model.responses[static_cast<std::size_t>(row)]) + "/" +
                                 name(model.forces[static_cast<std::size_t>(column)]) + " is not finite at " +
                                 core::number_text(hz) + " Hz");
    }
    if (!even) add_abscissa(text, hz);
    add_value(text, value.real());
    add_value(text, value.imag());
    const bool line_is_full = !even || line % 2 == 1 || line + 1 == model.H.size();
    if (line_is_full) text += "\n";
  }
  return text;
}

std::string function_text(const ResponseModel& model, const Abscissa& abscissa, const std::vector<std::string>& points,
                          Eigen::Index row, Eigen::Index column) {
  const Dof& response = model.responses[static_cast<std::size_t>(row)];
  const Dof& force = model.forces[static_cast<std::size_t>(column)];
  const long number = row * static_cast<long>(model.forces.size()) + column + 1;
  std::string text = std::string(delimiter) + "\n" + integer_field(function_set, 6) + "\n";
  text += text_record(response_point_words, response.point) + text_record(force_point_words, force.point);
  text += text_record("NONE");
  text += text_record(response_direction_words, vector_text(response.direction));
  text += text_record(force_direction_words, vector_text(force.direction));
  text += integer_field(frequency_response_function, 5) + integer_field(number, 10) + integer_field(0, 5) +
          integer_field(0, 10) + dof_fields(points, response) + dof_fields(points, force) + "\n";
  text += integer_field(complex_double_precision, 10) + integer_field(model.axis.size(), 10) +
          integer_field(abscissa.even ? 1 : 0, 10);
  for (const double hz : {abscissa.first_hz, abscissa.step_hz, 0.0}) add_abscissa(text, hz);
  text += "\n" + all_characteristics(response, force) + values(model, abscissa.even, row, column);
  return text + std::string(delimiter) + "\n";
}

// ---- Reading ----

/// The lines of a file without their trailing blanks, and how many of them have been taken.
struct Records {
  std::filesystem::path path;
  std::vector<std::string> lines;
  std::size_t taken = 0;
};

/// About the line that was taken last.
[[noreturn]] void fail(const Records& records, const std::string& cause) {
  throw core::DataError(records.path.string() + ":" + std::to_string(records.taken) + ": " + cause);
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

Records records_of(const std::filesystem::path& path) {
  Records records{path, {}, 0};
  std::istringstream content(core::read_file(path));
  for (std::string line; std::getline(content, line);) {
    records.lines.push_back(line.substr(0, line.find_last_not_of(" \t\r") + 1));
  }
  return records;
}

bool at_end(const Records& records) {
  return records.taken == records.lines.size();
}

std::string_view take(Records& records) {
  if (at_end(records)) fail(records, "the file ends within a data set; write it again");
  return records.lines[records.taken++];
}

/// The number in `width` columns from `start` (counted from 0) of the line taken last.
template <typename Number>
Number number(const Records& records, std::string_view line, std::size_t start, std::size_t width) {
  const std::string_view field = trimmed(line.substr(std::min(start, line.size()), width));
  Number value{};
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  const bool whole = error == std::errc() && end == field.data() + field.size();
  if (!whole || !std::isfinite(static_cast<double>(value))) {
    fail(records, "\"" + std::string(field) + "\" in columns " + std::to_string(start + 1) + " to " +
                      std::to_string(start + width) + " is no finite number of its kind");
  }
  return value;
}

void require(const Records& records, bool holds, const std::string& expected) {
  if (!holds) fail(records, expected + " is expected here; was the file written by thinwall?");
}

/// What follows `words` on the next line.
std::string take_after(Records& records, std::string_view words) {
  const std::string_view line = take(records);
  require(records, line.size() > words.size() && line.starts_with(words), "\"" + std::string(words) + "\" and a value");
  return std::string(line.substr(words.size()));
}

Eigen::Vector3d take_vector(Records& records, std::string_view words) {
  const std::string text = take_after(records, words);
  Eigen::Vector3d vector;
  std::size_t start = 0;
  for (double& component : vector) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    component = number<double>(records, text, start, end - start);
    start = std::min(end + 1, text.size());
  }
  return vector;
}

/// The kind that the unit label of a record 9 or 10 tells: DOFs along oblique directions have no other sign of it.
DofKind take_kind(Records& records, int type, std::string (*unit)(DofKind)) {
  const std::string_view line = take(records);
  require(records, number<int>(records, line, 0, 10) == type, "specific data type " + std::to_string(type));
  const std::string_view label = trimmed(line.substr(std::min<std::size_t>(47, line.size())));
  for (const DofKind kind : {DofKind::translation, DofKind::rotation}) {
    if (label == unit(kind)) return kind;
  }
  fail(records, "unit \"" + std::string(label) + "\" where " + unit(DofKind::translation) + " or " +
                    unit(DofKind::rotation) + " is expected");
}

/// One data set 58.
struct Function {
  Dof response;
  Dof force;
  std::vector<double> hz;
  std::vector<std::complex<double>> H;
};

void take_values(Records& records, const Abscissa& abscissa, long lines, Function& function) {
  for (long line = 0; line < lines; ++line) {
    const bool new_record = !abscissa.even || line % 2 == 0;
    const std::string_view record = new_record ? take(records) : records.lines[records.taken - 1];
    const std::size_t start = abscissa.even ? (line % 2 == 0 ? 0 : 40) : 13;
    function.hz.push_back(abscissa.even ? even_line(abscissa, line) : number<double>(records, record, 0, 13));
    const auto real = number<double>(records, record, start, 20);
    function.H.emplace_back(real, number<double>(records, record, start + 20, 20));
    if (line > 0 && function.hz[function.hz.size() - 2] >= function.hz.back()) {
      fail(records, "the frequency does not rise");
    }
  }
}

/// Records 1 to 12, up to the line before the closing delimiter.
Function take_function(Records& records) {
  Function function;
  function.response.point = take_after(records, response_point_words);
  function.force.point = take_after(records, force_point_words);
  (void)take(records);
  function.response.direction = take_vector(records, response_direction_words);
  function.force.direction = take_vector(records, force_direction_words);

  const std::string_view dofs = take(records);
  require(records, number<int>(records, dofs, 0, 5) == frequency_response_function, "function type 4 (FRF)");
  const int response_code = number<int>(records, dofs, 51, 4);
  const int force_code = number<int>(records, dofs, 76, 4);

  const std::string_view form = take(records);
  require(records, number<int>(records, form, 0, 10) == complex_double_precision, "ordinate type 6 (complex double)");
  const long lines = number<long>(records, form, 10, 10);
  require(records, lines > 0, "a positive number of values");
  const Abscissa abscissa{number<int>(records, form, 20, 10) == 1, number<double>(records, form, 30, 13),
                          number<double>(records, form, 43, 13)};

  require(records, number<int>(records, take(records), 0, 10) == frequency, "specific data type 18 (frequency)");
  function.response.kind = take_kind(records, displacement, response_unit);
  function.force.kind = take_kind(records, excitation_force, force_unit);
  (void)take(records);
  require(records, direction_code(function.response) == response_code && direction_code(function.force) == force_code,
          "a direction in record 6 that agrees with ID lines 4 and 5");
  take_values(records, abscissa, lines, function);
  return function;
}

std::vector<Function> take_functions(Records& records) {
  std::vector<Function> functions;
  while (!at_end(records)) {
    if (trimmed(take(records)).empty()) continue;
    require(records, records.lines[records.taken - 1] == delimiter, "\"    -1\", which opens a data set,");
    const int kind = number<int>(records, take(records), 0, record_width);
    if (kind == function_set) {
      functions.push_back(take_function(records));
      require(records, take(records) == delimiter, "\"    -1\", which closes the data set,");
      continue;
    }
    if (kind == units_set) require(records, number<int>(records, take(records), 0, 10) == si_units, "units code 1");
    while (take(records) != delimiter) continue;
  }
  return functions;
}

/// The place of a DOF in the table, which grows if it is new.
Eigen::Index place_of(DofTable& table, const Dof& dof) {
  const auto same = [&dof](const Dof& other) {
    return other.point == dof.point && other.kind == dof.kind && other.direction == dof.direction;
  };
  const auto found = std::find_if(table.begin(), table.end(), same);
  const auto place = found - table.begin();
  if (found == table.end()) table.push_back(dof);
  return place;
}

ResponseModel matrix_of(const std::vector<Function>& functions, const std::filesystem::path& path) {
  if (functions.empty()) throw core::DataError(path.string() + ": holds no data set 58; was it written by thinwall?");
  ResponseModel model;
  std::vector<std::pair<Eigen::Index, Eigen::Index>> places;
  for (const Function& function : functions) {
    const std::string entry = name(function.response) + "/" + name(function.force);
    const std::pair place{place_of(model.responses, function.response), place_of(model.forces, function.force)};
    if (std::find(places.begin(), places.end(), place) != places.end()) {
      throw core::DataError(path.string() + ": the entry " + entry + " is there twice; remove one");
    }
    if (function.hz != functions.front().hz) {
      throw core::DataError(path.string() + ": the entry " + entry + " has other frequencies than the first entry");
    }
    places.push_back(place);
  }
  const auto rows = static_cast<Eigen::Index>(model.responses.size());
  const auto columns = static_cast<Eigen::Index>(model.forces.size());
  if (functions.size() != static_cast<std::size_t>(rows * columns)) {
    throw core::DataError(path.string() + ": " + std::to_string(functions.size()) + " entries where " +
                          std::to_string(rows) + " responses to " + std::to_string(columns) + " forces need " +
                          std::to_string(rows * columns) + "; write the file again");
  }
  const std::vector<double>& hz = functions.front().hz;
  model.axis.hz = Eigen::Map<const Eigen::VectorXd>(hz.data(), static_cast<Eigen::Index>(hz.size()));
  model.H.assign(hz.size(), Eigen::MatrixXcd::Zero(rows, columns));
  for (std::size_t k = 0; k < functions.size(); ++k) {
    for (std::size_t line = 0; line < hz.size(); ++line) {
      model.H[line](places[k].first, places[k].second) = functions[k].H[line];
    }
  }
  return model;
}

}  // namespace

void write_uff(const std::filesystem::path& path, const ResponseModel& model) {
  require_consistent(model);
  for (const Dof& dof : model.responses) require_writable(dof);
  for (const Dof& dof : model.forces) require_writable(dof);
  const Abscissa abscissa = abscissa_of(model.axis);
  require_writable(model.axis, abscissa);
  const std::vector<std::string> points = points_of(model);
  std::string text = header_sets();
  for (Eigen::Index row = 0; row < static_cast<Eigen::Index>(model.responses.size()); ++row) {
    for (Eigen::Index column = 0; column < static_cast<Eigen::Index>(model.forces.size()); ++column) {
      text += function_text(model, abscissa, points, row, column);
    }
  }
  core::write_file_atomically(path, text);
}

ResponseModel read_uff(const std::filesystem::path& path) {
  Records records = records_of(path);
  return matrix_of(take_functions(records), path);
}

}  // namespace thinwall::io
