#include "io/frf/response_csv.hpp"

#include "core/error.hpp"
#include "io/frf/frf_csv.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::response_csv_test {

namespace {

using dynamics::Dof;
using dynamics::DofKind;

class ResponseFile : public ScratchFolder {};

dynamics::ResponseModel random_model() {
  std::srand(7);
  dynamics::ResponseModel model;
  model.axis.hz = Eigen::VectorXd::LinSpaced(50, 1.0 / 3.0, 5000.0 / 7.0);
  model.responses = {{"P, \"upper\" edge", Eigen::Vector3d(1.0, 2.0, -3.0).normalized(), DofKind::translation},
                     {"P2", Eigen::Vector3d::UnitY(), DofKind::rotation}};
  model.forces = {{"P2", Eigen::Vector3d::UnitY(), DofKind::rotation},
                  {"R", Eigen::Vector3d::UnitX(), DofKind::translation},
                  {"Stäubli tip", Eigen::Vector3d::UnitZ(), DofKind::translation}};
  for (int i = 0; i < 50; ++i) model.H.emplace_back(Eigen::MatrixXcd::Random(2, 3) * std::pow(10.0, -i));
  return model;
}

dynamics::ResponseModel single_entry() {
  dynamics::ResponseModel model;
  model.axis.hz = Eigen::Vector2d(1.0, 2.0);
  model.responses = {{"P", Eigen::Vector3d::UnitX(), DofKind::translation}};
  model.forces = model.responses;
  model.H.assign(2, Eigen::MatrixXcd::Constant(1, 1, {1e-6, -2e-7}));
  return model;
}

void expect_equal(const dynamics::DofTable& a, const dynamics::DofTable& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].point, b[i].point);
    EXPECT_EQ(a[i].direction, b[i].direction);
    EXPECT_EQ(a[i].kind, b[i].kind);
  }
}

}  // namespace

TEST_F(ResponseFile, ComesBackToTheLastBit) {
  const auto model = random_model();
  write_response(path("frf.csv"), model);
  const auto back = read_response(path("frf.csv"));
  EXPECT_EQ(back.axis.hz, model.axis.hz);
  expect_equal(back.responses, model.responses);
  expect_equal(back.forces, model.forces);
  ASSERT_EQ(back.H.size(), model.H.size());
  for (std::size_t i = 0; i < model.H.size(); ++i) EXPECT_EQ(back.H[i], model.H[i]) << i;
}

TEST_F(ResponseFile, NamesEveryColumnWithItsUnit) {
  write_response(path("frf.csv"), random_model());
  std::ifstream file(path("frf.csv"));
  std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(text.find("re P2.ry/P2.ry rad/(N m)"), std::string::npos);
  EXPECT_NE(text.find("im P2.ry/R.x rad/N"), std::string::npos);
}

TEST_F(ResponseFile, OfOneEntryReadsAsAMeasurement) {
  const auto model = single_entry();
  write_response(path("frf.csv"), model);
  const MeasuredFrf frf = read_frf(path("frf.csv"), frf_format("receptance", "m/N", "Hz"));
  EXPECT_EQ(frf.axis.hz, model.axis.hz);
  EXPECT_EQ(frf.H(1), model.H[1](0, 0));
}

TEST_F(ResponseFile, IsNotWrittenWithHoles) {
  auto model = single_entry();
  model.H[1](0, 0) = {std::nan(""), 0.0};
  const std::string message = message_of<core::NumericalError>([&] { write_response(path("frf.csv"), model); });
  EXPECT_NE(message.find("P.x/P.x is not finite at 2 Hz"), std::string::npos) << message;
  model = single_entry();
  model.H.pop_back();
  EXPECT_THROW(write_response(path("frf.csv"), model), core::InputError);
  model = single_entry();
  model.responses[0].point = "P\nQ";
  EXPECT_THROW(write_response(path("frf.csv"), model), core::InputError);
  EXPECT_TRUE(is_empty());
}

TEST_F(ResponseFile, WithoutDofTableIsRefused) {
  const auto file = write("frf.csv", "frequency_hz,re,im\n1,2,3\n");
  EXPECT_THROW((void)read_response(file), core::DataError);
  const auto wrong = write("frf2.csv", "# response translation 1 0 P\n# force translation 1 0 0 P\n1,2,3\n");
  EXPECT_THROW((void)read_response(wrong), core::DataError);
}

}  // namespace thinwall::io::test::response_csv_test
