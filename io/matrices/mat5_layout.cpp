#include "io/matrices/mat5_layout.hpp"

#include <array>
#include <cstdint>
#include <cstring>

#include "io/matrices/mat_variables.hpp"

namespace thinwall::io {

namespace {

// Types of elements and kinds of arrays, by their numbers in the format.
constexpr std::uint32_t int32_type = 5, uint32_type = 6, matrix_type = 14, compressed_type = 15;
constexpr std::uint32_t struct_kind = 2, object_kind = 3, sparse_kind = 5, last_kind = 15;

/// Checks the head of an array that is not compressed: flags, dimensions, whose product must be possible in its `size`
/// bytes, and the name. With impossible dimensions matio takes minutes.
void require_head(const std::string& bytes, std::size_t at, std::size_t size, const std::filesystem::path& path) {
  constexpr std::size_t head_size = 24;  // the tag of the flags, the flags, the tag of the dimensions
  std::array<std::uint32_t, 6> head{};
  if (size < head_size || at + size > bytes.size()) return;  // refused as not whole, or empty
  std::memcpy(head.data(), bytes.data() + at, head_size);
  const std::uint32_t kind = head[2] & 0xFFU;
  if (kind == struct_kind || kind == object_kind || kind > last_kind) return;  // none of these is read
  const std::size_t dimensions = head[5] / 4;
  bool whole = head[0] == uint32_type && head[1] == 8 && head[4] == int32_type && head[5] <= size - head_size;
  std::size_t left = size;
  for (std::size_t i = kind == sparse_kind ? 1 : 0; whole && i < dimensions; ++i) {
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + at + head_size + 4 * i, sizeof length);
    left = length == 0 ? size : left / length;
    whole = left > 0;
  }
  const std::size_t name_at = head_size + (head[5] + 7) / 8 * 8;
  std::array<std::uint32_t, 2> name{};
  whole = whole && name_at + 8 <= size;
  if (whole) std::memcpy(name.data(), bytes.data() + at + name_at, 8);
  whole = whole && (name[0] > 0xFFFFU || name[1] <= size - name_at - 8);  // a short name lies within its tag
  if (!whole) fail_in(path, "has a variable that states more than its bytes hold; write it again");
}

}  // namespace

std::size_t require_whole_mat5(const std::string& bytes, const std::filesystem::path& path) {
  constexpr std::size_t header_size = 128;
  constexpr std::size_t tag_size = 8;
  std::size_t at = header_size;
  bool compressed = false;
  while (at + tag_size <= bytes.size()) {
    std::array<std::uint32_t, 2> tag{};
    std::memcpy(tag.data(), bytes.data() + at, tag_size);
    const std::size_t size = tag[1];
    if (tag[0] == matrix_type) require_head(bytes, at + tag_size, size, path);
    compressed = compressed || tag[0] == compressed_type;
    at += tag_size + (tag[0] == compressed_type ? size : (size + 7) / 8 * 8);
  }
  if (at != bytes.size()) fail_in(path, "is no whole MAT file of version 5; write it again with that version");
  constexpr std::size_t most_by_deflate = 1032;
  return bytes.size() * (compressed ? most_by_deflate : 1);
}

}  // namespace thinwall::io
