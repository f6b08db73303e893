#include "report/fit_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/error.hpp"
#include "identification/fitted_model.hpp"
#include "io/frf/response_csv.hpp"
#include "io/frf/uff_shapes.hpp"
#include "io/json_file.hpp"
#include "io/results/csv_table.hpp"
#include "report/model_files.hpp"

namespace thinwall::report {

namespace {

using identification::FittedMode;
using nlohmann::json;

constexpr double two_sided = 1.959964;  // 95 % of a normal distribution

struct Interval {
  double low = 0.0, high = 0.0;
};

Interval interval(double value, double sd_ln) {
  return {value * std::exp(-two_sided * sd_ln), value * std::exp(two_sided * sd_ln)};
}

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
  io::Table table{{"frequency_hz", hz},    {"frequency_low_hz", hz_low},    {"frequency_high_hz", hz_high},
                  {"damping_ratio", zeta}, {"damping_ratio_low", zeta_low}, {"damping_ratio_high", zeta_high}};
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

json matrix_json(const Eigen::MatrixXd& values) {
  json rows = json::array();
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    json row = json::array();
    for (Eigen::Index j = 0; j < values.cols(); ++j) row.push_back(values(i, j));
    rows.push_back(row);
  }
  return rows;
}

json mode_json(const FittedMode& mode, const std::optional<identification::PointMode>& point) {
  const Interval f = interval(mode.frequency_hz, mode.sd_ln_frequency),
                 z = interval(mode.damping_ratio, mode.sd_ln_damping);
  json entry{{"frequency_hz", mode.frequency_hz},
             {"frequency_95_hz", {f.low, f.high}},
             {"damping_ratio", mode.damping_ratio},
             {"damping_ratio_95", {z.low, z.high}},
             {"second_singular", mode.second_singular},
             {"residue_re", matrix_json(mode.residue.real())},
             {"residue_im", matrix_json(mode.residue.imag())}};
  if (point) {
    entry["mass_kg"] = point->mass_kg;
    entry["stiffness_n_m"] = point->stiffness_N_m;
    entry["direction"] = std::vector<double>(point->direction.begin(), point->direction.end());
  }
  return entry;
}

/// |aᴴb|²/(aᴴa bᴴb) of the residues as vectors.
json mac_json(const std::vector<FittedMode>& modes) {
  Eigen::MatrixXd mac(static_cast<Eigen::Index>(modes.size()), static_cast<Eigen::Index>(modes.size()));
  for (Eigen::Index i = 0; i < mac.rows(); ++i) {
    for (Eigen::Index j = 0; j < mac.cols(); ++j) {
      const Eigen::MatrixXcd &a = modes[static_cast<std::size_t>(i)].residue,
                             &b = modes[static_cast<std::size_t>(j)].residue;
      mac(i, j) = std::norm(a.reshaped().dot(b.reshaped())) / (a.squaredNorm() * b.squaredNorm());
    }
  }
  return matrix_json(mac);
}

json fit_json(const FitReport& found) {
  const identification::ModalFit& fit = found.fit.found.fit;
  const auto points = identification::point_modes(fit, found.measured.responses, found.measured.forces);
  json document{
      {"modes", json::array()},
      {"chi2_per_dof", fit.chi2_per_dof()},
      {"converged", fit.converged},
      {"weights", core::word_of(found.fit.weights)},
      {"terms", {{"inertia", found.fit.found.terms.inertia}, {"highest_power", found.fit.found.terms.highest_power}}},
      {"lines",
       {{"count", found.fit.lines.lines()},
        {"from_hz", found.fit.lines.hz(0)},
        {"to_hz", found.fit.lines.hz(found.fit.lines.lines() - 1)}}},
      {"misfit", matrix_json(found.fit.misfit)},
      {"mac", mac_json(fit.modes)},
      {"warnings", found.doubts}};
  for (std::size_t r = 0; r < fit.modes.size(); ++r) document["modes"].push_back(mode_json(fit.modes[r], points[r]));
  for (const auto& [key, dofs] :
       {std::pair{"responses", &found.measured.responses}, {"forces", &found.measured.forces}}) {
    document[key] = json::array();
    for (const dynamics::Dof& dof : *dofs) document[key].push_back(dynamics::name(dof));
  }
  return document;
}

std::string terms_text(const identification::ResidualTerms& terms) {
  std::string text = terms.inertia ? "LR/s^2" : "";
  for (int power = 0; power <= terms.highest_power; ++power)
    text += fmt::format("{}c{}{}", text.empty() ? "" : ", ", power,
                        power == 0   ? ""
                        : power == 1 ? " s"
                                     : fmt::format(" s^{}", power));
  return text.empty() ? "none" : text;
}

std::string mode_line(std::size_t number, const FittedMode& mode,
                      const std::optional<identification::PointMode>& point) {
  std::string line = fmt::format("  {:>4}  {:>10.5g} ± {:<8.2g}  {:>8.4g} ± {:<8.2g}", number, mode.frequency_hz,
                                 two_sided * mode.sd_ln_frequency * mode.frequency_hz, 100.0 * mode.damping_ratio,
                                 100.0 * two_sided * mode.sd_ln_damping * mode.damping_ratio);
  line += point ? fmt::format("  {:>9.4g}  {:>9.4g}", point->mass_kg, point->stiffness_N_m * 1e-6)
                : fmt::format("  {:>9}  {:>9}", "-", "-");
  return line + fmt::format("  {:>7.2g}\n", mode.second_singular);
}

}  // namespace

std::string fit_text(const FitReport& found) {
  const identification::ModalFit& fit = found.fit.found.fit;
  const identification::MeasuredLines& lines = found.fit.lines;
  const auto points = identification::point_modes(fit, found.measured.responses, found.measured.forces);
  std::string text = fmt::format("{} x {} receptances, {} lines from {:.6g} to {:.6g} Hz, weighed by {}\n",
                                 lines.responses(), lines.references(), lines.lines(), lines.hz(0),
                                 lines.hz(lines.lines() - 1), core::word_of(found.fit.weights));
  text += fmt::format("  {:>4}  {:>21}  {:>19}  {:>9}  {:>9}  {:>7}\n", "mode", "frequency (Hz, 95 %)",
                      "damping (%, 95 %)", "mass (kg)", "k (N/um)", "s2/s1");
  for (std::size_t r = 0; r < fit.modes.size(); ++r) text += mode_line(r + 1, fit.modes[r], points[r]);
  text += fmt::format("  chi2        {:.3g} a degree of freedom; 1 where model and weights are right\n",
                      fit.chi2_per_dof());
  text += fmt::format("  terms       {}\n", terms_text(found.fit.found.terms));
  text += fmt::format("  misfit      {:.2g} % of the entry that is worst\n", 100.0 * found.fit.misfit.maxCoeff());
  for (const std::string& doubt : found.doubts) text += "  warning     " + doubt + "\n";
  for (const std::string& note : found.notes) text += "  note        " + note + "\n";
  return text;
}

std::vector<std::string> write_fit(const std::filesystem::path& folder, const FitReport& found) {
  constexpr double told_share = 0.02;
  make_model_folder(folder);
  const identification::ModalFit& fit = found.fit.found.fit;
  std::vector<std::string> left_out;
  write_modes(folder / "modes.csv", found);
  io::write_json(folder / "fit.json", fit_json(found));
  io::write_response(
      folder / "fitted.csv",
      identification::fitted_response(fit, {found.fit.lines.hz}, found.measured.responses, found.measured.forces));
  const auto write = [&](const char* name, const auto& write_table) {
    try {
      write_table(folder / name, identification::modal_table(fit, found.measured.responses, found.measured.forces));
    } catch (const core::InputError& error) {
      std::filesystem::remove(folder / name);  // of an earlier fit
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

}  // namespace thinwall::report
