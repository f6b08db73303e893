#include "report/damping_files.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <memory>
#include <numbers>

#include "io/results/csv_table.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::report::damping_files_test {
namespace {

namespace fs = std::filesystem;

/// Two DOFs that a mode of 100 Hz and 2 % moves, by 1 and by 3 kg^-½.
dynamics::ModalModel part() {
  const double omega = 2.0 * std::numbers::pi * 100.0, damped = omega * std::sqrt(1.0 - 4e-4);
  const std::complex<double> pole(-0.02 * omega, damped), a(0.0, 2.0 * damped);
  const Eigen::Vector2d shape(1.0, 3.0);
  dynamics::ModalModel model;
  model.poles = Eigen::Vector2cd(pole, std::conj(pole));
  model.right = shape.cast<std::complex<double>>() * Eigen::RowVector2cd::Ones();
  model.left = model.right;
  model.scaling = Eigen::Vector2cd(a, std::conj(a));
  model.dofs = {{"P", Eigen::Vector3d::UnitX()}, {"P", Eigen::Vector3d::UnitZ()}};
  return model;
}

setup::MeasuredFrf frf(const std::string& dof) {
  setup::MeasuredFrf measured;
  measured.response = measured.force = dof;
  measured.content = std::make_shared<setup::FrfContent>(
      setup::FrfContent{{{Eigen::Vector2d(50.0, 100.0)},
                         Eigen::Vector2cd(std::complex(1e-6, -2e-6), std::complex(3e-6, -4e-6)),
                         "bump.csv"},
                        {},
                        {},
                        false});
  return measured;
}

TEST(DampingFiles, HaveTheDampedPartBesideWhatWasMeasured) {
  const fs::path file = tests::temporary_files() / "part_damping.csv";
  write_damping_frf(file, frf("P.z"), part());
  const io::Table table = io::read_csv(file);
  EXPECT_EQ(io::numbers(table, "frequency_hz", file), (std::vector<double>{50.0, 100.0}));
  EXPECT_EQ(io::numbers(table, "re P.z/P.z m/N", file), (std::vector<double>{1e-6, 3e-6}));
  EXPECT_EQ(io::numbers(table, "im P.z/P.z m/N", file), (std::vector<double>{-2e-6, -4e-6}));
  // 9 / (Ω² − ω² + 2iζΩω), at the resonance 9 / (2iζΩ²)
  const double omega = 2.0 * std::numbers::pi * 100.0;
  const std::complex<double> below = 9.0 / (omega * omega * std::complex<double>(0.75, 0.02));
  const auto re = io::numbers(table, "synthesised re P.z/P.z m/N", file);
  const auto im = io::numbers(table, "synthesised im P.z/P.z m/N", file);
  EXPECT_NEAR(re[0], below.real(), 1e-9 * std::abs(below));
  EXPECT_NEAR(im[0], below.imag(), 1e-9 * std::abs(below));
  EXPECT_NEAR(re[1], 0.0, 1e-9 * std::abs(im[1]));
  EXPECT_NEAR(im[1], -9.0 / (0.04 * omega * omega), 1e-9 * std::abs(im[1]));
  fs::remove(file);
}

TEST(DampingFiles, AreNotWrittenOfADofThatThePartLacks) {
  const fs::path file = tests::temporary_files() / "no_part_damping.csv";
  write_damping_frf(file, frf("P.y"), part());
  EXPECT_FALSE(fs::exists(file));
}

}  // namespace
}  // namespace thinwall::report::damping_files_test
