// reduction.modes beyond what the part has.

#include <gtest/gtest.h>

#include <string>

#include "case/reader.hpp"
#include "core/error.hpp"
#include "study/part/discretisation.hpp"
#include "study/part/part_stage.hpp"

namespace thinwall::tests::reduction_modes_test {
namespace {

/// The number of fixed-interface modes of a block of six tetrahedra or a few more, or the message of a refusal.
std::string modes_of_block(const std::string& reduction) {
  const cases::Case source = cases::parse_case(R"([part]
length = "10 mm"
height = "10 mm"
thickness = "10 mm"
[part.material]
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2700 kg/m^3"
[part.mesh]
element_size = "40 mm"
order = 1
[[part.supports]]
on = "z_min"
[points.P]
at = [1.0, 1.0, 1.0]
[modes]
count = 2
[reduction]
check_frequencies = 0
)" + reduction,
                                               ".");
  study::Stages stages;
  try {
    const auto part =
        study::compute_part(study::part_input(source), study::discretise(study::part_input(source)), stages);
    return std::to_string(part.reduced->fixed_interface_hz.size());
  } catch (const core::InputError& error) {
    return error.what();
  }
}

// Four corners are held, and one of the other four is the point.
TEST(ReductionModes, BeyondThoseOfThePartAreRefusedWithTheirNumber) {
  EXPECT_EQ(
      modes_of_block("modes = 2000\n"),
      "reduction.modes is 2000, but the part has 9 degrees of freedom besides its points; ask for fewer modes, or "
      "take a finer mesh");
  EXPECT_EQ(modes_of_block("modes = 8\n"), "8");
  EXPECT_EQ(modes_of_block(""), "9") << "the usual number means as many as there are";
}

}  // namespace
}  // namespace thinwall::tests::reduction_modes_test
