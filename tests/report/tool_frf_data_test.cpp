#include "report/page/tool_frf_data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "report/tool_files.hpp"
#include "result_folder.hpp"
#include "unpacked.hpp"

namespace thinwall::report::tool_frf_data_test {
namespace {

using nlohmann::json;
using Numbers = std::vector<double>;

setup::MeasuredFrf measured(const std::string& response, const std::string& force, double size, bool coherent) {
  auto content = std::make_shared<setup::FrfContent>();
  content->frf.axis.hz = Eigen::VectorXd::LinSpaced(20, 100.0, 290.0);
  content->frf.H = Eigen::VectorXcd::Constant(20, {size, -2.0 * size});
  content->frf.H(7) *= 3.0;
  if (coherent) content->frf.coherence = Eigen::VectorXd::LinSpaced(20, 0.5, 1.0);
  setup::MeasuredFrf file{.response = response, .force = force, .file = "tip.csv"};
  file.content = content;
  return file;
}

/// What was measured comes back through the table at its own place, with the coherence where there is one; an entry
/// that was not measured has no value.
TEST(ToolFrfData, IsWhatWasMeasured) {
  const auto file = result_folder("tool_frf") / "lobes" / "tool_frf.csv";
  EXPECT_EQ(tool_frf_data(file), nullptr);
  setup::Tool tool;
  write_tool_frf(file, tool);
  EXPECT_EQ(tool_frf_data(file), nullptr) << "of a tool without measurements there is no file";
  tool.measured = {measured("x", "x", 1e-6, true), measured("y", "y", 2e-6, false)};
  write_tool_frf(file, tool);
  const json frf = tool_frf_data(file);
  EXPECT_EQ(frf["responses"], json({"x", "y"}));
  EXPECT_EQ(unpacked<double>(frf["hz"])[1], 110.0);
  const auto H = unpacked<float>(frf["H"]);
  ASSERT_EQ(H.size(), 2U * 2U * 20U * 2U);
  EXPECT_NEAR(H[14], 3e-6, 1e-10);
  EXPECT_NEAR(H[15], -6e-6, 1e-10);
  EXPECT_TRUE(std::isnan(H[40])) << "x/y was not measured";
  EXPECT_NEAR(H[120], 2e-6, 1e-10);
  const auto coherence = unpacked<float>(frf["coherence"]);
  EXPECT_NEAR(coherence[19], 1.0, 1e-4);
  EXPECT_TRUE(std::isnan(coherence[60])) << "y/y has no coherence";
  EXPECT_FALSE(frf.contains("thinned"));
}

TEST(ToolFrfData, OfManyLinesKeepsThePeaks) {
  const auto file = result_folder("tool_frf_thinned") / "lobes" / "tool_frf.csv";
  setup::Tool tool;
  tool.measured = {measured("x", "x", 1e-6, false)};
  write_tool_frf(file, tool);
  const json frf = tool_frf_data(file, 8);
  const auto hz = unpacked<double>(frf["hz"]);
  EXPECT_LE(hz.size(), 8U);
  EXPECT_EQ(std::ranges::count(hz, 170.0), 1);
  EXPECT_EQ(frf["thinned"]["from"], 20);
  EXPECT_FALSE(frf.contains("coherence"));
}

}  // namespace
}  // namespace thinwall::report::tool_frf_data_test
