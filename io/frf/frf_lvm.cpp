#include "io/frf/frf_lvm.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "io/csv_text.hpp"
#include "io/frf/frf_csv.hpp"
#include "io/surface_text.hpp"

namespace thinwall::io {

namespace {

constexpr const char* end_of_header = "***End_of_Header***";

using Fields = std::vector<std::string>;

[[noreturn]] void fail(const std::filesystem::path& path, int line, const std::string& cause) {
  throw core::DataError(path.string() + (line > 0 ? ":" + std::to_string(line) : "") + ": " + cause);
}

/// The file line by line, split at its separator.
class LvmLines {
 public:
  explicit LvmLines(const std::filesystem::path& path) : path_(path), bytes_(core::read_file(path)) {
    if (!next_line().starts_with("LabVIEW Measurement")) fail(path, 1, "is no LabVIEW measurement file");
    const std::size_t told = bytes_.find("\nSeparator");
    if (told != std::string::npos && told + 10 < bytes_.size() && bytes_[told + 10] == ',') separator_ = ',';
  }

  /// The fields of the next line that is not blank; empty at the end of the file.
  Fields next() {
    while (at_ < bytes_.size()) {
      const std::string line = next_line();
      if (line.find_first_not_of(std::string(" ") + separator_) == std::string::npos) continue;
      Fields fields;
      for (std::size_t from = 0; from <= line.size();) {
        const std::size_t to = std::min(line.find(separator_, from), line.size());
        fields.push_back(line.substr(from, to - from));
        from = to + 1;
      }
      return fields;
    }
    return {};
  }

  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::string next_line() {
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    std::string line = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    ++number_;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
  }

  std::filesystem::path path_;
  std::string bytes_;
  std::size_t at_ = 0;
  int number_ = 0;
  char separator_ = '\t';
};

/// The entries of a header, by their first field, up to its end.
using Header = std::map<std::string, Fields>;

Header take_header(LvmLines& lines) {
  Header header;
  for (Fields fields = lines.next(); !fields.empty(); fields = lines.next()) {
    if (fields.front() == end_of_header) return header;
    const std::string name = fields.front();
    fields.erase(fields.begin());
    header.emplace(name, std::move(fields));
  }
  fail(lines.path(), lines.number(), std::string("the file ends before ") + end_of_header);
}

/// The entry of a channel; empty if there is none.
std::string entry_of(const Header& header, const std::string& name, std::size_t channel) {
  const auto found = header.find(name);
  return found == header.end() || channel >= found->second.size() ? "" : found->second[channel];
}

/// The channels whose names contain one of the words.
std::optional<std::size_t> channel_named(const Fields& names, const std::vector<std::string>& words,
                                         const LvmLines& lines) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = lower_case(names[i]);
    if (std::ranges::none_of(words, [&](const std::string& word) { return name.find(word) != std::string::npos; }))
      continue;
    if (found)
      fail(lines.path(), lines.number(),
           "two channels are named as one: \"" + names[*found] + "\" and \"" + names[i] +
               "\"; keep one FRF in the file");
    found = i;
  }
  return found;
}

/// Where the FRF is: the channels of both parts, the factor from the file's phase to radians (none: real and imaginary
/// part), and the coherence's channel.
struct FrfChannels {
  std::size_t first = 0, second = 0;
  std::optional<double> phase_in_rad{};
  std::optional<std::size_t> coherence{};
};

double phase_unit(const Header& header, const Fields& names, std::size_t channel, const LvmLines& lines) {
  const std::string told = lower_case(entry_of(header, "Y_Unit_Label", channel) + " " + names[channel]);
  if (told.find("deg") != std::string::npos) return std::numbers::pi / 180.0;
  if (told.find("rad") != std::string::npos) return 1.0;
  fail(lines.path(), lines.number(), "the phase \"" + names[channel] + "\" has no unit; name it in deg or rad");
}

FrfChannels channels_of(const Header& header, const Fields& names, const LvmLines& lines) {
  FrfChannels channels;
  channels.coherence = channel_named(names, {"coherence"}, lines);
  const auto real = channel_named(names, {"real"}, lines), imaginary = channel_named(names, {"imag"}, lines);
  if (real && imaginary) {
    channels.first = *real;
    channels.second = *imaginary;
    return channels;
  }
  const auto size = channel_named(names, {"magnitude", "mag.", "(mag", "amplitude"}, lines);
  const auto phase = channel_named(names, {"phase"}, lines);
  if (!size || !phase)
    fail(lines.path(), lines.number(),
         "no channels of real and imaginary part, nor of magnitude and phase; name them so");
  if (lower_case(entry_of(header, "Y_Unit_Label", *size) + names[*size]).find("db") != std::string::npos)
    fail(lines.path(), lines.number(), "the magnitude is in dB; write it in a unit");
  channels.first = *size;
  channels.second = *phase;
  channels.phase_in_rad = phase_unit(header, names, *phase, lines);
  return channels;
}

}  // namespace

MeasuredFrf read_lvm_frf(const std::filesystem::path& path, const FrfFormat& format) {
  LvmLines lines(path);
  const Header of_file = take_header(lines);
  const Header of_record = take_header(lines);
  const std::string columns = entry_of(of_file, "X_Columns", 0);
  const bool comma = entry_of(of_file, "Decimal_Separator", 0).starts_with(",");
  Fields names = lines.next();
  if (names.empty() || names.front() != "X_Value")
    fail(path, lines.number(), "the line of X_Value and names is missing");
  names.erase(names.begin());
  if (columns == "Multi") std::erase(names, "X_Value");
  const FrfChannels channels = channels_of(of_record, names, lines);
  if (const std::string over = entry_of(of_record, "X_Dimension", channels.first); !over.empty() && over != "Frequency")
    fail(path, lines.number(), "the channel \"" + names[channels.first] + "\" is over " + over + ", not frequency");

  // The text that the numbers make, with the checks and messages of other tables.
  CsvText text;
  text.path = path;
  text.separator = '\t';
  text.header = {"frequency", "real", "imaginary"};
  if (channels.coherence) text.header.emplace_back("coherence");
  const auto field = [&](const Fields& fields, std::size_t at) {
    std::string word = at < fields.size() ? fields[at] : "";
    if (comma) std::ranges::replace(word, ',', '.');
    return word;
  };
  const auto start = [&](const char* name) {
    CsvText one;
    one.path = path;
    const CsvLine line{lines.number(), {field({entry_of(of_record, name, channels.first)}, 0)}};
    return number(one, line, 0);
  };
  const bool even = columns == "No";
  const double x0 = even ? start("X0") : 0.0, step = even ? start("Delta_X") : 0.0;
  for (Fields fields = lines.next(); !fields.empty(); fields = lines.next()) {
    if (fields.front() == end_of_header || fields.front() == "Channels")
      fail(path, lines.number(), "a second record begins; keep one in the file");
    const auto place = [&](std::size_t channel) { return columns == "Multi" ? 2 * channel + 1 : channel + 1; };
    const std::string x = even ? core::number_text(x0 + static_cast<double>(text.lines.size()) * step)
                               : field(fields, columns == "Multi" ? 2 * channels.first : 0);
    CsvLine line{lines.number(), {x, field(fields, place(channels.first)), field(fields, place(channels.second))}};
    if (channels.phase_in_rad) {
      const double size = number(text, line, 1), phase = number(text, line, 2) * *channels.phase_in_rad;
      line.fields[1] = core::number_text(size * std::cos(phase));
      line.fields[2] = core::number_text(size * std::sin(phase));
    }
    if (channels.coherence) line.fields.push_back(field(fields, place(*channels.coherence)));
    text.lines.push_back(std::move(line));
  }
  return measured_frf(text, format);
}

}  // namespace thinwall::io
