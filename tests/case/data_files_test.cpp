// The files that a case names: read when it is loaded, once each, and told there if they are faulty.

#include <gtest/gtest.h>

#include <filesystem>

#include "case/numbers.hpp"
#include "case/problem.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "dynamics/response_model.hpp"
#include "io/frf/uff.hpp"
#include "setup/measured.hpp"
#include "tests/case/opened_files.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::data_files_test {

using namespace cases;

namespace {

const std::string frf_lines = "10,1e-6,-1e-7\n20,2e-6,-1e-7\n30,1e-6,-1e-7\n";

std::string frf(const std::string& owner, const std::string& response, const std::string& force,
                const std::string& file, const std::string& more) {
  return "[[" + owner + ".measured]]\nresponse = \"" + response + "\"\nforce = \"" + force + "\"\nfile = \"" + file +
         "\"\n" + more;
}

const std::string receptance = "quantity = \"receptance\"\nunit = \"m/N\"\n";

/// A robot's tip of three directions in one Universal File.
std::string robot_of_nine_records(const std::filesystem::path& folder) {
  dynamics::ResponseModel tip;
  tip.axis = dynamics::linear_axis(10.0, 30.0, 3);
  tip.responses = tip.forces = dynamics::translations("R");
  for (int line = 0; line < 3; ++line) tip.H.emplace_back(Eigen::Matrix3cd::Identity() * std::complex(1e-6, -1e-7));
  io::write_uff(folder / "tip.uff", tip);
  std::string text = "[robot]\nmodel = \"measured\"\n";
  int record = 0;
  for (const char* response : {"R.x", "R.y", "R.z"}) {
    for (const char* force : {"R.x", "R.y", "R.z"})
      text += frf("robot", response, force, "tip.uff", "record = " + std::to_string(++record) + "\n");
  }
  return text;
}

TEST(DataFiles, AFileIsOpenedOnceToBeReadAndOnceForItsChecksumHoweverOftenItIsNamed) {
  const TemporaryFolder folder;
  core::write_file_atomically(folder.path / "part.csv", frf_lines);
  const std::string text = robot_of_nine_records(folder.path) + frf("part", "P.x", "P.x", "part.csv", receptance);
  OpenedFiles opened(folder.path);
  const Case source = parse_case(text, folder.path);
  EXPECT_EQ(opened.count("tip.uff"), 2);
  EXPECT_EQ(opened.count("part.csv"), 2);
  const auto& measured = std::get<setup::MeasuredRobot>(source.robot->model).measured;
  EXPECT_EQ(setup::receptance_of(measured[8]).H(0), std::complex(1e-6, -1e-7));
  EXPECT_EQ(setup::receptance_of(measured[7]).H(0), 0.0);
}

TEST(DataFiles, AFaultIsToldWhenTheCaseIsLoadedWithItsFileAndLine) {
  const TemporaryFolder folder;
  const auto fault = [&](const std::string& text) -> std::string {
    try {
      (void)parse_case(text, folder.path);
    } catch (const core::Error& error) {
      return error.what();
    }
    return "none";
  };
  core::write_file_atomically(folder.path / "part.csv", "10,1e-6,0\n20,2e-6,0\n15,1e-6,0\n");
  const std::string part = frf("part", "P.x", "P.x", "part.csv", receptance);
  EXPECT_NE(fault(part).find("part.csv:3"), std::string::npos) << fault(part);
  core::write_file_atomically(folder.path / "one.csv", "10,1e-6,0\n20,2e-6,0\n");
  const std::string second = frf("part", "P.x", "P.x", "one.csv", std::string(receptance) + "record = 2\n");
  EXPECT_NE(fault(second).find("holds one FRF, and record asks for number 2"), std::string::npos) << fault(second);
  core::write_file_atomically(folder.path / "slip.csv", "10,1e-6,0\n20,1e308,1e308\n30,1e-6,0\n");
  const std::string slip = frf("part", "P.x", "P.x", "slip.csv", receptance);
  EXPECT_NE(fault(slip).find("slip.csv: at 20 Hz a force of 1 N moves it by"), std::string::npos) << fault(slip);
  const std::string nine = robot_of_nine_records(folder.path);
  const std::string unsaid = "[robot]\nmodel = \"measured\"\n" + frf("robot", "R.x", "R.x", "tip.uff", "");
  EXPECT_NE(fault(unsaid).find("holds 9 FRFs"), std::string::npos) << fault(unsaid);
  const std::string beyond = frf("part", "P.x", "P.x", "tip.uff", "record = 10\n");
  EXPECT_NE(fault(beyond).find("holds 9 FRFs"), std::string::npos) << fault(beyond);
  EXPECT_EQ(fault(nine), "none");
}

TEST(DataFiles, ACaseWithAnotherNumberHoldsWhatTheFilesSaidWithoutThem) {
  const TemporaryFolder folder;
  core::write_file_atomically(folder.path / "part.csv", frf_lines);
  core::write_file_atomically(
      folder.path / "one.urdf",
      R"(<robot name="one"><link name="base"/><link name="a"><inertial><origin xyz="0 0 0.3"/><mass value="30"/><inertia ixx="2" iyy="2" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="j1" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 1 0"/></joint></robot>)");
  core::write_file_atomically(folder.path / "joints.toml", "[[joints]]\nname = \"j1\"\nstiffness = \"2e6 N m/rad\"\n");
  Case source = parse_case(frf("part", "P.x", "P.x", "part.csv", receptance + "noise = 0.01\n") +
                               "[robot]\nmodel = \"flexible_joints\"\nurdf = \"one.urdf\"\njoints = \"joints.toml\"\n"
                               "[robot.base]\nposition = [1, 2, 3]\n[robot.posture]\njoints = [0.3]\n",
                           folder.path);
  const auto before = source;
  for (const auto& file : input_files(source)) std::filesystem::remove(file);
  set_value(source, "robot.base.position[0]", 4.0);
  set_value(source, "part.measured[0].noise", 0.02);
  const robot::SerialArm& arm = std::get<setup::JointedRobot>(source.robot->model).arm;
  EXPECT_EQ(arm.base.translation(), Eigen::Vector3d(4.0, 2.0, 3.0));
  ASSERT_EQ(arm.links.size(), 1U);
  EXPECT_EQ(arm.links[0].mass, 30.0);
  EXPECT_EQ(arm.links[0].joint.stiffness, 2e6);
  EXPECT_EQ(arm.gravity, std::get<setup::JointedRobot>(before.robot->model).arm.gravity);
  EXPECT_EQ(source.measured_part[0].noise, 0.02);
  EXPECT_EQ(setup::receptance_of(source.measured_part[0]).H, setup::receptance_of(before.measured_part[0]).H);
  ASSERT_EQ(source.data_files.size(), 3U);
  for (const DataFile& file : source.data_files) EXPECT_EQ(file.sha256.size(), 64U) << file.path;
}

TEST(DataFiles, AnFrfThatWasNotReadIsRefused) {
  const setup::MeasuredFrf frf{"P.x", "P.x", "tip.csv", io::FrfQuantity::receptance, "m/N", "Hz", {}};
  EXPECT_THROW((void)setup::receptance_of(frf), core::InputError);
}

}  // namespace
}  // namespace thinwall::tests::data_files_test
