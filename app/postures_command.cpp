#include "app/postures_command.hpp"

#include "app/doctor.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/split.hpp"
#include "core/units.hpp"
#include "io/results/csv_table.hpp"
#include "report/postures/posture_files.hpp"
#include "report/postures/posture_text.hpp"
#include "report/publish.hpp"
#include "report/result_folder.hpp"

namespace thinwall::app {

namespace {

/// The quantity of an option, above 0.
double quantity(const std::string& text, const core::QuantityKind& kind, const std::string& option) {
  try {
    const double value = core::parse_quantity(text, kind);
    if (value > 0.0) return value;
  } catch (const core::InputError& error) {
    throw core::UsageError(option + " \"" + text + "\": " + error.what());
  }
  throw core::UsageError(option + " \"" + text + "\": must be above 0");
}

study::PostureQuestions questions_of(const std::string& parts) {
  try {
    return study::questions_on(core::split(parts, ','));
  } catch (const core::InputError& error) {
    throw core::UsageError("--parts: " + std::string(error.what()));
  }
}

/// The columns of robot.over of a table.
Eigen::MatrixXd places_of(const std::string& file, const std::vector<std::string>& over) {
  if (file.empty()) return {};
  const io::Table table = io::read_csv(file);
  Eigen::MatrixXd places;
  for (std::size_t c = 0; c < over.size(); ++c) {
    const std::vector<double>& values = io::numbers(table, over[c], file);
    if (c == 0) places.resize(std::ssize(values), std::ssize(over));
    for (std::size_t i = 0; i < values.size(); ++i)
      places(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = values[i];
  }
  if (places.rows() == 0) throw core::DataError(file + " has no place; give a line for each");
  return places;
}

const std::vector<std::string>& columns_of(const cases::Case& source) {
  static const std::vector<std::string> none;
  const setup::TabledRobot* robot = setup::tabled_robot(source.robot);
  return robot != nullptr && robot->postures ? robot->postures->over : none;
}

}  // namespace

study::PostureQuestions posture_questions(const PosturesRequest& request, const std::vector<std::string>& over) {
  study::PostureQuestions questions = questions_of(request.parts);
  questions.grid = request.grid;
  questions.folds = request.folds;
  questions.best_speed = request.speed == "best";
  if (!request.speed.empty() && !questions.best_speed)
    questions.spindle_speed_rpm = quantity(request.speed, core::kind::spindle_speed, "--speed");
  if (!request.split.empty()) questions.split_hz = quantity(request.split, core::kind::frequency, "--split");
  questions.path = places_of(request.path, over);
  questions.candidates = places_of(request.candidates, over);
  return questions;
}

std::string study_postures(const cases::Case& source, const PosturesRequest& request, const std::filesystem::path& out,
                           ProgressDisplay display) {
  const study::PostureQuestions questions = posture_questions(request, columns_of(source));
  report::ResultFolder folder(out.empty() ? report::default_result_folder(source.name) : out);
  log_to_file(folder.path() / "run.log");  // marks the folder as ours
  messages_to_log();
  StageDisplay stages(display);
  const study::PostureStudy found =
      report::unless_refused(folder, [&] { return study::study_postures(source, questions, stages.listener()); });
  const auto staging = core::partial_path(folder.path() / "postures");
  report::write_posture_study(staging, found, source.title, program_name());
  report::publish_folder(staging, folder.path() / "postures");
  return (source.title.empty() ? "" : source.title + "\n") + report::posture_text(report::summary_of(found)) +
         "  tables    " + (folder.path() / "postures").string() + "\n" + "  page      " +
         (folder.path() / "postures" / "postures.html").string() + "\n";
}

}  // namespace thinwall::app
