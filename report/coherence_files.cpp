#include "report/coherence_files.hpp"

#include "io/frf/resample.hpp"
#include "io/results/csv_table.hpp"
#include "setup/measured.hpp"

namespace thinwall::report {

void write_coherence(const std::filesystem::path& file, const std::vector<setup::MeasuredFrf>& measured,
                     const dynamics::FrequencyAxis& axis) {
  io::Table table{{"frequency_hz", std::vector<double>(axis.hz.begin(), axis.hz.end())}};
  for (const setup::MeasuredFrf& one : measured) {
    const Eigen::VectorXd coherence = io::coherence_on(setup::receptance_of(one), axis);
    if (coherence.size() == 0) continue;
    table.push_back(
        {"coherence " + one.response + "/" + one.force, std::vector<double>(coherence.begin(), coherence.end())});
  }
  if (table.size() > 1) io::write_csv(file, table, {"of the measured FRFs, between their lines in proportion"});
}

}  // namespace thinwall::report
