#include "io/matrices/mat4.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/error.hpp"
#include "io/number_at.hpp"

namespace thinwall::io {

namespace {

enum class Mat4Kind { full, text, sparse };

/// The head of a variable. The first number of the format is 1000 M + 100 O + 10 P + T: M tells the byte order, O is 0,
/// P the kind of number, T whether the variable is full, a text or sparse.
struct Mat4Head {
  bool big_endian = false;
  int number = 0;  ///< P: 0 double, 1 single, 2 and 3 signed, 4 and 5 unsigned whole numbers
  Mat4Kind kind = Mat4Kind::full;
  std::size_t rows = 0;
  std::size_t columns = 0;
  bool is_complex = false;
  std::string name;
  std::size_t data = 0;   ///< place of the first number
  std::size_t bytes = 0;  ///< of all numbers
};

constexpr std::size_t mat4_head_size = 20;
constexpr std::array<std::size_t, 6> mat4_number_size{8, 4, 4, 2, 2, 1};

bool is_mat4_name(std::string_view text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !text.empty() && is_letter(text.front()) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

/// The head at a place in the given byte order; nothing if what stands there is none.
std::optional<Mat4Head> mat4_head_in(std::string_view bytes, std::size_t at, bool big_endian) {
  if (bytes.size() - at < mat4_head_size) return std::nullopt;
  std::array<std::int64_t, 5> field{};
  for (std::size_t i = 0; i < 5; ++i) field[i] = number_at<std::int32_t>(bytes, at + 4 * i, big_endian);
  const auto [type, rows, columns, is_complex, name_length] = field;
  const bool sound = type >= 0 && type / 1000 == (big_endian ? 1 : 0) && type / 100 % 10 == 0 && type / 10 % 10 <= 5 &&
                     type % 10 <= 2 && rows >= 0 && columns >= 0 && (is_complex == 0 || is_complex == 1) &&
                     name_length >= 2 && name_length <= 512;
  const auto length = static_cast<std::size_t>(name_length);
  if (!sound || bytes.size() - at - mat4_head_size < length) return std::nullopt;
  const std::string_view name = bytes.substr(at + mat4_head_size, length);
  if (name.back() != '\0' || !is_mat4_name(name.substr(0, name.find('\0')))) return std::nullopt;
  Mat4Head head;
  head.big_endian = big_endian;
  head.number = static_cast<int>(type / 10 % 10);
  head.kind = static_cast<Mat4Kind>(type % 10);
  head.rows = static_cast<std::size_t>(rows);
  head.columns = static_cast<std::size_t>(columns);
  head.is_complex = is_complex == 1;
  head.name = name.substr(0, name.find('\0'));
  head.data = at + mat4_head_size + length;
  head.bytes =
      head.rows * head.columns * mat4_number_size[static_cast<std::size_t>(head.number)] * (head.is_complex ? 2 : 1);
  return head;
}

std::optional<Mat4Head> mat4_head_at(std::string_view bytes, std::size_t at) {
  std::optional<Mat4Head> head = mat4_head_in(bytes, at, false);
  return head ? head : mat4_head_in(bytes, at, true);
}

/// A reader of one variable, whose numbers lie within the bytes.
class Mat4Variable {
 public:
  Mat4Variable(std::string_view bytes, const Mat4Head& head, const std::string& path)
      : bytes_(bytes), head_(head), path_(path) {}

  [[nodiscard]] MatVariable read() const {
    if (head_.kind == Mat4Kind::text) fail("is a text; numbers belong there");
    MatVariable variable{head_.name, {head_.rows, head_.columns}, {}};
    if (head_.kind == Mat4Kind::sparse) {
      read_sparse(variable);
      return variable;
    }
    const std::size_t count = head_.rows * head_.columns;
    variable.re = numbers(0, count);
    if (head_.is_complex) variable.im = numbers(count, count);
    return variable;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw core::DataError(path_ + ": the variable " + head_.name + " " + what);
  }

  [[nodiscard]] double number(std::size_t i) const {
    const std::size_t at = head_.data + i * mat4_number_size[static_cast<std::size_t>(head_.number)];
    switch (head_.number) {
      case 0:
        return number_at<double>(bytes_, at, head_.big_endian);
      case 1:
        return number_at<float>(bytes_, at, head_.big_endian);
      case 2:
        return number_at<std::int32_t>(bytes_, at, head_.big_endian);
      case 3:
        return number_at<std::int16_t>(bytes_, at, head_.big_endian);
      case 4:
        return number_at<std::uint16_t>(bytes_, at, head_.big_endian);
      default:
        return number_at<std::uint8_t>(bytes_, at, head_.big_endian);
    }
  }

  [[nodiscard]] std::vector<double> numbers(std::size_t first, std::size_t count) const {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) {
      values[i] = number(first + i);
      if (!std::isfinite(values[i])) fail("holds NaN or infinity");
    }
    return values;
  }

  /// A row or column, or the number of them in the last row, as a whole number from `least` to `most`.
  [[nodiscard]] int whole(double value, int least, double most) const {
    if (value >= least && value <= most && value == std::floor(value)) return static_cast<int>(value);
    fail("has an entry in no row or column of it, or too many of these: write it again");
  }

  /// The entries are rows of row, column and value; the last one has the numbers of rows and columns.
  void read_sparse(MatVariable& variable) const {
    if (head_.is_complex || head_.columns != 3 || head_.rows == 0) fail("is no real sparse matrix");
    const std::vector<double> all = numbers(0, 3 * head_.rows);
    const std::size_t last = head_.rows - 1;
    const double most = std::min(64.0 * static_cast<double>(bytes_.size()), 2147483646.0);
    const int rows = whole(all[last], 0, most), columns = whole(all[head_.rows + last], 0, most);
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i < last; ++i)
      entries.emplace_back(whole(all[i], 1, rows) - 1, whole(all[head_.rows + i], 1, columns) - 1,
                           all[2 * head_.rows + i]);
    variable.is_sparse = true;
    variable.size = {static_cast<std::size_t>(rows), static_cast<std::size_t>(columns)};
    variable.sparse.resize(rows, columns);
    variable.sparse.setFromTriplets(entries.begin(), entries.end());
  }

  std::string_view bytes_;
  const Mat4Head& head_;
  const std::string& path_;
};

}  // namespace

bool is_mat4(std::string_view bytes) {
  return mat4_head_at(bytes, 0).has_value();
}

MatVariables mat4_variables(std::string_view bytes, const std::vector<std::string>& names, const std::string& path) {
  MatVariables variables;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::optional<Mat4Head> head = mat4_head_at(bytes, at);
    if (!head || head->bytes > bytes.size() - head->data)
      throw core::DataError(path + ": is no whole MAT file of version 4; write it again, by save(…, '-v7')");
    if (std::find(names.begin(), names.end(), head->name) != names.end())
      variables.insert_or_assign(head->name, Mat4Variable(bytes, *head, path).read());
    at = head->data + head->bytes;
  }
  return variables;
}

}  // namespace thinwall::io
