// Points of six degrees of freedom on patches, averaging and rigid, with masses and springs, against closed forms.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "fem/interpolation.hpp"
#include "fem/points.hpp"
#include "fem/to_tolerance.hpp"
#include "mesh/planar/bend.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::fem::attached_points_test {
namespace {

using Words = std::vector<std::string>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

const Eigen::Vector3d size(0.2, 0.05, 0.03);
const Material steel{210e9, 0.3, 7850.0};
const Material slender{210e9, 0.0, 7850.0};  // no contraction: rods and beams are exact
const mesh::Region foot = mesh::PlaneRegion{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()};
const mesh::Region tip = mesh::PlaneRegion{{0.2, 0, 0}, Eigen::Vector3d::UnitX()};
const std::vector<Eigen::Vector3d> xyz{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
const NamedPoint tip_point{"tip", Eigen::Vector3d::Zero(), 0.0, xyz, xyz, tip};

mesh::TetMesh bar() {
  return mesh::kuhn_box(size, {4, 2, 2});
}

Attachments at_tip(Connection connection) {
  Attachments attachments;
  attachments.points.push_back({"tip", tip, connection});
  return attachments;
}

Modes modes_of(const Model& model, int count) {
  const Factored factored = factorise(model);
  return modes(model, factored, {.count = count, .up_to_hz = {}});
}

template <class Function>
std::string message_of(const Function& function) {
  try {
    function();
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(PatchAverage, SeesRigidMotionsExactlyAndSpreadsAMomentWithoutForce) {
  for (const bool curved : {false, true}) {
    auto nodes = mesh::lagrange_nodes(bar(), 3);
    if (curved) mesh::bend({0.3, 0, 2, 0.0, 0.015}, nodes.positions);
    for (const Patch& patch : {Patch(Disc{{0.1, 0.02, 0.03}, 0.012}), Patch(tip)}) {
      const PatchAverage average = patch_average(bar(), nodes, patch, "P");
      const Eigen::Matrix3d J_inverse = inverse_spread(average, "P");
      const Eigen::Vector3d shift(0.3, -0.2, 0.5);
      const Eigen::Vector3d turn(1.0, -2.0, 0.7);
      Eigen::Matrix<double, 6, 1> seen = Eigen::Matrix<double, 6, 1>::Zero();
      Matrix6 load = Matrix6::Zero();  // force and moment about the centre of each functional's transpose
      for (std::size_t a = 0; a < average.nodes.size(); ++a) {
        const Eigen::Vector3d r = nodes.positions.row(average.nodes[a]).transpose() - average.centre_m;
        const auto rows = motion_of_node(average, static_cast<Eigen::Index>(a), J_inverse);
        seen += rows * (shift + turn.cross(r));
        load.leftCols<3>() += rows;
        load.rightCols<3>() += rows * cross_matrix(r).transpose();
      }
      Eigen::Matrix<double, 6, 1> expected;
      expected << shift, turn;
      EXPECT_LT((seen - expected).norm(), 1e-12);
      EXPECT_LT((load - Matrix6::Identity()).norm(), 1e-12 / 0.01);
    }
  }
}

TEST(PatchAverage, OfAPlaceOrALineHasNoTurn) {
  const auto nodes = mesh::lagrange_nodes(bar(), 2);
  const auto single = patch_average(bar(), nodes, Disc{{0.1, 0.02, 0.03}, 0.0}, "P");
  EXPECT_NE(message_of([&] { (void)inverse_spread(single, "P"); }).find("\"P\" is a single place"), std::string::npos);
  PatchAverage line;  // along y
  line.nodes = {0, 1};
  line.spread_m2 = Eigen::Vector3d(1e-4, 0.0, 1e-4).asDiagonal();
  const std::string message = message_of([&] { (void)inverse_spread(line, "Q"); });
  EXPECT_NE(message.find("\"Q\": its patch lies on one line"), std::string::npos) << message;
  EXPECT_NE(message_of([&] {
              (void)patch_average(bar(), nodes, Disc{{0.1, 0.02, 0.04}, 0.01}, "R");
            }).find("\"R\""),
            std::string::npos);
}

// Traction that grows with the distance from the axis is what a bent beam has inside, and a plane section stays plane.
TEST(Point, UnderAMomentBendsABeamByItsClosedFormThroughEitherConnection) {
  const double E = 210e9;
  for (const Connection connection : {Connection::averaging, Connection::rigid}) {
    const Model model = supported_model(bar(), 2, slender, {{"foot", foot, {0, 1, 2}}}, {}, at_tip(connection));
    const Factored factored = factorise(model);
    const Eigen::MatrixXd W = point_columns(model, tip_point);
    const Eigen::MatrixXd H = W.transpose() * factored.factor.solve(W);
    EXPECT_LT((H - H.transpose()).norm(), 1e-10 * H.norm());
    const double Iy = size.y() * std::pow(size.z(), 3) / 12.0;
    const double Iz = size.z() * std::pow(size.y(), 3) / 12.0;
    EXPECT_NEAR(H(0, 0) * E * size.y() * size.z() / size.x(), 1.0, 1e-9);
    EXPECT_NEAR(H(4, 4) * E * Iy / size.x(), 1.0, 1e-9) << "turn about y";
    EXPECT_NEAR(H(5, 5) * E * Iz / size.x(), 1.0, 1e-9);
    EXPECT_NEAR(H(2, 4) * 2.0 * E * Iy / (size.x() * size.x()), -1.0, 1e-9) << "moment about y lowers the tip";
    EXPECT_NEAR(H(1, 5) * 2.0 * E * Iz / (size.x() * size.x()), 1.0, 1e-9);
  }
}

TEST(Point, OnASupportOrWithoutAPatchIsAnErrorThatNamesIt) {
  const Model model = supported_model(bar(), 2, steel, {{"foot", foot, {0, 1, 2}}});
  NamedPoint held = tip_point;
  held.faces = foot;
  held.directions.clear();
  EXPECT_NE(message_of([&] { (void)point_columns(model, held); }).find("\"tip\" cannot turn about"), std::string::npos);
  NamedPoint bare{"P", {0.1, 0.02, 0.03}, 0.0, {}, {xyz[0]}, {}};
  EXPECT_NE(message_of([&] { (void)point_columns(model, bare); }).find("\"P\" is a single place"), std::string::npos);
}

/// A body's 6 × 6 mass about the origin.
Matrix6 mass_at_origin(const MassProperties& body) {
  return matrix_at_point(PointMass{"", body.mass_kg, body.inertia_kg_m2, body.centre_m});
}

const Eigen::Matrix3d some_inertia = (Eigen::Matrix3d() << 3e-4, 1e-4, 0, 1e-4, 4e-4, 5e-5, 0, 5e-5, 5e-4).finished();

TEST(PointMass, AddsItsMassCentreAndInertiaToTheRigidMotions) {
  for (const Connection connection : {Connection::averaging, Connection::rigid}) {
    Attachments attachments = at_tip(connection);
    attachments.masses.push_back({"tip", 0.7, some_inertia, {0.02, -0.01, 0.03}});
    const Model model = supported_model(bar(), 2, steel, {}, {}, attachments);
    const Eigen::MatrixXd R = rigid_body_motions(model);
    const MassProperties body{0.7, Eigen::Vector3d(0.22, 0.015, 0.045), some_inertia};
    const Matrix6 expected = mass_at_origin(model.mass) + mass_at_origin(body);
    EXPECT_LT((R.transpose() * (model.M * R) - expected).norm(), 1e-12 * expected.norm());
    EXPECT_LT((model.K * R).norm(), 1e-9 * model.K.norm() * R.norm());
    EXPECT_EQ(model.rigid_motions, 6);
    EXPECT_EQ(modes_of(model, 3).rigid_motions, 6);
  }
}

// So stiff a part moves as one on its spring: the six frequencies of Rᵀ K R and Rᵀ M R by hand.
TEST(GroundSpring, HoldsARigidPartWithItsSixFrequencies) {
  const Material hard{3e15, 0.3, 7850.0};
  const mesh::Region end = mesh::PlaneRegion{{0.06, 0, 0}, Eigen::Vector3d::UnitX()};
  GroundSpring spring{"tip",
                      Eigen::Vector3d(3e6, 2e6, 4e6).asDiagonal(),
                      Eigen::Vector3d(5e3, 6e3, 7e3).asDiagonal(),
                      {-0.03, 0.01, 0.02}};
  spring.translation_N_m(0, 1) = spring.translation_N_m(1, 0) = 5e5;
  const PointMass mass{"tip", 0.7, some_inertia, {0.02, -0.01, 0.03}};
  const Eigen::Vector3d centre(0.06, 0.025, 0.025);
  for (const Connection connection : {Connection::averaging, Connection::rigid}) {
    Attachments attachments;
    attachments.points.push_back({"tip", end, connection});
    attachments.springs.push_back(spring);
    attachments.masses.push_back(mass);
    const Model model = supported_model(mesh::kuhn_box({0.06, 0.05, 0.05}, {2, 2, 2}), 2, hard, {}, {}, attachments);
    ASSERT_EQ(model.rigid_motions, 0);
    // A spring and a body equal to those before, but with offsets from the origin.
    GroundSpring from_origin = spring;
    from_origin.offset_m += centre;
    PointMass body = mass;
    body.offset_m += centre;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6> expected(
        matrix_at_point(from_origin), mass_at_origin(model.mass) + matrix_at_point(body));
    const Eigen::VectorXd f = expected.eigenvalues().cwiseSqrt() / (2.0 * std::numbers::pi);
    EXPECT_LT((modes_of(model, 6).frequency_hz - f).cwiseQuotient(f).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(GroundSpring, LeavesTheMotionsThatItDoesNotHold) {
  const auto left = [](const Eigen::Vector3d& k, const Eigen::Vector3d& turn) {
    Attachments attachments = at_tip(Connection::averaging);
    attachments.springs.push_back({"tip", k.asDiagonal(), turn.asDiagonal(), Eigen::Vector3d::Zero()});
    const Model model = supported_model(bar(), 2, steel, {}, {}, attachments);
    EXPECT_EQ(modes_of(model, 2).rigid_motions, model.rigid_motions);
    return model.free_motions;
  };
  EXPECT_EQ(left({1e6, 1e6, 1e6}, {1e3, 1e3, 1e3}), Words{});
  EXPECT_EQ(left({1e6, 0, 1e6}, {1e3, 1e3, 1e3}), Words{"translation along y"});
  EXPECT_EQ(left({1e6, 1e6, 1e6}, {0, 0, 1e3}).size(), 2U);
  EXPECT_EQ(left({1e6, 1e6, 1e6}, {0, 1e3, 1e3}), Words{"rotation about x through (0.1, 0.025, 0.015)"});
  EXPECT_EQ(left({1e6, 0, 0}, {0, 0, 0}).size(), 5U);
  EXPECT_EQ(left({1e-9, 1e6, 1e6}, {1e3, 1e3, 1e3}), Words{"translation along x"}) << "softer than round-off";
}

/// First solution of g in (from, to), g rising there through zero.
template <class Function>
double root(const Function& g, double from, double to) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (from + to);
    (g(middle) > 0.0 ? to : from) = middle;
  }
  return 0.5 * (from + to);
}

// A rod in a smooth tube: βL tan βL = m_rod/m_tip with a mass at its end, tan βL / βL = −EA/(k L) with a spring.
TEST(Rod, WithAMassOrASpringAtItsEndHasTheClosedForm) {
  std::vector<Support> tube{{"foot", foot, {0, 1, 2}}};
  for (const int axis : {1, 2}) {
    for (const double at : {0.0, size(axis)})
      tube.push_back(
          {"wall", mesh::PlaneRegion{at * Eigen::Vector3d::Unit(axis), Eigen::Vector3d::Unit(axis)}, {1, 2}});
  }
  const double c = std::sqrt(210e9 / 7850.0);
  const double area = size.y() * size.z();
  const double m_rod = 7850.0 * size.prod();
  const auto hertz = [&](double beta_L) { return beta_L * c / (2.0 * std::numbers::pi * size.x()); };
  const double pi = std::numbers::pi;
  Attachments mass = at_tip(Connection::averaging);
  mass.masses.push_back({"tip", 2.0, Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero()});
  const double with_mass = root([&](double x) { return x * std::tan(x) - m_rod / 2.0; }, 0.0, 0.5 * pi);
  Attachments spring = at_tip(Connection::averaging);
  const double k = 3e9;
  spring.springs.push_back(
      {"tip", Eigen::Vector3d(k, 0, 0).asDiagonal(), Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero()});
  const double with_spring =
      root([&](double x) { return -(x * std::cos(x) * 210e9 * area / size.x() + k * std::sin(x)); }, 0.5 * pi, pi);
  for (const auto& [attachments, beta_L] : {std::pair{mass, with_mass}, std::pair{spring, with_spring}}) {
    const Model rod = supported_model(mesh::kuhn_box(size, {4, 1, 1}), 5, slender, tube, {}, attachments);
    EXPECT_NEAR(modes_of(rod, 1).frequency_hz(0) / hertz(beta_L), 1.0, 1e-6);
  }
}

// The stored energy k |u|² + moment k J of a spring spread over the face: the mean rigid motion stores less, and a face
// held rigid can only store more, so that every frequency rises from averaging over the bed to rigid (Courant and
// Fischer).
TEST(Connections, BracketASpreadSpring) {
  const double k = 4e11;  // N/m³
  Attachments bed;
  bed.clamps.push_back({"bed", tip, k, k});
  const auto with = [&](Connection connection) {
    Attachments attachments = at_tip(connection);
    const PatchAverage average = patch_average(bar(), mesh::lagrange_nodes(bar(), 2), tip, "tip");
    const double total = k * size.y() * size.z();
    attachments.springs.push_back(
        {"tip", total * Eigen::Matrix3d::Identity(), total * average.spread_m2, Eigen::Vector3d::Zero()});
    return modes_of(supported_model(bar(), 2, steel, {}, {}, attachments), 12).frequency_hz;
  };
  const Eigen::VectorXd spread = modes_of(supported_model(bar(), 2, steel, {}, {}, bed), 12).frequency_hz;
  const Eigen::VectorXd averaging = with(Connection::averaging);
  const Eigen::VectorXd rigid = with(Connection::rigid);
  EXPECT_TRUE((averaging.array() <= spread.array() * (1.0 + 1e-9)).all());
  EXPECT_TRUE((spread.array() <= rigid.array() * (1.0 + 1e-9)).all());
  EXPECT_GT((rigid.array() / averaging.array()).maxCoeff(), 1.01);
}

/// T of u = T q by the definition, dense: unit displacements of the rows.
Eigen::MatrixXd expansion(const Model& model) {
  Eigen::MatrixXd T(3 * model.nodes.positions.rows(), model.K.rows());
  for (Eigen::Index j = 0; j < T.cols(); ++j)
    T.col(j) = displacements(model, Eigen::VectorXd::Unit(T.cols(), j)).reshaped<Eigen::RowMajor>();
  return T;
}

TEST(RigidPatch, CondensesTheFreeMatricesToItsSixRows) {
  for (const bool disc : {false, true}) {
    Attachments attachments = at_tip(Connection::rigid);
    if (disc) attachments.points[0].patch = Disc{{0.1, 0.025, 0.03}, 0.03};
    const Model model = supported_model(bar(), 2, steel, {{"foot", foot, {0, 1, 2}}}, {}, attachments);
    const Model free = supported_model(bar(), 2, steel, {});
    ASSERT_EQ(model.rigid.size(), 1U);
    EXPECT_EQ(model.node_of_row.back(), model.nodes.positions.rows());
    const Eigen::MatrixXd T = expansion(model);
    EXPECT_LT((T.transpose() * (free.K * T) - model.K).norm(), 1e-12 * model.K.norm());
    EXPECT_LT((T.transpose() * (free.M * T) - model.M).norm(), 1e-12 * model.M.norm());
    for (const int node : model.rigid[0].nodes) {
      const Eigen::Vector3d x = model.nodes.positions.row(node);
      if (disc) {
        EXPECT_TRUE(std::abs(x.z() - 0.03) < 1e-12 && std::hypot(x.x() - 0.1, x.y() - 0.025) < 0.03 + 1e-9);
      } else {
        EXPECT_NEAR(x.x(), 0.2, 1e-12);
      }
    }
    EXPECT_GT(model.rigid[0].nodes.size(), 8U);
    const Eigen::VectorXd q = Eigen::VectorXd::Random(model.K.rows());
    EXPECT_LT((on_rows(model, displacements(model, q)) - q).norm(), 1e-11 * q.norm());
  }
}

TEST(RigidPatch, IsCarriedFromOneOrderToTheNext) {
  const auto model = [](int order) {
    return supported_model(bar(), order, steel, {{"foot", foot, {0, 1, 2}}}, {}, at_tip(Connection::rigid));
  };
  const Model low = model(2);
  const Model high = model(3);
  const Eigen::VectorXd q = Eigen::VectorXd::Random(low.K.rows());
  const Eigen::VectorXd carried = interpolated(low, q, high);
  const NamedPoint inside{"P", {0.13, 0.02, 0.01}, 0.0, xyz, {}, {}};
  for (const NamedPoint& point : {inside, tip_point}) {
    const Eigen::VectorXd expected = point_columns(low, point).transpose() * q;
    EXPECT_LT((point_columns(high, point).transpose() * carried - expected).norm(), 1e-10 * expected.norm());
  }
}

TEST(RigidPatch, JoinsPiecesToOneBody) {
  mesh::TetMesh two = mesh::kuhn_box({0.1, 0.05, 0.03}, {2, 2, 2});
  const auto one = two;
  for (const auto& v : one.vertices) two.vertices.emplace_back(v + Eigen::Vector3d(0.15, 0, 0));
  for (auto tet : one.tets) {
    for (int& v : tet) v += static_cast<int>(one.vertices.size());
    two.tets.push_back(tet);
  }
  const mesh::Region lids = mesh::PlaneRegion{{0, 0, 0.03}, Eigen::Vector3d::UnitZ()};
  EXPECT_EQ(build_model(two, 2, steel, {}).rigid_motions, 12);
  Attachments attachments;
  attachments.points.push_back({"bridge", lids, Connection::rigid});
  const Model joined = build_model(two, 2, steel, {}, attachments);
  EXPECT_EQ(joined.rigid_motions, 6);
  EXPECT_EQ(modes_of(joined, 3).rigid_motions, 6);
  attachments.points[0].connection = Connection::averaging;
  attachments.springs.push_back({"bridge", Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero(), {0, 0, 0}});
  EXPECT_NE(message_of([&] { (void)build_model(two, 2, steel, {}, attachments); }).find("pieces that do not hang"),
            std::string::npos);
}

TEST(Attachments, ThatCannotBeAreErrorsWithTheirNames) {
  const auto message = [](const Attachments& attachments, const std::vector<Support>& supports = {}) {
    return message_of([&] { (void)supported_model(bar(), 2, steel, supports, {}, attachments); });
  };
  Attachments a = at_tip(Connection::averaging);
  a.points.push_back(a.points[0]);
  a.masses.push_back({"tib", 1.0, Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero()});
  a.masses.push_back({"tip", -1.0, Eigen::Vector3d(1, 1, 3).asDiagonal(), Eigen::Vector3d::Zero()});
  a.springs.push_back(
      {"tip", Eigen::Vector3d(-1, 0, 0).asDiagonal(), Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero()});
  a.springs.push_back({"tip", Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(), Eigen::Vector3d::Constant(NAN)});
  a.springs[1].rotation_N_m(0, 1) = 1.0;
  const std::string all = message(a);
  for (const char* part :
       {"two connected points are called \"tip\"", "\"tib\" hangs on no connected point (did you mean", "-1 kg",
        "that of no body", "negative eigenvalue", "not symmetric", "not finite"})
    EXPECT_NE(all.find(part), std::string::npos) << part << " in " << all;
  EXPECT_NE(message(at_tip(Connection::rigid), {{"tip", tip, {1}}}).find("\"tip\" reaches nodes that a support holds"),
            std::string::npos);
  Attachments b = at_tip(Connection::rigid);
  b.points.push_back({"side", mesh::Region(mesh::PlaneRegion{{0, 0, 0}, {0, 1, 0}}), Connection::rigid});
  EXPECT_NE(message(b).find("\"tip\" and \"side\" share nodes"), std::string::npos);
  Attachments c;
  c.points.push_back({"P", Disc{{0.11, 0.02, 0.03}, 0.002}, Connection::rigid});
  EXPECT_NE(message(c).find("rigid connection \"P\" holds"), std::string::npos);
  Attachments d = at_tip(Connection::averaging);
  d.points[0].patch = foot;
  d.masses.push_back({"tip", 1.0, Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero()});
  EXPECT_NE(message(d, {{"foot", foot, {0, 1, 2}}}).find("\"tip\" lies on a support"), std::string::npos);
}

// The answer of the tolerance search against two orders more on a finer mesh.
TEST(Attachments, AreRefinedToATolerance) {
  SolidPart part;
  part.mesh = [](int level) { return mesh::kuhn_box(size, {4 << level, 1, 1}); };
  part.material = steel;
  part.attachments = at_tip(Connection::rigid);
  part.attachments.masses.push_back({"tip", 0.5, some_inertia, {0.03, 0, 0}});
  part.attachments.clamps.push_back({"bed", foot, 1e13, 5e12});
  part.materials = [](const mesh::TetMesh& mesh) {
    return Materials{{steel, {70e9, 0.3, 2700.0}}, std::vector<int>(mesh.tets.size(), 1)};
  };
  ToleranceOptions options;
  options.tolerance = 1e-2;
  options.modes.count = 4;
  options.points = {{"mid", {0.1, 0.02, 0.03}, 0.01, {Eigen::Vector3d::UnitZ()}, {Eigen::Vector3d::UnitY()}, {}}};
  options.first_order = 2;
  const Refined refined = refine_to_tolerance(part, options);
  EXPECT_TRUE(refined.estimate.met) << refined.estimate.frequency << ' ' << refined.estimate.receptance;
  const Model fine =
      supported_model(mesh::kuhn_box(size, {16, 2, 2}), 4, {70e9, 0.3, 2700.0}, {}, {}, part.attachments);
  const Eigen::VectorXd f = modes_of(fine, 4).frequency_hz;
  EXPECT_LT((refined.modes.frequency_hz.head(4) - f).cwiseQuotient(f).cwiseAbs().maxCoeff(), 1e-2);
}

}  // namespace
}  // namespace thinwall::fem::attached_points_test
