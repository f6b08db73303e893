#include "io/frf/one_reference.hpp"

#include <complex>
#include <string>

#include "core/error.hpp"
#include "io/frf/uff_content.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::one_reference_test {

namespace {

using Complex = std::complex<double>;
using dynamics::Dof;

Dof dof(const std::string& point, double z = 1.0) {
  return {point, {0.0, 0.0, z}, dynamics::DofKind::translation};
}

/// The entry a/b of a symmetric matrix whose points are P1, P2, …: H = (10 i + j)(1 − i/2) for i ≤ j, at two lines.
MeasuredEntry measured(int a, int b, double sign_a = 1.0, double sign_b = 1.0) {
  const double size = 10.0 * std::min(a, b) + std::max(a, b);
  MeasuredEntry entry{dof("P" + std::to_string(a), sign_a), dof("P" + std::to_string(b), sign_b), {}};
  entry.frf.source = "test.uff:" + std::to_string(10 * a + b);
  entry.frf.axis.hz = Eigen::Vector2d(10.0, 20.0);
  entry.frf.H = sign_a * sign_b * size * Eigen::Vector2cd(Complex(1.0, -0.5), Complex(2.0, -1.0));
  return entry;
}

/// The rows P1 to P3 of the column of a force at P1, along +z.
void expect_column_of_first(const ReferenceColumn& column) {
  const auto& model = column.measured.response;
  ASSERT_EQ(model.forces.size(), 1U);
  EXPECT_EQ(dynamics::name(model.forces.front()), "P1.z");
  ASSERT_EQ(model.responses.size(), 3U);
  for (std::size_t row = 0; row < 3; ++row) {
    const std::string name = dynamics::name(model.responses[row]);
    const double expected = name == "P1.z" ? 11.0 : name == "P2.z" ? 12.0 : name == "P3.z" ? 13.0 : 0.0;
    EXPECT_EQ(model.H[0](static_cast<Eigen::Index>(row), 0), expected * Complex(1.0, -0.5)) << name;
    EXPECT_EQ(model.H[1](static_cast<Eigen::Index>(row), 0), expected * Complex(2.0, -1.0)) << name;
  }
}

}  // namespace

TEST(OneReference, AMovedHammerGivesTheColumnOfItsSensorByReciprocity) {
  const ReferenceColumn column = reference_column({{measured(1, 1), measured(1, 2), measured(1, 3)}, {}});
  expect_column_of_first(column);
  EXPECT_EQ(column.by_reciprocity, 2);
  EXPECT_EQ(column.driving_point, 0);
}

// Neither a row nor a column: response_matrix() misses P3/P2 there.
TEST(OneReference, SensorAndHammerMayBothMoveAndPointEitherWay) {
  const MeasuredEntries mixed{{measured(1, 2, 1.0, -1.0), measured(3, 1, -1.0, -1.0), measured(1, 1, 1.0, -1.0)}, {}};
  EXPECT_THROW((void)response_matrix(mixed), core::DataError);
  const ReferenceColumn column = reference_column(mixed);
  expect_column_of_first(column);
  EXPECT_EQ(column.by_reciprocity, 1);
}

TEST(OneReference, OfAPairThatWasMeasuredBothWaysTheForceAtTheReferenceCounts) {
  MeasuredEntry reverse = measured(1, 2);
  reverse.frf.H *= 1.25;
  const ReferenceColumn column = reference_column({{reverse, measured(2, 1), measured(3, 1), measured(1, 1)}, {}});
  expect_column_of_first(column);
  ASSERT_EQ(column.measured.notes.size(), 1U);
  EXPECT_EQ(column.measured.notes.front(),
            "test.uff:12: P2.z/P1.z was measured both ways; the two differ by 25 % of the largest value");
}

TEST(OneReference, WithoutADrivingPointOrACommonDofItIsSaid) {
  EXPECT_EQ(reference_column({{measured(2, 1), measured(1, 3)}, {}}).driving_point, -1);
  EXPECT_FALSE(reference_of({measured(1, 2), measured(3, 4)}));
  EXPECT_FALSE(reference_of({}));
  EXPECT_THROW((void)reference_column({{measured(1, 2), measured(2, 3), measured(3, 1)}, {}}), core::DataError);
}

// A point that is measured twice is a fault of the file, as in any matrix.
TEST(OneReference, AnEntryThatIsThereTwiceIsRefused) {
  EXPECT_THROW((void)reference_column({{measured(1, 1), measured(1, 2), measured(1, 2)}, {}}), core::DataError);
}

TEST(UniversalContent, IsKnownByItsFirstLine) {
  EXPECT_TRUE(begins_as_universal_file("    -1\n   151\n"));
  EXPECT_TRUE(begins_as_universal_file("    -1    \r\n   151\n"));
  EXPECT_FALSE(begins_as_universal_file("    -1 2 3\n"));
  EXPECT_FALSE(begins_as_universal_file("-1\n"));
  EXPECT_FALSE(begins_as_universal_file("    -1"));
}

TEST(UniversalContent, APartThatIsRefusedDoesNotHideTheOthers) {
  const std::string sets =
      "    -1\n   151\nmodel\n    -1\n"
      "    -1\n    15\n         1         0         0         8  0.00000E+00  0.00000E+00  0.00000E+00\n    -1\n"
      "    -1\n    55\nx\n    -1\n";
  const UffContent stated = uff_content(sets, "a.unv", 1e-3);
  ASSERT_TRUE(stated.geometry);
  EXPECT_EQ(stated.geometry->nodes.size(), 1U);
  ASSERT_EQ(stated.refused.size(), 1U);  // the shape
  const UffContent unstated = uff_content(sets, "a.unv");
  EXPECT_FALSE(unstated.geometry);
  EXPECT_EQ(unstated.refused.size(), 2U);  // and the unit of the nodes
}

}  // namespace thinwall::io::test::one_reference_test
