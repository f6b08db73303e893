#pragma once
// What each kept stage of a run follows from, as a key: the same key, the same result.

#include <string>
#include <vector>

#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Hash of the program, of the case's values but those under the given keys or sections ("lobes.count", "cutting"), of
/// the bytes of the files that the other sections name, and of words `besides`. Throws DataError for a file that cannot
/// be read. Cost: of hashing these files.
[[nodiscard]] std::string key_of(const Case& source, const std::vector<std::string>& without,
                                 const std::vector<std::string>& besides = {});

/// Of the part as it is meshed, solved and reduced (PartResult less its damping): all but the robot, the tool, the cut
/// and the charts. Along a path the points of cut and contacts belong to it; damping only where the number of modes
/// or a fit follows from it, or a file brings it. Throws DataError for a file that cannot be read, as the others do.
[[nodiscard]] std::string part_key(const Case& source);

/// Of part, robot and their receptances: all but the tool, the cut and the charts. Along a path the robot's postures
/// follow from the points of cut and contacts, so these belong to it.
[[nodiscard]] std::string structure_key(const Case& source);

/// Of the rows of the charts: all but the title, the machine's limits and the case's own speed, unless a force law
/// asks for the feed of a tooth, which then follows from it.
[[nodiscard]] std::string charts_key(const Case& source);

}  // namespace thinwall::cases
