// Assemblies with known answers: beams of beams, springs inside a component, joints given as matrices; and inputs that
// are refused.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "coupling/receptance.hpp"
#include "coupling/route_difference.hpp"
#include "coupling/spatial.hpp"
#include "masses.hpp"

namespace thinwall::coupling::assemblies_test {
namespace {

using dynamics::DofKind;
using dynamics::ResponseModel;
using dynamics::SpatialModel;
const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
constexpr double rigid = std::numeric_limits<double>::infinity();

/// A free Euler-Bernoulli beam along x of equal elements, DOFs y and rz at its nodes (cubic shapes; Craig & Kurdila
/// 2006, Eq. 14.20-21), steel of 20 x 20 mm, `length` an element; C = 1e-5 K.
SpatialModel beam(const std::vector<std::string>& nodes, double length) {
  const double EI = 210e9 * std::pow(0.02, 4) / 12.0, mass = 7850.0 * 0.02 * 0.02 * length, a = length;
  Eigen::Matrix4d K, M;
  K << 12, 6 * a, -12, 6 * a, 6 * a, 4 * a * a, -6 * a, 2 * a * a, -12, -6 * a, 12, -6 * a, 6 * a, 2 * a * a, -6 * a,
      4 * a * a;
  M << 156, 22 * a, 54, -13 * a, 22 * a, 4 * a * a, 13 * a, -3 * a * a, 54, 13 * a, 156, -22 * a, -13 * a, -3 * a * a,
      -22 * a, 4 * a * a;
  const auto n = 2 * static_cast<Eigen::Index>(nodes.size());
  SpatialModel model{Eigen::MatrixXd::Zero(n, n), {}, Eigen::MatrixXd::Zero(n, n), {}, {}};
  for (Eigen::Index i = 0; i + 2 < n; i += 2) {
    model.K.block(i, i, 4, 4) += EI / (a * a * a) * K;
    model.M.block(i, i, 4, 4) += mass / 420.0 * M;
  }
  model.C = 1e-5 * model.K;
  for (const std::string& node : nodes) {
    model.dofs.push_back({node, y, DofKind::translation});
    model.dofs.push_back({node, z, DofKind::rotation});
  }
  return model;
}

const std::vector<ContactSpring> welded{{y}, {z, rigid, 0.0, 0.0, DofKind::rotation}};

std::vector<ResponseModel> responses(const std::vector<SpatialModel>& components, const dynamics::FrequencyAxis& axis) {
  std::vector<ResponseModel> all;
  for (const SpatialModel& component : components) all.push_back(dynamics::direct_response(component, axis));
  return all;
}

double largest_difference(const ResponseModel& G, const ResponseModel& other, const std::string& response,
                          const std::string& force) {
  const Eigen::VectorXcd a = dynamics::entry(G, response, force), b = dynamics::entry(other, response, force);
  return ((a - b).array().abs() / (a.array().abs() + 1e-3 * a.array().abs().mean())).maxCoeff();
}

TEST(Beams, ThreeThatAreWeldedAreOneByBothRoutes) {
  const auto axis = dynamics::logarithmic_axis(200.0, 6000.0, 80);
  const auto whole = dynamics::direct_response(beam({"a", "b", "c", "d", "e", "f", "g"}, 0.05), axis);
  const std::vector<SpatialModel> parts{beam({"a", "b", "c"}, 0.05), beam({"C", "d", "e"}, 0.05),
                                        beam({"E", "f", "g"}, 0.05)};
  const std::vector<Contact> contacts{{"c", "C", welded}, {"e", "E", welded}};
  const auto spatial = dynamics::direct_response(couple(parts, contacts), axis);
  const auto receptance = couple(responses(parts, axis), contacts);
  EXPECT_EQ(receptance.status, KernelStatus::well_conditioned);
  for (const char* response : {"a.y", "c.rz", "d.y", "g.rz"}) {
    for (const char* force : {"a.y", "b.rz", "e.y", "g.rz"}) {
      EXPECT_LT(largest_difference(whole, spatial, response, force), 1e-8) << response << "/" << force;
      EXPECT_LT(largest_difference(whole, receptance.response, response, force), 1e-8) << response << "/" << force;
    }
  }
}

TEST(Beams, AMixedRouteJoinsRotationsToo) {
  const auto axis = dynamics::logarithmic_axis(200.0, 6000.0, 80);
  const SpatialModel left = beam({"a", "b"}, 0.05), right = beam({"B", "c"}, 0.05);
  for (const double K : {1e3, rigid}) {
    const std::vector<Contact> contacts{{"b", "B", {{y}, {z, K, 0.0, 0.0, DofKind::rotation}}}};
    const auto spatial = dynamics::direct_response(couple(left, right, contacts), axis);
    const auto mixed = direct_response(left, dynamics::direct_response(right, axis), contacts, axis);
    for (const char* entry : {"a.y", "a.rz", "b.rz"}) {
      EXPECT_LT(largest_difference(spatial, mixed, entry, "a.y"), 1e-9) << K << entry;
    }
  }
}

TEST(Beams, AHingeLeavesTheTurnsApart) {
  // two free beams hinged at their ends, static receptance of the hinge's turn excluded: only y is joined
  const auto axis = dynamics::linear_axis(50.0, 1000.0, 20);
  const std::vector<SpatialModel> parts{beam({"a", "b"}, 0.05), beam({"B", "c"}, 0.05)};
  const auto hinged = couple(responses(parts, axis), {{"b", "B", {{y}}}}).response;
  const auto y_b = dynamics::entry(hinged, "b.y", "a.y"), y_B = dynamics::entry(hinged, "B.y", "a.y");
  EXPECT_LT((y_b - y_B).cwiseAbs().maxCoeff(), 1e-10 * y_b.cwiseAbs().maxCoeff());
  const auto turn_b = dynamics::entry(hinged, "b.rz", "a.y"), turn_B = dynamics::entry(hinged, "B.rz", "a.y");
  EXPECT_GT((turn_b - turn_B).cwiseAbs().minCoeff(), 0.1 * turn_b.cwiseAbs().minCoeff());
}

TEST(InternalJoint, IsASpringBetweenTwoPointsOfOneComponent) {
  const auto axis = dynamics::logarithmic_axis(200.0, 6000.0, 60);
  const SpatialModel plain = beam({"a", "b", "c"}, 0.05);
  SpatialModel held = plain;
  const double K = 1e6, C = 20.0;
  const Eigen::VectorXd b = coordinate_row(plain, "a", y) - coordinate_row(plain, "c", y);
  held.K += K * b * b.transpose();
  held.C += C * b * b.transpose();
  const auto exact = dynamics::direct_response(held, axis);
  const std::vector<Contact> contact{{"a", "c", {{y, K, C}}}};
  const auto spatial = dynamics::direct_response(couple(std::vector{plain}, contact), axis);
  const auto receptance = couple(responses({plain}, axis), contact).response;
  for (const char* entry : {"a.y", "b.rz", "c.y"}) {
    EXPECT_LT(largest_difference(exact, spatial, entry, "a.y"), 1e-9) << entry;
    EXPECT_LT(largest_difference(exact, receptance, entry, "a.y"), 1e-9) << entry;
  }
}

TEST(JointMatrices, AreTheSpringsAlongTheirPrincipalDirections) {
  const auto axis = dynamics::linear_axis(5.0, 500.0, 50);
  const std::vector<SpatialModel> masses{testing::model({{1.0, 5.0, 1e6}, {2.0, 5.0, 3e6}, {3.0, 9.0, 2e6}}, "P"),
                                         testing::model({{9.0, 5.0, 4e6}, {8.0, 7.0, 1e6}, {7.0, 9.0, 9e6}}, "R")};
  Eigen::Matrix3d Q;
  Q << 2, -2, 1, 1, 2, 2, -2, -1, 2;
  Q /= 3.0;
  const Eigen::Vector3d k(1e5, 1e7, 1e12), c(10.0, 100.0, 1000.0), eta(0.1, 0.01, 0.001);
  Contact principal{"P", "R", {}}, full{"P", "R", {{x}, {y}, {z}}};
  for (Eigen::Index i = 0; i < 3; ++i) principal.springs.push_back({Q.col(i), k(i), c(i), eta(i)});
  full.matrices = {Q * k.asDiagonal() * Q.transpose(), Q * c.asDiagonal() * Q.transpose(),
                   Q * k.cwiseProduct(eta).asDiagonal() * Q.transpose()};
  for (Eigen::MatrixXd* matrix : {&full.matrices.K, &full.matrices.C, &full.matrices.D}) {
    *matrix = (0.5 * (*matrix + matrix->transpose())).eval();
  }
  const auto H = responses(masses, axis);
  const auto exact = couple(H, {principal}).response;
  // K of condition 1e7 holds its smallest stiffness to 1e-9
  EXPECT_LT(route_difference(exact, couple(H, {full}).response).max_relative, 1e-8);
  EXPECT_LT(route_difference(exact, dynamics::direct_response(couple(masses, {full}), axis)).max_relative, 1e-8);
  const auto mixed = direct_response(masses[0], H[1], {full}, axis);
  EXPECT_LT(route_difference(between(exact, "P", "P"), mixed).max_relative, 1e-8);
}

TEST(WantedPoints, AreTheRowsAndColumnsOfTheWhole) {
  const auto axis = dynamics::linear_axis(50.0, 1000.0, 20);
  const auto H = responses({beam({"a", "b"}, 0.05), beam({"B", "c", "d"}, 0.05)}, axis);
  const std::vector<Contact> contacts{{"b", "B", welded}};
  const auto all = couple(H, contacts).response;
  const auto some = couple(H, contacts, {.points = {"d", "a"}}).response;
  ASSERT_EQ(some.responses.size(), 4U);
  for (const auto& response : some.responses) {
    for (const auto& force : some.forces) {
      EXPECT_LT(largest_difference(all, some, name(response), name(force)), 1e-12) << name(response) << name(force);
    }
  }
  EXPECT_THROW((void)couple(H, contacts, {.points = {"e"}}), core::InputError);
}

template <typename Action>
std::string refusal(Action action) {
  try {
    action();
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Refused, WithWhatIsWrongAndWhere) {
  const auto axis = dynamics::linear_axis(50.0, 1000.0, 20);
  const std::vector<SpatialModel> models{beam({"a", "b"}, 0.05), beam({"B", "c"}, 0.05), beam({"C", "a"}, 0.05)};
  const auto H = responses(models, axis);
  const std::vector<Contact> contacts{{"b", "B", welded}, {"c", "C", welded}};
  const auto says = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
  };
  says(refusal([&] { (void)couple(H, contacts); }), "components 1 and 3 both have a point \"a\"");
  says(refusal([&] { (void)couple(models, contacts); }), "components 1 and 3 both have a point \"a\"");
  const std::vector<ResponseModel> two{H[0], H[1]};
  says(refusal([&] { (void)couple(two, {{"b", "X", welded}}); }), "no component has a point \"X\"");
  says(refusal([&] { (void)couple(two, {{"b", "b", welded}}); }), "a contact joins two points");
  says(refusal([&] { (void)couple(two, {{"b", "B", {{y, 0.0}}}}); }), "stiffness (N/m) is 0");
  says(refusal([&] { (void)couple(two, {{"b", "B", {{z, -1.0, 0, 0, DofKind::rotation}}}}); }), "(N m/rad) is -1");
  says(refusal([&] { (void)couple(two, {{"b", "B", {{y, rigid, 0, 0, DofKind::modal}}}}); }), "kind of a direction");
  says(refusal([&] { (void)couple(two, {}); }), "without a contact");
  says(refusal([&] { (void)couple(std::vector<ResponseModel>{}, contacts); }), "without a component");
  auto broken = two;
  broken[1].H[3](0, 1) = std::nan("");
  says(refusal([&] { (void)couple(broken, {{"b", "B", welded}}); }), "at 200 Hz holds a value that is not finite");
  broken[1].H[3].resize(2, 2);
  says(refusal([&] { (void)couple(broken, {{"b", "B", welded}}); }), "is 2 x 2, but its tables name 4");
}

TEST(Refused, FrequencyAxesThatDiffer) {
  const std::vector<Contact> contacts{{"P", "R", {{x}}}};
  const auto part = testing::response({1.0, 1.0, 1e6}, "P", dynamics::linear_axis(10.0, 100.0, 10));
  const auto message = [&](const dynamics::FrequencyAxis& axis) {
    return refusal([&] { (void)couple(part, testing::response({1.0, 1.0, 1e6}, "R", axis), contacts); });
  };
  EXPECT_NE(message(dynamics::linear_axis(50.0, 140.0, 10)).find("both cover 50 to 100 Hz"), std::string::npos);
  EXPECT_NE(message(dynamics::linear_axis(200.0, 400.0, 11)).find("one ends at 100 Hz, the other begins at 200 Hz"),
            std::string::npos);
}

TEST(Refused, JointMatricesThatNoJointHas) {
  const std::vector<ContactSpring> directions{{y}, {z, rigid, 0.0, 0.0, DofKind::rotation}};
  const auto message = [&](const JointMatrices& matrices) {
    return refusal([&] { require_valid({{"b", "B", directions, matrices}}); });
  };
  const auto matrix = [](double a, double b, double c, double d) {
    Eigen::MatrixXd all(2, 2);
    all << a, b, c, d;
    return all;
  };
  const Eigen::MatrixXd good = matrix(1e8, 1e6, 1e6, 2e4);
  EXPECT_EQ(message({good, 1e-5 * good}), "accepted");
  EXPECT_NE(message({matrix(1e8, 1e6, 0.0, 2e4)}).find("K is not symmetric"), std::string::npos);
  EXPECT_NE(message({matrix(1e8, 2e6, 2e6, 2e4)}).find("smallest eigenvalue of K"), std::string::npos);
  EXPECT_NE(message({good, matrix(1.0, 2.0, 2.0, 1.0)}).find("smallest eigenvalue of C"), std::string::npos);
  EXPECT_NE(message({Eigen::MatrixXd::Identity(3, 3)}).find("rows of K is 3"), std::string::npos);
  EXPECT_NE(message({{}, good}).find("K is missing"), std::string::npos);
  EXPECT_NE(message({matrix(rigid, 0.0, 0.0, 1.0)}).find("not finite"), std::string::npos);
  EXPECT_NE(refusal([&] {
              require_valid({{"b", "B", {{y, 1e6}}, {Eigen::MatrixXd::Identity(1, 1)}}});
            }).find("one or the other"),
            std::string::npos);
}

}  // namespace
}  // namespace thinwall::coupling::assemblies_test
