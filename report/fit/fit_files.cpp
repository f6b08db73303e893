#include "report/fit/fit_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "identification/fitted_model.hpp"
#include "io/frf/response_csv.hpp"
#include "io/frf/uff_shapes.hpp"
#include "io/json_file.hpp"
#include "io/results/csv_table.hpp"
#include "report/fit/fit_json.hpp"
#include "report/fit/fit_page.hpp"
#include "report/folder_lock.hpp"
#include "report/model_files.hpp"
#include "report/page/page.hpp"
#include "report/publish.hpp"

namespace thinwall::report {

namespace {

using identification::FittedMode;

/// The point at which all DOFs with both roles are, as translations; empty if there are several, or none.
std::string single_point(const FitReport& found) {
  const auto common = identification::common_dofs(found.measured.responses, found.measured.forces);
  std::string point;
  for (const int i : common.response) {
    const dynamics::Dof& dof = found.measured.responses[static_cast<std::size_t>(i)];
    if (dof.kind != dynamics::DofKind::translation || (!point.empty() && dof.point != point)) return "";
    point = dof.point;
  }
  return point;
}

/// The lines of modes at a point in space, of DOFs along any directions.
Eigen::Vector3d direction_in_space(const FitReport& found, const Eigen::VectorXd& over_common) {
  const auto common = identification::common_dofs(found.measured.responses, found.measured.forces);
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < common.response.size(); ++i)
    direction += over_common(static_cast<Eigen::Index>(i)) *
                 found.measured.responses[static_cast<std::size_t>(common.response[i])].direction;
  return direction.normalized();
}

void write_modes(const std::filesystem::path& file, const FitReport& found) {
  std::vector<double> hz, hz_low, hz_high, zeta, zeta_low, zeta_high, stiffness;
  std::array<std::vector<double>, 3> direction;
  const auto points = identification::point_modes(found.fit.found.fit, found.measured.responses, found.measured.forces);
  const bool single =
      !single_point(found).empty() && std::ranges::all_of(points, [](const auto& p) { return p.has_value(); });
  for (std::size_t r = 0; r < points.size(); ++r) {
    const FittedMode& mode = found.fit.found.fit.modes[r];
    const Interval f = interval(mode.frequency_hz, mode.sd_ln_frequency),
                   z = interval(mode.damping_ratio, mode.sd_ln_damping);
    hz.push_back(mode.frequency_hz);
    hz_low.push_back(f.low);
    hz_high.push_back(f.high);
    zeta.push_back(mode.damping_ratio);
    zeta_low.push_back(z.low);
    zeta_high.push_back(z.high);
    if (!single) continue;
    stiffness.push_back(points[r]->stiffness_N_m);
    const Eigen::Vector3d along = direction_in_space(found, points[r]->direction);
    for (std::size_t i = 0; i < 3; ++i) direction.at(i).push_back(along(static_cast<Eigen::Index>(i)));
  }
  io::Table table{
      {"frequency_hz", hz},    {"frequency_low_hz", hz_low, true},    {"frequency_high_hz", hz_high, true},
      {"damping_ratio", zeta}, {"damping_ratio_low", zeta_low, true}, {"damping_ratio_high", zeta_high, true}};
  if (single) {
    table.push_back({"stiffness", stiffness});
    table.push_back({"direction_x", direction[0]});
    table.push_back({"direction_y", direction[1]});
    table.push_back({"direction_z", direction[2]});
  }
  io::write_csv(file, table,
                {"modes of a fit; low and high bound 95 %; stiffness in N/m, as a mode of the point alone"});
}

/// The name of a DOF in a table of modes, "1X"; empty of one that has none there.
std::string column_name(const dynamics::Dof& dof) {
  if (dof.kind != dynamics::DofKind::translation) return "";
  for (const char* letter : {"x", "y", "z"}) {
    if (dof.direction == dynamics::axis(letter)) return dof.point + static_cast<char>(letter[0] - 'x' + 'X');
  }
  return "";
}

/// The receptance of the modes of modes.csv at the driving points: Σ d dᵀ/(k (1 − r² + 2iζr)), r = f/f_k.
Eigen::MatrixXcd of_point_modes(const FitReport& found,
                                const std::vector<std::optional<identification::PointMode>>& points, double hz) {
  const Eigen::Index n = points.front()->direction.size();
  Eigen::MatrixXcd H = Eigen::MatrixXcd::Zero(n, n);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const FittedMode& mode = found.fit.found.fit.modes[k];
    const double r = hz / mode.frequency_hz;
    const std::complex<double> stiffness =
        points[k]->stiffness_N_m * std::complex<double>(1.0 - r * r, 2.0 * mode.damping_ratio * r);
    H += points[k]->direction * points[k]->direction.transpose() / stiffness;
  }
  return H;
}

/// The median over the lines of the share of the fit that the modes of modes.csv leave out at the driving points.
double share_left_out(const FitReport& found, const std::vector<std::optional<identification::PointMode>>& points) {
  const auto common = identification::common_dofs(found.measured.responses, found.measured.forces);
  const dynamics::ResponseModel fitted = identification::fitted_response(
      found.fit.found.fit, {found.fit.lines.hz}, found.measured.responses, found.measured.forces);
  std::vector<double> shares;
  for (std::size_t i = 0; i < fitted.H.size(); ++i) {
    const Eigen::MatrixXcd there = fitted.H[i](common.response, common.reference);
    const double hz = found.fit.lines.hz(static_cast<Eigen::Index>(i));
    shares.push_back((of_point_modes(found, points, hz) - there).norm() / there.norm());
  }
  const auto middle = shares.begin() + std::ssize(shares) / 2;
  std::ranges::nth_element(shares, middle);
  return *middle;
}

void write_modal_table(const std::filesystem::path& file, const dynamics::ModalTable& modes) {
  std::vector<std::string> names;
  std::vector<double> hz, zeta;
  for (const dynamics::ModalTableRow& row : modes.rows) {
    names.push_back("mode " + row.mode);
    hz.push_back(row.frequency_hz);
    zeta.push_back(row.damping_ratio);
  }
  io::Table table{{"mode", names}, {"frequency_hz", hz}, {"damping_ratio", zeta}};
  for (std::size_t d = 0; d < modes.dofs.size(); ++d) {
    const std::string name = column_name(modes.dofs[d]);
    if (name.empty())
      throw core::InputError(dynamics::name(modes.dofs[d]) +
                             " is not a motion along x, y or z, which a table of modes has");
    for (const bool left : {true, false}) {
      std::vector<double> re, im;
      for (const dynamics::ModalTableRow& row : modes.rows) {
        const std::complex<double> value = (left ? row.left : row.right)(static_cast<Eigen::Index>(d));
        re.push_back(value.real());
        im.push_back(value.imag());
      }
      const std::string start = (left ? "L_" : "R_") + name;
      table.push_back({start + "_re", re});
      table.push_back({start + "_im", im});
    }
  }
  io::write_csv(file, table, {"left and right vectors in sqrt(s/kg): H = sum R L / (s - lambda) and its conjugate"});
}

/// Labels of points as nodes: the number of "node 12", others counted on from the largest.
std::map<std::string, long> labels_of(const dynamics::DofTable& dofs) {
  std::map<std::string, long> labels;
  long largest = 0;
  for (const dynamics::Dof& dof : dofs) {
    if (!dof.point.starts_with("node ")) continue;
    labels[dof.point] = std::strtol(dof.point.c_str() + 5, nullptr, 10);
    largest = std::max(largest, labels[dof.point]);
  }
  for (const dynamics::Dof& dof : dofs) {
    if (!labels.contains(dof.point)) labels[dof.point] = ++largest;
  }
  return labels;
}

void write_shapes(const std::filesystem::path& file, const dynamics::ModalTable& modes) {
  const std::map<std::string, long> labels = labels_of(modes.dofs);
  std::vector<io::UffShape> shapes;
  for (const dynamics::ModalTableRow& row : modes.rows) {
    io::UffShape shape;
    shape.number = static_cast<int>(shapes.size()) + 1;
    shape.is_complex = true;
    shape.frequency_hz = row.frequency_hz;
    shape.damping_ratio = row.damping_ratio;
    const double omega = 2.0 * std::numbers::pi * row.frequency_hz, zeta = row.damping_ratio;
    shape.pole = {-zeta * omega, omega * std::sqrt(1.0 - zeta * zeta)};
    shape.modal_a = 1.0;
    shape.displacement = Eigen::MatrixXcd::Zero(static_cast<Eigen::Index>(labels.size()), 6);
    for (const auto& [point, label] : labels) {
      const auto at = static_cast<Eigen::Index>(shape.nodes.size());
      shape.nodes.push_back(label);
      for (std::size_t d = 0; d < modes.dofs.size(); ++d) {
        const dynamics::Dof& dof = modes.dofs[d];
        if (dof.point != point) continue;
        shape.displacement.row(at).segment(dof.kind == dynamics::DofKind::rotation ? 3 : 0, 3) +=
            row.right(static_cast<Eigen::Index>(d)) * dof.direction.transpose().cast<std::complex<double>>();
      }
    }
    if (shape.displacement.rightCols(3).isZero(0.0)) shape.displacement = shape.displacement.leftCols(3).eval();
    shapes.push_back(std::move(shape));
  }
  io::write_uff_shapes(file, shapes);
}

/// The tables and the page, each as far as it can be written; what could not, and what they leave out.
std::vector<std::string> write_into(const std::filesystem::path& folder, const FitReport& found,
                                    const std::string& program) {
  constexpr double told_share = 0.02;
  const identification::ModalFit& fit = found.fit.found.fit;
  std::vector<std::string> left_out;
  write_modes(folder / "modes.csv", found);
  io::write_json(folder / "fit.json", fit_json(found));
  io::write_response(
      folder / "fitted.csv",
      identification::fitted_response(fit, {found.fit.lines.hz}, found.measured.responses, found.measured.forces));
  core::write_file_atomically(folder / "fit.html", page(fit_document(found, program)));
  const auto write = [&](const char* name, const auto& write_table) {
    try {
      write_table(folder / name, identification::modal_table(fit, found.measured.responses, found.measured.forces));
    } catch (const core::InputError& error) {
      left_out.push_back(std::string(name) + " is not written: " + error.what());
    }
  };
  const auto points = identification::point_modes(fit, found.measured.responses, found.measured.forces);
  if (!single_point(found).empty() && std::ranges::all_of(points, [](const auto& p) { return p.has_value(); })) {
    if (const double share = share_left_out(found, points); share > told_share)
      left_out.push_back(fmt::format(
          "the modes of modes.csv leave out {:.2g} % of the fit on half of the lines, and so do lobes from it: terms "
          "beside the modes (--terms constant has fewer) or second shapes of a pole (modal_table.csv has them)",
          100.0 * share));
  }
  write("modal_table.csv", write_modal_table);
  write("modes.uff", write_shapes);
  return left_out;
}

/// Removes what a killed fit left in the folder; its lock keeps this from the files of one that still writes.
void remove_leftovers(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> left;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (core::is_partial_name(entry.path())) left.push_back(entry.path());
  }
  for (const std::filesystem::path& path : left) std::filesystem::remove_all(path);
}

}  // namespace

std::vector<std::string> write_fit(const std::filesystem::path& folder, const FitReport& found,
                                   const std::string& program) {
  make_model_folder(folder);
  const std::optional<FolderLock> lock = FolderLock::of(folder);
  if (lock) remove_leftovers(folder);
  const std::filesystem::path staging = core::partial_path(folder / "fit");
  std::filesystem::create_directory(staging);
  try {
    std::vector<std::string> left_out = write_into(staging, found, program);
    publish_files(staging, folder, {fit_file_names.begin(), fit_file_names.end()});
    return left_out;
  } catch (...) {
    std::error_code error;
    std::filesystem::remove_all(staging, error);
    throw;
  }
}

}  // namespace thinwall::report
