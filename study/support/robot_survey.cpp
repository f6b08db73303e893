#include "study/support/robot_survey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"
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

TipReport report_at(const setup::PartSetup& part, const setup::SupportSetup& support,
                    const std::optional<Eigen::VectorXd>& near) {
  const setup::RobotPosture robot = setup::robot_posture(part, support, near);
  const bool measured = std::holds_alternative<setup::MeasuredRobot>(support.robot->model);
  const dynamics::FrequencyAxis one_line{Eigen::VectorXd::Ones(1)};  // modes and stiffness need no more
  return tip_report(
      robot,
      robot_component(*support.robot, measured ? frequency_axis(part.response, {}, support) : one_line, robot.posture));
}

/// Adds the robot at that place, or why it cannot stand so.
void add(const setup::PartSetup& part, const setup::SupportSetup& support, const Eigen::Vector3d& place,
         RobotSurvey& survey) {
  std::optional<Eigen::VectorXd> near;
  if (!survey.tips.empty()) near = survey.tips.back().robot.posture.q;
  try {
    survey.tips.push_back(report_at(part, support, near));
  } catch (const core::InputError& error) {
    survey.out_of_reach.push_back({place, error.what()});
  }
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

SurveyInput survey_input(const setup::Setup& source) {
  SurveyInput input{source, source, {}};
  if (source.path && source.path->robot_follows) input.followed = setup::stations(source);
  return input;
}

RobotSurvey survey(const SurveyInput& input, const std::optional<TipReport>& as_it_stands) {
  if (!input.support.robot) throw core::InputError("the case has no robot; add [robot]");
  const auto* robot = std::get_if<setup::JointedRobot>(&input.support.robot->model);
  const auto own_tip = [&] { return as_it_stands ? *as_it_stands : report_at(input.part, input.support, {}); };
  RobotSurvey survey;
  if (robot != nullptr && !robot->workspace.empty()) {
    survey.over = SurveyPlaces::workspace;
    setup::SupportSetup there = input.support;
    for (const Eigen::Vector3d& place : robot->workspace) {
      std::get<setup::JointedRobot>(there.robot->model).posture.tip = place;
      add(input.part, there, place, survey);
    }
  } else if (!input.followed.empty()) {
    survey.over = SurveyPlaces::path;
    if (robot == nullptr) {
      survey.tips.assign(input.followed.size(), own_tip());
      return survey;
    }
    for (const setup::PathStation& station : input.followed)
      add(setup::part_at(input.part, station), setup::support_at(input.support, station),
          *station.points.front().position, survey);
  } else {
    survey.tips.push_back(own_tip());
  }
  return survey;
}

}  // namespace thinwall::study
