#include "io/frf/one_reference.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"

namespace thinwall::io {

namespace {

using dynamics::Dof;

bool same(const Dof& a, const Dof& b) {
  return a.point == b.point && a.kind == b.kind && (a.direction - b.direction).norm() <= 1e-9;
}

/// The sign that turns a direction along its positive axis.
double sign_of(const Dof& dof) {
  Eigen::Index largest = 0;
  dof.direction.cwiseAbs().maxCoeff(&largest);
  return dof.direction(largest) < 0.0 ? -1.0 : 1.0;
}

Dof along_positive_axis(Dof dof) {
  dof.direction = (sign_of(dof) * dof.direction).array() + 0.0;  // turns -0 into 0
  return dof;
}

/// The entry between DOFs along their positive axes.
MeasuredEntry along_positive_axes(const MeasuredEntry& entry) {
  MeasuredEntry turned = entry;
  turned.response = along_positive_axis(entry.response);
  turned.force = along_positive_axis(entry.force);
  turned.frf.H *= sign_of(entry.response) * sign_of(entry.force);
  return turned;
}

bool is_in_all(const Dof& reference, const std::vector<MeasuredEntry>& entries) {
  return std::ranges::all_of(entries, [&](const MeasuredEntry& entry) {
    return same(along_positive_axis(entry.response), reference) || same(along_positive_axis(entry.force), reference);
  });
}

bool has_driving_point(const Dof& reference, const std::vector<MeasuredEntry>& entries) {
  return std::ranges::any_of(entries, [&](const MeasuredEntry& entry) {
    return same(along_positive_axis(entry.response), reference) && same(along_positive_axis(entry.force), reference);
  });
}

/// The difference of a pair that was measured both ways, relative to the largest value.
std::string difference_text(const MeasuredEntry& kept, const MeasuredEntry& transposed) {
  std::string pair = name(kept.response) + "/" + name(kept.force) + " was measured both ways";
  if (!equal(kept.frf.axis, transposed.frf.axis)) return pair + ", on other frequencies";
  const double largest = kept.frf.H.cwiseAbs().maxCoeff();
  const double difference = (kept.frf.H - transposed.frf.H).cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return pair;
  return pair + "; the two differ by " + core::number_text(std::round(1000.0 * difference / largest) / 10.0) +
         " % of the largest value";
}

}  // namespace

std::optional<Dof> reference_of(const std::vector<MeasuredEntry>& entries) {
  if (entries.empty()) return std::nullopt;
  std::vector<Dof> candidates;
  for (const Dof& dof : {along_positive_axis(entries.front().force), along_positive_axis(entries.front().response)})
    if (!dof.direction.isZero() && is_in_all(dof, entries)) candidates.push_back(dof);
  if (candidates.empty()) return std::nullopt;
  const auto driven = std::ranges::find_if(candidates, [&](const Dof& dof) { return has_driving_point(dof, entries); });
  return driven == candidates.end() ? candidates.front() : *driven;
}

ReferenceColumn reference_column(const MeasuredEntries& measured) {
  const auto reference = reference_of(measured.entries);
  if (!reference)
    throw core::DataError("the " + std::to_string(measured.entries.size()) +
                          " FRFs have no DOF in common that is a reference; name each one by its record");
  MeasuredEntries column{{}, measured.notes};
  std::vector<MeasuredEntry> transposed;
  for (const MeasuredEntry& entry : measured.entries) {
    MeasuredEntry turned = along_positive_axes(entry);
    if (same(turned.force, *reference)) {
      column.entries.push_back(std::move(turned));
    } else {
      std::swap(turned.response, turned.force);
      transposed.push_back(std::move(turned));
    }
  }
  ReferenceColumn result;
  const auto stated = static_cast<std::ptrdiff_t>(column.entries.size());
  for (MeasuredEntry& entry : transposed) {
    const auto end = column.entries.begin() + stated;
    const auto kept = std::find_if(column.entries.begin(), end,
                                   [&](const MeasuredEntry& other) { return same(other.response, entry.response); });
    if (kept != end) {
      column.notes.push_back(entry.frf.source + ": " + difference_text(*kept, entry));
      continue;
    }
    column.entries.push_back(std::move(entry));
    ++result.by_reciprocity;
  }
  result.measured = response_matrix(column);
  const auto& rows = result.measured.response.responses;
  const auto driving = std::ranges::find_if(rows, [&](const Dof& dof) { return same(dof, *reference); });
  if (driving != rows.end()) result.driving_point = static_cast<int>(driving - rows.begin());
  return result;
}

}  // namespace thinwall::io
