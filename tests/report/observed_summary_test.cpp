// Cuts that were made, counted.

#include "report/lobes/observed_summary.hpp"

#include <gtest/gtest.h>

namespace thinwall::report::observed_summary_test {
namespace {

study::JudgedCut judged(milling::CutOutcome outcome, bool stable, milling::StabilityStatus status) {
  study::JudgedCut cut;
  cut.observed = {6000.0, 1e-3, outcome, {}};
  cut.predicted.point = {6000.0, 1e-3};
  cut.predicted.stable = stable;
  cut.predicted.status = status;
  return cut;
}

TEST(ObservedSummary, CountsAPredictionThatDidNotConvergeNeitherAsRightNorAsWrong) {
  using enum milling::CutOutcome;
  using Status = milling::StabilityStatus;
  const ObservedSummary summary = observed_summary(
      {judged(chatter, false, Status::converged), judged(chatter, true, Status::stable_to_depth_limit),
       judged(chatter, false, Status::node_limit_reached), judged(stable, false, Status::crossing_missed),
       judged(stable, true, Status::data_insufficient), judged(stable, true, Status::data_limited),
       judged(marginal, true, Status::node_limit_reached)});
  EXPECT_EQ(summary.prediction.right, 2);
  EXPECT_EQ(summary.prediction.of, 3);
  EXPECT_EQ(summary.doubtful, 3);
  EXPECT_EQ(summary.marginal, 1);
  EXPECT_FALSE(summary.cuts[2].right);
  EXPECT_NE(observed_text(summary).find("3 doubtful: the prediction did not converge"), std::string::npos);
  EXPECT_FALSE(observed_summary({judged(stable, true, Status::converged)}).doubtful);
}

TEST(ObservedSummary, CountsForTheTextbookOnlyCutsThatItJudges) {
  using enum milling::CutOutcome;
  std::vector<study::JudgedCut> cuts(3, judged(chatter, false, milling::StabilityStatus::converged));
  cuts[0].textbook_stable = false;
  cuts[1].textbook_stable = true;
  const ObservedSummary summary = observed_summary(cuts);
  EXPECT_EQ(summary.prediction.of, 3);
  ASSERT_TRUE(summary.textbook);
  EXPECT_EQ(summary.textbook->right, 1);
  EXPECT_EQ(summary.textbook->of, 2);
}

}  // namespace
}  // namespace thinwall::report::observed_summary_test
