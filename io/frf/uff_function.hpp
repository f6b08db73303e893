#pragma once
// Data set 58, function at nodal DOF, as a plain struct; 58b differs by its binary values.
//
// Layout: "Universal File Datasets Summary" (SDRC, I-DEAS Test; data set 58 as of 23-Apr-1993), whose FORMAT statements
// give the columns.

#include <array>
#include <complex>
#include <string>
#include <vector>

#include "io/frf/universal_file.hpp"

namespace thinwall::io {

/// Codes of the format.
namespace uff {
constexpr int frequency_response_function = 4;
constexpr int coherence = 6;
constexpr int unknown_data = 0;
constexpr int general_data = 1;
constexpr int displacement = 8;
constexpr int reaction_force = 9;
constexpr int velocity = 11;
constexpr int acceleration = 12;
constexpr int excitation_force = 13;
constexpr int frequency = 18;
}  // namespace uff

/// One end of a function: node and direction, ±1…±3 (translation along ±x, ±y, ±z), ±4…±6 (rotation), 0 (scalar).
struct UffDof {
  std::string entity = "NONE";
  long node = 0;
  int direction = 0;
};

/// Records 8 to 11: the data of an axis. Exponents of length, force and temperature matter if the type is general.
struct UffAxis {
  int type = 0;
  std::array<int, 3> exponents{};
  std::string label = "NONE";
  std::string unit = "NONE";
};

/// One function. `x` contains every abscissa, even if the file has only the first value and the increment.
struct UffFunction {
  std::array<std::string, 5> id{"NONE", "NONE", "NONE", "NONE", "NONE"};
  int type = 0;
  long number = 0;
  UffDof response;
  UffDof reference;
  bool is_complex = true;
  bool even = false;
  double first = 0.0;      ///< first abscissa, if they are even
  double increment = 0.0;  ///< step of the abscissa, if it is even
  UffAxis abscissa;
  UffAxis numerator;
  UffAxis denominator;
  UffAxis z_axis;
  std::vector<double> x;
  std::vector<std::complex<double>> values;
};

/// The form in which values are written. Double precision keeps 13 digits as text and all bits as bytes, single
/// precision six digits and 24 bits. An uneven abscissa keeps six digits as text and the precision of the values as
/// bytes.
struct UffForm {
  bool binary = false;
  bool little_endian = true;
  bool double_precision = true;
};

/// The data set with its delimiters, every text filled with blanks to its width. Binary values are followed by the
/// closing delimiter without a line end, as the format prescribes. Cost O(values).
[[nodiscard]] std::string function_text(const UffFunction& function, const UffForm& form);

/// Reads a data set 58 or 58b. Blank ID lines, and zeros that fill the last record, are noted. Throws DataError with
/// file and line for a field that is no number, values that are not finite, and fewer or more values than record 7
/// states. Memory and cost are proportional to the bytes of the data set.
[[nodiscard]] UffFunction read_function(const UffDataSet& set, UffNotes& notes);

}  // namespace thinwall::io
