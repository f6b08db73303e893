#include <algorithm>

#include "io/matrices/op4_source.hpp"
#include "io/mesh/inp_text.hpp"

namespace thinwall::io {

namespace {

/// The lengths of the record of a head: four whole numbers and eight characters, in words of 4 or 8 bytes.
constexpr std::int32_t narrow_head = 24, wide_head = 48;

bool is_wide(std::string_view bytes) {
  return is_record(bytes, 0, wide_head, false) || is_record(bytes, 0, wide_head, true);
}

bool is_big_endian(std::string_view bytes) {
  return is_record(bytes, 0, narrow_head, true) || is_record(bytes, 0, wide_head, true);
}

}  // namespace

bool Op4Bytes::begins(std::string_view bytes) {
  return is_record(bytes, 0, narrow_head, false) || is_record(bytes, 0, narrow_head, true) || is_wide(bytes);
}

Op4Bytes::Op4Bytes(std::string_view bytes, std::string path)
    : records_(bytes, std::move(path), is_big_endian(bytes), is_wide(bytes)) {}

std::optional<Op4Head> Op4Bytes::head() {
  if (records_.at_end()) return std::nullopt;
  records_.open();
  if (records_.left() != static_cast<std::size_t>(records_.word() == 8 ? wide_head : narrow_head))
    fail("the head of a matrix has another length: export the file again");
  Op4Head head;
  for (std::int64_t* number : {&head.columns, &head.rows, &head.form, &head.type}) *number = records_.whole();
  std::string name(records_.text(records_.left()));
  name.erase(std::remove_if(name.begin(), name.end(), [](char c) { return c <= ' ' || c > '~'; }), name.end());
  head.name = capitals(name);
  single_ = head.type == 1 || head.type == 3;
  records_.close();
  return head;
}

Op4Column Op4Bytes::column() {
  records_.open();
  Op4Column column;
  for (std::int64_t* number : {&column.column, &column.row, &column.words}) *number = records_.whole();
  return column;
}

Op4String Op4Bytes::string(bool large) {
  const std::int64_t first = records_.whole();
  if (!large) return op4_string(first);
  return {records_.whole(), first - 1};
}

void Op4Bytes::numbers(std::int64_t count, std::vector<double>& values) {
  records_.numbers(count, single_ && records_.word() == 4, values);
}

void Op4Bytes::end_column() {
  if (records_.left() != 0) fail("a column has another length than its record: export the file again");
  records_.close();
}

}  // namespace thinwall::io
