#pragma once
// The records of a universal file as fields in columns, in the form of Fortran's FORMAT statements.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace thinwall::io {

constexpr std::size_t uff_record_width = 80;

// ---- Writing ----

/// The text in the format nA1: left-aligned, filled with blanks, cut to the width.
[[nodiscard]] std::string text_field(std::string_view text, std::size_t width);

/// The number in the format Iw: right-aligned.
[[nodiscard]] std::string integer_field(long value, std::size_t width);

/// Appends the number in the format Ew.d with one digit before the point, as all programs but those in Fortran write
/// it.
void add_real_field(std::string& text, double value, std::size_t width, int decimals);

// ---- Reading ----

/// The records of a data set that have not been taken yet, and the line in the file of the one taken last.
struct UffRecords {
  std::string source;
  std::string_view rest;
  std::size_t line = 0;
};

/// Throws DataError "source:line: cause" about the record taken last.
[[noreturn]] void refuse(const UffRecords& records, const std::string& cause);

/// The next record without line end and trailing blanks; throws DataError at the end of the data set.
[[nodiscard]] std::string_view take_record(UffRecords& records);

/// True if only blanks and line ends are left.
[[nodiscard]] bool at_end(const UffRecords& records);

/// Columns [start, start + width), counted from 0, without outer blanks; empty beyond the record's end.
[[nodiscard]] std::string_view field(std::string_view record, std::size_t start, std::size_t width);

/// The whole number in these columns of the record taken last, or `blank`, if given, when they are blank. Throws
/// DataError for anything else.
[[nodiscard]] long integer(const UffRecords& records, std::string_view record, std::size_t start, std::size_t width,
                           std::optional<long> blank = std::nullopt);

/// The finite number in these columns, with the errors of integer(). Exponents are those of Fortran: 1.5E-3, 1.5D-3,
/// 1.5-103.
[[nodiscard]] double real(const UffRecords& records, std::string_view record, std::size_t start, std::size_t width,
                          std::optional<double> blank = std::nullopt);

}  // namespace thinwall::io
