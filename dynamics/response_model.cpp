#include "dynamics/response_model.hpp"

#include <sstream>

#include "core/error.hpp"

namespace thinwall::dynamics {

namespace {

std::vector<int> translation_rows(const DofTable& dofs, const std::string& point) {
  std::vector<int> rows;
  for (const int row : rows_of_point(dofs, point)) {
    if (dofs[static_cast<std::size_t>(row)].kind == DofKind::translation) rows.push_back(row);
  }
  if (rows.empty()) throw core::InputError("point \"" + point + "\" has no translation");
  return rows;
}

DofTable select(const DofTable& dofs, const std::vector<int>& rows) {
  DofTable selected;
  selected.reserve(rows.size());
  for (const int row : rows) selected.push_back(dofs[static_cast<std::size_t>(row)]);
  return selected;
}

}  // namespace

void require_consistent(const ResponseModel& model) {
  const auto rows = static_cast<Eigen::Index>(model.responses.size());
  const auto columns = static_cast<Eigen::Index>(model.forces.size());
  bool consistent = model.axis.size() == static_cast<Eigen::Index>(model.H.size());
  for (const auto& H : model.H) consistent = consistent && H.rows() == rows && H.cols() == columns;
  if (!consistent) throw core::InputError("the response's matrices do not match its frequencies and DOF tables");
}

void require_complete(const ResponseModel& model) {
  if (static_cast<Eigen::Index>(model.H.size()) != model.axis.size()) {
    throw core::InputError("a response of " + std::to_string(model.H.size()) + " matrices on an axis of " +
                           std::to_string(model.axis.size()) + " frequency lines");
  }
  const auto rows = static_cast<Eigen::Index>(model.responses.size());
  const auto columns = static_cast<Eigen::Index>(model.forces.size());
  for (std::size_t line = 0; line < model.H.size(); ++line) {
    const Eigen::MatrixXcd& H = model.H[line];
    const bool right_size = H.rows() == rows && H.cols() == columns;
    if (right_size && H.allFinite()) continue;
    std::ostringstream text;
    text << "the response at " << model.axis.hz(static_cast<Eigen::Index>(line)) << " Hz ";
    if (right_size) {
      text << "holds a value that is not finite";
    } else {
      text << "is " << H.rows() << " x " << H.cols() << ", but its tables name " << rows << " responses and " << columns
           << " forces";
    }
    throw core::InputError(text.str());
  }
}

Eigen::VectorXcd entry(const ResponseModel& model, const std::string& response, const std::string& force) {
  const int row = row_of(model.responses, response);
  const int column = row_of(model.forces, force);
  Eigen::VectorXcd values(model.axis.size());
  for (Eigen::Index line = 0; line < values.size(); ++line) {
    values(line) = model.H[static_cast<std::size_t>(line)](row, column);
  }
  return values;
}

ResponseModel between(const ResponseModel& model, const std::string& response_point, const std::string& force_point) {
  const std::vector<int> rows = translation_rows(model.responses, response_point);
  const std::vector<int> columns = translation_rows(model.forces, force_point);
  ResponseModel part{model.axis, select(model.responses, rows), select(model.forces, columns), {}};
  part.H.reserve(model.H.size());
  for (const Eigen::MatrixXcd& H : model.H) part.H.emplace_back(H(rows, columns));
  return part;
}

}  // namespace thinwall::dynamics
