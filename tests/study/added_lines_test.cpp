// Lines that a run adds between those that were asked for.

#include "study/support/added_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "dynamics/conversion.hpp"
#include "study/support/support_stage.hpp"
#include "tests/dynamics/random_models.hpp"

namespace thinwall::tests::added_lines_test {

using namespace study;

namespace {

/// Three masses, the first of them named `point`, the others after it.
dynamics::SpatialModel chain(const std::string& point, unsigned seed) {
  dynamics::SpatialModel model = dynamics::testing::spring_chain(3, seed);
  model.C = 2e-6 * model.K;
  for (dynamics::Dof& dof : model.dofs) dof.point = dof.point == "p0" ? point : point + dof.point;
  return model;
}

Results coupled_run(const dynamics::FrequencyAxis& axis) {
  Results results;
  results.part = component(chain("P", 4), axis);
  results.robot = component(chain("R", 5), axis);
  results.contacts.emplace_back();
  coupling::ContactSpring spring;
  spring.direction = Eigen::Vector3d::UnitX();
  results.contacts.front().contact = {"P", "R", {spring}, {}};
  results.coupled = couple(contacts_of(results.contacts), {}, *results.part, *results.robot);
  return results;
}

TEST(AddedLines, HaveTheResponsesOfTheModelsAndLieBetweenTheOthers) {
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(1.0, 500.0, 500);
  const Results results = coupled_run(axis);
  const AddedLines added = added_lines({}, results);
  ASSERT_TRUE(added.part && added.robot && added.coupled && added.coupled_spatial);
  const Eigen::VectorXd& hz = added.part->axis.hz;
  EXPECT_GT(hz.size(), 50);
  EXPECT_LE(hz.size(), 250);
  EXPECT_TRUE(std::ranges::is_sorted(hz));
  for (const double line : hz) EXPECT_FALSE(std::ranges::binary_search(axis.hz, line)) << line;
  for (const auto* response : {&added.robot, &added.coupled, &added.coupled_spatial}) {
    EXPECT_EQ((*response)->axis.hz, hz);
    EXPECT_EQ((*response)->H.size(), added.part->H.size());
  }
  const dynamics::ResponseModel truth = dynamics::direct_response(chain("P", 4), {hz});
  const dynamics::ResponseModel both = dynamics::direct_response(*results.coupled->model, {hz});
  for (std::size_t line = 0; line < truth.H.size(); ++line) {
    EXPECT_LT((added.part->H[line] - truth.H[line]).norm(), 1e-9 * truth.H[line].norm());
    EXPECT_LT((added.coupled->H[line] - both.H[line]).norm(), 1e-8 * both.H[line].norm());
  }
}

/// The peak of a resonance that lines miss by many half widths is there.
TEST(AddedLines, HoldResonancesThatTheOthersMiss) {
  Results results;
  results.part = component(chain("P", 4), dynamics::linear_axis(1.0, 500.0, 40));
  const AddedLines added = added_lines({}, results);
  ASSERT_TRUE(added.part);
  EXPECT_FALSE(added.robot || added.coupled);
  const auto fine = dynamics::direct_response(chain("P", 4), dynamics::linear_axis(1.0, 500.0, 50000));
  double peak = 0.0;
  for (const auto& H : fine.H) peak = std::max(peak, std::abs(H(0, 0)));
  double found = 0.0;
  for (const auto& H : added.part->H) found = std::max(found, std::abs(H(0, 0)));
  EXPECT_NEAR(found / peak, 1.0, 0.01);
}

TEST(AddedLines, AreNoneAtPolesWithoutDamping) {
  dynamics::SpatialModel undamped = chain("P", 4);
  undamped.C.setZero();
  Results results;
  results.part = component(undamped, dynamics::linear_axis(1.0, 500.0, 40));
  EXPECT_FALSE(added_lines({}, results).part);
}

TEST(AddedLines, AreNoneWhereAComponentIsKnownByMeasurementOnly) {
  Results results = coupled_run(dynamics::linear_axis(1.0, 500.0, 500));
  results.robot->modal.reset();
  results.robot->spatial.reset();
  const AddedLines added = added_lines({}, results);
  EXPECT_TRUE(added.part);
  EXPECT_FALSE(added.robot || added.coupled || added.coupled_spatial);
  results.part->modal.reset();
  results.part->spatial.reset();
  EXPECT_FALSE(added_lines({}, results).part);
}

}  // namespace

}  // namespace thinwall::tests::added_lines_test
