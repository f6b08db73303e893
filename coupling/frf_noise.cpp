#include "coupling/frf_noise.hpp"

#include <cmath>
#include <random>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::coupling {

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw core::InputError("noise of measured responses: " + what);
}

/// Throws InputError unless there is one matrix for each line with the shape of H and within(entry) is true for every
/// entry; `bound` describes that condition in the message.
template <typename Within>
void require_entries(const std::vector<Eigen::MatrixXd>& values, const dynamics::ResponseModel& model,
                     const std::string& name, const std::string& bound, Within within) {
  if (values.size() != model.H.size()) {
    refuse(std::to_string(values.size()) + " lines of " + name + " for " + std::to_string(model.H.size()) +
           " lines of the response; give one matrix a line");
  }
  for (std::size_t line = 0; line < values.size(); ++line) {
    std::ostringstream where;
    where << name << " at " << model.axis.hz(static_cast<Eigen::Index>(line)) << " Hz ";
    const Eigen::MatrixXd& value = values[line];
    if (value.rows() != model.H[line].rows() || value.cols() != model.H[line].cols()) {
      where << "is " << value.rows() << " x " << value.cols() << ", the response " << model.H[line].rows() << " x "
            << model.H[line].cols() << ": they must be alike";
      refuse(where.str());
    }
    for (const double entry : value.reshaped()) {
      if (within(entry)) continue;
      where << "is " << entry << ": it must be " << bound;
      refuse(where.str());
    }
  }
}

}  // namespace

void require_valid(const Deviations& deviations, const dynamics::ResponseModel& model) {
  require_entries(deviations, model, "the standard deviation", "finite and not negative",
                  [](double value) { return std::isfinite(value) && value >= 0.0; });
}

Deviations relative_deviations(const dynamics::ResponseModel& model, double share) {
  dynamics::require_complete(model);
  if (!(share >= 0.0 && std::isfinite(share))) {
    refuse("the share of the modulus is " + std::to_string(share) + ": it must be finite and not negative");
  }
  Deviations deviations;
  deviations.reserve(model.H.size());
  for (const Eigen::MatrixXcd& H : model.H) deviations.emplace_back(share * H.cwiseAbs());
  return deviations;
}

Deviations deviations_from_coherence(const dynamics::ResponseModel& model,
                                     const std::vector<Eigen::MatrixXd>& coherence, int averages) {
  dynamics::require_complete(model);
  if (averages < 1) refuse(std::to_string(averages) + " averages: there must be at least 1");
  require_entries(coherence, model, "the coherence", "above 0 and at most 1; leave the line out",
                  [](double value) { return value > 0.0 && value <= 1.0; });
  Deviations deviations;
  deviations.reserve(model.H.size());
  for (std::size_t line = 0; line < model.H.size(); ++line) {
    const Eigen::ArrayXXd gamma2 = coherence[line].array();
    deviations.emplace_back(model.H[line].cwiseAbs().array() *
                            ((1.0 - gamma2) / (2.0 * static_cast<double>(averages) * gamma2)).sqrt());
  }
  return deviations;
}

dynamics::ResponseModel with_noise(dynamics::ResponseModel model, const Deviations& deviations, std::uint64_t seed) {
  require_valid(deviations, model);
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  for (std::size_t line = 0; line < model.H.size(); ++line) {
    const Eigen::MatrixXd& sigma = deviations[line];
    for (Eigen::Index j = 0; j < sigma.cols(); ++j) {
      for (Eigen::Index i = 0; i < sigma.rows(); ++i) {
        const double a = normal(generator);
        const double b = normal(generator);
        model.H[line](i, j) += sigma(i, j) * std::complex<double>(a, b);
      }
    }
  }
  return model;
}

}  // namespace thinwall::coupling
