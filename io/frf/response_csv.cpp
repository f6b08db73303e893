#include "io/frf/response_csv.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <locale>
#include <sstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "io/csv_text.hpp"

namespace thinwall::io {

namespace {

using dynamics::Dof;
using dynamics::DofKind;
using dynamics::DofTable;
using dynamics::ResponseModel;

constexpr std::array kind_words{std::pair{DofKind::translation, "translation"},
                                std::pair{DofKind::rotation, "rotation"}, std::pair{DofKind::modal, "modal"}};

std::string kind_word(DofKind kind) {
  for (const auto& [known, word] : kind_words) {
    if (known == kind) return word;
  }
  throw core::InputError("a degree of freedom is of no known kind");
}

/// A line such as "response translation 1 0 0 P". The point comes last, because its name may contain blanks.
std::string dof_line(const std::string& role, const Dof& dof) {
  std::string line = "# " + role + " " + kind_word(dof.kind);
  for (const double component : dof.direction) line += " " + core::number_text(component);
  const bool plain = std::none_of(dof.point.begin(), dof.point.end(), [](unsigned char c) { return std::iscntrl(c); });
  if (!plain || dof.point.empty() || dof.point.front() == ' ' || dof.point.back() == ' ') {
    throw core::InputError("the point name \"" + dof.point + "\" cannot be written; use one without outer blanks");
  }
  return line + " " + dof.point + "\n";
}

std::string entry_unit(const Dof& response, const Dof& force) {
  return unit(response) + (force.kind == DofKind::rotation ? "/(N m)" : "/N");
}

std::string header(const ResponseModel& model) {
  std::string line = "frequency_hz";
  for (const Dof& response : model.responses) {
    for (const Dof& force : model.forces) {
      const std::string entry = name(response) + "/" + name(force) + " " + entry_unit(response, force);
      line += "," + csv_field("re " + entry) + "," + csv_field("im " + entry);
    }
  }
  return line + "\n";
}

std::string line_text(const ResponseModel& model, std::size_t line) {
  const Eigen::MatrixXcd& H = model.H[line];
  const double hz = model.axis.hz(static_cast<Eigen::Index>(line));
  std::string text = core::number_text(hz);
  for (Eigen::Index row = 0; row < H.rows(); ++row) {
    for (Eigen::Index column = 0; column < H.cols(); ++column) {
      const auto value = H(row, column);
      if (!std::isfinite(value.real()) || !std::isfinite(value.imag())) {
        throw core::NumericalError("receptance " + name(model.responses[static_cast<std::size_t>(row)]) + "/" +
                                   name(model.forces[static_cast<std::size_t>(column)]) + " is not finite at " +
                                   core::number_text(hz) + " Hz");
      }
      text += "," + core::number_text(value.real()) + "," + core::number_text(value.imag());
    }
  }
  return text + "\n";
}

/// Adds the DOF that a comment line describes, if it describes one.
void take_dof(const CsvText& text, const std::string& comment, ResponseModel& model) {
  std::istringstream words(comment);
  words.imbue(std::locale::classic());
  std::string role;
  std::string kind;
  words >> role >> kind;
  if (role != "response" && role != "force") return;
  Dof dof;
  bool known = false;
  for (const auto& [value, word] : kind_words) {
    if (kind != word) continue;
    dof.kind = value;
    known = true;
  }
  words >> dof.direction.x() >> dof.direction.y() >> dof.direction.z();
  if (!known || !words || words.get() != ' ' || !std::getline(words, dof.point)) {
    throw core::DataError(text.path.string() + ": \"# " + comment + "\" does not tell a degree of freedom");
  }
  (role == "response" ? model.responses : model.forces).push_back(dof);
}

}  // namespace

void write_response(const std::filesystem::path& path, const ResponseModel& model) {
  dynamics::require_consistent(model);
  std::string text = "# receptance, e^{+i omega t}; entry response/force, real and imaginary part\n";
  for (const Dof& dof : model.responses) text += dof_line("response", dof);
  for (const Dof& dof : model.forces) text += dof_line("force", dof);
  text += header(model);
  for (std::size_t line = 0; line < model.H.size(); ++line) text += line_text(model, line);
  core::write_file_atomically(path, text);
}

ResponseModel read_response(const std::filesystem::path& path) {
  const CsvText text = read_csv_text(path);
  ResponseModel model;
  for (const std::string& comment : text.comments) take_dof(text, comment, model);
  if (model.responses.empty() || model.forces.empty()) {
    throw core::DataError(path.string() +
                          ": has no \"# response\" or no \"# force\" line; was it written by thinwall?");
  }
  const auto rows = static_cast<Eigen::Index>(model.responses.size());
  const auto columns = static_cast<Eigen::Index>(model.forces.size());
  require_columns(text, static_cast<std::size_t>(1 + 2 * rows * columns), "frequency and every entry twice");
  model.axis.hz.resize(static_cast<Eigen::Index>(text.lines.size()));
  for (Eigen::Index line_index = 0; line_index < model.axis.size(); ++line_index) {
    const CsvLine& line = text.lines[static_cast<std::size_t>(line_index)];
    model.axis.hz(line_index) = number(text, line, 0);
    if (line_index > 0 && model.axis.hz(line_index) <= model.axis.hz(line_index - 1)) {
      throw core::DataError(location(text, line) + ": the frequency does not rise");
    }
    Eigen::MatrixXcd& H = model.H.emplace_back(rows, columns);
    for (Eigen::Index k = 0; k < rows * columns; ++k) {
      const auto column = static_cast<std::size_t>(1 + 2 * k);
      H(k / columns, k % columns) = {number(text, line, column), number(text, line, column + 1)};
    }
  }
  return model;
}

}  // namespace thinwall::io
