// Bindings of milling: the cut, and the depths and speeds at which it is stable.

#include <algorithm>
#include <iterator>
#include <variant>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "dynamics/conversion.hpp"
#include "milling/chart/lobes.hpp"
#include "milling/chart/refined_lobes.hpp"
#include "milling/chart/sampled_stability.hpp"
#include "milling/chart/stability_map.hpp"
#include "python/bindings.hpp"
#include "python/cut_structure.hpp"

namespace thinwall::python {

std::string point_of(const dynamics::DofTable& dofs, const std::optional<std::string>& at) {
  if (at) return *at;
  std::vector<std::string> points;
  for (const auto& dof : dofs)
    if (dof.kind == dynamics::DofKind::translation && std::ranges::find(points, dof.point) == points.end())
      points.push_back(dof.point);
  if (points.size() == 1) return points.front();
  throw core::InputError("say at which point the cut is: `at`");
}

milling::RelativeStructure poles(const dynamics::ModalModel& model, const std::optional<std::string>& at) {
  return milling::relative_structure(model, point_of(model.dofs, at));
}

milling::RelativeStructure poles(const dynamics::SpatialModel& model, const std::optional<std::string>& at) {
  return poles(dynamics::to_modal(model.has_structural_damping() ? dynamics::equivalent_viscous(model) : model), at);
}

namespace {

using milling::Lobes;
using milling::MillingProcess;

/// The moving side of the cut: poles, or lines of a receptance, both in part axes.
using Structure = std::variant<dynamics::SpatialModel, dynamics::ModalModel, dynamics::ResponseModel>;

MillingProcess process(int teeth, double diameter_m, double K_t, double K_r, double K_a,
                       std::optional<double> radial_depth_m, const std::string& direction,
                       std::optional<std::pair<double, double>> arc_rad, const Eigen::Vector3d& feed,
                       const Eigen::Vector3d& axis, OneOrMore<double> helices_rad,
                       const OneOrMore<double>& pitches_rad) {
  if (helices_rad.values.size() == 1 && teeth > 1)
    helices_rad.values.assign(static_cast<std::size_t>(teeth), helices_rad.values.front());
  MillingProcess result;
  result.cutter = {teeth, diameter_m, pitches_rad.values, helices_rad.values, {}, {}};
  result.coefficients = {.K_t = K_t, .K_r = K_r, .K_a = K_a};
  result.frame = {feed, axis};
  if (radial_depth_m.has_value() == arc_rad.has_value())
    throw core::InputError("a cut has either a radial_depth_m, with a direction, or an arc_rad");
  if (direction != "up" && direction != "down")
    throw core::InputError("a cut's direction is \"up\" or \"down\", not \"" + direction + "\"");
  const auto turn = direction == "up" ? milling::MillingDirection::up : milling::MillingDirection::down;
  result.engagement = arc_rad ? milling::Engagement{arc_rad->first, arc_rad->second}
                              : milling::engagement_of(result.cutter, *radial_depth_m, turn);
  milling::require_valid(milling::validate(result));
  return result;
}

milling::SampledStructure samples(const dynamics::ResponseModel& model, const std::optional<std::string>& at,
                                  const milling::ToolFrame& frame) {
  const std::string point = point_of(model.responses, at);
  const auto at_cut = dynamics::between(model, point, point);
  const Eigen::MatrixXd D = frame.rotation().transpose() * dynamics::displacement_matrix(at_cut.responses, point);
  const Eigen::MatrixXd F = frame.rotation().transpose() * dynamics::displacement_matrix(at_cut.forces, point);
  milling::SampledStructure result{{at_cut.axis.hz, {}}, {}};
  for (const auto& H : at_cut.H) result.samples.H.emplace_back(D * H * F.transpose());
  return result;
}

/// A chart for the given speeds, and the row of any speed.
struct Chart {
  std::function<Lobes(const std::vector<double>&)> at;
  milling::RowAt row_at;
};

Chart chart_of(const Structure& structure, const MillingProcess& process, const std::optional<std::string>& at,
               const milling::StabilityOptions& options, const std::string& method) {
  if (const auto* response = std::get_if<dynamics::ResponseModel>(&structure)) {
    if (method != "direct") throw core::InputError("from receptances the method is \"direct\", not \"" + method + "\"");
    const auto felt = milling::fitted_structure(samples(*response, at, process.frame), process.frame);
    return {[felt, process, options](const std::vector<double>& speeds) {
              return milling::stability_lobes(felt, process, speeds, options);
            },
            [felt, process](double rpm, const milling::StabilityOptions& with) {
              return milling::limiting_depth(felt, process, rpm, with);
            }};
  }
  const auto* modal = std::get_if<dynamics::ModalModel>(&structure);
  const auto felt = modal ? poles(*modal, at) : poles(std::get<dynamics::SpatialModel>(structure), at);
  const std::shared_ptr<milling::LobeMethod> by =
      milling::lobe_method(milling::method_named(method), felt, process, {.stability = options});
  return {[by](const std::vector<double>& speeds) { return milling::stability_lobes(*by, speeds); },
          [by](double rpm, const milling::StabilityOptions& with) {
            return by->limiting_depth(rpm, with.expected_depth_m);
          }};
}

Lobes lobes(const Structure& structure, const MillingProcess& process, const OneOrMore<double>& spindle_speeds,
            const std::optional<std::string>& at, double depth_limit_m, double error_tolerance,
            const std::string& method, const std::function<void(std::size_t, std::size_t)>& progress,
            std::optional<double> line_tolerance, std::optional<int> most_added) {
  const std::vector<double>& speeds = spindle_speeds.values;
  const milling::StabilityOptions options{.depth_limit_m = depth_limit_m, .error_tolerance = error_tolerance};
  const auto chart = [&] {
    const LongCall guard;
    return chart_of(structure, process, at, options, method);
  }();
  const auto part = [&chart](const std::vector<double>& some) {
    const LongCall guard;
    return chart.at(some);
  };
  const auto with_line = [&](Lobes whole) {
    if (!line_tolerance) return whole;
    const LongCall guard;
    return milling::refined(std::move(whole), chart.row_at, process, options,
                            {*line_tolerance, most_added.value_or(2 * static_cast<int>(speeds.size()))});
  };
  if (!progress) return with_line(part(speeds));
  const std::size_t at_once = 8 * static_cast<std::size_t>(core::thread_count());
  Lobes result;
  for (std::size_t from = 0; from < speeds.size(); from += at_once) {
    const std::size_t to = std::min(from + at_once, speeds.size());
    Lobes next =
        part({speeds.begin() + static_cast<std::ptrdiff_t>(from), speeds.begin() + static_cast<std::ptrdiff_t>(to)});
    std::ranges::move(next.rows, std::back_inserter(result.rows));
    result.method = next.method;
    result.residual_share = next.residual_share;
    progress(to, speeds.size());
  }
  Lobes whole = milling::lobes_of(std::move(result.rows), result.method);
  whole.residual_share = result.residual_share;
  return with_line(std::move(whole));
}

milling::Multiplier multiplier(const Structure& structure, const MillingProcess& process, double speed_rpm,
                               double depth_m, const std::optional<std::string>& at) {
  if (const auto* modal = std::get_if<dynamics::ModalModel>(&structure))
    return milling::multiplier_at(poles(*modal, at), process, speed_rpm, depth_m, {.depth_limit_m = depth_m});
  if (const auto* spatial = std::get_if<dynamics::SpatialModel>(&structure))
    return milling::multiplier_at(poles(*spatial, at), process, speed_rpm, depth_m, {.depth_limit_m = depth_m});
  throw core::InputError("a multiplier needs poles: a SpatialModel or a ModalModel, not receptances");
}

/// An array with one value for each row.
template <typename Value>
py::array column(const Lobes& lobes, Value milling::LobeRow::*member) {
  py::array_t<Value> values(static_cast<py::ssize_t>(lobes.rows.size()));
  for (std::size_t i = 0; i < lobes.rows.size(); ++i) values.mutable_at(i) = lobes.rows[i].*member;
  return values;
}

template <typename Member>
std::vector<std::string> words(const Lobes& lobes, Member milling::LobeRow::*member) {
  std::vector<std::string> result;
  for (const auto& row : lobes.rows) result.push_back(milling::name(row.*member));
  return result;
}

py::tuple members_of_row(const milling::LobeRow& row) {
  py::list crossings;
  for (const auto& point : row.crossings)
    crossings.append(py::make_tuple(point.depth_m, point.chatter_frequency_hz, static_cast<int>(point.kind),
                                    point.unstable_change, point.error_estimate));
  return py::make_tuple(row.spindle_speed_rpm, row.limiting_depth_m, row.at_limit, row.chatter_frequency_hz,
                        static_cast<int>(row.kind), row.error_estimate, row.searched_m, crossings, row.nodes,
                        static_cast<int>(row.status));
}

milling::LobeRow row_of(const py::tuple& t) {
  milling::LobeRow row{.spindle_speed_rpm = t[0].cast<double>(),
                       .limiting_depth_m = t[1].cast<double>(),
                       .at_limit = t[2].cast<bool>(),
                       .chatter_frequency_hz = t[3].cast<double>(),
                       .kind = static_cast<milling::Bifurcation>(t[4].cast<int>()),
                       .error_estimate = t[5].cast<double>(),
                       .searched_m = t[6].cast<double>(),
                       .crossings = {},
                       .nodes = t[8].cast<int>(),
                       .status = static_cast<milling::StabilityStatus>(t[9].cast<int>())};
  for (const auto& each : t[7].cast<py::list>()) {
    const auto p = each.cast<py::tuple>();
    row.crossings.push_back({p[0].cast<double>(), p[1].cast<double>(),
                             static_cast<milling::Bifurcation>(p[2].cast<int>()), p[3].cast<int>(),
                             p[4].cast<double>()});
  }
  return row;
}

py::tuple members_of_chart(const Lobes& lobes) {
  py::list rows;
  for (const auto& row : lobes.rows) rows.append(members_of_row(row));
  return py::make_tuple(lobes.method, lobes.residual_share, rows);
}

Lobes chart_from(const py::tuple& members) {
  std::vector<milling::LobeRow> rows;
  for (const auto& row : members[2].cast<py::list>()) rows.push_back(row_of(row.cast<py::tuple>()));
  Lobes lobes = milling::lobes_of(std::move(rows), members[0].cast<std::string>());
  lobes.residual_share = members[1].cast<double>();
  return lobes;
}

std::string represented(const Lobes& lobes) {
  return "<Lobes at " + std::to_string(lobes.rows.size()) + " speeds, least depth " +
         core::readable_text(lobes.minimum_depth_m, core::kind::length) + " at " +
         core::number_text(lobes.at_spindle_speed_rpm, 6) + " rpm>";
}

py::tuple members_of_process(const MillingProcess& p) {
  return py::make_tuple(p.cutter.teeth, p.cutter.diameter_m, p.coefficients.K_t, p.coefficients.K_r, p.coefficients.K_a,
                        std::pair(p.engagement.entry_rad, p.engagement.exit_rad), p.frame.feed, p.frame.axis,
                        p.cutter.helices_rad, p.cutter.pitches_rad);
}

MillingProcess process_of(const py::tuple& t) {
  const auto numbers = [&t](std::size_t i) { return OneOrMore<double>{t[i].cast<std::vector<double>>()}; };
  return process(t[0].cast<int>(), t[1].cast<double>(), t[2].cast<double>(), t[3].cast<double>(), t[4].cast<double>(),
                 {}, "down", t[5].cast<std::pair<double, double>>(), t[6].cast<Eigen::Vector3d>(),
                 t[7].cast<Eigen::Vector3d>(), numbers(8), numbers(9));
}

std::string represented(const MillingProcess& p) {
  return "<MillingProcess of " + std::to_string(p.cutter.teeth) + " teeth, diameter " +
         core::readable_text(p.cutter.diameter_m, core::kind::length) + ", K_t " +
         core::readable_text(p.coefficients.K_t, core::kind::stress) + ", arc " +
         core::number_text(p.engagement.entry_rad, 4) + " to " + core::number_text(p.engagement.exit_rad, 4) + " rad>";
}

void bind_lobes(py::module_& module) {
  using milling::LobeRow;
  py::class_<Lobes>(module, "Lobes", "A stability chart with one value for each spindle speed.")
      .def_readonly("method", &Lobes::method, "The method by which it was computed.")
      .def_readonly("minimum_depth_m", &Lobes::minimum_depth_m, "The least limiting depth of all speeds.")
      .def_readonly("at_spindle_speed_rpm", &Lobes::at_spindle_speed_rpm, "The speed of the least limiting depth.")
      .def_readonly("worst_error_estimate", &Lobes::worst_error_estimate,
                    "The largest estimated relative error of a depth.")
      .def_readonly("rows_not_converged", &Lobes::rows_not_converged,
                    "The number of speeds whose error estimate exceeds the tolerance.")
      .def_property_readonly(
          "line_error", [](const Lobes& l) { return l.line ? std::optional(l.line->error_estimate) : std::nullopt; },
          "The largest estimated distance of the line between the speeds from the boundary, relative; inf where it is\n"
          "not known, None of a chart without added speeds.")
      .def_property_readonly(
          "speeds_added", [](const Lobes& l) { return l.line ? l.line->speeds_added : 0; },
          "The number of speeds that were added for the line's sake.")
      .def_property_readonly(
          "spindle_speed_rpm", [](const Lobes& l) { return column(l, &LobeRow::spindle_speed_rpm); },
          "The spindle speeds.")
      .def_property_readonly(
          "limiting_depth_m", [](const Lobes& l) { return column(l, &LobeRow::limiting_depth_m); },
          "The depths below which the cut is stable; the depth limit if `at_limit`.")
      .def_property_readonly(
          "at_limit", [](const Lobes& l) { return column(l, &LobeRow::at_limit); },
          "True for each speed at which the cut is stable up to the depth limit.")
      .def_property_readonly(
          "chatter_frequency_hz", [](const Lobes& l) { return column(l, &LobeRow::chatter_frequency_hz); },
          "The frequency of the motion that grows above the limiting depth.")
      .def_property_readonly(
          "error_estimate", [](const Lobes& l) { return column(l, &LobeRow::error_estimate); },
          "The estimated relative error of each depth.")
      .def_property_readonly(
          "kind", [](const Lobes& l) { return words(l, &LobeRow::kind); },
          "The kind of the instability: hopf, flip or fold.")
      .def_property_readonly(
          "status", [](const Lobes& l) { return words(l, &LobeRow::status); },
          "\"converged\", or the reason why it is not.")
      .def("__repr__", [](const Lobes& lobes) { return represented(lobes); })
      .def(py::pickle(&members_of_chart, &chart_from));
  py::class_<milling::Multiplier>(module, "Multiplier", "The dominant Floquet multiplier of a cut.")
      .def_readonly("value", &milling::Multiplier::value, "The multiplier μ, with Im μ ≥ 0.")
      .def_readonly("modulus", &milling::Multiplier::modulus, "The modulus |μ|; the cut is stable below 1.")
      .def_readonly("error_estimate", &milling::Multiplier::error_estimate,
                    "The estimated relative error of the modulus.")
      .def_readonly("chatter_frequency_hz", &milling::Multiplier::chatter_frequency_hz, "The frequency of the motion.")
      .def("__repr__",
           [](const milling::Multiplier& m) {
             return "<Multiplier of modulus " + core::number_text(m.modulus, 6) + ", " +
                    (m.modulus < 1.0 ? "stable" : "unstable") + ", " + core::number_text(m.chatter_frequency_hz, 6) +
                    " Hz>";
           })
      .def(py::pickle(
          [](const milling::Multiplier& m) {
            return py::make_tuple(m.value, m.modulus, m.error_estimate, m.chatter_frequency_hz,
                                  static_cast<int>(m.kind), m.nodes, static_cast<int>(m.status));
          },
          [](const py::tuple& t) {
            return milling::Multiplier{t[0].cast<std::complex<double>>(),
                                       t[1].cast<double>(),
                                       t[2].cast<double>(),
                                       t[3].cast<double>(),
                                       static_cast<milling::Bifurcation>(t[4].cast<int>()),
                                       t[5].cast<int>(),
                                       static_cast<milling::StabilityStatus>(t[6].cast<int>())};
          }));
}

}  // namespace

void bind_milling(py::module_& module) {
  py::class_<MillingProcess>(module, "MillingProcess",
                             "A cut without its speed, its depth and the vibrating structure.")
      .def(py::init(&process), py::kw_only(), "teeth"_a, "diameter_m"_a, "K_t"_a, "K_r"_a, "K_a"_a = 0.0,
           "radial_depth_m"_a = py::none(), "direction"_a = "down", "arc_rad"_a = py::none(),
           "feed"_a = Eigen::Vector3d(1, 0, 0), "axis"_a = Eigen::Vector3d(0, 0, 1),
           "helices_rad"_a = OneOrMore<double>{}, "pitches_rad"_a = OneOrMore<double>{},
           "K_t, K_r, K_a: cutting coefficients, N/m². radial_depth_m with direction \"up\" or \"down\", or arc_rad =\n"
           "(entry, exit). feed, axis: unit vectors in the structure's axes, tool against part, tip to spindle.\n"
           "helices_rad, pitches_rad: one value for each tooth; one helix stands for all.")
      .def("__repr__", [](const MillingProcess& p) { return represented(p); })
      .def(py::pickle(&members_of_process, &process_of));
  bind_lobes(module);
  module.def("lobes", lobes, "structure"_a, "process"_a, "spindle_speeds_rpm"_a, py::kw_only(), "at"_a = py::none(),
             "depth_limit_m"_a = 0.02, "error_tolerance"_a = 1e-4, "method"_a = "direct", "progress"_a = py::none(),
             "line_tolerance"_a = py::none(), "most_added"_a = py::none(),
             "The limiting depth at every speed, which is a stability lobe diagram.\n\n"
             "structure: SpatialModel, ModalModel, or Response (measured receptances, without a fit). at: the point\n"
             "of the cut, if the structure has several. method: direct (exact, with its error), zeroth_order,\n"
             "multi_frequency, semi_discretization_0 … 2, full_discretization_1 … 3. progress(done, of): called after\n"
             "every few of the given speeds; an exception that it raises ends the call. line_tolerance: speeds are\n"
             "added, at most most_added (twice as many as given), until the line between them is within this share of\n"
             "the boundary; None: the given speeds alone. They must rise.");
  module.def("multiplier", multiplier, "structure"_a, "process"_a, "spindle_speed_rpm"_a, "depth_m"_a,
             "at"_a = py::none(), LongCallGuard(), "The dominant Floquet multiplier at one speed and depth.");
}

}  // namespace thinwall::python
