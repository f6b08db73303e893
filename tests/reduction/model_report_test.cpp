#include "reduction/trust/model_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "reduction/methods/reduce.hpp"
#include "tests/reduction/reducible_part.hpp"

namespace thinwall::reduction::model_report_test {
namespace {

using Eigen::MatrixXd;

const Eigen::Vector3d size(0.3, 0.2, 0.06);

/// The points of small_part().
const Positions positions{{"P", {0.3, 0.11, 0.03}}, {"Q", {0.1, 0.2, 0.03}}, {"R", {0.2, 0.05, 0.06}}};

dynamics::SpatialModel reduced(bool held, Method method, int modes) {
  const Reducible part = small_part(held);
  return std::get<dynamics::SpatialModel>(
      reduce(method, part.full, part.interface, {.modes = modes, .characteristic = 9}).model);
}

std::string what_is_wrong(const ReducedModelReport& report) {
  std::string names;
  for (const Finding& each : report.findings) {
    if (!each.ok) names += (names.empty() ? "" : ", ") + each.name;
  }
  return names;
}

/// The block in closed form: ρV, its middle, m (b² + c²)/12.
void expect_block(const dynamics::RigidBody& body, double tolerance) {
  const fem::MassProperties exact = fem::box_mass_properties(size, steel.density_kg_m3);
  EXPECT_NEAR(body.mass_kg / exact.mass_kg, 1.0, tolerance);
  EXPECT_LT((body.centre_m - exact.centre_m).norm(), tolerance * size.norm());
  EXPECT_LT((body.inertia_kg_m2 - exact.inertia_kg_m2).norm(), tolerance * exact.inertia_kg_m2.norm());
}

TEST(ModelReport, OfEveryReductionOfAFreeBlockHasItsMassCentreAndInertia) {
  for (const Method method : {Method::guyan, Method::craig_bampton, Method::characteristic_constraint_modes,
                              Method::rubin, Method::macneal, Method::craig_chang}) {
    const ReducedModelReport found = report(reduced(false, method, 12), {.positions = positions, .rigid_motions = 6});
    EXPECT_TRUE(found.trustworthy()) << name(method) << ": " << what_is_wrong(found) << "\n" << text(found);
    ASSERT_TRUE(found.rigid);
    expect_block(found.rigid->body, 1e-6);
    EXPECT_EQ(found.rigid->free_motions, 6);
    EXPECT_EQ(found.translations, 9);
    std::printf("%-31s sets disagree by %.1e (stiffness), %.1e (modes), mass by %.1e, grounding %.1e Hz\n",
                name(method).c_str(), found.rigid->sets.stiffness_disagreement, found.rigid->sets.eigen_disagreement,
                found.rigid->mass_disagreement, found.rigid->grounding_hz.maxCoeff());
  }
}

TEST(ModelReport, EffectiveMassesOfAllModesAreTheRigidBodysButForTheInterfacesOwn) {
  const Reducible part = small_part(false);
  const int all = static_cast<int>(part.full.K.rows() - part.interface.W.cols());
  const ReducedModelReport found =
      report(reduced(false, Method::craig_bampton, all), {.positions = positions, .reference = size / 2});
  ASSERT_TRUE(found.rigid && found.rigid->effective.available);
  const EffectiveMass& effective = found.rigid->effective;
  ASSERT_EQ(effective.mass.rows(), all);
  // The interface's own, from the full mass matrix alone.
  const MatrixXd W = part.interface.W;
  const MatrixXd mobility = W.transpose() * MatrixXd(part.full.M).llt().solve(W);
  const MatrixXd r = rigid_motions_of(part.interface.dofs, physical_rows(part.interface.dofs), positions, size / 2);
  const Eigen::VectorXd own = (r.transpose() * mobility.llt().solve(r)).diagonal();
  const fem::MassProperties exact = fem::box_mass_properties(size, steel.density_kg_m3);
  Eigen::VectorXd rigid(6);
  rigid << Eigen::Vector3d::Constant(exact.mass_kg), exact.inertia_kg_m2.diagonal();
  for (Eigen::Index k = 0; k < 6; ++k) {
    const double sum = effective.mass.col(k).sum() + own(k);
    std::printf("direction %td: effective mass of all modes and the interface over the block's: 1 %+.1e\n", k,
                sum / rigid(k) - 1.0);
    EXPECT_NEAR(sum / rigid(k), 1.0, 1e-6) << k;
    EXPECT_GT(effective.mass.col(k).sum(), 0.5 * rigid(k)) << "most of it is the modes'";
  }
  EXPECT_LT(effective.closure, 1e-6);
}

TEST(ModelReport, OfAnImportedFullModelNeedsNoReduction) {
  const fem::Model block_model = block(size, {2, 1, 1}, 1, false);
  dynamics::SpatialModel model = dense(block_model.K, block_model.M);
  Positions nodes;
  for (std::size_t row = 0; row < model.dofs.size(); ++row) {
    const int node = block_model.free_rows[row] / 3, axis = block_model.free_rows[row] % 3;
    model.dofs[row] = {"N" + std::to_string(node), Eigen::Vector3d::Unit(axis), dynamics::DofKind::translation};
    nodes["N" + std::to_string(node)] = block_model.nodes.positions.row(node).transpose();
  }
  const ReducedModelReport found = report(model, {.positions = nodes, .rigid_motions = 6});
  EXPECT_TRUE(found.trustworthy()) << what_is_wrong(found);
  expect_block(found.rigid->body, 1e-9);
  EXPECT_NE(text(found).find("nothing found against this model"), std::string::npos);
  EXPECT_NE(text(found).find("mass 28.26 kg"), std::string::npos) << text(found);
}

TEST(ModelReport, AHeldPartHasNoFreeMotions) {
  const auto model = reduced(true, Method::craig_bampton, 12);
  const ReducedModelReport held = report(model, {.positions = positions, .rigid_motions = 0});
  EXPECT_TRUE(held.trustworthy()) << what_is_wrong(held);
  EXPECT_EQ(held.rigid->free_motions, 0);
  EXPECT_EQ(held.rigid->sets.without_energy, 0);
  EXPECT_EQ(what_is_wrong(report(model, {.positions = positions, .rigid_motions = 6})), "free rigid motions");
}

TEST(ModelReport, FindsWhatIsWrong) {
  const dynamics::SpatialModel good = reduced(false, Method::craig_bampton, 12);
  const auto wrong = [&](const auto& spoil) {
    dynamics::SpatialModel model = good;
    Positions moved = positions;
    spoil(model, moved);
    return what_is_wrong(report(model, {.positions = moved, .rigid_motions = 6}));
  };
  const auto contains = [](const std::string& found, const std::string& name) {
    EXPECT_NE(found.find(name), std::string::npos) << name << " not in: " << found;
  };
  EXPECT_EQ(wrong([](auto&, auto&) {}), "");
  const std::string asymmetric = wrong([](auto& model, auto&) { model.K(0, 4) *= 1.01; });
  contains(asymmetric, "symmetry of K");
  contains(asymmetric, "reciprocity");
  contains(wrong([](auto& model, auto&) { model.M.diagonal()(2) *= -1.0; }), "least eigenvalue of M");
  contains(wrong([](auto& model, auto&) { model.K.diagonal()(11) *= -1.0; }), "least eigenvalue of K");
  contains(wrong([](auto& model, auto&) { model.K.diagonal()(11) *= -1.0; }), "least power");
  contains(wrong([](auto& model, auto&) { model.C(3, 3) = -1.0; }), "least eigenvalue of C");
  contains(wrong([](auto& model, auto&) { std::swap(model.dofs[0], model.dofs[4]); }), "rigid motions by stiffness");
  contains(wrong([](auto&, auto& moved) { moved.at("Q").x() += 0.005; }), "free rigid motions");
  contains(wrong([](auto& model, auto&) { model.K(0, 0) *= 1.001; }), "free rigid motions");
  contains(wrong([](auto& model, auto&) { model.M.row(0) *= 1.1, model.M.col(0) *= 1.1; }), "mass along the axes");
}

/// Three masses on springs: what is spoilt is named by its DOFs, in the report and in its text.
TEST(ModelReport, NamesTheDofsThatShowWhatIsWrong) {
  dynamics::SpatialModel good{
      MatrixXd::Identity(3, 3), MatrixXd::Zero(3, 3), MatrixXd(3, 3), {}, dynamics::translations("A")};
  good.K << 2e6, -1e6, 0, -1e6, 2e6, -1e6, 0, -1e6, 2e6;
  const auto place = [](const dynamics::SpatialModel& model, const std::string& letter) {
    const ReducedModelReport found = report(model);
    for (const MatrixState& matrix : found.matrices) {
      if (matrix.name != letter) continue;
      EXPECT_EQ(matrix.place.empty(), text(found).find("; see " + matrix.place + "\n") == std::string::npos);
      return matrix.place;
    }
    return std::string("no matrix");
  };
  EXPECT_EQ(place(good, "K"), "");
  dynamics::SpatialModel asymmetric = good, indefinite = good, negative = good;
  asymmetric.K(2, 1) = -0.5e6;
  indefinite.K(1, 1) = -9e6;
  negative.M(2, 2) = -1.0;
  EXPECT_EQ(place(asymmetric, "K"), "A.y, A.z");
  EXPECT_EQ(place(indefinite, "K"), "A.y");
  EXPECT_EQ(place(negative, "M"), "A.z");
  indefinite.T = MatrixXd::Identity(3, 3);
  EXPECT_EQ(place(indefinite, "K"), "coordinate 2");
}

TEST(ModelReport, AHingeIsFreeWhateverItsAxis) {
  const dynamics::RigidBody body{2.0, Eigen::Vector3d::Zero(), Eigen::Vector3d(0.02, 0.03, 0.04).asDiagonal()};
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, -2, 0.5)}) {
    const Eigen::Vector3d a = axis.normalized();
    MatrixXd K = 1e6 * MatrixXd::Identity(6, 6);
    K.bottomRightCorner(3, 3) -= 1e6 * a * a.transpose();
    const dynamics::SpatialModel model{
        dynamics::mass_matrix(body), MatrixXd::Zero(6, 6), K, {}, dynamics::six_dofs("A")};
    const ReducedModelReport found = report(model, {.positions = {{"A", {1.0, 2.0, 3.0}}}, .rigid_motions = 1});
    EXPECT_EQ(found.rigid->free_motions, 1) << axis.transpose();
    EXPECT_TRUE(found.trustworthy()) << what_is_wrong(found);
    ASSERT_EQ(found.rigid->in_words.size(), 1U);
    EXPECT_EQ(found.rigid->in_words[0].find("rotation about"), 0U) << found.rigid->in_words[0];
  }
}

/// A model for which nothing could be computed must not be reported as faultless.
TEST(ModelReport, OfWhatHasNoFrequenciesGivesNoVerdictOnReceptances) {
  const dynamics::SpatialModel good = reduced(true, Method::craig_bampton, 12);
  dynamics::SpatialModel bare = good, massless = good;
  for (MatrixXd* matrix : {&bare.K, &bare.M}) {
    matrix->row(4).setZero();
    matrix->col(4).setZero();
  }
  massless.M.setZero();
  for (const ReportOptions& options : {ReportOptions{}, ReportOptions{.positions = positions}}) {
    const ReducedModelReport of_bare = report(bare, options), of_massless = report(massless, options);
    for (const ReducedModelReport* found : {&of_bare, &of_massless}) {
      EXPECT_NE(what_is_wrong(*found).find("frequencies found"), std::string::npos) << text(*found);
      EXPECT_TRUE(std::isnan(found->reciprocity) && std::isnan(found->least_power));
      EXPECT_EQ(text(*found).find("reciprocity"), std::string::npos) << "a verdict on what was not computed";
    }
    EXPECT_EQ(what_is_wrong(of_bare).find("DOFs without mass and stiffness"), 0U) << what_is_wrong(of_bare);
    EXPECT_NE(text(of_bare).find(name(good.dofs[4])), std::string::npos) << text(of_bare);
    EXPECT_EQ(what_is_wrong(of_massless).find("DOFs without"), std::string::npos) << "they have stiffness";
  }
}

/// A full model of n points whose mass matrix is singular but for round-off in a motion that is no rigid one, as that
/// of ten-node tetrahedra integrated at four points is: the sum over the modes, of which there are none, closes.
TEST(ModelReport, AMassMatrixThatIsSingularToRoundOffClosesItsEffectiveMasses) {
  constexpr int points = 9, n = 3 * points;
  Positions places;
  dynamics::DofTable dofs;
  for (int i = 0; i < points; ++i) {
    const std::string point = "N" + std::to_string(i);
    places[point] = Eigen::Vector3d(i % 3, i / 3, (i * i) % 5);
    for (const auto& dof : dynamics::translations(point)) dofs.push_back(dof);
  }
  Eigen::VectorXd massless(n);
  for (int i = 0; i < n; ++i) massless(i) = i % 2 == 0 ? 1.0 : -1.0;
  massless.normalize();
  const MatrixXd M = MatrixXd::Identity(n, n) - (1.0 - 2e-15) * massless * massless.transpose();
  const std::vector<int> rows = physical_rows(dofs);
  const MatrixXd Y = rigid_motions_of(dofs, rows, places, Eigen::Vector3d::Zero());
  const EffectiveMass found = effective_mass(MatrixXd::Identity(n, n), M, MatrixXd::Identity(n, n), Y);
  ASSERT_TRUE(found.available);
  EXPECT_LT(found.closure, 1e-12) << "through the inverse of M it is 8e-3";
  EXPECT_LT((found.interface_own - found.total).norm(), 1e-12 * found.total.norm());
}

/// Two coordinates that are one: their difference has neither stiffness nor mass.
TEST(ModelReport, WhatKAndMBothLackIsToldAsDependentCoordinates) {
  MatrixXd K(2, 2), T(3, 2);
  K << 2e6, -1e6, -1e6, 2e6;
  T << 1.0, 0.0, 0.0, 0.6, 0.0, 0.4;  // the third and the second coordinate move as one
  const dynamics::SpatialModel model{
      T * T.transpose(), MatrixXd::Zero(3, 3), T * K * T.transpose(), {}, dynamics::translations("A")};
  const ReducedModelReport found = report(model);
  EXPECT_EQ(what_is_wrong(found), "motions without mass and stiffness, frequencies found") << text(found);
  EXPECT_NE(text(found).find("K and M share a null space, in which A."), std::string::npos) << text(found);
  EXPECT_EQ(text(found).find("missing, zero or singular"), std::string::npos) << text(found);
}

/// Nine coordinates with mass and as many without.
TEST(ModelReport, OfFewModesBesideCoordinatesWithoutMass) {
  const ReducedModelReport found =
      report(reduced(false, Method::macneal, 3), {.positions = positions, .rigid_motions = 6});
  EXPECT_TRUE(found.trustworthy()) << what_is_wrong(found);
  EXPECT_EQ(found.rigid->sets.without_energy, 6);
}

TEST(ModelReport, PassivityIsLostWhereStiffnessGivesEnergy) {
  dynamics::SpatialModel model = reduced(false, Method::craig_bampton, 12);
  EXPECT_GE(report(model).least_power, -1e-9);
  model.D = -0.01 * model.K;
  EXPECT_EQ(what_is_wrong(report(model)), "least eigenvalue of D");
}

TEST(ModelReport, OfOnePointSaysWhichQuestionsItCannotAnswer) {
  const Reducible part = small_part(true, 1);
  const auto model =
      std::get<dynamics::SpatialModel>(reduce(Method::craig_bampton, part.full, part.interface, {.modes = 5}).model);
  const ReducedModelReport found = report(model, {.positions = positions});
  EXPECT_EQ(found.rigid->sets.seen, 3);
  EXPECT_TRUE(found.trustworthy()) << "one point is no fault";
  EXPECT_NE(text(found).find("rigid body not judged: the DOFs show 3 of 6 motions"), std::string::npos);
  EXPECT_EQ(what_is_wrong(report(model, {.positions = positions, .rigid_motions = 6})),
            "rigid motions that the DOFs can show, modes without energy")
      << "it is held: none is free, whatever the point sees";
  EXPECT_TRUE(report(model, {.positions = positions, .rigid_motions = 0}).trustworthy());
  EXPECT_EQ(what_is_wrong(report(model, {.rigid_motions = 1})), "modes without energy");
  EXPECT_TRUE(report(model).trustworthy()) << "without positions nothing is asked about rigid motions";
}

/// A point with rotations shows all six; a beam's ends do, too.
TEST(ModelReport, RotationsCountAsMotionsOfAPoint) {
  dynamics::RigidBody body{2.0, {0.1, 0.0, -0.2}, Eigen::Vector3d(0.02, 0.03, 0.04).asDiagonal()};
  dynamics::SpatialModel model{
      dynamics::mass_matrix(body), MatrixXd::Zero(6, 6), MatrixXd::Zero(6, 6), {}, dynamics::six_dofs("A")};
  const Eigen::Vector3d at(1.0, 2.0, 3.0);
  const ReducedModelReport found = report(model, {.positions = {{"A", at}}});
  ASSERT_EQ(found.rigid->sets.seen, 6);
  EXPECT_NEAR(found.rigid->body.mass_kg, 2.0, 1e-12);
  EXPECT_LT((found.rigid->body.centre_m - at - body.centre_m).norm(), 1e-12);
  EXPECT_LT((found.rigid->body.inertia_kg_m2 - body.inertia_kg_m2).norm(), 1e-12);
  EXPECT_EQ(found.rotations, 3);
}

TEST(ModelReport, BadInputIsRefused) {
  const dynamics::SpatialModel model = reduced(false, Method::craig_bampton, 3);
  try {
    (void)report(model, {.positions = {{"P", {0, 0, 0}}}});
    FAIL() << "Q has no position";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"Q\""), std::string::npos) << error.what();
  }
  dynamics::SpatialModel short_table = model;
  short_table.dofs.pop_back();
  EXPECT_THROW((void)report(short_table), core::InputError);
  dynamics::SpatialModel nameless = model;
  for (auto& dof : nameless.dofs) dof.kind = dynamics::DofKind::modal;
  EXPECT_THROW((void)report(nameless), core::InputError);
}

}  // namespace
}  // namespace thinwall::reduction::model_report_test
