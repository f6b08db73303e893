#include "io/frf/uff_shapes.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "scratch_folder.hpp"
#include "uff_bytes.hpp"

namespace thinwall::io::test::uff_shapes_test {

namespace {

using Complex = std::complex<double>;
using dynamics::DofKind;
using dynamics::ModalModel;

class UniversalShapes : public ScratchFolder {};

/// Three coupled coordinates at two points, one of them a rotation; light damping, proportional or at one place.
dynamics::SpatialModel plant(bool proportional) {
  dynamics::SpatialModel model;
  model.dofs = {{"P", Eigen::Vector3d::UnitX(), DofKind::translation},
                {"Q", Eigen::Vector3d(0.6, 0.0, 0.8), DofKind::translation},
                {"Q", Eigen::Vector3d::UnitY(), DofKind::rotation}};
  model.M = Eigen::Vector3d(1.0, 2.0, 0.1).asDiagonal();
  model.K = (Eigen::Matrix3d() << 3e6, -1e6, 2e4, -1e6, 2e6, -3e4, 2e4, -3e4, 4e4).finished();
  model.C =
      proportional ? Eigen::MatrixXd(1e-5 * model.K) : Eigen::MatrixXd(Eigen::Vector3d(50.0, 0.0, 0.0).asDiagonal());
  return model;
}

const std::map<std::string, long> labels{{"P", 3}, {"Q", 11}};

/// Receptance between two components of displacement, from what a shape holds.
Complex modal_sum(const std::vector<UffShape>& shapes, double omega, Eigen::Index node_a, Eigen::Index a,
                  Eigen::Index node_b, Eigen::Index b) {
  Complex sum = 0.0;
  for (const UffShape& shape : shapes) {
    const Complex product = shape.displacement(node_a, a) * shape.displacement(node_b, b);
    if (shape.is_complex) {
      sum += product / (shape.modal_a * (Complex(0.0, omega) - shape.pole)) +
             std::conj(product) / (std::conj(shape.modal_a) * (Complex(0.0, omega) - std::conj(shape.pole)));
    } else {
      const double omega_r = 2.0 * std::numbers::pi * shape.frequency_hz;
      sum += product / (shape.modal_mass *
                        Complex(omega_r * omega_r - omega * omega, 2.0 * shape.damping_ratio * omega_r * omega));
    }
  }
  return sum;
}

}  // namespace

// The whole way: model, shapes, file, shapes, and the receptance that they give against the direct one. Six digits of
// frequency and shape; off a resonance of damping ratio ζ they cost no more than some 1e-5, so half way between.
TEST_F(UniversalShapes, GiveTheReceptanceBackToTheDigitsOfTheFormat) {
  for (const bool proportional : {true, false}) {
    const dynamics::SpatialModel model = plant(proportional);
    write_uff_shapes(path("modes.unv"), shapes_of(dynamics::to_modal(model), labels));
    const UffShapes back = read_uff_shapes(path("modes.unv"));
    EXPECT_TRUE(back.notes.empty());
    ASSERT_EQ(back.shapes.size(), 3U);
    EXPECT_EQ(back.shapes[0].is_complex, !proportional);
    EXPECT_EQ(back.shapes[0].nodes, (std::vector<long>{3, 11}));
    EXPECT_LT(back.shapes[0].frequency_hz, back.shapes[1].frequency_hz);
    for (const double hz : {10.0, 60.0, 200.0, 400.0}) {
      const auto exact = dynamics::direct_response(model, {Eigen::VectorXd::Constant(1, hz)}).H[0];
      const double omega = 2.0 * std::numbers::pi * hz;
      const double tolerance = 5e-5 * exact.cwiseAbs().maxCoeff();
      EXPECT_LE(std::abs(modal_sum(back.shapes, omega, 0, 0, 0, 0) - exact(0, 0)), tolerance) << hz;
      EXPECT_LE(std::abs(modal_sum(back.shapes, omega, 1, 0, 0, 0) - 0.6 * exact(1, 0)), tolerance) << hz;
      EXPECT_LE(std::abs(modal_sum(back.shapes, omega, 1, 2, 1, 4) - 0.8 * exact(1, 2)), tolerance) << hz;
    }
  }
}

// A phase of the shape belongs to its scaling: a → c² a.
TEST_F(UniversalShapes, AreNormalWhateverThePhaseOfTheirScaling) {
  ModalModel modal = dynamics::to_modal(plant(true));
  const std::vector<UffShape> before = shapes_of(modal, labels);
  const Complex c = std::polar(3.0, 0.7);
  modal.right *= c;
  modal.left *= c;
  modal.scaling *= c * c;
  const std::vector<UffShape> after = shapes_of(modal, labels);
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_FALSE(after[k].is_complex);
    EXPECT_NEAR(after[k].modal_mass, 9.0 * before[k].modal_mass, 1e-9);
    const double sign = std::real(after[k].displacement(0, 0) * before[k].displacement(0, 0)) > 0.0 ? 1.0 : -1.0;
    EXPECT_LE((after[k].displacement - 3.0 * sign * before[k].displacement).norm(),
              1e-9 * before[k].displacement.norm());
  }
}

// By hand from the FORMAT statements: 6I10; 2, 4 and I10s; 6E13.5; then I10 and 6E13.5 a node.
TEST_F(UniversalShapes, HaveEveryFieldInItsColumns) {
  UffShape shape;
  shape.number = 2;
  shape.frequency_hz = 29.5;
  shape.modal_mass = 1.0;
  shape.damping_ratio = 0.01;
  shape.nodes = {5};
  shape.displacement = Eigen::RowVector3cd(0.5, -0.25, 0.0);
  write_uff_shapes(path("modes.unv"), {shape});
  const std::string text = core::read_file(path("modes.unv"));
  EXPECT_NE(text.find("         1         2         2         8         2         3\n"
                      "         2         4         1         2\n"
                      "  2.95000E+01  1.00000E+00  1.00000E-02  0.00000E+00\n"
                      "         5\n"
                      "  5.00000E-01 -2.50000E-01  0.00000E+00\n"
                      "    -1\n"),
            std::string::npos)
      << text;
  shape.is_complex = true;
  shape.pole = {-1.0, 100.0};
  shape.modal_a = {0.0, 200.0};
  write_uff_shapes(path("modes.unv"), {shape});
  // Modal B is −λ a = −(−1 + 100i) 200i = 20000 + 200i.
  EXPECT_NE(core::read_file(path("modes.unv"))
                .find("         1         3         2         8         5         3\n"
                      "         2         6         1         2\n"
                      " -1.00000E+00  1.00000E+02  0.00000E+00  2.00000E+02  2.00000E+04  2.00000E+02\n"
                      "         5\n"
                      "  5.00000E-01  0.00000E+00 -2.50000E-01  0.00000E+00  0.00000E+00  0.00000E+00\n"),
            std::string::npos);
}

// By hand from the FORMAT statement of data set 15, 4I10,1P3E13.5.
TEST_F(UniversalShapes, HaveTheGeometryThatTestsAreDrawnWith) {
  UffShape shape;
  shape.nodes = {5, 6};
  shape.displacement = Eigen::MatrixXcd::Ones(2, 3);
  UffMesh geometry;
  geometry.nodes = {{5, {0.0, 0.25, -1.5}}, {6, {1.0, 0.0, 0.0}}};
  geometry.lines = {{1, "edge", {5, 6}}};
  write_uff_shapes(path("modes.unv"), {shape}, geometry);
  const std::string text = core::read_file(path("modes.unv"));
  EXPECT_NE(text.find("    -1\n    15\n"
                      "         5         0         0         7  0.00000E+00  2.50000E-01 -1.50000E+00\n"
                      "         6         0         0         7  1.00000E+00  0.00000E+00  0.00000E+00\n"
                      "    -1\n    -1\n    82\n         1         2         7\nedge"),
            std::string::npos)
      << text;
  const UffMesh back = read_uff_mesh(path("modes.unv"));
  EXPECT_EQ(back.nodes.at(0).position, geometry.nodes[0].position);
  EXPECT_EQ(back.lines.at(0).nodes, geometry.lines[0].nodes);
  EXPECT_EQ(read_uff_shapes(path("modes.unv")).shapes.size(), 1U);
  geometry.lines = {{1, "edge", {5, 7}}};
  EXPECT_THROW(write_uff_shapes(path("modes.unv"), {shape}, geometry), core::InputError) << "node 7 is none";
}

TEST_F(UniversalShapes, OfOtherAnalysesOrUnitsAreNotedOrRefused) {
  UffShape shape;
  shape.nodes = {5};
  shape.displacement = Eigen::RowVector3cd(0.5, -0.25, 0.0);
  write_uff_shapes(path("modes.unv"), {shape, shape});
  std::string text = core::read_file(path("modes.unv"));
  const std::string record = "         1         2         2         8";
  text.replace(text.find(record), record.size(), "         1         1         2         8");
  const UffShapes read = uff_shapes(text, "m");
  EXPECT_EQ(read.shapes.size(), 1U);
  ASSERT_EQ(read.notes.size(), 1U);
  EXPECT_NE(read.notes[0].find("analysis type 1"), std::string::npos);
  const std::string sets = text.substr(text.find("    -1\n    55"));
  EXPECT_NE(uff_shapes(sets, "m").notes.back().find("no data set 164"), std::string::npos);
  EXPECT_THROW((void)uff_shapes(units_set(10, 1000.0, 1.0) + sets, "m"), core::DataError);
  EXPECT_THROW((void)uff_shapes(units_set(1, 1.0, 1.0), "m"), core::DataError);
}

TEST_F(UniversalShapes, AreNotWrittenFromWhatTheFormatCannotHold) {
  ModalModel modal = dynamics::to_modal(plant(true));
  EXPECT_THROW((void)shapes_of(modal, {{"P", 1}}), core::InputError) << "Q has no label";
  modal.left *= 2.0;
  EXPECT_THROW((void)shapes_of(modal, labels), core::InputError);
  UffShape shape;
  shape.nodes = {1, 2};
  shape.displacement = Eigen::MatrixXcd::Ones(1, 3);
  EXPECT_THROW(write_uff_shapes(path("modes.unv"), {shape}), core::InputError);
  shape.displacement = Eigen::MatrixXcd::Constant(2, 3, std::nan(""));
  EXPECT_THROW(write_uff_shapes(path("modes.unv"), {shape}), core::NumericalError);
  EXPECT_TRUE(is_empty());
}

}  // namespace thinwall::io::test::uff_shapes_test
