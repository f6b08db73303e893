#pragma once
// The vibration of a simulated cut over speed and depth.

#include <Eigen/Core>
#include <vector>

#include "setup/machining_setup.hpp"
#include "study/kept/checkpoint.hpp"
#include "study/lobes/chart_of.hpp"

namespace thinwall::study {

struct Results;

/// Peak-to-peak vibration over speed and depth, depths × speeds.
struct AmplitudeMap {
  ChartOf of = ChartOf::part;
  std::vector<double> spindle_speeds_rpm;
  std::vector<double> depths_m;    ///< ascending
  Eigen::MatrixXd peak_to_peak_m;  ///< of tool minus part, the largest of the three tool axes; infinite where the
                                   ///< vibration outgrew the cutter
  Eigen::MatrixXd share_without_contact;  ///< of the time within the angles of the cut; 1 where it outgrew the cutter
  Eigen::MatrixXi unsettled;              ///< 1 where forces within steps did not settle: not to be trusted, else 0
};

/// The map of every structure that setup.simulation asks for, by milling::simulate(); empty where it asks for no map.
/// What `kept` holds is taken from there. Points share out among the threads. Errors as simulate_points(). Cost:
/// speeds × depths × turns of a point.
[[nodiscard]] std::vector<AmplitudeMap> amplitude_maps(const setup::Setup& setup, const Results& results,
                                                       Checkpoint& kept);

}  // namespace thinwall::study
