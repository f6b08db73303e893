#pragma once
// `thinwall postures`: a robot that is learned over its tapped postures, judged, mapped, and asked for the next one.

#include <filesystem>
#include <string>

#include "app/log.hpp"
#include "app/stage_display.hpp"
#include "case/machining_case.hpp"
#include "study/postures/posture_study.hpp"

namespace thinwall::app {

/// The words of the command.
struct PosturesRequest {
  std::string parts = "errors,curve,sharing,map,envelope,next";
  std::string speed;             ///< "9000 rpm", or best: of each place of the map; empty: the case's
  std::string split;             ///< "300 Hz"; empty: in the widest gap between the modes
  std::string path, candidates;  ///< CSV files with the columns of robot.over; empty: robot.at, the map's grid
  int grid = 5, folds = 5;
};

/// The questions of the words, for a robot over those columns. Throws UsageError for words that cannot be read,
/// DataError for files as io::read_csv().
[[nodiscard]] study::PostureQuestions posture_questions(const PosturesRequest& request,
                                                        const std::vector<std::string>& over);

/// Answers and writes the folder `postures` of the result folder (report::write_posture_study()). Returns the text for
/// the terminal. Throws UsageError as above, and as study::study_postures().
[[nodiscard]] std::string study_postures(const cases::Case& source, const PosturesRequest& request,
                                         const std::filesystem::path& out, ProgressDisplay display);

}  // namespace thinwall::app
