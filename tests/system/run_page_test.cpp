// The page of a run holds the numbers of its results.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "io/frf/response_csv.hpp"
#include "io/results/csv_table.hpp"
#include "report/page/document.hpp"
#include "run_in_folder.hpp"
#include "tests/report/unpacked.hpp"
#include "tests/system/kept_wall.hpp"

namespace thinwall::tests::run_page_test {

namespace {

namespace fs = std::filesystem;

void expect_column(const nlohmann::json& array, const std::vector<double>& expected) {
  const auto found = report::unpacked<double>(array);
  EXPECT_EQ(found, expected);
}

/// H of the page, entry by entry against the file; the mirror image of an entry may stand for it.
void expect_receptances(const nlohmann::json& entry, const dynamics::ResponseModel& file) {
  const auto H = report::unpacked<float>(entry["H"]);
  const std::size_t n = file.responses.size(), lines = file.H.size();
  ASSERT_EQ(entry["H"]["shape"], (std::vector<std::size_t>{n, n, lines, 2}));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const bool mirrored = std::isnan(H[(i * n + j) * lines * 2]);
      EXPECT_EQ(mirrored, i > j);
      const std::size_t at = (mirrored ? j * n + i : i * n + j) * lines * 2;
      for (std::size_t line = 0; line < lines; ++line) {
        const auto expected = file.H[line](static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        const double close = 3e-5 * file.H[line].cwiseAbs().maxCoeff();
        ASSERT_NEAR(H[at + 2 * line], expected.real(), close) << i << ' ' << j << ' ' << line;
        ASSERT_NEAR(H[at + 2 * line + 1], expected.imag(), close) << i << ' ' << j << ' ' << line;
      }
    }
  }
}

/// A response with its lines at resonances among the others.
dynamics::ResponseModel drawn_response(const fs::path& frf, const std::string& name) {
  dynamics::ResponseModel response = io::read_response(frf / (name + ".csv"));
  const dynamics::ResponseModel added = io::read_response(frf / (name + "_added.csv"));
  std::map<double, Eigen::MatrixXcd> lines;
  for (const auto* of : {&std::as_const(response), &added}) {
    for (std::size_t line = 0; line < of->H.size(); ++line)
      lines[of->axis.hz(static_cast<Eigen::Index>(line))] = of->H[line];
  }
  response.H.clear();
  for (const auto& [hz, H] : lines) response.H.push_back(H);
  return response;
}

/// The page's data are the results: decoded from the document as the page does it.
TEST(RunPage, ThePageHoldsTheNumbersOfTheRun) {
  const fs::path folder = scratch("page_numbers");
  const auto summary = run_kept(kept_wall(), folder);
  const nlohmann::json document = report::document({{folder}, "thinwall"});
  const nlohmann::json& run = document["runs"][0];
  EXPECT_EQ(run["summary"]["lobes"][1]["minimum_depth_m"], summary["lobes"][1]["minimum_depth_m"]);
  ASSERT_EQ(run["lobes"].size(), 2U);
  for (const auto& chart : run["lobes"]) {
    const fs::path file = folder / "lobes" / (chart["name"].get<std::string>() + ".csv");
    expect_column(chart["rpm"], column(file, "spindle_speed_rpm"));
    expect_column(chart["depth_m"], column(file, "limiting_depth_m"));
    EXPECT_FALSE(chart["tooth_passing_hz"].empty());
  }
  ASSERT_EQ(run["frf"].size(), 4U);
  for (const auto& entry : run["frf"])
    expect_receptances(entry, drawn_response(folder / "frf", entry["name"].get<std::string>()));
  const auto hz = column(folder / "modes" / "modes.csv", "frequency_hz");
  const auto with_robot = column(folder / "modes" / "coupled_modes.csv", "frequency_hz");
  const auto& modes = run["shapes"]["modes"];
  ASSERT_EQ(modes.size(), hz.size() + with_robot.size());
  for (std::size_t k = 0; k < hz.size(); ++k) {
    EXPECT_EQ(modes[k]["hz"], hz[k]);
    EXPECT_EQ(modes[k]["damping"], summary["part"]["modes"][k]["damping_ratio"]);
  }
  for (std::size_t k = 0; k < with_robot.size(); ++k) EXPECT_EQ(modes[hz.size() + k]["hz"], with_robot[k]);
  ASSERT_EQ(run["shapes"]["fixtures"].size(), 1U);
  EXPECT_EQ(run["shapes"]["fixtures"][0]["name"], "z_min");
  EXPECT_EQ(run["mac"]["values"]["shape"][0], 4);
  EXPECT_GT(fs::file_size(folder / "report.html"), 2000000U);
  EXPECT_LT(fs::file_size(folder / "report.html"), 5000000U);
  const auto diagonal = column(folder / "modes" / "auto_mac.csv", "part_mode_2");
  EXPECT_NEAR(diagonal[1], 1.0, 1e-12);
}

/// Receptances that are kept for the page are in the order of the cut that they were kept for.
TEST(RunPage, AnotherCutPointComesFirstOnThePage) {
  const fs::path folder = scratch("page_cut");
  const auto first_dof = [&](const std::string& text) {
    (void)run_kept(text, folder);
    const std::string page = core::read_file(folder / "report.html");
    const std::size_t begin = page.find("id=\"data\">") + 10;
    const auto data = nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
    return data["runs"][0]["frf"][0]["responses"][0].get<std::string>();
  };
  const std::string two_points = kept_wall() + "[points.A]\nat = [1.0, 0.25, 1.0]\npatch_radius = \"1 mm\"\n";
  EXPECT_EQ(first_dof(two_points), "P.x");
  EXPECT_EQ(first_dof(replaced(two_points, "at = \"P\"\nradial", "at = \"A\"\nradial")), "A.x");
}

/// A free part has no damped model: its modes are not undamped, their damping is not known.
TEST(RunPage, DampingThatIsNotKnownIsToldAsSuch) {
  const fs::path folder = scratch("page_free");
  (void)run_kept(R"([part]
length = "80 mm"
height = "40 mm"
thickness = "3 mm"
[part.material]
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"
[part.mesh]
element_size = "20 mm"
[modes]
count = 8
)",
                 folder);
  const fs::path file = folder / "modes" / "modes.csv";
  const auto damping = io::numbers_or_gaps(io::read_csv(file), "damping_ratio", file);
  const nlohmann::json document = report::document({{folder}, "thinwall"});
  const auto& modes = document["runs"][0]["shapes"]["modes"];
  ASSERT_EQ(modes.size(), damping.size());
  ASSERT_GE(modes.size(), 8U);
  for (std::size_t k = 0; k < damping.size(); ++k) {
    EXPECT_TRUE(std::isnan(damping[k]));
    EXPECT_TRUE(modes[k]["damping"].is_null());
  }
}

}  // namespace
}  // namespace thinwall::tests::run_page_test
