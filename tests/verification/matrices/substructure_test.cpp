// The idea of CalculiX's test beamfsuper: a beam whose one end is condensed to a joint is the whole beam, here with all
// modes kept and by way of files.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <map>

#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "dynamics/sparse_spatial.hpp"
#include "io/matrices/dmig.hpp"
#include "io/matrices/dof_table_csv.hpp"
#include "io/matrices/mat_sparse.hpp"
#include "io/matrices/matrix_files.hpp"
#include "io/matrices/matrix_market.hpp"
#include "reduction/methods/reduce.hpp"
#include "reduction/trust/imported_model.hpp"
#include "tube.hpp"

namespace thinwall::substructure_test {
namespace {

using dynamics::SparseModel;
using testing::six;
using testing::tube;

/// The assembly of two models: DOFs of the same node and component are shared (b's nodes without elements in a have
/// other numbers).
dynamics::SpatialModel joined(const SparseModel& a, const SparseModel& b) {
  std::map<dynamics::NodeDof, int> rows;
  for (const SparseModel* part : {&a, &b})
    for (const dynamics::NodeDof& dof : part->dofs) rows.emplace(dof, static_cast<int>(rows.size()));
  const auto n = static_cast<Eigen::Index>(rows.size());
  dynamics::SpatialModel whole;
  whole.K = whole.M = whole.C = Eigen::MatrixXd::Zero(n, n);
  for (const SparseModel* part : {&a, &b}) {
    std::vector<int> at;
    for (const dynamics::NodeDof& dof : part->dofs) at.push_back(rows.at(dof));
    whole.K(at, at) += Eigen::MatrixXd(part->K);
    whole.M(at, at) += Eigen::MatrixXd(part->M);
  }
  for (Eigen::Index i = 0; i < n; ++i)
    whole.dofs.push_back({std::to_string(i), Eigen::Vector3d::UnitX(), dynamics::DofKind::translation});
  return whole;
}

/// The twelve elements of a tube in two: nodes 1 to 7, clamped at 1, and 7 to 13.
struct Halves {
  SparseModel first, second;
};
Halves halves() {
  const SparseModel half = tube(6);
  Halves cut{tube(6, six(1)), half};
  for (dynamics::NodeDof& dof : cut.second.dofs) dof.node += 6;
  cut.second.positions.clear();
  return cut;
}

double largest_difference(const dynamics::SpatialModel& a, const dynamics::SpatialModel& b) {
  const Eigen::VectorXd f = dynamics::undamped_modes(a).omega_rad_s, g = dynamics::undamped_modes(b).omega_rad_s;
  EXPECT_EQ(f.size(), g.size());
  return (f.cwiseQuotient(g).head(20).array() - 1.0).abs().maxCoeff();
}

class Substructure : public ::testing::TestWithParam<const char*> {
 protected:
  Substructure() {
    folder_ = std::filesystem::temp_directory_path() /
              ("thinwall_substructure_" + std::string(GetParam()) + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~Substructure() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] SparseModel through_files(const SparseModel& model) const {
    const std::string format = GetParam();
    io::MatrixFiles files;
    if (format == "matrix_market") {
      io::write_matrix_market(folder_ / "K.mtx", model.K);
      io::write_matrix_market(folder_ / "M.mtx", model.M);
      io::write_dof_table(folder_ / "dofs.csv", model);
      files = {folder_ / "K.mtx", folder_ / "M.mtx", {}, folder_ / "dofs.csv"};
    } else if (format == "mat") {
      io::write_mat(folder_ / "a.mat", model);
      files.stiffness = folder_ / "a.mat";
    } else {
      (void)io::write_dmig(folder_ / "a.pch", model);
      files.stiffness = folder_ / "a.pch";
    }
    files.length_unit = "m";
    files.mass_unit = "kg";
    return io::read_matrices(files).model;
  }

  std::filesystem::path folder_;
};

TEST_P(Substructure, CondensedWithAllModesAndReadBackReproducesTheWhole) {
  const Halves cut = halves();
  const SparseModel full = through_files(cut.first);
  const auto reduced = reduction::reduce(reduction::Method::craig_bampton, reduction::full_model(full),
                                         reduction::interface_at(full, {7}), {.modes = 30});
  const SparseModel super = dynamics::sparse_model(std::get<dynamics::SpatialModel>(reduced.model));
  ASSERT_EQ(super.size(), 36);
  const SparseModel read = through_files(super);
  ASSERT_TRUE(std::find(read.dofs.begin(), read.dofs.end(), dynamics::NodeDof{7, 6}) != read.dofs.end());
  SparseModel apart = read;  // amplitudes numbered away from the other half's nodes
  for (dynamics::NodeDof& dof : apart.dofs)
    if (dof.component == 0) dof.node += 1000;
  const double worst = largest_difference(joined(apart, cut.second), joined(cut.first, cut.second));
  std::printf("%s: largest relative difference of a frequency %.1e\n", GetParam(), worst);
  EXPECT_LE(worst, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Formats, Substructure, ::testing::Values("matrix_market", "mat", "dmig"));

TEST(ImportedModel, WithoutMassOrWithoutDofsIsRefusedByName) {
  SparseModel model = tube(3, six(1));
  EXPECT_THROW((void)reduction::interface_at(model, {1}), core::InputError);
  model.M.coeffRef(3, 3) = 0.0;
  try {
    (void)reduction::full_model(model);
    ADD_FAILURE();
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("node 2.rx has no mass"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace thinwall::substructure_test
