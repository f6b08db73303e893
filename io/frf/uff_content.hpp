#pragma once
// The contents of a universal file: geometry, shapes and FRFs together.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/frf/measured_response.hpp"
#include "io/frf/uff.hpp"
#include "io/frf/uff_mesh.hpp"
#include "io/frf/uff_shapes.hpp"

namespace thinwall::io {

/// The contents of a universal file, each part as its own reader gives it.
struct UffContent {
  std::map<int, int> data_sets;         ///< how many of each number
  std::optional<UffMesh> geometry;      ///< nodes (15, 2411), elements (2412), trace lines (82)
  std::optional<UffShapes> shapes;      ///< data sets 55
  std::optional<MeasuredEntries> frfs;  ///< data sets 58
  std::vector<std::string> refused;     ///< why a part that is there could not be read: a line each
};

/// True if the bytes begin as a universal file does, with a line "    -1".
[[nodiscard]] bool begins_as_universal_file(std::string_view bytes);

/// Reads each part of a file that is there: geometry (uff_mesh(), with `unit_in_m`), shapes (uff_shapes()) and FRFs
/// (uff_entries(), with `reading`). A part that its reader refuses is told in `refused`. Throws DataError where the
/// file does not consist of data sets (universal_data_sets()). Memory and cost O(bytes).
[[nodiscard]] UffContent uff_content(std::string_view bytes, const std::string& source,
                                     std::optional<double> unit_in_m = std::nullopt, const UffReading& reading = {});

/// The labels on which shapes have values and for which the geometry has no node; empty without one of the two.
[[nodiscard]] std::vector<long> nodes_without_place(const UffContent& content);

}  // namespace thinwall::io
