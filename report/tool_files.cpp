#include "report/tool_files.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

#include "io/frf/resample.hpp"
#include "io/results/csv_table.hpp"
#include "setup/measured.hpp"
#include "study/lobes/cut_structure.hpp"

namespace thinwall::report {

namespace {

std::vector<double> list_of(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

/// Real or imaginary parts of an entry of the synthesised receptance on an axis; NaN at lines that it does not have.
std::vector<double> synthesised_on(const dynamics::FrequencyAxis& axis, const milling::SampledReceptance& synthesised,
                                   Eigen::Index i, Eigen::Index j, bool imaginary) {
  std::vector<double> values;
  const auto& hz = synthesised.frequency_hz;
  for (const double at : axis.hz) {
    const auto line = static_cast<std::size_t>(std::lower_bound(hz.begin(), hz.end(), at * (1.0 - 1e-12)) - hz.begin());
    const bool known = line < synthesised.H.size() && hz(static_cast<Eigen::Index>(line)) <= at * (1.0 + 1e-12);
    const std::complex<double> H = known ? synthesised.H[line](i, j) : std::complex<double>(NAN, NAN);
    values.push_back(imaginary ? H.imag() : H.real());
  }
  return values;
}

/// The columns of an entry as the fitted poles alone give it.
void add_synthesised(io::Table& table, const dynamics::FrequencyAxis& axis, const std::string& entry, Eigen::Index i,
                     Eigen::Index j, const milling::SampledReceptance& synthesised) {
  for (const bool imaginary : {false, true})
    table.push_back({std::string("synthesised ") + (imaginary ? "im " : "re ") + entry + " m/N",
                     synthesised_on(axis, synthesised, i, j, imaginary), true});
}

}  // namespace

void write_tool_frf(const std::filesystem::path& file, const setup::Tool& tool,
                    const std::optional<milling::SampledReceptance>& synthesised) {
  if (tool.measured.empty()) return;
  const dynamics::FrequencyAxis axis = setup::receptance_of(tool.measured.front()).axis;
  io::Table table{{"frequency_hz", list_of(axis.hz)}};
  for (const setup::MeasuredFrf& measured : tool.measured) {
    const io::MeasuredFrf& frf = setup::receptance_of(measured);
    const Eigen::VectorXcd H = io::resample(frf, axis);
    const std::string entry = measured.response + "/" + measured.force;
    table.push_back({"re " + entry + " m/N", list_of(H.real())});
    table.push_back({"im " + entry + " m/N", list_of(H.imag())});
    const Eigen::VectorXd coherence = io::coherence_on(frf, axis);
    if (coherence.size() > 0) table.push_back({"coherence " + entry, list_of(coherence)});
    if (!synthesised) continue;
    const int i = study::direction_of_dof(measured.response), j = study::direction_of_dof(measured.force);
    add_synthesised(table, axis, entry, i, j, *synthesised);
  }
  io::write_csv(file, table,
                {"receptances of the tool's tip as measured, on the lines of the first file; synthesised: those of the "
                 "poles that were fitted to them, where they were"});
}

void write_swapped_frf(const std::filesystem::path& file, const milling::SampledReceptance& tip,
                       const std::optional<milling::SampledReceptance>& synthesised) {
  const dynamics::FrequencyAxis axis{tip.frequency_hz};
  io::Table table{{"frequency_hz", list_of(axis.hz)}};
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      if (std::ranges::all_of(tip.H, [&](const Eigen::Matrix3cd& H) { return H(i, j) == 0.0; })) continue;
      const std::string entry = std::string("tool.") + "xyz"[i] + "/tool." + "xyz"[j];
      std::vector<double> real, imaginary;
      for (const Eigen::Matrix3cd& H : tip.H) {
        real.push_back(H(i, j).real());
        imaginary.push_back(H(i, j).imag());
      }
      table.push_back({"re " + entry + " m/N", std::move(real)});
      table.push_back({"im " + entry + " m/N", std::move(imaginary)});
      if (synthesised) add_synthesised(table, axis, entry, i, j, *synthesised);
    }
  }
  io::write_csv(
      file, table,
      {"receptances of the tool's tip by the swap; synthesised: those of the poles that were fitted to them"});
}

}  // namespace thinwall::report
