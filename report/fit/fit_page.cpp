#include "report/fit/fit_page.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>

#include "core/dense_factorisations.hpp"
#include "identification/fitted_model.hpp"
#include "report/fit/fit_json.hpp"
#include "report/page/agreement.hpp"
#include "report/page/arrays.hpp"
#include "report/page/thinned_lines.hpp"

namespace thinwall::report {

namespace {

using nlohmann::json;
using Lines = std::vector<std::size_t>;

/// The numbers of the lines of `measured` that the fit used.
Lines used_lines(const FitReport& found) {
  Lines used;
  Eigen::Index line = 0;
  for (const double hz : found.fit.lines.hz) {
    while (found.measured.axis.hz(line) < hz) ++line;
    used.push_back(static_cast<std::size_t>(line));
  }
  return used;
}

json names_of(const dynamics::DofTable& dofs) {
  json names = json::array();
  for (const dynamics::Dof& dof : dofs) names.push_back(dynamics::name(dof));
  return names;
}

json packed_response(const std::vector<Eigen::MatrixXcd>& H, const Lines& lines) {
  const auto rows = static_cast<std::size_t>(H.front().rows()), columns = static_cast<std::size_t>(H.front().cols());
  std::vector<float> values;
  for (Eigen::Index i = 0; i < H.front().rows(); ++i) {
    for (Eigen::Index j = 0; j < H.front().cols(); ++j) {
      for (const std::size_t line : lines) {
        values.push_back(for_picture(H[line](i, j).real()));
        values.push_back(for_picture(H[line](i, j).imag()));
      }
    }
  }
  return packed(values, {rows, columns, lines.size(), 2});
}

/// FRAC and error of each entry, over all lines.
json packed_agreement(const std::vector<Eigen::MatrixXcd>& H, const std::vector<Eigen::MatrixXcd>& fitted) {
  const Eigen::Index rows = H.front().rows(), columns = H.front().cols(), lines = std::ssize(H);
  std::vector<double> values;
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) {
      Eigen::VectorXcd of_measured(lines), of_fit(lines);
      for (Eigen::Index line = 0; line < lines; ++line) {
        of_measured(line) = H[static_cast<std::size_t>(line)](i, j);
        of_fit(line) = fitted[static_cast<std::size_t>(line)](i, j);
      }
      const auto agreement = agreement_of(of_measured, of_fit).value_or(Agreement{0.0, 1.0});
      values.push_back(agreement.frac);
      values.push_back(agreement.error);
    }
  }
  return packed(values, {static_cast<std::size_t>(rows), static_cast<std::size_t>(columns), 2});
}

json packed_coherence(const FitReport& found, const Lines& used, const Lines& lines) {
  const Eigen::MatrixXd& first = found.coherence.front();
  std::vector<float> values;
  for (Eigen::Index i = 0; i < first.rows(); ++i) {
    for (Eigen::Index j = 0; j < first.cols(); ++j) {
      for (const std::size_t line : lines) values.push_back(for_picture(found.coherence[used[line]](i, j)));
    }
  }
  return packed(values, {static_cast<std::size_t>(first.rows()), static_cast<std::size_t>(first.cols()), lines.size()});
}

/// Measured and fitted receptances on the lines of the fit.
json frf_of(const FitReport& found) {
  constexpr double most_values = 250000.0;  // a value and its fit take some 16 bytes
  const identification::MeasuredLines& of_fit = found.fit.lines;
  const dynamics::ResponseModel measured{{of_fit.hz}, found.measured.responses, found.measured.forces, of_fit.H};
  const dynamics::ResponseModel fitted = identification::fitted_response(
      found.fit.found.fit, measured.axis, found.measured.responses, found.measured.forces);
  const auto most = static_cast<std::size_t>(most_values / static_cast<double>(of_fit.H.front().size()));
  const Lines lines = thinned_lines({&measured}, std::max<std::size_t>(most, 200));
  std::vector<double> hz;
  for (const std::size_t line : lines) hz.push_back(of_fit.hz(static_cast<Eigen::Index>(line)));
  json frf = {{"name", "measured"},
              {"responses", names_of(measured.responses)},
              {"forces", names_of(measured.forces)},
              {"hz", packed(hz, {hz.size()})},
              {"H", packed_response(measured.H, lines)},
              {"synthesised", packed_response(fitted.H, lines)},
              {"agreement", packed_agreement(measured.H, fitted.H)}};
  if (!found.coherence.empty()) frf["coherence"] = packed_coherence(found, used_lines(found), lines);
  if (lines.size() < measured.H.size()) frf["thinned"] = {{"from", measured.H.size()}, {"to", lines.size()}};
  return frf;
}

json diagram_of(const std::vector<identification::OrderPoles>& orders) {
  const auto stability = identification::stabilisation(orders);
  std::vector<std::uint32_t> order, agrees;
  std::vector<float> hz, damping;
  for (std::size_t i = 0; i < orders.size(); ++i) {
    for (std::size_t k = 0; k < orders[i].poles.size(); ++k) {
      const std::complex<double> pole = orders[i].poles[k].pole;
      const identification::Stability& stable = stability[i][k];
      order.push_back(static_cast<std::uint32_t>(orders[i].order));
      hz.push_back(for_picture(std::abs(pole) / (2.0 * std::numbers::pi), 22));
      damping.push_back(for_picture(-pole.real() / std::abs(pole)));
      agrees.push_back((stable.frequency ? 1U : 0U) | (stable.damping ? 2U : 0U) | (stable.participation ? 4U : 0U));
    }
  }
  const std::vector<std::size_t> shape{order.size()};
  return {{"order", packed(order, shape)},
          {"hz", packed(hz, shape)},
          {"damping", packed(damping, shape)},
          {"agrees", packed(agrees, shape)}};
}

json mac_of(const std::vector<identification::FittedMode>& modes) {
  const Eigen::MatrixXd mac = mac_of_residues(modes);
  std::vector<double> hz;
  hz.reserve(modes.size());
  for (const identification::FittedMode& mode : modes) hz.push_back(mode.frequency_hz);
  std::vector<float> values;
  for (const double value : mac.reshaped()) values.push_back(for_picture(value));  // symmetric
  return {{"values", packed(values, {hz.size(), hz.size()})}, {"row_hz", hz}, {"column_hz", hz}};
}

/// The motion of a mode at the responses, or at the forces where these are more (a hammer that roves): by the first
/// singular vector of the residue.
std::pair<const dynamics::DofTable*, Eigen::VectorXcd> motion_of(const FitReport& found,
                                                                 const identification::FittedMode& mode) {
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(mode.residue, Eigen::ComputeThinU | Eigen::ComputeThinV);
  if (mode.residue.rows() >= mode.residue.cols()) return {&found.measured.responses, svd.matrixU().col(0)};
  return {&found.measured.forces, svd.matrixV().col(0).conjugate()};
}

/// The vector turned by the phase that makes its squares sum to a positive number: real where the mode is.
Eigen::VectorXcd most_real(const Eigen::VectorXcd& vector) {
  const std::complex<double> sum = vector.array().square().sum();
  if (std::abs(sum) == 0.0) return vector;
  return vector / std::sqrt(sum / std::abs(sum));
}

json motion_json(const FitReport& found, const identification::FittedMode& mode,
                 const std::vector<std::string>& points) {
  const auto [dofs, vector] = motion_of(found, mode);
  const Eigen::VectorXcd motion = most_real(vector);
  json shape = json::array();
  for (const std::string& point : points) {
    Eigen::Vector3cd u = Eigen::Vector3cd::Zero();
    for (std::size_t d = 0; d < dofs->size(); ++d) {
      const dynamics::Dof& dof = (*dofs)[d];
      if (dof.point == point && dof.kind == dynamics::DofKind::translation)
        u += motion(static_cast<Eigen::Index>(d)) * dof.direction.cast<std::complex<double>>();
    }
    shape.push_back({u(0).real(), u(0).imag(), u(1).real(), u(1).imag(), u(2).real(), u(2).imag()});
  }
  return shape;
}

/// Null where fewer than two points have a place.
json shapes_json(const FitReport& found) {
  const bool by_response = found.measured.responses.size() >= found.measured.forces.size();
  std::vector<std::string> points;
  json places = json::array();
  for (const dynamics::Dof& dof : by_response ? found.measured.responses : found.measured.forces) {
    const auto place = found.geometry.position.find(dof.point);
    if (place == found.geometry.position.end() || std::ranges::find(points, dof.point) != points.end()) continue;
    points.push_back(dof.point);
    places.push_back({{"name", dof.point}, {"position_m", {place->second(0), place->second(1), place->second(2)}}});
  }
  if (points.size() < 2) return nullptr;
  json lines = json::array(), modes = json::array();
  for (const auto& [from, to] : found.geometry.lines) {
    const auto a = std::ranges::find(points, from), b = std::ranges::find(points, to);
    if (a != points.end() && b != points.end()) lines.push_back({a - points.begin(), b - points.begin()});
  }
  for (const identification::FittedMode& mode : found.fit.found.fit.modes)
    modes.push_back({{"hz", mode.frequency_hz}, {"shape", motion_json(found, mode, points)}});
  return {{"points", places}, {"lines", lines}, {"modes", modes}};
}

/// Names of the files of the command, without their folders.
std::string title_of(const FitReport& found) {
  std::string title = "Fit of " + std::to_string(found.measured.responses.size()) + " x " +
                      std::to_string(found.measured.forces.size()) + " receptances";
  for (const std::string& file : found.sources)
    title += (&file == &found.sources.front() ? ": " : ", ") + std::filesystem::path(file).filename().string();
  return title;
}

}  // namespace

json fit_document(const FitReport& found, const std::string& program) {
  const std::vector<identification::StablePole> stable = identification::stable_poles(found.diagram);
  json fit = {{"figures", fit_json(found)},
              {"notes", found.notes},
              {"frf", frf_of(found)},
              {"command", found.command},
              {"mac", mac_of(found.fit.found.fit.modes)},
              {"stable", json::array()}};
  for (const identification::StablePole& pole : stable)
    fit["stable"].push_back({{"hz", std::abs(pole.pole) / (2.0 * std::numbers::pi)},
                             {"damping", -pole.pole.real() / std::abs(pole.pole)},
                             {"orders", pole.orders}});
  if (!found.diagram.empty()) fit["diagram"] = diagram_of(found.diagram);
  if (json shapes = shapes_json(found); !shapes.is_null()) fit["shapes"] = std::move(shapes);
  return {{"schema", 1}, {"program", program}, {"title", title_of(found)}, {"runs", json::array()}, {"fit", fit}};
}

}  // namespace thinwall::report
