#include "report/page/phases.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.hpp"
#include "io/results/pvd.hpp"
#include "io/results/vtp.hpp"

namespace thinwall::report {

namespace {

namespace fs = std::filesystem;

void require_shape(const PhasesRequest& request, const io::SurfaceFields& fields) {
  const auto modes = static_cast<int>(fields.vectors.size());
  if (request.mode < 1 || request.mode > modes)
    throw core::InputError("there is no mode " + std::to_string(request.mode) + "; the results hold shapes 1 to " +
                           std::to_string(modes));
  if (!(request.amplitude >= 1e-3 && request.amplitude <= 10.0))
    throw core::InputError("the amplitude is a share of the part's diagonal, 0.001 to 10");
}

}  // namespace

fs::path write_phases(const fs::path& results, const PhasesRequest& request) {
  constexpr int phases = 16;
  if (request.of != "part" && request.of != "coupled")
    throw core::UsageError("shapes are of the \"part\" alone or \"coupled\" with the robot, not of \"" + request.of +
                           "\"");
  const fs::path folder = results / "modes";
  const io::SurfaceFields fields = io::read_vtp(folder / (request.of + "_surface.vtp"));
  require_shape(request, fields);
  const auto& shape = fields.vectors[static_cast<std::size_t>(request.mode - 1)].values;
  Eigen::AlignedBox3d box;
  for (const auto& x : fields.surface.vertices) box.extend(x);
  const double largest = shape.rowwise().norm().maxCoeff();
  const double scale = largest > 0.0 ? request.amplitude * box.diagonal().norm() / largest : 0.0;
  const std::string stem = fmt::format("{}_mode_{:02}_phases", request.of, request.mode);
  std::vector<io::PvdEntry> entries;
  for (int k = 0; k < phases; ++k) {
    const double cosine = std::cos(2.0 * std::numbers::pi * k / phases);
    mesh::TriangleSurface moved = fields.surface;
    for (std::size_t v = 0; v < moved.vertices.size(); ++v)
      moved.vertices[v] += scale * cosine * shape.row(static_cast<Eigen::Index>(v)).transpose();
    io::TriangleNumbers size{"displacement_relative", {}};
    for (const auto& t : moved.triangles) {
      const double sum = shape.row(t[0]).norm() + shape.row(t[1]).norm() + shape.row(t[2]).norm();
      size.values.push_back(largest > 0.0 ? std::abs(cosine) * sum / (3.0 * largest) : 0.0);
    }
    entries.push_back({static_cast<double>(k), fmt::format("{}_{:02}.vtp", stem, k)});
    io::write_vtp(folder / entries.back().file, moved, {size});
  }
  io::write_pvd(folder / (stem + ".pvd"), entries);
  return folder / (stem + ".pvd");
}

}  // namespace thinwall::report
