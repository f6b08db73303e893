#include "app/case_template.hpp"

#include <system_error>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/nearest_name.hpp"

namespace thinwall::app {

namespace {

// Every key is in docs/case-file.md. Quantities go in quotes with their unit; bare numbers are SI.
constexpr const char* plate = R"(# A plate clamped at both ends, held from behind by a robot and milled on its front.
# Every key is described in docs/case-file.md. Quantities carry their unit in quotes; a bare number is SI.
title = "Robot-supported plate"

[part]                       # a box, one corner at the origin
length = "400 mm"            # along y
height = "100 mm"            # along z
thickness = "6 mm"           # along x

[part.material]
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
density = "7850 kg/m^3"

[part.mesh]
tolerance = 0.001            # of frequencies and receptances; size and order of the elements follow

[[part.supports]]            # faces: x_min, x_max, y_min, y_max, z_min, z_max
on = "y_min"
[[part.supports]]
on = "y_max"

[points.P]                   # where the robot touches and the tool cuts
at = [1.0, 0.5, 0.95]        # fractions of the box along x, y, z
patch_radius = "3 mm"

[damping]
ratio = 0.01                 # of every mode; ratios = [0.008, 0.012] names the first ones

[robot]                      # one mode at the tip; leave the section out for the part alone
direction = "x"
frequency = "29 Hz"
stiffness = "1.7e6 N/m"
damping_ratio = 0.02

[[contacts]]
part = "P"
directions = ["x"]
stiffness = "inf"            # or "1e8 N/m"

[response]
to = "2 kHz"

[tool]
teeth = 6
diameter = "16 mm"
length = "20 mm"

[cutting]
at = "P"
radial_depth = "0.2 mm"
mode = "down"
Kt = "2220 N/mm^2"           # C45; see cases/barrios-2019/README.md
Kr = "666 N/mm^2"
spindle_speed = "1900 rpm"

[lobes]
from = "1000 rpm"
to = "3000 rpm"
count = 200
modes_up_to = "4 kHz"
)";

constexpr const char* wall = R"(# A wall clamped along its foot and milled along its free edge.
# Every key is described in docs/case-file.md. Quantities carry their unit in quotes; a bare number is SI.
title = "Cantilever wall"

[part]                       # a box, one corner at the origin
length = "120 mm"            # along y
height = "60 mm"             # along z
thickness = "2 mm"           # along x

[part.material]              # aluminium
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"

[part.mesh]
tolerance = 0.001            # of frequencies and receptances; size and order of the elements follow

[[part.supports]]
on = "z_min"

[points.P]                   # middle of the free edge
at = [1.0, 0.5, 0.97]        # fractions of the box along x, y, z
patch_radius = "1.5 mm"

[damping]
ratio = 0.006

[response]
to = "5 kHz"

[tool]
teeth = 4
diameter = "12 mm"
length = "26 mm"

[cutting]
at = "P"
radial_depth = "0.5 mm"
mode = "down"
Kt = "600 N/mm^2"            # 7075-T6; see cases/cantilever-wall/README.md
Kr = "181 N/mm^2"

[lobes]
from = "3000 rpm"
to = "15000 rpm"
count = 200
depth_limit = "10 mm"
)";

}  // namespace

std::vector<std::string> template_names() {
  return {"plate", "wall"};
}

std::string case_template(const std::string& name) {
  if (name == "plate") return plate;
  if (name == "wall") return wall;
  throw core::UsageError("there is no template \"" + name + "\"" + core::did_you_mean(name, template_names()) +
                         "; there are plate and wall");
}

std::filesystem::path write_template(const std::string& name, const std::filesystem::path& folder) {
  const std::string text = case_template(name);
  auto file = folder / "case.toml";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw core::DataError("cannot make \"" + folder.string() + "\": " + error.message() + "; choose another folder");
  if (std::filesystem::exists(file)) {
    throw core::DataError("\"" + file.string() + "\" is already there and is not overwritten; choose another folder");
  }
  core::write_file_atomically(file, text);
  return file;
}

}  // namespace thinwall::app
