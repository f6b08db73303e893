#include "io/urdf.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/atomic_file.hpp"
#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "tests/io/scratch_folder.hpp"

namespace thinwall::io::urdf_test {
namespace {

const std::string two_links = R"(<?xml version="1.0"?>
<robot name="arm">
  <link name="world"/>
  <link name="shoulder"><inertial><origin xyz="0 0 0.3"/><mass value="40"/>
    <inertia ixx="2" iyy="3" izz="4" ixy="0.1" ixz="0.2" iyz="0.3"/></inertial></link>
  <link name="arm"><inertial><origin xyz="0.2 0 0" rpy="0 0 1.5707963267948966"/><mass value="10"/>
    <inertia ixx="1" iyy="2" izz="2.5" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="flange"><inertial><origin xyz="0 0 0.1"/><mass value="5"/>
    <inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="cable"><inertial><mass value="1"/><inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="j1" type="revolute"><parent link="world"/><child link="shoulder"/><origin xyz="0 0 0.5"/><axis xyz="0 0 2"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="j2" type="continuous"><parent link="shoulder"/><child link="arm"/><origin xyz="0 0 0.6" rpy="0 1.5707963267948966 0"/><axis xyz="0 1 0"/></joint>
  <joint name="f" type="fixed"><parent link="arm"/><child link="flange"/><origin xyz="0.4 0 0"/></joint>
  <joint name="c" type="fixed"><parent link="arm"/><child link="cable"/><origin xyz="0 1 0"/></joint>
</robot>
)";

class Urdf : public test::ScratchFolder {
 protected:
  UrdfChain read(const std::string& text, const std::string& base, const std::string& tip) {
    core::write_file_atomically(file, text);
    return read_urdf(file, base, tip);
  }
  void expect_refused(const std::string& text, const std::string& part, const std::string& tip = "flange") {
    try {
      (void)read(text, "", tip);
      ADD_FAILURE() << "accepted, though " << part;
    } catch (const core::DataError& error) {
      const std::string found = error.what();
      EXPECT_NE(found.find(part), std::string::npos) << found;
      EXPECT_EQ(found.find('\n'), std::string::npos) << found;
    }
  }
  std::filesystem::path file = path("arm.urdf");
};

std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(Urdf, JointsAndFramesAreThoseOfTheFile) {
  const UrdfChain chain = read(two_links, "", "flange");
  ASSERT_EQ(chain.links.size(), 2U);
  EXPECT_EQ(chain.links[0].name, "shoulder");
  EXPECT_EQ(chain.links[0].joint, "j1");
  EXPECT_EQ(chain.links[0].axis, Eigen::Vector3d::UnitZ()) << "of unit length";
  EXPECT_EQ(chain.links[0].placement.translation(), Eigen::Vector3d(0, 0, 0.5));
  EXPECT_DOUBLE_EQ(chain.links[0].mass, 40.0);
  EXPECT_DOUBLE_EQ(chain.links[0].inertia(1, 2), 0.3);
  // Pitched by 90 degrees the child's x axis points down.
  EXPECT_LT((chain.links[1].placement.linear().col(0) + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((chain.tip.translation() - Eigen::Vector3d(0.4, 0, 0)).norm(), 1e-12);
}

// Arm, flange and cable are one body: 10 kg at (0.2, 0, 0) turned about z by 90 degrees, 5 kg at (0.4, 0, 0.1), 1 kg at
// (0, 1, 0).
TEST_F(Urdf, WhatIsFixedToALinkIsPartOfIt) {
  const UrdfLink arm = read(two_links, "world", "flange").links[1];
  EXPECT_DOUBLE_EQ(arm.mass, 16.0);
  const Eigen::Vector3d places[] = {{0.2, 0, 0}, {0.4, 0, 0.1}, {0, 1, 0}};
  const double masses[] = {10, 5, 1};
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) centre += masses[i] * places[i] / 16.0;
  EXPECT_LT((arm.centre - centre).norm(), 1e-14);
  Eigen::Matrix3d I = Eigen::Vector3d(2, 1, 2.5).asDiagonal();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d d = places[i] - centre;
    I += masses[i] * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
  }
  EXPECT_LT((arm.inertia - I).norm(), 1e-12);
}

TEST_F(Urdf, WhatAnArmCannotHaveIsRefusedByName) {
  expect_refused("not xml", "no robot in URDF");
  expect_refused(with(two_links, "type=\"continuous\">", "type=\"planar\">"), "\"j2\" is planar");
  expect_refused(two_links, "there is no link \"flanges\" (did you mean \"flange\"?)", "flanges");
  expect_refused(two_links, "carries several (", "");
  expect_refused(two_links.substr(0, two_links.find("<link name=\"shoulder")) + "</robot>", "no joint moves", "world");
  expect_refused(with(two_links, "mass value=\"40\"", "mass value=\"-40\""), "mass or inertia that no body has");
  expect_refused(with(two_links, "<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 1 0\"/><mimic joint=\"j1\"/>"), "mimics");
  expect_refused(with(two_links, "xyz=\"0 0 2\"", "xyz=\"0 0 0\""), "j1");
  EXPECT_THROW((void)read_urdf(path("none.urdf")), core::DataError);
  EXPECT_THROW((void)read(two_links, "flange", "world"), core::DataError) << "the wrong way";
}

// The cable, 1 kg, hangs on a joint beside the chain: where that stands is where its mass is.
TEST_F(Urdf, JointsBesideTheChainStandStillAtTheStatedPlace) {
  const std::string limits = "\"><limit lower=\"0.2\" upper=\"1\" effort=\"1\" velocity=\"1\"/><axis xyz=\"0 0 3\"/>";
  const std::string turning = with(two_links, "name=\"c\" type=\"fixed\">", "name=\"c\" type=\"revolute" + limits);
  const std::string sliding = with(two_links, "name=\"c\" type=\"fixed\">", "name=\"c\" type=\"prismatic" + limits);
  const auto cable = [&](const std::string& text, const UrdfPlaces& places) -> Eigen::Vector3d {
    const UrdfChain chain = (core::write_file_atomically(file, with(text, "<mass value=\"1\"/>",
                                                                    "<origin xyz=\"0.5 0 0\"/><mass value=\"1\"/>")),
                             read_urdf(file, "world", "flange", places));
    EXPECT_EQ(chain.frozen.size(), 1U);
    EXPECT_EQ(chain.frozen[0].stated, !places.empty());
    return 16.0 * chain.links[1].centre - 10.0 * Eigen::Vector3d(0.2, 0, 0) - 5.0 * Eigen::Vector3d(0.4, 0, 0.1);
  };
  const double right_angle = std::numbers::pi / 2;
  EXPECT_LT((cable(turning, {{"c", {right_angle, false}}}) - Eigen::Vector3d(0, 1.5, 0)).norm(), 1e-12);
  EXPECT_LT((cable(turning, {}) - Eigen::Vector3d(0.5 * std::cos(0.2), 1 + 0.5 * std::sin(0.2), 0)).norm(), 1e-12)
      << "0 is outside the limits";
  EXPECT_LT((cable(sliding, {{"c", {0.7, true}}}) - Eigen::Vector3d(0.5, 1, 0.7)).norm(), 1e-12);
  EXPECT_THROW((void)cable(sliding, {{"c", {0.7, false}}}), core::DataError) << "an angle of a joint that slides";
  EXPECT_THROW((void)cable(sliding, {{"cc", {0.7, true}}}), core::DataError) << "no such joint";
  const std::string mimics = with(turning, "</robot>",
                                  "<link name=\"d\"/><joint name=\"g\" type=\"continuous\"><parent "
                                  "link=\"arm\"/><child link=\"d\"/><axis xyz=\"0 0 "
                                  "1\"/><mimic joint=\"c\" multiplier=\"-2\" offset=\"0.1\"/></joint></robot>");
  core::write_file_atomically(file, mimics);
  const UrdfChain chain = read_urdf(file, "world", "flange", {{"c", {0.3, false}}});
  ASSERT_EQ(chain.frozen.size(), 2U);
  EXPECT_TRUE(chain.frozen[0].stated && chain.frozen[1].stated) << "a joint that mimics a stated one is stated";
  EXPECT_NEAR(chain.frozen[chain.frozen[0].name == "g" ? 0 : 1].value, -0.5, 1e-15);
}

TEST_F(Urdf, AJointOfTheChainWithAStatedPlaceIsFixedThere) {
  core::write_file_atomically(file, two_links);
  const UrdfChain chain = read_urdf(file, "world", "flange", {{"j2", {std::numbers::pi / 2, false}}});
  ASSERT_EQ(chain.links.size(), 1U);
  EXPECT_DOUBLE_EQ(chain.links[0].mass, 56.0);
  // The flange's x is turned down by j2's frame, and back by a quarter turn about y less: it points to -x of the
  // shoulder's frame.
  EXPECT_LT((chain.tip.translation() - Eigen::Vector3d(-0.4, 0, 0.6)).norm(), 1e-12);
}

TEST_F(Urdf, AJointOfTheChainMaySlide) {
  const UrdfChain chain = read(with(two_links, "type=\"continuous\">",
                                    "type=\"prismatic\"><limit lower=\"0\" upper=\"1\" effort=\"1\" velocity=\"1\"/>"),
                               "world", "flange");
  ASSERT_EQ(chain.links.size(), 2U);
  EXPECT_FALSE(chain.links[0].slides);
  EXPECT_TRUE(chain.links[1].slides);
}

// A frame beside the foot is no tip; of two fingers and a tool's frame the last lies farthest from the base.
TEST_F(Urdf, ATipIsProposedAndAFrameBesideTheChainIsNone) {
  const auto fixed = [](const std::string& name, const std::string& parent, const std::string& z) {
    return "<link name=\"" + name + "\"/><joint name=\"to_" + name + "\" type=\"fixed\"><parent link=\"" + parent +
           "\"/><child link=\"" + name + "\"/><origin xyz=\"0 0 " + z + "\"/></joint>";
  };
  const auto finger = [](const std::string& name) {
    return "<link name=\"" + name + "\"/><joint name=\"to_" + name +
           "\" type=\"continuous\"><parent link=\"flange\"/>" + "<child link=\"" + name +
           "\"/><origin xyz=\"0 0 0.05\"/></joint>";
  };
  std::string one_chain = with(two_links, "<joint name=\"c\" type=\"fixed\"><parent link=\"arm\"/>",
                               "<joint name=\"c\" type=\"fixed\"><parent link=\"flange\"/>");
  one_chain = with(one_chain, "</robot>", fixed("base", "world", "9") + "</robot>");
  EXPECT_EQ(read(one_chain, "", "").links.size(), 2U);
  expect_refused(with(one_chain, "</robot>", fixed("tool0", "flange", "2") + "</robot>"),
                 "(cable, tool0); name the link that is the robot's tip: \"tool0\" lies farthest", "");
  expect_refused(
      with(one_chain, "</robot>", finger("left") + finger("right") + fixed("tool0", "flange", "2") + "</robot>"),
      "(left, right); name the link that is the robot's tip: \"tool0\" lies farthest", "");
}

std::string links(int count, const std::string& joints) {
  std::string text = "<robot name=\"r\"><link name=\"root\"/>";
  for (int i = 0; i < count; ++i) text += "<link name=\"l" + std::to_string(i) + "\"/>";
  return text + joints + "</robot>";
}

std::string joint(const std::string& name, const std::string& parent, const std::string& child) {
  return "<joint name=\"" + name + "\" type=\"fixed\"><parent link=\"" + parent + "\"/><child link=\"" + child +
         "\"/></joint>";
}

// A way up from l1 has no end, and every one of twenty links that hang twice doubles the ways down.
TEST_F(Urdf, JointsThatMakeNoTreeAreRefusedByName) {
  expect_refused(links(3, joint("a", "root", "l0") + joint("b", "l1", "l2") + joint("c", "l2", "l1")),
                 "hangs on joints that form a cycle", "l1");
  expect_refused(links(1, joint("a", "l0", "l0")), "hangs on joints that form a cycle", "l0");
  expect_refused(links(2, joint("a", "root", "l0") + joint("b", "l0", "l1") + joint("c", "l0", "l1")),
                 "\"b\" and \"c\" both carry link \"l1\"", "l1");
}

// The parser descends by recursion, and so are links freed.
TEST_F(Urdf, WhatIsNestedTooDeepForTheParserIsRefusedBeforeIt) {
  std::string deep = "<robot name=\"r\">";
  for (int i = 0; i < 1000000; ++i) deep += "<a>";
  expect_refused(deep, "nested deeper than 100");
  std::string joints;
  for (int i = 1; i < 1100; ++i)
    joints += joint("j" + std::to_string(i), "l" + std::to_string(i - 1), "l" + std::to_string(i));
  expect_refused(links(1100, joints), "more than 1000 joints");
  std::string flat = two_links;
  for (int i = 0; i < 200; ++i) flat.insert(flat.rfind("</robot>"), "<!-- <a> --><gazebo reference=\"a>b\"/>");
  EXPECT_EQ(read(flat, "", "flange").links.size(), 2U) << "comments and closed tags have no depth";
}

}  // namespace
}  // namespace thinwall::io::urdf_test
