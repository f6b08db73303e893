#include "setup/measured_noise.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "io/frf/resample.hpp"
#include "setup/measured.hpp"
#include "setup/measured_layout.hpp"

namespace thinwall::setup {

namespace {

/// The file's coherence on `axis`; throws unless there is one that a noise follows from.
Eigen::VectorXd coherence_of(const MeasuredFrf& file, const dynamics::FrequencyAxis& axis) {
  Eigen::VectorXd coherence = io::coherence_on(receptance_of(file), axis);
  if (coherence.size() == 0) {
    throw core::InputError("\"" + file.file.string() +
                           "\" has no coherence: give noise in place of averages, or a file with coherence");
  }
  return coherence;
}

/// σ = |H| √((1 − γ²)/(2nγ²)), coupling::deviations_from_coherence() of a single FRF.
Eigen::VectorXd from_coherence(const Eigen::VectorXd& coherence, int averages, const dynamics::FrequencyAxis& axis,
                               const Eigen::VectorXcd& H) {
  const dynamics::Dof one{"P", Eigen::Vector3d::UnitX(), dynamics::DofKind::translation};
  dynamics::ResponseModel single{axis, {one}, {one}, {}};
  std::vector<Eigen::MatrixXd> gamma2;
  for (Eigen::Index line = 0; line < H.size(); ++line) {
    single.H.emplace_back(Eigen::MatrixXcd::Constant(1, 1, H(line)));
    gamma2.emplace_back(Eigen::MatrixXd::Constant(1, 1, coherence(line)));
  }
  const coupling::Deviations deviations = coupling::deviations_from_coherence(single, gamma2, averages);
  Eigen::VectorXd sigma(H.size());
  for (Eigen::Index line = 0; line < H.size(); ++line) sigma(line) = deviations[static_cast<std::size_t>(line)](0, 0);
  return sigma;
}

Eigen::VectorXcd entry_of(const dynamics::ResponseModel& response, Eigen::Index i, Eigen::Index j) {
  Eigen::VectorXcd H(response.axis.size());
  for (Eigen::Index line = 0; line < H.size(); ++line) H(line) = response.H[static_cast<std::size_t>(line)](i, j);
  return H;
}

}  // namespace

std::optional<Eigen::VectorXd> deviation_of(const MeasuredFrf& file, const dynamics::FrequencyAxis& axis,
                                            const Eigen::VectorXcd& H) {
  if (file.noise) return *file.noise * H.cwiseAbs();
  if (file.averages) return from_coherence(coherence_of(file, axis), *file.averages, axis, H);
  return std::nullopt;
}

coupling::Deviations measured_deviations(const std::vector<MeasuredFrf>& files,
                                         const dynamics::ResponseModel& response) {
  if (!any_noise(files)) return {};
  const auto rows = static_cast<Eigen::Index>(response.responses.size());
  const Eigen::MatrixXi file_of =
      files.size() == 1 ? Eigen::MatrixXi::Zero(rows, rows) : Eigen::MatrixXi(measured_layout(files).file);
  if (file_of.rows() != rows || static_cast<Eigen::Index>(response.forces.size()) != rows)
    throw core::InputError("noise of measured FRFs: the response is not the matrix that their files make");
  coupling::Deviations deviations(response.H.size(), Eigen::MatrixXd::Zero(rows, rows));
  for (std::size_t number = 0; number < files.size(); ++number) {
    for (Eigen::Index j = 0; j < rows; ++j) {
      for (Eigen::Index i = 0; i < rows; ++i) {
        if (file_of(i, j) != static_cast<int>(number)) continue;
        const auto sigma = deviation_of(files[number], response.axis, entry_of(response, i, j));
        if (!sigma) continue;
        for (Eigen::Index line = 0; line < sigma->size(); ++line)
          deviations[static_cast<std::size_t>(line)](i, j) = (*sigma)(line);
      }
    }
  }
  return deviations;
}

bool any_noise(const std::vector<MeasuredFrf>& files) {
  return std::ranges::any_of(files, [](const MeasuredFrf& f) { return f.noise || f.averages; });
}

std::string fault_of_coherence(const MeasuredFrf& file) {
  try {
    const io::MeasuredFrf& frf = receptance_of(file);
    const Eigen::VectorXd coherence = coherence_of(file, frf.axis);
    Eigen::Index line = 0;
    if (coherence.minCoeff(&line) > 0.0 && coherence.maxCoeff() <= 1.0) return "";
    if (coherence(line) > 0.0) return "the file's coherence is above 1 at some line; correct the file";
    return "the file's coherence is 0 at " + std::to_string(frf.axis.hz(line)) +
           " Hz: nothing was measured there; leave out such lines, or give noise in place of averages";
  } catch (const core::Error& error) {
    return error.what();
  }
}

}  // namespace thinwall::setup
