#pragma once
// The part of a set-up as the mesher and the finite elements take it: geometry, supports, points.

#include <array>
#include <string>
#include <vector>

#include "fem/closed_part.hpp"
#include "fem/to_tolerance.hpp"
#include "mesh/planar/bend.hpp"
#include "mesh/selection.hpp"
#include "mesh/solid/solid_mesh.hpp"
#include "mesh/tet_mesh.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// The part's prism in its plane: of a box, length and height; x, y, z of the mesher run along `axes` of the part.
struct PlanarPart {
  mesh::Prism prism;
  std::array<int, 3> axes{0, 1, 2};
};
/// The prism of a box or a prismatic part.
[[nodiscard]] PlanarPart planar(const Part& part);

/// The part's bend in its own coordinates; the part must have one.
[[nodiscard]] mesh::Bend bend_of(const Part& part);

/// Moves the nodes of the flat mesh onto the bent part; empty for a part that is not bent.
[[nodiscard]] fem::Shaping shaping(const Part& part);

/// Mass of the part, kg, in closed form on the flat mesh: ρ ∫ (1 + w/R) dV, R infinite without a bend.
[[nodiscard]] double mass(const Part& part, const mesh::TetMesh& flat);

/// A face of the box around the part, or a selection, by its name.
[[nodiscard]] mesh::Region region_of(const PartSetup& source, const std::string& name);

/// The nodes of a mesh from a file that are held: 3·node + axis of the supports on its sets. `nodes`: those of the
/// mesh, or of a higher order on it, which are held where all of the mesh's own are (mesh::set_of_order()).
[[nodiscard]] std::vector<int> rows_held_by_sets(const PartSetup& source, const mesh::SolidMesh& solid,
                                                 const mesh::LagrangeNodes& nodes);

/// The material of the part as the finite elements take it.
[[nodiscard]] fem::Material material_of(const Part& part);

/// Supports on faces and selections; those on sets of nodes are rows_held_by_sets().
[[nodiscard]] std::vector<fem::Support> supports_of(const PartSetup& source);

/// The distance (m) by which elements may lie off a place that is given on the part: nothing where they fill it
/// exactly; 0.01 of the diagonal where they follow a file's surface by chords (outside_part() has held the place to the
/// surface itself); what the edges of a file's curved elements bow by.
[[nodiscard]] double off_surface(const Part& part);

/// Directions that choose the face of a point's patch (mesh::Disc::facing): the normal of points.NAME.face, or else the
/// point's directions.
[[nodiscard]] std::vector<Eigen::Vector3d> facing(const PartSetup& source, const Point& point);

/// The point of that name as the finite elements take it. Throws InputError with the nearest name if there is none.
[[nodiscard]] fem::NamedPoint named_point(const PartSetup& source, const std::string& name);

/// The modes that the set-up asks for.
[[nodiscard]] fem::ModeOptions mode_options(const PartSetup& source);

/// A line for each point on whose receptance no tolerance can be met, for it has no patch: a force on a single place of
/// a solid moves it without bound as elements shrink. None where size or mesh are given.
[[nodiscard]] std::vector<std::string> unreachable_tolerances(const PartSetup& source);

}  // namespace thinwall::setup
