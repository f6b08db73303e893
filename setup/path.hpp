#pragma once
// The set-up at the positions of the path along which the cut moves.

#include <cstddef>
#include <string>
#include <vector>

#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// The points of the part that matter while the cut is at one position of its path.
struct PathStation {
  std::vector<Point> points;  ///< the cut, moved there with its patch, and the contacts' points that differ from it
  std::string cut;            ///< name of the cut's point
  std::vector<std::string> touched;  ///< name of each contact's point on the part, in the order of the contacts
};

/// The station of one position. The contacts' points move by the same vector as the cut where the robot follows it;
/// one that coincides with the cut is the cut's. The set-up must have a path, a part and a known `cutting.at`; throws
/// InputError for an unknown point.
[[nodiscard]] PathStation station(const Setup& source, std::size_t position);

/// The stations of all positions in their order; empty without a path or a part. Errors as station().
[[nodiscard]] std::vector<PathStation> stations(const Setup& source);

/// The part with the points of the station alone, which are the interface of its reduction.
[[nodiscard]] PartSetup part_at(const PartSetup& source, const PathStation& station);

/// The robot's contacts, or the cut of a robot that carries the tool, at the points of the station.
[[nodiscard]] SupportSetup support_at(const SupportSetup& source, const PathStation& station);

/// The cut at its point of the station.
[[nodiscard]] CutSetup cut_at(const CutSetup& source, const PathStation& station);

}  // namespace thinwall::setup
