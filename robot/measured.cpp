#include "robot/measured.hpp"

#include <cmath>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::robot {

namespace {

[[noreturn]] void refuse_line(const std::string& point, Eigen::Index line, double hz, const char* cause) {
  std::ostringstream text;
  text << "measured receptance of \"" << point << "\", line " << line + 1 << " (" << hz << " Hz): " << cause;
  throw core::DataError(text.str());
}

}  // namespace

dynamics::ResponseModel measured_receptance(const dynamics::FrequencyAxis& axis, const Eigen::VectorXcd& receptance,
                                            const std::string& point, const Eigen::Vector3d& direction) {
  if (!(std::abs(direction.norm() - 1.0) <= 1e-9)) {
    std::ostringstream text;
    text << "measured receptance of \"" << point << "\": its direction has length " << direction.norm()
         << ", but it must be a unit vector";
    throw core::InputError(text.str());
  }
  if (axis.size() != receptance.size() || axis.size() == 0) {
    throw core::DataError("measured receptance of \"" + point + "\": " + std::to_string(receptance.size()) +
                          " values for " + std::to_string(axis.size()) + " frequencies; each line needs both");
  }
  const dynamics::DofTable dof{{point, direction, dynamics::DofKind::translation}};
  dynamics::ResponseModel model{axis, dof, dof, {}};
  model.H.reserve(static_cast<std::size_t>(axis.size()));
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    const std::complex<double> H = receptance(line);
    const double hz = axis.hz(line);
    if (!std::isfinite(hz) || !std::isfinite(H.real()) || !std::isfinite(H.imag())) {
      refuse_line(point, line, hz, "the value is not finite; remove or repair the line");
    }
    if (line > 0 && !(hz > axis.hz(line - 1))) refuse_line(point, line, hz, "frequencies must rise strictly");
    model.H.emplace_back(Eigen::MatrixXcd::Constant(1, 1, H));
  }
  return model;
}

}  // namespace thinwall::robot
