#include "study/postures/posture_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"
#include "milling/direct/fitted_receptance.hpp"
#include "setup/identified/arm_mean.hpp"
#include "setup/identified/identify.hpp"
#include "setup/identified/learned_modes.hpp"
#include "setup/identified/posture_tables.hpp"
#include "setup/identified/table_modes.hpp"
#include "setup/milling_process.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/lobes/line_warnings.hpp"
#include "study/lobes/tool_swap.hpp"

namespace thinwall::study {

namespace {

constexpr double depth_tolerance = 1e-3;  // relative; bands are wider by far
constexpr int most_chart_speeds = 60;

/// The robot of a set-up with its files read.
setup::TabledRobot tapped_robot(const setup::Setup& source) {
  const setup::TabledRobot* tabled = setup::tabled_robot(source.robot);
  if (tabled == nullptr || !tabled->postures)
    throw core::InputError("the case has no robot that was tapped at several postures; give robot.postures");
  setup::TabledRobot robot = *tabled;
  if (!robot.tapped) robot.tapped = std::make_shared<const setup::PostureTables>(setup::read_posture_tables(robot));
  return robot;
}

/// The robot, and what is learned of it.
struct LearnedRobot {
  setup::TabledRobot robot;
  setup::PostureLearning learning;
  posture::Predictor predictor;
};

LearnedRobot learn(const setup::Setup& source, const setup::TabledRobot& robot) {
  setup::PostureLearning learning = setup::posture_learning(robot, setup::asked_joints(source, robot));
  posture::Predictor predictor(learning.postures, learning.options);
  return {robot, std::move(learning), std::move(predictor)};
}

/// Rows as the columns of robot.over have them, as places that the predictor takes.
std::vector<posture::Place> places_of(const LearnedRobot& learned, const Eigen::MatrixXd& rows) {
  const setup::TabledRobot& robot = learned.robot;
  if (rows.cols() != robot.tapped->places.cols())
    throw core::InputError(fmt::format("places with {} numbers, must have one for each of the {} columns of robot.over",
                                       rows.cols(), robot.tapped->places.cols()));
  std::vector<posture::Place> places;
  for (const auto& row : rows.rowwise())
    places.push_back(setup::place_at(robot, learned.learning, {row.begin(), row.end()}));
  return places;
}

Eigen::MatrixXd asked_place(const setup::TabledRobot& robot) {
  return Eigen::Map<const Eigen::RowVectorXd>(robot.postures->at.data(), std::ssize(robot.postures->at));
}

/// The even speeds of the chart; none without one.
std::vector<double> chart_speeds(const setup::Setup& source) {
  if (!source.lobes) return {};
  const int count = std::min(source.lobes->count, most_chart_speeds);
  const Eigen::VectorXd rpm = Eigen::VectorXd::LinSpaced(count, source.lobes->from_rpm, source.lobes->to_rpm);
  return {rpm.begin(), rpm.end()};
}

/// The cut of a robot that carries the tool, without a speed yet.
std::optional<posture::PostureCut> cut_of(const setup::Setup& source, const setup::TabledRobot& robot,
                                          std::vector<std::string>& notes) {
  if (!setup::carries_tool(source.robot) || !source.tool || !source.cutting) return std::nullopt;
  if ((setup::known_by_lines(*source.tool) && !setup::swapped_on_robot(*source.tool)) || setup::awaits_fit(source))
    throw core::InputError("the tool is known by lines, must have poles beside the robot's; give tool.modes");
  posture::PostureCut cut;
  cut.process = setup::milling_process(source);
  const dynamics::DofTable dofs = setup::learned_dofs(robot);
  cut.responses.resize(3, std::ssize(dofs));
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const bool moves = dofs[i].kind == dynamics::DofKind::translation;
    cut.responses.col(static_cast<Eigen::Index>(i)) =
        moves ? Eigen::Vector3d(robot.base.linear() * dofs[i].direction) : Eigen::Vector3d::Zero();
  }
  cut.references = cut.responses;
  cut.cross_terms = robot.cross_terms;
  cut.stability.depth_limit_m = source.lobes ? source.lobes->depth_limit : source.tool->length;
  cut.stability.error_tolerance = depth_tolerance;
  if (!setup::swapped_on_robot(*source.tool)) cut.beside = cut_poles(source, nullptr);
  if (source.part) notes.emplace_back("depths count the part as rigid; `run` has them with the part");
  return cut;
}

/// The poles of the tip with the tool that is swapped in, by the robot's modes with the tool that was tapped: on the
/// lines that those at robot.at have. What a run says of the swap there is said here, too.
void swap_tool(const setup::Setup& source, const setup::TabledRobot& robot, const posture::PosturePrediction& at,
               posture::PostureCut& cut) {
  const auto table_for_swap = [robot, swap = *source.tool->swap](const std::vector<identification::FittedMode>& modes) {
    return setup::modes_for_swap(robot, setup::table_of(modes, setup::learned_dofs(robot)), swap);
  };
  setup::CutSetup there = source;
  there.tool->swap->table = std::make_shared<const dynamics::ModalTable>(table_for_swap(posture::expected_modes(at)));
  const TipOfModes tip = tip_of_modes(there);
  const SwappedTip swapped = tip(*there.tool->swap->table);
  warn_of_swap(*there.tool, swapped);
  warn_of_growing_motion(milling::fitted(swapped.tip).growing, "the swapped tool's");
  cut.structure_by = [table_for_swap, tip](const std::vector<identification::FittedMode>& modes) {
    return milling::fitted_poles(tip(table_for_swap(modes)).tip);
  };
}

/// The speed of the depths: one that is asked for, the case's, else the best of the chart at robot.at.
double chosen_speed(const setup::Setup& source, const PostureQuestions& questions, posture::PostureCut cut,
                    const posture::PosturePrediction& at) {
  if (questions.spindle_speed_rpm) return *questions.spindle_speed_rpm;
  if (source.cutting->spindle_speed_rpm) return *source.cutting->spindle_speed_rpm;
  cut.spindle_speeds_rpm = chart_speeds(source);
  if (cut.spindle_speeds_rpm.empty())
    throw core::InputError("the depths have no speed; give cutting.spindle_speed, [lobes], or --speed");
  Eigen::Index best = 0;
  posture::limiting_depths(posture::expected_modes(at), cut, at.rest).maxCoeff(&best);
  return cut.spindle_speeds_rpm[static_cast<std::size_t>(best)];
}

/// Says what is learned, and what of it the answers do not know.
void tell_learning(const LearnedRobot& learned, const PostureQuestions& questions, PostureStudy& study) {
  study.notes.push_back(fmt::format("{} modes are learned from {} postures{}", learned.predictor.labels().size(),
                                    study.names.size(), learned.learning.note));
  if (!learned.learning.options.mean) return;
  if (questions.errors)
    study.notes.emplace_back("the arm was calibrated on all postures, those that are held out among them");
  if (questions.sharing)
    study.notes.emplace_back("numbers alone and together are compared by themselves, without the arm as their mean");
}

void answer_curve(const LearnedRobot& learned, const std::optional<posture::PostureCut>& cut, PostureStudy& study) {
  std::optional<posture::TappedArm> nominal;
  if (learned.robot.mean) nominal = setup::tapped_arm(learned.robot, setup::learned_dofs(learned.robot));
  study.curves = posture::learning_curves(study.postures, learned.learning.options, nominal, cut);
  if (!study.curves->plain.empty()) return;
  study.curves.reset();
  study.notes.emplace_back("a learning curve needs at least nine postures");
}

void answer_map(const LearnedRobot& learned, const PostureQuestions& questions, std::optional<posture::PostureCut> cut,
                PostureStudy& study) {
  if (cut && questions.best_speed && !study.chart_rpm.empty()) cut->spindle_speeds_rpm = study.chart_rpm;
  study.mapped_at = posture::grid_within_hull(study.places, questions.grid);
  study.map = posture::workspace_map(learned.predictor, places_of(learned, study.mapped_at), cut);
}

void answer_envelope(const posture::PosturePrediction& at, const PostureQuestions& questions, posture::PostureCut cut,
                     PostureStudy& study) {
  const auto modes = posture::expected_modes(at);
  const std::vector<double> hz = posture::split_among_hz(modes, cut);
  if (study.chart_rpm.empty() || hz.size() < 2) {
    study.notes.emplace_back("the envelope over low and high modes needs [lobes] and two modes");
    return;
  }
  cut.spindle_speeds_rpm = study.chart_rpm;
  study.envelope = posture::band_envelope(modes, cut, questions.split_hz.value_or(posture::widest_gap_hz(hz)), at.rest);
}

void answer_next(const LearnedRobot& learned, const PostureQuestions& questions,
                 const std::optional<posture::PostureCut>& cut, PostureStudy& study) {
  study.path = questions.path.size() > 0 ? questions.path : asked_place(learned.robot);
  study.candidates =
      questions.candidates.size() > 0 ? questions.candidates : posture::grid_within_hull(study.places, questions.grid);
  study.next = posture::next_posture(learned.predictor, places_of(learned, study.path),
                                     places_of(learned, study.candidates), cut);
}

}  // namespace

PostureQuestions questions_on(const std::vector<std::string>& parts) {
  PostureQuestions questions;
  const std::array<bool*, posture_parts.size()> asked{&questions.errors, &questions.curve,    &questions.sharing,
                                                      &questions.map,    &questions.envelope, &questions.next};
  for (bool* part : asked) *part = false;
  for (const std::string& part : parts) {
    const auto found = std::ranges::find(posture_parts, part);
    if (found == posture_parts.end())
      throw core::InputError(fmt::format("\"{}\" is no part; name some of {}", part, fmt::join(posture_parts, ",")));
    *asked.at(static_cast<std::size_t>(found - posture_parts.begin())) = true;
  }
  return questions;
}

PostureStudy study_postures(const setup::Setup& source, const PostureQuestions& questions,
                            const StageListener& listener) {
  Stages stages(listener);
  const setup::TabledRobot robot = tapped_robot(source);
  PostureStudy study{robot.tapped->names,  robot.postures->over, setup::names_of(setup::learned_dofs(robot)),
                     robot.tapped->places, asked_place(robot),   {}};
  study.doubts = setup::doubts_about(robot);
  study.chart_rpm = chart_speeds(source);
  std::optional<posture::PostureCut> cut = cut_of(source, robot, study.notes);
  stages.begin("learning");
  const LearnedRobot learned = learn(source, robot);
  const posture::PosturePrediction at = learned.predictor.predict(learned.learning.asked);
  study.postures = learned.learning.postures;
  tell_learning(learned, questions, study);
  if (cut) {
    if (setup::swapped_on_robot(*source.tool)) {
      swap_tool(source, robot, at, *cut);
      study.notes.emplace_back("depths are those of the tool that is swapped in");
    }
    study.spindle_speed_rpm = chosen_speed(source, questions, *cut, at);
    cut->spindle_speeds_rpm = {*study.spindle_speed_rpm};
  }
  const std::vector<int> fold =
      posture::folds_in_turn(study.names.size(), std::min<int>(questions.folds, static_cast<int>(study.names.size())));
  if (questions.errors) {
    stages.begin("errors");
    study.held_out = posture::held_out(study.postures, learned.learning.options, fold, cut);
  }
  if (questions.curve) {
    stages.begin("learning curve");
    answer_curve(learned, cut, study);
  }
  if (questions.sharing) {
    stages.begin("sharing");
    study.shared = posture::alone_and_together(study.postures, fold);
  }
  if (questions.map) {
    stages.begin("map");
    answer_map(learned, questions, cut, study);
  }
  if (questions.envelope && cut) answer_envelope(at, questions, *cut, study);
  if (questions.next) {
    stages.begin("next posture");
    answer_next(learned, questions, cut, study);
  }
  stages.end();
  return study;
}

}  // namespace thinwall::study
