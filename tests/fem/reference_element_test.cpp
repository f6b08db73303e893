#include "fem/reference_element.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/error.hpp"
#include "mesh/lagrange_nodes.hpp"

namespace thinwall::fem::reference_element_test {
namespace {

Eigen::MatrixXd derivative_product(const ReferenceElement& element, int k, int l) {
  const Eigen::VectorXd entries = element.stiffness.row(3 * k + l);
  return entries.reshaped(element.nodes, element.nodes);
}

TEST(ShapeFunctions, AreOneAtTheirNodeAndNoughtAtTheOthers) {
  for (int p = 1; p <= 6; ++p) {
    const auto alphas = mesh::lattice(p);
    for (std::size_t a = 0; a < alphas.size(); ++a) {
      Eigen::Vector4d lambda;
      for (std::size_t k = 0; k < 4; ++k) lambda(static_cast<Eigen::Index>(k)) = static_cast<double>(alphas[a][k]) / p;
      Eigen::VectorXd N = shape_functions(p, lambda);
      N(static_cast<Eigen::Index>(a)) -= 1.0;
      EXPECT_LT(N.cwiseAbs().maxCoeff(), 1e-13) << "order " << p << ", node " << a;
    }
  }
}

TEST(ShapeFunctions, SumToOneAndReproduceThePosition) {
  std::mt19937 random(1);
  std::exponential_distribution<double> share(1.0);
  for (int p = 1; p <= 6; ++p) {
    const auto alphas = mesh::lattice(p);
    for (int sample = 0; sample < 20; ++sample) {
      Eigen::Vector4d lambda(share(random), share(random), share(random), share(random));
      lambda /= lambda.sum();
      const Eigen::VectorXd N = shape_functions(p, lambda);
      EXPECT_NEAR(N.sum(), 1.0, 1e-13);
      Eigen::Vector4d position = Eigen::Vector4d::Zero();
      for (std::size_t a = 0; a < alphas.size(); ++a) {
        for (std::size_t k = 0; k < 4; ++k) {
          position(static_cast<Eigen::Index>(k)) += N(static_cast<Eigen::Index>(a)) * alphas[a][k] / p;
        }
      }
      EXPECT_LT((position - lambda).norm(), 1e-13);
    }
  }
}

TEST(ReferenceElement, MassSumsToOneAndIsSymmetric) {
  for (int p = 1; p <= 6; ++p) {
    const ReferenceElement& element = reference_element(p);
    EXPECT_EQ(element.nodes, (p + 1) * (p + 2) * (p + 3) / 6);
    EXPECT_NEAR(element.mass.sum(), 1.0, 1e-14) << "order " << p;
    EXPECT_LT((element.mass - element.mass.transpose()).cwiseAbs().maxCoeff(), 1e-18) << "order " << p;
    // Row sums are the mean values of the shape functions; with Σ N = 1 the mass of a constant is exact.
    const Eigen::VectorXd mean = element.mass.rowwise().sum();
    EXPECT_NEAR(mean.sum(), 1.0, 1e-14);
  }
}

TEST(ReferenceElement, DerivativesOfAConstantVanishAndOfALinearFieldAreOne) {
  for (int p = 1; p <= 6; ++p) {
    const ReferenceElement& element = reference_element(p);
    const auto alphas = mesh::lattice(p);
    Eigen::MatrixXd xi(element.nodes, 3);  // the field ξ_k at the nodes
    for (std::size_t a = 0; a < alphas.size(); ++a) {
      for (std::size_t k = 0; k < 3; ++k) {
        xi(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(k)) = static_cast<double>(alphas[a][k + 1]) / p;
      }
    }
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l) {
        const Eigen::MatrixXd D = derivative_product(element, k, l);
        EXPECT_LT(D.rowwise().sum().cwiseAbs().maxCoeff(), 1e-12) << "order " << p;
        EXPECT_LT((D - derivative_product(element, l, k).transpose()).cwiseAbs().maxCoeff(),
                  1e-15 * D.cwiseAbs().maxCoeff());
        // ∂ξ_i/∂ξ_k ∂ξ_j/∂ξ_l = δ_ik δ_jl.
        Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
        expected(k, l) = 1.0;
        EXPECT_LT((xi.transpose() * D * xi - expected).cwiseAbs().maxCoeff(), 1e-12) << "order " << p;
      }
    }
  }
}

TEST(ReferenceElement, LinearMassIsATwentiethTimesOnePlusDelta) {
  const Eigen::MatrixXd expected = (Eigen::MatrixXd::Ones(4, 4) + Eigen::MatrixXd::Identity(4, 4)) / 20.0;
  EXPECT_LT((reference_element(1).mass - expected).cwiseAbs().maxCoeff(), 1e-17);
}

// The consistent mass of the ten-node tetrahedron, ρV/420 times: corner 6, two corners 1, a corner with the middle of
// an edge that meets it −4 and that does not −6, a middle 32, two middles of edges that share a corner 16, of opposite
// edges 8 (Zienkiewicz & Taylor, The Finite Element Method, by ∫ λ^γ dV).
TEST(ReferenceElement, QuadraticMassIsThePublishedOne) {
  const auto alphas = mesh::lattice(2);
  const ReferenceElement& element = reference_element(2);
  const auto shared = [&](std::size_t a, std::size_t b) {
    int corners = 0;
    for (std::size_t k = 0; k < 4; ++k) corners += alphas[a][k] > 0 && alphas[b][k] > 0 ? 1 : 0;
    return corners;
  };
  for (std::size_t a = 0; a < 10; ++a) {
    for (std::size_t b = 0; b < 10; ++b) {
      double expected = 0.0;
      if (a < 4 && b < 4) {
        expected = a == b ? 6.0 : 1.0;
      } else if (a < 4 || b < 4) {
        expected = shared(a, b) == 1 ? -4.0 : -6.0;
      } else {
        expected = a == b ? 32.0 : (shared(a, b) == 1 ? 16.0 : 8.0);
      }
      EXPECT_NEAR(420.0 * element.mass(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)), expected, 1e-12);
    }
  }
}

TEST(ReferenceElement, OrdersOutsideOneToSixAreRefused) {
  EXPECT_THROW((void)reference_element(0), core::InputError);
  EXPECT_THROW((void)reference_element(7), core::InputError);
}

}  // namespace
}  // namespace thinwall::fem::reference_element_test
