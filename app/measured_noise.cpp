#include "app/measured_noise.hpp"

#include <algorithm>
#include <cmath>

#include "app/measured.hpp"
#include "core/error.hpp"

namespace thinwall::app {

namespace {

/// σ = |H| √((1 − γ²)/(2nγ²)), coupling::deviations_from_coherence() of a single FRF.
Eigen::VectorXd from_coherence(const MeasuredFrf& file, const dynamics::FrequencyAxis& axis,
                               const Eigen::VectorXcd& H) {
  const Eigen::VectorXd coherence = io::coherence_on(read_measured(file), axis);
  if (coherence.size() == 0) {
    throw core::InputError("\"" + file.file.string() +
                           "\" has no coherence: give noise in place of averages, or a file with coherence");
  }
  const dynamics::Dof one{"P", Eigen::Vector3d::UnitX(), dynamics::DofKind::translation};
  dynamics::ResponseModel single{axis, {one}, {one}, {}};
  std::vector<Eigen::MatrixXd> gamma2;
  for (Eigen::Index line = 0; line < H.size(); ++line) {
    single.H.emplace_back(Eigen::MatrixXcd::Constant(1, 1, H(line)));
    gamma2.emplace_back(Eigen::MatrixXd::Constant(1, 1, coherence(line)));
  }
  const coupling::Deviations deviations = coupling::deviations_from_coherence(single, gamma2, *file.averages);
  Eigen::VectorXd sigma(H.size());
  for (Eigen::Index line = 0; line < H.size(); ++line) sigma(line) = deviations[static_cast<std::size_t>(line)](0, 0);
  return sigma;
}

/// The file that the entry (response, force) was taken from: its own, else that of its transpose.
const MeasuredFrf* file_of(const std::vector<MeasuredFrf>& files, const std::string& response,
                           const std::string& force) {
  const auto of = [&](const std::string& a, const std::string& b) {
    const auto found =
        std::ranges::find_if(files, [&](const MeasuredFrf& f) { return f.response == a && f.force == b; });
    return found == files.end() ? nullptr : &*found;
  };
  if (files.size() == 1) return &files.front();
  const MeasuredFrf* own = of(response, force);
  return own != nullptr ? own : of(force, response);
}

}  // namespace

std::optional<Eigen::VectorXd> deviation_of(const MeasuredFrf& file, const dynamics::FrequencyAxis& axis,
                                            const Eigen::VectorXcd& H) {
  if (file.noise) return *file.noise * H.cwiseAbs();
  if (file.averages) return from_coherence(file, axis, H);
  return std::nullopt;
}

coupling::Deviations measured_deviations(const std::vector<MeasuredFrf>& files,
                                         const dynamics::ResponseModel& response) {
  if (std::ranges::none_of(files, [](const MeasuredFrf& f) { return f.noise || f.averages; })) return {};
  const auto rows = static_cast<Eigen::Index>(response.responses.size());
  const auto columns = static_cast<Eigen::Index>(response.forces.size());
  coupling::Deviations deviations(response.H.size(), Eigen::MatrixXd::Zero(rows, columns));
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) {
      const std::string by = dynamics::name(response.responses[static_cast<std::size_t>(i)]);
      const MeasuredFrf* file = file_of(files, by, dynamics::name(response.forces[static_cast<std::size_t>(j)]));
      Eigen::VectorXcd H(response.axis.size());
      for (Eigen::Index line = 0; line < H.size(); ++line) H(line) = response.H[static_cast<std::size_t>(line)](i, j);
      const auto sigma = file == nullptr ? std::nullopt : deviation_of(*file, response.axis, H);
      if (!sigma) continue;
      for (Eigen::Index line = 0; line < H.size(); ++line)
        deviations[static_cast<std::size_t>(line)](i, j) = (*sigma)(line);
    }
  }
  return deviations;
}

}  // namespace thinwall::app
