// The time of a part before it is solved.

#include "study/part/part_forecast.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::part_forecast_test {
namespace {

/// A block of one hexahedron, which is read as tetrahedra.
constexpr auto block =
    "*NODE\n1, 0, 0, 0\n2, 10, 0, 0\n3, 10, 10, 0\n4, 0, 10, 0\n5, 0, 0, 10\n6, 10, 0, 10\n7, 10, 10, 10\n"
    "8, 0, 10, 10\n*ELEMENT, TYPE=C3D8, ELSET=ALL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n";

setup::PartSize forecast_of_block(const std::string& mesh) {
  const TemporaryFolder folder;
  core::write_file_atomically(folder.path / "block.inp", block);
  const cases::Case source = cases::parse_case(
      "[part]\nfile = \"block.inp\"\nunit = \"mm\"\n[part.material]\nyoungs_modulus = \"70 GPa\"\npoisson_ratio = 0.3\n"
      "density = \"2700 kg/m^3\"\n[[part.supports]]\non = \"z_min\"\n[modes]\ncount = 1\n[damping]\nratio = 0.01\n" +
          mesh,
      folder.path);
  return study::forecast(study::part_input(source)).value();
}

/// Of order p the block has (p + 1)³ nodes.
TEST(PartForecast, AMeshOfAFileIsSolvedOnceMoreOneOrderHigher) {
  const auto solved_s = [](int order) { return 1.3 * std::pow(3.0 * std::pow(order + 1.0, 3) / 4e4, 1.3); };
  EXPECT_NEAR(forecast_of_block("").seconds, solved_s(2) + solved_s(3), 1e-12);
  EXPECT_NEAR(forecast_of_block("[part.mesh]\norder = 5\n").seconds, solved_s(5) + solved_s(6), 1e-12);
  EXPECT_NEAR(forecast_of_block("[part.mesh]\norder = 6\n").seconds, solved_s(6), 1e-12) << "there is none higher";
}

}  // namespace
}  // namespace thinwall::tests::part_forecast_test
