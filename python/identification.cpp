// Bindings of identification: modes from measured receptances.

#include <iterator>
#include <numbers>

#include "core/error.hpp"
#include "identification/fit_response.hpp"
#include "identification/fitted_model.hpp"
#include "python/bindings.hpp"

namespace thinwall::python {

namespace {

using identification::FittedMode;
using identification::ResponseFit;

/// The coherence of lines × responses × forces as a matrix a line.
std::vector<Eigen::MatrixXd> matrices_of(const py::array_t<double, py::array::c_style | py::array::forcecast>& values,
                                         const dynamics::ResponseModel& response) {
  const auto rows = static_cast<Eigen::Index>(response.responses.size()),
             columns = static_cast<Eigen::Index>(response.forces.size());
  if (values.ndim() != 3 || values.shape(0) != response.axis.size() || values.shape(1) != rows ||
      values.shape(2) != columns)
    throw core::InputError("coherence is of another shape than the receptances; give lines x responses x forces");
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::vector<Eigen::MatrixXd> lines;
  for (Eigen::Index i = 0; i < response.axis.size(); ++i)
    lines.emplace_back(Eigen::Map<const RowMajor>(values.data() + i * rows * columns, rows, columns));
  return lines;
}

identification::ResponseFitOptions options_of(const std::string& residues, const std::optional<std::string>& terms,
                                              const std::optional<std::vector<double>>& band) {
  identification::ResponseFitOptions options;
  const auto form = core::from_word<identification::Residues>(residues);
  if (!form) throw core::InputError("residues are \"free\", \"rank_one\" or \"symmetric\", not \"" + residues + "\"");
  options.identify.residues = *form;
  if (terms) options.identify.terms = identification::terms_named(*terms);
  if (band && band->size() != 2) throw core::InputError("band_hz is a pair of frequencies, the lowest and the highest");
  if (band) options.band = {band->front(), band->back()};
  return options;
}

/// A number of each mode.
template <typename Of>
Eigen::VectorXd of_modes(const ResponseFit& fit, const Of& of) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(fit.found.fit.modes.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) values(i) = of(fit.found.fit.modes[static_cast<std::size_t>(i)]);
  return values;
}

py::object model_of(const ResponseFit& fit, const dynamics::ResponseModel& response) {
  if (identification::common_dofs(response.responses, response.forces).response.empty()) return py::none();
  return py::cast(identification::modal_model(fit.found.fit, response.responses, response.forces));
}

/// The stabilisation diagram as columns.
py::dict diagram_of(const std::vector<identification::OrderPoles>& orders) {
  const auto stability = identification::stabilisation(orders);
  std::vector<double> order, hz, damping;
  std::vector<bool> stable;
  for (std::size_t i = 0; i < orders.size(); ++i) {
    for (std::size_t k = 0; k < orders[i].poles.size(); ++k) {
      const std::complex<double> pole = orders[i].poles[k].pole;
      order.push_back(orders[i].order);
      hz.push_back(std::abs(pole) / (2.0 * std::numbers::pi));
      damping.push_back(-pole.real() / std::abs(pole));
      stable.push_back(stability[i][k].all());
    }
  }
  const auto column = [](const std::vector<double>& values) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values)));
  };
  py::dict result;
  result["order"] = column(order);
  result["frequency_hz"] = column(hz);
  result["damping_ratio"] = column(damping);
  result["stable"] = py::array(py::cast(stable));
  return result;
}

py::dict fit_as_dict(const ResponseFit& fit, const dynamics::ResponseModel& response,
                     const std::vector<std::string>& warnings) {
  py::dict result;
  result["frequency_hz"] = of_modes(fit, [](const FittedMode& mode) { return mode.frequency_hz; });
  result["damping_ratio"] = of_modes(fit, [](const FittedMode& mode) { return mode.damping_ratio; });
  result["frequency_sd_hz"] = of_modes(fit, [](const FittedMode& m) { return m.sd_ln_frequency * m.frequency_hz; });
  result["damping_ratio_sd"] = of_modes(fit, [](const FittedMode& m) { return m.sd_ln_damping * m.damping_ratio; });
  result["second_singular"] = of_modes(fit, [](const FittedMode& mode) { return mode.second_singular; });
  py::list residues;
  for (const FittedMode& mode : fit.found.fit.modes) residues.append(mode.residue);
  result["residues"] = residues;
  result["chi2_per_dof"] = fit.found.fit.chi2_per_dof();
  result["misfit"] = fit.misfit;
  result["warnings"] = warnings;
  result["model"] = model_of(fit, response);
  result["fitted"] =
      identification::fitted_response(fit.found.fit, {fit.lines.hz}, response.responses, response.forces);
  return result;
}

py::dict fit_modes(const dynamics::ResponseModel& response, const std::string& residues,
                   const std::optional<std::string>& terms, const std::optional<std::vector<double>>& band_hz,
                   std::optional<double> noise,
                   const std::optional<py::array_t<double, py::array::c_style | py::array::forcecast>>& coherence,
                   std::optional<int> averages, const std::optional<std::vector<double>>& poles_hz, int order) {
  identification::ResponseFitOptions options = options_of(residues, terms, band_hz);
  if (noise) options.noise = Eigen::MatrixXd::Constant(1, 1, *noise);
  if (averages) options.averages = Eigen::MatrixXd::Constant(1, 1, *averages);
  const std::vector<Eigen::MatrixXd> of_lines =
      coherence ? matrices_of(*coherence, response) : std::vector<Eigen::MatrixXd>();
  options.identify.highest_order = order;
  ResponseFit fit;
  std::vector<identification::OrderPoles> diagram;
  std::vector<std::string> warnings;
  {
    const LongCall call;
    if (poles_hz) {
      diagram = identification::stabilisation_diagram(response, options);
      options.identify.poles = identification::poles_near(*poles_hz, identification::stable_poles(diagram));
    }
    fit = identification::fit_response(response, of_lines, options);
    warnings = identification::doubts_about(fit, response.responses, response.forces, options);
  }
  py::dict result = fit_as_dict(fit, response, warnings);
  result["diagram"] = diagram_of(poles_hz ? diagram : fit.found.diagram);
  return result;
}

}  // namespace

void bind_identification(py::module_& module) {
  module.def(
      "fit_modes", fit_modes, "response"_a, py::kw_only(), "residues"_a = "rank_one", "terms"_a = py::none(),
      "band_hz"_a = py::none(), "noise"_a = py::none(), "coherence"_a = py::none(), "averages"_a = py::none(),
      "poles_hz"_a = py::none(), "order"_a = 30,
      "The modes of measured receptances, found without a guess: a dict of frequency_hz, damping_ratio and their\n"
      "standard deviations, residues in m/(N s), chi2_per_dof, misfit by entry, warnings, fitted (a Response),\n"
      "model (a ModalModel; None without a driving point), and diagram: order, frequency_hz, damping_ratio and\n"
      "stable of the poles of the orders up to `order`. poles_hz names frequencies in place of the diagram's.\n"
      "residues: \"free\", \"rank_one\" or \"symmetric\". terms beside the modes: \"none\", \"constant\", or the\n"
      "highest power of s, \"0\" to \"6\"; as needed if not given. Lines are weighed by their noise (of real and\n"
      "imaginary part, relative), by coherence (lines x responses x forces) and averages, or by their scatter.");
}

}  // namespace thinwall::python
