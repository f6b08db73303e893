#include "coupling/route_difference.hpp"

#include <sstream>

#include "core/error.hpp"

namespace thinwall::coupling {

namespace {

void require_same_table(const dynamics::DofTable& a, const dynamics::DofTable& b) {
  if (a.size() != b.size()) {
    throw core::InputError("the routes' tables hold " + std::to_string(a.size()) + " and " + std::to_string(b.size()) +
                           " degrees of freedom: compare between points that both have");
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (name(a[i]) != name(b[i])) {
      throw core::InputError("the routes' tables differ in row " + std::to_string(i + 1) + ": " + name(a[i]) +
                             " against " + name(b[i]));
    }
  }
}

std::string entry_name(const dynamics::Dof& response, const dynamics::Dof& force) {
  if (response.point != force.point) return name(response) + "/" + name(force);
  return name(response).substr(response.point.size() + 1) + name(force).substr(force.point.size() + 1);
}

}  // namespace

RouteDifference route_difference(const dynamics::ResponseModel& spatial, const dynamics::ResponseModel& receptance) {
  require_equal(spatial.axis, receptance.axis);
  require_same_table(spatial.responses, receptance.responses);
  require_same_table(spatial.forces, receptance.forces);
  RouteDifference largest;
  for (Eigen::Index line = 0; line < spatial.axis.size(); ++line) {
    const Eigen::MatrixXcd& G = spatial.H[static_cast<std::size_t>(line)];
    const Eigen::MatrixXcd& G_receptance = receptance.H[static_cast<std::size_t>(line)];
    if (!G.allFinite() || !G_receptance.allFinite()) {
      std::ostringstream text;
      text << "a coupled receptance at " << spatial.axis.hz(line) << " Hz is not finite";
      throw core::NumericalError(text.str());
    }
    Eigen::Index row = 0, column = 0;
    const double difference = (G - G_receptance).cwiseAbs().maxCoeff(&row, &column) / G.cwiseAbs().maxCoeff();
    if (line > 0 && !(difference > largest.max_relative)) continue;
    largest = {
        difference, spatial.axis.hz(line),
        entry_name(spatial.responses[static_cast<std::size_t>(row)], spatial.forces[static_cast<std::size_t>(column)])};
  }
  return largest;
}

RouteDifference route_difference(const dynamics::ResponseModel& spatial, const dynamics::ResponseModel& receptance,
                                 const std::string& response_point, const std::string& force_point) {
  return route_difference(between(spatial, response_point, force_point),
                          between(receptance, response_point, force_point));
}

}  // namespace thinwall::coupling
