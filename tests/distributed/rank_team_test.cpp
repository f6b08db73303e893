#include "distributed/rank_team.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/time_limit.hpp"
#include "fem/model.hpp"
#include "fem/modes.hpp"
#include "fem/supports.hpp"
#include "mesh/planar/bend.hpp"
#include "mesh/planar/prism_mesh.hpp"
#include "tests/linalg/grid_problem.hpp"

namespace thinwall::distributed {
namespace rank_team_test {

/// Skips where the ranks' program was not built.
class RankTeams : public testing::Test {
 protected:
  void SetUp() override {
    ::setenv("THINWALL_MPI", THINWALL_BUILD_DIR "/app/thinwall-mpi", 0);
    if (rank_program().empty()) GTEST_SKIP() << "thinwall-mpi is not built: libmumps-dev is not installed";
  }
};

Eigen::MatrixXd right_sides(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd B(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    for (Eigen::Index i = 0; i < rows; ++i) B(i, j) = std::sin(0.1 * static_cast<double>(i + 7 * j + 1));
  }
  return B;
}

TEST_F(RankTeams, SolveWhatOneProcessSolvesForAnyNumberOfThem) {
  const auto problem = linalg::grid_problem(30);
  const Eigen::MatrixXd B = right_sides(problem.K.rows(), 5);
  for (const int ranks : {2, 3}) {
    RankTeam team({.ranks = ranks});
    const auto of_K = team.factorise(problem.K, {});
    const auto of_M = team.factorise(problem.M, {});  // both factors are there at the same time
    EXPECT_LT((problem.K * of_K->solve(B) - B).norm(), 1e-12 * B.norm()) << ranks;
    EXPECT_LT((problem.M * of_M->solve(B) - B).norm(), 1e-12 * B.norm()) << ranks;
    EXPECT_LT((problem.K * of_K->solve(B.col(3)) - B.col(3)).norm(), 1e-12 * B.norm()) << ranks;
    EXPECT_EQ(of_K->solve(B.leftCols(0)).cols(), 0);
  }
}

TEST_F(RankTeams, SolveWithAFactorOnDiskAndLeaveNothingThere) {
  const auto scratch = std::filesystem::temp_directory_path() / ("rank_team_test-" + std::to_string(::getpid()));
  std::filesystem::create_directory(scratch);
  const char* before = std::getenv("TMPDIR");
  const std::string earlier = before != nullptr ? before : "/tmp";
  ::setenv("TMPDIR", scratch.c_str(), 1);
  const auto problem = linalg::grid_problem(60);
  const Eigen::MatrixXd B = right_sides(problem.K.rows(), 3);
  {
    RankTeam team({.ranks = 2, .threads = 1, .on_disk = true});
    const auto factor = team.factorise(problem.K, {});
    EXPECT_LT((problem.K * factor->solve(B) - B).norm(), 1e-12 * B.norm());
    EXPECT_FALSE(std::filesystem::is_empty(scratch));
  }
  EXPECT_TRUE(std::filesystem::is_empty(scratch));
  ::setenv("TMPDIR", earlier.c_str(), 1);
  std::filesystem::remove_all(scratch);
}

TEST_F(RankTeams, SayThatAMatrixIsNotPositiveDefiniteAndGoOn) {
  const auto problem = linalg::grid_problem(20);
  RankTeam team({});
  const double between = 0.5 * (problem.lambda[0] + problem.lambda[1]);
  const auto indefinite = linalg::combine(1.0, problem.K, -between, problem.M);
  EXPECT_THROW((void)team.factorise(indefinite, {}), core::NumericalError);
  const auto factor = team.factorise(problem.K, {});
  const Eigen::MatrixXd B = right_sides(problem.K.rows(), 1);
  EXPECT_LT((problem.K * factor->solve(B) - B).norm(), 1e-12 * B.norm());
}

TEST_F(RankTeams, RefuseAFactorBeyondTheMemoryAndNameTheRanksThatWouldDo) {
  const auto problem = linalg::grid_problem(60);
  RankTeam team({});
  try {
    (void)team.factorise(problem.K, {.memory_limit_bytes = 1e5});
    FAIL() << "a factor of megabytes fits into 0.1 MB";
  } catch (const linalg::MemoryLimitError& error) {
    EXPECT_GT(error.needed_bytes, 1e6);
    EXPECT_DOUBLE_EQ(error.limit_bytes, 1e5);
    const auto enough = static_cast<int>(std::ceil(2.0 * error.needed_bytes / 1e5));
    EXPECT_NE(std::string(error.what()).find("take " + std::to_string(enough) + " ranks"), std::string::npos)
        << error.what();
  }
}

/// A plate clamped at one end; `curved`: bent about its width. It is so stout that round-off changes its frequencies by
/// less than 1e-10; in thin plates it grows as (length / thickness)⁴, whatever factorises.
fem::Model plate(int order, bool curved) {
  mesh::PrismMeshOptions options;
  options.size_m = 0.04;
  const mesh::Prism flat{{{0, 0}, {0.12, 0}, {0.12, 0.06}, {0, 0.06}}, {}, 0.0, 0.012, {}};
  const fem::Support foot{"foot", mesh::PlaneRegion{{0, 0, 0}, {1, 0, 0}}, {0, 1, 2}};
  fem::Shaping bend;
  if (curved) bend = [](mesh::LagrangeNodes& nodes) { mesh::bend({0.3, 0, 2, 0.06, 0.006}, nodes.positions); };
  return fem::supported_model(mesh::mesh_prism(flat, options), order, {210e9, 0.3, 7850.0}, {foot}, bend);
}

TEST_F(RankTeams, GiveTheFrequenciesOfOneProcessForStraightAndCurvedElements) {
  for (const auto& [order, ranks] : {std::pair{2, 4}, std::pair{6, 2}}) {
    const fem::Model model = plate(order, order > 2);
    const fem::ModeOptions options{.count = 8, .up_to_hz = {}};
    const Eigen::VectorXd alone = fem::modes(model, fem::factorise(model), options).frequency_hz;
    const DistributedFactors factors({.ranks = ranks, .threads = 1, .on_disk = false, .least_rows = 1});
    const Eigen::VectorXd together = fem::modes(model, fem::factorise(model), options).frequency_hz;
    EXPECT_LT((together - alone).cwiseQuotient(alone).cwiseAbs().maxCoeff(), 1e-10) << order << ", " << ranks;
  }
}

TEST_F(RankTeams, ForecastTheirMemoryWithinAFifth) {
  const fem::Model model = plate(6, false);
  const DistributedFactors factors({.ranks = 2, .threads = 1, .on_disk = false, .least_rows = 1});
  const fem::Factored factored = fem::factorise(model);
  EXPECT_GT(factored.factor.statistics().bytes, 2e7);  // beside some 4e7 that a rank without a factor holds
  EXPECT_LT(std::abs(factors.latest().peak_bytes / factors.latest().forecast_bytes - 1.0), 0.2);
}

TEST_F(RankTeams, GoOnAfterATimeLimitHasEndedTheWaitForThem) {
  const auto large = linalg::grid_problem(150);
  const auto small = linalg::grid_problem(20);
  const Eigen::MatrixXd B = right_sides(small.K.rows(), 2), C = right_sides(large.K.rows(), 40);
  RankTeam team({});
  const auto of_large = team.factorise(large.K, {});
  const auto of_small = team.factorise(small.K, {});
  for (int attempt = 0; attempt < 3; ++attempt) {
    EXPECT_THROW(
        {
          const core::TimeLimit limit(0.0);
          (void)of_large->solve(C);
        },
        core::TimeIsOver);
    EXPECT_LT((small.K * of_small->solve(B) - B).norm(), 1e-12 * B.norm());
    EXPECT_THROW(
        {
          const core::TimeLimit limit(0.0);
          (void)team.factorise(large.K, {});
        },
        core::TimeIsOver);
    EXPECT_LT((small.K * of_small->solve(B) - B).norm(), 1e-12 * B.norm());
  }
  EXPECT_LT((large.K * of_large->solve(C) - C).norm(), 1e-12 * C.norm());
}

TEST_F(RankTeams, EndWithAnInterruption) {
  const auto problem = linalg::grid_problem(100);
  RankTeam team({});
  const auto factor = team.factorise(problem.K, {});
  const Eigen::MatrixXd B = right_sides(problem.K.rows(), 1);
  std::thread user([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    core::request_interrupt();
  });
  EXPECT_THROW(
      {
        while (true) (void)factor->solve(B);
      },
      core::Interrupted);
  user.join();
  core::clear_interrupt();
  EXPECT_THROW((void)team.factorise(problem.K, {}), core::NumericalError);  // the ranks have ended
}

}  // namespace rank_team_test
}  // namespace thinwall::distributed
