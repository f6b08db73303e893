#pragma once
// A small result folder, written by hand.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/atomic_file.hpp"
#include "dynamics/response_model.hpp"
#include "io/frf/response_csv.hpp"
#include "report/summary/summary_json.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::report {

/// An empty folder of that name among the test's temporary files, with a summary.json.
inline std::filesystem::path result_folder(const std::string& name, const std::string& case_name = "small") {
  const std::filesystem::path folder = tests::temporary_files() / name;
  std::filesystem::remove_all(folder);
  for (const char* sub : {"frf", "modes", "lobes"}) std::filesystem::create_directories(folder / sub);
  Summary summary;
  summary.case_name = case_name;
  core::write_file_atomically(folder / "summary.json", summary_json(summary).dump());
  return folder;
}

/// Receptances of points along x that differ in every entry: H_ij = (1 + i + 10 j) (2 − ω²/2 + iω/100)⁻¹ with ω from
/// 0.5 to 3.5, symmetric if asked for.
inline dynamics::ResponseModel response_of(const std::vector<std::string>& points, int lines, bool symmetric) {
  dynamics::ResponseModel response;
  response.axis.hz = Eigen::VectorXd::LinSpaced(lines, 0.5, 3.5);
  for (const std::string& point : points)
    response.responses.push_back({point, Eigen::Vector3d::UnitX(), dynamics::DofKind::translation});
  response.forces = response.responses;
  const auto count = static_cast<Eigen::Index>(points.size());
  for (const double w : response.axis.hz) {
    Eigen::MatrixXcd H(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index j = 0; j < count; ++j) {
        const auto size = static_cast<double>(symmetric ? 1 + i + j : 1 + i + 10 * j);
        H(i, j) = size / std::complex<double>(2.0 - 0.5 * w * w, 0.01 * w);
      }
    }
    response.H.push_back(H);
  }
  return response;
}

}  // namespace thinwall::report
