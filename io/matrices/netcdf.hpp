#pragma once
// Numbers in NetCDF files of the classic formats (CDF-1, CDF-2 with 64-bit offsets, CDF-5), as Exodus files are.
//
// Layout: "The NetCDF Classic Format Specification", Unidata. Behind the letters CDF and a byte of the version stand
// the dimensions, the attributes and the variables, each variable with its type and the byte at which its numbers
// begin. All words are big-endian; texts and values are filled up to four bytes; the last dimension runs fastest.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall::io {

/// A variable of a file's heading.
struct NetcdfVariable {
  std::string name;
  std::vector<std::int64_t> size;  ///< lengths of its dimensions, in their order
  int type = 0;                    ///< the specification's number of the type: 1 byte, 2 character … 6 double …
  std::size_t begin = 0;           ///< the byte at which its values begin
  bool by_record = false;          ///< its first dimension is the unlimited one
};

/// True if the bytes begin as a file of a classic format.
[[nodiscard]] bool is_netcdf(std::string_view bytes);

/// True if the bytes are a file of NetCDF-4, which is HDF5.
[[nodiscard]] bool is_netcdf4(std::string_view bytes);

/// The variables of a file's heading. `path` is for messages. Throws DataError with file and byte for a truncated or
/// damaged heading. Cost O(bytes of the heading).
[[nodiscard]] std::vector<NetcdfVariable> netcdf_variables(std::string_view bytes, const std::string& path);

/// The variable of that name, or null.
[[nodiscard]] const NetcdfVariable* find_variable(const std::vector<NetcdfVariable>& variables, std::string_view name);

/// All values of a variable of numbers, the last dimension fastest (whole ones beyond 2⁵³ are rounded). Throws
/// DataError that names the file and the variable if it is text, has the unlimited dimension, reaches beyond the end of
/// the file or contains NaN or infinity. Cost O(values).
[[nodiscard]] std::vector<double> netcdf_values(std::string_view bytes, const NetcdfVariable& variable,
                                                const std::string& path);

}  // namespace thinwall::io
