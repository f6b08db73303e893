// A tool that is swapped in at the modes of the robot that carries it, at a posture where it was not tapped, against
// the machine assembled with that tool.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <fstream>
#include <functional>
#include <numbers>

#include "app/fit/fit_command.hpp"
#include "core/atomic_file.hpp"
#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/messages.hpp"
#include "milling/chart/sampled_stability.hpp"
#include "milling/direct/fitted_receptance.hpp"
#include "robot/modal_table.hpp"
#include "setup/identified/identify.hpp"
#include "setup/milling_process.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/lobes/drawn_structures.hpp"
#include "study/lobes/lobes_stage.hpp"
#include "study/lobes/tool_swap.hpp"
#include "study/postures/posture_study.hpp"
#include "tests/system/machine_in_postures.hpp"

namespace thinwall::tests::swap_on_robot_test {
namespace {

using namespace swap_on_robot;

/// A line of a table of modes: frequency, damping ratio, right and left vectors at 1X, 1Y, aX, aY.
void write_row(std::ofstream& file, double hz, double zeta, const Eigen::VectorXcd& right,
               const Eigen::VectorXcd& left) {
  file << hz << "," << zeta;
  for (Eigen::Index i = 0; i < right.size(); ++i)
    file << "," << right(i).real() << "," << right(i).imag() << "," << left(i).real() << "," << left(i).imag();
  file << "\n";
}

/// The model over its undamped modes below 100 kHz: all that a table has of it moves in these.
dynamics::SpatialModel low_modes(const dynamics::SpatialModel& all) {
  const dynamics::UndampedModes modes = dynamics::undamped_modes(all);
  const Eigen::Index count = (modes.omega_rad_s.array() < 2.0 * std::numbers::pi * 1e5).count();
  const Eigen::MatrixXd Phi = modes.Phi.leftCols(count);
  const Eigen::VectorXd omega = modes.omega_rad_s.head(count);
  return {Eigen::MatrixXd::Identity(count, count),
          Phi.transpose() * all.C * Phi,
          omega.cwiseAbs2().asDiagonal(),
          {},
          all.dofs,
          dynamics::displacements(all) * Phi};
}

/// Writes the modes of posture u with the reference tool up to `up_to_hz`, and unless told otherwise what they leave of
/// the static compliance as modes at six times that frequency; `damping` times the damping ratios.
void write_table(const fs::path& path, double u, double up_to_hz, bool with_rest = true, double damping = 1.0) {
  const dynamics::SpatialModel whole = assembled(u, reference());
  std::vector<int> rows;
  for (const char* name : {"1.x", "1.y", "1a.x", "1a.y"}) rows.push_back(dynamics::row_of(whole.dofs, name));
  const Eigen::MatrixXd T = dynamics::displacements(whole)(rows, Eigen::all);
  const dynamics::ModalModel modes = dynamics::to_modal(low_modes(whole));
  Eigen::MatrixXd rest = T * whole.K.ldlt().solve(T.transpose());
  std::ofstream file(path);
  file.precision(17);
  file << "frequency_hz,damping_ratio,R_1X_re,R_1X_im,L_1X_re,L_1X_im,R_1Y_re,R_1Y_im,L_1Y_re,L_1Y_im,"
          "R_1aX_re,R_1aX_im,L_1aX_re,L_1aX_im,R_1aY_re,R_1aY_im,L_1aY_re,L_1aY_im\n";
  const double largest = modes.right(rows, Eigen::all).cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < modes.poles.size(); ++k) {
    const std::complex<double> pole = modes.poles(k);
    const double hz = std::abs(pole) / (2.0 * std::numbers::pi);
    const Eigen::VectorXcd right = modes.right(rows, k), left = modes.left(rows, k) / modes.scaling(k);
    if (pole.imag() <= 0.0 || hz > up_to_hz || right.cwiseAbs().maxCoeff() < 1e-9 * largest) continue;
    rest += 2.0 * (right * left.transpose() / pole).real();
    write_row(file, hz, -damping * pole.real() / std::abs(pole), right, left);
  }
  if (!with_rest) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> statics(0.5 * (rest + rest.transpose()));
  for (Eigen::Index k = 0; k < 4; ++k) {
    constexpr double zeta = 0.1;
    const double omega = 2.0 * std::numbers::pi * 6.0 * up_to_hz * (1.0 + 0.1 * static_cast<double>(k));
    const Eigen::VectorXcd phi =
        (omega * std::sqrt(std::max(0.0, statics.eigenvalues()(k))) * statics.eigenvectors().col(k)).cast<Complex>();
    if (phi.isZero(0.0)) continue;
    write_row(file, omega / (2.0 * std::numbers::pi), zeta, phi,
              phi / Complex(0.0, 2.0 * omega * std::sqrt(1.0 - zeta * zeta)));
  }
}

/// Six millimetres thick, 120 mm out: held rigidly it would be at 370 Hz.
const std::string slender = R"(length = "120 mm"
outer_diameter = "6 mm"
youngs_modulus = "580 GPa"
density = "14400 kg/m^3"
)";
/// The tool that was tapped, in the two steps in which its own beam is divided at the second point.
const std::string same = R"(length = "20 mm"
outer_diameter = "16 mm"
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
density = "7850 kg/m^3"
[[tool.swap.target]]
length = "70 mm"
outer_diameter = "16 mm"
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
density = "7850 kg/m^3"
)";

std::string one_table(const std::string& target) {
  return "[robot]\nmodel = \"modal_table\"\ncarries = \"tool\"\ntable = \"modes.csv\"\n" + tools(target);
}

std::string postures(double at, const std::string& target) {
  return "[robot]\nmodel = \"modal_table\"\ncarries = \"tool\"\npostures = \"postures.csv\"\ntable = "
         "\"{posture}.csv\"\nover = [\"u\"]\nat = [" +
         std::to_string(at) + "]\n" + tools(target);
}

void write_postures(const fs::path& folder, int count, double up_to_hz, double damping = 1.0) {
  std::ofstream list(folder / "postures.csv");
  list << "posture,u\n";
  for (int i = 0; i < count; ++i) {
    const double u = 4.0 * i / (count - 1);
    list << "p" << i << "," << u << "\n";
    write_table(folder / ("p" + std::to_string(i) + ".csv"), u, up_to_hz, true, damping);
  }
}

/// The largest difference of the tip up to 3 kHz from that of the machine in posture u with the carbide tool, over the
/// largest receptance.
double off_truth(const milling::SampledReceptance& tip, double u) {
  const Eigen::Index lines = (tip.frequency_hz.array() < 3000.0).count();
  const dynamics::ResponseModel truth =
      machine::only(dynamics::direct_response(assembled(u, target()), {tip.frequency_hz.head(lines)}), {"1.x", "1.y"});
  double worst = 0.0, largest = 0.0;
  for (std::size_t line = 0; line < truth.H.size(); ++line) {
    worst = std::max(worst, (tip.H[line].topLeftCorner<2, 2>() - truth.H[line]).norm());
    largest = std::max(largest, truth.H[line].norm());
  }
  return worst / largest;
}

Case identified(const std::string& text, const fs::path& folder) {
  Case source = parse_case(text, folder);
  setup::identify(source);
  return source;
}

/// What the table leaves out is the only error, and falls with the square of its highest frequency.
TEST(SwapOnRobot, TheTipIsThatOfTheMachineWithTheOtherTool) {
  const fs::path folder = own_folder();
  double before = 0.0;
  for (const double up_to_hz : {12e3, 48e3}) {
    write_table(folder / "modes.csv", 1.0, up_to_hz);
    const study::SwappedTip found = study::swapped_tip(identified(one_table(carbide), folder));
    EXPECT_EQ(found.status, coupling::SwapStatus::done);
    const double off = off_truth(found.tip, 1.0);
    std::printf("modes up to %.0f Hz, %td lines: tip off by %.2g\n", up_to_hz, found.tip.frequency_hz.size(), off);
    if (before > 0.0) {
      EXPECT_LT(off, before / 4.0);
    }
    before = off;
  }
  write_table(folder / "modes.csv", 1.0, 12e3, false);
  const double bare = off_truth(study::swapped_tip(identified(one_table(carbide), folder)).tip, 1.0);
  std::printf("modes up to 12000 Hz alone: tip off by %.2g\n", bare);
  EXPECT_GT(bare, 0.01) << "the compliance of the modes above is felt";
}

/// A tool that is swapped for itself leaves the receptance of the table as it is, whatever the table leaves out.
TEST(SwapOnRobot, TheSameToolGivesBackTheModes) {
  const fs::path folder = own_folder();
  write_table(folder / "modes.csv", 0.0, 8e3);
  const Case source = identified(one_table(same), folder);
  const study::SwappedTip found = study::swapped_tip(source);
  const dynamics::ResponseModel table =
      dynamics::to_response(robot::modal_model(*source.tool->swap->table), {found.tip.frequency_hz});
  for (std::size_t line = 0; line < table.H.size(); ++line) {
    const Eigen::Matrix2cd swapped = found.tip.H[line].topLeftCorner(2, 2), tapped = table.H[line].topLeftCorner(2, 2);
    EXPECT_LT((swapped - tapped).norm(), 1e-7 * tapped.norm());
  }
}

/// The limiting depths of the machine in posture u with the carbide tool, by its receptance on lines to 20 kHz.
std::vector<double> true_depths(const Case& source, double u, const std::vector<double>& speeds_rpm) {
  const milling::MillingProcess process = setup::milling_process(source);
  const Eigen::Matrix3d R = process.frame.rotation();
  milling::SampledStructure lines{{dynamics::logarithmic_axis(200.0, 20000.0, 800).hz, {}}, {}};
  const dynamics::ResponseModel truth =
      machine::only(dynamics::direct_response(assembled(u, target()), {lines.samples.frequency_hz}), {"1.x", "1.y"});
  for (const Eigen::MatrixXcd& H : truth.H) {
    Eigen::Matrix3cd tip = Eigen::Matrix3cd::Zero();
    tip.topLeftCorner<2, 2>() = H;
    lines.samples.H.emplace_back(R.transpose() * tip * R);
  }
  const milling::FittedStructure structure = milling::fitted_structure(lines, process.frame);
  std::vector<double> depths;
  for (const double rpm : speeds_rpm)
    depths.push_back(
        milling::limiting_depth(structure, process, rpm, study::stability_options(*source.lobes)).limiting_depth_m);
  return depths;
}

/// A posture between the tapped ones, through the program: the chart is that of the machine with the carbide tool, and
/// its range of 95 % by what was learned holds it.
TEST(SwapOnRobot, AtAPostureBetweenTheTappedOnesHasTheDepthsOfTheMachine) {
  const fs::path folder = own_folder();
  constexpr double u = 1.3;
  write_postures(folder, 6, 16e3);
  const Case source = identified(postures(u, carbide), folder);
  const double off = off_truth(study::swapped_tip(source).tip, u);
  const nlohmann::json summary = run(postures(u, carbide), folder);
  ASSERT_EQ(summary["lobes"].size(), 1U) << "the robot is in the tip, and is charted once";
  EXPECT_EQ(summary["lobes"][0]["name"], "tool");
  const auto rpm = column(folder / "lobes" / "tool.csv", "spindle_speed_rpm"),
             depth = column(folder / "lobes" / "tool.csv", "limiting_depth_m"),
             low = column(folder / "lobes" / "tool.csv", "identification_low_m"),
             high = column(folder / "lobes" / "tool.csv", "identification_high_m");
  const std::vector<double> truth = true_depths(source, u, rpm);
  double worst = 0.0;
  std::size_t within = 0;
  for (std::size_t i = 0; i < rpm.size(); ++i) {
    worst = std::max(worst, std::abs(depth[i] / truth[i] - 1.0));
    within += low[i] <= truth[i] && truth[i] <= high[i] ? 1 : 0;
  }
  std::printf("posture between the tapped ones: tip off by %.2g, depths at %zu speeds by %.2g\n", off, rpm.size(),
              worst);
  EXPECT_LT(off, 0.005);
  EXPECT_LT(worst, 0.005);
  EXPECT_GE(within + 1, rpm.size()) << "ranges of 95 %";
  for (std::size_t i = 0; i < rpm.size(); ++i)
    EXPECT_LT(high[i] - low[i], 0.02 * depth[i]) << "six postures leave less than that open";
}

/// The answers over postures have the swapped tool, too: the depths of all modes at a posture between the tapped ones
/// and those over the map are those of the machine with the carbide tool, most of which lie in their bands.
TEST(SwapOnRobot, TheAnswersOnPosturesHaveTheDepthsOfTheMachine) {
  const fs::path folder = own_folder();
  write_postures(folder, 6, 16e3);
  const Case source = parse_case(postures(1.3, carbide), folder);
  study::PostureQuestions questions = study::questions_on({"map", "envelope"});
  questions.grid = 3;
  questions.spindle_speed_rpm = 14000.0;
  const study::PostureStudy found = study::study_postures(source, questions);
  ASSERT_TRUE(found.envelope);
  const std::vector<double> truth = true_depths(source, 1.3, found.chart_rpm);
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_NEAR(found.envelope->together(static_cast<Eigen::Index>(i)), truth[i], 0.005 * truth[i]) << i;
  const milling::SampledReceptance tip = study::swapped_tip(identified(postures(1.3, carbide), folder)).tip;
  const Eigen::ArrayXd hz = milling::fitted_poles(tip).poles.cwiseAbs() / (2.0 * std::numbers::pi);
  EXPECT_TRUE((hz < found.envelope->split_hz).any()) << "a low mode";
  EXPECT_TRUE((hz > found.envelope->split_hz).any()) << "a high mode";
  std::size_t within = 0;
  ASSERT_EQ(std::ssize(found.map), found.mapped_at.rows());
  for (std::size_t i = 0; i < found.map.size(); ++i) {
    ASSERT_TRUE(found.map[i].depth);
    const posture::Banded& depth = found.map[i].depth->depth_m;
    const double there = true_depths(source, found.mapped_at(static_cast<Eigen::Index>(i), 0), {14000.0})[0];
    EXPECT_NEAR(depth.value, there, 0.005 * there) << i;
    within += depth.low <= there && there <= depth.high ? 1 : 0;
  }
  EXPECT_GE(within + 1, found.map.size());
}

/// The messages that a program's listener hears while something is done.
std::string told_while(const std::function<void()>& done) {
  std::string told;
  const auto before = core::set_message_listener([&](core::MessageLevel, const std::string& said) { told += said; });
  done();
  (void)core::set_message_listener(before);
  return told;
}

/// With a part of their damping alone the modes are those of no passive machine: the answers say so as a run does.
TEST(SwapOnRobot, TheAnswersOnPosturesTellWhatARunTells) {
  const fs::path folder = own_folder();
  write_postures(folder, 6, 16e3, 0.1);
  const Case source = parse_case(postures(1.3, carbide), folder);
  study::PostureQuestions questions = study::questions_on({});
  questions.spindle_speed_rpm = 14000.0;
  const std::string told = told_while([&] { (void)study::study_postures(source, questions); });
  const Case run = identified(postures(1.3, carbide), folder);
  const milling::ToolFrame frame = setup::milling_process(run).frame;
  const std::string of_run = told_while([&] { (void)study::cut_structure(run, frame, nullptr); });
  EXPECT_NE(of_run.find("gives energy"), std::string::npos) << of_run;
  EXPECT_NE(of_run.find("grows by itself"), std::string::npos) << of_run;
  EXPECT_NE(told.find(of_run), std::string::npos) << told;
}

/// The change of the lines that is handed to the ranges is that of a draw's own modes, swapped by themselves.
TEST(SwapOnRobot, ADrawChangesTheLinesByItsOwnSwap) {
  const fs::path folder = own_folder();
  write_postures(folder, 6, 16e3);
  const Case source = identified(postures(1.3, carbide), folder);
  const milling::ToolFrame frame = setup::milling_process(source).frame;
  const auto changes = study::drawn_swaps(source, frame);
  ASSERT_EQ(changes.size(), setup::draws_of(source));
  ASSERT_GE(changes.size(), 2U);
  const std::size_t last = changes.size() - 1;
  setup::CutSetup cut = source;
  setup::SupportSetup support = source;
  setup::take_draw(last, cut, support);
  const study::SwappedTip expected = study::swapped_tip(source);
  const dynamics::ResponseModel tip =
      study::swapped_response(
          *cut.tool->swap, Vector3d::UnitZ(),
          dynamics::to_response(robot::modal_model(*cut.tool->swap->table), {expected.tip.frequency_hz}))
          .tip;
  const Eigen::Matrix3d R = frame.rotation();
  double largest = 0.0;
  for (std::size_t line = 0; line < tip.H.size(); ++line) {
    Eigen::Matrix3cd change = -expected.tip.H[line];
    change.topLeftCorner<2, 2>() += tip.H[line];
    EXPECT_LT((changes[last][line] - R.transpose() * change * R).norm(), 1e-9 * expected.tip.H[line].norm());
    largest = std::max(largest, change.norm() / expected.tip.H[line].norm());
  }
  EXPECT_GT(largest, 1e-4) << "a draw is another one";
}

/// A slender target has a lower frequency than the lowest mode with the rod.
TEST(SwapOnRobot, LinesBeginBelowASlenderTarget) {
  const fs::path folder = own_folder();
  write_table(folder / "modes.csv", 1.0, 12e3);
  const Case source = identified(one_table(slender), folder);
  const milling::SampledReceptance tip = study::swapped_tip(source).tip;
  const auto peaks = milling::resonances(tip);
  ASSERT_FALSE(peaks.empty());
  for (const dynamics::ModalTableRow& row : source.tool->swap->table->rows)
    EXPECT_LT(peaks.front().frequency_hz, row.frequency_hz);
  EXPECT_LE(tip.frequency_hz(0), 0.5 * peaks.front().frequency_hz);
}

/// A target with less damping than any mode with the rod has four lines in a peak's width, too.
TEST(SwapOnRobot, LinesResolveATargetOfLittleDamping) {
  const fs::path folder = own_folder();
  write_table(folder / "modes.csv", 1.0, 12e3);
  const Case source = identified(one_table(replaced(slender, "120 mm", "80 mm")), folder);
  const milling::SampledReceptance tip = study::swapped_tip(source).tip;
  EXPECT_FALSE(study::unresolved_peak_hz(tip));
  EXPECT_GT(tip.frequency_hz.size(), study::lines_of_modes(*source.tool->swap).size()) << "the modes need fewer";
}

/// What is missing is told in one line at its key.
TEST(SwapOnRobot, TellsWhatIsMissing) {
  const fs::path folder = own_folder();
  write_table(folder / "modes.csv", 0.0, 8e3);
  const auto told = [&](const std::string& from, const std::string& to, const std::string& part) {
    try {
      (void)parse_case(replaced(one_table(carbide), from, to), folder);
      ADD_FAILURE() << "accepted, though " << part;
    } catch (const core::Error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  told("up = \"1a\"", "up = \"2\"", "tool.swap.up: \"2\" is no point of the robot's tables");
  told("up = \"1a\"", "up = \"1\"", "tool.swap.up: \"1\" is robot.table_point, the tip");
  told("up = \"1a\"", "up = \"1a\"\ntip = \"1\"", "tool.swap.tip: ");
  told("up = \"1a\"", "up = \"1a\"\nrotations = \"rank_one\"", "tool.swap.rotations: ");
  told("table = ", "cross_terms = false\ntable = ", "robot.cross_terms: ");
  told("carries = \"tool\"\n", "", "tool.swap: needs [[tool.swap.measured]]");
  told("[cutting]", "[cutting]\ntool_axis = \"x\"", "two at each");
  const std::string robot_alone =
      replaced(one_table(carbide), "[lobes]\nfrom = \"8000 rpm\"\nto = \"20000 rpm\"\ncount = 8\nmost_added = 0\n", "");
  EXPECT_NO_THROW((void)parse_case(robot_alone, folder));
  EXPECT_THROW((void)parse_case(replaced(robot_alone, "up = \"1a\"", "up = \"zz\""), folder), core::Error)
      << "also where nothing is charted";
}

/// The second point may have the name that a tip has unless it is named.
TEST(SwapOnRobot, TakesAnyNamesOfTheTwoPoints) {
  const fs::path folder = own_folder();
  write_table(folder / "modes.csv", 0.0, 8e3);
  const study::SwappedTip usual = study::swapped_tip(identified(one_table(carbide), folder));
  std::string table = core::read_file(folder / "modes.csv");
  for (const auto& [from, to] :
       {std::pair("_1X", "_TX"), std::pair("_1Y", "_TY"), std::pair("_1aX", "_1X"), std::pair("_1aY", "_1Y")}) {
    for (int i = 0; i < 4; ++i) table = replaced(table, from, to);
  }
  std::ofstream(folder / "modes.csv") << table;
  const std::string named =
      replaced(replaced(one_table(carbide), "up = \"1a\"", "up = \"1\""), "table = ", "table_point = \"T\"\ntable = ");
  const study::SwappedTip other = study::swapped_tip(identified(named, folder));
  ASSERT_EQ(other.tip.H.size(), usual.tip.H.size());
  for (std::size_t line = 0; line < usual.tip.H.size(); ++line) EXPECT_EQ(other.tip.H[line], usual.tip.H[line]);
}

}  // namespace
}  // namespace thinwall::tests::swap_on_robot_test
