#include "coupling/error_budget.hpp"

#include "core/error.hpp"

namespace thinwall::coupling {

namespace {

using dynamics::ResponseModel;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

void require_fitting(const std::vector<ComponentError>& errors, const std::vector<ResponseModel>& components) {
  if (errors.size() != components.size()) {
    throw core::InputError("error budget: errors of " + std::to_string(errors.size()) + " components for " +
                           std::to_string(components.size()) + "; give one each, empty where a component is exact");
  }
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (!errors[c].noise.empty()) require_valid(errors[c].noise, components[c]);
    const auto& truncation = errors[c].truncation;
    bool alike = truncation.empty() || truncation.size() == components[c].H.size();
    for (std::size_t line = 0; alike && line < truncation.size(); ++line) {
      const MatrixXcd& H = components[c].H[line];
      alike =
          truncation[line].rows() == H.rows() && truncation[line].cols() == H.cols() && truncation[line].allFinite();
    }
    if (alike) continue;
    throw core::InputError("error budget: the truncation of component " + std::to_string(c + 1) +
                           " is not finite or has not the shape of its response");
  }
}

/// Calls visit(c, row, column) for every component c with the place of its block in Y.
template <typename Visit>
void for_blocks(const std::vector<ResponseModel>& components, std::size_t line, Visit visit) {
  Index row = 0, column = 0;
  for (std::size_t c = 0; c < components.size(); ++c) {
    visit(c, row, column);
    row += components[c].H[line].rows();
    column += components[c].H[line].cols();
  }
}

}  // namespace

ErrorBudget error_budget(const std::vector<ResponseModel>& components, const std::vector<Contact>& contacts,
                         const std::vector<ComponentError>& errors, const CouplingOptions& options) {
  require_fitting(errors, components);
  const CouplingSensitivity to = coupling_sensitivity(components, contacts, options);
  ErrorBudget budget{to.responses, to.forces, {}, {}};
  for (std::size_t line = 0; line < to.P.size(); ++line) {
    MatrixXd variance = MatrixXd::Zero(to.P[line].rows(), to.Q[line].cols());
    MatrixXcd truncation = MatrixXcd::Zero(variance.rows(), variance.cols());
    for_blocks(components, line, [&](std::size_t c, Index row, Index column) {
      const MatrixXcd& H = components[c].H[line];
      const auto P = to.P[line].middleCols(row, H.rows());
      const auto Q = to.Q[line].middleRows(column, H.cols());
      if (!errors[c].noise.empty()) variance += P.cwiseAbs2() * errors[c].noise[line].cwiseAbs2() * Q.cwiseAbs2();
      if (!errors[c].truncation.empty()) truncation += P * errors[c].truncation[line] * Q;
    });
    budget.noise.emplace_back(variance.cwiseSqrt());
    budget.truncation.push_back(std::move(truncation));
  }
  return budget;
}

std::vector<MatrixXcd> entry_covariance(const std::vector<ResponseModel>& components,
                                        const std::vector<Contact>& contacts, const std::vector<ComponentError>& errors,
                                        const std::vector<std::string>& responses,
                                        const std::vector<std::string>& forces, const CouplingOptions& options) {
  require_fitting(errors, components);
  const CouplingSensitivity to = coupling_sensitivity(components, contacts, options);
  std::vector<int> rows, columns;
  for (const std::string& name : responses) rows.push_back(dynamics::row_of(to.responses, name));
  for (const std::string& name : forces) columns.push_back(dynamics::row_of(to.forces, name));
  const auto size = static_cast<Index>(rows.size() * columns.size());
  std::vector<MatrixXcd> covariance(to.P.size(), MatrixXcd::Zero(size, size));
  for (std::size_t line = 0; line < to.P.size(); ++line) {
    const MatrixXcd P = to.P[line](rows, Eigen::all), Q = to.Q[line](Eigen::all, columns);
    for_blocks(components, line, [&](std::size_t c, Index row, Index column) {
      if (errors[c].noise.empty()) return;
      const MatrixXd& sigma = errors[c].noise[line];
      for (Index l = 0; l < sigma.cols(); ++l) {
        for (Index k = 0; k < sigma.rows(); ++k) {
          const MatrixXcd by_entry = P.col(row + k) * Q.row(column + l);
          covariance[line] += 2.0 * sigma(k, l) * sigma(k, l) * by_entry.reshaped() * by_entry.reshaped().adjoint();
        }
      }
    });
  }
  return covariance;
}

SampledScatter sampled_scatter(const std::vector<ResponseModel>& components, const std::vector<Contact>& contacts,
                               const std::vector<ComponentError>& errors, int samples, std::uint64_t seed,
                               const CouplingOptions& options) {
  require_fitting(errors, components);
  if (samples < 2) throw core::InputError("error budget: " + std::to_string(samples) + " samples; take at least 2");
  // The sums are of differences from G without noise, so that the variance does not suffer from cancellation.
  const CoupledResponse exact = couple(components, contacts, options);
  const std::size_t lines = exact.response.H.size();
  const MatrixXcd none = MatrixXcd::Zero(exact.response.H[0].rows(), exact.response.H[0].cols());
  SampledScatter scatter{exact.response.responses,
                         exact.response.forces,
                         std::vector<MatrixXcd>(lines, none),
                         std::vector<MatrixXd>(lines, none.real()),
                         std::vector<MatrixXd>(lines, none.real()),
                         std::vector<MatrixXd>(lines, none.real())};
  for (int i = 0; i < samples; ++i) {
    std::vector<ResponseModel> drawn = components;
    for (std::size_t c = 0; c < components.size(); ++c) {
      if (errors[c].noise.empty()) continue;
      drawn[c] = with_noise(std::move(drawn[c]), errors[c].noise, seed++);
    }
    const CoupledResponse coupled = couple(drawn, contacts, options);
    for (std::size_t line = 0; line < lines; ++line) {
      const MatrixXcd off = coupled.response.H[line] - exact.response.H[line];
      scatter.mean[line] += off;
      scatter.rr[line] += off.real().cwiseAbs2();
      scatter.ri[line] += off.real().cwiseProduct(off.imag());
      scatter.ii[line] += off.imag().cwiseAbs2();
    }
  }
  const double n = samples;
  for (std::size_t line = 0; line < lines; ++line) {
    MatrixXcd& mean = scatter.mean[line];
    mean /= n;
    scatter.rr[line] = (scatter.rr[line] - n * mean.real().cwiseAbs2()) / (n - 1.0);
    scatter.ri[line] = (scatter.ri[line] - n * mean.real().cwiseProduct(mean.imag())) / (n - 1.0);
    scatter.ii[line] = (scatter.ii[line] - n * mean.imag().cwiseAbs2()) / (n - 1.0);
    mean += exact.response.H[line];
  }
  return scatter;
}

}  // namespace thinwall::coupling
