#pragma once
// ZIP archives by hand, from the specification: heads with data, a directory, its end.

#include <zlib.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace thinwall::io::test {

inline std::string least_first(std::uint32_t value, int bytes) {
  std::string text;
  for (int k = 0; k < bytes; ++k) text += static_cast<char>((value >> (8 * k)) & 0xFFU);
  return text;
}

inline std::string deflated(const std::string& text) {
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string packed(text.size() + 100, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(packed.size() - stream.avail_out);
  deflateEnd(&stream);
  return packed;
}

/// An archive of files by name and contents, deflated or stored.
inline std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files, bool packed) {
  std::string bytes, directory;
  for (const auto& [name, contents] : files) {
    const std::string data = packed ? deflated(contents) : contents;
    const auto checksum =
        crc32(0L, reinterpret_cast<const Bytef*>(contents.data()), static_cast<uInt>(contents.size()));
    const std::string common = least_first(0, 2) + least_first(packed ? 8 : 0, 2) + least_first(0, 4) +
                               least_first(static_cast<std::uint32_t>(checksum), 4) +
                               least_first(static_cast<std::uint32_t>(data.size()), 4) +
                               least_first(static_cast<std::uint32_t>(contents.size()), 4) +
                               least_first(static_cast<std::uint32_t>(name.size()), 2) + least_first(0, 2);
    directory += least_first(0x02014b50, 4) + least_first(20, 2) + least_first(20, 2) + common + least_first(0, 2) +
                 least_first(0, 4) + least_first(0, 4) + least_first(static_cast<std::uint32_t>(bytes.size()), 4) +
                 name;
    bytes += least_first(0x04034b50, 4) + least_first(20, 2) + common + name + data;
  }
  const auto count = static_cast<std::uint32_t>(files.size());
  return bytes + directory + least_first(0x06054b50, 4) + least_first(0, 4) + least_first(count, 2) +
         least_first(count, 2) + least_first(static_cast<std::uint32_t>(directory.size()), 4) +
         least_first(static_cast<std::uint32_t>(bytes.size()), 4) + least_first(0, 2);
}

}  // namespace thinwall::io::test
