#pragma once
// Craig-Bampton superelements that Sierra/SD (Salinas) writes as NetCDF, by themselves or within an Exodus file.
//
// Layout: Sierra/SD User's Manual, "Superelement"; the names also by the Exodus tools for MATLAB that Sandia published.
// Variables: Kr, Mr and Cr (may be absent), NumDof × NumDof; cbmap, NumDof × 2, of each coordinate the node and the
// component 1 … 6, or a node that is not positive for the amplitude of a mode; coordx, coordy, coordz and node_num_map
// of Exodus.

#include <string>
#include <string_view>

#include "dynamics/sparse_model.hpp"

namespace thinwall::io {

/// The superelement in a NetCDF file's bytes, in the units of the file. The amplitude of the k-th mode (from 1) gets
/// the number of the largest node, of cbmap and node_num_map, plus k. Nodes of cbmap are the numbers of node_num_map if
/// all of them occur there, else places in that map, from 1. Without cbmap the model has no DOFs, and is not consistent
/// until it gets them. `path` is for messages. Throws DataError that names the file and the variable that is missing or
/// of another shape. Cost O(bytes).
[[nodiscard]] dynamics::SparseModel read_superelement(std::string_view bytes, const std::string& path);

}  // namespace thinwall::io
