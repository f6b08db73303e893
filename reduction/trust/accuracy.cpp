#include "reduction/trust/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/dense_factorisations.hpp"
#include "core/interrupt.hpp"
#include "dynamics/conversion.hpp"
#include "linalg/sparse_indefinite.hpp"
#include "linalg/tall.hpp"
#include "reduction/trust/receptance_sum.hpp"
#include "reduction/worst.hpp"

namespace thinwall::reduction {

double max_relative_frequency_error(const dynamics::SpatialModel& reduced, const Eigen::VectorXd& full_hz, int rigid) {
  const dynamics::UndampedModes modes = dynamics::undamped_modes(reduced);
  const Eigen::Index count = std::min<Eigen::Index>(full_hz.size(), modes.omega_rad_s.size() - rigid);
  double worst = 0.0;
  for (Eigen::Index k = 0; k < count; ++k) {
    const double hz = modes.omega_rad_s(k + rigid) / (2.0 * std::numbers::pi);
    const double error = std::abs(hz - full_hz(k)) / full_hz(k);
    worst = worse_of(worst, error);
  }
  return worst;
}

std::vector<ErrorBySize> frequency_error_by_size(const CraigBampton& reduced, const Eigen::VectorXd& full_hz,
                                                 int rigid) {
  const auto all = static_cast<int>(reduced.fixed_interface_hz.size());
  const auto interface = static_cast<int>(reduced.model.size()) - all;
  std::vector<ErrorBySize> result;
  for (int step = 1; step <= 8; ++step) {
    const int modes = static_cast<int>(std::lround(all * std::pow(0.125 * step, 1.5)));
    const bool enough = interface + modes - rigid >= full_hz.size();
    if (!enough || (!result.empty() && result.back().modes == modes)) continue;
    const int n = interface + modes;
    dynamics::SpatialModel cut = reduced.model;
    for (Eigen::MatrixXd* matrix : {&cut.M, &cut.C, &cut.K}) matrix->conservativeResize(n, n);
    cut.dofs.resize(static_cast<std::size_t>(n));
    result.push_back({modes, max_relative_frequency_error(cut, full_hz, rigid)});
  }
  return result;
}

std::vector<FullReceptance> full_receptances(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                                             const std::vector<int>& node_of_row, const Interface& interface,
                                             const std::vector<double>& frequencies_hz) {
  std::vector<FullReceptance> result;
  const Eigen::MatrixXd W = interface.W;
  for (const double hz : frequencies_hz) {
    core::check_interrupt();
    const double omega = 2.0 * std::numbers::pi * hz;
    const linalg::SparseMatrix Z = linalg::combine(1.0, K, -omega * omega, M);
    const auto solution = linalg::SparseIndefinite(Z, node_of_row).solve(W);
    const Eigen::MatrixXd H = interface.W.transpose() * solution.X;
    const Eigen::MatrixXd R = linalg::symmetric_product(Z, solution.X) - W;
    const Eigen::MatrixXd wrong = (solution.X.transpose() * R).cwiseAbs() + residual_round_off(K, M, omega, solution.X);
    const double error = wrong.maxCoeff<Eigen::PropagateNaN>() / H.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    result.push_back({hz, H, solution.relative_residual, error});
  }
  return result;
}

std::vector<double> frequencies_between(const Eigen::VectorXd& natural_hz, double from_hz, double to_hz, int count) {
  std::vector<double> edges{from_hz};
  for (const double hz : natural_hz) {
    if (hz > from_hz && hz < to_hz) edges.push_back(hz);
  }
  edges.push_back(to_hz);
  std::vector<std::pair<double, double>> gaps;  // width on a logarithmic scale, middle
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    gaps.emplace_back(std::log(edges[i + 1] / edges[i]), std::sqrt(edges[i] * edges[i + 1]));
  }
  std::sort(gaps.rbegin(), gaps.rend());
  std::vector<double> chosen;
  for (const auto& [width, middle] : gaps) {
    if (static_cast<int>(chosen.size()) < count) chosen.push_back(middle);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

double max_relative_receptance_error(const dynamics::SpatialModel& reduced, const std::vector<FullReceptance>& full) {
  double worst = 0.0;
  for (const FullReceptance& line : full) {
    const double omega = 2.0 * std::numbers::pi * line.frequency_hz;
    const Eigen::Index nb = line.H.rows();
    const Eigen::MatrixXd B = displacements(reduced).topRows(nb);
    const Eigen::MatrixXd H = B * (reduced.K - omega * omega * reduced.M).partialPivLu().solve(B.transpose());
    const double error =
        (H - line.H).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() / line.H.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    worst = worse_of(worst, error);
  }
  return worst;
}

}  // namespace thinwall::reduction
