#pragma once
// The entries of a ZIP archive, which is what a 3MF file is.
//
// Layout: PKWARE, APPNOTE.TXT, "ZIP File Format Specification", sections 4.3 and 4.4.

#include <string>
#include <string_view>
#include <vector>

namespace thinwall::io {

/// An entry of the archive's directory.
struct ZipEntry {
  std::string name;
  bool deflated = false;       ///< stored otherwise
  std::string_view data;       ///< as it lies in the archive
  std::size_t size = 0;        ///< of the contents, bytes
  unsigned long checksum = 0;  ///< CRC-32 of the contents
};

/// The entries that the archive's directory lists; they refer to the bytes. `path` is for messages. Throws DataError
/// for a file that is no archive or not whole, one in several pieces, ZIP64, encrypted entries, and methods of
/// compression other than deflate. Cost O(entries).
[[nodiscard]] std::vector<ZipEntry> zip_entries(std::string_view bytes, const std::string& path);

/// The contents of an entry. Throws DataError if they are damaged, or state more bytes than deflate can make of their
/// data. Cost O(bytes).
[[nodiscard]] std::string zip_contents(const ZipEntry& entry, const std::string& path);

}  // namespace thinwall::io
