#pragma once
// A universal file as data sets: text between two lines "    -1", or, for data set 58b, text followed by bytes.
//
// Layout: "Universal File Datasets Summary" (SDRC, I-DEAS Test) and, for 58b, "The Binary 58 Universal File Format"
// (University of Cincinnati, SDRL).

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/frf/uff_fields.hpp"

namespace thinwall::io {

/// The delimiter: a record with -1 in format I6.
constexpr std::string_view uff_delimiter = "    -1";

/// Number of records of a 58b before its bytes.
constexpr int uff_text_records = 11;

/// The storage of the values of a data set 58b; an even abscissa takes no bytes.
struct UffBinary {
  bool little_endian = true;
  std::size_t abscissa_bytes = 0;  ///< 0, 4 or 8
  std::size_t value_bytes = 8;     ///< 4 or 8
  std::string_view bytes;
};

/// One data set. `records` are its records after the one with its number, which gives their line. A text data set has
/// no `binary.bytes`.
struct UffDataSet {
  int number = 0;
  bool is_binary = false;
  UffRecords records;
  UffBinary binary{};
};

/// Notes on irregularities of a file, "file:line: fact", in the order of the file.
using UffNotes = std::vector<std::string>;

/// Appends the note "source:line: what" about the record taken last.
void note(UffNotes& notes, const UffRecords& records, const std::string& what);

/// The data sets of a file, whose bytes must outlive the result. Every size is bounded by the bytes that exist; lines
/// are counted by '\n', including those among binary values.
///
/// The bytes of a 58b are taken by count, spacing and type of its record 7 and must end at a closing "    -1". If they
/// do not, the faults of real analysers are tried and noted: a line end between the last byte and the closing "    -1",
/// another precision, single or double, than stated, and an uneven abscissa in single before values in double
/// precision. The number of bytes that the first record states is not relied on; if it is wrong (a half, a third), that
/// is noted.
///
/// Throws DataError with file and line for text outside of the data sets, a data set without a number or without its
/// end, an unknown byte order or floating-point format, and binary values that fit no reading. Cost O(bytes).
[[nodiscard]] std::vector<UffDataSet> universal_data_sets(std::string_view bytes, const std::string& source,
                                                          UffNotes& notes);

}  // namespace thinwall::io
