// An arm in a case: from links or from a URDF, and what is refused.

#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "case/checks/doubts.hpp"
#include "case/problem.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "io/frf/uff.hpp"
#include "robot/arm_kinematics.hpp"
#include "setup/measured.hpp"
#include "setup/robot_tip.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::robot_case_test {

using namespace setup;
using namespace cases;

namespace {

std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

RobotPosture posture_of(const Case& source) {
  return robot_posture(source, source);
}

dynamics::SpatialModel matrices_of(const Case& source) {
  return robot_matrices(source, source);
}

std::string link(const std::string& name, const std::string& axis, double length) {
  return "[[robot.links]]\nname = \"" + name + "\"\nposition = [0, 0, " + std::to_string(length) + "]\naxis = \"" +
         axis +
         "\"\nmass = \"20 kg\"\ncentre = [0, 0, 0.1]\ninertia = [1, 1, 0.5]\nstiffness = \"1e6 N m/rad\"\n"
         "damping = \"100 N m s/rad\"\n";
}

/// First axis z, three along y: 0.6, 0.9, 0.8 and 0.3 m.
const std::string arm = "[robot]\nmodel = \"flexible_joints\"\n" + link("column", "z", 0.0) + link("upper", "y", 0.6) +
                        link("fore", "y", 0.9) + link("hand", "y", 0.8) +
                        "[robot.tip]\nposition = [0, 0, \"300 mm\"]\n";
const std::string reaching = "[robot.posture]\ntip = [\"1.2 m\", \"0.5 m\", \"0.9 m\"]\npitch = \"90 deg\"\n";

void expect_problem(const std::string& text, const std::string& key, const std::string& part,
                    const std::filesystem::path& folder = ".") {
  try {
    (void)parse_case(text, folder);
    ADD_FAILURE() << "accepted, though " << part;
  } catch (const CaseError& error) {
    ASSERT_EQ(error.problems.size(), 1U) << error.what();
    const std::string& found = error.problems[0].text;
    EXPECT_EQ(found.find(key + ":"), 0U) << found;
    EXPECT_NE(found.find(part), std::string::npos) << found;
    EXPECT_EQ(found.find('\n'), std::string::npos) << found;
  }
}

TEST(RobotCase, ThePostureBringsTheTipWhereItIsAskedToBe) {
  const Case by_pitch = parse_case(arm + reaching, ".");
  const RobotPosture stands = robot_posture(by_pitch, by_pitch);
  EXPECT_LT((*stands.tip - Eigen::Vector3d(1.2, 0.5, 0.9)).norm(), 1e-12);
  const Eigen::Vector3d along =
      robot::pose(std::get<JointedRobot>(by_pitch.robot->model).arm, stands.posture.q).tip.linear().col(2);
  EXPECT_NEAR(along.z(), 0.0, 1e-12) << "a pitch of 90 degrees is level";
  EXPECT_GT(stands.posture.q(2), 0.0) << "elbow up";
  const RobotPosture down = posture_of(parse_case(arm + reaching + "elbow = \"down\"\n", "."));
  EXPECT_LT((*down.tip - *stands.tip).norm(), 1e-12);
  EXPECT_LT(down.posture.q(2), 0.0);
}

TEST(RobotCase, TheBaseStandsWhereItIsPutAndGravityPullsAgainstItsZ) {
  const Case hung = parse_case(
      arm + "[robot.base]\nposition = [1, 2, 3]\nx = \"x\"\nz = \"-z\"\n[robot.posture]\njoints = [0, 0, 0, 0]\n", ".");
  EXPECT_LT((*robot_posture(hung, hung).tip - Eigen::Vector3d(1, 2, 3 - 2.6)).norm(), 1e-12);
  EXPECT_EQ(std::get<JointedRobot>(hung.robot->model).arm.gravity, Eigen::Vector3d(0, 0, 9.81));
  EXPECT_GT(std::get<JointedRobot>(hung.robot->model).arm.base.linear().determinant(), 0.0);
}

// Six axes, wrist in the middle: the tip's z looks along the approach, and the angle turns it about that.
TEST(RobotCase, AnArmOfSixJointsIsSearchedWithTheRedundancyAngle) {
  const std::string six = "[robot]\nmodel = \"flexible_joints\"\n" + link("1", "z", 0.4) + link("2", "y", 0.3) +
                          link("3", "y", 0.9) + link("4", "z", 0.4) + link("5", "y", 0.5) + link("6", "z", 0.1) +
                          "[robot.tip]\nposition = [0, 0, \"200 mm\"]\n[robot.posture]\ntip = [1.1, 0.3, 0.9]\n"
                          "approach = \"x\"\nangle = \"30 deg\"\nstart = [0.2, 0.4, 1.0, 0.1, 0.5, 0.2]\n";
  const Case source = parse_case(six, ".");
  const RobotPosture stands = robot_posture(source, source);
  const robot::ArmPose at = robot::pose(std::get<JointedRobot>(source.robot->model).arm, stands.posture.q);
  EXPECT_LT((*stands.tip - Eigen::Vector3d(1.1, 0.3, 0.9)).norm(), 1e-9);
  EXPECT_LT((at.tip.linear().col(2) - Eigen::Vector3d::UnitX()).norm(), 1e-9);
  const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
  EXPECT_LT((at.tip.linear().col(0) - Eigen::Vector3d(0, -s, c)).norm(), 1e-9) << "z turned about x by 30 degrees";
  expect_problem(with(six, "[1.1, 0.3, 0.9]", "[5, 0.3, 0.9]"), "robot.posture", "does not reach (5, 0.3, 0.9) m");
}

TEST(RobotCase, WhatAnArmCannotBeIsSaid) {
  expect_problem(arm, "robot.posture", "give either joints, or pitch");
  expect_problem(arm + reaching + "joints = [0, 0, 0, 0]\n", "robot.posture", "give either joints, or pitch");
  expect_problem(arm + "[robot.posture]\njoints = [0, 0]\n", "robot.posture.joints", "2 angles for 4 joints");
  expect_problem(arm + "[robot.posture]\njoints = [0]\ntip = [1, 0, 1]\n", "robot.posture.joints",
                 "1 angles for 4 joints");
  expect_problem(arm + with(reaching, "1.2 m", "9 m"), "robot.posture", "is out of reach");
  expect_problem(with(arm, "inertia = [1, 1, 0.5]", "inertia = [1, 1]") + reaching, "robot.links[0].inertia",
                 "three moments");
  expect_problem(with(arm, "inertia = [1, 1, 0.5]", "inertia = [1, 1, 3]") + reaching, "robot.links",
                 "no body has that");
  expect_problem(with(arm, "stiffness = \"1e6 N m/rad\"\n", "") + reaching, "robot.links[0].stiffness", "missing");
  expect_problem(with(arm, "1e6 N m/rad", "1e6 N/m") + reaching, "robot.links[0].stiffness", "torsional stiffness");
  expect_problem(with(arm, "1e6 N m/rad", "0 N m/rad") + reaching, "robot.links[0].stiffness", "above 0");
  expect_problem(arm + "[robot.base]\nx = [1, 0, 1]\n" + reaching, "robot.base.x", "right angle");
  expect_problem(arm + reaching +
                     "[[robot.counterbalances]]\nfrom_point = [0, 0, 0]\nto = \"uper\"\nto_point = [0, 0, 1]\n" +
                     "length = \"1 m\"\nforce = \"100 N\"\n",
                 "robot.counterbalances[0].to", "did you mean \"upper\"");
  expect_problem("[robot]\nmodel = \"flexible_joints\"\n", "robot.model", "needs [[robot.links]]");
  expect_problem(arm + "[robot.posture]\njoints = [0, 0, 0, 0]\n[robot.workspace]\nfrom = [0, 0, 0]\nto = [1, 1, 1]\n",
                 "robot.workspace", "needs a posture by pitch or approach");
}

TEST(RobotCase, AnArmThatFallsIsRefusedByItsSoftestJoint) {
  std::string soft = arm;
  for (int i = 0; i < 4; ++i) soft = with(soft, "1e6 N m/rad", "10 N m/rad");
  expect_problem(soft + "[robot.posture]\njoints = [0, 0, 0, 0]\n", "robot.posture", "does not stay in its posture");
}

TEST(RobotCase, SeveralModesHoldInTheirDirectionsOnly) {
  const auto mode = [](const std::string& direction) {
    return "[[robot.modes]]\nfrequency = \"20 Hz\"\ndamping_ratio = 0.02\nstiffness = \"1e6 N/m\"\ndirection = " +
           direction + "\n";
  };
  const std::string robot = "[robot]\nmodel = \"modes\"\n" + mode("\"x\"") + mode("[0.6, 0.8, 0]");
  EXPECT_NO_THROW((void)parse_case(robot, "."));
  const auto matrices = matrices_of(parse_case(robot, "."));
  EXPECT_EQ(matrices.dofs.size(), 2U);
  EXPECT_EQ(matrices.size(), 2);
  expect_problem("[robot]\nmodel = \"modes\"\n", "robot.modes",
                 "missing; robot.model = \"modes\" needs it: Modes of the tip.");
  expect_problem(
      robot + "[robot.posture]\njoints = [0]\n", "robot.posture",
      "belongs to robot.model = \"modal_table\" or \"flexible_joints\", but it is \"modes\"; set robot.model, or "
      "remove posture");
}

// A hammer along −x turns the sign of the receptance, which the file tells and the case need not.
TEST(RobotCase, SignsOfAFilesDirectionsCount) {
  const TemporaryFolder folder;
  dynamics::ResponseModel tip;
  tip.axis = dynamics::linear_axis(1.0, 100.0, 12);
  tip.responses = {{"R", Eigen::Vector3d::UnitX()}};
  tip.forces = {{"R", -Eigen::Vector3d::UnitX()}};
  for (int line = 0; line < 12; ++line)
    tip.H.emplace_back(Eigen::MatrixXcd::Constant(1, 1, {-1e-6, 1e-7 * (line + 1)}));
  io::write_uff(folder.path / "tip.uff", tip);
  const MeasuredFrf named{"R.x", "R.x", folder.path / "tip.uff", std::nullopt, "", "Hz", {}};
  EXPECT_NEAR(read_measured(named).frf.H(3).real(), 1e-6, 1e-18);
  EXPECT_NEAR(read_measured(named).frf.H(3).imag(), -4e-7, 1e-18);
  EXPECT_EQ(read_measured(named).notes.size(), 1U) << "the FRF is turned";
  const MeasuredFrf second{"R.x", "R.x", folder.path / "tip.uff", std::nullopt, "", "Hz", 2};
  EXPECT_THROW((void)read_measured(second), core::InputError);
}

const std::string urdf = R"(<robot name="two"><link name="base"/>
<link name="a"><inertial><origin xyz="0 0 0.3"/><mass value="30"/><inertia ixx="2" iyy="2" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="b"><inertial><origin xyz="0 0 0.2"/><mass value="10"/><inertia ixx="1" iyy="1" izz="0.5" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="tool"/>
<joint name="j1" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 1 0"/></joint>
<joint name="j2" type="continuous"><parent link="a"/><child link="b"/><origin xyz="0 0 0.7"/><axis xyz="0 1 0"/></joint>
<joint name="f" type="fixed"><parent link="b"/><child link="tool"/><origin xyz="0 0 0.5"/></joint>
</robot>)";
const std::string joints =
    "[[joints]]\nname = \"j1\"\nstiffness = \"2e6 N m/rad\"\n[[joints]]\nname = \"j2\"\nstiffness = \"1e6 N "
    "m/rad\"\ngear_ratio = 120\n";
const std::string by_urdf =
    "[robot]\nmodel = \"flexible_joints\"\nurdf = \"two.urdf\"\njoints = \"joints.toml\"\n[robot.posture]\njoints = "
    "[0.3, 0.4]\n";

TEST(RobotCase, AnArmFromAUrdfIsTheOneWrittenOutLinkByLink) {
  const TemporaryFolder folder;
  core::write_file_atomically(folder.path / "two.urdf", urdf);
  core::write_file_atomically(folder.path / "joints.toml", joints);
  const auto body = [](const char* mass, const char* centre, const char* inertia, const char* stiffness) {
    return std::string("axis = \"y\"\nmass = ") + mass + "\ncentre = " + centre + "\ninertia = " + inertia +
           "\nstiffness = " + stiffness + "\n";
  };
  const std::string by_links =
      "[robot]\nmodel = \"flexible_joints\"\n[[robot.links]]\n" + body("30", "[0, 0, 0.3]", "[2, 2, 1]", "2e6") +
      "[[robot.links]]\nposition = [0, 0, 0.7]\n" + body("10", "[0, 0, 0.2]", "[1, 1, 0.5]", "1e6") +
      "[robot.tip]\nposition = [0, 0, 0.5]\n[robot.posture]\njoints = [0.3, 0.4]\n";
  const dynamics::SpatialModel a = matrices_of(parse_case(by_urdf, folder.path));
  const dynamics::SpatialModel b = matrices_of(parse_case(by_links, folder.path));
  EXPECT_LT((a.M - b.M).norm(), 1e-12 * b.M.norm());
  EXPECT_LT((a.K - b.K).norm(), 1e-12 * b.K.norm());
  EXPECT_LT((a.T - b.T).norm(), 1e-12 * b.T.norm());
  const Case source = parse_case(by_urdf, folder.path);
  EXPECT_DOUBLE_EQ(std::get<JointedRobot>(source.robot->model).arm.links[1].joint.gear_ratio, 120.0);
}

TEST(RobotCase, UrdfAndItsJointsAreCheckedAgainstEachOther) {
  const TemporaryFolder folder;
  core::write_file_atomically(folder.path / "two.urdf", urdf);
  const auto expect = [&](const std::string& file, const std::string& part) {
    core::write_file_atomically(folder.path / "joints.toml", file);
    expect_problem(by_urdf, "robot.urdf", part, folder.path);
  };
  expect(with(joints, "\"j2\"", "\"j3\""), "nothing of joint \"j2\"");
  expect(joints + "[[joints]]\nname = \"f\"\nstiffness = 1\n", "joint \"f\" does not move between");
  expect(joints + "[[joints]]\nname = \"j1\"\nstiffness = 1\n", "is there twice");
  expect(with(joints, "stiffness = \"2e6 N m/rad\"\n", ""), "joint \"j1\" turns and needs its stiffness");
  core::write_file_atomically(folder.path / "joints.toml", joints);
  expect_problem(with(by_urdf, "two.urdf", "none.urdf"), "robot.urdf", "none.urdf", folder.path);
  expect_problem(with(by_urdf, "joints = \"joints.toml\"\n", ""), "robot.urdf", "needs robot.joints", folder.path);
}

// A column that slides by 0.2 m along z carries the arm of the test above; a finger beside the chain stands still.
TEST(RobotCase, AUrdfsSlidesHaveAStiffnessAndJointsBesideItsChainAreTold) {
  const TemporaryFolder folder;
  const std::string limits = "<limit lower=\"0\" upper=\"1\" effort=\"1\" velocity=\"1\"/>";
  const std::string sliding =
      with(with(urdf, "type=\"continuous\"><parent link=\"base\"/><child link=\"a\"/><axis xyz=\"0 1 0\"/>",
                "type=\"prismatic\"><parent link=\"base\"/><child link=\"a\"/><axis xyz=\"0 0 1\"/>" + limits),
           "</robot>",
           "<link name=\"finger\"/><joint name=\"g\" type=\"continuous\"><parent link=\"b\"/><child "
           "link=\"finger\"/></joint></robot>");
  const std::string stiff =
      "[[joints]]\nname = \"j1\"\nlinear_stiffness = \"5 N/um\"\n[[joints]]\nname = \"j2\"\n"
      "stiffness = \"1e6 N m/rad\"\n";
  const std::string stands = with(with(by_urdf, "[0.3, 0.4]", "[\"0.4 rad\"]\nslides = [\"200 mm\"]"),
                                  "urdf =", "urdf_tip = \"tool\"\nurdf =");
  core::write_file_atomically(folder.path / "two.urdf", sliding);
  core::write_file_atomically(folder.path / "joints.toml", stiff);
  const Case source = parse_case(stands, folder.path);
  const RobotPosture posture = posture_of(source);
  EXPECT_NEAR(posture.tip->z(), 0.2 + 0.7 + 0.5 * std::cos(0.4), 1e-12);
  const dynamics::SpatialModel model = matrices_of(source);
  EXPECT_DOUBLE_EQ(model.K(0, 0), 5e6) << "a slide along the weight has its drive's stiffness only";
  EXPECT_NEAR(model.M(0, 0), 40.0, 1e-12);
  ASSERT_EQ(doubts_about(source).size(), 1U);
  EXPECT_NE(doubts_about(source)[0].find("joint \"g\" of two.urdf"), std::string::npos) << doubts_about(source)[0];
  expect_problem(with(stands, "\nslides = [\"200 mm\"]", "\nslides = [1, 2]"), "robot.posture.slides",
                 "2 distances for 1 joints that slide", folder.path);

  const auto expect = [&](const std::string& file, const std::string& part) {
    core::write_file_atomically(folder.path / "joints.toml", file);
    expect_problem(stands, "robot.urdf", part, folder.path);
  };
  expect(with(stiff, "linear_stiffness = \"5 N/um\"", "stiffness = 1"), "\"j1\" slides and needs its linear_stiffness");
  expect(with(stiff, "linear_stiffness", "damping = 3\nlinear_stiffness"), "remove its motor, servo and damping");
  expect(stiff + "[[joints]]\nname = \"g\"\ndistance = 1\n", "joint \"g\" is continuous and stands at no distance");
  core::write_file_atomically(folder.path / "joints.toml", stiff + "[[joints]]\nname = \"g\"\nangle = \"20 deg\"\n");
  EXPECT_TRUE(doubts_about(parse_case(stands, folder.path)).empty()) << "its place is stated";
}

TEST(RobotCase, AnEndOfAUrdfThatIsNotToldIsReportedAtItsKey) {
  const TemporaryFolder folder;
  core::write_file_atomically(folder.path / "joints.toml", joints);
  core::write_file_atomically(folder.path / "two.urdf",
                              with(urdf, "</robot>",
                                   "<link name=\"camera\"/><joint name=\"g\" type=\"fixed\"><parent link=\"b\"/><child "
                                   "link=\"camera\"/></joint></robot>"));
  expect_problem(by_urdf, "robot.urdf_tip", "link \"b\" carries several (", folder.path);
  EXPECT_NO_THROW((void)parse_case(with(by_urdf, "urdf =", "urdf_tip = \"tool\"\nurdf ="), folder.path));
  expect_problem(with(by_urdf, "urdf =", "urdf_tip = \"tol\"\nurdf ="), "robot.urdf_tip", "did you mean \"tool\"",
                 folder.path);
  expect_problem(with(by_urdf, "urdf =", "urdf_base = \"bse\"\nurdf_tip = \"tool\"\nurdf ="), "robot.urdf_base",
                 "did you mean \"base\"", folder.path);
}

}  // namespace
}  // namespace thinwall::tests::robot_case_test
