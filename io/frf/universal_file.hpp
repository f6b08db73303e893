#pragma once
// A universal file as data sets: text between two lines "    -1", or, for data set 58b, text and then bytes.
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

/// Records of a 58b before its bytes.
constexpr int uff_text_records = 11;

/// The values of a data set 58b as they lie in the file; an abscissa takes no bytes where it is even.
struct UffBinary {
  bool little_endian = true;
  std::size_t abscissa_bytes = 0;  ///< 0, 4 or 8
  std::size_t value_bytes = 8;     ///< 4 or 8
  std::string_view bytes;
};

/// One data set. `records` are its records after the one with its number, with the line of that one. A text data set
/// has no `binary.bytes`.
struct UffDataSet {
  int number = 0;
  bool is_binary = false;
  UffRecords records;
  UffBinary binary{};
};

/// Oddities of a file: "file:line: what", in the order of the file.
using UffNotes = std::vector<std::string>;

/// "source:line: what" about the record taken last.
void note(UffNotes& notes, const UffRecords& records, const std::string& what);

/// Splits the bytes of a file, which must outlive the result. Every size is bounded by the bytes that exist; lines are
/// counted by '\n', those among binary values included.
///
/// The bytes of a 58b are taken by count, spacing and type of its record 7 and must end at a closing "    -1". Where
/// they do not, the faults of real analysers are tried and noted: a line end between the last byte and the closing
/// "    -1", another precision than the one that is stated, single or double, and an uneven abscissa in single before
/// values in double. The number of bytes that the first record states is not relied on; where it is wrong (half, a
/// third) that is noted.
///
/// Throws DataError with file and line: text outside of the data sets, a data set without number, one that does not
/// close, a byte order or floating-point format that is unknown, binary values that fit no reading. Cost O(bytes).
[[nodiscard]] std::vector<UffDataSet> universal_data_sets(std::string_view bytes, const std::string& source,
                                                          UffNotes& notes);

}  // namespace thinwall::io
