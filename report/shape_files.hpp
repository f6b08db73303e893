#pragma once
// Mode shapes of the part, alone and with the robot, as files.

#include <filesystem>
#include <functional>
#include <vector>

#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::report {

/// Files to be written side by side, each by one call; what they refer to must outlive them.
using FileTasks = std::vector<std::function<void()>>;

/// Tables of modes (modes.csv, coupled_modes.csv), how alike the shapes of the part alone and with the robot are
/// (mac.csv, auto_mac.csv; dynamics::mac), each shape on the elements (VTU, PVD) and all of them on the surface
/// (part_surface.vtp, coupled_surface.vtp) with what is held, by each support (shape_files.cpp), and how thick the wall
/// is, and with geometry for programs of modal tests (part.uff, coupled.uff). The largest entry of every drawn shape,
/// the robot's end included, is 1; the files have `warp_factor`, a twentieth of the part's diagonal in m, and those of
/// the part alone `modal_mass_kg`. `source` is the case as the part was computed, fitted sizes included. The tables are
/// written at once.
void write_shapes(FileTasks& files, const std::filesystem::path& folder, const setup::Setup& source,
                  const study::Results& results);

}  // namespace thinwall::report
