// Problems that cannot be solved give an error that names the cause: too large, too many modes, an impossible tolerance
// or shift.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "fem/modes.hpp"
#include "fem/to_tolerance.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::fem::limits_test {
namespace {

const Material steel{210e9, 0.3, 7850.0};
const mesh::Box box{{0.3, 0.2, 0.15}};

Support face(const std::string& name, std::vector<int> axes = {0, 1, 2}) {
  return {name, mesh::face_of(box, name), std::move(axes)};
}

Model cantilever(int cells, int order) {
  return supported_model(mesh::kuhn_box(box.size, {cells, cells, cells}), order, steel, {face("x_min")});
}

constexpr ModeOptions modes_wanted(int count) {
  return {.count = count, .up_to_hz = {}};
}

TEST(MemoryLimit, SaysHowManyDegreesOfFreedomFitAndTheyDo) {
  const Model model = cantilever(6, 3);
  const double needed = factorise(model).factor.statistics().bytes;
  const double limit = needed / 4.0;
  try {
    (void)factorise(model, limit);
    FAIL() << "accepted";
  } catch (const linalg::MemoryLimitError& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.needed_bytes, needed);
    EXPECT_EQ(error.limit_bytes, limit);
    EXPECT_EQ(message.find('\n'), std::string::npos) << "one line";
    const auto about = message.find("about ");
    ASSERT_NE(about, std::string::npos) << message;
    const int fitting = std::stoi(message.substr(about + 6));
    EXPECT_NE(message.find("of these " + std::to_string(model.K.rows()) + " degrees of freedom fit"), std::string::npos)
        << message;
    EXPECT_LT(fitting, model.K.rows());
    // A part with at most as many degrees of freedom as the message proposes fits, and nearly fills the limit.
    int cells = 6;
    Model smaller = cantilever(cells, 3);
    while (smaller.K.rows() > fitting) smaller = cantilever(--cells, 3);
    const double taken = factorise(smaller, limit).factor.statistics().bytes;
    std::printf("limit of a quarter: %s; %td rows take %.2f of the limit\n", message.c_str(), smaller.K.rows(),
                taken / limit);
    EXPECT_LE(taken, limit);
  }
}

TEST(Modes, AsManyAsDegreesOfFreedomOrMoreAreRefusedWithTheBound) {
  const Model model = cantilever(1, 1);
  ASSERT_EQ(model.K.rows(), 12);
  const Factored factored = factorise(model);
  EXPECT_EQ(modes(model, factored, modes_wanted(11)).frequency_hz.size(), 11);
  for (const int count : {12, 13, 1000, 0, -3}) {
    try {
      (void)modes(model, factored, modes_wanted(count));
      FAIL() << count;
    } catch (const core::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("12 degrees of freedom: ask for 1 to 11"), std::string::npos)
          << error.what();
    }
  }
  // A band that holds every mode is no error: all twelve come.
  const Modes all = modes(model, factored, {.count = 1, .up_to_hz = 1e9});
  EXPECT_EQ(all.frequency_hz.size(), 12);
}

TEST(Modes, ABandThatIsNoFrequencyIsRefused) {
  const Model model = cantilever(1, 2);
  const Factored factored = factorise(model);
  for (const double bound : {0.0, std::nan("")}) {
    EXPECT_THROW((void)modes(model, factored, {.count = 1, .up_to_hz = bound}), core::InputError) << bound;
  }
}

TEST(Modes, OfAPartThatSlidesInOneDirectionHaveOneRigidMode) {
  const Model model =
      supported_model(mesh::kuhn_box(box.size, {3, 2, 2}), 2, steel, {face("x_min", {0}), face("y_min", {1})});
  ASSERT_EQ(model.rigid_motions, 1);
  const Modes found = modes(model, factorise(model), modes_wanted(3));
  ASSERT_EQ(found.frequency_hz.size(), 4);
  EXPECT_EQ(found.frequency_hz(0), 0.0);
  EXPECT_GT(found.frequency_hz(1), 100.0);
  const auto u = displacements(model, found.pairs.Phi.col(0));
  EXPECT_LT((u.col(2).array() - u(0, 2)).abs().maxCoeff(), 1e-8 * std::abs(u(0, 2))) << "it moves along z";
}

TEST(Modes, OfTwoBlocksThatHangTogetherAtACornerAreNotTakenForElastic) {
  mesh::TetMesh two = mesh::kuhn_box({0.1, 0.1, 0.1}, {1, 1, 1});
  const auto first = static_cast<int>(two.vertices.size());
  const mesh::TetMesh other = two;
  // The second block's vertex 0 is the first one's vertex 7.
  for (std::size_t v = 1; v < other.vertices.size(); ++v)
    two.vertices.emplace_back(other.vertices[v] + Eigen::Vector3d(0.1, 0.1, 0.1));
  for (auto tet : other.tets) {
    for (int& v : tet) v = v == 0 ? 7 : v + first - 1;
    two.tets.push_back(tet);
  }
  const Model model = build_model(two, 2, steel, {});
  const Factored factored = factorise(model);
  try {
    (void)modes(model, factored, modes_wanted(4));
    FAIL() << "a ball joint: nine motions";
  } catch (const core::NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("6 rigid motions (translation along x, translation along y, "),
              std::string::npos)
        << error.what();
  }
}

TEST(Modes, OfAPartInTwoPiecesHaveTheRigidModesOfThePieceThatNothingHolds) {
  mesh::TetMesh two = mesh::kuhn_box({0.1, 0.1, 0.1}, {1, 1, 1});
  const mesh::TetMesh one = two;
  const auto first = static_cast<int>(one.vertices.size());
  for (const auto& x : one.vertices) two.vertices.emplace_back(x + Eigen::Vector3d(0.2, 0, 0));
  for (auto tet : one.tets) {
    for (int& v : tet) v += first;
    two.tets.push_back(tet);
  }
  const Support foot{"foot", mesh::PlaneRegion{{0, 0, 0}, {1, 0, 0}}, {0, 1, 2}};
  const Modes held = [&] {
    const Model model = supported_model(one, 3, steel, {foot});
    return modes(model, factorise(model), modes_wanted(4));
  }();
  const Model model = supported_model(two, 3, steel, {foot});
  ASSERT_EQ(model.rigid_motions, 6);
  EXPECT_EQ(model.free_motions.front(), "translation along x of the piece around (0.25, 0.05, 0.05)");
  const Modes found = modes(model, factorise(model), modes_wanted(4));
  EXPECT_LT(
      (found.frequency_hz.segment(6, 4) - held.frequency_hz).cwiseQuotient(held.frequency_hz).cwiseAbs().maxCoeff(),
      1e-8)
      << "the lowest elastic modes are the held piece's";
}

// One block clamped, the other on it along an edge: a hinge that no count of rigid motions sees.
TEST(Modes, OfABlockHingedToAHeldOneAreNeverSilentNumbers) {
  mesh::TetMesh two = mesh::kuhn_box({0.1, 0.1, 0.1}, {1, 1, 1});
  const mesh::TetMesh one = two;
  // The second block's vertices 0 and 4, its edge along z, are the first one's 3 and 7.
  std::vector<int> number(one.vertices.size());
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (v == 0 || v == 4) {
      number[v] = v == 0 ? 3 : 7;
    } else {
      number[v] = static_cast<int>(two.vertices.size());
      two.vertices.emplace_back(one.vertices[v] + Eigen::Vector3d(0.1, 0.1, 0));
    }
  }
  for (auto tet : one.tets) {
    for (int& v : tet) v = number[static_cast<std::size_t>(v)];
    two.tets.push_back(tet);
  }
  const Support foot{"foot", mesh::PlaneRegion{{0, 0, 0}, {1, 0, 0}}, {0, 1, 2}};
  for (int order = 1; order <= 5; ++order) {
    const Model model = supported_model(two, order, steel, {foot});
    ASSERT_EQ(model.rigid_motions, 0);
    try {
      const Modes found = modes(model, factorise(model), modes_wanted(4));
      ADD_FAILURE() << "order " << order << ": " << found.frequency_hz.transpose() << " Hz";
    } catch (const core::NumericalError& error) {
      std::printf("hinged block, order %d: %s\n", order, error.what());
    }
  }
}

TEST(ShiftOnAnEigenvalue, OfTheModelIsAnErrorAtTheFactorisation) {
  const Model model = cantilever(2, 2);
  const Modes found = modes(model, factorise(model), modes_wanted(4));
  for (const Eigen::Index k : {1, 2, 3}) {
    const double sigma = found.pairs.lambda(k);
    EXPECT_THROW(linalg::SparseCholesky(model.K, -sigma, model.M, model.node_of_row), core::NumericalError)
        << "λ" << k + 1;
  }
}

TEST(ToleranceOptions, OutOfRangeAreRefusedBeforeAnythingIsMeshed) {
  SolidPart part;
  part.mesh = [](int) -> mesh::TetMesh { throw std::logic_error("meshed"); };
  part.material = steel;
  const auto message = [&](const ToleranceOptions& options) -> std::string {
    try {
      (void)refine_to_tolerance(part, options);
    } catch (const core::InputError& error) {
      return error.what();
    } catch (const std::logic_error& error) {
      return error.what();
    }
    return "accepted";
  };
  for (const double tolerance : {0.0, -1e-3, 0.99e-6, 0.11, 1.0, std::nan(""), double(INFINITY)}) {
    ToleranceOptions options;
    options.tolerance = tolerance;
    EXPECT_NE(message(options).find("outside 1e-6 to 0.1"), std::string::npos) << tolerance << ": " << message(options);
  }
  for (const double tolerance : {1e-6, 0.1}) {
    ToleranceOptions options;
    options.tolerance = tolerance;
    EXPECT_EQ(message(options), "meshed") << "the bounds themselves are allowed";
  }
  for (const auto& [first, last, levels] : {std::array{0, 4, 1}, {4, 7, 1}, {4, 4, 1}, {5, 3, 1}, {4, 6, 0}}) {
    ToleranceOptions options;
    options.first_order = first;
    options.last_order = last;
    options.levels = levels;
    EXPECT_NE(message(options).find("orders must rise within 1 to 6"), std::string::npos) << first << ' ' << last;
  }
}

// A thousand times the rounding of K's entries, made on purpose, moves the lowest eigenvalue by a thousand times what
// is said of double precision, within the chance of random signs.
/// A cantilever whose mesh has 1, 2, 4 … cells across it as `cells` says for a level; the levels asked for are kept.
SolidPart divided(std::vector<int>& meshed, const std::function<int(int level)>& cells) {
  return {[&meshed, cells](int level) {
            meshed.push_back(level);
            return mesh::kuhn_box(box.size, {2 * cells(level), cells(level), cells(level)});
          },
          {},
          steel,
          {face("x_min")}};
}

/// Levels whose meshes are all the same bring nothing. Where each halves the elements, a tolerance that only the last
/// of them meets is met.
TEST(Refinement, EndsWhereFurtherLevelsAreInVainAndNotWhereTheyReachTheTolerance) {
  std::vector<int> meshed;
  ToleranceOptions options;
  options.modes = modes_wanted(2);
  options.first_order = 1;
  options.last_order = 2;
  options.tolerance = 1e-3;
  const Refined in_vain = refine_to_tolerance(divided(meshed, [](int) { return 1; }), options);
  EXPECT_FALSE(in_vain.estimate.met);
  EXPECT_NEAR(in_vain.estimate.within_reach, in_vain.estimate.frequency, 1e-3 * in_vain.estimate.frequency);
  EXPECT_EQ(meshed, (std::vector<int>{0, 1})) << "two more would be the same";

  options.levels = 1;
  const Refined last = refine_to_tolerance(divided(meshed, [](int) { return 8; }), options);
  ASSERT_FALSE(last.estimate.met);
  meshed.clear();
  options.levels = 4;
  options.tolerance = 1.01 * last.estimate.frequency;
  const Refined reached = refine_to_tolerance(divided(meshed, [](int level) { return 1 << level; }), options);
  EXPECT_TRUE(reached.estimate.met);
  EXPECT_EQ(meshed, (std::vector<int>{0, 1, 2, 3}));
}

/// Options under which a cantilever of one cell across does not come to its tolerance in two orders.
ToleranceOptions far_from_tolerance() {
  ToleranceOptions options;
  options.modes = modes_wanted(2);
  options.first_order = 1;
  options.last_order = 3;
  options.tolerance = 1e-6;
  return options;
}

TEST(Refinement, ReturnsWhatIsSolvedWhenItsTimeIsOver) {
  std::vector<int> meshed;
  std::vector<int> told;
  ToleranceOptions options = far_from_tolerance();
  options.time_budget_s = 1e-9;
  options.solved = [&told](const RefinementStep& step) { told.push_back(step.order); };
  const Refined first = refine_to_tolerance(divided(meshed, [](int) { return 1; }), options);
  EXPECT_EQ(first.model.nodes.order, 2) << "the first answer and its estimate come in any case";
  EXPECT_EQ(told, (std::vector<int>{1, 2}));
  EXPECT_EQ(meshed, (std::vector<int>{0}));
  EXPECT_FALSE(first.estimate.met);
  EXPECT_GT(first.estimate.frequency, options.tolerance);
  EXPECT_NE(first.estimate.held_back_by.find("1e-09 s for its solutions were over"), std::string::npos)
      << first.estimate.held_back_by;
  EXPECT_NO_THROW(core::check_interrupt()) << "the limit ends with the refinement";
}

TEST(Refinement, ReturnsWhatIsSolvedWhenALaterModelNeedsTooMuchMemory) {
  std::vector<int> meshed;
  ToleranceOptions options = far_from_tolerance();
  const SolidPart part = divided(meshed, [](int) { return 2; });
  const double second = factorise(supported_model(part.mesh(0), 2, steel, part.supports)).factor.statistics().bytes;
  options.memory_limit_bytes = second;
  options.levels = 1;
  const Refined refined = refine_to_tolerance(part, options);
  EXPECT_EQ(refined.model.nodes.order, 2);
  EXPECT_FALSE(refined.estimate.met);
  EXPECT_NE(refined.estimate.held_back_by.find("the next solution could not be had: "), std::string::npos)
      << refined.estimate.held_back_by;
  options.memory_limit_bytes = 0.5 * second;
  EXPECT_THROW((void)refine_to_tolerance(part, options), linalg::MemoryLimitError) << "nothing is solved then";
}

TEST(Refinement, ReturnsWhatIsSolvedWhenAFinerMeshCannotBeMade) {
  std::vector<int> meshed;
  ToleranceOptions options = far_from_tolerance();
  SolidPart part = divided(meshed, [](int) { return 1; });
  part.mesh = [coarse = part.mesh](int level) {
    if (level > 0) throw core::NumericalError("no mesher could fill it");
    return coarse(level);
  };
  const Refined refined = refine_to_tolerance(part, options);
  EXPECT_FALSE(refined.estimate.met);
  EXPECT_NE(refined.estimate.held_back_by.find("no mesher could fill it"), std::string::npos);
  EXPECT_EQ(refined.model.nodes.order, 3) << "the orders of the mesh at hand are left";
}

TEST(Refinement, ReturnsTheSolutionOfTheSmallerErrorNotTheLast) {
  std::vector<int> meshed;
  ToleranceOptions options = far_from_tolerance();
  options.last_order = 2;
  const auto finer_first = [](int level) { return level == 0 ? 4 : 1; };
  const Refined refined = refine_to_tolerance(divided(meshed, finer_first), options);
  ASSERT_EQ(meshed, (std::vector<int>{0, 1}));
  EXPECT_EQ(refined.level, 0);
  EXPECT_EQ(refined.model.K.rows(), refined.estimate.steps[1].dofs);
}

/// Beside a re-entrant edge orders 5 and 6 are cheaper than a finer mesh, whose unknowns are four times as many.
TEST(Refinement, GoesThroughTheOrdersOfAMeshBeforeAFinerOneWhereTheyMaySuffice) {
  std::vector<int> meshed;
  ToleranceOptions options = far_from_tolerance();
  options.reentrant_edges = true;
  options.first_order = 3;
  options.last_order = 6;
  options.levels = 1;
  const SolidPart part = divided(meshed, [](int) { return 1; });
  const Refined sixth = refine_to_tolerance(part, options);
  ASSERT_EQ(sixth.model.nodes.order, 6);
  meshed.clear();
  options.levels = 2;
  options.tolerance = 1.01 * sixth.estimate.frequency;
  const Refined refined = refine_to_tolerance(part, options);
  EXPECT_TRUE(refined.estimate.met);
  EXPECT_EQ(meshed, (std::vector<int>{0}));
}

/// Higher orders do not follow the surface better, a finer mesh does.
TEST(Refinement, TakesAFinerMeshNotHigherOrdersWhereTheShapeMissesTheTolerance) {
  std::vector<int> meshed;
  SolidPart part = divided(meshed, [](int level) { return 1 << level; });
  part.shape_error = [](const Model& model) { return model.mesh.tets.size() > 12 ? 0.0 : 0.06; };
  ASSERT_LE(part.mesh(0).tets.size(), 12U);
  meshed.clear();
  ToleranceOptions options = far_from_tolerance();
  options.first_order = 2;
  options.last_order = 6;
  options.tolerance = 0.05;
  const Refined finer = refine_to_tolerance(part, options);
  EXPECT_TRUE(finer.estimate.met);
  EXPECT_EQ(meshed, (std::vector<int>{0, 1}));
  EXPECT_EQ(finer.estimate.steps[1].order, 3);
  EXPECT_EQ(finer.estimate.steps[2].level, 1);
  options.levels = 1;
  const Refined only = refine_to_tolerance(part, options);
  EXPECT_FALSE(only.estimate.met);
  EXPECT_EQ(only.estimate.steps.size(), 2U);
  EXPECT_EQ(only.estimate.held_back_by, "the elements follow the surface's volume to 6 % only");
}

/// A solution of order 4 has one estimate, whether orders 1 and 2 came before it or not.
TEST(Refinement, OrdersBelowTheUsualOnesDoNotLowerTheEstimate) {
  std::vector<int> meshed;
  ToleranceOptions options = far_from_tolerance();
  options.reentrant_edges = true;
  options.first_order = 3;
  options.last_order = 4;
  options.levels = 1;
  const SolidPart part = divided(meshed, [](int) { return 1; });
  const Refined usual = refine_to_tolerance(part, options);
  options.first_dofs = 1;
  const Refined from_lowest = refine_to_tolerance(part, options);
  ASSERT_EQ(from_lowest.estimate.steps.size(), 4U);
  EXPECT_EQ(from_lowest.model.nodes.order, usual.model.nodes.order);
  EXPECT_NEAR(from_lowest.estimate.frequency / usual.estimate.frequency, 1.0, 0.02);
}

TEST(RoundOff, OfTheLowestFrequencyIsWhatRoundingTheEntriesDoes) {
  for (const double thickness : {0.01, 0.002}) {
    const mesh::Box plate{{0.4, 0.4, thickness}};
    const Model model = supported_model(mesh::kuhn_box(plate.size, {4, 4, 1}), 4, steel,
                                        {{"x_min", mesh::face_of(plate, "x_min"), {0, 1, 2}}});
    const Modes exact = modes(model, factorise(model), modes_wanted(2));
    Model rounded = model;
    constexpr double factor = 1000.0;
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> sign(-1.0, 1.0);
    for (int column = 0; column < model.K.cols(); ++column) {
      for (linalg::SparseMatrix::InnerIterator it(model.K, column); it; ++it) {
        if (it.row() > column) continue;
        const double value = it.value() * (1.0 + factor * std::numeric_limits<double>::epsilon() * sign(random));
        rounded.K.coeffRef(it.row(), column) = value;
        rounded.K.coeffRef(column, it.row()) = value;
      }
    }
    const Modes moved = modes(rounded, factorise(rounded), modes_wanted(2));
    const double change = std::abs(moved.frequency_hz(0) / exact.frequency_hz(0) - 1.0) / factor;
    std::printf("%.0f times as long as thick: round-off %.1e said, %.1e done\n", 0.4 / thickness, exact.round_off,
                change);
    EXPECT_LT(change, exact.round_off);
    EXPECT_GT(change, 0.02 * exact.round_off);
  }
}

}  // namespace
}  // namespace thinwall::fem::limits_test
