#include "report/robot_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "io/results/csv_table.hpp"
#include "io/results/polyline_vtu.hpp"
#include "robot/arm_kinematics.hpp"

namespace thinwall::report {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Round-off is shown as zero.
std::string three(const Eigen::Vector3d& v, double unit, const char* format) {
  std::string text;
  for (int i = 0; i < 3; ++i)
    text += fmt::format(fmt::runtime(format), std::abs(v[i] * unit) > 1e-9 ? v[i] * unit : 0.0);
  return text;
}

/// Stiffness along x, y, z in N/um; "-" along an axis of which nothing is known.
std::string three_stiffnesses(const Eigen::Vector3d& stiffness) {
  std::string text;
  for (const double value : stiffness)
    text += std::isfinite(value) ? fmt::format("{:>8.3g}", value * 1e-6) : fmt::format("{:>8}", "-");
  return text;
}

/// A line that names the axes whose stiffness is not known; "" where all are.
std::string unknown_axes(const Eigen::Vector3d& stiffness) {
  std::string axes;
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(stiffness[i])) axes += std::string(axes.empty() ? "" : ", ") + "xyz"[i];
  }
  return axes.empty() ? "" : "  -: not measured along " + axes + "; the robot's model does not move there\n";
}

std::size_t most_modes(const study::RobotSurvey& survey) {
  std::size_t most = 0;
  for (const study::TipReport& tip : survey.tips) most = std::max(most, tip.modes.size());
  return most;
}

/// A column of one number a posture; `of` gives NaN-free numbers.
template <typename Of>
io::Column column(const study::RobotSurvey& survey, const std::string& name, const Of& of) {
  std::vector<double> values;
  values.reserve(survey.tips.size());
  for (const study::TipReport& tip : survey.tips) values.push_back(of(tip));
  return {name, values};
}

io::Table columns(const study::RobotSurvey& survey) {
  io::Table table{
      column(survey, "posture", [&survey](const study::TipReport& tip) { return 1.0 + (&tip - survey.tips.data()); })};
  const study::TipReport& first = survey.tips.front();
  for (int i = 0; i < 3 && first.robot.tip; ++i)
    table.push_back(column(survey, std::string("tip_") + "xyz"[i] + "_m",
                           [i](const study::TipReport& t) { return (*t.robot.tip)[i]; }));
  for (Eigen::Index i = 0; i < first.robot.posture.q.size(); ++i)
    table.push_back(
        column(survey, fmt::format("joint_{}_{}", i + 1, first.robot.slides[static_cast<std::size_t>(i)] ? "m" : "rad"),
               [i](const study::TipReport& t) { return t.robot.posture.q(i); }));
  if (first.robot.smallest_singular)
    table.push_back(column(survey, "smallest_singular_value",
                           [](const study::TipReport& t) { return *t.robot.smallest_singular; }));
  for (std::size_t k = 0; k < most_modes(survey); ++k) {
    table.push_back(column(survey, fmt::format("frequency_{}_hz", k + 1), [k](const study::TipReport& t) {
      return k < t.modes.size() ? t.modes[k].frequency_hz : infinite;
    }));
    table.push_back(column(survey, fmt::format("damping_ratio_{}", k + 1), [k](const study::TipReport& t) {
      return k < t.modes.size() ? t.modes[k].damping_ratio : infinite;
    }));
  }
  if (!first.stiffness) return table;
  for (int i = 0; i < 3; ++i)
    table.push_back(column(survey, std::string("stiffness_") + "xyz"[i] + "_n_per_m",
                           [i](const study::TipReport& t) { return (*t.stiffness)[i]; }));
  table.push_back(
      column(survey, "least_stiffness_n_per_m", [](const study::TipReport& t) { return *t.least_stiffness; }));
  for (int i = 0; i < 3; ++i)
    table.push_back(
        column(survey, std::string("softest_") + "xyz"[i], [i](const study::TipReport& t) { return t.softest[i]; }));
  return table;
}

/// Every arm as a line from its base over its joints to the tip, then every tip as a point.
void write_arms(const std::filesystem::path& path, const robot::SerialArm& arm, const study::RobotSurvey& survey,
                const io::Table& table) {
  std::vector<Eigen::Matrix3Xd> lines, tips;
  for (const study::TipReport& tip : survey.tips) {
    const robot::ArmPose at = robot::pose(arm, tip.robot.posture.q);
    Eigen::Matrix3Xd line(3, at.joints() + 2);
    line << arm.base.translation(), at.origins, at.tip.translation();
    lines.push_back(line);
    tips.emplace_back(at.tip.translation());
  }
  lines.insert(lines.end(), tips.begin(), tips.end());
  std::vector<io::LineNumbers> numbers;
  for (const io::Column& c : table) {
    auto values = std::get<std::vector<double>>(c.values);
    if (!std::ranges::all_of(values, [](double v) { return std::isfinite(v); })) continue;
    const auto once = values;
    values.insert(values.end(), once.begin(), once.end());
    numbers.push_back({c.name, values});
  }
  io::write_polylines(path, lines, numbers);
}

void write_out_of_reach(const std::filesystem::path& below, const study::RobotSurvey& survey) {
  if (survey.out_of_reach.empty()) return;
  std::vector<double> x, y, z;
  std::vector<std::string> reasons;
  for (const study::OutOfReach& out : survey.out_of_reach) {
    x.push_back(out.place.x());
    y.push_back(out.place.y());
    z.push_back(out.place.z());
    reasons.push_back(out.reason);
  }
  std::ranges::for_each(reasons, [](std::string& reason) { std::ranges::replace(reason, ',', ';'); });
  io::write_csv(below / "out_of_reach.csv", {{"x_m", x}, {"y_m", y}, {"z_m", z}, {"reason", reasons}});
}

}  // namespace

PostureSummary posture_summary(const setup::RobotPosture& robot) {
  PostureSummary result;
  if (robot.posture.preload != Eigen::Vector3d::Zero()) result.preload_n = robot.posture.preload;
  if (!robot.tip) return result;
  result.joints_rad.emplace(robot.posture.q.begin(), robot.posture.q.end());
  result.tip_m = robot.tip;
  result.smallest_singular_value = *robot.smallest_singular;
  result.arm_m = robot.arm;
  return result;
}

std::string survey_text(const study::RobotSurvey& survey) {
  const study::TipReport& first = survey.tips.front();
  const auto joints = static_cast<std::size_t>(first.robot.posture.q.size());
  const std::size_t modes = std::min<std::size_t>(most_modes(survey), 4);
  const bool slides = std::ranges::count(first.robot.slides, true) > 0;
  std::string text = fmt::format("  {:>4}", "no.");
  if (first.robot.tip) text += fmt::format("  {:>24}", "tip x, y, z (mm)");
  if (joints > 0) text += fmt::format("  {:>{}}", slides ? "joints (deg, mm)" : "joints (deg)", 8 * joints);
  if (modes > 0) text += fmt::format("  {:>{}}", "modes (Hz)", 8 * modes);
  if (first.stiffness) text += fmt::format("  {:>24}  {:>8}  {}", "stiffness x, y, z (N/um)", "least", "along");
  text += '\n';
  for (std::size_t i = 0; i < survey.tips.size(); ++i) {
    const study::TipReport& tip = survey.tips[i];
    text += fmt::format("  {:>4}", i + 1);
    if (tip.robot.tip) text += "  " + three(*tip.robot.tip, 1e3, "{:>8.1f}");
    if (joints > 0) text += "  ";
    for (std::size_t j = 0; j < joints; ++j)
      text += fmt::format("{:>8.2f}", tip.robot.posture.q(static_cast<Eigen::Index>(j)) *
                                          (tip.robot.slides[j] ? 1e3 : 180.0 / std::numbers::pi));
    if (modes > 0) text += "  ";
    for (std::size_t k = 0; k < modes; ++k)
      text += k < tip.modes.size() ? fmt::format("{:>8.2f}", tip.modes[k].frequency_hz) : fmt::format("{:>8}", "-");
    if (tip.stiffness) {
      text += "  " + three_stiffnesses(*tip.stiffness) + fmt::format("  {:>8.3g}  ", *tip.least_stiffness * 1e-6) +
              fmt::format("({:.2f}, {:.2f}, {:.2f})", tip.softest.x(), tip.softest.y(), tip.softest.z());
    }
    if (tip.robot.smallest_singular && *tip.robot.smallest_singular < 1e-4) text += "  singular posture";
    text += '\n';
  }
  if (first.stiffness) text += unknown_axes(*first.stiffness);
  if (!survey.out_of_reach.empty()) {
    text += fmt::format("  {} of {} places are not reached; the first: {}\n", survey.out_of_reach.size(),
                        survey.out_of_reach.size() + survey.tips.size(), survey.out_of_reach.front().reason);
  }
  return text;
}

void write_survey(const std::filesystem::path& folder, const setup::Setup& source, const study::RobotSurvey& survey) {
  const std::filesystem::path below = folder / "robot";
  std::filesystem::remove_all(below);  // tables of an earlier survey
  std::filesystem::create_directories(below);
  write_out_of_reach(below, survey);
  if (survey.tips.empty()) return;
  const io::Table table = columns(survey);
  io::write_csv(below / "postures.csv", table, {"tip of the robot, part axes; stiffness: static, 1/H_nn(0)"});
  if (const auto* robot = std::get_if<setup::JointedRobot>(&source.robot->model))
    write_arms(below / "postures.vtu", robot->arm, survey, table);
}

}  // namespace thinwall::report
