#include "io/frf/measured_response.hpp"

#include <algorithm>
#include <array>
#include <complex>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"
#include "dynamics/rational_fit.hpp"

namespace thinwall::io {

namespace {

using Complex = std::complex<double>;
using dynamics::Dof;
using dynamics::DofTable;

std::string range_text(double from, double to) {
  return core::number_text(from) + " to " + core::number_text(to) + " Hz";
}

/// The value at x of the Lagrange polynomial through all the points (x_i, y_i).
Complex interpolate(std::span<const double> x_i, std::span<const Complex> y_i, double x) {
  Complex sum = 0.0;
  for (std::size_t i = 0; i < x_i.size(); ++i) {
    double weight = 1.0;
    for (std::size_t j = 0; j < x_i.size(); ++j) {
      if (j != i) weight *= (x - x_i[j]) / (x_i[i] - x_i[j]);
    }
    sum += weight * y_i[i];
  }
  return sum;
}

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
             " responses to " + std::to_string(forces.dofs.size()) + " forces need " + std::to_string(needed));
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
      faults.add("the entry " + name + " has other frequencies than the first entry");
    }
    places.emplace_back(responses.place_of(entry.response), forces.place_of(entry.force));
    if (!taken.insert(places.back()).second) faults.add("the entry " + name + " is there twice; remove one");
  }
  add_absent(faults, responses, forces, taken);
  if (faults.count > 0) throw core::DataError(entries.front().frf.source + ": " + faults.text);
  return places;
}

/// A fit of one entry at the lines of an axis.
Eigen::VectorXcd on_axis(const dynamics::PartialFractions& fit, const dynamics::FrequencyAxis& axis) {
  Eigen::VectorXcd H(axis.size());
  for (Eigen::Index line = 0; line < axis.size(); ++line) H(line) = value(fit, axis.omega_rad_s(line))(0, 0);
  return H;
}

/// The values on another axis, by polynomials through `points` neighbours.
Eigen::VectorXcd interpolated(const MeasuredFrf& frf, const Eigen::VectorXcd& values,
                              const dynamics::FrequencyAxis& axis, std::size_t points) {
  const std::span<const double> x(frf.axis.hz.data(), static_cast<std::size_t>(frf.axis.size()));
  const std::span<const Complex> y(values.data(), x.size());
  const double slack = 1e-9 * x.back();
  if (axis.hz.minCoeff() < x.front() - slack || axis.hz.maxCoeff() > x.back() + slack) {
    throw core::DataError(frf.source + ": measured from " + range_text(x.front(), x.back()) + ", asked for " +
                          range_text(axis.hz.minCoeff(), axis.hz.maxCoeff()) +
                          "; narrow the frequency range of the case or measure further");
  }
  points = std::min(points, x.size());
  Eigen::VectorXcd on_axis(axis.size());
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    const auto above = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), axis.hz(line)) - x.begin());
    const std::size_t first = std::min(above - std::min(above, points / 2), x.size() - points);
    on_axis(line) = interpolate(x.subspan(first, points), y.subspan(first, points), axis.hz(line));
  }
  return on_axis;
}

}  // namespace

Eigen::VectorXd coherence_of(const MeasuredResponse& measured, Eigen::Index row, Eigen::Index column) {
  for (const EntryCoherence& entry : measured.coherence) {
    if (entry.row == row && entry.column == column) return entry.values;
  }
  return {};
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

Eigen::VectorXcd resample(const MeasuredFrf& frf, const dynamics::FrequencyAxis& axis) {
  if (equal(frf.axis, axis)) return frf.H;
  constexpr Eigen::Index fit_from = 14;
  if (frf.axis.size() < fit_from || frf.H.isZero(0.0)) return interpolated(frf, frf.H, axis, 4);
  std::vector<Eigen::MatrixXcd> lines;
  for (const Complex H : frf.H) lines.emplace_back(Eigen::MatrixXcd::Constant(1, 1, H));
  const dynamics::PartialFractions fit = dynamics::rational_fit(frf.axis.hz, lines);
  return interpolated(frf, frf.H - on_axis(fit, frf.axis), axis, 4) + on_axis(fit, axis);
}

Eigen::VectorXd coherence_on(const MeasuredFrf& frf, const dynamics::FrequencyAxis& axis) {
  if (frf.coherence.size() == 0 || equal(frf.axis, axis)) return frf.coherence;
  return interpolated(frf, frf.coherence.cast<Complex>(), axis, 2).real();
}

}  // namespace thinwall::io
