#pragma once
// Modes followed over many postures.

#include <Eigen/Core>
#include <vector>

#include "identification/modal_fit.hpp"

namespace thinwall::identification {

/// The names of modes over postures.
struct Tracking {
  std::vector<std::vector<int>> label;      ///< of each posture and mode, from 0 on
  std::vector<std::vector<bool>> doubtful;  ///< neighbours of the posture, or another way to it, disagree
  int labels = 0;
  std::vector<int> parent;  ///< of each posture in the tree, −1 for where it begins
};

/// The unlikeness of two modes: 1 − MAC of left times MAC of right vectors, plus 8 |Δ ln ω| + ½ |Δ ln ζ| + 3/10 |Δ ln
/// of the residue's size|. 0 for the same one.
[[nodiscard]] double unlikeness(const FittedMode& a, const FittedMode& b);

/// Joins the modes of postures, each with left and right vector, along the tree of least difference that spans them
/// (Prim 1957), from the posture that differs least from all others. The difference of two postures is what their
/// cheapest pairing by unlikeness() costs, so that neither the places nor a scale for them are needed; it follows
/// crossings because shapes change less between neighbours than the order of frequencies does. A mode of a label that
/// the parent does not have is compared with the nearest ancestor that has it, so that a gap ends no label; one that is
/// unlike all by more than 3 begins a new one. The tree hears one neighbour of each posture; then labels of a posture
/// are exchanged where that lowers the cost against all of its neighbours: the `neighbours` postures that differ least,
/// as many that lie nearest, and those that have it among theirs, until nothing changes (iterated conditional modes,
/// Besag 1986). Where more of those that differ least contradict a label than agree with it, it is doubtful. Labels are
/// numbered by the mean frequency of their modes. `turned`: the same modes in another frame, such as that of the tip,
/// in which those of a spindle hardly change while those of an arm do; two modes are as unlike as in the frame in which
/// they are less. `places`: a row a posture, whose columns count by their ranges. With them the modes are followed a
/// second time, along the shortest tree that spans the places, and a name that is another one on this way is doubtful,
/// too: around an exceptional point, where two modes are one, names depend on the way although every step is sure
/// (docs/theory/postures.md). Throws InputError for no posture, modes without vectors, frames with another number of
/// modes or another number of places. Cost O(postures² modes³).
[[nodiscard]] Tracking track(const std::vector<std::vector<FittedMode>>& postures,
                             const std::vector<std::vector<FittedMode>>& turned = {},
                             const Eigen::MatrixXd& places = {}, int neighbours = 6);

}  // namespace thinwall::identification
