#include "report/tool_files.hpp"

#include <string>
#include <vector>

#include "io/frf/resample.hpp"
#include "io/results/csv_table.hpp"
#include "setup/measured.hpp"

namespace thinwall::report {

namespace {

std::vector<double> list_of(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

}  // namespace

void write_tool_frf(const std::filesystem::path& file, const setup::Tool& tool) {
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
  }
  io::write_csv(file, table, {"receptances of the tool's tip as measured, on the lines of the first file"});
}

}  // namespace thinwall::report
