#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "io/matrices/op4_source.hpp"
#include "io/mesh/inp_text.hpp"
#include "io/number_at.hpp"

namespace thinwall::io {

namespace {

/// The lengths of the record of a head: four whole numbers and eight characters, in words of 4 or 8 bytes.
constexpr std::int32_t narrow_head = 24, wide_head = 48;

/// True if a record of that length begins and ends where it should.
bool is_record(std::string_view bytes, std::int32_t length, bool big_endian) {
  const std::size_t end = 4 + static_cast<std::size_t>(length);
  return bytes.size() >= end + 4 && number_at<std::int32_t>(bytes, 0, big_endian) == length &&
         number_at<std::int32_t>(bytes, end, big_endian) == length;
}

}  // namespace

bool Op4Bytes::begins(std::string_view bytes) {
  for (const bool big_endian : {false, true})
    for (const std::int32_t length : {narrow_head, wide_head})
      if (is_record(bytes, length, big_endian)) return true;
  return false;
}

Op4Bytes::Op4Bytes(std::string_view bytes, std::string path) : bytes_(bytes), path_(std::move(path)) {
  big_endian_ = is_record(bytes, narrow_head, true) || is_record(bytes, wide_head, true);
  wide_ = is_record(bytes, wide_head, big_endian_);
}

void Op4Bytes::open_record() {
  if (bytes_.size() - at_ < 4) fail("the file ends within a matrix: export it again");
  const auto length = number_at<std::int32_t>(bytes_, at_, big_endian_);
  at_ += 4;
  if (length < 0 || bytes_.size() - at_ < 4 || bytes_.size() - at_ - 4 < static_cast<std::size_t>(length))
    fail("a record of " + std::to_string(length) + " bytes is not whole: export the file again");
  end_ = at_ + static_cast<std::size_t>(length);
  if (number_at<std::int32_t>(bytes_, end_, big_endian_) != length)
    fail("a record begins and ends with different lengths: export the file again");
}

std::int64_t Op4Bytes::whole() {
  const std::size_t size = wide_ ? 8 : 4;
  if (end_ - at_ < size) fail("a record ends before its whole numbers do: export the file again");
  const std::int64_t value =
      wide_ ? number_at<std::int64_t>(bytes_, at_, big_endian_) : number_at<std::int32_t>(bytes_, at_, big_endian_);
  at_ += size;
  if (value > most_in_op4 || value < -most_in_op4)
    fail(std::to_string(value) + " is no whole number that belongs here");
  return value;
}

std::optional<Op4Head> Op4Bytes::head() {
  if (at_ == bytes_.size()) return std::nullopt;
  open_record();
  if (end_ - at_ != static_cast<std::size_t>(wide_ ? wide_head : narrow_head))
    fail("the head of a matrix has another length: export the file again");
  Op4Head head;
  for (std::int64_t* number : {&head.columns, &head.rows, &head.form, &head.type}) *number = whole();
  std::string name(bytes_.substr(at_, end_ - at_));
  name.erase(std::remove_if(name.begin(), name.end(), [](char c) { return c <= ' ' || c > '~'; }), name.end());
  head.name = capitals(name);
  single_ = head.type == 1 || head.type == 3;
  at_ = end_ + 4;
  return head;
}

Op4Column Op4Bytes::column() {
  open_record();
  Op4Column column;
  for (std::int64_t* number : {&column.column, &column.row, &column.words}) *number = whole();
  return column;
}

Op4String Op4Bytes::string(bool large) {
  const std::int64_t first = whole();
  if (!large) return op4_string(first);
  return {whole(), first - 1};
}

void Op4Bytes::numbers(std::int64_t count, std::vector<double>& values) {
  values.clear();
  const bool narrow = single_ && !wide_;
  const std::size_t size = narrow ? 4 : 8;
  if (count < 0 || static_cast<std::size_t>(count) > (end_ - at_) / size)
    fail("more numbers are stated than the record holds: export the file again");
  for (std::int64_t i = 0; i < count; ++i) {
    values.push_back(narrow ? number_at<float>(bytes_, at_, big_endian_) : number_at<double>(bytes_, at_, big_endian_));
    if (!std::isfinite(values.back())) fail("a number is not finite");
    at_ += size;
  }
}

void Op4Bytes::end_column() {
  if (at_ != end_) fail("a column has another length than its record: export the file again");
  at_ = end_ + 4;
}

void Op4Bytes::fail(const std::string& what) const {
  throw core::DataError(path_ + ": byte " + std::to_string(at_) + ": " + what);
}

}  // namespace thinwall::io
