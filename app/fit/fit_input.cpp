#include "app/fit/fit_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/split.hpp"
#include "io/frf/mat_response.hpp"
#include "io/frf/measured_response.hpp"
#include "setup/measured.hpp"
#include "setup/measured_layout.hpp"

namespace thinwall::app {

namespace {

bool names_direction(char letter) {
  return letter == 'x' || letter == 'y' || letter == 'z';
}

/// The DOFs and the file of a word.
setup::MeasuredFrf named(const std::string& word) {
  setup::MeasuredFrf frf;
  frf.response = frf.force = "tool.x";
  frf.file = word;
  const auto equals = word.find('=');
  if (equals == std::string::npos || std::filesystem::exists(word)) return frf;
  const std::string entry = word.substr(0, equals);
  const auto slash = entry.find('/');
  if (slash != std::string::npos) {
    frf.response = entry.substr(0, slash);
    frf.force = entry.substr(slash + 1);
  } else if (!entry.empty() && entry.size() <= 2 && std::ranges::all_of(entry, names_direction)) {
    frf.response = std::string("tool.") + entry.front();
    frf.force = std::string("tool.") + entry.back();
  } else {
    throw core::UsageError("\"" + word + "\": write P.x/Q.y=FILE for response and force, or x=FILE, xy=FILE at a tip");
  }
  frf.file = word.substr(equals + 1);
  return frf;
}

/// Throws UsageError for words that say something only beside others.
void require_together(const FitInput& input) {
  if (input.quantity.empty() != input.unit.empty())
    throw core::UsageError("--quantity and --unit belong together; give both, or neither where the files say them");
  if (input.quantity.empty() && !input.frequency_unit.empty())
    throw core::UsageError("--frequency-unit belongs to --quantity and --unit; give them, too, or remove it");
  if (input.variable.empty() != input.frequency_variable.empty())
    throw core::UsageError("--variable and --frequency-variable belong together; give both or neither");
  if (input.responses.empty() != input.forces.empty())
    throw core::UsageError("--responses and --forces belong together; give both for an array, or neither for one FRF");
  const bool of_array = !input.responses.empty() || !input.coherence_variable.empty();
  if (of_array && input.variable.empty())
    throw core::UsageError(
        "--responses, --forces and --coherence-variable tell of the array of --variable; give that, too");
  if (!input.coherence_variable.empty() && input.responses.empty())
    throw core::UsageError("--coherence-variable needs --responses and --forces; name the DOFs of the array");
  if (!input.variable.empty() && input.quantity.empty())
    throw core::UsageError("--variable does not say what it holds; give --quantity and --unit");
}

/// Throws UsageError, by the option, for a unit that is none of the quantity and for one that is none of frequency.
void require_units(const setup::MeasuredFrf& frf) {
  const auto require = [&](const char* option, const std::string& frequency_unit) {
    try {
      (void)io::frf_format(*frf.quantity, frf.unit, frequency_unit);
    } catch (const core::InputError& error) {
      throw core::UsageError(std::string(option) + ": " + error.what());
    }
  };
  require("--unit", "Hz");
  require("--frequency-unit", frf.frequency_unit);
}

setup::MeasuredFrf source_of(const std::string& word, const FitInput& input) {
  setup::MeasuredFrf frf = named(word);
  frf.variable = input.variable;
  frf.frequency_variable = input.frequency_variable;
  if (input.quantity.empty()) return frf;
  frf.quantity = core::from_word<io::FrfQuantity>(input.quantity);
  if (!frf.quantity)
    throw core::UsageError("--quantity \"" + input.quantity + "\"; write receptance, mobility or accelerance");
  frf.unit = input.unit;
  frf.frequency_unit = input.frequency_unit.empty() ? "Hz" : input.frequency_unit;
  require_units(frf);
  return frf;
}

/// "1.x, 2.x" as DOFs. Throws UsageError for a name that is none.
dynamics::DofTable dofs_of(const std::string& list, const std::string& option) {
  dynamics::DofTable dofs;
  for (std::string& word : core::split(list, ',')) {
    std::erase(word, ' ');
    try {
      dofs.push_back(setup::dof_of(word));
    } catch (const core::InputError& error) {
      throw core::UsageError(fmt::format("{} \"{}\": {}", option, list, error.what()));
    }
  }
  return dofs;
}

/// All FRFs of the array that a MAT file of another program holds.
io::MeasuredEntries entries_of_array(const std::string& word, const FitInput& input) {
  const setup::MeasuredFrf source = source_of(word, input);
  if (setup::frf_file_kind(source.file) != setup::FrfFileKind::mat)
    throw core::UsageError("--variable is of MAT files, which \"" + source.file.string() + "\" is not; remove it");
  return io::entries_of(
      io::read_mat_frf(source.file, {input.frequency_variable, input.variable, input.coherence_variable},
                       io::frf_format(*source.quantity, source.unit, source.frequency_unit),
                       dofs_of(input.responses, "--responses"), dofs_of(input.forces, "--forces")),
      source.file.string());
}

/// The coherence of each line as a matrix; none unless every entry has one.
std::vector<Eigen::MatrixXd> coherence_of(const io::MeasuredResponse& measured) {
  const dynamics::ResponseModel& model = measured.response;
  const auto rows = static_cast<Eigen::Index>(model.responses.size()),
             columns = static_cast<Eigen::Index>(model.forces.size());
  std::vector<Eigen::MatrixXd> lines(static_cast<std::size_t>(model.axis.size()), Eigen::MatrixXd(rows, columns));
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) {
      const Eigen::VectorXd values = io::coherence_of(measured, i, j);
      if (values.size() != model.axis.size()) return {};
      for (Eigen::Index line = 0; line < values.size(); ++line)
        lines[static_cast<std::size_t>(line)](i, j) = values(line);
    }
  }
  return lines;
}

/// Adds the entries of the matrix that are absent and whose transpose is there, with a note on each.
void complete_by_reciprocity(io::MeasuredEntries& all) {
  std::map<std::pair<std::string, std::string>, std::size_t> known;
  std::map<std::string, dynamics::Dof> responses, forces;
  for (std::size_t i = 0; i < all.entries.size(); ++i) {
    const io::MeasuredEntry& entry = all.entries[i];
    const std::string response = dynamics::name(entry.response), force = dynamics::name(entry.force);
    known.emplace(std::pair(response, force), i);
    responses.emplace(response, entry.response);
    forces.emplace(force, entry.force);
  }
  for (const auto& [response, of_response] : responses) {
    for (const auto& [force, of_force] : forces) {
      const auto reverse = known.find({force, response});
      if (known.contains({response, force}) || reverse == known.end()) continue;
      io::MeasuredFrf frf = all.entries[reverse->second].frf;
      all.entries.push_back({of_response, of_force, std::move(frf)});
      all.notes.push_back(fmt::format("{0}/{1} is taken from {1}/{0} by reciprocity", response, force));
    }
  }
}

}  // namespace

std::string file_of(const std::string& word) {
  return named(word).file.string();
}

FitMatrix fit_matrix(const FitInput& input) {
  require_together(input);
  io::MeasuredEntries all;
  std::vector<std::string> files;
  for (const std::string& word : input.sources) {
    files.push_back(file_of(word));
    io::MeasuredEntries of_file =
        input.responses.empty() ? setup::read_all_measured(source_of(word, input)) : entries_of_array(word, input);
    std::ranges::move(of_file.entries, std::back_inserter(all.entries));
    std::ranges::move(of_file.notes, std::back_inserter(all.notes));
  }
  complete_by_reciprocity(all);
  io::MeasuredResponse matrix = io::response_matrix(all);
  return {matrix.response, coherence_of(matrix), all.notes, files};
}

}  // namespace thinwall::app
