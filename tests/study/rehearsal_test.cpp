// Modes of a part on its first mesh against those of the run, and what a forecast of charts makes of them.

#include "study/rehearsal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "case/numbers.hpp"
#include "case/reader.hpp"
#include "core/error.hpp"
#include "core/messages.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/lobes/lobes_forecast.hpp"
#include "study/part/discretisation.hpp"
#include "study/run.hpp"

namespace thinwall::tests::rehearsal_test {

namespace {

std::string folder_of(const std::string& name) {
  return std::string(THINWALL_SOURCE_DIR) + "/cases/" + name;
}

std::optional<study::StandInModes> rehearsed(const cases::Case& source) {
  return study::rehearsed_modes(source, study::first_mesh(study::part_input(source)));
}

/// The lowest frequencies that the cut feels, Hz.
std::vector<double> lowest_hz(const milling::RelativeStructure& modes, std::size_t count) {
  std::vector<double> hz;
  for (const std::complex<double> pole : modes.poles) hz.push_back(std::abs(pole) / (2.0 * std::numbers::pi));
  std::ranges::sort(hz);
  hz.resize(std::min(count, hz.size()));
  return hz;
}

void expect_near(const std::vector<double>& rehearsed, const std::vector<double>& of_run, double share) {
  ASSERT_EQ(rehearsed.size(), of_run.size());
  for (std::size_t i = 0; i < of_run.size(); ++i)
    EXPECT_NEAR(rehearsed[i] / of_run[i], 1.0, share) << "mode " << i + 1 << " at " << of_run[i] << " Hz";
}

TEST(Rehearsal, ModesAreNearThoseOfTheRunAloneAndWithTheRobot) {
  // One layer of elements of order 2 across a wall of 2 mm is stiffer than the wall by some percent in low modes.
  constexpr double share = 0.15;
  constexpr std::size_t modes = 3;
  cases::Case source = cases::read_case(folder_of("wall-path"));
  source.path.reset();
  const auto found = rehearsed(source);
  ASSERT_TRUE(found && found->supported);
  const setup::CutSetup cut = source;
  source.lobes.reset();
  source.part->mesh.tolerance = 0.02;
  study::Kept nothing;
  const study::Results results = study::run(source, cases::variation_of(source), nothing, {});
  const auto of_run = [&](const dynamics::ModalModel& model) {  // the tool of this case is rigid
    return lowest_hz(*study::cut_poles(cut, &model), modes);
  };
  expect_near(lowest_hz(found->part, modes), of_run(*results.part->modal), share);
  expect_near(lowest_hz(found->supported.value(), modes), of_run(*results.coupled->modal), share);
}

TEST(Rehearsal, TakesTheFirstMeshOfASurface) {
  constexpr double by_calculix_hz = 755.6;  // cases/pocketed-rib/expected.toml
  const cases::Case source = cases::read_case(folder_of("pocketed-rib"));
  const auto found = rehearsed(source);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->supported) << "no robot";
  EXPECT_NEAR(lowest_hz(found->part, 1).front() / by_calculix_hz, 1.0, 0.1);
}

TEST(Rehearsal, SaysNothing) {
  std::string told;
  const auto before = core::set_message_listener([&](core::MessageLevel, const std::string& said) { told += said; });
  const auto found = rehearsed(cases::read_case(folder_of("barrios-2019")));
  (void)core::set_message_listener(before);
  EXPECT_TRUE(found);
  EXPECT_EQ(told, "");
}

TEST(Rehearsal, ThereIsNoneWithoutAPartOrAChart) {
  EXPECT_FALSE(study::rehearsed_modes(cases::read_case(folder_of("ding-2010")), {}));
  cases::Case source = cases::read_case(folder_of("barrios-2019"));
  source.lobes.reset();
  EXPECT_FALSE(study::rehearsed_modes(source, {}));
}

TEST(Rehearsal, AForecastTakesItsModesForThoseOfThePart) {
  // A row of a structure that does not move in the plane of the cut is an error, so that there is no forecast.
  const cases::Case source = cases::read_case(folder_of("barrios-2019"));
  constexpr double limit_s = 20.0;
  auto modes = rehearsed(source);
  ASSERT_TRUE(modes && modes->supported);
  EXPECT_TRUE(study::forecast_lobes(source, limit_s, {}, [&] { return modes; }));
  modes->supported->phi.topRows(2).setZero();
  modes->supported->b.topRows(2).setZero();
  modes->supported->R.setZero();
  EXPECT_FALSE(study::forecast_lobes(source, limit_s, {}, [&] { return modes; }))
      << "the supported part has rows of its own";
}

}  // namespace

}  // namespace thinwall::tests::rehearsal_test
