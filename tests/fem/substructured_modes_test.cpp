#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "fem/modes.hpp"
#include "fem/supports.hpp"
#include "fem/to_tolerance.hpp"
#include "linalg/substructures/substructured_eigenpairs.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::fem::substructured_modes_test {
namespace {

/// A steel plate, clamped at one edge or free.
Model plate(bool clamped, const Eigen::Vector3d& size = {0.3, 0.2, 0.006}) {
  std::vector<Support> supports;
  if (clamped) supports.push_back({"edge", mesh::PlaneRegion{{0, 0, 0}, {1, 0, 0}}, {0, 1, 2}});
  return supported_model(mesh::kuhn_box(size, {20, 13, 1}), 2, {210e9, 0.3, 7850.0}, supports);
}

TEST(SubstructuredModes, TheFrequenciesOfAPlateAreTheDirectOnesWithinTheirEstimate) {
  for (const bool clamped : {true, false}) {
    const Model model = plate(clamped);
    const Factored factored = factorise(model);
    const Modes direct = modes(model, factored, {.count = 40, .up_to_hz = {}});
    for (const int domains : {2, 4}) {
      const auto found = linalg::substructured_eigenpairs(model.K, model.M, {{}, factored.sigma},
                                                          {.count = 40 + model.rigid_motions, .domains = domains});
      ASSERT_EQ(found.pairs.status, linalg::EigenStatus::converged);
      EXPECT_LE(found.error.maxCoeff(), 1e-3);
      for (Eigen::Index k = model.rigid_motions; k < found.pairs.lambda.size(); ++k) {
        const double error = std::abs(std::sqrt(found.pairs.lambda(k) / direct.pairs.lambda(k)) - 1.0);
        EXPECT_LE(error, found.error(k)) << k << (clamped ? " clamped " : " free ") << domains;
      }
    }
  }
}

TEST(SubstructuredModes, ModesOfAPartAreFoundByThemAndTold) {
  std::vector<std::string> told;
  const auto before =
      core::set_message_listener([&](core::MessageLevel, const std::string& text) { told.push_back(text); });
  const Model model = plate(false);
  const Factored factored = factorise(model);
  const Modes direct = modes(model, factored, {.count = 20, .up_to_hz = {}});
  const Modes found = modes(model, factored, {.count = 20, .substructures = 4});
  const double bound = 1.001 * direct.frequency_hz(25);
  const Modes below = modes(model, factored, {.substructures = 2, .up_to_hz = bound});
  (void)core::set_message_listener(before);
  EXPECT_EQ(found.rigid_motions, 6);
  ASSERT_EQ(found.frequency_hz.size(), 26);
  ASSERT_EQ(below.frequency_hz.size(), 26);
  for (Eigen::Index k = 6; k < 26; ++k) {
    EXPECT_NEAR(found.frequency_hz(k) / direct.frequency_hz(k), 1.0, 1e-5) << k;
    EXPECT_NEAR(below.frequency_hz(k) / direct.frequency_hz(k), 1.0, 1e-5) << k;
  }
  ASSERT_EQ(told.size(), 2U);
  EXPECT_NE(told[0].find("modes from 4 substructures: "), std::string::npos) << told[0];
  EXPECT_THROW((void)modes(model, factored, {.count = 20, .substructures = 6}), core::InputError);
}

/// The messages that were told while the body ran.
template <class Body>
std::vector<std::string> told_by(const Body& body) {
  std::vector<std::string> told;
  const auto before =
      core::set_message_listener([&](core::MessageLevel, const std::string& text) { told.push_back(text); });
  body();
  (void)core::set_message_listener(before);
  return told;
}

TEST(SubstructuredModes, AWallTooThinForTheToleranceInDoublesConverges) {
  const Model model = plate(true, {0.4, 0.25, 0.0005});
  const Factored factored = factorise(model);
  const auto told = told_by([&] {
    const Modes found = modes(model, factored, {.count = 6, .substructures = 2, .up_to_hz = {}});
    EXPECT_GT(found.round_off, 1e-5);
  });
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("modes from 2 substructures: "), std::string::npos) << told[0];
}

TEST(SubstructuredModes, TheirErrorIsInTheEstimateOfTheMesh) {
  const auto plate_of = [](int order) {
    return supported_model(mesh::kuhn_box({0.3, 0.2, 0.006}, {12, 8, 1}), order, {210e9, 0.3, 7850.0},
                           {{"edge", mesh::PlaneRegion{{0, 0, 0}, {1, 0, 0}}, {0, 1, 2}}});
  };
  const Model model = plate_of(2), higher = plate_of(3);
  const Factored factored = factorise(model);
  const auto estimated = [&](int substructures) {
    ToleranceOptions options;
    options.modes = {.count = 6, .substructures = substructures, .up_to_hz = {}};
    return estimate_by_next_order(model, factored, modes(model, factored, options.modes), higher, options).frequency;
  };
  EXPECT_NEAR(estimated(2) - estimated(0), 1e-5, 5e-6);  // the changes differ by the true errors, which are far smaller
}

TEST(SubstructuredModes, ABoundBelowAllModesIsNamed) {
  const Model model = plate(true);
  const Factored factored = factorise(model);
  try {
    (void)modes(model, factored, {.substructures = 2, .up_to_hz = 1.0});
    ADD_FAILURE();
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("raise modes.up_to"), std::string::npos) << error.what();
  }
}

TEST(SubstructuredModes, AMeshWithFewRowsTakesBlockLanczos) {
  const Model model = supported_model(mesh::kuhn_box({0.1, 0.05, 0.01}, {2, 1, 1}), 2, {210e9, 0.3, 7850.0}, {});
  const Factored factored = factorise(model);
  const auto count = static_cast<int>(model.K.rows() / 2);
  const auto told = told_by([&] {
    const Modes found = modes(model, factored, {.count = count, .substructures = 2, .up_to_hz = {}});
    EXPECT_EQ(found.frequency_hz.size(), count + 6);
  });
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("modes.substructures is left out"), std::string::npos) << told[0];
}

}  // namespace
}  // namespace thinwall::fem::substructured_modes_test
