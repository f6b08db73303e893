// Stability lobes from a measured receptance of the tool tip: slotting with four teeth, the tool moves along the feed.
#include <cstdio>
#include <thinwall/io/io.hpp>
#include <thinwall/milling/milling.hpp>

using namespace thinwall;

int main(int, char** words) {
  const io::MeasuredFrf frf = io::read_frf(words[1], io::frf_format("receptance", "m/N", "Hz"));
  milling::SampledReceptance tip{frf.axis.hz, {}};
  for (const auto& along_feed : frf.H) tip.H.emplace_back(Eigen::Vector3cd(along_feed, 0.0, 0.0).asDiagonal());

  milling::MillingProcess slot;
  slot.cutter = {.teeth = 4, .diameter_m = 0.012};
  slot.coefficients = {.K_t = 600e6, .K_r = 200e6};
  slot.engagement = milling::engagement_of(slot.cutter, 0.012, milling::MillingDirection::up);

  const auto speeds = milling::spindle_speeds(3000.0, 9000.0, 121);
  const auto lobes = milling::stability_lobes(milling::SampledStructure{tip, {}}, slot, speeds, {});
  std::printf("least depth %.5f mm at %.0f rpm\n", 1e3 * lobes.minimum_depth_m, lobes.at_spindle_speed_rpm);
}
