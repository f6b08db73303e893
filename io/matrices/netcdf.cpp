#include "io/matrices/netcdf.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/error.hpp"
#include "io/number_at.hpp"

namespace thinwall::io {

namespace {

constexpr std::string_view hdf5 = "\x89HDF\r\n\x1a\n";

/// Bytes of a value of each type, by the specification's number of the type; 0: none.
constexpr std::array<std::size_t, 12> widths{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};

/// The marks of the three lists of a heading.
enum class List : std::uint8_t { dimensions = 0x0a, variables = 0x0b, attributes = 0x0c };

std::size_t width_of(std::int64_t type) {
  return type > 0 && type < std::ssize(widths) ? widths[static_cast<std::size_t>(type)] : 0;
}

/// Reads a heading from front to back.
class NetcdfHeading {
 public:
  NetcdfHeading(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path), version_(bytes[3]) {}

  std::vector<NetcdfVariable> variables() {
    (void)count();  // records
    std::vector<std::int64_t> lengths;
    for (std::int64_t left = entries(List::dimensions); left > 0; --left) {
      (void)name();
      lengths.push_back(count());
    }
    skip_attributes();
    std::vector<NetcdfVariable> result;
    for (std::int64_t left = entries(List::variables); left > 0; --left) result.push_back(variable(lengths));
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw core::DataError(path_ + ": byte " + std::to_string(at_) + ": " + what + ": export the file again");
  }

  /// The bytes that are read next; the file must contain them.
  std::string_view take(std::int64_t length) {
    if (length < 0 || static_cast<std::uint64_t>(length) > bytes_.size() - at_)
      fail("the file ends within its heading");
    const std::string_view taken = bytes_.substr(at_, static_cast<std::size_t>(length));
    at_ += taken.size();
    return taken;
  }

  std::int64_t word() { return number_at<std::int32_t>(take(4), 0, true); }
  std::int64_t long_word() { return number_at<std::int64_t>(take(8), 0, true); }
  /// A length or a number of entries, which CDF-5 writes in 8 bytes. The number of records may be −1.
  std::int64_t count() { return version_ == 5 ? long_word() : word(); }
  void fill_up() { (void)take(static_cast<std::int64_t>((4 - at_ % 4) % 4)); }

  /// A name, in which the specification allows no control characters.
  std::string name() {
    const std::string result(take(count()));
    if (std::ranges::any_of(result, [](unsigned char c) { return std::iscntrl(c) != 0; }))
      fail("a name contains a control character");
    fill_up();
    return result;
  }

  /// The number of entries of a list, which must be the one named, or absent.
  std::int64_t entries(List list) {
    const std::int64_t mark = word();
    const std::int64_t number = count();
    if ((mark != static_cast<std::int64_t>(list) && (mark != 0 || number != 0)) || number < 0)
      fail("another list begins than is expected");
    return number;
  }

  void skip_attributes() {
    for (std::int64_t left = entries(List::attributes); left > 0; --left) {
      (void)name();
      const auto width = static_cast<std::int64_t>(width_of(word()));
      const std::int64_t number = count();
      if (width == 0 || number > std::ssize(bytes_)) fail("an attribute has no known type, or no length");
      (void)take(width * number);
      fill_up();
    }
  }

  NetcdfVariable variable(const std::vector<std::int64_t>& lengths) {
    NetcdfVariable result;
    result.name = name();
    for (std::int64_t left = count(); left > 0; --left) {
      const std::int64_t dimension = count();
      if (dimension < 0 || dimension >= std::ssize(lengths)) fail(result.name + " has an unknown dimension");
      result.size.push_back(lengths[static_cast<std::size_t>(dimension)]);
    }
    result.by_record = !result.size.empty() && result.size.front() == 0;
    skip_attributes();
    result.type = static_cast<int>(word());
    (void)count();  // its bytes, of which large variables state a wrong number
    const std::int64_t begin = version_ == 1 ? word() : long_word();
    if (width_of(result.type) == 0 || begin < 0) fail(result.name + " has no known type, or begins nowhere");
    result.begin = static_cast<std::size_t>(begin);
    return result;
  }

  std::string_view bytes_;
  std::string path_;
  int version_;
  std::size_t at_ = 4;
};

double value_at(std::string_view bytes, std::size_t at, int type) {
  switch (type) {
    case 1:
      return number_at<std::int8_t>(bytes, at, true);
    case 3:
      return number_at<std::int16_t>(bytes, at, true);
    case 4:
      return number_at<std::int32_t>(bytes, at, true);
    case 5:
      return static_cast<double>(number_at<float>(bytes, at, true));
    case 6:
      return number_at<double>(bytes, at, true);
    case 7:
      return number_at<std::uint8_t>(bytes, at, true);
    case 8:
      return number_at<std::uint16_t>(bytes, at, true);
    case 9:
      return number_at<std::uint32_t>(bytes, at, true);
    case 10:
      return static_cast<double>(number_at<std::int64_t>(bytes, at, true));
    default:
      return static_cast<double>(number_at<std::uint64_t>(bytes, at, true));
  }
}

/// The number of values of a variable that lies within so many bytes; −1 if it does not.
std::int64_t number_within(const NetcdfVariable& variable, std::size_t bytes) {
  if (variable.begin > bytes) return -1;
  const auto most = static_cast<std::int64_t>((bytes - variable.begin) / width_of(variable.type));
  std::int64_t number = 1;
  for (const std::int64_t length : variable.size) {
    if (length < 0 || (length > 0 && number > most / length)) return -1;
    number *= length;
  }
  return number <= most ? number : -1;  // a variable without dimensions has one value
}

}  // namespace

bool is_netcdf(std::string_view bytes) {
  return bytes.size() > 4 && bytes.starts_with("CDF") && (bytes[3] == 1 || bytes[3] == 2 || bytes[3] == 5);
}

bool is_netcdf4(std::string_view bytes) {
  const auto names = [&](std::string_view attribute) { return bytes.find(attribute) != std::string_view::npos; };
  return bytes.starts_with(hdf5) && (names("_NCProperties") || names("_Netcdf4"));
}

std::vector<NetcdfVariable> netcdf_variables(std::string_view bytes, const std::string& path) {
  if (!is_netcdf(bytes)) throw core::DataError(path + ": is no NetCDF file of a classic format");
  return NetcdfHeading(bytes, path).variables();
}

const NetcdfVariable* find_variable(const std::vector<NetcdfVariable>& variables, std::string_view name) {
  const auto found = std::ranges::find(variables, name, &NetcdfVariable::name);
  return found == variables.end() ? nullptr : &*found;
}

std::vector<double> netcdf_values(std::string_view bytes, const NetcdfVariable& variable, const std::string& path) {
  const std::string where = path + ": the variable " + variable.name;
  constexpr int character = 2;
  if (variable.type == character) throw core::DataError(where + " is text, not numbers");
  if (variable.by_record) throw core::DataError(where + " has the unlimited dimension: write it with fixed ones");
  const std::int64_t number = number_within(variable, bytes.size());
  if (number < 0) throw core::DataError(where + " reaches beyond the end of the file: export the file again");
  std::vector<double> values(static_cast<std::size_t>(number));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = value_at(bytes, variable.begin + i * width_of(variable.type), variable.type);
    if (!std::isfinite(values[i])) throw core::DataError(where + " contains a value that is not finite");
  }
  return values;
}

}  // namespace thinwall::io
