// Cases, their checks, and the whole workflow on them.

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "case/checks/checks.hpp"
#include "case/machining_case.hpp"
#include "case/numbers.hpp"
#include "case/reader.hpp"
#include "python/bindings.hpp"
#include "report/postures/posture_summary.hpp"
#include "report/summary.hpp"
#include "report/summary/summary_json.hpp"
#include "report/summary/write_json.hpp"
#include "study/postures/posture_study.hpp"
#include "study/run.hpp"

namespace thinwall::python {

namespace {

/// A case with the overrides that it was read with, so that further ones can be put over the same text.
struct LoadedCase {
  std::filesystem::path path;  ///< empty for a case from text
  std::vector<std::string> overrides;
  cases::Case value;
};

LoadedCase read_again(const LoadedCase& loaded, std::vector<std::string> overrides) {
  const cases::Case& before = loaded.value;
  cases::Case value = loaded.path.empty() ? cases::parse_case(before.source, before.folder, "case.toml", overrides)
                                          : cases::read_case(loaded.path, overrides);
  return {loaded.path, std::move(overrides), std::move(value)};
}

LoadedCase load(const std::filesystem::path& path, const OneOrMore<std::string>& overrides) {
  return {path, overrides.values, cases::read_case(path, overrides.values)};
}

LoadedCase parse(const std::string& text, const std::filesystem::path& folder,
                 const OneOrMore<std::string>& overrides) {
  return {{}, overrides.values, cases::parse_case(text, folder, "case.toml", overrides.values)};
}

/// "part.thickness" and 0.003 or "3 mm" as an override of the command line; a bare number is in SI.
std::string override_text(const std::string& key, const py::object& value) {
  return key + "=" + (py::isinstance<py::str>(value) ? value.cast<std::string>() : py::repr(value).cast<std::string>());
}

LoadedCase with(const LoadedCase& loaded, const std::string& key, const py::object& value) {
  std::vector<std::string> overrides = loaded.overrides;
  overrides.push_back(override_text(key, value));
  return read_again(loaded, std::move(overrides));
}

std::vector<std::string> check(const std::filesystem::path& path, const OneOrMore<std::string>& overrides) {
  try {
    (void)cases::read_case(path, overrides.values);
    return {};
  } catch (const cases::CaseError& error) {
    std::vector<std::string> lines;
    for (const cases::Problem& problem : error.problems)
      lines.push_back(cases::problem_line(error.source.name, problem));
    return lines;
  }
}

/// A case from a file is read again where it is unpickled; one from text is its text.
py::tuple members_of_case(const LoadedCase& loaded) {
  const bool is_file = !loaded.path.empty();
  return py::make_tuple(is_file, is_file ? std::filesystem::absolute(loaded.path).string() : loaded.value.source,
                        std::filesystem::absolute(loaded.value.folder).string(), loaded.overrides);
}

LoadedCase case_of(const py::tuple& members) {
  const OneOrMore<std::string> overrides{members[3].cast<std::vector<std::string>>()};
  const auto text = members[1].cast<std::string>();
  return members[0].cast<bool>() ? load(text, overrides) : parse(text, members[2].cast<std::string>(), overrides);
}

study::Results run(const LoadedCase& loaded, const std::function<void(const std::string&)>& progress) {
  const auto tell = [&progress](const std::string& stage) {
    if (stage.empty()) return;
    const py::gil_scoped_acquire held;
    progress(stage);
  };
  const LongCall guard;
  study::Kept nothing;
  return study::run(loaded.value, cases::variation_of(loaded.value), nothing,
                    {{}, progress ? study::StageListener(tell) : study::StageListener()});
}

std::string summary_text(const study::Results& results) {
  return report::summary_json(report::summary_of(results.setup, results)).dump();
}

std::map<std::string, milling::Lobes> charts(const study::Results& results) {
  std::map<std::string, milling::Lobes> list;
  for (const study::StructureLobes& named : results.lobes) list[core::word_of(named.of)] = named.lobes;
  return list;
}

py::object number_or_none(bool known, double value) {
  return known ? py::object(py::float_(value)) : py::object(py::none());
}

/// A simulated point: where it is, how it grows, and all that a simulated cut has.
py::dict simulation_of(const study::PointSimulation& p) {
  py::dict point = dict_of(p.cut);
  point["chart"] = core::word_of(p.of);
  point["spindle_speed_rpm"] = p.point.spindle_speed_rpm;
  point["depth_m"] = p.point.depth_m;
  point["feed_per_tooth_m"] = p.feed_per_tooth_m;
  point["multiplier_march"] = number_or_none(p.growth.converged, p.growth.modulus);
  point["multiplier_lobes"] = number_or_none(std::isfinite(p.lobes.modulus), p.lobes.modulus);
  point["growth_difference"] = number_or_none(p.growth.converged, p.growth_difference());
  point["forced_difference"] = number_or_none(p.forced.has_value(), p.forced ? p.forced->difference : 0.0);
  point["removal_error"] = number_or_none(p.cut.removal_error.has_value(), p.cut.removal_error.value_or(0.0));
  if (!p.lag_m.empty()) point["lag_m"] = p.lag_m;
  return point;
}

py::list simulations(const study::Results& results) {
  py::list list;
  for (const study::PointSimulation& point : results.simulations) list.append(simulation_of(point));
  return list;
}

py::dict amplitude_maps(const study::Results& results) {
  py::dict maps;
  for (const study::AmplitudeMap& map : results.amplitude_maps) {
    const auto array = [](const std::vector<double>& values) {
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values)));
    };
    maps[py::str(core::word_of(map.of))] =
        py::dict("spindle_speed_rpm"_a = array(map.spindle_speeds_rpm), "depth_m"_a = array(map.depths_m),
                 "peak_to_peak_m"_a = map.peak_to_peak_m, "share_without_contact"_a = map.share_without_contact,
                 "unsettled"_a = map.unsettled);
  }
  return maps;
}

std::map<std::string, dynamics::ResponseModel> responses(const study::Results& results) {
  std::map<std::string, dynamics::ResponseModel> list;
  if (results.part) list["part"] = results.part->response;
  if (results.robot) list["robot"] = results.robot->response;
  if (results.coupled) list["coupled_receptance"] = results.coupled->receptance.response;
  if (results.coupled && results.coupled->spatial_response)
    list["coupled_spatial"] = *results.coupled->spatial_response;
  return list;
}

/// A row a place: value, lower and upper end of the band of 95 %.
template <typename Of>
Eigen::MatrixXd bands_of(const std::vector<posture::MappedPlace>& map, const Of& of) {
  Eigen::MatrixXd bands(std::ssize(map), 3);
  for (std::size_t i = 0; i < map.size(); ++i) {
    const posture::Banded band = of(map[i]);
    bands.row(static_cast<Eigen::Index>(i)) << band.value, band.low, band.high;
  }
  return bands;
}

py::dict postures_as_dict(const study::PostureStudy& found) {
  const std::string figures = report::json_of(report::summary_of(found)).dump();
  py::dict result = py::module_::import("json").attr("loads")(figures);
  if (!found.map.empty()) {
    result["map_places"] = found.mapped_at;
    result["map_first_hz"] = bands_of(found.map, [](const posture::MappedPlace& at) { return at.first_hz; });
    if (found.map.front().depth)
      result["map_depth_m"] = bands_of(found.map, [](const posture::MappedPlace& at) { return at.depth->depth_m; });
  }
  if (found.envelope) {
    result["chart_rpm"] = found.chart_rpm;
    result["low_modes_depth_m"] = found.envelope->low;
    result["high_modes_depth_m"] = found.envelope->high;
    result["all_modes_depth_m"] = found.envelope->together;
  }
  if (found.next) {
    result["candidates"] = found.candidates;
    result["reduction"] = found.next->reduction;
  }
  return result;
}

study::PostureStudy answers(const LoadedCase& loaded, const study::PostureQuestions& questions) {
  const LongCall guard;
  return study::study_postures(loaded.value, questions);
}

py::dict study_postures(const LoadedCase& loaded, const std::optional<OneOrMore<std::string>>& parts,
                        std::optional<double> spindle_speed_rpm, bool best_speed, int grid, int folds,
                        const std::optional<Eigen::MatrixXd>& path, const std::optional<Eigen::MatrixXd>& candidates,
                        std::optional<double> split_hz) {
  study::PostureQuestions questions = parts ? study::questions_on(parts->values) : study::PostureQuestions();
  questions.spindle_speed_rpm = spindle_speed_rpm;
  questions.best_speed = best_speed;
  questions.grid = grid;
  questions.folds = folds;
  questions.path = path.value_or(Eigen::MatrixXd());
  questions.candidates = candidates.value_or(Eigen::MatrixXd());
  questions.split_hz = split_hz;
  return postures_as_dict(answers(loaded, questions));
}

void bind_case(py::module_& module) {
  py::class_<LoadedCase>(module, "Case", "A case, as read from its file.")
      .def_static("load", load, "path"_a, "overrides"_a = OneOrMore<std::string>{},
                  "A case from its folder or its file. overrides: \"key=value\" as on the command line. Raises\n"
                  "InputError with every problem of the case.")
      .def_static("parse", parse, "text"_a, "folder"_a = ".", "overrides"_a = OneOrMore<std::string>{},
                  "A case from its text; files that it names are relative to `folder`.")
      .def("with_", with, "key"_a, "value"_a,
           "A copy of the case with one value changed, a number in SI or a text with its unit: "
           "with_(\"part.thickness\",\n"
           "\"3 mm\").")
      .def(
          "value", [](const LoadedCase& c, const std::string& key) { return cases::get_value(c.value, key); }, "key"_a,
          "The number of a key, in SI (frequencies in Hz, spindle speeds in rpm).")
      .def_property_readonly(
          "name", [](const LoadedCase& c) { return c.value.name; }, "The name of the case's folder.")
      .def_property_readonly(
          "title", [](const LoadedCase& c) { return c.value.title; }, "The title of the case.")
      .def("__repr__",
           [](const LoadedCase& c) {
             const std::string& name = c.value.name.empty() ? "from text" : c.value.name;
             return "<Case " + name + (c.value.title.empty() ? "" : ": " + c.value.title) +
                    (c.overrides.empty() ? "" : "; " + listed("overrides", c.overrides)) + ">";
           })
      .def(py::pickle(&members_of_case, &case_of));
}

void bind_results(py::module_& module) {
  py::class_<study::Results>(module, "StudyResults", "All results of a run, in memory.")
      .def_property_readonly(
          "summary", [](const study::Results& r) { return py::module_::import("json").attr("loads")(summary_text(r)); },
          "The figures of summary.json, as a dict.")
      .def_property_readonly("lobes", charts, "The stability charts by their names: part, supported, tool, carried.")
      .def_property_readonly("frf", responses,
                             "The receptances by their names: part, robot, coupled_receptance, coupled_spatial.")
      .def_property_readonly("simulations", simulations,
                             "The simulated points, structure by structure: each a dict as of simulate(), with chart,\n"
                             "spindle_speed_rpm, depth_m, feed_per_tooth_m, multiplier_march, multiplier_lobes,\n"
                             "growth_difference, forced_difference and removal_error (None: not known), and lag_m of\n"
                             "a multibody arm.")
      .def_property_readonly(
          "amplitude_maps", amplitude_maps,
          "Peak-to-peak vibration over speed and depth by the names of charts: dicts of\n"
          "spindle_speed_rpm, depth_m, and peak_to_peak_m, share_without_contact and unsettled (1: not to be\n"
          "trusted), depths x speeds.")
      .def("__repr__", [](const study::Results& r) {
        std::vector<std::string> frf, lobes;
        for (const auto& [name, response] : responses(r)) frf.push_back(name);
        for (const auto& [name, chart] : charts(r)) lobes.push_back(name);
        return "<StudyResults: " + listed("charts", lobes) + "; " + listed("responses", frf) + ">";
      });
}

}  // namespace

void bind_study(py::module_& module) {
  bind_case(module);
  bind_results(module);
  module.def("check", check, "path"_a, "overrides"_a = OneOrMore<std::string>{},
             "Every problem of a case, one line each with its place; empty if there is none. Nothing is computed.");
  module.def("run", run, "case"_a, "progress"_a = py::none(),
             "Computes all that the case asks for, without files. progress(stage): called when each stage begins;\n"
             "an exception that it raises ends the call.");
  module.def(
      "study_postures", study_postures, "case"_a, "parts"_a = py::none(), py::kw_only(),
      "spindle_speed_rpm"_a = py::none(), "best_speed"_a = false, "grid"_a = 5, "folds"_a = 5, "path"_a = py::none(),
      "candidates"_a = py::none(), "split_hz"_a = py::none(),
      "A robot that was tapped at several postures (robot.postures). parts, all unless some are named: errors (at\n"
      "postures that were held out), curve (errors over the number of postures), sharing (numbers learned alone and\n"
      "together), map (over the workspace), envelope (of low and high modes), next (the posture to tap). A dict of "
      "the\n"
      "figures of postures.json and, as far as asked for, arrays: map_places, map_first_hz and map_depth_m (value, "
      "low\n"
      "and high of the band of 95 %), chart_rpm with low_modes_depth_m, high_modes_depth_m and all_modes_depth_m,\n"
      "candidates with reduction. path and candidates: a row a place, as robot.over has them.");
}

}  // namespace thinwall::python
