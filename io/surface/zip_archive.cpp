#include "io/surface/zip_archive.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdint>

#include "core/error.hpp"
#include "io/surface_text.hpp"

namespace thinwall::io {

namespace {

constexpr std::size_t end_size = 22, longest_comment = 65535, entry_size = 46, head_size = 30;
constexpr std::size_t largest_deflate_expansion = 1100;  ///< by deflate, whose largest ratio is 1032
constexpr std::uint32_t end_mark = 0x06054b50, entry_mark = 0x02014b50, head_mark = 0x04034b50;

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw core::DataError(path + ": " + what);
}

/// The number of `count` bytes, least first.
std::uint32_t number_in(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t k = count; k-- > 0;) value = (value << 8U) | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

/// The place of the record at the archive's end, behind which there is a comment only.
std::size_t end_of(std::string_view bytes, const std::string& path) {
  if (bytes.size() >= end_size) {
    const std::size_t first = bytes.size() - std::min(bytes.size(), end_size + longest_comment);
    for (std::size_t at = bytes.size() - end_size + 1; at-- > first;) {
      if (number_in(bytes, at, 4) == end_mark) return at;
    }
  }
  fail(path, "is no ZIP archive, or not whole");
}

/// The data of the entry whose head lies at `at`.
std::string_view data_at(std::string_view bytes, std::size_t at, std::size_t size, const std::string& path) {
  if (at > bytes.size() || bytes.size() - at < head_size || number_in(bytes, at, 4) != head_mark)
    fail(path, "an entry of the archive is not where its directory says");
  const std::size_t begin = at + head_size + number_in(bytes, at + 26, 2) + number_in(bytes, at + 28, 2);
  if (begin > bytes.size() || bytes.size() - begin < size) fail(path, "the archive ends within an entry");
  return bytes.substr(begin, size);
}

}  // namespace

std::vector<ZipEntry> zip_entries(std::string_view bytes, const std::string& path) {
  const std::size_t end = end_of(bytes, path);
  const std::uint32_t count = number_in(bytes, end + 10, 2);
  std::size_t at = number_in(bytes, end + 16, 4);
  if (number_in(bytes, end + 4, 2) != 0 || number_in(bytes, end + 8, 2) != count)
    fail(path, "the archive is in several pieces");
  if (count == 0xFFFF || at == 0xFFFFFFFF) fail(path, "is a ZIP64 archive, which is not read");
  std::vector<ZipEntry> entries;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (at > end || end - at < entry_size || number_in(bytes, at, 4) != entry_mark)
      fail(path, "the directory of the archive is damaged");
    const std::uint32_t flags = number_in(bytes, at + 8, 2), method = number_in(bytes, at + 10, 2);
    const std::size_t name = number_in(bytes, at + 28, 2);
    const std::size_t behind = name + number_in(bytes, at + 30, 2) + number_in(bytes, at + 32, 2);
    if (end - at - entry_size < behind) fail(path, "the directory of the archive is damaged");
    ZipEntry entry;
    entry.name = std::string(bytes.substr(at + entry_size, name));
    if ((flags & 1U) != 0) fail(path, "the entry " + io::quoted(entry.name) + " is encrypted");
    if (method != 0 && method != 8)
      fail(path, "the entry " + io::quoted(entry.name) + " is compressed by another method than deflate");
    entry.deflated = method == 8;
    entry.checksum = number_in(bytes, at + 16, 4);
    entry.size = number_in(bytes, at + 24, 4);
    entry.data = data_at(bytes, number_in(bytes, at + 42, 4), number_in(bytes, at + 20, 4), path);
    entries.push_back(std::move(entry));
    at += entry_size + behind;
  }
  return entries;
}

std::string zip_contents(const ZipEntry& entry, const std::string& path) {
  const std::string what = "the entry " + io::quoted(entry.name) + " of the archive is damaged";
  std::string contents;
  if (!entry.deflated) {
    contents = std::string(entry.data);
  } else {
    if (entry.size > largest_deflate_expansion * (entry.data.size() + 1)) fail(path, what);
    contents.resize(entry.size);
    z_stream stream{};
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(entry.data.data()));
    stream.avail_in = static_cast<uInt>(entry.data.size());
    stream.next_out = reinterpret_cast<Bytef*>(contents.data());
    stream.avail_out = static_cast<uInt>(contents.size());
    if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) fail(path, what);
    const int status = inflate(&stream, Z_FINISH);
    inflateEnd(&stream);
    if (status != Z_STREAM_END || stream.avail_out != 0) fail(path, what);
  }
  const auto checksum = crc32(0L, reinterpret_cast<const Bytef*>(contents.data()), static_cast<uInt>(contents.size()));
  if (contents.size() != entry.size || checksum != entry.checksum) fail(path, what);
  return contents;
}

}  // namespace thinwall::io
