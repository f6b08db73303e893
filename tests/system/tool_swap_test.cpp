// A case whose tool is another than the one that was measured, against the assembled machine with that tool.

#include "study/lobes/tool_swap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "app/case_run.hpp"
#include "case/problem.hpp"
#include "case/reader.hpp"
#include "io/frf/uff.hpp"
#include "milling/chart/sampled_stability.hpp"
#include "report/summary/summary_json.hpp"
#include "setup/milling_process.hpp"
#include "study/lobes/lobes_stage.hpp"
#include "tests/system/run_in_folder.hpp"
#include "tests/system/swapped_tools.hpp"
#include "tests/verification/tool_swap/machine.hpp"

namespace thinwall::tests::tool_swap_test {

using namespace app;
using namespace setup;
using namespace cases;
using namespace study;

namespace {

namespace fs = std::filesystem;
namespace machine = coupling::testing;

/// The machine as measured at the tip and 20 mm up.
dynamics::ResponseModel with_reference(const dynamics::FrequencyAxis& axis) {
  return machine::only(machine::assembled(swapped_tools::reference(), coupling::radial_contact("root", "holder"), axis),
                       {"1.x", "1.y", "1a.x", "1a.y"});
}

dynamics::ResponseModel with_target(const dynamics::FrequencyAxis& axis) {
  return machine::only(machine::assembled(swapped_tools::target(), coupling::radial_contact("root", "holder"), axis),
                       {"1.x", "1.y"});
}

std::string swap_case() {
  std::string text = R"([tool]
teeth = 2
diameter = "12 mm"
length = "20 mm"
[tool.swap]
distance = "20 mm"
)" + swapped_tools::reference_table +
                     "[[tool.swap.target]]\n" + swapped_tools::carbide;
  const char* const dofs[] = {"1.x", "1.y", "1a.x", "1a.y"};
  for (int i = 0; i < 16; ++i) {
    text += std::string("[[tool.swap.measured]]\nresponse = \"") + dofs[i / 4] + "\"\nforce = \"" + dofs[i % 4] +
            "\"\nfile = \"reference.uff\"\nrecord = " + std::to_string(i + 1) + "\n";
  }
  return text +
         "[cutting]\nradial_depth = \"1 mm\"\nKt = \"800 N/mm^2\"\nKr = \"240 N/mm^2\"\n"
         "[lobes]\nfrom = \"8000 rpm\"\nto = \"20000 rpm\"\ncount = 4\n";
}

/// Of the test's own name: tests run beside each other.
fs::path measured_folder(const dynamics::FrequencyAxis& axis) {
  const fs::path folder =
      scratch(std::string("tool_swap_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
  io::UffForm form;
  form.binary = true;
  io::write_uff(folder / "reference.uff", with_reference(axis), form);
  return folder;
}

TEST(ToolSwapCase, TheTipIsThatOfTheAssembledMachineWithTheOtherTool) {
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(50.0, 5000.0, 199);
  const SwappedTip found = swapped_tip(parse_case(swap_case(), measured_folder(axis)));
  EXPECT_EQ(found.status, coupling::SwapStatus::done);
  const dynamics::ResponseModel expected = with_target(axis);
  double worst = 0.0;
  for (std::size_t line = 0; line < expected.H.size(); ++line) {
    const Eigen::Matrix2cd difference = found.tip.H[line].topLeftCorner<2, 2>() - expected.H[line];
    worst = std::max(worst, difference.norm() / expected.H[line].norm());
    EXPECT_EQ(found.tip.H[line](2, 2), 0.0) << "along its axis nothing is known";
  }
  std::printf("swapped tip against the assembled machine: %.1e\n", worst);
  EXPECT_LT(worst, 1e-7) << "the file holds doubles; frequencies to the last bit";
}

// cases/tool-swap: its file is the synthetic machine's, in single precision, and its tip that of the assembled machine.
TEST(ToolSwapCase, TheCaseIsTheSyntheticMachine) {
  const fs::path folder = fs::path(THINWALL_SOURCE_DIR) / "cases" / "tool-swap";
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(5.0, 6000.0, 1200);
  io::UffForm form;
  form.binary = true;
  form.double_precision = false;
  const dynamics::ResponseModel machine_model = with_reference(axis);
  if (std::getenv("THINWALL_WRITE_DOCS") != nullptr) io::write_uff(folder / "reference.uff", machine_model, form);
  const dynamics::ResponseModel file = io::read_uff(folder / "reference.uff").response;
  ASSERT_EQ(file.H.size(), machine_model.H.size());
  for (std::size_t line = 0; line < file.H.size(); ++line)
    EXPECT_LT((file.H[line] - machine_model.H[line]).norm(), 1e-7 * machine_model.H[line].norm());
  const SwappedTip found = swapped_tip(read_case(folder, {}));
  const dynamics::ResponseModel expected = with_target(axis);
  double worst = 0.0;
  for (std::size_t line = 40; line < expected.H.size(); ++line)  // from 205 Hz: below, the rigid tool hides the holder
    worst =
        std::max(worst, (found.tip.H[line].topLeftCorner<2, 2>() - expected.H[line]).norm() / expected.H[line].norm());
  std::printf("cases/tool-swap from single precision: %.1e\n", worst);
  EXPECT_LT(worst, 1e-4) << "single precision has 6e-8, of which the swap costs digits";
}

/// The column "status" of a chart's file, which is its last where nothing is known of the errors of its data.
std::vector<std::string> statuses(const fs::path& file) {
  const io::Table table = io::read_csv(file);
  EXPECT_EQ(table.back().name, "status");
  return std::get<std::vector<std::string>>(table.back().values);
}

/// cases/tool-swap draws the boundary of the assembled machine, which is known here on lines to 20 kHz, between its
/// speeds too: within what the line and its rows claim and a hundredth of the depth.
TEST(ToolSwapCase, TheLineOfTheCaseIsTheBoundaryOfTheAssembledMachine) {
  const Case source = read_case(fs::path(THINWALL_SOURCE_DIR) / "cases" / "tool-swap", {});
  const fs::path out = scratch("tool_swap_line");
  const auto chart = summary_json(run_case(source, {out, true, -1, false}).summary)["lobes"][0];
  const milling::MillingProcess process = milling_process(source);
  const Eigen::Matrix3d R = process.frame.rotation();
  milling::SampledStructure lines{{dynamics::linear_axis(5.0, 20000.0, 4000).hz, {}}, {}};
  for (const Eigen::MatrixXcd& H : with_target({lines.samples.frequency_hz}).H) {
    Eigen::Matrix3cd tip = Eigen::Matrix3cd::Zero();
    tip.topLeftCorner<2, 2>() = H;
    lines.samples.H.emplace_back(R.transpose() * tip * R);
  }
  const milling::FittedStructure machine_tip = milling::fitted_structure(lines, process.frame);
  milling::StabilityOptions options = stability_options(*source.lobes);
  options.follow = 1.0;
  const auto rpm = column(out / "lobes" / "tool.csv", "spindle_speed_rpm"),
             depth = column(out / "lobes" / "tool.csv", "limiting_depth_m"),
             error = column(out / "lobes" / "tool.csv", "error_estimate_relative");
  const auto least_rpm = chart["at_spindle_speed_rpm"].get<double>();
  const double least = milling::limiting_depth(machine_tip, process, least_rpm, options).limiting_depth_m;
  // Rows that are no answer lie at the noses of two flip lobes, whose speeds the lines do not tell any better.
  constexpr double noses_rpm[] = {14374.0, 18593.0}, beside = 5e-4;
  for (const double nose : noses_rpm) {
    const auto kind = [&](double n) { return milling::limiting_depth(machine_tip, process, n, options).kind; };
    EXPECT_NE(kind(nose * (1.0 - beside)), kind(nose * (1.0 + beside))) << nose << " rpm is a nose of the machine";
  }
  const auto status = statuses(out / "lobes" / "tool.csv");
  for (std::size_t i = 0; i < rpm.size(); ++i) {
    if (status[i] == "converged" || status[i] == "data_limited" || status[i] == "stable_to_depth_limit") continue;
    const bool at_nose =
        std::ranges::any_of(noses_rpm, [&](double nose) { return std::abs(rpm[i] / nose - 1.0) < beside; });
    EXPECT_TRUE(at_nose) << rpm[i] << " rpm: " << status[i];
  }
  double worst = 0.0;
  for (const double n : milling::spindle_speeds(8001.0, 19999.0, 300)) {
    const milling::LobeRow row = milling::limiting_depth(machine_tip, process, n, options);
    const auto right = static_cast<std::size_t>(std::ranges::lower_bound(rpm, n) - rpm.begin());
    const double share = (n - rpm[right - 1]) / (rpm[right] - rpm[right - 1]);
    const double line = depth[right - 1] + share * (depth[right] - depth[right - 1]);
    const double off = std::abs(line / row.limiting_depth_m - 1.0);
    const double claimed = std::max(0.02, 2.0 * std::max(error[right - 1], error[right]));
    EXPECT_LE(off, claimed + 0.01 + row.error_estimate) << n << " rpm";
    worst = std::max(worst, off);
    EXPECT_GE(row.limiting_depth_m, 0.98 * least) << n << " rpm: no pit is overlooked";
  }
  std::printf("cases/tool-swap: line within %.1e of the machine's boundary, least depth there %.4g mm\n", worst,
              1e3 * least);
  EXPECT_NEAR(chart["minimum_depth_m"].get<double>() / least, 1.0, 0.01) << "the case's tolerance";
  EXPECT_TRUE(chart["line"]["met"].get<bool>());
}

TEST(ToolSwapCase, ItsChartIsThatOfTheMeasuredTip) {
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(5.0, 8000.0, 1600);
  const fs::path folder = measured_folder(axis);
  const auto swapped =
      summary_json(run_case(parse_case(swap_case(), folder), {folder / "swap", true, -1, false}).summary);
  io::UffForm form;
  form.binary = true;
  io::write_uff(folder / "target.uff", with_target(axis), form);
  std::string text = swap_case();
  text.replace(text.find("[tool.swap]"), text.find("[cutting]") - text.find("[tool.swap]"), "");
  int record = 0;
  std::string files;
  for (const char* response : {"x", "y"}) {
    for (const char* force : {"x", "y"}) {
      files += std::string("[[tool.measured]]\nresponse = \"") + response + "\"\nforce = \"" + force +
               "\"\nfile = \"target.uff\"\nrecord = " + std::to_string(++record) + "\n";
    }
  }
  text.insert(text.find("[cutting]"), files);
  const auto measured = summary_json(run_case(parse_case(text, folder), {folder / "direct", true, -1, false}).summary);
  EXPECT_NEAR(
      swapped["lobes"][0]["minimum_depth_m"].get<double>() / measured["lobes"][0]["minimum_depth_m"].get<double>(), 1.0,
      1e-4);
}

TEST(ToolSwapCase, WhatIsMissingIsSaid) {
  const fs::path folder = measured_folder(dynamics::linear_axis(50.0, 5000.0, 20));
  const auto refused = [&](std::string text, const std::string& from, const std::string& to, const std::string& part) {
    text.replace(text.find(from), from.size(), to);
    try {
      (void)swapped_tip(parse_case(text, folder));
      ADD_FAILURE() << "accepted, though " << part;
    } catch (const core::Error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refused(swap_case(), "distance = \"20 mm\"", "distance = \"95 mm\"", "beyond the overhang");
  refused(swap_case(), "distance = \"20 mm\"", "distance = \"0 mm\"", "above 0");
  refused(swap_case(), "length = \"65 mm\"", "length = \"0 mm\"", "above 0");
  refused(swap_case(), "distance = \"20 mm\"", "distance = \"20 mm\"\nup = \"2\"", "point \"2\"");
  refused(swap_case(), "[[tool.swap.target]]", "[[tool.swap.reference]]", "needs [[tool.swap.target]]");
  refused(swap_case(), "record = 3\n", "", "holds 16 FRFs");
}

}  // namespace
}  // namespace thinwall::tests::tool_swap_test
