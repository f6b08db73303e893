#pragma once
// The records of a universal file below the level of meaning: fields in columns, as Fortran's FORMAT statements give
// them.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace thinwall::io {

constexpr std::size_t uff_record_width = 80;

// ---- Writing ----

/// nA1: to the left, blanks behind; cut to the width.
[[nodiscard]] std::string text_field(std::string_view text, std::size_t width);

/// Iw: to the right.
[[nodiscard]] std::string integer_field(long value, std::size_t width);

/// Adds Ew.d with one digit before the point, as every program but a Fortran one writes it.
void add_real_field(std::string& text, double value, std::size_t width, int decimals);

// ---- Reading ----

/// The records of a data set that are not taken yet, and the line in the file of the one that was taken last.
struct UffRecords {
  std::string source;
  std::string_view rest;
  std::size_t line = 0;
};

/// Throws DataError "source:line: cause" about the record that was taken last.
[[noreturn]] void refuse(const UffRecords& records, const std::string& cause);

/// The next record without line end and trailing blanks; throws DataError at the end of the data set.
[[nodiscard]] std::string_view take_record(UffRecords& records);

/// True if nothing but blanks and line ends is left.
[[nodiscard]] bool at_end(const UffRecords& records);

/// Columns [start, start + width), counted from 0, without outer blanks; empty beyond the record's end.
[[nodiscard]] std::string_view field(std::string_view record, std::size_t start, std::size_t width);

/// The whole number in these columns of the record taken last; where they are blank, `blank` if given. Throws
/// DataError.
[[nodiscard]] long integer(const UffRecords& records, std::string_view record, std::size_t start, std::size_t width,
                           std::optional<long> blank = std::nullopt);

/// The finite number in these columns, with the same errors. Exponents are those of Fortran: 1.5E-3, 1.5D-3, 1.5-103.
[[nodiscard]] double real(const UffRecords& records, std::string_view record, std::size_t start, std::size_t width,
                          std::optional<double> blank = std::nullopt);

}  // namespace thinwall::io
