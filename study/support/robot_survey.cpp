#include "study/support/robot_survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "io/results/csv_table.hpp"
#include "io/results/polyline_vtu.hpp"
#include "robot/arm_kinematics.hpp"
#include "setup/path.hpp"
#include "setup/robot_tip.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// D of u_tip = D q; a tip's table holds one point alone.
Eigen::Matrix3Xd translations_of(const dynamics::DofTable& dofs) {
  return dynamics::displacement_matrix(dofs, dofs.front().point);
}

/// Re H(0) between the tip's translations, m/N; none without a model.
std::optional<Eigen::Matrix3d> static_compliance(const Component& tip) {
  if (tip.spatial && !tip.modal) return std::nullopt;  // it moves without any force
  if (tip.spatial) {
    const Eigen::MatrixXd T = translations_of(tip.spatial->dofs) * dynamics::displacements(*tip.spatial);
    return T * tip.spatial->K.ldlt().solve(T.transpose());
  }
  if (!tip.modal) return std::nullopt;
  const Eigen::Matrix3Xd D = translations_of(tip.modal->dofs);
  const dynamics::FrequencyAxis at_rest{Eigen::VectorXd::Zero(1)};
  return D * dynamics::to_response(*tip.modal, at_rest).H.front().real() * D.transpose();
}

/// Infinite where nothing moves; negative, and seen as such, where a table of modes says so of rest.
double stiffness_of(double compliance, double largest) {
  return std::abs(compliance) > 1e-12 * largest ? 1.0 / compliance : infinite;
}

TipReport report_at(const setup::Setup& source, const std::optional<Eigen::VectorXd>& near) {
  const setup::RobotPosture robot = setup::robot_posture(source, near);
  const bool measured = source.robot->model == "measured";
  const dynamics::FrequencyAxis one_line{Eigen::VectorXd::Ones(1)};  // modes and stiffness need no more
  return tip_report(robot, robot_component(source, measured ? frequency_axis(source) : one_line, robot.posture));
}

/// Adds the robot of `there`, or why it cannot stand so.
void add(const setup::Setup& there, const Eigen::Vector3d& place, RobotSurvey& survey) {
  std::optional<Eigen::VectorXd> near;
  if (!survey.tips.empty()) near = survey.tips.back().robot.posture.q;
  try {
    survey.tips.push_back(report_at(there, near));
  } catch (const core::InputError& error) {
    survey.out_of_reach.push_back({place, error.what()});
  }
}

/// Round-off is shown as zero.
std::string three(const Eigen::Vector3d& v, double unit, const char* format) {
  std::string text;
  for (int i = 0; i < 3; ++i)
    text += fmt::format(fmt::runtime(format), std::abs(v[i] * unit) > 1e-9 ? v[i] * unit : 0.0);
  return text;
}

std::size_t most_modes(const RobotSurvey& survey) {
  std::size_t most = 0;
  for (const TipReport& tip : survey.tips) most = std::max(most, tip.modes.size());
  return most;
}

/// A column of one number a posture; `of` gives NaN-free numbers.
template <typename Of>
io::Column column(const RobotSurvey& survey, const std::string& name, const Of& of) {
  std::vector<double> values;
  values.reserve(survey.tips.size());
  for (const TipReport& tip : survey.tips) values.push_back(of(tip));
  return {name, values};
}

io::Table columns(const RobotSurvey& survey) {
  io::Table table{
      column(survey, "posture", [&survey](const TipReport& tip) { return 1.0 + (&tip - survey.tips.data()); })};
  const TipReport& first = survey.tips.front();
  for (int i = 0; i < 3 && first.robot.tip; ++i)
    table.push_back(
        column(survey, std::string("tip_") + "xyz"[i] + "_m", [i](const TipReport& t) { return (*t.robot.tip)[i]; }));
  for (Eigen::Index i = 0; i < first.robot.posture.q.size(); ++i)
    table.push_back(
        column(survey, fmt::format("joint_{}_rad", i + 1), [i](const TipReport& t) { return t.robot.posture.q(i); }));
  if (first.robot.smallest_singular)
    table.push_back(
        column(survey, "smallest_singular_value", [](const TipReport& t) { return *t.robot.smallest_singular; }));
  for (std::size_t k = 0; k < most_modes(survey); ++k) {
    table.push_back(column(survey, fmt::format("frequency_{}_hz", k + 1), [k](const TipReport& t) {
      return k < t.modes.size() ? t.modes[k].frequency_hz : infinite;
    }));
    table.push_back(column(survey, fmt::format("damping_ratio_{}", k + 1), [k](const TipReport& t) {
      return k < t.modes.size() ? t.modes[k].damping_ratio : infinite;
    }));
  }
  if (!first.stiffness) return table;
  for (int i = 0; i < 3; ++i)
    table.push_back(column(survey, std::string("stiffness_") + "xyz"[i] + "_n_per_m",
                           [i](const TipReport& t) { return (*t.stiffness)[i]; }));
  table.push_back(column(survey, "least_stiffness_n_per_m", [](const TipReport& t) { return *t.least_stiffness; }));
  for (int i = 0; i < 3; ++i)
    table.push_back(
        column(survey, std::string("softest_") + "xyz"[i], [i](const TipReport& t) { return t.softest[i]; }));
  return table;
}

/// Every arm as a line from its base over its joints to the tip, then every tip as a point.
void write_arms(const std::filesystem::path& path, const robot::SerialArm& arm, const RobotSurvey& survey,
                const io::Table& table) {
  std::vector<Eigen::Matrix3Xd> lines, tips;
  for (const TipReport& tip : survey.tips) {
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

void write_out_of_reach(const std::filesystem::path& below, const RobotSurvey& survey) {
  if (survey.out_of_reach.empty()) return;
  std::vector<double> x, y, z;
  std::vector<std::string> reasons;
  for (const OutOfReach& out : survey.out_of_reach) {
    x.push_back(out.place.x());
    y.push_back(out.place.y());
    z.push_back(out.place.z());
    reasons.push_back(out.reason);
  }
  std::ranges::for_each(reasons, [](std::string& reason) { std::ranges::replace(reason, ',', ';'); });
  io::write_csv(below / "out_of_reach.csv", {{"x_m", x}, {"y_m", y}, {"z_m", z}, {"reason", reasons}});
}

}  // namespace

TipReport tip_report(const setup::RobotPosture& robot, const Component& tip) {
  TipReport report;
  report.robot = robot;
  if (tip.modal) {
    for (const int k : dynamics::oscillating_modes(*tip.modal))
      report.modes.push_back(dynamics::summarise(tip.modal->poles(k)));
  }
  const auto compliance = static_compliance(tip);
  if (!compliance) return report;
  const Eigen::Matrix3d S = 0.5 * (*compliance + compliance->transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(S);
  const double largest = principal.eigenvalues().cwiseAbs().maxCoeff();
  report.stiffness = S.diagonal().unaryExpr([&](double c) { return stiffness_of(c, largest); });
  report.least_stiffness = stiffness_of(principal.eigenvalues()(2), largest);
  report.softest = principal.eigenvectors().col(2);
  Eigen::Index main = 0;
  report.softest.cwiseAbs().maxCoeff(&main);
  if (report.softest[main] < 0.0) report.softest = -report.softest;
  return report;
}

RobotSurvey survey(const setup::Setup& source, const std::optional<TipReport>& as_it_stands) {
  if (!source.robot) throw core::InputError("the case has no robot; add [robot]");
  const auto own_tip = [&] { return as_it_stands ? *as_it_stands : report_at(source, {}); };
  RobotSurvey survey;
  if (!source.robot->workspace.empty()) {
    survey.over = "workspace";
    setup::Setup there = source;
    there.robot->workspace.clear();
    for (const Eigen::Vector3d& place : source.robot->workspace) {
      there.robot->posture.tip = place;
      add(there, place, survey);
    }
  } else if (source.path && source.path->robot_follows && source.part) {
    survey.over = "path";
    if (source.robot->model != "flexible_joints") {
      survey.tips.assign(source.path->positions.size(), own_tip());
      return survey;
    }
    for (std::size_t i = 0; i < source.path->positions.size(); ++i)
      add(setup::at_position(source, i), source.path->positions[i], survey);
  } else {
    survey.tips.push_back(own_tip());
  }
  return survey;
}

nlohmann::json posture_summary(const setup::RobotPosture& robot) {
  nlohmann::json result = nlohmann::json::object();
  if (robot.posture.preload != Eigen::Vector3d::Zero()) result["preload_n"] = robot.posture.preload;
  if (!robot.tip) return result;
  result["joints_rad"] = robot.posture.q;
  result["tip_m"] = *robot.tip;
  result["smallest_singular_value"] = *robot.smallest_singular;
  result["arm_m"] = nlohmann::json::array();
  for (const Eigen::Vector3d& joint : robot.arm) result["arm_m"].push_back(joint);
  return result;
}

std::string survey_text(const RobotSurvey& survey) {
  const TipReport& first = survey.tips.front();
  const auto joints = static_cast<std::size_t>(first.robot.posture.q.size());
  const std::size_t modes = std::min<std::size_t>(most_modes(survey), 4);
  std::string text = fmt::format("  {:>4}", "no.");
  if (first.robot.tip) text += fmt::format("  {:>24}", "tip x, y, z (mm)");
  if (joints > 0) text += fmt::format("  {:>{}}", "joints (deg)", 8 * joints);
  if (modes > 0) text += fmt::format("  {:>{}}", "modes (Hz)", 8 * modes);
  if (first.stiffness) text += fmt::format("  {:>24}  {:>8}  {}", "stiffness x, y, z (N/um)", "least", "along");
  text += '\n';
  for (std::size_t i = 0; i < survey.tips.size(); ++i) {
    const TipReport& tip = survey.tips[i];
    text += fmt::format("  {:>4}", i + 1);
    if (tip.robot.tip) text += "  " + three(*tip.robot.tip, 1e3, "{:>8.1f}");
    if (joints > 0) text += "  ";
    for (const double q : tip.robot.posture.q) text += fmt::format("{:>8.2f}", q * 180.0 / std::numbers::pi);
    if (modes > 0) text += "  ";
    for (std::size_t k = 0; k < modes; ++k)
      text += k < tip.modes.size() ? fmt::format("{:>8.2f}", tip.modes[k].frequency_hz) : fmt::format("{:>8}", "-");
    if (tip.stiffness) {
      text += "  " + three(*tip.stiffness, 1e-6, "{:>8.3g}") +
              fmt::format("  {:>8.3g}  ", *tip.least_stiffness * 1e-6) +
              fmt::format("({:.2f}, {:.2f}, {:.2f})", tip.softest.x(), tip.softest.y(), tip.softest.z());
    }
    if (tip.robot.smallest_singular && *tip.robot.smallest_singular < 1e-4) text += "  singular posture";
    text += '\n';
  }
  if (!survey.out_of_reach.empty()) {
    text += fmt::format("  {} of {} places are not reached; the first: {}\n", survey.out_of_reach.size(),
                        survey.out_of_reach.size() + survey.tips.size(), survey.out_of_reach.front().reason);
  }
  return text;
}

void write_survey(const std::filesystem::path& folder, const setup::Setup& source, const RobotSurvey& survey) {
  const std::filesystem::path below = folder / "robot";
  std::filesystem::remove_all(below);  // tables of an earlier survey
  std::filesystem::create_directories(below);
  write_out_of_reach(below, survey);
  if (survey.tips.empty()) return;
  const io::Table table = columns(survey);
  io::write_csv(below / "postures.csv", table, {"tip of the robot, part axes; stiffness: static, 1/H_nn(0)"});
  if (source.robot->model == "flexible_joints") write_arms(below / "postures.vtu", source.robot->arm, survey, table);
}

}  // namespace thinwall::study
