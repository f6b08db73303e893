#include "io/frf/universal_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace thinwall::io {

namespace {

/// True for a line that contains only the delimiter.
bool is_delimiter(std::string_view record) {
  return record == uff_delimiter;
}

/// The first record of a data set: its number, and for a binary one the text behind the letter b.
struct Heading {
  int number = 0;
  bool is_binary = false;
  std::string_view binary_fields;
};

Heading heading_of(const UffRecords& file, std::string_view record) {
  Heading heading;
  const std::string_view text = field(record, 0, uff_record_width);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), heading.number);
  const std::string_view rest = text.substr(static_cast<std::size_t>(end - text.data()));
  const bool ends_well = rest.empty() || rest.find_first_of(" bB") == 0;
  if (error != std::errc() || heading.number <= 0 || !ends_well) {
    refuse(file, "\"" + std::string(text) + "\" where the number of a data set is expected");
  }
  heading.is_binary = rest.starts_with('b') || rest.starts_with('B');
  if (heading.is_binary) heading.binary_fields = rest.substr(1);
  if (heading.is_binary && heading.number != 58) {
    refuse(file, "a binary data set " + std::to_string(heading.number) + "; only 58b is known");
  }
  return heading;
}

/// Takes the text up to the delimiter, and the delimiter too.
std::string_view take_text(UffRecords& file) {
  const std::string_view start = file.rest;
  while (!file.rest.empty()) {
    const std::size_t size = start.size() - file.rest.size();
    if (is_delimiter(take_record(file))) return start.substr(0, size);
  }
  refuse(file, "the file ends within a data set; write it again");
}

/// True if the first line of `text` contains only the delimiter.
bool starts_with_delimiter(std::string_view text) {
  if (!text.starts_with(uff_delimiter)) return false;
  const std::string_view rest = text.substr(uff_delimiter.size());
  const auto end = rest.find_first_not_of(" \t\r");
  return end == std::string_view::npos || rest[end] == '\n';
}

/// The line end between `at` and the closing delimiter, possibly of no bytes; empty if the delimiter is not there.
std::optional<std::string_view> line_end_before_delimiter(std::string_view bytes, std::size_t at) {
  for (const std::string_view line_end : {"", "\n", "\r\n", "\r"}) {
    if (bytes.substr(at).starts_with(line_end) && starts_with_delimiter(bytes.substr(at + line_end.size()))) {
      return line_end;
    }
  }
  return std::nullopt;
}

/// A way in which the values may be stored.
struct Storage {
  std::size_t abscissa_bytes;
  std::size_t value_bytes;
  bool as_stated;
};

/// All ways, the stated one first. With double values, most programs write a double abscissa, some a single one, which
/// its ASCII format E13.5 suggests.
std::vector<Storage> storages(bool even, bool stated_double) {
  if (even) return {{0, stated_double ? 8U : 4U, true}, {0, stated_double ? 4U : 8U, false}};
  if (stated_double) return {{8, 8, true}, {4, 8, true}, {4, 4, false}};
  return {{4, 4, true}, {8, 8, false}, {4, 8, false}};
}

/// The form of the values by record 7.
struct DataForm {
  long type = 0;
  long count = 0;
  bool even = false;
};

DataForm data_form(UffRecords records) {
  for (int k = 0; k < 6; ++k) (void)take_record(records);
  const std::string_view record = take_record(records);
  const DataForm form{integer(records, record, 0, 10), integer(records, record, 10, 10),
                      integer(records, record, 20, 10) == 1};
  if (form.type != 2 && form.type != 4 && form.type != 5 && form.type != 6) {
    refuse(records, "ordinate data type " + std::to_string(form.type) + " where 2, 4, 5 or 6 is expected");
  }
  if (form.count <= 0) refuse(records, "a positive number of values is expected in record 7");
  return form;
}

/// True for the byte order that the heading gives by two numbers I6,I6 behind the letter b; the second is the
/// floating-point format.
bool little_endian(const UffRecords& file, const UffRecords& heading_at, std::string_view fields, UffNotes& notes) {
  const long order = integer(file, fields, 0, 6);
  if (order != 1 && order != 2) {
    refuse(file, "byte order " + std::to_string(order) + " where 1 (little endian) or 2 (big endian) is expected");
  }
  const long format = integer(file, fields, 6, 6, 0);
  if (format != 0 && format != 2) {
    refuse(file, "floating-point format " + std::to_string(format) + " where 2 (IEEE 754) is expected");
  }
  if (format == 0) note(notes, heading_at, "the floating-point format is not stated; read as IEEE 754");
  const long records = integer(file, fields, 12, 12, uff_text_records);
  if (records != uff_text_records) {
    note(notes, heading_at, std::to_string(records) + " text records are stated, there are always 11");
  }
  return order == 1;
}

/// Notes deviations of the storage that was found.
void note_storage(UffNotes& notes, const UffRecords& heading_at, const Storage& storage, bool stated_double,
                  std::string_view line_end, long stated_bytes, std::size_t bytes) {
  if (!line_end.empty()) note(notes, heading_at, "a line end after the binary values is passed over");
  if (!storage.as_stated) {
    note(notes, heading_at,
         stated_double ? "the values are stored in single precision, record 7 states double"
                       : "the values are stored in double precision, record 7 states single");
  }
  if (stated_bytes < 0 || static_cast<std::size_t>(stated_bytes) != bytes) {
    note(notes, heading_at,
         std::to_string(stated_bytes) + " bytes are stated where " + std::to_string(bytes) +
             " are, by the count of the values");
  }
}

/// Takes the values of a data set and the closing delimiter.
UffBinary take_binary(UffRecords& file, const UffRecords& heading_at, const DataForm& form, std::string_view fields,
                      UffNotes& notes) {
  UffBinary binary;
  binary.little_endian = little_endian(file, heading_at, fields, notes);
  const std::size_t parts = form.type >= 5 ? 2 : 1;
  const bool stated_double = form.type == 4 || form.type == 6;
  const auto count = static_cast<std::size_t>(form.count);
  for (const Storage& storage : storages(form.even, stated_double)) {
    const std::size_t point = storage.abscissa_bytes + parts * storage.value_bytes;
    if (count > file.rest.size() / point) continue;
    const std::size_t size = count * point;
    const auto line_end = line_end_before_delimiter(file.rest, size);
    if (!line_end) continue;
    binary.abscissa_bytes = storage.abscissa_bytes;
    binary.value_bytes = storage.value_bytes;
    binary.bytes = file.rest.substr(0, size);
    note_storage(notes, heading_at, storage, stated_double, *line_end, integer(file, fields, 24, 12, 0), size);
    const std::string_view passed = file.rest.substr(0, size + line_end->size());
    file.line += static_cast<std::size_t>(std::count(passed.begin(), passed.end(), '\n'));
    file.rest.remove_prefix(passed.size());
    (void)take_record(file);
    return binary;
  }
  refuse(file,
         std::to_string(form.count) +
             " values by record 7, after which no \"    -1\" closes the data set, neither in single nor in double "
             "precision; export the file again");
}

UffDataSet take_data_set(UffRecords& file, UffNotes& notes) {
  if (file.rest.empty()) refuse(file, "the file ends within a data set; write it again");
  const Heading heading = heading_of(file, take_record(file));
  UffDataSet set;
  set.number = heading.number;
  set.is_binary = heading.is_binary;
  set.records = {file.source, {}, file.line};
  if (!heading.is_binary) {
    set.records.rest = take_text(file);
    return set;
  }
  const std::string_view start = file.rest;
  for (int k = 0; k < uff_text_records; ++k) (void)take_record(file);
  set.records.rest = start.substr(0, start.size() - file.rest.size());
  set.binary = take_binary(file, set.records, data_form(set.records), heading.binary_fields, notes);
  return set;
}

}  // namespace

void note(UffNotes& notes, const UffRecords& records, const std::string& what) {
  notes.push_back(records.source + ":" + std::to_string(records.line) + ": " + what);
}

std::vector<UffDataSet> universal_data_sets(std::string_view bytes, const std::string& source, UffNotes& notes) {
  UffRecords file{source, bytes, 0};
  std::vector<UffDataSet> sets;
  while (!file.rest.empty()) {
    const std::string_view record = take_record(file);
    if (record.empty()) continue;
    if (!is_delimiter(record)) refuse(file, "\"    -1\", which opens a data set, is expected here");
    sets.push_back(take_data_set(file, notes));
  }
  return sets;
}

}  // namespace thinwall::io
