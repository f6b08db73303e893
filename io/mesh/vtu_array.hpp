#pragma once
// The numbers of a DataArray of VTK's XML formats, in any of their encodings.
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
  bool wide_header = false;  ///< true if lengths have 8 bytes, not 4
  bool zlib = false;         ///< true if binary and appended data are compressed
  bool appended_base64 = false;
  std::string_view appended;     ///< the bytes behind the '_' of AppendedData
  std::uint64_t most_bytes = 0;  ///< largest size of an array after decompression
};

/// One array as it stands in the file.
struct VtuArray {
  std::string name;          ///< for messages
  std::string type;          ///< "Float64", "Int32", ...
  std::string format;        ///< "ascii", "binary" (base64), "appended"
  std::uint64_t offset = 0;  ///< place of appended data
  std::string_view text;     ///< content of the element
};

/// The real numbers of an array, also if they are stored as integers. Throws DataError with the array's name for
/// truncated data, another encoding or type, and text in place of a number. Memory and cost are bounded by 1100 times
/// the bytes of the array, which is more than zlib can expand, and by most_bytes.
[[nodiscard]] std::vector<double> vtu_reals(const VtuEncoding& encoding, const VtuArray& array);
/// The integers of an array. Throws as vtu_reals() does, and for reals and numbers beyond 2⁶³ − 1.
[[nodiscard]] std::vector<std::int64_t> vtu_integers(const VtuEncoding& encoding, const VtuArray& array);

}  // namespace thinwall::io
