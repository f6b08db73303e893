#include "setup/identified/posture_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>

#include "core/units.hpp"
#include "identification/tracking.hpp"
#include "io/csv_text.hpp"
#include "posture/arm_modes.hpp"
#include "posture/hull.hpp"
#include "posture/mode_targets.hpp"
#include "posture/predictor.hpp"
#include "setup/identified/arm_mean.hpp"

namespace thinwall::setup {

namespace {

constexpr std::string_view place_of_name = "{posture}";

[[noreturn]] void refuse(const char* key, const std::string& what) {
  throw TabledRobotError(key, core::InputError(what));
}

/// Calls `read`, whose errors are those of the key.
template <class Read>
auto read_for(const char* key, const Read& read) {
  try {
    return read();
  } catch (const core::Interrupted&) {
    throw;
  } catch (const TabledRobotError&) {
    throw;
  } catch (const core::Error& error) {
    throw TabledRobotError(key, error);
  }
}

void require_keys(const TabledRobot& robot) {
  if (!robot.postures) refuse("postures", "a robot without postures has nothing to learn; give robot.postures");
  if (robot.table.string().find(place_of_name) == std::string::npos)
    refuse("table", "robot.table = \"" + robot.table.string() +
                        "\" names one file; with robot.postures it must have {posture} where the name of each stands, "
                        "as \"fits/{posture}/modal_table.csv\"");
  const std::size_t over = robot.postures->over.size(), at = robot.postures->at.size();
  if (over == 0)
    refuse("over", "no column is named; name those of " + robot.postures->list.string() + " over which is learned");
  if (over != at)
    refuse("at", "has " + std::to_string(at) + " numbers for the " + std::to_string(over) +
                     " columns of robot.over; give one for each");
}

std::size_t column_of(const io::CsvText& text, const std::string& name, const char* key) {
  const auto found = std::ranges::find(text.header, name);
  if (found == text.header.end())
    refuse(key, text.path.string() + " has no column \"" + name + "\"; it has " +
                    fmt::format("{}", fmt::join(text.header, ", ")));
  return static_cast<std::size_t>(found - text.header.begin());
}

/// A name is that of one posture, for it names a file.
void require_names(const io::CsvText& text, const std::vector<std::string>& names) {
  std::map<std::string, int> line_of;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto [first, is_new] = line_of.try_emplace(names[i], text.lines[i].number);
    if (!is_new)
      refuse("postures", io::location(text, text.lines[i]) + ": posture \"" + names[i] + "\" stands in line " +
                             std::to_string(first->second) + ", too; give each a name of its own");
  }
}

/// Each column varies, and no two postures are at one place.
void require_places(const TappedPostures& postures, const PostureTables& read) {
  for (Eigen::Index c = 0; c < read.places.cols(); ++c) {
    if (!(read.places.col(c).maxCoeff() > read.places.col(c).minCoeff()))
      refuse("over", "\"" + postures.over[static_cast<std::size_t>(c)] + "\" is the same at all postures of " +
                         postures.list.string() + "; leave it out");
  }
  for (Eigen::Index i = 0; i < read.places.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      if (read.places.row(i) == read.places.row(j))
        refuse("postures", "\"" + read.names[static_cast<std::size_t>(j)] + "\" and \"" +
                               read.names[static_cast<std::size_t>(i)] + "\" are at one place of " +
                               fmt::format("{}", fmt::join(postures.over, ", ")) +
                               "; average their tables or leave one out");
    }
  }
}

/// The joints of the arm that is the mean; "0" stands for one that does not move.
Eigen::MatrixXd read_joints(const io::CsvText& text, const std::vector<std::string>& columns) {
  Eigen::MatrixXd joints = Eigen::MatrixXd::Zero(std::ssize(text.lines), std::ssize(columns));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c] == "0") continue;
    const std::size_t column = column_of(text, columns[c], "joint_columns");
    for (std::size_t i = 0; i < text.lines.size(); ++i)
      joints(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = io::number(text, text.lines[i], column);
  }
  return joints;
}

void read_list(const TabledRobot& robot, PostureTables& read) {
  const TappedPostures& postures = *robot.postures;
  const io::CsvText text = io::read_csv_text(postures.list);
  io::require_columns(text, text.header.size(), "those of the header");
  const std::size_t name = column_of(text, "posture", "postures");
  for (const io::CsvLine& line : text.lines) read.names.push_back(line.fields[name]);
  require_names(text, read.names);
  read.places.resize(std::ssize(text.lines), std::ssize(postures.over));
  for (std::size_t c = 0; c < postures.over.size(); ++c) {
    const std::size_t column = column_of(text, postures.over[c], "over");
    for (std::size_t i = 0; i < text.lines.size(); ++i)
      read.places(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = io::number(text, text.lines[i], column);
  }
  require_places(postures, read);
  if (robot.mean) read.joints = read_joints(text, robot.joint_columns);
}

/// The file of a posture's modes.
std::filesystem::path table_of(const std::filesystem::path& pattern, const std::string& posture) {
  std::string path = pattern.string();
  for (auto at = path.find(place_of_name); at != std::string::npos; at = path.find(place_of_name, at + posture.size()))
    path.replace(at, place_of_name.size(), posture);
  return path;
}

void read_tables(const TabledRobot& robot, PostureTables& read) {
  for (const std::string& name : read.names) {
    read.files.push_back(table_of(robot.table, name));
    TipTable tip = read_tip_table(read.files.back(), robot);
    if (tip.condition > read.freed_condition) read.freed_worst = name;
    read.freed_condition = std::max(read.freed_condition, tip.condition);
    read.tables.push_back(std::move(tip.table));
    const auto dofs = names_of(read.tables.back().dofs), first = names_of(read.tables.front().dofs);
    if (dofs != first)
      refuse("table", read.files.back().string() + " has " + fmt::format("{}", fmt::join(dofs, ", ")) + ", " +
                          read.files.front().string() + " has " + fmt::format("{}", fmt::join(first, ", ")) +
                          "; tap the same at every posture");
  }
}

/// The turn of the vectors at all points of a table into the tip's frame, for an arm that stands at q.
posture::Turn turn_of_table(const TabledRobot& robot, const dynamics::DofTable& dofs, const Eigen::VectorXd& q) {
  posture::Turn turn{Eigen::MatrixXd::Zero(std::ssize(dofs), std::ssize(dofs)), {}};
  for (const dynamics::Dof& dof : dofs) {
    const std::vector<int> rows = dynamics::rows_of_point(dofs, dof.point);
    dynamics::DofTable of_point;
    for (const int row : rows) of_point.push_back(dofs[static_cast<std::size_t>(row)]);
    turn.responses(rows, rows) = posture::tip_turn(tapped_arm(robot, of_point), q).responses;
  }
  turn.references = turn.responses;
  return turn;
}

using ModesOfPostures = std::vector<std::vector<identification::FittedMode>>;

/// The modes in the tip's frame, in which those of a spindle hardly change; empty without an arm that tells it, and
/// where the tip tilts out of the directions that were tapped.
ModesOfPostures in_tip_frame(const TabledRobot& robot, const PostureTables& read, const ModesOfPostures& seen) {
  if (!robot.mean || read.joints.cols() != robot.mean->arm.joints()) return {};
  ModesOfPostures turned(seen.size());
  try {
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const posture::Turn turn =
          turn_of_table(robot, read.tables[i].dofs, read.joints.row(static_cast<Eigen::Index>(i)).transpose());
      for (const identification::FittedMode& mode : seen[i]) turned[i].push_back(posture::turned(mode, turn));
    }
  } catch (const core::InputError&) {
    return {};
  }
  return turned;
}

/// Follows the modes by the shapes at all points, which tell them apart better than the tip's alone.
void follow_modes(const TabledRobot& robot, PostureTables& read) {
  ModesOfPostures seen;
  for (std::size_t i = 0; i < read.tables.size(); ++i) seen.push_back(modes_of(read.tables[i], read.files[i].string()));
  const identification::Tracking tracking = identification::track(seen, in_tip_frame(robot, read, seen), read.places);
  read.labels = tracking.label;
  for (const std::vector<bool>& of : tracking.doubtful) read.doubtful += static_cast<int>(std::ranges::count(of, true));
}

/// The number of modes that are seen at enough postures to be learned, and of those that are not.
struct LearnedCount {
  int enough = 0, too_few = 0;
};

LearnedCount count_of(const PostureTables& read) {
  std::map<int, int> postures;
  for (const std::vector<int>& of : read.labels) {
    for (const int label : of) ++postures[label];
  }
  LearnedCount count;
  for (const auto& [label, seen] : postures)
    ++(seen < std::max(2, posture::PredictorOptions{}.fewest_postures) ? count.too_few : count.enough);
  return count;
}

}  // namespace

PostureTables read_posture_tables(const TabledRobot& robot) {
  require_keys(robot);
  PostureTables read;
  read_for("postures", [&] { read_list(robot, read); });
  read_for("table", [&] { read_tables(robot, read); });
  read_for("table", [&] { follow_modes(robot, read); });
  if (count_of(read).enough == 0)
    refuse("postures", "no mode was seen at enough of the " + std::to_string(read.names.size()) + " postures of " +
                           robot.postures->list.string() + " to be learned; tap more");
  return read;
}

ScaledPlaces scaled_places(const TabledRobot& robot) {
  const std::vector<double>& at = robot.postures->at;
  ScaledPlaces scaled{robot.tapped->places, Eigen::Map<const Eigen::VectorXd>(at.data(), std::ssize(at))};
  for (Eigen::Index c = 0; c < scaled.places.cols(); ++c) {
    const double low = scaled.places.col(c).minCoeff(), high = scaled.places.col(c).maxCoeff();
    scaled.places.col(c) = (scaled.places.col(c).array() - 0.5 * (low + high)) / (0.5 * (high - low));
    scaled.at(c) = (scaled.at(c) - 0.5 * (low + high)) / (0.5 * (high - low));
  }
  return scaled;
}

std::vector<posture::TappedPosture> tapped_postures(const TabledRobot& robot) {
  const PostureTables& read = *robot.tapped;
  const Eigen::MatrixXd places = scaled_places(robot).places;
  std::vector<posture::TappedPosture> postures;
  for (std::size_t i = 0; i < read.tables.size(); ++i)
    postures.push_back({{places.row(static_cast<Eigen::Index>(i)).transpose(), {}, {}},
                        modes_of(used_part(robot, read.tables[i]), read.files[i].string()),
                        read.labels[i],
                        {}});
  return postures;
}

dynamics::DofTable learned_dofs(const TabledRobot& robot) {
  return used_part(robot, robot.tapped->tables.front()).dofs;
}

std::vector<std::string> names_of(const dynamics::DofTable& dofs) {
  std::vector<std::string> names;
  for (const dynamics::Dof& dof : dofs) names.push_back(dynamics::name(dof));
  return names;
}

std::vector<std::string> doubts_about(const TabledRobot& robot) {
  std::vector<std::string> doubts;
  if (!robot.postures || !robot.tapped) return doubts;
  if (robot.tapped->doubtful > 0)
    doubts.push_back(std::to_string(robot.tapped->doubtful) +
                     " modes could not be followed over the postures without contradiction; what is learned of them is "
                     "less certain than told: tap postures between");
  if (std::string doubt =
          doubt_about_sensors(robot.tapped->freed_condition, "at posture \"" + robot.tapped->freed_worst + "\"");
      !doubt.empty())
    doubts.push_back(std::move(doubt));
  const ScaledPlaces scaled = scaled_places(robot);
  if (const double distance = posture::distance_from_hull(scaled.places, scaled.at); distance > 1e-9)
    doubts.push_back("robot.at lies " + core::number_text(50.0 * distance, 2) +
                     " % of the postures' range beyond their hull, where nothing was tapped; tap one there");
  if (const int too_few = count_of(*robot.tapped).too_few; too_few > 0)
    doubts.push_back(std::to_string(too_few) +
                     " of the robot's modes were seen at too few postures to be learned, and their compliance is "
                     "missing; tap more postures");
  return doubts;
}

TabledRobot as_first_posture(TabledRobot robot) {
  if (robot.tapped && !robot.table_modes)
    robot.table_modes = std::make_shared<const dynamics::ModalTable>(robot.tapped->tables.front());
  return robot;
}

}  // namespace thinwall::setup
