#pragma once
// A robot that is learned over its tapped postures, judged, mapped, and asked for the posture to tap next.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "posture/band_envelope.hpp"
#include "posture/held_out.hpp"
#include "posture/learning_curve.hpp"
#include "posture/next_posture.hpp"
#include "posture/shared_tasks.hpp"
#include "posture/workspace_map.hpp"
#include "setup/machining_setup.hpp"
#include "study/stages.hpp"

namespace thinwall::study {

/// The words of the questions: members of PostureQuestions.
inline constexpr std::array<std::string_view, 6> posture_parts{"errors", "curve", "sharing", "map", "envelope", "next"};

/// The questions that are asked.
struct PostureQuestions {
  bool errors = true;    ///< how far off is what is learned, at postures that were held out?
  bool curve = true;     ///< do more postures pay, and how many does an arm as the mean save?
  bool sharing = true;   ///< does it pay to learn the numbers of a mode together?
  bool map = true;       ///< what does the robot do over its workspace?
  bool envelope = true;  ///< which modes limit the depth at the posture that is asked for?
  bool next = true;      ///< which posture is to be tapped next?
  int folds = 5;         ///< ≥ 2, of the postures that are held out
  int grid = 5;          ///< ≥ 2, places of the map along each column

  std::optional<double> spindle_speed_rpm{};  ///< of the depths; none: the case's, else the best of its chart
  bool best_speed = false;                    ///< the map has at each place the best speed of the chart
  Eigen::MatrixXd path{};            ///< places that matter, a row each, as robot.over has them; empty: robot.at
  Eigen::MatrixXd candidates{};      ///< places that could be tapped; empty: those of the map's grid
  std::optional<double> split_hz{};  ///< between the low and the high modes; none: in the widest gap
};

/// The questions of some of posture_parts. Throws InputError for another word.
[[nodiscard]] PostureQuestions questions_on(const std::vector<std::string>& parts);

/// The answers; what was not asked is empty. Places are as the columns of robot.over have them.
struct PostureStudy {
  std::vector<std::string> names;  ///< of the postures
  std::vector<std::string> over;   ///< the columns
  std::vector<std::string> dofs;   ///< of the tip: responses and forces
  Eigen::MatrixXd places;          ///< of the postures, a row each
  Eigen::RowVectorXd asked;        ///< robot.at
  std::vector<posture::TappedPosture> postures;
  std::optional<double> spindle_speed_rpm{};  ///< of depths; none: no cut by the robot
  std::optional<posture::HeldOut> held_out{};
  std::optional<posture::LearningCurves> curves{};
  std::vector<posture::SharedTasks> shared{};
  Eigen::MatrixXd mapped_at{};
  std::vector<posture::MappedPlace> map{};
  std::vector<double> chart_rpm{};
  std::optional<posture::BandEnvelope> envelope{};
  Eigen::MatrixXd candidates{}, path{};
  std::optional<posture::NextPosture> next{};
  std::vector<std::string> doubts{};  ///< sentences
  std::vector<std::string> notes{};
};

/// Learns the modes of `source.robot` over its postures (setup::posture_learning(), as `run` does), and answers. Depths
/// are those of a robot that carries the tool, with the tool's modes beside it and a rigid part; of a tool that is
/// swapped in at the robot's modes, those of the tip by each posture's modes. Throws InputError for
/// a set-up whose robot has no postures, for a measured tool, for places with another number of columns, and as
/// setup::read_posture_tables(), setup::posture_learning(), setup::place_at() and the functions of posture/. Cost: a
/// Predictor, one a fold and one a point of each curve; of the map, draws × places limiting depths.
[[nodiscard]] PostureStudy study_postures(const setup::Setup& source, const PostureQuestions& questions,
                                          const StageListener& listener = {});

}  // namespace thinwall::study
