#include "milling/simulation/circular_cut.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace thinwall::milling {

namespace {

double longest_step_rad(const MarchGrid& grid) {
  double longest = 0.0;
  for (const MarchStretch& s : grid.stretches) longest = std::max(longest, (s.to_rad - s.from_rad) / s.steps);
  return longest;
}

/// Steps of free flight twice as long as those of the cut.
Flight flight_over(const CircularCut& cut, double from_rad, double to_rad, double cut_step_rad) {
  const double rad = to_rad - from_rad;
  Flight flight{free_flight(cut.structure, rad / cut.rad_per_s), {}, 0, from_rad, 0.0};
  if (rad < 1e-9) return flight;
  flight.steps = std::max(1, static_cast<int>(std::ceil(rad / (2.0 * cut_step_rad))));
  flight.step_rad = rad / flight.steps;
  flight.half_step = free_flight(cut.structure, 0.5 * flight.step_rad / cut.rad_per_s);
  return flight;
}

}  // namespace

CircularCut circular_cut(const RelativeStructure& structure, const MillingProcess& process, double spindle_speed_rpm,
                         double depth_m, double feed_per_tooth_m, const StepOptions& options) {
  CircularCut result;
  result.grid = march_grid(process, depth_m, feed_per_tooth_m, options);
  result.structure = contact_state(structure, process.frame);
  const Eigen::Matrix3d to_part = process.frame.rotation();
  result.residual = to_part.transpose() * structure.R * to_part;
  result.rad_per_s = spindle_speed_rpm * 2.0 * std::numbers::pi / 60.0;
  result.start = start_map(result.structure, result.residual, result.rad_per_s);
  const double usual_step_rad = longest_step_rad(result.grid);
  double since = 0.0;
  for (const MarchStretch& stretch : result.grid.stretches) {
    const double step_rad = (stretch.to_rad - stretch.from_rad) / stretch.steps;
    result.flights.push_back(flight_over(result, since, stretch.from_rad, usual_step_rad));
    result.rules.push_back(march_rule<3>(result.structure, ports_of(result.structure, result.residual),
                                         step_rad / result.rad_per_s, step_rad));
    since = stretch.to_rad;
  }
  result.flights.push_back(flight_over(result, since, result.grid.period_rad, usual_step_rad));
  return result;
}

Eigen::VectorXd at_rest(const ContactState& structure, const Eigen::Vector3d& force_n) {
  const Eigen::Index n = structure.decay.size();
  const Eigen::VectorXd driven = structure.B * force_n;
  Eigen::VectorXd x(structure.size());
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::complex<double> z = -std::complex<double>(driven(k), driven(n + k)) /
                                   std::complex<double>(structure.decay(k), structure.frequency(k));
    x(k) = z.real();
    x(n + k) = z.imag();
  }
  for (Eigen::Index k = 2 * n; k < structure.size(); ++k) x(k) = -driven(k) / structure.real_pole(k - 2 * n);
  return x;
}

CutState at_rest(const CircularCut& cut, const Eigen::Vector3d& force_n) {
  CutState state{at_rest(cut.structure, force_n), {}, std::vector<unsigned char>(cut.grid.points.size(), 1)};
  const Eigen::Vector3d q = cut.structure.motion * state.modes + cut.residual * force_n;
  for (const CutPoint& p : cut.grid.points) {
    const Disc& disc = cut.grid.discs[static_cast<std::size_t>(p.disc)];
    state.surface_m.push_back(disc.sin_kappa * (p.sine * q.x() + p.cosine * q.y()) - disc.cos_kappa * q.z());
  }
  return state;
}

}  // namespace thinwall::milling
