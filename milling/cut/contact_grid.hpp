#pragma once
// The contact of the teeth within a period of the cut, sampled at nodes: what is known before speed and structure.

#include <Eigen/Core>
#include <vector>

#include "milling/cut/process.hpp"

namespace thinwall::milling {

/// A smooth stretch of the cut: no tooth enters or leaves within it.
struct CutElement {
  double from_rad = 0.0;  ///< rotation since the start of the period
  double to_rad = 0.0;
  int first_node = 0;
  int nodes = 0;
};

/// A share of the displacement of another time, at a node in this period or the one before. (Process damping sees a
/// slope: the difference to its own and the other nodes of its element, in this period.)
struct Past {
  int node = 0;
  bool previous_period = true;
  Eigen::Vector3d chip;
};

/// One way in which the force at a node depends on the displacement: with f the force on the tool and q the
/// displacement of tool minus part, both in tool axes, and w the depth,
///
///     f(t_node) = −w Σ force · c,      c = chipᵀ q(t_node) − Σ chip_pastᵀ q(past)      over the node's contacts
///
/// The matrices are means over the depth if the heights of an edge differ, by helix or envelope.
struct EdgeContact {
  int node = 0;
  Eigen::Vector3d force;  ///< N/m²
  Eigen::Vector3d chip;   ///< of unit size where the node has one delay, below it where it has several
  std::vector<Past> past;
};

/// The elements of one period of the cut, and the contacts at their nodes.
struct ContactGrid {
  double period_rad = 0.0;  ///< after which the cut repeats itself
  std::vector<CutElement> elements;
  Eigen::VectorXd node_rad;
  std::vector<EdgeContact> contacts;
  bool one_delay = true;  ///< every past is the same node, one period ago
};

/// The fineness with which a cut is sampled.
struct Resolution {
  int elements = 1;  ///< of the longest stretch between entries and exits; others in proportion
  int nodes = 8;     ///< of an element
};

/// The period is a pitch where all teeth are alike, else a turn. Elements end where a tip, a joint of the envelope or
/// the edge at the depth enters or leaves an arc; with unequal teeth also where such a moment is felt again a pitch
/// later. Nodes are Gauss's, so that the end of an element is superconvergent. Heights of one edge with one delay are
/// integrated exactly (edge.hpp); where the helices of two teeth differ the delay changes along the edge, which is cut
/// into six Gauss slices a piece. Process damping adds contacts that see the slope dq/dφ of the polynomial of the
/// element (spectrally accurate, as the rest). The directional matrix of a node is cut into contacts by its singular
/// values: one tooth at a time gives one a node. With several delays at once (unequal teeth) there is a contact for
/// each direction of the force, which sees them all. A past moment between nodes is the polynomial of its element.
/// `yielding`: 3 × p, orthonormal columns in tool axes, the directions in which the structure moves or feels a force.
/// `depth_m` matters where Cutter::depends_on_depth. Throws InputError if it exceeds the height of the edges. Cost
/// O(nodes teeth).
[[nodiscard]] ContactGrid contact_grid(const MillingProcess& process, const Eigen::Matrix3Xd& yielding,
                                       Resolution resolution, double depth_m = 0.0);

/// The longest stretch without an entry or exit, rad.
[[nodiscard]] double longest_stretch_rad(const MillingProcess& process, double depth_m = 0.0);

}  // namespace thinwall::milling
