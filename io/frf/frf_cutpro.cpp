#include "io/frf/frf_cutpro.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/csv_text.hpp"
#include "io/frf/frf_csv.hpp"

namespace thinwall::io {

namespace {

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// True if the first three words are numbers.
bool starts_with_numbers(const std::vector<std::string>& words) {
  return words.size() >= 3 && std::all_of(words.begin(), words.begin() + 3, [](const auto& w) { return is_number(w); });
}

// Every word before the numbers is tried as four units, so that their number is limited; a file of another kind is then
// recognised soon.
constexpr int most_words = 1000;
constexpr std::size_t longest_unit = 32;

/// Units and quantity that the words of a header give.
struct Told {
  std::optional<FrfFormat> frf;  ///< quantity and unit
  std::optional<double> in_hz;
  int words = 0;  ///< seen so far
};

bool equal(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::abs(b);
}

std::optional<FrfFormat> format_of_unit(const std::string& word) {
  for (const FrfQuantity quantity : {FrfQuantity::receptance, FrfQuantity::mobility, FrfQuantity::accelerance}) {
    try {
      return frf_format(quantity, word, "Hz");
    } catch (const core::InputError&) {
    }
  }
  return std::nullopt;
}

std::optional<double> frequency_unit(const std::string& word) {
  try {
    return frf_format(FrfQuantity::receptance, "m/N", word).unit_in_hz;
  } catch (const core::InputError&) {
    return std::nullopt;
  }
}

void take_word(const std::string& bracketed, Told& told, const std::string& location) {
  if (++told.words > most_words) {
    throw core::DataError(location + ": more than " + std::to_string(most_words) +
                          " words before the lines of three numbers; a .frf file has a short heading, or none");
  }
  constexpr const char* outer = "()[]{},;:\"";
  const auto first = bracketed.find_first_not_of(outer);
  if (first == std::string::npos) return;
  const std::string word = bracketed.substr(first, bracketed.find_last_not_of(outer) - first + 1);
  if (word.size() > longest_unit) return;
  if (const auto in_hz = frequency_unit(word)) {
    if (told.in_hz && *told.in_hz != *in_hz) throw core::DataError(location + ": two different units of frequency");
    told.in_hz = in_hz;
  }
  if (const auto format = format_of_unit(word)) {
    if (told.frf && (told.frf->quantity != format->quantity || told.frf->unit_in_si != format->unit_in_si)) {
      throw core::DataError(location + ": \"" + word + "\" is another unit than the one before; keep one");
    }
    told.frf = format;
  }
}

FrfFormat agreed(const Told& told, const std::optional<FrfFormat>& stated, const std::string& source) {
  if (!stated) {
    if (told.frf && told.in_hz) return {told.frf->quantity, told.frf->unit_in_si, *told.in_hz};
    throw core::DataError(source + ": tells no unit of the " + (told.frf ? "frequency" : "response") +
                          "; state quantity and units");
  }
  const bool same_frf =
      !told.frf || (told.frf->quantity == stated->quantity && equal(told.frf->unit_in_si, stated->unit_in_si));
  const bool same_frequency = !told.in_hz || equal(*told.in_hz, stated->unit_in_hz);
  if (same_frf && same_frequency) return *stated;
  throw core::DataError(source + ": the file's header tells another " +
                        (same_frf ? "unit of frequency" : "quantity or unit") +
                        " than the one that is stated; correct one of them");
}

}  // namespace

MeasuredFrf read_cutpro_frf(const std::filesystem::path& path, const std::optional<FrfFormat>& stated) {
  CsvText text;
  text.path = path;
  text.separator = '\t';
  Told told;
  std::istringstream content(core::read_file(path));
  int number = 0;
  for (std::string line; std::getline(content, line);) {
    ++number;
    std::vector<std::string> words = words_of(line);
    if (words.empty()) continue;
    const std::string location = path.string() + ":" + std::to_string(number);
    const bool first = text.lines.empty();
    if (first && !starts_with_numbers(words)) {
      for (const std::string& word : words) take_word(word, told, location);
      continue;
    }
    if (first) {
      for (std::size_t i = 3; i < words.size(); ++i) {
        if (is_number(words[i])) throw core::DataError(location + ": more than three numbers in a line");
        take_word(words[i], told, location);
      }
      words.resize(3);
    }
    text.lines.push_back({number, std::move(words)});
  }
  if (text.lines.empty()) throw core::DataError(path.string() + ": holds no line of three numbers");
  return measured_frf(text, agreed(told, stated, path.string()));
}

}  // namespace thinwall::io
