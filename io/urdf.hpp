#pragma once
// A serial chain from a URDF file, the format in which robot makers and ROS describe arms (wiki.ros.org/urdf/XML).

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace thinwall::io {

/// A rigid body and the joint that carries it; bodies that fixed joints connect to it are part of it. At angle 0 its
/// frame is the joint's.
struct UrdfLink {
  std::string name;                                             ///< name of the first link that moves with it
  std::string joint;                                            ///< name of the joint
  Eigen::Isometry3d placement = Eigen::Isometry3d::Identity();  ///< joint's frame in that of the link before, m
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();              ///< in the joint's frame
  double mass = 0.0;                                            ///< kg
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();             ///< centre of mass in the link's frame, m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();            ///< about the centre, in the link's axes, kg m²
};

/// The links from `base` to `tip`. The frame `tip` is relative to that of the last link.
struct UrdfChain {
  std::vector<UrdfLink> links;
  Eigen::Isometry3d tip = Eigen::Isometry3d::Identity();
};

/// The error of an end of the chain that is not told, or is no link that it can be.
struct UrdfEndError : core::DataError {
  UrdfEndError(const std::string& message, bool of_tip) : core::DataError(message), tip(of_tip) {}
  bool tip;  ///< true of the tip, false of the base
};

/// Reads the chain between two links of the file; an empty `base` is the root, an empty `tip` the one link at the end
/// of the only chain. Joints along the chain are revolute, continuous or fixed; branches off it must be fixed, and add
/// their mass. A URDF contains neither stiffness nor rotor inertia; its damping and friction, which belong to a
/// controller's model, are not read. Throws DataError that names the file and the fault: no XML, a joint of another
/// kind (prismatic, planar, floating) or one that mimics another, joints that form a cycle or carry one link twice,
/// more than 1000 joints, a mass or inertia that is not finite; UrdfEndError for an end that does not exist, a tip that
/// does not hang on the base, or an empty one where there are several.
[[nodiscard]] UrdfChain read_urdf(const std::filesystem::path& path, const std::string& base = "",
                                  const std::string& tip = "");

}  // namespace thinwall::io
