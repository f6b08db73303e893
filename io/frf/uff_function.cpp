#include "io/frf/uff_function.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace thinwall::io {

namespace {

/// Widths of the fields of a record of values: E13.5 in single precision, E20.12 in double, an abscissa always E13.5.
std::vector<std::size_t> value_widths(bool is_complex, bool even, bool double_precision) {
  if (!double_precision) return std::vector<std::size_t>(6, 13);
  if (even) return std::vector<std::size_t>(4, 20);
  if (is_complex) return {13, 20, 20};
  return {13, 20, 13, 20};
}

// ---- Writing ----

std::string text_record(std::string_view text) {
  return text_field(text, uff_record_width) + "\n";
}

/// Entity, node and direction in the format 1X,10A1,I10,I4.
std::string dof_fields(const UffDof& dof) {
  return " " + text_field(dof.entity, 10) + integer_field(dof.node, 10) + integer_field(dof.direction, 4);
}

/// Type, exponents of length, force and temperature, axis and unit label in the format I10,3I5,2(1X,20A1).
std::string axis_record(const UffAxis& axis) {
  std::string text = integer_field(axis.type, 10);
  for (const int exponent : axis.exponents) text += integer_field(exponent, 5);
  return text + " " + text_field(axis.label, 20) + " " + text_field(axis.unit, 20) + "\n";
}

template <typename Number, typename Bits>
void add_bytes(std::string& text, double value, bool little_endian) {
  const Bits bits = std::bit_cast<Bits>(static_cast<Number>(value));
  for (std::size_t k = 0; k < sizeof(Bits); ++k) {
    const std::size_t shift = 8 * (little_endian ? k : sizeof(Bits) - 1 - k);
    text += static_cast<char>(static_cast<unsigned char>(bits >> shift));
  }
}

std::string binary_values(const UffFunction& function, const UffForm& form) {
  std::string text;
  const auto add = form.double_precision ? add_bytes<double, std::uint64_t> : add_bytes<float, std::uint32_t>;
  for (std::size_t i = 0; i < function.values.size(); ++i) {
    if (!function.even) add(text, function.x[i], form.little_endian);
    add(text, function.values[i].real(), form.little_endian);
    if (function.is_complex) add(text, function.values[i].imag(), form.little_endian);
  }
  return text;
}

std::string text_values(const UffFunction& function, const UffForm& form) {
  const auto widths = value_widths(function.is_complex, function.even, form.double_precision);
  std::string text;
  std::size_t place = 0;
  const auto add = [&](double value) {
    if (place == widths.size()) text += "\n";
    place %= widths.size();
    add_real_field(text, value, widths[place], widths[place] == 13 ? 5 : 12);
    ++place;
  };
  for (std::size_t i = 0; i < function.values.size(); ++i) {
    if (!function.even) add(function.x[i]);
    add(function.values[i].real());
    if (function.is_complex) add(function.values[i].imag());
  }
  return text + "\n";
}

// ---- Reading ----

UffDof read_dof(const UffRecords& records, std::string_view record, std::size_t start) {
  return {std::string(field(record, start + 1, 10)), integer(records, record, start + 11, 10, 0),
          static_cast<int>(integer(records, record, start + 21, 4, 0))};
}

UffAxis take_axis(UffRecords& records) {
  const std::string_view record = take_record(records);
  UffAxis axis;
  axis.type = static_cast<int>(integer(records, record, 0, 10, 0));
  for (std::size_t k = 0; k < 3; ++k) {
    axis.exponents[k] = static_cast<int>(integer(records, record, 10 + 5 * k, 5, 0));
  }
  axis.label = field(record, 26, 20);
  axis.unit = field(record, 47, 20);
  return axis;
}

void note_blank_ids(const UffFunction& function, const UffDataSet& set, UffNotes& notes) {
  std::string blank;
  for (std::size_t k = 0; k < function.id.size(); ++k) {
    if (function.id[k].empty()) blank += (blank.empty() ? "" : ", ") + std::to_string(k + 1);
  }
  if (!blank.empty()) note(notes, set.records, "ID lines are blank: " + blank);
}

/// The numbers of records 12, one after another across records.
struct TextNumbers {
  UffRecords records;
  std::vector<std::size_t> widths;
  std::string_view record;
  std::size_t place = 0;
  std::size_t start = 0;

  double take() {
    if (place == 0) {
      record = take_record(records);
      start = 0;
    }
    const double value = real(records, record, start, widths[place]);
    start += widths[place];
    place = (place + 1) % widths.size();
    return value;
  }
};

/// Throws DataError if anything but zeros, with which some programs fill the record, follows the last number.
void require_no_more(TextNumbers& numbers, const UffDataSet& set, UffNotes& notes) {
  bool filled = false;
  while (numbers.place != 0 && !field(numbers.record, numbers.start, uff_record_width).empty()) {
    if (numbers.take() != 0.0) refuse(numbers.records, "a value more than record 7 states");
    filled = true;
  }
  if (filled) note(notes, set.records, "zeros behind the last value are passed over");
  if (at_end(numbers.records)) return;
  (void)take_record(numbers.records);
  refuse(numbers.records, "more values than record 7 states");
}

template <typename Take>
void take_values(UffFunction& function, std::size_t count, Take take) {
  function.x.reserve(count);
  function.values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    function.x.push_back(function.even ? function.first + static_cast<double>(i) * function.increment : take());
    const double re = take();
    const double im = function.is_complex ? take() : 0.0;
    function.values.emplace_back(re, im);
  }
}

void read_text_values(UffFunction& function, std::size_t count, bool double_precision, const UffRecords& records,
                      const UffDataSet& set, UffNotes& notes) {
  TextNumbers numbers{records, value_widths(function.is_complex, function.even, double_precision), {}};
  // Every record but the last is full, which bounds the memory that a count may ask for by the bytes of the file.
  const std::size_t a_point = 1 + (function.is_complex ? 1 : 0) + (function.even ? 0 : 1);
  std::size_t a_record = 0;
  for (const std::size_t width : numbers.widths) a_record += width;
  const std::size_t room = records.rest.size() / (a_record - 18) + 1;
  if (count > records.rest.size() || count * a_point / numbers.widths.size() > room) {
    refuse(records, std::to_string(count) + " values are stated, more than the data set has room for");
  }
  take_values(function, count, [&numbers] { return numbers.take(); });
  require_no_more(numbers, set, notes);
}

template <typename Bits>
Bits bits_at(const char* bytes, bool little_endian) {
  Bits bits = 0;
  for (std::size_t k = 0; k < sizeof(Bits); ++k) {
    const std::size_t at = little_endian ? sizeof(Bits) - 1 - k : k;
    bits = static_cast<Bits>(bits << 8U) | static_cast<unsigned char>(bytes[at]);
  }
  return bits;
}

double real_number_at(const char* bytes, std::size_t size, bool little_endian) {
  if (size == 4) return std::bit_cast<float>(bits_at<std::uint32_t>(bytes, little_endian));
  return std::bit_cast<double>(bits_at<std::uint64_t>(bytes, little_endian));
}

void read_binary_values(UffFunction& function, std::size_t count, const UffDataSet& set) {
  const UffBinary& binary = set.binary;
  const char* at = binary.bytes.data();
  bool of_abscissa = !function.even;
  const std::size_t parts = function.is_complex ? 2 : 1;
  std::size_t part = 0;
  take_values(function, count, [&] {
    const std::size_t size = of_abscissa ? binary.abscissa_bytes : binary.value_bytes;
    const double value = real_number_at(at, size, binary.little_endian);
    if (!std::isfinite(value)) refuse(set.records, "binary values are not finite; is the byte order the stated one?");
    at += size;
    part = of_abscissa ? 0 : part + 1;
    of_abscissa = !of_abscissa && !function.even && part == parts;
    return value;
  });
}

}  // namespace

std::string function_text(const UffFunction& function, const UffForm& form) {
  const std::string values = form.binary ? binary_values(function, form) : text_values(function, form);
  std::string text = std::string(uff_delimiter) + "\n" + integer_field(58, 6);
  if (form.binary) {
    text += "b" + integer_field(form.little_endian ? 1 : 2, 6) + integer_field(2, 6) +
            integer_field(uff_text_records, 12) + integer_field(static_cast<long>(values.size()), 12) +
            integer_field(0, 6) + integer_field(0, 6) + integer_field(0, 12) + integer_field(0, 12);
  }
  text += "\n";
  for (const std::string& id : function.id) text += text_record(id);
  text += integer_field(function.type, 5) + integer_field(function.number, 10) + integer_field(0, 5) +
          integer_field(0, 10) + dof_fields(function.response) + dof_fields(function.reference) + "\n";
  const int type = (form.double_precision ? 4 : 2) + (function.is_complex ? (form.double_precision ? 2 : 3) : 0);
  text += integer_field(type, 10) + integer_field(static_cast<long>(function.values.size()), 10) +
          integer_field(function.even ? 1 : 0, 10);
  for (const double value : {function.first, function.increment, 0.0}) add_real_field(text, value, 13, 5);
  text += "\n";
  for (const UffAxis* axis : {&function.abscissa, &function.numerator, &function.denominator, &function.z_axis}) {
    text += axis_record(*axis);
  }
  return text + values + std::string(uff_delimiter) + "\n";
}

UffFunction read_function(const UffDataSet& set, UffNotes& notes) {
  UffRecords records = set.records;
  UffFunction function;
  for (std::string& id : function.id) id = take_record(records);
  note_blank_ids(function, set, notes);

  const std::string_view dofs = take_record(records);
  function.type = static_cast<int>(integer(records, dofs, 0, 5));
  function.number = integer(records, dofs, 5, 10, 0);
  function.response = read_dof(records, dofs, 30);
  function.reference = read_dof(records, dofs, 55);

  const std::string_view form = take_record(records);
  const long type = integer(records, form, 0, 10);
  if (type != 2 && type != 4 && type != 5 && type != 6) {
    refuse(records, "ordinate data type " + std::to_string(type) + " where 2, 4, 5 or 6 is expected");
  }
  function.is_complex = type >= 5;
  const long count = integer(records, form, 10, 10);
  if (count <= 0) refuse(records, "a positive number of values is expected in record 7");
  function.even = integer(records, form, 20, 10) == 1;
  function.first = real(records, form, 30, 13, 0.0);
  function.increment = real(records, form, 43, 13, 0.0);
  for (UffAxis* axis : {&function.abscissa, &function.numerator, &function.denominator, &function.z_axis}) {
    *axis = take_axis(records);
  }
  if (set.is_binary) {
    read_binary_values(function, static_cast<std::size_t>(count), set);
  } else {
    read_text_values(function, static_cast<std::size_t>(count), type == 4 || type == 6, records, set, notes);
  }
  return function;
}

}  // namespace thinwall::io
