// modes.verify: the modes of the part's stage are checked, and a solution that is not right goes no further.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "case/reader.hpp"
#include "core/error.hpp"
#include "study/kept/stage_keys.hpp"
#include "study/part/discretisation.hpp"
#include "study/part/part_stage.hpp"

namespace thinwall::tests::mode_check_test {
namespace {

std::string wall(const char* verify) {
  return std::string(R"([part]
length = "60 mm"
height = "40 mm"
thickness = "3 mm"
[part.material]
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2700 kg/m^3"
[part.mesh]
element_size = "10 mm"
order = 2
[[part.supports]]
on = "z_min"
[modes]
count = 6
verify = )") +
         verify + "\n";
}

/// The wall's solution without a check.
study::Solution solution() {
  const cases::Case source = cases::parse_case(wall("false"), ".");
  study::Stages stages;
  study::Solution found = study::solved_part(source, study::discretise(study::part_input(source)), stages);
  EXPECT_FALSE(found.modes.check.has_value());
  return found;
}

/// The message with which the part's stage refuses this solution; empty if it takes it.
std::string refusal(study::Solution found) {
  const cases::Case source = cases::parse_case(wall("true"), ".");
  study::Stages stages;
  study::Discretisation given;
  given.solved = std::move(found);
  try {
    const study::PartResult part = study::compute_part(study::part_input(source), std::move(given), stages);
    EXPECT_EQ(part.modes.check.value().counted, 6);
    EXPECT_LT(part.modes.check->largest_difference, 1e-9);
  } catch (const core::NumericalError& error) {
    return error.what();
  }
  return "";
}

TEST(ModesVerify, TakesASolutionThatIsRight) {
  EXPECT_EQ(refusal(solution()), "");
}

TEST(ModesVerify, RefusesASolutionThatLacksAMode) {
  study::Solution forged = solution();
  auto& pairs = forged.modes.pairs;
  const std::vector<int> kept{0, 1, 3, 4, 5};
  pairs.lambda = Eigen::VectorXd(pairs.lambda(kept));
  pairs.Phi = Eigen::MatrixXd(pairs.Phi(Eigen::all, kept));
  const std::string text = refusal(std::move(forged));
  EXPECT_NE(text.find("5 modes were found below "), std::string::npos) << text;
  EXPECT_NE(text.find("where the Sturm count of K - sM shows 6"), std::string::npos) << text;
}

TEST(ModesVerify, RefusesASolutionWithAFrequencyThatIsNone) {
  study::Solution forged = solution();
  forged.modes.pairs.lambda(2) *= 1.0 + 1e-5;
  const std::string text = refusal(std::move(forged));
  EXPECT_NE(text.find("mode 3 at "), std::string::npos) << text;
  EXPECT_NE(text.find("differ by 1e-05 relative"), std::string::npos) << text;
}

TEST(ModesVerify, IsPartOfTheKeyOfThePart) {
  const auto key = [](const char* verify) { return study::part_key(cases::parse_case(wall(verify), ".")); };
  EXPECT_NE(key("true"), key("false"));
}

}  // namespace
}  // namespace thinwall::tests::mode_check_test
