// A tool swapped by receptances against the machine assembled with it.

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "coupling/decoupling.hpp"
#include "machine.hpp"

namespace thinwall::coupling::tool_swap_test {
namespace {

using namespace testing;
using dynamics::direct_response;

const std::vector<std::string> tip_1{"1tip.x", "1tip.ry", "1tip.y", "1tip.rx"};
const std::vector<std::string> tip_2{"2tip.x", "2tip.ry", "2tip.y", "2tip.rx"};
const std::vector<std::string> two_points{"1tip.x", "1up.x", "1tip.y", "1up.y"};

/// The receptances of both tools, alone and in the machine, over a band with lines on all resonances.
struct Pair {
  SpatialModel model_1 = tool("1", steel(0.016), 0.090, 0.02), model_2 = tool("2", carbide(0.012), 0.065, 0.02);
  Contact joint_1 = shrink_fit("1root", 3e8, 2e-6), joint_2 = shrink_fit("2root", 1.2e8, 3e-6);
  dynamics::FrequencyAxis band = with_resonances();
  HeldTool tool_1{direct_response(model_1, band), joint_1}, tool_2{direct_response(model_2, band), joint_2};
  ResponseModel C_1 = assembled(model_1, joint_1, band), C_2 = assembled(model_2, joint_2, band);

  [[nodiscard]] dynamics::FrequencyAxis with_resonances() const {
    std::vector<double> hz;
    for (double f = 20.0; f < 5000.0; f += 40.0) hz.push_back(f);
    const auto add = [&](const SpatialModel& tool, const Contact& joint) {
      for (const double w : dynamics::undamped_modes(couple({tool, spindle_and_holder()}, {joint})).omega_rad_s) {
        if (w > 200.0 && w < 31000.0) hz.push_back(w / (2.0 * std::numbers::pi));
      }
    };
    add(model_1, joint_1);
    add(model_2, joint_2);
    std::sort(hz.begin(), hz.end());
    hz.erase(std::unique(hz.begin(), hz.end(), [](double a, double b) { return b - a < 1e-3; }), hz.end());
    return {Eigen::Map<const Eigen::VectorXd>(hz.data(), static_cast<Eigen::Index>(hz.size()))};
  }
};

const Pair& pair() {
  static const Pair made;
  return made;
}

TEST(ToolSwap, ExactRotationsGiveTheDirectAssembly) {
  const SwappedTool swapped = tool_swap(only(pair().C_1, tip_1), pair().tool_1, pair().tool_2);
  const double off = difference(only(swapped.coupled.response, tip_2), only(pair().C_2, tip_2));
  std::printf("swapped tip against assembly, 4 x 4: %.2g\n", off);
  EXPECT_LT(off, 1e-9);
  EXPECT_EQ(swapped.status, SwapStatus::done);
  EXPECT_LT(swapped.holder.condition.maxCoeff(), 1e8);
  // x and y act on each other: without that the bar above would say less
  EXPECT_GT(std::abs(dynamics::entry(pair().C_2, "2tip.x", "2tip.y").cwiseAbs().maxCoeff()),
            0.05 * dynamics::entry(pair().C_2, "2tip.x", "2tip.x").cwiseAbs().maxCoeff());
}

TEST(ToolSwap, SixteenDisplacementsNeedNoRotations) {
  const SwappedTool swapped = tool_swap(only(pair().C_1, two_points), pair().tool_1, pair().tool_2);
  const double off = difference(only(swapped.coupled.response, tip_2), only(pair().C_2, tip_2));
  std::printf("from 16 displacements as they are: %.2g\n", off);
  EXPECT_LT(off, 1e-9);
}

TEST(ToolSwap, TheHolderIsTheMachineWithoutTool) {
  const HolderReceptance holder = holder_receptance(only(pair().C_1, tip_1), pair().tool_1);
  const ResponseModel exact =
      only(direct_response(spindle_and_holder(), pair().band), {"holder.x", "holder.y", "holder.rx", "holder.ry"});
  EXPECT_LT(difference(holder.receptance, exact), 1e-7);  // between two large terms, T^A_22 at 20 Hz is 1e4 times T^B
  EXPECT_EQ(dynamics::name(holder.receptance.responses[3]), "holder.ry");
  EXPECT_FALSE(holder.rank_deficient());
}

TEST(ToolSwap, TheHolderIsWhatDecouplingLeavesAtTheRoot) {
  const std::vector<std::string> root{"1root.x", "1root.y", "1root.rx", "1root.ry"};
  std::vector<std::string> of_tool = tip_1;
  of_tool.insert(of_tool.end(), root.begin(), root.end());
  const CoupledResponse rest = decouple(only(pair().C_1, tip_1), only(pair().tool_1.free, of_tool), {"1tip"},
                                        {.regularisation = Regularisation::none});
  HolderReceptance holder =
      holder_receptance(only(pair().C_1, tip_1), {pair().tool_1.free, radial_contact("1root", "holder")});
  EXPECT_LT(difference(holder.receptance, only(rest.response, root)), 1e-9);
}

TEST(ToolSwap, TheSameToolGivesBackWhatWasMeasured) {
  const SwappedTool same = tool_swap(only(pair().C_1, tip_1), pair().tool_1, pair().tool_1);
  EXPECT_LT(difference(only(same.coupled.response, tip_1), only(pair().C_1, tip_1)), 1e-9);
  std::vector<int> rows;
  for (const std::string& name : tip_1) rows.push_back(dynamics::row_of(same.coupled.response.responses, name));
  for (std::size_t line = 0; line < same.left.size(); ++line) {  // and so do its errors
    const Eigen::MatrixXcd left = same.left[line](rows, Eigen::all), right = same.right[line](Eigen::all, rows);
    for (const Eigen::MatrixXcd& factor : {left, right}) {
      for (const auto& [i, j] : {std::pair{0, 0}, {1, 1}, {2, 2}, {3, 3}})
        EXPECT_NEAR(std::abs(factor(i, j) - 1.0), 0.0, 1e-6);
      EXPECT_LT(std::abs(factor(0, 2)), 1e-6);
    }
  }
}

TEST(ToolSwap, AnUnknownJointThatDoesNotChangeNeedsNotBeKnown) {
  const ResponseModel exact = assembled(pair().model_2, shrink_fit("2root", 3e8, 2e-6), pair().band);
  const SwappedTool swapped =
      tool_swap(only(pair().C_1, tip_1), {pair().tool_1.free, radial_contact("1root", "holder")},
                {pair().tool_2.free, radial_contact("2root", "holder")});
  EXPECT_LT(difference(only(swapped.coupled.response, tip_2), only(exact, tip_2)), 1e-9);
}

TEST(ToolSwap, TheLengthThatScalesRotationsDoesNotMatter) {
  const ResponseModel measured = only(pair().C_1, tip_1);
  const SwappedTool a = tool_swap(measured, pair().tool_1, pair().tool_2, 0.01);
  const SwappedTool b = tool_swap(measured, pair().tool_1, pair().tool_2, 2.0);
  EXPECT_LT(difference(only(a.coupled.response, tip_2), only(b.coupled.response, tip_2)), 1e-9);
  EXPECT_LT((a.holder.condition.array() / b.holder.condition.array() - 1.0).abs().maxCoeff(), 1e-6);
}

TEST(ToolSwap, SensitivitiesAreTheDifferenceQuotient) {
  const ResponseModel measured = only(pair().C_1, tip_1);
  const SwappedTool swapped = tool_swap(measured, pair().tool_1, pair().tool_2);
  const std::complex<double> share(1e-7, -2e-7);
  for (const auto& [k, l] : {std::pair{0, 0}, {1, 0}, {3, 1}}) {
    ResponseModel moved = measured;
    for (Eigen::MatrixXcd& T : moved.H) T(k, l) *= 1.0 + share;
    const SwappedTool other = tool_swap(moved, pair().tool_1, pair().tool_2);
    for (std::size_t line = 0; line < measured.H.size(); line += 7) {
      const std::complex<double> d = share * measured.H[line](k, l);
      const Eigen::MatrixXcd first_order = swapped.left[line].col(k) * d * swapped.right[line].row(l);
      const Eigen::MatrixXcd found = other.coupled.response.H[line] - swapped.coupled.response.H[line];
      const double round_off = 1e-9 * swapped.coupled.response.H[line](0, 0).real();
      EXPECT_NEAR(std::abs(found(0, 0) - first_order(0, 0)), 0.0,
                  3e-3 * std::abs(first_order(0, 0)) + std::abs(round_off));
    }
  }
}

TEST(ToolSwap, SpindleHolderAndToolAreAChain) {
  // Each on its own, joined by receptances (Schmitz): the tool's shrink fit, the taper rigid in all six directions.
  const dynamics::FrequencyAxis& band = pair().band;
  Contact taper{"taper", "nose", {}, {}};
  for (const auto kind : {dynamics::DofKind::translation, dynamics::DofKind::rotation}) {
    for (int axis = 0; axis < 3; ++axis) {
      ContactSpring& spring = taper.springs.emplace_back();
      spring.direction = Vector3d::Unit(axis);
      spring.kind = kind;
    }
  }
  const ResponseModel spindle = direct_response(fem::spatial_model(spindle_frame()), band);
  const ResponseModel free_holder = direct_response(holder(), band);
  const CoupledResponse chain = couple({pair().tool_2.free, free_holder, spindle}, {pair().joint_2, taper});
  const double off = difference(only(chain.response, tip_2), only(pair().C_2, tip_2));
  std::printf("chain of three against assembly: %.2g\n", off);
  EXPECT_LT(off, 1e-9);
  // and backwards: tool out, holder out, what remains is the spindle at its nose
  HolderReceptance with_holder = holder_receptance(only(chain.response, tip_2), pair().tool_2);
  Contact cone = radial_contact("taper", "nose");
  const HolderReceptance bare =
      holder_receptance(with_holder.receptance, {only(free_holder, {"holder.x", "holder.y", "holder.rx", "holder.ry",
                                                                    "taper.x", "taper.y", "taper.rx", "taper.ry"}),
                                                 cone});
  EXPECT_LT(difference(bare.receptance, only(spindle, {"nose.x", "nose.y", "nose.rx", "nose.ry"})), 1e-5);
}

TEST(ToolSwap, ALineThatSaysNothingOfTheHolderIsAStatus) {
  ResponseModel measured = only(pair().C_1, tip_1);
  const ResponseModel free = only(pair().tool_1.free, tip_1);
  measured.H[5].row(1) = free.H[5].row(1);
  measured.H[5].col(1) = free.H[5].col(1);
  const SwappedTool swapped = tool_swap(measured, pair().tool_1, pair().tool_2);
  EXPECT_EQ(swapped.status, SwapStatus::rank_deficient);
  EXPECT_EQ(swapped.holder.rank_deficient_lines, 1);
  EXPECT_TRUE(swapped.holder.receptance.H[5].array().isNaN().all());
  EXPECT_TRUE(swapped.holder.receptance.H[4].allFinite());
  EXPECT_TRUE(swapped.coupled.response.H.empty());
  EXPECT_TRUE(std::isinf(swapped.holder.condition(5)));
}

template <typename Call>
std::string refusal(Call call) {
  try {
    call();
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ToolSwap, RefusesWhatIsNoSwap) {
  const ResponseModel measured = only(pair().C_1, tip_1);
  const HeldTool &tool_1 = pair().tool_1, &tool_2 = pair().tool_2;
  const auto with = [&](const ResponseModel& C, const HeldTool& a, const HeldTool& b, double length = 0.1) {
    return refusal([&] { (void)tool_swap(C, a, b, length); });
  };
  EXPECT_NE(with(only(tool_1.free, tip_1), tool_1, tool_2).find("that of the free tool"), std::string::npos);
  EXPECT_NE(with(only(pair().C_1, {"1tip.x", "1tip.y"}), tool_1, tool_2).find("has 4 directions, but 2"),
            std::string::npos);
  EXPECT_NE(
      with(only(pair().C_1, {"1root.x", "1root.y", "1root.rx", "1root.ry"}), tool_1, tool_2).find("without overhang"),
      std::string::npos);
  EXPECT_NE(with(measured, tool_1, {only(tool_2.free, {"2root.x", "2root.y", "2root.rx", "2root.ry"}), tool_2.joint})
                .find("without overhang"),
            std::string::npos);
  EXPECT_NE(with(only(pair().C_2, tip_2), tool_1, tool_2).find("2tip.x is none of the tool's"), std::string::npos);
  ResponseModel bad = measured;
  bad.H[3](0, 1) = std::nan("");
  EXPECT_NE(with(bad, tool_1, tool_2), "");
  ResponseModel other_axis = measured;
  other_axis.axis.hz(7) += 0.01;
  EXPECT_NE(with(other_axis, tool_1, tool_2), "");
  ResponseModel unequal = measured;
  std::swap(unequal.forces[0], unequal.forces[1]);
  EXPECT_NE(with(unequal, tool_1, tool_2).find("not the same degrees of freedom"), std::string::npos);
  Contact three = tool_2.joint;
  three.matrices = {};
  three.springs.pop_back();
  EXPECT_NE(with(measured, tool_1, {tool_2.free, three}).find("differ in their directions"), std::string::npos);
  EXPECT_NE(with(measured, tool_1, tool_2, 0.0), "");
  const SwappedTool fine = tool_swap(measured, tool_1, tool_2);
  EXPECT_NE(refusal([&] { (void)swap_error_bound(fine, fine, {}); }), "");
  EXPECT_NE(refusal([&] {
              (void)swap_error_bound(fine, fine,
                                     std::vector<Eigen::MatrixXd>(measured.H.size(), Eigen::Matrix3d::Zero()));
            }),
            "");
}

}  // namespace
}  // namespace thinwall::coupling::tool_swap_test
