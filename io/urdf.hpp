#pragma once
// A serial chain from a URDF file, the format in which robot makers and ROS describe arms (wiki.ros.org/urdf/XML).

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace thinwall::io {

/// A rigid body and the joint that carries it; bodies that fixed joints, or joints beside the chain, connect to it are
/// part of it. Where the joint stands at 0 its frame is the joint's.
struct UrdfLink {
  std::string name;                                             ///< name of the first link that moves with it
  std::string joint;                                            ///< name of the joint
  Eigen::Isometry3d placement = Eigen::Isometry3d::Identity();  ///< joint's frame in that of the link before, m
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();              ///< in the joint's frame
  double mass = 0.0;                                            ///< kg
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();             ///< centre of mass in the link's frame, m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();            ///< about the centre, in the link's axes, kg m²
  bool slides = false;                                          ///< true if the joint slides along its axis
};

/// The place at which a joint is held.
struct UrdfPlace {
  double value = 0.0;   ///< rad, m
  bool slides = false;  ///< true of a distance, false of an angle
};

/// Places of joints by the joints' names.
using UrdfPlaces = std::map<std::string, UrdfPlace>;

/// A joint beside the chain, which is taken as fixed.
struct UrdfFrozenJoint {
  std::string name;
  double value = 0.0;   ///< rad, m
  bool slides = false;  ///< true if the value is a distance
  bool stated = false;  ///< true if the user has stated it, or that of the joint which this one mimics
};

/// The links from `base` to `tip`. The frame `tip` is relative to that of the last link. `frozen` are the joints beside
/// the chain that moving links carry.
struct UrdfChain {
  std::vector<UrdfLink> links;
  std::vector<UrdfFrozenJoint> frozen;
  Eigen::Isometry3d tip = Eigen::Isometry3d::Identity();
};

/// The error of an end of the chain that is not told, or is no link that it can be.
struct UrdfEndError : core::DataError {
  UrdfEndError(const std::string& message, bool of_tip) : core::DataError(message), tip(of_tip) {}
  bool tip;  ///< true of the tip, false of the base
};

/// Reads the chain between two links of the file; an empty `base` is the root, an empty `tip` the one link at the end
/// of the only chain, beside which branches without a moving joint do not count. Joints along the chain are revolute,
/// continuous, prismatic or fixed. A joint in `places` is fixed there; a joint beside the chain (a gripper's, a head's)
/// is fixed at its place, or at the one that follows from the joint that it mimics, or at the one within its limits
/// that is nearest to 0, and adds the mass that it carries. A URDF contains neither stiffness nor rotor inertia; its
/// damping and friction, which belong to a controller's model, are not read. Throws DataError that names the file and
/// the fault: no XML, a joint along the chain of another kind (planar, floating) or one that mimics another, joints
/// that form a cycle or carry one link twice, more than 1000 joints, a place of a joint that does not exist or is of
/// another kind, a mass or inertia that is not finite; UrdfEndError for an end that does not exist, a tip that does not
/// hang on the base, or an empty one where there are several, of which the farthest from the base that moves with some
/// mass is proposed.
[[nodiscard]] UrdfChain read_urdf(const std::filesystem::path& path, const std::string& base = "",
                                  const std::string& tip = "", const UrdfPlaces& places = {});

}  // namespace thinwall::io
