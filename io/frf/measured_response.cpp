#include "io/frf/measured_response.hpp"

#include <array>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"

namespace thinwall::io {

namespace {

using dynamics::Dof;
using dynamics::DofTable;

/// A key that is equal for equal DOFs only.
using DofKey = std::tuple<std::string, int, std::array<double, 3>>;

DofKey key_of(const Dof& dof) {
  return {dof.point, static_cast<int>(dof.kind), {dof.direction.x(), dof.direction.y(), dof.direction.z()}};
}

/// A table of DOFs to which new DOFs are appended.
struct GrowingTable {
  DofTable dofs;
  std::map<DofKey, Eigen::Index> places;

  Eigen::Index place_of(const Dof& dof) {
    const auto [found, is_new] = places.try_emplace(key_of(dof), static_cast<Eigen::Index>(dofs.size()));
    if (is_new) dofs.push_back(dof);
    return found->second;
  }
};

std::string entry_name(const Dof& response, const Dof& force) {
  return name(response) + "/" + name(force);
}

/// "840 lines from 10 to 219.75 Hz".
std::string lines_text(const MeasuredFrf& frf) {
  const Eigen::VectorXd& hz = frf.axis.hz;
  if (hz.size() == 0) return "no lines";
  return std::to_string(hz.size()) + " lines from " + core::number_text(hz(0), 6) + " to " +
         core::number_text(hz(hz.size() - 1), 6) + " Hz";
}

/// A list of faults, of which the message contains the first few.
struct Faults {
  std::string text;
  int count = 0;

  void add(const std::string& fault) {
    constexpr int shown = 10;
    ++count;
    if (count <= shown) text += (text.empty() ? "" : "; ") + fault;
    if (count == shown + 1) text += "; and others";
  }
};

using Place = std::pair<Eigen::Index, Eigen::Index>;

void add_absent(Faults& faults, const GrowingTable& responses, const GrowingTable& forces,
                const std::set<Place>& places) {
  const std::size_t needed = responses.dofs.size() * forces.dofs.size();
  if (places.size() == needed) return;
  faults.add(std::to_string(places.size()) + " entries where " + std::to_string(responses.dofs.size()) +
             " responses to " + std::to_string(forces.dofs.size()) + " forces need " + std::to_string(needed) +
             "; give the ones that are absent, or leave out their points");
  for (std::size_t row = 0; row < responses.dofs.size() && faults.count < 12; ++row) {
    for (std::size_t column = 0; column < forces.dofs.size() && faults.count < 12; ++column) {
      if (places.contains({static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)})) continue;
      faults.add("the entry " + entry_name(responses.dofs[row], forces.dofs[column]) + " is absent");
    }
  }
}

/// The place of every entry in the matrix. Throws DataError that names all entries without direction, with other
/// frequencies, that occur twice, or that are absent.
std::vector<Place> places_of(const std::vector<MeasuredEntry>& entries, GrowingTable& responses, GrowingTable& forces) {
  Faults faults;
  std::vector<Place> places;
  std::set<Place> taken;
  for (const MeasuredEntry& entry : entries) {
    for (const Dof* dof : {&entry.response, &entry.force}) {
      if (dof->direction.isZero()) {
        faults.add("the direction at \"" + dof->point + "\" is not told; read the entry by itself and name its DOFs");
      }
    }
    const std::string name = entry_name(entry.response, entry.force);
    if (!equal(entry.frf.axis, entries.front().frf.axis)) {
      faults.add("the entry " + name + " has other frequencies than the first entry, " + lines_text(entry.frf) +
                 " in " + entry.frf.source + " beside " + lines_text(entries.front().frf) +
                 "; measure or export all on the same lines");
    }
    places.emplace_back(responses.place_of(entry.response), forces.place_of(entry.force));
    if (!taken.insert(places.back()).second) faults.add("the entry " + name + " is there twice; remove one");
  }
  add_absent(faults, responses, forces, taken);
  if (faults.count > 0) throw core::DataError(entries.front().frf.source + ": " + faults.text);
  return places;
}

}  // namespace

Eigen::VectorXd coherence_of(const MeasuredResponse& measured, Eigen::Index row, Eigen::Index column) {
  for (const EntryCoherence& entry : measured.coherence) {
    if (entry.row == row && entry.column == column) return entry.values;
  }
  return {};
}

MeasuredEntries entries_of(const MeasuredResponse& measured, const std::string& source) {
  MeasuredEntries list{{}, measured.notes};
  const dynamics::ResponseModel& model = measured.response;
  for (std::size_t i = 0; i < model.responses.size(); ++i) {
    for (std::size_t j = 0; j < model.forces.size(); ++j) {
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      Eigen::VectorXcd H(model.axis.size());
      for (Eigen::Index line = 0; line < H.size(); ++line)
        H(line) = model.H[static_cast<std::size_t>(line)](row, column);
      list.entries.push_back(
          {model.responses[i], model.forces[j], {model.axis, H, source, coherence_of(measured, row, column)}});
    }
  }
  return list;
}

MeasuredResponse response_matrix(const MeasuredEntries& measured) {
  const auto& entries = measured.entries;
  if (entries.empty()) throw core::DataError("no frequency response function was read; nothing makes a matrix");
  GrowingTable responses;
  GrowingTable forces;
  const std::vector<Place> places = places_of(entries, responses, forces);
  const dynamics::FrequencyAxis& axis = entries.front().frf.axis;
  MeasuredResponse matrix;
  matrix.notes = measured.notes;
  matrix.response = {axis, responses.dofs, forces.dofs, {}};
  matrix.response.H.assign(static_cast<std::size_t>(axis.size()),
                           Eigen::MatrixXcd::Zero(static_cast<Eigen::Index>(responses.dofs.size()),
                                                  static_cast<Eigen::Index>(forces.dofs.size())));
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto [row, column] = places[k];
    const MeasuredFrf& frf = entries[k].frf;
    for (Eigen::Index line = 0; line < axis.size(); ++line) {
      matrix.response.H[static_cast<std::size_t>(line)](row, column) = frf.H(line);
    }
    if (frf.coherence.size() > 0) matrix.coherence.push_back({row, column, frf.coherence});
  }
  return matrix;
}

}  // namespace thinwall::io
