#pragma once
// Mode shapes of a part on the corners of its surface, as programs of modal tests draw them.

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "study/results.hpp"

namespace thinwall::report {

/// Frequency (Hz), damping ratio and modal mass (kg) of each mode. What is not known, a ratio of NaN or masses that are
/// left out, is written as 0.
struct ModeValues {
  std::vector<double> frequency_hz, damping_ratio, modal_mass{};
};

/// Writes a Universal File with the corners of the part's surface as nodes (data set 15, from 1), the edges between
/// them as trace lines (82), and the columns of `shapes`, over the free rows of the model, as normal modes (55). Throws
/// as io::write_uff_shapes(). Cost O(edges + corners · modes).
void write_test_shapes(const std::filesystem::path& path, const study::PartResult& part, const Eigen::MatrixXd& shapes,
                       const ModeValues& modes);

}  // namespace thinwall::report
