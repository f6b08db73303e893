#include "setup/identified/learned_modes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"
#include "identification/fitted_model.hpp"
#include "identification/tracking.hpp"
#include "io/csv_text.hpp"
#include "io/frf/modal_table_csv.hpp"
#include "posture/bands.hpp"
#include "posture/predictor.hpp"
#include "robot/modal_table.hpp"

namespace thinwall::setup {

namespace {

constexpr std::string_view place_of_name = "{posture}";

/// The list of postures: names, and the columns over which is learned.
struct PostureList {
  std::vector<std::string> names;
  Eigen::MatrixXd places;  ///< a row a posture
};

std::size_t column_of(const io::CsvText& text, const std::string& name) {
  const auto found = std::ranges::find(text.header, name);
  if (found == text.header.end())
    throw core::DataError(text.path.string() + " has no column \"" + name + "\"; it has " +
                          fmt::format("{}", fmt::join(text.header, ", ")));
  return static_cast<std::size_t>(found - text.header.begin());
}

PostureList read_list(const TappedPostures& postures) {
  const io::CsvText text = io::read_csv_text(postures.list);
  io::require_columns(text, text.header.size(), "those of the header");
  const std::size_t name = column_of(text, "posture");
  PostureList list;
  list.places.resize(std::ssize(text.lines), std::ssize(postures.over));
  for (std::size_t c = 0; c < postures.over.size(); ++c) {
    const std::size_t column = column_of(text, postures.over[c]);
    for (std::size_t i = 0; i < text.lines.size(); ++i)
      list.places(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = io::number(text, text.lines[i], column);
  }
  for (const io::CsvLine& line : text.lines) list.names.push_back(line.fields[name]);
  return list;
}

/// Scales each column of `places`, and `at` with them, to −1 … 1 over the postures.
void scale(const TappedPostures& postures, Eigen::MatrixXd& places, Eigen::VectorXd& at) {
  for (Eigen::Index c = 0; c < places.cols(); ++c) {
    const double low = places.col(c).minCoeff(), high = places.col(c).maxCoeff();
    if (!(high > low))
      throw core::InputError("robot.over: \"" + postures.over[static_cast<std::size_t>(c)] +
                             "\" is the same at all postures of " + postures.list.string() + "; leave it out");
    places.col(c) = (places.col(c).array() - 0.5 * (low + high)) / (0.5 * (high - low));
    at(c) = (at(c) - 0.5 * (low + high)) / (0.5 * (high - low));
  }
}

/// The file of a posture's modes.
std::filesystem::path table_of(const std::filesystem::path& pattern, const std::string& posture) {
  std::string path = pattern.string();
  for (auto at = path.find(place_of_name); at != std::string::npos; at = path.find(place_of_name, at + posture.size()))
    path.replace(at, place_of_name.size(), posture);
  return path;
}

/// A row of a table as an identification would give it.
identification::FittedMode mode_of(const dynamics::ModalTableRow& row) {
  identification::FittedMode mode;
  mode.frequency_hz = row.frequency_hz;
  mode.damping_ratio = row.damping_ratio;
  mode.residue = row.right * row.left.transpose();
  Eigen::Index largest = 0;
  row.left.cwiseAbs().maxCoeff(&largest);
  const std::complex<double> scale = row.left(largest);
  mode.left = row.left / scale;
  mode.right = row.right * scale;
  return mode;
}

std::vector<std::string> names_of(const dynamics::DofTable& dofs) {
  std::vector<std::string> names;
  for (const dynamics::Dof& dof : dofs) names.push_back(dynamics::name(dof));
  return names;
}

/// The tables of all postures.
std::vector<dynamics::ModalTable> read_tables(const TabledRobot& robot, const std::vector<std::string>& names,
                                              std::vector<std::filesystem::path>& files) {
  const io::ModalTableFormat format{
      io::modal_unit(robot.left_unit), io::modal_unit(robot.right_unit), {{robot.table_point, {0.0}}}};
  std::vector<dynamics::ModalTable> tables;
  for (const std::string& name : names) {
    files.push_back(table_of(robot.table, name));
    tables.push_back(io::read_modal_table(files.back(), format));
    if (names_of(tables.back().dofs) != names_of(tables.front().dofs))
      throw core::InputError(
          files.back().string() + " has " + fmt::format("{}", fmt::join(names_of(tables.back().dofs), ", ")) + ", " +
          files.front().string() + " has " + fmt::format("{}", fmt::join(names_of(tables.front().dofs), ", ")) +
          "; tap the same at every posture");
  }
  return tables;
}

/// "0.021 to 0.34 %" of a number of all modes, relative.
std::string span(const std::vector<posture::PredictedMode>& modes, Eigen::Index number) {
  const auto [least, largest] = std::ranges::minmax_element(
      modes, {}, [number](const posture::PredictedMode& mode) { return mode.deviation(number); });
  return core::number_text(100.0 * least->deviation(number), 2) + " to " +
         core::number_text(100.0 * largest->deviation(number), 2) + " %";
}

std::vector<identification::FittedMode> modes_of(const dynamics::ModalTable& table, const std::string& file) {
  std::vector<identification::FittedMode> modes;
  for (const dynamics::ModalTableRow& row : table.rows) {
    if (row.left.isZero(0.0) || row.right.isZero(0.0))
      throw core::DataError(file + ": the mode at " + core::number_text(row.frequency_hz, 5) +
                            " Hz has a vector of zeros, which moves nothing; remove its line");
    modes.push_back(mode_of(row));
  }
  return modes;
}

/// The postures as the predictor takes them: the modes are followed by the shapes at all points, which tell them apart
/// better than the tip's alone, and learned at the tip.
std::vector<posture::TappedPosture> tapped(const Eigen::MatrixXd& places,
                                           const std::vector<dynamics::ModalTable>& tables,
                                           const std::vector<std::filesystem::path>& files, const std::string& tip,
                                           std::vector<std::string>& doubts) {
  std::vector<std::vector<identification::FittedMode>> seen;
  for (std::size_t i = 0; i < tables.size(); ++i) seen.push_back(modes_of(tables[i], files[i].string()));
  const identification::Tracking tracking = identification::track(seen);
  std::ptrdiff_t doubtful = 0;
  for (const std::vector<bool>& of : tracking.doubtful) doubtful += std::ranges::count(of, true);
  if (doubtful > 0)
    doubts.push_back(std::to_string(doubtful) +
                     " modes could not be followed over the postures without contradiction; what is learned of them is "
                     "less certain than told: tap postures between");
  std::vector<posture::TappedPosture> postures;
  for (std::size_t i = 0; i < seen.size(); ++i)
    postures.push_back({{places.row(static_cast<Eigen::Index>(i)).transpose(), {}, {}},
                        modes_of(robot::at_point(tables[i], tip), files[i].string()),
                        tracking.label[i],
                        {}});
  return postures;
}

void doubt_prediction(const posture::Predictor& predictor, const posture::PosturePrediction& at,
                      std::vector<std::string>& doubts) {
  if (at.from_hull > 1e-9)
    doubts.push_back("robot.at lies " + core::number_text(50.0 * at.from_hull, 2) +
                     " % of the postures' range beyond their hull, where nothing was tapped; tap one there");
  if (!predictor.left_out().empty())
    doubts.push_back(std::to_string(predictor.left_out().size()) +
                     " of the robot's modes were seen at too few postures to be learned, and their compliance is "
                     "missing; tap more postures");
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

LearnedModes learned_modes(const TabledRobot& robot) {
  require_valid(robot);
  const TappedPostures& postures = *robot.postures;
  PostureList list = read_list(postures);
  Eigen::VectorXd at = Eigen::Map<const Eigen::VectorXd>(postures.at.data(), std::ssize(postures.at));
  scale(postures, list.places, at);
  LearnedModes result;
  const auto tables = read_tables(robot, list.names, result.learned.files);
  std::vector<std::string>& doubts = result.learned.doubts;
  const posture::Predictor predictor(tapped(list.places, tables, result.learned.files, robot.table_point, doubts), {});
  const posture::PosturePrediction there = predictor.predict({at, {}, {}});
  if (there.modes.empty())
    throw core::InputError("no mode was seen at enough of the " + std::to_string(list.names.size()) + " postures of " +
                           postures.list.string() + " to be learned; tap more");
  doubt_prediction(predictor, there, doubts);
  identification::ModalFit expected;
  expected.modes = posture::expected_modes(there);
  for (identification::FittedMode& mode : expected.modes)
    mode.right = mode.left = {};  // all of the residue, if of more
  const dynamics::DofTable dofs = robot::at_point(tables.front(), robot.table_point).dofs;
  result.table = identification::modal_table(expected, dofs, dofs);
  const auto places = Eigen::VectorXd::Zero(std::ssize(result.table.dofs));
  for (dynamics::ModalTableRow& row : result.table.rows) row.place_m = places;
  result.learned.summary = "the robot's modes are learned from " + std::to_string(list.names.size()) +
                           " postures: frequencies within " + span(there.modes, 0) + ", damping ratios within " +
                           span(there.modes, 1) + " (one standard deviation), which the error of charts leaves out";
  return result;
}

}  // namespace thinwall::setup
