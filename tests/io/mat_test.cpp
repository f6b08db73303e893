#include "io/matrices/mat.hpp"

#include <set>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/matrices/mat_sparse.hpp"
#include "matrix_model.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::mat_test {

namespace {

using dynamics::DofKind;

class MatFile : public ScratchFolder {};

dynamics::SpatialModel random_model(bool structural) {
  std::srand(5);
  dynamics::SpatialModel model;
  model.dofs = dynamics::translations("P");
  model.dofs.push_back({"P2 (Stäubli)", Eigen::Vector3d(1.0, 1.0, 1.0).normalized(), DofKind::translation});
  model.dofs.push_back({"R", Eigen::Vector3d::UnitZ(), DofKind::rotation});
  model.dofs.push_back({"mode 1", Eigen::Vector3d::Zero(), DofKind::modal});
  model.M = Eigen::MatrixXd::Random(6, 6);
  model.C = Eigen::MatrixXd::Random(6, 6) * 1e2;
  model.K = Eigen::MatrixXd::Random(6, 6) * 1e9;
  if (structural) model.D = Eigen::MatrixXd::Random(6, 6) * 1e6;
  return model;
}

/// What reading a file leads to; anything but a model or a DataError that names the file fails the test.
template <typename Read>
bool is_read(const std::filesystem::path& file, const std::string& what, const Read& read) {
  try {
    read();
    return true;
  } catch (const core::DataError& error) {
    EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << what << ": " << error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << what << ": another kind of error: " << error.what();
  }
  return false;
}

}  // namespace

TEST_F(MatFile, ComesBackToTheLastBitWithItsDofTable) {
  for (const bool structural : {false, true}) {
    const auto model = random_model(structural);
    write_mat(path("part.mat"), model);
    const auto back = read_mat(path("part.mat"));
    EXPECT_EQ(back.M, model.M);
    EXPECT_EQ(back.C, model.C);
    EXPECT_EQ(back.K, model.K);
    ASSERT_EQ(back.has_structural_damping(), structural);
    EXPECT_EQ(back.D, model.D);
    ASSERT_EQ(back.dofs.size(), model.dofs.size());
    for (std::size_t i = 0; i < model.dofs.size(); ++i) {
      EXPECT_EQ(back.dofs[i].point, model.dofs[i].point);
      EXPECT_EQ(back.dofs[i].direction, model.dofs[i].direction);
      EXPECT_EQ(back.dofs[i].kind, model.dofs[i].kind);
    }
  }
}

TEST_F(MatFile, KeepsWhatTheDofsAreInCoordinatesOfTheirOwn) {
  dynamics::SpatialModel model = random_model(false);
  for (Eigen::MatrixXd* matrix : {&model.M, &model.C, &model.K}) matrix->conservativeResize(4, 4);
  model.T = Eigen::MatrixXd::Random(6, 4);
  write_mat(path("arm.mat"), model);
  const auto back = read_mat(path("arm.mat"));
  EXPECT_EQ(back.T, model.T);
  EXPECT_EQ(back.K, model.K);
  EXPECT_EQ(back.dofs.size(), 6U);
  model.T = Eigen::MatrixXd::Random(5, 4);
  EXPECT_THROW(write_mat(path("arm.mat"), model), core::InputError) << "six names for five rows";
}

// The header as the format's description has it: 116 bytes of text that start with "MATLAB", at 124 the version
// 0x0100 and the letters "MI", which read "IM" on a little-endian machine.
TEST_F(MatFile, IsOfVersionFiveAndTheSameEveryTime) {
  write_mat(path("a.mat"), random_model(true));
  write_mat(path("b.mat"), random_model(true));
  const std::string bytes = core::read_file(path("a.mat"));
  EXPECT_EQ(bytes.substr(0, 19), "MATLAB 5.0 MAT-file");
  EXPECT_EQ(bytes.substr(124, 4), std::string("\x00\x01IM", 4));
  EXPECT_EQ(bytes, core::read_file(path("b.mat")));
}

TEST_F(MatFile, IsNotWrittenFromAnInconsistentModel) {
  auto model = random_model(false);
  model.K.resize(2, 2);
  EXPECT_THROW(write_mat(path("part.mat"), model), core::InputError);
  model = random_model(false);
  model.M(1, 1) = std::nan("");
  EXPECT_THROW(write_mat(path("part.mat"), model), core::InputError);
  model = random_model(false);
  model.dofs[0].point = "\xFF";
  EXPECT_THROW(write_mat(path("part.mat"), model), core::InputError);
  EXPECT_TRUE(is_empty());
  EXPECT_THROW(write_mat(path("absent/part.mat"), random_model(false)), core::DataError);
}

TEST_F(MatFile, ThatIsNoneIsRefusedByName) {
  const auto file = write("part.mat", "this is not a MAT file");
  const std::string message = message_of<core::DataError>([&] { (void)read_mat(file); });
  EXPECT_NE(message.find(file.string()), std::string::npos) << message;
  EXPECT_THROW((void)read_mat(path("absent.mat")), core::DataError);
}

TEST_F(MatFile, CutShortIsRefused) {
  write_mat(path("part.mat"), random_model(false));
  const std::string bytes = core::read_file(path("part.mat"));
  for (const std::size_t length : {std::size_t{100}, std::size_t{130}, bytes.size() / 2, bytes.size() - 40}) {
    const auto file = write("cut.mat", bytes.substr(0, length));
    EXPECT_THROW((void)read_mat(file), core::DataError) << length;
  }
}

// A damaged file states sizes that no memory holds, or that its bytes do not fill.
TEST_F(MatFile, WithOneByteChangedIsReadOrRefusedByName) {
  write_mat(path("dense.mat"), random_model(true));
  write_mat(path("sparse.mat"), matrix_model(2, true));
  for (const bool dense : {true, false}) {
    const std::string whole = core::read_file(path(dense ? "dense.mat" : "sparse.mat"));
    std::size_t refused = 0;
    for (std::size_t at = 0; at < whole.size(); ++at) {
      std::string bytes = whole;
      bytes[at] = '\xff';
      const auto file = write("changed.mat", bytes);
      const std::string what = (dense ? "dense, byte " : "sparse, byte ") + std::to_string(at);
      const bool read = dense ? is_read(file, what, [&] { (void)read_mat(file); })
                              : is_read(file, what, [&] { (void)read_sparse_mat(file); });
      refused += read ? 0 : 1;
    }
    EXPECT_GT(refused, 100U);
  }
}

// Debian's matio uses the serial HDF5 and parts of VTK use the MPI one: two of them in one process would meet under the
// same symbols. This program links all of io.
TEST(Libraries, OfOneHdf5AtMostAreInThisProcess) {
  std::ifstream maps("/proc/self/maps");
  std::set<std::string> found;
  for (std::string line; std::getline(maps, line);) {
    const auto at = line.find("/libhdf5");
    if (at != std::string::npos && line.find("_hl", at) == std::string::npos) found.insert(line.substr(at));
    EXPECT_EQ(line.find("/libmpi"), std::string::npos) << line;
  }
  EXPECT_LE(found.size(), 1U);
}

}  // namespace thinwall::io::test::mat_test
