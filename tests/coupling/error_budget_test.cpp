// Errors of the components in the coupled response: closed forms, differences and samples.

#include "coupling/error_budget.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "masses.hpp"

namespace thinwall::coupling::error_budget_test {
namespace {

using namespace testing;
using Complex = std::complex<double>;
using dynamics::ResponseModel;
using Eigen::Index;

const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
constexpr Mass part_mass{0.8, 3.0, 1.4e6};
constexpr Mass robot_mass{51.2, 373.0, 1.7e6};

TEST(ErrorBudget, TwoMassesHaveTheirClosedForm) {
  // G_PP = H_P H_R/(H_P + H_R): ∂G/∂H_P = (H_R/(H_P + H_R))², ∂G/∂H_R = (H_P/(H_P + H_R))².
  const auto axis = dynamics::linear_axis(5.0, 400.0, 40);
  const ResponseModel P = response(part_mass, "P", axis), R = response(robot_mass, "R", axis);
  const std::vector<ComponentError> errors{{relative_deviations(P, 0.02), {}}, {relative_deviations(R, 0.05), {}}};
  const ErrorBudget budget = error_budget({P, R}, {{"P", "R", {{x}}, {}}}, errors);
  for (std::size_t line = 0; line < P.H.size(); ++line) {
    const Complex p = P.H[line](0, 0), r = R.H[line](0, 0);
    const double by_P = std::norm(r / (p + r)) * 0.02 * std::abs(p);
    const double by_R = std::norm(p / (p + r)) * 0.05 * std::abs(r);
    EXPECT_NEAR(budget.noise[line](0, 0) / std::hypot(by_P, by_R), 1.0, 1e-9);
    EXPECT_EQ(budget.truncation[line](0, 0), 0.0);
  }
}

/// Three components at three points, x and y acting on each other, one spring with loss and two rigid directions.
struct Chain {
  dynamics::FrequencyAxis axis = dynamics::linear_axis(30.0, 300.0, 4);
  std::vector<ResponseModel> components;
  std::vector<Contact> contacts{{"a1", "b0", {{x}, {y, 4e6, 20.0, 0.05}}, {}}, {"b1", "c0", {{y}}, {}}};

  Chain() {
    int seed = 1;
    for (const std::string& name : {std::string("a"), std::string("b"), std::string("c")}) {
      dynamics::SpatialModel model;
      for (const char* point : {"0", "1"}) {
        for (const Eigen::Vector3d& e : {x, y}) model.dofs.push_back({name + point, e, dynamics::DofKind::translation});
      }
      std::srand(static_cast<unsigned>(seed++));
      const Eigen::Matrix4d A = Eigen::Matrix4d::Random(), B = Eigen::Matrix4d::Random();
      model.M = 2.0 * Eigen::Matrix4d::Identity() + 0.3 * A * A.transpose();
      model.K = 1e6 * (Eigen::Matrix4d::Identity() + B * B.transpose());
      model.C = 2e-4 * model.K;
      components.push_back(dynamics::direct_response(model, axis));
    }
  }
  [[nodiscard]] std::vector<ComponentError> noise(double share) const {
    std::vector<ComponentError> errors(3);
    for (std::size_t c = 0; c < 3; ++c) errors[c].noise = relative_deviations(components[c], share);
    return errors;
  }
};

Eigen::MatrixXcd side_by_side(const Chain& chain, std::size_t line) {
  Eigen::MatrixXcd Y = Eigen::MatrixXcd::Zero(12, 12);
  for (Index c = 0; c < 3; ++c) Y.block<4, 4>(4 * c, 4 * c) = chain.components[static_cast<std::size_t>(c)].H[line];
  return Y;
}

TEST(CouplingSensitivity, BothFactorsGiveTheCoupledResponse) {
  Chain chain;
  const CouplingSensitivity flexible = coupling_sensitivity(chain.components, chain.contacts);
  const CoupledResponse coupled = couple(chain.components, chain.contacts);
  chain.contacts[0].springs[1] = {y};
  const CouplingSensitivity rigid = coupling_sensitivity(chain.components, chain.contacts);
  for (std::size_t line = 0; line < 4; ++line) {
    const Eigen::MatrixXcd Y = side_by_side(chain, line), G = coupled.response.H[line];
    EXPECT_LT((flexible.P[line] * Y - G).norm(), 1e-11 * G.norm());
    EXPECT_LT((Y * flexible.Q[line] - G).norm(), 1e-11 * G.norm());
    EXPECT_LT((rigid.P[line] * rigid.P[line] - rigid.P[line]).norm(), 1e-11 * rigid.P[line].norm());
    EXPECT_LT((rigid.Q[line] * rigid.Q[line] - rigid.Q[line]).norm(), 1e-11 * rigid.Q[line].norm());
    EXPECT_NEAR(std::abs(rigid.P[line].trace() - 9.0), 0.0, 1e-10) << "twelve DOFs, three constraints";
  }
}

TEST(ErrorBudget, TruncationIsTheDifferenceThatItMakesToFirstOrder) {
  const Chain chain;
  const CoupledResponse exact = couple(chain.components, chain.contacts);
  double previous = 0.0;
  for (const double size : {1e-3, 1e-4}) {
    auto off = chain.components;
    std::vector<ComponentError> errors(3);
    for (std::size_t c = 0; c < 3; ++c) {
      for (Eigen::MatrixXcd& H : off[c].H) {
        errors[c].truncation.push_back(size * Complex(0.6, 0.8) * H.cwiseProduct(H.transpose().conjugate()) / H.norm());
        H += errors[c].truncation.back();
      }
    }
    const CoupledResponse other = couple(off, chain.contacts);
    const ErrorBudget budget = error_budget(chain.components, chain.contacts, errors);
    double left = 0.0;
    for (std::size_t line = 0; line < 4; ++line) {
      const Eigen::MatrixXcd difference = other.response.H[line] - exact.response.H[line];
      left = std::max(left, (difference - budget.truncation[line]).norm() / difference.norm());
    }
    EXPECT_LT(left, 30.0 * size);
    if (previous > 0.0) {
      EXPECT_NEAR(left / previous, 0.1, 0.02) << "what is left is of second order";
    }
    previous = left;
  }
}

TEST(ErrorBudget, FirstOrderAndSamplesAgreeWhereTheNoiseIsSmall) {
  const Chain chain;
  const auto errors = chain.noise(2e-3);
  constexpr int n = 4000;
  const ErrorBudget budget = error_budget(chain.components, chain.contacts, errors);
  const SampledScatter scatter = sampled_scatter(chain.components, chain.contacts, errors, n, 17);
  const CoupledResponse exact = couple(chain.components, chain.contacts);
  // 2304 variances, each known to √(2/n) = 2.2 %: the largest of so many normal numbers is 3.5 deviations, five allowed
  const double five = 5.0 / std::sqrt(n);
  for (std::size_t line = 0; line < 4; ++line) {
    const Eigen::ArrayXXd variance = budget.noise[line].array().square();
    EXPECT_LT((scatter.rr[line].array() / variance - 1.0).abs().maxCoeff(), std::sqrt(2.0) * five);
    EXPECT_LT((scatter.ii[line].array() / variance - 1.0).abs().maxCoeff(), std::sqrt(2.0) * five);
    EXPECT_LT((scatter.ri[line].array() / variance).abs().maxCoeff(), five) << "circular noise stays circular";
    const Eigen::ArrayXXd bias = (scatter.mean[line] - exact.response.H[line]).array().abs();
    EXPECT_LT((bias / budget.noise[line].array()).maxCoeff(), std::sqrt(2.0) * five + 0.02);
  }
}

TEST(ErrorBudget, TheTrueScatterIsCovered) {
  // |dG| ≤ kσ with probability 1 − e^{−k²/2}, over draws that are not those of sampled_scatter().
  const Chain chain;
  const ErrorBudget budget = error_budget(chain.components, chain.contacts, chain.noise(0.01));
  const CoupledResponse exact = couple(chain.components, chain.contacts);
  double within = 0.0;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i) {
    auto drawn = chain.components;
    for (std::size_t c = 0; c < 3; ++c) {
      drawn[c] = with_noise(drawn[c], relative_deviations(drawn[c], 0.01), static_cast<unsigned>(1000 + 3 * i) + c);
    }
    const CoupledResponse coupled = couple(drawn, chain.contacts);
    for (std::size_t line = 0; line < 4; ++line) {
      const Eigen::ArrayXXd off = (coupled.response.H[line] - exact.response.H[line]).array().abs();
      within += (off <= 2.0 * budget.noise[line].array()).cast<double>().mean() / (4.0 * n);
    }
  }
  EXPECT_NEAR(within, 1.0 - std::exp(-2.0), 0.015);
}

TEST(ErrorBudget, EntriesOfOneResponseScatterTogether) {
  const Chain chain;
  const auto errors = chain.noise(2e-3);
  const std::vector<std::string> responses{"a0.x", "c1.y"}, forces{"a0.x", "b0.y"};
  const auto covariance = entry_covariance(chain.components, chain.contacts, errors, responses, forces);
  const ErrorBudget budget = error_budget(chain.components, chain.contacts, errors);
  std::vector<Eigen::MatrixXcd> sum(4, Eigen::Matrix4cd::Zero());
  const CoupledResponse exact = couple(chain.components, chain.contacts);
  const std::vector<int> rows{dynamics::row_of(budget.responses, "a0.x"), dynamics::row_of(budget.responses, "c1.y")};
  const std::vector<int> columns{dynamics::row_of(budget.forces, "a0.x"), dynamics::row_of(budget.forces, "b0.y")};
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) {
    auto drawn = chain.components;
    for (std::size_t c = 0; c < 3; ++c)
      drawn[c] = with_noise(drawn[c], errors[c].noise, static_cast<unsigned>(5000 + 3 * i) + c);
    const CoupledResponse coupled = couple(drawn, chain.contacts);
    for (std::size_t line = 0; line < 4; ++line) {
      const Eigen::MatrixXcd off = (coupled.response.H[line] - exact.response.H[line])(rows, columns);
      sum[line] += off.reshaped() * off.reshaped().adjoint() / n;
    }
  }
  for (std::size_t line = 0; line < 4; ++line) {
    const Eigen::VectorXd deviation = covariance[line].diagonal().real().cwiseSqrt();
    const Eigen::MatrixXd scale = deviation * deviation.transpose();
    EXPECT_LT(((sum[line] - covariance[line]).array().abs() / scale.array()).maxCoeff(), 5.0 / std::sqrt(n));
    EXPECT_NEAR(deviation(2) / (std::sqrt(2.0) * budget.noise[line](rows[0], columns[1])), 1.0, 1e-10);
    EXPECT_LT((covariance[line] - covariance[line].adjoint()).norm(), 1e-14 * covariance[line].norm());
  }
}

TEST(ErrorBudget, RefusesErrorsThatFitNoComponent) {
  const Chain chain;
  const auto with = [&](std::vector<ComponentError> errors) {
    (void)error_budget(chain.components, chain.contacts, errors);
  };
  EXPECT_THROW(with({}), core::InputError);
  auto errors = chain.noise(0.01);
  errors[1].noise.pop_back();
  EXPECT_THROW(with(errors), core::InputError);
  errors = chain.noise(0.01);
  errors[2].noise[3](1, 1) = std::nan("");
  EXPECT_THROW(with(errors), core::InputError);
  errors = chain.noise(0.01);
  errors[0].truncation.assign(4, Eigen::Matrix4cd::Constant(std::nan("")));
  EXPECT_THROW(with(errors), core::InputError);
  errors[0].truncation.assign(4, Eigen::Matrix3cd::Zero());
  EXPECT_THROW(with(errors), core::InputError);
  EXPECT_THROW((void)sampled_scatter(chain.components, chain.contacts, chain.noise(0.01), 1, 1), core::InputError);
  EXPECT_THROW((void)entry_covariance(chain.components, chain.contacts, chain.noise(0.01), {"a0.z"}, {"a0.x"}),
               core::InputError);
  CouplingOptions regularised;
  regularised.regularisation = Regularisation::truncated;
  EXPECT_THROW((void)error_budget(chain.components, chain.contacts, chain.noise(0.01), regularised), core::InputError);
}

}  // namespace
}  // namespace thinwall::coupling::error_budget_test
