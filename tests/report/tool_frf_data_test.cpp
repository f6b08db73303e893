#include "report/page/tool_frf_data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
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

/// Half of what was measured is as like it as can be (FRAC 1) and half of it off; lines that the fit lacks do not
/// count.
TEST(ToolFrfData, SaysHowWellTheFittedPolesAgree) {
  const auto file = result_folder("tool_frf_fit") / "lobes" / "tool_frf.csv";
  setup::Tool tool;
  tool.measured = {measured("x", "x", 1e-6, true), measured("y", "x", 2e-6, false)};
  milling::SampledReceptance fit{Eigen::VectorXd::LinSpaced(10, 100.0, 190.0), {}};
  for (Eigen::Index line = 0; line < 10; ++line) {
    fit.H.emplace_back(Eigen::Matrix3cd::Zero());
    fit.H.back()(0, 0) = std::complex<double>(0.5e-6, -1e-6) * (line == 7 ? 3.0 : 1.0);
    fit.H.back()(1, 0) = std::complex<double>(4e-6, 2e-6) * (line == 7 ? 3.0 : 1.0);
  }
  write_tool_frf(file, tool, fit);
  const json frf = tool_frf_data(file);
  const auto agreement = unpacked<double>(frf["agreement"]);
  ASSERT_EQ(agreement.size(), 4U) << "responses x and y, force x";
  EXPECT_NEAR(agreement[0], 1.0, 1e-12);
  EXPECT_NEAR(agreement[1], 0.5, 1e-12);
  EXPECT_NEAR(agreement[2], 1.0, 1e-12) << "a quarter of a turn ahead, which FRAC does not see";
  EXPECT_GT(agreement[3], 1.0) << "but the error does";
  const auto poles = unpacked<float>(frf["synthesised"]);
  ASSERT_EQ(poles.size(), 2U * 20U * 2U);
  EXPECT_NEAR(poles[14], 1.5e-6, 1e-10);
  EXPECT_TRUE(std::isnan(poles[2 * 10])) << "at 200 Hz the fit has no line";
}

/// The entries of a swapped tip stand at their own places beside those of the fitted poles; along the axis, where
/// nothing is known, there is none.
TEST(ToolFrfData, OfASwappedToolIsWhatTheSwapGave) {
  const auto file = result_folder("tool_frf_swapped") / "lobes" / "tool_frf.csv";
  milling::SampledReceptance tip{Eigen::VectorXd::LinSpaced(4, 100.0, 130.0), {}};
  for (int line = 0; line < 4; ++line) {
    Eigen::Matrix3cd H = Eigen::Matrix3cd::Zero();
    H.topLeftCorner<2, 2>() << std::complex<double>(1e-6, -2e-6), 3e-6, 4e-6, 5e-6;
    tip.H.emplace_back(H);
  }
  milling::SampledReceptance fit = tip;
  for (Eigen::Matrix3cd& H : fit.H) H *= 1.5;
  write_swapped_frf(file, tip, fit);
  const json frf = tool_frf_data(file);
  EXPECT_EQ(frf["responses"], json({"tool.x", "tool.y"}));
  EXPECT_EQ(frf["forces"], json({"tool.x", "tool.y"}));
  const auto H = unpacked<float>(frf["H"]), poles = unpacked<float>(frf["synthesised"]);
  ASSERT_EQ(H.size(), 2U * 2U * 4U * 2U);
  EXPECT_NEAR(H[1], -2e-6, 1e-10);
  EXPECT_NEAR(H[8], 3e-6, 1e-10) << "x/y";
  EXPECT_NEAR(H[16], 4e-6, 1e-10) << "y/x";
  EXPECT_NEAR(poles[24], 7.5e-6, 1e-10) << "y/y";
  EXPECT_NEAR(unpacked<double>(frf["agreement"])[1], 0.5, 1e-9);
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
