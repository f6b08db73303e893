#include "io/matrices/fortran_records.hpp"

#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "io/number_at.hpp"

namespace thinwall::io {

bool is_record(std::string_view bytes, std::size_t at, std::int32_t length, bool big_endian) {
  const std::size_t end = at + 4 + static_cast<std::size_t>(length);
  return bytes.size() >= end + 4 && number_at<std::int32_t>(bytes, at, big_endian) == length &&
         number_at<std::int32_t>(bytes, end, big_endian) == length;
}

FortranRecords::FortranRecords(std::string_view bytes, std::string path, bool big_endian, bool wide)
    : bytes_(bytes), path_(std::move(path)), big_endian_(big_endian), wide_(wide) {}

void FortranRecords::open() {
  if (bytes_.size() - at_ < 4) fail("the file ends within a matrix: export it again");
  const auto length = number_at<std::int32_t>(bytes_, at_, big_endian_);
  at_ += 4;
  if (length < 0 || bytes_.size() - at_ < 4 || bytes_.size() - at_ - 4 < static_cast<std::size_t>(length))
    fail("a record of " + std::to_string(length) + " bytes is not whole: export the file again");
  end_ = at_ + static_cast<std::size_t>(length);
  if (number_at<std::int32_t>(bytes_, end_, big_endian_) != length)
    fail("a record begins and ends with different lengths: export the file again");
}

std::int64_t FortranRecords::whole() {
  if (left() < word()) fail("a record ends before its whole numbers do: export the file again");
  const std::int64_t value =
      wide_ ? number_at<std::int64_t>(bytes_, at_, big_endian_) : number_at<std::int32_t>(bytes_, at_, big_endian_);
  at_ += word();
  if (value > most || value < -most) fail(std::to_string(value) + " is no whole number that belongs here");
  return value;
}

std::string_view FortranRecords::text(std::size_t count) {
  if (left() < count) fail("a record ends before its text does: export the file again");
  at_ += count;
  return bytes_.substr(at_ - count, count);
}

void FortranRecords::numbers(std::int64_t count, bool single, std::vector<double>& values) {
  values.clear();
  const std::size_t size = single ? 4 : 8;
  if (count < 0 || static_cast<std::size_t>(count) > left() / size)
    fail("more numbers are stated than the record holds: export the file again");
  for (std::int64_t i = 0; i < count; ++i) {
    values.push_back(single ? number_at<float>(bytes_, at_, big_endian_) : number_at<double>(bytes_, at_, big_endian_));
    if (!std::isfinite(values.back())) fail("a number is not finite");
    at_ += size;
  }
}

void FortranRecords::fail(const std::string& what) const {
  throw core::DataError(path_ + ": byte " + std::to_string(at_) + ": " + what);
}

}  // namespace thinwall::io
