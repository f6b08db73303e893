#include "io/inp_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/atomic_file.hpp"
#include "core/error.hpp"

namespace thinwall::io {

namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// What the lines after a keyword hold.
enum class Section { passed_over, nodes, elements, set, generated_set };

/// Goes through a file line by line.
class Reader {
 public:
  Reader(const std::filesystem::path& path, double metres_per_unit)
      : text_(core::read_file(path)), metres_per_unit_(metres_per_unit) {
    result_.path = path.string();
  }

  InpText read() {
    std::string_view rest = text_;
    while (!rest.empty()) {
      const auto end = std::min(rest.find('\n'), rest.size());
      const std::string_view line = trimmed(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
      ++line_;
      if (line.empty() || line.starts_with("**")) continue;
      if (line.front() == '*' || keyword_goes_on_) {
        read_keyword(line);
      } else {
        read_data(line);
      }
    }
    require_whole_element();
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { fail_at(result_, line_, what); }

  /// A keyword's line goes on in the next one if it ends with a comma.
  void read_keyword(std::string_view line) {
    if (!keyword_goes_on_) keyword_.clear();
    keyword_ += line;
    keyword_goes_on_ = line.back() == ',';
    if (keyword_goes_on_) return;
    require_whole_element();
    std::string_view rest = keyword_;
    const std::string name = capitals(next_field(rest));
    std::map<std::string, std::string> parameters;
    while (!rest.empty()) {
      const std::string_view field = next_field(rest);
      const auto equals = std::min(field.find('='), field.size());
      std::string_view value = trimmed(field.substr(std::min(equals + 1, field.size())));
      if (value.size() > 1 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
      parameters[capitals(trimmed(field.substr(0, equals)))] = capitals(value);
    }
    open_section(name, parameters);
  }

  void open_section(const std::string& name, std::map<std::string, std::string>& parameters) {
    section_ = Section::passed_over;
    set_ = nullptr;
    for (const char* maker : {"*INCLUDE", "*SYSTEM", "*NGEN", "*NFILL", "*NCOPY", "*NMAP", "*ELGEN", "*ELCOPY"}) {
      if (name == maker) {
        fail(name + " is not read, and without it the mesh would be another one: have the program that writes the " +
             "file write all nodes and elements");
      }
    }
    if (name == "*NODE") {
      section_ = Section::nodes;
      if (parameters.contains("INPUT") || parameters.contains("SYSTEM")) {
        fail("*NODE is read without INPUT= and SYSTEM=: write the nodes here, in Cartesian coordinates");
      }
      if (parameters.contains("NSET")) set_ = &result_.sets[parameters["NSET"]];
    } else if (name == "*ELEMENT") {
      section_ = Section::elements;
      open_elements(parameters["TYPE"]);
    } else if (name == "*NSET") {
      if (parameters["NSET"].empty()) fail("*NSET lacks NSET=name");
      if (parameters.contains("ELSET")) fail("*NSET is read without ELSET=: write the numbers of the nodes");
      section_ = parameters.contains("GENERATE") ? Section::generated_set : Section::set;
      set_ = &result_.sets[parameters["NSET"]];
    }
  }

  void open_elements(const std::string& type) {
    const int order = type == "C3D4" ? 1 : type == "C3D10" ? 2 : 0;
    if (order == 0) fail("elements of type \"" + type + "\" are not read; mesh with C3D4 or C3D10");
    if (result_.order != 0 && result_.order != order)
      fail("C3D4 and C3D10 in one file: mesh the part with one of them");
    result_.order = order;
  }

  void read_data(std::string_view line) {
    if (section_ == Section::nodes) read_node(line);
    if (section_ == Section::elements) read_element(line);
    if (section_ == Section::set) read_set(line);
    if (section_ == Section::generated_set) read_generated_set(line);
  }

  void read_node(std::string_view rest) {
    InpTextNode node{.label = next_label(rest), .line = line_, .x = {}};
    for (int i = 0; i < 3; ++i) node.x(i) = metres_per_unit_ * next_number(rest);
    if (!rest.empty()) fail("a node has a number and three coordinates; \"" + std::string(rest) + "\" is beyond them");
    if (set_ != nullptr) set_->push_back({node.label, node.label, 1, line_, false});
    result_.nodes.push_back(node);
  }

  /// An element may take several lines; it is whole when it has all its nodes.
  void read_element(std::string_view rest) {
    if (nodes_missing_ == 0) {
      result_.elements.push_back({next_label(rest), line_, {}});
      nodes_missing_ = inp_node_count(result_.order);
    }
    InpTextElement& element = result_.elements.back();
    const std::size_t all = inp_node_count(result_.order);
    while (!rest.empty()) {
      if (nodes_missing_ == 0)
        fail("more than " + std::to_string(all) + " nodes in element " + std::to_string(element.label));
      element.nodes[all - nodes_missing_] = next_label(rest);
      --nodes_missing_;
    }
  }

  void require_whole_element() const {
    if (nodes_missing_ == 0) return;
    const InpTextElement& element = result_.elements.back();
    fail_at(result_, element.line,
            "element " + std::to_string(element.label) + " lacks " + std::to_string(nodes_missing_) + " of its nodes");
  }

  void read_set(std::string_view rest) {
    while (!rest.empty()) {
      std::string_view field = next_field(rest);
      if (field.empty()) continue;
      const bool is_name = (field.front() < '0' || field.front() > '9') && field.front() != '-' && field.front() != '+';
      if (is_name) {
        append_set(capitals(field));
      } else {
        const int label = next_label(field);
        set_->push_back({label, label, 1, line_, false});
      }
    }
  }

  void append_set(const std::string& other) {
    const auto found = result_.sets.find(other);
    if (found == result_.sets.end()) fail("the node set \"" + other + "\" is not defined above this line");
    const std::vector<InpLabelRange> copy = found->second;
    set_->insert(set_->end(), copy.begin(), copy.end());
  }

  void read_generated_set(std::string_view rest) {
    InpLabelRange range{next_label(rest), 0, 1, line_, true};
    range.last = next_label(rest);
    if (!rest.empty()) range.step = next_label(rest);
    if (range.last < range.first)
      fail("a range from " + std::to_string(range.first) + " down to " + std::to_string(range.last) +
           ": write the smaller number first");
    set_->push_back(range);
  }

  /// The text up to the next comma, which is taken off `rest`.
  static std::string_view next_field(std::string_view& rest) {
    const auto comma = std::min(rest.find(','), rest.size());
    const std::string_view field = trimmed(rest.substr(0, comma));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    return field;
  }

  int next_label(std::string_view& rest) const {
    const std::string_view field = next_field(rest);
    int label = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), label);
    if (error != std::errc{} || end != field.data() + field.size() || label < 1) {
      fail("\"" + std::string(field) + "\" where a whole number from 1 to 2147483647 belongs");
    }
    return label;
  }

  /// Fortran's "1.5D-3" and "+1.5" as well.
  double next_number(std::string_view& rest) const {
    const std::string_view field = next_field(rest);
    double value = std::nan("");
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error == std::errc{} && end == field.data() + field.size() && std::isfinite(value)) return value;
    std::string text(field.substr(field.starts_with('+') ? 1 : 0));
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
    const auto [text_end, text_error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text_error != std::errc{} || text_end != text.data() + text.size() || !std::isfinite(value)) {
      fail("\"" + std::string(field) + "\" where a finite number belongs");
    }
    return value;
  }

  std::string text_;
  double metres_per_unit_ = 0.0;
  InpText result_;
  Section section_ = Section::passed_over;
  std::vector<InpLabelRange>* set_ = nullptr;  ///< the set that the section adds to
  std::string keyword_;
  bool keyword_goes_on_ = false;
  std::size_t nodes_missing_ = 0;  ///< of the last element
  int line_ = 0;
};

}  // namespace

InpText read_inp_text(const std::filesystem::path& path, double metres_per_unit) {
  return Reader(path, metres_per_unit).read();
}

void fail_at(const InpText& text, int line, const std::string& what) {
  throw core::DataError(text.path + ":" + std::to_string(line) + ": " + what);
}

std::string capitals(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return result;
}

}  // namespace thinwall::io
