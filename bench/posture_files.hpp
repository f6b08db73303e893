#pragma once
// A robot's postures, modes and truth as files: the folder that bench/postures.cpp reads.

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "posture/arm_modes.hpp"
#include "posture/tapped_posture.hpp"

namespace thinwall::posture {

/// Rows of numbers by name of column; lines that begin with # are remarks, words are NaN.
struct Columns {
  std::map<std::string, std::size_t> column;
  std::vector<std::vector<double>> rows;

  [[nodiscard]] double at(std::size_t row, const std::string& name) const { return rows[row][column.at(name)]; }
};

inline Columns read_columns(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw core::DataError(file + ": cannot be read; name the folder with the robot's files");
  Columns result;
  for (std::string line, word; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::stringstream words(line);
    if (result.column.empty()) {
      for (std::size_t i = 0; std::getline(words, word, ','); ++i) result.column[word] = i;
      continue;
    }
    std::vector<double> row;
    while (std::getline(words, word, ',')) {
      char* end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      row.push_back(*end == '\0' ? value : std::nan(""));
    }
    result.rows.push_back(row);
  }
  return result;
}

/// Places of the postures over x, y and the table's angle.
inline std::vector<TappedPosture> read_postures(const std::string& file) {
  const Columns table = read_columns(file);
  std::vector<TappedPosture> postures;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    TappedPosture p;
    p.place.at = Eigen::Vector3d((table.at(i, "x_mm") - 1600.0) / 300.0, table.at(i, "y_mm") / 300.0,
                                 table.at(i, "kappa_deg") / 60.0);
    p.place.q = Eigen::VectorXd::Zero(8);
    for (int j = 1; j <= 6; ++j) p.place.q(1 + j) = table.at(i, "q" + std::to_string(j) + "_rad");
    postures.push_back(p);
  }
  return postures;
}

/// The vector of a mode at the named points.
inline Eigen::VectorXcd read_vector(const Columns& table, std::size_t row, const std::string& side,
                                    const std::vector<std::string>& points) {
  Eigen::VectorXcd v(static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k)
    v(static_cast<Eigen::Index>(k)) = {table.at(row, side + points[k] + "_re"),
                                       table.at(row, side + points[k] + "_im")};
  return v;
}

/// Adds the modes of a file to the postures; labels from 0 on, −1 for those that the file does not label.
inline void read_modes(const std::string& file, const std::string& label, const std::vector<std::string>& points,
                       std::vector<TappedPosture>& postures) {
  const Columns table = read_columns(file);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    identification::FittedMode mode;
    mode.frequency_hz = table.at(i, "frequency_hz");
    mode.damping_ratio = 0.01 * table.at(i, "damping_percent");
    mode.left = read_vector(table, i, "L_", points);
    mode.right = read_vector(table, i, "R_", points);
    mode.residue = mode.right * mode.left.transpose();
    TappedPosture& at = postures[static_cast<std::size_t>(table.at(i, "posture"))];
    at.modes.push_back(mode);
    at.label.push_back(static_cast<int>(table.at(i, label)) - 1);
  }
}

inline Eigen::Vector3d vector_of(const nlohmann::json& json) {
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

/// The arm as its maker knows it, with the tip along X and Y and a point `height_m` up the tool along X and Y.
inline TappedArm read_arm(const std::string& file, double height_m) {
  const nlohmann::json json = nlohmann::json::parse(std::ifstream(file));
  TappedArm tapped;
  for (const auto& row : json["links"]) {
    robot::Link link;
    link.name = row["name"];
    link.placement.translation() = vector_of(row["placement"]);
    link.axis = vector_of(row["axis"]);
    link.mass = row["mass"];
    link.centre = vector_of(row["centre"]);
    for (int i = 0; i < 3; ++i) link.inertia.row(i) = vector_of(row["inertia"][static_cast<std::size_t>(i)]);
    link.joint.stiffness = row["stiffness"];
    link.joint.damping = row["damping"];
    tapped.arm.links.push_back(link);
  }
  tapped.arm.tip.translation() = vector_of(json["tip_in_housing"]);
  tapped.responses = Eigen::MatrixXd::Zero(4, 6);
  tapped.responses(0, 0) = tapped.responses(1, 1) = tapped.responses(2, 0) = tapped.responses(3, 1) = 1.0;
  tapped.responses(2, 4) = height_m;
  tapped.responses(3, 3) = -height_m;
  tapped.references = tapped.responses;
  return tapped;
}

}  // namespace thinwall::posture
