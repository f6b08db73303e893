#include "dynamics/response_model.hpp"

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
