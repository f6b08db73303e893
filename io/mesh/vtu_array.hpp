#pragma once
// The numbers of a DataArray of VTK's XML formats, however they are encoded.
//
// Layout: VTK 9.1, "VTK File Formats", XML formats; vtkXMLDataParser for the heading of compressed data.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall::io {

/// The encoding that the file states for all its arrays.
struct VtuEncoding {
  std::string path;  ///< for messages
  bool big_endian = false;
  bool wide_header = false;  ///< lengths of 8 bytes, not 4
  bool zlib = false;         ///< binary and appended data are compressed
  bool appended_base64 = false;
  std::string_view appended;     ///< what follows the '_' of AppendedData
  std::uint64_t most_bytes = 0;  ///< that an array may hold once decompressed
};

/// One array as the file gives it.
struct VtuArray {
  std::string name;          ///< for messages
  std::string type;          ///< "Float64", "Int32", ...
  std::string format;        ///< "ascii", "binary" (base64), "appended"
  std::uint64_t offset = 0;  ///< of appended data
  std::string_view text;     ///< what stands within the element
};

/// The numbers. Reals are converted from integers; integers from reals are refused, and those beyond 2⁶³ − 1. Throws
/// DataError with the array's name: truncated data, another encoding or type, text where a number belongs. Memory and
/// cost are bounded by 1100 times the bytes of the array, which is what zlib can hold, and by most_bytes.
[[nodiscard]] std::vector<double> vtu_reals(const VtuEncoding& encoding, const VtuArray& array);
/// The integers of an array; otherwise as the function above.
[[nodiscard]] std::vector<std::int64_t> vtu_integers(const VtuEncoding& encoding, const VtuArray& array);

}  // namespace thinwall::io
