#include "setup/identified/posture_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <map>

#include "core/error.hpp"
#include "core/units.hpp"
#include "identification/tracking.hpp"
#include "io/csv_text.hpp"
#include "io/frf/modal_table_csv.hpp"
#include "posture/hull.hpp"
#include "posture/predictor.hpp"

namespace thinwall::setup {

namespace {

constexpr std::string_view place_of_name = "{posture}";

std::size_t column_of(const io::CsvText& text, const std::string& name) {
  const auto found = std::ranges::find(text.header, name);
  if (found == text.header.end())
    throw core::DataError(text.path.string() + " has no column \"" + name + "\"; it has " +
                          fmt::format("{}", fmt::join(text.header, ", ")));
  return static_cast<std::size_t>(found - text.header.begin());
}

void read_list(const TappedPostures& postures, PostureTables& read) {
  const io::CsvText text = io::read_csv_text(postures.list);
  io::require_columns(text, text.header.size(), "those of the header");
  const std::size_t name = column_of(text, "posture");
  read.places.resize(std::ssize(text.lines), std::ssize(postures.over));
  for (std::size_t c = 0; c < postures.over.size(); ++c) {
    const std::size_t column = column_of(text, postures.over[c]);
    for (std::size_t i = 0; i < text.lines.size(); ++i)
      read.places(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = io::number(text, text.lines[i], column);
  }
  for (const io::CsvLine& line : text.lines) read.names.push_back(line.fields[name]);
}

void require_variation(const TappedPostures& postures, const Eigen::MatrixXd& places) {
  for (Eigen::Index c = 0; c < places.cols(); ++c) {
    if (!(places.col(c).maxCoeff() > places.col(c).minCoeff()))
      throw core::InputError("robot.over: \"" + postures.over[static_cast<std::size_t>(c)] +
                             "\" is the same at all postures of " + postures.list.string() + "; leave it out");
  }
}

/// The file of a posture's modes.
std::filesystem::path file_of(const std::filesystem::path& pattern, const std::string& posture) {
  std::string path = pattern.string();
  for (auto at = path.find(place_of_name); at != std::string::npos; at = path.find(place_of_name, at + posture.size()))
    path.replace(at, place_of_name.size(), posture);
  return path;
}

std::vector<std::string> names_of(const dynamics::DofTable& dofs) {
  std::vector<std::string> names;
  for (const dynamics::Dof& dof : dofs) names.push_back(dynamics::name(dof));
  return names;
}

void read_tables(const TabledRobot& robot, PostureTables& read) {
  const io::ModalTableFormat format{
      io::modal_unit(robot.left_unit), io::modal_unit(robot.right_unit), {{robot.table_point, {0.0}}}};
  for (const std::string& name : read.names) {
    read.files.push_back(file_of(robot.table, name));
    read.tables.push_back(io::read_modal_table(read.files.back(), format));
    const auto dofs = names_of(read.tables.back().dofs), first = names_of(read.tables.front().dofs);
    if (dofs != first)
      throw core::InputError(read.files.back().string() + " has " + fmt::format("{}", fmt::join(dofs, ", ")) + ", " +
                             read.files.front().string() + " has " + fmt::format("{}", fmt::join(first, ", ")) +
                             "; tap the same at every posture");
  }
}

/// Follows the modes by the shapes at all points, which tell them apart better than the tip's alone.
void follow_modes(PostureTables& read) {
  std::vector<std::vector<identification::FittedMode>> seen;
  for (std::size_t i = 0; i < read.tables.size(); ++i) seen.push_back(modes_of(read.tables[i], read.files[i].string()));
  const identification::Tracking tracking = identification::track(seen);
  read.labels = tracking.label;
  for (const std::vector<bool>& of : tracking.doubtful) read.doubtful += static_cast<int>(std::ranges::count(of, true));
}

/// The number of modes that are seen at too few postures to be learned.
int too_few(const PostureTables& read) {
  std::map<int, int> postures;
  for (const std::vector<int>& of : read.labels) {
    for (const int label : of) ++postures[label];
  }
  return static_cast<int>(std::ranges::count_if(postures, [](const auto& seen) {
    return seen.second < std::max(2, posture::PredictorOptions{}.fewest_postures);
  }));
}

void require_valid(const TabledRobot& robot) {
  if (!robot.postures) throw core::InputError("a robot without postures has nothing to learn; give robot.postures");
  if (robot.table.string().find(place_of_name) == std::string::npos)
    throw core::InputError("robot.table = \"" + robot.table.string() +
                           "\" names one file; with robot.postures it must have {posture} where the name of each "
                           "stands, as \"fits/{posture}/modal_table.csv\"");
  const std::size_t over = robot.postures->over.size(), at = robot.postures->at.size();
  if (over == 0 || over != at)
    throw core::InputError("robot.over has " + std::to_string(over) + " columns and robot.at " + std::to_string(at) +
                           " numbers; give a number for each column of " + robot.postures->list.string());
}

}  // namespace

PostureTables read_posture_tables(const TabledRobot& robot) {
  require_valid(robot);
  PostureTables read;
  read_list(*robot.postures, read);
  require_variation(*robot.postures, read.places);
  read_tables(robot, read);
  follow_modes(read);
  return read;
}

ScaledPlaces scaled_places(const PostureTables& read, const std::vector<double>& at) {
  ScaledPlaces scaled{read.places, Eigen::Map<const Eigen::VectorXd>(at.data(), std::ssize(at))};
  for (Eigen::Index c = 0; c < scaled.places.cols(); ++c) {
    const double low = scaled.places.col(c).minCoeff(), high = scaled.places.col(c).maxCoeff();
    scaled.places.col(c) = (scaled.places.col(c).array() - 0.5 * (low + high)) / (0.5 * (high - low));
    scaled.at(c) = (scaled.at(c) - 0.5 * (low + high)) / (0.5 * (high - low));
  }
  return scaled;
}

std::vector<std::string> doubts_about(const PostureTables& read, const std::vector<double>& at) {
  std::vector<std::string> doubts;
  if (read.doubtful > 0)
    doubts.push_back(std::to_string(read.doubtful) +
                     " modes could not be followed over the postures without contradiction; what is learned of them is "
                     "less certain than told: tap postures between");
  const ScaledPlaces scaled = scaled_places(read, at);
  if (const double distance = posture::distance_from_hull(scaled.places, scaled.at); distance > 1e-9)
    doubts.push_back("robot.at lies " + core::number_text(50.0 * distance, 2) +
                     " % of the postures' range beyond their hull, where nothing was tapped; tap one there");
  if (const int few = too_few(read); few > 0)
    doubts.push_back(std::to_string(few) +
                     " of the robot's modes were seen at too few postures to be learned, and their compliance is "
                     "missing; tap more postures");
  return doubts;
}

}  // namespace thinwall::setup
