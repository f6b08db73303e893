#include "report/damping_files.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/conversion.hpp"
#include "io/frf/resample.hpp"
#include "io/results/csv_table.hpp"
#include "setup/measured.hpp"

namespace thinwall::report {

namespace {

std::vector<double> list_of(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

/// The part as one of its DOFs knows it; none if it has no such DOF.
std::optional<dynamics::ModalModel> seen_at(const dynamics::ModalModel& part, const std::string& dof) {
  const auto at = std::ranges::find(part.dofs, dof, [](const dynamics::Dof& d) { return dynamics::name(d); });
  if (at == part.dofs.end()) return std::nullopt;
  const Eigen::Index row = at - part.dofs.begin();
  Eigen::MatrixXd residual;
  if (part.residual.size() > 0) residual = part.residual.block(row, row, 1, 1);
  return dynamics::ModalModel{part.poles, part.right.row(row), part.left.row(row), part.scaling, residual, {*at}};
}

}  // namespace

void write_damping_frf(const std::filesystem::path& file, const setup::MeasuredFrf& measured,
                       const dynamics::ModalModel& part) {
  const std::optional<dynamics::ModalModel> there = seen_at(part, measured.response);
  if (!there || measured.force != measured.response) return;
  const io::MeasuredFrf& frf = setup::receptance_of(measured);
  const Eigen::VectorXcd synthesised =
      dynamics::entry(dynamics::to_response(*there, frf.axis), measured.response, measured.force);
  const std::string entry = measured.response + "/" + measured.force + " m/N";
  io::Table table{{"frequency_hz", list_of(frf.axis.hz)},
                  {"re " + entry, list_of(frf.H.real())},
                  {"im " + entry, list_of(frf.H.imag())}};
  const Eigen::VectorXd coherence = io::coherence_on(frf, frf.axis);
  if (coherence.size() > 0)
    table.push_back({"coherence " + measured.response + "/" + measured.force, list_of(coherence)});
  table.push_back({"synthesised re " + entry, list_of(synthesised.real())});
  table.push_back({"synthesised im " + entry, list_of(synthesised.imag())});
  io::write_csv(file, table,
                {"the driving point that the damping of the part was taken from, as measured; synthesised: that of the "
                 "part with the damping that was found"});
}

}  // namespace thinwall::report
