#include "app/measured.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "reduction/damping.hpp"

namespace thinwall::app {

namespace {

/// "P.x" as a DOF.
dynamics::Dof dof_of(const std::string& name) {
  const auto dot = name.rfind('.');
  if (dot == std::string::npos || dot == 0) {
    throw core::InputError("\"" + name + "\" names no degree of freedom; write it as POINT.x, POINT.y or POINT.z");
  }
  return {name.substr(0, dot), dynamics::axis(name.substr(dot + 1)), dynamics::DofKind::translation};
}

}  // namespace

io::MeasuredFrf read_measured(const MeasuredFrf& measured) {
  return io::read_frf(measured.file, io::frf_format(measured.quantity, measured.unit, measured.frequency_unit));
}

dynamics::ResponseModel measured_response(const std::vector<MeasuredFrf>& files, const dynamics::FrequencyAxis& axis) {
  std::map<std::pair<std::string, std::string>, Eigen::VectorXcd> entries;
  std::vector<std::string> names;
  for (const MeasuredFrf& file : files) {
    entries[{file.response, file.force}] = io::resample(read_measured(file), axis);
    for (const auto& name : {file.response, file.force}) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  dynamics::ResponseModel model;
  model.axis = axis;
  for (const auto& name : names) model.responses.push_back(dof_of(name));
  model.forces = model.responses;
  const auto n = static_cast<Eigen::Index>(names.size());
  model.H.assign(static_cast<std::size_t>(axis.size()), Eigen::MatrixXcd(n, n));
  for (Eigen::Index a = 0; a < n; ++a) {
    for (Eigen::Index b = 0; b < n; ++b) {
      auto found = entries.find({names[static_cast<std::size_t>(a)], names[static_cast<std::size_t>(b)]});
      if (found == entries.end())
        found = entries.find({names[static_cast<std::size_t>(b)], names[static_cast<std::size_t>(a)]});
      if (found == entries.end()) {
        throw core::InputError("no file gives the response of " + names[static_cast<std::size_t>(a)] +
                               " to a force at " + names[static_cast<std::size_t>(b)] +
                               ", nor the reverse: add one, or leave the others out");
      }
      for (Eigen::Index line = 0; line < axis.size(); ++line)
        model.H[static_cast<std::size_t>(line)](a, b) = found->second(line);
    }
  }
  return model;
}

std::vector<double> matched_ratios(const dynamics::SpatialModel& reduced,
                                   const std::vector<reduction::IdentifiedMode>& identified, double rest) {
  const Eigen::VectorXd all_hz = dynamics::undamped_modes(reduced).omega_rad_s / (2.0 * std::numbers::pi);
  const Eigen::VectorXd hz = all_hz.tail(all_hz.size() - reduction::rigid_motions(all_hz));
  std::vector<double> ratios(static_cast<std::size_t>(hz.size()), rest);
  for (const auto& mode : identified) {
    Eigen::Index nearest = 0;
    (hz.array() - mode.frequency_hz).abs().minCoeff(&nearest);
    if (std::abs(hz(nearest) - mode.frequency_hz) > 0.1 * mode.frequency_hz) {
      throw core::InputError(
          "the measured resonance at " + std::to_string(mode.frequency_hz) +
          " Hz has no mode of the part within 10 %: fit the part first (updating), or give damping.ratios");
    }
    ratios[static_cast<std::size_t>(nearest)] = mode.damping_ratio;
  }
  return ratios;
}

}  // namespace thinwall::app
